//! Patterns of holes, deep holes, pockets and threads: the same in all languages, and by hand.

use std::collections::BTreeMap;

use proptest::prelude::*;
use trueaxis_nc::moves::{Axis, Move, MoveKind, Position};
use trueaxis_nc::{
    Control, Event, NoLibrary, Outcome, Program, Settings, Step, interpret, leaves_motion_out,
};

fn run(control: Control, text: &str) -> (Vec<Move>, Outcome) {
    let program = Program::new("p", text.as_bytes().to_vec(), control);
    let tool = Position([0.0, 0.0, 50.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
    let settings = Settings { tools: BTreeMap::from([(1, tool)]), ..Settings::default() };
    let mut moves = Vec::new();
    let outcome = interpret(&program, &NoLibrary, &settings, &mut |s| {
        if let Step::Move(m) = s {
            moves.push(m);
        }
    });
    (moves, outcome)
}

fn sound(control: Control, text: &str) -> Vec<Move> {
    let (moves, outcome) = run(control, text);
    let problems: Vec<_> = outcome.problems.iter().map(ToString::to_string).collect();
    assert!(outcome.finished && problems.is_empty(), "{text}\n{problems:?}");
    moves
}

/// Rapid or with feed, and where to; moves that lead nowhere are left out.
fn path(moves: &[Move]) -> Vec<(bool, [f64; 3])> {
    let mut found: Vec<(bool, [f64; 3])> = Vec::new();
    for m in moves {
        let to = [m.target.0[0], m.target.0[1], m.target.0[2]];
        let same = |p: &[f64; 3]| p.iter().zip(&to).all(|(a, b)| (a - b).abs() < 1e-9);
        if found.last().is_none_or(|(_, p)| !same(p)) {
            found.push((m.kind == MoveKind::Rapid, to));
        }
    }
    found
}

fn assert_same(a: &[(bool, [f64; 3])], b: &[(bool, [f64; 3])], what: &str) {
    assert_eq!(a.len(), b.len(), "{what}\n{a:?}\n{b:?}");
    for ((rapid, p), (other, q)) in a.iter().zip(b) {
        let near = p.iter().zip(q).all(|(p, q)| (p - q).abs() < 1e-6);
        assert!(rapid == other && near, "{what}\n{a:?}\n{b:?}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, cases: 64, ..ProptestConfig::default() })]

    /// A circle of holes drilled to 5 below the surface, from 2 above it, out to 10: in the words of five
    /// controls, and hole by hole.
    #[test]
    fn law_a_circle_of_holes_is_the_same_in_all_languages(
        x in -50..50, y in -50..50, r in 5..40, start in 0..300, count in 2..9_u32,
    ) {
        let (x, y, r, start) = (f64::from(x), f64::from(y), f64::from(r), f64::from(start));
        let hole = |i: u32| {
            let angle = (start + 360.0 * f64::from(i) / f64::from(count)).to_radians();
            [x + r * angle.cos(), y + r * angle.sin()]
        };
        let mut wanted = Vec::new();
        for i in 0..count {
            let [x, y] = hole(i);
            for (rapid, z) in [(true, 10.0), (true, 2.0), (false, -5.0), (true, 10.0)] {
                wanted.push((rapid, [x, y, z]));
            }
        }
        let since_first = |moves: Vec<Move>| {
            let path = path(&moves);
            let end = path.iter().rposition(|(_, p)| p[2] == 10.0).unwrap() + 1;
            let begin = path.iter().position(|(_, p)| (p[0] - wanted[0].1[0]).abs() < 1e-6 && (p[1] - wanted[0].1[1]).abs() < 1e-6).unwrap();
            path[begin..end].to_vec()
        };
        let klartext = format!(
            "TOOL CALL 1 Z S100\nL X+999 Y+0 Z+10 R0 FMAX\nCYCL DEF 200 D Q200=2 Q201=-5 Q206=100 Q202=9 Q210=0 Q203=0 Q204=10 Q211=0\n\
             CYCL DEF 220 P Q216={x} Q217={y} Q244={} Q245={start} Q246={} Q247=0 Q241={count} Q200=2 Q203=0 Q204=10 Q301=1\n",
            2.0 * r, start + 360.0,
        );
        assert_same(&since_first(sound(Control::Heidenhain, &klartext)), &wanted, &klartext);
        let mpf = format!(
            "G0 G90 X999 Y0 Z10 F100\nMCALL CYCLE81(10,0,2,-5)\nHOLES2({x},{y},{r},{start},0,{count})\nMCALL\nM30\n",
        );
        assert_same(&since_first(sound(Control::Sinumerik840d, &mpf)), &wanted, &mpf);
        let haas = format!(
            "G0 G90 X999. Y0 Z10.\nX{x}. Y{y}.\nG98 G81 Z-5. R2. F100. L0\nG70 I{r}. J{start}. L{count}\nG80\nM30\n",
        );
        assert_same(&since_first(sound(Control::Haas, &haas)), &wanted, &haas);
        for control in [Control::Fanuc, Control::LinuxCnc] {
            let mut text = "G0 G90 X999. Y0 Z10.\nG98 G81 Z-5. R2. F100.".to_owned();
            for i in 0..count {
                let [x, y] = hole(i);
                text += &format!(" X{x:.9} Y{y:.9}\n");
            }
            text += "G80\nM30\n";
            assert_same(&since_first(sound(control, &text)), &wanted, &text);
        }
    }
}

/// HOLES1 begins at the nearer end; CYCLE801 and cycle 221 go through their rows there and back.
#[test]
fn rows_and_grids() {
    let places = |moves: &[Move]| -> Vec<[f64; 2]> {
        let bottom = |m: &&Move| m.target[Axis::Z] == -5.0 && m.kind == MoveKind::Linear;
        let deep = moves.iter().filter(bottom);
        deep.map(|m| [m.target.0[0], m.target.0[1]].map(|v| (v * 1e6).round() / 1e6 + 0.0))
            .collect()
    };
    let row = |x: i32| {
        let text = format!(
            "G0 X{x} Y0 Z10 F100\nMCALL CYCLE81(10,0,2,-5)\nHOLES1(20,30,0,10,20,3)\nMCALL\nM30\n"
        );
        places(&sound(Control::Sinumerik840d, &text))
    };
    assert_eq!(row(0), [[30.0, 30.0], [50.0, 30.0], [70.0, 30.0]]);
    assert_eq!(row(100), [[70.0, 30.0], [50.0, 30.0], [30.0, 30.0]]);
    let grid = [[10.0, 5.0], [30.0, 5.0], [30.0, 15.0], [10.0, 15.0]];
    let mpf = "G0 X0 Y0 Z10 F100\nMCALL CYCLE82(10,0,2,-5,,0.2)\nCYCLE801(10,5,0,20,10,2,2)\nMCALL\nM30\n";
    assert_eq!(places(&sound(Control::Sinumerik840d, mpf)), grid);
    let klartext = "TOOL CALL 1 Z S100\nL X+0 Y+0 Z+50 FMAX\n\
        CYCL DEF 200 D Q200=2 Q201=-5 Q206=100 Q202=9 Q210=0 Q203=0 Q204=10 Q211=0\n\
        CYCL DEF 221 P Q225=10 Q226=5 Q237=20 Q238=10 Q242=2 Q243=2 Q224=0 Q200=2 Q203=0 Q204=30 Q301=0\n";
    let moves = sound(Control::Heidenhain, klartext);
    assert_eq!(places(&moves), grid);
    // Between the holes at the set-up clearance, after the last one at the second clearance of the pattern.
    let over: Vec<_> =
        path(&moves).iter().filter(|(r, p)| *r && p[2] > 0.0).map(|(_, p)| p[2]).collect();
    assert_eq!(over[over.len() - 4..], [2.0, 2.0, 2.0, 30.0]);
    // Patterns without a cycle before them leave their holes out.
    let (_, outcome) =
        run(Control::Heidenhain, "CYCL DEF 220 P Q216=1 Q217=2 Q244=9 Q245=0 Q246=360 Q241=4\n");
    assert_eq!(outcome.problems.iter().next().unwrap().code, "not-applied");
}

/// A depth below the surface has no sign: DPR, and DP where _AMODE counts it from there.
#[test]
fn a_depth_below_the_surface_has_no_sign() {
    for call in ["CYCLE81(10,3,2,,5)", "CYCLE81(10,3,2,5,,,,,1)", "CYCLE81(10,3,2,-5,,,,,1)"] {
        let moves = sound(Control::Sinumerik840d, &format!("G0 X0 Y0 Z10 F100\n{call}\nM30\n"));
        let lowest = moves.iter().map(|m| m.target[Axis::Z]).fold(f64::MAX, f64::min);
        assert_eq!(lowest, -2.0, "{call}");
    }
}

/// 10 turns at 120 a minute are 5 s.
#[test]
fn a_dwell_in_revolutions_takes_their_time() {
    let moves = sound(Control::Sinumerik840d, "S120 M3\nG4 S10\nM30\n");
    let seconds: Vec<f64> = moves
        .iter()
        .filter_map(|m| if let MoveKind::Dwell { seconds } = m.kind { Some(seconds) } else { None })
        .collect();
    assert_eq!(seconds, [5.0]);
}

/// The pecks of CYCLE83 by percent, by factor and by amount, and the chip breaking of its newer parameters.
#[test]
fn deep_holes_with_degression() {
    let depths = |call: &str| -> Vec<f64> {
        let text = format!("G0 X0 Y0 Z10 F100\n{call}\nM30\n");
        let moves = sound(Control::Sinumerik840d, &text);
        let mut lows: Vec<f64> = Vec::new();
        for m in &moves {
            let z = m.target[Axis::Z];
            if m.kind == MoveKind::Linear && lows.last().is_none_or(|low| z < *low) {
                lows.push((z * 1e6).round() / 1e6);
            }
        }
        lows
    };
    // 10, 9, 8.1 and the rest of 30; 20, 12, 8 and the remaining 10 in halves (see the manual's rule for DAM).
    let percent = depths("CYCLE83(10,0,2,,30,,10,90,0,0,100,1,0,1,1.4,0,1.6,0,1,11211111)");
    assert_eq!(percent, [-10.0, -19.0, -27.1, -30.0]);
    assert_eq!(depths("CYCLE83(10,0,2,,30,,10,-0.9,0,0,1,1)"), [-10.0, -19.0, -27.1, -30.0]);
    assert_eq!(depths("CYCLE83(10,0,2,,50,,20,8,0,0,1,1)"), [-20.0, -32.0, -40.0, -45.0, -50.0]);
    let chip = sound(
        Control::Sinumerik840d,
        "G0 X0 Y0 Z10 F100\nCYCLE83(10,0,2,,20,,8,0,0,0,1,0,,,1.5)\nM30\n",
    );
    let heights: Vec<_> = chip.iter().map(|m| m.target[Axis::Z]).collect();
    assert_eq!(heights, [10.0, 2.0, -8.0, -6.5, -16.0, -14.5, -20.0, 10.0]);
}

#[test]
fn technologies_of_cycle832_have_names() {
    for name in
        ["_ROUGH", "_FINISH", "_SEMIFIN", "_ORI_ROUGH", "_OFF", "_TOP_SURFACE_SMOOTH_ON+_FINISH"]
    {
        sound(Control::Sinumerik840d, &format!("CYCLE832(0.05,{name},1)\nM30\n"));
    }
    // A variable of the program of this name comes first.
    sound(Control::Sinumerik840d, "DEF INT _ROUGH\n_ROUGH=3\nCYCLE832(0.05,_ROUGH,1)\nM30\n");
}

/// Cycle 208: D20 with a tool of R4, so the centre goes around at 6; 252: D30 with R5, at 10; 251: 60 x 40.
#[test]
fn bores_and_pockets_reach_their_walls() {
    let begin = "TOOL DEF 1 L+0 R+5\nTOOL CALL 1 Z S100\nL X+10 Y+20 Z+50 FMAX\n";
    let reach = |text: &str| {
        let moves = sound(Control::Heidenhain, text);
        let deep = moves.iter().filter(|m| m.target[Axis::Z] == -8.0);
        let far = deep.map(|m| [m.target.0[0] - 10.0, m.target.0[1] - 20.0]);
        let far = far.fold([0.0_f64; 2], |far, p| [far[0].max(p[0].abs()), far[1].max(p[1].abs())]);
        let last = path(&moves).last().unwrap().1;
        (far.map(|v| (v * 1e6).round() / 1e6), last)
    };
    let heights = "Q200=2 Q203=0 Q204=20 Q201=-8 Q206=50";
    let bore = format!("{begin}CYCL DEF 208 B {heights} Q334=3 Q335=22 Q342=0\nCYCL CALL\n");
    assert_eq!(reach(&bore), ([6.0, 0.0], [10.0, 20.0, 20.0]));
    let round = format!(
        "{begin}CYCL DEF 252 P Q215=0 Q223=30 Q202=3 Q207=200 Q370=1 {heights}\nCYCL CALL\n"
    );
    assert_eq!(reach(&round), ([10.0, 0.0], [10.0, 20.0, 20.0]));
    let rectangle = format!(
        "{begin}CYCL DEF 251 P Q215=0 Q218=60 Q219=40 Q220=7 Q202=3 Q207=200 Q370=1.2 {heights}\nCYCL CALL\n"
    );
    assert_eq!(reach(&rectangle), ([25.0, 15.0], [10.0, 20.0, 20.0]));
    // Without the radius of the tool nothing is moved, which is said.
    let (moves, outcome) = run(Control::Heidenhain, &round.replace(" R+5", ""));
    assert_eq!(outcome.problems.iter().next().unwrap().code, "not-applied");
    assert_eq!(moves.len(), 1);
}

/// Cycle 241 goes with Q253 to the deepened starting point, and with Q208 out.
#[test]
fn single_lip_drilling_has_three_feeds() {
    let moves = sound(
        Control::Heidenhain,
        "TOOL CALL 1 Z S100\nL X+0 Y+0 Z+50 FMAX\nCYCL DEF 241 D Q200=2 Q201=-80 Q206=150 Q211=0 Q203=0 Q204=10 Q379=20 Q253=750 Q208=1000\nCYCL CALL\n",
    );
    let shown: Vec<_> =
        moves[1..].iter().map(|m| (m.kind, m.target[Axis::Z], m.feed.value)).collect();
    let linear = MoveKind::Linear;
    assert_eq!(
        shown[1..4],
        [(linear, -20.0, 750.0), (linear, -80.0, 150.0), (linear, 2.0, 1000.0)]
    );
    assert_eq!((shown[0].1, shown[4].1, shown.len()), (2.0, 10.0, 5));
}

/// Old cycles with the German words that such programs have.
#[test]
fn localised_words_of_old_cycles() {
    let moves = sound(
        Control::Heidenhain,
        "TOOL CALL 1 Z S100\nL X+0 Y+0 Z+2 FMAX\nCYCL DEF 1.0 TIEFBOHREN\nCYCL DEF 1.1 ABST 2\nCYCL DEF 1.2 TIEFE -10\n\
         CYCL DEF 1.3 ZUSTLG 10\nCYCL DEF 1.4 V.ZEIT 0.5\nCYCL DEF 1.5 F100\nCYCL CALL\nCYCL DEF 9.0 VERWEILZEIT\nCYCL DEF 9.1 V.ZEIT 3\n",
    );
    let dwells: Vec<_> = moves
        .iter()
        .filter_map(|m| if let MoveKind::Dwell { seconds } = m.kind { Some(seconds) } else { None })
        .collect();
    assert_eq!(dwells, [0.5, 3.0]);
    assert!(moves.iter().any(|m| m.target[Axis::Z] == -10.0));
}

/// The E word of printers moves nothing; elsewhere it is still an unknown word.
#[test]
fn the_extruder_is_an_axis_without_motion() {
    for control in [Control::LinuxCnc, Control::Fanuc] {
        let moves = sound(
            control,
            "G21\nG90\nG92 E0\nG1 X1. Y2. E0.5 F1000.\nG1 E-2. F1800.\nG0 X5. E1.\nM30\n",
        );
        assert_eq!(moves.len(), 2);
        let (_, outcome) = run(control, "G4 P1 E5\nM30\n");
        assert!(outcome.problems.has_errors());
    }
}

/// G76 against LinuxCNC's own interpreter (`oracles/linuxcnc_threads.py`).
#[test]
fn oracle_threads_of_linuxcnc() {
    let data = include_str!("data/linuxcnc-threads.txt");
    let mut count = 0;
    for case in data.split("program\n").skip(1) {
        let (text, theirs) = case.split_once("moves\n").unwrap();
        let unit = if text.contains("g20") { 25.4 } else { 1.0 };
        let ours = sound(Control::LinuxCnc, text);
        let lines: Vec<_> = theirs.lines().collect();
        assert_eq!(ours.len(), lines.len(), "{text}");
        for (m, line) in ours.iter().zip(lines) {
            let pitch = if let MoveKind::Thread { pitch_mm } = m.kind { pitch_mm } else { 0.0 };
            let own = [m.target[Axis::X], m.target[Axis::Z], pitch];
            let numbers = line.split(' ').map(|n| n.parse::<f64>().unwrap() * unit);
            for (own, their) in own.into_iter().zip(numbers) {
                assert!((own - their).abs() < 6e-5 * unit, "{text}{line}\n{own}");
            }
        }
        count += 1;
    }
    assert_eq!(count, 60);
    let (_, outcome) = run(Control::LinuxCnc, "G17 G0 X10 Z5\nG76 P1 Z-9 I-1 J0.1 K0.5\nM2\n");
    assert_eq!(outcome.problems.iter().next().unwrap().code, "bad-thread");
}

/// The pitch, the bottom and the spindle speed of the taps of a SINUMERIK program.
fn taps(block: &str) -> Vec<(f64, f64, f64)> {
    let program = Program::new("p", format!("{block}\nM30\n").into_bytes(), Control::Sinumerik840d);
    let (mut speed, mut taps) = (0.0, Vec::new());
    let outcome = interpret(&program, &NoLibrary, &Settings::default(), &mut |s| match s {
        Step::Event(Event::SpindleSpeed(s), _) => speed = s,
        Step::Move(Move { kind: MoveKind::RigidTap { pitch_mm }, target, .. }) => {
            taps.push((pitch_mm, target[Axis::Z], speed));
        }
        _ => {}
    });
    assert!(outcome.finished, "{block} {:?}", outcome.problems);
    taps
}

#[test]
fn tapping_has_the_speed_the_depth_and_the_pitch_of_its_cycle() {
    // 16 parameters: the last is _VARI, chip breaking, and not the mode of DP.
    assert_eq!(taps("CYCLE84(20,10,2,-15,,0,3,,1.5,0,500,600,3,0,0,1,2,1)"), [(1.5, -15.0, 500.0)]);
    assert_eq!(taps("S300 M3\nCYCLE84(20,10,2,-15,,0,3,6,,0)"), [(1.0, -15.0, 300.0)]);
    // _AMODE, the 24th: DP counts from RFP.
    assert_eq!(
        taps("CYCLE84(20,10,2,15,,0,3,,1,0,500,500,0,1,0,0,5,1.4,,,,1001,1,1)"),
        [(1.0, -5.0, 500.0)]
    );
    // With a compensating chuck: PIT, MPIT, or F / S.
    assert_eq!(taps("S400 M3\nCYCLE840(20,10,2,-15,,0,4,3,0,,1.25)"), [(1.25, -15.0, 400.0)]);
    assert_eq!(taps("S400 M3\nCYCLE840(20,10,2,-15,,0,4,3,0,8)"), [(1.25, -15.0, 400.0)]);
    assert_eq!(taps("S400 M3 F500\nCYCLE840(20,10,2,-15,,0,4,3,1)"), [(1.25, -15.0, 400.0)]);
}

#[test]
fn what_moves_nothing_is_no_missing_motion() {
    let programs = [
        (
            Control::Sinumerik840d,
            "GROUP_BEGIN(0,\"A\",0,0)\nG0 X1\nGROUP_END(0,0)\nWRITE(_E,\"F\",\"x\")\nM30\n",
        ),
        (
            Control::Heidenhain,
            "BEGIN PGM A MM\nBLK FORM CYLINDER Z R50 L100\nCYCL DEF 239 ASCERTAIN THE LOAD Q570=+0\nL X+1 FMAX\n\
             END PGM A MM\n",
        ),
        (
            Control::Fanuc,
            "POPEN\nDPRNT[X#1[53]*A[B]**Y#2[53]]\nPCLOS\nIF[1EQ1]GOTO5\nX9\nN5BPRNT[#1[2]]\nG0X1\nM30\n",
        ),
    ];
    for (control, text) in programs {
        assert_eq!(sound(control, text).len(), 1, "{control:?}");
    }
    for (control, text) in [
        (
            Control::Sinumerik840d,
            "G0 Z5\nSLOT1(10,0,1,-5,,2,30,8,0,0,20,0,45,100,100,2,3,0)\nM30\n",
        ),
        (
            Control::Heidenhain,
            "BEGIN PGM A MM\nCYCL DEF 256 STUD Q218=+10\nL X+1 FMAX M99\nEND PGM A MM\n",
        ),
    ] {
        let (_, outcome) = run(control, text);
        assert!(
            outcome.problems.iter().any(|p| leaves_motion_out(p.code)),
            "{:?}",
            outcome.problems
        );
    }
}

/// "If you program DEPTH = 0, the cycle will not be executed": neither a plunge nor a way to its start.
#[test]
fn law_klartext_cycles_of_depth_zero_do_not_move() {
    let heights = "Q200=2 Q201=0 Q203=0 Q204=20 Q206=50 Q239=+1 Q202=3 Q207=100 Q334=1 Q335=20 Q218=30 Q219=20 Q223=20";
    let milled = ["208", "251", "252", "253", "254", "262"];
    let drilled = ["200", "201", "202", "203", "205", "206", "207", "209", "240", "241"];
    let new = milled.iter().chain(&drilled).map(|n| format!("CYCL DEF {n} D {heights}\n"));
    let old = [1, 2, 17].map(|n| {
        format!("CYCL DEF {n}.0 D\nCYCL DEF {n}.1 SET UP 2\nCYCL DEF {n}.2 DEPTH 0\nCYCL DEF {n}.3 P 1\nCYCL DEF {n}.4 V 0\nCYCL DEF {n}.5 F 100\n")
    });
    for cycle in new.chain(old) {
        let text = format!(
            "TOOL DEF 1 L+0 R+3\nTOOL CALL 1 Z S100\nL X+0 Y+0 Z+50 FMAX\n{cycle}CYCL CALL\nL X+5 FMAX M99\nM30\n"
        );
        let (moves, outcome) = run(Control::Heidenhain, &text);
        let codes: Vec<_> = outcome.problems.iter().map(|d| d.code).collect();
        assert_eq!(codes, ["cycle-depth-zero"], "{text}");
        let wanted = [(true, [0.0, 0.0, 50.0]), (true, [5.0, 0.0, 50.0])];
        assert_eq!(path(&moves), wanted, "{text}");
        assert!(outcome.finished && !leaves_motion_out("cycle-depth-zero"));
    }
}

/// The way from the bottom to the set-up clearance has the feed Q208; between pecks it is rapid.
#[test]
fn law_klartext_retracts_with_its_feed() {
    let up = |cycle: u32, q208: &str| -> Vec<Option<f64>> {
        let text = format!(
            "TOOL CALL 1 Z S100\nL X+0 Y+0 Z+50 FMAX\nCYCL DEF {cycle} D Q200=2 Q201=-20 Q206=150 Q202=15 Q203=0 Q204=10 {q208}\nCYCL CALL\nM30\n"
        );
        let moves = sound(Control::Heidenhain, &text);
        let pairs = moves.windows(2).filter(|m| m[1].target[Axis::Z] > m[0].target[Axis::Z]);
        let feed = |m: &Move| (m.kind == MoveKind::Linear).then_some(m.feed.value);
        let up: Vec<_> = pairs.map(|m| (m[1].target[Axis::Z], feed(&m[1]))).collect();
        assert_eq!(up.last(), Some(&(10.0, None)), "{text}");
        assert!(up[..up.len() - 1].iter().all(|(z, _)| *z == 2.0), "{text} {up:?}");
        up[..up.len() - 1].iter().map(|(_, feed)| *feed).collect()
    };
    for pecked in [203, 205] {
        assert_eq!(up(pecked, "Q208=500"), [None, Some(500.0)]);
        assert_eq!(up(pecked, "Q208=0"), [None, Some(150.0)]);
    }
    for whole in [201, 241] {
        assert_eq!(up(whole, "Q208=500"), [Some(500.0)]);
        assert_eq!(up(whole, "Q208=0"), [Some(150.0)]);
    }
    for (cycle, pecks) in [(203, 1), (205, 1), (201, 0), (241, 0)] {
        for rapid in ["Q208=FMAX", "Q208=99999"] {
            assert_eq!(up(cycle, rapid), vec![None; pecks], "{cycle} {rapid}");
        }
    }
}
