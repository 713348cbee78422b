//! Temperatures that change, several sources of heat, and what the coefficients' uncertainties do.

mod library;

use library::{checked, warm};
use proptest::prelude::*;
use std::sync::Arc;
use trueaxis_input::Diagnostics;
use trueaxis_machine::Machine;
use trueaxis_machine::file::NoTables;
use trueaxis_machine::heat::field::{ScaleField, Source, ierfc};
use trueaxis_machine::heat::{TemperatureLog, TemperatureRun, WarmingMachine};

const HOT: &str = r#"
machine = { name = "hot", chain = "w X' b Y Z t" }
[axis.X]
travel = ["0 mm", "900 mm"]
[axis.Y]
travel = ["0 mm", "900 mm"]
[tool]
length = "120 mm"
[workpiece]
expansion = "23 ± 1 um/(m K)"
[scale.X]
expansion = "10 ± 1 um/(m K)"
table_temperature = "20 degC"
sensors = { x_begin = "0 mm", x_end = "900 mm" }
[scale.Y]
expansion = "11 um/(m K)"
table_temperature = "20 degC"
heated = [
    { at = "0 mm", near = "left", far = "far", diffusivity = "4 mm^2/s", time = "1800 s" },
    { at = "150 mm", near = "right", far = "far", diffusivity = "4 mm^2/s", time = "900 s" },
]
[heat.EZ0t]
spindle = "1.5 ± 0.2 um/K"
column = "-0.5 ± 0.1 um/K"
"#;

fn hot() -> Machine {
    checked(HOT, "")
}

fn log(text: &str) -> Arc<TemperatureLog> {
    let mut problems = Diagnostics::new();
    let log = TemperatureLog::parse("log.csv", text, &mut problems);
    Arc::new(log.unwrap_or_else(|| panic!("{:?}", problems.sorted())))
}

/// EYY at a position of Y.
fn eyy(machine: &Machine, y: f64) -> f64 {
    let command = [0.0, y, 0.0, 0.0, 0.0, 0.0];
    machine.errors_at(&command, &[0.0; 6]).expect("inside").bodies[2].motion.0[1]
}

proptest! {
    #[test]
    fn law_two_constant_sources_are_the_sum_of_the_single_ones(
        g1 in -0.05..0.2_f64, g2 in -0.05..0.2_f64, y in 0.0..900.0_f64,
    ) {
        // What the sensors read under both fluxes; each also sees the other.
        let [long, short] = [1800.0, 900.0].map(|t: f64| (4.0 * 4.0 * t).sqrt());
        let rise = |l: f64| g1 * long * ierfc(l.abs() / long)
            + g2 * short * ierfc((l - 150.0).abs() / short);
        let text = format!("left={} right={} far=21", 21.0 + rise(0.0), 21.0 + rise(150.0));
        let both = warm(&hot(), &text);
        let single = |place_mm: f64, age_s: f64, g: f64| ScaleField {
            initial_celsius: 20.0,
            diffusivity_mm2_per_s: 4.0,
            sources: vec![Source { place_mm, steps: vec![(-age_s, g)] }],
        }.integral(0.0, [0.0, y], 20.0);
        let sum = 11e-6 * (single(0.0, 1800.0, g1) + single(150.0, 900.0, g2) + y);
        prop_assert!((eyy(&both, y) - sum).abs() < 2e-9, "{} {sum}", eyy(&both, y));
    }

    #[test]
    fn law_fluxes_of_two_places_are_found_again_from_their_log(
        g in prop::collection::vec((-0.1..0.2_f64, -0.1..0.2_f64), 2..10),
    ) {
        let times: Vec<f64> = (0..=g.len()).map(|i| 120.0 * i as f64).collect();
        let source = |place_mm: f64, of: fn(&(f64, f64)) -> f64| {
            let steps = times.iter().zip(&g).map(|(t, g)| (*t, of(g))).collect();
            Source { place_mm, steps }
        };
        let made = ScaleField {
            initial_celsius: 0.0,
            diffusivity_mm2_per_s: 4.0,
            sources: vec![source(0.0, |g| g.0), source(60.0, |g| g.1)],
        };
        let rises = [0.0, 60.0].map(|l| times.iter().map(|t| made.celsius_at(l, *t)).collect());
        let found = Source::from_rises(&[0.0, 60.0], 4.0, &times, &rises).expect("solvable");
        for (found, made) in found.iter().zip(&made.sources) {
            for (a, b) in found.steps.iter().zip(&made.steps) {
                prop_assert!((a.1 - b.1).abs() < 1e-9, "{a:?} {b:?}");
            }
        }
    }

    #[test]
    fn law_a_warming_machine_keeps_within_its_bound(
        steps in prop::collection::vec((-3.0..3.0_f64, -3.0..3.0_f64, -2.0..2.0_f64), 2..8),
        at in prop::collection::vec(0.0..1.0_f64, 1..20),
    ) {
        let mut text = "time_s,x_begin_degC,x_end_degC,spindle_degC,column_degC\n".to_owned();
        let mut now = [20.0, 21.0, 25.0];
        for (i, step) in steps.iter().enumerate() {
            let [a, b, c] = now;
            text += &format!("{},{a},{b},{c},22\n", 100 * i);
            now = [a + step.0, b + step.1, c + step.2];
        }
        let log = log(&text);
        let run = TemperatureRun { log: Arc::clone(&log), start_s: 0.0 };
        let machine = hot();
        let warming = WarmingMachine::new(&machine, &run, &mut Diagnostics::new()).expect("sound");
        let command = [900.0, 0.0, 0.0, 0.0, 0.0, 0.0];
        let end_s = run.lasts_s();
        let exact = |t: f64| {
            let there = machine.at(&log.at(t).expect("inside"), &mut Diagnostics::new());
            there.expect("sound").errors_at(&command, &[0.0; 6]).expect("inside")
        };
        for part in at {
            let (begun, until) = warming.at(part * end_s).expect("inside");
            let held = begun.errors_at(&command, &[0.0; 6]).expect("inside");
            // Anywhere in the time that it holds.
            let within = part * end_s + 0.999 * (until.min(end_s) - part * end_s);
            let now = exact(within);
            // 10 µm/(m·K) · 0.9 m · 0.01 K; (1.5 + 0.5) µm/K · 0.01 K
            let x = held.bodies[1].motion.0[0] - now.bodies[1].motion.0[0];
            let z = held.bodies[4].location.0[2] - now.bodies[4].location.0[2];
            prop_assert!(x.abs() <= 90e-6 * 1.0001 && z.abs() <= 20e-6 * 1.0001, "{x} {z}");
        }
    }
}

#[test]
fn law_a_heated_scale_takes_its_history_from_the_log() {
    // Twice the same temperatures, once after an hour of heat, once after a minute of it.
    let rows = |hot_s: f64| {
        let mut text = "time_s,left_degC,right_degC,far_degC\n".to_owned();
        for i in 0..=60 {
            let t = 60.0 * f64::from(i);
            let rise = 10.0 * ((t - 3600.0 + hot_s).max(0.0) / hot_s).sqrt();
            text += &format!("{t},{},20,20\n", 20.0 + rise);
        }
        log(&text)
    };
    let grown = [3600.0, 600.0].map(|hot_s| {
        let run = TemperatureRun { log: rows(hot_s), start_s: 3500.0 };
        let warming = WarmingMachine::new(&hot(), &run, &mut Diagnostics::new()).expect("sound");
        let (end, _) = warming.at(100.0).expect("at the very end");
        let (direct, at) = (run.log.at(3600.0).expect("inside"), &mut Diagnostics::new());
        let direct = hot().at(&direct, at).expect("sound");
        assert!((eyy(&end, 140.0) - eyy(&direct, 140.0)).abs() < 1e-12);
        // Between rows the field is continuous: no step of more than the bound.
        let (before, until) = warming.at(39.0).expect("inside");
        let (later, _) = warming.at(until).expect("inside");
        assert!((eyy(&before, 140.0) - eyy(&later, 140.0)).abs() < 3e-4);
        eyy(&end, 140.0)
    });
    assert!(grown[0] > 1.1 * grown[1], "{grown:?}");
}

#[test]
fn a_machine_holds_until_a_sensor_of_it_moves() {
    // `hall` is not used; x_begin rises by 0.01 K in 10 s, then stands.
    let text =
        "time_s,x_begin_degC,x_end_degC,hall_degC\n0,20,20,0\n100,20.1,20,30\n200,20.1,20,0\n";
    let run = TemperatureRun { log: log(text), start_s: 0.0 };
    let warming = WarmingMachine::new(&hot(), &run, &mut Diagnostics::new()).expect("sound");
    assert!((warming.at(0.0).expect("inside").1 - 10.0).abs() < 1e-9);
    assert!((warming.at(95.0).expect("inside").1).is_infinite());
    assert!(warming.at(200.5).is_none() && warming.at(-1.0).is_none());
    let late = TemperatureRun { start_s: 300.0, ..run };
    let mut problems = Diagnostics::new();
    assert!(WarmingMachine::new(&hot(), &late, &mut problems).is_none());
    assert_eq!(problems.iter().map(|d| d.code).collect::<Vec<_>>(), ["outside-log"]);
}

#[test]
fn every_coefficient_is_an_uncertain_quantity() {
    let machine = warm(&hot(), "x_begin=25 x_end=25 spindle=30 column=30 workpiece=28");
    let names = machine.uncertain_quantities();
    assert_eq!(
        names,
        [
            "expansion of scale X",
            "EZ0t per K of spindle",
            "EZ0t per K of column",
            "expansion of the workpiece"
        ]
    );
    let command = [800.0, 0.0, 0.0, 0.0, 0.0, 0.0];
    let errors = machine.errors_at(&command, &[0.0; 6]).expect("inside");
    let known = machine.uncertainties_at(&command, &names);
    let moved = |quantity: usize| {
        let displaced = known.displaced_by(&errors, quantity, 1.0);
        machine.deviation(&command, &displaced).tip_mm - machine.deviation(&command, &errors).tip_mm
    };
    // 1 µm/(m·K) · 5 K · 800 mm: the table goes −X, the tool +X in the workpiece.
    assert!((moved(0).x - 0.004).abs() < 1e-12);
    // 0.2 µm/K · 10 K and 0.1 µm/K · 10 K along Z, each alone.
    assert!((moved(1).z - 0.002).abs() < 1e-12 && (moved(2).z - 0.001).abs() < 1e-12);
    // −1 µm/(m·K) · 8 K · 800 mm
    assert!((moved(3).x + 0.0064).abs() < 1e-12);
    let u = known.of_errors();
    assert!((u.bodies[4].location.0[2] - 0.002_f64.hypot(0.001)).abs() < 1e-15);
}

#[test]
fn bad_heated_places_are_named() {
    let codes = |heated: &str| {
        let text = format!(
            "machine = {{ name = \"m\", chain = \"w b X Y Z t\" }}\n[scale.X]\n\
             expansion = \"11 um/(m K)\"\ntable_temperature = \"20 degC\"\nheated = {heated}\n"
        );
        let problems = Machine::check("m.toml", &text, &NoTables).1;
        problems.iter().map(|d| d.code).collect::<Vec<_>>()
    };
    let place = |at: &str, near: &str, far: &str, a: &str| {
        format!("{{ at = \"{at}\", near = \"{near}\", far = \"{far}\", diffusivity = \"{a}\" }}")
    };
    let one = place("0 mm", "a", "f", "4 mm^2/s");
    let with = |other: String| codes(&format!("[{one}, {other}]"));
    assert!(with(place("90 mm", "b", "f", "4 mm^2/s")).is_empty());
    assert!(codes(&one).is_empty());
    assert_eq!(with(place("0 mm", "b", "f", "4 mm^2/s")), ["heated-twice"]);
    assert_eq!(with(place("90 mm", "a", "f", "4 mm^2/s")), ["heated-twice"]);
    assert_eq!(with(place("90 mm", "b", "g", "4 mm^2/s")), ["two-scales-in-one"]);
    assert_eq!(with(place("90 mm", "b", "f", "5 mm^2/s")), ["two-scales-in-one"]);
    assert_eq!(codes("[]"), ["missing-key"]);
    assert_eq!(codes("[3]"), ["wrong-type"]);
}
