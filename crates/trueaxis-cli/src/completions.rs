//! `trueaxis completions`: what a shell completes when Tab is pressed.

use crate::output::{Outcome, show_by};
use clap::Args;
use clap_complete::Shell;

/// For which shell.
#[derive(Args)]
#[command(after_help = "\
Examples:
  trueaxis completions bash > ~/.local/share/bash-completion/completions/trueaxis
  trueaxis completions zsh > ~/.zfunc/_trueaxis
  trueaxis completions fish > ~/.config/fish/completions/trueaxis.fish
  trueaxis completions powershell >> $PROFILE

Prints a script that the shell loads; the package for Debian has those of bash, zsh and fish.
Exit status: 0 printed, 2 unknown shell.")]
pub struct Arguments {
    /// The shell
    #[arg(value_enum)]
    shell: Shell,
}

pub fn run(arguments: &Arguments, mut command: clap::Command) -> Outcome {
    let mut script = Vec::new();
    clap_complete::generate(arguments.shell, &mut command, "trueaxis", &mut script);
    show_by(|out| out.write_all(&script))
}
