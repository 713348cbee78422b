//! The shipped machines, for the tests.

// Each test program uses a part of this file.
#![allow(dead_code)]

use std::path::{Path, PathBuf};
use trueaxis_geometry::Vec3;
use trueaxis_input::Diagnostics;
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{Approach, AxisKind, Command, Travel};
use trueaxis_machine::errors::{Component, Curve, ErrorIndex, ErrorKind, Harmonic, StatedError};
use trueaxis_machine::file::Tables;
use trueaxis_machine::heat::Conditions;

/// The folders of `machines/` that carry five-axis machines with a known oracle.
pub const FIVE_AXIS: [&str; 6] =
    ["xkas2525", "i5-engraver", "lei-hsu-mill", "head-table", "nutating-head", "wyxzcat-gantry"];

/// All folders of `machines/`.
pub const SHIPPED: [&str; 7] = [
    "xkas2525",
    "i5-engraver",
    "lei-hsu-mill",
    "head-table",
    "nutating-head",
    "wyxzcat-gantry",
    "three-axis-mill",
];

struct Folder(PathBuf);

impl Tables for Folder {
    fn text(&self, name: &str) -> Result<String, String> {
        std::fs::read_to_string(self.0.join(name)).map_err(|e| e.to_string())
    }
}

pub fn machine(name: &str) -> Machine {
    machine_of(name, |text| text)
}

/// A shipped machine after a change of its text.
pub fn machine_of(name: &str, change: impl Fn(String) -> String) -> Machine {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../machines").join(name);
    let path = folder.join("machine.toml");
    let text = change(std::fs::read_to_string(&path).expect("a shipped machine file"));
    let (machine, problems) = Machine::check("machine.toml", &text, &Folder(folder));
    let list: Vec<String> = problems.iter().map(ToString::to_string).collect();
    machine.unwrap_or_else(|| panic!("{name}: {}", list.join("\n")))
}

/// The machine at these temperatures, degrees Celsius: `"x=25 workpiece=28"`.
pub fn warm(machine: &Machine, text: &str) -> Machine {
    let mut problems = Diagnostics::new();
    let conditions = Conditions::typed("t", text, &mut problems).expect("sound");
    machine.at(&conditions, &mut problems).unwrap_or_else(|| panic!("{:?}", problems.sorted()))
}

/// Numbers in 0..1 that are the same in every run (splitmix64).
pub struct Random(pub u64);

impl Random {
    pub fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    pub fn within(&mut self, reach: f64) -> f64 {
        reach * (2.0 * self.unit() - 1.0)
    }

    pub fn vector(&mut self, reach: f64) -> Vec3 {
        Vec3::from_fn(|_, _| self.within(reach))
    }

    pub fn command(&mut self, machine: &Machine) -> Command {
        command_within_travel(machine, std::array::from_fn(|_| self.unit()))
    }
}

/// A committed table of numbers: headings and rows.
pub fn golden(path: &str) -> (Vec<String>, Vec<Vec<f64>>) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data").join(path);
    let text = std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{path:?}: {e}"));
    let mut lines = text.lines().filter(|l| !l.starts_with('#'));
    let heads = lines.next().expect("headings").split(',').map(str::to_owned).collect();
    let row = |l: &str| l.split(',').map(|f| f.parse().expect("a number")).collect();
    (heads, lines.map(row).collect())
}

/// A number of a row in its inner unit: degrees of a rotary axis become rad.
pub fn command(machine: &Machine, heads: &[String], row: &[f64]) -> Command {
    let mut command = Command::default();
    for (slot, axis) in command.iter_mut().zip(machine.axes()) {
        let column = heads.iter().position(|h| *h == axis.name.to_string()).expect("a column");
        *slot = match axis.kind {
            AxisKind::Linear => row[column],
            AxisKind::Rotary => row[column].to_radians(),
        };
    }
    command
}

/// A command within the travel from numbers in 0..1; where no travel is stated, ±300 mm, ±100°.
pub fn command_within_travel(machine: &Machine, unit: [f64; 6]) -> Command {
    let mut command = Command::default();
    for ((slot, axis), t) in command.iter_mut().zip(machine.axes()).zip(unit) {
        let (from, to) = match (axis.travel, axis.kind) {
            (Travel::Between(from, to), _) => (from, to),
            (Travel::Unlimited, _) => (-std::f64::consts::PI, std::f64::consts::PI),
            (Travel::Unknown, AxisKind::Linear) => (-300.0, 300.0),
            (Travel::Unknown, AxisKind::Rotary) => (-1.7, 1.7),
        };
        *slot = from + (to - from) * t;
    }
    command
}

/// The tables of a machine file by name.
pub struct Texts<'a>(pub &'a [(&'a str, &'a str)]);

impl Tables for Texts<'_> {
    fn text(&self, name: &str) -> Result<String, String> {
        let found = self.0.iter().find(|(n, _)| *n == name);
        found.map(|(_, text)| (*text).to_owned()).ok_or_else(|| "not here".to_owned())
    }
}

pub fn check(text: &str, csv: &str) -> (Option<Machine>, Diagnostics) {
    Machine::check("m.toml", text, &Texts(&[("t.csv", csv)]))
}

pub fn checked(text: &str, csv: &str) -> Machine {
    let (machine, problems) = check(text, csv);
    let list: Vec<String> = problems.iter().map(ToString::to_string).collect();
    machine.unwrap_or_else(|| panic!("{}\n{text}", list.join("\n")))
}

/// Every folder of `machines/`.
pub const MACHINES: [&str; 8] = [
    "xkas2525",
    "i5-engraver",
    "lei-hsu-mill",
    "head-table",
    "nutating-head",
    "wyxzcat-gantry",
    "three-axis-mill",
    "gantry-001",
];

/// Location errors of all bodies and smooth motions of all axes with reversal, each up to `reach`
/// (1: 1 mm and 1 mrad).
pub fn with_random_errors(machine: &Machine, random: &mut Random, reach: f64) -> Machine {
    let mut changed = machine.clone();
    for (body, b) in machine.bodies().iter().enumerate() {
        let axis = b.axis.map(|i| machine.axes()[i].kind);
        for component in Component::ALL {
            let reach = reach * if component.is_rotation() { 1e-3 } else { 1.0 };
            let location = StatedError::constant(random.within(reach), None);
            let index = ErrorIndex { body, kind: ErrorKind::Location, component };
            changed = changed.with_error(index, Some(location));
            if let Some(kind) = axis {
                let index = ErrorIndex { kind: ErrorKind::Motion, ..index };
                changed = changed.with_error(index, Some(motion(kind, random, reach)));
            }
        }
    }
    changed
}

/// A curve within ±`reach` over some metres or turns.
fn motion(kind: AxisKind, random: &mut Random, reach: f64) -> StatedError {
    let mut value = |part: f64| random.within(part * reach);
    let mean = match kind {
        AxisKind::Linear => Curve::Polynomial {
            coefficients: vec![value(0.3), value(0.3), value(0.2)],
            origin: 0.0,
            scale: 1000.0,
        },
        AxisKind::Rotary => Curve::Fourier {
            mean: value(0.2),
            terms: vec![
                Harmonic { order: 1.0, cosine: value(0.2), sine: value(0.2) },
                Harmonic { order: 3.0, cosine: value(0.1), sine: value(0.1) },
            ],
        },
    };
    let reversal = Some(Curve::Constant(value(0.1)));
    StatedError { mean, reversal, ..StatedError::constant(0.0, None) }
}

/// A command in the middle 76 % of the travel.
pub fn away_from_ends(machine: &Machine, random: &mut Random) -> Command {
    command_within_travel(machine, std::array::from_fn(|_| 0.12 + 0.76 * random.unit()))
}

/// From which side each axis comes: −1, 0 or 1.
pub fn sides(random: &mut Random) -> Approach {
    std::array::from_fn(|_| (3.0 * random.unit()).floor() - 1.0)
}
