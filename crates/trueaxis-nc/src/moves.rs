//! What comes out: moves and what happens between them.

use std::fmt;
use std::ops::{Index, IndexMut};

/// The nine axes that a program can name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Axis {
    /// Linear.
    X,
    /// Linear.
    Y,
    /// Linear.
    Z,
    /// Rotary about X.
    A,
    /// Rotary about Y.
    B,
    /// Rotary about Z.
    C,
    /// Linear, parallel to X.
    U,
    /// Linear, parallel to Y.
    V,
    /// Linear, parallel to Z.
    W,
}

impl Axis {
    /// All, in the order of [`Position`].
    pub const ALL: [Self; 9] =
        [Self::X, Self::Y, Self::Z, Self::A, Self::B, Self::C, Self::U, Self::V, Self::W];

    /// The letter.
    pub fn letter(self) -> u8 {
        b"XYZABCUVW"[self as usize]
    }

    /// Whether it turns: its numbers are degrees.
    pub fn is_rotary(self) -> bool {
        matches!(self, Self::A | Self::B | Self::C)
    }
}

/// Axis values: mm for linear axes, degrees for rotary ones, as programs have them.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Position(pub [f64; 9]);

impl Index<Axis> for Position {
    type Output = f64;
    fn index(&self, axis: Axis) -> &f64 {
        &self.0[axis as usize]
    }
}

impl IndexMut<Axis> for Position {
    fn index_mut(&mut self, axis: Axis) -> &mut f64 {
        &mut self.0[axis as usize]
    }
}

impl Position {
    /// Axis by axis the sum.
    pub fn plus(&self, other: &Self) -> Self {
        Self(std::array::from_fn(|i| self.0[i] + other.0[i]))
    }

    /// Axis by axis the difference.
    pub fn minus(&self, other: &Self) -> Self {
        Self(std::array::from_fn(|i| self.0[i] - other.0[i]))
    }

    /// X and Y turned by an angle about Z; everything else as it was.
    pub fn turned(&self, angle_deg: f64) -> Self {
        if angle_deg == 0.0 {
            return *self;
        }
        let (sin, cos) = angle_deg.to_radians().sin_cos();
        let mut out = *self;
        out.0[0] = self.0[0] * cos - self.0[1] * sin;
        out.0[1] = self.0[0] * sin + self.0[1] * cos;
        out
    }
}

/// The plane of arcs and cycles.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Plane {
    /// G17.
    Xy,
    /// G18.
    Zx,
    /// G19.
    Yz,
}

impl Plane {
    /// First and second axis of the plane and the one that stands on it, right-handed.
    pub fn axes(self) -> [Axis; 3] {
        match self {
            Self::Xy => [Axis::X, Axis::Y, Axis::Z],
            Self::Zx => [Axis::Z, Axis::X, Axis::Y],
            Self::Yz => [Axis::Y, Axis::Z, Axis::X],
        }
    }
}

/// What F means.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FeedMode {
    /// G94: mm/min (degrees/min if only rotary axes move).
    PerMinute,
    /// G93: the move takes 1/F minutes.
    InverseTime,
    /// G95: mm per revolution of the spindle.
    PerRevolution,
}

/// A feed with its meaning.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Feed {
    /// What the value means.
    pub mode: FeedMode,
    /// mm/min, 1/min or mm/revolution; 0 where none is programmed.
    pub value: f64,
}

/// A circle or helix in the program frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Arc {
    /// Its plane.
    pub plane: Plane,
    /// The centre along the first and the second axis of the plane, mm.
    pub center_mm: [f64; 2],
    /// Begun turns: 1 up to and including a full circle.
    pub turns: u32,
    /// Counter-clockwise seen against the axis of the plane.
    pub ccw: bool,
}

/// How a place is reached.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum MoveKind {
    /// As fast as the machine can.
    Rapid,
    /// A straight line with feed.
    Linear,
    /// A circle or helix.
    Arc(Arc),
    /// A straight line that keeps step with the spindle.
    Thread {
        /// mm per revolution.
        pitch_mm: f64,
    },
    /// To the place and back, in step with the spindle.
    RigidTap {
        /// mm per revolution.
        pitch_mm: f64,
    },
    /// A straight line until the probe trips; here it never does.
    Probe,
    /// Nothing moves.
    Dwell {
        /// How long.
        seconds: f64,
    },
}

/// Where in which program a move was written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Origin {
    /// 0 is the main program, then subprograms in the order of their first call.
    pub program: u32,
    /// The line, from 1.
    pub line: u32,
}

/// One move of the tool.
///
/// The target is in the program frame: what the program says, after units and increments, before
/// work offset, shift, rotation and tool length, which [`Event`]s tell.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Move {
    /// How.
    pub kind: MoveKind,
    /// Where to, mm and degrees.
    pub target: Position,
    /// The direction of the tool axis where it is programmed as a vector, as it is written.
    pub direction: Option<[f64; 3]>,
    /// How fast; of no meaning to [`MoveKind::Rapid`].
    pub feed: Feed,
    /// The block.
    pub origin: Origin,
}

/// Which way the spindle turns.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Turning {
    /// Not at all.
    Stopped,
    /// Clockwise seen from the spindle.
    Clockwise,
    /// Counter-clockwise.
    CounterClockwise,
}

/// Coolant on or off.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Coolant {
    /// Mist on.
    Mist,
    /// Flood on.
    Flood,
    /// All off.
    Off,
}

/// On which side of the path the cutter stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CompensationSide {
    /// On the path.
    Off,
    /// Left of it.
    Left,
    /// Right of it.
    Right,
}

/// How corners are passed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PathControl {
    /// Along the programmed path.
    ExactPath,
    /// Stopping at each corner.
    ExactStop,
    /// Rounded, within P.
    Continuous,
}

/// What happens between the moves.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Event {
    /// A tool is prepared.
    ToolSelect(u32),
    /// That tool comes into the spindle.
    ToolChange(u32),
    /// The spindle turns or stops.
    Spindle(Turning),
    /// Revolutions per minute, or m/min with surface speed.
    SpindleSpeed(f64),
    /// The spindle is oriented to an angle.
    SpindleOrient {
        /// In degrees.
        angle_deg: f64,
    },
    /// Coolant.
    Coolant(Coolant),
    /// Another work offset, or another value of it: machine = offset + turn(program + shift) + tool.
    WorkOffset {
        /// Its number, from 1 for G54.
        index: u32,
        /// The offset.
        offset: Position,
        /// The turn about Z.
        rotation_deg: f64,
    },
    /// The shift of the axes (G92, G52).
    Shift(Position),
    /// The tool length, along each axis.
    ToolLength(Position),
    /// The tip of the tool is programmed (TCP) or the axes are.
    ToolCentre(bool),
    /// The plane of arcs and cycles.
    Plane(Plane),
    /// Radius compensation is wanted; the moves are those of the program.
    Compensation(CompensationSide),
    /// How corners are passed; tolerance in mm, 0 if none is given.
    Path {
        /// The way.
        control: PathControl,
        /// How far from the corner.
        tolerance_mm: f64,
    },
    /// A message to the operator.
    Message(String),
    /// A line for the log.
    Log(String),
    /// A stop, optional or not.
    Stop {
        /// Only if the operator wished so.
        optional: bool,
    },
    /// The end of the program.
    End,
    /// Something of no effect on the path.
    Note(&'static str),
}

/// A move or an event, in the order of execution.
#[derive(Debug, Clone, PartialEq)]
pub enum Step {
    /// The tool moves.
    Move(Move),
    /// Something else happens.
    Event(Event, Origin),
}

impl fmt::Display for Axis {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", char::from(self.letter()))
    }
}
