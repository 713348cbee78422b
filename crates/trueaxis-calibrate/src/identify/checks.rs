//! What is wrong with readings before anything is fitted to them.

use super::another_machine::check_poses;
use super::records::Records;
use std::collections::BTreeMap;
use trueaxis_geometry::Vec3;
use trueaxis_geometry::statistics::robust_deviation;
use trueaxis_input::{Diagnostics, Place};
use trueaxis_machine::axis::AxisKind;
use trueaxis_machine::errors::{Component, ErrorIndex, ErrorKind, ErrorValues};
use trueaxis_measure::instruments::Kind;
use trueaxis_measure::instruments::instrument::Sight;
use trueaxis_measure::measure::Readings;
use trueaxis_measure::unknowns::design::Design;
use trueaxis_measure::unknowns::fit::{FitError, Observability};
use trueaxis_measure::unknowns::term::Basis;

/// An axis of rotation that passes so near to the ball says nothing by turning, mm.
const ON_AXIS_MM: f64 = 0.5;
/// Readings further from the nominal one than this, and than twenty times what is usual, are reported.
const FAR_MM: f64 = 0.5;
/// A probe-ball reads no more than a few tenths of a millimetre, mm.
const PROBE_RANGE_MM: f64 = 2.0;
/// Powers of three and more are reported where less than this share of their range was measured.
const LEAST_RANGE: f64 = 0.4;
/// Rows that are reported one by one.
const MOST_REPORTED: usize = 10;

/// Reading minus nominal reading of the machine without the unknown errors, mm or rad.
pub fn deviations(design: &Design, readings: &Readings) -> Vec<[f64; 3]> {
    let nominal = |i: usize| {
        let instrument = &design.instruments[readings.instruments[i] as usize];
        let (command, direction) = (&readings.commands[i], readings.directions[i]);
        instrument.nominal_reading(&design.machine, command, direction)
    };
    (0..readings.len())
        .map(|i| {
            let nominal = nominal(i);
            std::array::from_fn(|c| readings.values[i][c] - nominal[c])
        })
        .collect()
}

/// Looks at the readings; errors where no answer could be trusted.
pub fn check_records(
    design: &Design,
    records: &Records,
    places: usize,
    campaign: &Place,
    problems: &mut Diagnostics,
) {
    let readings = &records.readings;
    let channels = |i: usize| design.instruments[readings.instruments[i] as usize].sight.channels();
    let numbers: usize = (0..readings.len()).map(channels).sum();
    let read: Vec<bool> = (0..design.instruments.len())
        .map(|k| readings.instruments.iter().any(|i| *i as usize == k))
        .collect();
    let unknowns = design.terms.len()
        + (0..read.len())
            .filter(|k| read[*k])
            .map(|k| design.instruments[k].unknowns.len())
            .sum::<usize>();
    let known = design.known().map_or(0, |known| Observability::of(&known.normal).rank);
    if numbers + known <= unknowns {
        let message = format!(
            "{numbers} numbers in {} readings cannot carry {unknowns} unknowns",
            readings.len()
        );
        let hint = "measure at more poses, or seek less: fewer motions, location = \"minimal\"";
        problems.error("too-few-readings", campaign.clone(), message, hint);
    }
    if places < 3 {
        let message = match places {
            1 => "all readings were taken in one place".to_owned(),
            _ => format!("the readings were taken in {places} places"),
        };
        let hint = "errors show where the machine moves: measure at many poses of all axes";
        problems.error("one-place", campaign.clone(), message, hint);
    }
    check_poses(design, records, problems);
    check_size(design, records, problems);
    check_lost_rows(records, problems);
    check_balls_on_axes(design, readings, campaign, problems);
    check_ranges(design, readings, campaign, problems);
}

/// Powers over a travel of which little was measured stand in for each other.
fn check_ranges(
    design: &Design,
    readings: &Readings,
    campaign: &Place,
    problems: &mut Diagnostics,
) {
    let mut reported = Vec::new();
    for term in &design.terms {
        let (Basis::Legendre { degree, half, .. }, Some(axis)) = (term.basis, term.axis) else {
            continue;
        };
        let positions = readings.commands.iter().map(|c| c[axis]);
        let (low, high) = positions.fold((f64::MAX, f64::MIN), |(l, h), q| (l.min(q), h.max(q)));
        // A parabola over a quarter of its range bends by a sixteenth of its size.
        if degree < 3 || high - low >= LEAST_RANGE * 2.0 * half || reported.contains(&term.error) {
            continue;
        }
        reported.push(term.error);
        let machine_axis = &design.machine.axes()[axis];
        let (unit, by) = match machine_axis.kind {
            AxisKind::Linear => ("mm", 1.0),
            AxisKind::Rotary => ("deg", 1f64.to_degrees()),
        };
        let message = format!(
            "{}: powers up to {degree} over {:.0} {unit}, but {} was moved over {:.0} {unit} only: \
             they look alike there, and values can become large and cancel",
            term.error,
            2.0 * half * by,
            machine_axis.name,
            (high - low) * by
        );
        let hint = "measure over more of the travel, or seek \"polynomial 2\"";
        problems.warn("short-range", campaign.clone(), message, hint);
    }
}

/// Readings that no machine could give: hits on the wrong side, wrong rows, wrong units.
fn check_size(design: &Design, records: &Records, problems: &mut Diagnostics) {
    let readings = &records.readings;
    let deviations = deviations(design, readings);
    for (k, instrument) in design.instruments.iter().enumerate() {
        let rows: Vec<usize> =
            (0..readings.len()).filter(|i| readings.instruments[*i] as usize == k).collect();
        let channels = instrument.sight.channels();
        let usual: Vec<f64> = (0..channels)
            .map(|c| robust_deviation(rows.iter().map(|i| deviations[*i][c])))
            .collect();
        let least = usual.iter().copied().fold(f64::INFINITY, f64::min);
        let most = usual.iter().copied().fold(0.0, f64::max);
        if least > 0.0 && most / least > 300.0 {
            let message = format!(
                "{}: one channel reads {:.0} times as much as another",
                instrument.name,
                most / least
            );
            let hint = "are the units in the headings right? x_um is not x_mm";
            problems.warn("mixed-units", records.place(rows[0]), message, hint);
        }
        let limit = if instrument.sight.is_angle() { 5e-3 } else { FAR_MM };
        let far = |i: &&usize| {
            (0..channels).any(|c| deviations[**i][c].abs() > limit.max(20.0 * usual[c]))
        };
        let far: Vec<usize> = rows.iter().filter(far).copied().collect();
        for i in far.iter().take(MOST_REPORTED) {
            let off = deviations[*i].iter().fold(0.0_f64, |m, v| m.max(v.abs()));
            if instrument.kind.triggers() {
                let message = format!(
                    "the stylus was {off:.2} mm from where it touches: a hit on the wrong side?"
                );
                let hint = "correct or delete the hit; `length` is radius of ball + stylus";
                problems.error("wrong-side", records.place(*i), message, hint);
            } else {
                let (size, unit) = match instrument.sight.is_angle() {
                    true => (off * 1e6, "µrad"),
                    false => (off, "mm"),
                };
                let message = format!("reads {size:.3} {unit} off, far more than the others");
                if instrument.kind == Kind::ProbeBall && off > PROBE_RANGE_MM {
                    let message =
                        format!("the pose is {off:.2} mm off the ball, which no probe-ball reads");
                    let hint =
                        "a wrong pose or a wrong row: the socket stays on the ball in every pose";
                    problems.error("pose-off-ball", records.place(*i), message, hint);
                    continue;
                }
                let hint = "a lost row, a slip, a wrong pose? correct it or delete it";
                problems.warn("far-off", records.place(*i), message, hint);
            }
        }
        if far.len() > MOST_REPORTED {
            let message =
                format!("{}: {} more like these", instrument.name, far.len() - MOST_REPORTED);
            problems.note("far-off", records.place(far[MOST_REPORTED]), message, "");
        }
    }
}

/// Groups that are shorter than most.
fn check_lost_rows(records: &Records, problems: &mut Diagnostics) {
    let mut groups: BTreeMap<u32, (usize, usize)> = BTreeMap::new();
    for (i, group) in records.readings.groups.iter().enumerate() {
        groups.entry(*group).or_insert((0, i)).0 += 1;
    }
    let mut sizes: BTreeMap<usize, usize> = BTreeMap::new();
    groups.values().for_each(|(size, _)| *sizes.entry(*size).or_default() += 1);
    let Some((usual, times)) = sizes.iter().max_by_key(|(_, times)| **times) else { return };
    if *usual < 2 || *times * 10 < groups.len() * 8 || groups.len() < 5 {
        return;
    }
    for (size, first) in groups.values().filter(|(size, _)| size != usual).take(MOST_REPORTED) {
        let message = format!("{size} readings in this group, {usual} in most");
        let hint = "were rows lost, or measured twice? the rest counts as it is";
        problems.warn("uneven-groups", records.place(*first), message, hint);
    }
}

/// A ball on an axis of rotation stays where it is when the axis turns.
fn check_balls_on_axes(
    design: &Design,
    readings: &Readings,
    campaign: &Place,
    problems: &mut Diagnostics,
) {
    let machine = &design.machine;
    let none = ErrorValues::default();
    for (k, instrument) in design.instruments.iter().enumerate() {
        if !matches!(instrument.sight, Sight::ProbeOffset | Sight::Distance) {
            continue;
        }
        let rows: Vec<usize> =
            (0..readings.len()).filter(|i| readings.instruments[*i] as usize == k).collect();
        for (body, axis) in
            machine.bodies().iter().enumerate().filter_map(|(b, x)| Some((b, x.axis?)))
        {
            let angles = rows.iter().map(|i| readings.commands[*i][axis]);
            let (low, high) = angles.fold((f64::MAX, f64::MIN), |(l, h), q| (l.min(q), h.max(q)));
            if machine.axes()[axis].kind == AxisKind::Linear || high - low < 0.01 {
                continue;
            }
            let Some(component) = turning(machine.axes()[axis].direction) else { continue };
            let index = ErrorIndex { body, kind: ErrorKind::Motion, component };
            let distance = |i: &usize| {
                let command = &readings.commands[*i];
                let twist = machine.error_frames(command, instrument.reference).twist(index);
                let view = instrument.view(machine, command, &none, readings.directions[*i]);
                let p = view.nominal.linear() * instrument.tool_point_mm + view.nominal.shift_mm();
                (twist.shift_mm + twist.turn_rad.cross(&p)).norm()
            };
            let greatest = rows.iter().take(2000).map(distance).fold(0.0, f64::max);
            if greatest < ON_AXIS_MM {
                let name = machine.axes()[axis].name;
                let message = format!(
                    "{}: what it measures lies on the axis of {name} (within {greatest:.3} mm)",
                    instrument.name
                );
                let hint =
                    format!("turning {name} moves nothing there: set it up 50 mm or more away");
                problems.warn("on-axis", campaign.clone(), message, &hint);
            }
        }
    }
}

/// The rotation about an axis of rotation that lies along a machine axis.
fn turning(direction: Vec3) -> Option<Component> {
    let along = (0..3).find(|i| direction[*i].abs() > 1.0 - 1e-9)?;
    Some([Component::A, Component::B, Component::C][along])
}

/// Why a fit failed, with its row.
pub(super) fn tell_fault(
    fault: &FitError,
    records: &Records,
    place: &Place,
    problems: &mut Diagnostics,
) {
    let (place, hint) = match fault {
        FitError::Outside { row, .. } => {
            (records.place(*row), "correct the pose, or extend the table of the machine file")
        }
        _ => (place.clone(), "trueaxis identify --check-conventions tries signs, orders and sides"),
    };
    problems.error("no-fit", place, fault.to_string(), hint);
}
