//! What holds for every machine, whatever its numbers are.

mod library;

use library::{FIVE_AXIS, Random, SHIPPED, checked, machine, machine_of};
use std::f64::consts::TAU;
use trueaxis_geometry::frame::rotation;
use trueaxis_geometry::{Mat3, Vec3};
use trueaxis_machine::axis::Command;
use trueaxis_machine::errors::{
    Component, Curve, ErrorIndex, ErrorKind, ErrorValues, Extrapolation, Interpolation, Rotation,
    SixErrors, Spline,
};
use trueaxis_machine::{ErrorModel, Machine, Squareness, volume};

/// All errors of all bodies: ±20 µm and ±100 µrad.
fn random_errors(random: &mut Random, machine: &Machine) -> ErrorValues {
    let mut errors = ErrorValues::default();
    for index in every_error(machine) {
        let reach = if index.component.is_rotation() { 1e-4 } else { 0.02 };
        errors.set(index, random.within(reach));
    }
    errors
}

fn every_error(machine: &Machine) -> Vec<ErrorIndex> {
    let mut all = Vec::new();
    for (body, b) in machine.bodies().iter().enumerate() {
        for component in Component::ALL {
            all.push(ErrorIndex { body, kind: ErrorKind::Location, component });
            if b.axis.is_some() {
                all.push(ErrorIndex { body, kind: ErrorKind::Motion, component });
            }
        }
    }
    all
}

/// A table in X and Y below a Z head, with further lines.
fn mill(rest: &str) -> Machine {
    checked(&format!("[machine]\nname = \"mill\"\nchain = \"w X' Y' b Z t\"\n{rest}"), "")
}

fn stated_deviation(machine: &Machine, command: &Command) -> Vec3 {
    let errors = machine.errors_at(command, &[0.0; 6]).expect("within the tables");
    machine.deviation(command, &errors).tip_mm
}

const MODELS: [ErrorModel; 4] = {
    let (exact, small) = (Rotation::Exact, Rotation::SmallAngle);
    let (carried, direction) = (Squareness::Carried, Squareness::Direction);
    [
        ErrorModel { rotation: exact, squareness: carried },
        ErrorModel { rotation: exact, squareness: direction },
        ErrorModel { rotation: small, squareness: carried },
        ErrorModel { rotation: small, squareness: direction },
    ]
};

/// The corners first, then poses within the travel; every axis has as many on either side of its middle.
#[test]
fn law_the_volume_is_filled_evenly() {
    for name in SHIPPED {
        let machine = machine(name);
        let (axes, count) = (machine.axes(), 300_u32);
        let all = volume::commands(axes, count);
        let corners = 1_usize << axes.len();
        assert_eq!(all.len(), corners + count as usize);
        for (i, axis) in axes.iter().enumerate() {
            let at: Vec<f64> = all.iter().map(|command| command[i]).collect();
            let (low, high) =
                at.iter().fold((f64::MAX, f64::MIN), |r, q| (r.0.min(*q), r.1.max(*q)));
            assert!(at.iter().all(|q| axis.travel.contains(*q)), "{name} {}", axis.name);
            assert!(at[..corners].iter().all(|q| *q == low || *q == high), "{name} {}", axis.name);
            let mean = at.iter().map(|q| (q - low) / (high - low)).sum::<f64>() / at.len() as f64;
            assert!((mean - 0.5).abs() < 0.02, "{name} {}: {mean}", axis.name);
        }
    }
}

// ---------------------------------------------------------------- errors and deviations

#[test]
fn law_no_errors_no_deviation_at_all() {
    let mut random = Random(1);
    for name in SHIPPED {
        for model in MODELS {
            let machine = machine(name).with_model(model);
            for _ in 0..400 {
                let at = machine.deviation(&random.command(&machine), &ErrorValues::default());
                assert_eq!(at.tip_mm, Vec3::zeros(), "{name} {model:?}");
                assert_eq!(at.axis, Vec3::zeros(), "{name} {model:?}");
            }
        }
    }
}

/// The deviation to first order: the slope at zero errors, by a central difference whose own error
/// is of third order and a millionth of what is judged.
fn linear(machine: &Machine, command: &Command, errors: &ErrorValues) -> (Vec3, Vec3) {
    let h = 1e-3;
    let plus = machine.deviation(command, &errors.scaled(h));
    let minus = machine.deviation(command, &errors.scaled(-h));
    ((plus.tip_mm - minus.tip_mm) / (2.0 * h), (plus.axis - minus.axis) / (2.0 * h))
}

/// Asserts that a difference of second order falls to a quarter; `floor` is where noise begins.
fn falls_by_four(whole: Vec3, half: Vec3, floor: f64, what: &str) -> bool {
    if whole.norm() < floor {
        return false;
    }
    let ratio = whole.norm() / half.norm();
    assert!((3.96..4.04).contains(&ratio), "{what}: {ratio}");
    true
}

#[test]
fn law_errors_halved_difference_of_exact_and_linear_falls_by_four() {
    let mut random = Random(2);
    for name in SHIPPED {
        let exact = machine(name);
        let small = exact
            .clone()
            .with_model(ErrorModel { rotation: Rotation::SmallAngle, ..exact.model() });
        let mut judged = 0;
        for _ in 0..1500 {
            let command = random.command(&exact);
            let errors = random_errors(&mut random, &exact);
            let [to_linear, to_small, of_axis] = [1.0, 0.5]
                .map(|factor| {
                    let errors = errors.scaled(factor);
                    let whole = exact.deviation(&command, &errors);
                    let (tip, axis) = linear(&exact, &command, &errors);
                    let matrices = small.deviation(&command, &errors);
                    [whole.tip_mm - tip, whole.tip_mm - matrices.tip_mm, whole.axis - axis]
                })
                .map_pairs();
            // 1e-8 mm: some thousand times the rounding of the deviation.
            judged += usize::from(falls_by_four(to_linear.0, to_linear.1, 1e-8, name));
            judged += usize::from(falls_by_four(to_small.0, to_small.1, 1e-8, name));
            judged += usize::from(falls_by_four(of_axis.0, of_axis.1, 1e-10, name));
        }
        assert!(judged > 2000, "{name}: only {judged} were large enough");
    }
}

/// `[[a, b, c], [x, y, z]]` to `[(a, x), (b, y), (c, z)]`.
trait MapPairs {
    fn map_pairs(self) -> [(Vec3, Vec3); 3];
}

impl MapPairs for [[Vec3; 3]; 2] {
    fn map_pairs(self) -> [(Vec3, Vec3); 3] {
        std::array::from_fn(|i| (self[0][i], self[1][i]))
    }
}

#[test]
fn law_small_errors_superpose() {
    let mut random = Random(3);
    for name in SHIPPED {
        for model in MODELS {
            let machine = machine(name).with_model(model);
            let mut judged = 0;
            for _ in 0..60 {
                let command = random.command(&machine);
                let errors = random_errors(&mut random, &machine);
                let [whole, half] = [1.0, 0.5].map(|factor| {
                    let errors = errors.scaled(factor);
                    let alone = |i: &ErrorIndex| machine.deviation(&command, &errors.only(*i));
                    let sum: Vec3 = every_error(&machine).iter().map(|i| alone(i).tip_mm).sum();
                    sum - machine.deviation(&command, &errors).tip_mm
                });
                // 1e-4 rad times 60 errors of up to 1 µm each 100 mm of lever: far below a percent.
                assert!(whole.norm() < 0.01, "{name}: {whole}");
                judged += usize::from(falls_by_four(whole, half, 1e-8, name));
            }
            assert!(judged > 30, "{name}: only {judged} were large enough");
        }
    }
}

#[test]
fn law_the_matrices_say_the_same() {
    let mut random = Random(4);
    for name in SHIPPED {
        for model in MODELS {
            let machine = machine(name).with_model(model);
            for _ in 0..200 {
                let (command, errors) =
                    (random.command(&machine), random_errors(&mut random, &machine));
                let at = machine.deviation(&command, &errors);
                let pose = machine.pose(&command, &errors);
                let tip = pose.linear() * machine.tip_mm() + pose.shift_mm();
                assert!((tip - at.nominal_tip.vector() - at.tip_mm).amax() < 1e-11);
                let axis = (pose.linear() * Vec3::z()).normalize();
                assert!((axis - at.nominal_axis.vector() - at.axis).amax() < 2e-15);
            }
        }
    }
}

/// conventions.md: `Rz(EC)·Ry(EB)·Rx(EA)`; another order differs in the second order.
#[test]
fn law_an_error_turns_about_x_then_y_then_z() {
    let mut random = Random(13);
    for reach in [1e-6, 1e-3, 1.0, 10.0] {
        for _ in 0..2000 {
            let [a, b, c] = std::array::from_fn(|_| random.within(reach));
            let six = SixErrors([1.0, 2.0, 3.0, a, b, c]);
            let product =
                rotation(Vec3::z(), c) * (rotation(Vec3::y(), b) * rotation(Vec3::x(), a));
            let ours = six.rotation_minus_identity(Rotation::Exact);
            assert!((ours + Mat3::identity() - product).amax() < 1e-15);
            // [ε]× v = ε × v
            let v = Vec3::new(0.3, -0.5, 0.8);
            let small = six.rotation_minus_identity(Rotation::SmallAngle) * v;
            assert!((small - Vec3::new(six.0[3], six.0[4], six.0[5]).cross(&v)).amax() < 1e-15);
        }
    }
}

// ---------------------------------------------------------------- signs

#[test]
fn law_error_of_a_workpiece_axis_enters_with_the_opposite_sign() {
    for sense in [-1, 1] {
        let errors = "[motion.X]\nEXX = \"5 um\"\n[motion.Z]\nEXZ = \"3 um\"\n";
        let machine = mill(&format!("[axis.X]\nsense = {sense}\n{errors}"));
        for x in [-100.0, 0.0, 100.0] {
            let tip = stated_deviation(&machine, &[x, 20.0, -30.0, 0.0, 0.0, 0.0]);
            assert!((tip - Vec3::new(-0.005 + 0.003, 0.0, 0.0)).amax() < 1e-17, "{tip}");
        }
    }
    // A table that turns by +10 µrad has turned away under the tool: EC0C of C' at x = 100 mm.
    let text =
        "[machine]\nname = \"t\"\nchain = \"w C' b X Y Z t\"\n[motion.C]\nECC = \"10 urad\"\n";
    let tip = stated_deviation(&checked(text, ""), &[0.0, 100.0, 0.0, 0.0, 0.0, 0.0]);
    assert!((tip - Vec3::new(0.0, -0.001, 0.0)).amax() < 1e-8, "{tip}");
}

#[test]
fn law_the_sense_turns_the_motion_and_not_the_error() {
    let mut random = Random(5);
    for name in ["lei-hsu-mill", "i5-engraver", "head-table"] {
        let normal = machine(name);
        for (i, axis) in normal.axes().iter().enumerate() {
            let header = format!("[axis.{}]", axis.name);
            let line = format!("{header}\nsense = {}", -axis.sense);
            let flipped = machine_of(name, |text| {
                let without = text.replace("sense = -1\n", "").replace("sense = 1\n", "");
                let keep = |a: &trueaxis_machine::axis::Axis| {
                    (
                        format!("[axis.{}]\n", a.name),
                        format!("[axis.{}]\nsense = {}\n", a.name, a.sense),
                    )
                };
                let others = normal.axes().iter().filter(|a| a.name != axis.name).map(keep);
                let text = others.fold(without, |text, (from, to)| text.replace(&from, &to));
                text.replace(&header, &line)
            });
            assert_eq!(flipped.axes()[i].sense, -axis.sense);
            for _ in 0..50 {
                let (command, errors) =
                    (random.command(&normal), random_errors(&mut random, &normal));
                let mut mirrored = command;
                mirrored[i] = -command[i];
                let there = normal.deviation(&command, &errors);
                let here = flipped.deviation(&mirrored, &errors);
                assert!((there.tip_mm - here.tip_mm).amax() < 1e-15);
                assert!((there.axis - here.axis).amax() < 1e-18);
            }
        }
    }
}

#[test]
fn law_pure_shifts_of_workpiece_and_tool() {
    let mut random = Random(6);
    for name in SHIPPED {
        let machine = machine(name);
        let last = machine.bodies().len() - 1;
        for _ in 0..200 {
            let command = random.command(&machine);
            let shift = Vec3::from_fn(|_, _| random.within(0.05));
            let of_body = |body: usize| {
                let mut errors = ErrorValues::default();
                for (i, component) in Component::ALL.into_iter().take(3).enumerate() {
                    let index = ErrorIndex { body, kind: ErrorKind::Location, component };
                    errors.set(index, shift[i]);
                }
                machine.deviation(&command, &errors)
            };
            // The workpiece moves away under the tool; its mounting says in which direction.
            let away = of_body(0);
            let back = machine.bodies()[0].mounting.linear().transpose();
            assert!((away.tip_mm + back * shift).amax() < 1e-16, "{name}");
            assert_eq!(away.axis, Vec3::zeros());
            // The tool moves along with its spindle.
            let along = of_body(last);
            let turn = *machine.pose(&command, &ErrorValues::default()).linear();
            assert!((along.tip_mm - turn * shift).amax() < 1e-16, "{name}");
            assert_eq!(along.axis, Vec3::zeros());
        }
    }
}

#[test]
fn law_error_frames_coincide_at_zero_and_differ_elsewhere() {
    let mut random = Random(7);
    for name in FIVE_AXIS {
        let of_frame = |frame: &str| {
            machine_of(name, |text| {
                let line = format!("[machine]\nerror_frame = \"{frame}\"");
                text.replace("error_frame = \"moving\"", "").replace("[machine]", &line)
            })
        };
        let (fixed, moving) = (of_frame("fixed"), of_frame("moving"));
        let rotary: Vec<usize> = (0..5).filter(|i| fixed.axes()[*i].name.is_rotary()).collect();
        for _ in 0..200 {
            let errors = random_errors(&mut random, &fixed);
            let mut command = random.command(&fixed);
            let both = |command: &Command| {
                let tip = |m: &Machine| m.deviation(command, &errors).tip_mm;
                (tip(&fixed) - tip(&moving)).amax()
            };
            assert!(both(&command) > 1e-6, "{name}: {}", both(&command));
            for i in &rotary {
                command[*i] = 0.0;
            }
            assert!(both(&command) < 1e-15, "{name}: {}", both(&command));
        }
    }
}

#[test]
fn law_the_whole_machine_may_stand_anywhere() {
    let mut random = Random(8);
    let turned = "\"shift 1000 -2000 300 mm\", \"turn X 20 deg\", \"turn Z -130 deg\"";
    let here = machine("i5-engraver");
    let elsewhere = machine_of("i5-engraver", |text| {
        text.replace("[axis.A]", &format!("[axis.A]\nplacement = [{turned}]"))
            .replace("\"0 0 250 mm\"", &format!("[{turned}, \"shift 0 0 250 mm\"]"))
    });
    for _ in 0..2000 {
        let (command, errors) = (random.command(&here), random_errors(&mut random, &here));
        let (a, b) = (here.deviation(&command, &errors), elsewhere.deviation(&command, &errors));
        assert!((a.nominal_tip - b.nominal_tip).amax() < 1e-11);
        assert!((a.nominal_axis.vector() - b.nominal_axis.vector()).amax() < 1e-14);
        assert!((a.tip_mm - b.tip_mm).amax() < 1e-15);
        assert!((a.axis - b.axis).amax() < 1e-18);
    }
}

// ---------------------------------------------------------------- curves

const RISING: f64 = 1.0;
const FALLING: f64 = -1.0;
const UNKNOWN: f64 = 0.0;

/// EXX of a mill with a table `t.csv`.
fn with_table(motion: &str, csv: &str) -> Machine {
    let text = format!(
        "[machine]\nname = \"mill\"\nchain = \"w b X Y Z t\"\n\
         [axis.X]\ntravel = [\"-100 mm\", \"100 mm\"]\n[motion.X]\n{motion}\n"
    );
    checked(&text, csv)
}

fn exx(machine: &Machine, x: f64, approach: f64) -> f64 {
    let body = machine.bodies().iter().position(|b| b.name.letter() == 'X').expect("X");
    let index = ErrorIndex { body, kind: ErrorKind::Motion, component: Component::X };
    let mut at = Command::default();
    let mut side = [0.0; 6];
    (at[body - 1], side[body - 1]) = (x, approach);
    machine.errors_at(&at, &side).expect("within the table").get(index)
}

#[test]
fn law_backlash_is_up_minus_down_and_the_mean_lies_between() {
    let constant = with_table(
        "EXX = { polynomial = [\"1 um\", \"4 um\"], scale = \"100 mm\", reversal = \"-3 um\" }",
        "",
    );
    let csv = "position_mm,EXX_up_um,EXX_down_um\n-100,3,1\n0,5,-2\n40,1,1.5\n100,2,0\n";
    for (interpolation, exact) in [("linear", true), ("not-a-knot", false)] {
        let how = format!("table = \"t.csv\"\ninterpolation = \"{interpolation}\"");
        let table = with_table(&how, csv);
        for i in 0..=200 {
            let x = f64::from(i) - 100.0;
            let [up, down, mean] = [RISING, FALLING, UNKNOWN].map(|side| exx(&table, x, side));
            assert!((0.5 * (up + down) - mean).abs() < 1e-17);
            if exact && (-100.0..=0.0).contains(&x) {
                let t = (x + 100.0) / 100.0;
                assert!((up - (0.003 + 0.002 * t)).abs() < 1e-17);
                assert!((down - (0.001 - 0.003 * t)).abs() < 1e-17);
            }
            let [up, down, mean] = [RISING, FALLING, UNKNOWN].map(|side| exx(&constant, x, side));
            assert!((up - down + 0.003).abs() < 1e-17 && (0.5 * (up + down) - mean).abs() < 1e-17);
            assert!((mean - (0.001 + 0.004 * x / 100.0)).abs() < 1e-17);
        }
        for (x, up, down) in [(-100.0, 3.0, 1.0), (0.0, 5.0, -2.0), (40.0, 1.0, 1.5)] {
            assert!((exx(&table, x, RISING) * 1e3 - up).abs() < 1e-12);
            assert!((exx(&table, x, FALLING) * 1e3 - down).abs() < 1e-12);
        }
    }
    // A column pair of one error motion of its own.
    let own = with_table("EXX = { table = \"t.csv\", interpolation = \"linear\" }", csv);
    assert!((exx(&own, 0.0, RISING) - exx(&own, 0.0, FALLING) - 0.007).abs() < 1e-17);
}

#[test]
fn law_uncertainties_are_those_that_were_stated() {
    let text = "[machine]\nname = \"mill\"\nchain = \"w b X Y Z t\"\n[location]\n\
        EC0Y = \"12 ± 2 urad\"\nEA0Z = \"5 urad\"\nEB0Z = \"3 mrad +- 40 µrad\"\n\
        [motion.X]\ntable = \"t.csv\"\nu = [\"0.5 um\", \"1 urad\"]\noutside = \"extend\"\n\
        [motion.Y]\nu = [\"0.4 um\", \"2 urad\"]\nEYY = { constant = \"1 um\", u = \"0.25 μm\" }\n\
        EXY = \"1 ± 0.125 um\"\nEAY = \"3 urad\"\n";
    let csv = "position_mm,EXX_um,u_EXX_um,ECX_urad\n-10,0,1,0\n0,1,3,2\n10,0,2,5\n";
    let machine = checked(text, csv);
    let u = |letter: char, kind, component, x: f64| {
        let body = machine.bodies().iter().position(|b| b.name.letter() == letter).expect("a body");
        let mut at = Command::default();
        at[0] = x;
        let u = machine.uncertainties_at(&at, &machine.uncertain_quantities());
        u.of_errors().get(ErrorIndex { body, kind, component })
    };
    use {Component as C, ErrorKind::*};
    let same = |ours: f64, theirs: f64| assert!((ours - theirs).abs() < 1e-18, "{ours} {theirs}");
    same(u('Y', Location, C::C, 0.0), 2e-6);
    same(u('Z', Location, C::A, 0.0), 0.0);
    same(u('Z', Location, C::B, 0.0), 40e-6);
    for (x, um) in [(-99.0, 1.0), (-10.0, 1.0), (-5.0, 2.0), (0.0, 3.0), (5.0, 2.5), (99.0, 2.0)] {
        same(u('X', Motion, C::X, x), um / 1e3);
        same(u('X', Motion, C::C, x), 1e-6);
    }
    same(u('X', Motion, C::Y, 0.0), 0.0);
    same(u('Y', Motion, C::Y, 0.0), 0.00025);
    same(u('Y', Motion, C::X, 0.0), 0.000125);
    same(u('Y', Motion, C::A, 0.0), 2e-6);
}

/// A table in degrees whose ends are the travel: the end is never lost to rounding.
#[test]
fn law_the_ends_of_a_table_in_degrees_belong_to_it() {
    for (interpolation, outside) in ["not-a-knot", "linear", "periodic"]
        .into_iter()
        .flat_map(|i| ["error", "clamp", "extend"].map(|o| (i, o)))
    {
        for from in (-360..=0).step_by(7) {
            let to = if interpolation == "periodic" { from + 360 } else { from + 83 };
            let middle = [from + 17, from + 40];
            let text = format!(
                "[machine]\nname = \"m\"\nchain = \"w b X Y Z C t\"\n[axis.C]\n\
                 travel = [\"{from} deg\", \"{to} deg\"]\n[motion.C]\ntable = \"t.csv\"\n\
                 interpolation = \"{interpolation}\"\noutside = \"{outside}\"\n"
            );
            let csv = format!(
                "position_deg,ECC_urad\n{from},3\n{},5\n{},-4\n{to},3\n",
                middle[0], middle[1]
            );
            let machine = checked(&text, &csv);
            let index = ErrorIndex { body: 4, kind: ErrorKind::Motion, component: Component::C };
            let at = |c: f64| {
                let errors = machine.errors_at(&[0.0, 0.0, 0.0, c, 0.0, 0.0], &[0.0; 6]);
                errors.map(|e| e.get(index) * 1e6)
            };
            for end in [from, to].map(f64::from) {
                let spellings =
                    [end.to_radians(), end * std::f64::consts::PI / 180.0, end / 360.0 * TAU];
                for q in spellings {
                    let value = at(q).expect("the end belongs to the table");
                    assert!((value - 3.0).abs() < 1e-9, "{interpolation} {outside} {end}: {value}");
                    assert!(machine.axes()[3].travel.contains(q));
                }
            }
            let beyond = f64::from(to + 10).to_radians();
            match outside {
                "error" if interpolation == "periodic" => {}
                "error" => {
                    let error = at(beyond).expect_err("outside").to_string();
                    let wanted = format!("ECC: {} deg lies outside the error table", to + 10);
                    assert!(error.starts_with(&wanted), "{error}");
                }
                "clamp" if interpolation != "periodic" => {
                    assert!((at(beyond).expect("clamped") - 3.0).abs() < 1e-9);
                }
                _ => assert!(at(beyond).is_ok()),
            }
        }
    }
}

#[test]
fn law_beyond_the_ends_a_table_clamps_or_goes_straight_on() {
    let mut random = Random(9);
    for _ in 0..200 {
        let knots = knots(&mut random, 6);
        let values: Vec<f64> = knots.iter().map(|_| random.within(0.01)).collect();
        for interpolation in [Interpolation::NotAKnot, Interpolation::Linear] {
            let spline = Spline::new(&knots, &values, interpolation).expect("a spline");
            let of = |outside| Curve::Table { spline: spline.clone(), outside };
            let (first, last) = spline.range();
            for (end, beyond) in [(first, first - 3.0), (last, last + 3.0)] {
                assert!(of(Extrapolation::Error).at(beyond).is_err());
                let at = |outside, q| of(outside).at(q).expect("defined everywhere");
                assert_eq!(at(Extrapolation::Clamp, beyond), spline.at(end));
                let step = at(Extrapolation::Extend, beyond) - spline.at(end);
                assert!((step - spline.slope_at(end) * (beyond - end)).abs() < 1e-15);
                for outside in [Extrapolation::Error, Extrapolation::Clamp, Extrapolation::Extend] {
                    assert_eq!(at(outside, end), spline.at(end));
                }
            }
        }
    }
}

/// Increasing, with steps between 1 and 20.
fn knots(random: &mut Random, count: usize) -> Vec<f64> {
    let mut at = random.within(100.0);
    std::iter::repeat_with(|| {
        at += 1.0 + 19.0 * random.unit();
        at
    })
    .take(count)
    .collect()
}

#[test]
fn law_splines_reproduce_what_their_knots_determine() {
    let mut random = Random(10);
    for round in 0..400 {
        let count = 2 + round % 12;
        let x = knots(&mut random, count);
        let degree = (count - 1).min(3);
        let c: Vec<f64> = (0..=degree).map(|_| random.within(1.0)).collect();
        let (from, reach) = (x[0], x[count - 1] - x[0]);
        let value = |q: f64| c.iter().rev().fold(0.0, |sum, c| sum * ((q - from) / reach) + c);
        let y: Vec<f64> = x.iter().map(|q| value(*q)).collect();
        let spline = Spline::new(&x, &y, Interpolation::NotAKnot).expect("a spline");
        for _ in 0..50 {
            let q = from + reach * random.unit();
            assert!((spline.at(q) - value(q)).abs() < 1e-12, "{count} knots");
        }
    }
}

#[test]
fn law_periodic_splines_close_with_slope_and_curvature() {
    let mut random = Random(11);
    for round in 0..400 {
        let x = knots(&mut random, 2 + round % 20);
        let mut y: Vec<f64> = x.iter().map(|_| random.within(1.0)).collect();
        let last = y.len() - 1;
        y[last] = y[0];
        let spline = Spline::new(&x, &y, Interpolation::Periodic).expect("a spline");
        let (from, to) = spline.range();
        let curvature = |piece: usize, h: f64| {
            let [_, _, c2, c3] = spline.pieces()[piece];
            2.0 * c2 + 6.0 * c3 * h
        };
        let (first, end) = (curvature(0, 0.0), curvature(last - 1, to - x[last - 1]));
        assert!((spline.at(from) - spline.at(to)).abs() < 1e-12);
        assert!((spline.slope_at(from) - spline.slope_at(to)).abs() < 1e-11);
        assert!((first - end).abs() < 1e-10, "{} knots", x.len());
        for (i, knot) in x.iter().enumerate().skip(1).take(last.saturating_sub(1)) {
            let (left, right) = (curvature(i - 1, knot - x[i - 1]), curvature(i, 0.0));
            assert!((left - right).abs() < 1e-10, "{} knots", x.len());
        }
    }
}

// ---------------------------------------------------------------- the machine file

/// ISO 841: an axis that carries the workpiece has a prime, those on the side of the tool have none.
#[test]
fn law_axes_of_the_workpiece_have_a_prime() {
    for (name, text) in [
        ("i5-engraver", "w C' A' b X Y Z t"),
        ("head-table", "w C' b X Y Z B t"),
        ("xkas2525", "w b X Y Z C A t"),
    ] {
        assert_eq!(machine(name).chain_text(), text);
    }
}
