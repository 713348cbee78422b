//! What a campaign states of an element on which points lie.

use super::Kind;
use crate::instruments::Element;
use crate::instruments::instrument::SetupError;
use trueaxis_input::{Dimension, Section};

/// `radius = "30 mm"` of a round element, 0 of others, mm; a direction is needed of all but a sphere.
pub(super) fn read_radius(section: &Section<'_>, element: Element, is_directed: bool) -> f64 {
    if element != Element::Sphere && !is_directed {
        let message = "which way does the element lie, roughly?".to_owned();
        let hint = "direction = \"0 0 1\": the normal of a plane or circle, the axis of a line or cylinder";
        section.error("missing-key", message, hint);
    }
    if !element.is_round() {
        return 0.0;
    }
    let radius_mm = section.quantity("radius", Dimension::Length).unwrap_or(0.0);
    if radius_mm <= 0.0 {
        let message = "how large is the element, roughly?".to_owned();
        section.error("missing-key", message, "radius = \"30 mm\": to the point of the tool");
    }
    radius_mm
}

/// `shift` and `tilt` among the unknowns of an element: those that its points can see.
pub(super) fn element_unknowns(kind: Kind, key: &str) -> Option<Vec<SetupError>> {
    kind.element()?;
    let usual = kind.usual_unknowns().into_iter();
    let own: Vec<SetupError> = match key {
        "shift" => usual.filter(|e| matches!(e, SetupError::Shift(_))).collect(),
        "tilt" => usual.filter(|e| matches!(e, SetupError::Tilt(_))).collect(),
        _ => return None,
    };
    Some(own).filter(|own| !own.is_empty())
}
