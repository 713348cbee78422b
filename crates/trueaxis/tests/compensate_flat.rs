//! Programs whose blocks are executed at several places: unrolled they go the same way, and are
//! compensated as any other.

mod library;

use library::{bare, machine, with_lost_motion};
use std::path::PathBuf;
use trueaxis::compensate::program::{MARK, ProgramOptions, Rewritten, compensate_program};
use trueaxis::files::disk;
use trueaxis::input::Diagnostics;
use trueaxis::machine::Machine;
use trueaxis::nc::moves::{Event, Move, MoveKind, Origin, Step};
use trueaxis::nc::{Control, Library, Program, Settings, interpret};
use trueaxis::simulate::SetUp;

const LINUXCNC: &str = "\
(head)
G21 G90 G94 F500
o100 sub
  #3 = [#1 + 10]
  G1 X[#1] Y#2 (corner)
  N7 X#3 ; across
  G91 G1 Y[2*3] F[100*[#5+1]]
  G90
o100 endsub
G0 X100 Y100 Z-50
#5 = 0 (counts)
o1 while [#5 LT 3]
  o100 call [100 + 20*#5] [110]
  #5 = [#5 + 1]
o1 endwhile
o2 if [#5 EQ 3]
  G2 X[150+#5] Y116 I[3/2] (half a turn)
o2 else
  G1 X0 (never)
o2 endif
M2
";

const FANUC: &str = "\
%
O0001(LOOPS)
G21 G90 G94 F500.
G0 X100. Y100. Z-50.
#1=0
WHILE[#1LT3]DO1
N10 G1 X[100.+#1*20.] Y110. (ROUND)
M98 P1000 L2
#1=#1+1
END1
IF[#1EQ3]GOTO20
G1 X0 (NEVER)
N20 G65 P1001 A120. B5. (MACRO)
M30
O1000
G91 G1 Y5. (UP)
G90 M99
O1001
G1 X#1 F[500+#2]
Z-#2 Y-#100
M99
%
";

const SINUMERIK: &str = "\
; head
N10 G54 G17 G710 G90 G94 F500
N20 DEF INT II
N30 R1=100 ; first
N40 G0 X=R1 Y100 Z-50
N50 FOR II=0 TO 2
N60 G1 X=R1+20*II Y=AC(110) ; round
N70 UP1
N80 ENDFOR
LAB1: G1 Y=IC(-R1/50)
G1 X105 F=R1*2
LAB2:
REPEAT LAB1 LAB2 P=2
IF R1>50 GOTOF ENDE
G1 X0 ; never
ENDE: TRANS X=R1/10
G2 X110 Y140 CR=R1/4
M30
";

const UP1: &str = "PROC UP1\nG91 G1 Y5 ; up\nG90\nRET\n";

const HEIDENHAIN: &str = "\
0 BEGIN PGM A MM
1 Q1 = +100
2 Q2 = +3
3 Q3 = +40
4 L X+Q1 Y+100 Z-50 R0 FMAX
5 LBL 1
6 L IX+10 F500 ; step
7 L IY-Q2
8 CALL LBL 1 REP 2
9 FN 1: Q1 = +Q1 + +40
10 L X+Q1 FQ1
11 CALL LBL 2
12 L Z-Q3
13 CALL LBL 2
14 FN 9: IF +Q1 EQU +140 GOTO LBL 5
15 L X+0 ; never
16 LBL 5
17 L X+150 ; last
18 M30
19 LBL 2
20 L IY+5 ; up
21 LBL 0
22 END PGM A MM
";

const PROGRAMS: [(Control, &str, &str, &[&str]); 4] = [
    (Control::LinuxCnc, "a.ngc", LINUXCNC, &["(corner)", "; across", "(half a turn)"]),
    (Control::Fanuc, "a.nc", FANUC, &["(ROUND)", "(UP)", "(MACRO)"]),
    (Control::Sinumerik840d, "a.mpf", SINUMERIK, &["; round", "; up", "; first"]),
    (Control::Heidenhain, "a.h", HEIDENHAIN, &["; step", "; up", "; last"]),
];

/// The program in a folder of its own, beside its subprogram.
fn program(control: Control, name: &str, text: &str) -> Program {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(format!("flat-{name}"));
    std::fs::create_dir_all(&folder).unwrap();
    std::fs::write(folder.join("up1.spf"), UP1).unwrap();
    let path = folder.join(name).display().to_string();
    Program::new(&path, text.as_bytes().to_vec(), control)
}

struct Beside;

impl Library for Beside {
    fn text(&self, name: &str) -> Result<Vec<u8>, String> {
        match name.to_ascii_uppercase().starts_with("UP1") {
            true => Ok(UP1.as_bytes().to_vec()),
            false => Err("not there".to_owned()),
        }
    }
}

/// The moves without the lines that they come from.
fn moves(program: &Program) -> Vec<Move> {
    let mut moves = Vec::new();
    let outcome = interpret(program, &Beside, &Settings::default(), &mut |step| {
        if let Step::Move(m) = step {
            moves.push(Move { origin: Origin::default(), ..m });
        }
    });
    assert!(outcome.finished, "{:?}", outcome.problems);
    moves
}

fn flat(machine: &Machine, program: &Program) -> (Option<Rewritten>, Diagnostics) {
    let options = ProgramOptions { flat: true, increments: None, ..ProgramOptions::default() };
    compensate_program(machine, program, &SetUp { files: disk(), ..SetUp::default() }, &options)
}

#[test]
fn law_an_unrolled_program_makes_the_same_moves() {
    // Circles stay circles where nothing is to be corrected.
    let machine = bare("three-axis-mill");
    for (control, name, text, kept) in PROGRAMS {
        let program = program(control, name, text);
        let (done, problems) = flat(&machine, &program);
        let Some(done) = done else { panic!("{name}: {problems:?}") };
        let new = String::from_utf8(done.text.into_vec()).unwrap();
        let unrolled = Program::new(name, new.clone().into_bytes(), control);
        let (was, is) = (moves(&program), moves(&unrolled));
        assert!(was.len() > 8, "{name} {}", was.len());
        assert_eq!(was, is, "{name}:\n{new}");
        for comment in kept {
            assert!(new.contains(comment), "{name} lost {comment}:\n{new}");
        }
        let gone =
            ["never", "NEVER", "#", "=R", "Q1", "o1", "CALL", "M98", "REPEAT", "GOTO", "FOR"];
        for word in gone {
            let found = new.lines().filter(|l| !l.contains(MARK)).find(|l| l.contains(word));
            assert_eq!(found, None, "{name}:\n{new}");
        }
    }
}

#[test]
fn law_an_unrolled_program_is_compensated_as_any_other() {
    let machine = with_lost_motion(&machine("three-axis-mill"), 2e-3);
    for (control, name, text, _) in PROGRAMS {
        let program = program(control, &format!("c-{name}"), text);
        let (by_itself, reported) = compensate_program(
            &machine,
            &program,
            &SetUp { files: disk(), ..SetUp::default() },
            &ProgramOptions { increments: None, ..ProgramOptions::default() },
        );
        assert!(reported.iter().any(|d| d.code == "unrolled"), "{name}: {reported:?}");
        let (done, problems) = flat(&machine, &program);
        let Some(done) = done else { panic!("{name}: {problems:?}") };
        assert_eq!(by_itself.map(|d| d.text), Some(done.text), "{name}");
        let (before, after) = (done.proof.before, done.proof.after);
        assert!(before.tip_end.value > 2e-3, "{name} {before:?}");
        assert!(done.found.undecided == 0 && after.tip_end.value <= 1e-9, "{name} {after:?}");
        assert!(after.tip.value <= 1e-3, "{name} {after:?}");
    }
}

#[test]
fn what_does_not_unroll_is_named() {
    // A modal macro is called by moves: the block of the move is not the only one to be executed.
    let text = "%\nO1\nG21 G90 G94 F500.\nG0 X100. Y100. Z-50.\nG66 P1000\nX110.\nG67\nM30\nO1000\nG1 Y#100 Z-51.\nM99\n%\n";
    let program = program(Control::Fanuc, "modal.nc", text);
    let (done, problems) = flat(&bare("three-axis-mill"), &program);
    match done {
        // Or it is executed to the same moves.
        Some(done) => {
            let new = Program::of("m.nc", done.text, Control::Fanuc);
            assert_eq!(moves(&program), moves(&new));
        }
        None => assert!(problems.iter().any(|d| d.code == "not-unrolled"), "{problems:?}"),
    }
}

const TURNING: &str = "\
G18 G21 G90 G94 F500
G0 X130 Y110 Z-40
o100 sub
  G0 X105 Z-50
  o101 repeat [2]
    G1 X[#<_x>+5] Z[#<_z>-4] F20
    G1 Z[#<_z>-3] A0.5
  o101 endrepeat
  G3 X119 Z-68 R4
  G1 X125
o100 endsub
G71 Q100 X130 Z-45 D0.5 I4 R1 F300 (rough)
X131
G70 Q100 X130 Z-45 F200
M2
";

/// A turning cycle becomes its moves; the blocks of its profile are none.
#[test]
fn law_turning_cycles_unroll_to_their_moves() {
    let program = program(Control::LinuxCnc, "turning.ngc", TURNING);
    let (done, problems) = flat(&bare("three-axis-mill"), &program);
    let Some(done) = done else { panic!("{problems:?}") };
    let new = String::from_utf8(done.text.into_vec()).unwrap();
    let unrolled = Program::new("turning.ngc", new.clone().into_bytes(), Control::LinuxCnc);
    let (was, is) = (moves(&program), moves(&unrolled));
    assert!(was.len() > 40, "{}", was.len());
    assert_eq!(was.len(), is.len(), "{new}");
    for (a, b) in was.iter().zip(&is) {
        let apart = a.target.minus(&b.target).0.iter().fold(0.0_f64, |m, d| m.max(d.abs()));
        assert!(apart < 1e-3 && a.feed == b.feed, "{a:?}\n{b:?}");
        let same = std::mem::discriminant(&a.kind) == std::mem::discriminant(&b.kind);
        assert!(same, "{a:?}\n{b:?}");
    }
    assert!(["G71", "G70", "Q100", "o100"].iter().all(|w| !new.contains(w)), "{new}");
    let machine = with_lost_motion(&machine("three-axis-mill"), 2e-3);
    let options = ProgramOptions { increments: None, ..ProgramOptions::default() };
    let setup = SetUp { files: disk(), ..SetUp::default() };
    let (done, problems) = compensate_program(&machine, &program, &setup, &options);
    let Some(done) = done else { panic!("{problems:?}") };
    assert!(done.proof.after.tip_end.value <= 1e-9, "{:?}", done.proof.after);
}

/// Cycles whose arguments, places and calls are computed; lines of Klartext with `/` before their number.
const CYCLES: [(Control, &str, &str); 5] = [
    (
        Control::Heidenhain,
        "holes.h",
        "0 BEGIN PGM A MM\n1 Q3 = +50\n2 Q9 = +20\n3 L X+100 Y+100 Z-10 R0 FMAX\n\
         4 CYCL DEF 200 DRILLING~\n   Q200=2 ;SET-UP~\n   Q201=-Q9 ;DEPTH~\n   Q206=Q3 ;FEED~\n   Q202=Q9/2 ~\n\
         \x20  Q203=-60~\n   Q204=50\n\
         5 L X+110 Y+Q9 FMAX M99\n6 Q9 = +30\n/7 L X+Q3 Y+Q9 R0 FMAX M99\n8 LBL 1\n9 L IX+Q9 FMAX M99\n\
         10 CALL LBL 1 REP 2\n11 L Z-Q9 FMAX\n/12 M30\n13 END PGM A MM\n",
    ),
    (
        Control::Heidenhain,
        "old.h",
        "0 BEGIN PGM A MM\n1 Q3 = +50\n2 L X+100 Y+100 Z-10 R0 FMAX\n3 CYCL DEF 1.0 PECKING\n\
         4 CYCL DEF 1.1 SET UP 2\n5 CYCL DEF 1.2 DEPTH -Q3\n6 CYCL DEF 1.3 PECKG 20\n7 CYCL DEF 1.4 DWELL 0\n\
         8 CYCL DEF 1.5 FQ3\n9 L X+Q3 FMAX M99\n10 M30\n11 END PGM A MM\n",
    ),
    (
        Control::Sinumerik840d,
        "holes.mpf",
        "G17 G710 G90 G94 F500\nR1=100 R2=-60\nG0 X=R1 Y100 Z-30\nCYCLE81(-30,-40,2,R2)\nX=R1+20\n\
         MCALL CYCLE83(-30,-40,2,R2,,-45,,2,0,0,1,0)\nX=R1+30\nY=IC(R1/10)\nMCALL\nG0 Z-30\nM30\n",
    ),
    (
        Control::Fanuc,
        "holes.nc",
        "%\nO1\nG21 G90 G94 F500.\n#1=100.\n#2=-60.\nG0 X#1 Y100. Z-30.\nG99 G81 X[#1+10.] Z#2 R-38. F[#1*3]\n\
         #1=130.\nX#1\nG91 G83 X[#1-125.] Y10. Z-12. R-6. Q[ABS[#2]/20] K2\nG90 G80\nG0 Z-30.\nM30\n%\n",
    ),
    (
        Control::LinuxCnc,
        "holes.ngc",
        "G21 G90 G94 F500\n#1=100\nG0 X#1 Y100 Z-30\nG98 G81 X[#1+10] Z[0-#1/2] R-38 F[#1*3]\n#1=130\nX#1\nG80\n\
         G0 Z-30\nM2\n",
    ),
];

#[test]
fn law_cycles_with_computed_arguments_unroll_to_their_moves() {
    let lost = with_lost_motion(&machine("three-axis-mill"), 2e-3);
    for (control, name, text) in CYCLES {
        let program = program(control, name, text);
        let (done, problems) = flat(&bare("three-axis-mill"), &program);
        let Some(done) = done else { panic!("{name}: {problems:?}") };
        let new = String::from_utf8(done.text.into_vec()).unwrap();
        let unrolled = Program::new(name, new.clone().into_bytes(), control);
        let plain = |all: Vec<Move>| -> Vec<_> {
            // A rapid has no feed; what a block names is not what it moves.
            let feed = |m: &Move| (m.kind != MoveKind::Rapid).then_some(m.feed);
            all.into_iter().map(|m| (m.kind, m.target, feed(&m))).collect()
        };
        let (was, is) = (plain(moves(&program)), plain(moves(&unrolled)));
        assert!(was.len() > 4, "{name} {}", was.len());
        assert_eq!(was, is, "{name}:\n{new}");
        assert!(name != "old.h" || new.contains("F50"), "{new}");
        for word in ["#", "=R", "Q3", "Q9", "M99", "G81", "G83"] {
            let found = new.lines().filter(|l| !l.contains(MARK)).find(|l| l.contains(word));
            assert_eq!(found, None, "{name}:\n{new}");
        }
        let options = ProgramOptions { increments: None, ..ProgramOptions::default() };
        let setup = SetUp { files: disk(), ..SetUp::default() };
        let (done, problems) = compensate_program(&lost, &program, &setup, &options);
        let Some(done) = done else { panic!("{name}: {problems:?}") };
        let (before, after) = (done.proof.before, done.proof.after);
        assert!(before.tip_end.value > 1e-3, "{name} {before:?}");
        assert!(after.tip_end.value <= 1e-9, "{name} {after:?}");
    }
}

/// Optional blocks that lead the tool, call or jump, and what is written then goes elsewhere without them.
const OPTIONAL: [(Control, &str); 9] = [
    (
        Control::Fanuc,
        "G21 G90 G94 F500.\nG0 X100. Y100. Z-10.\nG1 Z-50.\nX190. /Y140.\nX180. Y120.\nG0 Z-10.\nM30\n",
    ),
    (
        Control::Fanuc,
        "G21 G90 G94 F500.\nG0 X100. Y100. Z-10.\nG1 Z-50.\n/ G1 X190.\nG1 Y120.\nG0 Z-10.\nM30\n",
    ),
    (
        Control::LinuxCnc,
        "G21 G90 G94 F500\nG0 X100 Y100 Z-10\nG1 Z-50\n/ X190\nY120\nG0 Z-10\nM2\n",
    ),
    (
        Control::Sinumerik840d,
        "G710 G90 G94 F500\nG0 X100 Y100 Z-10\nG1 Z-50\nR1=120\n/R1=130\nX140 Y=R1\nREPEATB A P=1\nA: X150\nM30\n",
    ),
    (
        Control::Heidenhain,
        "0 BEGIN PGM A MM\n1 L X+100 Y+100 Z-10 R0 FMAX\n2 L Z-50 F500\n/3 CALL LBL 1\n4 CALL LBL 1\n5 M30\n6 LBL 1\n7 L IX+5\n8 LBL 0\n9 END PGM A MM\n",
    ),
    (
        Control::Fanuc,
        "G21 G90 G94 F500.\nG0 X100. Y100. Z-10.\nG98 G81 X110. Y120. Z-60. R-48.\n/ X150.\nG91 X10.\nG90 G80\nM30\n",
    ),
    (
        Control::Fanuc,
        "G21 G90 G94 F500.\nG0 X100. Y100. Z-50.\n/M98 P2 L2\nG1 X150. Y150.\nM30\nO2\nG91 G1 X3. Y1.\nG90 M99\n",
    ),
    (
        Control::Fanuc,
        "G21 G90 G94 F500.\nG0 X100. Y100. Z-50.\n/GOTO 100\nG1 X150. Y150. M8\nN100 G1 X105. Y105.\nM98 P2 L2\nM30\nO2\nG91 G1 X3. Y1.\nG90 M99\n",
    ),
    (
        Control::Haas,
        "G21 G90 G94 F500.\nG0 X100. Y100. Z-50.\nN5 G1 X150.\n/N6 X190.\nN7 Y150.\nX120.\nM30\n",
    ),
];

#[test]
fn law_what_fits_only_with_optional_blocks_is_not_proved() {
    let lost = with_lost_motion(&machine("three-axis-mill"), 2e-3);
    let options = ProgramOptions { increments: None, ..ProgramOptions::default() };
    let setup = SetUp { files: disk(), ..SetUp::default() };
    let codes = |control: Control, text: &str| -> Option<Vec<&'static str>> {
        let program = Program::new("p", text.as_bytes().to_vec(), control);
        let (done, problems) = compensate_program(&lost, &program, &setup, &options);
        assert!(done.is_some() || problems.has_errors(), "{text}");
        Some(done?.unproved.iter().map(|d| d.code).collect())
    };
    for (control, text) in OPTIONAL {
        let found = codes(control, text);
        // Refused, or not proved for this reason.
        assert!(found.is_none_or(|found| found == ["optional-blocks"]), "{text}");
        // Without the marks it is proved, or refused as before.
        let plain = text.replace("\n/ ", "\n").replace("\n/", "\n").replace(" /", " ");
        assert!(codes(control, &plain).is_none_or(|found| found.is_empty()), "{plain}");
    }
    // What leads nowhere else does no harm: a function, a whole pass, the end.
    for (control, text) in [
        (
            Control::Fanuc,
            "G21 G90 G94 F500.\nG0 X100. Y100. Z-50.\n/ M8\nG1 X150. Y150.\n/ M30\nM30\n",
        ),
        (
            Control::Fanuc,
            "G21 G90 G94 F500.\nG0 X100. Y100. Z-50.\nG1 X150. Y150. Z-51.\n/ G1 X160. Y155. Z-52.\nG1 X170. Y160. Z-53.\nM30\n",
        ),
        (
            Control::Heidenhain,
            "0 BEGIN PGM A MM\n1 L X+100 Y+100 Z-50 R0 FMAX\n2 L X+150 Y+150 F500\n/3 M30\n4 LBL 1\n5 LBL 0\n6 END PGM A MM\n",
        ),
    ] {
        assert_eq!(codes(control, text), Some(Vec::new()), "{text}");
    }
}

/// What a call of a cycle says besides: functions in their order, comments, the feed of what follows.
#[test]
fn law_functions_and_comments_of_cycles_stay() {
    let machine = bare("three-axis-mill");
    let klartext = |body: &str| {
        format!(
            "0 BEGIN PGM A MM\n1 L X+100 Y+100 Z-10 R0 FMAX\n2 L Z-30 F500\n3 CYCL DEF 200 Q200=2 Q201=-9 Q206=150 Q202=5 Q210=0 Q203=-40 Q204=20 Q211=0\n{body}\n9 M30\n10 END PGM A MM\n"
        )
    };
    for (control, name, text, wanted) in [
        (Control::Heidenhain, "m.h", klartext("4 L X+110 FMAX\n5 CYCL CALL M8 ; first\n6 CYCL DEF 9.0 DWELL\n7 CYCL DEF 9.1 DWELL 1\n8 L X+120"), &["M8", "; first", "F500"][..]),
        (Control::Heidenhain, "n.h", klartext("4 L X+110 FMAX\n5 CYCL CALL M9\n6 L X+120"), &["M9"]),
        (Control::Sinumerik840d, "m.mpf", "G710 G90 F500\nG0 X100 Y100 Z-30\nCYCLE82(-30,-40,2,-50,,0.5) ; reamed\nG0 Z-30\nM30\n".to_owned(), &["; reamed"]),
        (Control::Fanuc, "inch.nc", "G20 G90 G94 F20.\nG0 X4. Y4. Z-1.\nG98 G83 X4.1 Y4.1 Z-2.05 R-1.3 Q.1 F10.\nG80\nM30\n".to_owned(), &["X4.1"]),
    ] {
        let program = program(control, name, &text);
        let events = |program: &Program| {
            let mut functions = Vec::new();
            let outcome = interpret(program, &Beside, &Settings::default(), &mut |step| match step {
                Step::Move(m) => functions.push(format!("{:?} {:.6?}", m.kind, m.target.0)),
                Step::Event(Event::Coolant(coolant), _) => functions.push(format!("{coolant:?}")),
                Step::Event(..) => {}
            });
            assert!(outcome.finished, "{:?}", outcome.problems);
            functions
        };
        let (done, problems) = flat(&machine, &program);
        let Some(done) = done else { panic!("{name}: {problems:?}") };
        let new = String::from_utf8(done.text.into_vec()).unwrap();
        let unrolled = Program::new(name, new.clone().into_bytes(), control);
        assert_eq!(events(&program), events(&unrolled), "{name}:\n{new}");
        assert!(wanted.iter().all(|word| new.contains(word)), "{name}:\n{new}");
        assert!(!new.contains("CYCL CALL") && !new.contains("G83 "), "{name}:\n{new}");
    }
}
