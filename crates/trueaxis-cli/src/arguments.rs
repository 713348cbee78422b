//! Words of the command line: positions, vectors, tools.

use clap::Args;
use std::path::PathBuf;
use trueaxis::files;
use trueaxis::geometry::Vec3;
use trueaxis::geometry::input::{Diagnostics, Dimension, Place, parse_quantity};
use trueaxis::machine::Machine;
use trueaxis::machine::axis::{Approach, AxisKind, Command};
use trueaxis::machine::errors::BodyName;

/// The machine and the tool in it.
#[derive(Args)]
pub struct MachineArguments {
    /// The machine file
    #[arg(value_name = "MACHINE.toml")]
    pub machine: PathBuf,
    /// Length of the tool from the holder to the tip, mm, instead of the machine file's tool
    #[arg(long, value_name = "MM", allow_negative_numbers = true)]
    pub tool_length: Option<f64>,
    /// A tool assembly of the machine file, by its name
    #[arg(long, value_name = "NAME", conflicts_with = "tool_length")]
    pub tool: Option<String>,
}

impl MachineArguments {
    /// Reads the machine and puts the tool in; what is wrong goes to `problems`.
    pub fn read(&self, problems: &mut Diagnostics) -> Option<Machine> {
        let (machine, found) = files::machine(&self.machine);
        problems.append(found);
        let machine = machine?;
        if let Some(name) = &self.tool {
            return with_tool(machine, name, problems);
        }
        match self.tool_length {
            None => Some(machine),
            Some(length) if length.is_finite() => {
                Some(machine.with_tip(Vec3::new(0.0, 0.0, -length)))
            }
            Some(_) => {
                let message = "the tool length is not a finite number".to_owned();
                problems.error("not-finite", argument("--tool-length"), message, "give it in mm");
                None
            }
        }
    }
}

fn with_tool(machine: Machine, name: &str, problems: &mut Diagnostics) -> Option<Machine> {
    let Some(tool) = machine.tools().iter().find(|t| t.name == name) else {
        let known: Vec<_> = machine.tools().iter().map(|t| t.name.as_str()).collect();
        let message = format!("the machine file has no tool `{name}`");
        let hint = format!("its tools: {}", known.join(", "));
        problems.error("unknown-tool", argument("--tool"), message, &hint);
        return None;
    };
    let tip = Vec3::new(0.0, 0.0, -tool.length_mm);
    Some(machine.with_tip(tip))
}

/// The place of a problem in an argument.
pub fn argument(name: &str) -> Place {
    Place::whole(name)
}

/// Reads `X=10 Y=20 A=30`: mm and degrees; axes not named are 0.
pub fn command(
    machine: &Machine,
    name: &str,
    text: &str,
    problems: &mut Diagnostics,
) -> Option<Command> {
    let mut command = Command::default();
    let mut named = Vec::new();
    let mut sound = true;
    for word in text.split([' ', ',', ';']).filter(|w| !w.is_empty()) {
        match assignment(machine, word) {
            Ok((axis, value)) if !named.contains(&axis) => {
                named.push(axis);
                command[axis] = value;
            }
            Ok(_) => {
                sound = false;
                let message = format!("`{word}`: the axis is named twice");
                problems.error("duplicate-axis", argument(name), message, "name each axis once");
            }
            Err((code, message)) => {
                sound = false;
                let hint = format!("write \"{}\", in mm and degrees", example(machine));
                problems.error(code, argument(name), message, &hint);
            }
        }
    }
    sound.then_some(command)
}

fn assignment(machine: &Machine, word: &str) -> Result<(usize, f64), (&'static str, String)> {
    let Some((axis, number)) = word.split_once('=') else {
        return Err(("bad-position", format!("`{word}` is no axis position")));
    };
    let index = axis_index(machine, axis)
        .ok_or_else(|| ("unknown-axis", format!("the machine has no axis `{axis}`")))?;
    let value = parse_quantity(number, Dimension::Ratio)
        .map_err(|e| (e.code(), format!("`{word}`: {e}")))?;
    Ok((index, to_inner(machine, index, value)))
}

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
    match machine.axes()[axis].kind {
        AxisKind::Linear => value,
        AxisKind::Rotary => value.to_degrees(),
    }
}

fn example(machine: &Machine) -> String {
    let words: Vec<_> = machine.axes().iter().map(|a| format!("{}=0", a.name)).collect();
    words.join(" ")
}

/// Reads `X=+ C=-`: the direction in which each axis reaches its position.
pub fn approach(machine: &Machine, text: &str, problems: &mut Diagnostics) -> Option<Approach> {
    let mut approach = Approach::default();
    let mut sound = true;
    for word in text.split_whitespace() {
        let side = match word.split_once('=') {
            Some((axis, "+")) => axis_index(machine, axis).map(|i| (i, 1.0)),
            Some((axis, "-")) => axis_index(machine, axis).map(|i| (i, -1.0)),
            _ => None,
        };
        match side {
            Some((axis, sign)) => approach[axis] = sign,
            None => {
                sound = false;
                let message = format!("`{word}` is no direction of approach of an axis");
                problems.error("bad-approach", argument("--approach"), message, "\"X=+ C=-\"");
            }
        }
    }
    sound.then_some(approach)
}

/// Reads `x y z`: three finite numbers.
pub fn vector(name: &str, text: &str, problems: &mut Diagnostics) -> Option<Vec3> {
    let numbers: Vec<_> = text
        .split([' ', ',', ';'])
        .filter(|w| !w.is_empty())
        .map(|w| parse_quantity(w, Dimension::Ratio))
        .collect();
    match &numbers[..] {
        [Ok(x), Ok(y), Ok(z)] => Some(Vec3::new(*x, *y, *z)),
        _ => {
            let message = format!("`{text}` is not three finite numbers");
            problems.error("bad-vector", argument(name), message, "write \"10 20 30\"");
            None
        }
    }
}
