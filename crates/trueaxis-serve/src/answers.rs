//! The requests by name: one file for each tab of the page.

mod describe;
mod evaluate;
mod identify;
mod machine;
mod plan;
mod predict;
mod project;
mod report;
mod simulate;
mod wants;

pub(crate) use simulate::Simulated;

use crate::desk::{Desk, Job, Reply};
use crate::refusal::Refusal;
use serde_json::Value;

/// How long a request usually takes.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Pace {
    /// As fast as somebody drags a slider.
    Quick,
    /// Long enough for a progress bar.
    Long,
}

/// One request.
pub(crate) struct Answer {
    pub(crate) name: &'static str,
    pub(crate) pace: Pace,
    pub(crate) work: fn(&Desk, &Value, &Job) -> Result<Reply, Refusal>,
}

const fn quick(
    name: &'static str,
    work: fn(&Desk, &Value, &Job) -> Result<Reply, Refusal>,
) -> Answer {
    Answer { name, pace: Pace::Quick, work }
}

const fn long(
    name: &'static str,
    work: fn(&Desk, &Value, &Job) -> Result<Reply, Refusal>,
) -> Answer {
    Answer { name, pace: Pace::Long, work }
}

/// All of them.
pub(crate) const ANSWERS: &[Answer] = &[
    quick("project", project::project),
    quick("open", project::open),
    quick("save", project::save),
    quick("describe", describe::describe),
    quick("models", describe::models),
    quick("pose", describe::pose),
    quick("set-error", describe::set_error),
    long("predict", predict::whole),
    quick("what-if", predict::what_if),
    long("plan", plan::plan),
    long("identify", identify::identify),
    quick("standards", evaluate::standards),
    quick("evaluate", evaluate::evaluate),
    long("report", report::report),
    long("simulate", simulate::simulate),
    quick("simulation-at", simulate::at),
    quick("simulation-block", simulate::block),
    quick("simulation-path", simulate::path),
    quick("simulation-curves", simulate::curves),
    quick("simulation-source", simulate::source),
];
