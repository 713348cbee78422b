//! What is wanted of a compensated program, and how much of it each step may leave.

use super::correct::CorrectionLimit;
use super::number::Increments;

/// What is wanted of the compensated program.
#[derive(Debug, Clone, PartialEq)]
pub struct ProgramOptions {
    /// The program is unrolled first: loops, subprograms, repeated parts and computed numbers.
    pub flat: bool,
    /// The tip alone, with the linear axes.
    pub position_only: bool,
    /// How far the tip may be missed between the ends of blocks, mm.
    pub residual_mm: f64,
    /// How far the tool axis may be missed there, rad.
    pub residual_rad: f64,
    /// Whether that was asked for by name: then it also holds where the machine cannot turn the tool.
    pub residual_axis_asked: bool,
    /// Numbers are rounded to them; `None`: full double precision.
    pub increments: Option<Increments>,
    /// Larger corrections are refused.
    pub limit: CorrectionLimit,
    /// Every pose by [`trueaxis_machine::compensate::Compensator::at`] instead of whole stretches by
    /// the batch compensator: the reference, some ten times slower.
    pub pose_by_pose: bool,
    /// What stands in the heading: machine, its file, version.
    pub mark: String,
}

impl Default for ProgramOptions {
    fn default() -> Self {
        Self {
            flat: false,
            position_only: false,
            residual_mm: 1e-3,
            residual_rad: 1e-5,
            residual_axis_asked: false,
            increments: Some(Increments::default()),
            limit: CorrectionLimit::default(),
            pose_by_pose: false,
            mark: String::new(),
        }
    }
}

/// Circles may leave this share of the residual: rounding adds to it.
const SHARE: f64 = 0.5;

impl ProgramOptions {
    /// What may be missed between the ends of blocks, tip in mm and tool axis in rad: the residual and what rounding adds.
    pub(super) fn limits_between(&self) -> [f64; 2] {
        let rounding = self.increments.map_or([0.0; 2], |i| [i.linear_mm, i.rotary_deg]);
        [self.residual_mm + rounding[0], self.residual_rad + 2.0 * rounding[1].to_radians()]
    }
}

pub(super) fn residual_share(options: &ProgramOptions) -> [f64; 2] {
    [SHARE * options.residual_mm, SHARE * options.residual_rad]
}

/// What straight pieces may leave: the residual less what rounding the ends adds at most, but never
/// less than half of it.
///
/// Three linear axes are rounded by half an increment each, two rotary axes too.
pub(super) fn residual_of_pieces(options: &ProgramOptions) -> [f64; 2] {
    let rounding = options.increments.map_or([0.0; 2], |i| {
        [0.5 * 3_f64.sqrt() * i.linear_mm, 0.5 * 2_f64.sqrt() * i.rotary_deg.to_radians()]
    });
    let share = residual_share(options);
    [
        (options.residual_mm - rounding[0]).max(share[0]),
        (options.residual_rad - rounding[1]).max(share[1]),
    ]
}
