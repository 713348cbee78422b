//! `trueaxis simulate`: an NC program on the actual machine.

use crate::arguments::{LogStart, MachineArguments};
use crate::door::DoorArguments;
use crate::output::Outcome;
use clap::Args;
use std::path::PathBuf;
use trueaxis::questions::{MachineChoice, ProgramChoice, Simulate};

/// The program to simulate.
#[derive(Args)]
#[command(after_help = "\
Examples:
  trueaxis simulate machines/wyxzcat-gantry/machine.toml examples/02_simulate/impeller-840d.mpf
  trueaxis simulate machines/i5-engraver/machine.toml examples/02_simulate/ring-fanuc.nc --format json
  trueaxis simulate machines/i5-engraver/machine.toml examples/02_simulate/ring-fanuc.nc --stock
  trueaxis simulate MACHINE.toml PART.ngc --setup PART.setup.toml --path path.csv --chord 0.002
  trueaxis simulate MACHINE.toml PART.mpf --temperature-log hall.csv --log-start \"2 h\"

With --log-start every point of the path is evaluated at the temperatures of its own time (within
0.01 K), and the summary shows the drift: the change of the deviation since the start. A program
that is longer than its log is an error. Without --setup work offsets and tool lengths are 0; a file
PROGRAM.setup.toml in the folder of the program is used automatically. Exit status: 0 no critical
issue, 1 a collision, a rapid move through stock, a gouge, an axis beyond its travel, or motion that is not
executed (see the diagnostics), 2 unusable input; then nothing is written.")]
pub struct Arguments {
    #[command(flatten)]
    machine: MachineArguments,
    #[command(flatten)]
    program: ProgramArguments,
    /// Write every point of the path to this file: CSV, or Parquet if its name ends in .parquet
    #[arg(long, value_name = "FILE")]
    path: Option<PathBuf>,
    /// Write the nominal and actual pose of every body at every point of the path to this CSV file
    #[arg(long, value_name = "FILE.csv")]
    bodies: Option<PathBuf>,
    /// Without the collision check
    #[arg(long)]
    no_collisions: bool,
    /// Cut the [stock] of the set-up: removed volume by block, rapid moves and shanks in what remains
    /// of it, gouges of its [part]; a [stock] with a resolution always is
    #[arg(long)]
    stock: bool,
    /// List errors of the program and continue after them
    #[arg(long)]
    keep_going: bool,
    #[command(flatten)]
    door: DoorArguments,
}

/// The program, its set-up, and the division of its moves.
#[derive(Args)]
pub struct ProgramArguments {
    #[command(flatten)]
    pub log: LogStart,
    /// The NC program
    #[arg(value_name = "PROGRAM")]
    program: PathBuf,
    /// Work offsets, tools, stock, fixtures
    #[arg(long, value_name = "SETUP.toml")]
    setup: Option<PathBuf>,
    /// The control of the program: sinumerik, fanuc, haas, linuxcnc or heidenhain
    #[arg(long, value_name = "NAME")]
    control: Option<String>,
    /// Largest distance between path and chord, mm
    #[arg(long, value_name = "MM", default_value = "0.005", allow_negative_numbers = true)]
    chord: String,
    /// Longest piece of a move, mm (λ of Jiang et al.)
    #[arg(long, value_name = "MM", default_value = "10", allow_negative_numbers = true)]
    spacing: String,
    /// Largest rotation in a piece, deg (φ of Jiang et al.)
    #[arg(long, value_name = "DEG", default_value = "1", allow_negative_numbers = true)]
    angle: String,
    /// Divide moves by spacing and angle alone, as Jiang et al. do
    #[arg(long)]
    by_count: bool,
    /// Do not divide moves, except circles
    #[arg(long, conflicts_with = "by_count")]
    no_densify: bool,
    /// Corner rounding tolerance where the program states none, mm
    #[arg(long, value_name = "MM", default_value = "0.01", allow_negative_numbers = true)]
    rounding: String,
    /// Time each block by the three phases of Jiang et al., with this mean acceleration, mm/s^2,
    /// and exact stop, instead of looking ahead within the limits of the axes
    #[arg(long, value_name = "MM_PER_S2", allow_negative_numbers = true)]
    three_phase: Option<String>,
    /// Backward jumps and calls after which the program counts as an endless loop; so do twice as many points of
    /// the path in its loops
    #[arg(long, value_name = "N", default_value = "1000000")]
    most_jumps: u64,
    /// Leave out optional blocks (/), as with the switch of the control on; they are executed otherwise
    #[arg(long)]
    without_optional: bool,
    /// With --three-phase: the velocity changes smoothly
    #[arg(long, requires = "three_phase")]
    smooth: bool,
}

impl ProgramArguments {
    /// Machine and program as the questions of the library take them.
    pub fn choices(self, machine: MachineArguments) -> (MachineChoice, ProgramChoice) {
        let program = ProgramChoice {
            program: self.program,
            setup: self.setup,
            control: self.control,
            chord: self.chord,
            spacing: self.spacing,
            angle: self.angle,
            by_count: self.by_count,
            no_densify: self.no_densify,
            rounding: self.rounding,
            three_phase: self.three_phase,
            smooth: self.smooth,
            most_jumps: self.most_jumps,
            without_optional: self.without_optional,
            ..ProgramChoice::default()
        };
        (machine.choice(Some(&self.log)), program)
    }
}

pub fn run(arguments: Arguments) -> Outcome {
    let Arguments { machine, program, path, bodies, no_collisions, stock, keep_going, door } =
        arguments;
    let (machine, program) = program.choices(machine);
    let program = ProgramChoice { keep_going, ..program };
    let pictures = door.report.is_some();
    let question = Simulate { machine, program, path, bodies, pictures, no_collisions, stock };
    door.door().ask(&question)
}
