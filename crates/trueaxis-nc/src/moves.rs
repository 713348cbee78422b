//! What comes out: moves and what happens between them.

use std::fmt;
use std::ops::{Index, IndexMut, Range};

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

/// Axes by name, as one bit each.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct AxisSet(pub u16);

impl AxisSet {
    /// X, Y and Z.
    pub const XYZ: Self = Self(0b111);

    /// Whether an axis is in it.
    pub fn contains(self, axis: Axis) -> bool {
        self.0 & (1 << axis as u16) != 0
    }

    /// With one more axis.
    #[must_use]
    pub fn with(self, axis: Axis) -> Self {
        Self(self.0 | (1 << axis as u16))
    }
}

/// Which way a rotary axis turns to its target.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Way {
    /// From the present angle to the written one, over as many turns as lie between.
    #[default]
    AsWritten,
    /// The shortest way to the written angle, full turns left out: DC.
    Shortest,
    /// In the positive direction, full turns left out: ACP.
    Positive,
    /// In the negative direction, full turns left out: ACN.
    Negative,
}

/// What the numbers of a target count from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Coordinates {
    /// The program frame.
    #[default]
    Program,
    /// The machine zero, without any frame, tool length or transformation; only the named axes
    /// move: G53 and SUPA of SINUMERIK, M91 of HEIDENHAIN.
    Machine,
}

/// Where the program frame stands in the basic frame: `basic = linear · program + shift`.
///
/// The basic frame is that of the machine coordinates while all rotary axes stand at zero. Rotary
/// axes and U, V, W are only shifted.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frame {
    /// Turn, scale and mirror of X, Y and Z; row by row.
    pub linear: [[f64; 3]; 3],
    /// The origin of the program frame, mm and degrees.
    pub shift: Position,
}

impl Frame {
    /// Program and basic coordinates are the same.
    pub const IDENTITY: Self = Self {
        linear: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        shift: Position([0.0; 9]),
    };

    /// A shift alone.
    pub fn shifted(shift: Position) -> Self {
        Self { shift, ..Self::IDENTITY }
    }

    /// A vector of the program frame in the basic frame.
    pub fn vector(&self, v: [f64; 3]) -> [f64; 3] {
        self.linear.map(|row| row[0] * v[0] + row[1] * v[1] + row[2] * v[2])
    }

    /// A place of the program frame in the basic frame.
    pub fn place(&self, p: &Position) -> Position {
        let mut out = p.plus(&self.shift);
        let turned = self.vector([p.0[0], p.0[1], p.0[2]]);
        for (i, value) in turned.into_iter().enumerate() {
            out.0[i] = value + self.shift.0[i];
        }
        out
    }

    /// `inner` is applied first, then `self`.
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

    /// A place of the basic frame in the program frame; `None` if the frame squeezes space flat.
    pub fn inverse_place(&self, p: &Position) -> Option<Position> {
        let m = &self.linear;
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

/// How the tool axis gets from one direction to the next while the tip moves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum OrientationPath {
    /// The rotary axes move evenly: ORIAXES, ORIMKS, and all controls without vectors.
    Axes,
    /// In the plane of both directions: ORIVECT, ORIPLANE, TCPM with PATHCTRL VECTOR.
    GreatCircle,
    /// On a cone: ORICONCW, ORICONCCW, ORICONIO, ORICONTO; it holds for the next move only.
    Cone(Cone),
}

/// A cone that the tool axis moves on; what is not given follows from the ends.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Cone {
    /// Its axis in the program frame: A6 B6 C6.
    pub axis: Option<[f64; 3]>,
    /// A direction on the way: A7 B7 C7 of ORICONIO.
    pub through: Option<[f64; 3]>,
    /// The angle between the axis and each line, half the opening: NUT.
    pub half_opening_deg: Option<f64>,
    /// The angle that is travelled about the axis: PSI.
    pub angle_deg: Option<f64>,
    /// Right-handed about the axis (ORICONCW); `None` the shorter way or by `through`.
    pub ccw: Option<bool>,
    /// The cone continues the last one without a corner: ORICONTO.
    pub tangential: bool,
}

/// Which of the poses with the same tool axis is taken.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Branch {
    /// The one with the least rotary travel.
    #[default]
    Nearest,
    /// The first rotary axis of the head, or the last of the table, at a positive angle: SEQ+.
    Positive,
    /// The same at a negative angle: SEQ-.
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

/// A circle or helix in any plane of the program frame: CIP, CT, polar circles.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpatialArc {
    /// The centre, mm.
    pub center_mm: [f64; 3],
    /// The axis; the tool turns counter-clockwise about it.
    pub normal: [f64; 3],
    /// Begun turns: 1 up to and including a full circle.
    pub turns: u32,
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
    /// A circle or helix in any plane.
    SpatialArc(SpatialArc),
    /// The rotary axes turn, as fast as they can, until the tool stands along Z of the program
    /// frame: G53.1, CYCLE800, PLANE MOVE and TURN. The target tells nothing.
    Align {
        /// The tip stays where it is on the workpiece; otherwise the linear axes stand still.
        keep_tip: bool,
        /// Which pose.
        branch: Branch,
    },
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
    /// The axes that the block names; the others keep their place, rotary axes also their angle
    /// unless a direction is given.
    pub named: AxisSet,
    /// How A, B and C turn to their targets.
    pub ways: [Way; 3],
    /// What the target counts from.
    pub coordinates: Coordinates,
    /// The direction of the tool axis in the program frame where it is programmed as a vector, as
    /// it is written, of any length.
    pub direction: Option<[f64; 3]>,
    /// How fast; of no meaning to [`MoveKind::Rapid`].
    pub feed: Feed,
    /// The block.
    pub origin: Origin,
}

impl Move {
    /// A move in program coordinates without a direction of its own.
    pub fn plain(
        kind: MoveKind,
        target: Position,
        named: AxisSet,
        feed: Feed,
        origin: Origin,
    ) -> Self {
        let (ways, coordinates) = ([Way::AsWritten; 3], Coordinates::Program);
        Self { kind, target, named, ways, coordinates, direction: None, feed, origin }
    }
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
    /// The whole of offsets, shifts, turns and scales has changed: this is what moves are read
    /// with. Without [`Event::ToolCentre`] and [`Event::TiltedPlane`] the axes go to
    /// frame(target) + tool length; with one of them the tip, in the workpiece, goes to
    /// frame(target), however the rotary axes stand.
    Frame(Frame),
    /// The tip of the tool is programmed (TCP) or the axes are.
    ToolCentre(bool),
    /// The frame is tied to a swivelled plane of the workpiece: CYCLE800, G68.2, PLANE.
    TiltedPlane(bool),
    /// How the tool axis moves between directions from here on.
    Orientation(OrientationPath),
    /// The next tool by its name, for controls that call tools so; its number is in the event of
    /// selection or change that follows.
    ToolName(String),
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
        /// Only if the operator wished so.
        optional: bool,
    },
    /// A block is executed; told only where [`crate::Settings::tell_blocks`] asks for it, before what
    /// the block does.
    Block {
        /// Its bytes in its program, line end included.
        text: Range<usize>,
    },
    /// A part of the block just told that the program computes, or that only steers the execution;
    /// told with the blocks.
    Computed {
        /// Its bytes; blanks behind it may be among them.
        text: Range<usize>,
        /// Its value; `None` for what steers: assignments, labels, jumps, calls.
        value: Option<f64>,
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
