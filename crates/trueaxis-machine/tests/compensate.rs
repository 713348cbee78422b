//! Compensated poses: the actual tool stands where the programmed one should.

mod library;

use library::{
    FIVE_AXIS, MACHINES, Random, away_from_ends, checked, machine, machine_of, sides, warm,
    with_random_errors,
};
use trueaxis_machine::axis::{Approach, AxisKind, Command};
use trueaxis_machine::compensate::{
    AxisLimitation, CompensatedPose, Compensator, Fault, MOST_SWING, Scope,
};
use trueaxis_machine::errors::{Curve, ErrorName, ErrorValues, Rotation, StatedError};
use trueaxis_machine::{ErrorModel, Machine, Squareness};

/// Actual minus programmed tip and axis, by the machine itself and its matrices.
fn missed(machine: &Machine, programmed: &Command, given: &Command, side: &Approach) -> [f64; 2] {
    let wanted = machine.deviation(programmed, &ErrorValues::default());
    let errors = machine.errors_at(given, side).expect("inside the tables");
    let pose = machine.pose(given, &errors);
    let tip = pose.linear() * machine.tip_mm() + pose.shift_mm();
    let axis = pose.linear().column(2).normalize();
    [(tip - wanted.nominal_tip.vector()).norm(), (axis - wanted.nominal_axis.vector()).norm()]
}

/// Compensates a pose and judges it; the axis only where it is said to be corrected.
fn judged(compensator: &Compensator, command: &Command, side: &Approach) -> CompensatedPose {
    let machine = compensator.machine();
    let name = machine.name();
    let done = compensator.at(command, side).unwrap_or_else(|f| panic!("{name} {command:?}: {f}"));
    let [tip, axis] = missed(machine, command, &done.command, side);
    assert!(tip < 1e-9, "{name} {command:?}: {tip:e} mm");
    assert!(axis < 1e-12 || done.axis_limitation.is_some(), "{name} {command:?}: {axis:e}");
    assert!((tip - done.residual.tip_mm.norm()).abs() < 1e-10, "{name}: what it says of the tip");
    assert!((axis - done.residual.axis.norm()).abs() < 1e-12, "{name}: what it says of the axis");
    done
}

fn pose(machine: &Machine) -> Compensator {
    Compensator::of(machine, Scope::Pose).expect("three linear axes")
}

/// The evaluations and how often the axis kept a deviation, in hundredths of the poses.
fn judged_everywhere(machine: &Machine, random: &mut Random, poses: u32) -> (u32, u32) {
    let compensator = pose(machine);
    let (mut most, mut share) = (0, 0);
    for _ in 0..poses {
        let (command, side) = (away_from_ends(machine, random), sides(random));
        let done = judged(&compensator, &command, &side);
        most = most.max(done.evaluations);
        share += u32::from(done.axis_limitation.is_some());
    }
    (most, 100 * share / poses)
}

// ---------------------------------------------------------------- every machine

#[test]
fn law_compensated_poses_are_the_programmed_ones() {
    let mut random = Random(3);
    for name in MACHINES {
        let own = machine(name);
        let five_axes = FIVE_AXIS.contains(&name);
        let (most, share) = judged_everywhere(&own, &mut random, 2_000);
        assert!(most <= 4, "{name}: {most} evaluations");
        assert!(!five_axes || share <= 2, "{name}: {share} % near a pole");
        for reach in [0.05, 1.0] {
            for _ in 0..20 {
                let wrong = with_random_errors(&own, &mut random, reach);
                let (most, share) = judged_everywhere(&wrong, &mut random, 500);
                assert!(most <= if reach < 1.0 { 5 } else { 9 }, "{name}: {most} evaluations");
                assert!(!five_axes || share <= 3, "{name}: {share} % near a pole");
            }
        }
    }
}

#[test]
fn law_every_error_model_and_temperature_is_compensated() {
    let mut random = Random(4);
    for name in ["xkas2525", "i5-engraver", "lei-hsu-mill"] {
        for rotation in [Rotation::Exact, Rotation::SmallAngle] {
            for squareness in [Squareness::Carried, Squareness::Direction] {
                let wrong = with_random_errors(&machine(name), &mut random, 0.3)
                    .with_model(ErrorModel { rotation, squareness });
                judged_everywhere(&wrong, &mut random, 1_000);
            }
        }
    }
    let hot = machine("gantry-001");
    let hot = warm(&hot, "scale_x=25 scale_y=24 workpiece=28");
    assert!(hot.growth().is_some());
    let (most, _) = judged_everywhere(&hot, &mut random, 1_000);
    assert!(most <= 4, "{most} evaluations");
}

#[test]
fn law_without_errors_the_command_stays() {
    let mut random = Random(5);
    let plain = machine_of("nutating-head", |text| text);
    let plain = plain
        .stated_errors()
        .into_iter()
        .fold(plain.clone(), |m, (index, _)| m.with_error(index, None));
    for scope in [Scope::Pose, Scope::Position] {
        let compensator = Compensator::of(&plain, scope).expect("three linear axes");
        for _ in 0..500 {
            let command = random.command(&plain);
            let done = compensator.at(&command, &[0.0; 6]).expect("a pose");
            assert_eq!((done.command, done.evaluations, done.axis_limitation), (command, 1, None));
        }
    }
}

// ---------------------------------------------------------------- position only

#[test]
fn law_position_only_moves_no_rotary_axis() {
    let mut random = Random(6);
    for name in MACHINES {
        let wrong = with_random_errors(&machine(name), &mut random, 1.0);
        let compensator = Compensator::of(&wrong, Scope::Position).expect("three linear axes");
        for _ in 0..1_000 {
            let (command, side) = (away_from_ends(&wrong, &mut random), sides(&mut random));
            let done = judged(&compensator, &command, &side);
            assert_eq!(done.axis_limitation, Some(AxisLimitation::PositionOnly));
            for (i, axis) in wrong.axes().iter().enumerate() {
                let stays = done.command[i] == command[i];
                assert!(stays || axis.kind == AxisKind::Linear, "{name}: {} moved", axis.name);
            }
        }
    }
}

#[test]
fn fewer_than_two_rotary_axes_leave_the_tool_axis() {
    for chain in ["w b X Y Z t", "w C' b X Y Z t", "w b X Y Z B t"] {
        let text = format!(
            "[machine]\nname = \"m\"\nchain = \"{chain}\"\n[tool]\nlength = \"80 mm\"\n\
             [location]\nEA0Z = \"50 urad\"\nEB0Y = \"-30 urad\"\nEC0Y = \"10 urad\""
        );
        let compensator = pose(&checked(&text, ""));
        let done = judged(&compensator, &[30.0, 40.0, 500.0, -70.0, 0.0, 0.0], &[0.0; 6]);
        assert_eq!(done.axis_limitation, Some(AxisLimitation::FewRotaryAxes), "{chain}");
        assert!(done.residual.axis.norm() > 1e-5, "{chain}");
    }
}

// ---------------------------------------------------------------- poles

/// Head with C and A, its spindle leaning sideways and forwards; errors that stand still.
fn leaning_head(rest: &str) -> Machine {
    checked(
        &format!(
            "[machine]\nname = \"head\"\nchain = \"w b X Y Z C A t\"\n[tool]\nlength = \"200 mm\"\n\
             [location]\nEB0Z = \"20 urad\"\nEA0Z = \"30 urad\"\n{rest}"
        ),
        "",
    )
}

#[test]
fn law_near_a_pole_no_axis_swings_beyond_the_limit() {
    let machine = leaning_head("");
    let compensator = pose(&machine);
    for tilt in [0.0, 1e-9, 1e-6, 2e-5, 1e-4, 1e-3, 5e-3, 9.9e-3, 1.02e-2, 0.1, 0.7] {
        for turn in 0..12 {
            let c = f64::from(turn) * 0.5;
            let command = [0.0, 0.0, 0.0, c, tilt, 0.0];
            let done = judged(&compensator, &command, &[0.0; 6]);
            let size = done.before.axis.norm();
            let swing = (done.command[3] - c).abs().max((done.command[4] - tilt).abs());
            assert!(swing <= 1.02 * MOST_SWING * size, "{tilt}: {swing} rad for {size}");
            assert!(done.residual.axis.norm() <= 1.001 * size, "{tilt}: no worse than before");
            if tilt < 0.995 / MOST_SWING {
                let Some(AxisLimitation::Pole(axis)) = done.axis_limitation else {
                    panic!("{tilt}")
                };
                assert_eq!(axis.to_string(), "C");
                // A has corrected its part: the residual error lies along A, as far as its errors permit.
                let along_a = nalgebra::Vector3::new(c.cos(), c.sin(), 0.0);
                let other = done.residual.axis - along_a * along_a.dot(&done.residual.axis);
                assert!(other.norm() < 2.0 * size * (swing + size), "{tilt}: {:e}", other.norm());
            } else {
                assert_eq!(done.axis_limitation, None, "{tilt}");
            }
        }
    }
}

#[test]
fn at_the_limit_of_the_pole_the_command_does_not_jump() {
    let compensator = pose(&leaning_head(""));
    let at = |tilt: f64| {
        let done = judged(&compensator, &[0.0, 0.0, 0.0, 2.5, tilt, 0.0], &[0.0; 6]);
        (done.command, done.axis_limitation.is_some())
    };
    // The limit is where the *actual* tool is 0.01 rad from C: some 30 µrad beside.
    let (mut below, mut above) = (9.9e-3, 1.01e-2);
    assert!(at(below).1 && !at(above).1);
    for _ in 0..30 {
        let middle = 0.5 * (below + above);
        if at(middle).1 { below = middle } else { above = middle }
    }
    let ((low, _), (high, _)) = (at(below), at(above));
    // A whole correction of C is some 3 mrad here.
    assert!((low[3] - 2.5).abs() > 1e-3);
    assert!((low[3] - high[3]).abs() < 2e-5, "{} {}", low[3], high[3]);
}

#[test]
fn a_wider_limit_corrects_nearer_to_the_pole() {
    let compensator = pose(&leaning_head(""));
    let command = [0.0, 0.0, 0.0, 0.4, 5e-3, 0.0];
    assert!(judged(&compensator, &command, &[0.0; 6]).axis_limitation.is_some());
    let wider = compensator.swinging_at_most(1000.0);
    assert_eq!(judged(&wider, &command, &[0.0; 6]).axis_limitation, None);
}

// ---------------------------------------------------------------- direction of travel

#[test]
fn each_direction_of_travel_has_its_own_command() {
    let text = "[machine]\nname = \"m\"\nchain = \"w b X Y Z t\"\n\
                [motion.X]\nEXX = { polynomial = [\"0 um\", \"10 um\"], scale = \"100 mm\", \
                reversal = \"6 um\" }";
    let compensator = pose(&checked(text, ""));
    let at = |side: f64| {
        judged(&compensator, &[200.0, 0.0, 0.0, 0.0, 0.0, 0.0], &[side, 0.0, 0.0, 0.0, 0.0, 0.0])
            .command[0]
    };
    // q + 10⁻⁴·q ± 0.003 = 200, by hand.
    for (side, wanted) in [(1.0, 199.997 / 1.0001), (-1.0, 200.003 / 1.0001), (0.0, 200.0 / 1.0001)]
    {
        assert!((at(side) - wanted).abs() < 1e-9, "{side}: {} {wanted}", at(side));
    }
}

// ---------------------------------------------------------------- redundant axes

#[test]
fn a_redundant_linear_axis_keeps_its_place() {
    let text = "[machine]\nname = \"m\"\nchain = \"w b X Y W Z t\"\n\
                [location]\nEC0Y = \"10 urad\"\nEA0Y = \"-20 urad\"";
    let compensator = pose(&checked(text, ""));
    let command = [10.0, 500.0, 77.0, -300.0, 0.0, 0.0];
    let done = judged(&compensator, &command, &[0.0; 6]);
    assert_eq!(done.command[2], 77.0);
    assert_ne!(done.command[3], -300.0);
}

#[test]
fn three_rotary_axes_share_the_smallest_motion() {
    let text = "[machine]\nname = \"m\"\nchain = \"w C' b X Y Z B A t\"\n[tool]\n\
                length = \"100 mm\"\n[location]\nEB0Z = \"40 urad\"\nEA0Z = \"-25 urad\"";
    let machine = checked(text, "");
    let compensator = pose(&machine);
    let command = [0.3, 10.0, 20.0, 30.0, 0.5, -0.4];
    let done = judged(&compensator, &command, &[0.0; 6]);
    assert_eq!(done.axis_limitation, None);
    // B and A alone come there as well, by no shorter way.
    let two = pose(&checked(&text.replace("C' ", ""), ""));
    let other = judged(&two, &[10.0, 20.0, 30.0, 0.5, -0.4, 0.0], &[0.0; 6]).command;
    let square = |turns: [f64; 3]| turns.iter().map(|t| t * t).sum::<f64>();
    let least = square([done.command[0] - 0.3, done.command[4] - 0.5, done.command[5] + 0.4]);
    let held = square([0.0, other[3] - 0.5, other[4] + 0.4]);
    assert!(least < 0.99 * held, "{least:e} {held:e}");
}

// ---------------------------------------------------------------- faults

#[test]
fn an_axis_at_its_end_is_named_with_how_far_it_would_pass() {
    let text = "[machine]\nname = \"m\"\nchain = \"w b X Y Z t\"\n[axis.X]\n\
                travel = [\"-300 mm\", \"300 mm\"]\n[location]\nEC0Y = \"1000 urad\"";
    let compensator = pose(&checked(text, ""));
    // Y = 150 mm and 1 mrad move X by 0.15 mm, inwards from −300 mm, outwards from 300 mm.
    let faults: Vec<Fault> = [-300.0, 300.0]
        .into_iter()
        .filter_map(|x| compensator.at(&[x, 150.0, 0.0, 0.0, 0.0, 0.0], &[0.0; 6]).err())
        .collect();
    let [Fault::Travel { axis, at, by }] = faults[..] else { panic!("{faults:?}") };
    assert_eq!(axis.to_string(), "X");
    assert!((at - 300.15).abs() < 1e-6 && (by - 0.15).abs() < 1e-6);
    assert!(faults[0].to_string().contains("outside its travel"), "{}", faults[0]);
}

#[test]
fn commands_without_errors_are_refused() {
    let compensator = pose(&machine("xkas2525"));
    let at = |x: f64| compensator.at(&[x, 100.0, -100.0, 0.0, 0.5, 0.0], &[0.0; 6]);
    assert!(matches!(at(f64::NAN), Err(Fault::Command(_))));
    assert!(matches!(at(7000.0), Err(Fault::Command(_))));
}

#[test]
fn a_table_that_ends_before_the_travel_is_named() {
    let text = "[machine]\nname = \"m\"\nchain = \"w b X Y Z t\"\n[motion.X]\ntable = \"t.csv\"\n\
                outside = \"error\"";
    let csv = "position_mm,EXX_um\n0,0\n100,-20\n200,-40\n";
    let fault = pose(&checked(text, csv)).at(&[200.0, 0.0, 0.0, 0.0, 0.0, 0.0], &[0.0; 6]);
    let Err(fault @ Fault::Corrected(_)) = fault else { panic!("{fault:?}") };
    assert!(fault.to_string().contains("EXX: 200.04"), "{fault}");
}

#[test]
fn two_linear_axes_are_refused() {
    let text = "[machine]\nname = \"m\"\nchain = \"w C' b X Z t\"";
    let fault = Compensator::of(&checked(text, ""), Scope::Pose).err();
    assert_eq!(fault, Some(Fault::FewLinearAxes { linear: 2 }));
}

#[test]
fn errors_as_steep_as_the_axis_are_refused() {
    let plain = checked("[machine]\nname = \"m\"\nchain = \"w b X Y Z t\"", "");
    let exx = plain.error_index(ErrorName::parse("EXX").expect("a name")).expect("a body");
    // e = −q + 1: wherever the axis goes, the tool stands at 1.
    let steep = Curve::Polynomial { coefficients: vec![1.0, -1.0], origin: 0.0, scale: 1.0 };
    let stated = StatedError { mean: steep, ..StatedError::constant(0.0, None) };
    let compensator = pose(&plain.with_error(exx, Some(stated)));
    let fault = compensator.at(&[5.0, 0.0, 0.0, 0.0, 0.0, 0.0], &[0.0; 6]);
    assert_eq!(fault.err(), Some(Fault::Flat));
}

#[test]
fn steps_that_lead_nowhere_are_refused() {
    let plain = checked("[machine]\nname = \"m\"\nchain = \"w b X Y Z t\"", "");
    let exx = plain.error_index(ErrorName::parse("EXX").expect("a name")).expect("a body");
    // The tool stands at q + 1 − q + q² = 1 + q², never at the 0.3 that is programmed.
    let curve = Curve::Polynomial { coefficients: vec![1.0, -1.0, 1.0], origin: 0.0, scale: 1.0 };
    let stated = StatedError { mean: curve, ..StatedError::constant(0.0, None) };
    let compensator = pose(&plain.with_error(exx, Some(stated)));
    let fault = compensator.at(&[0.3, 0.0, 0.0, 0.0, 0.0, 0.0], &[0.0; 6]);
    let Err(fault @ Fault::NotConverged { .. }) = fault else { panic!("{fault:?}") };
    assert!(fault.to_string().contains("check the error tables"), "{fault}");
}
