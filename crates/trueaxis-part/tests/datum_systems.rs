//! Datum systems and common datums against independent programs, `oracles/datum_systems.py` and `oracles/common_datums.py` (scipy).

use serde::Deserialize;
use std::collections::BTreeMap;
use std::path::Path;
use trueaxis_geometry::Vec3;
use trueaxis_geometry::surface::SurfacePoint;
use trueaxis_input::{Files, SourceText};
use trueaxis_part::part::Part;

#[derive(Deserialize)]
struct Oracle {
    features: BTreeMap<String, Points>,
    systems: Vec<System>,
    angularity: BTreeMap<String, f64>,
}

#[derive(Deserialize)]
struct Points {
    points: Vec<[f64; 3]>,
    normals: Vec<[f64; 3]>,
    deviations_mm: Vec<f64>,
}

#[derive(Deserialize)]
struct System {
    datums: Vec<String>,
    values: BTreeMap<String, f64>,
}

const FEATURES: &str = "name = \"block\"\n\
    [feature.base]\nplane = { at = \"0 0 0 mm\", normal = \"0 0 -1\", size = \"100 60 mm\" }\n\
    [feature.wall]\nplane = { at = \"0 -30 10 mm\", normal = \"0 -1 0\", size = \"100 20 mm\" }\n\
    [feature.end]\nplane = { at = \"-50 0 10 mm\", normal = \"-1 0 0\", size = \"60 20 mm\" }\n\
    [feature.hole]\nhole = { at = \"20 5 0 mm\", axis = \"0 0 1\", diameter = \"30 mm\", length = \"20 mm\" }\n\
    [feature.pin]\ncylinder = { at = \"-25 10 20 mm\", axis = \"0 0 1\", diameter = \"16 mm\", length = \"20 mm\" }\n\
    [feature.bore]\nhole = { at = \"-20 -12 0 mm\", axis = \"0 0 1\", diameter = \"12 mm\", length = \"20 mm\" }\n\
    [feature.top]\nplane = { at = \"0 0 20 mm\", normal = \"0 0 1\", size = \"100 60 mm\" }\n\
    [feature.slope]\nplane = { at = \"0 32 10 mm\", normal = \"0 0.6 0.8\", size = \"40 20 mm\" }\n";

/// Points around a round feature.
const AROUND: usize = 24;

#[test]
fn oracle_datum_systems() {
    let oracle: Oracle =
        serde_json::from_str(include_str!("data/datum_systems.json")).expect("the data");
    let mut text = FEATURES.to_owned();
    let mut due = Vec::new();
    let mut ask = |name: &str, datums: &str, value: f64| {
        let (kind, of) = name.split_once(" of ").expect("a characteristic of a feature");
        text += &format!(
            "[[characteristic]]\n{kind} = \"20 um\"\nof = \"{of}\"\ndatum = \"{datums}\"\n"
        );
        due.push((format!("{name} to {datums}"), value));
    };
    for system in &oracle.systems {
        for (name, value) in &system.values {
            ask(name, &system.datums.join("|"), *value);
        }
    }
    for (datums, value) in &oracle.angularity {
        ask("angularity of slope", datums, *value);
    }
    let source = SourceText::from(&Files::none(), "p.toml", &text);
    let part = source.read(|root| Part::read(root, Path::new("")));
    let problems = source.finish();
    let mut part = part.unwrap_or_else(|| panic!("{problems:?}"));
    let deviation_mm = given(&mut part, &oracle.features);
    let found = part.evaluate(&deviation_mm).expect("values");
    assert_eq!(found.len(), due.len());
    for (found, (name, due)) in found.iter().zip(&due) {
        assert!((found - due).abs() < 1e-11, "{name}: {found} {due}");
    }
}

/// Gives a part the points of an oracle; their deviations come back.
fn given(part: &mut Part, all: &BTreeMap<String, Points>) -> Vec<f64> {
    let mut deviation_mm = Vec::new();
    for feature in &mut part.features {
        let given = &all[&feature.name];
        let points = given.points.iter().zip(&given.normals).map(|(p, n)| {
            let normal = Vec3::from(*n);
            SurfacePoint { point_mm: Vec3::from(*p), normal, axis: normal, line: 0 }
        });
        feature.points = points.collect();
        if !feature.sections.is_empty() {
            let count = feature.points.len() / AROUND;
            feature.sections = (0..count).map(|k| k * AROUND..(k + 1) * AROUND).collect();
        }
        deviation_mm.extend(&given.deviations_mm);
    }
    deviation_mm
}

#[derive(Deserialize)]
struct Commons {
    cases: Vec<Common>,
}

#[derive(Deserialize)]
struct Common {
    kind: String,
    seed: u32,
    features: BTreeMap<String, Points>,
    values: BTreeMap<String, f64>,
}

/// The part of a kind of case; none where the value has no characteristic of its own.
fn common_part(kind: &str) -> Option<String> {
    let round = |name: &str, z: u32, diameter: u32, is_hole: bool, length: u32| {
        let shape = if is_hole { "hole" } else { "cylinder" };
        format!(
            "[feature.{name}]\n{shape} = {{ at = \"10 5 {z} mm\", axis = \"0 0 1\", diameter = \"{diameter} mm\", length = \"{length} mm\" }}\n"
        )
    };
    let seats = |[a, b, c]: [bool; 3]| {
        [round("A", 0, 30, a, 12), round("B", 88, 25, b, 12), round("C", 40, 40, c, 20)].concat()
            + "[[characteristic]]\ncoaxiality = \"9 um\"\nof = \"C\"\ndatum = \"A-B\"\n"
    };
    let text = match kind {
        "shafts" => seats([false; 3]),
        "holes" => seats([true; 3]),
        "mixed" => seats([false, true, false]),
        "pads" => {
            let pad = |name: &str, x: i32| {
                format!(
                    "[feature.{name}]\nplane = {{ at = \"{x} 0 0 mm\", normal = \"0 0 -1\", along = \"1 0 0\", size = \"20 60 mm\" }}\n"
                )
            };
            [pad("A", -40), pad("B", 40)].concat()
                + "[feature.T]\nplane = { at = \"0 0 20 mm\", normal = \"0 0 1\", along = \"1 0 0\", size = \"100 60 mm\" }\n\
                   [[characteristic]]\nparallelism = \"9 um\"\nof = \"T\"\ndatum = \"A-B\"\n"
        }
        _ => return None,
    };
    Some(format!("name = \"p\"\n{text}"))
}

#[test]
fn oracle_common_datums() {
    let oracle: Commons =
        serde_json::from_str(include_str!("data/common_datums.json")).expect("the data");
    let mut count = 0;
    for case in &oracle.cases {
        let Some(text) = common_part(&case.kind) else { continue };
        let source = SourceText::from(&Files::none(), "p.toml", &text);
        let part = source.read(|root| Part::read(root, Path::new("")));
        let problems = source.finish();
        let mut part = part.unwrap_or_else(|| panic!("{problems:?}"));
        let deviation_mm = given(&mut part, &case.features);
        let found = part.evaluate(&deviation_mm).expect("values")[0];
        let due = case.values.values().next().expect("a value");
        assert!((found - due).abs() < 1e-9, "{} {}: {found} {due}", case.kind, case.seed);
        count += 1;
    }
    assert_eq!(count, 12);
}
