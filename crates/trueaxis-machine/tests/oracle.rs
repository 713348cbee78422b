//! Against other software: plain 4×4 matrices and splines in Python, 50 digits (oracles/).

mod library;

use library::{command, golden, machine, machine_of};
use trueaxis_geometry::Vec3;
use trueaxis_geometry::frame::{Direction, Point};
use trueaxis_machine::Machine;
use trueaxis_machine::errors::{ErrorValues, Interpolation, Spline};

/// Compares nominal poses and deviations with a golden table and judges by the worst row.
fn compare(machine: &Machine, file: &str) {
    let (heads, rows) = golden(&format!("poses/{file}.csv"));
    assert!(rows.len() >= 30, "{file}: too few rows");
    let (mut tip_mm, mut axis, mut tip_um, mut axis_urad) = (0.0_f64, 0.0_f64, 0.0_f64, 0.0_f64);
    for row in &rows {
        let at = command(machine, &heads, row);
        let errors = machine.errors_at(&at, &[0.0; 6]).expect("within the tables");
        let ours = machine.deviation(&at, &errors);
        let n = heads.len() - 12;
        let vector = |i: usize| Vec3::new(row[n + i], row[n + i + 1], row[n + i + 2]);
        tip_mm = tip_mm.max((ours.nominal_tip.vector() - vector(0)).amax());
        axis = axis.max((ours.nominal_axis.vector() - vector(3)).amax());
        tip_um = tip_um.max((ours.tip_mm * 1e3 - vector(6)).amax());
        axis_urad = axis_urad.max((ours.axis * 1e6 - vector(9)).amax());

        // The matrix product says the same, with a double's digits of a 6 m machine.
        let actual = machine.pose(&at, &errors);
        let tip = actual * Point::from_vector(machine.tip_mm());
        let whole = ours.nominal_tip.vector() + ours.tip_mm;
        assert!((tip.vector() - whole).amax() < 1e-9);
        let direction = (actual * Direction::Z).vector();
        assert!((direction - ours.nominal_axis.vector() - ours.axis).amax() < 1e-13);
        let nominal = machine.pose(&at, &ErrorValues::default());
        let nominal_tip = nominal * Point::from_vector(machine.tip_mm());
        assert!((nominal_tip.vector() - ours.nominal_tip.vector()).amax() < 1e-9);
    }
    assert!(tip_mm < 1e-9 && axis < 1e-12, "{file}: nominal pose {tip_mm:e} {axis:e}");
    assert!(tip_um < 1e-9 && axis_urad < 1e-9, "{file}: deviation {tip_um:e} {axis_urad:e}");
}

#[test]
fn oracle_poses_of_the_shipped_machines() {
    for name in library::FIVE_AXIS {
        compare(&machine(name), name);
    }
}

#[test]
fn oracle_small_angle_matrices() {
    let small = |text: String| text.replace("[machine]", "[machine]\nrotation = \"small-angle\"");
    compare(&machine_of("xkas2525", small), "xkas2525.small-angle");
}

#[test]
fn oracle_error_motions_in_the_fixed_frame() {
    let fixed = |text: String| text.replace("\"moving\"", "\"fixed\"");
    compare(&machine_of("xkas2525", fixed), "xkas2525.error-frame-fixed");
}

#[test]
fn oracle_squareness_of_the_direction_of_motion() {
    let tilted = |text: String| text.replace("[machine]", "[machine]\nsquareness = \"direction\"");
    compare(&machine_of("xkas2525", tilted), "xkas2525.squareness-direction");
}

/// One table of `splines.csv`: its knots, and the points between them where it is judged.
#[derive(Default)]
struct SplineCase {
    boundary: String,
    knots: [Vec<f64>; 2],
    judged: Vec<[f64; 3]>,
}

#[test]
fn oracle_splines_of_scipy() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/splines.csv");
    let text = std::fs::read_to_string(path).expect("splines.csv");
    let mut cases = std::collections::BTreeMap::<String, SplineCase>::new();
    for line in text.lines().filter(|l| !l.starts_with('#')).skip(1) {
        let f: Vec<&str> = line.split(',').collect();
        let case = cases.entry(f[0].to_owned()).or_default();
        case.boundary = f[1].to_owned();
        let number = |i: usize| f[i].parse::<f64>().expect("a number");
        if f[2] == "knot" {
            case.knots[0].push(number(3));
            case.knots[1].push(number(4));
        } else {
            case.judged.push([number(3), number(4), number(5)]);
        }
    }
    assert!(cases.len() >= 6);
    for (name, case) in cases {
        let how = match case.boundary.as_str() {
            "periodic" => Interpolation::Periodic,
            _ => Interpolation::NotAKnot,
        };
        let spline = Spline::new(&case.knots[0], &case.knots[1], how).expect("a spline");
        let scale = case.knots[1].iter().fold(1.0_f64, |m, v| m.max(v.abs()));
        for [x, y, slope] in case.judged {
            assert!((spline.at(x) - y).abs() < 1e-12 * scale, "{name} at {x}");
            assert!((spline.slope_at(x) - slope).abs() < 1e-11 * scale, "{name} slope at {x}");
        }
    }
}
