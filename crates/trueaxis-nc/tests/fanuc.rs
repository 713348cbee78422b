//! FANUC programs, each worked out by hand.

use std::collections::BTreeMap;

use trueaxis_input::Severity;
use trueaxis_nc::Control::{Fanuc, Haas, LinuxCnc};
use trueaxis_nc::moves::{Axis, Frame, Move, Position};
use trueaxis_nc::{
    Control, Event, Library, MoveKind, NoLibrary, Program, Settings, Step, interpret,
};

/// Subprograms by name, for tests.
struct Subprograms(&'static [(&'static str, &'static str)]);

impl Library for Subprograms {
    fn text(&self, name: &str) -> Result<Vec<u8>, String> {
        let found = self.0.iter().find(|(n, _)| *n == name);
        found.map(|(_, t)| t.as_bytes().to_vec()).ok_or_else(|| "not in this test".to_owned())
    }
}

/// All steps; the program must be without errors.
#[track_caller]
fn steps(text: &str, library: &dyn Library) -> Vec<Step> {
    let program = Program::new("p", text.as_bytes().to_vec(), Control::Fanuc);
    let mut steps = Vec::new();
    let outcome = interpret(&program, library, &Settings::default(), &mut |s| steps.push(s));
    let problems: Vec<_> = outcome.problems.iter().map(ToString::to_string).collect();
    assert!(!outcome.problems.has_errors(), "{problems:?}");
    steps
}

/// Where one axis goes, move by move.
#[track_caller]
fn path(axis: Axis, text: &str, library: &dyn Library) -> Vec<f64> {
    let of = |s: &Step| if let Step::Move(m) = s { Some(m.target[axis]) } else { None };
    steps(text, library).iter().filter_map(of).collect()
}

#[test]
fn macros_count_and_jump() {
    let text = "%\nO0001(COUNT)\n#1=0\nWHILE [#1 LT 3] DO1\n#1=#1+1\nG0 X#1\nEND1\n\
                IF [#1 EQ 3] GOTO 20\nX99\nN20 X[#1*2+1]\nIF [#1 GT 5] THEN #1=0\nX#1\nM30\n%\n";
    assert_eq!(path(Axis::X, text, &NoLibrary), [1.0, 2.0, 3.0, 7.0, 3.0]);
}

#[test]
fn two_letters_of_a_macro_word_are_enough() {
    let text = "%\nO0001\n#1=0\nWH[[#1LT3]AN[1EQ1]]DO1\n#1=#1+1\nG0X#1\nEN1\nIF[#1EQ3]GO20\nX99\n\
                N20X[SQ[AB[-16]]+RO[0.6]]\nIF[#1GT2]TH#1=FI[2.7]\nWHI[#1GT1]DO2\n#1=1\nX[CO[0]*2]\nEND2\nM30\n%\n";
    assert_eq!(path(Axis::X, text, &NoLibrary), [1.0, 2.0, 3.0, 5.0, 2.0]);
}

#[test]
fn functions_of_two_arguments() {
    let text = "#1=3\nG0 X[POW[#1-1,3]]\nX[POW[4,0.5]+1]\nX[ATAN[1,-1]]\nX[ATAN[-1,#1-4]]\nX[ATAN[1]/[-1]]\nX[ATAN[1]]\nX[-POW[2,-1]*2]\nM30\n";
    let found = path(Axis::X, text, &NoLibrary);
    let wanted = [8.0, 3.0, 135.0, 225.0, 135.0, 45.0, -1.0];
    assert!(found.iter().zip(wanted).all(|(a, b)| (a - b).abs() < 1e-9), "{found:?}");
    assert_eq!(found.len(), wanted.len());
    for (control, text, code) in [
        (Fanuc, "G0 X[POW[2]]\n", "missing-value"),
        (Fanuc, "G0 X[POW[-1,0.5]]\n", "not-finite"),
        (Fanuc, "G0 X[SIN[2,3]]\n", "unbalanced-brackets"),
        (Haas, "G0 X[POW[2,3]]\n", "missing-value"),
    ] {
        let program = Program::new("p", text.as_bytes().to_vec(), control);
        let outcome = interpret(&program, &NoLibrary, &Settings::default(), &mut |_| {});
        assert_eq!(outcome.problems.iter().next().unwrap().code, code, "{text}");
    }
}

/// No word is lost beside a jump or loop: it is an error at that word.
#[test]
fn law_words_beside_a_jump_or_loop_are_an_error() {
    let problems = |text: &str| -> Vec<(String, usize, usize)> {
        let program = Program::new("p", text.as_bytes().to_vec(), Fanuc);
        let outcome = interpret(&program, &NoLibrary, &Settings::default(), &mut |_| {});
        let of =
            |d: &trueaxis_input::Diagnostic| (d.code.to_string(), d.place.line, d.place.column);
        outcome.problems.iter().map(of).collect()
    };
    let loops = "N1 WHILE[#1 LT 1]DO1 (A)\n#1=1\nN2 END1 (B)\nN3 IF[1 EQ 2]GOTO 5\nGOTO 5 (C)\nN5 IF[1EQ1]THEN #1=2\nM30\n";
    assert_eq!(problems(loops), []);
    for (text, line, column) in [
        ("G0 X1.\nIF[1 EQ 2] GOTO 5 X9.\nN5 M30\n", 2, 19),
        ("G0 X1.\nGOTO 5 X9.\nN5 M30\n", 2, 8),
        ("G0 X1.\nWHILE[#1 LT 1] DO1 X9.\n#1=1\nEND1\nM30\n", 2, 20),
        ("G0 X1.\nWHILE[#1 LT 1] DO1\n#1=1\nEND1 X9.\nM30\n", 4, 6),
        ("G0 X1.\nX9. GOTO 5\nN5 M30\n", 2, 5),
        ("G0 X1.\n#1=3 IF[1 EQ 1] GOTO 5\nN5 M30\n", 2, 6),
        ("G0 X1.\nIF[1 EQ 1] THEN GOTO 5\nN5 M30\n", 2, 17),
    ] {
        assert_eq!(problems(text), [("unexpected-sign".to_owned(), line, column)], "{text}");
    }
}

#[test]
fn an_empty_parameter_leaves_its_word_out() {
    let text = "G0 X1 Y1\nX2 Y#9\nIF [#9 EQ #0] GOTO 1\nX9\nN1 M30\n";
    assert_eq!(path(Axis::Y, text, &NoLibrary), [1.0, 1.0]);
}

#[test]
fn subprograms_in_the_text_and_in_the_library() {
    let text = "O0001\nG91 G0 X1\nM98 P10 L2\nM98 P30020\nG65 P30 A5 B7\nM30\nO0010\nX10\nM99\n";
    let library =
        Subprograms(&[("O0020", "O0020\nX100\nM99\n"), ("O0030", "O0030\nG90 X[#1+#2]\nM99\n")]);
    let wanted = [1.0, 11.0, 21.0, 121.0, 221.0, 321.0, 12.0];
    assert_eq!(path(Axis::X, text, &library), wanted);
}

/// A call or return follows the move of its block, whether the G code of the move is written or modal.
#[test]
fn law_a_modal_move_in_the_block_of_a_call_or_return_is_executed_first() {
    let ends = |control, text: &str| -> Vec<[f64; 3]> {
        let program = Program::new("p", text.as_bytes().to_vec(), control);
        let mut ends = Vec::new();
        let outcome = interpret(&program, &NoLibrary, &Settings::default(), &mut |s| {
            if let Step::Move(m) = s {
                ends.push([m.target.0[0], m.target.0[1], m.target.0[2]]);
            }
        });
        let problems: Vec<_> = outcome.problems.iter().map(ToString::to_string).collect();
        assert!(outcome.finished && problems.is_empty(), "{text} {problems:?}");
        ends
    };
    for control in [Control::Fanuc, Control::Haas, Control::LinuxCnc] {
        for call in ["X5. Y6. M98 P2", "M98 P2 X5. Y6.", "G0 X5. Y6. M98 P2", "M98 P2 L1 X5. Y6."] {
            let text =
                format!("G21 G90 G54 G0 X0 Y0 Z50.\n{call}\nM30\nO2\nG91 Z1.\nG90\nX7. Y8. M99\n");
            let wanted = [[0.0, 0.0, 50.0], [5.0, 6.0, 50.0], [5.0, 6.0, 51.0], [7.0, 8.0, 51.0]];
            assert_eq!(ends(control, &text), wanted, "{control:?} {call}");
        }
        // The words of the call are not those of the cycle: one hole without a wait, then twice the subprogram.
        let text = "G21 G90 G54 G0 X0 Y0 Z50.\nG99 G81 X1. Z-1. R2. F100.\nX2. M98 P2 L2\nM30\nO2\nG80\nG0 G91 Z1.\nG90\nM99\n";
        let ends = ends(control, text);
        let down = ends.iter().filter(|p| p[2] == -1.0).map(|p| p[0]);
        assert_eq!(down.collect::<Vec<_>>(), [1.0, 2.0], "{control:?}");
        assert_eq!(ends.last(), Some(&[2.0, 0.0, 4.0]), "{control:?}");
    }
    let text =
        "G90 G0 X0 Z50.\nM97 P7 X5.\nX6. G187 P1\nX8. G103 P1\nM30\nN7 G91 Z1.\nG90 X7. M99\n";
    let wanted = [0.0, 5.0, 5.0, 7.0, 6.0, 8.0];
    assert_eq!(ends(Control::Haas, text).iter().map(|p| p[0]).collect::<Vec<_>>(), wanted);
}

#[test]
fn m99_with_p_goes_back_elsewhere() {
    let text = "G0 X1\nM98 P10\nX2\nN50 X3\nM30\nO10\nM99 P50\n";
    assert_eq!(path(Axis::X, text, &NoLibrary), [1.0, 3.0]);
}

/// From the bottom to R with feed, as it went in, then with rapid.
#[test]
fn law_a_tap_leaves_the_hole_with_feed_and_goes_on_with_rapid() {
    for (code, control) in [("G84", Fanuc), ("G74", Fanuc), ("G84", Haas), ("G74", Haas)] {
        let text =
            format!("G90 G0 X0 Y0 Z50.\nG98 {code} X10. Z-5. R2. F100.\nG99 X20.\nG80\nM30\n");
        let program = Program::new("p", text.into_bytes(), control);
        let mut found = Vec::new();
        interpret(&program, &NoLibrary, &Settings::default(), &mut |s| {
            if let Step::Move(m) = s
                && !matches!(m.kind, MoveKind::Dwell { .. })
            {
                found.push((m.kind == MoveKind::Rapid, m.target[Axis::Z]));
            }
        });
        let first =
            [(true, 50.0), (true, 50.0), (true, 2.0), (false, -5.0), (false, 2.0), (true, 50.0)];
        let second = [(true, 50.0), (true, 2.0), (false, -5.0), (false, 2.0)];
        assert_eq!(found, [&first[..], &second].concat(), "{code} {control:?}");
    }
}

#[test]
fn drilling_returns_to_the_initial_plane_or_to_r() {
    let text = "G90 G0 X0 Y0 Z50\nG98 G81 X10 Z-5 R2 F100\nG99 X20\nG80 X30 Z60\nM30\n";
    let wanted = [50.0, 50.0, 2.0, -5.0, 50.0, 50.0, 2.0, -5.0, 2.0, 60.0];
    assert_eq!(path(Axis::Z, text, &NoLibrary), wanted);
    let kinds: Vec<_> = steps(text, &NoLibrary)
        .into_iter()
        .filter_map(|s| if let Step::Move(m) = s { Some(m.kind) } else { None })
        .collect();
    // G80 brings the rapid before the cycle back.
    assert_eq!(kinds[9], MoveKind::Rapid);
}

#[test]
fn deep_holes_are_left_after_each_peck() {
    // Q 4 from R 1: −3, then −5; back into the hole 0.254 mm above the bottom reached.
    let text = "G0 Z10\nG99 G83 Z-5 R1 Q4 F100\nM30\n";
    assert_eq!(path(Axis::Z, text, &NoLibrary), [10.0, 10.0, 1.0, -3.0, 1.0, -2.746, -5.0, 1.0]);
}

#[test]
fn work_offsets_move_the_frame_not_the_machine() {
    let text = "G10 L2 P2 X100\nG90 G0 X5\nG55\nG91 X1\nG90 G53 X0\nM30\n";
    // Machine 5 reads −95 in G55; machine 0 reads −100.
    assert_eq!(path(Axis::X, text, &NoLibrary), [5.0, -94.0, -100.0]);
}

#[test]
fn further_offsets_and_tool_lengths_are_set_by_g10() {
    let text = "G10 L20 P3 X-40\nG90 G0 X5\nG54.1 P3\nG91 X0\nM30\n";
    // Machine 5 reads 45 from an origin at −40.
    assert_eq!(path(Axis::X, text, &NoLibrary), [5.0, 45.0]);
    let text = "G10 L10 P2 R120\nG90 G0 G43 H2 Z10\nG49 G91 Z0\nM30\n";
    // G49 takes the 120 off the end point: the nose goes to where the tip was.
    assert_eq!(path(Axis::Z, text, &NoLibrary), [10.0, 10.0]);
    let text = "G10 L10 P2 R120\nG90 G0 G43 H2 Z10\nG49 Z130\nM30\n";
    assert_eq!(path(Axis::Z, text, &NoLibrary), [10.0, 130.0]);
}

#[test]
fn radius_arcs_take_the_short_or_the_long_way() {
    for (radius, center) in [("R10", [0.0, 10.0]), ("R-10", [10.0, 0.0])] {
        let text = format!("G17 G90 G0 X0 Y0\nG2 X10 Y10 {radius} F100\nM30\n");
        let arc = steps(&text, &NoLibrary).into_iter().find_map(|s| match s {
            Step::Move(m) => {
                if let MoveKind::Arc(arc) = m.kind {
                    Some(arc)
                } else {
                    None
                }
            }
            Step::Event(..) => None,
        });
        let arc = arc.unwrap();
        assert!(!arc.ccw);
        // Clockwise the short arc from (0, 0) to (10, 10) has its centre right of the chord.
        let right = [10.0 - center[0], 10.0 - center[1]];
        assert!((0..2).all(|i| (arc.center_mm[i] - right[i]).abs() < 1e-12), "{arc:?}");
    }
}

#[test]
fn reference_points_are_reached_by_way_of_the_words() {
    let text = "G90 G0 X5 Z5\nG91 G28 Z2\nM30\n";
    assert_eq!(path(Axis::Z, text, &NoLibrary), [5.0, 7.0, 0.0]);
    assert_eq!(path(Axis::X, text, &NoLibrary), [5.0, 5.0, 5.0]);
}

#[test]
fn the_tip_is_programmed_from_g43_4_to_g49() {
    let found: Vec<_> = steps("T1 M6\nG43.4 H0 X1\nG1 B10 F100\nG49\nM30\n", &NoLibrary)
        .into_iter()
        .filter_map(|s| match s {
            Step::Event(Event::ToolCentre(on), origin) => Some((on, origin.line)),
            _ => None,
        })
        .collect();
    assert_eq!(found, [(true, 2), (false, 4)]);
}

#[test]
fn tool_directions_come_with_the_move() {
    let text = "G43.5 H0\nG1 X1 I0 J0.6 K0.8 F100\nX2\nM30\n";
    let of = |s: Step| if let Step::Move(m) = s { Some(m.direction) } else { None };
    let found: Vec<_> = steps(text, &NoLibrary).into_iter().filter_map(of).collect();
    assert_eq!(found, [Some([0.0, 0.6, 0.8]), None]);
}

#[test]
fn a_preamble_with_everything_still_moves() {
    let text = "G0 G15 G17 G40 G49 G50 G69 G80 G90 X5\nM30\n";
    assert_eq!(path(Axis::X, text, &NoLibrary), [5.0]);
}

/// The times that a program waits, or what it is refused for.
fn waits(control: Control, text: &str) -> Result<Vec<f64>, &'static str> {
    let (mut steps, program) = (Vec::new(), Program::new("p", text.as_bytes().to_vec(), control));
    let outcome = interpret(&program, &NoLibrary, &Settings::default(), &mut |s| steps.push(s));
    let seconds = steps.into_iter().filter_map(|s| match s {
        Step::Move(Move { kind: MoveKind::Dwell { seconds }, .. }) => Some(seconds),
        _ => None,
    });
    match outcome.problems.iter().find(|p| p.severity == Severity::Error) {
        Some(problem) => Err(problem.code),
        None => Ok(seconds.collect()),
    }
}

/// P of FANUC counts milliseconds and takes no fraction; of Haas P10. is 10 s and P10 is 10 ms; of LinuxCNC it counts
/// seconds. In a drilling cycle as in G4, whatever variable or sign is written.
#[test]
fn law_a_dwell_lasts_as_its_control_counts() {
    let hole = |p: &str| format!("G0 Z5\nG82 Z-5 R1 {p} F100\nG80\n");
    for (p, fanuc, haas, linuxcnc) in [
        ("P500", Ok(0.5), 0.5, 500.0),
        ("P1.5", Err("bad-dwell"), 1.5, 1.5),
        ("P10.", Ok(0.01), 10.0, 10.0),
        ("P #1", Ok(0.25), 0.25, 250.0),
        ("P[200+50]", Ok(0.25), 0.25, 250.0),
        ("P +2.5", Err("bad-dwell"), 2.5, 2.5),
    ] {
        for text in [format!("G4 {p}\n"), hole(p)] {
            let text = format!("G21 G90 G94\n#1=250\n{text}M30\n");
            assert_eq!(waits(Fanuc, &text), fanuc.map(|s| vec![s]), "{text}");
            assert_eq!(waits(Haas, &text), Ok(vec![haas]), "{text}");
            assert_eq!(waits(LinuxCnc, &text), Ok(vec![linuxcnc]), "{text}");
        }
    }
    assert_eq!(waits(Fanuc, "G4 X1.5\nG4 U2\nM30\n"), Ok(vec![1.5, 2.0]));
}

#[test]
fn the_x_of_a_dwell_moves_nothing() {
    let found = path(Axis::X, "G1 F100 X20\nG4 X1.5\nY5\nM30\n", &NoLibrary);
    assert!(!found.is_empty() && found.iter().all(|x| *x == 20.0), "{found:?}");
}

#[test]
fn work_offsets_turn_in_space() {
    // About X by 90°: y goes to z. Machine 0, 0, 0 from the origin 0, 0, 5 reads z −5 turned back:
    // the vector (0, 0, −5) is y −5.
    let turned = Frame {
        linear: [[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]],
        shift: Position([0.0, 0.0, 5.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]),
    };
    let program = Program::new("p", b"G55 G91 G0 X0\nM30\n".to_vec(), Control::Fanuc);
    let work_offsets = BTreeMap::from([(2, turned)]);
    let settings = Settings { work_offsets, ..Settings::default() };
    let (mut frames, mut places) = (Vec::new(), Vec::new());
    let outcome = interpret(&program, &NoLibrary, &settings, &mut |step| match step {
        Step::Event(Event::Frame(frame), _) => frames.push(frame),
        Step::Move(m) => places.push(m.target),
        Step::Event(..) => {}
    });
    assert_eq!(outcome.problems.iter().count(), 0);
    assert_eq!(frames, [turned]);
    assert_eq!(places[0].0[..3], [0.0, -5.0, 0.0]);
}

/// Haas Automation, "Mill Operator's Manual", M97: the local subprogram follows M30 and ends with M99.
#[test]
fn haas_calls_parts_of_its_program() {
    let text = "%\nO00001\nG0 X1.\nM97 P1000 L3\nX9.\nM30\nN1000 G91 G0 X2.\nM99 (BACK)\n%\n";
    let x_mm = |control| {
        let program = Program::new("p", text.as_bytes().to_vec(), control);
        let (mut x_mm, settings) = (Vec::new(), Settings::default());
        let outcome = interpret(&program, &NoLibrary, &settings, &mut |step| {
            if let Step::Move(m) = step {
                x_mm.push(m.target[Axis::X]);
            }
        });
        assert!(!outcome.problems.has_errors(), "{:?}", outcome.problems);
        (x_mm, outcome.problems.iter().any(|p| p.code == "not-applied"))
    };
    assert_eq!(x_mm(Control::Haas), (vec![1.0, 3.0, 5.0, 7.0, 16.0], false));
    // FANUC has no such call: that motion is missing is a warning.
    assert_eq!(x_mm(Control::Fanuc), (vec![1.0, 9.0], true));
}

#[test]
fn what_goes_out_of_the_control_is_said() {
    let text = "%\nO0001\nPOPEN\nDPRNT[TRUEAXIS*HITS*MM]\nG0 X0 Y0 Z50.\nT7 M6\nG31 X8. Y6. F100.\n\
                IF[ABS[#5061-8.]GT0.005]GOTO1\n#3000=1(NO TOUCH)\n\
                N1 DPRNT[H1*T#4120[40]*X#5061[44]*Y#5062[41]*A-30.]\nPCLOS\nM30\n%\n";
    let steps = steps(text, &NoLibrary);
    let logged =
        |s: &Step| if let Step::Event(Event::Log(text), _) = s { Some(text.clone()) } else { None };
    let logged: Vec<String> = steps.iter().filter_map(logged).collect();
    // 0.01 mm before the end of a way of 10 mm along (0.8, 0.6): 7.992 and 5.994.
    assert_eq!(logged, ["TRUEAXIS HITS MM", "H1 T7 X7.9920 Y6.0 A-30."]);
}

/// I, then each peck less by J, none below K; the next hole keeps them, Q ends them.
#[test]
fn haas_pecks_become_shorter() {
    let run = |text: &str| -> (Vec<f64>, Vec<String>) {
        let program = Program::new("p", text.as_bytes().to_vec(), Haas);
        let mut down = Vec::new();
        let outcome = interpret(&program, &NoLibrary, &Settings::default(), &mut |s| {
            if let Step::Move(m) = s
                && m.kind == MoveKind::Linear
            {
                down.push(m.target[Axis::Z]);
            }
        });
        (down, outcome.problems.iter().map(|d| d.code.to_string()).collect())
    };
    for code in ["G83", "G73"] {
        let begin = format!("G21 G90 G0 X0 Y0 Z50.\nG99 {code} Z-28. R2.");
        let (down, problems) =
            run(&format!("{begin} I10. J4. K3. F100.\nX5.\nX9. Q15.\nG80\nM30\n"));
        // 10, 6, 3, 3, 3, 3 and the remaining 2 from Z2 to Z-28.
        let one = [-8.0, -14.0, -17.0, -20.0, -23.0, -26.0, -28.0];
        assert_eq!(down, [&one[..], &one, &[-13.0, -28.0]].concat(), "{code}");
        assert!(problems.is_empty(), "{problems:?}");
        assert_eq!(run(&format!("{begin} I10. K3. F100.\nM30\n")).1, ["cycle-without-q"]);
        let (down, problems) = run(&format!("{begin} Q15. K3. F100.\nG80\nM30\n"));
        assert_eq!((down, &problems[..]), (vec![-13.0, -28.0], &["not-applied".to_owned()][..]));
    }
}
