//! What holds for certificates: their intervals cover the truth, and what they promise of a part comes true.
//!
//! Every machine here is virtual: errors are injected, read with noise, identified by the product, compensated
//! with what was *identified*, and judged on the actual machine.

mod library;

use library::{Random, bare, root, runs};
use nalgebra::{DMatrix, DVector};
use std::path::PathBuf;
use trueaxis::files::disk;
use trueaxis::geometry::Vec3;
use trueaxis::identify::errors::{Identification, identify};
use trueaxis::identify::records::{Options, Records};
use trueaxis::input::Diagnostics;
use trueaxis::machine::Machine;
use trueaxis::machine::axis::{Approach, AxisKind, Command, Travel};
use trueaxis::machine::compensate::{Compensator, Scope};
use trueaxis::machine::errors::{ErrorName, Uncertainty};
use trueaxis::measure::instrument::Instrument;
use trueaxis::measure::{Campaign, Kind, Reading, Readings};
use trueaxis::predict::{Cutting, Judge, Sampling, Study, read_study};
use trueaxis::unknowns::minimal::minimal_location_errors;
use trueaxis::unknowns::term::{Basis, Shape, Term, stated};
use trueaxis::verify::certificate::applied::AppliedCompensation;
use trueaxis::verify::certificate::residual::{Residual, ToolDeviation};
use trueaxis::verify::certificate::spread::lengths;
use trueaxis::verify::certificate::uncertainties::UncertaintyFactors;

const STILL: Approach = [0.0; 6];
/// Standard deviation of a reading, mm.
const NOISE_MM: f64 = 2e-3;

/// Location errors that can be separated, and a few error motions of every axis.
fn terms(machine: &Machine) -> Vec<Term> {
    let mut terms = minimal_location_errors(machine);
    for axis in machine.axes() {
        let shape = if axis.kind == AxisKind::Rotary { "fourier 2" } else { "polynomial 2-3" };
        for direction in ['X', 'Y', 'Z'] {
            let error = ErrorName::parse(&format!("E{direction}{}", axis.name)).expect("a name");
            let mut all = Shape::parse(shape).expect("a shape").terms(machine, error);
            // Once a turn, a shift of the table looks like a datum that stands elsewhere.
            all.retain(|t| !matches!(t.basis, Basis::Cosine(1) | Basis::Sine(1)));
            terms.extend(all);
        }
    }
    terms.sort_by_key(|t| t.index);
    terms
}

/// The machine with these factors of the terms.
fn with_terms(machine: &Machine, terms: &[Term], values: &[f64]) -> Machine {
    let mut made = machine.clone();
    for (k, term) in terms.iter().enumerate() {
        if k > 0 && terms[k - 1].index == term.index {
            continue;
        }
        let same = terms.iter().zip(values).filter(|(t, _)| t.index == term.index);
        let curve = stated(&same.map(|(t, v)| (*t, *v)).collect::<Vec<_>>(), None);
        made = made.with_error(term.index, Some(curve));
    }
    made
}

/// A tracker that reads the place of a reflector so far below the tool tip; its position is not known.
fn tracker(machine: &Machine, below_mm: f64) -> Instrument {
    Instrument {
        name: "tracker".to_owned(),
        tool_point_mm: machine.tip_mm() + Vec3::new(60.0, 25.0, -below_mm),
        noise: [NOISE_MM; 3],
        ..Instrument::usual(Kind::CutPiece, machine)
    }
}

/// A place well inside the travels.
fn inside(random: &mut Random, machine: &Machine) -> Command {
    let mut command = Command::default();
    for (q, axis) in command.iter_mut().zip(machine.axes()) {
        let (from, to) = match (axis.travel, axis.kind) {
            (Travel::Between(from, to), _) => (from, to),
            (_, AxisKind::Linear) => (-250.0, 250.0),
            (_, AxisKind::Rotary) => (-1.5, 1.5),
        };
        *q = from + (to - from) * (0.1 + 0.8 * random.unit());
    }
    command
}

/// A campaign on a machine whose errors are not known yet.
struct Bench {
    campaign: Campaign,
    stations: Vec<Command>,
    options: Options,
}

/// One machine from its injection to its identification.
struct Trial {
    real: Machine,
    identified: Machine,
    found: Identification,
}

impl Bench {
    fn new(machine: &Machine, stations: usize, random: &mut Random) -> Self {
        let campaign = Campaign {
            files: disk(),
            name: "test".to_owned(),
            path: PathBuf::from("campaign.toml"),
            conditions: None,
            machine: machine.clone(),
            machine_path: PathBuf::from("machine.toml"),
            terms: terms(machine),
            // Of one tool length a tilt of the tool cannot be distinguished from a shift.
            instruments: vec![tracker(machine, 0.0), tracker(machine, 150.0)],
            tables: vec![Vec::new(); 2],
            stages: Default::default(),
            limits: Default::default(),
        };
        let stations = (0..stations).map(|_| inside(random, machine)).collect();
        // Without a choice among the terms: what is omitted by chance has no uncertainty.
        let options = Options { selection: false, folds: 2, ..Options::default() };
        Self { campaign, stations, options }
    }

    /// Errors of some 10 µm and 30 µrad, readings with noise, and what the product finds.
    fn trial(&self, random: &mut Random) -> Trial {
        let terms = &self.campaign.terms;
        let size = |t: &Term| if t.error.component.is_rotation() { 3e-5 } else { 0.01 };
        let values: Vec<f64> = terms.iter().map(|t| size(t) * random.normal()).collect();
        let real = with_terms(&self.campaign.machine, terms, &values);
        let instruments = &self.campaign.instruments;
        let setups: Vec<[f64; 6]> =
            instruments.iter().map(|_| [0; 6].map(|_| 1e-4 * random.normal())).collect();
        let mut readings = Readings::default();
        for (group, command) in self.stations.iter().enumerate() {
            let instrument = group % instruments.len();
            let (own, setup) = (&instruments[instrument], &setups[instrument]);
            let errors = real.errors_at(command, &STILL).expect("no tables");
            let view = own.view(&real, command, &errors, Vec3::x());
            let value = own.read(&view, setup).map(|v| v + NOISE_MM * random.normal());
            readings.push(Reading {
                command: *command,
                approach: STILL,
                instrument: instrument as u32,
                direction: Vec3::x(),
                value,
                group: group as u32,
                time_s: 0.0,
                motion: trueaxis::measure::Motion::default(),
                line: 0,
            });
        }
        let mut problems = Diagnostics::new();
        let found =
            identify(&self.campaign, &self.options, &Records::bare(readings), &mut problems);
        let found = found.unwrap_or_else(|| panic!("{problems:?}"));
        let unseen: Vec<_> = found.unobservable.iter().map(|u| &u.combination).collect();
        assert_eq!(found.fit.sight.rank, found.design.unknowns(), "{unseen:?}");
        let identified = with_terms(&self.campaign.machine, &found.design.terms, &found.fit.values);
        Trial { real, identified, found }
    }
}

/// How often intervals held what they promised.
#[derive(Default)]
struct Coverage {
    tip: [usize; 2],
    axis: [usize; 2],
    length: [usize; 2],
}

fn count(hits: &mut [usize; 2], inside: bool) {
    hits[0] += usize::from(inside);
    hits[1] += 1;
}

impl Coverage {
    /// Of the coordinates of tip and axis, and of the lengths.
    fn shares(&self) -> [f64; 3] {
        [self.tip, self.axis, self.length].map(|[inside, all]| inside as f64 / all as f64)
    }

    /// The truth of one machine at poses that were not used, compensated with what is known of it.
    fn add(
        &mut self,
        real: &Machine,
        (machine, known): (&Machine, &UncertaintyFactors),
        (zero, poses): (&Command, &[Command]),
    ) {
        let compensator = Compensator::of(machine, Scope::Pose).expect("three axes");
        let applied = AppliedCompensation::Program(Box::new(compensator));
        let reported =
            |q: &Command| Residual::at(machine, (known, &applied), q, &STILL).expect("a pose");
        let true_off = |q: &Command| {
            let (at, _) = applied.go(machine, q, &STILL).expect("a pose");
            let errors = real.errors_at(&at, &STILL).expect("no tables");
            ToolDeviation::of(real, &at, &errors, q)
        };
        let (at_zero, true_at_zero) = (reported(zero), true_off(zero));
        let predicted: Vec<Residual> =
            poses.iter().map(|q| reported(q).against(&at_zero)).collect();
        let within = lengths(&predicted, Sampling { samples: 2000, seed: 3 }).within_mm;
        for ((q, predicted), within_mm) in poses.iter().zip(&predicted).zip(within) {
            let truth = true_off(q) - true_at_zero;
            let (off, u) = (truth.tip_mm - predicted.after.tip_mm, predicted.u_mm());
            (0..3).for_each(|i| count(&mut self.tip, off[i].abs() <= 2.0 * u[i]));
            let (off, u) = (truth.axis - predicted.after.axis, predicted.u_axis());
            // Along the tool its axis does not change.
            let across = (0..3).filter(|i| u[*i] > 1e-8);
            across.for_each(|i| count(&mut self.axis, off[i].abs() <= 2.0 * u[i]));
            count(&mut self.length, truth.tip_mm.norm() <= within_mm);
        }
    }
}

/// k = 2 is 95.45 % of a normal coordinate, the bound of a length is made for 95 %.
fn covers(
    name: &str,
    machines: usize,
    known: fn(&Trial) -> (Machine, UncertaintyFactors),
) -> [f64; 3] {
    let machine = bare(name);
    let mut random = Random(31);
    let bench = Bench::new(&machine, 80, &mut random);
    let zero = inside(&mut random, &machine);
    let poses: Vec<Command> = (0..12).map(|_| inside(&mut random, &machine)).collect();
    let mut coverage = Coverage::default();
    for _ in 0..machines {
        let trial = bench.trial(&mut random);
        let (machine, known) = known(&trial);
        coverage.add(&trial.real, (&machine, &known), (&zero, &poses));
    }
    coverage.shares()
}

/// The intervals of a certificate hold the truth in 93 to 97 % of all cases, on poses that were not used, of
/// machines that were injected, measured and identified.
///
/// 12 poses of one machine share its errors: 70 machines say as much as some 700 independent numbers, whose
/// share scatters by 0.8 %; the bounds are three of them away from what is promised. Of 2000 machines each
/// (the long test): tip 95.4, 95.3 and 95.6 %, axis 95.4, 95.3 and 95.7 %, lengths 95.2, 95.3 and 95.2 %.
#[test]
fn law_the_interval_of_a_certificate_covers_the_truth() {
    let known = |trial: &Trial| {
        let known = UncertaintyFactors::identified(&trial.identified, &trial.found);
        (trial.identified.clone(), known)
    };
    for name in ["lei-hsu-mill", "xkas2525", "head-table"] {
        let shares = covers(name, runs(2000, 70), known);
        assert!(shares.iter().all(|s| (0.925..=0.975).contains(s)), "{name}: {shares:?}");
    }
}

/// With one u for each error, which is all that a machine file can say of an identification, an interval of
/// 95 % is too long: errors that look alike are then wrong twice over.
#[test]
fn law_without_correlations_the_interval_is_too_long() {
    let known = |trial: &Trial| {
        let whole = UncertaintyFactors::identified(&trial.identified, &trial.found);
        let mut stated_alone = trial.identified.clone();
        for (index, _) in trial.identified.stated_errors() {
            let body = &trial.identified.bodies()[index.body];
            let at = body.axis.map_or(0.0, |axis| trial.found.reach[axis][1]);
            let mut command = Command::default();
            if let Some(axis) = body.axis {
                command[axis] = at;
            }
            let u = whole.at(&trial.identified, &command, &STILL).u(index);
            let mut error = body.stated(index.kind, index.component).expect("stated").clone();
            error.u = Some(Uncertainty::Constant(u));
            stated_alone = stated_alone.with_error(index, Some(error));
        }
        let known = UncertaintyFactors::stated(&stated_alone);
        (stated_alone, known)
    };
    let [tip, ..] = covers("lei-hsu-mill", 60, known);
    assert!(tip > 0.97, "{tip}");
}

/// The frustum of NAS 979 on the gantry, its errors left out.
fn frustum() -> Study {
    let (study, problems) =
        read_study(&disk(), &root().join("examples/03_predict/nas979-on-xkas2525.toml"));
    let mut study = study.unwrap_or_else(|| panic!("{problems:?}"));
    let stated = study.machine.stated_errors();
    study.machine =
        stated.iter().fold(study.machine, |machine, (index, _)| machine.with_error(*index, None));
    study
}

/// The indices of the part that a machine cuts, compensated with what is known of it; mm.
fn part(study: &Study, real: &Machine, known: Option<&Machine>) -> Vec<f64> {
    let piece = study.piece();
    let mut cutting = Cutting::new(real, piece, &study.reference).expect("a path");
    if let Some(known) = known {
        let compensator = Compensator::of(known, Scope::Pose).expect("three axes");
        cutting = cutting.compensated(&|command, approach| {
            let at = compensator.at(command, approach).expect("a pose").command;
            std::array::from_fn(|i| at[i] - command[i])
        });
    }
    Judge { cutting: &cutting, piece }.once(&|errors, _| *errors).expect("indices")
}

/// Another machine that the identification allows as well.
fn drawn(trial: &Trial, machine: &Machine, random: &mut Random) -> Machine {
    let (terms, fit) = (&trial.found.design.terms, &trial.found.fit);
    let n = terms.len();
    let covariance = fit.covariance.view((0, 0), (n, n));
    let z = DVector::from_fn(n, |_, _| random.normal());
    // Another root than that of the product, of the covariance scaled to correlations.
    let u = covariance.diagonal().map(f64::sqrt);
    let correlation = DMatrix::from_fn(n, n, |i, j| covariance[(i, j)] / (u[i] * u[j]));
    let moved = correlation.cholesky().expect("a covariance").l() * z;
    let values: Vec<f64> = (0..n).map(|k| fit.values[k] + u[k] * moved[k]).collect();
    with_terms(machine, terms, &values)
}

/// Over many machines: how often each index became smaller; its root mean square before, after, and after
/// as the uncertainties predict it.
struct Parts {
    names: Vec<String>,
    better: Vec<f64>,
    rms: [Vec<f64>; 3],
}

fn cut_parts(machines: usize, draws: usize) -> Parts {
    let study = frustum();
    let machine = study.machine.clone();
    let mut random = Random(32);
    let bench = Bench::new(&machine, 80, &mut random);
    let names: Vec<String> =
        study.piece().index_names().iter().map(|n| n.key.to_string()).collect();
    let mut parts = Parts {
        better: vec![0.0; names.len()],
        rms: [0; 3].map(|_| vec![0.0; names.len()]),
        names,
    };
    for _ in 0..machines {
        let trial = bench.trial(&mut random);
        let before = part(&study, &trial.real, None);
        let after = part(&study, &trial.real, Some(&trial.identified));
        for (i, (a, b)) in before.iter().zip(&after).enumerate() {
            parts.better[i] += f64::from(u8::from(b.abs() < a.abs())) / machines as f64;
            parts.rms[0][i] += a * a / machines as f64;
            parts.rms[1][i] += b * b / machines as f64;
        }
        for _ in 0..draws {
            let other = drawn(&trial, &machine, &mut random);
            let predicted = part(&study, &other, Some(&trial.identified));
            for (sum, v) in parts.rms[2].iter_mut().zip(predicted) {
                *sum += v * v / (machines * draws) as f64;
            }
        }
    }
    parts.rms.iter_mut().flatten().for_each(|v| *v = v.sqrt());
    parts
}

/// Parts of 200 machines that were injected, measured, identified and compensated: every index becomes smaller
/// on 95 % of them at least, and as small as the uncertainties say.
///
/// The root mean square of an index over 200 machines scatters by 3.5 % (a length in a plane) to 5 % (a normal
/// number), its prediction from 800 draws by half of that: 15 % are three of them.
/// Of 1000 machines and 8000 draws (10 s) they agree within 3 %: roundness_mzc 30.45 → 1.151 µm, predicted
/// 1.144 µm; coaxiality_lsc 63.84 → 2.578 µm (2.534 µm); angularity_zone 4.58 → 0.305 µm (0.306 µm).
/// `angularity_eq19_mm` has a sign: its size counts.
#[test]
fn law_compensated_parts_improve_as_the_uncertainties_predict() {
    let parts = cut_parts(200, 4);
    for (i, name) in parts.names.iter().enumerate() {
        let [before, after, predicted] = [0, 1, 2].map(|k| parts.rms[k][i] * 1e3);
        let better = parts.better[i];
        assert!(better >= 0.95, "{name}: {better}");
        assert!((after / predicted - 1.0).abs() < 0.15, "{name}: {after} {predicted}");
        // Some 12 µm and 30 µrad are found to within some 0.5 µm and 1 µrad.
        assert!(after < 0.1 * before, "{name}: {before} {after}");
    }
}
