//! What holds for every identification: machines with known errors give their errors back.

mod library;

use library::{MACHINES, Random, bare, machine};
use trueaxis::geometry::Vec3;
use trueaxis::machine::Machine;
use trueaxis::machine::axis::{Approach, AxisKind};
use trueaxis::machine::errors::{ErrorName, StatedError};
use trueaxis::machine::twist::Reference;
use trueaxis::measure::instrument::Instrument;
use trueaxis::measure::{Kind, Reading, Readings};
use trueaxis::unknowns::confusion::confusions;
use trueaxis::unknowns::design::Design;
use trueaxis::unknowns::fit::{
    LEAST_SINGULAR_VALUE, Model, Observability, Rule, fit, fit_by, normal_matrix,
};
use trueaxis::unknowns::minimal::minimal_location_errors;
use trueaxis::unknowns::term::{Shape, Term};

fn instrument(kind: Kind, machine: &Machine) -> Instrument {
    Instrument {
        // From the floor a tracker sees only what carries the tool: enough where that is all.
        reference: match (kind, machine.workpiece_side()) {
            (Kind::LengthTracker, 1) => Reference::Bed,
            _ => Reference::Workpiece,
        },
        reference_point_mm: Vec3::new(40.0, -700.0, 90.0),
        noise: [1e-3; 3],
        ..Instrument::usual(kind, machine)
    }
}

/// ±20 µm, ±60 µrad.
fn size(random: &mut Random, term: &Term) -> f64 {
    random.within(if term.error.component.is_rotation() { 6e-5 } else { 0.02 })
}

/// The machine with the errors that the terms have with these factors, and nothing else of them.
fn truth(machine: &Machine, terms: &[Term], values: &[f64]) -> Machine {
    let mut truth = machine.clone();
    let mut k = 0;
    while k < terms.len() {
        let mine: Vec<(Term, f64)> = terms[k..]
            .iter()
            .zip(&values[k..])
            .take_while(|(t, _)| t.index == terms[k].index)
            .map(|(t, v)| (*t, *v))
            .collect();
        let stated: StatedError = trueaxis::unknowns::term::stated(&mine, None);
        truth = truth.with_error(terms[k].index, Some(stated));
        k += mine.len();
    }
    truth
}

/// Location errors, and a few error motions of the first and the last axis.
fn terms(machine: &Machine) -> Vec<Term> {
    let mut terms = minimal_location_errors(machine);
    for axis in [machine.axes().first(), machine.axes().last()].into_iter().flatten() {
        let shape = if axis.kind == AxisKind::Rotary { "fourier 2" } else { "polynomial 2-3" };
        for direction in ['X', 'B', 'C'] {
            let error = ErrorName::parse(&format!("E{direction}{}", axis.name)).expect("a name");
            terms.extend(Shape::parse(shape).expect("a shape").terms(machine, error));
        }
    }
    terms.sort_by_key(|t| t.index);
    terms
}

/// Random commands and directions.
fn stations(random: &mut Random, machine: &Machine, count: u32) -> Readings {
    let mut stations = Readings::default();
    for group in 0..count {
        stations.push(Reading {
            command: random.command(machine, [250.0, 1.5]),
            approach: Approach::default(),
            instrument: 0,
            direction: Vec3::from_fn(|_, _| random.within(1.0)).normalize(),
            value: [0.0; 3],
            group,
            time_s: 0.0,
            motion: trueaxis::measure::Motion::default(),
            line: 0,
        });
    }
    stations
}

/// What the first instrument reads on the real machine.
fn read_by(real: &Machine, design: &Design, stations: &Readings, values: &[f64]) -> Readings {
    let mut readings = stations.clone();
    let own = &design.instruments[0];
    for i in 0..readings.len() {
        let command = &readings.commands[i];
        let errors = real.errors_at(command, &[0.0; 6]).expect("within the tables");
        let view = own.view(real, command, &errors, readings.directions[i]);
        readings.values[i] = own.read(&view, design.setup(0, values));
    }
    readings
}

#[test]
fn law_errors_injected_are_found_by_every_instrument_on_every_machine() {
    let mut random = Random(11);
    for name in MACHINES {
        let machine = machine(name);
        for kind in Kind::all() {
            let terms = terms(&machine);
            let design = Design::new(&machine, terms.clone(), vec![instrument(kind, &machine)]);
            let drawn: Vec<f64> = (0..design.unknowns())
                .map(|k| match design.terms.get(k) {
                    Some(term) => size(&mut random, term),
                    None => random.within(0.02),
                })
                .collect();
            let stations = stations(&mut random, &machine, 160);
            // What is not observable is set to 0: it would come back in second order.
            let sight = Observability::of(&normal_matrix(&design, &stations, &[]));
            let values = sight.seen_part(&drawn);
            let real = truth(&machine, &terms, &values);
            let readings = read_by(&real, &design, &stations, &values);
            let found = fit(&design, &readings, &[])
                .unwrap_or_else(|e| panic!("{name} {}: {e}", kind.name()));
            let seen = (0..design.unknowns()).filter(|k| found.sight.is_seen[*k]);
            let mut worst = (0.0, String::new());
            for k in seen {
                let typical =
                    if design.unknown(k).is_some_and(|u| u.is_angle()) { 6e-7 } else { 2e-4 };
                let off = (found.values[k] - values[k]).abs() / values[k].abs().max(typical);
                if off > worst.0 {
                    worst = (off, design.names()[k].clone());
                }
            }
            // As many sentences as there are things that cannot be determined.
            let missing = design.unknowns() - found.sight.rank;
            assert_eq!(confusions(&found.sight).len(), missing, "{name} {}", kind.name());
            assert!(worst.0 < 1e-6, "{name} {}: {} by {:.1e}", kind.name(), worst.1, worst.0);
        }
    }
}

#[test]
fn law_the_slopes_of_a_design_are_the_derivative_of_its_readings() {
    let mut random = Random(12);
    for name in MACHINES {
        let machine = machine(name);
        for kind in Kind::all() {
            let terms = terms(&machine);
            let design = Design::new(&machine, terms, vec![instrument(kind, &machine)]);
            // Without the other errors of the machine file: the slopes are those of the nominal one.
            let stated = design.machine.stated_errors();
            let bare =
                stated.iter().fold(machine.clone(), |m, (index, _)| m.with_error(*index, None));
            let design = Design::new(&bare, design.terms.clone(), design.instruments.clone());
            let stations = stations(&mut random, &bare, 4);
            let n = design.unknowns();
            let mut rows = vec![0.0; 3 * n];
            for i in 0..stations.len() {
                let channels = design.slopes(&stations, i, &mut rows);
                for k in 0..n {
                    let angle = design.unknown(k).is_some_and(|u| u.is_angle());
                    let h = if angle { 1e-6 } else { 1e-3 };
                    let [plus, minus] = [h, -h].map(|h| {
                        let mut values = vec![0.0; n];
                        values[k] = h;
                        design.read(&stations, i, &values).expect("within the tables")
                    });
                    for c in 0..channels {
                        let slope = (plus[c] - minus[c]) / (2.0 * h);
                        let allowed = if angle { 2e-5 } else { 1e-6 };
                        let off = (slope - rows[c * n + k]).abs();
                        let unknown = &design.names()[k];
                        assert!(
                            off < allowed,
                            "{name} {} {unknown}: {slope} {}",
                            kind.name(),
                            rows[c * n + k]
                        );
                    }
                }
            }
        }
    }
}

/// What a linear fit is off by is made of products of errors: half the errors, a quarter of it.
#[test]
fn law_the_linear_fit_is_off_by_the_second_order_only() {
    let mut random = Random(13);
    let rule = |model| Rule { threshold: LEAST_SINGULAR_VALUE, model };
    for name in ["lei-hsu-mill", "head-table", "i5-engraver"] {
        let machine = bare(name);
        let terms = terms(&machine);
        let own = instrument(Kind::ProbeBall, &machine);
        let design = Design::new(&machine, terms.clone(), vec![own]);
        let stations = stations(&mut random, &machine, 160);
        let drawn: Vec<f64> = (0..design.unknowns())
            .map(|k| design.terms.get(k).map_or(0.02, |term| size(&mut random, term)))
            .collect();
        let sight = Observability::of(&normal_matrix(&design, &stations, &[]));
        let values = sight.seen_part(&drawn);
        let off = |share: f64, model| {
            let values: Vec<f64> = values.iter().map(|v| v * share).collect();
            let real = truth(&machine, &terms, &values);
            let readings = read_by(&real, &design, &stations, &values);
            let found = fit_by(rule(model), &design, &readings, &[]).expect("a fit");
            let differences = found.values.iter().zip(&values).zip(&found.sight.is_seen);
            let seen = differences.filter(|(_, seen)| **seen);
            seen.map(|((a, b), _)| (a - b).powi(2)).sum::<f64>().sqrt()
        };
        let ratio = off(1.0, Model::Linear) / off(0.5, Model::Linear);
        assert!((ratio - 4.0).abs() < 0.2, "{name}: {ratio}");
        assert!(off(1.0, Model::Full) < 1e-3 * off(1.0, Model::Linear), "{name}");
    }
}
