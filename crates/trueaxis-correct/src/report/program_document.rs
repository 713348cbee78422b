//! The document of a compensated program.

use super::program::ProgramReport;
use crate::compensate::program::{Largest, Residual};
use serde::Serialize;
use std::collections::BTreeMap;
use trueaxis_report::JsonSchema;

/// A program rewritten for the actual machine, with its proof: `trueaxis/compensate-program/1`.
#[derive(Debug, Serialize, JsonSchema)]
pub struct ProgramDocument<'a> {
    /// Which document this is.
    #[schemars(extend("const" = "trueaxis/compensate-program/1"))]
    pub schema: &'static str,
    /// The name of the machine.
    pub machine: &'a str,
    /// The program as it was.
    pub program: &'a str,
    /// The compensated program.
    pub output: &'a str,
    /// Blocks that move the tool.
    pub blocks: u64,
    /// Blocks of these that were divided.
    pub split: u64,
    /// Blocks that were written for all of them.
    pub pieces: u64,
    /// Circles that became lines.
    pub circles_to_lines: u64,
    /// Words that were added to blocks.
    pub words_added: u64,
    /// The first thousand of them.
    pub additions: Vec<AddedWord>,
    /// Computed words that have a correction added.
    pub expressions_corrected: u64,
    /// The first thousand of them.
    pub expressions: Vec<CorrectedExpression<'a>>,
    /// Whether the written program, read back, keeps the residual: only then it is written.
    pub proved: bool,
    /// Blocks of rotary axes alone with a new F, so that they take the same time.
    pub feeds_changed: u64,
    /// Places where an axis reverses by less than its reversal error.
    pub undecided_reversals: u64,
    /// Cuts that begin where no corrected word leads, as after a move to machine zero: their ways are not part of the proof.
    pub begins_elsewhere: u64,
    /// Blocks that stay as they are, by reason.
    pub left: &'a BTreeMap<&'static str, u64>,
    /// Places where the tool axis keeps its deviation, by reason.
    pub axis_left: &'a BTreeMap<String, u64>,
    /// Whether only the tip was corrected.
    pub position_only: bool,
    /// How far the tip may be missed between the ends of blocks, mm.
    pub residual_mm: f64,
    /// How far the tool axis may be missed there, rad.
    pub residual_axis_rad: f64,
    /// The least increments; null if numbers were not rounded.
    pub increments: Option<IncrementsEntry>,
    /// The largest deviations of the program as it was.
    pub before: ResidualEntry,
    /// Of the compensated program, read back.
    pub after: ResidualEntry,
    /// How many ends of blocks were compared.
    pub ends_compared: u64,
    /// The blocks with the largest deviations after compensation.
    pub worst_blocks: Vec<BlockEntry>,
    /// The largest correction of each axis.
    pub largest_corrections: Vec<AxisCorrection>,
    /// The largest relative change of the path length of the tip in a block. Unit: 1.
    pub way_change_relative: f64,
    /// How well the corrections are known.
    pub uncertainty: UncertaintyEntry,
    /// What would be left without correction and with a wrong sign.
    pub convention_check: Vec<ConventionEntry>,
    /// What to know of this program.
    pub remarks: Vec<String>,
}

/// A word that a block did not have.
#[derive(Debug, Serialize, JsonSchema)]
pub struct AddedWord {
    /// The line of the program as it was.
    pub line: u32,
    /// The axis.
    pub axis: String,
}

/// A computed word that has a correction added.
#[derive(Debug, Serialize, JsonSchema)]
pub struct CorrectedExpression<'a> {
    /// The line of the program as it was.
    pub line: u32,
    /// The expression as it was.
    pub was: &'a str,
    /// What stands there now; in Klartext the calculation before the block.
    pub is: &'a str,
}

/// The least increments.
#[derive(Debug, Serialize, JsonSchema)]
pub struct IncrementsEntry {
    /// Of linear axes, mm.
    pub linear_mm: f64,
    /// Of rotary axes, deg.
    pub rotary_deg: f64,
}

/// The largest deviations of the actual tool.
#[derive(Debug, Serialize, JsonSchema)]
pub struct ResidualEntry {
    /// Of the tip at the ends of blocks, µm.
    pub tip_at_ends_um: LineValue,
    /// Of the tool axis at the ends of blocks, µrad.
    pub axis_at_ends_urad: LineValue,
    /// Of the tip between the ends, µm.
    pub tip_between_um: LineValue,
    /// Of the tool axis between the ends, µrad.
    pub axis_between_urad: LineValue,
    /// Root mean square of the tip over the ends of blocks, µm.
    pub tip_at_ends_rms_um: f64,
    /// Of the tool axis over the ends of blocks, µrad.
    pub axis_at_ends_rms_urad: f64,
}

/// A value and the line of the program where it occurs.
#[derive(Debug, Serialize, JsonSchema)]
pub struct LineValue {
    /// The value. Unit: that of the key.
    pub value: f64,
    /// The line of the program as it was, from 1.
    pub line: u32,
}

/// One block.
#[derive(Debug, Serialize, JsonSchema)]
pub struct BlockEntry {
    /// The line of the program as it was, from 1.
    pub line: u32,
    /// Deviation of the tip before, µm.
    pub tip_before_um: f64,
    /// Deviation of the tip after, µm.
    pub tip_after_um: f64,
    /// Deviation of the tool axis before, µrad.
    pub axis_before_urad: f64,
    /// Deviation of the tool axis after, µrad.
    pub axis_after_urad: f64,
}

/// The largest correction of one axis.
#[derive(Debug, Serialize, JsonSchema)]
pub struct AxisCorrection {
    /// The axis.
    pub axis: String,
    /// The correction. Unit: that of `unit`.
    pub value: f64,
    /// Its unit.
    pub unit: &'static str,
    /// The line of the program as it was, from 1.
    pub line: u32,
}

/// How well the corrections are known.
#[derive(Debug, Serialize, JsonSchema)]
pub struct UncertaintyEntry {
    /// Places that were examined.
    pub places: usize,
    /// Of these, where the correction is smaller than its standard uncertainty.
    pub smaller_than_u: usize,
    /// The largest standard uncertainty of the tip, µm.
    pub largest_u_um: f64,
}

/// The block with the largest correction under another convention.
#[derive(Debug, Serialize, JsonSchema)]
pub struct ConventionEntry {
    /// Which convention.
    pub what: String,
    /// Deviation of the tip, µm.
    pub tip_um: f64,
    /// Deviation of the tool axis, µrad.
    pub axis_urad: f64,
}

impl<'a> ProgramDocument<'a> {
    /// The document of a compensated program.
    pub fn of(r: &ProgramReport<'a>) -> Self {
        let (found, proof) = (&r.rewritten.found, &r.rewritten.proof);
        let confidence = &r.rewritten.confidence;
        let largest = found.largest.iter().enumerate().map(|(i, l)| {
            let (scale, unit) = r.unit(i);
            AxisCorrection { axis: r.axis_name(i), value: l.value * scale, unit, line: l.line }
        });
        let conventions = r.conventions().into_iter();
        Self {
            schema: "trueaxis/compensate-program/1",
            machine: r.machine.name(),
            program: r.program,
            output: r.output,
            blocks: found.blocks,
            split: found.split,
            pieces: found.pieces,
            circles_to_lines: found.circles,
            words_added: found.words_added,
            additions: found
                .additions
                .iter()
                .map(|(line, axis)| AddedWord { line: *line, axis: axis.to_string() })
                .collect(),
            expressions_corrected: found.expressions_corrected,
            expressions: found
                .expressions
                .iter()
                .map(|e| CorrectedExpression { line: e.line, was: &e.was, is: &e.is })
                .collect(),
            proved: r.rewritten.is_proved(),
            feeds_changed: found.feeds_changed,
            undecided_reversals: found.undecided,
            begins_elsewhere: found.begins_elsewhere.len() as u64,
            left: &found.left,
            axis_left: &found.axis_left,
            position_only: r.options.position_only,
            residual_mm: r.options.residual_mm,
            residual_axis_rad: r.options.residual_rad,
            increments: r
                .options
                .increments
                .map(|i| IncrementsEntry { linear_mm: i.linear_mm, rotary_deg: i.rotary_deg }),
            before: ResidualEntry::from(&proof.before),
            after: ResidualEntry::from(&proof.after),
            ends_compared: proof.compared,
            worst_blocks: proof
                .worst
                .iter()
                .map(|b| BlockEntry {
                    line: b.line,
                    tip_before_um: b.tip_before_mm * 1e3,
                    tip_after_um: b.tip_after_mm * 1e3,
                    axis_before_urad: b.axis_before_rad * 1e6,
                    axis_after_urad: b.axis_after_rad * 1e6,
                })
                .collect(),
            largest_corrections: largest.collect(),
            way_change_relative: found.length_change,
            uncertainty: UncertaintyEntry {
                places: confidence.looked_at,
                smaller_than_u: confidence.weaker,
                largest_u_um: confidence.largest_u_mm * 1e3,
            },
            convention_check: conventions
                .map(|(what, tip_um, axis_urad)| ConventionEntry { what, tip_um, axis_urad })
                .collect(),
            remarks: r.remarks(),
        }
    }
}

impl From<&Residual> for ResidualEntry {
    fn from(of: &Residual) -> Self {
        let value = |l: Largest, scale: f64| LineValue { value: l.value * scale, line: l.line };
        Self {
            tip_at_ends_um: value(of.tip_end, 1e3),
            axis_at_ends_urad: value(of.axis_end, 1e6),
            tip_between_um: value(of.tip, 1e3),
            axis_between_urad: value(of.axis, 1e6),
            tip_at_ends_rms_um: of.tip_end_rms_mm * 1e3,
            axis_at_ends_rms_urad: of.axis_end_rms_rad * 1e6,
        }
    }
}
