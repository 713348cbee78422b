//! The frames between program and machine: where basic coordinates lie, and which of several
//! poses is taken.

use super::setup::SetUp;
use trueaxis_geometry::angle;
use trueaxis_geometry::frame::{Direction, Pose, Workpiece};
use trueaxis_geometry::{Mat3, Vec3};
use trueaxis_machine::axis::{AxisKind, Command};
use trueaxis_machine::errors::ErrorValues;
use trueaxis_machine::tcp::{DirectionSolution, TipControl};
use trueaxis_machine::{Machine, SolveError};
use trueaxis_nc::moves::{Axis, Branch, Frame, Position};

/// The axis of the machine for each axis that a program can name.
pub(super) fn axes_of_programs(machine: &Machine) -> [Option<usize>; 9] {
    let of = |letter: char| machine.axes().iter().position(|a| a.name.letter() == letter);
    Axis::ALL.map(|axis| of(char::from(axis.letter())))
}

/// The pose along a direction that is nearest to the present one.
pub(super) fn nearest(
    control: &TipControl,
    direction: Direction<Workpiece>,
    now: &Command,
) -> Result<Command, SolveError> {
    nearest_to(control, direction, (now, control.tip_and_axis(now).1))
}

/// The same where the tool axis there is known.
pub(super) fn nearest_to(
    control: &TipControl,
    direction: Direction<Workpiece>,
    (now, axis): (&Command, Vec3),
) -> Result<Command, SolveError> {
    // Rounding of a direction that is held must not turn an axis at a pole.
    if angle(&axis, &direction.vector()) < trueaxis_machine::tcp::POLE_RAD {
        return Ok(*now);
    }
    Ok(control.aim_nearest(direction, now)?.command)
}

/// The pose of an alignment: by the sign of the rotary axis that tilts the tool.
pub(super) fn choose(machine: &Machine, aimed: &[DirectionSolution], branch: Branch) -> Command {
    // The tilting axis is the one next to the tool of a head, next to the bed of a table.
    let rotary =
        || (0..machine.axes().len()).filter(|i| machine.axes()[*i].kind == AxisKind::Rotary);
    let tilting = rotary().nth(1).or(rotary().next());
    let fits = |c: &Command| match (branch, tilting) {
        (Branch::Nearest, _) | (_, None) => true,
        (Branch::Positive, Some(axis)) => c[axis] >= 0.0,
        (Branch::Negative, Some(axis)) => c[axis] <= 0.0,
    };
    let mut inside = aimed.iter().filter(|a| a.within_travel).map(|a| a.command);
    inside.find(fits).unwrap_or(aimed[0].command)
}

/// The place of basic coordinates in the workpiece: where the gauge point of the spindle is
/// when the linear axes do and all rotary axes are at zero.
pub(super) fn workpiece_from_basic(machine: &Machine) -> (Mat3, Vec3) {
    let Some(control) = TipControl::of(&machine.clone().with_tip(Vec3::zeros())) else {
        return (Mat3::identity(), Vec3::zeros());
    };
    let axis_of = axes_of_programs(machine);
    let at = |i: usize, q: f64| {
        let mut command = Command::default();
        if let Some(axis) = axis_of[i] {
            command[axis] = q;
        }
        control.tip_and_axis(&command).0
    };
    // The distance is long so that the offsets of the machine do not cost digits of the direction.
    const FAR_MM: f64 = 1_048_576.0;
    let columns = [0, 1, 2].map(|i| (at(i, FAR_MM) - at(i, -FAR_MM)) / (2.0 * FAR_MM));
    let turn = Mat3::from_columns(&columns);
    // Without X, Y and Z basic coordinates do not determine the workpiece.
    match turn.determinant().abs() > 1e-3 {
        true => (turn, at(0, 0.0)),
        false => (Mat3::identity(), Vec3::zeros()),
    }
}

/// Where the axes are before the program: as the set-up states, else at zero or the end of the
/// travel next to it.
pub(super) fn start(machine: &Machine, setup: &SetUp) -> Command {
    let axis_of = axes_of_programs(machine);
    let mut command = machine.nearest_in_travel(&Command::default());
    if let Some(start) = &setup.start {
        for axis in Axis::ALL {
            if let Some(index) = axis_of[axis as usize] {
                let value = start[axis];
                command[index] = if axis.is_rotary() { value.to_radians() } else { value };
            }
        }
    }
    command
}

/// A, B and C in degrees at which the tool points along a direction of the basic frame; what the
/// interpreter needs for Q120 to Q122 and similar parameters.
pub(super) fn rotary_angles(
    control: &TipControl,
    direction: [f64; 3],
    branch: Branch,
    now: &Position,
) -> Option<[f64; 3]> {
    let machine = control.machine();
    let axis_of = axes_of_programs(machine);
    let index = |axis: Axis| axis_of[axis as usize];
    let mut from = Command::default();
    let rotary = [Axis::A, Axis::B, Axis::C];
    for axis in rotary {
        if let Some(i) = index(axis) {
            from[i] = now[axis].to_radians();
        }
    }
    let aimed = control.aim(Direction::of(direction.into())?, &from).ok()?;
    let chosen = choose(machine, &aimed, branch);
    Some(rotary.map(|axis| index(axis).map_or(0.0, |i| chosen[i].to_degrees())))
}

/// How the tool is turned at A, B and C in degrees against its attitude at zero, in the workpiece frame.
pub(super) fn tool_turn(control: &TipControl, angles_deg: [f64; 3]) -> Mat3 {
    let machine = control.machine();
    let axis_of = axes_of_programs(machine);
    let mut there = Command::default();
    for (axis, angle) in [Axis::A, Axis::B, Axis::C].into_iter().zip(angles_deg) {
        if let Some(i) = axis_of[axis as usize] {
            there[i] = angle.to_radians();
        }
    }
    let none = ErrorValues::default();
    let attitude = |command| *machine.pose(command, &none).linear();
    attitude(&there) * attitude(&Command::default()).transpose()
}

/// The machine with its workpiece frame at a program zero.
pub(super) fn mount(machine: &Machine, frame: &Frame) -> Machine {
    let (turn, shift) = workpiece_from_basic(machine);
    let zero = Vec3::new(frame.shift.0[0], frame.shift.0[1], frame.shift.0[2]);
    let linear = Mat3::from_fn(|i, j| frame.linear[i][j]);
    let there = Pose::new(turn * linear, turn * zero + shift);
    // The workpiece is the first body of the chain; what is fixed on it is its mounting.
    let body = &machine.bodies()[0];
    machine.clone().with_workpiece(body.placement, body.mounting * there)
}

/// From directions of the basic frame to those of the workpiece frame.
pub(super) fn turn_to_workpiece(machine: &Machine, setup: &SetUp) -> Mat3 {
    match setup.given {
        true => workpiece_from_basic(machine).0,
        false => Mat3::identity(),
    }
}
