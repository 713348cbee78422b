//! Programs in `tests/programs`: `good` ones run to their end, `bad` ones have an error.
//!
//! Beside each program lies its `.expected`: one line per step (`support::step_line`), then one per
//! diagnostic (`error[code] line:column`); lines that begin with `#` are remarks. The extension of
//! a program tells its control. Subprograms lie in `tests/programs/subs`.
//!
//! The expected lines are worked out by hand; the programs carry the calculation as comments.
//! `TRUEAXIS_SHOW=name` prints what the program of that name gives.

#![allow(clippy::print_stdout, reason = "shows the steps of a program on demand")]

mod support;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use support::{same_line, step_line};
use trueaxis_input::Severity;
use trueaxis_nc::moves::{Axis, Position};
use trueaxis_nc::{Control, Library, Program, Settings, interpret};

/// Subprograms with the extension of the main program.
struct Subprograms(PathBuf, String);

impl Library for Subprograms {
    fn text(&self, name: &str) -> Result<Vec<u8>, String> {
        let file = self.0.join(format!("{name}.{}", self.1));
        std::fs::read(file).map_err(|_| "no such file".to_owned())
    }
}

fn control(file: &Path) -> Option<Control> {
    match file.extension()?.to_str()? {
        "ngc" => Some(Control::LinuxCnc),
        "nc" => Some(Control::Fanuc),
        // .mpf and .h have set-ups of their own: tests/sinumerik.rs and tests/heidenhain.rs.
        _ => None,
    }
}

/// Tool 1 is 100 mm long, tool 2 is 50 mm long.
fn settings() -> Settings {
    let length = |z_mm: f64| {
        let mut length = Position::default();
        length[Axis::Z] = z_mm;
        length
    };
    Settings {
        most_jumps: 1000,
        tools: BTreeMap::from([(1, length(100.0)), (2, length(50.0))]),
        ..Settings::default()
    }
}

/// Steps and diagnostics of a program, line by line; whether it has an error.
fn lines(file: &Path, control: Control) -> (Vec<String>, bool) {
    let extension = file.extension().unwrap().to_string_lossy().into_owned();
    let name = file.file_name().unwrap().to_string_lossy().into_owned();
    let library = Subprograms(file.ancestors().nth(2).unwrap().join("subs"), extension);
    let program = Program::new(&name, std::fs::read(file).unwrap(), control);
    assert_eq!(program.print(), program.source(), "{name}");
    let mut lines = Vec::new();
    let outcome = interpret(&program, &library, &settings(), &mut |s| lines.push(step_line(&s)));
    for problem in outcome.problems.iter() {
        let kind = match problem.severity {
            Severity::Error => "error",
            Severity::Warning => "warning",
            Severity::Note => "note",
        };
        let (line, column) = (problem.place.line, problem.place.column);
        lines.push(format!("{kind}[{}] {line}:{column}", problem.code));
    }
    (lines, outcome.problems.has_errors())
}

fn programs(folder: &Path) -> Vec<(PathBuf, Control)> {
    let entries = std::fs::read_dir(folder).unwrap().flatten().map(|e| e.path());
    let mut found: Vec<_> = entries.filter_map(|p| control(&p).map(|c| (p, c))).collect();
    found.sort_by(|a, b| a.0.cmp(&b.0));
    found
}

/// What is wrong with a program, if anything.
fn difference(file: &Path, control: Control, bad: bool) -> Option<String> {
    let name = file.file_name().unwrap().to_string_lossy().into_owned();
    let (ours, has_errors) = lines(file, control);
    if std::env::var("TRUEAXIS_SHOW").is_ok_and(|n| n == name) {
        println!("{}", ours.join("\n"));
    }
    let shown = || ours.join("\n    ");
    if has_errors != bad {
        return Some(format!("{name}: errors {has_errors}, wanted {bad}\n    {}", shown()));
    }
    let expected = PathBuf::from(format!("{}.expected", file.display()));
    let Ok(expected) = std::fs::read_to_string(&expected) else {
        return Some(format!("{name}: the file .expected is missing\n    {}", shown()));
    };
    let wanted: Vec<_> =
        expected.lines().filter(|l| !l.starts_with('#') && !l.trim().is_empty()).collect();
    for index in 0..wanted.len().max(ours.len()) {
        let (want, our) = (wanted.get(index), ours.get(index));
        if !want.zip(our).is_some_and(|(w, o)| same_line(w, o)) {
            return Some(format!(
                "{name}: step {index}: wanted {want:?}, is {our:?}\n    {}",
                shown()
            ));
        }
    }
    None
}

#[test]
fn programs_do_what_their_comments_say() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/programs");
    let mut wrong = Vec::new();
    for (folder, bad) in [("good", false), ("bad", true)] {
        let found = programs(&root.join(folder));
        println!("{}: {} programs", folder, found.len());
        assert!(!found.is_empty());
        wrong.extend(found.iter().filter_map(|(file, control)| difference(file, *control, bad)));
    }
    assert!(wrong.is_empty(), "{}\n{} wrong", wrong.join("\n"), wrong.len());
}
