//! The machine file with the errors that were found.
//!
//! The text of the file stays as it is, comments too; only the lines of the unknown errors
//! change: what was found gets its value, what is not observable or not supported by the readings
//! becomes a comment. The file is read back before anybody gets it.

use super::errors::Identification;
use nalgebra::DMatrix;
use std::collections::BTreeMap;
use trueaxis_input::Severity;
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{AxisKind, MAX_AXES};
use trueaxis_machine::describe::lines::Lines;
use trueaxis_machine::describe::replacement::{
    Entry, curve_text, keep_table_temperatures, measured_and_closed, measured_in_place_of, plain,
    put, take_out_of_table,
};
use trueaxis_machine::errors::{ErrorKind, ErrorName, StatedError};
use trueaxis_machine::file::Tables;
use trueaxis_measure::measure::Campaign;
use trueaxis_measure::unknowns::term::{Term, stated};

/// A machine file and the tables that it names.
#[derive(Debug, Clone, PartialEq)]
pub struct MachineFile {
    /// The text.
    pub text: String,
    /// Name and text of tables that were made for it.
    pub tables: Vec<(String, String)>,
}

/// Puts what was found into the text of the machine file.
///
/// # Errors
/// In words, why the file cannot be edited.
pub fn machine_file(
    campaign: &Campaign,
    found: &Identification,
    date: Option<&str>,
    old: &str,
    beside: &dyn Tables,
) -> Result<MachineFile, String> {
    let mut tables = Vec::new();
    let mut file = Lines::of(old);
    let origin = format!("identified with {}", origin(campaign, date));
    for (name, terms) in unknowns(campaign, found) {
        let entry = entry((campaign, found), (name, &terms), &origin, &mut tables);
        take_out_of_table(&mut file, name, &origin, &mut tables, beside);
        put(&mut file, name, &entry, &origin);
    }
    keep_table_temperatures(&mut file, old, &tables, beside, &origin)?;
    let text = file.text();
    read_back(found, &text, &tables, beside)?;
    Ok(MachineFile { text, tables })
}

pub(super) fn one_line(text: &str) -> String {
    text.replace(['\n', '\r'], " ")
}

/// Instruments, campaign and date: `probe-ball (my mill, 2026-01-31)`.
pub(super) fn origin(campaign: &Campaign, date: Option<&str>) -> String {
    let mut names: Vec<&str> = campaign.instruments.iter().map(|i| i.kind.name()).collect();
    names.dedup();
    format!(
        "{} ({}{})",
        names.join(", "),
        one_line(&campaign.name),
        date.map(|d| format!(", {}", one_line(d))).unwrap_or_default()
    )
}

/// Every unknown error, with the terms of the result and their numbers.
fn unknowns(
    campaign: &Campaign,
    found: &Identification,
) -> BTreeMap<ErrorName, Vec<(usize, Term)>> {
    let mut all: BTreeMap<ErrorName, Vec<(usize, Term)>> = BTreeMap::new();
    let is_made = |term: &Term| !term.basis.is_servo();
    for term in campaign.terms.iter().filter(|t| is_made(t)) {
        all.entry(term.error).or_default();
    }
    for (k, term) in found.design.terms.iter().enumerate().filter(|(_, t)| is_made(t)) {
        all.entry(term.error).or_default().push((k, *term));
    }
    all
}

/// Whether the file states an unknown of the machine: all terms of its error are observable.
pub(super) fn is_stated(found: &Identification, unknown: usize) -> bool {
    let terms = &found.design.terms;
    let is_same =
        |k: &usize| !terms[*k].basis.is_servo() && terms[*k].error == terms[unknown].error;
    (0..terms.len()).filter(is_same).all(|k| found.found[k].value.is_some())
}

fn entry(
    (campaign, found): (&Campaign, &Identification),
    (name, terms): (ErrorName, &[(usize, Term)]),
    origin: &str,
    tables: &mut Vec<(String, String)>,
) -> Entry {
    if terms.is_empty() {
        return Entry::Nothing("not supported by the readings".to_owned());
    }
    let values: Option<Vec<(Term, f64)>> = terms
        .iter()
        .map(|(k, term)| found.found[*k].value.map(|(value, _)| (*term, value)))
        .collect();
    let Some(values) = values else {
        return Entry::Nothing("not observable with these readings".to_owned());
    };
    let angle = name.component.is_rotation();
    if name.kind == ErrorKind::Location {
        let u = found.found[terms[0].0].value.map_or(0.0, |(_, u)| u);
        let scale = if angle { 1e6 } else { 1e3 };
        let unit = if angle { "urad" } else { "um" };
        let value = plain(values[0].1 * scale);
        return Entry::Value(format!("\"{value} ± {} {unit}\"", plain(u * scale)));
    }
    let u = largest_u(found.reach, &found.fit.covariance, terms);
    let measured = measured_of(&campaign.machine, name, origin);
    let is_rotary =
        terms[0].1.axis.is_some_and(|i| campaign.machine.axes()[i].kind == AxisKind::Rotary);
    Entry::Value(curve_text(name, is_rotary, &stated(&values, None), u, tables) + &measured)
}

/// The end of the text of a curve that was found: with which instruments, and at which temperature it holds.
pub(super) fn measured_of(machine: &Machine, name: ErrorName, origin: &str) -> String {
    measured_and_closed(&measured_in_place_of(stated_in(machine, name), origin))
}

/// What a machine states of an error.
pub(super) fn stated_in(machine: &Machine, name: ErrorName) -> Option<&StatedError> {
    let index = machine.error_index(name)?;
    machine.bodies()[index.body].stated(index.kind, index.component)
}

/// The greatest standard uncertainty of one error over the reach of its axis, from the covariance of its terms.
pub(super) fn largest_u(
    reach: [[f64; 2]; MAX_AXES],
    all: &DMatrix<f64>,
    terms: &[(usize, Term)],
) -> f64 {
    let axis = terms.first().and_then(|(_, term)| term.axis);
    let [low, high] = axis.map_or([0.0; 2], |axis| reach[axis]);
    let at = |q: f64| {
        let mut command = [0.0; 6];
        if let Some(axis) = axis {
            command[axis] = q;
        }
        let side = [0.0; 6];
        let phi: Vec<f64> = terms.iter().map(|(_, t)| t.value(&command, &side)).collect();
        let covariance = |a: usize, b: usize| all[(terms[a].0, terms[b].0)];
        let pairs = (0..phi.len()).flat_map(|a| (0..phi.len()).map(move |b| (a, b)));
        pairs.map(|(a, b)| phi[a] * phi[b] * covariance(a, b)).sum::<f64>().max(0.0).sqrt()
    };
    (0..=40).map(|i| at(low + (high - low) * f64::from(i) / 40.0)).fold(0.0, f64::max)
}

/// The text reads as a machine that has the errors that were found.
fn read_back(
    found: &Identification,
    text: &str,
    tables: &[(String, String)],
    beside: &dyn Tables,
) -> Result<(), String> {
    struct With<'a>(&'a [(String, String)], &'a dyn Tables);
    impl Tables for With<'_> {
        fn text(&self, name: &str) -> Result<String, String> {
            match self.0.iter().find(|(n, _)| n == name) {
                Some((_, text)) => Ok(text.clone()),
                None => self.1.text(name),
            }
        }
        fn display(&self, name: &str) -> String {
            self.1.display(name)
        }
    }
    let machine = machine_of(text, &With(tables, beside))?;
    for (k, term) in found.design.terms.iter().enumerate() {
        let Some((value, _)) = found.found[k].value else { continue };
        if term.error.kind != ErrorKind::Location {
            continue;
        }
        check_location(&machine, term.error, value)?;
    }
    Ok(())
}

/// Puts location errors (mm, rad) with their standard uncertainties into the text of a machine file.
///
/// # Errors
/// In words, why the new text is no machine file with these errors.
pub fn with_locations(
    old: &str,
    errors: &[(ErrorName, f64, f64)],
    origin: &str,
    beside: &dyn Tables,
) -> Result<String, String> {
    let mut file = Lines::of(old);
    let origin = one_line(origin);
    for (name, value, u) in errors {
        let (scale, unit) = if name.component.is_rotation() { (1e6, "urad") } else { (1e3, "um") };
        let text = format!("\"{} ± {} {unit}\"", plain(value * scale), plain(u * scale));
        put(&mut file, *name, &Entry::Value(text), &origin);
    }
    let text = file.text();
    let machine = machine_of(&text, beside)?;
    for (name, value, _) in errors {
        check_location(&machine, *name, *value)?;
    }
    Ok(text)
}

fn machine_of(text: &str, beside: &dyn Tables) -> Result<Machine, String> {
    let (machine, problems) = Machine::check("the new machine file", text, beside);
    machine.filter(|_| !problems.has_errors()).ok_or_else(|| {
        let first = problems.iter().find(|d| d.severity == Severity::Error);
        first.map_or_else(String::new, |d| d.message.clone())
    })
}

/// `Err`: a location error is read as another value.
fn check_location(machine: &Machine, name: ErrorName, value: f64) -> Result<(), String> {
    let read = stated_in(machine, name).and_then(|s| s.at(0.0, 0.0).ok()).unwrap_or(f64::NAN);
    match (read - value).abs() <= 2e-9 {
        true => Ok(()),
        false => Err(format!("{name} would be read as another value")),
    }
}
