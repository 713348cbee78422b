//! A test piece that was measured: its indices, the verdict on it, and its prediction.
//!
//! ```text
//!     part.toml ──read_part──> PartStudy {test piece, prediction, points or typed indices, rule}
//!               ──verify_part──> PartResult {per index: predicted ± u, measured ± u, ratio, E_n; verdict}
//! ```
//!
//! The verdict is about the part: every measured index of every part against its tolerance. Whether the prediction
//! agrees is a second answer: the ratio of Fig 20 of Wu et al. 2022, and E_n.

mod file;
mod noise;
mod points;
mod turned;

pub use file::read_part;
pub use points::PartPoints;

use std::path::PathBuf;
use trueaxis_geometry::Vec3;
use trueaxis_part::testpiece::agreement::Agreement;
use trueaxis_part::testpiece::cone::Cone;
use trueaxis_part::testpiece::measured::{MeasuredFault, MeasuredIndex, MeasuredPoint};
use trueaxis_part::testpiece::{IndexName, PartSection};
use trueaxis_part::tolerance::{Acceptance, Outcome, Tolerances};
use trueaxis_part::{Shape, TestPieceFile};
use trueaxis_predict::predict::{DatumAxis, Error, Study, predict};

/// Parts that were measured, and what was predicted for them.
#[derive(Debug)]
pub struct PartStudy {
    /// Its name.
    pub name: String,
    /// The file.
    pub path: PathBuf,
    /// The test piece.
    pub piece: TestPieceFile,
    /// What is allowed.
    pub tolerances: Tolerances,
    /// What was predicted.
    pub prediction: PredictionSource,
    /// What was measured.
    pub measured: Measurements,
    /// The rule of the verdict.
    pub rule: PartRule,
}

/// Where the predicted indices come from.
#[derive(Debug)]
pub enum PredictionSource {
    /// A study, predicted here.
    Study(Box<Study>),
    /// Typed: where they come from, and the values.
    Typed {
        /// Where they come from.
        source: String,
        /// Value and u (if stated) of each index, mm, in the order of the test piece.
        values_mm: Vec<Option<PredictedValue>>,
    },
}

/// A predicted value and its u (if it is known), mm.
pub type PredictedValue = (f64, Option<f64>);

/// What was measured.
#[derive(Debug)]
pub enum Measurements {
    /// Points of a coordinate measuring machine, part after part.
    Points(Box<CmmPoints>),
    /// Indices from its sheet.
    Typed {
        /// Where they come from.
        source: String,
        /// Index after index.
        rows: Vec<TypedRow>,
    },
}

/// Points of one or more parts.
#[derive(Debug)]
pub struct CmmPoints {
    /// Part after part.
    pub parts: Vec<PartPoints>,
    /// Standard uncertainty of a point along the normal, mm.
    pub point_u_mm: f64,
    /// Standard uncertainty of the datum axis at the top face in x and in y, mm.
    pub datum_u_mm: f64,
    /// Standard uncertainty of its direction about x and about y, rad.
    pub datum_tilt_u_rad: f64,
    /// Whether the frame is the one in which the part agrees best with its nominal shape.
    pub best_fit: bool,
    /// How the frame is named in reports.
    pub frame: String,
}

/// One index of the sheet of a measuring machine.
#[derive(Debug, Clone, PartialEq)]
pub struct TypedRow {
    /// Its position among the indices of the test piece.
    pub index: usize,
    /// One value for each part, mm.
    pub values_mm: Vec<f64>,
    /// The mean that the sheet prints, mm.
    pub printed_mean_mm: Option<f64>,
    /// Standard uncertainty of a value, mm.
    pub u_mm: Option<f64>,
    /// What else is said about it.
    pub note: String,
}

/// The rule of the verdict.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PartRule {
    /// ISO 14253-1, or value against limit.
    pub guarded: bool,
    /// k of U = k·u, also of E_n. Unit: 1.
    pub coverage_factor: f64,
}

/// One index: what was predicted, what was measured, and the verdict.
#[derive(Debug, Clone, PartialEq)]
pub struct IndexComparison {
    /// Which one.
    pub name: IndexName,
    /// Predicted value and u (if known), mm.
    pub predicted: Option<PredictedValue>,
    /// Part after part.
    pub measured: Vec<MeasuredIndex>,
    /// Whether u of the measured values is known.
    pub u_is_known: bool,
    /// What the noise of the points adds to the predicted index on average, mm; 0 if it is not known.
    pub noise_mm: f64,
    /// Both together; the ratio without the noise, E_n with it.
    pub agreement: Option<Agreement>,
    /// The ratio with the mean that the sheet prints, if it prints one, %.
    pub printed_ratio_percent: Option<f64>,
    /// Its limit, mm.
    pub limit_mm: Option<f64>,
    /// Part after part, where there is a limit.
    pub outcomes: Vec<Outcome>,
    /// What else is said about it.
    pub note: String,
}

/// One part with its measured sections.
#[derive(Debug, Clone)]
pub struct PartSections {
    /// The file of its points.
    pub name: String,
    /// Number of points.
    pub points: usize,
    /// From the base upwards.
    pub sections: Vec<PartSection>,
    /// Where the best fit has put the frame: shift, mm, and tilt, rad.
    pub best_fit: Option<(Vec3, Vec3)>,
}

/// All that was found out.
#[derive(Debug, Clone)]
pub struct PartResult {
    /// Index after index; those that were neither measured nor judged are left out.
    pub indices: Vec<IndexComparison>,
    /// The measured parts, if points were given.
    pub parts: Vec<PartSections>,
    /// The predicted sections, if a study was given.
    pub predicted: Vec<PartSection>,
    /// The number of parts.
    pub count: usize,
    /// The verdict on the parts.
    pub outcome: Outcome,
    /// Why, in a sentence.
    pub reason: String,
    /// What the reader of the numbers should know.
    pub warnings: Vec<String>,
}

/// Why measured parts cannot be evaluated.
#[derive(Debug, thiserror::Error)]
pub enum PartError {
    /// The prediction.
    #[error("{0}")]
    Prediction(#[from] Error),
    /// The points.
    #[error("{0}")]
    Points(#[from] MeasuredFault),
}

impl PartStudy {
    /// The cone of the test piece.
    pub fn cone(&self) -> &Cone {
        let Shape::Cone(cone) = &self.piece.shape;
        cone
    }
}

/// Evaluates the parts and compares them with their prediction.
///
/// # Errors
/// A study that cannot be predicted, points that cannot be evaluated.
pub fn verify_part(task: &PartStudy) -> Result<PartResult, PartError> {
    let names = task.piece.piece().index_names();
    let (predicted, predicted_sections, mut warnings) = predicted(task)?;
    let (mut measured, parts) = match &task.measured {
        Measurements::Points(points) => of_points(task, points)?,
        Measurements::Typed { rows, .. } => (of_rows(rows, names.len()), Vec::new()),
    };
    if let Measurements::Points(points) = &task.measured {
        let noise = noise::added_mm(task.cone(), &predicted_sections, points)?;
        for (values, noise_mm) in measured.iter_mut().zip(noise) {
            values.noise_mm = noise_mm;
        }
    }
    let typed = measured.iter().map(|m| m.values.len()).max().unwrap_or(0);
    let count = if parts.is_empty() { typed } else { parts.len() };
    let mut indices = Vec::new();
    for (i, name) in names.iter().enumerate() {
        let index = compared(task, name, predicted[i], &measured[i]);
        if !index.measured.is_empty() || (index.limit_mm.is_some() && name.decisive) {
            indices.push(index);
        }
    }
    let (outcome, reason) = verdict(task, &indices, count);
    warnings.extend(remarks(task, &indices));
    warnings.extend(parts.iter().filter_map(|p| turned::remark(p, &predicted_sections)));
    let predicted = predicted_sections;
    Ok(PartResult { indices, parts, predicted, count, outcome, reason, warnings })
}

type Predicted = (Vec<Option<PredictedValue>>, Vec<PartSection>, Vec<String>);

fn predicted(task: &PartStudy) -> Result<Predicted, PartError> {
    match &task.prediction {
        PredictionSource::Typed { values_mm, .. } => {
            Ok((values_mm.clone(), Vec::new(), Vec::new()))
        }
        PredictionSource::Study(study) => {
            let prediction = predict(study, &|_| ())?;
            // Of an index with a kink the larger u counts, as in the verdict of a study.
            let values = prediction.indices.iter().map(|i| {
                let u_mm = i.spread.map_or(i.u_mm, |s| s.u_mm.max(i.u_mm));
                Some((i.value_mm, Some(u_mm)))
            });
            let sections = prediction.sections.into_iter().map(|s| s.section).collect();
            let warnings = prediction.warnings.into_iter().map(|w| format!("prediction: {w}"));
            Ok((values.collect(), sections, warnings.collect()))
        }
    }
}

/// The values of one index.
#[derive(Default)]
struct Values {
    values: Vec<MeasuredIndex>,
    u_is_known: bool,
    printed_mean_mm: Option<f64>,
    noise_mm: f64,
    note: String,
}

fn of_rows(rows: &[TypedRow], count: usize) -> Vec<Values> {
    let mut found: Vec<Values> = (0..count).map(|_| Values::default()).collect();
    for row in rows {
        let u_mm = row.u_mm.unwrap_or(0.0);
        found[row.index] = Values {
            values: row.values_mm.iter().map(|v| MeasuredIndex { value_mm: *v, u_mm }).collect(),
            u_is_known: row.u_mm.is_some(),
            printed_mean_mm: row.printed_mean_mm,
            noise_mm: 0.0,
            note: row.note.clone(),
        };
    }
    found
}

fn of_points(
    task: &PartStudy,
    points: &CmmPoints,
) -> Result<(Vec<Values>, Vec<PartSections>), PartError> {
    let cone = task.cone();
    let names = task.piece.piece().index_names();
    let mut found: Vec<Values> =
        names.iter().map(|_| Values { u_is_known: true, ..Values::default() }).collect();
    let mut parts = Vec::new();
    for part in &points.parts {
        let (fit, places) = match points.best_fit {
            true => {
                let (datum, moved) = cone.best_fit_of(&part.points);
                (Some((datum.shift_mm, datum.tilt_rad)), moved)
            }
            false => (None, part.points.clone()),
        };
        let mut indices = cone.measured(&places, points.point_u_mm)?;
        if !points.best_fit {
            add_datum(cone, &places, points, &mut indices)?;
        }
        for (values, index) in found.iter_mut().zip(indices) {
            values.values.extend(index);
        }
        let sections = cone.measured_sections(&places)?;
        let (name, points) = (part.name.clone(), part.points.len());
        parts.push(PartSections { name, points, sections, best_fit: fit });
    }
    // An index of some parts only is none of all: its mean would be that of others.
    for values in &mut found {
        if values.values.len() < points.parts.len() {
            values.values.clear();
        }
    }
    Ok((found, parts))
}

/// What the uncertainty of the datum axis adds.
///
/// ```text
/// u² += Σ_d ((I(+u_d) − I(−u_d))/2)²        d: shift in x, in y, tilt about x, about y      docs/model.md eq. 211
/// ```
fn add_datum(
    cone: &Cone,
    places: &[MeasuredPoint],
    points: &CmmPoints,
    indices: &mut [Option<MeasuredIndex>],
) -> Result<(), MeasuredFault> {
    let (u, tilt) = (points.datum_u_mm, points.datum_tilt_u_rad);
    let none = Vec3::zeros();
    let motions = [
        (Vec3::new(u, 0.0, 0.0), none),
        (Vec3::new(0.0, u, 0.0), none),
        (none, Vec3::new(tilt, 0.0, 0.0)),
        (none, Vec3::new(0.0, tilt, 0.0)),
    ];
    for (shift, turn) in motions.into_iter().filter(|(s, t)| s.norm() + t.norm() > 0.0) {
        let moved = |sign: f64| {
            let by = |p: &MeasuredPoint| MeasuredPoint {
                place_mm: p.place_mm + (shift + turn.cross(&p.place_mm)) * sign,
                ..*p
            };
            cone.measured(&places.iter().map(by).collect::<Vec<_>>(), 0.0)
        };
        let (up, down) = (moved(1.0)?, moved(-1.0)?);
        for ((index, up), down) in indices.iter_mut().zip(up).zip(down) {
            let (Some(index), Some(up), Some(down)) = (index, up, down) else { continue };
            index.u_mm = index.u_mm.hypot(0.5 * (up.value_mm - down.value_mm));
        }
    }
    Ok(())
}

fn compared(
    task: &PartStudy,
    name: &IndexName,
    predicted: Option<PredictedValue>,
    measured: &Values,
) -> IndexComparison {
    let k = task.rule.coverage_factor;
    let values: Vec<f64> = measured.values.iter().map(|m| m.value_mm).collect();
    let u_mm = measured.values.iter().map(|m| m.u_mm).fold(0.0, f64::max);
    let agreement = predicted.and_then(|(value, u)| {
        let expected_mm = value + measured.noise_mm;
        let found = Agreement::of((expected_mm, u.unwrap_or(0.0)), (&values, u_mm), k)?;
        Some(Agreement { ratio_percent: 100.0 * value / found.mean_mm, ..found })
    });
    let printed = predicted.zip(measured.printed_mean_mm);
    let judged = |m: &MeasuredIndex| {
        let expanded = [k * m.u_mm];
        let acceptance = match task.rule.guarded {
            true => Acceptance::GuardBand { expanded_mm: &expanded },
            false => Acceptance::Simple,
        };
        let verdict = task.tolerances.judge(&[*name], &[m.value_mm], acceptance).ok()?;
        verdict.judgements.first().map(|j| j.outcome)
    };
    IndexComparison {
        name: *name,
        predicted,
        agreement,
        noise_mm: measured.noise_mm,
        u_is_known: measured.u_is_known,
        printed_ratio_percent: printed.map(|((value, _), mean)| 100.0 * value / mean),
        limit_mm: task.tolerances.limit_mm(name.key),
        outcomes: measured.values.iter().filter_map(judged).collect(),
        measured: measured.values.clone(),
        note: measured.note.clone(),
    }
}

/// Whether an index decides: in the best fit the part has no datum.
fn decides(task: &PartStudy, index: &IndexComparison) -> bool {
    let without_datum = task.is_best_fit() && index.name.key.starts_with("coaxiality");
    index.name.decisive && index.limit_mm.is_some() && !without_datum
}

impl PartStudy {
    /// Whether parts and prediction are compared in the frame of the best fit.
    pub fn is_best_fit(&self) -> bool {
        let points = match &self.measured {
            Measurements::Points(points) => points.best_fit,
            Measurements::Typed { .. } => false,
        };
        let study = match &self.prediction {
            PredictionSource::Study(study) => study.reference.datum == DatumAxis::BestFit,
            PredictionSource::Typed { .. } => false,
        };
        points || study
    }
}

fn verdict(task: &PartStudy, indices: &[IndexComparison], count: usize) -> (Outcome, String) {
    let deciding: Vec<_> = indices.iter().filter(|i| decides(task, i)).collect();
    let part = |k: usize| {
        let of = deciding.iter().map(|i| i.outcomes.get(k).copied().unwrap_or(Outcome::Undecided));
        of.fold(Outcome::Pass, |all, one| match (all, one) {
            (Outcome::Fail, _) | (_, Outcome::Fail) => Outcome::Fail,
            (Outcome::Undecided, _) | (_, Outcome::Undecided) => Outcome::Undecided,
            _ => Outcome::Pass,
        })
    };
    let parts: Vec<Outcome> = (0..count).map(part).collect();
    let number = |outcome| parts.iter().filter(|p| **p == outcome).count();
    let (fail, open) = (number(Outcome::Fail), number(Outcome::Undecided));
    let missing: Vec<_> =
        deciding.iter().filter(|i| i.measured.is_empty()).map(|i| i.name.title()).collect();
    let of = if count == 1 { "the part".to_owned() } else { format!("of {count} parts") };
    match (fail, open) {
        _ if deciding.is_empty() || count == 0 => {
            (Outcome::Undecided, "no measured index has a tolerance".to_owned())
        }
        (0, 0) if count == 1 => (Outcome::Pass, "the part is within tolerance".to_owned()),
        (0, 0) => (Outcome::Pass, format!("all {count} parts are within tolerance")),
        (0, _) if !missing.is_empty() => {
            (Outcome::Undecided, format!("not measured: {}", missing.join(", ")))
        }
        (0, _) if count == 1 => {
            (Outcome::Undecided, "a limit lies within U of the part".to_owned())
        }
        (0, _) => (Outcome::Undecided, format!("{of}, a limit lies within U of {open}")),
        _ if count == 1 => (Outcome::Fail, "the part is out of tolerance".to_owned()),
        _ => (Outcome::Fail, format!("{of}, {fail} are out of tolerance")),
    }
}

fn remarks(task: &PartStudy, indices: &[IndexComparison]) -> Vec<String> {
    let mut remarks = Vec::new();
    if task.is_best_fit() {
        remarks.push(
            "the frame is the best fit: coaxiality has no datum there and does not decide"
                .to_owned(),
        );
    }
    for index in indices.iter().filter(|i| i.agreement.is_some()) {
        let u_predicted = index.predicted.and_then(|p| p.1);
        if u_predicted.is_none() || !index.u_is_known {
            remarks.push(format!(
                "{}: u of the {} is not stated and counts as 0 in E_n",
                index.name.title(),
                match (u_predicted, index.u_is_known) {
                    (None, false) => "prediction and of the measurement",
                    (None, true) => "prediction",
                    _ => "measurement",
                }
            ));
        }
    }
    remarks
}
