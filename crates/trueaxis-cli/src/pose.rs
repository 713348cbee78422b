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
use trueaxis::machine::errors::ErrorValues;
use trueaxis::machine::heat::ErrorPart;
use trueaxis::machine::{Deviation, Machine};

/// The pose to show.
#[derive(Args)]
#[command(after_help = "\
Examples:
  trueaxis pose machines/xkas2525/machine.toml --at \"X=3000 Y=1200 Z=-700 C=-90 A=15\"
  trueaxis pose machines/xkas2525/machine.toml --at-file examples/01_describe/positions.csv
  trueaxis pose machines/gantry-001/machine.toml --at \"X=3500\" --temperature \"scale_x=30.5 workpiece=30.5\"

Lengths are in the workpiece frame; deviation = actual - nominal. With temperatures it is the
comprehensive one, machine - workpiece: what the part has at 20 degC. A position outside the travel is
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
        Format::Json => {
            let mut document = document(&deviation, &budget, bodies);
            if machine.is_at_temperatures() {
                add_split(&mut document, &machine, &command, &errors);
            }
            Answer::Json(document)
        }
        Format::Text => {
            let mut text = table(&machine, &deviation, &budget, bodies);
            if machine.is_at_temperatures() {
                text += &split_table(&machine, &command, &errors);
            }
            Answer::Text(text)
        }
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

pub type Budget = Vec<(String, Deviation)>;

/// The deviation under each error alone; thermal parts such as `EXX(scale)` and `workpiece` too.
pub fn budget(machine: &Machine, command: &Command, errors: &ErrorValues) -> Budget {
    let shares = machine.shares(command, errors).into_iter();
    shares.map(|share| (share.name, machine.deviation(command, &share.errors))).collect()
}

/// What each part does to the tip, µm; that of the workpiece is its growth E_w.
fn split(machine: &Machine, command: &Command, errors: &ErrorValues) -> [(ErrorPart, Vec3); 4] {
    ErrorPart::ALL.map(|part| {
        let errors = machine.part(command, errors, part);
        let tip_um = match part {
            ErrorPart::Workpiece => errors.workpiece_mm,
            _ => machine.deviation(command, &errors).tip_mm,
        };
        (part, tip_um * 1e3)
    })
}

/// `comprehensive = machine - workpiece`, and its four parts.
fn add_split(document: &mut Value, machine: &Machine, command: &Command, errors: &ErrorValues) {
    let without = ErrorValues { workpiece_mm: Vec3::zeros(), ..*errors };
    let tip_um = |errors| array(machine.deviation(command, errors).tip_mm * 1e3);
    let parts = split(machine, command, errors).into_iter();
    let parts = parts.map(|(part, um)| (part.name().to_owned(), json!({ "tip_um": array(um) })));
    document["split"] = Value::Object(parts.collect());
    document["machine"] = json!({ "tip_um": tip_um(&without) });
    document["comprehensive"] = json!({
        "tip_um": tip_um(errors),
        "formula": "machine - workpiece = geometric + scale + structure - workpiece",
    });
    if let Some(settling) = machine.heat().workpiece.as_ref().and_then(|w| w.settling) {
        document["settling"] = json!({
            "time_constant_s": settling.time_constant_s,
            "time_to_a_tenth_s": settling.time_to_s(1.0, 0.1),
        });
    }
}

fn split_table(machine: &Machine, command: &Command, errors: &ErrorValues) -> String {
    let mut text = String::from("\nmachine - workpiece, tip, µm    x          y          z\n");
    for (part, um) in split(machine, command, errors) {
        let sign = if part == ErrorPart::Workpiece { '-' } else { '+' };
        // Writing to a String cannot fail.
        let _ = writeln!(text, "{sign} {:<21} {}", part.name(), columns(um, 10, 3));
    }
    let whole = machine.deviation(command, errors).tip_mm * 1e3;
    let _ = writeln!(text, "= {:<21} {}", "comprehensive", columns(whole, 10, 3));
    if let Some(settling) = machine.heat().workpiece.as_ref().and_then(|w| w.settling) {
        let hours = settling.time_to_s(1.0, 0.1) / 3600.0;
        let _ = writeln!(
            text,
            "\nthe workpiece needs {hours:.1} h until a tenth of its difference to the air is left"
        );
    }
    text
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
    let share = |(name, share): &(String, Deviation)| {
        json!({
            "error": name,
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
        let _ = writeln!(text, "{name:<11} {tip}   {axis}");
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
