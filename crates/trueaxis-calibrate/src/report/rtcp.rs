//! An RTCP calibration as text and JSON.

use crate::identify::rtcp::forecast::{Forecast, Strays};
use crate::identify::rtcp::{Calibration, NewSlot, Offset, RtcpStudy, Unseen, WorstReading};
use schemars::JsonSchema;
use serde::Serialize;
use serde_json::Value;
use std::fmt::Write;
use trueaxis_geometry::statistics::chi_square_above;
use trueaxis_report::{Keyed, document};

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
#[derive(Debug, Serialize, JsonSchema)]
pub struct RtcpDocument<'a> {
    /// Which document this is.
    #[schemars(extend("const" = "trueaxis/identify-rtcp/1"))]
    pub schema: &'static str,
    /// The name of the study.
    pub name: &'a str,
    /// The name of the machine.
    pub machine: &'a str,
    /// Which rotary axes carry the tool and which the workpiece.
    pub topology: &'static str,
    /// The offsets of the rotary axes in chain order.
    pub offsets: Vec<OffsetEntry<'a>>,
    /// The control whose numbers follow; null if none is stated.
    pub control: Option<&'static str>,
    /// The numbers of the control.
    pub numbers: Vec<NumberEntry<'a>>,
    /// Offsets that no number of the control takes in.
    pub without_number: Vec<&'a str>,
    /// Combinations of offsets that change no reading.
    pub unobservable: Vec<UnseenEntry<'a>>,
    /// How many numbers were read.
    pub readings: usize,
    /// χ² of the readings.
    pub chi_square: f64,
    /// Its degrees of freedom.
    pub degrees_of_freedom: usize,
    /// By how much the uncertainties are enlarged, 1 or more.
    pub birge: f64,
    /// Root mean square of what is left, µm.
    pub rms_residual_um: f64,
    /// The reading that fits worst.
    pub worst_reading: Option<WorstEntry<'a>>,
    /// Wrong signs that would explain a bad fit.
    pub suspicions: &'a [String],
    /// The tip before and after; null if not all offsets are known.
    pub forecast: Option<ForecastEntry>,
    /// The result in one sentence.
    pub verdict: String,
}

/// One offset of a rotary axis.
#[derive(Debug, Serialize, JsonSchema)]
pub struct OffsetEntry<'a> {
    /// Its ISO 230-1 name.
    pub name: &'a str,
    /// The same in words.
    pub words: &'a str,
    /// True − machine file, µm; null if no reading determines it.
    pub value_um: Option<f64>,
    /// Its standard uncertainty, µm.
    pub u_um: Option<f64>,
}

/// One number of the control.
#[derive(Debug, Serialize, JsonSchema)]
pub struct NumberEntry<'a> {
    /// Its name at the control.
    pub name: &'a str,
    /// What it means.
    pub words: &'a str,
    /// As it is entered today, mm.
    pub old_mm: f64,
    /// As it is to be entered, mm; null if no reading determines it.
    pub new_mm: Option<f64>,
    /// Standard uncertainty of the new one, µm.
    pub u_um: Option<f64>,
    /// Whether the offsets change it at all.
    pub changes: bool,
}

/// A combination of offsets that changes no reading.
#[derive(Debug, Serialize, JsonSchema)]
pub struct UnseenEntry<'a> {
    /// The sum.
    pub combination: &'a str,
    /// What that means.
    pub words: &'a str,
}

/// The reading that fits worst.
#[derive(Debug, Serialize, JsonSchema)]
pub struct WorstEntry<'a> {
    /// File of the reading.
    pub file: &'a str,
    /// Its line there.
    pub line: usize,
    /// Its direction: x, y or z.
    pub channel: char,
    /// Reading − model, µm.
    pub residual_um: f64,
    /// The same in its standard uncertainty.
    pub standardised: f64,
    /// Whether that is more than chance.
    pub is_outlier: bool,
}

/// The tip over all poses, before and after.
#[derive(Debug, Serialize, JsonSchema)]
pub struct ForecastEntry {
    /// How many poses.
    pub poses: usize,
    /// With the old numbers.
    pub before: StraysEntry,
    /// With the new numbers as entered, if the centres are right.
    pub after: StraysEntry,
    /// Expanded uncertainty (k = 2) at the worst pose, µm.
    #[serde(rename = "U_after_um")]
    pub expanded_after_um: f64,
    /// The root mean square to be expected, µm.
    pub expected_rms_um: f64,
}

/// How far the tip strays.
#[derive(Debug, Serialize, JsonSchema)]
pub struct StraysEntry {
    /// The longest deviation, µm.
    pub worst_um: f64,
    /// The root mean square of all, µm.
    pub rms_um: f64,
    /// The rotary axes at the longest deviation, degrees.
    pub at_deg: Keyed<f64>,
}

impl<'a> RtcpDocument<'a> {
    /// The document of a calibration.
    pub fn of(report: &RtcpReport<'a>) -> Self {
        let (study, found) = (report.study, report.found);
        let without = study.slots.iter().flat_map(|s| &s.without_slot);
        Self {
            schema: "trueaxis/identify-rtcp/1",
            name: &study.name,
            machine: study.machine.name(),
            topology: study.centres.topology.key(),
            offsets: found.offsets.iter().map(OffsetEntry::from).collect(),
            control: study.slots.as_ref().map(|s| s.names.key()),
            numbers: found.new.iter().map(NumberEntry::from).collect(),
            without_number: without.map(|k| found.offsets[*k].name.as_str()).collect(),
            unobservable: found.unseen.iter().map(UnseenEntry::from).collect(),
            readings: found.numbers,
            chi_square: found.chi_square,
            degrees_of_freedom: found.degrees_of_freedom,
            birge: found.birge,
            rms_residual_um: found.rms_residual_mm * 1e3,
            worst_reading: found.worst.as_ref().map(WorstEntry::from),
            suspicions: &found.suspicions,
            forecast: report.forecast.map(ForecastEntry::from),
            verdict: found.verdict(),
        }
    }
}

impl<'a> From<&'a Offset> for OffsetEntry<'a> {
    fn from(o: &'a Offset) -> Self {
        let um = |mm: f64| mm * 1e3;
        Self {
            name: &o.name,
            words: &o.words,
            value_um: o.found_mm.map(|(v, _)| um(v)),
            u_um: o.found_mm.map(|(_, u)| um(u)),
        }
    }
}

impl<'a> From<&'a NewSlot> for NumberEntry<'a> {
    fn from(n: &'a NewSlot) -> Self {
        Self {
            name: &n.slot.name,
            words: &n.slot.words,
            old_mm: n.old_mm,
            new_mm: n.new_mm.map(|(v, _)| v),
            u_um: n.new_mm.map(|(_, u)| u * 1e3),
            changes: is_known(n),
        }
    }
}

impl<'a> From<&'a Unseen> for UnseenEntry<'a> {
    fn from(u: &'a Unseen) -> Self {
        Self { combination: &u.combination, words: &u.words }
    }
}

impl<'a> From<&'a WorstReading> for WorstEntry<'a> {
    fn from(w: &'a WorstReading) -> Self {
        Self {
            file: &w.place.file,
            line: w.place.line,
            channel: w.channel,
            residual_um: w.residual_mm * 1e3,
            standardised: w.standardised,
            is_outlier: w.is_outlier,
        }
    }
}

impl From<&Forecast> for ForecastEntry {
    fn from(f: &Forecast) -> Self {
        Self {
            poses: f.poses,
            before: StraysEntry::from(&f.before),
            after: StraysEntry::from(&f.after),
            expanded_after_um: 2e3 * f.u_after_mm,
            expected_rms_um: f.expected_rms_mm * 1e3,
        }
    }
}

impl From<&Strays> for StraysEntry {
    fn from(s: &Strays) -> Self {
        Self {
            worst_um: s.worst_mm * 1e3,
            rms_um: s.rms_mm * 1e3,
            at_deg: s.at.iter().map(|(name, q)| (name.as_str(), q.to_degrees())).collect(),
        }
    }
}

/// The document `trueaxis/identify-rtcp/1` as a JSON value.
pub fn rtcp_json(report: &RtcpReport<'_>) -> Value {
    document(&RtcpDocument::of(report))
}
