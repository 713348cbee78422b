//! Laws over random programs.

use proptest::prelude::*;
use trueaxis_nc::lexer::Lexer;
use trueaxis_nc::{Control, Dialect, NoLibrary, Program, Settings, Step, interpret};

const CONTROLS: [Control; 4] =
    [Control::LinuxCnc, Control::Fanuc, Control::Sinumerik840d, Control::Heidenhain];

/// Pieces that programs are made of, and some that they are not.
const PIECES: [&str; 72] = [
    "G0",
    "G1",
    "G2",
    "G3 ",
    "G17",
    "G20",
    "G21",
    "G28",
    "G43 H1",
    "G54",
    "G55",
    "G80",
    "G81",
    "G90",
    "G91",
    "G92",
    "G10 L2 P1",
    "M3",
    "M6 T1",
    "M98 P1",
    "M99",
    "X1.5",
    "Y-2",
    "Z[#1+2]",
    "I1",
    "J0",
    "R5",
    "F100",
    "S1000",
    "Q1",
    "#1=5",
    "#<a>=#1",
    "#2=[1/0]",
    "sin[30]",
    "o1 sub",
    "o1 endsub",
    "o1 call [2]",
    "o2 while [1]",
    "o2 endwhile",
    "o3 if [#1 gt 2]",
    "o3 else",
    "o3 endif",
    "o4 repeat [3]",
    "o4 endrepeat",
    "O0001",
    "IF [#1 GT 0] GOTO 10",
    "WHILE [#1 LT 3] DO1",
    "END1",
    "N10",
    "G16",
    "G15",
    "G51 P2000",
    "G50",
    "G51.1 X5",
    "G50.1",
    "G68 R30",
    "G68 X1 Y2 Z3 I1 J1 K0 R30",
    "G69",
    "G68.2 X1 Y2 Z3 I10 J20 K30",
    "G53.1",
    "G66 P1 A1",
    "G67",
    "G43.5 H1",
    "#5221=7",
    "G53 Z0",
    "\n",
    "\n",
    "\r\n",
    "(note)",
    "(open",
    "%",
    "/",
];

fn survives(source: Vec<u8>, control: Control) {
    let program = Program::new("p", source, control);
    assert_eq!(program.print(), program.source());
    let mut end = 0;
    for block in program.blocks() {
        assert_eq!(block.span.start, end);
        assert!(block.span.end > end);
        end = block.span.end;
    }
    assert_eq!(end, program.source().len());
    let _ = program.check();
    for keep_going in [false, true] {
        let settings =
            Settings { most_jumps: 200, deepest_call: 8, keep_going, ..Settings::default() };
        interpret(&program, &NoLibrary, &settings, &mut |step| {
            if let Step::Move(m) = step {
                assert!(m.target.0.iter().all(|v| v.is_finite()), "{m:?}");
                assert!(m.feed.value.is_finite());
            }
        });
    }
}

/// Every step, and the codes of the problems.
fn steps(text: &str, control: Control) -> (Vec<Step>, Vec<&'static str>) {
    let program = Program::new("p", text.as_bytes().to_vec(), control);
    let settings =
        Settings { most_jumps: 200, deepest_call: 8, keep_going: true, ..Settings::default() };
    let mut steps = Vec::new();
    let outcome = interpret(&program, &NoLibrary, &settings, &mut |step| steps.push(step));
    (steps, outcome.problems.iter().map(|d| d.code).collect())
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn law_any_bytes_survive(source in proptest::collection::vec(any::<u8>(), 0..400), which in 0..4_usize) {
        survives(source, CONTROLS[which]);
    }

    #[test]
    fn law_mixed_pieces_survive(
        pieces in proptest::collection::vec((0..PIECES.len(), any::<bool>()), 0..60),
        which in 0..4_usize,
    ) {
        let text: String = pieces
            .iter()
            .map(|(i, blank)| format!("{}{}", PIECES[*i], if *blank { " " } else { "" }))
            .collect();
        survives(text.into_bytes(), CONTROLS[which]);
    }

    #[test]
    fn law_mutated_programs_survive(
        pieces in proptest::collection::vec(0..PIECES.len(), 1..40),
        changes in proptest::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 0..6),
        which in 0..4_usize,
    ) {
        let mut text = pieces.iter().map(|i| PIECES[*i]).collect::<Vec<_>>().join("\n").into_bytes();
        for (index, byte) in changes {
            let at = index.index(text.len());
            text[at] = byte;
        }
        survives(text, CONTROLS[which]);
    }

    /// Lines of plain words take a short cut; a comment sends them the long way.
    #[test]
    fn law_the_short_cut_changes_nothing(
        pieces in proptest::collection::vec((0..PIECES.len(), any::<bool>()), 0..60),
        fanuc in any::<bool>(),
    ) {
        let text: String = pieces
            .iter()
            .filter(|(i, _)| PIECES[*i] != "(open")
            .map(|(i, blank)| format!("{}{}", PIECES[*i], if *blank { " " } else { "\n" }))
            .collect();
        let control = if fanuc { Control::Fanuc } else { Control::LinuxCnc };
        let long: String = text.lines().map(|l| format!("{l}()\n")).collect();
        prop_assert_eq!(steps(&text, control), steps(&long, control));
    }

    /// Lines of straight moves with numbers of all lengths: the quick way and the long way.
    #[test]
    fn law_straight_lines_are_read_like_all_others(
        lines in proptest::collection::vec(
            proptest::collection::vec((0..16_usize, -1.0..1.0_f64, 0..9_i32, 0..9_usize), 0..7),
            1..30,
        ),
        settings in (any::<bool>(), any::<bool>(), any::<bool>(), any::<bool>()),
    ) {
        let (fanuc, inches, incremental, crlf) = settings;
        let mut text = String::from("F100 G1\n");
        text += if inches { "G20\n" } else { "G21\n" };
        text += if incremental { "G91\n" } else { "G90\n" };
        for line in lines {
            for (letter, value, exponent, digits) in line {
                let letter = char::from(b"XYZABCUVWFGGNxgf"[letter]);
                let value = value * 10_f64.powi(exponent);
                match letter {
                    'G' | 'g' => text += &format!("{letter}{} ", i32::from(value > 0.0)),
                    'N' => text += &format!("N{exponent} "),
                    'F' | 'f' => text += &format!("{letter}{:.digits$}", value.abs()),
                    _ if exponent % 2 == 0 => text += &format!("{letter}{value:+.digits$}"),
                    _ => text += &format!("{letter}{value:.digits$}"),
                }
            }
            text += if crlf { "\r\n" } else { "\n" };
        }
        let control = if fanuc { Control::Fanuc } else { Control::LinuxCnc };
        let long: String = text.lines().map(|l| format!("{l}()\n")).collect();
        prop_assert_eq!(steps(&text, control), steps(&long, control));
    }

    /// Frames change where a place is written, never where the machine is.
    #[test]
    fn law_frames_leave_the_machine_where_it_is(
        codes in proptest::collection::vec((0..14_usize, -90.0..90.0_f64, 1.0..9.0_f64), 1..12),
    ) {
        let mut text = String::from("G90 G0 X11. Y-7. Z5.\n");
        for (code, angle, size) in codes {
            text += &match code {
                0 => format!("G51 X{size:.3} Y1. Z0 P{size:.3}"),
                1 => format!("G51 X0 Y{size:.3} Z1. I{size:.3} J-0.5 K1.5"),
                2 => "G50".to_owned(),
                3 => format!("G51.1 X{size:.3}"),
                4 => "G50.1 X0".to_owned(),
                5 => format!("G68 X{size:.3} Y2. R{angle:.3}"),
                6 => "G69".to_owned(),
                7 => format!("G68.2 X1. Y{size:.3} Z3. I{angle:.3} J20. K-{size:.3}"),
                8 => format!("G68.4 X1. Y0 Z3. I{size:.3} J{angle:.3} K0"),
                9 => format!("G68.2 P1 Q213 X0 Y{size:.3} Z0 I{angle:.3} J{size:.3} K7."),
                10 => format!("G52 X{size:.3} Z{angle:.3}"),
                11 => format!("G10 L2 P1 X{size:.3} Y{angle:.3}"),
                12 => "G18".to_owned(),
                _ => format!("G55\nG10 L2 P0 Z{size:.3}"),
            };
            text += "\nG91 G0 X0\nG90\n";
        }
        let (steps, problems) = steps(&text, Control::Fanuc);
        prop_assert!(problems.is_empty(), "{problems:?}");
        let mut frame = trueaxis_nc::moves::Frame::IDENTITY;
        for step in steps {
            match step {
                Step::Event(trueaxis_nc::Event::Frame(new), _) => frame = new,
                Step::Move(m) => {
                    let machine = frame.place(&m.target).0;
                    for (is, was) in machine.iter().zip([11.0, -7.0, 5.0]) {
                        prop_assert!((is - was).abs() < 1e-6, "{machine:?}\n{text}");
                    }
                }
                Step::Event(..) => {}
            }
        }
    }

    #[test]
    fn law_tokens_are_the_text(source in proptest::collection::vec(any::<u8>(), 0..400), which in 0..4_usize) {
        let mut end = 0;
        for token in Lexer::new(&source, Dialect::of(CONTROLS[which]), 0) {
            prop_assert_eq!(token.start, end);
            prop_assert!(token.end > token.start);
            end = token.end;
        }
        prop_assert_eq!(end, source.len());
    }

    #[test]
    fn law_written_numbers_are_read_back(x in -1e6..1e6_f64, digits in 0..9_usize) {
        let text = format!("G90\nG0X{x:.digits$}\n");
        let mut found = Vec::new();
        let program = Program::new("p", text.into_bytes(), Control::LinuxCnc);
        interpret(&program, &NoLibrary, &Settings::default(), &mut |step| {
            if let Step::Move(m) = step {
                found.push(m.target.0[0]);
            }
        });
        let wanted: f64 = format!("{x:.digits$}").parse().unwrap();
        prop_assert_eq!(found, vec![wanted]);
    }
}
