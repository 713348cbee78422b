//! What the claims are computed with: the shipped files, read through the public interface.

use std::path::{Path, PathBuf};
use std::sync::LazyLock;
use trueaxis::files::disk;
use trueaxis::geometry::Vec3;
use trueaxis::geometry::frame::{Direction, Point};
use trueaxis::machine::axis::{AxisKind, Command};
use trueaxis::machine::errors::ErrorValues;
use trueaxis::machine::{Machine, Target};
use trueaxis::predict::{Prediction, Study, predict, read_study};

/// The folder of the workspace.
pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// A shipped machine.
pub fn machine(name: &str) -> Machine {
    let path = root().join("machines").join(name).join("machine.toml");
    let (machine, problems) = trueaxis::files::machine(&path);
    let list: Vec<String> = problems.iter().map(ToString::to_string).collect();
    machine.unwrap_or_else(|| panic!("{}", list.join("\n")))
}

/// The README's first study, without its Monte Carlo run.
pub static STUDY: LazyLock<Study> = LazyLock::new(|| {
    let (study, problems) =
        read_study(&disk(), &root().join("examples/03_predict/nas979-on-xkas2525.toml"));
    let list: Vec<String> = problems.iter().map(ToString::to_string).collect();
    let mut study = study.unwrap_or_else(|| panic!("{}", list.join("\n")));
    study.sampling = None;
    study
});

/// What it says.
pub static PREDICTION: LazyLock<Prediction> =
    LazyLock::new(|| predict(&STUDY, &|_| {}).expect("a prediction"));

/// Positions of named axes in the units of people: mm and deg.
pub fn shown(machine: &Machine, command: &Command, letters: &str) -> Vec<f64> {
    let one = |letter: char| {
        let axis = machine.axes().iter().position(|a| a.name.letter() == letter);
        let axis = axis.expect("an axis of that letter");
        match machine.axes()[axis].kind {
            AxisKind::Linear => command[axis],
            AxisKind::Rotary => command[axis].to_degrees(),
        }
    };
    letters.chars().map(one).collect()
}

/// A command in mm and deg, as `X=10 C=90`.
pub fn command(machine: &Machine, text: &str) -> Command {
    let mut command = Command::default();
    for word in text.split_whitespace() {
        let (letter, value) = word.split_once('=').expect("LETTER=value");
        let axis = machine.axes().iter().position(|a| a.name.to_string() == letter);
        let axis = axis.expect("an axis of that letter");
        let value: f64 = value.parse().expect("a number");
        command[axis] = match machine.axes()[axis].kind {
            AxisKind::Linear => value,
            AxisKind::Rotary => value.to_radians(),
        };
    }
    command
}

/// A wanted pose of the tool.
pub fn target(tip: [f64; 3], axis: [f64; 3]) -> Target {
    let axis = Direction::of(Vec3::from(axis)).expect("a direction");
    Target { tip: Point::from_vector(Vec3::from(tip)), axis }
}

/// The nominal tip and tool axis in the workpiece.
pub fn nominal(machine: &Machine, command: &Command) -> (Vec3, Vec3) {
    let at = machine.deviation(command, &ErrorValues::default());
    (at.nominal_tip.vector(), at.nominal_axis.vector())
}

/// The components of a vector.
pub fn list(vector: Vec3) -> Vec<f64> {
    vector.iter().copied().collect()
}
