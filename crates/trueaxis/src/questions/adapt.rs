//! How is a path moved onto the blank that was measured?

use super::words;
use super::{Answer, NewFile, Question, Tell, named_control, with_diagnostics};
use crate::files::output::Output;
use crate::report;
use serde_json::Value;
use std::path::{Path, PathBuf};
use trueaxis_calibrate::identify::surface::{deviations, read_hits};
use trueaxis_correct::compensate::adapt::{AdaptStudy, Adaptation, adapt, read_adapt_study};
use trueaxis_correct::report::{AdaptReport, AdaptedProgram};
use trueaxis_input::{Diagnostics, Dimension, Files, Place, parse_quantity};
use trueaxis_post::{PostOptions, post, verify};
use trueaxis_report::Report;
use trueaxis_writer::TipWords;

/// A path moved onto a measured blank, and the wall that it leaves.
#[derive(Debug, Clone)]
pub struct Adapt {
    /// The study: path, measured blank, cutter, wall.
    pub study: PathBuf,
    /// Where the program of the adapted path goes, and the control that it is for, by its name.
    pub output: Option<(PathBuf, String)>,
    /// Whether the control keeps the tip of the tool on the path (TCP).
    pub tcp: bool,
    /// Largest distance between adapted path and program, mm, as typed.
    pub tolerance: String,
    /// Where the adapted cutter locations go.
    pub cl: Option<PathBuf>,
}

/// A study with the adapted path.
#[derive(Debug)]
pub struct AdaptAnswer {
    study: AdaptStudy,
    adaptation: Adaptation,
    program: Option<AdaptedProgram>,
    /// Words of the path that are not applied.
    not_applied: usize,
    files: Vec<NewFile>,
    asked_for_files: bool,
}

impl Adapt {
    fn options(&self, problems: &mut Diagnostics) -> Option<PostOptions> {
        let tolerance_mm = parse_quantity(&self.tolerance, Dimension::Ratio).ok();
        let Some(tolerance_mm) = tolerance_mm.filter(|v| (1e-6..1.0).contains(v)) else {
            let message = format!("`{}` is not a tolerance in mm", self.tolerance);
            problems.error("bad-number", Place::whole("--tolerance"), message, "such as 0.001");
            return None;
        };
        let (path, control) = self.output.as_ref()?;
        let name = path.file_stem();
        Some(PostOptions {
            tip_words: self.tcp.then_some(TipWords::Angles),
            tolerance_mm,
            name: name.map_or_else(|| "PROGRAM".into(), |n| n.to_string_lossy().into_owned()),
            ..PostOptions::of(named_control(control, problems)?)
        })
    }

    /// The program of the adapted path, with its proof.
    fn program(
        &self,
        study: &AdaptStudy,
        adaptation: &Adaptation,
        options: &PostOptions,
        problems: &mut Diagnostics,
    ) -> Option<(AdaptedProgram, NewFile)> {
        let path = self.output.as_ref()?.0.clone();
        let posted = problems.keep(post(&study.machine, &adaptation.path, options))?;
        let proof = verify(&study.machine, &posted, options);
        let program = AdaptedProgram {
            file: path.display().to_string(),
            written: proof.is_within(options) && adaptation.findings.is_empty(),
            blocks: posted.blocks,
            tip_mm: proof.tip_between.value,
            axis_rad: proof.axis_between.value,
        };
        Some((program, NewFile::of("program", path, posted.text)))
    }

    /// The adapted cutter locations, in the form of those that were read.
    fn cutter_locations(&self, study: &AdaptStudy, adaptation: &Adaptation) -> Option<NewFile> {
        let begin = if study.path.is_table() { "#" } else { "$$" };
        let mut text = format!("{begin} adapted by trueaxis: {}\n", one_line(&study.name));
        text.retain(|c| c.is_ascii());
        let content = [text.into_bytes(), adaptation.path.rewritten()].concat();
        Some(NewFile::of("path", self.cl.as_ref()?, content))
    }
}

fn one_line(text: &str) -> String {
    text.chars().map(|c| if c.is_control() { ' ' } else { c }).take(60).collect()
}

impl Question for Adapt {
    type Input = (AdaptStudy, Option<PostOptions>);
    type Answer = AdaptAnswer;

    fn read(&self, files: &Files, problems: &mut Diagnostics) -> Option<Self::Input> {
        // The path knows nothing of probes: what hits say of the blank is another question.
        let from_hits = |path: &Path, found: &mut Diagnostics| {
            let hits = found.keep(read_hits(files, path))?;
            let surface = deviations(&hits, found)?;
            Some(report::deviations_csv(&hits, &surface))
        };
        let study = problems.keep(read_adapt_study(files, &self.study, &from_hits));
        let options = self.options(problems);
        Some((study?, options))
    }

    fn outputs(&self, _: Option<&Self::Input>) -> Vec<Output> {
        let program = self.output.iter().map(|(path, _)| Output::file("-o", path));
        program.chain(self.cl.iter().map(|path| Output::file("--cl", path))).collect()
    }

    fn answer(
        &self,
        (study, options): Self::Input,
        _: Tell<'_>,
        problems: &mut Diagnostics,
    ) -> Option<AdaptAnswer> {
        let adaptation = problems.keep(adapt(&study))?;
        let program = match &options {
            Some(options) => self.program(&study, &adaptation, options, problems),
            None => None,
        };
        let mut files = Vec::new();
        let (program, text) = program.unzip();
        files.extend(text.filter(|_| program.as_ref().is_some_and(|p| p.written)));
        if adaptation.findings.is_empty() {
            files.extend(self.cutter_locations(&study, &adaptation));
        }
        let asked_for_files = self.output.is_some() || self.cl.is_some();
        let not_applied = words::not_applied(problems);
        Some(AdaptAnswer { study, adaptation, program, not_applied, files, asked_for_files })
    }
}

impl AdaptAnswer {
    fn shown(&self) -> AdaptReport<'_> {
        let Self { study, adaptation, program, not_applied, .. } = self;
        AdaptReport { study, adaptation, program: program.as_ref(), not_applied: *not_applied }
    }
}

impl Answer for AdaptAnswer {
    fn document(&self, problems: &Diagnostics) -> Value {
        with_diagnostics(&report::AdaptDocument::of(&self.shown()), problems)
    }

    fn report(&self) -> Report<'_> {
        report::adapt_report(&self.shown())
    }

    fn is_yes(&self) -> bool {
        self.shown().is_sound() && self.not_applied == 0
    }

    fn files(&mut self) -> Vec<NewFile> {
        std::mem::take(&mut self.files)
    }

    fn notes(&self) -> Vec<String> {
        let refused = !self.adaptation.findings.is_empty() && self.asked_for_files;
        let note = "the adapted path must not be cut; neither program nor path was written";
        refused.then(|| note.to_owned()).into_iter().collect()
    }
}
