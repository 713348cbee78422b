//! The smooth path: straight pieces and blends, and what the axes allow on them.

use super::scurve::Bounds;
use super::{AxisLimits, LimitKind, Limiting, Node};
use trueaxis_machine::axis::{Command, MAX_AXES};

/// Largest velocity, acceleration and jerk of the path where no axis limits it.
const CEILING: Bounds = Bounds { v: 1e6, a: 1e9, j: 1e12 };

/// Shares of a blend: its curvature takes at most so much of an axis' acceleration and jerk. The
/// rest speeds the path up and slows it down. Found by trial on the programs of the bench: where
/// the curvature binds, the velocity that it allows counts for more than the change of velocity.
const ACCELERATION_SHARE: f64 = 0.75;
const JERK_SHARE: f64 = 0.9;
/// The mixed term 3 q″ σ̇ σ̈ takes at most so much of the jerk where the curvature takes less.
const MIXED_SHARE: f64 = 0.2;

/// Reciprocals of the limits: 0 where an axis is unlimited.
#[derive(Debug, Clone, Copy)]
pub(super) struct Reciprocals {
    v: [f64; MAX_AXES],
    a: [f64; MAX_AXES],
    j: [f64; MAX_AXES],
}

impl Reciprocals {
    pub(super) fn of(limits: &AxisLimits) -> Self {
        let each = |values: &[f64; MAX_AXES]| values.map(|x| 1.0 / x);
        Self { v: each(&limits.velocity), a: each(&limits.acceleration), j: each(&limits.jerk) }
    }
}

/// The straight line from one node to the next.
#[derive(Debug, Clone, Copy)]
pub(super) struct Segment {
    /// dq/dσ of each axis.
    pub slope: Command,
    pub length: f64,
    pub feed: f64,
}

impl Segment {
    pub(super) fn between(from: &Command, node: &Node) -> Self {
        let mut slope = [0.0; MAX_AXES];
        for (i, s) in slope.iter_mut().enumerate() {
            *s = (node.command[i] - from[i]) / node.length;
        }
        Self { slope, length: node.length, feed: node.feed }
    }
}

/// How the path gets round a node.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Corner {
    /// There is none: the path goes straight on.
    None,
    /// A blend over ± this length.
    Blend(f64),
    /// It stops, because this axis may not leave the corner.
    Stop(usize),
}

/// The largest blend that each axis' tolerance and half of both segments allow,
/// docs/model.md eq. 42.
///
/// `least` is the shortest blend that differs from none.
pub(super) fn corner(node: &Node, before: &Segment, after: &Segment, least: f64) -> Corner {
    let half = 0.5 * before.length.min(after.length);
    let mut d = half;
    let (mut bends, mut tightest) = (false, 0);
    for i in 0..MAX_AXES {
        let (e, f) = (before.slope[i], after.slope[i]);
        let change = (f - e).abs();
        // Below this the change is rounding of the positions.
        let rounding = 4.0 * f64::EPSILON * node.command[i].abs() / half;
        if change <= 1e-12 * (e.abs() + f.abs()) + rounding {
            continue;
        }
        bends = true;
        let allowed = node.tolerance[i] * (16.0 / 3.0) / change;
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

/// A piece of the path with constant limits, and the axes that make them.
#[derive(Debug, Clone, Copy)]
pub(super) struct Piece {
    pub bounds: Bounds,
    /// What keeps V below the feed.
    pub velocity: Option<Limiting>,
    pub acceleration_axis: usize,
    pub jerk_axis: usize,
}

/// The largest of some numbers and where it is.
#[derive(Clone, Copy, Default)]
struct Largest {
    value: f64,
    axis: usize,
}

impl Largest {
    fn take(&mut self, value: f64, axis: usize) {
        if value > self.value {
            *self = Self { value, axis };
        }
    }

    /// 1/value, no more than a ceiling.
    fn reciprocal(self, ceiling: f64) -> f64 {
        if self.value * ceiling > 1.0 { 1.0 / self.value } else { ceiling }
    }
}

/// Limits on a straight piece: all that an axis has, docs/model.md eq. 43.
pub(super) fn straight(limits: &Reciprocals, segment: &Segment) -> Piece {
    let [mut v, mut a, mut j] = [Largest::default(); 3];
    for i in 0..MAX_AXES {
        let m = segment.slope[i].abs();
        v.take(m * limits.v[i], i);
        a.take(m * limits.a[i], i);
        j.take(m * limits.j[i], i);
    }
    let ceiling = segment.feed.min(CEILING.v);
    let velocity = v.reciprocal(ceiling);
    let kind = LimitKind::Velocity;
    Piece {
        bounds: Bounds { v: velocity, a: a.reciprocal(CEILING.a), j: j.reciprocal(CEILING.j) },
        velocity: (velocity < ceiling).then_some(Limiting { axis: v.axis, kind }),
        acceleration_axis: a.axis,
        jerk_axis: j.axis,
    }
}

/// Limits on a blend of half length d, docs/model.md eq. 43.
pub(super) fn blend(limits: &Reciprocals, before: &Segment, after: &Segment, d: f64) -> Piece {
    let [mut v, mut bend, mut twist] = [Largest::default(); 3];
    // |q′|, |q″|, |q‴| at most.
    let mut slope = [0.0_f64; MAX_AXES];
    let (mut second, mut third) = (slope, slope);
    let (k, c) = (0.75 / d, 1.5 / (d * d));
    for i in 0..MAX_AXES {
        let change = (after.slope[i] - before.slope[i]).abs();
        slope[i] = before.slope[i].abs().max(after.slope[i].abs());
        (second[i], third[i]) = (k * change, c * change);
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
    let mut a = Largest::default();
    for i in 0..MAX_AXES {
        let bending = second[i] * limits.a[i] * velocity * velocity;
        a.take(slope[i] * limits.a[i] / (1.0 - bending), i);
        let twisting = third[i] * limits.j[i] * velocity.powi(3);
        let mixed = 3.0 * second[i] * velocity * limits.j[i];
        a.take(mixed / MIXED_SHARE.max(0.5 * twisting), i);
    }
    let acceleration = a.reciprocal(CEILING.a);
    let mut j = Largest::default();
    for i in 0..MAX_AXES {
        let twisting = third[i] * limits.j[i] * velocity.powi(3);
        let mixed = 3.0 * second[i] * velocity * acceleration * limits.j[i];
        j.take(slope[i] * limits.j[i] / (1.0 - jerk_of_curvature(twisting, mixed)), i);
    }
    Piece {
        bounds: Bounds { v: velocity, a: acceleration, j: j.reciprocal(CEILING.j) },
        velocity: why,
        acceleration_axis: a.axis,
        jerk_axis: j.axis,
    }
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
        let change = (after.slope[i] - before.slope[i]).abs();
        let slope = before.slope[i].abs().max(after.slope[i].abs());
        v.take(slope * limits.v[i], i);
        bend.take(0.75 / d * change * limits.a[i], i);
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

/// q and its first three derivatives by σ at x = σ − σᵢ from a node, docs/model.md eq. 42.
pub(super) fn derivatives(at: &Command, slopes: [&Command; 2], d: f64, x: f64) -> [Command; 4] {
    let mut result = [[0.0; MAX_AXES]; 4];
    let inside = d > 0.0 && x.abs() < d;
    for i in 0..MAX_AXES {
        let (e, f) = (slopes[0][i], slopes[1][i]);
        let values = if inside {
            let (u, change) = ((x + d) / (2.0 * d), f - e);
            [
                at[i] + e * x + change * 2.0 * d * u * u * u * (1.0 - 0.5 * u),
                e + change * u * u * (3.0 - 2.0 * u),
                change * 6.0 * u * (1.0 - u) / (2.0 * d),
                change * (6.0 - 12.0 * u) / (4.0 * d * d),
            ]
        } else {
            let slope = if x < 0.0 { e } else { f };
            [at[i] + slope * x, slope, 0.0, 0.0]
        };
        for (row, value) in result.iter_mut().zip(values) {
            row[i] = value;
        }
    }
    result
}

#[cfg(test)]
mod tests {
    use super::*;

    fn segment(x: f64, y: f64, length: f64) -> Segment {
        Segment { slope: [x, y, 0.0, 0.0, 0.0, 0.0], length, feed: 50.0 }
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

    /// In the middle of that blend each axis is 3/16 · 0.16 = 0.03 off and has half its slope.
    #[test]
    fn the_middle_of_a_blend() {
        let (a, b) = (segment(1.0, 0.0, 10.0), segment(0.0, 1.0, 10.0));
        let [q, slope, second, third] = derivatives(&[0.0; 6], [&a.slope, &b.slope], 0.16, 0.0);
        assert!((q[0] + 0.03).abs() < 1e-15 && (q[1] - 0.03).abs() < 1e-15);
        assert!((slope[0] - 0.5).abs() < 1e-15 && third[0].abs() < 1e-9);
        assert!((second[1] - 0.75 / 0.16).abs() < 1e-12);
    }

    /// 45°: both axes may go 100/√½ = 141.4 mm/s; the feed of 50 mm/s is less.
    #[test]
    fn a_straight_piece() {
        let mut limits = AxisLimits::UNLIMITED;
        limits.velocity = [100.0; 6];
        let half = 0.5_f64.sqrt();
        let mut line = segment(half, half, 1.0);
        assert!(straight(&Reciprocals::of(&limits), &line).velocity.is_none());
        line.feed = 200.0;
        let piece = straight(&Reciprocals::of(&limits), &line);
        assert!((piece.bounds.v - 100.0 / half).abs() < 1e-9 && piece.velocity.is_some());
    }

    /// P = 0.6, Q = 0.4: u with |1−2u| = 0.75 gives 0.45 + 0.4·0.4375 = 0.625.
    #[test]
    fn the_jerk_terms_are_not_largest_together() {
        assert!((jerk_of_curvature(0.6, 0.4) - 0.625).abs() < 1e-15);
    }
}
