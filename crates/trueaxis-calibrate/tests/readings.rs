//! Readings: where they are taken, what one of them does to the result, and what is said of a wrong unit or sign.

mod library;

use library::{bare, disk, poses, probe_campaign, read, root, within};
use std::collections::BTreeMap;
use trueaxis_calibrate::identify::convention::check_conventions;
use trueaxis_calibrate::identify::influence::influences;
use trueaxis_geometry::statistics::SplitMix64;
use trueaxis_machine::errors::ErrorName;
use trueaxis_measure::measure::virtual_campaign::{measure, read_virtual};
use trueaxis_measure::measure::{Kind, Readings, read_campaign};
use trueaxis_measure::unknowns::design::Design;
use trueaxis_measure::unknowns::fit::fit;
use trueaxis_measure::unknowns::term::Shape;

/// Location errors of some 20 µm and 60 µrad, as a probe with 1 µm of noise reads them.
fn campaign(count: u32, seed: u64) -> (Design, Readings) {
    let mut random = SplitMix64::new(seed);
    let machine = bare("lei-hsu-mill");
    let design = probe_campaign(machine.clone()).design();
    let size = |k: usize| if design.unknown(k).is_some_and(|u| u.is_angle()) { 6e-5 } else { 0.02 };
    let values: Vec<f64> = (0..design.unknowns()).map(|k| within(&mut random, size(k))).collect();
    let at = poses(&mut random, &machine, count);
    let readings = read(&mut random, &design, &at, &values);
    (design, readings)
}

/// Cook (1977): the sum of squares by which all predictions move, in units of the noise, over the number of unknowns found;
/// a row counts with its weight.
#[test]
fn law_cooks_distance_is_what_leaving_a_row_out_moves() {
    let (design, readings) = campaign(14, 5);
    let mut weights: Vec<f64> = (0..readings.len()).map(|i| [1.0, 0.5, 2.0][i % 3]).collect();
    let whole = fit(&design, &readings, &weights).expect("a fit");
    let found = influences(&design, &readings, &weights, &whole);
    for left_out in 0..readings.len() {
        let weight = std::mem::replace(&mut weights[left_out], 0.0);
        let without = fit(&design, &readings, &weights).expect("a fit");
        weights[left_out] = weight;
        assert_eq!(without.sight.rank, whole.sight.rank, "nothing else rests on one row");
        let mut moved = 0.0;
        for (i, weight) in weights.iter().enumerate() {
            let noise = design.instruments[0].noise;
            let of = |values: &[f64]| design.read(&readings, i, values).expect("a reading");
            let (before, after) = (of(&whole.values), of(&without.values));
            let squares = (0..3).map(|c| ((after[c] - before[c]) / noise[c]).powi(2));
            moved += weight * squares.sum::<f64>();
        }
        let (due, cook) = (moved / whole.sight.rank as f64, found.rows[left_out].cook);
        assert!(
            (cook - due).abs() < 0.01 * due + 1e-6,
            "{left_out}: {cook}, by leaving it out {due}"
        );
    }
}

/// A heading with the wrong unit makes all readings too large or too small by one factor; the errors follow, the residual
/// against the noise gives it away.
#[test]
fn law_a_wrong_unit_is_named_and_no_other() {
    let (design, readings) = campaign(60, 9);
    let zero = vec![0.0; design.unknowns()];
    // What is written is the deviation from the machine without errors.
    let words = [
        (1.0, None),
        (1000.0, Some("µm written as mm")),
        (0.001, Some("mm written as µm")),
        (25.4, None),
        (1.0 / 25.4, Some("inch written as mm")),
        (25_400.0, Some("µm written as inch")),
        (1.0 / 25_400.0, Some("inch written as µm")),
    ];
    for (factor, due) in words {
        let mut scaled = readings.clone();
        for i in 0..scaled.len() {
            let exact = design.read(&readings, i, &zero).expect("a reading");
            let value = scaled.values[i].iter_mut().zip(exact);
            value.for_each(|(value, exact)| *value = exact + factor * (*value - exact));
        }
        let remarks = check_conventions(&design, &scaled).remarks;
        let found: Vec<&String> = remarks.iter().filter(|r| r.contains("written as")).collect();
        match due {
            Some(due) => assert!(
                found.iter().any(|r| r.ends_with(&format!("{due}?"))),
                "{factor}: {found:?}"
            ),
            None => assert!(found.is_empty(), "{factor}: {found:?}"),
        }
    }
}

/// Of an instrument with one number a turn at one row is found: written by hand until then, by a program from there on.
#[test]
fn law_rows_turned_up_to_one_are_the_rarer_ones() {
    let machine = bare("three-axis-mill");
    let mut campaign = probe_campaign(machine.clone());
    let laser = &mut campaign.instruments[0];
    (laser.kind, laser.sight) = (Kind::LaserLine, Kind::LaserLine.sight());
    laser.unknowns.clear();
    let name = ErrorName::parse("EXX").expect("an error");
    campaign.terms = Shape::parse("polynomial 1-2").expect("a shape").terms(&machine, name);
    let design = campaign.design();
    let mut random = SplitMix64::new(3);
    let values: Vec<f64> = (0..design.unknowns()).map(|_| 0.05 + random.unit() * 0.01).collect();
    let at = poses(&mut random, &machine, 60);
    let straight = read(&mut random, &design, &at, &values);
    let zero = vec![0.0; design.unknowns()];
    for turned in [0, 25, 40] {
        let mut readings = straight.clone();
        for i in 0..turned {
            let exact = design.read(&at, i, &zero).expect("a reading")[0];
            readings.values[i][0] = exact - (readings.values[i][0] - exact);
        }
        let due: Vec<usize> =
            if turned < 30 { (0..turned).collect() } else { (turned..60).collect() };
        assert_eq!(check_conventions(&design, &readings).mixed, due);
    }
}

/// Stations of a path are evenly spaced from its first angle to its last, and back the same way.
#[test]
fn law_a_path_goes_from_its_first_angle_to_its_last() {
    let path = root().join("examples/05_identify/path-in-memory.toml");
    for (from, to, count, back) in
        [(0.0, 330.0, 12, false), (45.0, -90.0, 2, true), (10.0, 20.0, 5, true)]
    {
        let text = format!(
            "name = \"path\"\nmachine = \"../../machines/lei-hsu-mill/machine.toml\"\n\
             [unknown]\nlocation = [\"EX0C\"]\n\
             [instrument.probe]\nkind = \"probe-ball\"\nsocket = \"0 0 -330 mm\"\nreads = \"ball\"\nnoise = \"1 um\"\n\
             [[path]]\nkind = \"C\"\nfrom = \"{from} deg\"\nto = \"{to} deg\"\ncount = {count}\nback = {back}\n"
        );
        let files = disk().with_texts(BTreeMap::from([(path.clone(), text)]));
        let (read, problems) = read_campaign(&files, &path, |r, c| read_virtual(r, c, Some(1)));
        let (campaign, real) = read.unwrap_or_else(|| panic!("{problems:?}"));
        let readings = measure(&campaign, &real).expect("readings").readings;
        let axis = campaign.machine.axes().iter().position(|a| a.name.to_string() == "C");
        let found = readings.commands.iter().map(|command| command[axis.expect("C")].to_degrees());
        let there = (0..count).map(|k| from + (to - from) * f64::from(k) / f64::from(count - 1));
        let due: Vec<f64> = match back {
            true => there.clone().chain(there.rev()).collect(),
            false => there.collect(),
        };
        assert_eq!(readings.len(), due.len());
        assert!(found.zip(due).all(|(found, due)| (found - due).abs() < 1e-9), "{from} {to}");
    }
}
