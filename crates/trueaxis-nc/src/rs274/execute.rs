//! Executes the words of a block in the order of RS274/NGC.

use super::{Language, Next, Passage, Run, fault};
use crate::dialect::Control;
use crate::execution::corners::{Corner, is_size};
use crate::execution::mistakes;
use crate::moves::{Axis, AxisSet, Event, Move, MoveKind, PathControl, Position};
use crate::rs274::code::{Action, Motion};
use crate::text::program::{Block, Fault, Item, Keyword, Label, Program};
use trueaxis_contour::corner::Shape;

impl Run<'_> {
    /// Executes one block.
    pub(super) fn block(&mut self, passage: Passage<'_>) -> Result<Next, Fault> {
        if passage.block.skip.is_some() && !self.core.settings.skipped_blocks_too {
            return Ok(Next::Following);
        }
        let optional = passage.block.items.iter().position(|i| matches!(i, Item::Optional(_)));
        if let Some(count) = optional.filter(|_| !self.core.settings.skipped_blocks_too) {
            let mut block = passage.block.clone();
            block.items.truncate(count);
            return self.block(Passage { block: &block, ..passage });
        }
        if let Some(first) = passage.block.faults.first() {
            for later in &passage.block.faults[1..] {
                self.core.report(later.clone());
            }
            return Err(first.clone());
        }
        if self.core.settings.report_blocks {
            return self.report_block(passage);
        }
        self.sound_block(passage)
    }

    pub(super) fn sound_block(&mut self, passage: Passage<'_>) -> Result<Next, Fault> {
        self.comments(passage)?;
        let mut rest = &passage.block.items[..];
        self.called = None;
        if let Some((name, _)) = called_name(passage.program, &passage.block.items) {
            self.called = Some(name.clone());
        } else if let Some(index) = passage.block.items.iter().position(is_control) {
            match self.control(passage, &passage.block.items[index])? {
                Some(next) => return Ok(next),
                None => rest = &passage.block.items[index + 1..],
            }
        }
        if passage.block.items.iter().any(|i| matches!(i, Item::Mark(_))) {
            return Ok(self.tape_mark());
        }
        if rest.is_empty() {
            return Ok(Next::Following);
        }
        if passage.program.dialect().macro_words
            && passage.block.items.iter().any(|i| matches!(i, Item::Assign { .. }))
        {
            self.keep_remark(passage.program, &passage.block.items);
        }
        self.gather(passage, rest)?;
        if let Some(next) = self.call_modal(passage.block, true)? {
            return Ok(next);
        }
        self.assign(passage, rest)?;
        self.system_reads(passage.block.span.start);
        if self.turning.is_some() {
            return self.profile_block(passage.block);
        }
        self.perform(passage.block)
    }

    fn assign(&mut self, passage: Passage<'_>, items: &[Item]) -> Result<(), Fault> {
        let mut values = Vec::new();
        for item in items {
            if let Item::Assign { target, value, offset } = item {
                let value = self.value(passage, *value)?;
                values.push((self.parameter(passage, *target)?, value, *offset));
            }
        }
        values.into_iter().try_for_each(|(target, value, at)| self.write(target, value, at))
    }

    fn tape_mark(&mut self) -> Next {
        if std::mem::replace(&mut self.opened, true) {
            self.core.emit(Event::End);
            return Next::Finished;
        }
        Next::Following
    }

    /// Executes the gathered words in the order of RS274/NGC.
    pub(super) fn perform(&mut self, block: &Block) -> Result<Next, Fault> {
        let actions = std::mem::take(&mut self.words.actions);
        let result = self.perform_actions(&actions, block);
        self.words.actions = actions;
        self.core.forget_corner();
        let next = result?;
        if next != Next::Following {
            return Ok(next);
        }
        if let Some((_, _, at)) = self.words.corner {
            let message = "no move of this block has the corner ,C or ,R";
            return Err(fault("unused-word", at, message, "write it after G1, G2 or G3"));
        }
        self.report_unused()?;
        if self.called.take().is_some() {
            let message = "the block names a program, but no code that calls it";
            let hint = "write M98 or G65 before the name";
            return Err(fault("unexpected-sign", block.span.start, message, hint));
        }
        if let Some((name, at)) = self.core.own_call.take() {
            return self.call_own(&name, block, at);
        }
        if std::mem::take(&mut self.modes.moved) && !self.modes.macros.is_empty() {
            return Ok(self.call_modal(block, false)?.unwrap_or(next));
        }
        Ok(next)
    }

    fn perform_actions(
        &mut self,
        actions: &[(Action, usize)],
        block: &Block,
    ) -> Result<Next, Fault> {
        self.modes.moved = false;
        let cycles = |a: &Action| matches!(a, Action::Motion(Motion::Cycle(_)));
        self.modes.cycle.written = actions.iter().any(|(a, _)| cycles(a));
        if self.modes.data_input {
            self.modes.data_input = !actions.iter().any(|(a, _)| *a == Action::DataInputEnd);
            let _ = self.words.take_all();
            return Ok(Next::Following);
        }
        let early = actions.iter().take_while(|(a, _)| a.rank() <= 3).count();
        for (action, at) in &actions[..early] {
            self.act(*action, *at)?;
        }
        let calls = |a: &Action| matches!(a, Action::MacroCall | Action::ModalMacro { .. });
        if actions.iter().any(|(a, _)| calls(a)) {
            return self.macro_call(&actions[early..], block);
        }
        self.units_before_feed(actions);
        self.feed_speed_tool(block)?;
        let further = self.reselect_modes(actions, block)?;
        let own = self.words_of_call(actions);
        let mut moved = false;
        let machine = actions.iter().any(|(a, _)| *a == Action::MachineCoordinates);
        let taken = actions.iter().any(|(a, _)| a.takes_axis_words());
        for (action, at) in &actions[early..] {
            match action {
                Action::Motion(motion) => {
                    self.select_motion(*motion);
                    if !taken {
                        self.motion(*motion, machine, *at)?;
                        moved = true;
                    }
                }
                Action::WorkOffset(1) if further => {
                    self.act(Action::WorkOffsetFurther, *at)?;
                }
                Action::Approach => {
                    self.core.emit(Event::Note("G60 approach from one side"));
                    self.motion(Motion::Rapid, machine, *at)?;
                    moved = true;
                }
                Action::Turning(code) => return self.turning(*code, *at, block),
                Action::Call | Action::LocalCall | Action::Return => {
                    if !moved && !taken {
                        self.modal_motion(machine, block)?;
                    }
                    own.into_iter().flatten().try_for_each(|(l, v, p)| self.words.put(l, v, p))?;
                    return self.call_or_return(*action, block);
                }
                Action::End | Action::Stop(_) if !moved && !taken => {
                    self.modal_motion(machine, block)?;
                    moved = true;
                    if self.act(*action, *at)? {
                        return Ok(Next::Finished);
                    }
                }
                _ if self.act(*action, *at)? => return Ok(Next::Finished),
                _ => {}
            }
        }
        if !moved && !taken {
            self.modal_motion(machine, block)?;
        }
        Ok(Next::Following)
    }

    /// P, L and Q of a call or return, which follow the move of their block: no cycle may take them as its own.
    fn words_of_call(&mut self, actions: &[(Action, usize)]) -> [Option<(u8, f64, usize)>; 3] {
        let calls = |a: &Action| matches!(a, Action::Call | Action::LocalCall | Action::Return);
        if !actions.iter().any(|(a, _)| calls(a)) {
            return [None; 3];
        }
        let (words, begins) = (&mut self.words, self.core.programs[0].dialect().control);
        b"PLQ".map(|l| {
            let own = l != b'Q' || begins == Control::Fanuc;
            let value = if own { words.take_away(l) } else { None };
            value.map(|value| (l, value, words.place(l)))
        })
    }

    fn call_or_return(&mut self, action: Action, block: &Block) -> Result<Next, Fault> {
        match action {
            Action::Call => self.subprogram_call(block),
            Action::LocalCall => self.local_call(block),
            _ => self.subprogram_return(block),
        }
    }

    /// The motion lasts; G31 of FANUC is for one block.
    fn select_motion(&mut self, motion: Motion) {
        if motion == Motion::Probe && self.is_fanuc() {
            return;
        }
        self.modes.spline.select(self.modes.motion, motion);
        self.modes.motion = Some(motion);
        if !matches!(motion, Motion::Cycle(_) | Motion::Cancelled) {
            self.modes.base = motion;
            self.modes.cycle.forget();
        }
    }

    /// G31 that reaches its end has touched nothing; no workpiece is simulated, so that the signal is taken to come
    /// a little before the end.
    fn skip_short_of(&mut self, from: Position, end: Position) {
        const SHORT_MM: f64 = 0.01;
        let axes = Axis::ALL.into_iter().filter(|a| !a.is_rotary());
        let way: Vec<(Axis, f64)> = axes.map(|a| (a, end[a] - from[a])).collect();
        let length = way.iter().map(|(_, d)| d * d).sum::<f64>().sqrt();
        if length > SHORT_MM {
            for (axis, d) in way {
                self.modes.skip[axis] -= d * SHORT_MM / length;
            }
        }
        self.core.emit(Event::Note(
            "a touch: no workpiece is simulated, it comes 0.01 mm before the end",
        ));
    }

    /// What a FANUC block does by words without a code: H is another length, P with G54 is G54.1.
    fn reselect_modes(
        &mut self,
        actions: &[(Action, usize)],
        block: &Block,
    ) -> Result<bool, Fault> {
        if !self.is_fanuc() {
            return Ok(false);
        }
        if !actions.iter().any(|(a, _)| a.rank() == Action::ToolLength.rank()) {
            self.reselect_length(block.span.start)?;
        }
        let moves = |a: &Action| matches!(a, Action::Motion(m) if !matches!(m, Motion::Cycle(_)));
        if actions.iter().all(|(a, _)| moves(a)) {
            self.reselect_radius(block.span.start)?;
        }
        let p = self.words.look(b'P').filter(|p| p.fract() == 0.0 && (1.0..=300.0).contains(p));
        let alone = |a: &Action| {
            matches!(a, Action::WorkOffset(1) | Action::Incremental(_) | Action::Plane(_))
                || matches!(a, Action::Motion(m) if !matches!(m, Motion::Cycle(_)))
        };
        let further = actions.iter().any(|(a, _)| *a == Action::WorkOffset(1));
        Ok(p.is_some() && further && actions.iter().all(|(a, _)| alone(a)))
    }

    /// A FANUC block has its units before it has its feed, a LinuxCNC block afterwards.
    fn units_before_feed(&mut self, actions: &[(Action, usize)]) {
        let units = actions.iter().find_map(|(action, at)| match action {
            Action::Inches(inches) if *inches != self.core.modes.inches => Some((*inches, *at)),
            _ => None,
        });
        let Some((inches, at)) = units else { return };
        if self.is_fanuc() {
            self.core.modes.inches = inches;
        } else if self.words.look(b'F').is_some() {
            let message = "F is read in the units before this block".to_owned();
            let hint = "write G20 or G21 in a block before F";
            self.core.warn("feed-before-units", 0, at, message, hint);
        }
    }

    /// Axis words without a code of their own.
    fn modal_motion(&mut self, machine: bool, block: &Block) -> Result<(), Fault> {
        let arc =
            matches!(self.modes.motion, Some(Motion::ArcClockwise | Motion::ArcCounterClockwise))
                && b"IJK".iter().any(|l| self.words.look(*l).is_some())
                || self.names_direction();
        if !self.words.has_axis() && !arc {
            return Ok(());
        }
        let at = block.span.start;
        match self.modes.motion {
            Some(motion) if motion != Motion::Cancelled => self.motion(motion, machine, at),
            _ => {
                let message = "axis words without an active motion code";
                Err(fault("no-motion-code", at, message, "write G0, G1, G2 or G3 before them"))
            }
        }
    }

    fn feed_speed_tool(&mut self, block: &Block) -> Result<(), Fault> {
        let (at, feed) = (self.words.place(b'F'), self.words.take(b'F'));
        if let Some(negative) = feed.filter(|feed| *feed < 0.0) {
            return Err(mistakes::negative_feed(negative, at));
        }
        let unit_mm = self.core.modes.unit_mm();
        self.core.modes.set_feed(feed, unit_mm);
        let speed = self.words.take(b'S');
        self.core.set_speed(speed);
        let at = self.words.place(b'T');
        if let Some(tool) = self.words.take(b'T') {
            if !(0.0..1e9).contains(&tool) {
                let at = at.max(block.span.start);
                return Err(mistakes::bad_tool(format_args!("T{tool}"), at));
            }
            self.core.select_tool(tool as u32);
        }
        Ok(())
    }

    /// Everything but motions and calls; `true` at the end of the program.
    pub(super) fn act(&mut self, action: Action, at: usize) -> Result<bool, Fault> {
        self.settle();
        match action {
            Action::Feed(mode) => self.core.modes.change_feed_mode(mode),
            Action::Dwell => self.dwell(at)?,
            Action::Plane(plane) => self.core.select_plane(plane),
            Action::Inches(inches) => self.core.modes.inches = inches,
            Action::Diameter(diameter) => self.core.modes.diameter = diameter,
            Action::Compensation(side) => self.compensation(side, false, at)?,
            Action::CompensationDirect(side) => self.compensation(side, true, at)?,
            Action::SpatialCompensation => {
                self.words.take(b'D');
                self.core.left_out("G141 3D cutter compensation", at);
            }
            Action::Path(control) => self.path(control),
            Action::Incremental(incremental) => self.core.modes.incremental = incremental,
            Action::ArcAbsolute(absolute) => self.modes.arc_absolute = absolute,
            Action::RetractToR(to_r) => self.modes.retract_to_r = to_r,
            Action::MachineCoordinates => {}
            Action::CancelCycle => {
                self.modes.motion = Some(self.modes.base);
                self.modes.cycle.forget();
            }
            Action::Spindle(_) | Action::Orient | Action::SurfaceSpeed(_) | Action::ToolChange => {
                self.spindle(action);
            }
            Action::Coolant(coolant) => self.core.emit(Event::Coolant(coolant)),
            Action::Stop(optional) => self.core.emit(Event::Stop { optional }),
            Action::End => {
                self.dynamic_offset(false, at)?;
                self.core.emit(Event::End);
                return Ok(true);
            }
            Action::Kinematics(on) => self.core.emit(Event::ToolCentre(on)),
            Action::ModalMacroOff => {
                self.modes.macros.pop();
            }
            Action::DataInputEnd => {}
            Action::NurbsEnd => self.nurbs_end(at)?,
            Action::Threading => self.thread(at)?,
            Action::HolePattern(code) => self.hole_pattern(code, at)?,
            Action::CircularPocket { ccw } => self.circular_pocket(ccw, at)?,
            Action::ModalState(saving) => self.save_or_restore(saving, at)?,
            Action::Note(_)
            | Action::NoteWhole(_)
            | Action::NotApplied(_)
            | Action::NotAppliedAlone(_) => self.note(action, at),
            _ => {
                if !self.transform(action, at)? {
                    self.table(action, at)?;
                }
            }
        }
        Ok(false)
    }

    /// Passes on what has no effect on the path; warns of what should have one.
    fn note(&mut self, action: Action, at: usize) {
        match action {
            Action::Note(name) => {
                if name.starts_with("M97") && self.words.look(b'P').is_some() {
                    self.core.left_out("M97 P, a call of HAAS (--control haas),", at);
                }
                if self.is_haas() && name.starts_with("M96") {
                    self.core.left_out("M96 P Q, a jump where an input is 0,", at);
                }
                self.words.take_parameters();
                self.core.emit(Event::Note(name));
            }
            Action::NoteWhole(name) => {
                let _ = self.words.take_all();
                self.core.emit(Event::Note(name));
            }
            Action::NotApplied(name) | Action::NotAppliedAlone(name) => {
                if matches!(action, Action::NotApplied(_)) {
                    let _ = self.words.take_all();
                }
                self.core.left_out(name, at);
            }
            _ => {}
        }
    }

    fn spindle(&mut self, action: Action) {
        match action {
            Action::Spindle(turning) => {
                self.words.take(b'P');
                self.core.turn_spindle(turning);
            }
            Action::Orient => {
                let angle_deg = self.words.take(b'R').unwrap_or(0.0);
                self.words.take(b'P');
                self.words.take(b'Q');
                self.core.emit(Event::SpindleOrient { angle_deg });
            }
            Action::ToolChange => self.core.change_tool(),
            Action::SurfaceSpeed(on) => {
                self.words.take(b'D');
                self.core.surface_speed(on);
            }
            _ => {}
        }
    }

    fn path(&mut self, control: PathControl) {
        let mut tolerance_mm = 0.0;
        if control == PathControl::Continuous {
            tolerance_mm = self.length(b'P').unwrap_or(0.0);
            self.words.take(b'Q');
            self.words.take(b'R');
        }
        (self.modes.path, self.modes.path_tolerance_mm) = (control, tolerance_mm);
        self.core.emit(Event::Path { control, tolerance_mm });
    }

    pub(super) fn step(&mut self, kind: MoveKind, target: Position) {
        self.step_of(kind, target, self.words.axes());
    }

    /// A move of axes, and of those that move with them where the frame is turned.
    pub(super) fn step_of(&mut self, kind: MoveKind, target: Position, axes: AxisSet) {
        let (feed, origin) = (self.core.modes.feed, self.core.origin);
        let named = self.with_turned(axes, &target);
        self.emit_move(Move::plain(kind, target, named, feed, origin));
    }

    /// The axes of the words, and those that move with them where the frame is turned.
    fn named_to(&self, target: &Position) -> AxisSet {
        self.with_turned(self.words.axes(), target)
    }

    fn with_turned(&self, axes: AxisSet, target: &Position) -> AxisSet {
        let moves = |a: &Axis| target[*a] != self.frames.position[*a];
        [Axis::X, Axis::Y, Axis::Z].into_iter().filter(moves).fold(axes, AxisSet::with)
    }

    fn motion(&mut self, motion: Motion, machine: bool, at: usize) -> Result<(), Fault> {
        let motion = if machine { self.machine_motion(motion, at)? } else { motion };
        if machine && self.core.has_radius() {
            return self.off_contour("G53", at, |run| run.motion_as_written(motion, machine, at));
        }
        self.motion_as_written(motion, machine, at)
    }

    fn motion_as_written(&mut self, motion: Motion, machine: bool, at: usize) -> Result<(), Fault> {
        self.settle();
        if !matches!(motion, Motion::Cycle(_)) {
            self.polar_words(machine)?;
        }
        let moves = self.words.has_axis() || self.names_direction();
        if motion == Motion::Cancelled {
            self.modes.cycle.forget();
            return Ok(());
        }
        if let Motion::Cycle(cycle) = motion {
            if moves && self.core.has_radius() {
                return Err(mistakes::cycle_on_contour("a cycle", at));
            }
            return if moves { self.cycle(cycle, at) } else { Ok(()) };
        }
        self.modes.cycle.forget();
        if let Motion::Spline(spline) = motion {
            return self.spline(spline, at);
        }
        let arc = matches!(motion, Motion::ArcClockwise | Motion::ArcCounterClockwise);
        if !moves && !arc {
            if motion == Motion::Probe {
                let message = "a probing move needs an axis word";
                return Err(fault("no-axis-words", at, message, "write G38.2 Z-10"));
            }
            return Ok(());
        }
        let position = self.frames.position;
        self.modes.moved = true;
        if machine && (self.follows_workpiece() || self.modes.dynamic.is_on()) {
            let place = Axis::ALL.map(|a| self.axis_word(a).unwrap_or(0.0));
            self.machine_move(Position(place), self.words.axes());
            return Ok(());
        }
        let target = if machine { self.machine_target() } else { self.target() };
        if !matches!(motion, Motion::Rapid | Motion::Thread | Motion::RigidTap) {
            self.core.modes.check_feed(at)?;
        }
        self.corner()?;
        match motion {
            Motion::Rapid | Motion::Linear => {
                let direction = self.take_direction(at)?;
                let (feed, origin) = (self.core.modes.feed, self.core.origin);
                let named = self.named_to(&target);
                let rapid = motion == Motion::Rapid;
                let kind = if rapid { MoveKind::Rapid } else { MoveKind::Linear };
                let straight = Move::plain(kind, target, named, feed, origin);
                self.emit_move(Move { direction, ..straight });
            }
            Motion::Probe => {
                self.step(MoveKind::Probe, target);
                self.modes.skip = target;
                if self.is_fanuc() {
                    self.skip_short_of(position, target);
                }
            }
            Motion::Thread | Motion::RigidTap => {
                let pitch_mm = match self.length(b'K') {
                    Some(pitch) => pitch,
                    None => self.core.modes.feed.value,
                };
                self.words.take(b'I');
                if motion == Motion::Thread {
                    self.step(MoveKind::Thread { pitch_mm }, target);
                } else {
                    self.step(MoveKind::RigidTap { pitch_mm }, target);
                    self.frames.position = position;
                }
            }
            _ => return self.arc(motion == Motion::ArcCounterClockwise, target, at),
        }
        Ok(())
    }

    /// `,C` and `,R`: the legs of a chamfer or the radius of a rounding after the move of this block.
    fn corner(&mut self) -> Result<(), Fault> {
        let Some((round, size, at)) = self.words.corner.take() else { return Ok(()) };
        let (size, name) = (size * self.core.modes.unit_mm(), if round { ",R" } else { ",C" });
        if !is_size(size) {
            let message = format!("{name} needs a size above 0");
            return Err(fault("missing-value", at, message, "write ,C2. or ,R5."));
        }
        let shape = if round {
            Shape::Round { radius_mm: size }
        } else {
            Shape::ChamferLeg { leg_mm: size }
        };
        let corner = Corner { shape, feed: None, name, modal: false, at };
        self.core.corner_after_next(self.frames.position, Some(corner));
        Ok(())
    }

    /// Whether I J K of the block are a tool direction.
    fn names_direction(&self) -> bool {
        self.modes.vectors && b"IJK".iter().any(|l| self.words.look(*l).is_some())
    }

    /// I J K of a line are a tool direction with G43.5.
    fn take_direction(&mut self, at: usize) -> Result<Option<[f64; 3]>, Fault> {
        let given = b"IJK".iter().any(|l| self.words.look(*l).is_some());
        if !self.modes.vectors || !given {
            return Ok(None);
        }
        let direction = b"IJK".map(|l| self.words.take(l).unwrap_or(0.0));
        if direction == [0.0; 3] {
            return Err(mistakes::zero_direction(at));
        }
        Ok(Some(direction))
    }
}

/// The name after M98 or G65 of FANUC, and its byte offset.
fn called_name<'b>(program: &Program, items: &'b [Item]) -> Option<(&'b Label, usize)> {
    let name = items.iter().find_map(|item| match item {
        Item::Control { keyword: Keyword::Call, label: Some(label), offset, .. } => {
            Some((label, *offset))
        }
        _ => None,
    });
    name.filter(|_| program.dialect().macro_words)
}

pub(super) fn is_control(item: &Item) -> bool {
    matches!(item, Item::Control { .. })
}
