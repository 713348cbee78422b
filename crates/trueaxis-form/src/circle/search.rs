//! The exhaustive way: branch and bound over all centres, for points that are hardly a circle.
//!
//! A square of centres with half diagonal h can hold no better centre than its middle improved by
//! h (inscribed radius) or 2h (zone width); only points within 2h of the nearest (farthest) one
//! can be contacts anywhere in it. Squares are split until few points are left; then every
//! combination of contacts is tried. Nothing is skipped that could be better.

use super::{Cloud, circumscribed, cross, meet};
use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// Squares split at most this often; beyond it the middle is the answer to 1e-14 of the size.
const DEEPEST: u32 = 48;
/// A guard against endless work on points that are all ties.
const MOST_SQUARES: usize = 400_000;

struct Square {
    /// The best that any centre in here can be; larger is better.
    promise: f64,
    nearest: f64,
    farthest: f64,
    center: [f64; 2],
    half: f64,
    depth: u32,
    near: Vec<u32>,
    far: Vec<u32>,
}

impl Square {
    #[expect(clippy::cast_possible_truncation, reason = "a section has far fewer than 2^32 points")]
    fn root(cloud: &Cloud) -> Self {
        let center = circumscribed::center(cloud);
        let all: Vec<u32> = (0..cloud.len() as u32).collect();
        let half = all.iter().map(|&i| cloud.distance(i as usize, center)).fold(0.0, f64::max);
        let (promise, nearest, farthest) = (0.0, 0.0, 0.0);
        let (near, depth) = (all.clone(), 0);
        Self { promise, nearest, farthest, center, half, depth, near, far: all }
    }

    fn half_diagonal(&self) -> f64 {
        self.half * std::f64::consts::SQRT_2
    }

    /// Keeps the points that can be nearest or farthest in here, and their distances.
    fn sift(&mut self, cloud: &Cloud) {
        let reach = 2.0 * self.half_diagonal();
        let center = self.center;
        let distance = |i: &u32| cloud.distance(*i as usize, center);
        let nearest = self.near.iter().map(distance).fold(f64::INFINITY, f64::min);
        let farthest = self.far.iter().map(distance).fold(0.0, f64::max);
        let noise = 1e-15 * (farthest + cloud.size);
        self.near.retain(|i| distance(i) <= nearest + reach + noise);
        self.far.retain(|i| distance(i) >= farthest - reach - noise);
        (self.nearest, self.farthest) = (nearest, farthest);
    }

    fn quarters(self) -> impl Iterator<Item = Self> {
        let half = 0.5 * self.half;
        [[-half, -half], [-half, half], [half, -half], [half, half]].into_iter().map(move |by| {
            Self {
                promise: self.promise,
                nearest: self.nearest,
                farthest: self.farthest,
                center: [self.center[0] + by[0], self.center[1] + by[1]],
                half,
                depth: self.depth + 1,
                near: self.near.clone(),
                far: self.far.clone(),
            }
        })
    }

    /// Whether a centre is in here, but for the rounding of its own computation.
    fn holds(&self, cloud: &Cloud, center: [f64; 2]) -> bool {
        let reach = self.half + 1e-12 * cloud.size;
        (center[0] - self.center[0]).abs() <= reach && (center[1] - self.center[1]).abs() <= reach
    }
}

impl PartialEq for Square {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}
impl Eq for Square {}
impl PartialOrd for Square {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}
impl Ord for Square {
    fn cmp(&self, other: &Self) -> Ordering {
        self.promise.total_cmp(&other.promise)
    }
}

/// The best centre within the enclosing circle, or the one given if that is better.
pub(super) fn minimum_zone(cloud: &Cloud, known: Option<[f64; 2]>) -> Option<[f64; 2]> {
    let mut best = known.map(|center| (width(cloud, center), center));
    let mut open = BinaryHeap::new();
    let enter = |mut square: Square, open: &mut BinaryHeap<Square>| {
        square.sift(cloud);
        square.promise = 2.0 * square.half_diagonal() - (square.farthest - square.nearest);
        open.push(square);
    };
    enter(Square::root(cloud), &mut open);
    for _ in 0..MOST_SQUARES {
        let Some(square) = open.pop() else { break };
        if best.is_some_and(|(width, _)| -square.promise >= width) {
            break;
        }
        let width = square.farthest - square.nearest;
        if square.depth >= DEEPEST {
            if width <= 1e-12 * square.farthest {
                offer(&mut best, (width, square.center));
            }
        } else if square.near.len() <= 4 && square.far.len() <= 4 {
            try_zones(cloud, &square, &mut best);
        } else {
            square.quarters().for_each(|quarter| enter(quarter, &mut open));
        }
    }
    best.map(|(_, center)| center)
}

fn offer(best: &mut Option<(f64, [f64; 2])>, candidate: (f64, [f64; 2])) {
    if best.is_none_or(|(width, _)| candidate.0 < width) {
        *best = Some(candidate);
    }
}

fn width(cloud: &Cloud, center: [f64; 2]) -> f64 {
    let mut range = (f64::INFINITY, 0.0);
    for i in 0..cloud.len() {
        let d = cloud.distance(i, center);
        range = (f64::min(range.0, d), f64::max(range.1, d));
    }
    range.1 - range.0
}

/// Every outer pair with every inner pair.
fn try_zones(cloud: &Cloud, square: &Square, best: &mut Option<(f64, [f64; 2])>) {
    for (outer, inner) in pairs(&square.far).flat_map(|o| pairs(&square.near).map(move |i| (o, i)))
    {
        let ends = |pair: [usize; 2]| (cloud.point(pair[0]), cloud.point(pair[1]));
        let Some(center) = meet([ends(outer), ends(inner)]) else { continue };
        if square.holds(cloud, center) && takes_turns(cloud, center, outer, inner) {
            offer(best, (width(cloud, center), center));
        }
    }
}

fn pairs(points: &[u32]) -> impl Iterator<Item = [usize; 2]> {
    let one =
        move |a: usize| points[a + 1..].iter().map(move |b| [points[a] as usize, *b as usize]);
    (0..points.len()).flat_map(one)
}

/// Whether the pairs are the farthest and nearest points and lie crosswise seen from the centre.
fn takes_turns(cloud: &Cloud, center: [f64; 2], outer: [usize; 2], inner: [usize; 2]) -> bool {
    let zone = width(cloud, center);
    let contact = cloud.distance(outer[0], center) - cloud.distance(inner[0], center);
    if (zone - contact).abs() > 1e-12 * (cloud.size + contact.abs()) {
        return false;
    }
    if zone <= 1e-13 * cloud.size {
        return true;
    }
    let unit = |i: usize| {
        let (p, d) = (cloud.point(i), cloud.distance(i, center).max(f64::MIN_POSITIVE));
        [(p[0] - center[0]) / d, (p[1] - center[1]) / d]
    };
    let [a, b, c, d] = [unit(outer[0]), unit(outer[1]), unit(inner[0]), unit(inner[1])];
    let side = |p: [f64; 2], q: [f64; 2], r: [f64; 2]| {
        cross([q[0] - p[0], q[1] - p[1]], [r[0] - p[0], r[1] - p[1]])
    };
    side(a, b, c) * side(a, b, d) <= 0.0 && side(c, d, a) * side(c, d, b) <= 0.0
}

/// The centre of the largest empty circle that has contact points on all sides.
pub(super) fn maximum_inscribed(cloud: &Cloud) -> Option<[f64; 2]> {
    let mut best: Option<(f64, [f64; 2])> = None;
    let mut open = BinaryHeap::new();
    let enter = |mut square: Square, open: &mut BinaryHeap<Square>| {
        square.sift(cloud);
        square.promise = square.nearest + square.half_diagonal();
        if !one_sided(cloud, &square) {
            open.push(square);
        }
    };
    let mut root = Square::root(cloud);
    root.far.clear();
    enter(root, &mut open);
    for _ in 0..MOST_SQUARES {
        let Some(square) = open.pop() else { break };
        if best.is_some_and(|(radius, _)| square.promise <= radius) {
            break;
        }
        if square.depth >= DEEPEST {
            if best.is_none_or(|(radius, _)| square.nearest > radius) {
                best = Some((square.nearest, square.center));
            }
        } else if square.near.len() <= 6 {
            try_inscribed(cloud, &square, &mut best);
        } else {
            square.quarters().for_each(|quarter| enter(quarter, &mut open));
        }
    }
    best.map(|(_, center)| center)
}

/// Whether from everywhere in the square all possible contacts are on one side of it.
fn one_sided(cloud: &Cloud, square: &Square) -> bool {
    if square.nearest <= square.half_diagonal() {
        return false;
    }
    let relative = |i: u32| {
        let p = cloud.point(i as usize);
        [p[0] - square.center[0], p[1] - square.center[1]]
    };
    let mean = square.near.iter().fold([0.0; 2], |s, &i| {
        let p = relative(i);
        [s[0] + p[0], s[1] + p[1]]
    });
    let length = mean[0].hypot(mean[1]);
    let ahead = |i: &u32| {
        let p = relative(*i);
        (p[0] * mean[0] + p[1] * mean[1]) / length
    };
    length > 0.0
        && square.near.iter().map(ahead).fold(f64::INFINITY, f64::min) > square.half_diagonal()
}

fn try_inscribed(cloud: &Cloud, square: &Square, best: &mut Option<(f64, [f64; 2])>) {
    let near = &square.near;
    for (a, [b, c]) in (0..near.len())
        .flat_map(|k| pairs(&near[k + 1..]).map(move |pair| (near[k] as usize, pair)))
    {
        let Some(center) = cloud.circumcenter([a, b, c]) else { continue };
        let radius = cloud.distance(a, center);
        let empty = near
            .iter()
            .all(|&i| cloud.distance(i as usize, center) >= radius - 1e-14 * (radius + cloud.size));
        if empty
            && square.holds(cloud, center)
            && surrounds(cloud, center, [a, b, c])
            && best.is_none_or(|(r, _)| radius > r)
        {
            *best = Some((radius, center));
        }
    }
}

fn surrounds(cloud: &Cloud, center: [f64; 2], contacts: [usize; 3]) -> bool {
    let [a, b, c] = contacts.map(|i| {
        let p = cloud.point(i);
        [p[0] - center[0], p[1] - center[1]]
    });
    let turns = [cross(a, b), cross(b, c), cross(c, a)];
    let noise = 1e-12 * cloud.size * cloud.size;
    turns.iter().all(|t| *t >= -noise) || turns.iter().all(|t| *t <= noise)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::circle::Fitter;

    /// Fast and exhaustive ways must agree where both work, ovals with their ridges included.
    #[test]
    fn agrees_with_the_fast_way() {
        for (lobes, count) in [(2.0, 24), (3.0, 31), (5.0, 40), (2.0, 72), (7.0, 16)] {
            let point = |i: u32| {
                let angle = f64::from(i) * std::f64::consts::TAU / f64::from(count);
                let r = 20.0 + 0.1 * (lobes * angle + 0.3).cos() + 0.001 * f64::from(i * i % 17);
                [r * angle.cos(), r * angle.sin()]
            };
            let points: Vec<_> = (0..count).map(point).collect();
            let circles = Fitter::default().all(&points).unwrap();
            let mut cloud = Cloud::default();
            cloud.load(&points).unwrap();
            let zone = minimum_zone(&cloud, None).unwrap();
            assert!((width(&cloud, zone) - circles.mzc.width_mm()).abs() < 1e-12);
            let center = maximum_inscribed(&cloud).unwrap();
            let radius =
                (0..cloud.len()).map(|i| cloud.distance(i, center)).fold(f64::INFINITY, f64::min);
            assert!((radius - circles.mic.radius_mm).abs() < 1e-12, "{lobes} lobes");
        }
    }
}
