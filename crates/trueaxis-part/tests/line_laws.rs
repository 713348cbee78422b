//! Lines of surfaces, each by itself, and projected zones, by hand.

use std::path::Path;
use trueaxis_geometry::surface::SurfacePoint;
use trueaxis_input::{Files, SourceText};
use trueaxis_part::part::Part;

const FEATURES: &str = "name = \"p\"\n\
    [feature.base]\nplane = { at = \"0 0 0 mm\", normal = \"0 0 -1\", along = \"1 0 0\", size = \"100 60 mm\" }\n\
    [feature.top]\nplane = { at = \"0 0 20 mm\", normal = \"0 0 1\", along = \"1 0 0\", size = \"100 60 mm\" }\n\
    openings = [{ at = \"10 5 20 mm\", diameter = \"30 mm\" }]\n\
    [feature.hole]\nhole = { at = \"10 5 0 mm\", axis = \"0 0 1\", diameter = \"20 mm\", length = \"20 mm\" }\n\
    [feature.cone]\ncone = { at = \"10 5 100 mm\", axis = \"0 0 1\", diameters = \"60 20 mm\", length = \"20 mm\" }\n\
    [feature.bolts]\nhole = { at = \"30 0 0 mm\", axis = \"0 0 1\", diameter = \"6 mm\", length = \"20 mm\" }\n\
    repeat = { count = 4, about = \"0 0 0 mm\", axis = \"0 0 1\" }\n";

fn read(asked: &[&str]) -> Result<Part, Vec<(&'static str, String)>> {
    let asked = asked.iter().map(|a| format!("[[characteristic]]\n{a}\n"));
    let text = FEATURES.to_owned() + &asked.collect::<String>();
    let source = SourceText::from(&Files::none(), "p.toml", &text);
    let part = source.read(|root| Part::read(root, Path::new("")));
    part.ok_or_else(|| source.finish().iter().map(|p| (p.code, p.message.clone())).collect())
}

/// The values after a feature was changed by so much along its normals.
fn values(asked: &[&str], changed: &str, by: &dyn Fn(&SurfacePoint) -> f64) -> Vec<f64> {
    let part = read(asked).unwrap_or_else(|p| panic!("{p:?}"));
    let change = |f: &trueaxis_part::part::Feature| {
        let change = |p| if f.name.starts_with(changed) { by(p) } else { 0.0 };
        f.points.iter().map(change).collect::<Vec<f64>>()
    };
    let deviation_mm: Vec<f64> = part.features.iter().flat_map(change).collect();
    part.evaluate(&deviation_mm).expect("values")
}

fn close(found: &[f64], due: &[f64], to: f64) {
    assert_eq!(found.len(), due.len());
    for (found, due) in found.iter().zip(due) {
        assert!((found - due).abs() < to, "{found} {due}");
    }
}

/// A plane that sags by 4 µm along its lines has them as little straight; one that sags across them is as little flat, and its lines are
/// straight. The opening divides no line: the sag is that between the ends.
#[test]
fn law_lines_of_a_plane() {
    let asked =
        ["line_straightness = \"20 um\"\nof = \"top\"", "flatness = \"20 um\"\nof = \"top\""];
    let along = |p: &SurfacePoint| 4e-3 * (p.point_mm.x / 49.75).powi(2);
    let across = |p: &SurfacePoint| 4e-3 * (p.point_mm.y / 29.75).powi(2);
    close(&values(&asked, "top", &along), &[4e-3, 4e-3], 1e-8);
    close(&values(&asked, "top", &across), &[0.0, 4e-3], 1e-8);
    // Each line leans otherwise: a saddle of straight lines.
    let saddle = |p: &SurfacePoint| 4e-3 * p.point_mm.x * p.point_mm.y / (49.75 * 29.75);
    close(&values(&asked, "top", &saddle), &[0.0, 8e-3], 1e-8);
}

/// An opening that leaves two points of the middle lines leaves the others; one that leaves of every line two leaves nothing to judge.
#[test]
fn lines_of_two_points_are_straight() {
    let plate = |rows: u32, opening: &str| {
        let text = format!(
            "name = \"p\"\n[feature.top]\nplane = {{ at = \"0 0 0 mm\", normal = \"0 0 1\", along = \"1 0 0\", size = \"100 60 mm\" }}\n\
             extraction = {{ rows = {rows}, points = 9 }}\nopenings = [{{ at = \"0 0 0 mm\", size = \"{opening}\" }}]\n\
             [[characteristic]]\nline_straightness = \"20 um\"\nof = \"top\"\n"
        );
        let source = SourceText::from(&Files::none(), "p.toml", &text);
        let part = source.read(|root| Part::read(root, Path::new(""))).expect("a part");
        let sag = |p: &SurfacePoint| 4e-3 * (p.point_mm.x / 49.75).powi(2);
        let deviation_mm: Vec<f64> = part.features[0].points.iter().map(sag).collect();
        part.evaluate(&deviation_mm)
    };
    close(&plate(7, "90 30 mm").expect("a value"), &[4e-3], 1e-8);
    let error = plate(7, "90 70 mm").expect_err("no line").to_string();
    assert!(error.contains("three points"), "{error}");
}

/// A barrel of 3 µm has lines that are 3 µm out of straight on both sides; a hole that leans, is too wide, conical or oval has straight ones. On a cone
/// the normal leans, and its lines are as long as its flank.
#[test]
fn law_lines_of_what_is_round() {
    let hole = ["line_straightness = \"20 um\"\nof = \"hole\""];
    let barrel = |p: &SurfacePoint| 3e-3 * ((p.point_mm.z - 10.0) / 9.75).powi(2);
    close(&values(&hole, "hole", &barrel), &[3e-3], 1e-7);
    let leaning = |p: &SurfacePoint| {
        1e-4 * p.normal.x * p.point_mm.z + 5e-3 + 2e-4 * p.point_mm.z + 4e-3 * p.normal.y.powi(2)
    };
    close(&values(&hole, "hole", &leaning), &[0.0], 1e-7);
    let cone = ["line_straightness = \"20 um\"\nof = \"cone\""];
    let bow = |p: &SurfacePoint| 3e-3 * ((p.point_mm.z - 110.0) / 9.823_223_3).powi(2);
    close(&values(&cone, "cone", &bow), &[3e-3], 1e-6);
}

/// To the zero that was set a line profile is the profile; of a cone with a half angle of 45° √2 times as much in its sections. To a datum that leaves shifts
/// free every section lies for itself where it fits best: it may be beside the others, and not larger.
#[test]
fn law_line_profile_of_sections() {
    let asked = |of: &str, datum: &str| format!("line_profile = \"20 um\"\nof = \"{of}\"\n{datum}");
    let to_base = "datum = \"base\"";
    let hole = [
        asked("hole", ""),
        asked("hole", to_base),
        "profile = \"20 um\"\nof = \"hole\"".to_owned(),
    ];
    let hole: Vec<&str> = hole.iter().map(String::as_str).collect();
    let aside = |p: &SurfacePoint| 5e-3 * p.normal.x * (0.1 * p.point_mm.z).sin();
    let found = values(&hole, "hole", &aside);
    // No section stands quite at 15.7 mm.
    let due = 2.0 * 5e-3;
    assert!((found[0] - due).abs() < 0.05e-3 && (found[2] - found[0]).abs() < 1e-6, "{found:?}");
    assert!(found[1] < 5e-6, "{found:?}");
    // Half of the deviation is a size, the other half three lobes.
    let lobes = |p: &SurfacePoint| {
        let angle = (p.point_mm.y - 5.0).atan2(p.point_mm.x - 10.0);
        2e-3 + 2e-3 * (3.0 * angle).cos()
    };
    close(&values(&hole, "hole", &lobes), &[8e-3; 3], 1e-6);
    let cone = [asked("cone", ""), asked("cone", to_base)];
    let cone: Vec<&str> = cone.iter().map(String::as_str).collect();
    let due = 2.0 * 3e-3 * 2_f64.sqrt();
    close(&values(&cone, "cone", &|_| 3e-3), &[due, due], 1e-7);
    // A shift of the cone by 4 µm: 4 µm in its sections, nothing where they may shift.
    let shift = |p: &SurfacePoint| 4e-3 * p.normal.x;
    close(&values(&cone, "cone", &shift), &[8e-3, 0.0], 5e-6);
}

/// Lines of a plane to a datum across it, which leaves them a shift and the turn in their plane: what remains is half of what is not straight, on either
/// side, the same as the straightness. To the zero that was set: twice the largest deviation.
#[test]
fn law_line_profile_of_a_plane() {
    let asked = [
        "line_profile = \"20 um\"\nof = \"top\"",
        "line_profile = \"20 um\"\nof = \"top\"\ndatum = \"hole\"",
        "line_straightness = \"20 um\"\nof = \"top\"",
    ];
    let by = |p: &SurfacePoint| 1e-4 * p.point_mm.y + 6e-3 * (p.point_mm.x / 49.75).powi(2);
    let found = values(&asked, "top", &by);
    // The hole holds the turns about X and Y: lines may not lean, which these do not.
    close(&found, &[2.0 * (6e-3 + 2.975e-3), 6e-3, 6e-3], 1e-7);
    let leaning = |p: &SurfacePoint| 1e-4 * p.point_mm.x;
    close(&values(&asked, "top", &leaning), &[9.95e-3, 9.95e-3, 0.0], 1e-7);
}

/// A hole that leans by 100 µrad about its middle, at 10 mm: 30 mm beyond its end the axis is (10 + 30) · 100 µrad = 4 µm off, 8 µm of position; from its
/// end to there it leans by 3 µm. Beyond its beginning the same.
#[test]
fn law_projected_zones() {
    let asked = |kind: &str, of: &str, projected: &str, datum: &str| {
        format!("{kind} = \"20 um\"\nof = \"{of}\"\n{projected}{datum}")
    };
    let (up, down, none) = ("projected = \"30 mm\"\n", "projected = \"-30 mm\"\n", "");
    let all = [
        asked("position", "hole", none, ""),
        asked("position", "hole", up, ""),
        asked("position", "hole", down, ""),
        asked("perpendicularity", "hole", none, "datum = \"base\""),
        asked("perpendicularity", "hole", up, "datum = \"base\""),
        asked("perpendicularity", "hole", "projected = \"5 mm\"\n", "datum = \"base\""),
        asked("angularity", "hole", up, "datum = \"base|bolts_1\""),
        asked("parallelism", "hole", up, "datum = \"bolts_1\""),
    ];
    let all: Vec<&str> = all.iter().map(String::as_str).collect();
    // Material along the normal of a hole, which points to its axis.
    let lean = |p: &SurfacePoint| 1e-4 * p.normal.x * (p.point_mm.z - 10.0);
    let due = [1.95e-3, 8e-3, 8e-3, 1.95e-3, 3e-3, 0.5e-3, 3e-3, 3e-3];
    close(&values(&all, "hole", &lean), &due, 2e-6);
    // A lean the other way is none of the sign; a shift counts at both ends.
    let other = |p: &SurfacePoint| -lean(p) + 2e-3 * p.normal.y;
    let off = |lean: f64| 2.0 * lean.hypot(2e-3);
    let found = values(&all, "hole", &other);
    close(&found[..3], &[off(0.975e-3), off(4e-3), off(4e-3)], 2e-6);
    close(&found[3..], &due[3..], 2e-6);
}

/// A pattern with projected zones goes as a whole: all lean alike, the ends of all axes are shifted alike, and a datum across them leaves that free.
#[test]
fn law_a_pattern_with_projected_zones() {
    let asked = [
        "position = \"20 um\"\nof = \"bolts\"\nprojected = \"30 mm\"",
        "position = \"20 um\"\nof = \"bolts\"\nprojected = \"30 mm\"\ndatum = \"base\"",
    ];
    let lean = |p: &SurfacePoint| 1e-4 * p.normal.x * (p.point_mm.z - 10.0);
    // From 1 µm at the end to 4 µm: half-way 1.5 µm remain either way.
    close(&values(&asked, "bolts", &lean), &[8e-3, 3e-3], 2e-6);
}

/// What has no lines or no projected zone is refused by name.
#[test]
fn what_has_no_lines_is_refused() {
    let refused = |asked: &str, code: &str| {
        let problems = read(&[asked]).expect_err(asked);
        assert!(problems.iter().any(|(c, _)| *c == code), "{asked}: {problems:?}");
    };
    refused("flatness = \"20 um\"\nof = \"top\"\nprojected = \"5 mm\"", "wrong-feature");
    refused("position = \"20 um\"\nof = \"top\"\nprojected = \"5 mm\"", "wrong-feature");
    refused("position = \"20 um\"\nof = \"cone\"\nprojected = \"5 mm\"", "wrong-feature");
    refused("diameter = \"20 um\"\nof = \"hole\"\nprojected = \"5 mm\"", "wrong-feature");
    refused("position = \"20 um\"\nof = \"hole\"\nprojected = \"0 mm\"", "bad-projection");
    refused("position = \"20 um\"\nof = \"hole\"\nprojected = \"401 mm\"", "bad-projection");
    refused("position = \"20 um\"\nof = \"hole\"\nprojected = \"5\"", "missing-unit");
    refused("position = \"20 um\"\nof = \"hole\"\nprojected = true", "wrong-type");
}

#[derive(serde::Deserialize)]
struct Cases {
    cases: Vec<Case>,
}

#[derive(serde::Deserialize)]
struct Case {
    of: String,
    datum: String,
    deviation_mm: Vec<f64>,
    value_mm: f64,
}

/// Each line where it fits best, by `oracles/lines.py` (scipy).
#[test]
fn oracle_line_profiles() {
    let all: Cases = serde_json::from_str(include_str!("data/lines.json")).expect("the data");
    assert_eq!(all.cases.len(), 12);
    for case in &all.cases {
        let text = format!(
            "name = \"p\"\n[feature.base]\nplane = {{ at = \"0 0 0 mm\", normal = \"0 0 -1\", along = \"1 0 0\", size = \"100 60 mm\" }}\n\
             [feature.top]\nplane = {{ at = \"0 0 20 mm\", normal = \"0 0 1\", along = \"1 0 0\", size = \"100 60 mm\" }}\nextraction = {{ rows = 5, points = 9 }}\n\
             [feature.hole]\nhole = {{ at = \"0 0 0 mm\", axis = \"0 0 1\", diameter = \"20 mm\", length = \"20 mm\" }}\nextraction = {{ sections = 4, points = 12 }}\n\
             [feature.cone]\ncone = {{ at = \"0 0 0 mm\", axis = \"0 0 1\", diameters = \"60 20 mm\", length = \"20 mm\" }}\nextraction = {{ sections = 4, points = 12 }}\n\
             [feature.pin]\nhole = {{ at = \"20 0 -30 mm\", axis = \"0 1 0\", diameter = \"10 mm\", length = \"20 mm\" }}\n\
             [[characteristic]]\nline_profile = \"20 um\"\nof = \"{}\"\ndatum = \"{}\"\n",
            case.of, case.datum
        );
        let source = SourceText::from(&Files::none(), "p.toml", &text);
        let part = source.read(|root| Part::read(root, Path::new(""))).expect("a part");
        let deviation_mm = part.features.iter().flat_map(|f| match f.name == case.of {
            true => case.deviation_mm.clone(),
            false => vec![0.0; f.points.len()],
        });
        let found = part.evaluate(&deviation_mm.collect::<Vec<f64>>()).expect("a value")[0];
        assert!((found - case.value_mm).abs() < 1e-8, "{} {found} {}", case.of, case.value_mm);
    }
}
