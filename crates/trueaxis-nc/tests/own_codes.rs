//! The user's dictionary of codes and programs of the machine builder.

use std::collections::BTreeMap;

use trueaxis_nc::moves::Axis;
use trueaxis_nc::{Control, Event, Library, OwnCode, Program, Settings, Step, interpret};

/// A program SUB of each control, which goes to X7.
struct Subs(Control);

impl Library for Subs {
    fn text(&self, name: &str) -> Result<Vec<u8>, String> {
        let text = match (name, self.0) {
            ("SUB", Control::Heidenhain) => "BEGIN PGM SUB MM\nL X+7 R0 FMAX\nEND PGM SUB MM\n",
            ("SUB", Control::Sinumerik840d) => "G0 X7\nRET\n",
            ("SUB", _) => "G0 X7.\nM99\n",
            _ => return Err("none".to_owned()),
        };
        Ok(text.as_bytes().to_vec())
    }
}

/// The X places, the number of stops, and the codes of the problems.
fn run(
    control: Control,
    text: &str,
    codes: &[(&str, OwnCode)],
) -> (Vec<f64>, usize, Vec<&'static str>) {
    let codes: BTreeMap<_, _> = codes.iter().map(|(k, v)| ((*k).to_owned(), v.clone())).collect();
    let settings = Settings { codes, keep_going: true, ..Settings::default() };
    let program = Program::new("p", text.as_bytes().to_vec(), control);
    let (mut x, mut stops) = (Vec::new(), 0);
    let outcome = interpret(&program, &Subs(control), &settings, &mut |s| match s {
        Step::Move(m) => x.push(m.target[Axis::X]),
        Step::Event(Event::Stop { .. }, _) => stops += 1,
        Step::Event(..) => {}
    });
    (x, stops, outcome.problems.iter().map(|p| p.code).collect())
}

const ISO: [Control; 4] =
    [Control::Fanuc, Control::Haas, Control::LinuxCnc, Control::Sinumerik840d];

#[test]
fn codes_are_ignored_stop_or_call_a_program() {
    let call = OwnCode::Call("SUB".to_owned());
    for control in ISO.into_iter().chain([Control::Heidenhain]) {
        let text = match control {
            Control::Heidenhain => "L X+1 R0 FMAX M777\nL X+2 R0 FMAX\n",
            _ => "G0 X1. M777\nX2.\nM30\n",
        };
        assert_eq!(
            run(control, text, &[]),
            (vec![1.0, 2.0], 0, vec!["unknown-m-code"]),
            "{control:?}"
        );
        let ignored = run(control, text, &[("M777", OwnCode::Ignore)]);
        assert_eq!(ignored, (vec![1.0, 2.0], 0, vec![]), "{control:?}");
        let stopped = run(control, text, &[("M777", OwnCode::Stop)]);
        assert_eq!(stopped, (vec![1.0, 2.0], 1, vec![]), "{control:?}");
        // After the move of its block.
        let called = run(control, text, &[("M777", call.clone())]);
        assert_eq!(called, (vec![1.0, 7.0, 2.0], 0, vec![]), "{control:?}");
        // What it calls must be there.
        let missing = run(control, text, &[("M777", OwnCode::Call("NONE".to_owned()))]);
        assert_eq!(missing.2, ["missing-subprogram"], "{control:?}");
    }
}

/// An ignored G code has the words of its block: they move nothing.
#[test]
fn ignored_g_codes_take_their_words() {
    for control in ISO {
        let text = "G0 X1.\nG777 X5. F3.\nX2.\nM30\n";
        let (_, _, codes) = run(control, text, &[]);
        assert_eq!(codes, ["unknown-g-code"], "{control:?}");
        let (x, _, codes) = run(control, text, &[("G777", OwnCode::Ignore)]);
        assert_eq!((x, codes), (vec![1.0, 2.0], vec![]), "{control:?}");
    }
}

/// Known codes as well, and names of SINUMERIK programs.
#[test]
fn known_codes_and_names_of_programs() {
    let call = OwnCode::Call("SUB".to_owned());
    for control in ISO {
        let (x, ..) = run(control, "G0 X1.\nM6\nX2.\nM30\n", &[("M6", call.clone())]);
        assert_eq!(x, [1.0, 7.0, 2.0], "{control:?}");
    }
    let text = "G0 X1\nTOOLIN(5)\nX2\nM30\n";
    let mpf = |codes| run(Control::Sinumerik840d, text, codes);
    assert_eq!(mpf(&[]).2, ["missing-subprogram"]);
    assert_eq!(mpf(&[("TOOLIN", OwnCode::Ignore)]), (vec![1.0, 2.0], 0, vec![]));
    assert_eq!(mpf(&[("TOOLIN", call)]).0, [1.0, 7.0, 2.0]);
}
