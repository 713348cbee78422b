//! `[uncertainty] covariance = "FILE"`: errors that are known better together than each alone.
//!
//! ```toml
//! [[known]]
//! of = { "EXX P2" = 1.0 }                   # the factor of a function, mm or rad
//! value = 0.012
//! u = 0.0004
//! covariance = [1.6e-7]                     # with all before it, and its own variance
//!
//! [function]
//! "EXX P2" = { error = "EXX", polynomial = [-0.5, 0.0, 1.5], origin = "600 mm", scale = "500 mm" }
//! "EXX as stated before" = { error = "EXX", value = 0.02 }
//! ```
//!
//! A function with a `value` of its own counts as known exactly.

use super::{KnownRow, Tables};
use crate::Machine;
use crate::axis::AxisKind;
use crate::errors::{
    Curve, ErrorKind, ErrorName, Extrapolation, Harmonic, Interpolation, JointErrors,
    JointFunction, Spline,
};
use nalgebra::DMatrix;
use trueaxis_input::{Dimension, Item, Section, SourceText};

/// More factors than this are no machine.
const MOST_ROWS: usize = 2000;
/// The machine file and its covariance say the same to this share, and to a picometre.
const SAME_VALUE: f64 = 1e-6;
const SAME_MM: f64 = 1e-9;
/// What to do with a file that is not usable.
const HINT: &str = "this is no covariance that `identify --predictor` wrote";

/// Reads `[uncertainty]` of a machine file.
pub fn read_joint(
    section: &Section<'_>,
    machine: &Machine,
    tables: &dyn Tables,
) -> Option<JointErrors> {
    let item = section.require("covariance", "the file that `identify --predictor` wrote")?;
    let name = item.text()?;
    let text = match tables.text(name) {
        Ok(text) => text,
        Err(reason) => {
            let message = format!("the covariance `{name}` cannot be read: {reason}");
            item.error("missing-table", message, "paths are relative to the machine file");
            return None;
        }
    };
    let shown = tables.display(name);
    let source = SourceText::new(&shown, &text);
    let read = source.read(|root| read_file(root, name, machine));
    let problems = source.finish();
    let sound = !problems.has_errors();
    section.take_over(problems);
    let joint = read.filter(|_| sound)?;
    if let Some(error) = differs(machine, &joint) {
        let message =
            format!("{error} of this file is not the one whose covariance `{name}` states");
        let hint = "an error that was changed has another uncertainty: delete [uncertainty], or write both files again \
                    with identify --predictor";
        item.error("other-covariance", message, hint);
        return None;
    }
    Some(joint)
}

fn read_file(root: &Section<'_>, name: &str, machine: &Machine) -> Option<JointErrors> {
    // They are for a later campaign and for the reader.
    for key in ["covariance", "setup", "readings", "scored"] {
        root.get(key);
    }
    let items = root.require("known", HINT)?.list()?;
    if items.len() > MOST_ROWS {
        let message = format!("{} rows, at most {MOST_ROWS} are read", items.len());
        root.error("bad-covariance", message, HINT);
        return None;
    }
    let mut rows = Vec::new();
    for (before, item) in items.iter().enumerate() {
        rows.push(item.section("known", |s| KnownRow::read(s, before)).flatten()?);
    }
    let functions = root.require("function", HINT)?;
    let functions = functions.section("function", |s| {
        let all = s.entries().into_iter().map(|(key, _, item)| {
            let is_row = |row: &KnownRow| matches!(&row.of[..], [(name, 1.0)] if name == key);
            let row = rows.iter().position(is_row);
            let known = row.map(|row| rows[row].value);
            let function = item.section(&s.path(key), |s| read_function(s, machine, known));
            Some((function.flatten()?, row))
        });
        all.collect::<Option<Vec<_>>>()
    });
    let (functions, places): (Vec<JointFunction>, Vec<Option<usize>>) =
        functions.flatten()?.into_iter().unzip();
    if let Some(row) = unused(&rows, &places) {
        let name = &rows[row].of[0].0;
        let message = format!(
            "what is known of `{name}` is not used: no other key of [function] is `{name}`"
        );
        items[row].error(
            "bad-covariance",
            message,
            "each name with the share 1.0, once, as in [function]",
        );
        return None;
    }
    let n = functions.len();
    let covariance = DMatrix::from_fn(n, n, |i, j| match (places[i], places[j]) {
        (Some(i), Some(j)) => rows[i.max(j)].covariance[i.min(j)],
        _ => 0.0,
    });
    let joint = JointErrors::new(name.to_owned(), functions, &covariance);
    if joint.is_none() {
        let message = "this is no covariance: a correlation is 1 or more".to_owned();
        root.error("bad-covariance", message, "take the file as identify wrote it");
    }
    joint
}

/// A row about one error that no function takes: its uncertainty would be lost. Set-ups and servo errors are for a later
/// campaign, sums of errors for the reader.
fn unused(rows: &[KnownRow], places: &[Option<usize>]) -> Option<usize> {
    let is_error = |name: &str| {
        let error = name.split(' ').next().and_then(ErrorName::parse);
        error.is_some() && !name.ends_with(" reversal")
    };
    (0..rows.len()).find(|row| {
        let alone = matches!(&rows[*row].of[..], [(name, _)] if is_error(name));
        alone && !places.contains(&Some(*row))
    })
}

/// `{ error = "EXX", polynomial = […], origin, scale }`, `cosine = 2`, `sine = 2`, `hat = "12 mm", step = "10 mm"`, or
/// the error alone: a constant.
fn read_function(
    section: &Section<'_>,
    machine: &Machine,
    known: Option<f64>,
) -> Option<JointFunction> {
    let item = section.require("error", "the error that it is part of: error = \"EXX\"")?;
    let text = item.text()?;
    let Some(error) = ErrorName::parse(text) else {
        let message = format!("`{text}` is not the name of an error of ISO 230-1");
        item.error("unknown-error-name", message, "write a name such as EXX, EAA or EC0Y");
        return None;
    };
    let Some(index) = machine.error_index(error) else {
        let message = format!("{error}: the chain has no body {}", error.body);
        item.error("unknown-body", message, "is it the covariance of another machine?");
        return None;
    };
    let value = match (known, section.get("value")) {
        (Some(value), None) => value,
        (None, Some(item)) => item.number()?,
        (None, None) => {
            let message = "nothing is known of this function".to_owned();
            section.error(
                "bad-covariance",
                message,
                "a [[known]] with of = { … = 1.0 }, or a value",
            );
            return None;
        }
        (Some(_), Some(item)) => {
            let message = "its value is stated twice".to_owned();
            item.error("bad-covariance", message, "keep that of [[known]]");
            return None;
        }
    };
    let position = machine.bodies()[index.body].axis.map(|i| match machine.axes()[i].kind {
        AxisKind::Linear => Dimension::Length,
        AxisKind::Rotary => Dimension::Angle,
    });
    let curve = match position.filter(|_| error.kind == ErrorKind::Motion) {
        Some(position) => read_curve(section, position)?,
        None => Curve::Constant(1.0),
    };
    Some(JointFunction { index, error, curve, value })
}

fn read_curve(section: &Section<'_>, position: Dimension) -> Option<Curve> {
    let order = |item: Item<'_>| item.count().map(|order| order as f64);
    let harmonic = |order, cosine, sine| {
        let terms = vec![Harmonic { order, cosine, sine }];
        Some(Curve::Fourier { mean: 0.0, terms })
    };
    if let Some(item) = section.get("polynomial") {
        let coefficients = item.list()?.iter().map(Item::number).collect::<Option<_>>()?;
        let origin = section.quantity("origin", position)?;
        let scale = section.quantity("scale", position)?;
        let curve = Curve::Polynomial { coefficients, origin, scale };
        return usable(&item, scale != 0.0, curve);
    }
    if let Some(item) = section.get("cosine") {
        return harmonic(order(item)?, 1.0, 0.0);
    }
    if let Some(item) = section.get("sine") {
        return harmonic(order(item)?, 0.0, 1.0);
    }
    let Some(item) = section.get("hat") else { return Some(Curve::Constant(1.0)) };
    let (at, step) = (item.quantity(position)?, section.quantity("step", position)?);
    let knots = [at - step, at, at + step];
    let spline = Spline::new(&knots, &[0.0, 1.0, 0.0], Interpolation::Linear);
    let Ok(spline) = spline else {
        item.error("bad-curve", "these knots do not rise".to_owned(), "step = \"10 mm\"");
        return None;
    };
    Some(Curve::Table { spline, outside: Extrapolation::Clamp })
}

fn usable(item: &Item<'_>, is: bool, curve: Curve) -> Option<Curve> {
    if !is {
        item.error("bad-curve", "the scale must not be zero".to_owned(), "scale = \"500 mm\"");
    }
    is.then_some(curve)
}

/// The first error whose functions with their factors are not what the machine file states.
fn differs(machine: &Machine, joint: &JointErrors) -> Option<ErrorName> {
    let runs = joint.functions().chunk_by(|a, b| a.index == b.index);
    runs.filter(|run| {
        let index = run[0].index;
        let stated = machine.bodies()[index.body].stated(index.kind, index.component);
        places(run).into_iter().any(|q| {
            let sum: f64 = run.iter().map(|f| f.value * f.curve.at(q).unwrap_or(0.0)).sum();
            // Beyond a table nothing is stated.
            let own = stated.map_or(Some(0.0), |s| s.at(q, 0.0).ok());
            let size: f64 =
                run.iter().map(|f| (f.value * f.curve.at(q).unwrap_or(0.0)).abs()).sum();
            own.is_some_and(|own| (own - sum).abs() > SAME_VALUE * size + SAME_MM)
        })
    })
    .map(|run| run[0].error)
    .next()
}

/// Some positions where functions of one error differ.
fn places(run: &[JointFunction]) -> Vec<f64> {
    let mut places = Vec::new();
    for function in run {
        match &function.curve {
            Curve::Polynomial { origin, scale, .. } => {
                places.extend([-0.9, -0.4, 0.1, 0.7].map(|x| origin + x * scale));
            }
            Curve::Table { spline, .. } => places.extend(spline.knots().get(1)),
            _ => places.extend([0.0, 0.7, 2.0, -1.1]),
        }
    }
    places.sort_by(f64::total_cmp);
    places.dedup();
    places
}
