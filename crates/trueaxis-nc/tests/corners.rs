//! Roundings and chamfers: RND and CHF, RND=, RNDM=, CHF= and CHR=, `,R` and `,C`.

use proptest::prelude::*;
use trueaxis_nc::moves::{Feed, FeedMode, Move, MoveKind};
use trueaxis_nc::{Control, NoLibrary, Outcome, Program, Settings, Step, interpret};

fn run(control: Control, text: &str) -> (Vec<Move>, Outcome) {
    let program = Program::new("p", text.as_bytes().to_vec(), control);
    let mut moves = Vec::new();
    let outcome = interpret(&program, &NoLibrary, &Settings::default(), &mut |s| {
        if let Step::Move(m) = s {
            moves.push(m);
        }
    });
    (moves, outcome)
}

fn sound(control: Control, text: &str) -> Vec<Move> {
    let (moves, outcome) = run(control, text);
    let problems: Vec<_> = outcome.problems.iter().map(ToString::to_string).collect();
    assert!(outcome.finished && problems.is_empty(), "{text}\n{problems:?}");
    moves
}

/// Kind (R, L, or the centre and sense of an arc), X, Y, Z of each move.
fn shown(moves: &[Move]) -> Vec<(String, [f64; 3])> {
    let kind = |m: &Move| match m.kind {
        MoveKind::Arc(arc) => {
            let [x, y] = arc.center_mm;
            format!("{}{:.6} {:.6}", if arc.ccw { "+" } else { "-" }, x + 0.0, y + 0.0)
        }
        MoveKind::Linear => "L".to_owned(),
        _ => "R".to_owned(),
    };
    moves.iter().map(|m| (kind(m), [m.target.0[0], m.target.0[1], m.target.0[2]])).collect()
}

fn assert_close(a: &[(String, [f64; 3])], b: &[(String, [f64; 3])], what: &str) {
    assert_eq!(a.len(), b.len(), "{what}\n{a:?}\n{b:?}");
    for ((kind, p), (other, q)) in a.iter().zip(b) {
        let numbers = |t: &str| {
            t.trim_start_matches(['+', '-'])
                .split(' ')
                .filter_map(|w| w.parse::<f64>().ok())
                .collect()
        };
        let (x, y): (Vec<f64>, Vec<f64>) = (numbers(kind), numbers(other));
        let same = kind.chars().next() == other.chars().next()
            && x.len() == y.len()
            && x.iter().zip(&y).all(|(x, y)| (x - y).abs() < 2e-6);
        let near = p.iter().zip(q).all(|(x, y)| (x - y).abs() < 1e-6);
        assert!(same && near, "{what}\n{a:?}\n{b:?}");
    }
}

/// The example of the iTNC 530 manual "Corner rounding RND": the corner at X40 Y25 of lines from X10 Y40
/// and to X10 Y5 with R5.
///
/// By hand: the lines run along (30, -15) and (-30, -20); cos of the angle between the unit vectors back
/// (-2, 1)/√5 and on (-3, -2)/√13 is 4/√65, so half of it has the tangent √((√65 - 4)/(√65 + 4)), and the
/// touching points lie 5/tan from the corner.
#[test]
fn a_rounding_of_the_manual_with_its_own_feed() {
    let text =
        "BEGIN PGM a MM\nL X+10 Y+40 R0 F300\nL X+40 Y+25\nRND R5 F100\nL X+10 Y+5\nEND PGM a MM\n";
    let moves = sound(Control::Heidenhain, text);
    let root = 65.0_f64.sqrt();
    let far = 5.0 / ((root - 4.0) / (root + 4.0)).sqrt();
    let (a, b) = (5.0_f64.sqrt(), 13.0_f64.sqrt());
    let touch = |m: &Move, x: f64, y: f64| {
        assert!((m.target.0[0] - x).abs() < 1e-9 && (m.target.0[1] - y).abs() < 1e-9, "{m:?}");
    };
    assert_eq!(moves.len(), 4);
    touch(&moves[1], 40.0 - 2.0 * far / a, 25.0 + far / a);
    touch(&moves[2], 40.0 - 3.0 * far / b, 25.0 - 2.0 * far / b);
    touch(&moves[3], 10.0, 5.0);
    let feeds: Vec<_> = moves.iter().map(|m| m.feed.value).collect();
    assert_eq!(feeds, [300.0, 300.0, 100.0, 300.0]);
    assert_eq!(moves[2].feed, Feed { mode: FeedMode::PerMinute, value: 100.0 });
}

/// The same contour, written in the words of each control.
#[test]
fn three_controls_round_and_cut_alike() {
    let klartext = sound(
        Control::Heidenhain,
        "L X+0 Y+0 Z-1 R0 F100\nL X+20\nRND R4\nL Y+20\nCHF 3\nL X+0\nRND R2\nCR X-10 Y+10 R+10 DR-\nRND R1\nL X-10 Y+25\n",
    );
    let iso = "X0 Y0 Z-1.\nX20.,R4.\nY20.,C3.\nX0,R2.\nG2 X-10. Y10. R10.,R1.\nG1 Y25.\n";
    let fanuc = sound(Control::Fanuc, &format!("G90 G1 F100.\n{iso}M30\n"));
    let mpf = sound(
        Control::Sinumerik840d,
        "G90 G1 F100\nX0 Y0 Z-1\nX20 RND=4\nY20 CHR=3\nX0 RND=2\nG2 X-10 Y10 CR=10 RND=1\nG1 Y25\nM30\n",
    );
    let (k, f, m) = (shown(&klartext), shown(&fanuc), shown(&mpf));
    assert_close(&k, &f, "HEIDENHAIN and FANUC");
    assert_close(&k, &m, "HEIDENHAIN and SINUMERIK");
    assert_eq!((k[1].1, k[2].1), ([16.0, 0.0, -1.0], [20.0, 4.0, -1.0]));
    assert_eq!((k[3].1, k[4].1), ([20.0, 17.0, -1.0], [17.0, 20.0, -1.0]));
    assert_eq!(k.len(), 10);
}

/// A rounding is seen whatever stands between the number of its block and RND, and after comments.
#[test]
fn blanks_and_comments_before_a_rounding_change_nothing() {
    let with = |between: &str, rounding: &str| {
        let text =
            format!("1 L X+0 Y+0 Z-1 R0 F100\n2 L X+20\n{between}3{rounding}RND R4\n4 L Y+20\n");
        shown(&sound(Control::Heidenhain, &text))
    };
    let plain = with("", " ");
    assert_eq!(plain.len(), 4);
    for (between, rounding) in
        [("", "\t"), ("", ""), ("; corner\n\n* - side\n", " \t "), ("\r\n", "  ")]
    {
        assert_close(&with(between, rounding), &plain, "rounding");
    }
}

/// CHF is the length of the chamfer, CHR its legs: at a right angle CHF = √2 · CHR.
#[test]
fn sinumerik_chamfers_by_length_and_leg_and_modal_roundings() {
    let by = |word: &str| {
        let text = format!("G1 G90 F100 X0 Y0\nX20 {word}\nY20\nM30\n");
        shown(&sound(Control::Sinumerik840d, &text))
    };
    assert_close(&by("CHF=2.8284271247461903"), &by("CHR=2"), "CHF and CHR");
    let each = "G1 F100 X0 Y0\nX20 RND=2\nY20 RND=2\nX0 Y0\nM30\n";
    let modal = "RNDM=2 FRCM=50\nG1 F100 X0 Y0\nX20\nY20\nG0 Z50\nG1 X0 Y0\nRNDM=0\nM30\n";
    let plain = sound(Control::Sinumerik840d, each);
    let moves = sound(Control::Sinumerik840d, modal);
    // The corner at X20 Y0 in both; before the rapid there is none.
    assert_close(&shown(&plain)[..3], &shown(&moves)[..3], "RND and RNDM");
    assert_eq!(moves[3].target.0[..2], [20.0, 20.0]);
    assert_eq!(
        [moves[1].feed.value, moves[2].feed.value, moves[3].feed.value],
        [100.0, 50.0, 100.0]
    );
}

/// The axis that stands on the plane goes on evenly: at each point of the plane its height is on the line
/// between the programmed heights.
#[test]
fn heights_are_kept_beside_the_corner() {
    let moves = sound(Control::Sinumerik840d, "G1 F100 X0 Y0 Z0\nX20 Z-2 RND=5\nY20 Z-4\nM30\n");
    let heights: Vec<_> = moves.iter().map(|m| m.target.0[2]).collect();
    assert_eq!(heights, [0.0, -1.5, -2.5, -4.0]);
}

#[test]
fn a_corner_that_does_not_fit_is_reported_and_stays_sharp() {
    for (control, text) in [
        (Control::Fanuc, "G1 F100. X0 Y0\nX10.,R30.\nY10.\nM30\n"),
        (Control::Fanuc, "G1 F100. X0 Y0\nX10.,R3.\nG0 Z10.\nM30\n"),
        (Control::Fanuc, "G1 F100. X0 Y0\nX10.,R3.\nM30\n"),
        (Control::Fanuc, "G1 F100. X0 Y0\nX10.,R3.\nZ-5.\nY10.\nM30\n"),
        (Control::Sinumerik840d, "G1 F100 X0 Y0\nX10 RND=30\nY10\nM30\n"),
        (Control::Sinumerik840d, "RNDM=30\nG1 F100 X0 Y0\nX10\nY10\nM30\n"),
        (Control::Sinumerik840d, "G1 F100 X0 Y0\nX10\nRND=3\nY10\nM30\n"),
        (Control::Heidenhain, "L X+0 Y+0 F100\nL X+10\nRND R30\nL Y+10\n"),
        (Control::Heidenhain, "L X+0 Y+0 F100\nL X+10\nM8\nRND R3\nL Y+10\n"),
    ] {
        let (moves, outcome) = run(control, text);
        let codes: Vec<_> = outcome.problems.iter().map(|p| p.code).collect();
        assert_eq!(codes, ["not-applied"], "{text}");
        assert!(outcome.finished);
        assert!(moves.iter().any(|m| m.target.0[..2] == [10.0, 0.0]), "{text}");
    }
    let (_, outcome) = run(Control::Fanuc, "G1 F100.\n,R3.\nM30\n");
    assert!(outcome.problems.has_errors());
}

/// A corner between two straight moves: its distance from the corner and the kind.
#[derive(Debug, Clone, Copy)]
struct Side {
    length: f64,
    turn_deg: f64,
    round: bool,
    size: f64,
}

fn sides() -> impl Strategy<Value = Vec<Side>> {
    let side = (20.0..60.0, 20.0..120.0, any::<bool>(), any::<bool>(), 0.5..4.0).prop_map(
        |(length, turn, left, round, size)| {
            let turn_deg: f64 = if left { turn } else { -turn };
            Side { length, turn_deg, round, size }
        },
    );
    prop::collection::vec(side, 2..8)
}

/// The corners of a chain of sides.
fn points(sides: &[Side]) -> Vec<([f64; 2], Side)> {
    let (mut at, mut heading) = ([0.0, 0.0], 0.0_f64);
    let step = |side: &Side| {
        at = [at[0] + side.length * heading.cos(), at[1] + side.length * heading.sin()];
        heading += side.turn_deg.to_radians();
        (at, *side)
    };
    sides.iter().map(step).collect()
}

fn rounded(value: f64) -> f64 {
    (value * 1e4).round() / 1e4
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    /// The same chain in three languages, absolute and incremental, gives the same path.
    #[test]
    fn law_corners_are_the_same_in_all_notations(sides in sides()) {
        let places = points(&sides);
        let (mut iso, mut inc, mut mpf) = (String::new(), String::new(), String::new());
        let mut klartext = "L X+0 Y+0 F100\n".to_owned();
        let mut before = [0.0, 0.0];
        for (i, (p, side)) in places.iter().enumerate() {
            let [x, y] = p.map(rounded);
            let (dx, dy) = (rounded(x - before[0]), rounded(y - before[1]));
            before = [x, y];
            let size = rounded(side.size);
            let last = i + 1 == places.len();
            let words = |round: [&str; 2]| match last {
                true => String::new(),
                false => format!("{}{size}", round[usize::from(!side.round)]),
            };
            iso += &format!("X{x:.4} Y{y:.4}{}\n", words([",R", ",C"]));
            inc += &format!("X{dx:.4} Y{dy:.4}{}\n", words([",R", ",C"]));
            mpf += &format!("X{x:.4} Y{y:.4} {}\n", words(["RND=", "CHR="]));
            klartext += &format!("L X{x:+.4} Y{y:+.4}\n{}\n", words(["RND R", "CHF "]));
        }
        let start = "G1 F100. G90 X0 Y0\n";
        let first = shown(&sound(Control::Fanuc, &format!("{start}{iso}M30\n")));
        let others = [
            shown(&sound(Control::Fanuc, &format!("{start}G91\n{inc}M30\n"))),
            shown(&sound(Control::Sinumerik840d, &format!("G1 F100 G90 X0 Y0\n{mpf}M30\n"))),
            shown(&sound(Control::Heidenhain, &klartext)),
        ];
        for other in others {
            assert_close(&first, &other, &iso);
        }
        prop_assert_eq!(first.len(), 2 * places.len());
    }
}
