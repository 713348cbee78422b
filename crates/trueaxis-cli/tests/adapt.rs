//! `trueaxis compensate adapt` as a user sees it, and inputs as users spoil them.

mod command;

use command::{Folder, Ran, root, trueaxis};

/// The example, or a part of it, as texts that can be spoiled.
#[derive(Clone)]
struct Parts {
    study: String,
    path: String,
    measured: String,
}

fn parts() -> Parts {
    let read = |name: &str| {
        std::fs::read_to_string(root().join("examples/06_compensate").join(name)).expect(name)
    };
    let machine = root().join("machines/i5-engraver/machine.toml").display().to_string();
    let study = read("bangle-adapt.toml")
        .replace("../../machines/i5-engraver/machine.toml", &machine.replace('\\', "/"))
        // Nothing to search for, and the map at the measured points.
        .replace("reach = \"4 mm\"", "length = \"20 mm\"\nreach = \"4 mm\"")
        .replace("blank = \"bangle-blank.csv\"", "");
    let path: Vec<String> = read("bangle-adapt.cls").lines().take(200).map(str::to_owned).collect();
    let measured: Vec<String> = read("bangle-measured.csv")
        .lines()
        .filter(|l| !l.starts_with("162,"))
        .map(str::to_owned)
        .collect();
    Parts { study, path: path.join("\n") + "\nFINI\n", measured: measured.join("\n") + "\n" }
}

impl Parts {
    fn run(&self, name: &str, arguments: &[&str]) -> (Folder, Ran) {
        let folder = Folder::new(&format!("adapt-{name}"));
        folder.file("bangle-adapt.cls", &self.path);
        folder.file("bangle-measured.csv", &self.measured);
        let study = folder.file("study.toml", &self.study);
        let all = [&["compensate", "adapt", &study, "--no-report"], arguments].concat();
        let ran = trueaxis(&all);
        (folder, ran)
    }

    /// Every row of the table, changed.
    fn with_rows(mut self, change: impl Fn(usize, Vec<f64>) -> Option<Vec<f64>>) -> Self {
        let (mut text, mut row) = (String::new(), 0);
        for line in self.measured.lines() {
            if line.starts_with(['#', 'p']) {
                text += &format!("{line}\n");
                continue;
            }
            let values = line.split(',').map(|v| v.parse().expect("a number")).collect();
            if let Some(values) = change(row, values) {
                let cells: Vec<String> = values.iter().map(ToString::to_string).collect();
                text += &(cells.join(",") + "\n");
            }
            row += 1;
        }
        self.measured = text;
        self
    }

    fn with_study(mut self, from: &str, to: &str) -> Self {
        assert!(self.study.contains(from), "{from}");
        self.study = self.study.replace(from, to);
        self
    }

    fn with_table(mut self, from: &str, to: &str) -> Self {
        assert!(self.measured.contains(from), "{from}");
        self.measured = self.measured.replacen(from, to, 1);
        self
    }

    fn with_path(mut self, from: &str, to: &str) -> Self {
        assert!(self.path.contains(from), "{from}");
        self.path = self.path.replacen(from, to, 1);
        self
    }
}

/// The command ends with `status` and tells `code` with the words.
#[track_caller]
fn reported(name: &str, parts: &Parts, status: i32, code: &str, words: &str) {
    let (_folder, ran) = parts.run(name, &["--format", "json"]);
    assert_eq!(ran.status, status, "{name}\n{}", ran.err);
    assert_eq!(ran.has_no_answer(), status == 2, "{name}");
    let mut blocks = ran.err.split("\n\n").filter(|b| b.contains(&format!("[{code}]")));
    let block = blocks.find(|b| b.contains(words));
    assert!(block.is_some(), "{code} `{words}` is not reported:\n{}", ran.err);
}

#[test]
fn the_example_as_it_stands() {
    let folder = Folder::new("adapt-example");
    let [report, program, cl] =
        ["report.html", "bangle.nc", "bangle.cls"].map(|name| folder.path(name));
    let ran = trueaxis(&[
        "compensate",
        "adapt",
        "examples/06_compensate/bangle-adapt.toml",
        "--report",
        &report,
        "--control",
        "fanuc",
        "-o",
        &program,
        "--cl",
        &cl,
        "--format",
        "json",
    ]);
    assert_eq!(ran.status, 0, "{}", ran.err);
    assert!(ran.err.contains("warning[outlier]: point 162 "), "{}", ran.err);
    let found = ran.json();
    assert_eq!(found["schema"], "trueaxis/compensate-adapt/1");
    let number = |pointer: &str| found.pointer(pointer).and_then(|v| v.as_f64()).expect(pointer);
    assert!(number("/wall/before/min_mm") <= 0.0);
    assert!(number("/wall/off_equal_layer_um/0") > -10.0);
    assert!(number("/wall/off_equal_layer_um/1") < 10.0);
    assert!(number("/program/tip_on_path_um") < 1.2);
    assert_eq!(found["program"]["written"], true);
    let page = std::fs::read_to_string(&report).expect("the report");
    assert!(page.starts_with("<!DOCTYPE html") && page.contains("adapted: wall, mm"));
    assert!(std::fs::read_to_string(&program).expect("the program").contains("G43.4"));
    // The adapted path is a file that can be posted by itself.
    let again = folder.path("again.nc");
    let machine = "machines/i5-engraver/machine.toml";
    let ran = trueaxis(&["post", machine, &cl, "--control", "fanuc", "--verify", "-o", &again]);
    assert_eq!(ran.status, 0, "{}", ran.err);
}

/// The text has the map, the verdict and what was held.
#[test]
fn the_text_shows_the_map() {
    let (_folder, ran) = parts().run("text", &[]);
    assert_eq!(ran.status, 0, "{}", ran.err);
    assert!(ran.out.contains("GOOD: as programmed the wall would be"), "{}", ran.out);
    assert!(ran.out.contains("remaining wall adapted, µm; across: angle about z"), "{}", ran.out);
}

/// The same path in inches gives the same answer.
#[test]
fn inches_that_are_said_are_read() {
    let mut inch = parts();
    let lines = inch.path.lines().map(|line| match line.strip_prefix("GOTO/") {
        Some(rest) => {
            let v: Vec<f64> = rest.split(',').map(|t| t.parse().expect("a number")).collect();
            let tip: Vec<String> = v[..3].iter().map(|x| format!("{:.9}", x / 25.4)).collect();
            format!("GOTO/{},{},{},{}", tip.join(","), v[3], v[4], v[5])
        }
        None => line.replace("UNITS/MM", "UNITS/INCHES").replace("MMPM", "IPM"),
    });
    inch.path = lines.collect::<Vec<_>>().join("\n") + "\n";
    let (_a, metric) = parts().run("metric", &["--format", "json"]);
    let (_b, inch) = inch.run("inch", &["--format", "json"]);
    assert_eq!((metric.status, inch.status), (0, 0), "{}", inch.err);
    for k in 0..2 {
        let [a, b] = [&metric, &inch].map(|r| r.json()["places"]["moved_um"][k].as_f64());
        assert!((a.expect("µm") - b.expect("µm")).abs() < 1e-3);
    }
}

#[test]
fn a_blank_in_another_set_up() {
    let shifted = parts().with_rows(|_, mut v| {
        v[7] += 500.0 * v[4];
        Some(v)
    });
    reported("shifted", &shifted, 2, "other-set-up", "lies 0.5");
    let other = parts().with_rows(|_, mut v| {
        v[7] *= 6.0;
        Some(v)
    });
    reported("other", &other, 2, "other-set-up", "allowed are");
    // The table counts from another zero than the path.
    let zero = parts().with_rows(|_, mut v| {
        v[1] += 0.8;
        Some(v)
    });
    reported("zero", &zero, 2, "other-zero", "bangle-adapt.cls:");
}

#[test]
fn a_path_beyond_what_was_probed() {
    // 24 of 48 points in each row: from 180 degrees on the path has none.
    let half = parts().with_rows(|row, v| (row % 48 < 8).then_some(v));
    reported("half", &half, 2, "beyond-probed", "bangle-adapt.cls:");
    // A file in mm that claims inches is far from everything.
    let inch = parts().with_path("UNITS/MM", "UNITS/INCHES");
    reported("inch-slip", &inch, 2, "beyond-probed", "UNITS/MM or INCHES");
}

#[test]
fn tables_with_slips() {
    let at = "bangle-measured.csv:5:";
    let third = |with: &str| {
        let base = parts();
        let line = base.measured.lines().nth(4).expect("a row").to_owned();
        let mut cells: Vec<&str> = line.split(',').collect();
        match with {
            "zero" => cells.splice(4..7, ["0", "0", "0"]).count(),
            "back" => cells.splice(4..7, ["-0.8991985", "-0.4323496", "0.0672006"]).count(),
            other => cells.splice(7..8, [other]).count(),
        };
        base.with_table(&line, &cells.join(","))
    };
    reported("nan", &third("nan"), 2, "not-a-number", at);
    reported("empty", &third(""), 2, "not-a-number", at);
    reported("zero", &third("zero"), 2, "bad-normal", at);
    reported("back", &third("back"), 2, "wrong-side", at);
    reported("large", &third("9000"), 2, "large-deviation", at);
    reported("unit", &parts().with_table("deviation_um", "deviation_deg"), 2, "wrong-unit", ":2:");
    reported("none", &parts().with_table("deviation_um", "deviation"), 2, "missing-unit", ":2:");
    reported("column", &parts().with_table(",k,", ",l,"), 2, "missing-column", "`k`");
    let few = parts().with_rows(|row, v| (row < 8).then_some(v));
    reported("few", &few, 2, "too-few-points", "at least 12");
    // All normals point inwards: no point contradicts its neighbours, but the tool is on the other side.
    let inside = parts().with_rows(|_, mut v| {
        v[4..7].iter_mut().for_each(|n| *n = -*n);
        Some(v)
    });
    reported("inside", &inside, 2, "wrong-side", "looks away from the tool");
    let twice = parts().with_rows(|row, mut v| {
        v[7] += if row % 3 == 0 { 80.0 } else { 0.0 };
        Some(v)
    });
    // Then the wall is not known well enough, either.
    reported("twice", &twice, 1, "rough-readings", "scatter");
}

/// The rows of the table in another order, and each of them twice: the same path, byte for byte.
#[test]
fn law_order_and_copies_of_rows_do_not_matter() {
    let whole = parts().with_study("length = \"20 mm\"\n", "");
    let (head, rows): (Vec<&str>, Vec<&str>) =
        whole.measured.lines().partition(|l| l.starts_with(['#', 'p']));
    let table = |rows: &[&str]| head.join("\n") + "\n" + &rows.join("\n") + "\n";
    let adapted = |name: &str, rows: &[&str]| {
        let parts = Parts { measured: table(rows), ..whole.clone() };
        let folder = Folder::new(&format!("adapt-{name}-cl"));
        let cl = folder.path("adapted.cls");
        let (_folder, ran) = parts.run(name, &["--cl", &cl]);
        assert_eq!(ran.status, 0, "{name}\n{}", ran.err);
        (std::fs::read_to_string(&cl).expect("the path"), ran.err.matches("[copied-rows]").count())
    };
    let reversed: Vec<&str> = rows.iter().rev().copied().collect();
    let twice: Vec<&str> = rows.iter().flat_map(|row| [*row, *row]).collect();
    let (path, none) = adapted("rows", &rows);
    assert_eq!(none, 0);
    assert!(adapted("reversed", &reversed) == (path.clone(), 0));
    assert!(adapted("each-twice", &twice) == (path, 4));
}

#[test]
fn paths_with_slips() {
    let whole = parts();
    let cut = Parts { path: whole.path[..whole.path.len() - 50].to_owned(), ..whole.clone() };
    reported("cut", &cut, 2, "bad-number", "bangle-adapt.cls:200");
    reported("cut-file", &cut, 2, "cut-file", "bangle-adapt.cls:200");
    reported("no-end", &whole.clone().with_path("FINI\n", ""), 0, "no-end", "FINI");
    let circle = "MULTAX/ON\nCIRCLE/0,0,0,0,0,1,5";
    reported("circle", &whole.clone().with_path("MULTAX/ON", circle), 2, "curve", ":7:");
    let none = whole.with_study("bangle-adapt.cls", "nowhere.cls");
    reported("missing", &none, 2, "unreadable-file", "nowhere.cls");
}

/// As `post`: what can change motion, spindle or coolant and is not applied is part of the verdict.
#[test]
fn words_that_are_not_applied_are_no_good_path() {
    let folder = Folder::new("adapt-not-applied-out");
    for (k, word) in ["CUTCOM/LEFT", "INSERT G68 R30", "FOO/1"].into_iter().enumerate() {
        let parts = parts().with_path("MULTAX/ON", &format!("MULTAX/ON\n{word}"));
        let cl = folder.path(&format!("{k}.cls"));
        let name = format!("not-applied-{k}");
        let (_folder, ran) = parts.run(&name, &["--cl", &cl, "--format", "json"]);
        assert_eq!(ran.status, 1, "{word}\n{}", ran.err);
        let found = ran.json();
        assert_eq!(
            (found["verdict"].as_str(), found["not_applied"].as_u64()),
            (Some("not applied"), Some(1))
        );
        assert!(std::fs::read_to_string(&cl).expect("the path").contains(word));
        if k == 0 {
            let (_folder, ran) = parts.run("not-applied-text", &[]);
            let said = ["NOT APPLIED", "1 word of the path is not applied, listed above"];
            assert!(said.iter().all(|text| ran.out.contains(text)), "{}", ran.out);
        }
    }
}

#[test]
fn a_path_for_another_cutter_is_named() {
    let parts = || parts().with_path("CUTTER/8.,4.", "CUTTER/10.,4.");
    reported("other-diameter", &parts(), 0, "other-cutter", "bangle-adapt.cls:5:");
    let corner = parts().with_path("CUTTER/10.,4.", "CUTTER/8.,1.");
    reported("other-corner", &corner, 0, "other-cutter", "a cutter of 8 mm with a corner of 1 mm");
    for same in ["CUTTER/8.", "CUTTER/8.,4.,0.,4.,0.,0.,50."] {
        let (_folder, ran) = parts().with_path("CUTTER/10.,4.", same).run("same-cutter", &[]);
        assert!(!ran.err.contains("other-cutter"), "{same}\n{}", ran.err);
    }
}

#[test]
fn studies_with_slips() {
    let study = |from: &str, to: &str| parts().with_study(from, to);
    reported(
        "layer",
        &study("depth = \"0.15 mm\"", "depth = \"0.08 mm\""),
        2,
        "other-layer",
        "0.15",
    );
    reported(
        "deep",
        &study("depth = \"0.15 mm\"", "depth = \"0.3 mm\""),
        2,
        "layer-too-deep",
        "-0.06",
    );
    // A wall of less than nothing is a hole.
    reported(
        "least",
        &study("least = \"0.05 mm\"", "least = \"-1 mm\""),
        2,
        "not-positive",
        "it is negative",
    );
    reported(
        "noise",
        &study("noise = \"1.5 um\"", "noise = \"0 um\""),
        2,
        "not-positive",
        "study.toml",
    );
    reported("cutter", &study("radius = \"4 mm\"", "radius = \"5 mm\""), 2, "bad-cutter", "5 mm");
    reported(
        "word",
        &study("[wall]", "[wall]\ninner = \"soft\""),
        2,
        "unknown-word",
        "\"follows\" or",
    );
    reported(
        "machine",
        &study("machine.toml", "nothing.toml"),
        2,
        "unreadable-file",
        "nothing.toml",
    );
    reported("key", &study("[probe]", "[probe]\nnoize = 1"), 2, "unknown-key", "noize");
}

/// A wall that may become too thin is named with its line, and nothing is written.
#[test]
fn nothing_is_written_where_the_wall_is_too_thin() {
    let thin = parts().with_study("least = \"0.05 mm\"", "least = \"0.085 mm\"");
    let (folder, ran) = thin.run("thin", &["--format", "json", "--control", "fanuc", "-o", "p.nc"]);
    assert_eq!(ran.status, 1, "{}", ran.err);
    let found = ran.json();
    assert_eq!(found["findings"][0]["code"], "thin-wall");
    assert!(found["findings"][0]["line"].as_u64().expect("a line") > 10);
    assert_eq!(found["program"]["written"], false);
    assert!(!root().join("p.nc").exists());
    assert_eq!(folder.names().len(), 3);
}

/// A blank so far to the side that its program would leave the travel: no program.
#[test]
fn nothing_leaves_the_travel() {
    let machine = std::fs::read_to_string(root().join("machines/i5-engraver/machine.toml"));
    let narrow =
        machine.expect("the machine").replace("\"-180 mm\", \"180 mm\"", "\"-5 mm\", \"5 mm\"");
    let mut parts = parts();
    let from = parts.study.find("machine = \"").expect("the machine is named");
    let to = from + parts.study[from..].find('\n').expect("a line");
    parts.study.replace_range(from..to, "machine = \"narrow.toml\"");
    let folder = Folder::new("adapt-travel");
    folder.file("narrow.toml", narrow);
    folder.file("bangle-adapt.cls", &parts.path);
    folder.file("bangle-measured.csv", &parts.measured);
    let study = folder.file("study.toml", &parts.study);
    let program = folder.path("p.nc");
    let ran = trueaxis(&[
        "compensate",
        "adapt",
        &study,
        "--no-report",
        "--control",
        "fanuc",
        "--tcp",
        "off",
        "-o",
        &program,
    ]);
    assert_eq!(ran.status, 2, "{}{}", ran.out, ran.err);
    assert!(ran.err.contains("bangle-adapt.cls:"), "{}", ran.err);
    assert!(!std::path::Path::new(&program).exists());
}
