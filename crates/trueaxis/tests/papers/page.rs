//! The page docs/validation.md.

use crate::claim::{Claim, Record};
use crate::errata_in;
use crate::scan::JudgedTest;
use std::fmt::Write;

/// More decimals than this would show the last bits of one kind of CPU.
const MOST_DECIMALS: usize = 7;

/// The whole page.
pub fn written(
    records: &[Record],
    tests: &[JudgedTest],
    ours: &dyn Fn(&Claim) -> Vec<f64>,
) -> String {
    let mut page = head(records, tests);
    for record in records.iter().filter(|r| !r.claims.is_empty()) {
        page += &section(&record.title, &record.text);
        page += "| claim | source | theirs | ours | allowed difference | why |\n";
        page += "|---|---|---|---|---|---|\n";
        for claim in &record.claims {
            page += &claim_row(claim, &ours(claim));
        }
    }
    for record in records.iter().filter(|r| !r.differences.is_empty()) {
        page += &section(&record.title, &record.text);
        page += &differences(record, records);
    }
    page += &judged(tests);
    for record in records.iter().filter(|r| !r.outsides.is_empty()) {
        page += &section(&record.title, &record.text);
        page += "| files | found | differs, and why | test |\n|---|---|---|---|\n";
        for outside in &record.outsides {
            let test = format!("`{}`", outside.test);
            page += &row(&[&outside.files, &outside.found, &outside.differs, &test]);
        }
    }
    for record in records.iter().filter(|r| !r.unknowns.is_empty()) {
        page += &section(&record.title, &record.text);
        page += "| what | why not | what would settle it |\n|---|---|---|\n";
        for unknown in &record.unknowns {
            page += &row(&[&unknown.what, &unknown.why, &unknown.settled_by]);
        }
    }
    page
}

fn head(records: &[Record], tests: &[JudgedTest]) -> String {
    let claims: usize = records.iter().map(|r| r.claims.len()).sum();
    let differences: usize = records.iter().map(|r| r.differences.len()).sum();
    let unknowns: usize = records.iter().map(|r| r.unknowns.len()).sum();
    let laws = tests.iter().filter(|t| t.name.starts_with("law_")).count();
    format!(
        "# Validation\n\n\
         <!-- Generated. Do not edit: change crates/trueaxis/tests/papers and run\n     \
         TRUEAXIS_WRITE_VALIDATION=1 cargo test -p trueaxis --test papers -->\n\n\
         This page states what was compared with what, and what was not. A test computes every figure under *ours* again through the library's public \
         interface, compares it with *theirs*, and compares this page with what it found: a page \
         that is out of date does not pass.\n\n\
         *Theirs* is a number that an independent source has printed or computed, or one that can be worked out \
         from a printed formula with a pocket calculator. *Allowed difference* is absolute, in the \
         unit of the row; it follows from the reason given in the row, not from how close we came. Numbers such \
         as 000-21 count the errors and ambiguities found in the five source papers (000 Wu et \
         al. 2022, 001 Zhang et al. 2019, 002 Jiang et al., 003 Zhang Jian et al. 2023, 004 Lei and \
         Hsu 2003).\n\n\
         {claims} claims · {differences} differences from the sources · {laws} laws and {} \
         comparisons with programs and formulas · {unknowns} open points.\n",
        tests.len() - laws
    )
}

fn section(title: &str, text: &str) -> String {
    format!("\n## {title}\n\n{text}\n\n")
}

fn row(cells: &[&str]) -> String {
    let mut line = String::from("|");
    for cell in cells {
        let _ = write!(line, " {} |", cell.replace('|', "\\|"));
    }
    line + "\n"
}

fn claim_row(claim: &Claim, ours: &[f64]) -> String {
    let decimals = decimals(claim.allowed);
    let unit = |numbers: Vec<String>| {
        format!("{} {}", numbers.join(", "), claim.unit).trim_end().to_owned()
    };
    let theirs = claim.theirs.iter().map(|v| as_stated(*v, decimals)).collect();
    let ours = ours.iter().map(|v| rounded(*v, decimals, &claim.id)).collect();
    row(&[
        &format!("{} `{}`", claim.what, claim.id),
        &claim.source,
        &unit(theirs),
        &unit(ours),
        &unit(vec![plain(claim.allowed)]),
        &claim.why,
    ])
}

/// One digit below the first of the allowed difference.
fn decimals(allowed: f64) -> usize {
    // The printed exponent is the same on every CPU, a logarithm need not be.
    let printed = format!("{allowed:e}");
    let exponent: i32 = printed.split('e').nth(1).and_then(|e| e.parse().ok()).expect("1e-3");
    (1 - exponent).clamp(0, MOST_DECIMALS as i32) as usize
}

/// Rounded so that the last bits do not show; a number on the edge of rounding is refused.
fn rounded(value: f64, decimals: usize, id: &str) -> String {
    let steps = value * 10f64.powi(decimals as i32);
    let from_edge = (steps.abs().fract() - 0.5).abs();
    assert!(from_edge > 1e-4, "{id}: {value} lies on the edge of rounding to {decimals} decimals");
    let text = format!("{value:.decimals$}");
    match text.strip_prefix('-') {
        Some(digits) if digits.chars().all(|c| c == '0' || c == '.') => digits.to_owned(),
        _ => text,
    }
}

/// As it was typed, unless it came from a file with all its digits.
fn as_stated(value: f64, decimals: usize) -> String {
    let typed = plain(value);
    if typed.len() > 12 { rounded(value, decimals, "theirs") } else { typed }
}

fn plain(value: f64) -> String {
    if value != 0.0 && value.abs() < 1e-3 { format!("{value:e}") } else { format!("{value}") }
}

fn differences(record: &Record, records: &[Record]) -> String {
    let mut text =
        "| | the source says | we do | why | shown by |\n|---|---|---|---|---|\n".to_owned();
    for difference in &record.differences {
        let cites = |c: &&Claim| {
            errata_in(&format!("{} {} {}", c.what, c.source, c.why)).contains(&difference.id)
        };
        let claims = records.iter().flat_map(|r| &r.claims).filter(cites);
        let claims: Vec<String> = claims.map(|c| format!("`{}`", c.id)).collect();
        let cells = [&difference.id, &difference.source_says, &difference.we_do, &difference.why];
        let shown_by = claims.join(" ");
        text += &row(&[cells[0], cells[1], cells[2], cells[3], &shown_by]);
    }
    text
}

fn judged(tests: &[JudgedTest]) -> String {
    let mut text = section(
        "What is proved by laws and other programs",
        "Found by reading the test files: the prefix of a test's name says who the judge is. All of \
         them run with `cargo test --workspace`.",
    );
    for (prefix, judge) in [
        ("law_", "Mathematics is the judge: true for any numbers, tried on many"),
        ("oracle_", "Another program is the judge (scripts in oracles/, their results committed)"),
        ("paper_", "A printed formula or number is the judge, in the crate that it concerns"),
    ] {
        let _ = write!(text, "### {judge}\n\n| what holds | test | file |\n|---|---|---|\n");
        for test in tests.iter().filter(|t| t.name.starts_with(prefix)) {
            let file = test.file.trim_start_matches("crates/");
            let link = format!("[{file}](../{})", test.file);
            text += &row(&[&test.sentence, &format!("`{}`", test.name), &link]);
        }
        text.push('\n');
    }
    text.trim_end().to_owned() + "\n"
}
