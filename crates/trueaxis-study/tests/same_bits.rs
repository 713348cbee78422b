//! A sample depends on its number alone.

mod common;

use common::{frustum, values};

const INPUTS: &str = r#"
[[input]]
error = "EC0Y"
value = "0 ± 20 urad"
[[input]]
error = "EA0A"
value = { uniform = ["-300 urad", "0 urad"] }
[[input]]
error = "EYX"
curve = { u = "4 um", terms = 3 }
[[input]]
error = "EZ0t"
value = "0 ± 3 um"
per = "day"
[[input]]
error = "EA0Z"
added = "0 ± 20 urad"
per = "hall"
"#;

const STATES: &str = r#"
[[input]]
workpiece = "X"
value = { uniform = ["-200 mm", "200 mm"] }
per = "day"
[[input]]
tool_length = "100 ± 5 mm"
per = "hall"
"#;

/// A study in one piece, in many, backwards, by 1, 2 and 5 threads: the same bits.
#[test]
fn law_any_piece_by_any_threads_has_the_same_bits() {
    for (name, kind, states) in [
        ("bits-random", "monte-carlo", ""),
        ("bits-latin", "latin-hypercube", ""),
        ("bits-sobol", "sobol", ""),
        ("bits-states", "monte-carlo", STATES),
    ] {
        let design =
            format!("[design]\nkind = \"{kind}\"\nmachines = 30\ndays = 12\nsensitivity = 16\n");
        let study = frustum(name, &format!("{design}{INPUTS}{states}"));
        let (all, width) = (study.design.samples(), study.output_count());
        let whole = values(&study, 0..all);
        for size in [1, 7, 200, 513] {
            if size == 1 && !states.is_empty() {
                continue;
            }
            let mut starts: Vec<usize> = (0..all).step_by(size).collect();
            starts.reverse();
            for start in starts {
                let end = (start + size).min(all);
                let part = values(&study, start..end);
                assert_eq!(part, whole[start * width..end * width], "{name} {start}..{end}");
            }
        }
        for threads in [1, 2, 5] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            assert_eq!(pool.install(|| values(&study, 0..all)), whole, "{name}, {threads} threads");
        }
    }
}

/// The order of the inputs in the file does not matter, but for rounding; nor do inputs that are added, to the others.
#[test]
fn law_the_order_of_the_inputs_does_not_matter() {
    let blocks: Vec<&str> = INPUTS.split("[[input]]").skip(1).collect();
    for kind in ["monte-carlo", "sobol"] {
        let file = |blocks: &[&str]| {
            let inputs: String = blocks.iter().map(|b| format!("[[input]]{b}")).collect();
            format!("[design]\nkind = \"{kind}\"\nmachines = 32\ndays = 4\n{inputs}")
        };
        let forwards = frustum("order-1", &file(&blocks));
        let reversed: Vec<&str> = blocks.iter().rev().copied().collect();
        let backwards = frustum("order-2", &file(&reversed));
        let (a, b) = (values(&forwards, 0..128), values(&backwards, 0..128));
        for (a, b) in a.iter().zip(&b) {
            assert!((a - b).abs() < 1e-13, "{a} {b}");
        }
    }
    // Without the last input, the others of a random design are drawn as before.
    let all = frustum("order-3", &format!("[design]\nmachines = 8\n{INPUTS}"));
    let fewer: String = blocks[..4].iter().map(|b| format!("[[input]]{b}")).collect();
    let fewer = frustum("order-4", &format!("[design]\nmachines = 8\n{fewer}"));
    for sample in 0..8 {
        let (all, fewer) = (all.inputs_of(sample..sample + 1), fewer.inputs_of(sample..sample + 1));
        assert_eq!(all[..fewer.len()], fewer[..]);
    }
}

/// A machine keeps its errors on all of its days, the hall its own on all machines, and a day of a machine has its own.
#[test]
fn law_each_level_is_drawn_as_often_as_it_says() {
    let study = frustum("levels", &format!("[design]\nmachines = 5\ndays = 7\n{INPUTS}"));
    let at = |machine: usize, day: usize, input: &str| {
        let sample = machine * 7 + day;
        let number = study.inputs.iter().position(|i| i.name == input).unwrap();
        study.inputs_of(sample..sample + 1)[number]
    };
    for (machine, day) in [(1, 2), (4, 6), (3, 0)] {
        assert_eq!(at(machine, day, "EC0Y"), at(machine, 0, "EC0Y"));
        assert_ne!(at(machine, day, "EC0Y"), at(0, day, "EC0Y"));
        assert_eq!(at(machine, day, "EA0Z added"), at(0, day, "EA0Z added"));
        assert_ne!(at(machine, day, "EZ0t"), at(0, day, "EZ0t"));
        assert_ne!(at(machine, day, "EZ0t"), at(machine, (day + 1) % 7, "EZ0t"));
    }
}

/// Of a factorial design every combination has the same machines.
#[test]
fn law_combinations_have_the_same_machines() {
    let study = frustum(
        "levels-factorial",
        r#"
[design]
kind = "factorial"
machines = 10
[[input]]
error = "EC0Y"
value = { values = ["-20 urad", "0 urad", "20 urad"] }
[[input]]
error = "EA0A"
value = { values = ["-200 urad", "0 urad"] }
[[input]]
error = "EB0A"
value = "0 ± 30 urad"
"#,
    );
    assert_eq!(study.design.combinations(), 6);
    let inputs = study.inputs_of(0..60);
    for combination in 0..6 {
        for machine in 0..10 {
            let row = &inputs[(combination * 10 + machine) * 3..][..3];
            assert!((row[0] - [-20e-6, 0.0, 20e-6][combination / 2]).abs() < 1e-18);
            assert!((row[1] - [-200e-6, 0.0][combination % 2]).abs() < 1e-18);
            assert_eq!(row[2], inputs[machine * 3 + 2]);
        }
    }
}

/// The hall is one for all machines, on one day, too; and its first day does not depend on how many follow.
#[test]
fn law_the_hall_of_one_day_is_one_for_all_machines() {
    let values = |days: usize, input: &str| -> Vec<f64> {
        let design = format!("[design]\nmachines = 5\ndays = {days}\n{INPUTS}");
        let study = frustum(&format!("hall-{days}"), &design);
        let number = study.inputs.iter().position(|i| i.name == input).unwrap();
        let first = (0..5).map(|machine| machine * days);
        first.map(|sample| study.inputs_of(sample..sample + 1)[number]).collect()
    };
    let hall = values(1, "EA0Z added");
    assert!(hall.iter().all(|value| *value == hall[0]), "{hall:?}");
    assert_eq!(hall, values(2, "EA0Z added"));
    // What belongs to a machine or to a day of it differs, on one day, too.
    for input in ["EC0Y", "EZ0t"] {
        let own = values(1, input);
        assert!((1..5).all(|machine| own[machine] != own[0]), "{input}: {own:?}");
    }
}
