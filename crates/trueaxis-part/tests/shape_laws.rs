//! Slots, tongues, roundings and patterns by hand.

use std::f64::consts::{FRAC_PI_2, TAU};
use std::path::Path;
use trueaxis_geometry::Vec3;
use trueaxis_geometry::surface::SurfacePoint;
use trueaxis_input::{Diagnostics, Files, SourceText};
use trueaxis_part::part::{Feature, Geometry, Part};

const BASE: &str = "name = \"p\"\n[feature.base]\ndatum = \"A\"\n\
    plane = { at = \"0 0 0 mm\", normal = \"0 0 -1\", along = \"1 0 0\", size = \"100 60 mm\" }\n";
const SLOT: &str = "[feature.slot]\nslot = { at = \"0 0 20 mm\", across = \"0 1 0\", along = \"1 0 0\", width = \"12 mm\", size = \"40 10 mm\" }\n\
    spacing = \"5 mm\"\n";
const OUTSIDE: &str = "[feature.outside]\ndatum = \"B\"\ntongue = { at = \"0 0 15 mm\", across = \"0 1 0\", along = \"1 0 0\", width = \"60 mm\", size = \"100 30 mm\" }\n\
    spacing = \"5 mm\"\n";
const HOLES: &str = "[feature.bolts]\nhole = { at = \"40 0 0 mm\", axis = \"0 0 1\", diameter = \"8 mm\", length = \"10 mm\" }\n\
    repeat = { count = 4, about = \"0 0 0 mm\", axis = \"0 0 1\" }\n";

fn read(text: &str) -> (Option<Part>, Diagnostics) {
    let source = SourceText::from(&Files::none(), "p.toml", text);
    let part = source.read(|root| Part::read(root, Path::new("")));
    (part, source.finish())
}

fn part(text: &str) -> Part {
    let (part, problems) = read(text);
    part.unwrap_or_else(|| panic!("{:?}", problems.iter().map(|p| &p.message).collect::<Vec<_>>()))
}

fn values(text: &str, by: &dyn Fn(&Feature, &SurfacePoint) -> f64) -> Vec<f64> {
    let part = part(text);
    let of = |f: &Feature| f.points.iter().map(|p| by(f, p)).collect::<Vec<f64>>();
    let deviation_mm: Vec<f64> = part.features.iter().flat_map(of).collect();
    part.evaluate(&deviation_mm).expect("values")
}

fn asked(kind: &str, of: &str, datum: &str) -> String {
    let datum = if datum.is_empty() { String::new() } else { format!("datum = \"{datum}\"\n") };
    format!("[[characteristic]]\n{kind} = \"20 um\"\nof = \"{of}\"\n{datum}")
}

fn near(found: f64, due: f64, to: f64) {
    assert!((found - due).abs() < to, "{found} {due}");
}

/// A cutter whose way is 3 µm off and whose track is 4 µm wider: as wide, a middle that is 3 µm off, 6 µm of position and of symmetry;
/// what leans by 100 µrad along X adds 2 · 19.75 mm · 100 µrad, and changes neither the width nor what stands on the base.
#[test]
fn law_a_slot_by_hand() {
    let text = [
        BASE,
        SLOT,
        OUTSIDE,
        &asked("width", "slot", ""),
        &asked("position", "slot", ""),
        &asked("symmetry", "slot", "B"),
        &asked("perpendicularity", "slot", "A"),
        &asked("parallelism", "slot", "B"),
        &asked("profile", "slot", ""),
    ]
    .concat();
    let off = |f: &Feature, p: &SurfacePoint| match f.name.as_str() {
        // The faces of a slot point to each other.
        "slot" => 3e-3 * p.normal.y - 2e-3,
        _ => 0.0,
    };
    let found = values(&text, &off);
    for (found, due) in found.iter().zip([4e-3, 6e-3, 6e-3, 0.0, 0.0, 10e-3]) {
        near(*found, due, 1e-8);
    }
    let leaning = |f: &Feature, p: &SurfacePoint| match f.name.as_str() {
        "slot" => 1e-4 * p.point_mm.x * p.normal.y + off(f, p),
        _ => 0.0,
    };
    let found = values(&text, &leaning);
    let lean = 2.0 * 19.75e-4;
    for (found, due) in found.iter().zip([4e-3, 6e-3 + lean, 6e-3 + lean, 0.0, lean, 10e-3 + lean])
    {
        near(*found, due, 1e-8);
    }
}

/// The datum of a tongue is the middle of the narrowest gauge about it: a single point that stands out by 8 µm, opposite the middle of the other
/// face, moves the middle by 4 µm.
#[test]
fn law_the_middle_of_a_tongue_as_datum() {
    let text = [BASE, SLOT, OUTSIDE, &asked("symmetry", "slot", "B")].concat();
    let burr = |f: &Feature, p: &SurfacePoint| {
        let is_there = f.name == "outside" && p.normal.y > 0.0;
        let at = (p.point_mm - Vec3::new(0.0, 30.0, 15.0)).norm();
        if is_there && at < 0.1 { 8e-3 } else { 0.0 }
    };
    let found = values(&text, &burr)[0];
    // Leaning would only make the gauge wider.
    near(found, 8e-3, 1e-8);
    let both = |f: &Feature, p: &SurfacePoint| {
        let is_there = f.name == "outside" && p.normal.y > 0.0;
        if is_there && (p.point_mm.x.abs() > 47.0) { 8e-3 } else { 0.0 }
    };
    near(values(&text, &both)[0], 8e-3, 1e-8);
    let slot = BASE.to_owned()
        + &SLOT.replace("[feature.slot]", "[feature.slot]\ndatum = \"C\"")
        + OUTSIDE
        + &asked("symmetry", "outside", "C");
    let narrow = |f: &Feature, p: &SurfacePoint| {
        let is_there = f.name == "slot" && p.normal.y > 0.0;
        if is_there && (p.point_mm.x.abs() > 17.0) { 6e-3 } else { 0.0 }
    };
    // A gauge in the slot touches what stands out of one face.
    near(values(&slot, &narrow)[0], 6e-3, 1e-8);
}

/// The middle of two opposite faces as a common datum: one of them 4 µm farther out moves it by 2 µm.
#[test]
fn law_the_middle_of_two_faces_as_datum() {
    let faces = "[feature.near]\ndatum = \"N\"\nplane = { at = \"0 -30 15 mm\", normal = \"0 -1 0\", size = \"100 30 mm\" }\n\
        [feature.far]\ndatum = \"F\"\nplane = { at = \"0 30 15 mm\", normal = \"0 1 0\", size = \"100 30 mm\" }\n";
    let text =
        [BASE, SLOT, faces, &asked("symmetry", "slot", "N-F"), &asked("position", "slot", "A|F-N")]
            .concat();
    let farther = |f: &Feature, _: &SurfacePoint| if f.name == "far" { 4e-3 } else { 0.0 };
    for found in values(&text, &farther) {
        near(found, 4e-3, 1e-8);
    }
    let (none, problems) = read(&text.replace("at = \"0 30 15 mm\"", "at = \"0 31 15 mm\""));
    assert!(none.is_none() && problems.iter().any(|p| p.code == "wrong-place"), "{problems:?}");
}

/// Two slots in line, one 4 µm off, the other −2 µm, of other widths than they should have: their common middle goes through those of both, and
/// the middle of a slot between them is 1 + 6/80 · 9.75 µm off it at its end.
#[test]
fn law_the_common_middle_of_two_slots() {
    let slot = |name: &str, x: i32| {
        format!(
            "[feature.{name}]\nslot = {{ at = \"{x} 0 20 mm\", across = \"0 1 0\", along = \"1 0 0\", width = \"12 mm\", size = \"20 10 mm\" }}\n"
        )
    };
    let text = [
        "name = \"p\"\n",
        &slot("one", -40),
        &slot("other", 40),
        &slot("mid", 0),
        &asked("symmetry", "mid", "one-other"),
    ];
    for [wider, narrower] in [[0.0, 0.0], [15e-3, 8e-3], [-4e-3, 11e-3]] {
        let by = |f: &Feature, p: &SurfacePoint| match f.name.as_str() {
            "one" => 4e-3 * p.normal.y - wider,
            "other" => -2e-3 * p.normal.y + narrower,
            _ => 0.0,
        };
        near(values(&text.concat(), &by)[0], 2.0 * (1e-3 + 6e-3 / 80.0 * 9.75), 1e-8);
    }
}

/// Half of the points of a slot are still pairs that face each other: where the whole slot leans along its height no half of them has
/// another middle.
#[test]
fn law_half_of_a_slot_has_its_middle() {
    let text = [BASE, SLOT, &asked("position", "slot", ""), &asked("width", "slot", "")].concat();
    let part = part(&text);
    let lean = |p: &SurfacePoint| 1e-4 * (p.point_mm.z - 20.0) * p.normal.y;
    let deviation_mm: Vec<f64> = part
        .features
        .iter()
        .flat_map(|f| f.points.iter().map(|p| if f.name == "slot" { lean(p) } else { 0.0 }))
        .collect();
    near(part.evaluate(&deviation_mm).expect("values")[0], 2.0 * 4.75e-4, 1e-9);
    for change in part.by_points_mm(&deviation_mm).expect("changes") {
        near(change, 0.0, 1e-9);
    }
}

/// A keyway whose sides lie 3 µm off, 10 to 15 mm from the axis of its shaft: the zone turns about the axis until both ends are equally far off,
/// 3 µm · (b − a)/(b + a), a and b the distances of its outermost rows from the axis.
#[test]
fn law_a_keyway_is_symmetrical_about_an_axis() {
    let text = "name = \"p\"\n[feature.shaft]\ncylinder = { at = \"-40 0 0 mm\", axis = \"1 0 0\", diameter = \"30 mm\", length = \"80 mm\" }\n\
        [feature.keyway]\nslot = { at = \"0 0 12.5 mm\", across = \"0 1 0\", along = \"1 0 0\", width = \"8 mm\", size = \"30 5 mm\" }\nspacing = \"1 mm\"\n"
        .to_owned()
        + &asked("symmetry", "keyway", "shaft");
    let off = |f: &Feature, p: &SurfacePoint| match f.name.as_str() {
        "keyway" => 3e-3 * p.normal.y,
        _ => 0.0,
    };
    let (a, b) = (10.25, 14.75);
    near(values(&text, &off)[0], 2.0 * 3e-3 * (b - a) / (b + a), 1e-8);
    // Turned about the axis, and moved with its shaft: nothing.
    let turned = |f: &Feature, p: &SurfacePoint| match f.name.as_str() {
        "keyway" => (Vec3::x().cross(&p.point_mm) * 2e-4).dot(&p.normal),
        _ => 0.0,
    };
    near(values(&text, &turned)[0], 0.0, 1e-8);
    let shifted = |_: &Feature, p: &SurfacePoint| 4e-3 * p.normal.y;
    near(values(&text, &shifted)[0], 0.0, 2e-6);
}

/// Four holes on a circle of 40 mm. All moved alike: nothing where they may float; to datums that hold them, twice the shift. One moved by 8 µm
/// along the radius: 8 µm of position instead of 16, since the pattern goes half of the way; the circle of all 8 µm larger: 16 µm.
#[test]
fn law_a_pattern_floats_as_a_whole() {
    let ask = asked("position", "bolts", "A");
    let text =
        [BASE, HOLES, &ask, &asked("position", "bolts", ""), &asked("position", "bolts_1", "")]
            .concat();
    let shifted = |way: Vec3, which: &'static [&'static str]| {
        move |f: &Feature, p: &SurfacePoint| {
            let is_meant =
                f.pattern.is_some() && (which.is_empty() || which.contains(&f.name.as_str()));
            if is_meant { p.normal.dot(&way) } else { 0.0 }
        }
    };
    let found = values(&text, &shifted(Vec3::new(6e-3, -8e-3, 0.0), &[]));
    for (found, due) in found.iter().zip([0.0, 20e-3, 20e-3]) {
        near(*found, due, 2e-6);
    }
    let found = values(&text, &shifted(Vec3::x() * 8e-3, &["bolts_1"]));
    // Half of it by a shift; a turn does not help.
    for (found, due) in found.iter().zip([8e-3, 16e-3, 16e-3]) {
        near(*found, due, 2e-6);
    }
    let larger = |f: &Feature, p: &SurfacePoint| match (&f.pattern, f.geometry) {
        (Some(_), Geometry::Cylinder { at_mm, axis, .. }) => {
            let out = at_mm - axis * at_mm.dot(&axis);
            8e-3 * p.normal.dot(&out.normalize())
        }
        _ => 0.0,
    };
    near(values(&text, &larger)[0], 16e-3, 2e-6);
    // All turned about the middle of the circle by 100 µrad: 4 µm, floated away.
    let turned = |f: &Feature, p: &SurfacePoint| {
        let way = Vec3::z().cross(&p.point_mm) * 1e-4;
        if f.pattern.is_some() { p.normal.dot(&way) } else { 0.0 }
    };
    let found = values(&text, &turned);
    near(found[0], 0.0, 2e-6);
    near(found[1], 8e-3, 2e-6);
}

/// Members of a pattern, written one by one, are the same features; so are steps along two directions in either order.
#[test]
fn law_a_pattern_is_its_members() {
    let places = |text: &str| {
        let part = part(&(BASE.to_owned() + text + &asked("flatness", "base", "")));
        let mut all: Vec<[i64; 3]> = part.features[1..]
            .iter()
            .flat_map(|f| &f.points)
            .map(|p| <[f64; 3]>::from(p.point_mm).map(|c| (c * 1e6).round() as i64))
            .collect();
        all.sort_unstable();
        all
    };
    let hole = |at: &str, more: &str| {
        format!(
            "hole = {{ at = \"{at} mm\", axis = \"0 0 1\", diameter = \"8 mm\", length = \"10 mm\" }}\n{more}"
        )
    };
    let along = "{ count = 3, step = \"20 0 0 mm\" }";
    let across = "{ count = 2, step = \"0 15 0 mm\" }";
    let one = places(&format!(
        "[feature.a]\n{}",
        hole("0 0 0", &format!("repeat = [{along}, {across}]\n"))
    ));
    let other = places(&format!(
        "[feature.a]\n{}",
        hole("0 0 0", &format!("repeat = [{across}, {along}]\n"))
    ));
    assert_eq!(one, other);
    let mut singly = String::new();
    for (i, x) in [0, 20, 40].iter().enumerate() {
        for (k, y) in [0, 15].iter().enumerate() {
            singly += &format!("[feature.a{i}{k}]\n{}", hole(&format!("{x} {y} 0"), ""));
        }
    }
    assert_eq!(one, places(&singly));
    let about = places(&format!(
        "[feature.a]\n{}",
        hole(
            "30 0 0",
            "repeat = { count = 3, about = \"0 0 0 mm\", axis = \"0 0 1\", angle = \"90 deg\" }\n"
        )
    ));
    let apart = ["30 0 0", "0 30 0", "-30 0 0"].map(|at| hole(at, ""));
    let apart: String =
        apart.iter().enumerate().map(|(i, t)| format!("[feature.a{i}]\n{t}")).collect();
    let middle = |all: &[[i64; 3]]| {
        let sum = all.iter().fold([0; 3], |s, p| [s[0] + p[0], s[1] + p[1], s[2] + p[2]]);
        sum.map(|c| c / all.len() as i64)
    };
    assert_eq!(about.len(), places(&apart).len());
    assert_eq!(middle(&about), middle(&places(&apart)));
}

/// A rounding of 3 mm at the foot of a boss of 40 mm: its points lie on it, its normals out of the material, its profile is the material on it, twice.
#[test]
fn law_a_rounding_by_hand() {
    // The middle of the section lies 23 mm from the axis; the rounding is the quarter towards the axis and downwards, material outside.
    let text = BASE.to_owned()
        + "[feature.rounding]\nhollow_torus = { at = \"0 0 3 mm\", axis = \"0 0 1\", ring = \"46 mm\", diameter = \"6 mm\", section = [\"180 deg\", \"270 deg\"] }\n\
           spacing = \"0.5 mm\"\n"
        + &asked("profile", "rounding", "")
        + OUTSIDE
        + "[feature.end]\ndatum = \"C\"\nplane = { at = \"50 0 15 mm\", normal = \"1 0 0\", size = \"60 20 mm\" }\n"
        + &asked("profile", "rounding", "A|B|C");
    let part = part(&text);
    let rounding = &part.features[1];
    assert!(rounding.points.len() > 500);
    for p in &rounding.points {
        let out = Vec3::new(p.point_mm.x, p.point_mm.y, 0.0);
        let radius = out.norm();
        near((radius - 23.0).hypot(p.point_mm.z - 3.0), 3.0, 1e-12);
        assert!((20.0..23.0).contains(&radius) && (0.0..3.0).contains(&p.point_mm.z));
        // Towards the middle of the section.
        let middle = out / radius * 23.0 + Vec3::z() * 3.0;
        near((p.point_mm + p.normal * 3.0 - middle).norm(), 0.0, 1e-12);
    }
    // Eleven rows, from edge to edge of 4.71 mm; as many points as their length asks (Pappus).
    let rows_mm = 11.0 * TAU * (23.0 - 3.0 / FRAC_PI_2);
    near(rounding.points.len() as f64 * 0.5 / rows_mm, 1.0, 0.02);
    let found = values(&text, &|f, _| if f.name == "rounding" { 5e-3 } else { 0.0 });
    near(found[0], 10e-3, 1e-9);
    // As the base sees it, which is 2 µm lower than it should be.
    let lower = |f: &Feature, p: &SurfacePoint| match f.name.as_str() {
        "rounding" => 2e-3 * p.normal.z,
        _ => -2e-3 * p.normal.z,
    };
    assert!(values(&text, &lower)[1] > 3e-3);
    let moved = |_: &Feature, p: &SurfacePoint| 2e-3 * p.normal.z;
    // 2 µm of a radius of 3 mm: 0.7 nm of second order, twice.
    near(values(&text, &moved)[1], 0.0, 3e-6);
}

#[test]
fn bad_shapes_are_refused_by_name() {
    let all = [BASE, SLOT, OUTSIDE, HOLES, &asked("width", "slot", "")].concat();
    assert!(read(&all).0.is_some());
    for (from, to, code) in [
        ("width = \"20 um\"\nof = \"slot\"", "width = \"20 um\"\nof = \"base\"", "wrong-feature"),
        (
            "width = \"20 um\"\nof = \"slot\"",
            "symmetry = \"20 um\"\nof = \"slot\"",
            "wrong-feature",
        ),
        (
            "width = \"20 um\"\nof = \"slot\"",
            "symmetry = \"20 um\"\nof = \"slot\"\ndatum = \"A\"",
            "wrong-place",
        ),
        (
            "width = \"20 um\"\nof = \"slot\"",
            "width = \"20 um\"\nof = \"slot\"\ndatum = \"A\"",
            "wrong-feature",
        ),
        (
            "width = \"20 um\"\nof = \"slot\"",
            "position = \"20 um\"\nof = \"bolts_1\"\ndatum = \"A\"",
            "free-degree",
        ),
        (
            "width = \"20 um\"\nof = \"slot\"",
            "flatness = \"20 um\"\nof = \"base\"\n[feature.bolts_2]\nplane = { at = \"0 0 9 mm\", normal = \"0 0 1\", size = \"9 9 mm\" }\n",
            "double-feature",
        ),
        ("count = 4", "count = 1", "bad-count"),
        ("count = 4", "count = 4, angle = \"120 deg\"", "bad-angle"),
        ("count = 4", "count = 4, step = \"1 0 0 mm\"", "contradiction"),
        ("count = 4", "count = 100000", "too-many-points"),
        ("repeat = {", "datum = \"C\"\nrepeat = {", "wrong-feature"),
        (
            "across = \"0 1 0\", along = \"1 0 0\", width = \"12 mm\"",
            "across = \"0 1 0\", along = \"0 1 0\", width = \"12 mm\"",
            "bad-direction",
        ),
        ("width = \"12 mm\"", "width = \"-12 mm\"", "not-positive"),
        // Metres for micrometres.
        ("width = \"20 um\"", "width = \"20 m\"", "impossible-value"),
        ("width = \"20 um\"", "width = [\"-20 um\", \"20 m\"]", "impossible-value"),
        (
            "width = \"20 um\"\nof = \"slot\"",
            "flatness = \"20 m\"\nof = \"base\"",
            "impossible-value",
        ),
    ] {
        let text = all.replacen(from, to, 1);
        assert_ne!(text, all, "{from}");
        let (part, problems) = read(&text);
        assert!(part.is_none(), "{to}");
        let codes: Vec<&str> = problems.iter().map(|p| p.code).collect();
        assert!(codes.contains(&code), "{to}: {codes:?}");
    }
    let torus = BASE.to_owned()
        + "[feature.r]\ntorus = { at = \"0 0 3 mm\", axis = \"0 0 1\", ring = \"46 mm\", diameter = \"6 mm\", section = [\"0 deg\", \"90 deg\"] }\n"
        + &asked("profile", "r", "");
    assert!(read(&torus).0.is_some());
    for (from, to, code) in [
        ("ring = \"46 mm\"", "ring = \"5 mm\"", "not-positive"),
        ("[\"0 deg\", \"90 deg\"]", "[\"90 deg\", \"0 deg\"]", "bad-angle"),
        ("[\"0 deg\", \"90 deg\"]", "\"90 deg\"", "wrong-type"),
        ("[\"0 deg\", \"90 deg\"]", "[\"0 deg\", \"400 deg\"]", "bad-angle"),
    ] {
        let (part, problems) = read(&torus.replacen(from, to, 1));
        assert!(part.is_none(), "{to}");
        let codes: Vec<&str> = problems.iter().map(|p| p.code).collect();
        assert!(codes.contains(&code), "{to}: {codes:?}");
    }
}

#[derive(serde::Deserialize)]
struct Cases {
    cases: Vec<Case>,
}

#[derive(serde::Deserialize)]
struct Case {
    kind: String,
    count: usize,
    offsets_mm: Vec<[f64; 2]>,
    position_mm: f64,
}

/// The place of a pattern as a whole, by `oracles/pattern.py` (scipy).
#[test]
fn oracle_the_place_of_a_pattern() {
    let all: Cases = serde_json::from_str(include_str!("data/pattern.json")).expect("the data");
    for case in &all.cases {
        let (at, repeat) = match case.kind.as_str() {
            "circle" => {
                let about = "about = \"0 0 0 mm\", axis = \"0 0 1\"";
                ("40 0 0", format!("{{ count = {}, {about} }}", case.count))
            }
            _ => {
                let rows = case.count / 3;
                let along = "{ count = 3, step = \"20 0 0 mm\" }";
                ("0 0 0", format!("[{along}, {{ count = {rows}, step = \"0 15 0 mm\" }}]"))
            }
        };
        let hole = format!(
            "[feature.holes]\nhole = {{ at = \"{at} mm\", axis = \"0 0 1\", diameter = \"8 mm\", length = \"10 mm\" }}\nrepeat = {repeat}\n"
        );
        let text = BASE.to_owned() + &hole + &asked("position", "holes", "A");
        let part = part(&text);
        let offset = |f: &Feature| {
            let number: usize = f.name.rsplit('_').next()?.parse().ok()?;
            let [x, y] = case.offsets_mm[number - 1];
            Some(Vec3::new(x, y, 0.0))
        };
        let of = |f: &Feature| {
            let way = offset(f).unwrap_or(Vec3::zeros());
            f.points.iter().map(move |p| p.normal.dot(&way)).collect::<Vec<f64>>()
        };
        let deviation_mm: Vec<f64> = part.features.iter().flat_map(of).collect();
        let found = part.evaluate(&deviation_mm).expect("a value")[0];
        // Points all around leave the centre of a displaced hole where it is, to second order.
        near(found, case.position_mm, 2e-8);
    }
}

/// A strip of 150 × 4 mm has rows enough for a plane, whatever spacing is asked for; a characteristic without a value is named.
#[test]
fn law_a_narrow_strip_is_a_plane() {
    for spacing in ["", "spacing = \"50 mm\"\n"] {
        let strip = format!(
            "name = \"p\"\n[feature.strip]\nplane = {{ at = \"0 0 0 mm\", normal = \"0 0 1\", size = \"150 4 mm\" }}\n{spacing}"
        );
        let found = values(&(strip + &asked("flatness", "strip", "")), &|_, p| 1e-4 * p.point_mm.y);
        near(found[0], 0.0, 1e-9);
    }
    let table = "name = \"p\"\n[feature.line]\nhole = { at = \"0 0 0 mm\", axis = \"0 0 1\", diameter = \"8 mm\", length = \"10 mm\" }\n"
        .to_owned()
        + &asked("cylindricity", "line", "");
    let part = part(&table);
    // A hole that is closed up: all points of it on its axis.
    let error = part.evaluate(&vec![4.0; part.points()]).expect_err("no cylinder").to_string();
    assert!(error.starts_with("cylindricity of line: "), "{error}");
}

/// Two slots as one datum, one of them 6 µm beside the other: the middle is the line through both, though the first is narrower by 20 µm in its upper
/// half and the other by 8 µm all over: what they are narrower does not count. A slot above the second is 6 · 84.75/80 µm off at its outer end.
#[test]
fn law_how_narrow_slots_are_does_not_move_their_common_middle() {
    let slot = |name: &str, x: i32, z: i32| {
        format!(
            "[feature.{name}]\nslot = {{ at = \"{x} 0 {z} mm\", across = \"0 1 0\", along = \"1 0 0\", width = \"12 mm\", size = \"10 10 mm\" }}\n"
        )
    };
    let text = ["name = \"p\"\n", &slot("P", -40, 0), &slot("Q", 40, 0), &slot("R", 40, 30)]
        .concat()
        + &asked("symmetry", "R", "P-Q");
    let by = |f: &Feature, p: &SurfacePoint| match f.name.as_str() {
        "P" if p.point_mm.z > 0.0 => 10e-3,
        // Material on both faces, and all of it along Y.
        "Q" => 4e-3 + 6e-3 * p.normal.y,
        _ => 0.0,
    };
    near(values(&text, &by)[0], 2.0 * 6e-3 * 84.75 / 80.0, 1e-7);
}

/// `along` out of the plane counts by its direction within it, and is named.
#[test]
fn a_direction_out_of_the_plane_is_named() {
    let all = [BASE, SLOT, OUTSIDE, HOLES, &asked("width", "slot", "")].concat();
    for (along, told) in [("1 0 0.0001", vec![]), ("1 0 0.3", vec!["bad-direction"])] {
        let text = all.replacen("along = \"1 0 0\"", &format!("along = \"{along}\""), 1);
        assert_ne!(text, all);
        let (part, problems) = read(&text);
        assert!(part.is_some(), "{problems:?}");
        let codes: Vec<&str> = problems.iter().map(|p| p.code).collect();
        assert_eq!(codes, told, "{along}");
    }
}
