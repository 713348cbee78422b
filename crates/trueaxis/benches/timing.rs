//! Nodes per second of the jerk-limited planner, beside the plain pass with velocity and
//! acceleration limits only over the same nodes. Target: at least 1 M nodes/s on one core.

#[path = "../tests/timing/programs.rs"]
mod programs;

use divan::counter::ItemsCount;
use trueaxis::simulate::timing::{Node, Planner, Timed, without_jerk_s};

fn main() {
    divan::main();
}

const NODES: usize = 1_000_000;

type Program = fn(usize) -> Vec<Node>;

const PROGRAMS: [(&str, Program); 2] = [("blade", programs::blade), ("pocket", programs::pocket)];

fn named(name: &str) -> Vec<Node> {
    let (_, program) = PROGRAMS.iter().find(|p| p.0 == name).expect("a program");
    program(NODES)
}

#[divan::bench(args = ["blade", "pocket"], sample_count = 5)]
fn jerk_limited(bencher: divan::Bencher<'_, '_>, name: &str) {
    let nodes = named(name);
    bencher.counter(ItemsCount::new(NODES)).bench_local(|| {
        let mut end_s = 0.0;
        let mut planner = Planner::new(&programs::mill()).expect("limits");
        let mut out = |t: Timed| end_s = t.t_s;
        for node in &nodes {
            planner.push(node, &mut out).expect("a node");
        }
        planner.finish(&mut out);
        end_s
    });
}

#[divan::bench(args = ["blade", "pocket"], sample_count = 5)]
fn without_jerk(bencher: divan::Bencher<'_, '_>, name: &str) {
    let nodes = named(name);
    bencher
        .counter(ItemsCount::new(NODES))
        .bench_local(|| without_jerk_s(&programs::mill(), &nodes).expect("a path"));
}
