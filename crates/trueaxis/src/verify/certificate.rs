//! Certificate of a volumetric compensation: the errors, their compensation, the residual errors and their
//! uncertainty.
//!
//! ```text
//!     study.toml ──read_certificate──> Study {machine, uncertainties, compensation, readings, rule}
//!                ──certify──> Certificate {per pose: before, after, predicted ± U, measured ± U; verdict}
//! ```
//!
//! - [`uncertainties`]: the uncertainties of the errors, as independent factors;
//! - [`applied`]: the axis positions with the compensation; [`residual`]: the residual error there, with its
//!   covariance;
//! - [`spread`]: lengths, which are not normally distributed; `decide`: the rule, and the test of the prediction;
//! - [`inputs`]: SHA-256 of every file, so that the certificate can be made again.
//!
//! It follows the topics of ISO/TR 16907 in their order: kinematic representation, errors, determination,
//! compensation, application, validation, documentation. docs/model.md eq. 172 to 177.

pub mod applied;
mod compensation;
mod decide;
mod file;
mod identified;
pub mod inputs;
mod loaded;
pub mod residual;
pub mod spread;
pub mod uncertainties;
mod used;
mod validation;

pub use decide::{Agreement, Decision, Rule, e_n};
pub use file::{Application, Circumstances, Study, read_certificate};
pub use used::UsedPose;
pub(in crate::verify) use used::read_at;
pub use validation::{MeasuredValue, Validation};

use residual::Residual;
use spread::{Lengths, lengths};
use std::f64::consts::TAU;
use trueaxis_geometry::Vec3;
use trueaxis_input::Place;
use trueaxis_machine::axis::{Approach, Axis, AxisKind, Command, Travel};
use trueaxis_machine::compensate::Fault;
use trueaxis_machine::volume::{approaches, commands};
use trueaxis_part::tolerance::Outcome;

/// Poses over the zone beside its corners.
const POSES: u32 = 512;

/// The source of the uncertainties of the errors.
#[derive(Debug, Clone, PartialEq)]
pub enum UncertaintySource {
    /// The machine file states one for each error, independent of each other.
    Stated,
    /// A campaign was evaluated again: with all that its results have in common.
    Campaign {
        /// Its name.
        name: String,
        /// How many readings.
        readings: usize,
        /// How many terms were found.
        terms: usize,
        /// How many were left out, because the readings do not support them: they count as nothing.
        left_out: usize,
        /// The verdict of the identification.
        verdict: String,
    },
}

/// One pose of the validation.
#[derive(Debug, Clone, PartialEq)]
pub struct PoseResult {
    /// What was measured.
    pub measured: MeasuredValue,
    /// What was predicted.
    pub predicted: Residual,
    /// The length of the residual error is below this in 95 % of the machines that the uncertainties of the
    /// errors allow, mm.
    pub within_mm: f64,
    /// Measured against predicted, without and with the compensation. Unit: 1.
    pub e_n: [f64; 2],
    /// The reading against the limit.
    pub outcome: Outcome,
}

impl PoseResult {
    /// Length of the measured tip deviation without and with the compensation, mm.
    pub fn lengths_mm(&self) -> [f64; 2] {
        [self.measured.before_mm.norm(), self.measured.after_mm.norm()]
    }
}

/// The prediction of the identified machine for the zone of the certificate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Volume {
    /// Poses that were evaluated; those that cannot be compensated are left out.
    pub poses: usize,
    /// Root mean square of the tip without and with the compensation, mm.
    pub rms_mm: [f64; 2],
    /// Of |l̂| + k·u along the worst direction, mm.
    pub largest_mm: f64,
    /// Where that is.
    pub at: Command,
}

/// A certificate.
#[derive(Debug, Clone, PartialEq)]
pub struct Certificate {
    /// Pose after pose.
    pub poses: Vec<PoseResult>,
    /// k·u_m of one coordinate of a reading, mm.
    pub expanded_mm: f64,
    /// The distribution of the lengths of all poses.
    pub lengths: Lengths,
    /// Measured root mean square of the tip without and with the compensation, mm.
    pub rms_mm: [f64; 2],
    /// Measured largest.
    pub largest_mm: [f64; 2],
    /// Whether readings and prediction agree, without and with the compensation.
    pub agreement: [Option<Agreement>; 2],
    /// The prediction over the zone.
    pub volume: Volume,
    /// How many poses are inside, outside, or can neither be said to be.
    pub counts: [usize; 3],
    /// The verdict.
    pub outcome: Outcome,
    /// Why, in a sentence.
    pub reason: String,
}

/// A pose that cannot be compensated.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{fault}")]
pub struct PoseFault {
    /// The reading; none for the pose where the instrument was set to zero.
    pub place: Option<Place>,
    /// Why.
    pub fault: Fault,
}

/// An axis is validated over a part of its zone that is less than this: that is remarked on. Unit: 1.
const HALF: f64 = 0.5;

impl Study {
    /// How much of the zone of each axis the poses of the validation reach over; an axis without a zone is not there.
    fn reached(&self) -> Vec<(String, f64)> {
        let share = |(i, axis): (usize, &Axis)| {
            let Travel::Between(from, to) = axis.travel else { return None };
            let at = self.validation.poses.iter().map(|p| p.command[i]);
            let (low, high) = (at.clone().reduce(f64::min)?, at.reduce(f64::max)?);
            // Beyond a whole turn a rotary axis stands as before.
            let turn = if axis.kind == AxisKind::Rotary { TAU } else { f64::INFINITY };
            (to > from).then(|| (axis.name.to_string(), (high - low) / (to - from).min(turn)))
        };
        self.zone.iter().enumerate().filter_map(share).collect()
    }

    /// The axes with a zone that stand at one position in all poses.
    fn axes_at_rest(&self) -> Vec<String> {
        self.reached()
            .into_iter()
            .filter(|(_, share)| *share <= 0.0)
            .map(|(name, _)| name)
            .collect()
    }

    /// The axes of whose zone less than half is validated, each with its part.
    pub fn barely_reached(&self) -> Vec<(String, f64)> {
        self.reached().into_iter().filter(|(_, share)| *share < HALF).collect()
    }
}

/// Evaluates the readings of a study.
///
/// # Errors
/// A pose that the compensation cannot reach, or at which the errors are not known.
pub fn certify(study: &Study) -> Result<Certificate, PoseFault> {
    let left = |command: &Command, approach: &Approach| {
        Residual::at(&study.machine, (&study.known, &study.applied), command, approach)
    };
    let zero = match &study.validation.zero {
        None => None,
        Some(command) => Some(
            left(command, &Approach::default())
                .map_err(|fault| PoseFault { place: None, fault })?,
        ),
    };
    let predicted = study.validation.poses.iter().map(|pose| {
        let place = Some(pose.place.clone());
        let here = left(&pose.command, &pose.approach);
        let here = here.map_err(|fault| PoseFault { place, fault })?;
        Ok(zero.as_ref().map_or_else(|| here.clone(), |zero| here.against(zero)))
    });
    let predicted = predicted.collect::<Result<Vec<Residual>, PoseFault>>()?;
    let lengths = lengths(&predicted, study.sampling);
    let volume = over_the_zone(study, zero.as_ref());
    let poses = judged(study, &predicted, &lengths);
    Ok(concluded(study, poses, lengths, volume))
}

fn judged(study: &Study, predicted: &[Residual], lengths: &Lengths) -> Vec<PoseResult> {
    let (u_mm, decision) = (study.validation.u_mm, study.decision);
    let k = decision.coverage_factor;
    let poses = study.validation.poses.iter().zip(predicted).zip(&lengths.within_mm);
    poses
        .map(|((measured, predicted), within_mm)| {
            let [before, after] = differences(measured, predicted);
            let e_n = [before, after].map(|r| e_n(&r, predicted, u_mm, k));
            PoseResult {
                outcome: decision.judge(measured.after_mm.norm(), k * u_mm),
                measured: measured.clone(),
                predicted: predicted.clone(),
                within_mm: *within_mm,
                e_n,
            }
        })
        .collect()
}

/// Measured less predicted tip without and with the compensation, mm.
fn differences(measured: &MeasuredValue, predicted: &Residual) -> [Vec3; 2] {
    let before = measured.before_mm - predicted.before.tip_mm;
    [before, measured.after_mm - predicted.after.tip_mm]
}

/// Every pose from every side from which an axis with reversal comes; the zero may have been set from any of them.
fn over_the_zone(study: &Study, zero: Option<&Residual>) -> Volume {
    let mut volume = Volume { poses: 0, rms_mm: [0.0; 2], largest_mm: 0.0, at: Command::default() };
    let approaches = approaches(&[&study.machine]);
    let tips = |command: &Command| -> Option<Vec<[Vec3; 2]>> {
        let tools = approaches.iter().map(|approach| {
            let tools = Residual::tools(&study.machine, &study.applied, command, approach);
            tools.map(|both| both.map(|tool| tool.tip_mm)).ok()
        });
        tools.collect()
    };
    let zeros = study.validation.zero.as_ref().and_then(&tips);
    let zeros = zeros.unwrap_or_else(|| vec![[Vec3::zeros(); 2]]);
    let mean = zero.map_or([Vec3::zeros(); 2], |zero| [zero.before.tip_mm, zero.after.tip_mm]);
    let per_pose = approaches.len() as f64;
    for command in commands(&study.zone, POSES) {
        let still = Approach::default();
        let applied = (&study.known, &study.applied);
        let Ok(here) = Residual::at(&study.machine, applied, &command, &still) else { continue };
        let Some(tips) = tips(&command) else { continue };
        let here = zero.map_or_else(|| here.clone(), |zero| here.against(zero));
        let u_mm = here.covariance_mm2().symmetric_eigenvalues().max().max(0.0).sqrt();
        let pairs = tips.iter().flat_map(|tip| zeros.iter().map(|zero| (tip[1] - zero[1]).norm()));
        let most = pairs.fold(0.0, f64::max) + study.decision.coverage_factor * u_mm;
        volume.poses += 1;
        for (state, rms_mm) in volume.rms_mm.iter_mut().enumerate() {
            let squares = tips.iter().map(|tip| (tip[state] - mean[state]).norm_squared());
            *rms_mm += squares.sum::<f64>() / per_pose;
        }
        if most > volume.largest_mm {
            (volume.largest_mm, volume.at) = (most, command);
        }
    }
    volume.rms_mm = volume.rms_mm.map(|sum| (sum / volume.poses.max(1) as f64).sqrt());
    volume
}

fn concluded(
    study: &Study,
    poses: Vec<PoseResult>,
    lengths: Lengths,
    volume: Volume,
) -> Certificate {
    let expanded_mm = study.decision.coverage_factor * study.validation.u_mm;
    let count = |outcome| poses.iter().filter(|p| p.outcome == outcome).count();
    let counts = [Outcome::Pass, Outcome::Fail, Outcome::Undecided].map(count);
    let lists: Vec<&Residual> = poses.iter().map(|p| &p.predicted).collect();
    let agreement = [0, 1].map(|state| {
        let r: Vec<Vec3> =
            poses.iter().map(|p| differences(&p.measured, &p.predicted)[state]).collect();
        Agreement::of(&r, &lists, study.validation.u_mm)
    });
    let over = |state: usize| poses.iter().map(move |p| p.lengths_mm()[state]);
    let mean = |state| {
        let squares: f64 = over(state).map(|d| d * d).sum();
        (squares / poses.len().max(1) as f64).sqrt()
    };
    let largest = |state| over(state).fold(0.0, f64::max);
    let (outcome, reason) = verdict(study, &volume, counts, agreement[1]);
    Certificate {
        rms_mm: [mean(0), mean(1)],
        largest_mm: [largest(0), largest(1)],
        poses,
        expanded_mm,
        lengths,
        agreement,
        volume,
        counts,
        outcome,
        reason,
    }
}

/// The poses decide; where readings and prediction disagree, nothing is known about other poses.
fn verdict(
    study: &Study,
    volume: &Volume,
    [pass, fail, open]: [usize; 3],
    agreement: Option<Agreement>,
) -> (Outcome, String) {
    let decision = study.decision;
    let expanded_mm = decision.coverage_factor * study.validation.u_mm;
    let [limit, expanded] = [decision.limit_mm, expanded_mm].map(|v| format!("{:.1} µm", v * 1e3));
    let all = pass + fail + open;
    if fail > 0 {
        return (Outcome::Fail, format!("{fail} of {all} poses are beyond {limit}"));
    }
    if decision.is_blind(expanded_mm) {
        let why = format!(
            "U = {expanded} is not smaller than the limit of {limit}: these readings cannot prove conformity"
        );
        return (Outcome::Undecided, why);
    }
    if open > 0 {
        let why = format!("{open} of {all} poses are nearer to {limit} than U = {expanded}");
        return (Outcome::Undecided, why);
    }
    let still = study.axes_at_rest();
    if !still.is_empty() {
        let why = format!(
            "all {all} poses are within {limit}, but at one position of {}: nothing is known about the rest of the zone",
            still.join(" ")
        );
        return (Outcome::Undecided, why);
    }
    if !agreement.is_some_and(|a| a.holds()) {
        let why = format!(
            "all {all} poses are within {limit}, but not as predicted: the machine is not the identified one, \
             and nothing is known about other poses"
        );
        return (Outcome::Undecided, why);
    }
    let mut why = format!("all {all} poses are within {limit}, and as predicted");
    if volume.largest_mm > decision.limit_mm {
        let most = volume.largest_mm * 1e3;
        why += &format!("; elsewhere in the zone up to {most:.1} µm are not excluded");
    }
    (Outcome::Pass, why)
}
