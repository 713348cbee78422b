//! In which order a table was written is no measurement: it changes neither the parts of the cross-validation nor what
//! is found.

mod library;

use library::{disk, root};
use std::collections::BTreeMap;
use std::path::PathBuf;
use trueaxis_calibrate::identify::errors::{Identification, identify};
use trueaxis_calibrate::identify::records::{Options, read_options, read_records};
use trueaxis_calibrate::identify::selection::parts_by_place;
use trueaxis_calibrate::identify::verdict::Verdict;
use trueaxis_geometry::statistics::SplitMix64;
use trueaxis_input::Diagnostics;
use trueaxis_measure::measure::read_campaign;

const TABLES: [&str; 3] = ["ball-bar.csv", "laser-x.csv", "r-test.csv"];

fn folder() -> PathBuf {
    root().join("examples/05_identify")
}

/// The rows of a table in an order of their own; comments and the heading stay.
fn shuffled(text: &str, random: &mut SplitMix64) -> String {
    let mut lines: Vec<&str> = text.lines().collect();
    let is_heading = |line: &&str| !line.starts_with('#');
    let first = 1 + lines.iter().position(is_heading).expect("a heading");
    for i in (first + 1..lines.len()).rev() {
        lines.swap(i, first + (random.unit() * (i - first + 1) as f64) as usize);
    }
    lines.join("\n") + "\n"
}

/// Ball-bar, R-test and laser together, with these texts in place of tables.
fn found(texts: BTreeMap<PathBuf, String>) -> Identification {
    let files = disk().with_texts(texts);
    let path = folder().join("mixed-instruments.toml");
    let (read, mut problems) = read_campaign(&files, &path, |root, _| Some(read_options(root)));
    let (campaign, options) = read.unwrap_or_else(|| panic!("{problems:?}"));
    let records = read_records(&campaign, &mut problems);
    let records = records.unwrap_or_else(|| panic!("{problems:?}"));
    let options = Options { predicts: false, ..options };
    let found = identify(&campaign, &options, &records, &mut problems);
    found.unwrap_or_else(|| panic!("{problems:?}"))
}

#[test]
fn law_neither_terms_nor_values_nor_verdict_follow_the_order_of_rows() {
    let first = found(BTreeMap::new());
    let mut random = SplitMix64::new(20);
    for _ in 0..3 {
        let table = |name: &str| {
            let text = std::fs::read_to_string(folder().join(name)).expect("a table");
            (folder().join(name), shuffled(&text, &mut random))
        };
        let other = found(TABLES.map(table).into());
        assert_eq!(other.design.names(), first.design.names(), "the terms");
        assert_eq!(other.design.terms.len(), first.design.terms.len());
        let kind = |found: &Identification| std::mem::discriminant::<Verdict>(&found.verdict);
        assert_eq!(kind(&other), kind(&first), "{:?} {:?}", other.verdict, first.verdict);
        for ((name, a), b) in first.design.names().iter().zip(&first.found).zip(&other.found) {
            let (Some((a, u)), Some((b, other_u))) = (a.value, b.value) else {
                assert_eq!(a.value, b.value, "{name}");
                continue;
            };
            // A value of 0 within its uncertainty has no digits of its own.
            let equal = |a: f64, b: f64| (a - b).abs() <= 1e-9 * a.abs().max(u);
            assert!(equal(a, b) && equal(u, other_u), "{name}: {a} ± {u}, {b} ± {other_u}");
        }
    }
}

#[test]
fn law_the_parts_of_places_are_the_same_in_every_order_of_rows() {
    let path = folder().join("mixed-instruments.toml");
    let mut problems = Diagnostics::new();
    let (read, _) = read_campaign(&disk(), &path, |root, _| Some(read_options(root)));
    let campaign = read.expect("a campaign").0;
    let readings = read_records(&campaign, &mut problems).expect("readings").readings;
    let (parts, places) = parts_by_place(&readings, 10);
    let mut backwards = readings.filtered(|_| false);
    (0..readings.len()).rev().for_each(|i| backwards.push(readings.row(i)));
    let (mut other, others) = parts_by_place(&backwards, 10);
    other.reverse();
    assert!(parts == other && places == others);
    // Every part has its share of each instrument.
    for instrument in 0..3 {
        let in_part = |part: usize| {
            let rows = (0..readings.len()).filter(|i| parts[*i] == part);
            rows.filter(|i| readings.instruments[*i] == instrument).count()
        };
        assert!((0..10).all(|part| in_part(part) > 0), "{:?}", [0, 1, 2].map(in_part));
    }
}
