//! What is to be commanded instead, with what the machine is known to do in its direction of travel.

use crate::simulate::axis_path::Fault;
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{Approach, AxisKind, Command, MAX_AXES};
use trueaxis_machine::compensate::{AxisLeft, Compensator, Scope};
use trueaxis_nc::moves::Origin;

/// A motion smaller than this has no direction: mm and rad.
const STILL: f64 = 1e-13;

/// The largest corrections that are taken for sound.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CorrectionLimit {
    /// Of linear axes, mm.
    pub linear_mm: f64,
    /// Of rotary axes, rad.
    pub rotary_rad: f64,
}

impl Default for CorrectionLimit {
    /// 1 mm and 1 mrad.
    fn default() -> Self {
        Self { linear_mm: 1.0, rotary_rad: 1e-3 }
    }
}

/// A machine with one tool, ready to be corrected.
pub(super) struct Corrector {
    pose: Compensator,
    position: Compensator,
    limit: CorrectionLimit,
    reverses: bool,
    /// The side from which each axis came in the program that is written.
    approach: Approach,
}

/// One corrected place.
#[derive(Debug, Clone, Copy)]
pub(super) struct Corrected {
    pub command: Command,
    /// Why the tool axis is left, if it is.
    pub left: Option<AxisLeft>,
    /// An axis turns round by less than its reversal error: no command meets the place.
    pub undecided: bool,
}

impl Corrector {
    /// Of a machine with its tool.
    pub fn of(
        machine: &Machine,
        position_only: bool,
        limit: CorrectionLimit,
    ) -> Result<Self, trueaxis_machine::compensate::Fault> {
        let scope = if position_only { Scope::Position } else { Scope::Pose };
        let reverses = machine.stated_errors().iter().any(|(index, name)| {
            let stated = machine.bodies()[index.body].stated(name.kind, name.component);
            stated.is_some_and(|s| s.reversal.is_some())
        });
        Ok(Self {
            pose: Compensator::of(machine, scope)?,
            position: Compensator::of(machine, Scope::Position)?,
            limit,
            reverses,
            approach: Approach::default(),
        })
    }

    /// The same history on the machine with another tool.
    pub fn with_history_of(mut self, other: &Self) -> Self {
        self.approach = other.approach;
        self
    }

    /// The machine as it is.
    pub fn machine(&self) -> &Machine {
        self.pose.machine()
    }

    /// The command for a nominal place that is reached from a written one.
    pub fn at(
        &self,
        nominal: &Command,
        (from, approach): (&Command, &Approach),
        only_position: bool,
        origin: Origin,
    ) -> Result<Corrected, Fault> {
        let compensator = if only_position { &self.position } else { &self.pose };
        let mut side = reached(approach, from, nominal);
        let mut rounds = 3;
        loop {
            let done = compensator.at(nominal, &side).map_err(|e| refused(origin, &e))?;
            self.within_limit(nominal, &done.command, origin)?;
            let real = reached(approach, from, &done.command);
            rounds -= 1;
            let undecided = self.reverses && real != side;
            let corrected = Corrected { command: done.command, left: done.axis_left, undecided };
            if !undecided || rounds == 0 {
                return Ok(corrected);
            }
            side = real;
        }
    }

    /// The side after a motion of the written program.
    pub fn reached(&self, approach: &Approach, from: &Command, to: &Command) -> Approach {
        reached(approach, from, to)
    }

    /// The side from which the axes of the written program came.
    pub fn approach(&self) -> &Approach {
        &self.approach
    }

    /// The written program has moved.
    pub fn moved(&mut self, from: &Command, to: &Command) {
        self.approach = reached(&self.approach, from, to);
    }

    fn within_limit(
        &self,
        nominal: &Command,
        command: &Command,
        origin: Origin,
    ) -> Result<(), Fault> {
        for (i, axis) in self.machine().axes().iter().enumerate() {
            let by = command[i] - nominal[i];
            let (limit, scale, unit) = match axis.kind {
                AxisKind::Linear => (self.limit.linear_mm, 1.0, "mm"),
                AxisKind::Rotary => (self.limit.rotary_rad, 1e3, "mrad"),
            };
            if by.is_nan() || by.abs() > limit {
                let (by, limit) = (by * scale, limit * scale);
                let message = format!(
                    "{} would be corrected by {by:.4} {unit}; the limit is {limit} {unit}",
                    axis.name
                );
                let hint = "are the errors of the machine file right? else allow more by --limit";
                let code = "correction-too-large";
                return Err(Fault { origin, word: None, code, message, hint });
            }
        }
        Ok(())
    }
}

fn reached(approach: &Approach, from: &Command, to: &Command) -> Approach {
    let mut side = *approach;
    for i in 0..MAX_AXES {
        let by = to[i] - from[i];
        if by.abs() > STILL {
            side[i] = by.signum();
        }
    }
    side
}

fn refused(origin: Origin, fault: &trueaxis_machine::compensate::Fault) -> Fault {
    use trueaxis_machine::compensate::Fault as F;
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
        F::NotConverged { .. } => ("not-converged", "check the error tables of the machine file"),
    };
    Fault { origin, word: None, code, message: fault.to_string(), hint }
}
