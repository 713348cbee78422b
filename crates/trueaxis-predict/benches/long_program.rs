//! A part study of a program of 10^5 lines with 10^5 points, nominal and actual, against a limit.
//!
//! A dome of 92 mm, finished by a ball end mill that leans and swings in five axes, on the XKAS2525 gantry with all of its errors.
//!
//! `cargo bench -p trueaxis-predict --bench long_program` (`-- 300` rows: other lengths of the program)

#![allow(clippy::print_stdout)] // a bench prints its figures

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::time::Instant;
use trueaxis_input::{Diagnostics, Files};
use trueaxis_predict::predict::drawing::{PartStudy, predict_part, read_part_study};

const LIMIT_S: f64 = 6.0;
const ROUNDS: usize = 5;
const DOME_MM: f64 = 120.0;
const BALL_MM: f64 = 5.0;
const SIDE_MM: f64 = 96.0;
const ROWS: usize = 320;
const PER_ROW: usize = 315;

/// A sphere whose points are 0.28 mm from each other.
fn part() -> String {
    format!(
        "name = \"dome\"\n[feature.dome]\nsphere = {{ at = \"0 0 0 mm\", axis = \"0 0 1\", diameter = \"{} mm\", opening = \"22 deg\" }}\n\
         extraction = {{ rows = 160, points = 625 }}\n[[characteristic]]\nprofile = \"60 um\"\nof = \"dome\"\n",
        2.0 * DOME_MM
    )
}

/// Rows to and fro, the lowest point of the ball on the dome, the tool 10° from the normal and more.
fn program(rows: usize) -> String {
    let mut text =
        "G54 G17 G710 G90 G94\nT=\"BALL\"\nM6\nD1 S12000 M3\nG0 X0 Y0 Z200\nTRAORI\nORIWKS ORIVECT\n"
            .to_owned();
    for row in 0..rows {
        let across = (row as f64 / (rows - 1) as f64 - 0.5) * SIDE_MM;
        for k in 0..PER_ROW {
            let k = if row % 2 == 0 { k } else { PER_ROW - 1 - k };
            let along = (k as f64 / (PER_ROW - 1) as f64 - 0.5) * SIDE_MM;
            let up = (DOME_MM * DOME_MM - along * along - across * across).sqrt();
            let normal = [along, across, up].map(|c| c / DOME_MM);
            let lean = [normal[0] + 0.17, normal[1] + 0.05 * (along / 10.0).sin(), normal[2]];
            let length = lean.iter().map(|c| c * c).sum::<f64>().sqrt();
            let axis = lean.map(|c| c / length);
            let [x, y, z] = [0, 1, 2].map(|i| normal[i] * (DOME_MM + BALL_MM) - axis[i] * BALL_MM);
            let _ = writeln!(
                text,
                "G1 X{x:.5} Y{y:.5} Z{z:.5} A3={:.8} B3={:.8} C3={:.8} F3000",
                axis[0], axis[1], axis[2]
            );
        }
    }
    text + "G0 Z200\nTRAFOOF\nM30\n"
}

fn study(rows: usize) -> PartStudy {
    let machines = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../machines/xkas2525");
    let machine = ["machine.toml", "X.csv", "Y.csv", "Z.csv", "C.csv", "A.csv"]
        .map(|name| (name, std::fs::read_to_string(machines.join(name)).expect("the machine")));
    let study =
        "name = \"s\"\nmachine = \"machine.toml\"\npart = \"p.toml\"\nprogram = \"p.mpf\"\n"
            .to_owned();
    let set_up = "control = \"sinumerik\"\nworkpiece_at = \"G54\"\n[work_offset.G54]\nX = \"3100 mm\"\nY = \"1250 mm\"\nZ = \"-900 mm\"\n\
        [tool.1]\nname = \"BALL\"\nlength = \"140 mm\"\ndiameter = \"10 mm\"\ncorner_radius = \"5 mm\"\n"
        .to_owned();
    let texts =
        [("s.toml", study), ("p.toml", part()), ("p.mpf", program(rows)), ("p.setup.toml", set_up)];
    let texts = machine.into_iter().chain(texts);
    let files = Files::none().with_texts(texts.map(|(name, text)| (PathBuf::from(name), text)));
    let (study, problems) = read_part_study(&files, Path::new("s.toml"));
    study.unwrap_or_else(|| panic!("{problems:?}"))
}

fn main() {
    let rows = std::env::args().skip(1).find_map(|a| a.parse().ok()).unwrap_or(ROWS);
    let study = study(rows);
    let threads = rayon::ThreadPoolBuilder::new().num_threads(2).build().expect("a pool");
    let mut times = Vec::new();
    for _ in 0..ROUNDS {
        let mut problems = Diagnostics::new();
        let start = Instant::now();
        let found = threads.install(|| predict_part(&study, &|_| {}, &mut problems));
        times.push(start.elapsed().as_secs_f64());
        let found = found.unwrap_or_else(|| panic!("{problems:?}"));
        let value = &found.values[0];
        if times.len() == 1 {
            println!(
                "{} moves, {} points: profile {:.2} µm, {:.2} µm by the program, u {:.2} µm",
                found.steps,
                study.part.points(),
                1e3 * value.value_mm,
                1e3 * value.nominal_mm,
                1e3 * value.u_mm
            );
        }
    }
    times.sort_by(f64::total_cmp);
    println!(
        "{:.2} s on two cores, the median of {ROUNDS} (limit: {LIMIT_S} s)",
        times[ROUNDS / 2]
    );
}
