//! The file of readings for error tables.

use super::reduce::{Role, role};
use super::{CircleReadings, ErrorReadings, ReferenceLine, TableStudy};
use crate::verify::Standard;
use crate::verify::certificate::read_at;
use crate::verify::import::{From, Import};
use crate::verify::iso230_2::{Direction, Measurement, read_deviations};
use std::path::Path;
use trueaxis_geometry::AxisKind;
use trueaxis_input::foreign::{self, Mapping};
use trueaxis_input::{Diagnostics, Dimension, Files, Item, Place, Section, SourceText};
use trueaxis_machine::Machine;
use trueaxis_machine::axis::Command;
use trueaxis_machine::errors::{ErrorKind, ErrorName};
use trueaxis_machine::file::{machine_of, read_vector_mm};
use trueaxis_machine::twist::Reference;

/// No axis in use has errors beyond these: mm, rad. A larger one is another unit.
const IMPOSSIBLE: [f64; 2] = [10.0, 0.05];
/// Larger than usual: mm, rad.
const UNUSUAL: [f64; 2] = [1.0, 2e-3];

/// Reads the file and the tables that it names.
pub fn read_tables(files: &Files, path: &Path) -> (Option<TableStudy>, Diagnostics) {
    let mut problems = Diagnostics::new();
    let Some(text) = files.text(path, "a file of readings (TOML)", &mut problems) else {
        return (None, problems);
    };
    parse_tables(files, path, &text)
}

/// The same of a text; its tables are looked for beside `path`.
pub fn parse_tables(files: &Files, path: &Path, text: &str) -> (Option<TableStudy>, Diagnostics) {
    let file = path.display().to_string();
    let source = SourceText::from(files, &file, text);
    let study = source.read(|root| read(root, path));
    let problems = source.finish();
    (study.filter(|_| !problems.has_errors()), problems)
}

fn read(root: &Section<'_>, path: &Path) -> Option<TableStudy> {
    let name = root.require("name", "say which machine this is, and when").and_then(|i| i.text());
    let date = root.get("date").and_then(|d| d.date_or_text());
    root.text("source");
    let (machine_path, machine) = machine_of(root, path)?;
    let mut readings = Vec::new();
    let mut circles = Vec::new();
    let mut stated = 0;
    let beside = Beside { machine: &machine, path, date: date.as_deref() };
    root.section("readings", |section| {
        for (key, place, item) in section.entries() {
            stated += 1;
            let Some(error) = ErrorName::parse(key).filter(|e| e.kind == ErrorKind::Motion) else {
                let message = format!("`{key}` is not an error motion");
                let hint = "[readings.EYX]: the error of ISO 230-1 that was read";
                section.error_at(place, "unknown-error-name", message, hint);
                continue;
            };
            let read =
                item.section(&section.path(key), |s| beside.readings(s, error, &place)).flatten();
            readings.extend(read);
        }
    });
    root.section("circle", |section| {
        for (key, _, item) in section.entries() {
            stated += 1;
            circles.extend(item.section(&section.path(key), |s| beside.circle(s)).flatten());
        }
    });
    if stated == 0 {
        let hint = "[readings.EXX] table = \"exx.csv\", or [circle.XY] table = \"xy.csv\"";
        root.error("nothing-read", "the file names no readings".to_owned(), hint);
    }
    let name = name?.to_owned();
    Some(TableStudy { name, machine_path, machine, readings, circles })
}

/// What all sections share.
struct Beside<'a> {
    machine: &'a Machine,
    path: &'a Path,
    date: Option<&'a str>,
}

impl Beside<'_> {
    fn readings(&self, s: &Section<'_>, name: ErrorName, place: &Place) -> Option<ErrorReadings> {
        let text = |key: &str| s.text(key).map(str::to_owned);
        // All keys are read before anything is given up, so that none is called unknown.
        let error = self.error(s, name, place);
        let table = self.table(s, "the readings: target, run, direction, deviation");
        let is_angle = name.component.is_rotation();
        let dimension = if is_angle { Dimension::Angle } else { Dimension::Length };
        let u = s.get("u").and_then(|item| positive(&item, dimension));
        if u.is_none() {
            let message = format!("{name}: no uncertainty of the instrument is stated");
            s.warn(
                "missing-uncertainty",
                message,
                "u = \"0.5 um\" or \"1 urad\", standard uncertainty",
            );
        }
        let at = self.at(s);
        let line = read_line(s);
        let centred = read_words(s, "eccentricity", &[("removed", true), ("kept", false)]);
        let stands_on =
            read_words(s, "stands_on", &[("table", Reference::Workpiece), ("bed", Reference::Bed)]);
        let of_workpiece = read_words(s, "reads", &[("tool", false), ("workpiece", true)]);
        let along = match name.body.is_rotary() {
            false => Dimension::Length,
            true => Dimension::Angle,
        };
        let zero = s.quantity("zero", along);
        let celsius = s.quantity("temperature", Dimension::Temperature);
        let u_ratio = s.get("u_ratio").and_then(|i| positive(&i, Dimension::Angle)).unwrap_or(0.0);
        let (instrument, optics_mm) = (text("instrument"), self.point(s, "optics"));
        let own_date = s.get("date").and_then(|d| d.date_or_text());
        let ((index, axis), (file, table, mapping)) = error.zip(table)?;
        if at.is_some_and(|at| at[axis] != 0.0) {
            let message =
                format!("at: the position of {} itself is that of each target", name.body);
            s.warn("idle-key", message, "leave it out of `at`");
        }
        if celsius.is_some_and(|c| !(-40.0..=150.0).contains(&c)) {
            let message = "no machine has this temperature".to_owned();
            s.error("impossible-temperature", message, "°C = (°F − 32)/1.8");
        }
        let role = role(&self.machine.axes()[axis], name.component);
        let celsius = celsius.or_else(|| self.assumed_celsius(s, name, (axis, role)));
        idle_keys(s, role);
        let mut problems = Diagnostics::new();
        // Reports of others say where the axis was, which is positioning.
        let form = Import::of(Path::new(&file));
        let (standard, mapping) = (Standard::Iso230_2, mapping.as_ref());
        let from = From { standard, file: &file, text: &table, feature: None, mapping };
        let read = form.read(&from, &mut problems);
        let measurement =
            read.and_then(|r| read_deviations(&file, r.table(), dimension, &mut problems));
        s.take_over(problems);
        let readings = ErrorReadings {
            name,
            index,
            axis,
            file,
            measurement: measurement?,
            instrument,
            date: own_date.or(self.date.map(str::to_owned)),
            celsius,
            u: u.unwrap_or(0.0),
            u_ratio,
            at: at?,
            optics_mm,
            stands_on: stands_on?,
            of_workpiece: of_workpiece?,
            line: line?,
            zero,
            centred: centred?,
        };
        self.check(s, &readings).then_some(readings)
    }

    /// The temperature of readings that state none: that at which the error table of the machine file holds. A warning
    /// says so, as the new readings may be of a warmer day. Only errors along a scale follow its temperature.
    fn assumed_celsius(
        &self,
        s: &Section<'_>,
        name: ErrorName,
        (axis, role): (usize, Role),
    ) -> Option<f64> {
        let scale = self.machine.heat().scales.iter().find(|scale| scale.axis == axis);
        let scale = scale.filter(|_| role == Role::Positioning)?;
        let celsius = scale.anchor.table_celsius;
        let message = format!(
            "{name}: the temperature of the scale is not stated; {celsius} °C is assumed, that of the table in the machine file"
        );
        let hint = "temperature = \"21.5 degC\" of the scale during the readings";
        s.warn("no-temperature", message, hint);
        Some(celsius)
    }

    fn error(
        &self,
        s: &Section<'_>,
        name: ErrorName,
        place: &Place,
    ) -> Option<(trueaxis_machine::errors::ErrorIndex, usize)> {
        let found = self.machine.error_index(name).zip(self.machine.axis_index(name.body));
        let Some((index, axis)) = found else {
            let message = format!("the machine has no axis `{}`", name.body);
            let hint = format!("its chain: {}", self.machine.chain_text());
            s.error_at(place.clone(), "unknown-axis", message, &hint);
            return None;
        };
        let of = &self.machine.axes()[axis];
        let is_slanted =
            of.kind == AxisKind::Linear && !of.direction.iter().any(|v| v.abs() > 1.0 - 1e-9);
        if is_slanted {
            let message = format!("{} does not move along a machine axis", of.name);
            let hint = "its errors have parts in several directions: identify them by a campaign";
            s.error_at(place.clone(), "slanted-axis", message, hint);
            return None;
        }
        Some((index, axis))
    }

    /// Name and text of the table, and its mapping file if it has one.
    fn table(&self, s: &Section<'_>, what: &str) -> Option<(String, String, Option<Mapping>)> {
        let name = s.require("table", &format!("table = \"readings.csv\": {what}"))?.text()?;
        let folder = self.path.parent().unwrap_or(Path::new(""));
        let (path, map) = (folder.join(name), s.text("map").map(|name| folder.join(name)));
        let mut problems = Diagnostics::new();
        let mapping = foreign::read_mapping(s.files(), map.as_deref(), &path, &mut problems);
        let what = "a table of readings (CSV)";
        let text = foreign::text(s.files(), &path, what, mapping.as_ref(), &mut problems);
        s.take_over(problems);
        Some((path.display().to_string(), text?, mapping))
    }

    fn at(&self, s: &Section<'_>) -> Option<Command> {
        match s.get("at") {
            Some(item) => read_at(s, &item, self.machine),
            None => Some(Command::default()),
        }
    }

    fn point(&self, s: &Section<'_>, key: &str) -> trueaxis_geometry::Vec3 {
        s.get(key).and_then(|item| read_vector_mm(&item)).unwrap_or(self.machine.tip_mm())
    }

    fn circle(&self, s: &Section<'_>) -> Option<CircleReadings> {
        let table = self.table(s, "the points: x_mm, y_mm, direction");
        let centre = s.require("centre", "centre = \"3000 1250 mm\", as commanded");
        let centre_mm = centre.and_then(|item| read_pair(&item));
        let radius = s.require("radius", "radius = \"150 mm\", nominal");
        let radius_mm = radius.and_then(|item| positive(&item, Dimension::Length));
        let u_mm = s.get("u").and_then(|item| positive(&item, Dimension::Length));
        if u_mm.is_none() {
            let message = "no uncertainty of the ball-bar is stated".to_owned();
            s.warn(
                "missing-uncertainty",
                message,
                "u = \"0.5 um\", standard uncertainty of a reading",
            );
        }
        s.text("instrument");
        let (at, ball_mm) = (self.at(s), self.point(s, "ball"));
        let (file, text, mapping) = table?;
        let mut problems = Diagnostics::new();
        let (standard, mapping) = (Standard::Iso230_4, mapping.as_ref());
        let from = From { standard, file: &file, text: &text, feature: None, mapping };
        let read = Import::of(Path::new(&file)).read(&from, &mut problems);
        let text = read.map(|r| r.table().to_owned());
        s.take_over(problems);
        Some(CircleReadings {
            text: text?,
            file,
            centre_mm: centre_mm?,
            radius_mm: radius_mm?,
            at: at?,
            ball_mm,
            u_mm: u_mm.unwrap_or(0.0),
        })
    }

    /// What cannot be, and what is unusual.
    fn check(&self, s: &Section<'_>, readings: &ErrorReadings) -> bool {
        let axis = &self.machine.axes()[readings.axis];
        let measurement = &readings.measurement;
        if measurement.kind != axis.kind {
            let message = format!("{} is an axis of the other kind than the targets", axis.name);
            s.error(
                "wrong-axis",
                message,
                "target_mm for a linear axis, target_deg for a rotary one",
            );
            return false;
        }
        let of = usize::from(readings.name.component.is_rotation());
        let largest = largest(measurement);
        if largest > IMPOSSIBLE[of] {
            let message = format!("{}: {} cannot be", readings.name, shown(largest, of));
            s.error("impossible-error", message, "is the unit of the heading right?");
            return false;
        }
        if largest > UNUSUAL[of] {
            let message = format!("{}: {} is large", readings.name, shown(largest, of));
            s.warn("unusual-error", message, "is the unit of the heading right?");
        }
        if readings.stands_on == Reference::Bed
            && readings.index.body < self.machine.workpiece_side()
        {
            let message = format!(
                "{} carries the workpiece: from the bed it is not seen at the tool",
                axis.name
            );
            s.error("not-seen", message, "stands_on = \"table\"");
            return false;
        }
        if let Some(outside) =
            measurement.targets.iter().find(|t| !axis.travel.contains(t.position))
        {
            let q = trueaxis_machine::describe::shown(axis, outside.position);
            let unit = trueaxis_machine::describe::unit(axis);
            let message = format!("{q} {unit} is outside the travel of {}", axis.name);
            s.error("outside-travel", message, "is it another axis, or another unit?");
            return false;
        }
        self.check_repeats(s, readings)
    }

    /// Rows that are there twice.
    fn check_repeats(&self, s: &Section<'_>, readings: &ErrorReadings) -> bool {
        for target in &readings.measurement.targets {
            for direction in [Direction::Up, Direction::Down] {
                let rows = target.of(direction);
                let twice = rows.windows(2).find(|w| w[0].run == w[1].run);
                if let Some(row) = twice {
                    let axis = &self.machine.axes()[readings.axis];
                    let q = trueaxis_machine::describe::shown(axis, target.position);
                    let message =
                        format!("{}: run {} reads the target {q} twice", readings.name, row[0].run);
                    s.error("reading-twice", message, "one row for each target, run and direction");
                    return false;
                }
            }
        }
        true
    }
}

fn largest(measurement: &Measurement) -> f64 {
    let all = measurement.targets.iter().flat_map(|t| t.up.iter().chain(&t.down));
    all.map(|r| r.deviation.abs()).fold(0.0, f64::max)
}

fn shown(value: f64, is_angle: usize) -> String {
    match is_angle {
        0 => format!("{value:.3} mm"),
        _ => format!("{:.0} µrad", value * 1e6),
    }
}

fn positive(item: &Item<'_>, dimension: Dimension) -> Option<f64> {
    let value = item.quantity(dimension)?;
    if value <= 0.0 {
        item.error("not-positive", "must be positive".to_owned(), "");
    }
    (value > 0.0).then_some(value)
}

fn read_line(s: &Section<'_>) -> Option<ReferenceLine> {
    let words = [
        ("least-squares", ReferenceLine::LeastSquares),
        ("ends", ReferenceLine::Ends),
        ("none", ReferenceLine::None),
    ];
    read_words(s, "line", &words)
}

/// One of some words; the first is the default.
fn read_words<T: Copy>(s: &Section<'_>, key: &str, words: &[(&str, T)]) -> Option<T> {
    let Some(item) = s.get(key) else { return Some(words[0].1) };
    let text = item.text()?;
    let found = words.iter().find(|(word, _)| *word == text).map(|(_, value)| *value);
    if found.is_none() {
        let known: Vec<String> = words.iter().map(|(word, _)| format!("\"{word}\"")).collect();
        item.error("unknown-word", format!("unknown {key} `{text}`"), &known.join(" or "));
    }
    found
}

/// `"3000 1250 mm"`.
fn read_pair(item: &Item<'_>) -> Option<[f64; 2]> {
    let text = item.text()?;
    let words: Vec<&str> = text.split_whitespace().collect();
    let pair = match words[..] {
        [a, b, unit] => {
            let of = |n: &str| {
                trueaxis_input::parse_quantity(&format!("{n} {unit}"), Dimension::Length).ok()
            };
            of(a).zip(of(b)).map(|(a, b)| [a, b])
        }
        _ => None,
    };
    if pair.is_none() {
        item.error("bad-position", format!("`{text}` is not a point"), "\"3000 1250 mm\"");
    }
    pair
}

/// Straightness alone has a reference line, run-out alone an artefact.
fn idle_keys(s: &Section<'_>, role: Role) {
    let uses = [
        ("line", role == Role::Straightness),
        ("eccentricity", matches!(role, Role::RunOut | Role::Axial)),
    ];
    for (key, is_used) in uses {
        if !is_used && s.get(key).is_some() {
            let message = format!("`{key}` has no meaning for this error");
            s.warn(
                "idle-key",
                message,
                "line: straightness; eccentricity: run-out and tilt of rotary axes",
            );
        }
    }
}
