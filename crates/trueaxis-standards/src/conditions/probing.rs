//! What is known of the ring, the sphere and the stylus of a probing test: `[probing]` of the conditions.

use super::{LIMIT, UNCERTAINTY, lengths, positive};
use trueaxis_input::plausible::Quantity;
use trueaxis_input::{Dimension, Item, MeasuredValue, Section};

/// A probing test.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ProbingTest {
    /// Diameter of the ring, mm, with its standard uncertainty.
    pub ring_mm: Option<MeasuredValue>,
    /// Diameter of the sphere, mm, with its standard uncertainty.
    pub sphere_mm: Option<MeasuredValue>,
    /// Diameter of the stylus ball, mm.
    pub stylus_mm: Option<f64>,
    /// Whether the points are contact points; else they are positions of the ball.
    pub is_corrected: bool,
    /// Where the centre of the ring is, mm.
    pub ring_centre_mm: Option<[f64; 2]>,
    /// Where the centre of the sphere is, mm.
    pub sphere_centre_mm: Option<[f64; 3]>,
    /// Standard uncertainty of the form of ring and sphere, mm.
    pub form_u_mm: Option<f64>,
    /// Standard uncertainty of one hit, mm.
    pub reading_u_mm: Option<f64>,
    /// Allowed range of repeated hits at one point, mm.
    pub allowed_point_mm: Option<f64>,
    /// Allowed range of the location after a change of the probe, mm.
    pub allowed_tool_mm: Option<f64>,
    /// Allowed form error of the ring, mm.
    pub allowed_2d_mm: Option<f64>,
    /// Allowed form error of the sphere, mm.
    pub allowed_3d_mm: Option<f64>,
}

pub(super) fn read(section: &Section<'_>) -> ProbingTest {
    let length = |key: &str| section.get(key).and_then(|item| positive(&item, Dimension::Length));
    let within = |key: &str, [quantity, _]: [Quantity; 2]| {
        let item = section.get(key)?;
        positive(&item, Dimension::Length).filter(|v| item.is_possible(quantity, *v))
    };
    let diameter = |key: &str| section.get(key).and_then(|item| item.measured(Dimension::Length));
    let points = |item: Item<'_>| match item.text()? {
        "ball" => Some(false),
        "contact" => Some(true),
        other => {
            let hint = "\"ball\" (positions of the ball) or \"contact\" (points of contact)";
            item.error("unknown-word", format!("`{other}` is not known here"), hint);
            None
        }
    };
    ProbingTest {
        ring_mm: diameter("ring_diameter"),
        sphere_mm: diameter("sphere_diameter"),
        stylus_mm: length("stylus_diameter"),
        is_corrected: section.get("points").and_then(points).unwrap_or_default(),
        ring_centre_mm: section.get("ring_centre").and_then(|item| lengths::<2>(&item)),
        sphere_centre_mm: section.get("sphere_centre").and_then(|item| lengths::<3>(&item)),
        form_u_mm: within("form_u", UNCERTAINTY),
        reading_u_mm: within("reading_u", UNCERTAINTY),
        allowed_point_mm: within("tolerance_point", LIMIT),
        allowed_tool_mm: within("tolerance_tool", LIMIT),
        allowed_2d_mm: within("tolerance_2d", LIMIT),
        allowed_3d_mm: within("tolerance_3d", LIMIT),
    }
}
