//! What does a touch probe add to its readings?

use super::{Answer, NewFile, Question, Tell, with_diagnostics};
use crate::files::output::Output;
use crate::report;
use serde_json::Value;
use std::path::{Path, PathBuf};
use trueaxis_calibrate::identify::probe::{
    Calibration, Purpose, Setup, Study, correct, identify_probe, parse_hits, read_study,
};
use trueaxis_input::{Diagnostics, Dimension, Files, Place, parse_quantity};
use trueaxis_report::Report;

/// The offset of a stylus ball and its pre-travel by direction, from hits on a ring or sphere.
#[derive(Debug, Clone, Default)]
pub struct IdentifyProbe {
    /// The study: ring or sphere, styli, tables of hits.
    pub study: PathBuf,
    /// Hits to be corrected, and where the corrected ones go.
    pub correct: Option<(PathBuf, PathBuf)>,
    /// Where the table by direction goes.
    pub table: Option<PathBuf>,
    /// The stylus of the tables; the first if none is named.
    pub stylus: Option<String>,
    /// How far the spindle is turned for the tables, as typed: a plain number is in degrees.
    pub orientation: Option<String>,
}

/// A study with its calibrations, one for each stylus.
#[derive(Debug)]
pub struct ProbeAnswer {
    /// The study.
    pub study: Study,
    /// The calibrations.
    pub found: Vec<Calibration>,
    files: Vec<NewFile>,
}

impl IdentifyProbe {
    fn orientation_rad(&self, problems: &mut Diagnostics) -> Option<f64> {
        let text = self.orientation.as_ref()?;
        let number = text.trim().parse::<f64>().is_ok();
        let text = if number { format!("{text} deg") } else { text.clone() };
        let found = parse_quantity(&text, Dimension::Angle);
        let place = Place::whole("--orientation");
        found.map_err(|e| problems.error(e.code(), place, e.to_string(), &e.hint())).ok()
    }

    fn stylus(&self, found: &[Calibration], problems: &mut Diagnostics) -> Option<usize> {
        let Some(name) = &self.stylus else { return Some(0) };
        let index = found.iter().position(|f| f.stylus == *name);
        if index.is_none() {
            let names: Vec<&str> = found.iter().map(|f| f.stylus.as_str()).collect();
            let message = format!("there is no stylus `{name}`");
            let hint = format!("one of {}", names.join(", "));
            problems.error("unknown-stylus", Place::whole("--stylus"), message, &hint);
        }
        index
    }

    /// The tables that were asked for.
    fn tables(
        &self,
        files: &Files,
        study: &Study,
        all: &[Calibration],
        orientation_rad: Option<f64>,
        problems: &mut Diagnostics,
    ) -> Option<Vec<NewFile>> {
        let index = self.stylus(all, problems)?;
        let (found, stylus) = (all.get(index)?, study.styli.get(index)?);
        let mut tables = Vec::new();
        let mut put = |path: &Path, text: String| tables.push(NewFile::of("table", path, text));
        if let Some(path) = &self.table {
            let first = found.orientations_rad.first().copied().unwrap_or(0.0);
            let turned = orientation_rad.unwrap_or(first);
            put(path, report::probe_table_csv(found, study.table_steps, turned));
        }
        if let Some((raw, path)) = &self.correct {
            let text = files.text(raw, "a table of hits (CSV)", problems)?;
            let setup = Setup {
                gauge: &study.gauge,
                ball_radius_mm: found.ball_radius_mm,
                reading: stylus.reading,
                orientation_rad: orientation_rad.unwrap_or(0.0),
                on_gauge: false,
            };
            let hits = parse_hits(&raw.display().to_string(), &text, &setup, problems)?;
            let points = correct(found, &hits, problems)?;
            put(path, report::corrected_csv(found, &hits, &points));
        }
        Some(tables)
    }
}

impl Question for IdentifyProbe {
    type Input = (Study, Files, Option<f64>);
    type Answer = ProbeAnswer;

    fn read(&self, files: &Files, problems: &mut Diagnostics) -> Option<Self::Input> {
        let study = problems.keep(read_study(files, &self.study, Purpose::Result));
        let orientation_rad = self.orientation_rad(problems);
        Some((study?, files.clone(), orientation_rad))
    }

    fn outputs(&self, _: Option<&Self::Input>) -> Vec<Output> {
        let corrected = self.correct.iter().map(|(_, path)| Output::file("-o", path));
        corrected.chain(self.table.iter().map(|path| Output::file("--table", path))).collect()
    }

    fn answer(
        &self,
        (study, files, orientation_rad): Self::Input,
        _: Tell<'_>,
        problems: &mut Diagnostics,
    ) -> Option<ProbeAnswer> {
        let found = identify_probe(&study, problems)?;
        let files = self.tables(&files, &study, &found, orientation_rad, problems)?;
        Some(ProbeAnswer { study, found, files })
    }
}

impl Answer for ProbeAnswer {
    fn document(&self, problems: &Diagnostics) -> Value {
        with_diagnostics(&report::ProbeDocument::of(&self.study, &self.found), problems)
    }

    fn report(&self) -> Report<'_> {
        report::probe_report(&self.study, &self.found)
    }

    fn files(&mut self) -> Vec<NewFile> {
        std::mem::take(&mut self.files)
    }
}
