//! How are the readings for the rotary centres taken?

use super::{Answer, NewFile, Question, Tell, in_folder, named_control};
use serde::Serialize;
use serde_json::Value;
use std::path::PathBuf;
use trueaxis_calibrate::plan::{extension, file_name};
use trueaxis_input::{Diagnostics, Files, Place};
use trueaxis_nc::Control;
use trueaxis_report::JsonSchema;
use trueaxis_report::{Report, Section, Table, document};
use trueaxis_rtcp::rtcp::program::{off_poses, program};
use trueaxis_rtcp::rtcp::{Purpose, RtcpStudy, read_rtcp};

/// One NC program for each set of readings of an RTCP study.
#[derive(Debug, Clone)]
pub struct RtcpPrograms {
    /// The study: machine, control, poses.
    pub study: PathBuf,
    /// The control of the programs, by its name.
    pub control: String,
    /// The folder of the programs.
    pub output: PathBuf,
}

/// The programs, each read back through the simulation.
#[derive(Debug)]
pub struct RtcpProgramsAnswer {
    programs: Vec<ProgramEntry>,
    files: Vec<NewFile>,
}

/// `trueaxis/identify-rtcp-programs/1`.
#[derive(Debug, Serialize, JsonSchema)]
pub struct RtcpProgramsDocument<'a> {
    /// Which document this is.
    #[schemars(extend("const" = "trueaxis/identify-rtcp-programs/1"))]
    pub schema: &'static str,
    /// The programs.
    pub programs: &'a [ProgramEntry],
}

/// One program.
#[derive(Debug, Serialize, JsonSchema)]
pub struct ProgramEntry {
    /// Its file in the folder.
    pub file: String,
    /// The set of readings.
    pub set: String,
    /// How far its poses, read back, lie from those of the set, µm.
    pub off_poses_um: f64,
}

impl Question for RtcpPrograms {
    type Input = (RtcpStudy, Control);
    type Answer = RtcpProgramsAnswer;

    fn read(&self, files: &Files, problems: &mut Diagnostics) -> Option<Self::Input> {
        let study = problems.keep(read_rtcp(files, &self.study, Purpose::Programs));
        let control = named_control(&self.control, problems);
        study.zip(control)
    }

    fn answer(
        &self,
        (study, control): Self::Input,
        _: Tell<'_>,
        problems: &mut Diagnostics,
    ) -> Option<RtcpProgramsAnswer> {
        let (mut programs, mut files) = (Vec::new(), Vec::new());
        for set in &study.sets {
            let file = format!("{}.{}", file_name(&set.name, files.len() + 1), extension(control));
            let place = Place::whole(&file);
            match program(&study, set, control) {
                Ok(text) => {
                    let off_mm = off_poses(&study, set, &text, control);
                    if !off_mm.is_finite() {
                        let message = "the program does not reach its poses".to_owned();
                        let hint = "another --control, or axes within their travel";
                        problems.error("unsound-program", place, message, hint);
                    }
                    files.push((file.clone(), text));
                    let (set, off_poses_um) = (set.name.clone(), 1e3 * off_mm);
                    programs.push(ProgramEntry { file, set, off_poses_um });
                }
                Err(reason) => {
                    let hint = "another --control";
                    problems.error("no-program", place, reason.to_string(), hint);
                }
            }
        }
        Some(RtcpProgramsAnswer { programs, files: in_folder(Some(&self.output), files) })
    }
}

impl Answer for RtcpProgramsAnswer {
    fn document(&self, _: &Diagnostics) -> Value {
        let (schema, programs) = ("trueaxis/identify-rtcp-programs/1", &self.programs[..]);
        document(&RtcpProgramsDocument { schema, programs })
    }

    fn report(&self) -> Report<'_> {
        let rows = self
            .programs
            .iter()
            .map(|p| [p.file.clone(), p.set.clone(), format!("{:.2}", p.off_poses_um)]);
        let table = Table::new(["file", "readings", "off its poses, read back, µm"]).rows(rows);
        Report::new("Programs of the readings").section(Section::new("").table(table))
    }

    fn files(&mut self) -> Vec<NewFile> {
        std::mem::take(&mut self.files)
    }
}
