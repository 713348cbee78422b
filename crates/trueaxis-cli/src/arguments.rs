//! Words of the command line: positions, vectors, tools.

use clap::Args;
use std::path::{Path, PathBuf};
pub use trueaxis::describe::{axis_index, to_inner, to_shown, warn_beyond_travel};
use trueaxis::files::disk;
use trueaxis::geometry::Vec3;
use trueaxis::input::{CsvTable, Diagnostics, Dimension, Place, QuantityError, parse_quantity};
use trueaxis::machine::Machine;
use trueaxis::machine::axis::{Approach, Command};
use trueaxis::machine::heat::TemperatureRun;
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
    /// The machine file.
    pub fn path(&self) -> &Path {
        &self.machine
    }

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

    /// Reads the machine and mounts the tool; problems go to `problems`.
    pub fn read(&self, problems: &mut Diagnostics) -> Option<Machine> {
        self.choice(None).read(&disk(), problems)
    }

    /// The same with a log that the temperatures follow, if a start is given.
    pub fn read_from(
        &self,
        start: &LogStart,
        problems: &mut Diagnostics,
    ) -> Option<(Machine, Option<TemperatureRun>)> {
        self.choice(Some(start)).read_from(&disk(), problems)
    }

    /// Whether temperatures were given.
    pub fn has_temperatures(&self) -> bool {
        self.choice(None).has_temperatures()
    }
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

/// Reads plain finite numbers; every one that is not is reported.
pub fn numbers(name: &str, text: &str, hint: &str, problems: &mut Diagnostics) -> Option<Vec<f64>> {
    let read = words(text).into_iter().map(|word| {
        let refuse = |e: QuantityError| {
            problems.error(e.code(), argument(name), e.to_string(), hint);
        };
        parse_quantity(word, Dimension::Ratio).map_err(refuse).ok()
    });
    // All of them first, so that every problem is reported.
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
