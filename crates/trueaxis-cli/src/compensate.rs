//! `trueaxis compensate`: values per axis; the other kinds have files of their own.

mod adapt;
mod program;
mod tables;

use crate::arguments::{self, MachineArguments, argument};
use crate::output::{Answer, Outcome, report, show, tell};
use clap::{Args, Subcommand, ValueEnum};
use std::path::PathBuf;
use trueaxis::compensate::not_twice;
use trueaxis::compensate::values::{
    MOST_POSITIONS, Order, ValueTable, ValuesError, compensation_values, travel_positions,
};
use trueaxis::files;
use trueaxis::input::{Diagnostics, Dimension, Place, parse_quantity};
use trueaxis::machine::Machine;
use trueaxis::machine::axis::{AxisKind, Command};
use trueaxis::predict::holes::Compensation;
use trueaxis::report::{
    compensation_csv, compensation_json, compensation_report, compensation_warnings,
};

/// The form of the compensation.
#[derive(Args)]
pub struct Arguments {
    #[command(subcommand)]
    command: CompensateCommand,
}

#[derive(Subcommand)]
enum CompensateCommand {
    /// Adapt a path to the blank that was probed, and show the wall thickness that remains
    Adapt(adapt::AdaptArguments),
    /// Rewrite an NC program so that the actual tool follows the programmed path
    Program(Box<program::ProgramArguments>),
    /// Tables of a control, read back, with the residual errors
    Tables(tables::TablesArguments),
    /// Values per axis and position, in least increments, to be added to the command
    Values(ValuesArguments),
}

/// The values to calculate.
#[derive(Args)]
#[command(after_help = "\
Examples:
  trueaxis compensate values machines/gantry-001/machine.toml --at \"X=3500 Y=2300\" --temperature \"scale_x=30.5 scale_y=31.2 workpiece=30.5\"
  trueaxis compensate values machines/gantry-001/machine.toml --axis X --step 350 --temperature \"scale_x=30.5 workpiece=30.5\"
  trueaxis compensate values machines/xkas2525/machine.toml --axis C --step 30 --format csv -o c.csv

value = - error of the axis in its own direction, rounded to whole increments, halves away from zero;
the control adds it to the command. Without temperatures there is no thermal part and the
machine and the comprehensive error are equal. Exit status: 0 done, 2 unusable input.")]
struct ValuesArguments {
    #[command(flatten)]
    machine: MachineArguments,
    /// The axis of a table over the travel
    #[arg(long, value_name = "X", required_unless_present = "at")]
    axis: Option<String>,
    /// Without --axis: one position, with a value for each axis named; with it: the position of the other axes
    #[arg(long, value_name = "\"X=.. Y=..\"")]
    at: Option<String>,
    /// Distance of the positions over the travel, mm or degrees (default: 100 and 10)
    #[arg(long, value_name = "STEP", requires = "axis", allow_negative_numbers = true)]
    step: Option<String>,
    /// These positions instead, mm or degrees
    #[arg(long, value_name = "\"0 500 1000\"", requires = "axis", conflicts_with = "step")]
    #[arg(allow_hyphen_values = true)]
    targets: Option<String>,
    /// The least increment of the control: "1 um" for linear, "0.0001 deg" for rotary axes by default
    #[arg(long, value_name = "\"1 um\"")]
    increment: Option<String>,
    /// Which error is compensated
    #[arg(long, value_enum, default_value = "comprehensive")]
    of: CompensatedError,
    /// Output as text, as one JSON document, or as a CSV table of one axis
    #[arg(long, value_enum, default_value = "text")]
    format: Format,
    /// Write to this file instead of standard output
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
}

/// Which error is compensated.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum CompensatedError {
    /// That of the machine alone, as a laser shows it
    Machine,
    /// machine - workpiece: what the part has at 20 degC
    Comprehensive,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Format {
    /// Text with tables
    Text,
    /// One JSON document
    Json,
    /// The table of one axis
    Csv,
}

pub fn run(arguments: &Arguments) -> Outcome {
    let arguments = match &arguments.command {
        CompensateCommand::Adapt(arguments) => return adapt::run(arguments),
        CompensateCommand::Program(arguments) => return program::run(arguments),
        CompensateCommand::Tables(arguments) => return tables::run(arguments),
        CompensateCommand::Values(arguments) => arguments,
    };
    let mut problems = Diagnostics::new();
    if let Some(path) = &arguments.output {
        // Before the work, not after it.
        crate::report_file::may_write(path, &VALUES, &mut problems);
    }
    let found = tables(arguments, &mut problems);
    // The text says it itself, on top.
    let is_listed = arguments.format == Format::Text && arguments.output.is_none();
    if let (Some((machine, tables)), false) = (&found, is_listed) {
        for warning in compensation_warnings(machine, tables) {
            let hint = match arguments.of {
                CompensatedError::Machine => "use --of comprehensive",
                CompensatedError::Comprehensive => "these values are of the comprehensive error",
            };
            problems.warn("machine-alone-is-worse", Place::whole("--of"), warning, hint);
        }
    }
    let failed = report(problems);
    match found {
        Some((machine, tables)) if !failed => answer(arguments, &machine, &tables),
        _ => Outcome::Unusable,
    }
}

/// What `--output` may replace.
const VALUES: crate::report_file::Written = crate::report_file::Written::file(
    "--output",
    "a file of compensation values",
    &[b"# trueaxis compensation values", b"{\n  \"schema\": \"trueaxis/compensate/"],
);

fn answer(arguments: &ValuesArguments, machine: &Machine, tables: &[ValueTable]) -> Outcome {
    let text = match arguments.format {
        Format::Text => compensation_report(machine, tables).text(),
        Format::Json => format!("{:#}\n", compensation_json(machine, tables)),
        Format::Csv => tables.iter().map(|t| compensation_csv(machine, t)).collect(),
    };
    let Some(path) = &arguments.output else { return show(&Answer::Text(text)) };
    let shown = path.display().to_string();
    match files::write(path, text.as_bytes()) {
        Ok(()) => {
            tell(&format!("values: {shown}"));
            Outcome::Done
        }
        Err(e) => {
            let message = format!("cannot be written: {e}");
            crate::report_file::unusable("unwritable-file", &shown, &message, "name another file")
        }
    }
}

fn tables(
    arguments: &ValuesArguments,
    problems: &mut Diagnostics,
) -> Option<(Machine, Vec<ValueTable>)> {
    let machine = arguments.machine.read(problems)?;
    let place = Place::whole(&arguments.machine.path().display().to_string());
    let machine = not_twice(&machine, place, problems);
    let text = arguments.at.as_deref();
    let command = match text {
        Some(text) => arguments::command(&machine, "--at", text, problems)?,
        None => Command::default(),
    };
    let axes: Vec<usize> = match &arguments.axis {
        Some(letter) => vec![axis(&machine, letter, problems)?],
        // `X=1` and `X = 1` both name X; the text was read already.
        None => (0..machine.axes().len())
            .filter(|i| {
                let name = machine.axes()[*i].name.letter();
                text.is_some_and(|t| t.contains(name))
            })
            .collect(),
    };
    if axes.is_empty() {
        let message = "no axis is named".to_owned();
        problems.error("missing-axis", argument("--at"), message, "such as \"X=3500 Y=2300\"");
        return None;
    }
    if arguments.format == Format::Csv && axes.len() > 1 {
        let message = format!("{} axes do not fit in one CSV table", axes.len());
        problems.error("one-axis", argument("--format"), message, "name one axis, or use json");
        return None;
    }
    let mut tables = Vec::new();
    for axis in axes {
        tables.push(table(arguments, &machine, axis, command, problems)?);
    }
    Some((machine, tables))
}

fn axis(machine: &Machine, letter: &str, problems: &mut Diagnostics) -> Option<usize> {
    let found = arguments::axis_index(machine, letter);
    if found.is_none() {
        let message = format!("the machine has no axis `{letter}`");
        let hint = format!("its chain: {}", machine.chain_text());
        problems.error("unknown-axis", argument("--axis"), message, &hint);
    }
    found
}

fn table(
    arguments: &ValuesArguments,
    machine: &Machine,
    axis: usize,
    command: Command,
    problems: &mut Diagnostics,
) -> Option<ValueTable> {
    let positions = match arguments.axis {
        None => vec![command[axis]],
        Some(_) => positions(arguments, machine, axis, problems)?,
    };
    if let Some(q) = positions.iter().find(|q| !machine.axes()[axis].travel.contains(**q)) {
        let at = arguments::to_shown(machine, axis, *q);
        let message = format!("{} {at} lies outside the travel", machine.axes()[axis].name);
        problems.warn("outside-travel", argument("--at"), message, "the machine cannot go there");
    }
    let order = Order {
        axis,
        command,
        positions,
        increment: increment(arguments, machine, axis, problems)?,
        of: match arguments.of {
            CompensatedError::Machine => Compensation::Machine,
            CompensatedError::Comprehensive => Compensation::Comprehensive,
        },
    };
    let refuse = |e: ValuesError| {
        let (code, hint) = match &e {
            ValuesError::Position(_) => (
                "outside-table",
                "stay inside the table (--targets), or say outside = \"clamp\" or \"extend\" for it",
            ),
            ValuesError::Unbounded { .. } => {
                ("not-finite", "is the increment too small, or does an error curve run away?")
            }
        };
        let place = argument(if arguments.axis.is_some() { "--axis" } else { "--at" });
        problems.error(code, place, e.to_string(), hint);
    };
    compensation_values(machine, &order).map_err(refuse).ok()
}

fn positions(
    arguments: &ValuesArguments,
    machine: &Machine,
    axis: usize,
    problems: &mut Diagnostics,
) -> Option<Vec<f64>> {
    if let Some(text) = &arguments.targets {
        let hint = "plain numbers, in mm or degrees: \"0 500 1000\"";
        let numbers = arguments::numbers("--targets", text, hint, problems)?;
        if !(1..=MOST_POSITIONS).contains(&numbers.len()) {
            let message = format!("{} positions", numbers.len());
            problems.error("bad-count", argument("--targets"), message, hint);
            return None;
        }
        let inner = numbers.into_iter().map(|n| arguments::to_inner(machine, axis, n));
        return Some(inner.collect());
    }
    let usual = match machine.axes()[axis].kind {
        AxisKind::Linear => "100",
        AxisKind::Rotary => "10",
    };
    let text = arguments.step.as_deref().unwrap_or(usual);
    let hint = "a positive number, in mm or degrees: --step 100";
    let step = match arguments::numbers("--step", text, hint, problems)?[..] {
        [step] if step > 0.0 => arguments::to_inner(machine, axis, step),
        _ => {
            let message = format!("`{text}` is not a step");
            problems.error("not-positive", argument("--step"), message, hint);
            return None;
        }
    };
    let found = travel_positions(&machine.axes()[axis], step);
    if found.is_none() {
        let name = machine.axes()[axis].name;
        let message = format!("no positions over the travel of {name} in steps of {text}");
        let hint = format!(
            "the machine file must state its travel, and {MOST_POSITIONS} positions are the most; \
             or use --targets"
        );
        problems.error("no-positions", argument("--axis"), message, &hint);
    }
    found
}

fn increment(
    arguments: &ValuesArguments,
    machine: &Machine,
    axis: usize,
    problems: &mut Diagnostics,
) -> Option<f64> {
    let (dimension, usual) = match machine.axes()[axis].kind {
        AxisKind::Linear => (Dimension::Length, "1 um"),
        AxisKind::Rotary => (Dimension::Angle, "0.0001 deg"),
    };
    let text = arguments.increment.as_deref().unwrap_or(usual);
    let (code, message) = match parse_quantity(text, dimension) {
        Ok(value) if value > 0.0 => return Some(value),
        Ok(_) => ("not-positive", format!("`{text}` is not an increment")),
        Err(e) => (e.code(), e.to_string()),
    };
    let hint = format!("above zero, with its unit, such as \"{usual}\"");
    problems.error(code, argument("--increment"), message, &hint);
    None
}
