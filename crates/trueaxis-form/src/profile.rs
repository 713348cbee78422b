//! The two parallel lines of a profile that are closest together (docs/model.md eq. 228): exact, by its convex hull.

/// A strip around points of a plane.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Strip {
    /// Direction of the lines, a unit vector.
    pub direction: [f64; 2],
    /// The two points of one line, and that of the other.
    pub contacts: [usize; 3],
    pub width: f64,
}

/// The narrowest strip: one line goes through an edge of the convex hull, the other through a corner.
pub(crate) fn narrowest(points: &[[f64; 2]]) -> Option<Strip> {
    let hull = hull(points);
    let n = hull.len();
    if n < 2 {
        return None;
    }
    let off = |i: usize, a: usize, b: usize| {
        let (p, q, r) = (points[hull[i]], points[hull[a]], points[hull[b]]);
        let (dx, dy) = (r[0] - q[0], r[1] - q[1]);
        (dx * (p[1] - q[1]) - dy * (p[0] - q[0])) / dx.hypot(dy)
    };
    let mut best: Option<Strip> = None;
    let mut far = 1;
    for a in 0..n {
        let b = (a + 1) % n;
        // The farthest corner moves on with the edge.
        let mut turns = 0;
        while turns < n && off((far + 1) % n, a, b) >= off(far % n, a, b) {
            far += 1;
            turns += 1;
        }
        let width = off(far % n, a, b).abs();
        if best.is_none_or(|s| width < s.width) {
            let (q, r) = (points[hull[a]], points[hull[b]]);
            let (dx, dy) = (r[0] - q[0], r[1] - q[1]);
            let length = dx.hypot(dy);
            let contacts = [hull[a], hull[b], hull[far % n]];
            best = Some(Strip { direction: [dx / length, dy / length], contacts, width });
        }
    }
    best
}

/// Corners of the convex hull, counter-clockwise (Andrew 1979).
fn hull(points: &[[f64; 2]]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..points.len()).collect();
    order.sort_by(|a, b| {
        let (a, b) = (points[*a], points[*b]);
        a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1]))
    });
    order.dedup_by(|a, b| points[*a] == points[*b]);
    if order.len() < 3 {
        return order;
    }
    let turns_left = |o: usize, a: usize, b: usize| {
        let (o, a, b) = (points[o], points[a], points[b]);
        (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0]) > 0.0
    };
    let chain = |order: &mut dyn Iterator<Item = usize>| {
        let mut chain: Vec<usize> = Vec::new();
        for i in order {
            while chain.len() > 1 && !turns_left(chain[chain.len() - 2], chain[chain.len() - 1], i)
            {
                chain.pop();
            }
            chain.push(i);
        }
        chain.pop();
        chain
    };
    let mut lower = chain(&mut order.iter().copied());
    lower.extend(chain(&mut order.iter().rev().copied()));
    lower
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_triangle_is_as_wide_as_its_least_height() {
        // Sides 3, 4, 5: heights 4, 3 and 12/5.
        let strip = narrowest(&[[0.0, 0.0], [3.0, 0.0], [0.0, 4.0], [1.0, 1.0]]).unwrap();
        assert!((strip.width - 2.4).abs() < 1e-15 && strip.contacts[2] == 0);
    }
}
