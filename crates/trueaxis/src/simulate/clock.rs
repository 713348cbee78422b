//! When each node is passed: the planner of the control.

use super::axis_path::Node;

/// When and how fast a node is passed.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Stamp {
    /// From the start of the program, s.
    pub time_s: f64,
    /// Along the path, mm/s or deg/s.
    pub speed: f64,
    /// The axis (its index) and the limit that keep the speed below the programmed one.
    pub held_by: Option<(usize, Limit)>,
}

/// What an axis cannot exceed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Limit {
    /// Its velocity.
    Velocity,
    /// Its acceleration.
    Acceleration,
    /// Its jerk.
    Jerk,
}

pub(super) struct Clock {
    time_s: f64,
}

impl Clock {
    pub fn new() -> Self {
        Self { time_s: 0.0 }
    }

    pub fn push(&mut self, node: &Node, out: &mut dyn FnMut(Stamp)) {
        let speed = if node.speed.is_finite() { node.speed } else { 500.0 };
        if speed > 0.0 {
            self.time_s += node.length / speed;
        }
        self.time_s += node.dwell_s;
        out(Stamp { time_s: self.time_s, speed, held_by: None });
    }

    pub fn finish(&mut self, _out: &mut dyn FnMut(Stamp)) {}
}
