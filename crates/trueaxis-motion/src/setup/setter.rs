//! `[tool_setter]`: where and how tools are measured on the machine.

use trueaxis_geometry::Vec3;
use trueaxis_input::plausible::Quantity;
use trueaxis_input::{Dimension, Section};
use trueaxis_machine::file::read_vector_mm;

/// A tool setter: a flat face on a cylinder, which triggers when a tool touches it.
#[derive(Debug, Clone, PartialEq)]
pub struct ToolSetter {
    /// The centre of its face: positions of X, Y, Z at which a tool of length 0 would touch it, mm.
    pub at_mm: Vec3,
    /// How well the height of the face is known (k = 1), mm.
    pub height_u_mm: f64,
    /// Diameter of the cylinder and its standard uncertainty, mm.
    pub diameter_mm: [f64; 2],
    /// Standard deviation of one trigger, mm.
    pub repeatability_mm: f64,
    /// How far above the face and beside the cylinder the tool comes in rapid, mm.
    pub clearance_mm: f64,
    /// How far a touch goes on beyond the expected place, mm.
    pub overtravel_mm: f64,
    /// How far below the face the diameter is touched, mm.
    pub depth_mm: f64,
    /// The feed of a touch, mm/min.
    pub feed_mm_per_min: f64,
    /// The speed of the spindle, against its cutting sense; `None`: it stands still. Unit: 1/min.
    pub speed_per_minute: Option<f64>,
    /// A gauge of known length in this tool place: it shows how far spindle and setter have drifted.
    pub reference: Option<u32>,
    /// Half the width in which spindle and setter may have moved since the face was calibrated, mm.
    pub growth_within_mm: Option<f64>,
}

pub(super) fn read_setter(section: &Section<'_>) -> Option<ToolSetter> {
    let hint = "the positions of X, Y, Z at which a tool of length 0 would touch its face";
    let at = section.require("at", hint).and_then(|i| read_vector_mm(&i));
    let mut sound = true;
    let mut length = |key: &str, usual: f64, zero: bool| {
        let Some(item) = section.get(key) else { return usual };
        match item.quantity(Dimension::Length) {
            Some(mm) if mm > 0.0 || (zero && mm == 0.0) => mm,
            Some(_) => {
                let message = format!("`{key}` must be more than 0");
                item.error("bad-size", message, "such as \"5 mm\"");
                sound = false;
                usual
            }
            None => {
                sound = false;
                usual
            }
        }
    };
    let height_u_mm = length("height_u", 0.0, true);
    let repeatability_mm = length("repeatability", 1e-3, false);
    let clearance_mm = length("clearance", 10.0, false);
    let overtravel_mm = length("overtravel", 2.0, false);
    let depth_mm = length("depth", 2.0, false);
    let growth = section.get("growth_within").is_some();
    let growth_within_mm = growth.then(|| length("growth_within", 0.0, true));
    let hint = "the diameter of its cylinder, such as \"10 mm ± 1 um\"";
    let diameter = section.require("diameter", hint).and_then(|i| {
        let value = i.measured_of(Quantity::Diameter)?;
        if value.value <= 0.0 {
            i.error("bad-size", "`diameter` must be more than 0".to_owned(), hint);
            return None;
        }
        Some([value.value, value.u.unwrap_or(0.0)])
    });
    let feed = match section.get("feed") {
        None => Some(50.0),
        Some(item) => item.quantity(Dimension::Velocity).map(|v| v * 60.0),
    };
    let speed = match section.get("speed") {
        None => Some(None),
        Some(item) => {
            let v = item.quantity(Dimension::AngularVelocity);
            v.map(|v| Some(v * 60.0 / std::f64::consts::TAU))
        }
    };
    if feed.is_some_and(|f| f <= 0.0) || speed.flatten().is_some_and(|s| s <= 0.0) {
        let message = "feed and speed of a tool setter are more than 0".to_owned();
        section.error("bad-size", message, "feed = \"50 mm/min\", speed = \"500 rpm\"");
        sound = false;
    }
    let reference = section.get("reference").and_then(|i| i.count());
    sound.then_some(())?;
    Some(ToolSetter {
        at_mm: at?,
        height_u_mm,
        diameter_mm: diameter?,
        repeatability_mm,
        clearance_mm,
        overtravel_mm,
        depth_mm,
        feed_mm_per_min: feed?,
        speed_per_minute: speed?,
        reference: reference.and_then(|n| u32::try_from(n).ok()),
        growth_within_mm,
    })
}
