//! What is to be commanded instead, with what the machine is known to do in its direction of travel.

use super::number::Increments;
use super::ready::Prepared;
use trueaxis_geometry::Vec3;
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{Approach, AxisKind, Command, MAX_AXES};
use trueaxis_machine::compensate::{AxisLimitation, Compensator, Fault as NoCorrection, Scope};
use trueaxis_motion::STILL;
use trueaxis_motion::axis_path::Fault;
use trueaxis_nc::moves::Origin;

/// The largest corrections of the tool that are taken for sound. A rotary axis near a pole may turn
/// by more than the tool axis does.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CorrectionLimit {
    /// Of the tip, mm.
    pub tip_mm: f64,
    /// Of the tool axis, rad.
    pub axis_rad: f64,
}

impl Default for CorrectionLimit {
    /// 1 mm and 1 mrad.
    fn default() -> Self {
        Self { tip_mm: 1.0, axis_rad: 1e-3 }
    }
}

/// A machine with one tool, ready to be corrected.
pub(super) struct Corrector {
    pose: Compensator,
    position: Compensator,
    limit: CorrectionLimit,
    reverses: bool,
    /// Of each axis: less than this is no motion once it is written.
    least: Command,
    /// The side from which each axis came in the program that is written.
    approach: Approach,
}

/// A place that is to be corrected.
#[derive(Debug, Clone, Copy)]
pub(super) struct Place<'p> {
    pub nominal: &'p Command,
    /// From where the axes come to it by the program.
    pub side: Approach,
    /// The place before it as it is written.
    pub from: &'p Command,
    /// From where the axes came to that one.
    pub approach: &'p Approach,
    pub only_position: bool,
    pub origin: Origin,
}

/// One corrected place.
#[derive(Debug, Clone, Copy)]
pub(super) struct Corrected {
    pub command: Command,
    /// Why the tool axis is left, if it is.
    pub left: Option<AxisLimitation>,
    /// An axis reverses by less than its reversal error: no command meets the place.
    pub undecided: bool,
}

impl Corrector {
    /// Of a machine with its tool.
    pub fn of(
        machine: &Machine,
        position_only: bool,
        limit: CorrectionLimit,
        increments: Option<Increments>,
    ) -> Result<Self, NoCorrection> {
        let scope = if position_only { Scope::Position } else { Scope::Pose };
        Ok(Self {
            pose: Compensator::of(machine, scope)?,
            position: Compensator::of(machine, Scope::Position)?,
            limit,
            reverses: reverses(machine),
            least: least_motions(machine, increments),
            approach: Approach::default(),
        })
    }

    /// The same history on the machine with another tool.
    pub fn with_history_of(mut self, other: &Self) -> Self {
        self.approach = other.approach;
        self
    }

    /// The actual machine.
    pub fn machine(&self) -> &Machine {
        self.pose.machine()
    }

    /// The command for a nominal place that is reached from a written one; what was prepared for
    /// it is taken where its axes come from there.
    pub fn at(&self, at: &Place<'_>, prepared: Option<Prepared>) -> Result<Corrected, Fault> {
        let Place { nominal, approach, origin, mut side, .. } = *at;
        let fits = |p: &Prepared| !at.only_position && (!self.reverses || p.side == side);
        if let Some(prepared) = prepared.filter(fits) {
            self.within_limit(prepared.before, origin)?;
            let Prepared { command, left, .. } = prepared;
            let real = turned(approach, at.from, &command, &self.least);
            if !self.reverses || real == side {
                return Ok(Corrected { command, left, undecided: false });
            }
        }
        let compensator = if at.only_position { &self.position } else { &self.pose };
        let mut rounds = 3;
        loop {
            let done = compensator.at(nominal, &side);
            let done = done.map_err(|e| self.refused(nominal, origin, &e))?;
            self.within_limit([done.before.tip_mm, done.before.axis], origin)?;
            let real = turned(approach, at.from, &done.command, &self.least);
            rounds -= 1;
            let undecided = self.reverses && real != side;
            let corrected =
                Corrected { command: done.command, left: done.axis_limitation, undecided };
            if !undecided || rounds == 0 {
                return Ok(corrected);
            }
            side = real;
        }
    }

    /// Whether errors depend on the side from which an axis comes.
    pub fn reverses(&self) -> bool {
        self.reverses
    }

    /// The least motions that count once they are written.
    pub fn least(&self) -> &Command {
        &self.least
    }

    /// From where the axes come after a motion, as it will be written.
    pub fn side_behind(&self, side: &Approach, from: &Command, to: &Command) -> Approach {
        turned(side, from, to, &self.least)
    }

    /// The command in the mean of both sides: the way it goes tells from where each axis comes.
    pub fn mean(&self, nominal: &Command, only_position: bool) -> Command {
        let compensator = if only_position { &self.position } else { &self.pose };
        compensator.at(nominal, &Approach::default()).map_or(*nominal, |done| done.command)
    }

    /// The side from which the axes of the written program came.
    pub fn approach(&self) -> &Approach {
        &self.approach
    }

    /// The written program has moved.
    pub fn moved(&mut self, from: &Command, to: &Command) {
        self.approach = reached(&self.approach, from, to);
    }

    fn within_limit(&self, [tip, axis]: [Vec3; 2], origin: Origin) -> Result<(), Fault> {
        let limit = self.limit;
        let tip = (tip.norm(), limit.tip_mm, "tip", "mm", 1.0);
        let axis = (axis.norm(), limit.axis_rad, "tool axis", "mrad", 1e3);
        for (by, limit, what, unit, scale) in [tip, axis] {
            // NaN is within no limit.
            if by.is_nan() || by > limit {
                let (by, limit) = (by * scale, limit * scale);
                let message = format!(
                    "the {what} would be corrected by {by:.4} {unit}; the limit is {limit} {unit}"
                );
                let hint = "are the errors of the machine file right? else allow more by --limit";
                let code = "correction-too-large";
                return Err(Fault { origin, word: None, code, message, hint });
            }
        }
        Ok(())
    }

    fn refused(&self, nominal: &Command, origin: Origin, fault: &NoCorrection) -> Fault {
        use NoCorrection as F;
        let axes = self.machine().axes().iter().zip(nominal);
        let outside = axes.into_iter().find(|(axis, q)| !axis.travel.contains(**q));
        if let Some((axis, q)) = outside {
            let shown = match axis.kind {
                AxisKind::Linear => format!("{q:.4} mm"),
                AxisKind::Rotary => format!("{:.5} deg", q.to_degrees()),
            };
            let message = format!("without any correction {} would go to {shown}", axis.name);
            let hint = "that is beyond its travel: a work offset (--setup), or another machine?";
            return Fault { origin, word: None, code: "leaves-travel", message, hint };
        }
        let (code, hint) = match fault {
            F::Travel { .. } => (
                "correction-leaves-travel",
                "the corrected place lies beyond the end of the travel: move the part or the path",
            ),
            F::Command(_) | F::Corrected(_) => (
                "unknown-errors",
                "cover the travel by the error table, or say outside = \"clamp\" for it",
            ),
            F::FewLinearAxes { .. } | F::Flat => {
                ("not-correctable", "a machine with three linear axes across each other is needed")
            }
            F::NotConverged { .. } => {
                ("not-converged", "check the error tables of the machine file")
            }
        };
        Fault { origin, word: None, code, message: fault.to_string(), hint }
    }
}

/// Whether an error of the machine depends on the side from which its axis comes.
pub(super) fn reverses(machine: &Machine) -> bool {
    machine.stated_errors().iter().any(|(index, name)| {
        let stated = machine.bodies()[index.body].stated(name.kind, name.component);
        stated.is_some_and(|s| s.reversal.is_some())
    })
}

/// The side after a motion.
pub(super) fn reached(approach: &Approach, from: &Command, to: &Command) -> Approach {
    turned(approach, from, to, &[STILL; MAX_AXES])
}

fn turned(approach: &Approach, from: &Command, to: &Command, least: &Command) -> Approach {
    let mut side = *approach;
    for i in 0..MAX_AXES {
        let by = to[i] - from[i];
        if by.abs() > least[i] {
            side[i] = by.signum();
        }
    }
    side
}

fn least_motions(machine: &Machine, increments: Option<Increments>) -> Command {
    let mut least = [STILL; MAX_AXES];
    for (axis, least) in machine.axes().iter().zip(&mut least) {
        if let Some(increments) = increments {
            *least = match axis.kind {
                AxisKind::Linear => 0.5 * increments.linear_mm,
                AxisKind::Rotary => 0.5 * increments.rotary_deg.to_radians(),
            };
        }
    }
    least
}
