//! Two calibrations of one machine, as text and page.

use crate::verify::calibrations::{
    Calibrations, ErrorChange, Significance, Stated, TwoTemperatures,
};
use trueaxis_machine::Machine;
use trueaxis_machine::axis::Travel;
use trueaxis_machine::describe::{command_words, shown, unit};
use trueaxis_machine::errors::{ErrorKind, ErrorName};
use trueaxis_report::{Band, Picture, Report, Scatter, Section, Standing, Table};

/// At which temperatures two tables hold, and how they are compared.
fn temperature_words(two: &TwoTemperatures) -> String {
    let TwoTemperatures { error, old_celsius, new_celsius, expansion_per_k } = two;
    let from = (old_celsius * 100.0).round() / 100.0;
    let to = (new_celsius * 100.0).round() / 100.0;
    match expansion_per_k {
        Some(expansion) => format!(
            "the tables of {error} hold at {from} °C and {to} °C: the old one is compared at {to} °C, by {:.2} µm/(m·K)",
            expansion.value * 1e6
        ),
        None => format!(
            "the tables of {error} hold at {from} °C and {to} °C, and no expansion of the scale is stated: they are \
             compared as they are"
        ),
    }
}

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
            0 => "no error has changed by more than the uncertainty of the two calibrations"
                .to_owned(),
            1 => format!("{} has changed", names[0]),
            n => format!("{n} errors have changed: {}", names.join(", ")),
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
        lines.extend(self.found.temperatures.iter().map(temperature_words));
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

    fn errors(&self) -> Table {
        let changed = self.found.errors.iter().filter(|e| e.change() != Some(0.0));
        let rows = changed.map(|e| {
            let (unit, scale) = scale_of(e.error);
            let number =
                |v: Option<f64>| v.map_or("–".to_owned(), |v| format!("{:.2}", v * scale));
            [
                e.error.to_string(),
                unit.to_owned(),
                number(e.old),
                number(e.new),
                number(e.change()),
                number(e.u.map(|u| 2.0 * u)),
                e.e_n().map_or("–".to_owned(), |e_n| format!("{e_n:.2}")),
                self.place(e),
                words(e.moved).to_owned(),
            ]
        });
        let note = "where the change is clearest; U of the change, k = 2; significant: with 5 % of false alarms \
                    among all errors together; perhaps: E_n above 1";
        let headings = ["error", "unit", "old", "new", "change", "U", "E_n", "at", "significant"];
        Table::new(headings).rows(rows).note(note)
    }

    fn shares(&self) -> Table {
        let shares = self.found.tip.shares.iter().take(MOST_SHARES);
        let rows = shares.map(|s| [s.error.to_string(), format!("{:.2}", s.largest_mm * 1e3)]);
        let note = "largest displacement of the tip by the change of this error alone";
        Table::new(["error", "µm"]).rows(rows).note(note)
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
            let stated = Stated::of(&machine.bodies()[index.body], index.kind, index.component)?;
            let at = |i: usize| from + (to - from) * i as f64 / (PLACES - 1) as f64;
            let places = (0..PLACES).map(at).filter_map(|q| {
                let (value, u) = (stated.at(q, 0.0)?, stated.u_at(q).unwrap_or(0.0));
                Some((shown(axis, q), value * scale, 2.0 * u * scale))
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

fn words(moved: Significance) -> &'static str {
    match moved {
        Significance::Yes => "yes",
        Significance::Perhaps => "perhaps",
        Significance::No => "no",
        Significance::Unknown => "no u stated",
        Significance::New => "only in new",
        Significance::Gone => "only in old",
    }
}

fn scale_of(error: ErrorName) -> (&'static str, f64) {
    if error.component.is_rotation() { ("µrad", 1e6) } else { ("µm", 1e3) }
}

/// Two calibrations as text and page.
pub fn calibrations_report(report: &CalibrationsReport<'_>) -> Report<'static> {
    let (standing, word) = match report.found.moved().next() {
        None => (Standing::Good, "UNCHANGED"),
        Some(_) => (Standing::Bad, "CHANGED"),
    };
    let title = format!("{}: comparison of two calibrations", report.new.name());
    let answer = report.lines().into_iter().fold(Report::new(title), Report::line);
    answer
        .verdict(standing, word, report.verdict())
        .section(Section::new("The errors that changed").table(report.errors()))
        .section(Section::new("Effect on the tip").table(report.shares()))
        .sections(report.pictures().into_iter().map(Section::from))
}
