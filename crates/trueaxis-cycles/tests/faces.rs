//! Faces: the cutter sweeps all of them, and crosses no wall.

mod support;

use proptest::prelude::*;
use support::{distance_at, pieces, places_below};
use trueaxis_cycles::face::Face;
use trueaxis_cycles::mill::Heights;

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, cases: 400, ..ProptestConfig::default() })]

    /// Next to walls at the ends of the strokes arcs of the cutter remain: there the points are a radius away.
    #[test]
    fn law_faces_are_swept_up_to_their_walls(
        (a, b, r, step) in (-90.0..90.0, -90.0..90.0, 1.0..20.0, 0.1..2.2),
        (angle_deg, along_second, back_and_forth) in (-180.0..180.0, any::<bool>(), any::<bool>()),
        (over_mm, over_across_mm, layer_mm) in (0.0..5.0, 0.0..3.0, 0.5..9.0),
        walls in any::<[[bool; 2]; 2]>(),
        points in prop::collection::vec([0.0..1.0, 0.0..1.0], 60),
    ) {
        let face = Face {
            corner: [3.0, -4.0], size_mm: [a, b], angle_deg, cutter_mm: r, step_mm: step * r, over_mm,
            over_across_mm, along_second, back_and_forth, walls,
        };
        let heights = Heights { safe_mm: 2.0, top_mm: 0.0, bottom_mm: -10.0, layer_mm };
        let Some(strokes) = face.strokes(&heights) else {
            // Only between walls that are too near.
            let narrow = |i: usize| f64::abs(face.size_mm[i]) < 2.0 * r && walls[i] == [true; 2];
            prop_assert!(narrow(0) || narrow(1), "{face:?}");
            return Ok(());
        };
        let (sin, cos) = f64::to_radians(angle_deg).sin_cos();
        let path = pieces(&strokes, [0.0, 0.0, 50.0]);
        // Along its own axes from its corner.
        let own = |p: [f64; 2]| {
            let d = [p[0] - 3.0, p[1] + 4.0];
            [d[0] * cos + d[1] * sin, -d[0] * sin + d[1] * cos]
        };
        for p in places_below(&path, 2.0).into_iter().map(own) {
            for i in 0..2 {
                let (low, high) = (f64::min(0.0, face.size_mm[i]), f64::max(0.0, face.size_mm[i]));
                prop_assert!(!walls[i][0] || p[i] > low + r - 1e-6, "{p:?} {face:?}");
                prop_assert!(!walls[i][1] || p[i] < high - r + 1e-6, "{p:?} {face:?}");
            }
        }
        let end = usize::from(along_second);
        for part in points {
            let p = [part[0] * a, part[1] * b];
            let (low, high) = (f64::min(0.0, face.size_mm[end]), f64::max(0.0, face.size_mm[end]));
            if walls[end][0] && p[end] < low + r || walls[end][1] && p[end] > high - r {
                continue;
            }
            let p = [3.0 + p[0] * cos - p[1] * sin, -4.0 + p[0] * sin + p[1] * cos];
            for height in heights.layers().unwrap() {
                prop_assert!(distance_at(&path, height, p) < r + 1e-6, "{p:?} {face:?}");
            }
        }
    }
}
