//! Tapping in step with the spindle: G84 and G74 after M29 of FANUC, G84 and G74 of Haas, CYCLE84, cycle 207, and on
//! LinuxCNC G33.1 between rapid moves.

use super::{Hole, Numbers, Thread, klartext_call};
use crate::number::Form;
use crate::{WriteResult, Writer};
use trueaxis_nc::Control;

/// Digits of a pitch: 28 threads per inch are 0.907143 mm.
const PITCH_DECIMALS: u8 = 6;

/// One hole, where the tool stands over it at the retract height.
///
/// # Source
/// FANUC Series 30i user manual (B-64484EN-2), rigid tapping: M29 S before G84 or G74, F is pitch times S with G94.
/// Haas "Mill Operator's Manual" (96-8000), G84 and G74: the control starts the spindle itself. SINUMERIK 840D
/// programming manual "Cycles", CYCLE84: PIT below zero is a left-hand thread, SDAC how the spindle turns afterwards.
/// HEIDENHAIN cycle 207: Q239 below zero is a left-hand thread. LinuxCNC, "G33.1 Spindle Synchronized Motion With
/// Return": down and back, reversed at both ends; its G84 taps with a floating holder.
pub(super) fn first(w: &mut Writer, hole: &Hole, numbers: &Numbers) -> WriteResult {
    let Some(thread) = hole.thread else { return Ok(()) };
    match w.control {
        Control::Fanuc | Control::Haas => g_cycle(w, hole, &thread, numbers),
        Control::LinuxCnc => synchronized(w, hole, &thread, numbers),
        Control::Sinumerik840d => siemens_cycle(w, hole, &thread, numbers),
        Control::Heidenhain => klartext_cycle(w, hole, &thread, numbers),
    }
}

fn pitch(value: f64, form: Form) -> Result<String, crate::WriteError> {
    Numbers::text(value, PITCH_DECIMALS, form, "a pitch")
}

fn speed(thread: &Thread, numbers: &Numbers) -> Result<String, crate::WriteError> {
    Numbers::text(thread.speed_per_minute, numbers.feed_decimals, Form::Plain, "S")
}

fn g_cycle(w: &mut Writer, hole: &Hole, thread: &Thread, numbers: &Numbers) -> WriteResult {
    let [x, y] = hole.place_mm;
    let line = format!(
        "G94 G98 {} X{} Y{} Z{} R{} F{}",
        if thread.left_hand { "G74" } else { "G84" },
        numbers.length(x)?,
        numbers.length(y)?,
        numbers.length(hole.bottom_mm)?,
        numbers.length(hole.clearance_mm)?,
        numbers.feed(&hole.feed)?
    );
    // M29 of Haas sets an output.
    if w.control == Control::Fanuc {
        w.line(format!("M29 S{}", speed(thread, numbers)?).as_bytes());
    }
    w.line(line.as_bytes());
    Ok(())
}

/// The spindle turns as at the first hole: the interpreter reverses it at both ends.
fn synchronized(w: &mut Writer, hole: &Hole, thread: &Thread, numbers: &Numbers) -> WriteResult {
    let lines = [
        format!("G0 Z{}", numbers.length(hole.clearance_mm)?),
        format!(
            "G33.1 Z{} K{}",
            numbers.length(hole.bottom_mm)?,
            pitch(thread.pitch_mm, Form::Plain)?
        ),
        format!("G0 Z{}", numbers.length(hole.retract_mm)?),
    ];
    lines.iter().for_each(|line| w.line(line.as_bytes()));
    Ok(())
}

/// RTP, RFP, SDIS, DP, DPR, DTB, SDAC, MPIT, PIT, POSS, SST, SST1.
fn siemens_cycle(w: &mut Writer, hole: &Hole, thread: &Thread, numbers: &Numbers) -> WriteResult {
    let (sense, sign) = if thread.left_hand { (4, -1.0) } else { (3, 1.0) };
    let speed = speed(thread, numbers)?;
    let call = format!(
        "CYCLE84({},{},{},{},,,{sense},,{},0,{speed},{speed})",
        numbers.length(hole.retract_mm)?,
        numbers.length(hole.surface_mm)?,
        numbers.length(hole.clearance_mm - hole.surface_mm)?,
        numbers.length(hole.bottom_mm)?,
        pitch(sign * thread.pitch_mm, Form::Plain)?
    );
    w.line(call.as_bytes());
    Ok(())
}

fn klartext_cycle(w: &mut Writer, hole: &Hole, thread: &Thread, numbers: &Numbers) -> WriteResult {
    let sign = if thread.left_hand { -1.0 } else { 1.0 };
    let parameters = [
        (200, numbers.length(hole.clearance_mm - hole.surface_mm)?, "SET-UP CLEARANCE"),
        (201, numbers.length(hole.bottom_mm - hole.surface_mm)?, "DEPTH OF THREAD"),
        (239, pitch(sign * thread.pitch_mm, Form::Signed)?, "THREAD PITCH"),
        (203, numbers.length(hole.surface_mm)?, "SURFACE COORDINATE"),
        (204, numbers.length(hole.retract_mm - hole.surface_mm)?, "2ND SET-UP CLEARANCE"),
    ];
    klartext_call(w, "CYCL DEF 207 RIGID TAPPING NEW ~".to_owned(), &parameters);
    Ok(())
}
