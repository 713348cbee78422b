//! An RTCP calibration for programs: `trueaxis/identify-rtcp/1`.

use super::rtcp::{RtcpReport, is_known};
use crate::rtcp::forecast::{Forecast, Strays};
use crate::rtcp::screen::{ScreenField, screen};
use crate::rtcp::{AngleError, NewSlot, Offset, Segments, Unseen, WorstReading};
use serde::Serialize;
use trueaxis_report::JsonSchema;
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
    /// Whether the directions of the rotary axes were unknowns beside the offsets.
    pub angles_found: bool,
    /// The angle errors of the rotary axes.
    pub angles: Vec<AngleEntry<'a>>,
    /// What the segments of a path with tool-centre point keep; null if the file has no `[segments]`.
    pub segments: Option<SegmentsEntry>,
    /// The RTCP screen of the i5 control, field by field; empty for other controls.
    pub screen: Vec<ScreenEntry>,
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

/// One angle error of a rotary axis.
#[derive(Debug, Serialize, JsonSchema)]
pub struct AngleEntry<'a> {
    /// Its ISO 230-1 name.
    pub name: &'a str,
    /// The same in words.
    pub words: &'a str,
    /// Its value, µrad; null where it was not asked for or is not observable.
    pub value_urad: Option<f64>,
    /// Its expanded uncertainty (k = 2), µrad.
    #[serde(rename = "U_urad")]
    pub expanded_urad: Option<f64>,
    /// Whether these readings determine it.
    pub observable: bool,
    /// The expanded uncertainty (k = 2) that these readings give by their stated noise, µrad; null: none.
    #[serde(rename = "U_expected_urad")]
    pub expected_expanded_urad: Option<f64>,
    /// Which further reading would determine it; null where these do.
    pub further_reading: Option<&'a str>,
}

/// What the segments of a path keep.
#[derive(Debug, Serialize, JsonSchema)]
pub struct SegmentsEntry {
    /// The largest chord error, µm.
    pub chord_error_um: f64,
    /// The largest distance of the path from a rotary axis, mm.
    pub distance_mm: f64,
    /// The largest step of one rotary axis while the tip stands still, degrees.
    pub largest_step_deg: f64,
    /// By how much the rotary axes together turn for each mm where the path turns most, deg/mm. Unit: deg/mm.
    pub sharpest_deg_per_mm: Option<f64>,
    /// The longest segment there, mm.
    pub longest_segment_mm: Option<f64>,
    /// The shortest segment of the control, mm, if stated.
    pub shortest_segment_mm: Option<f64>,
    /// The turning that it allows, deg/mm. Unit: deg/mm.
    pub shortest_allows_deg_per_mm: Option<f64>,
    /// The first segment of the control, mm, if stated.
    pub first_segment_mm: Option<f64>,
    /// The turning that it allows, deg/mm. Unit: deg/mm.
    pub first_allows_deg_per_mm: Option<f64>,
}

/// One field of the RTCP screen.
#[derive(Debug, Serialize, JsonSchema)]
pub struct ScreenEntry {
    /// Its name in English.
    pub name: &'static str,
    /// Its name as it is printed.
    pub printed: &'static str,
    /// Its unit; `--` where the screen states none.
    pub unit: &'static str,
    /// What the picture of the paper shows.
    pub picture: &'static str,
    /// What to enter; null where neither paper nor readings determine it.
    pub enter: Option<String>,
    /// Why, or why not.
    pub words: String,
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
            angles_found: found.angles_wanted,
            angles: found.angles.iter().map(AngleEntry::from).collect(),
            segments: study.segments.as_ref().map(SegmentsEntry::from),
            screen: screen(study, found).into_iter().map(ScreenEntry::from).collect(),
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

impl<'a> From<&'a AngleError> for AngleEntry<'a> {
    fn from(a: &'a AngleError) -> Self {
        Self {
            name: &a.name,
            words: &a.words,
            value_urad: a.found_rad.map(|(v, _)| v * 1e6),
            expanded_urad: a.found_rad.map(|(_, u)| 2e6 * u),
            observable: a.expected_u_rad.is_some(),
            expected_expanded_urad: a.expected_u_rad.map(|u| 2e6 * u),
            further_reading: a.further.as_deref(),
        }
    }
}

impl From<&Segments> for SegmentsEntry {
    fn from(s: &Segments) -> Self {
        let allows = |mm: f64| s.largest_turn_rad_per_mm(mm).to_degrees();
        Self {
            chord_error_um: s.chord_error_mm * 1e3,
            distance_mm: s.distance_mm,
            largest_step_deg: s.largest_step_rad().to_degrees(),
            sharpest_deg_per_mm: s.sharpest_rad_per_mm.map(f64::to_degrees),
            longest_segment_mm: s.sharpest_rad_per_mm.map(|rho| s.longest_mm(rho)),
            shortest_segment_mm: s.shortest_mm,
            shortest_allows_deg_per_mm: s.shortest_mm.map(allows),
            first_segment_mm: s.first_mm,
            first_allows_deg_per_mm: s.first_mm.map(allows),
        }
    }
}

impl From<ScreenField> for ScreenEntry {
    fn from(f: ScreenField) -> Self {
        let ScreenField { name, printed, unit, shown: picture, enter, words } = f;
        Self { name, printed, unit, picture, enter, words }
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
