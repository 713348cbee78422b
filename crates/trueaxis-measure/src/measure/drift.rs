//! `unknown = { drift = "free" }`: how a set-up drifts while its instrument reads.

use super::Kind;
use crate::instruments::Readings;
use crate::instruments::drift::Walk;
use crate::instruments::instrument::{Instrument, SetupError, SetupUnknown, Sight};
use trueaxis_geometry::Vec3;
use trueaxis_input::{Diagnostics, Dimension, Item, Place};
use trueaxis_machine::Machine;
use trueaxis_machine::axis::Command;
use trueaxis_machine::errors::ErrorValues;

/// A drift of a set-up as the campaign states it.
#[derive(Debug, Default)]
pub(super) struct StatedDrift {
    /// The rates that are unknown.
    pub rates: Vec<SetupUnknown>,
    /// What is not an even rate.
    pub walk: Walk,
}

/// `"free"`, the standard uncertainty with which the rate is known to be 0 (`"5 um/h"`), `"walk"` or `"none"`.
///
/// What drifts: the instrument along the axes of the machine; the zero of a distance; and where a head turns the tool, so
/// that it shows, the tool point along the tool.
pub(super) fn read_drift(
    item: &Item<'_>,
    kind: Kind,
    direction: Vec3,
    machine: &Machine,
) -> StatedDrift {
    let dimension = match kind.sight().is_angle() {
        true => Dimension::AngularVelocity,
        false => Dimension::Velocity,
    };
    let prior_u = match item.as_text() {
        Some("walk") => return StatedDrift { walk: Walk::Always, ..StatedDrift::default() },
        Some("none") => return StatedDrift { walk: Walk::Never, ..StatedDrift::default() },
        Some("free") => None,
        // Velocities are in mm/s and rad/s, drifts by the hour.
        _ => match item.quantity(dimension).map(|u| u * 3600.0) {
            Some(u) if u > 0.0 => Some(u),
            Some(_) => {
                let message = "the standard uncertainty of a rate is positive".to_owned();
                let hint =
                    "drift = \"free\", \"5 um/h\" (known to be 0 within it), \"walk\" or \"none\"";
                item.error("bad-drift", message, hint);
                return StatedDrift::default();
            }
            None => return StatedDrift::default(),
        },
    };
    // What reads along one direction sees a drift along no other.
    let sees = |i: &usize| match kind.sight() {
        Sight::Along | Sight::Turn => direction[*i].abs() > 1e-6,
        Sight::ProbeOffset | Sight::Place | Sight::Distance | Sight::Element(_) => true,
    };
    let zero = (kind.sight() == Sight::Distance).then_some(SetupError::ZeroDrift);
    let tool = (sees_growth(kind) && head_turns(machine)).then_some(SetupError::ToolDrift);
    let errors = (0..3).filter(sees).map(SetupError::Drift).chain(zero).chain(tool);
    let rate = |error| SetupUnknown { name: kind.unknown_name(error), error, prior_u };
    StatedDrift { rates: errors.map(rate).collect(), walk: Walk::default() }
}

/// Whether it reads a place of the tool point in several directions: along one alone a growth of the tool is a drift of the
/// instrument.
fn sees_growth(kind: Kind) -> bool {
    matches!(kind.sight(), Sight::ProbeOffset | Sight::Place | Sight::Distance)
}

/// Whether the direction of the tool on the bed changes with an axis.
fn head_turns(machine: &Machine) -> bool {
    let along = |command: &Command| {
        let pose = machine.tool_on_bed(command, &ErrorValues::default());
        pose.linear().column(2).into_owned()
    };
    let at_zero = along(&Command::default());
    (0..machine.axes().len()).any(|axis| {
        let mut turned = Command::default();
        turned[axis] = 0.5; // an angle that is no symmetry of any chain
        (along(&turned) - at_zero).norm() > 1e-6
    })
}

/// A drift needs to know when each row was read.
pub fn check_time(
    instrument: &Instrument,
    readings: &Readings,
    has_column: bool,
    table: &Place,
    problems: &mut Diagnostics,
) {
    let first = readings.times_s.first().copied().unwrap_or(0.0);
    let stands = readings.times_s.iter().all(|t| *t == first);
    if !instrument.needs_time() || readings.len() < 2 || has_column && !stands {
        return;
    }
    let message = match has_column {
        false => format!("{} drifts, but its readings have no time", instrument.name),
        true => format!("{} drifts, but all its rows were read at {first} s", instrument.name),
    };
    let hint = "a column time_s (time_min, time_h): when each row was read; or leave out `drift`";
    problems.error("drift-without-time", table.clone(), message, hint);
}
