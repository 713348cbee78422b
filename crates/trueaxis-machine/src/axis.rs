//! Axes: kind, direction, travel, limits; the only place of the ISO 841 sign.

use crate::errors::BodyName;
pub use trueaxis_geometry::AxisKind;
use trueaxis_geometry::Vec3;

/// At most this many axes; commands are arrays of this length.
pub const MAX_AXES: usize = 6;

/// Programmed axis positions in mm and rad, in the order of [`crate::Machine::axes`]; unused
/// entries are 0.
pub type Command = [f64; MAX_AXES];

/// The side from which each position is approached: +1 rising, −1 falling, 0 unknown (mean of both).
pub type Approach = [f64; MAX_AXES];

/// The side of the chain on which an axis is, as seen from the bed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AxisSide {
    /// It carries the workpiece; written with a prime (`C'`).
    Workpiece,
    /// It carries the tool.
    Tool,
}

/// The travel of an axis, mm or rad.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Travel {
    /// Between two ends, in rising order.
    Between(f64, f64),
    /// A rotary axis without ends.
    Unlimited,
    /// Not stated in the machine file.
    Unknown,
}

impl Travel {
    /// Whether a position lies within the travel; the rounding of a file's numbers is allowed.
    pub fn contains(&self, q: f64) -> bool {
        let [from, to] = self.ends();
        (from..=to).contains(&q)
    }

    /// The least and the largest position that it contains.
    pub(crate) fn ends(&self) -> [f64; 2] {
        match *self {
            Self::Between(from, to) => {
                let slack = 1e-9 * from.abs().max(to.abs()).max(1.0);
                [from - slack, to + slack]
            }
            // Any number, but not infinity.
            Self::Unlimited | Self::Unknown => [f64::MIN, f64::MAX],
        }
    }
}

/// Maximum velocity, acceleration and jerk, where stated; mm or rad, and s.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Limits {
    /// The largest velocity. Unit: mm/s or rad/s.
    pub velocity: Option<f64>,
    /// The largest acceleration. Unit: mm/s² or rad/s².
    pub acceleration: Option<f64>,
    /// The largest jerk. Unit: mm/s³ or rad/s³.
    pub jerk: Option<f64>,
}

/// One axis of the machine.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    /// Its ISO 841 letter.
    pub name: BodyName,
    /// Linear or rotary.
    pub kind: AxisKind,
    /// Unit vector of the positive direction, in the frame of its body at zero.
    pub direction: Vec3,
    /// Whether it carries the workpiece or the tool.
    pub carries: AxisSide,
    /// +1 if a positive command moves the *body* in the positive direction, else −1. Unit: 1.
    pub sense: f64,
    /// The range of its positions.
    pub travel: Travel,
    /// Its dynamic limits.
    pub limits: Limits,
}

/// The sense of ISO 841: a positive command moves the *tool relative to the workpiece* in the
/// positive direction, so an axis that carries the workpiece moves it the other way.
///
/// This is the only place where that sign is made.
pub fn iso_841_sense(carries: AxisSide) -> f64 {
    match carries {
        AxisSide::Tool => 1.0,
        AxisSide::Workpiece => -1.0,
    }
}

/// The direction that ISO 841 gives a letter: X, U and A along or about x, and so on.
pub fn iso_841_direction(name: BodyName) -> Vec3 {
    match name.letter() {
        'X' | 'U' | 'A' => Vec3::x(),
        'Y' | 'V' | 'B' => Vec3::y(),
        _ => Vec3::z(),
    }
}
