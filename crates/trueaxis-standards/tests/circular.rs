//! Circular tests: the order of the paths, arcs beside circles and the centre must not matter.

use std::f64::consts::TAU;
use trueaxis_input::{Diagnostics, Place};
use trueaxis_standards::Evaluated;
use trueaxis_standards::conditions::{Circle, Conditions};
use trueaxis_standards::iso230_4::{Cause, Circular, diagnose, evaluate};
use trueaxis_standards::judge::figures;

const RADIUS_MM: f64 = 150.0;

/// One path: its sense, how far it goes, and its deviation by angle and sense, µm.
type Run<'a> = (f64, f64, &'a dyn Fn(f64) -> f64);

fn table(runs: &[Run<'_>], shift: [f64; 2]) -> String {
    let mut text = "x_mm,y_mm,direction\n".to_owned();
    for (sense, degrees, radial) in runs {
        let word = if *sense > 0.0 { "ccw" } else { "cw" };
        for i in 0..=*degrees as usize {
            let angle = sense * (i as f64 / 360.0 * TAU + 1e-4);
            let r = RADIUS_MM + radial(angle) * 1e-3;
            let (x, y) = (shift[0] + r * angle.cos(), shift[1] + r * angle.sin());
            text += &format!("{x},{y},{word}\n");
        }
    }
    text
}

fn found(text: &str) -> (Circular, Vec<&'static str>) {
    let (centre_mm, radius_mm) = (Some([0.0; 2]), Some(RADIUS_MM));
    let circle = Circle { centre_mm, radius_mm, ..Circle::default() };
    let conditions = Conditions { circle, ..Conditions::default() };
    let mut problems = Diagnostics::new();
    let mut circle = evaluate("c.csv", text, conditions.circle, &mut problems).expect("a circle");
    let place = Place::whole("c.toml");
    circle.diagnosis = diagnose(&circle, &conditions, &place, &mut problems);
    (circle, problems.iter().map(|d| d.code).collect())
}

/// Every figure by its name, each once.
fn named(circle: &Circular) -> Vec<(String, f64)> {
    let all = figures(&Evaluated::Circular(Box::new(circle.clone())), &Conditions::default());
    let mut named: Vec<(String, f64)> = all.into_iter().map(|f| (f.name, f.value)).collect();
    named.sort_by(|a, b| a.0.cmp(&b.0));
    let count = named.len();
    named.dedup_by(|a, b| a.0 == b.0);
    assert_eq!(named.len(), count, "a figure has two values");
    named
}

#[track_caller]
fn same(a: &[(String, f64)], b: &[(String, f64)], allowed: f64) {
    assert_eq!(a.len(), b.len());
    for ((name, ours), (other, theirs)) in a.iter().zip(b) {
        assert!(
            name == other && (ours - theirs).abs() <= allowed,
            "{name}: {ours} {other} {theirs}"
        );
    }
}

/// A good and a bad path in one direction: the bad one counts, wherever it stands.
#[test]
fn law_the_order_of_paths_does_not_matter() {
    let (good, bad): (&dyn Fn(f64) -> f64, &dyn Fn(f64) -> f64) =
        (&|a| (2.0 * a).cos(), &|a| 20.0 * (2.0 * a).cos() - 7.0);
    let (ccw, cw, worse) = ((1.0, 360.0, good), (-1.0, 360.0, good), (1.0, 360.0, bad));
    let orders = [[ccw, cw, worse], [worse, cw, ccw], [cw, ccw, worse], [cw, worse, ccw]];
    let all: Vec<_> = orders.iter().map(|runs| named(&found(&table(runs, [0.0; 2])).0)).collect();
    let of = |name: &str| all[0].iter().find(|(n, _)| n == name).expect("a figure").1 * 1e3;
    for (name, um) in [("G_ccw", 40.0), ("G_cw", 2.0), ("G", 40.0), ("F_ccw_min", -27.0)] {
        assert!((of(name) - um).abs() < 0.2, "{name}: {}", of(name));
    }
    // Both are 0 but for the bad path: (−7 + 0)/2.
    assert!(of("G_b") > 39.0 && (of("D") + 3.5).abs() < 0.05, "{} {}", of("G_b"), of("D"));
    same(&all[0], &all[1], 1e-9);
    // Neighbours of one direction are one record of two turns, cut at a point that belongs to both.
    same(&all[0], &all[2], 5e-5);
    same(&all[0], &all[3], 5e-5);
}

/// A lead-in before a circle, or a run that was broken off, changes nothing but the warnings.
#[test]
fn law_an_arc_beside_whole_circles_is_in_no_result() {
    let round: &dyn Fn(f64) -> f64 = &|a| 3.0 * (2.0 * a).sin();
    let far: &dyn Fn(f64) -> f64 = &|_| -120.0;
    let whole = [(1.0, 360.0, round), (-1.0, 360.0, round)];
    let (expected, codes) = found(&table(&whole, [0.0; 2]));
    assert!(codes.iter().all(|c| *c != "partial-circle"), "{codes:?}");
    // Beside a path of its own direction an arc would be one record with it.
    for (at, sense) in [(0, -1.0), (2, 1.0)] {
        let mut runs = whole.to_vec();
        runs.insert(at, (sense, 60.0, far));
        let (circle, codes) = found(&table(&runs, [0.0; 2]));
        assert!(codes.contains(&"partial-circle"), "{at}: {codes:?}");
        same(&named(&expected), &named(&circle), 1e-12);
    }
    // Where there is nothing else, the arc is what was asked.
    let (arc, codes) = found(&table(&[(1.0, 270.0, round)], [0.0; 2]));
    assert!(codes.contains(&"partial-circle") && arc.paths.len() == 1, "{codes:?}");
}

/// Two turns in one record are two paths: neither is taken for overlap.
#[test]
fn two_turns_are_two_paths() {
    let second: &dyn Fn(f64) -> f64 =
        &|a| if a > TAU + 0.01 { 10.0 * (2.0 * a).cos() } else { (2.0 * a).cos() };
    let (circle, _) = found(&table(&[(1.0, 720.0, second)], [0.0; 2]));
    let g: Vec<f64> = circle.paths.iter().map(|p| (p.g_mm * 1e3).round()).collect();
    assert_eq!(g, [2.0, 20.0]);
}

/// Where the circle lies in the coordinates of the readings changes its centre and F, and no cause.
#[test]
fn law_causes_do_not_depend_on_the_centre() {
    let sign = |v: f64| if v > 0.0 { 1.0 } else { -1.0 };
    let ccw: &dyn Fn(f64) -> f64 =
        &|a| 2.5 * (2.0 * a).cos() + 1.5 * (2.0 * a).sin() - 2.0 * sign(-a.sin()) * a.cos();
    let cw: &dyn Fn(f64) -> f64 =
        &|a| 2.5 * (2.0 * a).cos() + 0.5 * (2.0 * a).sin() - 2.0 * sign(a.sin()) * a.cos();
    let runs = [(1.0, 360.0, ccw), (-1.0, 360.0, cw)];
    let of = |shift: [f64; 2]| found(&table(&runs, shift)).0;
    let centred = of([0.0; 2]);
    let values = |c: &Circular| {
        let all = c.diagnosis.as_ref().expect("a diagnosis").found.iter();
        let mut all: Vec<_> = all.map(|f| (f.cause, f.value, f.uncertainty.u)).collect();
        all.sort_by_key(|f| f.0);
        all
    };
    let scale = centred.diagnosis.as_ref().and_then(|d| d.of(Cause::ScaleMismatch));
    assert!((scale.expect("a scale").value * 1e3 - 10.0).abs() < 0.05);
    for shift in [[1.0, 0.0], [0.6, -0.8], [5.0, 0.0], [-3.0, 4.0]] {
        let moved = of(shift);
        for (a, b) in values(&centred).into_iter().zip(values(&moved)) {
            assert!(
                a.0 == b.0 && (a.1 - b.1).abs() < 1e-7 && (a.2 - b.2).abs() < 1e-7,
                "{a:?} {b:?}"
            );
        }
        let (a, b) = (centred.causes.as_ref().expect("causes"), moved.causes.expect("causes"));
        for (ours, theirs) in [
            (a.scale_mismatch_mm, b.scale_mismatch_mm),
            (a.backlash_mm[0], b.backlash_mm[0]),
            (a.centre_mm[0] + shift[0], b.centre_mm[0]),
            (a.centre_mm[1] + shift[1], b.centre_mm[1]),
        ] {
            assert!((ours - theirs).abs() < 1e-7, "{shift:?}: {ours} {theirs}");
        }
    }
}
