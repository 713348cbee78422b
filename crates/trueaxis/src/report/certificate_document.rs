//! The document `trueaxis/certificate/1`.

use super::certificate::{largest, rule, scope};
use super::trace_document::{MachineEntry, axes};
use crate::verify::certificate::applied::AppliedCompensation;
use crate::verify::certificate::inputs::Input;
use crate::verify::certificate::{
    Agreement, Certificate, Circumstances, PoseResult, Study, UncertaintySource, spread,
};
use serde::Serialize;
use trueaxis_condition::certificate_head::CertificateHead;
use trueaxis_geometry::Vec3;
use trueaxis_machine::Machine;
use trueaxis_machine::axis::Travel;
use trueaxis_machine::describe::shown;
use trueaxis_report::JsonSchema;
use trueaxis_report::Keyed;

/// The certificate of a volumetric compensation.
#[derive(Debug, Serialize, JsonSchema)]
pub struct CertificateDocument<'a> {
    /// Which document this is.
    #[schemars(extend("const" = "trueaxis/certificate/1"))]
    pub schema: &'static str,
    /// The version of TrueAxis.
    pub version: &'static str,
    /// The name of the study.
    pub name: &'a str,
    /// `pass`, `fail` or `undecided`.
    pub verdict: &'static str,
    /// The reason in one sentence.
    pub reason: &'a str,
    /// Number, customer, place, instruments with their certificates; null where they are not stated.
    pub certificate: Option<&'a CertificateHead>,
    /// The machine.
    pub machine: MachineEntry<'a>,
    /// Its identified errors.
    pub errors: Vec<CertifiedErrorEntry>,
    /// How they were determined.
    pub determination: DeterminationEntry<'a>,
    /// How they are compensated.
    pub compensation: CompensationEntry<'a>,
    /// How the compensation was put into the control.
    pub application: ApplicationEntry<'a>,
    /// The measurement with the compensation in effect, at poses that the determination did not use.
    pub validation: ValidationEntry<'a>,
    /// The prediction for the zone in which the certificate holds.
    pub zone: ZoneEntry,
    /// The decision.
    pub decision: DecisionEntry,
    /// Every file that was read.
    pub inputs: Vec<FileEntry<'a>>,
}

/// An identified error: `value_at_0_um`, its value at position 0 of its axis, and `u_um`, its largest standard
/// uncertainty, µm; `…_urad`, µrad, of an angle.
#[derive(Debug, Serialize, JsonSchema)]
pub struct CertifiedErrorEntry {
    /// Its ISO 230-1 name.
    pub error: String,
    /// Value and uncertainty; null where they are not stated.
    #[serde(flatten)]
    pub values: Keyed<Option<f64>>,
}

/// Who measured when with what.
#[derive(Debug, Serialize, JsonSchema)]
pub struct CircumstancesEntry<'a> {
    /// The method in words.
    pub method: &'a str,
    /// The date, as written.
    pub date: &'a str,
    /// Who measured.
    pub by: &'a str,
    /// The instrument.
    pub instrument: &'a str,
    /// Its calibration.
    pub calibration: &'a str,
    /// The temperature. Unit: °C.
    pub temperature_c: f64,
    /// Its standard uncertainty; null if it is not stated. Unit: K.
    pub u_temperature_c: Option<f64>,
}

/// How the errors were determined.
#[derive(Debug, Serialize, JsonSchema)]
pub struct DeterminationEntry<'a> {
    /// Who, when, with what.
    #[serde(flatten)]
    pub circumstances: CircumstancesEntry<'a>,
    /// The source of their uncertainties: `machine file`, or a campaign of measurements.
    pub uncertainties_from: SourceEntry<'a>,
    /// How many poses were used.
    pub poses_used: usize,
}

/// The source of the uncertainties.
#[derive(Debug, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum SourceEntry<'a> {
    /// `machine file`: each error independent of the others.
    Stated(&'static str),
    /// A campaign that was evaluated again, with all correlations.
    Campaign {
        /// Its name.
        campaign: &'a str,
        /// How many readings.
        readings: usize,
        /// How many terms were found.
        terms: usize,
        /// How many terms were left out because the readings do not support them.
        left_out: usize,
        /// The verdict of the identification.
        verdict: &'a str,
    },
}

/// How the errors are compensated.
#[derive(Debug, Serialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "lowercase")]
pub enum CompensationEntry<'a> {
    /// In the NC program.
    Program {
        /// What of each pose: `position` or `position and orientation`.
        scope: &'static str,
        /// The files of the compensation.
        files: Vec<FileEntry<'a>>,
    },
    /// By tables of the control.
    Tables {
        /// Their form.
        target: &'static str,
        /// How many.
        tables: usize,
        /// The files of the compensation.
        files: Vec<FileEntry<'a>>,
    },
}

/// A file with its hash.
#[derive(Debug, Serialize, JsonSchema)]
pub struct FileEntry<'a> {
    /// What it is.
    pub role: &'static str,
    /// Its name, relative to the study.
    pub name: &'a str,
    /// Its SHA-256, hexadecimal.
    pub sha256: &'a str,
}

/// How the compensation was put into the control.
#[derive(Debug, Serialize, JsonSchema)]
pub struct ApplicationEntry<'a> {
    /// In words.
    pub method: Option<&'a str>,
    /// The date, as written.
    pub date: Option<&'a str>,
    /// Who did it.
    pub by: Option<&'a str>,
    /// The folder with what the control has loaded; null if that was not compared.
    pub loaded: Option<&'a str>,
}

/// The measurement with the compensation in effect.
#[derive(Debug, Serialize, JsonSchema)]
pub struct ValidationEntry<'a> {
    /// Who, when, with what.
    #[serde(flatten)]
    pub circumstances: CircumstancesEntry<'a>,
    /// Where the instrument was set to zero, mm and degrees; null if it was not.
    pub zero: Option<Keyed<f64>>,
    /// Standard uncertainty of one coordinate of a reading, µm.
    pub u_um: f64,
    /// Expanded uncertainty U = k·u of one coordinate of a reading, µm.
    pub expanded_um: f64,
    /// Root mean square of the tip deviation, µm.
    pub rms_um: StatesEntry<f64>,
    /// Largest tip deviation, µm.
    pub largest_um: StatesEntry<f64>,
    /// What was predicted.
    pub predicted: PredictedEntry,
    /// Whether readings and prediction agree.
    pub agreement: StatesEntry<Option<AgreementEntry>>,
    /// The poses.
    pub poses: Vec<CertifiedPoseEntry>,
}

/// A figure without and with the compensation.
#[derive(Debug, Serialize, JsonSchema)]
pub struct StatesEntry<T> {
    /// Without the compensation.
    pub before: T,
    /// With it.
    pub after: T,
}

/// The prediction of the residual error at the poses of the validation.
#[derive(Debug, Serialize, JsonSchema)]
pub struct PredictedEntry {
    /// All poses together are below this with the probability `share`, µm.
    pub largest_within_um: f64,
    /// Root mean square, µm.
    pub rms_um: f64,
    /// The probability. Unit: 1.
    pub share: f64,
    /// Monte Carlo samples.
    pub samples: usize,
    /// Their random seed.
    pub seed: u64,
}

/// A χ² test of readings against the prediction.
#[derive(Debug, Serialize, JsonSchema)]
pub struct AgreementEntry {
    /// χ² of the readings. Unit: 1.
    pub chi_square: f64,
    /// How many numbers.
    pub numbers: usize,
    /// The value that chance exceeds once in a hundred times. Unit: 1.
    pub limit: f64,
    /// Whether χ² is within it.
    pub holds: bool,
}

/// A pose of the validation.
#[derive(Debug, Serialize, JsonSchema)]
pub struct CertifiedPoseEntry {
    /// Its line in the table of readings.
    pub line: usize,
    /// The positions of the axes, mm and degrees.
    pub at: Keyed<f64>,
    /// The side of approach by axis, +1 or −1, where it is stated.
    pub approach: Keyed<f64>,
    /// Measured deviation of the tip without the compensation, µm.
    pub before_um: [f64; 3],
    /// With it, µm.
    pub after_um: [f64; 3],
    /// Predicted deviation of the tip without the compensation, µm.
    pub predicted_before_um: [f64; 3],
    /// With it, µm.
    pub predicted_after_um: [f64; 3],
    /// Expanded uncertainty of the prediction, µm.
    pub expanded_predicted_um: [f64; 3],
    /// Predicted deviation of the tool axis with the compensation, µrad.
    pub predicted_axis_urad: [f64; 3],
    /// Its expanded uncertainty, µrad.
    pub expanded_axis_urad: [f64; 3],
    /// Length of `before_um`, µm.
    pub length_before_um: f64,
    /// Length of `after_um`, µm.
    pub length_after_um: f64,
    /// The predicted length is below this with 95 %, µm.
    pub predicted_within_um: f64,
    /// |measured − predicted| over its expanded uncertainty, of the worst coordinate.
    #[serde(rename = "E_n")]
    pub e_n: StatesEntry<f64>,
    /// `pass`, `fail` or `undecided`.
    pub verdict: &'static str,
}

/// The prediction for the zone in which the certificate holds.
#[derive(Debug, Serialize, JsonSchema)]
pub struct ZoneEntry {
    /// The ends by axis, mm or degrees.
    pub ends: Keyed<[f64; 2]>,
    /// How many poses were evaluated.
    pub poses: usize,
    /// Root mean square of the tip deviation without the compensation, µm.
    pub rms_before_um: f64,
    /// With it, µm.
    pub rms_after_um: f64,
    /// The largest with its uncertainty, µm.
    pub largest_um: f64,
    /// The positions of the axes there, mm and degrees.
    pub at: Keyed<f64>,
}

/// The decision.
#[derive(Debug, Serialize, JsonSchema)]
pub struct DecisionEntry {
    /// The rule in words.
    pub rule: String,
    /// The limit of the tip deviation, µm.
    pub limit_um: f64,
    /// The coverage factor k of U = k·u. Unit: 1.
    pub coverage_factor: f64,
    /// How many poses pass.
    pub pass: usize,
    /// How many fail.
    pub fail: usize,
    /// How many are neither.
    pub undecided: usize,
}

impl<'a> CertificateDocument<'a> {
    /// The document of a certificate.
    pub fn of(study: &'a Study, certificate: &'a Certificate) -> Self {
        let (machine, applied) = (&study.machine, &study.application);
        let [pass, fail, undecided] = certificate.counts;
        Self {
            schema: "trueaxis/certificate/1",
            version: trueaxis_report::VERSION,
            name: &study.name,
            verdict: certificate.outcome.word(),
            reason: &certificate.reason,
            certificate: study.head.as_ref(),
            machine: MachineEntry { name: machine.name(), chain: machine.chain_text() },
            errors: error_entries(machine),
            determination: DeterminationEntry {
                circumstances: CircumstancesEntry::from(&study.determination),
                uncertainties_from: SourceEntry::from(&study.determined),
                poses_used: study.used.len(),
            },
            compensation: CompensationEntry::from(study),
            application: ApplicationEntry {
                method: applied.method.as_deref(),
                date: applied.date.as_deref(),
                by: applied.by.as_deref(),
                loaded: applied.loaded.as_deref(),
            },
            validation: ValidationEntry::of(study, certificate),
            zone: ZoneEntry::of(study, certificate),
            decision: DecisionEntry {
                rule: rule(study),
                limit_um: study.decision.limit_mm * 1e3,
                coverage_factor: study.decision.coverage_factor,
                pass,
                fail,
                undecided,
            },
            inputs: files(&study.inputs),
        }
    }
}

fn error_entries(machine: &Machine) -> Vec<CertifiedErrorEntry> {
    let stated = machine.stated_errors().into_iter();
    let entries = stated.filter_map(|(index, name)| {
        let stated = machine.bodies()[index.body].stated(index.kind, index.component)?;
        let u = stated.u.as_ref().map(largest);
        let (unit, scale) = if name.component.is_rotation() { ("urad", 1e6) } else { ("um", 1e3) };
        let value = stated.at(0.0, 0.0).ok();
        let values = [
            (format!("value_at_0_{unit}"), value.map(|v| v * scale)),
            (format!("u_{unit}"), u.map(|u| u * scale)),
        ];
        Some(CertifiedErrorEntry { error: name.to_string(), values: values.into_iter().collect() })
    });
    entries.collect()
}

fn files(files: &[Input]) -> Vec<FileEntry<'_>> {
    let entries = files.iter();
    entries.map(|i| FileEntry { role: i.role, name: &i.name, sha256: &i.sha256 }).collect()
}

impl<'a> From<&'a Circumstances> for CircumstancesEntry<'a> {
    fn from(c: &'a Circumstances) -> Self {
        Self {
            method: &c.method,
            date: &c.date,
            by: &c.by,
            instrument: &c.instrument,
            calibration: &c.calibration,
            temperature_c: c.temperature_c.value,
            u_temperature_c: c.temperature_c.u,
        }
    }
}

impl<'a> From<&'a UncertaintySource> for SourceEntry<'a> {
    fn from(determined: &'a UncertaintySource) -> Self {
        match determined {
            UncertaintySource::Stated => Self::Stated("machine file"),
            UncertaintySource::Campaign { name, readings, terms, left_out, verdict } => {
                Self::Campaign {
                    campaign: name,
                    readings: *readings,
                    terms: *terms,
                    left_out: *left_out,
                    verdict,
                }
            }
        }
    }
}

impl<'a> From<&'a Study> for CompensationEntry<'a> {
    fn from(study: &'a Study) -> Self {
        let files = files(&study.application.files);
        match &study.applied {
            AppliedCompensation::Program(compensator) => {
                Self::Program { scope: scope(compensator.scope()), files }
            }
            AppliedCompensation::Tables { compiled, control, .. } => {
                Self::Tables { target: control.key(), tables: compiled.tables.len(), files }
            }
        }
    }
}

/// A figure without and with the compensation.
fn states<T, U>([before, after]: [T; 2], of: impl Fn(T) -> U) -> StatesEntry<U> {
    StatesEntry { before: of(before), after: of(after) }
}

impl<'a> ValidationEntry<'a> {
    fn of(study: &'a Study, certificate: &Certificate) -> Self {
        let v = &study.validation;
        let um = |mm: f64| mm * 1e3;
        Self {
            circumstances: CircumstancesEntry::from(&v.circumstances),
            zero: v.zero.map(|zero| axes(&study.machine, &zero)),
            u_um: um(v.u_mm),
            expanded_um: um(certificate.expanded_mm),
            rms_um: states(certificate.rms_mm, um),
            largest_um: states(certificate.largest_mm, um),
            predicted: PredictedEntry {
                largest_within_um: um(certificate.lengths.largest_within_mm),
                rms_um: um(certificate.lengths.rms_mm),
                share: spread::SHARE,
                samples: study.sampling.samples,
                seed: study.sampling.seed,
            },
            agreement: states(certificate.agreement, |a| a.map(AgreementEntry::from)),
            poses: certificate.poses.iter().map(|p| CertifiedPoseEntry::of(study, p)).collect(),
        }
    }
}

impl From<Agreement> for AgreementEntry {
    fn from(a: Agreement) -> Self {
        Self { chi_square: a.chi_square, numbers: a.numbers, limit: a.limit, holds: a.holds() }
    }
}

impl CertifiedPoseEntry {
    fn of(study: &Study, p: &PoseResult) -> Self {
        let k = study.decision.coverage_factor;
        let um = |vector: &Vec3| <[f64; 3]>::from(vector * 1e3);
        let [length_before_um, length_after_um] = p.lengths_mm().map(|d| d * 1e3);
        let sides = study.machine.axes().iter().zip(p.measured.approach);
        let sides = sides.filter(|(_, side)| *side != 0.0);
        Self {
            line: p.measured.place.line,
            at: axes(&study.machine, &p.measured.command),
            approach: sides.map(|(axis, side)| (axis.name.to_string(), side)).collect(),
            before_um: um(&p.measured.before_mm),
            after_um: um(&p.measured.after_mm),
            predicted_before_um: um(&p.predicted.before.tip_mm),
            predicted_after_um: um(&p.predicted.after.tip_mm),
            expanded_predicted_um: um(&(p.predicted.u_mm() * k)),
            predicted_axis_urad: (p.predicted.after.axis * 1e6).into(),
            expanded_axis_urad: (p.predicted.u_axis() * (k * 1e6)).into(),
            length_before_um,
            length_after_um,
            predicted_within_um: p.within_mm * 1e3,
            e_n: states(p.e_n, |e| e),
            verdict: p.outcome.word(),
        }
    }
}

impl ZoneEntry {
    fn of(study: &Study, certificate: &Certificate) -> Self {
        let volume = &certificate.volume;
        let ends = study.zone.iter().filter_map(|axis| match axis.travel {
            Travel::Between(from, to) => {
                Some((axis.name.to_string(), [shown(axis, from), shown(axis, to)]))
            }
            _ => None,
        });
        Self {
            ends: ends.collect(),
            poses: volume.poses,
            rms_before_um: volume.rms_mm[0] * 1e3,
            rms_after_um: volume.rms_mm[1] * 1e3,
            largest_um: volume.largest_mm * 1e3,
            at: axes(&study.machine, &volume.at),
        }
    }
}
