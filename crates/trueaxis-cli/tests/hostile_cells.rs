//! Hostile numbers in every table that a command reads: each run ends in time, without a panic, and an answer
//! fits its schema, which has no `null` where it promises a number.
//!
//! `cargo test -p trueaxis-cli --test hostile_cells` tries every column with a few numbers; the long form, every
//! column and every quantity of every file with all of them, lists what became of each:
//!
//! ```text
//! cargo test --release -p trueaxis-cli --test hostile_cells -- --ignored --nocapture
//! ```

#[path = "command/mod.rs"]
mod command;

use command::{Folder, root};
use jsonschema::Validator;
use serde_json::Value;
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::sync::Mutex;
use std::time::{Duration, Instant};

/// Name of the answer, command, files that it reads.
const CASES: &[(&str, &str, &str)] = &[
    ("evaluate", "evaluate iso230-1 07/moody-1955.csv", "07/moody-1955.csv"),
    ("evaluate", "evaluate iso230-1 07/squareness-xy.csv", "07/squareness-xy.csv"),
    ("evaluate", "evaluate iso230-1 07/straightness-x-level.csv", "07/straightness-x-level.csv"),
    (
        "evaluate",
        "evaluate iso230-2 07/x-axis-laser.csv --conditions 07/x-axis-laser.toml",
        "07/x-axis-laser.csv 07/x-axis-laser.toml",
    ),
    ("evaluate", "evaluate iso230-2 07/c-axis-polygon.csv", "07/c-axis-polygon.csv"),
    ("evaluate", "evaluate iso230-3 07/spindle-drift.csv", "07/spindle-drift.csv"),
    (
        "evaluate",
        "evaluate iso230-4 07/circle-xy.csv --conditions 07/circle-xy.toml",
        "07/circle-xy.csv 07/circle-xy.toml",
    ),
    (
        "evaluate",
        "evaluate iso230-6 07/body-diagonals.csv --conditions 07/body-diagonals.toml",
        "07/body-diagonals.csv 07/body-diagonals.toml",
    ),
    ("evaluate", "evaluate iso230-7 07/spindle-motion.csv", "07/spindle-motion.csv"),
    (
        "evaluate",
        "evaluate iso230-10 07/probe-performance.csv --conditions 07/probe-performance.toml",
        "07/probe-performance.csv 07/probe-performance.toml",
    ),
    ("evaluate-form", "evaluate form 07/cone-section.csv --element circle", "07/cone-section.csv"),
    (
        "evaluate-form",
        "evaluate form 07/cylinder-points.csv --element cylinder",
        "07/cylinder-points.csv",
    ),
    (
        "certificate",
        "verify --certificate 07/certificate.toml",
        "07/certificate-before.csv 07/certificate-after.csv 07/certificate.toml",
    ),
    (
        "verify",
        "verify 07/probe-ball.toml",
        "07/probe-ball.csv 07/probe-ball-campaign.toml 07/probe-ball-machine.toml",
    ),
    (
        "verify-part",
        "verify --part 07/nas979-points.toml",
        "07/nas979-points.csv 07/nas979-points.toml",
    ),
    (
        "before-after",
        "verify --before-after 07/laser-before-after-x.toml",
        "07/laser-before-after-x.toml",
    ),
    (
        "diff",
        "verify --diff machines/xkas2525/machine.toml 07/xkas2525-after-a-year.toml",
        "07/xkas2525-after-a-year-X.csv 07/xkas2525-after-a-year.toml",
    ),
    ("identify-errors", "identify 05/probe-ball.toml", "05/probe-ball.csv 05/probe-ball.toml"),
    (
        "identify-errors",
        "identify 05/mixed-instruments.toml",
        "05/ball-bar.csv 05/r-test.csv 05/laser-x.csv 05/mixed-instruments.toml",
    ),
    ("identify-errors", "identify 05/cone-path.toml", "05/cone-path.csv 05/cone-path.toml"),
    (
        "identify-errors",
        "identify 05/probe-ball-procedure.toml",
        "05/procedure-ball-bar.csv 05/procedure-ball.csv 05/procedure-probe.csv 05/procedure-zero.csv",
    ),
    (
        "identify-expansion",
        "identify expansion 05/y-axis-two-temperatures.toml",
        "05/y-axis-two-temperatures.csv 05/y-axis-two-temperatures.toml",
    ),
    (
        "identify-tables",
        "identify tables 05/error-tables.toml",
        "05/error-tables/EXX.csv 05/error-tables/ECC.csv 05/error-tables/circle-XY.csv 05/error-tables.toml",
    ),
    (
        "identify-thermal",
        "identify thermal 05/lathe-thermal.toml --score 05/lathe-new-day.csv",
        "05/lathe-thermal/cycle-1.csv 05/lathe-new-day.csv 05/lathe-thermal.toml",
    ),
    (
        "identify-rtcp",
        "identify rtcp 05/rtcp-engraver.toml",
        "05/rtcp-engraver-a.csv 05/rtcp-engraver-c-rtcp.csv 05/rtcp-engraver.toml",
    ),
    (
        "identify-rtcp",
        "identify rtcp 05/rtcp-angles.toml",
        "05/rtcp-angles-high.csv 05/rtcp-angles.toml",
    ),
    (
        "identify-surface",
        "identify surface 05/bangle-hits.toml",
        "05/bangle-points.csv 05/bangle-hits.toml",
    ),
    (
        "identify-probe",
        "identify probe 05/ring-60.toml",
        "05/ring-60.csv 05/ring-60-fresh.csv 05/ring-60.toml",
    ),
    ("identify-probe", "identify probe 05/sphere.toml", "05/sphere-long.csv 05/sphere.toml"),
    (
        "identify-tools",
        "identify tools machines/i5-engraver/machine.toml 04/tool-setting.setup.toml 05/tool-setting.log",
        "04/tool-setting.setup.toml",
    ),
    (
        "compensate-adapt",
        "compensate adapt 06/bangle-adapt.toml --no-report",
        "06/bangle-measured.csv 06/bangle-blank.csv 06/bangle-adapt.toml",
    ),
    (
        "compensate",
        "compensate values machines/xkas2525/machine.toml --axis C --step 30",
        "machines/xkas2525/C.csv machines/xkas2525/machine.toml",
    ),
    ("check", "check machines/i5-engraver/machine.toml", "machines/i5-engraver/machine.toml"),
    (
        "check",
        "check machines/gantry-001/machine.toml",
        "machines/gantry-001/X.csv machines/gantry-001/machine.toml",
    ),
    (
        "pose-rows",
        "pose machines/xkas2525/machine.toml --at-file 01/positions.csv",
        "01/positions.csv",
    ),
    ("solve-path", "solve machines/i5-engraver/machine.toml --path 01/path.csv", "01/path.csv"),
    (
        "predict-holes",
        "predict 03/torque-arm-over-a-shift.toml --no-report",
        "03/torque-arm-hall.csv 03/torque-arm-over-a-shift.toml",
    ),
    ("predict", "predict 03/cone-on-i5.toml --no-report", "03/cone-on-i5.toml"),
    ("plan", "plan 04/probe-ball.toml", "04/probe-ball.toml"),
    (
        "plan-probe-surface",
        "plan probe-surface 04/probe-surface.toml",
        "04/bangle-nominal.csv 04/bangle-true.csv 04/probe-surface.toml",
    ),
    ("measure", "measure 07/probe-ball-campaign.toml -o readings", "07/probe-ball-poses.csv"),
    (
        "simulate",
        "simulate machines/i5-engraver/machine.toml 02/ring-fanuc.nc --no-report",
        "02/ring-fanuc.setup.toml",
    ),
];

const HUGE: [&str; 3] = ["1e9", "1e308", "-1e308"];
const OTHERS: [&str; 7] = [
    "1e-308",
    "NaN",
    "inf",
    "",
    "99999999999999999999999999",
    "-99999999999999999999999999",
    "1e6",
];

/// A run may take so long; the slowest example takes some seconds, on a busy machine a minute.
const LONGEST: Duration = Duration::from_secs(120);
/// Examples that take seconds are not in the short form.
const SLOW: [&str; 4] = ["certificate", "compensate-adapt", "verify-part", "diff"];

/// One changed cell or quantity.
struct Mutant<'c> {
    case: &'c (&'static str, &'static str, &'static str),
    file: String,
    /// Column of a table or key of a section.
    name: String,
    line: usize,
    value: &'static str,
    text: String,
}

/// The files of one worker, a copy of the examples.
struct Copied(Folder);

impl Copied {
    fn new(name: &str) -> Self {
        let folder = Folder::new(name);
        for part in ["examples", "machines", "testpieces"] {
            copy(&root().join(part), Path::new(&folder.path(part)));
        }
        Self(folder)
    }
}

fn copy(from: &Path, to: &Path) {
    fs::create_dir_all(to).expect("a folder");
    for entry in fs::read_dir(from).expect("a folder").flatten() {
        let (path, to) = (entry.path(), to.join(entry.file_name()));
        if path.is_dir() {
            copy(&path, &to);
        } else {
            fs::copy(&path, &to).expect("a copy");
        }
    }
}

/// `07/x.csv` is `examples/07_verify/x.csv`.
fn whole(words: &str) -> String {
    let folders = [
        "01_describe",
        "02_simulate",
        "03_predict",
        "04_plan",
        "05_identify",
        "06_compensate",
        "07_verify",
    ];
    let long = |word: &str| match word.split_once('/') {
        Some((number, rest)) if number.len() == 2 => {
            let folder = folders.iter().find(|f| f.starts_with(number)).expect("a folder");
            format!("examples/{folder}/{rest}")
        }
        _ => word.to_owned(),
    };
    words.split(' ').map(long).collect::<Vec<_>>().join(" ")
}

/// The column of every heading with each value, in a row in the middle.
fn of_table<'c>(
    case: &'c (&'static str, &'static str, &'static str),
    file: &str,
    values: &[&'static str],
    found: &mut Vec<Mutant<'c>>,
) {
    let text = fs::read_to_string(root().join(file)).expect(file);
    let lines: Vec<&str> = text.lines().collect();
    let rows: Vec<usize> = (0..lines.len())
        .filter(|i| !lines[*i].trim().is_empty() && !lines[*i].trim_start().starts_with('#'))
        .collect();
    let (head, row) = (lines[rows[0]], rows[rows.len() / 2].max(rows[1]));
    for (c, name) in head.split([',', ';']).enumerate() {
        for value in values {
            let mut cells: Vec<&str> = lines[row].split([',', ';']).collect();
            let Some(cell) = cells.get_mut(c) else { continue };
            *cell = value;
            let changed = cells.join(if head.contains(';') { ";" } else { "," });
            let mut all = lines.clone();
            all[row] = &changed;
            found.push(Mutant {
                case,
                file: file.to_owned(),
                name: name.trim().to_owned(),
                line: row + 1,
                value,
                text: all.join("\n") + "\n",
            });
        }
    }
}

/// Every first number of an entry with each value.
fn of_entries<'c>(
    case: &'c (&'static str, &'static str, &'static str),
    file: &str,
    values: &[&'static str],
    found: &mut Vec<Mutant<'c>>,
) {
    let text = fs::read_to_string(root().join(file)).expect(file);
    let lines: Vec<&str> = text.lines().collect();
    for (i, line) in lines.iter().enumerate().filter(|(_, l)| !l.trim_start().starts_with('#')) {
        let Some((key, rest)) = line.split_once(" = ") else { continue };
        let Some(from) = rest.find(|c: char| c.is_ascii_digit()) else { continue };
        let from = from - usize::from(rest[..from].ends_with('-'));
        // A name with a digit in it is no number.
        if rest[..from].ends_with(|c: char| c.is_alphanumeric() || "/_.".contains(c)) {
            continue;
        }
        let end = rest[from..]
            .find(|c: char| !(c.is_ascii_digit() || ".-e".contains(c)))
            .map_or(rest.len(), |n| from + n);
        for value in values {
            let changed = format!("{key} = {}{value}{}", &rest[..from], &rest[end..]);
            let mut all = lines.clone();
            all[i] = &changed;
            found.push(Mutant {
                case,
                file: file.to_owned(),
                name: key.trim().to_owned(),
                line: i + 1,
                value,
                text: all.join("\n") + "\n",
            });
        }
    }
}

/// What became of a mutant: exit status and output; what is wrong with it.
fn run(mutant: &Mutant<'_>, copied: &Copied) -> (String, Result<(), String>) {
    let place = copied.0.path(&mutant.file);
    let before = fs::read(&place).expect("the file");
    fs::write(&place, &mutant.text).expect("written");
    let out = copied.0.path("out.json");
    let err = copied.0.path("err.txt");
    let words = whole(mutant.case.1);
    let mut child = Command::new(env!("CARGO_BIN_EXE_trueaxis"))
        .args(words.split(' ').chain(["--format", "json"]))
        .current_dir(copied.0.path(""))
        .stdin(Stdio::null())
        .stdout(fs::File::create(&out).expect("a file"))
        .stderr(fs::File::create(&err).expect("a file"))
        .spawn()
        .expect("the command starts");
    let begun = Instant::now();
    let status = loop {
        match child.try_wait().expect("a child") {
            Some(status) => break status.code(),
            None if begun.elapsed() > LONGEST => {
                let _ = child.kill(); // it may have ended
                let _ = child.wait();
                break Some(124);
            }
            None => std::thread::sleep(Duration::from_millis(3)),
        }
    };
    fs::write(&place, before).expect("written");
    let _ = fs::remove_dir_all(copied.0.path("readings")); // only `measure` writes it
    let (out, err) =
        (fs::read_to_string(out).expect("UTF-8"), fs::read_to_string(err).expect("UTF-8"));
    let judged = judge(mutant, status, &out, &err);
    (status.map_or("killed".to_owned(), |s| s.to_string()), judged)
}

fn judge(mutant: &Mutant<'_>, status: Option<i32>, out: &str, err: &str) -> Result<(), String> {
    if err.contains("panicked at") {
        return Err(format!("panic: {err}"));
    }
    let Some(status @ 0..=2) = status else { return Err(format!("status {status:?}")) };
    let document: Value = match serde_json::from_str(out) {
        Ok(document) => document,
        Err(e) => return Err(format!("no document: {e}; {err}")),
    };
    let name = if status == 2 && document["schema"] == "trueaxis/refused/1" {
        "refused"
    } else {
        mutant.case.0
    };
    let wrong: Vec<String> = validator(name)
        .iter_errors(&document)
        .map(|e| format!("{}: {e}", e.instance_path()))
        .collect();
    if let Some(first) = wrong.first() {
        return Err(format!("schema {name}: {}", first.chars().take(200).collect::<String>()));
    }
    let refused = || {
        let file = mutant.file.rsplit('/').next().unwrap_or_default();
        document["diagnostics"].as_array().is_some_and(|all| {
            all.iter().any(|d| {
                d["severity"] == "error"
                    && d["file"].as_str().is_some_and(|f| f.ends_with(file))
                    && d["line"] == mutant.line
            })
        })
    };
    let is_table = mutant.file.ends_with(".csv");
    // A column that is not read may hold anything.
    let is_read = mutant.name.contains('_') && !mutant.name.starts_with("n_") && !unread(mutant);
    if is_table && is_read && HUGE.contains(&mutant.value) && !refused() {
        return Err(format!(
            "status {status}, not refused with its row; {}",
            err.lines().next().unwrap_or_default()
        ));
    }
    Ok(())
}

/// Columns that the command does not read: words and remarks.
fn unread(mutant: &Mutant<'_>) -> bool {
    let words = ["direction", "axis", "line", "setup", "run", "diagonal", "group", "probe_no"];
    words.contains(&mutant.name.as_str()) || mutant.name.ends_with("_approach")
}

fn validator(name: &str) -> &'static Validator {
    static KNOWN: Mutex<BTreeMap<String, &'static Validator>> = Mutex::new(BTreeMap::new());
    let mut known = KNOWN.lock().expect("no thread has panicked");
    known.entry(name.to_owned()).or_insert_with(|| {
        let text =
            fs::read_to_string(root().join(format!("docs/schemas/{name}.json"))).expect(name);
        let schema = serde_json::from_str(&text).expect("JSON");
        Box::leak(Box::new(jsonschema::validator_for(&schema).expect("a schema")))
    })
}

/// Runs all; returns a line for each, and what is wrong.
fn run_all(mutants: &[Mutant<'_>], name: &str) -> (Vec<String>, Vec<String>) {
    let workers = std::thread::available_parallelism().map_or(2, |n| n.get()).min(8);
    let next = std::sync::atomic::AtomicUsize::new(0);
    let found = Mutex::new((Vec::new(), Vec::new()));
    std::thread::scope(|scope| {
        for worker in 0..workers {
            let (next, found) = (&next, &found);
            scope.spawn(move || {
                let copied = Copied::new(&format!("{name}-{worker}"));
                loop {
                    let i = next.fetch_add(1, std::sync::atomic::Ordering::Relaxed);
                    let Some(mutant) = mutants.get(i) else { break };
                    let (status, judged) = run(mutant, &copied);
                    let line = format!(
                        "{} | {}:{} {} = `{}` | {status}",
                        mutant.case.1, mutant.file, mutant.line, mutant.name, mutant.value
                    );
                    let mut found = found.lock().expect("no thread has panicked");
                    if let Err(wrong) = judged {
                        found.1.push(format!("{line} | {wrong}"));
                    }
                    found.0.push(line);
                }
            });
        }
    });
    found.into_inner().expect("no thread has panicked")
}

fn mutants(values: &[&'static str], entries: bool) -> Vec<Mutant<'static>> {
    let mut found = Vec::new();
    for case in CASES {
        for file in whole(case.2).split(' ') {
            if file.ends_with(".csv") {
                of_table(case, file, values, &mut found);
            } else if entries {
                of_entries(case, file, values, &mut found);
            }
        }
    }
    found
}

/// A part of the cells, with values that change from one to the next.
#[test]
fn a_hostile_cell_is_refused_or_answered_whole() {
    let values: Vec<&str> = HUGE.into_iter().chain(OTHERS).collect();
    let all = mutants(&values, false);
    let quick = all.into_iter().filter(|m| !SLOW.contains(&m.case.0));
    let some: Vec<Mutant<'_>> =
        quick.enumerate().filter(|(i, _)| i % 31 == 0).map(|(_, m)| m).collect();
    assert!(some.len() > 40);
    let (_, wrong) = run_all(&some, "hostile-short");
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
#[ignore = "some thousand runs; see the head of the file"]
#[allow(clippy::print_stdout, reason = "the list is what the long run is for")]
fn every_hostile_value_is_refused_or_answered_whole() {
    let values: Vec<&str> = HUGE.into_iter().chain(OTHERS).collect();
    let (mut lines, wrong) = run_all(&mutants(&values, true), "hostile-long");
    lines.sort();
    println!("{}", lines.join("\n"));
    println!("{} runs, {} wrong", lines.len(), wrong.len());
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
