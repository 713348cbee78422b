//! `trueaxis identify rtcp` as a user sees it, with good files and spoilt ones.

mod command;

use command::{Folder, root, trueaxis};

const EXAMPLE: &str = "examples/05_identify/rtcp-engraver.toml";

fn machine(name: &str) -> String {
    root().join("machines").join(name).join("machine.toml").display().to_string()
}

/// A study of one table with RTCP on.
fn study(machine_name: &str, set: &str, rest: &str) -> String {
    format!(
        "name = 'n'\nmachine = '{}'\nerrors = 'none'\n{rest}\n[readings.r]\nrtcp = true\n\
         indicator = 'spindle'\nball = '10 0 20 mm'\nnoise = '1 um'\ntable = 't.csv'\n{set}\n",
        machine(machine_name)
    )
}

/// Poses of two rotary axes with readings of an exact machine.
fn table() -> String {
    let mut text = "A,C,x_um,y_um,z_um\n".to_owned();
    for a in [-60, 0, 60] {
        for c in [0, 90, 180, 270] {
            text += &format!("{a},{c},0.3,-0.2,0.1\n");
        }
    }
    text
}

/// The command ends with `status` and tells `code` with the words.
#[track_caller]
fn reported(folder: &Folder, study: &str, table: &str, status: i32, code: &str, words: &str) {
    folder.file("t.csv", table);
    let file = folder.file("study.toml", study);
    let ran = trueaxis(&["identify", "rtcp", &file, "--format", "json"]);
    assert_eq!(ran.status, status, "{study}\n{}", ran.err);
    if status == 2 {
        assert!(ran.has_no_answer());
    }
    let block = ran.err.split("\n\n").find(|b| b.contains(&format!("[{code}]")));
    let block = block.unwrap_or_else(|| panic!("{code} is not reported:\n{}", ran.err));
    assert!(block.contains(words), "`{words}` is not in\n{block}");
}

#[test]
fn the_document_has_the_agreed_keys() {
    let ran = trueaxis(&["identify", "rtcp", EXAMPLE, "--format", "json"]);
    assert_eq!(ran.status, 0, "{}", ran.err);
    let found = ran.json();
    assert_eq!(found["schema"], "trueaxis/identify-rtcp/1");
    assert_eq!(found["topology"], "table-table");
    let names: Vec<&str> = (0..4).map(|k| found["numbers"][k]["name"].as_str().unwrap()).collect();
    assert_eq!(names, ["RTCP_OFFSET1_X", "RTCP_OFFSET1_Y", "RTCP_OFFSET1_Z", "RTCP_OFFSET2_Y"]);
    let new = found["numbers"][3]["new_mm"].as_f64().unwrap();
    let u = found["numbers"][3]["u_um"].as_f64().unwrap();
    assert!((new + 0.0094).abs() < 3e-3 * u, "{new} {u}");
    assert!(found["forecast"]["before"]["worst_um"].as_f64().unwrap() > 50.0);
    let text = trueaxis(&["identify", "rtcp", EXAMPLE]).out;
    for words in ["RTCP_OFFSET2_Y", "yes: all 4 offsets found", "U =", "worst: examples/"] {
        assert!(text.contains(words), "{words}\n{text}");
    }
}

#[test]
fn machine_file_and_programs() {
    let folder = Folder::new("rtcp-out");
    let output = folder.path("engraver.toml");
    let ran = trueaxis(&["identify", "rtcp", EXAMPLE, "-o", &output]);
    assert_eq!(ran.status, 0, "{}", ran.err);
    let text = std::fs::read_to_string(&output).unwrap();
    assert!(text.contains("RTCP calibration (RTCP of the i5 engraving centre)"), "{text}");
    assert_eq!(trueaxis(&["check", &output]).status, 0);
    // The input is not overwritten.
    let ran = trueaxis(&["identify", "rtcp", EXAMPLE, "-o", EXAMPLE]);
    assert!(ran.status == 2 && ran.err.contains("[unwritable-file]"), "{}", ran.err);

    let programs = folder.path("nc");
    for dialect in ["fanuc", "sinumerik", "heidenhain", "linuxcnc"] {
        let arguments = ["identify", "rtcp", EXAMPLE, "--programs", &programs];
        let ran = trueaxis(&[&arguments[..], &["--control", dialect, "--format", "json"]].concat());
        assert_eq!(ran.status, 0, "{}", ran.err);
        let reported = ran.json();
        for k in 0..4 {
            let off = reported["programs"][k]["off_poses_um"].as_f64().unwrap();
            assert!(off < 0.2, "{dialect}: {reported}");
        }
    }
    let text = std::fs::read_to_string(folder.path("nc/04-a-axis-rtcp.nc")).unwrap();
    assert!(text.contains("G43.4") && text.contains("M0") && text.contains("READ 21:"), "{text}");
}

#[test]
fn poses_without_readings_are_enough_for_programs() {
    let folder = Folder::new("rtcp-poses");
    let poses = "A,C\n0,0\n30,0\n";
    folder.file("t.csv", poses);
    let file = folder.file("study.toml", study("i5-engraver", "", ""));
    let programs = folder.path("nc");
    let ran = trueaxis(&["identify", "rtcp", &file, "--programs", &programs]);
    assert_eq!(ran.status, 0, "{}", ran.err);
    let study = study("i5-engraver", "", "");
    reported(&folder, &study, poses, 2, "missing-column", "the table has no reading");
}

#[test]
fn what_no_reading_tells_is_said() {
    let folder = Folder::new("rtcp-unseen");
    // C alone is turned.
    folder.file("t.csv", "A,C,x_um,y_um,z_um\n0,0,1,2,0\n0,90,2,1,0\n0,180,-1,0,0\n0,270,0,-2,0\n");
    let control = "[control]\nnames = 'fanuc'";
    let file = folder.file("study.toml", study("i5-engraver", "", control));
    let ran = trueaxis(&["identify", "rtcp", &file, "--format", "json"]);
    let found = ran.json();
    let by_name = |name: &str| {
        let all = found["numbers"].as_array().unwrap().clone();
        all.into_iter().find(|n| n["name"] == name).unwrap()
    };
    assert!(by_name("19700")["new_mm"].is_number() && by_name("19702")["new_mm"].is_null());
    assert!(found["forecast"].is_null());
    let words = found["unobservable"].to_string();
    assert!(words.contains("A is not turned"), "{words}");
    assert!(found["verdict"].as_str().unwrap().starts_with("in part"), "{found}");
}

#[test]
fn readings_that_fit_better_than_their_noise_are_doubted() {
    let folder = Folder::new("rtcp-below-noise");
    let plain = study("i5-engraver", "", "");
    let words = "of the noise: no indicator reads so well";
    reported(&folder, &plain, &table(), 0, "small-readings", words);
    // As they scatter by their noise, nothing is said.
    let mut seed = 1_u32;
    let scattered = table().replace("0.3,-0.2,0.1", "scattered");
    let rows = scattered.split("scattered").map(|row| {
        let mut next = || {
            seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            f64::from(seed >> 16) / 65536.0 * 3.4 - 1.7
        };
        (row.to_owned(), format!("{:.3},{:.3},{:.3}", next(), next(), next()))
    });
    let rows: Vec<_> = rows.collect();
    let last = rows.len() - 1;
    let text: String = rows.iter().enumerate().fold(String::new(), |text, (i, (row, read))| {
        text + row + if i < last { read } else { "" }
    });
    folder.file("t.csv", text);
    let ran = trueaxis(&["identify", "rtcp", &folder.file("study.toml", plain)]);
    assert_eq!(ran.status, 0, "{}", ran.out);
    assert!(!ran.err.contains("small-readings"), "{}", ran.err);
}

#[test]
fn readings_that_do_not_fit() {
    let folder = Folder::new("rtcp-noise");
    // Noise is 1 µm, and these scatter by 20.
    let wild = table().replace("0,90,0.3", "0,90,20.3").replace("60,270,0.3", "60,270,-20.3");
    folder.file("t.csv", wild);
    let file = folder.file("study.toml", study("i5-engraver", "", ""));
    let ran = trueaxis(&["identify", "rtcp", &file]);
    assert_eq!(ran.status, 1, "{}", ran.out);
    assert!(ran.out.contains("no: the readings differ from the model"), "{}", ran.out);
    assert!(ran.out.contains("t.csv:"), "{}", ran.out);
}

#[test]
fn spoilt_files() {
    let folder = Folder::new("rtcp-bad");
    let good = || study("i5-engraver", "", "");
    let with = |set: &str, rest: &str| study("i5-engraver", set, rest);
    let i5 = "[control]\nnames = 'i5'\n";
    let still = "A,C,x_um\n30,0,1\n30,0,2\n";
    let radians = "A,C,x_um,y_um\n0,0,1,2\n1.5,3,4,5\n-1.5,6,5,4\n0,3,2,1\n";
    for (study, table, code, words) in [
        (study("three-axis-mill", "", ""), table(), "no-centres", "0 rotary axes"),
        (study("gantry-001", "", ""), table(), "no-centres", "rotary"),
        (good(), "C,x_um\n0,1\n90,2\n".into(), "missing-column", "where did A stand?"),
        (good(), still.into(), "no-turned-poses", "no rotary axis is turned"),
        (good(), table().replacen("0.3", "NaN", 1), "not-a-number", "t.csv"),
        (good(), table().replacen("0.3", "1e999", 1), "not-a-number", "t.csv"),
        (good(), table().replacen("0.3", "1e300", 1), "too-large", "t.csv:2"),
        (good(), table().replacen("-60,0", "1e300,0", 1), "too-large", "t.csv:2"),
        (good(), table().replace("x_um", "x_urad"), "wrong-unit", "urad"),
        (
            good(),
            table().replace("x_um", "x_mm").replace(",0.3,", ",30,"),
            "impossible-value",
            "t.csv:2",
        ),
        (good(), table().replace("x_um", "x_furlong"), "unknown-unit", "furlong"),
        (good(), table()[..table().len() - 12].to_owned(), "ragged-row", "t.csv"),
        (good(), String::new(), "empty-table", "no line of headings"),
        (good(), "A,C,x_um\n".into(), "bad-count", "0 rows"),
        (good().replace("'1 um'", "'0 um'"), table(), "no-noise", "without noise"),
        (good().replace("'spindle'", "'wall'"), table(), "unknown-choice", "wall"),
        (good().replace("ball = '10 0 20 mm'", ""), table(), "missing-key", "ball"),
        (good().replace("'t.csv'", "'none.csv'"), table(), "unreadable-file", "none.csv"),
        (with("", "[control]\nnames = 'mazak'"), table(), "unknown-control", "mazak"),
        (
            study("xkas2525", "", "[control]\nnames = 'linuxcnc'"),
            table(),
            "unfit-control",
            "5axiskins",
        ),
        (with("", &format!("{i5}[control.now]\nX = '1 mm'")), table(), "unknown-key", "`X`"),
        (with("now = { RTCP_OFFSET1_X = '1 mm' }", ""), table(), "missing-key", "whose numbers"),
        (
            with("", &format!("{i5}[control.now]\nRTCP_OFFSET1_X = '1 deg'")),
            table(),
            "wrong-unit",
            "deg",
        ),
        (with("colour = 'red'", ""), table(), "unknown-key", "colour"),
    ] {
        reported(&folder, &study, &table, 2, code, words);
    }
    for (study, table, code, words) in [
        (good(), radians.to_owned(), "little-turned", "in rad"),
        (good(), table().replace(",0.3,", ",9000,"), "large-reading", "unit"),
        (
            good(),
            table().replace("0.3,-0.2,0.1", "0.0003,-0.0002,0.0001"),
            "small-readings",
            "mm under a heading in µm",
        ),
        (good(), table().replace("A,C,", "A,C,X,").replace(",0.3", ",7,0.3"), "unused-column", "X"),
        (good().replace("10 0 20", "10 0 900"), table(), "outside-travel", "outside its travel"),
        (
            with("", &format!("{i5}zero = 'tip'\n[control.now]\nRTCP_OFFSET1_Z = '90 mm'")),
            table(),
            "far-from-machine-file",
            "90.000 mm",
        ),
    ] {
        folder.file("t.csv", &table);
        let file = folder.file("study.toml", &study);
        let ran = trueaxis(&["identify", "rtcp", &file, "--format", "json"]);
        assert!(ran.status < 2, "{study}\n{}", ran.err);
        let block = ran.err.split("\n\n").find(|b| b.contains(&format!("[{code}]")));
        let block = block.unwrap_or_else(|| panic!("{code} is not reported:\n{}", ran.err));
        assert!(block.contains(words), "`{words}` is not in\n{block}");
    }
    // Cut off anywhere, neither file does harm.
    let (study, table) = (good(), table());
    for k in 0..12 {
        folder.file("t.csv", &table[..table.len() * k / 12]);
        let file = folder.file("study.toml", &study[..study.len() * (12 - k) / 12]);
        assert!(trueaxis(&["identify", "rtcp", &file]).status <= 2);
    }
}
