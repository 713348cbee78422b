//! Milled threads: the tooth stays in its groove from the first to the last touch.

mod support;

use std::f64::consts::TAU;

use proptest::prelude::*;
use support::{distance_at, pieces, places_below};
use trueaxis_cycles::mill::Heights;
use trueaxis_cycles::thread_mill::ThreadMill;

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, cases: 200, ..ProptestConfig::default() })]

    /// z minus the pitch for each turn is the same (up to whole pitches) at all places off the centre, the teeth reach
    /// the whole depth, and a right-hand thread rises counter-clockwise.
    #[test]
    fn law_teeth_stay_in_their_groove(
        (radius_mm, pitch, depth) in (0.5..20.0_f64, 0.3..4.0_f64, 0.5..30.0_f64),
        (teeth, right, ccw) in (0..6_u32, any::<bool>(), any::<bool>()),
    ) {
        let pitch_mm = if right { pitch } else { 0.0 - pitch };
        let thread = ThreadMill { center: [3.0, -4.0], radius_mm, pitch_mm, teeth, ccw };
        let heights = Heights { safe_mm: 2.0, top_mm: 0.0, bottom_mm: -depth, layer_mm: 0.0 };
        let path = pieces(&thread.strokes(&heights).unwrap(), [3.0, -4.0, 2.0]);
        let mut phase = None;
        let (mut low, mut high) = (f64::MAX, f64::MIN);
        for piece in &path {
            for i in 0..=8 {
                let part = f64::from(i) / 8.0;
                let p = piece.element.point(part);
                let z = piece.heights[0] + (piece.heights[1] - piece.heights[0]) * part;
                let d = [p[0] - 3.0, p[1] + 4.0];
                let far = f64::hypot(d[0], d[1]);
                prop_assert!(far < radius_mm + 1e-9);
                if far < 1e-6 {
                    continue;
                }
                let here = (z / pitch - f64::signum(pitch_mm) * d[1].atan2(d[0]) / TAU).rem_euclid(1.0);
                let wanted = *phase.get_or_insert(here);
                let off = (here - wanted + 0.5_f64).rem_euclid(1.0) - 0.5;
                prop_assert!(off.abs() < 1e-6, "{off} {thread:?}");
                if far > radius_mm - 1e-9 {
                    (low, high) = (low.min(z), high.max(z));
                }
            }
        }
        // From the bottom on; the teeth above the lowest one cut the rest.
        let teeth_mm = if teeth == 0 { depth } else { f64::from(teeth - 1) * pitch };
        prop_assert!((low + depth).abs() < 1e-9 && high + teeth_mm > -1e-9, "{low} {high} {thread:?}");
        prop_assert!(places_below(&path, 2.0).len() > 8 && distance_at(&path, 99.0, [0.0; 2]).is_infinite());
    }
}
