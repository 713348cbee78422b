//! The machine file with the errors that were found.
//!
//! The text of the file stays as it is, comments too; only the lines of the errors that were sought
//! change: what was found gets its value, what cannot be told or is not supported by the readings
//! becomes a comment. The file is read back before anybody gets it.

mod columns;

use super::errors::Identification;
use crate::measure::Campaign;
use crate::unknowns::term::{Term, stated};
use std::collections::BTreeMap;
use std::fmt::Write as _;
use trueaxis_input::Diagnostic;
use trueaxis_machine::Machine;
use trueaxis_machine::axis::AxisKind;
use trueaxis_machine::describe::lines::{Lines, header};
use trueaxis_machine::errors::{Curve, ErrorKind, ErrorName};
use trueaxis_machine::file::Tables;

/// A machine file and the tables that stand beside it.
#[derive(Debug, Clone, PartialEq)]
pub struct MachineFile {
    /// The text.
    pub text: String,
    /// Name and text of tables that were made for it.
    pub tables: Vec<(String, String)>,
}

/// What is written of one error.
enum Entry {
    Value(String),
    Nothing(String),
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
    let instruments: Vec<&str> = campaign.instruments.iter().map(|i| i.kind.name()).collect();
    let mut names = instruments.clone();
    names.dedup();
    let origin = format!(
        "identified with {} ({}{})",
        names.join(", "),
        one_line(&campaign.name),
        date.map(|d| format!(", {}", one_line(d))).unwrap_or_default()
    );
    for (name, terms) in sought(campaign, found) {
        let entry = entry((campaign, found), (name, &terms), &origin, &mut tables);
        take_out_of_table(&mut file, name, &origin, &mut tables, beside);
        put(&mut file, name, &entry, &origin);
    }
    let text = file.text();
    read_back(found, &text, &tables, beside)?;
    Ok(MachineFile { text, tables })
}

fn one_line(text: &str) -> String {
    text.replace(['\n', '\r'], " ")
}

/// Every error that was sought, with the terms of the result and their numbers.
fn sought(campaign: &Campaign, found: &Identification) -> BTreeMap<ErrorName, Vec<(usize, Term)>> {
    let mut all: BTreeMap<ErrorName, Vec<(usize, Term)>> = BTreeMap::new();
    for term in &campaign.terms {
        all.entry(term.error).or_default();
    }
    for (k, term) in found.design.terms.iter().enumerate() {
        all.entry(term.error).or_default().push((k, *term));
    }
    all
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
        return Entry::Nothing("cannot be told from others by these readings".to_owned());
    };
    let angle = name.component.is_rotation();
    if name.kind == ErrorKind::Location {
        let u = found.found[terms[0].0].value.map_or(0.0, |(_, u)| u);
        let scale = if angle { 1e6 } else { 1e3 };
        let unit = if angle { "urad" } else { "um" };
        let value = plain(values[0].1 * scale);
        return Entry::Value(format!("\"{value} ± {} {unit}\"", plain(u * scale)));
    }
    let u = curve_u(found, terms);
    let measured = format!(", measured = {{ instrument = {origin:?} }} }}");
    Entry::Value(curve_text(campaign, name, &values, u, tables) + &measured)
}

/// The greatest standard uncertainty of a curve over its axis.
fn curve_u(found: &Identification, terms: &[(usize, Term)]) -> f64 {
    let Some(axis) = terms[0].1.axis else { return 0.0 };
    let [low, high] = found.reach[axis];
    let at = |q: f64| {
        let mut command = [0.0; 6];
        command[axis] = q;
        let side = [0.0; 6];
        let phi: Vec<f64> = terms.iter().map(|(_, t)| t.value(&command, &side)).collect();
        let covariance = |a: usize, b: usize| found.fit.covariance[(terms[a].0, terms[b].0)];
        let pairs = (0..phi.len()).flat_map(|a| (0..phi.len()).map(move |b| (a, b)));
        pairs.map(|(a, b)| phi[a] * phi[b] * covariance(a, b)).sum::<f64>().max(0.0).sqrt()
    };
    let most = (0..=40).map(|i| at(low + (high - low) * f64::from(i) / 40.0)).fold(0.0, f64::max);
    most * found.birge
}

fn curve_text(
    campaign: &Campaign,
    name: ErrorName,
    values: &[(Term, f64)],
    u: f64,
    tables: &mut Vec<(String, String)>,
) -> String {
    let angle = name.component.is_rotation();
    let (scale, unit) = if angle { (1e6, "urad") } else { (1e3, "um") };
    let axis = values[0].0.axis.map(|i| campaign.machine.axes()[i].kind);
    let (position, shown) = match axis {
        Some(AxisKind::Rotary) => ("deg", 1f64.to_degrees()),
        _ => ("mm", 1.0),
    };
    let quantity = |v: f64| format!("\"{} {unit}\"", plain(v * scale));
    let stated = stated(values, None);
    let mut text = match &stated.mean {
        Curve::Constant(c) => format!("{{ constant = {}", quantity(*c)),
        Curve::Polynomial { coefficients, origin, scale } => {
            let list: Vec<String> = coefficients.iter().map(|c| quantity(*c)).collect();
            let (origin, length) = (origin * shown, scale * shown);
            format!(
                "{{ polynomial = [{}], origin = \"{origin} {position}\", \
                 scale = \"{length} {position}\"",
                list.join(", ")
            )
        }
        Curve::Fourier { mean, terms } => {
            let harmonic = |h: &trueaxis_machine::errors::Harmonic| {
                format!("[{}, {}, {}]", h.order, quantity(h.cosine), quantity(h.sine))
            };
            let list: Vec<String> = terms.iter().map(harmonic).collect();
            format!("{{ fourier = {{ mean = {}, terms = [{}] }}", quantity(*mean), list.join(", "))
        }
        Curve::Table { spline, .. } => {
            let file = format!("identified-{name}.csv");
            let mut table = format!("# {name}, identified\nposition_{position},{name}_{unit}\n");
            for at in spline.knots() {
                let value = plain(spline.at(*at) * scale);
                // Writing into a text cannot fail.
                let _ = writeln!(table, "{},{value}", at * shown);
            }
            tables.push((file.clone(), table));
            format!("{{ table = \"{file}\", interpolation = \"linear\", outside = \"clamp\"")
        }
    };
    if let Some(Curve::Constant(reversal)) = stated.reversal {
        let _ = write!(text, ", reversal = {}", quantity(reversal));
    }
    let _ = write!(text, ", u = {}", quantity(u));
    text
}

/// Six decimals of µm or µrad are a picometre.
fn plain(value: f64) -> String {
    let text = format!("{value:.6}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
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
    let (machine, problems) = Machine::check("the new machine file", text, &With(tables, beside));
    let Some(machine) = machine.filter(|_| !problems.has_errors()) else {
        let first = problems.iter().find(|d| d.severity == trueaxis_input::Severity::Error);
        return Err(first.map_or_else(String::new, |d| d.message.clone()));
    };
    for (k, term) in found.design.terms.iter().enumerate() {
        let Some((value, _)) = found.found[k].value else { continue };
        if term.error.kind != ErrorKind::Location {
            continue;
        }
        let read =
            machine.bodies()[term.index.body].stated(ErrorKind::Location, term.index.component);
        let read = read.and_then(|s| s.at(0.0, 0.0).ok()).unwrap_or(f64::NAN);
        if (read - value).abs().is_nan() || (read - value).abs() > 2e-9 {
            return Err(format!("{} would be read as another value", term.error));
        }
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
    let (machine, problems) = Machine::check("the new machine file", &text, beside);
    let Some(machine) = machine.filter(|_| !problems.has_errors()) else {
        let is_error = |d: &&Diagnostic| d.severity == trueaxis_input::Severity::Error;
        return Err(problems.iter().find(is_error).map_or_else(String::new, |d| d.message.clone()));
    };
    for (name, value, _) in errors {
        let index = machine.error_index(*name);
        let stated =
            index.and_then(|i| machine.bodies()[i.body].stated(ErrorKind::Location, i.component));
        let read = stated.and_then(|s| s.at(0.0, 0.0).ok()).unwrap_or(f64::NAN);
        if (read - value).abs().is_nan() || (read - value).abs() > 2e-9 {
            return Err(format!("{name} would be read as another value"));
        }
    }
    Ok(text)
}

fn put(file: &mut Lines, name: ErrorName, entry: &Entry, origin: &str) {
    match (file.error(name), entry) {
        (Some(at), Entry::Value(value)) => {
            file.replace(at, &format!("{name} = {value} # {origin}"));
        }
        (Some(at), Entry::Nothing(why)) => {
            file.comment_out(at);
            file.insert(at, &format!("# {name}: {why}; {origin}"));
        }
        (None, Entry::Value(value)) => {
            file.add(&header(name), &format!("{name} = {value} # {origin}"));
        }
        (None, Entry::Nothing(_)) => {}
    }
}

/// An error that stands in the table of its axis leaves it: a new table without its columns.
fn take_out_of_table(
    file: &mut Lines,
    name: ErrorName,
    origin: &str,
    tables: &mut Vec<(String, String)>,
    beside: &dyn Tables,
) {
    let header = header(name);
    let Some((line, table)) = file.table_of(&header) else { return };
    let made = tables.iter().position(|(made, _)| *made == table);
    let text = made.map_or_else(|| beside.text(&table).ok(), |i| Some(tables[i].1.clone()));
    let Some(left) = text.and_then(|text| columns::without(&text, name)) else { return };
    let new = columns::new_name(&table);
    tables.retain(|(made, _)| *made != new);
    if columns::is_bare(&left) {
        // How it was read between its rows goes with it.
        for key in ["table", "interpolation", "outside"] {
            if let Some(own) = file.key(&header, key) {
                let why = format!("# {} # nothing is left of it; {origin}", file.line(own));
                file.replace(own, &why);
            }
        }
        return;
    }
    file.replace(line, &format!("table = \"{new}\" # without what stands below; {origin}"));
    tables.push((new, left));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_line_of_the_error_changes() {
        let mut file = Lines::of(
            "# mine\n[location] # here\nEC0Y = \"1 urad\" # old\nX0C = \"2 um\"\n\n[tool]\n",
        );
        // why: both are names of ISO 230-1
        let (squareness, offset) =
            (ErrorName::parse("EC0Y").unwrap(), ErrorName::parse("EX0C").unwrap());
        put(&mut file, squareness, &Entry::Value("\"3 urad\"".into()), "now");
        put(&mut file, offset, &Entry::Nothing("unseen".into()), "now");
        assert_eq!(
            file.text(),
            "# mine\n[location] # here\nEC0Y = \"3 urad\" # now\n# EX0C: unseen; now\n# X0C = \"2 um\"\n\n[tool]\n"
        );
    }

    #[test]
    fn numbers_have_no_idle_zeros() {
        assert_eq!((plain(12.5).as_str(), plain(-1e-9).as_str()), ("12.5", "0"));
    }
}
