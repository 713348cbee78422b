//! Cutter radius compensation against LinuxCNC's own interpreter (`oracles/linuxcnc_radius.py`).

#![allow(clippy::print_stdout, reason = "the figures for docs/validation.md")]

use trueaxis_nc::moves::{Axis, Plane};
use trueaxis_nc::{Control, MoveKind, NoLibrary, Program, Settings, Step, interpret};

const DATA: &str = include_str!("data/linuxcnc-radius.txt");

/// Theirs have four decimals.
const PRINTED_MM: f64 = 6e-5;

/// A call as the data have it: its letter and its numbers.
type Call = (char, Vec<f64>);

fn theirs(line: &str) -> Call {
    let mut words = line.split(' ');
    let kind = words.next().and_then(|w| w.chars().next()).expect("a letter");
    (kind, words.map(|w| w.parse().expect("a number")).collect())
}

/// Our calls, and the code of an error.
fn ours(text: &str) -> (Vec<Call>, Option<&'static str>) {
    let program = Program::new("p.ngc", text.as_bytes().to_vec(), Control::LinuxCnc);
    let mut calls = Vec::new();
    let outcome = interpret(&program, &NoLibrary, &Settings::default(), &mut |step| {
        let Step::Move(m) = step else { return };
        let place = [Axis::X, Axis::Y, Axis::Z].map(|a| m.target[a]).to_vec();
        calls.push(match m.kind {
            MoveKind::Rapid => ('R', place),
            MoveKind::Linear => ('L', place),
            MoveKind::Arc(arc) => {
                let [a, b, n] = arc.plane.axes();
                let turns = f64::from(arc.turns) * if arc.ccw { 1.0 } else { -1.0 };
                assert!(arc.plane != Plane::Yz);
                let [x, y] = arc.center_mm;
                ('A', vec![m.target[a], m.target[b], x, y, turns, m.target[n]])
            }
            other => panic!("{other:?}"),
        });
    });
    let severe = |p: &&trueaxis_input::Diagnostic| p.severity == trueaxis_input::Severity::Error;
    let code = outcome.problems.iter().find(severe).map(|p| p.code);
    (calls, code)
}

fn agree(a: &Call, b: &Call) -> bool {
    a.0 == b.0
        && a.1.len() == b.1.len()
        && a.1.iter().zip(&b.1).all(|(a, b)| (a - b).abs() < PRINTED_MM)
}

/// Whether an arc sweeps more than 5 rad; none of the written ones does. DIFFERENCE: where an arc is cut off
/// at both ends by more than its length, or no entry arc fits, LinuxCNC makes nearly a full circle through
/// the part; we refuse.
fn loops(calls: &[Call]) -> bool {
    let in_plane = |(kind, v): &Call, zx: bool| match kind {
        'A' => [v[0], v[1]],
        _ if zx => [v[2], v[0]],
        _ => [v[0], v[1]],
    };
    [false, true].into_iter().any(|zx| {
        calls.windows(2).filter(|pair| pair[1].0 == 'A').any(|pair| {
            let ([x, y], v) = (in_plane(&pair[0], zx), &pair[1].1);
            let (a, b) = ([x - v[2], y - v[3]], [v[0] - v[2], v[1] - v[3]]);
            let turned = (a[0] * b[1] - a[1] * b[0]).atan2(a[0] * b[0] + a[1] * b[1]);
            (turned * v[4].signum()).rem_euclid(std::f64::consts::TAU) > 5.0
        })
    })
}

#[test]
fn oracle_radius_compensation_of_linuxcnc() {
    let (mut count, mut refused, mut stricter, mut wrong) = (0, 0, 0, Vec::new());
    for case in DATA.split("program\n").skip(1) {
        count += 1;
        let (text, calls) = match (case.split_once("calls\n"), case.split_once("error\n")) {
            (Some((text, calls)), _) => (text, Ok(calls)),
            (_, Some((text, message))) => (text, Err(message.trim())),
            _ => panic!("{case}"),
        };
        let (ours, code) = ours(text);
        match calls {
            Err(_) if code.is_some() => refused += 1,
            Err(message) => wrong.push(format!("{text}LinuxCNC: {message}")),
            Ok(calls) => {
                let theirs: Vec<Call> = calls.lines().map(theirs).collect();
                if code.is_some() {
                    if loops(&theirs) {
                        stricter += 1;
                    } else {
                        wrong.push(format!("{text}ours: {code:?}"));
                    }
                    continue;
                }
                let same = ours.iter().zip(&theirs).take_while(|(a, b)| agree(a, b)).count();
                if same != ours.len().max(theirs.len()) {
                    let (a, b) = (ours.get(same), theirs.get(same));
                    wrong.push(format!("{text}call {same}: ours {a:?}, theirs {b:?}"));
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{}\n{} of {count} differ", wrong.join("\n"), wrong.len());
    println!("{count} contours: {refused} refused by both, {stricter} by us alone");
    assert!(stricter < count / 50);
    assert!(count >= 400 && refused > 40 && refused < count / 3);
}
