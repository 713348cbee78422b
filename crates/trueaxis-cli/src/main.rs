//! The command `trueaxis`: one file per command, each belongs to one verb of the loop.
//!
//! Results go to standard output (with `--format json` one document and nothing else), progress
//! and diagnostics to standard error. Exit status: 0 done, 1 the verdict is "no", 2 unusable
//! input or arguments.

mod arguments;
mod check;
mod compensate;
mod door;
mod evaluate;
mod explain;
mod identify;
mod measure;
mod output;
mod path_file;
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
mod trace;
mod verify;

use clap::{Parser, Subcommand};
use output::Outcome;
use std::process::ExitCode;

/// TrueAxis: where is the tool really, and is the part good?
#[derive(Parser)]
#[command(name = "trueaxis", version, max_term_width = 100, arg_required_else_help = true)]
#[command(after_help = "\
Examples:
  trueaxis check machines/xkas2525/machine.toml
  trueaxis pose machines/xkas2525/machine.toml --at \"X=3000 Y=1200 Z=-700 C=-90 A=15\"
  trueaxis solve machines/i5-engraver/machine.toml --tip \"10 20 30\" --axis \"0.3 -0.2 0.93\"
  trueaxis simulate machines/i5-engraver/machine.toml examples/02_simulate/ring-fanuc.nc
  trueaxis predict examples/03_predict/nas979-on-xkas2525.toml
  trueaxis evaluate iso230-2 examples/07_verify/x-axis-laser.csv --report x.html
  trueaxis compensate values machines/gantry-001/machine.toml --axis X --step 500
  trueaxis measure examples/04_plan/probe-ball.toml
  trueaxis verify examples/07_verify/probe-ball.toml
  trueaxis plan examples/04_plan/probe-ball.toml
  trueaxis identify examples/05_identify/probe-ball.toml
  trueaxis post machines/i5-engraver/machine.toml examples/06_compensate/bangle.cls --control fanuc -o bangle.nc --verify
  trueaxis identify expansion examples/05_identify/y-axis-two-temperatures.toml
  trueaxis explain table-too-short
  trueaxis schema pose
  trueaxis serve --open

Exit status: 0 done, 1 the verdict is no, 2 unusable input or arguments.")]
struct Command {
    #[command(subcommand)]
    verb: Verb,
}

#[derive(Subcommand)]
enum Verb {
    /// Describe: check a machine file and say what the machine is and what it lacks
    Check(check::Arguments),
    /// Describe: nominal and actual pose of the tool, and the share of every error
    Pose(pose::Arguments),
    /// Describe: axis positions for a wanted tool tip and direction
    Solve(solve::Arguments),
    /// Simulate: run an NC program on the machine as it is: time, travel, deviations, troubles
    Simulate(simulate::Arguments),
    /// Simulate: one block of a program through every stage, with the share of each error
    Trace(trace::Arguments),
    /// Measure: what instruments would read on a machine whose errors are known
    Measure(measure::Arguments),
    /// Plan: what a measurement will tell, its NC programs, the poses that tell most
    Plan(plan::Arguments),
    /// Identify: what the machine is like, from measurements
    Identify(identify::Arguments),
    /// Predict: will the test piece be good, and which error costs how much of it
    Predict(predict::Arguments),
    /// Compensate: what the control has to add to its commands
    Compensate(compensate::Arguments),
    /// Compensate: cutter locations into an NC program of one control, with its proof
    Post(post::Arguments),
    /// Verify: readings of instruments by ISO 230: positioning, circles, diagonals, drift, spindles
    Evaluate(evaluate::Arguments),
    /// Verify: readings against what a machine file predicts, or against other readings
    Verify(verify::Arguments),
    /// What a diagnostic means and what to do: explain table-too-short
    Explain(explain::Arguments),
    /// The JSON documents that --format json prints: their keys, types, meanings and units
    Schema(schema::Arguments),
    /// See it all in a browser, offline: a local server with the page in it
    #[cfg(feature = "serve")]
    Serve(serve::Arguments),
}

fn main() -> ExitCode {
    // Ctrl-C and kill leave nothing half-written; without the handler they only leave a hidden file.
    let _ = ctrlc::set_handler(|| {
        trueaxis::files::remove_parts();
        std::process::exit(130);
    });
    let command = Command::parse();
    if std::env::args().any(|a| a == "--dialect" || a.starts_with("--dialect=")) {
        output::tell("`--dialect` is now called `--control`; the old name still works");
    }
    let outcome = match command.verb {
        Verb::Check(arguments) => check::run(&arguments),
        Verb::Pose(arguments) => pose::run(&arguments),
        Verb::Solve(arguments) => solve::run(&arguments),
        Verb::Simulate(arguments) => simulate::run(&arguments),
        Verb::Trace(arguments) => trace::run(&arguments),
        Verb::Measure(arguments) => measure::run(&arguments),
        Verb::Plan(arguments) => plan::run(&arguments),
        Verb::Identify(arguments) => identify::run(&arguments),
        Verb::Predict(arguments) => predict::run(&arguments),
        Verb::Compensate(arguments) => compensate::run(&arguments),
        Verb::Post(arguments) => post::run(&arguments),
        Verb::Evaluate(arguments) => evaluate::run(&arguments),
        Verb::Verify(arguments) => verify::run(&arguments),
        Verb::Explain(arguments) => explain::run(&arguments),
        Verb::Schema(arguments) => schema::run(&arguments),
        #[cfg(feature = "serve")]
        Verb::Serve(arguments) => serve::run(&arguments),
    };
    match outcome {
        Outcome::Done => ExitCode::SUCCESS,
        Outcome::No => ExitCode::from(1),
        Outcome::Unusable => ExitCode::from(2),
    }
}
