//! `trueaxis manual`: the help of every command as pages for `man`.

use crate::output::{Outcome, report, show_by, tell};
use clap::Args;
use clap_mangen::Man;
use std::path::PathBuf;
use trueaxis::files::output::may_fill;
use trueaxis::files::write_folder;
use trueaxis::input::Diagnostics;

/// Which page, or where all of them go.
#[derive(Args)]
#[command(after_help = "\
Examples:
  trueaxis manual | man -l -
  trueaxis manual compensate program | man -l -
  trueaxis manual -o man1

Exit status: 0 printed or written, 2 no such command, or the folder is not empty.")]
pub struct Arguments {
    /// The command, such as `pose` or `compensate program`; without it the page of the whole program
    #[arg(value_name = "COMMAND", conflicts_with = "output")]
    command: Vec<String>,
    /// Write the pages of all commands into this folder, which must be new or empty
    #[arg(short, value_name = "FOLDER")]
    output: Option<PathBuf>,
}

pub fn run(arguments: &Arguments, mut program: clap::Command) -> Outcome {
    program.build();
    let pages = pages(&program, "");
    if let Some(folder) = &arguments.output {
        let mut problems = Diagnostics::new();
        may_fill(folder, &mut problems);
        if report(problems) {
            return Outcome::Unusable;
        }
        let count = pages.len();
        if let Err(error) = write_folder(folder, &pages) {
            tell(&format!("error[unwritable-folder]: {}: {error}", folder.display()));
            return Outcome::Unusable;
        }
        tell(&format!("manual: {count} pages in {}", folder.display()));
        return Outcome::Done;
    }
    let words = ["trueaxis"].into_iter().chain(arguments.command.iter().map(String::as_str));
    let wanted = format!("{}.1", words.collect::<Vec<_>>().join("-"));
    match pages.iter().find(|(name, _)| *name == wanted) {
        Some((_, page)) => show_by(|out| out.write_all(page.as_bytes())),
        None => {
            let command = arguments.command.join(" ");
            tell(&format!(
                "error: there is no command `{command}`\n  hint: trueaxis --help lists them"
            ));
            Outcome::Unusable
        }
    }
}

/// The page of a command and of all within it, with the names of their files.
fn pages(command: &clap::Command, before: &str) -> Vec<(String, String)> {
    let name = format!("{before}{}", command.get_name());
    let mut all = vec![(format!("{name}.1"), page(command))];
    let within = command.get_subcommands().filter(|c| c.get_name() != "help" && !c.is_hide_set());
    all.extend(within.flat_map(|c| pages(c, &format!("{name}-"))));
    all
}

/// What stands below the options in `--help` has lines of its own, which `man` must not fill.
fn page(command: &clap::Command) -> String {
    let version = format!("trueaxis {}", trueaxis::VERSION);
    let mut page = Vec::new();
    // A vector takes every byte.
    let _ = Man::new(command.clone()).source(version).render(&mut page);
    let page = String::from_utf8_lossy(&page).into_owned();
    let Some((before, extra)) = page.split_once(".SH EXTRA\n") else { return page };
    let (extra, after) = match extra.split_once("\n.SH ") {
        Some((extra, after)) => (extra, format!("\n.SH {after}")),
        None => (extra, String::new()),
    };
    format!("{before}.SH EXAMPLES\n.nf\n{extra}\n.fi{after}")
}
