//! ISO 230-2 of a million rows beside just reading the table. Target: the evaluation is limited by
//! reading.

use divan::counter::ItemsCount;
use std::fmt::Write as _;
use trueaxis::input::Diagnostics;
use trueaxis::input::sheet::Sheet;
use trueaxis::verify::conditions::Conditions;
use trueaxis::verify::{Request, Standard, evaluate, iso230_2};

fn main() {
    divan::main();
}

const TARGETS: usize = 100;
const RUNS: usize = 5000;
const ROWS: usize = 2 * TARGETS * RUNS;

/// A million readings: 100 targets, 5000 runs, both directions.
fn table() -> String {
    let mut text = "target_mm,run,direction,deviation_um\n".to_owned();
    for run in 1..=RUNS {
        for (direction, reversal) in [("up", -1.0), ("down", 1.0)] {
            for i in 0..TARGETS {
                let noise = ((i * 7919 + run * 104_729) % 1000) as f64 / 1000.0;
                let target = 10.0 * i as f64 + 0.3 * ((i * i) % 7) as f64;
                let _ = writeln!(text, "{target:.1},{run},{direction},{:.3}", reversal + noise);
            }
        }
    }
    text
}

#[divan::bench(sample_count = 10)]
fn read(bencher: divan::Bencher<'_, '_>) {
    let text = table();
    bencher.counter(ItemsCount::new(ROWS)).bench_local(|| {
        Sheet::parse("x.csv", &text, iso230_2::role_cells, &mut Diagnostics::new())
            .expect("a table")
    });
}

#[divan::bench(sample_count = 10)]
fn read_and_evaluate(bencher: divan::Bencher<'_, '_>) {
    let text = table();
    let conditions = Conditions::default();
    let request = Request {
        standard: Standard::Iso230_2,
        file: "x.csv",
        text: &text,
        conditions: &conditions,
        conditions_file: "x.toml",
        window_s: 3600.0,
    };
    bencher
        .counter(ItemsCount::new(ROWS))
        .bench_local(|| evaluate(&request, &mut Diagnostics::new()).expect("figures"));
}
