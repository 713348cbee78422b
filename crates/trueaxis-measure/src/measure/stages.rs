//! `[[stage]]` of a campaign: what is calibrated in which order, and `prior`: what an earlier campaign left.
//!
//! ```text
//!     probe's zero ──> ball ──> linear axes ──> rotary axes        each hands on values with their covariance
//! ```
//!
//! All stages have the unknowns of the campaign; what one of them measures, the later ones know.

use super::prior::Prior;
use crate::instruments::instrument::SetupError;
use crate::unknowns::design::{Design, Unknown};
use std::path::{Path, PathBuf};
use trueaxis_geometry::Vec3;
use trueaxis_input::{Date, Dimension, Item, Place, Section};

/// A value that is stated without uncertainty is held to this. Unit: mm, rad or 1.
pub const FIXED_U: f64 = 1e-6;
/// Angles and scales that are stated without uncertainty, rad or 1.
const FIXED_U_ANGLE: f64 = 1e-9;
/// No table of a stage is longer.
const MOST_ROWS: usize = 100_000;

/// The stages of a campaign and what it starts from.
#[derive(Debug, Clone, Default)]
pub struct Stages {
    /// In the order of the file.
    pub list: Vec<Stage>,
    /// What an earlier campaign left.
    pub prior: Option<Prior>,
}

/// One stage.
#[derive(Debug, Clone)]
pub struct Stage {
    /// Its name.
    pub name: String,
    /// Where it stands in the campaign file.
    pub place: Place,
    /// When it was done, as written.
    pub date: Option<String>,
    /// The instruments whose readings belong to it.
    pub instruments: Vec<usize>,
    /// The readings of a probe where its true deviation is zero.
    pub zero: Option<ZeroStage>,
    /// Points on the ball from a coordinate measuring machine.
    pub ball: Option<BallStage>,
    /// Values with their uncertainties, as of a certificate.
    pub values: Vec<StatedValue>,
    /// What it was done with: key and what it says.
    pub with: Vec<(String, String, Place)>,
}

/// The zero of a probe, read where its ball joint is in the line of the taper.
#[derive(Debug, Clone)]
pub struct ZeroStage {
    /// The instrument.
    pub instrument: usize,
    /// The table of its readings.
    pub table: PathBuf,
    /// How far the joint may be from that line: standard uncertainty. Unit: mm or rad.
    pub u: f64,
    /// How many readings are planned.
    pub count: usize,
}

/// The ball, measured on a coordinate measuring machine.
#[derive(Debug, Clone)]
pub struct BallStage {
    /// The instrument whose ball it is.
    pub instrument: usize,
    /// The table of points on it.
    pub table: PathBuf,
    /// The standard uncertainty of a point, mm.
    pub u_mm: f64,
    /// The standard uncertainty with which its base plate lies on the table, mm.
    pub seat_u_mm: f64,
    /// The diameter of its certificate and the standard uncertainty of it, mm.
    pub diameter_mm: Option<(f64, f64)>,
    /// How many points are planned.
    pub count: usize,
}

/// A value that is known of an unknown.
#[derive(Debug, Clone)]
pub struct StatedValue {
    /// The unknown.
    pub name: String,
    /// Its value. Unit: mm, rad, s or 1.
    pub value: f64,
    /// Its standard uncertainty. Unit: mm, rad, s or 1.
    pub u: f64,
}

impl Stage {
    /// All readings of a campaign that has no stages.
    pub(super) fn of_all(instruments: usize, place: Place) -> Self {
        Self {
            name: "readings of this campaign".to_owned(),
            place,
            date: None,
            instruments: (0..instruments).collect(),
            zero: None,
            ball: None,
            values: Vec::new(),
            with: Vec::new(),
        }
    }

    /// Whether it measures without the axes of the machine.
    pub fn is_calibration(&self) -> bool {
        self.zero.is_some() || self.ball.is_some() || !self.values.is_empty()
    }

    /// All instruments that it has to do with.
    pub fn concerns(&self) -> Vec<usize> {
        let of =
            [self.zero.as_ref().map(|z| z.instrument), self.ball.as_ref().map(|b| b.instrument)];
        self.instruments.iter().copied().chain(of.into_iter().flatten()).collect()
    }
}

impl BallStage {
    /// Where its points are taken: even over the upper half of the ball (Fibonacci's lattice).
    pub fn directions(&self) -> Vec<Vec3> {
        let golden = std::f64::consts::PI * (3.0 - 5f64.sqrt());
        let one = |k: usize| {
            let z = (k as f64 + 0.5) / self.count as f64;
            let (r, turn) = ((1.0 - z * z).sqrt(), golden * k as f64);
            Vec3::new(r * turn.cos(), r * turn.sin(), z)
        };
        (0..self.count).map(one).collect()
    }
}

/// What a stage may refer to.
struct Context<'a> {
    design: &'a Design,
    folder: &'a Path,
}

impl Context<'_> {
    fn instrument(&self, item: &Item<'_>) -> Option<usize> {
        let name = item.text()?;
        let instruments = &self.design.instruments;
        let found = instruments.iter().position(|i| i.name == name);
        if found.is_none() {
            let names: Vec<&str> = instruments.iter().map(|i| i.name.as_str()).collect();
            let message = format!("the campaign has no instrument `{name}`");
            item.error("unknown-instrument", message, &format!("one of {}", names.join(", ")));
        }
        found
    }
}

/// Reads `[[stage]]`; every instrument belongs to one stage.
pub(super) fn read_stages(root: &Section<'_>, design: &Design, path: &Path) -> Vec<Stage> {
    let Some(item) = root.get("stage") else { return Vec::new() };
    let context = Context { design, folder: path.parent().unwrap_or(Path::new("")) };
    let items = item.list().unwrap_or_default();
    let read = |item: &Item<'_>| item.section("stage", |s| read_stage(s, &context)).flatten();
    let stages: Vec<Stage> = items.iter().filter_map(read).collect();
    if stages.len() == items.len() {
        check_names(root, &stages);
        check_instruments(root, design, &stages);
        check_equipment(root, design, &stages);
    }
    stages
}

fn read_stage(section: &Section<'_>, context: &Context<'_>) -> Option<Stage> {
    let name = section.require("name", "such as \"probe zero\"").and_then(|i| i.text());
    let instruments = match section.get("instruments") {
        None => Vec::new(),
        Some(item) => {
            let list = item.list().unwrap_or_default();
            list.iter().filter_map(|i| context.instrument(i)).collect()
        }
    };
    let zero = section.section("zero", |s| read_zero(s, context)).flatten();
    let ball = section.section("ball", |s| read_ball(s, context)).flatten();
    let mut values = Vec::new();
    section.section("values", |s| {
        for (key, _, item) in s.entries() {
            values.extend(read_value(&item, key, context.design));
        }
    });
    let mut with = Vec::new();
    section.section("with", |s| {
        for (key, place, item) in s.entries() {
            with.extend(item.text().map(|text| (key.to_owned(), text.trim().to_owned(), place)));
        }
    });
    let stage = Stage {
        name: name?.to_owned(),
        place: section.place(),
        date: section.get("date").and_then(|i| i.date_or_text()),
        instruments,
        zero,
        ball,
        values,
        with,
    };
    let asked =
        ["instruments", "zero", "ball", "values"].iter().any(|key| section.get(key).is_some());
    if stage.instruments.is_empty() && !stage.is_calibration() {
        if asked {
            // What is wrong with it was reported there, unless it is empty.
            return None;
        }
        let message = format!("stage `{}` measures nothing", stage.name);
        let hint = "instruments = [\"ball-bar\"], zero = { … }, ball = { … }, or values = { … }";
        section.error("missing-key", message, hint);
        return None;
    }
    Some(stage)
}

/// The instrument of `of` and its unknowns of one kind; the table of `key`.
fn read_table(
    section: &Section<'_>,
    context: &Context<'_>,
    (key, unknown): (&str, impl Fn(SetupError) -> bool),
) -> Option<(usize, PathBuf)> {
    let of = section.require("of", "the name of the instrument");
    let table = section.require(key, "a table (CSV)").and_then(|i| i.text());
    let of = of?;
    let instrument = context.instrument(&of)?;
    let own = &context.design.instruments[instrument];
    if key == "readings" && own.kind.triggers() {
        let message = format!("a {} has no zero that is read", own.kind.name());
        of.error("nothing-to-calibrate", message, "values = { \"NAME.radius\" = \"0 ± 1 um\" }");
        return None;
    }
    if !own.unknowns.iter().any(|u| unknown(u.error)) {
        let kind = own.kind;
        let what = if key == "points" { kind.reference_point() } else { kind.zero() };
        let message =
            format!("`{what}` is not among the unknowns of {}: nothing to calibrate", own.name);
        let hint = format!("[instrument.{}] unknown = {{ {what} = \"free\", … }}", own.name);
        of.error("nothing-to-calibrate", message, &hint);
        return None;
    }
    Some((instrument, context.folder.join(table?)))
}

fn read_zero(section: &Section<'_>, context: &Context<'_>) -> Option<ZeroStage> {
    let is_zero = |e| matches!(e, SetupError::Zero(_));
    let found = read_table(section, context, ("readings", is_zero));
    let angle =
        found.as_ref().is_some_and(|(i, _)| context.design.instruments[*i].sight.is_angle());
    let dimension = if angle { Dimension::Angle } else { Dimension::Length };
    let u = read_u(section, "u", dimension, "how well the ball joint was centred");
    let count = read_count(section, 10);
    let (instrument, table) = found?;
    Some(ZeroStage { instrument, table, u: u?, count: count? })
}

fn read_ball(section: &Section<'_>, context: &Context<'_>) -> Option<BallStage> {
    let is_point = |e| matches!(e, SetupError::ReferencePoint(_));
    let found = read_table(section, context, ("points", is_point));
    let u_mm = read_u(section, "u", Dimension::Length, "the uncertainty of a point");
    let seat_u_mm = read_u(section, "seat", Dimension::Length, "how the plate lies on the table");
    let count = read_count(section, 25);
    let diameter_mm = section.get("diameter").and_then(|item| {
        let read = item.measured(Dimension::Length)?;
        if read.u.is_none() || read.value <= 0.0 {
            let message = "the certificate of a diameter states its uncertainty".to_owned();
            item.error("no-uncertainty", message, "diameter = \"25 ± 0.0005 mm\"");
        }
        Some((read.value, read.u?))
    });
    let (instrument, table) = found?;
    let (u_mm, seat_u_mm, count) = (u_mm?, seat_u_mm?, count?);
    Some(BallStage { instrument, table, u_mm, seat_u_mm, diameter_mm, count })
}

/// A standard uncertainty; without one the value is handed on as if it were exact, with a warning.
fn read_u(section: &Section<'_>, key: &str, dimension: Dimension, what: &str) -> Option<f64> {
    let Some(item) = section.get(key) else {
        let message = format!("`{key}` is missing ({what}): it is taken as exact");
        section.warn(
            "fixed-value",
            message,
            &format!("{key} = \"0.5 um\", its standard uncertainty"),
        );
        return Some(0.0);
    };
    let u = item.quantity(dimension)?;
    if u < 0.0 {
        item.error("no-uncertainty", "a standard uncertainty is not negative".into(), "\"0.5 um\"");
        return None;
    }
    Some(u)
}

fn read_count(section: &Section<'_>, usual: usize) -> Option<usize> {
    let Some(item) = section.get("count") else { return Some(usual) };
    let count = item.count()?;
    if !(1..=MOST_ROWS).contains(&count) {
        item.error("bad-count", format!("1 to {MOST_ROWS} rows make sense"), "count = 12");
        return None;
    }
    Some(count)
}

fn read_value(item: &Item<'_>, key: &str, design: &Design) -> Option<StatedValue> {
    let found = (0..design.unknowns()).filter_map(|k| design.unknown(k)).find(|u| u.name() == key);
    let Some(unknown) = found else {
        let message = format!("`{key}` is not among the unknowns of the campaign");
        let hint = format!("one of {}", design.names().join(", "));
        item.error("unknown-error-name", message, &hint);
        return None;
    };
    let plain = matches!(unknown, Unknown::Setup(_, s) if s.error == SetupError::Scale);
    // A scale is written like a small angle: "0.5 um/m".
    let (dimension, fixed) = match (unknown.is_time(), unknown.is_angle() || plain) {
        (_, true) if unknown.is_rate() => (Dimension::AngularVelocity, FIXED_U_ANGLE / 3600.0),
        _ if unknown.is_rate() => (Dimension::Velocity, FIXED_U / 3600.0),
        (true, _) => (Dimension::Time, FIXED_U),
        (_, true) => (Dimension::Angle, FIXED_U_ANGLE),
        _ => (Dimension::Length, FIXED_U),
    };
    let read = item.measured(dimension)?;
    let u = read.u.filter(|u| *u > 0.0);
    if u.is_none() {
        let message = format!("{key} has no uncertainty: later stages take it as exact");
        item.warn("fixed-value", message, "such as \"12 ± 0.5 um\"");
    }
    // Drifts are by the hour.
    let by = if unknown.is_rate() { 3600.0 } else { 1.0 };
    let (value, u) = (read.value * by, u.unwrap_or(fixed) * by);
    Some(StatedValue { name: key.to_owned(), value, u })
}

fn check_names(root: &Section<'_>, stages: &[Stage]) {
    for (k, stage) in stages.iter().enumerate() {
        if let Some(first) = stages[..k].iter().find(|s| s.name == stage.name) {
            let message = format!(
                "two stages are called `{}`, the other in line {}",
                stage.name, first.place.line
            );
            let hint = "name each stage once: what is done twice counts twice";
            root.error_at(stage.place.clone(), "duplicate-stage", message, hint);
        }
    }
}

/// Every instrument belongs to one stage, every table of a calibration to one, too.
fn check_instruments(root: &Section<'_>, design: &Design, stages: &[Stage]) {
    for (k, instrument) in design.instruments.iter().enumerate() {
        let of: Vec<&Stage> = stages.iter().filter(|s| s.instruments.contains(&k)).collect();
        let name = &instrument.name;
        match of[..] {
            [] if stages.is_empty() => {}
            [] => {
                let message = format!("the readings of {name} are in no stage");
                let hint =
                    format!("instruments = [{name:?}] in the stage in which they were taken");
                root.error("no-stage", message, &hint);
            }
            [first, second, ..] => {
                let message = format!(
                    "the readings of {name} are in stage `{}` (line {}) already",
                    first.name, first.place.line
                );
                let hint = "readings that count twice look too sure: name the instrument once";
                root.error_at(second.place.clone(), "duplicate-stage", message, hint);
            }
            [_] => {}
        }
    }
    let tables = |s: &Stage| {
        let tables = [s.zero.as_ref().map(|z| &z.table), s.ball.as_ref().map(|b| &b.table)];
        tables.into_iter().flatten().cloned().collect::<Vec<_>>()
    };
    for (k, stage) in stages.iter().enumerate() {
        for table in tables(stage) {
            if let Some(first) = stages[..k].iter().find(|s| tables(s).contains(&table)) {
                let message = format!(
                    "{} is the table of stage `{}` (line {}) already",
                    table.display(),
                    first.name,
                    first.place.line
                );
                let hint = "readings that count twice look too sure: name the table once";
                root.error_at(stage.place.clone(), "duplicate-stage", message, hint);
            }
        }
    }
}

/// What several stages say they were done with is the same, and the length is that of the instrument.
fn check_equipment(root: &Section<'_>, design: &Design, stages: &[Stage]) {
    for (k, stage) in stages.iter().enumerate() {
        for (key, text, place) in &stage.with {
            if key == "length" {
                check_length(root, design, stage, (text, place));
                continue;
            }
            let other = stages[..k].iter().find_map(|s| {
                let found = s.with.iter().find(|(other, ..)| other == key)?;
                (found.1 != *text).then_some((s, found))
            });
            if let Some((first, (_, was, there))) = other {
                let message = format!(
                    "stage `{}` was done with {key} `{text}`, but stage `{}` (line {}) with `{was}`",
                    stage.name, first.name, there.line
                );
                let hint = "what is handed on holds for one set-up only: calibrate what is used";
                root.error_at(place.clone(), "stage-set-up", message, hint);
            }
        }
    }
    for pair in stages.windows(2) {
        let [Some(before), Some(after)] = [&pair[0], &pair[1]].map(|s| s.date.as_ref()) else {
            continue;
        };
        let days = Date::parse(before).zip(Date::parse(after));
        if days.is_some_and(|(before, after)| after < before) {
            let message = format!(
                "stage `{}` of {after} stands after stage `{}` of {before}",
                pair[1].name, pair[0].name
            );
            root.error_at(
                pair[1].place.clone(),
                "stage-order",
                message,
                "put the stages in the order of time",
            );
        }
    }
}

/// What an earlier campaign left contains what was known before it: stated again, it counts twice.
pub(super) fn warn_of_doubles(
    root: &Section<'_>,
    design: &Design,
    prior: &Prior,
    stages: &[Stage],
) {
    let own = design.prior();
    for (k, name) in own.names.iter().enumerate() {
        let stated = |s: &Stage| s.values.iter().any(|v| v.name == *name);
        let again = own.normal[(k, k)] > 0.0 || stages.iter().any(stated);
        if again && prior.known.normal[(k, k)] > 0.0 {
            let message = format!(
                "{name} is stated here and known from {}: if that is the same knowledge, it counts twice",
                prior.path.display()
            );
            let hint = "leave it out of [unknown.prior], `unknown` or `values`, or out of the file";
            root.warn("prior-twice", message, hint);
        }
    }
}

fn check_length(root: &Section<'_>, design: &Design, stage: &Stage, (text, place): (&str, &Place)) {
    let length = match trueaxis_input::parse_quantity(text, Dimension::Length) {
        Ok(length) => length,
        Err(e) => return root.error_at(place.clone(), e.code(), e.to_string(), &e.hint()),
    };
    for of in stage.concerns() {
        let crate::instruments::Instrument { name, length_mm, .. } = &design.instruments[of];
        if (length_mm - length).abs() > 1e-9 {
            let message = format!(
                "stage `{}` was done with a length of {length} mm, the `length` of {name} is {length_mm} mm",
                stage.name
            );
            let hint = "what is handed on holds for one set-up only: measure with the same bar";
            root.error_at(place.clone(), "stage-set-up", message, hint);
        }
    }
}
