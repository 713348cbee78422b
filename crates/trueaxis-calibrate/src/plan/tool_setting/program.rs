//! The program of a tool setting, in the words of each control.
//!
//! # Source
//! Touches: see [`crate::plan::touch`]. FANUC: G10 L11 and L13, wear of length and radius (tool compensation memory C);
//! HAAS: the same levels; what stands under D counts as radius or diameter by its setting 40. SINUMERIK:
//! `$TC_DP12` and `$TC_DP15`, wear of length 1 and of the radius. LinuxCNC: G10 L1, the whole length and radius, as its
//! tool table has no wear. HEIDENHAIN: touch-probe cycles 31 and 32 (481, 482), which use its calibrated TT, LTOL,
//! RTOL and LBREAK of its tool table, and report the state in a parameter: 1 worn, 2 broken. The form of
//! the cycles and `$TC_DP12` were seen in public programs; the values of the parameter and setting 40 are from knowledge of
//! the manuals.

use super::{SetTool, SettingTouch, ToolSetting, TouchOf};
use crate::plan::program::{ProgramCheck, ProgramError, axis_target, run};
use crate::plan::touch::{SURFACE_LOG, Touch, TouchLog, declare};
use trueaxis_machine::axis::{AxisKind, Command, Travel};
use trueaxis_motion::SetUp;
use trueaxis_nc::moves::{Axis, Feed, FeedMode, Position, SpindleDirection};
use trueaxis_nc::{Control, Program};
use trueaxis_writer::{Block, Heading, ToolCall, Writer};

/// Back from a touch and beside the setter, mm/min.
const BACK_MM_PER_MIN: f64 = 1000.0;
/// Numbers of blocks of the checks begin here: those below are of the touches.
const FIRST_BLOCK: usize = 1000;

/// What the machine would do with the program.
pub type SettingCheck = ProgramCheck;

/// The program.
///
/// # Errors
/// Something that the control cannot write.
pub fn setting_program(setting: &ToolSetting, control: Control) -> Result<Vec<u8>, ProgramError> {
    if control == Control::Heidenhain {
        return by_cycles(setting);
    }
    let log = TouchLog { machine: &setting.machine, control, is_stand_in: false };
    let mut p =
        Written { setting, control, log, writer: Writer::new(control), checks: FIRST_BLOCK };
    if let Some(text) = declare(control) {
        p.text(text)?;
        p.text("DEF REAL SET_OFF, SET_PLUS, SET_DRIFT")?;
    }
    p.begin()?;
    p.text(&SURFACE_LOG.open(control))?;
    for (k, tool) in setting.tools.iter().enumerate() {
        p.tool(tool)?;
        for (i, touch) in setting.touches.iter().enumerate().filter(|(_, t)| t.tool == k) {
            p.touch(i + 1, touch, tool)?;
        }
        if setting.setter.speed_per_minute.is_some() {
            p.writer.write(&Block::Spindle(SpindleDirection::Stopped, 0.0))?;
        }
    }
    p.text(&SURFACE_LOG.close(control, setting.touches.len()))?;
    p.writer.write(&Block::End)?;
    Ok(p.writer.finish())
}

struct Written<'a> {
    setting: &'a ToolSetting,
    control: Control,
    log: TouchLog<'a>,
    writer: Writer,
    checks: usize,
}

impl Written<'_> {
    fn text(&mut self, text: &str) -> Result<(), ProgramError> {
        Ok(self.writer.write(&Block::Text(text))?)
    }

    fn begin(&mut self) -> Result<(), ProgramError> {
        let about =
            format!("{} tools on {}", self.setting.tools.len(), self.setting.machine.name());
        let wear = match self.control {
            Control::LinuxCnc => "writes length and radius into the tool table",
            _ => "writes wear: the geometry of each tool must be its nominal length and radius",
        };
        self.writer
            .write(&Block::Start(&Heading::of_measuring("TOOL_SETTING", &[&about, wear])))?;
        let text = "SETTER CLEAN, SPINDLE WARM, ALL CLEAR";
        Ok(self.writer.write(&Block::Stop { optional: false, message: Some(text) })?)
    }

    /// Changes the tool, high up, with the rotary axes at 0 and over the setter.
    fn tool(&mut self, tool: &SetTool) -> Result<(), ProgramError> {
        self.lift()?;
        let call = ToolCall { number: tool.number, text: &tool.name, ..ToolCall::default() };
        self.writer.write(&Block::Tool(&call))?;
        let nominal = format!("nominal length {:.4} mm", tool.length_mm);
        self.writer.write(&Block::Comment(&nominal))?;
        self.lift()?;
        let rotary = |i: usize| self.setting.machine.axes()[i].kind == AxisKind::Rotary;
        let zero = Command::default();
        if (0..self.setting.machine.axes().len()).any(rotary) {
            let target = axis_target(&self.setting.machine, self.control, &zero, rotary);
            self.writer.write(&Block::Rapid(target))?;
        }
        if let Some(speed) = self.setting.setter.speed_per_minute.filter(|_| !tool.is_reference) {
            self.writer.write(&Block::Spindle(SpindleDirection::CounterClockwise, speed))?;
        }
        Ok(())
    }

    /// The end of Z, or well above the setter.
    fn top(&self) -> f64 {
        let z = self.setting.axes[2];
        match self.setting.machine.axes()[z].travel {
            Travel::Between(_, top) => top,
            _ => {
                let all = self.setting.touches.iter().map(|t| t.before[z]);
                all.fold(f64::NEG_INFINITY, f64::max) + 100.0
            }
        }
    }

    fn lift(&mut self) -> Result<(), ProgramError> {
        let z = self.setting.axes[2];
        let mut up = Command::default();
        up[z] = self.top();
        self.rapid(&up, &[z])
    }

    fn rapid(&mut self, to: &Command, named: &[usize]) -> Result<(), ProgramError> {
        let target = axis_target(&self.setting.machine, self.control, to, |i| named.contains(&i));
        Ok(self.writer.write(&Block::Rapid(target))?)
    }

    fn line(&mut self, to: &Command, mm_per_min: f64) -> Result<(), ProgramError> {
        let axes = self.setting.axes;
        let target = axis_target(&self.setting.machine, self.control, to, |i| axes.contains(&i));
        let feed = Feed { mode: FeedMode::PerMinute, value: mm_per_min };
        Ok(self.writer.write(&Block::Line(target, feed))?)
    }

    fn touch(
        &mut self,
        hit: usize,
        touch: &SettingTouch,
        tool: &SetTool,
    ) -> Result<(), ProgramError> {
        let [x, y, z] = self.setting.axes;
        self.lift()?;
        self.rapid(&touch.before, &[x, y])?;
        match touch.of {
            TouchOf::Length => self.rapid(&touch.before, &[z])?,
            // Beside the setter the way down is with feed.
            TouchOf::Plus | TouchOf::Minus => self.line(&touch.before, BACK_MM_PER_MIN)?,
        }
        let text = self.log.touch(&Touch {
            from: &touch.before,
            target: &touch.beyond,
            mm_per_min: self.setting.setter.feed_mm_per_min,
            hit,
            pose: tool.number as usize,
        })?;
        self.text(&text)?;
        let text = match touch.of {
            TouchOf::Length if tool.is_reference => self.reference(tool),
            TouchOf::Length => self.length(tool),
            TouchOf::Plus => self.plus(),
            TouchOf::Minus => self.diameter(tool),
        };
        self.text(&text)?;
        self.line(&touch.before, BACK_MM_PER_MIN)?;
        self.lift()
    }

    fn is_fanuc(&self) -> bool {
        matches!(self.control, Control::Fanuc | Control::Haas)
    }

    /// The drift of setter and spindle, from a gauge.
    fn reference(&self, tool: &SetTool) -> String {
        let face = self.setting.setter.at_mm.z + self.setting.expected_length_mm(tool);
        match self.control {
            Control::Sinumerik840d => format!("SET_DRIFT=$AA_MM[Z]-({face:.4})"),
            _ => format!("#105=[#5063-[{face:.4}]]"),
        }
    }

    /// Measured − nominal length, checked, and written as wear.
    fn length(&mut self, tool: &SetTool) -> String {
        let nominal = self.setting.setter.at_mm.z + tool.length_mm;
        let has_gauge = self.setting.setter.reference.is_some();
        let drift = match (has_gauge, self.control) {
            (false, _) => "",
            (true, Control::Sinumerik840d) => "-SET_DRIFT",
            (true, _) => "-#105",
        };
        let (off, mut text) = match self.control {
            Control::Sinumerik840d => {
                ("SET_OFF", format!("SET_OFF=$AA_MM[Z]-({nominal:.4}){drift}"))
            }
            _ => ("#102", format!("#102=[#5063-[{nominal:.4}]{drift}]")),
        };
        let number = tool.number;
        if let Some(limit) = tool.state.breakage_mm {
            text += &self.alarm(off, limit, &format!("TOOL {number} IS BROKEN"), 2);
        }
        text += &match self.control {
            Control::Sinumerik840d => format!("\n$TC_DP12[{number},1]=SET_OFF"),
            Control::LinuxCnc => format!("\nG10 L1 P{number} Z[{:.4}+#102]", tool.length_mm),
            _ => format!("\nG10 L11 P{number} R#102"),
        };
        if let Some(limit) = tool.state.wear_length_mm {
            text += &self.stop(off, limit, &format!("TOOL {number} IS WORN, REPLACE IT"));
        }
        text
    }

    fn plus(&self) -> String {
        match self.control {
            Control::Sinumerik840d => "SET_PLUS=$AA_MM[X]".to_owned(),
            _ => "#103=#5061".to_owned(),
        }
    }

    /// Measured − nominal radius, checked, and written as wear.
    fn diameter(&mut self, tool: &SetTool) -> String {
        let radius = 0.5 * tool.diameter_mm.unwrap_or(0.0);
        let (setter, number) = (self.setting.setter.diameter_mm[0], tool.number);
        let (off, mut text) = match self.control {
            Control::Sinumerik840d => (
                "SET_OFF",
                format!(
                    "SET_OFF=0.5*(SET_PLUS-$AA_MM[X]-({setter:.4}))-({radius:.4})\n\
                     $TC_DP15[{number},1]=SET_OFF"
                ),
            ),
            Control::LinuxCnc => (
                "#104",
                format!(
                    "#104=[[#103-#5061-[{setter:.4}]]/2-[{radius:.4}]]\nG10 L1 P{number} R[{radius:.4}+#104]"
                ),
            ),
            _ => (
                "#104",
                format!(
                    "#104=[[#103-#5061-[{setter:.4}]]/2-[{radius:.4}]]\nG10 L13 P{number} R#104"
                ),
            ),
        };
        if let Some(limit) = tool.state.wear_radius_mm {
            text += &self.stop(off, limit, &format!("TOOL {number} IS WORN, REPLACE IT"));
        }
        text
    }

    /// An alarm where the deviation passes a limit.
    fn alarm(&mut self, off: &str, limit_mm: f64, text: &str, number: u32) -> String {
        self.checks += 1;
        let n = self.checks;
        match self.control {
            Control::Sinumerik840d => {
                format!("\nIF ABS({off})>{limit_mm:.4}\nSETAL(65002,\"{text}\")\nM0\nENDIF")
            }
            Control::LinuxCnc => {
                format!("\no{n} if [ABS[{off}] GT {limit_mm:.4}]\n(ABORT, {text})\no{n} endif")
            }
            _ => format!("\nIF[ABS[{off}]LE{limit_mm:.4}]GOTO{n}\n#3000={number}({text})\nN{n}"),
        }
    }

    /// A stop with a message where the deviation passes a limit.
    fn stop(&mut self, off: &str, limit_mm: f64, text: &str) -> String {
        self.checks += 1;
        let n = self.checks;
        // A comma in a comment of LinuxCNC separates its key word.
        let plain = text.replace(',', "");
        match self.control {
            Control::Sinumerik840d => {
                format!("\nIF ABS({off})>{limit_mm:.4}\nMSG(\"{text}\")\nM0\nENDIF")
            }
            Control::LinuxCnc => {
                format!("\no{n} if [ABS[{off}] GT {limit_mm:.4}]\n(MSG, {plain})\nM0\no{n} endif")
            }
            _ if self.is_fanuc() => {
                format!("\nIF[ABS[{off}]LE{limit_mm:.4}]GOTO{n}\n#3006=1({plain})\nN{n}")
            }
            _ => String::new(),
        }
    }
}

/// HEIDENHAIN: cycles 31 and 32 for each tool, and an error where it is broken.
fn by_cycles(setting: &ToolSetting) -> Result<Vec<u8>, ProgramError> {
    let mut writer = Writer::new(Control::Heidenhain);
    let about = format!("{} tools on {}", setting.tools.len(), setting.machine.name());
    let comments = [
        about.as_str(),
        "the TT is calibrated; LTOL, RTOL and LBREAK stand in the tool table",
        "Q5: 0 in tolerance, 1 worn, 2 broken",
        "HEIGHT counts from the active datum: it must be the machine zero",
    ];
    writer.write(&Block::Start(&Heading::of_measuring("TOOL_SETTING", &comments)))?;
    // The cycles write Q5; before the first one it has no value.
    writer.write(&Block::Text("FN 0: Q5 = +0"))?;
    let z = setting.axes[2];
    let top = match setting.machine.axes()[z].travel {
        Travel::Between(_, top) => top,
        _ => setting.setter.at_mm.z + 200.0,
    };
    // The height counts from the workpiece zero: above the setter by the clearance.
    let height = setting.setter.at_mm.z + setting.setter.clearance_mm;
    for tool in setting.tools.iter().filter(|t| !t.is_reference) {
        let call = ToolCall { number: tool.number, text: &tool.name, ..ToolCall::default() };
        writer.write(&Block::Tool(&call))?;
        let mut up = Command::default();
        up[z] = top;
        let target = axis_target(&setting.machine, Control::Heidenhain, &up, |i| i == z);
        writer.write(&Block::Rapid(target))?;
        let mut cycles = vec![("31", "CAL. TOOL LENGTH")];
        if tool.state.measures_diameter {
            cycles.push(("32", "CAL. TOOL RADIUS"));
        }
        for (cycle, name) in cycles {
            let text = format!(
                "TCH PROBE {cycle}.0 {name}\nTCH PROBE {cycle}.1 CHECK: 1 Q5\n\
                 TCH PROBE {cycle}.2 HEIGHT: {height:+.3}\nTCH PROBE {cycle}.3 PROBING THE TEETH: 0\n\
                 FN 9: IF +Q5 EQU +2 GOTO LBL 99"
            );
            writer.write(&Block::Text(&text))?;
        }
    }
    writer.write(&Block::Text("FN 9: IF +0 EQU +0 GOTO LBL 98\nLBL 99"))?;
    writer.write(&Block::Stop { optional: false, message: Some("A TOOL IS BROKEN") })?;
    writer.write(&Block::Text("LBL 98"))?;
    writer.write(&Block::End)?;
    Ok(writer.finish())
}

/// Runs the program on the machine with the tools of the set-up. Interpreters take a touch as made at the end of its
/// way: the program that runs ends each touch where the nominal tool touches.
pub fn check_setting(
    setting: &ToolSetting,
    control: Control,
) -> Result<SettingCheck, ProgramError> {
    let mut exact = setting.clone();
    for touch in &mut exact.touches {
        touch.beyond = touch.expected;
    }
    let text = setting_program(&exact, control)?;
    let setup = SetUp { start: Some(start(setting)), ..setting.setup.clone() };
    // Tool lengths are off and work offsets 0 in this program; bodies on the table stay.
    let setup =
        SetUp { work_offsets: std::collections::BTreeMap::new(), workpiece_at: None, ..setup };
    let program = Program::new("TOOL_SETTING", text, control);
    Ok(run(&setting.machine, &setting.machine_path, &setup, &program, &[]))
}

/// Where the machine stands before: Z at its top, all other axes at 0.
fn start(setting: &ToolSetting) -> Position {
    let mut at = Position::default();
    for (i, axis) in setting.machine.axes().iter().enumerate() {
        let letter = Axis::ALL.into_iter().find(|a| char::from(a.letter()) == axis.name.letter());
        let (Some(letter), Travel::Between(from, to)) = (letter, axis.travel) else { continue };
        at[letter] = if i == setting.axes[2] { to } else { 0f64.clamp(from.min(to), to.max(from)) };
        if axis.kind == AxisKind::Rotary {
            at[letter] = at[letter].to_degrees();
        }
    }
    at
}
