//! Where is the tool?

use super::words::{self, argument};
use super::{Answer, MachineChoice, Question, Tell};
use crate::report::{self, PoseReport, array};
use serde_json::Value;
use std::path::PathBuf;
use trueaxis_input::{CsvTable, Diagnostics, Files};
use trueaxis_machine::axis::{Approach, Command};
use trueaxis_machine::describe::{axis_index, to_inner, warn_beyond_travel};
use trueaxis_machine::errors::ErrorValues;
use trueaxis_machine::{Deviation, Machine};
use trueaxis_motion::POSE_COLUMNS;
use trueaxis_report::{Report, Section, document};

/// The tool at one position of the axes, or at many: nominal and actual.
#[derive(Debug, Clone)]
pub struct AskPose {
    /// The machine.
    pub machine: MachineChoice,
    /// Where its axes stand.
    pub at: Positions,
    /// From where each axis comes, as typed: `X=+ C=-`; without it the mean of both directions.
    pub approach: Option<String>,
    /// Whether the place of every body is wanted, too.
    pub bodies: bool,
}

/// One position or many.
#[derive(Debug, Clone)]
pub enum Positions {
    /// As typed: `X=10 C=30`, mm and degrees.
    One(String),
    /// A table whose columns are named by axis.
    File(PathBuf),
}

/// Positions that were read.
#[derive(Debug)]
pub struct PoseInput {
    machine: Machine,
    approach: Approach,
    commands: Vec<Command>,
    table: Option<CsvTable>,
}

/// The tool at one position, or at each position of a table.
#[derive(Debug)]
pub enum PoseAnswer {
    /// One position.
    One(Box<PoseFound>),
    /// The headings and the numbers of a table.
    Rows(Vec<String>, Vec<Vec<f64>>),
}

/// A machine at one position.
#[derive(Debug)]
pub struct PoseFound {
    machine: Machine,
    command: Command,
    errors: ErrorValues,
    deviation: Deviation,
    with_bodies: bool,
}

impl Question for AskPose {
    type Input = PoseInput;
    type Answer = PoseAnswer;

    fn read(&self, files: &Files, problems: &mut Diagnostics) -> Option<PoseInput> {
        let machine = self.machine.read(files, problems)?;
        let approach = match &self.approach {
            Some(text) => words::approach(&machine, text, problems),
            None => Some(Approach::default()),
        };
        let (commands, table) = match &self.at {
            Positions::One(text) => {
                let command = words::command(&machine, "--at", text, problems)?;
                warn_beyond_travel(&machine, &command, &argument("--at"), problems);
                (vec![command], None)
            }
            Positions::File(path) => {
                let table = words::table(files, path, "a CSV table of axis positions", problems)?;
                let commands = commands(&machine, &table, problems)?;
                (commands, Some(table))
            }
        };
        Some(PoseInput { machine, approach: approach?, commands, table })
    }

    fn answer(
        &self,
        PoseInput { machine, approach, commands, table }: PoseInput,
        _: Tell<'_>,
        problems: &mut Diagnostics,
    ) -> Option<PoseAnswer> {
        let Some(table) = table else {
            let [command] = commands[..] else { return None };
            let place = argument("--at");
            let found = PoseReport::at(&machine, &command, &approach, &place, problems)?;
            let PoseReport { errors, deviation, .. } = found;
            let with_bodies = self.bodies;
            let found = PoseFound { machine, command, errors, deviation, with_bodies };
            return Some(PoseAnswer::One(Box::new(found)));
        };
        // Every row is tried, so that all rows with problems are reported at once.
        let mut rows = Vec::with_capacity(commands.len());
        for (row, command) in commands.iter().enumerate() {
            let place = table.row_place(row);
            let found = PoseReport::at(&machine, command, &approach, &place, problems);
            rows.extend(found.map(|found| numbers(&table, row, &found.deviation)));
        }
        let given = table.columns.into_iter().map(|c| c.name);
        Some(PoseAnswer::Rows(given.chain(POSE_COLUMNS.map(Into::into)).collect(), rows))
    }
}

/// The positions of a table; none if a column is no axis.
fn commands(
    machine: &Machine,
    table: &CsvTable,
    problems: &mut Diagnostics,
) -> Option<Vec<Command>> {
    let mut commands = vec![Command::default(); table.rows()];
    let mut are_axes = true;
    for column in &table.columns {
        let Some(axis) = axis_index(machine, &column.name) else {
            let message = format!("the machine has no axis `{}`", column.name);
            let hint = "name each column by an axis of the machine, mm and degrees";
            problems.error("unknown-axis", column.place.clone(), message, hint);
            are_axes = false;
            continue;
        };
        for (command, value) in commands.iter_mut().zip(&column.values) {
            command[axis] = to_inner(machine, axis, *value);
        }
    }
    if !are_axes || problems.has_errors() {
        return None;
    }
    warn_of_rows(machine, table, &commands, problems);
    Some(commands)
}

/// One warning for each axis, at the first row that it concerns.
fn warn_of_rows(
    machine: &Machine,
    table: &CsvTable,
    commands: &[Command],
    problems: &mut Diagnostics,
) {
    for (index, axis) in machine.axes().iter().enumerate() {
        let beyond = |c: &Command| !axis.travel.contains(c[index]);
        let Some(first) = commands.iter().position(beyond) else { continue };
        let count = commands.iter().filter(|c| beyond(c)).count();
        let rows = commands.len();
        let message = format!("{} stands outside its travel in {count} of {rows} rows", axis.name);
        let hint = "the machine cannot go there; this is the first such row";
        problems.warn("outside-travel", table.row_place(first), message, hint);
    }
}

fn numbers(table: &CsvTable, row: usize, d: &Deviation) -> Vec<f64> {
    let given = table.columns.iter().map(|c| c.values[row] + 0.0);
    let vectors =
        [d.nominal_tip.vector(), d.nominal_axis.vector(), d.tip_mm * 1e3, d.axis * 1e6].map(array);
    given.chain(vectors.into_iter().flatten()).collect()
}

impl PoseFound {
    fn shown(&self) -> PoseReport<'_> {
        PoseReport {
            machine: &self.machine,
            command: self.command,
            errors: self.errors,
            deviation: self.deviation,
            with_bodies: self.with_bodies,
        }
    }
}

impl Answer for PoseAnswer {
    fn document(&self, _: &Diagnostics) -> Value {
        match self {
            Self::One(found) => document(&report::PoseDocument::from(&found.shown())),
            Self::Rows(names, rows) => {
                let names: Vec<&str> = names.iter().map(String::as_str).collect();
                report::pose_rows_json(&names, rows)
            }
        }
    }

    fn report(&self) -> Report<'_> {
        match self {
            Self::One(found) => report::pose_report(&found.shown()),
            Self::Rows(names, rows) => {
                Report::new("Poses").section(Section::new("").code(words::csv(names, rows)))
            }
        }
    }

    /// The poses of a table are a table again.
    fn text(&self) -> String {
        match self {
            Self::One(_) => self.report().text(),
            Self::Rows(names, rows) => words::csv(names, rows),
        }
    }
}
