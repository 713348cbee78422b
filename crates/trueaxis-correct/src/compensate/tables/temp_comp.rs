//! SINUMERIK: setting data of the temperature compensation, SD43900, SD43910, SD43920.
//!
//! ```text
//!     ΔK = $SA_TEMP_COMP_ABS_VALUE + $SA_TEMP_COMP_SLOPE · (position − $SA_TEMP_COMP_REF_POSITION)
//! ```
//!
//! Function Manual, Extended Functions, 03/2013, 6FC5397-1BP40-3BA1, p. 225.

use super::content::Line;
use super::control::{File, ReadFault};
use super::joints_csv::{direction, parse_direction};
use super::table::{axis_order, decimal, parse_decimal};
use std::fmt::Write;
use trueaxis_machine::Machine;

/// The file.
pub const NAME: &str = "TEMP_COMP.SPF";

/// Setting data of the temperature compensation; as of a table, the value is minus what is added.
pub fn write(machine: &Machine, lines: &[Line]) -> File {
    let order = axis_order(machine);
    let mut text = ";TrueAxis: temperature compensation, mm and deg; MD32750 is 3\n".to_owned();
    for line in lines {
        let n = order.iter().position(|a| *a == line.axis).map_or(0, |n| n + 1);
        // Writing to a String cannot fail.
        let _ = writeln!(text, "$SA_TEMP_COMP_ABS_VALUE[AX{n}]={}", decimal(-line.offset));
        let _ = writeln!(text, "$SA_TEMP_COMP_SLOPE[AX{n}]={}", direction(-line.slope));
        let _ = writeln!(text, "$SA_TEMP_COMP_REF_POSITION[AX{n}]={}", decimal(line.reference));
    }
    File { name: NAME.to_owned(), text: text + "M17\n" }
}

/// What [`write`] has written.
///
/// # Errors
/// What was expected, by line.
pub fn read(machine: &Machine, file: &File) -> Result<Vec<Line>, ReadFault> {
    let order = axis_order(machine);
    let mut lines: Vec<Line> = Vec::new();
    for (i, text) in file.text.lines().enumerate() {
        if text.starts_with(';') || text == "M17" {
            continue;
        }
        let fault =
            || ReadFault::new(&file.name, format!("line {}: $SA_TEMP_COMP_…[AXn]=…", i + 1));
        let (name, value) = text.split_once('=').ok_or_else(fault)?;
        let (name, n) = name.split_once("[AX").ok_or_else(fault)?;
        let n = n.trim_end_matches(']').parse::<usize>().map_err(|_| fault())?;
        let axis = *n.checked_sub(1).and_then(|n| order.get(n)).ok_or_else(fault)?;
        if lines.last().is_none_or(|l| l.axis != axis) {
            lines.push(Line { axis, reference: 0, offset: 0, slope: 0 });
        }
        let Some(line) = lines.last_mut() else { return Err(fault()) };
        match name {
            "$SA_TEMP_COMP_ABS_VALUE" => {
                line.offset = -parse_decimal(value).ok_or_else(fault)?;
            }
            "$SA_TEMP_COMP_SLOPE" => line.slope = -parse_direction(value).ok_or_else(fault)?,
            "$SA_TEMP_COMP_REF_POSITION" => {
                line.reference = parse_decimal(value).ok_or_else(fault)?;
            }
            _ => return Err(fault()),
        }
    }
    Ok(lines)
}
