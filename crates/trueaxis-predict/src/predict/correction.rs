//! The smallest single correction of a location error that makes a failing part pass.

use super::Error;
use super::judge::Judge;
use super::sensitivity::{propagate, shifted};
use trueaxis_machine::Machine;
use trueaxis_machine::errors::{Component, ErrorIndex, ErrorKind, ErrorName};

/// The search ends here: a finished machine is not scraped by a millimetre or a milliradian.
const LIMIT: f64 = 1.0;
/// First trial, µm or µrad over 1000.
const FIRST: f64 = 1e-4;
/// Each trial is this much larger than the last.
const GROWTH: f64 = 1.2;
/// The same where only the uncertainty has changed.
const STEP: f64 = 1.02;

/// "Shim EA0A by 85 µrad": a change of one location error that brings every index in tolerance.
#[derive(Debug, Clone, PartialEq)]
pub struct Correction {
    /// What to correct.
    pub error: ErrorName,
    /// By how much its value must change. Unit: mm or rad.
    pub change: f64,
    /// All indices after the change, mm.
    pub indices_mm: Vec<f64>,
}

impl Correction {
    /// The size that corrections are compared by: µm, and µrad as µm per metre.
    pub fn effort(&self) -> f64 {
        let per_unit = if self.error.component.is_rotation() { 1e6 } else { 1e3 };
        self.change.abs() * per_unit
    }

    /// The same correction, larger by steps of 2 % until the part passes with the uncertainties that
    /// it has then; none if that takes more than anybody corrects.
    ///
    /// # Errors
    /// As [`Judge::indices`].
    pub(super) fn enough(
        mut self,
        machine: &Machine,
        judge: &Judge<'_>,
        passes: &dyn Fn(&[f64], &[f64]) -> bool,
    ) -> Result<Option<Self>, Error> {
        let ErrorName { kind, component, .. } = self.error;
        let Some(body) = machine.bodies().iter().position(|b| b.name == self.error.body) else {
            return Ok(None);
        };
        let index = ErrorIndex { body, kind, component };
        while self.effort() <= 1e3 * LIMIT {
            let by = self.change;
            let u_mm = propagate(machine, &|change| {
                judge.once(&|values, u| {
                    let mut changed = change(values, u);
                    changed.set(index, changed.get(index) + by);
                    changed
                })
            })?;
            if passes(&self.indices_mm, &u_mm) {
                return Ok(Some(self));
            }
            self.change *= STEP;
            self.indices_mm = shifted(judge, index, self.change)?;
        }
        Ok(None)
    }
}

/// Every location error that can do it alone, the smallest change first.
///
/// `passes` judges the indices. In both directions the change grows by steps of 20 % from 0.1 µm
/// (or µrad) to 1 mm (or mrad) until the part passes; bisection then finds the edge.
///
/// # Errors
/// As [`Judge::indices`].
pub fn corrections(
    machine: &Machine,
    judge: &Judge<'_>,
    passes: &(dyn Fn(&[f64]) -> bool + Sync),
) -> Result<Vec<Correction>, Error> {
    let mut found = Vec::new();
    for (body, b) in machine.bodies().iter().enumerate() {
        for component in Component::ALL {
            let kind = ErrorKind::Location;
            let index = ErrorIndex { body, kind, component };
            let error = ErrorName { body: b.name, kind, component };
            if let Some((change, indices_mm)) = smallest_change(judge, index, passes)? {
                found.push(Correction { error, change, indices_mm });
            }
        }
    }
    found.sort_by(|a, b| a.effort().total_cmp(&b.effort()));
    Ok(found)
}

fn smallest_change(
    judge: &Judge<'_>,
    index: ErrorIndex,
    passes: &(dyn Fn(&[f64]) -> bool + Sync),
) -> Result<Option<(f64, Vec<f64>)>, Error> {
    // mm for shifts; a rotation of as many µrad as the shift has µm.
    let unit = if index.component.is_rotation() { 1e-3 } else { 1.0 };
    let mut failing = 0.0;
    let mut trial = FIRST;
    while trial <= LIMIT {
        let mut smallest: Option<f64> = None;
        for sign in [1.0, -1.0] {
            if passes(&shifted(judge, index, sign * trial * unit)?) {
                let change = edge(judge, (index, sign * unit), (failing, trial), passes)?;
                if smallest.is_none_or(|other| change.abs() < other.abs()) {
                    smallest = Some(change);
                }
            }
        }
        if let Some(change) = smallest {
            return Ok(Some((change, shifted(judge, index, change)?)));
        }
        failing = trial;
        trial *= GROWTH;
    }
    Ok(None)
}

/// The smallest passing change between a failing and a passing one.
fn edge(
    judge: &Judge<'_>,
    (index, unit): (ErrorIndex, f64),
    (mut failing, mut passing): (f64, f64),
    passes: &(dyn Fn(&[f64]) -> bool + Sync),
) -> Result<f64, Error> {
    // A thousandth of the change is far finer than anybody shims.
    while passing - failing > 1e-3 * passing {
        let middle = 0.5 * (failing + passing);
        if passes(&shifted(judge, index, middle * unit)?) {
            passing = middle;
        } else {
            failing = middle;
        }
    }
    Ok(passing * unit)
}
