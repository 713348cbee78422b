//! The codes that mean the same to FANUC and LinuxCNC.

use crate::code::{Action as A, Cycle, Motion};
use trueaxis_moves::{
    CompensationSide as Side, Coolant, FeedMode, PathControl, Plane, SpindleDirection,
};

/// The common codes followed by those of one control.
pub(crate) const fn joined<const N: usize, const M: usize, const ALL: usize>(
    common: [(u16, A); N],
    own: [(u16, A); M],
) -> [(u16, A); ALL] {
    let mut all = [(0, A::End); ALL];
    let mut index = 0;
    while index < ALL {
        all[index] = if index < N { common[index] } else { own[index - N] };
        index += 1;
    }
    all
}

pub(crate) const RS274_G_CODES: [(u16, A); 47] = [
    (0, A::Motion(Motion::Rapid)),
    (10, A::Motion(Motion::Linear)),
    (20, A::Motion(Motion::ArcClockwise)),
    (30, A::Motion(Motion::ArcCounterClockwise)),
    (40, A::Dwell),
    (100, A::SetTable),
    (170, A::Plane(Plane::Xy)),
    (180, A::Plane(Plane::Zx)),
    (190, A::Plane(Plane::Yz)),
    (200, A::Inches(true)),
    (210, A::Inches(false)),
    (280, A::Reference(1)),
    (300, A::Reference(2)),
    (330, A::Motion(Motion::Thread)),
    (400, A::Compensation(Side::Off)),
    (410, A::Compensation(Side::Left)),
    (420, A::Compensation(Side::Right)),
    (430, A::ToolLength),
    (490, A::ToolLengthOff),
    (520, A::LocalShift),
    (530, A::MachineCoordinates),
    (540, A::WorkOffset(1)),
    (550, A::WorkOffset(2)),
    (560, A::WorkOffset(3)),
    (570, A::WorkOffset(4)),
    (580, A::WorkOffset(5)),
    (590, A::WorkOffset(6)),
    (640, A::Path(PathControl::Continuous)),
    (730, A::Motion(Motion::Cycle(Cycle::ChipBreaking))),
    (740, A::Motion(Motion::Cycle(Cycle::TapLeft))),
    (810, A::Motion(Motion::Cycle(Cycle::Drill))),
    (820, A::Motion(Motion::Cycle(Cycle::DrillDwell))),
    (830, A::Motion(Motion::Cycle(Cycle::Peck))),
    (840, A::Motion(Motion::Cycle(Cycle::TapRight))),
    (850, A::Motion(Motion::Cycle(Cycle::Bore))),
    (860, A::Motion(Motion::Cycle(Cycle::BoreStop))),
    (890, A::Motion(Motion::Cycle(Cycle::BoreDwell))),
    (900, A::Incremental(false)),
    (910, A::Incremental(true)),
    (920, A::Shift),
    (930, A::Feed(FeedMode::InverseTime)),
    (940, A::Feed(FeedMode::PerMinute)),
    (950, A::Feed(FeedMode::PerRevolution)),
    (960, A::SurfaceSpeed(true)),
    (970, A::SurfaceSpeed(false)),
    (980, A::RetractToR(false)),
    (990, A::RetractToR(true)),
];

pub(crate) const RS274_M_CODES: [(u16, A); 14] = [
    (0, A::Stop(false)),
    (1, A::Stop(true)),
    (2, A::End),
    (3, A::Spindle(SpindleDirection::Clockwise)),
    (4, A::Spindle(SpindleDirection::CounterClockwise)),
    (5, A::Spindle(SpindleDirection::Stopped)),
    (6, A::ToolChange),
    (7, A::Coolant(Coolant::Mist)),
    (8, A::Coolant(Coolant::Flood)),
    (9, A::Coolant(Coolant::Off)),
    (19, A::Orient),
    (30, A::End),
    (48, A::Note("M48 overrides on")),
    (49, A::Note("M49 overrides off")),
];
