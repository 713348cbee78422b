//! What is typed: positions, vectors, quantities.

use std::path::Path;
use trueaxis_geometry::Vec3;
use trueaxis_input::{
    CsvTable, Diagnostic, Diagnostics, Dimension, Files, Place, QuantityError, Severity,
    parse_quantity,
};
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{Approach, Command};
use trueaxis_machine::describe::{axis_index, to_inner};
use trueaxis_report::numbers::exact;

/// The place of a problem in an argument.
pub(super) fn argument(name: &str) -> Place {
    Place::whole(name)
}

/// How many words of a cutter-location file can change motion, spindle or coolant, and do not.
pub(super) fn not_applied(problems: &Diagnostics) -> usize {
    const CODES: [&str; 4] = ["not-applied", "cycle-not-applied", "unknown-word", "surface-speed"];
    let is_not_applied =
        |p: &&Diagnostic| p.severity == Severity::Warning && CODES.contains(&p.code);
    problems.iter().filter(is_not_applied).count()
}

/// The words of a list: between commas or semicolons if there are any, else between blanks. So a
/// decimal comma (`1,5 2`) never passes for two numbers.
fn words(text: &str) -> Vec<&str> {
    let separated = text.contains([',', ';']);
    let between = |c: char| if separated { matches!(c, ',' | ';') } else { c.is_whitespace() };
    text.split(between).map(str::trim).filter(|w| !w.is_empty()).collect()
}

/// Reads `X=10 Y=20 A=30`: mm and degrees; axes not named are 0.
pub(super) fn command(
    machine: &Machine,
    name: &str,
    text: &str,
    problems: &mut Diagnostics,
) -> Option<Command> {
    let mut command = Command::default();
    let mut named = Vec::new();
    let mut sound = true;
    for word in words(text) {
        let read = assignment(machine, word).and_then(|(axis, value)| {
            once(&mut named, axis, word)?;
            command[axis] = value;
            Ok(())
        });
        if let Err((code, message)) = read {
            sound = false;
            let hint = format!("write \"{}\", in mm and degrees", example(machine));
            problems.error(code, argument(name), message, &hint);
        }
    }
    sound.then_some(command)
}

type Refusal = (&'static str, String);

fn once(named: &mut Vec<usize>, axis: usize, word: &str) -> Result<(), Refusal> {
    if named.contains(&axis) {
        return Err(("duplicate-axis", format!("`{word}`: the axis is named twice")));
    }
    named.push(axis);
    Ok(())
}

fn assignment(machine: &Machine, word: &str) -> Result<(usize, f64), Refusal> {
    let (index, number) = axis_and_rest(machine, word)?;
    let value = parse_quantity(number, Dimension::Ratio)
        .map_err(|e| (e.code(), format!("`{word}`: {e}")))?;
    Ok((index, to_inner(machine, index, value)))
}

fn axis_and_rest<'w>(machine: &Machine, word: &'w str) -> Result<(usize, &'w str), Refusal> {
    let Some((axis, rest)) = word.split_once('=') else {
        return Err(("bad-position", format!("`{word}` is not an axis, =, and a value")));
    };
    let index = axis_index(machine, axis.trim())
        .ok_or_else(|| ("unknown-axis", format!("the machine has no axis `{axis}`")))?;
    Ok((index, rest.trim()))
}

fn example(machine: &Machine) -> String {
    let words: Vec<_> = machine.axes().iter().map(|a| format!("{}=0", a.name)).collect();
    words.join(" ")
}

/// Reads a CSV table of positions or poses; one without rows is a mistake, not an empty answer.
pub(super) fn table(
    files: &Files,
    path: &Path,
    what: &str,
    problems: &mut Diagnostics,
) -> Option<CsvTable> {
    let text = files.text(path, what, problems)?;
    let mut found = Diagnostics::new();
    let table = CsvTable::parse(&path.display().to_string(), &text, &mut found);
    let readable = found.iter().all(|d| !matches!(d.code, "bad-separator" | "empty-table"));
    if table.rows() == 0 && !found.has_errors() {
        let message = "the table has headings, but no row".to_owned();
        found.error("empty-table", argument(&table.file), message, "one row for each position");
    }
    problems.append(found);
    readable.then_some(table)
}

/// Reads `X=+ C=-`: the direction in which each axis reaches its position.
pub(super) fn approach(
    machine: &Machine,
    text: &str,
    problems: &mut Diagnostics,
) -> Option<Approach> {
    let mut approach = Approach::default();
    let mut named = Vec::new();
    let mut sound = true;
    for word in words(text) {
        let read = axis_and_rest(machine, word).and_then(|(axis, side)| {
            once(&mut named, axis, word)?;
            approach[axis] = match side {
                "+" => 1.0,
                "-" => -1.0,
                _ => return Err(("bad-approach", format!("`{word}` is neither + nor -"))),
            };
            Ok(())
        });
        if let Err((code, message)) = read {
            sound = false;
            let hint = "+ rising, - falling: \"X=+ C=-\"";
            problems.error(code, argument("--approach"), message, hint);
        }
    }
    sound.then_some(approach)
}

/// Reads plain finite numbers; every one that is not is reported.
pub(super) fn numbers(
    name: &str,
    text: &str,
    hint: &str,
    problems: &mut Diagnostics,
) -> Option<Vec<f64>> {
    let read = words(text).into_iter().map(|word| {
        let refuse = |e: QuantityError| {
            problems.error(e.code(), argument(name), e.to_string(), hint);
        };
        parse_quantity(word, Dimension::Ratio).map_err(refuse).ok()
    });
    // All of them first, so that every problem is reported.
    let read: Vec<Option<f64>> = read.collect();
    read.into_iter().collect()
}

/// Reads `x y z`: three finite numbers.
pub(super) fn vector(name: &str, text: &str, problems: &mut Diagnostics) -> Option<Vec3> {
    let words = words(text);
    let hint = "three plain numbers, such as \"10 20 30\"";
    if words.len() != 3 {
        let message = format!("`{text}` is {} numbers, not three", words.len());
        problems.error("bad-vector", argument(name), message, hint);
        return None;
    }
    numbers(name, text, hint, problems).map(|v| Vec3::new(v[0], v[1], v[2]))
}

/// Rows of numbers as CSV, each number in full.
pub(super) fn csv(names: &[String], rows: &[Vec<f64>]) -> String {
    let mut csv = names.join(",") + "\n";
    for row in rows {
        let fields: Vec<String> = row.iter().map(|x| exact(*x)).collect();
        csv += &(fields.join(",") + "\n");
    }
    csv
}

/// A quantity above zero with its unit; `what` it is, and what to write instead.
pub(super) fn above_zero(
    name: &str,
    text: &str,
    dimension: Dimension,
    (what, hint): (&str, &str),
    problems: &mut Diagnostics,
) -> Option<f64> {
    let (code, message) = match parse_quantity(text, dimension) {
        Ok(value) if value > 0.0 => return Some(value),
        Ok(_) => ("not-positive", format!("`{text}` is not {what}")),
        Err(e) => (e.code(), e.to_string()),
    };
    problems.error(code, argument(name), message, hint);
    None
}

/// A plain number that `is_possible`.
pub(super) fn plain(
    name: &str,
    text: &str,
    is_possible: impl Fn(&f64) -> bool,
    (what, hint): (&str, &str),
    problems: &mut Diagnostics,
) -> Option<f64> {
    let value = parse_quantity(text, Dimension::Ratio).ok().filter(is_possible);
    if value.is_none() {
        let message = format!("`{text}` is not {what}");
        problems.error("bad-number", argument(name), message, hint);
    }
    value
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_decimal_comma_is_not_two_numbers() {
        assert_eq!(words("1,5 2"), ["1", "5 2"]);
        assert_eq!(words("1, 2; 3"), ["1", "2", "3"]);
        assert_eq!(words(" 1\t2\n3 "), ["1", "2", "3"]);
        assert!(vector("--tip", "1,5 2", &mut Diagnostics::new()).is_none());
    }
}
