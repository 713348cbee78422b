//! Instruments that contradict each other: together they fit much worse than apart.
//!
//! ```text
//!     F = (χ²(all) − χ²(one) − χ²(others)) / (rank(one) + rank(others) − rank(all)) / s²
//! ```

use super::selection::Sums;
use nalgebra::DVector;
use trueaxis_geometry::statistics::{self, chi_square_above};
use trueaxis_input::{Diagnostics, Place};
use trueaxis_measure::measure::Readings;
use trueaxis_measure::unknowns::design::Design;
use trueaxis_measure::unknowns::fit::Observability;

/// One in a thousand by chance.
const TAIL: f64 = 1e-3;

/// The probability that χ² with these degrees of freedom is larger.
pub fn chi_square_tail(x: f64, degrees_of_freedom: usize) -> f64 {
    statistics::chi_square_tail(x, degrees_of_freedom as f64)
}

struct Solved {
    chi_square: f64,
    sight: Observability,
    values: DVector<f64>,
    numbers: usize,
}

impl Solved {
    fn of(sums: &Sums) -> Self {
        let sight = Observability::of(&sums.normal);
        let values = sight.solve(&sums.gradient);
        Self { chi_square: sums.error(&values), sight, values, numbers: sums.numbers }
    }

    fn freedom(&self) -> f64 {
        self.numbers.saturating_sub(self.sight.rank) as f64
    }
}

/// Warns of the instrument that contradicts the others most, and says which one it is.
///
/// `z` are the readings, linear about the solution.
pub fn check_conflicts(
    design: &Design,
    readings: &Readings,
    z: &[[f64; 3]],
    place: &Place,
    problems: &mut Diagnostics,
) -> Option<String> {
    let count = design.instruments.len();
    if count < 2 {
        return None;
    }
    let own: Vec<Sums> = (0..count)
        .map(|k| {
            let mine = |i: usize| readings.instruments[i] as usize == k;
            let z: Vec<[f64; 3]> = (0..z.len()).filter(|i| mine(*i)).map(|i| z[i]).collect();
            Sums::of(design, &readings.filtered(mine), &z, &[])
        })
        .collect();
    let mut sums = Sums::zero(design.unknowns());
    own.iter().for_each(|s| sums.add(s, 1.0));
    let all = Solved::of(&sums);
    let mut worst: Option<(f64, usize, Solved, Solved)> = None;
    for (k, mine) in own.iter().enumerate().filter(|(_, s)| s.numbers > 0) {
        let mut rest = sums.clone();
        rest.add(mine, -1.0);
        let (one, others) = (Solved::of(mine), Solved::of(&rest));
        let more = (one.sight.rank + others.sight.rank).saturating_sub(all.sight.rank) as f64;
        let free = one.freedom() + others.freedom();
        if more < 1.0 || free < 5.0 {
            continue;
        }
        let apart = one.chi_square + others.chi_square;
        let variance = (apart / free).max(1.0);
        let ratio = (all.chi_square - apart) / (chi_square_above(TAIL, more) * variance);
        if ratio > 1.5 && worst.as_ref().is_none_or(|w| ratio > w.0) {
            worst = Some((ratio, k, one, others));
        }
    }
    let (_, k, one, others) = worst?;
    let apart = one.chi_square + others.chi_square;
    let message = format!(
        "{} contradicts the others: χ² is {:.0} together and {apart:.0} apart{}",
        design.instruments[k].name,
        all.chi_square,
        differing(design, &one, &others)
    );
    let hint = "look at its sign, unit, place and temperature (--check-conventions), or at drift";
    problems.warn("conflicting-instruments", place.clone(), message, hint);
    Some(design.instruments[k].name.clone())
}

/// The error that both see and that differs most.
fn differing(design: &Design, one: &Solved, others: &Solved) -> String {
    let (a, b) = (one.sight.covariance(), others.sight.covariance());
    let both = (0..design.terms.len()).filter(|k| {
        let [a, b] = [a[(*k, *k)], b[(*k, *k)]];
        one.sight.is_seen[*k] && others.sight.is_seen[*k] && a > 0.0 && b > 0.0
    });
    let off = |k: usize| (one.values[k] - others.values[k]) / (a[(k, k)] + b[(k, k)]).sqrt();
    let worst = both.max_by(|x, y| off(*x).abs().total_cmp(&off(*y).abs()));
    worst.map_or_else(String::new, |k| {
        let angle = design.unknown(k).is_some_and(|u| u.is_angle());
        let (scale, unit) = if angle { (1e6, "µrad") } else { (1e3, "µm") };
        format!(
            "; {} is {:.1} {unit} by it and {:.1} {unit} by the others, {:.1} u",
            design.terms[k].name(),
            one.values[k] * scale,
            others.values[k] * scale,
            off(k).abs()
        )
    })
}

#[cfg(test)]
mod tests {
    use super::chi_square_tail;

    #[test]
    fn tails_of_published_tables() {
        // Abramowitz and Stegun, table 26.8: χ² that is exceeded with 5 % and 1 %.
        let table = [
            (1, 3.84146, 0.05),
            (2, 5.99147, 0.05),
            (5, 11.0705, 0.05),
            (9, 21.6660, 0.01),
            (30, 50.8922, 0.01),
            (100, 124.342, 0.05),
        ];
        for (n, x, p) in table {
            assert!((chi_square_tail(x, n) - p).abs() < 2e-5, "{n}: {}", chi_square_tail(x, n));
        }
    }
}
