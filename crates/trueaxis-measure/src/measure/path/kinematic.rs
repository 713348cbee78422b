//! The kinematic tests of ISO 10791-6 for five-axis machining centres, in the manner of the standard: A…, B… and C… by where
//! the rotary axes sit, 1 and 2 one rotary axis each, 3 both on a cone, 4 both on a sphere.
//!
//! The text of the standard was not available. That one axis at a time is followed by the linear ones and
//! read radially, tangentially and axially (AK1, AK2, BK1, BK2, CK1, CK2) is how the open literature
//! describes it; which number the tests with both rotary axes bear is our choice.

use super::sphere::{read_cone, read_s, read_turning};
use crate::instruments::instrument::Sight;
use crate::measure::{Campaign, Readings};
use trueaxis_input::{Item, Section};
use trueaxis_machine::Machine;
use trueaxis_machine::axis::AxisKind;

/// What the letters mean.
const FAMILIES: [(&str, &str); 3] = [
    ("AK", "both rotary axes on the tool side"),
    ("BK", "both rotary axes on the workpiece side"),
    ("CK", "one rotary axis on either side"),
];

/// Whether a word is the name of a test.
pub(super) fn is_test(word: &str) -> bool {
    word.len() == 3
        && FAMILIES.iter().any(|(family, _)| word.starts_with(family))
        && word.ends_with(['1', '2', '3', '4'])
}

/// The paths of a test: what their names end in, and the stations.
pub(super) fn read_test(
    section: &Section<'_>,
    kind: &Item<'_>,
    campaign: &Campaign,
    instrument: usize,
) -> Option<Vec<(String, Readings)>> {
    let word = kind.as_text()?;
    let machine = &campaign.machine;
    let family = family(machine);
    if family.is_none_or(|f| !word.starts_with(f)) {
        let (_, meaning) = FAMILIES.iter().find(|(f, _)| word.starts_with(f))?;
        let message =
            format!("{word} is for machines with {meaning}, not for {}", machine.chain_text());
        let hint = family.map_or_else(
            || "a machine with two rotary axes".to_owned(),
            |own| format!("kind = \"{own}{}\"", &word[2..]),
        );
        kind.error("other-topology", message, &hint);
        section.entries();
        return None;
    }
    let whole = |stations: Option<Readings>| stations.map(|s| vec![(String::new(), s)]);
    match &word[2..] {
        "1" => read_axis(section, campaign, instrument, tilting(machine)?),
        "2" => read_axis(section, campaign, instrument, other(machine, tilting(machine)?)?),
        "3" => whole(read_cone(section, campaign, instrument)),
        _ => whole(read_s(section, campaign, instrument)),
    }
}

/// One axis turns: a ball-bar reads in three directions, one after the other, unless one is named.
fn read_axis(
    section: &Section<'_>,
    campaign: &Campaign,
    instrument: usize,
    axis: usize,
) -> Option<Vec<(String, Readings)>> {
    let bars = match (campaign.instruments[instrument].sight, section.text("bar")) {
        (Sight::Distance, None) => vec!["radial", "tangential", "axial"],
        (Sight::Distance, Some(bar)) => vec![bar],
        _ => vec![""],
    };
    let read = |bar: &str| {
        let stations = read_turning(section, (axis, bar), campaign, instrument)?;
        Some((bar.to_owned(), stations))
    };
    bars.into_iter().map(read).collect()
}

/// Where the rotary axes sit.
fn family(machine: &Machine) -> Option<&'static str> {
    let on_workpiece_side: Vec<bool> = rotary(machine)
        .map(|axis| {
            let body = machine.bodies().iter().position(|b| b.axis == Some(axis));
            body.is_some_and(|body| body < machine.workpiece_side())
        })
        .collect();
    match on_workpiece_side.as_slice() {
        [false, false] => Some("AK"),
        [true, true] => Some("BK"),
        [_, _] => Some("CK"),
        _ => None,
    }
}

fn rotary(machine: &Machine) -> impl Iterator<Item = usize> {
    let axes = machine.axes().iter().enumerate();
    axes.filter(|(_, a)| a.kind == AxisKind::Rotary).map(|(i, _)| i)
}

/// The rotary axis that is not C; of two such, or of two C, the first of the chain.
fn tilting(machine: &Machine) -> Option<usize> {
    let letter = |i: &usize| machine.axes()[*i].name.to_string() != "C";
    rotary(machine).find(letter).or_else(|| rotary(machine).next())
}

fn other(machine: &Machine, axis: usize) -> Option<usize> {
    rotary(machine).find(|i| *i != axis)
}
