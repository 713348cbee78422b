//! Probing performance: other software, the calibration of the same hits, and what must not matter.

use serde_json::Value;
use trueaxis_geometry::statistics::SplitMix64;
use trueaxis_input::Diagnostics;
use trueaxis_standards::conditions::Conditions;
use trueaxis_standards::iso230_10::{Probing, evaluate};
use trueaxis_standards::judge::Decision;

const DATA: &str = include_str!("../../../examples/07_verify/probe-performance.csv");
const TEST: &str = include_str!("../../../examples/07_verify/probe-performance.toml");
const RING_60: &str = include_str!("../../../examples/05_identify/ring-60.csv");

fn tried(text: &str, conditions: &str) -> (Option<Probing>, Diagnostics) {
    let (conditions, read) = Conditions::read("p.toml", conditions);
    assert!(!read.has_errors(), "{read:?}");
    let mut problems = Diagnostics::new();
    let found = evaluate("p.csv", text, &conditions, &mut problems);
    (found, problems)
}

#[track_caller]
fn found(text: &str, conditions: &str) -> Probing {
    let (found, problems) = tried(text, conditions);
    assert!(!problems.has_errors(), "{problems:?}");
    found.expect("a result")
}

fn um(p: &Probing, name: &str) -> f64 {
    let quantity = p.quantities.iter().find(|q| q.name == name);
    quantity.unwrap_or_else(|| panic!("no {name}: {:?}", p.quantities)).value_mm * 1e3
}

/// SciPy finds the same ranges, circles, spheres and uncertainty.
#[test]
fn oracle_scipy_on_the_example() {
    let expected: Value = serde_json::from_str(include_str!("data/iso230-10.json")).expect("JSON");
    let ours = found(DATA, TEST);
    let figures = expected["um"].as_object().expect("figures");
    for (name, value) in figures {
        let value = value.as_f64().expect("a number");
        assert!((um(&ours, name) - value).abs() < 1e-6, "{name}: {} and {value}", um(&ours, name));
    }
    let stated = ours.quantities.iter().filter(|q| q.name.starts_with("effective less"));
    assert_eq!(ours.quantities.len(), figures.len() + stated.count());
    let s = expected["s_um"].as_f64().expect("s");
    assert!((ours.scatter.expect("repeated hits").0 * 1e3 - s).abs() < 1e-9);
    let form = ours.quantities.iter().find(|q| q.name.starts_with("P_FTU,3D")).expect("a sphere");
    let u = expected["u_form_um"].as_f64().expect("U");
    assert!((form.expanded_mm.expect("U") * 1e3 - u).abs() < 1e-9);
    assert!(ours.is_yes() && form.outcome == Some(Decision::Conforming));
}

/// `identify probe` prints for these hits: 23.78 µm about the centre that is found.
#[test]
fn a_ring_is_that_of_the_calibration() {
    let ours = found(RING_60, "");
    assert!((um(&ours, "P_FTU,2D of ring at 0°") - 23.780).abs() < 6e-4, "{:?}", ours.quantities);
    // Four hits of a circle by hand: 4 µm at one of them is 1 µm at each.
    let four = "x_mm,y_mm\n10.004,0\n0,10\n-10,0\n0,-10\n";
    assert!((um(&found(four, ""), "P_FTU,2D of ring") - 2.0).abs() < 1e-3);
}

/// The order of rows, the unit, the place and the frame change nothing; a larger pre-travel in all directions neither.
#[test]
fn law_what_must_not_matter_does_not() {
    let first = found(DATA, TEST);
    let lines: Vec<&str> = DATA.lines().filter(|l| !l.starts_with('#')).collect();
    let mut turned: Vec<&str> = lines[1..].to_vec();
    turned.reverse();
    let by_name = |p: &Probing, same: f64| {
        for q in &first.quantities {
            assert!((um(p, &q.name) - q.value_mm * 1e3).abs() < same, "{}", q.name);
        }
    };
    by_name(&found(&format!("{}\n{}", lines[0], turned.join("\n")), TEST), 1e-8);
    let moved: String = lines[1..]
        .iter()
        .map(|line| {
            let c: Vec<&str> = line.split(',').collect();
            let [x, y, z] = [3, 4, 5].map(|k| c[k].parse::<f64>().expect("a number") * 1e3);
            format!("{},{},{},{},{},{}\n", c[0], c[1], c[2], x + 1e5, y - 2e5, z + 3e5)
        })
        .collect();
    by_name(&found(&format!("test,direction,orientation_deg,x_um,y_um,z_um\n{moved}"), TEST), 1e-6);
}

/// U of the form covers what a probe without noise shows, in most draws: the range of many noisy points is larger than
/// that of few, so that U errs to the safe side only for the extreme points themselves.
#[test]
fn law_spheres_come_back() {
    let mut random = SplitMix64::new(5);
    let mut unit = || 2.0 * random.unit() - 1.0;
    for _ in 0..200 {
        let (centre, radius) =
            ([100.0 * unit(), 100.0 * unit(), 100.0 * unit()], 15.0 + 5.0 * unit());
        let mut text = "x_mm,y_mm,z_mm\n".to_owned();
        for _ in 0..25 {
            let d = [unit(), unit(), 0.3 + unit().abs()];
            let length = (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]).sqrt();
            let [x, y, z] = [0, 1, 2].map(|k| centre[k] + radius * d[k] / length);
            text += &format!("{x},{y},{z}\n");
        }
        let conditions = format!(
            "[probing]\nsphere_diameter = '{} mm'\npoints = 'contact'\nsphere_centre = '{} {} {} mm'",
            2.0 * radius,
            centre[0],
            centre[1],
            centre[2]
        );
        let ours = found(&text, &conditions);
        for q in &ours.quantities {
            assert!(q.value_mm.abs() < 1e-9, "{q:?}");
        }
        assert_eq!(ours.quantities.len(), 3);
    }
}

/// Any text as a table: diagnostics, never a panic, and no number that is not finite.
#[test]
fn law_hostile_tables_end_in_words() {
    let junk = ["nan", "1e999", "-", ",", "\n", "é", "1e300", "ring", "0", "\u{0}", "1e-300,"];
    let mut random = SplitMix64::new(6);
    for k in 0..800 {
        let mut text = DATA.to_owned();
        for _ in 0..1 + k % 3 {
            let places: Vec<usize> = text.char_indices().map(|(i, _)| i).collect();
            let at = places[(random.unit() * places.len() as f64) as usize];
            text.insert_str(at, junk[(random.unit() * junk.len() as f64) as usize]);
        }
        let (found, problems) = tried(&text, TEST);
        assert!(found.is_some() || problems.has_errors());
        for q in found.iter().flat_map(|f| &f.quantities) {
            assert!(q.value_mm.is_finite() && q.expanded_mm.is_none_or(f64::is_finite), "{q:?}");
        }
    }
}

#[test]
fn bad_tables_end_in_words() {
    let codes = |text: &str| -> Vec<&'static str> {
        let (found, problems) = tried(text, "");
        assert!(found.is_none(), "{text}");
        problems.iter().map(|d| d.code).collect()
    };
    assert_eq!(codes("test,x_mm,y_mm\nbore,1,2\n"), ["unknown-word"]);
    assert_eq!(codes("test,x_mm,y_mm\nsphere,1,2\n"), ["missing-column"]);
    assert_eq!(
        codes("test,direction,x_mm,y_mm,z_mm\npoint,up,1,2,3\npoint,up,1,2,3\n"),
        ["unknown-word"]
    );
    assert_eq!(codes("test,direction,x_mm,y_mm,z_mm\npoint,+X,1,2,3\n"), ["few-hits"]);
    assert_eq!(codes("x_mm,y_mm,z_mm\n0,0,1\n1,0,1\n0,1,1\n1,1,1\n"), ["no-shape"]);
    assert_eq!(codes("x_mm,y_mm\n0,0\n1,0\n2,0\n"), ["no-shape"]);
    // A pole of a sphere and few points are said.
    let (found, problems) = tried("x_mm,y_mm,z_mm\n1,0,0\n-1,0,0\n0,1,0\n0,0,1\n0,-1,0\n", "");
    assert!(found.is_some());
    assert_eq!(problems.iter().map(|d| d.code).collect::<Vec<_>>(), ["not-25-points"]);
}
