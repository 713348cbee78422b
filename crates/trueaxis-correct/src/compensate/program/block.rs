//! One block with corrected numbers: the same words in the same order, and what has to be added.

use super::computed::{Expression, Resting};
use super::number::{Grid, Of, Unit};
use super::refuse::refusal;
use super::text::Edits;
use super::words::{Word, Words};
use trueaxis_geometry::Vec3;
use trueaxis_machine::axis::Command;
use trueaxis_motion::axis_path::{AxisPath, Fault, Straight};
use trueaxis_nc::Control;
use trueaxis_nc::moves::{
    Arc, Axis, AxisSet, Coordinates, Move, MoveKind, Position, RotaryDirection,
};

/// A block that is being written.
pub(super) struct Block<'b> {
    pub m: &'b Move,
    pub source: &'b [u8],
    pub words: &'b Words,
    /// Its numbers are increments unless they say otherwise.
    pub incremental: bool,
    /// The unit of F.
    pub feed_unit: Unit,
    pub control: Control,
    pub grid: Grid,
    /// The axes whose words are corrected, if the block is no cut: the others keep their words.
    pub only: Option<AxisSet>,
    /// Of such a block: words are added where an axis stands farther than this from where the cut begins, mm and rad; `None`: never.
    pub adds_beyond: Option<[f64; 2]>,
    /// The circle that the block becomes, if it stays one.
    pub arc: Option<Arc>,
    /// The tool axis is programmed by vectors.
    pub vectors: bool,
    /// A feed that a block before has replaced.
    pub feed_again: Option<f64>,
    /// What of it rests on computed values.
    pub resting: Resting,
    /// Local parameters of Klartext that are free.
    pub locals: &'b [u16],
    pub edits: Edits,
    /// Calculations of Klartext that stand before it.
    pub before: Vec<String>,
    /// Its expressions that were corrected.
    pub expressions: Vec<Expression>,
    /// The lines that follow it.
    pub further: Vec<String>,
    /// Axes that the block has new words for.
    pub added: Vec<Axis>,
    pub pieces: usize,
}

/// The piece of it that is to be written.
pub(super) struct Written {
    /// Which, from 0.
    pub piece: usize,
    /// Its part of the way.
    pub share: f64,
    /// Where the axes shall stand at its end, and where the control believes the tip to be then.
    pub command: Command,
    pub tip: Vec3,
    pub held: Option<Held>,
}

/// What is wanted of a rapid where the cut begins to which its words lead.
#[derive(Debug, Clone, Copy)]
pub(super) struct Held {
    /// Where the axes shall stand there, and where the control believes the tip to be then.
    pub command: Command,
    pub tip: Vec3,
    /// The axes whose words hold there.
    pub axes: AxisSet,
    /// Whether the direction of the tool does.
    pub turns: bool,
}

/// What the control makes of a piece.
pub(super) struct Next {
    pub m: Move,
    /// The feed that is to be stated again in the next block.
    pub feed_again: Option<f64>,
}

/// A word on its way into the text.
pub(super) struct Put {
    pub letters: &'static str,
    pub text: String,
}

/// The letters of the axes in the order of [`Axis::ALL`].
const LETTERS: [&str; 9] = ["X", "Y", "Z", "A", "B", "C", "U", "V", "W"];

impl Block<'_> {
    /// Writes a piece that begins where `path` stands; `turns_deg`: only rotary axes move, and the
    /// feed counts along so many degrees.
    pub fn write(
        &mut self,
        path: &AxisPath<'_>,
        step: &Written,
        turns_deg: Option<f64>,
    ) -> Result<Next, Fault> {
        if step.piece == 0 {
            self.is_one_point()?;
        }
        let now = path.words_of(path.command(), self.m.coordinates);
        let mut wanted = self.wanted(path, &now, step);
        let mut aimed = &step.command;
        if let Some(held) = &step.held {
            let Held { command, tip, .. } = *held;
            let there = self.wanted(path, &now, &Written { command, tip, ..*step });
            for axis in Axis::ALL.into_iter().filter(|axis| held.axes.contains(*axis)) {
                wanted[axis] = there[axis];
            }
            aimed = if held.turns { &held.command } else { aimed };
        }
        let mut m = Move {
            kind: self.kind(),
            target: now,
            named: AxisSet::default(),
            rotary_directions: [RotaryDirection::AsWritten; 3],
            direction: None,
            ..*self.m
        };
        let mut puts = Vec::new();
        for axis in Axis::ALL {
            let by_vector = axis.is_rotary() && self.vectors;
            if path.axis_of(axis).is_some() && !by_vector {
                self.axis(axis, (now[axis], wanted[axis]), step.piece, &mut m, &mut puts)?;
            }
        }
        if self.vectors && self.turns(path, aimed) {
            self.direction(path, (step.piece, aimed), &mut m, &mut puts)?;
        } else if self.only.is_some() {
            m.direction = self.m.direction;
        }
        if let Some(arc) = self.arc {
            self.arc_words(&arc, &now, &mut puts)?;
        }
        let feed_again = self.feed(&now, step, turns_deg, &m, &mut puts)?;
        if step.piece == 0 {
            self.first(puts);
        } else if !puts.is_empty() {
            self.follow(&puts);
        }
        if self.pieces > 1 && step.piece + 1 == self.pieces {
            self.functions_at_end();
        }
        Ok(Next { m, feed_again })
    }

    /// Whether the block leads the tool axis, or has to.
    fn turns(&self, path: &AxisPath<'_>, aimed: &Command) -> bool {
        let Some(only) = self.only else { return true };
        if self.m.direction.is_some() {
            return only.contains(Axis::A);
        }
        let directions = path.direction_of(aimed).zip(path.direction_of(path.command()));
        self.adds_beyond.zip(directions).is_some_and(|([_, rad], (wanted, now))| {
            wanted.iter().zip(now).any(|(wanted, now)| (wanted - now).abs() > rad)
        })
    }

    /// Whether an axis that has no word in a block before a cut gets one, which leads it by so much, mm or deg.
    fn adds(&self, axis: Axis, by: f64) -> bool {
        let named = self.m.named.contains(axis);
        self.adds_beyond.is_some_and(|[mm, rad]| {
            !named && by.abs() > if axis.is_rotary() { rad.to_degrees() } else { mm }
        })
    }

    fn kind(&self) -> MoveKind {
        if let Some(arc) = self.arc {
            return MoveKind::Arc(arc);
        }
        match self.m.kind {
            MoveKind::Arc(_) | MoveKind::SpatialArc(_) => MoveKind::Linear,
            kind => kind,
        }
    }

    pub(super) fn is_circle(&self) -> bool {
        matches!(self.m.kind, MoveKind::Arc(_) | MoveKind::SpatialArc(_))
    }

    /// Words for axis positions; where rotary axes are rounded, linear ones go with them.
    fn wanted(&self, path: &AxisPath<'_>, now: &Position, step: &Written) -> Position {
        let exact = path.words_of(&step.command, self.m.coordinates);
        let (Some(control), Some(_), Straight::Axes) =
            (path.control(), self.grid.increments, path.straight())
        else {
            return exact;
        };
        let mut rounded = step.command;
        for axis in Axis::ALL.into_iter().filter(|a| a.is_rotary()) {
            if let Some(i) = path.axis_of(axis) {
                let at = (now[axis], exact[axis]);
                rounded[i] += self.rotary_rounding(axis, at, step.piece).to_radians();
            }
        }
        match control.place(step.tip, &mut rounded) {
            true => path.words_of(&rounded, self.m.coordinates),
            false => exact,
        }
    }

    /// What rounding, or a number that is near enough to stay, does to a rotary axis, degrees.
    fn rotary_rounding(&self, axis: Axis, (now, exact): (f64, f64), piece: usize) -> f64 {
        let rounded = self.grid.round(exact, Of::Rotary);
        let stays = match self.words.axes[axis as usize].as_ref().filter(|_| piece == 0) {
            None => now,
            Some(word) if word.is_increment(self.incremental) => return rounded - exact,
            Some(_) => {
                let old = self.m.target[axis];
                let turns = self.way(axis) != RotaryDirection::AsWritten;
                old + if turns { 360.0 * ((exact - old) / 360.0).round() } else { 0.0 }
            }
        };
        match self.grid.same(exact, stays, Of::Rotary) {
            true => stays - exact,
            false => rounded - exact,
        }
    }

    fn axis(
        &mut self,
        axis: Axis,
        (now, wanted): (f64, f64),
        piece: usize,
        m: &mut Move,
        puts: &mut Vec<Put>,
    ) -> Result<(), Fault> {
        let of = if axis.is_rotary() { Of::Rotary } else { Of::Linear };
        let is_led = self.only.is_none_or(|only| only.contains(axis));
        if !is_led && !self.adds(axis, wanted - now) {
            return self.stays(axis, m);
        }
        let words = self.words;
        let word = words.axes[axis as usize].as_ref().filter(|_| piece == 0);
        let Some(word) = word else {
            if piece == 0 && self.m.named.contains(axis) && !self.is_circle() {
                return Err(self.no_word(axis));
            }
            let value = self.grid.round(wanted, of);
            if !self.grid.same(wanted, now, of) {
                (m.target[axis], m.named) = (value, m.named.with(axis));
                if piece == 0 {
                    self.added.push(axis);
                }
                let shown = if self.incremental { value - now } else { value };
                puts.push(match self.increment(axis, value - now, of)? {
                    Some(put) => put,
                    None => Put { letters: LETTERS[axis as usize], text: self.text(shown, of) },
                });
            }
            return Ok(());
        };
        m.named = m.named.with(axis);
        let old = self.m.target[axis];
        let is_increment = word.is_increment(self.incremental);
        let (value, shown) = if is_increment {
            let old = word.value.ok_or_else(|| self.computed(axis))?;
            let by = wanted - now;
            let by = if self.grid.same(by, old, of) { old } else { self.grid.round(by, of) };
            (now + by, Some(by).filter(|by| *by != old))
        } else {
            let turn = self.way(axis) != RotaryDirection::AsWritten;
            if axis.is_rotary() {
                m.rotary_directions[axis as usize - Axis::A as usize] = self.way(axis);
            }
            let wanted = if turn { wanted.rem_euclid(360.0) } else { wanted };
            let value = self.grid.round(wanted, of);
            let value = if turn && value >= 360.0 { 0.0 } else { value };
            // By the shortest way 350° and −10° are the same word.
            let apart = if turn { within_half_a_turn(wanted - old) } else { wanted - old };
            if self.grid.same(old + apart, old, of) {
                (old, None)
            } else {
                let offset = self.offset(axis, word, old)?;
                (value, Some(value - offset))
            }
        };
        m.target[axis] = value;
        match shown {
            Some(shown) => self.put_number(word, shown, of),
            None => Ok(()),
        }
    }

    /// The word of an axis that is not corrected keeps its text.
    fn stays(&self, axis: Axis, m: &mut Move) -> Result<(), Fault> {
        if !self.m.named.contains(axis) {
            return Ok(());
        }
        m.named = m.named.with(axis);
        if axis.is_rotary() {
            m.rotary_directions[axis as usize - Axis::A as usize] = self.way(axis);
        }
        let word = self.words.axes[axis as usize].as_ref();
        let increments = word.map_or(self.incremental, |w| w.is_increment(self.incremental));
        if !increments {
            m.target[axis] = self.m.target[axis];
            return Ok(());
        }
        let by = word.and_then(|w| w.value).ok_or_else(|| self.computed(axis))?;
        m.target[axis] += by;
        Ok(())
    }

    /// What the control adds to the written number.
    fn offset(&self, axis: Axis, word: &Word, target: f64) -> Result<f64, Fault> {
        let value = word.value.ok_or_else(|| self.computed(axis))?;
        let turns = self.way(axis) != RotaryDirection::AsWritten;
        let near = |a: f64| {
            let by = if turns { within_half_a_turn(a - target) } else { a - target };
            by.abs() <= 1e-9 * (1.0 + target.abs())
        };
        if near(value) {
            return Ok(0.0);
        }
        let other = if self.grid.unit == Unit::Inch { value / 25.4 } else { value * 25.4 };
        if near(other) && !axis.is_rotary() {
            let message = "the unit of the block is not the one that its text states".to_owned();
            let hint = "state G20 or G21 at the beginning of the program and of each subprogram";
            return Err(refusal(self.m.origin, "inch-program", message, hint));
        }
        if self.m.coordinates == Coordinates::Machine || self.words.machine.is_some() {
            return Ok(target - value);
        }
        let round = |v: f64| (v * 1e4).round() / 1e4;
        let (value, target) = (round(value), round(target));
        let unit = if axis.is_rotary() { "deg" } else { "mm" };
        let message = format!(
            "{axis}{value} leads to {target} {unit}: polar or scaled coordinates, a corner, or a cycle"
        );
        let hint = "write plain moves with X, Y and Z; a cycle as its single moves";
        Err(refusal(self.m.origin, "other-coordinates", message, hint))
    }

    fn computed(&self, axis: Axis) -> Fault {
        let message = format!("the value of {axis} is computed, and would have to be corrected");
        let hint = "write a number instead";
        refusal(self.m.origin, "computed-coordinate", message, hint)
    }

    fn no_word(&self, axis: Axis) -> Fault {
        let message =
            format!("the block moves {axis} without a word {axis} that could be corrected");
        let hint = "write plain coordinates instead of poles, angles and contours";
        refusal(self.m.origin, "no-axis-word", message, hint)
    }

    fn way(&self, axis: Axis) -> RotaryDirection {
        match axis.is_rotary() {
            true => self.m.rotary_directions[axis as usize - Axis::A as usize],
            false => RotaryDirection::AsWritten,
        }
    }

    fn text(&self, value: f64, of: Of) -> String {
        self.grid.text(value, of, self.control)
    }

    /// The tool axis as a vector.
    fn direction(
        &mut self,
        path: &AxisPath<'_>,
        (piece, aimed): (usize, &Command),
        m: &mut Move,
        puts: &mut Vec<Put>,
    ) -> Result<(), Fault> {
        let here = self.m.direction.filter(|_| piece == 0);
        let (Some(wanted), Some(now)) =
            (path.direction_of(aimed), path.direction_of(path.command()))
        else {
            return Ok(());
        };
        let length = here.map_or(1.0, |d| d.iter().map(|v| v * v).sum::<f64>().sqrt());
        let old = here.unwrap_or(now);
        let wanted = wanted.map(|part| part * length);
        if (0..3).all(|i| self.grid.same(wanted[i], old[i], Of::Direction)) {
            m.direction = here;
            return Ok(());
        }
        let words = &self.words.vector;
        if here.is_some() {
            let fits = words.iter().zip(old).all(|(word, part)| match word {
                Some(word) => word.value.is_some_and(|v| (v - part).abs() < 1e-12),
                None => part == 0.0,
            });
            if !fits || words.iter().all(Option::is_none) {
                let message =
                    "the direction of the tool is not given by three plain numbers".into();
                let hint = "write it as A3= B3= C3=, I J K or TX TY TZ, or write the rotary axes";
                return Err(refusal(self.m.origin, "computed-coordinate", message, hint));
            }
        }
        let mut written = [0.0; 3];
        for i in 0..3 {
            written[i] = self.grid.round(wanted[i], Of::Direction);
            match words[i].as_ref().filter(|_| here.is_some()) {
                Some(word) => self.put_number(word, written[i], Of::Direction)?,
                None => {
                    let text = self.text(written[i], Of::Direction);
                    let letters = match self.control {
                        Control::Sinumerik840d => ["A3=", "B3=", "C3="][i],
                        Control::Heidenhain => ["TX", "TY", "TZ"][i],
                        Control::Fanuc | Control::Haas | Control::LinuxCnc => ["I", "J", "K"][i],
                    };
                    puts.push(Put { letters, text });
                }
            }
        }
        m.direction = Some(written);
        Ok(())
    }
}

/// The same turn between −180° and 180°.
fn within_half_a_turn(deg: f64) -> f64 {
    deg - 360.0 * (deg / 360.0).round()
}
