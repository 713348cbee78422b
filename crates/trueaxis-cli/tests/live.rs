//! `trueaxis live` as a user runs it, on its mock.

mod command;

use command::{Folder, root};
use serde_json::Value;
use std::process::{Command, Output, Stdio};
use std::thread;
use std::time::Duration;

const PLAN: &str = "examples/08_live/gantry-mock.toml";

/// The command with its journal in a folder of the test.
fn live(folder: &Folder, words: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_trueaxis"));
    command.arg("live").args(words).current_dir(root());
    command.env("XDG_STATE_HOME", folder.path("state"));
    command
}

fn ran(folder: &Folder, words: &[&str]) -> (i32, String, String) {
    let Output { status, stdout, stderr } = live(folder, words).output().expect("it starts");
    let text = |bytes| String::from_utf8(bytes).expect("UTF-8");
    let err = text(stderr);
    assert!(!err.contains("panicked at"), "{err}");
    (status.code().expect("a status"), text(stdout), err)
}

fn json(text: &str) -> Value {
    serde_json::from_str(text).unwrap_or_else(|e| panic!("{e}: {text}"))
}

#[test]
fn a_run_leaves_its_state_and_nothing_in_the_control() {
    let folder = Folder::new("live-run");
    let (status, out, err) = ran(&folder, &["status", PLAN, "--format", "json"]);
    assert_eq!(status, 0, "{err}");
    assert_eq!((&json(&out)["running"], &json(&out)["last"]), (&Value::Bool(false), &Value::Null));
    assert!(ran(&folder, &["status", PLAN]).1.contains("not running"));

    let record = folder.path("day.jsonl");
    let words = [PLAN, "--for", "3s", "--record", &record, "--format", "json"];
    let (status, out, err) = ran(&folder, &words);
    assert_eq!(status, 0, "{err}");
    for line in
        ["mock of a FANUC control at 127.0.0.1:", "Run: follows its target", "Off: not asked for"]
    {
        assert!(err.contains(line), "no `{line}` in\n{err}");
    }
    let document = json(&out);
    assert_eq!(document["schema"], "trueaxis/live-status/1");
    assert_eq!(document["last"]["state"], "off");
    assert_eq!(document["last"]["axes"][0]["own"], 0.0);
    assert!(document["last"]["writes"].as_u64() > Some(0), "{document}");

    let after = json(&ran(&folder, &["status", PLAN, "--format", "json"]).1);
    assert_eq!((&after["running"], &after["last"]["state"]), (&Value::Bool(false), &"off".into()));
    let (status, out, err) = ran(&folder, &["replay", PLAN, &record]);
    assert!(status == 0 && out.contains("the same orders"), "{out}{err}");
}

/// Two runs would write into one offset. An interrupt ends a run by its ramp.
#[cfg(unix)]
#[test]
fn a_second_run_is_refused_and_an_interrupt_ends_the_first() {
    let folder = Folder::new("live-two");
    let mut first = live(&folder, &[PLAN]);
    let first = first.stdout(Stdio::null()).stderr(Stdio::piped()).spawn().expect("it starts");
    let running = || {
        let (status, out, err) = ran(&folder, &["status", PLAN, "--format", "json"]);
        assert_eq!(status, 0, "{err}");
        let document = json(&out);
        document["running"] == true && document["last"]["state"] == "run"
    };
    for _ in 0..100 {
        if running() {
            break;
        }
        thread::sleep(Duration::from_millis(100));
    }
    assert!(running());
    let (status, _, err) = ran(&folder, &[PLAN, "--for", "1s"]);
    assert!(status == 2 && err.contains("error[live-already-running]"), "{err}");
    let id = first.id().to_string();
    assert!(Command::new("kill").args(["-INT", &id]).status().expect("kill").success());
    let ended = first.wait_with_output().expect("it ends");
    let err = String::from_utf8_lossy(&ended.stderr).into_owned();
    assert_eq!(ended.status.code(), Some(0), "{err}");
    assert!(err.contains("RampDown") || err.contains("Off: not asked for"), "{err}");
}

#[test]
fn what_is_no_plan_is_refused() {
    let folder = Folder::new("live-bad");
    let (status, out, err) = ran(&folder, &["no-such.toml", "--format", "json"]);
    assert!(status == 2 && err.contains("unreadable-file"), "{err}");
    assert_eq!(json(&out)["schema"], "trueaxis/refused/1");
    let (status, _, err) = ran(&folder, &[PLAN, "--for", "60"]);
    assert!(status == 2 && err.contains("error[bad-duration]: `60` is no time"), "{err}");
    let machine = "machines/gantry-001/machine.toml";
    let (status, _, err) = ran(&folder, &[machine]);
    assert!(status == 2 && err.contains("nothing was written to the control"), "{err}");
    let bad = folder.file("bad.jsonl", "{}\n");
    let (status, _, err) = ran(&folder, &["replay", PLAN, &bad]);
    assert!(status == 2 && err.contains("live-record"), "{err}");
}

/// A part is recorded over two runs, its record is never written over, and `predict` reads it.
#[test]
fn a_part_is_recorded_and_predicted_by_what_acted() {
    let folder = Folder::new("live-part");
    let (status, out, err) = ran(&folder, &["part", PLAN, "--begin", "ARM-0417"]);
    assert!(status == 0 && out.contains("when a run of this plan begins"), "{out}{err}");
    let show = ["part", PLAN, "--show", "ARM-0417", "--format", "json"];
    let mut rows = 0;
    for run in 1..=2 {
        // The first stop is left after 2 s.
        assert_eq!(ran(&folder, &[PLAN, "--for", "3s"]).0, 0);
        let document = json(&ran(&folder, &show).1);
        let now = document["part"]["rows"].as_u64().expect("rows");
        assert!(now > rows, "run {run}: {document}");
        assert_eq!(document["recording"], "ARM-0417");
        rows = now;
    }
    let file = json(&ran(&folder, &show).1)["part"]["file"].as_str().expect("a file").to_owned();
    let text = std::fs::read_to_string(&file).expect("the record");
    assert_eq!(text.lines().filter(|l| l.starts_with("time_s")).count(), 1, "{text}");
    for (words, says) in [
        (["part", PLAN, "--begin", "ARM-0417"], "is not written over"),
        (["part", PLAN, "--begin", "../x"], "is no name of a file"),
        (["part", PLAN, "--show", "ARM-0418"], "no part `ARM-0418`"),
    ] {
        let (status, _, err) = ran(&folder, &words);
        assert!(status == 2 && err.contains("error[live-part]") && err.contains(says), "{err}");
    }
    assert!(ran(&folder, &["part", PLAN, "--end"]).1.contains("the record of ARM-0417 ends"));
    assert!(ran(&folder, &["part", PLAN, "--end"]).1.contains("no part was recorded"));
    assert_eq!(std::fs::read_to_string(&file).expect("the record"), text);
    // Three holes around the first stop are not in it; said with the place.
    let study = "name = \"arm\"\nmachine = \"MACHINE\"\n[holes]\ncount = 3\ncircle = \"100 mm\"\n\
                 centre = \"100 100 0 mm\"\n[compensation]\nacted = \"RECORD\"\n";
    let machine = root().join("machines/gantry-001/machine.toml").display().to_string();
    let study =
        folder.file("arm.toml", study.replace("MACHINE", &machine).replace("RECORD", &file));
    let predicted = Command::new(env!("CARGO_BIN_EXE_trueaxis"))
        .args(["predict", &study])
        .output()
        .expect("it starts");
    let err = String::from_utf8_lossy(&predicted.stderr).into_owned();
    assert!(predicted.status.code() == Some(2) && err.contains("error[not-in-record]"), "{err}");
}

/// The largest error of X is that of `compensate values` at some row, and what remains is the age of the sample and the increment.
#[test]
fn what_is_gained_is_said_before() {
    let folder = Folder::new("live-expect");
    let log = "examples/03_predict/torque-arm-hall.csv";
    let words = ["expect", PLAN, "--temperature-log", log, "--format", "json"];
    let (status, out, err) = ran(&folder, &words);
    assert_eq!(status, 0, "{err}");
    let document = json(&out);
    assert_eq!(document["schema"], "trueaxis/live-expect/1");
    let x = &document["axes"][0];
    let number = |key: &str| x[key].as_f64().unwrap_or_else(|| panic!("{key}: {x}"));
    assert!(number("after") < number("before") / 5.0, "{x}");
    assert!(number("after") <= number("by_age") + number("by_increment") + 1e-9, "{x}");
    assert!(number("by_increment") < 1.0, "{x}");
    // Row 270 min by hand, at the end of X: 351.62 + 10.8 · 3.5 · (29.35 − 28.4) − 13.2 · 3.5 · (27.76 − 20) = 29.02 µm; it is
    // the largest of the travel or less.
    let rows = document["times"].as_array().expect("rows");
    let row = rows.iter().find(|row| row["time_s"] == 270.0 * 60.0).expect("a row at 270 min");
    let before = row["before"][0].as_f64().expect("a number");
    assert!((29.01..33.2).contains(&before), "{row}");
    assert_eq!(document["tool_axis_urad"], Value::Null);
}

/// What a sensor costs that is lost: the run holds, and the hall goes on.
#[test]
fn the_loss_of_a_sensor_has_its_price() {
    let folder = Folder::new("live-loss");
    let log = "examples/03_predict/torque-arm-hall.csv";
    let words = ["expect", PLAN, "--temperature-log", log, "--format", "json"];
    let document = json(&ran(&folder, &words).1);
    let losses = document["losses"].as_array().expect("losses");
    let names: Vec<&str> = losses.iter().map(|l| l["sensor"].as_str().expect("a name")).collect();
    assert_eq!(names, ["scale_x", "scale_y", "workpiece"]);
    for (axis, of) in document["axes"].as_array().expect("axes").iter().enumerate() {
        let [before, after] = ["before", "after"].map(|key| of[key].as_f64().expect("a number"));
        for loss in losses {
            let at = |key: &str| loss[key][axis].as_f64().expect("a number");
            let [ten, hour, rest] = ["after_10_min", "after_1_h", "rest_of_day"].map(at);
            // It never gets better, and the day is not worse than twice what is there without any correction.
            assert!(
                after <= ten + 1e-9 && ten <= hour && hour <= rest && rest <= 2.0 * before,
                "{loss} {of}"
            );
            assert!(rest > 5.0 * after, "{loss} {of}");
        }
    }
    let one = json(&ran(&folder, &[&words[..], &["--without", "workpiece"]].concat()).1);
    assert_eq!(one["losses"].as_array().map(Vec::len), Some(1));
    let (status, _, err) = ran(&folder, &[&words[..], &["--without", "hall"]].concat());
    assert!(status == 2 && err.contains("the plan has no sensor `hall`"), "{err}");
}

/// The run holds what followed from the row before the loss; until the end the hall warms scale and workpiece:
/// 10.8 · 3.5 µm/K · ΔT of the scale − 13.2 · 3.5 µm/K · ΔT of the workpiece at the end of X. Computed from the log alone; whole
/// increments and the dead band add less than a micrometre.
#[test]
fn law_a_lost_sensor_costs_what_the_hall_does_meanwhile() {
    let folder = Folder::new("live-loss-law");
    let log = "examples/03_predict/torque-arm-hall.csv";
    let document =
        json(&ran(&folder, &["expect", PLAN, "--temperature-log", log, "--format", "json"]).1);
    let text = std::fs::read_to_string(root().join(log)).expect("the log");
    let rows = text.lines().filter(|line| line.starts_with(|c: char| c.is_ascii_digit()));
    let rows: Vec<Vec<f64>> =
        rows.map(|r| r.split(',').map(|c| c.parse().expect("a number")).collect()).collect();
    // min, scale_x, scale_y, scale_z, workpiece.
    let end_um = |row: &[f64]| 10.8 * 3.5 * row[1] - 13.2 * 3.5 * row[4];
    let worst = |most_min: f64| {
        let mut worst = 0.0f64;
        for (i, now) in rows.iter().enumerate() {
            let sampled = &rows[i.saturating_sub(1)];
            let later = rows[i..].iter().take_while(|row| row[0] - now[0] <= most_min);
            later.for_each(|row| worst = worst.max((end_um(row) - end_um(sampled)).abs()));
        }
        worst
    };
    for (key, most_min) in [("after_10_min", 10.0), ("after_1_h", 60.0), ("rest_of_day", 1e9)] {
        let found = document["losses"][0][key][0].as_f64().expect("a number");
        assert!(
            (found - worst(most_min)).abs() < 1.0,
            "{key}: {found}, by hand {}",
            worst(most_min)
        );
    }
}

/// Every line of the text format of Prometheus that is no comment: name, labels, value.
fn metrics(text: &str) -> Vec<(String, f64)> {
    let samples = text.lines().filter(|line| !line.starts_with('#'));
    let sample = |line: &str| {
        let (name, value) = line.rsplit_once(' ').expect("a value");
        let legal = |c: char| c.is_ascii_alphanumeric() || c == '_';
        assert!(name.split('{').next().expect("a name").chars().all(legal), "{line}");
        (name.to_owned(), value.parse().expect("a number"))
    };
    samples.map(sample).collect()
}

#[test]
fn another_terminal_ends_a_run_and_its_metrics_stay() {
    let folder = Folder::new("live-stop");
    assert!(ran(&folder, &["stop", PLAN]).1.contains("no run of this plan"));
    let mut first = live(&folder, &[PLAN]);
    let mut first = first.stdout(Stdio::null()).stderr(Stdio::null()).spawn().expect("it starts");
    for _ in 0..100 {
        let (_, out, _) = ran(&folder, &["status", PLAN, "--format", "json"]);
        let document = json(&out);
        if document["running"] == true && document["last"]["state"] == "run" {
            break;
        }
        thread::sleep(Duration::from_millis(100));
    }
    let (status, out, err) = ran(&folder, &["stop", PLAN]);
    assert!(status == 0 && out.contains("the run has ended"), "{out}{err}");
    assert!(first.wait().expect("it ends").success());
    // The next run is not ended by it.
    let (status, _, err) = ran(&folder, &[PLAN, "--for", "2s"]);
    assert!(status == 0 && err.contains("Run: follows its target"), "{err}");

    let journals = std::fs::read_dir(folder.path("state/trueaxis/live")).expect("a folder");
    let page = journals.flatten().next().expect("a journal").path().join("metrics.prom");
    let all = metrics(&std::fs::read_to_string(page).expect("metrics"));
    let value = |part: &str| {
        let found: Vec<_> = all.iter().filter(|(name, _)| name.contains(part)).collect();
        assert_eq!(found.len(), 1, "{part}: {all:?}");
        found[0].1
    };
    assert_eq!((value("state=\"off\""), value("state=\"run\"")), (1.0, 0.0));
    assert_eq!(value("limit{plan=\"gantry of Zhang et al. 2019 on a mock\",axis=\"X\""), 600.0);
    assert!(
        value("cycles_total") > 10.0
            && value(
                "sensor_age_seconds{plan=\"gantry of Zhang et al. 2019 on a mock\",sensor=\"workpiece\""
            ) >= 0.0
    );
}

/// An indicator is read while the offset acts; the line for the plan comes from it.
#[test]
fn an_axis_is_commissioned_at_an_indicator() {
    use std::io::Write;
    let folder = Folder::new("live-commission");
    let answer = |words: &[&str], reading: &str| {
        let all = [&["commission"], words].concat();
        let mut command = live(&folder, &all);
        command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
        let mut child = command.spawn().expect("it starts");
        child.stdin.take().expect("a terminal").write_all(reading.as_bytes()).expect("typed");
        let done = child.wait_with_output().expect("it ends");
        let text = |bytes: Vec<u8>| String::from_utf8(bytes).expect("UTF-8");
        (done.status.code(), text(done.stdout), text(done.stderr))
    };
    let (status, out, err) = answer(
        &[PLAN, "--axis", "X", "--by", "20 um", "--evidence", "N.N., gauge"],
        "about\n19.6 um\n",
    );
    assert_eq!(status, Some(0), "{out}{err}");
    assert!(out.contains("commissioned = { wrote = \"20.000 um\", measured = \"19.600 um\", evidence = \"N.N., gauge\" }"), "{out}");
    assert!(
        err.contains("the offset of X is 20 um now") && err.contains("Off: not asked for"),
        "{err}"
    );
    for (reading, words) in
        [("-20 um\n", "near -1 it is the sign"), ("508 um\n", "near 25.4 inches")]
    {
        let (status, out, _) = answer(&[PLAN, "--axis", "Y", "--by", "20 um"], reading);
        assert!(status == Some(1) && out.contains(words), "{out}");
    }
    let (status, out, err) = answer(&[PLAN, "--axis", "X"], "\n");
    assert!(
        status == Some(1) && out.is_empty() && err.contains("no reading: nothing is proved"),
        "{err}"
    );
    for (words, code) in [
        (&[PLAN, "--axis", "Z"][..], "unknown-axis"),
        (&[PLAN, "--axis", "X", "--by", "0.5 um"], "live-limit"),
        (&[PLAN, "--axis", "X", "--by", "2 mm"], "live-limit"),
        (&[PLAN, "--axis", "X", "--by", "ten"], "live-limit"),
    ] {
        let (status, _, err) = answer(words, "");
        assert!(status == Some(2) && err.contains(code), "{words:?}: {err}");
    }
    // A control whose larger offset moves the tool against the axis: +20 µm shows -20, and the line is right for its plan.
    let text = std::fs::read_to_string(root().join(PLAN)).expect("the plan");
    let text = text
        .replace("../../machines", &root().join("machines").display().to_string())
        .replace("../03_predict", &root().join("examples/03_predict").display().to_string());
    let of_x =
        |more: &str| text.replacen("[axis.X]\n", &format!("[axis.X]\nsign = -1\n{more}\n"), 1);
    let plan = folder.file("against.toml", of_x(""));
    let (status, out, err) = answer(&[&plan, "--axis", "X", "--by", "20 um"], "-20 um\n");
    assert!(status == Some(0) && out.starts_with("1.00 of"), "{out}{err}");
    let line = out.lines().find(|line| line.starts_with("commissioned")).expect("the line");
    let plan = folder.file("against.toml", of_x(line));
    let (status, _, err) = ran(&folder, &["status", &plan]);
    assert_eq!(status, 0, "{err}");
    assert_eq!(answer(&[&plan, "--axis", "X", "--by", "20 um"], "20 um\n").0, Some(1));
    let plan = folder.file("against.toml", of_x(&line.replace("-20.000", "20.000")));
    let (status, _, err) = ran(&folder, &["status", &plan]);
    assert!(status == 2 && err.contains("error[live-commissioning]"), "{err}");
}
