//! HAAS: FANUC's words and custom macros, with some codes of its own.

use crate::code::Action as A;
use crate::common_codes::joined;
use crate::dialect::{Control, Dialect};
use crate::fanuc;

/// HAAS, milling control.
///
/// # Source
/// Haas Automation, "Mill Operator's Manual" (Next Generation Control), chapters "G-Codes" and "M-Codes". What
/// it does not list is as on FANUC. The first entry of a code counts.
pub(crate) static DIALECT: Dialect = Dialect {
    control: Control::Haas,
    g_codes: &joined::<20, 109, 129>(G_CODES, fanuc::ALL_G_CODES),
    m_codes: &joined::<11, 22, 33>(M_CODES, fanuc::ALL_M_CODES),
    ..fanuc::DIALECT
};

const G_CODES: [(u16, A); 20] = [
    (120, A::CircularPocket { ccw: false }),
    (130, A::CircularPocket { ccw: true }),
    (350, A::NotApplied("G35 automatic tool diameter")),
    (360, A::NotApplied("G36 automatic work offset")),
    (370, A::NotApplied("G37 automatic tool length")),
    (470, A::NotApplied("G47 engraving")),
    (700, A::HolePattern(70)),
    (710, A::HolePattern(71)),
    (720, A::HolePattern(72)),
    (1030, A::Note("G103 limit of block look-ahead")),
    (1410, A::SpatialCompensation),
    (1500, A::NotApplied("G150 general pocket")),
    (1530, A::NotApplied("G153 high-speed peck boring")),
    (1540, A::WorkOffsetFurther),
    (1870, A::Note("G187 smoothness of the path")),
    (2340, A::ToolCentre(false)),
    (2540, A::DynamicOffset(true)),
    (2550, A::DynamicOffset(false)),
    (2680, A::TiltedPlane { further: false }),
    (2690, A::RotationOff),
];

const M_CODES: [(u16, A); 11] = [
    (31, A::Note("M31 chip conveyor")),
    (33, A::Note("M33 chip conveyor off")),
    (59, A::Note("M59 output on")),
    (69, A::Note("M69 output off")),
    (75, A::Note("M75 reference point of a probe")),
    (78, A::Note("M78 alarm if a signal is found")),
    (79, A::Note("M79 alarm if no signal is found")),
    (88, A::Note("M88 coolant through the spindle")),
    (89, A::Note("M89 coolant through the spindle off")),
    (96, A::Note("M96 jump where an input is 0")),
    (97, A::LocalCall),
];
