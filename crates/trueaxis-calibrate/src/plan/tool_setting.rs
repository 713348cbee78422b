//! Tool setting: which touches measure the tools of a set-up at a tool setter, and the program that makes them.
//!
//! ```text
//!     set-up [tool.N], [tool_setter] ──tool_setting──> Touch … ──setting_program──> program of the control
//!     length = Z_touch − Z_face          diameter = X₊ − X₋ − D           docs/model.md eq. 199
//! ```
//!
//! Z_touch, X₊ and X₋ are axis positions without tool length, D the diameter of the setter. The spindle stands, or
//! turns against its cutting sense, so that edges are not damaged and the longest one counts.

mod program;

pub use program::{SettingCheck, check_setting, setting_program};

use std::path::{Path, PathBuf};
use trueaxis_input::{Diagnostics, Place};
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{AxisKind, Command};
use trueaxis_machine::errors::ErrorValues;
use trueaxis_measure::measure::path::leaves_travel;
use trueaxis_motion::{SetUp, SetUpTool, ToolSetter, ToolState};

/// A tool that is measured.
#[derive(Debug, Clone, PartialEq)]
pub struct SetTool {
    /// Its number.
    pub number: u32,
    /// Its name.
    pub name: String,
    /// Its nominal length, mm.
    pub length_mm: f64,
    /// Its nominal diameter, mm.
    pub diameter_mm: Option<f64>,
    /// Limits and what was measured before.
    pub state: ToolState,
    /// It is the gauge that shows the drift.
    pub is_reference: bool,
}

/// What a touch measures.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TouchOf {
    /// The length, from above.
    Length,
    /// The diameter, from the side of greater X.
    Plus,
    /// The diameter, from the side of smaller X.
    Minus,
}

/// One touch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SettingTouch {
    /// The place of the tool in the list of tools.
    pub tool: usize,
    /// What it measures.
    pub of: TouchOf,
    /// Where it begins.
    pub before: Command,
    /// Where the nominal tool touches.
    pub expected: Command,
    /// Where it ends at the latest.
    pub beyond: Command,
}

/// All that is measured, and where.
#[derive(Debug, Clone)]
pub struct ToolSetting {
    /// The machine.
    pub machine: Machine,
    /// Its file.
    pub machine_path: PathBuf,
    /// The set-up.
    pub setup: SetUp,
    /// Its file.
    pub file: String,
    /// The setter.
    pub setter: ToolSetter,
    /// The tools in the order in which they are measured; a gauge comes first.
    pub tools: Vec<SetTool>,
    /// The touches in order.
    pub touches: Vec<SettingTouch>,
    /// The axes X, Y, Z.
    pub axes: [usize; 3],
}

/// The touches for these tools of a set-up; without numbers, for all of them.
pub fn tool_setting(
    (machine, machine_path): (Machine, &Path),
    (setup, file): (SetUp, &str),
    numbers: &[u32],
    problems: &mut Diagnostics,
) -> Option<ToolSetting> {
    let Some(setter) = setup.setter.clone() else {
        let message = "the set-up has no [tool_setter]".to_owned();
        let hint = "[tool_setter] at = \"-150 80 -60 mm\", diameter = \"10 mm\"";
        problems.error("missing-key", Place::whole(file), message, hint);
        return None;
    };
    let axes = linear_axes(&machine, file, problems)?;
    let tools = tools(&setup, &setter, file, numbers, problems)?;
    within_limits((&machine, axes), &setter, file, problems)?;
    let mut setting = ToolSetting {
        machine,
        machine_path: machine_path.to_owned(),
        setup,
        file: file.to_owned(),
        setter,
        tools,
        touches: Vec::new(),
        axes,
    };
    setting.touches = touches(&setting);
    within_travel(&setting, problems).then_some(setting)
}

/// Whether the machine can touch as fast, and turn as fast, as the setter asks for.
fn within_limits(
    (machine, [x, _, z]): (&Machine, [usize; 3]),
    setter: &ToolSetter,
    file: &str,
    problems: &mut Diagnostics,
) -> Option<()> {
    let mut refuse = |message: String| {
        let hint =
            "lower feed or speed of [tool_setter], or correct the limits of the machine file";
        problems.error("setter-beyond-machine", Place::whole(file), message, hint);
    };
    let mut possible = Some(());
    for axis in [x, z].map(|i| &machine.axes()[i]) {
        let most = axis.limits.velocity.map(|mm_per_s| 60.0 * mm_per_s);
        if let Some(most) = most.filter(|most| setter.feed_mm_per_min > most * (1.0 + 1e-9)) {
            let feed = setter.feed_mm_per_min;
            refuse(format!(
                "feed {feed} mm/min of the tool setter: {} moves with at most {most:.4} mm/min",
                axis.name
            ));
            possible = None;
        }
    }
    let speed = setter.speed_per_minute;
    let passed =
        speed.and_then(|speed| Some((speed, machine.equipment().speed_limit_passed(speed)?)));
    if let Some((speed, limit)) = passed {
        let side = if speed > limit { "at most" } else { "at least" };
        refuse(format!(
            "speed {speed:.4} 1/min of the tool setter: the spindle turns with {side} {limit:.4} 1/min"
        ));
        possible = None;
    }
    possible
}

/// X, Y, Z of a machine whose Z moves the tool along itself with the rotary axes at 0.
fn linear_axes(machine: &Machine, file: &str, problems: &mut Diagnostics) -> Option<[usize; 3]> {
    let axis = |letter: char| {
        let linear = |a: &trueaxis_machine::axis::Axis| {
            a.kind == AxisKind::Linear && a.name.letter() == letter
        };
        machine.axes().iter().position(linear)
    };
    let found = match (axis('X'), axis('Y'), axis('Z')) {
        (Some(x), Some(y), Some(z)) => Some([x, y, z]),
        _ => None,
    };
    let along = found.filter(|[.., z]| {
        let none = ErrorValues::default();
        let mut up = Command::default();
        up[*z] = 1.0;
        let [low, high] = [Command::default(), up].map(|q| machine.pose(&q, &none));
        let way = high.shift_mm() - low.shift_mm();
        (way - low.linear().column(2)).norm() < 1e-6
    });
    if along.is_none() {
        let message = format!(
            "{} has no X, Y and Z of which Z moves the tool along itself with the rotary axes at 0",
            machine.name()
        );
        let hint = "lengths are measured along Z: other machines need a setter of their own kind";
        problems.error("cannot-follow", Place::whole(file), message, hint);
    }
    along
}

fn tools(
    setup: &SetUp,
    setter: &ToolSetter,
    file: &str,
    numbers: &[u32],
    problems: &mut Diagnostics,
) -> Option<Vec<SetTool>> {
    let all: Vec<u32> = setup.tools.keys().copied().collect();
    let mut wanted: Vec<u32> = if numbers.is_empty() { all } else { numbers.to_vec() };
    let mut seen = std::collections::HashSet::new();
    wanted.retain(|n| Some(*n) != setter.reference && seen.insert(*n));
    let mut found = Vec::new();
    let mut sound = true;
    for number in setter.reference.into_iter().chain(wanted) {
        let place = setup.tool_places.get(&number).cloned().unwrap_or_else(|| Place::whole(file));
        let mut refuse = |message: String, hint: &str| {
            problems.error("bad-tool", place.clone(), message, hint);
            sound = false;
        };
        let Some(tool) = setup.tools.get(&number) else {
            refuse(format!("the set-up has no tool {number}"), "name a tool of the set-up");
            continue;
        };
        let is_reference = setter.reference == Some(number);
        let (tip, wants_diameter) = (tool.tip_mm, tool.state.measures_diameter && !is_reference);
        if tip.x != 0.0 || tip.y != 0.0 || tip.z >= 0.0 {
            let message =
                format!("the tip of tool {number} is not on the spindle axis in front of it");
            refuse(message, "length = \"90 mm\"");
        }
        if wants_diameter && tool.diameter_mm.is_none() {
            let message =
                format!("the diameter of tool {number} shall be measured, but none is stated");
            refuse(message, "diameter = \"6 mm\"");
        }
        if wants_diameter && tool.diameter_mm.is_some() {
            refuse_corner(tool, (number, setter), &mut refuse);
        }
        if is_reference && tool.state.length.is_none() {
            let message = format!("the reference tool {number} has no calibrated length");
            refuse(message, "measured = { length = \"100.0021 mm ± 0.5 um\" }");
        }
        if setter.overtravel_mm <= tool.state.breakage_mm.unwrap_or(0.0) {
            let message = format!(
                "the overtravel of the setter ({} mm) does not reach a tool {number} that is broken by its limit",
                setter.overtravel_mm
            );
            refuse(message, "overtravel must be more than the largest `breakage`");
        }
        found.push(SetTool {
            number,
            name: tool.name.clone(),
            length_mm: -tip.z,
            diameter_mm: tool.diameter_mm,
            state: ToolState { measures_diameter: wants_diameter, ..tool.state.clone() },
            is_reference,
        });
    }
    if found.iter().all(|t| t.is_reference) && sound {
        let message = "the set-up has no tool to measure".to_owned();
        problems.error("bad-tool", Place::whole(file), message, "[tool.1] length = \"90 mm\"");
        return None;
    }
    sound.then_some(found)
}

/// The side of a tool is touched up to `depth` above its tip: there it must have its whole diameter.
fn refuse_corner(
    tool: &SetUpTool,
    (number, setter): (u32, &ToolSetter),
    refuse: &mut impl FnMut(String, &str),
) {
    let depth_mm = setter.depth_mm;
    match tool.whole_from_mm() {
        Some(from_mm) if from_mm <= depth_mm => {}
        Some(from_mm) => {
            let message = format!(
                "tool {number} has its whole diameter from {from_mm:.3} mm above its tip on, and its side is touched {depth_mm} mm above it"
            );
            let hint = "`depth` of [tool_setter] must reach above the corner radius or the point, or leave `measure_diameter` out";
            refuse(message, hint);
        }
        None => {
            let message = format!("tool {number} is a taper: its side has no one diameter");
            refuse(message, "leave `measure_diameter` out");
        }
    }
}

impl ToolSetting {
    /// Axis positions; the rotary axes at 0.
    fn at(&self, x: f64, z: f64) -> Command {
        let mut command = Command::default();
        command[self.axes[0]] = x;
        command[self.axes[1]] = self.setter.at_mm.y;
        command[self.axes[2]] = z;
        command
    }

    /// What the tool is nominally at the setter: its calibrated length if it is the gauge, mm.
    pub fn expected_length_mm(&self, tool: &SetTool) -> f64 {
        let calibrated = tool.state.length.filter(|_| tool.is_reference);
        calibrated.map_or(tool.length_mm, |l| l.mm)
    }
}

fn touches(setting: &ToolSetting) -> Vec<SettingTouch> {
    let (setter, mut all) = (&setting.setter, Vec::new());
    let at = setter.at_mm;
    for (k, tool) in setting.tools.iter().enumerate() {
        let touched = at.z + setting.expected_length_mm(tool);
        all.push(SettingTouch {
            tool: k,
            of: TouchOf::Length,
            before: setting.at(at.x, touched + setter.clearance_mm),
            expected: setting.at(at.x, touched),
            beyond: setting.at(at.x, touched - setter.overtravel_mm),
        });
        let Some(diameter) = tool.diameter_mm.filter(|_| tool.state.measures_diameter) else {
            continue;
        };
        let reach = 0.5 * (diameter + setter.diameter_mm[0]);
        for (of, side) in [(TouchOf::Plus, 1.0), (TouchOf::Minus, -1.0)] {
            let x = |gap: f64| at.x + side * (reach + gap);
            let z = touched - setter.depth_mm;
            all.push(SettingTouch {
                tool: k,
                of,
                before: setting.at(x(setter.clearance_mm), z),
                expected: setting.at(x(0.0), z),
                beyond: setting.at(x(-setter.overtravel_mm), z),
            });
        }
    }
    all
}

fn within_travel(setting: &ToolSetting, problems: &mut Diagnostics) -> bool {
    let mut sound = true;
    for touch in &setting.touches {
        let strayed = [touch.before, touch.beyond]
            .iter()
            .find_map(|command| leaves_travel(&setting.machine, command));
        let Some(strayed) = strayed else { continue };
        sound = false;
        let tool = setting.tools[touch.tool].number;
        let place = setting.setup.tool_places.get(&tool).cloned();
        let place = place.unwrap_or_else(|| Place::whole(&setting.file));
        let hint = "`at` of the tool setter: the axis positions at which a tool of length 0 would touch its face";
        let message = format!("tool {tool} cannot be measured: {strayed}");
        problems.error("unreachable-point", place, message, hint);
    }
    sound
}
