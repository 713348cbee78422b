//! Judged by mathematics: no limit is exceeded, whatever is programmed.

use crate::programs::{blade, mill, node, pocket};
use proptest::prelude::*;
use trueaxis::simulate::timing::three_phase::{Block, Shape};
use trueaxis::simulate::timing::{
    AxisLimits, LimitKind, Node, Planner, State, Timed, Timeline, TimingError, without_jerk_s,
};

/// A number between powers of ten.
fn decades(from: f64, to: f64) -> impl Strategy<Value = f64> {
    (from..to).prop_map(|x| 10.0_f64.powf(x))
}

/// Each axis moves or rests; sometimes exactly back or on.
fn a_direction() -> impl Strategy<Value = [f64; 6]> {
    prop_oneof![
        3 => prop::array::uniform6(-1.0..1.0),
        2 => (0usize..6, prop::bool::ANY).prop_map(|(axis, back)| {
            let mut d = [0.0; 6];
            d[axis] = if back { -1.0 } else { 1.0 };
            d
        }),
        // The same direction in every such move: straight on.
        2 => Just([0.6, 0.0, 0.8, 0.0, 0.1, 0.0]),
        // Hardly any corner, as in a contour of short lines.
        3 => prop::array::uniform3(-0.02..0.02)
            .prop_map(|[a, b, c]| [1.0, a, b, 0.1, c, 0.0]),
    ]
}

fn a_node() -> impl Strategy<Value = Node> {
    let feed = prop_oneof![4 => decades(-1.0, 3.0), 1 => Just(f64::INFINITY)];
    let tolerance = prop_oneof![6 => decades(-4.0, 0.0), 1 => Just(0.0), 1 => Just(f64::INFINITY)];
    let rest = prop_oneof![9 => Just(0.0), 1 => 0.0..2.0];
    (a_direction(), decades(-3.0, 2.0), feed, tolerance, prop::bool::weighted(0.1), rest).prop_map(
        |(step, length, feed, tolerance, stop, dwell_s)| {
            // A step for now; `walk` makes positions of them.
            let command = step.map(|d| d * length);
            Node { command, length, feed, stop, tolerance: [tolerance; 6], dwell_s }
        },
    )
}

/// Positions from steps.
fn walk(steps: Vec<Node>) -> Vec<Node> {
    let mut at = [0.0; 6];
    let each = |mut node: Node| {
        for (q, step) in at.iter_mut().zip(node.command) {
            *q += step;
        }
        node.command = at;
        node
    };
    steps.into_iter().map(each).collect()
}

fn programs() -> impl Strategy<Value = Vec<Node>> {
    prop::collection::vec(a_node(), 1..120).prop_map(walk)
}

fn limits() -> impl Strategy<Value = AxisLimits> {
    let axis = (decades(0.0, 3.0), decades(1.0, 4.0), decades(2.0, 6.0), 0..40u32);
    prop::collection::vec(axis, 6).prop_map(|axes| {
        let mut limits = AxisLimits::UNLIMITED;
        for (i, (v, a, j, kind)) in axes.into_iter().enumerate() {
            // A few axes state less.
            limits.velocity[i] = if kind == 0 { f64::INFINITY } else { v };
            limits.acceleration[i] = if kind == 1 { f64::INFINITY } else { a };
            limits.jerk[i] = if kind == 2 { f64::INFINITY } else { j };
        }
        limits
    })
}

/// Instants inside every phase and at equal steps, but for those at the very ends of the phases: the
/// jerk changes there at once, and half a bit of time decides between two of them.
fn instants(timeline: &Timeline, count: usize) -> Vec<f64> {
    let mut list = Vec::new();
    for phase in &timeline.phases {
        list.extend((0..8).map(|k| phase.t_s + phase.duration_s * (f64::from(k) + 0.5) / 8.0));
    }
    let end = timeline.duration_s();
    list.extend((0..=count).map(|k| end * k as f64 / count as f64));
    list.retain(|t| {
        let near = 1e-9 * (1.0 + end);
        let i = timeline.phases.partition_point(|p| p.t_s <= *t).saturating_sub(1);
        let phase = timeline.phases.get(i);
        phase.is_none_or(|p| t - p.t_s > near && p.t_s + p.duration_s - t > near)
    });
    list
}

fn at(timeline: &Timeline, t_s: f64) -> State {
    timeline.sample(t_s).expect("a state")
}

/// The largest of |value| / limit over the axes.
fn share(values: &[f64; 6], limits: &[f64; 6]) -> f64 {
    values.iter().zip(limits).map(|(x, l)| x.abs() / l).fold(0.0, f64::max)
}

/// No axis moves, speeds up or jerks more than it can, by the analytic derivatives.
pub fn assert_within(timeline: &Timeline, limits: &AxisLimits, count: usize) {
    for t in instants(timeline, count) {
        let state = at(timeline, t);
        let [v, a, j] = [
            share(&state.dq, &limits.velocity),
            share(&state.ddq, &limits.acceleration),
            share(&state.dddq, &limits.jerk),
        ];
        assert!(v.max(a).max(j) <= 1.0 + 1e-9, "at {t} s: {v} {a} {j} of the limits");
    }
}

/// The same by differences, which also see every jump: by the mean value theorem a difference over
/// a step is no more than the limit, for any step.
pub fn assert_differences_within(timeline: &Timeline, limits: &AxisLimits, count: usize) {
    let end = timeline.duration_s();
    let h = end / count as f64 / 3.0;
    for k in 0..count {
        let t = end * k as f64 / count as f64;
        let (one, two) = (at(timeline, t), at(timeline, t + h));
        for i in 0..6 {
            let over = |from: f64, to: f64, size: f64, limit: f64| {
                ((to - from).abs() - 1e-14 * size) / h > limit * (1.0 + 1e-7)
            };
            let speeds = one.dq[i].abs().max(two.dq[i].abs());
            // Half a bit of t moves the state a little.
            let late = |rate: f64| 10.0 * rate * end;
            let (dq, ddq) = (limits.acceleration[i], limits.jerk[i]);
            assert!(!over(one.q[i], two.q[i], one.q[i].abs() + late(speeds), limits.velocity[i]));
            assert!(dq.is_infinite() || !over(one.dq[i], two.dq[i], speeds + late(dq), dq));
            let size = one.ddq[i].abs() + late(ddq);
            assert!(
                ddq.is_infinite() || !over(one.ddq[i], two.ddq[i], size, ddq),
                "axis {i} at {t}"
            );
        }
    }
}

/// The programmed feed, wherever the path is.
fn assert_feed(timeline: &Timeline, nodes: &[Node]) {
    for t in instants(timeline, 500) {
        let state = at(timeline, t);
        let i = timeline.nodes.partition_point(|n| n.sigma < state.sigma).clamp(1, nodes.len() - 1);
        // On the node itself rounding may count it to the other side.
        let j = timeline.nodes.partition_point(|n| n.sigma < state.sigma - 1e-12).clamp(1, i);
        let feed = nodes[i].feed.max(nodes[j].feed);
        assert!(state.sigma_dot <= feed * (1.0 + 1e-9), "{} at feed {feed}", state.sigma_dot);
    }
}

fn assert_nodes(timeline: &Timeline, nodes: &[Node]) {
    assert_eq!(timeline.nodes.len(), nodes.len());
    for (i, (timed, node)) in timeline.nodes.iter().zip(nodes).enumerate() {
        assert_eq!(timed.index, i);
        let state = at(timeline, timed.t_s);
        for axis in 0..6 {
            let (q, wanted) = (state.q[axis], node.command[axis]);
            let allowed = node.tolerance[axis] * (1.0 + 1e-9) + 1e-9;
            assert!((q - wanted).abs() <= allowed, "node {i} axis {axis}: {q} for {wanted}");
        }
        let must_stop = node.stop || node.dwell_s > 0.0 || i == 0 || i + 1 == nodes.len();
        assert!(!must_stop || timed.sigma_dot == 0.0, "node {i} is passed at {}", timed.sigma_dot);
        assert!(
            timed.limiting.is_some() || must_stop || timed.sigma_dot >= 0.99 * feed_at(nodes, i)
        );
    }
    let pairs = timeline.nodes.windows(2).zip(nodes);
    assert!(pairs.into_iter().all(|(w, n)| w[1].t_s > w[0].t_s + 0.999 * n.dwell_s));
}

fn feed_at(nodes: &[Node], i: usize) -> f64 {
    nodes[i].feed.min(nodes[i + 1].feed).min(1e6)
}

/// The phases follow each other without a gap in time, place, velocity and acceleration.
fn assert_no_gap(timeline: &Timeline) {
    for pair in timeline.phases.windows(2) {
        let end = pair[0].after(pair[0].duration_s);
        let begin = [pair[1].sigma, pair[1].velocity, pair[1].acceleration];
        assert!((pair[1].t_s - pair[0].t_s - pair[0].duration_s).abs() <= 1e-12 * pair[1].t_s);
        for (k, (e, b)) in end.iter().zip(begin).enumerate() {
            let size = [b, pair[0].velocity + b, pair[0].acceleration.abs() + b.abs()][k] + 1e-3;
            assert!((e - b).abs() <= 1e-9 * size, "{k}: {e} then {b}");
        }
    }
}

proptest! {
    #[test]
    fn law_no_limit_is_exceeded(nodes in programs(), limits in limits()) {
        let timeline = Timeline::plan(&limits, &nodes).expect("a path");
        assert_within(&timeline, &limits, 2000);
        if timeline.duration_s() > 0.0 {
            assert_differences_within(&timeline, &limits, 2000);
        }
    }

    #[test]
    fn law_nodes_in_time_and_tolerance(nodes in programs(), limits in limits()) {
        let timeline = Timeline::plan(&limits, &nodes).expect("a path");
        assert_nodes(&timeline, &nodes);
        assert_no_gap(&timeline);
        if nodes.len() > 1 {
            assert_feed(&timeline, &nodes);
        }
    }

    #[test]
    fn law_no_faster_than_without_jerk(nodes in programs(), limits in limits()) {
        let timeline = Timeline::plan(&limits, &nodes).expect("a path");
        let least = without_jerk_s(&limits, &nodes).expect("a path");
        prop_assert!(timeline.duration_s() >= least * (1.0 - 1e-9));
    }

    /// What is handed on while the program still comes in is what the whole program gives.
    #[test]
    fn law_a_stream_gives_the_same(nodes in programs(), limits in limits()) {
        let whole = Timeline::plan(&limits, &nodes).expect("a path");
        let mut streamed: Vec<Timed> = Vec::new();
        let mut planner = Planner::new(&limits).expect("limits");
        for chunk in nodes.chunks(7) {
            let mut part = Vec::new();
            for node in chunk {
                planner.push(node, &mut |t: Timed| part.push(t)).expect("a node");
            }
            streamed.append(&mut part);
        }
        planner.finish(&mut |t: Timed| streamed.push(t));
        prop_assert_eq!(streamed, whole.nodes);
    }

    /// Jiang et al.: stamps rise from 0 to T₁ + T₂ + T₃, the phases cover the block, and the mean
    /// velocity between two stamps is no more than the largest of the block.
    #[test]
    fn law_three_phases(
        (length, feed, acceleration) in (decades(-3.0, 3.0), decades(-1.0, 3.0), decades(1.0, 4.0)),
        [start, end] in prop::array::uniform2(0.0..100.0),
        smooth in prop::bool::ANY,
    ) {
        let shape = if smooth { Shape::Smooth } else { Shape::Constant };
        let phases = Block { length, feed, acceleration, start, end, shape }.phases();
        let phases = phases.expect("a block");
        let covered: f64 = phases.lengths.iter().sum();
        prop_assert!((covered - length).abs() <= 1e-11 * length);
        let stamps: Vec<f64> = phases.stamps_s(50).collect();
        prop_assert!(stamps[0] == 0.0);
        prop_assert!((stamps[50] - phases.duration_s()).abs() <= 1e-6 * phases.duration_s());
        let most = feed.max(start).max(end) * (1.0 + 1e-6);
        for pair in stamps.windows(2) {
            prop_assert!(pair[1] > pair[0] && length / 50.0 <= most * (pair[1] - pair[0]));
        }
        let peak = acceleration * if smooth { 1.5 } else { 1.0 };
        prop_assert!(!phases.fits || phases.peak_acceleration() <= peak * (1.0 + 1e-9));
    }

    /// Any numbers at all: an error or finite times.
    #[test]
    fn law_any_numbers(
        raw in prop::collection::vec((prop::array::uniform6(prop::num::f64::ANY),
            prop::num::f64::ANY, prop::num::f64::ANY, prop::num::f64::ANY), 1..40),
        limit in prop::num::f64::ANY,
    ) {
        let limits = AxisLimits { jerk: [limit; 6], ..mill() };
        let made = Planner::new(&limits);
        prop_assert_eq!(made.is_ok(), limit >= 1e-9);
        let mut planner = made.or_else(|_| Planner::new(&mill())).expect("limits");
        let mut finite = true;
        let mut out = |t: Timed| finite &= t.t_s.is_finite() && t.sigma_dot.is_finite();
        for (command, length, feed, dwell_s) in raw {
            let small = command.map(|q| q % 1e3);
            for command in [command, small] {
                let node = Node { dwell_s: dwell_s % 10.0, ..node(command, length, feed) };
                let _ = planner.push(&node, &mut out);
                let _ = planner.push(&Node { length: length.abs() % 10.0, ..node }, &mut out);
            }
        }
        planner.finish(&mut out);
        prop_assert!(finite);
    }
}

/// Realistic programs: within the limits, and the jerk limit costs what the note says.
#[test]
fn law_realistic_programs() {
    for (nodes, most) in [(blade(12_000), 1.6), (pocket(6000), 1.5)] {
        let timeline = Timeline::plan(&mill(), &nodes).expect("a path");
        assert_within(&timeline, &mill(), 100_000);
        assert_differences_within(&timeline, &mill(), 100_000);
        assert_nodes(&timeline, &nodes);
        assert_feed(&timeline, &nodes);
        let ratio = timeline.duration_s() / without_jerk_s(&mill(), &nodes).expect("a path");
        assert!((1.0..most).contains(&ratio), "{ratio} times the time without jerk");
    }
}

/// A crawl to a velocity so high that the look-ahead never sees the end: memory stays bounded and
/// so do the axes.
#[test]
fn law_the_window_is_bounded() {
    let step = |i: usize| node([i as f64 * 1e-3, 0.0, 0.0, 0.0, 0.0, 0.0], 1e-3, f64::INFINITY);
    let nodes: Vec<Node> = (0..300_000).map(step).collect();
    let mut limits = mill();
    limits.acceleration[0] = 1.0;
    let (mut passed, mut lag) = (0, 0);
    let mut planner = Planner::new(&limits).expect("limits");
    for (i, node) in nodes.iter().enumerate() {
        planner.push(node, &mut |_: Timed| passed += 1).expect("a node");
        lag = lag.max(i + 1 - passed);
    }
    planner.finish(&mut |_: Timed| passed += 1);
    assert!(passed == nodes.len() && lag <= 1 << 17, "{lag} nodes wait");
    let timeline = Timeline::plan(&limits, &nodes).expect("a path");
    assert_within(&timeline, &limits, 1000);
}

/// Each reason where it must be.
#[test]
fn law_the_limiting_axis_is_named() {
    let mut limits = mill();
    limits.velocity[1] = 20.0;
    let to = |x: f64, y: f64, tolerance: f64| {
        let command = [x, y, 0.0, 0.0, 0.0, 0.0];
        Node { tolerance: [tolerance; 6], ..node(command, 100.0, 50.0) }
    };
    let kinds = |nodes: &[Node]| -> Vec<_> {
        let planned = Timeline::plan(&limits, nodes).expect("a path");
        planned.nodes.iter().map(|n| n.limiting.map(|l| (l.axis, l.kind))).collect()
    };
    let straight = kinds(&[to(0.0, 0.0, 0.0), to(0.0, 100.0, 0.0), to(0.0, 200.0, 0.0)]);
    assert_eq!(straight[1], Some((1, LimitKind::Velocity)));
    let corner = kinds(&[to(0.0, 0.0, 0.0), to(100.0, 0.0, 0.01), to(100.0, 100.0, 0.0)]);
    assert_eq!(corner[1].map(|l| l.1), Some(LimitKind::Corner));
    let sharp = kinds(&[to(0.0, 0.0, 0.0), to(100.0, 0.0, 0.0), to(100.0, 100.0, 0.0)]);
    assert_eq!(sharp[1].map(|l| l.1), Some(LimitKind::Corner));
    let short = |x: f64| Node { length: 0.1, ..to(x, 0.0, 0.0) };
    let short = kinds(&[short(0.0), short(0.1), short(0.2)]);
    assert_eq!(short[1], Some((0, LimitKind::Jerk)));
    assert_eq!(short[2], None);
}

/// A refused node says what is wrong with it and leaves the path as it was.
#[test]
fn law_a_refused_node_changes_nothing() {
    let mut planner = Planner::new(&mill()).expect("limits");
    let (mut times, mut out) = (Vec::new(), Vec::new());
    for length in [1.0, 0.0, f64::NAN, 1.0] {
        let at = [times.len() as f64, 0.0, 0.0, 0.0, 0.0, 0.0];
        match planner.push(&node(at, length, 50.0), &mut |t: Timed| out.push(t.t_s)) {
            Ok(()) => times.push(length),
            Err(e) => assert!(matches!(e, TimingError::Node { index: 1, what: "the length", .. })),
        }
    }
    planner.finish(&mut |t: Timed| out.push(t.t_s));
    assert!(times.len() == 2 && out.len() == 2 && out[1] > 0.02);
}
