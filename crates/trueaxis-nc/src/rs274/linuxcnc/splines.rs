//! G5, G5.1, G5.2 and G5.3: splines.
//!
//! # Source
//! LinuxCNC 2.9 user manual, "G5 Cubic Spline", "G5.1 Quadratic Spline", "G5.2 G5.3 NURBS Block". The control
//! draws each as a rational B-spline, with two arcs between points at four equal steps of the parameter for each
//! control point (`NURBS_FEED` of its task).

use crate::execution::mistakes;
use crate::moves::{Arc, Axis, AxisSet, Move, MoveKind, Plane};
use crate::rs274::code::{Motion, Spline};
use crate::rs274::{Run, fault};
use crate::text::program::Fault;
use trueaxis_cycles::Point;
use trueaxis_cycles::spline::{Nurbs, Piece};

/// Points of the curve between which the control draws two arcs, for each control point.
const STEPS: usize = 4;

/// What splines keep from block to block.
#[derive(Debug, Clone, Default)]
pub(in crate::rs274) struct SplineMemory {
    /// The control points of G5.2 with their weights.
    points: Vec<(Point, f64)>,
    order: usize,
    /// From the inner point before the end of a cubic to that end: the next one goes on in this direction.
    handle: Option<Point>,
}

impl SplineMemory {
    /// Another motion ends a series of splines.
    pub fn select(&mut self, before: Option<Motion>, now: Motion) {
        if before != Some(now) {
            *self = Self::default();
        }
    }
}

impl Run<'_> {
    /// G5, G5.1 and a block of G5.2.
    pub(in crate::rs274) fn spline(&mut self, spline: Spline, at: usize) -> Result<(), Fault> {
        if self.core.has_radius() {
            return Err(mistakes::cycle_on_contour("a spline", at));
        }
        self.core.modes.check_feed(at)?;
        if spline == Spline::Nurbs {
            return self.control_point(at);
        }
        let other = b"ZABCUVW".iter().find(|l| self.words.look(**l).is_some());
        if self.core.modes.plane != Plane::Xy || other.is_some() {
            let message = match other {
                Some(letter) => format!("a spline moves X and Y, not {}", char::from(*letter)),
                None => "splines are in the plane of G17 only".to_owned(),
            };
            return Err(fault(
                "bad-spline",
                at,
                message,
                "write G17 and X Y, or G5.2 in its plane",
            ));
        }
        let from = [self.frames.position[Axis::X], self.frames.position[Axis::Y]];
        let [i, j, p, q] = [b'I', b'J', b'P', b'Q'].map(|letter| self.length(letter));
        let target = self.target();
        let to = [target[Axis::X], target[Axis::Y]];
        let by = |base: Point, offset: Point| [base[0] + offset[0], base[1] + offset[1]];
        let first = match (i, j, self.modes.spline.handle) {
            (Some(i), Some(j), _) => [i, j],
            (None, None, Some(handle)) if spline == Spline::Cubic => handle,
            _ => {
                let hint = "write I and J, the way from the start to the first inner point";
                return Err(fault("bad-spline", at, "the spline needs both I and J", hint));
            }
        };
        let mut points = vec![(from, 1.0), (by(from, first), 1.0)];
        if spline == Spline::Cubic {
            let (Some(p), Some(q)) = (p, q) else {
                let hint = "write P and Q, the way from the end to the second inner point";
                return Err(fault("bad-spline", at, "G5 needs both P and Q", hint));
            };
            points.push((by(to, [p, q]), 1.0));
            self.modes.spline.handle = Some([-p, -q]);
        }
        points.push((to, 1.0));
        self.draw(&points, points.len(), at)
    }

    /// A block of G5.2: P alone is the weight of the place of the tool.
    fn control_point(&mut self, at: usize) -> Result<(), Fault> {
        let axes = self.core.modes.plane.axes();
        let given = [axes[0], axes[1]].map(|a| self.words.look(a.letter()).is_some());
        let (weight, order) = (self.words.take(b'P'), self.words.take(b'L'));
        let place = self.frames.position;
        let opens = self.modes.spline.points.is_empty();
        let wrong = match given {
            [true, true] if weight.is_none_or(|w| w <= 0.0) => Some("its weight P, above 0"),
            [false, false] if weight.is_some_and(|w| w <= 0.0) => Some("a weight P above 0"),
            [false, false] if !opens => Some("both axes of the plane"),
            [true, false] | [false, true] => Some("both axes of the plane"),
            _ => None,
        };
        if let Some(what) = wrong {
            let message = format!("a control point of a NURBS needs {what}");
            return Err(fault("bad-spline", at, message, "write X10 Y20 P1"));
        }
        if order.is_some_and(|l| !(1.0..=1000.0).contains(&l) || l.fract() != 0.0) {
            let message = "L, the order of the NURBS, is not a whole number from 3";
            return Err(fault("bad-spline", at, message, "write G5.2 P1 L3"));
        }
        let both = given == [true, true];
        let target = self.target();
        let memory = &mut self.modes.spline;
        if opens {
            let weight = if both { 1.0 } else { weight.unwrap_or(1.0) };
            memory.points.push(([place[axes[0]], place[axes[1]]], weight));
            memory.order = 3;
        }
        if let Some(order) = order {
            memory.order = memory.order.max(order as usize);
        }
        if both {
            memory.points.push(([target[axes[0]], target[axes[1]]], weight.unwrap_or(1.0)));
        }
        Ok(())
    }

    /// G5.3: the curve of the control points is drawn.
    pub(in crate::rs274) fn nurbs_end(&mut self, at: usize) -> Result<(), Fault> {
        let memory = std::mem::take(&mut self.modes.spline);
        if self.modes.motion != Some(Motion::Spline(Spline::Nurbs)) {
            let hint = "write G5.2 P1 L3 and the control points before it";
            return Err(fault("bad-spline", at, "G5.3 without G5.2 before it", hint));
        }
        self.modes.motion = Some(Motion::Cancelled);
        self.draw(&memory.points, memory.order, at)
    }

    fn draw(&mut self, points: &[(Point, f64)], order: usize, at: usize) -> Result<(), Fault> {
        let plane = self.core.modes.plane;
        self.check_round(plane, at);
        let Some(curve) = Nurbs::new(points, order) else {
            let message = format!(
                "{} control points with the place of the tool, fewer than the order {order}",
                points.len()
            );
            return Err(fault("bad-spline", at, message, "write more points, or a smaller L"));
        };
        let Some(pieces) = curve.biarcs(STEPS * curve.count()) else {
            let message = "the NURBS has too many control points";
            return Err(fault("bad-spline", at, message, "divide the curve"));
        };
        let [first, second, _] = plane.axes();
        let named = AxisSet(1 << first as u16 | 1 << second as u16);
        let (feed, origin) = (self.core.modes.feed, self.core.origin);
        self.modes.moved = true;
        for piece in pieces {
            let mut target = self.frames.position;
            [target[first], target[second]] = piece.end();
            let kind = match piece {
                Piece::Line(_) => MoveKind::Linear,
                Piece::Arc { center: center_mm, ccw, .. } => {
                    MoveKind::Arc(Arc { plane, center_mm, turns: 1, ccw })
                }
            };
            self.emit_move(Move::plain(kind, target, named, feed, origin));
        }
        Ok(())
    }
}
