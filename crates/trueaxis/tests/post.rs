//! Cutter locations to programs and back, on every machine, for every control.

#![allow(clippy::print_stdout, reason = "the whole set says what it found")]

mod library;

use library::paths::{cl, free_form, ways};
use library::{MACHINES, machine};
use proptest::prelude::*;
use std::f64::consts::{PI, TAU};
use std::fmt::Write;
use trueaxis::geometry::Vec3;
use trueaxis::machine::Machine;
use trueaxis::machine::axis::Command;
use trueaxis::machine::file::NoTables;
use trueaxis::machine::tcp::TipControl;
use trueaxis::nc::moves::{Axis, Feed, FeedMode, Move, MoveKind};
use trueaxis::nc::{Control, NoLibrary, Program, Settings, Step, interpret};
use trueaxis::post::{FeedRule, PostOptions, Posted, post, verify};
use trueaxis::simulate::{Batch, Observer, Options, SetUp, simulate};
use trueaxis::writer::TipWords;

fn posted(machine: &Machine, text: &str, options: &PostOptions) -> Posted {
    let (posted, problems) = post(machine, &cl(text), options);
    posted.unwrap_or_else(|| panic!("{problems:?}\n{text}"))
}

/// Posts, verifies, and tells what is out of bounds.
fn prove(machine: &Machine, text: &str, options: &PostOptions) -> Result<[f64; 4], String> {
    let (posted, problems) = post(machine, &cl(text), options);
    let Some(posted) = posted else {
        return Err(format!("{:?}", problems.iter().map(ToString::to_string).collect::<Vec<_>>()));
    };
    let proof = verify(machine, &posted, options);
    let increment_mm = 1e-4;
    let found = [
        proof.tip_at_ends.value,
        proof.axis_at_ends.value,
        proof.tip_between.value,
        proof.axis_between.value,
    ];
    let allowed = [
        increment_mm,
        1e-6,
        options.tolerance_mm + increment_mm,
        options.axis_tolerance_rad + 1e-6,
    ];
    let within = found.iter().zip(allowed).all(|(f, a)| *f <= a);
    let all = proof.compared == posted.blocks && posted.blocks >= posted.strokes / 2;
    match within && all && proof.is_within(options) {
        true => Ok(found),
        false => {
            let codes: Vec<_> = proof.problems.iter().map(|p| p.code).collect();
            let critical = proof.issues.is_critical();
            Err(format!("{found:?} {:?} {codes:?} critical {critical}", proof.tip_between))
        }
    }
}

fn prove_all(paths: u64, points: usize) -> [f64; 4] {
    let mut worst = [0.0_f64; 4];
    let mut faults = Vec::new();
    for name in MACHINES {
        let machine = machine(name);
        for (i, options) in ways().iter().enumerate() {
            for path in 0..paths {
                let seed = path * 1000 + 7 * i as u64 + name.len() as u64;
                match prove(&machine, &free_form(&machine, seed, points), options) {
                    Ok(found) => {
                        worst = std::array::from_fn(|k| worst[k].max(found[k]));
                    }
                    Err(why) => faults.push(format!(
                        "{name} {:?} {:?} seed {seed}: {why}",
                        options.control, options.tip_words
                    )),
                }
            }
        }
    }
    assert!(faults.is_empty(), "{} faults:\n{}", faults.len(), faults.join("\n"));
    worst
}

/// CL to NC to simulation on the nominal machine: tips within the tolerance and one least
/// increment, tool axes within 1e-6, for a sample of random paths on every machine, for every
/// dialect, with and without tool-centre point.
#[test]
fn law_programs_of_free_form_paths_come_back() {
    let worst = prove_all(2, 24);
    println!(
        "worst: tip {:.3e} mm, axis {:.3e}, on the way {:.3e} mm, {:.3e} rad",
        worst[0], worst[1], worst[2], worst[3]
    );
}

/// The whole set: 200 paths. `cargo test --release -p trueaxis --test post -- --ignored`
#[test]
#[ignore = "the whole set takes minutes"]
fn law_programs_of_200_free_form_paths_come_back() {
    let worst = prove_all(200, 40);
    println!(
        "worst: tip {:.3e} mm, axis {:.3e}, on the way {:.3e} mm, {:.3e} rad",
        worst[0], worst[1], worst[2], worst[3]
    );
}

/// The moves with feed of a program.
fn cuts(posted: &Posted, control: Control) -> Vec<Move> {
    let program = Program::new("p", posted.text.clone(), control);
    let mut found = Vec::new();
    let outcome = interpret(&program, &NoLibrary, &Settings::default(), &mut |step| {
        if let Step::Move(m) = step
            && m.kind == MoveKind::Linear
        {
            found.push(m);
        }
    });
    assert!(outcome.finished && !outcome.problems.has_errors(), "{:?}", outcome.problems);
    found
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    /// Without tool-centre point the engraver's programs are equations 1 to 3 of Zhang et al. 2023, with
    /// d = 35 mm, to the digits of the program.
    ///
    /// X = x cos C + y sin C, Y = (−x sin C + y cos C) cos A + (z + d) sin A,
    /// Z = (x sin C − y cos C) sin A + (z + d) cos A
    #[test]
    fn law_programs_of_the_engraver_are_equations_1_to_3_of_document_003(
        x in -30.0..30.0_f64, y in -30.0..30.0_f64, z in -20.0..20.0_f64,
        tilt in 0.01..1.5_f64, azimuth in -PI..PI,
    ) {
        let machine = machine("i5-engraver");
        let axis = Vec3::new(tilt.sin() * azimuth.cos(), tilt.sin() * azimuth.sin(), tilt.cos());
        let text = format!(
            "UNITS/MM\nFEDRAT/100\nGOTO/{x},{y},{z},{},{},{}\n", axis.x, axis.y, axis.z
        );
        let options = PostOptions { tip_words: None, ..PostOptions::of(Control::Fanuc) };
        let all = cuts(&posted(&machine, &text, &options), Control::Fanuc);
        prop_assert_eq!(all.len(), 1);
        let at = |axis: Axis| all[0].target[axis];
        let ((sa, ca), (sc, cc)) =
            (at(Axis::A).to_radians().sin_cos(), at(Axis::C).to_radians().sin_cos());
        let d = 35.0;
        prop_assert!((at(Axis::X) - (x * cc + y * sc)).abs() < 5.1e-5);
        prop_assert!((at(Axis::Y) - ((-x * sc + y * cc) * ca + (z + d) * sa)).abs() < 5.1e-5);
        prop_assert!((at(Axis::Z) - ((x * sc - y * cc) * sa + (z + d) * ca)).abs() < 5.1e-5);
        // a = Rz(C) Rx(A) e_z
        let is = Vec3::new(sc * sa, -cc * sa, ca);
        prop_assert!((is - axis).norm() < 2e-7);
    }
}

/// A helix round a part on a head whose C stops at ±360 deg: it rewinds, and nothing is lost.
#[test]
fn law_rewinds_leave_the_path_as_it_is() {
    let machine = machine("xkas2525");
    let mut text = "UNITS/MM\nMULTAX/ON\nFEDRAT/2000,MMPM\n".to_owned();
    for k in 0..=400 {
        let u = TAU * f64::from(k) / 80.0;
        let (s, c) = u.sin_cos();
        let _ = writeln!(
            text,
            "GOTO/{:.6},{:.6},{:.6},{:.12},{:.12},{:.12}",
            40.0 * c,
            40.0 * s,
            20.0 + f64::from(k) / 10.0,
            0.6 * c,
            0.6 * s,
            0.8
        );
    }
    for options in ways() {
        let posted = posted(&machine, &text, &options);
        assert!(posted.rewinds >= 2, "{}", posted.rewinds);
        let proof = verify(&machine, &posted, &options);
        assert!(proof.is_within(&options), "{proof:?}");
        assert_eq!(proof.compared, posted.blocks);
    }
}

/// A path that passes the pole at any distance is followed exactly, and with a pole tolerance
/// straight through it, with the deviation that is stated.
#[test]
fn law_poles_are_passed_with_the_stated_deviation() {
    let machine = machine("i5-engraver");
    for (k, beside) in [0.0, 1e-9, 1e-6, 1e-4, 1e-3, 0.02].into_iter().enumerate() {
        let mut text = "UNITS/MM\nMULTAX/ON\nFEDRAT/2000,MMPM\n".to_owned();
        for i in -6..=6 {
            let tilt = 0.03 * f64::from(i);
            let _ = writeln!(
                text,
                "GOTO/{:.6},{:.6},10,{:.15},{:.15},{:.15}",
                f64::from(i),
                5.0,
                tilt,
                beside,
                (1.0 - tilt * tilt - beside * beside).sqrt()
            );
        }
        for options in ways() {
            let exact = posted(&machine, &text, &options);
            assert_eq!(exact.pole_deviation_rad, 0.0);
            let proof = verify(&machine, &exact, &options);
            assert!(proof.is_within(&options), "{beside} {proof:?}");
            let wide = PostOptions { pole_rad: 0.005, ..options.clone() };
            let through = posted(&machine, &text, &wide);
            let proof = verify(&machine, &through, &wide);
            assert!(proof.is_within(&wide), "{beside} {proof:?}");
            let deviates = through.pole_deviation_rad;
            assert!(
                (1e-7..0.005).contains(&deviates) == (2..=4).contains(&k),
                "{beside} {deviates}"
            );
            assert!(through.blocks <= exact.blocks);
        }
    }
}

/// With inverse time, and with feed per minute without tool-centre point, the tip takes the time
/// that the file asks for, or that the slowest axis needs.
#[test]
fn law_feeds_keep_the_time_of_the_tip() {
    let machine = machine("i5-engraver");
    let text = free_form(&machine, 11, 30);
    for (rule, words) in [
        (FeedRule::InverseTime, None),
        (FeedRule::InverseTime, Some(TipWords::Angles)),
        (FeedRule::Tip, None),
    ] {
        let options =
            PostOptions { feed: rule, tip_words: words, ..PostOptions::of(Control::Sinumerik840d) };
        let posted = posted(&machine, &text, &options);
        let control = TipControl::of(&machine).unwrap();
        let all = cuts(&posted, options.control);
        let place = |m: &Move| Vec3::new(m.target.0[0], m.target.0[1], m.target.0[2]);
        let command = |m: &Move| {
            let mut command = Command::default();
            for (q, axis) in command.iter_mut().zip([Axis::C, Axis::A, Axis::X, Axis::Y, Axis::Z]) {
                let value = m.target[axis];
                *q = if axis.is_rotary() { value.to_radians() } else { value };
            }
            if words.is_some() {
                assert!(control.place(place(m), &mut command));
            }
            command
        };
        for pair in all.windows(2) {
            let (a, b) = (command(&pair[0]), command(&pair[1]));
            let tip = (control.tip_and_axis(&b).0 - control.tip_and_axis(&a).0).norm();
            let ways = machine.axes().iter().zip(a.iter().zip(&b));
            let least =
                ways.map(|(axis, (a, b))| (b - a).abs() / axis.limits.velocity.unwrap() / 60.0);
            let wanted = least.fold(tip / 1200.0, f64::max);
            let minutes = match pair[1].feed {
                Feed { mode: FeedMode::InverseTime, value } => 1.0 / value,
                Feed { value, .. } => (place(&pair[1]) - place(&pair[0])).norm() / value,
            };
            assert!((minutes - wanted).abs() <= 2e-3 * wanted + 1e-6, "{minutes} {wanted}");
        }
    }
}

#[test]
fn what_cannot_be_posted_is_told_with_its_line() {
    let reported = |machine: &Machine, text: &str, options: &PostOptions| {
        let (posted, problems) = post(machine, &cl(text), options);
        assert!(posted.is_none());
        let found = problems.iter().filter(|p| p.code != "no-tool");
        found.map(|p| (p.place.line, p.code)).collect::<Vec<_>>()
    };
    let engraver = machine("i5-engraver");
    let options = PostOptions::of(Control::Fanuc);
    let far = "UNITS/MM\nFEDRAT/9\nGOTO/0,0,0\nGOTO/500,0,0\n";
    assert_eq!(reported(&engraver, far, &options), [(4, "leaves-travel")]);
    assert_eq!(reported(&engraver, "UNITS/MM\nGOTO/0,0,0\n", &options), [(2, "no-feed")]);
    let below = "UNITS/MM\nFEDRAT/9\nGOTO/0,0,0,0,0,-1\n";
    assert_eq!(reported(&engraver, below, &options), [(3, "leaves-travel")]);
    let mill = machine("three-axis-mill");
    let tilted = "UNITS/MM\nFEDRAT/9\nGOTO/0,0,0\nGOTO/0,0,1,0.6,0,0.8\n";
    assert_eq!(reported(&mill, tilted, &options), [(4, "unreachable")]);
    let inverse =
        PostOptions { feed: FeedRule::InverseTime, ..PostOptions::of(Control::Heidenhain) };
    let two = "UNITS/MM\nFEDRAT/9\nGOTO/0,0,0\nGOTO/1,0,0\n";
    assert_eq!(reported(&mill, two, &inverse), [(3, "unwritable-block")]);
}

/// LinuxCNC's own inverse of tilting rotary tables, with offsets between the axes and tool length,
/// both senses of turning: the linear axes agree to 1e-9 mm.
#[test]
fn oracle_linuxcnc_inverse_of_tilting_tables() {
    let data = include_str!("data/linuxcnc-trt.csv");
    let (mut worst, mut count) = (0.0_f64, 0);
    for line in data.lines().filter(|l| l.starts_with("XYZ")) {
        let (kind, rest) = line.split_once(',').unwrap();
        let v: Vec<f64> = rest.split(',').map(|n| n.parse().unwrap()).collect();
        let tilting = kind.chars().nth(3).unwrap();
        let ([rx, ry, rz], [dx, dy, dz], tool) = ([v[0], v[1], v[2]], [v[3], v[4], v[5]], v[6]);
        // LinuxCNC's usual directions turn the table the positive way; ISO 841 the other.
        let sense = if v[7] == 0.0 { 1 } else { -1 };
        let text = format!(
            "[machine]\nname = \"trt\"\nchain = \"w C' {tilting}' b X Y Z t\"\n\
             [axis.{tilting}]\nsense = {sense}\nplacement = \"{} {} {} mm\"\n\
             [axis.C]\nsense = {sense}\nplacement = \"{} {} {} mm\"\n\
             [workpiece]\nplacement = \"{} {} {} mm\"\n[tool]\nlength = \"{tool} mm\"",
            rx + dx,
            ry + dy,
            rz + dz,
            -dx,
            -dy,
            -dz,
            -rx,
            -ry,
            -rz,
        );
        let machine = Machine::check("trt.toml", &text, &NoTables).0.unwrap();
        let control = TipControl::of(&machine).unwrap();
        // The chain has C, the tilting axis, X, Y, Z in this order.
        let mut command = [v[12].to_radians(), v[11].to_radians(), 0.0, 0.0, 0.0, 0.0];
        // LinuxCNC's position has the tool offset in Z: the tip lies below it.
        assert!(control.place(Vec3::new(v[8], v[9], v[10] - tool), &mut command));
        for (q, joint) in command[2..5].iter().zip(&v[13..]) {
            worst = worst.max((q - joint).abs());
        }
        count += 1;
    }
    println!("{count} positions, worst {worst:.2e} mm");
    assert!(count == 400 && worst < 1e-9, "{worst}");
}

/// Tools one after the other, each with its own place and tool axis: the way to a tool's first place
/// is no way of the file, and is not judged as one.
#[test]
fn law_tool_changes_are_not_on_the_path() {
    for name in MACHINES {
        let machine = machine(name);
        let one = free_form(&machine, 5, 12);
        let points = |text: &str| {
            let lines: Vec<_> = text.lines().filter(|l| l.starts_with("GOTO")).collect();
            lines.join("\n")
        };
        let other = points(&free_form(&machine, 6, 12));
        let text = format!(
            "UNITS/MM\nMULTAX/ON\nLOADTL/1\nFEDRAT/900\n{}\nLOADTL/2\n{other}\nLOADTL/3\nRAPID\n{}\n",
            points(&one),
            points(&one)
        );
        for options in ways() {
            let posted = posted(&machine, &text, &options);
            let proof = verify(&machine, &posted, &options);
            assert!(proof.is_within(&options), "{name} {:?} {proof:?}", options.control);
            assert_eq!(proof.compared, posted.blocks);
        }
    }
}

/// A path that crosses itself with other tool axes, and one whose tip hardly moves while the tool
/// turns: every place is compared with the tool axis that belongs there.
#[test]
fn law_the_tool_axis_is_compared_along_the_path() {
    let machine = machine("i5-engraver");
    let mut text = "UNITS/MM\nMULTAX/ON\nFEDRAT/900\n".to_owned();
    for k in 0..=120 {
        let u = TAU * f64::from(k) / 120.0;
        let (tilt, turn) = (0.5 + 0.2 * u.sin(), u);
        let (s, c) = tilt.sin_cos();
        let axis = Vec3::new(s * turn.cos(), s * turn.sin(), c);
        let tip = [10.0 * u.sin(), 5.0 * (2.0 * u).sin(), 2.0];
        let [x, y, z] = tip;
        let _ = writeln!(text, "GOTO/{x},{y},{z},{},{},{}", axis.x, axis.y, axis.z);
    }
    for (k, way) in [0.0, 0.004, 0.03, 0.2].into_iter().enumerate() {
        let tilt = 0.2 + 0.4 * f64::from(k as u32 % 2);
        let _ = writeln!(text, "GOTO/{way},0,2,0,{},{}", -tilt.sin(), tilt.cos());
        let _ = writeln!(text, "GOTO/0,{way},2,{},0,{}", tilt.sin(), tilt.cos());
    }
    for options in ways() {
        let posted = posted(&machine, &text, &options);
        let proof = verify(&machine, &posted, &options);
        assert!(
            proof.is_within(&options),
            "{:?} {:?} {proof:?}",
            options.control,
            options.tip_words
        );
        assert_eq!(proof.compared, posted.blocks);
    }
}

/// Holes on two levels, as a CAM system writes them; the tool axis is (x, 0, z).
fn holes([x, z]: [f64; 2]) -> String {
    let mut text = "UNITS/MM\nMULTAX/ON\nFEDRAT/900\nRAPID\n".to_owned();
    let goto = |u: f64, v: f64, height: f64| {
        let (a, b) = (u * z + height * x, -u * x + height * z);
        format!("GOTO/{a:.9},{v},{b:.9},{x},0,{z}\n")
    };
    text += &goto(0.0, 0.0, 80.0);
    text += "CYCLE/DRILL,FEDTO,5,MMPM,300,RAPTO,3,RTRCTO,25\n";
    text += &(goto(10.0, 0.0, 0.0) + &goto(20.0, 5.0, 0.0) + &goto(30.0, 5.0, 12.0));
    text += &(goto(20.0, -5.0, 0.0) + "CYCLE/OFF\n");
    text += "CYCLE/DEEP2,FEDTO,9,1STPECK,5,SUBPECK,2,MMPM,200,RAPTO,3,RTRCTO,25,DWELL,0.5\n";
    text + &goto(10.0, -5.0, 0.0) + "CYCLE/OFF\n"
}

/// (beside, across, height) of the tips of those holes, in order.
const HOLES: [[f64; 3]; 28] = [
    [0.0, 0.0, 80.0],
    [10.0, 0.0, 80.0],
    [10.0, 0.0, 3.0],
    [10.0, 0.0, -5.0],
    [10.0, 0.0, 25.0],
    [20.0, 5.0, 25.0],
    [20.0, 5.0, 3.0],
    [20.0, 5.0, -5.0],
    [20.0, 5.0, 25.0],
    // Up to 25 above the higher level before it crosses.
    [20.0, 5.0, 37.0],
    [30.0, 5.0, 37.0],
    [30.0, 5.0, 15.0],
    [30.0, 5.0, 7.0],
    [30.0, 5.0, 37.0],
    [20.0, -5.0, 37.0],
    [20.0, -5.0, 3.0],
    [20.0, -5.0, -5.0],
    [20.0, -5.0, 25.0],
    [10.0, -5.0, 25.0],
    [10.0, -5.0, 3.0],
    // Pecks.
    [10.0, -5.0, -5.0],
    [10.0, -5.0, 3.0],
    [10.0, -5.0, -4.5],
    [10.0, -5.0, -7.0],
    [10.0, -5.0, 3.0],
    [10.0, -5.0, -6.5],
    [10.0, -5.0, -9.0],
    [10.0, -5.0, 25.0],
];

/// Between holes the tool is at the retract height of the higher one, drills from the clearance, and
/// leaves the hole after every peck.
#[test]
fn holes_are_crossed_at_the_retract_height() {
    for (name, tilt) in [("xkas2525", [0.0, 1.0]), ("xkas2525", [0.6, 0.8])] {
        let machine = machine(name);
        for options in ways() {
            // As lines, so that every stop is ours; cycles of the controls are in `post_shapes.rs`.
            let options = PostOptions { lines_only: true, ..options };
            let posted = posted(&machine, &holes(tilt), &options);
            let proof = verify(&machine, &posted, &options);
            assert!(proof.is_within(&options), "{name} {:?} {proof:?}", options.control);
            let places = reached(&machine, &posted, options.control);
            let [x, z] = tilt;
            let wanted = HOLES.map(|[u, v, h]| Vec3::new(u * z + h * x, v, h * z - u * x));
            let near = |p: &Vec3, q: &Vec3| (p - q).norm() < 1e-3;
            let begin = places.iter().position(|p| near(p, &wanted[0])).unwrap();
            // A dwell is at the place before it.
            let mut places = places[begin..].to_vec();
            places.dedup_by(|p, q| near(p, q));
            for (p, q) in places.iter().zip(&wanted) {
                assert!(near(p, q), "{:?} {p:?}, not {q:?}", options.control);
            }
            assert!(places.len() > wanted.len());
        }
    }
}

/// The ends of all blocks of a program, by the simulation.
fn reached(machine: &Machine, posted: &Posted, control: Control) -> Vec<Vec3> {
    struct Ends(Vec<Vec3>);
    impl Observer for Ends {
        fn path(&mut self, batch: &Batch<'_>) {
            for (i, _) in batch.nodes.iter().enumerate().filter(|(_, node)| node.last) {
                self.0.push(batch.poses.at(i).nominal_tip.vector());
            }
        }
    }
    let program = Program::new("p", posted.text.clone(), control);
    let mut ends = Ends(Vec::new());
    simulate(machine, &program, &SetUp::default(), &Options::default(), &mut [&mut ends]);
    ends.0
}

/// The same holes on a mill without tool-centre point, through LinuxCNC's own interpreter
/// (`oracles/linuxcnc_holes.py`): it goes where we go, and where the cycles say.
#[test]
fn oracle_holes_through_linuxcnc() {
    let data = include_str!("data/linuxcnc-holes.txt");
    let (program, points) = data.strip_prefix("program\n").unwrap().split_once("points\n").unwrap();
    let machine = machine("three-axis-mill");
    let (tip_words, name) = (None, "holes".to_owned());
    let options = PostOptions { tip_words, name, ..PostOptions::of(Control::LinuxCnc) };
    let posted = posted(&machine, include_str!("data/holes.apt"), &options);
    assert_eq!(String::from_utf8_lossy(&posted.text), program);
    assert!(verify(&machine, &posted, &options).is_within(&options));
    let of = |line: &str| -> Vec3 {
        let all: Vec<f64> = line.split(' ').map(|w| w.parse().unwrap()).collect();
        // From axes to the tip: the spindle at 600, the tool of 120, the workpiece at 100.
        Vec3::new(all[0], all[1], all[2] + 380.0)
    };
    let theirs: Vec<Vec3> = points.lines().map(of).collect();
    let begin = theirs.iter().position(|p| (p.z - 80.0).abs() < 1e-9).unwrap();
    for ([x, y, z], point) in HOLES.iter().zip(&theirs[begin..]) {
        assert!((point - Vec3::new(*x, *y, *z)).norm() < 1e-4, "{point:?}");
    }
}
