//! Mistakes that programs of every language can have: one code and one wording for each.

use std::fmt::Display;

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

pub(crate) fn unclosed_bracket(at: usize) -> Fault {
    let hint = "one closing bracket for each that opens";
    fault("unbalanced-brackets", at, "this bracket is not closed", hint)
}

/// Brackets, functions and signs within each other.
pub(crate) fn too_deep(at: usize) -> Fault {
    let message = "too many brackets, functions or signs within each other";
    fault("too-deep", at, message, "use parameters for parts of it")
}

pub(crate) fn too_large(value: f64, what: impl Display, at: usize) -> Fault {
    let message = format!("{value} is too large for {what}");
    fault("too-large", at, message, "no machine goes that far")
}

pub(crate) fn repeated_word(name: impl Display, at: usize) -> Fault {
    let message = format!("the word {name} stands twice in this block");
    fault("repeated-word", at, message, "write it once")
}

pub(crate) fn unknown_word(name: impl Display, at: usize) -> Fault {
    let message = format!("the word {name} is not known to this control");
    let hint = "check the spelling; is the program written for another control or a printer?";
    fault("unknown-word", at, message, hint)
}

pub(crate) fn unknown_g_code(number: f64, at: usize) -> Fault {
    let message = format!("G{number} is not known to this control");
    fault("unknown-g-code", at, message, "is the program written for another control?")
}

pub(crate) fn unknown_axis(at: usize) -> Fault {
    fault("unknown-axis", at, "this axis is not known here", "the axes are X Y Z A B C U V W")
}

pub(crate) fn missing_equals(name: impl Display, hint: &'static str, at: usize) -> Fault {
    fault("missing-equals", at, format!("{name} is followed by ="), hint)
}

/// A tool, or the number of its length.
pub(crate) fn bad_tool(name: impl Display, at: usize) -> Fault {
    let message = format!("{name} is not the number of a tool");
    fault(
        "bad-tool",
        at,
        message,
        "write a whole number from 0 on, or a name where names are known",
    )
}

pub(crate) fn zero_direction(at: usize) -> Fault {
    fault("zero-direction", at, "the direction has no length", "write all three parts of it")
}

pub(crate) fn bad_dwell(at: usize) -> Fault {
    let message = "the time of the dwell is missing, negative or too long";
    fault("bad-dwell", at, message, "write how many seconds")
}

pub(crate) fn bad_work_offset(number: impl Display, hint: &'static str, at: usize) -> Fault {
    fault("bad-work-offset", at, format!("there is no work offset {number}"), hint)
}

/// A label, or the number or name of a block.
pub(crate) fn missing_label(name: impl Display, at: usize) -> Fault {
    let message = format!("there is no {name} to go to");
    fault("missing-label", at, message, "check the number or name, and the direction of the jump")
}

pub(crate) fn missing_depth(at: usize) -> Fault {
    fault("cycle-without-depth", at, "the cycle has no depth", "write the depth of the hole")
}

pub(crate) fn no_parameter(name: impl Display, hint: &'static str, at: usize) -> Fault {
    fault("parameter-out-of-range", at, format!("there is no parameter {name}"), hint)
}

/// A parameter is read before it got a value.
pub(crate) fn no_value_yet(name: impl Display, at: usize) -> Fault {
    let message = format!("{name} has no value yet");
    fault("undefined-parameter", at, message, "set it before it is used, in the same program")
}

pub(crate) fn text_too_long(most: usize, at: usize) -> Fault {
    fault("too-long", at, format!("the text is longer than {most} characters"), "shorten it")
}

/// A frame that has no inverse.
pub(crate) fn flat_frame(at: usize) -> Fault {
    let message = "the frame squeezes space flat or leaves the range of numbers";
    fault("flat-frame", at, message, "check its scales and shifts")
}

/// A factor that is zero, far from one or, where none can mirror, negative.
pub(crate) fn bad_scale(at: usize) -> Fault {
    fault(
        "bad-scale",
        at,
        "a scale squeezes the part flat, mirrors it or is too large",
        "write a factor near 1",
    )
}

/// Two codes of one group that differ cannot stand in one block.
pub(crate) fn check_groups<C: Copy + PartialEq>(
    codes: &[(C, usize)],
    group: impl Fn(C) -> Option<u8>,
) -> Result<(), Fault> {
    for (index, (code, at)) in codes.iter().enumerate() {
        let Some(own) = group(*code) else { continue };
        if codes[..index].iter().any(|(c, _)| c != code && group(*c) == Some(own)) {
            let message = "two codes of this block contradict each other";
            return Err(fault("conflicting-codes", *at, message, "write them in two blocks"));
        }
    }
    Ok(())
}

pub(crate) fn too_many_pecks(most: f64, at: usize) -> Fault {
    let message = format!("the block drills more than {most} times");
    fault("too-many-pecks", at, message, "check the depth of a peck and the number of holes")
}
