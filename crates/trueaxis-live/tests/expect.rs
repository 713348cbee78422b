//! Forecasts: what they say by hand, whatever the rows of the log.

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

/// A spindle whose growth outweighs all else: by hand U = 2 · 5 µm/K · 10 K along it.
#[test]
fn law_the_uncertainty_is_that_of_the_coefficient() {
    let path = root().join("examples/08_live/linuxcnc/xyzac-live.toml");
    let text = std::fs::read_to_string(&path).expect("the example");
    let machine = path.with_file_name("xyzac.toml");
    let u_um = |coefficient: &str| {
        let changed = std::fs::read_to_string(&machine).expect("the machine");
        assert!(changed.contains("\"-1.5 um/K\""));
        let changed = changed.replace("-1.5 um/K", coefficient);
        let files = disk().with_texts([(path.clone(), text.clone()), (machine.clone(), changed)]);
        let (plan, problems) = read_plan(&files, &path);
        let plan = plan.unwrap_or_else(|| panic!("{:?}", problems.sorted()));
        // At the end of a long day: all of the 10 K.
        let text = "time_s,spindle_degC\n0,30\n600,30\n";
        let log = TemperatureLog::parse("day.csv", text, &mut Diagnostics::new()).expect("a log");
        poses(&plan, &log).0.tip_expanded_uncertainty_um
    };
    assert_eq!(u_um("-100 um/K"), None);
    let u = u_um("-100 ± 5 um/K").expect("an uncertainty");
    assert!((92.0..=100.0).contains(&u), "{u}");
    let twice = u_um("-100 ± 10 um/K").expect("an uncertainty");
    assert!((twice - 2.0 * u).abs() < 1e-6 * u, "{u} {twice}");
}

/// A log of many rows is thinned; its sample is a row old all the same, and ten minutes and an hour are not those of the thinned rows.
#[test]
fn law_a_forecast_does_not_depend_on_how_many_rows_a_log_has() {
    for step_s in [600.0, 10.0] {
        let log = day(step_s, 10.0);
        let (found, document) = poses(&plan(&[]), &log);
        // By hand −1.5 µm/K · 10 K; the first rows change most.
        let after = |s: f64| 15.0 * (1.0 - f64::exp(-s / 3600.0));
        let by_age = found.tip_by_age_um;
        assert!(
            by_age > 0.9 * after(step_s) && by_age < 1.02 * after(step_s),
            "{step_s} s: {by_age}"
        );
        // Lost at the first row, or at the next one with an offset that is a row old.
        let loss = &document.losses[0];
        for (span_s, cost) in
            [(600.0, &loss.after_10_min), (3600.0, &loss.after_1_h), (14_400.0, &loss.rest_of_day)]
        {
            let (least, most) = (0.99 * after(span_s), 1.01 * after(span_s + step_s));
            assert!(
                (least..most).contains(&cost[0]),
                "{step_s} s, {span_s} s: {} of {least} to {most}",
                cost[0]
            );
        }
        assert!(document.other_tip_um.is_none());
    }
}

/// The same axis by axis: by hand X at 3500 mm changes by (10.8 − 13.2) · 3.5 µm/K where scale and workpiece warm alike.
#[test]
fn law_a_forecast_of_axes_does_not_depend_on_how_many_rows_a_log_has() {
    let of = |step_s: f64| {
        let mut text = "time_s,scale_x_degC,scale_y_degC,workpiece_degC\n".to_owned();
        let mut time_s = 0.0;
        while time_s <= 14_400.0 {
            let celsius = 20.0 + 10.0 * time_s / 14_400.0;
            writeln!(text, "{time_s},{celsius},{celsius},{celsius}").unwrap();
            time_s += step_s;
        }
        let log = TemperatureLog::parse("day.csv", &text, &mut Diagnostics::new()).expect("a log");
        let plan = rig::plan_with(&[]).unwrap_or_else(|e| panic!("{e:?}"));
        expect(&plan, &log, None).unwrap_or_else(|e| panic!("{e}"))
    };
    let (coarse, fine) = (of(600.0), of(10.0));
    for (found, step_s) in [(&coarse, 600.0), (&fine, 10.0)] {
        let by_hand = 2.4 * 3.5 * 10.0 * step_s / 14_400.0;
        let by_age = found.axes[0].by_age;
        assert!((by_age - by_hand).abs() < 0.02 * by_hand, "{step_s} s: {by_age} {by_hand}");
    }
    // 10 min of a sensor that is lost for good, beside one increment and the dead band.
    for (of, by_hand) in [(0, 3.5), (1, 21.0)] {
        for found in [&coarse, &fine] {
            let loss = &found.losses[0];
            let cost = [&loss.after_10_min, &loss.after_1_h][of][0];
            assert!((by_hand..by_hand + 5.1).contains(&cost), "{cost} {by_hand}");
        }
    }
}
