//! What is wrong with points that do not lie on the piece, and which single points do not belong there.

use super::frame::jumps;
use super::{HEIGHT_MM, MeasuredFault, MeasuredPoint, OFF_MM, Ring};
use crate::testpiece::cone::Cone;
use trueaxis_geometry::Vec3;
use trueaxis_geometry::statistics::robust_deviation;

/// The likely reason why all points lie beside the piece.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Suspicion {
    /// Multiplied by this they would lie on it: another unit of length. Unit: 1.
    Unit(f64),
    /// They would lie on it if these columns (0, 1, 2) were x, y and z.
    Columns([usize; 3]),
    /// All are this much outside, mm: a radius of the stylus, a step, another tool.
    Radius(f64),
    /// They would lie on it with z the other way round.
    UpsideDown,
    /// They lie on the same cone elsewhere.
    Frame {
        /// Where its origin is, mm.
        shift_mm: Vec3,
        /// How far its axis is turned, rad.
        tilt_rad: f64,
    },
}

/// With the right reason the points are as near to the surface as this, mm.
const NEAR_MM: f64 = 0.5;
/// A stylus has a larger radius than this, mm; less is a tool that cuts too much or too little.
const STYLUS_MM: f64 = 0.2;
/// The share of points that decides.
const MOST: f64 = 0.9;
/// A point is off by so many times the spread of the others.
const GROSS: f64 = 8.0;

impl Cone {
    /// Why nearly all points lie beside the piece. `None` if they lie on it, and where no reason fits: then each
    /// point has its own fault.
    pub fn suspicion(&self, places_mm: &[Vec3]) -> Option<Suspicion> {
        if places_mm.is_empty() || !places_mm.iter().flat_map(|p| p.iter()).all(|v| v.is_finite()) {
            return None;
        }
        let fits = |change: &dyn Fn(Vec3) -> Vec3, off_mm: f64| {
            let good = places_mm.iter().filter(|p| self.can_be(change(**p), off_mm)).count();
            good as f64 >= MOST * places_mm.len() as f64
        };
        let mean_mm =
            places_mm.iter().map(|p| self.row_of(*p).2).sum::<f64>() / places_mm.len() as f64;
        if fits(&|p| p, OFF_MM) {
            return (mean_mm.abs() > STYLUS_MM).then_some(Suspicion::Radius(mean_mm));
        }
        for factor in [25.4, 1.0 / 25.4, 1e-3, 1e3, 0.1, 10.0] {
            if fits(&|p| p * factor, NEAR_MM) {
                return Some(Suspicion::Unit(factor));
            }
        }
        for order in [[1, 0, 2], [0, 2, 1], [2, 1, 0], [1, 2, 0], [2, 0, 1]] {
            if fits(&|p| Vec3::new(p[order[0]], p[order[1]], p[order[2]]), NEAR_MM) {
                return Some(Suspicion::Columns(order));
            }
        }
        if fits(&|p| self.contact_mm(p, mean_mm), NEAR_MM) {
            return Some(Suspicion::Radius(mean_mm));
        }
        if fits(&|p| Vec3::new(p.x, -p.y, -p.z), NEAR_MM) {
            return Some(Suspicion::UpsideDown);
        }
        self.elsewhere(places_mm)
    }

    /// The same cone with another origin and axis.
    fn elsewhere(&self, places_mm: &[Vec3]) -> Option<Suspicion> {
        let count = places_mm.len() as f64;
        let mean = places_mm.iter().sum::<Vec3>() / count;
        let size = self.size();
        let middle = size.heights_mm.iter().sum::<f64>() / size.heights_mm.len() as f64;
        let first = Vec3::new(mean.x, mean.y, mean.z - (middle - size.height_mm));
        let near = |p: &Vec3| MeasuredPoint { place_mm: p - first, section: 0 };
        let points: Vec<MeasuredPoint> = places_mm.iter().map(near).collect();
        let (found, moved) = self.best_fit_of(&points);
        let good = moved.iter().filter(|p| self.can_be(p.place_mm, NEAR_MM)).count();
        (good as f64 >= MOST * count).then_some(Suspicion::Frame {
            shift_mm: first + found.shift_mm,
            tilt_rad: found.tilt_rad.norm(),
        })
    }

    /// Whether a point can be of a section of this piece.
    fn can_be(&self, place: Vec3, off_mm: f64) -> bool {
        let height = self.size().heights_mm[self.nearest_section(&place)];
        let off_height = place.z - (height - self.size().height_mm);
        off_height.abs() <= HEIGHT_MM && self.row_of(place).2.abs() <= off_mm
    }

    /// Single points that jump out of their section: their number and by how much E jumps, mm.
    ///
    /// ```text
    /// d_i = E_i − line through both neighbours        |d_i| > 8 s and > 5 u, s the robust deviation of d
    /// ```
    ///
    /// # Errors
    /// As [`Cone::measured`].
    ///
    /// # Source
    /// Median absolute deviation as a robust spread: Rousseeuw, Croux 1993, J. Am. Stat. Assoc. 88, 1273.
    pub fn gross_points(
        &self,
        points: &[MeasuredPoint],
        u_point_mm: f64,
    ) -> Result<Vec<(usize, f64)>, MeasuredFault> {
        let places = self.accepted(points)?;
        let mut found = Vec::new();
        for section in 0..self.size().heights_mm.len() {
            let mut mine: Vec<usize> =
                (0..points.len()).filter(|i| points[*i].section == section).collect();
            mine.sort_by(|a, b| places[*a].0.total_cmp(&places[*b].0));
            // The worst goes first, and its neighbours are examined again without it.
            while mine.len() > 8 {
                let ring: Ring = mine.iter().map(|i| places[*i]).collect();
                let off = jumps(&ring);
                let sizes: Vec<f64> = off.iter().map(|d| d.abs()).collect();
                let spread_mm = robust_deviation(off.iter().copied());
                let limit_mm = (GROSS * spread_mm).max(5.0 * u_point_mm);
                let worst = (0..sizes.len()).max_by(|a, b| sizes[*a].total_cmp(&sizes[*b]));
                let Some(worst) = worst.filter(|w| sizes[*w] > limit_mm.max(1e-6)) else { break };
                found.push((mine.remove(worst), off[worst]));
                if found.len() > 20 {
                    return Ok(found);
                }
            }
        }
        Ok(found)
    }
}
