//! How are the tools of a set-up measured on the machine, and what do the readings say?

use super::{Answer, NewFile, Question, Tell, in_folder, named_control, with_diagnostics};
use crate::files::output::Output;
use crate::report;
use serde_json::Value;
use std::path::PathBuf;
use trueaxis_calibrate::identify::surface::{HitsLog, parse_log};
use trueaxis_calibrate::identify::tool_setting::{ToolReadings, measured_tools, setup_lines};
use trueaxis_calibrate::plan::extension;
use trueaxis_calibrate::plan::program::ProgramCheck;
use trueaxis_calibrate::plan::tool_setting::{
    ToolSetting, check_setting, setting_program, tool_setting,
};
use trueaxis_input::{DATE_HINT, Date, Diagnostics, Files, Place};
use trueaxis_machine::Machine;
use trueaxis_motion::read_setup;
use trueaxis_nc::Control;
use trueaxis_report::Report;

/// A machine, a set-up with tools and a tool setter.
#[derive(Debug, Clone, Default)]
pub struct ToolChoice {
    /// The machine file.
    pub machine: PathBuf,
    /// The set-up file.
    pub setup: PathBuf,
    /// The tools, such as `1,2`; all without it.
    pub tools: Option<String>,
}

impl ToolChoice {
    fn read(&self, files: &Files, problems: &mut Diagnostics) -> Option<ToolSetting> {
        let machine = problems.keep(Machine::read(files, &self.machine))?;
        let setup = problems.keep(read_setup(files, &self.setup, &machine))?;
        let numbers = self.numbers(problems)?;
        let file = self.setup.display().to_string();
        tool_setting((machine, &self.machine), (setup, &file), &numbers, problems)
    }

    fn numbers(&self, problems: &mut Diagnostics) -> Option<Vec<u32>> {
        let Some(text) = &self.tools else { return Some(Vec::new()) };
        let numbers: Result<Vec<u32>, _> = text.split(',').map(|n| n.trim().parse()).collect();
        if numbers.is_err() {
            let message = format!("`{text}` is no list of tool numbers");
            problems.error("bad-tool", Place::whole("--tools"), message, "such as --tools 1,2,5");
        }
        numbers.ok()
    }
}

/// Why there is no file.
pub(super) const NOT_WRITTEN: &str =
    "the program is NOT SAFE: nothing was written (--write-unsafe writes it all the same)";

/// The program that measures tools at a tool setter.
#[derive(Debug, Clone, Default)]
pub struct PlanToolSetting {
    /// Machine, set-up, tools.
    pub choice: ToolChoice,
    /// The control of the program, by its name.
    pub control: String,
    /// The folder of the program.
    pub output: Option<PathBuf>,
    /// Whether a program that is not safe is written, too.
    pub write_unsafe: bool,
}

/// The touches with their program.
#[derive(Debug)]
pub struct ToolSettingAnswer {
    setting: ToolSetting,
    control: Control,
    program: Vec<u8>,
    check: ProgramCheck,
    output: Option<PathBuf>,
    write_unsafe: bool,
}

impl Question for PlanToolSetting {
    type Input = (ToolSetting, Control);
    type Answer = ToolSettingAnswer;

    fn read(&self, files: &Files, problems: &mut Diagnostics) -> Option<Self::Input> {
        let setting = self.choice.read(files, problems);
        let control = named_control(&self.control, problems);
        setting.zip(control)
    }

    fn answer(
        &self,
        (setting, control): Self::Input,
        _: Tell<'_>,
        problems: &mut Diagnostics,
    ) -> Option<ToolSettingAnswer> {
        let program = setting_program(&setting, control);
        let written = program.and_then(|p| Ok((p, check_setting(&setting, control)?)));
        match written {
            Ok((program, check)) => {
                let (output, write_unsafe) = (self.output.clone(), self.write_unsafe);
                Some(ToolSettingAnswer { setting, control, program, check, output, write_unsafe })
            }
            Err(error) => {
                let (place, hint) = (Place::whole("--control"), "choose another --control");
                problems.error("no-program", place, error.to_string(), hint);
                None
            }
        }
    }
}

impl Answer for ToolSettingAnswer {
    fn document(&self, problems: &Diagnostics) -> Value {
        with_diagnostics(&report::ToolSettingDocument::of(&self.setting, &self.check), problems)
    }

    fn report(&self) -> Report<'_> {
        report::setting_report(&self.setting, &self.check)
    }

    fn is_yes(&self) -> bool {
        self.check.is_sound()
    }

    fn files(&mut self) -> Vec<NewFile> {
        let name = format!("tool-setting.{}", extension(self.control));
        let written = self.is_yes() || self.write_unsafe;
        let folder = self.output.as_deref().filter(|_| written);
        in_folder(folder, [(name, self.program.clone())])
    }

    fn notes(&self) -> Vec<String> {
        let kept_back = self.output.is_some() && !self.is_yes() && !self.write_unsafe;
        kept_back.then(|| NOT_WRITTEN.to_owned()).into_iter().collect()
    }
}

/// What the log of a tool setting says.
#[derive(Debug, Clone, Default)]
pub struct IdentifyTools {
    /// Machine, set-up, tools: those of the program.
    pub choice: ToolChoice,
    /// The log that the program wrote.
    pub log: PathBuf,
    /// When it was measured.
    pub date: Option<String>,
    /// Where the lines for the set-up file go.
    pub output: Option<PathBuf>,
}

/// The measured tools.
#[derive(Debug)]
pub struct ToolsAnswer {
    readings: ToolReadings,
    date: Option<String>,
    output: Option<PathBuf>,
}

impl Question for IdentifyTools {
    type Input = (ToolSetting, HitsLog);
    type Answer = ToolsAnswer;

    fn read(&self, files: &Files, problems: &mut Diagnostics) -> Option<Self::Input> {
        if let Some(date) = self.date.as_ref().filter(|date| Date::parse(date).is_none()) {
            let message = format!("`{date}` is not a date");
            problems.error("bad-date", Place::whole("--date"), message, DATE_HINT);
        }
        let setting = self.choice.read(files, problems)?;
        let text = files.text(&self.log, "the log of a tool setting", problems)?;
        let log = parse_log(&self.log.display().to_string(), &text, &setting.machine, problems)?;
        Some((setting, log))
    }

    fn outputs(&self, _: Option<&Self::Input>) -> Vec<Output> {
        self.output.iter().map(|path| Output::file("-o", path)).collect()
    }

    fn answer(
        &self,
        (setting, log): Self::Input,
        _: Tell<'_>,
        problems: &mut Diagnostics,
    ) -> Option<ToolsAnswer> {
        let file = self.log.display().to_string();
        let readings = measured_tools(&setting, &log, &file, problems)?;
        Some(ToolsAnswer { readings, date: self.date.clone(), output: self.output.clone() })
    }
}

impl Answer for ToolsAnswer {
    fn document(&self, problems: &Diagnostics) -> Value {
        with_diagnostics(&report::MeasuredToolsDocument::of(&self.readings), problems)
    }

    fn report(&self) -> Report<'_> {
        report::tools_report(&self.readings)
    }

    fn is_yes(&self) -> bool {
        self.readings.tools.iter().all(|t| t.standing.is_fit())
    }

    fn files(&mut self) -> Vec<NewFile> {
        let lines = setup_lines(&self.readings, self.date.as_deref());
        let text = format!("# Measured tools: for the [tool.N] of the set-up file\n{lines}");
        let file = self.output.as_deref().map(|path| NewFile::of("measured tools", path, text));
        file.into_iter().collect()
    }
}
