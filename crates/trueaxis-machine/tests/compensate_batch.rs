//! Compensated batches against the pose-by-pose form.

mod library;

use library::{
    MACHINES, Random, away_from_ends, machine, machine_of, sides, warm, with_random_errors,
};
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{Approach, Command};
use trueaxis_machine::batch::{
    BatchError, CommandTable, Commands, CompensationError, CompiledCompensator, InstructionSet,
};
use trueaxis_machine::compensate::{Compensator, Fault, Scope};

struct Columns {
    positions: Vec<Vec<f64>>,
    approaches: Vec<Vec<f64>>,
}

impl Columns {
    fn of(machine: &Machine, poses: &[(Command, Approach)]) -> Self {
        let axes = 0..machine.axes().len();
        Self {
            positions: axes.clone().map(|k| poses.iter().map(|p| p.0[k]).collect()).collect(),
            approaches: axes.map(|k| poses.iter().map(|p| p.1[k]).collect()).collect(),
        }
    }
}

fn slices(columns: &[Vec<f64>]) -> Vec<&[f64]> {
    columns.iter().map(Vec::as_slice).collect()
}

fn sets() -> impl Iterator<Item = InstructionSet> {
    InstructionSet::ALL.into_iter().filter(|set| set.is_available())
}

fn poses(machine: &Machine, random: &mut Random, count: usize) -> Vec<(Command, Approach)> {
    (0..count).map(|_| (away_from_ends(machine, random), sides(random))).collect()
}

fn compiled(machine: &Machine, scope: Scope) -> CompiledCompensator {
    CompiledCompensator::new(Compensator::of(machine, scope).expect("three linear axes"))
}

/// The batch reaches the same poses: the residual errors of tip and axis are the same as pose by
/// pose, and the commands differ by less than the resolution of programs and controls. Returns the
/// share of the poses that took the scalar path, and the evaluations per pose.
fn agrees(machine: &Machine, scope: Scope, poses: &[(Command, Approach)]) -> (f64, f64) {
    let compiled = compiled(machine, scope);
    let columns = Columns::of(machine, poses);
    let (positions, approaches) = (slices(&columns.positions), slices(&columns.approaches));
    let batch = Commands::new(&positions).approached(&approaches);
    let (mut scalar, mut evaluations) = (0.0_f64, 0.0_f64);
    for set in sets() {
        let mut table = CommandTable::zeros(machine.axes().len(), poses.len());
        let effort = compiled.commands_by(set, &batch, &mut table.columns()).expect("a batch");
        scalar = scalar.max(effort.by_scalar as f64 / poses.len() as f64);
        evaluations = evaluations.max(effort.evaluations as f64 / poses.len() as f64);
        for (i, (command, approach)) in poses.iter().enumerate() {
            let one = compiled.compensator().at(command, approach).expect("a pose");
            let given = table.at(i);
            let errors = machine.errors_at(&given, approach).expect("inside the tables");
            let here = machine.deviation(&given, &errors);
            let tip = (here.nominal_tip - one.residual.nominal_tip) + here.tip_mm;
            let axis =
                (here.nominal_axis.vector() - one.residual.nominal_axis.vector()) + here.axis;
            let what = format!("{} {set:?} pose {i}", machine.name());
            assert!(tip.norm() < 1e-9, "{what}: {:e} mm", tip.norm());
            // Where the axis keeps a deviation both keep the same.
            let axis = (axis - one.residual.axis).norm();
            assert!(axis < 1e-12, "{what}: {axis:e}");
            for (a, b) in given.iter().zip(one.command) {
                assert!((a - b).abs() < 1e-8, "{what}: {a} {b}");
            }
        }
    }
    (scalar, evaluations)
}

#[test]
fn law_the_batch_is_the_pose_by_pose_form_on_every_shipped_machine() {
    let mut random = Random(21);
    for name in MACHINES {
        let own = machine(name);
        for scope in [Scope::Pose, Scope::Position] {
            let poses = poses(&own, &mut random, 3_001);
            let (scalar, evaluations) = agrees(&own, scope, &poses);
            assert!(scalar < 0.04, "{name} {scope:?}: {scalar} of the poses by the scalar path");
            assert!(evaluations < 3.5, "{name} {scope:?}: {evaluations} evaluations");
        }
        for reach in [0.05, 1.0] {
            let wrong = with_random_errors(&own, &mut random, reach);
            let poses = poses(&wrong, &mut random, 1_003);
            agrees(&wrong, Scope::Pose, &poses);
        }
    }
}

#[test]
fn law_a_warm_workpiece_and_uncompiled_models_agree() {
    let mut random = Random(22);
    let hot = warm(&machine("gantry-001"), "scale_x=25 scale_y=24 workpiece=28");
    let all = poses(&hot, &mut random, 501);
    let (scalar, _) = agrees(&hot, Scope::Pose, &all);
    assert_eq!(scalar, 0.0);
    let small = machine_of("i5-engraver", |text| {
        text.replace("[machine]", "[machine]\nrotation = \"small-angle\"")
    });
    assert!(!compiled(&small, Scope::Pose).is_fast());
    let all = poses(&small, &mut random, 501);
    agrees(&small, Scope::Pose, &all);
}

#[test]
fn law_a_compensated_pose_depends_on_its_own_command_only() {
    let mut random = Random(23);
    let wrong = with_random_errors(&machine("xkas2525"), &mut random, 0.3);
    let poses = poses(&wrong, &mut random, 20_000);
    let columns = Columns::of(&wrong, &poses);
    let (positions, approaches) = (slices(&columns.positions), slices(&columns.approaches));
    let compiled = compiled(&wrong, Scope::Pose);
    let mut all = CommandTable::zeros(5, poses.len());
    let batch = Commands::new(&positions).approached(&approaches);
    compiled.commands(&batch, &mut all.columns()).expect("a batch");
    let bits = |table: &CommandTable, i: usize| table.at(i).map(f64::to_bits);
    for length in (0..20).chain([63, 64, 65]) {
        let part = |columns: &[Vec<f64>]| -> Vec<Vec<f64>> {
            columns.iter().map(|c| c[100..100 + length].to_vec()).collect()
        };
        let (positions, approaches) = (part(&columns.positions), part(&columns.approaches));
        let (positions, approaches) = (slices(&positions), slices(&approaches));
        let mut table = CommandTable::zeros(5, length);
        let batch = Commands::new(&positions).approached(&approaches);
        compiled.commands(&batch, &mut table.columns()).expect("a batch");
        assert!((0..length).all(|i| bits(&table, i) == bits(&all, 100 + i)), "{length} poses");
    }
    for threads in [1, 3] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        let mut table = CommandTable::zeros(5, poses.len());
        pool.install(|| compiled.commands_parallel(&batch, &mut table.columns())).expect("a batch");
        assert!((0..poses.len()).all(|i| bits(&table, i) == bits(&all, i)), "{threads} threads");
    }
}

#[test]
fn the_first_pose_without_a_compensation_is_named() {
    let mill = machine("three-axis-mill");
    let compiled = compiled(&mill, Scope::Pose);
    let mut columns = vec![vec![0.0; 20_000], vec![150.0; 20_000], vec![-100.0; 20_000]];
    columns[0][15_001] = 301.0;
    columns[0][15_003] = f64::NAN;
    let fault = |columns: &[Vec<f64>], parallel: bool| {
        let positions = slices(columns);
        let (mut table, batch) = (CommandTable::zeros(3, 20_000), Commands::new(&positions));
        match parallel {
            true => compiled.commands_parallel(&batch, &mut table.columns()),
            false => compiled.commands(&batch, &mut table.columns()),
        }
        .expect_err("a fault")
    };
    for parallel in [false, true] {
        let CompensationError::Pose { index, fault } = fault(&columns, parallel) else { panic!() };
        assert_eq!(index, 15_001);
        assert!(matches!(fault, Fault::Travel { by, .. } if (by - 1.0).abs() < 0.01), "{fault}");
    }
    columns[0][15_001] = 0.0;
    let CompensationError::Pose { index, fault } = fault(&columns, false) else { panic!() };
    assert_eq!(index, 15_003);
    assert!(matches!(fault, Fault::Command(_)), "{fault}");
}

#[test]
fn columns_that_do_not_fit_are_refused() {
    let compiled = compiled(&machine("three-axis-mill"), Scope::Pose);
    let (three, two) = ([0.0; 3], [0.0; 2]);
    let run = |commands: Commands<'_>, axes: usize, length: usize| {
        let fault = compiled.commands(&commands, &mut CommandTable::zeros(axes, length).columns());
        match fault {
            Err(CompensationError::Batch(fault)) => Some(fault),
            _ => None,
        }
    };
    let good = Commands::new(&[&three, &three, &three]);
    let columns = |found| Some(BatchError::Columns { expected: 3, found });
    assert_eq!(run(good, 3, 3), None);
    assert_eq!(run(good, 2, 3), columns(2));
    assert_eq!(run(good, 7, 3), columns(7));
    assert_eq!(run(Commands::new(&[&three, &three]), 3, 3), columns(2));
    assert_eq!(run(good, 3, 2), Some(BatchError::Lengths { expected: 3, found: 2 }));
    let uneven = Commands::new(&[&three, &two, &three]);
    assert_eq!(run(uneven, 3, 3), Some(BatchError::Lengths { expected: 3, found: 2 }));
}
