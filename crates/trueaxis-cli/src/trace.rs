//! `trueaxis trace`: every stage of the simulation for one block.

use crate::arguments::MachineArguments;
use crate::door::DoorArguments;
use crate::output::Outcome;
use crate::simulate::ProgramArguments;
use clap::Args;
use trueaxis::questions::TraceBlock;

/// The block to trace.
#[derive(Args)]
#[command(after_help = "\
Examples:
  trueaxis trace machines/wyxzcat-gantry/machine.toml examples/02_simulate/impeller-840d.mpf --block 120
  trueaxis trace MACHINE.toml PART.ngc --block 42 --format json

--block is the block number N; if there is no such block, the line number. Exit status: 0 done, 2 unusable
input.")]
pub struct Arguments {
    #[command(flatten)]
    machine: MachineArguments,
    #[command(flatten)]
    program: ProgramArguments,
    /// The block: its number N, else its line
    #[arg(long, value_name = "N")]
    block: usize,
    #[command(flatten)]
    door: DoorArguments,
}

pub fn run(arguments: Arguments) -> Outcome {
    let Arguments { machine, program, block, door } = arguments;
    let (machine, program) = program.choices(machine);
    door.door().ask(&TraceBlock { machine, program, block })
}
