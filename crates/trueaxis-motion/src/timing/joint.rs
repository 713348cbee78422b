//! How the path gets from one element to the next.

use super::element::{Segment, Side};
use super::path::{CEILING, Largest, Piece, Reciprocals, curved, straight};
use super::scurve::{Bounds, ramp_time, reach};
use super::{LimitKind, Limiting, Node};
use trueaxis_machine::axis::{Command, MAX_AXES};

/// Shares of a blend: its curvature takes at most so much of an axis' acceleration and jerk. The
/// rest speeds the path up and slows it down. Found by trial on the programs of the bench: where
/// the curvature binds, the velocity that it allows counts for more than the change of velocity.
const ACCELERATION_SHARE: f64 = 0.75;
const JERK_SHARE: f64 = 0.9;
/// The mixed term 3 q″ σ̇ σ̈ takes at most so much of the jerk where the curvature takes less.
const MIXED_SHARE: f64 = 0.2;

/// How the path gets round a node.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Corner {
    /// There is none: the path goes straight on.
    None,
    /// A blend over ± this length.
    Blend(f64),
    /// It stops, because this axis may not leave the corner.
    Stop(usize),
}

/// A change of curvature of 1 over ± 1: the second derivative goes from 0 to 1 with the third −m, m,
/// −m, and changes it at ± s, docs/model.md eq. 42b.
mod step {
    /// (1/2)^(1/3)
    pub const S: f64 = 0.793_700_525_984_099_8;
    /// 1/(4s − 2)
    pub const M: f64 = 0.851_207_191_959_657_4;
    /// How far it leaves the two curves.
    pub const AWAY: f64 = 0.014_519_770_849_735_6;
    /// By how much the first derivative leaves theirs, in the middle.
    pub const SLOPE: f64 = 0.110_624;
    /// By how much the second goes beyond 0 and 1: m (1 − s).
    pub const BEND: f64 = 0.175_603_7;
}

/// The largest blend that each axis' tolerance and half of both segments allow,
/// docs/model.md eq. 42, 42b.
///
/// `least` is the shortest blend that differs from none.
fn corner(node: &Node, before: &Segment, after: &Segment, least: f64) -> Corner {
    let half = 0.5 * before.length.min(after.length);
    let straight = before.is_straight() && after.is_straight();
    let mut d = half;
    let (mut bends, mut tightest) = (false, 0);
    for i in 0..MAX_AXES {
        let (e, f) = (before.element.end.slope[i], after.element.begin.slope[i]);
        let mut change = (f - e).abs();
        // Below this the change is rounding of the positions.
        let rounding = 4.0 * f64::EPSILON * node.command[i].abs() / half;
        if change <= 1e-12 * (e.abs() + f.abs()) + rounding {
            change = 0.0;
        }
        let mut turn = 0.0;
        if !straight {
            let (e, f) = (before.element.end.bend[i], after.element.begin.bend[i]);
            turn = (f - e).abs();
            if turn <= 1e-9 * (e.abs() + f.abs()) + rounding / half {
                turn = 0.0;
            }
        }
        if change == 0.0 && turn == 0.0 {
            continue;
        }
        bends = true;
        // 3/16 change d + AWAY turn d² = tolerance
        let tolerance = node.tolerance[i];
        let allowed = if turn == 0.0 {
            tolerance * (16.0 / 3.0) / change
        } else if tolerance.is_infinite() {
            f64::INFINITY
        } else {
            let (p, q) = (step::AWAY * turn, 3.0 / 16.0 * change);
            2.0 * tolerance / (q + (q * q + 4.0 * p * tolerance).sqrt())
        };
        if allowed < d {
            (d, tightest) = (allowed, i);
        }
    }
    match bends {
        false => Corner::None,
        true if d < least.max(1e-9 * half) => Corner::Stop(tightest),
        true => Corner::Blend(d),
    }
}

/// Limits on a blend of half length d, docs/model.md eq. 43.
fn blend(limits: &Reciprocals, before: &Segment, after: &Segment, d: f64) -> Piece {
    let [mut v, mut bend, mut twist] = [Largest::default(); 3];
    // |q′|, |q″|, |q‴| at most.
    let [slope, second, third] = largest_in_blend(before, after, d);
    for i in 0..MAX_AXES {
        v.take(slope[i] * limits.v[i], i);
        bend.take(second[i] * limits.a[i], i);
        twist.take(third[i] * limits.j[i], i);
    }
    let feed = before.feed.min(after.feed).min(CEILING.v);
    let mut velocity = v.reciprocal(feed);
    let mut why = (velocity < feed).then_some(Limiting { axis: v.axis, kind: LimitKind::Velocity });
    if velocity * velocity * bend.value > ACCELERATION_SHARE {
        velocity = (ACCELERATION_SHARE / bend.value).sqrt();
        why = Some(Limiting { axis: bend.axis, kind: LimitKind::Corner });
    }
    if velocity.powi(3) * twist.value > JERK_SHARE {
        velocity = (JERK_SHARE / twist.value).cbrt();
        why = Some(Limiting { axis: twist.axis, kind: LimitKind::Corner });
    }
    let straight = before.is_straight() && after.is_straight();
    let mut a = Largest::default();
    for i in 0..MAX_AXES {
        let bending = second[i] * limits.a[i] * velocity * velocity;
        a.take(slope[i] * limits.a[i] / (1.0 - bending), i);
        let twisting = third[i] * limits.j[i] * velocity.powi(3);
        let mixed = 3.0 * second[i] * velocity * limits.j[i];
        let share = match straight {
            true => MIXED_SHARE.max(0.5 * twisting),
            // Both may be largest together.
            false => 0.5 * (1.0 - twisting),
        };
        a.take(mixed / share, i);
    }
    let acceleration = a.reciprocal(CEILING.a);
    let mut j = Largest::default();
    for i in 0..MAX_AXES {
        let twisting = third[i] * limits.j[i] * velocity.powi(3);
        let mixed = 3.0 * second[i] * velocity * acceleration * limits.j[i];
        let taken = if straight { jerk_of_curvature(twisting, mixed) } else { twisting + mixed };
        j.take(slope[i] * limits.j[i] / (1.0 - taken), i);
    }
    Piece {
        bounds: Bounds { v: velocity, a: acceleration, j: j.reciprocal(CEILING.j) },
        velocity: why,
        acceleration_axis: a.axis,
        jerk_axis: j.axis,
    }
}

fn largest_in_blend(before: &Segment, after: &Segment, d: f64) -> [Command; 3] {
    let (first, second) = (before.element.near(Side::End, d), after.element.near(Side::Begin, d));
    let (k, c) = (0.75 / d, 1.5 / (d * d));
    let mut most = [[0.0; MAX_AXES]; 3];
    for i in 0..MAX_AXES {
        for (n, row) in most.iter_mut().enumerate() {
            row[i] = first[n][i].max(second[n][i]);
        }
        let (e, f) = (&before.element.end, &after.element.begin);
        let change = (f.slope[i] - e.slope[i]).abs();
        let turn = (f.bend[i] - e.bend[i]).abs();
        most[0][i] += step::SLOPE * turn * d;
        most[1][i] += k * change + step::BEND * turn;
        most[2][i] += c * change + step::M * turn / d;
    }
    most
}

/// How the path passes a node that is no programmed stop.
#[derive(Debug, Clone, Copy)]
pub(super) enum Passage {
    /// Straight on.
    Through,
    /// On a blend over ± this length.
    Round(f64, Piece),
    /// It stops: the limit that asks for it.
    Rest(Limiting),
}

/// The faster of blend and stop, docs/model.md eq. 45b.
pub(super) fn passage(
    limits: &Reciprocals,
    node: &Node,
    [before, after]: [&Segment; 2],
    least: f64,
) -> Passage {
    let kind = LimitKind::Corner;
    let d = match corner(node, before, after, least) {
        Corner::None => return Passage::Through,
        Corner::Stop(axis) => return Passage::Rest(Limiting { axis, kind }),
        Corner::Blend(d) => d,
    };
    let round = blend(limits, before, after, d);
    match pays(limits, &round.bounds, d, [before, after]) {
        true => Passage::Round(d, round),
        false => {
            let axis = round.acceleration_axis;
            Passage::Rest(round.velocity.unwrap_or(Limiting { axis, kind }))
        }
    }
}

/// What the first part of a segment allows.
fn first_bounds(limits: &Reciprocals, segment: &Segment) -> Bounds {
    match segment.element.parts.first() {
        None => straight(limits, segment).bounds,
        Some(part) => curved(limits, part, segment.feed).bounds,
    }
}

/// Whether a blend takes less time than a stop at the node, docs/model.md eq. 45b: for each side the time
/// that a change of velocity loses against the velocity V from which it begins.
fn pays(limits: &Reciprocals, round: &Bounds, d: f64, sides: [&Segment; 2]) -> bool {
    let (mut blend_s, mut stop_s) = (0.0, 0.0);
    for segment in sides {
        // No segment allows more than its feed.
        if round.v >= 0.5 * segment.feed.min(CEILING.v) {
            continue;
        }
        let bounds = first_bounds(limits, segment);
        if round.v >= 0.5 * bounds.v {
            continue;
        }
        // As fast as the segment alone allows.
        let v = reach(0.0, 0.5 * segment.length, &bounds);
        let dv = (v - round.v).max(0.0);
        let slow = round.v.min(v);
        blend_s += 0.5 * ramp_time(dv, bounds.a, bounds.j) * dv / v + d * (1.0 / slow - 1.0 / v);
        stop_s += 0.5 * ramp_time(v, bounds.a, bounds.j);
    }
    blend_s <= stop_s
}

/// Limits on a blend from velocity and acceleration alone, each with all that an axis has.
pub(super) fn blend_without_jerk(
    limits: &Reciprocals,
    before: &Segment,
    after: &Segment,
    d: f64,
) -> Bounds {
    let [mut v, mut bend, mut a] = [Largest::default(); 3];
    for i in 0..MAX_AXES {
        let (e, f) = (before.element.end.slope[i], after.element.begin.slope[i]);
        let slope = e.abs().max(f.abs());
        v.take(slope * limits.v[i], i);
        bend.take(0.75 / d * (f - e).abs() * limits.a[i], i);
        a.take(slope * limits.a[i], i);
    }
    let ceiling = before.feed.min(after.feed).min(CEILING.v);
    let bent = if bend.value > 0.0 { (1.0 / bend.value).sqrt() } else { ceiling };
    Bounds { v: v.reciprocal(ceiling).min(bent), a: a.reciprocal(CEILING.a), j: CEILING.j }
}

/// The largest P·|1 − 2u| + Q·4u(1 − u) for 0 ≤ u ≤ 1: |h″| is largest at the ends of the blend, h′
/// in its middle; docs/model.md eq. 43.
fn jerk_of_curvature(p: f64, q: f64) -> f64 {
    if p >= 2.0 * q { p } else { q + p * p / (4.0 * q) }
}

/// What a blend over ± d adds at x to the curves that meet at 0 where their first and second
/// derivatives change by 1: value and three derivatives of each.
pub(super) fn rounding(d: f64, x: f64) -> [[f64; 4]; 2] {
    if d <= 0.0 || x.abs() >= d {
        return [[0.0; 4]; 2];
    }
    let (u, on) = ((x + d) / (2.0 * d), if x < 0.0 { 0.0 } else { 1.0 });
    let corner = [
        2.0 * d * u * u * u * (1.0 - 0.5 * u) - on * x,
        u * u * (3.0 - 2.0 * u) - on,
        6.0 * u * (1.0 - u) / (2.0 * d),
        (6.0 - 12.0 * u) / (4.0 * d * d),
    ];
    // The second half of the change of curvature is the first one about the point (0, 1/2).
    let (z, side) = (-x.abs() / d, if x < 0.0 { 1.0 } else { -1.0 });
    let [value, first, second, third] = step_to(z);
    [corner, [side * d * d * value, d * first, side * second, third / d]]
}

/// The change of curvature at z = −1 … 0 and its derivatives, docs/model.md eq. 42b.
fn step_to(z: f64) -> [f64; 4] {
    use step::{M, S};
    let t = z.min(-S) + 1.0;
    let begin = [-M * t * t * t / 6.0, -M * t * t / 2.0, -M * t];
    if z < -S {
        return [begin[0], begin[1], begin[2], -M];
    }
    let (t, [value, first, second]) = (z + S, begin);
    [
        value + t * (first + t * (second / 2.0 + t * M / 6.0)),
        first + t * (second + t * M / 2.0),
        second + t * M,
        M,
    ]
}

#[cfg(test)]
mod tests {
    use super::super::{Element, Turn};
    use super::*;

    fn segment(x: f64, y: f64, length: f64) -> Segment {
        let to = [x * length, y * length, 0.0, 0.0, 0.0, 0.0];
        let element = Element::straight(&[0.0; 6], &to, length);
        Segment { element, length, feed: 50.0 }
    }

    fn node(tolerance: f64) -> Node {
        Node {
            command: [0.0; 6],
            length: 10.0,
            feed: 50.0,
            stop: false,
            tolerance: [tolerance; 6],
            dwell_s: 0.0,
        }
    }

    /// A right angle, 0.03 mm: d = 0.03 · 16/3 = 0.16; without tolerance it is a stop.
    #[test]
    fn blend_of_a_right_angle() {
        let (a, b) = (segment(1.0, 0.0, 10.0), segment(0.0, 1.0, 10.0));
        let Corner::Blend(d) = corner(&node(0.03), &a, &b, 0.0) else { panic!() };
        assert!((d - 0.16).abs() < 1e-12);
        assert_eq!(corner(&node(0.0), &a, &b, 0.0), Corner::Stop(0));
        assert_eq!(corner(&node(0.0), &a, &a, 0.0), Corner::None);
    }

    /// From a line onto a circle of radius 20: 0.01452 d²/20 = 0.01 gives d = 3.711.
    #[test]
    fn blend_of_a_line_and_an_arc() {
        let arc = Turn {
            length: 30.0,
            rate: 0.05,
            cos: [0.0, -20.0, 0.0, 0.0, 0.0, 0.0],
            sin: [20.0, 0.0, 0.0, 0.0, 0.0, 0.0],
            steady: [0.0; 6],
            growth: 0.0,
        };
        let arc = Segment { element: arc.element(), length: 30.0, feed: 50.0 };
        let Corner::Blend(d) = corner(&node(0.01), &segment(1.0, 0.0, 10.0), &arc, 0.0) else {
            panic!()
        };
        assert!((d - (0.2_f64 / 0.014_519_77).sqrt()).abs() < 1e-6);
        assert_eq!(corner(&node(0.0), &arc, &arc, 0.0), Corner::Stop(0));
    }

    /// In the middle of a blend of 0.16 each axis of a right angle is 3/16 · 0.16 = 0.03 off and has
    /// half its slope; where the curvature changes the path is on both curves again.
    #[test]
    fn the_middle_of_a_blend() {
        let [corner, turn] = rounding(0.16, -0.0);
        assert!((corner[0] - 0.03).abs() < 1e-15 && (corner[1] + 0.5).abs() < 1e-15);
        assert!((corner[2] - 0.75 / 0.16).abs() < 1e-12 && corner[3].abs() < 1e-9);
        assert!(turn[0].abs() < 1e-15 && (turn[2] + 0.5).abs() < 1e-12);
        let away = (1..1000).map(|k| rounding(1.0, f64::from(k) * 1e-3)[1][0].abs());
        let most = away.fold(0.0, f64::max);
        assert!((most - step::AWAY).abs() < 1e-7 && most <= step::AWAY);
        assert!((step_to(0.0)[1] - step::SLOPE).abs() < 1e-6);
        assert!((step_to(-step::S)[2] + step::BEND).abs() < 1e-6);
    }

    /// P = 0.6, Q = 0.4: u with |1−2u| = 0.75 gives 0.45 + 0.4·0.4375 = 0.625.
    #[test]
    fn the_jerk_terms_are_not_largest_together() {
        assert!((jerk_of_curvature(0.6, 0.4) - 0.625).abs() < 1e-15);
    }

    /// A blend begins and ends with nothing, and each derivative is the slope of the one before.
    #[test]
    fn law_the_derivatives_of_a_blend_are_slopes() {
        let (d, h) = (0.8, 1e-6);
        for curve in 0..2 {
            let at = |x: f64| rounding(d, x)[curve];
            for x in [-0.79, -0.61, -0.33, -0.07, 0.05, 0.31, 0.59, 0.78] {
                for k in 0..3 {
                    let slope = (at(x + h)[k] - at(x - h)[k]) / (2.0 * h);
                    assert!((slope - at(x)[k + 1]).abs() < 1e-5, "{curve} {x} {k}: {slope}");
                }
            }
            for end in [-d + 1e-9, d - 1e-9] {
                assert!(at(end)[..2].iter().all(|v| v.abs() < 1e-6), "{curve} {end}");
            }
        }
    }
}
