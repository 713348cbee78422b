//! Blocks with radius compensation as the path of the centre of the tool, without it.

use super::super::number::{Grid, Of, Unit};
use super::super::text::Modes;
use super::super::words::Words;
use super::cycles::{Unrolled, head_without};
use std::ops::Range;
use trueaxis_nc::lexer::{Lexer, TokenKind};
use trueaxis_nc::moves::{Axis, Coordinates, FeedMode, Move, MoveKind, Position};
use trueaxis_nc::{Control, Program};

/// Codes that are written for each move, or that begin and end the compensation.
const CODES: [f64; 10] = [0.0, 1.0, 2.0, 3.0, 40.0, 41.0, 42.0, 41.1, 42.1, 91.0];

/// Codes that switch the compensation.
const COMPENSATION: [f64; 3] = [40.0, 41.0, 42.0];

const ANY_LETTER: [u8; 26] = *b"ABCDEFGHIJKLMNOPQRSTUVWXYZ";

/// The block without its contour, and its moves one by one; `None` if one of them has no plain block. `from` is
/// where the tool is before it.
pub(super) fn written(
    program: &Program,
    line: &Range<usize>,
    moves: &[Move],
    mut from: Option<Position>,
    modes: Modes,
) -> Option<Unrolled> {
    let control = program.dialect().control;
    let mut blocks = Vec::new();
    for m in moves {
        blocks.push(block(m, from, control, modes)?);
        from = Some(m.target);
    }
    let [head, tail] = match control {
        Control::Fanuc | Control::Haas | Control::LinuxCnc => {
            [head_without(program, line, &CODES, b"STMH"), String::new()]
        }
        Control::Sinumerik840d if moves.is_empty() => {
            // What else a block switches stays.
            [head_without(program, line, &COMPENSATION, &ANY_LETTER), String::new()]
        }
        Control::Sinumerik840d | Control::Heidenhain => functions(program, line),
    };
    blocks.extend(Some(tail).filter(|tail| !tail.is_empty()));
    if modes.incremental && control != Control::Heidenhain && !blocks.is_empty() {
        blocks.insert(0, "G90".to_owned());
        blocks.push("G91".to_owned());
    }
    Some(Unrolled { head, moves: blocks })
}

fn block(m: &Move, from: Option<Position>, control: Control, modes: Modes) -> Option<String> {
    if m.coordinates != Coordinates::Program || m.direction.is_some() {
        return None;
    }
    let klartext = control == Control::Heidenhain;
    let number = |value: f64| Grid::of(None, modes.unit).text(value, Of::Linear, control);
    let places = |axes: &[Axis]| -> String {
        axes.iter().map(|a| format!(" {a}{}", number(m.target[*a]))).collect()
    };
    let turned = |axis: &&Axis| axis.is_rotary() && m.named.contains(**axis);
    let rotary: String = Axis::ALL
        .iter()
        .filter(turned)
        .map(|a| {
            format!(
                " {a}{}",
                Grid::of(None, Unit::Millimetre).text(m.target[*a], Of::Rotary, control)
            )
        })
        .collect();
    let feed = match (m.kind, m.feed.mode) {
        (MoveKind::Rapid, _) if klartext => " FMAX".to_owned(),
        (MoveKind::Rapid, _) => String::new(),
        (_, FeedMode::PerMinute) if klartext => {
            format!(" F{}", super::cycles::klartext_feed(m, modes))
        }
        (_, FeedMode::InverseTime) => return None,
        _ if klartext => return None,
        _ => format!(" F{}", m.feed.value / modes.feed_unit.mm()),
    };
    let xyz = places(&[Axis::X, Axis::Y, Axis::Z]);
    Some(match m.kind {
        MoveKind::Rapid | MoveKind::Linear if klartext => format!("L{xyz}{rotary}{feed}"),
        MoveKind::Rapid => format!("G0{xyz}{rotary}"),
        MoveKind::Linear => format!("G1{xyz}{rotary}{feed}"),
        MoveKind::Arc(arc) if arc.turns == 1 && rotary.is_empty() => {
            let [a, b, c] = arc.plane.axes();
            let start = from?;
            if klartext {
                if start[c] != m.target[c] {
                    return None;
                }
                let [p, q] = arc.center_mm.map(number);
                let sense = if arc.ccw { "DR+" } else { "DR-" };
                return Some(format!("CC {a}{p} {b}{q}\nC{} {sense}{feed}", places(&[a, b])));
            }
            let code = if arc.ccw { "G3" } else { "G2" };
            let arm = [number(arc.center_mm[0] - start[a]), number(arc.center_mm[1] - start[b])];
            let letters = [a, b].map(|axis| ["I", "J", "K"][axis as usize]);
            format!("{code}{xyz} {}{} {}{}{feed}", letters[0], arm[0], letters[1], arm[1])
        }
        _ => return None,
    })
}

/// The M functions and comments of a block, and the M functions that act when it has been travelled.
pub(super) fn functions(program: &Program, line: &Range<usize>) -> [String; 2] {
    let source = program.source();
    let at_end = Words::read(source, program.dialect(), line.clone()).at_end;
    let tokens: Vec<_> = Lexer::new(source, program.dialect(), line.start)
        .take_while(|t| t.start < line.end && t.kind != TokenKind::LineEnd)
        .filter(|t| t.kind != TokenKind::Space)
        .collect();
    let mut kept = [const { Vec::new() }; 2];
    for (i, token) in tokens.iter().enumerate() {
        let text = |to: usize| String::from_utf8_lossy(&source[token.start..to]).into_owned();
        let is_m = text(token.end).eq_ignore_ascii_case("M");
        let number = tokens.get(i + 1).filter(|t| t.kind == TokenKind::Number);
        match (token.kind, number) {
            (TokenKind::Comment, _) => kept[0].push(text(token.end.min(line.end))),
            (TokenKind::Letter, Some(number)) if is_m => {
                let is_last = at_end.iter().any(|range| range.start == token.start);
                kept[usize::from(is_last)].push(text(number.end));
            }
            _ => {}
        }
    }
    kept.map(|words| words.join(" "))
}
