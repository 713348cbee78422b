//! The state of the tools in a report, and what of the spindle is checked.

use crate::tool_check::shown as life_shown;
use crate::{LifeBy, SetUp, Summary, ToolStanding, tool_standings};
use serde::Serialize;
use trueaxis_machine::Machine;
use trueaxis_report::JsonSchema;
use trueaxis_report::{Section, Table};

/// Wear, breakage and life of the tools, where the set-up states them.
pub(super) fn state_section(setup: &SetUp, summary: &Summary) -> Option<Section<'static>> {
    let standings = tool_standings(setup, summary);
    if standings.is_empty() {
        return None;
    }
    let off = |off: Option<[f64; 2]>| {
        off.map_or_else(String::new, |[d, u]| format!("{:+.1} ± {:.1}", d * 1e3, 2e3 * u))
    };
    let row = |t: &ToolStanding| {
        let life = t.life_by.zip(t.life_after);
        [
            format!("T{}", t.number),
            t.word().to_owned(),
            off(t.length_off_mm),
            off(t.radius_off_mm),
            format!("{:.2}", t.used.feed_s / 60.0),
            format!("{:.2}", t.used.feed_mm / 1e3),
            life.map_or_else(String::new, |(by, after)| life_shown(by, after)),
            t.sister.map_or_else(String::new, |n| format!("T{n}")),
        ]
    };
    let table = Table::new([
        "tool",
        "state",
        "length, measured − nominal, µm (k = 2)",
        "radius, µm (k = 2)",
        "with feed, min",
        "with feed, m",
        "life left after it",
        "sister",
    ]);
    Some(Section::new("State of the tools").table(table.rows(standings.iter().map(row))))
}

/// What of the spindle is checked.
pub(super) fn spindle_section(machine: &Machine) -> Option<Section<'static>> {
    let equipment = machine.equipment();
    let kw = equipment.spindle_power_w? / 1e3;
    let speed = match equipment.max_spindle_rad_per_s.or(equipment.min_spindle_rad_per_s) {
        Some(_) => "The speed of the spindle is checked against its limits.",
        None => "The speed of the spindle is not checked: the machine file states no limit of it.",
    };
    Some(Section::new("Spindle").paragraph(format!(
        "{speed} Its power of {kw} kW is not checked: a program states no cutting force, and none is assumed."
    )))
}

/// The state of a tool.
#[derive(Debug, Serialize, JsonSchema)]
pub struct ToolStateEntry {
    /// In one or two words: `fit`, `not decided`, `worn`, `broken` or `life spent`.
    pub word: &'static str,
    /// Measured − nominal length, µm; null if it was not measured.
    pub length_off_um: Option<f64>,
    /// Its expanded uncertainty (k = 2), µm.
    #[serde(rename = "U_length_um")]
    pub expanded_length_um: Option<f64>,
    /// Measured − nominal radius, µm; null if it was not measured.
    pub radius_off_um: Option<f64>,
    /// Its expanded uncertainty (k = 2), µm.
    #[serde(rename = "U_radius_um")]
    pub expanded_radius_um: Option<f64>,
    /// The life that remains after this program, s; null if it does not count by time.
    pub life_after_s: Option<f64>,
    /// The life that remains after this program, mm; null if it does not count by distance.
    pub life_after_mm: Option<f64>,
    /// The tool that takes its place.
    pub sister: Option<u32>,
}

impl From<&ToolStanding> for ToolStateEntry {
    fn from(t: &ToolStanding) -> Self {
        let by = |by| t.life_after.filter(|_| t.life_by == Some(by));
        Self {
            word: t.word(),
            length_off_um: t.length_off_mm.map(|[d, _]| d * 1e3),
            expanded_length_um: t.length_off_mm.map(|[_, u]| 2e3 * u),
            radius_off_um: t.radius_off_mm.map(|[d, _]| d * 1e3),
            expanded_radius_um: t.radius_off_mm.map(|[_, u]| 2e3 * u),
            life_after_s: by(LifeBy::Time),
            life_after_mm: by(LifeBy::Distance),
            sister: t.sister,
        }
    }
}
