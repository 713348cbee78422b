//! G41, G42 and G40 with NORM and KONT, G450 and G451.
//!
//! # Source
//! SINUMERIK 840D sl programming manual "Fundamentals", "Tool radius compensation"; function manual W1 for
//! the largest angle of an intersection (MD20210, 100°).

use trueaxis_contour::radius::{Outside, Rules};

use super::Run;
use crate::execution::radius::{Behaviour, Entry};
use crate::moves::CompensationSide;

const AS_SWITCHED_ON: Behaviour = Behaviour {
    rules: Rules { outside: Outside::Arc, smooth_rad: 0.0 },
    entry: Entry::Perpendicular,
    enters_on_arcs: false,
    ends_at_once: false,
    radius_at_end: false,
    feed_on_contour: true,
};

impl Run<'_> {
    pub(super) fn compensation(&mut self, side: CompensationSide, at: usize) {
        let (tool, edge) = (self.core.modes.tool, self.modes.edge);
        let mut radius = Some(0.0);
        if side != CompensationSide::Off && edge > 0 {
            radius = self.core.radii.get(&tool).copied();
            if radius.is_none() {
                self.core.unknown_radius(format_args!("of tool {tool}"), at);
            }
        }
        let place = self.chain.position;
        self.core.compensate(side, radius, AS_SWITCHED_ON, place, at);
    }
}
