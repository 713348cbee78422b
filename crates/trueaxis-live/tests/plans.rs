//! Plans that are refused at the start, each with its code.

mod rig;

use rig::plan_with;
use trueaxis::files::disk;
use trueaxis_live::commission::{Commission, commission, evidence_line};
use trueaxis_live::control::Identity;
use trueaxis_live::start::doubt;

/// What the example says when a line is changed.
fn codes(changes: &[(&str, &str)]) -> Vec<String> {
    let Err(found) = plan_with(changes) else { return Vec::new() };
    found.iter().map(|line| line.split(':').next().unwrap_or_default().to_owned()).collect()
}

#[track_caller]
fn refused(old: &str, new: &str, code: &str) {
    let found = codes(&[(old, new)]);
    assert!(found.iter().any(|c| c == code), "`{new}`: {found:?}, not {code}");
}

#[test]
fn the_example_is_a_plan() {
    let plan = plan_with(&[]).unwrap();
    assert_eq!((plan.axes.len(), plan.sensors.len()), (2, 3));
    assert!(plan.sensors[2].settings.is_workpiece && !plan.sensors[0].settings.is_workpiece);
    // 100 µm/s in increments of 1 µm, 600 of them at most.
    let limits = plan.axes[0].limits;
    assert_eq!((limits.limit, limits.step, limits.jump), (600, 10, 60));
    assert!((limits.slew_per_s - 100.0).abs() < 1e-9);
}

#[test]
fn without_limits_there_is_no_start() {
    for (line, new) in [
        ("limit = \"600 um\"", ""),
        ("slew = \"100 um/s\"", ""),
        ("step = \"10 um\"", ""),
        ("jump = \"60 um\"", ""),
        ("dead_band = \"1 um\"", ""),
    ] {
        refused(line, new, "live-no-limit");
    }
    refused("dead_band = \"1 um\"", "dead_band = \"0.4 um\"", "live-limit");
    refused("step = \"10 um\"", "step = \"0.4 um\"", "live-limit");
    refused("limit = \"600 um\"", "limit = \"9e9 m\"", "too-large");
    refused("increment = \"1 um\"", "increment = \"1e-7 nm\"", "live-limit");
    refused("limit = \"600 um\"", "limit = \"-600 um\"", "not-positive");
    refused("limit = \"600 um\"", "limit = \"600 deg\"", "wrong-unit");
    refused("limit = \"600 um\"", "limit = 600", "missing-unit");
    refused("slew = \"100 um/s\"", "slew = \"100 um\"", "wrong-unit");
    refused("[axis.X]", "[axis.Q]", "unknown-axis");
}

/// An axis without a usable increment is refused: left out without a word, the offset of the next axis went to its place.
#[test]
fn an_axis_is_never_left_out_without_a_word() {
    for new in ["0 um", "-1 um", "-0 um"] {
        let increment = format!("increment = \"{new}\"");
        assert_eq!(codes(&[("increment = \"1 um\"", &increment)]), ["not-positive"; 2], "{new}");
        let first = format!("[axis.X]\nincrement = \"{new}\"");
        assert_eq!(codes(&[("[axis.X]\nincrement = \"1 um\"", &first)]), ["not-positive"]);
    }
    for lag in ["0 um", "-2 um"] {
        let late = format!("dead_band = \"1 um\"\nlag = \"{lag}\"");
        assert_eq!(codes(&[("dead_band = \"1 um\"", &late)]), ["not-positive"; 2], "{lag}");
    }
}

#[test]
fn sensors_fit_the_machine_file() {
    let column = ("speed = 10 }", "speed = 10, column = \"scale_x\" }");
    let spindle = codes(&[("[sensor.scale_x]", "[sensor.spindle]"), column]);
    assert_eq!(spindle, ["live-unused-sensor", "live-missing-sensor"]);
    refused("[sensor.scale_x]", "[sensor.second]\ninput = \"scale_y\"", "live-twice");
    refused(
        "range = [\"10 degC\", \"45 degC\"]",
        "range = [\"45 degC\", \"10 degC\"]",
        "bad-range",
    );
    refused("rate_k_per_min = 5", "", "missing-key");
    refused("stale = \"90 s\"", "", "missing-key");
    refused("speed = 10", "speed = 10, column = \"scale_q\"", "live-no-column");
    refused("speed = 10", "speed = 0", "not-positive");
    let other = "rate_k_per_min = 5\ninstead = \"workpiece\"";
    refused("rate_k_per_min = 5", other, "live-instead");
    refused("of = \"comprehensive\"", "of = \"machine\"", "live-machine-only");
    let machine = "of = \"machine\"\nwithout_part = true";
    refused("of = \"comprehensive\"", machine, "live-unused-sensor");
}

/// What could not be read is not called missing besides.
#[test]
fn one_fault_has_one_message() {
    let sensor = ("rate_k_per_min = 5", "rate_k_per_min = nan");
    assert_eq!(codes(&[sensor]), ["not-finite"; 3]);
    let log = ("torque-arm-hall.csv", "none.csv");
    assert!(codes(&[log]).iter().all(|code| code == "unreadable-file"));
    let axis = ("limit = \"600 um\"", "");
    assert_eq!(codes(&[axis]), ["live-no-limit"; 2]);
    assert_eq!(codes(&[("[axis.X]", "[other.X]"), ("[axis.Y]", "[other.Y]")])[0], "live-no-axis");
}

#[test]
fn controls_are_whole() {
    refused("address = \"mock\"", "address = \"mill\"", "bad-address");
    refused("address = \"mock\"", "address = \"10.0.0.1:0\"", "bad-address");
    refused("address = \"mock\"", "address = \"10.0.0.1:8193\"", "contradiction");
    refused("command = \"R1000\"", "command = \"Q1000\"", "bad-pmc-address");
    refused("ask_hold = \"R1042.0\"", "ask_hold = \"R1042.8\"", "bad-pmc-address");
    refused("lever = \"pmc\"", "lever = \"crowbar\"", "unknown-word");
    refused("period = \"50 ms\"", "period = \"0 s\"", "not-positive");
    refused("after_hold = \"stay\"", "after_hold = \"stay\"\nmodes = []", "bad-list");
}

/// A real control needs its identity and the evidence of commissioning of each axis.
#[test]
fn a_real_control_is_bound_and_commissioned() {
    let path = rig::root().join("examples/08_live/gantry-mock.toml");
    let text = std::fs::read_to_string(path).unwrap();
    let mock = format!("[mock]{}", text.split("[mock]").nth(1).unwrap());
    let real = |bound: &str, evidence: &str| {
        codes(&[
            (mock.as_str(), ""),
            ("address = \"mock\"", &format!("address = \"10.0.0.1:8193\"\n{bound}")),
            ("dead_band = \"1 um\"", &format!("dead_band = \"1 um\"\n{evidence}")),
        ])
    };
    let bound = "identity = { kind = \"31\", series = \"G42A\", version = \"01.0\" }";
    let evidence = |measured: &str| {
        format!(
            "commissioned = {{ wrote = \"10 um\", measured = \"{measured}\", evidence = \"N.N.\" }}"
        )
    };
    let enabled = "enabled_by = \"a test\"";
    assert_eq!(real(enabled, &evidence("9.8 um")), ["live-not-bound"]);
    assert_eq!(real(bound, &evidence("9.8 um")), ["live-not-enabled"]);
    let bound = &format!("{bound}\n{enabled}");
    assert_eq!(real(bound, ""), ["live-not-commissioned", "live-not-commissioned"]);
    assert_eq!(real(bound, &evidence("9.8 um")), Vec::<String>::new());
    // The wrong sign, a diameter, inches.
    for measured in ["-10 um", "20 um", "254 um", "0 um"] {
        let found = real(bound, &evidence(measured));
        assert!(found.iter().all(|c| c == "live-commissioning") && found.len() == 2, "{found:?}");
    }
    assert_eq!(real(bound, &format!("sign = -1\n{}", evidence("-10 um"))), Vec::<String>::new());
}

/// The line of a commissioning is one of TOML, whatever the evidence is.
#[test]
fn the_line_of_a_commissioning_can_be_read() {
    let plan = plan_with(&[]).unwrap();
    let evidence = "N.N., \"dial\" C:\\log, 2026-11-26\tX";
    let line = evidence_line(&plan, "X", (0.010, 0.0098), evidence);
    let with = plan_with(&[("[axis.X]\n", &format!("[axis.X]\n{line}\n"))]).unwrap();
    let found = with.axes[0].commissioned.clone().expect("read");
    assert_eq!(found.evidence, evidence);
    assert!((found.wrote - 0.010).abs() < 1e-12 && (found.measured - 0.0098).abs() < 1e-12);
}

/// The control takes whole increments: 1.5 µm would be written as 2, and the indicator be compared with 1.5.
#[test]
fn an_axis_is_commissioned_by_whole_increments() {
    let plan = rig::root().join("examples/08_live/gantry-mock.toml");
    let tried = |by: f64| {
        let asked = Commission { plan: plan.clone(), axis: "X".to_owned(), by };
        let done = commission(&asked, &disk(), &|| true, (&|_| {}, &|| None));
        done.err().map_or_else(Vec::new, |e| e.iter().map(|d| d.code.to_owned()).collect())
    };
    for by in [0.0015, 0.0014, -0.0105, 0.0004] {
        assert_eq!(tried(by), ["live-limit"], "{by}");
    }
    assert_eq!(tried(0.003), Vec::<String>::new());
}

/// What is published of the calls is not of all series: a run says so where it is not.
#[test]
fn a_series_without_published_answers_is_named() {
    let plan = plan_with(&[]).unwrap();
    let of = |kind: &str| Identity {
        kind: kind.to_owned(),
        series: "BDE1".to_owned(),
        version: "01.0".to_owned(),
        axes: Vec::new(),
        decimals: Vec::new(),
    };
    for known in ["0", "30", "31", "32", "35"] {
        assert_eq!(doubt(&plan, &of(known)), None);
    }
    for older in ["15", "16", "18", "21"] {
        assert!(doubt(&plan, &of(older)).is_some_and(|words| words.contains(older)));
    }
}
