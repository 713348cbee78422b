//! Why the tool is off at one block: every stage of its processing, down to the contribution of each error.

use super::simulate_document::SimulateRequest;
use crate::desk::{Desk, Job};
use crate::refusal::{Refusal, entries};
use crate::request::{Diagnosed, Reply, Request};
use serde::Deserialize;
use trueaxis::JsonSchema;
use trueaxis::files::disk;
use trueaxis::input::Diagnostics;
use trueaxis::report::{TraceDocument, TraceReport};
use trueaxis::simulate;

/// One line of a program, as `trueaxis trace` shows its block.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct TraceRequest {
    /// The machine file.
    machine: String,
    /// The program.
    program: Option<String>,
    /// The set-up file; the one beside the program if it is left out.
    setup: Option<String>,
    /// The control that the program is for, as `--control` of the command line.
    control: Option<String>,
    /// The name of a program that was dropped.
    name: Option<String>,
    /// Its text.
    text: Option<String>,
    /// Whether blocks with `/` are executed, as with the switch of the control off; true if it is left out.
    optional_blocks: Option<bool>,
    /// The line of the block, from 1.
    line: u32,
}

impl Request for TraceRequest {
    type Answer<'a> = Diagnosed<'a, TraceDocument<'a>>;

    fn answer(self, desk: &Desk, job: &Job) -> Result<Reply<Self>, Refusal> {
        let Self { machine, program, setup, control, name, text, optional_blocks, line } = self;
        let asked = SimulateRequest {
            machine,
            program,
            setup,
            control,
            name,
            text,
            keep_going: Some(true),
            collisions: Some(false),
            optional_blocks,
        };
        let question = asked.question(desk, job)?;
        let mut problems = Diagnostics::new();
        let read = question.job(&disk(), &mut problems).filter(|_| !problems.has_errors());
        let Some(read) = read else { return Err(Refusal::unusable(&problems)) };
        let (found, run) = simulate::trace(
            &read.machine,
            &read.program,
            &read.setup,
            &read.options,
            line as usize,
        );
        if run.stopped {
            let message = "the search for the block was stopped";
            return Err(Refusal::new(409, "stopped", message, "ask again"));
        }
        found.warn_outside_travel(&read, &mut problems);
        let report = TraceReport::of(&read, line as usize, &found);
        let answer =
            Diagnosed { document: TraceDocument::from(&report), diagnostics: entries(&problems) };
        Ok(Reply::json(&answer))
    }
}
