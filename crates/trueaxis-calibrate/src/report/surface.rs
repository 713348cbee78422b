//! A probing path over a surface as text and JSON.

use crate::plan::program::ProgramCheck;
use crate::plan::surface::{Pose, SurfaceStudy};
use std::fmt::Write;

/// The path, for people.
pub fn surface_text(
    study: &SurfaceStudy,
    poses: &[Pose],
    asked: usize,
    check: &ProgramCheck,
) -> String {
    let mut text = format!("{}\n\n", study.name);
    // Writing to a String cannot fail.
    let _ = writeln!(
        text,
        "  points        {} of {asked}, {} mm apart at least, on {}",
        poses.len(),
        study.spacing_mm,
        study.machine.name()
    );
    let _ = writeln!(
        text,
        "  probe         ball {} mm, {} mm to its centre; stands off {} mm, goes on to {:.3} mm below the \
         surface",
        2.0 * study.ball_radius_mm,
        study.probe_length_mm,
        study.stand_off_mm,
        study.beyond_mm
    );
    let minutes = check.duration_s / 60.0;
    let _ = writeln!(text, "  duration      {minutes:.1} min");
    let part =
        if study.part.is_some() { "machine and part" } else { "machine (no part is stated)" };
    let _ = writeln!(text, "  collisions    probe with {part}");
    for (mark, list) in
        [("ERROR", &check.errors), ("TROUBLE", &check.grave), ("note", &check.minor)]
    {
        let most = if mark == "note" { 2 } else { 10 };
        for line in list.iter().take(most) {
            let _ = writeln!(text, "  {mark:<13} {line}");
        }
        if list.len() > most {
            let _ = writeln!(text, "  {mark:<13} and {} more", list.len() - most);
        }
    }
    let verdict = match check.is_sound() {
        true => "nothing is in its way",
        false => "NOT to be run: see above",
    };
    let _ = writeln!(text, "\n  {verdict}");
    text
}
