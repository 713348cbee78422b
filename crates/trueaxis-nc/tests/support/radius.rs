//! The path of the centre of a tool.

use std::collections::BTreeMap;

use trueaxis_nc::moves::{Axis, Position};
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

/// The path of a program in X and Y with tool 1 of a radius and tool 2 with 1 mm more, and the code and line
/// of what was found.
pub fn path(control: Control, text: &str, radius: f64) -> (Vec<Piece>, Vec<(&'static str, usize)>) {
    let program = Program::new("p", text.as_bytes().to_vec(), control);
    let settings = Settings {
        radii: BTreeMap::from([(1, radius), (2, radius + 1.0)]),
        tools: BTreeMap::from([(1, Position::default()), (2, Position::default())]),
        ..Settings::default()
    };
    let mut pieces = Vec::new();
    let outcome = interpret(&program, &NoLibrary, &settings, &mut |step| {
        let Step::Move(m) = step else { return };
        let (arc, turns) = match m.kind {
            MoveKind::Arc(arc) => (Some((arc.center_mm, arc.ccw)), arc.turns),
            MoveKind::Rapid | MoveKind::Linear => (None, 0),
            _ => return,
        };
        let to = [m.target[Axis::X], m.target[Axis::Y]];
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
