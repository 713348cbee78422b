//! The set-up of a test piece: programs, readings that a person fills in, and what they do to the prediction.

mod command;

use command::{Folder, trueaxis};
use std::fs;

const MACHINE: &str = "machines/xkas2525/machine.toml";
const PIECE: &str = "testpieces/nas979-gbt33150.toml";

fn post(folder: &Folder, control: &str) -> (i32, String) {
    let (program, set_up) = (folder.path("cone.nc"), folder.path("set-up"));
    let ran = trueaxis(&[
        "post",
        MACHINE,
        PIECE,
        "--control",
        control,
        "-o",
        &program,
        "--verify",
        "--set-up",
        &set_up,
    ]);
    (ran.status, ran.err)
}

#[test]
fn every_control_gets_its_programs_and_readings_are_never_overwritten() {
    for (control, extension) in
        [("sinumerik", "mpf"), ("fanuc", "nc"), ("heidenhain", "h"), ("linuxcnc", "ngc")]
    {
        let folder = Folder::new(&format!("set-up-{control}"));
        let (status, err) = post(&folder, control);
        assert_eq!(status, 0, "{control}: {err}");
        let read = |name: &str| {
            fs::read_to_string(folder.path(&format!("set-up/{name}"))).expect("a file")
        };
        let hole = read(&format!("3-hole.{extension}"));
        // Table 3: 15 mm/min, 600 1/min; 40 mm deep.
        assert!(hole.contains("S600") && hole.contains("F15"), "{hole}");
        assert!(hole.contains("-40"), "{hole}");
        for name in ["1-length", "2-centre"] {
            let stop = read(&format!("{name}.{extension}"));
            let lines: Vec<&str> = stop.lines().collect();
            let is_stop =
                |l: &&str| l.split_whitespace().any(|w| ["M0", "M00", "STOP"].contains(&w));
            let at = lines.iter().position(is_stop).expect("a stop");
            // It stops 100 mm above the piece, before it goes on.
            let reaches = |lines: &[&str], z: &str| {
                lines.iter().any(|l| l.contains(&format!("Z{z}")) || l.contains(&format!("Z+{z}")))
            };
            assert!(reaches(&lines[at - 3..at], "100") && reaches(&lines[at..], "105"), "{stop}");
        }
        let path = folder.path("set-up/set-up.toml");
        fs::write(&path, "# filled in by hand").expect("written");
        let (status, err) = post(&folder, control);
        assert_eq!(status, 2, "{err}");
        assert!(err.contains("set-up.toml") && err.contains("--force"), "{err}");
        assert_eq!(fs::read_to_string(&path).expect("a file"), "# filled in by hand");
    }
}

#[test]
fn a_set_up_needs_a_test_piece_that_states_one() {
    let folder = Folder::new("set-up-none");
    let (program, set_up) = (folder.path("plate.nc"), folder.path("set-up"));
    let ran = trueaxis(&[
        "post",
        "machines/i5-engraver/machine.toml",
        "examples/06_compensate/bangle.cls",
        "--control",
        "fanuc",
        "-o",
        &program,
        "--set-up",
        &set_up,
    ]);
    assert!(ran.status == 2 && ran.err.contains("no-set-up"), "{}", ran.err);
}

/// The study of the example with other readings, and the error that they make.
fn ask(folder: &Folder, readings: &str, more: &str) -> command::Ran {
    let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let here = format!("{}/", root.display());
    let study = fs::read_to_string(root.join("examples/03_predict/nas979-set-up.toml"));
    let study = study.expect("the study").replace("../../", &here);
    let study = study.replace("nas979-set-up-readings.toml", "readings.toml");
    let study = match readings.is_empty() {
        true => study.replace("set_up = \"readings.toml\"\n", ""),
        false => study,
    };
    fs::write(folder.path("readings.toml"), readings).expect("written");
    let path = folder.path("study.toml");
    fs::write(&path, study + more).expect("written");
    trueaxis(&["predict", &path, "--no-report", "--format", "json"])
}

fn length(tip_mm: f64, entered: &str, u: &str) -> String {
    format!(
        "[length]\nentered = \"{entered}\"\ninclination = \"10 deg\"\nface = [\"-512.404 mm\"]\n\
         face_radius = \"30 mm\"\ntip = [\"{tip_mm:.7} mm\"]\ntip_radius = \"10 mm\"\nu = \"{u}\"\n"
    )
}

/// Where the dial shows the same under a tool of this length: L cos β + (r_tip − r_face) sin β further up.
fn tip_mm(length_mm: f64) -> f64 {
    let tilt = 10f64.to_radians();
    -512.404 + length_mm * tilt.cos() - 20.0 * tilt.sin()
}

/// The readings of a tool that is 12 µm too short are an error EZ0t of +12 µm with u √2 · 2 µm / cos 10°.
#[test]
fn law_the_readings_are_the_error_that_they_mean() {
    let folder = Folder::new("set-up-law");
    let by_readings = ask(&folder, &length(tip_mm(99.988), "100 mm", "2 um"), "");
    assert_eq!(by_readings.status, 0, "{}", by_readings.err);
    let u_um = 2.0 * 2f64.sqrt() / 10f64.to_radians().cos();
    let stated = format!("[what_if]\nEZ0t = \"12 ± {u_um} um\"\n");
    let by_hand = ask(&folder, "", &stated);
    assert_eq!(by_hand.status, 0, "{}", by_hand.err);
    let index = |ran: &command::Ran, key: &str| {
        let found = ran.json()["indices"]["iso"][key].clone();
        [found["value"].as_f64().expect("mm"), found["u_mm"].as_f64().expect("mm")]
    };
    for key in ["roundness_mzc_mm", "coaxiality_lsc_mm", "angularity_zone_mm"] {
        let [a, b] = [&by_readings, &by_hand].map(|ran| index(ran, key));
        assert!((a[0] - b[0]).abs() < 1e-8 && (a[1] - b[1]).abs() < 1e-8, "{key}: {a:?} {b:?}");
    }
    // Without the readings the machine file counts, and the part is another one.
    let without = index(&ask(&folder, "", ""), "coaxiality_lsc_mm");
    let with = index(&by_readings, "coaxiality_lsc_mm");
    assert!((without[0] - with[0]).abs() > 1e-4, "{without:?} {with:?}");
}

#[test]
fn readings_with_a_mistake_are_refused() {
    let folder = Folder::new("set-up-bad");
    let refused = |readings: &str, words: &[&str]| {
        let ran = ask(&folder, readings, "");
        assert_eq!(ran.status, 2, "{readings}: {}", ran.err);
        words.iter().for_each(|word| assert!(ran.err.contains(word), "{word}: {}", ran.err));
    };
    let good = length(tip_mm(100.0), "100 mm", "2 um");
    refused(&good.replace("\"100 mm\"", "\"\""), &["no-readings", "entered"]);
    refused(&good.replace("[\"-512.404 mm\"]", "[]"), &["no-readings", "face"]);
    refused(&length(tip_mm(120.0), "100 mm", "2 um"), &["other-tool-length", "120."]);
    refused(
        &length(tip_mm(120.0), "120 mm", "2 um"),
        &["other-tool-length", "the study one of 100"],
    );
    refused(&good.replace(" mm\"]", "\"]"), &["missing-unit"]);
    let scattered = good.replace("[\"-512.404 mm\"]", "[\"-512.404 mm\", \"-512.284 mm\"]");
    refused(&scattered, &["scattered-readings"]);
    refused("[centre]\ndial = [\"1 um\", \"2 um\"]\nu = \"1 um\"\n", &["too-few-readings"]);
    let far = "[centre]\ndial = [\"1 mm\", \"0 mm\", \"-1 mm\", \"0 mm\"]\nu = \"1 um\"\n";
    refused(far, &["other-zero"]);
    let ran = ask(&folder, &good, "[what_if]\nEZ0t = \"3 um\"\n");
    assert!(ran.status == 2 && ran.err.contains("contradiction"), "{}", ran.err);
    // What was not filled in is not believed: the file as it was written.
    let machine = trueaxis(&[
        "post",
        MACHINE,
        PIECE,
        "--control",
        "fanuc",
        "-o",
        &folder.path("c.nc"),
        "--set-up",
        &folder.path("set-up"),
    ]);
    assert_eq!(machine.status, 0, "{}", machine.err);
    let empty = fs::read_to_string(folder.path("set-up/set-up.toml")).expect("the readings");
    refused(&empty, &["no-readings", "not filled in"]);
}

/// A program that a person edited stays, and nothing else is written either.
#[test]
fn an_edited_program_of_the_set_up_stays() {
    let folder = Folder::new("set-up-edited");
    fs::create_dir(folder.path("set-up")).expect("a folder");
    let path = folder.path("set-up/1-length.mpf");
    fs::write(&path, "; mine").expect("written");
    let (status, err) = post(&folder, "sinumerik");
    assert!(
        status == 2 && err.contains("1-length.mpf") && err.contains("was edited since"),
        "{err}"
    );
    assert_eq!(fs::read_to_string(&path).expect("a file"), "; mine");
    assert!(!std::path::Path::new(&folder.path("cone.nc")).exists());
    // One name for the program and for the folder.
    let both = folder.path("both");
    let ran = trueaxis(&[
        "post",
        MACHINE,
        PIECE,
        "--control",
        "sinumerik",
        "-o",
        &both,
        "--set-up",
        &both,
    ]);
    assert!(ran.status == 2 && ran.err.contains("one-file-twice"), "{}", ran.err);
    assert!(!std::path::Path::new(&both).exists());
}
