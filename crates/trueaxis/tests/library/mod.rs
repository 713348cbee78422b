//! What the tests of the loop share: the machines of the library, and numbers that look random and
//! are the same in every run.

#![allow(dead_code, reason = "each test takes what it needs")]

pub mod paths;

use std::path::{Path, PathBuf};
use trueaxis::machine::Machine;
use trueaxis::machine::axis::{AxisKind, Command, Travel};
use trueaxis::machine::errors::{Curve, StatedError};

/// All machines of the library.
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

/// How often a law is tried: all with TRUEAXIS_LONG (CONTRIBUTING.md), a part of them otherwise.
pub fn runs(all: usize, some: usize) -> usize {
    if std::env::var_os("TRUEAXIS_LONG").is_some() { all } else { some }
}

/// The root of the project.
pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

pub fn machine_path(name: &str) -> PathBuf {
    root().join("machines").join(name).join("machine.toml")
}

pub fn machine(name: &str) -> Machine {
    let (machine, problems) = trueaxis::files::machine(&machine_path(name));
    machine.unwrap_or_else(|| panic!("{problems:?}"))
}

/// The machine of the library, without its errors.
pub fn bare(name: &str) -> Machine {
    let stated = machine(name);
    let errors = stated.stated_errors();
    errors.iter().fold(stated.clone(), |m, (index, _)| m.with_error(*index, None))
}

/// The machine with the same lost motion, mm, of X, Y and Z, and no other reversal: each axis lags so
/// much more on one side than on the other, and a turn takes it up in the new direction.
pub fn with_lost_motion(machine: &Machine, lost_mm: f64) -> Machine {
    let all = machine.stated_errors();
    let none = all.iter().fold(machine.clone(), |m, (index, _)| m.with_error(*index, None));
    all.iter().fold(machine.clone(), |m, (index, name)| {
        let body = &m.bodies()[index.body];
        let Some(stated) = body.stated(name.kind, name.component).cloned() else { return m };
        let letter = ["EXX", "EYY", "EZZ"].iter().position(|own| *own == name.to_string());
        let axis = letter.and_then(|i| {
            machine.axes().iter().position(|a| a.name.letter() == ['X', 'Y', 'Z'][i])
        });
        let reversal = axis.filter(|_| lost_mm != 0.0).map(|axis| {
            // On the side of the workpiece a positive error leads the tool back.
            let one = none.clone().with_error(*index, Some(StatedError::constant(1.0, None)));
            let at = |q: f64| {
                let mut command = Command::default();
                command[axis] = q;
                one.deviation(&command, &one.errors_at(&command, &[0.0; 6]).unwrap())
            };
            let along = at(1.0).nominal_tip - at(0.0).nominal_tip;
            Curve::Constant(-lost_mm * along.dot(&at(0.0).tip_mm).signum())
        });
        m.with_error(*index, Some(StatedError { reversal, ..stated }))
    })
}

/// Numbers that are the same in every run (splitmix64).
pub struct Random(pub u64);

impl Random {
    /// In 0..1.
    pub fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    pub fn between(&mut self, from: f64, to: f64) -> f64 {
        from + (to - from) * self.unit()
    }

    pub fn within(&mut self, reach: f64) -> f64 {
        reach * (2.0 * self.unit() - 1.0)
    }

    /// Standard normal (Box and Muller).
    pub fn normal(&mut self) -> f64 {
        let (a, b) = (1.0 - self.unit(), self.unit());
        (-2.0 * a.ln()).sqrt() * (std::f64::consts::TAU * b).cos()
    }

    /// A place within the travels; where none is stated, within ± reach of linear (mm) and of
    /// rotary axes (rad).
    pub fn command(&mut self, machine: &Machine, reach: [f64; 2]) -> Command {
        let mut command = Command::default();
        for (q, axis) in command.iter_mut().zip(machine.axes()) {
            *q = match (axis.travel, axis.kind) {
                (Travel::Between(from, to), _) => self.between(from, to),
                (_, AxisKind::Linear) => self.within(reach[0]),
                (_, AxisKind::Rotary) => self.within(reach[1]),
            };
        }
        command
    }
}
