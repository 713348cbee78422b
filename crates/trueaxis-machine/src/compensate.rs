//! The command that brings the *actual* tool to where the programmed one should be.
//!
//! ```text
//!     q programmed ──nominal chain──> pose wanted          r(q) = (tip wanted, axis wanted)
//!     q_c ──chain with errors──> pose reached = pose wanted
//!     q_c ← q_c − J⁻¹·(reached − wanted)                   Newton, docs/model.md eq. 159 and 160
//! ```
//!
//! The errors are those at q_c, not at q, and J is the Jacobian of the machine *with* its errors and
//! their slopes, so that each step squares what is left: about three evaluations of the chain.
//!
//! The rotary axes take the smallest motion that turns the tool axis back, then the linear axes
//! bring the tip to its place. It knows nothing of NC programs.

mod columns;
mod rotary;
#[cfg(test)]
mod tests;

use crate::axis::{Approach, AxisKind, Command, Travel};
use crate::chain::{CommandFault, Machine};
use crate::deviation::Deviation;
use crate::errors::{BodyName, ErrorValues};
use columns::Columns;
use rotary::{Freedom, Turns};
use std::fmt;
use trueaxis_geometry::Vec3;
use trueaxis_geometry::frame::{Direction, Point, Workpiece};

/// The tip is met within this, mm: some ten times the rounding of a chain of 10 m.
pub(crate) const MET_MM: f64 = 1e-10;

/// The tool axis is met within this, rad: some hundred times the rounding of a chain.
pub(crate) const MET_RAD: f64 = 1e-13;

/// Evaluations of the chain after which a pose is given up; three are usual.
const MOST_EVALUATIONS: u32 = 12;

/// Below this volume the three linear axes do not span the space: 1 mm of the tip would cost more
/// than 1 m of an axis.
pub(crate) const FLAT: f64 = 1e-3;

/// No rotary axis moves by more than so many times the deviation of the tool axis, unless told
/// otherwise: the tool axis is then at least 0.57° away from the rotary axis that would swing.
pub const MOST_SWING: f64 = 100.0;

/// What of the pose is compensated.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Scope {
    /// Tip and tool axis, with all axes.
    #[default]
    Pose,
    /// The tip alone, with the linear axes; the rotary axes stay where they are programmed.
    Position,
}

/// Why the tool axis keeps (a part of) its deviation.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AxisLeft {
    /// [`Scope::Position`] asks for it.
    PositionOnly,
    /// Fewer than two rotary axes cannot turn the tool axis in both directions; none is moved.
    FewRotaryAxes,
    /// The tool axis is (nearly) along this rotary axis, which would have to swing far beyond the
    /// size of the error.
    Pole(BodyName),
}

impl fmt::Display for AxisLeft {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::PositionOnly => write!(f, "only the position is compensated"),
            Self::FewRotaryAxes => {
                write!(f, "fewer than two rotary axes cannot correct the tool axis")
            }
            Self::Pole(axis) => write!(
                f,
                "the tool axis is along {axis}, which would swing far beyond the size of the error"
            ),
        }
    }
}

/// A compensated pose.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Compensated {
    /// The command to give to the machine; axes that are not needed keep theirs.
    pub command: Command,
    /// The programmed pose, and what the machine misses it by at the *programmed* command.
    pub before: Deviation,
    /// The programmed pose, and what the machine misses it by at [`Compensated::command`].
    pub left: Deviation,
    /// Why the tool axis is not (fully) corrected; `None` if it is.
    pub axis_left: Option<AxisLeft>,
    /// How often the chain was evaluated, the first time at the programmed command.
    pub evaluations: u32,
}

/// Why a machine cannot be compensated, or a pose.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum Fault {
    /// The machine cannot move its tip in all three directions.
    #[error(
        "{linear} linear axes cannot bring the tip to its place in space; three are needed: name \
         them in the chain of the machine file"
    )]
    FewLinearAxes {
        /// How many it has.
        linear: usize,
    },
    /// There are no errors at the command.
    #[error("{0}")]
    Command(#[from] CommandFault),
    /// The compensated command lies where an error table says nothing.
    #[error(
        "at the compensated command {0}: measure the errors up to the ends of the travel, or let the \
         table be extended (outside = \"extend\")"
    )]
    Corrected(CommandFault),
    /// An axis would pass the end of its travel.
    #[error("{}", travel_passed(.axis, .at, .by))]
    Travel {
        /// The axis.
        axis: BodyName,
        /// Where it would have to go, mm or rad.
        at: f64,
        /// By how much that passes the end of the travel, mm or rad.
        by: f64,
    },
    /// The linear axes do not span the space at this pose.
    #[error("at this pose the linear axes do not move the tip in all three directions")]
    Flat,
    /// The errors are no small change of the machine.
    #[error(
        "after {evaluations} evaluations the tip is still {tip_mm:.6} mm off: the errors change too \
         steeply with the position; check the error tables"
    )]
    NotConverged {
        /// How often the chain was evaluated.
        evaluations: u32,
        /// What is left, mm.
        tip_mm: f64,
    },
}

fn travel_passed(axis: &BodyName, at: &f64, by: &f64) -> String {
    let (scale, unit) = match axis.is_rotary() {
        true => (180.0 / std::f64::consts::PI, "deg"),
        false => (1.0, "mm"),
    };
    let (at, by) = (at * scale, by * scale);
    format!(
        "{axis} would have to go to {at:.6} {unit}, {by:.6} {unit} beyond the end of its travel: move \
         the part or shorten the path"
    )
}

/// A machine made ready to be compensated, pose by pose.
///
/// # Example
/// ```
/// use trueaxis_machine::compensate::{Compensator, Scope};
/// use trueaxis_machine::{Machine, file::NoTables};
/// let text = "[machine]\nname = \"mill\"\nchain = \"w b X Y Z t\"\n\
///             [location]\nEC0Y = \"10 urad\"";
/// let machine = Machine::check("mill.toml", text, &NoTables).0.expect("a machine");
///
/// // Y leans by 10 µrad towards −x: at Y = 500 mm the tool stands 0.005 mm too far in −x, and X
/// // goes to +0.005. The cosine shortens Y by 500 mm · (10 µrad)²/2 = 25 pm.
/// let compensator = Compensator::of(&machine, Scope::Pose)?;
/// let done = compensator.at(&[0.0, 500.0, 0.0, 0.0, 0.0, 0.0], &[0.0; 6])?;
/// assert!((done.before.tip_mm.x + 0.005).abs() < 1e-9);
/// assert!((done.command[0] - 0.005).abs() < 1e-9);
/// assert!((done.command[1] - 500.0).abs() < 1e-7);
/// assert!(done.left.tip_mm.norm() < 1e-9);
/// # Ok::<(), trueaxis_machine::compensate::Fault>(())
/// ```
#[derive(Debug, Clone)]
pub struct Compensator {
    machine: Machine,
    scope: Scope,
    most_swing: f64,
    /// The linear axes that place the tip: X Y Z before U V W.
    placing: [usize; 3],
    rotary: Vec<usize>,
}

/// A command on its way, and what the machine misses the programmed pose by there.
struct Trial {
    command: Command,
    errors: ErrorValues,
    left: Deviation,
}

impl Compensator {
    /// Of a machine with its present tip, workpiece and temperatures.
    ///
    /// # Errors
    /// A machine with fewer than three linear axes.
    pub fn of(machine: &Machine, scope: Scope) -> Result<Self, Fault> {
        let of_kind = |kind| {
            let axes = machine.axes.iter().enumerate();
            axes.filter(move |(_, a)| a.kind == kind).map(|(i, _)| i).collect::<Vec<_>>()
        };
        let mut linear = of_kind(AxisKind::Linear);
        linear.sort_by_key(|&i| !matches!(machine.axes[i].name.letter(), 'X' | 'Y' | 'Z'));
        let [x, y, z, ..] = linear[..] else {
            return Err(Fault::FewLinearAxes { linear: linear.len() });
        };
        Ok(Self {
            machine: machine.clone(),
            scope,
            most_swing: MOST_SWING,
            placing: [x, y, z],
            rotary: of_kind(AxisKind::Rotary),
        })
    }

    /// The same where the rotary axes may move by so many times the deviation of the tool axis.
    #[must_use]
    pub fn swinging_at_most(mut self, times: f64) -> Self {
        self.most_swing = times.max(1.0);
        self
    }

    /// The machine that is compensated.
    pub fn machine(&self) -> &Machine {
        &self.machine
    }

    /// What is compensated.
    pub fn scope(&self) -> Scope {
        self.scope
    }

    pub(crate) fn most_swing(&self) -> f64 {
        self.most_swing
    }

    pub(crate) fn placing(&self) -> [usize; 3] {
        self.placing
    }

    pub(crate) fn rotary(&self) -> &[usize] {
        &self.rotary
    }

    /// The command at which the actual tool stands where the nominal one stands at `command`.
    ///
    /// `approach` says from which side each axis reaches its position (a correction of micrometres
    /// does not change that). The tip is exact to 1e-10 mm, the tool axis to 1e-13 unless
    /// [`Compensated::axis_left`] says why it is not.
    ///
    /// # Errors
    /// An axis that would pass its travel, a command outside an error table; see [`Fault`].
    pub fn at(&self, command: &Command, approach: &Approach) -> Result<Compensated, Fault> {
        let errors = self.machine.errors_at(command, approach)?;
        let before = self.machine.deviation(command, &errors);
        let mut now = Trial { command: *command, errors, left: before };
        let mut columns = Columns::of(&self.machine, command, approach, &now.errors);
        let (freedom, axis_left) = self.freedom(&now, &columns);
        for evaluations in 1..=MOST_EVALUATIONS {
            if self.is_met(&now, &freedom) {
                let (command, left) = (now.command, now.left);
                self.within_travel(&command)?;
                let axis_left = axis_left.filter(|_| left.axis.norm() > MET_RAD);
                return Ok(Compensated { command, before, left, axis_left, evaluations });
            }
            if evaluations > 1 {
                columns = Columns::of(&self.machine, &now.command, approach, &now.errors);
            }
            let next = self.step(&now, &columns, &freedom, evaluations == 1)?;
            now = self.trial(next, approach, &before)?;
        }
        let tip_mm = now.left.tip_mm.norm();
        Err(Fault::NotConverged { evaluations: MOST_EVALUATIONS, tip_mm })
    }

    /// How the rotary axes serve, and why not fully.
    fn freedom(&self, at: &Trial, columns: &Columns) -> (Freedom, Option<AxisLeft>) {
        if self.scope == Scope::Position {
            return (Freedom::None, Some(AxisLeft::PositionOnly));
        }
        if self.rotary.len() < 2 {
            return (Freedom::None, Some(AxisLeft::FewRotaryAxes));
        }
        let turns = Turns::of(columns, &self.rotary, at.left.nominal_axis.vector());
        let (freedom, swinging) = turns.freedom(at.left.axis, self.most_swing);
        (freedom, swinging.map(|i| AxisLeft::Pole(self.machine.axes[i].name)))
    }

    fn is_met(&self, at: &Trial, freedom: &Freedom) -> bool {
        let angle = match freedom {
            Freedom::None => 0.0,
            Freedom::Both => at.left.axis.norm(),
            Freedom::One { along, .. } => along.dot(&at.left.axis).abs(),
        };
        // After many turns an angle has fewer digits.
        let largest = self.rotary.iter().fold(0.0_f64, |m, &i| m.max(at.command[i].abs()));
        at.left.tip_mm.norm() <= MET_MM && angle <= MET_RAD + 4.0 * f64::EPSILON * largest
    }

    /// One step of Newton's method; the first one carries what is done once.
    fn step(
        &self,
        at: &Trial,
        columns: &Columns,
        freedom: &Freedom,
        is_first: bool,
    ) -> Result<Command, Fault> {
        let left = &at.left;
        let turned = match freedom {
            Freedom::None => Command::default(),
            Freedom::Both => {
                let axis = left.nominal_axis.vector();
                Turns::of(columns, &self.rotary, axis).least_motion(left.axis)
            }
            Freedom::One { along, motion, damped } => {
                let per_unit: f64 =
                    self.rotary.iter().map(|&i| along.dot(&columns.axis[i]) * motion[i]).sum();
                let by = -along.dot(&left.axis) / per_unit;
                let once = if is_first { 1.0 } else { 0.0 };
                std::array::from_fn(|i| motion[i] * by + once * damped[i])
            }
        };
        let mut missing = left.tip_mm;
        let mut next = at.command;
        for &i in &self.rotary {
            missing += columns.tip[i] * turned[i];
            next[i] += turned[i];
        }
        let [d1, d2, d3] = self.placing.map(|i| columns.tip[i]);
        let across = [d2.cross(&d3), d3.cross(&d1), d1.cross(&d2)];
        let volume = d1.dot(&across[0]);
        if volume.is_nan() || volume.abs() <= FLAT {
            return Err(Fault::Flat);
        }
        for (i, normal) in self.placing.into_iter().zip(across) {
            next[i] -= missing.dot(&normal) / volume;
        }
        Ok(next)
    }

    /// The chain at a corrected command.
    fn trial(
        &self,
        command: Command,
        approach: &Approach,
        wanted: &Deviation,
    ) -> Result<Trial, Fault> {
        let errors = self.machine.errors_at(&command, approach).map_err(|fault| {
            // What lies beyond the travel is named as that.
            self.within_travel(&command).err().unwrap_or(Fault::Corrected(fault))
        })?;
        let here = self.machine.deviation(&command, &errors);
        let (tip, axis) = (wanted.nominal_tip, wanted.nominal_axis);
        let left = missed(&here, tip, axis);
        Ok(Trial { command, errors, left })
    }

    fn within_travel(&self, command: &Command) -> Result<(), Fault> {
        for (axis, &at) in self.machine.axes.iter().zip(command) {
            if let (false, Travel::Between(from, to)) = (axis.travel.contains(at), axis.travel) {
                let by = (from - at).max(at - to);
                return Err(Fault::Travel { axis: axis.name, at, by });
            }
        }
        Ok(())
    }
}

/// Reached minus wanted pose.
fn missed(
    here: &Deviation,
    nominal_tip: Point<Workpiece>,
    nominal_axis: Direction<Workpiece>,
) -> Deviation {
    let tip_mm: Vec3 = (here.nominal_tip - nominal_tip) + here.tip_mm;
    let axis = (here.nominal_axis.vector() - nominal_axis.vector()) + here.axis;
    Deviation { nominal_tip, nominal_axis, tip_mm, axis }
}
