//! A part of any shape: cut virtually by its program, judged by its drawing.
//!
//! ```text
//! PartStudy { machine, program, part }
//!     program ──simulate──> CutPath: steps of each tool, nominal and actual ──> Sweeps
//!     nominal Sweeps ──> points of the surfaces that the part file leaves to the program
//!     part ──> nails ──cut──> deviation of each point, with the block that made it
//!                     └─ normal of the cutter there × displacement of the tool by each error ──> u, error budget
//!     deviations ──Part::evaluate──> values ──limits──> verdict
//! ```

mod budget;
mod compensated;
mod linear;
mod many;
mod measured;
mod path;
mod programmed;
mod study;

pub use budget::{ErrorEffect, PointEffect, effects};
pub use compensated::{
    Compensated, CompensatedPart, DeviationSource, Deviations, predict_compensated,
    predict_with_deviations,
};
pub use linear::LinearPart;
pub use many::{Drawn, ManyParts, cut_with};
pub use measured::{Measured, Measurement};
pub use path::{CutPath, Origin};
pub use study::{PartStudy, is_part_study, read_part_study};

use super::study::{Decision, errors_without_u};
use trueaxis_cut::{Cut, Nail, Reach, Sweep, cut};
use trueaxis_geometry::Vec3;
use trueaxis_geometry::surface::SurfacePoint;
use trueaxis_input::{Diagnostics, Place};
use trueaxis_machine::errors::ErrorName;
use trueaxis_motion::{Findings, Observer, Progress};
use trueaxis_part::part;
use trueaxis_part::tolerance::Outcome;

/// A characteristic of the part that will be cut.
#[derive(Debug, Clone, PartialEq)]
pub struct PartValue {
    /// Its value on the actual machine, mm.
    pub value_mm: f64,
    /// Standard uncertainty of that by the stated uncertainties of the machine, mm.
    pub u_mm: f64,
    /// By how much it changes with half of the points, mm.
    pub points_mm: f64,
    /// As the measuring machine of the study would find it.
    pub measured: Option<Measured>,
    /// What the program leaves on a machine without errors, mm.
    pub nominal_mm: f64,
    /// How much of the tolerance is used. Unit: 1.
    pub used_ratio: f64,
    /// Whether it is in tolerance.
    pub outcome: Outcome,
    /// What each error does to it, the largest first.
    pub errors: Vec<ErrorEffect>,
}

impl PartValue {
    /// Its combined standard uncertainty: of the machine, of what lies between the points, anywhere within [`PartValue::points_mm`] on
    /// either side (docs/model.md eq. 323), and of the measurement, mm.
    pub fn combined_mm(&self) -> f64 {
        combined_mm(self.u_mm, self.points_mm, self.measured)
    }
}

fn combined_mm(u_mm: f64, points_mm: f64, measured: Option<Measured>) -> f64 {
    u_mm.hypot(points_mm / 3f64.sqrt()).hypot(measured.map_or(0.0, |m| m.u_mm))
}

/// A point of a feature as it was cut.
#[derive(Debug, Clone, PartialEq)]
pub struct CutPoint {
    /// Where it should be, mm.
    pub nominal_mm: Vec3,
    /// Out of the material.
    pub normal: Vec3,
    /// How much material is left along the normal; negative: it is missing, mm.
    pub deviation_mm: f64,
    /// What the program leaves there without errors, mm.
    pub by_program_mm: f64,
    /// The block that cut it.
    pub origin: Origin,
    /// The errors that displace it most, the largest first.
    pub errors: Vec<PointEffect>,
}

/// A feature as it was cut.
#[derive(Debug, Clone, PartialEq)]
pub struct CutFeature {
    /// In the order of the part file.
    pub points: Vec<CutPoint>,
}

/// What was found out about the part.
#[derive(Debug, Clone, PartialEq)]
pub struct PartPrediction {
    /// The part; surfaces that its file leaves to the program have their points.
    pub part: part::Part,
    /// In the order of the part file.
    pub features: Vec<CutFeature>,
    /// In the order of the part file.
    pub values: Vec<PartValue>,
    /// The same on many machines, if the study asks for it.
    pub drawn: Option<ManyParts>,
    /// The same by the compensated program, if it was asked for.
    pub compensated: Option<CompensatedPart>,
    /// Files of the program, by the number in [`Origin`].
    pub programs: Vec<String>,
    /// All characteristics together.
    pub outcome: Outcome,
    /// Errors each of whose corrections alone brings all characteristics into tolerance, the best first; none where they are.
    pub sufficient: Vec<ErrorName>,
    /// Moves that cut, all tools together.
    pub steps: usize,
    /// Errors whose uncertainty is not stated: they add nothing to u.
    pub errors_without_u: Vec<String>,
}

/// Cuts the part of a study and judges it. `progress` is called with the share of the Monte Carlo samples that are done, from any thread;
/// before them with 0 again and again, so that work that is not awaited any more can end there.
///
/// # Errors
/// A program that can't be run, a tool of unknown shape, points that no cutter reaches, points that are cut deeper than
/// their nails reach, a machine whose errors are not known where it cuts.
pub fn predict_part(
    study: &PartStudy,
    progress: &(dyn Fn(f64) + Sync),
    problems: &mut Diagnostics,
) -> Option<PartPrediction> {
    let zero = study.zero(problems)?;
    let mut path = CutPath::new(&study.job, &zero);
    let CutOnce { part, actual: found, by_program, programs } =
        cut_once(study, &mut path, progress, problems)?;
    let nails = nails(&part);
    let place = Place::whole(&study.path.display().to_string());
    let by_program: Vec<f64> = by_program.iter().map(|c| c.deviation_mm).collect();
    let deviations: Vec<f64> = found.iter().map(|c| c.deviation_mm).collect();
    let made = (&nails[..], &found[..]);
    let values = budget::values((study, &part), &path, made, (&deviations, &by_program), progress);
    let budget::Judged { values, drawn, effects } = match values {
        Ok(values) => values,
        Err(why) => {
            problems.error(
                "no-value",
                place,
                why,
                "more points on the feature: a smaller `spacing`",
            );
            return None;
        }
    };
    let all = nails.iter().zip(&found).zip(&by_program).zip(effects);
    let mut points = all.map(|(((nail, cut), by_program), errors)| CutPoint {
        nominal_mm: nail.foot_mm,
        normal: nail.normal,
        deviation_mm: cut.deviation_mm,
        by_program_mm: *by_program,
        origin: path.origin(cut),
        errors,
    });
    let features = part.features.iter();
    let features = features
        .map(|f| CutFeature { points: points.by_ref().take(f.points.len()).collect() })
        .collect();
    let outcome = together(values.iter().map(|v| v.outcome));
    let sufficient = match outcome {
        Outcome::Pass => Vec::new(),
        Outcome::Fail | Outcome::Undecided => budget::sufficient(study, &part, &values),
    };
    Some(PartPrediction {
        features,
        values,
        sufficient,
        drawn,
        compensated: None,
        part,
        programs,
        outcome,
        steps: path.steps(),
        errors_without_u: errors_without_u(&study.mounted),
    })
}

/// A part after its program.
struct CutOnce {
    part: part::Part,
    actual: Vec<Cut>,
    by_program: Vec<Cut>,
    programs: Vec<String>,
}

/// Runs the program, and cuts the part on the actual machine and on one without errors.
fn cut_once(
    study: &PartStudy,
    path: &mut CutPath<'_>,
    progress: &dyn Fn(f64),
    problems: &mut Diagnostics,
) -> Option<CutOnce> {
    let mut told = Progress::through(&study.job.program, |_| progress(0.0));
    let observers: &mut [&mut dyn Observer] = &mut [&mut *path, &mut told];
    let Findings { run, .. } = study.job.run(None, observers);
    let place = Place::whole(&study.path.display().to_string());
    let left_out = run.motion_left_out().count();
    let has_errors = run.problems.has_errors();
    problems.append(run.problems);
    if left_out > 0 && !has_errors {
        let message =
            format!("the program moves the tool by {left_out} functions that are not executed");
        let hint = "the surfaces would be others; the warnings name them";
        problems.error("motion-left-out", place.clone(), message, hint);
    }
    if has_errors || left_out > 0 {
        return None;
    }
    let (actual, nominal) = sweeps(path, place, problems)?;
    progress(0.0);
    let (part, known) = programmed::completed(study, &nominal, problems)?;
    progress(0.0);
    let actual = cut(&actual, &nails(&part));
    progress(0.0);
    let nominal = nominal_cut(&part, &nominal, known);
    let actual = reached(study, &part, &actual, problems)?;
    let by_program = reached(study, &part, &nominal, problems)?;
    Some(CutOnce { part, actual, by_program, programs: run.programs })
}

/// What actual and nominal tools pass through.
fn sweeps(
    path: &CutPath<'_>,
    place: Place,
    problems: &mut Diagnostics,
) -> Option<(Vec<Sweep>, Vec<Sweep>)> {
    let hint = "state diameter and corner_radius of the tool in the set-up file";
    path.sweeps().map_err(|why| problems.error("unknown-cutter", place, why, hint)).ok()
}

/// All characteristics together.
fn together(outcomes: impl Iterator<Item = Outcome>) -> Outcome {
    outcomes.fold(Outcome::Pass, |all, one| match (all, one) {
        (Outcome::Fail, _) | (_, Outcome::Fail) => Outcome::Fail,
        (Outcome::Undecided, _) | (_, Outcome::Undecided) => Outcome::Undecided,
        (Outcome::Pass, Outcome::Pass) => Outcome::Pass,
    })
}

/// What the nominal cut leaves of the nails of each feature, as far as that is not known.
fn nominal_cut(part: &part::Part, nominal: &[Sweep], known: Vec<Option<Vec<Reach>>>) -> Vec<Reach> {
    let unknown = part.features.iter().zip(&known).filter(|(_, known)| known.is_none());
    let nails: Vec<Nail> = unknown.flat_map(|(feature, _)| nails_of(feature)).collect();
    let mut rest = cut(nominal, &nails).into_iter();
    let of = |(feature, known): (&part::Feature, Option<Vec<Reach>>)| {
        known.unwrap_or_else(|| rest.by_ref().take(feature.points.len()).collect())
    };
    part.features.iter().zip(known).flat_map(of).collect()
}

/// A nail on each point.
fn nails(part: &part::Part) -> Vec<Nail> {
    part.features.iter().flat_map(nails_of).collect()
}

fn nails_of(feature: &part::Feature) -> Vec<Nail> {
    let (below_mm, above_mm) = (feature.below_mm, feature.above_mm);
    let nail =
        |p: &SurfacePoint| Nail { foot_mm: p.point_mm, normal: p.normal, below_mm, above_mm };
    feature.points.iter().map(nail).collect()
}

/// The cuts, if every point was cut within its nail.
fn reached(
    study: &PartStudy,
    part: &part::Part,
    reaches: &[Reach],
    problems: &mut Diagnostics,
) -> Option<Vec<Cut>> {
    let mut rest = reaches;
    let mut sound = true;
    for feature in &part.features {
        let (own, others) = rest.split_at(feature.points.len());
        rest = others;
        let not_cut: Vec<usize> = places(own, |r| *r == Reach::NotCut);
        let deeper: Vec<usize> = places(own, |r| matches!(r, Reach::Deeper(_)));
        let place = || Place::whole(&study.part_file);
        let at = |i: usize| {
            let p = feature.points[i].point_mm;
            format!("X {:.3} Y {:.3} Z {:.3} mm", p.x, p.y, p.z)
        };
        let (name, count) = (&feature.name, own.len());
        if let Some(first) = not_cut.first() {
            sound = false;
            let message = format!(
                "`{name}`: no cutter comes to {} of {count} points, first at {}",
                not_cut.len(),
                at(*first)
            );
            let hint = format!(
                "within {} mm outside of the surface (`above`): program, work offset, tool or feature is another",
                feature.above_mm
            );
            problems.error("not-cut", place(), message, &hint);
        }
        if let Some(first) = deeper.first() {
            sound = false;
            let message = format!(
                "`{name}`: {} of {count} points are cut away, first at {}",
                deeper.len(),
                at(*first)
            );
            let hint = format!(
                "deeper than {} mm (`below`): a gouge, or the feature is another",
                feature.below_mm
            );
            problems.error("cut-away", place(), message, &hint);
        }
    }
    sound.then(|| reaches.iter().filter_map(|r| r.cut().copied()).collect())
}

fn places(reaches: &[Reach], is: impl Fn(&Reach) -> bool) -> Vec<usize> {
    reaches.iter().enumerate().filter(|(_, r)| is(r)).map(|(i, _)| i).collect()
}

/// A value against its limits, ISO 14253-1 where the study asks for it.
fn outcome(limits: &part::Limits, value_mm: f64, u_mm: f64, decision: Decision) -> Outcome {
    let expanded_mm = match decision {
        Decision::Simple => 0.0,
        Decision::Guarded { coverage } => coverage * u_mm,
    };
    match limits.room_mm(value_mm) {
        room if room >= expanded_mm => Outcome::Pass,
        room if room < -expanded_mm => Outcome::Fail,
        _ => Outcome::Undecided,
    }
}
