//! RL, RR and R0: the path of the centre of the tool.
//!
//! # Source
//! HEIDENHAIN iTNC 530 user's manual, "Tool radius compensation": transitional arcs at outside corners, the
//! intersection of the two paths at inside ones, entry and exit perpendicular to the contour.

use super::Run;
use super::words::Words;
use crate::execution::radius::{Approach, Behaviour};
use crate::moves::CompensationSide;

const HEIDENHAIN: Behaviour = Behaviour::USUAL;

impl Run<'_> {
    /// DEP ends the compensation by itself.
    pub(super) fn end_compensation(&mut self) {
        self.change_side(CompensationSide::Off, 0);
    }

    /// The next move leads to the contour in its own way. With R0 it does so as with RR and the radius 0.
    pub(super) fn approach_next(&mut self, approach: Approach, at: usize) {
        let side = if self.modes.side == CompensationSide::Left { 1.0 } else { -1.0 };
        let place = self.frames.position;
        self.core.approach_next(approach, side, HEIDENHAIN, place, at);
    }

    pub(super) fn compensation(&mut self, words: &Words) {
        if let Some(side) = words.side {
            self.change_side(side, words.at);
        }
    }

    fn change_side(&mut self, side: CompensationSide, at: usize) {
        if side == self.modes.side {
            return;
        }
        self.modes.side = side;
        let radius = self.modes.tool_radius_mm;
        if side != CompensationSide::Off && radius.is_none() {
            let tool = self.core.modes.tool;
            self.core.unknown_radius(format_args!("of tool {tool}"), at);
        }
        let place = self.frames.position;
        self.core.compensate(side, radius, HEIDENHAIN, place, at);
    }
}
