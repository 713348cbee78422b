//! Forecasts row by row: no row is left out, the zero of the part counts, and what the run would not do is said.

mod rig;

use rig::{plan_with, root};
use std::fmt::Write;
use std::path::PathBuf;
use trueaxis::files::disk;
use trueaxis::input::Diagnostics;
use trueaxis::machine::heat::TemperatureLog;
use trueaxis::questions::{Answer, Question};
use trueaxis_live::expect::{ExpectLive, LiveExpectDocument, expect};
use trueaxis_live::file::{Plan, read_plan};

fn log_of(text: &str) -> TemperatureLog {
    TemperatureLog::parse("day.csv", text, &mut Diagnostics::new()).expect("a log")
}

fn of(plan: &Plan, log: &TemperatureLog) -> LiveExpectDocument {
    expect(plan, log, None).unwrap_or_else(|e| panic!("{e}"))
}

/// A day of the gantry: scales as they are, the workpiece by the number of its row.
fn gantry(
    rows: usize,
    step_s: usize,
    scale: f64,
    workpiece: impl Fn(usize) -> f64,
) -> TemperatureLog {
    let mut text = "time_s,scale_x_degC,scale_y_degC,workpiece_degC\n".to_owned();
    for row in 0..rows {
        writeln!(text, "{},{scale},{scale},{}", row * step_s, workpiece(row)).unwrap();
    }
    log_of(&text)
}

/// One row of 1201 has a workpiece that is 1 K warmer: by hand 13.2 µm/(m·K) · 3.5 m · 1 K = 46.2 µm are left at it, the sample
/// being that of the row before, wherever in the log it is.
#[test]
fn law_no_row_is_left_out_of_the_largest_errors() {
    let plan = plan_with(&[]).unwrap_or_else(|e| panic!("{e:?}"));
    for peak in [600, 601, 602, 1199] {
        let found = of(&plan, &gantry(1201, 60, 28.4, |row| if row == peak { 28.0 } else { 27.0 }));
        let x = &found.axes[0];
        assert!((x.by_age - 46.2).abs() < 1e-6, "{peak}: {}", x.by_age);
        assert!((46.2 - 1.0..46.2 + 1.0).contains(&x.after), "{peak}: {}", x.after);
        assert!(found.times.len() <= 500);
        let shown = found.times.iter().map(|row| row.after[0]).fold(0.0, f64::max);
        assert!((shown - x.after).abs() < 1e-9, "{peak}: {shown}");
        // Whatever sensor is lost, it costs no less.
        for loss in &found.losses {
            assert!(loss.after_10_min[0] >= x.after - 1e-9, "{peak}: {}", loss.after_10_min[0]);
        }
    }
}

/// The same of poses: one row of 241 has a spindle that is 1 K warmer, by hand −1.5 µm/K.
#[test]
fn law_no_peak_is_left_out_of_the_largest_errors_of_poses() {
    let path = root().join("examples/08_live/linuxcnc/xyzac-live.toml");
    let (plan, problems) = read_plan(&disk(), &path);
    let plan = plan.unwrap_or_else(|| panic!("{:?}", problems.sorted()));
    for peak in [121, 123] {
        let mut text = "time_s,spindle_degC\n".to_owned();
        for row in 0..241 {
            writeln!(text, "{},{}", 60 * row, if row == peak { 23.0 } else { 22.0 }).unwrap();
        }
        let found = of(&plan, &log_of(&text)).poses.expect("poses");
        assert!((found.tip_by_age_um - 1.5).abs() < 0.05, "{peak}: {}", found.tip_by_age_um);
    }
}

/// By hand: zero touched at X = 3500 mm with scale and workpiece at 30.5 °C, m₀ = +54.1 µm. On a day of 28.4 and 27.0 °C the error
/// there is 351.62 − 13.2 · 3.5 · 7 = 28.2 µm, so −28.2 − 54.1 = −82.3 µm are needed.
#[test]
fn law_the_zero_of_the_part_counts_in_a_forecast() {
    let datum = "[datum]\nat = { X = \"3500 mm\" }\ntemperatures = { scale_x = \"30.5 degC\", scale_y = \"30.5 degC\", workpiece = \"30.5 degC\" }\n[mock]";
    let [without, with] = [plan_with(&[]), plan_with(&[("[mock]", datum)])]
        .map(|plan| plan.unwrap_or_else(|e| panic!("{e:?}")));
    let log = gantry(3, 600, 28.4, |_| 27.0);
    let (plain, found) = (of(&without, &log), of(&with, &log));
    let x = &found.axes[0];
    assert!((28.0..34.0).contains(&plain.axes[0].needed), "{}", plain.axes[0].needed);
    let more = x.needed - plain.axes[0].needed;
    assert!((more - 54.1).abs() < 0.01, "{} {}", x.needed, plain.axes[0].needed);
    // What the tool is off by is counted from the zero, and nothing but the increment is left.
    assert!((x.before - x.needed).abs() < 1e-9 && x.after < 1.0, "{x:?}");
    // No offset of an axis changes what the others leave.
    assert_eq!(plain.other_tip_um, found.other_tip_um);
}

/// The same of tip and tool axis: a touch at the temperatures of the day leaves nothing there, and the correction nothing anywhere.
#[test]
fn law_the_zero_of_the_part_counts_in_a_forecast_of_poses() {
    let path = root().join("examples/08_live/linuxcnc/xyzac-live.toml");
    let text = std::fs::read_to_string(&path).expect("the example").replace("250 um", "900 um");
    let of_text = |more: &str| {
        let own = path.with_file_name("changed.toml");
        let (plan, problems) =
            read_plan(&disk().with_texts([(own.clone(), format!("{text}\n{more}"))]), &own);
        let plan = plan.unwrap_or_else(|| panic!("{:?}", problems.sorted()));
        of(&plan, &log_of("time_s,spindle_degC\n0,30\n600,30\n")).poses.expect("poses")
    };
    let plain = of_text("");
    // At another touch the spindle was longer: another zero, and other offsets.
    let [same, other] = ["30", "40"].map(|celsius| {
        of_text(&format!(
            "[datum]\nat = {{ X = \"20 mm\", Y = \"-30 mm\", Z = \"-40 mm\" }}\ntemperatures = {{ spindle = \"{celsius} degC\" }}\n"
        ))
    });
    for found in [&plain, &same, &other] {
        assert!(found.tip_um[1] < 0.02, "{found:?}");
    }
    assert!((plain.tip_um[0] - same.tip_um[0]).abs() > 1.0, "{plain:?} {same:?}");
    let change = (same.axes[2].needed - other.axes[2].needed).abs();
    assert!(change > 5.0, "{change}");
}

/// The uncertainty is the largest over the day, not that of its last row.
#[test]
fn law_the_uncertainty_is_that_of_the_day() {
    let plan = plan_with(&[]).unwrap_or_else(|e| panic!("{e:?}"));
    let day = |first: f64, last: f64| {
        let text = format!(
            "time_s,scale_x_degC,scale_y_degC,workpiece_degC\n0,{first},{first},{first}\n600,{last},{last},{last}\n"
        );
        of(&plan, &log_of(&text)).axes[0].expanded_uncertainty.expect("stated")
    };
    let [hot, cold] = [day(40.0, 40.0), day(20.0, 20.0)];
    assert!(hot > cold + 5.0, "{hot} {cold}");
    assert_eq!((day(40.0, 20.0), day(20.0, 40.0)), (hot, hot));
}

const SCALES: &str = "[machine]\nname = \"two scales\"\nchain = \"w b X Y Z t\"\n[axis.X]\ntravel = [\"FROM\", \"500 mm\"]\n\
    [axis.Y]\ntravel = [\"FROM\", \"500 mm\"]\n[axis.Z]\ntravel = [\"0 mm\", \"500 mm\"]\n[workpiece]\nexpansion = \"12 um/(m K)\"\n\
    fixed_point = \"0 0 0 mm\"\nsensors = { workpiece = \"0 mm\" }\n[motion.X]\nEXX = { polynomial = [\"0 um\", \"100 um\"], scale = \"1000 mm\" }\n\
    [motion.Y]\nEYY = { polynomial = [\"0 um\", \"100 um\"], scale = \"1000 mm\" }\n";

/// Errors along X and Y only: both are corrected, and no deviation is left that no axis corrects, wherever a travel begins.
#[test]
fn law_what_no_axis_corrects_does_not_depend_on_where_a_travel_begins() {
    let path = root().join("examples/08_live/gantry-mock.toml");
    let text = std::fs::read_to_string(&path).expect("the example");
    let machine: PathBuf = path.with_file_name("scales.toml");
    let scale = |name: &str| {
        let from = text.find(&format!("[sensor.{name}]")).expect("a sensor");
        let to = from + text[from + 1..].find("\n\n").expect("its end") + 1;
        text[from..to].to_owned()
    };
    let plan_text = text
        .replace("../../machines/gantry-001/machine.toml", "scales.toml")
        .replace(&scale("scale_x"), "")
        .replace(&scale("scale_y"), "");
    for from in ["-500 mm", "0 mm", "100 mm"] {
        let own = path.with_file_name("changed.toml");
        let files = disk().with_texts([
            (own.clone(), plan_text.clone()),
            (machine.clone(), SCALES.replace("FROM", from)),
        ]);
        let (plan, problems) = read_plan(&files, &own);
        let plan = plan.unwrap_or_else(|| panic!("{:?}", problems.sorted()));
        let found = of(&plan, &log_of("time_s,workpiece_degC\n0,20\n600,20\n"));
        let other = found.other_tip_um.expect("axes");
        assert!(other < 1e-6, "{from}: {other}");
        assert!(found.axes[0].before > 49.0, "{from}");
    }
}

/// A sensor that reads the same as the lost one costs nothing: what remains is that of the day.
#[test]
fn law_a_sensor_that_stands_in_has_the_age_of_its_sample() {
    let instead = ("[sensor.scale_x]\n", "[sensor.scale_x]\ninstead = \"scale_y\"\n");
    let plan = plan_with(&[instead]).unwrap_or_else(|e| panic!("{e:?}"));
    let mut text = "time_s,scale_x_degC,scale_y_degC,workpiece_degC\n".to_owned();
    for row in 0..40 {
        let celsius = 20.0 + 0.25 * f64::from(row);
        writeln!(text, "{},{celsius},{celsius},{}", 60 * row, 20.0 + 0.1 * f64::from(row)).unwrap();
    }
    let found = of(&plan, &log_of(&text));
    let loss = &found.losses[0];
    assert_eq!(loss.instead.as_deref(), Some("scale_y"));
    // By hand (10.8 · 0.25 − 13.2 · 0.1) · 3.5 = 4.8 µm by the age of the sample.
    assert!((found.axes[0].by_age - 4.83).abs() < 0.01, "{}", found.axes[0].by_age);
    assert_eq!(loss.rest_of_day[0], found.axes[0].after);
}

/// What the run would not follow is said: a sample that becomes too old, a reading that is too fast, a slew that is too slow.
#[test]
fn what_the_run_would_not_follow_is_said() {
    let said = |changes: &[(&str, &str)], log: &str| {
        let path = root().join("examples/08_live/gantry-mock.toml");
        let mut text = std::fs::read_to_string(&path).expect("the example");
        for (old, new) in changes {
            assert!(text.contains(old), "{old}");
            text = text.replace(old, new);
        }
        let (own, day) = (path.with_file_name("changed.toml"), path.with_file_name("day.csv"));
        let files = disk().with_texts([(own.clone(), text), (day.clone(), log.to_owned())]);
        let mut problems = Diagnostics::new();
        let question = ExpectLive { plan: own, log: day, without: None };
        let input = question.read(&files, &mut problems).expect("it is read");
        let answer = question.answer(input, &|_| {}, &mut problems).expect("an answer");
        let _ = answer.report();
        let said: Vec<String> =
            problems.iter().map(|d| format!("{}: {}", d.code, d.message)).collect();
        said
    };
    let head = "time_s,scale_x_degC,scale_y_degC,workpiece_degC\n";
    let day = format!("{head}0,20,20,20\n600,20.5,20.5,20.5\n1200,21,21,21\n");
    // The plan replays its log ten times as fast: ten minutes are one of the run.
    assert_eq!(said(&[], &day), Vec::<String>::new());
    let old = said(&[("stale = \"90 s\"", "stale = \"30 s\"")], &day);
    assert_eq!(old.len(), 3, "{old:?}");
    assert!(
        old[0].starts_with("live-not-followed: 2 of 2 rows") && old[0].contains("up to 60 s"),
        "{old:?}"
    );
    let fast = said(&[("rate_k_per_min = 5", "rate_k_per_min = 0.3")], &day);
    assert!(fast.len() == 3 && fast[0].contains("faster than its rate"), "{fast:?}");
    // By hand 2.4 · 3.5 · 0.5 K = 4.2 µm in ten minutes of the log: 0.007 µm/s; along Y 4.6 · 2.3 · 0.5 K = 5.3 µm.
    let slow = said(&[("slew = \"100 um/s\"", "slew = \"0.005 um/s\"")], &day);
    assert!(slow.len() == 2 && slow[0].contains("the offset of X by up to 0.007"), "{slow:?}");
}
