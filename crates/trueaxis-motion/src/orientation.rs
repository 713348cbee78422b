//! How the tool axis gets from one direction to the next: great circle or cone.
//!
//! ```text
//!     d(u) = R(a, u·θ)·d0                                           docs/model.md eq. 36
//! ```
//!
//! On a great circle a is perpendicular to both directions; on a cone both lie at the same angle from a.

use trueaxis_geometry::frame::rotation;
use trueaxis_geometry::{Vec3, angle};
use trueaxis_nc::moves::Cone;

/// Directions nearer to opposite than this have no plane of their own, rad.
const OPPOSITE_RAD: f64 = 1e-9;

/// Both ends of a cone must lie at the same angle from its axis, within this, rad.
const CONE_RAD: f64 = 1e-4;

/// An even turn of the tool axis about a fixed axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Swing {
    pub from: Vec3,
    pub to: Vec3,
    pub about: Vec3,
    /// Right-handed.
    pub angle_rad: f64,
}

/// Why there is no swing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum NoSwing {
    /// Opposite directions: every great circle leads there.
    Opposite,
    /// The ends do not lie on one cone about the axis.
    NotOnCone,
    /// Neither axis nor angle nor a direction between is given.
    Undetermined,
}

impl Swing {
    /// In the plane of both directions, in the shorter direction.
    pub fn great_circle(from: Vec3, to: Vec3) -> Result<Self, NoSwing> {
        let normal = from.cross(&to);
        let angle_rad = angle(&from, &to);
        if std::f64::consts::PI - angle_rad < OPPOSITE_RAD {
            return Err(NoSwing::Opposite);
        }
        let about = if normal.norm() > 0.0 { normal.normalize() } else { perpendicular(&from) };
        Ok(Self { from, to, about, angle_rad })
    }

    /// On a cone; `to` is `None` where only the angle about the axis is given; `tangent` is the
    /// direction in which the tool axis turned last.
    pub fn cone(
        from: Vec3,
        to: Option<Vec3>,
        cone: &Cone,
        tangent: Option<Vec3>,
    ) -> Result<Self, NoSwing> {
        let unit = |v: [f64; 3]| Vec3::from(v).try_normalize(0.0).ok_or(NoSwing::Undetermined);
        if let (Some(axis), Some(degrees)) = (cone.axis, cone.angle_deg) {
            let about = unit(axis)?;
            let sign = if cone.ccw == Some(false) { -1.0 } else { 1.0 };
            let angle_rad = sign * degrees.to_radians();
            let reached = rotation(about, angle_rad) * from;
            if to.is_some_and(|to| angle(&to, &reached) > CONE_RAD) {
                return Err(NoSwing::NotOnCone);
            }
            return Ok(Self { from, to: to.unwrap_or(reached), about, angle_rad });
        }
        let to = to.ok_or(NoSwing::Undetermined)?;
        if let Some(axis) = cone.axis {
            return Self::about(unit(axis)?, from, to, cone.ccw);
        }
        if let Some(through) = cone.through {
            let through = unit(through)?;
            let normal = (through - from).cross(&(to - from));
            let about = normal.try_normalize(1e-12).ok_or(NoSwing::Undetermined)?;
            // Right-handed about this normal the three come in their order.
            return Self::about(about, from, to, Some(true));
        }
        if let Some(tangent) = tangent.filter(|_| cone.tangential) {
            let normal = tangent.cross(&(to - from)).try_normalize(1e-12);
            let Some(normal) = normal else { return Self::great_circle(from, to) };
            let forward = normal.cross(&from).dot(&tangent) > 0.0;
            let about = if forward { normal } else { -normal };
            return Self::about(about, from, to, Some(true));
        }
        let Some(half_opening) = cone.half_opening_deg else { return Self::great_circle(from, to) };
        let (middle, across) = (from + to, from.cross(&to));
        let (Some(middle), Some(across)) =
            (middle.try_normalize(1e-12), across.try_normalize(1e-12))
        else {
            return Err(NoSwing::Undetermined);
        };
        let x = half_opening.to_radians().cos() / middle.dot(&from);
        let y = (1.0 - x * x).max(0.0).sqrt();
        if x.abs() > 1.0 + CONE_RAD {
            return Err(NoSwing::NotOnCone);
        }
        let side = if cone.ccw == Some(false) { -1.0 } else { 1.0 };
        Self::about((middle * x + across * (side * y)).normalize(), from, to, cone.ccw)
    }

    fn about(about: Vec3, from: Vec3, to: Vec3, ccw: Option<bool>) -> Result<Self, NoSwing> {
        if (angle(&about, &from) - angle(&about, &to)).abs() > CONE_RAD {
            return Err(NoSwing::NotOnCone);
        }
        let (a, b) = (about.cross(&from), about.cross(&to));
        let shortest = about.dot(&a.cross(&b)).atan2(a.dot(&b));
        let turn = std::f64::consts::TAU;
        let angle_rad = match ccw {
            Some(true) if shortest < 0.0 => shortest + turn,
            Some(false) if shortest > 0.0 => shortest - turn,
            _ => shortest,
        };
        Ok(Self { from, to, about, angle_rad })
    }

    /// The direction at u; exactly the ends at 0 and 1.
    pub fn at(&self, u: f64) -> Vec3 {
        match u {
            0.0 => self.from,
            1.0 => self.to,
            _ => {
                let (sin, cos) = (self.angle_rad * u).sin_cos();
                let (about, from) = (&self.about, &self.from);
                let along = about * (about.dot(from) * (1.0 - cos));
                (from * cos + about.cross(from) * sin + along).normalize()
            }
        }
    }

    /// The angle that the tool axis itself travels, rad: on a cone less than about its axis.
    pub fn travelled_rad(&self) -> f64 {
        self.angle_rad.abs() * self.about.cross(&self.from).norm()
    }

    /// Where it turns to at its end.
    pub fn end_tangent(&self) -> Option<Vec3> {
        (self.about.cross(&self.to) * self.angle_rad.signum()).try_normalize(1e-12)
    }
}

fn perpendicular(v: &Vec3) -> Vec3 {
    let other = if v.x.abs() < 0.7 { Vec3::x() } else { Vec3::y() };
    v.cross(&other).normalize()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_hundred_equal_angles_on_a_great_circle() {
        // Jiang et al. densify by q = 100.
        let from = Vec3::new(0.0, 0.0, 1.0);
        let to = Vec3::new(0.6, -0.3, 0.7).normalize();
        let swing = Swing::great_circle(from, to).unwrap();
        let each = angle(&from, &to) / 100.0;
        let normal = from.cross(&to).normalize();
        for t in 0..100 {
            let (a, b) = (swing.at(f64::from(t) / 100.0), swing.at(f64::from(t + 1) / 100.0));
            assert!((angle(&a, &b) - each).abs() < 1e-12);
            assert!(normal.dot(&b).abs() < 1e-12);
        }
    }

    #[test]
    fn the_cone_of_siemens_example_turns_by_270_degrees() {
        // Axis (0,0,1), from (0,1,1) to (1,0,1); erratum 002-9.
        let (from, to) = (Vec3::new(0.0, 1.0, 1.0), Vec3::new(1.0, 0.0, 1.0));
        let cone = Cone { axis: Some([0.0, 0.0, 1.0]), ccw: Some(true), ..Cone::default() };
        let swing = Swing::cone(from.normalize(), Some(to.normalize()), &cone, None).unwrap();
        assert!((swing.angle_rad.to_degrees() - 270.0).abs() < 1e-9);
        assert!((swing.at(0.5).z - 0.5_f64.sqrt()).abs() < 1e-12);
    }

    #[test]
    fn a_cone_through_a_direction_and_one_by_its_opening() {
        let (from, to) = (Vec3::new(1.0, 0.0, 1.0), Vec3::new(0.0, 1.0, 1.0));
        let (from, to) = (from.normalize(), to.normalize());
        let through = Vec3::new(1.0, 1.0, 2_f64.sqrt()).normalize();
        let cone = Cone { through: Some(through.into()), ..Cone::default() };
        let swing = Swing::cone(from, Some(to), &cone, None).unwrap();
        assert!((swing.at(0.5) - through).norm() < 1e-12); // the cone about z, 45° along
        let cone = Cone { half_opening_deg: Some(45.0), ccw: Some(true), ..Cone::default() };
        let swing = Swing::cone(from, Some(to), &cone, None).unwrap();
        assert!(
            (swing.about - Vec3::z()).norm() < 1e-12
                || (angle(&swing.about, &from) - 45_f64.to_radians()).abs() < 1e-12
        );
    }

    #[test]
    fn opposite_directions_have_no_great_circle() {
        assert_eq!(Swing::great_circle(Vec3::z(), -Vec3::z()), Err(NoSwing::Opposite));
    }
}
