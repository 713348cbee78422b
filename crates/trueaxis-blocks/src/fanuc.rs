//! FANUC: the table of its codes.

use crate::code::{Action as A, Cycle, Motion};
use crate::common_codes::{RS274_G_CODES, RS274_M_CODES, joined};
use crate::dialect::{Control, Dialect};
use trueaxis_moves::PathControl;

/// FANUC, G-code system of machining centres, custom macro B.
pub(crate) static DIALECT: Dialect = Dialect {
    control: Control::Fanuc,
    paren_comments: true,
    angle_names: true,
    macro_words: true,
    fix_towards_zero: true,
    parameters: 99_999,
    g_codes: &ALL_G_CODES,
    m_codes: &ALL_M_CODES,
    ..Dialect::BARE
};

/// With the codes that LinuxCNC knows, too.
pub(crate) const ALL_G_CODES: [(u16, A); 109] = joined::<47, 62, 109>(RS274_G_CODES, G_CODES);
pub(crate) const ALL_M_CODES: [(u16, A); 22] = joined::<14, 8, 22>(RS274_M_CODES, M_CODES);

const G_CODES: [(u16, A); 62] = [
    (22, A::NotApplied("G2.2 involute")),
    (23, A::NotApplied("G2.3 exponential curve")),
    (24, A::NotApplied("G2.4 circle in space")),
    (32, A::NotApplied("G3.2 involute")),
    (33, A::NotApplied("G3.3 exponential curve")),
    (34, A::NotApplied("G3.4 circle in space")),
    (50, A::Note("G5 high-speed cycle cutting")),
    (51, A::Note("G5.1 contour control")),
    (54, A::Note("G5.4 smooth path of the axes")),
    (62, A::NotApplied("G6.2 NURBS")),
    (71, A::NotApplied("G7.1 cylindrical interpolation")),
    (80, A::Note("G8 look-ahead control")),
    (90, A::Note("G9 exact stop in this block")),
    (110, A::DataInputEnd),
    (150, A::Polar(false)),
    (160, A::Polar(true)),
    (121, A::NotAppliedAlone("G12.1 polar interpolation")),
    (131, A::Note("G13.1 polar interpolation off")),
    (220, A::NoteWhole("G22 stored stroke limits")),
    (230, A::Note("G23 stored stroke limits off")),
    (250, A::Note("G25 spindle watch off")),
    (260, A::Note("G26 spindle watch")),
    (270, A::ReferenceCheck),
    (290, A::ReferenceReturn),
    (310, A::Motion(Motion::Probe)),
    (434, A::ToolCentre(false)),
    (435, A::ToolCentre(true)),
    (440, A::ToolLengthNegative),
    (450, A::NotAppliedAlone("G45 longer by a tool offset")),
    (460, A::NotAppliedAlone("G46 shorter by a tool offset")),
    (470, A::NotAppliedAlone("G47 longer by two tool offsets")),
    (480, A::NotAppliedAlone("G48 shorter by two tool offsets")),
    (500, A::ScaleOff),
    (501, A::Mirror(false)),
    (510, A::Scale),
    (511, A::Mirror(true)),
    (531, A::Align { keep_tip: false }),
    (536, A::Align { keep_tip: true }),
    (541, A::WorkOffsetFurther),
    (542, A::NotApplied("G54.2 offset of a rotary table")),
    (544, A::NotApplied("G54.4 error of the workpiece setting")),
    (600, A::Approach),
    (610, A::Path(PathControl::ExactStop)),
    (620, A::Note("G62 corner override")),
    (630, A::Note("G63 tapping mode")),
    (650, A::MacroCall),
    (660, A::ModalMacro { each_block: false }),
    (661, A::ModalMacro { each_block: true }),
    (670, A::ModalMacroOff),
    (680, A::Rotation),
    (682, A::TiltedPlane { further: false }),
    (683, A::NotApplied("G68.3 plane by the tool axis")),
    (684, A::TiltedPlane { further: true }),
    (690, A::RotationOff),
    (760, A::Motion(Motion::Cycle(Cycle::FineBore))),
    (800, A::CancelCycle),
    (870, A::Motion(Motion::Cycle(Cycle::BackBore))),
    (880, A::Motion(Motion::Cycle(Cycle::BoreManual))),
    (921, A::Preset),
    (1070, A::NotApplied("G107 cylindrical interpolation")),
    (1120, A::NotAppliedAlone("G112 polar interpolation")),
    (1130, A::Note("G113 polar interpolation off")),
];

const M_CODES: [(u16, A); 8] = [
    (10, A::Note("M10 clamp")),
    (11, A::Note("M11 unclamp")),
    (29, A::Note("M29 rigid tapping")),
    (96, A::Note("M96 interruption type macro")),
    (97, A::Note("M97 interruption type macro off")),
    (98, A::Call),
    (99, A::Return),
    (198, A::Call),
];
