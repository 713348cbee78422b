//! The document `trueaxis/verify-part/1`.

use super::part::{predicted_at, prediction_words, rule};
use crate::verify::part::{IndexComparison, PartResult, PartSections, PartStudy};
use serde::Serialize;
use trueaxis_part::testpiece::PartSection;
use trueaxis_report::JsonSchema;

/// Measured test pieces against their tolerances and their prediction.
#[derive(Debug, Serialize, JsonSchema)]
pub struct VerifyPartDocument<'a> {
    /// Which document this is.
    #[schemars(extend("const" = "trueaxis/verify-part/1"))]
    pub schema: &'static str,
    /// The name of the file.
    pub name: &'a str,
    /// The test piece.
    pub test_piece: &'a str,
    /// What the prediction is.
    pub prediction: String,
    /// How many parts were measured.
    pub parts: usize,
    /// The coverage factor k of U = k·u. Unit: 1.
    pub coverage_factor: f64,
    /// The decision rule in words.
    pub rule: String,
    /// `pass`, `fail` or `undecided`: the parts against their tolerances.
    pub verdict: &'static str,
    /// Why, in a sentence.
    pub reason: &'a str,
    /// Whether the parts were measured in the frame of the best fit.
    pub best_fit: bool,
    /// Index after index.
    pub indices: Vec<PartIndexEntry<'a>>,
    /// The circles of every section of every part that was measured by points.
    pub sections: Vec<PartSectionEntry<'a>>,
    /// What the reader of the numbers should know.
    pub warnings: &'a [String],
}

/// One index.
#[derive(Debug, Serialize, JsonSchema)]
pub struct PartIndexEntry<'a> {
    /// Its key.
    pub index: &'static str,
    /// Whether it decides.
    pub decisive: bool,
    /// The predicted value, mm.
    pub predicted_mm: Option<f64>,
    /// Its standard uncertainty, mm; null if not stated.
    pub u_predicted_mm: Option<f64>,
    /// What the noise of the points adds to the predicted index on average, mm; 0 if not known.
    pub noise_mm: f64,
    /// Part after part, mm.
    pub measured_mm: Vec<f64>,
    /// Their standard uncertainties, mm; null if not stated.
    pub u_measured_mm: Option<Vec<f64>>,
    /// Mean of the parts, mm.
    pub mean_mm: Option<f64>,
    /// Its standard uncertainty with the spread of the parts, mm.
    pub u_mean_mm: Option<f64>,
    /// Predicted over measured mean (Fig 20 of Wu et al. 2022), %.
    pub ratio_percent: Option<f64>,
    /// The same with the mean that the sheet prints, %; null if it prints none.
    pub printed_ratio_percent: Option<f64>,
    /// |measured mean − predicted| over its expanded uncertainty; null where that is 0. Unit: 1.
    pub e_n: Option<f64>,
    /// Whether both agree within their uncertainties.
    pub agrees: Option<bool>,
    /// Its limit, mm.
    pub tolerance_mm: Option<f64>,
    /// Part after part `pass`, `fail` or `undecided`, where there is a limit.
    pub verdicts: Vec<&'static str>,
    /// What else is said about it.
    pub note: &'a str,
}

/// One section of one part.
#[derive(Debug, Serialize, JsonSchema)]
pub struct PartSectionEntry<'a> {
    /// The number of the part, from 1.
    pub part: usize,
    /// The file of its points.
    pub file: &'a str,
    /// Height in the workpiece frame, mm.
    pub z_mm: f64,
    /// Height above the base, mm.
    pub height_mm: f64,
    /// Number of points.
    pub points: usize,
    /// Nominal radius, mm.
    pub nominal_radius_mm: f64,
    /// Radius of the least-squares circle, mm.
    pub radius_mm: f64,
    /// Centre of the least-squares circle, mm.
    pub centre_mm: [f64; 2],
    /// Roundness about it, mm.
    pub roundness_lsc_mm: f64,
    /// Width of the minimum zone, mm.
    pub roundness_mzc_mm: f64,
    /// Width of the predicted minimum zone, mm; null without a study.
    pub predicted_roundness_mzc_mm: Option<f64>,
    /// Azimuth of each point, deg.
    pub azimuth_deg: Vec<f64>,
    /// E of each point, mm; positive: material left.
    pub e_mm: &'a [f64],
}

impl<'a> VerifyPartDocument<'a> {
    /// The document of measured parts.
    pub fn of(task: &'a PartStudy, found: &'a PartResult) -> Self {
        let sections = found.parts.iter().enumerate().flat_map(|(k, part)| {
            part.sections.iter().map(move |s| PartSectionEntry::of(found, (k, part), s))
        });
        Self {
            schema: "trueaxis/verify-part/1",
            name: &task.name,
            test_piece: &task.piece.name,
            prediction: prediction_words(task),
            parts: found.count,
            coverage_factor: task.rule.coverage_factor,
            rule: rule(task),
            verdict: found.outcome.word(),
            reason: &found.reason,
            best_fit: task.is_best_fit(),
            indices: found.indices.iter().map(PartIndexEntry::of).collect(),
            sections: sections.collect(),
            warnings: &found.warnings,
        }
    }
}

impl<'a> PartIndexEntry<'a> {
    fn of(index: &'a IndexComparison) -> Self {
        let agreement = index.agreement;
        let normalised = agreement.map(|a| a.normalised).filter(|n| n.is_finite());
        let u: Vec<f64> = index.measured.iter().map(|m| m.u_mm).collect();
        Self {
            index: index.name.key,
            decisive: index.name.decisive,
            predicted_mm: index.predicted.map(|p| p.0),
            u_predicted_mm: index.predicted.and_then(|p| p.1),
            noise_mm: index.noise_mm,
            measured_mm: index.measured.iter().map(|m| m.value_mm).collect(),
            u_measured_mm: index.u_is_known.then_some(u),
            mean_mm: agreement.map(|a| a.mean_mm),
            u_mean_mm: agreement.map(|a| a.u_mean_mm),
            ratio_percent: agreement.map(|a| a.ratio_percent),
            printed_ratio_percent: index.printed_ratio_percent,
            e_n: normalised,
            agrees: normalised.map(|n| n <= 1.0),
            tolerance_mm: index.limit_mm,
            verdicts: index.outcomes.iter().map(|o| o.word()).collect(),
            note: &index.note,
        }
    }
}

impl<'a> PartSectionEntry<'a> {
    fn of(found: &PartResult, (k, part): (usize, &'a PartSections), s: &'a PartSection) -> Self {
        let c = &s.circles;
        Self {
            part: k + 1,
            file: &part.name,
            z_mm: s.z_mm,
            height_mm: s.height_mm,
            points: s.azimuth_rad.len(),
            nominal_radius_mm: s.radius_mm,
            radius_mm: c.lsc.radius_mm,
            centre_mm: c.lsc.center_mm,
            roundness_lsc_mm: c.lsc.width_mm(),
            roundness_mzc_mm: c.mzc.width_mm(),
            predicted_roundness_mzc_mm: predicted_at(found, s).map(|p| p.circles.mzc.width_mm()),
            azimuth_deg: s.azimuth_rad.iter().map(|a| a.to_degrees()).collect(),
            e_mm: &s.deviation_mm,
        }
    }
}
