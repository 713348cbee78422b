//! Cuts of strokes before they are written: each stroke by itself, on any thread.

use crate::Fault;
use crate::axes::Leg;
use crate::cut::{Cutter, Node};
use crate::feed::feed_of;
use crate::path::{Path, Stroke, Way};
use std::ops::Range;
use trueaxis_machine::axis::Command;
use trueaxis_nc::moves::Feed;

/// A block of the program: a part of a stroke.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Piece {
    /// Where on the stroke it begins.
    pub from: f64,
    /// Where it ends, with the axis positions that are printed.
    pub to: Node,
    /// `None` in rapid traverse.
    pub feed: Option<Feed>,
}

/// The pieces of one stroke, as far as it can be cut.
pub(crate) struct CutStroke<'c> {
    pub pieces: &'c [Piece],
    pub fault: Option<&'c Fault>,
    /// The line of the file.
    pub line: u32,
}

/// The pieces of strokes in a row.
#[derive(Debug, Default)]
pub(crate) struct Cuts {
    strokes: Range<usize>,
    pieces: Vec<Piece>,
    /// Of each stroke: where its pieces end, and its line; none where it is not cut ahead.
    ends: Vec<(usize, Option<u32>)>,
    faults: Vec<(usize, Fault)>,
}

impl Cuts {
    /// Cuts these strokes of a leg. Left out are those that may become arcs, and all where the control
    /// takes its rotary axes from written vectors: there a cut depends on those before it.
    pub fn find(&mut self, cutter: &Cutter<'_>, path: &Path, leg: &Leg<'_>, strokes: Range<usize>) {
        self.pieces.clear();
        self.ends.clear();
        self.faults.clear();
        self.strokes = strokes.clone();
        let mut at = None;
        for index in strokes {
            let stroke = path.strokes.get(index);
            if stroke.way != Way::Line || cutter.has_vectors() {
                self.ends.push((self.pieces.len(), None));
                at = None;
                continue;
            }
            let from = at.unwrap_or_else(|| cutter.end_of(path, leg, index - 1));
            let pieces = &mut self.pieces;
            if let Some(to) = cutter.whole(&stroke, &from, &leg.turned(index)) {
                pieces.push(cutter.piece(&stroke, &Node { u: 0.0, ..from }, to));
                self.ends.push((pieces.len(), Some(stroke.line)));
                at = Some(to);
                continue;
            }
            let command = leg.command(path, index);
            let cut = cutter.pieces(&stroke, &from, command, &mut |piece| {
                pieces.push(*piece);
                Ok(())
            });
            match cut {
                Ok(end) => at = Some(end),
                Err(fault) => {
                    self.faults.push((index, fault));
                    at = None;
                }
            }
            self.ends.push((self.pieces.len(), Some(stroke.line)));
        }
    }

    pub fn strokes(&self) -> &Range<usize> {
        &self.strokes
    }

    /// What was found of a stroke; `None` if it is not cut ahead.
    pub fn of(&self, index: usize) -> Option<CutStroke<'_>> {
        let at = index.checked_sub(self.strokes.start)?;
        let (end, line) = *self.ends.get(at)?;
        let begin = at.checked_sub(1).map_or(0, |before| self.ends[before].0);
        let fault = self.faults.iter().find(|(stroke, _)| *stroke == index).map(|(_, f)| f);
        Some(CutStroke { pieces: &self.pieces[begin..end], fault, line: line? })
    }
}

impl Cutter<'_> {
    /// Hands out the pieces of a stroke that begins at `from`, with their feeds; where it ends.
    pub fn pieces(
        &self,
        stroke: &Stroke,
        from: &Node,
        command: Command,
        out: &mut dyn FnMut(&Piece) -> Result<(), Fault>,
    ) -> Result<Node, Fault> {
        let from = Node { u: 0.0, ..*from };
        let mut here = from;
        self.cut(stroke, &from, command, &mut |node| {
            let node = Node { command: self.exact(&node.stand, &node.command), ..*node };
            out(&self.piece(stroke, &here, node))?;
            here = node;
            Ok(())
        })?;
        Ok(here)
    }

    fn piece(&self, stroke: &Stroke, from: &Node, to: Node) -> Piece {
        let feed =
            (!stroke.rapid).then(|| feed_of(self.machine, self.options, from, &to, stroke.feed));
        Piece { from: from.u, to, feed }
    }
}
