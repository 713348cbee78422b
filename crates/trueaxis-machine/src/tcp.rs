//! Tool-centre-point control: what the control computes again and again while a program runs.
//!
//! ```text
//!     tip wanted, rotary axes given ──place──> linear axes      linear equations
//!     tool axis wanted ──aim──> rotary axes                     the branch and turn nearest to now
//! ```
//!
//! The same answers as [`Machine::solve`], for one pose after the other, without memory from the
//! heap in `place`.

use crate::Machine;
use crate::axis::{AxisKind, Command};
use crate::chain::Link;
use crate::inverse::{Aim, RESOLUTION_RAD, Serial, SolveError, turns};
use trueaxis_geometry::frame::{Direction, Workpiece};
use trueaxis_geometry::{Mat3, Vec3};

/// Below this volume the three linear axes do not span the space: 1 mm of the tip would cost more
/// than 1 m of an axis.
const FLAT: f64 = 1e-3;

/// A nominal machine made ready to follow tool tips; in the workpiece frame of the machine.
///
/// # Example
/// ```
/// use trueaxis_geometry::Vec3;
/// use trueaxis_machine::{Machine, file::NoTables, tcp::TipControl};
/// let text = "[machine]\nname = \"gantry\"\nchain = \"w b X Y Z C A t\"\n\
///             [tool]\nlength = \"100 mm\"";
/// let machine = Machine::check("gantry.toml", text, &NoTables).0.expect("a machine");
/// let control = TipControl::of(&machine).expect("three linear axes");
///
/// // The tool leans by 30° (A) and its tip shall be at the origin: the pivot stands 100 mm up
/// // the tool, so Y = −50 mm and Z = 86.6 mm.
/// let mut command = [0.0, 0.0, 0.0, 0.0, 30_f64.to_radians(), 0.0];
/// assert!(control.place(Vec3::zeros(), &mut command));
/// assert!((command[1] + 50.0).abs() < 1e-9 && (command[2] - 86.602540378).abs() < 1e-9);
/// ```
#[derive(Debug, Clone)]
pub struct TipControl {
    machine: Machine,
    serial: Serial,
    /// From the workpiece to the tool: what stands fixed before each joint, and behind the last.
    steps: Vec<Step>,
    /// The linear axes that place the tip: X Y Z before U V W.
    placing: [usize; 3],
    tip_mm: Vec3,
    aim: Aim,
    /// More than two rotary axes: the aim depends on those that are held.
    redundant: bool,
}

/// A fixed step of the chain and the joint behind it.
#[derive(Debug, Clone)]
struct Step {
    shift_mm: Vec3,
    /// `None` if nothing is turned.
    turn: Option<Mat3>,
    joint: Option<(AxisKind, Vec3)>,
}

impl Step {
    fn of(link: &Link, joint: Option<(AxisKind, Vec3)>) -> Self {
        let turn = Some(*link.linear()).filter(|turn| *turn != Mat3::identity());
        Self { shift_mm: *link.shift_mm(), turn, joint }
    }
}

impl TipControl {
    /// `None` if the machine has fewer than three linear axes.
    pub fn of(machine: &Machine) -> Option<Self> {
        let serial = Serial::of(machine);
        let mut linear: Vec<usize> = serial.linear().collect();
        linear.sort_by_key(|&i| !matches!(machine.axes()[i].name.letter(), 'X' | 'Y' | 'Z'));
        let placing = [*linear.first()?, *linear.get(1)?, *linear.get(2)?];
        // The sense goes into the direction: along −d is +d, about −d is the other way round.
        let joints = serial.joints.iter().map(|j| Some((j.kind, j.direction * j.sense)));
        let joints = joints.chain([None]);
        let steps = serial.fixed.iter().zip(joints).map(|(link, joint)| Step::of(link, joint));
        Some(Self {
            steps: steps.collect(),
            placing,
            tip_mm: machine.tip_mm(),
            aim: Aim::of(&serial, &Command::default()),
            redundant: serial.rotary().count() > 2,
            serial,
            machine: machine.clone(),
        })
    }

    /// The nominal machine.
    pub fn machine(&self) -> &Machine {
        &self.machine
    }

    /// Tip (mm) and tool axis (unit vector) at a command.
    pub fn tip_and_axis(&self, command: &Command) -> (Vec3, Vec3) {
        let mut vectors = [self.tip_mm, Vec3::z()];
        for (i, step) in self.steps.iter().enumerate().rev() {
            match step.joint {
                Some((AxisKind::Rotary, about)) => turn_all(about, command[i], &mut vectors),
                Some((AxisKind::Linear, along)) => vectors[0] += along * command[i],
                None => {}
            }
            step.place(&mut vectors);
        }
        (vectors[0], vectors[1].normalize())
    }

    /// Sets the linear axes so that the tip is at `tip_mm` while all other axes of the command
    /// stay; `false`, and nothing set, where the linear axes do not reach it.
    ///
    /// ```text
    ///     tip = tip(q = 0) + q1·d1 + q2·d2 + q3·d3       docs/model.md eq. 16
    /// ```
    pub fn place(&self, tip_mm: Vec3, command: &mut Command) -> bool {
        let mut vectors = [self.tip_mm, Vec3::zeros(), Vec3::zeros(), Vec3::zeros()];
        for (i, step) in self.steps.iter().enumerate().rev() {
            match step.joint {
                Some((AxisKind::Rotary, about)) => turn_all(about, command[i], &mut vectors),
                Some((AxisKind::Linear, along)) => {
                    match self.placing.iter().position(|&axis| axis == i) {
                        Some(column) => vectors[1 + column] = along,
                        None => vectors[0] += along * command[i],
                    }
                }
                None => {}
            }
            step.place(&mut vectors);
        }
        let [at_zero, d1, d2, d3] = vectors;
        let missing = tip_mm - at_zero;
        let across = d2.cross(&d3);
        let volume = d1.dot(&across);
        if volume.is_nan() || volume.abs() <= FLAT {
            return false;
        }
        let solved = [
            missing.dot(&across) / volume,
            missing.dot(&d3.cross(&d1)) / volume,
            missing.dot(&d1.cross(&d2)) / volume,
        ];
        let finite = solved.iter().all(|q| q.is_finite());
        if finite {
            for (axis, q) in self.placing.into_iter().zip(solved) {
                command[axis] = q + 0.0; // −0 is 0
            }
        }
        finite
    }

    /// The command with its rotary axes turned so that the tool stands along `axis`; the linear
    /// axes stay as they are. Of all branches and turns within the travel the one nearest to
    /// `from` comes first; an axis that turns about the tool axis keeps its angle.
    ///
    /// # Errors
    /// [`SolveError::Unreachable`] and [`SolveError::NotFinite`], as [`Machine::solve`].
    pub fn aim(
        &self,
        axis: Direction<Workpiece>,
        from: &Command,
    ) -> Result<Vec<Aimed>, SolveError> {
        let u = axis.vector();
        if !u.iter().chain(from).all(|v| v.is_finite()) {
            return Err(SolveError::NotFinite);
        }
        let held;
        let aim = match self.redundant {
            true => {
                held = Aim::of(&self.serial, from);
                &held
            }
            false => &self.aim,
        };
        let aimed = aim.at(u).map_err(|missed| {
            let turning = aim.turning.iter().map(|t| self.machine.axes()[t.axis].name).collect();
            let closest = Direction::of(missed.closest).unwrap_or(Direction::Z);
            SolveError::Unreachable { closest, missed_by_rad: missed.by_rad, turning }
        })?;
        let commands = aimed.angles.iter().map(|angles| {
            let mut command = *from;
            for (turn, angle) in aim.turning.iter().zip(angles) {
                if let Some(angle) = angle {
                    let principal = turns::principal(turn.sense * angle);
                    command[turn.axis] = self.nearest_inside(turn.axis, principal, from);
                }
            }
            command
        });
        let ordered = turns::in_order(&self.machine, commands.collect(), from);
        let rotary = |c: &Command| self.serial.rotary().all(|i| self.inside(i, c[i]));
        let entry = |s: crate::Solution| Aimed {
            command: s.command,
            within_travel: rotary(&s.command),
            idle: aimed.first_is_idle,
        };
        let mut entries: Vec<Aimed> = ordered.into_iter().map(entry).collect();
        // The linear axes do not count here: they are not placed yet.
        entries.sort_by_key(|e| !e.within_travel);
        Ok(entries)
    }

    fn inside(&self, axis: usize, q: f64) -> bool {
        self.machine.axes()[axis].travel.contains(q)
    }

    /// The turn of an angle nearest to where the axis is, within the travel if any is.
    fn nearest_inside(&self, axis: usize, q: f64, from: &Command) -> f64 {
        let near = turns::nearest(q, from[axis]);
        if self.inside(axis, near) {
            return near;
        }
        let travel = self.machine.axes()[axis].travel;
        let mut all = turns::others(travel, q, from[axis]);
        all.push(q);
        all.retain(|&q| travel.contains(q));
        let distance = |q: &f64| (q - from[axis]).abs();
        all.into_iter().min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap_or(near)
    }

    /// The direction of the rotary axis that turns first, seen from the workpiece: where the tool
    /// stands along it or against it, that axis has no effect. `None` with fewer than two rotary
    /// axes.
    pub fn pole(&self) -> Option<Direction<Workpiece>> {
        let [first, _, ..] = self.aim.turning[..] else { return None };
        let frames = self.serial.frames(&Command::default());
        Direction::of(self.serial.axis_in(&frames, first.axis))
    }

    /// How far a command is from a pole: the sine of the angle between the tool axis and the
    /// rotary axis that turns first, seen from the workpiece; 1 with fewer than two rotary axes.
    pub fn pole_sine(&self, command: &Command) -> f64 {
        let [first, _, ..] = self.aim.turning[..] else { return 1.0 };
        let frames = self.serial.frames(command);
        self.serial.axis_in(&frames, first.axis).cross(&frames.tool_axis()).norm()
    }
}

/// One way to stand along a direction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Aimed {
    /// The axis positions; linear ones as before.
    pub command: Command,
    /// Whether the rotary axes stay within their travel.
    pub within_travel: bool,
    /// A rotary axis turns about the tool axis here, and has kept its angle.
    pub idle: bool,
}

/// Below this the tool axis counts as a pole, in rad.
pub const POLE_RAD: f64 = RESOLUTION_RAD;

impl Step {
    /// Through the fixed step: the first vector is a place, the others are directions.
    fn place<const N: usize>(&self, vectors: &mut [Vec3; N]) {
        if let Some(turn) = &self.turn {
            vectors.iter_mut().for_each(|v| *v = turn * *v);
        }
        vectors[0] += self.shift_mm;
    }
}

/// Turns vectors about a unit vector (Rodrigues).
fn turn_all<const N: usize>(about: Vec3, angle_rad: f64, vectors: &mut [Vec3; N]) {
    let (sin, cos) = angle_rad.sin_cos();
    for v in vectors {
        *v = *v * cos + about.cross(v) * sin + about * (about.dot(v) * (1.0 - cos));
    }
}
