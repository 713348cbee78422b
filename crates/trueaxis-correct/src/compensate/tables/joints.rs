//! Where the rotary axes really are: kinematic parameters of controls with a tool-centre-point transformation.
//!
//! ```text
//!     point        a point of the axis, bed frame, all axes at 0
//!     direction    along the axis there
//! ```
//!
//! A control that has them moves the linear axes so that the tip is right about the actual axes. A turn of an
//! axis about itself (its zero) is none of them. docs/model.md eq. 330.

use trueaxis_geometry::Vec3;
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{Approach, AxisKind, Command};
use trueaxis_machine::errors::{
    BodyName, Component, ErrorIndex, ErrorKind, ErrorName, ErrorValues,
};

/// A count of a point, mm.
const POINT_MM: f64 = 1e-6;
/// A count of a direction.
const DIRECTION: f64 = 1e-9;

/// A rotary axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Joint {
    /// Its letter.
    pub axis: BodyName,
    /// A point of it, counts of 10⁻⁶ mm.
    pub point: [i64; 3],
    /// Along it, a unit vector in counts of 10⁻⁹.
    pub direction: [i64; 3],
}

/// All rotary axes, in chain order from the workpiece to the tool.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Joints(pub Vec<Joint>);

fn whole(v: Vec3, count: f64) -> [i64; 3] {
    [v.x, v.y, v.z].map(|c| (c / count).round() as i64)
}

fn vector(counts: [i64; 3], count: f64) -> Vec3 {
    let [x, y, z] = counts.map(|c| c as f64 * count);
    Vec3::new(x, y, z)
}

impl Joint {
    /// The point, mm.
    pub fn point_mm(&self) -> Vec3 {
        vector(self.point, POINT_MM)
    }

    /// Along it.
    pub fn along(&self) -> Vec3 {
        vector(self.direction, DIRECTION)
    }
}

/// Whether a location error moves or tilts a rotary axis; the turn about itself does neither.
pub fn moves_an_axis(machine: &Machine, error: ErrorName) -> bool {
    let Some(i) = machine.axis_index(error.body) else { return false };
    let axis = &machine.axes()[i];
    let about = axis.direction.iamax();
    let place = error.kind == ErrorKind::Location && axis.kind == AxisKind::Rotary;
    place && error.component as usize != about + 3
}

impl Joints {
    /// The rotary axes as these errors have placed them.
    pub fn of(machine: &Machine, errors: &ErrorValues) -> Self {
        let poses = machine.body_poses(&Command::default(), errors);
        let joints = machine.bodies().iter().zip(&poses).filter_map(|(body, pose)| {
            let axis = &machine.axes()[body.axis?];
            let along: Vec3 = pose.linear() * axis.direction;
            (axis.kind == AxisKind::Rotary).then(|| Joint {
                axis: body.name,
                point: whole(*pose.shift_mm(), POINT_MM),
                direction: whole(along, DIRECTION),
            })
        });
        Self(joints.collect())
    }

    /// The same without errors.
    pub fn nominal(machine: &Machine) -> Self {
        Self::of(machine, &ErrorValues::default())
    }

    /// Those of a machine that has these location errors and no others.
    pub fn actual(machine: &Machine) -> Self {
        let mut placed = ErrorValues::default();
        let stated =
            machine.errors_at(&Command::default(), &Approach::default()).unwrap_or_default();
        for (index, name) in machine.stated_errors() {
            if moves_an_axis(machine, name) {
                placed.set(index, stated.get(index));
            }
        }
        Self::of(machine, &placed)
    }

    /// Sets the location errors that place the axes so: from the bed outwards on both sides.
    pub fn place(&self, machine: &Machine, errors: &mut ErrorValues) {
        let side = machine.workpiece_side();
        let count = machine.bodies().len();
        let mut placed = ErrorValues::default();
        for body in (0..side).rev().chain(side..count) {
            let chain = &machine.bodies()[body];
            let joint = self.0.iter().find(|j| j.axis == chain.name);
            let Some((joint, axis)) = joint.zip(chain.axis) else { continue };
            // What the joints nearer to the bed do to this one is in the pose already.
            let pose = machine.body_poses(&Command::default(), &placed)[body];
            let back = pose.linear().transpose();
            let shift = back * (joint.point_mm() - *pose.shift_mm());
            let direction = machine.axes()[axis].direction;
            let turn = direction.cross(&(back * joint.along()));
            let six = [shift.x, shift.y, shift.z, turn.x, turn.y, turn.z];
            for (component, value) in Component::ALL.into_iter().zip(six) {
                let index = ErrorIndex { body, kind: ErrorKind::Location, component };
                placed.set(index, value);
                errors.set(index, value);
            }
        }
    }

    /// With every difference from the nominal turned.
    pub fn negated(&self, nominal: &Self) -> Self {
        let turned = |a: [i64; 3], b: [i64; 3]| std::array::from_fn(|i| 2 * b[i] - a[i]);
        let pairs = self.0.iter().zip(&nominal.0).map(|(a, b)| Joint {
            axis: a.axis,
            point: turned(a.point, b.point),
            direction: turned(a.direction, b.direction),
        });
        Self(pairs.collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use trueaxis_machine::file::NoTables;

    /// A tilt of C moves the A axis that hangs 200 mm below: 100 µrad · 200 mm = 20 µm; what is placed again is
    /// what was stated, but for second order.
    #[test]
    fn points_and_directions_are_the_location_errors() {
        let text = "[machine]\nname = \"m\"\nchain = \"w b X Y Z C A t\"\n\
            [axis.A]\nplacement = \"0 0 -200 mm\"\n[location]\nEB0C = \"100 urad\"\n\
            EX0C = \"5 um\"\nEY0A = \"-7 um\"\nEC0A = \"30 urad\"\nEA0A = \"50 urad\"";
        let machine = Machine::check("m.toml", text, &NoTables).0.unwrap();
        let joints = Joints::actual(&machine);
        let [c, a] = joints.0[..] else { panic!("{joints:?}") };
        assert_eq!((c.point, c.direction), ([5000, 0, 0], [100_000, 0, 999_999_995]));
        assert_eq!(a.point, [5000 - 20_000, -7000, -199_999_999]);
        let mut errors = ErrorValues::default();
        joints.place(&machine, &mut errors);
        for (index, name) in machine.stated_errors() {
            let stated = machine.errors_at(&Command::default(), &[0.0; 6]).unwrap().get(index);
            let stated = if moves_an_axis(&machine, name) { stated } else { 0.0 };
            assert!((errors.get(index) - stated).abs() < 2e-8, "{name}: {}", errors.get(index));
        }
        let back = joints.negated(&Joints::nominal(&machine)).negated(&Joints::nominal(&machine));
        assert_eq!(back, joints);
    }
}
