//! The document of a prediction for a part of any shape.

use super::prediction_document::SpreadEntry;
use crate::predict::Sampling;
use crate::predict::drawing::{
    Compensated, CompensatedPart, CutPoint, Drawn, ManyParts, PartPrediction, PartStudy, PartValue,
    PointEffect, effects,
};
use serde::Serialize;
use trueaxis_part::part::{Characteristic, Feature};
use trueaxis_report::JsonSchema;

/// Errors that are listed for a characteristic.
const MOST_ERRORS: usize = 10;

/// A part before it is cut, judged by its drawing: `trueaxis/predict/1`.
#[derive(Debug, Serialize, JsonSchema)]
pub struct DrawingDocument<'a> {
    /// Which document this is.
    #[schemars(extend("const" = "trueaxis/predict/1"))]
    pub schema: &'static str,
    /// The name of the study.
    pub name: &'a str,
    /// The name of the part.
    pub part: &'a str,
    /// `pass`, `fail`, or `undecided` within the uncertainty.
    pub outcome: &'static str,
    /// The same by the compensated program, the zero where it was set; absent unless it was asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub compensated_outcome: Option<&'static str>,
    /// The same with the zero set again by compensated motion.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub compensated_zero_set_outcome: Option<&'static str>,
    /// Errors each of whose corrections alone brings all characteristics into tolerance, the best first; empty where they are.
    pub sufficient: Vec<String>,
    /// Steps of the tools.
    pub steps: usize,
    /// Errors of the machine file without a stated uncertainty; they add nothing to `u_mm`.
    pub errors_without_u: &'a [String],
    /// The Monte Carlo run; absent if there was none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub monte_carlo: Option<ManyEntry>,
    /// The lines of the drawing, in the order of the part file.
    pub characteristics: Vec<CharacteristicEntry<'a>>,
    /// The features, in the order of the part file.
    pub features: Vec<FeatureEntry<'a>>,
}

/// One line of the drawing.
#[derive(Debug, Serialize, JsonSchema)]
pub struct CharacteristicEntry<'a> {
    /// Its name.
    pub name: &'a str,
    /// What is asked, such as `flatness`.
    pub kind: &'static str,
    /// Of which feature or pattern.
    pub feature: &'a str,
    /// The features that are meant: one, or all of the pattern.
    pub features: Vec<&'a str>,
    /// To which features, the first datum first; empty: to the zero that was set.
    pub datums: Vec<String>,
    /// How far its zone reaches beyond the end of the axis, below 0 beyond its beginning; absent without a projected zone, mm.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub projected_mm: Option<f64>,
    /// Its value; of a size the deviation from the nominal one, mm.
    pub value_mm: f64,
    /// Standard uncertainty of that, by the stated uncertainties of the machine, mm.
    pub u_mm: f64,
    /// By how much the value changes with half of the points, mm.
    pub points_mm: f64,
    /// As the measuring machine of the study would find it; absent if the study states none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub measured: Option<MeasuredEntry>,
    /// The value that the program leaves on a machine without errors, mm.
    pub nominal_mm: f64,
    /// The least value allowed; null for a zone, mm.
    pub low_mm: Option<f64>,
    /// The largest value allowed, mm.
    pub high_mm: f64,
    /// How much of the tolerance is used, 1 at a limit. Unit: 1.
    pub used_ratio: f64,
    /// `pass`, `fail` or `undecided`.
    pub outcome: &'static str,
    /// By the compensated program, the zero where it was set; absent unless it was asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub compensated: Option<CompensatedEntry>,
    /// The same with the zero set again by compensated motion.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub compensated_zero_set: Option<CompensatedEntry>,
    /// From the Monte Carlo run; absent if there was none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub monte_carlo: Option<DrawnEntry>,
    /// The errors that matter most, the largest first.
    pub errors: Vec<ErrorEffectEntry>,
}

/// A characteristic as it would be measured.
#[derive(Debug, Serialize, JsonSchema)]
pub struct MeasuredEntry {
    /// The mean of its values, mm.
    pub mean_mm: f64,
    /// Standard uncertainty by the scatter of the points, mm.
    pub u_mm: f64,
}

/// A characteristic by the compensated program.
#[derive(Debug, Serialize, JsonSchema)]
pub struct CompensatedEntry {
    /// Its value, mm.
    pub value_mm: f64,
    /// `pass`, `fail` or `undecided`, with the u of before.
    pub outcome: &'static str,
}

/// A Monte Carlo run for a part.
#[derive(Debug, Serialize, JsonSchema)]
pub struct ManyEntry {
    /// How many machines were drawn.
    pub samples: usize,
    /// The random seed.
    pub seed: u64,
    /// The share of them on which all characteristics are in tolerance. Unit: 1.
    pub good_ratio: f64,
}

/// A characteristic in the Monte Carlo run.
#[derive(Debug, Serialize, JsonSchema)]
pub struct DrawnEntry {
    /// Its values.
    #[serde(flatten)]
    pub values: SpreadEntry,
    /// The share of machines on which it is in tolerance. Unit: 1.
    pub good_ratio: f64,
}

/// What an error does to a characteristic.
#[derive(Debug, Serialize, JsonSchema)]
pub struct ErrorEffectEntry {
    /// Its ISO 230-1 name.
    pub error: String,
    /// The value without it, mm.
    pub without_mm: f64,
}

/// A feature as it was cut.
#[derive(Debug, Serialize, JsonSchema)]
pub struct FeatureEntry<'a> {
    /// Its name.
    pub name: &'a str,
    /// `plane`, `cylinder`, `cone`, `sphere`, `torus`, `slot`, `tongue`, `thread`, `points` or `programmed surface`.
    pub shape: &'static str,
    /// How many points it has.
    pub points: usize,
    /// How far neighbouring points are apart, mm.
    pub spacing_mm: f64,
    /// The point with the most material left.
    pub most: PointEntry,
    /// The point with the most material missing, or the least left.
    pub least: PointEntry,
    /// Mean of the deviations, mm.
    pub mean_mm: f64,
}

/// A point of a feature.
#[derive(Debug, Serialize, JsonSchema)]
pub struct PointEntry {
    /// Where it should be in the workpiece frame, mm.
    pub nominal_mm: [f64; 3],
    /// The deviation along the normal; positive where material is left, mm.
    pub deviation_mm: f64,
    /// What the program leaves there on a machine without errors, mm.
    pub by_program_mm: f64,
    /// The tool that cut it.
    pub tool: u32,
    /// The file of the program, or of a subprogram.
    pub program: String,
    /// Its line.
    pub line: u32,
    /// When, from the start of the program, s.
    pub time_s: f64,
    /// The errors that displace it most, the largest first.
    pub errors: Vec<PointEffectEntry>,
}

/// What an error does to a point.
#[derive(Debug, Serialize, JsonSchema)]
pub struct PointEffectEntry {
    /// Its ISO 230-1 name.
    pub error: String,
    /// How much of the deviation of the point it makes, mm.
    pub part_mm: f64,
}

impl CompensatedEntry {
    fn of(part: &Compensated, i: usize) -> Self {
        Self { value_mm: part.values_mm[i], outcome: part.outcomes[i].word() }
    }
}

impl<'a> DrawingDocument<'a> {
    /// The document of a prediction.
    pub fn of(study: &'a PartStudy, prediction: &'a PartPrediction) -> Self {
        let part = &study.part;
        let drawn = prediction.drawn.as_ref();
        let asked = part.characteristics.iter().zip(&prediction.values).enumerate();
        let after = prediction.compensated.as_ref();
        let (kept, set) =
            (after.map(|c| &c.zero_kept), after.map(|c: &CompensatedPart| &c.zero_set));
        let entry = |(i, (asked, value))| {
            let drawn = drawn.map(|d| d.characteristics[i]);
            let entry = CharacteristicEntry::of(&part.features, asked, (value, drawn));
            CharacteristicEntry {
                compensated: kept.map(|c| CompensatedEntry::of(c, i)),
                compensated_zero_set: set.map(|c| CompensatedEntry::of(c, i)),
                ..entry
            }
        };
        let many = |(s, drawn): (Sampling, &ManyParts)| ManyEntry {
            samples: s.samples,
            seed: s.seed,
            good_ratio: drawn.good_ratio,
        };
        let features = part.features.iter().zip(&prediction.features);
        Self {
            schema: "trueaxis/predict/1",
            name: &study.name,
            part: &part.name,
            outcome: prediction.outcome.word(),
            compensated_outcome: kept.map(|c| c.outcome.word()),
            compensated_zero_set_outcome: set.map(|c| c.outcome.word()),
            sufficient: prediction.sufficient.iter().map(ToString::to_string).collect(),
            steps: prediction.steps,
            errors_without_u: &prediction.errors_without_u,
            monte_carlo: study.sampling.zip(drawn).map(many),
            characteristics: asked.map(entry).collect(),
            features: features
                .map(|(f, cut)| FeatureEntry::of(f, &cut.points, &prediction.programs))
                .collect(),
        }
    }
}

impl<'a> CharacteristicEntry<'a> {
    fn of(
        features: &'a [Feature],
        asked: &'a Characteristic,
        (value, drawn): (&PartValue, Option<Drawn>),
    ) -> Self {
        let (low_mm, high_mm) = asked.limits.ends_mm();
        let effect = |e: &crate::predict::drawing::ErrorEffect| ErrorEffectEntry {
            error: e.error.to_string(),
            without_mm: e.without_mm,
        };
        Self {
            name: &asked.name,
            kind: asked.kind.key(),
            feature: &asked.of,
            features: asked.features.iter().map(|f| features[*f].name.as_str()).collect(),
            datums: asked.datums.iter().map(|d| d.name(features)).collect(),
            projected_mm: asked.projected_mm,
            value_mm: value.value_mm,
            u_mm: value.u_mm,
            points_mm: value.points_mm,
            measured: value.measured.map(|m| MeasuredEntry { mean_mm: m.mean_mm, u_mm: m.u_mm }),
            nominal_mm: value.nominal_mm,
            low_mm,
            high_mm,
            used_ratio: value.used_ratio,
            outcome: value.outcome.word(),
            compensated: None,
            compensated_zero_set: None,
            monte_carlo: drawn
                .map(|d| DrawnEntry { values: d.spread.into(), good_ratio: d.good_ratio }),
            errors: effects(value, MOST_ERRORS).map(effect).collect(),
        }
    }
}

/// The points with the most and the least material.
pub(super) fn extremes(points: &[CutPoint]) -> [&CutPoint; 2] {
    let by = |a: &&CutPoint, b: &&CutPoint| a.deviation_mm.total_cmp(&b.deviation_mm);
    let most = points.iter().max_by(by).unwrap_or(&points[0]);
    let least = points.iter().min_by(by).unwrap_or(&points[0]);
    [most, least]
}

/// The median of the distances of some points from their nearest neighbours; of one point 1 mm.
pub(super) fn spacing_mm(points: &[CutPoint]) -> f64 {
    const ASKED: usize = 50;
    let every = points.len().div_ceil(ASKED).max(1);
    let nearest = |i: usize| {
        let others = points.iter().enumerate().filter(|(k, _)| *k != i);
        let off = others.map(|(_, p)| (p.nominal_mm - points[i].nominal_mm).norm());
        off.filter(|d| *d > 1e-6).fold(f64::INFINITY, f64::min)
    };
    let mut all: Vec<f64> = (0..points.len()).step_by(every).map(nearest).collect();
    all.sort_by(f64::total_cmp);
    all.get(all.len() / 2).copied().filter(|d| d.is_finite()).unwrap_or(1.0)
}

impl<'a> FeatureEntry<'a> {
    fn of(feature: &'a Feature, points: &[CutPoint], programs: &[String]) -> Self {
        let [most, least] = extremes(points);
        let sum: f64 = points.iter().map(|p| p.deviation_mm).sum();
        Self {
            name: &feature.name,
            shape: feature.shape_name(),
            points: points.len(),
            spacing_mm: spacing_mm(points),
            most: PointEntry::of(most, programs),
            least: PointEntry::of(least, programs),
            mean_mm: sum / points.len() as f64,
        }
    }
}

impl From<&PointEffect> for PointEffectEntry {
    fn from(effect: &PointEffect) -> Self {
        Self { error: effect.error.to_string(), part_mm: effect.part_mm }
    }
}

impl PointEntry {
    fn of(point: &CutPoint, programs: &[String]) -> Self {
        let program = programs.get(point.origin.program as usize).cloned().unwrap_or_default();
        Self {
            program,
            nominal_mm: point.nominal_mm.into(),
            deviation_mm: point.deviation_mm,
            by_program_mm: point.by_program_mm,
            tool: point.origin.tool,
            line: point.origin.line,
            time_s: point.origin.time_s,
            errors: point.errors.iter().map(PointEffectEntry::from).collect(),
        }
    }
}
