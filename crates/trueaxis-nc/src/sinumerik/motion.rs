//! Targets and moves.

use super::tables::{Motion, Name};
use super::words::{Mode, Words};
use super::{Language, Run, fault};
use crate::execution::corners::{Corner, is_size};
use crate::moves::{Axis, AxisSet, Coordinates, Feed, Move, MoveKind, Position, RotaryDirection};
use crate::text::program::Fault;
use trueaxis_contour::corner::Shape;

impl Run<'_> {
    /// The move of a block; `false` if it has none.
    pub(super) fn motion(
        &mut self,
        words: &mut Words,
        machine: bool,
        at: usize,
    ) -> Result<bool, Fault> {
        self.settle();
        let direction = self.take_direction(words)?;
        let corner = self.corner(words)?;
        let motion = self.modes.motion;
        let round = matches!(motion, Motion::Arc { .. })
            && (words.centers.iter().any(Option::is_some)
                || words.has(Name::Radius)
                || words.has(Name::Opening));
        let polar = words.has(Name::PolarRadius) || words.has(Name::PolarAngle);
        if words.axes == AxisSet::default() && direction.is_none() && !round && !polar {
            if let Some(corner) = corner.filter(|c| !c.modal) {
                self.core.corner_after_next(self.chain.position, Some(corner));
                self.core.forget_corner();
            }
            return Ok(false);
        }
        if machine {
            return self.machine_move(words, at).map(|()| true);
        }
        let target = self.target(words);
        let mut target = if polar { self.polar_target(words, target)? } else { target };
        if !(target.0.iter().all(|v| v.abs() < 1e13)) {
            let message = "the target is too far away for a machine";
            return Err(fault("too-large", at, message, "check the increments"));
        }
        if motion == Motion::Linear && words.has(Name::Angle) {
            target = self.angle_target(words, target)?;
        }
        let block_feed = words.take(Name::BlockFeed).map(|(feed, ..)| feed);
        let modal = self.core.modes.feed.value;
        if let Some(feed) = block_feed.filter(|f| *f > 0.0) {
            self.core.modes.feed.value = if self.modes.feed_inches { feed * 25.4 } else { feed };
        }
        if let Some(corner) = corner {
            self.core.corner_after_next(self.chain.position, Some(corner));
        }
        let result = self.path_move(words, target, direction, at);
        self.core.forget_corner();
        self.core.modes.feed.value = modal;
        result.map(|()| true)
    }

    /// RND, CHF (length) and CHR (legs) at the end of the move, or RNDM; FRC or FRCM is their feed.
    ///
    /// # Source
    /// SINUMERIK 840D sl Programming Manual "Fundamentals", chamfer and rounding.
    fn corner(&mut self, words: &mut Words) -> Result<Option<Corner>, Fault> {
        let unit = self.core.modes.unit_mm();
        let feed_unit = if self.modes.feed_inches { 25.4 } else { 1.0 };
        if words.named.is_empty() && self.modes.corners[0] == 0.0 {
            return Ok(None);
        }
        let modal = [(Name::ModalRounding, unit), (Name::ModalCornerFeed, feed_unit)];
        for (kept, (name, unit)) in modal.into_iter().enumerate() {
            if let Some((value, ..)) = words.take(name) {
                self.modes.corners[kept] = value * unit;
            }
        }
        let own = words.take(Name::CornerFeed).map(|(feed, ..)| feed * feed_unit);
        let value = own.unwrap_or(self.modes.corners[1]);
        let feed = (value > 0.0).then_some(Feed { value, ..self.core.modes.feed });
        let mut found = None;
        for name in [Name::Rounding, Name::ChamferLength, Name::ChamferLeg] {
            found = found.or(words.take(name).map(|(size, _, at)| (name, size * unit, at)));
        }
        let (name, size, at, modal) = match found {
            Some((name, size, at)) => (name, size, at, false),
            None => (Name::Rounding, self.modes.corners[0], self.core.start, true),
        };
        if size == 0.0 {
            return Ok(None);
        }
        if !is_size(size) {
            let message = "the size of a rounding or chamfer is negative or too large";
            return Err(fault("missing-value", at, message, "write RND=5, CHF=2 or CHR=2"));
        }
        let (shape, name) = match name {
            Name::ChamferLength => (Shape::ChamferLength { length_mm: size }, "CHF"),
            Name::ChamferLeg => (Shape::ChamferLeg { leg_mm: size }, "CHR"),
            _ => (Shape::Round { radius_mm: size }, if modal { "RNDM" } else { "RND" }),
        };
        Ok(Some(Corner { shape, feed, name, modal, at }))
    }

    fn path_move(
        &mut self,
        words: &mut Words,
        target: Position,
        direction: Option<[f64; 3]>,
        at: usize,
    ) -> Result<(), Fault> {
        let motion = self.modes.motion;
        if !matches!(motion, Motion::Rapid | Motion::Thread) {
            self.core.modes.check_feed(at)?;
        }
        let kind = match motion {
            Motion::Rapid => MoveKind::Rapid,
            Motion::Linear | Motion::FreeTap => MoveKind::Linear,
            Motion::Thread => MoveKind::Thread { pitch_mm: self.pitch(words, at)? },
            _ => return self.round_move(words, target, direction, at),
        };
        self.straight_tangent(target);
        self.send_move(kind, target, direction, words);
        Ok(())
    }

    /// Sends a move with the words of the block and goes there.
    pub(super) fn send_move(
        &mut self,
        kind: MoveKind,
        target: Position,
        direction: Option<[f64; 3]>,
        words: &Words,
    ) {
        let ways = [Axis::A, Axis::B, Axis::C].map(|axis| {
            if !words.axes.contains(axis) {
                return RotaryDirection::AsWritten;
            }
            match words.modes[axis as usize] {
                Mode::Shortest => RotaryDirection::Shortest,
                Mode::Positive => RotaryDirection::Positive,
                Mode::Negative => RotaryDirection::Negative,
                _ => RotaryDirection::AsWritten,
            }
        });
        let (feed, origin) = (self.core.modes.feed, self.core.origin);
        let mut named = words.axes;
        for axis in [Axis::X, Axis::Y, Axis::Z] {
            if target[axis] != self.chain.position[axis] {
                named = named.with(axis);
            }
        }
        self.core.emit_move(Move {
            rotary_directions: ways,
            direction,
            ..Move::plain(kind, target, named, feed, origin)
        });
        self.chain.position = target;
    }

    /// A move without a direction or ways of its own.
    pub(super) fn step(&mut self, kind: MoveKind, target: Position, words: &Words) {
        let named =
            if matches!(kind, MoveKind::Dwell { .. }) { AxisSet::default() } else { words.axes };
        let (feed, origin) = (self.core.modes.feed, self.core.origin);
        self.core.emit_move(Move::plain(kind, target, named, feed, origin));
        self.chain.position = target;
    }

    pub(super) fn straight_tangent(&mut self, target: Position) {
        let d = target.minus(&self.chain.position).0;
        if d[..3].iter().any(|v| *v != 0.0) {
            self.modes.tangent = Some([d[0], d[1], d[2]]);
        }
    }

    /// What a word of an axis leads to, from a base that increments count from.
    fn axis_value(&self, words: &Words, axis: Axis, base: f64) -> f64 {
        let index = axis as usize;
        let value = words.values[index] * self.core.modes.scale(axis);
        match words.modes[index] {
            Mode::Modal if self.core.modes.incremental => base + value,
            Mode::Increment => base + value,
            _ => value,
        }
    }

    /// Where the words of the axes lead.
    fn target(&self, words: &Words) -> Position {
        let mut target = self.chain.position;
        for axis in Axis::ALL {
            if words.axes.contains(axis) {
                target[axis] = self.axis_value(words, axis, target[axis]);
            }
        }
        target
    }

    /// AP and RP about the pole.
    fn polar_target(&mut self, words: &mut Words, mut target: Position) -> Result<Position, Fault> {
        let unit = self.core.modes.unit_mm();
        let (mut angle_deg, mut radius) = self.modes.polar;
        if let Some((value, mode, at)) = words.take(Name::PolarRadius) {
            radius = if mode == Mode::Increment { radius + value * unit } else { value * unit };
            if radius < 0.0 {
                let message = format!("the polar radius {radius} is negative");
                return Err(fault("bad-polar", at, message, "write RP above 0"));
            }
        }
        if let Some((value, mode, _)) = words.take(Name::PolarAngle) {
            let added =
                mode == Mode::Increment || mode == Mode::Modal && self.core.modes.incremental;
            angle_deg = if added { angle_deg + value } else { value };
        }
        self.modes.polar = (angle_deg, radius);
        let [first, second, _] = self.core.modes.plane.axes();
        let (sin, cos) = angle_deg.to_radians().sin_cos();
        target[first] = self.modes.pole[first] + radius * cos;
        target[second] = self.modes.pole[second] + radius * sin;
        Ok(target)
    }

    /// ANG: a line by its angle in the plane and one coordinate of its end.
    fn angle_target(&mut self, words: &mut Words, mut target: Position) -> Result<Position, Fault> {
        let Some((angle_deg, _, at)) = words.take(Name::Angle) else { return Ok(target) };
        let [first, second, _] = self.core.modes.plane.axes();
        let (sin, cos) = angle_deg.to_radians().sin_cos();
        let start = self.chain.position;
        let given = [first, second].map(|a| words.axes.contains(a));
        let (along, other) = match given {
            [true, false] => (cos, sin),
            [false, true] => (sin, cos),
            _ => {
                self.core.not_applied(
                    "ANG needs exactly one coordinate of the end point",
                    at,
                    "write one coordinate of the end point",
                );
                return Ok(target);
            }
        };
        if along.abs() < 1e-9 {
            let message = "the line at the angle ANG does not reach the coordinate";
            return Err(fault("bad-angles", at, message, "check ANG"));
        }
        let (from, to) = if given[0] { (first, second) } else { (second, first) };
        target[to] = start[to] + (target[from] - start[from]) / along * other;
        Ok(target)
    }

    /// I, J or K of a thread along X, Y or Z.
    fn pitch(&mut self, words: &mut Words, at: usize) -> Result<f64, Fault> {
        let unit = self.core.modes.unit_mm();
        let pitch = words.centers.iter_mut().rev().find_map(Option::take);
        words.centers = [None; 3];
        let (pitch, _) = pitch.ok_or_else(|| {
            let message = "the pitch of the thread is missing";
            fault("missing-value", at, message, "write K1.5 for a thread along Z")
        })?;
        Ok((pitch * unit).abs())
    }

    /// G53, G153 and SUPA: the words count from the machine zero.
    ///
    /// The tool length stays on (the control takes it off with D0), so the axis goes to the word and
    /// the length.
    fn machine_move(&mut self, words: &mut Words, at: usize) -> Result<(), Fault> {
        let kind = match self.modes.motion {
            Motion::Rapid => MoveKind::Rapid,
            Motion::Linear => {
                self.core.modes.check_feed(at)?;
                MoveKind::Linear
            }
            _ => {
                let message = "machine coordinates need G0 or G1";
                return Err(fault("bad-machine-move", at, message, "write G0 or G1"));
            }
        };
        if self.core.modes.tool_centre {
            let message = "machine coordinates while TRAORI is on: they are read as axis positions"
                .to_owned();
            let hint = "write TRAFOOF before it";
            self.core.warn("machine-move-with-traori", "", at, message, hint);
        }
        let now = self.axis_positions();
        let mut target = now;
        for axis in Axis::ALL {
            if words.axes.contains(axis) {
                let length = self.chain.tool[axis];
                target[axis] = self.axis_value(words, axis, now[axis] - length) + length;
            }
        }
        self.go_to_machine(kind, target, words);
        Ok(())
    }

    fn go_to_machine(&mut self, kind: MoveKind, target: Position, words: &Words) {
        let (feed, origin) = (self.core.modes.feed, self.core.origin);
        let plain = Move::plain(kind, target, words.axes, feed, origin);
        self.core.emit_move(Move { coordinates: Coordinates::Machine, ..plain });
        let place = self.chain.program_at(&target);
        // Frames that are in force have an inverse.
        self.chain.position = place.unwrap_or(self.chain.position);
        self.modes.tangent = None;
    }

    /// Where the axes are in the machine.
    pub(super) fn axis_positions(&self) -> Position {
        self.core.axis_positions(self.chain.machine())
    }

    /// G74 and G75: the named axes go to the reference or fixed point.
    pub(super) fn reference(&mut self, words: &mut Words, at: usize) {
        let message = "G74 and G75 move to machine zero here".to_owned();
        let hint =
            "the reference and fixed points are in the machine data, which are not known here";
        self.core.warn("reference-point", "", at, message, hint);
        for (name, _) in &words.numbered {
            let letter = name.as_bytes().first().copied().unwrap_or(b' ');
            if let Some(axis) = super::variables::axis_of(letter) {
                words.axes = words.axes.with(axis);
            }
        }
        let mut target = self.axis_positions();
        for axis in Axis::ALL {
            if words.axes.contains(axis) {
                target[axis] = 0.0;
            }
        }
        if words.axes != AxisSet::default() {
            self.go_to_machine(MoveKind::Rapid, target, words);
        }
    }
}
