//! Machine files and documents of `evaluate` as calibrations: their date and their figures.

use super::{Limits, Point};
use serde_json::Value;
use std::path::Path;
use trueaxis_geometry::AxisKind;
use trueaxis_input::{Date, Diagnostics, Dimension, Files, Place, parse_quantity};
use trueaxis_machine::Machine;
use trueaxis_machine::axis::Travel;
use trueaxis_machine::errors::{ErrorKind, ErrorName, StatedError};

/// So many places along the travel show the range of a curve.
const PLACES: usize = 201;
/// A travel that is not stated is examined between these, mm.
const USUAL_MM: f64 = 500.0;

/// What one file says.
#[derive(Debug, Clone, PartialEq)]
pub struct Calibration {
    /// The file.
    pub file: String,
    /// The machine.
    pub machine: String,
    /// The chain of a machine file; documents of `evaluate` name none.
    pub chain: Option<String>,
    /// Name, unit and value of every figure.
    pub figures: Vec<(String, String, Point)>,
    /// At which temperature the table of a figure holds, °C.
    pub tables_celsius: Vec<(String, f64)>,
}

impl Calibration {
    /// Reads a machine file, or a document of `evaluate` where the name ends in `.json`.
    pub fn read(files: &Files, path: &Path, problems: &mut Diagnostics) -> Option<Self> {
        let file = path.display().to_string();
        if path.extension().is_some_and(|e| e.eq_ignore_ascii_case("json")) {
            let text = files.text(path, "a document of evaluate (JSON)", problems)?;
            return read_document(&file, &text, problems);
        }
        let machine = problems.keep(Machine::read(files, path))?;
        read_machine(&file, &machine, problems)
    }
}

/// Limits as typed: `EC0Y=30 urad`, `iso230-2 X: A=15 um`.
pub fn read_limits(texts: &[String], problems: &mut Diagnostics) -> Limits {
    let units = [(Dimension::Length, "um", 1e3), (Dimension::Angle, "urad", 1e6)];
    let mut limits = Limits::new();
    for text in texts {
        let read = text.rsplit_once('=').and_then(|(name, limit)| {
            let of = |(d, unit, scale): (Dimension, &str, f64)| {
                let value = parse_quantity(limit.trim(), d).ok().filter(|v| *v > 0.0)?;
                Some((name.trim().to_owned(), (value * scale, unit.to_owned())))
            };
            units.into_iter().find_map(of)
        });
        match read {
            Some((name, limit)) => drop(limits.insert(name, limit)),
            None => {
                let message = format!("`{text}` is not a figure, = and a limit above zero");
                let hint = "--limit \"EC0Y=20 urad\", --limit \"iso230-2 X: A=15 um\"";
                problems.error("bad-tolerance", Place::whole("--limit"), message, hint);
            }
        }
    }
    limits
}

/// The errors of a machine file: location errors by their value, error motions by their range over the travel and, where
/// one is stated, their largest reversal; each on the date of its measurement. Errors without a date are left out with a warning.
pub fn read_machine(
    file: &str,
    machine: &Machine,
    problems: &mut Diagnostics,
) -> Option<Calibration> {
    let (mut figures, mut undated, mut tables_celsius) = (Vec::new(), Vec::new(), Vec::new());
    for (index, name) in machine.stated_errors() {
        let Some(stated) = machine.bodies()[index.body].stated(index.kind, index.component) else {
            continue;
        };
        let Some(date) = stated.measured.date.as_deref().and_then(Date::parse) else {
            undated.push(name.to_string());
            continue;
        };
        let (scale, unit) = if name.component.is_rotation() { (1e6, "urad") } else { (1e3, "um") };
        let reversal = reversal_of(machine, name, stated);
        for (value, u, what) in value_of(machine, name, stated).into_iter().chain(reversal) {
            let u = stated.u.is_some().then_some(u * scale);
            let point = Point { date, value: value * scale, u, file: file.to_owned() };
            let figure = format!("{name}{what}");
            let celsius = table_celsius(machine, name, stated).filter(|_| what != REVERSAL);
            tables_celsius.extend(celsius.map(|celsius| (figure.clone(), celsius)));
            figures.push((figure, unit.to_owned(), point));
        }
    }
    if figures.is_empty() {
        let message = "no error of this machine file has a date".to_owned();
        let hint = "measured = { date = 2026-03-14 } in [location] and [motion.X], or of an error";
        problems.error("no-date", Place::whole(file), message, hint);
        return None;
    }
    if !undated.is_empty() {
        let message = format!("errors without a date are left out: {}", undated.join(" "));
        let hint = "measured = { date = 2026-03-14 } in [location] and [motion.X], or of an error";
        problems.warn("no-date", Place::whole(file), message, hint);
    }
    let (file, chain) = (file.to_owned(), Some(machine.chain_text()));
    let machine = machine.name().to_owned();
    Some(Calibration { file, machine, chain, figures, tables_celsius })
}

/// At which temperature the table of a positioning error holds: that from which its scale grows, else the one that is stated.
fn table_celsius(machine: &Machine, name: ErrorName, stated: &StatedError) -> Option<f64> {
    let axis = machine.axis_index(name.body).filter(|_| name.kind == ErrorKind::Motion)?;
    let of = &machine.axes()[axis];
    let is_along = !name.component.is_rotation() && of.direction[name.component as usize] != 0.0;
    if of.kind != AxisKind::Linear || !is_along {
        return None;
    }
    let scale = machine.heat().scales.iter().find(|scale| scale.axis == axis);
    scale.map(|scale| scale.anchor.table_celsius).or(stated.measured.temperature_celsius)
}

/// Value, standard uncertainty, and what of the error it is. Unit: mm or rad.
fn value_of(
    machine: &Machine,
    name: ErrorName,
    stated: &StatedError,
) -> Option<(f64, f64, &'static str)> {
    if name.kind == ErrorKind::Location {
        return Some((stated.at(0.0, 0.0).ok()?, stated.u_at(0.0), ""));
    }
    let places = places(machine, name)?;
    let values: Vec<f64> = places.iter().filter_map(|q| stated.at(*q, 0.0).ok()).collect();
    let low = values.iter().copied().fold(f64::INFINITY, f64::min);
    let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let u = places.iter().map(|q| stated.u_at(*q)).fold(0.0, f64::max);
    // The two ends of a range err by themselves.
    (high >= low).then_some((high - low, u * std::f64::consts::SQRT_2, " range"))
}

/// The name of a reversal after that of its error.
const REVERSAL: &str = " reversal";

/// The reversal of an error motion where it is largest, rising less falling, and its standard uncertainty. Unit: mm or rad.
fn reversal_of(
    machine: &Machine,
    name: ErrorName,
    stated: &StatedError,
) -> Option<(f64, f64, &'static str)> {
    stated.reversal.as_ref()?;
    let at = |q: f64, side: f64| stated.at(q, side).ok();
    let places = places(machine, name)?.into_iter();
    let each = places.filter_map(|q| Some((at(q, 1.0)? - at(q, -1.0)?, stated.u_at(q))));
    let (value, u) = each.max_by(|a, b| a.0.abs().total_cmp(&b.0.abs()))?;
    // The two directions err by themselves.
    Some((value, u * std::f64::consts::SQRT_2, REVERSAL))
}

/// Positions along the travel of the axis of an error.
fn places(machine: &Machine, name: ErrorName) -> Option<Vec<f64>> {
    let axis = &machine.axes()[machine.axis_index(name.body)?];
    let (from, to) = match axis.travel {
        Travel::Between(from, to) => (from, to),
        _ if axis.kind == AxisKind::Rotary => (0.0, std::f64::consts::TAU),
        _ => (-USUAL_MM, USUAL_MM),
    };
    Some((0..PLACES).map(|k| from + (to - from) * k as f64 / (PLACES - 1) as f64).collect())
}

/// The figures of a document of `evaluate`.
pub fn read_document(file: &str, text: &str, problems: &mut Diagnostics) -> Option<Calibration> {
    let mut refuse = |code, message: String, hint: &str| {
        problems.error(code, Place::whole(file), message, hint);
        None
    };
    let Ok(document) = serde_json::from_str::<Value>(text) else {
        return refuse(
            "bad-json",
            "this is no JSON document".to_owned(),
            "trueaxis evaluate … --format json > FILE.json",
        );
    };
    let word = |key: &str| document.get(key).and_then(Value::as_str).unwrap_or("");
    if word("schema") != "trueaxis/evaluate/1" {
        let message = "this is no document of `trueaxis evaluate`".to_owned();
        return refuse("bad-json", message, "its schema is trueaxis/evaluate/1");
    }
    let Some(date) = Date::parse(word("date")) else {
        let hint =
            "date = 2026-03-14 in the conditions file of the readings, then evaluate them again";
        return refuse("no-date", "the document has no date".to_owned(), hint);
    };
    if word("machine").is_empty() {
        let hint =
            "machine = \"…\" in the conditions file of the readings, then evaluate them again";
        return refuse("no-machine", "the document does not name its machine".to_owned(), hint);
    }
    let axis = match document.get("axes").and_then(Value::as_array) {
        Some(axes) => axes.iter().filter_map(Value::as_str).collect::<String>(),
        None => word("axis").to_owned(),
    };
    let prefix = [word("standard"), &axis]
        .into_iter()
        .filter(|w| !w.is_empty())
        .collect::<Vec<_>>()
        .join(" ");
    let mut figures = Vec::new();
    let mut put = |name: &str, unit: &str, value: f64, u: Option<f64>| {
        let point = Point { date, value, u, file: file.to_owned() };
        figures.push((format!("{prefix}: {name}"), unit.to_owned(), point));
    };
    let entries = document.as_object().into_iter().flatten();
    for (key, value) in entries {
        let Some((name, unit)) = key.rsplit_once('_') else { continue };
        // Angles are there twice.
        if let ("um" | "arcsec", Some(value)) = (unit, value.as_f64()) {
            let expanded = document.get(format!("U_{unit}")).and_then(|u| u.get(name));
            put(name, unit, value, expanded.and_then(Value::as_f64).map(|u| 0.5 * u));
        }
    }
    let causes = document.get("diagnosis").and_then(|d| d.get("causes")).and_then(Value::as_array);
    for cause in causes.into_iter().flatten() {
        let name = cause.get("cause").and_then(Value::as_str).unwrap_or("");
        let axis =
            cause.get("axis").and_then(Value::as_str).map_or(String::new(), |a| format!(" {a}"));
        for unit in ["um", "urad"] {
            let number = |key: &str| cause.get(format!("{key}_{unit}")).and_then(Value::as_f64);
            let k = cause.get("k").and_then(Value::as_f64).unwrap_or(2.0);
            if let Some(value) = number("value").filter(|_| name != "unexplained") {
                put(&format!("{name}{axis}"), unit, value, number("U").map(|u| u / k));
            }
        }
    }
    if figures.is_empty() {
        let hint = "documents of iso230-2, -4 and -6 have figures with units";
        return refuse("no-figures", "the document has no figures".to_owned(), hint);
    }
    let (file, machine) = (file.to_owned(), word("machine").to_owned());
    Some(Calibration { file, machine, chain: None, figures, tables_celsius: Vec::new() })
}
