//! A path moved onto a probed blank, in text and on a page.

use super::adapt_maps::Layout;
use super::adapt_pictures::pictures;
use crate::compensate::adapt::{AdaptStudy, Adaptation, MapCell, MovedPlace};
use trueaxis_geometry::Vec3;
use trueaxis_report::{Columns, Report, Section, Standing, Table};

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
    /// Words of the path that can change motion, spindle or coolant and are not applied.
    pub not_applied: usize,
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

    /// Whether the path may be cut and its program, if one was asked for, was written.
    pub fn is_sound(&self) -> bool {
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

/// The answer.
pub fn adapt_report<'a>(r: &AdaptReport<'a>) -> Report<'a> {
    let (standing, word) = match (r.is_sound(), r.not_applied) {
        (true, 0) => (Standing::Good, "GOOD"),
        (true, _) => (Standing::Open, "NOT APPLIED"),
        (false, _) => (Standing::Bad, "NOT TO BE CUT"),
    };
    let words = match r.not_applied {
        0 => None,
        1 => Some("1 word of the path is not applied, listed above".to_owned()),
        n => Some(format!("{n} words of the path are not applied, listed above")),
    };
    let (study, path) = (r.study, r.study.path.name());
    let maps = Section::new("Form of the blank and distance from an equal layer").on_page();
    let [walls_before_after, others] = pictures(*r);
    let wall = Section::new("Remaining wall, place by place").on_page();
    let mut characters = String::new();
    Layout::of(&r.adaptation.map).characters(&mut characters, r);
    let on = format!("{path} on {}, moved onto the blank of {}", study.machine.name(), study.table);
    let lines = std::iter::once(on).chain(words);
    lines
        .fold(Report::new(&study.name), Report::line)
        .verdict(standing, word, r.verdict())
        .section(findings(r))
        .section(walls(r))
        .section(wall.note("Vermilion: cut through.").grid(Columns::AsFit, walls_before_after))
        .section(Section::new("").on_terminal().code(characters.trim_matches('\n')))
        .section(maps.grid(Columns::AsFit, others))
        .section(registration(r))
        .section(field(r))
        .section(program(r))
}

fn findings<'a>(r: &AdaptReport<'_>) -> Section<'a> {
    let rows = r.adaptation.findings.iter().map(|f| {
        let place = format!("{}:{}", r.study.path.name(), f.line);
        [f.code.to_owned(), f.places.to_string(), place, f.message.clone()]
    });
    let table = Table::new(["finding", "places", "worst at", "message"]);
    Section::new("Why it must not be cut").table(table.rows(rows))
}

fn walls<'a>(r: &AdaptReport<'_>) -> Section<'a> {
    let wall = &r.study.wall;
    let rows = [(false, "as programmed"), (true, "adapted")].map(|(after, name)| {
        let s = r.walls(after);
        let [min, mean, max] = [s.min, s.mean, s.max].map(|v| format!("{v:.4}"));
        let through = format!("{} of {}", r.through(after), r.adaptation.map.len());
        [name.to_owned(), min, mean, max, through]
    });
    let note = format!(
        "Wanted: {} mm less a layer of {} mm, least {} mm. Source: {}.",
        wall.thickness_mm,
        wall.layer_mm,
        wall.least_mm,
        r.map_source()
    );
    let table = Table::new(["wall, mm", "least", "mean", "most", "cut through"]);
    Section::new("Remaining wall").table(table.rows(rows).note(note))
}

fn registration<'a>(r: &AdaptReport<'_>) -> Section<'a> {
    let found = &r.adaptation.field.registration;
    let row = |name: &str, v: Vec3, u: Vec3, scale: f64| {
        let cell = |i: usize| format!("{:.2} ± {:.2}", v[i] * scale, u[i] * scale);
        [name.to_owned(), cell(0), cell(1), cell(2)]
    };
    let table = Table::new(["± standard uncertainty", "x", "y", "z"])
        .row(row("shift, µm", found.shift_mm(), found.u_shift_mm(), 1e3))
        .row(row("turn, µrad", found.turn_rad(), found.u_turn_rad(), 1e6))
        .note(format!("about ({}) mm", centre(&found.freedoms.center_mm)));
    let held = found.held_words().into_iter();
    let held = held.map(|held| format!("held at zero, since no reading determines it: {held}"));
    Section::new("Position of the blank").table(table).list(held)
}

/// Without a minus before a zero.
fn centre(c: &Vec3) -> String {
    let round = |v: f64| (v * 100.0).round() / 100.0 + 0.0;
    format!("{:.2} {:.2} {:.2}", round(c.x), round(c.y), round(c.z))
}

/// What the readings state of themselves.
fn stated_u(study: &AdaptStudy, common_mm: f64) -> String {
    let stated = || study.points.iter().filter_map(|p| p.u_mm);
    let noise = format!("{:.2} µm", study.noise_mm * 1e3);
    match (stated().reduce(f64::min), stated().reduce(f64::max)) {
        (Some(least), Some(most)) => format!(
            "{:.2} to {:.2} µm by the table, of it {:.2} µm in all of them alike; one hit {noise}",
            least * 1e3,
            most * 1e3,
            common_mm * 1e3
        ),
        _ => format!("{noise}: the noise of a hit; the table states none"),
    }
}

fn field<'a>(r: &AdaptReport<'_>) -> Section<'a> {
    let (study, field) = (r.study, &r.adaptation.field);
    let moved = r.moved();
    let length = if study.length_mm.is_some() { "stated" } else { "by cross-validation" };
    let pairs = [
        ("points", format!("{}, {} outliers", study.points.len(), field.outliers.len())),
        ("their standard uncertainty", stated_u(study, field.common_mm)),
        (
            "form",
            format!(
                "{:.1} µm (standard deviation) over {:.1} mm ({length})",
                field.covariance.form_mm * 1e3,
                field.covariance.length_mm
            ),
        ),
        (
            "each point predicted by all others",
            format!(
                "{:.2} µm rms; {:.1} % within U (k = 2)",
                field.left_out_rms_mm * 1e3,
                field.share_within(2.0) * 100.0
            ),
        ),
        (
            "path",
            format!(
                "{} places, {} cut; moved by {:+.1} to {:+.1} µm along the normals, U (k = 2) up to {:.1} µm",
                r.adaptation.places.len(),
                r.cut_places(),
                moved.min * 1e3,
                moved.max * 1e3,
                2.0 * r.most_u_mm() * 1e3
            ),
        ),
    ];
    let outliers = field.outliers.iter().map(|o| {
        let point = &study.points[o.index];
        let residual = format!("{:+.1}", o.residual_mm * 1e3);
        [point.number.to_string(), point.line.to_string(), residual]
    });
    let headings = ["outlier: point", "line", "off the others, µm"];
    Section::new("Form of the blank")
        .table(Table::pairs(pairs))
        .table(Table::new(headings).rows(outliers))
}

fn program<'a>(r: &AdaptReport<'_>) -> Section<'a> {
    let section = Section::new("Program");
    let Some(program) = r.program else { return section };
    section.paragraph(format!(
        "{} {}: {} blocks; read back and simulated it is within {:.3} µm and {:.5} deg of the adapted path",
        if program.written { "written to" } else { "not written to" },
        program.file,
        program.blocks,
        program.tip_mm * 1e3,
        program.axis_rad.to_degrees()
    ))
}
