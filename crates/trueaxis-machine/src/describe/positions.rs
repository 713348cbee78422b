//! Positions by the names of their axes, in mm and degrees, as in `--at "X=10 C=45"`.

use crate::Machine;
use crate::axis::{Axis, AxisKind, Command};
use crate::errors::BodyName;
use trueaxis_input::{Diagnostics, Place};

/// The index of an axis by its letter as text.
pub fn axis_index(machine: &Machine, letter: &str) -> Option<usize> {
    let mut letters = letter.chars();
    let name = BodyName::new(letters.next()?)?;
    letters.next().is_none().then(|| machine.axis_index(name)).flatten()
}

/// A typed number (mm or degrees) in mm or rad.
pub fn to_inner(machine: &Machine, axis: usize, number: f64) -> f64 {
    match machine.axes()[axis].kind {
        AxisKind::Linear => number,
        AxisKind::Rotary => number.to_radians(),
    }
}

/// An axis position in mm or degrees.
pub fn to_shown(machine: &Machine, axis: usize, value: f64) -> f64 {
    let shown = match machine.axes()[axis].kind {
        AxisKind::Linear => value,
        AxisKind::Rotary => value.to_degrees(),
    };
    shown + 0.0 // no minus before a zero
}

/// The axes that a position puts outside their travel.
fn beyond_travel(machine: &Machine, command: &Command) -> Vec<BodyName> {
    let axes = machine.axes().iter().zip(command);
    axes.filter(|(axis, q)| !axis.travel.contains(**q)).map(|(axis, _)| axis.name).collect()
}

/// The command of positions by axis, mm and degrees; axes that are not named are at 0. A position
/// outside the travel is computed, with a warning.
///
/// ```no_run
/// use trueaxis_input::{Diagnostics, Place};
/// # let files = trueaxis_input::Files::none();
/// # let machine = trueaxis_machine::Machine::read(&files, "m.toml".as_ref()).0.unwrap();
/// let at = [("X", 3000.0), ("C", -90.0)];
/// let command = trueaxis_machine::describe::command(&machine, at, &Place::whole("at"), &mut Diagnostics::new());
/// ```
pub fn command<'a>(
    machine: &Machine,
    positions: impl IntoIterator<Item = (&'a str, f64)>,
    place: &Place,
    problems: &mut Diagnostics,
) -> Option<Command> {
    let mut command = Command::default();
    let mut named = Vec::new();
    let mut sound = true;
    for (letter, value) in positions {
        let (code, message) = match axis_index(machine, letter) {
            None => ("unknown-axis", format!("the machine has no axis `{letter}`")),
            Some(axis) if named.contains(&axis) => {
                ("duplicate-axis", format!("`{letter}`: the axis is named twice"))
            }
            Some(_) if !value.is_finite() => {
                ("not-finite", format!("`{letter}`: {value} is not an accepted position"))
            }
            Some(axis) => {
                named.push(axis);
                command[axis] = to_inner(machine, axis, value);
                continue;
            }
        };
        sound = false;
        let hint = format!(
            "the axes are those of the chain: {}; positions in mm and degrees",
            machine.chain_text()
        );
        problems.error(code, place.clone(), message, &hint);
    }
    if sound {
        warn_beyond_travel(machine, &command, place, problems);
    }
    sound.then_some(command)
}

/// A warning for each axis that a position puts outside its travel.
pub fn warn_beyond_travel(
    machine: &Machine,
    command: &Command,
    place: &Place,
    problems: &mut Diagnostics,
) {
    for axis in beyond_travel(machine, command) {
        let message = format!("the position of {axis} is outside its travel");
        let hint = "the machine cannot reach this position";
        problems.warn("outside-travel", place.clone(), message, hint);
    }
}

/// mm or degrees.
pub fn shown(axis: &Axis, value: f64) -> f64 {
    match axis.kind {
        AxisKind::Linear => value,
        AxisKind::Rotary => value.to_degrees(),
    }
}

/// mm or deg.
pub fn unit(axis: &Axis) -> &'static str {
    match axis.kind {
        AxisKind::Linear => "mm",
        AxisKind::Rotary => "deg",
    }
}

/// `X 3114.7601 mm  C 0.0000 deg`.
pub fn command_words(axes: &[Axis], command: &Command) -> String {
    let words: Vec<String> = axes
        .iter()
        .zip(command)
        // + 0.0: no minus before a zero.
        .map(|(axis, q)| format!("{} {:.4} {}", axis.name, shown(axis, *q) + 0.0, unit(axis)))
        .collect();
    words.join("  ")
}
