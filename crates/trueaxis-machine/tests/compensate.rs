//! Compensated poses: the actual tool stands where the programmed one should.

mod library;

use library::{Random, checked, command_within_travel, machine};
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{Approach, AxisKind, Command};
use trueaxis_machine::compensate::{AxisLeft, Compensator, Fault, MOST_SWING, Scope};
use trueaxis_machine::errors::{
    Component, Curve, ErrorIndex, ErrorKind, Harmonic, Outside, StatedError,
};

/// Every folder of `machines/`.
const MACHINES: [&str; 8] = [
    "xkas2525",
    "i5-engraver",
    "lei-hsu-mill",
    "head-table",
    "nutating-head",
    "wyxzcat-gantry",
    "three-axis-mill",
    "gantry-001",
];

/// Location errors of all bodies and smooth motions of all axes with reversal, each up to `reach`
/// (1: 1 mm and 1 mrad).
fn with_random_errors(machine: &Machine, random: &mut Random, reach: f64) -> Machine {
    let mut changed = machine.clone();
    for (body, b) in machine.bodies().iter().enumerate() {
        let axis = b.axis.map(|i| machine.axes()[i].kind);
        for component in Component::ALL {
            let reach = reach * if component.is_rotation() { 1e-3 } else { 1.0 };
            let location = StatedError::constant(random.within(reach), None);
            let index = ErrorIndex { body, kind: ErrorKind::Location, component };
            changed = changed.with_error(index, Some(location));
            if let Some(kind) = axis {
                let index = ErrorIndex { kind: ErrorKind::Motion, ..index };
                changed = changed.with_error(index, Some(motion(kind, random, reach)));
            }
        }
    }
    changed
}

/// A curve within ±`reach` over some metres or turns.
fn motion(kind: AxisKind, random: &mut Random, reach: f64) -> StatedError {
    let mut value = |part: f64| random.within(part * reach);
    let mean = match kind {
        AxisKind::Linear => Curve::Polynomial {
            coefficients: vec![value(0.3), value(0.3), value(0.2)],
            origin: 0.0,
            scale: 1000.0,
        },
        AxisKind::Rotary => Curve::Fourier {
            mean: value(0.2),
            terms: vec![
                Harmonic { order: 1.0, cosine: value(0.2), sine: value(0.2) },
                Harmonic { order: 3.0, cosine: value(0.1), sine: value(0.1) },
            ],
        },
    };
    let reversal = Curve::Constant(value(0.1));
    StatedError { reversal: Some(reversal), ..StatedError::constant(0.0, None) }.with(mean)
}

trait With {
    fn with(self, mean: Curve) -> Self;
}

impl With for StatedError {
    fn with(self, mean: Curve) -> Self {
        Self { mean, ..self }
    }
}

/// A command in the middle 76 % of the travel.
fn away_from_ends(machine: &Machine, random: &mut Random) -> Command {
    command_within_travel(machine, std::array::from_fn(|_| 0.12 + 0.76 * random.unit()))
}

fn sides(random: &mut Random) -> Approach {
    std::array::from_fn(|_| (3.0 * random.unit()).floor() - 1.0)
}

/// Actual minus programmed tip and axis, by the machine itself.
fn missed(machine: &Machine, programmed: &Command, given: &Command, side: &Approach) -> [f64; 2] {
    let wanted = machine.deviation(programmed, &Default::default());
    let errors = machine.errors_at(given, side).expect("inside the tables");
    let pose = machine.pose(given, &errors);
    let tip = pose.linear() * machine.tip_mm() + pose.shift_mm();
    let axis = pose.linear().column(2).normalize();
    [(tip - wanted.nominal_tip.vector()).norm(), (axis - wanted.nominal_axis.vector()).norm()]
}

fn is_exact(name: &str, machine: &Machine, random: &mut Random, poses: usize) -> u32 {
    let compensator = Compensator::of(machine, Scope::Pose).expect("three linear axes");
    let mut most = 0;
    for _ in 0..poses {
        let (command, side) = (away_from_ends(machine, random), sides(random));
        let done = compensator.at(&command, &side).unwrap_or_else(|f| panic!("{name}: {f}"));
        let [tip, axis] = missed(machine, &command, &done.command, &side);
        assert!(tip < 1e-9, "{name} {command:?}: {tip:e} mm");
        assert!(axis < 1e-12 || done.axis_left.is_some(), "{name} {command:?}: {axis:e}");
        assert!((tip - done.left.tip_mm.norm()).abs() < 1e-10, "{name}: it says what is left");
        assert!((axis - done.left.axis.norm()).abs() < 1e-12, "{name}: it says what is left");
        most = most.max(done.evaluations);
    }
    most
}

#[test]
fn law_compensated_poses_are_the_programmed_ones() {
    let mut random = Random(3);
    for name in MACHINES {
        let own = machine(name);
        let most = is_exact(name, &own, &mut random, 2_000);
        println!("{name}: at most {most} evaluations with its own errors");
        for reach in [0.05, 1.0] {
            for _ in 0..20 {
                let wrong = with_random_errors(&own, &mut random, reach);
                let most = is_exact(name, &wrong, &mut random, 500);
                println!("{name}: at most {most} evaluations with errors up to {reach}");
            }
        }
    }
}
