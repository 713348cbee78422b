//! G5, G5.1 and G5.2 against what LinuxCNC's own functions draw (`oracles/linuxcnc_splines.py`).

use trueaxis_nc::moves::{Axis, MoveKind};
use trueaxis_nc::{Control, NoLibrary, Program, Settings, Step, interpret};

const DATA: &str = include_str!("data/linuxcnc-splines.txt");

/// End, centre and sense of an arc; the end of a line.
type Drawn = Vec<f64>;

fn run(text: &str) -> (Vec<Drawn>, Vec<&'static str>) {
    let program = Program::new("p.ngc", text.as_bytes().to_vec(), Control::LinuxCnc);
    let mut drawn = Vec::new();
    let outcome = interpret(&program, &NoLibrary, &Settings::default(), &mut |step| {
        let Step::Move(m) = step else { return };
        let end = [m.target[Axis::X], m.target[Axis::Y]];
        match &m.kind {
            MoveKind::Arc(arc) => {
                let ccw = f64::from(u8::from(arc.ccw));
                drawn.push([&end[..], &arc.center_mm[..], &[ccw]].concat());
            }
            _ => drawn.push(end.to_vec()),
        }
    });
    (drawn, outcome.problems.iter().map(|p| p.code).collect())
}

/// The point halfway on an arc, or on a line.
fn middle(from: &Drawn, piece: &Drawn) -> [f64; 2] {
    let [_, _, x, y, ccw] = piece[..] else {
        return [0, 1].map(|i| f64::midpoint(from[i], piece[i]));
    };
    let angle = |p: &Drawn| (p[1] - y).atan2(p[0] - x);
    let (begin, end) = if ccw == 1.0 { (from, piece) } else { (piece, from) };
    let half = (angle(end) - angle(begin)).rem_euclid(std::f64::consts::TAU) / 2.0;
    let (sin, cos) = half.sin_cos();
    let [dx, dy] = [begin[0] - x, begin[1] - y];
    [x + dx * cos - dy * sin, y + dx * sin + dy * cos]
}

/// Every second end is a point of the curve: to the rounding of nine decimals. Between them LinuxCNC takes its
/// tangents from differences over 1e-5 of the parameter, which moves its arcs by up to 1e-4 mm.
#[test]
fn oracle_splines_of_linuxcnc() {
    let (mut count, mut worst) = (0, 0.0_f64);
    for case in DATA.split("program\n").skip(1) {
        let (text, drawn) = case.split_once("drawn\n").expect("drawn");
        let numbers = |line: &str| line.split(' ').skip(1).map(|w| w.parse().unwrap()).collect();
        let theirs: Vec<Drawn> = drawn.lines().map(numbers).collect();
        let (ours, problems) = run(text);
        assert!(problems.is_empty(), "{text}{problems:?}");
        // The rapid to the start comes first.
        assert_eq!(ours.len(), theirs.len() + 1, "{text}");
        let mut before = [&ours[0], &ours[0]];
        for (n, (our, their)) in ours[1..].iter().zip(&theirs).enumerate() {
            let apart = |a: &[f64], b: &[f64]| (a[0] - b[0]).hypot(a[1] - b[1]);
            assert!(n % 2 == 0 || apart(our, their) < 2e-9, "{text}{our:?} {their:?}");
            let halfway = apart(&middle(before[0], our), &middle(before[1], their));
            worst = worst.max(halfway).max(apart(our, their));
            assert!(worst < 1e-4, "{text}{our:?} {their:?} {worst}");
            before = [our, their];
        }
        count += 1;
    }
    assert_eq!(count, 40);
}

/// G5 with I J only: the second cubic goes on in the direction of the first (user manual, "G5 Cubic Spline"),
/// here as the mirror image of it.
#[test]
fn the_next_cubic_goes_on_smoothly() {
    let head = "G21 G17 G90 F100\nG0 X0 Y0\nG5 I0 J3 P0 Q-3 X1 Y1\n";
    let (smooth, problems) = run(&format!("{head}G5 P0 Q-3 X2 Y2\nM2\n"));
    let (written, _) = run(&format!("{head}G5 I0 J3 P0 Q-3 X2 Y2\nM2\n"));
    assert!(problems.is_empty() && smooth.len() == 65);
    assert_eq!(smooth, written);
    // Incremental words and the place after it.
    let (incremental, _) = run(&format!("{head}G91 G5 I0 J3 P0 Q-3 X1 Y1\nG1 X1\nM2\n"));
    assert_eq!((&incremental[..65], &incremental[65][..2]), (&written[..], &[3.0, 2.0][..]));
}

/// A parabola: every second end lies on y = x².
#[test]
fn the_parabola_of_the_manual() {
    let (drawn, problems) = run("G21 G17 G90 F100\nG0 X-2 Y4\nG5.1 X2 Y4 I2 J-8\nM2\n");
    assert!(problems.is_empty() && drawn.len() == 25, "{problems:?} {}", drawn.len());
    for arc in drawn.iter().skip(2).step_by(2) {
        assert!((arc[1] - arc[0] * arc[0]).abs() < 1e-12, "{arc:?}");
    }
    assert_eq!(drawn[24][..2], [2.0, 4.0]);
}

/// G5.2 in the other planes, as in LinuxCNC's development version (2.9 takes X and Y only).
#[test]
fn nurbs_in_other_planes() {
    let points = [("1", "0", ""), ("4", "2", "P1"), ("2", "5", "P2"), ("0", "4", "P1")];
    let text = |plane: &str, [a, b]: [&str; 2]| {
        let mut text = format!("G21 {plane} G90 F100\nG0 {a}1 {b}0\nG5.2 P1.5 L3\n");
        for (x, y, p) in &points[1..] {
            text += &format!("{a}{x} {b}{y} {p}\n");
        }
        text + "G5.3\nM2\n"
    };
    let (xy, problems) = run(&text("G17", ["X", "Y"]));
    assert!(problems.is_empty() && xy.len() == 33, "{problems:?}");
    let (yz, problems) = run(&text("G19", ["Y", "Z"]));
    assert!(problems.is_empty());
    // Centres are in the plane: the same numbers.
    assert!(yz.iter().zip(&xy).skip(1).all(|(a, b)| a[2..] == b[2..]));
}

#[test]
fn splines_that_are_not_complete() {
    for text in [
        "G5 X1 Y1 P0 Q-1",
        "G5 X1 Y1 I0 J1 P0",
        "G5 X1 Y1 I0 P0 Q1",
        "G5.1 X1 Y1 I1",
        "G5 X1 Y1 Z1 I0 J1 P0 Q-1",
        "G18 G5 X1 I0 J1 P0 Q-1",
        "G5.3",
        "G5.2 P1 L3\nX1 Y1 P1\nG5.3",
        "G5.2 P1 L3\nX1 P1\nX2 Y2 P1\nG5.3",
        "G5.2 P1 L3\nX1 Y1\nX2 Y2 P1\nG5.3",
        "G5.2 P1 L3\nX1 Y1 P0\nX2 Y2 P1\nG5.3",
        "G5.2 P1 L3.5\nX1 Y1 P1\nX2 Y2 P1\nG5.3",
    ] {
        let (_, problems) = run(&format!("G21 G17 G90 F100\nG0 X0 Y0\n{text}\nM2\n"));
        assert_eq!(problems, ["bad-spline"], "{text}");
    }
}
