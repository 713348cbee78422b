//! `trueaxis identify`: errors of a machine from readings.

mod errors;
mod probe;
mod rtcp;
mod thermal;

use crate::output::{Answer, Format, Outcome, finish};
use clap::{Args, Subcommand};
use serde_json::{Value, json};
use std::fmt::Write;
use std::path::PathBuf;
use trueaxis::files::disk;
use trueaxis::identify::expansion::{Expansion, Runs, identify_expansion, read_runs};
use trueaxis::input::{Diagnostics, Place};

/// What to identify.
#[derive(Args)]
#[command(
    args_conflicts_with_subcommands = true,
    after_help = "\
Examples:
  trueaxis identify examples/05_identify/probe-ball.toml --report found.html
  trueaxis identify examples/05_identify/mixed-instruments.toml -o identified.toml --format json
  trueaxis identify expansion examples/05_identify/y-axis-two-temperatures.toml
  trueaxis identify rtcp examples/05_identify/rtcp-engraver.toml

Exit status: 0 the model explains what can be explained, 1 it does not, 2 unusable input."
)]
pub struct Arguments {
    #[command(subcommand)]
    what: Option<What>,
    #[command(flatten)]
    errors: errors::CampaignArguments,
}

#[derive(Subcommand)]
enum What {
    /// The coefficient of expansion of a scale, from laser runs at two or more temperatures
    Expansion(ExpansionArguments),
    /// The rotary centres for RTCP, from dial or probe readings at turned poses
    Rtcp(rtcp::Arguments),
    /// A linear model of an error that drifts with temperatures, from logs of whole cycles
    Thermal(thermal::Arguments),
    /// The offset of a stylus ball and its pre-travel by direction, from hits on a ring or sphere
    Probe(probe::Arguments),
}

/// The runs.
#[derive(Args)]
#[command(after_help = "\
Example:
  trueaxis identify expansion examples/05_identify/y-axis-two-temperatures.toml

Exit status: 0 done, 2 unusable input.")]
struct ExpansionArguments {
    /// The file of the runs: table, temperatures
    #[arg(value_name = "FILE.toml")]
    file: PathBuf,
    /// For people or for programs
    #[arg(long, value_enum, default_value = "text")]
    format: Format,
}

pub fn run(arguments: &Arguments) -> Outcome {
    match &arguments.what {
        None => errors::run(&arguments.errors),
        Some(What::Expansion(arguments)) => run_expansion(arguments),
        Some(What::Rtcp(arguments)) => rtcp::run(arguments),
        Some(What::Thermal(arguments)) => thermal::run(arguments),
        Some(What::Probe(arguments)) => probe::run(arguments),
    }
}

fn run_expansion(arguments: &ExpansionArguments) -> Outcome {
    let (runs, mut problems) = read_runs(&disk(), &arguments.file);
    let answer = runs.map(|runs| answer(&runs, arguments, &mut problems));
    finish(problems, answer)
}

fn answer(runs: &Runs, arguments: &ExpansionArguments, problems: &mut Diagnostics) -> Answer {
    let found = identify_expansion(runs);
    for warning in &found.warnings {
        let place = Place::whole(&arguments.file.display().to_string());
        problems.warn("identification", place, warning.clone(), "");
    }
    match arguments.format {
        Format::Json => Answer::Json(document(runs, &found)),
        Format::Text => Answer::Text(text(runs, &found)),
    }
}

fn document(data: &Runs, found: &Expansion) -> Value {
    let runs = data.runs.iter().zip(&found.slopes).map(|(run, slope)| {
        json!({
            "name": run.name,
            "temperature_celsius": run.celsius.value,
            "slope_um_per_m": slope * 1e6,
        })
    });
    json!({
        "schema": "trueaxis/identify/1",
        "name": data.name,
        "expansion_um_per_m_k": found.per_k * 1e6,
        "u_um_per_m_k": found.u_per_k * 1e6,
        "slope_difference_um_per_m_k": found.slope_difference_per_k * 1e6,
        "residual_um": found.residual_mm * 1e3,
        "materials": found.materials,
        "runs": runs.collect::<Vec<_>>(),
        "warnings": found.warnings,
    })
}

fn text(data: &Runs, found: &Expansion) -> String {
    let mut text = format!("{}\n\n", data.name);
    let (alpha, u) = (found.per_k * 1e6, found.u_per_k * 1e6);
    // Writing to a String cannot fail.
    let _ =
        writeln!(text, "  expansion          {alpha:.3} ± {u:.3} µm/(m·K), standard uncertainty");
    let difference = found.slope_difference_per_k * 1e6;
    let _ =
        writeln!(text, "  slope difference   {difference:.3} µm/(m·K), coldest and warmest run");
    let material = match found.materials.is_empty() {
        true => "none of steel tape, glass, Zerodur".to_owned(),
        false => found.materials.join(" or "),
    };
    let _ = writeln!(text, "  material           {material}");
    let _ = writeln!(text, "  residual           {:.3} µm\n", found.residual_mm * 1e3);
    for (run, slope) in data.runs.iter().zip(&found.slopes) {
        let (name, celsius) = (&run.name, run.celsius.value);
        let _ = writeln!(text, "  {name:<18} {celsius:>6.1} °C   slope {:>9.3} µm/m", slope * 1e6);
    }
    let _ = writeln!(text, "\n  in the machine file: expansion = \"{alpha:.2} ± {u:.2} um/(m K)\"");
    text
}
