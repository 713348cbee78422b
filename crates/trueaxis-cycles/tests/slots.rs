//! Slots along arcs: the cutter sweeps all of them and nothing else.

mod support;

use proptest::prelude::*;
use support::{distance, distance_at, pieces, places_below};
use trueaxis_contour::Element;
use trueaxis_cycles::mill::Heights;
use trueaxis_cycles::slot::ArcSlot;

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, cases: 400, ..ProptestConfig::default() })]

    /// A slot is all that is within half of its width of its middle line.
    #[test]
    fn law_slots_are_swept_and_their_walls_left(
        (radius_mm, start_deg, sweep_deg) in (5.0..60.0, -360.0..360.0, 2.0..360.0),
        (half, r, step) in (0.0..0.99, 0.5..8.0, 0.1..2.5),
        (ccw, back, layer_mm) in (any::<bool>(), any::<bool>(), 0.7..9.0),
        points in prop::collection::vec([-1.0..1.0, -1.0..1.0], 80),
    ) {
        let sweep_deg: f64 = if back { 0.0 - sweep_deg } else { sweep_deg };
        let slot = ArcSlot {
            center: [3.0, -4.0], radius_mm, start_deg, sweep_deg, half_mm: half * radius_mm, cutter_mm: r,
            step_mm: step * r, ccw,
        };
        let middle = Element::Arc {
            center: [3.0, -4.0], radius_mm, start_rad: f64::to_radians(start_deg), sweep_rad: sweep_deg.to_radians(),
        };
        let heights = Heights { safe_mm: 2.0, top_mm: 0.0, bottom_mm: -10.0, layer_mm };
        let path = pieces(&slot.strokes(&heights).unwrap(), [0.0, 0.0, 2.0]);
        for p in places_below(&path, 2.0) {
            prop_assert!(distance(&middle, p) < slot.half_mm + 1e-6, "{p:?} {slot:?}");
        }
        for p in points {
            let p = [3.0 + p[0] * 2.1 * radius_mm, -4.0 + p[1] * 2.1 * radius_mm];
            if distance(&middle, p) < slot.half_mm + r - 1e-6 {
                for height in heights.layers().unwrap() {
                    prop_assert!(distance_at(&path, height, p) < r + 1e-6, "{p:?} {slot:?}");
                }
            }
        }
    }
}
