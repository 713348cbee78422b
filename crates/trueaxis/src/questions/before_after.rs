//! What would a laser read before and after a compensation?

use super::{Answer, NewFile, Question, Tell, with_diagnostics};
use crate::files::output::Output;
use crate::report::{self, BeforeAfterDocument, BeforeAfterReport};
use crate::verify::before_after::{BeforeAfter, Curve, before_after, read_before_after};
use serde_json::Value;
use std::fmt::Write;
use std::path::PathBuf;
use trueaxis_input::{Diagnostics, Files, Place};
use trueaxis_predict::predict::holes::Compensation;
use trueaxis_report::Report;

/// Virtual lasers before and after compensation.
#[derive(Debug, Clone, Default)]
pub struct LaserBeforeAfter {
    /// The campaign: machine, lasers, paths of targets, and if wanted `[compensation]`.
    pub campaign: PathBuf,
    /// The folder for one table of readings per path and compensation.
    pub output: Option<PathBuf>,
}

/// The readings.
pub struct BeforeAfterAnswer {
    study: BeforeAfter,
    curves: Vec<Curve>,
    names: Vec<String>,
    files: Vec<NewFile>,
}

const READINGS_BEGIN: &str = "# virtual readings of trueaxis verify --before-after";

impl LaserBeforeAfter {
    /// Where the readings of a path under a compensation go.
    fn place(&self, study: &BeforeAfter, path: usize, of: Compensation) -> Option<PathBuf> {
        let safe = |c: char| if c.is_alphanumeric() || "-_.".contains(c) { c } else { '_' };
        let name: String = study.real.paths[path].name.chars().map(safe).collect();
        let file = format!("{:02}-{name}-{}.csv", path + 1, of.name());
        self.output.as_ref().map(|folder| folder.join(file))
    }

    fn file(&self, study: &BeforeAfter, curve: &Curve) -> Option<NewFile> {
        let path = self.place(study, curve.path, curve.compensation)?;
        let mut text = format!(
            "{READINGS_BEGIN}: {}, compensated: {}\ntarget_mm,run,direction,deviation_um\n",
            study.campaign.instruments[curve.instrument].name,
            curve.compensation.name()
        );
        for target in &curve.measured.targets {
            for (direction, readings) in [("up", &target.up), ("down", &target.down)] {
                for reading in readings {
                    // Writing to a String cannot fail.
                    let _ = writeln!(
                        text,
                        "{},{},{direction},{}",
                        target.position,
                        reading.run,
                        reading.deviation * 1e3
                    );
                }
            }
        }
        Some(NewFile::of("readings", path, text))
    }
}

impl Question for LaserBeforeAfter {
    type Input = BeforeAfter;
    type Answer = BeforeAfterAnswer;

    fn read(&self, files: &Files, problems: &mut Diagnostics) -> Option<BeforeAfter> {
        problems.keep(read_before_after(files, &self.campaign, None))
    }

    fn outputs(&self, input: Option<&BeforeAfter>) -> Vec<Output> {
        let Some(study) = input else { return Vec::new() };
        let all = (0..study.real.paths.len())
            .flat_map(|path| study.states.iter().map(move |state| (path, *state)));
        all.filter_map(|(path, state)| self.place(study, path, state))
            .map(|path| Output::in_new_folder("-o", path))
            .collect()
    }

    fn answer(
        &self,
        study: BeforeAfter,
        _: Tell<'_>,
        problems: &mut Diagnostics,
    ) -> Option<BeforeAfterAnswer> {
        match before_after(&study) {
            Ok(curves) => {
                let files: Vec<NewFile> =
                    curves.iter().filter_map(|curve| self.file(&study, curve)).collect();
                let names = files.iter().map(|file| file.path.display().to_string()).collect();
                Some(BeforeAfterAnswer { study, curves, names, files })
            }
            Err(error) => {
                let place = Place::whole(&self.campaign.display().to_string());
                let hint = "keep the targets inside the error tables of the machine";
                problems.error("cannot-measure", place, error.to_string(), hint);
                None
            }
        }
    }
}

impl BeforeAfterAnswer {
    fn shown(&self) -> BeforeAfterReport<'_> {
        BeforeAfterReport { study: &self.study, curves: &self.curves, files: &self.names }
    }
}

impl Answer for BeforeAfterAnswer {
    fn document(&self, problems: &Diagnostics) -> Value {
        with_diagnostics(&BeforeAfterDocument::of(&self.shown()), problems)
    }

    fn report(&self) -> Report<'_> {
        report::before_after_report(&self.shown())
    }

    fn files(&mut self) -> Vec<NewFile> {
        std::mem::take(&mut self.files)
    }
}
