//! Holes on a circle as text.

use crate::predict::holes::{HolePrediction, HoleSet, HoleStudy};
use std::fmt::Write;

/// The holes as a table, with the verdict and the warning first.
pub fn holes_text(study: &HoleStudy, prediction: &HolePrediction) -> String {
    let mut text = format!("{}\n  machine  {}\n", study.name, study.machine.name());
    if let Some(running) = &study.temperatures {
        // Writing to a String cannot fail.
        let _ = writeln!(
            text,
            "  temperatures of {} from {} s on, the last hole after {:.1} s",
            running.run.log.file(),
            running.run.start_s,
            prediction.times_s.last().copied().unwrap_or(0.0)
        );
    }
    for warning in &prediction.warnings {
        let _ = write!(text, "\n  WARNING  {warning}\n");
    }
    set_table(&mut text, study, &prediction.sets, "");
    if let Some(held) = &prediction.held {
        set_table(&mut text, study, held, ", at the temperatures of the start, held");
    }
    text += "\n  hole       x         y    dx, dy in µm:   none           machine-only      comprehensive      u(dx), u(dy)\n";
    for (i, place) in study.holes_mm.iter().enumerate() {
        let _ = write!(text, "  {:>4} {:>9.3} {:>9.3}           ", i + 1, place.x, place.y);
        for set in &prediction.sets {
            // No minus before a zero.
            let error = (set.holes[i].error_mm * 1e4).map(|v| v.round() / 10.0 + 0.0);
            let _ = write!(text, " {:>8.1} {:>8.1}", error.x, error.y);
        }
        let u = prediction.sets[0].holes[i].u_mm * 1e3;
        let _ = writeln!(text, " {:>8.1} {:>6.1}", u.x, u.y);
    }
    if !prediction.without_u.is_empty() {
        let _ = writeln!(text, "\n  u lacks: {} (none stated)", prediction.without_u.join(", "));
    }
    text
}

fn set_table(text: &mut String, study: &HoleStudy, sets: &[HoleSet; 3], when: &str) {
    let _ = writeln!(text, "\n  compensation     worst hole, mm    u, mm   in tolerance{when}");
    for set in sets {
        let verdict = match set.in_tolerance {
            Some(true) => "yes",
            Some(false) => "NO",
            None => "-",
        };
        let mark = if set.compensation == study.applied { "  <- applied" } else { "" };
        let (name, u_mm) = (set.compensation.name(), set.u_worst_mm);
        let _ = writeln!(text, "  {name:<16} {:>14.4} {u_mm:>8.4}   {verdict}{mark}", set.worst_mm);
    }
}
