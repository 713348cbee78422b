//! A path moved onto a probed blank, as text and JSON.

use super::adapt_maps::Layout;
use crate::compensate::adapt::{AdaptStudy, Adaptation, MapCell, MovedPlace};
use std::fmt::Write;
use trueaxis_geometry::Vec3;

/// The program that was made of the adapted path.
#[derive(Debug, Clone, PartialEq)]
pub struct AdaptedProgram {
    /// Where it is.
    pub file: String,
    /// Whether it was written: only if its proof holds and nothing speaks against the path.
    pub written: bool,
    /// Blocks that move the tool along the path.
    pub blocks: usize,
    /// The largest distance of the read-back program from the adapted path.
    pub tip_mm: f64,
    /// Of its tool axis.
    pub axis_rad: f64,
}

/// Everything that there is to tell.
#[derive(Debug, Clone, Copy)]
pub struct AdaptReport<'a> {
    /// What was asked.
    pub study: &'a AdaptStudy,
    /// What came of it.
    pub adaptation: &'a Adaptation,
    /// The program, if one was asked for.
    pub program: Option<&'a AdaptedProgram>,
}

/// The spread of some values.
pub(super) struct Spread {
    pub min: f64,
    pub max: f64,
    pub mean: f64,
}

impl Spread {
    pub fn of(values: impl Iterator<Item = f64>) -> Self {
        let start = (f64::INFINITY, f64::NEG_INFINITY, 0.0, 0.0_f64);
        let (min, max, sum, count) =
            values.fold(start, |(a, b, s, n), v| (a.min(v), b.max(v), s + v, n + 1.0));
        if count == 0.0 {
            return Self { min: 0.0, max: 0.0, mean: 0.0 };
        }
        Self { min, max, mean: sum / count }
    }
}

impl AdaptReport<'_> {
    /// How far the wall after the cut is from the wanted one at a place of the map, mm.
    pub(super) fn off_mm(&self, cell: &MapCell) -> f64 {
        cell.after.wall_mm - Adaptation::wanted_mm(self.study, &cell.after)
    }

    pub(super) fn walls(&self, after: bool) -> Spread {
        let wall = |c: &MapCell| if after { c.after.wall_mm } else { c.before.wall_mm };
        Spread::of(self.adaptation.map.iter().map(wall))
    }

    pub(super) fn through(&self, after: bool) -> usize {
        let wall = |c: &&MapCell| if after { c.after.wall_mm } else { c.before.wall_mm };
        self.adaptation.map.iter().filter(|c| wall(c) <= 0.0).count()
    }

    pub(super) fn moved(&self) -> Spread {
        let moved = |p: &MovedPlace| p.contact.map(|c| c.moved_mm);
        Spread::of(self.adaptation.places.iter().filter_map(moved))
    }

    pub(super) fn most_u_mm(&self) -> f64 {
        let contacts = self.adaptation.places.iter().filter_map(|p| p.contact);
        contacts.fold(0.0, |m, c| m.max(c.u_mm))
    }

    pub(super) fn cut_places(&self) -> usize {
        self.adaptation.places.iter().filter(|p| p.contact.is_some()).count()
    }

    pub(super) fn is_sound(&self) -> bool {
        self.adaptation.findings.is_empty() && self.program.is_none_or(|p| p.written)
    }

    /// The outcome in one sentence.
    pub(super) fn verdict(&self) -> String {
        let (before, after) = (self.walls(false), self.walls(true));
        let off = Spread::of(self.adaptation.map.iter().map(|c| self.off_mm(c)));
        let through = match self.through(false) {
            0 => String::new(),
            n => format!(", cut through at {n} of {} places", self.adaptation.map.len()),
        };
        format!(
            "as programmed the wall would be {:.3} to {:.3} mm{through}; adapted {:.3} to {:.3} mm, within \
             {:+.1} and {:+.1} µm of an equal layer",
            before.min,
            before.max,
            after.min,
            after.max,
            off.min * 1e3,
            off.max * 1e3
        )
    }

    /// Where the map comes from.
    pub(super) fn map_source(&self) -> String {
        match &self.study.blank {
            Some((file, _)) => format!("virtual cut of the blank of {file}"),
            None => {
                "virtual cut of the blank as the field foretells it, at the measured points".into()
            }
        }
    }
}

/// The tables for a terminal, the verdict first.
pub fn adapt_text(report: &AdaptReport<'_>) -> String {
    let mut text = format!("{}\n\n", report.study.name);
    let word = if report.is_sound() { "GOOD" } else { "NOT TO BE CUT" };
    // Writing to a String cannot fail.
    let _ = writeln!(text, "{word}: {}\n", report.verdict());
    for finding in &report.adaptation.findings {
        let _ = writeln!(
            text,
            "  {} at {} places, worst at {}:{}: {}",
            finding.code,
            finding.places,
            report.study.path.name(),
            finding.line,
            finding.message
        );
    }
    if !report.adaptation.findings.is_empty() {
        text.push('\n');
    }
    registration_text(&mut text, report);
    field_text(&mut text, report);
    walls_text(&mut text, report);
    Layout::of(&report.adaptation.map).characters(&mut text, report);
    if let Some(program) = report.program {
        let _ = writeln!(
            text,
            "\n  program   {} {}: {} blocks; read back and simulated it is within {:.3} µm and {:.5} deg \
             of the adapted path",
            if program.written { "written to" } else { "not written to" },
            program.file,
            program.blocks,
            program.tip_mm * 1e3,
            program.axis_rad.to_degrees()
        );
    }
    text
}

fn registration_text(text: &mut String, report: &AdaptReport<'_>) {
    let r = &report.adaptation.field.registration;
    let _ = writeln!(text, "  how the blank lies             x          y          z");
    let row = |text: &mut String, name: &str, v: Vec3, u: Vec3, scale: f64| {
        let cells: Vec<String> =
            (0..3).map(|i| format!("{:>7.2} ± {:.2}", v[i] * scale, u[i] * scale)).collect();
        let _ = writeln!(text, "  {name:<22}{}", cells.join(" "));
    };
    row(text, "shift, µm", r.shift_mm(), r.u_shift_mm(), 1e3);
    row(text, "turn, µrad", r.turn_rad(), r.u_turn_rad(), 1e6);
    let c = centre(&r.freedoms.center_mm);
    let _ = writeln!(text, "  about ({c}) mm; ± standard uncertainty");
    for held in r.held_words() {
        let _ = writeln!(text, "  held at zero, since no reading tells: {held}");
    }
}

/// Without a minus before a zero.
pub(super) fn centre(c: &Vec3) -> String {
    let round = |v: f64| (v * 100.0).round() / 100.0 + 0.0;
    format!("{:.2} {:.2} {:.2}", round(c.x), round(c.y), round(c.z))
}

fn field_text(text: &mut String, report: &AdaptReport<'_>) {
    let (study, field) = (report.study, &report.adaptation.field);
    let how = if study.length_mm.is_some() { "stated" } else { "by cross-validation" };
    let _ = writeln!(
        text,
        "\n  form      {:.1} µm (standard deviation) over {:.1} mm ({how}), {} points, {} outliers",
        field.covariance.form_mm * 1e3,
        field.covariance.length_mm,
        study.points.len(),
        field.outliers.len()
    );
    let _ = writeln!(
        text,
        "  foretold  each point by all others: {:.2} µm rms; {:.1} % within U (k = 2)",
        field.left_out_rms_mm * 1e3,
        field.share_within(2.0) * 100.0
    );
    let moved = report.moved();
    let _ = writeln!(
        text,
        "  path      {} places, {} cut; moved by {:+.1} to {:+.1} µm along the normals, U (k = 2) up to \
         {:.1} µm",
        report.adaptation.places.len(),
        report.cut_places(),
        moved.min * 1e3,
        moved.max * 1e3,
        2.0 * report.most_u_mm() * 1e3
    );
}

fn walls_text(text: &mut String, report: &AdaptReport<'_>) {
    let wall = &report.study.wall;
    let _ = writeln!(
        text,
        "  wall      {} mm less a layer of {} mm, least {} mm; {}\n",
        wall.thickness_mm,
        wall.layer_mm,
        wall.least_mm,
        report.map_source()
    );
    let _ = writeln!(text, "  remaining wall, mm        least     mean     most   cut through");
    for (after, name) in [(false, "as programmed"), (true, "adapted")] {
        let s = report.walls(after);
        let _ = writeln!(
            text,
            "  {name:<20} {:>10.4} {:>8.4} {:>8.4}   {:>5} of {}",
            s.min,
            s.mean,
            s.max,
            report.through(after),
            report.adaptation.map.len()
        );
    }
}
