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
///
/// Points that lie on one line to rounding have a hull with edges of no length, whose direction is chance: from such an edge the
/// farthest corner cannot be followed to the next one. So it is searched among all corners, at every edge of a small hull, and at the
/// best edge of a large one.
pub(crate) fn narrowest(points: &[[f64; 2]]) -> Option<Strip> {
    let hull: Vec<[f64; 3]> =
        hull(points).into_iter().map(|i| [points[i][0], points[i][1], i as f64]).collect();
    if hull.len() < 2 {
        return None;
    }
    if hull.len() > MOST_CORNERS
        && let Some(strip) = by_turning(&hull)
    {
        return Some(strip);
    }
    let strips = (0..hull.len()).map(|a| strip(&hull, a, farthest(&hull, a)));
    strips.min_by(|a, b| a.width.total_cmp(&b.width))
}

/// Up to so many corners each edge is compared with all of them.
const MOST_CORNERS: usize = 2000;

/// How far a corner is from the line through the edge that begins at another.
fn off(hull: &[[f64; 3]], corner: usize, edge: usize) -> f64 {
    let n = hull.len();
    let (p, q, r) = (hull[corner % n], hull[edge], hull[(edge + 1) % n]);
    let (dx, dy) = (r[0] - q[0], r[1] - q[1]);
    (dx * (p[1] - q[1]) - dy * (p[0] - q[0])) / dx.hypot(dy)
}

/// The corner that is farthest from the line through an edge, on whichever side: rounding may leave one on the other side.
fn farthest(hull: &[[f64; 3]], edge: usize) -> usize {
    let corners = (0..hull.len()).map(|i| (i, off(hull, i, edge).abs()));
    corners.max_by(|a, b| a.1.total_cmp(&b.1)).map_or(0, |(i, _)| i)
}

fn strip(hull: &[[f64; 3]], edge: usize, far: usize) -> Strip {
    let n = hull.len();
    let (q, r) = (hull[edge], hull[(edge + 1) % n]);
    let (dx, dy) = (r[0] - q[0], r[1] - q[1]);
    let length = dx.hypot(dy);
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "numbers of points, which they were before"
    )]
    let contacts = [q, r, hull[far % n]].map(|corner| corner[2] as usize);
    let width = off(hull, far, edge).abs();
    Strip { direction: [dx / length, dy / length], contacts, width }
}

/// The farthest corner moves on with the edge; `None` where rounding has led it astray.
fn by_turning(hull: &[[f64; 3]]) -> Option<Strip> {
    let n = hull.len();
    let (mut far, mut best) = (1, (0, 1, f64::INFINITY));
    for edge in 0..n {
        let mut turns = 0;
        while turns < n && off(hull, far + 1, edge) >= off(hull, far, edge) {
            far += 1;
            turns += 1;
        }
        let width = off(hull, far, edge).abs();
        if width < best.2 {
            best = (edge, far, width);
        }
    }
    let (edge, far, width) = best;
    let whole = off(hull, farthest(hull, edge), edge).abs();
    (whole <= width * (1.0 + 1e-9)).then(|| strip(hull, edge, far))
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

    /// A wall of 90 mm that is flat to a tenth of a nanometre, its points doubled to rounding: no direction but that along it is narrow.
    /// Every turn, shift and size of the wall must tell the same.
    #[test]
    fn law_a_wall_that_is_flat_to_rounding_is_narrow() {
        let mut state = 3_u64;
        let mut unit = || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1_u64 << 53) as f64
        };
        for round in 0..2000 {
            let (size, turn) = (10_f64.powf(4.0 * unit() - 1.0), 7.0 * unit());
            let (sin, cos) = turn.sin_cos();
            let (shift, rough) = (size * unit(), size * 10_f64.powf(-16.0 + 8.0 * unit()));
            let mut points = Vec::new();
            for k in 0..41 {
                for _ in 0..9 {
                    let (along, across) = (size * f64::from(k) / 40.0, rough * unit());
                    points.push([along * cos - across * sin + shift, along * sin + across * cos]);
                }
            }
            let strip = narrowest(&points).unwrap();
            let [dx, dy] = strip.direction;
            let heights = points.iter().map(|p| dx * p[1] - dy * p[0]);
            let (low, high) = heights.fold((f64::MAX, f64::MIN), |(l, h), v| (l.min(v), h.max(v)));
            assert!(high - low < rough + 1e-14 * size, "{round}: {} for {rough}", high - low);
            assert!((strip.width - (high - low)).abs() < 1e-14 * size + 1e-6 * rough, "{round}");
        }
    }

    /// A hull of many corners is searched by turning: the same strip as by comparing every edge with every corner.
    #[test]
    fn law_a_large_hull_is_as_wide_as_a_small_one() {
        let circle = |n: u32| -> Vec<[f64; 2]> {
            let at = |k| std::f64::consts::TAU * f64::from(k) / f64::from(n);
            (0..n).map(|k| [3.0 * at(k).cos(), at(k).sin()]).collect()
        };
        let (large, small) = (narrowest(&circle(5000)).unwrap(), narrowest(&circle(1000)).unwrap());
        assert!((large.width - 2.0).abs() < 1e-5 && (small.width - 2.0).abs() < 1e-4);
    }
}
