use super::{Run, fault};
use crate::code::Action;
use crate::moves::{Axis, Event, MoveKind, Position};
use crate::program::Fault;

impl Run<'_> {
    /// Tool lengths, work offsets, shifts and reference points.
    pub(super) fn table(&mut self, action: Action, at: usize) -> Result<(), Fault> {
        match action {
            Action::ToolLength
            | Action::ToolLengthDirect
            | Action::ToolLengthAdd
            | Action::ToolLengthOff
            | Action::ToolCentre(_) => self.tool_length(action, at)?,
            Action::WorkOffset(index) => self.select_offset(usize::from(index) - 1),
            Action::WorkOffsetFurther => {
                let number = self.words.take(b'P').unwrap_or(1.0);
                if !(1.0..=300.0).contains(&number) {
                    let message = format!("there is no further work offset P{number}");
                    return Err(fault("bad-work-offset", at, message, "write G54.1 P1"));
                }
                // The six of G54 to G59 come first, three places are LinuxCNC's.
                self.select_offset(8 + number as usize);
            }
            Action::SetTable => self.set_table(at)?,
            Action::Shift => {
                let target = self.target_absolute();
                self.frames.change(|f| {
                    let moved = f.position.minus(&target);
                    f.shift = f.live_shift().plus(&moved);
                    f.shift_on = true;
                });
                self.emit_shift();
            }
            Action::LocalShift => {
                let mut shift = self.frames.shift;
                for axis in Axis::ALL {
                    if let Some(value) = self.axis_word(axis) {
                        shift[axis] = value;
                    }
                }
                self.change_shift(shift, true);
            }
            Action::ShiftCancel => self.change_shift(Position::default(), false),
            Action::ShiftSuspend => self.change_shift(self.frames.shift, false),
            Action::ShiftResume => self.change_shift(self.frames.shift, true),
            Action::Reference(index) => self.reference(usize::from(index) - 1),
            Action::SetReference(index) => {
                self.frames.references[usize::from(index) - 1] = self.frames.machine();
            }
            _ => {}
        }
        Ok(())
    }

    /// The axis words as they stand, the present place for the other axes.
    fn target_absolute(&mut self) -> Position {
        let mut target = self.frames.position;
        for axis in Axis::ALL {
            if let Some(value) = self.axis_word(axis) {
                target[axis] = value;
            }
        }
        target
    }

    fn emit_shift(&mut self) {
        let shift = self.frames.live_shift();
        self.emit(Event::Shift(shift));
        self.emit_frame();
    }

    fn change_shift(&mut self, shift: Position, on: bool) {
        self.frames.change(|f| (f.shift, f.shift_on) = (shift, on));
        self.emit_shift();
    }

    fn emit_offset(&mut self) {
        let work = self.frames.work();
        self.emit(Event::WorkOffset {
            index: self.frames.active as u32 + 1,
            offset: work.offset,
            rotation_deg: work.rotation_deg,
        });
        self.emit_frame();
    }

    fn select_offset(&mut self, index: usize) {
        if index == self.frames.active {
            return;
        }
        self.frames.change(|f| {
            if f.offsets.len() <= index {
                f.offsets.resize(index + 1, Default::default());
            }
            f.active = index;
        });
        self.emit_offset();
        self.emit_shift();
    }

    fn tool_length(&mut self, action: Action, at: usize) -> Result<(), Fault> {
        let number = match self.words.take(b'H') {
            Some(h) if (0.0..1e9).contains(&h) => h as u32,
            Some(h) => {
                let message = format!("H{h} is not the number of a tool length");
                return Err(fault("bad-tool", at, message, "write H1"));
            }
            None => self.modes.tool,
        };
        let mut length = self.frames.tool;
        match action {
            Action::ToolLengthOff => length = Position::default(),
            Action::ToolLengthDirect => {
                for axis in Axis::ALL {
                    if let Some(value) = self.axis_word(axis) {
                        length[axis] = value;
                    }
                }
            }
            Action::ToolLengthAdd => length = length.plus(&self.frames.tool_length(number)),
            _ => {
                if number != 0 && !self.frames.tools.contains_key(&number) {
                    let message = format!("the length of tool {number} is not known: 0 is taken");
                    let hint = "give a tool table";
                    self.warn_once("unknown-tool-length", number, at, message, hint);
                }
                length = self.frames.tool_length(number);
            }
        }
        self.frames.change(|f| f.tool = length);
        self.emit(Event::ToolLength(length));
        match action {
            Action::ToolCentre(vectors) => {
                self.modes.vectors = vectors;
                self.emit(Event::ToolCentre(true));
            }
            Action::ToolLengthOff => {
                self.modes.vectors = false;
                self.emit(Event::ToolCentre(false));
            }
            _ => {}
        }
        Ok(())
    }

    /// G28, G30: by way of the axis words to a reference point; only the named axes go there.
    fn reference(&mut self, index: usize) {
        let named = Axis::ALL.map(|a| self.words.look(a.letter()).is_some());
        let all = !named.contains(&true);
        let between = self.target();
        self.step(MoveKind::Rapid, between);
        let mut machine = self.frames.machine();
        for axis in Axis::ALL {
            if all || named[axis as usize] {
                machine[axis] = self.frames.references[index][axis];
            }
        }
        let target = self.frames.program_at(&machine);
        self.step(MoveKind::Rapid, target);
    }

    /// G10: sets a table by L and P.
    fn set_table(&mut self, at: usize) -> Result<(), Fault> {
        let level = self.words.take(b'L');
        let number = self.words.take(b'P');
        let number = match number {
            Some(p) if (0.0..1000.0).contains(&p) && p.fract() == 0.0 => p as u32,
            _ => {
                let message = "G10 needs P, the number of the entry".to_owned();
                return Err(fault("bad-g10", at, message, "write G10 L2 P1 X0"));
            }
        };
        let fanuc = self.programs[0].dialect().macro_words;
        match level.map(|l| l as i64) {
            // FANUC: the further work offsets, and the length of a tool.
            Some(20) if fanuc => self.set_offset(number + 9, false, at),
            Some(10) if fanuc => {
                self.set_length(number);
                Ok(())
            }
            Some(2 | 20) => self.set_offset(number, level == Some(20.0), at),
            Some(1 | 10 | 11) if !fanuc => {
                self.set_tool(number, level.unwrap_or(1.0) as u32);
                Ok(())
            }
            _ => {
                let _ = self.words.take_all();
                let message = "this form of G10 is not applied".to_owned();
                let hint = "L2, L10 and L20 are, and L1 and L11 of LinuxCNC";
                self.warn_once("not-applied", 10, at, message, hint);
                Ok(())
            }
        }
    }

    fn set_offset(&mut self, number: u32, from_place: bool, at: usize) -> Result<(), Fault> {
        let index = if number == 0 { self.frames.active } else { number as usize - 1 };
        if self.programs[0].dialect().macro_words && self.frames.offsets.len() <= index {
            self.frames.offsets.resize(index + 1, Default::default());
        }
        if index >= self.frames.offsets.len() {
            let message = format!("there is no work offset {number}");
            return Err(fault("bad-work-offset", at, message, "P1 is G54, P6 is G59"));
        }
        let words = Axis::ALL.map(|a| self.axis_word(a));
        let rotation = self.words.take(b'R');
        let incremental = self.modes.incremental && self.programs[0].dialect().macro_words;
        let before = self.frames.clone();
        let mut work = self.frames.offsets[index];
        work.rotation_deg = rotation.unwrap_or(work.rotation_deg);
        if from_place {
            // The place that the axes have now shall read as the words say.
            let mut there = self.frames.clone();
            there.change(|f| {
                f.active = index;
                f.offsets[index] = work;
            });
            for (axis, word) in words.iter().enumerate() {
                there.position.0[axis] = word.unwrap_or(there.position.0[axis]);
            }
            let turned = there.position.plus(&there.live_shift()).turned(work.rotation_deg);
            work.offset = before.machine().minus(&before.tool).minus(&turned);
        } else {
            for (axis, word) in words.iter().enumerate() {
                let base = if incremental { work.offset.0[axis] } else { 0.0 };
                work.offset.0[axis] = word.map_or(work.offset.0[axis], |w| base + w);
            }
        }
        self.frames.change(|f| f.offsets[index] = work);
        if index == self.frames.active {
            self.emit_offset();
        }
        Ok(())
    }

    /// FANUC G10 L10 P… R…: the length of a tool along Z.
    fn set_length(&mut self, number: u32) {
        let mut length = self.frames.tool_length(number);
        if let Some(value) = self.length(b'R') {
            let base = if self.modes.incremental { length[Axis::Z] } else { 0.0 };
            length[Axis::Z] = base + value;
        }
        self.frames.tools.insert(number, length);
    }

    /// G10 L1 (as written), L10 (from the present place) and L11 (from the place in G59.3).
    fn set_tool(&mut self, number: u32, level: u32) {
        let words = Axis::ALL.map(|a| self.axis_word(a));
        let others = b"RIJQ".map(|letter| self.words.take(letter));
        if others.iter().any(Option::is_some) {
            self.emit(Event::Note("G10 radius and angles of a tool"));
        }
        let mut length = self.frames.tool_length(number);
        let mut target = self.frames.position;
        let mut rotation_deg = 0.0;
        if level > 1 {
            let work = if level == 11 { self.frames.offsets[8] } else { self.frames.work() };
            let shift = if level == 11 { Position::default() } else { self.frames.live_shift() };
            rotation_deg = work.rotation_deg;
            let from_origin = self.frames.machine().minus(&work.offset);
            // What the place reads with the length as it stands in the table.
            target = from_origin.minus(&length).turned(-rotation_deg).minus(&shift);
            for (axis, word) in words.iter().enumerate() {
                target.0[axis] = word.unwrap_or(target.0[axis]);
            }
            target = from_origin.minus(&target.plus(&shift).turned(rotation_deg));
        }
        let turned = rotation_deg != 0.0 && (words[0].is_some() || words[1].is_some());
        for (axis, word) in words.iter().enumerate() {
            match (level, word) {
                (1, Some(value)) => length.0[axis] = *value,
                (1, None) => {}
                (_, Some(_)) => length.0[axis] = target.0[axis],
                (_, None) if turned && axis < 2 => length.0[axis] = target.0[axis],
                _ => {}
            }
        }
        self.frames.tools.insert(number, length);
    }
}
