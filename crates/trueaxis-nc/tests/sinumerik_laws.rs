//! Laws over random SINUMERIK programs.

use proptest::prelude::*;
use trueaxis_nc::moves::Coordinates;
use trueaxis_nc::sinumerik::read_archive;
use trueaxis_nc::{Control, Library, NoLibrary, Program, Settings, Step, interpret};

/// Pieces that programs are made of, and some that they are not.
const PIECES: [&str; 100] = [
    "G0",
    "G1",
    "G2",
    "G3",
    "CIP",
    "CT",
    "G17",
    "G18",
    "G70",
    "G710",
    "G90",
    "G91",
    "G93",
    "G95",
    "G54",
    "G500",
    "G53",
    "SUPA",
    "TRANS",
    "ATRANS",
    "AROT",
    "ROT",
    "SCALE",
    "AMIRROR",
    "ROTS",
    "RPL=30",
    "X1.5",
    "Y-2",
    "Z=R1*2",
    "A=DC(90)",
    "C=IC(30)",
    "I1",
    "J=AC(3)",
    "K2",
    "I1=5",
    "J1=IC(2)",
    "CR=5",
    "AR=90",
    "TURN=2",
    "AP=45",
    "RP=10",
    "G111",
    "G110",
    "F100",
    "S1000",
    "M3",
    "M6",
    "T1",
    "T=\"MILL\"",
    "D0",
    "D1",
    "TRAORI",
    "TRAFOOF",
    "ORIVECT",
    "ORICONCW",
    "A3=1",
    "C3=-1",
    "A2=30",
    "B6=1",
    "NUT=20",
    "PSI=90",
    "R1=R1+1",
    "R2=1/R1",
    "R[R1]=POT(R2)",
    "DEF REAL AA=2, BB[3]",
    "DEF STRING[9] SS=\"a\"",
    "AA=SIN(30)",
    "BB[1]=SET(1,2)",
    "SS=SS<<R1",
    "IF R1<3",
    "IF R1==2 GOTOF LAB1",
    "ELSE",
    "ENDIF",
    "FOR R1=0 TO 3",
    "ENDFOR",
    "WHILE R1<5",
    "ENDWHILE",
    "LOOP",
    "ENDLOOP",
    "REPEAT",
    "UNTIL R1>2",
    "LAB1:",
    "GOTOB LAB1",
    "REPEAT LAB1 P=2",
    "REPEATB LAB1",
    "CASE R1 OF 1 GOTOF LAB1 DEFAULT GOTOB LAB1",
    "SUB1(1,R2)",
    "L5 P2",
    "MCALL CYCLE81(10,0,2,-5)",
    "CYCLE83(10,0,1,-10,,,4)",
    "CYCLE800(0,\"T\",1,57,1,2,3,10,20,30,1,1,1,1)",
    "CYCLE800()",
    "$P_PFRAME=CTRANS(X,1):CROT(Z,9)",
    "$P_UIFR[1,X,TR]=$P_EP[X]",
    "M17",
    "%_N_SUB1_SPF",
    "PROC SUB1(REAL PA, VAR REAL PB) SAVE",
    "/",
    "(",
    "'H1F'",
];

fn survives(source: Vec<u8>) {
    let program = Program::new("p", source, Control::Sinumerik840d);
    assert_eq!(program.print(), program.source());
    for keep_going in [false, true] {
        let settings =
            Settings { most_jumps: 200, deepest_call: 8, keep_going, ..Settings::default() };
        interpret(&program, &NoLibrary, &settings, &mut |step| {
            if let Step::Move(m) = step {
                assert!(m.target.0.iter().all(|v| v.is_finite()), "{m:?}");
                assert!(m.feed.value.is_finite());
                assert!(m.direction.is_none_or(|d| d.iter().any(|v| *v != 0.0)));
            }
        });
    }
    let (archive, _) = read_archive("p", program.source());
    assert!(archive.tools.values().all(|t| t.length_mm.0.iter().all(|v| v.is_finite())));
}

/// Every step and the problems.
fn steps(text: &str) -> (Vec<Step>, Vec<(&'static str, String)>) {
    let program = Program::new("p", text.as_bytes().to_vec(), Control::Sinumerik840d);
    let settings =
        Settings { most_jumps: 200, deepest_call: 8, keep_going: true, ..Settings::default() };
    let mut steps = Vec::new();
    let outcome = interpret(&program, &NoLibrary, &settings, &mut |step| steps.push(step));
    let problems = outcome.problems.iter().map(|d| (d.code, d.place.to_string())).collect();
    (steps, problems)
}

fn joined(pieces: &[(usize, bool)]) -> String {
    pieces
        .iter()
        .map(|(i, blank)| format!("{}{}", PIECES[*i], if *blank { " " } else { "\n" }))
        .collect()
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn law_any_bytes_survive_sinumerik(source in proptest::collection::vec(any::<u8>(), 0..400)) {
        survives(source);
    }

    #[test]
    fn law_mixed_sinumerik_pieces_survive(
        pieces in proptest::collection::vec((0..PIECES.len(), any::<bool>()), 0..60),
    ) {
        survives(joined(&pieces).into_bytes());
    }

    #[test]
    fn law_mutated_sinumerik_programs_survive(
        pieces in proptest::collection::vec((0..PIECES.len(), any::<bool>()), 1..40),
        changes in proptest::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 0..6),
    ) {
        let mut text = joined(&pieces).into_bytes();
        for (index, byte) in changes {
            let at = index.index(text.len());
            text[at] = byte;
        }
        survives(text);
    }

    /// Lines of plain words take a short cut; a comment sends them the long way.
    #[test]
    fn law_the_short_cut_of_sinumerik_changes_nothing(
        pieces in proptest::collection::vec((0..PIECES.len(), any::<bool>()), 0..60),
    ) {
        let text = joined(&pieces);
        let end = |l: &str| if l.contains('%') { "" } else { ";" };
        let long: String = text.lines().map(|l| format!("{l}{}\n", end(l))).collect();
        let (short_steps, short_problems) = steps(&format!("{}\n", text.trim_end()));
        let (long_steps, long_problems) = steps(&long);
        prop_assert_eq!(short_steps, long_steps);
        prop_assert_eq!(short_problems, long_problems);
    }

    /// The machine stays where it is while frames change: a place reached in machine coordinates
    /// reads the same, by whatever frames, when it is stated as a target in them.
    #[test]
    fn law_frames_change_and_the_machine_stays(
        shift in -100.0..100.0_f64,
        angles in prop::array::uniform3(-170.0..170.0_f64),
        place in prop::array::uniform3(-100.0..100.0_f64),
    ) {
        let [x, y, z] = place;
        let [a, b, c] = angles;
        let text = format!(
            "G0 X={x} Y={y} Z={z}\nTRANS X={shift}\nAROT X={a} Y={b} Z={c}\n\
             X=$P_EP[X] Y=$P_EP[Y] Z=$P_EP[Z]\nSUPA X=IC(0) Y=IC(0) Z=IC(0)\n"
        );
        let mut last = None;
        for step in steps(&text).0 {
            if let Step::Move(m) = step
                && m.coordinates == Coordinates::Machine
            {
                last = Some(m.target);
            }
        }
        let last = last.unwrap();
        for (ours, wanted) in last.0.iter().zip(place) {
            prop_assert!((ours - wanted).abs() < 1e-9, "{last:?}");
        }
    }
}

/// One program, whatever its name.
struct Sub(&'static str);

impl Library for Sub {
    fn text(&self, name: &str) -> Result<Vec<u8>, String> {
        let known = name.ends_with(".SPF");
        if known { Ok(self.0.as_bytes().to_vec()) } else { Err("none".to_owned()) }
    }
}

/// A program with parameters may be named by L and a number, too.
#[test]
fn law_a_program_with_parameters_may_be_named_by_l_and_a_number() {
    for (name, text) in [
        ("L140", "PROC L140(INT NUM)\nG0 X=NUM\nRET\n"),
        ("L140", "N10 PROC L140 ( REAL NUM , INT DEPTH=3 ) SAVE\nG0 X=NUM\nM17\n"),
        ("L0123", "PROC L0123(INT NUM)\nG0 X=NUM\nRET\n"),
        ("HOLES", "PROC HOLES(INT NUM)\nG0 X=NUM\nRET\n"),
    ] {
        for (call, wanted) in [("(2)", 2.0), ("(R1)", 7.0), ("(1+3)", 4.0)] {
            let main = format!("R1=7\n{name}{call}\nG0 Y1\nM30\n");
            let program = Program::new("p", main.into_bytes(), Control::Sinumerik840d);
            let mut x = Vec::new();
            let outcome = interpret(&program, &Sub(text), &Settings::default(), &mut |s| {
                if let Step::Move(m) = s {
                    x.push(m.target.0[0]);
                }
            });
            let problems: Vec<_> = outcome.problems.iter().map(ToString::to_string).collect();
            assert_eq!((x, problems), (vec![wanted, wanted], vec![]), "{name}{call} {text}");
        }
    }
}
