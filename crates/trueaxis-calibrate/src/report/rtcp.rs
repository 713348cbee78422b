//! An RTCP calibration as text and JSON.

use crate::identify::rtcp::forecast::{Forecast, Strays};
use crate::identify::rtcp::{Calibration, NewSlot, RtcpStudy};
use serde_json::{Value, json};
use std::fmt::Write;
use trueaxis_geometry::statistics::chi_square_above;

/// What stands in a report of an RTCP calibration.
#[derive(Debug, Clone, Copy)]
pub struct RtcpReport<'a> {
    /// The study.
    pub study: &'a RtcpStudy,
    /// What was found.
    pub found: &'a Calibration,
    /// Before and after.
    pub forecast: Option<&'a Forecast>,
}

/// For people.
pub fn rtcp_text(told: &RtcpReport<'_>) -> String {
    let (study, found) = (told.study, told.found);
    let mut text =
        format!("{}\n{}, {}\n\n", study.name, study.machine.name(), study.centres.topology.words());
    let width = found.offsets.iter().map(|o| o.words.len()).max().unwrap_or(0).max(24);
    // Writing to a String cannot fail.
    let _ = writeln!(
        text,
        "true − machine file {:>width$}      µm      u  (k = 1)",
        "",
        width = width - 8
    );
    for offset in &found.offsets {
        let value = match offset.found_mm {
            Some((mm, u)) => format!("{:>9.2} {:>6.2}", mm * 1e3, u * 1e3),
            None => " not seen".to_owned(),
        };
        let _ = writeln!(text, "  {:<6} {:<width$} {value}", offset.name, offset.words);
    }
    text += &unseen(found);
    text += &numbers(told);
    text += &fit(found);
    text += &forecast(told);
    let _ = writeln!(text, "\n{}", found.verdict());
    text
}

fn unseen(found: &Calibration) -> String {
    let mut text = String::new();
    for unseen in &found.unseen {
        // Writing to a String cannot fail.
        let _ = writeln!(text, "\nnot seen: {}\n  {}", unseen.combination, unseen.words);
    }
    text
}

/// The numbers of the control.
fn numbers(told: &RtcpReport<'_>) -> String {
    let Some(slots) = &told.study.slots else { return String::new() };
    let decimals = usize::from(told.study.decimals);
    let width = told.found.new.iter().map(|n| n.slot.name.len()).max().unwrap_or(0).max(17);
    let mut text =
        format!("\n{:<width$}         old mm         new mm      u µm\n", slots.names.title());
    for new in &told.found.new {
        let NewSlot { slot, old_mm, new_mm } = new;
        let value = match new_mm {
            Some((mm, u)) if is_known(new) => {
                format!("{:>14.decimals$} {:>9.2}", mm + 0.0, u * 1e3)
            }
            Some((mm, _)) => format!("{:>14.decimals$} unchanged", mm + 0.0),
            None => format!("{:>14} {:>9}", "not seen", ""),
        };
        // Writing to a String cannot fail.
        let _ = writeln!(
            text,
            "{:<width$} {:>14.decimals$} {value}  {}",
            slot.name,
            old_mm + 0.0,
            slot.words
        );
    }
    for k in &slots.without_slot {
        let words = told.study.centres.words(&told.study.machine, *k);
        let _ = writeln!(
            text,
            "no number of {} takes in {words}: correct it at the machine or in its zero",
            slots.names.title()
        );
    }
    text
}

/// A number that the centres change.
fn is_known(new: &NewSlot) -> bool {
    new.slot.slopes.iter().any(|s| *s != 0.0)
}

fn fit(found: &Calibration) -> String {
    let limit = chi_square_above(0.01, found.degrees_of_freedom.max(1) as f64);
    let mut text = format!(
        "\n{} readings, {} degrees of freedom: χ² = {:.1} (99 %: {:.1}), {:.2} µm RMS left\n",
        found.numbers,
        found.degrees_of_freedom,
        found.chi_square,
        limit,
        found.rms_residual_mm * 1e3
    );
    if let Some(worst) = &found.worst {
        // Writing to a String cannot fail.
        let _ = writeln!(
            text,
            "worst: {}:{} {}, {:+.2} µm off ({:+.1} of its standard deviations{})",
            worst.place.file,
            worst.place.line,
            worst.channel,
            worst.residual_mm * 1e3,
            worst.standardised,
            if worst.is_outlier { ", more than chance" } else { "" }
        );
    }
    if found.birge > 1.0 {
        let _ = writeln!(
            text,
            "the uncertainties above are {:.1} times those of the stated noise",
            found.birge
        );
        match found.suspicions.is_empty() {
            true => text += "no single wrong sign explains that\n",
            false => found.suspicions.iter().for_each(|s| text += &format!("suspicion: {s}\n")),
        }
    }
    text
}

fn forecast(told: &RtcpReport<'_>) -> String {
    let Some(f) = told.forecast else {
        return "\nno forecast: not all offsets are known\n".to_owned();
    };
    let at = |s: &Strays| {
        let each = s.at.iter().map(|(name, q)| format!("{name} {:.0}°", q.to_degrees()));
        each.collect::<Vec<_>>().join(", ")
    };
    format!(
        "\ntip over {} poses, the zero touched at rotary 0      worst µm    RMS µm\n\
         \u{20}\u{20}with the old numbers                                  {:>9.2} {:>9.2}  at {}\n\
         \u{20}\u{20}with the new ones as entered, if the centres are right {:>8.2} {:>9.2}\n\
         \u{20}\u{20}to be expected                                  U = {:>9.2} {:>9.2}  (k = 2; RMS)\n",
        f.poses,
        f.before.worst_mm * 1e3,
        f.before.rms_mm * 1e3,
        at(&f.before),
        f.after.worst_mm * 1e3,
        f.after.rms_mm * 1e3,
        2e3 * f.u_after_mm,
        f.expected_rms_mm * 1e3
    )
}

/// For programs: `trueaxis/identify-rtcp/1`.
pub fn rtcp_json(told: &RtcpReport<'_>) -> Value {
    let (study, found) = (told.study, told.found);
    let um = |mm: f64| mm * 1e3;
    let offsets: Vec<Value> = found
        .offsets
        .iter()
        .map(|o| {
            json!({
                "name": o.name,
                "words": o.words,
                "value_um": o.found_mm.map(|(v, _)| um(v)),
                "u_um": o.found_mm.map(|(_, u)| um(u)),
            })
        })
        .collect();
    let numbers: Vec<Value> = found
        .new
        .iter()
        .map(|n| {
            json!({
                "name": n.slot.name,
                "words": n.slot.words,
                "old_mm": n.old_mm,
                "new_mm": n.new_mm.map(|(v, _)| v),
                "u_um": n.new_mm.map(|(_, u)| um(u)),
                "changes": is_known(n),
            })
        })
        .collect();
    let without = study.slots.iter().flat_map(|s| &s.without_slot);
    json!({
        "schema": "trueaxis/identify-rtcp/1",
        "name": study.name,
        "machine": study.machine.name(),
        "topology": study.centres.topology.key(),
        "offsets": offsets,
        "control": study.slots.as_ref().map(|s| s.names.key()),
        "numbers": numbers,
        "without_number": without.map(|k| found.offsets[*k].name.clone()).collect::<Vec<_>>(),
        "unobservable": found.unseen.iter().map(|u| json!({
            "combination": u.combination, "words": u.words,
        })).collect::<Vec<_>>(),
        "readings": found.numbers,
        "chi_square": found.chi_square,
        "degrees_of_freedom": found.degrees_of_freedom,
        "birge": found.birge,
        "rms_residual_um": um(found.rms_residual_mm),
        "worst_reading": found.worst.as_ref().map(|w| json!({
            "file": w.place.file, "line": w.place.line, "channel": w.channel.to_string(),
            "residual_um": um(w.residual_mm), "standardised": w.standardised,
            "is_outlier": w.is_outlier,
        })),
        "suspicions": found.suspicions,
        "forecast": told.forecast.map(forecast_json),
        "verdict": found.verdict(),
    })
}

fn forecast_json(f: &Forecast) -> Value {
    let strays = |s: &Strays| {
        let at: serde_json::Map<String, Value> =
            s.at.iter().map(|(name, q)| (name.clone(), json!(q.to_degrees()))).collect();
        json!({ "worst_um": s.worst_mm * 1e3, "rms_um": s.rms_mm * 1e3, "at_deg": at })
    };
    json!({
        "poses": f.poses,
        "before": strays(&f.before),
        "after": strays(&f.after),
        "U_after_um": 2e3 * f.u_after_mm,
        "expected_rms_um": f.expected_rms_mm * 1e3,
    })
}
