//! `trueaxis identify probe FILE.toml`: a touch probe on a ring or a sphere.

use crate::output::{Answer, Format, Outcome, diagnostic_json, report, show, tell};
use crate::report_file::{REPORT, Written, may_write, unusable, write_report};
use clap::Args;
use std::path::{Path, PathBuf};
use trueaxis::files;
use trueaxis::files::disk;
use trueaxis::identify::probe::{
    Calibration, Setup, Study, correct, identify_probe, parse_hits, read_study,
};
use trueaxis::input::{Diagnostics, Dimension, Place, parse_quantity};
use trueaxis::report::{corrected_csv, probe_html, probe_json, probe_table_csv, probe_text};

/// The study and what is made of it.
#[derive(Args)]
#[command(after_help = "\
Examples:
  trueaxis identify probe examples/05_identify/ring-60.toml --report probe.html --table table.csv
  trueaxis identify probe examples/05_identify/ring-60.toml \\
      --correct examples/05_identify/ring-60-fresh.csv -o corrected.csv

Directions are those of motion; the offset is ball - spindle; corrected point = measured point - dR
along the direction of motion. Exit status: 0 done, 2 unusable input.")]
pub struct Arguments {
    /// The study: ring or sphere, styli, tables of hits
    #[arg(value_name = "FILE.toml")]
    file: PathBuf,
    /// Raw hits to be corrected (columns as in the study, with directions)
    #[arg(long, value_name = "HITS.csv", requires = "output")]
    correct: Option<PathBuf>,
    /// Where the corrected hits go
    #[arg(short, long, value_name = "FILE.csv", requires = "correct")]
    output: Option<PathBuf>,
    /// Where the direction table goes: angle, dR, dX, dY, u
    #[arg(long, value_name = "FILE.csv")]
    table: Option<PathBuf>,
    /// Of which stylus (the first)
    #[arg(long, value_name = "NAME")]
    stylus: Option<String>,
    /// How far the spindle is turned for the table, and for hits that do not say so
    #[arg(long, value_name = "ANGLE", allow_negative_numbers = true)]
    orientation: Option<String>,
    /// Where an HTML report goes
    #[arg(long, value_name = "FILE")]
    report: Option<PathBuf>,
    /// For people or for programs
    #[arg(long, value_enum, default_value = "text")]
    format: Format,
}

const CORRECTED: Written =
    Written { argument: "-o", what: "a table of corrected hits", begins: &[b"point_x_mm,"] };
const TABLE: Written =
    Written { argument: "--table", what: "a direction table", begins: &[b"# stylus "] };

pub fn run(arguments: &Arguments) -> Outcome {
    let (study, mut problems) = read_study(&disk(), &arguments.file);
    let outputs =
        [(&arguments.report, &REPORT), (&arguments.output, &CORRECTED), (&arguments.table, &TABLE)];
    for (path, kind) in outputs {
        // Before the work, not after it.
        path.iter().for_each(|path| may_write(path, kind, &mut problems));
    }
    let orientation_rad = orientation(arguments, &mut problems);
    let study = study.filter(|_| !problems.has_errors());
    let found = study.and_then(|study| {
        let all = identify_probe(&study, &mut problems)?;
        let tables = tables(arguments, &study, &all, orientation_rad, &mut problems)?;
        Some((study, all, tables))
    });
    let list = problems.clone();
    let failed = report(problems);
    let (Some((study, all, tables)), false) = (found, failed) else { return Outcome::Unusable };
    if let Some(path) = &arguments.report
        && let Err(outcome) = write_report(path, probe_html(&study, &all))
    {
        return outcome;
    }
    for (path, text) in &tables {
        let shown = path.display().to_string();
        if let Err(e) = files::write(path, text.as_bytes()) {
            let message = format!("cannot be written: {e}");
            return unusable("unwritable-file", &shown, &message, "name another file");
        }
        tell(&format!("table: {shown}"));
    }
    show(&match arguments.format {
        Format::Text => Answer::Text(probe_text(&study, &all)),
        Format::Json => {
            let mut document = probe_json(&study, &all);
            document["diagnostics"] = list.iter().map(diagnostic_json).collect();
            Answer::Json(document)
        }
    })
}

fn orientation(arguments: &Arguments, problems: &mut Diagnostics) -> Option<f64> {
    let text = arguments.orientation.as_ref()?;
    let number = text.trim().parse::<f64>().is_ok();
    let text = if number { format!("{text} deg") } else { text.clone() };
    let found = parse_quantity(&text, Dimension::Angle);
    let place = Place::whole("--orientation");
    found.map_err(|e| problems.error(e.code(), place, e.to_string(), &e.hint())).ok()
}

/// The files to be written, with their texts.
fn tables<'a>(
    arguments: &'a Arguments,
    study: &Study,
    all: &[Calibration],
    orientation_rad: Option<f64>,
    problems: &mut Diagnostics,
) -> Option<Vec<(&'a Path, String)>> {
    let index = match &arguments.stylus {
        None => 0,
        Some(name) => match all.iter().position(|f| f.stylus == *name) {
            Some(index) => index,
            None => {
                let names: Vec<&str> = all.iter().map(|f| f.stylus.as_str()).collect();
                let message = format!("there is no stylus `{name}`");
                let hint = format!("one of {}", names.join(", "));
                problems.error("unknown-stylus", Place::whole("--stylus"), message, &hint);
                return None;
            }
        },
    };
    let (found, stylus) = (all.get(index)?, study.styli.get(index)?);
    let mut tables: Vec<(&Path, String)> = Vec::new();
    if let Some(path) = &arguments.table {
        let first = found.orientations_rad.first().copied().unwrap_or(0.0);
        let turned = orientation_rad.unwrap_or(first);
        tables.push((path, probe_table_csv(found, study.table_steps, turned)));
    }
    if let (Some(raw), Some(path)) = (&arguments.correct, &arguments.output) {
        let text = disk().text(raw, "a table of hits (CSV)", problems)?;
        let setup = Setup {
            gauge: &study.gauge,
            ball_radius_mm: found.ball_radius_mm,
            reading: stylus.reading,
            orientation_rad: orientation_rad.unwrap_or(0.0),
            on_gauge: false,
        };
        let hits = parse_hits(&raw.display().to_string(), &text, &setup, problems)?;
        let points = correct(found, &hits, problems)?;
        tables.push((path, corrected_csv(found, &hits, &points)));
    }
    Some(tables)
}
