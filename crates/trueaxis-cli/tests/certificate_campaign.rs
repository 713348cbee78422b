//! From a campaign to its certificate: measure, identify, compensate, certify, all by the command.

mod command;

use command::{Folder, Ran, root, trueaxis};
use serde_json::Value;
use std::fmt::Write as _;
use std::path::Path;
use trueaxis::files;
use trueaxis::machine::Machine;
use trueaxis::machine::axis::{Approach, Command};
use trueaxis::machine::compensate::{Compensator, Scope};
use trueaxis::verify::certificate::residual::ToolDeviation;

const CAMPAIGN: &str = r#"
name = "probe-ball, its socket calibrated"
machine = "mill/machine.toml"
[unknown]
location = ["EX0C", "EY0C", "EB0C", "EY0A", "EZ0A", "EA0A", "EB0A", "EC0A", "EC0X", "EA0Z", "EB0Z"]
[instrument.probe]
kind = "probe-ball"
socket = "0 0 -330 mm"
ball = "0 0 0 mm"
noise = "1 um"
unknown = { ball = "free", socket = "0.1 um" }
readings = "readings/probe.csv"
[[path]]
kind = "random"
count = 60
seed = 4
A = ["-80 deg", "80 deg"]
C = ["-170 deg", "170 deg"]
[truth]
setup = { ball_x = "0.021 mm", ball_y = "-0.034 mm", ball_z = "0.012 mm" }
seed = 17
"#;

const STUDY: &str = r#"
name = "Lei-Hsu mill: compensated programs"
machine = "machine.toml"
[determination]
method = "probe-ball"
date = 2026-11-21
by = "not named"
instrument = "probe"
calibration = "none"
temperature = "20 ± 0.1 degC"
campaign = "campaign.toml"
[compensation]
kind = "program"
[validation]
method = "R-test on other poses"
date = 2026-11-22
by = "not named"
instrument = "R-test"
calibration = "none"
temperature = "20 ± 0.1 degC"
before = "before.csv"
after = "after.csv"
zero = "A=20 C=10 X=250 Y=200 Z=-200"
u = "0.5 um"
[decision]
limit = "5 um"
"#;

/// A folder with the actual mill, a campaign on it, and the study.
fn workshop(name: &str) -> Folder {
    let folder = Folder::new(name);
    std::fs::create_dir_all(folder.path("mill")).expect("a folder");
    let mill = root().join("machines/lei-hsu-mill/machine.toml");
    let mut text = std::fs::read_to_string(mill).expect("the mill");
    // The zero of the readings takes the place of the workpiece out, but nothing is known exactly.
    for (error, value) in [("EX0w", "6"), ("EY0w", "-4"), ("EZ0w", "8")] {
        let stated = format!("{error} = \"{value} um\"");
        assert!(text.contains(&stated), "{stated}");
        text = text.replace(&stated, &format!("{error} = \"{value} ± 0.2 um\""));
    }
    folder.file("mill/machine.toml", text);
    folder.file("campaign.toml", CAMPAIGN);
    folder.file("study.toml", STUDY);
    folder
}

fn machine(path: &str) -> Machine {
    let (machine, problems) = files::machine(Path::new(path));
    machine.unwrap_or_else(|| panic!("{problems:?}"))
}

/// What an instrument without noise reads on the real machine, before and after the compensation.
fn readings(real: &Machine, identified: &Machine) -> [String; 2] {
    let compensator = Compensator::of(identified, Scope::Pose).expect("three axes");
    let still = Approach::default();
    let off = |q: &Command, is_compensated: bool| {
        let at = match is_compensated {
            true => compensator.at(q, &still).expect("a pose").command,
            false => *q,
        };
        ToolDeviation::of(real, &at, &real.errors_at(&at, &still).expect("no tables"), q).tip_mm
    };
    let inner =
        |[c, a, x, y, z]: [f64; 5]| -> Command { [c.to_radians(), a.to_radians(), x, y, z, 0.0] };
    let zero = inner([10.0, 20.0, 250.0, 200.0, -200.0]);
    [false, true].map(|is_compensated| {
        let mut text = "C,A,X,Y,Z,x_um,y_um,z_um\n".to_owned();
        for k in 0..16 {
            let k = f64::from(k);
            let q = [
                20.0 * k - 155.0,
                8.0 * k - 62.5,
                200.0 + 7.0 * k,
                240.0 - 5.0 * k,
                -220.0 + 3.0 * k,
            ];
            let d = (off(&inner(q), is_compensated) - off(&zero, is_compensated)) * 1e3;
            let [c, a, x, y, z] = q;
            writeln!(text, "{c},{a},{x},{y},{z},{},{},{}", d.x, d.y, d.z).expect("a text");
        }
        text
    })
}

/// Measures and identifies; what `identify` says.
fn identified(folder: &Folder) -> Ran {
    let campaign = folder.path("campaign.toml");
    let ran = trueaxis(&["measure", &campaign, "-o", &folder.path("readings")]);
    assert_eq!(ran.status, 0, "{}", ran.err);
    trueaxis(&["identify", &campaign, "-o", &folder.path("machine.toml")])
}

fn certified(folder: &Folder) -> Ran {
    let (real, known) =
        (machine(&folder.path("mill/machine.toml")), machine(&folder.path("machine.toml")));
    let [before, after] = readings(&real, &known);
    folder.file("before.csv", before);
    folder.file("after.csv", after);
    trueaxis(&["verify", "--certificate", &folder.path("study.toml"), "--format", "json"])
}

/// The largest predicted U of a coordinate, µm.
fn largest_u(found: &Value) -> f64 {
    let poses = found["validation"]["poses"].as_array().expect("poses");
    let all = poses.iter().flat_map(|p| p["expanded_predicted_um"].as_array().expect("x y z"));
    all.map(|v| v.as_f64().expect("a number")).fold(0.0, f64::max)
}

#[test]
fn a_campaign_is_evaluated_again_with_all_its_correlations() {
    let folder = workshop("certificate-campaign");
    assert_eq!(identified(&folder).status, 0);
    let ran = certified(&folder);
    assert_eq!(ran.status, 0, "{}{}", ran.err, ran.out);
    let found = ran.json();
    let determination = &found["determination"];
    assert_eq!(determination["poses_used"], 60);
    assert_eq!(determination["uncertainties_from"]["terms"], 11);
    for state in ["before", "after"] {
        assert_eq!(found["validation"]["agreement"][state]["holds"], true);
    }
    // EY0A is known to 1.0 µm and EA0Z to 3.6 µrad, but together (0.985): a machine file alone, which cannot say
    // so, leaves far more open.
    let study = STUDY.replace("campaign = \"campaign.toml\"", "used = [\"readings/probe.csv\"]");
    let alone = folder.file("alone.toml", study);
    let ran = trueaxis(&["verify", "--certificate", &alone, "--format", "json"]);
    assert_eq!(ran.status, 0, "{}", ran.err);
    let [together, alone] = [&found, &ran.json()].map(largest_u);
    assert!(together < 2.0 && alone > 3.0 * together, "{together} {alone}");
    let names: Vec<_> =
        found["inputs"].as_array().expect("inputs").iter().map(|i| i["name"].clone()).collect();
    let due = [
        "study.toml",
        "machine.toml",
        "campaign.toml",
        "mill/machine.toml",
        "readings/probe.csv",
        "before.csv",
        "after.csv",
    ];
    assert_eq!(names, due);

    // A machine file that is not what the campaign finds.
    let path = folder.path("machine.toml");
    let text = std::fs::read_to_string(&path).expect("the machine");
    let line = text.lines().find(|l| l.starts_with("EB0C")).expect("EB0C");
    std::fs::write(&path, text.replace(line, "EB0C = \"60 ± 3 urad\"")).expect("written");
    let ran = trueaxis(&["verify", "--certificate", &folder.path("study.toml")]);
    assert_eq!(ran.status, 2);
    for word in ["other-identification", "EB0C is 60.000 µrad", "study.toml"] {
        assert!(ran.err.contains(word), "no {word} in {}", ran.err);
    }
}

#[test]
fn a_pose_of_the_campaign_proves_nothing() {
    let folder = workshop("certificate-campaign-used");
    assert_eq!(identified(&folder).status, 0);
    let used = std::fs::read_to_string(folder.path("readings/probe.csv")).expect("readings");
    let row = used.lines().nth(2).expect("a row");
    let pose = row.split(',').take(5).collect::<Vec<_>>().join(",");
    let known = machine(&folder.path("machine.toml"));
    for (name, text) in ["before.csv", "after.csv"].iter().zip(readings(&known, &known)) {
        folder.file(name, text + &pose + ",0,0,0\n");
    }
    let ran = trueaxis(&["verify", "--certificate", &folder.path("study.toml")]);
    assert_eq!(ran.status, 2);
    for word in ["used-pose", "after.csv:18", "probe.csv:3"] {
        assert!(ran.err.contains(word), "no {word} in {}", ran.err);
    }
}

/// Where the socket sits is not known: EX0C cannot be separated from it, and the remaining uncertainty is not known.
#[test]
fn what_a_campaign_cannot_tell_is_not_certified() {
    let folder = workshop("certificate-campaign-unseen");
    let free = CAMPAIGN.replace("socket = \"0.1 um\"", "socket = \"free\"");
    let free = free.replace(
        "ball_z = \"0.012 mm\"",
        "ball_z = \"0.012 mm\", socket_x = \"0 mm\", socket_y = \"0 mm\", socket_z = \"0 mm\"",
    );
    folder.file("campaign.toml", free);
    assert_eq!(identified(&folder).status, 0);
    let ran = certified(&folder);
    assert_eq!(ran.status, 2);
    for word in ["not-identified", "EX0C + probe.socket_x", "resolved by"] {
        assert!(ran.err.contains(word), "no {word} in {}", ran.err);
    }
}
