//! Laws over random Klartext programs.

use proptest::prelude::*;
use trueaxis_nc::moves::{Axis, Frame, Position};
use trueaxis_nc::{Control, Event, Library, NoLibrary, Program, Settings, Step, interpret};

/// Pieces that programs are made of, and some that they are not.
const PIECES: [&str; 96] = [
    "BEGIN PGM a MM",
    "BEGIN PGM a INCH",
    "END PGM a MM",
    "BLK FORM 0.1 Z X+0 Y+0 Z-9",
    "BLK FORM 0.2 X+9 Y+9 Z+0",
    "TOOL CALL 1 Z S100 F200",
    "TOOL CALL \"M\" Y DL+1",
    "TOOL DEF 1 L+5 R+2",
    "L X+10 Y-2.5 R0 FMAX",
    "L Z-5 F100",
    "L IX+1 IY-1",
    "L A+20 C-370",
    "L X+Q1 Y-QL2",
    "L Z-10 FMAX M91",
    "X+5 R0",
    "C+90 FMAX",
    "LN X+1 NX+0 NY+0 NZ+1 TX+1 TY+0 TZ+1",
    "CC X+5 Y+0",
    "CC",
    "CC IX+3",
    "C X+10 Y+0 DR+",
    "C DR-",
    "CR X+3 Y+4 R+5 DR-",
    "CR X+3 Y+4 R-9 DR+",
    "CT X+7 Y+8",
    "LP PR+5 PA+30",
    "LP IPA+720",
    "CP IPA+1080 IZ-5 DR+",
    "CTP PR+2 PA+80",
    "RND R2",
    "CHF 1",
    "APPR LT X+1 Y+1 LEN5 RL",
    "DEP CT CCA90 R+3",
    "DEP LN LEN4",
    "DEP LCT X+3 R2",
    "M3",
    "M8 M5",
    "M89",
    "M94",
    "M99",
    "M126",
    "M127",
    "M128 F500",
    "M129",
    "M130",
    "M136",
    "M140 MB 5",
    "M140 MB MAX",
    "M30",
    "M118 X1 Y1",
    "FUNCTION TCPM F TCP AXIS SPAT PATHCTRL VECTOR",
    "FUNCTION RESET TCPM",
    "PLANE SPATIAL SPA+30 SPB-20 SPC+Q1 MOVE SEQ+",
    "PLANE VECTOR BX1 BY0 BZ0 NX0 NY1 NZ1 STAY",
    "PLANE RELATIVE SPB+10 TURN",
    "PLANE EULER EULPR5 EULNU6 EULROT7 STAY",
    "PLANE RESET STAY",
    "PLANE POINTS P1X0 P2X1 P3Y1 STAY",
    "CYCL DEF 7.1 X+10 IY+1",
    "CYCL DEF 8.1 X Y",
    "CYCL DEF 8.1",
    "CYCL DEF 10.1 IROT+30",
    "CYCL DEF 11.1 SCL0.5",
    "CYCL DEF 19.1 A+10 B+20",
    "CYCL DEF 19.1",
    "CYCL DEF 26.1 X2 CCX+5",
    "CYCL DEF 32.1 T0.05",
    "CYCL DEF 9.1 DWELL 1",
    "CYCL DEF 247 P Q339=+2",
    "CYCL DEF 200 D ~\nQ200=2 ~\nQ201=-9 Q202=2 Q206=100",
    "CYCL DEF 203 D Q200=1 Q201=-9 Q202=3 Q206=9 Q212=1",
    "CYCL DEF 1.0 P\nCYCL DEF 1.2 DEPTH-5\nCYCL DEF 1.5 F9",
    "CYCL DEF 253 X",
    "CYCL CALL",
    "CYCL CALL POS X1",
    "CYCL DEF 12.1 PGM SUB",
    "Q1 = 5 + SIN 30 * ( 2 - Q2 ) ^ 2",
    "Q2 = Q1 / 0",
    "QL2 = 7 % 3",
    "QS1 = \"a\" || QS1",
    "QS1 = \"x\"",
    "FN 0: Q2 = +3",
    "FN 4: Q1 = +Q2 DIV +2",
    "FN 9: IF +Q1 EQU +Q2 GOTO LBL 1",
    "FN 12: IF +Q1 LT +3 GOTO LBL \"A\"",
    "FN 18: SYSREAD Q1 = ID270 NR1 IDX1",
    "LBL 1",
    "LBL \"A\"",
    "LBL 0",
    "CALL LBL 1",
    "CALL LBL 1 REP 3",
    "CALL PGM SUB",
    "L Xnan",
    "* - part",
    "; note ~",
    "12",
];

/// One subprogram, which calls itself.
struct One;

impl Library for One {
    fn text(&self, name: &str) -> Result<Vec<u8>, String> {
        if name.starts_with("SUB") {
            return Ok(b"BEGIN PGM SUB MM\nL IX+1 F9\nCALL PGM SUB\nEND PGM SUB MM\n".to_vec());
        }
        Err("none".to_owned())
    }
}

fn survives(source: Vec<u8>) {
    let program = Program::new("p", source, Control::Heidenhain);
    assert_eq!(program.print(), program.source());
    let lines = program.source().len() as u32 + 1;
    for keep_going in [false, true] {
        let settings =
            Settings { most_jumps: 200, deepest_call: 8, keep_going, ..Settings::default() };
        let outcome = interpret(&program, &One, &settings, &mut |step| match step {
            Step::Move(m) => {
                assert!(m.target.0.iter().all(|v| v.is_finite()), "{m:?}");
                assert!(m.direction.iter().flatten().all(|v| v.is_finite()), "{m:?}");
                assert!(m.feed.value.is_finite());
                assert!(m.origin.line <= lines);
            }
            Step::Event(Event::Frame(frame), _) => {
                assert!(frame.linear.iter().flatten().all(|v| v.is_finite()));
            }
            Step::Event(..) => {}
        });
        assert!(outcome.finished || outcome.problems.has_errors());
        assert!(outcome.problems.iter().all(|d| d.place.line > 0));
    }
}

fn frames_of(text: &str) -> Frame {
    let program = Program::new("p", text.as_bytes().to_vec(), Control::Heidenhain);
    let mut last = Frame::IDENTITY;
    let outcome = interpret(&program, &NoLibrary, &Settings::default(), &mut |step| {
        if let Step::Event(Event::Frame(frame), _) = step {
            last = frame;
        }
    });
    assert!(!outcome.problems.has_errors(), "{:?}", outcome.problems);
    last
}

fn close(a: &Frame, b: &Frame) -> bool {
    let linear = a.linear.iter().flatten().zip(b.linear.iter().flatten());
    linear.chain(a.shift.0.iter().zip(&b.shift.0)).all(|(x, y)| (x - y).abs() < 1e-9)
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn law_any_bytes_survive(source in proptest::collection::vec(any::<u8>(), 0..400)) {
        survives(source);
    }

    #[test]
    fn law_mutated_programs_survive(
        pieces in proptest::collection::vec((0..PIECES.len(), 0..9_u8), 1..60),
        changes in proptest::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 0..6),
    ) {
        let mut text = String::new();
        for (index, end) in pieces {
            text.push_str(PIECES[index]);
            text.push_str(match end { 0 => " ", 1 => " ~\n", _ => "\n" });
        }
        survives(text.clone().into_bytes());
        let mut bytes = text.into_bytes();
        for (index, byte) in changes {
            let at = index.index(bytes.len());
            bytes[at] = byte;
        }
        survives(bytes);
    }

    /// The same plane by space angles and by its vectors: X and Z of R = Rz(C)·Ry(B)·Rx(A), worked
    /// out by hand.
    #[test]
    fn law_space_angles_and_vectors_give_one_plane(
        a in -180.0..180.0_f64, b in -180.0..180.0_f64, c in -180.0..180.0_f64,
    ) {
        let (a, b, c) = ((a * 1e3).round() / 1e3, (b * 1e3).round() / 1e3, (c * 1e3).round() / 1e3);
        let [(sa, ca), (sb, cb), (sc, cc)] = [a, b, c].map(|v| v.to_radians().sin_cos());
        let x = [cc * cb, sc * cb, -sb];
        let z = [cc * sb * ca + sc * sa, sc * sb * ca - cc * sa, cb * ca];
        let angles = frames_of(&format!("PLANE SPATIAL SPA{a:+} SPB{b:+} SPC{c:+} STAY\n"));
        let vectors = frames_of(&format!(
            "PLANE VECTOR BX{:+.15} BY{:+.15} BZ{:+.15} NX{:+.15} NY{:+.15} NZ{:+.15} STAY\n",
            x[0], x[1], x[2], z[0], z[1], z[2]
        ));
        prop_assert!(close(&angles, &vectors), "{angles:?} {vectors:?}");
    }

    /// RELATIVE turns about the axes of the plane: A, B, C one after the other is Rx·Ry·Rz.
    #[test]
    fn law_relative_planes_chain(a in -90.0..90.0_f64, c in -90.0..90.0_f64) {
        let chained = frames_of(&format!(
            "PLANE SPATIAL SPA+0 SPB+0 SPC{c:+.3} STAY\nPLANE RELATIVE SPA{a:+.3} STAY\n"
        ));
        let whole = frames_of(&format!("PLANE SPATIAL SPA{a:+.3} SPB+0 SPC{c:+.3} STAY\n"));
        prop_assert!(close(&chained, &whole));
    }

    /// Wherever the frame goes, the tool stays: going to the present place moves nothing.
    #[test]
    fn law_frames_leave_the_tool_where_it_is(
        picks in proptest::collection::vec(0..8_usize, 1..8),
        x in -100.0..100.0_f64, y in -100.0..100.0_f64,
    ) {
        const CHANGES: [&str; 8] = [
            "CYCL DEF 7.1 X+10 IY+1", "CYCL DEF 8.1 X", "CYCL DEF 10.1 IROT+30", "CYCL DEF 11.1 SCL0.5",
            "PLANE SPATIAL SPA+30 SPB-20 SPC+10 STAY", "PLANE RESET STAY", "CYCL DEF 26.1 X2 Y1 CCX+5",
            "TRANS MIRROR RESET",
        ];
        let changes: String = picks.iter().map(|i| format!("{}\n", CHANGES[*i])).collect();
        let text = format!("L X{x:+.3} Y{y:+.3} Z+5 FMAX\n{changes}L IX+0 IY+0 IZ+0 FMAX\n");
        let program = Program::new("p", text.into_bytes(), Control::Heidenhain);
        let (mut frame, mut places) = (Frame::IDENTITY, Vec::<Position>::new());
        let outcome = interpret(&program, &NoLibrary, &Settings::default(), &mut |step| match step {
            Step::Event(Event::Frame(new), _) => frame = new,
            Step::Move(m) => places.push(frame.place(&m.target)),
            Step::Event(..) => {}
        });
        prop_assert!(!outcome.problems.has_errors());
        for axis in [Axis::X, Axis::Y, Axis::Z] {
            prop_assert!((places[0][axis] - places[1][axis]).abs() < 1e-7);
        }
    }

    /// Every begun place of a circle lies on it.
    #[test]
    fn law_tangential_circles_reach_their_target(
        x in -50.0..50.0_f64, y in -50.0..50.0_f64, angle in 0.0..360.0_f64,
    ) {
        prop_assume!(x.hypot(y) > 1.0);
        let text = format!("CC X+0 Y+0\nL X+0 Y+0 FMAX\nLP PR+5 PA{angle:+.6} F9\nCT IX{x:+.3} IY{y:+.3}\n");
        let program = Program::new("p", text.into_bytes(), Control::Heidenhain);
        let mut moves = Vec::new();
        interpret(&program, &NoLibrary, &Settings::default(), &mut |step| {
            if let Step::Move(m) = step {
                moves.push(m);
            }
        });
        prop_assume!(moves.len() == 3);
        if let trueaxis_nc::MoveKind::Arc(arc) = moves[2].kind {
            let radius = |p: &Position| (p.0[0] - arc.center_mm[0]).hypot(p.0[1] - arc.center_mm[1]);
            let (from, to) = (radius(&moves[1].target), radius(&moves[2].target));
            prop_assert!((from - to).abs() < 1e-9 * from.max(1.0), "{from} {to}");
            // The centre stands square to the line before.
            let (sin, cos) = angle.to_radians().sin_cos();
            let across = (arc.center_mm[0] - moves[1].target.0[0]) * cos
                + (arc.center_mm[1] - moves[1].target.0[1]) * sin;
            prop_assert!(across.abs() < 1e-6 * from.max(1.0));
        }
    }
}

/// CT to a place straight ahead is a line, whatever the direction; to one in the opposite direction nothing leads.
#[test]
fn a_tangential_circle_straight_ahead_is_a_line() {
    for (way, from) in [(1.0, 10.0), (-1.0, 10.0), (1.0, -90.0), (-1.0, -90.0)] {
        for axis in ["X", "Y"] {
            let moved = |by: f64| format!("I{axis}{:+}", way * by);
            let text =
                |by: f64| format!("L X{from:+} Y{from:+} F9\nL {}\nCT {}\n", moved(5.0), moved(by));
            let run = |text: String| {
                let program = Program::new("p", text.into_bytes(), Control::Heidenhain);
                let mut kinds = Vec::new();
                let outcome = interpret(&program, &NoLibrary, &Settings::default(), &mut |step| {
                    if let Step::Move(m) = step {
                        kinds.push(m.kind);
                    }
                });
                (kinds, outcome.problems.iter().any(|p| p.code == "arc-does-not-fit"))
            };
            let (kinds, refused) = run(text(3.0));
            assert!(!refused && kinds.len() == 3, "{}", text(3.0));
            assert_eq!(kinds[2], kinds[1]);
            assert!(run(text(-3.0)).1, "{}", text(-3.0));
        }
    }
}
