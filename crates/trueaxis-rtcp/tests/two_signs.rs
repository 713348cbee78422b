//! One machine, one file of readings, each way in which it can be written: the same error with the same sign by `identify`
//! and by `identify rtcp`, and a warning with both meanings where the file does not say which way it counts.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use trueaxis_calibrate::identify::convention::check_conventions;
use trueaxis_calibrate::identify::errors::identify;
use trueaxis_calibrate::identify::records::{Options, read_options, read_records};
use trueaxis_input::{Diagnostics, Files, Source};
use trueaxis_measure::measure::virtual_campaign::{measure, read_virtual};
use trueaxis_measure::measure::{Kind, read_campaign};
use trueaxis_rtcp::rtcp::{Purpose, calibrate, read_rtcp};

struct Disk;

impl Source for Disk {
    fn read(&self, path: &Path) -> std::io::Result<Vec<u8>> {
        std::fs::read(path)
    }

    fn is_file(&self, path: &Path) -> bool {
        path.is_file()
    }
}

fn folder() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../examples/05_identify")
}

fn path() -> PathBuf {
    folder().join("signs-in-memory.toml")
}

fn files(text: &str, table: &str) -> Files {
    let mut all = BTreeMap::new();
    all.insert(path(), text.to_owned());
    all.insert(folder().join("signs.csv"), table.to_owned());
    Files::new(Disk).with_texts(all)
}

/// An instrument whose numbers have a sign, the error that it shows, and the rest of its campaign.
struct Case {
    kind: Kind,
    error: &'static str,
    location: &'static str,
    section: &'static str,
    path: &'static str,
}

const CENTRES: &str = r#"["EX0C", "EY0C", "EY0A", "EZ0A"]"#;
const BALL: &str = "ball = \"40 0 -5 mm\"\nunknown = { ball = \"free\", TOOL = \"0.01 um\" }\n";
const TURNS: &str = "kind = \"random\"\nA = [\"-80 deg\", \"80 deg\"]\nC = [\"-170 deg\", \"170 deg\"]\ncount = 40\nseed = 3\n";
const ALONG_Y: &str = "kind = \"grid\"\nY = [\"-90 mm\", \"90 mm\", 13]\n";

const fn of_centres(kind: Kind) -> Case {
    Case { kind, error: "EX0C", location: CENTRES, section: BALL, path: TURNS }
}

const fn of_squareness(kind: Kind, section: &'static str) -> Case {
    Case { kind, error: "EC0Y", location: "[\"EC0Y\"]", section, path: ALONG_Y }
}

const CASES: [Case; 6] = [
    of_centres(Kind::ProbeBall),
    of_centres(Kind::BallCentre),
    of_squareness(Kind::LaserLine, "direction = \"1 0 0\"\n"),
    of_squareness(Kind::LaserAngle, "direction = \"0 0 1\"\nunknown = { zero = \"0.1 urad\" }\n"),
    of_squareness(Kind::Artefact, "direction = \"1 0 0\"\nunknown = { zero = \"free\" }\n"),
    of_squareness(Kind::CutPiece, "unknown = { datum = \"free\" }\n"),
];

fn campaign(case: &Case, reads: Option<&str>) -> String {
    let noise = if case.kind == Kind::LaserAngle { "0.2 urad" } else { "0.2 um" };
    let section = case.section.replace("TOOL", case.kind.tool_point());
    // Nothing else is off: what is not listed would be another question.
    let errors = match case.error {
        "EX0C" => "EX0C = \"115.5 um\", EY0A = \"60 um\"",
        _ => "EC0Y = \"700 urad\"",
    };
    let reads = reads.map_or(String::new(), |word| format!("reads = \"{word}\"\n"));
    format!(
        "name = \"signs\"\nmachine = \"../../machines/i5-engraver/machine.toml\"\n[unknown]\nlocation = {}\n\
         [instrument.it]\nkind = \"{}\"\nnoise = \"{noise}\"\n{section}{reads}readings = \"signs.csv\"\n[[path]]\n{}\
         [truth]\nerrors = {{ {errors} }}\n",
        case.location,
        case.kind.name(),
        case.path
    )
}

/// The readings, written as the campaign says that they count.
fn table(text: &str) -> String {
    let (read, problems) =
        read_campaign(&files(text, ""), &path(), |r, c| read_virtual(r, c, Some(2)));
    let (campaign, real) = read.unwrap_or_else(|| panic!("{problems:?}"));
    let read = measure(&campaign, &real).expect("readings").readings;
    read.table(&campaign.machine, &campaign.instruments[0], 0)
}

/// The value of an error by `identify`, and what was said.
fn by_identify(text: &str, table: &str, error: &str) -> ((f64, f64), Diagnostics) {
    let read = read_campaign(&files(text, table), &path(), |root, _| Some(read_options(root)));
    let (Some((campaign, options)), mut problems) = read else { panic!("{:?}", read.1) };
    let options = Options { predicts: false, ..options };
    let records = read_records(&campaign, &mut problems).unwrap_or_else(|| panic!("{problems:?}"));
    let found = identify(&campaign, &options, &records, &mut problems);
    let found = found.unwrap_or_else(|| panic!("{problems:?}"));
    // The check of conventions looks at the sign, too.
    let check = check_conventions(&campaign.design(), &records.readings);
    assert!(check.remarks.iter().any(|r| r.contains("sign of all channels")), "{check:?}");
    let of = found.found.iter().find(|f| f.name == error).and_then(|f| f.value);
    (of.unwrap_or_else(|| panic!("{error} is not stated: {problems:?}")), problems)
}

const RTCP: &str = "name = \"signs\"\nmachine = \"../../machines/i5-engraver/machine.toml\"\n\
                    [readings.it]\nball = \"40 0 -5 mm\"\nnoise = \"0.2 um\"\ntable = \"signs.csv\"\n";

/// The value of an offset by `identify rtcp`, and what was said.
fn by_rtcp(text: &str, table: &str, error: &str) -> ((f64, f64), Diagnostics) {
    let (study, problems) = read_rtcp(&files(text, table), &path(), Purpose::Result);
    let study = study.unwrap_or_else(|| panic!("{problems:?}"));
    let found = calibrate(&study).expect("a fit");
    let of = found.offsets.iter().find(|o| o.name == error).and_then(|o| o.found_mm);
    (of.unwrap_or_else(|| panic!("{error}: {:?}", found.offsets)), problems)
}

#[test]
fn every_instrument_has_one_sign_whichever_way_it_counts() {
    for case in &CASES {
        let truth = if case.error == "EX0C" { 115.5e-3 } else { 700e-6 };
        let is_true = |v: f64| (v - truth).abs() < 0.02 * truth;
        let mut tables = Vec::new();
        for word in case.kind.words_of_reads() {
            let text = campaign(case, Some(word));
            let table = table(&text);
            let ((value, u), problems) = by_identify(&text, &table, case.error);
            assert!(is_true(value), "{} {word}: {value:e} ± {u:e}", case.kind.name());
            assert!(!problems.iter().any(|d| d.code == "reads-not-stated"), "{problems:?}");
            tables.push(table);
        }
        assert_ne!(tables[0], tables[1], "{}: the words say nothing", case.kind.name());
        // The wrong word turns the sign.
        let [defined, _] = case.kind.words_of_reads();
        let ((wrong, _), _) = by_identify(&campaign(case, Some(defined)), &tables[1], case.error);
        assert!(wrong < -0.3 * truth, "{}: {wrong:e}", case.kind.name());
        // Nothing stated: the default, and a warning with both meanings.
        let ((value, _), problems) = by_identify(&campaign(case, None), &tables[0], case.error);
        assert!(is_true(value), "{value:e}");
        let warning = problems.iter().find(|d| d.code == "reads-not-stated");
        let warning = warning.unwrap_or_else(|| panic!("{}: {problems:?}", case.kind.name()));
        let said = format!("{} {}", warning.message, warning.hint);
        for word in case.kind.words_of_reads() {
            assert!(said.contains(&format!("\"{word}\"")), "{said}");
        }
    }
}

/// Instruments that are not in the list have numbers without a sign: a new one must be put here or there.
#[test]
fn the_other_instruments_read_no_sign() {
    let others: Vec<Kind> = Kind::all().filter(|k| CASES.iter().all(|c| c.kind != *k)).collect();
    let elements = |kind: &Kind| matches!(kind, Kind::Points(_));
    let (points, others): (Vec<Kind>, Vec<Kind>) = others.into_iter().partition(elements);
    let unsigned = [Kind::BallBar, Kind::TouchProbeBall, Kind::TouchProbeFace, Kind::LengthTracker];
    assert_eq!((points.len(), &others[..]), (5, &unsigned[..]));
}

/// The same file: a probe-ball with the axes as they were commanded, RTCP off.
#[test]
fn both_commands_find_the_same_error_in_one_file() {
    let case = &CASES[0];
    let rtcp = |reads: &str| format!("{RTCP}rtcp = false\nindicator = \"spindle\"\n{reads}");
    let mut values = Vec::new();
    for word in ["ball", "tool"] {
        let text = campaign(case, Some(word));
        let table = table(&text);
        let ((a, u), _) = by_identify(&text, &table, "EX0C");
        let reads = format!("reads = \"{word}\"\n");
        let ((b, v), problems) = by_rtcp(&rtcp(&reads), &table, "EX0C");
        assert!((a - 115.5e-3).abs() < 1e-3, "{a} ± {u}");
        assert!((b - 115.5e-3).abs() < 1e-3, "{b} ± {v}");
        assert!(!problems.iter().any(|d| d.code == "reads-not-stated"));
        values.push((a, b, table));
    }
    assert!((values[0].0 - values[1].0).abs() < 1e-4 && (values[0].1 - values[1].1).abs() < 1e-4);
    // Not stated: each command has its own default, and says so with the other meaning.
    let (_, problems) = by_rtcp(&rtcp(""), &values[1].2, "EX0C");
    let warning = problems.iter().find(|d| d.code == "reads-not-stated").expect("a warning");
    let said = format!("{} {}", warning.message, warning.hint);
    assert!(said.contains("\"tool\"") && said.contains("\"ball\""), "{said}");
}

/// The same readings of `ball-centre` for `identify rtcp`: less the ball, along the axes of the table, with RTCP on.
#[test]
fn centres_of_a_ball_have_one_sign_in_both_commands() {
    for word in ["ball", "tool"] {
        let text = campaign(&CASES[1], Some(word));
        let table = table(&text);
        let ((a, _), _) = by_identify(&text, &table, "EX0C");
        let mut lines = table.lines();
        let names: Vec<&str> = lines.next().expect("a head").split(',').collect();
        let mut other = names.join(",").replace("_mm", "_um") + "\n";
        for line in lines {
            let cells = line.split(',').zip(&names).map(|(cell, name)| {
                let value: f64 = cell.parse().expect("a number");
                let ball = [("x_mm", 40.0), ("y_mm", 0.0), ("z_mm", -5.0)];
                let of = ball.iter().find(|(n, _)| n == name);
                of.map_or(value, |(_, b)| (value - b) * 1e3).to_string()
            });
            other += &(cells.collect::<Vec<_>>().join(",") + "\n");
        }
        let study = format!("{RTCP}rtcp = true\nindicator = \"table\"\nreads = \"{word}\"\n");
        let ((b, _), _) = by_rtcp(&study, &other, "EX0C");
        assert!((a - 115.5e-3).abs() < 1e-3 && (b - 115.5e-3).abs() < 1e-3, "{word}: {a} {b}");
    }
}

/// Rows that were copied count once in `identify rtcp`, too.
#[test]
fn copied_rows_make_no_offset_surer() {
    let text = campaign(&CASES[0], Some("ball"));
    let table = table(&text);
    let rows = table.split_once('\n').expect("a head").1;
    let study = format!("{RTCP}rtcp = false\nindicator = \"spindle\"\nreads = \"ball\"\n");
    let (once, _) = by_rtcp(&study, &table, "EX0C");
    for copies in [rows.to_owned(), rows.repeat(3)] {
        let (again, problems) = by_rtcp(&study, &format!("{table}{copies}"), "EX0C");
        assert_eq!(again, once);
        let told = problems.iter().find(|d| d.code == "copied-rows").expect("named");
        assert_eq!(told.place.line, 42);
    }
}
