//! Our figures for the claims of Zhang et al. 2019.

use crate::{Ours, shop};
use trueaxis::compensate::values::{Order, ValueTable, compensation_values};
use trueaxis::files::disk;
use trueaxis::geometry::Vec3;
use trueaxis::identify::expansion::{identify_expansion, read_runs};
use trueaxis::input::Diagnostics;
use trueaxis::machine::Machine;
use trueaxis::machine::errors::{ErrorValues, Interpolation, Spline};
use trueaxis::machine::heat::field::{ScaleField, Source};
use trueaxis::machine::heat::{Conditions, ErrorPart};
use trueaxis::predict::holes::{Compensation, predict_holes, read_hole_study};

pub const CLAIMS: &[(&str, Ours)] = &[
    ("001-machine", || both(TESTS, machine_um)),
    ("001-scale", || both(TESTS, |m, at| part_um(m, at, ErrorPart::Scale))),
    ("001-at-20", || both(AT_20, machine_um)),
    ("001-workpiece", || both(TESTS, growth_um)),
    ("001-machine-only", || both(TESTS, growth_um)),
    ("001-comprehensive", || both(TESTS, whole_um)),
    ("001-comprehensive-printed", || both(TESTS, |m, at| whole_um(m, at).abs())),
    ("001-reduction", || {
        let before = both(TESTS, whole_um);
        before.iter().zip([7.1, 8.3]).map(|(b, after)| 100.0 * (1.0 - after / b.abs())).collect()
    }),
    ("001-values", || values(|table| table.nodes[0].value.increments as f64)),
    ("001-values-machine-only", || values(|table| 1e3 * table.worst[1])),
    ("001-expansion", || {
        let file = shop::root().join("examples/05_identify/y-axis-two-temperatures.toml");
        let (runs, problems) = read_runs(&disk(), &file);
        let runs = runs.unwrap_or_else(|| panic!("{:?}", problems.sorted()));
        vec![identify_expansion(&runs).per_k * 1e6]
    }),
    ("001-at-least", || vec![100.0 * (1.0 - 21.9 / 46.0)]),
    ("001-location-diameter", || {
        let file = shop::root().join("examples/03_predict/torque-arm.toml");
        let (study, problems) = read_hole_study(&disk(), &file);
        let study = study.unwrap_or_else(|| panic!("{:?}", problems.sorted()));
        let found = predict_holes(&study).expect("reachable");
        let within = |set: usize| found.sets[set].location_in_tolerance == Some(true);
        vec![f64::from(u8::from(!within(0))), f64::from(u8::from(within(2)))]
    }),
    ("001-field", field),
    ("001-spline", || {
        let cubic = |x: f64| ((x - 0.3) * x + 0.1) * x - 0.2;
        let x: Vec<f64> = (0..=10).map(|i| f64::from(i) / 10.0).collect();
        let y: Vec<f64> = x.iter().map(|x| cubic(*x)).collect();
        let spline = Spline::new(&x, &y, Interpolation::NotAKnot).expect("eleven knots");
        let off = (0..=1000).map(|i| f64::from(i) / 1000.0).map(|x| spline.at(x) - cubic(x));
        vec![off.fold(0.0, |worst: f64, d| worst.max(d.abs()))]
    }),
];

/// Where and at which temperatures; which component of the deviation counts.
type Test = (&'static str, &'static str, usize);

const TESTS: [Test; 2] =
    [("X=3500", "scale_x=30.5 workpiece=30.5", 0), ("Y=2300", "scale_y=31.2 workpiece=31.2", 1)];
const AT_20: [Test; 2] = [("X=3500", "scale_x=20", 0), ("Y=2300", "scale_y=20", 1)];

/// What a test needs: the errors at its command.
struct At {
    command: [f64; 6],
    errors: ErrorValues,
    component: usize,
}

fn both(tests: [Test; 2], value: impl Fn(&Machine, &At) -> f64) -> Vec<f64> {
    let one = |(position, temperatures, component): Test| {
        let mut problems = Diagnostics::new();
        let conditions = Conditions::typed("test", temperatures, &mut problems).expect("sound");
        let machine = shop::machine("gantry-001").at(&conditions, &mut problems).expect("sensors");
        let command = shop::command(&machine, position);
        let errors = machine.errors_at(&command, &[0.0; 6]).expect("inside the table");
        value(&machine, &At { command, errors, component })
    };
    tests.into_iter().map(one).collect()
}

/// What `compensate values` says at the two ends, in increments of 1 µm or in µm.
fn values(of: impl Fn(&ValueTable) -> f64) -> Vec<f64> {
    let one = |(position, temperatures, component): Test| {
        let mut problems = Diagnostics::new();
        let conditions = Conditions::typed("test", temperatures, &mut problems).expect("sound");
        let machine = shop::machine("gantry-001").at(&conditions, &mut problems).expect("sensors");
        let command = shop::command(&machine, position);
        let order = Order {
            axis: component,
            command,
            positions: vec![command[component]],
            increment: 1e-3,
            of: Compensation::Comprehensive,
        };
        of(&compensation_values(&machine, &order).expect("inside the table"))
    };
    TESTS.into_iter().map(one).collect()
}

fn whole_um(machine: &Machine, at: &At) -> f64 {
    1e3 * machine.deviation(&at.command, &at.errors).tip_mm[at.component]
}

fn machine_um(machine: &Machine, at: &At) -> f64 {
    let errors = ErrorValues { workpiece_mm: Vec3::zeros(), ..at.errors };
    1e3 * machine.deviation(&at.command, &errors).tip_mm[at.component]
}

fn growth_um(_: &Machine, at: &At) -> f64 {
    1e3 * at.errors.workpiece_mm[at.component]
}

fn part_um(machine: &Machine, at: &At, part: ErrorPart) -> f64 {
    let errors = machine.part(&at.command, &at.errors, part);
    1e3 * machine.deviation(&at.command, &errors).tip_mm[at.component]
}

/// −∂T/∂l at the surface against q/λ, and a ∂²T/∂l² against ∂T/∂τ at 60 mm after 900 s.
fn field() -> Vec<f64> {
    let (a, g) = (4.0, 0.05);
    let sources = vec![Source { place_mm: 0.0, steps: vec![(0.0, g)] }];
    let field = ScaleField { initial_celsius: 26.0, diffusivity_mm2_per_s: a, sources };
    let at = |l: f64, t: f64| field.celsius_at(l, t);
    let e = 1e-3;
    let slope = (-3.0 * at(0.0, 900.0) + 4.0 * at(e, 900.0) - at(2.0 * e, 900.0)) / (2.0 * e);
    let second = at(60.5, 900.0) - 2.0 * at(60.0, 900.0) + at(59.5, 900.0);
    let rate = at(60.0, 900.5) - at(60.0, 899.5);
    vec![slope / -g - 1.0, a * second / 0.25 / rate - 1.0]
}
