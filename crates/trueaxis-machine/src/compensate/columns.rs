//! How the actual tool moves when an axis moves: the Jacobian of the machine with its errors.

use crate::axis::{Approach, AxisKind, Command, MAX_AXES};
use crate::chain::{ErrorFrame, Link, Machine, Squareness, nominal_motion};
use crate::errors::{BodyErrors, ErrorKind, ErrorValues, MAX_BODIES, Six};
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

        // What each body carries, from the tip to the workpiece; then back again with what turns it.
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
fn error_slopes(machine: &Machine, command: &Command, approach: &Approach) -> [Six; MAX_BODIES] {
    let mut slopes = [Six::default(); MAX_BODIES];
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

/// d(link · v)/dq of a point and a direction; the cases are those of [`Machine::link`].
fn link_slope(
    machine: &Machine,
    i: usize,
    command: &Command,
    errors: &BodyErrors,
    slopes: &Six,
    pair: Pair,
) -> [Vec3; 2] {
    let (body, model) = (&machine.bodies[i], machine.model);
    let Some(index) = body.axis else { return [Vec3::zeros(); 2] };
    let (axis, q) = (&machine.axes[index], command[index]);
    let turn = |six: &Six| Mat3::identity() + six.rotation_minus_identity(model.rotation);
    let turn_slope = errors.motion.rotation_slope(slopes, model.rotation);
    let error_slope = |v: Vec3, place: f64| slopes.shift_mm() * place + turn_slope * v;
    let per_unit = axis.direction * axis.sense;
    let location = turn(&errors.location);
    let placed = body.placement.linear() * location;
    let pair = through(&body.mounting, pair);
    match (axis.kind, body.error_frame) {
        (AxisKind::Linear, _) if model.squareness == Squareness::Direction => {
            let along = location * per_unit;
            pair.map(|(v, place)| body.placement.linear() * (along * place + error_slope(v, place)))
        }
        (AxisKind::Linear, _) => {
            pair.map(|(v, place)| placed * (per_unit * place + error_slope(v, place)))
        }
        (AxisKind::Rotary, ErrorFrame::Fixed) => {
            let (motion, error) = (*nominal_motion(axis, q).linear(), turn(&errors.motion));
            pair.map(|(v, place)| {
                let turned = motion * v;
                placed * (error_slope(turned, place) + error * per_unit.cross(&turned))
            })
        }
        (AxisKind::Rotary, ErrorFrame::Moving) => {
            let (motion, error) = (*nominal_motion(axis, q).linear(), turn(&errors.motion));
            pair.map(|(v, place)| {
                let turned = motion * (error * v + errors.motion.shift_mm() * place);
                placed * (per_unit.cross(&turned) + motion * error_slope(v, place))
            })
        }
    }
}
