//! What logs cannot say: each with its name, its file and its line.

use super::{Cycle, Logs, jitter_square};
use trueaxis_input::plausible::{Limits, Quantity, Standing};
use trueaxis_input::{Diagnostics, Place};

/// Fewer rows are no cycle.
const FEWEST_ROWS: usize = 10;
/// A step between two rows that no body makes, K.
const JUMP_K: f64 = 5.0;
/// A jump is so many times the usual step.
const JUMP_STEPS: f64 = 10.0;
/// Others must move by so much before a sensor that stands still is stuck, K.
const MOVING_K: f64 = 0.5;
/// A temperature does not jitter like that from row to row, K.
const JITTER_K: f64 = 0.3;

/// Checks one cycle; `place` gives the place of a row of it.
pub fn check_cycle(
    cycle: &Cycle,
    logs: &Logs,
    (place, limits): (&dyn Fn(usize) -> Place, &Limits),
    problems: &mut Diagnostics,
) {
    let rows = cycle.displacement_mm.len();
    if rows < FEWEST_ROWS {
        let message = format!("cycle `{}` has too few rows: {rows}", cycle.name);
        let hint = format!("a cycle has {FEWEST_ROWS} rows or more; leave shorter ones out");
        problems.error("short-cycle", place(0), message, &hint);
        return;
    }
    let times = cycle.times_s.iter().flat_map(|t| t.windows(2));
    if let Some((row, t)) = times.enumerate().find(|(_, t)| t[1] <= t[0]) {
        let message = format!("the time runs from {} s to {} s", t[0], t[1]);
        let hint = "times rise from row to row; are two cycles joined? Name them in a cycle column";
        problems.error("time-runs-backwards", place(row + 1), message, hint);
    }
    check_displacement(cycle, (place, limits), problems);
    let widest = cycle.temperatures_celsius.iter().map(|t| spread(t)).fold(0.0, f64::max);
    for (name, celsius) in logs.sensors.iter().zip(&cycle.temperatures_celsius) {
        check_sensor((name, celsius), widest, (place, limits), problems);
    }
    if widest < MOVING_K {
        let message = format!("cycle `{}`: no sensor moves by {MOVING_K} K", cycle.name);
        problems.warn("nothing-moves", place(0), message, "it says little; warm the machine up");
    }
}

fn check_displacement(
    cycle: &Cycle,
    (place, limits): (&dyn Fn(usize) -> Place, &Limits),
    problems: &mut Diagnostics,
) {
    let d = &cycle.displacement_mm;
    let moved = spread(d);
    if moved == 0.0 {
        let message = "the displacement is the same in all rows".to_owned();
        problems.error("stuck-displacement", place(0), message, "is the probe connected?");
    } else {
        // From their mean: a probe may stand anywhere.
        let mean = d.iter().sum::<f64>() / d.len() as f64;
        let drift: Vec<f64> = d.iter().map(|v| v - mean).collect();
        limits.judge_column(Quantity::Deviation, ("displacement", &drift), place, problems);
    }
    if let Some(row) = jump(d, 0.0) {
        let step = (d[row] - d[row - 1]) * 1e3;
        let message = format!("the displacement jumps by {step:.1} µm between two rows");
        problems.warn("jumping-displacement", place(row), message, "did the probe slip?");
    }
}

fn check_sensor(
    (name, celsius): (&str, &[f64]),
    widest: f64,
    (place, limits): (&dyn Fn(usize) -> Place, &Limits),
    problems: &mut Diagnostics,
) {
    let standing = |v: &f64| limits.standing(Quantity::Temperature, *v);
    if let Some(row) = celsius.iter().position(|v| standing(v) == Standing::Impossible) {
        let message = format!("`{name}` says {} °C, which no machine has", celsius[row]);
        let hint = "°F, K, or swapped with the displacement? °C = (°F − 32)/1.8 = K − 273.15";
        problems.error("impossible-temperature", place(row), message, hint);
        return;
    }
    // A hot place alone is warm at times; °F are so always.
    if celsius.iter().all(|v| *v > 0.0 && standing(v) == Standing::Odd) {
        let coldest = celsius.iter().fold(f64::INFINITY, |low, v| low.min(*v));
        let message = format!("`{name}` is never colder than {coldest} °C");
        let hint = "°F, or swapped with the displacement? °C = (°F − 32)/1.8";
        problems.warn("warm-temperature", place(0), message, hint);
    }
    if jitter_square(celsius).sqrt() > JITTER_K {
        let message = format!("`{name}` jitters by more than {JITTER_K} K from row to row");
        let hint = "no body does so: swapped with the displacement, or a bad contact?";
        problems.warn("jittering-sensor", place(0), message, hint);
    }
    if spread(celsius) == 0.0 && widest >= MOVING_K {
        let message = format!("`{name}` stands still at {} °C while others move", celsius[0]);
        problems.warn("stuck-sensor", place(0), message, "is it connected? If not, leave it out");
    }
    if let Some(row) = jump(celsius, JUMP_K) {
        let (from, to) = (celsius[row - 1], celsius[row]);
        let message = format!("`{name}` jumps from {from} to {to} °C between two rows");
        problems.warn("jumping-sensor", place(row), message, "is it connected?");
    }
}

/// Looks at all cycles together.
pub fn check_cycles(logs: &Logs, problems: &mut Diagnostics) {
    let cycles = &logs.cycles;
    if cycles.len() < 2 && !problems.has_errors() {
        let place = Place::whole(cycles.first().map_or("", |c| &c.name));
        let message = "one cycle can be fitted by anything and judged by nothing".to_owned();
        let hint = "three cycles or more, each a log of its own or named by a cycle column";
        problems.error("too-few-cycles", place, message, hint);
    }
    for (i, cycle) in cycles.iter().enumerate() {
        let same = |c: &&Cycle| {
            c.displacement_mm == cycle.displacement_mm
                && c.temperatures_celsius == cycle.temperatures_celsius
        };
        if let Some(copy) = cycles[..i].iter().find(same) {
            let message = format!("it has the same readings as `{}`", copy.name);
            let hint = "a cycle and its copy are no two witnesses: what fits one fits the other";
            problems.error("duplicate-cycle", Place::whole(&cycle.name), message, hint);
        }
    }
}

/// A later log must not be one of those that the model comes from.
pub fn check_later(later: &Cycle, logs: &Logs, file: &str, problems: &mut Diagnostics) {
    let same = |c: &&Cycle| {
        c.displacement_mm == later.displacement_mm
            && c.temperatures_celsius == later.temperatures_celsius
    };
    if let Some(copy) = logs.cycles.iter().chain(&logs.later).find(same) {
        let message = format!("it has the same readings as `{}`", copy.name);
        let hint = "a score of readings that the model comes from promises what it knows already";
        problems.error("duplicate-cycle", Place::whole(file), message, hint);
    }
}

fn spread(values: &[f64]) -> f64 {
    let (low, high) =
        values.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(*v), h.max(*v)));
    high - low
}

/// The first row whose step is more than `least` and many times the usual one.
fn jump(values: &[f64], least: f64) -> Option<usize> {
    let steps: Vec<f64> = values.windows(2).map(|w| (w[1] - w[0]).abs()).collect();
    let mut sorted = steps.clone();
    sorted.sort_by(f64::total_cmp);
    let usual = sorted.get(sorted.len() / 2).copied().filter(|s| *s > 0.0)?;
    steps.iter().position(|s| *s > least && *s > JUMP_STEPS * usual).map(|i| i + 1)
}
