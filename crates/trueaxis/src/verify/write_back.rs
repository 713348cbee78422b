//! A positioning test as a table of the error motion that the machine file reads.
//!
//! Error = actual − nominal of the *body* in the direction of the machine axis. The readings are of the
//! command: a body that moves against its command (ISO 841: one that carries the workpiece) gets them
//! with the opposite sign. docs/model.md eq. 76.

use super::conditions::Conditions;
use super::iso230_2::{Approached, Position, Positioning};
use std::fmt::Write as _;
use trueaxis_input::{Diagnostics, Place};
use trueaxis_machine::axis::{Axis, AxisKind, iso_841_direction};
use trueaxis_machine::describe::replacement::{measured_text, quoted};
use trueaxis_machine::errors::Measurement;

/// The first line of every table written here; only such a file is overwritten.
pub const FIRST_LINE: &str = "# written by trueaxis evaluate --write-back";

/// A table for `[motion.X]`, and what to write into the machine file.
#[derive(Debug, Clone, PartialEq)]
pub struct WriteBack {
    /// The error motion, such as `EXX`.
    pub error: String,
    /// The text of the CSV file.
    pub table: String,
    /// Whether the readings changed their sign.
    pub negated: bool,
}

impl WriteBack {
    /// The section of the machine file that reads the table.
    pub fn section(&self, axis: &Axis, file: &str, conditions: &Conditions) -> String {
        let measured = Measurement {
            instrument: conditions.instrument_name.clone(),
            date: conditions.date.clone(),
            temperature_celsius: conditions.temperature_c.map(|t| t.value),
        };
        let mut section = format!("[motion.{}]\ntable = {}\n", axis.name, quoted(file));
        if let Some(text) = measured_text(&measured) {
            section += &format!("measured = {text}\n");
        }
        section
    }
}

/// Makes the table; `None` with errors in `problems`.
pub fn write_back(
    axis: &Axis,
    result: &Positioning,
    conditions: &Conditions,
    file: &str,
    problems: &mut Diagnostics,
) -> Option<WriteBack> {
    let place = || Place::whole(file);
    if axis.kind != result.kind {
        let message = format!("{} is an axis of the other kind than the readings", axis.name);
        problems.error("wrong-axis", place(), message, "linear readings for a linear axis");
        return None;
    }
    let along = iso_841_direction(axis.name);
    if (axis.direction - along).norm() > 1e-9 {
        let message = format!("{} does not move along a machine axis", axis.name);
        let hint = "its positioning error has parts in several directions: write them by hand";
        problems.error("slanted-axis", place(), message, hint);
        return None;
    }
    let both = result.positions.iter().all(|p| p.reversal().is_some());
    let one = |p: &Position| p.up.is_some() != p.down.is_some();
    if !both && !result.positions.iter().all(one) {
        let message = "some targets were reached from one side only".to_owned();
        let hint = "a table holds both directions or one; measure or leave out those targets";
        problems.error("missing-side", place(), message, hint);
        return None;
    }
    if result.budget.is_none() {
        let message = "the uncertainty of the table is that of the repeatability only".to_owned();
        let hint = "say [uncertainty] in the conditions file";
        problems.warn("missing-uncertainty", place(), message, hint);
    }
    let component = match (axis.kind, along.iter().position(|v| *v == 1.0)) {
        (AxisKind::Linear, Some(i)) => ['X', 'Y', 'Z'][i],
        (AxisKind::Rotary, Some(i)) => ['A', 'B', 'C'][i],
        (_, None) => return None,
    };
    let error = format!("E{component}{}", axis.name);
    let negated = axis.sense < 0.0;
    let mut table = heading(conditions, &error, negated, file);
    // Writing into a text cannot fail.
    let _ = write_rows(&mut table, result, &error, if negated { -1.0 } else { 1.0 }, both);
    Some(WriteBack { error, table, negated })
}

fn heading(conditions: &Conditions, error: &str, negated: bool, file: &str) -> String {
    // One line each: a line break in a name must not become a row.
    let line = |text: &str| text.replace(['\n', '\r'], " ");
    let mut out = format!("{FIRST_LINE}\n# {error} from {}", line(file));
    if negated {
        out += ", sign changed: the body moves against its command";
    }
    out.push('\n');
    let parts = [("instrument", &conditions.instrument_name), ("date", &conditions.date)];
    for (name, text) in parts {
        if let Some(text) = text {
            out += &format!("# {name}: {}\n", line(text));
        }
    }
    if let Some(t) = conditions.temperature_c {
        out += &format!("# temperature: {} degC\n", t.value);
    }
    out
}

fn write_rows(
    out: &mut String,
    result: &Positioning,
    error: &str,
    sign: f64,
    both: bool,
) -> std::fmt::Result {
    let (position, unit, scale) = match result.kind {
        AxisKind::Linear => ("position_mm", "um", 1e3),
        AxisKind::Rotary => ("position_deg", "urad", 1e6),
    };
    match both {
        true => writeln!(out, "{position},{error}_up_{unit},{error}_down_{unit},u_{error}_{unit}")?,
        false => writeln!(out, "{position},{error}_{unit},u_{error}_{unit}")?,
    }
    let first = result.positions.first().map_or(0.0, |p| p.target);
    for p in &result.positions {
        let target = match result.kind {
            AxisKind::Linear => p.target,
            AxisKind::Rotary => (p.target.to_degrees() * 1e9).round() / 1e9,
        };
        write!(out, "{target}")?;
        for side in [p.up, p.down].into_iter().flatten() {
            // + 0.0: no minus before a zero; six decimals are a picometre.
            write!(out, ",{:.6}", sign * side.mean * scale + 0.0)?;
        }
        writeln!(out, ",{:.6}", uncertainty(result, p, first) * scale)?;
    }
    Ok(())
}

/// Standard uncertainty of the mean at a target: instrument from the first target on, drift and
/// scatter of one side's mean.
fn uncertainty(result: &Positioning, p: &Position, first: f64) -> f64 {
    let sides = || [p.up, p.down].into_iter().flatten();
    let of_mean = |a: Approached| a.s.map_or(0.0, |s| s * s / a.count as f64);
    let scatter = sides().map(of_mean).fold(0.0, f64::max);
    let count = sides().map(|a| a.count).min().unwrap_or(1) as f64;
    let (scale, drift) = result
        .budget
        .as_ref()
        .map_or((0.0, 0.0), |b| (b.scale_u(p.target - first), b.drift_u.unwrap_or(0.0)));
    (scale * scale + drift * drift / count + scatter).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use trueaxis_machine::Machine;
    use trueaxis_machine::file::Tables;
    use trueaxis_standards::iso230_2::{evaluate, read};

    struct One(String);

    impl Tables for One {
        fn text(&self, _: &str) -> Result<String, String> {
            Ok(self.0.clone())
        }
        fn display(&self, name: &str) -> String {
            name.to_owned()
        }
    }

    const MACHINE: &str = "[machine]\nname = 'm'\nchain = \"w X' b Y Z t\"\nsource = 'a test'\n\
        [axis.X]\ntravel = ['0 mm', '100 mm']\n[axis.Y]\ntravel = ['0 mm', '1 mm']\n\
        [axis.Z]\ntravel = ['0 mm', '1 mm']\n[tool]\nlength = '100 mm'\n";

    #[test]
    fn the_machine_with_the_table_deviates_as_it_was_measured() {
        let csv = "target_mm,run,direction,deviation_um\n0,1,up,1\n0,1,down,3\n50,1,up,2\n\
                   50,1,down,4\n100,1,up,6\n100,1,down,8\n";
        let result = evaluate(&read("x.csv", csv, &mut Diagnostics::new()).unwrap(), None);
        let (bare, _) = Machine::check("m.toml", MACHINE, &One(String::new()));
        let axis = bare.unwrap().axes()[0].clone();
        let mut problems = Diagnostics::new();
        let conditions = Conditions { date: Some("2026-11-21".into()), ..Conditions::default() };
        let back = write_back(&axis, &result, &conditions, "x.csv", &mut problems).unwrap();
        assert!(back.negated && !problems.has_errors());
        let text = format!("{MACHINE}{}", back.section(&axis, "t.csv", &conditions));
        let (machine, found) = Machine::check("m.toml", &text, &One(back.table));
        assert!(!found.has_errors(), "{found:?}");
        let machine = machine.unwrap();
        // The tool relative to the workpiece, as the laser saw it: the mean of both sides, in µm.
        for (x, um) in [(0.0, 2.0), (50.0, 3.0), (100.0, 7.0)] {
            let mut command = trueaxis_machine::axis::Command::default();
            command[0] = x;
            let errors = machine.errors_at(&command, &Default::default()).unwrap();
            let tip = machine.deviation(&command, &errors).tip_mm;
            assert!((tip.x * 1e3 - um).abs() < 1e-6, "{tip:?} at {x}");
        }
    }
}
