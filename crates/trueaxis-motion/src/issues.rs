//! Issues on the machine: travel, speed, flips, and bodies that meet.

use super::timing::LimitKind;
use super::{Batch, Node, Observer, Stamp, Timing};
use std::collections::BTreeMap;
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{AxisKind, Command, Travel};
use trueaxis_machine::tcp::TipControl;
use trueaxis_nc::moves::Origin;

/// The kind of an issue.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub enum IssueKind {
    /// Two bodies touch or cut into each other.
    Collision {
        /// One of them.
        first: String,
        /// The other.
        second: String,
    },
    /// Two bodies come closer than the requested clearance.
    NearMiss {
        /// One of them.
        first: String,
        /// The other.
        second: String,
    },
    /// The cutter goes through the stock in rapid.
    RapidInStock {
        /// The part of the tool.
        first: String,
        /// The body that it meets.
        second: String,
    },
    /// The cutter takes something off the part.
    Gouge {
        /// Its number.
        tool: u32,
    },
    /// An axis leaves its travel.
    OverTravel {
        /// Its index.
        axis: usize,
    },
    /// At the programmed feed an axis is too fast.
    OverSpeed {
        /// Its index.
        axis: usize,
        /// Whether the control slows down for it; the timing of three phases keeps the feed.
        slows: bool,
        /// Near a pole of the rotary axes.
        near_pole: bool,
    },
    /// An axis' acceleration or jerk keeps the speed below the programmed one.
    SlowedDown {
        /// Its index.
        axis: usize,
        /// Which limit.
        limit: LimitKind,
    },
    /// A rotary axis turns far while the tool axis hardly turns.
    RotaryFlip {
        /// Its index.
        axis: usize,
    },
}

/// One issue over a stretch of the path.
#[derive(Debug, Clone, PartialEq)]
pub struct Issue {
    /// Its kind.
    pub kind: IssueKind,
    /// Whether the part or the machine is in danger; the others cost time only.
    pub critical: bool,
    /// The block where it begins.
    pub first: Origin,
    /// The block where it ends.
    pub last: Origin,
    /// When it begins, s.
    pub from_s: f64,
    /// When it ends, s.
    pub to_s: f64,
    /// The worst value: position, speed, speed ratio, angle or clearance; see [`issue_text`](crate::report::issue_text).
    /// Unit: mm, rad, mm/s, rad/s or 1, by its kind.
    pub value: f64,
    /// The limit. Unit: that of the value.
    pub limit: f64,
    /// Nodes in it.
    pub nodes: u64,
    /// How many stretches it holds: above 1 where there are so many of its kind that the nearest were put together. What lies
    /// between them counts as part of it.
    pub stretches: u64,
}

/// Kept of each kind; where there are twice as many, the nearest are put together.
const MOST: usize = 200;

/// Stretches of an issue that costs only time are one if they are nearer than this.
const PAUSE_S: f64 = 1.0;

/// The tool axis counts as near a pole below this sine: 2°.
const NEAR_POLE: f64 = 0.035;

/// A rotary axis that turns this much more than the tool axis flips, rad.
const FLIP_RAD: f64 = std::f64::consts::FRAC_PI_2;

/// Issues in their order; consecutive ones of a kind are one.
#[derive(Debug, Default)]
pub struct Log {
    closed: BTreeMap<IssueKind, Vec<Issue>>,
    open: BTreeMap<IssueKind, Issue>,
}

impl Log {
    /// Records an issue at a node; the value farthest from its limit is the worst of a stretch.
    pub fn note(&mut self, kind: IssueKind, node: &Node, stamp: &Stamp, value: f64, limit: f64) {
        self.note_at(kind, (node.origin, stamp.time_s), value, limit);
    }

    /// The same at a block and a time.
    pub fn note_at(&mut self, kind: IssueKind, at: (Origin, f64), value: f64, limit: f64) {
        use IssueKind::{Collision, Gouge, OverTravel, RapidInStock};
        let critical = matches!(
            kind,
            Collision { .. } | Gouge { .. } | OverTravel { .. } | RapidInStock { .. }
        );
        let (origin, time_s) = at;
        let entry = self.open.entry(kind.clone()).or_insert(Issue {
            kind,
            critical,
            first: origin,
            last: origin,
            from_s: time_s,
            to_s: time_s,
            value,
            limit,
            nodes: 0,
            stretches: 1,
        });
        if (value - limit).abs() > (entry.value - entry.limit).abs() {
            (entry.value, entry.limit) = (value, limit);
        }
        (entry.last, entry.to_s) = (origin, time_s);
        entry.nodes += 1;
    }

    /// An issue that was not recorded at this time has ended; one that costs only time, after a pause.
    pub fn close(&mut self, time_s: f64) {
        let is_over = |t: &Issue| t.to_s < time_s - if t.critical { 0.0 } else { PAUSE_S };
        if !self.open.values().any(is_over) {
            return;
        }
        let over = self.open.iter().filter(|(_, t)| is_over(t)).map(|(k, _)| k.clone());
        for kind in over.collect::<Vec<_>>() {
            if let Some(issue) = self.open.remove(&kind) {
                self.keep(issue);
            }
        }
    }

    fn keep(&mut self, issue: Issue) {
        let closed = self.closed.entry(issue.kind.clone()).or_default();
        closed.push(issue);
        if closed.len() >= 2 * MOST {
            put_together(closed, MOST);
        }
    }

    fn close_all(&mut self) {
        let open = std::mem::take(&mut self.open);
        open.into_values().for_each(|t| self.keep(t));
    }
}

/// Puts the nearest of one kind together until so many are left; none is lost.
fn put_together(closed: &mut Vec<Issue>, most: usize) {
    let gap = |pair: &[Issue]| pair[1].from_s - pair[0].to_s;
    let mut gaps: Vec<f64> = closed.windows(2).map(gap).collect();
    let joins = closed.len().saturating_sub(most);
    if joins == 0 || joins > gaps.len() {
        return;
    }
    let (below, widest, _) = gaps.select_nth_unstable_by(joins - 1, f64::total_cmp);
    // Of gaps that are as wide as the widest to be closed, the first ones.
    let widest = *widest;
    let mut equal = joins - below.iter().filter(|gap| **gap < widest).count();
    let mut kept: Vec<Issue> = Vec::with_capacity(most);
    for issue in closed.drain(..) {
        let Some(last) = kept.last_mut() else {
            kept.push(issue);
            continue;
        };
        let gap = issue.from_s - last.to_s;
        if gap < widest {
            last.join(&issue);
        } else if gap == widest && equal > 0 {
            equal -= 1;
            last.join(&issue);
        } else {
            kept.push(issue);
        }
    }
    *closed = kept;
}

impl Issue {
    /// Takes a later one of its kind in.
    fn join(&mut self, later: &Self) {
        if (later.value - later.limit).abs() > (self.value - self.limit).abs() {
            (self.value, self.limit) = (later.value, later.limit);
        }
        (self.last, self.to_s) = (later.last, later.to_s);
        self.nodes += later.nodes;
        self.stretches += later.stretches;
    }
}

/// The issues of a whole run.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct IssueList {
    /// In the order of time.
    pub list: Vec<Issue>,
}

impl IssueList {
    /// All that some logs hold.
    pub fn of(logs: impl IntoIterator<Item = Log>) -> Self {
        let mut all = Self::default();
        for mut log in logs {
            log.close_all();
            all.list.extend(log.closed.into_values().flatten());
        }
        all.list.sort_by(|a, b| a.from_s.total_cmp(&b.from_s));
        all
    }

    /// How many stretches there are in all.
    pub fn found(&self) -> u64 {
        self.list.iter().map(|t| t.stretches).sum()
    }

    /// Whether part or machine are in danger anywhere.
    pub fn is_critical(&self) -> bool {
        self.list.iter().any(|t| t.critical)
    }
}

/// Watches travel, speed and flips of the axes.
#[derive(Debug)]
pub struct AxisWatch {
    machine: Machine,
    control: Option<TipControl>,
    slows: bool,
    /// The issues that were found.
    pub log: Log,
    before: Option<(Command, trueaxis_geometry::Vec3)>,
}

impl AxisWatch {
    /// Empty, for a machine whose control keeps the limits of its axes.
    pub fn on(machine: &Machine) -> Self {
        let control = TipControl::of(machine);
        Self { machine: machine.clone(), control, slows: true, log: Log::default(), before: None }
    }

    /// The same with the timing of the run: that of three phases knows no limit of an axis.
    #[must_use]
    pub fn timed(mut self, timing: Timing) -> Self {
        self.slows = !matches!(timing, Timing::ThreePhase { .. });
        self
    }

    fn see_travel(&mut self, node: &Node, stamp: &Stamp) {
        for i in 0..self.machine.axes().len() {
            let (travel, q) = (self.machine.axes()[i].travel, node.command[i]);
            if let Travel::Between(low, high) = travel
                && !travel.contains(q)
            {
                let limit = if q > high { high } else { low };
                self.log.note(IssueKind::OverTravel { axis: i }, node, stamp, q, limit);
            }
        }
    }

    /// The programmed feed against the velocities of the axes.
    fn see_speed(&mut self, node: &Node, stamp: &Stamp, before: &Command) {
        if node.is_rapid() || node.length <= 0.0 {
            return;
        }
        let mut slowed = false;
        for (i, axis) in self.machine.axes().iter().enumerate() {
            let Some(limit) = axis.limits.velocity else { continue };
            let demanded = (node.command[i] - before[i]).abs() / node.length * node.speed;
            if demanded > limit * (1.0 + 1e-9) {
                let rotary = axis.kind == AxisKind::Rotary;
                let near = |c: &TipControl| c.pole_sine(&node.command) < NEAR_POLE;
                let near_pole = rotary && self.control.as_ref().is_some_and(near);
                let kind = IssueKind::OverSpeed { axis: i, slows: self.slows, near_pole };
                self.log.note(kind, node, stamp, demanded, limit);
                slowed = true;
            }
        }
        // Speeding up and slowing down at rests is not an issue; what an axis cannot follow is.
        if let (false, Some(held)) = (slowed, stamp.held_by)
            && stamp.speed < 0.999 * node.speed
            && !node.stop
        {
            let kind = IssueKind::SlowedDown { axis: held.axis, limit: held.kind };
            self.log.note(kind, node, stamp, stamp.speed / node.speed, 1.0);
        }
    }

    fn see_flip(&mut self, node: &Node, stamp: &Stamp, before: &Command, turned_rad: f64) {
        if node.is_rapid() {
            return;
        }
        for (i, axis) in self.machine.axes().iter().enumerate() {
            let by = (node.command[i] - before[i]).abs();
            if axis.kind == AxisKind::Rotary && by - turned_rad > FLIP_RAD {
                self.log.note(IssueKind::RotaryFlip { axis: i }, node, stamp, by, turned_rad);
            }
        }
    }
}

impl Observer for AxisWatch {
    fn path(&mut self, batch: &Batch<'_>) {
        for (i, (node, stamp)) in batch.nodes.iter().zip(batch.stamps).enumerate() {
            let axis = batch.deviation(i).nominal_axis.vector();
            self.see_travel(node, stamp);
            if let Some((before, axis_before)) = self.before {
                let turned = axis.cross(&axis_before).norm().atan2(axis.dot(&axis_before));
                self.see_speed(node, stamp, &before);
                self.see_flip(node, stamp, &before, turned);
            }
            self.before = Some((node.command, axis));
            self.log.close(stamp.time_s);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Notes of one kind at whole seconds, each second a stretch of its own; what the log says of them.
    fn logged(seconds: &[u32], worst_at: u32) -> Vec<Issue> {
        let mut log = Log::default();
        for s in seconds {
            let at = (Origin { program: 0, line: *s }, f64::from(*s));
            let value = if *s == worst_at { 9.0 } else { 2.0 };
            log.note_at(IssueKind::OverTravel { axis: 0 }, at, value, 1.0);
            log.close(f64::from(*s) + 0.5);
        }
        let list = IssueList::of([log]);
        assert_eq!(list.found(), seconds.len() as u64);
        list.list
    }

    /// Far more stretches than are kept: each of them lies in an entry, the worst too, and the widest gaps stay open.
    #[test]
    fn law_no_stretch_is_lost_however_many_there_are() {
        let mut state = 7_u32;
        let mut random = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            1 + (state >> 16) % 9
        };
        for count in [1, 2, MOST, 2 * MOST - 1, 2 * MOST, 50 * MOST + 3] {
            let mut second = 0;
            let mut seconds: Vec<u32> =
                (0..count).map(|_| (second += random(), second).1).collect();
            // A pause that no one may take for trouble.
            seconds.iter_mut().skip(count / 2).for_each(|s| *s += 1_000_000);
            let worst_at = seconds[count / 3];
            let list = logged(&seconds, worst_at);
            assert!(list.len() < 2 * MOST && list.len() >= count.min(MOST));
            assert!(list.is_sorted_by(|a, b| a.to_s < b.from_s));
            assert_eq!(list.iter().map(|t| t.nodes).sum::<u64>(), count as u64);
            for s in &seconds {
                let holds = |t: &&Issue| (t.from_s..=t.to_s).contains(&f64::from(*s));
                let entry = list.iter().find(holds).unwrap_or_else(|| panic!("{s} of {count}"));
                assert!(entry.first.line <= *s && *s <= entry.last.line);
                assert!(*s != worst_at || entry.value == 9.0);
            }
            assert!(list.iter().all(|t| t.to_s - t.from_s < 900_000.0), "the pause is closed");
        }
    }
}
