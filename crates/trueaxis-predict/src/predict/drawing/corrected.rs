//! The same part by another program, such as the one that is compensated for the machine: before and after.

use super::path::CutPath;
use super::{PartPrediction, PartStudy, nails, outcome, reached, sweeps, together};
use trueaxis_cut::cut;
use trueaxis_input::{Diagnostics, Place};
use trueaxis_motion::{Observer, simulate};
use trueaxis_nc::Program;
use trueaxis_part::part::Characteristic;
use trueaxis_part::tolerance::Outcome;

/// What another program makes of the part on the same machine.
#[derive(Debug, Clone, PartialEq)]
pub struct CorrectedPart {
    /// Values of the characteristics, in the order of the part file, mm.
    pub values_mm: Vec<f64>,
    /// Whether each is in tolerance, by the u of the first program: the machine is as uncertain as before.
    pub outcomes: Vec<Outcome>,
    /// All of them together.
    pub outcome: Outcome,
}

/// Cuts the part of a prediction by another program. Surfaces that the part file leaves to the program stay those of the first one; the zero
/// stays where it was set.
///
/// # Errors
/// As [`super::predict_part`].
pub fn predict_corrected(
    study: &PartStudy,
    prediction: &PartPrediction,
    program: &Program,
    problems: &mut Diagnostics,
) -> Option<CorrectedPart> {
    let (job, part) = (&study.job, &prediction.part);
    let mut path = CutPath::new(job, &study.zero(problems)?);
    let observers = &mut [&mut path as &mut dyn Observer];
    let run = simulate(&job.machine, program, &job.setup, &job.options, observers);
    let place = Place::whole(program.file());
    if run.problems.has_errors() || run.motion_left_out().count() > 0 {
        let message = "the compensated program cannot be run to its end".to_owned();
        let hint = "write it with `compensate program` and read what is said of it";
        problems.error("motion-left-out", place, message, hint);
        return None;
    }
    let (actual, _) = sweeps(&path, place, problems)?;
    let cuts = reached(study, part, &cut(&actual, &nails(part)), problems)?;
    let deviations: Vec<f64> = cuts.iter().map(|c| c.deviation_mm).collect();
    let values_mm = match part.evaluate(&deviations) {
        Ok(values) => values,
        Err(why) => {
            let place = Place::whole(&study.path.display().to_string());
            let hint = "more points on the feature: a smaller `spacing`";
            problems.error("no-value", place, why.to_string(), hint);
            return None;
        }
    };
    let judge = |((asked, value), before): ((&Characteristic, &f64), &super::PartValue)| {
        outcome(&asked.limits, *value, before.combined_mm(), study.decision)
    };
    let all = part.characteristics.iter().zip(&values_mm).zip(&prediction.values);
    let outcomes: Vec<Outcome> = all.map(judge).collect();
    let outcome = together(outcomes.iter().copied());
    Some(CorrectedPart { values_mm, outcomes, outcome })
}
