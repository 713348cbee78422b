//! Circles: G2, G3, CIP and CT.

use super::tables::{Motion, Name};
use super::words::{Mode, Words};
use super::{Run, fault};
use crate::execution::arcs::{self, end_tangent};
use crate::execution::mistakes;
use crate::moves::turns::{cross, dot, minus, xyz};
use crate::moves::{Arc, MoveKind, Position, SpatialArc};
use crate::text::program::Fault;

/// How far the radii at both ends may differ: machine data 21000 and 21010 as delivered.
const GAP_MM: f64 = 0.01;
const GAP_FACTOR: f64 = 0.001;

impl Run<'_> {
    /// A circle to a target.
    pub(super) fn round_move(
        &mut self,
        words: &mut Words,
        target: Position,
        direction: Option<[f64; 3]>,
        at: usize,
    ) -> Result<(), Fault> {
        let turns = self.turns(words)?;
        let (kind, tangent) = match self.modes.motion {
            Motion::ThroughPoint => self.through_point(words, target, turns, at)?,
            Motion::Tangent => self.tangent_arc(target, turns, at)?,
            motion => {
                let ccw = motion == Motion::Arc { ccw: true };
                let (target, arc) = self.plane_arc(words, target, ccw, at)?;
                let arc = Arc { turns, ..arc };
                let tangent = end_tangent(&arc, &target);
                self.modes.tangent = Some(tangent);
                self.send_move(MoveKind::Arc(arc), target, direction, words);
                return Ok(());
            }
        };
        self.modes.tangent = Some(tangent);
        self.send_move(kind, target, direction, words);
        Ok(())
    }

    /// TURN counts the full circles beside the programmed one.
    fn turns(&mut self, words: &mut Words) -> Result<u32, Fault> {
        match words.take(Name::Turn) {
            None => Ok(1),
            Some((turn, ..)) if (0.0..1e6).contains(&turn) && turn.fract() == 0.0 => {
                Ok(turn as u32 + 1)
            }
            Some((turn, _, at)) => Err(mistakes::bad_turns(turn, at)),
        }
    }

    fn plane_arc(
        &mut self,
        words: &mut Words,
        mut target: Position,
        ccw: bool,
        at: usize,
    ) -> Result<(Position, Arc), Fault> {
        let plane = self.core.modes.plane;
        let [first, second, _] = plane.axes();
        let unit = self.core.modes.unit_mm();
        let start = [self.chain.position[first], self.chain.position[second]];
        let letters = [first, second].map(|a| words.centers[a as usize]);
        let polar = [first, second].into_iter().all(|a| !words.axes.contains(a))
            && self.modes.pole_used(&target, [first, second]);
        let end = [target[first], target[second]];
        let given = letters.iter().any(Option::is_some);
        for axis in [first, second] {
            words.centers[axis as usize] = None;
        }
        let by_letters = || -> [f64; 2] {
            std::array::from_fn(|i| match letters[i] {
                Some((value, Mode::Absolute)) => value * unit,
                Some((value, _)) => start[i] + value * unit,
                None => start[i],
            })
        };
        let opening = words.take(Name::Opening);
        let radius = words.take(Name::Radius);
        let center_mm = if let Some((radius, _, place)) = radius {
            arcs::by_radius(
                [start, end],
                radius * unit,
                ccw,
                arcs::rounding_mm(radius * unit),
                place,
            )?
        } else if let Some((angle, _, place)) = opening {
            if !(angle > 0.0 && angle < 360.0) {
                let message = format!("AR={angle} is not between 0 and 360 degrees");
                return Err(fault("bad-angles", place, message, "write AR=90"));
            }
            if given {
                let center = by_letters();
                let turned = turned_about(center, start, if ccw { angle } else { -angle });
                (target[first], target[second]) = (turned[0], turned[1]);
                center
            } else {
                arcs::by_opening([start, end], if ccw { angle } else { -angle }, place)?
            }
        } else if given {
            let center = by_letters();
            check_radii([start, end], center, at)?;
            center
        } else if polar {
            let pole = [self.modes.pole[first], self.modes.pole[second]];
            check_radii([start, end], pole, at)?;
            pole
        } else {
            let hint = "write I J K of the plane, CR= or AR=";
            return Err(mistakes::arc_without_centre(hint, at));
        };
        Ok((target, Arc { plane, center_mm, turns: 1, ccw }))
    }

    /// CIP: a circle through a point, in any plane.
    fn through_point(
        &mut self,
        words: &mut Words,
        target: Position,
        turns: u32,
        at: usize,
    ) -> Result<(MoveKind, [f64; 3]), Fault> {
        let unit = self.core.modes.unit_mm();
        let p = xyz(&self.chain.position);
        let r = xyz(&target);
        let mut q = p;
        if words.through.iter().all(Option::is_none) {
            let message = "CIP needs an intermediate point";
            return Err(fault("missing-value", at, message, "write I1= J1= K1="));
        }
        for (i, word) in words.through.iter_mut().enumerate() {
            if let Some((value, mode)) = word.take() {
                let added =
                    mode == Mode::Increment || mode == Mode::Modal && self.core.modes.incremental;
                q[i] = if added { p[i] + value * unit } else { value * unit };
            }
        }
        let (a, b) = (minus(q, p), minus(r, p));
        let normal = cross(a, minus(r, q));
        let n2 = dot(normal, normal);
        let scale = dot(a, a) * dot(b, b);
        if n2.is_nan() || n2 <= 1e-18 * scale || scale == 0.0 {
            let message = "the three points of CIP lie on a line or coincide";
            return Err(fault("arc-does-not-fit", at, message, "check I1, J1, K1 and the target"));
        }
        // The centre of the circle through 0, a and b:
        // c = (|a|² b − |b|² a) × (a × b) / (2 |a × b|²).
        let ab = cross(a, b);
        let mixed: [f64; 3] = std::array::from_fn(|i| dot(a, a) * b[i] - dot(b, b) * a[i]);
        let c = cross(mixed, ab).map(|v| v / (2.0 * dot(ab, ab)));
        let center_mm = std::array::from_fn(|i| p[i] + c[i]);
        let normal = normal.map(|v| v / n2.sqrt());
        let tangent = cross(normal, minus(r, center_mm));
        Ok((MoveKind::SpatialArc(SpatialArc { center_mm, normal, turns }), tangent))
    }

    /// CT: a circle in the plane that goes on where the last move went.
    fn tangent_arc(
        &mut self,
        target: Position,
        turns: u32,
        at: usize,
    ) -> Result<(MoveKind, [f64; 3]), Fault> {
        let plane = self.core.modes.plane;
        let [first, second, _] = plane.axes();
        let axes = [first as usize, second as usize];
        let along = arcs::direction_before(self.modes.tangent, axes, at)?;
        let start = [self.chain.position[first], self.chain.position[second]];
        let end = [target[first], target[second]];
        let Some((center_mm, ccw)) = arcs::tangential([start, end], along) else {
            self.straight_tangent(target);
            let tangent = self.modes.tangent.unwrap_or([along[0], along[1], 0.0]);
            return Ok((MoveKind::Linear, tangent));
        };
        let arc = Arc { plane, center_mm, turns, ccw };
        Ok((MoveKind::Arc(arc), end_tangent(&arc, &target)))
    }
}

impl super::execute::Modes {
    /// Whether the target lies on the polar radius about the pole.
    fn pole_used(&self, target: &Position, axes: [crate::moves::Axis; 2]) -> bool {
        let d = axes.map(|a| target[a] - self.pole[a]);
        self.polar.1 > 0.0 && (d[0].hypot(d[1]) - self.polar.1).abs() < 1e-6 * self.polar.1
    }
}

fn check_radii(ends: [[f64; 2]; 2], center: [f64; 2], at: usize) -> Result<(), Fault> {
    arcs::check_radii(ends, center, |radius| GAP_MM.max(GAP_FACTOR * radius), at)
}

fn turned_about(center: [f64; 2], p: [f64; 2], angle_deg: f64) -> [f64; 2] {
    let (sin, cos) = angle_deg.to_radians().sin_cos();
    let d = [p[0] - center[0], p[1] - center[1]];
    [center[0] + d[0] * cos - d[1] * sin, center[1] + d[0] * sin + d[1] * cos]
}
