//! Whether the tools that a program uses are fit for it: broken, worn, at the end of their life.
//!
//! ```text
//!     d = measured − nominal        |d| > breakage: broken        |d| > wear limit: to be replaced
//!     life − used − use by this program ≥ 0                                docs/model.md eq. 198
//! ```
//!
//! As on controls with tool measuring the sign of d does not count: a tool that is longer than it should be was
//! changed or is not seated. Where d with its expanded uncertainty passes a limit that d itself keeps, this is noted.

use crate::setup::{LifeBy, MeasuredSize, SetUp, SetUpTool, ToolLife};
use crate::summary::{Summary, ToolUse};
use trueaxis_input::{Diagnostics, Place};

/// The codes of tools that must not be used as they are.
pub(crate) const CODES: [&str; 3] = ["tool-broken", "tool-worn", "tool-life"];

/// How a tool stands.
#[derive(Debug, Clone, PartialEq)]
pub struct ToolStanding {
    /// Its number.
    pub number: u32,
    /// Measured − nominal length with its standard uncertainty, mm.
    pub length_off_mm: Option<[f64; 2]>,
    /// Measured − nominal radius with its standard uncertainty, mm.
    pub radius_off_mm: Option<[f64; 2]>,
    /// What this program uses.
    pub used: ToolUse,
    /// What counts as its life, if that is stated.
    pub life_by: Option<LifeBy>,
    /// What remains of it after this program. Unit: s or mm.
    pub life_after: Option<f64>,
    /// The tool that takes its place.
    pub sister: Option<u32>,
    /// What stands against it: code and words.
    pub faults: Vec<(&'static str, String)>,
    /// What cannot be decided.
    pub doubts: Vec<String>,
}

impl ToolStanding {
    /// Whether the tool can be used as it is.
    pub fn is_fit(&self) -> bool {
        self.faults.is_empty()
    }

    /// In one or two words.
    pub fn word(&self) -> &'static str {
        match self.faults.first().map(|f| f.0) {
            Some("tool-broken") => "broken",
            Some("tool-worn") => "worn",
            Some(_) => "life spent",
            None if !self.doubts.is_empty() => "not decided",
            None => "fit",
        }
    }
}

/// The tools of a run, in the order of their numbers; only those of which a state is stated.
pub fn tool_standings(setup: &SetUp, summary: &Summary) -> Vec<ToolStanding> {
    let used = summary.tools.keys().filter_map(|n| Some((*n, setup.tools.get(n)?)));
    let stated = used.filter(|(_, tool)| {
        let s = &tool.state;
        s.length.is_some() || s.diameter.is_some() || s.life.is_some()
    });
    stated
        .map(|(n, tool)| standing(n, tool, summary.tool_use.get(&n).copied().unwrap_or_default()))
        .collect()
}

/// A tool as it stands after it was used so much.
pub fn standing(number: u32, tool: &SetUpTool, used: ToolUse) -> ToolStanding {
    let state = &tool.state;
    let off = |size: MeasuredSize, nominal_mm: f64, share: f64| {
        [(size.mm - nominal_mm) * share, size.u_mm * share]
    };
    let length_off_mm = state.length.map(|l| off(l, -tool.tip_mm.z, 1.0));
    let radius_off_mm =
        state.diameter.zip(tool.diameter_mm).map(|(d, nominal)| off(d, nominal, 0.5));
    let mut found = ToolStanding {
        number,
        length_off_mm,
        radius_off_mm,
        used,
        life_by: state.life.map(|l| l.by),
        life_after: state.life.map(|l| remaining(&l, used)),
        sister: state.sister,
        faults: Vec::new(),
        doubts: Vec::new(),
    };
    // The first limit that is passed says what the tool is; the next one adds nothing.
    let length = [
        ("tool-broken", "breakage", state.breakage_mm),
        ("tool-worn", "wear", state.wear_length_mm),
    ];
    judge(&mut found, "length", length_off_mm, &length);
    judge(&mut found, "radius", radius_off_mm, &[("tool-worn", "wear", state.wear_radius_mm)]);
    if let (Some(life), Some(after)) = (state.life, found.life_after.filter(|after| *after < 0.0)) {
        let words = format!(
            "this program cuts {}, {} of {} are left: {} too little",
            shown(life.by, part(life.by, used)),
            shown(life.by, (life.allowed - life.used).max(0.0)),
            shown(life.by, life.allowed),
            shown(life.by, -after)
        );
        found.faults.push(("tool-life", words));
    }
    found
}

type Limit = (&'static str, &'static str, Option<f64>);

fn judge(found: &mut ToolStanding, what: &str, off: Option<[f64; 2]>, limits: &[Limit]) {
    let Some([d, u]) = off else { return };
    for (code, name, limit) in limits {
        let Some(limit) = limit else { continue };
        let words = format!(
            "measured {what} {:+.1} µm from nominal (U = {:.1} µm, k = 2), limit of {name} {:.1} µm",
            d * 1e3,
            2e3 * u,
            limit * 1e3
        );
        if d.abs() > *limit {
            found.faults.push((code, words));
            return;
        }
        if d.abs() + 2.0 * u > *limit {
            found.doubts.push(words);
        }
    }
}

fn part(by: LifeBy, used: ToolUse) -> f64 {
    match by {
        LifeBy::Time => used.feed_s,
        LifeBy::Distance => used.feed_mm,
    }
}

fn remaining(life: &ToolLife, used: ToolUse) -> f64 {
    life.allowed - life.used - part(life.by, used)
}

/// `12.3 min` or `4.56 m`.
pub(crate) fn shown(by: LifeBy, value: f64) -> String {
    match by {
        LifeBy::Time => format!("{:.2} min", value / 60.0),
        LifeBy::Distance => format!("{:.2} m", value / 1e3),
    }
}

/// Says what stands against the tools of a run. A fit sister takes the place of a tool that is not: the control
/// changes to it, the simulation does not.
pub(crate) fn tell(setup: &SetUp, summary: &Summary, problems: &mut Diagnostics) {
    for tool in tool_standings(setup, summary) {
        let place = setup.tool_places.get(&tool.number).cloned();
        let place = place.unwrap_or_else(|| Place::whole("set-up"));
        let sister = tool.sister.and_then(|n| Some((n, setup.tools.get(&n)?)));
        let fit = sister.filter(|(n, t)| standing(*n, t, tool.used).is_fit());
        for (code, words) in &tool.faults {
            let name = match *code {
                "tool-broken" => "is broken",
                "tool-worn" => "is worn",
                _ => "comes to the end of its life",
            };
            let message = format!("tool {} {name}: {words}", tool.number);
            match (fit, sister) {
                (Some((n, _)), _) => {
                    let hint = format!(
                        "the control takes the sister tool {n} in its place; the simulation goes on with the size \
                         of tool {}",
                        tool.number
                    );
                    problems.warn("tool-replaced", place.clone(), message, &hint);
                }
                (None, Some((n, _))) => {
                    let hint =
                        format!("its sister tool {n} is not fit either: replace one of them");
                    problems.warn(code, place.clone(), message, &hint);
                }
                (None, None) => {
                    let hint = "replace and measure it, or name a sister tool: sister = 2";
                    problems.warn(code, place.clone(), message, hint);
                }
            }
        }
        for words in &tool.doubts {
            let message = format!("tool {}: {words}", tool.number);
            let hint = "the uncertainty reaches beyond the limit: measure again, more exactly";
            problems.note("tool-near-limit", place.clone(), message, hint);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::setup::ToolState;
    use trueaxis_geometry::Vec3;

    fn tool(length_mm: f64, u_mm: f64) -> SetUpTool {
        SetUpTool {
            tip_mm: Vec3::new(0.0, 0.0, -90.0),
            diameter_mm: Some(3.0),
            state: ToolState {
                length: Some(MeasuredSize { mm: length_mm, u_mm }),
                wear_length_mm: Some(0.05),
                breakage_mm: Some(0.2),
                life: Some(ToolLife { by: LifeBy::Time, allowed: 600.0, used: 540.0 }),
                ..ToolState::default()
            },
            ..SetUpTool::default()
        }
    }

    #[test]
    fn states_by_hand() {
        let none = ToolUse::default();
        let word = |length, u| standing(1, &tool(length, u), none).word();
        assert_eq!(word(89.96, 0.002), "fit");
        // 49 µm of 50 µm with U = 4 µm: not decided; 51 µm: worn; longer counts as shorter does.
        assert_eq!((word(89.951, 0.002), word(89.949, 0.002)), ("not decided", "worn"));
        assert_eq!(
            (word(90.051, 0.0), word(89.7, 0.0), word(90.3, 0.0)),
            ("worn", "broken", "broken")
        );
        // 60 s of life are left: 61 s are too much.
        let cut = |feed_s| standing(1, &tool(90.0, 0.0), ToolUse { feed_s, feed_mm: 0.0 });
        assert_eq!((cut(59.0).word(), cut(61.0).word()), ("fit", "life spent"));
        assert!(cut(61.0).faults[0].1.contains("0.02 min too little"), "{:?}", cut(61.0).faults);
    }
}
