//! Where a plane is not.

use super::positive;
use crate::part::Geometry;
use trueaxis_geometry::Vec3;
use trueaxis_input::{Item, Section};

/// Seen along the normal of the plane a circle or a rectangle.
pub(super) struct Opening {
    at_mm: Vec3,
    edges: [Vec3; 2],
    normal: Vec3,
    /// Half of the edges, or the radius twice.
    half_mm: [f64; 2],
    is_round: bool,
}

impl Opening {
    pub fn contains(&self, point: &Vec3) -> bool {
        let arm = point - self.at_mm;
        match self.is_round {
            true => (arm - self.normal * arm.dot(&self.normal)).norm() <= self.half_mm[0],
            false => (0..2).all(|k| arm.dot(&self.edges[k]).abs() <= self.half_mm[k]),
        }
    }
}

/// `openings = [{ at = "35 15 0 mm", diameter = "32 mm" }, { at = "-25 0 0 mm", size = "52 32 mm" }]`.
pub(super) fn read_openings(item: &Item<'_>, geometry: &Geometry) -> Option<Vec<Opening>> {
    let Geometry::Plane { normal, along, .. } = *geometry else {
        let message = "only a plane has `openings`".to_owned();
        item.error("wrong-feature", message, "divide the feature, or take a table of points");
        return None;
    };
    let read = |one: &Item<'_>| one.section("openings", |s| opening(s, normal, along)).flatten();
    let all: Vec<Option<Opening>> = item.list()?.iter().map(read).collect();
    all.into_iter().collect()
}

fn opening(section: &Section<'_>, normal: Vec3, along: Vec3) -> Option<Opening> {
    let at = section.require("at", "its middle: at = \"35 15 0 mm\"").and_then(|i| i.lengths());
    let diameter = section.get("diameter").map(|i| positive(&i, "diameter"));
    let size = section.get("size").map(|i| i.lengths::<2>());
    let (half_mm, is_round) = match (diameter, size) {
        (Some(diameter), None) => ([0.5 * diameter?; 2], true),
        (None, Some(size)) => (size?.map(|s| 0.5 * s), false),
        _ => {
            let message = "an opening has a diameter or a size".to_owned();
            section.error("one-shape", message, "diameter = \"32 mm\" or size = \"52 32 mm\"");
            return None;
        }
    };
    let edges = [along, normal.cross(&along)];
    Some(Opening { at_mm: Vec3::from(at?), edges, normal, half_mm, is_round })
}
