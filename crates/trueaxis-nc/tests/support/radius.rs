//! The path of the centre of a tool.

use std::collections::BTreeMap;

use trueaxis_nc::moves::{Axis, Event, Frame, Position};
use trueaxis_nc::{Control, MoveKind, NoLibrary, Program, Settings, Step, interpret};

pub type Point = [f64; 2];

/// A piece of the path: where it ends, the centre of an arc with its sense, the feed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Piece {
    pub to: Point,
    pub z: f64,
    pub arc: Option<(Point, bool)>,
    pub feed: f64,
    pub turns: u32,
    /// Its block.
    pub line: u32,
}

/// Where places are counted from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum On {
    /// The program zero.
    Program,
    /// The workpiece, whatever the frame is.
    Workpiece,
}

/// The path in coordinates of the program, see [`placed`].
pub fn path(control: Control, text: &str, radius: f64) -> (Vec<Piece>, Vec<(&'static str, usize)>) {
    placed(control, text, radius, On::Program)
}

/// The path of a program in X and Y with tool 1 of a radius and tool 2 with 1 mm more, and the code and line
/// of what was found.
pub fn placed(
    control: Control,
    text: &str,
    radius: f64,
    on: On,
) -> (Vec<Piece>, Vec<(&'static str, usize)>) {
    let program = Program::new("p", text.as_bytes().to_vec(), control);
    let settings = Settings {
        radii: BTreeMap::from([(1, radius), (2, radius + 1.0)]),
        tools: BTreeMap::from([(1, Position::default()), (2, Position::default())]),
        ..Settings::default()
    };
    let mut pieces = Vec::new();
    let mut frame = Frame::IDENTITY;
    let outcome = interpret(&program, &NoLibrary, &settings, &mut |step| {
        let m = match step {
            Step::Move(m) => m,
            Step::Event(Event::Frame(now), _) => {
                frame = if on == On::Workpiece { now } else { frame };
                return;
            }
            Step::Event(..) => return,
        };
        let place = |x, y| {
            let mut at = m.target;
            (at[Axis::X], at[Axis::Y]) = (x, y);
            let at = frame.place(&at);
            [at[Axis::X], at[Axis::Y]]
        };
        let (arc, turns) = match m.kind {
            MoveKind::Arc(arc) => {
                (Some((place(arc.center_mm[0], arc.center_mm[1]), arc.ccw)), arc.turns)
            }
            MoveKind::Rapid | MoveKind::Linear => (None, 0),
            _ => return,
        };
        let to = place(m.target[Axis::X], m.target[Axis::Y]);
        pieces.push(Piece {
            to,
            z: m.target[Axis::Z],
            arc,
            feed: m.feed.value,
            turns,
            line: m.origin.line,
        });
    });
    (pieces, outcome.problems.iter().map(|p| (p.code, p.place.line)).collect())
}

/// The path of a program in which nothing is found.
pub fn sound(control: Control, text: &str, radius: f64) -> Vec<Piece> {
    let (pieces, found) = path(control, text, radius);
    assert!(found.is_empty(), "{found:?}\n{text}");
    pieces
}
