//! Tools with limits of wear, breakage and life, the tool setter and its log, as a user sees them.

mod command;

use command::{Folder, root, trueaxis};

const MACHINE: &str = "machines/i5-engraver/machine.toml";
const SETUP: &str = "examples/04_plan/tool-setting.setup.toml";
const LOG: &str = "examples/05_identify/tool-setting.log";

/// A program of FANUC that cuts 600 mm at 100 mm/min: 6 min, 0.6 m, with tool 1.
const PROGRAM: &str = "G21 G90 G54\nT1 M6\nG0 X0 Y0 Z60.\nG1 X60. F100.\nX0.\nX60.\nX0.\nX60.\nX0.\nX60.\nX0.\nX60.\nX0.\nM30\n";

fn setup(tool: &str) -> String {
    format!(
        "control = 'fanuc'\n[work_offset.G54]\nZ = '0 mm'\n[start]\nZ = '100 mm'\n\
         [tool.1]\nname = 'a'\nlength = '90 mm'\ndiameter = '3 mm'\n{tool}\n\
         [tool.2]\nname = 'b'\nlength = '90 mm'\ndiameter = '3 mm'\n"
    )
}

#[track_caller]
fn simulated(folder: &Folder, tool: &str, status: i32, words: &[&str]) -> serde_json::Value {
    let program = folder.file("p.nc", PROGRAM);
    let setup = folder.file("s.toml", setup(tool));
    let ran = trueaxis(&[
        "simulate",
        MACHINE,
        &program,
        "--setup",
        &setup,
        "--no-report",
        "--format",
        "json",
    ]);
    assert_eq!(ran.status, status, "{tool}\n{}\n{}", ran.err, ran.out);
    for word in words {
        assert!(ran.err.contains(word), "`{word}` is not in\n{}", ran.err);
    }
    ran.json()
}

#[test]
fn the_state_of_a_tool_decides() {
    let folder = Folder::new("tool-state");
    let of = |json: &serde_json::Value| {
        json["tools"].as_array().unwrap().iter().find(|t| t["tool"] == 1).unwrap().clone()
    };
    let limits = "wear_limit = { length = '30 um', radius = '15 um' }\nbreakage = '200 um'\n";
    let tool = |rest: &str| format!("{limits}{rest}");
    // Nothing is known: nothing is said.
    let json = simulated(&folder, limits, 0, &[]);
    assert!(of(&json)["state"].is_null());
    // 600 mm at 100 mm/min: 6 minutes and a little for the corners.
    let (s, mm) =
        (of(&json)["with_feed_s"].as_f64().unwrap(), of(&json)["with_feed_mm"].as_f64().unwrap());
    assert!((360.0..362.0).contains(&s) && (mm - 600.0).abs() < 0.5, "{s} {mm}");
    let json = simulated(&folder, &tool("measured = { length = '89.98 mm ± 1 um' }"), 0, &[]);
    assert_eq!(of(&json)["state"]["word"], "fit");
    assert!((of(&json)["state"]["length_off_um"].as_f64().unwrap() + 20.0).abs() < 1e-6);
    for (measured, code, word) in [
        ("length = '89.96 mm'", "tool-worn", "worn"),
        ("length = '90.04 mm'", "tool-worn", "worn"),
        ("length = '89.7 mm'", "tool-broken", "broken"),
        ("length = '90 mm', diameter = '2.96 mm'", "tool-worn", "worn"),
    ] {
        let json = simulated(
            &folder,
            &tool(&format!("measured = {{ {measured} }}")),
            1,
            &[&format!("warning[{code}]")],
        );
        assert_eq!(of(&json)["state"]["word"], word);
        assert_eq!(json["beyond_equipment"], 1);
        // A fit sister takes its place.
        let sister = format!("measured = {{ {measured} }}\nsister = 2");
        simulated(&folder, &tool(&sister), 0, &["warning[tool-replaced]", "sister tool 2"]);
    }
    // 29 µm with U = 4 µm of 30 µm.
    simulated(
        &folder,
        &tool("measured = { length = '89.971 mm ± 2 um' }"),
        0,
        &["note[tool-near-limit]"],
    );
}

#[test]
fn the_life_of_a_tool_counts_time_or_path_with_feed() {
    let folder = Folder::new("tool-life");
    simulated(&folder, "life = { time = '10 min', used = '3 min' }", 0, &[]);
    simulated(
        &folder,
        "life = { time = '10 min', used = '5 min' }",
        1,
        &["warning[tool-life]", "too little", "5.00 min of 10.00 min"],
    );
    let json = simulated(&folder, "life = { distance = '1 m', used = '300 mm' }", 0, &[]);
    let tool = &json["tools"].as_array().unwrap().iter().find(|t| t["tool"] == 1).unwrap()["state"];
    assert!((tool["life_after_mm"].as_f64().unwrap() - 100.0).abs() < 0.5, "{tool}");
    simulated(&folder, "life = { distance = '1 m', used = '500 mm' }", 1, &["0.10 m too little"]);
}

#[test]
fn spoilt_states() {
    let folder = Folder::new("tool-bad");
    for (tool, code, words) in [
        ("measured = { }", "missing-key", "nothing was measured"),
        ("measured = { length = '-20 um' }", "bad-size", "more than 0"),
        ("measured = { length = '90' }", "missing-unit", "a length"),
        ("wear_limit = { length = '0 um' }", "bad-size", "more than 0"),
        ("wear_limit = { length = '300 um' }\nbreakage = '200 um'", "bad-tool", "worn"),
        ("wear_limit = { width = '3 um' }", "unknown-key", "width"),
        ("life = { used = '1 min' }", "missing-key", "either by time or by distance"),
        ("life = { time = '1 min', distance = '1 m' }", "missing-key", "either"),
        ("life = { time = '1 min', used = '-1 min' }", "bad-size", "0 or more"),
        ("life = { time = '1 m' }", "wrong-unit", "time"),
        ("sister = 1", "unknown-tool", "its own sister"),
        ("sister = 7", "unknown-tool", "no tool 7"),
    ] {
        let json = simulated(&folder, tool, 2, &[&format!("[{code}]"), words, "s.toml:"]);
        assert_eq!(json["schema"], "trueaxis/refused/1");
    }
}

#[test]
fn programs_of_all_controls_and_their_log() {
    let folder = Folder::new("tool-setting");
    for control in ["fanuc", "haas", "sinumerik", "linuxcnc", "heidenhain"] {
        let programs = folder.path(control);
        let ran = trueaxis(&[
            "plan",
            "tool-setting",
            MACHINE,
            SETUP,
            "--control",
            control,
            "-o",
            &programs,
            "--format",
            "json",
        ]);
        assert_eq!(ran.status, 0, "{control}: {}{}", ran.err, ran.out);
        let json = ran.json();
        assert_eq!(json["schema"], "trueaxis/plan-tool-setting/1");
        assert_eq!(json["touches"].as_array().unwrap().len(), 8);
    }
    let lines = folder.path("measured.toml");
    let ran = trueaxis(&[
        "identify",
        "tools",
        MACHINE,
        SETUP,
        LOG,
        "-o",
        &lines,
        "--date",
        "2026-11-24",
        "--format",
        "json",
    ]);
    assert_eq!(ran.status, 1, "{}", ran.err);
    let json = ran.json();
    assert_eq!(json["schema"], "trueaxis/identify-tools/1");
    let words: Vec<&str> =
        json["tools"].as_array().unwrap().iter().map(|t| t["state"].as_str().unwrap()).collect();
    assert_eq!(words, ["fit", "fit", "broken"]);
    assert!((json["drift_um"].as_f64().unwrap() - 7.3).abs() < 3.0);
    let text = std::fs::read_to_string(&lines).unwrap();
    assert!(
        text.contains("[tool.1]\nmeasured = { length = \"89.98") && text.contains("2026-11-24"),
        "{text}"
    );
    let text = trueaxis(&["identify", "tools", MACHINE, SETUP, LOG]).out;
    for words in ["NOT FIT", "broken", "drifted by +7", "− nominal, µm"] {
        assert!(text.contains(words), "{words}\n{text}");
    }
}

#[test]
fn spoilt_setters_and_logs() {
    let folder = Folder::new("tool-setting-bad");
    let example = std::fs::read_to_string(root().join(SETUP)).unwrap();
    let planned = |text: &str, more: &[&str], code: &str, words: &str| {
        let setup = folder.file("s.toml", text);
        let arguments = ["plan", "tool-setting", MACHINE, &setup];
        let ran = trueaxis(&[&arguments[..], more].concat());
        assert_eq!(ran.status, 2, "{code}\n{}{}", ran.err, ran.out);
        assert!(
            ran.err.contains(&format!("[{code}]")) && ran.err.contains(words),
            "{code}: {}",
            ran.err
        );
    };
    let changed = |from: &str, to: &str| {
        assert!(example.contains(from), "{from}");
        example.replace(from, to)
    };
    let (start, rest) = example.split_once("[tool_setter]").unwrap();
    let without = format!("{start}{}", &rest[rest.find("[tool.1]").unwrap()..]);
    planned(&without, &[], "missing-key", "no [tool_setter]");
    planned(&changed("at = \"-150 85 -110 mm\"", ""), &[], "missing-key", "at");
    planned(&changed("diameter = \"10 mm ± 1 um\"", ""), &[], "missing-key", "diameter");
    planned(
        &changed("-150 85 -110 mm", "-150 85 -250 mm"),
        &[],
        "unreachable-point",
        "outside its travel",
    );
    planned(
        &changed("overtravel = \"2 mm\"", "overtravel = \"0.1 mm\""),
        &[],
        "bad-tool",
        "does not reach",
    );
    planned(&changed("reference = 12", "reference = 13"), &[], "unknown-tool", "no tool 13");
    planned(
        &changed("measured = { length = \"100.0021 mm ± 0.4 um\", date = \"2026-11-02\" }", ""),
        &[],
        "bad-tool",
        "no calibrated length",
    );
    planned(&changed("\"2026-11-02\"", "\"foo\""), &[], "bad-date", "`foo` is not a date");
    let lines = folder.path("foo.toml");
    let ran =
        trueaxis(&["identify", "tools", MACHINE, SETUP, LOG, "-o", &lines, "--date", "2026-02-30"]);
    assert_eq!(ran.status, 2, "{}", ran.out);
    assert!(ran.err.contains("[bad-date]") && ran.err.contains("--date"), "{}", ran.err);
    assert!(!std::path::Path::new(&lines).exists());
    planned(
        &changed("feed = \"50 mm/min\"", "feed = \"-50 mm/min\""),
        &[],
        "bad-size",
        "more than 0",
    );
    planned(
        &changed("speed = \"600 rpm\"", "speed = \"600\""),
        &[],
        "missing-unit",
        "angular velocity",
    );
    planned(&example, &["--tools", "1,x"], "bad-tool", "1,x");
    planned(&example, &["--tools", "5"], "bad-tool", "no tool 5");
    planned(&example, &["--control", "mazak"], "unknown-control", "mazak");
    let log = std::fs::read_to_string(root().join(LOG)).unwrap();
    let read = |text: String, code: &str, words: &str| {
        let file = folder.file("l.log", text);
        let ran = trueaxis(&["identify", "tools", MACHINE, SETUP, &file]);
        assert_eq!(ran.status, 2, "{code}\n{}{}", ran.err, ran.out);
        assert!(
            ran.err.contains(&format!("[{code}]")) && ran.err.contains(words),
            "{code}: {}",
            ran.err
        );
    };
    read(log.replace("END 8", ""), "lost-hits", "no END");
    read(log.replace("END 8", "END 9"), "too-many-hits", "need 8");
    read(
        log.lines().filter(|l| !l.starts_with("H5")).map(|l| format!("{l}\n")).collect(),
        "lost-hits",
        "hit 5 (tool 2) is missing",
    );
    read(log.replace("H6 K2 T2", "H6 K2 T5"), "other-tool", "expected is tool 2");
    read(log.replace("Z-20.0058", "Z-40.0058"), "far-hit", "Z is at -40.0058");
    read(log.replace("Z-20.0058", "Z"), "unknown-line", "Z");
    read(log.replace("MM MACHINE", "INCH MACHINE"), "far-hit", "l.log:2");
    read(log.replace("MM MACHINE", "MM WORK"), "other-frame", "WORK");
    read(String::new(), "too-few-hits", "no hit");
    read(format!("{log}{log}"), "two-logs", "second heading");
    // Read with the plan of other tools.
    let ran = trueaxis(&["identify", "tools", MACHINE, SETUP, LOG, "--tools", "2"]);
    assert!(ran.status == 2 && ran.err.contains("the log has 8 hits"), "{}", ran.err);
    // Cut off anywhere: no harm.
    for k in 0..10 {
        let file = folder.file("l.log", &log[..log.len() * k / 10]);
        assert_eq!(trueaxis(&["identify", "tools", MACHINE, SETUP, &file]).status, 2);
    }
}

#[test]
fn the_angles_and_the_screen() {
    let ran = trueaxis(&[
        "identify",
        "rtcp",
        "examples/05_identify/rtcp-angles.toml",
        "--format",
        "json",
    ]);
    assert_eq!(ran.status, 0, "{}", ran.err);
    let json = ran.json();
    assert_eq!(json["angles_found"], true);
    assert_eq!(json["angles"].as_array().unwrap().len(), 4);
    assert_eq!(json["screen"].as_array().unwrap().len(), 14);
    let step = json["segments"]["largest_step_deg"].as_f64().unwrap();
    assert!((step - 0.572_96).abs() < 1e-4, "{step}");
    let folder = Folder::new("rtcp-angles");
    let output = folder.path("m.toml");
    let ran =
        trueaxis(&["identify", "rtcp", "examples/05_identify/rtcp-angles.toml", "-o", &output]);
    assert_eq!(ran.status, 0, "{}", ran.err);
    let text = std::fs::read_to_string(&output).unwrap();
    let line = text.lines().find(|l| l.starts_with("EB0C")).unwrap();
    assert!(line.contains("urad") && line.contains('±'), "{line}");
    let example =
        std::fs::read_to_string(root().join("examples/05_identify/rtcp-angles.toml")).unwrap();
    let example = example.replace("../../machines", &root().join("machines").display().to_string());
    for table in ["low", "high"] {
        let name = format!("rtcp-angles-{table}.csv");
        let text =
            std::fs::read_to_string(root().join("examples/05_identify").join(&name)).unwrap();
        folder.file(&name, text);
    }
    for (from, to, code, words) in [
        ("angles = \"found\"", "angles = \"all\"", "unknown-choice", "all"),
        ("chord_error = \"1 um\"", "", "missing-key", "chord_error"),
        ("chord_error = \"1 um\"", "chord_error = \"0 um\"", "bad-size", "more than 0"),
        ("distance = \"80 mm\"", "distance = \"0.5 um\"", "bad-size", "not smaller"),
        ("along = \"5 mm\"", "", "missing-key", "belong together"),
        ("turned = \"10 deg\"", "turned = \"10 mm\"", "wrong-unit", "an angle"),
        ("shortest = \"0.1 mm\"", "shortest = \"-1 mm\"", "bad-size", "shortest"),
    ] {
        assert!(example.contains(from), "{from}");
        let file = folder.file("s.toml", example.replace(from, to));
        let ran = trueaxis(&["identify", "rtcp", &file]);
        assert_eq!(ran.status, 2, "{code} {}{}", ran.err, ran.out);
        assert!(
            ran.err.contains(&format!("[{code}]")) && ran.err.contains(words),
            "{code}: {}",
            ran.err
        );
    }
}

/// A side that is touched within the corner radius or the point is not the diameter.
#[test]
fn a_diameter_is_measured_where_the_tool_has_it() {
    let folder = Folder::new("tool-setting-corner");
    let text = std::fs::read_to_string(root().join(SETUP)).expect("a set-up");
    let planned = |tool: &str, depth: &str| {
        let text = text.replace(
            "diameter = \"1 mm\"\ncorner_radius = \"0.5 mm\"",
            &format!("measure_diameter = true\n{tool}"),
        );
        let deep = format!("depth = \"{depth}\"");
        let lines = text.lines().map(|l| if l.starts_with("depth = ") { &deep } else { l });
        let setup = folder.file("s.toml", lines.collect::<Vec<_>>().join("\n"));
        trueaxis(&["plan", "tool-setting", MACHINE, &setup, "--control", "fanuc", "--tools", "3"])
    };
    // The ball of 10 mm, a bull nose, a drill of 118° with a point of 3.004 mm, a flat one.
    for (tool, enough, less) in [
        ("corner_radius = \"5 mm\"", "5 mm", "4.9 mm"),
        ("corner_radius = \"2 mm\"", "2 mm", "1.9 mm"),
        ("cutter = { point = \"118 deg\" }", "3.01 mm", "3 mm"),
        ("corner_radius = \"0 mm\"", "0.1 mm", ""),
    ] {
        let tool = format!("diameter = \"10 mm\"\n{tool}");
        let text = planned(&tool, enough);
        assert!(!text.err.contains("bad-tool"), "{tool} {}", text.err);
        if !less.is_empty() {
            let ran = planned(&tool, less);
            assert_eq!(ran.status, 2, "{tool} {}", ran.out);
            assert!(ran.err.contains("has its whole diameter from"), "{}", ran.err);
        }
    }
    let taper = planned("diameter = \"10 mm\"\ncutter = { side = \"5 deg\" }", "5 mm");
    assert!(taper.status == 2 && taper.err.contains("is a taper"), "{}", taper.err);
}

/// Feed and speed of the setter are possible for the machine: 24 m/min, 40 000 1/min.
#[test]
fn a_setter_asks_for_no_more_than_the_machine_can() {
    let folder = Folder::new("setter-limits");
    let example = std::fs::read_to_string(root().join(SETUP)).expect("the set-up");
    for (from, to, said) in [
        ("feed = \"50 mm/min\"", "feed = \"25 m/min\"", "X moves with at most 24000.0000 mm/min"),
        ("feed = \"50 mm/min\"", "feed = \"25 m/min\"", "Z moves with at most 24000.0000 mm/min"),
        ("speed = \"600 rpm\"", "speed = \"50000 rpm\"", "turns with at most 40000.0000 1/min"),
        ("speed = \"600 rpm\"", "speed = \"39000 rpm\"", ""),
    ] {
        let setup = folder.file("s.toml", example.replace(from, to));
        let ran = trueaxis(&["plan", "tool-setting", MACHINE, &setup, "--control", "fanuc"]);
        assert_eq!(ran.status, if said.is_empty() { 0 } else { 2 }, "{}", ran.err);
        assert!(ran.err.contains(said), "{}", ran.err);
        assert_eq!(ran.err.contains("error[setter-beyond-machine]"), !said.is_empty());
    }
}
