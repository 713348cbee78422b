//! Circles and holes of cutter locations as arcs and drilling cycles of the controls.

mod library;

use library::machine;
use library::paths::cl;
use proptest::prelude::*;
use std::fmt::Write;
use trueaxis::machine::Machine;
use trueaxis::nc::Control::{self, Fanuc, Haas, Heidenhain, LinuxCnc, Sinumerik840d};
use trueaxis::nc::moves::{Axis, MoveKind};
use trueaxis::nc::{NoLibrary, Program, Settings, Step, interpret};
use trueaxis::post::{FeedRule, PostOptions, Posted, post, verify};
use trueaxis::writer::TipWords;

const CONTROLS: [Control; 5] = [Fanuc, Haas, LinuxCnc, Sinumerik840d, Heidenhain];

fn posted(machine: &Machine, text: &str, options: &PostOptions) -> Posted {
    let (posted, problems) = post(machine, &cl(text), options);
    posted.unwrap_or_else(|| panic!("{problems:?}\n{text}"))
}

/// Posts and proves.
fn proved(machine: &Machine, text: &str, options: &PostOptions) -> Posted {
    let posted = posted(machine, text, options);
    let proof = verify(machine, &posted, options);
    let program = String::from_utf8_lossy(&posted.text);
    let (control, words) = (options.control, options.tip_words);
    assert!(proof.is_within(options), "{control:?} {words:?} {proof:?}\n{text}\n{program}");
    assert_eq!(proof.compared, posted.blocks, "{control:?} {words:?}\n{program}");
    posted
}

fn options(control: Control, tip_words: Option<TipWords>) -> PostOptions {
    PostOptions { tip_words, ..PostOptions::of(control) }
}

const PLATE: &str = include_str!("../../../examples/06_compensate/plate.cls");

/// How many arcs and cycles there are in which program; the helix is an arc everywhere but on HEIDENHAIN.
#[test]
fn arcs_and_cycles_stand_where_the_control_has_them() {
    let mill = machine("three-axis-mill");
    let length = Some(TipWords::Length);
    let angles = Some(TipWords::Angles);
    for (control, words, wanted) in [
        (Fanuc, length, [4, 8]),
        (Haas, length, [4, 8]),
        (LinuxCnc, length, [4, 8]),
        (Sinumerik840d, length, [4, 8]),
        (Heidenhain, length, [3, 8]),
        (Fanuc, None, [4, 8]),
        (Sinumerik840d, None, [4, 8]),
        // Each block from the machine zero: G53, M91.
        (LinuxCnc, None, [0, 0]),
        (Heidenhain, None, [0, 0]),
        (Fanuc, angles, [4, 0]),
        (Haas, angles, [0, 0]),
        (LinuxCnc, angles, [4, 8]),
        (Sinumerik840d, angles, [4, 8]),
        (Heidenhain, angles, [3, 0]),
    ] {
        let posted = proved(&mill, PLATE, &options(control, words));
        assert_eq!([posted.arcs, posted.holes()], wanted, "{control:?} {words:?}");
        let lines = PostOptions { lines_only: true, ..options(control, words) };
        let posted = proved(&mill, PLATE, &lines);
        assert_eq!([posted.arcs, posted.holes()], [0, 0], "{control:?} {words:?}");
    }
}

/// LinuxCNC's own interpreter does what the file says (`oracles/linuxcnc_holes.py`): the arcs with their centres
/// and senses, down to every hole from the clearance, across at the retract height.
#[test]
fn oracle_plate_through_linuxcnc() {
    let data = include_str!("data/linuxcnc-plate.txt");
    let (program, calls) = data.strip_prefix("program\n").unwrap().split_once("calls\n").unwrap();
    let name = "plate".to_owned();
    let options = PostOptions { name, ..options(LinuxCnc, Some(TipWords::Length)) };
    let posted = posted(&machine("three-axis-mill"), PLATE, &options);
    assert_eq!(String::from_utf8_lossy(&posted.text), program);
    let calls: Vec<&str> = calls.lines().collect();
    // End, centre, sense and height.
    let arcs: Vec<&&str> = calls.iter().filter(|c| c.starts_with("ARC_FEED")).collect();
    let wanted = [
        "ARC_FEED -50.0000 40.0000 -50.0000 30.0000 -1 -5.0000",
        "ARC_FEED 60.0000 30.0000 50.0000 30.0000 -1 -5.0000",
        "ARC_FEED 15.0000 0.0000 0.0000 0.0000 1 -2.0000",
        "ARC_FEED 15.0000 0.0000 0.0000 0.0000 1 -2.0000",
    ];
    assert!(arcs.iter().map(|c| **c).eq(wanted), "{arcs:?}");
    let cycles = calls.iter().position(|c| *c == "STRAIGHT_TRAVERSE -40.0000 -25.0000 30.0000");
    let mut theirs: Vec<String> =
        calls[cycles.unwrap()..].iter().map(|c| (*c).to_owned()).collect();
    theirs.dedup();
    let mut wanted = vec!["STRAIGHT_TRAVERSE -40.0000 -25.0000 30.0000".to_owned()];
    let mut go = |word: &str, [x, y, z]: [f64; 3]| {
        wanted.push(format!("STRAIGHT_{word} {x:.4} {y:.4} {z:.4}"));
    };
    for [x, y] in [[-40.0, -25.0], [40.0, -25.0], [40.0, 25.0], [-40.0, 25.0]] {
        go("TRAVERSE", [x, y, 20.0]);
        go("TRAVERSE", [x, y, 3.0]);
        go("FEED", [x, y, -8.0]);
        go("TRAVERSE", [x, y, 20.0]);
    }
    let before_the_dwells = wanted.len();
    assert_eq!(theirs[..before_the_dwells], wanted);
    // The two with a dwell, at two levels, and the deep ones: the bottoms, and no traverse below what is drilled.
    let rest = &theirs[before_the_dwells..];
    assert_eq!(rest.iter().filter(|c| *c == "DWELL 0.5000").count(), 2);
    for bottom in [
        "0.0000 -30.0000 -5.0000",
        "0.0000 30.0000 -15.0000",
        "-20.0000 0.0000 -20.0000",
        "-25.0000 0.0000 -20.0000",
    ] {
        assert!(rest.contains(&format!("STRAIGHT_FEED {bottom}")), "{bottom} {rest:?}");
    }
}

/// What a file may ask of a hole.
#[derive(Debug, Clone)]
struct Asked {
    place: [f64; 2],
    height: f64,
    depth: f64,
    clearance: f64,
    above: f64,
    pecks: Option<[f64; 2]>,
    dwell: f64,
    /// The cycle of the one before, if there is one.
    same: bool,
}

fn holes() -> impl Strategy<Value = Vec<Asked>> {
    let pecks = prop::option::of((2.0..9.0_f64, prop::option::of(1.0..9.0_f64)));
    let size = (1.0..14.0_f64, 0.5..5.0_f64, prop_oneof![Just(0.0), 0.0..20.0_f64]);
    let place =
        (-60.0..60.0_f64, -40.0..40.0_f64, prop_oneof![3 => Just(0.0), 1 => -5.0..20.0_f64]);
    let hole = (place, size, pecks, prop_oneof![Just(0.0), 0.1..2.0_f64], any::<bool>());
    let hole =
        hole.prop_map(|((x, y, height), (depth, clearance, above), pecks, dwell, same)| Asked {
            place: [x, y],
            height,
            depth,
            clearance,
            above,
            pecks: pecks.map(|(first, further)| [first, further.unwrap_or(first)]),
            dwell,
            same,
        });
    prop::collection::vec(hole, 1..8)
}

/// Arcs: turn, radius, sense, height; the first point is at the radius along X.
fn circles() -> impl Strategy<Value = Vec<(f64, f64, bool, f64)>> {
    let turn = prop_oneof![3 => 0.01..6.27_f64, 1 => Just(std::f64::consts::TAU)];
    let rise = prop_oneof![2 => Just(0.0), 1 => -3.0..3.0_f64];
    prop::collection::vec((turn, 0.5..40.0_f64, any::<bool>(), rise), 0..5)
}

/// A file with circles and holes; (a, b, h) go along three perpendicular directions of the workpiece.
fn file(
    circles: &[(f64, f64, bool, f64)],
    holes: &[Asked],
    frame: [[f64; 3]; 3],
    unit: f64,
) -> String {
    let [_, _, axis] = frame;
    let place = |[a, b, h]: [f64; 3]| {
        let at = |i: usize| (frame[0][i] * a + frame[1][i] * b + frame[2][i] * h) / unit;
        format!("{:.7},{:.7},{:.7}", at(0), at(1), at(2))
    };
    let direction = |v: [f64; 3]| format!("{:.12},{:.12},{:.12}", v[0], v[1], v[2]);
    let units = if unit == 1.0 { "MM" } else { "INCHES" };
    let mut text = format!("UNITS/{units}\nMULTAX/ON\nFEDRAT/{}\n", 600.0 / unit);
    let goto = |text: &mut String, at: [f64; 3]| {
        let _ = writeln!(text, "GOTO/{},{}", place(at), direction(axis));
    };
    let _ = writeln!(text, "RAPID");
    goto(&mut text, [0.0, 0.0, 60.0]);
    for (turn, radius, ccw, rise) in circles {
        goto(&mut text, [*radius, 0.0, 0.0]);
        let normal = if *ccw { axis } else { axis.map(|v| -v) };
        let _ =
            writeln!(text, "CIRCLE/{},{},{:.7}", place([0.0; 3]), direction(normal), radius / unit);
        let (sin, cos) = if *ccw { turn.sin_cos() } else { (-turn).sin_cos() };
        goto(&mut text, [radius * cos, radius * sin, *rise]);
    }
    let _ = writeln!(text, "RAPID");
    goto(&mut text, [0.0, 0.0, 60.0]);
    let mut last: Option<&Asked> = None;
    for hole in holes {
        let cycle = last.filter(|_| hole.same).unwrap_or(hole);
        if last.is_none() || !hole.same {
            let kind = if cycle.pecks.is_some() { "DEEP" } else { "DRILL" };
            let pecks = cycle.pecks.map_or_else(String::new, |[a, b]| {
                format!("1STPECK,{:.7},SUBPECK,{:.7},", a / unit, b / unit)
            });
            let _ = writeln!(
                text,
                "CYCLE/{kind},FEDTO,{:.7},{pecks}{},{:.5},RAPTO,{:.7},RTRCTO,{:.7},DWELL,{:.3}",
                cycle.depth / unit,
                if unit == 1.0 { "MMPM" } else { "IPM" },
                150.0 / unit,
                cycle.clearance / unit,
                (cycle.clearance + cycle.above) / unit,
                cycle.dwell
            );
            last = Some(hole);
        }
        goto(&mut text, [hole.place[0], hole.place[1], hole.height]);
    }
    text + "CYCLE/OFF\nFINI\n"
}

const UPRIGHT: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// How long a program waits, and the deepest place that it comes to with feed in each hole.
fn waits(posted: &Posted, control: Control) -> f64 {
    let program = Program::new("p", posted.text.clone(), control);
    let mut all = 0.0;
    interpret(&program, &NoLibrary, &Settings::default(), &mut |step| {
        if let Step::Move(m) = step
            && let MoveKind::Dwell { seconds } = m.kind
        {
            all += seconds;
        }
    });
    all
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 60, failure_persistence: None, ..ProptestConfig::default() })]

    /// Whatever circles and holes a file has, in whatever unit: every program is proved, waits as long as the file
    /// says, and its arcs and cycles do what lines would.
    #[test]
    fn law_shapes_do_what_lines_do(circles in circles(), holes in holes(), inches: bool) {
        let mill = machine("three-axis-mill");
        let unit = if inches { 25.4 } else { 1.0 };
        let text = file(&circles, &holes, UPRIGHT, unit);
        for control in CONTROLS {
            for words in [Some(TipWords::Length), Some(TipWords::Angles), None] {
                let options = options(control, words);
                let shapes = proved(&mill, &text, &options);
                let lines = proved(&mill, &text, &PostOptions { lines_only: true, ..options.clone() });
                prop_assert!(shapes.blocks <= lines.blocks);
                let [a, b] = [waits(&shapes, control), waits(&lines, control)];
                prop_assert!((a - b).abs() < 1e-3 * holes.len() as f64, "{control:?} {a} s, not {b} s");
            }
        }
    }

    /// The same on a table that tilts, for one direction of the tool: with the numbers of the axes the tool still
    /// goes along Z, and the circle lies in X and Y.
    #[test]
    fn law_shapes_on_a_tilted_table(circles in circles(), holes in holes(), tilt in 0.1..0.6_f64) {
        let engraver = machine("i5-engraver");
        let (sin, cos) = tilt.sin_cos();
        let small = |hole: &Asked| Asked {
            place: hole.place.map(|v| 0.3 * v), height: 0.2 * hole.height, depth: hole.depth.min(10.0), ..hole.clone()
        };
        let holes: Vec<Asked> = holes.iter().map(small).collect();
        let circles: Vec<_> = circles.iter().map(|(t, r, c, h)| (*t, r.min(20.0), *c, *h)).collect();
        let text = file(&circles, &holes, [[1.0, 0.0, 0.0], [0.0, cos, sin], [0.0, -sin, cos]], 1.0);
        for control in CONTROLS {
            for words in [None, Some(TipWords::Angles)] {
                let posted = proved(&engraver, &text, &options(control, words));
                if words.is_none() && matches!(control, Fanuc | Sinumerik840d) {
                    let simple = holes.iter().all(|h| h.pecks.is_none());
                    prop_assert!(!simple || posted.holes() == holes.len());
                }
            }
        }
    }
}

/// A place that the file gives twice, exactly or but for its last digits, after a line and after a circle, with a tilted
/// tool: every program is proved, and none of its blocks goes slower than the file says.
#[test]
fn law_a_place_given_twice_slows_no_block() {
    let engraver = machine("i5-engraver");
    let (sin, cos) = 0.5_f64.sin_cos();
    let file = |apart: f64| {
        let mut text = "UNITS/MM\nFEDRAT/600\nMULTAX/ON\n".to_owned();
        let mut goto = |x: f64, along: f64, before: &str| {
            for i in 0..2 {
                let [x, y, z] = [x, along * cos, along * sin].map(|v| v + apart * f64::from(i));
                let _ =
                    writeln!(text, "{before}GOTO/{x:.13},{y:.13},{z:.13},0,{:.12},{cos:.12}", -sin);
            }
        };
        goto(13.3525204, 0.0, "");
        goto(20.0, 0.0, "");
        let circle = format!("CIRCLE/0,0,0,0,{sin:.12},{:.12},20\n", -cos);
        goto(20.0, 0.0, &circle);
        goto(-12.0, -16.0, &circle);
        goto(-12.0, 3.0, "");
        text + "FINI\n"
    };
    for control in CONTROLS {
        for (words, feed) in [
            (None, FeedRule::Tip),
            (None, FeedRule::InverseTime),
            (Some(TipWords::Angles), FeedRule::Tip),
            (Some(TipWords::Angles), FeedRule::AxisLimit),
        ] {
            if control == Heidenhain && feed == FeedRule::InverseTime {
                continue;
            }
            let options = PostOptions { feed, lines_only: true, ..options(control, words) };
            for apart in [0.0, 1e-13, 1e-10, 2e-9, 1e-6, 2e-5, 3e-4] {
                let twice = proved(&engraver, &file(apart), &options);
                let feeds = feeds(&twice, control);
                let at_least = if feed == FeedRule::InverseTime { 2.9 } else { 599.9 };
                assert!(
                    feeds.iter().all(|f| *f > at_least),
                    "{control:?} {words:?} {apart} {feeds:?}"
                );
            }
        }
    }
}

/// The feeds of the moves that cut.
fn feeds(posted: &Posted, control: Control) -> Vec<f64> {
    let program = Program::new("p", posted.text.clone(), control);
    let mut all = Vec::new();
    interpret(&program, &NoLibrary, &Settings::default(), &mut |step| {
        if let Step::Move(m) = step
            && matches!(m.kind, MoveKind::Linear)
        {
            all.push(m.feed.value);
        }
    });
    all
}

/// With the tool length alone a tilted tool is refused with its line.
#[test]
fn a_turned_tool_needs_more_than_its_length() {
    let text = "UNITS/MM\nLOADTL/1\nFEDRAT/9\nMULTAX/ON\nGOTO/0,0,0,0,0,1\nGOTO/1,0,0,0.6,0,0.8\n";
    let (none, problems) =
        post(&machine("i5-engraver"), &cl(text), &options(Fanuc, Some(TipWords::Length)));
    assert!(none.is_none());
    let found: Vec<_> = problems.iter().map(|p| (p.place.line, p.code)).collect();
    assert_eq!(found, [(6, "turned-tool")]);
}

/// The place after a cycle and after an arc is known: the next moves go where the file says.
#[test]
fn moves_after_shapes_begin_where_these_end() {
    let text = "UNITS/MM\nFEDRAT/100\nRAPID\nGOTO/0,0,30\nCYCLE/DRILL,FEDTO,5,RAPTO,2,RTRCTO,2\nGOTO/10,0,0\n\
                GOTO/20,0,0\nCYCLE/OFF\nGOTO/20,0,1\nCIRCLE/10,0,1,0,0,1,10\nGOTO/0,0,1\nGOTO/0,0,5\nFINI\n";
    let mill = machine("three-axis-mill");
    for control in CONTROLS {
        let posted = proved(&mill, text, &options(control, Some(TipWords::Length)));
        let program = Program::new("p", posted.text.clone(), control);
        let mut ends = Vec::new();
        interpret(&program, &NoLibrary, &Settings::default(), &mut |step| {
            if let Step::Move(m) = step {
                ends.push([Axis::X, Axis::Y, Axis::Z].map(|axis| m.target[axis]));
            }
        });
        ends.dedup();
        let wanted = [[20.0, 0.0, 2.0], [20.0, 0.0, 1.0], [0.0, 0.0, 1.0], [0.0, 0.0, 5.0]];
        let found = ends.windows(4).any(|w| {
            w.iter().zip(&wanted).all(|(a, b)| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-6))
        });
        assert!(found, "{control:?} {ends:?}");
    }
}

/// A circle about the tool axis and a hole along it are an arc and a cycle on a table that stands inclined.
#[test]
fn shapes_on_a_standing_table_are_written_as_shapes() {
    let engraver = machine("i5-engraver");
    let hole = Asked {
        place: [5.0, 5.0],
        height: 0.0,
        depth: 5.0,
        clearance: 2.0,
        above: 3.0,
        pecks: None,
        dwell: 0.0,
        same: false,
    };
    for tilt in [0.2_f64, 0.5] {
        let (sin, cos) = tilt.sin_cos();
        let frame = [[1.0, 0.0, 0.0], [0.0, cos, sin], [0.0, -sin, cos]];
        let text = file(&[(2.0, 10.0, true, 0.0)], std::slice::from_ref(&hole), frame, 1.0);
        for control in [Fanuc, Sinumerik840d] {
            let posted = proved(&engraver, &text, &options(control, None));
            assert_eq!([posted.arcs, posted.holes()], [1, 1], "{control:?} {tilt}");
        }
    }
}

/// With tool-centre point a circle about Z of the workpiece stays one while the tool leans, on FANUC (A-79348E) only where
/// the table stands as it did when G43.4 began.
#[test]
fn an_arc_of_fanuc_needs_the_table_where_it_was() {
    let engraver = machine("i5-engraver");
    let leans = "0,-0.5,0.866025403784";
    for (first, arcs_of_fanuc) in [(leans, 1), ("0,0,1", 0)] {
        let text = format!(
            "UNITS/MM\nMULTAX/ON\nFEDRAT/600\nGOTO/10,0,20,{first}\nGOTO/10,0,0,{leans}\n\
             CIRCLE/0,0,0,0,0,1,10\nGOTO/0,10,0,{leans}\nFINI\n"
        );
        for (control, wanted) in [(Fanuc, arcs_of_fanuc), (Sinumerik840d, 1)] {
            let posted = proved(&engraver, &text, &options(control, Some(TipWords::Angles)));
            assert_eq!(posted.arcs, wanted, "{control:?} from {first}");
        }
    }
}

/// Controls calculate with radii up to 10 m: a flatter circle is lines. Over 200 mm both bulge by half a millimetre.
#[test]
fn a_circle_of_more_than_ten_metres_is_lines() {
    let mill = machine("three-axis-mill");
    for (radius, arcs) in [(9_990.0_f64, 1), (10_010.0, 0)] {
        let below = (radius * radius - 100.0 * 100.0).sqrt();
        let text = format!(
            "UNITS/MM\nFEDRAT/600\nRAPID\nGOTO/-100,0,5\nGOTO/-100,0,0\n\
             CIRCLE/0,{:.7},0,0,0,-1,{radius}\nGOTO/100,0,0\nFINI\n",
            -below
        );
        for control in CONTROLS {
            let posted = proved(&mill, &text, &options(control, Some(TipWords::Length)));
            assert_eq!(posted.arcs, arcs, "{control:?} {radius}");
        }
    }
}
