//! What the words of a cutter-location file become: spindle, coolant, tool and cycle as the program runs them.

mod library;

use library::machine;
use library::paths::cl;
use std::collections::BTreeMap;
use trueaxis::nc::Control::{self, Fanuc, Haas, Heidenhain, LinuxCnc, Sinumerik840d};
use trueaxis::nc::moves::{Coolant, Event, MoveKind, SpindleDirection};
use trueaxis::nc::{NoLibrary, Program, Settings, Step, interpret};
use trueaxis::post::{PostOptions, Posted, post, verify};
use trueaxis::writer::TipWords;

const CONTROLS: [Control; 5] = [Fanuc, Haas, LinuxCnc, Sinumerik840d, Heidenhain];

fn options(control: Control) -> PostOptions {
    PostOptions { tip_words: Some(TipWords::Length), ..PostOptions::of(control) }
}

fn proved(text: &str, options: &PostOptions) -> (Posted, String) {
    let mill = machine("three-axis-mill");
    let (posted, problems) = post(&mill, &cl(text), options);
    let posted = posted.unwrap_or_else(|| panic!("{problems:?}\n{text}"));
    let proof = verify(&mill, &posted, options);
    let program = String::from_utf8_lossy(&posted.text).into_owned();
    assert!(proof.is_within(options), "{proof:?}\n{text}\n{program}");
    (posted, program)
}

/// What turns and flows while the tool cuts.
#[derive(Debug, Clone, Copy, PartialEq)]
struct State {
    tool: u32,
    turning: SpindleDirection,
    speed: f64,
    coolant: Coolant,
}

/// The state at the end of each cut, by its X; a change of tool stops spindle and coolant.
fn states(posted: &Posted, control: Control) -> BTreeMap<i64, State> {
    let program = Program::new("p", posted.text.clone(), control);
    let (turning, coolant) = (SpindleDirection::Stopped, Coolant::Off);
    let mut now = State { tool: 0, turning, speed: 0.0, coolant };
    let mut all = BTreeMap::new();
    interpret(&program, &NoLibrary, &Settings::default(), &mut |step| match step {
        Step::Event(Event::ToolChange(tool), _) => now = State { tool, turning, coolant, ..now },
        Step::Event(Event::Spindle(turning), _) => now.turning = turning,
        Step::Event(Event::SpindleSpeed(speed), _) => now.speed = speed,
        Step::Event(Event::Coolant(coolant), _) => now.coolant = coolant,
        Step::Move(m) if m.kind == MoveKind::Linear => {
            all.insert(m.target.0[0].round() as i64, now);
        }
        _ => {}
    });
    all
}

/// A cut to X.
fn cut(x: u32) -> String {
    format!("GOTO/{x},0,30\n")
}

/// Where spindle and coolant are started once, before the first tool, or again for each, or by ON: all cuts have them.
#[test]
fn law_a_change_of_tool_leaves_spindle_and_coolant_as_the_file_has_them() {
    let on = "SPINDL/RPM,1000,CCLW\nCOOLNT/MIST\n";
    let [a, b, c] = [10, 20, 30].map(cut);
    let head = "UNITS/MM\nFEDRAT/500,MMPM\nFROM/0,0,30\n";
    for (text, in_last) in [
        (format!("{head}{on}LOADTL/3\n{a}LOADTL/4\n{b}{c}"), true),
        (format!("{head}LOADTL/3\n{on}{a}LOADTL/4\n{on}{b}{c}"), true),
        (format!("{head}LOADTL/3\n{on}{a}LOADTL/4\nSPINDL/ON\nCOOLNT/ON\n{b}{c}"), true),
        (
            format!(
                "{head}LOADTL/3\n{on}{a}SPINDL/OFF\nLOADTL/4\n{on}{b}COOLNT/OFF\nSPINDL/OFF\n{c}"
            ),
            false,
        ),
    ] {
        for control in CONTROLS {
            let (posted, program) = proved(&text, &options(control));
            let states = states(&posted, control);
            let turning = SpindleDirection::CounterClockwise;
            let is = |tool| State { tool, turning, speed: 1000.0, coolant: Coolant::Mist };
            assert_eq!(
                [states[&10], states[&20]],
                [is(3), is(4)],
                "{control:?}\n{text}\n{program}"
            );
            let last = states[&30];
            assert_eq!(last == is(4), in_last, "{control:?} {last:?}\n{program}");
            // Not twice where the file says it itself.
            let starts = program.matches("M4").count() + usize::from(control == Haas);
            assert!(starts <= 4, "{program}");
        }
    }
}

#[test]
fn the_length_of_a_tool_is_that_of_its_offset() {
    let text = |load: &str| format!("UNITS/MM\n{load}\nFEDRAT/500\nGOTO/0,0,30\n{}", cut(10));
    for (control, word) in
        [(Fanuc, "G43 H7"), (Haas, "G43 H7"), (LinuxCnc, "G43 H7"), (Sinumerik840d, "D7")]
    {
        let (_, program) = proved(&text("LOADTL/5,OSETNO,7"), &options(control));
        assert!(program.contains(word), "{program}");
        let (_, program) = proved(&text("LOADTL/5,ADJUST,0"), &options(control));
        let usual = if control == Sinumerik840d { "D1" } else { "H5" };
        assert!(program.contains(usual) && !program.contains(word), "{program}");
    }
    let codes = |text: &str, options: &PostOptions| -> Vec<&'static str> {
        let (_, problems) = post(&machine("three-axis-mill"), &cl(text), options);
        problems.iter().map(|p| p.code).collect()
    };
    assert_eq!(codes(&text("LOADTL/5,OSETNO,7"), &options(Heidenhain)), ["not-applied"]);
    assert_eq!(codes(&text(""), &options(Fanuc)), ["no-tool"]);
    // Positions of axes contain the length, 120 mm on this machine.
    let without = PostOptions { tip_words: None, ..options(Fanuc) };
    assert_eq!(codes(&text("LOADTL/5,LENGTH,99"), &without), ["stated-tool-length"]);
    assert_eq!(codes(&text("LOADTL/5,LENGTH,120"), &without), [""; 0]);
    assert_eq!(codes(&text("LOADTL/5,LENGTH,99"), &options(Fanuc)), [""; 0]);
}

const HOLES: &str = "GOTO/10,0,0,0,0,1\nGOTO/20,0,2\nGOTO/30,5,0\nCYCLE/OFF\nFINI\n";

fn with_cycle(cycle: &str) -> String {
    format!("UNITS/MM\nLOADTL/1\nSPINDL/RPM,1200,CLW\nRAPID\nGOTO/0,0,40,0,0,1\n{cycle}\n{HOLES}")
}

/// The words of NX, Creo, CATIA and of APT without words give the same program.
#[test]
fn law_notations_of_a_cycle_give_the_same_program() {
    let all = "MMPM,100,RAPTO,3,RTRCTO";
    for (given, others) in [
        (
            format!("CYCLE/DRILL,FEDTO,20,{all},3"),
            vec![
                "CYCLE/DRILL,RAPTO,3.0,FEDTO,-20.0,RTRCTO,MANUAL,MMPM,100.0",
                "CYCLE/DRILL,20,100,MMPM,3",
            ],
        ),
        (
            format!("CYCLE/DEEP,FEDTO,20,{all},12,STEP,5"),
            vec!["CYCLE/DRILL,DEEP,STEP,5.0,CLEAR,3.0,FEDTO,-20.0,RETURN,12.0,MMPM,100.0"],
        ),
    ] {
        for control in CONTROLS {
            let (_, wanted) = proved(&with_cycle(&given), &options(control));
            for other in &others {
                assert_eq!(proved(&with_cycle(other), &options(control)).1, wanted, "{other}");
            }
        }
    }
}

/// The tool crosses at the height from which it came: 40 above the first hole, whatever the holes lie at.
#[test]
fn holes_are_left_to_where_the_tool_came_from() {
    let cycle = "CYCLE/DRILL,FEDTO,-10,RAPTO,3,RTRCTO,AUTO,MMPM,100";
    for control in CONTROLS {
        for lines_only in [false, true] {
            let options = PostOptions { lines_only, ..options(control) };
            let (posted, program) = proved(&with_cycle(cycle), &options);
            let text = posted.text.clone();
            let mut last = [0.0; 3];
            let mut crossed = Vec::new();
            interpret(
                &Program::new("p", text, control),
                &NoLibrary,
                &Settings::default(),
                &mut |step| {
                    if let Step::Move(m) = step {
                        let [x, y, z] = [0, 1, 2].map(|i| m.target.0[i]);
                        if (x - last[0]).abs() + (y - last[1]).abs() > 1.0 && last[0] > 5.0 {
                            crossed.push((last[2], z));
                        }
                        last = [x, y, z];
                    }
                },
            );
            // From hole to hole twice.
            let high = crossed.iter().filter(|(from, to)| *from >= 39.999 && *to >= 39.999);
            assert!(high.count() >= 2, "{control:?} {crossed:?}\n{program}");
        }
    }
}

/// A reamer leaves the hole with feed.
#[test]
fn a_reamer_leaves_the_hole_with_feed() {
    for control in CONTROLS {
        let cycle = "CYCLE/REAM,FEDTO,20,MMPM,100,RAPTO,3,RTRCTO,12";
        let (posted, program) = proved(&with_cycle(cycle), &options(control));
        let mut ups = Vec::new();
        let mut z = f64::NAN;
        let text = Program::new("p", posted.text.clone(), control);
        interpret(&text, &NoLibrary, &Settings::default(), &mut |step| {
            if let Step::Move(m) = step {
                let to = m.target.0[2];
                if m.kind == MoveKind::Linear && to > z + 1.0 {
                    ups.push((to - z).round() as i64);
                }
                z = to;
            }
        });
        assert_eq!(ups, [23, 23, 23], "{control:?}\n{program}");
    }
}

/// A circle that the next point does not lie on was a chord through its centre.
#[test]
fn a_circle_that_does_not_lead_to_its_point_is_refused() {
    let text = |x: &str| {
        format!(
            "UNITS/MM\nLOADTL/1\nFEDRAT/500\nGOTO/0,0,30\nCIRCLE/50,0,30,0,0,1,50\nGOTO/{x},0,30\n"
        )
    };
    let mill = machine("three-axis-mill");
    for x in ["100.1", "99.9", "150"] {
        let (posted, problems) = post(&mill, &cl(&text(x)), &options(Fanuc));
        let found: Vec<_> = problems.iter().map(|p| (p.place.line, p.code)).collect();
        assert!(posted.is_none() && found == [(6, "bad-circle")], "{x} {found:?}");
    }
    assert_eq!(proved(&text("100.004"), &options(Fanuc)).0.arcs, 1);
}

/// Circles of CATIA (TLON,GOFWD) and of Autodesk (ANGLE) are the arcs of `CIRCLE` and GOTO: the same programs, and proved.
#[test]
fn law_circles_are_the_same_in_every_notation() {
    let text = |arcs: &str| {
        format!("UNITS/MM\nLOADTL/1\nFEDRAT/500\nGOTO/10,0,5,0,0,1\n{arcs}GOTO/20,20,5\nFINI\n")
    };
    let usual = text(
        "CIRCLE/0,0,5,0,0,1,10\nGOTO/0,10,5\nCIRCLE/0,20,5,0,0,-1,10\nGOTO/10,20,5\n\
         CIRCLE/0,20,5,0,0,-1,10\nGOTO/10,20,5\n",
    );
    let of_catia = text(
        "AUTOPS\nINDIRV/0,1,0\nTLON,GOFWD/ (CIRCLE/ 0,0,5,$\n10),ON,(LINE/ 0,0,5,$\n0,10,5)\n\
         AUTOPS\nINDIRV/-1,0,0\nTLON,GOFWD/(CIRCLE/0,20,5,10),ON,2,INTOF,(LINE/0,20,5,10,20,5)\n\
         AUTOPS\nINDIRV/0,-1,0\nTLON,GOFWD/(CIRCLE/0,20,5,10),ON,2,INTOF,(LINE/0,20,5,10,20,5)\n",
    );
    let of_autodesk = text(
        "MOVARC/0, 0, 5, 0, 0, 1, 10, ANGLE, 90.\nGOTO/0,10,5\nMOVARC/0,20,5,0,0,-1,10,ANGLE,270\nGOTO/10,20,5\n\
         MOVARC/0,20,5,0,0,-1,10,ANGLE,360\nGOTO/10,20,5\n",
    );
    for control in CONTROLS {
        let (posted, program) = proved(&usual, &options(control));
        assert_eq!(posted.arcs, 3, "{control:?}");
        for other in [&of_catia, &of_autodesk] {
            assert_eq!(proved(other, &options(control)).1, program, "{control:?}");
        }
    }
    // Two turns and a quarter down a helix: no block has more than one, so they are lines.
    let helix = text("MOVARC/0,0,5,0,0,1,10,ANGLE,810\nGOTO/0,10,2\n");
    let (posted, _) = proved(&helix, &options(Sinumerik840d));
    assert!(posted.arcs == 0 && posted.blocks > 100, "{} {}", posted.arcs, posted.blocks);
    let wrong = text("MOVARC/0,0,5,0,0,-1,10,ANGLE,90\nGOTO/0,10,5\n");
    let (posted, problems) = post(&machine("three-axis-mill"), &cl(&wrong), &options(Fanuc));
    let said = problems.iter().find(|p| p.code == "bad-circle").map(|p| p.message.clone());
    assert!(posted.is_none() && said.is_some_and(|s| s.contains("270.0000 deg")), "{problems:?}");
}

/// A feed per revolution needs the speed that turns, not the one before a surface speed.
#[test]
fn a_surface_speed_leaves_no_feed_per_revolution() {
    let text = |surface: &str| {
        format!(
            "UNITS/MM\nLOADTL/1\nSPINDL/RPM,1000,CLW\n{surface}FEDRAT/0.2,MMPR\nGOTO/0,0,30\n{}",
            cut(10)
        )
    };
    let (_, program) = proved(&text(""), &options(Fanuc));
    assert!(program.contains("F200."), "{program}");
    let (posted, problems) =
        post(&machine("three-axis-mill"), &cl(&text("SPINDL/120,SFM,CLW\n")), &options(Fanuc));
    let codes: Vec<_> = problems.iter().map(|p| p.code).collect();
    assert!(posted.is_none() && codes == ["no-feed"], "{codes:?}");
}

fn with_tap(spindle: &str, cycle: &str) -> String {
    format!(
        "UNITS/MM\nLOADTL/1\nSPINDL/{spindle}\nRAPID\nGOTO/0,0,40,0,0,1\n{cycle}\n\
         GOTO/10,0,0,0,0,1\nGOTO/20,0,2\nGOTO/30,5,2\nCYCLE/OFF\nFEDRAT/300,MMPM\nGOTO/50,0,40\nGOTO/60,0,40\nFINI\n"
    )
}

const M8: &str = "CYCLE/TAP,FEDTO,20,MMPR,1.25,RAPTO,3,RTRCTO,12";

/// What a control writes for three threads, 1.25 mm at 400 1/min: 500 mm/min.
#[test]
fn threads_are_tapped_by_the_cycle_of_the_control() {
    for (control, right, left) in [
        (
            Fanuc,
            vec!["M29 S400\nG94 G98 G84 X10. Y0. Z-20. R3. F500."],
            vec!["M29 S400\nG94 G98 G74 X10. Y0. Z-20. R3. F500."],
        ),
        (Haas, vec!["\nG94 G98 G84 X10. Y0. Z-20. R3. F500."], vec!["G98 G74 X10."]),
        (
            LinuxCnc,
            vec!["M3\n", "G0 Z3\nG33.1 Z-20 K1.25\nG0 Z12"],
            vec!["M4\n", "G33.1 Z-20 K1.25"],
        ),
        (
            Sinumerik840d,
            vec!["CYCLE84(12,0,3,-20,,,3,,1.25,0,400,400)"],
            vec!["CYCLE84(12,0,3,-20,,,4,,-1.25,0,400,400)"],
        ),
        (
            Heidenhain,
            vec!["CYCL DEF 207 RIGID TAPPING NEW ~", "Q201=-20 ;", "Q239=+1.25 ;", "M99"],
            vec!["CYCL DEF 207 RIGID TAPPING NEW ~", "Q239=-1.25 ;"],
        ),
    ] {
        for (spindle, words, turning) in [
            ("RPM,400,CLW", right, SpindleDirection::Clockwise),
            ("RPM,400,CCLW", left, SpindleDirection::CounterClockwise),
        ] {
            let (posted, program) = proved(&with_tap(spindle, M8), &options(control));
            assert_eq!([posted.holes(), posted.threads()], [3, 3], "{control:?}\n{program}");
            for word in words {
                assert!(program.contains(word), "{control:?} {word}\n{program}");
            }
            // The cut after them has the spindle of the file.
            let last = states(&posted, control)[&60];
            assert_eq!((last.turning, last.speed), (turning, 400.0), "{control:?}\n{program}");
        }
        let (posted, _) = proved(&with_tap("RPM,400,CLW", M8), &options(control));
        for (from, to) in [
            ("G84", "G74"),
            ("G84", "G81"),
            ("F500.", "F510."),
            ("M29 S400", "M29 S410"),
            ("CYCLE84(12,0,3,-20,,,3,,1.25", "CYCLE84(12,0,3,-20,,,3,,-1.25"),
            ("1.25,0,400,400", "1.25,0,410,410"),
            ("Q239=+1.25", "Q239=-1.25"),
            ("Q239=+1.25", "Q239=+1.27"),
            ("K1.25", "K1.27"),
            ("S400 M3", "S400 M4"),
            ("CYCL DEF 207", "CYCL DEF 200"),
        ] {
            let text = String::from_utf8_lossy(&posted.text).into_owned();
            let counts = !matches!((control, from), (Fanuc | Haas | Sinumerik840d, "S400 M3"));
            if text.contains(from) && counts {
                let mut changed = posted.clone();
                changed.text = text.replace(from, to).into_bytes();
                let proof = verify(&machine("three-axis-mill"), &changed, &options(control));
                assert!(!proof.is_within(&options(control)), "{control:?} {from} {to}");
            }
        }
    }
}

/// A pitch, or a feed and a speed, or FEDRAT per revolution, are the same thread; inches too.
#[test]
fn law_statements_of_a_pitch_give_the_same_thread() {
    for control in CONTROLS {
        let (_, wanted) = proved(&with_tap("RPM,400,CLW", M8), &options(control));
        for cycle in [
            "CYCLE/TAP,FEDTO,20,MMPM,500,RAPTO,3,RTRCTO,12",
            "CYCLE/RIGID,DEPTH,20,PITCH,1.25,CLEAR,3,RETURN,12",
            "CYCLE/TAP,FEDTO,20,MMPM,501,MMPR,1.25,RAPTO,3,RTRCTO,12",
            "FEDRAT/1.25,MMPR\nCYCLE/TAP,FEDTO,20,RAPTO,3,RTRCTO,12",
        ] {
            assert_eq!(
                proved(&with_tap("RPM,400,CLW", cycle), &options(control)).1,
                wanted,
                "{cycle}"
            );
        }
        let inches = "CYCLE/TAP,FEDTO,20,TPI,20,RAPTO,3,RTRCTO,12";
        let (_, program) = proved(&with_tap("RPM,400,CLW", inches), &options(control));
        let word = match control {
            Fanuc | Haas => "F508.",
            LinuxCnc => "K1.27\n",
            Sinumerik840d => ",,1.27,",
            Heidenhain => "Q239=+1.27 ",
        };
        assert!(program.contains(word), "{program}");
    }
}

#[test]
fn threads_that_the_file_does_not_say_are_refused() {
    let codes = |text: &str, options: &PostOptions| -> Vec<(usize, &'static str)> {
        let (posted, problems) = post(&machine("three-axis-mill"), &cl(text), options);
        assert_eq!(posted.is_none(), problems.has_errors(), "{text}");
        problems.iter().map(|p| (p.place.line, p.code)).collect()
    };
    let on = "RPM,400,CLW";
    let none = "CYCLE/TAP,FEDTO,20,RAPTO,3";
    for (spindle, cycle, found) in [
        (on, none, vec![(7, "no-pitch")]),
        (on, "CYCLE/TAP,FEDTO,20,MMPM,50000,RAPTO,3", vec![(7, "no-pitch")]),
        (on, "CYCLE/TAP,FEDTO,20,MMPM,600,MMPR,1.25,RAPTO,3", vec![(7, "contradicting-pitch")]),
        ("OFF", M8, vec![(7, "tap-without-spindle")]),
        ("CLW", M8, vec![(7, "tap-without-spindle")]),
        (on, "FEDRAT/500,MMPM\nCYCLE/TAP,FEDTO,20,RAPTO,3", vec![(8, "pitch-of-feed")]),
    ] {
        for control in CONTROLS {
            assert_eq!(codes(&with_tap(spindle, cycle), &options(control)), found, "{cycle}");
        }
    }
    // Lines cannot follow the spindle.
    for control in CONTROLS {
        let lines = PostOptions { lines_only: true, ..options(control) };
        assert_eq!(codes(&with_tap(on, M8), &lines), [(7, "thread-needs-cycle")], "{control:?}");
    }
    let off = PostOptions { tip_words: None, ..options(LinuxCnc) };
    assert_eq!(codes(&with_tap(on, M8), &off), [(7, "thread-needs-cycle")]);
}
