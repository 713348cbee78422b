//! The inverse of whole columns of targets against the control that does it pose by pose.

mod library;

use library::{FIVE_AXIS, Random, machine};
use trueaxis_geometry::Vec3;
use trueaxis_geometry::frame::{Direction, Workpiece};
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{AxisKind, Command};
use trueaxis_machine::batch::{
    BatchError, CommandTable, CompiledInverse, InstructionSet, InverseError, TargetColumns,
};
use trueaxis_machine::file::NoTables;
use trueaxis_machine::tcp::TipControl;

/// Tips and tool axes along a path: steps, jumps, and places at a pole and close to it.
struct Path {
    tips: Vec<Vec3>,
    axes: Vec<Vec3>,
}

impl Path {
    fn of(machine: &Machine, control: &TipControl, seed: u64, length: usize) -> Self {
        let mut random = Random(seed);
        let (mut tips, mut axes) = (Vec::new(), Vec::new());
        let mut command = random.command(machine);
        for i in 0..length {
            let goal = random.command(machine);
            for (k, q) in command.iter_mut().enumerate() {
                *q = match i % 50 {
                    0 => goal[k],
                    _ => *q + 1e-3 * (goal[k] - *q),
                };
            }
            let (tip, mut axis) = control.tip_and_axis(&command);
            if let Some(pole) = control.pole().filter(|_| i % 50 >= 45) {
                let off = 10_f64.powi(i as i32 % 50 - 59);
                axis = (pole.vector() + axis * if i % 50 == 47 { 0.0 } else { off }).normalize();
            }
            tips.push(tip);
            axes.push(axis);
        }
        Self { tips, axes }
    }

    fn columns(&self) -> [[Vec<f64>; 3]; 2] {
        [&self.tips, &self.axes].map(|all| [0, 1, 2].map(|k| all.iter().map(|v| v[k]).collect()))
    }

    fn direction(&self, i: usize) -> Direction<Workpiece> {
        Direction::of(self.axes[i]).expect("a direction")
    }
}

fn targets([tips, axes]: &[[Vec<f64>; 3]; 2]) -> TargetColumns<'_> {
    TargetColumns {
        tip_mm: tips.each_ref().map(Vec::as_slice),
        axis: axes.each_ref().map(Vec::as_slice),
    }
}

fn pose_by_pose(control: &TipControl, path: &Path, from: &Command) -> Vec<Command> {
    let mut last = *from;
    let each = path.tips.iter().enumerate().map(|(i, tip)| {
        last = control.aim_nearest(path.direction(i), &last).expect("reachable").command;
        assert!(control.place(*tip, &mut last));
        last
    });
    each.collect()
}

#[test]
fn law_a_batch_of_targets_is_the_control_pose_by_pose() {
    for name in FIVE_AXIS {
        let machine = machine(name);
        let control = TipControl::of(&machine).expect("three linear axes");
        let inverse = CompiledInverse::of(&machine).expect("three linear axes");
        // Not a whole number of groups.
        let path = Path::of(&machine, &control, 5, 1037);
        let from = Random(9).command(&machine);
        let wanted = pose_by_pose(&control, &path, &from);
        let columns = path.columns();
        for set in InstructionSet::ALL.into_iter().filter(|set| set.is_available()) {
            let mut table = CommandTable::zeros(machine.axes().len(), path.tips.len());
            let done = inverse.commands_by(set, &targets(&columns), &from, &mut table.columns());
            done.expect("reachable");
            for (i, wanted) in wanted.iter().enumerate() {
                let found = table.at(i);
                let (tip, axis) = control.tip_and_axis(&found);
                assert!((tip - path.tips[i]).norm() < 1e-9, "{name} {set:?} {i}");
                assert!((axis - path.axes[i]).norm() < 1e-12, "{name} {set:?} {i}");
                // Near a pole the angle of the axis there is as rounding makes it; nowhere else.
                let sine = control.pole_sine(wanted).max(1e-9);
                for (k, axis) in machine.axes().iter().enumerate() {
                    let reach = if "XYZ".contains(axis.name.letter()) { 2e3 } else { 1.0 };
                    let off = (found[k] - wanted[k]).abs();
                    assert!(off < 1e-12 * reach / sine, "{name} {set:?} {i} {off:e} {sine:e}");
                }
            }
        }
    }
}

/// Whatever the path is cut into, and wherever it begins in a group, the commands are the same bits.
#[test]
fn law_the_cut_of_a_batch_does_not_matter() {
    let machine = machine(FIVE_AXIS[0]);
    let control = TipControl::of(&machine).expect("three linear axes");
    let inverse = CompiledInverse::of(&machine).expect("three linear axes");
    let path = Path::of(&machine, &control, 3, 300);
    let columns = path.columns();
    let axes = machine.axes().len();
    let mut whole = CommandTable::zeros(axes, 300);
    inverse.commands(&targets(&columns), &[0.0; 6], &mut whole.columns()).expect("reachable");
    for part in [1, 7, 64, 65] {
        let mut last = [0.0; 6];
        for at in (0..300).step_by(part) {
            let end = (at + part).min(300);
            let piece = columns.each_ref().map(|v| v.each_ref().map(|c| c[at..end].to_vec()));
            let mut table = CommandTable::zeros(axes, end - at);
            inverse.commands(&targets(&piece), &last, &mut table.columns()).expect("reachable");
            for i in at..end {
                last = table.at(i - at);
                assert_eq!(last, whole.at(i), "{part} {i}");
            }
        }
    }
}

#[test]
fn law_four_poses_are_four_single_ones() {
    for name in FIVE_AXIS {
        let machine = machine(name);
        let control = TipControl::of(&machine).expect("three linear axes");
        let path = Path::of(&machine, &control, 21, 400);
        let mut last = Random(2).command(&machine);
        for at in (0..400).step_by(4) {
            let single = {
                let part = Path {
                    tips: path.tips[at..at + 4].to_vec(),
                    axes: path.axes[at..at + 4].to_vec(),
                };
                pose_by_pose(&control, &part, &last)
            };
            let directions = [0, 1, 2, 3].map(|k| path.direction(at + k));
            let mut four = control.aim_four(&directions, &last).expect("reachable");
            let tips = [0, 1, 2, 3].map(|k| path.tips[at + k]);
            assert!(control.place_four(&tips, &mut four));
            for (found, wanted) in four.iter().zip(&single) {
                let sine = control.pole_sine(wanted).max(1e-9);
                let off = found.iter().zip(wanted).map(|(a, b)| (a - b).abs());
                assert!(off.fold(0.0, f64::max) < 2e-9 / sine, "{name} {found:?} {wanted:?}");
            }
            last = single[3];
        }
    }
}

/// Many poses are those one after the other: tips placed, and the tool at commands; in groups of any size, with angles beyond
/// those of the closed form too, on machines with three axes, with five and with a parallel one.
#[test]
fn law_many_poses_are_single_ones() {
    let others = ["w b X Y Z t", "w C' b X Y Z U B t", "w X' b C Y Z t"];
    let named = FIVE_AXIS.into_iter().map(machine);
    let stated = others.map(|chain| {
        let text =
            format!("[machine]\nname = \"m\"\nchain = \"{chain}\"\n[tool]\nlength = \"80 mm\"\n");
        Machine::check("m.toml", &text, &NoTables).0.expect("a machine")
    });
    for machine in named.chain(stated) {
        let control = TipControl::of(&machine).expect("three linear axes");
        let mut random = Random(7);
        for count in [0, 1, 63, 64, 65, 200] {
            let mut commands: Vec<_> = (0..count).map(|_| random.command(&machine)).collect();
            let rotary = machine.axes().iter().position(|axis| axis.kind == AxisKind::Rotary);
            if let (200, Some(axis)) = (count, rotary) {
                commands[130][axis] = 2e6;
            }
            let mut tools = Vec::new();
            control.tips_and_axes(&commands, &mut tools);
            assert_eq!(tools.len(), count);
            for (command, (tip, axis)) in commands.iter().zip(&tools) {
                let (there, along) = control.tip_and_axis(command);
                let off = [(tip - there).norm(), (axis - along).norm()];
                assert!(off[0] < 1e-9 && off[1] < 1e-13, "{off:?} {command:?}");
            }
            let tips: Vec<_> = tools.iter().map(|(tip, _)| tip + tip.yzx() * 0.01).collect();
            let mut placed = commands.clone();
            let mut singles = commands.clone();
            let each = tips.iter().zip(&mut singles);
            let reached = each.map(|(tip, single)| usize::from(control.place(*tip, single)));
            let reached: usize = reached.sum();
            assert_eq!(control.place_all(&tips, &mut placed), reached == count);
            for (placed, single) in placed.iter().zip(&singles).filter(|_| reached == count) {
                let off = placed.iter().zip(single).map(|(a, b)| (a - b).abs());
                assert!(off.fold(0.0, f64::max) < 1e-9, "{placed:?} {single:?}");
            }
        }
        let nowhere = Vec3::new(0.0, f64::NAN, 0.0);
        assert!(!control.place_all(&[nowhere], &mut [[0.0; 6]]));
    }
}

#[test]
fn bad_targets_are_refused_with_their_number() {
    let machine = machine(FIVE_AXIS[0]);
    let inverse = CompiledInverse::of(&machine).expect("three linear axes");
    let axes = machine.axes().len();
    let (tip, mut up) = (vec![0.0; 100], vec![1.0; 100]);
    let zero = vec![0.0; 100];
    up[70] = f64::NAN;
    let columns = [[tip.clone(), tip.clone(), tip], [zero.clone(), zero, up]];
    let run = |axes: usize, length: usize| {
        let mut table = CommandTable::zeros(axes, length);
        inverse.commands(&targets(&columns), &[0.0; 6], &mut table.columns())
    };
    let Err(InverseError::Target(error)) = run(axes, 100) else { panic!("NaN is no direction") };
    assert_eq!(error.index, 70);
    let wrong = InverseError::Batch(BatchError::Columns { expected: axes, found: 3 });
    assert_eq!(run(3, 100), Err(wrong));
    let wrong = InverseError::Batch(BatchError::Lengths { expected: 100, found: 99 });
    assert_eq!(run(axes, 99), Err(wrong));
}
