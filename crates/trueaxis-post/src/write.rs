//! Legs as blocks: safe start and end, events, moves.

use crate::ahead::{Cuts, Piece};
use crate::axes::{BLOCK, Leg};
use crate::cut::{Cutter, Node};
use crate::feed::feed_of;
use crate::path::{Event, Path, Stand};
use crate::{BlockPlace, Fault, HolePlace, Places, PostOptions};
use trueaxis_cl::ClTool;
use trueaxis_geometry::Vec3;
use trueaxis_input::{in_order, usual_threads};
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{AxisKind, Travel};
use trueaxis_machine::tcp::TipControl;
use trueaxis_nc::moves::{Axis, Coordinates, Feed, SpindleDirection};
use trueaxis_writer::{
    Block, Heading, Hole, Target, Templates, TipWords, ToolCall, WriteError, Writer,
    axis_coordinates,
};

/// No control takes a longer program, and no memory should.
const MOST_BLOCKS: usize = 10_000_000;

/// Everything that is needed while the text grows.
pub(crate) struct Post<'p> {
    pub machine: &'p Machine,
    pub control: &'p TipControl,
    pub options: &'p PostOptions,
    pub path: &'p Path,
    pub cutter: &'p Cutter<'p>,
    writer: Writer,
    /// The axis of programs for each axis of the machine.
    pub names: Vec<Axis>,
    pub coordinates: Coordinates,
    /// Lines written so far.
    pub line: u32,
    pub places: Places,
    pub drilled: Vec<HolePlace>,
    /// The cycle that is on.
    pub hole: Option<Hole>,
    pub blocks: usize,
    pub arcs: usize,
}

/// What was written.
pub(crate) struct Written {
    pub text: Vec<u8>,
    pub lines: usize,
    pub places: Places,
    pub drilled: Vec<HolePlace>,
    pub blocks: usize,
    pub arcs: usize,
}

fn names(machine: &Machine) -> Result<Vec<Axis>, Fault> {
    let of = |letter: char| Axis::ALL.into_iter().find(|a| char::from(a.letter()) == letter);
    let names: Option<Vec<Axis>> =
        machine.axes().iter().map(|axis| of(axis.name.letter())).collect();
    names.ok_or_else(|| Fault {
        line: 0,
        code: "unknown-axis",
        message: "an axis of the machine has no letter that programs know".into(),
        hint: "X Y Z A B C U V W are known",
    })
}

impl<'p> Post<'p> {
    /// A program with its first lines.
    pub fn begin(
        machine: &'p Machine,
        path: &'p Path,
        cutter: &'p Cutter<'p>,
        options: &'p PostOptions,
    ) -> Result<Self, Fault> {
        let templates = options.templates.clone().unwrap_or_else(|| Templates::of(options.control));
        let mut post = Self {
            machine,
            control: cutter.control,
            options,
            path,
            cutter,
            writer: Writer::with(options.control, options.decimals, templates),
            names: names(machine)?,
            coordinates: axis_coordinates(options.control),
            line: 0,
            places: Places::default(),
            drilled: Vec::new(),
            hole: None,
            blocks: 0,
            arcs: 0,
        };
        post.heading()?;
        Ok(post)
    }

    pub(crate) fn block(&mut self, block: &Block<'_>, line: u32) -> Result<(), Fault> {
        self.try_block(block).map_err(|e| unwritable(&e, line))
    }

    pub(crate) fn try_block(&mut self, block: &Block<'_>) -> Result<(), WriteError> {
        let before = self.writer.text().len();
        self.writer.write(block)?;
        let new = &self.writer.text()[before..];
        self.line += new.iter().filter(|b| **b == b'\n').count() as u32;
        Ok(())
    }

    fn heading(&mut self) -> Result<(), Fault> {
        let made = format!("trueaxis post for {}", self.machine.name());
        let tip = self.machine.tip_mm();
        let tool =
            format!("tool length {:.4} mm, tolerance {} mm", -tip.z, self.options.tolerance_mm);
        let upright = "work offset at the workpiece zero, tool lengths in the control";
        let length = self.options.tip_words == Some(TipWords::Length);
        let comments = [&made, &tool, upright];
        let heading = Heading {
            name: &self.options.name,
            number: self.options.number,
            comments: if length { &comments } else { &comments[..2] },
            machine_coordinates: self.options.tip_words.is_none(),
            tolerance_mm: 0.5 * self.options.tolerance_mm,
        };
        self.block(&Block::Start(&heading), 0)?;
        let named = |e: &(usize, Event)| e.0 == 0 && matches!(e.1, Event::Tool(..));
        if !self.path.events.iter().any(named) {
            self.tool(&ClTool { number: 1, ..ClTool::default() })?;
        }
        Ok(())
    }

    /// The last lines.
    pub fn end(mut self) -> Result<Written, Fault> {
        self.events(self.path.strokes.len())?;
        self.block(&Block::End, 0)?;
        let Self { writer, line, places, drilled, blocks, arcs, .. } = self;
        Ok(Written { text: writer.finish(), lines: line as usize, places, drilled, blocks, arcs })
    }

    fn tool(&mut self, tool: &ClTool) -> Result<(), Fault> {
        let ClTool { number, offset, .. } = *tool;
        self.block(&Block::Tool(&ToolCall { number, offset, ..ToolCall::default() }), 0)
    }

    /// What happens before a stroke.
    pub(crate) fn events(&mut self, stroke: usize) -> Result<(), Fault> {
        let path = self.path;
        let from = path.events.partition_point(|(at, _)| *at < stroke);
        for (_, event) in path.events[from..].iter().take_while(|(at, _)| *at == stroke) {
            match event {
                Event::Tool(tool, _) => self.tool(tool)?,
                Event::Spindle(turning, speed) => {
                    let speed = if *turning == SpindleDirection::Stopped { 0.0 } else { *speed };
                    self.block(&Block::Spindle(*turning, speed), 0)?;
                }
                Event::Coolant(coolant) => self.block(&Block::Coolant(*coolant), 0)?,
                Event::Dwell(seconds) => self.block(&Block::Dwell(*seconds), 0)?,
                Event::Stop { optional } => {
                    self.block(&Block::Stop { optional: *optional, message: None }, 0)?;
                }
                Event::Comment(text) => self.block(&Block::Comment(text), 0)?,
            }
        }
        Ok(())
    }

    /// The strokes of a leg. The cuts of each block of them are found on any thread, and written in order.
    pub fn leg(&mut self, leg: &Leg<'_>) -> Result<(), Fault> {
        if leg.cuts_first {
            self.events(leg.first)?;
        }
        let begin = self.end_of(leg, leg.first);
        self.enter(leg, &begin)?;
        let mut at = begin;
        let mut result = Ok(());
        let (cutter, path) = (self.cutter, self.path);
        let strokes = leg.first + 1..leg.end();
        let find = |block: usize, cuts: &mut Cuts| {
            let first = strokes.start + block * BLOCK;
            cuts.find(cutter, path, leg, first..strokes.end.min(first + BLOCK));
        };
        let mut next = strokes.start;
        in_order(strokes.len().div_ceil(BLOCK), usual_threads(), &find, &mut |cuts| {
            result = self.strokes(leg, cuts, &mut next, &mut at);
            result.is_ok()
        });
        result?;
        self.end_holes()?;
        self.leave(&at)
    }

    /// A block of strokes, from the next one that is not written.
    fn strokes(
        &mut self,
        leg: &Leg<'_>,
        cuts: &mut Cuts,
        next: &mut usize,
        at: &mut Node,
    ) -> Result<(), Fault> {
        while *next < cuts.strokes().end {
            let index = *next;
            *next += 1;
            if let Some(last) = self.drill(leg, index, at)? {
                (*next, *at) = (last + 1, self.end_of(leg, last));
                continue;
            }
            self.end_holes()?;
            self.events(index)?;
            let Some(found) = cuts.of(index) else {
                *at = self.stroke(leg, index, at)?;
                continue;
            };
            for Piece { from, to, feed } in found.pieces {
                self.go(to, *feed, Some((index, Some(*from))), found.line)?;
                *at = *to;
            }
            if let Some(fault) = found.fault {
                return Err(fault.clone());
            }
        }
        Ok(())
    }

    /// A stroke that was not cut ahead; where it ends.
    fn stroke(&mut self, leg: &Leg<'_>, index: usize, at: &Node) -> Result<Node, Fault> {
        let stroke = self.path.strokes.get(index);
        let (from, end) = (Node { u: 0.0, ..*at }, self.end_of(leg, index));
        if self.write_circle(&stroke, [&from, &end], leg, index)? {
            return Ok(end);
        }
        let (cutter, command) = (self.cutter, leg.command(self.path, index));
        cutter.pieces(&stroke, &from, command, &mut |piece| {
            self.go(&piece.to, piece.feed, Some((index, Some(piece.from))), stroke.line)
        })
    }

    /// The end of a stroke of a leg.
    pub(crate) fn end_of(&self, leg: &Leg<'_>, index: usize) -> Node {
        self.cutter.end_of(self.path, leg, index)
    }

    /// To the beginning of a leg: up, over it, down along the tool axis.
    fn enter(&mut self, leg: &Leg<'_>, begin: &Node) -> Result<(), Fault> {
        let stroke = self.path.strokes.get(leg.first);
        let line = stroke.line;
        self.raise_z(line)?;
        let above = self.above(begin);
        let mut over = Target::default().from_machine_zero();
        for (i, name) in self.names.iter().enumerate().filter(|(_, n)| **n != Axis::Z) {
            over = over.at(*name, self.shown(i, above.command[i]));
        }
        self.block(&Block::Rapid(over), line)?;
        if let Some(words) = self.options.tip_words {
            self.block(&Block::TipOn(words), line)?;
        }
        self.go(&above, None, None, line)?;
        let after = (leg.first + 1).min(self.path.strokes.len() - 1);
        let next = self.path.strokes.get(after);
        let (rapid, feed) = match leg.cuts_first {
            true => (stroke.rapid, stroke.feed),
            false => (next.rapid, next.feed),
        };
        let feed = (!rapid).then(|| feed_of(self.machine, self.options, &above, begin, feed));
        self.go(begin, feed, leg.cuts_first.then_some((leg.first, None)), line)
    }

    /// From the end of a leg: back along the tool axis and up.
    fn leave(&mut self, end: &Node) -> Result<(), Fault> {
        let above = self.above(end);
        self.go(&above, None, None, 0)?;
        if self.options.tip_words.is_some() {
            self.block(&Block::TipOff, 0)?;
        }
        self.raise_z(0)
    }

    /// As far back along the tool axis as is wanted and the travel allows.
    fn above(&self, node: &Node) -> Node {
        let mut distance = self.options.retract_mm;
        while distance > 0.05 {
            let tip = node.stand.tip + node.stand.axis * distance;
            let stand = Stand { tip, ..node.stand };
            let mut command = node.command;
            if self.control.place(tip, &mut command) && self.cutter.inside(&command, 0).is_ok() {
                return Node { stand, command, ..*node };
            }
            distance *= 0.5;
        }
        *node
    }

    /// Z to the end of its travel, away from the part.
    fn raise_z(&mut self, line: u32) -> Result<(), Fault> {
        let at = self.names.iter().position(|n| *n == Axis::Z);
        let Some((axis, Travel::Between(_, high))) =
            at.map(|i| (Axis::Z, self.machine.axes()[i].travel))
        else {
            return Ok(());
        };
        let target = Target::default().at(axis, high).from_machine_zero();
        self.block(&Block::Rapid(target), line)
    }

    fn shown(&self, axis: usize, q: f64) -> f64 {
        match self.machine.axes()[axis].kind {
            AxisKind::Linear => q,
            AxisKind::Rotary => q.to_degrees(),
        }
    }

    /// A block to a place; `stroke` where it is on the path, with the place on it from which the tool
    /// comes along the stroke.
    pub(crate) fn go(
        &mut self,
        node: &Node,
        feed: Option<Feed>,
        stroke: Option<(usize, Option<f64>)>,
        line: u32,
    ) -> Result<(), Fault> {
        self.cutter.inside(&node.command, line)?;
        let target = self.target(node);
        let block = match feed {
            Some(feed) => Block::Line(target, feed),
            None => Block::Rapid(target),
        };
        let before = self.line;
        self.block(&block, line)?;
        if let (Some((stroke, from)), true) = (stroke, self.line > before) {
            let (line, stroke, until) = (self.line, stroke as u32, node.u);
            self.places.push(&BlockPlace { line, stroke, from, until });
            self.blocks += 1;
        }
        if self.blocks > MOST_BLOCKS {
            return Err(Fault {
                line,
                code: "too-many-blocks",
                message: format!("the program would have more than {MOST_BLOCKS} blocks"),
                hint: "allow a larger --tolerance or --axis-tolerance; are the units right?",
            });
        }
        Ok(())
    }

    pub(crate) fn target(&self, node: &Node) -> Target {
        let mut target = Target::default();
        let vectors = self.options.tip_words == Some(TipWords::Vectors);
        if self.options.tip_words.is_some() {
            let Stand { tip, axis } = node.stand;
            for (i, name) in [Axis::X, Axis::Y, Axis::Z].into_iter().enumerate() {
                target = target.at(name, tip[i]);
            }
            if vectors {
                return target.along(Vec3::into(axis));
            }
        } else {
            target.coordinates = self.coordinates;
        }
        for (i, name) in self.names.iter().enumerate() {
            let rotary = self.machine.axes()[i].kind == AxisKind::Rotary;
            let length = self.options.tip_words == Some(TipWords::Length);
            if rotary && !length || self.options.tip_words.is_none() {
                target = target.at(*name, self.shown(i, node.command[i]));
            }
        }
        target
    }
}

fn unwritable(error: &WriteError, line: u32) -> Fault {
    let hint = "another control, template or --feed-mode can";
    Fault { line, code: "unwritable-block", message: error.to_string(), hint }
}
