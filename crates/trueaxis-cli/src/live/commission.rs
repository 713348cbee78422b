//! `trueaxis live commission`: a person at an indicator.

use super::{CommissionArguments, RUNNING, STOPPED, refuse};
use crate::output::{Answer, Format, Outcome, show, tell};
use std::cell::RefCell;
use std::io::BufRead;
use std::sync::atomic::Ordering;
use std::sync::mpsc::{Receiver, channel};
use trueaxis::files::disk;
use trueaxis::input::{Diagnostics, Dimension, Place, parse_quantity};
use trueaxis_live::commission::{Commission, Step, Tried, commission, evidence_line, moved_ratio};
use trueaxis_live::file::{RIGHT, WRONG};

/// A length or an angle, mm or rad.
fn quantity(text: &str) -> Option<f64> {
    let of = |dimension| parse_quantity(text.trim(), dimension).ok();
    of(Dimension::Length).or_else(|| of(Dimension::Angle)).filter(|v| v.is_finite())
}

/// Lines of the terminal, read beside the loop: its heartbeat goes on meanwhile.
fn lines() -> Receiver<String> {
    let (sender, receiver) = channel();
    std::thread::spawn(move || {
        for line in std::io::stdin().lock().lines().map_while(Result::ok) {
            if sender.send(line).is_err() {
                return;
            }
        }
    });
    receiver
}

pub(super) fn run(arguments: &CommissionArguments) -> Outcome {
    let Some(by) = quantity(&arguments.by).filter(|by| *by != 0.0) else {
        let mut problems = Diagnostics::new();
        let message = format!("`{}` is no length or angle", arguments.by);
        problems.error(
            "live-limit",
            Place::whole("--by"),
            message,
            "such as \"10 um\" or \"0.001 deg\"",
        );
        return refuse(problems, Format::Text);
    };
    let asked = Commission { plan: arguments.plan.clone(), axis: arguments.axis.clone(), by };
    RUNNING.store(true, Ordering::Relaxed);
    let stopped = || STOPPED.load(Ordering::Relaxed);
    let answers: RefCell<Option<Receiver<String>>> = RefCell::new(None);
    let steps = |step: Step| match step {
        Step::Line(line) => tell(&line),
        Step::Stands => {
            tell(&format!(
                "the offset of {} is {} now: type what the indicator shows, such as 9.8 um; an empty line ends it",
                arguments.axis, arguments.by
            ));
            *answers.borrow_mut() = Some(lines());
        }
    };
    let said = || {
        let answers = answers.borrow();
        match answers.as_ref()?.try_recv() {
            Ok(line) if line.trim().is_empty() => Some(None),
            Ok(line) => {
                let read = quantity(&line);
                if read.is_none() {
                    tell("no length or angle: type it with its unit, such as 9.8 um");
                }
                read.map(Some)
            }
            Err(std::sync::mpsc::TryRecvError::Empty) => None,
            Err(std::sync::mpsc::TryRecvError::Disconnected) => Some(None),
        }
    };
    let (plan, tried) = match commission(&asked, &disk(), &stopped, (&steps, &said)) {
        Ok(tried) => tried,
        Err(problems) => return refuse(problems, Format::Text),
    };
    let measured = match tried {
        Tried::Measured(measured) => measured,
        Tried::Abandoned => {
            tell("no reading: nothing is proved");
            return Outcome::No;
        }
        Tried::Never(state) => {
            tell(&format!("the offset did not come to stand: {state}"));
            return Outcome::No;
        }
    };
    let line = evidence_line(&plan, &arguments.axis, (by, measured), &arguments.evidence);
    let ratio = moved_ratio(&plan, &arguments.axis, by, measured);
    let good = RIGHT.contains(&ratio);
    let shown = match good {
        true => format!(
            "{ratio:.2} of what was written. For [axis.{}] of the plan:\n{line}\n",
            arguments.axis
        ),
        false => format!("{ratio:.2} of what was written: {WRONG}\n"),
    };
    let done = show(&Answer::Text(shown));
    if good { done } else { Outcome::No }
}
