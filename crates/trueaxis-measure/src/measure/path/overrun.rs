//! The overrun at the ends of a run: the first target of the next run is approached from its own side.
//!
//! ```text
//!     q_before = q − d o        d = ±1 the stated side, o the overrun      docs/model.md eq. 187
//! ```

use crate::measure::{Campaign, Readings};
use trueaxis_input::{Dimension, Section, parse_quantity};
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{AxisKind, Command, Travel};

/// The overrun of a linear axis where none is stated, mm.
const USUAL_MM: f64 = 5.0;
/// That of a rotary axis, rad.
const USUAL_RAD: f64 = std::f64::consts::PI / 180.0;
/// The rounding of an inverse is no motion, mm or rad.
const REST: f64 = 1e-9;

/// How far, and whether the campaign states it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Overrun {
    /// Unit: mm or rad.
    pub amount: f64,
    is_stated: bool,
}

/// `overrun = "5 mm"` of targets, diagonals and tables; the other paths state no sides.
pub(super) fn read_overrun(
    section: &Section<'_>,
    kind: &str,
    campaign: &Campaign,
) -> Option<Overrun> {
    let rotary = match kind {
        "diagonal" => false,
        "targets" => {
            let letter = section.text("axis").unwrap_or_default();
            let mut axes = campaign.machine.axes().iter();
            axes.any(|a| a.name.to_string() == letter && a.kind == AxisKind::Rotary)
        }
        "table" if section.get("overrun").is_some() => {
            let stated = section.get("overrun").and_then(|item| item.as_text());
            stated.is_some_and(|text| parse_quantity(text, Dimension::Angle).is_ok())
        }
        _ => return Some(Overrun { amount: 0.0, is_stated: false }),
    };
    let (usual, dimension) = match rotary {
        true => (USUAL_RAD, Dimension::Angle),
        false => (USUAL_MM, Dimension::Length),
    };
    let Some(item) = section.get("overrun") else {
        return Some(Overrun { amount: usual, is_stated: false });
    };
    let amount = item.quantity(dimension)?;
    if amount < 0.0 {
        let message = "an overrun is a distance: it cannot be negative".to_owned();
        item.error("negative", message, "write it without the minus, or 0 for none");
        return None;
    }
    Some(Overrun { amount, is_stated: true })
}

/// Where the axes go first, so that station `i` is approached from the sides that it states; `None`
/// where the way from the station before it does that already, or there is no room.
pub fn before_station(
    machine: &Machine,
    stations: &Readings,
    i: usize,
    overrun: f64,
) -> Option<Command> {
    let here = stations.commands[i];
    let mut first = here;
    for (k, axis) in machine.axes().iter().enumerate() {
        if overrun > 0.0 && comes_from_elsewhere(stations, i, k) {
            let beyond = here[k] - stations.approaches[i][k] * overrun;
            first[k] = match axis.travel {
                Travel::Between(from, to) => beyond.clamp(from.min(to), to.max(from)),
                _ => beyond,
            };
        }
    }
    (first != here).then_some(first)
}

/// Whether an axis does not come to a station from the side that is stated.
fn comes_from_elsewhere(stations: &Readings, i: usize, axis: usize) -> bool {
    let side = stations.approaches[i][axis];
    let Some(before) = i.checked_sub(1) else { return side != 0.0 };
    let way = stations.commands[i][axis] - stations.commands[before][axis];
    let came = if way.abs() > REST { way.signum() } else { stations.approaches[before][axis] };
    side != 0.0 && came != side
}

/// Whether a stated overrun stays within the travel.
pub(super) fn check_room(
    section: &Section<'_>,
    machine: &Machine,
    stations: &Readings,
    overrun: Overrun,
) -> bool {
    if !overrun.is_stated || overrun.amount == 0.0 {
        return true;
    }
    for i in 0..stations.len() {
        for (k, axis) in machine.axes().iter().enumerate() {
            let beyond = stations.commands[i][k] - stations.approaches[i][k] * overrun.amount;
            if comes_from_elsewhere(stations, i, k) && !axis.travel.contains(beyond) {
                let (unit, scale) = match axis.kind {
                    AxisKind::Linear => ("mm", 1.0),
                    AxisKind::Rotary => ("deg", 1f64.to_degrees()),
                };
                let [at, beyond] = [stations.commands[i][k], beyond].map(|q| q * scale);
                let message = format!(
                    "no room for the overrun: target {at:.3} {unit} of {} is approached from {beyond:.3} \
                     {unit}, outside its travel",
                    axis.name
                );
                let hint = "keep the targets away from the ends of the travel (from, to), or shorten the overrun";
                section.error("no-overrun", message, hint);
                return false;
            }
        }
    }
    true
}
