//! Points along a helix, and threads as cylinders, by hand.

use std::path::Path;
use trueaxis_geometry::Vec3;
use trueaxis_geometry::surface::SurfacePoint;
use trueaxis_input::{Files, SourceText};
use trueaxis_part::part::Part;

const BASE: &str = "name = \"p\"\n\
    [feature.base]\nplane = { at = \"0 0 0 mm\", normal = \"0 0 -1\", along = \"1 0 0\", size = \"100 60 mm\" }\n\
    [feature.side]\nplane = { at = \"0 -30 10 mm\", normal = \"0 -1 0\", along = \"1 0 0\", size = \"100 20 mm\" }\n\
    [feature.end]\nplane = { at = \"-50 0 10 mm\", normal = \"-1 0 0\", along = \"0 1 0\", size = \"60 20 mm\" }\n";
const HOLE: &str =
    "hole = { at = \"10 5 0 mm\", axis = \"0 0 1\", diameter = \"20 mm\", length = \"20 mm\" }\n";
const HELIX: &str = "extraction = { helix = 5, points = 240 }\n";
const SECTIONS: &str = "extraction = { sections = 12, points = 48 }\n";
/// From the edges.
const EDGE_MM: f64 = 0.25;

const ASKED: [&str; 7] = [
    "position = \"50 um\"\ndatum = \"base|side|end\"",
    "perpendicularity = \"50 um\"\ndatum = \"base\"",
    "diameter = \"50 um\"",
    "cylindricity = \"50 um\"",
    "profile = \"50 um\"\ndatum = \"base|side|end\"",
    "parallelism = \"50 um\"\ndatum = \"side|end\"",
    "position = \"50 um\"\ndatum = \"base|side|end\"\nprojected = \"20 mm\"",
];

fn read(feature: &str, asked: &[&str]) -> Result<Part, Vec<(&'static str, String)>> {
    let asked = asked.iter().map(|a| format!("[[characteristic]]\n{a}\nof = \"it\"\n"));
    let text = format!("{BASE}[feature.it]\n{feature}") + &asked.collect::<String>();
    let source = SourceText::from(&Files::none(), "p.toml", &text);
    let part = source.read(|root| Part::read(root, Path::new("")));
    let problems = source.finish();
    let words = || problems.iter().map(|p| (p.code, p.message.clone())).collect();
    part.filter(|_| !problems.has_errors()).ok_or_else(words)
}

/// The values after the feature was changed by so much along its normals.
fn values(feature: &str, asked: &[&str], by: &dyn Fn(&SurfacePoint) -> f64) -> Vec<f64> {
    let part = read(feature, asked).unwrap_or_else(|p| panic!("{p:?}"));
    let change = |f: &trueaxis_part::part::Feature| {
        let change = |p| if f.name == "it" { by(p) } else { 0.0 };
        f.points.iter().map(change).collect::<Vec<f64>>()
    };
    let deviation_mm: Vec<f64> = part.features.iter().flat_map(change).collect();
    part.evaluate(&deviation_mm).expect("values")
}

fn close(found: &[f64], due: &[f64], to: f64) {
    assert_eq!(found.len(), due.len());
    for (i, (found, due)) in found.iter().zip(due).enumerate() {
        assert!((found - due).abs() < to, "{}: {found} {due}", ASKED[i.min(6)]);
    }
}

/// 3 µm and 4 µm to the side are 10 µm of position; a hole 2 µm larger all around is 4 µm larger in diameter.
#[test]
fn law_a_hole_that_is_moved_and_larger() {
    let feature = HOLE.to_owned() + HELIX;
    let moved = |p: &SurfacePoint| p.normal.dot(&Vec3::new(3e-3, 4e-3, 0.0));
    close(&values(&feature, &ASKED, &moved), &[10e-3, 0.0, 0.0, 0.0, 10e-3, 0.0, 10e-3], 5e-6);
    let larger = |_: &SurfacePoint| -2e-3;
    close(&values(&feature, &ASKED, &larger), &[0.0, 0.0, 4e-3, 0.0, 4e-3, 0.0, 0.0], 1e-8);
}

/// An axis that leans by 100 µrad, 1.95 µm over the 19.5 mm between the outermost points, about the middle of the hole.
#[test]
fn law_a_hole_that_leans() {
    let feature = HOLE.to_owned() + HELIX;
    let leans = |p: &SurfacePoint| p.normal.x * 1e-4 * (p.point_mm.z - 10.0);
    let ends_mm = 1e-4 * (20.0 - 2.0 * EDGE_MM);
    // 30 mm from the middle to the end of the projected zone.
    let due = [ends_mm, ends_mm, 0.0, 0.0, ends_mm, ends_mm, 6e-3];
    close(&values(&feature, &ASKED, &leans), &due, 2e-5);
}

/// What is smooth has the same values along a helix and in sections: as far as the points of one miss what those of the other meet.
#[test]
fn law_a_helix_sees_what_sections_see() {
    let form = |p: &SurfacePoint| {
        let angle = p.normal.y.atan2(p.normal.x);
        1e-3 * (2.0 * angle).cos()
            + 2e-3 * (0.05 * (p.point_mm.z - 10.0)).powi(2)
            + p.normal.x * 5e-5 * (p.point_mm.z - 7.0)
    };
    let helix = values(&(HOLE.to_owned() + HELIX), &ASKED, &form);
    let sections = values(&(HOLE.to_owned() + SECTIONS), &ASKED, &form);
    // The largest values stand at the ends, of which a helix meets one point each.
    for (i, (helix, sections)) in helix.iter().zip(&sections).enumerate() {
        let due = 0.85 * sections - 1e-4..sections + 1.5e-4;
        assert!(due.contains(helix), "{}: {helix} {sections}", ASKED[i]);
    }
    assert!(helix[3] > 2e-3, "{helix:?}");
}

/// Moved rigidly, the other way round, with another number of turns and points: the axis is the same.
#[test]
fn law_turns_points_and_sense_do_not_matter() {
    let leans =
        |p: &SurfacePoint| p.normal.x * (1e-4 * (p.point_mm.z - 10.0) + 2e-3) + 1e-3 * p.normal.y;
    let asked = &ASKED[..2];
    let due = values(&(HOLE.to_owned() + HELIX), asked, &leans);
    for (turns, points) in [("1", 8), ("1.5", 40), ("3", 36), ("17.25", 900)] {
        let how = format!("extraction = {{ helix = {turns}, points = {points} }}\n");
        close(&values(&(HOLE.to_owned() + &how), asked, &leans), &due, 2e-5);
        let other = HOLE.replace("10 5 0 mm", "10 5 20 mm").replace("0 0 1", "0 0 -1");
        close(&values(&(other + &how), asked, &leans), &due, 2e-5);
    }
}

/// Of a thread the axis is judged, as that of a hole of its outer diameter.
#[test]
fn law_a_thread_has_the_axis_of_its_hole() {
    let thread = HOLE.replace("hole =", "thread =");
    let moved = |p: &SurfacePoint| p.normal.dot(&Vec3::new(3e-3, 4e-3, 0.0));
    let asked = [ASKED[0], ASKED[1], ASKED[6], "straightness = \"10 um\""];
    assert_eq!(values(&thread, &asked, &moved), values(HOLE, &asked, &moved));
    let part = read(&thread, &asked).expect("a part");
    assert_eq!(part.features.last().map(|f| f.shape_name()), Some("thread"));
}

#[test]
fn what_does_not_fit_is_refused() {
    let cone = "cone = { at = \"0 0 0 mm\", axis = \"0 0 1\", diameters = \"30 20 mm\", length = \"9 mm\" }\n";
    let helix = HOLE.to_owned() + HELIX;
    let with = |how: &str| HOLE.to_owned() + "extraction = " + how + "\n";
    let thread = HOLE.replace("hole =", "thread =");
    let cases = [
        (helix.clone(), "roundness = \"9 um\"", "wrong-feature", "needs sections"),
        (helix.clone(), "straightness = \"9 um\"", "wrong-feature", "needs sections"),
        (helix.clone(), "line_straightness = \"9 um\"", "wrong-feature", "needs sections"),
        (helix.clone(), "line_profile = \"9 um\"", "wrong-feature", "needs sections"),
        (cone.to_owned() + HELIX, "profile = \"9 um\"", "contradiction", "helix on a cone"),
        (with("{ helix = 5, points = 7 }"), ASKED[2], "bad-count", "7 points"),
        (with("{ helix = 5, points = 14 }"), ASKED[2], "bad-count", "5 turns"),
        (with("{ helix = 0.5, points = 99 }"), ASKED[2], "bad-count", "0.5 turns"),
        (with("{ helix = -5, points = 99 }"), ASKED[2], "bad-count", "-5 turns"),
        (with("{ helix = 5, points = 99, sections = 4 }"), ASKED[2], "unknown-key", "sections"),
        (with("{ helix = 5 }"), ASKED[2], "missing-key", "points"),
        (thread.clone(), "diameter = \"9 um\"", "wrong-feature", "not asked of a thread"),
        (thread.clone(), "roundness = \"9 um\"", "wrong-feature", "not asked of a thread"),
        (thread, "profile = \"9 um\"", "wrong-feature", "not asked of a thread"),
    ];
    for (feature, asked, code, words) in cases {
        let Err(problems) = read(&feature, &[asked]) else { panic!("{feature}: {asked}") };
        let is = |(c, message): &(&str, String)| *c == code && message.contains(words);
        assert!(problems.iter().any(is), "{code}: {problems:?}");
    }
}
