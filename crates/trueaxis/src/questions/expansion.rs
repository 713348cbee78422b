//! How far does a scale expand, and what are its errors at one temperature?

use super::machine_folder::{MadeMachine, machine_folder};
use super::{Answer, NewFile, Question, Tell, with_diagnostics};
use crate::files::output::may_fill;
use crate::report::{self, ScaleFound};
use serde_json::Value;
use std::path::{Path, PathBuf};
use trueaxis_input::{Diagnostics, Files, Place};
use trueaxis_machine::describe::replacement::NewTables;
use trueaxis_machine::file::Folder;
use trueaxis_report::Report;
use trueaxis_thermal::expansion::{
    Runs, ScaleFiles, geometric_table, identify_expansion, read_runs, scale_files,
};

/// The coefficient of expansion and the error table of scales, each from runs at two or more temperatures.
#[derive(Debug, Clone, Default)]
pub struct IdentifyExpansion {
    /// The files of the runs, one for each scale.
    pub runs: Vec<PathBuf>,
    /// The folder of the machine file with these scales, new or empty.
    pub output: Option<PathBuf>,
}

/// The runs, and the files that they lead to.
#[derive(Debug)]
pub struct ExpansionInput {
    runs: Vec<Runs>,
    files: Files,
}

/// The runs with what was found from them.
#[derive(Debug)]
pub struct ExpansionAnswer {
    scales: Vec<ScaleFound>,
    files: Vec<NewFile>,
    notes: Vec<String>,
}

impl Question for IdentifyExpansion {
    type Input = ExpansionInput;
    type Answer = ExpansionAnswer;

    fn read(&self, files: &Files, problems: &mut Diagnostics) -> Option<ExpansionInput> {
        let read = self.runs.iter().map(|path| problems.keep(read_runs(files, path)));
        let runs: Vec<Option<Runs>> = read.collect();
        let runs: Vec<Runs> = runs.into_iter().collect::<Option<_>>()?;
        if let Some(folder) = &self.output {
            may_fill(folder, problems);
            self.one_machine(&runs, problems);
        }
        Some(ExpansionInput { runs, files: files.clone() })
    }

    fn answer(
        &self,
        input: ExpansionInput,
        _: Tell<'_>,
        problems: &mut Diagnostics,
    ) -> Option<ExpansionAnswer> {
        let mut scales = Vec::new();
        for (runs, path) in input.runs.into_iter().zip(&self.runs) {
            let place = || Place::whole(&path.display().to_string());
            let found = identify_expansion(&runs);
            for warning in &found.warnings {
                problems.warn("identification", place(), warning.clone(), "");
            }
            if self.output.is_some() && !found.is_possible() {
                let message = "no machine file is written with a coefficient that no scale has";
                let hint =
                    "correct the runs: temperatures, columns, units, [laser] material_expansion";
                problems.error("impossible-scale", place(), message.to_owned(), hint);
            }
            match geometric_table(&runs, &found) {
                Ok(table) => scales.push(ScaleFound { runs, found, table }),
                Err(reason) => {
                    let hint = "position_mm of the table: numbers that differ";
                    problems.error("no-table", place(), reason, hint);
                }
            }
        }
        let mut answer = ExpansionAnswer { scales, files: Vec::new(), notes: Vec::new() };
        if let (Some(folder), false) = (&self.output, problems.has_errors()) {
            self.put_into_machine(&mut answer, folder, &input.files, problems)?;
        }
        Some(answer)
    }
}

impl IdentifyExpansion {
    /// A machine file needs an axis for each scale, and one machine for all.
    fn one_machine(&self, runs: &[Runs], problems: &mut Diagnostics) {
        let first = runs.first().and_then(|r| r.scale.machine.as_deref());
        for (i, (runs_i, path)) in runs.iter().zip(&self.runs).enumerate() {
            let place = Place::whole(&path.display().to_string());
            let (axis, machine) = (&runs_i.scale.axis, runs_i.scale.machine.as_deref());
            if machine.is_none() {
                let message = "--output writes a machine file, and `machine` is not stated";
                let hint = "machine = \"machine.toml\" and axis = \"X\" in the file of the runs";
                problems.error("missing-key", place, message.to_owned(), hint);
            } else if machine != first && !same_file(machine, first) {
                let message = "names another machine than the first file of runs".to_owned();
                problems.error("two-machines", place, message, "ask for each machine by itself");
            } else if runs[..i].iter().any(|r| r.scale.axis == *axis) {
                let message = "names an axis that another file of runs names, too".to_owned();
                let hint =
                    "all runs of an axis belong into one file: they determine one coefficient";
                problems.error("axis-twice", place, message, hint);
            }
        }
    }

    /// The machine file with all scales, one after the other.
    fn put_into_machine(
        &self,
        answer: &mut ExpansionAnswer,
        folder: &Path,
        files: &Files,
        problems: &mut Diagnostics,
    ) -> Option<()> {
        let path = answer.scales.first()?.runs.scale.machine.clone()?;
        let mut text = files.text(&path, "the machine file", problems)?;
        let beside = Folder::of(files, &path);
        let mut tables: Vec<(String, String)> = Vec::new();
        let (mut splines, mut models) = (Vec::new(), Vec::new());
        for (scale, path) in answer.scales.iter().zip(&self.runs) {
            let made = NewTables::of(&tables, &beside);
            match scale_files(&scale.runs, &scale.found, &scale.table, &text, &made) {
                Ok(ScaleFiles { text: new, tables: read, models: named, .. }) => {
                    (text, tables, models) = (new, read, named);
                }
                Err(reason) => {
                    let place = Place::whole(&path.display().to_string());
                    let hint = "see axis, machine and the positions of the table of runs";
                    problems.error("unwritable-file", place, reason, hint);
                    return None;
                }
            }
            let axis = scale.runs.scale.axis.as_deref().unwrap_or("axis");
            splines.push((format!("{axis}-spline.csv"), scale.table.pieces_csv(axis)));
        }
        let made = MadeMachine { text, tables, models };
        let (file, notes) = machine_folder(folder, &path, made, splines, problems)?;
        answer.files.push(file);
        answer.notes = notes;
        Some(())
    }
}

fn same_file(one: Option<&Path>, other: Option<&Path>) -> bool {
    one.zip(other).is_some_and(|(a, b)| crate::files::output::same_file(a, b))
}

impl Answer for ExpansionAnswer {
    fn document(&self, problems: &Diagnostics) -> Value {
        match &self.scales[..] {
            [scale] => with_diagnostics(&report::ExpansionDocument::of(scale), problems),
            scales => with_diagnostics(&report::ExpansionsDocument::of(scales), problems),
        }
    }

    fn report(&self) -> Report<'_> {
        report::expansion_report(&self.scales)
    }

    fn files(&mut self) -> Vec<NewFile> {
        std::mem::take(&mut self.files)
    }

    fn notes(&self) -> Vec<String> {
        self.notes.clone()
    }
}
