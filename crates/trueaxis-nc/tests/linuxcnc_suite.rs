//! LinuxCNC's own expected canonical calls against our moves and frames.
//!
//! The suite lies outside the project; without it the test says so and passes.

#![allow(clippy::print_stdout, reason = "the table for docs/validation.md")]

mod support;

use std::path::{Path, PathBuf};

use support::{Call, expected_calls, our_calls, outside, tidy_end};

/// DIFFERENCE: in these LinuxCNC feeds the tap along the wrong axis (G84 in G18 and G19: the axes
/// of the feed moves are rotated against those of the rapid moves over the same hole). With the
/// axes of their feed moves rotated back, all agrees.
const ROTATED_TAPS: [(&str, [usize; 3]); 4] = [
    ("g84/g18/g98", [2, 0, 1]),
    ("g84/g18/g99", [2, 0, 1]),
    ("g84/g19/g98", [1, 2, 0]),
    ("g84/g19/g99", [1, 2, 0]),
];

/// Tests about Python, which we do not have.
const PYTHON: [&str; 2] = ["python-self", "value-returned"];

/// Tests that end with an error, and our code for it.
const ERRORS: [(&str, &str); 5] = [
    ("abort-hot-comment", "program-alarm"),
    ("iniparam", "undefined-parameter"),
    ("iniparam-failassign", "read-only-parameter"),
    ("nested-sub-error", "nested-sub"),
    ("oword-unwind", "division-by-zero"),
];

fn programs(folder: &Path, found: &mut Vec<PathBuf>) {
    let mut entries: Vec<_> =
        std::fs::read_dir(folder).into_iter().flatten().flatten().map(|e| e.path()).collect();
    entries.sort();
    for entry in &entries {
        if entry.is_dir() {
            programs(entry, found);
        }
    }
    if entries.iter().any(|e| e.ends_with("expected")) {
        let main = entries.iter().filter(|e| e.extension().is_some_and(|x| x == "ngc"));
        let main: Vec<_> = main.collect();
        let test = main.iter().find(|m| m.ends_with("test.ngc")).or(main.first());
        found.extend(test.map(|t| (*t).clone()));
    }
}

#[test]
fn oracle_linuxcnc_suite() {
    let Some(suite) = outside("suites/LinuxCNC__linuxcnc/interp") else { return };
    let mut found = Vec::new();
    programs(&suite, &mut found);
    assert!(found.len() > 30);
    let (mut agree, mut wrong) = (0, Vec::new());
    for file in &found {
        let folder = file.parent().unwrap();
        let name = folder.strip_prefix(&suite).unwrap().to_string_lossy().into_owned();
        let mut theirs = expected_calls(&std::fs::read_to_string(folder.join("expected")).unwrap());
        let (mut ours, problems) = our_calls(file);
        if !name.starts_with("g6") {
            // LinuxCNC changes the path control within its cycles without being asked.
            for calls in [&mut theirs, &mut ours] {
                calls.retain(|c| !matches!(c, Call::Numbers("path", ..)));
                *calls = tidy_end(std::mem::take(calls));
            }
        }
        if PYTHON.contains(&name.as_str()) {
            println!("left out {name}: it needs Python");
            continue;
        }
        let code = ERRORS.iter().find(|(n, _)| *n == name).map(|(_, c)| format!("error[{c}]"));
        if name.starts_with("g7") {
            // LinuxCNC also calls turning moves that lead nowhere.
            (theirs, ours) = (without_rests(theirs), without_rests(ours));
        }
        if !ends_as_it_should(&problems, code.as_deref()) {
            wrong.push(format!("{name}: {problems}"));
        }
        if !theirs.is_empty() && theirs.iter().all(|c| matches!(c, Call::Text(_))) {
            // These expected files hold nothing but messages.
            ours.retain(|c| matches!(c, Call::Text(_)));
        }
        if let Some((_, order)) = ROTATED_TAPS.iter().find(|(n, _)| *n == name) {
            rotate_taps(&mut theirs, *order);
            println!("rotate {name}: LinuxCNC feeds its taps along the wrong axis");
        }
        let difference = first_difference(&theirs, &ours);
        match &difference {
            None if theirs.is_empty() && code.is_none() => {
                println!("empty  {name}: nothing that moves");
            }
            None => {
                agree += 1;
                println!("agree  {name}: {} calls", theirs.len());
            }
            Some(text) => wrong.push(format!("{name}: {text}\n   {problems}")),
        }
    }
    println!("{agree} of {} agree", found.len());
    assert!(wrong.is_empty(), "{}\n{} wrong", wrong.join("\n"), wrong.len());
}

/// Whether the problems hold the error that is due, or none.
fn ends_as_it_should(problems: &str, code: Option<&str>) -> bool {
    code.map_or(!problems.contains("error["), |c| problems.contains(c))
}

fn first_difference(theirs: &[Call], ours: &[Call]) -> Option<String> {
    for (index, their) in theirs.iter().enumerate() {
        match ours.get(index) {
            Some(our) if our.agrees(their) => {}
            our => return Some(format!("call {index}: theirs {their:?}, ours {our:?}")),
        }
    }
    (ours.len() > theirs.len()).then(|| format!("ours goes on: {:?}", ours[theirs.len()]))
}

/// The calls without straight moves to where the tool is, and the feeds of these.
fn without_rests(calls: Vec<Call>) -> Vec<Call> {
    let mut place = vec![0.0; 6];
    let mut out = Vec::new();
    let mut rests = false;
    for call in calls {
        match &call {
            Call::Numbers("rapid" | "line", to, _) => {
                rests = to.iter().zip(&place).all(|(a, b)| (a - b).abs() < 1e-4);
                place.clone_from(to);
            }
            Call::Numbers("feed", ..) if rests => continue,
            Call::Numbers("arc", at, _) => (place[2], place[0], rests) = (at[0], at[1], false),
            _ => rests = false,
        }
        if !rests {
            out.push(call);
        }
    }
    out
}

fn rotate_taps(calls: &mut [Call], order: [usize; 3]) {
    for index in 0..calls.len() {
        // The feed moves of a tap are followed by their feed and a spindle that stops; that of
        // the last move was cut off with the end of the program.
        let tap = index + 2 == calls.len()
            || matches!(calls.get(index + 2), Some(Call::Numbers("spindle", ..)));
        if let Call::Numbers("line", values, _) = &mut calls[index]
            && tap
        {
            let old = [values[0], values[1], values[2]];
            for (value, from) in values.iter_mut().zip(order) {
                *value = old[from];
            }
        }
    }
}

/// Programs that LinuxCNC rejects and we accept, and why.
const ACCEPTED: [(&str, &str); 2] = [
    ("g64-r-on-g61", "a word that nothing uses is a warning"),
    ("g64-m19-r-ambiguous", "R goes to M19"),
];

#[test]
fn oracle_linuxcnc_rejects() {
    let Some(folder) = outside("suites/LinuxCNC__linuxcnc/interp/bad") else { return };
    let mut wrong = Vec::new();
    let mut files: Vec<_> =
        std::fs::read_dir(folder).unwrap().flatten().map(|e| e.path()).collect();
    files.sort();
    for file in files.iter().filter(|f| f.extension().is_some_and(|x| x == "ngc")) {
        let name = file.file_stem().unwrap().to_string_lossy().into_owned();
        let (_, problems) = our_calls(file);
        let first = problems.split('\n').find(|l| l.contains("error[")).unwrap_or("accepted");
        println!("{name}: {first}");
        let known = ACCEPTED.iter().any(|(n, _)| *n == name);
        if (first == "accepted") != known {
            wrong.push(name);
        }
    }
    assert!(wrong.is_empty(), "{wrong:?}");
}
