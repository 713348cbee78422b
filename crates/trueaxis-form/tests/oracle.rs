//! Reference circles against oracles/fits.py (independent, 40 digits).

use serde::Deserialize;
use trueaxis_form::Error;
use trueaxis_form::circle::{Fitter, Zone};

#[derive(Deserialize)]
struct Case {
    name: String,
    points_mm: Vec<[f64; 2]>,
    lsc: Option<Expected>,
    mzc: Option<Expected>,
    mic: Option<Expected>,
    mcc: Option<Expected>,
    note: Option<String>,
}

#[derive(Deserialize)]
struct Expected {
    cx: f64,
    cy: f64,
    r: Option<f64>,
    width: f64,
}

/// The worst of centre, radius and width.
fn worst(ours: Zone, theirs: &Expected, unique: bool) -> f64 {
    if !unique {
        return theirs.r.map_or(f64::NAN, |r| (ours.radius_mm - r).abs());
    }
    let center = (ours.center_mm[0] - theirs.cx).hypot(ours.center_mm[1] - theirs.cy);
    let radius = theirs.r.map_or(0.0, |r| (ours.radius_mm - r).abs());
    center.max(radius).max((ours.width_mm() - theirs.width).abs())
}

#[test]
fn oracle_circles_agree_to_1e_9_mm() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/circles.json");
    let text = std::fs::read_to_string(path)
        .unwrap_or_else(|e| panic!("{path} is missing ({e}): run oracles/fits.py"));
    let cases: Vec<Case> = serde_json::from_str(&text).unwrap();
    assert!(cases.len() >= 5, "only {} cases", cases.len());
    let mut wrong = Vec::new();
    let mut fitter = Fitter::default();
    for case in &cases {
        let points = &case.points_mm;
        let note = case.note.as_deref().unwrap_or_default();
        for (kind, ours, theirs) in [
            ("lsc", fitter.least_squares(points), &case.lsc),
            ("mzc", fitter.minimum_zone(points), &case.mzc),
            ("mic", fitter.maximum_inscribed(points), &case.mic),
            ("mcc", fitter.minimum_circumscribed(points), &case.mcc),
        ] {
            // Two inscribed circles of one size: the oracle says so, and any of them is right.
            let unique = !note.contains(&format!("{kind}: not unique"));
            let error = match (&ours, theirs) {
                (Ok(ours), Some(theirs)) => worst(*ours, theirs, unique),
                (Err(Error::NoCentre), None) => 0.0,
                (Ok(_), None) | (Err(_), _) => f64::NAN,
            };
            if error.is_nan() || error > 1e-9 {
                wrong.push(format!("{} {kind}: off by {error:e} mm, {ours:?}", case.name));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
