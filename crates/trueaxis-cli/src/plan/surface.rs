//! `trueaxis plan probe-surface FILE.toml`: touch after touch over a surface.

use super::written;
use crate::arguments::control;
use crate::output::{Answer, Format, Outcome, diagnostic_json, report, show};
use clap::Args;
use std::path::PathBuf;
use trueaxis::files::disk;
use trueaxis::input::{Diagnostics, Place};
use trueaxis::nc::Control;
use trueaxis::plan::extension;
use trueaxis::plan::program::ProgramCheck;
use trueaxis::plan::surface::{
    Pose, SurfacePoint, SurfaceStudy, check_surface, nominal_table, poses, read_surface, spread,
    surface_program,
};
use trueaxis::report::{surface_json, surface_text};

/// The surface.
#[derive(Args)]
#[command(after_help = "\
Example:
  trueaxis plan probe-surface examples/04_plan/probe-surface.toml --control fanuc -o programs

Writes the NC program of the touches along the normals, and surface.csv: point, x_mm .. z_mm, i, j, k,
deviation_um (empty: what is measured goes there; um along the normal, positive outside).
Exit status: 0 done, 1 the program would run into something or leave the travel, 2 unusable input.")]
pub struct Arguments {
    /// The study: machine, surface, spacing, probe
    #[arg(value_name = "FILE.toml")]
    file: PathBuf,
    /// Whose NC program: sinumerik, fanuc or linuxcnc
    #[arg(long, alias = "dialect", value_name = "NAME", default_value = "sinumerik")]
    control: String,
    /// Write the program and the table of the points into this folder
    #[arg(short, long, value_name = "FOLDER")]
    output: Option<PathBuf>,
    /// For people or for programs
    #[arg(long, value_enum, default_value = "text")]
    format: Format,
}

struct Made {
    study: SurfaceStudy,
    poses: Vec<Pose>,
    asked: usize,
    program: Vec<u8>,
    check: ProgramCheck,
}

pub fn run(arguments: &Arguments) -> Outcome {
    let (study, mut problems) = read_surface(&disk(), &arguments.file);
    let control = control(&arguments.control, &mut problems);
    let ready = !problems.has_errors();
    let made = study.zip(control).filter(|_| ready);
    let made = made.and_then(|(study, control)| make(study, control, &mut problems));
    let list = problems.clone();
    let failed = report(problems);
    let (Some(made), Some(control), false) = (made, control, failed) else {
        return Outcome::Unusable;
    };
    if let Some(folder) = &arguments.output {
        let points: Vec<SurfacePoint> = made.poses.iter().map(|p| p.point).collect();
        let files = [
            (format!("surface.{}", extension(control)), made.program.clone()),
            ("surface.csv".to_owned(), nominal_table(&points).into_bytes()),
        ];
        if let Err(outcome) = written(folder, &files) {
            return outcome;
        }
    }
    let outcome = show(&match arguments.format {
        Format::Text => {
            Answer::Text(surface_text(&made.study, &made.poses, made.asked, &made.check))
        }
        Format::Json => {
            let mut document = surface_json(&made.study, &made.poses, made.asked, &made.check);
            document["diagnostics"] = list.iter().map(diagnostic_json).collect();
            Answer::Json(document)
        }
    });
    match outcome {
        Outcome::Done if !made.check.is_sound() => Outcome::No,
        outcome => outcome,
    }
}

fn make(study: SurfaceStudy, control: Control, problems: &mut Diagnostics) -> Option<Made> {
    let place = || Place::whole(&study.file);
    let points = match spread(&study.candidates, study.spacing_mm, study.most_points) {
        Ok(points) => points,
        Err(why) => {
            let hint = "a wider spacing, or a larger most_points";
            problems.error("too-many-points", place(), why, hint);
            return None;
        }
    };
    let faces = |p: &SurfacePoint| {
        study.facing.is_none_or(|(direction, within)| {
            p.normal.dot(&direction).clamp(-1.0, 1.0).acos() <= within
        })
    };
    let points: Vec<SurfacePoint> = points.into_iter().filter(faces).collect();
    if points.is_empty() {
        let message = "no point is left".to_owned();
        problems.error("no-points", place(), message, "a wider `within`, or another `facing`");
        return None;
    }
    let poses = poses(&study, &points, problems);
    if poses.is_empty() {
        return None;
    }
    let program = match surface_program(&study, &poses, control) {
        Ok(program) => program,
        Err(error) => {
            let hint = "choose another --control";
            problems.error("no-program", Place::whole("--control"), error.to_string(), hint);
            return None;
        }
    };
    let check = check_surface(&study, &poses, &program, control);
    Some(Made { asked: points.len(), study, poses, program, check })
}
