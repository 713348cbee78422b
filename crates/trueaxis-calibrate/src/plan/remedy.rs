//! The cheapest further set-up that makes a combination observable.

use super::trial::{Trial, trials};
use nalgebra::{DMatrix, DVector, SymmetricEigen};
use trueaxis_measure::measure::Campaign;
use trueaxis_measure::unknowns::confusion::Confusion;
use trueaxis_measure::unknowns::design::Design;

/// Seen less than this share of what each member alone would show is rounding.
const NOTHING: f64 = 1e-6;

/// A set-up that makes a combination observable, in words; `None` if no
/// set-up of the list does.
///
/// A second tool, a turned spindle, the ball at another place, more turned poses, and instruments that the campaign
/// does not have are tried in the order of their minutes.
pub fn remedies(campaign: &Campaign, design: &Design, confusion: &Confusion) -> Option<String> {
    let trials = trials(campaign, design);
    let found = trials.iter().find(|trial| separates(trial, design.unknowns(), confusion))?;
    Some(format!("{} (about {} min)", found.words, found.minutes))
}

/// Whether the readings of a trial change along a combination, whatever its own unknowns do.
///
/// ```text
///     |(1 − F F⁺) J c| > 0        F: columns of the unknowns that are others there   docs/model.md eq. 113
/// ```
fn separates(trial: &Trial, known: usize, confusion: &Confusion) -> bool {
    let columns = trial.design.columns(&trial.stations, 0..trial.stations.len());
    let is_fresh = |k: usize| k >= known || trial.fresh.contains(&k);
    let mut along = DVector::zeros(trial.design.unknowns());
    let mut alone = 0.0_f64;
    for (k, share) in confusion.members.iter().filter(|(k, _)| !is_fresh(*k)) {
        let changed = trial.changed.iter().find(|(changed, _)| changed == k);
        along[*k] = share * changed.map_or(1.0, |(_, factor)| *factor);
        alone = alone.max((columns.row(*k) * *share).norm());
    }
    let read = columns.tr_mul(&along);
    let fresh: Vec<usize> = (0..trial.design.unknowns()).filter(|k| is_fresh(*k)).collect();
    let left = without(&columns, &fresh, read);
    alone > 0.0 && left.norm() > NOTHING * alone
}

/// What of a reading the free unknowns cannot take up.
fn without(columns: &DMatrix<f64>, free: &[usize], read: DVector<f64>) -> DVector<f64> {
    // Rows of length 1: mm and rad weigh alike.
    let rows = free.iter().filter_map(|k| {
        let row = columns.row(*k).transpose();
        let length = row.norm();
        (length > 0.0).then(|| row / length)
    });
    let rows: Vec<DVector<f64>> = rows.collect();
    if rows.is_empty() {
        return read;
    }
    let f = DMatrix::from_columns(&rows);
    let eigen = SymmetricEigen::new(f.tr_mul(&f));
    let greatest = eigen.eigenvalues.amax();
    let mut left = read;
    for (value, vector) in eigen.eigenvalues.iter().zip(eigen.eigenvectors.column_iter()) {
        if *value > 1e-12 * greatest {
            let direction = (&f * vector) / value.sqrt();
            let by = direction.dot(&left);
            left -= direction * by;
        }
    }
    left
}
