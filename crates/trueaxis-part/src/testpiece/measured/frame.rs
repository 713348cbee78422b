//! The frame in which a part agrees best with its nominal shape.

use super::{MeasuredPoint, Ring};
use crate::testpiece::cone::Cone;
use crate::testpiece::{Datum, TestPiece};
use nalgebra::{Rotation3, SMatrix, SVector};
use trueaxis_geometry::Vec3;

/// Steps of the fit of points; from a tilt of a few degrees five are enough.
const STEPS: usize = 20;

/// A place, the outward normal there and E.
type Row = (Vec3, Vec3, f64);

impl Cone {
    /// The rigid motion of a cut that takes away as much of E as possible.
    ///
    /// ```text
    /// Σ (E_i − n_i·(t + ω × p_i))² → min        ω_z = 0                              docs/model.md eq. 210
    /// ```
    ///
    /// # Source
    /// Least squares; Wu et al. 2022 measure from a reference hole instead (section 3).
    pub fn best_fit_of_cut(&self, deviation_mm: &[Vec3]) -> Datum {
        let contacts = self.tool_positions().into_iter().flat_map(|p| {
            let axis_of = move |along| p.tip.along(p.axis, along).vector();
            p.contacts.into_iter().map(move |c| (axis_of(c.along_axis_mm), c.normal.vector()))
        });
        let rows = contacts.zip(deviation_mm).map(|((place, n), e)| (place, n, n.dot(e)));
        fitted(rows)
    }

    /// The rigid motion that takes measured points as near to the nominal surface as possible, and the points after
    /// it. Their sections stay.
    pub fn best_fit_of(&self, points: &[MeasuredPoint]) -> (Datum, Vec<MeasuredPoint>) {
        let mut moved = points.to_vec();
        let (mut turn, mut shift_mm) = (Rotation3::identity(), Vec3::zeros());
        for _ in 0..STEPS {
            let step = fitted(moved.iter().map(|p| self.row_of(p.place_mm)));
            // An exact rotation: another frame may be turned by degrees.
            let back = Rotation3::from_scaled_axis(-step.tilt_rad);
            for point in &mut moved {
                point.place_mm = back * (point.place_mm - step.shift_mm);
            }
            (turn, shift_mm) = (back * turn, back * (shift_mm - step.shift_mm));
            if step.shift_mm.norm() + 100.0 * step.tilt_rad.norm() < 1e-9 {
                break;
            }
        }
        // p′ = R p + d: the new origin is at −Rᵀ d of the old frame.
        let found = Datum { shift_mm: turn.inverse() * -shift_mm, tilt_rad: -turn.scaled_axis() };
        (found, moved)
    }

    /// E and the normal at the azimuth of a point, at its own height.
    pub(super) fn row_of(&self, place: Vec3) -> Row {
        let (sin, cos) = place.y.atan2(place.x).sin_cos();
        let (tilt_sin, tilt_cos) = self.size().half_angle_rad.sin_cos();
        let normal = Vec3::new(tilt_cos * cos, tilt_cos * sin, tilt_sin);
        let radius = self.radius_mm(place.z + self.size().height_mm);
        (place, normal, (place.x.hypot(place.y) - radius) * tilt_cos)
    }
}

/// Least squares of three shifts and two tilts. What the rows do not determine (the height of a cylinder) is 0.
fn fitted(rows: impl Iterator<Item = Row>) -> Datum {
    // Lengths of tilts in units of 100 mm, so that all five are alike in size.
    const ARM_MM: f64 = 100.0;
    let (mut normal, mut right) = (SMatrix::<f64, 5, 5>::zeros(), SVector::<f64, 5>::zeros());
    for (place, n, e) in rows {
        let turn = place.cross(&n) / ARM_MM;
        let row = SVector::<f64, 5>::new(n.x, n.y, n.z, turn.x, turn.y);
        normal += row * row.transpose();
        right += row * e;
    }
    let eigen = normal.symmetric_eigen();
    let least = 1e-10 * eigen.eigenvalues.max();
    let mut found = SVector::<f64, 5>::zeros();
    for (value, vector) in eigen.eigenvalues.iter().zip(eigen.eigenvectors.column_iter()) {
        if *value > least {
            found += vector * (vector.dot(&right) / value);
        }
    }
    Datum {
        shift_mm: Vec3::new(found[0], found[1], found[2]),
        tilt_rad: Vec3::new(found[3], found[4], 0.0) / ARM_MM,
    }
}

/// Largest difference of E between neighbours, for the search of gross errors.
pub(super) fn jumps(ring: &Ring) -> Vec<f64> {
    let n = ring.len();
    let off = |i: usize| {
        let (before, after) = (ring[(i + n - 1) % n], ring[(i + 1) % n]);
        let whole = (after.0 - before.0).rem_euclid(std::f64::consts::TAU);
        let part = (ring[i].0 - before.0).rem_euclid(std::f64::consts::TAU);
        let share = if whole > 0.0 { part / whole } else { 0.5 };
        ring[i].1 - before.1 - (after.1 - before.1) * share
    };
    (0..n).map(off).collect()
}
