//! Readings and slopes by groups of rows against those of one row at a time.

mod library;

use library::{bare, poses, root, within};
use nalgebra::DVector;
use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Mutex;
use trueaxis_geometry::Vec3;
use trueaxis_geometry::statistics::SplitMix64;
use trueaxis_input::{Diagnostics, MeasuredValue};
use trueaxis_machine::Machine;
use trueaxis_machine::errors::{Component, ErrorKind, ErrorName};
use trueaxis_machine::file::Tables;
use trueaxis_machine::heat::Conditions;
use trueaxis_machine::twist::Reference;
use trueaxis_machine::{ErrorModel, Squareness, errors::Rotation};
use trueaxis_measure::instruments::instrument::{SetupError, SetupUnknown};
use trueaxis_measure::instruments::{MaterialCompensation, Motion};
use trueaxis_measure::measure::instrument::Instrument;
use trueaxis_measure::measure::{Kind, Readings};
use trueaxis_measure::unknowns::design::Design;
use trueaxis_measure::unknowns::fit::{FitError, by_rows, fit, normal_matrix};
use trueaxis_measure::unknowns::term::{Basis, Shape, Term};

const MACHINES: [&str; 4] = ["lei-hsu-mill", "xkas2525", "nutating-head", "three-axis-mill"];

/// Heat that moves the tool, tilts Z and lengthens the scale of X, with and without the position.
const HEAT: &str = r#"
[scale.X]
expansion = "10 um/(m K)"
fixed_point = "-100 mm"
sensors = { x = "0 mm" }
[heat.EZ0t]
spindle = "1.5 um/K"
[heat.EA0Z]
column = "2 urad/K"
"#;

/// A machine of the library with all that it states, and the same with workpiece, scale and structure warm.
fn stated(name: &str) -> [Machine; 2] {
    let path = root().join("machines").join(name).join("machine.toml");
    let text = std::fs::read_to_string(&path).expect("a machine of the library");
    let grows = "[workpiece]\nexpansion = \"23 um/(m K)\"\nfixed_point = \"5 6 7 mm\"";
    let text = match text.contains("\n[workpiece]\n") {
        true => text.replacen("[workpiece]", grows, 1) + HEAT,
        false => format!("{text}\n{grows}\n{HEAT}"),
    };
    let (machine, problems) = Machine::check("machine.toml", &text, &Beside(&path));
    let machine = machine.unwrap_or_else(|| panic!("{name}: {problems:?}"));
    let machine = machine.with_model(ErrorModel::default());
    let mut problems = Diagnostics::new();
    let text = "x=25 spindle=40 column=25 workpiece=28";
    let conditions = Conditions::typed("t", text, &mut problems).expect("sound");
    let warm = machine.at(&conditions, &mut problems);
    let warm = warm.unwrap_or_else(|| panic!("{name}: {problems:?}"));
    assert!(warm.growth().is_some() && warm.bodies().iter().any(|b| b.thermal.len() == 1));
    [machine, warm]
}

/// The tables of a machine stand in its folder.
struct Beside<'a>(&'a Path);

impl Tables for Beside<'_> {
    fn text(&self, name: &str) -> Result<String, String> {
        std::fs::read_to_string(self.0.with_file_name(name)).map_err(|error| error.to_string())
    }
}

/// Every kind of instrument, on the workpiece and on the bed, with everything unknown of its set-up.
fn instruments(machine: &Machine) -> Vec<Instrument> {
    let references = [Reference::Workpiece, Reference::Bed];
    let all = Kind::all().flat_map(|kind| references.map(|reference| (kind, reference)));
    let one = |(kind, reference): (Kind, Reference)| {
        let mut one = Instrument::usual(kind, machine);
        let known: Vec<SetupError> = one.unknowns.iter().map(|u| u.error).collect();
        let more = (0..3).map(SetupError::ToolPoint).chain((0..3).map(SetupError::Drift));
        let more = more.chain([SetupError::Scale]).filter(|error| !known.contains(error));
        let unknown = |error| SetupUnknown { name: kind.unknown_name(error), error, prior_u: None };
        one.unknowns.extend(more.map(unknown));
        one.name = format!("{} {reference:?}", kind.name());
        one.reference = reference;
        one.reference_point_mm = Vec3::new(40.0, -70.0, 90.0);
        one.direction = Vec3::new(0.36, 0.48, 0.8);
        one.length_mm = 12.5;
        one.noise = [1e-3, 2e-3, 5e-4];
        if kind == Kind::LaserLine {
            one.material = Some(MaterialCompensation {
                expansion_per_k: MeasuredValue { value: 11.7e-6, u: None },
                celsius: MeasuredValue { value: 23.0, u: None },
                sensor: None,
                datum_mm: Vec3::new(5.0, 6.0, 7.0),
            });
            one.unknowns.push(unknown(SetupError::Material));
        }
        one
    };
    all.map(one).collect()
}

/// Location errors and error motions of every axis by every kind of function.
fn terms(machine: &Machine) -> Vec<Term> {
    let name = |body, kind, component| ErrorName { body, kind, component };
    let mut terms = Vec::new();
    for body in machine.bodies() {
        for component in Component::ALL {
            terms.extend(Term::location(machine, name(body.name, ErrorKind::Location, component)));
        }
    }
    for (i, axis) in machine.axes().iter().enumerate() {
        let shape = if axis.name.is_rotary() {
            "fourier 3 + reversal"
        } else {
            "polynomial 1-3 + reversal"
        };
        for (component, text) in
            [(Component::X, shape), (Component::C, shape), (Component::B, "linear 3")]
        {
            let shape = Shape::parse(text).expect("a shape");
            terms.extend(shape.terms(machine, name(axis.name, ErrorKind::Motion, component)));
        }
        let servo: [fn(f64) -> Basis; 3] = [
            |sense| Basis::Lag { sense },
            |sense| Basis::LostMotion { sense },
            |sense| Basis::Friction { free_s: 0.2, sense },
        ];
        terms.extend(servo.into_iter().filter_map(|basis| Term::servo(machine, i, basis)));
    }
    let drift = Basis::Ramp { instrument: 2, from_s: 500.0, over_s: 4000.0 };
    let wandering = terms[0];
    terms.push(Term { basis: drift, axis: None, ..wandering });
    terms.sort_by_key(|term| term.index);
    terms
}

/// Rows of all instruments, mixed; the axes come from both sides and move.
fn rows(random: &mut SplitMix64, machine: &Machine, instruments: usize) -> Readings {
    let mut all = poses(random, machine, 613);
    for i in 0..all.len() {
        all.instruments[i] = (random.unit() * instruments as f64) as u32;
        let direction = Vec3::new(within(random, 1.0), within(random, 1.0), 0.3);
        all.directions[i] = direction.normalize();
        all.approaches[i] =
            std::array::from_fn(|_| [-1.0, 0.0, 1.0][(random.unit() * 3.0) as usize]);
        all.motions[i] = Motion {
            feed_mm_per_s: Some(20.0),
            speed: std::array::from_fn(|_| within(random, 5.0)),
            turned: std::array::from_fn(|_| [-1.0, 0.0, 1.0][(random.unit() * 3.0) as usize]),
            turned_ago_s: std::array::from_fn(|_| random.unit()),
        };
    }
    all
}

fn design_of(machine: &Machine) -> Design {
    Design::new(machine, terms(machine), instruments(machine))
}

/// The slopes of each channel of each row by groups.
fn by_groups(design: &Design, readings: &Readings) -> BTreeMap<(usize, usize), Vec<f64>> {
    let all = Mutex::new(BTreeMap::new());
    by_rows(design, readings, |i, c, slopes| {
        all.lock().expect("no panic").insert((i, c), slopes.to_vec());
        0.0
    });
    all.into_inner().expect("no panic")
}

/// The same, one row after the other.
fn judged(design: &Design, readings: &Readings) -> BTreeMap<(usize, usize), Vec<f64>> {
    let (n, mut all) = (design.unknowns(), BTreeMap::new());
    let mut slopes = vec![0.0; 3 * n];
    for i in 0..readings.len() {
        let channels = design.slopes(readings, i, &mut slopes);
        for (c, slopes) in slopes.chunks_exact(n).enumerate().take(channels) {
            all.insert((i, c), slopes.to_vec());
        }
    }
    all
}

/// The largest difference, and the largest slope.
fn apart(design: &Design, readings: &Readings) -> (f64, f64) {
    let (found, due) = (by_groups(design, readings), judged(design, readings));
    assert_eq!(found.keys().collect::<Vec<_>>(), due.keys().collect::<Vec<_>>());
    let pairs = || found.values().flatten().zip(due.values().flatten());
    assert_eq!(pairs().count(), due.len() * design.unknowns());
    let most = |of: fn((&f64, &f64)) -> f64| pairs().map(of).fold(0.0, f64::max);
    (most(|(found, due)| (found - due).abs()), most(|(_, due)| due.abs()))
}

#[test]
fn law_slopes_by_groups_are_those_of_each_row() {
    for name in MACHINES {
        for machine in stated(name) {
            let design = design_of(&machine);
            let readings = rows(&mut SplitMix64::new(21), &machine, design.instruments.len());
            // Of a point 10 m away the last digit is 2·10⁻¹² mm.
            let (off, largest) = apart(&design, &readings);
            assert!(off < 1e-13 * largest, "{name}: {off} of {largest}");
        }
    }
}

#[test]
fn law_residuals_by_groups_are_those_of_each_row() {
    for name in MACHINES {
        for machine in stated(name) {
            let design = design_of(&machine);
            let mut random = SplitMix64::new(22);
            let mut readings = rows(&mut random, &machine, design.instruments.len());
            let size = |k: usize| match design.unknown(k) {
                Some(u) if u.is_angle() => 3e-5,
                Some(u) if u.is_share() || u.is_time() => 1e-5,
                _ => 0.01,
            };
            let truth: Vec<f64> =
                (0..design.unknowns()).map(|k| within(&mut random, size(k))).collect();
            for i in 0..readings.len() {
                let read = design.read(&readings, i, &truth).expect("within the tables");
                readings.values[i] = read.map(|v| v + within(&mut random, 1e-3));
            }
            let found = fit(&design, &readings, &[]).expect("a fit");
            let n = design.unknowns();
            let mut along = DVector::zeros(n);
            let mut slopes = vec![0.0; 3 * n];
            for i in 0..readings.len() {
                let read = design.read(&readings, i, &found.values).expect("within the tables");
                let channels = design.slopes(&readings, i, &mut slopes);
                let noise = design.instruments[readings.instruments[i] as usize].noise;
                for c in 0..channels {
                    let due = readings.values[i][c] - read[c];
                    let off = (found.residuals[i][c] - due).abs();
                    assert!(off < 1e-9, "{name}, row {i}: {} {due}", found.residuals[i][c]);
                    for k in 0..n {
                        along[k] += slopes[c * n + k] * due / noise[c].powi(2);
                    }
                }
            }
            // One more step is no share of a standard uncertainty.
            let step = found.sight.solve(&along);
            let length = step.dot(&along).abs().sqrt();
            assert!(length < 1e-6, "{name}: {length} after {} passes", found.passes);
        }
    }
}

/// The bits of a row do not depend on the order of the rows.
#[test]
fn law_a_row_has_the_same_slopes_among_any_others() {
    let [machine, _] = stated("lei-hsu-mill");
    let design = design_of(&machine);
    let readings = rows(&mut SplitMix64::new(23), &machine, design.instruments.len());
    let mut backwards = Readings::default();
    for i in (0..readings.len()).rev() {
        backwards.push(readings.row(i));
    }
    let (all, turned) = (by_groups(&design, &readings), by_groups(&design, &backwards));
    for ((i, c), slopes) in &all {
        assert_eq!(*slopes, turned[&(readings.len() - 1 - i, *c)], "row {i}");
    }
}

/// The models that have no groups give the same as before, row by row; the first row outside a table is named whichever
/// instrument reads it.
#[test]
fn law_what_the_groups_do_not_cover_is_computed_row_by_row() {
    let [machine, _] = stated("lei-hsu-mill");
    for model in [
        ErrorModel { rotation: Rotation::SmallAngle, ..ErrorModel::default() },
        ErrorModel { squareness: Squareness::Direction, ..ErrorModel::default() },
    ] {
        let design = design_of(&machine.clone().with_model(model));
        let readings = rows(&mut SplitMix64::new(24), &machine, design.instruments.len());
        assert_eq!(apart(&design, &readings).0, 0.0, "{model:?}");
    }
    let design = design_of(&bare("lei-hsu-mill"));
    let mut readings = rows(&mut SplitMix64::new(25), &machine, design.instruments.len());
    // Far turns are no reason to leave a row out: the scalar form computes them.
    readings.commands[100][0] += 2e5;
    let (off, largest) = apart(&design, &readings);
    assert!(off < 1e-13 * largest, "{off} of {largest}");
    readings.instruments[300] = 29;
    readings.instruments[301] = 0;
    readings.commands[300][3] = f64::NAN;
    readings.commands[301][3] = 1e13;
    match fit(&design, &readings, &[]) {
        Err(FitError::Outside { row, .. }) => assert_eq!(row, 300),
        other => panic!("{:?}", other.map(|fit| fit.passes)),
    }
}

/// The normal matrix of many rows, which is summed from groups, is the sum of those of parts of them, which are not; with the
/// weights of a robust fit, too.
#[test]
fn law_the_normal_matrix_of_many_rows_is_that_of_its_parts() {
    for name in MACHINES {
        for machine in stated(name) {
            let design = design_of(&machine);
            let few = rows(&mut SplitMix64::new(26), &machine, design.instruments.len());
            let mut many = Readings::default();
            for i in 0..6000 {
                many.push(few.row(i * 7 % few.len()));
            }
            let weights: Vec<f64> = (0..many.len()).map(|i| (i % 5) as f64 / 4.0).collect();
            for weights in [&[][..], &weights] {
                let priors = normal_matrix(&design, &Readings::default(), &[]);
                let mut due = priors.clone();
                for start in (0..many.len()).step_by(1500) {
                    let mut part = Readings::default();
                    (start..start + 1500).for_each(|i| part.push(many.row(i)));
                    let weights = weights.get(start..start + 1500).unwrap_or_default();
                    due += normal_matrix(&design, &part, weights) - &priors;
                }
                let found = normal_matrix(&design, &many, weights);
                for (i, j) in (0..due.nrows()).flat_map(|i| (0..=i).map(move |j| (i, j))) {
                    let unit = (due[(i, i)] * due[(j, j)]).sqrt();
                    let off = (found[(i, j)] - due[(i, j)]).abs();
                    assert!(off <= 1e-12 * unit, "{name} {i} {j}: {off} of {unit}");
                }
            }
        }
    }
}

/// Bodies of an instrument's own and light do not grow with the workpiece; its surfaces do, unless they are read from the bed.
#[test]
fn law_only_surfaces_of_the_workpiece_grow_with_it() {
    for name in MACHINES {
        let [_, warm] = stated(name);
        let cold_piece = warm.without_growth();
        let [warm, cold_piece] = [&warm, &cold_piece].map(design_of);
        let readings = rows(&mut SplitMix64::new(27), &warm.machine, warm.instruments.len());
        let none = vec![0.0; warm.unknowns()];
        for i in 0..readings.len() {
            let of = &warm.instruments[readings.instruments[i] as usize];
            let read =
                |design: &Design| design.read(&readings, i, &none).expect("within the tables");
            let grows = matches!(of.kind, Kind::CutPiece | Kind::TouchProbeFace | Kind::Points(_));
            let may = grows && of.reference == Reference::Workpiece;
            assert!(may || read(&warm) == read(&cold_piece), "{name}: {}", of.name);
            let is_place = of.kind == Kind::CutPiece && may;
            assert!(!is_place || read(&warm) != read(&cold_piece), "{name}: {}", of.name);
        }
    }
}
