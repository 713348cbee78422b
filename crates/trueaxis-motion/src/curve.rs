//! The path of a programmed point: lines, circles and helices in the program frame.

use trueaxis_geometry::Vec3;
use trueaxis_geometry::frame::rotation;
use trueaxis_nc::moves::{Arc, SpatialArc};

/// A curve with a parameter u from 0 to 1 that grows evenly with its length.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Curve {
    /// Straight on.
    Line { from: Vec3, to: Vec3 },
    /// On a circle, or a helix along its axis.
    ///
    /// ```text
    ///     p(u) = c + R(n, u·sweep)·(r + u·Δr·r/|r|) + u·rise·n        docs/model.md eq. 34
    /// ```
    Helix {
        /// A point of the axis, at the height of the start.
        center: Vec3,
        /// Unit vector.
        axis: Vec3,
        /// From the axis to the start.
        arm: Vec3,
        /// The end may lie a little nearer to the axis than the start, or farther.
        radius_change: f64,
        /// Right-handed about the axis, rad.
        sweep: f64,
        /// Along the axis.
        rise: f64,
    },
}

impl Curve {
    /// An arc of a main plane.
    pub fn arc(from: Vec3, to: Vec3, arc: &Arc) -> Self {
        let [first, second, third] = arc.plane.axes().map(|a| a as usize);
        let mut center = from;
        (center[first], center[second]) = (arc.center_mm[0], arc.center_mm[1]);
        let mut axis = Vec3::zeros();
        axis[third] = 1.0;
        Self::about(center, axis, arc.ccw, arc.turns, from, to)
    }

    /// An arc of any plane.
    pub fn spatial(from: Vec3, to: Vec3, arc: &SpatialArc) -> Self {
        let axis = Vec3::from(arc.normal).normalize();
        let center = Vec3::from(arc.center_mm);
        let center = center + axis * axis.dot(&(from - center));
        Self::about(center, axis, true, arc.turns, from, to)
    }

    fn about(center: Vec3, axis: Vec3, ccw: bool, turns: u32, from: Vec3, to: Vec3) -> Self {
        let arm = from - center;
        let rise = axis.dot(&(to - from));
        let end = to - center - axis * rise;
        let angle = axis.dot(&arm.cross(&end)).atan2(arm.dot(&end));
        // Rounding must not make a full circle of none: an angle of nearly zero is a full turn.
        let whole = f64::from(turns.max(1) - 1) * std::f64::consts::TAU;
        let first = if ccw { angle } else { -angle };
        let first = if first <= 1e-9 { first + std::f64::consts::TAU } else { first };
        let sweep = if ccw { first + whole } else { -(first + whole) };
        Self::Helix { center, axis, arm, radius_change: end.norm() - arm.norm(), sweep, rise }
    }

    /// The place at u.
    pub fn at(&self, u: f64) -> Vec3 {
        match *self {
            Self::Line { from, to } => from + (to - from) * u,
            Self::Helix { center, axis, arm, radius_change, sweep, rise } => {
                let radius = arm.norm();
                let grown = if radius > 0.0 { 1.0 + u * radius_change / radius } else { 1.0 };
                center + rotation(axis, sweep * u) * arm * grown + axis * (rise * u)
            }
        }
    }

    /// Its length, mm; that of a helix of the mean radius.
    pub fn length_mm(&self) -> f64 {
        match *self {
            Self::Line { from, to } => (to - from).norm(),
            Self::Helix { arm, radius_change, sweep, rise, .. } => {
                (sweep * (arm.norm() + 0.5 * radius_change)).hypot(rise)
            }
        }
    }

    /// No two points of it lie farther apart, mm; turns do not count.
    pub fn span_mm(&self) -> f64 {
        match *self {
            Self::Line { from, to } => (to - from).norm(),
            Self::Helix { arm, radius_change, rise, .. } => {
                (2.0 * arm.norm() + radius_change.abs()).hypot(rise).min(self.length_mm())
            }
        }
    }

    /// Pieces so that no chord leaves the curve by more than a tolerance.
    ///
    /// ```text
    ///     e = r·(1 − cos(θ/2))      θ = 2·arccos(1 − e/r)             docs/model.md eq. 35
    /// ```
    pub fn chords(&self, tolerance_mm: f64) -> f64 {
        let Self::Helix { arm, sweep, .. } = *self else { return 1.0 };
        let ratio = tolerance_mm / arm.norm();
        if ratio.is_nan() || ratio >= 2.0 {
            return 1.0;
        }
        // 1 − cos x = 2 sin²(x/2) keeps its digits for small x.
        sweep.abs() / (4.0 * (0.5 * ratio).sqrt().asin())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use trueaxis_nc::moves::Plane;

    fn arc(plane: Plane, center_mm: [f64; 2], turns: u32, ccw: bool) -> Arc {
        Arc { plane, center_mm, turns, ccw }
    }

    #[test]
    fn a_quarter_circle() {
        let (from, to) = (Vec3::new(10.0, 0.0, 5.0), Vec3::new(0.0, 10.0, 5.0));
        let quarter = Curve::arc(from, to, &arc(Plane::Xy, [0.0, 0.0], 1, true));
        let half = 10.0 / 2_f64.sqrt();
        assert!((quarter.at(0.5) - Vec3::new(half, half, 5.0)).norm() < 1e-12);
        assert!((quarter.length_mm() - 5.0 * std::f64::consts::PI).abs() < 1e-12);
        // The other direction: three quarters.
        let rest = Curve::arc(from, to, &arc(Plane::Xy, [0.0, 0.0], 1, false));
        assert!((rest.length_mm() - 15.0 * std::f64::consts::PI).abs() < 1e-12);
    }

    #[test]
    fn turns_make_a_curve_longer_but_not_wider() {
        let (from, to) = (Vec3::new(3.0, 0.0, 0.0), Vec3::new(3.0, 0.0, 8.0));
        for turns in [1, 1000] {
            let helix = Curve::arc(from, to, &arc(Plane::Xy, [0.0, 0.0], turns, true));
            assert!((helix.span_mm() - 10.0).abs() < 1e-12); // 6 across, 8 up
            assert!(helix.length_mm() > 18.0 * f64::from(turns));
        }
        assert_eq!(Curve::Line { from, to }.span_mm(), 8.0);
        // A short piece of a very large circle is no wider than it is long.
        let flat =
            Curve::arc(from, Vec3::new(3.0, 1.0, 0.0), &arc(Plane::Xy, [1e9, 0.5], 1, false));
        assert!((flat.span_mm() - 1.0).abs() < 1e-6, "{}", flat.span_mm());
    }

    #[test]
    fn a_full_circle_and_a_helix() {
        let from = Vec3::new(0.0, 0.0, 3.0); // G18: first axis Z, second X
        let full = Curve::arc(from, from, &arc(Plane::Zx, [0.0, 0.0], 1, true));
        assert!((full.at(0.25) - Vec3::new(3.0, 0.0, 0.0)).norm() < 1e-12);
        let to = Vec3::new(0.0, 8.0, 3.0);
        let helix = Curve::arc(from, to, &arc(Plane::Zx, [0.0, 0.0], 2, true));
        assert!((helix.at(0.5) - Vec3::new(0.0, 4.0, 3.0)).norm() < 1e-12);
    }

    #[test]
    fn chords_by_hand() {
        // r = 1, e = 1 − cos 30°: chords of 60°, six in a circle.
        let from = Vec3::new(1.0, 0.0, 0.0);
        let full = Curve::arc(from, from, &arc(Plane::Xy, [0.0, 0.0], 1, true));
        assert!((full.chords(1.0 - 30_f64.to_radians().cos()) - 6.0).abs() < 1e-9);
    }
}
