//! Laws of turning cycles over random profiles: what must not change them, and what they never touch.

use proptest::prelude::*;
use trueaxis_nc::moves::{Axis, MoveKind};
use trueaxis_nc::{Control, NoLibrary, Program, Settings, Step, interpret};

type Point = [f64; 2];

/// A move: rapid or not, X and Z, the centre of an arc.
type Way = (bool, Point, Option<Point>);

fn ways(text: &str) -> Vec<Way> {
    let program = Program::new("p.ngc", text.as_bytes().to_vec(), Control::LinuxCnc);
    let mut ways = Vec::new();
    let outcome = interpret(&program, &NoLibrary, &Settings::default(), &mut |step| {
        let Step::Move(m) = step else { return };
        let center = match m.kind {
            MoveKind::Arc(arc) => Some([arc.center_mm[1], arc.center_mm[0]]),
            _ => None,
        };
        ways.push((m.kind == MoveKind::Rapid, [m.target[Axis::X], m.target[Axis::Z]], center));
    });
    assert!(!outcome.problems.has_errors(), "{text}{:?}", outcome.problems);
    ways
}

fn equal(a: &[Way], b: &[Way]) -> bool {
    let close = |p: &Point, q: &Point| (p[0] - q[0]).hypot(p[1] - q[1]) < 1e-6;
    a.len() == b.len()
        && a.iter().zip(b).all(|(a, b)| {
            let centers = match (a.2, b.2) {
                (Some(p), Some(q)) => close(&p, &q),
                (p, q) => p == q,
            };
            a.0 == b.0 && close(&a.1, &b.1) && centers
        })
}

/// Lines, seen from the side: steps along −Z, and the X of each point; every second one an arc, if that is so.
#[derive(Debug, Clone)]
struct Shape {
    points: Vec<Point>,
    arcs: bool,
}

fn shape(arcs: bool) -> impl Strategy<Value = Shape> {
    let step = (20_u32..60, 30_u32..120);
    prop::collection::vec(step, 3..9).prop_map(move |steps| {
        let mut z = 0.0;
        let mut points: Vec<Point> = steps
            .iter()
            .map(|(along, x)| {
                z -= f64::from(*along) / 10.0;
                [f64::from(*x) / 10.0, z]
            })
            .collect();
        // The end is farther out than all others, the start than the end.
        points.push([13.0, z - 2.0]);
        Shape { points, arcs }
    })
}

const START: Point = [15.0, 1.5];

/// How a program is written.
#[derive(Debug, Clone, Copy)]
struct Style {
    head: &'static str,
    /// Units of X, and of all else.
    x: f64,
    unit: f64,
    relative: bool,
    backwards: bool,
    /// The start is in a block of its own.
    apart: bool,
}

const PLAIN: Style =
    Style { head: "", x: 1.0, unit: 1.0, relative: false, backwards: false, apart: false };

fn program(shape: &Shape, style: Style, code: &str, words: &[(char, f64)]) -> String {
    let Style { head, x, unit, .. } = style;
    let pair = |a: String, b: String| {
        if style.backwards { format!("{b} {a}") } else { format!("{a} {b}") }
    };
    let place = |p: Point| pair(format!("X{:.13}", p[0] * x), format!("Z{:.13}", p[1] * unit));
    let mut text = format!("G18 G21 G8 G90 F100\n{head}\nG0 {}\nO7 SUB\n", place([20.0, 5.0]));
    let mut last = [START[0], START[1]];
    for (n, p) in shape.points.iter().enumerate() {
        let code = match (n, shape.arcs && n % 2 == 0) {
            (0, _) => "G0",
            (_, true) => "G2",
            _ => "G1",
        };
        let by = [(p[0] - last[0]) * x, (p[1] - last[1]) * unit];
        let to = match style.relative {
            true => pair(format!("U{:.13}", by[0]), format!("W{:.13}", by[1])),
            false => place(*p),
        };
        // An arc that turns by less than 20 degrees hardly ever turns back.
        let chord = (p[0] - last[0]).hypot(p[1] - last[1]);
        let round =
            if code == "G2" { format!(" R{:.13}", 3.0 * chord * unit) } else { String::new() };
        text += &format!("{code} {to}{round}\n");
        last = *p;
    }
    text += "O7 ENDSUB\n";
    let words: String = words.iter().map(|(l, v)| format!(" {l}{:.13}", v * unit)).collect();
    let start = place(START);
    match style.apart {
        true => text += &format!("G0 {start}\n{code} Q7{words}\n"),
        false => text += &format!("{code} {start} Q7{words}\n"),
    }
    text + "G0 X0 Z0\nM2\n"
}

fn moves_of(shape: &Shape, style: Style, code: &str, words: &[(char, f64)]) -> Vec<Way> {
    ways(&program(shape, style, code, words))
}

/// How far a point is from a line between two others.
fn distance(p: Point, a: Point, b: Point) -> f64 {
    let (d, v) = ([b[0] - a[0], b[1] - a[1]], [p[0] - a[0], p[1] - a[1]]);
    let part = ((d[0] * v[0] + d[1] * v[1]) / (d[0] * d[0] + d[1] * d[1])).clamp(0.0, 1.0);
    (v[0] - part * d[0]).hypot(v[1] - part * d[1])
}

/// Points on all moves, rapid ones too.
fn samples(ways: &[Way]) -> Vec<Point> {
    let mut out = Vec::new();
    for pair in ways.windows(2) {
        let ((_, a, _), (_, b, center)) = (pair[0], pair[1]);
        for n in 0..=20 {
            let part = f64::from(n) / 20.0;
            let chord = [a[0] + part * (b[0] - a[0]), a[1] + part * (b[1] - a[1])];
            // Their arcs are outer corners, less than half a turn: out from the centre.
            let p = center.map_or(chord, |c| {
                let (out, r) =
                    ([chord[0] - c[0], chord[1] - c[1]], (a[0] - c[0]).hypot(a[1] - c[1]));
                let l = out[0].hypot(out[1]);
                [c[0] + out[0] * r / l, c[1] + out[1] * r / l]
            });
            out.push(p);
        }
    }
    out
}

proptest! {
    #[test]
    fn law_the_way_of_writing_does_not_change_a_turning_cycle(
        shape in (any::<bool>()).prop_flat_map(shape),
        code in prop::sample::select(vec!["G71", "G71.1", "G71.2", "G70"]),
        leave in 0_u32..2,
    ) {
        let leave = f64::from(leave) * 0.3;
        let words: &[(char, f64)] = match code {
            "G70" => &[('D', leave), ('E', leave / 2.0)],
            _ => &[('D', leave), ('I', 0.7137), ('R', 0.4)],
        };
        // An arc may turn back, or be too narrow for D: then it is refused in each way of writing.
        let text = program(&shape, PLAIN, code, words);
        let checked = Program::new("p.ngc", text.clone().into_bytes(), Control::LinuxCnc);
        let outcome = interpret(&checked, &NoLibrary, &Settings::default(), &mut |_| ());
        prop_assume!(!outcome.problems.has_errors());
        let plain = ways(&text);
        prop_assert!(plain.len() > 3);
        let mut styles = vec![
            Style { head: "G7", x: 2.0, ..PLAIN },
            Style { relative: true, ..PLAIN },
            Style { relative: true, head: "G7", x: 2.0, ..PLAIN },
            Style { backwards: true, ..PLAIN },
            Style { apart: true, ..PLAIN },
            Style { head: "T2 M6 G43\nG10 L2 P2 X7 Z-3\nG55", ..PLAIN },
            Style { head: "(a comment)\nG92.1 M3 S500 G40", backwards: true, apart: true, ..PLAIN },
        ];
        if leave == 0.0 {
            // Which arcs are too short to be made depends on the unit.
            let inch = 1.0 / 25.4;
            styles.push(Style { head: "G20", x: inch, unit: inch, ..PLAIN });
        }
        for style in styles {
            let other = moves_of(&shape, style, code, words);
            prop_assert!(equal(&plain, &other), "{style:?}\n{plain:?}\n{other:?}");
        }
    }

    #[test]
    fn law_a_turning_cycle_keeps_its_distance_from_the_profile(
        shape in shape(false),
        code in prop::sample::select(vec!["G71", "G71.1", "G71.2", "G70"]),
        leave in 1_u32..12,
    ) {
        let leave = f64::from(leave) / 10.0;
        let words: &[(char, f64)] = match code {
            "G70" => &[('E', leave)],
            _ => &[('D', leave), ('I', 0.7137), ('R', 0.4)],
        };
        let text = program(&shape, PLAIN, code, words);
        let checked = Program::new("p.ngc", text.clone().into_bytes(), Control::LinuxCnc);
        let outcome = interpret(&checked, &NoLibrary, &Settings::default(), &mut |_| ());
        // A first or last element may be too short for the distance; one that lies inside says so.
        prop_assume!(outcome.problems.iter().next().is_none());
        let ways = ways(&text);
        let inner = &ways[1..ways.len() - 1];
        let mut nearest = f64::INFINITY;
        // The way in may come nearer: it ends where the first element is shifted to, from another direction.
        let beyond = |p: &Point| p[1] <= shape.points[0][1] - leave;
        for p in samples(inner).into_iter().filter(beyond) {
            let near = shape.points.windows(2).map(|l| distance(p, l[0], l[1])).fold(f64::INFINITY, f64::min);
            prop_assert!(near > leave - 1e-6, "{text}{p:?} is {near} from the profile");
            nearest = nearest.min(near);
        }
        prop_assert!((nearest - leave).abs() < 1e-6, "{text}{nearest}");
    }
}
