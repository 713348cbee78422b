//! Predicting readings where the errors cannot be separated: all errors together, listed or not, each with what is
//! known of it before as a prior (ridge regression with stated weights).
//!
//! ```text
//!     x̂ = (N + σ² Λ)⁻¹ g      Λ = diag(1/u²) of the listed ones, 1/(t_g D²) of the others     docs/model.md eq. 306
//! ```
//!
//! Compensation needs the place of the tool, not the names of the errors. How good the prediction is, is seen on
//! readings that were held out: every tenth of the places, and all readings at one angle of a rotary axis; the sizes
//! are found again without them.

use super::adequacy::{Prepared, Task, explanations};
use super::score::Rms;
use super::selection::{Sums, parts_by_place};
use nalgebra::{DMatrix, DVector};
use trueaxis_machine::axis::{Axis, AxisKind};
use trueaxis_measure::unknowns::design::Design;
use trueaxis_measure::unknowns::fit::linear_residuals;
use trueaxis_measure::unknowns::mixed::Sizes;
use trueaxis_measure::unknowns::stated::Stated;

/// Angles of a rotary axis that are held out one after the other; with more it is swept, not set.
const ANGLES: std::ops::RangeInclusive<usize> = 3..=24;
/// More readings than this are not held out: it would take too long, and selection does it for the listed errors.
const MOST_ROWS: usize = 3000;
/// Parts of the places.
const FOLDS: usize = 10;

/// Readings that were predicted by a model without them.
#[derive(Debug, Clone, PartialEq)]
pub struct HeldOut {
    /// The rotary axis of which one angle after the other was held out; none: tenths of the places.
    pub axis: Option<usize>,
    /// How many parts.
    pub parts: usize,
    /// The residual of the prediction by all errors.
    pub predicted: Rms,
    /// The residual of the listed errors alone.
    pub listed: Rms,
}

/// How well readings are predicted, and by what.
#[derive(Debug, Clone)]
pub struct Predictor {
    /// On the readings themselves.
    pub in_sample: Rms,
    /// On readings that were held out.
    pub held_out: Vec<HeldOut>,
    /// The listed errors and all others; those whose size is 0 are in it with the value 0.
    pub design: Design,
    /// The values of all errors, in the order of that design. Unit: mm, rad or 1.
    pub values: DVector<f64>,
    /// Their covariance: σ² (N + σ² Λ)⁻¹, over the explanations of the residual by their likelihood.
    pub covariance: DMatrix<f64>,
}

/// Predicts by the first explanation; `None` if the sums are not finite.
pub(super) fn predictor(
    all: &Prepared<'_>,
    (sums, explanations): (&Sums, &[Sizes]),
    task: Task<'_>,
) -> Option<Predictor> {
    let values = all.values(sums, explanations.first()?)?;
    let mut covariance = covariance(all, (sums, explanations), &values)?;
    let stated = Stated::of(&all.all, task.readings);
    if !stated.names().is_empty() {
        let first = explanations.first()?;
        let gain = all.covariance(sums, first)? / first.noise.powi(2);
        let moved = gain * stated.pull(task.readings, task.weights);
        let off = stated.off_together(moved, task.readings);
        covariance += &off * off.transpose();
    }
    let in_sample = rms(all, task, |_| &values);
    let mut splits = Vec::new();
    if task.scores && task.readings.len() <= MOST_ROWS {
        splits.push((None, parts_by_place(task.readings, FOLDS).0));
        splits.extend(angles(task).into_iter().map(|(axis, parts)| (Some(axis), parts)));
    }
    let held_out = splits.into_iter().filter_map(|(axis, part)| held_out(all, task, axis, &part));
    let (held_out, design) = (held_out.collect(), all.all.clone());
    Some(Predictor { in_sample, held_out, design, values, covariance })
}

/// The covariance about these values, over the explanations by their likelihood: what one of them leaves, and how far
/// its values are off.
fn covariance(
    all: &Prepared<'_>,
    (sums, explanations): (&Sums, &[Sizes]),
    values: &DVector<f64>,
) -> Option<DMatrix<f64>> {
    let mut covariance = DMatrix::zeros(values.len(), values.len());
    let deviances: Vec<f64> = explanations.iter().map(|e| e.deviance).collect();
    for (explanation, share) in explanations.iter().zip(shares(&deviances)) {
        let off = all.values(sums, explanation)? - values;
        covariance += (all.covariance(sums, explanation)? + &off * off.transpose()) * share;
    }
    Some(covariance)
}

/// How likely each of them is among all: exp(−d/2) of their deviances, the least of which is taken out, as with
/// thousands of readings nothing but zeros would remain.
fn shares(deviances: &[f64]) -> Vec<f64> {
    let least = deviances.iter().copied().fold(f64::INFINITY, f64::min);
    let likelihoods = deviances.iter().map(|deviance| (-0.5 * (deviance - least)).exp());
    let whole: f64 = likelihoods.clone().sum();
    likelihoods.map(|likelihood| likelihood / whole).collect()
}

fn rms<'v>(
    all: &Prepared<'_>,
    task: Task<'_>,
    values: impl Fn(usize) -> &'v DVector<f64> + Sync,
) -> Rms {
    let residuals = linear_residuals(&all.all, task.readings, &all.z, values);
    // What was left out of the fit is no measure of it.
    let counts = |i: usize| task.weights.get(i) != Some(&0.0);
    let kept =
        (0..residuals.len()).filter(|i| counts(*i)).map(|i| residuals[i]).collect::<Vec<_>>();
    Rms::of(&all.all, &task.readings.filtered(counts), &kept)
}

/// Every part predicted by the others, with the listed errors and with all.
fn held_out(
    all: &Prepared<'_>,
    task: Task<'_>,
    axis: Option<usize>,
    part: &[usize],
) -> Option<HeldOut> {
    let parts = part.iter().max().map_or(0, |p| p + 1);
    if parts < 2 {
        return None;
    }
    let mut with = Vec::new();
    let mut listed = Vec::new();
    for held in 0..parts {
        let sums = all.sums(|i| part[i] != held);
        let rest = all.rest(&sums)?;
        let sizes = explanations(&rest, &all.ranges).swap_remove(0);
        with.push(all.values(&sums, &sizes)?);
        listed.push(all.values(&sums, &Sizes::none(all.ranges.len()))?);
    }
    Some(HeldOut {
        axis,
        parts,
        predicted: rms(all, task, |i| &with[part[i]]),
        listed: rms(all, task, |i| &listed[part[i]]),
    })
}

/// Rotary axes that stood at a few angles, with the number of the angle of each row.
fn angles(task: Task<'_>) -> Vec<(usize, Vec<usize>)> {
    let axes = task.design.machine.axes().iter().enumerate();
    let rotary = axes.filter(|(_, a)| a.kind == AxisKind::Rotary);
    let of = |(axis, _): (usize, &Axis)| {
        let angle =
            |i: usize| (task.readings.commands[i][axis].to_degrees() * 100.0).round() as i64;
        let mut distinct: Vec<i64> = (0..task.readings.len()).map(angle).collect();
        distinct.sort_unstable();
        distinct.dedup();
        let place = |i: usize| distinct.binary_search(&angle(i)).unwrap_or(0);
        let parts = (0..task.readings.len()).map(place).collect();
        ANGLES.contains(&distinct.len()).then_some((axis, parts))
    };
    rotary.filter_map(of).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Only differences of deviances count, however many readings there are.
    #[test]
    fn law_the_shares_do_not_depend_on_what_all_have_in_common() {
        // exp(−0), exp(−1), exp(−2) over their sum.
        let due = [0.665_241, 0.244_728, 0.090_031];
        for common in [-50_000.0, -300.0, 0.0, 7.5, 2_000.0, 80_000.0] {
            let found = shares(&[common, common + 2.0, common + 4.0]);
            assert!(
                found.iter().zip(due).all(|(a, b)| (a - b).abs() < 1e-6),
                "{common}: {found:?}"
            );
        }
    }
}
