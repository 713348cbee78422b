//! What a word of a cutter-location file means in the forms that systems write, and what is refused.

use trueaxis_cl::{ClCycle, ClFile, ClTool, Reading, Word};
use trueaxis_input::Severity;
use trueaxis_nc::moves::{Coolant, Feed, FeedMode, SpindleDirection};

const HEAD: &str = "UNITS/MM\nSPINDL/RPM,1200,CLW\nFEDRAT/500,MMPM\nGOTO/0,0,30,0,0,1\n";

/// A file that ends as it should.
fn read(text: &str) -> (Vec<Word>, Vec<(usize, &'static str)>) {
    let text = format!("{}\nFINI\n", text.trim_end()).into_bytes();
    let (file, problems) = ClFile::read("a.cls", text, &Reading::default());
    let found = problems.iter().map(|p| (p.place.line, p.code)).collect();
    (file.records().iter().map(|r| r.word.clone()).collect(), found)
}

/// The word of a line after the head, and the codes of what is said of it.
fn word(line: &str) -> (Word, Vec<&'static str>) {
    let (words, found) = read(&format!("{HEAD}{line}\n"));
    (words[4].clone(), found.into_iter().map(|(_, code)| code).collect())
}

fn refused(line: &str, code: &str) {
    assert_eq!(word(line).1, [code], "{line}");
}

/// The same hole in the words of every system: 20 deep, from 3 above, at 100 mm/min.
#[test]
fn law_a_hole_is_the_same_in_every_notation() {
    let feed = Some(Feed { mode: FeedMode::PerMinute, value: 100.0 });
    let hole = ClCycle {
        depth_mm: 20.0,
        clearance_mm: 3.0,
        retract_mm: 3.0,
        to_begin: false,
        pecks_mm: None,
        dwell_s: 0.0,
        feeds_out: false,
        feed,
        tap: None,
    };
    for line in [
        "CYCLE/DRILL,FEDTO,20,MMPM,100,RAPTO,3",
        "CYCLE/DRILL,RAPTO,3.0,FEDTO,-20.0,MMPM,100",
        "CYCLE/DRILL,DEPTH,20,MMPM,100,CLEAR,3",
        "CYCLE/DRILL,20,100,MMPM,3",
        "CYCLE/DRILL,20,MMPM,100,3",
        "CYCLE/DRILL,FEDTO,20,100,MMPM,RAPTO,3",
        "cycle / drill , fedto , 20 , mmpm , 100 , rapto , 3 , rtrcto , 3 , manual",
        "CYCLE/DRILL,FEDTO,20,MMPM,100, $\n RAPTO,3,RETURN,0",
        "CYCLE/DRILL,FEDTO,20,PERMIN,100,RAPTO,3,DWELL,OFF",
    ] {
        assert_eq!(word(line), (Word::Cycle(hole), vec![]), "{line}");
    }
    let one = |line: &str, is: ClCycle| assert_eq!(word(line), (Word::Cycle(is), vec![]), "{line}");
    let all = "FEDTO,20,MMPM,100,RAPTO,3";
    one(&format!("CYCLE/DRILL,{all},RTRCTO,AUTO"), ClCycle { to_begin: true, ..hole });
    one(&format!("CYCLE/DRILL,{all},RETURN,12"), ClCycle { retract_mm: 12.0, ..hole });
    one(&format!("CYCLE/REAM,{all}"), ClCycle { feeds_out: true, ..hole });
    // 2 turns at 1200 1/min are 0.1 s.
    for dwell in ["DWELL,0.1", "DWELL,2,REV", "DWELL,REV,2"] {
        one(&format!("CYCLE/DRILL,{all},{dwell}"), ClCycle { dwell_s: 0.1, ..hole });
    }
    let pecks = ClCycle { pecks_mm: Some([5.0, 5.0]), ..hole };
    one(&format!("CYCLE/DEEP,{all},STEP,5"), pecks);
    one(&format!("CYCLE/DRILL,DEEP,STEP,5,{all}"), pecks);
    let (words, found) = read(&format!("{HEAD}CYCLE/DRILL,{all}\nCYCLE/OFF\nCYCLE/ON\n"));
    assert!(words[4] == words[6] && found.is_empty());
}

#[test]
fn what_a_cycle_does_not_say_is_not_guessed() {
    for line in [
        "CYCLE/DRILL",
        "CYCLE/ON",
        "CYCLE/20,MMPM,100",
        "CYCLE/DRILL,20,3",
        "CYCLE/DRILL,20,100,MMPM,3,4",
        "CYCLE/DRILL,20,100,MMPM,3,RAPTO,4",
        "CYCLE/DRILL,FEDTO,20,RAPTO,-3",
        "CYCLE/DRILL,FEDTO,20,CLEAR,3,RETURN,-5",
        "CYCLE/DRILL,FEDTO,20,CLEAR,3,RETURN,1",
        "CYCLE/TAP,FEDTO,20,PITCH,1,CLEAR,3,RETURN,-5",
        "CYCLE/TAP,FEDTO,20,PITCH,1,RAPTO,3,RTRCTO,-30",
        "CYCLE/DRILL,FEDTO,20,RTRCTO,-30",
        "CYCLE/TAP,FEDTO,0,PITCH,1,RAPTO,3",
    ] {
        refused(line, "bad-cycle");
    }
    refused("CYCLE/TAP,FEDTO,20,PITCH,1", "no-clearance");
    refused("CYCLE/DRILL,FEDTO,20,RTRCTO,30", "no-clearance");
    refused("CYCLE/DRILL,FEDTO,MMPM,100", "bad-number");
    refused("CYCLE/DRILL,FEDTO,20,MMPM,0", "bad-feed");
    refused("CYCLE/DRILL,FEDTO,20,DWELL,-2", "bad-delay");
    refused("CYCLE/THREAD,20,1", "motion-not-read");
    for line in ["CYCLE/DRILL,FEDTO,20,MMPT,0.1,RAPTO,3", "CYCLE/BRKCHP,FEDTO,20,STEP,5,RAPTO,3"] {
        refused(line, "cycle-not-applied");
    }
}

/// An M8 thread, 20 deep, from 3 above, in the words of every system; 20 threads per inch are 1.27 mm.
#[test]
fn law_a_thread_is_the_same_in_every_notation() {
    let tapped = |line: &str| match word(line) {
        (Word::Cycle(cycle), found) => {
            let heights = [cycle.depth_mm, cycle.clearance_mm, cycle.retract_mm];
            assert!(
                cycle.feeds_out && heights == [20.0, 3.0, 12.0] && cycle.dwell_s == 0.0,
                "{line}"
            );
            (cycle.tap.expect("a thread").pitch_mm, cycle.feed.map(|f| f.value), found)
        }
        other => panic!("{line} {other:?}"),
    };
    for kind in ["TAP", "RTAP", "RIGID", "tap"] {
        for pitch in ["MMPR,1.25", "1.25,MMPR", "PERREV,1.25", "PITCH,1.25"] {
            let line = format!("CYCLE/{kind},FEDTO,20,{pitch},RAPTO,3,RTRCTO,12");
            let (found, _, said) = tapped(&line);
            assert_eq!((found, said), (Some(1.25), vec![]), "{line}");
        }
    }
    let (pitch, _, _) = tapped("CYCLE/TAP,DEPTH,20,TPI,20,CLEAR,3,RETURN,12");
    assert_eq!(pitch, Some(1.27));
    // Without a pitch it is that of feed and speed where the hole is.
    let of_feed = tapped("CYCLE/TAP,FEDTO,20,MMPM,1500,RAPTO,3,RTRCTO,12");
    assert_eq!(of_feed, (None, Some(1500.0), vec![]));
    let both = tapped("CYCLE/TAP,FEDTO,20,MMPM,1500,MMPR,1.25,RAPTO,3,RTRCTO,12");
    assert_eq!(both, (Some(1.25), Some(1500.0), vec![]));
    // The spindle reverses at the bottom: nothing waits there.
    let waits = tapped("CYCLE/TAP,FEDTO,20,MMPR,1.25,RAPTO,3,RTRCTO,12,DWELL,0.5");
    assert_eq!(waits.2, ["cycle-not-applied"]);
    for (words, code) in [
        ("MMPR,1.25,PITCH,1.5", "contradicting-pitch"),
        ("PITCH,1.25,TPI,16", "contradicting-pitch"),
        ("PITCH,0", "bad-cycle"),
        ("PITCH,-1", "bad-cycle"),
        ("PITCH,30", "bad-cycle"),
        ("TPI,0", "bad-cycle"),
        ("MMPR,1.25,STEP,5", "bad-cycle"),
        ("PITCH,MMPR,1.25", "bad-number"),
    ] {
        refused(&format!("CYCLE/TAP,FEDTO,20,{words},RAPTO,3"), code);
    }
    refused("CYCLE/DRILL,FEDTO,20,MMPM,100,RAPTO,3,PITCH,1.25", "cycle-not-applied");
}

#[test]
fn a_spindle_turns_as_the_file_says_or_not_at_all() {
    use SpindleDirection::{Clockwise, CounterClockwise, Stopped};
    for (line, turning, speed) in [
        ("SPINDL/RPM,1000,CLW", Clockwise, Some(1000.0)),
        ("SPINDL/1000,CCLW", CounterClockwise, Some(1000.0)),
        ("SPINDL/ON", Clockwise, None),
        ("SPINDL/OFF", Stopped, None),
        ("SPINDL/0", Stopped, None),
    ] {
        assert_eq!(word(line), (Word::Spindle(turning, speed), vec![]), "{line}");
    }
    for line in ["SPINDL/LOCK", "SPINDL/ORIENT,90", "SPINDL/NEUTRL"] {
        assert_eq!(word(line), (Word::Spindle(Stopped, None), vec!["not-applied"]), "{line}");
    }
    for line in ["SPINDL/MAXRPM,100", "SPINDL/RANGE,2", "SPINDL/HIGH"] {
        assert_eq!(word(line), (Word::Noted, vec!["not-applied"]), "{line}");
    }
    for line in ["SPINDL/-500", "SPINDL/RPM,100,REVERS", "SPINDL/RPM,100,200"] {
        refused(line, "bad-spindle");
    }
    // A surface speed leaves no speed that turns are counted by.
    let surface = Word::Spindle(Clockwise, Some(0.0));
    assert_eq!(word("SPINDL/120,SFM,CLW"), (surface, vec!["surface-speed"]));
    let (_, found) = read(&format!("{HEAD}SPINDL/120,SMM\nDELAY/2,REV\n"));
    assert_eq!(found, [(5, "surface-speed"), (6, "bad-delay")]);
    // ON and a speed alone keep the direction.
    let (words, found) = read(&format!("{HEAD}SPINDL/CCLW\nSPINDL/OFF\nSPINDL/ON\nSPINDL/900\n"));
    assert_eq!(words[6], Word::Spindle(CounterClockwise, None));
    assert_eq!(words[7], Word::Spindle(CounterClockwise, Some(900.0)));
    assert_eq!(found, [(7, "direction-kept")]);
}

#[test]
fn units_of_feeds_are_known_or_refused() {
    for (line, value) in
        [("FEDRAT/250,MMPM", 250.0), ("FEDRAT/MMPM,250", 250.0), ("FEDRAT/IPM,2", 50.8)]
    {
        let feed = Feed { mode: FeedMode::PerMinute, value };
        assert_eq!(word(line), (Word::Feed(feed), vec![]), "{line}");
    }
    for line in [
        "FEDRAT/5,MPM",
        "FEDRAT/0.1,MMPT",
        "FEDRAT/20,FPM",
        "FEDRAT/0.2,PERTOOTH",
        "FEDRAT/1E7,MMPM",
        "FEDRAT/5,6",
        "FEDRAT/0",
        "FEDRAT/INVERS,3",
    ] {
        refused(line, "bad-feed");
    }
    for line in ["DELAY/2,MIN", "DELAY/-1", "DELAY/1e9", "DELAY/"] {
        refused(line, "bad-delay");
    }
    assert_eq!(word("DELAY/10,REV"), (Word::Delay(0.5), vec![]));
}

#[test]
fn coolant_and_tools_are_those_of_the_file() {
    for (line, coolant) in [
        ("COOLNT/ON", Coolant::Flood),
        ("COOLNT/FLOOD", Coolant::Flood),
        ("COOLNT/MIST", Coolant::Mist),
        ("COOLNT/FLOOD,OFF", Coolant::Off),
    ] {
        assert_eq!(word(line), (Word::Coolant(coolant), vec![]), "{line}");
    }
    assert_eq!(word("COOLNT/FLOOD,HIGH"), (Word::Coolant(Coolant::Flood), vec!["not-applied"]));
    for line in ["COOLNT/AIR", "COOLNT/THRU", "COOLNT/FOO", "COOLNT/"] {
        assert_eq!(word(line), (Word::Noted, vec!["not-applied"]), "{line}");
    }
    let tool = ClTool { number: 5, ..ClTool::default() };
    for (line, is) in [
        ("LOADTL/5", tool),
        ("LOAD/TOOL,5,ADJUST,0", tool),
        ("TURRET/5", tool),
        ("LOADTL/5,5", tool),
        ("LOADTL/5,LENGTH,99,OSETNO,7", ClTool { offset: Some(7), length_mm: Some(99.0), ..tool }),
        ("LOADTL/5,ADJUST,7,MILL", ClTool { offset: Some(7), ..tool }),
    ] {
        assert_eq!(word(line), (Word::Tool(is), vec![]), "{line}");
    }
    assert_eq!(word("LOADTL/5,1"), (Word::Tool(tool), vec!["not-applied"]));
    for line in ["LOADTL/1.5", "LOADTL/-1", "LOADTL/5,OSETNO,1.5"] {
        refused(line, "bad-tool");
    }
    for line in ["AUXFUN/42", "PREFUN/61", "OPSKIP/ON", "CLAMP/ON", "INSERT/M98 P1000", "RETRCT"] {
        assert_eq!(word(line).1, ["not-applied"], "{line}");
    }
    assert_eq!(word("TOOLNO/4").1, ["no-tool"]);
}

/// NX writes the vector of a point where it changes; GODLTA may have one of its own.
#[test]
fn law_a_tool_axis_holds_until_another_one() {
    let axes = |text: &str| -> (Vec<[f64; 3]>, Vec<(usize, &'static str)>) {
        let text = format!("{text}FINI\n").into_bytes();
        let (file, problems) = ClFile::read("a", text, &Reading::default());
        let found = problems.iter().map(|p| (p.place.line, p.code)).collect();
        (file.points().map(|(_, p)| p.axis).collect(), found)
    };
    let (tilted, up) = ([0.0, 0.6, 0.8], [0.0, 0.0, 1.0]);
    let all = "UNITS/MM\nGOTO/1,0,0,0,0.6,0.8\nGOTO/2,0,0,0,0.6,0.8\nGOTO/2,3,4,0,0.6,0.8\nGOTO/2,3,5,0,0,1\n";
    let wanted = axes(all).0;
    assert_eq!(wanted, [tilted, tilted, tilted, up]);
    let where_it_changes =
        "UNITS/MM\nGOTO/1,0,0,0,0.6,0.8\nGOTO/2,0,0\nGODLTA/5\nGODLTA/0,0,1,0,0,1\n";
    assert_eq!(axes(where_it_changes), (wanted.clone(), vec![(3, "tool-axis-kept")]));
    let stated = "UNITS/MM\nTLAXIS/0,0.6,0.8\nGOTO/1,0,0\nGOTO/2,0,0\nGODLTA/5\nTLAXIS/0,0,1\nGODLTA/0,0,1\n";
    assert_eq!(axes(stated), (wanted, vec![]));
    let off = "UNITS/MM\nMULTAX/ON\nGOTO/1,0,0,0,0.6,0.8\nMULTAX/OFF\nGOTO/2,0,0\n";
    assert_eq!(axes(off), (vec![tilted, up], vec![(5, "no-tool-axis")]));
    refused("GODLTA/0,0,-5,77", "bad-point");
}

#[test]
fn what_stands_in_the_wrong_place_is_said() {
    let said = |text: &str, code: &str, line: usize| {
        assert_eq!(read(text).1, [(line, code)], "{text}");
    };
    said("GOTO/1,2,3,0,0,1\nUNITS/INCHES\nGOTO/2,2,3\n", "unit-changes", 2);
    said("UNITS/MM\nGOTO/1,2,3,0,0,1\nUNITS/INCHES\nGOTO/2,2,3\n", "unit-changes", 3);
    said("UNITS/MM\nGOTO/1,2,3,0,0,1\nFINI\nGOTO/2,2,3\nGOTO/3,2,3\n", "goes-on-after-end", 4);
    said("UNITS/MM\nGOTO/1,2,3,0,0,1\nN10 GOTO/2,2,3\n", "unknown-motion", 3);
    let (words, _) = read(&format!("{HEAD}RAPID\nRAPID/OFF\nGOTO/1,0,0\n"));
    assert!(matches!(words[6], Word::Goto(point) if !point.rapid));
    let frame = |x: i32| format!("MSYS/{x},0,0,1,0,0,0,1,0\n");
    let same = format!("UNITS/MM\n{0}GOTO/1,2,3,0,0,1\nEND-OF-PATH\n{0}GOTO/1,2,4\n", frame(0));
    assert_eq!(read(&same).1, []);
    let other = same.replacen(&frame(0), &frame(50), 1);
    said(&other, "other-coordinate-system", 5);
}

/// A circle leads from the point before it to the one after it.
#[test]
fn circles_state_the_radius_of_their_points() {
    let circle =
        |line: &str| read(&format!("UNITS/MM\nGOTO/10,0,0,0,0,1\n{line}\nGOTO/0,10,0\n")).1;
    for line in [
        "CIRCLE/0,0,5,0,0,1",
        "CIRCLE/0,0,5,0,0,1,10",
        "CIRCLE/0,0,0,0,0,1,10.01",
        // NX: tolerances and the cutter.
        "CIRCLE/0.0,0.0,0.0,0.0,0.0,1.0,10.0,0.06,0.5,10.0,0.0",
    ] {
        assert_eq!(circle(line), [], "{line}");
    }
    for line in ["CIRCLE/0,0,0,0,0,1,500", "CIRCLE/0,0,0,0,0,1,10.1", "CIRCLE/0,0,0,0,0,1,10,1"] {
        assert_eq!(circle(line), [(3, "bad-circle")], "{line}");
    }
}

/// Words that move the points are applied or refused; what changes neither motion nor spindle nor coolant is a note.
#[test]
fn words_that_move_the_points_are_applied_or_refused() {
    for line in [
        "TRACUT/1,0,0,5,0,1,0,0,0,0,1,0",
        "TRACUT/M1",
        "ORIGIN/1,0,0",
        "COPY/1,SAME,3",
        "ROTABL/90",
        "ROTHED/ATANGL,30",
        "ROTATE/TABLE,90",
    ] {
        refused(line, "motion-not-read");
    }
    for line in ["TRACUT/NOMORE", "ORIGIN/0,0,0", "ROTABL/OFF", "COPY/OFF"] {
        assert_eq!(word(line), (Word::Noted, vec![]), "{line}");
    }
    for line in ["TRANS/1,2", "TRANS/1,2,3,4"] {
        refused(line, "bad-point");
    }
    refused("TRANS/1e9,0,0", "too-far");
    let severities = |line: &str| -> Vec<Severity> {
        let text = format!("{HEAD}{line}\nFINI\n").into_bytes();
        let (_, problems) = ClFile::read("a", text, &Reading::default());
        problems.iter().map(|p| p.severity).collect()
    };
    for line in ["GOHOME", "CLAMP/ON", "LOCKX/C"] {
        assert_eq!(severities(line), [Severity::Note], "{line}");
    }
    for line in ["CUTCOM/LEFT", "AUXFUN/8", "RETRCT", "INSERT/M4", "AIR/ON", "CALSUB/1"] {
        assert_eq!(severities(line), [Severity::Warning], "{line}");
    }
}

/// TRANS/x,y,z is added to all points after it, in every form of them, and taken away where the file is rewritten.
#[test]
fn trans_displaces_points_and_circles() {
    let text = "UNITS/INCHES\nFEDRAT/9\nGOTO/1,0,0,0,0,1\nTRANS/1,2,3\nGOTO/1,0,0,0,0,1\n\
                CIRCLE/0,0,0,0,0,1,1\nGOTO/0,1,0\nGODLTA/0,0,1\nTRANS/OFF\nGOTO/1,0,0,0,0,1\nFINI\n";
    let (file, problems) = ClFile::read("a", text.as_bytes().to_vec(), &Reading::default());
    assert!(problems.iter().next().is_none(), "{problems:?}");
    let inches = |p: [f64; 3]| p.map(|v| (v / 25.4 * 1e9).round() / 1e9);
    let tips: Vec<_> = file.points().map(|(_, p)| inches(p.tip_mm)).collect();
    let moved = [[2.0, 2.0, 3.0], [1.0, 3.0, 3.0], [1.0, 3.0, 4.0]];
    assert_eq!(tips, [&[[1.0, 0.0, 0.0]][..], &moved, &[[1.0, 0.0, 0.0]]].concat());
    let centre = file.records().iter().find_map(|r| match &r.word {
        Word::Circle(circle) => Some(inches(circle.center_mm)),
        _ => None,
    });
    assert_eq!(centre, Some([1.0, 2.0, 3.0]));
    let again = ClFile::read("a", file.rewritten(), &Reading::default()).0;
    let again: Vec<_> = again.points().map(|(_, p)| inches(p.tip_mm)).collect();
    assert_eq!(again, tips);
    let said = |text: &str| read(&format!("{HEAD}{text}")).1;
    assert_eq!(said("TRANS/1,0,0\nTRANS/2,0,0\n"), [(6, "motion-not-read")]);
    assert_eq!(said("TRANS/1,0,0\nTRANS/0,0,0\nTRANS/2,0,0\nGOTO/1,1,1\n"), []);
    assert_eq!(said("TRANS/1,0,0\nGODLTA/1\n"), [(6, "no-place")]);
}

/// CATIA and Creo: a quarter counter-clockwise and one clockwise, three quarters to the second place, and a full turn.
#[test]
fn law_circles_up_to_a_line_end_where_it_says() {
    let arc = |direction: &str, circle: &str, rest: &str| {
        let text = format!(
            "UNITS/MM\nFEDRAT/500\nGOTO/10,0,5,0,0,1\nAUTOPS\nINDIRV/{direction}\nTLON,GOFWD/ (CIRCLE/ {circle},$\n 10.),ON,{rest}\n"
        );
        let (words, found) = read(&text);
        let codes: Vec<_> = found.into_iter().map(|(_, code)| code).collect();
        match &words[5] {
            Word::Arc(circle, point) => {
                let turn = circle.turn_rad.expect("a turn").to_degrees();
                assert_eq!(circle.center_mm, [0.0, 0.0, 5.0]);
                Ok((circle.normal[2], (turn * 1e3).round() / 1e3, point.tip_mm))
            }
            _ => Err(codes),
        }
    };
    let to = |x: &str| format!("(LINE/ 0,0,5,$\n {x})");
    let second = |x: &str| format!("2,INTOF,$\n{}", to(x));
    let (left, right, centre) = ("0.0,1.0,0.0", "0,-1,0", "0.,0.,5.");
    assert_eq!(arc(left, centre, &to("0,10,5")), Ok((1.0, 90.0, [0.0, 10.0, 5.0])));
    assert_eq!(arc(right, centre, &to("0,-10,5")), Ok((-1.0, 90.0, [0.0, -10.0, 5.0])));
    assert_eq!(arc(left, centre, &to("-10,0,5")), Ok((1.0, 180.0, [-10.0, 0.0, 5.0])));
    assert_eq!(arc(left, centre, &second("0,-10,5")), Ok((1.0, 270.0, [0.0, -10.0, 5.0])));
    assert_eq!(arc(left, centre, &second("10,0,5")), Ok((1.0, 360.0, [10.0, 0.0, 5.0])));
    for (direction, circle, rest) in [
        // Neither a tangent, nor one in the plane.
        ("1,0,0", centre, to("0,10,5")),
        ("0,1,0.1", centre, to("0,10,5")),
        ("0,0,0", centre, to("0,10,5")),
        // The line is reached before, is reached but once, or not at all.
        (left, centre, to("0,-10,5")),
        (left, centre, to("10,0,5")),
        (left, centre, second("0,10,5")),
        (left, centre, to("0,9.9,5")),
        (left, "0,0.2,5", to("0,10,5")),
        // A helix, another plane, a line from elsewhere.
        (left, centre, to("0,10,4")),
        (left, "0,0,4", to("0,10,5")),
        (left, centre, "(LINE/0,1,5,0,10,5)".to_owned()),
        (left, centre, "(LINE/0,0,5,0,10)".to_owned()),
    ] {
        assert_eq!(
            arc(direction, circle, &rest),
            Err(vec!["bad-circle"]),
            "{direction} {circle} {rest}"
        );
    }
    for other in ["(PLANE/1,0,0,0)", "(LINE/CANON,1,0,0,0)"] {
        assert_eq!(arc(left, centre, other), Err(vec!["motion-not-read"]), "{other}");
    }
    let goes_on = format!(
        "{HEAD}CYCLE/DRILL,FEDTO,5,MMPM,50,RAPTO,3\nINDIRV/0,1,0\nTLON,GOFWD/(CIRCLE/-10,0,30,10),ON,(LINE/-10,0,30,-10,10,30)\nCYCLE/OFF\n"
    );
    assert_eq!(read(&goes_on).1, [(7, "bad-circle")]);
    let none = format!("{HEAD}TLON,GOFWD/(CIRCLE/-10,0,30,10),ON,(LINE/-10,0,30,-10,10,30)\n");
    assert_eq!(read(&none).1, [(5, "bad-circle")]);
    for line in ["TLON,GOFWD/(CYLNDR/0,0,0,0,1,0,5),ON,(PLANE/1,0,0,0)", "TLLFT,GOLFT/L1", "TLON"] {
        refused(line, "motion-not-read");
    }
}

/// ANGLE of Autodesk is how far the tool goes, counter-clockwise about the normal.
#[test]
fn law_an_angle_of_a_circle_is_that_to_its_point() {
    let circle = |line: &str| match word(line) {
        (Word::Circle(circle), found) if found.is_empty() => circle,
        other => panic!("{line} {other:?}"),
    };
    let from = [10.0, 0.0, 0.0];
    let on = |degrees: f64| {
        let (sine, cosine) = degrees.to_radians().sin_cos();
        [10.0 * cosine, 10.0 * sine, -2.0]
    };
    for (stated, is) in [
        (90.0, 90.0),
        (90.0, 90.04),
        (270.0, 270.0),
        (360.0, 0.0),
        (360.0, -1e-3),
        (450.0, 90.0),
        (720.0, 0.0),
    ] {
        let line = format!("MOVARC/0, 0, 30, 0, 0, 1, 0, ANGLE, {stated}");
        let turn = circle(&line).turn_rad(&from, &on(is)).expect("the same");
        let wanted = is + 360.0 * f64::round((stated - is) / 360.0);
        assert!((turn.to_degrees() - wanted).abs() < 1e-9, "{stated} {is} {turn}");
    }
    for (stated, is) in [(90.0, 270.0), (90.0, 92.0), (270.0, 90.0), (360.0, 180.0), (1.0, 0.0)] {
        let line = format!("MOVARC/0,0,30,0,0,1,0,ANGLE,{stated}");
        assert!(circle(&line).turn_rad(&from, &on(is)).is_err(), "{stated} {is}");
    }
    for line in [
        "MOVARC/0,0,30,0,0,1,0,ANGLE,-90",
        "MOVARC/0,0,30,0,0,1,0,ANGLE,0",
        "MOVARC/0,0,30,0,0,1,0,TURNS,2",
    ] {
        refused(line, "bad-circle");
    }
}
