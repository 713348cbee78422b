//! How a control leads a tool along a contour.

use trueaxis_contour::radius::{Outside, Rules};

/// How a tool comes to the contour.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Entry {
    /// To the place perpendicular to the start of the contour: FANUC type A, SINUMERIK NORM, HEIDENHAIN.
    Perpendicular,
    /// The same, round the start of the contour where the way would cross the contour: SINUMERIK KONT.
    Round,
    /// The entry is the first element: its end is compensated, and the corner after it is like all others.
    Element,
}

/// What a control does.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Behaviour {
    pub rules: Rules,
    pub entry: Entry,
    /// Its first move may be an arc.
    pub enters_on_arcs: bool,
    /// A move without motion in the plane goes to the programmed place if the compensation has ended.
    pub ends_at_once: bool,
    /// Of the slightly different radii of a written arc that at its end counts.
    pub radius_at_end: bool,
    pub feed_at: FeedAt,
}

impl Behaviour {
    /// What most controls do; each states where it differs.
    pub const USUAL: Self = Self {
        rules: Rules { outside: Outside::Arc, smooth_rad: 0.0 },
        entry: Entry::Perpendicular,
        enters_on_arcs: false,
        ends_at_once: false,
        radius_at_end: false,
        feed_at: FeedAt::Centre,
    };
}

/// Where the feed of arcs counts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum FeedAt {
    /// At the centre of the tool.
    Centre,
    /// On the contour.
    Contour,
    /// On the contour, but the centre is not faster than programmed.
    Inside,
}
