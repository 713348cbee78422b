//! Mistakes that programs of every language can have: one code and one wording for each.

use crate::moves::FeedMode;
use crate::text::program::{Fault, fault};

pub(crate) fn endless_loop(most: u64, at: usize) -> Fault {
    let message = format!("more than {most} jumps and calls: an endless loop?");
    fault("endless-loop", at, message, "check its condition, or raise the limit")
}

pub(crate) fn calls_too_deep(deepest: usize, at: usize) -> Fault {
    let message = format!("more than {deepest} calls or repetitions within each other");
    fault("calls-too-deep", at, message, "does it call itself for ever?")
}

pub(crate) fn missing_program(name: &str, why: &str, at: usize) -> Fault {
    let hint = "put it where subprograms are found, or check the spelling";
    fault("missing-subprogram", at, format!("the program {name} is missing: {why}"), hint)
}

/// The program itself sets off an alarm.
pub(crate) fn alarm(text: &str, at: usize) -> Fault {
    let message = format!("the program sets off the alarm {}", text.trim());
    fault("program-alarm", at, message, "the program asked for it")
}

pub(crate) fn arc_without_centre(hint: &'static str, at: usize) -> Fault {
    let message = "neither the centre nor the radius of the arc is given";
    fault("arc-without-centre", at, message, hint)
}

pub(crate) fn bad_turns(turns: f64, at: usize) -> Fault {
    let message = format!("{turns} is not a number of turns");
    fault("bad-turns", at, message, "write a whole number")
}

pub(crate) fn negative_feed(feed: f64, at: usize) -> Fault {
    fault("negative-feed", at, format!("{feed} is not a feed"), "write F100")
}

pub(crate) fn zero_feed(mode: FeedMode, at: usize) -> Fault {
    let (message, hint) = match mode {
        FeedMode::InverseTime => ("with G93 each feed move needs its own F", "write F"),
        _ => ("a feed move without feed", "write F before the first feed move"),
    };
    fault("zero-feed", at, message, hint)
}
