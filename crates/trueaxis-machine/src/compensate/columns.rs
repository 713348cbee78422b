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

/// A point (place 1) and a direction (place 0) that travel together.
type Pair = [(Vec3, f64); 2];

fn through(link: &Link, pair: Pair) -> Pair {
    pair.map(|(v, place)| (link.linear() * v + link.shift_mm() * place, place))
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
        let slope = |i: usize, pair: Pair| {
            link_slope(machine, i, command, &errors.bodies[i], &slopes[i], pair)
        };

        // The points carried by each body, from the tip to the workpiece; then back with their rotations.
        let mut carried = [[(Vec3::zeros(), 0.0); 2]; MAX_BODIES];
        let mut pair = [(machine.tip_mm, 1.0), (Vec3::z(), 0.0)];
        for i in (side..count).rev() {
            carried[i] = pair;
            pair = through(&links[i], pair);
        }
        pair = through(&workpiece_from_bed, pair);
        let (axis, mut columns) =
            (pair[1].0, Self { tip: [Vec3::zeros(); MAX_AXES], axis: [Vec3::zeros(); MAX_AXES] });
        for i in 0..side {
            carried[i] = pair;
            pair = through(&links[i], pair);
        }
        let mut put = |i: usize, turn: Mat3| {
            if let Some(k) = machine.bodies[i].axis {
                let [tip, direction] = slope(i, carried[i]);
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
    pair: Pair,
) -> [Vec3; 2] {
    let (body, model) = (&machine.bodies[i], machine.model);
    let Some(index) = body.axis else { return [Vec3::zeros(); 2] };
    let (axis, q) = (&machine.axes[index], command[index]);
    let turn = |six: &SixErrors| Mat3::identity() + six.rotation_minus_identity(model.rotation);
    let per_unit = axis.direction * axis.sense;
    // What the steps to the right carry, and its slope; `None` as long as nothing has moved.
    let mut carried = through(&body.mounting, pair);
    let mut slope: Option<[Vec3; 2]> = None;
    let mut placed = *body.placement.linear();
    for step in machine.steps(i).iter().rev() {
        match (step, axis.kind) {
            // Constant, and the last before the placement.
            (Step::Location, _) => placed *= turn(&errors.location),
            (Step::Motion, _) => {
                let turning = errors.motion.rotation_slope(slopes, model.rotation);
                let mut grown = carried.map(|(v, place)| slopes.shift_mm() * place + turning * v);
                // A straight motion has the same slope wherever the errors put what it carries.
                if axis.kind == AxisKind::Rotary {
                    let error = Link::new(turn(&errors.motion), errors.motion.shift_mm());
                    grown = sum(grown, slope.map(|s| s.map(|v| error.linear() * v)));
                    carried = through(&error, carried);
                }
                slope = Some(grown);
            }
            (Step::Joint, AxisKind::Rotary) => {
                let motion = nominal_motion(axis, q);
                carried = through(&motion, carried);
                let turned = carried.map(|(v, _)| per_unit.cross(&v));
                slope = Some(sum(turned, slope.map(|s| s.map(|v| motion.linear() * v))));
            }
            (Step::Joint, AxisKind::Linear) => {
                slope = Some(sum(carried.map(|(_, place)| per_unit * place), slope));
            }
            (Step::TiltedJoint, _) => {
                let along = turn(&errors.location) * per_unit;
                slope = Some(sum(carried.map(|(_, place)| along * place), slope));
            }
        }
    }
    slope.map_or([Vec3::zeros(); 2], |slope| slope.map(|v| placed * v))
}

fn sum(a: [Vec3; 2], b: Option<[Vec3; 2]>) -> [Vec3; 2] {
    b.map_or(a, |b| [a[0] + b[0], a[1] + b[1]])
}
