//! Where is the tool?

use super::words::{self, argument};
use super::{
    Answer, MachineChoice, PoseTable, Question, Tell, complete, is_absurd, write_document,
};
use crate::report::{self, PoseReport};
use serde_json::{Value, json};
use std::io;
use std::path::PathBuf;
use trueaxis_input::{CsvTable, Diagnostics, Files, Place};
use trueaxis_machine::axis::{Approach, Command};
use trueaxis_machine::describe::{axis_index, to_inner, warn_beyond_travel};
use trueaxis_machine::errors::ErrorValues;
use trueaxis_machine::{Deviation, Machine};
use trueaxis_report::{English, Language, Report, Section, document};

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
    at: Read,
}

/// One position, or those of a table.
#[derive(Debug)]
enum Read {
    One(Command),
    Table(CsvTable),
}

/// The tool at one position, or at each position of a table.
#[derive(Debug)]
pub enum PoseAnswer {
    /// One position.
    One(Box<PoseFound>),
    /// Many.
    Rows(Box<PoseTable>),
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
        note_active(&machine, self.machine.place(), problems);
        let approach = match &self.approach {
            Some(text) => words::approach(&machine, text, problems),
            None => Some(Approach::default()),
        };
        let at = match &self.at {
            Positions::One(text) => {
                let command = words::command(&machine, "--at", text, problems)?;
                warn_beyond_travel(&machine, &command, &argument("--at"), problems);
                Read::One(command)
            }
            Positions::File(path) => {
                let table = words::table(files, path, "a CSV table of axis positions", problems)?;
                are_axes(&machine, &table, problems)?;
                Read::Table(table)
            }
        };
        Some(PoseInput { machine, approach: approach?, at })
    }

    fn answer(
        &self,
        PoseInput { machine, approach, at }: PoseInput,
        _: Tell<'_>,
        problems: &mut Diagnostics,
    ) -> Option<PoseAnswer> {
        let mut table = match at {
            Read::Table(table) => PoseTable::new(&machine, approach, table),
            Read::One(command) => {
                let place = argument("--at");
                let found = PoseReport::at(&machine, &command, &approach, &place, problems)?;
                let PoseReport { errors, deviation, .. } = found;
                let with_bodies = self.bodies;
                let found = PoseFound { machine, command, errors, deviation, with_bodies };
                return Some(PoseAnswer::One(Box::new(found)));
            }
        };
        if !table.examine(is_absurd) {
            // Every row is tried, so that all rows with problems are reported at once.
            for row in 0..table.table().rows() {
                let place = table.table().row_place(row);
                PoseReport::at(&machine, &table.command(row), &approach, &place, problems);
            }
        }
        Some(PoseAnswer::Rows(Box::new(table)))
    }
}

/// A pose shows every error of the machine file, also those that active tables of the control compensate.
fn note_active(machine: &Machine, place: Place, problems: &mut Diagnostics) {
    let Some(names) = machine.active_names() else { return };
    let message = format!("shown with {names}, which the control compensates");
    let hint = "with these tables on, `simulate` and `predict` count them as zero";
    problems.note("already-active", place, message, hint);
}

/// Whether every column of a table is an axis; what stands outside its travel is a warning.
fn are_axes(machine: &Machine, table: &CsvTable, problems: &mut Diagnostics) -> Option<()> {
    let mut are_axes = true;
    for column in &table.columns {
        if axis_index(machine, &column.name).is_none() {
            let message = format!("the machine has no axis `{}`", column.name);
            let hint = "name each column by an axis of the machine, mm and degrees";
            problems.error("unknown-axis", column.place.clone(), message, hint);
            are_axes = false;
        }
    }
    if !are_axes || problems.has_errors() {
        return None;
    }
    warn_of_rows(machine, table, problems);
    Some(())
}

/// One warning for each axis, at the first row that it concerns.
fn warn_of_rows(machine: &Machine, table: &CsvTable, problems: &mut Diagnostics) {
    for (index, axis) in machine.axes().iter().enumerate() {
        let column = table.columns.iter().find(|c| axis_index(machine, &c.name) == Some(index));
        let beyond = |row: &usize| {
            let value = column.map_or(0.0, |c| to_inner(machine, index, c.values[*row]));
            !axis.travel.contains(value)
        };
        let rows = table.rows();
        let Some(first) = (0..rows).find(beyond) else { continue };
        let count = (0..rows).filter(beyond).count();
        let message = format!("{} stands outside its travel in {count} of {rows} rows", axis.name);
        let hint = "the machine cannot go there; this is the first such row";
        problems.warn("outside-travel", table.row_place(first), message, hint);
    }
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

/// The document `trueaxis/pose/1` of a table, with these rows.
fn of_rows(rows: Value) -> Value {
    json!({ "schema": "trueaxis/pose/1", "rows": rows })
}

impl Answer for PoseAnswer {
    fn document(&self, problems: &Diagnostics) -> Value {
        match self {
            Self::One(found) => document(&report::PoseDocument::from(&found.shown())),
            Self::Rows(_) => {
                let mut text = Vec::new();
                // A vector takes every byte, and what was written is JSON.
                let _ = self.write_json(problems, &mut text);
                serde_json::from_slice(&text).unwrap_or_default()
            }
        }
    }

    fn report(&self) -> Report<'_> {
        match self {
            Self::One(found) => report::pose_report(&found.shown()),
            Self::Rows(_) => {
                Report::new("Poses").section(Section::new("").code(self.text(&English)))
            }
        }
    }

    fn text(&self, language: &dyn Language) -> String {
        let mut text = Vec::new();
        let _ = self.write_text(language, &mut text);
        String::from_utf8_lossy(&text).into_owned()
    }

    /// The poses of a table are a table again.
    fn write_text(&self, language: &dyn Language, out: &mut dyn io::Write) -> io::Result<()> {
        match self {
            Self::One(_) => out.write_all(self.report().in_language(language).text().as_bytes()),
            Self::Rows(table) => table.write_csv(out),
        }
    }

    fn write_json(&self, problems: &Diagnostics, out: &mut dyn io::Write) -> io::Result<()> {
        let Self::Rows(table) = self else {
            return write_document(self.document(problems), problems, out);
        };
        const ROWS: &str = "\"rows\": [";
        let around = format!("{:#}", complete(of_rows(json!([])), problems));
        let (before, after) = around.split_once(ROWS).unwrap_or((&around, ""));
        write!(out, "{before}{ROWS}")?;
        table.write_json_rows(out)?;
        writeln!(out, "{after}")
    }

    fn examined(&self, problems: &Diagnostics) -> Value {
        match self {
            Self::One(_) => self.document(problems),
            Self::Rows(table) => of_rows(Value::Object(table.conspicuous())),
        }
    }
}
