//! The document of a prediction for a test piece.

use super::{family_key, ranked};
use crate::predict::{
    ConditionResult, Correction, Index, Prediction, SectionResult, Sensitivity, Share, Spread,
    Study,
};
use serde::Serialize;
use trueaxis_machine::axis::{Axis, Command};
use trueaxis_machine::describe::shown;
use trueaxis_machine::errors::ErrorKind;
use trueaxis_part::testpiece::IndexName;
use trueaxis_part::tolerance::Judgement;
use trueaxis_report::JsonSchema;
use trueaxis_report::Keyed;

/// A test piece before it is cut: `trueaxis/predict/1`.
#[derive(Debug, Serialize, JsonSchema)]
pub struct PredictionDocument<'a> {
    /// Which document this is.
    #[schemars(extend("const" = "trueaxis/predict/1"))]
    pub schema: &'static str,
    /// The version of TrueAxis.
    pub version: &'static str,
    /// The name of the study.
    pub study: &'a str,
    /// The machine.
    pub machine: MachineEntry<'a>,
    /// The name of the test piece.
    pub test_piece: &'a str,
    /// `pass`, `fail` or `undecided`.
    pub verdict: &'static str,
    /// The indices, those of ISO under `iso`, those of the paper under `paper`, mm.
    pub indices: Keyed<Grouped<IndexEntry>>,
    /// The tolerances with their verdicts.
    pub judgements: Vec<JudgementEntry<'a>>,
    /// Where the axes stand when the zero is set, mm and deg.
    pub setting_command: Keyed<f64>,
    /// The form at each measuring position.
    pub positions: Vec<PositionEntry<'a>>,
    /// The share of each error in each index, the largest first.
    #[serde(rename = "blame")]
    pub budget: Vec<ShareEntry>,
    /// The same with all errors of a body together.
    #[serde(rename = "blame_by_body")]
    pub budget_by_body: Vec<ShareEntry>,
    /// The same with all location errors and all error motions together.
    #[serde(rename = "blame_by_kind")]
    pub budget_by_kind: Vec<ShareEntry>,
    /// Slopes of the indices by each location error.
    pub sensitivity: Vec<SensitivityEntry>,
    /// Single corrections after which the part would pass, the smallest first.
    pub corrections: Vec<CorrectionEntry>,
    /// The same part with other setting points and datums.
    pub variants: Vec<VariantEntry<'a>>,
    /// Axis positions of all tool positions, mm and deg.
    pub commands: Vec<Keyed<f64>>,
    /// The Monte Carlo run; null if there was none.
    pub monte_carlo: Option<SamplingEntry>,
    /// The log that the temperatures follow; null if there is none.
    pub temperature_log: Option<&'a str>,
    /// The part at the feed of every cutting condition; absent without `[servo]`.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub conditions: Vec<ConditionEntry<'a>>,
    /// What to know of this prediction.
    pub warnings: &'a [String],
}

/// The part at the feed of one cutting condition.
#[derive(Debug, Serialize, JsonSchema)]
pub struct ConditionEntry<'a> {
    /// Its name.
    pub condition: &'a str,
    /// The feed of the tip, mm/min.
    pub feed_mm_per_min: f64,
    /// The lowest and the highest speed of the tip that the axes allow, mm/min.
    pub tip_mm_per_min: [f64; 2],
    /// Index after index.
    pub indices: Vec<ConditionIndexEntry>,
    /// `pass`, `fail` or `undecided`.
    pub verdict: &'static str,
}

/// An index at the feed of a cutting condition.
#[derive(Debug, Serialize, JsonSchema)]
pub struct ConditionIndexEntry {
    /// Its key.
    pub index: &'static str,
    /// Its value, mm.
    pub value_mm: f64,
    /// Its standard uncertainty, mm.
    pub u_mm: f64,
    /// The part of it that comes from the servo alone, mm.
    pub u_servo_mm: f64,
    /// The value less that without following errors, mm.
    pub added_mm: f64,
    /// The value with the servo alone, on a machine without errors, mm.
    pub servo_alone_mm: f64,
}

impl<'a> ConditionEntry<'a> {
    fn of(result: &'a ConditionResult, prediction: &Prediction) -> Self {
        let index = |(i, index): (usize, &Index)| ConditionIndexEntry {
            index: index.name.key,
            value_mm: result.indices_mm[i],
            u_mm: result.u_mm[i],
            u_servo_mm: result.u_servo_mm[i],
            added_mm: result.indices_mm[i] - index.value_mm,
            servo_alone_mm: result.servo_alone_mm[i],
        };
        Self {
            condition: &result.condition.name,
            feed_mm_per_min: result.condition.feed_mm_per_min.unwrap_or(0.0),
            tip_mm_per_min: result.speed_mm_per_s.map(|v| v * 60.0),
            indices: prediction.indices.iter().enumerate().map(index).collect(),
            verdict: result.verdict.outcome.word(),
        }
    }
}

/// The machine.
#[derive(Debug, Serialize, JsonSchema)]
pub struct MachineEntry<'a> {
    /// Its name.
    pub name: &'a str,
    /// Its chain from the workpiece to the tool.
    pub chain: String,
}

/// One value, or those of a family (`iso`, `paper`) by their keys.
#[derive(Debug, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum Grouped<T> {
    /// One.
    One(T),
    /// A family.
    Family(Keyed<T>),
}

/// An index of the whole part.
#[derive(Debug, Serialize, JsonSchema)]
pub struct IndexEntry {
    /// Its value. Unit: mm.
    pub value: f64,
    /// Its standard uncertainty by linear propagation, mm.
    pub u_mm: f64,
    /// From the Monte Carlo run; absent if there was none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub monte_carlo: Option<SpreadEntry>,
}

/// What the Monte Carlo run gives for an index.
#[derive(Debug, Serialize, JsonSchema)]
pub struct SpreadEntry {
    /// The mean, mm.
    pub mean_mm: f64,
    /// The standard uncertainty, mm.
    pub u_mm: f64,
    /// Lower and upper end of the 95 % interval, mm.
    pub interval_95_mm: [f64; 2],
}

/// A tolerance with its verdict.
#[derive(Debug, Serialize, JsonSchema)]
pub struct JudgementEntry<'a> {
    /// The key of the index.
    pub index: &'a str,
    /// Its value, mm.
    pub value_mm: f64,
    /// The tolerance, mm.
    pub tolerance_mm: f64,
    /// The expanded uncertainty; null where the rule uses none, mm.
    pub expanded_mm: Option<f64>,
    /// Value divided by tolerance. Unit: 1.
    pub used_ratio: f64,
    /// Whether the verdict depends on it.
    pub decisive: bool,
    /// `pass`, `fail` or `undecided`.
    pub verdict: &'static str,
}

/// The form at one measuring position.
#[derive(Debug, Serialize, JsonSchema)]
pub struct PositionEntry<'a> {
    /// The indices of this position, those of ISO under `iso`, those of the paper under `paper`, mm.
    #[serde(flatten)]
    pub indices: Keyed<Grouped<PositionIndex>>,
    /// Its number, from 1.
    pub position: usize,
    /// Its place along the axis of the part in the workpiece frame, mm.
    pub z_mm: f64,
    /// Its height above the base, mm.
    pub height_mm: f64,
    /// The nominal radius, mm.
    pub nominal_radius_mm: f64,
    /// Where the form is given, deg.
    pub azimuth_deg: Vec<f64>,
    /// The error there, positive where material is left, mm.
    pub e_mm: &'a [f64],
}

/// An index at one position.
#[derive(Debug, Serialize, JsonSchema)]
pub struct PositionIndex {
    /// Its value. Unit: mm.
    pub value: f64,
    /// Its standard uncertainty, mm.
    pub u_mm: f64,
}

/// The share of an error, or of a group of errors, in an index.
#[derive(Debug, Serialize, JsonSchema)]
pub struct ShareEntry {
    /// The ISO 230-1 name, or the name of the group.
    pub error: String,
    /// The key of the index.
    pub index: &'static str,
    /// The index if there were only this error, mm.
    pub alone_mm: f64,
    /// The index without this error, mm.
    pub without_mm: f64,
}

/// Slopes of the indices by one location error.
#[derive(Debug, Serialize, JsonSchema)]
pub struct SensitivityEntry {
    /// Its ISO 230-1 name.
    pub error: String,
    /// `um_per_um` of a shift, `um_per_urad` of a rotation: the slope of each index.
    #[serde(flatten)]
    pub slopes: Keyed<Keyed<f64>>,
}

/// A correction of one location error after which the part would pass.
#[derive(Debug, Serialize, JsonSchema)]
pub struct CorrectionEntry {
    /// Its ISO 230-1 name.
    pub error: String,
    /// `change_um` of a shift, `change_urad` of a rotation: what is to be added to the error.
    #[serde(flatten)]
    pub change: Keyed<f64>,
    /// The indices after it, mm.
    pub indices_mm: Keyed<f64>,
}

/// The same part with another setting point or datum.
#[derive(Debug, Serialize, JsonSchema)]
pub struct VariantEntry<'a> {
    /// What is different.
    pub name: &'a str,
    /// The indices, mm.
    pub indices_mm: Keyed<f64>,
}

/// A Monte Carlo run.
#[derive(Debug, Serialize, JsonSchema)]
pub struct SamplingEntry {
    /// How many machines were drawn.
    pub samples: usize,
    /// The random seed.
    pub seed: u64,
}

impl<'a> PredictionDocument<'a> {
    /// The document of a prediction.
    pub fn of(study: &'a Study, prediction: &'a Prediction) -> Self {
        let axes = study.machine.axes();
        let names: Vec<IndexName> = prediction.indices.iter().map(|i| i.name).collect();
        let budget = &prediction.budget;
        let sections = prediction.sections.iter().zip(1..);
        let variants = prediction.variants.iter();
        Self {
            schema: "trueaxis/predict/1",
            version: trueaxis_report::VERSION,
            study: &study.name,
            machine: MachineEntry { name: study.machine.name(), chain: study.machine.chain_text() },
            test_piece: &study.test_piece.name,
            verdict: prediction.outcome().word(),
            indices: grouped(prediction.indices.iter().map(|i| (i.name, IndexEntry::from(i)))),
            judgements: prediction.verdict.judgements.iter().map(JudgementEntry::from).collect(),
            setting_command: command(axes, &prediction.setting_command),
            positions: sections.map(|(s, n)| PositionEntry::of(n, s, &names)).collect(),
            budget: shares(prediction, &budget.errors, &names, ToString::to_string),
            budget_by_body: shares(prediction, &budget.bodies, &names, ToString::to_string),
            budget_by_kind: shares(prediction, &budget.kinds, &names, |kind| match kind {
                ErrorKind::Location => "location errors".to_owned(),
                ErrorKind::Motion => "error motions".to_owned(),
            }),
            sensitivity: prediction
                .sensitivities
                .iter()
                .map(|s| SensitivityEntry::of(s, &names))
                .collect(),
            corrections: prediction
                .corrections
                .iter()
                .map(|c| CorrectionEntry::of(c, &names))
                .collect(),
            variants: variants
                .map(|v| VariantEntry { name: &v.name, indices_mm: named(&names, &v.indices_mm) })
                .collect(),
            commands: prediction.commands.iter().map(|c| command(axes, c)).collect(),
            monte_carlo: study.sampling.map(|s| SamplingEntry { samples: s.samples, seed: s.seed }),
            temperature_log: study.temperatures.as_ref().map(|t| t.run.log.file()),
            conditions: prediction
                .conditions
                .iter()
                .map(|c| ConditionEntry::of(c, prediction))
                .collect(),
            warnings: &prediction.warnings,
        }
    }
}

/// A family stands where its first index stands.
fn grouped<T>(entries: impl Iterator<Item = (IndexName, T)>) -> Keyed<Grouped<T>> {
    let mut groups: Keyed<Grouped<T>> = Keyed(Vec::new());
    for (name, value) in entries {
        let key = name.key.to_owned();
        let Some(family) = family_key(name.family) else {
            groups.0.push((key, Grouped::One(value)));
            continue;
        };
        match groups.0.iter_mut().find(|(group, _)| group == family) {
            Some((_, Grouped::Family(members))) => members.0.push((key, value)),
            _ => {
                let members = Grouped::Family(Keyed(vec![(key, value)]));
                groups.0.push((family.to_owned(), members));
            }
        }
    }
    groups
}

fn named(names: &[IndexName], values: &[f64]) -> Keyed<f64> {
    names.iter().zip(values).map(|(n, v)| (n.key, *v)).collect()
}

fn command(axes: &[Axis], command: &Command) -> Keyed<f64> {
    let entries = axes.iter().zip(command);
    // + 0.0: no minus before a zero.
    entries.map(|(axis, q)| (axis.name.to_string(), shown(axis, *q) + 0.0)).collect()
}

impl From<&Index> for IndexEntry {
    fn from(index: &Index) -> Self {
        let spread = index.spread.map(SpreadEntry::from);
        Self { value: index.value_mm, u_mm: index.u_mm, monte_carlo: spread }
    }
}

impl From<Spread> for SpreadEntry {
    fn from(s: Spread) -> Self {
        Self { mean_mm: s.mean_mm, u_mm: s.u_mm, interval_95_mm: [s.low_mm, s.high_mm] }
    }
}

impl From<&Judgement> for JudgementEntry<'_> {
    fn from(j: &Judgement) -> Self {
        Self {
            index: j.index.key,
            value_mm: j.value_mm,
            tolerance_mm: j.limit_mm,
            expanded_mm: j.expanded_mm,
            used_ratio: j.used_ratio,
            decisive: j.index.decisive,
            verdict: j.outcome.word(),
        }
    }
}

impl<'a> PositionEntry<'a> {
    fn of(number: usize, result: &'a SectionResult, names: &[IndexName]) -> Self {
        let section = &result.section;
        let values = names.iter().zip(&section.indices_mm).zip(&result.u_mm);
        let known = values.filter_map(|((name, value), u)| {
            value.map(|value| (*name, PositionIndex { value, u_mm: *u }))
        });
        Self {
            indices: grouped(known),
            position: number,
            z_mm: section.z_mm,
            height_mm: section.height_mm,
            nominal_radius_mm: section.radius_mm,
            azimuth_deg: section.azimuth_rad.iter().map(|a| a.to_degrees()).collect(),
            e_mm: &section.deviation_mm,
        }
    }
}

/// Index after index, the shares that matter most first.
fn shares<T>(
    prediction: &Prediction,
    shares: &[Share<T>],
    names: &[IndexName],
    word: impl Fn(&T) -> String,
) -> Vec<ShareEntry> {
    let mut entries = Vec::new();
    for (i, name) in names.iter().enumerate() {
        for share in ranked(prediction, i, shares, shares.len()) {
            entries.push(ShareEntry {
                error: word(&share.of),
                index: name.key,
                alone_mm: share.alone_mm[i],
                without_mm: share.without_mm[i],
            });
        }
    }
    entries
}

impl SensitivityEntry {
    fn of(sensitivity: &Sensitivity, names: &[IndexName]) -> Self {
        let rotation = sensitivity.error.component.is_rotation();
        // mm per rad is µm per µrad times 1: both sides of the quotient scale by 1e-6 or 1e-3.
        let (unit, scale) = if rotation { ("um_per_urad", 1e-3) } else { ("um_per_um", 1.0) };
        let slopes: Vec<f64> = sensitivity.slope.iter().map(|s| s * scale).collect();
        let slopes = [(unit, named(names, &slopes))].into_iter().collect();
        Self { error: sensitivity.error.to_string(), slopes }
    }
}

impl CorrectionEntry {
    fn of(correction: &Correction, names: &[IndexName]) -> Self {
        let rotation = correction.error.component.is_rotation();
        let (unit, scale) = if rotation { ("change_urad", 1e6) } else { ("change_um", 1e3) };
        Self {
            error: correction.error.to_string(),
            change: [(unit, correction.change * scale)].into_iter().collect(),
            indices_mm: named(names, &correction.indices_mm),
        }
    }
}
