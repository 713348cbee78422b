//! Heat: the field against mpmath and its own equation, the thermal machine against its formulas.

#![allow(clippy::print_stdout, reason = "says why it skips")]

mod library;

use library::{checked, warm};
use proptest::prelude::*;
use std::sync::Arc;
use trueaxis_geometry::Vec3;
use trueaxis_input::{CsvTable, Diagnostics};
use trueaxis_machine::Machine;
use trueaxis_machine::batch::{Commands, CompiledMachine, DeviationTable};
use trueaxis_machine::file::NoTables;
use trueaxis_machine::heat::field::{HeatedPoint, ScaleField, Source, i2erfc, ierfc};
use trueaxis_machine::heat::{Conditions, ErrorPart, TemperatureLog};

#[track_caller]
fn judge(table: &CsvTable) {
    let column = |name: &str| &table.column(name).expect("a column").values;
    let mut worst = 0.0_f64;
    for ((x, one), two) in column("x").iter().zip(column("ierfc")).zip(column("i2erfc")) {
        for (ours, theirs) in [(ierfc(*x), *one), (i2erfc(*x), *two)] {
            // Below that a double has no twelve digits left.
            if theirs > 1e-290 {
                worst = worst.max((ours / theirs - 1.0).abs());
            }
        }
    }
    assert!(worst < 1e-12, "{worst:e}");
}

#[test]
fn oracle_ierfc_and_i2erfc_over_the_whole_range() {
    let mut problems = Diagnostics::new();
    let table = CsvTable::parse("ierfc.csv", include_str!("data/ierfc.csv"), &mut problems);
    assert!(!problems.has_errors() && table.rows() > 400);
    judge(&table);
}

#[test]
fn oracle_ierfc_against_the_shared_table() {
    let root = concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared/data/outside/reference");
    let Ok(text) = std::fs::read_to_string(format!("{root}/generated/ierfc_mpmath.csv")) else {
        println!("skipped: no ../shared/data/outside");
        return;
    };
    judge(&CsvTable::parse("ierfc_mpmath.csv", &text, &mut Diagnostics::new()));
}

/// Gauss–Legendre with 5 points on many intervals: good to the last digits on smooth pieces.
fn quadrature(f: impl Fn(f64) -> f64, from: f64, to: f64) -> f64 {
    const X: [f64; 3] = [0.0, 0.538_469_310_105_683, 0.906_179_845_938_664];
    const W: [f64; 3] =
        [0.568_888_888_888_888_9, 0.478_628_670_499_366_47, 0.236_926_885_056_189_08];
    const PIECES: usize = 400;
    let h = (to - from) / PIECES as f64;
    let piece = |i: usize| {
        let middle = from + h * (i as f64 + 0.5);
        let at = |x: f64| f(middle + 0.5 * h * x);
        0.5 * h * (W[0] * at(0.0) + W[1] * (at(X[1]) + at(-X[1])) + W[2] * (at(X[2]) + at(-X[2])))
    };
    (0..PIECES).map(piece).sum()
}

fn field(steps: Vec<(f64, f64)>) -> ScaleField {
    let sources = vec![Source { place_mm: 0.0, steps }];
    ScaleField { initial_celsius: 26.0, diffusivity_mm2_per_s: 4.0, sources }
}

proptest! {
    #[test]
    fn law_the_field_satisfies_the_heat_equation_and_the_flux(
        l in 5.0..400.0_f64, t in 300.0..5000.0_f64, g in 0.01..0.2_f64,
    ) {
        let f = field(vec![(0.0, g)]);
        let (h, k) = (1.0, 1.0);
        let at = |l: f64, t: f64| f.celsius_at(l, t);
        let second = (at(l + h, t) - 2.0 * at(l, t) + at(l - h, t)) / (h * h);
        let rate = (at(l, t + k) - at(l, t - k)) / (2.0 * k);
        prop_assert!((4.0 * second - rate).abs() < 1e-4 * (1e-3 + rate.abs()), "{second} {rate}");
        // −∂T/∂l = q/λ at the surface: one-sided difference of second order.
        let e = 1e-3;
        let slope = (-3.0 * at(0.0, t) + 4.0 * at(e, t) - at(2.0 * e, t)) / (2.0 * e);
        prop_assert!((slope / -g - 1.0).abs() < 1e-6, "{slope} {g}");
    }

    #[test]
    fn law_the_integral_is_the_quadrature(
        place in 0.0..1000.0_f64, from in 0.0..1000.0_f64, to in 0.0..1000.0_f64,
        near in 20.0..60.0_f64, time in 100.0..20_000.0_f64,
    ) {
        let f = HeatedPoint {
            place_mm: place, near_celsius: near, far_celsius: 24.0,
            diffusivity_mm2_per_s: 4.0, time_s: time,
        };
        let exact = f.integral(from, to, 20.0);
        // The kink at the place must be an end.
        let rise = |s: f64| f.celsius_at(s) - 20.0;
        let place = place.clamp(from.min(to), from.max(to));
        let numeric = quadrature(rise, from, place) + quadrature(rise, place, to);
        let rise = (near - 20.0).abs().max(4.0);
        // The integral is a difference of two from the place on: their rounding stays, however short the way is.
        let reach = (from - f.place_mm).abs().max((to - f.place_mm).abs());
        let allowed = 1e-12 * ((to - from).abs() * rise).max(1.0) + 2e-15 * reach * rise;
        prop_assert!((exact - numeric).abs() <= allowed, "{exact} {numeric}");
    }

    #[test]
    fn law_duhamel_with_constant_heat_is_the_closed_form(
        p in 0.0..800.0_f64, cuts in prop::collection::vec(1.0..200.0_f64, 0..6),
    ) {
        // The same flux stated again and again changes nothing.
        let mut steps = vec![(0.0, 0.05)];
        let mut t = 0.0;
        for cut in cuts {
            t += cut;
            steps.push((t, 0.05));
        }
        let (once, often) = (field(vec![(0.0, 0.05)]), field(steps));
        prop_assert!((once.celsius_at(p, 1500.0) - often.celsius_at(p, 1500.0)).abs() < 1e-12);
        let near = once.celsius_at(0.0, 1500.0);
        let closed = HeatedPoint {
            place_mm: 0.0, near_celsius: near, far_celsius: 26.0,
            diffusivity_mm2_per_s: 4.0, time_s: 1500.0,
        };
        prop_assert!((once.celsius_at(p, 1500.0) - closed.celsius_at(p)).abs() < 1e-12);
        let (a, b) = (once.integral(1500.0, [0.0, p], 20.0), closed.integral(0.0, p, 20.0));
        prop_assert!((a - b).abs() < 1e-9 * (1.0 + a.abs()));
    }

    #[test]
    fn law_the_flux_from_a_log_gives_the_log_back(
        rises in prop::collection::vec(-3.0..8.0_f64, 2..12),
    ) {
        let times: Vec<f64> = (0..=rises.len()).map(|i| 120.0 * i as f64).collect();
        let mut log = vec![0.0];
        log.extend(&rises);
        let source = Source::from_rise(0.0, 4.0, &times, &log).expect("rising times");
        let f = ScaleField { initial_celsius: 20.0, diffusivity_mm2_per_s: 4.0, sources: vec![source] };
        for (t, rise) in times.iter().zip(&log) {
            prop_assert!((f.celsius_at(0.0, *t) - 20.0 - rise).abs() < 1e-9);
        }
    }
}

const HOT: &str = r#"
[machine]
name = "hot"
chain = "w C' X' b Y Z t"
[axis.X]
travel = ["-500 mm", "500 mm"]
[axis.Y]
travel = ["0 mm", "900 mm"]
[axis.Z]
placement = "0 0 300 mm"
[workpiece]
mounting = "10 20 30 mm"
expansion = "23 um/(m K)"
fixed_point = "5 6 7 mm"
[tool]
length = "120 mm"
[location]
EC0Y = "12 urad"
[motion.Y]
EYY = { polynomial = ["0 um", "3 um"], scale = "900 mm", reversal = "1 um" }
measured = { temperature = "22 degC" }
[scale.X]
expansion = "10 ± 1 um/(m K)"
table_temperature = "20 degC"
fixed_point = "-100 mm"
sensors = { x = "0 mm" }
[scale.Y]
expansion = "8 um/(m K)"
sensors = { y_end = "900 mm", y_middle = "400 mm", y_begin = "0 mm" }
[scale.Z]
expansion = "11 um/(m K)"
table_temperature = "20 degC"
heated = { at = "0 mm", near = "z_near", far = "z_far", diffusivity = "4 mm^2/s", time = "1800 s" }
[heat.EZ0t]
spindle = "1.5 ± 0.2 um/K"
[heat.EA0Z]
column = "2 urad/K"
reference = "22 degC"
"#;

fn hot() -> Machine {
    checked(HOT, "")
}

const ALL: &str = "x=25 y_begin=22 y_middle=27 y_end=24 z_near=35 z_far=21 spindle=40 column=25 \
                   workpiece=28";

#[test]
fn a_scale_that_carries_the_workpiece_moves_it_back() {
    let machine = warm(&hot(), "x=25");
    let command = [0.0, 400.0, 0.0, 0.0, 0.0, 0.0];
    let errors = machine.errors_at(&command, &[0.0; 6]).unwrap();
    // 10 µm/(m·K) · 5 K · (400 + 100) mm = 25 µm: the table goes −X, the tool +X in the workpiece.
    assert!((errors.bodies[2].motion.0[0] + 0.025).abs() < 1e-15);
    let cold = hot().deviation(&command, &hot().errors_at(&command, &[0.0; 6]).unwrap());
    let dx = machine.deviation(&command, &errors).tip_mm.x - cold.tip_mm.x;
    assert!((dx - 0.025).abs() < 1e-12, "{dx}");
    let u = machine.uncertainties_at(&command, &machine.uncertain_quantities()).of_errors();
    assert!((u.bodies[2].motion.0[0] - 0.0025).abs() < 1e-15);
}

#[test]
fn structure_and_workpiece_by_hand() {
    let machine = warm(&hot(), "spindle=40 column=25 workpiece=28");
    let command = [0.0; 6];
    let errors = machine.errors_at(&command, &[0.0; 6]).unwrap();
    // 1.5 µm/K · 20 K = 30 µm; 2 µrad/K · 3 K = 6 µrad; 23e-6 · 8 K · (p − f)
    assert!((errors.bodies[5].location.0[2] - 0.03).abs() < 1e-15);
    assert!((errors.bodies[4].location.0[3] - 6e-6).abs() < 1e-18);
    let p = machine.deviation(&command, &Default::default()).nominal_tip.vector();
    let grown = (p - Vec3::new(5.0, 6.0, 7.0)) * (23e-6 * 8.0);
    assert!((errors.workpiece_mm - grown).norm() < 1e-15);
}

#[test]
fn law_without_conditions_not_a_bit_changes() {
    let heated = hot();
    let cut = HOT.find("[scale.X]").expect("there");
    let plain = HOT[..cut].replace("expansion = \"23 um/(m K)\"\nfixed_point = \"5 6 7 mm\"\n", "");
    let plain = Machine::check("plain.toml", &plain, &NoTables).0.expect("sound");
    let nothing = warm(&heated, "");
    for q in [-300.0, 0.0, 123.4] {
        let command = [0.3, q, 400.0 + q, -q, 0.0, 0.0];
        let of = |m: &Machine| m.deviation(&command, &m.errors_at(&command, &[1.0; 6]).unwrap());
        assert_eq!(of(&heated), of(&plain));
        assert_eq!(of(&nothing), of(&plain));
    }
}

#[test]
fn law_parts_sum_up_and_the_batch_agrees() {
    let machine = warm(&hot(), ALL);
    assert!(CompiledMachine::new(&machine).is_fast());
    let mut columns = vec![Vec::new(); 4];
    for i in 0..200 {
        let s = f64::from(i);
        for (column, q) in columns.iter_mut().zip([0.02 * s, 4.0 * s - 400.0, 4.4 * s, 3.0 * s]) {
            column.push(q);
        }
    }
    let borrowed: Vec<&[f64]> = columns.iter().map(Vec::as_slice).collect();
    let mut table = DeviationTable::zeros(200);
    CompiledMachine::new(&machine)
        .deviations(&Commands::new(&borrowed), &mut table.columns())
        .expect("inside");
    for i in 0..200 {
        let mut command = [0.0; 6];
        for (q, column) in command.iter_mut().zip(&columns) {
            *q = column[i];
        }
        let errors = machine.errors_at(&command, &[0.0; 6]).expect("inside");
        let whole = machine.deviation(&command, &errors);
        assert!((whole.tip_mm - table.at(i).tip_mm).norm() < 1e-12);
        let pose = machine.pose(&command, &errors);
        let tip = pose.linear() * machine.tip_mm() + pose.shift_mm();
        assert!((tip - whole.nominal_tip.vector() - whole.tip_mm).norm() < 1e-9);
        let parts = ErrorPart::ALL.map(|p| machine.part(&command, &errors, p));
        let sum: Vec3 = parts.iter().map(|p| machine.deviation(&command, p).tip_mm).sum();
        assert!((sum - whole.tip_mm).norm() < 1e-5, "{sum} {}", whole.tip_mm);
        let shares = machine.shares(&command, &errors);
        let sum: Vec3 = shares.iter().map(|s| machine.deviation(&command, &s.errors).tip_mm).sum();
        assert!((sum - whole.tip_mm).norm() < 1e-5);
    }
    let names: Vec<String> =
        machine.shares(&[0.0; 6], &Default::default()).into_iter().map(|s| s.name).collect();
    for name in ["EYY", "EXX(scale)", "EZ0t(structure)", "EA0Z(structure)", "workpiece"] {
        assert!(names.iter().any(|n| n == name), "{name} {names:?}");
    }
}

#[test]
fn law_the_heated_scale_follows_the_exact_integral() {
    let machine = warm(&hot(), "z_near=35 z_far=21");
    let exact = HeatedPoint {
        place_mm: 0.0,
        near_celsius: 35.0,
        far_celsius: 21.0,
        diffusivity_mm2_per_s: 4.0,
        time_s: 1800.0,
    };
    for i in -100..=100 {
        let command = [0.0, 0.0, 0.0, 7.77 * f64::from(i), 0.0, 0.0];
        let errors = machine.errors_at(&command, &[0.0; 6]).expect("everywhere");
        let theirs = 11e-6 * exact.integral(0.0, command[3], 20.0);
        assert!((errors.bodies[4].motion.0[2] - theirs).abs() < 1e-9, "{i}");
    }
}

#[test]
fn law_a_log_of_constant_flux_is_the_closed_form_at_its_end() {
    // The surface rises with √τ under constant flux.
    let mut text = String::from("time_s,z_near_degC,z_far_degC\n");
    for i in 0..=60 {
        let t = 30.0 * f64::from(i);
        text += &format!("{t},{},21\n", 21.0 + 14.0 * (t / 1800.0).sqrt());
    }
    let mut problems = Diagnostics::new();
    let log = TemperatureLog::parse("log.csv", &text, &mut problems).map(Arc::new).expect("sound");
    let conditions = log.at(1800.0).expect("in the log");
    let logged = hot().at(&conditions, &mut problems).expect("sound");
    let closed = warm(&hot(), "z_near=35 z_far=21");
    for z in [-200.0, 0.0, 50.0, 400.0] {
        let command = [0.0, 0.0, 0.0, z, 0.0, 0.0];
        let ezz = |m: &Machine| m.errors_at(&command, &[0.0; 6]).unwrap().bodies[4].motion.0[2];
        assert!((ezz(&logged) - ezz(&closed)).abs() < 1e-9, "{z}");
    }
}

#[test]
fn bad_conditions_are_named() {
    let codes = |text: &str| {
        let mut problems = Diagnostics::new();
        let conditions = Conditions::typed("t", text, &mut problems).expect("sound");
        let found = hot().at(&conditions, &mut problems).is_some();
        let errors = problems.iter().filter(|d| d.severity.to_string() == "error");
        (found, errors.map(|d| d.code).collect::<Vec<_>>())
    };
    assert_eq!(codes("scale_q=20"), (false, vec!["unknown-sensor"]));
    assert_eq!(codes("y_end=20"), (false, vec!["missing-sensor"]));
    assert_eq!(codes(ALL), (true, vec![]));
}

#[test]
fn bad_sections_are_named() {
    let codes = |rest: &str| {
        let text = format!("[machine]\nname = \"m\"\nchain = \"w b X Y Z C t\"\n{rest}");
        let problems = Machine::check("m.toml", &text, &NoTables).1;
        problems.iter().map(|d| d.code).collect::<Vec<_>>()
    };
    let scale = "expansion = \"10 um/(m K)\"\ntable_temperature = \"20 degC\"\n";
    let sensors = "sensors = { a = \"0 mm\" }\n";
    assert!(codes(&format!("[scale.X]\n{scale}{sensors}")).is_empty());
    assert_eq!(codes(&format!("[scale.C]\n{scale}{sensors}")), ["unknown-axis"]);
    assert_eq!(codes(&format!("[scale.X]\n{scale}")), ["missing-key"]);
    let alone = "[scale.X]\nexpansion = \"10 um/(m K)\"\n";
    assert_eq!(codes(&format!("{alone}{sensors}")), ["no-temperature"]);
    assert_eq!(
        codes(&format!("{alone}{sensors}table_temperature = \"68 degF\"\n")),
        ["unknown-unit", "no-temperature"]
    );
    assert_eq!(codes("[scale.X]\nexpansion = \"10 um/m\"\n").first(), Some(&"wrong-unit"));
    assert_eq!(codes("[heat.EXt]\na = \"1 um/K\"\n"), ["unknown-error-name"]);
    assert_eq!(codes("[heat.EA0Z]\na = \"1 um/K\"\n"), ["wrong-unit", "missing-key"]);
    assert_eq!(codes("[workpiece]\nfixed_point = \"0 0 0 mm\"\n"), ["missing-key"]);
    assert_eq!(codes("[workpiece]\nexpansion = \"10800 um/(m K)\"\n"), ["impossible-value"]);
}
