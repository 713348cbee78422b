//! Corners of random lines and arcs: the inserted element touches its neighbours.

use proptest::prelude::*;
use trueaxis_contour::Element;
use trueaxis_contour::corner::{Shape, transition};

fn element(from: [f64; 2]) -> impl Strategy<Value = Element> {
    let line = (5.0..40.0, 0.0..std::f64::consts::TAU).prop_map(move |(l, a): (f64, f64)| {
        Element::line(from, [from[0] + l * a.cos(), from[1] + l * a.sin()])
    });
    let arc = (3.0..30.0, 0.0..std::f64::consts::TAU, 0.3..5.5, any::<bool>()).prop_map(
        move |(radius_mm, start_rad, sweep, ccw): (f64, f64, f64, bool)| {
            let center =
                [from[0] - radius_mm * start_rad.cos(), from[1] - radius_mm * start_rad.sin()];
            Element::Arc {
                center,
                radius_mm,
                start_rad,
                sweep_rad: if ccw { sweep } else { -sweep },
            }
        },
    );
    prop_oneof![line, arc]
}

/// An element that ends where another begins.
fn pair() -> impl Strategy<Value = (Element, Element)> {
    element([0.0, 0.0]).prop_flat_map(|first| (Just(first), element(first.point(1.0))))
}

fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    /// A rounding leaves the first element and meets the second one without a corner, with its radius.
    #[test]
    fn law_roundings_are_tangential((a, b) in pair(), radius_mm in 0.1..8.0) {
        let Ok(Some(t)) = transition(&a, &b, Shape::Round { radius_mm }) else { return Ok(()) };
        let (center, ccw) = t.arc.unwrap();
        prop_assert!(distance(a.point(t.first_ends), t.from) < 1e-6);
        prop_assert!(distance(b.point(t.second_begins), t.to) < 1e-6);
        let own = Element::arc(t.from, t.to, center, ccw, 1);
        prop_assert!((distance(center, t.to) - radius_mm).abs() < 1e-6);
        prop_assert!((distance(center, t.from) - radius_mm).abs() < 1e-6);
        prop_assert!(distance(own.tangent(0.0), a.tangent(t.first_ends)) < 1e-5);
        prop_assert!(distance(own.tangent(1.0), b.tangent(t.second_begins)) < 1e-5);
    }

    /// A chamfer has its ends at the same distance from the corner, or its length.
    #[test]
    fn law_chamfers_have_their_measure((a, b) in pair(), size in 0.1..8.0) {
        let corner = a.point(1.0);
        if let Ok(Some(t)) = transition(&a, &b, Shape::ChamferLeg { leg_mm: size }) {
            prop_assert!((distance(t.from, corner) - size).abs() < 1e-9);
            prop_assert!((distance(t.to, corner) - size).abs() < 1e-9);
            prop_assert!(distance(a.point(t.first_ends), t.from) < 1e-9);
            prop_assert!(distance(b.point(t.second_begins), t.to) < 1e-9);
        }
        if let Ok(Some(t)) = transition(&a, &b, Shape::ChamferLength { length_mm: size }) {
            prop_assert!((distance(t.from, t.to) - size).abs() < 1e-5);
            prop_assert!((distance(t.from, corner) - distance(t.to, corner)).abs() < 1e-9);
        }
    }
}
