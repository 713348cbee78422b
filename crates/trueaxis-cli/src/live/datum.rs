//! `trueaxis live datum`: tells a run that the zero of the part is being touched.

use super::refuse;
use crate::output::{Answer, Format, Outcome, show};
use std::path::Path;
use std::time::Duration;
use trueaxis::files::disk;
use trueaxis::input::{Diagnostics, Place};
use trueaxis_live::file::read_plan;
use trueaxis_live::run::{DATUM_CLEARED, DATUM_REFUSED, DATUM_SET};
use trueaxis_live::status::folder_of;
use trueaxis_live::store::{ask_datum, is_running, last_events};

/// The run looks once a second; it has this long, in tenths of a second.
const PATIENCE: usize = 100;
/// Events that are looked through for the answer.
const EVENTS: usize = 100;

pub fn run(clear: bool, plan: &Path) -> Outcome {
    let (read, mut problems) = read_plan(&disk(), plan);
    let folder = read.as_ref().and_then(|plan| folder_of(plan, &mut problems));
    let Some(folder) = folder else { return refuse(problems, Format::Text) };
    let runs = is_running(&folder);
    if !runs && !clear {
        let message = "no run of this plan is going on: what acted at the touch is not known";
        problems.error(
            "live-datum",
            Place::whole(&plan.display().to_string()),
            message.to_owned(),
            "start it (with --dry-run where the zero is touched without correction), or write [datum] into the plan",
        );
        return refuse(problems, Format::Text);
    }
    let known = last_events(&folder, EVENTS).last().map(|e| (e.date_s, e.at_s));
    if let Err(error) = ask_datum(&folder, clear, runs) {
        return cannot_write(&folder, &error, problems);
    }
    if !runs {
        return show(&Answer::Text("nothing is subtracted in the next run\n".to_owned()));
    }
    for _ in 0..PATIENCE {
        std::thread::sleep(Duration::from_millis(100));
        let events = last_events(&folder, EVENTS);
        let new = events.iter().rev().take_while(|e| Some((e.date_s, e.at_s)) != known);
        let names = [DATUM_SET, DATUM_CLEARED, DATUM_REFUSED];
        if let Some(event) = new.into_iter().find(|e| names.contains(&e.event.as_str())) {
            let shown = show(&Answer::Text(format!("{}: {}\n", event.event, event.what)));
            return if event.event == DATUM_REFUSED { Outcome::No } else { shown };
        }
    }
    show(&Answer::Text("the run has not answered: see trueaxis live status\n".to_owned()));
    Outcome::No
}

fn cannot_write(folder: &Path, error: &str, mut problems: Diagnostics) -> Outcome {
    problems.error(
        "live-no-journal",
        Place::whole(&folder.display().to_string()),
        format!("cannot be written: {error}"),
        "do it as the user who has started the run",
    );
    refuse(problems, Format::Text)
}
