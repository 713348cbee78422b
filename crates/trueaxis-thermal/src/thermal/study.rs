//! A study of a thermal model and its logs, read and checked.

use super::check::{check_cycle, check_cycles, check_later};
use super::subsets::combinations;
use super::{Cycle, Logs, Zero};
use std::ops::Range;
use std::path::{Path, PathBuf};
use trueaxis_input::plausible::Limits;
use trueaxis_input::{
    CsvColumn, CsvTable, Diagnostics, Dimension, Files, Item, Place, Section, SourceText, Unit,
};
use trueaxis_machine::errors::{Component, ErrorName};

/// Terms of the largest model unless the study says otherwise.
const MOST_TERMS: usize = 3;
/// The temperature of the zero of a model unless the study says otherwise, °C (ISO 1).
const REFERENCE_CELSIUS: f64 = 20.0;
/// Combinations of terms that are tried in all, once without each cycle: some seconds.
const MOST_TRIED: f64 = 3e6;
/// More candidates than this are no choice of sensors.
const MOST_CANDIDATES: usize = 100;
/// Numbers in all columns of all cycles: some hundred megabytes.
const MOST_NUMBERS: usize = 10_000_000;
/// A study with more files than this is a slip.
const MOST_FILES: usize = 1000;

/// Reads a study and the logs that it names.
///
/// A log that cannot be used is an error, not left out: a model of the other cycles would be
/// another answer.
pub fn read_logs(files: &Files, path: &Path) -> (Option<Logs>, Diagnostics) {
    read_logs_and(files, path, &[])
}

/// The same with logs that came later, beside those of `[score]`.
pub fn read_logs_and(files: &Files, path: &Path, later: &[PathBuf]) -> (Option<Logs>, Diagnostics) {
    let mut problems = Diagnostics::new();
    let Some(text) = files.text(path, "a study of a thermal model (TOML)", &mut problems) else {
        return (None, problems);
    };
    let beside = |name: &str| path.parent().unwrap_or(Path::new("")).join(name);
    let load = |name: &str, problems: &mut Diagnostics| {
        files.text(&beside(name), "a log of displacement and temperatures (CSV)", problems)
    };
    let show = |name: &str| beside(name).display().to_string();
    let tables = Tables { load: &load, show: &show };
    let load = |name: &str, problems: &mut Diagnostics| {
        files.text(Path::new(name), "a log of displacement and temperatures (CSV)", problems)
    };
    let later: Vec<String> = later.iter().map(|p| p.display().to_string()).collect();
    let asked = Later { names: &later, tables: Tables { load: &load, show: &str::to_owned } };
    let shown = path.display().to_string();
    let source = SourceText::new(&shown, &text);
    let logs = source.read(|root| read(root, &tables, Some(&asked)));
    let found = source.finish();
    let logs = logs.filter(|_| !found.has_errors());
    problems.append(found);
    (logs, problems)
}

/// Where the logs of a study come from.
pub struct Tables<'a> {
    /// The text of a log by its name in the study.
    pub load: &'a dyn Fn(&str, &mut Diagnostics) -> Option<String>,
    /// What to call it in messages.
    pub show: &'a dyn Fn(&str) -> String,
}

/// Later logs that are named beside the study.
pub struct Later<'a> {
    /// Their names.
    pub names: &'a [String],
    /// Where they come from.
    pub tables: Tables<'a>,
}

/// The same for a text and logs that need not lie on a disk.
pub fn parse_logs(file: &str, text: &str, tables: &Tables<'_>) -> (Option<Logs>, Diagnostics) {
    let source = SourceText::new(file, text);
    let logs = source.read(|root| read(root, tables, None));
    let problems = source.finish();
    (logs.filter(|_| !problems.has_errors()), problems)
}

/// Where in the logs what stands.
struct Columns {
    displacement: String,
    unit: Option<Unit>,
    sensors: Vec<(String, String)>,
    cycle: Option<String>,
    time: Option<String>,
    interval_s: Option<f64>,
    limits: Limits,
}

fn read(root: &Section<'_>, tables: &Tables<'_>, later: Option<&Later<'_>>) -> Option<Logs> {
    // Every key is asked for before anything is given up, or it would count as unknown.
    let name = root.require("name", "say what drifts").and_then(|i| i.text());
    root.text("source");
    let files = root.require("files", "files = [\"monday.csv\", \"tuesday.csv\"]");
    let files = files.and_then(|item| read_files(&item));
    let scored = read_score(root);
    let displacement = root
        .require("displacement", "[displacement] column = \"drift_um\", error = \"EZ0t\"")
        .and_then(|item| item.section("displacement", read_displacement));
    let sensors = read_sensors(root);
    let cycle = root.text("cycle").map(str::to_owned);
    let time = root.text("time").map(str::to_owned);
    let interval_s = root.get("interval").and_then(|i| positive(&i));
    let lags_s = read_lags(root, time.is_some() || interval_s.is_some());
    let zero = root.get("zero").map_or(Some(Zero::Cycle), |item| read_zero(&item));
    let most_terms = root.get("most_terms").map_or(Some(MOST_TERMS), |i| i.count());
    if most_terms == Some(0) {
        root.error("too-few-terms", "a model without terms is none".into(), "most_terms = 3");
    }
    let reference = root.quantity("reference", Dimension::Temperature);
    let (displacement, unit, error, repeatability_mm) = displacement?;
    let (displacement, sensors) = (displacement?, sensors?);
    let limits = root.limits();
    let columns = Columns { displacement, unit, sensors, cycle, time, interval_s, limits };
    let logs = Logs {
        name: name?.to_owned(),
        error: error?,
        sensors: columns.sensors.iter().map(|s| s.0.clone()).collect(),
        cycles: Vec::new(),
        later: Vec::new(),
        zero: zero?,
        lags_s,
        most_terms: most_terms?,
        reference_celsius: reference.unwrap_or(REFERENCE_CELSIUS),
        repeatability_mm,
    };
    let mut logs = read_cycles(root, tables, &files?, &columns, logs);
    read_later(root, tables, &scored, &columns, &mut logs);
    if let Some(later) = later {
        read_later(root, &later.tables, later.names, &columns, &mut logs);
    }
    Some(logs)
}

/// The logs of `[score]`.
fn read_score(root: &Section<'_>) -> Vec<String> {
    let of = |section: &Section<'_>| {
        let item = section.require("files", "files = [\"next-week.csv\"]")?;
        read_files(&item)
    };
    root.section("score", of).flatten().unwrap_or_default()
}

/// Logs that the model does not see.
fn read_later(
    root: &Section<'_>,
    tables: &Tables<'_>,
    files: &[String],
    columns: &Columns,
    logs: &mut Logs,
) {
    let mut problems = Diagnostics::new();
    for file in files {
        let known = std::mem::take(&mut logs.cycles);
        read_file(file, tables, columns, logs, &mut problems);
        let found = std::mem::replace(&mut logs.cycles, known);
        for later in &found {
            check_later(later, logs, &(tables.show)(file), &mut problems);
        }
        logs.later.extend(found);
    }
    root.take_over(problems);
}

/// The same study with its cycles.
fn read_cycles(
    root: &Section<'_>,
    tables: &Tables<'_>,
    files: &[String],
    columns: &Columns,
    mut logs: Logs,
) -> Logs {
    let mut problems = Diagnostics::new();
    for file in files {
        read_file(file, tables, columns, &mut logs, &mut problems);
        let terms = logs.sensors.len() * (1 + logs.lags_s.len()) + 1;
        let rows: usize = logs.cycles.iter().map(|c| c.displacement_mm.len()).sum();
        if rows.saturating_mul(terms) > MOST_NUMBERS {
            let message = format!("{rows} rows and more with {terms} columns are too many");
            let hint = "thin the logs: heat is slow, a row a minute is enough";
            root.error("too-many-readings", message, hint);
            break;
        }
    }
    let sound = !problems.has_errors();
    check_cycles(&logs, &mut problems);
    root.take_over(problems);
    if sound {
        check_search(root, &logs);
    }
    logs
}

fn read_files(item: &Item<'_>) -> Option<Vec<String>> {
    let list = item.list()?;
    if list.is_empty() || list.len() > MOST_FILES {
        let message = format!("{} logs are named", list.len());
        item.error("bad-list", message, "name each log of a cycle once");
        return None;
    }
    let names: Vec<_> = list.iter().map(|i| (i, i.text())).collect();
    for (i, (item, name)) in names.iter().enumerate() {
        if name.is_some() && names[..i].iter().any(|(_, n)| n == name) {
            let message = "this log is named twice".to_owned();
            let hint = "a cycle and its copy are no two witnesses: what fits one fits the other";
            item.error("duplicate-cycle", message, hint);
            return None;
        }
    }
    names.into_iter().map(|(_, name)| name.map(str::to_owned)).collect()
}

type Displacement = (Option<String>, Option<Unit>, Option<String>, Option<f64>);

fn read_displacement(section: &Section<'_>) -> Displacement {
    let column = section.require("column", "the heading of the displacement, such as drift_um");
    let column = column.and_then(|i| i.text()).map(str::to_owned);
    let unit = section.get("unit").and_then(|item| {
        let found = Unit::find(item.text()?, Dimension::Length);
        found.map_err(|e| item.error(e.code(), e.to_string(), &e.hint())).ok()
    });
    let hint = "the error of the machine file that it is, such as \"EZ0t\", or a name of your own";
    let error = section.require("error", hint).and_then(|item| {
        let text = item.text()?;
        let named = ErrorName::parse(text).map(|n| n.component);
        if named.is_some_and(|c| matches!(c, Component::A | Component::B | Component::C)) {
            let message = format!("{text} is an angle, a displacement is not");
            let hint = "the difference of two probes over their distance is an angle; \
                        so far only displacements are modelled";
            item.error("wrong-unit", message, hint);
            return None;
        }
        Some(text.to_owned())
    });
    let repeatability = section.get("repeatability").and_then(|item| {
        let value = item.quantity(Dimension::Length)?;
        if value <= 0.0 {
            let hint = "the standard uncertainty of one reading, such as \"0.5 um\"";
            item.error("not-positive", "it is not positive".to_owned(), hint);
        }
        Some(value)
    });
    (column, unit, error, repeatability)
}

/// The names of the sensors and the columns where they stand.
fn read_sensors(root: &Section<'_>) -> Option<Vec<(String, String)>> {
    root.require("sensors", "[sensors] spindle_front = \"spindle_front_degC\"");
    let mut sensors = Vec::new();
    root.section("sensors", |section| {
        for (name, _, item) in section.entries() {
            sensors.extend(item.text().map(|column| (name.to_owned(), column.to_owned())));
        }
        if sensors.is_empty() {
            let message = "no sensor is named".to_owned();
            section.error("missing-sensor", message, "spindle_front = \"spindle_front_degC\"");
        }
    });
    (!sensors.is_empty()).then_some(sensors)
}

fn read_lags(root: &Section<'_>, timed: bool) -> Vec<f64> {
    let Some(item) = root.get("lags") else { return Vec::new() };
    let lags: Vec<f64> = item.list().into_iter().flatten().filter_map(|i| positive(&i)).collect();
    if !lags.is_empty() && !timed {
        let message = "a lag needs to know the time between the rows".to_owned();
        item.error("missing-time", message, "time = \"time_s\" (a column) or interval = \"60 s\"");
    }
    lags
}

fn positive(item: &Item<'_>) -> Option<f64> {
    let value = item.quantity(Dimension::Time)?;
    if value <= 0.0 {
        item.error("not-positive", "it is not positive".to_owned(), "such as \"10 min\"");
        return None;
    }
    Some(value)
}

fn read_zero(item: &Item<'_>) -> Option<Zero> {
    let text = item.text()?;
    let found = Zero::ALL.into_iter().find(|(_, name)| *name == text);
    if found.is_none() {
        let hint = "\"cycle\" (unknown in each), \"start\" (the first reading) or \"common\"";
        item.error("unknown-word", format!("`{text}` is no zero"), hint);
    }
    found.map(|(zero, _)| zero)
}

fn check_search(root: &Section<'_>, logs: &Logs) {
    let candidates = logs.sensors.len() * (1 + logs.lags_s.len());
    let tried = combinations(candidates, logs.most_terms) * (logs.cycles.len() + 1) as f64;
    if tried > MOST_TRIED || candidates > MOST_CANDIDATES {
        let message =
            format!("{candidates} candidates make {tried:.1e} models of up to {}", logs.most_terms);
        let hint = "name fewer sensors or lags, or a smaller most_terms: who tries so many finds \
                    one that fits by chance";
        root.error("too-many-candidates", message, hint);
    }
}

/// Reads one log into one cycle, or as many as its cycle column states.
fn read_file(
    name: &str,
    tables: &Tables<'_>,
    columns: &Columns,
    logs: &mut Logs,
    problems: &mut Diagnostics,
) {
    let mut found = Diagnostics::new();
    if let Some(text) = (tables.load)(name, &mut found) {
        let table = CsvTable::parse(&(tables.show)(name), &text, &mut found);
        let values = if found.has_errors() { None } else { values(&table, columns, &mut found) };
        if let Some(values) = values {
            for rows in cycles_of(&table, columns, &mut found) {
                let cycle = cut(&table, columns, &values, &rows);
                let place = |row: usize| match rows.is_empty() {
                    true => Place::whole(&table.file),
                    false => table.row_place(rows.start + row),
                };
                check_cycle(&cycle, logs, (&place, &columns.limits), &mut found);
                logs.cycles.push(cycle);
            }
        }
    }
    problems.append(found);
}

/// The columns of a table in mm, °C and s.
struct Values {
    displacement_mm: Vec<f64>,
    celsius: Vec<Vec<f64>>,
    times_s: Option<Vec<f64>>,
}

fn values(table: &CsvTable, columns: &Columns, problems: &mut Diagnostics) -> Option<Values> {
    let displacement = find(table, &columns.displacement, problems).and_then(|column| {
        let unit = match columns.unit {
            Some(unit) if !holds(column, Dimension::Temperature) => unit,
            _ => unit_of(column, Dimension::Length, problems)?,
        };
        table.in_unit(column, unit, problems)
    });
    let mut celsius = Vec::new();
    for (_, name) in &columns.sensors {
        let Some(column) = find(table, name, problems) else { continue };
        // A heading without a unit is taken as °C: there is no other unit of temperature here.
        let unit = match unit_suffix(column) {
            Some(_) => unit_of(column, Dimension::Temperature, problems),
            None => Unit::find("degC", Dimension::Temperature).ok(),
        };
        celsius.extend(unit.and_then(|unit| table.in_unit(column, unit, problems)));
    }
    let time = columns.time.as_ref().map(|name| {
        let column = find(table, name, problems)?;
        table.in_unit(column, unit_of(column, Dimension::Time, problems)?, problems)
    });
    let rows = (0..table.rows()).map(|i| i as f64);
    let times_s = match (time, columns.interval_s) {
        (Some(times_s), _) => Some(times_s?),
        (None, Some(interval_s)) => Some(rows.map(|i| i * interval_s).collect()),
        (None, None) => None,
    };
    let displacement_mm = displacement?;
    (celsius.len() == columns.sensors.len()).then_some(Values { displacement_mm, celsius, times_s })
}

fn find<'t>(table: &'t CsvTable, name: &str, problems: &mut Diagnostics) -> Option<&'t CsvColumn> {
    let column = table.column(name);
    if column.is_none() {
        let names: Vec<&str> = table.columns.iter().take(30).map(|c| c.name.as_str()).collect();
        let message = format!("the log has no column `{name}`");
        let hint = format!("its columns: {}", names.join(", "));
        problems.error("missing-column", Place::whole(&table.file), message, &hint);
    }
    column
}

/// What stands after the last underscore, if it is a unit of anything.
fn unit_suffix(column: &CsvColumn) -> Option<&str> {
    let (_, unit) = column.name.rsplit_once('_')?;
    let of = [Dimension::Temperature, Dimension::Length, Dimension::Angle, Dimension::Time];
    let known = of.iter().any(|d| Unit::find(unit, *d).is_ok());
    let fahrenheit = ["degf", "f", "°f", "fahrenheit"].contains(&&*unit.to_lowercase());
    (known || fahrenheit || unit == "K").then_some(unit)
}

fn holds(column: &CsvColumn, dimension: Dimension) -> bool {
    unit_suffix(column).is_some_and(|unit| Unit::find(unit, dimension).is_ok())
}

fn unit_of(column: &CsvColumn, dimension: Dimension, problems: &mut Diagnostics) -> Option<Unit> {
    let suffix = column.name.rsplit_once('_').map_or("", |(_, unit)| unit);
    let error = match Unit::find(suffix, dimension) {
        Ok(unit) => return Some(unit),
        Err(error) => error,
    };
    let hint = match dimension {
        Dimension::Length if holds(column, Dimension::Temperature) => {
            "is it swapped with a sensor?".to_owned()
        }
        Dimension::Length => {
            "a heading such as drift_um, or [displacement] unit = \"um\"".to_owned()
        }
        Dimension::Temperature if holds(column, Dimension::Length) => {
            "is it swapped with the displacement?".to_owned()
        }
        Dimension::Temperature => "convert it first: °C = (°F − 32)/1.8 = K − 273.15".to_owned(),
        _ => error.hint(),
    };
    let message = format!("column `{}`: {error}", column.name);
    problems.error(error.code(), column.place.clone(), message, &hint);
    None
}

/// The rows of each cycle: all, or those of one value of the cycle column after the other.
fn cycles_of(table: &CsvTable, columns: &Columns, problems: &mut Diagnostics) -> Vec<Range<usize>> {
    let Some(name) = &columns.cycle else {
        return std::iter::once(0..table.rows()).collect();
    };
    let Some(column) = find(table, name, problems) else { return Vec::new() };
    let mut cycles: Vec<Range<usize>> = Vec::new();
    let mut seen: Vec<f64> = Vec::new();
    for (row, value) in column.values.iter().enumerate() {
        match cycles.last_mut() {
            Some(last) if column.values[last.start] == *value => last.end = row + 1,
            _ if seen.contains(value) => {
                let message = format!("cycle {value} comes again after another one");
                let hint = "the rows of a cycle stand together, in the order of time";
                problems.error("cycle-torn", table.row_place(row), message, hint);
                return Vec::new();
            }
            _ if seen.len() == MOST_FILES => {
                let message = format!("`{name}` counts more than {MOST_FILES} cycles");
                let hint = "it numbers cycles, not rows";
                problems.error("too-many-cycles", table.row_place(row), message, hint);
                return Vec::new();
            }
            _ => {
                seen.push(*value);
                cycles.push(row..row + 1);
            }
        }
    }
    cycles
}

fn cut(table: &CsvTable, columns: &Columns, values: &Values, rows: &Range<usize>) -> Cycle {
    let part = |all: &Vec<f64>| all[rows.clone()].to_vec();
    let number = columns.cycle.as_ref().and_then(|name| table.column(name));
    let number = number.map(|c| format!(" {}", c.values[rows.start])).unwrap_or_default();
    let file = Path::new(&table.file).file_name().unwrap_or_default().to_string_lossy();
    Cycle {
        name: format!("{file}{number}"),
        times_s: values.times_s.as_ref().map(part),
        displacement_mm: part(&values.displacement_mm),
        temperatures_celsius: values.celsius.iter().map(part).collect(),
    }
}
