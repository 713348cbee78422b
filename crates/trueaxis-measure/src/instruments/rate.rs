//! What is stated of a drift, and how far drifts have gone.

use trueaxis_geometry::Mat3;

/// Whether a drift that is no even rate is looked for: a random walk.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Walk {
    /// Where the residual is larger than by chance.
    #[default]
    IfNeeded,
    /// Always: its size is found from the readings even if they could do without.
    Always,
    /// Never.
    Never,
}

/// What is stated of the drift of a set-up.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Drift {
    /// What is not an even rate.
    pub walk: Walk,
    /// When a rate counts from. Unit: s.
    pub from_s: f64,
}

/// How far drifts of 1 by the hour have gone at a reading.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Drifted {
    /// Along each axis of the machine, in the frame of the reference, h.
    pub along_axes: Mat3,
    /// Since the first reading of the instrument. Unit: h.
    pub hours: f64,
}
