//! Tools by number and by name, and their lengths.

use super::words::{ToolCall, Words};
use super::{Run, fault};
use crate::execution::mistakes;
use crate::moves::Event;
use crate::text::program::Fault;

/// Tools that only have a name here are numbered from this.
const FIRST_NAMED: u32 = 10_001;

impl Run<'_> {
    /// T and D of a block.
    pub(super) fn tool_words(&mut self, words: &mut Words) -> Result<(), Fault> {
        if let Some((tool, at)) = words.tool.take() {
            let number = match tool {
                ToolCall::Number(number) => number,
                ToolCall::Name(name) => {
                    let number = self.tool_named(&name, at)?;
                    self.core.emit(Event::ToolName(name));
                    number
                }
            };
            self.core.select_tool(number);
        }
        let changes = words.m.iter().any(|(m, _)| *m == 6);
        if let Some((edge, at)) = words.edge
            && !changes
        {
            self.modes.edge = edge;
            self.apply_edge(at)?;
        }
        Ok(())
    }

    fn tool_named(&mut self, name: &str, at: usize) -> Result<u32, Fault> {
        let known = &self.core.settings.tool_names;
        let same =
            |(other, number): (&String, &u32)| other.eq_ignore_ascii_case(name).then_some(*number);
        if let Some(number) = known.get(name).copied().or_else(|| known.iter().find_map(same)) {
            return Ok(number);
        }
        // T="12" names the tool by its number.
        if let Ok(number) = name.parse() {
            return Ok(number);
        }
        if let Some(number) = self.names.get(name) {
            return Ok(*number);
        }
        let mut number = FIRST_NAMED + self.names.len() as u32;
        while self.core.settings.tool_names.values().any(|n| *n == number) {
            number += 1;
        }
        if self.names.len() >= 100_000 {
            let message = "more than 100000 tool names";
            return Err(fault("bad-tool", at, message, "check whether the file is an NC program"));
        }
        let message = format!("unknown tool {name}: the number {number} is assigned");
        self.core.warn("unknown-tool", name, at, message, "state the tool in the set-up file");
        self.names.insert(name.to_owned(), number);
        Ok(number)
    }

    /// M6: the selected tool comes into the spindle; its first cutting edge is active.
    pub(super) fn change_tool(&mut self, edge: Option<u32>, at: usize) {
        self.modes.edge = edge.unwrap_or(1);
        self.core.change_tool();
        self.apply_length(at);
    }

    fn apply_edge(&mut self, at: usize) -> Result<(), Fault> {
        if self.modes.edge > 1 {
            let message = format!("cutting edge D{}: the length of D1 is used", self.modes.edge);
            let hint = "the tool table has one length for each tool";
            self.core.warn("unknown-cutting-edge", self.modes.edge, at, message, hint);
        }
        self.apply_length(at);
        Ok(())
    }

    /// Makes the length of the tool in the spindle valid along the normal of the plane.
    pub(super) fn apply_length(&mut self, at: usize) {
        let (tool, edge, plane) = (self.core.modes.tool, self.modes.edge, self.core.modes.plane);
        let mut length = crate::moves::Position::default();
        if edge > 0 && tool > 0 {
            if !self.chain.tools.contains_key(&tool) {
                self.core.unknown_length(tool, at);
            }
            length = self.chain.tool_length(tool, plane);
        }
        if length != self.chain.tool {
            if self.chain.change(|c| c.tool = length) {
                self.core.emit(Event::ToolLength(length));
            } else {
                let fault = mistakes::flat_frame(at);
                self.core.report(fault);
            }
        }
        self.other_radius(at);
    }
}
