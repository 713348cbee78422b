//! Elements in space against oracles/form.py (scipy: exact for lines, planes, spheres; best of 40 starts for the rest).

use serde::Deserialize;
use trueaxis_form::{Criterion, Element, Fitted, Known, Proof, fit};
use trueaxis_geometry::Vec3;

#[derive(Deserialize)]
struct Case {
    name: String,
    element: String,
    normal: Option<[f64; 3]>,
    points: Vec<[f64; 3]>,
    lsc_norm: f64,
    mzc: f64,
    mcc: Option<f64>,
    mic: Option<f64>,
    centre: Option<[f64; 3]>,
    radius: Option<f64>,
    half_angle: Option<f64>,
    direction: Option<[f64; 3]>,
}

fn wrong(case: &Case) -> Vec<String> {
    let element = Element::ALL.into_iter().find(|e| e.key() == case.element).unwrap();
    let points: Vec<Vec3> = case.points.iter().map(|p| Vec3::from(*p)).collect();
    let known = Known { normal: case.normal.map(Vec3::from), ..Known::default() };
    let fitted = fit(element, &points, &known).unwrap();
    let mut found = Vec::new();
    let mut compare = |what: &str, ours: f64, theirs: Option<f64>, [better, allowed]: [f64; 2]| {
        if let Some(theirs) = theirs
            && !(-better..=allowed).contains(&(ours - theirs))
        {
            found.push(format!("{} {what}: {ours:.12}, not {theirs:.12}", case.name));
        }
    };
    let norm = fitted.residual_deviation_mm * (fitted.degrees_of_freedom as f64).sqrt();
    compare("least squares", norm, Some(case.lsc_norm), [1e-9; 2]);
    let shape = fitted.shape();
    let apart = |p: [f64; 3]| (Vec3::from(p) - shape.point_mm).norm();
    let tilt = |d: [f64; 3]| Vec3::from(d).cross(&shape.direction).norm();
    compare("centre", case.centre.map_or(0.0, apart), Some(0.0), [1e-8; 2]);
    compare("direction", case.direction.map_or(0.0, tilt), Some(0.0), [1e-8; 2]);
    compare("half angle", shape.half_angle_rad, case.half_angle, [1e-8; 2]);
    if element != Element::Cone {
        compare("radius", shape.radius_mm, case.radius, [1e-8; 2]);
    }
    let value = |criterion| {
        fitted.reference(criterion).map_or(f64::NAN, |r| match criterion {
            Criterion::MinimumZone => r.form_mm(),
            _ => r.shape.radius_mm,
        })
    };
    // Ours may be better than a search of theirs, by what that leaves; never worse.
    let allowed = if element == Element::Cone { [3e-7, 2e-8] } else { [2e-8; 2] };
    compare("MZC", value(Criterion::MinimumZone), Some(case.mzc), allowed);
    compare("MCC", value(Criterion::MinimumCircumscribed), case.mcc, allowed);
    compare("MIC", value(Criterion::MaximumInscribed), case.mic, allowed);
    found.extend(unproved(case, &fitted));
    found
}

/// Every element of contact points is proved, and no bound is contradicted.
fn unproved(case: &Case, fitted: &Fitted) -> Option<String> {
    fitted.references.iter().skip(1).find_map(|r| match r.proof {
        Some(Proof::Global | Proof::Local { .. }) => None,
        Some(Proof::Bound(bound)) => {
            let is_zone = r.criterion == Criterion::MinimumZone;
            let contradicted = is_zone && (bound > r.form_mm() || bound > case.mzc + 1e-9);
            contradicted.then(|| format!("{}: bound {bound}", case.name))
        }
        other => Some(format!("{} {:?}: {other:?}", case.name, r.criterion)),
    })
}

#[test]
fn oracle_elements_agree_with_scipy() {
    let cases: Vec<Case> = serde_json::from_str(include_str!("data/form.json")).unwrap();
    assert_eq!(cases.len(), 14);
    let all: Vec<String> = cases.iter().flat_map(wrong).collect();
    assert!(all.is_empty(), "\n{}", all.join("\n"));
}
