//! `trueaxis post`: cutter locations into an NC program.

use crate::arguments::MachineArguments;
use crate::door::DoorArguments;
use crate::output::{Answer, Outcome, finish};
use clap::{Args, ValueEnum};
use std::path::PathBuf;
use trueaxis::input::Diagnostics;
use trueaxis::post::FeedRule;
use trueaxis::questions::{Post, template};
use trueaxis::writer::TipWords;

/// The cutter locations, the machine and the control.
#[derive(Args)]
#[command(after_help = "\
Examples:
  trueaxis post machines/i5-engraver/machine.toml examples/06_compensate/bangle.cls \\
      --control fanuc -o bangle.nc --verify
  trueaxis post machines/xkas2525/machine.toml examples/06_compensate/blade.cls \\
      --control sinumerik --tcp off -o blade.mpf --verify
  trueaxis post machines/three-axis-mill/machine.toml examples/06_compensate/plate.cls \\
      --control heidenhain --tcp length -o plate.h --verify

  trueaxis post machines/xkas2525/machine.toml testpieces/nas979-gbt33150.toml \\
      --control sinumerik -o cone.mpf --verify --set-up set-up

A test piece is cut in one turn for each [[condition]] of its file. The points are taken in the workpiece frame of the machine file. With --tcp on and --tcp length the program has
places of the tip from the workpiece zero (G54), with --tcp off positions of the axes from the machine zero, tool
length and workpiece included. Arcs and drilling cycles of the file are written as such where the control has them
in that place (docs/post.md).
Exit status: 0 done, 1 --verify found more than the tolerances (then nothing is written), or words of the file that
can change motion, spindle or coolant are not applied (NOT APPLIED; the program is written), 2 unusable input, or the
path leaves the travel.")]
pub struct Arguments {
    #[command(flatten)]
    machine: MachineArguments,
    /// The cutter-location file: APT of Creo, NCL, CATIA, SolidWorks CAM, a table x y z i j k, or a test piece (.toml)
    #[arg(value_name = "FILE.cls")]
    file: PathBuf,
    /// The control of the program: sinumerik, fanuc, haas, linuxcnc or heidenhain
    #[arg(long, alias = "dialect", value_name = "NAME")]
    control: String,
    /// What the control compensates, and so what the numbers of the program are
    #[arg(long, value_enum, default_value = "on")]
    tcp: Tcp,
    /// How the tool axis is written with --tcp on
    #[arg(long, value_enum, default_value = "angles")]
    orientation: Orientation,
    /// Write lines for arcs and drilling cycles, too
    #[arg(long)]
    lines_only: bool,
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
    /// Write the programs of the set-up of a test piece, and a file for its readings, into this folder
    #[arg(long, value_name = "FOLDER")]
    set_up: Option<PathBuf>,
    #[command(flatten)]
    door: DoorArguments,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Tcp {
    /// The tool tip, in any direction (RTCP, TRAORI, TCPM): positions of the tip
    On,
    /// The tool length alone (G43): positions of the tip, with the rotary axes at 0
    Length,
    /// Nothing: positions of the axes from the machine zero
    Off,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum OnOff {
    /// The program states positions of the tool tip
    On,
    /// The program states positions of the axes
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

pub fn run(arguments: Arguments) -> Outcome {
    let mut problems = Diagnostics::new();
    if arguments.show_template {
        let text = template(&arguments.control, &mut problems);
        return finish(problems, text.map(|text| Answer::Text(text.to_owned())));
    }
    let Some(output) = arguments.output else { return Outcome::Unusable };
    let words = match arguments.orientation {
        Orientation::Angles => TipWords::Angles,
        Orientation::Vectors => TipWords::Vectors,
    };
    let question = Post {
        machine: arguments.machine.choice(None),
        file: arguments.file,
        control: arguments.control,
        tip_words: match arguments.tcp {
            Tcp::On => Some(words),
            Tcp::Length => Some(TipWords::Length),
            Tcp::Off => None,
        },
        lines_only: arguments.lines_only,
        tolerance: arguments.tolerance,
        axis_tolerance: arguments.axis_tolerance,
        pole_tolerance: arguments.pole_tolerance,
        feed_rule: match arguments.feed_mode {
            FeedMode::Tip => FeedRule::Tip,
            FeedMode::InverseTime => FeedRule::InverseTime,
            FeedMode::AxisLimit => FeedRule::AxisLimit,
        },
        feed: arguments.feed,
        retract: arguments.retract,
        inches: arguments.units.map(|u| u == Units::Inch),
        decimals: arguments.decimals,
        template: arguments.template,
        number: arguments.number,
        output,
        verify: arguments.verify,
        set_up: arguments.set_up,
    };
    arguments.door.door().ask(&question)
}
