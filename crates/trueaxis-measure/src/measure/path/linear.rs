//! Paths of the linear axes: circles, diagonals, lists of targets.

use super::placing::turns_about;
use super::sphere::unreachable_station;
use super::spread::read_range;
use super::{MOST_STATIONS, Placing, read_at, read_count, station};
use crate::measure::{Campaign, Readings};
use trueaxis_geometry::Vec3;
use trueaxis_geometry::statistics::SplitMix64;
use trueaxis_input::{Dimension, Item, Section};
use trueaxis_machine::axis::{AxisKind, Command};

/// A circle or an arc of a bar about its table ball in a plane of the workpiece, first counter-clockwise,
/// then clockwise.
pub(super) fn read_circle(
    section: &Section<'_>,
    campaign: &Campaign,
    instrument: usize,
) -> Option<Readings> {
    let placing = Placing::for_path(section, campaign, instrument)?;
    let length = |key: &str| section.get(key).map(|i| i.quantity(Dimension::Length));
    let radius = length("radius").unwrap_or(Some(placing.reach_mm));
    let count = read_count(section, "count", 72);
    let both = section.get("both_ways").map_or(Some(true), |i| i.flag());
    let rotary = read_at(section, campaign);
    let (a, b) = match section.text("plane") {
        Some("XY") | None => (Vec3::x(), Vec3::y()),
        Some("YZ") => (Vec3::y(), Vec3::z()),
        Some("ZX") => (Vec3::z(), Vec3::x()),
        Some(other) => {
            let message = format!("`{other}` is no plane");
            section.error("bad-plane", message, "plane = \"XY\", \"YZ\" or \"ZX\"");
            return None;
        }
    };
    let (radius, count, both, rotary) = (radius?, count?, both?, rotary?);
    if radius <= 0.0 {
        let message = "a circle needs a radius".to_owned();
        section.error("bad-radius", message, "radius = \"150 mm\", or `length` of the instrument");
        return None;
    }
    let (from, to) = read_arc(section)?;
    let step = (to - from) / count as f64;
    let there = (0..=count).map(|k| from + k as f64 * step);
    let back = (0..if both { count + 1 } else { 0 }).rev().map(|k| from + k as f64 * step);
    let mut stations = Readings::default();
    for (i, angle) in there.chain(back).enumerate() {
        let (sin, cos) = angle.sin_cos();
        let point = placing.reference_point_mm + (a * cos + b * sin) * radius;
        let Some(command) = placing.place(point, &rotary) else {
            return unreachable_station(section, i);
        };
        stations.push(station(command, campaign, instrument, i));
    }
    Some(stations)
}

/// `from` and `to` of an arc: in a vertical plane the bar does not pass under its table ball.
fn read_arc(section: &Section<'_>) -> Option<(f64, f64)> {
    const WHOLE: f64 = std::f64::consts::TAU;
    let bound = |key: &str| section.get(key).map(|i| i.quantity(Dimension::Angle));
    let (from, to) = (bound("from"), bound("to"));
    let (from, to) = (from.unwrap_or(Some(0.0))?, to.unwrap_or(Some(WHOLE))?);
    if (to - from).abs() < 1e-6 || (to - from).abs() > WHOLE + 1e-9 {
        let message = "an arc is longer than 0 and at most 360 deg".to_owned();
        section.error("bad-arc", message, "from = \"-20 deg\" and to = \"200 deg\"");
        return None;
    }
    Some((from, to))
}

/// A body or face diagonal of the travel: `diagonal = "++-"` (X, Y, Z) or `"+X-Y"`.
pub(super) fn read_diagonal(
    section: &Section<'_>,
    campaign: &Campaign,
    instrument: usize,
) -> Option<Readings> {
    let hint = "\"+++\", \"++-\", \"+-+\", \"+--\" (body) or \"+X+Y\", \"+X-Y\" … (face)";
    let item = section.require("diagonal", hint);
    let count = read_count(section, "count", 10);
    let runs = read_count(section, "runs", 1);
    let start = read_at(section, campaign);
    let item = item?;
    let Some(signs) = signs(item.text()?, campaign) else {
        item.error("bad-diagonal", "this names no diagonal of the machine".into(), hint);
        section.entries();
        return None;
    };
    let mut ends = Vec::new();
    for (axis, sign) in &signs {
        let (from, to) = read_range(section, campaign, *axis)?;
        ends.push((*axis, if *sign > 0.0 { (from, to) } else { (to, from) }));
    }
    let (count, runs, start) = (count?.max(2), runs?, start?);
    let at = |t: f64| {
        let mut command = start;
        for (axis, (from, to)) in &ends {
            command[*axis] = from + (to - from) * t;
        }
        command
    };
    let along = (0..count).map(|k| at(k as f64 / (count - 1) as f64)).collect::<Vec<_>>();
    let direction = way_of_tool(campaign, instrument, &at(0.0), &at(1.0));
    let runs = Runs { commands: &along, count: runs, direction };
    there_and_back(section, campaign, instrument, &runs, |i| {
        let mut approach = [0.0; 6];
        for (axis, sign) in &signs {
            approach[*axis] = if i { *sign } else { -sign };
        }
        approach
    })
}

/// Axis and sign for each letter of a diagonal.
fn signs(text: &str, campaign: &Campaign) -> Option<Vec<(usize, f64)>> {
    let index = |letter: char| {
        let axes = campaign.machine.axes();
        axes.iter().position(|a| a.kind == AxisKind::Linear && a.name.letter() == letter)
    };
    let sign = |c: char| match c {
        '+' => Some(1.0),
        '-' | '−' => Some(-1.0),
        _ => None,
    };
    let chars: Vec<char> = text.chars().collect();
    match chars[..] {
        [x, y, z] => [(x, 'X'), (y, 'Y'), (z, 'Z')]
            .into_iter()
            .map(|(s, letter)| Some((index(letter)?, sign(s)?)))
            .collect(),
        [a, first, b, second] if first != second => [(a, first), (b, second)]
            .into_iter()
            .map(|(s, letter)| Some((index(letter)?, sign(s)?)))
            .collect(),
        _ => None,
    }
}

/// Targets of one axis, up and down, `runs` times, after ISO 230-2.
///
/// ```text
///     P_i = from + (i − 1) p + r_i        |r_i| ≤ period/2, another one at every target
/// ```
///
/// so that a periodic error of the scale or screw is not always met in the same phase (ISO 230-2,
/// 4.3.2).
pub(super) fn read_targets(
    section: &Section<'_>,
    campaign: &Campaign,
    instrument: usize,
) -> Option<Readings> {
    let item = section.require("axis", "axis = \"X\"");
    let item = item?;
    let letter = item.text()?;
    let Some(axis) = campaign.machine.axes().iter().position(|a| a.name.to_string() == letter)
    else {
        let message = format!("{} has no axis {letter}", campaign.machine.chain_text());
        item.error("unknown-axis", message, "the letter of an axis of the machine");
        section.entries();
        return None;
    };
    let kind = campaign.machine.axes()[axis].kind;
    let range = match (section.get("from"), section.get("to")) {
        (None, None) => read_range(section, campaign, axis),
        (Some(from), Some(to)) => read_ends(&from, &to, kind),
        _ => {
            section.error("missing-key", "a range has two ends".into(), "from = and to =");
            None
        }
    };
    let period = section.get("period").map_or(Some(0.0), |i| super::read_position(&i, kind));
    let runs = read_count(section, "runs", 5);
    let seed = section.get("seed").map_or(Some(1), |i| i.count());
    let start = read_at(section, campaign);
    let (from, to) = range?;
    let count = read_count(section, "count", usual_targets(kind, to - from))?.max(2);
    let (period, runs, seed, start) = (period?, runs?, seed?, start?);
    let mut random = SplitMix64::new(seed as u64);
    let p = (to - from) / (count - 1) as f64;
    // The ends stay inside, and the order of the targets is kept.
    let reach = (0.5 * period).abs().min(0.49 * p.abs());
    let (low, high) = (from.min(to), from.max(to));
    let targets: Vec<Command> = (0..count)
        .map(|i| {
            let mut command = start;
            let shifted = from + p * i as f64 + reach * (2.0 * random.unit() - 1.0);
            command[axis] = shifted.clamp(low, high);
            command
        })
        .collect();
    let direction = match kind {
        AxisKind::Linear => way_of_tool(campaign, instrument, &targets[0], &targets[count - 1]),
        AxisKind::Rotary => {
            let about = turns_about(&campaign.machine, axis, &start, Vec3::zeros()).1;
            // The deviation is counted in the sense of the axis.
            Some(about * if p < 0.0 { -1.0 } else { 1.0 }).filter(|v| v.norm() > 0.5)
        }
    };
    let runs = Runs { commands: &targets, count: runs, direction };
    there_and_back(section, campaign, instrument, &runs, |up| {
        let mut approach = [0.0; 6];
        approach[axis] = if up == (p >= 0.0) { 1.0 } else { -1.0 };
        approach
    })
}

fn read_ends(from: &Item<'_>, to: &Item<'_>, kind: AxisKind) -> Option<(f64, f64)> {
    let (from, to) = (super::read_position(from, kind), super::read_position(to, kind));
    Some((from?, to?)).filter(|(from, to)| from != to)
}

/// ISO 230-2: at least five targets a metre and five in all; 3, 5 or 8 of a rotary axis.
fn usual_targets(kind: AxisKind, range: f64) -> usize {
    let range = range.abs();
    match kind {
        AxisKind::Linear => ((range / 200.0).ceil().min(1e4) as usize + 1).max(5),
        AxisKind::Rotary if range <= 90f64.to_radians() + 1e-9 => 3,
        AxisKind::Rotary if range <= 180f64.to_radians() + 1e-9 => 5,
        AxisKind::Rotary => 8,
    }
}

/// Which way the tool point goes between two commands, as the instrument sees it.
fn way_of_tool(
    campaign: &Campaign,
    instrument: usize,
    from: &Command,
    to: &Command,
) -> Option<Vec3> {
    let instrument = &campaign.instruments[instrument];
    let none = trueaxis_machine::errors::ErrorValues::default();
    let [a, b] = [from, to].map(|command| {
        let view = instrument.view(&campaign.machine, command, &none, Vec3::x());
        view.nominal.linear() * instrument.tool_point_mm + view.nominal.shift_mm()
    });
    (b - a).try_normalize(1e-9)
}

/// Runs up and down over the same commands.
struct Runs<'a> {
    commands: &'a [Command],
    count: usize,
    /// In which the tool goes.
    direction: Option<Vec3>,
}

/// The stations of runs; `approach` of a run up (`true`) or down.
fn there_and_back(
    section: &Section<'_>,
    campaign: &Campaign,
    instrument: usize,
    runs: &Runs<'_>,
    approach: impl Fn(bool) -> [f64; 6],
) -> Option<Readings> {
    let own = &campaign.instruments[instrument];
    let commands = runs.commands;
    // What the instrument is set to counts: straightness is read across the way.
    let direction = match section.get("direction") {
        Some(item) => trueaxis_machine::file::read_direction(&item)?,
        None => runs.direction.unwrap_or(own.direction),
    };
    if commands.len().saturating_mul(2 * runs.count) > MOST_STATIONS {
        let message = format!("more than {MOST_STATIONS} stations");
        section.error("bad-count", message, "fewer targets or runs");
        return None;
    }
    let mut stations = Readings::default();
    for _ in 0..runs.count {
        for up in [true, false] {
            for k in 0..commands.len() {
                let k = if up { k } else { commands.len() - 1 - k };
                let row = station(commands[k], campaign, instrument, k);
                stations.push(super::Reading { approach: approach(up), direction, ..row });
            }
        }
    }
    Some(stations)
}
