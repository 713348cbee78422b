//! Cutter radius compensation: the moves of a program become those of the centre of the tool.
//!
//! A move along the contour waits for the next one, because its end depends on the corner. What comes in
//! between without motion in the plane happens at the end of the first of the two. Where the program
//! changes its frame, its tool or its side, the tool stops perpendicular to the end of the contour.

mod behaviour;
pub(super) mod element;
mod lead;

use trueaxis_contour::Element;
use trueaxis_contour::lead::{Begin, Lead};
use trueaxis_contour::plane::{Point, along, length, minus};
use trueaxis_contour::radius::{Link, centre, check_fit, passage};

pub(crate) use behaviour::{Behaviour, Entry, FeedAt};
pub(crate) use lead::Approach;

use element::{element, entry_arc, feed_of_centre, scale_of};

use super::corners::shorten;
use super::language::changes_place;
use super::{Core, KnownPosition, mistakes};
use crate::moves::{
    Arc, Coordinates, Event, FeedMode, Frame, Move, MoveKind, Origin, Plane, Position, Step,
};

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Phase {
    /// The next move in the plane leads to the contour.
    Entering,
    /// On the contour.
    On,
    /// On the contour, but the next element begins where the centre is: the radius has changed.
    Aslant,
    /// On the contour, but the next element has the tool on the other side.
    Across,
    /// The next move in the plane leads away.
    Leaving,
}

/// A move that waits for the next one.
struct Waiting {
    /// It leads to the contour in this way, from this place of the centre.
    approach: Option<(Approach, Point)>,
    step: Move,
    /// Its element of the contour; none for an entry that ends perpendicular to the next one.
    element: Option<Element>,
    /// How much of it there is; more than 1 where it begins before its element.
    part: f64,
    /// It is the entry: any length of it may be cut off.
    is_entry: bool,
    /// Where the centre is after it if no corner follows.
    end: Point,
    /// What happened since.
    later: Vec<Step>,
}

pub(super) struct Active {
    behaviour: Behaviour,
    phase: Phase,
    plane: Plane,
    /// The distance of the centre to the left of the contour, mm on the workpiece.
    true_left_mm: f64,
    /// The same in the program frame, which may be scaled.
    left_mm: f64,
    /// 1 if the tool is to the left, -1 if it is to the right.
    side: f64,
    /// The way of the next move.
    approach: Option<Approach>,
    /// The end of the contour so far.
    place: Position,
    /// Where the centre is there.
    centre: Point,
    waiting: Option<Waiting>,
    /// From the contour to the centre in the basic frame, while the place in the program frame is unread.
    vector: Option<[f64; 3]>,
}

impl Active {
    fn point(&self, p: &Position) -> Point {
        let [a, b, _] = self.plane.axes();
        [p[a], p[b]]
    }

    fn put(&self, p: &mut Position, at: Point) {
        let [a, b, _] = self.plane.axes();
        (p[a], p[b]) = (at[0], at[1]);
    }

    /// The direction in which the contour has come: the offset is perpendicular to it. Unit: 1.
    fn tangent(&self) -> Point {
        let [x, y] = minus(self.centre, self.point(&self.place));
        [y / self.left_mm, -x / self.left_mm]
    }

    /// From the contour to the centre, in the program frame.
    fn offset(&self) -> [f64; 3] {
        let (mut vector, here) = (Position::default(), self.point(&self.place));
        self.put(&mut vector, minus(self.centre, here));
        [vector.0[0], vector.0[1], vector.0[2]]
    }
}

impl Core<'_> {
    /// The compensation begins, or changes its side or radius: from here the centre of a tool runs to the
    /// left (negative: to the right) of the contour.
    pub fn begin_radius(
        &mut self,
        true_left_mm: f64,
        behaviour: Behaviour,
        place: Position,
        at: usize,
    ) {
        if let Some(active) = &mut self.radius
            && active.true_left_mm == true_left_mm
            && active.phase != Phase::Leaving
        {
            active.behaviour = behaviour;
            return;
        }
        self.end_corner("the radius compensation begins");
        self.end_contour();
        let plane = self.modes.plane;
        let Some(scale) = scale_of(&self.reported_frame, plane) else {
            self.hold_fault(mistakes::unequal_scales(at));
            return;
        };
        let left_mm = true_left_mm / scale;
        if let Some(active) = &mut self.radius {
            if active.phase == Phase::Leaving && active.behaviour.ends_at_once {
                // The control counts from the end of the contour as if the centre were there.
                active.centre = active.point(&active.place);
            }
            active.phase = match active.phase {
                Phase::Entering | Phase::Leaving => Phase::Entering,
                _ if active.left_mm * left_mm > 0.0 => Phase::Aslant,
                _ => Phase::Across,
            };
            (active.true_left_mm, active.left_mm) = (true_left_mm, left_mm);
            active.side = true_left_mm.signum();
            active.behaviour = behaviour;
            return;
        }
        let [a, b, _] = plane.axes();
        self.radius = Some(Box::new(Active {
            behaviour,
            phase: Phase::Entering,
            plane,
            true_left_mm,
            left_mm,
            side: true_left_mm.signum(),
            approach: None,
            place,
            centre: [place[a], place[b]],
            waiting: None,
            vector: None,
        }));
    }

    /// The compensation ends with the next move in the plane, or at once.
    pub fn end_radius(&mut self) {
        self.end_corner("the radius compensation ends");
        self.end_contour();
        match &mut self.radius {
            Some(active) if active.phase != Phase::Entering => active.phase = Phase::Leaving,
            _ => self.radius = None,
        }
    }

    /// The contour is followed in another way from here on.
    pub fn follow_by(&mut self, behaviour: Behaviour) {
        if let Some(active) = &mut self.radius {
            active.behaviour = behaviour;
        }
    }

    /// Whether the centre of the tool runs along a contour.
    pub fn has_radius(&self) -> bool {
        self.radius.is_some()
    }

    /// Sends the move that waits for a corner to the place perpendicular to its end.
    pub(super) fn end_contour(&mut self) {
        let Some(active) = &mut self.radius else { return };
        let Some(waiting) = active.waiting.take() else { return };
        active.centre = waiting.end;
        let end = waiting.end;
        self.release_waiting(waiting, end, 0.0);
    }

    /// The program is about to count from another place: the tool stops at the contour.
    pub(super) fn stop_on_contour(&mut self) {
        self.end_contour();
        let frame = self.reported_frame;
        if let Some(active) = &mut self.radius {
            let offset = active.offset();
            active.vector.get_or_insert_with(|| frame.vector(offset));
        }
    }

    /// A step while the compensation is on.
    pub(super) fn step_on_contour(&mut self, step: Step) {
        match step {
            Step::Move(m) => self.move_on_contour(m),
            Step::Event(event, origin) => self.event_on_contour(event, origin),
        }
    }

    fn event_on_contour(&mut self, event: Event, origin: Origin) {
        if changes_place(&event) || event == Event::End {
            self.stop_on_contour();
        }
        let Some(active) = &mut self.radius else { return };
        if let Event::Plane(plane) = event
            && plane != active.plane
        {
            match active.phase {
                Phase::On | Phase::Aslant | Phase::Across => {
                    self.hold_fault(mistakes::plane_on_contour(self.start));
                }
                Phase::Entering => {
                    active.plane = plane;
                    active.centre = active.point(&active.place);
                    self.follower.take(Step::Event(event, origin));
                }
                Phase::Leaving => {
                    self.radius = None;
                    self.follower.take(Step::Event(event, origin));
                }
            }
            return;
        }
        let step = Step::Event(event, origin);
        match &mut active.waiting {
            Some(waiting) => waiting.later.push(step),
            None => self.follower.take(step),
        }
    }

    fn move_on_contour(&mut self, m: Move) {
        let Some(active) = &mut self.radius else { return };
        if m.coordinates == Coordinates::Machine || matches!(m.kind, MoveKind::Align { .. }) {
            self.end_contour();
            match &mut self.radius {
                Some(active) if active.phase != Phase::Leaving => active.phase = Phase::Entering,
                _ => self.radius = None,
            }
            self.follower.take(Step::Move(m));
            return;
        }
        let arc = matches!(m.kind, MoveKind::Arc(_) | MoveKind::SpatialArc(_));
        let still = active.point(&m.target) == active.point(&active.place) && !arc;
        let at_once = active.phase == Phase::Leaving && active.behaviour.ends_at_once;
        if matches!(m.kind, MoveKind::Dwell { .. }) || still && !at_once {
            self.move_across(m);
            return;
        }
        match active.phase {
            Phase::Entering => self.enter(m),
            Phase::On | Phase::Aslant | Phase::Across => self.follow_contour(m),
            Phase::Leaving => {
                if arc {
                    self.hold_fault(mistakes::arc_after_contour(self.start));
                }
                self.lead_out(&m);
                self.radius = None;
                self.follower.take(Step::Move(m));
            }
        }
    }

    /// A move without motion in the plane: the centre stays where it is there.
    fn move_across(&mut self, mut m: Move) {
        let Some(active) = &mut self.radius else { return };
        active.place = m.target;
        match &mut active.waiting {
            Some(waiting) => waiting.later.push(Step::Move(m)),
            None => {
                active.put(&mut m.target, active.centre);
                self.follower.take(Step::Move(m));
            }
        }
    }

    fn enter(&mut self, m: Move) {
        let at = self.start;
        let Some(active) = &mut self.radius else { return };
        let (from, to) = (active.centre, active.point(&m.target));
        let arc = matches!(m.kind, MoveKind::Arc(_) | MoveKind::SpatialArc(_));
        if arc && !active.behaviour.enters_on_arcs {
            self.hold_fault(mistakes::arc_before_contour(at));
            return;
        }
        let radius = active.left_mm.abs();
        if active.behaviour.entry == Entry::Element && length(minus(to, from)) <= radius {
            self.hold_fault(mistakes::short_entry(length(minus(to, from)), radius, at));
            return;
        }
        let (element, mut step) = match m.kind {
            MoveKind::Arc(arc) => match entry_arc(from, to, &arc, active.left_mm) {
                Some((element, center_mm)) => {
                    let turned = MoveKind::Arc(Arc { center_mm, ..arc });
                    (element, Move { kind: turned, ..m })
                }
                None => {
                    self.hold_fault(mistakes::entry_arc_aside(at));
                    return;
                }
            },
            _ => (Element::line(from, to), m),
        };
        let across = (active.place, active.plane.axes()[2]);
        step.feed = feed_of_centre(&element, &m, across, 0.0, active.behaviour);
        let end = centre(&element, 1.0, active.left_mm);
        let round = Approach { lead: Lead::Round, kind: step.kind, feed: step.feed, name: "KONT" };
        let approach = match active.behaviour.entry {
            Entry::Round => Some(active.approach.take().unwrap_or(round)),
            _ => active.approach.take(),
        };
        let is_element = active.behaviour.entry == Entry::Element && approach.is_none();
        let element = is_element.then_some(element);
        let approach = approach.map(|approach| (approach, from));
        let (part, is_entry, later) = (1.0, true, Vec::new());
        let waiting = Waiting { approach, step, element, part, is_entry, end, later };
        active.place = m.target;
        active.centre = end;
        active.phase = Phase::On;
        active.waiting = Some(waiting);
    }

    fn follow_contour(&mut self, m: Move) {
        let Some(active) = &mut self.radius else { return };
        let (left_mm, corner) = (active.left_mm, active.place);
        let Some(mut element) = element(active.plane, &corner, &m) else {
            self.hold_fault(mistakes::no_contour_element(self.start));
            return;
        };
        if active.behaviour.radius_at_end {
            element = element.through(active.point(&m.target));
        }
        if let Err(gouge) = check_fit(&element, left_mm) {
            self.hold_fault(mistakes::gouge(gouge, left_mm.abs(), None, self.start));
            return;
        }
        let begin = centre(&element, 0.0, left_mm);
        let mut step = m;
        let across = active.plane.axes()[2];
        step.feed = feed_of_centre(&element, &m, (corner, across), left_mm, active.behaviour);
        let mut m = m;
        if m.feed.mode == FeedMode::InverseTime {
            m.feed = step.feed;
        }
        let mut part = 1.0;
        if let Some(waiting) = active.waiting.take() {
            part -= self.pass_on(waiting, &element, begin, &m);
        } else {
            part -= self.go_on(&element, begin, &m);
        }
        let Some(active) = &mut self.radius else { return };
        let end = centre(&element.through(active.point(&m.target)), 1.0, left_mm);
        (active.place, active.centre) = (m.target, end);
        if left_mm == 0.0 {
            // It was the approach of a tool without radius.
            self.radius = None;
            self.follower.take(Step::Move(m));
            return;
        }
        let (element, approach, is_entry, later) = (Some(element), None, false, Vec::new());
        active.waiting = Some(Waiting { approach, step, element, part, is_entry, end, later });
    }

    /// Sends the move that waited, and the way to the next element; the part of that one that is cut off.
    fn pass_on(&mut self, waiting: Waiting, next: &Element, begin: Point, m: &Move) -> f64 {
        let Some(active) = &self.radius else { return 0.0 };
        let (left_mm, corner, rules) = (active.left_mm, active.place, active.behaviour.rules);
        let Some(first) = &waiting.element else {
            let tangent = next.tangent(0.0);
            let (corner, side) = (active.point(&corner), active.side);
            self.lead_in(waiting, &Begin { corner, centre: begin, tangent, side });
            return 0.0;
        };
        // What lies before its element is no room for a corner at its end.
        let room = if waiting.is_entry { f64::INFINITY } else { waiting.part.min(1.0) };
        match passage(first, next, active.point(&corner), left_mm, room, rules) {
            Ok(p) => {
                self.release_waiting(waiting, p.end, p.first_cut);
                self.go_round(&p.links, corner, m);
                p.second_cut
            }
            Err(gouge) => {
                let line = waiting.step.origin.line;
                let end = waiting.end;
                self.release_waiting(waiting, end, 0.0);
                self.hold_fault(mistakes::gouge(gouge, left_mm.abs(), Some(line), self.start));
                0.0
            }
        }
    }

    /// Sends the way from the perpendicular end of the contour, where it was interrupted, to the next element;
    /// the part of that one that is cut off.
    fn go_on(&mut self, next: &Element, begin: Point, m: &Move) -> f64 {
        let Some(active) = &mut self.radius else { return 0.0 };
        let (place, centre, left_mm) = (active.place, active.centre, active.left_mm);
        let straight = [Link::Line { to: begin }];
        match std::mem::replace(&mut active.phase, Phase::On) {
            Phase::Aslant => return 0.0,
            Phase::Across => {
                self.go_round(&straight, place, m);
                return 0.0;
            }
            _ => {}
        }
        let corner = active.point(&place);
        let before = Element::line(along(corner, active.tangent(), -left_mm.abs()), corner);
        match passage(&before, next, corner, left_mm, 0.0, active.behaviour.rules) {
            Ok(found) => {
                if length(minus(found.end, centre)) > 1e-9 {
                    self.go_round(&[Link::Line { to: found.end }], place, m);
                }
                self.go_round(&found.links, place, m);
                found.second_cut
            }
            Err(_) => {
                self.interrupted_inside();
                self.go_round(&straight, place, m);
                0.0
            }
        }
    }

    /// Sends a move that waited, with the end of its path of the centre, and what came after it.
    fn release_waiting(&mut self, waiting: Waiting, end: Point, cut: f64) {
        let Some(active) = &self.radius else { return };
        let [a, b, _] = active.plane.axes();
        let mut step = waiting.step;
        active.put(&mut step.target, end);
        step.named = step.named.with(a).with(b);
        if let Some(element) = &waiting.element {
            shorten(&mut step, element, waiting.part - cut);
        }
        self.follower.take(Step::Move(step));
        self.release_later(waiting.later, end);
    }

    /// What came without motion in the plane, where the centre is.
    fn release_later(&mut self, steps: Vec<Step>, end: Point) {
        let Some(active) = &self.radius else { return };
        for mut later in steps {
            if let Step::Move(m) = &mut later {
                active.put(&mut m.target, end);
            }
            self.follower.take(later);
        }
    }

    /// Sends the pieces between two elements; they belong to the second one.
    fn go_round(&mut self, links: &[Link], corner: Position, next: &Move) {
        let Some(active) = &self.radius else { return };
        let [a, b, _] = active.plane.axes();
        let named = next.named.with(a).with(b);
        for link in links {
            let (kind, to) = match *link {
                Link::Line { to } => (MoveKind::Linear, to),
                Link::Arc { center, to, ccw } => {
                    let plane = active.plane;
                    (MoveKind::Arc(Arc { plane, center_mm: center, turns: 1, ccw }), to)
                }
            };
            let mut target = corner;
            active.put(&mut target, to);
            // There is no arc in rapid traverse.
            let kind = if next.kind == MoveKind::Rapid { MoveKind::Rapid } else { kind };
            let step = Move::plain(kind, target, named, next.feed, next.origin);
            self.follower.take(Step::Move(step));
        }
    }

    /// From the contour to the centre in the present program frame.
    fn vector_now(&self) -> Position {
        let turned = Frame { shift: Position::default(), ..self.reported_frame };
        let known = self.radius.as_ref().filter(|a| a.phase != Phase::Entering);
        let [x, y, z] = known.and_then(|a| a.vector).unwrap_or_default();
        let vector = Position([x, y, z, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
        turned.inverse_place(&vector).unwrap_or_default()
    }

    /// The place on the contour where a machine says where the centre is.
    pub(super) fn contour_place(&self, mut known: KnownPosition) -> KnownPosition {
        if self.radius.is_some() {
            known.position = known.position.minus(&self.vector_now());
        }
        known
    }

    /// The contour goes on from here, in another frame perhaps.
    pub(super) fn contour_from(&mut self, place: Position) {
        let (vector, scale) = (self.vector_now(), scale_of(&self.reported_frame, self.modes.plane));
        let Some(active) = &mut self.radius else { return };
        (active.place, active.vector) = (place, None);
        active.centre = active.point(&place.plus(&vector));
        match scale {
            Some(scale) => active.left_mm = active.true_left_mm / scale,
            None => self.hold_fault(mistakes::unequal_scales(self.start)),
        }
    }
}
