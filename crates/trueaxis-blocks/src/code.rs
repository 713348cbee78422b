//! What a code does, whatever its number on this or that control.

use trueaxis_moves::{CompensationSide, Coolant, FeedMode, PathControl, Plane, SpindleDirection};

/// How a motion is programmed; it lasts until another one comes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Motion {
    /// As fast as the machine can.
    Rapid,
    /// A straight line with feed.
    Linear,
    /// A circle or helix, clockwise seen against the axis of the plane.
    ArcClockwise,
    /// A circle or helix, counter-clockwise.
    ArcCounterClockwise,
    /// A straight line coupled to the spindle.
    Thread,
    /// Tapping with a coupled spindle, in and out.
    RigidTap,
    /// A straight line until the probe trips.
    Probe,
    /// A spline in the plane.
    Spline(Spline),
    /// A drilling cycle.
    Cycle(Cycle),
    /// None: axis words are not allowed.
    Cancelled,
}

/// The splines of LinuxCNC.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Spline {
    /// G5: cubic, with two inner points.
    Cubic,
    /// G5.1: quadratic, with one.
    Quadratic,
    /// G5.2: blocks of control points, until G5.3.
    Nurbs,
}

/// The drilling cycles.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Cycle {
    /// Drill with chip breaking.
    ChipBreaking,
    /// Left-hand tapping.
    TapLeft,
    /// Right-hand tapping.
    TapRight,
    /// Drill, out at once, rapid.
    Drill,
    /// Drill, dwell, out rapid.
    DrillDwell,
    /// Deep-hole drilling with full retraction.
    Peck,
    /// Bore, out with feed.
    Bore,
    /// Bore, stop the spindle, out rapid.
    BoreStop,
    /// Bore, dwell, out with feed.
    BoreDwell,
    /// Fine boring with an oriented spindle, out rapid; the lift-off is not moved.
    FineBore,
    /// Back boring: beside the hole down to R, then upwards with feed.
    BackBore,
    /// Bore, dwell, stop for the operator, out rapid.
    BoreManual,
}

/// One thing that a G or M code does.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Action {
    /// What F means from here on.
    Feed(FeedMode),
    /// Wait for P (or X) seconds.
    Dwell,
    /// The plane of arcs, cycles and compensation.
    Plane(Plane),
    /// Lengths are inches (`true`) or millimetres.
    Inches(bool),
    /// X words are diameters.
    Diameter(bool),
    /// Radius compensation with the radius of a number.
    Compensation(CompensationSide),
    /// Radius compensation with a diameter.
    CompensationDirect(CompensationSide),
    /// Compensation perpendicular to I J K; not applied.
    SpatialCompensation,
    /// Tool length of the table (H).
    ToolLength,
    /// Tool length as the axis words say.
    ToolLengthDirect,
    /// Tool length of the table, downwards: G44.
    ToolLengthNegative,
    /// Tool length of the table in addition.
    ToolLengthAdd,
    /// No tool length.
    ToolLengthOff,
    /// The tip of the tool is programmed; `true` with direction vectors I J K.
    ToolCentre(bool),
    /// Switchable kinematics: the tip of the tool is programmed, or the axes.
    Kinematics(bool),
    /// A work offset by number, from 1.
    WorkOffset(u8),
    /// A further work offset, by P.
    WorkOffsetFurther,
    /// How corners are passed.
    Path(PathControl),
    /// Axis words are increments.
    Incremental(bool),
    /// I J K are absolute.
    ArcAbsolute(bool),
    /// Cycles retract to R (`true`) or to where they began.
    RetractToR(bool),
    /// Axis words are machine coordinates, in this block.
    MachineCoordinates,
    /// By way of the point given to reference point 1 or 2.
    Reference(u8),
    /// Makes the present place reference point 1 or 2.
    SetReference(u8),
    /// Sets a table by L and P.
    SetTable,
    /// Shifts the axes so that the present place has the given coordinates.
    Shift,
    /// Shifts the axes by the given amounts.
    LocalShift,
    /// Forgets the shift.
    ShiftCancel,
    /// Suspends the shift.
    ShiftSuspend,
    /// Takes the shift back.
    ShiftResume,
    /// Ends drilling cycles; the motion before them is back.
    CancelCycle,
    /// How the axis words are meant.
    Motion(Motion),
    /// Calls a macro with letters as arguments.
    MacroCall,
    /// The spindle.
    Spindle(SpindleDirection),
    /// Orients the spindle.
    Orient,
    /// S is a surface speed (`true`) or revolutions.
    SurfaceSpeed(bool),
    /// Puts the selected tool into the spindle.
    ToolChange,
    /// Coolant.
    Coolant(Coolant),
    /// Stops until the operator goes on; `true` only if he wished so.
    Stop(bool),
    /// The end of the program.
    End,
    /// Calls a subprogram by its number.
    Call,
    /// M97 of HAAS: a part of the program from a block number to M99.
    LocalCall,
    /// The end of a subprogram.
    Return,
    /// G5.3 of LinuxCNC: the control points are complete.
    NurbsEnd,
    /// G76 of LinuxCNC: a thread in several passes.
    Threading,
    /// G70 to G72.2 of LinuxCNC, ten times the number: a profile turned on a lathe.
    Turning(u16),
    /// G70, G71 and G72 of HAAS: the cycle that is on at holes on a circle, an arc or a line.
    HolePattern(u8),
    /// G12 and G13 of HAAS: a circular pocket, counter-clockwise or not.
    CircularPocket {
        /// G13.
        ccw: bool,
    },
    /// Polar coordinates in the plane.
    Polar(bool),
    /// Scale, also negative.
    Scale,
    /// No scale.
    ScaleOff,
    /// Mirror at planes, or no longer.
    Mirror(bool),
    /// Rotation in the plane or about an axis in space.
    Rotation,
    /// A tilted plane; `further` builds on the one before.
    TiltedPlane {
        /// In the plane that is there.
        further: bool,
    },
    /// No rotation, no tilted plane.
    RotationOff,
    /// The work offset goes round with the table, or no longer.
    DynamicOffset(bool),
    /// Turns the tool along Z of the tilted plane.
    Align {
        /// The tip stays at its place.
        keep_tip: bool,
    },
    /// A rapid that comes from one side: the place alone counts.
    Approach,
    /// Goes to a place and looks whether it is a reference point.
    ReferenceCheck,
    /// From the reference point by way of the place before.
    ReferenceReturn,
    /// The shift of the named axes is gone.
    Preset,
    /// The end of data input.
    DataInputEnd,
    /// Calls a macro after each move (or instead of each block) from here on.
    ModalMacro {
        /// Instead of each block, with its words as arguments.
        each_block: bool,
    },
    /// Ends that.
    ModalMacroOff,
    /// Known to the control, of no effect on the path: passed on by name.
    Note(&'static str),
    /// The same, and the words of its block are its own.
    NoteWhole(&'static str),
    /// Known to the control, not interpreted: a warning says so. The words of its block are its own.
    NotApplied(&'static str),
    /// The same, but the words of its block belong to the other codes.
    NotAppliedAlone(&'static str),
    /// M70 to M73 of LinuxCNC.
    ModalState(Saving),
}

/// What M70 to M73 of LinuxCNC do with the modal state.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Saving {
    /// M70: it is saved.
    Save,
    /// M71: what was saved is forgotten.
    Forget,
    /// M72: it comes back.
    Restore,
    /// M73: it is saved, and the return from the subprogram restores it.
    SaveUntilReturn,
}

impl Action {
    /// The place in the order of execution within a block (RS274/NGC, order of execution).
    pub fn rank(self) -> u8 {
        match self {
            Self::Feed(_) => 2,
            Self::SurfaceSpeed(_) => 3,
            Self::ToolChange => 7,
            Self::ModalState(_) => 8,
            Self::Spindle(_) | Self::Orient => 8,
            Self::Coolant(_) => 9,
            Self::Note(_)
            | Self::NoteWhole(_)
            | Self::NotApplied(_)
            | Self::NotAppliedAlone(_)
            | Self::Kinematics(_)
            | Self::ModalMacroOff
            | Self::DataInputEnd => 10,
            Self::Dwell => 11,
            Self::Plane(_) => 12,
            Self::Inches(_) | Self::Diameter(_) => 13,
            Self::Compensation(_) | Self::CompensationDirect(_) | Self::SpatialCompensation => 14,
            Self::ToolLength
            | Self::ToolLengthDirect
            | Self::ToolLengthNegative
            | Self::ToolLengthAdd
            | Self::ToolLengthOff
            | Self::ToolCentre(_) => 15,
            Self::WorkOffset(_) | Self::WorkOffsetFurther => 16,
            Self::Path(_) => 17,
            Self::Incremental(_) | Self::ArcAbsolute(_) | Self::CancelCycle => 18,
            Self::RetractToR(_) | Self::Polar(_) => 19,
            Self::Reference(_)
            | Self::SetReference(_)
            | Self::SetTable
            | Self::Shift
            | Self::LocalShift
            | Self::ShiftCancel
            | Self::ShiftSuspend
            | Self::ShiftResume
            | Self::ReferenceCheck
            | Self::ReferenceReturn
            | Self::Preset
            | Self::NurbsEnd
            | Self::ScaleOff
            | Self::Scale
            | Self::Mirror(_)
            | Self::RotationOff
            | Self::Rotation
            | Self::TiltedPlane { .. }
            | Self::DynamicOffset(_)
            | Self::Align { .. } => 20,
            Self::MachineCoordinates => 21,
            Self::Motion(_)
            | Self::Approach
            | Self::Threading
            | Self::Turning(_)
            | Self::CircularPocket { .. }
            | Self::HolePattern(_) => 22,
            Self::MacroCall | Self::ModalMacro { .. } | Self::Call | Self::LocalCall => 23,
            Self::Stop(_) | Self::End | Self::Return => 24,
        }
    }

    /// Whether the action itself uses the axis words of its block, so that no motion follows.
    pub fn takes_axis_words(self) -> bool {
        matches!(
            self,
            Self::Reference(_)
                | Self::SetTable
                | Self::Shift
                | Self::LocalShift
                | Self::ToolLengthDirect
                | Self::MacroCall
                | Self::ModalMacro { .. }
                | Self::ReferenceCheck
                | Self::ReferenceReturn
                | Self::Preset
                | Self::Threading
                | Self::Turning(_)
                | Self::HolePattern(_)
                | Self::CircularPocket { .. }
                | Self::Scale
                | Self::Mirror(_)
                | Self::Rotation
                | Self::TiltedPlane { .. }
                | Self::NoteWhole(_)
                | Self::NotApplied(_)
        )
    }
}
