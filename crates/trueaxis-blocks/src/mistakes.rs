//! Mistakes that programs of every language can have: one code and one wording for each.

use std::fmt::Display;

use trueaxis_moves::FeedMode;

pub use crate::program::unclosed_bracket;
use crate::program::{Fault, fault};

/// More jumps and calls, or points of the path in them, than any program means.
pub fn endless_loop(most: u64, points: u64, at: usize) -> Fault {
    let message = format!(
        "more than {most} jumps and calls, or {points} points of the path in them: probably an endless loop"
    );
    let hint = "check the condition of the loop, or raise the limit: --most-jumps of simulate";
    fault("endless-loop", at, message, hint)
}

/// Calls or repetitions within each other, more than any program means.
pub fn calls_too_deep(deepest: usize, at: usize) -> Fault {
    let message = format!("more than {deepest} nested calls or repetitions");
    fault("calls-too-deep", at, message, "check whether the program calls itself without end")
}

/// A called program that is not there, and why.
pub fn missing_program(name: &str, why: &str, at: usize) -> Fault {
    let hint = "put it into the folder of subprograms, check the spelling, or state in [codes] of the set-up \
                file what it does";
    fault("missing-subprogram", at, format!("the program {name} is missing: {why}"), hint)
}

/// The program itself sets off an alarm.
pub fn alarm(text: &str, at: usize) -> Fault {
    let message = format!("the program raises the alarm {}", text.trim());
    fault("program-alarm", at, message, "check the condition before it in the program")
}

/// An arc that has neither a centre nor a radius.
pub fn arc_without_centre(hint: &'static str, at: usize) -> Fault {
    let message = "neither the centre nor the radius of the arc is given";
    fault("arc-without-centre", at, message, hint)
}

/// Turns of a helix that cannot be.
pub fn bad_turns(turns: f64, at: usize) -> Fault {
    let message = format!("expected a whole number of turns, found {turns}");
    fault("bad-turns", at, message, "write a whole number")
}

/// A feed below zero.
pub fn negative_feed(feed: f64, at: usize) -> Fault {
    fault("negative-feed", at, format!("the feed {feed} is negative"), "write F100")
}

/// A feed move without a feed.
pub fn zero_feed(mode: FeedMode, at: usize) -> Fault {
    let (message, hint) = match mode {
        FeedMode::InverseTime => ("inverse-time feed (G93) needs F in each feed move", "write F"),
        _ => ("a feed move without feed", "write F before the first feed move"),
    };
    fault("zero-feed", at, message, hint)
}

/// Brackets, functions and signs within each other.
pub fn too_deep(at: usize) -> Fault {
    let message = "brackets, functions or signs are nested too deeply";
    fault("too-deep", at, message, "use parameters for parts of the expression")
}

/// A value larger than any machine.
pub fn too_large(value: f64, what: impl Display, at: usize) -> Fault {
    let message = format!("{value} is too large for {what}");
    fault("too-large", at, message, "check the value and the unit")
}

/// A word that stands twice in a block.
pub fn repeated_word(name: impl Display, at: usize) -> Fault {
    let message = format!("the word {name} occurs twice in this block");
    fault("repeated-word", at, message, "write it once")
}

/// A word that the control does not know.
pub fn unknown_word(name: impl Display, at: usize) -> Fault {
    let message = format!("unknown word {name} for this control");
    let hint = "check the spelling, and whether the program is for another control or a 3D printer";
    fault("unknown-word", at, message, hint)
}

/// A G code that the control does not know.
pub fn unknown_g_code(number: f64, at: usize) -> Fault {
    let message = format!("unknown G code G{number} for this control");
    let hint = "check whether the program is for another control; what a code of the machine builder does, \
                state in [codes] of the set-up file, such as G120 = \"ignore\"";
    fault("unknown-g-code", at, message, hint)
}

/// An axis that no machine of ours has.
pub fn unknown_axis(at: usize) -> Fault {
    fault("unknown-axis", at, "unknown axis", "use the axes X Y Z A B C U V W")
}

/// A word whose value needs the sign =.
pub fn missing_equals(name: impl Display, hint: &'static str, at: usize) -> Fault {
    fault("missing-equals", at, format!("expected = after {name}"), hint)
}

/// A tool, or the number of its length.
pub fn bad_tool(name: impl Display, at: usize) -> Fault {
    let message = format!("{name} is not a tool number");
    fault(
        "bad-tool",
        at,
        message,
        "write a whole number from 0, or a name if the control has names of tools",
    )
}

/// A direction of the tool whose components are all zero.
pub fn zero_direction(at: usize) -> Fault {
    fault("zero-direction", at, "the direction has length zero", "write all three components")
}

/// A wait without a time.
pub fn bad_dwell(at: usize) -> Fault {
    let message = "the time of the dwell is missing, negative or too long";
    fault("bad-dwell", at, message, "write the time in seconds")
}

/// A wait of FANUC whose milliseconds have a decimal point.
pub fn dwell_with_a_point(at: usize) -> Fault {
    let message = "FANUC takes no decimal point in the time P of a dwell: it counts milliseconds";
    fault("bad-dwell", at, message, "write P1500 or, in G4, X1.5 for 1.5 s")
}

/// A work offset that the control does not have.
pub fn bad_work_offset(number: impl Display, hint: &'static str, at: usize) -> Fault {
    fault("bad-work-offset", at, format!("unknown work offset {number}"), hint)
}

/// A label, or the number or name of a block.
pub fn missing_label(name: impl Display, at: usize) -> Fault {
    let message = format!("the target {name} of the jump does not exist");
    fault("missing-label", at, message, "check the number or name, and the direction of the jump")
}

/// A cycle that has no depth, or none below its surface.
pub fn missing_depth(at: usize) -> Fault {
    fault("cycle-without-depth", at, "the cycle has no depth", "state the depth of the hole")
}

/// A parameter that the control does not have.
pub fn no_parameter(name: impl Display, hint: &'static str, at: usize) -> Fault {
    fault("parameter-out-of-range", at, format!("unknown parameter {name}"), hint)
}

/// A parameter is read before it got a value.
pub fn no_value_yet(name: impl Display, at: usize) -> Fault {
    let message = format!("{name} has no value yet");
    fault("undefined-parameter", at, message, "set it before it is used, in the same program")
}

/// A text longer than the control keeps.
pub fn text_too_long(most: usize, at: usize) -> Fault {
    fault("too-long", at, format!("the text is longer than {most} characters"), "shorten the text")
}

/// A frame that has no inverse.
pub fn flat_frame(at: usize) -> Fault {
    let message = "a scale of the frame is zero or its values are too large";
    fault("flat-frame", at, message, "check the scales and shifts of the frame")
}

/// A factor that is zero, far from one or, where none can mirror, negative.
pub fn bad_scale(at: usize) -> Fault {
    fault("bad-scale", at, "the scale is zero, negative or too large", "write a factor near 1")
}

/// Two codes of one group that differ cannot stand in one block.
pub fn check_groups<C: Copy + PartialEq>(
    codes: &[(C, usize)],
    group: impl Fn(C) -> Option<u8>,
) -> Result<(), Fault> {
    for (index, (code, at)) in codes.iter().enumerate() {
        let Some(own) = group(*code) else { continue };
        if codes[..index].iter().any(|(c, _)| c != code && group(*c) == Some(own)) {
            let message = "two codes of one group are in this block";
            return Err(fault("conflicting-codes", *at, message, "write them in two blocks"));
        }
    }
    Ok(())
}

/// More strokes of a drill than any program means.
pub fn too_many_pecks(most: f64, at: usize) -> Fault {
    let message = format!("the block drills more than {most} times");
    fault("too-many-pecks", at, message, "check the depth of peck and the number of holes")
}

/// The tool does not fit at a corner or inside an arc; `before` is the line of the first of two elements.
pub fn gouge(gouge: impl Display, radius_mm: f64, before: Option<u32>, at: usize) -> Fault {
    let place = before.map_or(String::new(), |line| format!(" after line {line}"));
    let message =
        format!("the tool of radius {radius_mm:.4} mm would cut into the contour{place}: {gouge}");
    let hint = "take a smaller tool, or check the contour and the side of the compensation";
    fault("tool-too-large", at, message, hint)
}

/// A way to the contour that is too short for the radius of the tool.
pub fn short_entry(length_mm: f64, radius_mm: f64, at: usize) -> Fault {
    let message = format!(
        "the first move of the radius compensation is {length_mm:.4} mm long, not longer than the radius \
         {radius_mm:.4} mm of the tool"
    );
    fault("bad-compensation", at, message, "begin farther away from the contour")
}

/// An arc that cannot lead to the contour.
pub fn entry_arc_aside(at: usize) -> Fault {
    let message = "no arc leads from the tool to the contour so that both have the same tangent";
    fault("bad-compensation", at, message, "begin on a line, or farther away from the contour")
}

/// An approach or departure that the geometry does not allow, and why.
pub fn bad_approach(name: &str, why: &dyn std::error::Error, at: usize) -> Fault {
    let message = format!("{name} is not possible: {why}");
    fault("bad-compensation", at, message, "begin farther away from the contour")
}

/// An arc as the way to the contour.
pub fn arc_before_contour(at: usize) -> Fault {
    let message = "the first move of the radius compensation is an arc";
    fault("bad-compensation", at, message, "lead to the contour on a line, G0 or G1")
}

/// An arc as the way from the contour.
pub fn arc_after_contour(at: usize) -> Fault {
    let message = "the first move after the radius compensation is an arc";
    fault("bad-compensation", at, message, "lead away from the contour on a line, G0 or G1")
}

/// Another plane within a compensated contour.
pub fn plane_on_contour(at: usize) -> Fault {
    let message = "the plane changes while the radius compensation is on";
    fault("bad-compensation", at, message, "end the compensation before (G40, R0)")
}

/// A cycle within a compensated contour.
pub fn cycle_on_contour(what: &str, at: usize) -> Fault {
    let message = format!("{what} begins while the radius compensation is on");
    fault("bad-compensation", at, message, "end the compensation before (G40, R0)")
}

/// A move within a compensated contour that is no line or arc of the plane.
pub fn no_contour_element(at: usize) -> Fault {
    let message = "with radius compensation only lines and arcs of the plane are possible";
    fault("bad-compensation", at, message, "end the compensation before (G40, R0)")
}

/// A compensated contour whose axes are scaled differently.
pub fn unequal_scales(at: usize) -> Fault {
    let message =
        "the scales of the two axes of the plane differ while the radius compensation is on";
    fault("bad-compensation", at, message, "scale both axes alike, or end the compensation before")
}
