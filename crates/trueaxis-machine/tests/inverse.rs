//! From the wanted tool back to the axis positions.

mod library;

use library::{Random, command_within_travel, golden, machine, machine_of};
use proptest::prelude::*;
use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::sync::LazyLock;
use trueaxis_geometry::Vec3;
use trueaxis_geometry::frame::{Direction, Point};
use trueaxis_machine::axis::{AxisKind, Command};
use trueaxis_machine::errors::ErrorValues;
use trueaxis_machine::file::NoTables;
use trueaxis_machine::{FollowFault, Machine, Solution, SolveError, Target};

/// Where the nominal tool is.
fn tool_at(machine: &Machine, command: &Command) -> Target {
    let pose = machine.pose(command, &ErrorValues::default());
    Target { tip: pose * Point::from_vector(machine.tip_mm()), axis: pose * Direction::Z }
}

fn target(tip: [f64; 3], axis: [f64; 3]) -> Target {
    let axis = Direction::of(Vec3::from(axis)).expect("a direction");
    Target { tip: Point::from_vector(Vec3::from(tip)), axis }
}

fn from_text(text: &str) -> Machine {
    let (machine, problems) = Machine::check("machine.toml", text, &NoTables);
    machine.unwrap_or_else(|| panic!("{problems:?}\n{text}"))
}

fn rotary(machine: &Machine) -> Vec<usize> {
    let axes = machine.axes();
    (0..axes.len()).filter(|&i| axes[i].kind == AxisKind::Rotary).collect()
}

/// A command by the letters of its axes, in mm and deg.
fn at(machine: &Machine, words: &[(char, f64)]) -> Command {
    let mut command = Command::default();
    for &(letter, value) in words {
        let i = machine.axes().iter().position(|a| a.name.letter() == letter).expect("an axis");
        let turns = machine.axes()[i].kind == AxisKind::Rotary;
        command[i] = if turns { value.to_radians() } else { value };
    }
    command
}

/// The angles of every solution in deg, in the order found.
fn angles(machine: &Machine, target: &Target, from: &Command) -> Vec<Vec<f64>> {
    let found = machine.solve(target, from).expect("reachable");
    let degrees = |c: &Command| rotary(machine).iter().map(|&i| c[i].to_degrees()).collect();
    found.solutions.iter().map(|s| degrees(&s.command)).collect()
}

fn close(found: &[Vec<f64>], wanted: &[&[f64]]) {
    let near = |a: &Vec<f64>, b: &&[f64]| a.iter().zip(*b).all(|(a, b)| (a - b).abs() < 1e-9);
    let same = found.len() == wanted.len() && found.iter().zip(wanted).all(|(a, b)| near(a, b));
    assert!(same, "found {found:?}\nwanted {wanted:?}");
}

/// The commanded position is found again to this.
const SAME_RAD: f64 = 1e-11;
const SAME_MM: f64 = 1e-7;

/// The worst of what a law is judged by.
#[derive(Default, Debug)]
struct Worst {
    tip_mm: f64,
    axis: f64,
    /// How far the commanded angles are from the nearest solution, where they are determined.
    angle_rad: f64,
    /// The same for the linear axes.
    linear_mm: f64,
}

impl Worst {
    /// Solves for the tool of a command and compares both ways.
    fn judge(&mut self, machine: &Machine, command: &Command) {
        let wanted = tool_at(machine, command);
        let found = match machine.solve(&wanted, command) {
            Ok(found) => found,
            // Two linear axes forgive no noise of an angle that the tool axis does not determine.
            Err(SolveError::TipUnreachable { .. }) if determined(machine, command) < 1e-2 => return,
            Err(error) => panic!("{} at {command:?}: {error}", machine.chain_text()),
        };
        // No machine is 100 m long; a double ends at 1e-11 mm there.
        let is_real = |s: &&Solution| s.command.iter().all(|q| q.abs() < 1e5);
        for solution in found.solutions.iter().filter(is_real) {
            let reached = tool_at(machine, &solution.command);
            self.tip_mm = self.tip_mm.max((reached.tip - wanted.tip).amax());
            let axis = reached.axis.vector() - wanted.axis.vector();
            self.axis = self.axis.max(axis.amax());
        }
        let off = |c: &Command, kind: AxisKind| {
            let axes = machine.axes().iter().enumerate().filter(|(_, a)| a.kind == kind);
            let differ = axes.map(|(i, _)| match kind {
                AxisKind::Linear => (c[i] - command[i]).abs(),
                AxisKind::Rotary => ((c[i] - command[i] + PI).rem_euclid(TAU) - PI).abs(),
            });
            differ.fold(0.0, f64::max)
        };
        let nearest = found
            .solutions
            .iter()
            .map(|s| (off(&s.command, AxisKind::Rotary), off(&s.command, AxisKind::Linear)))
            .min_by(|a, b| a.0.total_cmp(&b.0))
            .expect("never empty");
        // IK(FK(q)) contains q, at least where the tool axis determines the angles.
        let same = nearest.0 < SAME_RAD && nearest.1 < SAME_MM;
        if same || determined(machine, command) > 1e-2 {
            self.angle_rad = self.angle_rad.max(nearest.0);
            self.linear_mm = self.linear_mm.max(nearest.1);
        }
    }

    fn holds(&self) -> bool {
        let same = self.angle_rad < SAME_RAD && self.linear_mm < SAME_MM;
        self.tip_mm < 1e-9 && self.axis < 1e-12 && same
    }
}

/// The area that the two first rotary axes span on the sphere of directions; 1 is best.
fn determined(machine: &Machine, command: &Command) -> f64 {
    let axis = |command: &Command| {
        let pose = machine.pose(command, &ErrorValues::default());
        (pose * Direction::Z).vector()
    };
    let zero = axis(command);
    let step = 1e-6;
    let moved = |&i: &usize| {
        let mut command = *command;
        command[i] += step;
        (axis(&command) - zero) / step
    };
    match rotary(machine).iter().map(moved).collect::<Vec<_>>()[..] {
        [] => 1.0,
        [one] => one.norm(),
        [first, second, ..] => first.cross(&second).norm(),
    }
}

/// 10^5 poses within the travel; every fifth lies close to a pole or to the end of the reach.
fn over_random_poses(name: &str) {
    let machine = machine(name);
    let (mut random, mut worst) = (Random(2026), Worst::default());
    for i in 0..100_000 {
        let mut command = command_within_travel(&machine, [(); 6].map(|_| random.unit()));
        if i % 5 == 0 {
            let near = [0.0, PI, -PI, FRAC_PI_2, -FRAC_PI_2][i / 5 % 5];
            let off = 10_f64.powf(-14.0 * random.unit()) * (random.unit() - 0.5).signum();
            for &axis in rotary(&machine).last().iter().copied() {
                if machine.axes()[axis].travel.contains(near + off) {
                    command[axis] = near + off;
                }
            }
        }
        worst.judge(&machine, &command);
    }
    assert!(worst.holds(), "{name}: {worst:?}");
}

#[test]
fn law_there_and_back_on_every_machine() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../machines");
    let entries = std::fs::read_dir(folder).expect("the shipped machines");
    let names = entries.map(|e| e.expect("a folder").file_name().into_string().expect("a name"));
    std::thread::scope(|scope| {
        let runs: Vec<_> = names.map(|n| scope.spawn(move || over_random_poses(&n))).collect();
        assert!(runs.len() >= 7);
    });
}

/// A chain of any order with tilted placements and axes in any direction.
fn any_machine() -> impl Strategy<Value = Machine> {
    let letters = Just("XYZUVWABC".chars().collect::<Vec<_>>()).prop_shuffle();
    let vector = || prop::array::uniform3(-1.0..1.0_f64);
    let bodies = prop::collection::vec((vector(), vector(), any::<bool>()), 8);
    (letters, 3..=6_usize, 0..=6_usize, bodies).prop_map(|(letters, count, bed, bodies)| {
        let axes = &letters[..count];
        let bed = bed.min(count);
        let word = |(i, c): (usize, &char)| if i < bed { format!("{c}'") } else { c.to_string() };
        let words: Vec<String> = axes.iter().enumerate().map(word).collect();
        let chain = format!("w {} b {} t", words[..bed].join(" "), words[bed..].join(" "));
        let place = |i: usize| {
            let ([x, y, z], [a, b, c], _) = bodies[i];
            let [x, y, z] = [x, y, z].map(|v: f64| v * 500.0);
            let [a, b, c] = [a, b, c].map(|v: f64| v * 180.0);
            format!(
                "placement = [\"shift {x} {y} {z} mm\", \"turn X {a} deg\", \"turn Y {b} deg\", \
                 \"turn Z {c} deg\"]\n"
            )
        };
        let mut text = format!("[machine]\nname = \"any\"\nchain = \"{chain}\"\n");
        for (i, axis) in axes.iter().enumerate() {
            let ([height, around, _], [sense, ..], nutating) = bodies[i];
            text += &format!("[axis.{axis}]\n");
            if nutating {
                text += &place(i);
                let (j, i) = (around * PI).sin_cos();
                text += &format!("direction = \"{i} {j} {}\"\n", 2.0 * height);
                text += if sense < 0.0 { "sense = -1\n" } else { "sense = 1\n" };
            }
        }
        let tool = place(7);
        text += &format!("[workpiece]\n{}[tool]\n{tool}length = \"120 mm\"\n", place(6));
        from_text(&text)
    })
}

/// Whether linear axes nearly coincide: their commands would be kilometres. No machine is built so.
fn close_to_parallel(machine: &Machine, command: &Command) -> bool {
    let mut basis: Vec<Vec3> = Vec::new();
    let axes = machine.axes().iter().enumerate();
    for (i, _) in axes.filter(|(_, axis)| axis.kind == AxisKind::Linear) {
        let mut moved = *command;
        moved[i] += 100.0;
        let step = (tool_at(machine, &moved).tip - tool_at(machine, command).tip) / 100.0;
        let across = basis.iter().fold(step, |s, b| s - *b * b.dot(&s));
        if across.norm() > 1e-9 && across.norm() < 0.05 {
            return true;
        }
        if across.norm() >= 0.05 {
            basis.push(across.normalize());
        }
    }
    false
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]
    #[test]
    fn law_there_and_back_on_any_machine(
        machine in any_machine(),
        poses in prop::collection::vec(prop::array::uniform6(0.0..1.0_f64), 5),
    ) {
        for unit in poses {
            let command = command_within_travel(&machine, unit);
            if close_to_parallel(&machine, &command) {
                continue;
            }
            let mut worst = Worst::default();
            worst.judge(&machine, &command);
            prop_assert!(worst.holds(), "{} {command:?}: {worst:?}", machine.chain_text());
        }
    }

    #[test]
    fn law_there_and_back_close_to_every_pole(
        tilt in 0.0..16.0_f64, azimuth in -PI..PI, which in 0..4_usize,
    ) {
        static MACHINES: LazyLock<Vec<Machine>> =
            LazyLock::new(|| library::FIVE_AXIS.map(machine).to_vec());
        for machine in MACHINES.iter() {
            let mut command = Command::default();
            let pair = rotary(machine);
            command[pair[0]] = azimuth;
            let off = 10_f64.powf(-tilt);
            command[pair[1]] = [off, -off, PI - off, off - PI][which];
            let mut worst = Worst::default();
            worst.judge(machine, &command);
            prop_assert!(worst.holds(), "{} {command:?}: {worst:?}", machine.name());
        }
    }
}

#[test]
fn oracle_all_branches() {
    for name in library::FIVE_AXIS {
        let machine = machine(name);
        let (heads, rows) = golden(&format!("solve/{name}.csv"));
        let (mut worst_deg, mut worst_mm) = (0.0_f64, 0.0_f64);
        let mut cases = 0;
        for case in rows.chunk_by(|a, b| a[0] == b[0]) {
            cases += 1;
            let v = |i: usize| [case[0][i], case[0][i + 1], case[0][i + 2]];
            let found = machine.solve(&target(v(1), v(4)), &[0.0; 6]).expect("reachable").solutions;
            let main = found.iter().filter(|s| {
                rotary(&machine).iter().all(|&i| s.command[i] > -PI && s.command[i] <= PI)
            });
            assert_eq!(main.clone().count(), case.len(), "{name}, case {}", case[0][0]);
            for row in case {
                let wanted = library::command(&machine, &heads, row);
                let off = |command: &Command, kind: AxisKind| {
                    let axes = machine.axes().iter().enumerate().filter(|(_, a)| a.kind == kind);
                    let differ = axes.map(|(i, _)| (command[i] - wanted[i]).abs());
                    let around = |d: f64| if kind == AxisKind::Rotary { d.min(TAU - d) } else { d };
                    differ.map(around).fold(0.0, f64::max)
                };
                let nearest = main
                    .clone()
                    .map(|s| (off(&s.command, AxisKind::Rotary), off(&s.command, AxisKind::Linear)))
                    .min_by(|a, b| a.0.total_cmp(&b.0))
                    .expect("a solution");
                worst_deg = worst_deg.max(nearest.0.to_degrees());
                worst_mm = worst_mm.max(nearest.1);
            }
        }
        let good = cases >= 30 && worst_deg < 1e-10 && worst_mm < 1e-9;
        assert!(good, "{name}: {worst_deg:e} deg, {worst_mm:e} mm");
    }
}

/// The flank-milling path of Wu et al. 2022: tool axis along the generatrix, tip at the base circle.
fn frustum() -> Vec<Target> {
    let (sin, cos) = 15_f64.to_radians().sin_cos();
    (0..72)
        .map(|i| f64::from(i * 5).to_radians())
        .map(|phi| {
            let radius = 125.0 + 10.0 * cos;
            let tip = [radius * phi.cos(), radius * phi.sin(), -60.0 + 10.0 * sin];
            target(tip, [-sin * phi.cos(), -sin * phi.sin(), cos])
        })
        .collect()
}

#[test]
fn oracle_frustum_of_document_000() {
    let machine = machine("xkas2525");
    let commands = machine.follow(&frustum(), &[0.0; 6]).expect("a way");
    let (heads, rows) = golden("../../../trueaxis/tests/data/nas979-xkas2525.csv");
    let wanted: Vec<_> = rows.iter().map(|row| library::command(&machine, &heads, row)).collect();
    assert_eq!(commands.len(), wanted.len());
    let worst = commands.iter().zip(&wanted).fold([0.0_f64; 2], |worst, (ours, theirs)| {
        let off = |i: usize| (ours[i] - theirs[i]).abs();
        [worst[0].max(off(0)).max(off(1)).max(off(2)), worst[1].max(off(3)).max(off(4))]
    });
    assert!(worst[0] < 1e-9 && worst[1].to_degrees() < 1e-11, "{worst:?}");
}

#[test]
fn best_solution_first() {
    let machine = machine("xkas2525");
    // The tool leans by 30 deg towards −y of the machine: C = 0, A = 30 or C = ±180, A = −30.
    let start = at(&machine, &[('X', 3100.0), ('Y', 1250.0), ('Z', -500.0), ('A', 30.0)]);
    let wanted = tool_at(&machine, &start);
    let all: [&[f64]; 5] =
        [&[0.0, 30.0], &[-180.0, -30.0], &[180.0, -30.0], &[-360.0, 30.0], &[360.0, 30.0]];
    close(&angles(&machine, &wanted, &[0.0; 6]), &all);
    let from = at(&machine, &[('C', 200.0), ('A', -20.0)]);
    let all: [&[f64]; 5] =
        [&[180.0, -30.0], &[360.0, 30.0], &[0.0, 30.0], &[-180.0, -30.0], &[-360.0, 30.0]];
    close(&angles(&machine, &wanted, &from), &all);
    // Equal ways from between them: a second angle that is not negative.
    let from = at(&machine, &[('C', 90.0)]);
    close(&angles(&machine, &wanted, &from)[..2], &[&[0.0, 30.0], &[180.0, -30.0]]);
}

#[test]
fn entries_outside_the_travel_stand_last() {
    let short =
        |text: String| text.replace("\"-105 deg\", \"105 deg\"", "\"-20 deg\", \"105 deg\"");
    let machine = machine_of("xkas2525", short);
    let start =
        at(&machine, &[('X', 3100.0), ('Y', 1250.0), ('Z', -500.0), ('C', 10.0), ('A', 30.0)]);
    let from = at(&machine, &[('C', -170.0), ('A', -30.0)]);
    let found = machine.solve(&tool_at(&machine, &start), &from).expect("reachable");
    let marks: Vec<bool> = found.solutions.iter().map(|s| s.within_travel).collect();
    assert_eq!(marks, [true, true, false]);
    let last = found.solutions[2];
    assert!((last.command[4].to_degrees() + 30.0).abs() < 1e-9);
    assert!(last.rotary_travel_rad < 1e-9, "nearest, but out of the travel");
    assert!(found.singular.is_none());
}

#[test]
fn endless_axis_offers_the_nearest_turn() {
    let machine = machine("i5-engraver");
    let wanted = target([0.0; 3], [0.3, -0.2, 0.93]);
    let from = at(&machine, &[('C', 730.0), ('A', 20.0)]);
    let c = 56.30993247402021;
    let a = 21.190997441077872;
    let all: [&[f64]; 4] = [&[c + 720.0, a], &[c + 540.0, -a], &[c, a], &[c - 180.0, -a]];
    close(&angles(&machine, &wanted, &from), &all);
}

#[test]
fn pole_keeps_the_last_angle() {
    let machine = machine("lei-hsu-mill");
    for (k, a) in [(1.0, 0.0), (-1.0, 180.0)] {
        for c in [0.0, 77.0, -300.0] {
            let from = at(&machine, &[('C', c), ('A', 10.0)]);
            let wanted = target([10.0, 20.0, 30.0], [0.0, 0.0, k]);
            let found = machine.solve(&wanted, &from).expect("reachable");
            close(&angles(&machine, &wanted, &from), &[&[c, a]]);
            let singular = found.singular.expect("singular");
            assert_eq!(singular.to_string(), "C turns about the tool axis; its angle is kept");
            let reached = tool_at(&machine, &found.solutions[0].command);
            assert!((reached.tip - wanted.tip).amax() < 1e-9);
        }
    }
    // Less than a double can tell of a direction keeps it too; a ten-millionth of a radian not.
    let from = at(&machine, &[('C', 77.0)]);
    let noise = target([0.0; 3], [3e-16, 0.0, 1.0]);
    assert!(machine.solve(&noise, &from).expect("reachable").singular.is_some());
    let near = target([0.0; 3], [1e-7, 0.0, 1.0]);
    let found = machine.solve(&near, &from).expect("reachable");
    assert!(found.singular.is_none());
    close(
        &angles(&machine, &near, &from),
        &[&[90.0, 1e-7_f64.to_degrees()], &[-90.0, -1e-7_f64.to_degrees()]],
    );
}

#[test]
fn reach_of_a_nutating_head_ends_at_the_horizontal() {
    let machine = machine("nutating-head");
    let limit = target([0.0; 3], [1.0, 0.0, 0.0]);
    let found = machine.solve(&limit, &[0.0; 6]).expect("just reachable");
    assert_eq!(found.solutions.len(), 1, "the branches meet");
    assert!((found.solutions[0].command[4] - PI).abs() < 1e-12);
    let reached = tool_at(&machine, &found.solutions[0].command);
    assert!((reached.axis.vector() - Vec3::x()).amax() < 1e-14);

    let below = target([0.0; 3], [1.0, 0.0, -(10_f64.to_radians().tan())]);
    let error = machine.solve(&below, &[0.0; 6]).expect_err("10 deg too low");
    assert!(error.to_string().contains("turned only by C and B"), "{error}");
    let SolveError::Unreachable { closest, missed_by_rad, .. } = error else { panic!("{error}") };
    assert!((missed_by_rad.to_degrees() - 10.0).abs() < 1e-12);
    assert!((closest.vector() - Vec3::x()).amax() < 1e-15);
}

#[test]
fn fewer_than_two_rotary_axes() {
    let machine = machine("three-axis-mill");
    let up = target([1.0, 2.0, 3.0], [0.0, 0.0, 2.0]);
    let found = machine.solve(&up, &[0.0; 6]).expect("reachable");
    assert_eq!(found.solutions.len(), 1);
    let tilted = target([1.0, 2.0, 3.0], [0.0, 1.0, 1.0]);
    let error = machine.solve(&tilted, &[0.0; 6]).expect_err("45 deg off");
    let text = error.to_string();
    assert!(text.contains("45.000000 deg") && text.contains("no rotary axis"), "{text}");
    // With one rotary axis: the directions on its circle.
    let machine = from_text("[machine]\nname = \"four axes\"\nchain = \"w A' b X Y Z t\"");
    let wanted = target([0.0; 3], [0.0, -1.0, 1.0]);
    close(&angles(&machine, &wanted, &[0.0; 6]), &[&[45.0]]);
    let aside = target([0.0; 3], [0.5, 0.0, 0.75_f64.sqrt()]);
    let error = machine.solve(&aside, &[0.0; 6]).expect_err("30 deg off its circle");
    assert!(error.to_string().contains("30.000000 deg"), "{error}");
}

#[test]
fn redundant_axes_stay_where_they_were() {
    let machine = from_text("[machine]\nname = \"six\"\nchain = \"w C' b W X Y Z B t\"");
    let from = at(&machine, &[('W', 40.0)]);
    let found = machine.solve(&target([1.0, 2.0, 3.0], [1.0, 0.0, 1.0]), &from).expect("reachable");
    for solution in found.solutions {
        assert_eq!(solution.command[1], 40.0);
        assert!((solution.command[4] + 37.0).abs() < 1e-12, "Z makes up for W");
    }
    // Three rotary axes: the first two that can aim do; C and then C again would not.
    let text = "[machine]\nname = \"parallel\"\nchain = \"w C' b X Y Z B A t\"\n\
                [axis.B]\ndirection = \"0 0 1\"";
    let machine = from_text(text);
    let from = at(&machine, &[('B', 25.0)]);
    let found = machine.solve(&target([0.0; 3], [0.0, -1.0, 1.0]), &from).expect("reachable");
    for solution in found.solutions {
        assert!((solution.command[4].to_degrees() - 25.0).abs() < 1e-12);
        assert!((solution.command[5].to_degrees().abs() - 45.0).abs() < 1e-12);
    }
}

#[test]
fn parallel_rotary_axes_reach_one_cone() {
    let text = "[machine]\nname = \"parallel\"\nchain = \"w C' b X Y Z B t\"\n\
                [axis.B]\ndirection = \"0 0 1\"\n[tool]\nplacement = \"turn X 30 deg\"";
    let machine = from_text(text);
    let from = at(&machine, &[('B', 15.0)]);
    let found = machine.solve(&target([0.0; 3], [0.5, 0.0, 0.75_f64.sqrt()]), &from);
    assert_eq!(found.expect("on the cone").solutions.len(), 1);
    let error = machine.solve(&target([0.0; 3], [0.0, 0.0, 1.0]), &from).expect_err("off the cone");
    assert!(error.to_string().contains("30.000000 deg"), "{error}");
    // A second axis along the tool never aims it.
    let text = "[machine]\nname = \"spindle\"\nchain = \"w A' b X Y Z C t\"";
    let machine = from_text(text);
    let from = at(&machine, &[('C', 15.0)]);
    let found = machine.solve(&target([0.0; 3], [0.0, -1.0, 1.0]), &from).expect("reachable");
    assert_eq!(found.singular.expect("C is idle").axis.letter(), 'C');
}

#[test]
fn dependent_linear_axes() {
    let text = "[machine]\nname = \"flat\"\nchain = \"w C' b X Y Z A t\"\n\
                [axis.Z]\ndirection = \"1 1 0\"\n[tool]\nlength = \"0 mm\"";
    let machine = from_text(text);
    let from = at(&machine, &[('Z', 5.0)]);
    let found =
        machine.solve(&target([1.0, 2.0, 0.0], [0.0, 0.0, 1.0]), &from).expect("in its plane");
    assert_eq!(found.solutions[0].command[3], 5.0);
    let error =
        machine.solve(&target([1.0, 2.0, 7.0], [0.0, 0.0, 1.0]), &from).expect_err("off it");
    let SolveError::TipUnreachable { missed_by_mm, .. } = error else { panic!("{error}") };
    assert!((missed_by_mm - 7.0).abs() < 1e-12);
    assert!(error.to_string().contains("X and Y cannot"), "{error}");
}

#[test]
fn no_number_is_refused() {
    let machine = machine("xkas2525");
    let good = target([0.0; 3], [0.0, 0.0, 1.0]);
    for bad in [f64::NAN, f64::INFINITY] {
        let tip = Point::new(bad, 0.0, 0.0);
        let found = machine.solve(&Target { tip, ..good }, &[0.0; 6]);
        assert_eq!(found, Err(SolveError::NotFinite));
    }
    let from = [f64::NAN, 0.0, 0.0, 0.0, 0.0, 0.0];
    assert_eq!(machine.solve(&good, &from), Err(SolveError::NotFinite));
}

#[test]
fn path_through_the_pole_holds_the_idle_axis() {
    let machine = machine("xkas2525");
    // From +10 deg over the pole to −10 deg in one plane, which stands at C = 40 deg.
    let leaning = |a: f64| {
        let words = [('X', 3100.0), ('Y', 1250.0), ('Z', -500.0), ('C', 40.0), ('A', a)];
        tool_at(&machine, &at(&machine, &words))
    };
    let path: Vec<Target> = (-10..=10).map(|a| leaning(f64::from(-a))).collect();
    let commands = machine.follow(&path, &[0.0; 6]).expect("a way");
    for (a, command) in (-10..=10).zip(commands) {
        assert!((command[3].to_degrees() - 40.0).abs() < 1e-9);
        assert!((command[4].to_degrees() + f64::from(a)).abs() < 1e-9);
    }
    // Beginning at the pole, C turns to where it is needed before the tool leans.
    let path: Vec<Target> = (0..=10).map(|a| leaning(f64::from(a))).collect();
    let commands = machine.follow(&path, &[0.0; 6]).expect("a way");
    assert!(commands.iter().all(|c| (c[3].to_degrees() - 40.0).abs() < 1e-9));
    // Nothing but the pole: the angle of the start.
    let from = at(&machine, &[('C', 77.0)]);
    assert_eq!(machine.follow(&path[..1], &from).expect("a way")[0][3], from[3]);
    assert_eq!(machine.follow(&[], &from), Ok(Vec::new()));
}

#[test]
fn endless_axes_unwind_without_end() {
    for name in ["i5-engraver", "lei-hsu-mill"] {
        let machine = machine(name);
        let leaning = |c: f64| target([0.0; 3], [0.3 * c.cos(), 0.3 * c.sin(), 1.0]);
        let path: Vec<_> = (0..=360).map(|i| leaning(f64::from(i * 10).to_radians())).collect();
        let commands = machine.follow(&path, &[0.0; 6]).expect("a way");
        let c = rotary(&machine)[0];
        assert!(((commands[360][c] - commands[0][c]).abs() - 10.0 * TAU).abs() < 1e-9);
        assert!(commands.windows(2).all(|w| (w[1][c] - w[0][c]).abs() < 0.2));
    }
}

#[test]
fn path_that_cannot_be_followed() {
    let machine = machine("xkas2525");
    let once = frustum();
    let fails = |path: &[Target]| machine.follow(path, &[0.0; 6]).expect_err("no way");

    // Three times round does not fit into ±360 deg; twice does not either: −90 + 720 > 360.
    let error = fails(&[once.clone(), once.clone(), once.clone()].concat());
    assert!(
        matches!(error.fault, FollowFault::Jump { axis, .. } if axis.letter() == 'C'),
        "{error}"
    );

    let mut far = once.clone();
    far[7].tip = Point::new(0.0, 5000.0, 0.0);
    let error = fails(&far);
    assert_eq!(error.index, 7);
    let FollowFault::LeavesTravel { axis, beyond, .. } = error.fault else { panic!("{error}") };
    let found = machine.solve(&far[7], &[0.0; 6]).expect("reachable without ends");
    let y = found.solutions[0].command[1];
    assert!(axis.letter() == 'Y' && (beyond - (y - 2500.0)).abs() < 1e-9, "{error}");
    assert!(error.to_string().starts_with("point 7 of the path (counted from 0): Y exceeds"));

    let nutating = library::machine("nutating-head");
    let path = [[0.0, 0.0, 1.0], [0.0, 1.0, -1.0]].map(|axis| target([0.0; 3], axis));
    let error = nutating.follow(&path, &[0.0; 6]).expect_err("too low");
    assert_eq!(error.index, 1);
    assert!(matches!(error.fault, FollowFault::Solve(SolveError::Unreachable { .. })));
}

#[test]
fn travel_decides_the_branch_for_the_whole_path() {
    // With A >= −20 deg only one branch stays; with A <= 20 deg none does.
    let machine_with = |travel: &str| {
        machine_of("xkas2525", |text| text.replace("\"-105 deg\", \"105 deg\"", travel))
    };
    let commands = machine_with("\"-105 deg\", \"20 deg\"").follow(&frustum(), &[0.0; 6]);
    assert!(commands.expect("a way").iter().all(|c| c[4] < 0.0));
    let error = machine_with("\"-20 deg\", \"20 deg\"").follow(&frustum(), &[0.0; 6]);
    let error = error.expect_err("25 deg needed");
    assert_eq!((error.index, error.to_string().contains("A exceeds its travel by")), (21, true));
}
