//! Cuts of strokes before they are written: each stroke by itself, on any thread.

use crate::Fault;
use crate::axes::Leg;
use crate::cut::{Cutter, Node};
use crate::feed::feed_of;
use crate::path::{Path, Stroke, Way};
use std::ops::Range;
use trueaxis_geometry::Vec3;
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
    /// The rotary axes at the ends of the strokes and at the one before them, and what is printed there.
    turned: Vec<Command>,
    printed: Vec<Command>,
    tips: Vec<Vec3>,
}

impl Cuts {
    /// Cuts these strokes of a leg. Left out are those that may become arcs, and all where the control
    /// takes its rotary axes from written vectors: there a cut depends on those before it.
    pub fn find(&mut self, cutter: &Cutter<'_>, path: &Path, leg: &Leg<'_>, strokes: Range<usize>) {
        self.pieces.clear();
        self.ends.clear();
        self.faults.clear();
        self.strokes = strokes.clone();
        let is_known = self.print_ends(cutter, path, leg);
        let printed = |cuts: &Self, index: usize| {
            let command = cuts.printed[index + 1 - strokes.start];
            is_known.then(|| Node { u: 1.0, stand: path.strokes.to(index), command })
        };
        let mut at = None;
        for index in strokes.clone() {
            let stroke = path.strokes.get(index);
            if stroke.way != Way::Line || cutter.has_vectors() {
                self.ends.push((self.pieces.len(), None));
                at = None;
                continue;
            }
            let before = || printed(self, index - 1);
            let from = at.or_else(before).unwrap_or_else(|| cutter.end_of(path, leg, index - 1));
            let turned = &self.turned[index + 1 - strokes.start];
            if cutter.is_near_at_a_glance(&stroke, &from, turned)
                && let Some(to) = printed(self, index)
            {
                self.pieces.push(cutter.piece(&stroke, &Node { u: 0.0, ..from }, to));
                self.ends.push((self.pieces.len(), Some(stroke.line)));
                at = Some(to);
                continue;
            }
            let pieces = &mut self.pieces;
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

    /// The axis positions that are printed at the ends of the strokes and at the one before them, where they
    /// follow from the rotary axes.
    fn print_ends(&mut self, cutter: &Cutter<'_>, path: &Path, leg: &Leg<'_>) -> bool {
        let ends = self.strokes.start - 1..self.strokes.end;
        self.turned.clear();
        self.turned.extend(ends.clone().map(|index| leg.turned(index)));
        self.tips.clear();
        self.tips.extend(ends.map(|index| path.strokes.to(index).tip));
        self.printed.clone_from(&self.turned);
        cutter.print_ends(&self.tips, &mut self.printed)
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::axes::{legs, stretches};
    use crate::{PostOptions, axes};
    use std::fmt::Write;
    use trueaxis_cl::{ClPath, Reading};
    use trueaxis_input::Diagnostics;
    use trueaxis_machine::Machine;
    use trueaxis_machine::file::NoTables;
    use trueaxis_machine::tcp::TipControl;
    use trueaxis_nc::Control;

    /// A path that turns slowly and fast, comes near the pole, and has an arc in it.
    fn path_text() -> String {
        let mut text = "FEDRAT/100\n".to_owned();
        for i in 0..400 {
            let u = f64::from(i) / 400.0;
            let (sin, cos) = (9.0 * u * u).sin_cos();
            let tilt = 0.9 * (3.0 * u).sin() + if i % 40 == 0 { 0.05 } else { 0.002 };
            if i == 100 {
                text.push_str("CIRCLE/0,0,0,0,0,1,30\n");
            }
            let (x, y, z) = (30.0 * cos, 30.0 * sin, 5.0 * u);
            let (i, j, k) = (tilt.sin() * cos, tilt.sin() * sin, tilt.cos());
            let _ = writeln!(text, "GOTO/{x},{y},{z},{i},{j},{k}");
        }
        text
    }

    /// The pieces are the same in blocks of any size, and those that are seen at a glance are those that the
    /// places on the way give.
    #[test]
    fn law_pieces_are_the_same_in_any_blocks() {
        for (chain, decimals) in
            [("w C' A' b X Y Z t", 5), ("w b X Y Z C A t", 3), ("w b X Y Z U C A t", 5)]
        {
            let text = format!(
                "[machine]\nname = \"m\"\nchain = \"{chain}\"\n[tool]\nlength = \"50 mm\"\n"
            );
            let machine = Machine::check("m.toml", &text, &NoTables).0.expect("a machine");
            let control = TipControl::of(&machine).expect("three linear axes");
            let mut options = PostOptions::of(Control::Sinumerik840d);
            options.decimals.angle = decimals;
            let text = path_text();
            let (file, _) = ClPath::read("a.cls", text.as_bytes(), &Reading::default());
            let mut path = Path::of(file, &options, &mut Diagnostics::new());
            axes::pass_poles(&mut path, &control, options.pole_rad);
            let cutter = Cutter::new(&machine, &control, &options);
            for stretch in stretches(&path) {
                let check = &mut |leg: &Leg<'_>| blocks_agree(&cutter, &path, leg);
                legs(&machine, &path, stretch, &mut Command::default(), check).expect("a way");
            }
        }
    }

    fn blocks_agree(cutter: &Cutter<'_>, path: &Path, leg: &Leg<'_>) {
        let mut wanted = Vec::new();
        let mut glances = 0;
        for index in leg.first + 1..leg.end() {
            let stroke = path.strokes.get(index);
            let from = cutter.end_of(path, leg, index - 1);
            let begin = wanted.len();
            cutter
                .pieces(&stroke, &from, leg.command(path, index), &mut |piece| {
                    wanted.push((index, *piece));
                    Ok(())
                })
                .expect("pieces");
            let (mut printed, tip) = ([leg.turned(index)], path.strokes.to(index).tip);
            if cutter.is_near_at_a_glance(&stroke, &from, &printed[0])
                && cutter.print_ends(&[tip], &mut printed)
            {
                glances += 1;
                let to = Node { u: 1.0, stand: stroke.to, command: printed[0] };
                let piece = cutter.piece(&stroke, &Node { u: 0.0, ..from }, to);
                assert!(are_the_same(&wanted[begin..], &[(index, piece)]));
            }
        }
        assert!(glances > 0 || !cutter.has_three_linear || leg.end() - leg.first < 100);
        let mut blocks = None;
        for size in [1, 7, 100, 1000] {
            let (mut found, mut cuts) = (Vec::new(), Cuts::default());
            for first in (leg.first + 1..leg.end()).step_by(size) {
                cuts.find(cutter, path, leg, first..leg.end().min(first + size));
                for index in cuts.strokes().clone() {
                    let of = cuts.of(index);
                    assert_eq!(of.is_none(), path.strokes.get(index).way != Way::Line);
                    found.extend(of.iter().flat_map(|c| c.pieces).map(|piece| (index, *piece)));
                }
            }
            wanted.retain(|(index, _)| path.strokes.get(*index).way == Way::Line);
            assert!(are_the_same(&found, &wanted));
            let first = blocks.get_or_insert_with(|| found.clone());
            assert_eq!(*first, found, "blocks of {size}");
        }
    }

    /// But for the last digits of the linear axes: side by side they may be rounded otherwise.
    fn are_the_same(a: &[(usize, Piece)], b: &[(usize, Piece)]) -> bool {
        let is_near =
            |a: &Command, b: &Command| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-11);
        a.len() == b.len()
            && a.iter().zip(b).all(|((i, a), (k, b))| {
                let to = Node { command: b.to.command, ..a.to };
                i == k && Piece { to, ..*a } == *b && is_near(&a.to.command, &b.to.command)
            })
    }
}
