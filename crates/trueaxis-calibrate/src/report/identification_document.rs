//! An identification for programs: `trueaxis/identify/1`.

use super::adequacy::follows;
use super::identification::{IdentificationReport, shown};
use super::stages::{StageEntry, stage_entries};
use crate::identify::adequacy::LEVEL;
use crate::identify::convention::ConventionCheck;
use crate::identify::errors::{Found, Identification};
use crate::identify::feeds::Feeds;
use crate::identify::score::Rms;
use crate::identify::selection::Score;
use crate::plan::Unobservable;
use serde::Serialize;
use trueaxis_measure::unknowns::fit::Model;
use trueaxis_report::JsonSchema;
use trueaxis_report::Keyed;

/// Errors identified from the readings of a campaign.
#[derive(Debug, Serialize, JsonSchema)]
pub struct IdentificationDocument<'a> {
    /// Which document this is.
    #[schemars(extend("const" = "trueaxis/identify/1"))]
    pub schema: &'static str,
    /// Name of the campaign.
    pub name: &'a str,
    /// Name of the machine.
    pub machine: &'a str,
    /// Date of the measurement as written; null if none is stated.
    pub date: Option<&'a str>,
    /// Whether the model explains the readings.
    pub verdict: VerdictEntry,
    /// The stages one after the other; empty if the campaign has none.
    pub stages: Vec<StageEntry<'a>>,
    /// The largest difference between the stages and all readings at once, in standard uncertainties; null
    /// without stages. Unit: 1.
    pub stages_differ_by_u: Option<f64>,
    /// The errors of the machine.
    pub errors: Vec<FoundEntry<'a>>,
    /// The errors of the set-up of the instruments.
    pub setup: Vec<FoundEntry<'a>>,
    /// Combinations of errors that change no reading.
    pub unobservable: &'a [Unobservable],
    /// Candidate terms that the readings do not support.
    pub left_out: &'a [String],
    /// Root mean square of the residual of length readings, in sample, µm; null without such readings.
    pub rms_in_um: Option<f64>,
    /// The same on places that the model had not seen, µm.
    pub rms_held_out_um: Option<f64>,
    /// Repeatability of the readings, µm.
    pub repeatability_um: Option<f64>,
    /// Whether the repeatability comes from repeated readings; if not, it is the stated noise.
    pub repeatability_is_measured: bool,
    /// Root mean square without the unknown errors, set-up only, µm.
    pub rms_without_model_um: Option<f64>,
    /// The same figures for lengths and angles.
    pub rms: RmsEntries,
    /// Number of readings.
    pub readings: usize,
    /// Number of places.
    pub places: usize,
    /// Rank of the design matrix.
    pub rank: usize,
    /// Its condition number. Unit: 1.
    pub condition: f64,
    /// Relative singular value below which a combination counts as unobservable. Unit: 1.
    pub threshold: f64,
    /// `full` or `linear`.
    pub model: &'static str,
    /// χ² of the fit. Unit: 1.
    pub chi_square: f64,
    /// Its degrees of freedom.
    pub degrees_of_freedom: usize,
    /// The feeds of the readings, and the lags that they cannot separate.
    pub feeds: &'a Feeds,
    /// Factor by which the uncertainties are enlarged, 1 or more. Unit: 1.
    pub birge_ratio: f64,
    /// The test of the residual.
    pub test: TestEntry,
    /// The largest coverage factor of the values. Unit: 1.
    pub coverage_factor: f64,
    /// What the residual follows, the most evident first.
    pub residual_follows: Vec<FieldEntry>,
    /// How well readings are predicted; null if that was not asked for.
    pub prediction: Option<PredictionEntry>,
    /// How the terms were selected.
    pub selection: SelectionEntry<'a>,
    /// Readings beyond the limit of studentised residuals.
    pub outliers: Vec<OutlierEntry>,
    /// That limit, in standard deviations. Unit: 1.
    pub outlier_limit: f64,
    /// The readings that change the result most if they are left out.
    pub most_influential: Vec<InfluenceEntry>,
    /// The conventions that were tried; null if that was not asked for.
    pub conventions: Option<&'a ConventionCheck>,
}

/// The result.
#[derive(Debug, Serialize, JsonSchema)]
pub struct VerdictEntry {
    /// `explained`, `over-fitted`, `follows-xyz`, `turns-with-axis`, `arrangement`, `reverses`, `drifts`,
    /// `gross-readings`, `unexplained` or `stages-contradict`.
    pub key: &'static str,
    /// In words.
    pub words: String,
    /// Whether the model may be trusted.
    pub good: bool,
}

/// One unknown.
#[derive(Debug, Serialize, JsonSchema)]
pub struct FoundEntry<'a> {
    /// Its name.
    pub name: &'a str,
    /// `value_um`, its standard uncertainty `u_um` and its expanded uncertainty `U_um` = k u (95.45 %); the same with
    /// `urad`, `ms` (lag), `um_per_m` (scale, material), `um_per_h` or `urad_per_h` (drift); null if not observable.
    #[serde(flatten)]
    pub value: Keyed<Option<f64>>,
    /// The standard uncertainty again. Unit: that of the value.
    pub u: Option<f64>,
    /// Value divided by its standard uncertainty. Unit: 1.
    pub z: Option<f64>,
    /// Effective degrees of freedom of u; null if they are infinite or the value is not observable. Unit: 1.
    pub degrees_of_freedom: Option<f64>,
    /// k for 95.45 %; null if not observable. Unit: 1.
    pub coverage_factor: Option<f64>,
}

/// Root mean squares of the residual.
#[derive(Debug, Serialize, JsonSchema)]
pub struct RmsEntries {
    /// Of the readings that the model was fitted to.
    pub in_sample: RmsEntry,
    /// Of places that the model had not seen.
    pub held_out: RmsEntry,
    /// Of repeated readings, or the stated noise.
    pub repeatability: RmsEntry,
    /// Without the unknown errors, set-up only.
    pub without_model: RmsEntry,
}

/// A root mean square.
#[derive(Debug, Serialize, JsonSchema)]
pub struct RmsEntry {
    /// Of lengths, µm; null without such readings.
    pub um: Option<f64>,
    /// Of angles, µrad; null without such readings.
    pub urad: Option<f64>,
    /// In units of the stated noise. Unit: 1.
    pub times_noise: f64,
}

/// The test of the residual against noise or repeatability.
#[derive(Debug, Serialize, JsonSchema)]
pub struct TestEntry {
    /// `chi-square` against the stated noise, or `F` against repeated readings.
    pub statistic: &'static str,
    /// Its value. Unit: 1.
    pub value: f64,
    /// What it exceeds by chance, at this level; null without degrees of freedom. Unit: 1.
    pub limit: Option<f64>,
    /// How often a good campaign exceeds it. Unit: 1.
    pub level: f64,
    /// Degrees of freedom of the residual. Unit: 1.
    pub degrees_of_freedom: f64,
    /// Those of the repeatability; null for `chi-square`. Unit: 1.
    pub degrees_of_freedom_of_repeats: Option<f64>,
}

/// How well readings are predicted, by all errors together.
#[derive(Debug, Serialize, JsonSchema)]
pub struct PredictionEntry {
    /// On the readings themselves.
    pub in_sample: RmsEntry,
    /// On readings that were held out.
    pub held_out: Vec<HeldOutEntry>,
}

/// Readings that were predicted without them.
#[derive(Debug, Serialize, JsonSchema)]
pub struct HeldOutEntry {
    /// The rotary axis of which one angle after the other was held out; null: a part of the places.
    pub axis: Option<String>,
    /// How many parts.
    pub parts: usize,
    /// The residual by the listed errors alone.
    pub listed: RmsEntry,
    /// The residual by all errors, listed or not.
    pub all: RmsEntry,
}

/// A part of the residual.
#[derive(Debug, Serialize, JsonSchema)]
pub struct FieldEntry {
    /// The letter of an axis, `arrangement` (location errors), `approach` or `time`.
    pub what: String,
    /// The share of the squares of the residual that this kind of error, which is not listed, would explain alone,
    /// 0 to 1. Unit: 1.
    pub share: f64,
}

/// How the terms were selected.
#[derive(Debug, Serialize, JsonSchema)]
pub struct SelectionEntry<'a> {
    /// Number of candidate terms.
    pub candidates: usize,
    /// Least |z| of a term that is kept; null if none is. Unit: 1.
    pub least_z: Option<f64>,
    /// The limits that were tried.
    pub scores: &'a [Score],
}

/// A reading that does not fit.
#[derive(Debug, Serialize, JsonSchema)]
pub struct OutlierEntry {
    /// Its file.
    pub file: String,
    /// Its line there.
    pub line: usize,
    /// Its channel, from 1.
    pub channel: usize,
    /// Its studentised residual. Unit: 1.
    pub studentised: f64,
}

/// A reading and its influence on the result.
#[derive(Debug, Serialize, JsonSchema)]
pub struct InfluenceEntry {
    /// Its file.
    pub file: String,
    /// Its line there.
    pub line: usize,
    /// Its leverage, 0 to 1. Unit: 1.
    pub leverage: f64,
    /// Cook's distance; null if the result depends on this reading alone. Unit: 1.
    pub cook: Option<f64>,
}

impl<'a> IdentificationDocument<'a> {
    /// The document of an identification.
    pub fn of(report: &IdentificationReport<'a>) -> Self {
        let (found, records) = (report.found, report.records);
        let of = |setup: bool| {
            let of = found.found.iter().filter(|f| f.is_setup == setup);
            of.map(FoundEntry::from).collect()
        };
        let um = |rms: &Rms| rms.length_mm.map(|v| v * 1e3);
        let score = &found.score;
        Self {
            schema: "trueaxis/identify/1",
            name: &report.campaign.name,
            machine: report.campaign.machine.name(),
            date: report.options.date.as_deref(),
            verdict: VerdictEntry {
                key: found.verdict.key(),
                words: found.verdict.words(),
                good: found.verdict.is_good(),
            },
            stages: found
                .sequence
                .as_ref()
                .map_or(Vec::new(), |sequence| stage_entries(&found.design, sequence)),
            stages_differ_by_u: found.sequence.as_ref().map(|sequence| sequence.difference),
            errors: of(false),
            setup: of(true),
            unobservable: &found.unobservable,
            left_out: &found.left_out,
            rms_in_um: um(&score.in_sample),
            rms_held_out_um: um(&score.held_out),
            repeatability_um: um(&score.floor),
            repeatability_is_measured: score.floor_is_measured,
            rms_without_model_um: um(&score.before),
            rms: RmsEntries {
                in_sample: RmsEntry::from(&score.in_sample),
                held_out: RmsEntry::from(&score.held_out),
                repeatability: RmsEntry::from(&score.floor),
                without_model: RmsEntry::from(&score.before),
            },
            readings: records.readings.len(),
            places: found.places,
            rank: found.fit.sight.rank,
            condition: found.fit.sight.condition(),
            threshold: report.options.threshold,
            model: match report.options.model {
                Model::Full => "full",
                Model::Linear => "linear",
            },
            chi_square: found.fit.chi_square,
            degrees_of_freedom: found.fit.degrees_of_freedom,
            feeds: &found.feeds,
            birge_ratio: found.adequacy.noise,
            test: test(found),
            coverage_factor: found.coverage_factor(),
            residual_follows: fields(report),
            prediction: prediction(found),
            selection: SelectionEntry {
                candidates: found.candidates,
                least_z: finite(found.selection.threshold),
                scores: &found.selection.scores,
            },
            outliers: outliers(report),
            outlier_limit: found.influences.limit,
            most_influential: report.influential().map(|row| influence(report, row)).collect(),
            conventions: report.conventions,
        }
    }
}

fn finite(value: f64) -> Option<f64> {
    value.is_finite().then_some(value)
}

fn fields(report: &IdentificationReport<'_>) -> Vec<FieldEntry> {
    let found = report.found;
    let kinds = found.adequacy.kinds.iter();
    kinds.map(|k| FieldEntry { what: follows(&found.design, k), share: k.share }).collect()
}

fn test(found: &Identification) -> TestEntry {
    let lack = &found.adequacy.lack;
    TestEntry {
        statistic: if lack.of_repeats.is_some() { "F" } else { "chi-square" },
        value: lack.statistic,
        limit: finite(lack.limit),
        level: LEVEL,
        degrees_of_freedom: lack.freedom,
        degrees_of_freedom_of_repeats: lack.of_repeats,
    }
}

fn prediction(found: &Identification) -> Option<PredictionEntry> {
    let predictor = found.adequacy.predictor.as_ref()?;
    let axes = found.design.machine.axes();
    let held_out = predictor.held_out.iter().map(|held| HeldOutEntry {
        axis: held.axis.map(|a| axes[a].name.to_string()),
        parts: held.parts,
        listed: RmsEntry::from(&held.listed),
        all: RmsEntry::from(&held.predicted),
    });
    Some(PredictionEntry {
        in_sample: RmsEntry::from(&predictor.in_sample),
        held_out: held_out.collect(),
    })
}

fn outliers(report: &IdentificationReport<'_>) -> Vec<OutlierEntry> {
    let outliers = report.found.influences.outliers.iter().map(|o| {
        let place = report.records.place(o.row);
        let (channel, studentised) = (o.channel + 1, o.studentised);
        OutlierEntry { file: place.file, line: place.line, channel, studentised }
    });
    outliers.collect()
}

fn influence(report: &IdentificationReport<'_>, row: usize) -> InfluenceEntry {
    let place = report.records.place(row);
    let influence = &report.found.influences.rows[row];
    let (leverage, cook) = (influence.leverage, finite(influence.cook));
    InfluenceEntry { file: place.file, line: place.line, leverage, cook }
}

impl<'a> From<&'a Found> for FoundEntry<'a> {
    fn from(found: &'a Found) -> Self {
        let names = match (found.is_time, found.is_angle) {
            _ if found.is_share => ["value_um_per_m", "u_um_per_m", "U_um_per_m"],
            (_, true) if found.is_rate => ["value_urad_per_h", "u_urad_per_h", "U_urad_per_h"],
            _ if found.is_rate => ["value_um_per_h", "u_um_per_h", "U_um_per_h"],
            (true, _) => ["value_ms", "u_ms", "U_ms"],
            (_, true) => ["value_urad", "u_urad", "U_urad"],
            _ => ["value_um", "u_um", "U_um"],
        };
        let u = found.value.map(|(_, u)| shown(found, u));
        let value = found.value.map(|(v, _)| shown(found, v));
        let expanded = found.expanded().map(|u| shown(found, u));
        let value = names.into_iter().zip([value, u, expanded]).collect();
        Self {
            name: &found.name,
            value,
            u,
            z: found.z(),
            degrees_of_freedom: found.value.and(found.degrees_of_freedom),
            coverage_factor: found.value.map(|_| found.coverage_factor()),
        }
    }
}

impl From<&Rms> for RmsEntry {
    fn from(rms: &Rms) -> Self {
        Self {
            um: rms.length_mm.map(|v| v * 1e3),
            urad: rms.angle_rad.map(|v| v * 1e6),
            times_noise: rms.noise,
        }
    }
}
