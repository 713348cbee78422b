//! Tool-centre-point control: the transformation that a control computes in every cycle.
//!
//! ```text
//!     required tip, rotary axes given ──place──> linear axes      linear equations
//!     required tool axis ──aim──> rotary axes                   the branch and turn nearest to the present
//! ```
//!
//! The same results as [`Machine::solve`], for one pose after the other; `place` allocates nothing.

use crate::Machine;
use crate::axis::Command;
use crate::inverse::{DirectionSolver, Placer, RESOLUTION_RAD, Serial, SolveError, turns};
use trueaxis_geometry::Vec3;
use trueaxis_geometry::frame::{Direction, Workpiece};

/// The tool-centre-point control of a nominal machine; poses are in its workpiece frame, mm.
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
    placer: Placer,
    aim: DirectionSolver,
    /// More than two rotary axes: the aim depends on those that are held.
    redundant: bool,
}

impl TipControl {
    /// `None` if the machine has fewer than three linear axes.
    pub fn of(machine: &Machine) -> Option<Self> {
        let serial = Serial::of(machine);
        Some(Self {
            placer: Placer::of(machine, &serial)?,
            aim: DirectionSolver::of(&serial, &Command::default()),
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
        self.placer.tip_and_axis(command)
    }

    /// Sets the linear axes so that the tip is at `tip_mm` while all other axes of the command
    /// stay; `false`, and nothing set, where the linear axes do not reach it.
    ///
    /// ```text
    ///     tip = tip(q = 0) + q1·d1 + q2·d2 + q3·d3       docs/model.md eq. 16
    /// ```
    pub fn place(&self, tip_mm: Vec3, command: &mut Command) -> bool {
        self.placer.place(tip_mm, command)
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
    ) -> Result<Vec<DirectionSolution>, SolveError> {
        let (one, other) = self.branches(axis, from)?;
        let idle = one.idle;
        let commands = [Some(one), other].into_iter().flatten().map(|b| b.command).collect();
        let ordered = turns::in_order(&self.machine, commands, from);
        let rotary = |c: &Command| self.serial.rotary().all(|i| self.inside(i, c[i]));
        let entry = |s: crate::Solution| DirectionSolution {
            command: s.command,
            within_travel: rotary(&s.command),
            idle,
        };
        let mut entries: Vec<DirectionSolution> = ordered.into_iter().map(entry).collect();
        // The linear axes do not count here: they are not placed yet.
        entries.sort_by_key(|e| !e.within_travel);
        Ok(entries)
    }

    /// The first of [`TipControl::aim`], the one nearest to `from`, without allocation.
    ///
    /// # Errors
    /// As [`TipControl::aim`].
    pub fn aim_nearest(
        &self,
        axis: Direction<Workpiece>,
        from: &Command,
    ) -> Result<DirectionSolution, SolveError> {
        let (one, other) = self.branches(axis, from)?;
        Ok(match other {
            None => one,
            // Solutions inside the travel of the rotary axes come first, then the shorter motion.
            Some(other) if one.within_travel != other.within_travel => {
                if one.within_travel {
                    one
                } else {
                    other
                }
            }
            Some(other) => {
                match turns::is_nearer(&self.machine, &other.command, &one.command, from) {
                    true => other,
                    false => one,
                }
            }
        })
    }

    /// The branches in the turns nearest to `from`; two, or one where both meet.
    fn branches(
        &self,
        axis: Direction<Workpiece>,
        from: &Command,
    ) -> Result<(DirectionSolution, Option<DirectionSolution>), SolveError> {
        let u = axis.vector();
        if !u.iter().chain(from).all(|v| v.is_finite()) {
            return Err(SolveError::NotFinite);
        }
        let held;
        let aim = match self.redundant {
            true => {
                held = DirectionSolver::of(&self.serial, from);
                &held
            }
            false => &self.aim,
        };
        let aimed = aim.at(u).map_err(|missed| {
            let turning = aim.turning.iter().map(|t| self.machine.axes()[t.axis].name).collect();
            let closest = Direction::of(missed.closest).unwrap_or(Direction::Z);
            SolveError::Unreachable { closest, missed_by_rad: missed.by_rad, turning }
        })?;
        let idle = aimed.first_is_idle;
        let entry = |angles: [Option<f64>; 2]| {
            let mut command = *from;
            for (turn, angle) in aim.turning.iter().zip(angles) {
                if let Some(angle) = angle {
                    let principal = turns::principal(turn.sense * angle);
                    command[turn.axis] = self.nearest_inside(turn.axis, principal, from);
                }
            }
            let within_travel = self.serial.rotary().all(|i| self.inside(i, command[i]));
            DirectionSolution { command, within_travel, idle }
        };
        Ok((entry(aimed.one), aimed.other.map(entry)))
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
        let own = Some(q).filter(|&q| travel.contains(q));
        let all = turns::others(travel, q, from[axis]).chain(own);
        let distance = |q: &f64| (q - from[axis]).abs();
        all.min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap_or(near)
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

/// A position of the rotary axes for a required direction of the tool.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DirectionSolution {
    /// The axis positions; linear ones as before.
    pub command: Command,
    /// Whether the rotary axes stay within their travel.
    pub within_travel: bool,
    /// A rotary axis turns about the tool axis here, and has kept its angle.
    pub idle: bool,
}

/// Below this the tool axis counts as a pole, in rad.
pub const POLE_RAD: f64 = RESOLUTION_RAD;
