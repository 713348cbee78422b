//! The study of the hits that a probing program will make: what `identify surface` reads.

use super::file::SurfaceStudy;
use super::program::order;
use std::fmt::Write;

/// Names of files in the study.
#[derive(Debug, Clone, Copy)]
pub struct HitsFiles<'a> {
    /// The machine file, seen from the study.
    pub machine: &'a str,
    /// The study of `identify probe`, seen from the study.
    pub calibration: Option<&'a str>,
    /// The log that was written at once on a virtual machine.
    pub log: Option<&'a str>,
}

/// The text of the study; `points` were planned.
pub fn hits_study(study: &SurfaceStudy, points: usize, files: &HitsFiles<'_>) -> String {
    let mut text = "# What the probe touches, in which order; `trueaxis identify surface` reads it with the log \
                    that the control writes.\n"
        .to_owned();
    let hits = order(study, points).len();
    let quoted = |text: &str| format!("\"{}\"", text.replace('\\', "/").replace('"', "'"));
    // Writing to a String cannot fail.
    let _ = writeln!(text, "name = {}", quoted(&study.name));
    let _ = writeln!(
        text,
        "machine = {}    # with its errors: they say where the ball really was",
        quoted(files.machine)
    );
    let _ = writeln!(
        text,
        "points = \"surface.csv\"    # nominal points and normals, row by row K1, K2 …"
    );
    match files.log {
        Some(log) => {
            let _ = writeln!(
                text,
                "log = {}    # of the virtual machine: put the log of the control in its place",
                quoted(log)
            );
        }
        None => {
            let _ = writeln!(
                text,
                "# log = \"surface-hits.log\"    # what the program wrote on the control"
            );
        }
    }
    let _ = writeln!(
        text,
        "hits = {hits}    # H1 to H{points} touch the points in order{}",
        if hits > points { ", the last hit touches point 1 again: the drift" } else { "" }
    );
    let _ = writeln!(text, "\n[probe]\ntool = {}", study.tool);
    let u = study.u_probe_length_mm.map_or(String::new(), |u| format!(" ± {u:.6}"));
    let _ = writeln!(
        text,
        "length = \"{:.6}{u} mm\"    # spindle to the centre of the ball",
        study.probe_length_mm
    );
    let _ = writeln!(text, "ball_diameter = \"{:.6} mm\"", 2.0 * study.ball_radius_mm);
    match files.calibration {
        Some(file) => {
            let _ =
                writeln!(text, "calibration = {}    # a study of `identify probe`", quoted(file));
        }
        None => {
            let _ =
                writeln!(text, "# calibration = \"ring.toml\"    # a study of `identify probe`");
        }
    }
    if let Some((_, stylus)) = study.calibration.as_ref().filter(|(_, s)| !s.is_empty()) {
        let _ = writeln!(text, "stylus = {}", quoted(stylus));
    }
    text
}
