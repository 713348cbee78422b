//! An RTCP calibration for programs: `trueaxis/identify-rtcp/1`.

use super::rtcp::{RtcpReport, is_known};
use crate::identify::rtcp::forecast::{Forecast, Strays};
use crate::identify::rtcp::{NewSlot, Offset, Unseen, WorstReading};
use schemars::JsonSchema;
use serde::Serialize;
use trueaxis_report::Keyed;

/// An RTCP calibration.
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
    pub unobservable: &'a [Unseen],
    /// How many numbers were read.
    pub readings: usize,
    /// χ² of the readings. Unit: 1.
    pub chi_square: f64,
    /// Its degrees of freedom.
    pub degrees_of_freedom: usize,
    /// By how much the uncertainties are enlarged, 1 or more. Unit: 1.
    pub birge: f64,
    /// Root mean square of the residual, µm.
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
    /// The same in its standard uncertainty. Unit: 1.
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
            unobservable: &found.unseen,
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
