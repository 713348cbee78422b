//! The forecast of a control that takes whole poses: against the same machine, pose by pose.

mod rig;

use rig::root;
use std::fmt::Write;
use trueaxis::files::disk;
use trueaxis::input::Diagnostics;
use trueaxis::machine::heat::TemperatureLog;
use trueaxis_live::expect::{ExpectedPoses, LiveExpectDocument, expect};
use trueaxis_live::file::{Plan, read_plan};

fn plan(changes: &[(&str, &str)]) -> Plan {
    let path = root().join("examples/08_live/linuxcnc/xyzac-live.toml");
    let mut text = std::fs::read_to_string(&path).expect("the example");
    // In the corners of the travel X needs 289 µm.
    text = text.replace("limit = \"250 um\"", "limit = \"400 um\"");
    for (old, new) in changes {
        assert!(text.contains(old), "no `{old}`");
        text = text.replace(old, new);
    }
    let own = path.with_file_name("changed.toml");
    let (plan, problems) = read_plan(&disk().with_texts([(own.clone(), text)]), &own);
    plan.unwrap_or_else(|| panic!("{:?}", problems.sorted()))
}

/// A spindle that warms up within the day, a row each `step_s`.
fn day(step_s: f64, warms_k: f64) -> TemperatureLog {
    let mut text = "time_s,spindle_degC\n".to_owned();
    let mut time_s = 0.0;
    while time_s <= 14_400.0 {
        writeln!(text, "{time_s},{}", 20.0 + warms_k * (1.0 - f64::exp(-time_s / 3600.0))).unwrap();
        time_s += step_s;
    }
    TemperatureLog::parse("day.csv", &text, &mut Diagnostics::new()).expect("a log")
}

fn poses(plan: &Plan, log: &TemperatureLog) -> (ExpectedPoses, LiveExpectDocument) {
    let mut found = expect(plan, log, None).unwrap_or_else(|e| panic!("{e}"));
    (found.poses.take().expect("poses"), found)
}

/// Without a change of temperature only second-order terms, increments of 1 nm and the pole remain.
#[test]
fn law_at_rest_nearly_nothing_is_left() {
    let (found, _) = poses(&plan(&[]), &day(600.0, 0.0));
    assert!(found.tip_um[0] > 20.0 && found.tip_um[1] < 0.01, "{:?}", found.tip_um);
    let urad = found.tool_axis_urad.expect("rotary axes");
    assert!(urad[1] < urad[0], "{urad:?}");
    assert!(found.axes.iter().all(|axis| axis.needed <= axis.limit), "{:?}", found.axes);
}

/// An offset beyond its limit is missing: by hand 289 of X less 250.
#[test]
fn law_a_limit_that_is_too_small_is_said() {
    let small = plan(&[("limit = \"400 um\"", "limit = \"250 um\"")]);
    let (found, _) = poses(&small, &day(600.0, 0.0));
    let x = &found.axes[0];
    assert!(x.needed > x.limit && x.limit == 250.0, "{x:?}");
    assert!((found.tip_um[1] - (x.needed - x.limit)).abs() < 0.5, "{found:?}");
}

/// The spindle grows along its axis: by hand −1.5 µm/K in the machine file, and a sample that is a row old lacks that times ΔT of the
/// row. With coarse increments half of one remains of each axis, and the tip is off by that in space.
#[test]
fn law_what_is_left_is_age_and_increment() {
    let per_k = -1.5;
    let (found, _) = poses(&plan(&[]), &day(600.0, 10.0));
    // The first rows change most: 10 K · (1 − e^(−600/3600)).
    let by_hand = (per_k * 10.0 * (1.0 - f64::exp(-600.0 / 3600.0))).abs();
    assert!(
        (found.tip_by_age_um - by_hand).abs() < 0.02 * by_hand,
        "{} {by_hand}",
        found.tip_by_age_um
    );
    assert!((found.tip_um[1] - found.tip_by_age_um).abs() < 0.01, "{found:?}");
    let coarse: Vec<(&str, &str)> = vec![
        ("increment = \"1 nm\"", "increment = \"1 um\""),
        ("dead_band = \"1 nm\"", "dead_band = \"1 um\""),
    ];
    let (found, _) = poses(&plan(&coarse), &day(600.0, 0.0));
    assert!((0.5..0.87).contains(&found.tip_um[1]), "{:?}", found.tip_um);
}

/// Finer rows make the sample younger, and the price of a sensor that is lost for good does not depend on them.
#[test]
fn law_the_price_of_a_sensor_does_not_depend_on_the_rows() {
    let [a, b] = [600.0, 300.0].map(|step_s| poses(&plan(&[]), &day(step_s, 10.0)));
    assert!(b.0.tip_by_age_um < 0.6 * a.0.tip_by_age_um);
    let rest = |found: &LiveExpectDocument| found.losses[0].rest_of_day[0];
    assert_eq!(a.1.losses.len(), 1);
    assert!((rest(&a.1) - rest(&b.1)).abs() < 0.05 * rest(&a.1), "{} {}", rest(&a.1), rest(&b.1));
    assert!(a.1.losses[0].after_10_min[0] < a.1.losses[0].after_1_h[0]);
}
