//! Elements: arcs within the limits, closed forms, and the same time however finely a path is drawn.

use crate::laws::{assert_differences_within, assert_within};
use crate::programs::{mill, node};
use proptest::prelude::*;
use trueaxis::simulate::timing::{AxisLimits, Node, Planner, Shape, Timed, Timeline, Turn};

fn limits(v: f64, a: f64, j: f64) -> AxisLimits {
    AxisLimits { velocity: [v; 6], acceleration: [a; 6], jerk: [j; 6] }
}

/// An arc in the plane of two axes from a place, from a direction on (rad), with a helix along a third.
fn arc(radius: f64, from: f64, sweep: f64, rise: f64) -> Turn {
    let length = (radius * sweep).hypot(rise);
    let mut steady = [0.0; 6];
    steady[2] = rise / length;
    let (sin, cos) = from.sin_cos();
    Turn {
        length,
        rate: sweep / length,
        cos: [radius * cos, radius * sin, 0.0, 0.0, 0.0, 0.0],
        sin: [-radius * sin, radius * cos, 0.0, 0.0, 0.0, 0.0],
        steady,
        growth: 0.0,
    }
}

fn circle(radius: f64, feed: f64) -> [(Node, Shape); 2] {
    let turn = arc(radius, 0.0, std::f64::consts::TAU, 0.0);
    let at = |length: f64| node([0.0; 6], length, feed);
    [(at(1.0), Shape::Line), (at(turn.length), Shape::Arc(turn))]
}

/// A line or an arc that goes on from a place, in a direction in the plane of X and Y; some tangent to
/// the one before, some not.
#[derive(Debug, Clone)]
struct Piece {
    length: f64,
    bend: Option<f64>,
    corner: f64,
    rise: f64,
    feed: f64,
    tolerance: f64,
}

fn piece() -> impl Strategy<Value = Piece> {
    let ten = |low: f64, high: f64| (low..high).prop_map(|x| 10.0_f64.powf(x));
    let bend = prop_oneof![
        Just(None),
        (ten(-0.5, 2.0), prop::bool::ANY).prop_map(|(r, left)| Some(if left { r } else { -r }))
    ];
    let corner = prop_oneof![2 => Just(0.0), 1 => -3.0..3.0];
    let rise = prop_oneof![3 => Just(0.0), 1 => -5.0..5.0];
    (ten(-1.0, 2.0), bend, corner, rise, ten(0.0, 3.0), ten(-3.0, -1.0)).prop_map(
        |(length, bend, corner, rise, feed, tolerance)| Piece {
            length,
            bend,
            corner,
            rise,
            feed,
            tolerance,
        },
    )
}

fn chain(pieces: &[Piece]) -> Vec<(Node, Shape)> {
    let (mut at, mut heading) = ([0.0; 6], 0.0_f64);
    let mut nodes = vec![(node(at, 1.0, 1.0), Shape::Line)];
    for p in pieces {
        heading += p.corner;
        let (shape, length, step) = match p.bend {
            None => {
                let (sin, cos) = heading.sin_cos();
                let step = [p.length * cos, p.length * sin, p.rise];
                (Shape::Line, p.length.hypot(p.rise), step)
            }
            Some(radius) => {
                // The arm is at a right angle to the heading; a negative radius turns to the right.
                let sweep = p.length / radius.abs() * radius.signum();
                let turn = arc(
                    radius.abs(),
                    heading - radius.signum() * std::f64::consts::FRAC_PI_2,
                    sweep,
                    p.rise,
                );
                heading += sweep;
                let [q, ..] = turn.derivatives(turn.length);
                (Shape::Arc(turn), turn.length, [q[0], q[1], q[2]])
            }
        };
        (0..3).for_each(|i| at[i] += step[i]);
        let tolerance = [p.tolerance; 6];
        nodes.push((Node { tolerance, ..node(at, length, p.feed) }, shape));
    }
    nodes
}

fn chains() -> impl Strategy<Value = Vec<(Node, Shape)>> {
    prop::collection::vec(piece(), 1..20).prop_map(|pieces| chain(&pieces))
}

fn some_limits() -> impl Strategy<Value = AxisLimits> {
    let ten = |low: f64, high: f64| (low..high).prop_map(|x| 10.0_f64.powf(x));
    (ten(1.0, 3.0), ten(2.0, 4.0), ten(3.0, 6.0)).prop_map(|(v, a, j)| limits(v, a, j))
}

proptest! {
    #[test]
    fn law_no_limit_is_exceeded_on_arcs(nodes in chains(), limits in some_limits()) {
        let timeline = Timeline::plan_shapes(&limits, &nodes).expect("a path");
        assert_within(&timeline, &limits, 2000);
        assert_differences_within(&timeline, &limits, 2000);
    }

    /// A place that is timed on an element changes nothing but the list of times.
    #[test]
    fn law_time_does_not_depend_on_what_is_drawn(
        nodes in chains(), limits in some_limits(), count in 1..200_u32,
    ) {
        let plan = |count: u32| {
            let mut all: Vec<Timed> = Vec::new();
            let mut planner = Planner::new(&limits).expect("limits");
            let mut from = nodes[0].0.command;
            for (i, (node, shape)) in nodes.iter().enumerate() {
                let marks: Vec<f64> = (1..if i == 0 { 1 } else { count })
                    .map(|k| node.length * f64::from(k) / f64::from(count))
                    .collect();
                let element = match shape {
                    Shape::Arc(turn) => turn.element(),
                    Shape::Line => trueaxis::simulate::timing::Element::straight(
                        &from, &node.command, node.length),
                };
                let out = &mut |t: Timed| all.push(t);
                planner.push_element(node, element, &marks, out).expect("a node");
                from = node.command;
            }
            planner.finish(&mut |t: Timed| all.push(t));
            all
        };
        let (coarse, fine) = (plan(1), plan(count));
        prop_assert_eq!(fine.len(), (nodes.len() - 1) * count as usize + 1);
        for (k, one) in coarse.iter().enumerate() {
            let other = fine[k * count as usize];
            prop_assert_eq!((one.t_s, one.sigma_dot), (other.t_s, other.sigma_dot));
        }
        prop_assert!(fine.windows(2).all(|w| w[1].t_s > w[0].t_s && w[1].sigma >= w[0].sigma));
    }

    /// A corner that may be rounded takes no longer than one at which the axes stop.
    #[test]
    fn law_a_blend_is_never_slower_than_a_stop(
        pieces in prop::collection::vec(piece(), 1..8), limits in some_limits(),
    ) {
        let nodes = chain(&pieces);
        let stops: Vec<_> = nodes.iter().map(|(n, s)| (Node { stop: true, ..*n }, *s)).collect();
        let [round, stop] = [&nodes, &stops]
            .map(|n| Timeline::plan_shapes(&limits, n).expect("a path").duration_s());
        prop_assert!(round <= stop * (1.0 + 1e-9), "{round} s, with stops {stop} s");
    }
}

/// 2πr/V and a change of velocity from rest and to rest: where the demand of the circle is small, the
/// closed form of a straight line of that length; where the circle binds, no more than its limit
/// allows and at least 95 % of it.
#[test]
fn law_a_full_circle() {
    let plan = |radius: f64, feed: f64, limits: &AxisLimits| {
        Timeline::plan_shapes(limits, &circle(radius, feed)).expect("a path").duration_s()
    };
    // The issue: radius 20 at F6000 with 2 m/s² and 20 m/s³: 0.4π s and 2 √(V/J) = 0.1414 s.
    let issue = limits(1e3, 2000.0, 20_000.0);
    let straight = 0.4 * std::f64::consts::PI + 2.0 * 0.005_f64.sqrt();
    let took = plan(20.0, 100.0, &issue);
    assert!((straight..1.02 * straight).contains(&took), "{took} s for {straight} s");
    // A demand of nearly nothing.
    let straight = std::f64::consts::TAU * 20.0 / 5.0 + 2.0 * (5.0_f64 / 20_000.0).sqrt();
    assert!((plan(20.0, 5.0, &issue) / straight - 1.0).abs() < 1e-5);
    // v² / r = a, and v³ / r² = j, on a hundred turns.
    for (limits, most) in [
        (limits(1e4, 2000.0, 1e7), (2000.0_f64 * 20.0).sqrt()),
        (limits(1e4, 1e6, 20_000.0), (20_000.0_f64 * 400.0).cbrt()),
    ] {
        let turn = arc(20.0, 0.0, 100.0 * std::f64::consts::TAU, 0.0);
        let [start, end] = [1.0, turn.length].map(|length| node([0.0; 6], length, 1e4));
        let nodes = [(start, Shape::Line), (end, Shape::Arc(turn))];
        let took = Timeline::plan_shapes(&limits, &nodes).expect("a path").duration_s();
        let least = turn.length / most;
        assert!((1.0..1.05).contains(&(took / least)), "{took} s, at least {least} s");
    }
}

/// One line is the profile of seven phases, two with a stop between them twice that, and with a corner
/// of 90° that may be rounded never more.
#[test]
fn law_lines_and_a_corner() {
    // 300 mm at 300 mm/s, 2 m/s², 20 m/s³: 1 + 0.15 + 0.1 s.
    let issue = limits(1e3, 2000.0, 20_000.0);
    let one = [node([0.0; 6], 1.0, 1.0), node([300.0, 0.0, 0.0, 0.0, 0.0, 0.0], 300.0, 300.0)];
    let took = Timeline::plan(&issue, &one).expect("a path").duration_s();
    assert!((took - 1.25).abs() < 1e-9, "{took}");
    // The same in 300 blocks.
    let many: Vec<Node> =
        (0..=300).map(|k| node([f64::from(k), 0.0, 0.0, 0.0, 0.0, 0.0], 1.0, 300.0)).collect();
    let took = Timeline::plan(&issue, &many).expect("a path").duration_s();
    assert!((took - 1.25).abs() < 1e-9, "{took}");
    let corner = |tolerance: f64, stop: bool| {
        let node = |x: f64, y: f64| Node {
            tolerance: [tolerance; 6],
            stop,
            ..node([x, y, 0.0, 0.0, 0.0, 0.0], 50.0, 50.0)
        };
        let nodes = [node(0.0, 0.0), node(50.0, 0.0), node(50.0, 50.0)];
        Timeline::plan(&mill(), &nodes).expect("a path").duration_s()
    };
    // 1 s and 2 √(50/50000) = 0.063245 s for each of both.
    let stop = 2.0 * (1.0 + 2.0 * 1e-3_f64.sqrt());
    assert!((corner(0.0, true) - stop).abs() < 1e-9);
    let mut before = stop + 1e-9;
    for tolerance in [1e-4, 1e-3, 0.01, 0.1, 1.0, 3.0] {
        let took = corner(tolerance, false);
        assert!(took <= before, "{tolerance} mm: {took} s after {before} s");
        before = took + 1e-9;
    }
    assert!(before < stop - 0.05);
}
