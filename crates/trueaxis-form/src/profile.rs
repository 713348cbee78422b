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

    /// The rows of a wall that leans, seen along it: a lattice that is 90 mm long and thinner than a micrometre, sheared by rounding. No
    /// direction but that along it is narrow, however it is turned, shifted and scaled.
    #[test]
    fn law_the_rows_of_a_leaning_wall_are_narrow() {
        let mut state = 3_u64;
        let mut unit = || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1_u64 << 53) as f64
        };
        for round in 0..3000 {
            let (size, turn) = (10_f64.powf(4.0 * unit() - 1.0), 1e-3 * (unit() - 0.5));
            let (sin, cos) = turn.sin_cos();
            let (shear, lean) =
                (10_f64.powf(-18.0 + 12.0 * unit()), 10_f64.powf(-17.0 + 11.0 * unit()));
            let mut points = Vec::new();
            for k in 0..41 {
                for j in 0..9 {
                    let row = size * f64::from(j) / 8.0;
                    let (along, across) =
                        (size * f64::from(k - 20) / 40.0 + shear * row, lean * row);
                    points.push([along * cos - across * sin, along * sin + across * cos]);
                }
            }
            let strip = narrowest(&points).unwrap();
            let [dx, dy] = strip.direction;
            let heights = points.iter().map(|p| dx * p[1] - dy * p[0]);
            let (low, high) = heights.fold((f64::MAX, f64::MIN), |(l, h), v| (l.min(v), h.max(v)));
            assert!(
                high - low < 1.001 * lean * size + 1e-14 * size,
                "{round}: {} for {}",
                high - low,
                lean * size
            );
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

    /// The hull of the side of a plate that leans by a micrometre on one machine of many: the farthest corner, followed from edge to
    /// edge, was lost at the corner that three of them have to rounding, and the strip was 2 wide.
    #[test]
    fn a_corner_of_three_is_no_reason_to_lose_the_other_side() {
        let points = [
            [-1.0000000000000158e0, 5.440689544716315e-7],
            [-9.999999767909158e-1, 1.3601723409266376e-7],
            [-9.999999690545491e-1, -6.0336587990372905e-15],
            [-9.999999613181825e-1, -1.3601724615998135e-7],
            [-9.999999381090823e-1, -5.440689666183392e-7],
            [-7.999999442981723e-1, -5.440689655068758e-7],
            [2.000000247563766e-1, -5.440689597113878e-7],
            [3.500000201145589e-1, -5.440689588380951e-7],
            [9.500000015472881e-1, -5.440689553449243e-7],
            [1.000000000000016e0, -5.440689550273632e-7],
            [9.999999922636493e-1, -4.080517149010406e-7],
            [9.999999381090824e-1, 5.440689660626075e-7],
            [5.499999520345353e-1, 5.440689747161446e-7],
        ];
        let strip = narrowest(&points).unwrap();
        assert!(strip.width < 1.1e-6 && strip.direction[0].abs() > 0.999_999, "{strip:?}");
    }
}
