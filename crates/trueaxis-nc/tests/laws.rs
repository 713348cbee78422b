//! Laws over random programs.

use proptest::prelude::*;
use trueaxis_nc::lexer::Lexer;
use trueaxis_nc::{Control, Dialect, NoLibrary, Program, Settings, Step, interpret};

const CONTROLS: [Control; 4] =
    [Control::LinuxCnc, Control::Fanuc, Control::Sinumerik840d, Control::Heidenhain];

/// Pieces that programs are made of, and some that they are not.
const PIECES: [&str; 56] = [
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
