//! Feeds of posted programs where only a rotary axis turns.

mod library;

use library::machine;
use library::paths::cl;
use std::fmt::Write;
use trueaxis::nc::moves::{FeedMode, Move, MoveKind};
use trueaxis::nc::{Control, NoLibrary, Program, Settings, Step, interpret};
use trueaxis::post::{PostOptions, post};

/// The moves with feed of a file for the engraver, as positions of its axes.
fn cuts(text: &str, control: Control) -> Vec<Move> {
    let options = PostOptions { tip_words: None, ..PostOptions::of(control) };
    let (posted, problems) = post(&machine("i5-engraver"), &cl(text), &options);
    let posted = posted.unwrap_or_else(|| panic!("{problems:?}\n{text}"));
    let program = Program::new("p", posted.text, control);
    let mut found = Vec::new();
    let outcome = interpret(&program, &NoLibrary, &Settings::default(), &mut |step| {
        if let Step::Move(m) = step
            && m.kind == MoveKind::Linear
        {
            found.push(m);
        }
    });
    assert!(outcome.finished && !outcome.problems.has_errors(), "{:?}", outcome.problems);
    found
}

/// A tip that runs at 60 mm/min round the axis of the table, the tool turned with it: only C turns, by steps of 2°, so
/// that the feed counts degrees. At a radius r the table turns by F/r, at 10 mm 6 rad/min = 343.775 deg/min; where the
/// tip stands on the axis, F itself counts degrees.
#[test]
fn law_a_turning_table_gets_the_feed_of_the_tip_in_degrees() {
    for (radius, wanted) in [(10.0, (60.0_f64 / 10.0).to_degrees()), (0.0, 60.0)] {
        let mut text = "UNITS/MM\nMULTAX/ON\nRAPID\n".to_owned();
        for k in 0..6 {
            let (sin, cos) = (2.0 * f64::from(k)).to_radians().sin_cos();
            // The tool axis of C = 2k°, A = 30°.
            let (lean, up) = (0.5, 0.75_f64.sqrt());
            let _ = writeln!(
                text,
                "GOTO/{:.12},{:.12},5,{:.14},{:.14},{up:.14}",
                radius * cos,
                radius * sin,
                lean * sin,
                -lean * cos
            );
            if k == 0 {
                text += "FEDRAT/60,MMPM\n";
            }
        }
        for control in [Control::Fanuc, Control::Sinumerik840d] {
            let all = cuts(&text, control);
            assert_eq!(all.len(), 5, "{control:?} {radius}");
            for m in &all {
                assert_eq!(m.feed.mode, FeedMode::PerMinute);
                // The chord of 2° is shorter than its arc by 5e-5 of it.
                let off = m.feed.value / wanted - 1.0;
                assert!(off.abs() < 2e-4, "{control:?} {radius}: {:?}, not {wanted}", m.feed);
            }
        }
    }
}
