//! Single moves against ruckig: data/ruckig-moves.csv, made by oracles/ruckig_moves.py.

use crate::programs::node;
use trueaxis::simulate::timing::{AxisLimits, Timeline};

#[test]
fn oracle_single_moves_take_as_long_as_ruckigs() {
    let text = include_str!("../data/ruckig-moves.csv");
    let mut count = 0;
    for line in text.lines().skip(2) {
        let numbers: Vec<f64> = line.split(',').map(|x| x.parse().expect("a number")).collect();
        let [length, v, a, j, duration_s] = numbers[..] else { panic!("{line}") };
        let row = |limit: f64| [limit; 6];
        let limits = AxisLimits { velocity: row(v), acceleration: row(a), jerk: row(j) };
        let to = [length, 0.0, 0.0, 0.0, 0.0, 0.0];
        let nodes = [node([0.0; 6], 1.0, 1.0), node(to, length, f64::INFINITY)];
        let ours = Timeline::plan(&limits, &nodes).expect("a path").duration_s();
        // The last digits of a top velocity that is found by halving; ours is never the shorter.
        let over = ours / duration_s - 1.0;
        assert!((-1e-12..1e-6).contains(&over), "{line}: {ours} s, {over:e}");
        count += 1;
    }
    assert_eq!(count, 300);
}
