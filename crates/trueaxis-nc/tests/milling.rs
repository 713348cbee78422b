//! Milling cycles: the same path in every notation, frame, plane and unit, and the printed examples of manuals.

use std::collections::BTreeMap;

use proptest::prelude::*;
use trueaxis_nc::moves::{Axis, Event, Frame, Move, MoveKind, Position};
use trueaxis_nc::{Control, NoLibrary, Program, Settings, Step, interpret};

/// A move on the workpiece: its end, its centre if it is an arc, rapid or its feed.
#[derive(Debug, Clone, Copy)]
struct Piece {
    to: [f64; 3],
    center: Option<[f64; 3]>,
    feed: f64,
}

/// The moves of a program on the workpiece with tool 1 of a radius, and the codes of what was found.
fn run(control: Control, text: &str, radius: f64) -> (Vec<Piece>, Vec<&'static str>) {
    let program = Program::new("p", text.as_bytes().to_vec(), control);
    let settings = Settings {
        radii: BTreeMap::from([(1, radius), (2, radius + 1.0)]),
        tools: BTreeMap::from([(1, Position::default()), (2, Position::default())]),
        ..Settings::default()
    };
    let (mut pieces, mut frame) = (Vec::new(), Frame::IDENTITY);
    let outcome = interpret(&program, &NoLibrary, &settings, &mut |step| match step {
        Step::Event(Event::Frame(now), _) => frame = now,
        Step::Event(..) => {}
        Step::Move(m) => pieces.push(piece(&m, &frame)),
    });
    (pieces, outcome.problems.iter().map(|p| p.code).collect())
}

fn piece(m: &Move, frame: &Frame) -> Piece {
    let place = |p: &Position| {
        let p = frame.place(p);
        [p[Axis::X], p[Axis::Y], p[Axis::Z]]
    };
    let center = match m.kind {
        MoveKind::Arc(arc) => {
            let [a, b, _] = arc.plane.axes();
            let mut center = m.target;
            (center[a], center[b]) = (arc.center_mm[0], arc.center_mm[1]);
            Some(place(&center))
        }
        _ => None,
    };
    let feed = if m.kind == MoveKind::Rapid { f64::INFINITY } else { m.feed.value };
    Piece { to: place(&m.target), center, feed }
}

fn sound(control: Control, text: &str, radius: f64) -> Vec<Piece> {
    let (pieces, found) = run(control, text, radius);
    assert!(found.iter().all(|code| *code == "pocket-size"), "{found:?}\n{text}");
    pieces
}

fn near(a: [f64; 3], b: [f64; 3]) -> bool {
    a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-6)
}

/// The pieces without those that lead nowhere.
fn moving(pieces: &[Piece]) -> Vec<Piece> {
    let mut found: Vec<Piece> = Vec::new();
    for p in pieces {
        if p.center.is_some() || found.last().is_none_or(|last| !near(last.to, p.to)) {
            found.push(*p);
        }
    }
    found
}

fn assert_same(a: &[Piece], b: &[Piece], what: &str) {
    let (a, b) = (moving(a), moving(b));
    assert_eq!(a.len(), b.len(), "{what}");
    for (a, b) in a.iter().zip(&b) {
        let centers = match (a.center, b.center) {
            (Some(a), Some(b)) => near(a, b),
            (a, b) => a.is_none() && b.is_none(),
        };
        let feeds = a.feed == b.feed || (a.feed - b.feed).abs() < 1e-6;
        assert!(near(a.to, b.to) && centers && feeds, "{a:?} {b:?}\n{what}");
    }
}

const SINUMERIK: Control = Control::Sinumerik840d;

/// Calls of milling cycles in mm with the tool of radius 4: lengths are multiples of 1 mm about (x, y).
fn sinumerik_calls(x: f64, y: f64, angle: f64) -> Vec<String> {
    vec![
        format!("POCKET3(10,0,2,-7,40,26,6,{x},{y},{angle},3,0.5,0.25,300,100,0,11,5)"),
        format!("POCKET3(10,0,2,-7,40,26,6,{x},{y},{angle},3,0.5,0.25,300,100,2,22,5,0,0,0,3,2)"),
        format!("POCKET3(10,0,2,-7,20,36,0,{x},{y},{angle},0,0,0,300,100,1,31,0,0,0,0,20,0)"),
        format!("POCKET4(10,0,2,-7,20,{x},{y},3,0.5,0.25,300,100,0,21,5,0,0,3,2)"),
        format!(
            "POCKET4(10,0,2,7,40,{x},{y},3,0.5,0.25,300,100,3,1014,50,0,0,3,2,0,1,2,10100,110,111)"
        ),
    ]
}

/// The same face in both cycles: 60 x 40 from (x, y), strokes of 10, 5 off the face, 1.5 left; CYCLE61 has no angle.
fn faces(x: f64, y: f64, angle: f64) -> [String; 2] {
    let (x1, y1) = (x + 60.0, y + 40.0);
    [
        format!("CYCLE71(10,0,5,-11,{x},{y},60,40,{angle},6,6,5,1.5,400,31,0)"),
        format!("CYCLE61(10,0,5,11,{x},{y},{x1},{y1},6,75,1.5,400,31,0,1,11011)"),
    ]
}

/// CYCLE71 and CYCLE61 are the same without an angle; the printed CYCLE71 (60 x 40 at X100 Y100, 10 degrees).
#[test]
fn faces_of_both_cycles() {
    let run = |call: &str| {
        sound(SINUMERIK, &format!("T1 D1 M6\nM3 F9\nG0 X0 Y0 Z50\n{call}\nM30\n"), 4.0)
    };
    let [old, new] = faces(7.0, -3.0, 0.0);
    assert_same(&run(&old), &run(&new), &old);
    // Opposite corners, absolute and incremental; a limit keeps the cutter inside.
    let incremental = "CYCLE61(10,0,5,-9.5,7,-3,60,40,6,6,0,400,31,0,1,0)";
    assert_same(
        &run(&new)[..],
        &run(&incremental.replace("-9.5,7", "-11,7").replace("6,6,0,", "6,6,1.5,")),
        &new,
    );
    let limited = run("CYCLE61(10,0,5,-9.5,7,-3,60,40,6,6,0,400,31,1011,1,0)");
    let [low, high, bottom, top] = reach(&limited, -9.5);
    assert_eq!((low, high, top), (11.0, 63.0, 33.0));
    assert!(bottom < -3.0 + 4.0, "{bottom}");
    let printed = "T1 D1 M6\nM3 F2000\nG17 G0 G90 G54 G94 X0 Y0 Z20\n\
        CYCLE71(10,0,2,-11,100,100,60,40,10,6,10,5,0,4000,31,2)\nG0 G90 X0 Y0\nM30\n";
    let pieces = sound(SINUMERIK, printed, 10.0);
    // Two layers of 5.5; in its own axes from X-15 to 75, from Y0 to 32 (40 + 2 - 10).
    let (sin, cos) = 10.0_f64.to_radians().sin_cos();
    let own: Vec<_> = pieces
        .iter()
        .map(|p| {
            let d = [p.to[0] - 100.0, p.to[1] - 100.0];
            Piece { to: [d[0] * cos + d[1] * sin, d[1] * cos - d[0] * sin, p.to[2]], ..*p }
        })
        .collect();
    assert_eq!(reach(&own, -11.0), [-15.0, 75.0, 0.0, 32.0]);
    assert_eq!(reach(&own, -5.5), [-15.0, 75.0, 0.0, 32.0]);
    assert!(pieces.iter().filter(|p| p.to[2] < 0.0).all(|p| p.feed == 4000.0));
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, cases: 32, ..ProptestConfig::default() })]

    /// A milling cycle in a frame that is shifted and turned is the same cycle, shifted and turned.
    #[test]
    fn law_milling_cycles_move_with_their_frame(
        x in -50.0..50.0, y in -50.0..50.0, turn in -180.0..180.0,
    ) {
        for call in 0..sinumerik_calls(0.0, 0.0, 0.0).len() {
            let head = "T1 D1 M6\nS1000 M3 F200\n";
            let there = format!(
                "{head}TRANS X{x:.9} Y{y:.9}\nAROT Z{turn:.9}\nG0 X0 Y0 Z50\n{}\nM30\n", sinumerik_calls(0.0, 0.0, 0.0)[call]
            );
            let here = format!(
                "{head}G0 X{x:.9} Y{y:.9} Z50\n{}\nM30\n",
                sinumerik_calls(x, y, f64::round(turn * 1e9) / 1e9)[call]
            );
            // Circles begin along the first axis of the plane, and CYCLE61 has no angle.
            if matches!(call, 3 | 4 | 6 | 8) && turn != 0.0 {
                let round = here.replace("G0 X", "ROT Z0\nG0 X");
                let turned = there.replace(&format!("AROT Z{turn:.9}"), "AROT Z0");
                assert_same(&sound(SINUMERIK, &turned, 4.0), &sound(SINUMERIK, &round, 4.0), &there);
                continue;
            }
            assert_same(&sound(SINUMERIK, &there, 4.0), &sound(SINUMERIK, &here, 4.0), &there);
        }
    }
}

/// In G18 and G19 the axes change places; inches are 25.4 mm; a tool change before it changes nothing.
#[test]
fn milling_cycles_in_other_planes_units_and_notations() {
    for call in sinumerik_calls(3.0, -4.0, 30.0) {
        let head = "T1 D1 M6\nS1000 M3 F200\n";
        let xy = sound(SINUMERIK, &format!("{head}G0 X3 Y-4 Z50\n{call}\nM30\n"), 4.0);
        let yz = sound(SINUMERIK, &format!("{head}G19\nG0 Y3 Z-4 X50\n{call}\nM30\n"), 4.0);
        let turned: Vec<_> = yz
            .iter()
            .map(|p| {
                let turn = |p: [f64; 3]| [p[1], p[2], p[0]];
                Piece { to: turn(p.to), center: p.center.map(turn), ..*p }
            })
            .collect();
        let named = call.contains("POCKET4") && call.contains(",110,");
        if !named {
            assert_same(&xy[1..], &turned[1..], &call);
        }
        let other = format!("T2 D1 M6\nG0 X1 Y1 Z60\n{head}G0 X3 Y-4 Z50\n{call}\nM30\n");
        assert_same(&xy[1..], &sound(SINUMERIK, &other, 4.0)[2..], &call);
        // The place after the cycle: incremental words count from there.
        let after = format!("{head}G0 X3 Y-4 Z50\n{call}\nG91 G0 X1 Y1 Z1\nM30\n");
        let pieces = sound(SINUMERIK, &after, 4.0);
        let [.., before, end] = &pieces[..] else { panic!() };
        let wanted = [before.to[0] + 1.0, before.to[1] + 1.0, 11.0];
        assert!(near(end.to, wanted), "{call} {end:?}");
        let over_centre = near(before.to, [3.0, -4.0, 10.0]);
        assert_eq!(over_centre, call.starts_with("POCKET"), "{call}");
    }
    let inch = "T1 D1 M6\nM3 F20\nG700\nG0 X1 Y1 Z2\nPOCKET4(0.5,0,0.1,-0.3,1,1,1,0.1,0.01,0.01,30,10,0,11,0.2)\nM30\n";
    let mm = "T1 D1 M6\nM3 F20\nG0 X25.4 Y25.4 Z50.8\n\
        POCKET4(12.7,0,2.54,-7.62,25.4,25.4,25.4,2.54,0.254,0.254,762,254,0,11,5.08)\nM30\n";
    assert_same(&sound(SINUMERIK, inch, 4.0), &sound(SINUMERIK, mm, 4.0), inch);
    // MCALL: a pocket without a centre of its own at each place.
    let many = "T1 D1 M6\nM3 F200\nG0 X0 Y0 Z50\nMCALL POCKET4(10,0,2,-7,20,,,3,0,0,300,100,0,11,5)\n\
        X10 Y5\nX60\nMCALL\nM30\n";
    let two = "T1 D1 M6\nM3 F200\nG0 X0 Y0 Z50\nX10 Y5\nPOCKET4(10,0,2,-7,20,10,5,3,0,0,300,100,0,11,5)\n\
        X60\nPOCKET4(10,0,2,-7,20,60,5,3,0,0,300,100,0,11,5)\nM30\n";
    assert_same(&sound(SINUMERIK, many, 4.0), &sound(SINUMERIK, two, 4.0), many);
}

/// A surface that lies 5 mm higher, with the same depth below it: the same path 5 mm higher.
#[test]
fn law_a_higher_surface_has_the_same_path_higher() {
    for call in sinumerik_calls(3.0, -4.0, 30.0) {
        let head = "T1 D1 M6\nM3 F200\nG0 X3 Y-4 Z";
        let higher = call.replace("(10,0,2,-7,", "(15,5,2,-2,").replace("(10,0,2,7,", "(15,5,2,7,");
        let low = sound(SINUMERIK, &format!("{head}50\n{call}\nM30\n"), 4.0);
        let high = sound(SINUMERIK, &format!("{head}55\n{higher}\nM30\n"), 4.0);
        let down = |[x, y, z]: [f64; 3]| [x, y, z - 5.0];
        let lowered = |p: &Piece| Piece { to: down(p.to), center: p.center.map(down), ..*p };
        assert_same(&low, &high.iter().map(lowered).collect::<Vec<_>>(), &call);
    }
}

/// The reach of the cutter at a height: X and Y from, to.
fn reach(pieces: &[Piece], z: f64) -> [f64; 4] {
    let mut found = [f64::MAX, f64::MIN, f64::MAX, f64::MIN];
    for p in pieces.iter().filter(|p| (p.to[2] - z).abs() < 1e-9) {
        found[0] = found[0].min(p.to[0]);
        found[1] = found[1].max(p.to[0]);
        found[2] = found[2].min(p.to[1]);
        found[3] = found[3].max(p.to[1]);
    }
    found.map(|v| (v * 1e6).round() / 1e6)
}

/// The printed examples of the manual's POCKET3 (60 x 40 at X60 Y40, R8, 17.5 deep, allowances 0.75 and 0.2,
/// infeed 4 at most) and POCKET4 (radius 25 in G19 at Y50 Z60, 20 deep, helix of 2 with 3 a turn).
#[test]
fn printed_pockets() {
    let text = "G90 T1 D1 M6\nS600 M4\nG17 G0 X60 Y40 Z5\n\
        POCKET3(5,0,0.5,-17.5,60,40,8,60,40,0,4,0.75,0.2,1000,750,0,11,5)\nM30\n";
    let pieces = sound(SINUMERIK, text, 5.0);
    // The wall is at 30 and 20, the centre 5.75 before it; the floor 0.2 above -17.5, in 5 layers of 3.46.
    assert_eq!(reach(&pieces, -17.3), [60.0 - 24.25, 60.0 + 24.25, 40.0 - 14.25, 40.0 + 14.25]);
    assert!(pieces.iter().any(|p| (p.to[2] + 3.46).abs() < 1e-9 && p.feed == 750.0));
    assert!(near(pieces.last().unwrap().to, [60.0, 40.0, 5.0]));
    let text = "G19 G90 G0 S650 M3\nT1 D1 M6\nX30 Y50 Z60\n\
        POCKET4(3,0,0.5,-20,25,50,60,6,0,0,200,100,1,21,0,0,0,2,3)\nM30\n";
    let pieces = sound(SINUMERIK, text, 5.0);
    let turned: Vec<_> =
        pieces.iter().map(|p| Piece { to: [p.to[1], p.to[2], p.to[0]], ..*p }).collect();
    assert_eq!(reach(&turned, -20.0)[..2], [30.0, 70.0]);
    // Conventional milling with M3: G2 within a pocket, on a helix of 2 mm first.
    assert!(pieces.iter().any(|p| near(p.to, [0.5, 52.0, 60.0])));
}

/// The printed examples of CYCLE76 (60 x 40, corners 15, 10 degrees, 17.5 deep in steps of 11, blank 80 x 50) and CYCLE77
/// (diameter 50, blank 55, steps of 10, allowance 0.5, conventional).
#[test]
fn printed_spigots() {
    let text = "G90 G0 G17 X100 Y100 T1 D1 M6\nS3000 M3\n\
        CYCLE76(10,0,2,-17.5,,-60,-40,15,80,60,10,11,,,900,800,0,1,80,50)\nM30\n";
    let pieces = sound(SINUMERIK, text, 10.0);
    let (sin, cos) = 10.0_f64.to_radians().sin_cos();
    let own: Vec<_> = pieces
        .iter()
        .map(|p| {
            let d = [p.to[0] - 80.0, p.to[1] - 60.0];
            Piece { to: [d[0] * cos + d[1] * sin, d[1] * cos - d[0] * sin, p.to[2]], ..*p }
        })
        .collect();
    // The path is 10 outside; the start 2 off the blank of 80.
    for z in [-8.75, -17.5] {
        assert_eq!(reach(&own, z), [-40.0, 52.0, -30.0, 30.0]);
    }
    let text = "G90 G17 G0 S1800 M3 T1 D1 M6\nX0 Y0 Z50\nCYCLE77(10,0,3,-20,,50,60,70,10,0.5,0,900,800,1,1,55)\nM30\n";
    let pieces = sound(SINUMERIK, text, 10.0);
    // 25 + 0.5 + 10 about X60 Y70; from 27.5 + 3 + 10. Conventional with M3: G3 around the spigot.
    assert_eq!(reach(&pieces, -20.0), [60.0 - 35.5, 60.0 + 40.5, 70.0, 70.0]);
    assert!(near(pieces.last().unwrap().to, [100.5, 70.0, 10.0]));
    // The same with an allowance of 0.25 on the floor.
    let pieces = sound(SINUMERIK, &text.replace(",0.5,0,900", ",0.5,0.25,900"), 10.0);
    assert_eq!(reach(&pieces, -19.75), [60.0 - 35.5, 60.0 + 40.5, 70.0, 70.0]);
    assert!(pieces.iter().all(|p| p.to[2] > -19.75 - 1e-9));
}

/// M20 x 2 by a cutter of 8: right-hand and climb rises from the bottom, by one helix or in steps of three pitches.
#[test]
fn threads_of_klartext() {
    let thread = |more: &str| {
        let text = format!(
            "{KLARTEXT}L X+10 Y+20 Z+50 FMAX\nCYCL DEF 262 T Q335=20 Q239=2 Q201=-9 Q253=750 Q351=+1 Q200=2 Q203=0 Q204=20 \
             Q207=200 {more}\nCYCL CALL\n"
        );
        sound(Control::Heidenhain, &text, 4.0)
    };
    let heights = |pieces: &[Piece]| -> Vec<f64> {
        let far = |p: &&Piece| (p.to[0] - 16.0).abs() < 1e-9 && p.center.is_some();
        pieces.iter().filter(far).map(|p| (p.to[2] * 1e6).round() / 1e6).collect()
    };
    let one = thread("Q355=1");
    assert_eq!(heights(&one), [-9.0, -7.0, -5.0, -3.0, -1.0, 1.0]);
    assert!(one.iter().any(|p| near(p.to, [10.0, 20.0, -9.5]) && p.feed == 750.0));
    assert!(near(one.last().unwrap().to, [10.0, 20.0, 20.0]));
    assert_eq!(heights(&thread("Q355=3")), [-9.0, -7.0, -3.0, -1.0]);
    assert_eq!(heights(&thread("Q355=0")), [-9.0, -7.0]);
    let down = thread("Q355=1 Q351=-1");
    assert_eq!(heights(&down), [1.0, -1.0, -3.0, -5.0, -7.0, -9.0]);
}

/// Whether the hundreds of _DMODE make the size a diameter was not checked: a program that states them gets a warning.
#[test]
fn the_reading_of_the_size_of_a_round_pocket_is_named() {
    let codes = |modes: &str| {
        let call = format!("POCKET4(10,0,2,-7,20,0,0,3,0,0,300,100,0,11,5{modes})");
        run(SINUMERIK, &format!("T1 D1 M6\nM3 F9\nG0 X0 Y0 Z50\n{call}\nM30\n"), 4.0).1
    };
    assert_eq!(codes(""), [] as [&str; 0]);
    assert_eq!(codes(",,,,,,,,10100,111,0"), ["pocket-size"]);
    assert_eq!(codes(",,,,,,,,10100,11,0"), ["pocket-size"]);
}

/// What is not executed says so, and moves nothing.
#[test]
fn variants_that_are_not_executed_are_named() {
    let calls = [
        ("POCKET4(10,0,2,-7,20,0,0,3,0,0,300,100,0,15,5)", "not-executed"),
        (
            "POCKET3(10,0,2,-7,40,26,6,0,0,0,3,0,0,300,100,0,11,5,,,,,,,,,12100,11,0)",
            "not-executed",
        ),
        (
            "POCKET3(10,0,2,-7,40,26,6,0,0,0,3,0,0,300,100,0,11,5,,,,,,,,,21100,11,0)",
            "not-executed",
        ),
        (
            "POCKET3(10,0,2,-7,40,26,6,0,0,0,3,0,0,300,100,0,11,5,,,,,,,,,11100,12,0)",
            "not-executed",
        ),
        ("POCKET4(10,0,2,-7,3,0,0,3,0,0,300,100,0,11,5)", "not-applied"),
        ("POCKET4(10,0,2,-7,20,0,0,0.00000001,0,0,300,100,0,11,5)", "not-applied"),
        ("POCKET4(10,0,2,7,20,0,0,3,0,0,300,100,0,11,5)", "cycle-heights"),
        ("POCKET4(10,0,2,,20,0,0,3,0,0,300,100,0,11,5)", "cycle-without-depth"),
        ("POCKET4(9999999999999,0,2,-7,20,0,0,3,0,0,300,100,0,11,5)", "too-large"),
    ];
    for (call, code) in calls {
        let (pieces, found) =
            run(SINUMERIK, &format!("T1 D1 M6\nM3 F9\nG0 X0 Y0 Z50\n{call}\nM30\n"), 4.0);
        assert_eq!(found, [code], "{call}");
        assert_eq!(pieces.len(), 1, "{call}");
    }
    let (_, found) = run(
        SINUMERIK,
        "T3 D1 M6\nM3 F9\nPOCKET4(10,0,2,-7,20,0,0,3,0,0,300,100,0,11,5)\nM30\n",
        4.0,
    );
    assert_eq!(found, ["unknown-tool-length", "not-applied"]);
    let (_, found) = run(
        SINUMERIK,
        "T1 D1 M6\nM3 F9\nG41 G1 X10\nPOCKET4(10,0,2,-7,20,0,0,3,0,0,300,100,0,11,5)\nM30\n",
        4.0,
    );
    assert_eq!(found, ["bad-compensation"]);
}

const KLARTEXT: &str = "TOOL DEF 1 L+0 R+4\nTOOL CALL 1 Z S100\n";

/// A slot as a pocket whose corners are as large as they can be; Q367 and Q374 by hand.
#[test]
fn slots_of_klartext() {
    let depth = "Q201=-6 Q202=4 Q206=50 Q207=200 Q200=2 Q203=0 Q204=20 Q351=+1 Q366=0 Q215=0";
    let slot = |more: &str| {
        let text = format!(
            "{KLARTEXT}L X+10 Y+20 Z+50 FMAX\nCYCL DEF 253 SLOT {depth} Q218=40 Q219=12 {more}\nCYCL CALL\n"
        );
        sound(Control::Heidenhain, &text, 4.0)
    };
    // 40 x 12 with a cutter of 8: the centre goes 16 to both sides and 2 up and down.
    let plain = slot("Q374=0 Q367=0");
    assert_eq!(reach(&plain, -6.0), [-6.0, 26.0, 18.0, 22.0]);
    assert!(near(plain.last().unwrap().to, [10.0, 20.0, 20.0]));
    let pocket = format!(
        "{KLARTEXT}L X+10 Y+20 Z+50 FMAX\nCYCL DEF 251 POCKET {depth} Q218=40 Q219=12 Q220=6 Q370=1\nCYCL CALL\n"
    );
    assert_same(&plain, &sound(Control::Heidenhain, &pocket, 4.0), "slot");
    // The tool at the left end, at the centre of the right circle; turned by 90 degrees.
    assert_eq!(reach(&slot("Q374=0 Q367=1"), -6.0), [14.0, 46.0, 18.0, 22.0]);
    assert_eq!(reach(&slot("Q374=0 Q367=3"), -6.0), [-20.0, 12.0, 18.0, 22.0]);
    assert_eq!(reach(&slot("Q374=90 Q367=4"), -6.0), [8.0, 12.0, -16.0, 16.0]);
    // Allowances: roughed to them, then finished with Q385; only roughed with Q215=1.
    let both = slot("Q374=0 Q367=0 Q368=0.5 Q369=1 Q385=333 Q338=3");
    assert_eq!(reach(&both, -5.0), [-5.5, 25.5, 18.5, 21.5]);
    assert_eq!(reach(&both, -3.0), [-6.0, 26.0, 18.0, 22.0]);
    assert_eq!(reach(&both, -6.0), [-6.0, 26.0, 18.0, 22.0]);
    assert!(both.iter().any(|p| p.feed == 333.0));
    // As wide as the cutter: to and fro only; narrower: not at all.
    for (size, z) in [("Q218=40 Q219=8", Some(-6.0)), ("Q218=40 Q219=7", None)] {
        let text =
            format!("{KLARTEXT}L X+0 Y+0 Z+50 FMAX\nCYCL DEF 253 SLOT {depth} {size}\nCYCL CALL\n");
        let (pieces, found) = run(Control::Heidenhain, &text, 4.0);
        match z {
            Some(z) => assert_eq!(reach(&pieces, z), [-16.0, 16.0, 0.0, 0.0]),
            None => assert_eq!((found, pieces.len()), (vec!["not-applied"], 1)),
        }
    }
}

/// The tool at each corner of a pocket (Q367), turned about the pocket's own axes.
#[test]
fn pockets_of_klartext_by_their_corners() {
    for (place, x, y) in [(1, 15.0, 10.0), (2, -15.0, 10.0), (3, -15.0, -10.0), (4, 15.0, -10.0)] {
        let text = format!(
            "{KLARTEXT}L X+0 Y+0 Z+50 FMAX\nCYCL DEF 251 POCKET Q215=0 Q218=30 Q219=20 Q220=5 Q367={place} Q224=0 \
             Q201=-6 Q202=9 Q206=50 Q207=200 Q200=2 Q203=0 Q204=20 Q351=+1 Q366=0 Q370=1\nCYCL CALL\n"
        );
        let wanted = [x - 11.0, x + 11.0, y - 6.0, y + 6.0];
        assert_eq!(reach(&sound(Control::Heidenhain, &text, 4.0), -6.0), wanted, "Q367={place}");
    }
}

/// PATTERN DEF: places by hand, the cycle at each of them, the surface of a place added to Q203.
#[test]
fn patterns_of_klartext() {
    let places = |pattern: &str| -> Vec<[f64; 2]> {
        let text = format!(
            "{KLARTEXT}L X+0 Y+0 Z+50 FMAX\nPATTERN DEF ~\n {pattern}\nCYCL DEF 200 D Q200=2 Q201=-5 Q206=100 Q202=9 Q210=0 \
             Q203=0 Q204=10 Q211=0\nCYCL CALL PAT FMAX M3\n"
        );
        let deep = sound(Control::Heidenhain, &text, 4.0);
        let deep = deep.iter().filter(|p| p.feed == 100.0);
        deep.map(|p| [p.to[0], p.to[1]].map(|v| (v * 1e3).round() / 1e3 + 0.0)).collect()
    };
    assert_eq!(
        places("POS1 (X+25 Y+33,5 Z+0) ~\n POS2 (X+50 Y+75 Z+0)"),
        [[25.0, 33.5], [50.0, 75.0]]
    );
    assert_eq!(
        places("ROW1 (X+25 Y+33.5 D+8 NUM3 ROT+90 Z+0)"),
        [[25.0, 33.5], [25.0, 41.5], [25.0, 49.5]]
    );
    assert_eq!(
        places("PAT1 (X+10 Y+20 DX+8 DY+10 NUMX2 NUMY2 ROT+0 ROTX+0 ROTY+0 Z+0)"),
        [[10.0, 20.0], [18.0, 20.0], [18.0, 30.0], [10.0, 30.0]]
    );
    // Rows turned by 90 degrees, columns as they were: a parallelogram.
    assert_eq!(
        places("PAT1 (X+10 Y+20 DX+8 DY+10 NUMX2 NUMY2 ROT+0 ROTX+0 ROTY-45 Z+0)")[2],
        [25.071, 27.071]
    );
    let frame = places("FRAME1 (X+0 Y+0 DX+8 DY+10 NUMX3 NUMY3 ROT+0 ROTX+0 ROTY+0 Z+0)");
    assert!(frame.len() == 8 && !frame.contains(&[8.0, 10.0]), "{frame:?}");
    assert_eq!(
        places("CIRC1 (X+25 Y+33 D80 START+45 NUM4 Z+0)")[..2],
        [[53.284, 61.284], [-3.284, 61.284]]
    );
    assert_eq!(
        places("PITCHCIRC1 (X+0 Y+0 D80 START+0 STEP+30 NUM3 Z+0)"),
        places("PITCHCIRC1 (X+0 Y+0 D80 START+0 END+60 NUM3 Z+0)")
    );
    // The surface of a place, and the way between them at the second set-up clearance or where the tool stands.
    let heights = |begin: i32| -> Vec<f64> {
        let text = format!(
            "{KLARTEXT}L X+0 Y+0 Z+{begin} FMAX\nPATTERN DEF POS1 (X+1 Y+2 Z-3) POS2 (X+9 Y+2 Z+4)\n\
             CYCL DEF 252 P Q215=0 Q223=20 Q202=9 Q207=200 Q370=1 Q200=2 Q201=-5 Q206=100 Q203=0 Q204=10\nCYCL CALL PAT FMAX\n"
        );
        let pieces = sound(Control::Heidenhain, &text, 4.0);
        moving(&pieces).iter().filter(|p| p.feed.is_infinite()).map(|p| p.to[2]).collect()
    };
    let wanted = [50.0, 50.0, -1.0, -1.0, 7.0, 50.0, 50.0, 6.0, 6.0, 14.0];
    let found = heights(50);
    assert_eq!((found.first(), found.last()), (Some(&50.0), Some(&14.0)));
    assert!(wanted.iter().all(|z| found.contains(z)), "{found:?}");
    // Without a pattern, or with one in a table, nothing is moved, which is said.
    let text = format!(
        "{KLARTEXT}PATTERN DEF POS1 (X+1 Y+2 Z+0)\nSEL PATTERN \"A\"\nCYCL CALL PAT FMAX\n"
    );
    assert_eq!(run(Control::Heidenhain, &text, 4.0).1, ["not-applied", "not-applied"]);
    for (bad, code) in [
        ("PATTERN DEF POS1 (X+1 Z+0)", "missing-value"),
        ("PATTERN DEF POS1 (X+1 Y+1", "unbalanced-brackets"),
        ("PATTERN DEF POS1 X+1 Y+1", "missing-sign"),
        ("PATTERN DEF ROW1 (X+1 Y+1 D+1 NUM999999 ROT+0 Z+0)", "bad-repeats"),
        ("PATTERN DEF STAR1 (X+1 Y+1)", "unknown-word"),
        ("PATTERN DEF", "missing-value"),
    ] {
        let (_, found) = run(Control::Heidenhain, &format!("{KLARTEXT}{bad}\n"), 4.0);
        assert_eq!(found.last(), Some(&code), "{bad}");
    }
}

/// A pattern moves with its frame, and is the same as the calls one by one.
#[test]
fn patterns_are_calls_one_by_one() {
    let cycle = "CYCL DEF 253 S Q215=0 Q218=30 Q219=12 Q374=20 Q367=0 Q207=200 Q201=-6 Q202=4 Q206=50 Q200=2 Q203=1 Q204=10 Q351=+1";
    let pattern = "PATTERN DEF ROW1 (X+5 Y+7 D+40 NUM3 ROT+0 Z+0)";
    for frame in [
        "",
        "CYCL DEF 10.0 ROTATION\nCYCL DEF 10.1 ROT+35\n",
        "CYCL DEF 7.0 D\nCYCL DEF 7.1 X+9\nCYCL DEF 7.2 Y-4\n",
    ] {
        let head = format!("{KLARTEXT}{frame}L X+0 Y+0 Z+10 FMAX\n{cycle}\n");
        let many = format!("{head}{pattern}\nCYCL CALL PAT FMAX\n");
        let single = format!("{head}L X+5 Y+7 FMAX M99\nL X+45 FMAX M99\nL X+85 FMAX M99\n");
        let (a, b) =
            (sound(Control::Heidenhain, &many, 4.0), sound(Control::Heidenhain, &single, 4.0));
        // The pattern goes up to 11 (Q203 + Q204) first.
        let no_lift: Vec<_> =
            a.iter().enumerate().filter(|(i, _)| *i != 1).map(|(_, p)| *p).collect();
        let last = |p: &[Piece]| p.last().unwrap().to;
        assert!(near(last(&a), last(&b)), "{many}");
        let cut =
            |p: &[Piece]| p.iter().filter(|p| p.feed.is_finite()).copied().collect::<Vec<_>>();
        assert_same(&cut(&no_lift), &cut(&b), &many);
    }
}

/// HAAS G12 and G13 by hand: I alone, I K Q, G91 with L; the tool stays in depth at the centre.
#[test]
fn circular_pockets_of_haas() {
    let haas = |text: &str| {
        sound(Control::Haas, &format!("T1 M6\nG54 G90 G0 X10. Y20.\nZ1.\n{text}\nM30\n"), 4.0)
    };
    let radii = |pieces: &[Piece], z: f64| -> Vec<f64> {
        let full = pieces.iter().filter(|p| p.center.is_some_and(|c| near(c, [10.0, 20.0, z])));
        full.map(|p| ((p.to[0] - 10.0) * 1e6).round() / 1e6).collect()
    };
    let one = haas("G13 I12. F100. Z-3. D1");
    assert_eq!(radii(&one, -3.0), [-8.0, 8.0]);
    assert!(near(one.last().unwrap().to, [10.0, 20.0, -3.0]));
    let many = haas("G12 I6. K15. Q4. F100. Z-3. D1");
    assert_eq!(radii(&many, -3.0), [-2.0, 2.0, -6.0, 6.0, -10.0, 10.0, -11.0, 11.0]);
    let deeper = haas("G91 G13 I12. F100. Z-2. D1 L3\nG0 Z9.");
    for z in [-1.0, -3.0, -5.0] {
        assert_eq!(radii(&deeper, z), [-8.0, 8.0]);
    }
    assert!(near(deeper.last().unwrap().to, [10.0, 20.0, 4.0]));
    // D0 is the path of the centre; in inches everything is 25.4 times as large.
    assert_eq!(radii(&haas("G13 I12. F100. Z-3. D0"), -3.0), [-12.0, 12.0]);
    let inch = sound(
        Control::Haas,
        "T1 M6\nG20 G54 G90 G0 X1. Y2.\nZ1.\nG13 I0.5 F10. Z-.1 D1\nM30\n",
        4.0,
    );
    let mm = sound(
        Control::Haas,
        "T1 M6\nG21 G54 G90 G0 X25.4 Y50.8\nZ25.4\nG13 I12.7 F254. Z-2.54 D1\nM30\n",
        4.0,
    );
    assert_same(&inch, &mm, "inch");
    // G2 or G3: which way the first quarter goes is seen at its centre; the half circle to the path comes before.
    for (bad, code) in [
        ("G13 F100. Z-3. D1", "missing-value"),
        ("G13 I6. K12. F100. Z-3. D1", "missing-value"),
        ("G13 I6. K12. Q0.00001 F100. Z-3. D1", "missing-value"),
        ("G13 I3. F100. Z-3. D1", "not-applied"),
        ("G18 G13 I12. F100. Z-3. D1", "not-applied"),
        ("G13 I12. F100. Z-3. D1 L1000000.", "bad-repeats"),
        ("G13 I12. F100. Z-3. D7", "unknown-tool-radius"),
        ("G41 D1 G1 X30. F100.\nG13 I12. Z-3. D1", "bad-compensation"),
    ] {
        let (_, found) = run(Control::Haas, &format!("T1 M6\nG0 X10. Y20. Z1.\n{bad}\nM30\n"), 4.0);
        assert_eq!(found.first(), Some(&code), "{bad}");
    }
}

/// Cycle 254: two slots of 60 degrees about (50, 40), 12 wide on a diameter of 80.
#[test]
fn slots_along_an_arc() {
    let slot = |more: &str| {
        format!(
            "{KLARTEXT}L X+0 Y+0 Z+50 FMAX\nCYCL DEF 254 S Q215=0 Q219=12 Q375=80 Q216=50 Q217=40 Q376=0 Q248=90 Q378=180 Q377=2 \
             Q207=200 Q201=-6 Q202=9 Q206=50 Q200=2 Q203=0 Q204=20 Q351=+1 Q366=0 {more}\nCYCL CALL\n"
        )
    };
    let pieces = sound(Control::Heidenhain, &slot("Q367=0"), 4.0);
    // The middle at 40 from the centre; the path 2 to both sides and around the ends.
    let at = |x: f64, y: f64| pieces.iter().any(|p| near(p.to, [x, y, -6.0]));
    assert!(at(92.0, 40.0) && at(88.0, 40.0) && at(50.0, 82.0) && at(50.0, 78.0));
    assert!(at(8.0, 40.0) && at(50.0, -2.0));
    assert_eq!(pieces.last().unwrap().to[2], 20.0);
    let (pieces, found) = run(Control::Heidenhain, &slot("Q367=1"), 4.0);
    assert_eq!((pieces.len(), found), (1, vec!["not-applied"]));
}

/// Cycle 204 by hand: 20 thick, edge 15 above the lower end and 3.5 off the centre, counterbore 5 deep, aside to +X.
#[test]
fn counterbores_from_below() {
    let text = "TOOL DEF 1 L+0 R+4\nTOOL CALL 1 Z S100\nL X+10 Y+20 Z+50 FMAX M3\nCYCL DEF 204 B Q200=2 Q249=+5 Q250=20 Q251=3.5 \
        Q252=15 Q253=750 Q254=200 Q255=0.5 Q203=+1 Q204=30 Q214=3 Q336=0\nCYCL CALL\nL IZ+1 FMAX\n";
    let pieces = sound(Control::Heidenhain, text, 4.0);
    let shown: Vec<_> = pieces[1..].iter().map(|p| (p.to[0], p.to[2], p.feed)).collect();
    // The edge of the material is at -19; the lower end 2 + 15 below it, then 5 - 15 from it.
    let rapid = f64::INFINITY;
    assert_eq!(
        shown,
        [
            (10.0, 3.0, rapid),
            (13.5, 3.0, rapid),
            (13.5, -36.0, 750.0),
            (10.0, -36.0, 750.0),
            (10.0, -29.0, 200.0),
            (10.0, -29.0, shown[5].2),
            (10.0, -36.0, 750.0),
            (13.5, -36.0, 750.0),
            (13.5, 3.0, 750.0),
            (10.0, 3.0, rapid),
            (10.0, 31.0, rapid),
            (10.0, 32.0, rapid),
        ]
    );
}
