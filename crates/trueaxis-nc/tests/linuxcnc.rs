//! LinuxCNC programs, each worked out by hand.

use std::collections::BTreeMap;

use trueaxis_nc::moves::{Axis, Frame};
use trueaxis_nc::{Control, Library, NoLibrary, Program, Settings, Step, interpret};

struct Subs(&'static [(&'static str, &'static str)]);

impl Library for Subs {
    fn text(&self, name: &str) -> Result<Vec<u8>, String> {
        let found = self.0.iter().find(|(n, _)| *n == name);
        found.map(|(_, t)| t.as_bytes().to_vec()).ok_or_else(|| "not in this test".to_owned())
    }
}

/// Where X goes, move by move.
#[track_caller]
fn path(text: &str, library: &dyn Library) -> Vec<f64> {
    let program = Program::new("p", text.as_bytes().to_vec(), Control::LinuxCnc);
    let mut x_mm = Vec::new();
    let outcome = interpret(&program, library, &Settings::default(), &mut |step| {
        if let Step::Move(m) = step {
            x_mm.push(m.target[Axis::X]);
        }
    });
    let problems: Vec<_> = outcome.problems.iter().map(ToString::to_string).collect();
    assert!(!outcome.problems.has_errors(), "{problems:?}");
    x_mm
}

#[test]
fn expressions_bind_as_in_the_manual() {
    let of = |expression: &str| path(&format!("G0 X{expression}\nM2\n"), &NoLibrary)[0];
    assert_eq!(of("[1+2*3]"), 7.0);
    assert_eq!(of("[2**3*2]"), 16.0);
    assert_eq!(of("[10-4-3]"), 3.0);
    assert_eq!(of("[-2**2]"), 4.0);
    assert_eq!(of("[-7 MOD 3]"), 2.0);
    assert_eq!(of("[1 GT 0 AND 2 LT 1]"), 0.0);
    assert_eq!(of("[1 OR 0 XOR 1]"), 0.0);
    assert_eq!(of("-[1+1]"), -2.0);
    assert_eq!(of("ATAN[1]/[1]"), 45.0);
    assert_eq!(of("FIX[-2.5]"), -3.0);
    assert_eq!(of("FUP[-2.5]"), -2.0);
    assert_eq!(of("ROUND[-2.5]"), -3.0);
    assert_eq!(of("SQRT[9]"), 3.0);
    assert_eq!(of("LN[EXP[2]]"), 2.0);
    assert_eq!(of("ABS[-1.5]"), 1.5);
}

#[test]
fn parameters_get_their_values_after_the_block_is_read() {
    assert_eq!(path("#1=1\nG0 X#1 #1=5\nX#1\nM2\n", &NoLibrary), [1.0, 5.0]);
}

#[test]
fn branches() {
    let text = "#1=0\no1 while [#1 lt 4]\n#1=[#1+1]\no2 if [#1 eq 1]\nG0 X10\n\
                o2 elseif [#1 eq 2]\nX20\no2 elseif [#1 eq 3]\nX30\no2 else\nX40\no2 endif\n\
                o1 endwhile\nM2\n";
    assert_eq!(path(text, &NoLibrary), [10.0, 20.0, 30.0, 40.0]);
}

#[test]
fn loops_break_and_continue() {
    let text = "#1=0\no1 while [1]\n#1=[#1+1]\no2 if [#1 eq 2]\no1 continue\no2 endif\n\
                o3 if [#1 eq 4]\no1 break\no3 endif\nG0 X#1\no1 endwhile\n\
                o4 do\n#1=[#1+1]\nX#1\no4 while [#1 lt 6]\no5 repeat [2]\nG91 X1\no5 endrepeat\nM2\n";
    assert_eq!(path(text, &NoLibrary), [1.0, 3.0, 5.0, 6.0, 7.0, 8.0]);
}

#[test]
fn subs_have_their_own_parameters_and_return_a_value() {
    let text = "o<twice> sub\n#<a>=[#1*2]\no<twice> endsub [#<a>]\n#1=7\no<twice> call [4]\n\
                G0 X#<_value>\nX#1\nM2\n";
    assert_eq!(path(text, &NoLibrary), [8.0, 7.0]);
}

#[test]
fn subs_come_from_the_library() {
    let library = Subs(&[("half", "o<half> sub\nG0 X[#1/2]\no<half> endsub\nM2\n")]);
    assert_eq!(path("o<half> call [3]\nG0 X9\nM2\n", &library), [1.5, 9.0]);
}

#[test]
fn a_factorial_calls_itself() {
    let text = "o<f> sub\no1 if [#1 le 1]\no<f> return [1]\no1 endif\no<f> call [#1-1]\n\
                o<f> endsub [#1*#<_value>]\no<f> call [5]\nG0 X#<_value>\nM2\n";
    assert_eq!(path(text, &NoLibrary), [120.0]);
}

#[test]
fn inches_and_increments() {
    assert_eq!(path("G20 G91 G0 X1\nX1\nG21 X1\nM2\n", &NoLibrary), [25.4, 50.8, 51.8]);
}

#[test]
fn skipped_blocks_can_be_left_out() {
    let program = Program::new("p", b"G0 X1\n/X2\nX3\nM2\n".to_vec(), Control::LinuxCnc);
    let settings = Settings { skipped_blocks_too: false, ..Settings::default() };
    let mut moves = 0;
    interpret(&program, &NoLibrary, &settings, &mut |s| {
        moves += u32::from(matches!(s, Step::Move(_)));
    });
    assert_eq!(moves, 2);
}

#[test]
fn a_work_offset_turned_in_space_is_reported() {
    let turned =
        Frame { linear: [[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]], ..Frame::IDENTITY };
    let settings = Settings {
        work_offsets: BTreeMap::from([(1, turned), (2, turned)]),
        ..Settings::default()
    };
    let program = Program::new("p", b"G0 X1\nG55\nM2\n".to_vec(), Control::LinuxCnc);
    let outcome = interpret(&program, &NoLibrary, &settings, &mut |_| {});
    let found: Vec<_> =
        outcome.problems.iter().map(|d| (d.code, d.place.line, d.place.column)).collect();
    assert_eq!(found, [("work-offset-not-about-z", 1, 1), ("work-offset-not-about-z", 2, 1)]);
}

/// LinuxCNC 2.9 user manual, chapter "O Codes", full example of numbered subprograms: `#1` "will equal
/// 5.25".
#[test]
fn numbered_subprograms_share_the_parameters_of_their_caller() {
    let text = "O1 (main)\n#1 = 0\nM98 P100 L5\nG0 X#1\nM98 P100 L0\nG0 X#1\nM30\n\
                O100\n#1 = [#1 + 1]\nM98 P200 L5\nM99\nO200\n#1 = [#1 + 0.01]\nM99\n";
    let x_mm = path(text, &NoLibrary);
    assert!(x_mm.iter().all(|x| (x - 5.25).abs() < 1e-12), "{x_mm:?}");
    assert_eq!(x_mm.len(), 2);
    assert_eq!(
        path("M98 P7\nM98 P12000 L2\nM2\no7\nG0 X1\nM99\no12000\nG91 X1\nM99\n", &NoLibrary),
        [1.0, 2.0, 3.0]
    );
}

#[test]
fn a_structure_without_its_end_is_an_error() {
    for text in
        ["o1 while [1]\nG0 X1\nM2\n", "o1 if [1]\nG0 X1\nM2\n", "o1 repeat [2]\nG0 X1\nM2\n"]
    {
        let program = Program::new("p", text.as_bytes().to_vec(), Control::LinuxCnc);
        let outcome = interpret(&program, &NoLibrary, &Settings::default(), &mut |_| ());
        let problem = outcome.problems.iter().next().unwrap();
        assert!(problem.code.starts_with("missing-end") && problem.place.line == 1, "{problem}");
    }
}
