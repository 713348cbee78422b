//! `trueaxis compensate` as a user sees it.

mod command;

use command::{Folder, trueaxis};
use serde_json::Value;

const GANTRY: &str = "machines/gantry-001/machine.toml";
const MILL: &str = "machines/three-axis-mill/machine.toml";

/// Zhang et al. 2019: the values at the two ends, and both figures of the warning.
#[test]
fn the_ends_of_the_gantry() {
    for (at, temperatures, value, um) in [
        ("X=3500", "scale_x=30.5 workpiece=30.5", 54, [-54.1, -485.1]),
        ("Y=2300", "scale_y=31.2 workpiece=31.2", 87, [-86.93, -340.03]),
    ] {
        let arguments = ["compensate", "values", GANTRY, "--at", at, "--temperature", temperatures];
        let ran = trueaxis(&[&arguments[..], &["--format", "json"]].concat());
        assert_eq!(ran.status, 0, "{}", ran.err);
        assert!(ran.err.contains("MAKES THE PART WORSE"), "{}", ran.err);
        let found = ran.json();
        assert_eq!(found["schema"], "trueaxis/compensate/1");
        let node = &found["axes"][0]["positions"][0];
        assert_eq!(node["value_increments"], value);
        for (key, expected) in ["none", "machine"].into_iter().zip(um) {
            let part = node["part_error_um"][key].as_f64().expect("a number");
            assert!((part - expected).abs() < 0.15, "{key}: {part}, not {expected}");
        }
        // The text has the warning on top, and both figures.
        let ran = trueaxis(&arguments);
        assert!(ran.out.contains("WARNING") && !ran.err.contains("WORSE"), "{}", ran.out);
        let [before, after] = um.map(|v: f64| format!("{:.1} µm", v.abs()));
        assert!(ran.out.contains(&before), "{}", ran.out);
        assert!(ran.out.contains(&after) || at == "Y=2300", "{}", ran.out);
    }
}

/// Zhang et al. 2019, section 3.2.1: −431 µm for the machine leave 485.1 µm in a part of 30.5 °C that has 54.1 µm without
/// them. Without the temperature of the workpiece nothing is calculated, and nothing is written.
#[test]
fn a_workpiece_of_unknown_temperature_is_refused_with_the_price() {
    let folder = Folder::new("compensate-unknown-workpiece");
    let refused = |arguments: &[&str]| {
        let ran = trueaxis(arguments);
        assert_eq!((ran.status, ran.out.as_str()), (2, ""), "{arguments:?} {}", ran.err);
        assert!(ran.err.contains("error[no-workpiece-temperature]"), "{}", ran.err);
        assert!(ran.err.contains("46.2 µm over the 3500 mm of X"), "{}", ran.err);
        ran.err
    };
    let at = ["compensate", "values", GANTRY, "--at", "X=3500"];
    let scale = ["--temperature", "scale_x=30.5"];
    let price = refused(&[&at[..], &scale].concat());
    for figure in
        ["485.1 µm if it has the 30.5 °C", "54.1 µm in X uncompensated", "485.1 µm compensated so"]
    {
        assert!(price.contains(figure), "{figure}: {price}");
    }
    // Without any temperature the scales have that of their tables, 28.4 and 29.3 °C.
    let price = refused(&at);
    assert!(price.contains("28.8 °C") || price.contains("28.9 °C"), "{price}");
    // Tables and programs have the same hole.
    let (tables, program) = (folder.path("tables"), folder.path("p.nc"));
    let source = folder.path("in.nc");
    folder.file("in.nc", "%\nO1\nG90 G54 G1 X10. Y10. Z100. F500.\nX3000.\nM30\n%\n");
    let of_tables = ["compensate", "tables", GANTRY, "--target", "csv", "-o", &tables];
    let of_program =
        ["compensate", "program", GANTRY, &source, "-o", &program, "--control", "fanuc"];
    refused(&[&of_tables[..], &scale].concat());
    refused(&[&of_program[..], &scale].concat());
    assert_eq!(folder.names(), ["in.nc"]);
    // A workpiece at 20 °C is known; asked for by name, the machine alone is given, the price first.
    let known = trueaxis(&[&at[..], &["--temperature", "scale_x=30.5 workpiece=20"]].concat());
    assert!(known.status == 0 && !known.out.contains("MACHINE ONLY"), "{}", known.out);
    for ask in [&["--machine-only"][..], &["--of", "machine"]] {
        let ran = trueaxis(&[&at[..], &scale, ask].concat());
        let first = ran.out.lines().next().expect("a line");
        assert!(first.starts_with("MACHINE ONLY") && first.contains("485.1 µm"), "{first}");
        assert!(ran.out.contains("-431") && ran.out.contains("not known"), "{}", ran.out);
        let json = trueaxis(&[&at[..], &scale, ask, &["--format", "json"]].concat()).json();
        assert!(json["warnings"][0].as_str().is_some_and(|w| w.starts_with("MACHINE ONLY")));
        let node = &json["axes"][0]["positions"][0];
        assert!(node["comprehensive_um"].is_null() && node["part_error_um"].is_null(), "{node}");
        let csv = trueaxis(&[&at[..], &scale, ask, &["--format", "csv"]].concat());
        let first = csv.out.lines().next().expect("a line");
        assert!(first.contains("MACHINE ONLY") && csv.out.contains(",,"), "{}", csv.out);
    }
    let ran = trueaxis(&[&of_tables[..], &scale, &["--machine-only"]].concat());
    assert!(ran.status == 0 && ran.out.starts_with("MACHINE ONLY"), "{} {}", ran.out, ran.err);
}

/// A table that is on in the control is not asked for again; what heat adds still is.
#[test]
fn what_the_control_compensates_already_is_no_value() {
    let folder = Folder::new("compensate-active");
    let text = std::fs::read_to_string(command::root().join(MILL)).expect("a machine");
    let active = folder.path("active.toml");
    let errors = r#"["EXX", "EYX", "EZX", "EAX", "EBX", "ECX"]"#;
    let text = format!("{text}\n[compensation]\nactive = {errors}\n");
    std::fs::write(&active, text).expect("written");
    let values = |machine: &str| {
        let arguments =
            ["compensate", "values", machine, "--axis", "X", "--step", "100", "--format", "json"];
        let ran = trueaxis(&arguments);
        assert_eq!(ran.status, 0, "{}", ran.err);
        let positions = ran.json()["axes"][0]["positions"].clone();
        let each = positions.as_array().expect("positions").clone();
        let largest = each.iter().map(|p| p["value_increments"].as_i64().expect("whole").abs());
        (largest.max(), ran.err)
    };
    let (largest, reported) = values(MILL);
    assert!(largest > Some(3) && !reported.contains("already-active"), "{largest:?} {reported}");
    let (largest, reported) = values(&active);
    assert_eq!(largest, Some(0));
    assert!(reported.contains("already-active") && reported.contains("EXX"), "{reported}");
}

#[test]
fn a_table_goes_into_a_file_and_over_nothing_else() {
    let folder = Folder::new("compensate-file");
    let path = folder.path("x.csv");
    let arguments = [
        "compensate",
        "values",
        MILL,
        "--axis",
        "X",
        "--step",
        "100",
        "--format",
        "csv",
        "-o",
        &path,
    ];
    let ran = trueaxis(&arguments);
    assert_eq!((ran.status, ran.out.as_str()), (0, ""), "{}", ran.err);
    let text = std::fs::read_to_string(&path).expect("the table");
    assert_eq!(text.lines().filter(|l| !l.starts_with('#')).count(), 8, "{text}");
    // Both directions of approach stand in it.
    assert!(text.contains(",value_up_increments,value_down_increments\n-300,-8,"), "{text}");
    // It may be written again; what is something else may not.
    assert_eq!(trueaxis(&arguments).status, 0);
    folder.file("x.csv", "mine");
    assert_eq!(trueaxis(&arguments).status, 2);
    assert_eq!(folder.names(), ["x.csv"]);
}

#[test]
fn mistakes_are_named() {
    for (arguments, code) in [
        (vec!["--axis", "Q"], "unknown-axis"),
        (vec!["--axis", "X", "--step", "0"], "not-positive"),
        (vec!["--axis", "X", "--step", "1e-9"], "no-positions"),
        (vec!["--axis", "X", "--targets", "0 x"], "not-a-number"),
        (vec!["--axis", "X", "--increment", "1"], "missing-unit"),
        (vec!["--axis", "X", "--increment", "0 um"], "not-positive"),
        (vec!["--axis", "X", "--increment", "1e-300 um"], "not-finite"),
        (vec!["--at", ""], "missing-axis"),
        (vec!["--at", "X=nan"], "not-finite"),
        (vec!["--at", "X=0 Y=0", "--format", "csv"], "one-axis"),
    ] {
        let ran = trueaxis(&[&["compensate", "values", MILL], &arguments[..]].concat());
        assert_eq!((ran.status, ran.out.as_str()), (2, ""), "{arguments:?} {}", ran.err);
        assert!(ran.err.contains(&format!("error[{code}]")), "{code}: {}", ran.err);
    }
}

/// What the issue asks of the document, and that nothing is half-written.
#[test]
fn tables_of_a_control() {
    let folder = Folder::new("compensate-tables");
    for (target, files) in [("csv", 1), ("linuxcnc", 4), ("sinumerik", 2)] {
        let out = folder.path(target);
        let arguments = ["compensate", "tables", MILL, "--target", target, "-o", &out];
        let ran = trueaxis(&[&arguments[..], &["--format", "json"]].concat());
        assert_eq!(ran.status, 0, "{}", ran.err);
        let found = ran.json();
        assert_eq!(found["schema"], "trueaxis/compensate-tables/1");
        assert_eq!(found["target"], target);
        let written = found["files"].as_array().expect("files");
        assert_eq!(written.len(), files);
        assert!(written.iter().all(|f| std::fs::metadata(f.as_str().expect("a path")).is_ok()));
        assert!(found["represents"].as_array().is_some_and(|r| r.contains(&"EXX".into())));
        let number = |path: &str| found.pointer(path).and_then(|v| v.as_f64()).expect("a number");
        let check = &found["tables"][0]["check"];
        let added = check["added_um"].as_f64().expect("a number");
        assert!(added.abs() > 5.0 && check["position"].is_number(), "{check}");
        assert!(number("/left_um/max") < number("/before_um/max"));
        assert!(number("/wrong_sign_um/rms") > number("/before_um/rms"));
        assert!(found["left_um"]["test_piece"].is_null());
        // Nothing is overwritten.
        let again = trueaxis(&arguments);
        assert_eq!(again.status, 2);
        assert!(again.err.contains("unwritable-folder"), "{}", again.err);
    }
    // Of controls that know more than tables, on a machine with rotary axes.
    for (target, name) in [
        ("fanuc", "GRID3D.CSV"),
        ("heidenhain", "AXIS_XC.COM"),
        ("isg", "volcomp.csv"),
        ("sinumerik", "TOOLCARRIER.SPF"),
        ("csv", "kinematics.csv"),
    ] {
        let out = folder.path(&format!("xkas-{target}"));
        let machine = "machines/xkas2525/machine.toml";
        let arguments = ["compensate", "tables", machine, "--target", target, "-o", &out];
        let ran = trueaxis(&[&arguments[..], &["--format", "json"]].concat());
        assert_eq!(ran.status, 0, "{}", ran.err);
        let found = ran.json();
        let written = found["files"].as_array().expect("files");
        assert!(
            written.iter().any(|f| f.as_str().is_some_and(|f| f.ends_with(name))),
            "{written:?}"
        );
        let number = |path: &str| found.pointer(path).and_then(|v| v.as_f64()).expect("a number");
        assert!(number("/left_um/rms") < 0.8 * number("/before_um/rms"), "{target}");
        assert!(number("/wrong_sign_um/rms") > number("/before_um/rms"), "{target}");
        assert!(found["cannot"].as_array().is_some_and(|c| !c.is_empty()));
        if target == "isg" {
            let text = trueaxis(&[&arguments[..6], &[&format!("{out}-text")]].concat());
            assert!(text.out.contains("with tables") && text.out.contains(name), "{}", text.out);
        }
    }
    for (extra, code) in [
        (&["--limit", "2 um"][..], "too-large"),
        (&["--limit", "2 um", "--target", "isg"], "too-large"),
        (&["--bound", "0.001 um", "--target", "fanuc"], "bound-below-increment"),
        (&["--bound", "0.01 um", "--target", "sinumerik"], "bound-below-increment"),
        (&["--bound", "-1 um"], "not-positive"),
        (&["--bound", "nan um"], "not-finite"),
        (&["--comp-file-type", "1"], "unused-argument"),
        (&["--at", "Q=1"], "unknown-axis"),
    ] {
        let out = folder.path("refused");
        let target = if extra.contains(&"--target") { &[][..] } else { &["--target", "csv"] };
        let arguments = ["compensate", "tables", MILL, "-o", &out];
        let ran = trueaxis(&[&arguments[..], target, extra].concat());
        assert_eq!(ran.status, 2, "{extra:?}");
        assert!(ran.err.contains(code), "{extra:?}: {}", ran.err);
        assert!(std::fs::metadata(&out).is_err(), "{extra:?}: something was written");
    }
}

/// The test piece of a study is cut with the tables.
#[test]
fn tables_and_a_test_piece() {
    let folder = Folder::new("compensate-tables-piece");
    let out = folder.path("xkas");
    let study = "examples/03_predict/nas979-on-xkas2525.toml";
    let arguments = ["compensate", "tables", "machines/xkas2525/machine.toml", "--target", "csv"];
    let ran =
        trueaxis(&[&arguments[..], &["-o", &out, "--piece", study, "--format", "json"]].concat());
    assert_eq!(ran.status, 0, "{}", ran.err);
    let found = ran.json();
    let indices = found["left_um"]["test_piece"]["indices"].as_array().expect("indices").clone();
    assert!(indices.len() >= 11);
    assert!(indices.iter().all(|i| i["left_um"] != i["before_um"]));
}

/// The part of a study is cut with the tables: before as `predict` says, after nearer to the drawing, and a study of another machine is refused.
#[test]
fn tables_and_a_part_by_its_drawing() {
    let folder = Folder::new("compensate-tables-part");
    let study = "examples/03_predict/housing.toml";
    let predicted = trueaxis(&["predict", study, "--samples", "0", "--format", "json"]).json();
    let machine = "machines/xkas2525/machine.toml";
    for target in ["csv", "sinumerik"] {
        let out = folder.path(target);
        let arguments = ["compensate", "tables", machine, "--target", target, "-o", &out];
        let ran = trueaxis(&[&arguments[..], &["--piece", study, "--format", "json"]].concat());
        assert_eq!(ran.status, 0, "{}", ran.err);
        let found = ran.json();
        let part = &found["left_um"]["part"];
        assert_eq!(part["outcome"], predicted["outcome"]);
        let lines = part["characteristics"].as_array().expect("characteristics").clone();
        let number = |of: &Value, key: &str| of[key].as_f64().expect(key);
        let (mut before_um, mut after_um) = (0.0, 0.0);
        for (line, due) in lines.iter().zip(predicted["characteristics"].as_array().unwrap()) {
            assert_eq!(line["name"], due["name"]);
            assert!((number(line, "before_um") - 1e3 * number(due, "value_mm")).abs() < 1e-9);
            before_um += number(line, "before_um").abs();
            after_um += number(line, "zero_set_um").abs();
        }
        assert!(after_um < 0.6 * before_um, "{target}: {before_um} {after_um}");
    }
    let out = folder.path("other");
    let mill = "machines/three-axis-mill/machine.toml";
    let arguments = ["compensate", "tables", mill, "--target", "csv", "-o", &out];
    let ran = trueaxis(&[&arguments[..], &["--piece", study]].concat());
    assert_eq!(ran.status, 2);
    assert!(ran.err.contains("another-machine"), "{}", ran.err);
}

/// What the control compensates already is left to it: by tables and by programs.
#[test]
fn nothing_is_compensated_twice() {
    let folder = Folder::new("compensate-twice");
    let text = "[machine]\nname = \"mill\"\nchain = \"w b X Y Z t\"\n\
                [axis.X]\ntravel = [\"0 mm\", \"500 mm\"]\n[axis.Y]\ntravel = [\"0 mm\", \"400 mm\"]\n\
                [axis.Z]\ntravel = [\"0 mm\", \"300 mm\"]\n\
                [location]\nEC0Y = \"50 ± 1 urad\"\nEB0Z = \"40 ± 1 urad\"\n";
    let bare = folder.file("bare.toml", text);
    let active = format!("{text}[compensation]\nactive = [\"EC0Y\"]\n");
    let active = folder.file("active.toml", active);
    let unknown = format!("{text}[compensation]\nactive = [\"EQ0Y\"]\n");
    let unknown = folder.file("unknown.toml", unknown);
    let tables = |machine: &str, out: &str| {
        let out = folder.path(out);
        trueaxis(&[
            "compensate",
            "tables",
            machine,
            "--target",
            "csv",
            "-o",
            &out,
            "--format",
            "json",
        ])
    };
    let represented = |ran: &command::Ran| ran.json()["represents"].to_string();
    let ran = tables(&bare, "a");
    assert_eq!((ran.status, represented(&ran)), (0, "[\"EC0Y\",\"EB0Z\"]".to_owned()));
    let ran = tables(&active, "b");
    assert_eq!((ran.status, represented(&ran)), (0, "[\"EB0Z\"]".to_owned()));
    assert!(ran.err.contains("not compensated again: EC0Y"), "{}", ran.err);
    let ran = tables(&unknown, "c");
    assert_eq!(ran.status, 2);
    assert!(ran.err.contains("EQ0Y"), "{}", ran.err);
    // X = 0 + 300 · 40 µrad only: the squareness of Y is the control's own affair.
    let program =
        folder.file("p.nc", "O1\nG90 G21 G0 X100 Y100 Z100\nG1 X200. Y400. Z300. F500\nM30\n");
    let out = folder.path("p-comp.nc");
    let ran = trueaxis(&[
        "compensate",
        "program",
        &active,
        &program,
        "-o",
        &out,
        "--report",
        &folder.path("r.html"),
    ]);
    assert_eq!(ran.status, 0, "{}", ran.err);
    assert!(ran.err.contains("not compensated again: EC0Y"), "{}", ran.err);
    let written = std::fs::read_to_string(out).expect("the program");
    assert!(written.contains("X199.988") || written.contains("X200.012"), "{written}");
}

/// HEIDENHAIN's and ISG's tables hold errors of axes alone: for a warm part they are refused, not written without it.
#[test]
fn tables_that_would_leave_the_workpiece_out_are_refused() {
    let folder = Folder::new("warm-part-tables");
    let gantry = "machines/gantry-001/machine.toml";
    let warm = "scale_x=30.5 scale_y=30.5 scale_z=30.5 workpiece=30.5";
    for target in ["heidenhain", "isg"] {
        let out = folder.path(target);
        let words =
            ["compensate", "tables", gantry, "--target", target, "--temperature", warm, "-o", &out];
        let ran = trueaxis(&words);
        assert!(ran.status == 2 && ran.err.contains("workpiece-left-out"), "{target}: {}", ran.err);
        assert!(!std::path::Path::new(&out).exists());
        let machine = trueaxis(&[&words[..], &["--machine-only"]].concat());
        assert_eq!(machine.status, 0, "{target}: {}", machine.err);
    }
    for target in ["sinumerik", "fanuc", "linuxcnc", "csv"] {
        let out = folder.path(target);
        let words =
            ["compensate", "tables", gantry, "--target", target, "--temperature", warm, "-o", &out];
        let ran = trueaxis(&[&words[..], &["--format", "json"]].concat());
        assert_eq!(ran.status, 0, "{target}: {}", ran.err);
    }
}

/// A program that asks for JSON gets one document, also where nothing can be computed.
#[test]
fn values_that_are_refused_are_a_document_too() {
    let folder = Folder::new("compensate-refused");
    let broken = folder.file("machine.toml", "[machine]\nname = \"m\"\n");
    let ran = trueaxis(&["compensate", "values", &broken, "--axis", "X", "--format", "json"]);
    assert_eq!(ran.status, 2, "{}", ran.err);
    assert_eq!(ran.json()["schema"], "trueaxis/refused/1");
    assert_eq!(ran.json()["diagnostics"][0]["code"], "missing-key");
    let sound = trueaxis(&["compensate", "values", MILL, "--axis", "X", "--format", "json"]);
    assert!(sound.json()["diagnostics"].is_array(), "every document has that key: {}", sound.out);
}

/// The machine alone compensated makes a warm part worse: the warning advises the other values, whichever way they were left out.
#[test]
fn the_warning_about_the_machine_alone_advises_what_was_not_asked() {
    let gantry = "machines/gantry-001/machine.toml";
    let warm = "scale_x=30.5 scale_y=31.2 scale_z=30.8 workpiece=30.8";
    let at = [
        "compensate",
        "values",
        gantry,
        "--at",
        "X=3500",
        "--temperature",
        warm,
        "--format",
        "csv",
    ];
    let of = |more: &[&str]| trueaxis(&[&at[..], more].concat()).err;
    for ask in [&["--machine-only"][..], &["--of", "machine"]] {
        assert!(of(ask).contains("hint: use --of comprehensive"), "{}", of(ask));
    }
    assert!(of(&[]).contains("hint: these values are of the comprehensive error"), "{}", of(&[]));
}
