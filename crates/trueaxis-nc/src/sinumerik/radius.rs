//! G41, G42 and G40 with NORM and KONT, G450 and G451.
//!
//! # Source
//! SINUMERIK 840D sl programming manual "Fundamentals", "Tool radius compensation"; function manual W1 for
//! the largest angle of an intersection (MD20210, 100°).

use trueaxis_contour::radius::Outside;

use super::Run;
use super::tables::ContourRule;
use crate::execution::radius::{Behaviour, Entry, FeedAt};
use crate::moves::CompensationSide;

/// G450, NORM; the feed is that of the centre of the tool (CFTCP).
pub(super) const AS_SWITCHED_ON: Behaviour = Behaviour::USUAL;

impl Run<'_> {
    pub(super) fn compensation(&mut self, side: CompensationSide, at: usize) {
        self.modes.side = side;
        let (tool, edge) = (self.core.modes.tool, self.modes.edge);
        let mut radius = Some(0.0);
        if side != CompensationSide::Off && edge > 0 {
            radius = self.radius_of(tool, at);
        }
        let (place, behaviour) = (self.chain.position, self.modes.behaviour);
        self.core.compensate(side, radius, behaviour, place, at);
    }

    /// The radius of a tool, mm; `None`, with a warning, if it is not stated anywhere.
    pub(super) fn radius_of(&mut self, tool: u32, at: usize) -> Option<f64> {
        let radius = self.core.radii.get(&tool).copied();
        if radius.is_none() {
            self.core.unknown_radius(format_args!("of tool {tool}"), at);
        }
        radius
    }

    /// T or D while the compensation is on: from the next block on the radius is another one.
    pub(super) fn other_radius(&mut self, at: usize) {
        if self.modes.side != CompensationSide::Off {
            self.compensation(self.modes.side, at);
        }
    }

    /// G450, G451, NORM, KONT, CFTCP, CFC and CFIN.
    pub(super) fn contour_rule(&mut self, rule: ContourRule, at: usize) {
        if rule == ContourRule::KontSmooth {
            let hint =
                "the places of the contour are right; the way to it and from it is that of KONT";
            self.core.not_applied("the polynomial of KONTC and KONTT (KONT is used)", at, hint);
        }
        let behaviour = &mut self.modes.behaviour;
        match rule {
            ContourRule::OutsideOnArc => behaviour.rules.outside = Outside::Arc,
            ContourRule::OutsideToMeeting => behaviour.rules.outside = Outside::Meeting,
            ContourRule::Norm => behaviour.entry = Entry::Perpendicular,
            ContourRule::Kont | ContourRule::KontSmooth => behaviour.entry = Entry::Round,
            ContourRule::FeedAtCentre => behaviour.feed_at = FeedAt::Centre,
            ContourRule::FeedOnContour => behaviour.feed_at = FeedAt::Contour,
            ContourRule::FeedOnInside => behaviour.feed_at = FeedAt::Inside,
        }
        self.core.follow_by(self.modes.behaviour);
    }
}
