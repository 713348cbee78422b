//! Two calibrations of one machine, as text, JSON and a page.

use crate::verify::calibrations::{Calibrations, ErrorChange, Moved};
use maud::html;
use serde_json::{Map, Value, json};
use std::fmt::Write as _;
use trueaxis_machine::Machine;
use trueaxis_machine::axis::Travel;
use trueaxis_machine::describe::{command_words, shown, unit};
use trueaxis_machine::errors::{ErrorKind, ErrorName};
use trueaxis_report::picture_page::{PicturePage, picture_page};
use trueaxis_report::{Band, Picture, Scatter};
use trueaxis_report::{Block, DrawingError, write_block};

/// Rows of the table of shares.
const MOST_SHARES: usize = 12;
/// Curves that the page shows.
const MOST_PICTURES: usize = 8;
/// Places of a curve.
const PLACES: usize = 121;

/// Two machine files and what is different between them.
pub struct CalibrationsReport<'a> {
    /// The older machine.
    pub old: &'a Machine,
    /// The newer one.
    pub new: &'a Machine,
    /// Their files, as the user named them.
    pub files: [&'a str; 2],
    /// What was found.
    pub found: &'a Calibrations,
}

impl CalibrationsReport<'_> {
    fn verdict(&self) -> String {
        let names: Vec<_> = self.found.moved().map(|e| e.error.to_string()).collect();
        match names.len() {
            0 => "nothing has moved beyond the uncertainty of the two calibrations".to_owned(),
            1 => format!("{} has moved", names[0]),
            n => format!("{n} errors have moved: {}", names.join(", ")),
        }
    }

    fn lines(&self) -> Vec<String> {
        let tip = &self.found.tip;
        let mut lines = vec![
            format!("old: {}, new: {}", self.files[0], self.files[1]),
            format!("chain {}", self.old.chain_text()),
            format!(
                "the tip moves by {:.1} ± {:.1} µm at most (k = 2), rms {:.1} µm over {} poses; the tool \
                 axis by {:.1} µrad",
                tip.largest_mm * 1e3,
                2.0 * tip.u_mm * 1e3,
                tip.rms_mm * 1e3,
                tip.poses,
                tip.axis_rad * 1e6
            ),
        ];
        if tip.largest_mm > 0.0 {
            lines.push(format!("most at {}", command_words(self.old.axes(), &tip.at)));
        }
        if tip.nominal_mm > 1e-9 {
            lines.push(format!(
                "the nominal machines differ too, by up to {:.4} mm at the tip: placements, workpiece or tool; \
                 errors refer to another nominal machine in each file",
                tip.nominal_mm
            ));
        }
        lines
    }

    fn place(&self, change: &ErrorChange) -> String {
        let axis = self.old.axes().iter().find(|a| a.name == change.error.body);
        let side = match change.approach {
            a if a > 0.0 => " ↑",
            a if a < 0.0 => " ↓",
            _ => "",
        };
        match (change.at, axis) {
            (Some(q), Some(axis)) => {
                format!("{} {:.1} {}{side}", axis.name, shown(axis, q) + 0.0, unit(axis))
            }
            _ => "–".to_owned(),
        }
    }

    fn blocks(&self) -> [Block; 2] {
        let headings = ["error", "unit", "old", "new", "change", "U", "E_n", "at", "moved"];
        let note = "where the change is clearest; U of the change, k = 2; moved: beyond what chance does \
                    anywhere among all errors (5 %); perhaps: E_n above 1";
        let mut errors = Block::new("The errors that changed", note, &headings);
        let changed = |e: &&ErrorChange| e.change() != Some(0.0);
        for e in self.found.errors.iter().filter(changed) {
            let (unit, scale) = scale_of(e.error);
            let number =
                |v: Option<f64>| v.map_or("–".to_owned(), |v| format!("{:.2}", v * scale));
            errors.rows.push(vec![
                e.error.to_string(),
                unit.to_owned(),
                number(e.old),
                number(e.new),
                number(e.change()),
                number(e.u.map(|u| 2.0 * u)),
                e.e_n().map_or("–".to_owned(), |e_n| format!("{e_n:.2}")),
                self.place(e),
                words(e.moved).to_owned(),
            ]);
        }
        let note = "how far the change of this error alone moves the tip at most";
        let mut shares = Block::new("What it does to the tip", note, &["error", "µm"]);
        for share in self.found.tip.shares.iter().take(MOST_SHARES) {
            shares
                .rows
                .push(vec![share.error.to_string(), format!("{:.2}", share.largest_mm * 1e3)]);
        }
        [errors, shares]
    }

    /// Old and new curve of the error motions that moved, with U.
    fn pictures(&self) -> Vec<Picture> {
        let motions = self.found.moved().filter(|e| e.error.kind == ErrorKind::Motion);
        motions.take(MOST_PICTURES).filter_map(|e| self.picture(e.error)).collect()
    }

    fn picture(&self, error: ErrorName) -> Option<Picture> {
        let index = self.old.error_index(error)?;
        let axis = self.old.axes().iter().find(|a| a.name == error.body)?;
        let Travel::Between(from, to) = axis.travel else { return None };
        let (unit_of_error, scale) = scale_of(error);
        let curve = |machine: &Machine, label: &str, colour| {
            let stated = machine.bodies()[index.body].stated(index.kind, index.component)?;
            let at = |i: usize| from + (to - from) * i as f64 / (PLACES - 1) as f64;
            let places = (0..PLACES).map(at).filter_map(|q| {
                let value = stated.at(q, 0.0).ok()?;
                Some((shown(axis, q), value * scale, 2.0 * stated.u_at(q) * scale))
            });
            let (label, points) = (label.to_owned(), Vec::new());
            Some(Band { label, colour, line: places.collect(), points })
        };
        let bands = [curve(self.old, "old", 0)?, curve(self.new, "new", 1)?];
        Some(Picture::Scatter(Scatter {
            title: error.to_string(),
            note: "mean of both directions; band: U, k = 2".to_owned(),
            x: format!("{} ({})", axis.name, unit(axis)),
            y: unit_of_error.to_owned(),
            from_zero: true,
            bands: bands.into(),
            dashed: Vec::new(),
        }))
    }
}

fn words(moved: Moved) -> &'static str {
    match moved {
        Moved::Yes => "yes",
        Moved::Perhaps => "perhaps",
        Moved::No => "no",
        Moved::Unknown => "no u stated",
        Moved::New => "only in new",
        Moved::Gone => "only in old",
    }
}

fn scale_of(error: ErrorName) -> (&'static str, f64) {
    if error.component.is_rotation() { ("µrad", 1e6) } else { ("µm", 1e3) }
}

/// For the terminal.
pub fn calibrations_text(report: &CalibrationsReport<'_>) -> String {
    let mut out = format!("{}\n", report.new.name());
    // Writing into a text cannot fail.
    for line in report.lines() {
        let _ = writeln!(out, "  {line}");
    }
    for block in report.blocks().iter().filter(|b| !b.rows.is_empty()) {
        let _ = write_block(&mut out, block);
    }
    let _ = writeln!(out, "\n{}", report.verdict());
    out
}

/// The document `trueaxis/diff/1`.
pub fn calibrations_json(report: &CalibrationsReport<'_>) -> Value {
    let (old, found) = (report.old, report.found);
    let errors = found.errors.iter().map(|e| {
        let rotation = e.error.component.is_rotation();
        let scale = scale_of(e.error).1;
        let scaled = |v: Option<f64>| v.map(|v| v * scale);
        let axis = old.axes().iter().find(|a| a.name == e.error.body);
        let at = e.at.zip(axis).map(|(q, axis)| json!({ "axis": axis.name.to_string(), "position": shown(axis, q), "unit": unit(axis), "approach": e.approach }));
        json!({
            "error": e.error.to_string(),
            "unit": if rotation { "urad" } else { "um" },
            "old": scaled(e.old),
            "new": scaled(e.new),
            "change": scaled(e.change()),
            "rms_change": e.rms * scale,
            "u_change": scaled(e.u),
            "E_n": e.e_n(),
            "at": at,
            "moved": e.moved.key(),
        })
    });
    let tip = &found.tip;
    let at = old.axes().iter().zip(&tip.at);
    let at: Map<String, Value> =
        at.map(|(a, q)| (a.name.to_string(), json!(shown(a, *q)))).collect();
    let shares = tip
        .shares
        .iter()
        .map(|s| json!({ "error": s.error.to_string(), "largest_um": s.largest_mm * 1e3 }));
    json!({
        "schema": "trueaxis/diff/1",
        "version": trueaxis_report::VERSION,
        "machine": report.new.name(),
        "chain": old.chain_text(),
        "old": report.files[0],
        "new": report.files[1],
        "moved": found.moved().map(|e| e.error.to_string()).collect::<Vec<_>>(),
        "limit_u": found.limit,
        "errors": errors.collect::<Vec<_>>(),
        "tip": {
            "poses": tip.poses,
            "largest_um": tip.largest_mm * 1e3,
            "u_um": tip.u_mm * 1e3,
            "at": at,
            "rms_um": tip.rms_mm * 1e3,
            "axis_largest_urad": tip.axis_rad * 1e6,
            "nominal_difference_mm": tip.nominal_mm,
            "shares": shares.collect::<Vec<_>>(),
        },
    })
}

/// The page.
///
/// # Errors
/// What the drawing library says.
pub fn calibrations_html(report: &CalibrationsReport<'_>) -> Result<String, DrawingError> {
    let class = if report.found.moved().next().is_none() { "verdict pass" } else { "verdict fail" };
    picture_page(&PicturePage {
        title: &format!("{}: what moved", report.new.name()),
        lines: &report.lines(),
        verdict: Some(html! { section class=(class) { strong { (report.verdict()) } } }),
        blocks: &report.blocks(),
        pictures: &report.pictures(),
    })
}
