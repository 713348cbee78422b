//! Incremental words and axes that a block does not name count from where the machine is, whatever
//! changed before: plane, tool-centre point, tool, frame, start.

use proptest::prelude::*;
use std::collections::BTreeMap;
use std::fmt::Write as _;
use trueaxis::geometry::Vec3;
use trueaxis::machine::Machine;
use trueaxis::machine::file::NoTables;
use trueaxis::machine::tcp::TipControl;
use trueaxis::nc::moves::{Event, Frame, Position, Step};
use trueaxis::nc::{Control, Program};
use trueaxis::simulate::{Batch, Densify, Observer, Options, SetUp, SetUpTool, simulate};

const HEAD: &str = "[machine]\nname = \"head\"\nchain = \"w b X Y Z C A t\"\n\
                    [axis.C]\ntravel = \"unlimited\"\n[tool]\nlength = \"100 mm\"\n";
const TABLE: &str = "[machine]\nname = \"table\"\nchain = \"w C' A' b X Y Z t\"\n\
                     [axis.C]\ntravel = \"unlimited\"\n[tool]\nlength = \"100 mm\"\n";

fn machine(text: &str) -> Machine {
    Machine::check("machine.toml", text, &NoTables).0.unwrap()
}

fn setup() -> SetUp {
    let tool = |length_mm: f64| SetUpTool {
        name: format!("T{length_mm}"),
        tip_mm: Vec3::new(0.0, 0.0, -length_mm),
        ..SetUpTool::default()
    };
    let offset = |x: f64, y: f64, z: f64| {
        let mut shift = Position::default();
        shift.0[..3].copy_from_slice(&[x, y, z]);
        Frame::shifted(shift)
    };
    SetUp {
        given: true,
        tools: BTreeMap::from([(1, tool(80.0)), (2, tool(125.5))]),
        work_offsets: BTreeMap::from([
            (1, offset(10.0, -20.0, -300.0)),
            (2, offset(3.0, 4.0, -290.0)),
        ]),
        start: Some(Position([1.0, 2.0, 3.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0])),
        ..SetUp::default()
    }
}

/// The state of the control at a move, as the events before it say.
#[derive(Clone)]
struct State {
    frame: Frame,
    length: Position,
    follows_tip: [bool; 2],
    dynamic: Option<[f64; 3]>,
}

/// What happens line by line.
struct Lines {
    frame: Frame,
    length: Position,
    follows_tip: [bool; 2],
    dynamic: Option<[f64; 3]>,
    moves: BTreeMap<u32, State>,
    /// Axis positions, tip in the workpiece and direction of the tool at the end of each line.
    ends: Vec<(u32, [f64; 6], Vec3, Vec3)>,
}

impl Lines {
    fn new() -> Self {
        Self {
            frame: Frame::IDENTITY,
            length: Position::default(),
            follows_tip: [false; 2],
            dynamic: None,
            moves: BTreeMap::new(),
            ends: Vec::new(),
        }
    }

    fn end(&self, line: u32) -> &(u32, [f64; 6], Vec3, Vec3) {
        self.ends.iter().rfind(|e| e.0 <= line).unwrap()
    }
}

impl Observer for Lines {
    fn step(&mut self, step: &Step) {
        match step {
            Step::Event(Event::Frame(frame), _) => self.frame = *frame,
            Step::Event(Event::ToolLength(length), _) => self.length = *length,
            Step::Event(Event::ToolCentre(on), _) => self.follows_tip[0] = *on,
            Step::Event(Event::TiltedPlane(on), _) => self.follows_tip[1] = *on,
            Step::Event(Event::DynamicOffset(zero), _) => self.dynamic = *zero,
            Step::Move(m) => {
                let state = State {
                    frame: self.frame,
                    length: self.length,
                    follows_tip: self.follows_tip,
                    dynamic: self.dynamic,
                };
                self.moves.insert(m.origin.line, state);
            }
            Step::Event(..) => {}
        }
    }

    fn path(&mut self, batch: &Batch<'_>) {
        for (i, node) in batch.nodes.iter().enumerate() {
            let pose = batch.deviation(i);
            let end = (
                node.origin.line,
                node.command,
                pose.nominal_tip.vector(),
                pose.nominal_axis.vector(),
            );
            self.ends.push(end);
        }
    }
}

fn run(machine: &Machine, setup: &SetUp, control: Control, text: &str) -> Lines {
    let program = Program::new("program", text.as_bytes().to_vec(), control);
    let options = Options { densify: Densify::Off, ..Options::default() };
    let mut lines = Lines::new();
    let run = simulate(machine, &program, setup, &options, &mut [&mut lines]);
    assert!(!run.problems.has_errors(), "{text}\n{:?}", run.problems);
    lines
}

/// A change of the state of the control.
#[derive(Debug, Clone, Copy)]
enum Change {
    Tip(bool),
    Plane([f64; 3]),
    NoPlane,
    Shift([f64; 3]),
    Turn(f64),
    Offset(u32),
    Tool(u32),
    /// To a height over the machine zero.
    Machine(f64),
    Mirror,
    /// The rotary axis C by its shorter way.
    Shortest(f64),
    /// The work offset goes round with the table.
    Dynamic(bool),
    /// To the reference point of Z, or of all axes.
    Home(bool),
}

#[derive(Debug, Clone)]
enum Op {
    Change(Change),
    /// To X Y Z A C, of which only some are named: bits.
    Move([f64; 5], u8),
}

const LETTERS: [char; 5] = ['X', 'Y', 'Z', 'A', 'C'];

/// The blocks of a change in the language of a control; none if it has no word for it.
fn blocks(control: Control, change: Change) -> Vec<String> {
    use Change::{
        Dynamic, Home, Machine, Mirror, NoPlane, Offset, Plane, Shift, Shortest, Tip, Tool, Turn,
    };
    let one = |text: String| vec![text];
    match (control, change) {
        // Neither goes together with G254.
        (Control::Haas, Tip(_) | Plane(_)) => {
            let mut all = one("G255".into());
            all.extend(blocks(Control::Fanuc, change));
            all
        }
        (Control::Haas, Dynamic(true)) => ["G49", "G69", "G43 H1", "G254"].map(Into::into).into(),
        (Control::Haas, Dynamic(false)) => one("G255".into()),
        (Control::Haas | Control::Fanuc, Home(true)) => one("G28".into()),
        (Control::Haas | Control::Fanuc, Home(false)) => {
            ["G91 G28 Z0", "G90"].map(Into::into).into()
        }
        (Control::Haas, other) => blocks(Control::Fanuc, other),
        (Control::Heidenhain, Tip(on)) => one(if on { "M128" } else { "M129" }.into()),
        (Control::Heidenhain, Plane([a, b, c])) => {
            one(format!("PLANE SPATIAL SPA{a:+.4} SPB{b:+.4} SPC{c:+.4} TURN FMAX"))
        }
        (Control::Heidenhain, NoPlane) => one("PLANE RESET STAY".into()),
        (Control::Heidenhain, Shift([x, y, z])) => {
            one(format!("TRANS DATUM AXIS X{x:+.4} Y{y:+.4} Z{z:+.4}"))
        }
        (Control::Heidenhain, Turn(by)) => {
            vec!["CYCL DEF 10.0 ROTATION".into(), format!("CYCL DEF 10.1 ROT{by:+.4}")]
        }
        (Control::Heidenhain, Tool(n)) => one(format!("TOOL CALL {n} Z S1000")),
        (Control::Fanuc, Tip(on)) => one(if on { "G43.4 H1" } else { "G49" }.into()),
        (Control::Fanuc, Plane([a, b, c])) => {
            vec![format!("G68.2 P1 Q123 X1. Y2. Z3. I{a:.4} J{b:.4} K{c:.4}"), "G53.1".into()]
        }
        (Control::Fanuc, NoPlane) => one("G69".into()),
        (Control::Fanuc, Shift([x, y, z])) => one(format!("G52 X{x:.4} Y{y:.4} Z{z:.4}")),
        (Control::Fanuc | Control::LinuxCnc, Offset(n)) => one(format!("G{}", 53 + n)),
        (Control::Fanuc, Tool(n)) => vec![format!("T{n} M6"), format!("G43 H{n}")],
        (Control::LinuxCnc, Tip(on)) => one(if on { "M428" } else { "M429" }.into()),
        (Control::LinuxCnc, Turn(by)) => one(format!("G10 L2 P1 R{by:.4}")),
        (Control::LinuxCnc, Shift([x, y, z])) => one(format!("G92 X{x:.4} Y{y:.4} Z{z:.4}")),
        (Control::LinuxCnc, Tool(n)) => vec![format!("T{n} M6"), "G43".into()],
        (Control::Sinumerik840d, Tip(on)) => one(if on { "TRAORI" } else { "TRAFOOF" }.into()),
        (Control::Sinumerik840d, Plane([a, b, c])) => {
            one(format!("CYCLE800(0,\"\",0,57,1,2,3,{a:.4},{b:.4},{c:.4},0,0,0,1,0,0)"))
        }
        (Control::Sinumerik840d, NoPlane) => one("CYCLE800()".into()),
        (Control::Sinumerik840d, Shift([x, y, z])) => one(format!("TRANS X{x:.4} Y{y:.4} Z{z:.4}")),
        (Control::Sinumerik840d, Turn(by)) => one(format!("AROT Z{by:.4}")),
        (Control::Sinumerik840d, Offset(n)) => one(format!("G{}", 53 + n)),
        (Control::Sinumerik840d, Tool(n)) => vec![format!("T{n} M6"), "D1".into()],
        (Control::Heidenhain, Machine(z)) => one(format!("L Z{z:+.4} FMAX M91")),
        (Control::Fanuc | Control::LinuxCnc, Machine(z)) => one(format!("G53 G0 Z{z:.4}")),
        (Control::Sinumerik840d, Machine(z)) => one(format!("SUPA G0 Z{z:.4}")),
        (Control::Heidenhain, Mirror) => {
            vec!["CYCL DEF 8.0 MIRROR IMAGE".into(), "CYCL DEF 8.1 X".into()]
        }
        (Control::Fanuc, Mirror) => one("G51.1 X5.".into()),
        (Control::Sinumerik840d, Mirror) => one("AMIRROR Y0".into()),
        // With M126 HEIDENHAIN displays the written angle, which is not that of the axis.
        (Control::Sinumerik840d, Shortest(c)) => one(format!("G0 C=DC({c:.4})")),
        _ => Vec::new(),
    }
}

/// How the moves of a program are written.
#[derive(Clone, Copy, PartialEq)]
enum Notation {
    /// As the case says: absolute, some axes not named.
    Some,
    /// Absolute, all axes named.
    All,
    /// Incremental, some axes not named.
    Incremental,
}

/// A move in the first writing of a program.
#[derive(Clone, Copy, Default)]
struct Begin {
    /// The place in the program frame before it.
    place: [f64; 5],
    /// A plane is swivelled and the tip not followed: rotary words turn the axes alone, and are not written with others.
    turns_alone: bool,
}

/// X, Y, Z and A, C as bits.
const LINEAR: u8 = 0b111;
const ROTARY: u8 = 0b1_1000;

/// The lines of the program and the numbers of those with moves.
fn written(control: Control, ops: &[Op], notation: Notation, from: &[Begin]) -> (String, Vec<u32>) {
    let klartext = control == Control::Heidenhain;
    let mut text = String::new();
    let (mut line, mut moves) = (1, Vec::new());
    text.push_str(if klartext { "BEGIN PGM T MM\n" } else { "G21 G90 G17 G94 F1000 G54\n" });
    if control == Control::Sinumerik840d {
        text = "G71 G90 G17 G94 F1000 G54\n".into();
    }
    let mut dynamic = false;
    for op in ops {
        match op {
            Op::Change(change) => {
                dynamic = match change {
                    Change::Dynamic(on) => *on && control == Control::Haas,
                    Change::Tip(_) | Change::Plane(_) => false,
                    _ => dynamic,
                };
                for block in blocks(control, *change) {
                    let _ = writeln!(text, "{block}");
                    line += 1;
                }
            }
            Op::Move(to, named) => {
                // While the work offset goes round, the rotary axes are not to turn: X, Y and Z alone, at least X.
                let mut named =
                    if dynamic { named & LINEAR | u8::from(named & LINEAR == 0) } else { *named };
                let Begin { place: start, turns_alone } =
                    from.get(moves.len()).copied().unwrap_or_default();
                if turns_alone && named & LINEAR != 0 {
                    named &= LINEAR;
                }
                let all = if turns_alone && named & LINEAR == 0 { ROTARY } else { 0b1_1111 };
                let mut words = String::new();
                let incremental = notation == Notation::Incremental;
                for (i, letter) in LETTERS.into_iter().enumerate() {
                    let is_named = named >> i & 1 == 1;
                    if !is_named && (notation != Notation::All || all >> i & 1 == 0) {
                        continue;
                    }
                    let goal = if is_named { to[i] } else { start[i] };
                    let value = if incremental { goal - start[i] } else { goal };
                    let _ = match (klartext, incremental) {
                        (true, true) => write!(words, " I{letter}{value:+.9}"),
                        (true, false) => write!(words, " {letter}{value:+.9}"),
                        (false, _) => write!(words, " {letter}{value:.9}"),
                    };
                }
                let _ = match (klartext, incremental) {
                    (true, _) => writeln!(text, "L{words} F1000"),
                    (false, true) => writeln!(text, "G91 G1{words}\nG90"),
                    (false, false) => writeln!(text, "G90 G1{words}\nG90"),
                };
                line += 1;
                moves.push(line);
                line += u32::from(!klartext);
            }
        }
    }
    text.push_str(if klartext { "END PGM T MM\n" } else { "M30\n" });
    (text, moves)
}

/// The place in the program frame before a line, from the axis positions and the tip of the kinematics.
fn place_before(machine: &Machine, lines: &Lines, line: u32) -> [f64; 5] {
    let state = &lines.moves[&line];
    let (_, command, ..) = lines.end(line - 1);
    // The end of the spindle, and from there the length that the control counts with.
    let spindle = TipControl::of(&machine.clone().with_tip(Vec3::zeros())).unwrap();
    let (gauge, direction) = spindle.tip_and_axis(command);
    let tip = gauge - direction * state.length.0[2];
    let axis = |letter| machine.axes().iter().position(|a| a.name.letter() == letter).unwrap();
    let mut basic = Position::default();
    let linear = Vec3::new(command[axis('X')], command[axis('Y')], command[axis('Z')]);
    let length = Vec3::new(state.length.0[0], state.length.0[1], state.length.0[2]);
    let [a, c] = [axis('A'), axis('C')].map(|i| command[i]);
    let carried = state.dynamic.map_or(Vec3::zeros(), |zero| {
        let zero = Vec3::from(zero);
        // The table turns the other way than its axes count (ISO 841), about the machine zero.
        let about_z = [zero.x * c.cos() + zero.y * c.sin(), zero.y * c.cos() - zero.x * c.sin()];
        let there = Vec3::new(
            about_z[0],
            about_z[1] * a.cos() + zero.z * a.sin(),
            zero.z * a.cos() - about_z[1] * a.sin(),
        );
        if machine.workpiece_side() > 1 { there - zero } else { Vec3::zeros() }
    });
    let place = if state.follows_tip.contains(&true) { tip } else { linear - length - carried };
    basic.0[..3].copy_from_slice(place.as_slice());
    let place = state.frame.inverse_place(&basic).unwrap();
    let [a, c] = [a, c].map(f64::to_degrees);
    [place.0[0], place.0[1], place.0[2], a - state.frame.shift.0[3], c - state.frame.shift.0[5]]
}

/// Places at the end of each move differ at most by so much, mm and rad.
fn worst(a: (&Lines, &[u32]), b: (&Lines, &[u32])) -> f64 {
    let end = |(lines, moves): (&Lines, &[u32]), i: usize| *lines.end(moves[i]);
    let mut worst = 0.0_f64;
    for i in 0..a.1.len() {
        let (a, b) = (end(a, i), end(b, i));
        worst = a.1.iter().zip(&b.1).map(|(p, q)| (p - q).abs()).fold(worst, f64::max);
    }
    worst
}

fn agree(machine: &Machine, control: Control, ops: &[Op]) -> Result<(), TestCaseError> {
    let setup = setup();
    let (text, moves) = written(control, ops, Notation::Some, &[]);
    let alone = run(machine, &setup, control, &text);
    let begin = |line: &u32| Begin {
        turns_alone: alone.moves[line].follows_tip == [false, true],
        ..Begin::default()
    };
    let mut from: Vec<Begin> = moves.iter().map(begin).collect();
    let (text, moves) = written(control, ops, Notation::Some, &from);
    let first = run(machine, &setup, control, &text);
    for (begin, line) in from.iter_mut().zip(&moves) {
        begin.place = place_before(machine, &first, *line);
    }
    for notation in [Notation::All, Notation::Incremental] {
        let (twin, twin_moves) = written(control, ops, notation, &from);
        let second = run(machine, &setup, control, &twin);
        let worst = worst((&first, &moves), (&second, &twin_moves));
        prop_assert!(worst < 1e-6, "{worst}\n{text}\n{twin}");
    }
    Ok(())
}

fn change() -> impl Strategy<Value = Change> {
    let place = || prop::array::uniform3(-50.0..50.0_f64);
    prop_oneof![
        any::<bool>().prop_map(Change::Tip),
        prop::array::uniform3(-40.0..40.0_f64).prop_map(Change::Plane),
        Just(Change::NoPlane),
        place().prop_map(Change::Shift),
        (-170.0..170.0_f64).prop_map(Change::Turn),
        (1..3_u32).prop_map(Change::Offset),
        (1..3_u32).prop_map(Change::Tool),
        (-100.0..100.0_f64).prop_map(Change::Machine),
        Just(Change::Mirror),
        (0.0..360.0_f64).prop_map(Change::Shortest),
        any::<bool>().prop_map(Change::Dynamic),
        any::<bool>().prop_map(Change::Home),
    ]
}

fn ops() -> impl Strategy<Value = Vec<Op>> {
    let to = (prop::array::uniform3(-50.0..50.0_f64), -60.0..60.0_f64, -170.0..170.0_f64)
        .prop_map(|([x, y, z], a, c)| [x, y, z, a, c]);
    let go = (to, 1..32_u8).prop_map(|(to, named)| Op::Move(to, named));
    prop::collection::vec(prop_oneof![change().prop_map(Op::Change), go], 2..14)
}

/// All with TRUEAXIS_LONG (CONTRIBUTING.md), a part of them otherwise.
fn cases() -> ProptestConfig {
    let is_long = std::env::var_os("TRUEAXIS_LONG").is_some();
    ProptestConfig::with_cases(if is_long { 10_000 } else { 3000 })
}

proptest! {
    #![proptest_config(cases())]

    /// The same path, over 10^4 programs for each control (3000 without TRUEAXIS_LONG), in absolute words, in incremental words and with all axes named.
    #[test]
    fn law_incremental_is_absolute_fanuc(ops in ops(), table in any::<bool>()) {
        agree(&machine(if table { TABLE } else { HEAD }), Control::Fanuc, &ops)?;
    }

    #[test]
    fn law_incremental_is_absolute_haas(ops in ops(), table in any::<bool>()) {
        agree(&machine(if table { TABLE } else { HEAD }), Control::Haas, &ops)?;
    }

    #[test]
    fn law_incremental_is_absolute_linuxcnc(ops in ops(), table in any::<bool>()) {
        agree(&machine(if table { TABLE } else { HEAD }), Control::LinuxCnc, &ops)?;
    }

    #[test]
    fn law_incremental_is_absolute_sinumerik(ops in ops(), table in any::<bool>()) {
        agree(&machine(if table { TABLE } else { HEAD }), Control::Sinumerik840d, &ops)?;
    }

    #[test]
    fn law_incremental_is_absolute_heidenhain(ops in ops(), table in any::<bool>()) {
        agree(&machine(if table { TABLE } else { HEAD }), Control::Heidenhain, &ops)?;
    }
}

/// The tip after the last line, less where it was after line `before`.
fn tip_moved(lines: &Lines, before: u32) -> Vec3 {
    lines.ends.last().unwrap().2 - lines.end(before).2
}

#[test]
fn after_a_swivel_five_along_the_tool_is_five() {
    let programs = [
        (
            Control::Heidenhain,
            "BEGIN PGM T MM\nTOOL CALL 1 Z S1000\nL X+10 Y+20 Z+30 F1000\n\
          PLANE SPATIAL SPA+30 SPB+0 SPC+0 TURN FMAX\nL IZ+5 F1000\nEND PGM T MM\n",
        ),
        (
            Control::Fanuc,
            "G54 T1 M6\nG43 H1\nG68.2 P1 Q123 X0 Y0 Z0 I30. J0 K0\n\
          G53.1\nG91 G1 Z5. F1000\nM30\n",
        ),
        (
            Control::Sinumerik840d,
            "G54 T1 M6 D1\nG1 X10 Y20 Z30 F1000\n\n\
          CYCLE800(0,\"\",0,57,0,0,0,30,0,0,0,0,0,1,0,0)\nG91 G1 Z5\nM30\n",
        ),
    ];
    for chain in [HEAD, TABLE] {
        for (control, text) in programs {
            let lines = run(&machine(chain), &setup(), control, text);
            let (.., axis) = lines.ends.last().unwrap();
            let moved = tip_moved(&lines, 4);
            assert!((moved - axis * 5.0).norm() < 1e-9, "{control:?} {moved:?} along {axis:?}");
        }
    }
}

#[test]
fn tip_control_switched_on_while_tilted_moves_nothing() {
    let programs = [
        (
            Control::Fanuc,
            "G54 T1 M6\nG43 H1\nG1 X10. Y20. Z30. A25. C40. F1000\nG43.4 H1\n\
          G91 G1 X0 Y0 Z0\nM30\n",
        ),
        (
            Control::LinuxCnc,
            "G54 T1 M6\nG43\nG1 X10. Y20. Z30. A25. C40. F1000\nM428\n\
          G91 G1 X0 Y0 Z0\nM2\n",
        ),
        (
            Control::Sinumerik840d,
            "G54\nT1 M6 D1\nG1 X10. Y20. Z30. A25. C40. F1000\nTRAORI\n\
          G91 G1 X0 Y0 Z0\nM30\n",
        ),
        (
            Control::Heidenhain,
            "BEGIN PGM T MM\nTOOL CALL 1 Z S1000\n\
          L X+10 Y+20 Z+30 A+25 C+40 F1000\nM128\nL IX+0 IY+0 IZ+0\nEND PGM T MM\n",
        ),
    ];
    for (control, text) in programs {
        let lines = run(&machine(HEAD), &setup(), control, text);
        assert!(tip_moved(&lines, 4).norm() < 1e-9, "{control:?}");
    }
}

#[test]
fn the_start_counts_before_the_first_absolute_word() {
    let mut setup = setup();
    setup.work_offsets.get_mut(&1).unwrap().shift.0[2] = -410.0;
    setup.start = Some(Position::default());
    for (text, z) in [("G54\nG91 G28 Z0\nM30\n", 0.0), ("G54\nG91 G0 Z-10.\nM30\n", -10.0)] {
        for control in [Control::Fanuc, Control::LinuxCnc] {
            let lines = run(&machine(HEAD), &setup, control, text);
            let lowest = lines.ends.iter().map(|e| e.1[2]).fold(f64::INFINITY, f64::min);
            assert!((lowest - z).abs() < 1e-9, "{control:?} {text}: {lowest}");
        }
    }
}

#[test]
fn machine_coordinates_in_a_turned_frame_move_the_named_axis_alone() {
    let programs = [
        (Control::Fanuc, "G54\nG68 X0 Y0 R40.\nG53 G0 X70.\nM30\n"),
        (Control::Fanuc, "G54\nG68 X0 Y0 R40.\nG91 G28 X0\nM30\n"),
        (Control::LinuxCnc, "G54\nG10 L2 P1 R40\nG53 G0 X70\nM2\n"),
        (Control::Sinumerik840d, "G54\nAROT RPL=40\nG0 SUPA X70\nM30\n"),
        (
            Control::Heidenhain,
            "BEGIN PGM T MM\nTOOL CALL 1 Z S1\nCYCL DEF 10.0 ROTATION\nCYCL DEF 10.1 ROT+40\n\
          L X+70 FMAX M91\nEND PGM T MM\n",
        ),
    ];
    for (control, text) in programs {
        let lines = run(&machine(HEAD), &setup(), control, text);
        let at = lines.ends.last().unwrap().1;
        let x = if text.contains("G28") { 0.0 } else { 70.0 };
        assert!(
            (at[0] - x).abs() < 1e-9 && (at[1] - 2.0).abs() < 1e-9,
            "{control:?} {text}: {at:?}"
        );
    }
}

#[test]
fn a_retraction_without_a_length_ends_where_the_first_axis_has_its_end() {
    let travel = "[axis.X]\ntravel = [\"-900 mm\", \"900 mm\"]\n[axis.Y]\ntravel = [\"-120 mm\", \"900 mm\"]\n\
                  [axis.Z]\ntravel = [\"-900 mm\", \"400 mm\"]\n";
    let text = "BEGIN PGM T MM\nTOOL CALL 1 Z S1\nL X+10 Y+20 Z+30 A+0 C+0 FMAX\nL M140 MB MAX\nL IZ-10 FMAX\n\
                L A+50 C+20 FMAX\nL Z+30 FMAX\nL M140 MB MAX\nEND PGM T MM\n";
    let head = machine(&format!("{HEAD}{travel}"));
    let lines = run(&head, &setup(), Control::Heidenhain, text);
    assert!((lines.end(4).1[2] - 400.0).abs() < 1e-9, "{:?}", lines.end(4));
    assert!((lines.end(5).1[2] - 390.0).abs() < 1e-9, "{:?}", lines.end(5));
    // Tilted: along the tool, until Y or Z is at its end, and no axis beyond.
    let (.., at, tip, axis) = lines.end(8);
    let moved = tip - lines.end(7).2;
    assert!(
        moved.norm() > 50.0 && moved.cross(axis).norm() < 1e-9 && moved.dot(axis) > 0.0,
        "{moved:?} {axis:?}"
    );
    assert!(at[1] >= -120.0 - 1e-9 && at[2] <= 400.0 + 1e-9, "{at:?}");
    assert!((at[1] + 120.0).abs() < 1e-9 || (at[2] - 400.0).abs() < 1e-9, "{at:?}");
    // MB of PLANE goes back along the tool before the axes turn.
    let plane = "BEGIN PGM T MM\nTOOL CALL 1 Z S1\nL X+10 Y+20 Z+30 A+0 C+0 FMAX\n\
                 PLANE SPATIAL SPA+20 SPB+0 SPC+0 TURN MB MAX FMAX\nEND PGM T MM\n";
    let lines = run(&head, &setup(), Control::Heidenhain, plane);
    assert!((lines.end(4).1[2] - 400.0).abs() < 1e-9, "{:?}", lines.end(4));
    let near = plane.replace("MB MAX", "MB7");
    let lines = run(&head, &setup(), Control::Heidenhain, &near);
    assert!((lines.end(4).1[2] - lines.end(3).1[2] - 7.0).abs() < 1e-9, "{:?}", lines.end(4));
}

/// With G254 the same words lead to the same place of the workpiece, seen along the axes of the machine, wherever the
/// workpiece is clamped: the program of a part on the centre of the table needs no change.
#[test]
fn a_dynamic_work_offset_goes_round_with_the_table() {
    let table = machine(TABLE);
    let text =
        "G54 T1 M6\nG43 H1\nG0 A90. C0.\nG254\nG0 X1. Y2.\nG0 Z3.\nG91 G1 X1. F1000\nG255\nM30\n";
    let lines = run(&table, &setup(), Control::Haas, text);
    // G54 at (10, -20, -300). A table at A+90 is turned by -90 deg about X: (x, y, z) comes to (x, z, -y), so that
    // the origin comes to (10, -300, 20). X = 10 + 1, Y = -300 + 2, Z = 20 + 3 + 80 of the tool.
    let at = lines.end(6).1;
    let linear = |letter| at[table.axes().iter().position(|a| a.name.letter() == letter).unwrap()];
    for (letter, expected) in [('X', 11.0), ('Y', -298.0), ('Z', 103.0)] {
        assert!((linear(letter) - expected).abs() < 1e-9, "{letter}: {}", linear(letter));
    }
    // The tip is one along X, two along Z and three along -Y of the workpiece from its origin.
    let from_zero = lines.end(6).2 - Vec3::new(10.0, -20.0, -300.0);
    assert!((from_zero - Vec3::new(1.0, -3.0, 2.0)).norm() < 1e-9, "{from_zero:?}");
    assert!((lines.end(7).2 - lines.end(6).2 - Vec3::x()).norm() < 1e-9);
}

#[test]
fn what_goes_not_together_with_a_dynamic_work_offset_is_refused() {
    let codes = |text: &str| -> Vec<&'static str> {
        let program = Program::new("program", text.as_bytes().to_vec(), Control::Haas);
        let run = simulate(&machine(TABLE), &program, &setup(), &Options::default(), &mut []);
        run.problems.iter().map(|p| p.code).filter(|c| c.starts_with("dynamic")).collect()
    };
    for (text, code) in [
        ("G54 T1 M6\nG43.4 H1\nG254\n", "dynamic-offset-twice"),
        ("G54 T1 M6\nG254\nG43.4 H1\n", "dynamic-offset-twice"),
        ("G54 T1 M6\nG254\nG68.2 X0 Y0 Z0 I10. J20. K0\n", "dynamic-offset-twice"),
        ("G10 L2 P1 C15.\nG54 T1 M6\nG254\n", "dynamic-offset-turned"),
        ("G54 T1 M6\nG43 H1\nG254\nG1 X1. Y2. F100\n", "dynamic-offset-place"),
        ("G54 T1 M6\nG43 H1\nG254\nG0 A20.\n", "dynamic-offset-turns"),
    ] {
        assert!(codes(&format!("{text}M30\n")).contains(&code), "{text} {:?}", codes(text));
    }
    let good =
        "G54 T1 M6\nG43 H1\nG0 A20.\nG254\nG0 X1. Y2.\nZ3.\nG1 Z1. F100\nG255\nG0 A0.\nM30\n";
    assert_eq!(codes(good), Vec::<&str>::new());
}
