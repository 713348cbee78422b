//! The fit of 43 unknowns on 10⁵ numbers, and of 10⁶.
//!
//! Target: 3·10⁶ numbers a second on two cores, and 50 times the rate of
//! scipy.optimize.least_squares with a numerical Jacobian on the same model, in the same run:
//! `oracles/fit_speed.py` runs this bench and its peer and prints the ratio.

use divan::Bencher;
use std::path::Path;
use trueaxis::geometry::Vec3;
use trueaxis::machine::errors::{BodyName, Component, ErrorKind, ErrorName};
use trueaxis::measure::instrument::Instrument;
use trueaxis::measure::{Kind, Reading, Readings};
use trueaxis::unknowns::design::Design;
use trueaxis::unknowns::fit::fit;
use trueaxis::unknowns::minimal::minimal_location_errors;
use trueaxis::unknowns::term::Shape;

fn main() {
    divan::main();
}

/// The mill of Lei and Hsu 2003 with a probe-ball: 13 location errors, 27 factors of error motions, and
/// the place of the ball: 43 unknowns.
fn design() -> Design {
    let path =
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../../machines/lei-hsu-mill/machine.toml");
    let (machine, problems) = trueaxis::files::machine(&path);
    let machine = machine.unwrap_or_else(|| panic!("{problems:?}"));
    let mut terms = minimal_location_errors(&machine);
    let motion = |letter: char, direction: Component| ErrorName {
        body: BodyName::new(letter).expect("an axis"),
        kind: ErrorKind::Motion,
        component: direction,
    };
    let harmonics = Shape::parse("fourier 2").expect("a shape");
    for (axis, direction) in [('C', Component::C), ('A', Component::C), ('C', Component::X)] {
        terms.extend(harmonics.terms(&machine, motion(axis, direction)));
    }
    let powers = Shape::parse("polynomial 2-4").expect("a shape");
    for (axis, direction) in [
        ('X', Component::X),
        ('X', Component::Y),
        ('Y', Component::X),
        ('Y', Component::Y),
        ('Z', Component::X),
    ] {
        terms.extend(powers.terms(&machine, motion(axis, direction)));
    }
    terms.sort_by_key(|t| t.index);
    let probe = Instrument::usual(Kind::ProbeBall, &machine);
    let design = Design::new(&machine, terms, vec![probe]);
    assert_eq!(design.unknowns(), 43);
    design
}

/// What the probe reads at poses all over the travel, with errors and noise.
fn readings(design: &Design, poses: u32) -> Readings {
    let mut state = 1u64;
    let mut unit = || {
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1u64 << 53) as f64
    };
    let values: Vec<f64> = (0..design.unknowns())
        .map(|k| {
            let angle = design.unknown(k).is_some_and(|u| u.is_angle());
            (2.0 * unit() - 1.0) * if angle { 5e-5 } else { 0.02 }
        })
        .collect();
    let mut readings = Readings::default();
    for group in 0..poses {
        let mut command = [0.0; 6];
        for (q, reach) in command.iter_mut().zip([3.0, 1.5, 200.0, 200.0, 200.0]) {
            *q = reach * (2.0 * unit() - 1.0);
        }
        readings.push(Reading {
            command,
            approach: [0.0; 6],
            instrument: 0,
            direction: Vec3::x(),
            value: [0.0; 3],
            group,
            time_s: 0.0,
            motion: trueaxis::measure::Motion::default(),
            line: 0,
        });
    }
    for i in 0..readings.len() {
        let read = design.read(&readings, i, &values).expect("no tables");
        readings.values[i] = read.map(|v| v + 1e-3 * (unit() + unit() + unit() + unit() - 2.0));
    }
    readings
}

#[divan::bench(args = [33_334, 333_334], sample_count = 5, sample_size = 1)]
fn fit_43_unknowns(bencher: Bencher<'_, '_>, poses: u32) {
    let design = design();
    let readings = readings(&design, poses);
    let numbers = divan::counter::ItemsCount::new(3 * readings.len());
    bencher.counter(numbers).bench(|| fit(&design, &readings, &[]).expect("a fit"));
}
