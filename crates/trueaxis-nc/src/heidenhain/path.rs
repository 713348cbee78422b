//! Path blocks: L, LP, LN, CC and what all of them have in common.

use super::line::Cursor;
use super::plane::spatial;
use super::words::{FeedWord, Words};
use super::{Language, Run, fault};
use crate::execution::Next;
use crate::execution::corners::{Corner, is_size};
use crate::execution::mistakes;
use crate::moves::turns::unit;
use crate::moves::{
    Axis, AxisSet, Coordinates, Feed, FeedMode, MoveKind, Position, RotaryDirection,
};
use crate::text::program::Fault;
use trueaxis_contour::corner::Shape;

impl Run<'_> {
    /// Executes a path block; `None` if the block is none.
    pub(super) fn path_statement(&mut self, c: &mut Cursor<'_>) -> Result<Option<Next>, Fault> {
        const KINDS: [&str; 14] = [
            "L", "LP", "LN", "C", "CP", "CR", "CT", "CTP", "CC", "RND", "CHF", "APPR", "DEP",
            "CYCL",
        ];
        if c.accept("L") {
            // The usual case.
            let words = self.words(c)?;
            return self.travel(0, 0, &words).map(Some);
        }
        let mut ahead = c.clone();
        let Some(kind) = ahead.accept_any(&KINDS) else { return self.bare_words(c) };
        if kind == 13 {
            return Ok(None);
        }
        *c = ahead;
        let form = if matches!(kind, 11 | 12) {
            const FORMS: [&str; 9] = ["LT", "LN", "CT", "LCT", "PLT", "PLN", "PCT", "PLCT", "L"];
            match c.accept_any(&FORMS) {
                Some(index) => index,
                None => return Err(c.unknown()),
            }
        } else {
            0
        };
        if kind == 3 && (matches!(c.symbol(), Some(b'+' | b'-')) || c.is_number()) {
            // A block along the axis C alone: `C+90 R0 FMAX`.
            return self.single_axis(Axis::C, c).map(Some);
        }
        let at = c.offset();
        let leg = if kind == 10 { self.operand(c)? } else { None };
        let words = Words { at, ..self.words(c)? };
        check_words(kind, &words)?;
        match kind {
            8 => self.pole_statement(&words)?,
            9 | 10 => {
                self.corner(kind, leg, &words)?;
            }
            _ => return self.travel(kind, form, &words).map(Some),
        }
        Ok(Some(Next::Following))
    }

    /// Whether the next block is RND or CHF: the move of this block then ends before its target.
    fn corner_follows(&self) -> bool {
        let Some(active) = self.stack.last() else { return false };
        let source = self.core.program().source();
        let is_number = |b: &u8| b.is_ascii_digit() || matches!(b, b' ' | b'\t');
        let mut at = active.at;
        loop {
            let line = source.get(at..).unwrap_or_default();
            let word = &line[line.iter().take_while(|b| is_number(b)).count()..];
            match word.first() {
                None => return false,
                Some(b';' | b'*' | b'\n' | b'\r') => {}
                Some(_) => {
                    let word = word.get(..3).unwrap_or_default();
                    return [b"RND", b"CHF"].iter().any(|w| word.eq_ignore_ascii_case(*w));
                }
            }
            match word.iter().position(|b| matches!(b, b'\n' | b'\r')) {
                Some(end) => at = source.len() - word.len() + end + 1,
                None => return false,
            }
        }
    }

    /// RND R and CHF: a rounding or a chamfer with this side between the blocks before and after it; F is
    /// for it alone.
    fn corner(&mut self, kind: usize, leg: Option<f64>, words: &Words) -> Result<(), Fault> {
        let name = ["RND", "CHF"][kind - 9];
        let unit_mm = self.core.modes.unit_mm();
        let size = words.arc_radius.or(leg.map(|l| l * unit_mm)).filter(|size| is_size(*size));
        let Some(size) = size else {
            let message = format!("{name} needs a size above 0");
            return Err(fault("missing-value", words.at, message, "write RND R5 or CHF 2"));
        };
        let shape = if kind == 9 {
            Shape::Round { radius_mm: size }
        } else {
            Shape::ChamferLeg { leg_mm: size }
        };
        let modal = self.core.modes.feed;
        let rapid = self.feed(words);
        let own = std::mem::replace(&mut self.core.modes.feed, modal);
        let feed = (words.feed.is_some() && !rapid).then_some(own);
        if !self.core.corner_here(Corner { shape, feed, name, modal: false, at: words.at }) {
            let message = format!("{name} is not applied: no contour element stands before it");
            let hint = "write it between two blocks with L, C, CR or CT";
            self.core.warn("not-applied", name, words.at, message, hint);
        }
        Ok(())
    }

    /// A block that begins with an axis or with an M function.
    fn bare_words(&mut self, c: &mut Cursor<'_>) -> Result<Option<Next>, Fault> {
        const AXES: [&str; 8] = ["X", "Y", "Z", "A", "B", "U", "V", "W"];
        const INCREMENTS: [&str; 9] = ["IX", "IY", "IZ", "IA", "IB", "IC", "IU", "IV", "IW"];
        if c.is("M") {
            let words = self.words(c)?;
            return self.block_without_move(&words).map(Some);
        }
        if AXES.iter().chain(&INCREMENTS).any(|a| c.is(a)) {
            let words = self.words(c)?;
            return self.travel(0, 0, &words).map(Some);
        }
        Ok(None)
    }

    fn single_axis(&mut self, axis: Axis, c: &mut Cursor<'_>) -> Result<Next, Fault> {
        let value = self.value(c)?;
        let mut words = self.words(c)?;
        words.axes[axis as usize] = Some(super::words::Coordinate { value, incremental: false });
        self.travel(0, 0, &words)
    }

    /// Everything in a block around its move.
    fn travel(&mut self, kind: usize, form: usize, words: &Words) -> Result<Next, Fault> {
        check_words(kind, words)?;
        self.compensation(words);
        let rapid = self.feed(words);
        if self.functions(words, false)? {
            return Ok(Next::Finished);
        }
        self.settle();
        if self.corner_follows() {
            self.core.corner_after_next(self.position(), None);
        }
        match kind {
            0 => self.line(words, rapid)?,
            1 => {
                let target = self.polar_target(words)?;
                self.line_to(target, words, rapid, None)?;
            }
            2 => self.line_with_vectors(words, rapid)?,
            11 => self.approach(form, words, rapid)?,
            12 => {
                self.depart(form, words, rapid)?;
                self.end_compensation();
            }
            _ => self.circle(kind, words, rapid)?,
        }
        self.core.forget_corner();
        if self.functions(words, true)? {
            return Ok(Next::Finished);
        }
        self.cycle_of_block(words)
    }

    /// Sets the feed; `true` if this block is rapid.
    pub(super) fn feed(&mut self, words: &Words) -> bool {
        let per_minute = FeedMode::PerMinute;
        self.core.modes.feed = match words.feed {
            None => return false,
            Some(FeedWord::Rapid) => return true,
            Some(FeedWord::OfTool) => Feed { mode: per_minute, value: self.modes.feed_of_tool },
            Some(FeedWord::PerMinute(value)) => Feed { mode: per_minute, value },
            Some(FeedWord::PerRevolution(value)) => Feed { mode: FeedMode::PerRevolution, value },
            Some(FeedWord::PerTooth(value)) => {
                let message = "FZ: the number of teeth is not known, one is assumed";
                self.core.warn("feed-per-tooth", "", words.at, message, "write FU or F instead");
                Feed { mode: FeedMode::PerRevolution, value }
            }
        };
        false
    }

    fn line(&mut self, words: &Words, rapid: bool) -> Result<(), Fault> {
        if !words.has_axis() {
            return Ok(());
        }
        if words.calls(91) || words.calls(92) {
            return self.machine_line(words, rapid);
        }
        let mut target = words.target(&self.frames.position);
        if words.calls(130) {
            let place = self.frames.untilted().place(&target);
            target = self.frames.frame().inverse_place(&place).unwrap_or(target);
        }
        self.line_to(target, words, rapid, None)
    }

    /// A straight line; A B C are space angles of the tool with TCPM AXIS SPAT.
    fn line_to(
        &mut self,
        mut target: Position,
        words: &Words,
        rapid: bool,
        mut direction: Option<[f64; 3]>,
    ) -> Result<(), Fault> {
        if !rapid {
            self.core.modes.check_feed(words.at)?;
        }
        let mut named = words.named();
        if words.radius.or(words.angle).is_some() {
            let [first, second, _] = self.core.modes.plane.axes();
            named = named.with(first).with(second);
        }
        if words.calls(130) {
            named = AxisSet(named.0 | AxisSet::XYZ.0);
        }
        let rotary = [Axis::A, Axis::B, Axis::C];
        let turns = rotary.iter().any(|a| named.contains(*a));
        let before = self.frames.position;
        if self.modes.space_angles && turns {
            let angles = rotary.map(|a| target[a]);
            let turn = spatial(angles[0], angles[1], angles[2]);
            direction = Some(turn.linear.map(|row| row[2]));
            named.0 &= !0b11_1000;
        }
        let kind = if rapid { MoveKind::Rapid } else { MoveKind::Linear };
        let mut step = self.core.plain_move(kind, target, named);
        step.direction = direction;
        for (i, axis) in rotary.into_iter().enumerate() {
            let absolute = words.axes[axis as usize].is_some_and(|w| !w.incremental);
            if self.modes.shortest && absolute {
                step.rotary_directions[i] = RotaryDirection::Shortest;
            }
        }
        self.emit_move(step, words.at)?;
        target = self.frames.position;
        self.tangent = unit(std::array::from_fn(|i| target.0[i] - before.0[i]));
        if direction.is_some() {
            self.direction = direction;
        } else if turns {
            self.direction = None;
        }
        Ok(())
    }

    /// Where the axes are in the machine; without a machine as long as neither tilt nor TCP is on.
    pub(super) fn machine_place(&self) -> Position {
        let mut machine = self.frames.frame().place(&self.frames.position);
        machine[self.core.modes.plane.axes()[2]] += self.modes.tool_length_mm;
        self.core.axis_positions(machine)
    }

    /// M91: coordinates count from the machine zero.
    fn machine_line(&mut self, words: &Words, rapid: bool) -> Result<(), Fault> {
        if words.calls(92) {
            let message = "M92 is read as M91: the datum of the machine builder is not known";
            self.core.warn("not-applied", "M92", words.at, message, "check the path of the tool");
        }
        if !rapid {
            self.core.modes.check_feed(words.at)?;
        }
        let machine = words.target(&self.machine_place());
        let named = words.named();
        let kind = if rapid { MoveKind::Rapid } else { MoveKind::Linear };
        let mut step = self.core.plain_move(kind, machine, named);
        step.coordinates = Coordinates::Machine;
        self.emit_move(step, words.at)?;
        let mut place = machine;
        place[self.core.modes.plane.axes()[2]] -= self.modes.tool_length_mm;
        if let Some(position) = self.frames.frame().inverse_place(&place) {
            self.frames.position = position;
        }
        self.tangent = None;
        Ok(())
    }

    /// LN X Y Z NX NY NZ TX TY TZ: the tool stands along T; N is the normal of the surface.
    fn line_with_vectors(&mut self, words: &Words, rapid: bool) -> Result<(), Fault> {
        let vector = |parts: [Option<f64>; 3]| {
            parts.iter().any(Option::is_some).then(|| parts.map(|v| v.unwrap_or(0.0)))
        };
        let (normal, tool) = (vector(words.normal), vector(words.tool));
        for given in normal.iter().chain(&tool) {
            if unit(*given).is_none() {
                return Err(mistakes::zero_direction(words.at));
            }
        }
        if normal.is_some() {
            let message = "LN: 3D compensation by the normal is not applied";
            let hint = "the moves are those of the program";
            self.core.warn("not-applied", "LN normal", words.at, message, hint);
        }
        if tool.is_some() && !self.core.modes.tool_centre {
            let message = "LN has a tool direction, but M128 or FUNCTION TCPM is not on";
            self.core.warn(
                "direction-without-tcp",
                "",
                words.at,
                message,
                "write FUNCTION TCPM before it",
            );
        }
        let target = words.target(&self.frames.position);
        self.line_to(target, words, rapid, tool)
    }

    /// CC: the centre of circles and polar coordinates; without words the present place.
    fn pole_statement(&mut self, words: &Words) -> Result<(), Fault> {
        let [first, second, _] = self.core.modes.plane.axes();
        words.only_axes(&[first, second])?;
        let now = self.frames.position;
        let old = self.pole.unwrap_or([now[first], now[second]]);
        if !words.has_axis() {
            self.pole = Some([now[first], now[second]]);
            return Ok(());
        }
        let mut pole = old;
        for (value, axis) in pole.iter_mut().zip([first, second]) {
            if let Some(word) = words.axes[axis as usize] {
                *value = word.from(now[axis]);
            }
        }
        self.pole = Some(pole);
        Ok(())
    }

    /// The pole, which must be there.
    pub(super) fn pole(&self, at: usize) -> Result<[f64; 2], Fault> {
        self.pole.ok_or_else(|| {
            fault("missing-pole", at, "the centre (CC) is missing", "write CC before this block")
        })
    }

    /// Radius and angle of the present place about the pole.
    pub(super) fn polar_place(&self, pole: [f64; 2]) -> (f64, f64) {
        let [first, second, _] = self.core.modes.plane.axes();
        let now = self.frames.position;
        let (dx, dy) = (now[first] - pole[0], now[second] - pole[1]);
        (dx.hypot(dy), dy.atan2(dx).to_degrees())
    }

    /// The target of LP, CP and CTP; what is not given stays as it is.
    pub(super) fn polar_target(&mut self, words: &Words) -> Result<Position, Fault> {
        let pole = self.pole(words.at)?;
        let (radius, angle) = self.polar_place(pole);
        let radius = words.radius.map_or(radius, |w| w.from(radius));
        let angle = words.angle.map_or(angle, |w| w.from(angle));
        let [first, second, _] = self.core.modes.plane.axes();
        let mut target = words.target(&self.frames.position);
        let (sin, cos) = angle.to_radians().sin_cos();
        target[first] = pole[0] + radius * cos;
        target[second] = pole[1] + radius * sin;
        Ok(target)
    }
}

/// Words that the kind of block has no use for are said, not dropped.
fn check_words(kind: usize, words: &Words) -> Result<(), Fault> {
    let vectors = words.normal.iter().chain(&words.tool).any(Option::is_some);
    let polar = words.radius.or(words.angle).is_some();
    let wrong = [
        (vectors && kind != 2, "a vector needs LN"),
        (polar && !matches!(kind, 1 | 4 | 7 | 11 | 12), "polar coordinates need LP, CP or CTP"),
        (words.arc_radius.is_some() && !matches!(kind, 5 | 9 | 11 | 12), "a radius needs CR"),
        (words.ccw.is_some() && !(3..=7).contains(&kind), "DR needs a circle"),
        (
            words.length.or(words.sweep).is_some() && !matches!(kind, 11 | 12),
            "LEN and CCA need DEP",
        ),
        (
            matches!(kind, 9 | 10) && !words.functions.is_empty(),
            "an M function is not possible here",
        ),
        (matches!(kind, 9 | 10) && words.has_axis(), "an axis is not possible here"),
    ];
    match wrong.iter().find(|(found, _)| *found) {
        Some((_, why)) => {
            let message = "a word of this block has no effect".to_owned();
            Err(fault("unused-word", words.at, message, why))
        }
        None => Ok(()),
    }
}
