//! The command `trueaxis`: one file per command, each belongs to one verb of the loop.
//!
//! Results go to standard output (with `--format json` one document and nothing else), progress
//! and diagnostics to standard error. Exit status: 0 done, 1 the verdict is "no", 2 unusable
//! input or arguments.

mod arguments;
mod check;
mod compensate;
mod completions;
mod door;
mod evaluate;
mod explain;
mod identify;
mod live;
mod manual;
mod measure;
mod new;
mod output;
mod part;
mod plan;
mod pose;
mod post;
mod predict;
mod report_file;
mod schema;
#[cfg(feature = "serve")]
mod serve;
mod simulate;
mod solve;
mod study;
mod trace;
mod verify;

use clap::error::ErrorKind;
use clap::{CommandFactory, Parser, Subcommand};
use output::{Answer, Outcome};
use std::process::ExitCode;

/// TrueAxis computes the actual tool pose of a multi-axis machine tool and its effect on the part
#[derive(Parser)]
#[command(name = "trueaxis", version, max_term_width = 100, arg_required_else_help = true)]
#[command(after_help = "\
Examples:
  trueaxis new my-machine
  trueaxis check machines/xkas2525/machine.toml
  trueaxis pose machines/xkas2525/machine.toml --at \"X=3000 Y=1200 Z=-700 C=-90 A=15\"
  trueaxis solve machines/i5-engraver/machine.toml --tip \"10 20 30\" --axis \"0.3 -0.2 0.93\"
  trueaxis part parts/housing.toml
  trueaxis simulate machines/i5-engraver/machine.toml examples/02_simulate/ring-fanuc.nc
  trueaxis predict examples/03_predict/nas979-on-xkas2525.toml
  trueaxis evaluate iso230-2 examples/07_verify/x-axis-laser.csv --report x.html
  trueaxis compensate values machines/three-axis-mill/machine.toml --axis X --step 50
  trueaxis study examples/09_study/fleet.toml
  trueaxis measure examples/04_plan/probe-ball.toml
  trueaxis verify examples/07_verify/probe-ball.toml
  trueaxis plan examples/04_plan/probe-ball.toml
  trueaxis identify examples/05_identify/probe-ball.toml
  trueaxis post machines/i5-engraver/machine.toml examples/06_compensate/bangle.cls --control fanuc -o bangle.nc --verify
  trueaxis identify expansion examples/05_identify/y-axis-two-temperatures.toml
  trueaxis live examples/08_live/gantry-mock.toml --for 60s
  trueaxis explain table-too-short
  trueaxis schema pose
  trueaxis serve --open

Exit status: 0 done, 1 the verdict is no, 2 unusable input or arguments.")]
struct Command {
    /// Print the licences of everything in this program and in its page
    #[arg(long, exclusive = true)]
    licenses: bool,
    #[command(subcommand)]
    verb: Option<Verb>,
}

/// Made by `scripts/sbom --licenses`.
const LICENSES: &str = include_str!("../licenses.txt");

#[derive(Subcommand)]
enum Verb {
    /// Describe: a new folder with a machine, a part, a program, a study and a campaign to begin with
    New(new::Arguments),
    /// Describe: check a machine file and show what it describes and what is missing
    Check(check::Arguments),
    /// Describe: nominal and actual pose of the tool, and the contribution of every error
    Pose(pose::Arguments),
    /// Describe: what a part file asks for, or a draft of one from a QIF file
    Part(part::Arguments),
    /// Describe: axis positions for a required position and direction of the tool
    Solve(solve::Arguments),
    /// Simulate: run an NC program on the actual machine: time, travel, deviations, issues
    Simulate(simulate::Arguments),
    /// Simulate: one block of a program through every stage, with the contribution of each error
    Trace(trace::Arguments),
    /// Measure: readings of instruments on a virtual machine with known errors
    Measure(measure::Arguments),
    /// Plan: which errors a measurement determines, its NC programs, the most informative poses
    Plan(plan::Arguments),
    /// Identify: the errors of the machine from measurements
    Identify(identify::Arguments),
    /// Predict: is the test piece within tolerance, and what does each error contribute
    Predict(predict::Arguments),
    /// Predict, for a fleet: how many machines hold the part on how many days, and which tolerance matters
    Study(study::Arguments),
    /// Compensate: the values, programs and tables that correct the errors
    Compensate(compensate::Arguments),
    /// Compensate: cutter locations to the NC program of one control, verified by simulation
    Post(post::Arguments),
    /// Compensate, running: the correction in the control while it cuts
    Live(live::Arguments),
    /// Verify: readings of instruments by ISO 230: positioning, circles, diagonals, drift, spindles
    Evaluate(evaluate::Arguments),
    /// Verify: readings against the prediction of a machine file, or against other readings
    Verify(verify::Arguments),
    /// Explain: the meaning of a diagnostic and what to do: explain table-too-short
    Explain(explain::Arguments),
    /// Schema: the JSON documents of --format json: keys, types, meanings and units
    Schema(schema::Arguments),
    /// Completions: what a shell completes when Tab is pressed
    Completions(completions::Arguments),
    /// Manual: the help of every command as pages for man
    Manual(manual::Arguments),
    /// Serve: all functions in a browser, offline: a local server with a built-in page
    #[cfg(feature = "serve")]
    Serve(serve::Arguments),
}

fn main() -> ExitCode {
    // Ctrl-C and kill leave nothing half-written; without the handler they only leave a hidden file.
    let _ = ctrlc::set_handler(|| {
        if live::ends_by_its_ramp() {
            return;
        }
        trueaxis::files::remove_parts();
        std::process::exit(130);
    });
    let command = Command::parse();
    if std::env::args().any(|a| a == "--dialect" || a.starts_with("--dialect=")) {
        output::tell("`--dialect` is now called `--control`; the old name still works");
    }
    let Some(verb) = command.verb else {
        if command.licenses {
            return exit(output::show(&Answer::Text(LICENSES.to_owned())));
        }
        Command::command().error(ErrorKind::MissingSubcommand, "name a command").exit();
    };
    let outcome = match verb {
        Verb::New(arguments) => new::run(&arguments),
        Verb::Check(arguments) => check::run(&arguments),
        Verb::Part(arguments) => part::run(&arguments),
        Verb::Pose(arguments) => pose::run(arguments),
        Verb::Solve(arguments) => solve::run(arguments),
        Verb::Simulate(arguments) => simulate::run(arguments),
        Verb::Trace(arguments) => trace::run(arguments),
        Verb::Measure(arguments) => measure::run(&arguments),
        Verb::Plan(arguments) => plan::run(&arguments),
        Verb::Identify(arguments) => identify::run(&arguments),
        Verb::Predict(arguments) => predict::run(&arguments),
        Verb::Study(arguments) => study::run(&arguments),
        Verb::Compensate(arguments) => compensate::run(arguments),
        Verb::Post(arguments) => post::run(arguments),
        Verb::Live(arguments) => live::run(&arguments),
        Verb::Evaluate(arguments) => evaluate::run(&arguments),
        Verb::Verify(arguments) => verify::run(&arguments),
        Verb::Explain(arguments) => explain::run(&arguments),
        Verb::Schema(arguments) => schema::run(&arguments),
        Verb::Completions(arguments) => completions::run(&arguments, Command::command()),
        Verb::Manual(arguments) => manual::run(&arguments, Command::command()),
        #[cfg(feature = "serve")]
        Verb::Serve(arguments) => serve::run(&arguments),
    };
    exit(outcome)
}

fn exit(outcome: Outcome) -> ExitCode {
    match outcome {
        Outcome::Done => ExitCode::SUCCESS,
        Outcome::No => ExitCode::from(1),
        Outcome::Unusable => ExitCode::from(2),
    }
}
