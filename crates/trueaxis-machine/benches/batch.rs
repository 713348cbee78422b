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

#[path = "batch_plain/mod.rs"]
mod plain;

use plain::{Exact, PlainDeviation, PlainMachine, SmallAngle};
use std::time::Instant;
use trueaxis_machine::Machine;
use trueaxis_machine::batch::{Commands, CompiledMachine, DeviationTable, InstructionSet};
use trueaxis_machine::file::Tables;

const POSES: usize = 1_000_000;
const KNOTS: usize = 50;
/// The slow candidates compute this many poses per round.
const SLOW_POSES: usize = 100_000;
/// So many fit into the second-level cache; a divisor of [`POSES`].
const CACHED_POSES: usize = 2000;
const ROUNDS: usize = 15;

/// Tables in memory: `X.csv` and so on.
struct Memory;

impl Tables for Memory {
    fn text(&self, name: &str) -> Result<String, String> {
        let letter = name.chars().next().ok_or("no name")?;
        Ok(table(letter))
    }
}

/// Fifty positions with six smooth errors each, µm and µrad.
fn table(letter: char) -> String {
    let (unit, from, to) = match letter {
        'X' | 'Y' | 'Z' => ("mm", -500.0, 500.0),
        _ => ("deg", -180.0, 180.0),
    };
    let heads = ["EX", "EY", "EZ", "EA", "EB", "EC"];
    let units = ["um", "um", "um", "urad", "urad", "urad"];
    let columns: Vec<_> =
        heads.iter().zip(units).map(|(h, u)| format!("{h}{letter}_{u}")).collect();
    let mut text = format!("position_{unit},{}\n", columns.join(","));
    for i in 0..KNOTS {
        let t = i as f64 / (KNOTS - 1) as f64;
        let phase = f64::from(letter as u32);
        let value =
            |k: usize| 12.0 * (7.0 * t + phase + 1.3 * k as f64).sin() + 3.0 * (31.0 * t).cos();
        let row: Vec<_> = (0..6).map(|k| format!("{:.4}", value(k))).collect();
        text += &format!("{},{}\n", from + (to - from) * t, row.join(","));
    }
    text
}

/// Head-head, all thirty error motions, all location errors of the axes.
fn machine() -> Machine {
    let mut text = String::from(
        "[machine]\nname = \"bench\"\nchain = \"w b X Y Z C A t\"\nsource = \"invented\"\n\
         [tool]\nplacement = \"0 0 -200 mm\"\nlength = \"100 mm\"\n[location]\n",
    );
    for (i, axis) in "XYZCA".chars().enumerate() {
        for (k, direction) in "XYZ".chars().enumerate() {
            text += &format!("E{direction}0{axis} = \"{} um\"\n", 3 + 2 * i + k);
        }
        for (k, direction) in "ABC".chars().enumerate() {
            text += &format!("E{direction}0{axis} = \"{} urad\"\n", 11 - 3 * i as i32 + k as i32);
        }
    }
    for axis in "XYZCA".chars() {
        text += &format!("[motion.{axis}]\ntable = \"{axis}.csv\"\n");
    }
    let (machine, problems) = Machine::check("bench.toml", &text, &Memory);
    let list: Vec<String> = problems.iter().map(ToString::to_string).collect();
    machine.unwrap_or_else(|| panic!("{}", list.join("\n")))
}

/// Random positions within the tables (splitmix64).
fn commands() -> Vec<Vec<f64>> {
    let mut state = 1_u64;
    let mut unit = move || {
        state = state.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = state;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    };
    let half = [500.0, 500.0, 500.0, std::f64::consts::PI, std::f64::consts::PI];
    half.map(|half| (0..POSES).map(|_| half * (2.0 * unit() - 1.0)).collect()).to_vec()
}

/// One way to compute the batch.
struct Candidate<'a> {
    name: String,
    /// How many poses a round computes.
    poses: usize,
    work: Box<dyn FnMut() + 'a>,
    /// By the clock, and by what all threads used of the cores; of every round.
    ns_per_pose: [Vec<f64>; 2],
}

impl<'a> Candidate<'a> {
    fn new(name: impl Into<String>, poses: usize, work: impl FnMut() + 'a) -> Self {
        Self { name: name.into(), poses, work: Box::new(work), ns_per_pose: Default::default() }
    }

    fn round(&mut self) {
        let start = (Instant::now(), cpu_seconds());
        (self.work)();
        let seconds = [start.0.elapsed().as_secs_f64(), cpu_seconds() - start.1];
        for (all, seconds) in self.ns_per_pose.iter_mut().zip(seconds) {
            all.push(seconds * 1e9 / self.poses as f64);
        }
    }

    /// Median and least, by the clock and by the core.
    fn summary(&self) -> [[f64; 2]; 2] {
        self.ns_per_pose.each_ref().map(|all| {
            // The first round warms up.
            let mut all = all[1..].to_vec();
            all.sort_by(f64::total_cmp);
            [all[all.len() / 2], all[0]]
        })
    }
}

/// What all threads have used of the cores; 0 where the system does not say (not Linux).
fn cpu_seconds() -> f64 {
    let threads = std::fs::read_dir("/proc/self/task").into_iter().flatten().flatten();
    let ns = |thread: std::fs::DirEntry| {
        let text = std::fs::read_to_string(thread.path().join("schedstat")).ok()?;
        text.split(' ').next()?.parse::<f64>().ok()
    };
    threads.filter_map(ns).sum::<f64>() * 1e-9
}

/// All twelve numbers, so that the compiler leaves none out.
fn sum_of(d: &PlainDeviation) -> f64 {
    (d.nominal_tip_mm + d.nominal_axis + d.tip_mm + d.axis).sum()
}

fn pool(threads: usize) -> rayon::ThreadPool {
    rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads")
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
    // `cargo test --benches` only wants to see it run.
    let rounds = if std::env::args().any(|a| a == "--bench") { ROUNDS } else { 1 };
    for _ in 0..=rounds {
        candidates.iter_mut().for_each(Candidate::round);
    }
    print(&candidates);
}

fn print(candidates: &[Candidate<'_>]) {
    println!("ns per pose: median of the rounds (least); ratio of the medians to the first row");
    println!(
        "{:<36}{:>20}{:>8}{:>22}{:>8}{:>12}",
        "", "clock", "ratio", "core", "ratio", "M poses/s"
    );
    let plain = candidates[0].summary();
    for candidate in candidates {
        let [clock, core] = candidate.summary();
        print!("{:<36}{:>10.1} ({:>7.1})", candidate.name, clock[0], clock[1]);
        print!("{:>8.2}", plain[0][0] / clock[0]);
        print!("{:>12.1} ({:>7.1}){:>8.2}", core[0], core[1], plain[1][0] / core[0]);
        println!("{:>12.1}", 1e3 / core[0]);
    }
}
