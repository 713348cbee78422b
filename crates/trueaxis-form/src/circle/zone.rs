//! The minimum zone: exchange of contact points, then a proof.
//!
//! To first order in a shift δ of the centre the deviations are dᵢ − ρ − uᵢ·δ: a Chebyshev
//! approximation by 1, cos φ, sin φ. Its optimum touches four points that take turns outside,
//! inside, outside, inside (the functions are a Haar system on the circle), so that an entering
//! point always replaces its neighbour of the same side. The centre that belongs to four such
//! points is exact without iteration: the bisector of the outer pair meets that of the inner
//! pair. The distances are computed again there, and the exchange continues until all points are inside.
//!
//! **Proof.** At the centre found, width w, inner radius r, let s be the distance of the origin
//! from the edges of the parallelogram {u_inner − u_outer}. Because a distance is convex and bends
//! by at most 1/r, for every other centre at δ
//!
//! ```text
//! w(δ) ≥ w + s |δ| − |δ|²/(2r)             > w for 0 < |δ| < 2 r s
//! w(δ) ≥ |δ − far side| − |δ − near side|, growing in |δ|, where points are at most a
//!        half gap g away from the line of δ
//! ```
//!
//! If the second bound beats w at |δ| = 2 r s, no centre in the plane is better.

use super::{Cloud, HalfGap, Polar, cross, meet};

/// A centre whose contact points take turns.
#[derive(Debug, Clone, Copy)]
pub(super) struct Found {
    pub(super) center: [f64; 2],
    /// Whether no other centre in the plane can be better.
    pub(super) proven: bool,
}

/// Four points in angular order; 0 and 2 on one side, 1 and 3 on the other.
type Turn = [usize; 4];

/// The levelled solution of four points: shift of the centre, mid radius, ± half width.
struct Level {
    shift: [f64; 2],
    radius: f64,
    half: f64,
}

/// The centre of the minimum zone; expects `polar` about a centre near it.
pub(super) fn center(cloud: &Cloud, polar: &mut Polar, angles: &mut Vec<f64>) -> Option<Found> {
    let quarters = polar.quarters();
    let distinct = (0..4).all(|k| !quarters[..k].contains(&quarters[k]));
    let mut turn = if distinct { quarters } else { spread(polar) };
    let mut best = None;
    for _ in 0..30 {
        let half = exchange(polar, &mut turn)?;
        let [a, b, c, d] = turn;
        let center = meet([(cloud.point(a), cloud.point(c)), (cloud.point(b), cloud.point(d))])?;
        polar.about(cloud, center);
        let (outer, inner) = if half >= 0.0 { ([a, c], [b, d]) } else { ([b, d], [a, c]) };
        let noise = 8.0 * f64::EPSILON * polar.max.max(cloud.size);
        let touches = polar.max - polar.distance[outer[0]] <= noise
            && polar.distance[inner[0]] - polar.min <= noise;
        if touches {
            best = Some((center, outer, inner));
            break;
        }
    }
    let (center, outer, inner) = best?;
    let sharpness = sharpness(polar, outer, inner);
    if sharpness <= 0.0 && polar.max - polar.min > 1e-13 * polar.max {
        return None;
    }
    let proven = is_global(polar, sharpness, polar.half_gap(angles));
    Some(Found { center, proven })
}

/// Four points apart from each other on an arc.
fn spread(polar: &Polar) -> Turn {
    let mut order: Vec<usize> = (0..polar.len()).collect();
    order.sort_by(|&a, &b| {
        turn_angle(polar.direction(a)).total_cmp(&turn_angle(polar.direction(b)))
    });
    let last = order.len() - 1;
    [order[0], order[last / 3], order[2 * last / 3], order[last]]
}

/// Exchanges points until none sticks out of the levelled zone; its signed half width.
fn exchange(polar: &Polar, turn: &mut Turn) -> Option<f64> {
    let noise = 4.0 * f64::EPSILON * polar.max;
    let mut last = -1.0;
    for _ in 0..20 + 4 * polar.len() {
        sort(polar, turn);
        let level = level(polar, turn)?;
        if level.half.abs() < last - noise {
            return None;
        }
        last = level.half.abs();
        let (point, residual) = worst(polar, &level);
        if residual.abs() <= last + noise || turn.contains(&point) {
            return Some(level.half);
        }
        replace(polar, turn, (point, residual), level.half);
    }
    None
}

fn level(polar: &Polar, turn: &Turn) -> Option<Level> {
    let [d0, d1, d2, d3] = turn.map(|i| polar.distance[i]);
    let [u0, u1, u2, u3] = turn.map(|i| polar.direction(i));
    let (a, b) = ([u0[0] - u2[0], u0[1] - u2[1]], [u1[0] - u3[0], u1[1] - u3[1]]);
    let determinant = cross(a, b);
    if determinant.abs() < 1e-10 {
        return None;
    }
    let (e, f) = (d0 - d2, d1 - d3);
    let shift = [(e * b[1] - a[1] * f) / determinant, (a[0] * f - e * b[0]) / determinant];
    let rest = |d: f64, u: [f64; 2]| d - u[0] * shift[0] - u[1] * shift[1];
    let (even, odd) = (rest(d0, u0), rest(d1, u1));
    Some(Level { shift, radius: 0.5 * (even + odd), half: 0.5 * (even - odd) })
}

/// The point with the largest deviation from the levelled circle.
fn worst(polar: &Polar, level: &Level) -> (usize, f64) {
    let ([sx, sy], radius) = (level.shift, level.radius);
    let n = polar.len();
    let (ds, us, vs) = (&polar.distance[..n], &polar.ux[..n], &polar.uy[..n]);
    let (mut high, mut low) = ((0, f64::NEG_INFINITY), (0, f64::INFINITY));
    for i in 0..n {
        let residual = ds[i] - us[i] * sx - vs[i] * sy;
        if residual > high.1 {
            high = (i, residual);
        }
        if residual < low.1 {
            low = (i, residual);
        }
    }
    let (above, below) = (high.1 - radius, radius - low.1);
    if above >= below { (high.0, above) } else { (low.0, -below) }
}

/// The entering point takes the place of its neighbour on the same side of the circle.
fn replace(polar: &Polar, turn: &mut Turn, (point, residual): (usize, f64), half: f64) {
    let angle = turn_angle(polar.direction(point));
    let next = turn.iter().position(|&i| turn_angle(polar.direction(i)) > angle).unwrap_or(0);
    let before = (next + 3) % 4;
    let sign = |k: usize| if k.is_multiple_of(2) { half } else { -half };
    let place = if (sign(next) > 0.0) == (residual > 0.0) { next } else { before };
    turn[place] = point;
}

fn sort(polar: &Polar, turn: &mut Turn) {
    // Four elements and nearly always in order already.
    for end in 1..4 {
        let mut k = end;
        while k > 0
            && turn_angle(polar.direction(turn[k])) < turn_angle(polar.direction(turn[k - 1]))
        {
            turn.swap(k, k - 1);
            k -= 1;
        }
    }
}

/// Grows with the angle of a direction from 0 to 4, without trigonometry.
fn turn_angle([x, y]: [f64; 2]) -> f64 {
    let part = y / (x.abs() + y.abs()).max(f64::MIN_POSITIVE);
    match (x >= 0.0, y >= 0.0) {
        (true, true) => part,
        (false, _) => 2.0 - part,
        (true, false) => 4.0 + part,
    }
}

/// By how much the zone widens at least per mm of shift; ≤ 0 if the contacts do not take turns.
fn sharpness(polar: &Polar, outer: [usize; 2], inner: [usize; 2]) -> f64 {
    let difference = |i: usize, o: usize| {
        let (p, q) = (polar.direction(i), polar.direction(o));
        [p[0] - q[0], p[1] - q[1]]
    };
    let corners = [
        difference(inner[0], outer[0]),
        difference(inner[0], outer[1]),
        difference(inner[1], outer[1]),
        difference(inner[1], outer[0]),
    ];
    let edge = |k: usize| {
        let (a, b) = (corners[k], corners[(k + 1) % 4]);
        let length = (a[0] - b[0]).hypot(a[1] - b[1]).max(f64::MIN_POSITIVE);
        cross(a, b) / length
    };
    let edges = [edge(0), edge(1), edge(2), edge(3)];
    let (low, high) =
        edges.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), &e| (l.min(e), h.max(e)));
    low.max(-high)
}

fn is_global(polar: &Polar, sharpness: f64, gap: HalfGap) -> bool {
    let (inner, outer) = (polar.min, polar.max);
    if gap.cos <= 0.0 || sharpness <= 0.0 {
        return false;
    }
    let shift = 2.0 * inner * sharpness;
    let side = |q: f64, sign: f64| {
        (q * q + sign * 2.0 * q * shift * gap.cos + shift * shift).max(0.0).sqrt()
    };
    let near = side(inner, -1.0).max(side(outer, -1.0));
    side(inner, 1.0) - near > (outer - inner) * (1.0 + 1e-9) + 8.0 * f64::EPSILON * outer
}
