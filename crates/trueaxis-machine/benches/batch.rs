//! Batch deviations against the same computation written plainly with nalgebra 4×4 matrices.
//!
//! Target (issue 2): at least 5 times the plain matrices on one core, near-linear on two. The
//! candidates take turns in one run, and the medians are compared: on a shared machine only the
//! ratio means something. Two times are shown: by the clock, and core time of all threads, which
//! suffers less from neighbours; two threads are linear when they use no more of it than one.
//!
//! ```text
//!     cargo bench -p trueaxis-machine --bench batch
//! ```

#![allow(clippy::print_stdout, reason = "the table is what this program is for")]

#[path = "common/mod.rs"]
mod common;
#[path = "batch_plain/mod.rs"]
mod plain;

use common::{Candidate, POSES, commands, machine, pool, print, run};
use plain::{Exact, PlainDeviation, PlainMachine, SmallAngle};
use trueaxis_machine::batch::{Commands, CompiledMachine, DeviationTable, InstructionSet};

/// The slow candidates compute this many poses per round.
const SLOW_POSES: usize = 100_000;
/// So many fit into the second-level cache; a divisor of [`POSES`].
const CACHED_POSES: usize = 2000;

/// All twelve numbers, so that the compiler leaves none out.
fn sum_of(d: &PlainDeviation) -> f64 {
    (d.nominal_tip_mm + d.nominal_axis + d.tip_mm + d.axis).sum()
}

fn main() {
    let machine = machine();
    let plain = PlainMachine::of::<Exact>(&machine);
    let small_angle = PlainMachine::of::<SmallAngle>(&machine);
    let compiled = CompiledMachine::new(&machine);
    let columns = commands();
    let slices: Vec<&[f64]> = columns.iter().map(Vec::as_slice).collect();
    let batch = Commands::new(&slices);
    let command = |i: usize| std::array::from_fn(|k| columns.get(k).map_or(0.0, |c| c[i]));
    let pools = [pool(1), pool(2)];

    let slow = |f: &dyn Fn(usize) -> f64| {
        let sum: f64 = (0..SLOW_POSES).map(f).sum();
        std::hint::black_box(sum);
    };
    let exact = |i| sum_of(&plain.deviation::<Exact>(&command(i)));
    let small = |i| sum_of(&small_angle.deviation::<SmallAngle>(&command(i)));
    let scalar = |i| {
        let errors = machine.errors_at(&command(i), &[0.0; 6]).expect("within the tables");
        machine.deviation(&command(i), &errors).tip_mm.x
    };
    let mut candidates = vec![
        Candidate::new("nalgebra 4x4, exact rotations", SLOW_POSES, || slow(&exact)),
        Candidate::new("nalgebra 4x4, small-angle matrices", SLOW_POSES, || slow(&small)),
        Candidate::new("Machine::deviation", SLOW_POSES, || slow(&scalar)),
    ];
    for set in InstructionSet::ALL.into_iter().filter(|set| set.is_available()) {
        let mut out = DeviationTable::zeros(POSES);
        let (compiled, batch) = (&compiled, &batch);
        candidates.push(Candidate::new(format!("batch, {set:?}"), POSES, move || {
            compiled.deviations_by(set, batch, &mut out.columns()).expect("a batch");
        }));
    }
    // The same poses again and again: what memory costs the rows above.
    let near: Vec<&[f64]> = columns.iter().map(|c| &c[..CACHED_POSES]).collect();
    let (compiled_again, mut out) = (&compiled, DeviationTable::zeros(CACHED_POSES));
    candidates.push(Candidate::new("batch, best, in cache", POSES, move || {
        let near = Commands::new(&near);
        for _ in 0..POSES / CACHED_POSES {
            compiled_again.deviations(&near, &mut out.columns()).expect("a batch");
        }
    }));
    for pool in &pools {
        let mut out = DeviationTable::zeros(POSES);
        let (compiled, batch) = (&compiled, &batch);
        let name = format!("batch, parallel, {} threads", pool.current_num_threads());
        candidates.push(Candidate::new(name, POSES, move || {
            pool.install(|| compiled.deviations_parallel(batch, &mut out.columns()))
                .expect("a batch");
        }));
    }
    run(&mut candidates);
    print(&candidates);
}
