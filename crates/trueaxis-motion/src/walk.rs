//! A program on the actual machine: read and followed by one thread, timed and evaluated by another, in the order of the program.
//!
//! ```text
//!     interpreter ──Step──> Leader: AxisPath ──Lot──> channel ──> Walk: clock, poses ──> observers
//! ```
//!
//! What comes out does not depend on how far the one is ahead of the other.

use super::axis_path::{AxisPath, Fault, Node, PathStep};
use super::clock::{Clock, Stamp, Timing};
use super::equipment::EquipmentWatch;
use super::setup::SetUp;
use super::temperatures::Present;
use super::timing::Element;
use super::tool_path::{BATCH, ToolPath};
use super::{Observer, Options, Stop};
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use trueaxis_machine::Machine;
use trueaxis_machine::axis::Command;
use trueaxis_nc::moves::Step;
use trueaxis_nc::{Follower, FollowingAxes, Outcome};

/// Items of a lot.
const TOGETHER: usize = 1024;
/// Lots that wait, some 300 kB each.
const WAITING: usize = 4;

/// What the leader found, in the order of the program.
enum Item {
    /// The next of the steps.
    Step,
    /// The next of the elements, and its length.
    Element(f64),
    Node(Node),
    Abandoned,
    Tool(u32),
}

/// Items that are handed on together. Emptied ones come back to be filled again: what one thread allocates another would free.
#[derive(Default)]
struct Lot {
    items: Vec<Item>,
    steps: Vec<Step>,
    elements: Vec<Element>,
}

/// Follows the program with the axes and hands on what it finds.
pub(super) struct Leader<'m> {
    path: AxisPath<'m>,
    keep_going: bool,
    stop: &'m Stop,
    points: u64,
    /// How many steps were followed, and at which of them each fault of the path came.
    steps: u64,
    faulty: Vec<u64>,
    sent: Sent,
}

/// What is handed on, lot by lot.
struct Sent {
    lot: Lot,
    /// None as soon as the other end is gone.
    to: Option<SyncSender<Lot>>,
    /// Emptied lots.
    back: Receiver<Lot>,
}

impl Sent {
    fn step(&mut self, step: &Step) {
        self.lot.steps.push(step.clone());
        self.push(Item::Step);
    }

    fn path(&mut self, step: PathStep) {
        let item = match step {
            PathStep::Element { element, length } => {
                self.lot.elements.push(*element);
                Item::Element(length)
            }
            PathStep::Node(node) => Item::Node(node),
            PathStep::Abandoned => Item::Abandoned,
            PathStep::Tool(number) => Item::Tool(number),
        };
        self.push(item);
    }

    fn push(&mut self, item: Item) {
        self.lot.items.push(item);
        if self.lot.items.len() >= TOGETHER {
            self.send();
        }
    }

    fn send(&mut self) {
        let lot = std::mem::replace(&mut self.lot, self.back.try_recv().unwrap_or_default());
        let is_received = self.to.as_ref().is_some_and(|to| to.send(lot).is_ok());
        if !is_received {
            self.to = None;
        }
    }
}

impl Leader<'_> {
    /// The faults of its path with the steps at which they came; nothing more is sent.
    fn finish(mut self) -> Vec<(u64, Fault)> {
        self.sent.send();
        self.faulty.into_iter().zip(self.path.faults).collect()
    }
}

impl Follower for Leader<'_> {
    fn take(&mut self, step: Step) {
        // Without `keep_going` the first fault ends the simulation.
        let goes_on = self.keep_going || self.path.faults.is_empty();
        if self.stop.is_requested() {
            return;
        }
        if !goes_on || self.sent.to.is_none() {
            // The interpreter goes on and asks where the axes are.
            self.path.take(&step, &mut |_| {});
            return;
        }
        self.sent.step(&step);
        let (sent, points) = (&mut self.sent, &mut self.points);
        self.path.take(&step, &mut |step| {
            *points += 1;
            sent.path(step);
        });
        self.steps += 1;
        self.faulty.resize(self.path.faults.len(), self.steps);
    }

    fn points(&self) -> u64 {
        self.points
    }

    fn axes(&self) -> Option<&dyn FollowingAxes> {
        Some(&self.path)
    }
}

/// Leads what is found ahead through clock and poses.
pub(super) struct Walk<'w, 'o> {
    stretch: Stretch<'w, 'o>,
    watch: EquipmentWatch,
    keep_going: bool,
    steps: u64,
    is_ended: bool,
}

/// How a walk ended.
pub(super) struct Walked {
    pub outcome: Outcome,
    /// Of the path, then of times and poses.
    pub faults: Vec<Fault>,
    pub watch: EquipmentWatch,
}

impl<'w, 'o> Walk<'w, 'o> {
    /// With the path that its leader goes.
    pub fn new(
        machine: &'w Machine,
        present: Present,
        setup: &'w SetUp,
        (options, watch): (&'w Options, EquipmentWatch),
        observers: &'w mut [&'o mut dyn Observer],
    ) -> (Self, AxisPath<'w>) {
        let mut path = AxisPath::new(machine, setup, options.densify, options.rounding_mm);
        if options.timing == Timing::LookAhead {
            path = path.with_elements();
        }
        let start = *path.command();
        let stretch = Stretch {
            setup,
            stop: &options.stop,
            clock: Clock::new(machine, start, options.timing),
            tool_path: ToolPath::new(present.compiled(), start),
            present,
            tool: 0,
            at: start,
            // Where the axes are before the program.
            nodes: vec![path.start()],
            stamps: vec![Stamp::default()],
            observers,
            faults: Vec::new(),
        };
        let keep_going = options.keep_going;
        (Self { stretch, watch, keep_going, steps: 0, is_ended: false }, path)
    }

    /// All of a program that a leader is led through.
    pub fn along(
        mut self,
        path: AxisPath<'_>,
        lead: impl FnOnce(&mut Leader<'_>) -> Outcome + Send,
    ) -> Walked {
        let (to, from) = sync_channel(WAITING);
        let (emptied, back) = sync_channel(WAITING + 2);
        let mut leader = Leader {
            path,
            keep_going: self.keep_going,
            stop: self.stretch.stop,
            points: 0,
            steps: 0,
            faulty: Vec::new(),
            sent: Sent { lot: Lot::default(), to: Some(to), back },
        };
        let (outcome, found) = std::thread::scope(|scope| {
            let ahead = scope.spawn(move || {
                let outcome = lead(&mut leader);
                (outcome, leader.finish())
            });
            self.take_all(from, &emptied);
            ahead.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic))
        });
        self.stretch.rest();
        // What the leader met after the end of the walk does not count.
        let met = found.into_iter().filter(|(step, _)| *step <= self.steps);
        let mut faults: Vec<Fault> = met.map(|(_, fault)| fault).collect();
        faults.append(&mut self.stretch.faults);
        Walked { outcome, faults, watch: self.watch }
    }

    fn take_all(&mut self, from: Receiver<Lot>, emptied: &SyncSender<Lot>) {
        for mut lot in from {
            let (mut steps, mut elements) = (lot.steps.drain(..), lot.elements.drain(..));
            for item in lot.items.drain(..) {
                match item {
                    Item::Step => steps.next().iter().for_each(|step| self.see(step)),
                    Item::Element(length) => {
                        let element = elements.next().filter(|_| !self.is_ended);
                        element.into_iter().for_each(|e| self.stretch.clock.begin(e, length));
                    }
                    _ if self.is_ended => {}
                    Item::Node(node) => self.stretch.take(node),
                    Item::Abandoned => self.stretch.abandon(),
                    Item::Tool(number) => self.stretch.change_tool(number),
                }
            }
            drop((steps, elements));
            // Of no use to a leader that has ended, or that has enough of them.
            let _ = emptied.try_send(lot);
        }
    }

    fn see(&mut self, step: &Step) {
        let is_sound = self.keep_going || self.stretch.faults.is_empty();
        self.is_ended |= !is_sound || self.stretch.stop.is_requested();
        if !self.is_ended {
            self.steps += 1;
            self.stretch.observers.iter_mut().for_each(|o| o.step(step));
            self.watch.see(step);
        }
    }
}

/// The stretch of the path that waits for its times and poses.
struct Stretch<'w, 'o> {
    present: Present,
    setup: &'w SetUp,
    stop: &'w Stop,
    clock: Clock,
    tool_path: ToolPath,
    tool: u32,
    /// Where the axes are.
    at: Command,
    nodes: Vec<Node>,
    stamps: Vec<Stamp>,
    observers: &'w mut [&'o mut dyn Observer],
    faults: Vec<Fault>,
}

impl Stretch<'_, '_> {
    fn take(&mut self, node: Node) {
        // A full circle ends where it began.
        if node.command == self.at && node.dwell_s == 0.0 && !self.clock.on_element() {
            return;
        }
        let stamps = &mut self.stamps;
        match self.clock.push(&node, &mut |stamp| stamps.push(stamp)) {
            Ok(()) => {
                self.at = node.command;
                self.nodes.push(node);
            }
            Err(error) => {
                self.abandon();
                self.faults.push(Fault::untimed(&node, &error));
            }
        }
        if self.stamps.len() >= BATCH {
            self.evaluate();
        }
    }

    /// Nodes of a move that does not come to its end get no time.
    fn abandon(&mut self) {
        let left = self.clock.drop_element();
        self.nodes.truncate(self.nodes.len().saturating_sub(left));
    }

    /// All nodes that have their time, in batches of one temperature.
    fn evaluate(&mut self) {
        while let Some(first) = self.stamps.first().filter(|_| !self.stop.is_requested()) {
            match self.present.advance(first.time_s) {
                Ok(true) => {
                    let since_s = self.present.since_s();
                    self.tool_path.change_temperatures(self.present.compiled(), since_s);
                }
                Ok(false) => {}
                Err(message) => self.faults.push(Fault::untempered(&self.nodes[0], message)),
            }
            let most = self.stamps.len().min(BATCH);
            // The first one at least: it is why the machine is as it is.
            let count = self.present.holds(&self.stamps[1..most]) + 1;
            let (nodes, stamps) = (&self.nodes[..count], &self.stamps[..count]);
            let batch = self.tool_path.evaluate(self.tool, nodes, stamps, &mut self.faults);
            self.observers.iter_mut().for_each(|o| o.path(&batch));
            self.nodes.drain(..count);
            self.stamps.drain(..count);
        }
    }

    /// The axes rest while the tool is changed.
    fn change_tool(&mut self, number: u32) {
        self.rest();
        self.tool = number;
        if let Some(tool) = self.setup.tools.get(&number) {
            self.present.change_tip(tool.tip_mm);
            self.tool_path.change_tool(self.present.compiled());
        }
    }

    fn rest(&mut self) {
        let stamps = &mut self.stamps;
        self.clock.finish(&mut |stamp| stamps.push(stamp));
        self.evaluate();
    }
}
