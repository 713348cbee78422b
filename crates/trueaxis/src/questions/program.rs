//! How is a program written so that the actual tool goes where it says?

use super::workpiece::{machine_or_part, on_top};
use super::{
    Answer, Content, MachineChoice, NewFile, Question, Tell, named_control, with_diagnostics,
};
use crate::files::output::Output;
use crate::report;
use serde_json::Value;
use std::path::{Path, PathBuf};
use trueaxis_correct::compensate::program::{
    CorrectionLimit, Increments, MARK, ProgramOptions, Rewritten, compensate_program_with,
};
use trueaxis_correct::report::ProgramReport;
use trueaxis_input::{Diagnostics, Dimension, Files, Place, parse_quantity};
use trueaxis_motion::{Job, Options, ProgramFiles};
use trueaxis_report::Report;

/// An NC program rewritten for the actual machine. Quantities are as typed, with their units.
#[derive(Debug, Clone)]
pub struct CompensateProgram {
    /// The machine.
    pub machine: MachineChoice,
    /// The NC program.
    pub program: PathBuf,
    /// Where the compensated program goes.
    pub output: PathBuf,
    /// Work offsets and tools; PROGRAM.setup.toml if none is named and it is there.
    pub setup: Option<PathBuf>,
    /// The control of the program, by its name.
    pub control: Option<String>,
    /// Whether loops, subprograms and computed numbers become one flat program first.
    pub flat: bool,
    /// Whether only the tip is corrected, with the linear axes.
    pub position_only: bool,
    /// How far the tip may be missed between the ends of blocks.
    pub residual: String,
    /// How far the tool axis may be missed there; 10 µrad where the machine can turn the tool.
    pub residual_axis: Option<String>,
    /// Whether a program that the proof speaks against is written, marked, under another name.
    pub keep_unproved: bool,
    /// The least increment of linear axes.
    pub increment: String,
    /// The least increment of rotary axes.
    pub increment_deg: String,
    /// Whether numbers are written in full double precision instead.
    pub no_rounding: bool,
    /// A larger correction of the tip is refused.
    pub limit: String,
    /// A larger correction of the tool axis is refused.
    pub limit_axis: String,
    /// Whether the machine alone is compensated, though the temperature of the workpiece is unknown.
    pub machine_only: bool,
}

/// A program rewritten.
pub struct ProgramAnswer {
    job: Job,
    program: String,
    output: Option<PathBuf>,
    shown_output: String,
    options: ProgramOptions,
    /// The program and its proof.
    pub rewritten: Rewritten,
    /// What it can cost that the temperature of the workpiece is not known.
    price: Option<String>,
}

impl CompensateProgram {
    fn options(&self, problems: &mut Diagnostics) -> Option<ProgramOptions> {
        let mut read = |name: &str, text: &str, dimension, (low, high): (f64, f64), hint: &str| {
            let value = parse_quantity(text, dimension).ok().filter(|v| (low..=high).contains(v));
            if value.is_none() {
                let message = format!("`{text}` cannot be used here");
                problems.error("bad-number", Place::whole(name), message, hint);
            }
            value
        };
        let (length, angle) = (Dimension::Length, Dimension::Angle);
        let residual_mm =
            read("--residual", &self.residual, length, (1e-6, 1.0), "such as \"1 um\"");
        let residual_rad = read(
            "--residual-axis",
            self.residual_axis.as_deref().unwrap_or("10 urad"),
            angle,
            (1e-8, 0.1),
            "such as \"10 urad\"",
        );
        let linear_mm =
            read("--increment", &self.increment, length, (1e-9, 0.1), "such as \"1 um\"");
        let turn = (1e-12, 0.02);
        let rotary =
            read("--increment-deg", &self.increment_deg, angle, turn, "such as \"0.0001 deg\"");
        let tip_mm = read("--limit", &self.limit, length, (1e-6, 100.0), "such as \"1 mm\"");
        let axis_rad =
            read("--limit-axis", &self.limit_axis, angle, (1e-8, 0.1), "such as \"1 mrad\"");
        let increments = Increments { linear_mm: linear_mm?, rotary_deg: rotary?.to_degrees() };
        Some(ProgramOptions {
            position_only: self.position_only,
            residual_mm: residual_mm?,
            residual_rad: residual_rad?,
            residual_axis_asked: self.residual_axis.is_some(),
            increments: (!self.no_rounding).then_some(increments),
            limit: CorrectionLimit { tip_mm: tip_mm?, axis_rad: axis_rad? },
            flat: self.flat,
            pose_by_pose: false,
            mark: String::new(),
        })
    }

    fn job(&self, files: &Files, problems: &mut Diagnostics) -> Option<(Job, Option<String>)> {
        let machine = self.machine.read(files, problems)?;
        let only = self.machine_only;
        let (machine, price) = machine_or_part(machine, &self.machine, files, only, problems)?;
        let control = match &self.control {
            None => None,
            Some(name) => Some(named_control(name, problems)?),
        };
        let setup = self.setup.as_deref();
        let program = ProgramFiles { files, program: &self.program, text: None, setup, control };
        Some((Job::read(machine, &program, Options::default(), problems)?, price))
    }

    /// Machine, its file and this version, for the heading of the program.
    fn mark(&self, files: &Files, machine: &str) -> String {
        let hash = files.read(&self.machine.file).map_or(0, |bytes| fnv1a(&bytes));
        format!("FOR {machine} FILE {hash:016x} BY TRUEAXIS {}", crate::VERSION)
    }
}

/// The name of a program that the proof speaks against: `part.unproved.nc` for `part.nc`.
fn unproved(output: &Path) -> PathBuf {
    let extension =
        output.extension().map_or(String::new(), |e| format!(".{}", e.to_string_lossy()));
    output.with_extension(format!("unproved{extension}"))
}

/// The heading says that the program is not proved.
fn marked(text: &[u8]) -> Vec<u8> {
    let at = text.windows(MARK.len()).position(|w| w.eq_ignore_ascii_case(MARK.as_bytes()));
    let end = at.map_or(0, |at| at + MARK.len());
    [&text[..end], b" NOT PROVED", &text[end..]].concat()
}

/// Tells one machine file from another; no secret depends on it.
fn fnv1a(bytes: &[u8]) -> u64 {
    let step = |hash: u64, byte: &u8| (hash ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3);
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, step)
}

impl Question for CompensateProgram {
    type Input = (Job, ProgramOptions, Option<String>);
    type Answer = ProgramAnswer;
    const PROGRESS: &'static str = "Compensation";

    fn read(&self, files: &Files, problems: &mut Diagnostics) -> Option<Self::Input> {
        let options = self.options(problems);
        let job = self.job(files, problems);
        let ((job, price), options) = (job?, options?);
        let mut mark = self.mark(files, job.machine.name());
        if price.is_some() {
            mark += " MACHINE ONLY NOT FOR A PART";
        }
        Some((job, ProgramOptions { mark, ..options }, price))
    }

    fn outputs(&self, _: Option<&Self::Input>) -> Vec<Output> {
        let unproved = self.keep_unproved.then(|| Output::file("--output", unproved(&self.output)));
        [Output::file("--output", &self.output)].into_iter().chain(unproved).collect()
    }

    fn answer(
        &self,
        (job, options, price): Self::Input,
        progress: Tell<'_>,
        problems: &mut Diagnostics,
    ) -> Option<ProgramAnswer> {
        let (machine, program, setup) = (&job.machine, &job.program, &job.setup);
        let done = compensate_program_with(machine, program, setup, &options, progress);
        let rewritten = problems.keep(done)?;
        problems.append(rewritten.unproved.clone());
        let output = match (rewritten.is_proved(), self.keep_unproved) {
            (true, _) => Some(self.output.clone()),
            (false, keep) => keep.then(|| unproved(&self.output)),
        };
        let program = self.program.display().to_string();
        let shown_output =
            output.as_ref().map_or("no file".to_owned(), |path| path.display().to_string());
        Some(ProgramAnswer { job, program, output, shown_output, options, rewritten, price })
    }
}

impl ProgramAnswer {
    fn shown(&self) -> ProgramReport<'_> {
        ProgramReport {
            machine: &self.job.machine,
            program: &self.program,
            output: &self.shown_output,
            options: &self.options,
            rewritten: &self.rewritten,
        }
    }
}

impl Answer for ProgramAnswer {
    fn document(&self, problems: &Diagnostics) -> Value {
        with_diagnostics(&report::ProgramDocument::of(&self.shown()), problems)
    }

    fn report(&self) -> Report<'_> {
        on_top(report::program_report(&self.shown()), self.price.as_deref())
    }

    fn is_yes(&self) -> bool {
        self.rewritten.is_proved()
    }

    fn files(&mut self) -> Vec<NewFile> {
        let Some(path) = &self.output else { return Vec::new() };
        // Nothing after this asks for the text: of a large program there is one.
        let text = std::mem::take(&mut self.rewritten.text);
        let content = if self.is_yes() { text } else { marked(&text).into() };
        vec![NewFile { name: "program", path: path.clone(), content: Content::Bytes(content) }]
    }
}
