//! Measured test pieces: virtually, and against their tolerances and their prediction.

use super::predict::refuse;
use super::{Answer, NewFile, Question, Tell, with_diagnostics};
use crate::files::output::Output;
use crate::report;
use crate::verify::part::{PartError, PartResult, PartStudy, read_part, verify_part};
use serde::Serialize;
use serde_json::Value;
use std::fmt::Write;
use std::path::PathBuf;
use trueaxis_input::{Diagnostics, Dimension, Files, Place, parse_quantity};
use trueaxis_part::tolerance::Outcome;
use trueaxis_predict::predict::{Study, VirtualPart, cut_virtually, read_study};
use trueaxis_report::JsonSchema;
use trueaxis_report::{Report, Section, Table};

/// Measured test pieces against their tolerances and their prediction.
#[derive(Debug, Clone, Default)]
pub struct VerifyPart {
    /// The file of the measured parts.
    pub file: PathBuf,
}

/// Measured parts with what was found out.
#[derive(Debug)]
pub struct PartAnswer {
    task: PartStudy,
    found: PartResult,
}

impl Question for VerifyPart {
    type Input = PartStudy;
    type Answer = PartAnswer;

    fn read(&self, files: &Files, problems: &mut Diagnostics) -> Option<PartStudy> {
        problems.keep(read_part(files, &self.file))
    }

    fn answer(
        &self,
        task: PartStudy,
        _: Tell<'_>,
        problems: &mut Diagnostics,
    ) -> Option<PartAnswer> {
        let place = Place::whole(&self.file.display().to_string());
        match verify_part(&task) {
            Ok(found) => Some(PartAnswer { task, found }),
            Err(PartError::Prediction(error)) => {
                refuse(&error, place, problems);
                None
            }
            Err(error) => {
                let hint = "check the points of the sections";
                problems.error("not-evaluable", place, error.to_string(), hint);
                None
            }
        }
    }
}

impl Answer for PartAnswer {
    fn document(&self, problems: &Diagnostics) -> Value {
        with_diagnostics(&report::VerifyPartDocument::of(&self.task, &self.found), problems)
    }

    fn report(&self) -> Report<'_> {
        report::part_report(&self.task, &self.found)
    }

    fn is_yes(&self) -> bool {
        self.found.outcome == Outcome::Pass
    }
}

/// The test piece of a study, cut once and measured on a coordinate measuring machine.
#[derive(Debug, Clone, Default)]
pub struct MeasurePart {
    /// The study.
    pub study: PathBuf,
    /// The file of the points.
    pub output: Option<PathBuf>,
    /// The random seed.
    pub seed: u64,
    /// Whether the errors of the machine are drawn within their uncertainties.
    pub draw: bool,
    /// The standard uncertainty of a point along the normal, as typed.
    pub point_u: String,
}

/// A part that was cut and measured virtually.
#[derive(Debug)]
pub struct VirtualPartAnswer {
    study: Study,
    part: VirtualPart,
    seed: u64,
    drawn: bool,
    u_point_mm: f64,
    files: Vec<NewFile>,
}

/// A test piece that was cut and measured virtually.
#[derive(Debug, Serialize, JsonSchema)]
pub struct VirtualPartDocument<'a> {
    /// Which document this is.
    #[schemars(extend("const" = "trueaxis/measure-part/1"))]
    pub schema: &'static str,
    /// The name of the study.
    pub name: &'a str,
    /// The random seed.
    pub seed: u64,
    /// Whether the errors of the machine were drawn within their uncertainties.
    pub drawn: bool,
    /// Standard uncertainty of a point along the normal, mm.
    pub point_u_mm: f64,
    /// The true indices of the part, in the order of the test piece.
    pub indices: Vec<TrueIndexEntry>,
    /// The points.
    pub points: Vec<PointEntry>,
}

/// A true index of a virtual part.
#[derive(Debug, Serialize, JsonSchema)]
pub struct TrueIndexEntry {
    /// Its key.
    pub index: &'static str,
    /// Its value without the noise of the points, mm.
    pub value_mm: f64,
}

/// A point of a virtual part.
#[derive(Debug, Serialize, JsonSchema)]
pub struct PointEntry {
    /// The number of its section, from 1 at the base.
    pub section: usize,
    /// The point in the frame of the datum, mm.
    pub place_mm: [f64; 3],
}

const POINTS_BEGIN: &str = "# points of trueaxis measure --part";

impl Question for MeasurePart {
    type Input = (Study, f64);
    type Answer = VirtualPartAnswer;

    fn read(&self, files: &Files, problems: &mut Diagnostics) -> Option<Self::Input> {
        let study = problems.keep(read_study(files, &self.study));
        let u_mm = match parse_quantity(&self.point_u, Dimension::Length) {
            Ok(u) if u >= 0.0 => Some(u),
            Ok(_) => {
                let message = "an uncertainty is not negative".to_owned();
                problems.error("negative", Place::whole("--point-u"), message, "\"0.7 um\"");
                None
            }
            Err(e) => {
                problems.error(e.code(), Place::whole("--point-u"), e.to_string(), &e.hint());
                None
            }
        };
        Some((study?, u_mm?))
    }

    fn outputs(&self, _: Option<&Self::Input>) -> Vec<Output> {
        self.output.iter().map(|path| Output::file("-o", path)).collect()
    }

    fn answer(
        &self,
        (study, u_point_mm): Self::Input,
        _: Tell<'_>,
        problems: &mut Diagnostics,
    ) -> Option<VirtualPartAnswer> {
        let part = match cut_virtually(&study, (self.seed, self.draw), u_point_mm) {
            Ok(part) => part,
            Err(error) => {
                refuse(&error, Place::whole(&self.study.display().to_string()), problems);
                return None;
            }
        };
        let mut text = format!(
            "{POINTS_BEGIN}: {}, seed {}, errors {}, u = {} um\nsection,x_mm,y_mm,z_mm\n",
            study.name,
            self.seed,
            if self.draw { "drawn" } else { "as stated" },
            (u_point_mm * 1e9).round() / 1e6
        );
        for p in &part.points {
            let at = p.place_mm;
            // Writing to a String cannot fail.
            let _ = writeln!(text, "{},{:.5},{:.5},{:.5}", p.section + 1, at.x, at.y, at.z);
        }
        let files = self.output.iter().map(|path| NewFile::of("points", path, text.clone()));
        let (seed, drawn, files) = (self.seed, self.draw, files.collect());
        Some(VirtualPartAnswer { study, part, seed, drawn, u_point_mm, files })
    }
}

impl Answer for VirtualPartAnswer {
    fn document(&self, problems: &Diagnostics) -> Value {
        let names = self.study.piece().index_names().iter().zip(&self.part.indices_mm);
        let points = self.part.points.iter();
        let document = VirtualPartDocument {
            schema: "trueaxis/measure-part/1",
            name: &self.study.name,
            seed: self.seed,
            drawn: self.drawn,
            point_u_mm: self.u_point_mm,
            indices: names.map(|(n, v)| TrueIndexEntry { index: n.key, value_mm: *v }).collect(),
            points: points
                .map(|p| PointEntry { section: p.section + 1, place_mm: p.place_mm.into() })
                .collect(),
        };
        with_diagnostics(&document, problems)
    }

    fn report(&self) -> Report<'_> {
        let names = self.study.piece().index_names().iter().zip(&self.part.indices_mm);
        let rows = names.map(|(n, v)| [n.title().to_owned(), format!("{:.2}", v * 1e3)]);
        let drawn = if self.drawn { "drawn within their uncertainties" } else { "as stated" };
        Report::new(format!("{}: the part, cut and measured virtually", self.study.name))
            .line(format!(
                "{} points, errors of the machine {drawn}, seed {}, u = {:.2} µm of a point",
                self.part.points.len(),
                self.seed,
                self.u_point_mm * 1e3
            ))
            .line(format!("datum: {}", self.study.reference.datum))
            .section(Section::new("True indices").table(Table::new(["", "µm"]).rows(rows)))
    }

    fn files(&mut self) -> Vec<NewFile> {
        std::mem::take(&mut self.files)
    }
}
