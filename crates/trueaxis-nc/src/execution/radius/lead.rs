//! Ways to a contour and away from it.

use trueaxis_contour::lead::{Begin, Lead};
use trueaxis_contour::radius::Link;

use super::{Behaviour, Entry, Phase, Waiting};
use crate::execution::{Core, mistakes};
use crate::moves::{Feed, Move, MoveKind, Position};

/// A way to the contour that a block asks for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Approach {
    pub lead: Lead,
    /// How the tool comes to the first of its places.
    pub kind: MoveKind,
    pub feed: Feed,
    /// Its word in the messages.
    pub name: &'static str,
}

impl Core<'_> {
    /// The next move leads to the contour in its own way, with a tool on a side (1: left), also with radius 0.
    pub fn approach_next(
        &mut self,
        approach: Approach,
        side: f64,
        behaviour: Behaviour,
        place: Position,
        at: usize,
    ) {
        if self.radius.is_none() {
            self.begin_radius(0.0, behaviour, place, at);
        }
        if let Some(active) = &mut self.radius {
            active.phase = Phase::Entering;
            active.approach = Some(approach);
            active.side = side;
        }
    }

    /// The contour ends here and the tool is free: where its centre is.
    pub fn leave_contour(&mut self) -> Option<Position> {
        self.end_corner("the radius compensation ends");
        self.end_contour();
        let active = self.radius.take()?;
        let mut place = active.place;
        active.put(&mut place, active.centre);
        Some(place)
    }

    /// The tool leaves the contour for a place of the machine: where its centre is, and with what it comes back,
    /// unless the compensation has ended.
    pub fn interrupt_contour(&mut self) -> Option<(Position, Option<(f64, Behaviour)>)> {
        let active = self.radius.as_ref()?;
        let back =
            (active.phase != Phase::Leaving).then_some((active.true_left_mm, active.behaviour));
        self.leave_contour().map(|place| (place, back))
    }

    /// Sends the way round the end of the contour, if the next move would cross it: KONT.
    pub(super) fn lead_out(&mut self, m: &Move) {
        let Some(active) = self.radius.as_ref().filter(|a| a.behaviour.entry == Entry::Round)
        else {
            return;
        };
        // Seen from its target the way out is a way in, with the contour reversed.
        let [x, y] = active.tangent();
        let (corner, centre) = (active.point(&active.place), active.centre);
        let begin = Begin { corner, centre, tangent: [-x, -y], side: -active.side };
        let place = active.place;
        let pieces = Lead::Round.pieces(active.point(&m.target), &begin);
        match pieces.as_deref() {
            Ok([Link::Line { to }, Link::Arc { center, ccw, .. }]) => {
                let back = Link::Arc { center: *center, to: *to, ccw: !ccw };
                self.go_round(&[back], place, m);
            }
            Ok(_) => {}
            Err(why) => self.hold_fault(mistakes::bad_approach("KONT", why, self.start)),
        }
    }

    /// Sends the entry to the contour.
    pub(super) fn lead_in(&mut self, waiting: Waiting, begin: &Begin) {
        let Some((approach, start)) = waiting.approach else {
            self.release_waiting(waiting, begin.centre, 0.0);
            return;
        };
        match approach.lead.pieces(start, begin) {
            Ok(links) => {
                let place = waiting.step.target;
                let mut lead = waiting.step;
                for (index, link) in links.iter().enumerate() {
                    (lead.kind, lead.feed) = match index {
                        0 => (approach.kind, approach.feed),
                        _ => (MoveKind::Linear, waiting.step.feed),
                    };
                    self.go_round(&[*link], place, &lead);
                }
                self.release_later(waiting.later, begin.centre);
            }
            Err(why) => {
                self.hold_fault(mistakes::bad_approach(approach.name, &why, self.start));
                self.release_waiting(waiting, begin.centre, 0.0);
            }
        }
    }
}
