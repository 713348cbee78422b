//! The readings of a set-up: how long the tool really is, and where the zero is.
//!
//! ```text
//! L = (z_tip − z_face − (r_tip − r_face) sin β)/cos β        EZ0t = L_entered − L        docs/model.md eq. 215
//! ```
//!
//! β inclination of the tool, z of the machine where the upright dial shows the same under the lowest points of the face
//! of the spindle (radius r_face) and of the end of the tool (r_tip).

use std::path::Path;
use trueaxis_input::{Diagnostics, Dimension, Files, Item, Section, SourceText};
use trueaxis_machine::Machine;
use trueaxis_machine::errors::{ErrorName, StatedError};

/// What was read while the part was set up.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct SetUpReadings {
    /// The length of the tool, if it was measured.
    pub length: Option<MeasuredLength>,
    /// Centre of the blank less the zero in x and y of the workpiece, with u, mm; none if it was not measured.
    pub centre_mm: Option<[(f64, f64); 2]>,
}

/// A measured length of a tool.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeasuredLength {
    /// In the control, mm.
    pub entered_mm: f64,
    /// Measured, mm.
    pub actual_mm: f64,
    /// Its standard uncertainty, mm.
    pub u_mm: f64,
}

/// A measured length farther from the entered one is another tool, mm.
const OTHER_TOOL_MM: f64 = 0.5;
/// A dial that shows more is not centred, mm.
const OFF_CENTRE_MM: f64 = 0.5;

impl SetUpReadings {
    /// Reads the file that `post --set-up` wrote and a person filled in.
    pub(super) fn read(files: &Files, path: &Path, problems: &mut Diagnostics) -> Option<Self> {
        let text = files.text(path, "readings of a set-up (TOML)", problems)?;
        let file = path.display().to_string();
        let source = SourceText::from(files, &file, &text);
        let found = source.read(|root| {
            let length = root.section("length", read_length);
            let centre_mm = root.section("centre", read_centre);
            if length.is_none() && centre_mm.is_none() {
                let hint = "fill in [length] or [centre]; leave the other out";
                root.error("no-readings", "nothing was read".to_owned(), hint);
            }
            Self { length: length.flatten(), centre_mm: centre_mm.flatten() }
        });
        problems.append(source.finish());
        (!problems.has_errors()).then_some(found)
    }
}

/// `set_up = "set-up.toml"`: the readings that a person has filled in.
pub(super) fn read_set_up(
    item: &Item<'_>,
    root: &Section<'_>,
    folder: &Path,
) -> Option<Option<SetUpReadings>> {
    let path = folder.join(item.text()?);
    let mut problems = Diagnostics::new();
    let found = SetUpReadings::read(root.files(), &path, &mut problems);
    root.take_over(problems);
    found.map(Some)
}

/// The measured length of the tool as an error of the tool that the control knows.
pub(super) fn with_length(
    root: &Section<'_>,
    machine: Machine,
    set_up: Option<SetUpReadings>,
    words: &mut Vec<String>,
) -> Machine {
    let Some(length) = set_up.and_then(|s| s.length) else { return machine };
    let Some(name) = ErrorName::parse("EZ0t") else { return machine };
    if words.iter().any(|w| w.starts_with("EZ0t")) {
        let message = "EZ0t is measured by the set-up and stated in [what_if]".to_owned();
        root.error("contradiction", message, "take one of them out");
    }
    let nominal_mm = -machine.tip_mm().z;
    if (nominal_mm - length.entered_mm).abs() > 1e-6 {
        let message = format!(
            "the set-up has a tool of {} mm in the control, the study one of {nominal_mm} mm",
            length.entered_mm
        );
        root.error("other-tool-length", message, "[tool] length = \"…\" of the set-up");
    }
    let off_mm = length.entered_mm - length.actual_mm;
    words.push(format!("EZ0t = {:.2} ± {:.2} um (set-up)", off_mm * 1e3, length.u_mm * 1e3));
    match machine.error_index(name) {
        Some(index) => {
            machine.with_error(index, Some(StatedError::constant(off_mm, Some(length.u_mm))))
        }
        None => machine,
    }
}

/// A value that a person has filled in.
fn filled<'s>(section: &Section<'s>, key: &str, example: &str) -> Option<Item<'s>> {
    let item = section.require(key, example)?;
    let is_empty = match item.is_list() {
        true => item.list().is_some_and(|l| l.is_empty()),
        false => item.as_text() == Some(""),
    };
    if is_empty {
        let message = format!("`{key}` of [{}] is not filled in", section.name());
        item.error("no-readings", message, example);
        return None;
    }
    Some(item)
}

fn quantities(item: &Item<'_>) -> Option<Vec<f64>> {
    let all: Vec<_> = item.list()?.iter().map(|i| i.quantity(Dimension::Length)).collect();
    all.into_iter().collect()
}

fn read_length(section: &Section<'_>) -> Option<MeasuredLength> {
    let length = |key: &str, example: &str| {
        filled(section, key, example).and_then(|i| i.quantity(Dimension::Length))
    };
    let entered = length("entered", "the length in the control: entered = \"100 mm\"");
    let face = filled(section, "face", "face = [\"-512.404 mm\"]").and_then(|i| quantities(&i));
    let tip = filled(section, "tip", "tip = [\"-412.404 mm\"]").and_then(|i| quantities(&i));
    let face_radius = length("face_radius", "face_radius = \"30 mm\"");
    let tip_radius = length("tip_radius", "tip_radius = \"10 mm\"");
    let u = length("u", "u = \"2 um\"");
    let inclination = section.require("inclination", "inclination = \"10 deg\"");
    let inclination = inclination.and_then(|i| i.quantity(Dimension::Angle));
    let (entered_mm, face, tip) = (entered?, face?, tip?);
    let (face_radius_mm, tip_radius_mm, u_mm) = (face_radius?, tip_radius?, u?);
    let (sin, cos) = inclination?.sin_cos();
    let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
    let across = (tip_radius_mm - face_radius_mm) * sin;
    let actual_mm = (mean(&tip) - mean(&face) - across) / cos;
    // Of repeated readings u is that of one: their dial is common to all.
    let found = MeasuredLength { entered_mm, actual_mm, u_mm: u_mm * 2f64.sqrt() / cos.abs() };
    let range = |values: &[f64]| {
        let (low, high) = values
            .iter()
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(*v), h.max(*v)));
        high - low
    };
    if u_mm <= 0.0 {
        section.error("not-positive", "u must be above zero".to_owned(), "u = \"2 um\"");
        return None;
    }
    let spread = range(&face).max(range(&tip));
    if spread > 10.0 * u_mm {
        let message = format!(
            "repeated readings differ by {:.1} µm, far more than their u of {:.1} µm",
            spread * 1e3,
            u_mm * 1e3
        );
        section.error("scattered-readings", message, "check the readings, or state a larger u");
        return None;
    }
    let off = actual_mm - entered_mm;
    if off.abs() > OTHER_TOOL_MM || off.is_nan() {
        let message =
            format!("the readings make {actual_mm:.4} mm, the control has {entered_mm} mm");
        let hint = "are `face` and `tip` Z of the machine, not swapped, and of this tool? otherwise correct the length \
                    in the control";
        section.error("other-tool-length", message, hint);
        return None;
    }
    Some(found)
}

/// `c = ((r₀ − r₁₈₀)/2, (r₉₀ − r₂₇₀)/2)`, u of each u/√2.
fn read_centre(section: &Section<'_>) -> Option<[(f64, f64); 2]> {
    let example = "dial = [\"0 um\", \"3 um\", \"1 um\", \"-2 um\"], at 0, 90, 180 and 270 deg";
    let item = filled(section, "dial", example);
    let dial = item.as_ref().and_then(quantities);
    let u = filled(section, "u", "u = \"1 um\"").and_then(|i| i.quantity(Dimension::Length));
    let dial = dial?;
    let [right, front, left, back] = dial[..] else {
        let message = format!("{} readings of the dial, 4 are needed", dial.len());
        section.error("too-few-readings", message, example);
        return None;
    };
    let u_mm = u? / 2f64.sqrt();
    let centre = [0.5 * (right - left), 0.5 * (front - back)];
    // An ellipse of the blank is no fault of the centre.
    if centre.iter().any(|c| c.abs() > OFF_CENTRE_MM) {
        let message = format!("the zero is {:.3} {:.3} mm off the centre", centre[0], centre[1]);
        section.error("other-zero", message, "set the zero again, and read the dial again");
        return None;
    }
    Some(centre.map(|c| (c, u_mm)))
}
