//! Time along the path: two laws.
//!
//! - [`three_phase`]: block by block with exact stop, as in Jiang et al.;
//! - [`Planner`]: jerk-limited with look-ahead across blocks, within the velocity, acceleration and
//!   jerk of every axis at every instant.
//!
//! ```text
//! Element ─passage─> pieces (line, arc, cell, blend) with V, A, J of the path
//!                                                                         docs/model.md eq. 42, 43
//!      ──merge───> runs of pieces with common V, A, J; acceleration 0 between them
//!      ──look-ahead (backward), then forward──> velocity between the runs  docs/model.md eq. 45
//!      ──7 phases per run──> time stamp of every node, Phase by Phase     docs/model.md eq. 44
//! ```
//!
//! What is drawn on an element has no effect on time (docs/decisions/0018-time-on-elements.md).

mod element;
mod joint;
mod path;
mod planner;
mod run;
mod scurve;
pub mod three_phase;
mod timeline;
mod trapezoid;

pub use element::{Element, Part, Parts, Tangent, Turn};
pub use planner::Planner;
pub use timeline::{Shape, State, Timeline};
pub use trapezoid::without_jerk_s;
use trueaxis_machine::axis::{Command, Limits, MAX_AXES};

/// What each axis can do, in mm or rad and s; infinite where nothing is stated.
///
/// Without any finite limit the path still stays finite: its velocity, acceleration and jerk end at
/// 1e6, 1e9 and 1e12 units of the path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AxisLimits {
    /// Largest velocities. Unit: mm/s or rad/s.
    pub velocity: [f64; MAX_AXES],
    /// Largest accelerations. Unit: mm/s² or rad/s².
    pub acceleration: [f64; MAX_AXES],
    /// Largest jerks. Unit: mm/s³ or rad/s³.
    pub jerk: [f64; MAX_AXES],
}

impl AxisLimits {
    /// Nothing is limited.
    pub const UNLIMITED: Self = Self {
        velocity: [f64::INFINITY; MAX_AXES],
        acceleration: [f64::INFINITY; MAX_AXES],
        jerk: [f64::INFINITY; MAX_AXES],
    };

    /// The stated limits of a machine's axes in their order; what is not stated is unlimited.
    pub fn from_stated<'a>(axes: impl IntoIterator<Item = &'a Limits>) -> Self {
        let mut limits = Self::UNLIMITED;
        for (i, axis) in axes.into_iter().take(MAX_AXES).enumerate() {
            limits.velocity[i] = axis.velocity.unwrap_or(f64::INFINITY);
            limits.acceleration[i] = axis.acceleration.unwrap_or(f64::INFINITY);
            limits.jerk[i] = axis.jerk.unwrap_or(f64::INFINITY);
        }
        limits
    }

    fn check(&self) -> Result<(), TimingError> {
        for (kind, values) in [
            (LimitKind::Velocity, &self.velocity),
            (LimitKind::Acceleration, &self.acceleration),
            (LimitKind::Jerk, &self.jerk),
        ] {
            for (axis, value) in values.iter().enumerate() {
                if value.is_nan() || *value < SMALLEST {
                    return Err(TimingError::Limit { axis, kind, value: *value });
                }
            }
        }
        Ok(())
    }
}

/// Lengths, feeds and limits below this are refused: they are slips, not programs.
const SMALLEST: f64 = 1e-9;
/// Positions and lengths beyond this are refused.
const LARGEST: f64 = 1e9;

/// One node of the path: where the axes shall be, and how the path gets there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Node {
    /// Commanded axis positions, mm and rad.
    pub command: Command,
    /// Length of the path from the node before, > 0: of the tool tip, or an angle where nothing
    /// but the tool axis moves; the caller chooses the unit of the path. Ignored at the first node.
    /// Unit: that of the path.
    pub length: f64,
    /// Largest dσ/dt on the path from the previous node; infinite for a rapid move.
    /// Unit: that of the path per s.
    pub feed: f64,
    /// Exact stop: the velocity at this node is zero.
    pub stop: bool,
    /// How far each axis may leave the corner at this node. A corner with an axis that
    /// turns off and may not leave it is a stop. Unit: mm or rad.
    pub tolerance: [f64; MAX_AXES],
    /// Rest after this node; more than 0 s makes it a stop.
    pub dwell_s: f64,
}

/// What binds an axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum LimitKind {
    /// Its velocity on this piece of the path.
    Velocity,
    /// Its acceleration while the path speeds up or slows down.
    Acceleration,
    /// Its jerk while the path speeds up or slows down.
    Jerk,
    /// Its acceleration or jerk in the rounded corner, or a corner that may not be rounded at all.
    Corner,
}

/// The axis (index as in the command) that keeps the path below the programmed feed, and why.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Limiting {
    /// Index of the axis.
    pub axis: usize,
    /// Which of its limits.
    pub kind: LimitKind,
}

/// When the path passes a node.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Timed {
    /// Number of the node, from 0.
    pub index: usize,
    /// Time at which the path is at the node (the middle of its blend), before its dwell.
    pub t_s: f64,
    /// Length of the path from the first node. Unit: that of the path.
    pub sigma: f64,
    /// Velocity along the path. Unit: that of the path per s.
    pub sigma_dot: f64,
    /// Half the length of the blend at the node; 0 without one. Unit: that of the path.
    pub blend: f64,
    /// The limit that keeps the velocity here below the programmed feed; none at a programmed stop.
    pub limiting: Option<Limiting>,
}

/// A stretch of time with constant jerk along the path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Phase {
    /// Begin.
    pub t_s: f64,
    /// How long.
    pub duration_s: f64,
    /// Length of the path at the begin. Unit: that of the path.
    pub sigma: f64,
    /// Velocity along the path at the begin. Unit: that of the path per s.
    pub velocity: f64,
    /// Acceleration along the path at the begin. Unit: that of the path per s².
    pub acceleration: f64,
    /// Jerk along the path. Unit: that of the path per s³.
    pub jerk: f64,
}

impl Phase {
    /// Length of the path, velocity and acceleration a time after the begin.
    pub fn after(&self, tau_s: f64) -> [f64; 3] {
        let (t, v, a, j) = (tau_s, self.velocity, self.acceleration, self.jerk);
        let length = self.sigma + t * (v + t * (a / 2.0 + t * j / 6.0));
        [length, v + t * (a + t * j / 2.0), a + t * j]
    }
}

/// Takes what the planner finds, in the order of time. A closure over [`Timed`] is one.
pub trait Receive {
    /// A node is passed.
    fn node(&mut self, timed: Timed);
    /// The motion goes on like this.
    fn phase(&mut self, _phase: &Phase) {}
}

impl<F: FnMut(Timed)> Receive for F {
    fn node(&mut self, timed: Timed) {
        self(timed);
    }
}

/// Numbers that no path can have.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum TimingError {
    /// A limit is not a positive number.
    #[error("the {kind:?} limit of axis {axis} is {value}: it must be at least 1e-9, or infinite")]
    Limit {
        /// Index of the axis.
        axis: usize,
        /// Which limit.
        kind: LimitKind,
        /// As given.
        value: f64,
    },
    /// A number of a node is out of range.
    #[error("node {index}: {what} is {value}: it must be {expected}")]
    Node {
        /// Number of the node, from 0.
        index: usize,
        /// The number's name.
        what: &'static str,
        /// As given.
        value: f64,
        /// What it may be.
        expected: &'static str,
    },
}

impl Node {
    fn check(&self, index: usize) -> Result<(), TimingError> {
        let fault = |what, value, expected| Err(TimingError::Node { index, what, value, expected });
        if let Some(q) = self.command.iter().find(|q| q.is_nan() || q.abs() > LARGEST) {
            return fault("a position", *q, "between -1e9 and 1e9");
        }
        if index > 0 && !(SMALLEST..=LARGEST).contains(&self.length) {
            return fault("the length", self.length, "between 1e-9 and 1e9");
        }
        if index > 0 && (self.feed.is_nan() || self.feed < SMALLEST) {
            return fault("the feed", self.feed, "at least 1e-9, or infinite");
        }
        if let Some(d) = self.tolerance.iter().find(|d| d.is_nan() || **d < 0.0) {
            return fault("a tolerance", *d, "0 or more");
        }
        if !(0.0..=LARGEST).contains(&self.dwell_s) {
            return fault("the dwell", self.dwell_s, "between 0 and 1e9 s");
        }
        Ok(())
    }
}
