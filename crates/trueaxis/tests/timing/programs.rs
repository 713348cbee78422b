//! Programs as a machine sees them, for the laws and the bench.

use trueaxis::simulate::timing::{AxisLimits, Node};

/// A five-axis mill, X Y Z A C: 30 m/min, 3 m/s², 50 m/s³; 29 rpm, 20 rad/s², 400 rad/s³.
pub fn mill() -> AxisLimits {
    let [l, r] = [[500.0, 3000.0, 5e4], [3.0, 20.0, 400.0]];
    let row = |k: usize| [l[k], l[k], l[k], r[k], r[k], f64::INFINITY];
    AxisLimits { velocity: row(0), acceleration: row(1), jerk: row(2) }
}

/// A blade finished in passes: 0.05 to 0.6 mm per line, four decimals as a CAM system writes them,
/// 50 mm/s; the tool axis swings fast over the leading edge. A rapid return after every pass.
pub fn blade(lines: usize) -> Vec<Node> {
    let per_pass = 600;
    let mut nodes: Vec<Node> = Vec::with_capacity(lines);
    while nodes.len() < lines {
        let (line, pass) = (nodes.len() % per_pass, nodes.len() / per_pass);
        let command = match line {
            // Up, back, down again.
            597.. => {
                let s = [1.0, 0.0, 0.0][line - 597];
                let mut q = on_blade(s, pass + usize::from(line > 597));
                q[2] += [40.0, 40.0, 2.0][line - 597];
                q
            }
            _ => on_blade(line as f64 / 596.0, pass),
        };
        let command = command.map(|q| (q * 1e4).round() / 1e4);
        let rapid = line >= 597;
        let Some(before) = nodes.last() else {
            nodes.push(node(command, 1.0, 50.0));
            continue;
        };
        let tip = (0..3).map(|i| (command[i] - before.command[i]).powi(2)).sum::<f64>().sqrt();
        let feed = if rapid { f64::INFINITY } else { 50.0 };
        nodes.push(Node { stop: line == 599, ..node(command, tip.max(1e-3), feed) });
    }
    nodes
}

/// Machine positions at s = 0 … 1 of a pass around a blade of 120 mm chord.
fn on_blade(s: f64, pass: usize) -> [f64; 6] {
    let height = 0.4 * pass as f64 % 40.0;
    // The leading edge is at s = 0.5, of radius 2 mm; points stand closer there.
    let t = 2.0 * s - 1.0;
    let along = 120.0 * t.abs().powf(1.5);
    let thick = 8.0 * t.signum() * (1.0 - (-(t.abs() * 12.0)).exp()) * (1.0 - 0.5 * t.abs());
    let turn = (t * 9.0).tanh();
    let lean = 0.15 * (3.0 * t).sin() + 0.002 * height;
    [along, thick + 0.1 * height, height + 6.0 * lean, 0.4 + lean, 1.5 * turn, 0.0]
}

pub fn node(command: [f64; 6], length: f64, feed: f64) -> Node {
    let tolerance = [0.01, 0.01, 0.01, 1e-3, 1e-3, 1e-3];
    Node { command, length, feed, stop: false, tolerance, dwell_s: 0.0 }
}

/// Pockets of a plate in X and Y: straight lines of 1 to 60 mm, arcs in chords of 0.2 mm.
pub fn pocket(lines: usize) -> Vec<Node> {
    let mut nodes = vec![node([0.0; 6], 1.0, 80.0)];
    let mut at = [0.0_f64; 6];
    let mut heading = 0.0_f64;
    let mut k = 0u32;
    while nodes.len() < lines {
        k += 1;
        // Every straight line ends in an arc of radius 3 mm (30 chords) or in a sharp corner.
        let length = 1.0 + f64::from(k * 37 % 60);
        let step = |at: &mut [f64; 6], heading: f64, length: f64| {
            at[0] += length * heading.cos();
            at[1] += length * heading.sin();
            node(*at, length, 80.0)
        };
        nodes.push(step(&mut at, heading, length));
        let turn = if k.is_multiple_of(2) { 1.57 } else { -1.2 };
        if k.is_multiple_of(3) {
            heading += turn;
        } else {
            for _ in 0..24 {
                heading += turn / 24.0;
                nodes.push(step(&mut at, heading, 3.0 * turn.abs() / 24.0));
            }
        }
    }
    nodes.truncate(lines);
    nodes
}
