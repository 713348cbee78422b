//! Readings in the forms of others: each becomes the table that the standards read, with every row on
//! its own line of the source, so that a problem is reported with that line.
//!
//! A new form is a variant of [`Import`] and a file here; docs/decisions/0010-importers.md.

mod ecmc;
mod qif;
mod rtl;

use crate::conditions::{Circle, Conditions};
use crate::{Evaluated, Standard};
use std::borrow::Cow;
use std::path::Path;
use trueaxis_input::foreign::{self, Beside, Mapping};
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
    /// A laser file of Renishaw.
    RenishawRtl,
}

impl Import {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Csv, Self::Qif, Self::EcmcMarkdown, Self::RenishawRtl];

    /// The name on the command line.
    pub fn key(self) -> &'static str {
        match self {
            Self::Csv => "csv",
            Self::Qif => "qif",
            Self::EcmcMarkdown => "ecmc-md",
            Self::RenishawRtl => "rtl",
        }
    }

    /// Its name in text output.
    pub fn title(self) -> &'static str {
        match self {
            Self::Csv => {
                "a table with headings in one of five languages, or read by a mapping file"
            }
            Self::Qif => "QIF 3 (ISO 23952), points measured on features",
            Self::EcmcMarkdown => "Markdown report of the ECMC motion test",
            Self::RenishawRtl => "Renishaw laser file (.rtl, .rta)",
        }
    }

    /// The form that belongs to the extension of a file.
    pub fn of(path: &Path) -> Self {
        let ending = path.extension().unwrap_or_default().to_string_lossy().to_ascii_lowercase();
        match &*ending {
            "qif" | "xml" => Self::Qif,
            "md" => Self::EcmcMarkdown,
            "rtl" | "rta" => Self::RenishawRtl,
            _ => Self::Csv,
        }
    }

    /// Reads a text. `None` with errors in `problems`.
    pub fn read<'t>(self, source: &From<'t>, problems: &mut Diagnostics) -> Option<Imported<'t>> {
        let From { standard, file, text, feature, mapping } = *source;
        let imported = match self {
            Self::Csv => table(file, text, mapping, problems),
            Self::Qif => qif::read(standard, file, text, feature, problems),
            Self::EcmcMarkdown => ecmc::read(standard, file, text, problems),
            Self::RenishawRtl => rtl::read(standard, file, text, problems),
        };
        let mut idle = |argument: &str, hint: &str| {
            let message = format!("`{argument}` does not apply to {}", self.title());
            problems.warn("unused-argument", Place::whole(argument), message, hint);
        };
        if feature.is_some() && self != Self::Qif {
            idle("--feature", "only QIF files have features; leave it out");
        }
        if mapping.is_some() && self != Self::Csv {
            idle("--map", "only tables have columns; leave it out, or --import csv");
        }
        imported
    }
}

/// A text to be read.
#[derive(Debug, Clone, Copy)]
pub struct From<'a> {
    /// For which standard.
    pub standard: Standard,
    /// The file, as the user named it.
    pub file: &'a str,
    /// Its text.
    pub text: &'a str,
    /// Which of several features of a form that has them.
    pub feature: Option<&'a str>,
    /// Which column is what, where the headings do not say it.
    pub mapping: Option<&'a Mapping>,
}

/// A table: our own form as it is, any other by its mapping file or its headings.
fn table<'t>(
    file: &str,
    text: &'t str,
    mapping: Option<&Mapping>,
    problems: &mut Diagnostics,
) -> Option<Imported<'t>> {
    let table = match mapping {
        Some(mapping) => Cow::Owned(mapping.read(file, text, problems)?),
        None if foreign::is_ours(text) => Cow::Borrowed(text),
        None => Cow::Owned(foreign::read(file, text, problems)?),
    };
    Some(Imported { table, ..Imported::default() })
}

/// Only standards of positioning evaluate positions along one axis, which this file holds.
fn one_axis_only(
    standard: Standard,
    what: &str,
    file: &str,
    problems: &mut Diagnostics,
) -> Option<()> {
    let positioning =
        [Standard::Iso230_2, Standard::Gbt17421_2, Standard::Vdi3441, Standard::B5_54];
    if positioning.contains(&standard) {
        return Some(());
    }
    let message = format!("{what} cannot be evaluated by {}", standard.key());
    let hint = "it has targets, runs and directions: use iso230-2";
    problems.error("no-such-readings", Place::whole(file), message, hint);
    None
}

/// What the source says of its readings.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
struct About {
    machine: Option<String>,
    axis: Option<String>,
    date: Option<String>,
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
    about: About,
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
            ..stated.circle
        };
        let or = |stated: &Option<String>, found: &Option<String>| stated.clone().or(found.clone());
        Conditions {
            circle,
            machine: or(&stated.machine, &self.about.machine),
            axis: or(&stated.axis, &self.about.axis),
            date: or(&stated.date, &self.about.date),
            ..stated.clone()
        }
    }

    /// Removes from the result what such readings cannot determine, and reports which printed results of the
    /// source are not those of the standard.
    pub fn finish(&self, evaluated: &mut Evaluated, file: &str, problems: &mut Diagnostics) {
        if let (Evaluated::Circular(circle), true) = (&mut *evaluated, self.of_a_part) {
            circle.causes = None;
            circle.diagnosis = None;
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
