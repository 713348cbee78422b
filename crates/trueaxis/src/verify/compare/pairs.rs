//! Two sets of readings of the same places, reading by reading.

use std::collections::BTreeMap;
use trueaxis_machine::axis::{AxisKind, Command};
use trueaxis_measure::measure::{Campaign, Readings};

/// Commands that differ by less are one place: a hit moves by the errors, mm and rad.
const SAME_MM: f64 = 0.5;
const SAME_RAD: f64 = 1e-3;

/// The pairs of two sets.
#[derive(Debug, Clone)]
pub struct Pairs {
    /// The rows of the first set; their values are nominal readings plus second less first.
    pub differences: Readings,
    /// How many rows of the first set have no partner.
    pub alone_in_first: usize,
    /// How many rows of the second set have no partner.
    pub alone_in_second: usize,
}

/// Pairs readings of the same instrument at the same place, in their order.
pub fn pair(campaign: &Campaign, first: &Readings, second: &Readings) -> Pairs {
    let mut partners: BTreeMap<(u32, [i64; 6]), Vec<usize>> = BTreeMap::new();
    for row in (0..second.len()).rev() {
        let key = (second.instruments[row], cell(campaign, &second.commands[row], [0; 6]));
        partners.entry(key).or_default().push(row);
    }
    let mut differences = Readings::default();
    for row in 0..first.len() {
        let Some(other) = take_partner(campaign, first, second, row, &mut partners) else {
            continue;
        };
        let instrument = &campaign.instruments[first.instruments[row] as usize];
        let deviation = |readings: &Readings, row: usize| {
            let (command, direction) = (&readings.commands[row], readings.directions[row]);
            let nominal = instrument.nominal_reading(&campaign.machine, command, direction);
            (nominal, std::array::from_fn(|c| readings.values[row][c] - nominal[c]))
        };
        let (nominal, before): (_, [f64; 3]) = deviation(first, row);
        let (_, after): (_, [f64; 3]) = deviation(second, other);
        let mut reading = first.row(row);
        reading.value = std::array::from_fn(|c| nominal[c] + after[c] - before[c]);
        differences.push(reading);
    }
    Pairs {
        alone_in_first: first.len() - differences.len(),
        alone_in_second: second.len() - differences.len(),
        differences,
    }
}

/// The cell of a grid of places; `step` neighbours away.
fn cell(campaign: &Campaign, command: &Command, step: [i64; 6]) -> [i64; 6] {
    let mut cell = [0; 6];
    for (i, axis) in campaign.machine.axes().iter().enumerate() {
        let width = if axis.kind == AxisKind::Rotary { SAME_RAD } else { SAME_MM };
        let at = (command[i] / (2.0 * width)).floor() as i64;
        cell[i] = at.saturating_add(step[i]);
    }
    cell
}

/// The first unused row of the second set at the same place, in this cell or a neighbouring one.
fn take_partner(
    campaign: &Campaign,
    first: &Readings,
    second: &Readings,
    row: usize,
    partners: &mut BTreeMap<(u32, [i64; 6]), Vec<usize>>,
) -> Option<usize> {
    let command = &first.commands[row];
    let axes = campaign.machine.axes();
    let near = |other: &Command| {
        axes.iter().enumerate().all(|(i, axis)| {
            let width = if axis.kind == AxisKind::Rotary { SAME_RAD } else { SAME_MM };
            (other[i] - command[i]).abs() <= width
        })
    };
    // Each axis stands in the left or the right half of its cell: only that neighbour is near.
    let mut toward = [0i64; 6];
    for (i, axis) in axes.iter().enumerate() {
        let width = if axis.kind == AxisKind::Rotary { SAME_RAD } else { SAME_MM };
        let within = (command[i] / (2.0 * width)).rem_euclid(1.0);
        toward[i] = if within < 0.5 { -1 } else { 1 };
    }
    let mut best: Option<((u32, [i64; 6]), usize, usize)> = None;
    for choice in 0..1usize << axes.len() {
        let step = std::array::from_fn(|i| if choice >> i & 1 == 1 { toward[i] } else { 0 });
        let key = (first.instruments[row], cell(campaign, command, step));
        let Some(rows) = partners.get(&key) else { continue };
        // Rows stand backwards, so that the earliest is the last.
        let Some(at) = rows.iter().rposition(|r| near(&second.commands[*r])) else { continue };
        if best.as_ref().is_none_or(|(_, _, earliest)| rows[at] < *earliest) {
            best = Some((key, at, rows[at]));
        }
    }
    let (key, at, other) = best?;
    partners.get_mut(&key)?.remove(at);
    Some(other)
}
