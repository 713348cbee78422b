//! Points all over an element at poses of the rotary axes; the linear axes follow.

use super::spread::tell_left;
use super::{Placing, leaves_travel, read_count, read_poses, station};
use crate::measure::{Campaign, Readings};
use trueaxis_input::{Dimension, Section};
use trueaxis_machine::axis::Command;

/// How long and wide a plane, a line or a cylinder is where it is not stated, mm.
const USUAL_MM: f64 = 100.0;

/// `element`: `points` of each pose, over `length` and `width`.
pub(super) fn read_element(
    section: &Section<'_>,
    campaign: &Campaign,
    instrument: usize,
) -> Option<Readings> {
    let own = &campaign.instruments[instrument];
    let Some(element) = own.kind.element() else {
        let message = "only points that lie on an element are spread over it".to_owned();
        section.error("unknown-instrument", message, "kind = \"points-on-circle\", …");
        section.entries();
        return None;
    };
    let placing = Placing::for_path(section, campaign, instrument)?;
    let count = read_count(section, "points", 8)?;
    let extent = ["length", "width"]
        .map(|key| section.quantity(key, Dimension::Length).unwrap_or(USUAL_MM).max(0.0));
    let random = section.get("count").is_some();
    let poses = read_poses(section, campaign, random, true)?;
    let wanted = if random { read_count(section, "count", 50)? } else { usize::MAX };
    let points = element.points_mm(count, own.direction, own.length_mm, extent);
    let mut stations = Readings::default();
    let (mut kept, mut left) = (0, 0);
    for rotary in &poses.commands {
        if kept == wanted {
            break;
        }
        let inside = |c: &Command| leaves_travel(&campaign.machine, c).is_none();
        let placed = points
            .iter()
            .map(|d| placing.place(placing.reference_point_mm + d, rotary).filter(inside));
        let placed: Option<Vec<Command>> = placed.collect();
        match placed {
            Some(commands) => {
                let row = |c| station(c, campaign, instrument, kept);
                commands.into_iter().for_each(|c| stations.push(row(c)));
                kept += 1;
            }
            None => left += 1,
        }
    }
    tell_left(section, left, kept, random);
    Some(stations)
}
