use crate::arguments::{self, MachineArguments, argument};
use crate::output::{Format, Outcome, report, show, show_json};
use clap::Args;
use serde_json::{Value, json};
use std::fmt::Write;
use std::path::{Path, PathBuf};
use trueaxis::files;
use trueaxis::geometry::Vec3;
use trueaxis::geometry::frame::Body;
use trueaxis::geometry::frame::{Bed, Pose};
use trueaxis::geometry::input::{CsvTable, Diagnostics};
use trueaxis::machine::axis::{Approach, Command};
use trueaxis::machine::errors::{ErrorName, ErrorValues};
use trueaxis::machine::{Deviation, Machine};

/// The pose to show.
#[derive(Args)]
#[command(after_help = "Example:\n  trueaxis pose machines/xkas2525/machine.toml \
                        --at \"X=3000 Y=1200 Z=-700 C=-90 A=15\"")]
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
    let result = answer(arguments, &mut problems);
    if report(problems) {
        return Outcome::Unusable;
    }
    let Some(result) = result else { return Outcome::Unusable };
    match result {
        Answer::Text(text) => show(&text),
        Answer::Json(document) => show_json(&document),
    }
    Outcome::Done
}

enum Answer {
    Text(String),
    Json(Value),
}

fn answer(arguments: &Arguments, problems: &mut Diagnostics) -> Option<Answer> {
    let machine = arguments.machine.read(problems)?;
    let approach = match &arguments.approach {
        Some(text) => arguments::approach(&machine, text, problems)?,
        None => Approach::default(),
    };
    if let Some(path) = &arguments.at_file {
        return batch(&machine, path, &approach, arguments.format, problems);
    }
    let text = arguments.at.as_deref().unwrap_or_default();
    let command = arguments::command(&machine, "--at", text, problems)?;
    warn_beyond_travel(&machine, &command, problems);
    let errors = errors_at(&machine, &command, &approach, "--at", problems)?;
    let deviation = machine.deviation(&command, &errors);
    let budget = budget(&machine, &command, &errors);
    let bodies = arguments.bodies.then(|| bodies(&machine, &command, &errors));
    Some(match arguments.format {
        Format::Json => Answer::Json(document(&deviation, &budget, bodies)),
        Format::Text => Answer::Text(table(&machine, &deviation, &budget, bodies)),
    })
}

fn warn_beyond_travel(machine: &Machine, command: &Command, problems: &mut Diagnostics) {
    for (axis, q) in machine.axes().iter().zip(command) {
        if !axis.travel.contains(*q) {
            let message = format!("{} stands outside its travel", axis.name);
            problems.warn(
                "outside-travel",
                argument("--at"),
                message,
                "the machine cannot go there",
            );
        }
    }
}

fn errors_at(
    machine: &Machine,
    command: &Command,
    approach: &Approach,
    place: &str,
    problems: &mut Diagnostics,
) -> Option<ErrorValues> {
    machine
        .errors_at(command, approach)
        .map_err(|e| {
            let hint = "stay inside the table, or say outside = \"clamp\" or \"extend\" for it";
            problems.error("outside-table", argument(place), e.to_string(), hint);
        })
        .ok()
}

/// The deviation under each stated error alone.
fn budget(
    machine: &Machine,
    command: &Command,
    errors: &ErrorValues,
) -> Vec<(ErrorName, Deviation)> {
    let alone = |index| machine.deviation(command, &errors.only(index));
    machine.stated_errors().into_iter().map(|(index, name)| (name, alone(index))).collect()
}

type Bodies = Vec<(String, [Pose<Bed, Body>; 2])>;

fn bodies(machine: &Machine, command: &Command, errors: &ErrorValues) -> Bodies {
    let nominal = machine.body_poses(command, &ErrorValues::default());
    let actual = machine.body_poses(command, errors);
    let names = machine.bodies().iter().map(|b| b.name.to_string());
    names.zip(nominal.into_iter().zip(actual).map(|(n, a)| [n, a])).collect()
}

fn array(v: Vec3) -> [f64; 3] {
    [v.x, v.y, v.z]
}

fn deviation_json(deviation: &Deviation) -> Value {
    json!({
        "tip_um": array(deviation.tip_mm * 1e3),
        "axis_urad": array(deviation.axis * 1e6),
    })
}

fn document(
    deviation: &Deviation,
    budget: &[(ErrorName, Deviation)],
    bodies: Option<Bodies>,
) -> Value {
    let (tip, axis) = (deviation.nominal_tip.vector(), deviation.nominal_axis.vector());
    let budget: Vec<Value> = budget
        .iter()
        .map(|(name, share)| {
            let mut entry = json!({ "error": name.to_string() });
            if let (Some(entry), Value::Object(share)) =
                (entry.as_object_mut(), deviation_json(share))
            {
                entry.extend(share);
            }
            entry
        })
        .collect();
    let mut document = json!({
        "schema": "trueaxis/pose/1",
        "nominal": { "tip_mm": array(tip), "axis": array(axis) },
        "actual": {
            "tip_mm": array(tip + deviation.tip_mm),
            "axis": array(axis + deviation.axis),
        },
        "deviation": deviation_json(deviation),
        "budget": budget,
    });
    if let Some(bodies) = bodies {
        document["bodies"] =
            bodies.into_iter().map(|(name, poses)| body_json(&name, poses)).collect();
    }
    document
}

fn body_json(name: &str, [nominal, actual]: [Pose<Bed, Body>; 2]) -> Value {
    let pose = |pose: &Pose<Bed, Body>| {
        let rows: Vec<[f64; 3]> = (0..3).map(|i| array(pose.linear().row(i).transpose())).collect();
        json!({ "origin_mm": array(*pose.shift_mm()), "rotation": rows })
    };
    json!({ "body": name, "nominal": pose(&nominal), "actual": pose(&actual) })
}

fn table(
    machine: &Machine,
    deviation: &Deviation,
    budget: &[(ErrorName, Deviation)],
    bodies: Option<Bodies>,
) -> String {
    let (tip, axis) = (deviation.nominal_tip.vector(), deviation.nominal_axis.vector());
    let mut text = format!("{}   {}\n\n", machine.name(), machine.chain_text());
    text += "in the workpiece frame         x              y              z\n";
    let mut row = |name: &str, v: Vec3, digits: usize, unit: &str| {
        let _ = writeln!(
            text,
            "{name:<18} {:>14.digits$} {:>14.digits$} {:>14.digits$}  {unit}",
            v.x, v.y, v.z
        );
    };
    row("tip, nominal", tip, 4, "mm");
    row("tip, actual", tip + deviation.tip_mm, 4, "mm");
    row("  deviation", deviation.tip_mm * 1e3, 3, "µm");
    row("axis, nominal", axis, 7, "");
    row("axis, actual", axis + deviation.axis, 7, "");
    row("  deviation", deviation.axis * 1e6, 3, "µrad");
    text += &budget_table(budget);
    if let Some(bodies) = bodies {
        text += "\nbody in the machine frame, nominal mm, actual − nominal µm\n";
        for (name, [nominal, actual]) in bodies {
            let (n, d) = (*nominal.shift_mm(), (actual.shift_mm() - nominal.shift_mm()) * 1e3);
            let _ = writeln!(
                text,
                "  {name}  {:>12.4} {:>12.4} {:>12.4}   {:>9.3} {:>9.3} {:>9.3}",
                n.x, n.y, n.z, d.x, d.y, d.z
            );
        }
    }
    text
}

/// The errors that move the tip or turn the axis here, the greatest first.
fn budget_table(budget: &[(ErrorName, Deviation)]) -> String {
    let mut felt: Vec<_> =
        budget.iter().filter(|(_, d)| d.tip_mm.norm() + d.axis.norm() > 0.0).collect();
    if felt.is_empty() {
        return String::new();
    }
    felt.sort_by(|a, b| b.1.tip_mm.norm().total_cmp(&a.1.tip_mm.norm()));
    let mut text =
        String::from("\neach error alone      tip, µm                          axis, µrad\n");
    for (name, d) in felt {
        let (t, a) = (d.tip_mm * 1e3, d.axis * 1e6);
        let _ = writeln!(
            text,
            "{:<10} {:>10.3} {:>10.3} {:>10.3}   {:>10.3} {:>10.3} {:>10.3}",
            name.to_string(),
            t.x,
            t.y,
            t.z,
            a.x,
            a.y,
            a.z
        );
    }
    text
}

const COLUMNS: [&str; 12] = [
    "tip_x_mm",
    "tip_y_mm",
    "tip_z_mm",
    "axis_i",
    "axis_j",
    "axis_k",
    "dev_x_um",
    "dev_y_um",
    "dev_z_um",
    "dev_i_urad",
    "dev_j_urad",
    "dev_k_urad",
];

fn batch(
    machine: &Machine,
    path: &Path,
    approach: &Approach,
    format: Format,
    problems: &mut Diagnostics,
) -> Option<Answer> {
    let text = files::text(path, "a CSV table of axis positions", problems)?;
    let table = CsvTable::parse(&path.display().to_string(), &text, problems);
    let columns = axis_columns(machine, &table, problems);
    if problems.has_errors() {
        return None;
    }
    let mut csv = table.columns.iter().map(|c| c.name.as_str()).collect::<Vec<_>>().join(",");
    csv += &format!(",{}\n", COLUMNS.join(","));
    let mut rows = Vec::new();
    for row in 0..table.rows() {
        let mut command = Command::default();
        for (column, &axis) in table.columns.iter().zip(&columns) {
            command[axis] = arguments::to_inner(machine, axis, column.values[row]);
        }
        let place = table.row_place(row).to_string();
        let errors = errors_at(machine, &command, approach, &place, problems)?;
        let d = machine.deviation(&command, &errors);
        let numbers: Vec<f64> =
            [d.nominal_tip.vector(), d.nominal_axis.vector(), d.tip_mm * 1e3, d.axis * 1e6]
                .iter()
                .flat_map(|v| array(*v))
                .collect();
        let given = table.columns.iter().map(|c| (c.name.as_str(), c.values[row]));
        let named = given.chain(COLUMNS.into_iter().zip(numbers));
        match format {
            Format::Json => rows.push(named.map(|(k, v)| (k.to_owned(), json!(v))).collect()),
            Format::Text => {
                let fields: Vec<String> = named.map(|(_, v)| v.to_string()).collect();
                csv += &fields.join(",");
                csv += "\n";
            }
        }
    }
    Some(match format {
        Format::Json => Answer::Json(
            json!({ "schema": "trueaxis/pose/1", "rows": rows.into_iter().map(Value::Object).collect::<Vec<_>>() }),
        ),
        Format::Text => Answer::Text(csv),
    })
}

fn axis_columns(machine: &Machine, table: &CsvTable, problems: &mut Diagnostics) -> Vec<usize> {
    let mut columns = Vec::new();
    for column in &table.columns {
        match arguments::axis_index(machine, &column.name) {
            Some(axis) => columns.push(axis),
            None => {
                let message = format!("the machine has no axis `{}`", column.name);
                let hint = "name each column by an axis of the machine, mm and degrees";
                problems.error("unknown-axis", column.place.clone(), message, hint);
            }
        }
    }
    columns
}
