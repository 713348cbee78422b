//! `[[input]]` of a study.

use crate::distribution::Distribution;
use crate::inputs::{Input, Level, Term, Varied};
use std::path::Path;
use std::sync::Arc;
use trueaxis::input::plausible::Quantity;
use trueaxis::input::{Diagnostics, Item, Section};
use trueaxis::machine::Machine;
use trueaxis::machine::errors::{BodyName, ErrorKind, ErrorName};
use trueaxis::simulate::read_temperature_log;

/// Terms of a curve beyond these are finer than any guideway.
const MOST_TERMS: usize = 12;
const USUAL_TERMS: usize = 4;

const DISTRIBUTION: &str = "\"12 ± 2 um\" (normal), { uniform = [\"-5 um\", \"5 um\"] }, { triangular = [low, mode, high] }, \
     { arcsine = [low, high] } or { values = [ … ] }";

/// What the entries of all inputs are read with.
pub(super) struct Reader<'a> {
    pub folder: &'a Path,
    /// Of the first case: what a curve runs along.
    pub machine: Option<&'a Machine>,
}

impl Reader<'_> {
    /// The inputs of one entry; a curve is several.
    pub fn read(&self, item: &Item<'_>) -> Option<Vec<Input>> {
        item.section("input", |s| self.entry(s)).flatten()
    }

    fn entry(&self, s: &Section<'_>) -> Option<Vec<Input>> {
        let kinds = ["error", "temperature", "log", "workpiece", "setting", "tool_length"];
        let given: Vec<&str> = kinds.into_iter().filter(|kind| s.get(kind).is_some()).collect();
        let [kind] = given[..] else {
            let message = match given.is_empty() {
                true => "this input says not what it varies".to_owned(),
                false => format!("this input varies more than one thing: {}", given.join(", ")),
            };
            s.error("one-input", message, &format!("exactly one of {}", kinds.join(", ")));
            // Their keys are not called unknown.
            s.entries();
            return None;
        };
        let usual =
            if matches!(kind, "temperature" | "log") { Level::Hall } else { Level::Machine };
        let level = read_level(s).unwrap_or(Some(usual));
        let found = match kind {
            "error" => self.of_error(s),
            "temperature" => temperature(s),
            "log" => self.log(s),
            "workpiece" => workpiece(s),
            "setting" => setting(s),
            _ => tool_length(s),
        };
        let (own_name, drawn) = found?;
        let name = s.text("name").unwrap_or(&own_name).to_owned();
        let group = s.text("group").unwrap_or(&name).to_owned();
        let level = level?;
        let several = drawn.len() > 1;
        let input = |(i, (varied, distribution)): (usize, (Varied, Distribution))| Input {
            name: if several { format!("{name} #{}", i + 1) } else { name.clone() },
            group: group.clone(),
            level,
            varied,
            distribution,
        };
        Some(drawn.into_iter().enumerate().map(input).collect())
    }

    fn of_error(&self, s: &Section<'_>) -> Option<Drawn> {
        let errors = read_errors(&s.get("error")?);
        let keys = ["value", "added", "scale", "curve"];
        let given: Vec<&str> = keys.into_iter().filter(|key| s.get(key).is_some()).collect();
        let [key] = given[..] else {
            let message = "an error is varied in one way".to_owned();
            let hint = "one of `value` (instead of the stated one), `added`, `scale` (a factor), `curve` (a random one)";
            s.error("one-input", message, hint);
            return None;
        };
        let (item, errors) = (s.get(key)?, errors?);
        let names = errors.iter().map(ErrorName::to_string).collect::<Vec<_>>().join(" ");
        if key == "curve" {
            return self.curves(&item, &errors, &names);
        }
        let location = |e: &ErrorName| e.kind == ErrorKind::Location;
        if let Some(motion) = errors.iter().find(|e| key == "value" && !location(e)) {
            let message = format!("{motion} changes along its axis: one value does not state it");
            item.error("not-a-location", message, "`scale`, `added` or `curve`");
            return None;
        }
        let quantity = match key {
            "scale" => None,
            _ => errors.first().map(quantity_of),
        };
        let mixed = errors.iter().any(|e| e.component.is_rotation())
            && errors.iter().any(|e| !e.component.is_rotation());
        if quantity.is_some() && mixed {
            let message = "displacements and angles have no common value".to_owned();
            item.error("no-common-unit", message, "an input for each, in one `group`");
            return None;
        }
        let distribution = read_distribution(&item, quantity)?;
        let (name, varied) = match key {
            "value" => (names, Varied::Value(errors)),
            "added" => (format!("{names} added"), Varied::Added(errors)),
            _ => (format!("{names} scale"), Varied::Scale(errors)),
        };
        Some((name, vec![(varied, distribution)]))
    }

    fn curves(&self, item: &Item<'_>, errors: &[ErrorName], names: &str) -> Option<Drawn> {
        let is_angle = errors.iter().any(|e| e.component.is_rotation());
        if is_angle && errors.iter().any(|e| !e.component.is_rotation()) {
            let message = "displacements and angles have no common u".to_owned();
            item.error("no-common-unit", message, "an input for each, in one `group`");
            return None;
        }
        let quantity = if is_angle { Quantity::AngleError } else { Quantity::PositionError };
        let (u, count) = item.section("curve", |s| {
            let hint = "the root mean square of the curve along the axis, such as \"3 um\"";
            let u = s.require("u", hint).and_then(|i| {
                let u = i.quantity_of(quantity)?;
                (u > 0.0).then_some(u).or_else(|| {
                    i.error(
                        "not-positive",
                        "u of a curve is above zero".into(),
                        "such as \"3 um\"",
                    );
                    None
                })
            });
            let terms = s.get("terms").map_or(Some(USUAL_TERMS), |i| {
                let terms = i.count()?;
                (1..=MOST_TERMS).contains(&terms).then_some(terms).or_else(|| {
                    i.error("bad-count", format!("{terms} terms"), &format!("1 to {MOST_TERMS}"));
                    None
                })
            });
            Some((u?, terms?))
        })??;
        let machine = self.machine?;
        let mut drawn = Vec::new();
        for error in errors {
            match Term::of(machine, *error, count) {
                Ok(terms) => drawn.extend(terms.into_iter().map(|(term, share)| {
                    let varied = Varied::Curve { error: *error, term, u: u * share.sqrt() };
                    (varied, Distribution::Normal { mean: 0.0, u: 1.0 })
                })),
                Err(why) => {
                    item.error("no-curve", why, "an error motion of an axis of this machine");
                    return None;
                }
            }
        }
        Some((format!("{names} curve"), drawn))
    }

    fn log(&self, s: &Section<'_>) -> Option<Drawn> {
        let item = s.get("log")?;
        let name = item.text()?;
        let mut problems = Diagnostics::new();
        let log = read_temperature_log(s.files(), &self.folder.join(name), &mut problems);
        s.take_over(problems);
        let log = Arc::new(log?);
        let times = log.times_s();
        let (low, high) = (*times.first()?, *times.last()?);
        let drawn = (Varied::Log(log), Distribution::Uniform { low, high });
        Some((format!("log {name}"), vec![drawn]))
    }
}

/// The name of an entry, and the numbers that it draws.
type Drawn = (String, Vec<(Varied, Distribution)>);

fn temperature(s: &Section<'_>) -> Option<Drawn> {
    let item = s.get("temperature")?;
    let sensors: Vec<String> = match item.is_list() {
        true => item.list()?.iter().map(|i| i.text().map(str::to_owned)).collect::<Option<_>>()?,
        false => vec![item.text()?.to_owned()],
    };
    let value = s.require("value", DISTRIBUTION)?;
    let distribution = read_distribution(&value, Some(Quantity::Temperature))?;
    Some((sensors.join(" "), vec![(Varied::Temperatures(sensors), distribution)]))
}

fn workpiece(s: &Section<'_>) -> Option<Drawn> {
    let item = s.get("workpiece")?;
    let letter = item.text()?;
    let Some(axis) = ["X", "Y", "Z"].iter().position(|l| *l == letter) else {
        let message = format!("`{letter}` is no direction of the base of the workpiece");
        item.error("unknown-word", message, "X, Y or Z");
        return None;
    };
    let value = s.require("value", DISTRIBUTION)?;
    let distribution = read_distribution(&value, Some(Quantity::Length))?;
    Some((format!("workpiece {letter}"), vec![(Varied::Workpiece(axis), distribution)]))
}

fn setting(s: &Section<'_>) -> Option<Drawn> {
    let item = s.get("setting")?;
    let letter = item.text()?;
    let axis = letter.chars().next().filter(|_| letter.len() == 1).and_then(BodyName::new);
    let Some(axis) = axis else {
        item.error("unknown-axis", format!("`{letter}` is no axis"), "the letter of a rotary axis");
        return None;
    };
    let value = s.require("value", DISTRIBUTION)?;
    let distribution = read_distribution(&value, Some(Quantity::RotaryPosition))?;
    Some((format!("setting {letter}"), vec![(Varied::Setting(axis), distribution)]))
}

fn tool_length(s: &Section<'_>) -> Option<Drawn> {
    let distribution = read_distribution(&s.get("tool_length")?, Some(Quantity::ToolLength))?;
    Some(("tool length".to_owned(), vec![(Varied::ToolLength, distribution)]))
}

fn read_level(s: &Section<'_>) -> Option<Option<Level>> {
    let item = s.get("per")?;
    let word = item.text();
    let level = word.and_then(|w| Level::ALL.into_iter().find(|l| l.word() == w));
    if let (Some(word), None) = (word, level) {
        let hint = "machine (once for each), day (each day of each machine), hall (each day, the same for all machines)";
        item.error("unknown-word", format!("`{word}` is no level"), hint);
    }
    Some(level)
}

fn read_errors(item: &Item<'_>) -> Option<Vec<ErrorName>> {
    let read = |item: &Item<'_>| {
        let text = item.text()?;
        let name = ErrorName::parse(text);
        if name.is_none() {
            let message = format!("`{text}` is no error by ISO 230-1");
            item.error("unknown-error-name", message, "such as EC0Y (location) or EYX (motion)");
        }
        name
    };
    let errors: Vec<ErrorName> = match item.is_list() {
        true => item.list()?.iter().map(read).collect::<Option<_>>()?,
        false => vec![read(item)?],
    };
    let twice = errors.iter().enumerate().find(|(i, e)| errors[..*i].contains(e));
    if let Some((_, twice)) = twice {
        item.error("duplicate-input", format!("{twice} is named twice"), "name it once");
        return None;
    }
    if errors.is_empty() {
        item.error("bad-count", "no error is named".to_owned(), "one or more");
        return None;
    }
    Some(errors)
}

fn quantity_of(error: &ErrorName) -> Quantity {
    match (error.kind, error.component.is_rotation()) {
        (ErrorKind::Location, false) => Quantity::LocationError,
        (ErrorKind::Location, true) => Quantity::LocationAngle,
        (ErrorKind::Motion, false) => Quantity::PositionError,
        (ErrorKind::Motion, true) => Quantity::AngleError,
    }
}

/// A distribution of a quantity; without one, of a factor.
fn read_distribution(item: &Item<'_>, quantity: Option<Quantity>) -> Option<Distribution> {
    if !item.is_table() {
        return read_normal(item, quantity);
    }
    item.section("distribution", |s| {
        let all = s.entries();
        let [(key, place, item)] = &all[..] else {
            s.error(
                "one-distribution",
                format!("{} entries of a distribution", all.len()),
                DISTRIBUTION,
            );
            return None;
        };
        let numbers = |count: Option<usize>| -> Option<Vec<f64>> {
            let list = item.list()?;
            if list.is_empty() || count.is_some_and(|count| list.len() != count) {
                let wanted = count.map_or("one or more".to_owned(), |n| n.to_string());
                item.error("bad-count", format!("{} values", list.len()), &wanted);
                return None;
            }
            list.iter().map(|i| read_number(i, quantity)).collect()
        };
        let distribution = match *key {
            "normal" => read_normal(item, quantity)?,
            "uniform" | "arcsine" => {
                let [low, high] = numbers(Some(2))?.try_into().ok()?;
                match *key {
                    "uniform" => Distribution::Uniform { low, high },
                    _ => Distribution::Arcsine { low, high },
                }
            }
            "triangular" => {
                let [low, mode, high] = numbers(Some(3))?.try_into().ok()?;
                Distribution::Triangular { low, mode, high }
            }
            "values" => Distribution::Values(numbers(None)?),
            other => {
                let message = format!("`{other}` is no distribution");
                s.error_at(place.clone(), "unknown-word", message, DISTRIBUTION);
                return None;
            }
        };
        let rises = match &distribution {
            Distribution::Uniform { low, high } | Distribution::Arcsine { low, high } => low < high,
            Distribution::Triangular { low, mode, high } => {
                low <= mode && mode <= high && low < high
            }
            _ => true,
        };
        if !rises {
            item.error("bad-range", "the limits do not rise".to_owned(), "the lower limit first");
        }
        rises.then_some(distribution)
    })?
}

fn read_normal(item: &Item<'_>, quantity: Option<Quantity>) -> Option<Distribution> {
    let known = match quantity {
        Some(quantity) => item.measured_of(quantity)?,
        None => item.measured(trueaxis::input::Dimension::Ratio)?,
    };
    let Some(u) = known.u.filter(|u| *u > 0.0) else {
        item.error("no-uncertainty", "a value that does not vary".to_owned(), DISTRIBUTION);
        return None;
    };
    // Also what is drawn must be possible, not only the mean.
    let far = [known.value - 3.0 * u, known.value + 3.0 * u];
    let possible = |q| far.iter().all(|v| item.is_possible(q, *v));
    quantity.is_none_or(possible).then_some(Distribution::Normal { mean: known.value, u })
}

fn read_number(item: &Item<'_>, quantity: Option<Quantity>) -> Option<f64> {
    match quantity {
        Some(quantity) => item.quantity_of(quantity),
        None => item.quantity(trueaxis::input::Dimension::Ratio),
    }
}
