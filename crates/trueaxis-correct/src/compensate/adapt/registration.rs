//! How the blank lies: the rigid part of the deviations.

use super::table::SurfacePoint;
use nalgebra::{DMatrix, Matrix6, Vector6};
use trueaxis_geometry::frame::rotation;
use trueaxis_geometry::{Mat3, Vec3};

/// A freedom that moves the surface along its normals by less than this share of itself (rms) cannot
/// be determined from the readings.
const LEAST_EFFECT: f64 = 0.02;

/// The freedoms of a rigid body that change readings along the normals.
///
/// d = n·τ + ((p − c) × n)·ω                                     docs/model.md eq. 147
#[derive(Debug, Clone)]
pub struct Freedoms {
    /// Rotations count about it.
    pub center_mm: Vec3,
    /// A rotation counts as its path at this arm.
    pub arm_mm: f64,
    /// Orthogonal, (τ, ω·arm): seen.
    pub seen: Vec<Vector6<f64>>,
    /// The others, held at zero.
    pub held: Vec<Vector6<f64>>,
}

impl Freedoms {
    /// By singular values: what moves the surface and what does not.
    pub fn of(points: &[SurfacePoint]) -> Self {
        let count = points.len().max(1) as f64;
        let center_mm = points.iter().map(|p| p.at_mm).sum::<Vec3>() / count;
        let square = points.iter().map(|p| (p.at_mm - center_mm).norm_squared()).sum::<f64>();
        let arm_mm = (square / count).sqrt().max(1e-9);
        let mut freedoms = Self { center_mm, arm_mm, seen: Vec::new(), held: Vec::new() };
        let normal: Matrix6<f64> = points
            .iter()
            .map(|p| freedoms.row(&p.at_mm, &p.normal))
            .map(|row| row * row.transpose())
            .sum();
        let eigen = (normal / count).symmetric_eigen();
        for k in 0..6 {
            let freedom = eigen.eigenvectors.column(k).into_owned();
            let seen = eigen.eigenvalues[k].max(0.0).sqrt() >= LEAST_EFFECT;
            if seen { &mut freedoms.seen } else { &mut freedoms.held }.push(freedom);
        }
        freedoms
    }

    fn row(&self, at: &Vec3, normal: &Vec3) -> Vector6<f64> {
        let turn = (at - self.center_mm).cross(normal) / self.arm_mm;
        Vector6::new(normal.x, normal.y, normal.z, turn.x, turn.y, turn.z)
    }

    /// What each freedom that is seen adds to a reading.
    pub(super) fn basis(&self, at: &Vec3, normal: &Vec3) -> Vec<f64> {
        let row = self.row(at, normal);
        self.seen.iter().map(|f| f.dot(&row)).collect()
    }
}

/// The blank as it was set up.
#[derive(Debug, Clone)]
pub struct Registration {
    /// Which freedoms were seen, which held.
    pub freedoms: Freedoms,
    /// Shift of the centre and rotation times the arm, mm.
    pub moved_mm: Vector6<f64>,
    /// Their covariance; zero for what is held.
    pub covariance_mm2: Matrix6<f64>,
}

impl Registration {
    pub(super) fn of(freedoms: Freedoms, beta: &[f64], covariance: &DMatrix<f64>) -> Self {
        let mut moved_mm = Vector6::zeros();
        let mut covariance_mm2 = Matrix6::zeros();
        for (i, f) in freedoms.seen.iter().enumerate() {
            moved_mm += f * beta[i];
            for (j, g) in freedoms.seen.iter().enumerate() {
                covariance_mm2 += f * g.transpose() * covariance[(i, j)];
            }
        }
        Self { freedoms, moved_mm, covariance_mm2 }
    }

    /// How far the middle of the points lies off.
    pub fn shift_mm(&self) -> Vec3 {
        self.moved_mm.fixed_rows::<3>(0).into_owned()
    }

    /// How far the blank is turned about it.
    pub fn turn_rad(&self) -> Vec3 {
        self.moved_mm.fixed_rows::<3>(3) / self.freedoms.arm_mm
    }

    /// Standard uncertainty of the shift.
    pub fn u_shift_mm(&self) -> Vec3 {
        Vec3::from_fn(|i, _| self.covariance_mm2[(i, i)].max(0.0).sqrt())
    }

    /// Standard uncertainty of the rotation.
    pub fn u_turn_rad(&self) -> Vec3 {
        let variance = |i: usize| self.covariance_mm2[(i + 3, i + 3)].max(0.0);
        Vec3::from_fn(|i, _| variance(i).sqrt() / self.freedoms.arm_mm)
    }

    pub(super) fn rotation(&self) -> Mat3 {
        let turn = self.turn_rad();
        let angle = turn.norm();
        if angle < 1e-15 { Mat3::identity() } else { rotation(turn / angle, angle) }
    }

    /// Where a point of the nominal part is on the blank as it was set up.
    pub(super) fn carry(&self, p: &Vec3) -> Vec3 {
        let center = self.freedoms.center_mm;
        self.rotation() * (p - center) + center + self.shift_mm()
    }

    /// What cannot be determined from the readings, in words.
    pub fn held_words(&self) -> Vec<String> {
        let f = &self.freedoms;
        f.held.iter().map(|q| words(q, &f.center_mm, f.arm_mm)).collect()
    }
}

/// A shift, or a turn about a line in space.
fn words(freedom: &Vector6<f64>, center: &Vec3, arm: f64) -> String {
    let shift = freedom.fixed_rows::<3>(0).into_owned();
    let turn = freedom.fixed_rows::<3>(3) / arm;
    let numbers = |v: &Vec3, digits: usize| {
        // + 0.0: no minus before a zero.
        let round = |x: f64| (x * 1e4).round() / 1e4 + 0.0;
        format!("{:.digits$} {:.digits$} {:.digits$}", round(v.x), round(v.y), round(v.z))
    };
    if turn.norm() * arm < 0.05 {
        return format!("shift along ({})", numbers(&shift.normalize(), 3));
    }
    let through = center + turn.cross(&shift) / turn.norm_squared();
    let pitch = shift.dot(&turn) / turn.norm_squared();
    let with = match (pitch * turn.norm()).abs() > 0.05 {
        true => format!(" with {pitch:.2} mm of shift along it per rad"),
        false => String::new(),
    };
    let direction = numbers(&turn.normalize(), 3);
    format!("turn about ({direction}) through ({}) mm{with}", numbers(&through, 2))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cylinder_holds_its_turn_and_its_shift() {
        let points: Vec<SurfacePoint> = (0..200)
            .map(|k| {
                let (a, z) = (f64::from(k) * 0.7, f64::from(k % 20));
                let normal = Vec3::new(a.cos(), a.sin(), 0.0);
                let at_mm = normal * 10.0 + Vec3::z() * z;
                SurfacePoint { line: 1, number: 1.0, at_mm, normal, deviation_mm: 0.0, u_mm: None }
            })
            .collect();
        let freedoms = Freedoms::of(&points);
        assert_eq!((freedoms.seen.len(), freedoms.held.len()), (4, 2));
        // Both keep the cylinder on itself: no point moves along its normal.
        for (f, p) in freedoms.held.iter().flat_map(|f| points.iter().map(move |p| (f, p))) {
            assert!(freedoms.row(&p.at_mm, &p.normal).dot(f).abs() < 1e-9, "{f}");
        }
    }
}
