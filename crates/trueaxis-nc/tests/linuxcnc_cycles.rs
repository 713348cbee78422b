//! Drilling cycles and polar words against the end points of LinuxCNC's own interpreter
//! (`oracles/linuxcnc_cycles.py`).

use trueaxis_nc::moves::Axis;
use trueaxis_nc::{Control, NoLibrary, Program, Settings, Step, interpret};

const DATA: &str = include_str!("data/linuxcnc-cycles.txt");

type Point = [f64; 3];

fn numbers(line: &str) -> Point {
    let mut words = line.split(' ').map(|word| word.parse().expect("a number"));
    std::array::from_fn(|_| words.next().expect("three numbers"))
}

fn apart(a: &Point, b: &Point) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

fn ours(text: &str) -> Vec<Point> {
    let program = Program::new("p.ngc", text.as_bytes().to_vec(), Control::LinuxCnc);
    let mut points: Vec<Point> = Vec::new();
    let outcome = interpret(&program, &NoLibrary, &Settings::default(), &mut |step| {
        let Step::Move(m) = step else { return };
        let point = [Axis::X, Axis::Y, Axis::Z].map(|axis| m.target[axis]);
        // Theirs have four decimals.
        if points.last().is_none_or(|last| apart(last, &point) > 6e-5) {
            points.push(point);
        }
    });
    assert!(!outcome.problems.has_errors(), "{text}\n{:?}", outcome.problems);
    points
}

#[test]
fn oracle_cycles_and_polar_words_of_linuxcnc() {
    let mut count = 0;
    for case in DATA.split("program\n").skip(1) {
        let (text, points) = case.split_once("points\n").expect("points");
        let theirs: Vec<Point> = points.lines().map(numbers).collect();
        let ours = ours(text);
        assert_eq!(ours.len(), theirs.len(), "{text}");
        for (n, (a, b)) in ours.iter().zip(&theirs).enumerate() {
            assert!(apart(a, b) < 6e-5, "{text}point {n}: {a:?}, LinuxCNC {b:?}");
        }
        count += 1;
    }
    assert_eq!(count, 120);
}

fn problem_of(text: &str, control: Control) -> (&'static str, usize) {
    let program = Program::new("p.nc", text.as_bytes().to_vec(), control);
    let outcome = interpret(&program, &NoLibrary, &Settings::default(), &mut |_| ());
    let problem = outcome.problems.iter().next().expect("a problem");
    (problem.code, problem.place.line)
}

#[test]
fn polar_words_that_lead_nowhere() {
    for text in [
        "G0 @1\nM2\n",
        "G91 G0 @1 ^30\nM2\n",
        "G53 G0 @1 ^0\nM2\n",
        "G0 @5 ^0 X1\nM2\n",
        "G28 @1 ^0\nM2\n",
    ] {
        assert_eq!(problem_of(text, Control::LinuxCnc), ("polar-words", 1), "{text}");
    }
    assert_eq!(problem_of("G0 @5 ^1 @5\nM2\n", Control::LinuxCnc).0, "repeated-word");
}

/// FANUC ends a comment at its first `)`: the rest of the line is executed, a lone `)` means nothing.
#[test]
fn a_comment_in_a_comment() {
    assert_eq!(problem_of("(CUT (10)) G0 X1\nM30\n", Control::Fanuc), ("loose-comment-end", 1));
    assert_eq!(problem_of("(CUT (10) MM)\nM30\n", Control::Fanuc).1, 1);
    let ran = |text: &str| {
        let program = Program::new("p.nc", text.as_bytes().to_vec(), Control::Fanuc);
        let mut x = Vec::new();
        interpret(&program, &NoLibrary, &Settings::default(), &mut |step| {
            if let Step::Move(m) = step {
                x.push(m.target[Axis::X]);
            }
        });
        x
    };
    assert_eq!(ran("(CUT (10)) G0 X1\nM30\n"), [1.0]);
    assert_eq!(ran("(CUT (10) X5 MM)\nG0 X1\nM30\n"), Vec::<f64>::new());
}
