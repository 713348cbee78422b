//! A circular test for programs; its keys are fixed in docs/reference/json.md.

use super::diagnosis::DiagnosisEntry;
use crate::iso230_4::{Causes, Circular, PathResult};
use serde::Serialize;
use trueaxis_report::JsonSchema;
use trueaxis_report::Keyed;

const UM: f64 = 1e3;

/// A circular test by ISO 230-4. For each sense (`ccw`, `cw`), the worst of its paths, there are `G_ccw_um`, `F_ccw_max_um` and
/// `F_ccw_min_um`, then the same over all paths: `G_um`, `G_b_um`, `F_max_um`, `F_min_um` and `D_um`.
#[derive(Debug, Serialize, JsonSchema)]
pub struct CircularEntry<'a> {
    /// The two axes.
    pub axes: &'a [String; 2],
    /// The nominal radius, mm; null if none is stated.
    pub radius_mm: Option<f64>,
    /// The centre that deviations are counted from, mm.
    pub centre_mm: [f64; 2],
    /// The circular deviations, µm; null if the readings do not allow them.
    #[serde(flatten)]
    pub deviations: Keyed<Option<f64>>,
    /// Every path.
    pub paths: Vec<PathEntry>,
    /// The causes of the deviations; null if they cannot be separated.
    pub causes: Option<CausesEntry<'a>>,
    /// All causes with uncertainties and shares; null without a whole circle in both directions and its radius.
    pub diagnosis: Option<DiagnosisEntry<'a>>,
}

/// One path of a circular test.
#[derive(Debug, Serialize, JsonSchema)]
pub struct PathEntry {
    /// `ccw` or `cw`.
    pub direction: &'static str,
    /// How many points it has.
    pub points: usize,
    /// The overlap that was left out, degrees.
    pub overlap_left_out_deg: f64,
    /// Circular deviation, µm.
    #[serde(rename = "G_um")]
    pub circular_um: f64,
    /// Largest radial deviation, µm; null without a nominal radius.
    #[serde(rename = "F_max_um")]
    pub radial_max_um: Option<f64>,
    /// Smallest radial deviation, µm; null without a nominal radius.
    #[serde(rename = "F_min_um")]
    pub radial_min_um: Option<f64>,
    /// Mean radial deviation, µm; null without a nominal radius.
    pub mean_radial_um: Option<f64>,
    /// Centre of the least-squares circle, mm.
    pub centre_mm: [f64; 2],
    /// Its radius, mm.
    pub mean_radius_mm: f64,
}

/// The causes of the deviations of a circular test, by least squares.
#[derive(Debug, Serialize, JsonSchema)]
pub struct CausesEntry<'a> {
    /// Reversal error of each axis, µm.
    pub backlash_um: Keyed<f64>,
    /// Scale of the first axis − that of the second, over the diameter, µm.
    pub scale_mismatch_um: f64,
    /// Squareness, positive if closer than 90°, µrad; null if one sense alone cannot separate it.
    pub squareness_urad: Option<f64>,
    /// Servo mismatch, counterclockwise along +45°, µm; null if one sense alone cannot separate it.
    pub servo_mismatch_um: Option<f64>,
    /// Squareness and servo mismatch together, µm; null if they are separated.
    pub diagonal_ellipse_um: Option<f64>,
    /// The centre, µm.
    pub centre_um: [f64; 2],
    /// The spikes at the reversals.
    pub spikes: Vec<SpikeEntry<'a>>,
    /// Root mean square of the residuals, µm.
    pub residual_rms_um: f64,
}

/// A spike after a reversal.
#[derive(Debug, Serialize, JsonSchema)]
pub struct SpikeEntry<'a> {
    /// The axis that reverses.
    pub axis: &'a str,
    /// Where on the circle, degrees.
    pub at_deg: f64,
    /// `ccw` or `cw`.
    pub direction: &'static str,
    /// Largest residual after the reversal, outward positive, µm.
    pub height_um: f64,
}

impl<'a> From<&'a Circular> for CircularEntry<'a> {
    fn from(c: &'a Circular) -> Self {
        let mut deviations = Vec::new();
        let mut put = |key: String, mm: Option<f64>| deviations.push((key, mm.map(|v| v * UM)));
        for sense in c.senses() {
            let (word, worst) = (sense.word(), c.worst(Some(sense)));
            put(format!("G_{word}_um"), worst.map(|w| w.g_mm));
            put(format!("F_{word}_max_um"), worst.and_then(|w| w.f_mm).map(|f| f[0]));
            put(format!("F_{word}_min_um"), worst.and_then(|w| w.f_mm).map(|f| f[1]));
        }
        let worst = c.worst(None);
        put("G_um".to_owned(), worst.map(|w| w.g_mm));
        put("G_b_um".to_owned(), c.g_both_mm);
        put("F_max_um".to_owned(), worst.and_then(|w| w.f_mm).map(|f| f[0]));
        put("F_min_um".to_owned(), worst.and_then(|w| w.f_mm).map(|f| f[1]));
        put("D_um".to_owned(), c.d_mm);
        Self {
            axes: &c.axes,
            radius_mm: c.radius_mm,
            centre_mm: c.centre_mm,
            deviations: Keyed(deviations),
            paths: c.paths.iter().map(PathEntry::from).collect(),
            causes: c.causes.as_ref().map(|causes| CausesEntry::of(c, causes)),
            diagnosis: c.diagnosis.as_ref().map(|found| DiagnosisEntry::of(c, found)),
        }
    }
}

impl From<&PathResult> for PathEntry {
    fn from(p: &PathResult) -> Self {
        Self {
            direction: p.path.sense.word(),
            points: p.path.points_mm.len(),
            overlap_left_out_deg: p.path.overlap_rad.to_degrees(),
            circular_um: p.g_mm * UM,
            radial_max_um: p.f_mm.map(|f| f[0] * UM),
            radial_min_um: p.f_mm.map(|f| f[1] * UM),
            mean_radial_um: p.mean_radial_mm.map(|v| v * UM),
            centre_mm: p.circle.center_mm,
            mean_radius_mm: p.circle.radius_mm,
        }
    }
}

impl<'a> CausesEntry<'a> {
    fn of(c: &'a Circular, causes: &Causes) -> Self {
        let spike = |s: &crate::iso230_4::Spike| SpikeEntry {
            axis: &c.axes[s.axis],
            at_deg: s.at_rad.to_degrees().round(),
            direction: s.sense.word(),
            height_um: s.height_mm * UM,
        };
        let backlash = c.axes.iter().zip(causes.backlash_mm);
        Self {
            backlash_um: backlash.map(|(axis, mm)| (axis.as_str(), mm * UM)).collect(),
            scale_mismatch_um: causes.scale_mismatch_mm * UM,
            squareness_urad: causes.squareness_rad.map(|v| v * 1e6),
            servo_mismatch_um: causes.servo_mismatch_mm.map(|v| v * UM),
            diagonal_ellipse_um: causes.diagonal_ellipse_mm.map(|v| v * UM),
            centre_um: causes.centre_mm.map(|v| v * UM),
            spikes: causes.spikes.iter().map(spike).collect(),
            residual_rms_um: causes.residual_rms_mm * UM,
        }
    }
}
