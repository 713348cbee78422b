//! The machine of a question, with the tool in it and at its temperatures.

use std::path::PathBuf;
use std::sync::Arc;
use trueaxis_geometry::Vec3;
use trueaxis_input::plausible::{Limits, Quantity, Seen};
use trueaxis_input::{Diagnostics, Dimension, Files, Place, QuantityError, parse_quantity};
use trueaxis_machine::Machine;
use trueaxis_machine::heat::{Conditions, TemperatureRun};
use trueaxis_motion::read_temperature_log;

/// A machine file, and what is put into the machine. Texts are as typed: plain numbers in mm and s.
#[derive(Debug, Clone, Default)]
pub struct MachineChoice {
    /// The machine file.
    pub file: PathBuf,
    /// Length of the tool from the holder to the tip instead of the machine file's tool.
    pub tool_length: Option<String>,
    /// A tool of the machine file, by its name.
    pub tool: Option<String>,
    /// Temperatures of the sensors, such as `scale_x=30.5 workpiece=31`, °C.
    pub temperature: Option<String>,
    /// A log of temperatures.
    pub temperature_log: Option<PathBuf>,
    /// The time of the log that holds; its end if none is named.
    pub log_time: Option<String>,
    /// The time of the log at which a program begins; the temperatures follow the log from there.
    pub log_start: Option<String>,
}

impl MachineChoice {
    /// Reads the machine, brings it to its temperatures and puts the tool in.
    pub fn read(&self, files: &Files, problems: &mut Diagnostics) -> Option<Machine> {
        let machine = problems.keep(Machine::read(files, &self.file));
        let machine = self.at_temperatures(files, machine?, problems)?;
        self.with_tool(machine, problems)
    }

    /// The same with the log that the temperatures follow, if a start is named: then the machine is that of
    /// the start.
    pub fn read_from(
        &self,
        files: &Files,
        problems: &mut Diagnostics,
    ) -> Option<(Machine, Option<TemperatureRun>)> {
        let (Some(text), Some(path)) = (&self.log_start, &self.temperature_log) else {
            return Some((self.read(files, problems)?, None));
        };
        let machine = problems.keep(Machine::read(files, &self.file));
        let start_s = log_time("--log-start", text, problems);
        let log = read_temperature_log(files, path, problems);
        let run = TemperatureRun { log: Arc::new(log?), start_s: start_s? };
        let conditions = conditions_at(&run, "--log-start", problems)?;
        let machine = machine?.at(&conditions, problems)?;
        Some((self.with_tool(machine, problems)?, Some(run)))
    }

    /// Whether temperatures are given.
    pub fn has_temperatures(&self) -> bool {
        self.temperature.is_some() || self.temperature_log.is_some()
    }

    /// The place of the machine file in messages.
    pub fn place(&self) -> Place {
        Place::whole(&self.file.display().to_string())
    }

    fn with_tool(&self, machine: Machine, problems: &mut Diagnostics) -> Option<Machine> {
        let length_mm = match (&self.tool, &self.tool_length) {
            (Some(name), _) => named_tool(&machine, name, problems)?,
            (None, Some(text)) => tool_length(text, problems)?,
            (None, None) => return Some(machine),
        };
        Some(machine.with_tip(Vec3::new(0.0, 0.0, -length_mm)))
    }

    fn at_temperatures(
        &self,
        files: &Files,
        machine: Machine,
        problems: &mut Diagnostics,
    ) -> Option<Machine> {
        match self.conditions(files, problems)? {
            Some(conditions) => machine.at(&conditions, problems),
            None => Some(machine),
        }
    }

    /// The temperatures that are given, none if there are none; `None` if they cannot be read.
    pub(super) fn conditions(
        &self,
        files: &Files,
        problems: &mut Diagnostics,
    ) -> Option<Option<Conditions>> {
        Some(match (&self.temperature, &self.temperature_log) {
            (Some(text), _) => Some(Conditions::typed("--temperature", text, problems)?),
            (None, Some(path)) => {
                let time_s = self.log_time.as_deref();
                let time_s = time_s.map(|t| log_time("--log-time", t, problems));
                let log = read_temperature_log(files, path, problems)?;
                let last_s = *log.times_s().last()?;
                let start_s = time_s.unwrap_or(Some(last_s))?;
                let run = TemperatureRun { log: Arc::new(log), start_s };
                Some(conditions_at(&run, "--log-time", problems)?)
            }
            (None, None) => None,
        })
    }
}

fn log_time(name: &str, text: &str, problems: &mut Diagnostics) -> Option<f64> {
    let plain = parse_quantity(text, Dimension::Ratio);
    let refuse = |e: QuantityError| {
        let hint = format!("a plain number, in s, or with its unit: {name} 3600, {name} \"1 h\"");
        problems.error(e.code(), Place::whole(name), e.to_string(), &hint);
    };
    plain.or_else(|_| parse_quantity(text, Dimension::Time)).map_err(refuse).ok()
}

fn conditions_at(
    run: &TemperatureRun,
    name: &str,
    problems: &mut Diagnostics,
) -> Option<Conditions> {
    let conditions = run.log.at(run.start_s);
    if conditions.is_none() {
        let outside = run.log.outside(run.start_s);
        problems.error(outside.code, Place::whole(name), outside.message, &outside.hint);
    }
    conditions
}

fn named_tool(machine: &Machine, name: &str, problems: &mut Diagnostics) -> Option<f64> {
    let tool = machine.tools().iter().find(|t| t.name == name);
    if tool.is_none() {
        let known: Vec<_> = machine.tools().iter().map(|t| t.name.as_str()).collect();
        let message = format!("the machine file has no tool `{name}`");
        let hint = match known.is_empty() {
            true => "it has no [tool.library]; give --tool-length instead".to_owned(),
            false => format!("its tools: {}", known.join(", ")),
        };
        problems.error("unknown-tool", Place::whole("--tool"), message, &hint);
    }
    tool.map(|t| t.length_mm)
}

/// The length of a tool as typed, mm: none where it is no length of a tool.
pub fn tool_length(text: &str, problems: &mut Diagnostics) -> Option<f64> {
    let refuse = |e: QuantityError| {
        let hint = "a plain number, in mm: --tool-length 100";
        problems.error(e.code(), Place::whole("--tool-length"), e.to_string(), hint);
    };
    let length_mm = parse_quantity(text, Dimension::Ratio).map_err(refuse).ok()?;
    let (place, seen) = (Place::whole("--tool-length"), Seen::one(text, length_mm));
    Limits::default().judge(Quantity::ToolLength, &seen, &place, problems).then_some(length_mm)
}
