//! Causes of the deviations of a circle, by linear least squares over both directions; docs/model.md eq. 70.

use super::{PathResult, Sense};
use crate::least_squares::LeastSquares;
use std::f64::consts::{FRAC_PI_2, TAU};

/// After a reversal the axis may stick: these angles are left out of the fit and searched for a
/// spike, rad.
const SPIKE_WINDOW_RAD: f64 = 10.0 * TAU / 360.0;

/// The largest residual just after the reversal of an axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spike {
    /// 0 for the first axis, 1 for the second.
    pub axis: usize,
    /// Where the axis reverses: 0°, 90° …, rad.
    pub at_rad: f64,
    /// The sense of rotation.
    pub sense: Sense,
    /// Outward positive, mm.
    pub height_mm: f64,
}

/// The parts of the radial deviation.
#[derive(Debug, Clone, PartialEq)]
pub struct Causes {
    /// Centre of both paths from the nominal one, mm.
    pub centre_mm: [f64; 2],
    /// Reversal E↑ − E↓ of each axis, mm, as B of ISO 230-2: negative for lost motion.
    pub backlash_mm: [f64; 2],
    /// Scale of the first axis longer than that of the second, over the diameter, mm.
    pub scale_mismatch_mm: f64,
    /// Angle by which the axes are closer than 90°, rad; `None` from one direction.
    pub squareness_rad: Option<f64>,
    /// Width of the ellipse along ±45° that changes with the direction, mm, over the diameter along
    /// +45° when going counter-clockwise: the first axis lags less or more than the second. `None`
    /// from one direction.
    pub servo_mismatch_mm: Option<f64>,
    /// Squareness and servo mismatch together, as the second, where one direction cannot separate them.
    pub diagonal_ellipse_mm: Option<f64>,
    /// Largest residuals after the reversals.
    pub spikes: Vec<Spike>,
    /// Root mean square of the residuals, without the spikes, mm.
    pub residual_rms_mm: f64,
}

/// Unknowns: radius of ccw and cw, centre, scale, squareness, servo, backlash of both axes.
const UNKNOWNS: usize = 9;

pub(super) fn sign(v: f64) -> f64 {
    if v == 0.0 { 0.0 } else { v.signum() }
}

fn row(angle: f64, sense: Sense, both: bool) -> [f64; UNKNOWNS] {
    let s = sense.sign();
    let (sin, cos) = angle.sin_cos();
    let (sin2, cos2) = (2.0 * angle).sin_cos();
    // Velocities of the axes are −s sin θ and s cos θ; half the reversal to either side.
    let backlash = [0.5 * sign(-s * sin) * cos, 0.5 * sign(s * cos) * sin];
    let servo = if both { s * sin2 } else { 0.0 };
    let [ccw, cw] = if s > 0.0 { [1.0, 0.0] } else { [0.0, 1.0] };
    [ccw, cw, cos, sin, cos2, sin2, servo, backlash[0], backlash[1]]
}

/// How far beyond the last reversal an angle is in the direction of motion, and which reversal.
pub(super) fn after_reversal(angle: f64, sense: Sense) -> (f64, usize) {
    let turned = (sense.sign() * angle).rem_euclid(TAU);
    let quarter = (turned / FRAC_PI_2).floor();
    (turned - quarter * FRAC_PI_2, quarter as usize % 4)
}

/// So close to a reversal the noise decides on which side a point lies: half a step of the points.
pub(super) fn doubtful_rad(paths: &[PathResult]) -> f64 {
    let most = paths.iter().map(|p| p.path.points_mm.len()).max().unwrap_or(1);
    (0.5 * TAU / most as f64).min(0.1 * SPIKE_WINDOW_RAD)
}

pub(super) fn separate(
    paths: &[PathResult],
    centre_mm: [f64; 2],
    radius_mm: Option<f64>,
) -> Option<Causes> {
    let both = paths.iter().any(|p| p.path.sense != paths[0].path.sense);
    let radius = radius_mm.or(paths.first().map(|p| p.circle.radius_mm))?;
    let about = super::points_centre_mm(paths)?;
    let polar = |p: &[f64; 2]| {
        let (x, y) = (p[0] - about[0], p[1] - about[1]);
        (y.atan2(x), x.hypot(y) - radius)
    };
    let all = || {
        paths.iter().flat_map(|r| r.path.points_mm.iter().map(move |p| (r.path.sense, p))).map(
            |(sense, p)| {
                let (angle, radial) = polar(p);
                (sense, angle, radial)
            },
        )
    };
    let doubtful = doubtful_rad(paths);
    let sure = |after: f64| (doubtful..=FRAC_PI_2 - doubtful).contains(&after);
    let mut fit = LeastSquares::<UNKNOWNS>::default();
    for (sense, angle, radial) in all() {
        let after = after_reversal(angle, sense).0;
        if after > SPIKE_WINDOW_RAD && sure(after) {
            fit.add(&row(angle, sense, both), radial);
        }
    }
    let x = fit.solve()?;
    let (mut squares, mut count) = (0.0, 0_usize);
    let mut highest = [[0.0_f64; 4]; 2];
    for (sense, angle, radial) in all() {
        let model: f64 = row(angle, sense, both).iter().zip(&x).map(|(a, b)| a * b).sum();
        let residual = radial - model;
        let (after, quarter) = after_reversal(angle, sense);
        if !sure(after) {
            continue;
        }
        if after > SPIKE_WINDOW_RAD {
            squares += residual * residual;
            count += 1;
            continue;
        }
        let spike = &mut highest[usize::from(sense == Sense::Clockwise)][quarter];
        if residual.abs() > spike.abs() {
            *spike = residual;
        }
    }
    let ellipse = 2.0 * x[5];
    Some(Causes {
        centre_mm: [0, 1].map(|i| about[i] - centre_mm[i] + x[2 + i]),
        backlash_mm: [x[7], x[8]],
        scale_mismatch_mm: 4.0 * x[4],
        squareness_rad: both.then_some(2.0 * x[5] / radius),
        servo_mismatch_mm: both.then_some(2.0 * x[6]),
        diagonal_ellipse_mm: (!both).then_some(ellipse),
        spikes: spikes(&highest, paths),
        residual_rms_mm: (squares / count.max(1) as f64).sqrt(),
    })
}

fn spikes(highest: &[[f64; 4]; 2], paths: &[PathResult]) -> Vec<Spike> {
    let mut spikes = Vec::new();
    for (i, sense) in [Sense::CounterClockwise, Sense::Clockwise].into_iter().enumerate() {
        if !paths.iter().any(|p| p.path.sense == sense) {
            continue;
        }
        for (quarter, height_mm) in highest[i].iter().enumerate() {
            let at_rad = (sense.sign() * quarter as f64 * FRAC_PI_2).rem_euclid(TAU).abs();
            // At 0° and 180° the first axis reverses, at 90° and 270° the second.
            spikes.push(Spike { axis: quarter % 2, at_rad, sense, height_mm: *height_mm });
        }
    }
    spikes
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_reversal_before_is_found_in_the_direction_of_motion() {
        let (after, quarter) = after_reversal(95_f64.to_radians(), Sense::CounterClockwise);
        assert!((after.to_degrees() - 5.0).abs() < 1e-9 && quarter == 1);
        // Clockwise 85° comes 5° after 90°, which is three quarters of a turn from 0°.
        let (after, quarter) = after_reversal(85_f64.to_radians(), Sense::Clockwise);
        assert!((after.to_degrees() - 5.0).abs() < 1e-9 && quarter == 3);
    }
}
