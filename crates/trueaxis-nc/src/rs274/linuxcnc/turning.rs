//! G70 to G72.2: a profile turned on a lathe.
//!
//! The block calls the subprogram Q. Its blocks are executed as those of any subprogram, but what moves is
//! gathered as the profile; at the end the cycle moves, as the block that called it.
//!
//! # Source
//! LinuxCNC 2.9 user manual, "G70 Lathe finishing cycle", "G71 G72 Lathe roughing cycles". What they leave open was
//! seen in the moves of `rs274` (`oracles/linuxcnc_lathe.py`): codes of the profile other than G0 to G3 have no
//! effect, R of an arc has no sign, and with G91 the control first goes to X and Z as if they were absolute.

use std::ops::Range;

use crate::execution::{Language, Next, arcs};
use crate::moves::{Arc, Axis, AxisSet, CompensationSide, Event, Move, MoveKind, Plane, Position};
use crate::rs274::code::{Action, Motion};
use crate::rs274::parameters::Locals;
use crate::rs274::{Passage, Run, fault};
use crate::text::program::{Block, Fault, Label};
use trueaxis_cycles::turning::{
    Corner, Passes, Pockets, Profile, Roughing, Stretch, TurnMove, Turned, TurningError,
};

/// What a profile may turn back, in the units of the program.
const TURNS_BACK: f64 = 1e-3;

const HINT: &str = "write G18 and G71 Q100 X20 Z2 D0.5 I1 R0.5 after O100 sub … O100 endsub";

/// A turning cycle whose profile is being read.
pub(in crate::rs274) struct Turning {
    cycle: Cycle,
    /// The block of the cycle: its program, text and line, and where its code is.
    call: (usize, Range<usize>, u32),
    at: usize,
    /// The calls that were open then.
    depth: usize,
    /// Where the tool was, where G91 leads it first, and where the cycle begins.
    before: Position,
    via: Option<Position>,
    start: Position,
    /// The axes that the block names.
    named: AxisSet,
    /// G1 until the profile has a code.
    motion: Motion,
    profile: Vec<(Stretch, Option<Corner>)>,
}

#[derive(Debug, Clone, Copy)]
enum Cycle {
    Rough(Roughing),
    /// The distances of the first and the last pass, and the number of passes.
    Finish {
        first_mm: f64,
        last_mm: f64,
        passes: f64,
    },
}

impl Run<'_> {
    /// G70 to G72.2: reads the words and calls the profile.
    pub(in crate::rs274) fn turning(
        &mut self,
        code: u16,
        at: usize,
        block: &Block,
    ) -> Result<Next, Fault> {
        self.settle();
        let number = self.words.take(b'Q');
        let cycle = self.turning_cycle(code);
        let is_number = |q: f64| q.fract() == 0.0 && (0.0..1e9).contains(&q);
        let on_contour = self.modes.compensation != CompensationSide::Off;
        let wrong = match (number, cycle) {
            _ if self.core.modes.plane != Plane::Zx => Some("the plane is not G18"),
            (None, _) => Some("Q, the subprogram of the profile, is missing"),
            (Some(q), _) if !is_number(q) => Some("Q is not a number of a subprogram"),
            (_, Cycle::Rough(how)) if how.step_mm <= 0.0 => {
                Some("I, from pass to pass, is not above 0")
            }
            (_, Cycle::Finish { passes, .. }) if !(0.0..=20.0).contains(&passes) => {
                Some("P is not a number of passes")
            }
            (_, Cycle::Rough(_)) if on_contour => Some("G41 or G42 is on"),
            _ if b"UW".iter().any(|l| self.words.look(*l).is_some()) => Some(
                "U or W, which later versions read as a shift of the profile, stands in its block",
            ),
            _ if self.turning.is_some() => Some("it is in the profile of another one"),
            _ => None,
        };
        if let Some(why) = wrong {
            return Err(impossible(why, at));
        }
        let (before, via, start) = self.turning_start(at);
        let named = self.words.axes();
        self.report_unused()?;
        let program = self.core.origin.program as usize;
        let depth = self.stack.len();
        let label = Label::Number(number.unwrap_or(0.0) as u64);
        let passage = Passage { program: &self.core.program().clone(), block };
        let next = self.enter(passage, &label, Locals::default(), 1, at)?;
        self.frames.position = start;
        let call = (program, block.span.clone(), block.line);
        let (motion, profile) = (Motion::Linear, Vec::new());
        let turning =
            Turning { cycle, call, at, depth, before, via, start, named, motion, profile };
        self.turning = Some(Box::new(turning));
        Ok(next)
    }

    fn turning_cycle(&mut self, code: u16) -> Cycle {
        let unit = self.core.modes.unit_mm();
        let mut or = |letter: u8, value: f64| self.words.take(letter).unwrap_or(value);
        if code == 700 {
            return Cycle::Finish {
                first_mm: or(b'D', 0.0) * unit,
                last_mm: or(b'E', 0.0) * unit,
                passes: or(b'P', 1.0),
            };
        }
        Cycle::Rough(Roughing {
            passes: if code < 720 { Passes::First } else { Passes::Second },
            leave_mm: or(b'D', 0.0) * unit,
            step_mm: or(b'I', 1.0) * unit,
            retract_mm: or(b'R', 0.5) * unit,
            pockets: match code % 10 {
                0 => Pockets::Cut,
                1 => Pockets::Left,
                _ => Pockets::Only,
            },
        })
    }

    /// Where the tool is, where it goes first with G91, and where the cycle begins.
    fn turning_start(&mut self, at: usize) -> (Position, Option<Position>, Position) {
        let before = self.frames.position;
        let mut absolute = before;
        for axis in [Axis::X, Axis::Z] {
            if let Some(value) = self.axis_word(axis) {
                absolute[axis] = value;
            }
        }
        let start = self.target();
        let via = (self.core.modes.incremental && absolute != before).then_some(absolute);
        if let Some(via) = via {
            let message = format!(
                "with G91 LinuxCNC first goes to X and Z as absolute places, X{:.3} Z{:.3} mm",
                via[Axis::X],
                via[Axis::Z]
            );
            let hint = "go to the start in a block before the cycle, or write G90";
            self.core.warn("turning-start", 0, at, message, hint);
        }
        (before, via, start)
    }

    /// A block of a profile: what moves is kept, all else has no effect.
    pub(in crate::rs274) fn profile_block(&mut self, block: &Block) -> Result<Next, Fault> {
        let at = block.span.start;
        let Some(mut turning) = self.turning.take() else { return Ok(Next::Following) };
        let result = self.profile_words(&mut turning, at);
        self.turning = Some(turning);
        result.map(|()| Next::Following)
    }

    fn profile_words(&mut self, turning: &mut Turning, at: usize) -> Result<(), Fault> {
        let given = |l: &u8| self.words.look(*l).is_some();
        let moves = b"XZUW".iter().any(given);
        for (action, at) in &self.words.actions {
            use Motion::{ArcClockwise, ArcCounterClockwise, Linear, Rapid};
            match action {
                Action::Motion(m @ (Rapid | Linear | ArcClockwise | ArcCounterClockwise)) => {
                    turning.motion = *m;
                }
                Action::Call | Action::Return | Action::LocalCall | Action::Turning(_) => {
                    return Err(impossible("its profile has a call, a return or a cycle", *at));
                }
                Action::Motion(Motion::Cancelled) | Action::MachineCoordinates => {}
                Action::Motion(_) | Action::Threading if moves => {
                    return Err(impossible("its profile has a motion other than G0 to G3", *at));
                }
                other if moves && other.takes_axis_words() => {
                    return Err(impossible("its profile has a code with X or Z of its own", *at));
                }
                _ => {}
            }
        }
        self.no_polar_words_left()?;
        let round = matches!(turning.motion, Motion::ArcClockwise | Motion::ArcCounterClockwise);
        if moves {
            let target = self.profile_target(at)?;
            self.profile_stretch(turning, target, round, at)?;
            self.frames.position = target;
        }
        let _ = self.words.take_all();
        Ok(())
    }

    /// X and Z, or U and W from where the profile is.
    fn profile_target(&mut self, at: usize) -> Result<Position, Fault> {
        let incremental = self.core.modes.incremental;
        let mut target = self.frames.position;
        for (axis, letter) in [(Axis::X, b'U'), (Axis::Z, b'W')] {
            let scale = self.core.modes.scale(axis);
            let by = self.words.take(letter).map(|value| value * scale);
            let to = self.axis_word(axis);
            if by.is_some() && (to.is_some() || incremental) {
                let why = "U or W stands with X or Z, or with G91";
                return Err(impossible(why, at));
            }
            let base = if incremental || by.is_some() { target[axis] } else { 0.0 };
            target[axis] = by.or(to).map_or(target[axis], |value| base + value);
        }
        Ok(target)
    }

    fn profile_stretch(
        &mut self,
        turning: &mut Turning,
        target: Position,
        round: bool,
        at: usize,
    ) -> Result<(), Fault> {
        let flat = |p: &Position| [p[Axis::Z], p[Axis::X]];
        let (from, to) = (flat(&self.frames.position), flat(&target));
        let (rounding, chamfer) = (self.length(b'A'), self.length(b'C'));
        if rounding.is_some() && chamfer.is_some() {
            return Err(impossible("A and C stand in one block of its profile", at));
        }
        let corner = |size: f64, straight| Corner { radius_mm: size.abs(), straight };
        let corner = rounding.map(|a| corner(a, false)).or(chamfer.map(|c| corner(c, true)));
        let arc = if round {
            let ccw = turning.motion == Motion::ArcCounterClockwise;
            let center = match self.length(b'R') {
                Some(radius) => {
                    let rounding = arcs::rounding_mm(radius);
                    arcs::by_radius([from, to], radius.abs(), ccw, rounding, at)?
                }
                None => self.by_center([from, to], at)?,
            };
            if from == to {
                self.core.left_out("a full circle in the profile of a turning cycle", at);
            }
            Some((center, ccw))
        } else {
            None
        };
        let corner = corner.filter(|c| c.radius_mm > 0.0);
        turning.profile.push((Stretch { from, to, arc }, corner));
        Ok(())
    }

    /// The subprogram of the profile has returned.
    pub(in crate::rs274) fn profile_is_complete(&self) -> bool {
        self.turning.as_ref().is_some_and(|t| self.stack.len() <= t.depth)
    }

    /// After an error in it.
    pub(in crate::rs274) fn forget_profile(&mut self) {
        if let Some(turning) = self.turning.take() {
            self.frames.position = turning.before;
        }
    }

    /// The moves of the cycle, as moves of the block that called it.
    pub(in crate::rs274) fn turn_profile(&mut self) -> Result<Next, Fault> {
        let Some(turning) = self.turning.take() else { return Ok(Next::Jumped) };
        let (program, text, line) = turning.call.clone();
        self.frames.position = turning.before;
        self.core.begin(program, text.start, line);
        if self.core.settings.report_blocks {
            self.core.emit(Event::Block { text });
        }
        self.core.modes.check_feed(turning.at)?;
        let turned = self.turned(&turning)?;
        for place in turning.via.into_iter().chain([turning.start]) {
            self.turn_to(MoveKind::Rapid, place, turning.named);
        }
        for pass in turned {
            if pass.inside {
                let message = "the distance D or E is taken into the material: it lies on the side of the \
                     start, as the control judges it by the way in and the last element";
                let hint = "begin the cycle farther out, or farther before the profile";
                self.core.warn("turning-inside", 0, turning.at, message, hint);
            }
            for m in &pass.moves {
                self.turn_by(m);
            }
        }
        self.modes.motion = Some(Motion::Linear);
        self.modes.base = Motion::Linear;
        self.modes.cycle.forget();
        Ok(Next::Jumped)
    }

    fn turned(&self, turning: &Turning) -> Result<Vec<Turned>, Fault> {
        let wrong = |e: TurningError| impossible(&e.to_string(), turning.at);
        let tolerance_mm = TURNS_BACK * self.core.modes.unit_mm();
        let profile = Profile::new(&turning.profile, tolerance_mm).map_err(wrong)?;
        match turning.cycle {
            Cycle::Rough(how) => Ok(vec![profile.rough(&how).map_err(wrong)?]),
            Cycle::Finish { first_mm, last_mm, passes } => (1..=passes as u32)
                .rev()
                .map(|n| {
                    let distance = f64::from(n - 1) * (first_mm - last_mm) / passes + last_mm;
                    profile.finish(distance).map_err(wrong)
                })
                .collect(),
        }
    }

    fn turn_by(&mut self, m: &TurnMove) {
        let plane = Plane::Zx;
        let kind = match m.arc {
            Some((center_mm, ccw)) => MoveKind::Arc(Arc { plane, center_mm, turns: 1, ccw }),
            None if m.rapid => MoveKind::Rapid,
            None => MoveKind::Linear,
        };
        let mut target = self.frames.position;
        (target[Axis::Z], target[Axis::X]) = (m.to[0], m.to[1]);
        let named = AxisSet(1 << Axis::X as u16 | 1 << Axis::Z as u16);
        self.turn_to(kind, target, named);
    }

    /// A move, if it leads anywhere.
    fn turn_to(&mut self, kind: MoveKind, target: Position, named: AxisSet) {
        if target == self.frames.position {
            return;
        }
        let (feed, origin) = (self.core.modes.feed, self.core.origin);
        self.emit_move(Move::plain(kind, target, named, feed, origin));
    }
}

fn impossible(why: &str, at: usize) -> Fault {
    fault("bad-turning", at, format!("the turning cycle is not possible: {why}"), HINT)
}
