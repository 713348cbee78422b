//! Holes on a circle in a warm hall: where they will be, before and after compensation.
//!
//! Zhang et al. 2019: compensating the machine alone can make the part worse, since the growth of the
//! machine and that of the workpiece no longer cancel.

mod drawn;

pub use drawn::{CommandedHoles, HolesOfMachine};

use super::Error;
use super::acted::{ActedRecord, ActedRow, SAME_PLACE_MM, machine_then, moved};
use super::location::LocationCircle;
use super::running::running_machine;
use super::temperatures::{CuttingClock, RunningTemperatures, StudyTemperatures};
use std::path::Path;
use trueaxis_geometry::Vec3;
use trueaxis_geometry::frame::{Direction, Point};
use trueaxis_input::plausible::Quantity;
use trueaxis_input::{Diagnostics, Dimension, Files, Place, Section, SourceText};
use trueaxis_machine::axis::{Approach, Command};
use trueaxis_machine::errors::ErrorValues;
use trueaxis_machine::file::read_vector_mm;
use trueaxis_machine::{Machine, Target};

/// More holes than this are a slip of the pen.
const MOST_HOLES: usize = 100_000;

/// What the control adds to its commands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Compensation {
    /// Nothing.
    None,
    /// Minus the error of the machine.
    Machine,
    /// Minus the comprehensive error, machine − workpiece.
    Comprehensive,
}

impl Compensation {
    /// All three, in the order of reports.
    pub const ALL: [Self; 3] = [Self::None, Self::Machine, Self::Comprehensive];

    /// Its name in files, reports and JSON.
    pub fn name(self) -> &'static str {
        match self {
            Self::None => "none",
            Self::Machine => "machine",
            Self::Comprehensive => "comprehensive",
        }
    }
}

/// What the holes of a set are made with.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Applied {
    /// A compensation that is computed.
    By(Compensation),
    /// What a record says that acted.
    Acted,
}

impl Applied {
    /// Its name in files, reports and JSON.
    pub fn name(self) -> &'static str {
        match self {
            Self::By(compensation) => compensation.name(),
            Self::Acted => "acted",
        }
    }
}

/// Holes evenly on a circle, on a machine at temperatures.
#[derive(Debug)]
pub struct HoleStudy {
    /// Its name.
    pub name: String,
    /// The machine at its temperatures, those of the start if a log runs on.
    pub machine: Machine,
    /// The log that runs on while the holes are made, if one does.
    pub temperatures: Option<RunningTemperatures>,
    /// The nominal places, in the workpiece frame, mm.
    pub holes_mm: Vec<Vec3>,
    /// Largest distance of a hole from its place in X and Y, mm, if one is stated.
    pub tolerance_mm: Option<f64>,
    /// Largest deviation of the location diameter either way, mm, if one is stated.
    pub location_tolerance_mm: Option<f64>,
    /// The least increment of a compensation value, mm.
    pub increment_mm: f64,
    /// Which compensation is on: the verdict is about it.
    pub applied: Applied,
    /// The record of a live run, of a part that is made.
    pub acted: Option<ActedRecord>,
    /// The study states temperatures; those of a record are not used then.
    pub states_temperatures: bool,
}

/// One hole under one compensation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hole {
    /// What the control adds, in least increments along x, y, z.
    pub increments: [i64; 3],
    /// Where the hole is at 20 °C, less where it should be, mm.
    pub error_mm: Vec3,
    /// Standard uncertainty of that along x, y, z, mm.
    pub u_mm: Vec3,
    /// Standard uncertainty of [`Hole::distance_mm`], mm.
    pub u_distance_mm: f64,
}

impl Hole {
    /// Distance from its place in X and Y, mm.
    pub fn distance_mm(&self) -> f64 {
        self.error_mm.xy().norm()
    }
}

/// All holes under one compensation.
#[derive(Debug, Clone, PartialEq)]
pub struct HoleSet {
    /// Which one.
    pub compensation: Applied,
    /// In the order of the study.
    pub holes: Vec<Hole>,
    /// The largest distance from its place, mm.
    pub worst_mm: f64,
    /// Its standard uncertainty, mm.
    pub u_worst_mm: f64,
    /// Whether all places are in tolerance, if one is stated.
    pub in_tolerance: Option<bool>,
    /// Whether the location diameter is in its tolerance, if one is stated.
    pub location_in_tolerance: Option<bool>,
    /// The circle on which they are; none for fewer than three.
    pub location: Option<LocationCircle>,
}

impl HoleSet {
    /// Whether all stated tolerances are kept; none if none is stated.
    pub fn keeps_tolerances(&self) -> Option<bool> {
        let stated = [self.in_tolerance, self.location_in_tolerance];
        stated.into_iter().flatten().reduce(|one, other| one && other)
    }
}

/// All that was found out about the holes.
#[derive(Debug, Clone, PartialEq)]
pub struct HolePrediction {
    /// None, machine, comprehensive, and what acted where there is a record.
    pub sets: Vec<HoleSet>,
    /// The same at the temperatures of the start, held, where a log runs on.
    pub held: Option<Vec<HoleSet>>,
    /// When each hole is made, s from the start; all 0 without a log or a record.
    pub times_s: Vec<f64>,
    /// What the reader must know, each with its code.
    pub warnings: Vec<(&'static str, String)>,
    /// What grows though the uncertainty of its coefficient is not stated: u lacks it.
    pub without_u: Vec<String>,
}

/// Whether a study file is about holes.
pub fn is_hole_study(files: &Files, path: &Path) -> bool {
    let text = files.text(path, "a study file", &mut Diagnostics::new());
    text.is_some_and(|t| t.lines().any(|line| line.trim() == "[holes]"))
}

/// Reads a study of holes; all problems at once.
pub fn read_hole_study(files: &Files, path: &Path) -> (Option<HoleStudy>, Diagnostics) {
    let mut problems = Diagnostics::new();
    let Some(text) = files.text(path, "a study file (TOML)", &mut problems) else {
        return (None, problems);
    };
    parse_hole_study(files, path, &text)
}

/// The same of a text; its machine is looked for beside `path`.
pub fn parse_hole_study(
    files: &Files,
    path: &Path,
    text: &str,
) -> (Option<HoleStudy>, Diagnostics) {
    let file = path.display().to_string();
    let source = SourceText::from(files, &file, text);
    let study = source.read(|root| read(root, path));
    let problems = source.finish();
    (study.filter(|_| !problems.has_errors()), problems)
}

fn read(root: &Section<'_>, path: &Path) -> Option<HoleStudy> {
    let name = root.require("name", "give the study a name").and_then(|i| i.text());
    let machine = running_machine(root, path).map(|(_, machine)| machine);
    let folder = path.parent().unwrap_or(Path::new(""));
    let temperatures = StudyTemperatures::read(root, folder, false);
    let states_temperatures = temperatures.conditions.is_some();
    let holes = root.section("holes", read_holes).flatten();
    let compensation =
        root.section("compensation", |s| read_compensation(s, folder, machine.as_ref()));
    let Stated { increment_mm, applied, acted, names_record } = compensation.unwrap_or_default();
    let machine = match names_record && !states_temperatures {
        // Each hole at the temperatures of its row.
        true => machine,
        false => machine.and_then(|m| temperatures.warm(root, m)),
    };
    let (holes_mm, [tolerance_mm, location_tolerance_mm]) = holes?;
    Some(HoleStudy {
        name: name?.to_owned(),
        machine: machine?,
        temperatures: temperatures.running,
        holes_mm,
        tolerance_mm,
        location_tolerance_mm,
        increment_mm: increment_mm.unwrap_or(1e-3),
        applied: match acted {
            Some(_) => Applied::Acted,
            None => Applied::By(applied.unwrap_or(Compensation::None)),
        },
        acted,
        states_temperatures,
    })
}

/// What `[compensation]` says.
#[derive(Default)]
struct Stated {
    increment_mm: Option<f64>,
    applied: Option<Compensation>,
    acted: Option<ActedRecord>,
    /// Sound or not.
    names_record: bool,
}

fn read_compensation(section: &Section<'_>, folder: &Path, machine: Option<&Machine>) -> Stated {
    let increment_mm = section.quantity("increment", Dimension::Length);
    let names_record = section.get("acted").is_some();
    let applied = section.get("applied").and_then(|item| {
        let word = item.text()?;
        let found = Compensation::ALL.into_iter().find(|c| c.name() == word);
        if found.is_none() {
            let message = format!("`{word}` is no compensation");
            item.error("unknown-word", message, "none, machine or comprehensive");
        } else if names_record {
            let message = "`applied` and `acted` exclude each other".to_owned();
            item.error("contradiction", message, "with a record the verdict is about what acted");
        }
        found
    });
    if increment_mm.is_some_and(|i| i <= 0.0) {
        section.error("not-positive", "an increment is above zero".into(), "such as \"1 um\"");
    }
    let acted = machine.and_then(|machine| ActedRecord::named(section, folder, machine));
    Stated { increment_mm, applied, acted, names_record }
}

fn read_holes(section: &Section<'_>) -> Option<(Vec<Vec3>, [Option<f64>; 2])> {
    let count = section.require("count", "how many holes, such as 32").and_then(|i| i.count());
    let hint = "the diameter of their circle, such as \"1800 mm\"";
    let circle = section.require("circle", hint).and_then(|item| {
        let diameter_mm = item.quantity(Dimension::Length)?;
        if diameter_mm <= 0.0 {
            // All holes in one place have no location diameter: its tolerance would not be judged.
            item.error("not-positive", "the diameter of a circle is above zero".to_owned(), hint);
            return None;
        }
        Some(diameter_mm)
    });
    let hint = "of the circle in the workpiece frame, such as \"1750 1150 0 mm\"";
    let centre = section.require("centre", hint).and_then(|i| read_vector_mm(&i));
    let tolerances = ["tolerance", "location_diameter_tolerance"].map(|key| {
        let value = section.get(key).and_then(|item| item.quantity_of(Quantity::Deviation));
        if value.is_some_and(|v| v <= 0.0) {
            section.error("not-positive", format!("`{key}` is above zero"), "such as \"0.046 mm\"");
        }
        value
    });
    let (count, circle, centre) = (count?, circle?, centre?);
    if !(1..=MOST_HOLES).contains(&count) {
        let message = format!("{count} holes");
        section.error("bad-count", message, &format!("1 to {MOST_HOLES}"));
        return None;
    }
    if tolerances[1].is_some() && count < 3 {
        let message = format!("{count} holes lie on no circle: no location diameter can be judged");
        section.error(
            "bad-count",
            message,
            "3 holes or more, or leave out location_diameter_tolerance",
        );
        return None;
    }
    let hole = |i: usize| {
        let (sin, cos) = (std::f64::consts::TAU * i as f64 / count as f64).sin_cos();
        centre + 0.5 * circle * Vec3::new(cos, sin, 0.0)
    };
    Some(((0..count).map(hole).collect(), tolerances))
}

/// Minus an error in whole increments, halves away from zero.
///
/// ```
/// use trueaxis_predict::predict::holes::compensation_increments;
/// assert_eq!(compensation_increments(-0.0035, 0.001), 4);
/// assert_eq!(compensation_increments(0.0025, 0.001), -3);
/// ```
pub fn compensation_increments(error_mm: f64, increment_mm: f64) -> i64 {
    // A half that only rounding keeps from being one (0.0035/0.001) counts as one.
    let steps = -error_mm / increment_mm;
    (steps + steps.signum() * 1e-9 * steps.abs().max(1.0)).round() as i64
}

/// Predicts the holes under no, machine-only and comprehensive compensation.
///
/// The compensated command is solved for again, so errors of the compensation itself (other
/// place, other table value, whole increments) are in.
///
/// # Errors
/// A hole that the machine cannot reach, with its number.
///
/// # Source
/// Zhang et al. 2019, section 2 and 3.
pub fn predict_holes(study: &HoleStudy) -> Result<HolePrediction, Diagnostics> {
    let made = study.made()?;
    let running = study.temperatures.as_ref();
    let sets = drill_all(study, &made, running)?;
    let held = running.map(|_| drill_all(study, &made, None)).transpose()?;
    let clock = study.clock(running);
    let begun_s = made.first().map_or(0.0, |hole| hole.row.time_s);
    let time = |i: usize| made.get(i).map_or(clock.time_s(i), |hole| hole.row.time_s - begun_s);
    let times_s = (0..study.holes_mm.len()).map(time).collect();
    let without_u = study.machine.coefficients_without_u();
    Ok(HolePrediction { warnings: warnings(&sets, &made), sets, held, times_s, without_u })
}

/// A hole that a record knows of.
struct Made<'a> {
    row: &'a ActedRow,
    /// At the temperatures of its row; none where the study states some.
    machine: Option<Machine>,
}

impl HoleStudy {
    /// Each hole is made in the middle of its share of the time.
    fn clock(&self, running: Option<&RunningTemperatures>) -> CuttingClock {
        let mut shares: Vec<f64> = (0..self.holes_mm.len()).map(|i| i as f64 + 0.5).collect();
        shares.push(self.holes_mm.len() as f64);
        CuttingClock::along(&self.machine, running, &shares)
    }

    /// The row of each hole; none of them without a record.
    fn made(&self) -> Result<Vec<Made<'_>>, Diagnostics> {
        let Some(record) = &self.acted else { return Ok(Vec::new()) };
        let mut problems = Diagnostics::new();
        let mut made = Vec::with_capacity(self.holes_mm.len());
        for (i, place) in self.holes_mm.iter().enumerate() {
            let found = felt(&self.machine, *place).and_then(|(command, _)| {
                let row = record.at(&self.machine, &command).ok_or_else(|| no_row(record))?;
                Ok(Made { row, machine: machine_then(self, row)? })
            });
            match found {
                Ok(hole) => made.push(hole),
                Err(why) => problems.error(
                    "not-in-record",
                    Place::whole(&record.file),
                    format!("hole {}: {why}", i + 1),
                    "name the record of this part, and place the circle as it was on the machine",
                ),
            }
        }
        if problems.has_errors() { Err(problems) } else { Ok(made) }
    }
}

fn no_row(record: &ActedRecord) -> String {
    let rows = record.rows.len();
    format!("none of the {rows} rows is within {SAME_PLACE_MM} mm of its place")
}

fn drill_all(
    study: &HoleStudy,
    made: &[Made<'_>],
    running: Option<&RunningTemperatures>,
) -> Result<Vec<HoleSet>, Diagnostics> {
    let mut problems = Diagnostics::new();
    let acted = study.acted.as_ref().map(|_| Applied::Acted);
    let all = Compensation::ALL.map(Applied::By).into_iter().chain(acted);
    let sets = all.map(|applied| drill_set(study, (made, running), applied, &mut problems));
    let sets = sets.collect();
    if problems.has_errors() { Err(problems) } else { Ok(sets) }
}

fn drill_set(
    study: &HoleStudy,
    (made, running): (&[Made<'_>], Option<&RunningTemperatures>),
    applied: Applied,
    problems: &mut Diagnostics,
) -> HoleSet {
    let is_first = applied == Applied::By(Compensation::None);
    let mut told = |i: usize, message: String, hint: &str| {
        let message = format!("hole {}{message}", i + 1);
        problems.error("unreachable-hole", Place::whole(&study.name), message, hint);
    };
    let mut clock = study.clock(running);
    let centre = study.holes_mm.iter().sum::<Vec3>() / study.holes_mm.len() as f64;
    let mut holes = Vec::with_capacity(study.holes_mm.len());
    let mut outwards_mm = Vec::with_capacity(study.holes_mm.len());
    for (i, place) in study.holes_mm.iter().enumerate() {
        let of_time = match clock.machine_at(i) {
            Ok(machine) => machine.unwrap_or(&study.machine),
            Err(ends) if is_first => {
                told(i, format!(": {}", log_end(&ends)), "take a longer log, or start earlier");
                break;
            }
            Err(_) => break,
        };
        let hole = made.get(i);
        let machine = hole.and_then(|hole| hole.machine.as_ref()).unwrap_or(of_time);
        let drilled = match (applied, hole) {
            (Applied::By(compensation), _) => {
                drill(machine, study.increment_mm, *place, compensation)
            }
            (Applied::Acted, Some(hole)) => {
                drilled_with(machine, study.increment_mm, *place, hole.row)
            }
            (Applied::Acted, None) => break,
        };
        match drilled {
            Ok((hole, effects)) => {
                let out = (place - centre).xy().try_normalize(1e-12).unwrap_or_default();
                outwards_mm.push(effects.iter().map(|effect| out.dot(&effect.xy())).collect());
                holes.push(hole);
            }
            Err(message) if is_first => {
                told(i, format!(": {message}"), "move the circle, or extend the table");
            }
            // The same hole was reported already, or lies at the very end of a table.
            Err(message) => told(i, format!(", compensated: {message}"), ""),
        }
    }
    let worst = holes.iter().max_by(|a, b| a.distance_mm().total_cmp(&b.distance_mm()));
    let worst_mm = worst.map_or(0.0, Hole::distance_mm);
    let u_worst_mm = worst.map_or(0.0, |h| h.u_distance_mm);
    let in_tolerance = study.tolerance_mm.map(|t| worst_mm <= t);
    let location = LocationCircle::of(&study.holes_mm, &holes, &outwards_mm);
    let allowed = study.location_tolerance_mm.zip(location);
    let location_in_tolerance = allowed.map(|(t, circle)| circle.largest_mm().0.abs() <= t);
    HoleSet {
        compensation: applied,
        holes,
        worst_mm,
        u_worst_mm,
        in_tolerance,
        location_in_tolerance,
        location,
    }
}

fn log_end(ends: &Error) -> String {
    match ends {
        Error::LogEnds { time_s, lasts_s, .. } => {
            format!("it is made after {time_s:.1} s, the log ends after {lasts_s:.1} s")
        }
        other => other.to_string(),
    }
}

fn warnings(sets: &[HoleSet], made: &[Made<'_>]) -> Vec<(&'static str, String)> {
    let mut warnings = Vec::new();
    if let [before, machine, comprehensive, ..] = sets
        && machine.worst_mm > before.worst_mm
    {
        let message = format!(
            "COMPENSATING THE MACHINE ALONE MAKES THE PART WORSE: {:.3} mm instead of {:.3} mm; \
             the workpiece grows more than the scales; the comprehensive compensation leaves {:.3} mm",
            machine.worst_mm, before.worst_mm, comprehensive.worst_mm
        );
        warnings.push(("machine-only-compensation", message));
    }
    let held = made.iter().enumerate().filter(|(_, hole)| !hole.row.followed);
    let held: Vec<String> = held.map(|(i, _)| (i + 1).to_string()).collect();
    if !held.is_empty() {
        let message = format!(
            "the correction did not follow its target from the beginning to the end of the block (it was off, held, or \
             on its way back): hole {}",
            held.join(", ")
        );
        warnings.push(("did-not-follow", message));
    }
    warnings
}

fn drill(
    machine: &Machine,
    increment_mm: f64,
    place: Vec3,
    compensation: Compensation,
) -> Result<(Hole, Vec<Vec3>), String> {
    let (tip, errors) = felt(machine, place)?;
    let error = match compensation {
        Compensation::None => Vec3::zeros(),
        Compensation::Machine => {
            machine.deviation(&tip, &ErrorValues { workpiece_mm: Vec3::zeros(), ..errors }).tip_mm
        }
        Compensation::Comprehensive => machine.deviation(&tip, &errors).tip_mm,
    };
    let increments = [0, 1, 2].map(|i| compensation_increments(error[i], increment_mm));
    let added = Vec3::from(increments.map(|n| n as f64 * increment_mm));
    let (command, errors) = felt(machine, place + added)?;
    let error_mm = added + machine.deviation(&command, &errors).tip_mm;
    let effects = effects(machine, &command, &errors);
    let (u_mm, u_distance_mm) = uncertainty(&effects, error_mm);
    Ok((Hole { increments, error_mm, u_mm, u_distance_mm }, effects))
}

/// The same with the offsets that acted.
fn drilled_with(
    machine: &Machine,
    increment_mm: f64,
    place: Vec3,
    row: &ActedRow,
) -> Result<(Hole, Vec<Vec3>), String> {
    let (command, _) = felt(machine, place)?;
    let (added, there) = moved(machine, &command, row);
    let errors = machine.errors_at(&there, &Approach::default()).map_err(|e| e.to_string())?;
    let error_mm = added + machine.deviation(&there, &errors).tip_mm;
    let effects = effects(machine, &there, &errors);
    let (u_mm, u_distance_mm) = uncertainty(&effects, error_mm);
    let increments = [0, 1, 2].map(|i| compensation_increments(-added[i], increment_mm));
    Ok((Hole { increments, error_mm, u_mm, u_distance_mm }, effects))
}

/// What each uncertain quantity of the machine does to the place of the tip, mm.
///
/// ```text
///     (x(z = +1) − x(z = −1))/2
/// ```
fn effects(machine: &Machine, command: &Command, errors: &ErrorValues) -> Vec<Vec3> {
    let quantities = machine.uncertain_quantities();
    let known = machine.uncertainties_at(command, &quantities);
    let effect = |quantity: usize| {
        let tip =
            |z: f64| machine.deviation(command, &known.displaced_by(errors, quantity, z)).tip_mm;
        0.5 * (tip(1.0) - tip(-1.0))
    };
    (0..quantities.len()).map(effect).collect()
}

/// How well the place of a hole is known, along x, y, z and as a distance from where it should be.
///
/// ```text
///     u²(x) = Σ ((x(z = +1) − x(z = −1))/2)²                               docs/model.md eq. 31
/// ```
///
/// over all uncertain quantities of the machine; the compensation stays what it is.
fn uncertainty(effects: &[Vec3], error_mm: Vec3) -> (Vec3, f64) {
    let along = error_mm.xy().try_normalize(1e-12);
    let (mut variance, mut of_distance) = (Vec3::zeros(), 0.0);
    for half in effects {
        variance += half.component_mul(half);
        // A hole in its very place moves away in every direction.
        of_distance += along.map_or(half.xy().norm(), |a| a.dot(&half.xy())).powi(2);
    }
    (variance.map(f64::sqrt), of_distance.sqrt())
}

/// The command that brings the upright tool to a place, and the errors there.
fn felt(machine: &Machine, place: Vec3) -> Result<(Command, ErrorValues), String> {
    let target = Target { tip: Point::from_vector(place), axis: Direction::Z };
    let solved = machine.solve(&target, &Command::default()).map_err(|e| e.to_string())?;
    let best = solved.solutions.first().ok_or("no solution")?;
    if !best.within_travel {
        return Err("it lies outside the travel".to_owned());
    }
    let errors = machine.errors_at(&best.command, &Approach::default());
    Ok((best.command, errors.map_err(|e| e.to_string())?))
}
