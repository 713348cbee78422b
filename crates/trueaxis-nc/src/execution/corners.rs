//! Roundings and chamfers: a move that has a corner at its end waits for the next one.

use trueaxis_contour::Element;
use trueaxis_contour::corner::{CornerError, Shape, Transition, transition};

use super::Core;
use super::radius::element::element;
use crate::moves::{
    Arc, Axis, Coordinates, Event, Feed, FeedMode, Move, MoveKind, Origin, Plane, Position, Step,
};

/// A rounding or chamfer at the end of a move.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Corner {
    pub shape: Shape,
    /// The feed of its own; else that of the move.
    pub feed: Option<Feed>,
    /// Its word in the messages.
    pub name: &'static str,
    /// It is for all corners: where none is possible, none is missing.
    pub modal: bool,
    /// Where it is written.
    pub at: usize,
}

/// A move that waits for the one after its corner.
struct Held {
    start: Position,
    step: Move,
    plane: Plane,
    /// Written already; HEIDENHAIN writes it in the block that follows.
    corner: Option<Corner>,
    /// What happened since.
    later: Vec<Step>,
}

/// The corner between two moves.
#[derive(Default)]
pub(super) struct Corners {
    /// The next move is to be held, from this start.
    next: Option<(Position, Option<Corner>)>,
    held: Option<Box<Held>>,
}

impl Corners {
    #[inline]
    pub fn are_off(&self) -> bool {
        self.next.is_none() && self.held.is_none()
    }

    pub fn is_waiting(&self) -> bool {
        self.held.is_some()
    }
}

impl Core<'_> {
    /// The next move begins here and has a corner at its end, which may still be to be read.
    pub fn corner_after_next(&mut self, start: Position, corner: Option<Corner>) {
        self.corners.next = Some((start, corner));
    }

    /// The corner at the end of the move before; `false` if none waits for one.
    pub fn corner_here(&mut self, corner: Corner) -> bool {
        match self.corners.held.as_mut().filter(|h| h.corner.is_none()) {
            Some(held) => {
                held.corner = Some(corner);
                true
            }
            None => false,
        }
    }

    /// No move came for the corner that was announced.
    pub fn forget_corner(&mut self) {
        if let Some((_, Some(corner))) = self.corners.next.take() {
            self.sharp_corner(corner, "its block has no move in the plane");
        }
    }

    /// A step while a corner is announced or waits.
    pub(super) fn step_at_corner(&mut self, step: Step) {
        let Step::Move(m) = step else {
            if matches!(&step, Step::Event(event, _) if changes_frame(event)) {
                self.end_corner("a change of the frame or tool comes between its two elements");
            }
            match &mut self.corners.held {
                Some(held) => held.later.push(step),
                None => self.send(step),
            }
            return;
        };
        if matches!(m.kind, MoveKind::Dwell { .. }) && self.corners.held.is_some() {
            if let Some(held) = &mut self.corners.held {
                held.later.push(step);
            }
            return;
        }
        let (start, m) = self.pass_corner(m);
        match self.corners.next.take() {
            Some((from, corner)) if is_element(&m) => {
                let (start, plane) = (start.unwrap_or(from), self.modes.plane);
                let held = Held { start, step: m, plane, corner, later: Vec::new() };
                self.corners.held = Some(Box::new(held));
            }
            Some((_, corner)) => {
                self.send(Step::Move(m));
                if let Some(corner) = corner {
                    self.sharp_corner(corner, "only lines with feed and arcs can have one");
                }
            }
            None => self.send(Step::Move(m)),
        }
    }

    /// Sends the held move and its corner; the place where the next move begins now.
    fn pass_corner(&mut self, next: Move) -> (Option<Position>, Move) {
        let Some(held) = self.corners.held.take() else { return (None, next) };
        let Some(corner) = held.corner else {
            self.release(*held);
            return (None, next);
        };
        let unfit = |why| corner.modal && why != CornerError::TooLarge;
        match cut(&held, &next, corner) {
            Err(Unfit::Shape(why)) if !unfit(why) => {
                self.release(*held);
                self.sharp_corner(Corner { modal: false, ..corner }, &why.to_string());
                (None, next)
            }
            Ok(Some((first, own, begins, next))) => {
                self.send(Step::Move(first));
                self.send(Step::Move(own));
                held.later.into_iter().for_each(|s| self.send(s));
                (Some(begins), next)
            }
            Ok(None) => {
                self.release(*held);
                (None, next)
            }
            Err(_) => {
                self.release(*held);
                let why = "it needs a line with feed or an arc of the plane on both sides";
                self.sharp_corner(corner, why);
                (None, next)
            }
        }
    }

    fn release(&mut self, held: Held) {
        self.send(Step::Move(held.step));
        held.later.into_iter().for_each(|s| self.send(s));
    }

    /// Sends a move that waits for a corner as it is.
    pub fn end_corner(&mut self, why: &str) {
        let Some(held) = self.corners.held.take() else { return };
        let corner = held.corner;
        self.release(*held);
        if let Some(corner) = corner {
            self.sharp_corner(corner, why);
        }
    }

    fn sharp_corner(&mut self, corner: Corner, why: &str) {
        if corner.modal {
            return;
        }
        let name = corner.name;
        let message = format!("{name} is not applied: {why}");
        let subject = format!("{name} {}", self.origin.line);
        let hint = "the path keeps the sharp corner; check the size and the two elements";
        self.warn("not-applied", subject, corner.at, message, hint);
    }
}

/// Whether the coordinates before and after an event are not those of one contour.
fn changes_frame(event: &Event) -> bool {
    matches!(
        event,
        Event::Frame(_)
            | Event::Plane(_)
            | Event::ToolLength(_)
            | Event::ToolChange(_)
            | Event::ToolCentre(_)
            | Event::TiltedPlane(_)
            | Event::DynamicOffset(_)
            | Event::Stop { .. }
            | Event::End
    )
}

fn is_element(m: &Move) -> bool {
    matches!(m.kind, MoveKind::Linear | MoveKind::Arc(_))
        && m.coordinates == Coordinates::Program
        && m.direction.is_none()
        && m.feed.mode != FeedMode::InverseTime
}

/// Why there is no corner.
enum Unfit {
    /// Its neighbours are no elements of a contour in the plane.
    Elements,
    Shape(CornerError),
}

/// What remains of the first move, the corner, where the second one begins, and the second one.
type Cut = (Move, Move, Position, Move);

/// The two moves with the corner between them; `None` where they continue each other smoothly.
fn cut(held: &Held, next: &Move, corner: Corner) -> Result<Option<Cut>, Unfit> {
    let plane = held.plane;
    let first = element(plane, &held.start, &held.step).filter(|_| is_element(next));
    let second = element(plane, &held.step.target, next);
    let Some((first, second)) = first.zip(second) else {
        return Err(Unfit::Elements);
    };
    let found = transition(&first, &second, corner.shape);
    let Some(found) = found.map_err(Unfit::Shape)? else { return Ok(None) };
    let along = |from: &Position, to: &Position, part: f64, at: [f64; 2]| {
        let mut p = Position(std::array::from_fn(|i| from.0[i] + part * (to.0[i] - from.0[i])));
        let [a, b, _] = plane.axes();
        (p[a], p[b]) = (at[0], at[1]);
        p
    };
    let leaves = along(&held.start, &held.step.target, found.first_ends, found.from);
    let begins = along(&held.step.target, &next.target, found.second_begins, found.to);
    let mut before = Move { target: leaves, ..held.step };
    let mut after = *next;
    shorten(&mut before, &first, found.first_ends);
    shorten(&mut after, &second, 1.0 - found.second_begins);
    Ok(Some((before, inserted(held, &corner, &found, begins), begins, after)))
}

fn inserted(held: &Held, corner: &Corner, found: &Transition, target: Position) -> Move {
    let [a, b, _] = held.plane.axes();
    let kind = match found.arc {
        Some((center_mm, ccw)) => {
            MoveKind::Arc(Arc { plane: held.plane, center_mm, turns: 1, ccw })
        }
        None => MoveKind::Linear,
    };
    let mut named = held.step.named.with(a).with(b);
    for axis in Axis::ALL {
        if target[axis] != held.step.target[axis] {
            named = named.with(axis);
        }
    }
    let feed = corner.feed.unwrap_or(held.step.feed);
    let origin: Origin = held.step.origin;
    Move { kind, target, named, feed, origin, ..held.step }
}

/// The turns begun of an arc of which a part remains.
pub(super) fn shorten(m: &mut Move, whole: &Element, part: f64) {
    if let (MoveKind::Arc(arc), Element::Arc { sweep_rad, .. }) = (&mut m.kind, whole) {
        let turns = (sweep_rad.abs() * part / std::f64::consts::TAU - 1e-9).ceil();
        arc.turns = (turns as u32).max(1);
    }
}

/// The shape of a chamfer or rounding must have a size.
pub(crate) fn is_size(size_mm: f64) -> bool {
    size_mm > 0.0 && size_mm < 1e6
}
