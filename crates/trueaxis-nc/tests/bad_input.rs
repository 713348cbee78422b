//! What is wrong with a program, and where: one code with line and column each.

#![allow(clippy::print_stdout, reason = "says how long the longest lines take")]

use trueaxis_nc::{Control, Library, NoLibrary, Program, Settings, interpret};

/// Code and place of every problem.
fn problems(text: &[u8], control: Control, library: &dyn Library) -> Vec<(&'static str, String)> {
    let program = Program::new("p", text.to_vec(), control);
    let settings = Settings { most_jumps: 1000, ..Settings::default() };
    let outcome = interpret(&program, library, &settings, &mut |_| {});
    outcome.problems.iter().map(|d| (d.code, d.place.to_string())).collect()
}

#[track_caller]
fn first(text: &str, code: &str, place: &str) {
    let found = problems(text.as_bytes(), Control::LinuxCnc, &NoLibrary);
    assert_eq!(found.first().map(|(c, p)| (*c, p.as_str())), Some((code, place)), "{text}");
}

#[track_caller]
fn fanuc(text: &str, code: &str, place: &str) {
    let found = problems(text.as_bytes(), Control::Fanuc, &NoLibrary);
    assert_eq!(found.first().map(|(c, p)| (*c, p.as_str())), Some((code, place)), "{text}");
}

#[test]
fn faults_of_the_text() {
    first("G0 X[1+2\n", "unbalanced-brackets", "p:1:5");
    first("G0 X1]\n", "unbalanced-brackets", "p:1:6");
    first("G0 X1 µ\n", "unexpected-sign", "p:1:7");
    first("G0 (open\n", "unclosed-comment", "p:1:4");
    first("G0 X\n", "missing-value", "p:1:5");
    first("#1 5\n", "missing-equals", "p:1:4");
    first("o1 foo\n", "unknown-o-word", "p:1:4");
    first("\x00\x01\x02\x7fELF", "unexpected-sign", "p:1:1");
    first(&format!("#1={}1\n", "[".repeat(60)), "too-deep", "p:1:54");
}

#[test]
fn faults_of_the_numbers() {
    first("G21\n#1=[1/0]\n", "division-by-zero", "p:2:6");
    first("#1=[5 MOD 0]\n", "division-by-zero", "p:1:7");
    first("#1=SQRT[-1]\n", "out-of-domain", "p:1:4");
    first("#1=EXP[1000]\n", "not-finite", "p:1:4");
    first("G0 X#<gone>\n", "undefined-parameter", "p:1:1");
    first("G0 X[10**300]\n", "too-large", "p:1:4");
    first("G0\nG0 X1\nX2 Y[1/0]\n", "division-by-zero", "p:3:7");
    first("#9999=1\n", "parameter-out-of-range", "p:1:1");
    first("#<_x>=1\n", "read-only-parameter", "p:1:1");
}

#[test]
fn faults_of_the_moves() {
    first("G1 X1\n", "zero-feed", "p:1:1");
    first("F0\nG1 X1\n", "zero-feed", "p:2:1");
    first("F-1\n", "negative-feed", "p:1:1");
    first("G93 G1 X1\n", "zero-feed", "p:1:5");
    first("F9 G2 X1 I5\n", "arc-does-not-fit", "p:1:4");
    first("F9 G2 X10 R1\n", "arc-does-not-fit", "p:1:4");
    first("F9 G2 R1\n", "arc-does-not-fit", "p:1:4");
    first("F9 G2 X1\n", "arc-without-centre", "p:1:4");
    first("X1\n", "no-motion-code", "p:1:1");
    first("G0 G1 X1\n", "conflicting-codes", "p:1:4");
    first("G0 X1 X2\n", "repeated-word", "p:1:7");
    first("F9 G81 X1\n", "cycle-without-r", "p:1:4");
    first("F9 G83 Z-9 R0 Q1e-9\n", "unknown-word", "p:1:17");
    first("F9 G83 Z-9 R0 Q.0000001\n", "too-many-pecks", "p:1:4");
    first("F9 G83 Z-9 R0 Q0\n", "cycle-without-q", "p:1:4");
    first("G4\n", "bad-dwell", "p:1:1");
}

#[test]
fn faults_of_the_flow() {
    first("o1 while [1]\no1 endwhile\n", "endless-loop", "p:2:1");
    first("o1 sub\no1 call\no1 endsub\no1 call\n", "calls-too-deep", "p:2:1");
    first("o<gone> call\n", "missing-subprogram", "p:1:1");
    first("o1 if [0]\n", "missing-endif", "p:1:1");
    first("o1 sub\nG0 X1\n", "missing-endsub", "p:1:1");
    first("o1 endwhile\n", "unopened-control", "p:1:1");
    first("%\nG0 X1\n", "truncated-program", "p:3:1");
    fanuc("N1 GOTO 1\n", "endless-loop", "p:1:4");
    fanuc("G43.5 H0\nG1 X1 I0 J0 K0 F1\n", "zero-direction", "p:2:1");
    fanuc("GOTO 7\n", "missing-label", "p:1:1");
    fanuc("M98 P7\n", "missing-subprogram", "p:1:5");
}

#[test]
fn unknown_words_are_never_dropped() {
    first("G4 P1 E5\n", "unknown-word", "p:1:7");
    first("G77.7 X1\n", "unknown-g-code", "p:1:1");
    first("M777\n", "unknown-m-code", "p:1:1");
    first("G0 X1 H3\n", "unused-word", "p:1:7");
    first("G41 D1\n", "unknown-tool-radius", "p:1:1");
    first("G70 P1 Z-1\n", "bad-turning", "p:1:1");
}

#[test]
fn one_very_long_line_is_read_in_one_go() {
    // 8 MB in one line: one problem, nothing is squared, and the memory stays small.
    let text = "X1 ".repeat(3_000_000);
    let start = std::time::Instant::now();
    let found = problems(text.as_bytes(), Control::LinuxCnc, &NoLibrary);
    assert_eq!(found, [("too-many-words", "p:1:30001".to_owned())]);
    let found = problems("G1".repeat(4_000_000).as_bytes(), Control::LinuxCnc, &NoLibrary);
    assert_eq!(found, [("too-many-words", "p:1:20001".to_owned())]);
    let found = problems("#".repeat(8_000_000).as_bytes(), Control::LinuxCnc, &NoLibrary);
    assert_eq!(found[0].0, "too-deep");
    assert!(start.elapsed().as_secs() < 20);
}

/// 200 MB on one line, of several kinds: an error with line and column each, in bounded time.
#[test]
#[ignore = "seconds and 400 MB of memory: cargo test --release -- --ignored"]
fn two_hundred_megabytes_on_one_line() {
    const SIZE: usize = 200_000_000;
    let repeated = |piece: &str| piece.repeat(SIZE / piece.len()).into_bytes();
    let after_x = |piece: &str| [b"X".to_vec(), repeated(piece)].concat();
    let noise = || (0..SIZE).map(|i| ((i * i) >> 3) as u8 | 0x80).collect();
    type Kind<'t> = (&'t str, &'t dyn Fn() -> Vec<u8>, &'t str, &'t str);
    let kinds: [Kind<'_>; 7] = [
        ("words", &|| repeated("X1 "), "too-many-words", "p:1:30001"),
        ("codes", &|| repeated("G1"), "too-many-words", "p:1:20001"),
        ("digits", &|| after_x("1"), "bad-number", "p:1:2"),
        ("brackets", &|| after_x("["), "too-deep", "p:1:52"),
        ("comment", &|| repeated("(a"), "unclosed-comment", "p:1:1"),
        ("zeros", &|| vec![0; SIZE], "unexpected-sign", "p:1:1"),
        ("noise", &noise, "unexpected-sign", "p:1:1"),
    ];
    for (name, text, code, place) in kinds {
        for control in [Control::LinuxCnc, Control::Fanuc] {
            let program = Program::new("p", text(), control);
            let start = std::time::Instant::now();
            let outcome = interpret(&program, &NoLibrary, &Settings::default(), &mut |_| {});
            let seconds = start.elapsed().as_secs_f64();
            let found = outcome.problems.iter().next().map(|d| (d.code, d.place.to_string()));
            println!("{name} {control:?}: {seconds:.2} s, {found:?}");
            assert_eq!(found, Some((code, place.to_owned())), "{name}");
            assert!(seconds < 30.0);
        }
    }
}

#[test]
fn feed_before_units_is_said() {
    first("G20 F10\n", "feed-before-units", "p:1:1");
    let found = problems(b"G20 F10\n", Control::Fanuc, &NoLibrary);
    assert!(found.is_empty(), "{found:?}");
}
