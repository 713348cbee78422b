//! Points of a cut cone from a coordinate measuring machine: the same indices as a prediction.
//!
//! [`Cone::measured`] gives the indices, [`Cone::measured_sections`] what is drawn, [`Cone::best_fit_of`] another
//! frame; [`Cone::suspicion`] what is wrong with points that lie elsewhere.

mod frame;
mod suspicion;

pub use suspicion::Suspicion;

use super::cone::{Cone, INDICES};
use super::{Contact, CutSurface, PartSection, TestPiece, ToolPosition};
use crate::Error;
use crate::fit::circle::{Circles, Fitter};
use std::f64::consts::{FRAC_PI_2, TAU};
use trueaxis_geometry::Vec3;

/// A point of the surface in the workpiece frame, and the section (height) that it belongs to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeasuredPoint {
    /// The point of contact, mm; of centres of a probe ball see [`Cone::contact_mm`].
    pub place_mm: Vec3,
    /// Index of the section of the piece.
    pub section: usize,
}

/// The reason why measured points cannot be evaluated. Points are counted from 0.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum MeasuredFault {
    /// NaN or infinite.
    #[error("point {point} has a coordinate that is not finite")]
    NotFinite {
        /// The point.
        point: usize,
    },
    /// A section that the piece does not have.
    #[error("point {point} belongs to section {section}, which the piece does not have")]
    NoSection {
        /// The point.
        point: usize,
        /// The section that it names.
        section: usize,
    },
    /// The height is not that of the section.
    #[error(
        "point {point} is {off_mm:+.3} mm off the height of its section, at most 1 mm is allowed"
    )]
    OtherHeight {
        /// The point.
        point: usize,
        /// z of the point less z of the section, mm.
        off_mm: f64,
    },
    /// Not on the nominal surface: another frame, another unit, or centres of the probe ball.
    #[error("point {point} is {off_mm:+.3} mm off the nominal surface, at most 2 mm is allowed")]
    OffSurface {
        /// The point.
        point: usize,
        /// Distance along the normal of the surface, mm; positive outside.
        off_mm: f64,
    },
    /// The same coordinates twice.
    #[error("point {point} repeats point {first}")]
    Duplicate {
        /// The later point.
        point: usize,
        /// The earlier one.
        first: usize,
    },
    /// The form of a section needs eight points.
    #[error("section {section} has {found} points, at least 8 are needed")]
    TooFew {
        /// The section.
        section: usize,
        /// Its number of points.
        found: usize,
    },
    /// More than a quarter of the circumference without a point.
    #[error("section {section} has no point over {gap_rad:.3} rad of its circumference")]
    Arc {
        /// The section.
        section: usize,
        /// The largest gap, rad.
        gap_rad: f64,
    },
    /// No circle fits the points.
    #[error("{0}")]
    Fit(#[from] Error),
}

/// An index of a measured part.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeasuredIndex {
    /// Its value, mm.
    pub value_mm: f64,
    /// Its standard uncertainty from that of the points, mm.
    pub u_mm: f64,
}

/// Least number of points that shows the form of a section.
const MIN_POINTS: usize = 8;
/// Largest distance of a point from the height of its section.
const HEIGHT_MM: f64 = 1.0;
/// Largest distance of a point from the nominal surface.
const OFF_MM: f64 = 2.0;
/// Positions in [`INDICES`] whose vectors a measuring machine does not see: Eq 20 and the error of the tip.
const UNSEEN: [usize; 3] = [2, 3, 10];

/// Azimuth and E = n_f·(p − nominal surface) of the points of one section, in the order of the azimuth.
type Ring = Vec<(f64, f64)>;

impl Cone {
    /// The point of contact of a probe ball whose centre was measured.
    ///
    /// ```text
    /// p = c − r n_f(φ)        φ the azimuth of the centre, r the radius of the ball
    /// ```
    ///
    /// The nominal normal is used: with an actual one that leans by ε, p lies r(1 − cos ε) too deep, 0.01 nm
    /// for 100 µrad and 2 mm.
    ///
    /// # Example
    /// ```
    /// use trueaxis_geometry::Vec3;
    /// use trueaxis_part::testpiece::cone::{Cone, ConeSize};
    /// let cone = Cone::new("NAS 979", ConeSize::nas979())?;
    /// let contact = cone.contact_mm(Vec3::new(130.0, 0.0, -58.0), 2.0);
    /// assert!((contact.x - 128.068).abs() < 1e-3);       // 130 − 2 cos 15°
    /// assert!((contact.z - -58.518).abs() < 1e-3);       // −58 − 2 sin 15°
    /// # Ok::<(), trueaxis_part::Error>(())
    /// ```
    pub fn contact_mm(&self, centre_mm: Vec3, ball_radius_mm: f64) -> Vec3 {
        let (sin, cos) = centre_mm.y.atan2(centre_mm.x).sin_cos();
        let (tilt_sin, tilt_cos) = self.size().half_angle_rad.sin_cos();
        centre_mm - Vec3::new(tilt_cos * cos, tilt_cos * sin, tilt_sin) * ball_radius_mm
    }

    /// Every index that measured points show, in the order of [`INDICES`], each with u.
    ///
    /// ```text
    /// r′ = √(x² + y²) + (z − z_H) tan α        the point moved along the generatrix to the height of its section
    /// E  = (r′ − R(H)) cos α                   as in the prediction
    /// u² = Σ (∂index/∂Eᵢ)² u_point²            independent points; differences of ± u_point
    /// ```
    ///
    /// Roundness and coaxiality are those of the points; angularity and Eq 19 compare sections, so each section is
    /// interpolated linearly in the azimuth at the azimuths of the others. Indices that need a section without
    /// points, or the error vector of the tool (Eq 20), are `None`.
    ///
    /// # Errors
    /// [`MeasuredFault`] names the point or the section.
    ///
    /// # Source
    /// Wu et al. 2022, section 3 and Table 4 (measured on a coordinate measuring machine); JCGM 100:2008, 5.1.2.
    pub fn measured(
        &self,
        points: &[MeasuredPoint],
        u_point_mm: f64,
    ) -> Result<Vec<Option<MeasuredIndex>>, MeasuredFault> {
        let mut places = self.accepted(points)?;
        let values = self.of_points(points, &places)?;
        let mut squares = [0.0; INDICES.len()];
        let step_mm = u_point_mm;
        for i in 0..if step_mm > 0.0 { places.len() } else { 0 } {
            let there = places[i];
            let mut at = |e: f64| {
                places[i].1 = there.1 + e;
                self.of_points(points, &places)
            };
            let (up, down) = (at(step_mm)?, at(-step_mm)?);
            places[i] = there;
            for ((square, up), down) in squares.iter_mut().zip(up).zip(down) {
                *square += (0.5 * (up.unwrap_or(0.0) - down.unwrap_or(0.0))).powi(2);
            }
        }
        let index = |(value, square): (Option<f64>, f64)| {
            value.map(|value_mm| MeasuredIndex { value_mm, u_mm: square.sqrt() })
        };
        Ok(values.into_iter().zip(squares).map(index).collect())
    }

    /// The measured sections with their fitted circles, from the base upwards; sections without points are left out.
    /// Their indices are those of form and position.
    ///
    /// # Errors
    /// As [`Cone::measured`].
    pub fn measured_sections(
        &self,
        points: &[MeasuredPoint],
    ) -> Result<Vec<PartSection>, MeasuredFault> {
        let (places, size) = (self.accepted(points)?, self.size());
        let mut sections = Vec::new();
        for (section, height_mm) in size.heights_mm.iter().copied().enumerate() {
            let Some(ring) = self.ring(points, &places, section)? else { continue };
            let profile_mm = self.profile_of(&ring, height_mm);
            let circles = Fitter::default().all(&profile_mm).map_err(Error::from)?;
            let mut indices_mm = vec![None; INDICES.len()];
            for (i, value) in forms(&ring, &circles) {
                indices_mm[i] = Some(value);
            }
            sections.push(PartSection {
                height_mm,
                z_mm: height_mm - size.height_mm,
                radius_mm: self.radius_mm(height_mm),
                azimuth_rad: ring.iter().map(|r| r.0).collect(),
                deviation_mm: ring.iter().map(|r| r.1).collect(),
                profile_mm,
                circles,
                indices_mm,
            });
        }
        Ok(sections)
    }

    /// Points of the surface of a cut, as a coordinate measuring machine without errors would find them: nominal
    /// point + E n_f, tool position after tool position, from the base upwards.
    pub fn points_of(&self, cut: &CutSurface<'_>) -> Vec<MeasuredPoint> {
        let positions = self.tool_positions();
        let contacts = positions.iter().flat_map(|p| p.contacts.iter().map(move |c| (p, c)));
        let radius_mm = 0.5 * self.size().tool_diameter_mm;
        let point = |((position, contact), deviation): ((&ToolPosition, &Contact), &Vec3)| {
            let normal = contact.normal.vector();
            let axis = position.tip.along(position.axis, contact.along_axis_mm).vector();
            let nominal = axis - normal * radius_mm;
            let error = normal.dot(&(deviation - cut.datum.displacement_mm(axis)));
            MeasuredPoint { place_mm: nominal + normal * error, section: contact.section }
        };
        contacts.zip(cut.deviation_mm).map(point).collect()
    }

    /// Points of another surface of this piece at the azimuths of measured points, with the E of `sections`
    /// interpolated there; points of sections that are missing keep their own.
    pub fn points_at(
        &self,
        sections: &[PartSection],
        like: &[MeasuredPoint],
    ) -> Vec<MeasuredPoint> {
        let heights = &self.size().heights_mm;
        let rings: Vec<Option<Ring>> = heights
            .iter()
            .map(|h| {
                let section = sections.iter().find(|s| s.height_mm == *h)?;
                let azimuths = section.azimuth_rad.iter().map(|a| a.sin().atan2(a.cos()));
                let mut ring: Ring = azimuths.zip(section.deviation_mm.iter().copied()).collect();
                ring.sort_by(|a, b| a.0.total_cmp(&b.0));
                Some(ring).filter(|r| !r.is_empty())
            })
            .collect();
        let moved = |p: &MeasuredPoint| {
            let (_, normal, own) = self.row_of(p.place_mm);
            let ring = rings.get(p.section).and_then(Option::as_ref);
            let e = ring.map_or(own, |r| interpolated(r, p.place_mm.y.atan2(p.place_mm.x)));
            MeasuredPoint { place_mm: p.place_mm + normal * (e - own), ..*p }
        };
        like.iter().map(moved).collect()
    }

    /// A point moved along the normal of the surface.
    pub fn moved_outwards(&self, point: &MeasuredPoint, by_mm: f64) -> MeasuredPoint {
        let (_, normal, _) = self.row_of(point.place_mm);
        MeasuredPoint { place_mm: point.place_mm + normal * by_mm, ..*point }
    }

    /// The section whose height is nearest to a point.
    pub fn nearest_section(&self, place_mm: &Vec3) -> usize {
        let size = self.size();
        let height = place_mm.z + size.height_mm;
        let off = |s: &usize| (size.heights_mm[*s] - height).abs();
        (0..size.heights_mm.len()).min_by(|a, b| off(a).total_cmp(&off(b))).unwrap_or(0)
    }

    /// The profile of a section: radius + E / cos α.
    fn profile_of(&self, ring: &Ring, height_mm: f64) -> Vec<[f64; 2]> {
        let (radius, tilt_cos) = (self.radius_mm(height_mm), self.size().half_angle_rad.cos());
        let point = |(azimuth, e): &(f64, f64)| {
            let (sin, cos) = azimuth.sin_cos();
            [(radius + e / tilt_cos) * cos, (radius + e / tilt_cos) * sin]
        };
        ring.iter().map(point).collect()
    }

    /// Azimuth and E of every point.
    fn accepted(&self, points: &[MeasuredPoint]) -> Result<Vec<(f64, f64)>, MeasuredFault> {
        let (size, tan) = (self.size(), self.size().half_angle_rad.tan());
        let mut found = Vec::with_capacity(points.len());
        for (point, p) in points.iter().enumerate() {
            if !p.place_mm.iter().all(|v| v.is_finite()) {
                return Err(MeasuredFault::NotFinite { point });
            }
            let height = size.heights_mm.get(p.section);
            let no_section = MeasuredFault::NoSection { point, section: p.section };
            let height = *height.ok_or(no_section)?;
            let off_mm = p.place_mm.z - (height - size.height_mm);
            if off_mm.abs() > HEIGHT_MM {
                return Err(MeasuredFault::OtherHeight { point, off_mm });
            }
            let radius = p.place_mm.x.hypot(p.place_mm.y) + off_mm * tan;
            let error = (radius - self.radius_mm(height)) * size.half_angle_rad.cos();
            if error.abs() > OFF_MM {
                return Err(MeasuredFault::OffSurface { point, off_mm: error });
            }
            if let Some(first) = points[..point].iter().position(|q| q.place_mm == p.place_mm) {
                return Err(MeasuredFault::Duplicate { point, first });
            }
            found.push((p.place_mm.y.atan2(p.place_mm.x), error));
        }
        Ok(found)
    }

    fn ring(
        &self,
        points: &[MeasuredPoint],
        places: &[(f64, f64)],
        section: usize,
    ) -> Result<Option<Ring>, MeasuredFault> {
        let mine = points.iter().zip(places).filter(|(p, _)| p.section == section);
        let mut ring: Ring = mine.map(|(_, place)| *place).collect();
        if ring.is_empty() {
            return Ok(None);
        }
        if ring.len() < MIN_POINTS {
            return Err(MeasuredFault::TooFew { section, found: ring.len() });
        }
        ring.sort_by(|a, b| a.0.total_cmp(&b.0));
        let last = ring[0].0 + TAU - ring[ring.len() - 1].0;
        let gap_rad = ring.windows(2).map(|w| w[1].0 - w[0].0).fold(last, f64::max);
        if gap_rad > FRAC_PI_2 {
            return Err(MeasuredFault::Arc { section, gap_rad });
        }
        Ok(Some(ring))
    }

    fn of_points(
        &self,
        points: &[MeasuredPoint],
        places: &[(f64, f64)],
    ) -> Result<[Option<f64>; INDICES.len()], MeasuredFault> {
        let size = self.size();
        let sections = 0..size.heights_mm.len();
        let rings =
            sections.map(|s| self.ring(points, places, s)).collect::<Result<Vec<_>, _>>()?;
        let mut out = [None; INDICES.len()];
        let at = |height: &f64| size.heights_mm.iter().position(|h| h == height);
        let round = at(&size.roundness_height_mm).unwrap_or(0);
        if let Some(ring) = &rings[round] {
            let profile = self.profile_of(ring, size.roundness_height_mm);
            for (i, value) in forms(ring, &Fitter::default().all(&profile).map_err(Error::from)?) {
                out[i] = Some(value);
            }
        }
        let angular = size.angularity_heights_mm.iter().filter_map(at);
        let angular: Option<Vec<&Ring>> = angular.map(|s| rings[s].as_ref()).collect();
        if let Some(angular) = angular.filter(|a| a.len() > 1) {
            let [rise, zone] = lean(&angular);
            (out[1], out[9]) = (Some(rise), Some(zone));
        }
        debug_assert!(UNSEEN.iter().all(|i| out[*i].is_none()));
        Ok(out)
    }
}

/// The indices of form and position of one section, with their positions in [`INDICES`].
fn forms(ring: &Ring, circles: &Circles) -> [(usize, f64); 6] {
    let low = ring.iter().map(|r| r.1).fold(f64::INFINITY, f64::min);
    let high = ring.iter().map(|r| r.1).fold(f64::NEG_INFINITY, f64::max);
    [
        (0, 0.5 * (high - low)),
        (4, circles.lsc.width_mm()),
        (5, circles.mzc.width_mm()),
        (6, circles.mic.width_mm()),
        (7, circles.mcc.width_mm()),
        (8, circles.lsc.coaxiality_mm()),
    ]
}

/// Largest rise of E from the lowest to the highest section, and largest range of E over the sections.
fn lean(rings: &[&Ring]) -> [f64; 2] {
    let mut found = [f64::NEG_INFINITY, 0.0];
    for (azimuth, _) in rings.iter().flat_map(|ring| ring.iter()) {
        let errors: Vec<f64> = rings.iter().map(|ring| interpolated(ring, *azimuth)).collect();
        let low = errors.iter().copied().fold(f64::INFINITY, f64::min);
        let high = errors.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        found = [found[0].max(errors[errors.len() - 1] - errors[0]), found[1].max(high - low)];
    }
    found
}

/// E at an azimuth, linear between the two neighbours around the circumference.
fn interpolated(ring: &Ring, azimuth: f64) -> f64 {
    let after = ring.partition_point(|r| r.0 < azimuth);
    let n = ring.len();
    let (a, b) = (ring[(after + n - 1) % n], ring[after % n]);
    let step = (b.0 - a.0).rem_euclid(TAU);
    let part = if step > 0.0 { (azimuth - a.0).rem_euclid(TAU) / step } else { 0.0 };
    a.1 + (b.1 - a.1) * part
}
