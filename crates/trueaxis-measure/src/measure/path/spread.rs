//! Poses over the travel: grids and random ones, with linear axes that follow where the instrument
//! holds on to a ball.

use super::{MOST_STATIONS, Placing, leaves_travel, read_count, read_position, station};
use crate::measure::{Campaign, Kind, Readings};
use trueaxis_geometry::Vec3;
use trueaxis_geometry::statistics::SplitMix64;
use trueaxis_input::{Item, Section};
use trueaxis_machine::axis::{AxisKind, Command, Travel};

/// Draws per pose that is wanted; more are wasted on a ball that is out of reach.
const TRIES: usize = 200;

/// Where one axis may stand.
#[derive(Debug, Clone, Copy)]
struct Range {
    from: f64,
    to: f64,
    /// Steps of a grid; 1 for an axis that stands.
    count: usize,
}

/// Poses as a section names them.
#[derive(Debug, Clone, Default)]
pub struct Poses {
    /// Axis positions; linear ones may still have to follow.
    pub commands: Vec<Command>,
}

/// The range of an axis: `X = ["-100 mm", "100 mm"]`, else its travel.
pub(super) fn read_range(
    section: &Section<'_>,
    campaign: &Campaign,
    axis: usize,
) -> Option<(f64, f64)> {
    let axis = &campaign.machine.axes()[axis];
    if let Some(item) = section.get(&axis.name.to_string()) {
        let range = read_list(&item, axis.kind)?;
        return Some((range.from, range.to));
    }
    match (axis.travel, axis.kind) {
        (Travel::Between(from, to), _) => Some((from, to)),
        (_, AxisKind::Rotary) => Some((-std::f64::consts::PI, std::f64::consts::PI)),
        _ => {
            let message = format!("the machine file does not say how far {} goes", axis.name);
            let hint = format!("{} = [\"-200 mm\", \"200 mm\"]", axis.name);
            section.error("unknown-travel", message, &hint);
            None
        }
    }
}

/// `["-90 deg", "90 deg", 7]`, `["-90 deg", "90 deg"]` or `"0 deg"`.
fn read_list(item: &Item<'_>, kind: AxisKind) -> Option<Range> {
    if !item.is_list() {
        return read_position(item, kind).map(|q| Range { from: q, to: q, count: 1 });
    }
    let list = item.list()?;
    let position = |item: &Item<'_>| read_position(item, kind);
    match &list[..] {
        [from, to] => Some(Range { from: position(from)?, to: position(to)?, count: 2 }),
        [from, to, count] => {
            let count = count.count()?;
            if !(1..=MOST_STATIONS).contains(&count) {
                item.error("bad-count", format!("{count} steps make no grid"), "such as 7");
                return None;
            }
            Some(Range { from: position(from)?, to: position(to)?, count })
        }
        _ => {
            let hint = "[\"-90 deg\", \"90 deg\", 7]: from, to, how many";
            item.error("bad-list", "a range has two ends".into(), hint);
            None
        }
    }
}

/// Poses of the axes: every combination of the named ranges (`random = false`), or `count` draws.
///
/// Linear axes that follow a ball are not asked for. An axis that is not named stands at 0 in a
/// grid and goes over its whole travel in a draw.
pub fn read_poses(
    section: &Section<'_>,
    campaign: &Campaign,
    random: bool,
    follows: bool,
) -> Option<Poses> {
    let mut ranges = Vec::new();
    for (i, axis) in campaign.machine.axes().iter().enumerate() {
        if follows && axis.kind == AxisKind::Linear {
            continue;
        }
        let named = section.get(&axis.name.to_string());
        let range = match (named, random) {
            (Some(item), _) => read_list(&item, axis.kind)?,
            (None, false) => continue,
            (None, true) => {
                let (from, to) = read_range(section, campaign, i)?;
                Range { from, to, count: 2 }
            }
        };
        ranges.push((i, range));
    }
    if random {
        let count = read_count(section, "count", 50)?;
        let seed = section.get("seed").map_or(Some(1), |i| i.count())?;
        return Some(drawn(&ranges, count, seed as u64));
    }
    let total = ranges.iter().fold(1usize, |n, (_, r)| n.saturating_mul(r.count));
    if total > MOST_STATIONS {
        let message = format!("the grid has {total} poses");
        section.error("bad-count", message, &format!("at most {MOST_STATIONS}"));
        return None;
    }
    Some(combined(&ranges, total))
}

fn drawn(ranges: &[(usize, Range)], count: usize, seed: u64) -> Poses {
    let mut random = SplitMix64::new(seed);
    // Enough for those that turn out to be out of reach.
    let draw = |_| {
        let mut command = Command::default();
        for (axis, range) in ranges {
            command[*axis] = range.from + (range.to - range.from) * random.unit();
        }
        command
    };
    let most = count.saturating_mul(TRIES).min(MOST_STATIONS * 10);
    Poses { commands: (0..most).map(draw).collect() }
}

/// The last axis fastest, there and back, so that a pose is next to the one before.
fn combined(ranges: &[(usize, Range)], total: usize) -> Poses {
    let pose = |k: usize| {
        let mut command = Command::default();
        let mut block = total;
        for (axis, range) in ranges {
            block /= range.count;
            let step = k / block.max(1);
            let (digit, turn) = (step % range.count, step / range.count);
            let digit = if turn % 2 == 1 { range.count - 1 - digit } else { digit };
            let t = digit as f64 / (range.count.max(2) - 1) as f64;
            command[*axis] = range.from + (range.to - range.from) * t;
        }
        command
    };
    Poses { commands: (0..total).map(pose).collect() }
}

/// `grid` and `random`.
pub(super) fn read_spread(
    section: &Section<'_>,
    campaign: &Campaign,
    instrument: usize,
) -> Option<Readings> {
    let random = section.text("kind") == Some("random");
    let own = &campaign.instruments[instrument];
    let follows = matches!(own.kind, Kind::ProbeBall | Kind::BallBar | Kind::BallCentre);
    let placing = match follows {
        true => Some(Placing::for_path(section, campaign, instrument)?),
        false => None,
    };
    let poses = read_poses(section, campaign, random, follows)?;
    let wanted = if random { read_count(section, "count", 50)? } else { poses.commands.len() };
    let mut directions = SplitMix64::new(7);
    let mut stations = Readings::default();
    let mut left = 0;
    for rotary in &poses.commands {
        if stations.len() == wanted {
            break;
        }
        let command = match &placing {
            None => Some(*rotary),
            Some(placing) => {
                // A bar stands up from the table.
                let up = Vec3::new(directions.unit() - 0.5, directions.unit() - 0.5, 0.5);
                placing.contact(up.normalize(), rotary)
            }
        };
        match command.filter(|c| leaves_travel(&campaign.machine, c).is_none()) {
            Some(command) => {
                let group = stations.len();
                stations.push(station(command, campaign, instrument, group));
            }
            None => left += 1,
        }
    }
    tell_left(section, left, stations.len(), random);
    Some(stations)
}

/// What of a grid lies outside the travel is left out, and reported.
pub(super) fn tell_left(section: &Section<'_>, left: usize, kept: usize, random: bool) {
    if left > 0 && !random {
        let message = format!("{left} of {} poses are outside the travel", left + kept);
        section.warn("outside-travel", message, "they are left out");
    }
}
