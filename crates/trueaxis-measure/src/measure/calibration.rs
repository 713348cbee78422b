//! What stages know without the axes of the machine: a zero, a ball, values of certificates.
//!
//! ```text
//!     u(zero)² = s²/n + u(centring)²                                                      docs/model.md eq. 203
//!     V(c) = u² (JᵀJ)⁻¹ + u(seat)² I,   J = [−n, −½]                                      docs/model.md eq. 204
//! ```

use super::Campaign;
use super::stages::{BallStage, FIXED_U, Stage};
use crate::instruments::instrument::SetupError;
use crate::unknowns::design::Design;
use crate::unknowns::known::Known;
use nalgebra::{DMatrix, DVector, Matrix4, Vector4};
use trueaxis_geometry::Vec3;

/// What these stages will know before anything was read.
pub fn planned_calibrations(campaign: &Campaign) -> Vec<Known> {
    let design = campaign.design();
    let plan = |stage: &Stage| {
        let mut known = stated_values(&design, stage);
        if let Some(zero) = &stage.zero {
            let noise = design.instruments[zero.instrument].noise;
            for (k, c) in zeros(&design, zero.instrument) {
                let u = (noise[c] * noise[c] / zero.count as f64 + zero.u * zero.u).sqrt();
                known.add_value(k, 0.0, u);
            }
        }
        if let Some(ball) = &stage.ball
            && let Some(inverse) = normal_of_sphere(&ball.directions()).try_inverse()
        {
            add_centre(&design, ball, Vec3::zeros(), (inverse, ball.u_mm), &mut known);
        }
        known
    };
    campaign.stages.list.iter().map(plan).collect()
}

/// The values that a stage states.
pub fn stated_values(design: &Design, stage: &Stage) -> Known {
    let names = design.names();
    let mut known = Known::nothing(names.clone());
    for value in &stage.values {
        if let Some(k) = names.iter().position(|name| *name == value.name) {
            known.add_value(k, value.value, value.u);
        }
    }
    known
}

/// The unknown zeros of an instrument: the unknown and its channel.
pub fn zeros(design: &Design, instrument: usize) -> Vec<(usize, usize)> {
    of_setup(design, instrument, |error| match error {
        SetupError::Zero(c) => Some(c),
        _ => None,
    })
}

fn of_setup(
    design: &Design,
    instrument: usize,
    wanted: impl Fn(SetupError) -> Option<usize>,
) -> Vec<(usize, usize)> {
    let own = &design.instruments[instrument];
    let first: usize = design.terms.len()
        + design.instruments[..instrument].iter().map(|i| i.unknowns.len()).sum::<usize>();
    let unknowns = own.unknowns.iter().enumerate();
    unknowns.filter_map(|(j, u)| Some((first + j, wanted(u.error)?))).collect()
}

/// JᵀJ of centre and diameter for points in these directions from the centre.
pub fn normal_of_sphere(directions: &[Vec3]) -> Matrix4<f64> {
    directions.iter().fold(Matrix4::zeros(), |sum, n| {
        let row = Vector4::new(-n.x, -n.y, -n.z, -0.5);
        sum + row * row.transpose()
    })
}

/// The centre with its covariance as knowledge of the unknown coordinates of the ball.
pub fn add_centre(
    design: &Design,
    stage: &BallStage,
    off: Vec3,
    (inverse, u_point): (Matrix4<f64>, f64),
    known: &mut Known,
) {
    let own = of_setup(design, stage.instrument, |error| match error {
        SetupError::ReferencePoint(i) => Some(i),
        _ => None,
    });
    let names = design.names();
    let m = own.len();
    let mut rows = DMatrix::zeros(m, names.len());
    own.iter().enumerate().for_each(|(row, (k, _))| rows[(row, *k)] = 1.0);
    let values = DVector::from_fn(m, |row, _| off[own[row].1]);
    // Points and seat without any uncertainty would still be a value of 1 nm.
    let seat = stage.seat_u_mm.powi(2) + FIXED_U.powi(2);
    let covariance = DMatrix::from_fn(m, m, |i, j| {
        let (a, b) = (own[i].1, own[j].1);
        inverse[(a, b)] * u_point * u_point + if a == b { seat } else { 0.0 }
    });
    if let Some(centre) = Known::of_rows(names, &rows, &values, &covariance, &[]) {
        known.add(&centre, 1.0);
    }
}
