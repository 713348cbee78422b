//! SINUMERIK programs against what they do by hand calculation, and real ones of others.

#![allow(clippy::print_stdout, reason = "says what was read and what is not here")]

mod support;

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use support::outside;
use trueaxis_nc::moves::{
    Axis, Coordinates, Frame, OrientationPath, PathControl, Position, RotaryDirection,
    SpindleDirection,
};
use trueaxis_nc::sinumerik::read_archive;
use trueaxis_nc::{
    Control, Event, Library, Move, MoveKind, NoLibrary, Program, Settings, Step, interpret,
};

/// A number with up to four decimals.
fn short(value: f64) -> String {
    let text = format!("{value:.4}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".into() } else { text.into() }
}

fn list(values: &[f64]) -> String {
    values.iter().map(|v| short(*v)).collect::<Vec<_>>().join(" ")
}

fn place(position: &Position) -> String {
    let mut text = String::new();
    for axis in Axis::ALL {
        if position[axis].abs() > 5e-5 {
            write!(text, " {axis}{}", short(position[axis])).unwrap();
        }
    }
    if text.is_empty() { " zero".into() } else { text }
}

fn frame_text(frame: &Frame) -> String {
    let rows: Vec<_> = frame.linear.iter().map(|row| list(row)).collect();
    let turned = frame.linear != Frame::IDENTITY.linear;
    let turn = if turned { format!(" [{}]", rows.join(" | ")) } else { String::new() };
    format!("frame{}{turn}", place(&frame.shift))
}

fn move_text(m: &Move) -> String {
    let mut text = match m.kind {
        MoveKind::Rapid => "rapid".to_owned(),
        MoveKind::Linear => "line".to_owned(),
        MoveKind::Arc(arc) => {
            let way = if arc.ccw { "ccw" } else { "cw" };
            format!("arc {:?} {way} c({}) x{}", arc.plane, list(&arc.center_mm), arc.turns)
        }
        MoveKind::SpatialArc(arc) => {
            format!("spatial c({}) n({}) x{}", list(&arc.center_mm), list(&arc.normal), arc.turns)
        }
        MoveKind::Align { keep_tip, branch } => format!("align {branch:?} tip={keep_tip}"),
        MoveKind::Thread { pitch_mm } => format!("thread {}", short(pitch_mm)),
        MoveKind::RigidTap { pitch_mm } => format!("tap {}", short(pitch_mm)),
        MoveKind::Probe => "probe".to_owned(),
        MoveKind::Dwell { seconds } => format!("dwell {}", short(seconds)),
    };
    for axis in Axis::ALL {
        if m.named.contains(axis) {
            write!(text, " {axis}{}", short(m.target[axis])).unwrap();
        }
    }
    for (axis, way) in [Axis::A, Axis::B, Axis::C].into_iter().zip(m.rotary_directions) {
        if way != RotaryDirection::AsWritten {
            write!(text, " {axis}:{way:?}").unwrap();
        }
    }
    if let Some(direction) = m.direction {
        write!(text, " d({})", list(&direction)).unwrap();
    }
    if m.coordinates == Coordinates::Machine {
        text.push_str(" machine");
    }
    let fast = matches!(m.kind, MoveKind::Rapid | MoveKind::Align { .. } | MoveKind::Dwell { .. });
    if !fast {
        write!(text, " F{}", short(m.feed.value)).unwrap();
    }
    text
}

fn event_text(event: &Event) -> String {
    match event {
        Event::Frame(frame) => frame_text(frame),
        Event::WorkOffset { index, offset, rotation_deg } => {
            format!("offset {index}{} r{}", place(offset), short(*rotation_deg))
        }
        Event::ToolLength(length) => format!("length{}", place(length)),
        Event::Path { control, tolerance_mm } => {
            let name = match control {
                PathControl::ExactStop => "stop",
                PathControl::ExactPath => "path",
                PathControl::Continuous => "round",
            };
            format!("{name} {}", short(*tolerance_mm))
        }
        Event::Orientation(OrientationPath::Cone(cone)) => {
            let vector = |v: Option<[f64; 3]>| v.map_or("-".into(), |v| list(&v));
            format!(
                "cone axis({}) through({}) opening {} angle {} ccw {:?} tangential {}",
                vector(cone.axis),
                vector(cone.through),
                cone.half_opening_deg.map_or("-".into(), short),
                cone.angle_deg.map_or("-".into(), short),
                cone.ccw,
                cone.tangential
            )
        }
        Event::Spindle(SpindleDirection::Stopped) => "spindle off".into(),
        Event::Spindle(turning) => format!("spindle {turning:?}"),
        Event::SpindleSpeed(speed) => format!("speed {}", short(*speed)),
        other => format!("{other:?}"),
    }
}

/// Programs of the same folder.
struct Folder(PathBuf);

impl Library for Folder {
    fn text(&self, name: &str) -> Result<Vec<u8>, String> {
        std::fs::read(self.0.join(name)).map_err(|e| e.to_string())
    }
}

fn settings() -> Settings {
    let mut x10 = Position::default();
    (x10[Axis::X], x10[Axis::Z]) = (10.0, 5.0);
    let mut length = Position::default();
    length[Axis::Z] = 100.0;
    Settings {
        most_jumps: 1000,
        work_offsets: BTreeMap::from([(1, Frame::shifted(x10))]),
        tools: BTreeMap::from([(7, length)]),
        tool_names: BTreeMap::from([("FACEMILL 63".to_owned(), 7)]),
        ..Settings::default()
    }
}

/// What a program does, line by line, then what is wrong with it.
fn reported(text: &[u8], library: &dyn Library, settings: &Settings) -> String {
    let program = Program::new("p", text.to_vec(), Control::Sinumerik840d);
    assert!(program.print() == program.source());
    let mut out = String::new();
    let outcome = interpret(&program, library, settings, &mut |step| {
        let (origin, line) = match &step {
            Step::Move(m) => (m.origin, move_text(m)),
            Step::Event(event, origin) => (*origin, event_text(event)),
        };
        let from = if origin.program == 0 { String::new() } else { format!("{}.", origin.program) };
        writeln!(out, "{from}{} {line}", origin.line).unwrap();
    });
    for problem in outcome.problems.iter() {
        let place = problem.place.to_string();
        writeln!(out, "{:?} {} {place}", problem.severity, problem.code).unwrap();
    }
    out
}

fn check_folder(kind: &str) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/programs").join(kind);
    let mut files: Vec<_> =
        std::fs::read_dir(&folder).unwrap().flatten().map(|e| e.path()).collect();
    files.retain(|f| f.extension().is_some_and(|x| x == "mpf"));
    files.sort();
    assert!(!files.is_empty());
    let mut wrong = Vec::new();
    for file in files {
        let settings = Settings { keep_going: kind == "bad", ..settings() };
        let ours = reported(&std::fs::read(&file).unwrap(), &Folder(folder.clone()), &settings);
        let expected =
            std::fs::read_to_string(file.with_extension("mpf.expected")).unwrap_or_default();
        // A # begins the hand calculation of its line.
        let plain = |l: &str| l.split('#').next().unwrap_or("").trim().to_owned();
        let theirs: Vec<_> = expected.lines().map(plain).filter(|l| !l.is_empty()).collect();
        let mut ours: Vec<_> = ours.lines().map(str::to_owned).collect();
        if kind == "bad" {
            ours.retain(|l| l.starts_with("Error") || l.starts_with("Warning"));
        }
        if ours != theirs {
            let first = ours.iter().zip(&theirs).take_while(|(a, b)| a == b).count();
            wrong.push(format!(
                "{}: entry {first}\n  ours   {:?}\n  theirs {:?}\nall of ours:\n{}",
                file.display(),
                ours.get(first),
                theirs.get(first),
                ours.join("\n")
            ));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n\n"));
}

#[test]
fn blocks_show_their_plain_words() {
    use trueaxis_nc::program::{Item, Node};
    let text = b"N20 G1 X-1.5 Y=R1*2 TRANS Z.5 A3=1 ; done\n".to_vec();
    let program = Program::new("p", text, Control::Sinumerik840d);
    let block = program.blocks().next().unwrap();
    let words = block.items.iter().filter_map(|item| match item {
        Item::Word { letter, value, .. } => match block.nodes[*value as usize] {
            Node::Number(number) => Some((char::from(*letter), number)),
            _ => None,
        },
        _ => None,
    });
    let wanted = [('N', 20.0), ('G', 1.0), ('X', -1.5), ('R', 1.0), ('Z', 0.5)];
    assert_eq!(words.collect::<Vec<_>>(), wanted);
}

#[test]
fn good_programs_do_what_they_say() {
    check_folder("good");
}

#[test]
fn bad_programs_are_told_with_their_place() {
    check_folder("bad");
}

#[test]
fn long_texts_and_lines_are_bounded() {
    let start = std::time::Instant::now();
    let grow = "DEF STRING[1000000] TEXT=\"x\"\nLOOP\nTEXT=TEXT<<TEXT\nENDLOOP\n";
    assert!(reported(grow.as_bytes(), &NoLibrary, &settings()).contains("Error too-long p:3:"));
    let line = "X1 ".repeat(3_000_000);
    let found = reported(line.as_bytes(), &NoLibrary, &settings());
    assert!(found.contains("Error too-many-words p:1:"), "{found}");
    let deep = format!("R1={}1\n", "(".repeat(1_000_000));
    assert!(reported(deep.as_bytes(), &NoLibrary, &settings()).contains("Error too-many-words"));
    let nested = format!("R1={}1\n", "(".repeat(5000));
    assert!(reported(nested.as_bytes(), &NoLibrary, &settings()).contains("Error too-deep p:1:64"));
    let array = "DEF REAL AA[9999,9999]\n";
    assert!(
        reported(array.as_bytes(), &NoLibrary, &settings()).contains("Error too-many-variables")
    );
    assert!(start.elapsed().as_secs() < 20);
}

/// Diagnostics in programs of others that are due, and why.
const DUE: [(&str, &str); 6] = [
    ("pocket-size", "_DMODE of POCKET4 is not checked"),
    ("unknown-m-code", "M27, M29, M50, M51 and M65 are of the machine builder"),
    ("unknown-tool", "the test has no tool table"),
    ("unknown-tool-length", "the test has no tool table"),
    ("not-executed", "CYCLE61 and POCKET4"),
    ("not-applied", "retraction of CYCLE800"),
];

#[test]
fn oracle_sinumerik_programs_of_others_are_read() {
    let Some(folder) = outside("nc") else { return };
    let sets = [
        "121philip__SINUMERIK-840D-sl-CAS-Package",
        "ElMoe__Production-Data-Set-for-Five-Axis-CNC-Milling-with-Multiple-Changeovers",
        "d-creations__ncplot7py",
    ];
    let (mut wrong, mut count) = (Vec::new(), 0);
    for set in sets {
        let files = std::fs::read_dir(folder.join(set)).unwrap().flatten().map(|e| e.path());
        for file in files.filter(|f| f.extension().is_none_or(|x| x != "INI")) {
            let name = file.file_name().unwrap().to_string_lossy().into_owned();
            let source = std::fs::read(&file).unwrap();
            let program = Program::new(&name, source, Control::Sinumerik840d);
            let settings = Settings { keep_going: true, ..Settings::default() };
            let (mut moves, mut aligned) = (0, 0);
            let outcome = interpret(&program, &NoLibrary, &settings, &mut |step| {
                if let Step::Move(m) = step {
                    assert!(m.target.0.iter().all(|v| v.is_finite()));
                    moves += 1;
                    aligned += usize::from(matches!(m.kind, MoveKind::Align { .. }));
                }
            });
            println!("{name}: {moves} moves, {aligned} of them swivel");
            for problem in outcome.problems.iter() {
                println!("  {} {}: {}", problem.code, problem.place, problem.message);
                if !DUE.iter().any(|(code, _)| *code == problem.code) {
                    wrong.push(problem.to_string());
                }
            }
            assert!(moves > 10, "{name}");
            count += 1;
        }
    }
    assert_eq!(count, 4);
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// Lines of an editor's syntax tests that are wrong on purpose, or need what is not here.
const WRONG_ON_PURPOSE: [&str; 12] = [
    "zero-feed",
    "negative-feed",
    "undefined-parameter",
    "missing-label",
    "missing-subprogram",
    "missing-value",
    "unknown-axis",
    "unknown-g-code",
    "unknown-system-variable",
    "unexpected-sign",
    "function-not-known",
    "missing-end",
];

/// Words in them that are wrong on purpose or axes of a machine.
const FOREIGN: [&str; 4] = ["G0=10", "G0 = 10", "AX1", "_VAR"];

#[test]
fn oracle_syntax_tests_of_an_editor_have_no_unknown_word() {
    let Some(folder) = outside("suites/deathaxe__sublime-s840d") else { return };
    let mut wrong = Vec::new();
    for file in std::fs::read_dir(folder).unwrap().flatten().map(|e| e.path()) {
        let source = std::fs::read(&file).unwrap();
        for line in String::from_utf8_lossy(&source).lines() {
            let found = reported(line.as_bytes(), &NoLibrary, &settings());
            for entry in found.lines().filter(|l| l.starts_with("Error")) {
                let code = entry.split(' ').nth(1).unwrap();
                let foreign = FOREIGN.iter().any(|w| line.contains(w));
                if !foreign && !WRONG_ON_PURPOSE.contains(&code) {
                    wrong.push(format!("{code}: {line}"));
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn oracle_a_dump_of_a_control_is_read() {
    let Some(file) = outside("nc/121philip__SINUMERIK-840D-sl-CAS-Package/KUL_DEMO.INI") else {
        return;
    };
    let (archive, problems) = read_archive("KUL_DEMO.INI", &std::fs::read(file).unwrap());
    let all: Vec<_> = problems.iter().map(ToString::to_string).collect();
    assert!(all.is_empty(), "{}", all.join("\n"));
    assert_eq!(archive.tools.len(), 15);
    assert_eq!(archive.tools[&1].name, "CUTTER 4");
    assert_eq!(archive.tools[&1].length_mm[Axis::Z], 65.0);
    assert_eq!(archive.tools[&1].radius_mm, 2.0);
    assert_eq!(archive.tools[&15].kind, 240);
    assert_eq!(archive.work_offsets.len(), 19);
    assert_eq!(archive.work_offsets[&19], Frame::IDENTITY);
}

#[test]
fn dumps_with_turns_are_read() {
    let text =
        b"$P_UIFR[2]=CTRANS(X,1,Y,2,C,30):CFINE(X,0.5,SP1,0):CROT(Z,90):CSCALE(X,1):CMIRROR()\n\
                 $TC_TP2[4]=\"T4\"\n$TC_DP4[4,1]=3\n$TC_DP3[4,2]=9\nM30\n";
    let (archive, problems) = read_archive("d.ini", text);
    assert!(!problems.has_errors());
    let frame = archive.work_offsets[&2];
    // 1 + 0.5 along X; X of the frame points along Y.
    assert_eq!(frame.shift.0[..2], [1.5, 2.0]);
    assert_eq!(frame.shift[Axis::C], 30.0);
    assert_eq!(frame.vector([1.0, 0.0, 0.0]), [0.0, 1.0, 0.0]);
    let tool = &archive.tools[&4];
    assert_eq!((tool.length_mm[Axis::Y], tool.length_mm[Axis::Z]), (3.0, 0.0));
    let (_, problems) = read_archive("d.ini", b"$P_UIFR[1]=CTRANS(X,1/0)\n");
    assert!(problems.has_errors());
}
