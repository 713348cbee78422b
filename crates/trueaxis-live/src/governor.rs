//! The governor: what may be written now, if anything. No clock, no socket, no file: a function of the time since the last
//! step and of what was read.
//!
//! ```text
//!     Off ──run──> Arm ──first reading and target──> Run <──> Hold ──hold time──> RampDown
//!                                   foreign value, homed again ──> Latched ──a person confirms──> Arm
//! ```
//!
//! Whatever comes in, these hold (`tests/laws.rs`): |offset| ≤ limit; a write changes an axis by at most its step, and in a
//! time T by at most slew · T + one step; one write is under way at a time; nothing is written in E-stop, unhomed, without
//! a link, while the control forbids it, in [`State::Off`], [`State::Hold`] and [`State::Latched`].

mod axis;
mod reason;

pub use axis::{AxisLimits, increments_of};
pub use reason::{Reason, STATES, State};

use crate::control::{Mode, Seen};
use axis::AxisMemory;
use serde::{Deserialize, Serialize};

/// Time between two steps counts at most so much, s: after a suspend nothing runs away.
pub const LONGEST_STEP_S: f64 = 0.5;

/// What stands in the plan.
#[derive(Debug, Clone, PartialEq)]
pub struct Settings {
    /// One for each live axis.
    pub axes: Vec<AxisLimits>,
    /// How long a written value may take until it is read back.
    pub window_s: f64,
    /// How long a Hold lasts before the policy acts.
    pub hold_s: f64,
    /// What the policy does then.
    pub after_hold: AfterHold,
    /// Whether it may do so while a program moves the axes; otherwise it asks for feed hold and waits.
    pub ramp_in_cut: bool,
    /// The modes in which offsets change.
    pub modes: Vec<Mode>,
    /// What is done with a value at the start that is not the one of the journal.
    pub on_difference: OnDifference,
    /// Whether the control has a watchdog that may have ramped the offsets down while there was no link.
    pub ladder_ramps: bool,
}

/// What is done after a Hold that lasts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AfterHold {
    /// The offset stays.
    Stay,
    /// It goes to zero by its slew.
    Ramp,
}

/// What is done with a value that is not the one of the journal.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum OnDifference {
    /// A person decides.
    Latch,
    /// It is the base on which the correction is written.
    Adopt,
}

/// What this program has written before, from the journal of this machine.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, Deserialize)]
pub struct Owned {
    /// What stood there before, and stays.
    pub base: Vec<i32>,
    /// The last value, base included.
    pub last: Vec<i32>,
    /// The one before, which may stand there if the last was not written any more.
    pub before: Vec<i32>,
}

/// What is known at the start of an earlier run.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub enum Earlier {
    /// There was none, or it has left nothing: what stands in the control is another's.
    #[default]
    Nothing,
    /// What it has left.
    Owned(Owned),
    /// There was one, and what it has left is not known any more.
    Lost,
}

impl From<Option<Owned>> for Earlier {
    fn from(owned: Option<Owned>) -> Self {
        owned.map_or(Self::Nothing, Self::Owned)
    }
}

impl Owned {
    /// Nothing of ours is left in the control.
    pub fn is_nothing(&self) -> bool {
        self.last == self.base && self.before == self.base
    }

    fn is_of(&self, axes: usize) -> bool {
        [&self.base, &self.last, &self.before].iter().all(|list| list.len() == axes)
    }

    /// What is not ours of values that were not expected: all of them where nothing of ours was left in the control; else
    /// the base stays, and what stands there counts as ours, so that the correction is never added to itself.
    fn base_under(&self, held: &[i32]) -> Vec<i32> {
        if self.base == self.last { held.to_vec() } else { self.base.clone() }
    }
}

/// What the loop reads in one cycle.
#[derive(Debug, Clone, PartialEq)]
pub struct Inputs<'a> {
    /// From the control; none without a link, and why.
    pub seen: Result<&'a Seen, Reason>,
    /// Where the offsets shall go, in increments, base not included; or why that is not known.
    pub target: Result<&'a [f64], Reason>,
    /// Whether the correction is wanted.
    pub run: bool,
    /// A person has confirmed what was latched.
    pub confirmed: bool,
    /// The journal takes no entry: nothing is written that it does not know.
    pub journal_fails: bool,
}

/// What is to be done.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Order {
    /// The state.
    pub state: State,
    /// Why.
    pub reason: Reason,
    /// What to write, if anything: whole offsets in increments, base included.
    pub write: Option<Vec<i32>>,
    /// Feed hold is asked for.
    pub ask_hold: bool,
    /// An axis has used four fifths of its limit.
    pub near_limit: bool,
}

/// The governor with its memory.
#[derive(Debug, Clone)]
pub struct Governor {
    settings: Settings,
    state: State,
    reason: Reason,
    axes: Vec<AxisMemory>,
    earlier: Earlier,
    /// In Hold since, s.
    held_s: f64,
    /// A write that is not read back yet, and for how long.
    under_way_s: Option<f64>,
    /// No link since the last reading.
    was_lost: bool,
    /// Not homed since.
    was_unhomed: bool,
    /// No target for, s.
    missing_s: f64,
    /// A refused write is not tried again before, s.
    pause_s: f64,
    refusals: u32,
    /// A person has confirmed.
    is_confirmed: bool,
    /// What is owned is known from this run, not from the journal.
    has_run: bool,
    /// Feed hold was asked for, and the reason for it lasts.
    asks_hold: bool,
}

impl Governor {
    /// Starts in [`State::Off`], with what the journal knows.
    pub fn new(settings: Settings, earlier: impl Into<Earlier>) -> Self {
        let axes = settings.axes.iter().map(AxisMemory::new).collect();
        Self {
            settings,
            state: State::Off,
            reason: Reason::NotAsked,
            axes,
            earlier: earlier.into(),
            held_s: 0.0,
            under_way_s: None,
            was_lost: false,
            was_unhomed: false,
            missing_s: 0.0,
            pause_s: 0.0,
            asks_hold: false,
            refusals: 0,
            is_confirmed: false,
            has_run: false,
        }
    }

    /// The settings.
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// What this program owns: for the journal, before it is written.
    pub fn owned(&self) -> Owned {
        Owned {
            base: self.axes.iter().map(|a| a.base).collect(),
            last: self.axes.iter().map(AxisMemory::whole).collect(),
            before: self.axes.iter().map(|a| a.before).collect(),
        }
    }

    /// The state after the last step.
    pub fn state(&self) -> State {
        self.state
    }

    /// The present correction of each axis, in increments, base not included.
    pub fn corrections(&self) -> Vec<i32> {
        self.axes.iter().map(|a| a.own).collect()
    }

    /// Slew or step hold an axis back from its target.
    pub fn is_behind(&self) -> bool {
        self.axes.iter().any(|a| a.is_behind)
    }

    /// What comes next is no jump from the last target.
    pub fn forget_target(&mut self) {
        self.axes.iter_mut().for_each(AxisMemory::forget_target);
    }

    /// A write was refused: the next one waits, longer each time.
    pub fn write_failed(&mut self, refused: bool) {
        // What stands there is not known: it is read when the window is over, and taken as it is.
        self.under_way_s = Some(0.0);
        if refused {
            self.refusals = (self.refusals + 1).min(6);
            self.pause_s = f64::from(1u32 << self.refusals);
        }
    }

    /// One step.
    pub fn step(&mut self, dt_s: f64, inputs: &Inputs<'_>) -> Order {
        // Not a number, or back in time, is no time.
        let dt_s = if dt_s > 0.0 { dt_s.min(LONGEST_STEP_S) } else { 0.0 };
        self.axes.iter_mut().for_each(|axis| axis.pass(dt_s));
        self.pause_s = (self.pause_s - dt_s).max(0.0);
        let under_way = self.under_way_s.map(|s| s + dt_s);
        self.under_way_s = under_way;
        if inputs.target.is_err() {
            self.missing_s += dt_s;
        }
        let seen = match inputs.seen {
            Ok(seen) => seen,
            Err(ref reason) => return self.without_link(dt_s, reason, inputs.run),
        };
        if let Some(order) = self.settle(seen, inputs) {
            return order;
        }
        let (state, reason) = self.next(dt_s, seen, inputs);
        self.enter(state, reason, dt_s);
        let moves = match self.state {
            State::Run => inputs.target.as_ref().ok().copied(),
            State::RampDown => Some(&[][..]),
            _ => None,
        };
        let write =
            moves.filter(|_| self.may_write(seen, inputs)).and_then(|target| self.moved(target));
        self.order(write, seen)
    }

    /// No link: nothing is written, and what the control does meanwhile is not known.
    fn without_link(&mut self, dt_s: f64, reason: &Reason, run: bool) -> Order {
        self.was_lost |= self.state != State::Off && self.state != State::Arm;
        let kept = matches!(self.state, State::Off | State::Latched | State::Arm);
        let (state, reason) = match (kept, run) {
            (true, _) if self.state == State::Latched => (State::Latched, self.reason.clone()),
            (true, true) => (State::Arm, reason.clone()),
            (true, false) => (State::Off, Reason::NotAsked),
            (false, _) => (State::Hold, reason.clone()),
        };
        self.enter(state, reason, dt_s);
        let near_limit = self.axes.iter().any(AxisMemory::is_near_limit);
        let (state, reason) = (self.state, self.reason.clone());
        Order { state, reason, write: None, ask_hold: false, near_limit }
    }

    /// Compares what the control holds with what was written; an order, if that ends the step.
    fn settle(&mut self, seen: &Seen, inputs: &Inputs<'_>) -> Option<Order> {
        if seen.offsets.len() != self.axes.len() {
            return Some(self.latch(Reason::Foreign, seen));
        }
        self.is_confirmed |= inputs.confirmed;
        match self.state {
            State::Off if !inputs.run => return None,
            State::Latched if !self.is_confirmed || self.may_still_come() => {
                return Some(self.latch(self.reason.clone(), seen));
            }
            State::Off | State::Arm | State::Latched => {
                return self.arm(seen, inputs);
            }
            _ => self.is_confirmed = false,
        }
        let late = self.under_way_s.is_some_and(|s| s > self.settings.window_s);
        if seen.released && self.settings.ladder_ramps {
            self.axes.iter_mut().zip(&seen.offsets).for_each(|(axis, held)| axis.release(*held));
            self.under_way_s = None;
        }
        let ramped = (self.was_lost || seen.tripped) && self.settings.ladder_ramps;
        let known = |(axis, held): (&AxisMemory, &i32)| {
            *held == axis.whole()
                || (self.under_way_s.is_some() && *held == axis.before)
                || (ramped && axis.is_between(*held))
        };
        if !self.axes.iter().zip(&seen.offsets).all(known) {
            return Some(self.latch(Reason::Foreign, seen));
        }
        let all = self.axes.iter().zip(&seen.offsets).all(|(axis, held)| *held == axis.whole());
        if all {
            // Only a write that has arrived ends the pauses between attempts.
            if self.under_way_s.take().is_some() {
                self.refusals = 0;
            }
        } else if late || (ramped && self.under_way_s.is_none()) {
            // A part of the axes has its value, or the ladder has moved them: what stands there is taken as it is.
            self.axes.iter_mut().zip(&seen.offsets).for_each(|(axis, held)| axis.take(*held));
            self.under_way_s = None;
        }
        self.was_lost &= self.under_way_s.is_some();
        None
    }

    /// What is owned, from this run or the journal.
    fn known(&self) -> Earlier {
        if self.has_run { Earlier::Owned(self.owned()) } else { self.earlier.clone() }
    }

    /// Nothing of this run or of an earlier one is in the control, nor on its way there.
    fn has_nothing_there(&self) -> bool {
        let is_nothing = match self.known() {
            Earlier::Nothing => true,
            Earlier::Owned(owned) => owned.is_nothing(),
            Earlier::Lost => false,
        };
        !self.may_still_come() && is_nothing
    }

    /// What was written last may become visible yet.
    fn may_still_come(&self) -> bool {
        self.under_way_s.is_some_and(|s| s <= self.settings.window_s)
    }

    /// The first reading: takes over what the control holds, without a jump.
    fn arm(&mut self, seen: &Seen, inputs: &Inputs<'_>) -> Option<Order> {
        if !inputs.run && self.has_nothing_there() {
            self.enter(State::Off, Reason::NotAsked, 0.0);
            return Some(self.order(None, seen));
        }
        if let Some(reason) = self.forbidden(seen) {
            self.enter(State::Arm, reason, 0.0);
            return Some(self.order(None, seen));
        }
        // A zero is touched in Hold, so a run without it must come there.
        let fault = inputs.target.as_ref().err();
        if let Some(reason) = fault.filter(|reason| !matches!(reason, Reason::Setup { .. })) {
            let reason = reason.clone();
            self.enter(State::Arm, reason, 0.0);
            return Some(self.order(None, seen));
        }
        let fits = |owned: &Owned| {
            let (base, last, before) = (&owned.base, &owned.last, &owned.before);
            let ramps = self.settings.ladder_ramps;
            owned.is_of(self.axes.len())
                && seen.offsets.iter().enumerate().all(|(i, held)| {
                    let between = |end: i32| (base[i].min(end)..=base[i].max(end)).contains(held);
                    *held == last[i] || *held == before[i] || (ramps && between(last[i]))
                })
        };
        let accepted = self.is_confirmed || self.settings.on_difference == OnDifference::Adopt;
        let base = match &self.known() {
            Earlier::Owned(owned) if fits(owned) => owned.base.clone(),
            Earlier::Owned(owned) if accepted && owned.is_of(self.axes.len()) => {
                owned.base_under(&seen.offsets)
            }
            Earlier::Owned(_) if !accepted => {
                return Some(self.latch(Reason::Difference, seen));
            }
            // It may be ours, and the correction would be added to itself: only a person knows.
            Earlier::Lost if !self.is_confirmed && seen.offsets.iter().any(|held| *held != 0) => {
                return Some(self.latch(Reason::Lost, seen));
            }
            // Confirmed: what stands there counts as ours.
            Earlier::Lost => vec![0; self.axes.len()],
            // Nothing of ours is known there: what stands there is another's.
            _ => seen.offsets.clone(),
        };
        let fit = |((axis, held), base): ((&AxisMemory, &i32), &i32)| axis.can_adopt(*held, *base);
        if !self.axes.iter().zip(&seen.offsets).zip(&base).all(fit) {
            return Some(self.latch(Reason::Difference, seen));
        }
        for ((axis, held), base) in self.axes.iter_mut().zip(&seen.offsets).zip(base) {
            axis.adopt(*held, base);
        }
        self.has_run = true;
        self.under_way_s = None;
        (self.was_lost, self.was_unhomed, self.missing_s) = (false, false, 0.0);
        self.is_confirmed = false;
        self.enter(State::Run, Reason::Follows, 0.0);
        None
    }

    /// What of the state of the control forbids a change of the offsets now.
    fn forbidden(&self, seen: &Seen) -> Option<Reason> {
        if seen.emergency {
            return Some(Reason::Emergency);
        }
        if !seen.homed {
            return Some(Reason::NotHomed);
        }
        if seen.tripped {
            return Some(Reason::Watchdog);
        }
        if seen.released {
            return Some(Reason::Released);
        }
        if seen.inhibited {
            return Some(Reason::Inhibited);
        }
        (!self.settings.modes.contains(&seen.mode)).then_some(Reason::Mode)
    }

    /// The state that follows.
    fn next(&mut self, dt_s: f64, seen: &Seen, inputs: &Inputs<'_>) -> (State, Reason) {
        if self.state == State::Off {
            return (State::Off, Reason::NotAsked);
        }
        self.was_unhomed |= !seen.homed;
        if seen.homed && std::mem::take(&mut self.was_unhomed) {
            return (State::Latched, Reason::HomedAgain);
        }
        if let Some(reason) = self.forbidden(seen) {
            return (State::Hold, reason);
        }
        if inputs.journal_fails {
            return (State::Hold, Reason::Journal);
        }
        if self.pause_s > 0.0 {
            return (State::Hold, Reason::WriteRefused);
        }
        if !inputs.run {
            let done = self.axes.iter().all(|axis| axis.own == 0) && self.under_way_s.is_none();
            return if done {
                (State::Off, Reason::NotAsked)
            } else {
                (State::RampDown, Reason::NotAsked)
            };
        }
        let fault = match inputs.target {
            Err(ref reason) => Some(reason.clone()),
            Ok(target) => self.check(target),
        };
        let Some(reason) = fault else {
            let limited = self.axes.iter().any(|axis| axis.is_limited);
            return (State::Run, if limited { Reason::Limit } else { Reason::Follows });
        };
        let lasts = self.state == State::RampDown
            || (self.state == State::Hold && self.held_s + dt_s > self.settings.hold_s);
        let free = !seen.cutting || self.settings.ramp_in_cut;
        match self.settings.after_hold {
            AfterHold::Ramp if lasts && free => (State::RampDown, reason),
            _ => (State::Hold, reason),
        }
    }

    /// Whether a target is one: finite, and no jump from the last.
    fn check(&mut self, target: &[f64]) -> Option<Reason> {
        if target.len() != self.axes.len() || target.iter().any(|t| !t.is_finite()) {
            return Some(Reason::NotFinite);
        }
        let missing_s = self.missing_s;
        if self.axes.iter().zip(target).any(|(axis, target)| axis.jumps(*target, missing_s)) {
            return Some(Reason::Jump);
        }
        self.missing_s = 0.0;
        self.axes.iter_mut().zip(target).for_each(|(axis, target)| axis.wish(*target));
        None
    }

    fn may_write(&self, seen: &Seen, inputs: &Inputs<'_>) -> bool {
        self.under_way_s.is_none() && self.forbidden(seen).is_none() && !inputs.journal_fails
    }

    /// One step of all axes towards the target, or towards zero where there is none.
    fn moved(&mut self, target: &[f64]) -> Option<Vec<i32>> {
        let mut changed = false;
        self.axes.iter_mut().for_each(|axis| axis.before = axis.whole());
        for (i, axis) in self.axes.iter_mut().enumerate() {
            let to = if target.is_empty() { Some(0) } else { axis.wanted(target[i]) };
            changed |= axis.go(to);
        }
        changed.then(|| {
            self.under_way_s = Some(0.0);
            self.axes.iter().map(AxisMemory::whole).collect()
        })
    }

    fn latch(&mut self, reason: Reason, seen: &Seen) -> Order {
        self.enter(State::Latched, reason, 0.0);
        self.order(None, seen)
    }

    fn enter(&mut self, state: State, reason: Reason, dt_s: f64) {
        self.held_s = if state == State::Hold && self.state == State::Hold {
            self.held_s + dt_s
        } else {
            0.0
        };
        (self.state, self.reason) = (state, reason);
    }

    fn order(&mut self, write: Option<Vec<i32>>, seen: &Seen) -> Order {
        let holds = matches!(self.state, State::Hold | State::Latched);
        let lasts = self.state == State::Latched || self.held_s > self.settings.hold_s;
        let own = self.axes.iter().any(|axis| axis.own != 0);
        // A program that has stopped for it is not cutting, and must not go on for that.
        self.asks_hold = holds && own && (self.asks_hold || (lasts && seen.cutting));
        Order {
            state: self.state,
            reason: self.reason.clone(),
            write,
            ask_hold: self.asks_hold,
            near_limit: self.axes.iter().any(AxisMemory::is_near_limit),
        }
    }
}
