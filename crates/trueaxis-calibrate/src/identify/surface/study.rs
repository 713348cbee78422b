//! `hits.toml`: what was touched with which probe on which machine, and the log of it.

use super::log::{HitsLog, parse_log};
use crate::identify::probe::{Calibration, Purpose, identify_probe, read_study};
use crate::plan::surface::points_of_table;
use std::path::Path;
use trueaxis_geometry::Vec3;
use trueaxis_geometry::surface::SurfacePoint;
use trueaxis_input::plausible::Quantity;
use trueaxis_input::{Diagnostics, Dimension, Files, MeasuredValue, Place, Section, SourceText};
use trueaxis_machine::Machine;
use trueaxis_machine::file::machine_of;

/// The probe that made the hits.
#[derive(Debug, Clone)]
pub struct HitsProbe {
    /// Its number in the tool table of the control.
    pub tool: usize,
    /// From the spindle to the centre of the ball, mm.
    pub length_mm: f64,
    /// Standard uncertainty of the length, mm, if it is stated.
    pub u_length_mm: Option<f64>,
    /// What its hits on a ring or sphere have shown.
    pub calibration: Calibration,
    /// The study of the calibration, as it is shown.
    pub calibration_file: String,
    /// Standard deviation of one trigger, mm: stated, or that of the calibration.
    pub repeatability_mm: f64,
}

/// Hits with all that turns them into deviations.
#[derive(Debug, Clone)]
pub struct HitsStudy {
    /// The file as the user named it.
    pub file: String,
    /// In words.
    pub name: String,
    /// The machine, its tip at the centre of the ball.
    pub machine: Machine,
    /// Nominal points and normals, in the order of their numbers.
    pub points: Vec<SurfacePoint>,
    /// Their table, as it is shown.
    pub points_file: String,
    /// How many hits were planned.
    pub planned: usize,
    /// What the control wrote.
    pub log: HitsLog,
    /// The log as it is shown.
    pub log_file: String,
    /// The probe.
    pub probe: HitsProbe,
    /// Half the width in which a drift stays that no touch shows, mm, if it is stated.
    pub drift_within_mm: Option<f64>,
    /// Whether hits may be lacking.
    pub may_be_lost: bool,
}

/// Reads a study and the files that it names.
pub fn read_hits(files: &Files, path: &Path) -> (Option<HitsStudy>, Diagnostics) {
    let mut problems = Diagnostics::new();
    let Some(text) = files.text(path, "a study of hits (TOML)", &mut problems) else {
        return (None, problems);
    };
    let file = path.display().to_string();
    let source = SourceText::from(files, &file, &text);
    let mut found = Diagnostics::new();
    let study = source.read(|root| read(root, path, &mut found));
    problems.append(source.finish());
    problems.append(found);
    (study.filter(|_| !problems.has_errors()), problems)
}

fn read(root: &Section<'_>, path: &Path, found: &mut Diagnostics) -> Option<HitsStudy> {
    // Every key is asked for before anything is given up, or it would count as unknown.
    let folder = path.parent().unwrap_or(Path::new(""));
    let files = root.files();
    let name = root.require("name", "say which surface").and_then(|i| i.text()).map(str::to_owned);
    let machine = machine_of(root, path);
    let points_name =
        root.require("points", "points = \"surface.csv\", as `plan probe-surface` writes it");
    let points_file = points_name.and_then(|i| i.text()).map(|t| folder.join(t));
    let planned =
        root.require("hits", "hits = 71: how many the program makes").and_then(|i| i.count());
    let log = root.get("log").map(|i| i.text().map(|t| folder.join(t)));
    if log.is_none() {
        let message = "the study names no log: nothing was measured yet".to_owned();
        let hint = "run the program on the machine, put the file that it wrote here and state it as log = \
                    \"surface-hits.log\"; `[virtual]` in the study of the plan writes one without a machine";
        root.error("missing-log", message, hint);
    }
    let drift = root.quantity("drift_within", Dimension::Length);
    let may_be_lost = root.get("may_be_lost").map_or(Some(false), |i| i.flag());
    let probe =
        root.require("probe", "[probe] tool = 1, length = \"90 mm\", calibration = \"ring.toml\"");
    let probe = probe.and_then(|i| i.section("probe", |s| read_probe(s, folder, found))).flatten();
    let points = points_file.as_ref().and_then(|path| {
        let text = files.text(path, "a table of points (CSV)", found)?;
        points_of_table(&path.display().to_string(), &text, found)
    });
    let (_, machine) = machine?;
    let log_file = log??;
    let log = files
        .text(&log_file, "the log of a probing program", found)
        .and_then(|text| parse_log(&log_file.display().to_string(), &text, &machine, found));
    let probe = probe?;
    let planned = planned?;
    if planned == 0 {
        root.error("bad-count", "no hit is planned".to_owned(), "hits = 71");
    }
    Some(HitsStudy {
        file: path.display().to_string(),
        name: name?,
        machine: machine.with_tip(Vec3::new(0.0, 0.0, -probe.length_mm)),
        points: points?,
        points_file: points_file?.display().to_string(),
        planned,
        log: log?,
        log_file: log_file.display().to_string(),
        probe,
        drift_within_mm: drift.map(f64::abs),
        may_be_lost: may_be_lost?,
    })
}

fn read_probe(section: &Section<'_>, folder: &Path, found: &mut Diagnostics) -> Option<HitsProbe> {
    let tool =
        section.require("tool", "tool = 1: its number in the control").and_then(|i| i.count());
    let hint = "length = \"90 ± 0.001 mm\", from the spindle to the centre of the ball";
    let length = section.require("length", hint).and_then(|i| i.measured_of(Quantity::ToolLength));
    let ball = section.quantity_of("ball_diameter", Quantity::Diameter);
    let stylus = section.text("stylus").map(str::to_owned);
    let repeatability = section.quantity("repeatability", Dimension::Length);
    let hint = "calibration = \"ring.toml\": a study of `identify probe`; ball radius and pre-travel are not \
                known without it";
    let calibration = match section.get("calibration") {
        Some(item) => item.text().map(|t| folder.join(t)),
        None => {
            let message = "the calibration of the probe is not named".to_owned();
            section.error("missing-calibration", message, hint);
            None
        }
    };
    let study =
        found.keep(read_study(section.files(), calibration.as_ref()?, Purpose::Calibration));
    let all = study.and_then(|study| identify_probe(&study, found))?;
    let calibration_file = calibration?.display().to_string();
    let chosen = match &stylus {
        Some(name) => all.iter().find(|c| c.stylus == *name),
        None if all.len() == 1 => all.first(),
        None => None,
    };
    let Some(chosen) = chosen else {
        let names: Vec<&str> = all.iter().map(|c| c.stylus.as_str()).collect();
        let message = match &stylus {
            Some(name) => format!("`{calibration_file}` has no stylus `{name}`"),
            None => format!("`{calibration_file}` has several styli"),
        };
        section.error("unknown-stylus", message, &format!("stylus = one of {}", names.join(", ")));
        return None;
    };
    if let Some(ball) = ball
        && (0.5 * ball - chosen.ball_radius_mm).abs() > 1e-6
    {
        let message = format!(
            "the ball has {ball} mm here, {} mm in the calibration",
            2.0 * chosen.ball_radius_mm
        );
        let hint = "calibrate this stylus, or name the right one";
        found.error("other-ball", Place::whole(&calibration_file), message, hint);
    }
    let MeasuredValue { value: length_mm, u: u_length_mm, .. } = length?;
    Some(HitsProbe {
        tool: tool?,
        length_mm,
        u_length_mm,
        repeatability_mm: repeatability.unwrap_or(chosen.fit.s_mm()).abs(),
        calibration: chosen.clone(),
        calibration_file,
    })
}
