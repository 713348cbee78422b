//! Before and after: how far the tip strays with the old centres, and how far it will with the new.
//!
//! ```text
//!     d(q) = Σ (x_j − d_j)(v_j(q) − v_j(0))       d: what the control is set for    docs/model.md eq. 134
//! ```

use super::calibration::Calibration;
use super::centres::rotary_range;
use super::study::RtcpStudy;
use nalgebra::{DMatrix, DVector};
use trueaxis_geometry::Vec3;
use trueaxis_machine::axis::{AxisKind, Command};

/// Poses of each rotary axis.
const STEPS: usize = 13;

/// The tip over all poses of the rotary axes, the work offset touched with both at 0.
#[derive(Debug, Clone, PartialEq)]
pub struct Forecast {
    /// How many poses.
    pub poses: usize,
    /// With the old centres: worst, its pose, RMS, mm.
    pub before: Strays,
    /// With the new ones as they are entered, rounded to the decimals of the control.
    pub after: Strays,
    /// What the uncertainty of the new ones makes of it: the standard uncertainty in the worst
    /// direction at the worst pose, mm.
    pub u_after_mm: f64,
    /// The RMS that is to be expected with them: rounding and uncertainty, mm.
    pub expected_rms_mm: f64,
}

/// How far the tip strays.
#[derive(Debug, Clone, PartialEq)]
pub struct Strays {
    /// The longest deviation, mm.
    pub worst_mm: f64,
    /// Where, the rotary axes by name, rad.
    pub at: Vec<(String, f64)>,
    /// The root of the mean square of all, mm.
    pub rms_mm: f64,
}

/// The effect of the new centres; `None` where some of them were not found.
pub fn forecast(study: &RtcpStudy, found: &Calibration) -> Option<Forecast> {
    if !found.is_complete() {
        return None;
    }
    let poses = poses(study);
    let slopes: Vec<DMatrix<f64>> = poses.iter().map(|q| against_zero(study, q)).collect();
    let true_minus =
        |set_for: &DVector<f64>| DVector::from_column_slice(&found.values_mm) - set_for;
    let before = true_minus(&DVector::from_column_slice(&study.set_for_mm));
    let entered = true_minus(&entered(study, found));
    let u = slopes.iter().map(|j| j * &found.covariance * j.transpose());
    let (mut worst, mut trace) = (0.0_f64, 0.0);
    for covariance in u {
        trace += covariance.trace();
        worst = worst.max(covariance.symmetric_eigenvalues().max());
    }
    let after = strays(study, &poses, &slopes, &entered);
    let mean_square = after.rms_mm.powi(2) + trace / poses.len() as f64;
    Some(Forecast {
        poses: poses.len(),
        before: strays(study, &poses, &slopes, &before),
        after,
        u_after_mm: worst.max(0.0).sqrt(),
        expected_rms_mm: mean_square.sqrt(),
    })
}

/// The offsets that the control is set for with the new numbers, rounded as it takes them.
fn entered(study: &RtcpStudy, found: &Calibration) -> DVector<f64> {
    let mut offsets = found.values_mm.clone();
    if let Some(slots) = &study.slots {
        let scale = 10f64.powi(i32::from(study.decimals));
        // What rounding adds to each number, as offsets; numbers of the machine file stay.
        let rounding: Vec<(usize, f64)> = found
            .new
            .iter()
            .enumerate()
            .filter_map(|(k, new)| {
                let (mm, _) = new.new_mm?;
                Some((k, slots.slots[k].nominal_mm + (mm * scale).round() / scale - mm))
            })
            .collect();
        let off = slots.offsets_of(&rounding);
        offsets.iter_mut().zip(off).for_each(|(x, d)| *x += d);
        // What the control has no number for stays as it is.
        for k in &slots.without_slot {
            offsets[*k] = study.set_for_mm[*k];
        }
    }
    DVector::from_vec(offsets)
}

fn poses(study: &RtcpStudy) -> Vec<Command> {
    let mut poses = vec![Command::default()];
    for (i, axis) in study.machine.axes().iter().enumerate() {
        if axis.kind != AxisKind::Rotary {
            continue;
        }
        let (from, to) = rotary_range(axis.travel);
        let step = (to - from) / (STEPS - 1) as f64;
        let turned = |q: &Command| {
            let q = *q;
            (0..STEPS).map(move |s| {
                let mut turned = q;
                turned[i] = from + step * s as f64;
                turned
            })
        };
        poses = poses.iter().flat_map(turned).collect();
    }
    poses
}

/// Slopes of the tip less those at rotary zero: three rows, one column for each offset.
fn against_zero(study: &RtcpStudy, command: &Command) -> DMatrix<f64> {
    let here = study.centres.slopes(&study.machine, command);
    let zero = study.centres.slopes(&study.machine, &Command::default());
    let columns: Vec<Vec3> = here.iter().zip(&zero).map(|(a, b)| a - b).collect();
    DMatrix::from_fn(3, columns.len(), |i, k| columns[k][i])
}

fn strays(
    study: &RtcpStudy,
    poses: &[Command],
    slopes: &[DMatrix<f64>],
    offsets: &DVector<f64>,
) -> Strays {
    let lengths: Vec<f64> = slopes.iter().map(|j| (j * offsets).norm()).collect();
    let square: f64 = lengths.iter().map(|l| l * l).sum();
    let longest = (0..lengths.len()).max_by(|a, b| lengths[*a].total_cmp(&lengths[*b]));
    let at = longest.map_or_else(Vec::new, |i| {
        let axes = study.machine.axes().iter().zip(&poses[i]);
        axes.filter(|(a, _)| a.kind == AxisKind::Rotary)
            .map(|(a, q)| (a.name.to_string(), *q))
            .collect()
    });
    Strays {
        worst_mm: longest.map_or(0.0, |i| lengths[i]),
        at,
        rms_mm: (square / lengths.len().max(1) as f64).sqrt(),
    }
}
