//! What is asked of a geometric test, and what is known of its instrument: `[test]` of the conditions.

use super::{Extent, LIMIT, UNCERTAINTY, extent, lengths, positive};
use trueaxis_input::{Dimension, Item, Section};

/// What is measured.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// Of a line.
    Straightness,
    /// Of a surface.
    Flatness,
    /// Of two axes, or of two lines.
    Squareness,
    /// Of an axis to a surface, or of two lines.
    Parallelism,
}

impl Kind {
    /// With their names in files.
    pub const ALL: [(Self, &'static str); 4] = [
        (Self::Straightness, "straightness"),
        (Self::Flatness, "flatness"),
        (Self::Squareness, "squareness"),
        (Self::Parallelism, "parallelism"),
    ];

    /// Its name in files.
    pub fn name(self) -> &'static str {
        Self::ALL[self as usize].1
    }
}

/// The line or plane that deviations are counted from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Reference {
    /// Of the smallest distance between two parallels that contain all.
    MinimumZone,
    /// Of least squares.
    LeastSquares,
    /// Through the ends of a line, through three points of a surface.
    Points,
}

impl Reference {
    /// With their names in files.
    pub const ALL: [(Self, &'static str); 4] = [
        (Self::MinimumZone, "minimum zone"),
        (Self::LeastSquares, "least squares"),
        (Self::Points, "end points"),
        (Self::Points, "three points"),
    ];
}

/// A geometric test.
#[derive(Debug, Clone, PartialEq)]
pub struct Geometry {
    /// What is measured.
    pub kind: Kind,
    /// The machine error that it is, such as `EYX` or `EC0Y`.
    pub error: Option<String>,
    /// What is allowed.
    pub tolerance: Option<Extent>,
    /// What the tolerance is compared about.
    pub reference: Reference,
    /// Distance of the feet of the level or of the mirror, mm.
    pub base_mm: Option<f64>,
    /// Standard uncertainty of one reading.
    pub reading_u: Option<Extent>,
    /// Standard uncertainty of the straightedge (over its length) or of the square.
    pub artefact_u: Option<Extent>,
    /// Whether the axis carries the workpiece: its error has the opposite sign.
    pub carries_workpiece: bool,
    /// Whether angles of all lines are counted from gravity, with one zero of the level.
    pub gravity: bool,
    /// The three points of a reference plane, mm.
    pub points_mm: Option<[[f64; 2]; 3]>,
}

fn word<T: Copy>(item: &Item<'_>, all: &[(T, &'static str)]) -> Option<T> {
    let text = item.text()?;
    let found = all.iter().find(|(_, name)| *name == text);
    if found.is_none() {
        let names: Vec<String> = all.iter().map(|(_, name)| format!("\"{name}\"")).collect();
        item.error("unknown-word", format!("`{text}` is not known here"), &names.join(", "));
    }
    found.map(|(value, _)| *value)
}

pub(super) fn read(section: &Section<'_>) -> Option<Geometry> {
    let hint = "\"straightness\", \"flatness\", \"squareness\" or \"parallelism\"";
    let kind = section.require("kind", hint).and_then(|item| word(&item, &Kind::ALL));
    let reference = section.get("reference").map(|item| word(&item, &Reference::ALL));
    let carries = section
        .get("axis_carries")
        .map(|item| word(&item, &[(false, "tool"), (true, "workpiece")]).unwrap_or_default());
    let angles = section
        .get("angles_from")
        .map(|item| word(&item, &[(false, "each line"), (true, "gravity")]).unwrap_or_default());
    let corner = |key: &str| section.get(key).and_then(|item| lengths::<2>(&item));
    let points = [corner("point_1"), corner("point_2"), corner("point_3")];
    Some(Geometry {
        error: section.text("error").map(str::to_owned),
        tolerance: section.get("tolerance").and_then(|item| extent(&item, LIMIT)),
        reference: reference.unwrap_or(Some(Reference::MinimumZone))?,
        base_mm: section.get("base").and_then(|item| positive(&item, Dimension::Length)),
        reading_u: section.get("reading_u").and_then(|item| extent(&item, UNCERTAINTY)),
        artefact_u: section.get("artefact_u").and_then(|item| extent(&item, UNCERTAINTY)),
        carries_workpiece: carries.unwrap_or_default(),
        gravity: angles.unwrap_or_default(),
        points_mm: match points {
            [Some(a), Some(b), Some(c)] => Some([a, b, c]),
            _ => None,
        },
        kind: kind?,
    })
}
