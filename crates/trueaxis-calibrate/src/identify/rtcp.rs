//! RTCP set-up: the rotary centres of a five-axis machine from readings at turned poses.
//!
//! ```text
//!     RtcpStudy ──rows──> readings ──fit──> offsets, true − nominal ──Slots──> numbers of the control
//! ```
//!
//! Zhang et al. 2023 measure one centre after the other, each with the machine standing and with RTCP on.
//! Both are one reading: the tool against a ball (a mandrel, a ring) on the other side of the machine,
//!
//! ```text
//!     r = n · (P(q; x) − Q)                                                docs/model.md eq. 132
//! ```
//!
//! P the tip with the offsets x, Q the ball, which need not be known. With RTCP off the axes q stand
//! where they were commanded; with RTCP on the control has put them where, by the centres that stand in it,
//! P would be on Q. So all steps are solved at once, and the answer does not depend on their order.

pub mod centres;
pub mod control;
mod file;
pub mod forecast;
pub mod program;

pub use centres::{Centres, NoCentres, Topology};
pub use control::{MachineZero, Names, Slot, Slots};
pub use file::{Purpose, parse_rtcp, read_rtcp};

use super::errors::birge;
use super::influence::influences;
use super::machine_file::with_locations;
use nalgebra::{DMatrix, DVector};
use schemars::JsonSchema;
use serde::Serialize;
use std::path::PathBuf;
use trueaxis_geometry::Vec3;
use trueaxis_input::Place;
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{AxisKind, Command};
use trueaxis_machine::errors::{ErrorName, ErrorValues};
use trueaxis_machine::file::Tables;
use trueaxis_measure::measure::path::Placing;
use trueaxis_measure::measure::{Instrument, Reading, Readings};
use trueaxis_measure::unknowns::confusion::confusions;
use trueaxis_measure::unknowns::design::Design;
use trueaxis_measure::unknowns::fit::{Fit, FitError, fit};

/// Angles that differ by less are the same pose, rad.
const SAME_RAD: f64 = 1e-6;
/// A flipped sign is suspected where χ² falls at least to this share.
const SUSPICIOUS: f64 = 0.1;

/// One row of a table: the commanded positions of the axes, and the readings.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    /// Axis positions, mm and rad; with RTCP on only the rotary ones count.
    pub command: Command,
    /// What was read along x, y, z, mm; not every indicator reads all.
    pub read_mm: [Option<f64>; 3],
    /// The line of the table.
    pub line: u32,
}

/// Readings of one set-up: one ball, one indicator, one table.
#[derive(Debug, Clone, PartialEq)]
pub struct ReadingSet {
    /// Its name.
    pub name: String,
    /// Whether RTCP (TCP, TRAORI, M128) was on.
    pub tcp: bool,
    /// The indicator turns with the spindle head; else with the table.
    pub in_spindle: bool,
    /// Readings are of the ball against the tool, not of the tool against the ball.
    pub reads_ball: bool,
    /// Ball, noise, and the place of the ball as unknown.
    pub instrument: Instrument,
    /// The offsets for which the control was set while this was read, mm.
    pub set_for_mm: Vec<f64>,
    /// The rows.
    pub rows: Vec<Row>,
    /// The table.
    pub file: String,
}

/// What shall be calibrated, from which readings.
#[derive(Debug, Clone, PartialEq)]
pub struct RtcpStudy {
    /// What this is.
    pub name: String,
    /// The file.
    pub path: PathBuf,
    /// The machine file.
    pub machine_path: PathBuf,
    /// The machine; what it states of the centres is what stands in the control.
    pub machine: Machine,
    /// The unknowns.
    pub centres: Centres,
    /// The names of the control, if one is named.
    pub slots: Option<Slots>,
    /// What stands in the control, by the place in [`Slots::slots`], mm.
    pub now: Vec<(usize, f64)>,
    /// The same as offsets from the machine file, mm.
    pub set_for_mm: Vec<f64>,
    /// Decimals that the control takes.
    pub decimals: u8,
    /// How well the tool is centred in the spindle, and how well its length is known, mm (k = 1).
    pub tool_u_mm: [f64; 2],
    /// The readings.
    pub sets: Vec<ReadingSet>,
    /// When it was measured.
    pub date: Option<String>,
}

/// A combination of offsets that changes no reading.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct Unseen {
    /// As a sum.
    pub combination: String,
    /// What that means.
    pub words: String,
}

/// One offset.
#[derive(Debug, Clone, PartialEq)]
pub struct Offset {
    /// Its ISO 230-1 name.
    pub name: String,
    /// In the words of the shop.
    pub words: String,
    /// True − machine file and its standard uncertainty, mm; `None` where not observable.
    pub found_mm: Option<(f64, f64)>,
}

/// A number of the control, old and new.
#[derive(Debug, Clone, PartialEq)]
pub struct NewSlot {
    /// Which.
    pub slot: Slot,
    /// What stands there, mm.
    pub old_mm: f64,
    /// What shall stand there and its standard uncertainty, mm; `None` where not observable.
    pub new_mm: Option<(f64, f64)>,
}

/// The reading that fits worst.
#[derive(Debug, Clone, PartialEq)]
pub struct WorstReading {
    /// Where it stands.
    pub place: Place,
    /// Along which direction: x, y or z.
    pub channel: char,
    /// Reading − model, mm.
    pub residual_mm: f64,
    /// The same in its standard uncertainty. Unit: 1.
    pub standardised: f64,
    /// Beyond what one of so many readings may be off (Bonferroni, 5 %).
    pub is_outlier: bool,
}

/// What came out.
#[derive(Debug, Clone)]
pub struct Calibration {
    /// The offsets in chain order.
    pub offsets: Vec<Offset>,
    /// The offsets found, mm; of unobservable combinations the shortest.
    pub values_mm: Vec<f64>,
    /// Their covariance, mm²: noise (as large as the residuals say) and tool.
    pub covariance: DMatrix<f64>,
    /// Offsets that change no reading, one combination with balls each, of length 1 as a whole.
    pub null_space: DMatrix<f64>,
    /// The numbers of the control.
    pub new: Vec<NewSlot>,
    /// Unobservable combinations.
    pub unseen: Vec<Unseen>,
    /// χ² of the readings. Unit: 1.
    pub chi_square: f64,
    /// Numbers read less unknowns found.
    pub degrees_of_freedom: usize,
    /// How many numbers were read.
    pub numbers: usize,
    /// √(χ²/ν) where χ² is beyond its 99 % quantile, else 1. Unit: 1.
    pub birge: f64,
    /// The spread of reading − model, mm.
    pub rms_residual_mm: f64,
    /// The reading that fits worst.
    pub worst: Option<WorstReading>,
    /// Slips that would explain what does not fit, in words.
    pub suspicions: Vec<String>,
    /// Passes of the fit; one finds the answer, one more sees that it stands.
    pub passes: usize,
}

impl Calibration {
    /// Whether the readings fit the machine, and determine an offset.
    pub fn is_good(&self) -> bool {
        self.birge == 1.0 && self.offsets.iter().any(|o| o.found_mm.is_some())
    }

    /// Whether every offset was found.
    pub fn is_complete(&self) -> bool {
        self.offsets.iter().all(|o| o.found_mm.is_some())
    }

    /// In one sentence.
    pub fn verdict(&self) -> String {
        let (all, found) =
            (self.offsets.len(), self.offsets.iter().filter(|o| o.found_mm.is_some()).count());
        if found == 0 {
            return "no: the readings determine none of the centres".to_owned();
        }
        if self.birge > 1.0 {
            return format!(
                "no: the readings differ from the model by {:.1} times their noise",
                self.birge
            );
        }
        match found == all {
            true => format!("yes: all {all} offsets found, the readings fit"),
            false => format!("in part: {found} of {all} offsets found, the readings fit"),
        }
    }
}

/// A sense that may have been mixed up.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Flip {
    Set(usize),
    Channel(usize, usize),
    Sense(usize),
}

/// Rows as numbers, with the place that each comes from.
struct Rows {
    readings: Readings,
    /// Set, row, channel.
    origins: Vec<(usize, usize, usize)>,
}

/// Where the axes stand at a row.
pub(crate) fn command_of(study: &RtcpStudy, set: &ReadingSet, row: &Command) -> Option<Command> {
    if !set.tcp {
        return Some(*row);
    }
    let placing = Placing::of(&study.machine, &set.instrument).ok()?;
    let by_the_control = study.centres.moved_mm(&study.machine, row, &set.set_for_mm);
    placing.place(set.instrument.reference_point_mm - by_the_control, row)
}

/// Along which direction of the workpiece a channel reads at a command.
fn direction(study: &RtcpStudy, set: &ReadingSet, command: &Command, channel: usize) -> Vec3 {
    match set.in_spindle {
        true => {
            let pose = study.machine.pose(command, &ErrorValues::default());
            pose.linear().column(channel).into_owned()
        }
        false => Vec3::ith(channel, 1.0),
    }
}

fn rows(study: &RtcpStudy, flip: Option<Flip>) -> Rows {
    let mut made = Rows { readings: Readings::default(), origins: Vec::new() };
    for (s, set) in study.sets.iter().enumerate() {
        for (r, row) in set.rows.iter().enumerate() {
            let mut wanted = row.command;
            if let Some(Flip::Sense(axis)) = flip {
                wanted[axis] = -wanted[axis];
            }
            // The file was read with the same placing: a row that cannot be placed was reported there.
            let Some(command) = command_of(study, set, &wanted) else { continue };
            for (c, read) in row.read_mm.iter().enumerate() {
                let Some(mut value) = *read else { continue };
                let turned = set.reads_ball
                    != (flip == Some(Flip::Set(s)) || flip == Some(Flip::Channel(s, c)));
                if turned {
                    value = -value;
                }
                made.readings.push(Reading {
                    command,
                    approach: [0.0; 6],
                    instrument: u32::try_from(s).unwrap_or(u32::MAX),
                    direction: direction(study, set, &command, c),
                    value: [value, 0.0, 0.0],
                    group: u32::try_from(r).unwrap_or(u32::MAX),
                    time_s: 0.0,
                    motion: trueaxis_measure::measure::Motion::default(),
                    line: row.line,
                });
                made.origins.push((s, r, c));
            }
        }
    }
    made
}

/// Where a number stands that [`calibrate`] counts from 0.
pub fn place_of(study: &RtcpStudy, number: usize) -> Place {
    let whole = || Place::whole(&study.path.display().to_string());
    rows(study, None).origins.get(number).map_or_else(whole, |(set, row, _)| {
        let set = &study.sets[*set];
        Place { file: set.file.clone(), line: set.rows[*row].line as usize, column: 1 }
    })
}

/// The centres from the readings.
///
/// # Errors
/// No readings, a row outside an error table of the machine.
pub fn calibrate(study: &RtcpStudy) -> Result<Calibration, FitError> {
    let instruments = study.sets.iter().map(|s| s.instrument.clone()).collect();
    let design = Design::new(&study.machine, study.centres.terms.clone(), instruments);
    let rows = rows(study, None);
    let fit = fit(&design, &rows.readings, &[])?;
    let n = study.centres.terms.len();
    let birge = birge(&fit);
    let tool = tool_part(study, &design, &rows.readings, &fit);
    let covariance =
        fit.covariance.view((0, 0), (n, n)) * (birge * birge) + &tool * tool.transpose();
    let mut null_space = fit.sight.null_space.rows(0, n).into_owned();
    for (mut part, whole) in null_space.column_iter_mut().zip(fit.sight.null_space.column_iter()) {
        part /= whole.norm();
    }
    let values_mm = fit.values[..n].to_vec();
    let offsets = (0..n)
        .map(|k| Offset {
            name: design.terms[k].error.to_string(),
            words: study.centres.words(&study.machine, k),
            found_mm: fit.sight.is_seen[k].then(|| (values_mm[k], covariance[(k, k)].sqrt())),
        })
        .collect();
    let square: f64 = fit.residuals.iter().map(|r| r[0] * r[0]).sum();
    let suspicions = if birge > 1.0 { suspicions(study, &design, &fit) } else { Vec::new() };
    Ok(Calibration {
        offsets,
        new: new_slots(study, &values_mm, &covariance, &null_space),
        unseen: unseen(study, &design, &fit),
        chi_square: fit.chi_square,
        degrees_of_freedom: fit.degrees_of_freedom,
        numbers: rows.readings.len(),
        birge,
        rms_residual_mm: (square / rows.readings.len() as f64).sqrt(),
        worst: worst(study, &design, &rows, &fit),
        suspicions,
        passes: fit.passes,
        values_mm,
        covariance,
        null_space,
    })
}

/// How the offsets move with a tool that is not where it is said to be: one column for each of its
/// three directions, times its standard uncertainty. All sets are taken with one tool.
///
/// ```text
///     ∂x/∂s = −(JᵀWJ)⁺ JᵀW n·R                                             docs/model.md eq. 133
/// ```
fn tool_part(study: &RtcpStudy, design: &Design, readings: &Readings, fit: &Fit) -> DMatrix<f64> {
    let n = study.centres.terms.len();
    let [radial, length] = study.tool_u_mm;
    let u = [radial, radial, length];
    let columns = design.columns(readings, 0..readings.len());
    let mut gradient = DMatrix::zeros(design.unknowns(), 3);
    for i in 0..readings.len() {
        let noise = design.instruments[readings.instruments[i] as usize].noise[0];
        let pose = study.machine.pose(&readings.commands[i], &ErrorValues::default());
        for (c, u) in u.into_iter().enumerate() {
            let along = readings.directions[i].dot(&pose.linear().column(c));
            let column = columns.column(i) * (along * u / noise);
            let mut target = gradient.column_mut(c);
            target += column;
        }
    }
    let moved = &fit.covariance * gradient;
    -moved.rows(0, n).into_owned()
}

fn new_slots(
    study: &RtcpStudy,
    values_mm: &[f64],
    covariance: &DMatrix<f64>,
    null_space: &DMatrix<f64>,
) -> Vec<NewSlot> {
    let Some(slots) = &study.slots else { return Vec::new() };
    let one = |(k, slot): (usize, &Slot)| {
        let slopes = DVector::from_column_slice(&slot.slopes);
        let at = |offsets: &[f64]| slopes.dot(&DVector::from_column_slice(offsets));
        let stated = study.now.iter().find(|(s, _)| *s == k).map(|(_, mm)| *mm);
        let old_mm = stated.unwrap_or(slot.nominal_mm + at(&study.set_for_mm));
        let is_unobservable = null_space.tr_mul(&slopes).amax() > 1e-6;
        let u = slopes.dot(&(covariance * &slopes)).max(0.0).sqrt();
        let new = old_mm + at(values_mm) - at(&study.set_for_mm);
        NewSlot { slot: slot.clone(), old_mm, new_mm: (!is_unobservable).then_some((new, u)) }
    };
    slots.slots.iter().enumerate().map(one).collect()
}

/// Unobservable combinations, and which axis was not turned.
fn unseen(study: &RtcpStudy, design: &Design, fit: &Fit) -> Vec<Unseen> {
    let n = design.terms.len();
    let still: Vec<String> = study
        .machine
        .axes()
        .iter()
        .enumerate()
        .filter(|(_, axis)| axis.kind == AxisKind::Rotary)
        .filter_map(|(i, axis)| {
            let of = |set: &ReadingSet| spread(set.rows.iter().map(|r| r.command[i]));
            study.sets.iter().all(|s| of(s) < SAME_RAD).then(|| axis.name.to_string())
        })
        .collect();
    let because = match still.is_empty() {
        true => String::new(),
        false => format!("; {} is not turned within any set of readings", still.join(" and ")),
    };
    confusions(&fit.sight)
        .into_iter()
        .filter(|c| c.members.iter().any(|(k, _)| *k < n))
        .map(|c| Unseen { combination: c.formula(design), words: c.words(design) + &because })
        .collect()
}

fn spread(values: impl Iterator<Item = f64>) -> f64 {
    let (low, high) =
        values.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(v), h.max(v)));
    (high - low).max(0.0)
}

fn worst(study: &RtcpStudy, design: &Design, rows: &Rows, fit: &Fit) -> Option<WorstReading> {
    let found = influences(design, &rows.readings, &[], fit);
    let size = |i: &usize| found.rows[*i].standardised[0].abs();
    let i = (0..found.rows.len()).max_by(|a, b| size(a).total_cmp(&size(b)))?;
    let (set, row, channel) = rows.origins[i];
    let set = &study.sets[set];
    let line = set.rows[row].line as usize;
    Some(WorstReading {
        place: Place { file: set.file.clone(), line, column: 1 },
        channel: ['x', 'y', 'z'][channel],
        residual_mm: fit.residuals[i][0],
        standardised: found.rows[i].standardised[0],
        is_outlier: found.outliers.iter().any(|o| o.row == i),
    })
}

/// Which single slip would explain what does not fit.
fn suspicions(study: &RtcpStudy, design: &Design, found: &Fit) -> Vec<String> {
    let mut slips = Vec::new();
    if study.sets.len() > 1 {
        slips.extend((0..study.sets.len()).map(Flip::Set));
    }
    for (s, set) in study.sets.iter().enumerate() {
        let read = |c: &usize| set.rows.iter().any(|r| r.read_mm[*c].is_some_and(|v| v != 0.0));
        slips.extend((0..3).filter(read).map(|c| Flip::Channel(s, c)));
    }
    let axes = study.machine.axes().iter().enumerate();
    slips.extend(axes.filter(|(_, a)| a.kind == AxisKind::Rotary).map(|(i, _)| Flip::Sense(i)));
    let mut tried: Vec<(f64, Flip)> = slips
        .into_iter()
        .filter_map(|flip| {
            let rows = rows(study, Some(flip));
            let again = fit(design, &rows.readings, &[]).ok()?;
            Some((again.chi_square / found.chi_square, flip))
        })
        .filter(|(share, _)| *share < SUSPICIOUS)
        .collect();
    tried.sort_by(|a, b| a.0.total_cmp(&b.0));
    let words = |(share, flip): (f64, Flip)| {
        let what = match flip {
            Flip::Set(s) => {
                format!("all readings of `{}` had the other sign", study.sets[s].name)
            }
            Flip::Channel(s, c) => {
                format!("{} of `{}` had the other sign", ['x', 'y', 'z'][c], study.sets[s].name)
            }
            Flip::Sense(axis) => {
                format!("{} turned the other way", study.machine.axes()[axis].name)
            }
        };
        format!("χ² would be {:.1e} of what it is if {what}", share)
    };
    tried.into_iter().take(3).map(words).collect()
}

/// The machine file with the offsets that were found as location errors: what the machine truly is
/// while its placements say what the control has.
///
/// # Errors
/// In words, why the file cannot be edited.
pub fn machine_file(
    study: &RtcpStudy,
    found: &Calibration,
    old: &str,
    beside: &dyn Tables,
) -> Result<String, String> {
    let errors: Vec<(ErrorName, f64, f64)> = study
        .centres
        .terms
        .iter()
        .zip(&found.offsets)
        .filter_map(|(term, offset)| offset.found_mm.map(|(v, u)| (term.error, v, u)))
        .collect();
    let date = study.date.as_ref().map(|d| format!(", {d}")).unwrap_or_default();
    let origin = format!("RTCP calibration ({}{date})", study.name);
    with_locations(old, &errors, &origin, beside)
}
