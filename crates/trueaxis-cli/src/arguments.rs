//! Words of the command line: positions, vectors, tools.

use clap::Args;
use std::path::{Path, PathBuf};
use std::sync::Arc;
pub use trueaxis::describe::{axis_index, to_inner, to_shown, warn_beyond_travel};
use trueaxis::files;
use trueaxis::files::disk;
use trueaxis::geometry::Vec3;
use trueaxis::input::{CsvTable, Diagnostics, Dimension, Place, QuantityError, parse_quantity};
use trueaxis::machine::Machine;
use trueaxis::machine::axis::{Approach, Command};
use trueaxis::machine::heat::{Conditions, TemperatureRun};

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
    /// What the sensors of the machine file say, degC; without it every body stands at the
    /// temperature of its error table and the workpiece at 20 degC
    #[arg(long, value_name = "\"scale_x=30.5 workpiece=31\"")]
    temperature: Option<String>,
    /// The same from a log: a file (CSV, or Parquet) with time_s and one column per sensor
    /// (scale_x_degC)
    #[arg(long, value_name = "LOG.csv", conflicts_with = "temperature")]
    temperature_log: Option<PathBuf>,
    /// Held at this time of the log, s; without it at its end
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
    /// The machine file.
    pub fn path(&self) -> &Path {
        &self.machine
    }

    /// Reads the machine and puts the tool in; what is wrong goes to `problems`.
    pub fn read(&self, problems: &mut Diagnostics) -> Option<Machine> {
        let (machine, found) = files::machine(&self.machine);
        problems.append(found);
        let machine = self.at_temperatures(machine?, problems)?;
        self.with_tool(machine, problems)
    }

    /// The same with a log that the temperatures follow, if a start is given: then the machine is
    /// that of the start.
    pub fn read_from(
        &self,
        start: &LogStart,
        problems: &mut Diagnostics,
    ) -> Option<(Machine, Option<TemperatureRun>)> {
        let (Some(text), Some(path)) = (&start.log_start, &self.temperature_log) else {
            return Some((self.read(problems)?, None));
        };
        let (machine, found) = files::machine(&self.machine);
        problems.append(found);
        let start_s = log_time("--log-start", text, problems);
        let log = trueaxis::simulate::read_temperature_log(&disk(), path, problems);
        let run = TemperatureRun { log: Arc::new(log?), start_s: start_s? };
        let conditions = conditions_at(&run, "--log-start", problems)?;
        let machine = machine?.at(&conditions, problems)?;
        Some((self.with_tool(machine, problems)?, Some(run)))
    }

    fn with_tool(&self, machine: Machine, problems: &mut Diagnostics) -> Option<Machine> {
        let length_mm = match (&self.tool, &self.tool_length) {
            (Some(name), _) => named_tool(&machine, name, problems)?,
            (None, Some(text)) => tool_length(text, problems)?,
            (None, None) => return Some(machine),
        };
        Some(machine.with_tip(Vec3::new(0.0, 0.0, -length_mm)))
    }
}

impl MachineArguments {
    fn at_temperatures(&self, machine: Machine, problems: &mut Diagnostics) -> Option<Machine> {
        let conditions = match (&self.temperature, &self.temperature_log) {
            (Some(text), _) => Conditions::typed("--temperature", text, problems)?,
            (None, Some(path)) => {
                let time_s = self.log_time.as_deref();
                let time_s = time_s.map(|t| log_time("--log-time", t, problems));
                conditions_of(path, time_s, problems)?
            }
            (None, None) => return Some(machine),
        };
        machine.at(&conditions, problems)
    }

    /// Whether temperatures were given.
    pub fn has_temperatures(&self) -> bool {
        self.temperature.is_some() || self.temperature_log.is_some()
    }
}

fn log_time(name: &str, text: &str, problems: &mut Diagnostics) -> Option<f64> {
    let plain = parse_quantity(text, Dimension::Ratio);
    let refuse = |e: QuantityError| {
        let hint = format!("a plain number, in s, or with its unit: {name} 3600, {name} \"1 h\"");
        problems.error(e.code(), argument(name), e.to_string(), &hint);
    };
    plain.or_else(|_| parse_quantity(text, Dimension::Time)).map_err(refuse).ok()
}

/// `time_s`: none for the end of the log, an inner none if it could not be read.
fn conditions_of(
    path: &Path,
    time_s: Option<Option<f64>>,
    problems: &mut Diagnostics,
) -> Option<Conditions> {
    let log = trueaxis::simulate::read_temperature_log(&disk(), path, problems)?;
    let last_s = *log.times_s().last()?;
    let run = TemperatureRun { log: Arc::new(log), start_s: time_s.unwrap_or(Some(last_s))? };
    conditions_at(&run, "--log-time", problems)
}

fn conditions_at(
    run: &TemperatureRun,
    name: &str,
    problems: &mut Diagnostics,
) -> Option<Conditions> {
    let conditions = run.log.at(run.start_s);
    if conditions.is_none() {
        let outside = run.log.outside(run.start_s);
        problems.error(outside.code, argument(name), outside.message, &outside.hint);
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
        problems.error("unknown-tool", argument("--tool"), message, &hint);
    }
    tool.map(|t| t.length_mm)
}

fn tool_length(text: &str, problems: &mut Diagnostics) -> Option<f64> {
    let refuse = |e: QuantityError| {
        let hint = "a plain number, in mm: --tool-length 100";
        problems.error(e.code(), argument("--tool-length"), e.to_string(), hint);
    };
    parse_quantity(text, Dimension::Ratio).map_err(refuse).ok()
}

/// The place of a problem in an argument.
pub fn argument(name: &str) -> Place {
    Place::whole(name)
}

/// The words of a list: between commas or semicolons if there are any, else between blanks. So a
/// decimal comma (`1,5 2`) never passes for two numbers.
fn words(text: &str) -> Vec<&str> {
    let separated = text.contains([',', ';']);
    let between = |c: char| if separated { matches!(c, ',' | ';') } else { c.is_whitespace() };
    text.split(between).map(str::trim).filter(|w| !w.is_empty()).collect()
}

/// Reads `X=10 Y=20 A=30`: mm and degrees; axes not named are 0.
pub fn command(
    machine: &Machine,
    name: &str,
    text: &str,
    problems: &mut Diagnostics,
) -> Option<Command> {
    let mut command = Command::default();
    let mut named = Vec::new();
    let mut sound = true;
    for word in words(text) {
        let read = assignment(machine, word).and_then(|(axis, value)| {
            once(&mut named, axis, word)?;
            command[axis] = value;
            Ok(())
        });
        if let Err((code, message)) = read {
            sound = false;
            let hint = format!("write \"{}\", in mm and degrees", example(machine));
            problems.error(code, argument(name), message, &hint);
        }
    }
    sound.then_some(command)
}

type Refusal = (&'static str, String);

fn once(named: &mut Vec<usize>, axis: usize, word: &str) -> Result<(), Refusal> {
    if named.contains(&axis) {
        return Err(("duplicate-axis", format!("`{word}`: the axis is named twice")));
    }
    named.push(axis);
    Ok(())
}

fn assignment(machine: &Machine, word: &str) -> Result<(usize, f64), Refusal> {
    let (index, number) = axis_and_rest(machine, word)?;
    let value = parse_quantity(number, Dimension::Ratio)
        .map_err(|e| (e.code(), format!("`{word}`: {e}")))?;
    Ok((index, to_inner(machine, index, value)))
}

fn axis_and_rest<'w>(machine: &Machine, word: &'w str) -> Result<(usize, &'w str), Refusal> {
    let Some((axis, rest)) = word.split_once('=') else {
        return Err(("bad-position", format!("`{word}` is not an axis, =, and a value")));
    };
    let index = axis_index(machine, axis.trim())
        .ok_or_else(|| ("unknown-axis", format!("the machine has no axis `{axis}`")))?;
    Ok((index, rest.trim()))
}

fn example(machine: &Machine) -> String {
    let words: Vec<_> = machine.axes().iter().map(|a| format!("{}=0", a.name)).collect();
    words.join(" ")
}

/// Reads a CSV table of positions or poses; one without rows is a mistake, not an empty answer.
pub fn table(path: &Path, what: &str, problems: &mut Diagnostics) -> Option<CsvTable> {
    let text = disk().text(path, what, problems)?;
    let mut found = Diagnostics::new();
    let table = CsvTable::parse(&path.display().to_string(), &text, &mut found);
    let readable = found.iter().all(|d| !matches!(d.code, "bad-separator" | "empty-table"));
    if table.rows() == 0 && !found.has_errors() {
        let message = "the table has headings, but no row".to_owned();
        found.error("empty-table", argument(&table.file), message, "one row for each position");
    }
    problems.append(found);
    readable.then_some(table)
}

/// Reads `X=+ C=-`: the direction in which each axis reaches its position.
pub fn approach(machine: &Machine, text: &str, problems: &mut Diagnostics) -> Option<Approach> {
    let mut approach = Approach::default();
    let mut named = Vec::new();
    let mut sound = true;
    for word in words(text) {
        let read = axis_and_rest(machine, word).and_then(|(axis, side)| {
            once(&mut named, axis, word)?;
            approach[axis] = match side {
                "+" => 1.0,
                "-" => -1.0,
                _ => return Err(("bad-approach", format!("`{word}` is neither + nor -"))),
            };
            Ok(())
        });
        if let Err((code, message)) = read {
            sound = false;
            let hint = "+ rising, - falling: \"X=+ C=-\"";
            problems.error(code, argument("--approach"), message, hint);
        }
    }
    sound.then_some(approach)
}

/// Reads plain finite numbers; every one that is none is told.
pub fn numbers(name: &str, text: &str, hint: &str, problems: &mut Diagnostics) -> Option<Vec<f64>> {
    let read = words(text).into_iter().map(|word| {
        let refuse = |e: QuantityError| {
            problems.error(e.code(), argument(name), e.to_string(), hint);
        };
        parse_quantity(word, Dimension::Ratio).map_err(refuse).ok()
    });
    // All of them first, so that every problem is told.
    let read: Vec<Option<f64>> = read.collect();
    read.into_iter().collect()
}

/// Reads `x y z`: three finite numbers.
pub fn vector(name: &str, text: &str, problems: &mut Diagnostics) -> Option<Vec3> {
    let words = words(text);
    let hint = "three plain numbers, such as \"10 20 30\"";
    if words.len() != 3 {
        let message = format!("`{text}` is {} numbers, not three", words.len());
        problems.error("bad-vector", argument(name), message, hint);
        return None;
    }
    numbers(name, text, hint, problems).map(|v| Vec3::new(v[0], v[1], v[2]))
}

pub use trueaxis::questions::named_control as control;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_decimal_comma_is_not_two_numbers() {
        assert_eq!(words("1,5 2"), ["1", "5 2"]);
        assert_eq!(words("1, 2; 3"), ["1", "2", "3"]);
        assert_eq!(words(" 1\t2\n3 "), ["1", "2", "3"]);
        assert!(vector("--tip", "1,5 2", &mut Diagnostics::new()).is_none());
    }
}
