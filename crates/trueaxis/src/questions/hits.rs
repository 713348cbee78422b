//! What does a surface deviate by, after the hits of a probing program?

use super::{Answer, NewFile, Question, Tell, with_diagnostics};
use crate::files::output::Output;
use crate::report;
use serde_json::Value;
use std::path::PathBuf;
use trueaxis_calibrate::identify::surface::{HitsStudy, SurfaceDeviations, deviations, read_hits};
use trueaxis_input::{Diagnostics, Files};
use trueaxis_report::Report;

/// Deviations of a surface along its normals, from the log of a probing program.
#[derive(Debug, Clone, Default)]
pub struct IdentifySurface {
    /// The study: machine, points, log, probe.
    pub study: PathBuf,
    /// Where the table of deviations goes, which `compensate adapt` reads.
    pub output: Option<PathBuf>,
}

/// A study with its deviations.
#[derive(Debug)]
pub struct HitsAnswer {
    /// The study.
    pub study: HitsStudy,
    /// The deviations.
    pub found: SurfaceDeviations,
    output: Option<PathBuf>,
}

impl Question for IdentifySurface {
    type Input = HitsStudy;
    type Answer = HitsAnswer;

    fn read(&self, files: &Files, problems: &mut Diagnostics) -> Option<Self::Input> {
        problems.keep(read_hits(files, &self.study))
    }

    fn outputs(&self, _: Option<&Self::Input>) -> Vec<Output> {
        self.output.iter().map(|path| Output::file("-o", path)).collect()
    }

    fn answer(
        &self,
        study: HitsStudy,
        _: Tell<'_>,
        problems: &mut Diagnostics,
    ) -> Option<HitsAnswer> {
        let found = deviations(&study, problems)?;
        Some(HitsAnswer { study, found, output: self.output.clone() })
    }
}

impl Answer for HitsAnswer {
    fn document(&self, problems: &Diagnostics) -> Value {
        with_diagnostics(&report::HitsDocument::of(&self.study, &self.found), problems)
    }

    fn report(&self) -> Report<'_> {
        report::deviations_report(&self.study, &self.found)
    }

    fn files(&mut self) -> Vec<NewFile> {
        let table = self.output.as_deref().map(|path| {
            NewFile::of("table", path, report::deviations_csv(&self.study, &self.found))
        });
        table.into_iter().collect()
    }
}
