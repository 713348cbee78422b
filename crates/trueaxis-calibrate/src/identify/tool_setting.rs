//! What the readings of a tool setting say: length, wear and uncertainty of each tool.
//!
//! ```text
//!     L = Z − Z_face − δ,  δ = Z_gauge − Z_face − L_gauge (0 without a gauge)
//!     u²(L) = s² + u²(face) + g²/3              without a gauge, spindle and setter within ±g
//!     u²(L) = 2s² + u²(L_gauge)                 with one                          docs/model.md eq. 199
//!     D = X₊ − X₋ − D_setter,  u²(D) = 2s² + u²(D_setter)
//! ```
//!
//! Growth of spindle and setter since the face was calibrated shifts all lengths alike; only a gauge shows it. The
//! diameter does not see it.

use super::surface::{HitsLog, LoggedHit};
use crate::plan::tool_setting::{SetTool, SettingTouch, ToolSetting, TouchOf};
use trueaxis_input::{Diagnostics, Place};
use trueaxis_machine::describe::replacement::quoted;
use trueaxis_motion::{MeasuredSize, SetUpTool, ToolStanding, ToolUse, standing};

/// A log belongs to another place if its axes are off by more, mm.
const SAME_MM: f64 = 1e-2;

/// A tool that was measured.
#[derive(Debug, Clone, PartialEq)]
pub struct MeasuredTool {
    /// Its number.
    pub number: u32,
    /// Its name.
    pub name: String,
    /// Its nominal length, mm.
    pub nominal_mm: f64,
    /// Its length.
    pub length: MeasuredSize,
    /// Its diameter, if it was measured.
    pub diameter: Option<MeasuredSize>,
    /// How it stands against its limits.
    pub standing: ToolStanding,
}

/// What a log of a tool setting says.
#[derive(Debug, Clone, PartialEq)]
pub struct ToolReadings {
    /// The tools in the order of their numbers.
    pub tools: Vec<MeasuredTool>,
    /// What a gauge shows of the drift of spindle and setter, with its standard uncertainty, mm.
    pub drift: Option<MeasuredSize>,
    /// What is not covered by the uncertainties.
    pub missing: Vec<String>,
    /// Whether a virtual machine wrote the log.
    pub is_virtual: bool,
}

/// Evaluates the log of a tool setting.
pub fn measured_tools(
    setting: &ToolSetting,
    log: &HitsLog,
    file: &str,
    problems: &mut Diagnostics,
) -> Option<ToolReadings> {
    let hits = hits(setting, log, file, problems)?;
    let setter = &setting.setter;
    let [_, _, z] = setting.axes;
    let s = setter.repeatability_mm;
    let at = |k: usize, of: TouchOf, axis: usize| {
        let touch = setting.touches.iter().position(|t| t.tool == k && t.of == of)?;
        Some(hits[touch].command[axis])
    };
    let gauge = setting.tools.iter().enumerate().find(|(_, t)| t.is_reference);
    let drift = gauge.and_then(|(k, tool)| {
        let u_mm = s.hypot(tool.state.length.map_or(0.0, |l| l.u_mm));
        let mm = at(k, TouchOf::Length, z)? - setter.at_mm.z - setting.expected_length_mm(tool);
        Some(MeasuredSize { mm, u_mm })
    });
    let of_face = match (&drift, setter.growth_within_mm) {
        (Some(drift), _) => drift.u_mm,
        (None, growth) => setter.height_u_mm.hypot(growth.unwrap_or(0.0) / 3f64.sqrt()),
    };
    let delta = drift.map_or(0.0, |d| d.mm);
    let one = |(k, tool): (usize, &SetTool)| {
        let mm = at(k, TouchOf::Length, z)? - setter.at_mm.z - delta;
        let length = MeasuredSize { mm, u_mm: s.hypot(of_face) };
        let sides =
            at(k, TouchOf::Plus, setting.axes[0]).zip(at(k, TouchOf::Minus, setting.axes[0]));
        let diameter = sides.map(|(plus, minus)| {
            let [size, u] = setter.diameter_mm;
            MeasuredSize { mm: plus - minus - size, u_mm: (2.0 * s * s + u * u).sqrt() }
        });
        Some(measured(setting, tool, length, diameter))
    };
    let others = setting.tools.iter().enumerate().filter(|(_, t)| !t.is_reference);
    Some(ToolReadings {
        tools: others.filter_map(one).collect(),
        missing: missing(setting, drift.is_some()),
        drift,
        is_virtual: log.is_virtual,
    })
}

fn measured(
    setting: &ToolSetting,
    tool: &SetTool,
    length: MeasuredSize,
    diameter: Option<MeasuredSize>,
) -> MeasuredTool {
    let mut now: SetUpTool = setting.setup.tools.get(&tool.number).cloned().unwrap_or_default();
    now.state.length = Some(length);
    now.state.diameter = diameter.or(now.state.diameter);
    MeasuredTool {
        number: tool.number,
        name: tool.name.clone(),
        nominal_mm: tool.length_mm,
        length,
        diameter,
        standing: standing(tool.number, &now, ToolUse::default()),
    }
}

/// What the set-up does not state.
fn missing(setting: &ToolSetting, has_gauge: bool) -> Vec<String> {
    let mut missing = Vec::new();
    let setter = &setting.setter;
    if !has_gauge && setter.growth_within_mm.is_none() {
        missing.push(
            "growth of spindle and setter by heat since the face was calibrated shifts all lengths alike and is not \
             in U: measure a gauge (reference = N), or state growth_within"
                .to_owned(),
        );
    }
    if !has_gauge && setter.height_u_mm == 0.0 {
        missing
            .push("the uncertainty of the height of the face is not stated: height_u".to_owned());
    }
    if setter.speed_per_minute.is_none() {
        missing.push(
            "the spindle stood still: run-out and the longest edge are not in the result"
                .to_owned(),
        );
    }
    missing
}

/// One hit for each touch, in the order of the touches.
fn hits<'l>(
    setting: &ToolSetting,
    log: &'l HitsLog,
    file: &str,
    problems: &mut Diagnostics,
) -> Option<Vec<&'l LoggedHit>> {
    let mut sound = true;
    let mut refuse = |place: Place, code: &'static str, message: String, hint: &str| {
        problems.error(code, place, message, hint);
        sound = false;
    };
    let wanted = setting.touches.len();
    if log.end.is_some_and(|end| end != wanted) || log.hits.len() > wanted {
        let message = format!(
            "the log has {} hits, the tools of the set-up need {wanted}",
            log.end.unwrap_or(log.hits.len())
        );
        refuse(Place::whole(file), "too-many-hits", message, "is it the log of these tools?");
    } else if log.end.is_none() {
        let message = "the log has no END: the program did not come to its end".to_owned();
        refuse(Place::whole(file), "lost-hits", message, "run it again, or see its alarm");
    }
    let mut found = Vec::new();
    for (i, touch) in setting.touches.iter().enumerate() {
        let tool = setting.tools[touch.tool].number;
        let mut own = log.hits.iter().filter(|h| h.hit == i + 1);
        let Some(hit) = own.next() else {
            let message = format!("hit {} (tool {tool}) is missing", i + 1);
            refuse(Place::whole(file), "lost-hits", message, "run the program again");
            continue;
        };
        if own.next().is_some() {
            let message = format!("hit {} stands twice in the log", i + 1);
            refuse(hit.place.clone(), "hits-out-of-order", message, "keep one run in each file");
        }
        let other = hit.tool.filter(|t| *t != tool as usize);
        if other.is_some() || hit.point != tool as usize {
            let logged = other.unwrap_or(hit.point);
            let message = format!("hit {} is of tool {logged}, expected is tool {tool}", i + 1);
            refuse(hit.place.clone(), "other-tool", message, "is it the log of this set-up?");
        } else if let Some(words) = off_way(setting, touch, hit) {
            let hint = "is it the log of this set-up and this setter? lengths are nominal in it";
            refuse(hit.place.clone(), "far-hit", format!("hit {}: {words}", i + 1), hint);
        }
        found.push(hit);
    }
    (sound && found.len() == wanted).then_some(found)
}

/// A touch ends between its beginning and its end, and nowhere else.
fn off_way(setting: &ToolSetting, touch: &SettingTouch, hit: &LoggedHit) -> Option<String> {
    let own = match touch.of {
        TouchOf::Length => setting.axes[2],
        TouchOf::Plus | TouchOf::Minus => setting.axes[0],
    };
    for (i, axis) in setting.machine.axes().iter().enumerate() {
        let at = hit.command[i];
        let (a, b) = (touch.before[i], touch.beyond[i]);
        let (low, high) = (a.min(b), a.max(b));
        let inside = match i == own {
            true => (low..=high).contains(&at),
            false => (low - SAME_MM..=high + SAME_MM).contains(&at),
        };
        if !inside {
            return Some(format!(
                "{} is at {at:.4}, the touch goes from {a:.4} to {b:.4}",
                axis.name
            ));
        }
    }
    None
}

/// The lines of the set-up for what was measured.
pub fn setup_lines(readings: &ToolReadings, date: Option<&str>) -> String {
    let mut text = String::new();
    for tool in &readings.tools {
        let size = |s: &MeasuredSize| format!("\"{:.4} mm ± {:.4} mm\"", s.mm, s.u_mm);
        let diameter = tool.diameter.as_ref().map(|d| format!(", diameter = {}", size(d)));
        let date = date.map(|d| format!(", date = {}", quoted(d))).unwrap_or_default();
        text += &format!(
            "[tool.{}]\nmeasured = {{ length = {}{}{date} }}\n",
            tool.number,
            size(&tool.length),
            diameter.unwrap_or_default()
        );
    }
    text
}
