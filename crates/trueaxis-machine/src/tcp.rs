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
use crate::inverse::turns::RotaryPair;
use crate::inverse::{
    Aim, ClosedForm, DirectionSolver, Placer, RESOLUTION_RAD, Serial, SolveError, turns,
};
use crate::lanes::Plain;
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
    /// The same in closed form, where there is one.
    closed: Option<ClosedForm>,
    aim: DirectionSolver,
    /// The same in closed form, where exactly two axes aim and none is held.
    two_axes: Option<TwoAxes>,
    /// More than two rotary axes: the aim depends on those that are held.
    redundant: bool,
}

impl TipControl {
    /// `None` if the machine has fewer than three linear axes.
    pub fn of(machine: &Machine) -> Option<Self> {
        let serial = Serial::of(machine);
        let placer = Placer::of(machine, &serial)?;
        let aim = DirectionSolver::of(&serial, &Command::default());
        let redundant = serial.rotary().count() > 2;
        Some(Self {
            closed: ClosedForm::of(machine, &serial, placer.placing),
            two_axes: Aim::of(&aim)
                .filter(|_| !redundant)
                .map(|aim| TwoAxes { pair: RotaryPair::of(machine, aim.axes), aim }),
            placer,
            aim,
            redundant,
            serial,
            machine: machine.clone(),
        })
    }

    pub(crate) fn closed_form(&self) -> Option<&ClosedForm> {
        self.closed.as_ref()
    }

    pub(crate) fn two_axes(&self) -> Option<&Aim> {
        self.two_axes.as_ref().map(|two| &two.aim)
    }

    /// The nominal machine.
    pub fn machine(&self) -> &Machine {
        &self.machine
    }

    /// Tip (mm) and tool axis (unit vector) at a command.
    pub fn tip_and_axis(&self, command: &Command) -> (Vec3, Vec3) {
        let Some(form) = self.closed.as_ref().filter(|form| form.holds_for(command)) else {
            return self.placer.tip_and_axis(command);
        };
        let q = command.map(|q| Plain([q]));
        form.tool(&q, &form.sines(&q)).map(vector).into()
    }

    /// Sets the linear axes so that the tip is at `tip_mm` while all other axes of the command
    /// stay; `false`, and nothing set, where the linear axes do not reach it.
    ///
    /// ```text
    ///     tip = tip(q = 0) + q1·d1 + q2·d2 + q3·d3       docs/model.md eq. 16
    /// ```
    pub fn place(&self, tip_mm: Vec3, command: &mut Command) -> bool {
        let Some(form) = self.closed.as_ref().filter(|form| form.holds_for(command)) else {
            return self.placer.place(tip_mm, command);
        };
        let q = command.map(|q| Plain([q]));
        let tip = [tip_mm.x, tip_mm.y, tip_mm.z].map(|x| Plain([x]));
        let placed = form.place(tip, &q, &form.sines(&q));
        let is_finite = placed.iter().all(|q| q.0[0].is_finite());
        if is_finite {
            for (axis, q) in form.placing.into_iter().zip(placed) {
                command[axis] = q.0[0] + 0.0; // −0 is 0
            }
        }
        is_finite
    }

    /// Why a tip was not reached.
    pub(crate) fn flat(&self) -> SolveError {
        let moving = self.serial.linear().map(|i| self.machine.axes()[i].name).collect();
        SolveError::TipUnreachable { missed_by_mm: f64::NAN, moving }
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
        match self.decided(axis.vector(), from) {
            Some((two, branches)) => Ok(two.nearer(branches, from)),
            None => Ok(self.nearer(self.branches_by_scalar(axis.vector(), from)?, from)),
        }
    }

    /// The command goes to the nearest one for a direction whose branches may be known: two angles of one, two of the other.
    pub(crate) fn aim_with(
        &self,
        axis: Vec3,
        known: Option<[f64; 4]>,
        command: &mut Command,
    ) -> Result<(), SolveError> {
        if let (Some([a1, b1, a2, b2]), Some(two)) = (known, &self.two_axes) {
            let (q, _) = two.pair.nearer([[a1, b1], [a2, b2]], command);
            for (axis, q) in two.pair.axes.into_iter().zip(q) {
                command[axis] = q;
            }
            return Ok(());
        }
        *command = self.nearer(self.branches_by_scalar(axis, command)?, command).command;
        Ok(())
    }

    fn nearer(
        &self,
        (one, other): (DirectionSolution, Option<DirectionSolution>),
        from: &Command,
    ) -> DirectionSolution {
        match other {
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
        }
    }

    /// The branches in the turns nearest to `from`; two, or one where both meet.
    fn branches(
        &self,
        axis: Direction<Workpiece>,
        from: &Command,
    ) -> Result<(DirectionSolution, Option<DirectionSolution>), SolveError> {
        let Some((two, branches)) = self.decided(axis.vector(), from) else {
            return self.branches_by_scalar(axis.vector(), from);
        };
        let [one, other] =
            branches.map(|angles| self.entry(two.aim.axes.into_iter().zip(angles), from));
        Ok((one, Some(other)))
    }

    /// The angles of both branches where the closed form decides.
    fn decided(&self, u: Vec3, from: &Command) -> Option<(&TwoAxes, [[f64; 2]; 2])> {
        let two = self.two_axes.as_ref()?;
        let is_finite = u.iter().chain(from).all(|v| v.is_finite());
        Some((two, two.branches(u).filter(|_| is_finite)?))
    }

    /// The same at poles and where branches meet, too.
    fn branches_by_scalar(
        &self,
        u: Vec3,
        from: &Command,
    ) -> Result<(DirectionSolution, Option<DirectionSolution>), SolveError> {
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
            let turns = aim.turning.iter().zip(angles);
            let turned = turns.filter_map(|(turn, q)| Some((turn.axis, turn.sense * q?)));
            DirectionSolution { idle, ..self.entry(turned, from) }
        };
        Ok((entry(aimed.one), aimed.other.map(entry)))
    }

    /// A branch with its angles in the turns nearest to where the axes are.
    fn entry(
        &self,
        angles: impl Iterator<Item = (usize, f64)>,
        from: &Command,
    ) -> DirectionSolution {
        let mut command = *from;
        for (axis, angle) in angles {
            let travel = self.machine.axes()[axis].travel;
            command[axis] = turns::nearest_inside(travel, turns::principal(angle), from[axis]);
        }
        let within_travel = self.serial.rotary().all(|i| self.inside(i, command[i]));
        DirectionSolution { command, within_travel, idle: false }
    }

    fn inside(&self, axis: usize, q: f64) -> bool {
        self.machine.axes()[axis].travel.contains(q)
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

/// The two rotary axes of a machine that has no others, ready to aim.
#[derive(Debug, Clone)]
struct TwoAxes {
    aim: Aim,
    pair: RotaryPair,
}

impl TwoAxes {
    /// The angles of both branches; `None` where the scalar form has to decide.
    fn branches(&self, u: Vec3) -> Option<[[f64; 2]; 2]> {
        let (both, undecided) = self.aim.branches([u.x, u.y, u.z].map(|x| Plain([x])));
        (undecided == 0).then(|| both.map(|angles| angles.map(|q| q.0[0])))
    }

    fn nearer(&self, branches: [[f64; 2]; 2], from: &Command) -> DirectionSolution {
        let (q, within_travel) = self.pair.nearer(branches, from);
        let mut command = *from;
        for (axis, q) in self.pair.axes.into_iter().zip(q) {
            command[axis] = q;
        }
        DirectionSolution { command, within_travel, idle: false }
    }
}

fn vector(v: [Plain<1>; 3]) -> Vec3 {
    Vec3::from(v.map(|x| x.0[0]))
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
