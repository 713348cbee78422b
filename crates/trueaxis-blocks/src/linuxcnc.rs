//! LinuxCNC: the table of its codes.

use crate::code::{Action as A, Motion, Saving, Spline};
use crate::common_codes::{RS274_G_CODES, RS274_M_CODES, joined};
use crate::dialect::{Control, Dialect};
use trueaxis_moves::{CompensationSide as Side, PathControl};

/// LinuxCNC, RS274/NGC.
///
/// # Source
/// LinuxCNC 2.9 user manual, chapters "G-Codes", "M-Codes", "O Codes".
pub(crate) static DIALECT: Dialect = Dialect {
    control: Control::LinuxCnc,
    paren_comments: true,
    angle_names: true,
    o_words: true,
    sign_words: true,
    parameters: 5602,
    g_codes: &joined::<47, 39, 86>(RS274_G_CODES, G_CODES),
    m_codes: &joined::<14, 24, 38>(RS274_M_CODES, M_CODES),
    ..Dialect::BARE
};

const G_CODES: [(u16, A); 39] = [
    (50, A::Motion(Motion::Spline(Spline::Cubic))),
    (51, A::Motion(Motion::Spline(Spline::Quadratic))),
    (52, A::Motion(Motion::Spline(Spline::Nurbs))),
    (53, A::NurbsEnd),
    (70, A::Diameter(true)),
    (80, A::Diameter(false)),
    (171, A::NotAppliedAlone("G17.1 UV plane")),
    (181, A::NotAppliedAlone("G18.1 WU plane")),
    (191, A::NotAppliedAlone("G19.1 VW plane")),
    (281, A::SetReference(1)),
    (301, A::SetReference(2)),
    (331, A::Motion(Motion::RigidTap)),
    (382, A::Motion(Motion::Probe)),
    (383, A::Motion(Motion::Probe)),
    (384, A::Motion(Motion::Probe)),
    (385, A::Motion(Motion::Probe)),
    (411, A::CompensationDirect(Side::Left)),
    (421, A::CompensationDirect(Side::Right)),
    (431, A::ToolLengthDirect),
    (432, A::ToolLengthAdd),
    (591, A::WorkOffset(7)),
    (592, A::WorkOffset(8)),
    (593, A::WorkOffset(9)),
    (610, A::Path(PathControl::ExactPath)),
    (611, A::Path(PathControl::ExactStop)),
    (700, A::Turning(700)),
    (710, A::Turning(710)),
    (711, A::Turning(711)),
    (712, A::Turning(712)),
    (720, A::Turning(720)),
    (721, A::Turning(721)),
    (722, A::Turning(722)),
    (760, A::Threading),
    (800, A::Motion(Motion::Cancelled)),
    (901, A::ArcAbsolute(true)),
    (911, A::ArcAbsolute(false)),
    (921, A::ShiftCancel),
    (922, A::ShiftSuspend),
    (923, A::ShiftResume),
];

const M_CODES: [(u16, A); 24] = [
    (50, A::Note("M50 feed override")),
    (51, A::Note("M51 spindle override")),
    (52, A::Note("M52 adaptive feed")),
    (53, A::Note("M53 feed stop")),
    (60, A::Stop(false)),
    (61, A::Note("M61 set current tool")),
    (62, A::Note("M62 output on")),
    (63, A::Note("M63 output off")),
    (64, A::Note("M64 output on")),
    (65, A::Note("M65 output off")),
    (66, A::Note("M66 wait on input")),
    (67, A::Note("M67 analog output")),
    (68, A::Note("M68 analog output")),
    (70, A::ModalState(Saving::Save)),
    (71, A::ModalState(Saving::Forget)),
    (72, A::ModalState(Saving::Restore)),
    (73, A::ModalState(Saving::SaveUntilReturn)),
    (98, A::Call),
    (99, A::Return),
    (128, A::Kinematics(true)),
    (129, A::Kinematics(false)),
    (428, A::Kinematics(true)),
    (429, A::Kinematics(false)),
    (430, A::NotAppliedAlone("M430 the user's own kinematics")),
];
