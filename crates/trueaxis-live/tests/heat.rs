//! A scale that is heated at a bearing, live: its history in a few numbers, over restarts.

mod rig;

use rig::{Rig, root};
use std::fmt::Write;
use std::sync::Arc;
use trueaxis::compensate::values::{error_of, error_split};
use trueaxis::files::disk;
use trueaxis::input::Diagnostics;
use trueaxis::machine::heat::TemperatureLog;
use trueaxis::predict::holes::Compensation;
use trueaxis_live::clock::Clock;
use trueaxis_live::file::{Plan, read_plan};
use trueaxis_live::governor::State;
use trueaxis_live::memory::HeatOfRun;

/// The example with a screw in X that its bearing at 0 heats, standing at X = 3500 mm, two cycles a second.
fn heated() -> Plan {
    let machine_path = root().join("machines/gantry-001/machine.toml");
    let machine = std::fs::read_to_string(&machine_path).expect("the machine");
    let sensors = "sensors = { scale_x = \"0 mm\" }";
    assert_eq!(machine.matches(sensors).count(), 1);
    let heated = "heated = { at = \"0 mm\", near = \"scale_x\", far = \"scale_y\", diffusivity = \"12 mm^2/s\" }";
    let machine = machine.replace(sensors, heated);
    let path = root().join("examples/08_live/gantry-mock.toml");
    let text = std::fs::read_to_string(&path).expect("the example");
    let stops = text.split("stops = [").nth(1).expect("stops").to_owned();
    let text = text
        .replace("gantry-001/machine.toml", "gantry-001/heated.toml")
        .replace("period = \"50 ms\"", "period = \"500 ms\"")
        .replace(&stops, "[\"3500 mm\", \"2300 mm\", \"400 mm\"]]\n");
    let own = path.with_file_name("changed.toml");
    // As the plan names it.
    let machine_path = path.with_file_name("../../machines/gantry-001/heated.toml");
    let files = disk().with_texts([(own.clone(), text), (machine_path, machine)]);
    let (plan, problems) = read_plan(&files, &own);
    plan.unwrap_or_else(|| panic!("{:?}", problems.sorted()))
}

/// °C of bearing, screw far away, workpiece.
fn celsius(time_s: f64) -> [f64; 3] {
    // A sensor that stays to the last bit would be called stuck.
    let hall = 21.0 + 0.01 * (time_s / 7.0).sin();
    [hall + 10.0 * (1.0 - (-time_s / 600.0).exp()), hall, hall]
}

fn pass(rig: &mut Rig, time_s: f64) {
    let end_s = rig.clock.now_s() + time_s;
    while rig.clock.now_s() < end_s {
        rig.sensors.borrow_mut().celsius = celsius(rig.clock.now_s()).to_vec();
        rig.cycle();
    }
}

/// The error of X at 3500 mm by the whole log, µm: eq. 85 of docs/model.md.
fn by_the_whole_log(plan: &Plan, until_s: f64) -> f64 {
    let mut text = "time_s,scale_x_degC,scale_y_degC,workpiece_degC\n".to_owned();
    let mut time_s = 0.0;
    while time_s <= until_s {
        let [x, y, workpiece] = celsius(time_s);
        writeln!(text, "{time_s},{x},{y},{workpiece}").expect("a text");
        time_s += 10.0;
    }
    let mut problems = Diagnostics::new();
    let log = TemperatureLog::parse("log.csv", &text, &mut problems).map(Arc::new).expect("a log");
    let warm = plan.machine.at(&log.at(until_s).expect("in the log"), &mut problems);
    let command = [3500.0, 2300.0, 0.0, 0.0, 0.0, 0.0];
    let split = error_split(&warm.expect("a machine"), 0, &command).expect("inside");
    error_of(Compensation::Comprehensive, &split) * 1e3
}

#[test]
fn law_the_history_of_a_heated_scale_is_followed() {
    let plan = heated();
    let mut rig = Rig::new(plan.clone());
    pass(&mut rig, 1800.0);
    assert_eq!(rig.state(), State::Run, "{}", rig.story());
    let due = by_the_whole_log(&plan, 1800.0);
    // One increment, the dead band, and 10 s of heat.
    assert!((f64::from(rig.acting()[0]) + due).abs() < 1.6, "{:?} {due}", rig.acting());
    // Without the history: a bearing of 31 °C in a screw of 21 °C.
    let cold = by_the_whole_log(&plan, 0.0);
    assert!((due - cold).abs() > 10.0, "{due} {cold}");

    // The next run, 5 min later, goes on with it; without it nothing is known.
    let heat = HeatOfRun::from(rig.run.correction().memory().expect("heat").clone());
    let text = serde_json::to_string(&heat).expect("a text");
    let again: HeatOfRun = serde_json::from_str(&text).expect("a memory");
    assert_eq!(again, heat);
    let (clock, mock, owned) = (rig.clock.clone(), rig.mock.clone(), rig.run.correction().owned());
    drop(rig);
    clock.wait_until(clock.now_s() + 300.0);
    mock.borrow_mut().advance(clock.now_s());
    let mut none = Rig::on(plan.clone(), mock.clone(), clock.clone(), Some(owned.clone()));
    none.wish.confirmed = true;
    pass(&mut none, 20.0);
    assert!(none.shown().contains("warmer at its bearing"), "{}", none.shown());
    drop(none);
    let mut next = Rig::on(plan.clone(), mock, clock, Some(owned));
    next.run = next.run.with_heat(Some(heat));
    next.wish.confirmed = true;
    pass(&mut next, 600.0);
    assert_eq!(next.state(), State::Run, "{}", next.story());
    let due = by_the_whole_log(&plan, (next.clock.now_s() / 10.0).floor() * 10.0);
    assert!((f64::from(next.acting()[0]) + due).abs() < 2.0, "{:?} {due}", next.acting());
}
