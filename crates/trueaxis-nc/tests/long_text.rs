//! A text that is kept elsewhere than in the memory: what was executed is passed, and read again where a program jumps back.

use std::ops::Range;
use std::sync::{Arc, Mutex};
use trueaxis_input::{Content, Kept};
use trueaxis_nc::{Control, Library, Program, Settings, Step, interpret};

/// A text with the parts of it that were passed.
struct Text(Vec<u8>, Arc<Mutex<Vec<Range<usize>>>>);

impl Kept for Text {
    fn bytes(&self) -> &[u8] {
        &self.0
    }

    fn pass(&self, range: Range<usize>) {
        self.1.lock().expect("the list").push(range);
    }
}

struct Long(Content);

impl Library for Long {
    fn text(&self, _: &str) -> Result<Vec<u8>, String> {
        Err("not as a whole".to_owned())
    }

    fn content(&self, _: &str) -> Result<Content, String> {
        Ok(self.0.clone())
    }
}

/// The number of moves, the sum of their places, and whether the program was executed to its end.
fn run(program: &Program, library: &Long) -> (usize, f64, bool) {
    let (mut count, mut sum) = (0, 0.0);
    let outcome = interpret(program, library, &Settings::default(), &mut |step| {
        if let Step::Move(m) = step {
            (count, sum) = (count + 1, sum + m.target.0.iter().sum::<f64>());
        }
    });
    (count, sum, outcome.finished)
}

/// A program of a control that goes twice round so many lines as 20 MB hold, and the lines.
fn texts(control: Control) -> (String, String) {
    let (line, begin, end) = match control {
        Control::Heidenhain => ("L X+1.25 Y+2.5 F500\n", "LBL 1\n", "CALL LBL 1 REP 1\n"),
        Control::Sinumerik840d => {
            ("G1 X1.25 Y2.5 F500\n", "R1=0\nWHILE R1<2\n", "R1=R1+1\nENDWHILE\n")
        }
        Control::LinuxCnc => {
            ("G1 X1.25 Y2.5 F500\n", "#1=0\no1 while [#1 LT 2]\n", "#1=[#1+1]\no1 endwhile\n")
        }
        _ => ("G1 X1.25 Y2.5 F500.\n", "#1=0\nWHILE [#1 LT 2] DO1\n", "#1=#1+1\nEND1\n"),
    };
    let lines = line.repeat((20 << 20) / line.len());
    (format!("{begin}{lines}{end}"), lines)
}

#[test]
fn law_a_text_that_is_passed_is_executed_as_one_in_the_memory() {
    let controls = [Control::Fanuc, Control::LinuxCnc, Control::Sinumerik840d, Control::Heidenhain];
    for control in controls {
        let (round, _) = texts(control);
        let none = Long(Vec::new().into());
        let due = run(&Program::new("p", round.clone().into_bytes(), control), &none);
        assert!(due.2 && due.0 > 2 * 900_000, "{control:?} {due:?}");
        let passed = Arc::default();
        let kept = Content::kept(Text(round.clone().into_bytes(), Arc::clone(&passed)));
        assert_eq!(run(&Program::of("p", kept, control), &none), due, "{control:?}");
        let passed = passed.lock().expect("the list");
        // Each time round all but the last megabytes are passed.
        let bytes: usize = passed.iter().map(ExactSizeIterator::len).sum();
        assert!(bytes >= 2 * (round.len() - (17 << 20)), "{control:?} {passed:?}");
        assert!(passed.iter().all(|range| range.end <= round.len()), "{control:?} {passed:?}");
    }
}

#[test]
fn a_long_subprogram_is_passed_too() {
    let (_, lines) = texts(Control::Fanuc);
    let text = format!("O2\n{lines}M99\n").into_bytes();
    let passed = Arc::default();
    let library = Long(Content::kept(Text(text, Arc::clone(&passed))));
    let main = Program::new("p", b"O1\nM98 P2\nG0 X7.\nM30\n".to_vec(), Control::Fanuc);
    let (count, _, finished) = run(&main, &library);
    assert!(finished && count > 900_000, "{count}");
    assert!(!passed.lock().expect("the list").is_empty());
}
