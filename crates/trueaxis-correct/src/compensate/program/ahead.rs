//! The program ahead of what is written: its steps and the places that they lead to, in stretches.
//!
//! ```text
//!     interpreter ──Step──> Ahead ──Stretch──> channel ──> Walk        one thread before, one after
//!          └────── emptied <── channel <───────────────────┘
//! ```

use super::Progress;
use super::line_table::LineTable;
use super::ready::{Preparer, Ready};
use super::words::Words;
use std::ops::Range;
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use trueaxis_machine::axis::Command;
use trueaxis_motion::axis_path::{AxisPath, Fault};
use trueaxis_motion::{Node, PathStep};
use trueaxis_nc::lexer::Token;
use trueaxis_nc::moves::{AxisSet, Event, Move, MoveKind, Step};
use trueaxis_nc::{Follower, FollowingAxes};

/// Places of a stretch: enough that a batch pays, few enough to stay in the cache.
const NODES: usize = 1024;

/// Steps of a stretch that lead nowhere are not gathered for ever.
const STEPS: usize = 4096;

/// The part of the work that is done when all lines are written; the proof is the rest.
const WRITING: f64 = 0.75;

/// Stretches that wait: each some 2 MB with the words of its lines.
const WAITING: usize = 2;

/// Some steps of the program that follow each other, with one tool.
#[derive(Debug, Default)]
pub(super) struct Stretch {
    pub steps: Vec<Ahead>,
    /// Of all steps.
    pub nodes: Vec<Node>,
    pub words: Vec<Words>,
    /// What was found for the nodes.
    pub ready: Ready,
}

/// A step of the program, and where the axes go by it as it is.
#[derive(Debug)]
pub(super) struct Ahead {
    pub step: Step,
    /// Where the axes stand before it.
    pub begin: Command,
    /// Its places in the stretch.
    pub nodes: Range<usize>,
    /// Of a rapid: what of it leads to where a cut begins.
    pub lead: Lead,
    /// Which words of the stretch are those of its line, if it moves and is of the program itself.
    pub words: Option<usize>,
    /// Why it cannot be executed.
    pub fault: Option<Fault>,
}

/// What of a rapid leads to where a cut begins.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Lead {
    /// The axes whose words hold there; none if no cut begins.
    pub axes: AxisSet,
    /// Where the axes stand there.
    pub begin: Command,
    /// No other move is between it and the cut: what no word led to its place yet it does by words of its own.
    pub is_last: bool,
}

/// Whether a move removes material: it has a feed.
fn is_cut(m: &Move) -> bool {
    !matches!(m.kind, MoveKind::Rapid | MoveKind::Align { .. } | MoveKind::Dwell { .. })
}

/// Marks the words of the rapids before the last step, a cut, that hold where it begins.
fn lead_to_cut(steps: &mut [Ahead]) {
    let mut replaced = AxisSet::default();
    let Some(begin) = steps.last().map(|cut| cut.begin) else { return };
    let mut is_last = true;
    for ahead in steps.iter_mut().rev().skip(1) {
        let Step::Move(m) = &ahead.step else { continue };
        if is_cut(m) {
            return;
        }
        if m.kind == MoveKind::Rapid {
            // A direction leads all rotary axes.
            let turned = if m.direction.is_some() { AxisSet::ROTARY.0 } else { 0 };
            let named = m.named.0 | turned;
            ahead.lead = Lead { axes: AxisSet(named & !replaced.0), begin, is_last };
            replaced = AxisSet(replaced.0 | named);
        }
        is_last &= ahead.nodes.is_empty() || matches!(m.kind, MoveKind::Dwell { .. });
    }
}

/// Gathers what the interpreter hands out. Stretches that were written come back to be filled again: what one thread
/// allocates another would free, and wait for it.
pub(super) struct Gather<'m> {
    nominal: AxisPath<'m>,
    preparer: Preparer<'m>,
    table: &'m LineTable<'m>,
    stretch: Stretch,
    tokens: Vec<Token>,
    /// `None` as soon as no receiver is left.
    to: Option<SyncSender<Stretch>>,
    back: Receiver<Stretch>,
    points: u64,
    progress: Progress<'m>,
    /// The last line of the program itself.
    line: u32,
}

/// The other end of a [`Gather`].
pub(super) struct Stretches {
    /// In the order of the program.
    pub next: Receiver<Stretch>,
    /// For those that were written.
    pub written: SyncSender<Stretch>,
}

impl<'m> Gather<'m> {
    /// With the end at which the stretches come out.
    pub fn along(
        (nominal, mut preparer): (AxisPath<'m>, Preparer<'m>),
        table: &'m LineTable<'m>,
        progress: Progress<'m>,
    ) -> (Self, Stretches) {
        let (to, next) = sync_channel(WAITING);
        let (written, back) = sync_channel(WAITING + 2);
        let (stretch, tokens, to) = (Stretch::default(), Vec::new(), Some(to));
        let (points, line) = (0, 0);
        preparer.count_by(0, nominal.shared_control());
        let gather =
            Self { nominal, preparer, table, stretch, tokens, to, back, points, progress, line };
        (gather, Stretches { next, written })
    }

    /// An empty stretch.
    fn empty(&mut self) -> Stretch {
        let Ok(mut stretch) = self.back.try_recv() else { return Stretch::default() };
        stretch.steps.clear();
        stretch.nodes.clear();
        stretch.words.clear();
        stretch
    }

    /// Reads the words of a line of the program; their number in the stretch.
    fn words(&mut self, line: u32) -> usize {
        let words = self.table.words_with(line, &mut self.tokens);
        self.stretch.words.push(words);
        self.stretch.words.len() - 1
    }

    fn send(&mut self) {
        (self.progress)(WRITING * f64::from(self.line) / self.table.count() as f64);
        self.preparer.prepare(&mut self.stretch);
        let next = self.empty();
        let stretch = std::mem::replace(&mut self.stretch, next);
        let heard = self.to.as_ref().is_some_and(|to| to.send(stretch).is_ok());
        if !heard {
            self.to = None;
        }
    }

    /// Nothing more comes.
    pub fn finish(mut self) {
        self.send();
    }
}

impl Follower for Gather<'_> {
    fn take(&mut self, step: Step) {
        if self.to.is_none() {
            // The interpreter goes on and asks where the axes are.
            self.nominal.take(&step, &mut |_| {});
            return;
        }
        let begin = *self.nominal.command();
        let nodes = &mut self.stretch.nodes;
        let from = nodes.len();
        self.nominal.take(&step, &mut |step| {
            if let PathStep::Node(node) = step {
                nodes.push(node);
            }
        });
        if matches!(step, Step::Event(Event::ToolLength(_), _)) {
            self.preparer.count_by(nodes.len(), self.nominal.shared_control());
        }
        let fault = self.nominal.faults.pop();
        let tool = match step {
            Step::Event(Event::ToolChange(number), _) => Some(number),
            _ => None,
        };
        let cuts = matches!(step, Step::Move(m) if is_cut(&m));
        let nodes = from..nodes.len();
        self.points += nodes.len() as u64;
        let lead = Lead::default();
        let words = match &step {
            Step::Move(m) if m.origin.program == 0 && m.origin.line > 0 => {
                // A jump back is no step back.
                self.line = self.line.max(m.origin.line);
                Some(self.words(m.origin.line))
            }
            _ => None,
        };
        self.stretch.steps.push(Ahead { step, begin, nodes, lead, words, fault });
        if cuts {
            lead_to_cut(&mut self.stretch.steps);
        }
        let full = self.stretch.nodes.len() >= NODES || self.stretch.steps.len() >= STEPS;
        // Rapids wait for the cut that they lead to.
        let waits = !cuts && self.stretch.steps.len() < 4 * STEPS;
        if tool.is_some() || full && !waits {
            self.send();
        }
        if let Some(number) = tool {
            self.preparer.change_tool(number);
        }
    }

    fn points(&self) -> u64 {
        self.points
    }

    fn axes(&self) -> Option<&dyn FollowingAxes> {
        Some(&self.nominal)
    }
}
