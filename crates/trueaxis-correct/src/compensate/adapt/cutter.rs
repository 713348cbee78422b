//! The cutter: a ball, a flat or a bull-nosed end mill.

use trueaxis_geometry::Vec3;

/// A cutter of revolution with one radius at its corner.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cutter {
    /// Half of the diameter.
    pub radius_mm: f64,
    /// Of the corner: equal to the radius for a ball, 0 for a flat end.
    pub corner_mm: f64,
}

impl Cutter {
    /// From the tip to the point that touches a surface with this normal.
    ///
    /// o = ρ·a − (R − ρ)·t − ρ·n, t = (n − (n·a)a)/|…|              docs/model.md eq. 151
    ///
    /// ```
    /// use trueaxis_correct::compensate::adapt::Cutter;
    /// use trueaxis_geometry::Vec3;
    /// let ball = Cutter { radius_mm: 2.0, corner_mm: 2.0 };
    /// // An upright ball on an upright wall touches with its equator.
    /// assert_eq!(ball.contact(&Vec3::z(), &Vec3::x()), Vec3::new(-2.0, 0.0, 2.0));
    /// ```
    pub fn contact(&self, axis: &Vec3, normal: &Vec3) -> Vec3 {
        let across = normal - axis * normal.dot(axis);
        // A flat end that lies flat touches everywhere: its middle stands for it.
        let out = across.try_normalize(1e-9).unwrap_or(Vec3::zeros());
        (axis - normal) * self.corner_mm - out * (self.radius_mm - self.corner_mm)
    }

    /// How far a point is outside of the cutter and its shank of the same radius; inside: negative.
    pub fn distance(&self, tip: &Vec3, axis: &Vec3, point: &Vec3) -> f64 {
        let arm = point - tip;
        let height = arm.dot(axis);
        let radial = (arm.norm_squared() - height * height).max(0.0).sqrt();
        let side = radial - (self.radius_mm - self.corner_mm);
        let below = self.corner_mm - height;
        side.max(below).min(0.0) + side.max(0.0).hypot(below.max(0.0)) - self.corner_mm
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_point_that_touches_is_on_the_cutter() {
        let (axis, normal) = (Vec3::new(0.0, 0.6, 0.8), Vec3::new(0.6, 0.0, 0.8));
        for corner_mm in [0.0, 0.5, 3.0] {
            let cutter = Cutter { radius_mm: 3.0, corner_mm };
            let tip = Vec3::new(1.0, 2.0, 3.0);
            let touched = tip + cutter.contact(&axis, &normal);
            assert!(cutter.distance(&tip, &axis, &touched).abs() < 1e-12);
            let above = cutter.distance(&tip, &axis, &(touched - normal * 0.1));
            assert!((above - 0.1).abs() < 1e-12 || corner_mm == 0.0, "{above}");
        }
    }
}
