//! Every unit that a file may use against pint (oracles/units.py).

use std::collections::BTreeSet;
use trueaxis_input::{Dimension, parse_quantity};

const SIZES: &str = include_str!("data/units.csv");

fn dimension(name: &str) -> Dimension {
    use Dimension::*;
    match name {
        "Length" => Length,
        "Angle" => Angle,
        "Time" => Time,
        "Velocity" => Velocity,
        "Acceleration" => Acceleration,
        "Jerk" => Jerk,
        "AngularVelocity" => AngularVelocity,
        "AngularAcceleration" => AngularAcceleration,
        "AngularJerk" => AngularJerk,
        "Expansion" => Expansion,
        "LengthPerKelvin" => LengthPerKelvin,
        "AnglePerKelvin" => AnglePerKelvin,
        "Diffusivity" => Diffusivity,
        "FilmCoefficient" => FilmCoefficient,
        "HeatCapacity" => HeatCapacity,
        "Power" => Power,
        "Ratio" => Ratio,
        other => panic!("{other}"),
    }
}

fn rows() -> impl Iterator<Item = (Dimension, &'static str, f64)> {
    SIZES.lines().skip(2).map(|row| {
        let cells: Vec<&str> = row.split(',').collect();
        (dimension(cells[0]), cells[1], cells[2].parse().expect("a number"))
    })
}

#[test]
fn oracle_every_unit_has_its_size() {
    for (dimension, unit, size) in rows() {
        // The micro sign and the Greek letter look alike.
        for unit in [unit.to_owned(), unit.replace('µ', "μ")] {
            let found = parse_quantity(&format!("1 {unit}"), dimension).expect(&unit);
            assert!((found / size - 1.0).abs() < 1e-15, "1 {unit} is {found}, {size} by pint");
        }
    }
}

/// A unit that is added later needs its row.
#[test]
fn no_unit_is_left_out() {
    let known: BTreeSet<String> = rows().map(|(_, unit, _)| unit.to_owned()).collect();
    for (dimension, ..) in rows() {
        for unit in dimension.units().split(", ").filter(|u| !u.is_empty()) {
            assert!(known.contains(&unit.replace('μ', "µ")), "{unit}");
        }
    }
}
