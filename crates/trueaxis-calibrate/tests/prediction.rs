//! The prediction by all errors as a machine file: it says what the predictor says, and compensates poses that were
//! never measured, with an uncertainty that covers what remains.
//!
//! A head-head router, one ball (examples/05_identify/head-head.toml): the errors of X, Y, Z cannot be separated from those
//! of the head.

mod library;

use library::{disk, motions, normal, read, root, within};
use nalgebra::DVector;
use rayon::prelude::*;
use trueaxis_calibrate::identify::errors::{Identification, identify};
use trueaxis_calibrate::identify::predictor_file::{PredictorFile, judge, predictor_file};
use trueaxis_calibrate::identify::records::{Options, Records, read_records};
use trueaxis_geometry::Vec3;
use trueaxis_geometry::statistics::SplitMix64;
use trueaxis_input::{Diagnostics, Place};
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{Approach, AxisKind, Command};
use trueaxis_machine::errors::ErrorValues;
use trueaxis_machine::file::Tables;
use trueaxis_measure::measure::{Campaign, Readings, read_campaign};
use trueaxis_measure::unknowns::design::Design;
use trueaxis_measure::unknowns::term::Term;

const COVARIANCE: &str = "predicted-covariance.toml";
const STILL: Approach = [0.0; 6];

/// The campaign of the example, and the poses of its readings.
fn example() -> (Campaign, Readings) {
    let path = root().join("examples/05_identify/head-head.toml");
    let mut problems = Diagnostics::new();
    let read = read_campaign(&disk(), &path, |root, _| {
        root.get("fit");
        Some(())
    });
    let campaign = problems.keep(read).expect("a campaign").0;
    let records = read_records(&campaign, &mut problems).expect("readings");
    (campaign, records.readings)
}

/// Only the covariance is beside the machine file.
struct Beside<'a>(&'a str);

impl Tables for Beside<'_> {
    fn text(&self, name: &str) -> Result<String, String> {
        if name == COVARIANCE { Ok(self.0.to_owned()) } else { Err(format!("there is no {name}")) }
    }
}

struct Nothing;

impl Tables for Nothing {
    fn text(&self, name: &str) -> Result<String, String> {
        Err(format!("there is no {name}"))
    }
}

fn found(campaign: &Campaign, readings: &Readings, scores: bool) -> Identification {
    let options = Options { predicts: true, scores, ..Options::default() };
    let mut problems = Diagnostics::new();
    let records = Records::bare(readings.clone());
    identify(campaign, &options, &records, &mut problems).unwrap_or_else(|| panic!("{problems:?}"))
}

fn written(campaign: &Campaign, found: &Identification) -> PredictorFile {
    let old = std::fs::read_to_string(&campaign.machine_path).expect("the machine file");
    let records = Records::bare(Readings::default());
    let made = predictor_file((campaign, found), (&records, None), (&old, COVARIANCE), &Nothing);
    made.unwrap_or_else(|reason| panic!("{reason}"))
}

fn read_back(file: &PredictorFile) -> Machine {
    let (machine, problems) =
        Machine::check("predicted.toml", &file.machine.text, &Beside(&file.covariance));
    machine.unwrap_or_else(|| panic!("{problems:?}"))
}

/// A machine whose errors are not all listed: the design with all, and their values.
fn truth(campaign: &Campaign, random: &mut SplitMix64) -> (Design, Vec<f64>) {
    let hidden: Vec<Term> = motions(&campaign.machine, AxisKind::Linear, "polynomial 3");
    let whole = campaign.design().with_more(&hidden);
    let listed = campaign.terms.len();
    let value = |k: usize, random: &mut SplitMix64| match whole.unknown(k) {
        Some(u) if k < listed && u.is_angle() => within(random, 1.5e-4),
        _ if k < listed => within(random, 0.08),
        Some(u) if k < listed + hidden.len() && u.is_angle() => within(random, 2e-5),
        _ if k < listed + hidden.len() => within(random, 0.02),
        // The length of the stylus is as wrong as is assumed where it is not stated.
        Some(u) if u.prior().is_some() => u.prior().map_or(0.0, |p| p.1) * normal(random),
        _ => within(random, 0.05),
    };
    let values = (0..whole.unknowns()).map(|k| value(k, random)).collect();
    (whole, values)
}

/// Where the tool is off its nominal place in the workpiece.
fn deviation(machine: &Machine, command: &Command, errors: &ErrorValues) -> Vec3 {
    machine.deviation(command, errors).tip_mm
}

#[test]
fn law_the_file_says_what_the_predictor_says() {
    let (campaign, readings) = example();
    let found = found(&campaign, &readings, true);
    let file = written(&campaign, &found);
    let machine = read_back(&file);
    let predictor = found.adequacy.predictor.as_ref().expect("a prediction");
    let mut values = predictor.values.as_slice().to_vec();
    for (k, term) in predictor.design.terms.iter().enumerate() {
        // How an axis follows, and a drift, are no errors of a machine file.
        if term.basis.is_servo() || term.name().starts_with("drift") {
            values[k] = 0.0;
        }
    }
    let quantities = machine.uncertain_quantities();
    for command in &readings.commands {
        let own = predictor.design.errors_at(command, &STILL, &values).expect("a place");
        let errors = machine.errors_at(command, &STILL).expect("a place");
        let [own, read] =
            [deviation(&campaign.machine, command, &own), deviation(&machine, command, &errors)];
        assert!((own - read).norm() < 1e-9 * own.norm(), "{own} {read}");
        // U of the pose: the slopes of all terms with their covariance, by the design and not by the file.
        let known = machine.uncertainties_at(command, &quantities);
        for (axis, direction) in [Vec3::x(), Vec3::y(), Vec3::z()].into_iter().enumerate() {
            let of = |q: usize| {
                let moved = known.displaced_by(&errors, q, 1.0);
                (deviation(&machine, command, &moved) - read).dot(&direction)
            };
            let u = (0..quantities.len()).map(|q| of(q).powi(2)).sum::<f64>().sqrt();
            let slope = |k: usize| {
                let mut more = values.clone();
                more[k] += 1e-4;
                let errors = predictor.design.errors_at(command, &STILL, &more).expect("a place");
                let is_of_file = !predictor.design.terms[k].basis.is_servo();
                let off = deviation(&campaign.machine, command, &errors) - own;
                if is_of_file { off[axis] / 1e-4 } else { 0.0 }
            };
            let n = predictor.design.terms.len();
            let j = DVector::from_fn(n, |k, _| slope(k));
            let c = predictor.covariance.view((0, 0), (n, n));
            let expected = j.dot(&(c * &j)).sqrt();
            assert!((u - expected).abs() < 1e-3 * expected, "{u} {expected}");
        }
    }
    assert!(file.machine.text.contains("single values are not identified"));
    assert!(file.covariance.contains("held_out_places"));
    let mut problems = Diagnostics::new();
    judge(&found, &Place::whole("campaign.toml"), &mut problems);
    assert!(!problems.has_errors(), "{problems:?}");
}

/// What compensation by the file leaves at every third pose, which was not measured, after the zero was set at the first:
/// residual, its u, and the deviation without compensation.
fn compensated(seed: u64) -> Vec<[f64; 3]> {
    let (campaign, poses) = example();
    let mut random = SplitMix64::new(seed);
    let (design, values) = truth(&campaign, &mut random);
    let all = read(&mut random, &design, &poses, &values);
    let measured = all.filtered(|i| i % 3 != 0);
    let machine = read_back(&written(&campaign, &found(&campaign, &measured, false)));
    let quantities = machine.uncertain_quantities().len();
    // The deviation by truth and by the file, then by the file where one quantity is off by its u.
    let at = |command: &Command| -> Vec<Vec3> {
        let real = design.errors_at(command, &STILL, &values).expect("a place");
        let errors = machine.errors_at(command, &STILL).expect("a place");
        let known = machine.uncertainties_at(command, &machine.uncertain_quantities());
        let own = deviation(&machine, command, &errors);
        let moved = |q| deviation(&machine, command, &known.displaced_by(&errors, q, 1.0)) - own;
        let first = [deviation(&campaign.machine, command, &real), own];
        first.into_iter().chain((0..quantities).map(moved)).collect()
    };
    let zero = at(&poses.commands[0]);
    let mut left = Vec::new();
    for command in poses.commands.iter().step_by(3).skip(1) {
        let here: Vec<Vec3> = at(command).iter().zip(&zero).map(|(a, b)| a - b).collect();
        let off = here[0] - here[1];
        for c in 0..3 {
            let u = here[2..].iter().map(|d| d[c] * d[c]).sum::<f64>().sqrt();
            left.push([off[c], u, here[0][c]]);
        }
    }
    left
}

#[test]
fn law_compensation_of_places_that_were_not_measured() {
    let seeds: Vec<u64> = (0..12).map(|k| 5 + 31 * k).collect();
    let all: Vec<[f64; 3]> = seeds.into_par_iter().flat_map(compensated).collect();
    let n = all.len() as f64;
    let inside = all.iter().filter(|[off, u, _]| off.abs() <= 2.0 * u).count() as f64 / n;
    let rms = |i: usize| (all.iter().map(|row| row[i] * row[i]).sum::<f64>() / n).sqrt();
    let [left, u, without] = [0, 1, 2].map(rms);
    assert!(inside >= 0.90, "{inside}");
    assert!(left < 0.25 * without, "{left} mm of {without} mm");
    // The uncertainty is of the size of what remains, not only larger.
    assert!(u < 2.0 * left, "u {u}, {left} remains");
}

#[test]
fn law_neither_order_nor_list_changes_the_prediction() {
    let (campaign, readings) = example();
    let poses = readings.commands.clone();
    // After the zero was set: a shift of all places alike cannot be separated from the place of the ball.
    let tips = |campaign: &Campaign, readings: &Readings| -> Vec<Vec3> {
        let machine = read_back(&written(campaign, &found(campaign, readings, false)));
        let at =
            |q: &Command| deviation(&machine, q, &machine.errors_at(q, &STILL).expect("a place"));
        let zero = at(&poses[0]);
        poses.iter().map(|q| at(q) - zero).collect()
    };
    let first = tips(&campaign, &readings);
    let apart = |other: Vec<Vec3>| {
        let both = first.iter().zip(&other).map(|(a, b)| (a - b).norm_squared());
        (both.sum::<f64>() / first.len() as f64).sqrt()
    };
    let mut backwards = Readings::default();
    (0..readings.len()).rev().for_each(|i| backwards.push(readings.row(i)));
    assert!(apart(tips(&campaign, &backwards)) < 1e-6);
    // Errors that are not listed are predicted all the same, with a prior in place of none.
    for out in ["EA0Z", "EC0Y"] {
        let mut fewer = example().0;
        fewer.terms.retain(|t| t.error.to_string() != out);
        let apart = apart(tips(&fewer, &readings));
        assert!(apart < 0.001, "without {out}: {apart} mm apart");
    }
}
