//! Times along a path do not depend on the unit of its lengths.

use trueaxis_motion::timing::{AxisLimits, Node, Timeline};

/// 100 mm straight on in 50 blocks are one line: with V = 100 mm/s, A = 1 m/s² and J = 20 m/s³ it takes L/V + V/A + A/J =
/// 1 + 0.1 + 0.05 s, whether lengths and limits are in mm, µm, m or km.
#[test]
fn law_a_line_in_blocks_takes_the_same_time_in_any_unit() {
    for mm in [1.0, 1e3, 1e-3, 1e-6] {
        let row = |limit: f64| [limit * mm; 6];
        let limits =
            AxisLimits { velocity: row(100.0), acceleration: row(1000.0), jerk: row(20_000.0) };
        let node = |k: u32| Node {
            command: [2.0 * mm * f64::from(k), 0.0, 0.0, 0.0, 0.0, 0.0],
            length: 2.0 * mm,
            feed: f64::INFINITY,
            stop: false,
            tolerance: [0.0; 6],
            dwell_s: 0.0,
        };
        let nodes: Vec<Node> = (0..=50).map(node).collect();
        let time_s = Timeline::plan(&limits, &nodes).expect("a path").duration_s();
        assert!((time_s - 1.15).abs() < 1e-6, "{time_s} s where a mm is {mm}");
    }
}
