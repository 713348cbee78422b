//! `trueaxis compensate program`: an NC program rewritten for the actual machine.

use crate::arguments::{MachineArguments, control};
use crate::output::{Answer, Format, Outcome, diagnostic_json, report, show};
use crate::report_file::{REPORT, Written, may_write, unusable, write_report};
use clap::Args;
use std::path::PathBuf;
use trueaxis::compensate::program::{
    CorrectionLimit, Increments, MARK, ProgramOptions, compensate_program,
};
use trueaxis::files;
use trueaxis::files::disk;
use trueaxis::input::{Diagnostics, Dimension, Place, parse_quantity};
use trueaxis::machine::Machine;
use trueaxis::report::{ProgramReport, program_html, program_json, program_text};
use trueaxis::simulate::{Job, Options, ProgramFiles};

/// The machine, the program and what may be left.
#[derive(Args)]
#[command(after_help = "\
Examples:
  trueaxis compensate program machines/xkas2525/machine.toml examples/06_compensate/frustum.mpf \\
      -o frustum-comp.mpf --report r.html
  trueaxis compensate program MACHINE.toml PART.nc --setup PART.setup.toml -o PART-comp.nc \\
      --position-only --residual \"2 um\" --no-rounding --format json
  trueaxis compensate program MACHINE.toml LOOPS.ngc --flat -o LOOPS-comp.ngc

Words, comments and blocks that need no change stay as they are, byte by byte. The written program is
read back and simulated on the machine as it is before it is written. Loops, subprograms and computed
coordinates are refused with their line; --flat unrolls them (the lines of the report are then those of
the unrolled program). Cycles are refused. Exit status: 0 done, 2 unusable input or a block
that cannot be corrected; then nothing is written.")]
pub struct ProgramArguments {
    #[command(flatten)]
    machine: MachineArguments,
    /// The NC program
    #[arg(value_name = "PROGRAM")]
    program: PathBuf,
    /// Where the compensated program goes
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// Work offsets and tools; without it PROGRAM.setup.toml if it is there
    #[arg(long, value_name = "SETUP.toml")]
    setup: Option<PathBuf>,
    /// Whose program it is: sinumerik, fanuc, linuxcnc or heidenhain
    #[arg(long, value_name = "NAME")]
    control: Option<String>,
    /// Unroll the program first: loops, subprograms, repeated parts and computed numbers become one
    /// flat program, which is compensated
    #[arg(long)]
    flat: bool,
    /// Only the tip, with the linear axes
    #[arg(long)]
    position_only: bool,
    /// How far the tip may be missed between the ends of blocks
    #[arg(long, value_name = "\"1 um\"", default_value = "1 um", allow_negative_numbers = true)]
    residual: String,
    /// How far the tool axis may be missed there
    #[arg(
        long,
        value_name = "\"10 urad\"",
        default_value = "10 urad",
        allow_negative_numbers = true
    )]
    residual_axis: String,
    /// The least increment of linear axes
    #[arg(long, value_name = "\"1 um\"", default_value = "1 um", allow_negative_numbers = true)]
    increment: String,
    /// The least increment of rotary axes
    #[arg(
        long,
        value_name = "\"0.0001 deg\"",
        default_value = "0.0001 deg",
        allow_negative_numbers = true
    )]
    increment_deg: String,
    /// Numbers in full double precision instead
    #[arg(long, conflicts_with_all = ["increment", "increment_deg"])]
    no_rounding: bool,
    /// A larger correction of the tip is refused
    #[arg(long, value_name = "\"1 mm\"", default_value = "1 mm", allow_negative_numbers = true)]
    limit: String,
    /// A larger correction of the tool axis is refused
    #[arg(
        long,
        value_name = "\"1 mrad\"",
        default_value = "1 mrad",
        allow_negative_numbers = true
    )]
    limit_axis: String,
    /// Where the HTML report goes; without it none is written
    #[arg(long, value_name = "FILE")]
    report: Option<PathBuf>,
    /// For people or for programs
    #[arg(long, value_enum, default_value = "text")]
    format: Format,
}

/// What `--output` may replace: nothing that is there and not empty.
const PROGRAM: Written =
    Written { argument: "--output", what: "a compensated program of ours", begins: &[] };

pub fn run(arguments: &ProgramArguments) -> Outcome {
    arguments.run().unwrap_or_else(|outcome| outcome)
}

impl ProgramArguments {
    fn run(&self) -> Result<Outcome, Outcome> {
        let mut problems = Diagnostics::new();
        let machine = self.machine.read(&mut problems);
        let options = self.options(&mut problems);
        let job = machine.and_then(|m| self.job(m, &mut problems));
        self.may_write(&mut problems);
        let (Some(job), Some(options), false) = (job, options, problems.has_errors()) else {
            report(problems);
            return Err(Outcome::Unusable);
        };
        let options = ProgramOptions { mark: self.mark(&job.machine), ..options };
        let (rewritten, found) =
            compensate_program(&job.machine, &job.program, &job.setup, &options);
        problems.append(found);
        let list = problems.clone();
        let failed = report(problems);
        let Some(rewritten) = rewritten.filter(|_| !failed) else { return Err(Outcome::Unusable) };
        let (program, output) =
            (self.program.display().to_string(), self.output.display().to_string());
        let told = ProgramReport {
            machine: &job.machine,
            program: &program,
            output: &output,
            options: &options,
            rewritten: &rewritten,
        };
        files::write(&self.output, &rewritten.text).map_err(|e| {
            let message = format!("cannot be written: {e}");
            unusable("unwritable-file", &output, &message, "name another --output")
        })?;
        if let Some(path) = &self.report {
            write_report(path, Ok(program_html(&told)))?;
        }
        Ok(show(&match self.format {
            Format::Text => Answer::Text(program_text(&told)),
            Format::Json => {
                let mut document = program_json(&told);
                document["diagnostics"] = list.iter().map(diagnostic_json).collect();
                Answer::Json(document)
            }
        }))
    }

    fn job(&self, machine: Machine, problems: &mut Diagnostics) -> Option<Job> {
        let control = match &self.control {
            None => None,
            Some(name) => Some(control(name, problems)?),
        };
        let files = ProgramFiles {
            files: &disk(),
            program: &self.program,
            text: None,
            setup: self.setup.as_deref(),
            control,
        };
        Job::read(machine, &files, Options::default(), problems)
    }

    fn options(&self, problems: &mut Diagnostics) -> Option<ProgramOptions> {
        let mut read = |name: &str, text: &str, dimension, (low, high): (f64, f64), hint: &str| {
            let value = parse_quantity(text, dimension).ok().filter(|v| (low..=high).contains(v));
            if value.is_none() {
                let message = format!("`{text}` is not of use here");
                problems.error("bad-number", Place::whole(name), message, hint);
            }
            value
        };
        let length = Dimension::Length;
        let angle = Dimension::Angle;
        let residual_mm =
            read("--residual", &self.residual, length, (1e-6, 1.0), "such as \"1 um\"");
        let residual_rad =
            read("--residual-axis", &self.residual_axis, angle, (1e-8, 0.1), "such as \"10 urad\"");
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
            increments: (!self.no_rounding).then_some(increments),
            limit: CorrectionLimit { tip_mm: tip_mm?, axis_rad: axis_rad? },
            flat: self.flat,
            pose_by_pose: false,
            mark: String::new(),
        })
    }

    fn may_write(&self, problems: &mut Diagnostics) {
        if self.output == self.program {
            let place = Place::whole(&self.output.display().to_string());
            let message = "is the program itself".to_owned();
            problems.error("one-file-twice", place, message, "name another --output");
        } else if !is_ours(&self.output) {
            may_write(&self.output, &PROGRAM, problems);
        }
        if let Some(path) = &self.report {
            may_write(path, &REPORT, problems);
            if *path == self.output {
                let place = Place::whole(&path.display().to_string());
                let message = "is named for two outputs".to_owned();
                problems.error("one-file-twice", place, message, "name a file for each");
            }
        }
    }

    /// Machine, its file and this version, for the heading.
    fn mark(&self, machine: &Machine) -> String {
        let path = self.machine.path();
        let hash = files::read_bytes(path).map_or(0, |bytes| fnv1a(&bytes));
        let version = env!("CARGO_PKG_VERSION");
        format!("FOR {} FILE {hash:016x} BY TRUEAXIS {version}", machine.name())
    }
}

/// A compensated program may be made anew.
fn is_ours(path: &std::path::Path) -> bool {
    files::read_bytes(path).is_ok_and(|text| {
        let head = &text[..text.len().min(1 << 14)];
        String::from_utf8_lossy(head).to_ascii_uppercase().contains(MARK)
    })
}

/// Tells one machine file from another; no secret depends on it.
fn fnv1a(bytes: &[u8]) -> u64 {
    let step = |hash: u64, byte: &u8| (hash ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3);
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, step)
}
