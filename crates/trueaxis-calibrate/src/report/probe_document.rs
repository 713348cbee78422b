//! The calibration of a probe for programs: `trueaxis/identify-probe/1`.

use super::probe::{Harmonic, form_name, harmonics, is_chosen, um};
use crate::identify::probe::datums::{
    Eccentricity, XyDatum, ZDatum, eccentricity, xy_datum, z_datum,
};
use crate::identify::probe::{Calibration, FreshCheck, Repeats, Score, Spread, Study, TableRow};
use serde::Serialize;
use trueaxis_geometry::Vec3;
use trueaxis_report::JsonSchema;

/// The calibration of a touch probe.
#[derive(Debug, Serialize, JsonSchema)]
pub struct ProbeDocument<'a> {
    /// The results of the first stylus.
    #[serde(flatten)]
    pub first: Option<StylusEntry<'a>>,
    /// Which document this is.
    #[schemars(extend("const" = "trueaxis/identify-probe/1"))]
    pub schema: &'static str,
    /// Name of the study.
    pub name: &'a str,
    /// The dial gauge on the turning ball; null if not measured.
    pub eccentricity: Option<EccentricityEntry>,
    /// The length of the probe; null if not measured.
    pub z_datum: Option<ZDatumEntry>,
    /// The plain calibration with four hits; null if not measured.
    pub xy_datum: Option<XyDatum>,
    /// The results of all styli.
    pub styli: Vec<StylusEntry<'a>>,
}

/// The dial gauge on the turning ball.
#[derive(Debug, Serialize, JsonSchema)]
pub struct EccentricityEntry {
    /// Ball − spindle in x and y, mm.
    pub offset_mm: [f64; 2],
    /// Its standard uncertainties, mm.
    pub u_offset_mm: [f64; 2],
    /// Run-out of the ball, µm.
    pub runout_um: f64,
    /// Root mean square of the residual, µm.
    pub left_rms_um: f64,
}

/// The length of the probe.
#[derive(Debug, Serialize, JsonSchema)]
pub struct ZDatumEntry {
    /// Height of the ring, mm.
    pub ring_top_mm: f64,
    /// Length of the probe, mm.
    pub length_mm: f64,
    /// Its standard uncertainty, mm.
    pub u_length_mm: f64,
    /// Range of the triggers, µm.
    pub range_um: f64,
}

/// The results of one stylus.
#[derive(Debug, Serialize, JsonSchema)]
pub struct StylusEntry<'a> {
    /// Its name.
    pub stylus: &'a str,
    /// Range of the radii as measured, µm.
    pub range_before_um: f64,
    /// The same with only the offset corrected, µm.
    pub range_offset_only_um: f64,
    /// The same corrected, µm.
    pub range_after_um: f64,
    /// The same corrected, directions held out, µm.
    pub range_held_out_um: f64,
    /// Root mean square as measured, µm.
    pub rms_before_um: f64,
    /// The same corrected, µm.
    pub rms_after_um: f64,
    /// The same corrected, directions held out, µm.
    pub rms_held_out_um: f64,
    /// The least and the greatest measured radius, mm.
    pub radius_before_mm: [f64; 2],
    /// Ball − spindle with the spindle at 0, mm; null if not observable.
    pub offset_mm: Option<Vec<f64>>,
    /// Its standard uncertainties, mm.
    pub u_offset_mm: Option<Vec<f64>>,
    /// Centre of the gauge, mm.
    pub centre_mm: Vec<f64>,
    /// Whether that is stated.
    pub centre_known: bool,
    /// By how much an offset from four hits alone differs, µm.
    pub four_hit_bias_um: [f64; 2],
    /// The model of the pre-travel: `fourier` or `spline`.
    pub model: &'static str,
    /// Its highest harmonic, or its number of knots.
    pub size: usize,
    /// Harmonics of the pre-travel; the first is part of the offset.
    pub harmonics: Vec<HarmonicEntry>,
    /// The sizes of model that were tried.
    pub scores: Vec<ProbeScoreEntry>,
    /// Number of hits.
    pub hits: usize,
    /// Standard deviation of one hit, µm.
    pub s_um: f64,
    /// Degrees of freedom of the fit.
    pub degrees_of_freedom: usize,
    /// Factor from u to U (95 %). Unit: 1.
    pub coverage_factor: f64,
    /// Orientations of the spindle, degrees.
    pub orientations_deg: Vec<f64>,
    /// Widest gap between directions, degrees.
    pub widest_gap_deg: f64,
    /// Repeated hits; null if there are none.
    pub repeatability: Option<RepeatsEntry>,
    /// Form error after ISO 230-10; null if the hits do not allow it.
    pub iso230_10: Option<FormEntry>,
    /// Fresh hits that were not used in the fit; null if there are none.
    pub check: Option<FreshCheckEntry>,
    /// Orientation of the spindle for the table below, degrees.
    pub table_orientation_deg: f64,
    /// Deviations by direction of motion.
    pub table: Vec<DirectionEntry>,
    /// Deviation of each hit as measured, µm.
    pub deviations_um: Vec<f64>,
    /// Residual of each hit, µm.
    pub left_um: Vec<f64>,
    /// Residual of each hit, its direction held out, µm.
    pub held_out_um: Vec<f64>,
}

/// A harmonic of the pre-travel.
#[derive(Debug, Serialize, JsonSchema)]
pub struct HarmonicEntry {
    /// Its order.
    pub order: usize,
    /// Power of the sine of the latitude (spheres).
    pub axial: usize,
    /// Its amplitude, µm.
    pub amplitude_um: f64,
    /// Direction of its first lobe, degrees.
    pub phase_deg: f64,
    /// Its cosine term, µm.
    pub cosine_um: f64,
    /// Its sine term, µm.
    pub sine_um: f64,
    /// Standard uncertainty of each of the two, µm.
    pub u_um: f64,
}

/// One size of model.
#[derive(Debug, Serialize, JsonSchema)]
pub struct ProbeScoreEntry {
    /// `fourier` or `spline`.
    pub model: &'static str,
    /// Its highest harmonic, or its number of knots.
    pub size: usize,
    /// Number of its parameters.
    pub parameters: usize,
    /// Root mean square of the residual in sample, µm.
    pub rms_in_um: f64,
    /// The same with directions held out, µm.
    pub rms_held_out_um: f64,
    /// Whether it was chosen.
    pub chosen: bool,
}

/// Repeated hits.
#[derive(Debug, Serialize, JsonSchema)]
pub struct RepeatsEntry {
    /// Number of directions with repeated hits.
    pub directions: usize,
    /// Their standard deviation, µm.
    pub s_um: f64,
    /// Their largest range, µm.
    pub range_um: f64,
}

/// A form error after ISO 230-10.
#[derive(Debug, Serialize, JsonSchema)]
pub struct FormEntry {
    /// Its symbol.
    pub figure: &'static str,
    /// The number of hits that the standard asks for.
    pub hits_of_the_standard: usize,
    /// As measured, µm.
    pub before_um: f64,
    /// Corrected, µm.
    pub after_um: f64,
    /// Whether the clause was checked in the text of the standard.
    pub checked_on_the_page: bool,
}

/// Fresh hits that were not used in the fit.
#[derive(Debug, Serialize, JsonSchema)]
pub struct FreshCheckEntry {
    /// Number of hits.
    pub hits: usize,
    /// As measured.
    pub before: SpreadEntry,
    /// Corrected.
    pub after: SpreadEntry,
    /// Share of the hits within U (95 %), 0 to 1. Unit: 1.
    #[serde(rename = "within_U")]
    pub within_expanded: f64,
}

/// The spread of radii.
#[derive(Debug, Serialize, JsonSchema)]
pub struct SpreadEntry {
    /// Greatest − least, µm.
    pub range_um: f64,
    /// Root mean square, µm.
    pub rms_um: f64,
}

/// The deviation in one direction of motion.
#[derive(Debug, Serialize, JsonSchema)]
pub struct DirectionEntry {
    /// The direction of motion, degrees.
    pub angle_deg: f64,
    /// Deviation along it, µm.
    #[serde(rename = "dR_um")]
    pub radial_um: f64,
    /// Its part in X, µm.
    #[serde(rename = "dX_um")]
    pub x_um: f64,
    /// Its part in Y, µm.
    #[serde(rename = "dY_um")]
    pub y_um: f64,
    /// Its standard uncertainty, µm.
    pub u_um: f64,
}

impl<'a> ProbeDocument<'a> {
    /// The document of a study with the calibration of each stylus.
    pub fn of(study: &'a Study, all: &'a [Calibration]) -> Self {
        let dial = study.eccentricity.as_ref().and_then(eccentricity);
        Self {
            first: all.first().map(|found| StylusEntry::of(study, found)),
            schema: "trueaxis/identify-probe/1",
            name: &study.name,
            eccentricity: dial.as_ref().map(EccentricityEntry::from),
            z_datum: study.z_datum.as_ref().map(|z| ZDatumEntry::from(&z_datum(z))),
            xy_datum: study.xy_datum.as_ref().map(xy_datum),
            styli: all.iter().map(|found| StylusEntry::of(study, found)).collect(),
        }
    }
}

impl<'a> StylusEntry<'a> {
    fn of(study: &Study, found: &'a Calibration) -> Self {
        let known = |v: Vec3, n: usize| v.iter().take(n).copied().collect::<Vec<f64>>();
        let all = |values: &[f64]| values.iter().map(|d| um(*d)).collect();
        let orientation = found.orientations_rad.first().copied().unwrap_or(0.0);
        let table = found.table(study.table_steps, orientation);
        Self {
            stylus: &found.stylus,
            range_before_um: um(found.before.range_mm),
            range_offset_only_um: um(found.offset_only.range_mm),
            range_after_um: um(found.after.range_mm),
            range_held_out_um: um(found.held_out.range_mm),
            rms_before_um: um(found.before.rms_mm),
            rms_after_um: um(found.after.rms_mm),
            rms_held_out_um: um(found.held_out.rms_mm),
            radius_before_mm: radii(found),
            offset_mm: found.offset.map(|o| known(o.value_mm, o.coordinates)),
            u_offset_mm: found.offset.map(|o| known(o.u_mm, o.coordinates)),
            centre_mm: known(found.fit.centre_mm, found.gauge.dimensions()),
            centre_known: found.gauge.centre_mm.is_some(),
            four_hit_bias_um: found.four_hit_bias_mm().map(um),
            model: found.fit.lobing.model.name(),
            size: found.fit.lobing.size,
            harmonics: harmonics(found).iter().map(HarmonicEntry::from).collect(),
            scores: found.scores.iter().map(|s| score(found, s)).collect(),
            hits: found.before_mm.len(),
            s_um: um(found.fit.s_mm()),
            degrees_of_freedom: found.fit.freedom(),
            coverage_factor: found.coverage_factor,
            orientations_deg: found.orientations_rad.iter().map(|o| o.to_degrees()).collect(),
            widest_gap_deg: found.gap_rad.to_degrees(),
            repeatability: found.repeats.as_ref().map(RepeatsEntry::from),
            iso230_10: form(found),
            check: found.check.as_ref().map(FreshCheckEntry::from),
            table_orientation_deg: orientation.to_degrees(),
            table: table.iter().map(DirectionEntry::from).collect(),
            deviations_um: all(&found.before_mm),
            left_um: all(&found.fit.left_mm),
            held_out_um: all(&found.fit.held_out_mm),
        }
    }
}

/// The least and the greatest measured radius, mm.
fn radii(found: &Calibration) -> [f64; 2] {
    let sign = found.gauge.side.sign();
    let radius = |d: &f64| found.gauge.radius_mm + sign * d;
    let all = || found.before_mm.iter().map(radius);
    [all().fold(f64::INFINITY, f64::min), all().fold(f64::NEG_INFINITY, f64::max)]
}

fn form(found: &Calibration) -> Option<FormEntry> {
    let (figure, hits_of_the_standard) = form_name(found);
    found.form.map(|form| FormEntry {
        figure,
        hits_of_the_standard,
        before_um: um(form.before_mm),
        after_um: um(form.after_mm),
        checked_on_the_page: false,
    })
}

fn score(found: &Calibration, score: &Score) -> ProbeScoreEntry {
    ProbeScoreEntry {
        model: score.model.name(),
        size: score.size,
        parameters: score.parameters,
        rms_in_um: um(score.in_sample_mm),
        rms_held_out_um: um(score.held_out_mm),
        chosen: is_chosen(found, score),
    }
}

impl From<&Harmonic> for HarmonicEntry {
    fn from(h: &Harmonic) -> Self {
        Self {
            order: h.order,
            axial: h.axial,
            amplitude_um: um(h.amplitude_mm()),
            phase_deg: h.phase_rad().to_degrees(),
            cosine_um: um(h.cosine_mm),
            sine_um: um(h.sine_mm),
            u_um: um(h.u_mm),
        }
    }
}

impl From<&Eccentricity> for EccentricityEntry {
    fn from(e: &Eccentricity) -> Self {
        Self {
            offset_mm: e.offset_mm,
            u_offset_mm: e.u_mm,
            runout_um: um(e.runout_mm),
            left_rms_um: um(e.left_mm),
        }
    }
}

impl From<&ZDatum> for ZDatumEntry {
    fn from(z: &ZDatum) -> Self {
        Self {
            ring_top_mm: z.top_mm,
            length_mm: z.length_mm,
            u_length_mm: z.u_length_mm,
            range_um: um(z.range_mm),
        }
    }
}

impl From<&Repeats> for RepeatsEntry {
    fn from(r: &Repeats) -> Self {
        Self { directions: r.directions, s_um: um(r.s_mm), range_um: um(r.range_mm) }
    }
}

impl From<&FreshCheck> for FreshCheckEntry {
    fn from(check: &FreshCheck) -> Self {
        let spread = |s: &Spread| SpreadEntry { range_um: um(s.range_mm), rms_um: um(s.rms_mm) };
        Self {
            hits: check.deviations_mm.len(),
            before: spread(&check.before),
            after: spread(&check.after),
            within_expanded: check.covered,
        }
    }
}

impl From<&TableRow> for DirectionEntry {
    fn from(row: &TableRow) -> Self {
        let (s, c) = row.direction_rad.sin_cos();
        Self {
            angle_deg: row.direction_rad.to_degrees(),
            radial_um: um(row.deviation_mm),
            x_um: um(row.deviation_mm * c),
            y_um: um(row.deviation_mm * s),
            u_um: um(row.u_mm),
        }
    }
}
