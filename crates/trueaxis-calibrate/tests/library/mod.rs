//! What the tests of identification share: files, machines of the library, and virtual readings.

#![allow(dead_code, reason = "each test takes what it needs")]

use std::path::{Path, PathBuf};
use trueaxis_geometry::Vec3;
use trueaxis_geometry::statistics::SplitMix64;
use trueaxis_input::{Files, Source};
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{AxisKind, Command, Travel};
use trueaxis_machine::errors::{Component, ErrorKind, ErrorName};
use trueaxis_measure::instruments::Reading;
use trueaxis_measure::measure::instrument::Instrument;
use trueaxis_measure::measure::{Campaign, Kind, Readings};
use trueaxis_measure::unknowns::design::Design;
use trueaxis_measure::unknowns::minimal::minimal_location_errors;
use trueaxis_measure::unknowns::term::{Shape, Term};

struct Disk;

impl Source for Disk {
    fn read(&self, path: &Path) -> std::io::Result<Vec<u8>> {
        std::fs::read(path)
    }

    fn is_file(&self, path: &Path) -> bool {
        path.is_file()
    }
}

pub fn disk() -> Files {
    Files::new(Disk)
}

pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// A machine of the library without its errors.
pub fn bare(name: &str) -> Machine {
    let path = root().join("machines").join(name).join("machine.toml");
    let (machine, problems) = Machine::read(&disk(), &path);
    let stated = machine.unwrap_or_else(|| panic!("{problems:?}"));
    let errors = stated.stated_errors();
    errors.iter().fold(stated.clone(), |m, (index, _)| m.with_error(*index, None))
}

pub fn within(random: &mut SplitMix64, reach: f64) -> f64 {
    reach * (2.0 * random.unit() - 1.0)
}

/// Standard normal (Box and Muller).
pub fn normal(random: &mut SplitMix64) -> f64 {
    let (a, b) = (1.0 - random.unit(), random.unit());
    (-2.0 * a.ln()).sqrt() * (std::f64::consts::TAU * b).cos()
}

/// All six error motions of every axis of a kind.
pub fn motions(machine: &Machine, kind: AxisKind, shape: &str) -> Vec<Term> {
    let shape = Shape::parse(shape).expect("a shape");
    let axes = machine.axes().iter().filter(|a| a.kind == kind);
    let names = axes.flat_map(|a| {
        let name = |component| ErrorName { body: a.name, kind: ErrorKind::Motion, component };
        Component::ALL.map(name)
    });
    names.flat_map(|e| shape.terms(machine, e)).collect()
}

/// What the instruments read of a machine with these errors, with their noise.
pub fn read(random: &mut SplitMix64, truth: &Design, at: &Readings, values: &[f64]) -> Readings {
    let mut readings = at.clone();
    for i in 0..readings.len() {
        let instrument = &truth.instruments[readings.instruments[i] as usize];
        let read = truth.read(at, i, values).expect("within the tables");
        for (c, read) in read.iter().enumerate().take(instrument.sight.channels()) {
            readings.values[i][c] = read + instrument.noise[c] * normal(random);
        }
    }
    readings
}

/// A probe on a ball, with the least number of location errors.
pub fn probe_campaign(machine: Machine) -> Campaign {
    let probe = Instrument {
        reference_point_mm: Vec3::new(40.0, -70.0, 90.0),
        ..Instrument::usual(Kind::ProbeBall, &machine)
    };
    Campaign {
        conditions: None,
        files: disk(),
        name: "R-test".to_owned(),
        path: PathBuf::from("campaign.toml"),
        machine_path: PathBuf::from("machine.toml"),
        terms: minimal_location_errors(&machine),
        instruments: vec![probe],
        tables: vec![Vec::new()],
        stages: Default::default(),
        limits: Default::default(),
        machine,
    }
}

/// Poses all over the travel, one after the other.
pub fn poses(random: &mut SplitMix64, machine: &Machine, count: u32) -> Readings {
    let mut poses = Readings::default();
    for group in 0..count {
        let mut command = Command::default();
        for (q, axis) in command.iter_mut().zip(machine.axes()) {
            *q = match (axis.travel, axis.kind) {
                (Travel::Between(from, to), _) => from + (to - from) * random.unit(),
                (_, AxisKind::Linear) => within(random, 400.0),
                (_, AxisKind::Rotary) => within(random, 1.6),
            };
        }
        poses.push(Reading {
            command,
            approach: Default::default(),
            instrument: 0,
            direction: Vec3::x(),
            value: [0.0; 3],
            group,
            time_s: 300.0 * f64::from(group),
            motion: Default::default(),
            line: group + 2,
        });
    }
    poses
}
