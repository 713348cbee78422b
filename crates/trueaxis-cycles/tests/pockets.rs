//! Pockets: the cutter sweeps all that it can reach within the wall, and nothing outside it. Spigots: it sweeps
//! a band around them, and comes from outside the blank.

mod support;

use proptest::prelude::*;
use support::{distance_at, pieces, places_below};
use trueaxis_cycles::Point;
use trueaxis_cycles::mill::Heights;
use trueaxis_cycles::outline::Outline;
use trueaxis_cycles::pocket::{Insert, Pocket};
use trueaxis_cycles::spigot::Spigot;

/// How far a point is outside a rectangle with rounded corners (negative: inside), mm.
fn outside_rectangle(half: Point, corner: f64, angle_deg: f64, center: Point, p: Point) -> f64 {
    let (sin, cos) = angle_deg.to_radians().sin_cos();
    let d = [p[0] - center[0], p[1] - center[1]];
    let own = [d[0] * cos + d[1] * sin, -d[0] * sin + d[1] * cos];
    let q = [0, 1].map(|i| own[i].abs() - half[i] + corner);
    q[0].max(0.0).hypot(q[1].max(0.0)) + q[0].max(q[1]).min(0.0) - corner
}

fn inserts() -> impl Strategy<Value = Insert> {
    prop_oneof![
        Just(Insert::Rapid),
        Just(Insert::Straight),
        (0.1..20.0, 0.2..9.0)
            .prop_map(|(radius_mm, pitch_mm)| Insert::Helix { radius_mm, pitch_mm }),
        (1.0..60.0).prop_map(|angle_deg| Insert::Ramp { angle_deg }),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, cases: 400, ..ProptestConfig::default() })]

    /// A pocket of the size 2 (a + r), 2 (b + r) whose wall is at `r` from the outermost path, as wide as `rings`
    /// steps (in radii); half of the points lie on the diagonals of its corners.
    #[test]
    fn law_pockets_are_swept_and_their_walls_left(
        (rings, long, c, r, turned) in (0.05..6.0, 1.0..4.0, -0.5..1.0, 1.0..12.0, any::<bool>()),
        (angle_deg, round, ccw) in (-180.0..180.0, any::<bool>(), any::<bool>()),
        (step, layer_mm, insert) in (0.1..2.0, 0.7..9.0, inserts()),
        center in [-30.0..30.0, -30.0..30.0],
        points in prop::collection::vec([-1.0..1.0, -1.0..1.0], 60),
    ) {
        let rings = if rings > 1.0 { f64::round(rings) } else { rings };
        let (a, b) = (rings * step * r, rings * step * r * long);
        let (a, b) = if turned { (b, a) } else { (a, b) };
        let corner_mm = f64::max(c, 0.0) * f64::min(a, b);
        let (half_mm, corner_mm, angle_deg) =
            if round { ([a, a], a, 0.0) } else { ([a, b], corner_mm, angle_deg) };
        let outline = match round {
            true => Outline::Circle { radius_mm: a },
            false => Outline::Rectangle { half_mm, corner_mm, angle_deg },
        };
        let pocket = Pocket { center, outline, cutter_mm: r, step_mm: step * r, insert, ccw };
        let heights = Heights { safe_mm: 2.0, top_mm: 0.0, bottom_mm: -10.0, layer_mm };
        let outside = |p| outside_rectangle(half_mm, corner_mm, angle_deg, center, p);
        let at = |p: [f64; 2]| {
            let (sin, cos) = f64::to_radians(angle_deg).sin_cos();
            let [x, y] = match p[0] > 0.0 {
                true => [p[0] * (half_mm[0] + r), p[1] * (half_mm[1] + r)],
                // On the diagonal of a corner, from the corner of the outermost path inwards.
                false => half_mm.map(|h| (h + p[0] * half_mm[0].min(half_mm[1])) * f64::signum(p[1])),
            };
            [center[0] + x * cos - y * sin, center[1] + x * sin + y * cos]
        };
        let rough = pocket.strokes(&heights).unwrap();
        let floor = pocket.floor(&Heights { top_mm: -9.0, ..heights }).unwrap();
        for (strokes, bottoms) in [(&rough, heights.layers().unwrap()), (&floor, vec![-10.0])] {
            let path = pieces(strokes, [center[0], center[1], 50.0]);
            for p in places_below(&path, 2.0) {
                prop_assert!(outside(p) < 1e-6, "{p:?} {pocket:?}");
            }
            for p in points.iter().map(|p| at(*p)).filter(|p| outside(*p) < r - 1e-6) {
                for height in &bottoms {
                    let left = distance_at(&path, *height, p);
                    prop_assert!(left < r + 1e-6, "{p:?} at {height}: {left} {pocket:?}");
                }
            }
        }
        if let Some(strokes) = pocket.helices(&heights, false) {
            let path = pieces(&strokes, [center[0], center[1], 50.0]);
            for p in points.iter().map(|p| at(*p)).filter(|p| outside(*p) < r - 1e-6) {
                prop_assert!(distance_at(&path, -10.0, p) < r + 1e-6, "{p:?} {pocket:?}");
            }
            prop_assert!(places_below(&path, 2.0).into_iter().all(|p| outside(p) < 1e-6));
        }
        // The wall: every point of it is touched, and the way to it stays inside.
        let path = pieces(&pocket.wall(&heights).unwrap(), [center[0], center[1], 50.0]);
        for p in places_below(&path, 2.0) {
            prop_assert!(outside(p) < 1e-6, "{p:?} {pocket:?}");
        }
        for p in points.iter().map(|p| at(*p)).filter(|p| (outside(*p)).abs() < r - 1e-6) {
            let near = distance_at(&path, -10.0, p);
            prop_assert!(near < r + 1e-6, "{p:?}: {near} {pocket:?}");
        }
    }

    /// A spigot of the size 2 a, 2 b and its path at the distance r.
    #[test]
    fn law_spigots_are_left_and_the_band_around_them_is_swept(
        (a, b, c, r) in (0.5..40.0, 0.5..40.0, 0.0..1.0, 0.5..12.0_f64),
        (angle_deg, round, ccw) in (-180.0..180.0, any::<bool>(), any::<bool>()),
        (start_mm, layer_mm) in (0.01..30.0, 0.7..9.0),
        points in prop::collection::vec([-1.0..1.0, -1.0..1.0], 60),
    ) {
        let corner_mm = c * f64::min(a, b);
        let (half_mm, corner_mm, angle_deg) =
            if round { ([a, a], a, 0.0) } else { ([a, b], corner_mm, angle_deg) };
        let wall = match round {
            true => Outline::Circle { radius_mm: a },
            false => Outline::Rectangle { half_mm, corner_mm, angle_deg },
        };
        let center = [3.0, -4.0];
        let outline = wall.inside(0.0 - r).unwrap();
        let spigot = Spigot { center, outline, start_mm, ccw };
        let heights = Heights { safe_mm: 2.0, top_mm: 0.0, bottom_mm: -10.0, layer_mm };
        let outside = |p| outside_rectangle(half_mm, corner_mm, angle_deg, center, p);
        let path = pieces(&spigot.strokes(&heights).unwrap(), [0.0, 0.0, 2.0]);
        for p in places_below(&path, 2.0) {
            prop_assert!(outside(p) > r - 1e-6, "{p:?} {spigot:?}");
        }
        // Down only at the start: there the cutter is off the path by start_mm.
        let start = spigot.start();
        prop_assert!((outside(start) - r - start_mm).abs() < 1e-6, "{spigot:?}");
        for piece in path.iter().filter(|p| p.heights[0] != p.heights[1] && p.heights[1] < 2.0) {
            let p = piece.element.point(1.0);
            prop_assert!((p[0] - start[0]).hypot(p[1] - start[1]) < 1e-9, "{spigot:?}");
        }
        for p in points.iter().map(|p| [0, 1].map(|i| center[i] + p[i] * (a + b + 2.0 * r))) {
            let d = outside(p);
            if d > 1e-6 && d < 2.0 * r - 1e-6 {
                for height in heights.layers().unwrap() {
                    prop_assert!(distance_at(&path, height, p) < r + 1e-6, "{p:?} {spigot:?}");
                }
            }
        }
    }
}
