//! The steps before the direction table: eccentricity, Z datum, X and Y datum (Zhang et al. 2023, 2.3.2).

use nalgebra::{Matrix3, Vector3};
use serde::Serialize;
use trueaxis_input::MeasuredValue;
use trueaxis_report::JsonSchema;

/// A dial against the stylus ball while the spindle turns.
#[derive(Debug, Clone, PartialEq)]
pub struct DialTurn {
    /// Where the dial stands, seen from the spindle, rad.
    pub at_rad: f64,
    /// Spindle angle (rad) and reading (mm, plunger in: positive).
    pub readings: Vec<(f64, f64)>,
}

/// How far the ball runs out.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Eccentricity {
    /// Ball − spindle in the frame of the probe, mm.
    pub offset_mm: [f64; 2],
    /// Standard uncertainty of each coordinate, mm.
    pub u_mm: [f64; 2],
    /// Greatest less smallest reading, mm.
    pub runout_mm: f64,
    /// What is no eccentricity, rms, mm.
    pub left_mm: f64,
}

/// The offset from a dial.
///
/// ```text
///     reading(φ) = k + o_x cos(α − φ) + o_y sin(α − φ)                               docs/model.md eq. 142
/// ```
///
/// `None`: fewer than four readings, or too few directions.
pub fn eccentricity(turn: &DialTurn) -> Option<Eccentricity> {
    let count = turn.readings.len();
    let row = |angle: f64| {
        let seen = turn.at_rad - angle;
        Vector3::new(1.0, seen.cos(), seen.sin())
    };
    let (mut normal, mut right) = (Matrix3::zeros(), Vector3::zeros());
    for (angle, reading) in &turn.readings {
        normal += row(*angle) * row(*angle).transpose();
        right += row(*angle) * *reading;
    }
    let inverse = normal.try_inverse().filter(|_| normal.determinant() > 1e-3)?;
    let x = inverse * right;
    let left = turn.readings.iter().map(|(angle, reading)| (reading - row(*angle).dot(&x)).powi(2));
    let squares: f64 = left.sum();
    let s = (squares / count.checked_sub(3).filter(|n| *n > 0)? as f64).sqrt();
    let readings = || turn.readings.iter().map(|r| r.1);
    Some(Eccentricity {
        offset_mm: [x[1], x[2]],
        u_mm: [1, 2].map(|k| s * inverse[(k, k)].sqrt()),
        runout_mm: readings().fold(f64::MIN, f64::max) - readings().fold(f64::MAX, f64::min),
        left_mm: (squares / count as f64).sqrt(),
    })
}

/// A reference tool on a gauge block on the ring, then the probe on the ring.
#[derive(Debug, Clone, PartialEq)]
pub struct ZSteps {
    /// Length of the reference tool, mm.
    pub reference_length_mm: MeasuredValue,
    /// Height of the gauge block, mm.
    pub block_mm: MeasuredValue,
    /// The spindle when the reference tool touches the block, mm.
    pub reference_z_mm: MeasuredValue,
    /// The spindle at each trigger on the top of the ring, mm.
    pub probe_z_mm: Vec<f64>,
}

/// Where the top of the ring stands, and how long the probe is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ZDatum {
    /// Top of the ring, machine coordinate, mm.
    pub top_mm: f64,
    /// Length of the probe for the control: at the trigger, so less its pre-travel in Z, mm.
    pub length_mm: f64,
    /// Standard uncertainty of the length, mm.
    pub u_length_mm: f64,
    /// Range of the triggers, mm.
    pub range_mm: f64,
}

/// ```text
///     z_top = Z_ref − L_ref − b        L = mean Z_probe − z_top                    docs/model.md eq. 143
/// ```
pub fn z_datum(steps: &ZSteps) -> ZDatum {
    let top = steps.reference_z_mm.value - steps.reference_length_mm.value - steps.block_mm.value;
    let z = &steps.probe_z_mm;
    let count = z.len().max(1) as f64;
    let mean = z.iter().sum::<f64>() / count;
    let squares: f64 = z.iter().map(|v| (v - mean).powi(2)).sum();
    let scatter = if z.len() > 1 { squares / (count - 1.0) / count } else { 0.0 };
    let stated = [steps.reference_z_mm, steps.reference_length_mm, steps.block_mm];
    let variance: f64 = stated.iter().map(|m| m.u.unwrap_or(0.0).powi(2)).sum();
    let extreme = |pick: fn(f64, f64) -> f64| z.iter().copied().reduce(pick).unwrap_or(0.0);
    ZDatum {
        top_mm: top,
        length_mm: mean - top,
        u_length_mm: (variance + scatter).sqrt(),
        range_mm: extreme(f64::max) - extreme(f64::min),
    }
}

/// Four hits within a ring: X+, X−, Y+, Y−.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FourHits {
    /// The spindle at the triggers A, B (X) and C, D (Y), mm.
    pub hits_mm: [f64; 4],
    /// Centre of the ring, machine coordinates, mm.
    pub centre_mm: [f64; 2],
    /// Radius of the ring, mm.
    pub ring_radius_mm: f64,
}

/// What a control takes over from four hits.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct XyDatum {
    /// Ball − spindle in x and y, mm.
    pub offset_mm: [f64; 2],
    /// The effective diameters of the ball in x and y, less the pre-travel, mm.
    pub ball_diameter_mm: [f64; 2],
}

/// ```text
///     o = c − ((A + B)/2, (C + D)/2)        d = 2R − (A − B)                       docs/model.md eq. 144
/// ```
///
/// DIFFERENCE: 003-4. The paper has ((A + B)/2, (C + D)/2): without the centre, and the other sign.
pub fn xy_datum(four: &FourHits) -> XyDatum {
    let [a, b, c, d] = four.hits_mm;
    XyDatum {
        offset_mm: [four.centre_mm[0] - 0.5 * (a + b), four.centre_mm[1] - 0.5 * (c + d)],
        ball_diameter_mm: [(a - b), (c - d)].map(|way| 2.0 * four.ring_radius_mm - way),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn four_hits_tell_the_offset_with_its_sign() {
        // Ring of 62 about (100, 50), ball of 4 standing 0.03 to the right and 0.02 below: the
        // spindle goes from 100 − 0.03 by 29 to either side.
        let hits_mm = [128.97, 70.97, 79.02, 21.02];
        let four = FourHits { hits_mm, centre_mm: [100.0, 50.0], ring_radius_mm: 31.0 };
        let found = xy_datum(&four);
        assert!((found.offset_mm[0] - 0.03).abs() < 1e-12);
        assert!((found.offset_mm[1] + 0.02).abs() < 1e-12);
        assert!((found.ball_diameter_mm[0] - 4.0).abs() < 1e-12);
    }

    #[test]
    fn a_probe_is_as_long_as_the_spindle_stands_above_the_ring() {
        // Tool 100 on block 50 at Z 200: the ring is at 50; the probe triggers at 170: 120 long.
        let exact = |value| MeasuredValue { value, u: None };
        let found = z_datum(&ZSteps {
            reference_length_mm: MeasuredValue { value: 100.0, u: Some(0.003) },
            block_mm: MeasuredValue { value: 50.0, u: Some(0.004) },
            reference_z_mm: exact(200.0),
            probe_z_mm: vec![170.0, 170.0],
        });
        assert_eq!((found.top_mm, found.length_mm), (50.0, 120.0));
        assert!((found.u_length_mm - 0.005).abs() < 1e-12);
    }

    #[test]
    fn a_dial_sees_the_ball_come_and_go() {
        // Ball 0.01 towards +X of the probe, dial at +Y: the ball comes near it after a quarter turn.
        let readings = (0..8).map(|i| f64::from(i) * std::f64::consts::FRAC_PI_4);
        let readings = readings.map(|a| (a, 0.5 + 0.01 * a.sin())).collect();
        let found =
            eccentricity(&DialTurn { at_rad: std::f64::consts::FRAC_PI_2, readings }).unwrap();
        assert!((found.offset_mm[0] - 0.01).abs() < 1e-12 && found.offset_mm[1].abs() < 1e-12);
        assert!((found.runout_mm - 0.02).abs() < 1e-12);
    }
}
