//! Placements in the machine file: `"0 -1500 300 mm"`, `["shift …", "turn Y 10 deg"]`.

use crate::chain::Link;
use trueaxis_geometry::Vec3;
use trueaxis_geometry::frame::{Pose, rotation};
use trueaxis_input::plausible::Quantity;
use trueaxis_input::{Dimension, Item, parse_quantity};

const HINT: &str = "write \"x y z mm\", \"shift x y z mm\" or \"turn Z 15 deg\", or a list of \
    these, applied from left to right";

/// A pose from one step or a list of steps, applied from left to right in the moved frame.
pub fn read_pose(item: &Item<'_>) -> Option<Link> {
    let steps = if item.is_list() { item.list()? } else { vec![*item] };
    // All steps are read before giving up, so that every fault among them is reported.
    let poses: Vec<_> = steps.iter().map(read_step).collect();
    poses.into_iter().try_fold(Link::identity(), |acc, step| Some(acc * step?))
}

/// Three lengths with one unit: `"0 0 -100 mm"`.
pub fn read_vector_mm(item: &Item<'_>) -> Option<Vec3> {
    item.lengths().map(Vec3::from)
}

/// The tip of a tool, as far from the gauge line as a tool is long.
pub fn read_tip(item: &Item<'_>) -> Option<Vec3> {
    read_vector_mm(item).filter(|v| item.is_possible(Quantity::ToolLength, v.norm()))
}

/// A direction of any length: `"0 1 1"`; returned as a unit vector.
pub fn read_direction(item: &Item<'_>) -> Option<Vec3> {
    item.direction().map(Vec3::from)
}

fn read_step(item: &Item<'_>) -> Option<Link> {
    let words: Vec<&str> = item.text()?.split_whitespace().collect();
    match words[..] {
        ["turn", about, ..] => {
            let direction = match about {
                "X" => Vec3::x(),
                "Y" => Vec3::y(),
                "Z" => Vec3::z(),
                _ => return refuse(item, format!("`{about}` is not a direction to turn about")),
            };
            match parse_quantity(&words[2..].join(" "), Dimension::Angle) {
                Ok(angle) => Some(Pose::new(rotation(direction, angle), Vec3::zeros())),
                Err(e) => {
                    item.error(e.code(), e.to_string(), &e.hint());
                    None
                }
            }
        }
        ["shift", ..] => vector(item, &words[1..]).map(Pose::shift),
        _ => vector(item, &words).map(Pose::shift),
    }
}

fn vector(item: &Item<'_>, words: &[&str]) -> Option<Vec3> {
    item.lengths_of(words, HINT).map(Vec3::from)
}

fn refuse<T>(item: &Item<'_>, message: String) -> Option<T> {
    item.error("bad-place", message, HINT);
    None
}
