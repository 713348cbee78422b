//! A number that JSON does not have is found wherever it stands.

use serde::Serialize;
use std::collections::BTreeMap;
use trueaxis_report::{document, first_not_finite, not_finite};

#[derive(Serialize)]
enum Shape {
    None,
    Radius(f64),
    Edges { a_mm: f64, b_mm: f64 },
    Pair(f64, f32),
}

#[derive(Serialize)]
struct Answer {
    name: &'static str,
    list: Vec<(f64, u32)>,
    shapes: Vec<Shape>,
    by_name: BTreeMap<String, f64>,
    missing: Option<f64>,
    stated: Option<[f64; 2]>,
}

fn answer() -> Answer {
    let shapes = vec![
        Shape::None,
        Shape::Radius(1.0),
        Shape::Edges { a_mm: 1.0, b_mm: 2.0 },
        Shape::Pair(1.0, 2.0),
    ];
    Answer {
        name: "inf",
        list: vec![(1.0, 2), (f64::MAX, 3)],
        shapes,
        by_name: [("NaN".to_owned(), 1.0)].into(),
        missing: None,
        stated: Some([0.0, -1.0]),
    }
}

fn place(change: impl Fn(&mut Answer)) -> Option<String> {
    let mut changed = answer();
    change(&mut changed);
    let found = first_not_finite(&changed);
    assert_eq!(not_finite(&document(&changed)), found.as_deref());
    found
}

#[test]
fn every_place_is_found_and_no_other() {
    assert_eq!(place(|_| {}), None);
    for (wanted, change) in [
        ("list.1.0", (|a| a.list[1].0 = f64::NAN) as fn(&mut Answer)),
        ("shapes.1.Radius", |a| a.shapes[1] = Shape::Radius(f64::INFINITY)),
        ("shapes.2.b_mm", |a| a.shapes[2] = Shape::Edges { a_mm: 0.0, b_mm: f64::NAN }),
        ("shapes.3.1", |a| a.shapes[3] = Shape::Pair(0.0, f32::NEG_INFINITY)),
        ("by_name.0", |a| a.by_name.values_mut().for_each(|v| *v = f64::NAN)),
        ("stated.1", |a| a.stated = Some([0.0, f64::INFINITY])),
    ] {
        assert_eq!(place(change).as_deref(), Some(wanted));
    }
    // Inside of a document that stands in another one.
    let mut inner = answer();
    inner.missing = Some(f64::NAN);
    let outer = serde_json::json!({ "all": [1, document(&inner)] });
    assert_eq!(not_finite(&outer), Some("missing"));
}
