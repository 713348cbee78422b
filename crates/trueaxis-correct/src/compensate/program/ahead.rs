//! The program ahead of what is written: its steps and the places that they lead to, in stretches.
//!
//! ```text
//!     interpreter ──Step──> Ahead ──Stretch──> channel ──> Walk        one thread before, one after
//! ```

use std::ops::Range;
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use trueaxis_machine::axis::Command;
use trueaxis_motion::axis_path::{AxisPath, Fault};
use trueaxis_motion::{Node, PathStep};
use trueaxis_nc::moves::{Event, Step};

/// Places of a stretch: enough that a batch pays, few enough to stay in the cache.
const NODES: usize = 4096;

/// Steps of a stretch that lead nowhere are not gathered for ever.
const STEPS: usize = 4096;

/// Stretches that wait: each some 1 MB.
const WAITING: usize = 4;

/// Some steps of the program that follow each other, with one tool.
#[derive(Debug, Default)]
pub(super) struct Stretch {
    pub steps: Vec<Ahead>,
    /// Of all steps.
    pub nodes: Vec<Node>,
}

/// A step of the program, and where the axes go by it as it is.
#[derive(Debug)]
pub(super) struct Ahead {
    pub step: Step,
    /// Where the axes stand before it.
    pub begin: Command,
    /// Its places in the stretch.
    pub nodes: Range<usize>,
    /// Why it cannot be executed.
    pub fault: Option<Fault>,
}

/// Gathers what the interpreter hands out.
pub(super) struct Gather<'m> {
    nominal: AxisPath<'m>,
    stretch: Stretch,
    /// `None` as soon as no receiver is left.
    to: Option<SyncSender<Stretch>>,
}

impl<'m> Gather<'m> {
    /// With the end at which the stretches come out.
    pub fn along(nominal: AxisPath<'m>) -> (Self, Receiver<Stretch>) {
        let (to, from) = sync_channel(WAITING);
        (Self { nominal, stretch: Stretch::default(), to: Some(to) }, from)
    }

    pub fn take(&mut self, step: Step) {
        if self.to.is_none() {
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
        let fault = self.nominal.faults.pop();
        let changes_tool = matches!(step, Step::Event(Event::ToolChange(_), _));
        let ahead = Ahead { step, begin, nodes: from..nodes.len(), fault };
        self.stretch.steps.push(ahead);
        let full = self.stretch.nodes.len() >= NODES || self.stretch.steps.len() >= STEPS;
        if full || changes_tool {
            self.send();
        }
    }

    fn send(&mut self) {
        let stretch = std::mem::take(&mut self.stretch);
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
