//! The best terms of every number, all tried.

use super::design::{COLLINEAR, Training};
use nalgebra::{Cholesky, DVector};

/// For 0, 1, 2 … terms the columns with the smallest sum of squares left, of those that are
/// separable; the list ends where none can.
///
/// All combinations are tried: `k terms of p` is small for models that anybody should use, and no
/// step of a search can miss a pair that only works together.
pub fn best_subsets(training: &Training, most: usize) -> Vec<Vec<usize>> {
    let moving = training.moving();
    let mut found = vec![Vec::new()];
    for size in 1..=most.min(moving.len()) {
        let mut best: Option<(f64, Vec<usize>)> = None;
        let mut places: Vec<usize> = (0..size).collect();
        loop {
            let subset: Vec<usize> = places.iter().map(|i| moving[*i]).collect();
            if let Some(taken) = taken_away(training, &subset)
                && best.as_ref().is_none_or(|(most, _)| taken > *most)
                && training.condition(&subset) <= COLLINEAR
            {
                best = Some((taken, subset));
            }
            if !next(&mut places, moving.len()) {
                break;
            }
        }
        let Some((_, subset)) = best else { break };
        found.push(subset);
    }
    found
}

/// How many combinations there are of up to so many terms.
pub fn combinations(candidates: usize, most: usize) -> f64 {
    let mut of_size = 1.0;
    let mut all = 0.0;
    for k in 1..=most.min(candidates) {
        of_size *= (candidates + 1 - k) as f64 / k as f64;
        all += of_size;
    }
    all
}

/// The sum of squares that these columns explain: qᵀ R⁻¹ q.
fn taken_away(training: &Training, subset: &[usize]) -> Option<f64> {
    let (scaled, lengths) = training.scaled(subset);
    let right = subset.iter().zip(&lengths).map(|(j, length)| training.right[*j] / length);
    let right = DVector::from_iterator(subset.len(), right);
    let solved = Cholesky::new(scaled)?.solve(&right);
    Some(right.dot(&solved)).filter(|v| v.is_finite())
}

/// The next combination in the order of the alphabet.
fn next(places: &mut [usize], count: usize) -> bool {
    let size = places.len();
    for i in (0..size).rev() {
        if places[i] < count - size + i {
            places[i] += 1;
            for k in i + 1..size {
                places[k] = places[k - 1] + 1;
            }
            return true;
        }
    }
    false
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_combination_comes_once() {
        let mut places = vec![0, 1];
        let mut all = vec![places.clone()];
        while next(&mut places, 4) {
            all.push(places.clone());
        }
        assert_eq!(all, [[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]]);
        // 4 single ones and 6 pairs.
        assert_eq!(combinations(4, 2), 10.0);
    }
}
