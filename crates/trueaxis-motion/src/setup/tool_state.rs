//! What is known of the state of a tool: measured size, limits of wear and breakage, life, sister tool.

use trueaxis_input::plausible::Quantity;
use trueaxis_input::{Dimension, Item, Section};

/// A size with its standard uncertainty, mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeasuredSize {
    /// The size, mm.
    pub mm: f64,
    /// Its standard uncertainty (k = 1), mm; 0 if none is stated.
    pub u_mm: f64,
}

/// How long a tool may cut, and how long it has.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ToolLife {
    /// What counts.
    pub by: LifeBy,
    /// The whole life. Unit: s or mm.
    pub allowed: f64,
    /// What was used before this program. Unit: s or mm.
    pub used: f64,
}

/// What counts as life.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LifeBy {
    /// Time with feed.
    Time,
    /// Path with feed.
    Distance,
}

/// The state of a tool, as far as the set-up states it.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ToolState {
    /// The length as it was measured last.
    pub length: Option<MeasuredSize>,
    /// The diameter as it was measured last.
    pub diameter: Option<MeasuredSize>,
    /// When.
    pub date: Option<String>,
    /// How much the length may have changed by wear, mm.
    pub wear_length_mm: Option<f64>,
    /// How much the radius may have changed by wear, mm.
    pub wear_radius_mm: Option<f64>,
    /// A length that differs by more than this is that of a broken tool, mm.
    pub breakage_mm: Option<f64>,
    /// How long it may cut.
    pub life: Option<ToolLife>,
    /// The tool that takes its place.
    pub sister: Option<u32>,
    /// Whether the diameter shall be measured as well at the tool setter.
    pub measures_diameter: bool,
}

/// The keys of a tool that speak of its state.
pub(super) fn read_state(section: &Section<'_>) -> ToolState {
    let mut state = ToolState::default();
    section.section("measured", |s| {
        state.length = s.get("length").and_then(|i| size(&i));
        state.diameter = s.get("diameter").and_then(|i| size(&i));
        state.date = s.get("date").and_then(|i| i.date());
        if s.get("length").is_none() && s.get("diameter").is_none() {
            let hint = "measured = { length = \"89.98 mm ± 2 um\", diameter = \"2.99 mm\" }";
            s.error("missing-key", "nothing was measured".to_owned(), hint);
        }
    });
    section.section("wear_limit", |s| {
        state.wear_length_mm = s.get("length").and_then(|i| positive(&i, Dimension::Length));
        state.wear_radius_mm = s.get("radius").and_then(|i| positive(&i, Dimension::Length));
    });
    state.breakage_mm = section.get("breakage").and_then(|i| positive(&i, Dimension::Length));
    state.life = section.section("life", read_life).flatten();
    state.sister =
        section.get("sister").and_then(|i| i.count()).and_then(|n| u32::try_from(n).ok());
    state.measures_diameter =
        section.get("measure_diameter").and_then(|i| i.flag()).unwrap_or(false);
    if let (Some(wear), Some(breakage)) = (state.wear_length_mm, state.breakage_mm)
        && breakage <= wear
    {
        let message = format!(
            "a tool that is {wear} mm off in length is worn, one that is {breakage} mm off is broken"
        );
        section.error("bad-tool", message, "breakage must be more than the limit of wear");
    }
    state
}

fn size(item: &Item<'_>) -> Option<MeasuredSize> {
    let value = item.measured_of(Quantity::ToolLength)?;
    if value.value <= 0.0 {
        let message = "a measured size is more than 0".to_owned();
        item.error("bad-size", message, "the whole length or diameter, not the deviation");
        return None;
    }
    Some(MeasuredSize { mm: value.value, u_mm: value.u.unwrap_or(0.0) })
}

fn positive(item: &Item<'_>, dimension: Dimension) -> Option<f64> {
    // A tool cuts some km.
    let value = item.unjudged(dimension)?;
    if value <= 0.0 {
        item.error("bad-size", "the limit must be more than 0".to_owned(), "such as \"50 um\"");
        return None;
    }
    Some(value)
}

/// `life = { time = "90 min", used = "60 min" }`, or `distance`.
fn read_life(section: &Section<'_>) -> Option<ToolLife> {
    let (time, distance) = (section.get("time"), section.get("distance"));
    let used = section.get("used");
    let (by, item, dimension) = match (time, distance) {
        (Some(item), None) => (LifeBy::Time, item, Dimension::Time),
        (None, Some(item)) => (LifeBy::Distance, item, Dimension::Length),
        _ => {
            let message = "the life of a tool counts either by time or by distance".to_owned();
            section.error("missing-key", message, "life = { time = \"90 min\", used = \"0 min\" }");
            return None;
        }
    };
    let allowed = positive(&item, dimension)?;
    let used = match used {
        Some(used) => {
            let value = used.unjudged(dimension)?;
            if value < 0.0 {
                used.error("bad-size", "`used` is 0 or more".to_owned(), "such as \"20 min\"");
                return None;
            }
            value
        }
        None => 0.0,
    };
    Some(ToolLife { by, allowed, used })
}
