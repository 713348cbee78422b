mod batch;

use crate::arguments::{self, MachineArguments, argument};
use crate::numbers::fixed;
use crate::output::{Answer, Format, Outcome, finish};
use clap::Args;
use serde_json::{Value, json};
use std::fmt::Write;
use std::path::PathBuf;
use trueaxis::geometry::Vec3;
use trueaxis::geometry::frame::{Bed, Body, Pose};
use trueaxis::geometry::input::{Diagnostics, Place};
use trueaxis::machine::axis::{Approach, Command};
use trueaxis::machine::errors::{ErrorName, ErrorValues};
use trueaxis::machine::{Deviation, Machine};

/// The pose to show.
#[derive(Args)]
#[command(after_help = "\
Examples:
  trueaxis pose machines/xkas2525/machine.toml --at \"X=3000 Y=1200 Z=-700 C=-90 A=15\"
  trueaxis pose machines/xkas2525/machine.toml --at-file examples/01_describe/positions.csv

Lengths are in the workpiece frame; deviation = actual - nominal. A position outside the travel is
computed, with a warning. Exit status: 0 done, 2 unusable input.")]
pub struct Arguments {
    #[command(flatten)]
    machine: MachineArguments,
    /// Programmed axis positions in mm and degrees; axes not named are 0
    #[arg(long, value_name = "\"X=.. A=..\"", required_unless_present = "at_file")]
    at: Option<String>,
    /// Many positions: a CSV file whose columns are named by axis (mm, deg)
    #[arg(long, value_name = "POSITIONS.csv", conflicts_with = "at")]
    at_file: Option<PathBuf>,
    /// From which side each axis comes, where backlash is stated; without it the mean
    #[arg(long, value_name = "\"X=+ C=-\"")]
    approach: Option<String>,
    /// Also the nominal and actual place of every body in the machine frame
    #[arg(long, conflicts_with = "at_file")]
    bodies: bool,
    /// For people or for programs
    #[arg(long, value_enum, default_value = "text")]
    format: Format,
}

pub fn run(arguments: &Arguments) -> Outcome {
    let mut problems = Diagnostics::new();
    let answer = answer(arguments, &mut problems);
    finish(problems, answer)
}

fn answer(arguments: &Arguments, problems: &mut Diagnostics) -> Option<Answer> {
    let machine = arguments.machine.read(problems)?;
    let approach = match &arguments.approach {
        Some(text) => arguments::approach(&machine, text, problems),
        None => Some(Approach::default()),
    };
    if let Some(path) = &arguments.at_file {
        return batch::answer(&machine, path, &approach?, arguments.format, problems);
    }
    let text = arguments.at.as_deref().unwrap_or_default();
    let command = arguments::command(&machine, "--at", text, problems)?;
    for axis in arguments::beyond_travel(&machine, &command) {
        let message = format!("{axis} stands outside its travel");
        let hint = "the machine cannot go there";
        problems.warn("outside-travel", argument("--at"), message, hint);
    }
    let place = argument("--at");
    let (errors, deviation) = deviation(&machine, &command, &approach?, &place, problems)?;
    let budget = budget(&machine, &command, &errors);
    let bodies = arguments.bodies.then(|| bodies(&machine, &command, &errors));
    Some(match arguments.format {
        Format::Json => Answer::Json(document(&deviation, &budget, bodies)),
        Format::Text => Answer::Text(table(&machine, &deviation, &budget, bodies)),
    })
}

/// The errors at a position and what they do to the tool.
fn deviation(
    machine: &Machine,
    command: &Command,
    approach: &Approach,
    place: &Place,
    problems: &mut Diagnostics,
) -> Option<(ErrorValues, Deviation)> {
    let refuse = |e: trueaxis::machine::chain::CommandFault| {
        let hint = "stay inside the table, or say outside = \"clamp\" or \"extend\" for it";
        problems.error("outside-table", place.clone(), e.to_string(), hint);
    };
    let errors = machine.errors_at(command, approach).map_err(refuse).ok()?;
    let deviation = machine.deviation(command, &errors);
    let vectors = [deviation.nominal_tip.vector(), deviation.tip_mm, deviation.axis];
    if !vectors.iter().all(|v| v.iter().all(|x| x.is_finite())) {
        let message = "the errors here are too large to be computed".to_owned();
        let hint = "an error curve runs away outside the travel: stay inside";
        problems.error("not-finite", place.clone(), message, hint);
        return None;
    }
    Some((errors, deviation))
}

pub type Budget = Vec<(ErrorName, Deviation)>;

/// The deviation under each stated error alone.
pub fn budget(machine: &Machine, command: &Command, errors: &ErrorValues) -> Budget {
    let alone = |index| machine.deviation(command, &errors.only(index));
    machine.stated_errors().into_iter().map(|(index, name)| (name, alone(index))).collect()
}

pub type Bodies = Vec<(String, [Pose<Bed, Body>; 2])>;

pub fn bodies(machine: &Machine, command: &Command, errors: &ErrorValues) -> Bodies {
    let nominal = machine.body_poses(command, &ErrorValues::default());
    let actual = machine.body_poses(command, errors);
    let names = machine.bodies().iter().map(|b| b.name.to_string());
    names.zip(nominal.into_iter().zip(actual).map(|(n, a)| [n, a])).collect()
}

fn array(v: Vec3) -> [f64; 3] {
    [v.x, v.y, v.z].map(|x| x + 0.0) // no minus before a zero
}

fn document(deviation: &Deviation, budget: &Budget, bodies: Option<Bodies>) -> Value {
    let mut document = json!({ "schema": "trueaxis/pose/1" });
    let values = deviation_json(deviation);
    for key in ["nominal", "actual", "deviation"] {
        document[key] = values[key].clone();
    }
    document["budget"] = budget_json(budget);
    if let Some(bodies) = bodies {
        document["bodies"] = bodies_json(bodies);
    }
    document
}

/// Nominal and actual tool, and the difference.
pub fn deviation_json(deviation: &Deviation) -> Value {
    let (tip, axis) = (deviation.nominal_tip.vector(), deviation.nominal_axis.vector());
    json!({
        "nominal": { "tip_mm": array(tip), "axis": array(axis) },
        "actual": {
            "tip_mm": array(tip + deviation.tip_mm),
            "axis": array(axis + deviation.axis),
        },
        "deviation": {
            "tip_um": array(deviation.tip_mm * 1e3),
            "axis_urad": array(deviation.axis * 1e6),
        },
    })
}

/// Each error alone.
pub fn budget_json(budget: &Budget) -> Value {
    let share = |(name, share): &(ErrorName, Deviation)| {
        json!({
            "error": name.to_string(),
            "tip_um": array(share.tip_mm * 1e3),
            "axis_urad": array(share.axis * 1e6),
        })
    };
    budget.iter().map(share).collect()
}

/// Nominal and actual place of every body.
pub fn bodies_json(bodies: Bodies) -> Value {
    bodies.into_iter().map(|(name, poses)| body_json(&name, poses)).collect()
}

fn body_json(name: &str, [nominal, actual]: [Pose<Bed, Body>; 2]) -> Value {
    let pose = |pose: &Pose<Bed, Body>| {
        let rows: Vec<[f64; 3]> = (0..3).map(|i| array(pose.linear().row(i).transpose())).collect();
        json!({ "origin_mm": array(*pose.shift_mm()), "rotation": rows })
    };
    json!({ "body": name, "nominal": pose(&nominal), "actual": pose(&actual) })
}

/// Three numbers in columns of equal width.
fn columns(v: Vec3, width: usize, digits: usize) -> String {
    let [x, y, z] = array(v).map(|x| fixed(x, digits));
    format!("{x:>width$} {y:>width$} {z:>width$}")
}

fn table(
    machine: &Machine,
    deviation: &Deviation,
    budget: &Budget,
    bodies: Option<Bodies>,
) -> String {
    let (tip, axis) = (deviation.nominal_tip.vector(), deviation.nominal_axis.vector());
    let mut text = format!("{}   {}\n\n", machine.name(), machine.chain_text());
    text += &format!("{:<22}{:>14} {:>14} {:>14}\n", "in the workpiece frame", "x", "y", "z");
    let mut row = |name: &str, v: Vec3, digits: usize, unit: &str| {
        let line = format!("{name:<22}{}  {unit}", columns(v, 14, digits));
        // Writing to a String cannot fail.
        let _ = writeln!(text, "{}", line.trim_end());
    };
    row("tip, nominal", tip, 4, "mm");
    row("tip, actual", tip + deviation.tip_mm, 4, "mm");
    row("  deviation", deviation.tip_mm * 1e3, 3, "µm");
    row("axis, nominal", axis, 7, "");
    row("axis, actual", axis + deviation.axis, 7, "");
    row("  deviation", deviation.axis * 1e6, 3, "µrad");
    text += &budget_table(budget);
    if let Some(bodies) = bodies {
        text += &bodies_table(&bodies);
    }
    text
}

/// The errors that move the tip or turn the axis here, the greatest first.
pub fn budget_table(budget: &Budget) -> String {
    let mut felt: Vec<_> =
        budget.iter().filter(|(_, d)| d.tip_mm.norm() + d.axis.norm() > 0.0).collect();
    if felt.is_empty() {
        return String::new();
    }
    felt.sort_by(|a, b| b.1.tip_mm.norm().total_cmp(&a.1.tip_mm.norm()));
    let mut text = String::from(
        "\neach error alone            tip, µm                         axis, µrad\n\
         \u{20}                    x          y          z            x          y          z\n",
    );
    for (name, d) in felt {
        let (tip, axis) = (columns(d.tip_mm * 1e3, 10, 3), columns(d.axis * 1e6, 10, 3));
        let _ = writeln!(text, "{:<11} {tip}   {axis}", name.to_string());
    }
    text
}

pub fn bodies_table(bodies: &Bodies) -> String {
    let mut text = String::from(
        "\nbody in the machine frame      nominal, mm                   actual - nominal, µm\n\
         \u{20}             x            y            z           x         y         z\n",
    );
    for (name, [nominal, actual]) in bodies {
        let (n, d) = (*nominal.shift_mm(), (actual.shift_mm() - nominal.shift_mm()) * 1e3);
        let _ = writeln!(text, "  {name} {}   {}", columns(n, 12, 4), columns(d, 9, 3));
    }
    text
}
