//! Rows that are wrong in the ways of a shop: each is named with its line and its reason, and none makes a result look
//! surer than it is.

mod library;

use std::collections::BTreeMap;
use std::path::PathBuf;
use trueaxis_calibrate::identify::errors::{Identification, identify};
use trueaxis_calibrate::identify::records::{Options, read_options, read_records};
use trueaxis_input::{Diagnostics, Files};
use trueaxis_measure::measure::read_campaign;
use trueaxis_measure::measure::virtual_campaign::{measure, read_virtual};

fn folder() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../examples/05_identify")
}

fn path() -> PathBuf {
    folder().join("rows-in-memory.toml")
}

const CAMPAIGN: &str = r#"
name = "rows"
machine = "../../machines/i5-engraver/machine.toml"
[unknown]
location = ["EX0C", "EY0C", "EY0A", "EZ0A", "EA0C", "EB0C", "EB0A", "EC0A"]
[instrument.probe]
kind = "probe-ball"
ball = "40 0 -5 mm"
noise = "1 um"
reads = "ball"
readings = "rows.csv"
unknown = { ball = "free", socket = "5 um" }
[[path]]
kind = "random"
A = ["-80 deg", "80 deg"]
C = ["-170 deg", "170 deg"]
count = 60
seed = 9
[truth]
errors = { EX0C = "60 um", EY0C = "-45 um", EY0A = "50 um", EZ0A = "-40 um" }
setup = { ball_x = "20 um", ball_y = "-12 um" }
"#;

fn files(campaign: &str, table: &str) -> Files {
    let mut all = BTreeMap::new();
    all.insert(path(), campaign.to_owned());
    all.insert(folder().join("rows.csv"), table.to_owned());
    all.insert(folder().join("stations.csv"), table.to_owned());
    library::disk().with_texts(all)
}

/// The readings of the virtual machine.
fn table() -> String {
    measured(CAMPAIGN, "")
}

/// The same of another campaign, at these stations if its path is a table.
fn measured(campaign: &str, stations: &str) -> String {
    let (read, problems) =
        read_campaign(&files(campaign, stations), &path(), |r, c| read_virtual(r, c, Some(7)));
    let (campaign, real) = read.unwrap_or_else(|| panic!("{problems:?}"));
    let read = measure(&campaign, &real).expect("readings").readings;
    read.table(&campaign.machine, &campaign.instruments[0], 0)
}

fn told(campaign: &str, table: &str) -> (Option<Identification>, Diagnostics) {
    let read = read_campaign(&files(campaign, table), &path(), |root, _| Some(read_options(root)));
    let (Some((campaign, options)), mut problems) = read else { return (None, read.1) };
    let options = Options { predicts: false, ..options };
    let Some(records) = read_records(&campaign, &mut problems) else { return (None, problems) };
    let found = identify(&campaign, &options, &records, &mut problems);
    (found.filter(|_| !problems.has_errors()), problems)
}

/// Every row changed by a function of its number and its cells, by their headings.
fn changed(table: &str, change: impl Fn(usize, &mut BTreeMap<String, f64>)) -> String {
    let mut lines = table.lines();
    let head = lines.next().expect("a head");
    let names: Vec<&str> = head.split(',').collect();
    let mut text = format!("{head}\n");
    for (row, line) in lines.enumerate() {
        let cells = line.split(',').map(|c| c.parse().expect("a number"));
        let mut cells: BTreeMap<String, f64> =
            names.iter().map(|n| (*n).to_owned()).zip(cells).collect();
        change(row, &mut cells);
        let shown: Vec<String> = names.iter().map(|n| cells[*n].to_string()).collect();
        text += &(shown.join(",") + "\n");
    }
    text
}

fn turn(cells: &mut BTreeMap<String, f64>) {
    for name in ["x_um", "y_um", "z_um"] {
        *cells.get_mut(name).expect("a channel") *= -1.0;
    }
}

#[test]
fn the_readings_as_they_are_fit() {
    let (found, problems) = told(CAMPAIGN, &table());
    let found = found.unwrap_or_else(|| panic!("{problems:?}"));
    assert!(found.verdict.is_good(), "{:?}", found.verdict);
    assert!(problems.iter().next().is_none(), "{problems:?}");
}

/// Which rows are turned, by their number and cells.
type Choice = fn(usize, &BTreeMap<String, f64>) -> bool;

#[test]
fn rows_with_the_opposite_sign_are_named() {
    // The first half, every second row, a third of the rows, those beyond a tilt.
    let halves: [Choice; 4] = [
        |row, _| row < 30,
        |row, _| row % 2 == 0,
        |row, _| row % 3 == 1,
        |_, cells| cells["A"] > 20.0,
    ];
    for (n, is_turned) in halves.iter().enumerate() {
        let mut turned = Vec::new();
        let plain = table();
        let cells = std::cell::RefCell::new(&mut turned);
        let mixed = changed(&plain, |row, cells_of_row| {
            if is_turned(row, cells_of_row) {
                turn(cells_of_row);
                cells.borrow_mut().push(row + 2);
            }
        });
        let (found, problems) = told(CAMPAIGN, &mixed);
        assert!(!found.expect("an answer").verdict.is_good(), "{n}");
        let told = problems.iter().find(|d| d.code == "mixed-signs");
        let told = told.unwrap_or_else(|| panic!("{n}: {problems:?}"));
        // The rarer sign is named, of two halves either.
        let others: Vec<usize> = (2..62).filter(|l| !turned.contains(l)).collect();
        let expected = [&turned, &others].into_iter().filter(|rows| rows.len() <= 30);
        let mut first = expected.map(|rows| rows[0]);
        assert!(first.any(|line| line == told.place.line), "{n}: {told:?}");
    }
}

#[test]
fn one_sign_and_single_gross_rows_are_not_mixed_signs() {
    let codes = |table: &str| -> Vec<&'static str> {
        told(CAMPAIGN, table).1.iter().map(|d| d.code).collect()
    };
    assert!(!codes(&changed(&table(), |_, cells| turn(cells))).contains(&"mixed-signs"));
    let gross = changed(&table(), |row, cells| {
        if row == 17 {
            *cells.get_mut("x_um").expect("x") += 300.0;
        }
    });
    let gross = codes(&gross);
    assert!(gross.contains(&"gross-reading") && !gross.contains(&"mixed-signs"), "{gross:?}");
}

#[test]
fn exchanged_columns_are_named() {
    let swapped = table().replacen("x_um,y_um", "y_um,x_um", 1);
    let (found, problems) = told(CAMPAIGN, &swapped);
    let found = found.unwrap_or_else(|| panic!("{problems:?}"));
    assert!(!found.verdict.is_good());
    let better = &found.conventions.as_ref().expect("checked").better;
    assert!(better[0].change.contains("columns in the order y, x, z"), "{better:?}");
    // Of the axes: the poses are off the ball, or outside the travel.
    for (from, to) in [("C,A,", "A,C,"), ("X,Y,Z", "Y,X,Z"), ("X,Y,Z", "Z,Y,X")] {
        assert!(table().contains(from), "{from}");
        let (found, problems) = told(CAMPAIGN, &table().replacen(from, to, 1));
        assert!(found.is_none(), "{to}");
        let error = problems
            .iter()
            .find(|d| d.code == "readings-of-another-machine" || d.code == "pose-off-ball");
        let error = error.unwrap_or_else(|| panic!("{to}: {problems:?}"));
        assert!(error.place.line > 1 && error.place.file.ends_with("rows.csv"), "{error:?}");
    }
}

#[test]
fn readings_of_another_machine_are_named() {
    // An axis that this one has not.
    let foreign = table().replacen("A", "B", 1);
    let (found, problems) = told(CAMPAIGN, &foreign);
    assert!(found.is_none());
    let error = problems.iter().find(|d| d.code == "unknown-axis").expect("an error");
    assert!(error.message.contains("no axis B") && error.place.line == 1, "{error:?}");
    // A larger one: most poses are outside the travel; a single one may be a slip.
    let larger = changed(&table(), |_, cells| *cells.get_mut("X").expect("X") += 1500.0);
    let (found, problems) = told(CAMPAIGN, &larger);
    assert!(found.is_none());
    assert!(
        problems
            .iter()
            .any(|d| d.code == "readings-of-another-machine" && d.message.contains("60 of 60"))
    );
    let one = changed(&table(), |row, cells| {
        if row == 5 {
            *cells.get_mut("A").expect("A") = 136.0;
        }
    });
    let (_, problems) = told(CAMPAIGN, &one);
    let strayed = problems.iter().find(|d| d.code == "outside-travel").expect("a warning");
    assert_eq!(strayed.place.line, 7);
    // The same letters on the other side of the machine: the poses are off the ball.
    let head = CAMPAIGN.replace("i5-engraver", "xkas2525").replace(
        "[\"EX0C\", \"EY0C\", \"EY0A\", \"EZ0A\", \"EA0C\", \"EB0C\", \"EB0A\", \"EC0A\"]",
        "\"minimal\"",
    );
    let (found, problems) = told(&head, &table());
    assert!(found.is_none());
    let error = problems.iter().find(|d| d.code == "readings-of-another-machine");
    assert!(error.is_some_and(|e| e.place.line > 1), "{problems:?}");
}

#[test]
fn time_and_order_that_cannot_be_are_named() {
    let back = changed(&table(), |row, cells| {
        if row == 20 {
            *cells.get_mut("time_s").expect("a time") = 1.0;
        }
    });
    let (found, problems) = told(CAMPAIGN, &back);
    assert!(found.is_some());
    let warning = problems.iter().find(|d| d.code == "time-backwards").expect("a warning");
    assert_eq!(warning.place.line, 22);
    // Readings in the opposite order beside poses in the right one.
    let rows: Vec<BTreeMap<String, f64>> = {
        let all = std::cell::RefCell::new(Vec::new());
        changed(&table(), |_, cells| all.borrow_mut().push(cells.clone()));
        all.into_inner()
    };
    let turned = changed(&table(), |row, cells| {
        for name in ["x_um", "y_um", "z_um"] {
            cells.insert(name.to_owned(), rows[rows.len() - 1 - row][name]);
        }
    });
    let (found, _) = told(CAMPAIGN, &turned);
    let found = found.expect("an answer");
    assert!(!found.verdict.is_good());
    let better = &found.conventions.as_ref().expect("checked").better;
    assert!(better.iter().any(|c| c.change.contains("opposite order")), "{better:?}");
}

#[test]
fn an_empty_table_is_named() {
    let head = table().lines().next().expect("a head").to_owned() + "\n";
    let (found, problems) = told(CAMPAIGN, &head);
    assert!(found.is_none());
    let error = problems.iter().find(|d| d.place.file.ends_with("rows.csv")).expect("an error");
    assert!(["no-rows", "empty-table"].contains(&error.code), "{error:?}");
}

/// All rows twice and four times, in blocks and one after the other: the same values, the same U, and every copy is named.
#[test]
fn copies_make_nothing_surer() {
    let plain = table();
    let (once, _) = told(CAMPAIGN, &plain);
    let values = |found: &Identification| -> Vec<_> {
        found.found.iter().map(|f| (f.name.clone(), f.value)).collect()
    };
    let once = values(&once.expect("an answer"));
    let (head, rows) = plain.split_once('\n').expect("a head");
    let each: String = rows.lines().map(|l| format!("{l}\n{l}\n")).collect();
    let copies = [
        (format!("{head}\n{rows}{rows}"), 60, 62),
        (format!("{head}\n{rows}{rows}{rows}{rows}"), 180, 62),
        (format!("{head}\n{each}"), 60, 3),
    ];
    for (text, count, line) in &copies {
        let (found, problems) = told(CAMPAIGN, text);
        assert_eq!(values(&found.expect("an answer")), once);
        let told: Vec<_> = problems.iter().filter(|d| d.code == "copied-rows").collect();
        assert_eq!(told[0].place.line, *line);
        assert!(told[3].message.contains(&format!("{count} of")), "{}", told[3].message);
    }
    // Positions that differ by less than a control states make no other row of it.
    let first = head.split(',').next().expect("a column").to_owned();
    let near = changed(&plain, |_, cells| *cells.get_mut(&first).expect("an axis") += 1e-9);
    let near = format!("{plain}{}", near.split_once('\n').expect("a head").1);
    let (found, problems) = told(CAMPAIGN, &near);
    assert_eq!(values(&found.expect("an answer")), once);
    assert!(problems.iter().any(|d| d.code == "copied-rows"), "{first}");
    // Without times and groups a copy is a copy all the same.
    let bare = |text: &str| -> String {
        // The last two columns.
        let cut = |line: &str| line.rsplitn(3, ',').nth(2).expect("columns").to_owned() + "\n";
        text.lines().map(cut).collect()
    };
    let (found_once, _) = told(CAMPAIGN, &bare(&plain));
    let (twice, problems) = told(CAMPAIGN, &bare(&copies[0].0));
    assert_eq!(values(&twice.expect("an answer")), values(&found_once.expect("an answer")));
    assert!(problems.iter().any(|d| d.code == "copied-rows"));
    // What says that it was read again counts.
    let later = changed(&plain, |_, cells| *cells.get_mut("time_s").expect("a time") += 5000.0);
    let again = format!("{plain}{}", later.split_once('\n').expect("a head").1);
    let (found, problems) = told(CAMPAIGN, &again);
    assert!(!problems.iter().any(|d| d.code == "copied-rows"));
    let again = values(&found.expect("an answer"));
    let u = |(_, value): &(String, Option<(f64, f64)>)| value.map_or(f64::NAN, |v| v.1);
    let ratios: Vec<f64> = again.iter().zip(&once).map(|(a, b)| u(a) / u(b)).collect();
    assert!(ratios.iter().any(|r| *r < 0.75), "{ratios:?}");
}

/// One table turns, the head stands: its roll turns the probe about its own axis.
const ONE_AXIS: &str = r#"
name = "one axis"
machine = "../../machines/head-table/machine.toml"
[unknown]
location = "minimal"
[instrument.probe]
kind = "probe-ball"
socket = "0 0 -110 mm"
ball = "150 60 40 mm"
noise = "1 um"
reads = "ball"
readings = "rows.csv"
[[path]]
PATH
[truth]
errors = { EX0C = "14 um", EA0C = "23 urad", EB0C = "-19 urad", EC0Y = "20 urad", EA0Z = "-9 urad", EC0B = "-15 urad" }
setup = { ball_x = "35 um", ball_y = "-22 um", ball_z = "14 um" }
"#;

/// Stations as controls log them are a little off the ball, so that the readings follow every error by as much: what they see
/// well is the same whatever was rounded, and what only the rounding sees is not observable (docs/model.md eq. 347).
#[test]
fn law_rounded_stations_find_the_same() {
    let path = "kind = \"C\"\nfrom = \"-170 deg\"\nto = \"170 deg\"\ncount = 24";
    let exact = measured(&ONE_AXIS.replace("PATH", path), "");
    let campaign = ONE_AXIS.replace("PATH", "kind = \"table\"\ntable = \"stations.csv\"");
    let axes = ["X", "Y", "Z", "B", "C"];
    for decimals in [2, 3, 4, 5, 6, 9] {
        let scale = 10_f64.powi(decimals);
        let rounded = changed(&exact, |_, cells| {
            for (name, value) in cells.iter_mut() {
                let is_axis = axes.contains(&name.as_str());
                *value = if is_axis { (*value * scale).round() / scale } else { *value };
            }
        });
        let kept: Vec<usize> = rounded
            .lines()
            .next()
            .expect("a head")
            .split(',')
            .enumerate()
            .filter(|(_, h)| axes.contains(h))
            .map(|(k, _)| k)
            .collect();
        let stations: String = rounded
            .lines()
            .map(|l| {
                let cells: Vec<&str> = l.split(',').collect();
                kept.iter().map(|k| cells[*k]).collect::<Vec<_>>().join(",") + "\n"
            })
            .collect();
        let (found, problems) = told(&campaign, &measured(&campaign, &stations));
        let found = found.unwrap_or_else(|| panic!("{decimals}: {problems:?}"));
        let value = |name: &str| found.found.iter().find(|f| f.name == name).and_then(|f| f.value);
        for (name, truth) in [
            ("probe.ball_x", 35e-3),
            ("probe.ball_y", -22e-3),
            ("EC0Y", 20e-6),
            ("EA0C", 23e-6),
            ("EB0C", -19e-6),
        ] {
            let (is, u) = value(name).unwrap_or_else(|| panic!("{decimals} {name}"));
            assert!((is - truth).abs() < 4.0 * u, "{decimals} decimals: {name} {is} ± {u}");
        }
        assert_eq!(value("EC0B"), None, "{decimals}");
    }
}
