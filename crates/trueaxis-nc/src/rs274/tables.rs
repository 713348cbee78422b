//! Tool lengths, work offsets, shifts and reference points.

use super::frames::{WorkOffset, offset_name};
use super::radius::RADIUS_WEAR;
use super::{Language, Run, fault};
use crate::execution::mistakes;
use crate::moves::{Axis, AxisSet, Event, MoveKind, Position};
use crate::rs274::code::Action;
use crate::text::program::Fault;

impl Run<'_> {
    /// Tool lengths, work offsets, shifts and reference points.
    pub(super) fn table(&mut self, action: Action, at: usize) -> Result<(), Fault> {
        match action {
            Action::ToolLength
            | Action::ToolLengthDirect
            | Action::ToolLengthNegative
            | Action::ToolLengthAdd
            | Action::ToolLengthOff
            | Action::ToolCentre(_) => self.tool_length(action, at)?,
            Action::WorkOffset(index) => self.select_offset(usize::from(index) - 1, at),
            Action::WorkOffsetFurther => {
                let number = self.words.take(b'P').unwrap_or(1.0);
                if !(1.0..=300.0).contains(&number) {
                    let number = format_args!("P{number}");
                    return Err(mistakes::bad_work_offset(number, "write G54.1 P1", at));
                }
                // The six of G54 to G59 come first, three places are LinuxCNC's.
                self.select_offset(8 + number as usize, at);
            }
            Action::SetTable => self.set_table(at)?,
            Action::Shift => self.shift_here(),
            Action::LocalShift if self.is_fanuc() => {
                let local = self.by_words(self.frames.local, Axis::ALL, false);
                self.change_local(local);
            }
            Action::LocalShift => {
                let shift = self.by_words(self.frames.shift, Axis::ALL, false);
                self.change_shift(shift, true);
            }
            Action::ShiftCancel => self.change_shift(Position::default(), false),
            Action::ShiftSuspend => self.change_shift(self.frames.shift, false),
            Action::ShiftResume => self.change_shift(self.frames.shift, true),
            Action::Preset => {
                let [shift, local] =
                    [self.frames.shift, self.frames.local].map(|of| self.without_named(of));
                self.frames.change(|f| f.local = local);
                self.change_shift(shift, true);
            }
            Action::Reference(index) => self.off_contour("G28 or G30", at, |run| {
                run.check_second_reference(index, at);
                run.as_at_zero(|run| run.reference(usize::from(index) - 1));
                Ok(())
            })?,
            Action::ReferenceCheck => self.off_contour("G27", at, |run| {
                run.as_at_zero(|run| run.check_reference(at));
                Ok(())
            })?,
            Action::ReferenceReturn => self.as_at_zero(Self::leave_reference),
            Action::SetReference(index) => {
                self.frames.references[usize::from(index) - 1] = self.axis_positions();
            }
            _ => {}
        }
        Ok(())
    }

    /// The same with 0 for the axes that the block names.
    fn without_named(&mut self, mut of: Position) -> Position {
        let named = |axis: &Axis| self.axis_word(*axis).is_some();
        Axis::ALL.into_iter().filter(named).for_each(|axis| of[axis] = 0.0);
        of
    }

    /// G92: the present place gets the written coordinates.
    ///
    /// # Source
    /// Haas Automation, "Mill Operator's Manual", G92: it cancels G52 for the axes of its block. NCT 99M user's manual,
    /// 9.2.4, says the same of a control of FANUC's kind.
    fn shift_here(&mut self) {
        let target = self.by_words(self.frames.position, Axis::ALL, false);
        let local = self.without_named(self.frames.local);
        self.frames.change(|f| {
            let mut moved = f.position.minus(&target);
            if let Some(program) = &f.program {
                // The shift lies outside of the frames of the program.
                let [x, y, z, ..] = moved.0;
                moved.0[..3].copy_from_slice(&program.vector([x, y, z]));
            }
            f.shift = f.live_shift().minus(&local).plus(&moved);
            (f.local, f.shift_on) = (local, true);
        });
        self.emit_shift();
    }

    fn emit_shift(&mut self) {
        let shift = self.frames.live_shift();
        self.core.emit(Event::Shift(shift));
        self.emit_frame();
    }

    fn change_shift(&mut self, shift: Position, on: bool) {
        self.frames.change(|f| (f.shift, f.shift_on) = (shift, on));
        self.emit_shift();
    }

    pub(super) fn change_local(&mut self, local: Position) {
        self.frames.change(|f| f.local = local);
        self.emit_shift();
    }

    pub(super) fn emit_offset(&mut self) {
        let work = self.frames.work();
        self.core.emit(Event::WorkOffset {
            index: self.frames.active as u32 + 1,
            offset: work.offset,
            rotation_deg: work.rotation_deg,
        });
        self.emit_frame();
    }

    pub(super) fn select_offset(&mut self, index: usize, at: usize) {
        if self.frames.offsets.get(index).is_none_or(|o| *o == WorkOffset::default()) {
            self.core.unknown_offset(index as u32 + 1, offset_name(index), at);
        }
        if index == self.frames.active {
            return;
        }
        self.check_turn(index, at);
        self.frames.change(|f| {
            if f.offsets.len() <= index {
                f.offsets.resize(index + 1, Default::default());
            }
            f.active = index;
        });
        self.emit_offset();
        self.emit_shift();
    }

    /// LinuxCNC turns work offsets about Z only.
    pub(super) fn check_turn(&mut self, index: usize, at: usize) {
        let fanuc = self.is_fanuc();
        let Some(work) = self.frames.offsets.get_mut(index).filter(|_| !fanuc) else { return };
        if work.linear.take().is_some() {
            let message = format!(
                "work offset {} is rotated about other axes than Z: only the rotation about Z is \
                 used",
                index + 1
            );
            let hint =
                "this control rotates work offsets about Z only; align the part or the model";
            self.core.warn("work-offset-not-about-z", index as u32, at, message, hint);
        }
    }

    pub(super) fn tool_length(&mut self, action: Action, at: usize) -> Result<(), Fault> {
        let number = match self.words.take(b'H') {
            Some(h) if (0.0..1e9).contains(&h) => {
                self.modes.length_number = Some(h as u32);
                h as u32
            }
            Some(h) => return Err(mistakes::bad_tool(format_args!("H{h}"), at)),
            None if self.is_fanuc() => match (self.modes.length_number, action) {
                (Some(number), _) => number,
                (None, Action::ToolLengthOff) => 0,
                (None, _) => {
                    let message = "no H is active: H0, no length, is taken".to_owned();
                    self.core.warn(
                        "no-length-number",
                        0,
                        at,
                        message,
                        "write H with the number of the offset",
                    );
                    0
                }
            },
            None => self.core.modes.tool,
        };
        let mut length = self.frames.tool;
        match action {
            Action::ToolLengthOff => length = Position::default(),
            Action::ToolLengthDirect => length = self.by_words(length, Axis::ALL, false),
            Action::ToolLengthAdd => length = length.plus(&self.frames.tool_length(number)),
            _ => {
                if number != 0 && !self.frames.tools.contains_key(&number) {
                    self.core.unknown_length(number, at);
                }
                self.compare_length(number, at);
                length = self.frames.tool_length(number);
                if action == Action::ToolLengthNegative {
                    length = Position::default().minus(&length);
                }
            }
        }
        self.set_tool_length(length);
        self.modes.length_code = match action {
            Action::ToolLengthOff => 49.0,
            Action::ToolLengthNegative => 44.0,
            Action::ToolCentre(vectors) => 43.4 + 0.1 * f64::from(u8::from(vectors)),
            _ => 43.0,
        };
        let centre = match action {
            Action::ToolCentre(vectors) => Some((true, vectors)),
            Action::ToolLengthOff => Some((false, false)),
            _ => None,
        };
        if let Some((on, vectors)) = centre {
            if on {
                self.refuse_with_dynamic_offset("tool-centre-point control", at)?;
            }
            self.modes.vectors = vectors;
            if on {
                self.modes.length_due = Position::default();
            }
            self.core.tool_centre(on);
        }
        Ok(())
    }

    /// The offset of another number has the length of the tool in the spindle, or that is said.
    fn compare_length(&mut self, number: u32, at: usize) {
        const SAME_MM: f64 = 1e-6;
        let tool = self.core.modes.tool;
        let known = |n: u32| n != 0 && self.frames.tools.contains_key(&n);
        if number == tool || !known(number) || !known(tool) {
            return;
        }
        let lengths = [number, tool].map(|n| self.frames.tool_length(n));
        let longer = lengths[0].minus(&lengths[1]);
        if longer.0.iter().any(|mm| mm.abs() > SAME_MM) {
            self.core.other_length(lengths, number, at);
        }
    }

    /// Another tool length; the machine stays where it is. On FANUC the change is added to the word of its axis in the
    /// block, absolute or incremental.
    pub(super) fn set_tool_length(&mut self, length: Position) {
        let before = self.frames.position;
        if self.modes.transforms.tilted {
            // The tool stands along Z of the tilted plane.
            let longer = length.minus(&self.frames.tool);
            self.frames.position = self.frames.position.minus(&longer);
            self.frames.tool = length;
        } else {
            self.frames.change(|f| f.tool = length);
        }
        if self.is_fanuc() && !self.core.modes.tool_centre {
            let due = before.minus(&self.frames.position);
            self.modes.length_due = self.modes.length_due.plus(&due);
            self.modes.length_due_in = self.core.origin;
        }
        self.core.emit(Event::ToolLength(length));
    }

    /// H alone, while a length is on, is another length (FANUC).
    pub(super) fn reselect_length(&mut self, at: usize) -> Result<(), Fault> {
        let Some(number) = self.words.look(b'H') else { return Ok(()) };
        let on = self.modes.length_code != 49.0;
        if !on || !self.is_fanuc() {
            return Ok(());
        }
        if number == 0.0 {
            self.words.take(b'H');
            self.set_tool_length(Position::default());
            return Ok(());
        }
        let action = match self.modes.length_code {
            44.0 => Action::ToolLengthNegative,
            _ => Action::ToolLength,
        };
        let code = self.modes.length_code;
        self.tool_length(action, at)?;
        self.modes.length_code = code;
        Ok(())
    }

    /// G30 of FANUC: the second reference point, the third or fourth by P, is in the parameters of the control.
    fn check_second_reference(&mut self, index: u8, at: usize) {
        if index == 1 || !self.is_fanuc() {
            return;
        }
        if self.words.look(b'P').is_some_and(|p| [2.0, 3.0, 4.0].contains(&p)) {
            self.words.take(b'P');
        }
        let message = "G30 moves to machine zero here".to_owned();
        let hint =
            "the reference points are in the parameters of the control, which are not known here";
        self.core.warn("reference-point", "", at, message, hint);
    }

    /// G28, G30: by way of the axis words to a reference point; only the named axes go there.
    fn reference(&mut self, index: usize) {
        self.modes.length_due = Position::default();
        let between = self.target();
        self.step(MoveKind::Rapid, between);
        self.modes.via = Some(between);
        let named = match self.words.axes() {
            none if none == AxisSet::default() => self.core.axes_of_machine(),
            named => named,
        };
        if self.follows_workpiece() {
            return self.machine_move(self.frames.references[index], named);
        }
        let mut machine = self.frames.machine();
        for axis in Axis::ALL.into_iter().filter(|axis| named.contains(*axis)) {
            machine[axis] = self.frames.references[index][axis];
        }
        let target = self.frames.program_at(&machine);
        self.step_of(MoveKind::Rapid, target, named);
    }

    /// Where the axes are in the machine.
    pub(super) fn axis_positions(&self) -> Position {
        self.core.axis_positions(self.frames.machine())
    }

    /// G27: goes there, and it should be a reference point.
    fn check_reference(&mut self, at: usize) {
        let named = self.words.axes();
        let target = self.target();
        self.step(MoveKind::Rapid, target);
        let machine = self.frames.machine();
        let away = |a: Axis| (machine[a] - self.frames.references[0][a]).abs() > 1e-3;
        if Axis::ALL.into_iter().any(|a| named.contains(a) && away(a)) {
            let message = "G27: the position is not the reference point".to_owned();
            self.core.warn(
                "not-at-reference",
                0,
                at,
                message,
                "the control would stop here; check the position",
            );
        }
    }

    /// G29: the named axes go by way of the place of the last G28.
    fn leave_reference(&mut self) {
        let named = self.words.axes();
        if let Some(via) = self.modes.via {
            let now = self.frames.position;
            let between = Axis::ALL.map(|a| if named.contains(a) { via[a] } else { now[a] });
            self.step(MoveKind::Rapid, Position(between));
        }
        let target = self.target();
        self.step(MoveKind::Rapid, target);
    }

    /// G10: sets a table by L and P.
    fn set_table(&mut self, at: usize) -> Result<(), Fault> {
        let level = self.words.take(b'L');
        let fanuc = self.is_fanuc();
        if fanuc && level.is_some_and(|l| (50.0..=52.0).contains(&l)) {
            let _ = self.words.take_all();
            self.modes.data_input = true;
            self.core.emit(Event::Note("G10 L50 parameters are not set"));
            return Ok(());
        }
        let number = self.words.take(b'P');
        let number = match number {
            Some(p) if (0.0..1000.0).contains(&p) && p.fract() == 0.0 => p as u32,
            _ => {
                let message = "G10 needs P, the number of the entry";
                return Err(fault("bad-g10", at, message, "write G10 L2 P1 X0"));
            }
        };
        match level.map(|l| l as i64) {
            // FANUC: the further work offsets, lengths and radii of tools, and their wear.
            Some(20) if fanuc && !(1..=300).contains(&number) => Err(no_offset(number, at)),
            Some(2) if fanuc && number > 6 => Err(no_offset(number, at)),
            Some(20) if fanuc => self.set_offset(number + 9, false, at),
            Some(2) if fanuc && number == 0 => {
                self.set_external();
                Ok(())
            }
            None | Some(1 | 10..=13) if fanuc => {
                self.set_length(number, level.unwrap_or(10.0) as u32);
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
                let hint = "use L1, L2, L10, L11, L20, or L12, L13 and L50 of FANUC";
                self.core.warn("not-applied", 10, at, message, hint);
                Ok(())
            }
        }
    }

    fn set_offset(&mut self, number: u32, from_place: bool, at: usize) -> Result<(), Fault> {
        let index = if number == 0 { self.frames.active } else { number as usize - 1 };
        if self.is_fanuc() && self.frames.offsets.len() <= index {
            self.frames.offsets.resize(index + 1, Default::default());
        }
        if index >= self.frames.offsets.len() {
            return Err(mistakes::bad_work_offset(number, "write P1 for G54 to P6 for G59", at));
        }
        let words = Axis::ALL.map(|a| self.axis_word(a));
        let rotation = self.words.take(b'R');
        let incremental = self.core.modes.incremental && self.is_fanuc();
        self.check_turn(index, at);
        let before = self.frames.clone();
        let mut work = self.frames.offsets[index];
        if rotation.is_some() {
            work.linear = None;
        }
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

    /// FANUC G10 L2 P0: what is added to all work offsets.
    fn set_external(&mut self) {
        let incremental = self.core.modes.incremental;
        let external = self.by_words(self.external(), Axis::ALL, incremental);
        self.change_external(external);
    }

    /// What is added to all work offsets: a register of its own, on HAAS that of G52 ("Mill Operator's Manual", G10 P0
    /// and `#5201`).
    pub(super) fn external(&self) -> Position {
        if self.is_haas() { self.frames.local } else { self.frames.external }
    }

    pub(super) fn change_external(&mut self, external: Position) {
        if self.is_haas() {
            return self.change_local(external);
        }
        self.frames.change(|f| f.external = external);
        self.emit_frame();
    }

    /// A work offset as it is written; the machine stays where it is.
    pub(super) fn change_offset(&mut self, index: usize, offset: Position) {
        if self.frames.offsets.len() <= index {
            self.frames.offsets.resize(index + 1, Default::default());
        }
        self.frames.change(|f| f.offsets[index].offset = offset);
        if index == self.frames.active {
            self.emit_offset();
        }
    }

    /// FANUC G10 L10, L11 (wear), L12 and L13 (radius and its wear) P… R…; L1 is L10.
    ///
    /// # Source
    /// Haas Automation, "Mill Operator's Manual", G10: L12 and L13 are diameters (Setting 40), L1 is L11.
    fn set_length(&mut self, number: u32, level: u32) {
        let Some(value) = self.length(b'R') else { return };
        let (level, value) = match (self.is_haas(), level) {
            (true, 1) => (11, value),
            (true, 12 | 13) => (level, value / 2.0),
            _ => (level, value),
        };
        let length = self.frames.tools.get(&number).copied().unwrap_or_default();
        let old = match level {
            11 => self.frames.wear.get(&number).copied().unwrap_or_default(),
            12 => self.core.radii.get(&number).copied().unwrap_or(0.0),
            13 => {
                let wear = self.globals.get(&(RADIUS_WEAR + number)).copied();
                wear.unwrap_or(0.0) * self.core.modes.unit_mm()
            }
            _ => length[Axis::Z],
        };
        let value = if self.core.modes.incremental { old + value } else { value };
        match level {
            11 => {
                self.frames.wear.insert(number, value);
            }
            12 => {
                self.core.radii.insert(number, value);
            }
            13 => {
                self.globals.insert(RADIUS_WEAR + number, value / self.core.modes.unit_mm());
            }
            _ => {
                let mut length = length;
                length[Axis::Z] = value;
                self.frames.tools.insert(number, length);
            }
        }
    }

    /// G10 L1 (as written), L10 (from the present place) and L11 (from the place in G59.3).
    fn set_tool(&mut self, number: u32, level: u32) {
        let words = Axis::ALL.map(|a| self.axis_word(a));
        if let Some(radius) = self.length(b'R') {
            self.core.radii.insert(number, radius);
        }
        let others = b"IJQ".map(|letter| self.words.take(letter));
        if others.iter().any(Option::is_some) {
            self.core.emit(Event::Note("G10 angles of a tool"));
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

fn no_offset(number: u32, at: usize) -> Fault {
    let hint = "write G10 L2 P1 to P6, or G10 L20 P1 to P300";
    mistakes::bad_work_offset(format_args!("P{number}"), hint, at)
}
