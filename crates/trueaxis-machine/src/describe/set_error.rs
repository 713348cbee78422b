//! One error put into the text of a machine file.

use super::lines::{Lines, header, value_of};
use crate::Machine;
use crate::errors::ErrorName;
use crate::file::Tables;
use trueaxis_input::{Diagnostics, Dimension, Place, SourceText, parse_measured};

/// Upper limit of the characters of a value.
const LONGEST: usize = 10_000;

/// Puts one error into the text of a machine file; all else stays as it is, to the byte.
///
/// `value` as in a machine file: `12 ± 1 urad`, `-3 um`, or any TOML value that is accepted for that
/// error (`{ polynomial = ["0 um", "3 um"], scale = "100 mm" }`); an empty text removes the entry. A
/// comment after a value is kept, one within it (between its brackets) is removed with it. The new text
/// has been read back: it is a machine file, and if the old text was one, no other number has changed.
///
/// # Errors
/// What is wrong with the name or the value, or why the file cannot be edited; an error that stands in the
/// table of its axis, with the name of the table.
///
/// ```
/// use trueaxis_machine::{describe::set_error, file::NoTables};
/// let old = "machine = { name = \"m\", chain = \"w b X Y Z t\" }\n[location]\nEC0Y = \"3 urad\" # square\n";
/// let new = set_error(old, "m.toml", &NoTables, "EC0Y", "12 ± 1 urad").unwrap();
/// assert_eq!(new, old.replace("3 urad", "12 ± 1 urad"));
/// assert!(set_error(old, "m.toml", &NoTables, "EC0Y", "12 mm").is_err());
/// ```
pub fn set_error(
    old: &str,
    file: &str,
    tables: &dyn Tables,
    name: &str,
    value: &str,
) -> Result<String, Diagnostics> {
    let name = error_name(file, name)?;
    let value = value.trim();
    let mut lines = Lines::of(old);
    let line = lines.error(name);
    let place = line.map_or(Place::whole(file), |at| in_line(file, lines.number(at)));
    let (machine, _) = Machine::check(file, old, tables);
    if let Some(machine) = &machine {
        check_body(machine, name, file)?;
        let stated = machine
            .error_index(name)
            .is_some_and(|i| machine.bodies()[i.body].stated(i.kind, i.component).is_some());
        if stated && line.is_none() {
            return Err(elsewhere(&lines, file, name));
        }
    }
    match line {
        None if value.is_empty() => return Ok(old.to_owned()),
        Some(at) if value.is_empty() => lines.take_out(&header(name), at),
        Some(at) => {
            let written = as_toml(name, value, &place)?;
            if !lines.set_value(at, &written) {
                return Err(cannot_edit(place, name));
            }
        }
        None => {
            let written = as_toml(name, value, &place)?;
            lines.add(&header(name), &format!("{name} = {written}"));
        }
    }
    let new = lines.text();
    read_back(machine.as_ref(), (&new, file, tables), name, !value.is_empty(), &place)?;
    Ok(new)
}

fn refuse(code: &'static str, place: Place, message: String, hint: &str) -> Diagnostics {
    let mut problems = Diagnostics::new();
    problems.error(code, place, message, hint);
    problems
}

fn in_line(file: &str, line: usize) -> Place {
    Place { file: file.to_owned(), line, column: 1 }
}

fn error_name(file: &str, text: &str) -> Result<ErrorName, Diagnostics> {
    ErrorName::parse(text.trim()).ok_or_else(|| {
        let shown: String = text.chars().take(20).collect();
        let message = format!("`{shown}` is not the name of an error of ISO 230-1");
        let hint =
            "error motions are E, direction X Y Z A B C, axis, such as EXX; location errors have \
             a 0 before the body, such as EC0Y";
        refuse("unknown-error-name", Place::whole(file), message, hint)
    })
}

fn check_body(machine: &Machine, name: ErrorName, file: &str) -> Result<(), Diagnostics> {
    if machine.error_index(name).is_some() {
        return Ok(());
    }
    let message = format!("{name}: the chain has no body {}", name.body);
    let hint = format!("its chain: {}", machine.chain_text());
    Err(refuse("unknown-body", Place::whole(file), message, &hint))
}

/// An error that the file states in a table or an inline value, without a line of its own.
fn elsewhere(lines: &Lines, file: &str, name: ErrorName) -> Diagnostics {
    let Some((line, table)) = lines.table_of(&header(name)) else {
        return cannot_edit(Place::whole(file), name);
    };
    let message = format!("{name} is a column of the table `{table}` of its axis");
    let hint = format!(
        "change the column in the table, or remove the columns {name}_… from it and add an entry \
         {name} to the machine file"
    );
    refuse("error-in-table", in_line(file, lines.number(line)), message, &hint)
}

fn cannot_edit(place: Place, name: ErrorName) -> Diagnostics {
    let message = format!("{name}: the layout of this file cannot be edited by this program");
    let hint = format!("write {name} by hand on a separate line below [{}]", header(name));
    refuse("cannot-edit", place, message, &hint)
}

/// The value as written after the `=`: a quantity gets its quotes.
fn as_toml(name: ErrorName, value: &str, place: &Place) -> Result<String, Diagnostics> {
    let bad = |message: String, hint: &str| Err(refuse("bad-value", place.clone(), message, hint));
    if value.len() > LONGEST {
        let message = format!("{name}: the value has {} characters", value.len());
        return bad(message, "move the numbers to a table: { table = \"file.csv\" }");
    }
    if let Some(c) = value.chars().find(|c| c.is_control()) {
        let message = format!("{name}: the value contains {}", c.escape_default());
        return bad(message, "write the value on one line, such as 12 ± 1 urad");
    }
    if !value.starts_with(['{', '"', '\'']) {
        let dimension = match name.component.is_rotation() {
            true => Dimension::Angle,
            false => Dimension::Length,
        };
        return match parse_measured(value, dimension) {
            Ok(_) => Ok(format!("\"{value}\"")),
            Err(e) => Err(refuse(e.code(), place.clone(), format!("{name}: {e}"), &e.hint())),
        };
    }
    let entry = format!("x = {value}");
    let source = SourceText::new(&place.file, &entry);
    let keys = source.read(|root| root.entries().len());
    if keys != 1 || source.finish().has_errors() || value_of(&entry) != Some(4..entry.len()) {
        let message = format!("{name}: `{value}` is not a TOML value");
        return bad(
            message,
            "write one complete value, such as { constant = \"3 um\", reversal = \"1 um\" }",
        );
    }
    Ok(value.to_owned())
}

/// Checks that the new text is a machine file with (or without) the error and otherwise unchanged.
fn read_back(
    old: Option<&Machine>,
    (text, file, tables): (&str, &str, &dyn Tables),
    name: ErrorName,
    stated: bool,
    place: &Place,
) -> Result<(), Diagnostics> {
    let (machine, problems) = Machine::check(file, text, tables);
    let Some(machine) = machine.filter(|_| !problems.has_errors()) else {
        // A section that is written in another form is there twice now.
        let twice = |code: &str| matches!(code, "toml-syntax" | "duplicate-error");
        return Err(match old.is_some() && problems.iter().any(|d| twice(d.code)) {
            true => cannot_edit(place.clone(), name),
            false => problems,
        });
    };
    let Some(index) = machine.error_index(name) else {
        return Err(cannot_edit(place.clone(), name));
    };
    let is_stated = machine.bodies()[index.body].stated(index.kind, index.component).is_some();
    let without = |machine: &Machine| machine.clone().with_error(index, None);
    let same = old.is_none_or(|old| without(old) == without(&machine));
    match is_stated == stated && same {
        true => Ok(()),
        false => Err(cannot_edit(place.clone(), name)),
    }
}

/// The entry of an error in a machine file, if it has one: as written, without the
/// quotes of a quantity.
pub(super) fn own_text(lines: &Lines, name: ErrorName) -> Option<String> {
    let value = lines.value(lines.error(name)?)?;
    let inner = value.strip_prefix('"').and_then(|v| v.strip_suffix('"'));
    let plain = inner.filter(|v| !v.contains(['"', '\\']) && !v.is_empty());
    Some(plain.unwrap_or(value).to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::file::NoTables;

    const MACHINE: &str = "machine = { name = \"m\", chain = \"w C' b X Y Z t\" }\n";

    fn set(rest: &str, name: &str, value: &str) -> Result<String, Vec<&'static str>> {
        let old = format!("{MACHINE}{rest}");
        let new = set_error(&old, "m.toml", &NoTables, name, value);
        new.map(|text| text[MACHINE.len()..].to_owned())
            .map_err(|problems| problems.iter().map(|d| d.code).collect())
    }

    #[test]
    fn an_error_is_added_changed_and_taken_out() {
        let added = set("", "EC0Y", "12 ± 1 urad").unwrap();
        assert_eq!(added, "\n[location]\nEC0Y = \"12 ± 1 urad\"\n");
        assert_eq!(set(&added, "C0Y", "").unwrap(), ""); // the vendors' name
        assert_eq!(set("", "EC0Y", "").unwrap(), "");
        let curve = "{ fourier = { terms = [[1, \"6 urad\", \"-9 urad\"]] } }";
        let added = set("[motion.C]\n# mine\n", "EAC", curve).unwrap();
        assert_eq!(added, format!("[motion.C]\nEAC = {curve}\n# mine\n"));
        let changed = set(&added, "EAC", " 4 urad ").unwrap();
        assert_eq!(changed, "[motion.C]\nEAC = \"4 urad\"\n# mine\n");
    }

    #[test]
    fn a_bad_value_is_told_and_nothing_is_injected() {
        let old = "[location]\nEC0Y = \"1 urad\"\n";
        for (value, code) in [
            ("12 um", "wrong-unit"),
            ("12", "missing-unit"),
            ("NaN urad", "not-finite"),
            ("1e999 urad", "not-finite"),
            ("12 ± -1 urad", "negative-uncertainty"),
            ("12 urad\"", "unknown-unit"),
            ("12 urad\nEA0C = \"1 urad\"", "bad-value"),
            ("\"12 urad\"\rEA0C = \"1 urad\"", "bad-value"),
            ("\"12 urad\" # mine", "bad-value"),
            ("\"12 urad\", EA0C = \"1 urad\"", "bad-value"),
            ("\"\"\"12 urad", "bad-value"),
            ("{ x = 1", "bad-value"),
            ("{ constant = \"1 urad\" }", "wrong-type"),
            ("\"12 um\"", "wrong-unit"),
        ] {
            assert_eq!(set(old, "EC0Y", value), Err(vec![code]), "{value}");
        }
        assert_eq!(set(old, "EC0Y", &"9".repeat(20_000)), Err(vec!["bad-value"]));
        for (name, code) in
            [("EQX", "unknown-error-name"), ("", "unknown-error-name"), ("EXA", "unknown-body")]
        {
            assert_eq!(set(old, name, "1 um"), Err(vec![code]), "{name}");
        }
        // A problem of the value stands on the line of the entry.
        let old = format!("{MACHINE}{old}");
        let problems = set_error(&old, "m.toml", &NoTables, "EC0Y", "1 um").unwrap_err();
        assert_eq!(problems.iter().next().map(|d| d.place.line), Some(3));
    }

    #[test]
    fn a_wrong_value_of_the_file_can_be_mended() {
        let new = set("[location]\nEC0Y = \"1 um\" # ?\n", "EC0Y", "1 urad").unwrap();
        assert_eq!(new, "[location]\nEC0Y = \"1 urad\" # ?\n");
        // But not while something else is wrong.
        let other = set("[location]\nEC0Y = \"1 um\"\nEX0C = \"1 deg\"\n", "EC0Y", "1 urad");
        assert_eq!(other, Err(vec!["wrong-unit"]));
    }

    #[test]
    fn other_forms_are_left_alone() {
        for old in ["[motion]\nX = { EXX = \"1 um\" }\n", "[motion]\nX.EXX = \"1 um\"\n"] {
            for value in ["2 um", ""] {
                assert_eq!(set(old, "EXX", value), Err(vec!["cannot-edit"]), "{old}");
            }
            assert_eq!(set(old, "EYX", "2 um"), Err(vec!["cannot-edit"]), "{old}");
        }
        assert_eq!(
            set("[location]\nEC0Y = \"1 urad\"\nC0Y = \"2 urad\"\n", "EC0Y", "3 urad"),
            Err(vec!["duplicate-error"])
        );
    }

    #[test]
    fn what_stands_in_a_table_says_so() {
        struct Table;
        impl Tables for Table {
            fn text(&self, _: &str) -> Result<String, String> {
                Ok("position_mm,EXX_um\n0,1\n100,2\n".to_owned())
            }
        }
        let old = format!("{MACHINE}[motion.X]\n\ntable = 'X.csv' # laser\n");
        for value in ["2 um", ""] {
            let problems = set_error(&old, "m.toml", &Table, "EXX", value).unwrap_err();
            let found = problems.iter().next().unwrap();
            assert_eq!((found.code, found.place.line), ("error-in-table", 4));
            assert!(found.message.contains("`X.csv`"));
        }
        let new = set_error(&old, "m.toml", &Table, "EYX", "2 um").unwrap();
        assert_eq!(new, format!("{old}EYX = \"2 um\"\n"));
    }

    #[test]
    fn the_own_text_is_what_people_write() {
        let lines = Lines::of("[location]\nEC0Y = \"1 urad\" # x\nEA0Y = '2 urad'\n");
        let text = |name| own_text(&lines, ErrorName::parse(name).unwrap());
        assert_eq!(text("EC0Y").as_deref(), Some("1 urad"));
        assert_eq!(text("EA0Y").as_deref(), Some("'2 urad'"));
        assert_eq!(text("EB0Y"), None);
    }
}
