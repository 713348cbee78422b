//! `trueaxis post`: cutter locations into an NC program.

use crate::arguments::{MachineArguments, control};
use crate::output::{Answer, Format, Outcome, report, show, tell};
use crate::report_file::unusable;
use clap::{Args, ValueEnum};
use std::path::{Path, PathBuf};
use trueaxis::cl::{ClFile, Reading};
use trueaxis::compensate::post::{FeedRule, PostOptions, Posted, Verification, post, verify};
use trueaxis::files;
use trueaxis::files::disk;
use trueaxis::input::{Diagnostics, Dimension, Place, parse_quantity};
use trueaxis::machine::Machine;
use trueaxis::nc::writer::{Decimals, MOST_DECIMALS, Templates, TipWords};
use trueaxis::report::{PostReport, post_json, post_report};

/// The cutter locations, the machine and the control.
#[derive(Args)]
#[command(after_help = "\
Examples:
  trueaxis post machines/i5-engraver/machine.toml examples/06_compensate/bangle.cls \\
      --control fanuc -o bangle.nc --verify
  trueaxis post machines/xkas2525/machine.toml examples/06_compensate/blade.cls \\
      --control sinumerik --tcp off -o blade.mpf --verify

The points are taken in the workpiece frame of the machine file. With --tcp on the program has tips
and tool axes, without it axis positions from the machine zero, tool length and workpiece included.
Exit status: 0 done, 1 --verify found more than the tolerances (then nothing is written), 2 unusable
input, or the path leaves the travel.")]
pub struct Arguments {
    #[command(flatten)]
    machine: MachineArguments,
    /// The cutter-location file: APT of Creo, NCL, CATIA, SolidWorks CAM, or a table x y z i j k
    #[arg(value_name = "FILE.cls")]
    file: PathBuf,
    /// The control of the program: sinumerik, fanuc, linuxcnc or heidenhain
    #[arg(long, alias = "dialect", value_name = "NAME")]
    control: String,
    /// Whether the control keeps the tool tip on the path (RTCP, TRAORI, TCPM)
    #[arg(long, value_enum, default_value = "on")]
    tcp: OnOff,
    /// How the tool axis is written with --tcp on
    #[arg(long, value_enum, default_value = "angles")]
    orientation: Orientation,
    /// Largest distance between path and program, mm
    #[arg(long, value_name = "MM", default_value = "0.01", allow_negative_numbers = true)]
    tolerance: String,
    /// Largest angle of the tool axis between blocks, deg
    #[arg(long, value_name = "DEG", default_value = "0.05", allow_negative_numbers = true)]
    axis_tolerance: String,
    /// A tool axis nearer to a pole than this angle passes through it, deg
    #[arg(long, value_name = "DEG", default_value = "0", allow_negative_numbers = true)]
    pole_tolerance: String,
    /// How feeds are written
    #[arg(long, value_enum, default_value = "tip")]
    feed_mode: FeedMode,
    /// Feed of the tip where the file has none, mm/min
    #[arg(long, value_name = "MM_PER_MIN", allow_negative_numbers = true)]
    feed: Option<String>,
    /// Retraction of the tool along its axis before a reorientation, mm
    #[arg(long, value_name = "MM", default_value = "50", allow_negative_numbers = true)]
    retract: String,
    /// The unit of the file, in place of the one it states
    #[arg(long, value_enum)]
    units: Option<Units>,
    /// Decimals of mm and of degrees
    #[arg(long, value_name = "MM,DEG", default_value = "4,5")]
    decimals: String,
    /// Start, tool call and end of programs (Jinja); without it those of the control
    #[arg(long, value_name = "FILE.j2")]
    template: Option<PathBuf>,
    /// Print the template of the control, to be edited, and exit
    #[arg(long)]
    show_template: bool,
    /// Number of the program
    #[arg(long, value_name = "N", default_value = "1")]
    number: u32,
    /// Write the program to this file
    #[arg(short, long, value_name = "FILE", required_unless_present = "show_template")]
    output: Option<PathBuf>,
    /// Read the program back, simulate it, and show the largest deviations from the file
    #[arg(long)]
    verify: bool,
    /// Output as text or as one JSON document
    #[arg(long, value_enum, default_value = "text")]
    format: Format,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum OnOff {
    /// The program has tips
    On,
    /// The program has axis positions
    Off,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Orientation {
    /// The rotary axes
    Angles,
    /// The tool axis: I J K, A3 B3 C3, TX TY TZ
    Vectors,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum FeedMode {
    /// mm/min, so that the tip has the feed of the file
    Tip,
    /// Inverse time, G93
    InverseTime,
    /// As tip, but no axis faster than it can
    AxisLimit,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Units {
    /// Millimetres
    Mm,
    /// Inches
    Inch,
}

pub fn run(arguments: &Arguments) -> Outcome {
    if arguments.show_template {
        let mut problems = Diagnostics::new();
        let control = control(&arguments.control, &mut problems);
        if report(problems) {
            return Outcome::Unusable;
        }
        let text = trueaxis::nc::writer::BUILT_IN.iter().find(|(c, _)| Some(*c) == control);
        return show(&Answer::Text(text.map_or(String::new(), |(_, t)| (*t).to_owned())));
    }
    let mut problems = Diagnostics::new();
    let machine = arguments.machine.read(&mut problems);
    let file = arguments.read_file(&mut problems);
    let options = arguments.options(&mut problems);
    if arguments.machine.has_temperatures() {
        let message = "a program is made for the nominal machine".to_owned();
        let place = Place::whole("--temperature");
        problems.error("no-temperature", place, message, "leave it out");
    }
    if report(problems) {
        return Outcome::Unusable;
    }
    let (Some(machine), Some(file), Some(options)) = (machine, file, options) else {
        return Outcome::Unusable;
    };
    let (posted, problems) = post(&machine, &file, &options);
    if report(problems) {
        return Outcome::Unusable;
    }
    let Some(posted) = posted else { return Outcome::Unusable };
    let proof = arguments.verify.then(|| verify(&machine, &posted, &options));
    arguments.finish(&machine, &file, &options, &posted, proof.as_ref())
}

impl Arguments {
    fn read_file(&self, problems: &mut Diagnostics) -> Option<ClFile> {
        let text = disk().bytes(&self.file, "a cutter-location file", problems)?;
        let reading = Reading { inches: self.units.map(|u| u == Units::Inch) };
        let (file, found) = ClFile::read(&self.file.display().to_string(), text, &reading);
        problems.append(found);
        Some(file)
    }

    fn options(&self, problems: &mut Diagnostics) -> Option<PostOptions> {
        let mut number = |name: &str, text: &str, low: f64| {
            let value = parse_quantity(text, Dimension::Ratio).ok();
            let value = value.filter(|v| (low..1e6).contains(v));
            if value.is_none() {
                let message = format!("`{text}` is not a possible value");
                problems.error("bad-number", Place::whole(name), message, "such as 0.01");
            }
            value
        };
        let tolerance_mm = number("--tolerance", &self.tolerance, 1e-6);
        let axis_tolerance = number("--axis-tolerance", &self.axis_tolerance, 1e-6);
        let pole = number("--pole-tolerance", &self.pole_tolerance, 0.0);
        let retract_mm = number("--retract", &self.retract, 0.0);
        let feed = self.feed.as_ref().map(|text| number("--feed", text, 1e-3));
        let digits: Option<Vec<u8>> =
            self.decimals.split(',').map(|t| t.trim().parse().ok()).collect();
        let digits = digits.filter(|d| d.len() == 2 && d.iter().all(|d| *d <= MOST_DECIMALS));
        if digits.is_none() {
            let message = format!("`{}` are not two numbers of decimals", self.decimals);
            problems.error("bad-number", Place::whole("--decimals"), message, "such as 3,4");
        }
        let templates = match &self.template {
            Some(path) => Some(read_template(path, problems)?),
            None => None,
        };
        let digits = digits?;
        let words = match self.orientation {
            Orientation::Angles => TipWords::Angles,
            Orientation::Vectors => TipWords::Vectors,
        };
        let name = self.output.as_ref().and_then(|p| p.file_stem());
        Some(PostOptions {
            tip_words: (self.tcp == OnOff::On).then_some(words),
            tolerance_mm: tolerance_mm?,
            axis_tolerance_rad: axis_tolerance?.to_radians(),
            pole_rad: pole?.to_radians(),
            feed: match self.feed_mode {
                FeedMode::Tip => FeedRule::Tip,
                FeedMode::InverseTime => FeedRule::InverseTime,
                FeedMode::AxisLimit => FeedRule::AxisLimit,
            },
            usual_feed_mm_per_min: match feed {
                Some(value) => Some(value?),
                None => None,
            },
            retract_mm: retract_mm?,
            decimals: Decimals { linear: digits[0], angle: digits[1], ..Decimals::default() },
            templates,
            name: name.map_or_else(|| "PROGRAM".into(), |n| n.to_string_lossy().into_owned()),
            number: self.number,
            ..PostOptions::of(control(&self.control, problems)?)
        })
    }

    fn finish(
        &self,
        machine: &Machine,
        file: &ClFile,
        options: &PostOptions,
        posted: &Posted,
        verification: Option<&Verification>,
    ) -> Outcome {
        let Some(output) = &self.output else { return Outcome::Unusable };
        let report = PostReport { machine, file, options, posted, verification, output };
        let sound = report.is_sound();
        if sound {
            if let Err(error) = files::write(output, &posted.text) {
                let message = format!("cannot be written: {error}");
                let shown = output.display().to_string();
                return unusable("unwritable-file", &shown, &message, "name another file");
            }
        } else {
            tell("the program is not within the tolerances; nothing was written");
        }
        let answer = match self.format {
            Format::Json => Answer::Json(post_json(&report)),
            Format::Text => Answer::Text(post_report(&report).text()),
        };
        match show(&answer) {
            Outcome::Done if !sound => Outcome::No,
            shown => shown,
        }
    }
}

fn read_template(path: &Path, problems: &mut Diagnostics) -> Option<Templates> {
    let text = disk().text(path, "a template of programs", problems)?;
    let refuse = |error: trueaxis::nc::writer::WriteError| {
        let place = Place::whole(&path.display().to_string());
        let hint = "--show-template prints one that works";
        problems.error("bad-template", place, error.to_string(), hint);
    };
    Templates::parse(&text).map_err(refuse).ok()
}
