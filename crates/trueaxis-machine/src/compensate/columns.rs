//! How the actual tool moves when an axis moves: the Jacobian of the machine with its errors.

use crate::axis::{Approach, AxisKind, Command, MAX_AXES};
use crate::chain::{Link, Machine, Step, nominal_motion};
use crate::errors::{BodyErrors, ErrorKind, ErrorValues, MAX_BODIES, SixErrors};
use trueaxis_geometry::{Mat3, Vec3};

/// One column per axis, in the workpiece frame, per mm or rad of its command.
pub(super) struct Columns {
    /// Of the tip, mm.
    pub tip: [Vec3; MAX_AXES],
    /// Of the unit vector of the tool axis.
    pub axis: [Vec3; MAX_AXES],
}

/// The tip and the tool axis, which travel together.
#[derive(Clone, Copy, Default)]
struct Carried {
    /// A point, mm: shifts move it.
    tip: Vec3,
    /// A direction: only turns change it.
    axis: Vec3,
}

/// The slope of both.
type Slope = [Vec3; 2];

impl Carried {
    fn through(self, link: &Link) -> Self {
        Self { tip: link.linear() * self.tip + link.shift_mm(), axis: link.linear() * self.axis }
    }

    fn turned(self, turn: &Mat3) -> Slope {
        [turn * self.tip, turn * self.axis]
    }
}

impl Columns {
    /// The derivative of [`Machine::pose`] by each command (docs/model.md eq. 159).
    pub fn of(
        machine: &Machine,
        command: &Command,
        approach: &Approach,
        errors: &ErrorValues,
    ) -> Self {
        let slopes = error_slopes(machine, command, approach);
        let count = machine.bodies.len();
        let link = |i: usize| match i < count {
            true => machine.link(i, command, &errors.bodies[i]),
            false => Link::identity(),
        };
        let links: [Link; MAX_BODIES] = std::array::from_fn(link);
        let side = machine.workpiece_side;
        let bed_from_workpiece = links[..side].iter().fold(Link::identity(), |acc, l| *l * acc);
        let workpiece_from_bed = bed_from_workpiece.inverse();
        let back = *workpiece_from_bed.linear();

        // What each body carries, from the tip to the workpiece; then back with the rotations.
        let mut carried = [Carried::default(); MAX_BODIES];
        let mut tool = Carried { tip: machine.tip_mm, axis: Vec3::z() };
        for i in (side..count).rev() {
            carried[i] = tool;
            tool = tool.through(&links[i]);
        }
        tool = tool.through(&workpiece_from_bed);
        let axis = tool.axis;
        for i in 0..side {
            carried[i] = tool;
            tool = tool.through(&links[i]);
        }
        let mut columns = Self { tip: [Vec3::zeros(); MAX_AXES], axis: [Vec3::zeros(); MAX_AXES] };
        let mut put = |i: usize, turn: Mat3| {
            if let Some(k) = machine.bodies[i].axis {
                let errors = &errors.bodies[i];
                let [tip, direction] =
                    link_slope(machine, i, command, errors, &slopes[i], carried[i]);
                (columns.tip[k], columns.axis[k]) = (turn * tip, turn * direction);
            }
        };
        let mut turn = back;
        for (i, link) in links.iter().enumerate().take(count).skip(side) {
            put(i, turn);
            turn *= link.linear();
        }
        turn = -back;
        for (i, link) in links.iter().enumerate().take(side).rev() {
            put(i, turn);
            turn *= link.linear();
        }
        columns.finish(machine, command, axis);
        columns
    }

    /// The tool axis is a unit vector, and a warm workpiece has grown.
    fn finish(&mut self, machine: &Machine, command: &Command, axis: Vec3) {
        let (length, unit) = (axis.norm(), axis.normalize());
        for column in &mut self.axis {
            *column = (*column - unit * unit.dot(column)) / length;
        }
        if let Some(growth) = &machine.growth {
            let tip = machine.nominal_tip_mm(command);
            let grown = growth.at(tip);
            for column in &mut self.tip {
                *column -= growth.at(tip + *column) - grown;
            }
        }
    }
}

/// The slopes of the error motions of each body.
fn error_slopes(
    machine: &Machine,
    command: &Command,
    approach: &Approach,
) -> [SixErrors; MAX_BODIES] {
    let mut slopes = [SixErrors::default(); MAX_BODIES];
    for (body, out) in machine.bodies.iter().zip(&mut slopes) {
        let Some(axis) = body.axis else { continue };
        let (q, side) = (command[axis], approach[axis]);
        for (slope, stated) in out.0.iter_mut().zip(&body.motion) {
            *slope = stated.as_ref().map_or(0.0, |error| error.slope_at(q, side));
        }
        for term in body.thermal.iter().filter(|t| t.kind == ErrorKind::Motion) {
            out.0[term.component as usize] += term.curve.slope_at(q);
        }
    }
    slopes
}

/// d(link · v)/dq of a point and a direction: the product rule through the steps of the link, from
/// the right to the left.
fn link_slope(
    machine: &Machine,
    i: usize,
    command: &Command,
    errors: &BodyErrors,
    slopes: &SixErrors,
    carried: Carried,
) -> Slope {
    let (body, model) = (&machine.bodies[i], machine.model);
    let Some(index) = body.axis else { return [Vec3::zeros(); 2] };
    let (axis, q) = (&machine.axes[index], command[index]);
    let turn = |six: &SixErrors| Mat3::identity() + six.rotation_minus_identity(model.rotation);
    let per_unit = axis.direction * axis.sense;
    // What the steps to the right carry, and its slope; `None` as long as nothing has moved.
    let mut carried = carried.through(&body.mounting);
    let mut slope: Option<Slope> = None;
    let mut placed = *body.placement.linear();
    for step in machine.steps(i).iter().rev() {
        match (step, axis.kind) {
            // Constant, and the last before the placement.
            (Step::Location, _) => placed *= turn(&errors.location),
            (Step::Motion, _) => {
                let turning = errors.motion.rotation_slope(slopes, model.rotation);
                let [tip, axis_slope] = carried.turned(&turning);
                let mut grown = [slopes.shift_mm() + tip, axis_slope];
                // A straight motion has the same slope wherever the errors put what it carries.
                if axis.kind == AxisKind::Rotary {
                    let error = Link::new(turn(&errors.motion), errors.motion.shift_mm());
                    grown = sum(grown, slope.map(|s| s.map(|v| error.linear() * v)));
                    carried = carried.through(&error);
                }
                slope = Some(grown);
            }
            (Step::Joint, AxisKind::Rotary) => {
                let motion = nominal_motion(axis, q);
                carried = carried.through(&motion);
                let turned = [per_unit.cross(&carried.tip), per_unit.cross(&carried.axis)];
                slope = Some(sum(turned, slope.map(|s| s.map(|v| motion.linear() * v))));
            }
            (Step::Joint, AxisKind::Linear) => {
                slope = Some(shifted(per_unit, slope));
            }
            (Step::TiltedJoint, _) => {
                let along = turn(&errors.location) * per_unit;
                slope = Some(shifted(along, slope));
            }
        }
    }
    slope.map_or([Vec3::zeros(); 2], |slope| slope.map(|v| placed * v))
}

fn sum(a: Slope, b: Option<Slope>) -> Slope {
    b.map_or(a, |b| [a[0] + b[0], a[1] + b[1]])
}

/// A shift along a direction moves the tip and leaves the tool axis.
fn shifted(along: Vec3, slope: Option<Slope>) -> Slope {
    let [tip, axis] = slope.unwrap_or_default();
    [along + tip, axis]
}
