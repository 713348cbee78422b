//! Monte Carlo of the frustum study, as a ratio to the part of it that cannot be spared.

//!
//! One sample cuts 72 tool positions and the setting point and evaluates 11 indices. Target: a
//! sample costs at most twice what its 73 deviations cost, measured in the same run.
//!
//! `cargo bench -p trueaxis --bench predict`

#![allow(clippy::print_stdout)] // a bench prints its figures

use std::hint::black_box;
use std::path::Path;
use std::time::Instant;
use trueaxis::files::disk;
use trueaxis::machine::axis::Approach;
use trueaxis::predict::{Bench, Cutting, Judge, Sampling, Study, monte_carlo, read_study};

const SAMPLES: usize = 4000;
const ROUNDS: usize = 7;

fn study() -> Study {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let (study, problems) =
        read_study(&disk(), &root.join("examples/03_predict/nas979-on-xkas2525.toml"));
    assert!(!problems.has_errors(), "the shipped study is sound");
    study.expect("a study")
}

fn seconds(mut work: impl FnMut()) -> f64 {
    let start = Instant::now();
    work();
    start.elapsed().as_secs_f64()
}

fn median(mut times: Vec<f64>) -> f64 {
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}

fn main() {
    let study = study();
    let cutting = Cutting::new(&study.machine, study.piece(), &study.reference).expect("reachable");
    let judge = Judge { cutting: &cutting, piece: study.piece() };
    let commands: Vec<_> = cutting.commands().copied().collect();
    let errors: Vec<_> = commands
        .iter()
        .map(|c| study.machine.errors_at(c, &Approach::default()).expect("inside the tables"))
        .collect();
    let threads =
        |count| rayon::ThreadPoolBuilder::new().num_threads(count).build().expect("a pool");
    let (one, two) = (threads(1), threads(2));
    let run = || {
        let sampling = Sampling { samples: SAMPLES, seed: 1 };
        black_box(monte_carlo(&study.machine, &judge, sampling, &|_| {}).expect("a run"));
    };
    let mut bench = Bench::default();
    let mut indices = vec![0.0; judge.index_count()];
    let [mut floor, mut cut, mut single, mut double] = [const { Vec::new() }; 4];
    for _ in 0..ROUNDS {
        floor.push(seconds(|| {
            for _ in 0..SAMPLES {
                for (command, errors) in commands.iter().zip(&errors) {
                    black_box(study.machine.deviation(command, black_box(errors)));
                }
            }
        }));
        cut.push(seconds(|| {
            for _ in 0..SAMPLES {
                judge.indices(&|e, _| *e, &mut bench, &mut indices).expect("indices");
            }
        }));
        single.push(seconds(|| one.install(run)));
        double.push(seconds(|| two.install(run)));
    }
    let per_sample = |times: Vec<f64>| median(times) / SAMPLES as f64 * 1e6;
    let [floor, cut, single, double] = [floor, cut, single, double].map(per_sample);
    println!(
        "per sample, µs: deviations alone {floor:.1}, cut and evaluate {cut:.1}, Monte Carlo {single:.1}"
    );
    println!("ratio to the deviations alone: {:.2} (target: at most 2)", single / floor);
    println!("two threads: {:.2} times as fast as one", single / double);
    println!("10^5 samples: {:.1} s on one thread, {:.1} s on two", single / 10.0, double / 10.0);
}
