//! Compensated five-axis poses against one evaluation of the chain.
//!
//! Target (issue 8): at least 2 million poses per second and core, exact, with about three
//! evaluations each. The candidates take turns in one run and the medians are compared.
//!
//! ```text
//!     cargo bench -p trueaxis-machine --bench compensate
//! ```

#![allow(clippy::print_stdout, reason = "the table is what this program is for")]

#[path = "common/mod.rs"]
mod common;

use common::{Candidate, POSES, commands, machine, pool, print, run};
use trueaxis_machine::batch::{
    CommandTable, Commands, CompiledCompensator, CompiledMachine, DeviationTable, InstructionSet,
};
use trueaxis_machine::compensate::{Compensator, Scope};

/// The scalar path computes this many poses per round.
const SLOW_POSES: usize = 50_000;

fn main() {
    let machine = machine();
    let columns = inside(commands());
    let slices: Vec<&[f64]> = columns.iter().map(Vec::as_slice).collect();
    let batch = Commands::new(&slices);
    let compiled = CompiledMachine::new(&machine);
    let compensator = Compensator::of(&machine, Scope::Pose).expect("three linear axes");
    let fast = CompiledCompensator::new(compensator.clone());
    let position =
        CompiledCompensator::new(Compensator::of(&machine, Scope::Position).expect("the same"));
    let command = |i: usize| std::array::from_fn(|k| columns.get(k).map_or(0.0, |c| c[i]));
    let pools = [pool(1), pool(2)];

    let mut deviations = DeviationTable::zeros(POSES);
    let mut candidates = vec![
        Candidate::new("one evaluation of the chain, batch", POSES, || {
            compiled.deviations(&batch, &mut deviations.columns()).expect("a batch");
        }),
        Candidate::new("Compensator::at", SLOW_POSES, || {
            let x = |i| compensator.at(&command(i), &[0.0; 6]).expect("a pose").command[0];
            std::hint::black_box((0..SLOW_POSES).map(x).sum::<f64>());
        }),
    ];
    for set in InstructionSet::ALL.into_iter().filter(|set| set.is_available()) {
        let (mut out, fast, batch) = (CommandTable::zeros(5, POSES), &fast, &batch);
        candidates.push(Candidate::new(format!("batch, {set:?}"), POSES, move || {
            fast.commands_by(set, batch, &mut out.columns()).expect("a batch");
        }));
    }
    let (mut out, position, near) = (CommandTable::zeros(5, POSES), &position, &batch);
    candidates.push(Candidate::new("batch, position only", POSES, move || {
        position.commands(near, &mut out.columns()).expect("a batch");
    }));
    for pool in &pools {
        let (mut out, fast, batch) = (CommandTable::zeros(5, POSES), &fast, &batch);
        let name = format!("batch, parallel, {} threads", pool.current_num_threads());
        candidates.push(Candidate::new(name, POSES, move || {
            pool.install(|| fast.commands_parallel(batch, &mut out.columns())).expect("a batch");
        }));
    }
    run(&mut candidates);
    print(&candidates);
    let effort = fast.commands(&batch, &mut CommandTable::zeros(5, POSES).columns());
    let effort = effort.expect("a batch");
    println!(
        "{:.2} evaluations per pose; {:.2} % of the poses by the scalar path",
        effort.evaluations as f64 / POSES as f64,
        100.0 * effort.by_scalar as f64 / POSES as f64
    );
}

/// The poses drawn in a little, so that no corrected command leaves the tables.
fn inside(mut columns: Vec<Vec<f64>>) -> Vec<Vec<f64>> {
    columns.iter_mut().flatten().for_each(|q| *q *= 0.98);
    columns
}
