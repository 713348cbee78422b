//! What mathematics demands of circles, whatever the points.

use proptest::prelude::*;
use std::f64::consts::TAU;
use trueaxis_form::Error;
use trueaxis_form::circle::{self, Fitter};

type Points = Vec<[f64; 2]>;

/// A section of radius 10 to 200 mm: lobes of up to 1e-3 R, scatter of up to 1e-4 R.
fn section() -> impl Strategy<Value = Points> {
    let scatter = prop::collection::vec(-1.0..1.0f64, 8..90);
    (10.0..200.0f64, -7.0..-3.0f64, 1u32..9, 0.0..TAU, scatter, -1.0..1.0f64).prop_map(
        |(radius, size, lobes, phase, scatter, off)| {
            let (n, size) = (scatter.len() as f64, radius * 10f64.powf(size));
            let point = |(i, s): (usize, f64)| {
                let angle = TAU * i as f64 / n;
                let r = radius + size * ((f64::from(lobes) * angle + phase).cos() + 0.1 * s);
                [r * angle.cos() + off, r * angle.sin() - 2.0 * off]
            };
            scatter.into_iter().enumerate().map(point).collect()
        },
    )
}

/// Points around the origin with deviations up to half the radius: hardly a circle.
fn potato() -> impl Strategy<Value = Points> {
    prop::collection::vec(0.5..1.5f64, 5..13).prop_map(|radii| {
        let n = radii.len() as f64;
        let point = |(i, r): (usize, f64)| {
            let angle = TAU * i as f64 / n + 0.3 * r;
            [10.0 * r * angle.cos(), 10.0 * r * angle.sin()]
        };
        radii.into_iter().enumerate().map(point).collect()
    })
}

fn distances(points: &[[f64; 2]], c: [f64; 2]) -> impl Iterator<Item = f64> {
    points.iter().map(move |p| (p[0] - c[0]).hypot(p[1] - c[1]))
}

fn range(points: &[[f64; 2]], c: [f64; 2]) -> (f64, f64) {
    distances(points, c).fold((f64::INFINITY, 0.0), |(l, h), d| (l.min(d), h.max(d)))
}

/// The centre equally far from a and b, and from c and d; by its own formula.
fn crossing(a: [f64; 2], b: [f64; 2], c: [f64; 2], d: [f64; 2]) -> Option<[f64; 2]> {
    let row = |p: [f64; 2], q: [f64; 2]| {
        let square = |v: [f64; 2]| v[0] * v[0] + v[1] * v[1];
        [2.0 * (q[0] - p[0]), 2.0 * (q[1] - p[1]), square(q) - square(p)]
    };
    let (r, s) = (row(a, b), row(c, d));
    let det = r[0] * s[1] - r[1] * s[0];
    (det.abs() > 1e-9)
        .then(|| [(r[2] * s[1] - r[1] * s[2]) / det, (r[0] * s[2] - r[2] * s[0]) / det])
}

fn pairs(n: usize) -> Vec<(usize, usize)> {
    (0..n).flat_map(|i| (i + 1..n).map(move |j| (i, j))).collect()
}

/// The smallest enclosing radius by trying every pair and triple.
fn brute_circumscribed(p: &[[f64; 2]]) -> f64 {
    let mut best = f64::INFINITY;
    for (i, j) in pairs(p.len()) {
        let middle = [0.5 * (p[i][0] + p[j][0]), 0.5 * (p[i][1] + p[j][1])];
        best = best.min(range(p, middle).1);
        for k in j + 1..p.len() {
            if let Some(c) = crossing(p[i], p[j], p[i], p[k]) {
                best = best.min(range(p, c).1);
            }
        }
    }
    best
}

/// The largest empty circle with its centre in the triangle of its contacts.
fn brute_inscribed(p: &[[f64; 2]]) -> f64 {
    let mut best = 0.0;
    for (i, j) in pairs(p.len()) {
        for k in j + 1..p.len() {
            let Some(c) = crossing(p[i], p[j], p[i], p[k]) else { continue };
            let side = |a: [f64; 2], b: [f64; 2]| {
                (a[0] - c[0]) * (b[1] - c[1]) - (a[1] - c[1]) * (b[0] - c[0])
            };
            let turns = [side(p[i], p[j]), side(p[j], p[k]), side(p[k], p[i])];
            let inside = turns.iter().all(|t| *t >= -1e-9) || turns.iter().all(|t| *t <= 1e-9);
            let radius = (p[i][0] - c[0]).hypot(p[i][1] - c[1]);
            if inside && range(p, c).0 >= radius - 1e-9 && radius > best {
                best = radius;
            }
        }
    }
    best
}

/// The narrowest of all zones with two outer and two inner contacts that take turns.
fn brute_zone(p: &[[f64; 2]], within: f64) -> f64 {
    let mut best = f64::INFINITY;
    let all = pairs(p.len());
    for &(a, b) in &all {
        for &(c, d) in &all {
            let Some(m) = crossing(p[a], p[b], p[c], p[d]) else { continue };
            let (low, high) = range(p, m);
            let far = |i: usize| (p[i][0] - m[0]).hypot(p[i][1] - m[1]);
            let angle = |i: usize| (p[i][1] - m[1]).atan2(p[i][0] - m[0]);
            let between = |x: usize| {
                let turn = |i: usize| (angle(i) - angle(a)).rem_euclid(TAU);
                turn(x) < turn(b)
            };
            if m[0].hypot(m[1]) < within
                && (far(a) - high).abs() < 1e-9
                && (far(c) - low).abs() < 1e-9
                && between(c) != between(d)
            {
                best = best.min(high - low);
            }
        }
    }
    best
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, failure_persistence: None, ..Default::default() })]

    #[test]
    fn law_roundness_is_unchanged_by_a_rigid_motion(
        points in section(), turn in 0.0..TAU, x in -50.0..50.0f64, y in -50.0..50.0f64,
    ) {
        let (sin, cos) = turn.sin_cos();
        let moved: Points = points
            .iter()
            .map(|p| [cos * p[0] - sin * p[1] + x, sin * p[0] + cos * p[1] + y])
            .collect();
        let (a, b) = (Fitter::default().all(&points)?, Fitter::default().all(&moved)?);
        for (a, b) in [(a.lsc, b.lsc), (a.mzc, b.mzc), (a.mcc, b.mcc), (a.mic, b.mic)] {
            prop_assert!((a.radius_mm - b.radius_mm).abs() < 1e-10, "{:?} {:?}", a, b);
        }
        for (a, b) in [(a.lsc, b.lsc), (a.mzc, b.mzc)] {
            prop_assert!((a.width_mm() - b.width_mm()).abs() < 1e-10, "{:?} {:?}", a, b);
        }
    }

    #[test]
    fn law_each_circle_is_best_at_its_own_game(points in section()) {
        let c = Fitter::default().all(&points)?;
        let spread = |z: circle::Zone| {
            let mean = distances(&points, z.center_mm).sum::<f64>() / points.len() as f64;
            distances(&points, z.center_mm).map(|d| (d - mean).powi(2)).sum::<f64>()
        };
        for other in [c.lsc, c.mzc, c.mic, c.mcc] {
            prop_assert!(c.mzc.width_mm() <= other.width_mm() + 1e-12);
            prop_assert!(c.mic.inner_mm >= other.inner_mm - 1e-12);
            prop_assert!(c.mcc.outer_mm <= other.outer_mm + 1e-12);
            prop_assert!(spread(c.lsc) <= spread(other) * (1.0 + 1e-9) + 1e-22);
        }
    }

    #[test]
    fn law_a_thin_section_agrees_with_every_combination_of_contacts(points in section()) {
        let few: Points = points.iter().take(points.len().min(14)).copied().collect();
        let few = if few.len() < points.len() {
            // Every k-th point, so that they go all the way round.
            points.iter().step_by(points.len().div_ceil(14)).copied().collect()
        } else { few };
        prop_assume!(few.len() >= 6);
        let c = Fitter::default().all(&few)?;
        prop_assert!((c.mcc.radius_mm - brute_circumscribed(&few)).abs() < 1e-9);
        prop_assert!((c.mic.radius_mm - brute_inscribed(&few)).abs() < 1e-9);
        prop_assert!((c.mzc.width_mm() - brute_zone(&few, 1e9)).abs() < 1e-9);
    }

    #[test]
    fn law_a_potato_agrees_with_every_combination_of_contacts(points in potato()) {
        let c = Fitter::default().all(&points);
        let Ok(c) = c else {
            prop_assert_eq!(c, Err(Error::NoCentre));
            return Ok(());
        };
        prop_assert!((c.mcc.radius_mm - brute_circumscribed(&points)).abs() < 1e-9);
        let brute = brute_inscribed(&points);
        prop_assert!((c.mic.radius_mm - brute).abs() < 1e-9, "{} {} {:?}", c.mic.radius_mm, brute, points);
        let near = c.mcc.center_mm[0].hypot(c.mcc.center_mm[1]);
        prop_assert!(c.mzc.width_mm() <= brute_zone(&points, c.mcc.radius_mm - near) + 1e-9);
        prop_assert!(c.mzc.width_mm() >= brute_zone(&points, 1e9) - 1e-9);
    }

    #[test]
    fn law_fits_survive_any_points(
        points in prop::collection::vec(prop::array::uniform2(any::<f64>()), 0..12),
        grid in prop::collection::vec(prop::array::uniform2(-2i8..3), 0..12),
    ) {
        let grid: Points = grid.into_iter().map(|p| p.map(f64::from)).collect();
        for points in [points, grid] {
            if let Ok(c) = Fitter::default().all(&points) {
                for z in [c.lsc, c.mzc, c.mic, c.mcc] {
                    prop_assert!(z.center_mm.iter().all(|v| v.is_finite()));
                    prop_assert!(z.inner_mm <= z.outer_mm && z.outer_mm.is_finite());
                }
            }
        }
    }

    /// Two points opposite each other hold a circle that may go up or down between them: it goes to where there is more
    /// room. About (0, −h) its radius is √(a² + h²) = d − h, so that h = (d² − a²)/2d.
    #[test]
    fn law_an_oval_holds_the_circle_of_its_wider_end(
        turn in 0.0..TAU, near in 10.3..10.6f64, more in 0.02..0.2f64, count in 40usize..90,
    ) {
        let (a, far) = (10.0, near + more);
        let mut points = vec![[a, 0.0], [-a, 0.0], [0.0, near], [0.0, -far]];
        points.extend((0..count).map(|i| {
            let angle = TAU * (i as f64 + 0.5) / count as f64;
            [11.5 * angle.cos(), 11.5 * angle.sin()]
        }));
        let (sin, cos) = turn.sin_cos();
        let points: Points =
            points.iter().map(|p| [cos * p[0] - sin * p[1], sin * p[0] + cos * p[1]]).collect();
        let h = (far * far - a * a) / (2.0 * far);
        let found = Fitter::default().all(&points)?.mic;
        prop_assert!((found.radius_mm - (far - h)).abs() < 1e-9, "{} not {}", found.radius_mm, far - h);
        let centre = [h * sin, -h * cos];
        prop_assert!((0..2).all(|i| (found.center_mm[i] - centre[i]).abs() < 1e-8), "{:?}", found);
    }
}

/// Two points opposite each other, and between them two ends: the circle goes to the end with more room. Above, all points
/// lie on or outside of the circle through (±10, 0) about (0, up), below of that about (0, −down): r = √(10² + down²).
/// Straight below there is no point, so that the contact of that end lies 22° to the side of the way there.
#[test]
fn law_a_lens_holds_the_circle_of_its_wider_end() {
    let a = 10.0_f64;
    for (up, down) in [(0.4, 0.5), (0.45, 0.55)] {
        let at = |height: f64, degrees: f64, outside: f64| {
            let (sin, cos) = degrees.to_radians().sin_cos();
            let reach = height * sin + ((height * sin).powi(2) + a * a).sqrt() + outside;
            [reach * cos, reach * sin]
        };
        let below = |degrees: f64, outside: f64| {
            let [x, y] = at(down, degrees, outside);
            [x, -y]
        };
        let ring: Vec<f64> = (0..16).map(|i| (f64::from(i) + 0.5) * 11.25).collect();
        let mut points = vec![[a, 0.0], [-a, 0.0], at(up, 95.625, 0.0)];
        points.extend(ring.iter().filter(|d| (**d - 95.625).abs() > 1.0).map(|d| at(up, *d, 0.1)));
        points.extend([below(68.0, 0.0), below(114.2, 0.1)]);
        points.extend(ring.iter().filter(|d| (**d - 90.0).abs() > 28.6).map(|d| below(*d, 0.1)));
        for turn in 0..8 {
            let (sin, cos) = (TAU * f64::from(turn) / 8.0).sin_cos();
            let turned: Points =
                points.iter().map(|p| [cos * p[0] - sin * p[1], sin * p[0] + cos * p[1]]).collect();
            let found = Fitter::default().all(&turned).expect("circles").mic;
            let off = found.radius_mm - a.hypot(down);
            assert!(off.abs() < 1e-9, "{turn}/8 of a turn: {off} mm");
            let centre = [down * sin, -down * cos];
            assert!((0..2).all(|i| (found.center_mm[i] - centre[i]).abs() < 1e-8), "{found:?}");
        }
    }
}
