//! Columns of all candidate terms, cycle by cycle, and least squares on some of them.

use super::{Logs, Term, Zero};
use nalgebra::{DMatrix, DVector, SymmetricEigen};

/// Columns whose condition number at equal length exceeds this are not separable (Belsley, Kuh &
/// Welsch 1980: from 30 on).
pub const COLLINEAR: f64 = 30.0;
/// A direction of less weight than this is rounding.
const NOTHING: f64 = 1e-13;

/// What a sensor would say through a first-order lag of time constant τ.
///
/// ```text
///     τ dL/dt = T − L                                                            docs/model.md eq. 90
///     L_i+1 = T_i+1 − (1 − a) τ/Δ (T_i+1 − T_i) + a (L_i − T_i),   a = e^(−Δ/τ),  Δ = t_i+1 − t_i
/// ```
///
/// Exact if T is straight between the rows; at the first row everything had settled, L = T.
pub fn lagged(times_s: &[f64], celsius: &[f64], tau_s: f64) -> Vec<f64> {
    let mut lagged = Vec::with_capacity(celsius.len());
    lagged.extend(celsius.first());
    for (t, c) in times_s.windows(2).zip(celsius.windows(2)) {
        let step = (t[1] - t[0]) / tau_s;
        let (kept, gone) = ((-step).exp(), -(-step).exp_m1());
        // Between rows at the same time nothing passes.
        let share = if step > 0.0 { gone / step } else { 1.0 };
        let before = lagged[lagged.len() - 1];
        lagged.push(c[1] - share * (c[1] - c[0]) + kept * (before - c[0]));
    }
    lagged
}

/// One cycle: a row for each reading, a column for each term, less what is free.
struct Block {
    x: DMatrix<f64>,
    y: DVector<f64>,
    gram: DMatrix<f64>,
    right: DVector<f64>,
    sums: DVector<f64>,
}

/// All cycles with all candidate terms.
pub struct Design {
    /// The candidates, in the order of the columns.
    pub terms: Vec<Term>,
    zero: Zero,
    blocks: Vec<Block>,
    /// Taken from all columns beforehand, °C.
    centre_celsius: Vec<f64>,
    /// Taken from all displacements beforehand, mm.
    centre_mm: f64,
    ranges_celsius: Vec<[f64; 2]>,
}

/// Sums over some cycles: all that least squares needs of them.
pub struct Training {
    /// XᵀX, the common zero taken out.
    pub gram: DMatrix<f64>,
    /// Xᵀy, likewise.
    pub right: DVector<f64>,
    /// Of the columns; infinite where one does not move, so that it scales to nothing.
    lengths: DVector<f64>,
    rows: f64,
    x_mean: DVector<f64>,
    y_mean: f64,
    one_zero: bool,
}

/// Coefficients of some terms.
#[derive(Debug, Clone)]
pub struct Fit {
    /// The columns.
    pub subset: Vec<usize>,
    /// One each, mm/K.
    pub mm_per_k: DVector<f64>,
    /// Condition number of the columns at equal length. Unit: 1.
    pub condition: f64,
    /// (XᵀX)⁻¹ of the columns.
    inverse: DMatrix<f64>,
    /// How much of one row the common zero takes.
    zero_share: f64,
    /// Taken out of the columns for one zero of all cycles, K.
    pub x_mean: DVector<f64>,
    y_mean: f64,
}

impl Design {
    /// Builds all columns; the zeros of equation 91 are taken out.
    pub fn new(logs: &Logs) -> Self {
        let lags = logs.lags_s.iter().map(|s| Some(*s));
        let terms: Vec<Term> = std::iter::once(None)
            .chain(lags)
            .flat_map(|lag_s| (0..logs.sensors.len()).map(move |sensor| Term { sensor, lag_s }))
            .collect();
        let columns: Vec<Vec<Vec<f64>>> =
            terms.iter().map(|t| logs.cycles.iter().map(|c| column(c, t)).collect()).collect();
        let rows = logs.cycles.iter().map(|c| c.displacement_mm.len()).sum::<usize>() as f64;
        let mean = |of: &mut dyn Iterator<Item = f64>| of.sum::<f64>() / rows;
        let centre_celsius: Vec<f64> =
            columns.iter().map(|c| mean(&mut c.iter().flatten().copied())).collect();
        let centre_mm =
            mean(&mut logs.cycles.iter().flat_map(|c| c.displacement_mm.iter().copied()));
        let blocks = (0..logs.cycles.len()).map(|g| {
            let y = DVector::from_column_slice(&logs.cycles[g].displacement_mm);
            let x =
                DMatrix::from_fn(y.len(), terms.len(), |i, j| columns[j][g][i] - centre_celsius[j]);
            Block::new(x, y.add_scalar(-centre_mm), logs.zero)
        });
        let range = |cycles: &Vec<Vec<f64>>| {
            cycles
                .iter()
                .flatten()
                .fold([f64::INFINITY, f64::NEG_INFINITY], |r, v| [r[0].min(*v), r[1].max(*v)])
        };
        Self {
            blocks: blocks.collect(),
            ranges_celsius: columns.iter().map(range).collect(),
            zero: logs.zero,
            centre_celsius,
            centre_mm,
            terms,
        }
    }

    /// The sums over all cycles but one.
    pub fn train(&self, without: Option<usize>) -> Training {
        let count = self.terms.len();
        let mut gram = DMatrix::zeros(count, count);
        let mut right = DVector::zeros(count);
        let (mut x_sum, mut y_sum, mut rows) = (DVector::zeros(count), 0.0, 0.0);
        for (_, block) in self.blocks.iter().enumerate().filter(|(g, _)| Some(*g) != without) {
            gram += &block.gram;
            right += &block.right;
            x_sum += &block.sums;
            y_sum += block.y.sum();
            rows += block.y.len() as f64;
        }
        let one_zero = self.zero == Zero::Common;
        if !one_zero {
            (x_sum, y_sum) = (DVector::zeros(count), 0.0);
        }
        let (x_mean, y_mean) = (x_sum / rows, y_sum / rows);
        gram -= &x_mean * x_mean.transpose() * rows;
        right -= &x_mean * (y_mean * rows);
        let squares = gram.diagonal();
        let least = NOTHING * squares.max();
        let lengths = squares.map(|s| if s > least { s.sqrt() } else { f64::INFINITY });
        Training { gram, right, lengths, rows, x_mean, y_mean, one_zero }
    }

    /// XᵀX/n of some columns over all cycles but one, and what was taken out of them for one zero of all, K.
    pub fn second_moments(
        &self,
        without: Option<usize>,
        columns: &[usize],
    ) -> (DMatrix<f64>, DVector<f64>) {
        let all = self.train(without);
        let gram = DMatrix::from_fn(columns.len(), columns.len(), |i, k| {
            all.gram[(columns[i], columns[k])] / all.rows
        });
        (gram, DVector::from_iterator(columns.len(), columns.iter().map(|j| all.x_mean[*j])))
    }

    /// The rows of some columns of a cycle, less `mean`, K.
    pub fn rows(&self, cycle: usize, columns: &[usize], mean: &DVector<f64>) -> Vec<DVector<f64>> {
        self.blocks[cycle].rows(columns, mean)
    }

    /// A fit of all cycles on some terms.
    pub fn fit_of_terms(&self, terms: &[Term]) -> Fit {
        let place = |t: &Term| self.terms.iter().position(|own| own == t);
        self.train(None).fit(&terms.iter().filter_map(place).collect::<Vec<_>>())
    }

    /// The columns of a log that is not among the cycles.
    pub fn sample(&self, log: &super::Cycle) -> Sample {
        let columns: Vec<Vec<f64>> = self.terms.iter().map(|t| column(log, t)).collect();
        let y = DVector::from_column_slice(&log.displacement_mm).add_scalar(-self.centre_mm);
        let x =
            DMatrix::from_fn(y.len(), columns.len(), |i, j| columns[j][i] - self.centre_celsius[j]);
        Sample(Block::new(x, y, self.zero))
    }

    /// What a fit predicts for a cycle, in the zero of [`Design::measured`], mm.
    pub fn predict(&self, cycle: usize, fit: &Fit) -> Vec<f64> {
        self.blocks[cycle].predict(fit)
    }

    /// What was measured in a cycle, less its zero, mm.
    pub fn measured(&self, cycle: usize) -> Vec<f64> {
        self.blocks[cycle].y.as_slice().to_vec()
    }

    /// Measured less predicted, mm; a first row that is zero by definition is no reading.
    pub fn residuals(&self, cycle: usize, fit: &Fit) -> Vec<f64> {
        let predicted = self.predict(cycle, fit);
        let left = self.blocks[cycle].y.iter().zip(predicted).map(|(y, p)| y - p);
        left.skip(self.first_row()).collect()
    }

    fn first_row(&self) -> usize {
        usize::from(self.zero == Zero::Start)
    }

    /// What each row would miss if only it had been left out.
    ///
    /// ```text
    ///     e_i / (1 − h_i),   h = diag X (XᵀX)⁻¹ Xᵀ                                docs/model.md eq. 93
    /// ```
    ///
    /// # Source
    /// Allen 1974 (PRESS).
    pub fn row_wise_residuals(&self, cycle: usize, fit: &Fit) -> Vec<f64> {
        let x = &self.blocks[cycle].x;
        let of_zero = match self.zero {
            Zero::Cycle => 1.0 / x.nrows() as f64,
            _ => fit.zero_share,
        };
        let first = self.first_row();
        let miss = |(i, residual): (usize, f64)| {
            let row = DVector::from_iterator(
                fit.subset.len(),
                fit.subset.iter().enumerate().map(|(k, j)| x[(i + first, *j)] - fit.x_mean[k]),
            );
            let own = of_zero + row.dot(&(&fit.inverse * &row));
            // A row that alone determines a coefficient cannot be predicted.
            residual / (1.0 - own).max(1e-9)
        };
        self.residuals(cycle, fit).into_iter().enumerate().map(miss).collect()
    }

    /// The displacement where all sensors read the reference, mm.
    pub fn intercept(&self, fit: &Fit, reference_celsius: f64) -> f64 {
        let terms = fit.subset.iter().enumerate();
        let away = terms.map(|(k, j)| {
            fit.mm_per_k[k] * (reference_celsius - self.centre_celsius[*j] - fit.x_mean[k])
        });
        self.centre_mm + fit.y_mean + away.sum::<f64>()
    }

    /// Lowest and highest temperature of a term, °C.
    pub fn range_celsius(&self, term: usize) -> [f64; 2] {
        self.ranges_celsius[term]
    }

    /// Pairs of sensors (without lag) that are not separable.
    pub fn twins(&self) -> Vec<(Term, Term)> {
        let all = self.train(None);
        let plain = |j: &usize| self.terms[*j].lag_s.is_none();
        let moving: Vec<usize> = all.moving().into_iter().filter(plain).collect();
        let pairs = moving.iter().flat_map(|a| moving.iter().map(move |b| (*a, *b)));
        let twins = pairs.filter(|(a, b)| a < b && all.condition(&[*a, *b]) > COLLINEAR);
        twins.map(|(a, b)| (self.terms[a], self.terms[b])).collect()
    }
}

impl Block {
    fn new(mut x: DMatrix<f64>, mut y: DVector<f64>, zero: Zero) -> Self {
        let free = match zero {
            Zero::Cycle => Some((x.row_mean(), y.mean())),
            Zero::Start => Some((x.row(0).into_owned(), y[0])),
            Zero::Common => None,
        };
        if let Some((x_zero, y_zero)) = free {
            x.row_iter_mut().for_each(|mut row| row -= &x_zero);
            y.add_scalar_mut(-y_zero);
        }
        Self { gram: x.tr_mul(&x), right: x.tr_mul(&y), sums: x.row_sum_tr(), x, y }
    }

    fn predict(&self, fit: &Fit) -> Vec<f64> {
        let row = |i: usize| {
            let terms = fit.subset.iter().enumerate();
            let of = |(k, j): (usize, &usize)| fit.mm_per_k[k] * (self.x[(i, *j)] - fit.x_mean[k]);
            fit.y_mean + terms.map(of).sum::<f64>()
        };
        (0..self.x.nrows()).map(row).collect()
    }

    fn rows(&self, columns: &[usize], mean: &DVector<f64>) -> Vec<DVector<f64>> {
        let row = |i: usize| {
            let values = columns.iter().enumerate().map(|(k, j)| self.x[(i, *j)] - mean[k]);
            DVector::from_iterator(columns.len(), values)
        };
        (0..self.x.nrows()).map(row).collect()
    }
}

/// A log that is not among the cycles, with the columns of their design.
pub struct Sample(Block);

impl Sample {
    /// The rows of some columns, less `mean`, K.
    pub fn rows(&self, columns: &[usize], mean: &DVector<f64>) -> Vec<DVector<f64>> {
        self.0.rows(columns, mean)
    }

    /// What was measured, less its zero, mm.
    pub fn measured(&self) -> Vec<f64> {
        self.0.y.as_slice().to_vec()
    }

    /// What a fit predicts, in the same zero, mm.
    pub fn predict(&self, fit: &Fit) -> Vec<f64> {
        self.0.predict(fit)
    }
}

fn column(cycle: &super::Cycle, term: &Term) -> Vec<f64> {
    let celsius = &cycle.temperatures_celsius[term.sensor];
    match (term.lag_s, &cycle.times_s) {
        (Some(tau_s), Some(times_s)) => lagged(times_s, celsius, tau_s),
        _ => celsius.clone(),
    }
}

impl Training {
    /// The columns that move at all.
    pub fn moving(&self) -> Vec<usize> {
        (0..self.lengths.len()).filter(|j| self.lengths[*j].is_finite()).collect()
    }

    /// The Gram matrix of some columns, each scaled to length 1, and the lengths.
    pub fn scaled(&self, subset: &[usize]) -> (DMatrix<f64>, DVector<f64>) {
        let lengths = subset.iter().map(|j| self.lengths[*j]);
        let lengths = DVector::from_iterator(subset.len(), lengths);
        let scaled = DMatrix::from_fn(subset.len(), subset.len(), |i, k| {
            self.gram[(subset[i], subset[k])] / (lengths[i] * lengths[k])
        });
        (scaled, lengths)
    }

    /// Condition number of the columns at equal length: the largest by the smallest singular value.
    pub fn condition(&self, subset: &[usize]) -> f64 {
        let (scaled, _) = self.scaled(subset);
        if subset.is_empty() { 1.0 } else { condition(scaled.symmetric_eigenvalues().as_slice()) }
    }

    /// Least squares on some columns; directions that are not observable get the shortest solution.
    pub fn fit(&self, subset: &[usize]) -> Fit {
        if subset.is_empty() {
            return self.fit_of(subset, DMatrix::zeros(0, 0), 1.0);
        }
        let (scaled, lengths) = self.scaled(subset);
        let eigen = SymmetricEigen::new(scaled);
        let largest = eigen.eigenvalues.iter().fold(0.0_f64, |m, v| m.max(*v));
        let mut inverse = DMatrix::zeros(subset.len(), subset.len());
        for (value, vector) in eigen.eigenvalues.iter().zip(eigen.eigenvectors.column_iter()) {
            if *value > NOTHING * largest {
                inverse += vector * vector.transpose() / *value;
            }
        }
        for i in 0..subset.len() {
            for k in 0..subset.len() {
                inverse[(i, k)] /= lengths[i] * lengths[k];
            }
        }
        self.fit_of(subset, inverse, condition(eigen.eigenvalues.as_slice()))
    }

    fn fit_of(&self, subset: &[usize], inverse: DMatrix<f64>, condition: f64) -> Fit {
        let pick =
            |v: &DVector<f64>| DVector::from_iterator(subset.len(), subset.iter().map(|j| v[*j]));
        Fit {
            mm_per_k: &inverse * pick(&self.right),
            condition,
            subset: subset.to_vec(),
            inverse,
            zero_share: if self.one_zero { 1.0 / self.rows } else { 0.0 },
            x_mean: pick(&self.x_mean),
            y_mean: self.y_mean,
        }
    }
}

fn condition(eigenvalues: &[f64]) -> f64 {
    let (low, high) = eigenvalues
        .iter()
        .fold((f64::INFINITY, 0.0_f64), |(low, high), v| (low.min(*v), high.max(*v)));
    match high {
        0.0 => 1.0,
        _ if low <= NOTHING * high => f64::INFINITY,
        _ => (high / low).sqrt(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_lag_of_a_ramp_is_the_ramp_a_time_constant_later() {
        // T = t: L = t − τ + τ e^(−t/τ), whatever the steps.
        let times = [0.0, 1.0, 3.0, 3.0, 10.0];
        for (t, l) in times.iter().zip(lagged(&times, &times, 2.0)) {
            assert!((l - (t - 2.0 + 2.0 * (-t / 2.0_f64).exp())).abs() < 1e-12);
        }
    }

    #[test]
    fn equal_columns_have_no_condition_and_upright_ones_one() {
        assert_eq!(condition(&[2.0, 0.0]), f64::INFINITY);
        assert_eq!(condition(&[1.0, 1.0]), 1.0);
    }
}
