//! What `simulate` and `trace` write and how they end.

mod command;

use command::{Folder, Ran, root, trueaxis};
use serde_json::Value;

const I5: &str = "machines/i5-engraver/machine.toml";
const MILL: &str = "machines/three-axis-mill/machine.toml";
const RING: &str = "examples/02_simulate/ring-fanuc.nc";

/// Within the mill's X ±300, Y ±200, Z −400 … 0.
const GOOD: &str = "G21 G17 G90 G94\nG0 X0 Y0 Z-10\nG1 X50 F600\nG3 X50 Y0 I-50 J0\nM30\n";
/// X 400 is beyond.
const FAR: &str = "G21 G17 G90 G94\nG0 X0 Y0 Z-10\nG1 X400 F600\nG1 X0\nM30\n";
/// An unbalanced bracket in line 3.
const BROKEN: &str = "G21 G17 G90 G94\nG0 X0 Y0 Z-10\nG1 X[5 F600\nM30\n";

fn keys(value: &Value) -> Vec<&str> {
    value.as_object().expect("an object").keys().map(String::as_str).collect()
}

fn run(arguments: &[&str], more: &[&str]) -> Ran {
    trueaxis(&[arguments, more].concat())
}

/// One file: nothing is fetched, nothing runs. A name space is no reference.
#[track_caller]
fn stands_alone(page: &str) {
    assert!(page.starts_with("<!DOCTYPE html>") && page.ends_with("</html>"), "not whole");
    let bare = page.replace("http://www.w3.org/2000/svg", "");
    for outside in ["http", "src=", "<script", "<link", "@import", "url(", "href="] {
        let inside = bare.replace("url(#", "");
        assert!(!inside.contains(outside), "the page holds {outside}");
    }
    assert!(!page.contains("NaN") && !page.contains("inf"), "a number that is none");
}

#[test]
fn the_report_is_one_whole_file() {
    let folder = Folder::new("simulate-report");
    let page = folder.path("simulation.html");
    let ran = run(&["simulate", I5, RING, "--report", &page], &[]);
    assert_eq!(ran.status, 0, "{}", ran.err);
    assert!(ran.err.ends_with(&format!("report: {page}\n")), "{}", ran.err);
    assert_eq!(folder.names(), ["simulation.html"]);
    let html = std::fs::read_to_string(&page).expect("a report");
    stands_alone(&html);
    assert!(html.len() < 3 << 20, "{} bytes", html.len());
    for words in [
        "ring-fanuc.nc on i5 engraving centre",
        "Path of the tool tip in the workpiece",
        "deviation of the tip, µm",
        "speed of X, mm/s",
        "A, deg",
        "time, s",
        "Issues",
        "Zhang Jian et al. 2023",
        env!("CARGO_PKG_VERSION"),
    ] {
        assert!(html.contains(words), "{words}");
    }
    // Three views and the oblique one; two axes to a picture.
    assert_eq!(html.matches("<clipPath").count(), 4);
    assert_eq!(html.matches("<svg").count(), 1 + 1 + 3);

    // Over a report a report may be written; the same run, the same page.
    let again = run(&["simulate", I5, RING, "--report", &page, "--format", "json"], &[]);
    assert_eq!(again.status, 0, "{}", again.err);
    assert_eq!(again.json()["schema"], "trueaxis/simulate/1");
    assert_eq!(std::fs::read_to_string(&page).expect("a report"), html);
}

#[test]
fn what_a_program_says_cannot_break_the_page() {
    let folder = Folder::new("simulate-escape");
    let (page, name) = (folder.path("p.html"), "<script>alert(1)<&.ngc");
    let text = "G21 G90 G94\n(MSG, <script src=http:x>)\nG0 X0 Y0 Z-10\nG1 X5 F600\nM2\n";
    let program = folder.file(name, text);
    let ran = run(&["simulate", MILL, &program, "--report", &page], &[]);
    assert_eq!(ran.status, 0, "{}", ran.err);
    let html = std::fs::read_to_string(&page).expect("a report");
    assert!(html.contains("&lt;script&gt;alert(1)") && !html.contains("<script"));
}

#[test]
fn exit_status_says_whether_part_or_machine_are_in_danger() {
    let folder = Folder::new("simulate-status");
    for (name, text, status, verdict) in [
        ("good.nc", GOOD, 0, None),
        ("far.nc", FAR, 1, Some("NO SET-UP")),
        ("broken.nc", BROKEN, 2, None),
    ] {
        let (program, page) = (folder.file(name, text), folder.path(&format!("{name}.html")));
        let ran = run(&["simulate", MILL, &program, "--report", &page], &[]);
        assert_eq!(ran.status, status, "{name}: {}", ran.err);
        assert_eq!(std::fs::metadata(&page).is_ok(), status != 2, "{name}");
        if let Some(verdict) = verdict {
            let html = std::fs::read_to_string(&page).expect("a report");
            assert!(html.contains(verdict) && html.contains("over-travel: X goes to 400.000 mm"));
            let ran = run(&["simulate", MILL, &program, "--no-report", "--format", "json"], &[]);
            let issue = &ran.json()["troubles"][0];
            assert_eq!(ran.status, 1);
            assert_eq!((&issue["code"], &issue["axis"]), (&"over-travel".into(), &"X".into()));
            assert_eq!((&issue["grave"], &issue["line"]), (&true.into(), &3.into()));
            assert_eq!((&issue["value"], &issue["limit"]), (&400.0.into(), &300.0.into()));
        }
    }
}

#[test]
fn nothing_is_left_behind_after_an_error() {
    let folder = Folder::new("simulate-error");
    let program = folder.file("broken.nc", BROKEN);
    let (page, path) = (folder.path("p.html"), folder.path("p.csv"));
    let all = ["simulate", MILL, &program, "--report", &page, "--path", &path];
    let ran = run(&all, &[]);
    assert_eq!((ran.status, ran.out.as_str()), (2, ""), "{}", ran.err);
    assert!(ran.err.contains("broken.nc:3:"), "{}", ran.err);
    assert!(ran.err.ends_with("1 error found; nothing was written\n"), "{}", ran.err);
    assert_eq!(folder.names(), ["broken.nc"]);
    // Older results stay as they are.
    let old = [(&page, "<!doctype html>old"), (&path, "time_s,program,line,tool,rapid\n1\n")];
    old.iter().for_each(|(file, text)| std::fs::write(file, text).expect("a file"));
    assert_eq!(run(&all, &[]).status, 2);
    for (file, text) in old {
        assert_eq!(std::fs::read_to_string(file).expect("a file"), text);
    }
    // What follows the error is shown on request, with the note that it is not complete.
    let ran = run(&all, &["--keep-going"]);
    assert!(ran.status == 2 && ran.err.contains("nothing was written"), "{}", ran.err);
    let ran = run(&all, &["--keep-going", "--force"]);
    assert_eq!(ran.status, 2);
    assert!(
        ran.err.contains("1 error found; the simulation continued after them\n"),
        "{}",
        ran.err
    );
    let html = std::fs::read_to_string(&page).expect("a report");
    assert!(html.contains("NOT COMPLETE"));
    assert_eq!(folder.names(), ["broken.nc", "p.csv", "p.html"]);
}

#[test]
fn files_that_are_no_results_are_not_overwritten() {
    let folder = Folder::new("simulate-places");
    let program = folder.file("good.nc", GOOD);
    let (missing, both) = (folder.path("none/p.html"), folder.path("both.html"));
    let cases = [
        ("--report", program.as_str(), "unknown-report-form"),
        ("--path", program.as_str(), "unwritable-file"),
        ("--path", MILL, "unwritable-file"),
        ("--report", missing.as_str(), "unwritable-file"),
        ("--report", "/dev/null", "unknown-report-form"),
    ];
    for (argument, place, code) in cases {
        let mut arguments = vec!["simulate", MILL, &program, argument, place];
        if argument == "--path" {
            arguments.push("--no-report");
        }
        let ran = run(&arguments, &[]);
        assert_eq!((ran.status, ran.out.as_str()), (2, ""), "{arguments:?}: {}", ran.err);
        assert!(ran.err.starts_with(&format!("error[{code}]")), "{}", ran.err);
    }
    let ran = run(&["simulate", MILL, &program, "--report", &both, "--path", &both], &[]);
    assert!(ran.status == 2 && ran.err.starts_with("error[one-file-twice]"), "{}", ran.err);
    assert_eq!(folder.names(), ["good.nc"]);
    assert_eq!(std::fs::read_to_string(&program).expect("the program"), GOOD);
    assert!(std::fs::read_to_string(root().join(MILL)).expect("the mill").contains("[machine]"));
}

#[cfg(not(feature = "parquet"))]
#[test]
fn without_the_feature_parquet_says_how_to_get_it() {
    let folder = Folder::new("simulate-no-parquet");
    let path = folder.path("p.parquet");
    let ran = run(&["simulate", I5, RING, "--no-report", "--path", &path], &[]);
    assert_eq!(ran.status, 2);
    assert!(ran.err.starts_with("error[parquet-not-built]"), "{}", ran.err);
    assert!(ran.err.contains("--features parquet"), "{}", ran.err);
    assert!(folder.names().is_empty());
}

#[cfg(feature = "parquet")]
#[test]
fn with_the_feature_a_parquet_file_is_whole() {
    let folder = Folder::new("simulate-parquet");
    let path = folder.path("p.parquet");
    let ran = run(&["simulate", I5, RING, "--no-report", "--path", &path], &[]);
    assert_eq!(ran.status, 0, "{}", ran.err);
    let bytes = std::fs::read(&path).expect("a file");
    assert!(bytes.starts_with(b"PAR1") && bytes.ends_with(b"PAR1"));
    assert_eq!(folder.names(), ["p.parquet"]);
    assert_eq!(run(&["simulate", I5, RING, "--no-report", "--path", &path], &[]).status, 0);
}

#[test]
fn the_table_has_every_place_with_units() {
    let folder = Folder::new("simulate-table");
    let path = folder.path("p.csv");
    let ran = run(&["simulate", I5, RING, "--no-report", "--path", &path, "--format", "json"], &[]);
    let document = ran.json();
    let table = std::fs::read_to_string(&path).expect("a table");
    let mut lines = table.lines();
    assert_eq!(
        lines.next(),
        Some(
            "time_s,program,line,tool,rapid,speed_mm_per_min,C_deg,A_deg,X_mm,Y_mm,Z_mm,\
             tip_x_mm,tip_y_mm,tip_z_mm,axis_i,axis_j,axis_k,dev_x_um,dev_y_um,dev_z_um,\
             dev_i_urad,dev_j_urad,dev_k_urad,dev_feed_um,dev_normal_um,dev_binormal_um"
        )
    );
    let rows: Vec<Vec<f64>> =
        lines.map(|l| l.split(',').map(|w| w.parse().expect("a number")).collect()).collect();
    assert_eq!(rows.len() as u64, document["nodes"].as_u64().expect("a count"));
    assert!(rows.iter().all(|r| r.len() == 26 && r.iter().all(|v| v.is_finite())));
    assert!(rows.windows(2).all(|w| w[0][0] <= w[1][0]), "time is monotone");
    assert_eq!(rows[rows.len() - 1][0], document["time_s"].as_f64().expect("a time"));
    for row in &rows {
        // Feed, normal and binormal are three directions at right angles.
        let length = |at: usize| row[at..at + 3].iter().map(|v| v * v).sum::<f64>().sqrt();
        assert!((length(17) - length(23)).abs() < 1e-6 && (length(14) - 1.0).abs() < 1e-12);
    }
    // The greatest deviation with feed is the one that the document states.
    let with_feed = rows.iter().filter(|r| r[4] == 0.0);
    let most = with_feed.map(|r| r[17].hypot(r[18]).hypot(r[19])).fold(0.0, f64::max);
    let stated = document["deviation"]["tip_um"]["value"].as_f64().expect("a number");
    assert!((most - stated).abs() < 1e-9, "{most} and {stated}");
}

#[test]
fn the_documents_have_their_keys() {
    let ran = run(&["simulate", I5, RING, "--no-report", "--format", "json"], &[]);
    assert_eq!(ran.status, 0, "{}", ran.err);
    let document = ran.json();
    let wanted = [
        "schema",
        "version",
        "machine",
        "program",
        "programs",
        "control",
        "set_up_given",
        "time_s",
        "rapid_s",
        "dwell_s",
        "feed_mm",
        "rapid_mm",
        "moves",
        "nodes",
        "tip_box_mm",
        "axes",
        "deviation",
        "troubles",
        "troubles_found",
        "messages",
        "stops",
        "tools",
        "path_file",
    ];
    let missing: Vec<_> = wanted.iter().filter(|k| document.get(k).is_none()).collect();
    assert!(missing.is_empty(), "{missing:?} of {:?}", keys(&document));
    assert_eq!(document["schema"], "trueaxis/simulate/1");
    assert_eq!(keys(&document["axes"]), ["C", "A", "X", "Y", "Z"]);
    assert_eq!(document["axes"]["A"]["unit"], "deg");

    let ran = run(&["trace", I5, RING, "--block", "100", "--format", "json"], &[]);
    assert_eq!(ran.status, 0, "{}", ran.err);
    let document = ran.json();
    let wanted = [
        "schema",
        "machine",
        "program",
        "block",
        "line",
        "text",
        "executions",
        "programmed",
        "nodes",
        "axes",
        "nominal",
        "actual",
        "deviation",
        "time",
        "budget",
        "bodies",
    ];
    let missing: Vec<_> = wanted.iter().filter(|k| document.get(k).is_none()).collect();
    assert!(missing.is_empty(), "{missing:?} of {:?}", keys(&document));
    assert_eq!(document["schema"], "trueaxis/trace/1");
    assert!(document["text"].as_str().is_some_and(|t| t.starts_with("N100 G1 X29.8231")));
    // A block that is not there.
    let ran = run(&["trace", I5, RING, "--block", "99999"], &[]);
    assert_eq!((ran.status, ran.out.as_str()), (2, ""), "{}", ran.err);
}

/// Where the tip is after a line, by the table of `--path`.
fn tip_after(path: &str, line: &str) -> [f64; 3] {
    let text = std::fs::read_to_string(path).expect("the table");
    let mut lines = text.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let names = lines.next().expect("a head");
    let column = |name: &str| names.iter().position(|n| *n == name).expect("a column");
    let rows: Vec<_> = lines.collect();
    let last = rows.iter().rfind(|row| row[column("line")] == line).expect("a row of the line");
    ["tip_x_mm", "tip_y_mm", "tip_z_mm"].map(|name| last[column(name)].parse().expect("a number"))
}

/// The places that `examples/02_simulate/README.md` works out by hand: (20, 10, 0), tilted by 30° about Y.
#[test]
fn increments_count_from_where_the_tool_is() {
    let folder = Folder::new("increments");
    let path = folder.path("places.csv");
    let program = "examples/02_simulate/incremental.h";
    let machine = "machines/head-table/machine.toml";
    let words = ["simulate", machine, program, "--no-report", "--path", &path, "--format", "json"];
    let document = trueaxis(&words).json();
    assert_eq!(document["diagnostics"][0]["code"], "unknown-tool-length");
    assert_eq!(document["motion_left_out"], 0);
    let tip_after = |line: &str| tip_after(&path, line);
    let (sin, cos) = 30.0_f64.to_radians().sin_cos();
    let expected = [
        ("11", [20.0 + 5.0 * sin, 10.0, 5.0 * cos]),
        ("12", [20.0 - 3.0 * sin, 10.0, -3.0 * cos]),
        ("14", [20.0 + 5.0 * sin + 12.0 * cos, 10.0, 5.0 * cos - 12.0 * sin]),
        ("20", [20.0 + 45.0 * sin + 12.0 * cos, 10.0, 45.0 * cos - 12.0 * sin + 5.0]),
    ];
    for (line, place) in expected {
        let tip = tip_after(line);
        let off = tip.iter().zip(place).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(off < 1e-6, "line {line}: {tip:?}, by hand {place:?}");
    }
}

/// The places that `docs/radius-compensation.md` works out by hand.
#[test]
fn radius_compensation_goes_round_the_square() {
    let folder = Folder::new("square");
    let path = folder.path("places.csv");
    let program = "examples/02_simulate/square-g41.nc";
    let words = ["simulate", "machines/three-axis-mill/machine.toml", program];
    let ran =
        trueaxis(&[&words[..], &["--no-report", "--path", &path, "--format", "json"]].concat());
    assert_eq!(ran.status, 0, "{}", ran.err);
    assert_eq!(ran.json()["motion_left_out"], 0);
    for (line, x, y) in [
        ("8", -3.0, 0.0),
        ("9", -3.0, 23.0),
        ("10", 23.0, 23.0),
        ("11", 23.0, -3.0),
        ("12", 13.0, -3.0),
        ("13", 13.0, -20.0),
        ("14", 0.0, -20.0),
    ] {
        let tip = tip_after(&path, line);
        assert!((tip[0] - x).hypot(tip[1] - y) < 1e-9, "line {line}: {tip:?}");
    }
}

/// Codes of spindle and magazine, with their lines, that a program for the engraver comes to; its exit status.
fn asked_of_the_engraver(control: &str, program: &str) -> (i32, Vec<(String, u64)>) {
    let folder = Folder::new(&format!("equipment-{control}"));
    let path = folder.path("program.nc");
    std::fs::write(&path, program).expect("a file");
    let machine = "machines/i5-engraver/machine.toml";
    let words =
        ["simulate", machine, &path, "--control", control, "--no-report", "--format", "json"];
    let ran = trueaxis(&words);
    let document = ran.json();
    let of_equipment =
        |code: &str| ["spindle-speed", "no-magazine-place", "magazine-full"].contains(&code);
    let list = document["diagnostics"].as_array().expect("a list").iter();
    let found: Vec<(String, u64)> = list
        .filter(|d| of_equipment(d["code"].as_str().expect("a code")))
        .map(|d| (d["code"].as_str().unwrap().to_owned(), d["line"].as_u64().expect("a line")))
        .collect();
    assert_eq!(document["beyond_equipment"].as_u64(), Some(found.len() as u64));
    (ran.status, found)
}

/// The spindle of the paper's machine turns with 40,000 1/min at most, its magazine has 12 places.
#[test]
fn speeds_and_tools_that_the_machine_does_not_have_are_reported() {
    let told = |codes: &[(&str, u64)]| -> Vec<(String, u64)> {
        codes.iter().map(|(code, line)| ((*code).to_owned(), *line)).collect()
    };
    let sound = "G21 G90 G94\nT12 M6\nS40000 M3\nG1 X1 F100\nM5 S0\nM30\n";
    assert_eq!(asked_of_the_engraver("fanuc", sound), (0, vec![]));
    let spoiled = "G21 G90 G94\nT99 M6\nS60000 M3\nG1 X1 F100\nS60000\nX2\nT99 M6\nM30\n";
    let expected = [("no-magazine-place", 2), ("spindle-speed", 3), ("no-magazine-place", 7)];
    let (status, mut found) = asked_of_the_engraver("fanuc", spoiled);
    found.sort_by_key(|(_, line)| *line);
    assert_eq!((status, found), (1, told(&expected)));
    // LinuxCNC finds the place of tool 99 in its tool table; the speed is as wrong there.
    let (status, found) = asked_of_the_engraver("linuxcnc", spoiled);
    assert_eq!((status, found), (1, told(&[("spindle-speed", 3)])));
    // Thirteen tools do not fit, in whatever order they come, and each counts once.
    let tools: String = (1..=13).rev().map(|t| format!("T{t} M6\nT13 M6\n")).collect();
    let (status, found) = asked_of_the_engraver("linuxcnc", &format!("{tools}G1 X1 F100\nM2\n"));
    assert_eq!((status, found), (1, told(&[("magazine-full", 25)])));
    // Under G96 the number is a surface speed, m/min; after G97 it counts again.
    let surface = "G21 G90\nG96 S50000 M3\nG1 X1 F100\nG97 S50001\nM2\n";
    assert_eq!(asked_of_the_engraver("linuxcnc", surface).1, told(&[("spindle-speed", 4)]));
}

/// 6.2091 without its point: kilometres would be cut into pieces for minutes.
#[test]
fn a_move_that_is_longer_than_any_machine_is_refused_with_its_block() {
    let folder = Folder::new("simulate-far");
    let begin = "G21 G17 G90 G94\nG0 X0 Y0 Z-10\n";
    for far in [
        "G1 X62091 F600\nG1 X-6209100",
        "G0 X0\nG0 Y6209100",
        "G0 X1\nG53 G0 X6209100",
        "G0 X2\nG3 X2 Y0 I-6209100 J0 F600",
    ] {
        let program = folder.file("far.nc", format!("{begin}{far}\nM30\n"));
        let ran = run(&["simulate", MILL, &program, "--control", "fanuc"], &["--format", "json"]);
        let errors: Vec<_> = ran.json()["diagnostics"]
            .as_array()
            .expect("diagnostics")
            .iter()
            .filter(|d| d["severity"] == "error")
            .map(|d| (d["code"].clone(), d["line"].as_u64()))
            .collect();
        assert_eq!((ran.status, errors), (2, vec![("impossible-value".into(), Some(4))]), "{far}");
    }
    // 62 m are beyond the travel; what that means is shown, and that no error is known there.
    let program = folder.file("far.nc", format!("{begin}G1 X62091 F600\nM30\n"));
    let ran = run(&["simulate", MILL, &program, "--control", "fanuc"], &[]);
    assert!(ran.status == 1 && ran.out.contains("over-travel"), "{}{}", ran.out, ran.err);
    let said = ["warning[deviation-outside-travel]", "far.nc:3:1"];
    assert!(said.iter().all(|words| ran.err.contains(words)), "{}", ran.err);
    let program = folder.file("near.nc", format!("{begin}G1 X91 F600\nM30\n"));
    let ran = run(&["simulate", MILL, &program, "--control", "fanuc"], &[]);
    assert!(!ran.err.contains("outside-travel"), "{}", ran.err);
}

/// A block that leaves the travel is traced, and that no error is known there is said; so is a block number that stands twice.
#[test]
fn a_trace_says_what_is_not_known_and_which_block_it_shows() {
    let folder = Folder::new("trace-far");
    let text = "G21 G17 G90 G94\nN10 G0 X0 Y0 Z-10\nN20 G1 X1010. F600\nN10 G1 X20.\nM30\n";
    let program = folder.file("p.nc", text);
    let traced =
        |block: &str| run(&["trace", MILL, &program, "--control", "fanuc", "--block", block], &[]);
    let ran = traced("20");
    let said = ["warning[deviation-outside-travel]", "p.nc:3:1", "X goes to 1010.000 mm"];
    assert!(ran.status == 0 && said.iter().all(|words| ran.err.contains(words)), "{}", ran.err);
    let ran = traced("10");
    assert!(ran.err.contains("stands in the lines 2, 4: the first is shown"), "{}", ran.err);
    assert!(!ran.err.contains("outside-travel"), "{}", ran.err);
}

/// What the control compensates by active tables is no error of the machine that runs; a pose shows it, and both say so.
#[test]
fn active_tables_are_those_of_the_machine_that_runs() {
    let folder = Folder::new("simulate-active");
    let text = "[machine]\nname = \"mill\"\nchain = \"w b X Y Z t\"\n[tool]\nlength = \"100 mm\"\n[location]\nEC0Y = \"100 urad\"\nEB0Z = \"0 urad\"\n";
    let active = format!("{text}[compensation]\nactive = [\"EC0Y\"]\n");
    let machines = [folder.file("plain.toml", text), folder.file("active.toml", active)];
    let program = folder.file("p.nc", "G21 G90 G94\nG1 X10. Y200. F1000\nM30\n");
    let [plain, active] = machines.each_ref().map(|machine| {
        let ran = trueaxis(&["simulate", machine, &program, "--format", "json"]);
        let largest = ran.json()["deviation"]["tip_um"]["value"].as_f64().expect("a number");
        (largest, ran.err)
    });
    // 100 µrad over 200 mm.
    assert!((plain.0 - 20.0).abs() < 1e-6 && !plain.1.contains("already-active"), "{plain:?}");
    assert!(active.0 < 1e-6 && active.1.contains("simulated without EC0Y"), "{active:?}");
    let [plain, active] = machines.each_ref().map(|machine| {
        let ran = trueaxis(&["pose", machine, "--at", "Y=200", "--format", "json"]);
        (ran.json()["tool"].clone(), ran.err)
    });
    assert_eq!(plain.0, active.0);
    assert!(active.1.contains("shown with EC0Y") && !plain.1.contains("already-active"));
}

/// With the switch of the control on, a program is the one without these blocks; in every language, and in what it calls.
#[test]
fn law_optional_blocks_are_left_out_as_if_they_were_not_there() {
    let folder = Folder::new("simulate-optional");
    let whole = [
        (
            "nc",
            "G21 G17 G90 G94\nG0 X0 Y0 Z-10\n/G1 Y50 F600\nG1 X50 F600\n/2 G1 X80\n/N40 G1 X90\nM98 P7\nG1 X20\nM30\n",
        ),
        (
            "mpf",
            "G17 G90 G94\nG0 X0 Y0 Z-10\n/G1 Y50 F600\nG1 X50 F600\n/2 G1 X80\n/N40 G1 X90\nG1 X20\nM30\n",
        ),
        (
            "h",
            "BEGIN PGM A MM\nL X+0 Y+0 Z-10 R0 FMAX\n/ L Y+50 F600\nL X+50 F600\n/ L X+90\nL X+20\nEND PGM A MM\n",
        ),
    ];
    folder.file("O0007.nc", "O0007\n/G1 X70\nG1 Y10\nM99\n");
    for (ending, text) in whole {
        let marked = folder.file(&format!("marked.{ending}"), text);
        let numbers = |path: &str, more: &[&str]| -> [f64; 3] {
            let base = ["simulate", MILL, path, "--no-collisions", "--format", "json"];
            let ran = run(&base, more);
            assert_eq!(ran.status, 0, "{ending} {}", ran.err);
            let document = ran.json();
            ["time_s", "feed_mm", "rapid_mm"]
                .map(|key| document[key].as_f64().unwrap_or_else(|| panic!("{key} {}", ran.out)))
        };
        let left_out = numbers(&marked, &["--without-optional"]);
        let executed = numbers(&marked, &[]);
        let is_marked = |line: &&str| line.starts_with('/');
        let lines: Vec<&str> = text.lines().filter(|line| !is_marked(line)).collect();
        let bare = folder.file(&format!("bare.{ending}"), lines.join("\n") + "\n");
        if ending == "nc" {
            folder.file("O0007.nc", "O0007\nG1 Y10\nM99\n");
        }
        assert_eq!(numbers(&bare, &[]), left_out, "{ending}");
        assert!(executed[0] > left_out[0] + 1.0, "{ending} {executed:?} {left_out:?}");
    }
}

/// The offset of another tool is said with its block, where its length is another one, by both verbs.
#[test]
fn the_length_of_another_tool_is_said() {
    let mill = "machines/three-axis-mill/machine.toml";
    let folder = Folder::new("offset-of-other-tool");
    let set_up = |second: &str| {
        let text = format!(
            "[work_offset.G54]\nZ = \"-100 mm\"\n[tool.1]\nlength = \"100 mm\"\n[tool.2]\nlength = \"{second}\"\n"
        );
        folder.file("setup.toml", text)
    };
    for control in ["fanuc", "haas", "linuxcnc"] {
        for (call, second, said) in [
            ("T1 M6\nG43 H2", "80 mm", true),
            ("T1 M6\nG43 H2", "100 mm", false),
            ("T2 M6\nG43 H2", "80 mm", false),
            ("T1 M6\nG43 H0", "80 mm", false),
            ("T1 M6\nG44 H2", "80 mm", true),
        ] {
            if control == "linuxcnc" && call.contains("G44") {
                continue;
            }
            let set_up = set_up(second);
            let text = format!("%\nG21 G90 G94 G54\n{call}\nG1 X1. F100.\nM30\n%\n");
            let program = folder.file("a.nc", text);
            for verb in ["simulate", "trace"] {
                let words = [verb, mill, &program, "--control", control, "--setup", &set_up];
                let more: &[&str] =
                    if verb == "simulate" { &["--no-report"] } else { &["--block", "5"] };
                let ran = trueaxis(&[&words, more].concat());
                let text =
                    "H2 compensates 80.0000 mm, and tool 1 in the spindle is 100.0000 mm long";
                let found =
                    ran.err.contains("warning[offset-of-other-tool]") && ran.err.contains(text);
                assert_eq!(found, said, "{verb} {control} {call} {second}: {}", ran.err);
                assert_eq!(ran.err.contains("a.nc:4:"), said, "{}", ran.err);
            }
        }
    }
}

/// Two diameters of one tool are named, in a set-up file and in the library of a machine file.
#[test]
fn a_diameter_that_is_not_that_of_the_shape_is_said() {
    let folder = Folder::new("diameter-not-of-shape");
    let program = folder.file("a.nc", "%\nG21 G90 G94 G54\nT1 M6\nG43 H1\nM30\n%\n");
    let mill =
        std::fs::read_to_string(command::root().join("machines/three-axis-mill/machine.toml"));
    let mill = mill.expect("the machine");
    for (diameter, said) in [("12 mm", false), ("10 mm", true)] {
        let tool = format!(
            "length = \"100 mm\"\ndiameter = \"{diameter}\"\nshape = [[\"12 mm\", \"60 mm\"], [\"32 mm\", \"30 mm\"]]\n"
        );
        let set_up = folder.file("setup.toml", format!("[work_offset.G54]\n[tool.1]\n{tool}"));
        let machine = folder.file("machine.toml", format!("{mill}\n[tool.library.thick]\n{tool}"));
        let code = "warning[diameter-not-of-shape]";
        let options = ["--control", "fanuc", "--no-report", "--no-collisions", "--setup", &set_up];
        let known = "machines/three-axis-mill/machine.toml";
        let ran = trueaxis(&[&["simulate", known, &program][..], &options].concat());
        assert_eq!(ran.err.contains(code), said, "{}", ran.err);
        let ran = trueaxis(&["check", &machine]);
        assert_eq!(ran.err.contains(code), said, "{}", ran.err);
    }
}
