//! Where are the rotary centres?

use super::{Answer, NewFile, Question, Tell, with_diagnostics};
use crate::files::output::Output;
use crate::report;
use serde_json::Value;
use std::path::{Path, PathBuf};
use trueaxis_input::{Diagnostics, Files, Place};
use trueaxis_machine::file::Folder;
use trueaxis_measure::unknowns::fit::FitError;
use trueaxis_report::Report;
use trueaxis_rtcp::report::RtcpReport;
use trueaxis_rtcp::rtcp::forecast::{Forecast, forecast};
use trueaxis_rtcp::rtcp::{
    Calibration, Purpose, RtcpStudy, calibrate, machine_file, place_of, read_rtcp,
};

/// The rotary centres for RTCP, from indicator or probe readings at turned poses.
#[derive(Debug, Clone, Default)]
pub struct IdentifyRtcp {
    /// The study: machine, control, readings.
    pub study: PathBuf,
    /// Where a machine file with the centres found goes.
    pub output: Option<PathBuf>,
}

/// A study with the centres found.
#[derive(Debug)]
pub struct RtcpAnswer {
    study: RtcpStudy,
    found: Calibration,
    forecast: Option<Forecast>,
    files: Vec<NewFile>,
}

impl RtcpAnswer {
    fn shown(&self) -> RtcpReport<'_> {
        RtcpReport { study: &self.study, found: &self.found, forecast: self.forecast.as_ref() }
    }
}

impl Question for IdentifyRtcp {
    type Input = (RtcpStudy, Files);
    type Answer = RtcpAnswer;

    fn read(&self, files: &Files, problems: &mut Diagnostics) -> Option<Self::Input> {
        let study = problems.keep(read_rtcp(files, &self.study, Purpose::Result))?;
        Some((study, files.clone()))
    }

    fn outputs(&self, _: Option<&Self::Input>) -> Vec<Output> {
        self.output.iter().map(|path| Output::file("-o", path)).collect()
    }

    fn answer(
        &self,
        (study, files): Self::Input,
        _: Tell<'_>,
        problems: &mut Diagnostics,
    ) -> Option<RtcpAnswer> {
        let found = match calibrate(&study) {
            Ok(found) => found,
            Err(error) => {
                refuse(&study, &error, problems);
                return None;
            }
        };
        if let Some(part) = found.below_noise() {
            let message =
                format!("the residual is {part:.3} of the noise: no indicator reads so well");
            let place = Place::whole(&study.path.display().to_string());
            let hint = "are the readings mm under a heading in µm, or computed? Else state a smaller `noise`";
            problems.warn("small-readings", place, message, hint);
        }
        let files = match &self.output {
            Some(output) => vec![changed_machine(&files, &study, &found, output, problems)?],
            None => Vec::new(),
        };
        let forecast = forecast(&study, &found);
        Some(RtcpAnswer { study, found, forecast, files })
    }
}

fn refuse(study: &RtcpStudy, error: &FitError, problems: &mut Diagnostics) {
    let (place, hint) = match error {
        FitError::Outside { row, .. } => (
            place_of(study, *row),
            "errors = \"none\" leaves out what the machine file states besides the centres",
        ),
        _ => {
            let file = study.path.display().to_string();
            (Place::whole(&file), "readings at turned poses, with the right units")
        }
    };
    problems.error("no-result", place, error.to_string(), hint);
}

/// The machine file with the centres that were found.
fn changed_machine(
    files: &Files,
    study: &RtcpStudy,
    found: &Calibration,
    output: &Path,
    problems: &mut Diagnostics,
) -> Option<NewFile> {
    let old = files.text(&study.machine_path, "the machine file", problems)?;
    match machine_file(study, found, &old, &Folder::of(files, output)) {
        Ok(text) => Some(NewFile::of("machine file", output, text)),
        Err(reason) => {
            let hint = "put it beside the machine file if that names tables";
            let place = Place::whole(&output.display().to_string());
            problems.error("unwritable-file", place, reason, hint);
            None
        }
    }
}

impl Answer for RtcpAnswer {
    fn document(&self, problems: &Diagnostics) -> Value {
        with_diagnostics(&report::RtcpDocument::of(&self.shown()), problems)
    }

    fn report(&self) -> Report<'_> {
        report::rtcp_report(&self.shown())
    }

    fn is_yes(&self) -> bool {
        self.found.is_good()
    }

    fn files(&mut self) -> Vec<NewFile> {
        std::mem::take(&mut self.files)
    }
}
