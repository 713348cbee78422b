//! RTCP calibrations with the directions of the rotary axes: angles that are put in come out beside the centres,
//! and where one height or one tool cannot show them, that is reported with the reading that would.

mod library;

use library::{Random, machine, root};
use std::fmt::Write;
use std::path::PathBuf;
use std::sync::atomic::{AtomicUsize, Ordering};
use trueaxis::files::disk;
use trueaxis::geometry::Vec3;
use trueaxis::identify::rtcp::{Calibration, Purpose, RtcpStudy, Segments, calibrate, parse_rtcp};
use trueaxis::machine::Machine;
use trueaxis::machine::axis::{AxisKind, Command, Travel};
use trueaxis::machine::errors::ErrorValues;
use trueaxis::machine::tcp::TipControl;
use trueaxis::nc::{Control, Program};
use trueaxis::simulate::{Batch, Densify, Observer, Options, SetUp, simulate};

/// Table-table, one each, head-head.
const MACHINES: [&str; 3] = ["i5-engraver", "head-table", "xkas2525"];

fn folder() -> PathBuf {
    static NEXT: AtomicUsize = AtomicUsize::new(0);
    let (process, number) = (std::process::id(), NEXT.fetch_add(1, Ordering::Relaxed));
    let folder = std::env::temp_dir().join(format!("trueaxis-rtcp-angles-{process}-{number}"));
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

/// A set of readings: RTCP on or off, how much longer the tool is, where the ball stands from the working point.
#[derive(Clone, Copy)]
struct Set {
    rtcp: bool,
    longer_mm: f64,
    ball_mm: [f64; 3],
}

const BOTH: [Set; 3] = [
    Set { rtcp: true, longer_mm: 0.0, ball_mm: [20.0, 5.0, -10.0] },
    Set { rtcp: false, longer_mm: 0.0, ball_mm: [-15.0, 20.0, 0.0] },
    Set { rtcp: true, longer_mm: 60.0, ball_mm: [10.0, -10.0, 20.0] },
];

/// A point of the workpiece in the middle of the travel.
fn working_point(machine: &Machine) -> Vec3 {
    let mut command = Command::default();
    for (q, axis) in command.iter_mut().zip(machine.axes()) {
        if let (AxisKind::Linear, Travel::Between(from, to)) = (axis.kind, axis.travel) {
            *q = 0.5 * (from + to);
        }
    }
    let pose = machine.pose(&command, &ErrorValues::default());
    pose.linear() * machine.tip_mm() + pose.shift_mm()
}

fn poses(machine: &Machine, dice: &mut Random) -> Vec<Command> {
    let pose = |k: usize, dice: &mut Random| {
        let mut command = Command::default();
        for (q, axis) in command.iter_mut().zip(machine.axes()) {
            if axis.kind == AxisKind::Rotary && k > 0 {
                let (from, to) = match axis.travel {
                    Travel::Between(from, to) => (from.max(-1.7), to.min(1.7)),
                    _ => (-3.0, 3.0),
                };
                *q = from + (to - from) * dice.unit();
            }
        }
        command
    };
    (0..20).map(|k| pose(k, dice)).collect()
}

/// A study of these sets without values.
fn study(name: &str, angles: &str, sets: &[Set], dice: &mut Random) -> RtcpStudy {
    let machine = machine(name);
    let (centre, tip) = (working_point(&machine), machine.tip_mm());
    let mut text = format!(
        "name = 'law'\nmachine = '{}'\nerrors = 'none'\nangles = '{angles}'\n",
        root().join("machines").join(name).join("machine.toml").display()
    );
    let folder = folder();
    for (i, set) in sets.iter().enumerate() {
        let ball = centre + Vec3::from(set.ball_mm);
        // Writing to a String cannot fail.
        let _ = write!(
            text,
            "[readings.s{i}]\nrtcp = {}\nindicator = 'spindle'\nnoise = '1 um'\n\
             ball = '{} {} {} mm'\ntip = '{} {} {} mm'\ntable = 's{i}.csv'\n",
            set.rtcp,
            ball.x,
            ball.y,
            ball.z,
            tip.x,
            tip.y,
            tip.z - set.longer_mm
        );
        let heads: Vec<String> = machine.axes().iter().map(|a| a.name.to_string()).collect();
        let mut table = format!("{},x_um,y_um,z_um\n", heads.join(","));
        for pose in poses(&machine, dice) {
            let row = machine.axes().iter().zip(&pose).map(|(a, q)| match a.kind {
                AxisKind::Rotary => q.to_degrees().to_string(),
                AxisKind::Linear => q.to_string(),
            });
            let _ = writeln!(table, "{},0,0,0", row.collect::<Vec<_>>().join(","));
        }
        std::fs::write(folder.join(format!("s{i}.csv")), table).unwrap();
    }
    let (study, problems) = parse_rtcp(&disk(), &folder.join("law.toml"), &text, Purpose::Result);
    std::fs::remove_dir_all(&folder).unwrap();
    let mut study = study.unwrap_or_else(|| panic!("{problems:?}"));
    for set in study.sets.iter_mut().filter(|s| !s.tcp) {
        let held = study.machine.clone().with_tip(set.instrument.tool_point_mm);
        let control = TipControl::of(&held).unwrap();
        for row in &mut set.rows {
            assert!(control.place(set.instrument.reference_point_mm, &mut row.command));
        }
    }
    study
}

/// What would be read on a machine with these centres (mm) and angles (rad), by the full pose of its chain, the
/// ball elsewhere than is said.
fn read(study: &mut RtcpStudy, mm: &[f64], rad: &[f64], noise_mm: f64, dice: &mut Random) {
    for set in &mut study.sets {
        let tip = set.instrument.tool_point_mm;
        let held = study.machine.clone().with_tip(tip);
        let control = TipControl::of(&held).unwrap();
        let off = Vec3::new(dice.within(0.4), dice.within(0.4), dice.within(0.4));
        let ball = set.instrument.reference_point_mm + off;
        for row in &mut set.rows {
            let mut command = row.command;
            if set.tcp {
                assert!(control.place(set.instrument.reference_point_mm, &mut command));
            }
            let mut errors = ErrorValues::default();
            for (term, x) in study.centres.terms.iter().zip(mm) {
                errors.set(term.index, *x);
            }
            for (term, x) in study.angles.terms.iter().zip(rad) {
                errors.set(term.index, *x);
            }
            let pose = study.machine.pose(&command, &errors);
            let seen = pose.linear().transpose() * (pose.linear() * tip + pose.shift_mm() - ball);
            row.read_mm = [0, 1, 2].map(|i| Some(seen[i] + noise_mm * dice.normal()));
        }
    }
}

fn names(found: &Calibration) -> Vec<&str> {
    found.angles.iter().map(|a| a.name.as_str()).collect()
}

#[test]
fn every_machine_has_the_angles_of_its_axes() {
    let mut dice = Random(1);
    let of = |name: &str, dice: &mut Random| {
        let study = study(name, "found", &BOTH, dice);
        study.angles.terms.iter().map(|t| t.error.to_string()).collect::<Vec<_>>()
    };
    // Four fields of angles on the screen of the i5 control, four angles of a table with A and C.
    assert_eq!(of("i5-engraver", &mut dice), ["EB0A", "EC0A", "EA0C", "EB0C"]);
    assert_eq!(of("head-table", &mut dice)[..4], ["EA0C", "EB0C", "EA0B", "EC0B"]);
    assert_eq!(of("xkas2525", &mut dice)[..4], ["EA0C", "EB0C", "EB0A", "EC0A"]);
}

/// Angles of up to ±200 µrad and centres of up to ±50 µm come back together, on three topologies, with 1 µm of
/// noise: within 2 U each, and 95 % of all within U.
#[test]
fn law_angles_and_centres_come_back_together() {
    for name in MACHINES {
        let mut dice = Random(5);
        let mut study = study(name, "found", &BOTH, &mut dice);
        let (n, a) = (study.centres.terms.len(), study.angles.terms.len());
        let (mut inside, mut all) = (0, 0);
        for _ in 0..40 {
            let mm: Vec<f64> = (0..n).map(|_| dice.within(0.05)).collect();
            let rad: Vec<f64> = (0..a).map(|_| dice.within(200e-6)).collect();
            read(&mut study, &mm, &rad, 1e-3, &mut dice);
            let found = calibrate(&study).unwrap();
            assert!(found.verdict().starts_with("yes"), "{name}: {}", found.verdict());
            let centres = found.offsets.iter().zip(&mm).map(|(o, t)| (o.found_mm, &o.name, t));
            let angles = found.angles.iter().zip(&rad).map(|(o, t)| (o.found_rad, &o.name, t));
            for (value, which, truth) in centres.chain(angles) {
                let (x, u) = value.unwrap_or_else(|| panic!("{name}: {which} not found"));
                let off = (x - truth).abs() / (2.0 * u);
                assert!(off < 2.0, "{name} {which}: {x} ± {u}, true {truth}");
                all += 1;
                inside += usize::from(off <= 1.0);
            }
        }
        let share = f64::from(inside as u32) / f64::from(all);
        assert!(share > 0.92, "{name}: {share} within U");
    }
}

/// Without noise they come back to 0.1 µm and 2 µrad: a ball that is 0.4 mm off its stated place, times 200 µrad, is 0.08 µm.
#[test]
fn law_without_noise_only_the_second_order_remains() {
    for name in MACHINES {
        let mut dice = Random(9);
        let mut study = study(name, "found", &BOTH, &mut dice);
        let mm: Vec<f64> = study.centres.terms.iter().map(|_| dice.within(0.05)).collect();
        let rad: Vec<f64> = study.angles.terms.iter().map(|_| dice.within(200e-6)).collect();
        read(&mut study, &mm, &rad, 0.0, &mut dice);
        let found = calibrate(&study).unwrap();
        for (o, truth) in found.offsets.iter().zip(&mm) {
            let (x, _) = o.found_mm.unwrap();
            assert!((x - truth).abs() < 1e-4, "{name} {}: {x} {truth}", o.name);
        }
        for (o, truth) in found.angles.iter().zip(&rad) {
            let (x, _) = o.found_rad.unwrap();
            assert!((x - truth).abs() < 2e-6, "{name} {}: {x} {truth}", o.name);
        }
    }
}

/// Where the angles are not asked for but present, the offsets are wrong and the readings do not fit; the report
/// says what would explain them.
#[test]
fn inclined_axes_are_suspected() {
    let mut dice = Random(3);
    let mut asked = study("i5-engraver", "stated", &BOTH, &mut dice);
    read(&mut asked, &[0.01; 4], &[200e-6, -150e-6, 100e-6, 180e-6], 1e-3, &mut dice);
    let found = calibrate(&asked).unwrap();
    assert!(!found.is_good());
    assert!(found.suspicions[0].contains("inclined"), "{:?}", found.suspicions);
    assert!(found.angles.iter().all(|a| a.found_rad.is_none() && a.expected_u_rad.is_some()));
}

/// A spindle head with one tool: what its length cannot separate is reported with the reading that would.
#[test]
fn one_tool_length_is_not_enough_for_a_head() {
    let mut dice = Random(4);
    let one = [BOTH[0], BOTH[1]];
    for name in ["head-table", "xkas2525"] {
        let mut study = study(name, "found", &one, &mut dice);
        let zeros = vec![0.0; study.angles.terms.len()];
        read(&mut study, &[0.0; 4], &zeros, 1e-3, &mut dice);
        let found = calibrate(&study).unwrap();
        let unseen: Vec<_> = found.angles.iter().filter(|a| a.found_rad.is_none()).collect();
        assert!(!unseen.is_empty(), "{name}: {:?}", names(&found));
        for angle in unseen {
            let further = angle.further.as_deref().unwrap_or("");
            assert!(further.contains("second tool"), "{name} {}: {further}", angle.name);
        }
        assert!(!found.is_complete(), "{name}: a centre that an angle may be is not known");
    }
}

/// A table of which only C was turned: the angles of A are not observable, and the reading that helps is named.
#[test]
fn an_axis_that_stands_still_hides_its_direction() {
    let mut dice = Random(6);
    let mut study = study("i5-engraver", "found", &BOTH, &mut dice);
    let a = study.machine.axes().iter().position(|x| x.name.letter() == 'A').unwrap();
    for set in &mut study.sets {
        for row in &mut set.rows {
            row.command[a] = 0.0;
        }
    }
    for set in study.sets.iter_mut().filter(|s| !s.tcp) {
        let control = TipControl::of(&study.machine).unwrap();
        for row in &mut set.rows {
            assert!(control.place(set.instrument.reference_point_mm, &mut row.command));
        }
    }
    read(&mut study, &[0.0; 4], &[0.0; 4], 1e-3, &mut dice);
    let found = calibrate(&study).unwrap();
    let unseen: Vec<_> = found.angles.iter().filter(|a| a.found_rad.is_none()).collect();
    assert!(unseen.iter().any(|a| a.name == "EB0A"), "{:?}", found.angles);
    for angle in unseen {
        let further = angle.further.as_deref().unwrap_or("");
        assert!(further.contains("both rotary axes"), "{}: {further}", angle.name);
    }
}

fn segments(chord_error_mm: f64, distance_mm: f64) -> Segments {
    Segments {
        chord_error_mm,
        distance_mm,
        shortest_mm: None,
        first_mm: None,
        sharpest_rad_per_mm: None,
    }
}

/// How a program is cut: the commands at the ends of the pieces.
fn cut(program: &str, chord_mm: f64) -> Vec<Command> {
    struct Ends(Vec<Command>);
    impl Observer for Ends {
        fn path(&mut self, batch: &Batch<'_>) {
            self.0.extend(batch.nodes.iter().filter(|n| n.origin.line == 3).map(|n| n.command));
        }
    }
    let machine = library::bare("i5-engraver");
    let program = Program::new("c.nc", program.as_bytes().to_vec(), Control::Fanuc);
    let densify = Densify::Tolerance { chord_mm, angle_rad: 10.0, spacing_mm: 1e6 };
    let options = Options { densify, ..Options::default() };
    let mut ends = Ends(Vec::new());
    let run = {
        let mut observers: Vec<&mut dyn Observer> = vec![&mut ends];
        simulate(&machine, &program, &SetUp::default(), &options, &mut observers)
    };
    assert!(!run.problems.has_errors(), "{:?}", run.problems);
    ends.0
}

/// C turns by 90° around a tip that stands still: the path of trueaxis-motion, which is cut by halves where straight
/// axes would leave the tip, has pieces that keep the largest step, and twice a piece would not.
#[test]
fn law_the_densified_path_keeps_the_largest_step() {
    for distance_mm in [20.0, 60.0, 100.0] {
        for chord_mm in [1e-3, 5e-3, 20e-3] {
            let text = format!(
                "G21 G90 G43.4 H1\nG1 X{distance_mm} Y0. Z0. A0. C0. F1000.\nX{distance_mm} Y0. Z0. A0. C90. F1000.\nM30\n"
            );
            let ends = cut(&text, chord_mm);
            assert!(ends.len() > 4, "{} pieces", ends.len());
            let piece = std::f64::consts::FRAC_PI_2 / ends.len() as f64;
            let s = segments(chord_mm, distance_mm);
            assert!(piece <= s.largest_step_rad() * (1.0 + 1e-9), "{piece} {s:?}");
            assert!(2.0 * piece > s.largest_step_rad(), "{piece} {s:?}");
        }
    }
}

/// The middle of a piece on which the rotary axes turn and the tip moves lies nearer to its line than the bound;
/// at the longest segment that the bound allows the chord error is never passed, and used to more than a third.
#[test]
fn law_the_bound_of_two_axes_and_a_moving_tip_holds() {
    let machine = library::bare("i5-engraver");
    let control = TipControl::of(&machine).unwrap();
    let mut dice = Random(8);
    let place = |p: Vec3, a: f64, c: f64| {
        let mut command = Command::default();
        (command[0], command[1]) = (c, a);
        assert!(control.place(p, &mut command));
        command
    };
    let mut most: f64 = 0.0;
    for _ in 0..4000 {
        // Within a ball about the point where the axes meet, 35 mm below the workpiece frame.
        let reach = 80.0;
        let p = loop {
            let p = Vec3::new(dice.within(reach), dice.within(reach), dice.within(reach));
            if p.norm() < 0.9 * reach {
                break p;
            }
        };
        let s = segments(1e-3, reach);
        let rho = dice.between(0.001, 0.5);
        let length = s.longest_mm(rho);
        let along = Vec3::new(dice.normal(), dice.normal(), dice.normal()).normalize() * length;
        let share = dice.unit();
        let (a, c) = (dice.within(1.5), dice.within(3.0));
        let (da, dc) = (share * rho * length, (1.0 - share) * rho * length);
        let p0 = p - Vec3::new(0.0, 0.0, 35.0);
        let (from, to) = (place(p0, a, c), place(p0 + along, a + da, c + dc));
        let middle: Command = std::array::from_fn(|i| 0.5 * (from[i] + to[i]));
        let tip = control.tip_and_axis(&middle).0;
        let off = (tip - (p0 + along * 0.5)).norm();
        assert!(off <= 1e-3, "{off} mm at {rho} rad/mm");
        most = most.max(off);
        assert!((s.largest_turn_rad_per_mm(length) - rho).abs() < 1e-9);
    }
    assert!(most > 0.33e-3, "the bound is never nearly reached: {most}");
}

/// The example: readings of oracles/rtcp_angles.py, a model in plain Python; centres and angles within 2 U.
#[test]
fn oracle_two_balls_of_python() {
    let path = root().join("examples/05_identify/rtcp-angles.toml");
    let (study, problems) = trueaxis::identify::rtcp::read_rtcp(&disk(), &path, Purpose::Result);
    let study = study.unwrap_or_else(|| panic!("{problems:?}"));
    assert!(problems.iter().next().is_none(), "{problems:?}");
    let found = calibrate(&study).unwrap();
    assert!(
        found.verdict().starts_with("yes: all 4 offsets and 4 of 4 angles"),
        "{}",
        found.verdict()
    );
    let centres = [("EX0C", -0.0187), ("EY0C", -0.0094), ("EY0A", 0.0312), ("EZ0A", -0.0245)];
    for (name, truth) in centres {
        let (x, u) = found.offsets.iter().find(|o| o.name == name).unwrap().found_mm.unwrap();
        assert!((x - truth).abs() < 4.0 * u && u < 1e-3, "{name}: {x} ± {u}");
    }
    let angles = [("EB0A", 120e-6), ("EC0A", -85e-6), ("EA0C", 60e-6), ("EB0C", -150e-6)];
    for (name, truth) in angles {
        let (x, u) = found.angles.iter().find(|o| o.name == name).unwrap().found_rad.unwrap();
        assert!((x - truth).abs() < 4.0 * u && u < 15e-6, "{name}: {x} ± {u}");
    }
}
