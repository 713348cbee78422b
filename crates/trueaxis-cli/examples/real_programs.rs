//! Other people's NC programs through `trueaxis simulate`: a table of what is executed and what is not.
//!
//! `scripts/real-programs` brings the files here and calls this:
//!
//! ```text
//! real_programs TRUEAXIS MACHINES SOURCES.json FILES [TABLE.md]
//! ```
//!
//! FILES has a folder OWNER+NAME for each repository of SOURCES. The exit status is 1 if a program is
//! refused that its control runs.

#![allow(clippy::print_stdout, reason = "it prints a table")]

use serde_json::Value;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode, Stdio};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

/// A program that takes longer is stopped and listed as such.
const LONGEST: Duration = Duration::from_secs(60);
/// More reasons of one program are of no use to a reader.
const MOST_REASONS: usize = 3;

type Error = Box<dyn std::error::Error>;

/// A file of a source.
struct Entry {
    source: String,
    file: PathBuf,
    shown: String,
    control: String,
    machine: String,
    /// Why its first line, which is no part of it, is taken away.
    without_first_line: Option<String>,
    /// Why its control does not run it either.
    excuse: Option<String>,
}

/// What became of a program.
enum Verdict {
    /// All motion is executed.
    Run,
    /// Executed but for functions that move the tool, or its place.
    Partly,
    /// Ended by an error.
    Refused,
    /// Not ended in time.
    TooLong,
    /// The same, and its control does not run it either.
    Excused,
}

impl Verdict {
    fn word(&self) -> &'static str {
        match self {
            Self::Run => "run",
            Self::Partly => "run in part",
            Self::Refused => "refused",
            Self::TooLong => "too long",
            Self::Excused => "refused, rightly",
        }
    }
}

struct Row {
    blocks: usize,
    verdict: Verdict,
    reasons: Vec<String>,
}

fn main() -> ExitCode {
    match run() {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::from(1),
        Err(error) => {
            println!("{error}");
            ExitCode::from(2)
        }
    }
}

fn run() -> Result<bool, Error> {
    let arguments: Vec<PathBuf> = std::env::args_os().skip(1).map(PathBuf::from).collect();
    let [program, machines, sources, files, ..] = &*arguments else {
        return Err("expected TRUEAXIS MACHINES SOURCES.json FILES [TABLE.md]".into());
    };
    let manifest: Value = serde_json::from_str(&std::fs::read_to_string(sources)?)?;
    let mut entries = Vec::new();
    for source in list(&manifest["sources"]) {
        find(source, files, &mut entries)?;
    }
    if entries.is_empty() {
        println!("skipped: none of the programs is here");
        return Ok(true);
    }
    let rows = simulate_all(program, machines, &entries);
    let table = table(&manifest, files, &entries, &rows);
    match arguments.get(4) {
        Some(path) => std::fs::write(path, &table)?,
        None => println!("{table}"),
    }
    Ok(!rows.iter().any(|row| matches!(row.verdict, Verdict::Refused | Verdict::TooLong)))
}

fn list(value: &Value) -> &[Value] {
    value.as_array().map_or(&[], Vec::as_slice)
}

fn text<'a>(value: &'a Value, key: &str) -> &'a str {
    value[key].as_str().unwrap_or_default()
}

/// The folder of a repository.
fn folder_of(source: &Value, files: &Path) -> PathBuf {
    files.join(text(source, "repository").replace('/', "+"))
}

fn find(source: &Value, files: &Path, entries: &mut Vec<Entry>) -> Result<(), Error> {
    let root = folder_of(source, files);
    for set in list(&source["sets"]) {
        let folder = root.join(text(set, "folder"));
        let mut found = Vec::new();
        walk(&folder, &mut found);
        found.sort();
        for file in found {
            let name = file.file_name().unwrap_or_default().to_string_lossy().into_owned();
            let ending = file.extension().unwrap_or_default().to_string_lossy().to_lowercase();
            let by_name = list(&set["only"]).iter().any(|only| *only == *name);
            let by_ending = list(&set["endings"]).iter().any(|one| *one == *ending);
            if !by_name && !by_ending {
                continue;
            }
            let shown = file.strip_prefix(&root)?.to_string_lossy().into_owned();
            entries.push(Entry {
                source: text(source, "repository").to_owned(),
                excuse: excuse_of(source, &shown),
                shown,
                file,
                control: text(set, "control").to_owned(),
                machine: text(set, "machine").to_owned(),
                without_first_line: set["without_first_line"].as_str().map(str::to_owned),
            });
        }
    }
    Ok(())
}

/// The reason under which a program is listed.
fn excuse_of(source: &Value, shown: &str) -> Option<String> {
    let named = |(_, paths): &(&String, &Value)| list(paths).iter().any(|path| *path == *shown);
    source["refused"].as_object()?.iter().find(named).map(|(reason, _)| reason.clone())
}

fn walk(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).into_iter().flatten().flatten() {
        let path = entry.path();
        if path.is_dir() { walk(&path, found) } else { found.push(path) }
    }
}

/// Two programs at a time.
fn simulate_all(program: &Path, machines: &Path, entries: &[Entry]) -> Vec<Row> {
    let next = AtomicUsize::new(0);
    let rows = Mutex::new((0..entries.len()).map(|_| None).collect::<Vec<Option<Row>>>());
    std::thread::scope(|scope| {
        for _ in 0..2 {
            scope.spawn(|| {
                while let Some((i, entry)) = Some(next.fetch_add(1, Ordering::Relaxed))
                    .and_then(|i| Some((i, entries.get(i)?)))
                {
                    let row = simulate(program, machines, entry);
                    rows.lock().expect("no thread has panicked")[i] = Some(row);
                }
            });
        }
    });
    rows.into_inner().expect("no thread has panicked").into_iter().flatten().collect()
}

fn simulate(program: &Path, machines: &Path, entry: &Entry) -> Row {
    let bytes = std::fs::read(&entry.file).unwrap_or_default();
    let blocks = bytes.split(|b| *b == b'\n').filter(|line| !line.trim_ascii().is_empty()).count();
    let mut file = entry.file.clone();
    if entry.without_first_line.is_some() {
        // Beside the original, where its subprograms are.
        let end = bytes.iter().position(|b| *b == b'\n').map_or(bytes.len(), |n| n + 1);
        file = file.with_extension("without-first-line");
        if let Err(error) = std::fs::write(&file, &bytes[end..]) {
            return Row { blocks, verdict: Verdict::Refused, reasons: vec![error.to_string()] };
        }
    }
    let mut command = Command::new(program);
    command.arg("simulate").arg(machines.join(&entry.machine).join("machine.toml"));
    command.arg(&file).args(["--control", &entry.control]);
    command.args(["--keep-going", "--no-report", "--no-collisions", "--format", "json"]);
    let (verdict, mut reasons) = match output_in_time(&mut command) {
        Ok(Some(output)) => judge(&output, entry),
        Ok(None) => (Verdict::TooLong, vec![format!("more than {} s", LONGEST.as_secs())]),
        Err(error) => (Verdict::Refused, vec![error.to_string()]),
    };
    reasons.extend(entry.without_first_line.iter().map(|why| format!("without line 1: {why}")));
    Row { blocks, verdict, reasons }
}

/// Standard output; nothing where it takes too long.
fn output_in_time(command: &mut Command) -> std::io::Result<Option<Vec<u8>>> {
    let mut child = command.stdout(Stdio::piped()).stderr(Stdio::null()).spawn()?;
    let mut stdout = child.stdout.take().expect("a pipe");
    let reader = std::thread::spawn(move || {
        let mut bytes = Vec::new();
        std::io::Read::read_to_end(&mut stdout, &mut bytes).map(|_| bytes)
    });
    let begin = Instant::now();
    while child.try_wait()?.is_none() {
        if begin.elapsed() > LONGEST {
            child.kill()?;
            child.wait()?;
            return Ok(None);
        }
        std::thread::sleep(Duration::from_millis(5));
    }
    reader.join().expect("no panic").map(Some)
}

fn judge(output: &[u8], entry: &Entry) -> (Verdict, Vec<String>) {
    let Ok(document) = serde_json::from_slice::<Value>(output) else {
        return (Verdict::Refused, vec!["no JSON".to_owned()]);
    };
    // The axes belong to the machine, the set-up and its tools to the shop.
    const OTHERS: [&str; 4] = ["no-set-up", "unknown-axis", "unknown-tool", "unknown-tool-length"];
    let about_the_program = |d: &&Value| !OTHERS.contains(&text(d, "code"));
    let found = list(&document["diagnostics"]).iter().filter(about_the_program);
    let (errors, others): (Vec<&Value>, Vec<&Value>) =
        found.partition(|d| text(d, "severity") == "error");
    let reasons = |list: &[&Value]| -> Vec<String> {
        let mut all: Vec<String> = Vec::new();
        for d in list {
            let reason =
                format!("line {}: {} [{}]", d["line"], text(d, "message"), text(d, "code"));
            let same = |one: &String| one.contains(text(d, "message"));
            if !all.iter().any(same) {
                all.push(reason);
            }
        }
        let more = all.len().saturating_sub(MOST_REASONS);
        all.truncate(MOST_REASONS);
        all.extend((more > 0).then(|| format!("{more} more")));
        all
    };
    if let Some(excuse) = entry.excuse.as_ref().filter(|_| !errors.is_empty()) {
        return (Verdict::Excused, vec![excuse.clone(), reasons(&errors).join("; ")]);
    }
    if !errors.is_empty() {
        return (Verdict::Refused, reasons(&errors));
    }
    let warnings: Vec<&Value> =
        others.into_iter().filter(|d| text(d, "severity") == "warning").collect();
    let is_whole = document["motion_left_out"] == 0;
    (if is_whole { Verdict::Run } else { Verdict::Partly }, reasons(&warnings))
}

fn table(manifest: &Value, files: &Path, entries: &[Entry], rows: &[Row]) -> String {
    let mut out = String::from(
        "# Programs of other people\n\n\
         Generated by `scripts/real-programs`. Every program goes through `trueaxis simulate` with the machine of\n\
         its set and no set-up. `run`: all motion is executed; the last column has the warnings. `run in part`:\n\
         functions that move the tool, or its place, are not executed. `refused, rightly`: its control does not\n\
         run it either, and why. Axes that the machine does not have are not counted.\n",
    );
    for source in list(&manifest["sources"]) {
        let name = text(source, "repository");
        let mine: Vec<(&Entry, &Row)> =
            entries.iter().zip(rows).filter(|(entry, _)| entry.source == name).collect();
        let from = match text(source, "commit") {
            "" => "From the outside data".to_owned(),
            commit => format!("Commit `{commit}`"),
        };
        let _ = write!(out, "\n## {name}\n\n{from}");
        if !folder_of(source, files).is_dir() {
            out.push_str(": skipped, it is not here.\n");
            continue;
        }
        if mine.is_empty() {
            out.push_str(": skipped, its programs are not here.\n");
            continue;
        }
        let count = |word: &str| mine.iter().filter(|(_, row)| row.verdict.word() == word).count();
        let words = ["run", "run in part", "refused, rightly", "refused", "too long"];
        let counts = words.map(|word| (word, count(word))).into_iter().filter(|(_, n)| *n > 0);
        let counts: Vec<String> = counts.map(|(word, n)| format!("{n} {word}")).collect();
        let _ = writeln!(out, ", {} programs: {}.\n", mine.len(), counts.join(", "));
        out.push_str("| program | control | blocks | result | remarks |\n|---|---|---|---|---|\n");
        for (entry, row) in mine {
            let reasons = row.reasons.join("; ").replace('|', "\\|").replace('\n', " ");
            let (shown, control) = (&entry.shown, &entry.control);
            let (blocks, word) = (row.blocks, row.verdict.word());
            let _ = writeln!(out, "| {shown} | {control} | {blocks} | {word} | {reasons} |");
        }
    }
    out
}
