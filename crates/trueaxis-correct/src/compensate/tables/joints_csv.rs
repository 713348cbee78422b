//! Rotary axes as plain CSV, for controls whose kinematic parameters are entered by hand.

use super::control::{File, ReadFault};
use super::joints::{Joint, Joints};
use super::table::{decimal, parse_decimal};
use std::fmt::Write;
use trueaxis_machine::Machine;

/// The file.
pub const NAME: &str = "kinematics.csv";
const HEADINGS: &str = "axis,x,y,z,i,j,k";

/// A point and the direction of each rotary axis.
pub fn write(joints: &Joints) -> File {
    let mut text = format!(
        "# TrueAxis: a point of each rotary axis (mm) and its direction, machine frame, all axes at 0\n{HEADINGS}\n"
    );
    for joint in &joints.0 {
        let point = joint.point.map(decimal).join(",");
        let along = joint.direction.map(direction).join(",");
        // Writing to a String cannot fail.
        let _ = writeln!(text, "{},{point},{along}", joint.axis);
    }
    File { name: NAME.to_owned(), text }
}

/// Counts of 10⁻⁹ with nine decimals.
pub fn direction(counts: i64) -> String {
    let sign = if counts < 0 { "-" } else { "" };
    let size = counts.unsigned_abs();
    format!("{sign}{}.{:09}", size / 1_000_000_000, size % 1_000_000_000)
}

/// The counts of a component of a direction.
pub fn parse_direction(text: &str) -> Option<i64> {
    let value = text.trim().parse::<f64>().ok().filter(|v| v.abs() <= 1.0)?;
    Some((value * 1e9).round() as i64)
}

/// What [`write`] has written.
///
/// # Errors
/// What was expected, by line.
pub fn read(machine: &Machine, file: &File) -> Result<Joints, ReadFault> {
    let fault = |line: usize, expected: &str| {
        ReadFault::new(&file.name, format!("line {}: {expected}", line + 1))
    };
    let mut lines = file.text.lines().enumerate().filter(|(_, l)| !l.starts_with('#'));
    if lines.next().map(|(_, l)| l) != Some(HEADINGS) {
        return Err(fault(0, HEADINGS));
    }
    let mut joints = Vec::new();
    for (n, line) in lines {
        let cells: Vec<&str> = line.split(',').collect();
        let [name, x, y, z, i, j, k] = cells[..] else { return Err(fault(n, HEADINGS)) };
        let axis = machine.axes().iter().map(|a| a.name).find(|a| a.to_string() == name);
        let axis = axis.ok_or_else(|| fault(n, "an axis of the machine"))?;
        let number = |c: Option<i64>| c.ok_or_else(|| fault(n, "numbers"));
        let point =
            [number(parse_decimal(x))?, number(parse_decimal(y))?, number(parse_decimal(z))?];
        let [i, j, k] = [i, j, k].map(parse_direction);
        joints.push(Joint { axis, point, direction: [number(i)?, number(j)?, number(k)?] });
    }
    Ok(Joints(joints))
}
