//! A linear programme with few unknowns and many rows: the linear Chebyshev problem in a box.
//!
//! Docs/model.md eq. 224. The simplex method on the dual problem: the basis has as many rows as there are unknowns,
//! and the most violated row enters. Ties are broken by the lexicographic rule, so that it cannot run in a circle.

use crate::surface::MOST;
use nalgebra::{Const, DimMin, SMatrix, SVector};

/// Most unknowns: those of a family, upper and lower end.
const ROWS: usize = MOST + 2;
const MOST_PIVOTS: usize = 2000;
/// Values are of the order of 1.
const TOLERANCE: f64 = 1e-12;

/// Values and slopes at the points, in units of the box: |step| ≤ 1 for each unknown.
pub(crate) struct Linear<'a> {
    pub unknowns: usize,
    pub values: &'a [f64],
    /// `MOST` for each point.
    pub slopes: &'a [[f64; MOST]],
    /// Whether the upper end counts, the lower end counts.
    pub ends: [bool; 2],
}

/// A row of the programme.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Row {
    /// Unknown ≤ limit (+1) or ≥ −limit (−1).
    Box(usize, f64),
    /// A point below the upper end.
    Upper(usize),
    /// A point above the lower end.
    Lower(usize),
}

/// The solution.
pub(crate) struct Best {
    pub step: [f64; MOST],
    /// Upper and lower end.
    pub ends: [f64; 2],
    /// Rows that hold it, with their multipliers.
    pub rows: Vec<(Row, f64)>,
}

impl Best {
    /// What was made small.
    pub fn objective(&self, counted: [bool; 2]) -> f64 {
        f64::from(u8::from(counted[0])) * self.ends[0]
            - f64::from(u8::from(counted[1])) * self.ends[1]
    }
}

impl Linear<'_> {
    fn size(&self) -> usize {
        self.unknowns + self.ends.iter().filter(|e| **e).count()
    }

    /// Where the ends stand among the unknowns.
    fn upper(&self) -> usize {
        self.unknowns
    }

    fn lower(&self) -> usize {
        self.unknowns + usize::from(self.ends[0])
    }

    fn normal(&self, row: Row) -> [f64; ROWS] {
        let mut a = [0.0; ROWS];
        match row {
            Row::Box(k, sign) => a[k] = sign,
            Row::Upper(i) => {
                a[..self.unknowns].copy_from_slice(&self.slopes[i][..self.unknowns]);
                a[self.upper()] = -1.0;
            }
            Row::Lower(i) => {
                (0..self.unknowns).for_each(|k| a[k] = -self.slopes[i][k]);
                a[self.lower()] = 1.0;
            }
        }
        a
    }

    fn right(&self, row: Row, far: f64) -> f64 {
        match row {
            Row::Box(k, _) if k < self.unknowns => 1.0,
            Row::Box(..) => far,
            Row::Upper(i) => -self.values[i],
            Row::Lower(i) => self.values[i],
        }
    }

    /// The smallest range, upper end, or −lower end within the box.
    pub fn solve(&self) -> Option<Best> {
        match self.size() {
            2 => self.solve_of::<2>(),
            3 => self.solve_of::<3>(),
            4 => self.solve_of::<4>(),
            5 => self.solve_of::<5>(),
            6 => self.solve_of::<6>(),
            ROWS => self.solve_of::<ROWS>(),
            _ => None,
        }
    }

    /// With so many rows of the basis.
    fn solve_of<const M: usize>(&self) -> Option<Best>
    where
        Const<M>: DimMin<Const<M>, Output = Const<M>>,
    {
        let far = self.values.iter().fold(0.0_f64, |f, v| f.max(v.abs())) + 10.0 * MOST as f64;
        let mut cost = SVector::<f64, M>::zeros();
        if self.ends[0] {
            cost[self.upper()] = 1.0;
        }
        if self.ends[1] {
            cost[self.lower()] = -1.0;
        }
        let mut basis: Vec<Row> =
            (0..M).map(|k| Row::Box(k, if cost[k] > 0.0 { -1.0 } else { 1.0 })).collect();
        let first = self.matrix::<M>(&basis);
        for _ in 0..MOST_PIVOTS {
            let matrix = self.matrix::<M>(&basis);
            let lu = matrix.lu();
            let weights = lu.solve(&-cost)?;
            let limits = SVector::from_fn(|k, _| self.right(basis[k], far));
            let y = matrix.transpose().lu().solve(&limits)?;
            let Some(entering) = self.most_violated(y.as_slice(), &basis, far) else {
                return Some(self.best(y.as_slice(), &basis, weights.as_slice()));
            };
            let normal = self.normal(entering);
            let share = lu.solve(&SVector::from_column_slice(&normal[..M]))?;
            let leaving = leaving(&weights, &lu.solve(&first)?, &share)?;
            basis[leaving] = entering;
        }
        None
    }

    fn matrix<const M: usize>(&self, basis: &[Row]) -> SMatrix<f64, M, M> {
        let mut matrix = SMatrix::zeros();
        for (j, row) in basis.iter().enumerate() {
            let normal = self.normal(*row);
            (0..M).for_each(|i| matrix[(i, j)] = normal[i]);
        }
        matrix
    }

    fn most_violated(&self, y: &[f64], basis: &[Row], far: f64) -> Option<Row> {
        let step: [f64; MOST] = std::array::from_fn(|k| if k < self.unknowns { y[k] } else { 0.0 });
        let upper = if self.ends[0] { y[self.upper()] } else { f64::INFINITY };
        let lower = if self.ends[1] { y[self.lower()] } else { f64::NEG_INFINITY };
        let mut worst = (TOLERANCE * (1.0 + far * 1e-3), None);
        for (i, (value, slope)) in self.values.iter().zip(self.slopes).enumerate() {
            let there: f64 = value + slope.iter().zip(&step).map(|(s, d)| s * d).sum::<f64>();
            if there - upper > worst.0 {
                worst = (there - upper, Some(Row::Upper(i)));
            }
            if lower - there > worst.0 {
                worst = (lower - there, Some(Row::Lower(i)));
            }
        }
        for (k, v) in y.iter().enumerate() {
            let limit = self.right(Row::Box(k, 1.0), far);
            if v.abs() - limit > worst.0 {
                worst = (v.abs() - limit, Some(Row::Box(k, v.signum())));
            }
        }
        worst.1.filter(|row| !basis.contains(row))
    }

    fn best(&self, y: &[f64], basis: &[Row], weights: &[f64]) -> Best {
        let step = std::array::from_fn(|k| if k < self.unknowns { y[k] } else { 0.0 });
        let upper = if self.ends[0] { y[self.upper()] } else { 0.0 };
        let lower = if self.ends[1] { y[self.lower()] } else { 0.0 };
        let rows = basis.iter().zip(weights).map(|(row, w)| (*row, *w)).collect();
        Best { step, ends: [upper, lower], rows }
    }
}

/// The row of the basis that leaves: the smallest ratio, ties by the columns of the first basis.
fn leaving<const M: usize>(
    weights: &SVector<f64, M>,
    table: &SMatrix<f64, M, M>,
    share: &SVector<f64, M>,
) -> Option<usize> {
    let candidates = (0..M).filter(|k| share[*k] > 1e-11);
    candidates.min_by(|a, b| {
        let ratio = |k: usize, c: Option<usize>| c.map_or(weights[k], |c| table[(k, c)]) / share[k];
        std::iter::once(None)
            .chain((0..M).map(Some))
            .map(|c| (ratio(*a, c), ratio(*b, c)))
            .find(|(x, y)| (x - y).abs() > 1e-13 * (1.0 + x.abs()))
            .map_or(std::cmp::Ordering::Equal, |(x, y)| x.total_cmp(&y))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_through_three_points_by_hand() {
        // Points (−1, 0), (0, 1), (1, 0), line y = s x: range 1 at s = 0, whatever the box.
        let slopes: Vec<[f64; MOST]> =
            [-1.0, 0.0, 1.0].map(|x: f64| [-x, 0.0, 0.0, 0.0, 0.0]).to_vec();
        let problem =
            Linear { unknowns: 1, values: &[0.0, 1.0, 0.0], slopes: &slopes, ends: [true, true] };
        let best = problem.solve().unwrap();
        assert!((best.objective([true, true]) - 1.0).abs() < 1e-12 && best.step[0].abs() < 1e-12);
        let weights: f64 = best.rows.iter().map(|(_, w)| w).sum();
        assert!((weights - 2.0).abs() < 1e-12);
    }
}
