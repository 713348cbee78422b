//! `trueaxis solve`: axis positions for a tool pose.

use crate::arguments::{self, MachineArguments, argument};
use crate::output::{Answer, Format, Outcome, finish};
use clap::Args;
use std::path::{Path, PathBuf};
use trueaxis::geometry::Vec3;
use trueaxis::geometry::frame::{Direction, Point, Workpiece};
use trueaxis::input::{CsvTable, Diagnostics};
use trueaxis::machine::axis::Command;
use trueaxis::machine::{FollowError, FollowFault, Machine, SolveError, Target};
use trueaxis::report::numbers::exact;
use trueaxis::report::{solve_json, solve_path_json, solve_report};

/// The tool pose to reach.
#[derive(Args)]
#[command(after_help = "\
Examples:
  trueaxis solve machines/i5-engraver/machine.toml --tip \"10 20 30\" --axis \"0.3 -0.2 0.93\"
  trueaxis solve machines/i5-engraver/machine.toml --path examples/01_describe/path.csv

All solutions of the nominal machine, the best first; those outside the travel stand last. In a
singular pose the axis without effect keeps its angle of --from.
Exit status: 0 done, 2 unusable input, such as a direction that the machine cannot reach.")]
pub struct Arguments {
    #[command(flatten)]
    machine: MachineArguments,
    /// Tool tip in the workpiece frame, mm
    #[arg(
        long,
        value_name = "\"x y z\"",
        required_unless_present = "path",
        allow_hyphen_values = true
    )]
    tip: Option<String>,
    /// Tool axis from the tip to the spindle, of any length
    #[arg(
        long,
        value_name = "\"i j k\"",
        required_unless_present = "path",
        allow_hyphen_values = true
    )]
    axis: Option<String>,
    /// The present axis positions; the solution nearest to them is the best
    #[arg(long, value_name = "\"A=.. C=..\"", allow_hyphen_values = true)]
    from: Option<String>,
    /// A path: CSV with tip_x_mm,tip_y_mm,tip_z_mm,axis_i,axis_j,axis_k; one best branch
    #[arg(long, value_name = "PATH.csv", conflicts_with_all = ["tip", "axis"])]
    path: Option<PathBuf>,
    /// Output as text or as one JSON document
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
    if arguments.machine.has_temperatures() {
        let message = "temperatures do not change what the nominal machine does".to_owned();
        let hint = "leave them out; pose and simulate show what they do";
        problems.warn("no-effect", argument("--temperature"), message, hint);
    }
    let from = match &arguments.from {
        Some(text) => arguments::command(&machine, "--from", text, problems),
        None => Some(Command::default()),
    };
    if let Some(path) = &arguments.path {
        return follow(&machine, path, &from?, arguments.format, problems);
    }
    let tip = arguments::vector("--tip", arguments.tip.as_deref().unwrap_or_default(), problems);
    let axis = arguments::vector("--axis", arguments.axis.as_deref().unwrap_or_default(), problems);
    let axis = axis.and_then(|v| direction(v, problems));
    let target = Target { tip: Point::from_vector(tip?), axis: axis? };
    let solved = machine.solve(&target, &from?).map_err(|e| refuse(&e, problems)).ok()?;
    if let Some(singular) = &solved.singular {
        let hint = "every angle of that axis points the tool the same way; choose it with --from";
        problems.warn("singular-pose", argument("--axis"), singular.to_string(), hint);
    }
    if !solved.solutions.iter().any(|s| s.within_travel) {
        let message = "no solution lies within the travel of all axes".to_owned();
        let hint = "move or tilt the part, or take another tool";
        problems.warn("outside-travel", argument("--tip"), message, hint);
    }
    Some(match arguments.format {
        Format::Json => Answer::Json(solve_json(&machine, &solved)),
        Format::Text => Answer::Text(solve_report(&machine, &solved).text()),
    })
}

fn direction(vector: Vec3, problems: &mut Diagnostics) -> Option<Direction<Workpiece>> {
    let direction = Direction::of(vector);
    if direction.is_none() {
        let message = "the tool axis has no length".to_owned();
        problems.error("zero-axis", argument("--axis"), message, "write \"0 0 1\" for upright");
    }
    direction
}

fn refuse(error: &SolveError, problems: &mut Diagnostics) {
    let (code, place, hint) = match error {
        SolveError::Unreachable { .. } => {
            ("unreachable-direction", "--axis", "tilt the part, or ask for the closest direction")
        }
        SolveError::TipUnreachable { .. } => {
            ("unreachable-tip", "--tip", "the linear axes of this machine do not span space here")
        }
        SolveError::NotFinite => ("not-finite", "--tip", "write finite numbers"),
    };
    problems.error(code, argument(place), error.to_string(), hint);
}

const COLUMNS: [&str; 6] = ["tip_x_mm", "tip_y_mm", "tip_z_mm", "axis_i", "axis_j", "axis_k"];

fn follow(
    machine: &Machine,
    path: &Path,
    from: &Command,
    format: Format,
    problems: &mut Diagnostics,
) -> Option<Answer> {
    let table = arguments::table(path, "a CSV table of tool poses", problems)?;
    let targets = targets(&table, problems)?;
    let refuse = |error: FollowError| {
        let hint = match &error.fault {
            FollowFault::Solve(_) => "tilt the part or change the path there",
            _ => "move the part, or split the path where the rotary axes may turn back",
        };
        let code = match &error.fault {
            FollowFault::Solve(SolveError::Unreachable { .. }) => "unreachable-direction",
            FollowFault::Solve(SolveError::TipUnreachable { .. }) => "unreachable-tip",
            FollowFault::Solve(SolveError::NotFinite) => "not-finite",
            FollowFault::LeavesTravel { .. } => "path-leaves-travel",
            FollowFault::Jump { .. } => "path-jumps",
        };
        problems.error(code, table.row_place(error.index), error.fault.to_string(), hint);
    };
    let commands = machine.follow(&targets, from).map_err(refuse).ok()?;
    warn_of_poles(machine, &table, (&targets, &commands), problems);
    Some(match format {
        Format::Json => Answer::Json(solve_path_json(machine, &commands)),
        Format::Text => Answer::Text(csv(machine, &commands)),
    })
}

/// Names the first singular pose of a path, and how many there are.
fn warn_of_poles(
    machine: &Machine,
    table: &CsvTable,
    (targets, commands): (&[Target], &[Command]),
    problems: &mut Diagnostics,
) {
    let singular =
        targets.iter().zip(commands).enumerate().filter_map(|(row, (target, command))| {
            let solved = machine.solve(target, command).ok()?;
            Some((row, solved.singular?))
        });
    let all: Vec<_> = singular.collect();
    if let Some((row, first)) = all.first() {
        let message = format!("{first}; singular poses on the path: {}", all.len());
        let hint = "the idle axis turns there while the tool stands";
        problems.warn("singular-pose", table.row_place(*row), message, hint);
    }
}

fn csv(machine: &Machine, commands: &[Command]) -> String {
    let names: Vec<String> = machine.axes().iter().map(|a| a.name.to_string()).collect();
    let mut csv = names.join(",") + "\n";
    for command in commands {
        let values = command.iter().take(names.len()).enumerate();
        let values = values.map(|(i, q)| exact(arguments::to_shown(machine, i, *q)));
        csv += &(values.collect::<Vec<_>>().join(",") + "\n");
    }
    csv
}

fn targets(table: &CsvTable, problems: &mut Diagnostics) -> Option<Vec<Target>> {
    let mut columns = Vec::new();
    for name in COLUMNS {
        match table.column(name) {
            Some(column) => columns.push(&column.values),
            None => {
                let place = argument(&table.file);
                let message = format!("the table has no column `{name}`");
                problems.error("missing-column", place, message, &COLUMNS.join(","));
            }
        }
    }
    for column in table.columns.iter().filter(|c| !COLUMNS.contains(&c.name.as_str())) {
        let message = format!("the column `{}` is not used", column.name);
        problems.warn("unused-column", column.place.clone(), message, &COLUMNS.join(","));
    }
    if columns.len() < COLUMNS.len() {
        return None;
    }
    let mut targets = Vec::new();
    for row in 0..table.rows() {
        let pose: Vec<f64> = columns.iter().map(|values| values[row]).collect();
        let Some(axis) = Direction::of(Vec3::new(pose[3], pose[4], pose[5])) else {
            let message = "the tool axis has no length".to_owned();
            problems.error("zero-axis", table.row_place(row), message, "write 0,0,1 for upright");
            continue;
        };
        targets.push(Target { tip: Point::new(pose[0], pose[1], pose[2]), axis });
    }
    (!problems.has_errors()).then_some(targets)
}
