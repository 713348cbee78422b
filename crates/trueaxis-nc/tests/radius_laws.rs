//! Laws of cutter radius compensation over random contours: the distance of the centre, and what must not
//! change it.

mod support;

use std::fmt::Write;

use proptest::prelude::*;
use support::radius::{On, Piece, Point, path, placed};
use trueaxis_nc::Control::{self, Fanuc, Haas, Heidenhain, Sinumerik840d};

/// An element of a contour: its end, and the centre of an arc with its sense.
#[derive(Debug, Clone, Copy)]
struct Element {
    from: Point,
    to: Point,
    arc: Option<(Point, bool)>,
}

fn minus(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1]]
}

fn norm(a: Point) -> f64 {
    a[0].hypot(a[1])
}

/// By how much an arc turns from one point to another, rad.
fn sweep(from: Point, to: Point, (center, ccw): (Point, bool)) -> f64 {
    let (a, b) = (minus(from, center), minus(to, center));
    let turned = (a[0] * b[1] - a[1] * b[0]).atan2(a[0] * b[0] + a[1] * b[1]);
    let sign = if ccw { 1.0 } else { -1.0 };
    sign * (sign * turned).rem_euclid(std::f64::consts::TAU)
}

impl Element {
    fn at(&self, part: f64) -> Point {
        let Some((center, ccw)) = self.arc else {
            let d = minus(self.to, self.from);
            return [self.from[0] + part * d[0], self.from[1] + part * d[1]];
        };
        let angle = part * sweep(self.from, self.to, (center, ccw));
        let (a, (sin, cos)) = (minus(self.from, center), angle.sin_cos());
        [center[0] + a[0] * cos - a[1] * sin, center[1] + a[0] * sin + a[1] * cos]
    }

    /// The direction of the contour.
    fn tangent(&self, part: f64) -> Point {
        let Some((center, ccw)) = self.arc else { return minus(self.to, self.from) };
        let arm = minus(self.at(part), center);
        if ccw { [-arm[1], arm[0]] } else { [arm[1], -arm[0]] }
    }

    /// The distance of a point.
    fn distance(&self, p: Point) -> f64 {
        let ends = norm(minus(p, self.from)).min(norm(minus(p, self.to)));
        let foot = match self.arc {
            None => {
                let (d, v) = (minus(self.to, self.from), minus(p, self.from));
                let part = (d[0] * v[0] + d[1] * v[1]) / (d[0] * d[0] + d[1] * d[1]);
                (0.0..=1.0).contains(&part).then(|| norm(minus(p, self.at(part))))
            }
            Some((center, ccw)) => {
                let radius = norm(minus(self.from, center));
                let v = minus(p, center);
                let foot =
                    [center[0] + v[0] * radius / norm(v), center[1] + v[1] * radius / norm(v)];
                let part = sweep(self.from, foot, (center, ccw))
                    / sweep(self.from, self.to, (center, ccw));
                (part <= 1.0).then(|| norm(minus(p, foot)))
            }
        };
        foot.map_or(ends, |f| f.min(ends))
    }
}

/// A chain round the origin that does not come near itself.
fn wide_contour() -> impl Strategy<Value = Vec<Element>> {
    chain((20.0..40.0, -0.2..0.2, 0..3u8, 1.2..3.0))
}

/// A chain round the origin, with pointed corners and narrow places.
fn contour() -> impl Strategy<Value = Vec<Element>> {
    chain((10.0..40.0, -0.4..0.4, 0..3u8, 0.52..3.0))
}

/// Vertices at growing angles, joined by lines and arcs of less than 150°: distance of the origin, shift of
/// the angle, kind, radius per chord.
fn chain(
    vertex: impl Strategy<Value = (f64, f64, u8, f64)>,
) -> impl Strategy<Value = Vec<Element>> {
    prop::collection::vec(vertex, 4..10).prop_map(|vertices| {
        let step = 5.5 / vertices.len() as f64;
        let place = |(k, v): (usize, &(f64, f64, u8, f64))| {
            let (sin, cos) = ((k as f64 + v.1) * step).sin_cos();
            [v.0 * cos, v.0 * sin]
        };
        let places: Vec<Point> = vertices.iter().enumerate().map(place).collect();
        let each = places.windows(2).zip(&vertices);
        each.map(|(ends, (_, _, kind, bulge))| {
            let [from, to] = [ends[0], ends[1]];
            let d = minus(to, from);
            let radius = bulge * norm(d);
            let height = (radius * radius - norm(d) * norm(d) / 4.0).sqrt() / norm(d);
            let ccw = *kind == 1;
            let left = if ccw { height } else { -height };
            let center = [
                f64::midpoint(from[0], to[0]) - left * d[1],
                f64::midpoint(from[1], to[1]) + left * d[0],
            ];
            Element { from, to, arc: (*kind > 0).then_some((center, ccw)) }
        })
        .collect()
    })
}

/// The program zero in the workpiece frame, and the angle by which the program frame is turned about it, °.
type Zero = (Point, f64);

/// What changes at the corner before each element: where the program zero goes, and whether the tool length does.
type Change = (Option<Zero>, bool);

fn changes() -> impl Strategy<Value = Vec<Change>> {
    let zero = (-50.0..50.0, -50.0..50.0, -180.0..180.0).prop_map(|(x, y, a)| ([x, y], a));
    prop::collection::vec((prop::option::of(zero), any::<bool>()), 9)
}

/// Whether the contour turns away from the tool between two elements.
fn turns_away(before: &Element, next: &Element, left: bool) -> bool {
    let [a, b] = [before.tangent(1.0), next.tangent(0.0)];
    let turn = a[0] * b[1] - a[1] * b[0];
    if left { turn < -1e-3 } else { turn > 1e-3 }
}

/// The program of a contour whose state changes at outside corners.
fn changing(control: Control, contour: &[Element], changes: &[Change], left: bool) -> String {
    let side = if left { "G41" } else { "G42" };
    let (start, d) = match control {
        Fanuc => ("G21 G17 G90 G94 F500\nG54\nG0 X0 Y0\n", "D1"),
        _ => ("T1 D1\nM6\nG71 G17 G90 G94 F500 G0 X0 Y0\n", ""),
    };
    let [x, y] = contour[0].from;
    let mut text = format!("{start}{side} {d} G1 X{x:.12} Y{y:.12}\n");
    let (mut zero, mut turn_deg, mut height) = ([0.0, 0.0], 0.0, 0.0);
    let place = |p: Point, zero: Point, turn_deg: f64| {
        let (d, (sin, cos)) = (minus(p, zero), f64::to_radians(turn_deg).sin_cos());
        [cos * d[0] + sin * d[1], cos * d[1] - sin * d[0]]
    };
    for (n, e) in contour.iter().enumerate() {
        let outside = n > 0 && turns_away(&contour[n - 1], e, left);
        let (frame, length) = changes[n];
        if let Some((to, angle_deg)) = frame.filter(|_| outside) {
            (zero, turn_deg) = (to, angle_deg);
            let [x, y] = zero;
            let _ = match control {
                Fanuc => writeln!(text, "G69\nG10 L2 P1 X{x} Y{y}\nG68 X0 Y0 R{angle_deg}"),
                _ => writeln!(text, "TRANS X={x} Y={y}\nAROT RPL={angle_deg}"),
            };
        }
        if length && outside {
            height += 1.0;
            let _ = match control {
                Fanuc => writeln!(text, "G10 L10 P1 R{height}\nG43 H1"),
                _ => writeln!(text, "$TC_DP3[1,1]={height}\nD1"),
            };
        }
        let [x, y] = place(e.to, zero, turn_deg);
        let _ = match e.arc {
            None => writeln!(text, "G1 X{x:.12} Y{y:.12}"),
            Some((center, ccw)) => {
                let [i, j] = minus(place(center, zero, turn_deg), place(e.from, zero, turn_deg));
                let code = if ccw { "G3" } else { "G2" };
                writeln!(text, "{code} X{x:.12} Y{y:.12} I{i:.12} J{j:.12}")
            }
        };
    }
    let [x, y] = place([0.0, 0.0], zero, turn_deg);
    let _ = writeln!(text, "G40 G1 X{x:.12} Y{y:.12}\nM30");
    text
}

fn reversed(contour: &[Element]) -> Vec<Element> {
    let back =
        |e: &Element| Element { from: e.to, to: e.from, arc: e.arc.map(|(c, ccw)| (c, !ccw)) };
    contour.iter().rev().map(back).collect()
}

/// How a contour is written.
#[derive(Clone, Copy)]
struct Notation {
    left: bool,
    incremental: bool,
    by_radius: bool,
    /// Lines and arcs in two blocks each.
    halved: bool,
    /// With a mode of the rotary axes, of which the contour has none.
    rotary_mode: bool,
}

const PLAIN: Notation = Notation {
    left: true,
    incremental: false,
    by_radius: false,
    halved: false,
    rotary_mode: false,
};

/// The program of a contour with its entry and exit; the first element begins in this line.
const FIRST: u32 = 5;

fn written(control: Control, contour: &[Element], notation: Notation) -> String {
    let start = contour[0].from;
    let mut text = match control {
        Sinumerik840d => "T1\nM6\nG71 G17 G90 G94 F500 G0 X0 Y0\n",
        Heidenhain => "0 BEGIN PGM A MM\n1 TOOL CALL 1 Z S1\n2 L X+0 Y+0 R0 FMAX\n",
        _ => "G21 G17 G90 G94 F500\nG40\nG0 X0 Y0\n",
    }
    .to_owned();
    let klartext = control == Heidenhain;
    if klartext && notation.rotary_mode {
        text = text.trim_end().to_owned() + " M126\n";
    }
    let side = match (klartext, notation.left) {
        (true, true) => "RL F500",
        (true, false) => "RR F500",
        (false, true) => "G41 G1",
        (false, false) => "G42 G1",
    };
    let d = if matches!(control, Fanuc | Haas) { "D1" } else { "" };
    let [x, y] = start.map(|v| format!("{v:+.12}"));
    if klartext {
        let _ = writeln!(text, "3 L X{x} Y{y} {side}");
    } else {
        let _ = writeln!(text, "{side} {d} X{x} Y{y}");
        if notation.incremental {
            text = text.trim_end().to_owned() + "\nG91\n";
        }
    }
    let mut halves = Vec::new();
    for e in contour {
        let middle = e.at(0.5);
        match notation.halved {
            true => halves.extend([Element { to: middle, ..*e }, Element { from: middle, ..*e }]),
            false => halves.push(*e),
        }
    }
    for (n, e) in halves.iter().enumerate() {
        let to = if notation.incremental { minus(e.to, e.from) } else { e.to };
        let [x, y] = to.map(|v| format!("{v:+.12}"));
        let line = match e.arc {
            None if klartext => format!("L X{x} Y{y}"),
            None => format!("G1 X{x} Y{y}"),
            Some((c, ccw)) if klartext => {
                let sense = if ccw { "DR+" } else { "DR-" };
                format!("CC X{:+.12} Y{:+.12}\n{} C X{x} Y{y} {sense}", c[0], c[1], n + 5)
            }
            Some((c, ccw)) => {
                let code = if ccw { "G3" } else { "G2" };
                let arm = minus(c, e.from);
                let by = match notation.by_radius {
                    true if control == Sinumerik840d => format!("CR={:.12}", norm(arm)),
                    true => format!("R{:.12}", norm(arm)),
                    false => format!("I{:.12} J{:.12}", arm[0], arm[1]),
                };
                format!("{code} X{x} Y{y} {by}")
            }
        };
        let number = if klartext { format!("{} ", n + 4) } else { String::new() };
        let _ = writeln!(text, "{number}{line}");
    }
    text + if klartext { "98 L X+0 Y+0 R0\n99 END PGM A MM\n" } else { "G90 G40 G1 X0 Y0\nM30\n" }
}

/// The path between entry and exit; `None` if the tool does not fit.
fn centre(control: Control, contour: &[Element], notation: Notation) -> Option<Vec<Piece>> {
    centre_of(RADIUS, control, contour, notation)
}

fn centre_of(
    radius: f64,
    control: Control,
    contour: &[Element],
    notation: Notation,
) -> Option<Vec<Piece>> {
    let text = written(control, contour, notation);
    let (pieces, found) = path(control, &text, radius);
    let Some(first) = found.first() else { return Some(pieces[1..pieces.len() - 1].to_vec()) };
    assert_eq!(first.0, "tool-too-large", "{found:?}\n{text}");
    None
}

const RADIUS: f64 = 5.0;

/// Small enough for all places of a wide contour.
const SMALL: f64 = 1.5;

fn same(a: Option<&[Piece]>, b: Option<&[Piece]>) -> Result<(), TestCaseError> {
    prop_assert_eq!(a.is_some(), b.is_some());
    let (Some(a), Some(b)) = (a, b) else { return Ok(()) };
    prop_assert_eq!(a.len(), b.len());
    for (a, b) in a.iter().zip(b) {
        prop_assert!(norm(minus(a.to, b.to)) < 1e-6, "{:?} {:?}", a, b);
        prop_assert_eq!(a.arc.map(|(_, ccw)| ccw), b.arc.map(|(_, ccw)| ccw));
        let apart = a.arc.zip(b.arc).map_or(0.0, |(a, b)| norm(minus(a.0, b.0)));
        prop_assert!(apart < 1e-6, "{:?} {:?}", a, b);
    }
    Ok(())
}

/// Places on a path, with the block of each.
fn places(path: &[Piece]) -> Vec<(Point, u32)> {
    let mut out = Vec::new();
    for pair in path.windows(2) {
        let piece = Element { from: pair[0].to, to: pair[1].to, arc: pair[1].arc };
        out.extend((0..=20).map(|k| (piece.at(f64::from(k) / 20.0), pair[1].line)));
    }
    out
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, ..ProptestConfig::default() })]

    /// The centre is at the distance of the radius from the element that it runs along, and never nearer to
    /// its neighbours; arcs keep it there at corners too.
    #[test]
    fn law_the_centre_keeps_its_distance(contour in wide_contour(), left: bool) {
        for control in [Sinumerik840d, Fanuc] {
            let Some(path) = centre_of(SMALL, control, &contour, Notation { left, ..PLAIN }) else { continue };
            for (p, line) in places(&path) {
                let index = (line - FIRST + u32::from(control == Fanuc)) as usize;
                let index = index - usize::from(control == Fanuc);
                let near = &contour[index.saturating_sub(1)..(index + 2).min(contour.len())];
                let least = near.iter().map(|e| e.distance(p)).fold(f64::INFINITY, f64::min);
                prop_assert!(least > SMALL - 1e-6, "{control:?} {p:?} in line {line}: {least}");
                if control == Sinumerik840d {
                    prop_assert!(least < SMALL + 1e-6, "{control:?} {p:?} in line {line}: {least}");
                }
            }
        }
    }

    /// Neither the notation nor the control changes the path.
    #[test]
    fn law_notation_does_not_count(contour in contour(), left: bool) {
        let plain = Notation { left, ..PLAIN };
        let path = centre(Sinumerik840d, &contour, plain);
        for notation in [
            Notation { incremental: true, ..plain },
            Notation { by_radius: true, ..plain },
            Notation { incremental: true, by_radius: true, ..plain },
        ] {
            same(path.as_deref(), centre(Sinumerik840d, &contour, notation).as_deref())?;
        }
        for rotary_mode in [false, true] {
            let notation = Notation { rotary_mode, ..plain };
            same(path.as_deref(), centre(Heidenhain, &contour, notation).as_deref())?;
        }
        let fanuc = centre(Fanuc, &contour, plain);
        same(fanuc.as_deref(), centre(Haas, &contour, Notation { incremental: true, by_radius: true, ..plain }).as_deref())?;
    }

    /// Run backwards with the tool on the other side, the path is the same backwards.
    #[test]
    fn law_backwards_on_the_other_side(contour in contour(), left: bool) {
        for control in [Sinumerik840d, Fanuc] {
            let path = centre(control, &contour, Notation { left, ..PLAIN });
            let back = centre(control, &reversed(&contour), Notation { left: !left, ..PLAIN });
            prop_assert_eq!(path.is_some(), back.is_some());
            let (Some(path), Some(mut back)) = (path, back) else { continue };
            back.reverse();
            prop_assert_eq!(path.len(), back.len());
            for (a, b) in path.iter().zip(&back) {
                prop_assert!(norm(minus(a.to, b.to)) < 1e-6);
            }
        }
    }

    /// Other frames and tool lengths on the way do not change the path at outside corners.
    #[test]
    fn law_changes_of_state_do_not_count(contour in wide_contour(), changes in changes(), left: bool) {
        let none = vec![(None, false); 9];
        for control in [Sinumerik840d, Fanuc] {
            let run = |changes: &[Change]| {
                placed(control, &changing(control, &contour, changes, left), SMALL, On::Workpiece)
            };
            let ((plain, first), (changed, second)) = (run(&none), run(&changes));
            prop_assert_eq!(first.len(), second.len(), "{:?} {:?}", first, second);
            if !first.is_empty() {
                continue;
            }
            for (found, other) in [(&plain, &changed), (&changed, &plain)] {
                for (p, _) in places(found) {
                    let off = other.windows(2).map(|w| {
                        Element { from: w[0].to, to: w[1].to, arc: w[1].arc }.distance(p)
                    });
                    let off = off.fold(f64::INFINITY, f64::min);
                    prop_assert!(off < 1e-6, "{control:?} {p:?} {off}\n{}", changing(control, &contour, &changes, left));
                }
            }
        }
    }

    /// Elements in two blocks give the same path, with one more place each; a corner that takes more than the
    /// half of an element is refused then.
    #[test]
    fn law_two_halves_are_the_whole(contour in contour(), left: bool) {
        let whole = centre(Sinumerik840d, &contour, Notation { left, ..PLAIN });
        let halves = centre(Sinumerik840d, &contour, Notation { left, halved: true, ..PLAIN });
        let (Some(whole), Some(halves)) = (&whole, &halves) else {
            prop_assert!(whole.is_some() || halves.is_none());
            return Ok(());
        };
        for (p, _) in places(halves) {
            let along = whole.windows(2).map(|w| Element { from: w[0].to, to: w[1].to, arc: w[1].arc }.distance(p));
            prop_assert!(along.fold(f64::INFINITY, f64::min) < 1e-6);
        }
    }
}

/// Most of the contours have room for the tool: otherwise the laws would say little.
#[test]
fn most_contours_have_room() {
    use proptest::strategy::ValueTree;
    let mut runner = proptest::test_runner::TestRunner::deterministic();
    let fits = (0..200).filter(|k| {
        let contour = contour().new_tree(&mut runner).expect("a contour").current();
        centre(Sinumerik840d, &contour, Notation { left: k % 2 == 0, ..PLAIN }).is_some()
    });
    let fits = fits.count();
    assert!((120..=198).contains(&fits), "{fits} of 200");
}
