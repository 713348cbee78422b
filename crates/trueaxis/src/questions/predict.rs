//! Will the part be good?

use super::{Answer, NewFile, Question, Tell};
use crate::files::output::Output;
use crate::report;
use serde_json::Value;
use std::path::PathBuf;
use trueaxis_correct::compensate::program::{ProgramOptions, compensate_program};
use trueaxis_input::{Diagnostics, Files, Place};
use trueaxis_nc::Program;
use trueaxis_part::qif::results::{Found, results, results_csv};
use trueaxis_part::tolerance::Outcome;
use trueaxis_predict::predict::drawing::{
    CompensatedPart, PartPrediction, PartStudy, PartValue, is_part_study, predict_compensated,
    predict_part, read_part_study,
};
use trueaxis_predict::predict::holes::{
    HolePrediction, HoleSet, HoleStudy, is_hole_study, predict_holes, read_hole_study,
};
use trueaxis_predict::predict::{Error, Prediction, Sampling, Study, predict, read_study};
use trueaxis_report::{Report, VERSION, document};

/// A test piece, holes or a part before they are cut.
#[derive(Debug, Clone, Default)]
pub struct Predict {
    /// The study file: machine, part, setting point.
    pub study: PathBuf,
    /// Monte Carlo samples instead of the study's, as typed; 0 for none.
    pub samples: Option<String>,
    /// Random seed instead of the study's.
    pub seed: Option<u64>,
    /// Whether a part is judged by its program compensated for the machine, too.
    pub compensated: bool,
    /// Where the characteristics of a part go: a table (`csv`) or a QIF document (`qif`), by the extension.
    pub results: Option<PathBuf>,
}

/// A study that was read.
#[derive(Debug)]
pub enum PredictInput {
    /// A test piece.
    Part(Box<Study>),
    /// Holes on a circle.
    Holes(Box<HoleStudy>),
    /// A part of any shape.
    Drawing(Box<PartStudy>),
}

/// A study with its prediction.
#[derive(Debug)]
pub enum Predicted {
    /// A test piece.
    Part(Box<Study>, Box<Prediction>),
    /// Holes on a circle.
    Holes(Box<HoleStudy>, Box<HolePrediction>),
    /// A part of any shape, and a file of its results; it is handed out once.
    Drawing(Box<PartStudy>, Box<PartPrediction>, Option<NewFile>),
}

impl Predict {
    /// Whether results are wanted as QIF; none where the extension says neither.
    fn is_qif(&self) -> Option<bool> {
        let extension = self.results.as_ref()?.extension()?.to_ascii_lowercase();
        match extension.to_str()? {
            "qif" => Some(true),
            "csv" => Some(false),
            _ => None,
        }
    }

    /// What keeps the results from being written, or the program from being compensated.
    fn check_results(&self, is_part: bool, problems: &mut Diagnostics) {
        if self.compensated && !is_part {
            let message = "only the program of a part is compensated".to_owned();
            let hint = "leave it out; or name a study of a part";
            problems.error("contradiction", Place::whole("--compensated"), message, hint);
        }
        let Some(path) = &self.results else { return };
        let place = Place::whole("--results");
        if !is_part {
            let message = "results are written of a study of a part".to_owned();
            problems.error(
                "contradiction",
                place,
                message,
                "leave it out; --format json has the figures",
            );
        } else if self.is_qif().is_none() {
            let message = format!("`{}` is neither a table nor a QIF document", path.display());
            problems.error("unknown-word", place, message, "--results NAME.csv or NAME.qif");
        }
    }

    fn results_of(
        &self,
        study: &PartStudy,
        prediction: &PartPrediction,
        problems: &mut Diagnostics,
    ) -> Option<NewFile> {
        let (path, is_qif) = (self.results.as_ref()?, self.is_qif()?);
        let found = |v: &PartValue| Found {
            value_mm: v.value_mm,
            u_mm: v.combined_mm(),
            outcome: v.outcome,
        };
        let found: Vec<Found> = prediction.values.iter().map(found).collect();
        let text = match is_qif {
            true => results(&study.part, &found, &format!("TrueAxis {VERSION}")),
            false => results_csv(&study.part, &found),
        };
        match text {
            Ok(text) => Some(NewFile::of("results", path, text)),
            Err(error) => {
                let hint = "values that are finite";
                problems.error(
                    "not-finite-result",
                    Place::whole("--results"),
                    error.to_string(),
                    hint,
                );
                None
            }
        }
    }

    /// The part by its program as `compensate program` writes it; nothing where that cannot be.
    fn compensated(
        &self,
        study: &PartStudy,
        prediction: &PartPrediction,
        problems: &mut Diagnostics,
    ) -> Option<CompensatedPart> {
        let job = &study.job;
        let options = ProgramOptions::default();
        let (rewritten, found) =
            compensate_program(&job.machine, &job.program, &job.setup, &options);
        problems.append(found);
        let rewritten = rewritten?;
        problems.append(rewritten.unproved);
        let program = Program::of(job.program.file(), rewritten.text, job.control);
        predict_compensated(study, prediction, &program, problems)
    }

    fn place(&self) -> Place {
        Place::whole(&self.study.display().to_string())
    }

    /// The sampling of the study, changed as asked.
    fn sampling(&self, stated: Option<Sampling>, samples: Option<usize>) -> Option<Sampling> {
        let mut sampling = stated.unwrap_or_default();
        sampling.samples = samples.unwrap_or(stated.map_or(0, |s| s.samples));
        sampling.seed = self.seed.unwrap_or(sampling.seed);
        Some(sampling).filter(|s| s.samples > 0)
    }

    fn samples(&self, is_part: bool, problems: &mut Diagnostics) -> Option<usize> {
        let text = self.samples.as_deref()?;
        let most = if is_part { PartStudy::MOST_SAMPLES } else { Study::MOST_SAMPLES };
        let samples = text.parse().ok().filter(|n| *n != 1 && *n <= most);
        if samples.is_none() {
            let message = format!("`{text}` is not a possible number of Monte Carlo samples");
            let hint = format!("0 for no Monte Carlo run, or 2 to {most}");
            problems.error("bad-sampling", Place::whole("--samples"), message, &hint);
        }
        samples
    }
}

impl Question for Predict {
    type Input = PredictInput;
    type Answer = Predicted;
    const PROGRESS: &'static str = "Monte Carlo";

    fn read(&self, files: &Files, problems: &mut Diagnostics) -> Option<PredictInput> {
        let is_part = is_part_study(files, &self.study);
        let samples = self.samples(is_part, problems);
        self.check_results(is_part, problems);
        if is_hole_study(files, &self.study) {
            let study = problems.keep(read_hole_study(files, &self.study));
            return study.map(Box::new).map(PredictInput::Holes);
        }
        if is_part {
            let mut study = Box::new(problems.keep(read_part_study(files, &self.study))?);
            study.sampling = self.sampling(study.sampling, samples);
            return Some(PredictInput::Drawing(study));
        }
        let study = problems.keep(read_study(files, &self.study));
        let mut study = Box::new(study?);
        study.sampling = self.sampling(study.sampling, samples);
        Some(PredictInput::Part(study))
    }

    fn outputs(&self, _: Option<&PredictInput>) -> Vec<Output> {
        self.results.iter().map(|path| Output::file("--results", path)).collect()
    }

    fn answer(
        &self,
        input: PredictInput,
        progress: Tell<'_>,
        problems: &mut Diagnostics,
    ) -> Option<Predicted> {
        match input {
            PredictInput::Part(study) => {
                let samples = study.sampling.map_or(0, |s| s.samples).max(1) as f64;
                match predict(&study, &|done| progress(done as f64 / samples)) {
                    Ok(prediction) => Some(Predicted::Part(study, Box::new(prediction))),
                    Err(error) => {
                        refuse(&error, self.place(), problems);
                        None
                    }
                }
            }
            PredictInput::Drawing(study) => {
                let mut prediction = predict_part(&study, progress, problems)?;
                if self.compensated {
                    prediction.compensated =
                        Some(self.compensated(&study, &prediction, problems)?);
                }
                let results = self.results_of(&study, &prediction, problems);
                Some(Predicted::Drawing(study, Box::new(prediction), results))
            }
            PredictInput::Holes(study) => match predict_holes(&study) {
                Ok(prediction) => {
                    for (code, warning) in &prediction.warnings {
                        problems.warn(code, self.place(), warning.clone(), "");
                    }
                    Some(Predicted::Holes(study, Box::new(prediction)))
                }
                Err(found) => {
                    problems.append(found);
                    None
                }
            },
        }
    }
}

/// Says why there is no prediction, and what to change.
pub fn refuse(error: &Error, place: Place, problems: &mut Diagnostics) {
    let hint = match error {
        Error::Setting(_) | Error::SettingOutOfTravel => {
            "choose other rotary positions in [setting], or another fixture in [mounting]"
        }
        Error::Table { .. } => "cover the travel by the table, or say outside = \"clamp\" for it",
        Error::TooFewSamples(_) => "0, or 2 and more",
        Error::LogEnds { .. } => "take a longer log, or start earlier in it",
        _ => "move the part on the machine, tilt it, or change the tool, and ask again",
    };
    problems.error(error.code(), place, error.to_string(), hint);
}

impl Answer for Predicted {
    fn document(&self, _: &Diagnostics) -> Value {
        match self {
            Self::Part(study, prediction) => {
                document(&report::PredictionDocument::of(study, prediction))
            }
            Self::Holes(study, prediction) => {
                document(&report::HolesDocument::of(study, prediction))
            }
            Self::Drawing(study, prediction, _) => {
                document(&report::DrawingDocument::of(study, prediction))
            }
        }
    }

    fn report(&self) -> Report<'_> {
        match self {
            Self::Part(study, prediction) => report::prediction_report(study, prediction),
            Self::Holes(study, prediction) => report::holes_report(study, prediction),
            Self::Drawing(study, prediction, _) => report::drawing_report(study, prediction),
        }
    }

    fn files(&mut self) -> Vec<NewFile> {
        match self {
            Self::Drawing(.., results) => results.take().into_iter().collect(),
            Self::Part(..) | Self::Holes(..) => Vec::new(),
        }
    }

    fn is_yes(&self) -> bool {
        match self {
            Self::Part(_, prediction) => prediction.outcome() == Outcome::Pass,
            Self::Drawing(_, prediction, _) => prediction.outcome == Outcome::Pass,
            Self::Holes(study, prediction) => {
                let applied = prediction.sets.iter().find(|s| s.compensation == study.applied);
                applied.and_then(HoleSet::keeps_tolerances) != Some(false)
            }
        }
    }
}
