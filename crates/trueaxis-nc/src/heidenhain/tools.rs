//! TOOL CALL, TOOL DEF and the blank.

use super::line::Cursor;
use super::words::split_address;
use super::{Run, fault};
use crate::execution::mistakes;
use crate::moves::{Axis, Event, Plane, Position};
use crate::text::program::Fault;

impl Run<'_> {
    pub(super) fn tool_statement(&mut self, c: &mut Cursor<'_>) -> Result<(), Fault> {
        match c.accept_any(&["CALL", "DEF"]) {
            Some(0) => self.tool_call(c),
            Some(_) => self.tool_definition(c),
            None => Err(c.unknown()),
        }
    }

    /// The number of a tool, by number or by name; the event of its name is reported.
    fn tool_number(&mut self, c: &mut Cursor<'_>) -> Result<Option<u32>, Fault> {
        let at = c.offset();
        let name = match c.text() {
            Some(name) => Some(name),
            None if c.is("QS") => Some(self.text(c)?),
            None => None,
        };
        if let Some(name) = name {
            let number = self.core.settings.tool_names.get(&name).copied();
            if number.is_none() {
                let message = format!("unknown tool `{name}`: number 0 is used");
                self.core.warn(
                    "unknown-tool-name",
                    &name,
                    at,
                    &message,
                    "state the tools with their names in the set-up file",
                );
            }
            self.core.emit(Event::ToolName(name));
            return Ok(Some(number.unwrap_or(0)));
        }
        match self.operand(c)? {
            None => Ok(None),
            // 5.2 is the second edge of tool 5.
            Some(n) if (0.0..1e9).contains(&n) => Ok(Some(n as u32)),
            Some(n) => Err(mistakes::bad_tool(n, at)),
        }
    }

    /// TOOL CALL 5 Z S2500 F350 DL+0.2 DR-1.
    fn tool_call(&mut self, c: &mut Cursor<'_>) -> Result<(), Fault> {
        let at = c.offset();
        let called = self.tool_number(c)?;
        let (mut axis, mut speed, mut feed) = (None, None, None);
        let mut excess = [0.0; 2];
        while !c.done() && !c.is("M") {
            if let Some(index) = c.accept_any(&["X", "Y", "Z", "U", "V", "W"]) {
                axis = Some([Axis::X, Axis::Y, Axis::Z, Axis::U, Axis::V, Axis::W][index]);
                continue;
            }
            match split_address(c) {
                Some("S") => speed = Some(self.value(c)?),
                Some("F") => feed = Some(self.feed_word(c, Some("F"))?),
                Some("DL") => excess[0] = self.value(c)? * self.core.modes.unit_mm(),
                Some("DR") => {
                    let value = self.value(c)?;
                    // DR2: the excess of the corner radius.
                    if value == 2.0 && (c.is_number() || matches!(c.symbol(), Some(b'+' | b'-'))) {
                        self.value(c)?;
                    } else {
                        excess[1] = value * self.core.modes.unit_mm();
                    }
                }
                _ => return Err(c.unknown()),
            }
        }
        let (axis_given, number) = (axis.is_some(), called);
        if let Some(axis) = axis {
            self.tool_axis(axis);
        }
        if let Some(number) = number {
            self.change_tool(number, excess, at, axis_given)?;
        }
        self.core.set_speed(speed);
        if let Some(super::words::FeedWord::PerMinute(value)) = feed {
            self.modes.feed_of_tool = value;
            self.core.modes.feed.value = value;
        }
        if !c.done() {
            let words = self.words(c)?;
            words.only_functions()?;
            let _ = self.functions(&words, false)? || self.functions(&words, true)?;
        }
        Ok(())
    }

    /// The axis of the tool is that on which the plane of circles stands.
    fn tool_axis(&mut self, axis: Axis) {
        let plane = match axis {
            Axis::X | Axis::U => Plane::Yz,
            Axis::Y | Axis::V => Plane::Zx,
            _ => Plane::Xy,
        };
        self.modes.tool_axis = Some(axis);
        if plane != self.core.modes.plane {
            self.pole = None;
            self.core.select_plane(plane);
        }
    }

    fn change_tool(
        &mut self,
        number: u32,
        excess: [f64; 2],
        at: usize,
        with_axis: bool,
    ) -> Result<(), Fault> {
        if self.modes.tool_axis.is_none() && number != 0 && !with_axis {
            self.modes.tool_axis = Some(self.core.modes.plane.axes()[2]);
        }
        let entry = self.tools.get(&number).copied();
        if entry.is_none() && number != 0 {
            self.core.unknown_length(number, at);
        }
        let (length, radius) = entry.unwrap_or((0.0, None));
        self.core.modes.tool = number;
        self.modes.tool_radius_mm = radius.map(|r| r + excess[1]);
        let length_mm = if number == 0 { 0.0 } else { length + excess[0] };
        // The axes stay where they are, so a longer tool stands lower in the program.
        let along = self.core.modes.plane.axes()[2];
        self.frames.position[along] += self.modes.tool_length_mm - length_mm;
        self.modes.tool_length_mm = length_mm;
        self.tangent = None;
        self.core.emit(Event::ToolChange(number));
        let mut length = Position::default();
        length[along] = length_mm;
        self.core.emit(Event::ToolLength(length));
        Ok(())
    }

    /// TOOL DEF 5 L+10 R+5 sets the table; TOOL DEF 5 alone prepares the tool.
    fn tool_definition(&mut self, c: &mut Cursor<'_>) -> Result<(), Fault> {
        let at = c.offset();
        let Some(number) = self.tool_number(c)? else {
            let message = "the number of the tool is missing";
            return Err(fault("bad-tool", at, message, "write TOOL DEF 1 L+0 R+5"));
        };
        if c.done() {
            self.core.emit(Event::ToolSelect(number));
            return Ok(());
        }
        let (mut length, mut radius) = (0.0, None);
        while !c.done() {
            match split_address(c) {
                Some("L") => length = self.value(c)? * self.core.modes.unit_mm(),
                Some("R") => radius = Some(self.value(c)? * self.core.modes.unit_mm()),
                _ => return Err(c.unknown()),
            }
        }
        self.tools.insert(number, (length, radius));
        Ok(())
    }

    /// BLK FORM 0.1 Z X Y Z and 0.2 X Y Z: two corners of a box.
    pub(super) fn blank_form(&mut self, c: &mut Cursor<'_>) -> Result<(), Fault> {
        let at = c.start;
        if !c.accept("FORM") {
            return Err(c.unknown());
        }
        let corner = match c.number()? {
            Some(0.1) => 1,
            Some(0.2) => 2,
            _ => {
                c.leave();
                self.core.emit(Event::Note("BLK FORM: a blank that is no box"));
                return Ok(());
            }
        };
        if corner == 1 {
            // The axis of the tool has no value: `Z X+0 Y+0 Z-20`.
            let mut ahead = c.clone();
            let index = ahead.accept_any(&["X", "Y", "Z"]);
            if index.is_some() && !matches!(ahead.symbol(), Some(b'+' | b'-')) && !ahead.is_number()
            {
                *c = ahead;
            }
        }
        let words = self.words(c)?;
        words.only_axes(&[Axis::X, Axis::Y, Axis::Z])?;
        let first = self.blank.unwrap_or_default();
        let now = if corner == 2 { first } else { [0.0; 3] };
        let mut place = [0.0; 3];
        for (i, value) in place.iter_mut().enumerate() {
            *value = words.axes[i].map_or(now[i], |w| w.from(now[i]));
        }
        if corner == 1 {
            self.blank = Some(place);
            return Ok(());
        }
        if self.blank.is_none() {
            let message = "BLK FORM 0.2 without 0.1: the other corner is assumed at zero";
            self.core.warn(
                "blank-without-corner",
                "blank",
                at,
                message,
                "write BLK FORM 0.1 before it",
            );
        }
        self.blank = None;
        if !place.iter().chain(&first).all(|v| v.abs() < 1e9) {
            let message = "a corner of the blank is too far away";
            return Err(fault("too-large", at, message, "check the numbers of the block"));
        }
        let min_mm = std::array::from_fn(|i| first[i].min(place[i]));
        let max_mm = std::array::from_fn(|i| first[i].max(place[i]));
        self.core.emit(Event::Stock { min_mm, max_mm });
        Ok(())
    }
}
