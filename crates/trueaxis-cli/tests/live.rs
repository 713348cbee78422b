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
