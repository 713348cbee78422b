//! Readings in the forms of others: each becomes the table that the standards read, with every row on
//! its own line of the source, so that a problem is reported with that line.
//!
//! A new form is a variant of [`Import`] and a file here; docs/decisions/0010-importers.md.

mod ecmc;
mod qif;

use crate::conditions::{Circle, Conditions};
use crate::{Evaluated, Standard};
use std::borrow::Cow;
use std::path::Path;
use trueaxis_input::{Diagnostics, Place};

/// A form of readings.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Import {
    /// A table with one line of headings: what everybody can write.
    Csv,
    /// QIF 3 (ISO 23952): points measured on features of a part.
    Qif,
    /// The Markdown report of the ECMC motion test scripts (positions by target, run and direction).
    EcmcMarkdown,
}

impl Import {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Csv, Self::Qif, Self::EcmcMarkdown];

    /// The name on the command line.
    pub fn key(self) -> &'static str {
        match self {
            Self::Csv => "csv",
            Self::Qif => "qif",
            Self::EcmcMarkdown => "ecmc-md",
        }
    }

    /// Its name in text output.
    pub fn title(self) -> &'static str {
        match self {
            Self::Csv => "a table with one line of headings, each with its unit",
            Self::Qif => "QIF 3 (ISO 23952), points measured on features",
            Self::EcmcMarkdown => "Markdown report of the ECMC motion test",
        }
    }

    /// The form that belongs to the extension of a file.
    pub fn of(path: &Path) -> Self {
        let ending = path.extension().unwrap_or_default().to_string_lossy().to_ascii_lowercase();
        match &*ending {
            "qif" | "xml" => Self::Qif,
            "md" => Self::EcmcMarkdown,
            _ => Self::Csv,
        }
    }

    /// Reads a text; `feature` chooses one of several where the form has them. `None` with errors in
    /// `problems`.
    pub fn read<'t>(
        self,
        standard: Standard,
        file: &str,
        text: &'t str,
        feature: Option<&str>,
        problems: &mut Diagnostics,
    ) -> Option<Imported<'t>> {
        let imported = match self {
            Self::Csv => Some(Imported { table: Cow::Borrowed(text), ..Imported::default() }),
            Self::Qif => qif::read(standard, file, text, feature, problems),
            Self::EcmcMarkdown => ecmc::read(standard, file, text, problems),
        };
        if feature.is_some() && self != Self::Qif {
            let message = format!("`--feature` does not apply to {}", self.title());
            let hint = "only QIF files have features; leave it out";
            problems.warn("unused-argument", Place::whole("--feature"), message, hint);
        }
        imported
    }
}

/// A figure that the source prints of itself.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Printed {
    /// Its name there.
    theirs: &'static str,
    quantity: crate::iso230_2::Quantity,
    value_mm: f64,
    line: usize,
}

/// Readings that were read.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Imported<'t> {
    table: Cow<'t, str>,
    circle: Circle,
    printed: Vec<Printed>,
    /// Touched on a part: no machine has moved along these points.
    of_a_part: bool,
}

impl Imported<'_> {
    /// The table that the standards read.
    pub fn table(&self) -> &str {
        &self.table
    }

    /// The conditions of the readings; what the user wrote has priority over the source.
    pub fn conditions(&self, stated: &Conditions) -> Conditions {
        let circle = Circle {
            centre_mm: stated.circle.centre_mm.or(self.circle.centre_mm),
            radius_mm: stated.circle.radius_mm.or(self.circle.radius_mm),
        };
        Conditions { circle, ..stated.clone() }
    }

    /// Removes from the result what such readings cannot determine, and reports which printed results of the
    /// source are not those of the standard.
    pub fn finish(&self, evaluated: &mut Evaluated, file: &str, problems: &mut Diagnostics) {
        if let (Evaluated::Circular(circle), true) = (&mut *evaluated, self.of_a_part) {
            circle.causes = None;
        }
        let Evaluated::Positioning(_, ours) = evaluated else { return };
        let mut agree = 0;
        for printed in &self.printed {
            let Some(ours_mm) = ours.value(printed.quantity) else { continue };
            // Printed to 0.01 µm, from means and deviations that were rounded to that too.
            if (ours_mm - printed.value_mm).abs() < PRINTED_MM {
                agree += 1;
                continue;
            }
            let place = Place { file: file.to_owned(), line: printed.line, column: 1 };
            let message = format!(
                "the report prints {} = {:.2} µm; by ISO 230-2:2014 {} is {:.2} µm",
                printed.theirs,
                printed.value_mm * 1e3,
                printed.quantity.symbol(),
                ours_mm * 1e3
            );
            problems.warn("not-by-the-standard", place, message, ecmc::reason(printed.quantity));
        }
        if agree > 0 {
            let message = format!(
                "{agree} of {} printed results are those of ISO 230-2:2014 within {} µm",
                self.printed.len(),
                PRINTED_MM * 1e3
            );
            problems.note("printed-figures", Place::whole(file), message, "");
        }
    }
}

/// Printed parameters are rounded, mm.
const PRINTED_MM: f64 = 2e-5;

/// A table that is written line by line with its source.
#[derive(Debug, Default)]
struct Beside {
    text: String,
    lines: usize,
}

impl Beside {
    /// Puts a row on a line of the source, or on the next that is free.
    fn row(&mut self, line: usize, row: &str) {
        while self.lines + 1 < line {
            self.text.push('\n');
            self.lines += 1;
        }
        self.text += row;
        self.text.push('\n');
        self.lines += 1;
    }
}
