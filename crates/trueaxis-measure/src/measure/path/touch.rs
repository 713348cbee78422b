//! Hits of a touch probe on a ball: from the free side, where neither stem is in the way.

use super::spread::tell_left;
use super::{Placing, leaves_travel, read_axes, read_count, read_poses, station};
use crate::measure::{Campaign, Kind, Reading, Readings};
use trueaxis_geometry::Vec3;
use trueaxis_input::Section;
use trueaxis_machine::axis::Command;
use trueaxis_machine::file::read_direction;

/// Hits of a pose; more are not needed for a ball.
const MOST_HITS: usize = 100;
/// How far a hit stays from the stem of the ball: the cosine of 60°.
const NEAR_STEM: f64 = 0.5;
/// How many places around the ball are tried.
const ROUND: usize = 72;
/// How far the stylus stands off before a hit, mm.
pub const STAND_OFF_MM: f64 = 2.0;

/// Where a ball can be hit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FreeSide {
    /// From the ball towards its foot, a unit vector of the workpiece.
    pub stem: Vec3,
}

impl FreeSide {
    /// Whether a hit from this side meets neither the stem of the ball nor that of the stylus.
    pub fn is_free(&self, side: &Vec3, tool_axis: &Vec3) -> bool {
        side.dot(&self.stem) <= NEAR_STEM && side.dot(tool_axis) >= -1e-9
    }
}

/// From which sides a ball is hit while the tool stands along `tool_axis`: once from above, the
/// others evenly round the equator that the stylus can reach; empty where nothing is free.
pub fn hits(free: FreeSide, tool_axis: Vec3, count: usize) -> Vec<Vec3> {
    if count == 0 || !free.is_free(&tool_axis, &tool_axis) {
        return Vec::new();
    }
    let mut sides = vec![tool_axis];
    // Where the stem leans to, the equator is not free.
    let lean = free.stem - tool_axis * free.stem.dot(&tool_axis);
    let any = [Vec3::x(), Vec3::y()].map(|v| v - tool_axis * v.dot(&tool_axis));
    let any = if any[0].norm() > 0.5 { any[0] } else { any[1] };
    let away = -lean.try_normalize(1e-6).unwrap_or_else(|| -any.normalize());
    let beside = tool_axis.cross(&away);
    let at = |angle: f64| away * angle.cos() + beside * angle.sin();
    let turn = |k: usize| std::f64::consts::TAU * k as f64 / ROUND as f64;
    let blocked = (0..ROUND).find(|k| !free.is_free(&at(turn(*k)), &tool_axis));
    let wanted = count - 1;
    match blocked {
        None => {
            sides.extend((0..wanted).map(|k| at(std::f64::consts::TAU * k as f64 / wanted as f64)));
        }
        // Free from −last to +last about the side away from the stem.
        Some(first) => {
            let last = turn(first.max(1) - 1);
            let step = |k: usize| match wanted {
                1 => 0.0,
                _ => last * (2.0 * k as f64 / (wanted - 1) as f64 - 1.0),
            };
            sides.extend((0..wanted).map(|k| at(step(k))));
        }
    }
    sides
}

/// `touch`: hits on a ball at rotary poses.
pub(super) fn read_touch(
    section: &Section<'_>,
    campaign: &Campaign,
    instrument: usize,
) -> Option<Readings> {
    if campaign.instruments[instrument].kind != Kind::TouchProbeBall {
        let message = "only a touch probe on a ball hits".to_owned();
        section.error("unknown-instrument", message, "an instrument of kind \"touch-probe-ball\"");
        section.entries();
        return None;
    }
    let placing = Placing::for_path(section, campaign, instrument)?;
    let count = read_count(section, "hits", 5)?.min(MOST_HITS);
    let stem = section.get("stem").map_or(Some(-Vec3::z()), |i| read_direction(&i))?;
    let random = section.get("count").is_some();
    let poses = match section.get("poses") {
        Some(item) => {
            let mut commands = Vec::new();
            for item in item.list()? {
                let mut command = Command::default();
                let read = |s: &Section<'_>| read_axes(s, campaign, &mut command);
                item.section(&section.path("poses"), read).flatten()?;
                commands.push(command);
            }
            super::Poses { commands }
        }
        None => read_poses(section, campaign, random, true)?,
    };
    let wanted = if random { read_count(section, "count", 50)? } else { usize::MAX };
    let listed = section.get("poses").is_some();
    let mut stations = Readings::default();
    let (mut kept, mut left) = (0, 0);
    for rotary in &poses.commands {
        if kept == wanted {
            break;
        }
        let sides = hits(FreeSide { stem }, placing.tool_axis(rotary), count);
        let rows = touched(campaign, instrument, &placing, rotary, &sides, kept);
        let up = placing.tool_axis(rotary);
        let inside = |point: Vec3| {
            let command = placing.place(point, rotary);
            command.is_some_and(|c| leaves_travel(&campaign.machine, &c).is_none())
        };
        let free = |r: &Reading| {
            let hit = leaves_travel(&campaign.machine, &r.command).is_none();
            hit && placing.beside(r.direction, up).into_iter().all(inside)
        };
        // Poses that are named are not left out: their stations are judged with the path.
        if !rows.is_empty() && (listed || rows.iter().all(free)) {
            rows.into_iter().for_each(|row| stations.push(row));
            kept += 1;
        } else {
            left += 1;
        }
    }
    tell_left(section, left, kept, random);
    Some(stations)
}

/// The hits of one pose.
fn touched(
    campaign: &Campaign,
    instrument: usize,
    placing: &Placing,
    rotary: &Command,
    sides: &[Vec3],
    pose: usize,
) -> Vec<Reading> {
    let mut rows = Vec::new();
    for side in sides {
        let off = placing.reference_point_mm + side * (placing.reach_mm + STAND_OFF_MM);
        let (Some(command), Some(off)) =
            (placing.contact(*side, rotary), placing.place(off, rotary))
        else {
            return Vec::new();
        };
        let row = station(command, campaign, instrument, pose);
        let approach = std::array::from_fn(|i| {
            let moved: f64 = command[i] - off[i];
            if moved.abs() > 1e-9 { moved.signum() } else { 0.0 }
        });
        rows.push(Reading { approach, direction: *side, ..row });
    }
    rows
}

#[cfg(test)]
mod tests {
    use super::*;

    /// However tool and stem stand: hits are unit vectors from free sides, one along the tool, the others across it.
    #[test]
    fn law_hits_are_one_from_above_and_the_others_across() {
        let tilted = |x: f64, y: f64| Vec3::new(x, y, 1.0).normalize();
        for (tool_axis, stem) in [
            (Vec3::z(), -Vec3::z()),
            (tilted(0.6, 0.3), -tilted(0.6, 0.3)),
            (tilted(-0.2, 1.4), -Vec3::z()),
            (Vec3::x(), -Vec3::x()),
        ] {
            let free = FreeSide { stem };
            for count in [1, 2, 5, 13] {
                let sides = hits(free, tool_axis, count);
                assert_eq!((sides.len(), sides[0]), (count, tool_axis));
                for side in &sides {
                    assert!((side.norm() - 1.0).abs() < 1e-12 && free.is_free(side, &tool_axis));
                }
                assert!(sides[1..].iter().all(|side| side.dot(&tool_axis).abs() < 1e-12));
                // All round where nothing is in the way: their sum is nothing.
                let sum: Vec3 = sides[1..].iter().sum();
                assert!(stem != -tool_axis || count < 3 || sum.norm() < 1e-12, "{count}: {sum}");
            }
        }
    }
}
