//! The result of an execution: moves, and the events between them.
//!
//! Positions are in mm for linear axes and in degrees for rotary axes, as in programs. Frames:
//!
//! - *program frame*: the coordinates of the program, in mm whatever the programmed unit;
//! - *basic frame*: the machine coordinates while all rotary axes are at zero; [`Frame`] leads from
//!   the program frame to it;
//! - *machine coordinates*: axis positions from machine zero ([`Coordinates::Machine`]).

pub mod chain;
pub mod turns;

use std::fmt;
use std::ops::{Index, IndexMut, Range};

/// The nine axes of NC programs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Axis {
    /// Linear axis X.
    X,
    /// Linear axis Y.
    Y,
    /// Linear axis Z.
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
    /// All axes, in the order of [`Position`].
    pub const ALL: [Self; 9] =
        [Self::X, Self::Y, Self::Z, Self::A, Self::B, Self::C, Self::U, Self::V, Self::W];

    /// The letter of the axis as an ASCII byte.
    pub fn letter(self) -> u8 {
        b"XYZABCUVW"[self as usize]
    }

    /// Whether it is a rotary axis, with positions in degrees.
    pub fn is_rotary(self) -> bool {
        matches!(self, Self::A | Self::B | Self::C)
    }
}

/// Positions of the nine axes: mm for linear axes, degrees for rotary axes.
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
    /// The sum, axis by axis.
    pub fn plus(&self, other: &Self) -> Self {
        Self(std::array::from_fn(|i| self.0[i] + other.0[i]))
    }

    /// The difference, axis by axis.
    pub fn minus(&self, other: &Self) -> Self {
        Self(std::array::from_fn(|i| self.0[i] - other.0[i]))
    }

    /// X and Y rotated by an angle about Z; the other axes unchanged.
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

/// A set of axes, one bit each.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct AxisSet(pub u16);

impl AxisSet {
    /// X, Y and Z.
    pub const XYZ: Self = Self(0b111);
    /// A, B and C.
    pub const ROTARY: Self = Self(0b11_1000);

    /// Whether it contains a rotary axis.
    pub fn has_rotary(self) -> bool {
        self.0 & Self::ROTARY.0 != 0
    }

    /// Whether it contains an axis.
    pub fn contains(self, axis: Axis) -> bool {
        self.0 & (1 << axis as u16) != 0
    }

    /// The set with one more axis.
    #[must_use]
    pub fn with(self, axis: Axis) -> Self {
        Self(self.0 | (1 << axis as u16))
    }
}

/// The direction in which a rotary axis turns to its target.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum RotaryDirection {
    /// From the present angle to the programmed one, including full turns.
    #[default]
    AsWritten,
    /// The shortest rotation to the programmed angle, without full turns: DC.
    Shortest,
    /// In the positive direction, without full turns: ACP.
    Positive,
    /// In the negative direction, without full turns: ACN.
    Negative,
}

/// The coordinates in which a target is stated.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Coordinates {
    /// The program frame.
    #[default]
    Program,
    /// Axis positions from machine zero, without frame, tool length or transformation; only the
    /// named axes move: G53 and SUPA of SINUMERIK, M91 of HEIDENHAIN.
    Machine,
}

/// The program frame in the basic frame: `basic = linear · program + shift`.
///
/// The basic frame is that of the machine coordinates while all rotary axes are at zero. Rotary axes
/// and U, V, W are only shifted.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frame {
    /// Rotation, scale and mirroring of X, Y and Z: the matrix row by row. Unit: 1.
    pub linear: [[f64; 3]; 3],
    /// The origin of the program frame, mm and degrees.
    pub shift: Position,
}

impl Frame {
    /// The frame in which program and basic coordinates are equal.
    pub const IDENTITY: Self = Self {
        linear: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        shift: Position([0.0; 9]),
    };

    /// A frame with a shift only, mm and degrees.
    pub fn shifted(shift: Position) -> Self {
        Self { shift, ..Self::IDENTITY }
    }

    /// Converts a vector from the program frame to the basic frame.
    pub fn vector(&self, v: [f64; 3]) -> [f64; 3] {
        self.linear.map(|row| row[0] * v[0] + row[1] * v[1] + row[2] * v[2])
    }

    /// Converts a position from the program frame to the basic frame.
    pub fn place(&self, p: &Position) -> Position {
        let mut out = p.plus(&self.shift);
        let turned = self.vector([p.0[0], p.0[1], p.0[2]]);
        for (i, value) in turned.into_iter().enumerate() {
            out.0[i] = value + self.shift.0[i];
        }
        out
    }

    /// The product of two frames: `inner` is applied first, then `self`.
    #[must_use]
    pub fn after(&self, inner: &Self) -> Self {
        let mut linear = [[0.0; 3]; 3];
        for (row, own) in linear.iter_mut().zip(&self.linear) {
            for (j, entry) in row.iter_mut().enumerate() {
                *entry = (0..3).map(|k| own[k] * inner.linear[k][j]).sum();
            }
        }
        Self { linear, shift: self.place(&inner.shift) }
    }

    /// Converts a position from the basic frame to the program frame; `None` if the matrix has no
    /// inverse.
    pub fn inverse_place(&self, p: &Position) -> Option<Position> {
        let m = &self.linear;
        if *m == Self::IDENTITY.linear {
            let mut out = p.minus(&self.shift);
            // −0 is 0.
            out.0[..3].iter_mut().for_each(|x| *x += 0.0);
            return Some(out);
        }
        let minor = |a: usize, b: usize| {
            let (r, s) = ((a + 1) % 3, (a + 2) % 3);
            let (c, d) = ((b + 1) % 3, (b + 2) % 3);
            m[r][c] * m[s][d] - m[r][d] * m[s][c]
        };
        let det: f64 = (0..3).map(|j| m[0][j] * minor(0, j)).sum();
        if det.is_nan() || det.abs() <= 1e-12 {
            return None;
        }
        let mut out = p.minus(&self.shift);
        let d = [out.0[0], out.0[1], out.0[2]];
        for j in 0..3 {
            out.0[j] = (0..3).map(|i| minor(i, j) * d[i]).sum::<f64>() / det;
        }
        Some(out)
    }
}

/// The motion of the tool axis from one direction to the next while the tip moves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum OrientationPath {
    /// The rotary axes are interpolated linearly: ORIAXES, ORIMKS, and all controls without vectors.
    Axes,
    /// In the plane of the two directions: ORIVECT, ORIPLANE, TCPM with PATHCTRL VECTOR.
    GreatCircle,
    /// On a cone, for the next move only: ORICONCW, ORICONCCW, ORICONIO, ORICONTO.
    Cone(Cone),
}

/// The cone on which the tool axis moves; values that are not given follow from the end directions.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Cone {
    /// Its axis in the program frame, of any length: A6 B6 C6. Unit: 1.
    pub axis: Option<[f64; 3]>,
    /// An intermediate direction in the program frame, of any length: A7 B7 C7 of ORICONIO. Unit: 1.
    pub through: Option<[f64; 3]>,
    /// The angle between its axis and its generatrices, half of the opening angle, degrees: NUT.
    pub half_opening_deg: Option<f64>,
    /// The angle of rotation about its axis, degrees: PSI.
    pub angle_deg: Option<f64>,
    /// Whether the rotation is right-handed about the axis (ORICONCW); `None`: the shorter rotation,
    /// or the one through `through`.
    pub ccw: Option<bool>,
    /// Whether the cone continues the previous one tangentially: ORICONTO.
    pub tangential: bool,
}

/// The choice between the solutions of the rotary axes for the same tool axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Branch {
    /// The solution with the least rotary travel.
    #[default]
    Nearest,
    /// The solution with the first rotary axis of the head, or the last of the table, at a positive
    /// angle: SEQ+.
    Positive,
    /// The same with a negative angle: SEQ-.
    Negative,
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
    /// The first and second axis of the plane and the axis perpendicular to it, right-handed.
    pub fn axes(self) -> [Axis; 3] {
        match self {
            Self::Xy => [Axis::X, Axis::Y, Axis::Z],
            Self::Zx => [Axis::Z, Axis::X, Axis::Y],
            Self::Yz => [Axis::Y, Axis::Z, Axis::X],
        }
    }
}

/// The meaning of F.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FeedMode {
    /// G94: mm/min (degrees/min if only rotary axes move).
    PerMinute,
    /// G93: the move takes 1/F minutes.
    InverseTime,
    /// G95: mm per revolution of the spindle.
    PerRevolution,
}

/// A feed with its unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Feed {
    /// The unit of the value.
    pub mode: FeedMode,
    /// The value in mm/min (degrees/min if only rotary axes move), 1/min or mm/revolution; 0 if none
    /// The value; 0 if none is programmed. Unit: mm/min or deg/min, 1/min or mm/rev, by the mode.
    pub value: f64,
}

/// A circle or helix in the program frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Arc {
    /// The plane of the circle.
    pub plane: Plane,
    /// The centre along the first and the second axis of the plane, mm.
    pub center_mm: [f64; 2],
    /// Number of turns begun: 1 up to and including a full circle.
    pub turns: u32,
    /// Whether it is counter-clockwise, seen against the axis perpendicular to the plane.
    pub ccw: bool,
}

/// A circle or helix in any plane of the program frame: CIP, CT, polar circles.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpatialArc {
    /// The centre in the program frame, mm.
    pub center_mm: [f64; 3],
    /// The unit vector of the axis in the program frame; the tool moves counter-clockwise about it. Unit: 1.
    pub normal: [f64; 3],
    /// Number of turns begun: 1 up to and including a full circle.
    pub turns: u32,
}

/// The kind of motion to a target.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum MoveKind {
    /// Rapid traverse.
    Rapid,
    /// A straight line with feed.
    Linear,
    /// A circle or helix.
    Arc(Arc),
    /// A circle or helix in any plane.
    SpatialArc(SpatialArc),
    /// The rotary axes turn in rapid traverse until the tool axis is along Z of the program frame:
    /// G53.1, CYCLE800, PLANE MOVE and TURN. The target has no meaning.
    Align {
        /// Whether the tip keeps its position on the workpiece; otherwise the linear axes do not move.
        keep_tip: bool,
        /// The choice of the solution.
        branch: Branch,
    },
    /// A straight line synchronised with the spindle.
    Thread {
        /// Pitch, mm per revolution.
        pitch_mm: f64,
    },
    /// To the target and back, synchronised with the spindle.
    RigidTap {
        /// Pitch, mm per revolution.
        pitch_mm: f64,
    },
    /// A straight line until the probe triggers; it never triggers here.
    Probe,
    /// A dwell without motion.
    Dwell {
        /// Duration, s.
        seconds: f64,
    },
}

/// The place in the programs at which a move was written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Origin {
    /// The program: 0 for the main program, then subprograms in the order of their first call.
    pub program: u32,
    /// The line, from 1.
    pub line: u32,
}

/// One move of the tool.
///
/// The target is in the program frame: the programmed values after units and increments, before work
/// offset, shift, rotation and tool length, which [`Event`]s report.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Move {
    /// The kind of motion.
    pub kind: MoveKind,
    /// The target, mm and degrees, in the coordinates stated by `coordinates`.
    pub target: Position,
    /// The axes programmed in the block; the others keep their position, rotary axes also their angle
    /// unless a direction is given.
    pub named: AxisSet,
    /// The directions of rotation of A, B and C to their targets.
    pub rotary_directions: [RotaryDirection; 3],
    /// The coordinates of the target.
    pub coordinates: Coordinates,
    /// The tool axis in the program frame if it is programmed as a vector; of any length, as written. Unit: 1.
    pub direction: Option<[f64; 3]>,
    /// The feed; without meaning for [`MoveKind::Rapid`].
    pub feed: Feed,
    /// The block of the move.
    pub origin: Origin,
}

impl Move {
    /// A move in program coordinates without a tool direction.
    pub fn plain(
        kind: MoveKind,
        target: Position,
        named: AxisSet,
        feed: Feed,
        origin: Origin,
    ) -> Self {
        let (rotary_directions, coordinates) =
            ([RotaryDirection::AsWritten; 3], Coordinates::Program);
        Self { kind, target, named, rotary_directions, coordinates, direction: None, feed, origin }
    }
}

/// The direction of rotation of the spindle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SpindleDirection {
    /// The spindle is stopped.
    Stopped,
    /// Clockwise, seen from the spindle towards the workpiece (M3).
    Clockwise,
    /// Counter-clockwise (M4).
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

/// The side of the path on which the cutter is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CompensationSide {
    /// On the path.
    Off,
    /// Left of the path (G41).
    Left,
    /// Right of the path (G42).
    Right,
}

/// How corners are passed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PathControl {
    /// Along the programmed path, without a stop.
    ExactPath,
    /// With a stop at each corner.
    ExactStop,
    /// Rounded within a tolerance.
    Continuous,
}

/// An event between the moves.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Event {
    /// A tool is selected, by number.
    ToolSelect(u32),
    /// The tool of this number is changed into the spindle.
    ToolChange(u32),
    /// The spindle starts or stops.
    Spindle(SpindleDirection),
    /// The spindle speed, 1/min, or m/min with constant surface speed.
    SpindleSpeed(f64),
    /// The spindle is oriented to an angle.
    SpindleOrient {
        /// The angle, degrees.
        angle_deg: f64,
    },
    /// Coolant.
    Coolant(Coolant),
    /// A work offset becomes active or changes: machine = offset + rotation(program + shift) + tool.
    WorkOffset {
        /// Its number, from 1 for G54.
        index: u32,
        /// The offset, mm and degrees.
        offset: Position,
        /// The rotation about Z, degrees.
        rotation_deg: f64,
    },
    /// The shift of the axes (G92, G52), mm and degrees.
    Shift(Position),
    /// The tool length along each axis, mm.
    ToolLength(Position),
    /// The product of offsets, shifts, rotations and scales has changed; the following moves are
    /// read with this frame. Without [`Event::ToolCentre`] and [`Event::TiltedPlane`] the axes move
    /// to frame(target) + tool length; with one of them the tip, in the workpiece frame, moves to
    /// frame(target) for any position of the rotary axes.
    Frame(Frame),
    /// Tool-centre-point control is switched on (targets are those of the tip) or off (of the axes).
    ToolCentre(bool),
    /// A tilted working plane is switched on or off: CYCLE800, G68.2, PLANE.
    TiltedPlane(bool),
    /// The work offset goes round with the rotary axes of the table (G254 of HAAS): its origin in the basic frame,
    /// mm; `None` where it stays as it is. The axes keep their directions.
    DynamicOffset(Option<[f64; 3]>),
    /// The motion of the tool axis between directions, from here on.
    Orientation(OrientationPath),
    /// The next tool by its name, for controls with tool names; the following event of selection or
    /// change states its number.
    ToolName(String),
    /// The plane of arcs and cycles.
    Plane(Plane),
    /// Radius compensation is programmed.
    Compensation {
        /// The side of the contour on which the tool is.
        side: CompensationSide,
        /// The radius that the control adds, mm; a negative one changes the side.
        radius_mm: f64,
    },
    /// The mode in which corners are passed.
    Path {
        /// The mode.
        control: PathControl,
        /// Tolerance at corners, mm; 0 if none is programmed.
        tolerance_mm: f64,
    },
    /// The blank in the program frame, mm: two corners of a box along the axes.
    Stock {
        /// The corner with the smallest coordinates.
        min_mm: [f64; 3],
        /// The corner with the largest coordinates.
        max_mm: [f64; 3],
    },
    /// A message to the operator.
    Message(String),
    /// A line for the log.
    Log(String),
    /// A stop, optional or not.
    Stop {
        /// Whether it is an optional stop (M1).
        optional: bool,
    },
    /// A block is executed; reported before its moves, and only with
    /// `report_blocks` of the settings.
    Block {
        /// The range of its bytes in its program, line end included.
        text: Range<usize>,
    },
    /// A part of the last reported block that the program computes, or that only controls the
    /// execution; reported with the blocks.
    Computed {
        /// The range of its bytes, possibly with blanks after it.
        text: Range<usize>,
        /// Its value; `None` for assignments, labels, jumps and calls.
        value: Option<f64>,
    },
    /// The end of the program.
    End,
    /// A function without effect on the path, by name.
    Note(&'static str),
}

/// A move or an event, in the order of execution.
#[derive(Debug, Clone, PartialEq)]
pub enum Step {
    /// The tool moves.
    Move(Move),
    /// An event, with the block that causes it.
    Event(Event, Origin),
}

impl fmt::Display for Axis {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", char::from(self.letter()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_position_turns_about_z_counter_clockwise() {
        // (2, 1) by 30°: 2 cos − 1 sin and 2 sin + 1 cos; the other axes stay.
        let turned = Position([2.0, 1.0, 5.0, 0.0, 0.0, 0.0, 7.0, 0.0, 0.0]).turned(30.0);
        let half_root = 0.75_f64.sqrt();
        assert!((turned.0[0] - (2.0 * half_root - 0.5)).abs() < 1e-12, "{turned:?}");
        assert!((turned.0[1] - (1.0 + half_root)).abs() < 1e-12, "{turned:?}");
        assert_eq!((turned.0[2], turned.0[6]), (5.0, 7.0));
        // A right angle leads X to Y.
        let up = Position([3.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]).turned(90.0);
        assert!(up.0[0].abs() < 1e-12 && (up.0[1] - 3.0).abs() < 1e-12, "{up:?}");
    }
}
