//! The smallest enclosing circle: grow from a pair, take in the farthest point, repeat.
//!
//! Each round replaces the circle by the smallest one around its two or three contact points and
//! the farthest point; its radius grows, so the rounds end. The answer is then proven by itself:
//! it holds all points and is the smallest around its contacts.

use super::Cloud;

#[derive(Debug, Clone, Copy)]
struct Enclosing {
    center: [f64; 2],
    square: f64,
    contacts: [usize; 3],
    count: usize,
}

/// The centre of the smallest circle around all points.
pub(super) fn center(cloud: &Cloud) -> [f64; 2] {
    let (first, _) = farthest(cloud, [0.0, 0.0]);
    let (second, _) = farthest(cloud, cloud.point(first));
    let mut circle = Enclosing::pair(cloud, first, second);
    let mut best = (f64::INFINITY, circle.center);
    // Every round has a larger circle, but on nearly perfect circles by less than one rounding
    // step; so the centre that leaves least outside is kept, and the limit ends a tie.
    for _ in 0..20 + 4 * cloud.len() {
        let (outside, square) = farthest(cloud, circle.center);
        if square < best.0 {
            best = (square, circle.center);
        }
        if square <= circle.square * (1.0 + 4.0 * f64::EPSILON) {
            break;
        }
        match circle.with(cloud, outside) {
            Some(larger) => circle = larger,
            None => break,
        }
    }
    best.1
}

fn farthest(cloud: &Cloud, from: [f64; 2]) -> (usize, f64) {
    let mut best = (0, -1.0);
    for (i, (x, y)) in cloud.x.iter().zip(&cloud.y).enumerate() {
        let (dx, dy) = (x - from[0], y - from[1]);
        let square = dx * dx + dy * dy;
        if square > best.1 {
            best = (i, square);
        }
    }
    best
}

fn square(cloud: &Cloud, i: usize, center: [f64; 2]) -> f64 {
    let (x, y) = (cloud.x[i] - center[0], cloud.y[i] - center[1]);
    x * x + y * y
}

impl Enclosing {
    fn pair(cloud: &Cloud, a: usize, b: usize) -> Self {
        let (p, q) = (cloud.point(a), cloud.point(b));
        let center = [0.5 * (p[0] + q[0]), 0.5 * (p[1] + q[1])];
        let square = square(cloud, a, center).max(square(cloud, b, center));
        Self { center, square, contacts: [a, b, b], count: 2 }
    }

    fn triple(cloud: &Cloud, contacts: [usize; 3]) -> Option<Self> {
        let center = cloud.circumcenter(contacts)?;
        let square = contacts.iter().map(|&i| square(cloud, i, center)).fold(0.0, f64::max);
        Some(Self { center, square, contacts, count: 3 })
    }

    fn holds(&self, cloud: &Cloud, points: &[usize]) -> bool {
        let limit = self.square * (1.0 + 8.0 * f64::EPSILON);
        points.iter().all(|&i| square(cloud, i, self.center) <= limit)
    }

    /// The smallest circle around the contacts and one more point, which becomes a contact.
    fn with(&self, cloud: &Cloud, new: usize) -> Option<Self> {
        let old = &self.contacts[..self.count];
        let mut best: Option<Self> = None;
        let mut offer = |circle: Self| {
            if circle.holds(cloud, old) && best.is_none_or(|b| circle.square < b.square) {
                best = Some(circle);
            }
        };
        for (k, &a) in old.iter().enumerate() {
            offer(Self::pair(cloud, new, a));
            for &b in &old[k + 1..] {
                if let Some(circle) = Self::triple(cloud, [new, a, b]) {
                    offer(circle);
                }
            }
        }
        best
    }
}
