//! Laser files of Renishaw (`.rtl`, angular `.rta`): plain text in sections, each a line that ends with `::`.
//!
//! The form is not documented by its maker; it is what public programs read and write (docs/reference/evaluation.md names
//! them). `TARGET DATA::` has the targets, `DEVIATIONS::` a row for each reading: run, number of the target from 1,
//! deviation. A run is one pass along the axis; its direction follows from the order of its targets.

use super::{Beside, Imported, one_axis_only};
use crate::Standard;
use std::borrow::Cow;
use trueaxis_input::{Diagnostics, Place};

/// What the file says beside its readings.
#[derive(Debug, Default)]
struct Head {
    machine: Option<String>,
    axis: Option<String>,
    date: Option<String>,
    flags: Vec<String>,
    target_count: Option<usize>,
}

/// One reading as it stands there.
#[derive(Debug, Clone)]
struct Row<'t> {
    line: usize,
    run: u32,
    /// From 0.
    target: usize,
    deviation: &'t str,
}

/// A pass in one direction.
#[derive(Debug)]
struct Pass {
    up: bool,
    /// From which row to which, without the end.
    rows: std::ops::Range<usize>,
}

pub(super) fn read(
    standard: Standard,
    file: &str,
    text: &str,
    problems: &mut Diagnostics,
) -> Option<Imported<'static>> {
    one_axis_only(standard, "a laser file of one axis", file, problems)?;
    let (mut head, targets, rows) = parts(file, text, problems)?;
    check_counts(file, &head, &targets, &rows, problems)?;
    let passes = passes(file, &targets, &rows, problems)?;
    let is_angular = file.to_ascii_lowercase().ends_with(".rta");
    // Neither unit stands in the file.
    let (target, deviation) = if is_angular { ("deg", "mrad") } else { ("mm", "um") };
    let message = format!(
        "targets are read in {target}, deviations in {deviation}: the file does not state its units"
    );
    let hint = "convert the readings to a table if they are in other units";
    match is_angular {
        true => problems.warn("assumed-unit", Place::whole(file), message, hint),
        false => problems.note("assumed-unit", Place::whole(file), message, hint),
    }
    let unidirectional = head.flags.get(1).is_some_and(|f| f == "1");
    let mut ours = Beside::default();
    let first = rows[0].line;
    ours.row(first - 1, &format!("target_{target},run,direction,deviation_{deviation}"));
    let mut runs = [0_u32; 2];
    for pass in &passes {
        let of_pass = &rows[pass.rows.clone()];
        let is_zero = |r: &Row<'_>| r.deviation.parse::<f64>().is_ok_and(|v| v == 0.0);
        if unidirectional && !pass.up && of_pass.iter().all(is_zero) {
            let message =
                format!("run {}: all readings of the way back are 0: left out", of_pass[0].run);
            let hint = "the flags of the file say that it was measured in one direction";
            problems.note("read-as", place(file, of_pass[0].line), message, hint);
            continue;
        }
        let run = &mut runs[usize::from(pass.up)];
        *run += 1;
        let word = if pass.up { "up" } else { "down" };
        for row in of_pass {
            let cells = format!("{},{run},{word},{}", targets[row.target], row.deviation);
            ours.row(row.line, &cells);
        }
    }
    let about = super::About {
        machine: head.machine.take(),
        axis: head.axis.take(),
        date: head.date.take(),
    };
    Some(Imported { table: Cow::Owned(ours.into_text()), about, ..Imported::default() })
}

fn place(file: &str, line: usize) -> Place {
    Place { file: file.to_owned(), line, column: 1 }
}

/// Head, targets as they are written, and rows.
fn parts<'t>(
    file: &str,
    text: &'t str,
    problems: &mut Diagnostics,
) -> Option<(Head, Vec<&'t str>, Vec<Row<'t>>)> {
    let mut head = Head::default();
    let (mut targets, mut rows) = (Vec::new(), Vec::new());
    let (mut section, mut list) = (String::new(), "");
    for (i, line) in text.lines().enumerate() {
        let (line, number) = (line.trim(), i + 1);
        if let Some(name) = line.strip_suffix("::") {
            section = name.trim().to_ascii_uppercase();
            list = "";
            continue;
        }
        if let Some((key, value)) = line.split_once(':') {
            let (key, value) = (key.trim().to_ascii_lowercase(), value.trim());
            list = match (&*section, &*key) {
                ("TARGET DATA", "targets") => "targets",
                ("DEVIATIONS", "run target data") => "rows",
                _ => "",
            };
            take(&mut head, &section, &key, value);
            if list != "targets" || value.is_empty() {
                continue;
            }
        }
        match list {
            "targets" => {
                let numbers = line.rsplit(':').next().unwrap_or("").split_whitespace();
                for word in numbers {
                    if !word.parse::<f64>().is_ok_and(f64::is_finite) {
                        return bad(file, number, word, "a target position", problems);
                    }
                    targets.push(word);
                }
            }
            "rows" if !line.is_empty() => match row(line, number) {
                Some(row) => rows.push(row),
                None => return bad(file, number, line, "run, target and deviation", problems),
            },
            _ => {}
        }
    }
    if rows.is_empty() || targets.is_empty() {
        let message = "the file has no targets or no readings".to_owned();
        let hint = "they stand below `Targets :` in TARGET DATA:: and below `Run Target Data:` in DEVIATIONS::";
        problems.error("empty-table", Place::whole(file), message, hint);
        return None;
    }
    Some((head, targets, rows))
}

fn bad<T>(
    file: &str,
    line: usize,
    found: &str,
    what: &str,
    problems: &mut Diagnostics,
) -> Option<T> {
    let found: String = found.chars().take(40).collect();
    let message = format!("`{found}` is not {what}");
    let hint = "numbers with a decimal point; is the file cut off or edited here?";
    problems.error("not-a-number", place(file, line), message, hint);
    None
}

fn take(head: &mut Head, section: &str, key: &str, value: &str) {
    let text = || (!value.is_empty()).then(|| value.to_owned());
    match (section, key) {
        ("USER-TEXT", "machine") => head.machine = text(),
        ("USER-TEXT", "axis") => head.axis = text(),
        ("USER-TEXT", "date") => head.date = text(),
        ("TARGET DATA", "flags") => {
            head.flags = value.split_whitespace().map(str::to_owned).collect();
        }
        ("TARGET DATA", "target-count") => head.target_count = value.parse().ok(),
        _ => {}
    }
}

fn row(line: &str, number: usize) -> Option<Row<'_>> {
    let mut words = line.split_whitespace();
    let (run, target, deviation) = (words.next()?, words.next()?, words.next()?);
    let run = run.parse().ok().filter(|n| *n > 0)?;
    let target = target.parse::<usize>().ok().filter(|n| *n > 0)? - 1;
    let is_number = deviation.parse::<f64>().is_ok_and(f64::is_finite);
    (is_number && words.next().is_none()).then_some(Row { line: number, run, target, deviation })
}

fn check_counts(
    file: &str,
    head: &Head,
    targets: &[&str],
    rows: &[Row<'_>],
    problems: &mut Diagnostics,
) -> Option<()> {
    if let Some(outside) = rows.iter().find(|r| r.target >= targets.len()) {
        let message =
            format!("target {} is read, the file lists {}", outside.target + 1, targets.len());
        problems.error(
            "bad-target",
            place(file, outside.line),
            message,
            "is the list of targets cut off?",
        );
        return None;
    }
    if let Some(count) = head.target_count.filter(|n| *n != targets.len()) {
        let message = format!("the file states {count} targets and lists {}", targets.len());
        let hint = "the listed ones are used; is the file cut off or edited?";
        problems.warn("count-differs", Place::whole(file), message, hint);
    }
    Some(())
}

/// The runs, split where the direction of motion turns.
fn passes(
    file: &str,
    targets: &[&str],
    rows: &[Row<'_>],
    problems: &mut Diagnostics,
) -> Option<Vec<Pass>> {
    let at = |row: &Row<'_>| targets[row.target].parse::<f64>().unwrap_or(f64::NAN);
    let mut passes: Vec<Pass> = Vec::new();
    let mut from = 0;
    while from < rows.len() {
        let same_run = |r: &&Row<'_>| r.run == rows[from].run;
        let end_of_run = from + rows[from..].iter().take_while(same_run).count();
        let mut to = from + 1;
        let mut up = None;
        while to < end_of_run {
            let step = at(&rows[to]) - at(&rows[to - 1]);
            // The target at which it turns is read once in each direction.
            if step == 0.0 || up.is_some_and(|up| up != (step > 0.0)) {
                break;
            }
            up = Some(step > 0.0);
            to += 1;
        }
        let Some(up) = up else {
            let message = format!("run {}: a single reading has no direction", rows[from].run);
            let hint = "the readings of a pass stand in the order in which they were taken";
            problems.error("bad-run", place(file, rows[from].line), message, hint);
            return None;
        };
        passes.push(Pass { up, rows: from..to });
        from = to;
    }
    Some(passes)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::import::Import;

    /// Two passes there and back, as public programs write them.
    pub(super) const FILE: &str = "HEADER::\r\nFile type  : rtl\r\nOwner      : Linear\r\n\r\nTARGET DATA::\r\n\
        Filetype  : ISO\r\nTarget-count: 3\r\nTargets :\r\n0.000  100.000\r\n 200.000 \r\nFlags: 0 0 2 0\r\n\r\n\
        USER-TEXT::\r\nMachine: M7\r\nDate:2020-02-02 10:00:00\r\nAxis:X\r\n\r\nRUNS::\r\nRun-count:4\r\n\r\n\
        DEVIATIONS::\r\nRun Target Data:\r\n1   1      0.1\r\n1   2      0.5\r\n1   3      1.0\r\n\
        2   3      0.8\r\n2   2      0.2\r\n2   1      -0.1\r\n3   1      0.3\r\n3   2      0.5\r\n\
        3   3      1.2\r\n4   3      0.6\r\n4   2      0.2\r\n4   1      -0.3\r\n\r\nENVIRONMENT::\r\nAir temp: 20.1\r\n\
        EOF::\r\n";

    fn read_file(text: &str) -> Result<Imported<'static>, Vec<&'static str>> {
        let mut problems = Diagnostics::new();
        let read = read(Standard::Iso230_2, "x.rtl", text, &mut problems);
        read.ok_or_else(|| problems.iter().map(|d| d.code).collect())
    }

    #[test]
    fn passes_become_runs_with_their_directions() {
        let read = read_file(FILE).unwrap();
        let rows: Vec<&str> = read.table().lines().filter(|l| !l.is_empty()).collect();
        assert_eq!(rows[0], "target_mm,run,direction,deviation_um");
        assert_eq!((rows[1], rows[4]), ("0.000,1,up,0.1", "200.000,1,down,0.8"));
        assert_eq!((rows[7], rows[12]), ("0.000,2,up,0.3", "0.000,2,down,-0.3"));
        assert_eq!(read.about.axis.as_deref(), Some("X"));
        assert_eq!(read.about.date.as_deref(), Some("2020-02-02 10:00:00"));
        // Both ways may also carry one number.
        let one = FILE
            .replace("\n2   ", "\n1   ")
            .replace("\n3   ", "\n2   ")
            .replace("\n4   ", "\n2   ");
        assert_eq!(read_file(&one).unwrap().table(), read.table());
        assert_eq!(Import::of("a/B.RTL".as_ref()), Import::RenishawRtl);
    }

    #[test]
    fn what_is_broken_is_named() {
        for (old, new, code) in [
            ("2   3      0.8", "2   4      0.8", "bad-target"),
            ("2   3      0.8", "2   3      0,8", "not-a-number"),
            ("0.000  100.000", "0.000  l00.000", "not-a-number"),
            ("Run Target Data:", "Run data:", "empty-table"),
            ("4   3      0.6\r\n4   2      0.2\r\n", "", "bad-run"),
        ] {
            let found = read_file(&FILE.replace(old, new)).unwrap_err();
            assert_eq!(found.last(), Some(&code), "{new}");
        }
        // A way back of zeros in a test in one direction.
        let one_way = FILE
            .replace("0 0 2 0", "0 1 2 0")
            .replace("0.8", "0")
            .replace("2   2      0.2", "2   2 0");
        let one_way = one_way.replace("2   1      -0.1", "2   1 0");
        assert!(!read_file(&one_way).unwrap().table().contains(",1,down,0\n"));
    }
}
