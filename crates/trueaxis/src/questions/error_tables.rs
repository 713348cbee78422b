//! Which error tables follow from the readings of a laser and a ball-bar?

use super::machine_folder::{MadeMachine, machine_folder};
use super::{Answer, NewFile, Question, Tell, with_diagnostics};
use crate::files::output::may_fill;
use crate::report::{self, TablesFound};
use crate::verify::error_tables::{
    MachineFiles, TableStudy, error_tables, machine_files, read_tables, squarenesses,
};
use serde_json::Value;
use std::path::{Path, PathBuf};
use trueaxis_input::{Diagnostics, Files, Place};
use trueaxis_machine::file::Folder;
use trueaxis_report::Report;

/// Error tables from readings of single error motions, averaged over runs, and squarenesses from circles.
#[derive(Debug, Clone, Default)]
pub struct IdentifyTables {
    /// The file that names the readings.
    pub study: PathBuf,
    /// The folder of the machine file with these tables, new or empty.
    pub output: Option<PathBuf>,
}

/// The tables, and the files that they lead to.
#[derive(Debug)]
pub struct TablesFoundAnswer {
    found: TablesFound,
    files: Vec<NewFile>,
    notes: Vec<String>,
}

impl Question for IdentifyTables {
    type Input = (TableStudy, Files);
    type Answer = TablesFoundAnswer;

    fn read(&self, files: &Files, problems: &mut Diagnostics) -> Option<Self::Input> {
        let study = problems.keep(read_tables(files, &self.study));
        if let Some(folder) = &self.output {
            may_fill(folder, problems);
        }
        Some((study?, files.clone()))
    }

    fn answer(
        &self,
        (study, files): Self::Input,
        _: Tell<'_>,
        problems: &mut Diagnostics,
    ) -> Option<TablesFoundAnswer> {
        let tables = error_tables(&study, problems);
        if problems.has_errors() {
            return None;
        }
        let old = files.text(&study.machine_path, "the machine file", problems)?;
        let beside = Folder::of(&files, &study.machine_path);
        let refuse = |reason: String, problems: &mut Diagnostics| {
            let place = Place::whole(&self.study.display().to_string());
            let hint =
                "the readings cover the travel, or the machine file states `outside` for the axis";
            problems.error("unwritable-file", place, reason, hint);
        };
        // The circles are those of the machine with the new tables.
        let with_tables = machine_files(&study, &tables, &[], &old, &beside)
            .and_then(|made| made.machine(&beside))
            .map_err(|reason| refuse(reason, problems))
            .ok()?;
        let squarenesses = squarenesses(&study, &with_tables, problems);
        if problems.has_errors() {
            return None;
        }
        let made = machine_files(&study, &tables, &squarenesses, &old, &beside)
            .map_err(|reason| refuse(reason, problems))
            .ok()?;
        let read_back = made.read_back.clone();
        let found = TablesFound { study, tables, squarenesses, read_back };
        let mut answer = TablesFoundAnswer { found, files: Vec::new(), notes: Vec::new() };
        if let Some(folder) = &self.output {
            answer.put(folder, made, problems)?;
        }
        Some(answer)
    }
}

impl TablesFoundAnswer {
    fn put(&mut self, folder: &Path, made: MachineFiles, problems: &mut Diagnostics) -> Option<()> {
        let MachineFiles { text, tables, models, .. } = made;
        let made = MadeMachine { text, tables, models };
        let path = &self.found.study.machine_path;
        let (file, notes) = machine_folder(folder, path, made, Vec::new(), problems)?;
        self.files.push(file);
        self.notes = notes;
        Some(())
    }
}

impl Answer for TablesFoundAnswer {
    fn document(&self, problems: &Diagnostics) -> Value {
        with_diagnostics(&report::TablesFoundDocument::of(&self.found), problems)
    }

    fn report(&self) -> Report<'_> {
        report::error_tables_report(&self.found)
    }

    fn files(&mut self) -> Vec<NewFile> {
        std::mem::take(&mut self.files)
    }

    fn notes(&self) -> Vec<String> {
        self.notes.clone()
    }
}
