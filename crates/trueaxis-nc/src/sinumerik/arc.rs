//! Circles: G2, G3, CIP and CT.

use super::tables::{Motion, Name};
use super::words::{Mode, Words};
use super::{Run, fault};
use crate::execution::arcs::by_radius;
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
                let tangent = arc_tangent(&arc, &target);
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
            Some((turn, _, at)) => {
                let message = format!("TURN={turn} is not a number of turns");
                Err(fault("bad-turns", at, message, "write a whole number from 0 on"))
            }
        }
    }

    fn plane_arc(
        &mut self,
        words: &mut Words,
        mut target: Position,
        ccw: bool,
        at: usize,
    ) -> Result<(Position, Arc), Fault> {
        let plane = self.modes.plane;
        let [first, second, _] = plane.axes();
        let unit = self.modes.unit_mm();
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
            by_radius(start, end, radius * unit, ccw, place)?
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
                by_opening(start, end, if ccw { angle } else { -angle }, place)?
            }
        } else if given {
            let center = by_letters();
            check_radii(start, end, center, at)?;
            center
        } else if polar {
            let pole = [self.modes.pole[first], self.modes.pole[second]];
            check_radii(start, end, pole, at)?;
            pole
        } else {
            let message = "neither the centre nor the radius of the circle is given";
            let hint = "write I J K of the plane, CR= or AR=";
            return Err(fault("arc-without-centre", at, message, hint));
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
        let unit = self.modes.unit_mm();
        let p = xyz(&self.chain.position);
        let r = xyz(&target);
        let mut q = p;
        if words.through.iter().all(Option::is_none) {
            let message = "CIP needs the point on the way";
            return Err(fault("missing-value", at, message, "write I1= J1= K1="));
        }
        for (i, word) in words.through.iter_mut().enumerate() {
            if let Some((value, mode)) = word.take() {
                let added =
                    mode == Mode::Increment || mode == Mode::Modal && self.modes.incremental;
                q[i] = if added { p[i] + value * unit } else { value * unit };
            }
        }
        let (a, b) = (minus(q, p), minus(r, p));
        let normal = cross(a, minus(r, q));
        let n2 = dot(normal, normal);
        let scale = dot(a, a) * dot(b, b);
        if n2.is_nan() || n2 <= 1e-18 * scale || scale == 0.0 {
            let message = "the three points of CIP lie on a line or are the same";
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
        let plane = self.modes.plane;
        let [first, second, _] = plane.axes();
        let along = self.modes.tangent.map(|t| [t[first as usize], t[second as usize]]);
        let Some(along) = along.filter(|t| t[0].hypot(t[1]) > 1e-9) else {
            let message = "CT has no move before it in this plane";
            return Err(fault("arc-does-not-fit", at, message, "write a G1, G2 or G3 before CT"));
        };
        let start = [self.chain.position[first], self.chain.position[second]];
        let chord = [target[first] - start[0], target[second] - start[1]];
        let length = along[0].hypot(along[1]);
        let left = [-along[1] / length, along[0] / length];
        let side = left[0] * chord[0] + left[1] * chord[1];
        let chord2 = chord[0] * chord[0] + chord[1] * chord[1];
        if side.abs() < 1e-9 * chord2.sqrt().max(1e-9) {
            self.straight_tangent(target);
            let tangent = self.modes.tangent.unwrap_or([along[0], along[1], 0.0]);
            return Ok((MoveKind::Linear, tangent));
        }
        // The centre lies on the normal of the tangent: |start + s·left − target| = |s|.
        let s = chord2 / (2.0 * side);
        let center_mm = [start[0] + s * left[0], start[1] + s * left[1]];
        let arc = Arc { plane, center_mm, turns, ccw: s > 0.0 };
        Ok((MoveKind::Arc(arc), arc_tangent(&arc, &target)))
    }
}

impl super::execute::Modes {
    /// Whether the target lies on the polar radius about the pole.
    fn pole_used(&self, target: &Position, axes: [crate::moves::Axis; 2]) -> bool {
        let d = axes.map(|a| target[a] - self.pole[a]);
        self.polar.1 > 0.0 && (d[0].hypot(d[1]) - self.polar.1).abs() < 1e-6 * self.polar.1
    }
}

fn arc_tangent(arc: &Arc, target: &Position) -> [f64; 3] {
    let [first, second, _] = arc.plane.axes();
    let out = [target[first] - arc.center_mm[0], target[second] - arc.center_mm[1]];
    let sign = if arc.ccw { 1.0 } else { -1.0 };
    let mut tangent = [0.0; 3];
    tangent[first as usize] = -out[1] * sign;
    tangent[second as usize] = out[0] * sign;
    tangent
}

fn check_radii(start: [f64; 2], end: [f64; 2], center: [f64; 2], at: usize) -> Result<(), Fault> {
    let radius = |p: [f64; 2]| (p[0] - center[0]).hypot(p[1] - center[1]);
    let (from, to) = (radius(start), radius(end));
    if from <= 0.0 || to <= 0.0 {
        let message = "the radius of the circle is zero";
        return Err(fault("arc-does-not-fit", at, message, "check I, J and K"));
    }
    if (from - to).abs() > GAP_MM.max(GAP_FACTOR * from.max(to)) {
        let message = format!(
            "the circle does not fit: radius {from:.4} mm at its start, {to:.4} mm at its end"
        );
        let hint = "check I, J, K: they count from the start unless in AC( )";
        return Err(fault("arc-does-not-fit", at, message, hint));
    }
    Ok(())
}

fn turned_about(center: [f64; 2], p: [f64; 2], angle_deg: f64) -> [f64; 2] {
    let (sin, cos) = angle_deg.to_radians().sin_cos();
    let d = [p[0] - center[0], p[1] - center[1]];
    [center[0] + d[0] * cos - d[1] * sin, center[1] + d[0] * sin + d[1] * cos]
}

/// The centre of a circle that sweeps a signed angle between two points.
fn by_opening(
    start: [f64; 2],
    end: [f64; 2],
    angle_deg: f64,
    at: usize,
) -> Result<[f64; 2], Fault> {
    let chord = [end[0] - start[0], end[1] - start[1]];
    let half = chord[0].hypot(chord[1]) / 2.0;
    if half == 0.0 {
        let message = "a circle by AR must end elsewhere than it begins";
        return Err(fault("arc-does-not-fit", at, message, "a full circle needs I J K"));
    }
    // The height of the triangle of chord and centre: h = (chord / 2) / tan(angle / 2).
    let height = half / (angle_deg.to_radians() / 2.0).tan();
    let along = [chord[0] / (2.0 * half), chord[1] / (2.0 * half)];
    let middle = [0, 1].map(|i| f64::midpoint(start[i], end[i]));
    Ok([middle[0] - along[1] * height, middle[1] + along[0] * height])
}

fn xyz(p: &Position) -> [f64; 3] {
    [p.0[0], p.0[1], p.0[2]]
}

fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|i| a[i] - b[i])
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}
