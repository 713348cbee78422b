//! Thermal memory: in a few numbers what the full history says, whatever the rows.

mod library;

use proptest::prelude::*;
use std::fmt::Write;
use std::sync::Arc;
use trueaxis_input::Diagnostics;
use trueaxis_machine::Machine;
use trueaxis_machine::file::NoTables;
use trueaxis_machine::heat::{Conditions, MemoryFault, TemperatureLog, ThermalMemory};

const DAY_S: f64 = 86_400.0;

/// A screw with bearings at both ends, 2 m apart.
fn screw(time: &str) -> Machine {
    let text = format!(
        "[machine]\nname = \"screw\"\nchain = \"w b X Y Z t\"\n\
         [axis]\nX = {{ travel = [\"0 mm\", \"2000 mm\"] }}\n\
         [scale.X]\nexpansion = \"11 um/(m K)\"\ntable_temperature = \"20 degC\"\n\
         heated = [\n\
         {{ at = \"0 mm\", near = \"fixed\", far = \"far\", diffusivity = \"12 mm^2/s\"{time} }},\n\
         {{ at = \"2000 mm\", near = \"floating\", far = \"far\", diffusivity = \"12 mm^2/s\"{time} }},\n]\n"
    );
    let (machine, problems) = Machine::check("screw.toml", &text, &NoTables);
    machine.unwrap_or_else(|| panic!("{problems:?}"))
}

/// What the bearings read: shifts with breaks, on a hall that warms up.
fn celsius(sensor: &str, time_s: f64, (heat_k, break_s): (f64, f64)) -> f64 {
    let hall = 21.0 + 2.0 * (std::f64::consts::TAU * time_s / DAY_S).sin();
    let shift_s = 4.0 * 3600.0;
    let phase_s = time_s % (shift_s + break_s);
    // First order, with an hour: up in the shift, down in the break.
    let up = 1.0 - (-phase_s.min(shift_s) / 3600.0).exp();
    let rise = if phase_s < shift_s { up } else { up * (-(phase_s - shift_s) / 3600.0).exp() };
    match sensor {
        "fixed" => hall + heat_k * rise,
        "floating" => hall + 0.4 * heat_k * rise,
        _ => hall,
    }
}

type Shifts = (f64, f64);

fn remembered(machine: &Machine, times_s: &[f64], shifts: Shifts) -> ThermalMemory {
    let mut memory = ThermalMemory::default();
    for time_s in times_s {
        let read = |sensor: &str| Some(celsius(sensor, *time_s, shifts));
        memory.take(machine, *time_s, &read).unwrap_or_else(|e| panic!("{e}"));
    }
    memory
}

fn conditions(time_s: f64, shifts: Shifts) -> Conditions {
    ["fixed", "floating", "far"].iter().fold(Conditions::default(), |found, sensor| {
        found.with_reading(sensor, celsius(sensor, time_s, shifts))
    })
}

/// EXX at eleven places, µm.
fn expansion_um(machine: &Machine) -> Vec<f64> {
    let at = |i: u32| {
        let command = [200.0 * f64::from(i), 0.0, 0.0, 0.0, 0.0, 0.0];
        let errors = machine.errors_at(&command, &[0.0; 6]).expect("everywhere");
        machine.deviation(&command, &errors).tip_mm.x * 1e3
    };
    (0..=10).map(at).collect()
}

fn by_memory(machine: &Machine, memory: &ThermalMemory, time_s: f64, shifts: Shifts) -> Vec<f64> {
    let now = conditions(time_s, shifts);
    let warm = memory.machine_at(machine, &now, time_s, &mut Diagnostics::new());
    expansion_um(&warm.expect("a machine"))
}

fn every(step_s: f64, until_s: f64) -> Vec<f64> {
    let count = (until_s / step_s).round() as u32;
    (0..=count).map(|i| f64::from(i) * step_s).collect()
}

/// Uneven rows; the first and the last stay.
fn jittered(times_s: Vec<f64>) -> Vec<f64> {
    let end_s = times_s.last().copied().unwrap_or(0.0);
    let moved = |t: f64| if t > 0.0 && t < end_s { t + 20.0 * (t * 0.37).sin() } else { t };
    times_s.into_iter().map(moved).collect()
}

fn apart(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 8, ..ProptestConfig::default() })]

    /// The judge is the whole log (eq. 97), of which nothing is merged.
    #[test]
    fn law_it_is_the_full_history_within_a_thousandth(
        heat_k in 4.0..20.0_f64,
        break_s in 600.0..7200.0_f64,
        hours in 2.0..30.0_f64,
    ) {
        let (machine, shifts) = (screw(""), (heat_k, break_s));
        let end_s = (hours * 60.0).round() * 60.0;
        let times_s = jittered(every(60.0, end_s));
        let mut text = "time_s,fixed_degC,floating_degC,far_degC\n".to_owned();
        for t in &times_s {
            let [a, b, c] = ["fixed", "floating", "far"].map(|s| celsius(s, *t, shifts));
            writeln!(text, "{t},{a},{b},{c}").unwrap();
        }
        let log = TemperatureLog::parse("log.csv", &text, &mut Diagnostics::new()).map(Arc::new);
        let full = log.unwrap().at(end_s).unwrap();
        let full = expansion_um(&machine.at(&full, &mut Diagnostics::new()).unwrap());
        let memory = remembered(&machine, &times_s, shifts);
        let found = by_memory(&machine, &memory, end_s, shifts);
        let largest = full.iter().fold(0.0_f64, |most, v| most.max(v.abs()));
        prop_assert!(apart(&found, &full) < 1e-3 * largest, "{found:?} {full:?}");
        prop_assert!(largest > 5.0);
    }
}

/// Rows each 20 to 300 s, and rows that jitter. The flux between two rows counts as constant, which makes an error in proportion to
/// their distance: a thousandth of the expansion per minute here, and no more.
#[test]
fn law_the_spacing_of_the_rows_matters_by_a_thousandth_per_minute() {
    let (machine, shifts) = (screw(""), (12.0, 1800.0));
    let end_s = 36_000.0;
    let of = |times_s: &[f64]| {
        by_memory(&machine, &remembered(&machine, times_s, shifts), end_s, shifts)
    };
    let due = of(&every(10.0, end_s));
    let largest = due.iter().fold(0.0_f64, |most, v| most.max(v.abs()));
    for (step_s, times_s) in [20.0, 60.0, 120.0, 300.0]
        .map(|s| (s, every(s, end_s)))
        .into_iter()
        .chain([(100.0, jittered(every(60.0, end_s)))])
    {
        let apart = apart(&of(&times_s), &due);
        assert!(apart < 1.1e-3 * largest * step_s / 60.0, "{step_s} s: {apart} of {largest}");
    }
    // More often than it takes rows makes no difference at all.
    let dense = remembered(&machine, &every(2.5, end_s), shifts);
    let tens = remembered(&machine, &every(10.0, end_s), shifts);
    assert_eq!(dense, tens);
}

/// A month of a row a minute is no larger than two days of them.
#[test]
fn law_its_size_does_not_grow() {
    let (machine, shifts) = (screw(""), (12.0, 1800.0));
    let mut memory = ThermalMemory::default();
    let (mut after_two_days, mut most) = (0, 0);
    for time_s in every(60.0, 30.0 * DAY_S) {
        let read = |sensor: &str| Some(celsius(sensor, time_s, shifts));
        memory.take(&machine, time_s, &read).unwrap();
        if time_s == 2.0 * DAY_S {
            after_two_days = memory.size();
        }
        most = most.max(memory.size());
    }
    assert!(after_two_days > 100 && most < 2 * after_two_days, "{after_two_days} {most}");
}

/// A constant flux since a stated time is the closed form of Zhang et al. 2019, eq. 6 and 7, at once and later.
#[test]
fn law_a_stated_time_is_a_constant_flux() {
    let machine = screw(", time = \"30 min\"");
    let read = |sensor: &str| Some(if sensor == "far" { 21.0 } else { 29.0 });
    let mut memory = ThermalMemory::default();
    memory.take(&machine, 100.0, &read).unwrap();
    let now = ["fixed", "floating", "far"].iter().fold(Conditions::default(), |found, sensor| {
        found.with_reading(sensor, read(sensor).unwrap())
    });
    let by_memory = memory.machine_at(&machine, &now, 100.0, &mut Diagnostics::new()).unwrap();
    let typed = machine.at(&now, &mut Diagnostics::new()).unwrap();
    assert!(apart(&expansion_um(&by_memory), &expansion_um(&typed)) < 1e-9);
    // Without a time nothing is known.
    let mut none = ThermalMemory::default();
    let fault = none.take(&screw(""), 100.0, &read);
    assert!(matches!(fault, Err(MemoryFault::NotUniform { rise_k, .. }) if rise_k == 8.0));
    assert_eq!(none, ThermalMemory::default());
    let lost = |sensor: &str| (sensor != "far").then_some(20.0);
    let fault = none.take(&screw(""), 100.0, &lost);
    assert!(matches!(fault, Err(MemoryFault::NoReading { sensor, .. }) if sensor == "far"));
}

/// Another clock, and a pause of two hours in which nothing was read: the same as a log without those rows.
#[test]
fn law_a_pause_is_a_row_that_is_long() {
    let (machine, shifts) = (screw(""), (12.0, 1800.0));
    let all = every(60.0, 36_000.0);
    let rows: Vec<f64> = all.into_iter().filter(|t| !(14_400.0..21_600.0).contains(t)).collect();
    let whole = remembered(&machine, &rows, shifts);
    let (before, after) = rows.split_at(rows.iter().position(|t| *t >= 21_600.0).unwrap());
    // Stopped, and begun again on a clock of its own.
    let mut memory = remembered(&machine, before, shifts).shifted(-21_600.0);
    assert!(memory.fits(&machine) && !memory.fits(&library::machine("gantry-001")));
    for time_s in after {
        let read = |sensor: &str| Some(celsius(sensor, *time_s, shifts));
        memory.take(&machine, time_s - 21_600.0, &read).unwrap();
    }
    let found = {
        let warm = memory.machine_at(
            &machine,
            &conditions(36_000.0, shifts),
            14_400.0,
            &mut Diagnostics::new(),
        );
        expansion_um(&warm.unwrap())
    };
    assert!(apart(&found, &by_memory(&machine, &whole, 36_000.0, shifts)) < 1e-6);
}
