//! Cycles unrolled: the moves that a block makes as plain blocks.

use super::super::number::{Grid, Of, Unit};
use super::super::text::{Edits, Modes};
use super::super::words::Words;
use super::centre::functions;
use std::ops::Range;
use trueaxis_nc::lexer::{Lexer, TokenKind};
use trueaxis_nc::moves::{Axis, Coordinates, FeedMode, Move, MoveKind, Position};
use trueaxis_nc::{Control, Program};

/// A block that makes several moves, as plain text.
pub(super) struct Unrolled {
    /// What remains of the block itself.
    pub head: String,
    /// A block for each further move.
    pub moves: Vec<String>,
}

/// The moves of a cycle as plain blocks; `None` if `program`, a block alone, is no cycle, or one that has no
/// plain words.
pub(super) fn unrolled(
    program: &Program,
    words: &Words,
    moves: &[Move],
    modes: Modes,
) -> Option<Unrolled> {
    let control = program.dialect().control;
    let line = &(0..program.source().len());
    if moves.len() < 2 || words.reference || words.machine.is_some() {
        return None;
    }
    if moves.iter().all(|m| matches!(m.kind, MoveKind::Linear | MoveKind::Arc(_))) {
        // A rounding or chamfer: its word would remain.
        return None;
    }
    let is_rs274 = matches!(control, Control::Fanuc | Control::Haas | Control::LinuxCnc);
    // The place before a modal cycle is the block's own; a cycle of FANUC has its words for itself.
    let own_move = !is_rs274 && words.axes.iter().any(Option::is_some);
    let cycle = &moves[usize::from(own_move)..];
    let starts = std::iter::once(None).chain(cycle.iter().map(|m| Some(m.target)));
    let texts = cycle.iter().zip(starts).map(|(m, from)| block(m, from, control, modes));
    let mut blocks = texts.collect::<Option<Vec<_>>>()?;
    let [head, tail] = head(program, line, control, own_move);
    blocks.extend(Some(tail).filter(|tail| !tail.is_empty()));
    if is_rs274 && modes.incremental {
        blocks.insert(0, "G90".to_owned());
        blocks.push("G91".to_owned());
    }
    Some(Unrolled { head, moves: blocks })
}

/// One move with all coordinates, absolute; an arc has its centre from its start.
fn block(m: &Move, from: Option<Position>, control: Control, modes: Modes) -> Option<String> {
    let klartext = control == Control::Heidenhain;
    if m.coordinates != Coordinates::Program || m.direction.is_some() {
        return None;
    }
    let code = match m.kind {
        MoveKind::Rapid => "G0",
        MoveKind::Linear => "G1",
        MoveKind::Arc(arc) if control == Control::LinuxCnc && arc.turns == 1 => {
            if arc.ccw {
                "G3"
            } else {
                "G2"
            }
        }
        MoveKind::Dwell { seconds } => {
            return Some(match control {
                Control::Fanuc | Control::Haas => format!("G4 P{}", (seconds * 1000.0).round()),
                Control::LinuxCnc => format!("G4 P{seconds}"),
                Control::Sinumerik840d => format!("G4 F{seconds}"),
                Control::Heidenhain => format!("CYCL DEF 9.0 DWELL\nCYCL DEF 9.1 DWELL {seconds}"),
            });
        }
        _ => return None,
    };
    let mut text = if klartext { "L".to_owned() } else { code.to_owned() };
    for axis in [Axis::X, Axis::Y, Axis::Z] {
        let value = Grid::of(None, modes.unit).text(m.target[axis], Of::Linear, control);
        text += &format!(" {axis}{value}");
    }
    if let MoveKind::Arc(arc) = m.kind {
        for (axis, center) in arc.plane.axes().into_iter().zip(arc.center_mm) {
            let value = center - from?[axis];
            let value = Grid::of(None, modes.unit).text(value, Of::Linear, control);
            text += &format!(" {}{value}", char::from(b"IJK"[axis as usize]));
        }
    }
    if klartext {
        text += &match (m.kind, m.feed.mode) {
            (MoveKind::Rapid, _) => " FMAX".to_owned(),
            (_, FeedMode::PerMinute) => format!(" F{}", klartext_feed(m, modes)),
            _ => return None,
        };
    }
    Some(text)
}

/// F of Klartext: mm/min, or tenths of an inch.
pub(super) fn klartext_feed(m: &Move, modes: Modes) -> f64 {
    match modes.feed_unit {
        Unit::Millimetre => m.feed.value,
        Unit::Inch => m.feed.value / 2.54,
    }
}

/// The block without the words of its cycle, and what of it comes after the cycle.
fn head(program: &Program, line: &Range<usize>, control: Control, own_move: bool) -> [String; 2] {
    let text = || String::from_utf8_lossy(&program.source()[line.clone()]).into_owned();
    let whole = match control {
        Control::LinuxCnc if is_turning(program, line) => {
            head_without(program, line, &TURNING_CODES, b"NFSTMH")
        }
        Control::Fanuc | Control::Haas | Control::LinuxCnc => {
            head_without(program, line, &CYCLE_CODES, b"NFSTMDH")
        }
        Control::Heidenhain if own_move => {
            text().replace("M99", "").replace("M89", "").trim_end().to_owned()
        }
        Control::Sinumerik840d if own_move => text(),
        Control::Heidenhain | Control::Sinumerik840d => return functions(program, line),
    };
    [whole, String::new()]
}

/// The turning cycles of LinuxCNC: their D is a distance.
const TURNING_CODES: [f64; 7] = [70.0, 71.0, 71.1, 71.2, 72.0, 72.1, 72.2];

fn is_turning(program: &Program, line: &Range<usize>) -> bool {
    let all = head_without(program, line, &[], b"");
    head_without(program, line, &TURNING_CODES, b"") != all
}

/// Codes of cycles and of their retraction; what moves is written for each move.
const CYCLE_CODES: [f64; 19] = [
    0.0, 1.0, 2.0, 3.0, 73.0, 74.0, 76.0, 81.0, 82.0, 83.0, 84.0, 85.0, 86.0, 87.0, 88.0, 89.0,
    98.0, 99.0, 91.0,
];

/// G codes other than some, and the words of some letters.
pub(super) fn head_without(
    program: &Program,
    line: &Range<usize>,
    codes: &[f64],
    letters: &[u8],
) -> String {
    let source = program.source();
    let mut edits = Edits::default();
    let tokens: Vec<_> = Lexer::new(source, program.dialect(), line.start)
        .take_while(|t| t.start < line.end && t.kind != TokenKind::LineEnd)
        .filter(|t| !matches!(t.kind, TokenKind::Space))
        .collect();
    let starts: Vec<usize> = (0..tokens.len())
        .filter(|i| matches!(tokens[*i].kind, TokenKind::Letter | TokenKind::Comment))
        .collect();
    for (k, first) in starts.iter().enumerate() {
        let token = tokens[*first];
        let last = starts.get(k + 1).map_or(tokens.len(), |next| *next) - 1;
        let range = token.start..tokens[last].end.min(line.end);
        let value = String::from_utf8_lossy(&source[token.end..range.end]).trim().parse::<f64>();
        let stays = match source[token.start].to_ascii_uppercase() {
            _ if token.kind == TokenKind::Comment => true,
            b'G' => value.is_ok_and(|code| !codes.contains(&code)),
            letter => letters.contains(&letter),
        };
        if !stays {
            edits.put(range, "");
        }
    }
    let text = String::from_utf8_lossy(&edits.applied(source, line.clone())).into_owned();
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// The code of a motion that a block does not state because it lasts; `None` for others.
pub(super) fn motion_code(m: &Move) -> Option<&'static str> {
    match m.kind {
        MoveKind::Rapid => Some("G0 "),
        MoveKind::Linear => Some("G1 "),
        MoveKind::Arc(arc) => Some(if arc.ccw { "G3 " } else { "G2 " }),
        _ => None,
    }
}
