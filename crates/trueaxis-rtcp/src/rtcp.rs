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

pub mod angles;
mod calibration;
pub mod centres;
pub mod control;
mod file;
pub mod forecast;
pub mod program;
mod rows;
pub mod screen;
pub mod segments;
mod study;
mod table;

pub use angles::{AngleError, Angles};
pub use calibration::{Calibration, NewSlot, Offset, Unseen, WorstReading};
pub use centres::{Centres, NoCentres, Topology};
pub use control::{MachineZero, Names, Slot, Slots};
pub use file::{Purpose, parse_rtcp, read_rtcp};
pub use segments::Segments;
pub use study::{ReadingSet, Row, RtcpStudy};

use nalgebra::{DMatrix, DVector};
use rows::{Flip, Rows, rows};
use study::{SAME_RAD, spread};
use trueaxis_calibrate::identify::errors::birge;
use trueaxis_calibrate::identify::influence::influences;
use trueaxis_calibrate::identify::machine_file::with_locations;
use trueaxis_geometry::Vec3;
use trueaxis_geometry::statistics::chi_square_above;
use trueaxis_input::Place;
use trueaxis_machine::axis::AxisKind;
use trueaxis_machine::errors::{ErrorName, ErrorValues};
use trueaxis_machine::file::Tables;
use trueaxis_measure::measure::Readings;
use trueaxis_measure::unknowns::confusion::confusions;
use trueaxis_measure::unknowns::design::Design;
use trueaxis_measure::unknowns::fit::{Fit, FitError, fit};
use trueaxis_measure::unknowns::term::Term;

/// A flipped sign is suspected where χ² falls at least to this share.
const SUSPICIOUS: f64 = 0.1;

/// Where a number stands that [`calibrate`] counts from 0.
pub fn place_of(study: &RtcpStudy, number: usize) -> Place {
    let whole = || Place::whole(&study.path.display().to_string());
    rows(study, None).origins.get(number).map_or_else(whole, |(set, row, _)| {
        let set = &study.sets[*set];
        Place { file: set.file.clone(), line: set.rows[*row].line as usize, column: 1 }
    })
}

/// The design of the study with its centres, and with its angles if they are wanted.
fn design(study: &RtcpStudy, with_angles: bool) -> Design {
    let instruments = study.sets.iter().map(|s| s.instrument.clone()).collect();
    let angles = study.angles.terms.iter().filter(|_| with_angles);
    let terms: Vec<Term> = study.centres.terms.iter().chain(angles).copied().collect();
    Design::new(&study.machine, terms, instruments)
}

/// The centres from the readings, and the directions of the axes if they are wanted.
///
/// # Errors
/// No readings, a row outside an error table of the machine.
pub fn calibrate(study: &RtcpStudy) -> Result<Calibration, FitError> {
    let design = design(study, study.angles.wanted);
    let rows = rows(study, None);
    let fit = fit(&design, &rows.readings, &[])?;
    let (n, all) = (study.centres.terms.len(), design.terms.len());
    let birge = birge(&fit);
    let tool = tool_part(study, &design, &rows.readings, &fit);
    let whole =
        fit.covariance.view((0, 0), (all, all)) * (birge * birge) + &tool * tool.transpose();
    let covariance = whole.view((0, 0), (n, n)).into_owned();
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
    let of_angles = whole.view((n, n), (all - n, all - n)).into_owned();
    let angles = angles::found(
        study,
        angles::outlook(study),
        &fit.values[n..all],
        &of_angles,
        &fit.sight.is_seen[n..all],
    );
    let square: f64 = fit.residuals.iter().map(|r| r[0] * r[0]).sum();
    let suspicions = if birge > 1.0 { suspicions(study, &design, &fit) } else { Vec::new() };
    Ok(Calibration {
        offsets,
        angles,
        angles_wanted: study.angles.wanted,
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

/// How the unknowns of the machine move with a tool that is not where it is said to be: one column for each of its
/// three directions, times its standard uncertainty. Sets with the same tip are taken with one tool.
///
/// ```text
///     ∂x/∂s = −(JᵀWJ)⁺ JᵀW n·R                                             docs/model.md eq. 133
/// ```
fn tool_part(study: &RtcpStudy, design: &Design, readings: &Readings, fit: &Fit) -> DMatrix<f64> {
    let mut tips: Vec<Vec3> = Vec::new();
    for set in &study.sets {
        if !tips.contains(&set.instrument.tool_point_mm) {
            tips.push(set.instrument.tool_point_mm);
        }
    }
    let [radial, length] = study.tool_u_mm;
    let u = [radial, radial, length];
    let columns = design.columns(readings, 0..readings.len());
    let mut gradient = DMatrix::zeros(design.unknowns(), 3 * tips.len());
    for i in 0..readings.len() {
        let instrument = &design.instruments[readings.instruments[i] as usize];
        let tool = tips.iter().position(|t| *t == instrument.tool_point_mm).unwrap_or(0);
        let pose = study.machine.pose(&readings.commands[i], &ErrorValues::default());
        for (c, u) in u.into_iter().enumerate() {
            let along = readings.directions[i].dot(&pose.linear().column(c));
            let column = columns.column(i) * (along * u / instrument.noise[0]);
            let mut target = gradient.column_mut(3 * tool + c);
            target += column;
        }
    }
    let moved = &fit.covariance * gradient;
    -moved.rows(0, design.terms.len()).into_owned()
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
        format!("χ² would be {share:.1e} of what it is if {what}")
    };
    inclined(study, found).into_iter().chain(tried.into_iter().take(3).map(words)).collect()
}

/// Whether axes that are inclined would explain what does not fit.
fn inclined(study: &RtcpStudy, found: &Fit) -> Option<String> {
    let again = fit(&design(study, true), &rows(study, None).readings, &[]).ok()?;
    let limit = chi_square_above(0.01, again.degrees_of_freedom.max(1) as f64);
    let explains = !study.angles.wanted && again.chi_square < limit;
    let share = again.chi_square / found.chi_square;
    explains.then(|| {
        format!(
            "χ² would be {share:.1e} of what it is if the rotary axes are inclined as well: \
             set angles = \"found\""
        )
    })
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
        .chain(
            study
                .angles
                .terms
                .iter()
                .zip(&found.angles)
                .filter_map(|(term, angle)| angle.found_rad.map(|(v, u)| (term.error, v, u))),
        )
        .collect();
    let date = study.date.as_ref().map(|d| format!(", {d}")).unwrap_or_default();
    let origin = format!("RTCP calibration ({}{date})", study.name);
    with_locations(old, &errors, &origin, beside)
}
