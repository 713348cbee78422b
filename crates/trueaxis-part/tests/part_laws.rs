//! Values of a drawing by hand: surfaces that are displaced, turned, larger or out of form by so much.

use std::f64::consts::TAU;
use std::path::Path;
use trueaxis_geometry::Vec3;
use trueaxis_geometry::surface::SurfacePoint;
use trueaxis_input::{Files, SourceText};
use trueaxis_part::part::Part;

const FEATURES: &str = "name = \"p\"\n\
    [feature.base]\nplane = { at = \"0 0 0 mm\", normal = \"0 0 1\", along = \"1 0 0\", size = \"100 60 mm\" }\nspacing = \"10 mm\"\n\
    [feature.top]\nplane = { at = \"0 0 20 mm\", normal = \"0 0 1\", along = \"1 0 0\", size = \"100 60 mm\" }\nspacing = \"10 mm\"\n\
    [feature.wall]\nplane = { at = \"50 0 10 mm\", normal = \"1 0 0\", along = \"0 1 0\", size = \"60 20 mm\" }\nspacing = \"5 mm\"\n\
    [feature.hole]\nhole = { at = \"10 5 0 mm\", axis = \"0 0 1\", diameter = \"40 mm\", length = \"50 mm\" }\nspacing = \"5 mm\"\n\
    [feature.shaft]\ncylinder = { at = \"10 5 60 mm\", axis = \"0 0 1\", diameter = \"30 mm\", length = \"40 mm\" }\nspacing = \"5 mm\"\n\
    [feature.cone]\ncone = { at = \"10 5 100 mm\", axis = \"0 0 1\", diameters = \"60 20 mm\", length = \"20 mm\" }\nspacing = \"5 mm\"\n\
    [feature.slope]\ndatum = \"S\"\nplane = { at = \"0 -20 10 mm\", normal = \"0 -0.6 0.8\", along = \"1 0 0\", size = \"40 20 mm\" }\nspacing = \"5 mm\"\n";

/// The part with characteristics.
fn part(asked: &[(&str, &str, &str)]) -> Part {
    let mut text = FEATURES.to_owned();
    for (kind, of, datum) in asked {
        text += &format!("[[characteristic]]\n{kind} = \"20 um\"\nof = \"{of}\"\n");
        if !datum.is_empty() {
            text += &format!("datum = \"{datum}\"\n");
        }
    }
    read_part(&text).unwrap_or_else(|p| panic!("{p:?}"))
}

fn read_part(text: &str) -> Result<Part, Vec<String>> {
    let source = SourceText::from(&Files::none(), "p.toml", text);
    let part = source.read(|root| Part::read(root, Path::new("")));
    part.ok_or_else(|| source.finish().iter().map(|p| p.message.clone()).collect())
}

/// The values after a feature was changed by so much along its normals.
fn values(
    asked: &[(&str, &str, &str)],
    changed: &str,
    by: &dyn Fn(&SurfacePoint) -> f64,
) -> Vec<f64> {
    let part = part(asked);
    let of = |f: &trueaxis_part::part::Feature| {
        let change = |p| if f.name == changed { by(p) } else { 0.0 };
        f.points.iter().map(change).collect::<Vec<f64>>()
    };
    let deviation_mm: Vec<f64> = part.features.iter().flat_map(of).collect();
    part.evaluate(&deviation_mm).expect("values")
}

/// The values after a small rigid motion of the whole part.
fn values_of_moved(asked: &[(&str, &str, &str)]) -> Vec<f64> {
    let part = part(asked);
    let (shift, turn) = (Vec3::new(3e-3, -4e-3, 2e-3), Vec3::new(2e-5, -1e-5, 3e-5));
    let moved = |p: &SurfacePoint| p.normal.dot(&(shift + turn.cross(&p.point_mm)));
    let deviation_mm: Vec<f64> = part.features.iter().flat_map(|f| &f.points).map(moved).collect();
    part.evaluate(&deviation_mm).expect("values")
}

fn close(found: &[f64], due: &[f64], to: f64) {
    assert_eq!(found.len(), due.len());
    for (found, due) in found.iter().zip(due) {
        assert!((found - due).abs() < to, "{found} {due}");
    }
}

/// A nominal part has no deviations.
#[test]
fn law_the_nominal_part_is_nought() {
    let asked = [
        ("flatness", "top", ""),
        ("profile", "wall", ""),
        ("parallelism", "top", "base"),
        ("perpendicularity", "wall", "base"),
        ("perpendicularity", "hole", "base"),
        ("parallelism", "shaft", "hole"),
        ("coaxiality", "shaft", "hole"),
        ("circular_run_out", "shaft", "hole"),
        ("total_run_out", "shaft", "hole"),
        ("cylindricity", "hole", ""),
        ("roundness", "cone", ""),
        ("diameter", "hole", ""),
        ("position", "hole", ""),
        ("position", "cone", ""),
    ];
    close(&values(&asked, "", &|_| 0.0), &[0.0; 14], 1e-9);
}

/// A plane that is turned by 100 µrad about Y: 99.5 mm between its outermost points make 9.95 µm of parallelism and of profile, and
/// it stays flat; one that is a saddle of ±3 µm at its outermost corners is 6 µm out of flat.
#[test]
fn law_a_plane_that_leans_and_one_that_is_bent() {
    let asked = [("flatness", "top", ""), ("parallelism", "top", "base"), ("profile", "top", "")];
    let leaning = values(&asked, "top", &|p| 1e-4 * p.point_mm.x);
    close(&leaning, &[0.0, 9.95e-3, 9.95e-3], 1e-9);
    let saddle = |p: &SurfacePoint| 3e-3 * (p.point_mm.x / 49.75) * (p.point_mm.y / 29.75);
    close(&values(&asked, "top", &saddle), &[6e-3, 6e-3, 6e-3], 1e-9);
    let asked = [("perpendicularity", "wall", "base"), ("position", "wall", "")];
    // 19.5 mm between the outermost rows; about Z it may lean as it likes.
    close(&values(&asked, "wall", &|p| 2e-4 * (p.point_mm.z - 10.0)), &[3.9e-3, 3.9e-3], 1e-8);
    let about_z = values(&asked, "wall", &|p| 2e-4 * p.point_mm.y);
    assert!(about_z[0] < 1e-8 && (about_z[1] - 2.0 * 2e-4 * 29.75).abs() < 1e-8, "{about_z:?}");
}

/// A shaft beside the axis of its hole by 7 µm: 14 µm of coaxiality, position and run-out, round and of its size.
#[test]
fn law_a_shaft_that_is_displaced() {
    let asked = [
        ("coaxiality", "shaft", "hole"),
        ("position", "shaft", ""),
        ("circular_run_out", "shaft", "hole"),
        ("total_run_out", "shaft", "hole"),
        ("roundness", "shaft", ""),
        ("diameter", "shaft", ""),
    ];
    // Along a point of each section.
    let off = Vec3::x() * 7e-3;
    let found = values(&asked, "shaft", &|p| p.normal.dot(&off));
    // e²/2R = 1.6 nm of second order.
    close(&found, &[14e-3, 14e-3, 14e-3, 14e-3, 0.0, 0.0], 5e-6);
}

/// Material that is left makes a shaft larger and a hole smaller.
#[test]
fn law_left_material_makes_shafts_larger_and_holes_smaller() {
    let asked =
        [("diameter", "shaft", ""), ("diameter", "hole", ""), ("cylindricity", "shaft", "")];
    close(&values(&asked, "shaft", &|_| 5e-3), &[10e-3, 0.0, 0.0], 1e-9);
    close(&values(&asked, "hole", &|_| 5e-3), &[0.0, -10e-3, 0.0], 1e-9);
}

/// A hole whose axis leans by 100 µrad: 49.5 mm between its outermost sections make 4.95 µm across the base, as much along a shaft.
#[test]
fn law_a_hole_that_leans() {
    let asked = [
        ("perpendicularity", "hole", "base"),
        ("parallelism", "hole", "shaft"),
        ("roundness", "hole", ""),
    ];
    let leaning = |p: &SurfacePoint| p.normal.x * 1e-4 * p.point_mm.z;
    close(&values(&asked, "hole", &leaning), &[4.95e-3, 4.95e-3, 0.0], 1e-6);
}

/// Three lobes of 4 µm are 8 µm out of round, not off their place; on a cone with a half angle of 45° the material along the normal is √2 as
/// much in the section.
#[test]
fn law_lobes() {
    let lobes = |p: &SurfacePoint| {
        let angle = (p.point_mm.y - 5.0).atan2(p.point_mm.x - 10.0);
        4e-3 * (3.0 * angle).cos()
    };
    let asked = [
        ("roundness", "shaft", ""),
        ("cylindricity", "shaft", ""),
        ("position", "shaft", ""),
        ("diameter", "shaft", ""),
    ];
    let spread = 1.0 - (1.5 * TAU / 24.0).cos();
    let found = values(&asked, "shaft", &lobes);
    // The points of a section may miss the lobes by half a step.
    assert!(found[0] <= 8e-3 + 1e-6 && found[0] > 8e-3 * (1.0 - spread), "{found:?}");
    assert!(found[1] <= 8e-3 + 1e-6 && found[1] > 8e-3 * (1.0 - spread), "{found:?}");
    assert!(found[2] < 1e-6 && found[3].abs() < 1e-6, "{found:?}");
    let cone = values(&[("roundness", "cone", "")], "cone", &lobes)[0];
    let due = 8e-3 * 2_f64.sqrt();
    assert!(cone <= due + 1e-6 && cone > due * (1.0 - spread), "{cone}");
}

/// A rigid motion of the whole part leaves form, orientation and size alone; it shifts what counts from the zero.
#[test]
fn law_a_rigid_motion_of_the_part_changes_places_only() {
    let asked = [
        ("flatness", "top", ""),
        ("parallelism", "top", "base"),
        ("perpendicularity", "hole", "base"),
        ("coaxiality", "shaft", "hole"),
        ("diameter", "hole", ""),
        ("position", "hole", ""),
    ];
    let found = values_of_moved(&asked);
    close(&found[..5], &[0.0; 5], 3e-6);
    assert!(found[5] > 8e-3, "{found:?}");
}

/// A system of three datums holds all six degrees: a rigid motion of the whole part is nothing to it, whatever its order.
#[test]
fn law_a_datum_system_moves_with_the_part() {
    let asked = [
        ("position", "shaft", "base|wall|hole"),
        ("position", "shaft", "hole|base|wall"),
        ("position", "top", "wall|base|hole"),
        ("profile", "cone", "base|hole|wall"),
        ("profile", "slope", "base|wall|hole"),
        ("perpendicularity", "wall", "base|hole"),
        ("angularity", "slope", "base|wall"),
    ];
    close(&values_of_moved(&asked), &[0.0; 7], 6e-6);
}

/// The wall leans by 200 µrad about Z: as the second datum it turns the frame, and the axis of the shaft, 5 mm off the middle of the wall, is
/// 1 µm nearer to it. As the third it only shifts: its outermost row, 29.75 mm off, is 5.95 µm out.
#[test]
fn law_the_second_datum_turns_and_the_third_shifts() {
    let leaning = |p: &SurfacePoint| 2e-4 * p.point_mm.y;
    let found = values(&[("position", "shaft", "base|wall|hole")], "wall", &leaning);
    // The points of the hole, 13.8° apart, let its circle slip by some 0.1 µm.
    close(&found, &[2e-3], 2e-5);
    // A hole along the normal of the first leaves a turn about its axis: the wall holds it, without a shift; the shaft is on that axis.
    let found = values(&[("position", "shaft", "base|hole|wall")], "wall", &leaning);
    close(&found, &[0.0], 1e-6);
    // As the first it leans all of the frame: a top that is parallel to Y does not see it.
    let found = values(&[("perpendicularity", "top", "wall|base")], "wall", &leaning);
    close(&found, &[0.0], 1e-6);
}

/// A bump of 10 µm in a hole pushes the largest inscribed cylinder aside by half of it; the smallest circumscribed one would not see it. On a
/// shaft the same the other way round.
#[test]
fn law_a_bump_moves_the_datum_by_half_of_it() {
    let at_x =
        |p: &SurfacePoint| if p.normal.x.abs() > 0.999 && p.point_mm.x > 10.0 { 1e-2 } else { 0.0 };
    let asked = [("coaxiality", "shaft", "hole"), ("position", "shaft", "base|hole|wall")];
    // Points stand 13.8° apart: the circle slips aside between the two that hold it.
    close(&values(&asked, "hole", &at_x), &[1e-2; 2], 2e-4);
    let asked = [("coaxiality", "hole", "shaft"), ("position", "hole", "base|shaft|wall")];
    close(&values(&asked, "shaft", &at_x), &[1e-2; 2], 2e-4);
}

/// A plane at an angle: about the normal of its datum the zone may turn, across it not; a second datum holds the turn.
#[test]
fn law_angularity_turns_about_its_datum_only() {
    let asked = [("angularity", "slope", "base"), ("angularity", "slope", "base|wall")];
    let about_z = |p: &SurfacePoint| 1e-4 * p.point_mm.x;
    // 39.5 mm between the outermost rows.
    close(&values(&asked, "slope", &about_z), &[0.0, 3.95e-3], 1e-6);
    let slope = |p: &SurfacePoint| {
        1e-4 * (p.point_mm - Vec3::new(0.0, -20.0, 10.0)).dot(&Vec3::new(0.0, 0.8, 0.6))
    };
    close(&values(&asked, "slope", &slope), &[1.95e-3; 2], 1e-6);
}

/// A bow of a shaft by 4 µm is its straightness, and of a face its total run-out along the axis.
#[test]
fn law_straightness_and_the_run_out_of_a_face() {
    let bow = |p: &SurfacePoint| p.normal.x * 4e-3 * ((p.point_mm.z - 80.0) / 19.75).powi(2);
    let found = values(&[("straightness", "shaft", "")], "shaft", &bow);
    assert!((found[0] - 4e-3).abs() < 0.1e-3, "{found:?}");
    let leaning = |p: &SurfacePoint| 1e-4 * p.point_mm.x;
    close(&values(&[("total_run_out", "top", "hole")], "top", &leaning), &[9.95e-3], 1e-9);
}

/// Two seats of a shaft, one 4 µm off along X, the other −2 µm: their common axis goes through the middles of both, however large each was made;
/// a seat between them is off it by what the line is off there: 4 − 6 (z − 5)/90 µm, twice that at its lower end z = 45.25 of coaxiality.
#[test]
fn law_a_common_axis_goes_through_both_seats() {
    let seat = |name: &str, z: u32, diameter: u32| {
        format!(
            "[feature.{name}]\ndatum = \"{name}\"\ncylinder = {{ at = \"0 0 {z} mm\", axis = \"0 0 1\", diameter = \"{diameter} mm\", length = \"10 mm\" }}\n"
        )
    };
    let face = "[feature.face]\nplane = { at = \"0 0 100 mm\", normal = \"0 0 1\", size = \"20 20 mm\" }\n";
    let asked = |kind: &str, of: &str, datum: &str| {
        format!("[[characteristic]]\n{kind} = \"20 um\"\nof = \"{of}\"\ndatum = \"{datum}\"\n")
    };
    let text = [
        "name = \"p\"\n",
        &seat("A", 0, 30),
        &seat("C", 45, 40),
        &seat("B", 90, 25),
        face,
        &asked("coaxiality", "C", "A-B"),
        &asked("coaxiality", "C", "B-A"),
        &asked("circular_run_out", "C", "A-B"),
        &asked("perpendicularity", "face", "A-B"),
        &asked("parallelism", "C", "A-B"),
    ];
    let part = read_part(&text.concat()).unwrap_or_else(|p| panic!("{p:?}"));
    for [larger, smaller] in [[0.0, 0.0], [20e-3, 10e-3], [-5e-3, 7e-3]] {
        let by = |name: &str, p: &SurfacePoint| match name {
            "A" => p.normal.x * 4e-3 + larger,
            "B" => p.normal.x * -2e-3 - smaller,
            _ => 0.0,
        };
        let of = |f: &trueaxis_part::part::Feature| {
            f.points.iter().map(|p| by(&f.name, p)).collect::<Vec<f64>>()
        };
        let deviation_mm: Vec<f64> = part.features.iter().flat_map(of).collect();
        let found = part.evaluate(&deviation_mm).expect("values");
        let line = |z: f64| 4e-3 - 6e-3 * (z - 5.0) / 90.0;
        let off = 2.0 * line(45.25);
        // The face leans by 6 µm on 90 mm over the 19.5 mm between its outermost points.
        let due = [off, off, off, 19.5 * 6e-3 / 90.0, 9.5 * 6e-3 / 90.0];
        close(&found, &due, 2e-5);
    }
}

/// Two pads, one 5 µm higher: the plane on both leans by 5 µm on the 80 mm between their middles.
#[test]
fn law_a_common_plane_lies_on_both_pads() {
    let pad = |name: &str, x: i32| {
        format!(
            "[feature.{name}]\nplane = {{ at = \"{x} 0 0 mm\", normal = \"0 0 -1\", along = \"1 0 0\", size = \"20 60 mm\" }}\n"
        )
    };
    let text = [
        "name = \"p\"\n",
        &pad("one", -40),
        &pad("other", 40),
        "[feature.top]\nplane = { at = \"0 0 20 mm\", normal = \"0 0 1\", along = \"1 0 0\", size = \"100 60 mm\" }\n",
        "[[characteristic]]\nparallelism = \"20 um\"\nof = \"top\"\ndatum = \"one-other\"\n",
        "[feature.pads]\nplane = { at = \"-40 0 0 mm\", normal = \"0 0 -1\", along = \"1 0 0\", size = \"20 60 mm\" }\nrepeat = { count = 2, step = \"80 0 0 mm\" }\n",
        "[[characteristic]]\nparallelism = \"20 um\"\nof = \"top\"\ndatum = \"pads\"\n",
    ];
    let part = read_part(&text.concat()).unwrap_or_else(|p| panic!("{p:?}"));
    let of = |f: &trueaxis_part::part::Feature| {
        let high = if matches!(f.name.as_str(), "other" | "pads_2") { 5e-3 } else { 0.0 };
        vec![high; f.points.len()]
    };
    let deviation_mm: Vec<f64> = part.features.iter().flat_map(of).collect();
    let lean = 99.5 * 5e-3 / 80.0;
    close(&part.evaluate(&deviation_mm).expect("values"), &[lean; 2], 1e-8);
}

/// What half of the points changes, by hand: a plane that leans and is flat keeps its values with any half; a bore of three sections of three
/// points has no circle with half of them, so that its diameter counts whole, and nothing else does.
#[test]
fn law_what_half_of_the_points_changes() {
    let text = "name = \"p\"\n[feature.top]\nplane = { at = \"0 0 20 mm\", normal = \"0 0 1\", along = \"1 0 0\", size = \"100 60 mm\" }\n\
        extraction = { rows = 7, points = 9 }\n\
        [feature.bore]\nhole = { at = \"10 5 0 mm\", axis = \"0 0 1\", diameter = \"40 mm\", length = \"50 mm\" }\nextraction = { sections = 3, points = 3 }\n\
        [[characteristic]]\nflatness = \"20 um\"\nof = \"top\"\n[[characteristic]]\nprofile = \"20 um\"\nof = \"top\"\n\
        [[characteristic]]\nroundness = \"20 um\"\nof = \"bore\"\n[[characteristic]]\nposition = \"20 um\"\nof = \"bore\"\n";
    let part = read_part(text).unwrap_or_else(|p| panic!("{p:?}"));
    let by = |name: &str, p: &SurfacePoint| match name {
        "top" => 1e-4 * p.point_mm.x,
        // Along X by 3 µm.
        _ => p.normal.x * 3e-3,
    };
    let of = |f: &trueaxis_part::part::Feature| {
        f.points.iter().map(|p| by(&f.name, p)).collect::<Vec<f64>>()
    };
    let deviation_mm: Vec<f64> = part.features.iter().flat_map(of).collect();
    let values = part.evaluate(&deviation_mm).expect("values");
    close(&values, &[0.0, 9.95e-3, 0.0, 6e-3], 1e-5);
    let changes = part.by_points_mm(&deviation_mm).expect("changes");
    close(&changes, &[0.0, 0.0, 0.0, values[3]], 1e-9);
    // One high point in the middle of all is in one half and not in the other.
    let mut high = deviation_mm;
    high[31] += 5e-3;
    let changes = part.by_points_mm(&high).expect("changes");
    assert!((changes[0] - 5e-3).abs() < 1e-6, "{changes:?}");
}

/// Two pads, each with a strip along its middle that is 4 µm higher: the plane on both touches the strips, and the top is 4 µm farther from it.
#[test]
fn law_a_common_plane_touches_what_stands_out() {
    let pad = |name: &str, x: i32| {
        format!(
            "[feature.{name}]\nplane = {{ at = \"{x} 0 0 mm\", normal = \"0 0 -1\", along = \"1 0 0\", size = \"20 60 mm\" }}\n"
        )
    };
    let text = [
        "name = \"p\"\n",
        &pad("one", -40),
        &pad("other", 40),
        "[feature.top]\nplane = { at = \"0 0 20 mm\", normal = \"0 0 1\", along = \"1 0 0\", size = \"100 60 mm\" }\n",
        "[[characteristic]]\nposition = \"20 um\"\nof = \"top\"\ndatum = \"one-other\"\n",
    ];
    let part = read_part(&text.concat()).unwrap_or_else(|p| panic!("{p:?}"));
    let high = |f: &str, p: &SurfacePoint| {
        if f != "top" && p.point_mm.y.abs() < 10.0 { 4e-3 } else { 0.0 }
    };
    let points = part.features.iter().flat_map(|f| f.points.iter().map(|p| high(&f.name, p)));
    let deviation_mm: Vec<f64> = points.collect();
    close(&part.evaluate(&deviation_mm).expect("values"), &[8e-3], 1e-8);
}

/// Three pads of a wall turn the part about a hole that holds its place: they cannot shift it, so that the largest distance on either side is least.
/// The third, 60 mm off, misses 6 µm: t · 41.8 = 6 − t · 58.2 to the outermost points, t = 60 µrad, 3 µm at a bore 50 mm away.
#[test]
fn law_common_pads_turn_the_part_about_a_hole() {
    let pad = |name: &str, x: i32| {
        format!(
            "[feature.{name}]\nplane = {{ at = \"{x} -30 10 mm\", normal = \"0 -1 0\", along = \"1 0 0\", size = \"4.1 4.1 mm\" }}\n"
        )
    };
    let hole = |name: &str, x: i32| {
        format!(
            "[feature.{name}]\nhole = {{ at = \"{x} 0 0 mm\", axis = \"0 0 1\", diameter = \"10 mm\", length = \"20 mm\" }}\n"
        )
    };
    let text = [
        "name = \"p\"\n[feature.base]\nplane = { at = \"0 0 0 mm\", normal = \"0 0 -1\", size = \"100 60 mm\" }\n",
        &pad("P", -40),
        &pad("Q", 40),
        &pad("R", 60),
        &hole("pivot", 0),
        &hole("bore", 50),
        "[[characteristic]]\nposition = \"20 um\"\nof = \"bore\"\ndatum = \"base|pivot|P-Q-R\"\n",
    ];
    let part = read_part(&text.concat()).unwrap_or_else(|p| panic!("{p:?}"));
    let of = |f: &trueaxis_part::part::Feature| {
        vec![if f.name == "R" { -6e-3 } else { 0.0 }; f.points.len()]
    };
    let deviation_mm: Vec<f64> = part.features.iter().flat_map(of).collect();
    close(&part.evaluate(&deviation_mm).expect("values"), &[6e-3], 1e-6);
}

/// What a reader says of datums that hold nothing, leave what matters free, or stand at another angle.
#[test]
fn datums_that_do_not_do_are_refused_by_name() {
    let refused = |asked: (&str, &str, &str), code: &str| {
        let (kind, of, datum) = asked;
        let beside = "[feature.beside]\ncylinder = { at = \"22 5 60 mm\", axis = \"0 0 1\", diameter = \"30 mm\", length = \"40 mm\" }\n";
        let text = format!(
            "{FEATURES}{beside}[[characteristic]]\n{kind} = \"20 um\"\nof = \"{of}\"\ndatum = \"{datum}\"\n"
        );
        let source = SourceText::from(&Files::none(), "p.toml", &text);
        assert!(source.read(|root| Part::read(root, Path::new(""))).is_none(), "{asked:?}");
        let problems = source.finish();
        assert!(problems.iter().any(|p| p.code == code), "{asked:?}: {problems:?}");
    };
    refused(("position", "shaft", "base|top|wall"), "idle-datum");
    refused(("position", "shaft", "base|wall"), "free-degree");
    refused(("position", "shaft", "base"), "free-degree");
    refused(("position", "shaft", "base|wall|wall"), "bad-datum");
    refused(("position", "shaft", "base|wall|shaft"), "wrong-feature");
    refused(("position", "shaft", "base|nothing|hole"), "unknown-feature");
    refused(("position", "shaft", "base|wall|hole|top"), "bad-datum");
    refused(("position", "shaft", "base|wall (M)|hole"), "material-condition");
    refused(("position", "shaft", "base|cone|wall"), "wrong-feature");
    refused(("perpendicularity", "top", "base"), "wrong-angle");
    refused(("parallelism", "slope", "base"), "wrong-angle");
    refused(("flatness", "top", "base"), "wrong-feature");
    refused(("total_run_out", "shaft", "hole|base"), "bad-datum");
    refused(("total_run_out", "wall", "hole"), "wrong-angle");
    refused(("coaxiality", "beside", "hole"), "wrong-place");
    refused(("circular_run_out", "beside", "hole"), "wrong-place");
    refused(("coaxiality", "shaft", "hole-beside"), "wrong-place");
    refused(("coaxiality", "shaft", "hole-hole"), "bad-datum");
    refused(("coaxiality", "shaft", "hole-nothing"), "unknown-feature");
    refused(("coaxiality", "shaft", "hole-"), "unknown-feature");
    refused(("coaxiality", "shaft", "hole-shaft"), "wrong-feature");
    refused(("position", "shaft", "base-wall-hole"), "bad-datum");
}
