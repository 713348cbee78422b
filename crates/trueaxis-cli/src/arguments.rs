//! The machine of a command.

use clap::Args;
use std::path::PathBuf;
use trueaxis::questions::MachineChoice;

/// The machine and the tool in it.
#[derive(Args)]
pub struct MachineArguments {
    /// The machine file
    #[arg(value_name = "MACHINE.toml")]
    machine: PathBuf,
    /// Length of the tool from the holder to the tip, mm, instead of the machine file's tool
    #[arg(long, value_name = "MM", allow_negative_numbers = true)]
    tool_length: Option<String>,
    /// A tool assembly of the machine file, by its name
    #[arg(long, value_name = "NAME", conflicts_with = "tool_length")]
    tool: Option<String>,
    /// Readings of the sensors of the machine file, degC; without them every body has the
    /// temperature of its error table and the workpiece 20 degC
    #[arg(long, value_name = "\"scale_x=30.5 workpiece=31\"")]
    temperature: Option<String>,
    /// The same from a log: a file (CSV, or Parquet) with time_s and one column per sensor
    /// (scale_x_degC)
    #[arg(long, value_name = "LOG.csv", conflicts_with = "temperature")]
    temperature_log: Option<PathBuf>,
    /// The time in the log, s; default: its end
    #[arg(long, value_name = "S", requires = "temperature_log", allow_negative_numbers = true)]
    log_time: Option<String>,
}

/// Temperatures that follow the log while a program runs.
#[derive(Args)]
pub struct LogStart {
    /// The program begins at this time of the log, s, and the temperatures follow it from there
    #[arg(
        long,
        value_name = "S",
        requires = "temperature_log",
        conflicts_with = "log_time",
        allow_negative_numbers = true
    )]
    log_start: Option<String>,
}

impl MachineArguments {
    /// As the questions of the library take it.
    pub fn choice(&self, start: Option<&LogStart>) -> MachineChoice {
        MachineChoice {
            file: self.machine.clone(),
            tool_length: self.tool_length.clone(),
            tool: self.tool.clone(),
            temperature: self.temperature.clone(),
            temperature_log: self.temperature_log.clone(),
            log_time: self.log_time.clone(),
            log_start: start.and_then(|start| start.log_start.clone()),
        }
    }
}
