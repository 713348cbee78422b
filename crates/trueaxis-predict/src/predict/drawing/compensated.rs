//! The same part by its program compensated for the machine, or with tables in the control: before and after.

use super::path::CutPath;
use super::{PartPrediction, PartStudy, PartValue, nails, outcome, reached, sweeps, together};
use trueaxis_cut::cut;
use trueaxis_geometry::Vec3;
use trueaxis_input::{Diagnostics, Place};
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{Approach, Command};
use trueaxis_motion::{Observer, simulate};
use trueaxis_nc::Program;
use trueaxis_part::part::Characteristic;
use trueaxis_part::tolerance::Outcome;

/// What compensation makes of the part on the same machine.
#[derive(Debug, Clone, PartialEq)]
pub struct CompensatedPart {
    /// With the zero where it was set, by the machine without compensation: what counts from it keeps the error of the tip there.
    pub zero_kept: Compensated,
    /// With the zero set again by motion that is compensated, too.
    pub zero_set: Compensated,
}

/// The part judged again.
#[derive(Debug, Clone, PartialEq)]
pub struct Compensated {
    /// Values of the characteristics, in the order of the part file, mm.
    pub values_mm: Vec<f64>,
    /// Whether each is in tolerance, by the u of the program as it is: the machine is as uncertain as before.
    pub outcomes: Vec<Outcome>,
    /// All of them together.
    pub outcome: Outcome,
}

/// Cuts the part of a prediction by another program. Surfaces that the part file leaves to the program stay those of the first one.
///
/// # Errors
/// As [`super::predict_part`].
pub fn predict_compensated(
    study: &PartStudy,
    prediction: &PartPrediction,
    program: &Program,
    problems: &mut Diagnostics,
) -> Option<CompensatedPart> {
    let job = &study.job;
    let mut kept = CutPath::new(job, &study.zero(problems)?);
    let mut set = CutPath::new(job, &Vec3::zeros());
    let observers = &mut [&mut kept as &mut dyn Observer, &mut set];
    let run = simulate(&job.machine, program, &job.setup, &job.options, observers);
    if run.problems.has_errors() || run.motion_left_out().count() > 0 {
        problems.append(run.problems);
        let message = "the compensated program cannot be run to its end".to_owned();
        let hint = "write it with `compensate program` and read what is said of it";
        problems.error("motion-left-out", Place::whole(program.file()), message, hint);
        return None;
    }
    Some(CompensatedPart {
        zero_kept: judged(study, prediction, &kept, problems)?,
        zero_set: judged(study, prediction, &set, problems)?,
    })
}

/// Where tip and axis are off, by command and approach, mm and 1; none where the errors are not known.
pub type Deviations<'m> = Box<dyn Fn(&Command, &Approach) -> Option<[Vec3; 2]> + 'm>;

/// A machine that deviates otherwise than by its errors alone, such as with tables in its control.
pub trait DeviationSource {
    /// Deviations of the machine with a tool.
    fn deviations<'m>(&'m self, machine: &'m Machine) -> Deviations<'m>;
}

/// Cuts the part of a prediction by its program on the machine that deviates otherwise.
///
/// # Errors
/// As [`super::predict_part`]; that a deviation is not known.
pub fn predict_with_deviations(
    study: &PartStudy,
    prediction: &PartPrediction,
    source: &dyn DeviationSource,
    problems: &mut Diagnostics,
) -> Option<CompensatedPart> {
    let place = Place::whole(&study.path.display().to_string());
    let set_mm = match &study.setting {
        None => Some(Vec3::zeros()),
        Some(at) => source.deviations(&study.mounted)(at, &Approach::default()).map(|[tip, _]| tip),
    };
    let cut_from = |zero_mm: &Vec3| {
        let mut path = CutPath::new(&study.job, zero_mm);
        study.job.run(None, &mut [&mut path as &mut dyn Observer]);
        let machines = path.machines(&study.mounted);
        let moved = path.displace(&machines, |machine| {
            let deviation = source.deviations(machine);
            move |command: &Command, approach: &Approach| deviation(command, approach).ok_or(())
        });
        moved.ok().map(|()| path)
    };
    let kept = cut_from(&study.zero(problems)?);
    let set = set_mm.and_then(|zero| cut_from(&zero));
    let (Some(kept), Some(set)) = (kept, set) else {
        let message = "the errors are not known everywhere where the compensated program goes";
        let hint = "cover the travel by the tables of the machine file";
        problems.error("outside-table", place, message.to_owned(), hint);
        return None;
    };
    Some(CompensatedPart {
        zero_kept: judged(study, prediction, &kept, problems)?,
        zero_set: judged(study, prediction, &set, problems)?,
    })
}

fn judged(
    study: &PartStudy,
    prediction: &PartPrediction,
    path: &CutPath<'_>,
    problems: &mut Diagnostics,
) -> Option<Compensated> {
    let (part, place) = (&prediction.part, Place::whole(&study.path.display().to_string()));
    let (actual, _) = sweeps(path, place.clone(), problems)?;
    let cuts = reached(study, part, &cut(&actual, &nails(part)), problems)?;
    let deviations: Vec<f64> = cuts.iter().map(|c| c.deviation_mm).collect();
    let hint = "more points on the feature: a smaller `spacing`";
    let refused =
        |why: trueaxis_part::Error| problems.error("no-value", place, why.to_string(), hint);
    let values_mm = part.evaluate(&deviations).map_err(refused).ok()?;
    let judge = |((asked, value), before): ((&Characteristic, &f64), &PartValue)| {
        outcome(&asked.limits, *value, before.combined_mm(), study.decision)
    };
    let all = part.characteristics.iter().zip(&values_mm).zip(&prediction.values);
    let outcomes: Vec<Outcome> = all.map(judge).collect();
    let outcome = together(outcomes.iter().copied());
    Some(Compensated { values_mm, outcomes, outcome })
}
