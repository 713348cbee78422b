//! How the axes move while an instrument reads.

use trueaxis_machine::axis::{Approach, Command, MAX_AXES};

/// The state of motion of one reading: of the command, not of what follows it.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Motion {
    /// The feed of the tool against the workpiece; 0 standing still, none if it is not stated.
    /// Unit: mm/s.
    pub feed_mm_per_s: Option<f64>,
    /// The velocity of the command of each axis. Unit: mm/s or rad/s.
    pub speed: Command,
    /// Where to each axis turned last on this pass: 1 or −1; 0 if it did not. Unit: 1.
    pub turned: [f64; MAX_AXES],
    /// How long ago that was. Unit: s.
    pub turned_ago_s: [f64; MAX_AXES],
}

/// How and when something was read.
#[derive(Debug, Clone, Copy, Default)]
pub struct Moment {
    /// From which side each axis came.
    pub approach: Approach,
    /// How the axes move.
    pub motion: Motion,
    /// Which instrument reads.
    pub instrument: u32,
    /// When. Unit: s.
    pub time_s: f64,
}

impl Motion {
    /// A reading at this feed; what follows from the poses before it is not known yet.
    pub fn at_feed(feed_mm_per_s: f64) -> Self {
        Self { feed_mm_per_s: Some(feed_mm_per_s), ..Self::default() }
    }

    /// Whether the axes move while the instrument reads.
    pub fn is_moving(&self) -> bool {
        self.feed_mm_per_s.is_some_and(|f| f > 0.0)
    }
}
