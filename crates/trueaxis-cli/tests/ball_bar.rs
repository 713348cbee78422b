//! A ball-bar from its virtual readings to the machine file, against `identify` of the same readings.

mod command;

use command::{Folder, trueaxis};
use serde_json::Value;

const HEAD: &str =
    "[machine]\nname = \"m\"\nchain = \"w X' Y' b Z t\"\n[tool]\nlength = \"100 mm\"\n";

const CAMPAIGN: &str = "name = \"circle of a ball-bar\"\nmachine = \"m.toml\"\n[unknown]\nlocation = [\"EC0X\"]\n\
    [unknown.motion]\nEXX = \"polynomial 1 + reversal\"\nEYY = \"polynomial 1 + reversal\"\n\
    [instrument.bar]\nkind = \"ball-bar\"\nspindle_ball = \"0 0 -100 mm\"\ntable_ball = \"0 0 0 mm\"\n\
    length = \"150 mm\"\nnoise = \"0.3 um\"\nreadings = \"out/bar.csv\"\n\
    [[path]]\nkind = \"circle\"\nplane = \"XY\"\ncount = 180\n[truth]\nmachine = \"truth.toml\"\nseed = 5\n";

/// The readings of the campaign, over the angle.
fn polar(readings: &str) -> String {
    let mut text = "angle_deg,radius_mm,direction\n".to_owned();
    let rows = readings.lines().filter(|l| !l.starts_with('#')).skip(1);
    for (k, row) in rows.enumerate() {
        let cells: Vec<f64> = row.split(',').map(|c| c.parse().expect("a number")).collect();
        let angle = cells[1].atan2(cells[0]).to_degrees();
        // First counter-clockwise, 180 steps, then back.
        let word = if k < 181 { "ccw" } else { "cw" };
        text += &format!("{angle},{},{word}\n", cells[6]);
    }
    text
}

fn of<'a>(list: &'a Value, key: &str, name: &str) -> &'a Value {
    let list = list.as_array().expect("a list");
    list.iter().find(|e| e[key] == name).unwrap_or_else(|| panic!("no {name} in {list:?}"))
}

#[test]
fn the_squareness_that_is_written_is_that_of_identify() {
    let folder = Folder::new("ball-bar-identify");
    let machine = folder.file("m.toml", HEAD);
    folder.file(
        "truth.toml",
        format!(
            "{HEAD}[location]\nEC0X = \"35 urad\"\n[motion.X]\nEXX = {{ polynomial = [\"0 um\", \"5 um\"], \
             scale = \"150 mm\", reversal = \"2 um\" }}\n[motion.Y]\nEYY = {{ polynomial = [\"0 um\", \"-3 um\"], \
             scale = \"150 mm\", reversal = \"-1.5 um\" }}\n"
        ),
    );
    let campaign = folder.file("c.toml", CAMPAIGN);
    assert_eq!(trueaxis(&["measure", &campaign, "-o", &folder.path("out")]).status, 0);
    let identified = trueaxis(&["identify", &campaign, "--format", "json"]).json();
    let readings = std::fs::read_to_string(folder.path("out/bar.csv")).expect("readings");
    let data = folder.file("bar.csv", polar(&readings));
    folder.file("bar.toml", "[circle]\nradius = \"150 mm\"\nplane = \"XY\"\nat = \"Z=100\"\n");
    let new = folder.path("new.toml");
    let arguments =
        ["evaluate", "iso230-4", &data, "--machine", &machine, "-o", &new, "--format", "json"];
    let ran = trueaxis(&arguments);
    assert_eq!(ran.status, 0, "{}", ran.err);
    let found = ran.json();
    let cause = of(&found["diagnosis"]["causes"], "cause", "squareness");
    let (value, expanded) =
        (cause["value_urad"].as_f64().unwrap(), cause["U_urad"].as_f64().unwrap());
    // An axis that carries the workpiece: closer than 90 deg by +35 urad.
    assert!((value - 35.0).abs() <= expanded, "{value} ± {expanded}");
    let error = of(&identified["errors"], "name", "EC0X");
    let number = |key: &str| error[key].as_f64().unwrap_or_else(|| panic!("{error}"));
    let (other, other_u) = (number("value_urad"), number("u_urad"));
    assert!((value - other).abs() <= expanded.hypot(2.0 * other_u), "{value}, identify {other}");
    // The reversals too: identify reads the same table by another model.
    for (axis, put_in) in [("X", 2.0), ("Y", -1.5)] {
        let name = format!("E{axis}{axis}");
        let error = of(&identified["errors"], "name", &format!("{name} reversal"));
        let written =
            of(&found["machine_errors"]["written"], "error", &name)["value"].as_str().unwrap();
        let reversal = written.split_once("reversal = \"").unwrap().1.split(' ').next().unwrap();
        let reversal: f64 = reversal.parse().unwrap();
        let other = error["value_um"].as_f64().unwrap();
        assert!((reversal - other).abs() < 0.1, "{name}: {reversal}, identify {other}");
        assert!((reversal - put_in).abs() < 0.25, "{name}: {reversal}, put in {put_in}");
    }
    assert!(std::fs::read_to_string(&new).expect("a machine file").contains("EC0X = \"34."));
    let after = of(&found["machine_errors"]["compared"], "cause", "squareness");
    assert!((after["after"].as_f64().unwrap() - value).abs() < 0.05);
    // What a person has changed since is not replaced; the same is.
    assert_eq!(trueaxis(&arguments).status, 0);
    folder.file("new.toml", "# mine\n");
    let refused = trueaxis(&arguments);
    assert_eq!(refused.status, 2);
    assert!(refused.err.contains("unwritable-file"), "{}", refused.err);
    assert_eq!(std::fs::read_to_string(&new).expect("kept"), "# mine\n");
}

/// The example: German words, decimal commas, blocks, Windows-1252; the causes are those that oracles/ball_bar.py put in.
#[test]
fn oracle_the_export_in_german_has_the_causes_that_were_put_in() {
    let data = "examples/07_verify/ball-bar-export.csv";
    let found = trueaxis(&["evaluate", "iso230-4", data, "--format", "json"]).json();
    let causes = found["diagnosis"]["causes"].as_array().expect("causes");
    for (cause, axis, key, value) in [
        ("squareness", None, "urad", 31.0),
        ("scale-mismatch", None, "um", 6.0),
        ("servo-mismatch", None, "um", 3.0),
        ("backlash", Some("X"), "um", -2.4),
        ("backlash", Some("Y"), "um", -1.5),
        ("lateral-play", Some("X"), "um", 1.2),
        ("straightness", Some("X"), "um", 4.0),
    ] {
        let is_it = |c: &&Value| c["cause"] == cause && c["axis"].as_str() == axis;
        let found = causes.iter().find(is_it).unwrap_or_else(|| panic!("{cause}"));
        let is = found[format!("value_{key}")].as_f64().unwrap();
        assert!((is - value).abs() < 0.15 + 0.01 * value.abs(), "{cause}: {is}, not {value}");
    }
    let shares: f64 = causes.iter().map(|c| c["share_percent"].as_f64().unwrap()).sum();
    assert!((shares - 100.0).abs() < 1e-9);
    assert_eq!(causes[0]["cause"], "squareness");
}

#[test]
fn tolerances_decide_the_exit_status() {
    let data = "examples/07_verify/x-axis-laser.csv";
    for (tolerance, more, status, word) in [
        ("A=16 um", &[][..], 0, "conforming"),
        ("R=5 um", &[][..], 1, "not conforming"),
        ("E=10 um", &[][..], 1, "neither proved"),
        ("E=10 um", &["--rule", "simple"][..], 0, "conforming"),
        ("P=13 um", &[][..], 1, "neither proved"),
    ] {
        let arguments =
            [&["evaluate", "iso230-2", data, "--tolerance", tolerance, "--format", "json"], more]
                .concat();
        let ran = trueaxis(&arguments);
        assert_eq!(ran.status, status, "{tolerance}: {}", ran.err);
        assert_eq!(ran.json()["decisions"]["decision"], word, "{tolerance}");
    }
    let unknown = trueaxis(&["evaluate", "iso230-2", data, "--tolerance", "Q=1 um"]);
    assert!(unknown.status == 2 && unknown.err.contains("unknown-figure"));
}

#[test]
fn a_history_finds_the_jump() {
    let ran = trueaxis(&["verify", "--history", "examples/07_verify/history", "--format", "json"]);
    assert_eq!(ran.status, 1, "{}", ran.err);
    let found = ran.json();
    let series = of(&found["series"], "figure", "EC0X");
    // 32.1 − 19.4 µrad, U = 2 √(2² + 2²)
    let jump = &series["jumps"][0];
    assert!((jump["change"].as_f64().unwrap() - 12.7).abs() < 1e-9);
    assert!((jump["U"].as_f64().unwrap() - 32_f64.sqrt()).abs() < 1e-9);
    assert_eq!(jump["to"], "2026-03-09");
    // Of two documents of evaluate, by their dates.
    let folder = Folder::new("history");
    let data = "examples/07_verify/ball-bar-export.csv";
    let text = trueaxis(&["evaluate", "iso230-4", data, "--format", "json"]).out;
    let first = folder.file("a.json", text.replace("2026-11-24", "2025-11-24"));
    let second = folder.file("b.json", text.replace("three-axis mill", "other"));
    let ran = trueaxis(&["verify", "--history", &first, &second]);
    assert!(ran.status == 2 && ran.err.contains("other-machine"), "{}", ran.err);
    let second = folder.file("b.json", text);
    let ran = trueaxis(&["verify", "--history", &first, &second, "--format", "json"]);
    assert_eq!(ran.status, 0, "{}", ran.err);
    let found = ran.json();
    let series = of(&found["series"], "figure", "iso230-4 XY: squareness");
    assert_eq!(series["slope_per_year"].as_f64(), Some(0.0));
}
