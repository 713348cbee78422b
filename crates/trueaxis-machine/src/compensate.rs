//! The command that brings the *actual* tool to where the programmed one should be.
//!
//! ```text
//!     q programmed ──nominal chain──> pose wanted          r(q) = (tip wanted, axis wanted)
//!     q_c ──chain with errors──> pose reached = pose wanted
//!     q_c ← q_c − J⁻¹·(reached − wanted)                   Newton, docs/model.md eq. 159 and 160
//! ```
//!
//! The errors are those at q_c, not at q, and J is the Jacobian of the machine *with* its errors and
//! their slopes, so that each step squares the residual error: about three evaluations of the chain.
//!
//! The rotary axes take the smallest motion that turns the tool axis back, then the linear axes
//! bring the tip to its place. It knows nothing of NC programs.

mod columns;
mod fault;
mod linear;
mod rotary;
#[cfg(test)]
mod tests;

pub use fault::Fault;

use crate::axis::{Approach, AxisKind, Command, MAX_AXES, Travel};
use crate::chain::{CommandFault, Machine};
use crate::deviation::Deviation;
use crate::errors::{BodyName, ErrorValues};
use columns::Columns;
use linear::Placing;
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

/// Default limit for the motion of a rotary axis, in multiples of the deviation of the tool axis:
/// the tool axis is then at least 0.57° away from the rotary axis that would move.
pub const MOST_SWING: f64 = 100.0;

/// Largest accepted limit: nearer to the pole an angle has too few digits.
const LARGEST_SWING: f64 = 1e6;

/// What of the pose is compensated.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Scope {
    /// Tip and tool axis, with all axes.
    #[default]
    Pose,
    /// The tip alone, with the linear axes; the rotary axes stay where they are programmed.
    Position,
}

/// The reason why (a part of) the deviation of the tool axis is not compensated.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AxisLimitation {
    /// Only the position is compensated ([`Scope::Position`]).
    PositionOnly,
    /// Fewer than two rotary axes cannot turn the tool axis in both directions; none is moved.
    FewRotaryAxes,
    /// The tool axis is (nearly) along this rotary axis, which would have to turn by a multiple of
    /// the error.
    Pole(BodyName),
}

impl fmt::Display for AxisLimitation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::PositionOnly => write!(f, "only the position is compensated"),
            Self::FewRotaryAxes => {
                write!(f, "fewer than two rotary axes cannot correct the tool axis")
            }
            Self::Pole(axis) => write!(
                f,
                "the tool axis is along {axis}, which would have to turn by a multiple of the error"
            ),
        }
    }
}

/// A compensated pose.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CompensatedPose {
    /// The compensated command; axes that are not needed keep their position.
    pub command: Command,
    /// The programmed pose, and the deviation from it at the *programmed* command.
    pub before: Deviation,
    /// The programmed pose, and the residual deviation from it at [`CompensatedPose::command`].
    pub residual: Deviation,
    /// The reason why the tool axis is not (fully) compensated; `None` if it is.
    pub axis_limitation: Option<AxisLimitation>,
    /// Number of evaluations of the chain, the first at the programmed command.
    pub evaluations: u32,
}

/// The compensation of a machine, pose by pose.
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
/// assert!(done.residual.tip_mm.norm() < 1e-9);
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
    residual: Deviation,
}

/// How the tool moves from there.
struct View {
    /// The tip, mm per mm or rad of each axis.
    tip: [Vec3; MAX_AXES],
    /// The tool axis per rad of each rotary axis, while the linear axes hold the tip.
    turning: [Vec3; MAX_AXES],
    placing: Placing,
    /// The tool axis that is wanted.
    axis: Vec3,
    /// What it is missed by once the linear axes have brought the tip to its place.
    missed: Vec3,
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
        self.most_swing = if times >= 1.0 { times.min(LARGEST_SWING) } else { 1.0 };
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
    /// [`CompensatedPose::axis_limitation`] says why it is not.
    ///
    /// # Errors
    /// An axis that would pass its travel, a command outside an error table; see [`Fault`].
    pub fn at(&self, command: &Command, approach: &Approach) -> Result<CompensatedPose, Fault> {
        let errors = self.machine.errors_at(command, approach)?;
        let before = self.machine.deviation(command, &errors);
        let mut now = Trial { command: *command, errors, residual: before };
        let (mut freedom, mut axis_limitation) = self.intent();
        for evaluations in 1..=MOST_EVALUATIONS {
            if self.is_met(&now, &freedom) {
                let (command, residual) = (now.command, now.residual);
                self.within_travel(&command)?;
                let axis_limitation = axis_limitation.filter(|_| residual.axis.norm() > MET_RAD);
                return Ok(CompensatedPose {
                    command,
                    before,
                    residual,
                    axis_limitation,
                    evaluations,
                });
            }
            let view = self.view(&now, approach)?;
            if let (1, Freedom::Both) = (evaluations, &freedom) {
                (freedom, axis_limitation) = self.freedom(&view);
            }
            let next = self.step(&now, &view, &freedom, evaluations == 1);
            now = self.trial(next, approach, &before).map_err(|fault| match fault {
                // Steps that lead to no number lead away.
                Fault::Corrected(CommandFault::NotFinite { .. }) => {
                    not_converged(&now, evaluations)
                }
                other => other,
            })?;
        }
        Err(not_converged(&now, MOST_EVALUATIONS))
    }

    /// How the rotary axes shall serve wherever they can, and why not.
    fn intent(&self) -> (Freedom, Option<AxisLimitation>) {
        match (self.scope, self.rotary.len()) {
            (Scope::Position, _) => (Freedom::None, Some(AxisLimitation::PositionOnly)),
            (Scope::Pose, 0 | 1) => (Freedom::None, Some(AxisLimitation::FewRotaryAxes)),
            (Scope::Pose, _) => (Freedom::Both, None),
        }
    }

    /// How they can here, and why not fully.
    fn freedom(&self, view: &View) -> (Freedom, Option<AxisLimitation>) {
        let turns = Turns::of(&view.turning, &self.rotary, view.axis);
        let (freedom, swinging) = turns.freedom(view.missed, self.most_swing);
        (freedom, swinging.map(|i| AxisLimitation::Pole(self.machine.axes[i].name)))
    }

    /// The Jacobian at a command; the linear axes follow the tip, and turn the tool a little.
    fn view(&self, at: &Trial, approach: &Approach) -> Result<View, Fault> {
        let columns = Columns::of(&self.machine, &at.command, approach, &at.errors);
        let placing = Placing::of(&columns, self.placing)?;
        let mut turning = columns.axis;
        for &i in &self.rotary {
            turning[i] -= placing.turned(&columns, columns.tip[i]);
        }
        let missed = at.residual.axis - placing.turned(&columns, at.residual.tip_mm);
        let axis = at.residual.nominal_axis.vector();
        Ok(View { tip: columns.tip, turning, placing, axis, missed })
    }

    fn is_met(&self, at: &Trial, freedom: &Freedom) -> bool {
        let angle = match freedom {
            Freedom::None => 0.0,
            Freedom::Both => at.residual.axis.norm(),
            Freedom::One { along, .. } => along.dot(&at.residual.axis).abs(),
        };
        // After many turns an angle has fewer digits.
        let largest = self.rotary.iter().fold(0.0_f64, |m, &i| m.max(at.command[i].abs()));
        at.residual.tip_mm.norm() <= MET_MM && angle <= MET_RAD + 4.0 * f64::EPSILON * largest
    }

    /// One step of Newton's method; the first one carries what is done once.
    fn step(&self, at: &Trial, view: &View, freedom: &Freedom, is_first: bool) -> Command {
        let turned = match freedom {
            Freedom::None => Command::default(),
            Freedom::Both => {
                Turns::of(&view.turning, &self.rotary, view.axis).least_motion(view.missed)
            }
            Freedom::One { along, motion, damped } => {
                let per_unit: f64 =
                    self.rotary.iter().map(|&i| along.dot(&view.turning[i]) * motion[i]).sum();
                let by = -along.dot(&view.missed) / per_unit;
                let once = if is_first { 1.0 } else { 0.0 };
                std::array::from_fn(|i| motion[i] * by + once * damped[i])
            }
        };
        let (mut missing, mut next) = (at.residual.tip_mm, at.command);
        for &i in &self.rotary {
            missing += view.tip[i] * turned[i];
            next[i] += turned[i];
        }
        for (i, by) in view.placing.motion(missing) {
            next[i] -= by;
        }
        next
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
        let residual = missed(&here, tip, axis);
        Ok(Trial { command, errors, residual })
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

fn not_converged(at: &Trial, evaluations: u32) -> Fault {
    Fault::NotConverged { evaluations, tip_mm: at.residual.tip_mm.norm() }
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
