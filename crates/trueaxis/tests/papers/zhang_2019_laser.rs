//! Our figures for the laser tests of Zhang et al. 2019.

use crate::{Ours, shop};

use trueaxis::compensate::values::{Order, compensation_values};
use trueaxis::files::disk;
use trueaxis::identify::expansion::{Expansion, Run, Runs, identify_expansion};
use trueaxis::input::MeasuredValue;
use trueaxis::machine::axis::Command;
use trueaxis::measure::virtual_campaign::{measure, read_virtual};
use trueaxis::measure::{Campaign, read_campaign};
use trueaxis::predict::holes::Compensation;
use trueaxis::verify::before_after::{before_after, read_before_after};

pub const CLAIMS: &[(&str, Ours)] = &[
    ("001-laser-before", || largest_um(0, Compensation::None)),
    ("001-laser-composite", || largest_um(0, Compensation::Machine)),
    ("001-laser-part-before", || largest_um(1, Compensation::None)),
    ("001-laser-part-composite", || largest_um(1, Compensation::Machine)),
    ("001-laser-part-comprehensive", || largest_um(1, Compensation::Comprehensive)),
    ("001-laser-values", off_the_values_um),
    ("001-laser-expansion", || AXES.map(|axis| expansion(axis).per_k * 1e6).to_vec()),
    ("001-laser-materials", || {
        let only = |(axis, material): (Axis, &str)| {
            f64::from(u8::from(expansion(axis).materials == [material]))
        };
        AXES.into_iter().zip(["steel tape", "glass"]).map(only).collect()
    }),
    ("001-largest-location", || vec![0.4761 * 46.0, 100.0 * (1.0 - 0.4761)]),
];

/// The largest reading of the examples, X and Y, µm.
fn largest_um(laser: usize, of: Compensation) -> Vec<f64> {
    let one = |axis: &str| {
        let name = format!("examples/07_verify/laser-before-after-{axis}.toml");
        let (study, problems) = read_before_after(&disk(), &shop::root().join(name), None);
        let study = study.unwrap_or_else(|| panic!("{:?}", problems.sorted()));
        let curves = before_after(&study).expect("inside the tables");
        let curve = curves.iter().find(|c| c.instrument == laser && c.compensation == of);
        curve.expect("measured").largest.deviation_mm.abs() * 1e3
    };
    ["x", "y"].map(one).to_vec()
}

/// An axis of the gantry: letter, place in the machine, stroke (mm), and its two temperatures (°C).
type Axis = (&'static str, usize, f64, [f64; 2]);
const AXES: [Axis; 2] = [("X", 0, 3500.0, [28.4, 32.2]), ("Y", 1, 2300.0, [29.3, 33.8])];

/// Command and deviation (mm) at 11 targets, rising, of a laser without noise.
fn read((letter, axis, to, _): Axis, celsius: f64, keys: &str) -> (Campaign, Vec<(Command, f64)>) {
    let beam = ["1 0 0", "0 1 0"][axis];
    let text = format!(
        "name = \"c\"\nmachine = \"machines/gantry-001/machine.toml\"\n[temperature]\n\
         scale_{} = \"{celsius} degC\"\nworkpiece = \"{celsius} degC\"\n[instrument.laser]\n\
         kind = \"laser-line\"\nnoise = \"1 um\"\ndirection = \"{beam}\"\n{keys}\n[[path]]\nkind = \"targets\"\n\
         axis = \"{letter}\"\nfrom = \"0 mm\"\nto = \"{to} mm\"\ncount = 11\nruns = 1\n[disturb]\nnoise = 0\n",
        letter.to_lowercase()
    );
    let path = shop::root().join("laser.toml");
    let files = disk().with_texts([(path.clone(), text)]);
    let (found, problems) =
        read_campaign(&files, &path, |root, campaign| read_virtual(root, campaign, None));
    let (campaign, real) = found.unwrap_or_else(|| panic!("{:?}", problems.sorted()));
    let readings = measure(&campaign, &real).expect("inside the tables").readings;
    let laser = &campaign.instruments[0];
    let one = |i: usize| {
        let (command, direction) = (readings.commands[i], readings.directions[i]);
        let target = laser.nominal_reading(&campaign.machine, &command, direction)[0];
        (command, readings.values[i][0] - target)
    };
    let rising = (0..11).map(one).collect();
    (campaign, rising)
}

/// Machine and comprehensive error: the laser less `compensate values`, µm.
fn off_the_values_um() -> Vec<f64> {
    let material = "material_expansion = \"workpiece\"\nmaterial_temperature = \"workpiece\"";
    let mut worst = vec![0.0_f64; 2];
    for (axis, celsius) in AXES.into_iter().zip([30.5, 31.2]) {
        for (k, keys) in ["", material].into_iter().enumerate() {
            let (campaign, readings) = read(axis, celsius, keys);
            for (command, read) in readings {
                let order = Order {
                    axis: axis.1,
                    command,
                    positions: vec![command[axis.1]],
                    increment: 1e-3,
                    of: Compensation::Comprehensive,
                };
                let table = compensation_values(&campaign.machine, &order).expect("inside");
                let error = [table.nodes[0].machine, table.nodes[0].comprehensive][k];
                worst[k] = worst[k].max((read - error).abs() * 1e3);
            }
        }
    }
    worst
}

/// From virtual runs at the two temperatures of the paper.
fn expansion(axis: Axis) -> Expansion {
    let run = |celsius: f64| {
        let (_, readings) = read(axis, celsius, "");
        Run {
            name: format!("{celsius}"),
            celsius: MeasuredValue { value: celsius, u: Some(0.1) },
            errors_mm: readings.iter().map(|(_, e)| *e).collect(),
        }
    };
    let positions_mm = (0..11).map(|i| axis.2 * f64::from(i) / 10.0).collect();
    identify_expansion(&Runs {
        name: axis.0.to_owned(),
        positions_mm,
        runs: axis.3.map(run).to_vec(),
        scale: Default::default(),
        laser: Default::default(),
    })
}
