//! Errors of a machine file replaced by others: their lines, and their columns in the tables of axes.

use super::lines::{Lines, header};
use crate::Machine;
use crate::errors::{Curve, ErrorName, Harmonic, Measurement, StatedError};
use crate::file::Tables;
use std::cell::RefCell;
use std::fmt::Write as _;
use std::path::Path;
use trueaxis_input::Severity;

/// The tables of a new machine file: those that were made, else those beside the old one. It keeps which were read.
pub struct NewTables<'a> {
    made: &'a [(String, String)],
    beside: &'a dyn Tables,
    read: RefCell<Vec<(String, String)>>,
}

impl<'a> NewTables<'a> {
    /// Tables by name and text, before those beside the old file.
    pub fn of(made: &'a [(String, String)], beside: &'a dyn Tables) -> Self {
        Self { made, beside, read: RefCell::default() }
    }

    /// Name and text of every table that was read.
    pub fn read(self) -> Vec<(String, String)> {
        self.read.into_inner()
    }
}

impl Tables for NewTables<'_> {
    fn text(&self, name: &str) -> Result<String, String> {
        let text = match self.made.iter().find(|(n, _)| n == name) {
            Some((_, text)) => text.clone(),
            None => self.beside.text(name)?,
        };
        let mut read = self.read.borrow_mut();
        if !read.iter().any(|(n, _)| n == name) {
            read.push((name.to_owned(), text.clone()));
        }
        Ok(text)
    }

    fn display(&self, name: &str) -> String {
        self.beside.display(name)
    }
}

/// The machine of a text that was made.
///
/// # Errors
/// The first error of the text.
pub fn machine_of_text(text: &str, tables: &dyn Tables) -> Result<Machine, String> {
    let (machine, problems) = Machine::check("the new machine file", text, tables);
    machine.filter(|_| !problems.has_errors()).ok_or_else(|| {
        let first = problems.iter().find(|d| d.severity == Severity::Error);
        first.map_or("it would not be read".to_owned(), |d| format!("{}: {}", d.place, d.message))
    })
}

/// What the file states of an error.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Entry {
    /// A value in the form of the file.
    Value(String),
    /// Nothing, and why.
    Nothing(String),
}

/// States an error in the text: the line of its old value is replaced, or becomes a comment. The comment
/// `origin` says where the value comes from.
pub fn put(file: &mut Lines, name: ErrorName, entry: &Entry, origin: &str) {
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

/// Takes an error out of the table of its axis: a new table without its columns, by name and text.
pub fn take_out_of_table(
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
    let Some(left) = text.and_then(|text| without(&text, name)) else { return };
    let new = new_name(&table);
    tables.retain(|(made, _)| *made != new);
    if is_bare(&left) {
        // How it was read between its rows goes with it.
        for key in ["table", "interpolation", "outside"] {
            if let Some(own) = file.key(&header, key) {
                let why = format!("# {} # no columns remain in it; {origin}", file.line(own));
                file.replace(own, &why);
            }
        }
        return;
    }
    file.replace(line, &format!("table = \"{new}\" # without what stands below; {origin}"));
    tables.push((new, left));
}

/// A CSV text without the columns of an error; `None` if it has none.
fn without(text: &str, name: ErrorName) -> Option<String> {
    let is_row = |line: &&str| !line.trim().is_empty() && !line.trim_start().starts_with('#');
    let heading = text.lines().find(is_row)?;
    let prefixes = [format!("{name}_"), format!("u_{name}_")];
    let leaves: Vec<bool> = heading
        .split(',')
        .map(|cell| prefixes.iter().any(|p| cell.trim().starts_with(p)))
        .collect();
    if !leaves.contains(&true) {
        return None;
    }
    let kept = |line: &str| {
        let cells = line.split(',').enumerate();
        let cells = cells.filter(|(i, _)| leaves.get(*i) != Some(&true)).map(|(_, cell)| cell);
        cells.collect::<Vec<_>>().join(",")
    };
    let lines = text.lines().map(|l| if is_row(&l) { kept(l) } else { l.to_owned() });
    Some(lines.collect::<Vec<_>>().join("\n") + "\n")
}

/// Whether positions are all that is left.
fn is_bare(text: &str) -> bool {
    let rows = text.lines().map(str::trim).filter(|l| !l.is_empty() && !l.starts_with('#'));
    rows.take(1).all(|heading| heading.split(',').all(|cell| cell.trim().starts_with("position")))
}

/// `X.csv` becomes `X-identified.csv`.
fn new_name(table: &str) -> String {
    let stem = Path::new(table).file_stem().map_or(table.into(), |s| s.to_string_lossy());
    format!("{}-identified.csv", stem.trim_end_matches("-identified"))
}

/// A curve with its reversal and its standard uncertainty (mm or rad) in the form of the file, without the
/// closing brace; `is_rotary`: over a rotary axis. A table of values goes into `tables`.
pub fn curve_text(
    name: ErrorName,
    is_rotary: bool,
    stated: &StatedError,
    u: f64,
    tables: &mut Vec<(String, String)>,
) -> String {
    curve_text_by(plain, (name, is_rotary), stated, u, tables)
}

/// The same with numbers written in another way.
pub fn curve_text_by(
    number: fn(f64) -> String,
    (name, is_rotary): (ErrorName, bool),
    stated: &StatedError,
    u: f64,
    tables: &mut Vec<(String, String)>,
) -> String {
    let angle = name.component.is_rotation();
    let (scale, unit) = if angle { (1e6, "urad") } else { (1e3, "um") };
    let (position, shown) = if is_rotary { ("deg", 1f64.to_degrees()) } else { ("mm", 1.0) };
    let quantity = |v: f64| format!("\"{} {unit}\"", number(v * scale));
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
            let harmonic = |h: &Harmonic| {
                format!("[{}, {}, {}]", h.order, quantity(h.cosine), quantity(h.sine))
            };
            let list: Vec<String> = terms.iter().map(harmonic).collect();
            format!("{{ fourier = {{ mean = {}, terms = [{}] }}", quantity(*mean), list.join(", "))
        }
        Curve::Table { spline, .. } => {
            let file = format!("identified-{name}.csv");
            let mut table = format!("# {name}, identified\nposition_{position},{name}_{unit}\n");
            for at in spline.knots() {
                let value = number(spline.at(*at) * scale);
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

/// How an error was measured as the value of `measured`: `{ instrument = "…", date = "…", temperature = "28.4 degC" }`;
/// `None`: nothing is known of it. All writers of machine files take it from here.
pub fn measured_text(measured: &Measurement) -> Option<String> {
    let texts = [("instrument", &measured.instrument), ("date", &measured.date)];
    let of = |(key, text): (&str, &Option<String>)| {
        text.as_ref().map(|text| format!("{key} = {}", quoted(text)))
    };
    let mut parts: Vec<String> = texts.into_iter().filter_map(of).collect();
    // All digits: `table_temperature` of the scale may state the same temperature, and two are refused.
    let celsius = measured.temperature_celsius;
    parts.extend(celsius.map(|c| format!("temperature = \"{c} degC\"")));
    (!parts.is_empty()).then(|| format!("{{ {} }}", parts.join(", ")))
}

/// The same as the last part of an error in braces, which it closes.
pub fn measured_and_closed(measured: &Measurement) -> String {
    measured_text(measured).map_or(" }".to_owned(), |text| format!(", measured = {text} }}"))
}

/// How a curve was measured that was found in addition to what the machine says of heat: by `origin`, and at the temperature
/// of the table in whose place it stands, as the scale grows from there (docs/model.md eq. 81).
pub fn measured_in_place_of(before: Option<&StatedError>, origin: &str) -> Measurement {
    Measurement {
        instrument: Some(origin.to_owned()),
        date: None,
        temperature_celsius: before.and_then(|stated| stated.measured.temperature_celsius),
    }
}

/// States with a scale the temperature of its error table where it stood with a curve that the new text has no more: the
/// scale grows from there, whether there is a table or not.
///
/// # Errors
/// In words, why the new text is no machine file whose scales grow from the temperatures of the old one.
pub fn keep_table_temperatures(
    file: &mut Lines,
    old: &str,
    made: &[(String, String)],
    beside: &dyn Tables,
    origin: &str,
) -> Result<(), String> {
    let old = machine_of_text(old, beside)?;
    let moved = |file: &Lines| -> Result<Vec<(String, f64)>, String> {
        let new = machine_of_text(&file.text(), &NewTables::of(made, beside))?;
        let celsius = |machine: &Machine, axis: usize| {
            let scale = machine.heat().scales.iter().find(|scale| scale.axis == axis);
            scale.map(|scale| scale.anchor.table_celsius)
        };
        let axes = old.axes().iter().enumerate();
        let of = |(axis, _): &(usize, _)| celsius(&old, *axis) != celsius(&new, *axis);
        let of_axes = axes.filter(of);
        Ok(of_axes
            .filter_map(|(i, axis)| Some((format!("scale.{}", axis.name), celsius(&old, i)?)))
            .collect())
    };
    let before = moved(file)?;
    for (header, celsius) in &before {
        file.add(header, &format!("table_temperature = \"{celsius} degC\" # {origin}"));
    }
    match before.is_empty() || moved(file)?.is_empty() {
        true => Ok(()),
        false => Err("its scales would grow from another temperature".to_owned()),
    }
}

/// A text as TOML writes it, with its quotes.
///
/// ```
/// use trueaxis_machine::describe::replacement::quoted;
/// assert_eq!(quoted("laser \"XL\"\n"), "\"laser \\\"XL\\\"\\u000A\"");
/// ```
pub fn quoted(text: &str) -> String {
    let mut out = String::from("\"");
    for c in text.chars() {
        match c {
            '"' | '\\' => out.extend(['\\', c]),
            c if c.is_control() => {
                // Writing into a text cannot fail.
                let _ = write!(out, "\\u{:04X}", u32::from(c));
            }
            c => out.push(c),
        }
    }
    out.push('"');
    out
}

/// A value in µm or µrad without idle zeros: six decimals of µm or µrad are a picometre.
pub fn plain(value: f64) -> String {
    let text = format!("{value:.6}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::file::NoTables;

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
    fn the_columns_of_one_error_leave() {
        let text =
            "# laser\nposition_mm,EXX_up_um,EXX_down_um,EYX_um,u_EXX_um\n0,1,2,3,9\n10,4,5,6,9\n";
        let name = ErrorName::parse("EXX").unwrap(); // why: a name of ISO 230-1
        let left = without(text, name).unwrap();
        assert_eq!(left, "# laser\nposition_mm,EYX_um\n0,3\n10,6\n");
        assert!(without(&left, name).is_none() && !is_bare(&left));
        assert!(is_bare(&without(&left, ErrorName::parse("EYX").unwrap()).unwrap()));
        assert_eq!(new_name("X.csv"), "X-identified.csv");
    }

    #[test]
    fn a_scale_grows_from_its_temperature_without_a_table() {
        let old = "machine = { name = \"m\", chain = \"w b X Y Z t\" }\n\
            [axis.X]\ntravel = [\"0 mm\", \"500 mm\"]\n\
            [scale.X]\nexpansion = \"10 um/(m K)\"\nfixed_point = \"0 mm\"\nsensors = { x = \"0 mm\" }\n\
            [motion.X]\nEXX = { polynomial = [\"0 um\", \"3 um\"], scale = \"100 mm\", \
            measured = { temperature = \"28.4 degC\" } }\n";
        let name = ErrorName::parse("EXX").unwrap(); // why: a name of ISO 230-1
        let celsius = |text: &str| {
            let machine = machine_of_text(text, &NoTables).unwrap();
            machine.heat().scales[0].anchor.table_celsius
        };
        let mut file = Lines::of(old);
        keep_table_temperatures(&mut file, old, &[], &NoTables, "now").unwrap();
        assert_eq!(file.text(), old, "nothing has changed");
        put(&mut file, name, &Entry::Nothing("unseen".into()), "now");
        assert_eq!(celsius(&file.text()), 20.0, "assumed");
        keep_table_temperatures(&mut file, old, &[], &NoTables, "now").unwrap();
        assert_eq!([celsius(old), celsius(&file.text())], [28.4; 2]);
    }

    #[test]
    fn numbers_have_no_idle_zeros() {
        assert_eq!((plain(12.5).as_str(), plain(-1e-9).as_str()), ("12.5", "0"));
    }
}
