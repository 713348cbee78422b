//! What FANUC, Haas and LinuxCNC do differently with the same words.

use trueaxis_nc::Control::{Fanuc, Haas, LinuxCnc};
use trueaxis_nc::moves::{Axis, Frame, Move, Position};
use trueaxis_nc::{Control, Event, MoveKind, NoLibrary, Program, Settings, Step, interpret};

/// What a program comes to.
struct Run {
    moves: Vec<Move>,
    /// Where the axes are after each move.
    machine: Vec<Position>,
    /// Each new speed of the spindle.
    speeds: Vec<f64>,
    /// The codes of the problems.
    codes: Vec<&'static str>,
}

fn run(control: Control, text: &str) -> Run {
    let program = Program::new("p", text.as_bytes().to_vec(), control);
    let (mut frame, mut tool) = (Frame::IDENTITY, Position::default());
    let (mut moves, mut machine, mut speeds) = (Vec::new(), Vec::new(), Vec::new());
    let settings = Settings { most_jumps: 10_000, ..Settings::default() };
    let outcome = interpret(&program, &NoLibrary, &settings, &mut |s| match s {
        Step::Move(m) => {
            machine.push(frame.place(&m.target).plus(&tool));
            moves.push(m);
        }
        Step::Event(Event::SpindleSpeed(speed), _) => speeds.push(speed),
        Step::Event(Event::Frame(f), _) => frame = f,
        Step::Event(Event::ToolLength(length), _) => tool = length,
        Step::Event(..) => {}
    });
    Run { moves, machine, speeds, codes: outcome.problems.iter().map(|p| p.code).collect() }
}

impl Run {
    /// The places of one axis of the machine, those that repeat left out.
    fn axis(&self, axis: Axis) -> Vec<f64> {
        let mut places: Vec<f64> = self.machine.iter().map(|p| p[axis]).collect();
        places.dedup_by(|a, b| (*a - *b).abs() < 1e-9);
        places
    }
}

#[track_caller]
fn assert_near(found: &[f64], wanted: &[f64], what: &str) {
    let near = |(a, b): (&f64, &f64)| (a - b).abs() < 1e-9;
    assert!(
        found.len() == wanted.len() && found.iter().zip(wanted).all(near),
        "{what}\n{found:?}\n{wanted:?}"
    );
}

/// Haas: L0 in a later block of a cycle moves X and Y without a hole; in the block of G81 it keeps the data only.
#[test]
fn law_l0_in_a_later_block_of_a_cycle_moves_past_a_place() {
    let places = |text: &str| -> Vec<[f64; 3]> {
        let found = run(Haas, text);
        assert_eq!(found.codes, [""; 0], "{text}");
        let mut all: Vec<_> = found.machine.iter().map(|p| [p.0[0], p.0[1], p.0[2]]).collect();
        all.dedup();
        all
    };
    let begin = "G21 G0 X0. Y0. Z10.\nF100.\n";
    let end = "X7. Y3.\nG80\nM30\n";
    for (cycle, height) in [
        ("G81 G99 X1. Z-5. R2.", 2.0),
        ("G98 G81 Z-5. R2. X1.", 10.0),
        ("G83 G98 X1. Z-5. R2. Q1.", 10.0),
    ] {
        for past in ["X4. Y5. L0", "L0 Y5. X4.", "N5 G91 X3. Y5. L0\nG90", "G90 X4. Y5. L00"] {
            let found = places(&format!("{begin}{cycle}\n{past}\n{end}"));
            let there: Vec<_> = found.iter().filter(|p| p[0] == 4.0).collect();
            assert_eq!(there, [&[4.0, 5.0, height]], "{cycle} {past}");
            assert!(found.contains(&[7.0, 3.0, -5.0]), "the next hole: {cycle} {past}");
        }
        let first = places(&format!("{begin}{cycle} L0\n{end}"));
        assert!(first.iter().all(|p| p[0] != 1.0), "{cycle}");
        assert!(first.contains(&[7.0, 3.0, -5.0]), "{cycle}");
    }
    // K0 of FANUC is no such word.
    let fanuc = run(Fanuc, &format!("{begin}G81 G99 X1. Z-5. R2.\nX4. K0\nM30\n"));
    assert!(fanuc.machine.iter().all(|p| p[Axis::X] != 4.0));
}

/// Haas: L repeats an incremental arc, from where the last has ended.
#[test]
fn law_l_repeats_an_incremental_arc() {
    let begin = "G21 G0 X5. Y0. Z0.\nF100.\n";
    for arc in [
        "G91 G3 I-5. J0. Z1.",
        "G3 G91 Z1. I-5.",
        "G91 G2 X2. Y2. I2. J0. Z-1.",
        "G91\nG3 X3. Y1. R4.",
    ] {
        for count in [1, 2, 5] {
            let repeated = run(Haas, &format!("{begin}{arc} L{count}\nM30\n"));
            let plain = run(Haas, &format!("{begin}{}M30\n", format!("{arc}\n").repeat(count)));
            assert_eq!((&repeated.codes, &plain.codes), (&vec![], &vec![]), "{arc}");
            assert_eq!(repeated.machine.len(), count + 1, "{arc}");
            for (a, b) in repeated.moves.iter().zip(&plain.moves) {
                let round = |m: &Move| match m.kind {
                    MoveKind::Arc(arc) => (arc.ccw, arc.center_mm[0], arc.center_mm[1]),
                    _ => (false, 0.0, 0.0),
                };
                let (a, b) = ((round(a), a.target), (round(b), b.target));
                assert_eq!(a.0.0, b.0.0, "{arc} L{count}");
                assert_near(&[a.0.1, a.0.2], &[b.0.1, b.0.2], arc);
                assert_near(&a.1.0, &b.1.0, arc);
            }
        }
    }
    let absolute = run(Haas, &format!("{begin}G90 G3 I-5. Z1. L5\nM30\n"));
    assert_eq!((absolute.moves.len(), absolute.codes), (2, vec!["not-applied"]));
    assert_eq!(run(Haas, &format!("{begin}G91 G3 I-5. L0.5\nM30\n")).codes, ["bad-repeats"]);
    assert_eq!(run(Fanuc, &format!("{begin}G91 G3 I-5. L2\nM30\n")).codes, ["unused-word"]);
}

/// FANUC and Haas: G52 stands on top of G92, which cancels it for the axes of its block; LinuxCNC has one register.
#[test]
fn law_a_local_shift_stands_on_top_of_g92() {
    for (text, fanuc, linuxcnc) in [
        (
            "G0 X10.\nG92 X0.\nG52 X100.\nG1 X5. F100.\nG52 X0.\nX5.",
            &[10., 115., 15.][..],
            &[10., 105., 5.][..],
        ),
        (
            "G0 X10.\nG92 X0.\nN3 G52 X100.\nG91 G1 X95. F100.\nG90 G52 X0.\nX5.",
            &[10., 105., 15.],
            &[10., 105., 5.],
        ),
        ("G52 X100.\nG0 X5.\nG92 X0.\nG52 X0.\nG0 X1.", &[105., 106.], &[105., 1.]),
        ("G52 X100.\nG0 X5.\nG92 Y3.\nG52 X0.\nG0 X1.", &[105., 1.], &[105., 1.]),
        (
            "G52 X100.\nG52 X20. Y1.\nG0 X5.\nG52 Y0.\nX6.\nG52 X0.\nX6.",
            &[25., 26., 6.],
            &[25., 26., 6.],
        ),
        (
            "G10 L2 P2 X50.\nG52 X10.\nG0 X1.\nG55 X1.\nG92 X0.\nG54 X1.",
            &[11., 61., 12.],
            &[11., 61., 12.],
        ),
    ] {
        let text = format!("G21 G17\n{text}\nM30\n");
        for control in [Fanuc, Haas, LinuxCnc] {
            let found = run(control, &text);
            assert_eq!(found.codes, [""; 0], "{control:?} {text}");
            let wanted = if control == LinuxCnc { linuxcnc } else { fanuc };
            assert_near(&found.axis(Axis::X), wanted, &format!("{control:?} {text}"));
        }
    }
    for control in [Fanuc, Haas] {
        for (text, wanted) in [
            // G92.1 takes both away, for the axes of its block.
            ("G0 X10.\nG92 X0.\nG52 X100.\nG92.1 Y0.\nX1.\nG92.1 X0.\nX1.", &[10., 111., 1.][..]),
            // Seen from a rotated frame of the program, the place of G92 is that of the tool.
            (
                "G0 X10. Y0.\nG68 X0 Y0 R90.\nG92 Y0.\nG52 X3.\nG0 Y1.\nG69\nG52 X0.\nG0 X0.",
                &[10., 12., 10.],
            ),
            (
                "G0 X10.\nG92 X0.\nG52 X5.\nG51.1 X0.\nG0 X1.\nG50.1\nX1.\nG52 X0.\nX1.",
                &[10., 14., 16., 11.],
            ),
        ] {
            let found = run(control, &format!("G21 G17\n{text}\nM30\n"));
            assert_eq!(found.codes, [""; 0], "{control:?} {text}");
            assert_near(&found.axis(Axis::X), wanted, &format!("{control:?} {text}"));
        }
    }
    // On Haas #5201 and G10 L2 P0 are the register of G52, on FANUC one of its own.
    let text = "G21 G52 X7.\nG10 L2 P0 X3.\nG0 X#5201\nG52 X0.\nG0 X1.\n#5201=5.\nG0 X0.\nM30\n";
    assert_near(&run(Haas, text).axis(Axis::X), &[6., 1., 5.], "Haas");
    assert_near(&run(Fanuc, text).axis(Axis::X), &[13., 4., 5.], "FANUC");
}

/// G53 after G91: LinuxCNC refuses it, FANUC and Haas read a place of the machine and warn.
#[test]
fn law_g53_after_g91_is_refused_or_warned_of() {
    let begin = "G21 G54\nG10 L2 P1 X20.\nG0 X5.\n";
    for block in ["G91 G53 G0 X7.", "G53 G91 X7. G0", "G91\nN4 G53 X7.", "G91\nG53 G90 X7."] {
        let later = block.contains("G90");
        let text = format!("{begin}{block}\nG90 X6.\nM30\n");
        for control in [Fanuc, Haas] {
            let found = run(control, &text);
            assert_near(&found.axis(Axis::X), &[25., 7., 26.], &text);
            let wanted: &[&str] = if later { &[] } else { &["incremental-machine-place"] };
            assert_eq!(found.codes, wanted, "{control:?} {text}");
        }
        let linuxcnc = run(LinuxCnc, &text);
        let wanted: &[f64] = if later { &[25., 7., 26.] } else { &[25.] };
        assert_near(&linuxcnc.axis(Axis::X), wanted, &text);
    }
}

/// G53 of FANUC moves with rapid, whatever G code is modal; on the others as that says.
#[test]
fn law_g53_of_fanuc_moves_with_rapid() {
    let begin = "G21 G54\nG10 L2 P1 X20. Y3.\nG0 X5. F100.\n";
    for block in [
        "G1 G53 X7.",
        "G53 X7. G1 F50.",
        "G1 Y1.\nG53 X7.",
        "G53 G0 X7.",
        "G0 G53 X7.\nG90 G53 X8.",
    ] {
        let text = format!("{begin}{block}\nM30\n");
        for control in [Fanuc, Haas, LinuxCnc] {
            let found = run(control, &text);
            assert_eq!(found.codes, [""; 0], "{control:?} {text}");
            let rapid = control == Fanuc || !block.contains("G1");
            let last = found.moves.last().map(|m| m.kind);
            let wanted = if rapid { MoveKind::Rapid } else { MoveKind::Linear };
            assert_eq!(last, Some(wanted), "{control:?} {text}");
            let place = if block.contains("X8.") { 8.0 } else { 7.0 };
            assert_eq!(found.axis(Axis::X).last(), Some(&place), "{control:?} {text}");
        }
    }
    // After an arc no centre is asked for, and what is modal comes back.
    let found = run(Fanuc, &format!("{begin}G2 X7. I1.\nG53 Y0.\nX9. I1.\nM30\n"));
    assert_eq!(found.codes, [""; 0]);
    assert!(matches!(found.moves[3].kind, MoveKind::Arc(_)));
}

/// Angles of FANUC run from 0 to 360 (ASIN: 270 to 90), those of Haas and LinuxCNC are signed; both are the same direction.
#[test]
fn law_angles_of_fanuc_have_no_sign() {
    let value = |control, text: &str| {
        let found = run(control, &format!("G21 G0 X{text}\nM30\n"));
        assert_eq!(found.codes, [""; 0], "{text}");
        found.moves[0].target[Axis::X]
    };
    for degrees in (-175..180).step_by(10) {
        let angle = f64::from(degrees);
        let (sin, cos) = angle.to_radians().sin_cos();
        let whole = angle.rem_euclid(360.0);
        let two = format!("[ATAN[{sin:.12}]/[{cos:.12}]]");
        let wanted = [(Fanuc, whole), (Haas, angle), (LinuxCnc, angle)];
        for (control, wanted) in wanted {
            assert!((value(control, &two) - wanted).abs() < 1e-6, "{control:?} {two}");
        }
        assert!((value(Fanuc, &two.replace("]/[", ",")) - whole).abs() < 1e-6, "{two}");
        assert!((value(Fanuc, &format!("[ACOS[{cos:.12}]]")) - angle.abs()).abs() < 1e-6);
        if angle.abs() < 90.0 {
            let one = format!("[ATAN[{:.12}]]", sin / cos);
            assert!(
                (value(Fanuc, &one) - angle).abs() < 1e-6
                    && (value(Haas, &one) - angle).abs() < 1e-6
            );
            let text = format!("[ASIN[{sin:.12}]]");
            for (control, wanted) in wanted {
                assert!((value(control, &text) - wanted).abs() < 1e-6, "{control:?} {text}");
            }
        }
    }
}

/// G30 of FANUC and Haas goes to machine zero and says so; LinuxCNC knows its place by G30.1.
#[test]
fn law_g30_says_that_its_place_is_not_known() {
    for (block, codes) in [
        ("G30 X0.", &["reference-point"][..]),
        ("G91 G30 P2 X0.\nG90", &["reference-point"]),
        ("G30 X8. P3\nG30 P4 X8.", &["reference-point"]),
        ("X8. G30 P5", &["reference-point", "unused-word"]),
        ("G28 X0.", &[]),
    ] {
        let text = format!("G21 G10 L2 P1 X20.\nG54 G0 X5.\n{block}\nX1.\nM30\n");
        for control in [Fanuc, Haas] {
            let found = run(control, &text);
            assert_eq!(found.codes, codes, "{control:?} {text}");
            assert!(found.axis(Axis::X).contains(&0.0), "{control:?} {text}");
        }
    }
    let linuxcnc = run(LinuxCnc, "G21 G0 X5.\nG30.1\nX7.\nG30\nX1.\nM2\n");
    assert_eq!((linuxcnc.codes.len(), linuxcnc.axis(Axis::X)), (0, vec![5., 7., 5., 1.]));
}

/// Arguments of G65 without a decimal point: Haas counts ten-thousandths of an inch or thousandths of a millimetre.
#[test]
fn law_arguments_without_a_point_are_small_on_haas() {
    // D, E, F, H, M, S and T are #7 #8 #9 #11 #13 #19 #20.
    for (letter, variable) in b"ABCIJKQRUVWXYZDEFHMST"
        .iter()
        .zip([1, 2, 3, 4, 5, 6, 17, 18, 21, 22, 23, 24, 25, 26, 7, 8, 9, 11, 13, 19, 20])
    {
        let letter = char::from(*letter);
        let small = !"DEFHMST".contains(letter);
        for (unit, scale, mm) in [("G20", 0.0001, 25.4), ("G21", 0.001, 1.0)] {
            for (number, value) in
                [("5", 5.0), (" -5", -5.0), ("5.", 5.0), ("5.0", 5.0), ("[5]", 5.0), ("#100", 5.0)]
            {
                let point = number.contains(['.', '[', '#']);
                let text = format!(
                    "{unit}\n#100=5\nG65 P9010 {letter}{number}\nM30\nO9010\nG0 X[#{variable}*1000.]\nM99\n"
                );
                for control in [Fanuc, Haas] {
                    let found = run(control, &text);
                    let unit = if control == Haas && small && !point { scale } else { 1.0 };
                    assert_eq!(found.codes, [""; 0], "{text}");
                    assert_near(&found.axis(Axis::X), &[value * unit * 1000.0 * mm], &text);
                }
            }
        }
    }
}

/// G10 L12 and L13 of Haas are diameters, those of FANUC radii; L1 of Haas is the wear of the length.
#[test]
fn law_g10_l12_of_haas_is_a_diameter() {
    let radius = |control, text: &str| {
        let program =
            Program::new("p", format!("{text}\nG41 D5 G1 X5. F100.\nX9.\nM30\n").into(), control);
        let mut radius = 0.0;
        let _ = interpret(&program, &NoLibrary, &Settings::default(), &mut |s| {
            if let Step::Event(Event::Compensation { radius_mm, .. }, _) = s {
                radius = radius_mm;
            }
        });
        radius
    };
    for (text, fanuc) in [
        ("G21 G10 L12 P5 R8.", 8.0),
        ("G21 G10 G90 P5 R8. L12\nG10 L13 P5 R-0.2", 7.8),
        ("G21 G10 L12 P5 R8.\nG91 G10 L12 P5 R1.\nG90", 9.0),
        ("G20 G10 L12 P5 R.375\nG10 P5 L13 R0.01", 0.385 * 25.4),
    ] {
        assert_near(&[radius(Fanuc, text), radius(Haas, text)], &[fanuc, fanuc / 2.0], text);
    }
    let text = "G21 G10 L10 P1 R50.\nG10 L1 P1 R2.\nG43 H1 G0 Z0.\nM30\n";
    assert_near(&run(Haas, text).axis(Axis::Z), &[52.0], text);
    assert_near(&run(Fanuc, text).axis(Axis::Z), &[2.0], text);
}

/// Q of M98 is the block number at which a subprogram of FANUC begins, after the move of the block and at each repeat.
#[test]
fn law_q_of_m98_is_where_the_subprogram_begins() {
    let sub = "M30\nO2\nX20.\nN5 X21.\nN10 X22.\nX23.\nM99\nO3\nN10 X99.\nN40 X98.\nM99\n";
    for (call, wanted) in [
        ("M98 P2 Q10", &[1., 22., 23., 3.][..]),
        ("Q10 P2 M98 X2.", &[1., 2., 22., 23., 3.]),
        ("M98 P2", &[1., 20., 21., 22., 23., 3.]),
        ("N10 M98 P2 Q5 L2", &[1., 21., 22., 23., 21., 22., 23., 3.]),
        ("M98 P20002 Q10", &[1., 22., 23., 22., 23., 3.]),
        ("M98 P3 Q10", &[1., 99., 98., 3.]),
    ] {
        let text = format!("O1\nG21 G0 X1.\n{call}\nX3.\n{sub}");
        let found = run(Fanuc, &text);
        assert_eq!(found.codes, [""; 0], "{text}");
        assert_near(&found.axis(Axis::X), wanted, &text);
    }
    for missing in ["M98 P2 Q40", "M98 P2 Q11", "M98 P2 Q10.5", "M98 P2 Q-10"] {
        let found = run(Fanuc, &format!("O1\nG21 G0 X1.\n{missing}\nX3.\n{sub}"));
        assert_eq!(found.codes, ["missing-label"], "{missing}");
    }
    let haas = run(Haas, &format!("O1\nG21 G0 X1.\nM98 P2 Q10\nX3.\n{sub}"));
    assert_eq!(haas.axis(Axis::X)[1], 20.0);
}

/// J of G74 and G84 on Haas: the tap goes out so many times as fast, with the spindle; nothing else changes.
#[test]
fn law_j_of_a_tap_makes_the_way_out_faster() {
    for cycle in ["G84", "G74"] {
        for (begin, end) in [("X1. Z-5. R2.", ""), ("Z-5. R2.", " X1."), ("G98 R2. Z-5. X1.", "")] {
            for (j, times) in [("", 1.0), (" J2", 2.0), (" J1.", 1.0), (" J4", 4.0)] {
                let text = format!(
                    "G21 S500 M3\nG0 X0. Z10.\n{cycle} F400. {begin}{j}{end}\nX2.\nG80 G1 X3.\nM30\n"
                );
                let found = run(Haas, &text);
                assert_eq!(found.codes, [""; 0], "{text}");
                let (fast, own) = (500.0 * times, 500.0);
                let wanted = if j.is_empty() { vec![own] } else { vec![own, fast, own, fast, own] };
                assert_eq!(found.speeds, wanted, "{text}");
                let z = |m: &Move| m.target[Axis::Z];
                let cuts: Vec<_> =
                    found.moves.iter().filter(|m| m.kind == MoveKind::Linear).collect();
                assert_eq!(cuts.len(), 5, "{text}");
                for (cut, wanted) in cuts.iter().zip([400., 400. * times, 400., 400. * times, 400.])
                {
                    assert!((cut.feed.value - wanted).abs() < 1e-9, "{text} {}", z(cut));
                }
            }
        }
    }
    assert_eq!(
        run(Fanuc, "G21 S500 M3\nG0 Z10.\nG84 X1. Z-5. R2. J2 F400.\nG80\nM30\n").codes,
        ["unused-word"]
    );
}

/// Codes of Haas without effect on the path; M96 is a jump that is not executed.
#[test]
fn law_outputs_of_haas_are_known_and_m96_is_warned_of() {
    for (block, codes) in [
        ("M59 P2", &[][..]),
        ("X2. M69 P1134", &[]),
        ("M75 G1 F10. X2.", &[]),
        ("M78\nM79", &[]),
        ("N5 M96 P10 Q18\nN10", &["not-applied"]),
        ("X2. M96 Q1 P10\nN10 M96 P10 Q8", &["not-applied"]),
        ("G268 X1. Y2. I0 J0 K30.\nG269", &[]),
        ("G268 X1. Y2. I0 J0 K30.\nG269 G90", &[]),
    ] {
        let text = format!("G21 G0 X1. Y0.\n{block}\nG0 X3. Y0.\nM30\n");
        let found = run(Haas, &text);
        assert_eq!(found.codes, codes, "{text}");
        assert_near(&found.machine.last().unwrap().0[..3], &[3.0, 0.0, 0.0], &text);
        let second = found.machine[1][Axis::X];
        assert_eq!(second, if block.contains("X2.") { 2.0 } else { 3.0 }, "{text}");
    }
}

/// DO … END without WHILE is a loop that only a GOTO leaves; without one the limit of loops ends it.
#[test]
fn law_do_without_while_is_left_by_goto() {
    for control in [Fanuc, Haas] {
        for text in [
            "#1=0\nDO1\n#1=#1+1\nG0 X#1\nIF[#1 GE 3]GOTO 10\nEND1\nN10 X50.\nM30\n",
            "#1=0\nN3 DO 2 (TURN)\n#1=#1+1\nIF[#1 GT 3]GOTO 7\nG0 X#1\nN4 END 2\nN7 X50.\nM30\n",
            "#1=0\nDO3\n#2=0\nWHILE[#2 LT 1]DO1\n#2=#2+1\n#1=#1+1\nG0 X#1\nEND1\nIF[#1 EQ 3]GOTO 10\nEND3\nN10 X50.\nM30\n",
            "#1=0\nWHILE[#1 LT 3]DO1\nDO2\n#1=#1+1\nG0 X#1\nGOTO 6\nEND2\nN6\nEND1\nX50.\nM30\n",
        ] {
            let found = run(control, &format!("G21\n{text}"));
            assert_eq!(found.codes, [""; 0], "{text}");
            assert_near(&found.axis(Axis::X), &[1., 2., 3., 50.], text);
        }
        assert_eq!(run(control, "DO1\n#1=1\nEND1\nM30\n").codes, ["endless-loop"]);
        assert_eq!(run(control, "DO1\n#1=1\nM30\n").codes, ["missing-endwhile"]);
        let program = Program::new("p", b"G0 X1.\nEND1\nM30\n".to_vec(), control);
        let outcome = interpret(&program, &NoLibrary, &Settings::default(), &mut |_| {});
        let text = outcome.problems.iter().next().unwrap().to_string();
        assert!(text.contains("END of 1 without") && !text.contains("EndWhile"), "{text}");
    }
}

/// A `/` within a block of FANUC: the rest of the block is executed with the optional blocks only.
#[test]
fn law_a_slash_within_a_block_makes_its_rest_optional() {
    let places = |control, text: &str, optional: bool| {
        let program = Program::new("p", text.as_bytes().to_vec(), control);
        let settings = Settings { skipped_blocks_too: optional, ..Settings::default() };
        let mut places = Vec::new();
        let outcome = interpret(&program, &NoLibrary, &settings, &mut |s| {
            if let Step::Move(m) = s {
                places.push([m.target.0[0], m.target.0[1]]);
            }
        });
        let codes: Vec<_> = outcome.problems.iter().map(|p| p.code).collect();
        (places, codes)
    };
    let whole = |text: &str| format!("G21 G0 X1. F100.\n{text}\nX50. Y50.\nM30\n");
    for (rest, plain, without) in [
        ("X10. /Y10.", "X10. Y10.", "X10."),
        ("X10. /2 Y10.", "X10. Y10.", "X10."),
        ("N5 X[20/2] / Y10. F[6/2]", "X10. Y10.", "X10."),
        ("X10./Y10.\n/X11.", "X10. Y10.\nX11.", "X10."),
        ("#1=20/2\nX#1 /Y#1", "#1=10\nX#1 Y#1", "#1=10\nX#1"),
        ("X10. / M30", "X10. M30", "X10."),
    ] {
        assert_eq!(places(Fanuc, &whole(rest), true), places(Fanuc, &whole(plain), true), "{rest}");
        let skipped = places(Fanuc, &whole(without), false);
        assert_eq!(places(Fanuc, &whole(rest), false), skipped, "{rest}");
    }
    // A jump stands alone in its block, optional or not; Haas has slashes at the head of a block only.
    for (control, text) in [(Fanuc, "X10. /GOTO 7\nN7"), (Haas, "X10. /Y10.")] {
        assert_eq!(places(control, &whole(text), true).1, ["unexpected-sign"]);
    }
}

/// Of two G codes of one modal group in a block the last holds on FANUC; Haas and LinuxCNC refuse them.
#[test]
fn law_the_last_code_of_a_group_holds_on_fanuc() {
    for (block, plain) in [
        ("G0 G1 X10.", "G1 X10."),
        ("G1 G0 X10.", "G0 X10."),
        ("G91 X10. G90", "G90 X10."),
        ("N7 G90 G91 G0 X10.", "G91 G0 X10."),
        ("G55 G54 X10.", "G54 X10."),
        ("G20 G21 X10.", "G21 X10."),
        ("G17 G18 G2 X10. Z0. R5. G19 G18", "G18 G2 X10. Z0. R5."),
    ] {
        let text =
            |block: &str| format!("G21 G10 L2 P2 X5.\nG0 X1. F100.\n{block}\nG90 G1 X20.\nM30\n");
        let (found, plain) = (run(Fanuc, &text(block)), run(Fanuc, &text(plain)));
        assert!(
            !found.codes.is_empty() && found.codes.iter().all(|c| *c == "conflicting-codes"),
            "{block}"
        );
        assert_eq!(plain.codes, [""; 0], "{block}");
        assert_eq!(found.machine, plain.machine, "{block}");
        let kinds = |r: &Run| r.moves.iter().map(|m| m.kind).collect::<Vec<_>>();
        assert_eq!(kinds(&found), kinds(&plain), "{block}");
        for control in [Haas, LinuxCnc] {
            let refused = run(control, &text(block));
            assert_eq!(refused.moves.len(), 1, "{control:?} {block}");
            assert!(refused.codes.contains(&"conflicting-codes"), "{control:?} {block}");
        }
    }
    // The same code twice is one; others stay refused.
    assert_eq!(run(Fanuc, "G21 G90 G90 G0 X1.\nM30\n").codes, [""; 0]);
    assert_eq!(run(Fanuc, "G21 G0 X1.\nG28 G92 X0.\nM30\n").codes, ["conflicting-codes"]);
}

/// #2001 is the length of tool 1 on Haas and #2201 its wear, the other way round on FANUC; #10001 and #11001 of Haas are
/// variables like others.
#[test]
fn law_length_variables_of_haas_are_its_own() {
    let z = |control, text: &str| {
        let found = run(control, &format!("G21 {text}\nG43 H1 G0 Z0.\nM30\n"));
        assert_eq!(found.codes, [""; 0], "{text}");
        found.machine[0][Axis::Z]
    };
    for (text, haas, fanuc) in [
        ("#2001=50.\n#2201=2.", 52.0, 52.0),
        ("G10 L10 P1 R50.\n#2001=40.", 40.0, 90.0),
        ("G10 P1 R50. L10\n#2201=[2.5]", 52.5, 2.5),
        ("G10 L10 P1 R50.\nG10 L11 P1 R2.\n#10001=7.\n#11001=9.", 52.0, 16.0),
        ("G10 L10 P1 R50.\nG10 L11 P1 R2.\n#100=#2001\nG10 L10 P1 R#100", 52.0, 4.0),
        ("#10001=7.\nG10 L10 P1 R[#10001*2]", 14.0, 21.0),
    ] {
        assert_near(&[z(Haas, text), z(Fanuc, text)], &[haas, fanuc], text);
    }
    let inches = run(Haas, "G20\n#2001=2.\nG43 H1 G0 Z0.\nM30\n");
    assert_near(&inches.axis(Axis::Z), &[50.8], "inches");
}
