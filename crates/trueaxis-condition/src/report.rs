//! A circle as errors of the machine file: as sections of a report and for programs.

use crate::ball_bar::{Compared, MachineErrors, Written};
use serde::Serialize;
use trueaxis_report::JsonSchema;
use trueaxis_report::numbers::fixed;
use trueaxis_report::{Section, Table};
use trueaxis_standards::iso230_4::Cause;
use trueaxis_standards::report::{EvaluationDocument, cause_in_words};

/// An evaluation of readings by a standard, with what it says of the machine file: `trueaxis/evaluate/1`.
#[derive(Debug, Serialize, JsonSchema)]
pub struct EvaluatedDocument<'a> {
    /// The evaluation.
    #[serde(flatten)]
    pub document: EvaluationDocument<'a>,
    /// A circle as errors of the machine file; absent where no machine is named.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub machine_errors: Option<MachineErrorsEntry>,
}

/// A circle as errors of the machine file.
#[derive(Debug, Serialize, JsonSchema)]
pub struct MachineErrorsEntry {
    /// The errors that change.
    pub written: Vec<WrittenEntry>,
    /// The causes that change nothing, and why.
    pub left: Vec<LeftEntry>,
    /// Every cause in the readings and as the virtual ball-bar of the machine file shows it, before and after.
    pub compared: Vec<ComparedEntry>,
    /// Standard deviation of reading − virtual ball-bar of the machine file as it was, µm.
    pub residual_before_um: f64,
    /// The same of the new machine file, µm.
    pub residual_after_um: f64,
}

/// An error of the machine file that changes.
#[derive(Debug, Serialize, JsonSchema)]
pub struct WrittenEntry {
    /// Its ISO 230-1 name.
    pub error: String,
    /// What the file states now.
    pub value: String,
    /// The causes that it states.
    pub causes: Vec<&'static str>,
}

/// A cause that changes nothing.
#[derive(Debug, Serialize, JsonSchema)]
pub struct LeftEntry {
    /// Which.
    pub cause: &'static str,
    /// Of which axis; null where it belongs to both.
    pub axis: Option<String>,
    /// Why.
    pub why: String,
}

/// A cause before and after.
#[derive(Debug, Serialize, JsonSchema)]
pub struct ComparedEntry {
    /// Which.
    pub cause: &'static str,
    /// Of which axis; null where it belongs to both.
    pub axis: Option<String>,
    /// `um` or `urad`: the unit of the numbers.
    pub unit: &'static str,
    /// From the readings. Unit: that of `unit`.
    pub read: f64,
    /// From the machine file as it was. Unit: that of `unit`.
    pub before: f64,
    /// From the new machine file. Unit: that of `unit`.
    pub after: f64,
}

fn unit(cause: Cause) -> (&'static str, &'static str, f64) {
    if cause == Cause::Squareness { ("urad", "µrad", 1e6) } else { ("um", "µm", 1e3) }
}

impl MachineErrorsEntry {
    /// For programs; `axes` as the circle names them.
    pub fn of(found: &MachineErrors, axes: &[String; 2]) -> Self {
        let axis = |cause: Cause| cause.axis().map(|i| axes[i].clone());
        let written = |w: &Written| WrittenEntry {
            error: w.name.to_string(),
            value: w.text.clone(),
            causes: w.causes.iter().map(|c| c.key()).collect(),
        };
        let compared = |c: &Compared| {
            let (unit, _, scale) = unit(c.cause);
            let [read, before, after] = [c.read, c.before, c.after].map(|v| v * scale);
            ComparedEntry { cause: c.cause.key(), axis: axis(c.cause), unit, read, before, after }
        };
        let left = found.left.iter();
        let left = left.map(|l| LeftEntry {
            cause: l.cause.key(),
            axis: axis(l.cause),
            why: l.why.clone(),
        });
        Self {
            written: found.written.iter().map(written).collect(),
            left: left.collect(),
            compared: found.compared.iter().map(compared).collect(),
            residual_before_um: found.residual_mm[0] * 1e3,
            residual_after_um: found.residual_mm[1] * 1e3,
        }
    }
}

/// The sections of a report.
pub fn machine_errors_sections(found: &MachineErrors, axes: &[String; 2]) -> Vec<Section<'static>> {
    let words = |cause: Cause| cause_in_words(cause, axes);
    let written = found.written.iter().map(|w| {
        let causes: Vec<String> = w.causes.iter().map(|c| words(*c)).collect();
        [w.name.to_string(), w.text.clone(), causes.join("; ")]
    });
    let compared = found.compared.iter().map(|c| {
        let (_, unit, scale) = unit(c.cause);
        let [read, before, after] = [c.read, c.before, c.after].map(|v| fixed(v * scale, 2));
        [words(c.cause), read, before, after, unit.to_owned()]
    });
    let [before, after] = found.residual_mm.map(|v| fixed(v * 1e3, 3));
    let note = format!(
        "Virtual ball-bar of the machine file, through its whole chain. Reading − virtual ball-bar, standard deviation: \
         {before} µm before, {after} µm after."
    );
    let left = found.left.iter().map(|l| format!("{}: {}", words(l.cause), l.why));
    vec![
        Section::new("Errors of the machine file").table(
            Table::new(["error", "value in the file", "from"]).rows(written).note(
                "Names and signs of ISO 230-1: the error of the body; only what differs from the file by more than U.",
            ),
        ),
        Section::new("What the ball-bar reads, and what the machine file shows").table(
            Table::new(["cause", "read", "file before", "file after", ""]).rows(compared).note(note),
        ),
        Section::new("Not written").list(left.collect::<Vec<_>>()),
    ]
}
