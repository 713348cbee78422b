//! What the axes allow on a piece of the path.

use super::element::{Part, Segment};
use super::scurve::{Bounds, ramp_length, ramp_time};
use super::{AxisLimits, LimitKind, Limiting};
use trueaxis_machine::axis::MAX_AXES;

/// Largest velocity, acceleration and jerk of the path where no axis limits it.
pub(super) const CEILING: Bounds = Bounds { v: 1e6, a: 1e9, j: 1e12 };

/// Shares of an axis' acceleration and jerk that a curve may take where they bind the velocity; the
/// rest speeds the path up and slows it down. The best of them is chosen for each arc.
const SHARES: [[f64; 2]; 4] = [[0.6, 0.4], [0.8, 0.6], [0.9, 0.8], [0.97, 0.93]];
/// The shares on an arc that is too short to start and stop on it.
const PASSED: usize = 1;
/// On a sampled curve.
const SAMPLED_SHARES: [f64; 2] = [0.75, 0.9];

/// Reciprocals of the limits: 0 where an axis is unlimited.
#[derive(Debug, Clone, Copy)]
pub(super) struct Reciprocals {
    pub v: [f64; MAX_AXES],
    pub a: [f64; MAX_AXES],
    pub j: [f64; MAX_AXES],
}

impl Reciprocals {
    pub(super) fn of(limits: &AxisLimits) -> Self {
        let each = |values: &[f64; MAX_AXES]| values.map(|x| 1.0 / x);
        Self { v: each(&limits.velocity), a: each(&limits.acceleration), j: each(&limits.jerk) }
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
pub(super) struct Largest {
    pub value: f64,
    pub axis: usize,
}

impl Largest {
    pub(super) fn take(&mut self, value: f64, axis: usize) {
        if value > self.value {
            *self = Self { value, axis };
        }
    }

    /// 1/value, no more than a ceiling.
    pub(super) fn reciprocal(self, ceiling: f64) -> f64 {
        if self.value * ceiling > 1.0 { 1.0 / self.value } else { ceiling }
    }
}

/// Limits on a straight piece: all that an axis has, docs/model.md eq. 43.
pub(super) fn straight(limits: &Reciprocals, segment: &Segment) -> Piece {
    let [mut v, mut a, mut j] = [Largest::default(); 3];
    for i in 0..MAX_AXES {
        let m = segment.element.begin.slope[i].abs();
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

/// Limits on a curved part of an element, docs/model.md eq. 43b.
pub(super) fn curved(limits: &Reciprocals, part: &Part, feed: f64) -> Piece {
    let [mut v, mut bend, mut twist] = [Largest::default(); 3];
    for i in 0..MAX_AXES {
        v.take((part.steady[i] + part.slope[i]) * limits.v[i], i);
        bend.take(part.bend[i] * limits.a[i], i);
        twist.take(part.twist[i] * limits.j[i], i);
    }
    let feed = feed.min(CEILING.v);
    let mut velocity = v.reciprocal(feed);
    let kind = LimitKind::Velocity;
    let why = (velocity < feed).then_some(Limiting { axis: v.axis, kind });
    velocity = velocity.min(CEILING.v);
    let with = |[a, j]: [f64; 2]| {
        let (mut velocity, mut why) = (velocity, why);
        if velocity * velocity * bend.value > a {
            velocity = (a / bend.value).sqrt();
            why = Some(Limiting { axis: bend.axis, kind: LimitKind::Corner });
        }
        if velocity.powi(3) * twist.value > j {
            velocity = (j / twist.value).cbrt();
            why = Some(Limiting { axis: twist.axis, kind: LimitKind::Corner });
        }
        changes(limits, part, velocity, why)
    };
    let free = velocity * velocity * bend.value <= SHARES[0][0]
        && velocity.powi(3) * twist.value <= SHARES[0][1];
    if free || !part.circular {
        return with(SAMPLED_SHARES);
    }
    let pieces = SHARES.map(with);
    let fits = |piece: &Piece| 2.0 * ramp_length(0.0, piece.bounds.v, &piece.bounds) < part.length;
    // From rest to rest along this part; a part too short for that is passed on the way.
    let cost_s = |piece: &Piece| {
        let Bounds { v, a, j } = piece.bounds;
        part.length / v + ramp_time(v, a, j)
    };
    let candidates = pieces.iter().filter(|piece| fits(piece));
    let best = candidates.min_by(|one, other| cost_s(one).total_cmp(&cost_s(other)));
    *best.unwrap_or(&pieces[PASSED])
}

/// What a curve at a velocity leaves for its changes, docs/model.md eq. 43b.
fn changes(limits: &Reciprocals, part: &Part, v: f64, velocity: Option<Limiting>) -> Piece {
    let (mut a, mut acceleration_axis) = (CEILING.a, 0);
    for i in 0..MAX_AXES {
        let (c, m) = (part.steady[i] * limits.a[i], part.slope[i] * limits.a[i]);
        let s = part.bend[i] * limits.a[i] * v * v;
        let most = match part.circular {
            // (m a)² + s² = (1 − c a)²
            true => root([m * m - c * c, 2.0 * c, s * s - 1.0]),
            false => (1.0 - s) / (c + m),
        };
        if most < a {
            (a, acceleration_axis) = (most, i);
        }
    }
    let (mut j, mut jerk_axis) = (CEILING.j, 0);
    for i in 0..MAX_AXES {
        let (c, m) = (part.steady[i] * limits.j[i], part.slope[i] * limits.j[i]);
        let t = part.twist[i] * limits.j[i] * v * v * v;
        // 3 q″ σ̇ σ̈, where σ̇ σ̈ ≤ MIXED V^1.5 √J in a change of velocity, and ≤ V A.
        let mixed = 3.0 * part.bend[i] * limits.j[i];
        let (by_ramp, by_bound) = (mixed * MIXED * v * v.sqrt(), mixed * v * a);
        let most = match part.circular {
            // (m j + t)² + mixed² = (1 − c j)², with mixed² = by_ramp² j or by_bound²
            true => {
                let (square, line) = (m * m - c * c, 2.0 * (m * t + c));
                root([square, line + by_ramp * by_ramp, t * t - 1.0]).max(root([
                    square,
                    line,
                    t * t + by_bound * by_bound - 1.0,
                ]))
            }
            // (c + m) j + t + mixed = 1
            false => {
                let x = root([c + m, by_ramp, t - 1.0]);
                (x * x).max((1.0 - t - by_bound) / (c + m))
            }
        };
        if most < j {
            (j, jerk_axis) = (most, i);
        }
    }
    Piece { bounds: Bounds { v, a, j }, velocity, acceleration_axis, jerk_axis }
}

/// The largest σ̇ σ̈ of a change of velocity up to V with jerk J is √(8/27) V^1.5 √J: its second half is
/// σ̇ = V − σ̈²/(2J).
const MIXED: f64 = 0.544_331_053_951_817_4;

/// The positive root of p x² + q x + r = 0 for q ≥ 0, r ≤ 0; 0 where there is none, infinite where
/// nothing binds.
fn root([p, q, r]: [f64; 3]) -> f64 {
    if r >= 0.0 {
        return 0.0;
    }
    -2.0 * r / (q + (q * q - 4.0 * p * r).max(0.0).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::timing::Turn;

    fn segment(x: f64, y: f64, feed: f64) -> Segment {
        let to = [x, y, 0.0, 0.0, 0.0, 0.0];
        let element = super::super::Element::straight(&[0.0; 6], &to, 1.0);
        Segment { element, length: 1.0, feed }
    }

    /// 45°: both axes may go 100/√½ = 141.4 mm/s; the feed of 50 mm/s is less.
    #[test]
    fn a_straight_piece() {
        let mut limits = AxisLimits::UNLIMITED;
        limits.velocity = [100.0; 6];
        let half = 0.5_f64.sqrt();
        let line = segment(half, half, 50.0);
        assert!(straight(&Reciprocals::of(&limits), &line).velocity.is_none());
        let piece = straight(&Reciprocals::of(&limits), &segment(half, half, 200.0));
        assert!((piece.bounds.v - 100.0 / half).abs() < 1e-9 && piece.velocity.is_some());
    }

    /// Radius 20 at 100 mm/s: v²/r = 500 of 2000 mm/s² leaves √(2000² − 500²) = 1936 mm/s²; of
    /// 20,000 mm/s³ the curve takes v³/r² = 2500.
    #[test]
    fn a_circle_far_from_the_limits() {
        let mut limits = AxisLimits::UNLIMITED;
        limits.acceleration = [2000.0; 6];
        limits.jerk = [20_000.0; 6];
        let circle = Turn {
            length: 125.0,
            rate: 0.05,
            cos: [20.0, 0.0, 0.0, 0.0, 0.0, 0.0],
            sin: [0.0, 20.0, 0.0, 0.0, 0.0, 0.0],
            steady: [0.0; 6],
            growth: 0.0,
        };
        let part = circle.element().parts[0];
        let Bounds { v, a, j } = curved(&Reciprocals::of(&limits), &part, 100.0).bounds;
        assert!(v == 100.0 && (a - 3.75e6_f64.sqrt()).abs() < 1e-9);
        // (j + 2500)² + (3 · 0.05 · 0.5443 · 1000 √j)² = 20000²
        let used = (j + 2500.0).hypot(0.15 * MIXED * 1000.0 * j.sqrt());
        assert!((used - 20_000.0).abs() < 1e-6, "{j}");
        // So fast that the curve takes most: no more than the limits.
        let fast = curved(&Reciprocals::of(&limits), &part, 1e3).bounds;
        assert!(fast.v < 200.0 && fast.v > 0.7 * 200.0 && fast.j > 0.0, "{fast:?}");
    }
}
