//! What if: the same study with other errors, another zero, another tool, other temperatures.

use super::{Setting, Study};
use trueaxis_geometry::Vec3;
use trueaxis_input::{Diagnostics, Place};
use trueaxis_machine::Machine;
use trueaxis_machine::axis::AxisKind;
use trueaxis_machine::errors::{ErrorName, StatedError};
use trueaxis_machine::heat::Conditions;

/// What is larger than this is a slip of the pen.
const MOST_TIMES: f64 = 1000.0;
/// mm or rad.
const MOST_ADDED: f64 = 10.0;

/// One error, changed: `factor · E(q) + add`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ErrorChange {
    /// Which error.
    pub name: ErrorName,
    /// 0 switches it off, −1 turns its sign. Unit: 1.
    pub factor: f64,
    /// This is added to it. Unit: mm or rad.
    pub add: f64,
}

/// What is different; the default changes nothing.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct WhatIf {
    /// Errors of the machine.
    pub errors: Vec<ErrorChange>,
    /// Positions of rotary axes (their letter, rad) when the part zero is touched; others stay.
    pub setting_rad: Vec<(String, f64)>,
    /// Length of the tool from the holder to the tip, mm.
    pub tool_length_mm: Option<f64>,
    /// What the sensors say.
    pub conditions: Option<Conditions>,
}

impl WhatIf {
    /// The study with the changes in it; what cannot be changed goes to `problems`.
    pub fn put(&self, study: Study, problems: &mut Diagnostics) -> Option<Study> {
        let Study { machine, mut reference, .. } = study;
        let machine = self.errors.iter().try_fold(machine, |machine, change| {
            changed(machine, change).map_err(|why| refuse(problems, &change.name.to_string(), why))
        });
        let mut machine = machine.ok()?;
        if let Some(length_mm) = self.tool_length_mm {
            if !(length_mm.is_finite() && length_mm >= 0.0) {
                refuse(problems, "tool length", format!("{length_mm} mm is no length of a tool"));
                return None;
            }
            machine = machine.with_tip(Vec3::new(0.0, 0.0, -length_mm));
        }
        if let Some(conditions) = &self.conditions {
            machine = machine.at(conditions, problems)?;
            if machine.unknown_growth(conditions).is_some() {
                let why = "the workpiece grows, and none of its temperatures is given".to_owned();
                refuse(problems, "temperatures", why);
                return None;
            }
        }
        for (letter, angle_rad) in &self.setting_rad {
            let Some(axis) = rotary(&machine, letter).filter(|_| angle_rad.is_finite()) else {
                let why =
                    format!("the machine has no rotary axis `{letter}` to set to {angle_rad}");
                refuse(problems, "setting", why);
                return None;
            };
            let Setting::Touched { rotary } = &mut reference.setting else { continue };
            rotary[axis] = *angle_rad;
        }
        Some(Study { machine, reference, ..study })
    }
}

fn refuse(problems: &mut Diagnostics, what: &str, why: String) {
    let hint = "name errors and rotary axes of this machine, with finite numbers";
    problems.error("no-such-change", Place::whole(what), why, hint);
}

fn rotary(machine: &Machine, letter: &str) -> Option<usize> {
    let named = |a: &trueaxis_machine::axis::Axis| {
        a.kind == AxisKind::Rotary && a.name.to_string() == letter
    };
    machine.axes().iter().position(named)
}

/// An error that is not stated is zero, so that only what is added counts.
fn changed(machine: Machine, change: &ErrorChange) -> Result<Machine, String> {
    let ErrorChange { name, factor, add } = *change;
    // Also what is no number.
    if !(factor.abs() <= MOST_TIMES && add.abs() <= MOST_ADDED) {
        return Err(format!(
            "{factor} times {name} plus {add} is no error of a machine: at most {MOST_TIMES} times, plus \
             {MOST_ADDED} mm or rad"
        ));
    }
    let Some(index) = machine.error_index(name) else {
        return Err(format!("the chain {} has no body for {name}", machine.chain_text()));
    };
    let stated = machine.bodies()[index.body].stated(name.kind, name.component);
    let stated = match stated {
        Some(stated) => stated.changed(factor, add),
        None => StatedError::constant(add, None),
    };
    Ok(machine.with_error(index, Some(stated)))
}
