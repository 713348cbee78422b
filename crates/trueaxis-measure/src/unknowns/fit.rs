//! Weighted least squares on the full nonlinear machine.
//!
//! ```text
//!     min Σ w ((y − f(x))/u)² + Σ ((x − x₀)/u₀)² + (x − x₀)ᵀ Λ (x − x₀)     docs/model.md eq. 108, 201
//!     x ← x + (JᵀWJ)⁺ JᵀW (y − f(x))         J of the nominal machine: the chord method
//! ```
//!
//! J is that of the nominal machine in every pass: errors of 100 µrad change it by 1e-4, so each
//! pass gains four digits, and what is not separable stays exactly so (the rank is a property
//! of the plan, not of the noise).

use super::design::Design;
use super::determined::all_before;
use super::groups::Groups;
use super::known::Known;
use crate::instruments::{Instrument, Readings};
use nalgebra::{DMatrix, DMatrixView, DVector, SymmetricEigen};
use rayon::prelude::*;
use std::ops::Range;
use trueaxis_machine::chain::CommandFault;

/// A combination that is seen less than a millionth as well as the best one is not seen: the
/// singular values of J with columns scaled to 1, relative to the greatest.
pub const LEAST_SINGULAR_VALUE: f64 = 1e-6;
/// A column of J that is so much shorter than the longest is rounding: no reading depends on it.
const SHORTEST_COLUMN: f64 = 1e-11;
/// Steps below this share of a standard uncertainty change nothing.
const SMALLEST_STEP: f64 = 1e-9;
/// Steps below this share that do not shrink any more are rounding.
const ROUNDING_STEP: f64 = 1e-4;
/// More passes than this do not help.
const MOST_PASSES: usize = 60;
/// Rows that one thread takes at a time: fixed, so that sums do not depend on the machine.
const CHUNK: usize = 512;
/// From so many rows on JᵀWJ is summed from groups of rows. Fewer are summed row by row, as the candidates of a plan are: a plan,
/// and the fit of what was measured by it, then agree also on combinations that are hardly seen, which hang on last digits.
const MANY: usize = 4096;
/// Chunks whose squares are kept until they are summed, in order: so that a million rows do not keep a thousand matrices, and the
/// result does not depend on the threads.
const BATCH: usize = 64;

/// Why there is no answer.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum FitError {
    /// There is nothing to fit.
    #[error("there are no readings")]
    NoReadings,
    /// There is nothing to find.
    #[error("there are no unknowns")]
    NoUnknowns,
    /// A row stands where an error table of the machine says nothing.
    #[error("row {row}: {fault}")]
    Outside {
        /// The row, counted from 0.
        row: usize,
        /// Why.
        fault: CommandFault,
    },
    /// The readings are too far from what the machine could read.
    #[error("no fit after {passes} passes: the readings do not belong to this machine and set-up")]
    NotConverged {
        /// How many.
        passes: usize,
    },
}

/// What was found.
#[derive(Debug, Clone)]
pub struct Fit {
    /// The unknowns; of a combination that cannot be seen the shortest solution. Unit: mm, rad or 1.
    pub values: Vec<f64>,
    /// Their covariance by the stated noise, over what can be seen.
    pub covariance: DMatrix<f64>,
    /// What the readings say about the unknowns.
    pub sight: Observability,
    /// Reading minus model; channels that do not exist are 0. Unit: mm or rad.
    pub residuals: Vec<[f64; 3]>,
    /// Σ w ((y − f)/u)², without priors. Unit: 1.
    pub chi_square: f64,
    /// Numbers read less unknowns found.
    pub degrees_of_freedom: usize,
    /// How many passes it took.
    pub passes: usize,
}

/// Which unknowns a set of readings determines.
#[derive(Debug, Clone)]
pub struct Observability {
    /// Singular values of J with columns scaled to 1, in units of the noise: of what is seen, then of the rest, each greatest first. Unit: 1.
    pub singular_values: Vec<f64>,
    /// How many of them are seen.
    pub rank: usize,
    /// Combinations that leave all readings as they are: one column each, in mm, rad or 1.
    pub null_space: DMatrix<f64>,
    /// Which unknowns are seen, alone and not only in a combination.
    pub is_seen: Vec<bool>,
    scale: DVector<f64>,
    vectors: DMatrix<f64>,
    inverse: DVector<f64>,
}

impl Observability {
    /// From the normal matrix JᵀWJ.
    pub fn of(normal: &DMatrix<f64>) -> Self {
        Self::with_threshold(normal, LEAST_SINGULAR_VALUE)
    }

    /// The same; singular values below this share of the greatest are not seen.
    pub fn with_threshold(normal: &DMatrix<f64>, threshold: f64) -> Self {
        Self::within(normal, threshold, &DVector::from_element(normal.nrows(), f64::INFINITY))
    }

    /// The same of unknowns that are not larger than `before` (docs/model.md eq. 347): what is known of a combination by
    /// the readings alone only to more than that is not seen. Rounded poses see a little of every error, and a fit that
    /// looked for radians in it would spoil, by products of errors, what the readings see well.
    pub fn within(normal: &DMatrix<f64>, threshold: f64, before: &DVector<f64>) -> Self {
        let n = normal.nrows();
        let length = normal.diagonal().map(|d| d.max(0.0).sqrt());
        // A column of rounding errors must not be scaled to 1.
        let least = SHORTEST_COLUMN * length.max();
        let is_read = |k: usize| length[k] > least && length[k] * before[k] > 1.0;
        let scale = DVector::from_fn(n, |k, _| if is_read(k) { length[k] } else { 1.0 });
        let scaled = DMatrix::from_fn(n, n, |i, j| match is_read(i) && is_read(j) {
            true => normal[(i, j)] / (scale[i] * scale[j]),
            false => 0.0,
        });
        let eigen = SymmetricEigen::new(scaled);
        let singular = |k: usize| eigen.eigenvalues[k].max(0.0).sqrt();
        let least = threshold * (0..n).map(singular).fold(0.0, f64::max);
        let is_seen = |k: usize| {
            let standard = eigen.eigenvectors.column(k).component_div(&scale) / singular(k);
            singular(k) > least && standard.iter().zip(before).all(|(u, b)| u.abs() <= *b)
        };
        let mut order: Vec<usize> = (0..n).collect();
        order.sort_by(|a, b| eigen.eigenvalues[*b].total_cmp(&eigen.eigenvalues[*a]));
        // Those that are seen come first.
        order.sort_by_key(|k| !is_seen(*k));
        let singular_values: Vec<f64> = order.iter().map(|k| singular(*k)).collect();
        let rank = order.iter().filter(|k| is_seen(**k)).count();
        let vectors = DMatrix::from_fn(n, n, |i, k| eigen.eigenvectors[(i, order[k])]);
        let null = vectors.columns(rank, n - rank).into_owned();
        let is_seen = (0..n).map(|i| null.row(i).norm() < 1e-5).collect();
        let null_space = DMatrix::from_fn(n, n - rank, |i, k| null[(i, k)] / scale[i]);
        let inverse =
            DVector::from_fn(n, |k, _| if k < rank { singular_values[k].powi(-2) } else { 0.0 });
        Self { singular_values, rank, null_space, is_seen, scale, vectors, inverse }
    }

    /// How much all readings together see of one unknown, in units of the noise per mm, rad or 1.
    pub fn column_length(&self, unknown: usize) -> f64 {
        self.scale[unknown]
    }

    /// The null space with every unknown in units of what is seen of it.
    pub fn scaled_null_space(&self) -> DMatrix<f64> {
        let n = self.vectors.nrows();
        self.vectors.columns(self.rank, n - self.rank).into_owned()
    }

    /// Directions that the readings see, with every unknown in units of what is seen of it: one column each.
    pub fn scaled_seen_space(&self) -> DMatrix<f64> {
        self.vectors.columns(0, self.rank).into_owned()
    }

    /// The part of these values that the readings see; the rest is 0.
    pub fn seen_part(&self, values: &[f64]) -> Vec<f64> {
        let scaled = DVector::from_column_slice(values).component_mul(&self.scale);
        let seen = self.vectors.columns(0, self.rank);
        let part = seen * seen.tr_mul(&scaled);
        part.component_div(&self.scale).as_slice().to_vec()
    }

    /// `(JᵀWJ)⁺ g` over what is seen.
    pub fn solve(&self, g: &DVector<f64>) -> DVector<f64> {
        let scaled = g.component_div(&self.scale);
        let along = self.vectors.tr_mul(&scaled).component_mul(&self.inverse);
        (&self.vectors * along).component_div(&self.scale)
    }

    /// `(JᵀWJ)⁺` over what is seen: the covariance of the unknowns.
    pub fn covariance(&self) -> DMatrix<f64> {
        let mut half = self.vectors.clone();
        for (k, mut column) in half.column_iter_mut().enumerate() {
            column *= self.inverse[k].sqrt();
        }
        for (i, mut row) in half.row_iter_mut().enumerate() {
            row /= self.scale[i];
        }
        &half * half.transpose()
    }

    /// The greatest over the smallest singular value that is seen.
    pub fn condition(&self) -> f64 {
        match (self.singular_values.first(), self.rank.checked_sub(1)) {
            (Some(greatest), Some(last)) => greatest / self.singular_values[last],
            _ => f64::INFINITY,
        }
    }
}

/// The readings by chunks.
struct Rows<'a> {
    design: &'a Design,
    readings: &'a Readings,
    weights: &'a [f64],
    prior: Known,
}

impl<'a> Rows<'a> {
    fn new(design: &'a Design, readings: &'a Readings, weights: &'a [f64]) -> Self {
        Self { design, readings, weights, prior: design.prior() }
    }

    fn instrument(&self, i: usize) -> &Instrument {
        &self.design.instruments[self.readings.instruments[i] as usize]
    }

    fn range(&self, chunk: usize) -> Range<usize> {
        chunk * CHUNK..((chunk + 1) * CHUNK).min(self.readings.len())
    }

    fn weight(&self, i: usize) -> f64 {
        self.weights.get(i).copied().unwrap_or(1.0)
    }

    /// JᵀWJ with the priors.
    fn normal(&self, groups: &Groups<'_>) -> DMatrix<f64> {
        let n = self.design.unknowns();
        let mut normal = DMatrix::zeros(n, n);
        let chunks: Vec<usize> = (0..self.readings.len().div_ceil(CHUNK)).collect();
        for batch in chunks.chunks(BATCH) {
            let part = |room: &mut Vec<f64>, chunk: &usize| self.squared(groups, *chunk, room);
            for part in batch.par_iter().map_init(Vec::new, part).collect::<Vec<_>>() {
                normal += part;
            }
        }
        normal + &self.prior.normal
    }

    /// What a chunk adds to JᵀWJ; `room` for Jᵀ/u.
    fn squared(&self, groups: &Groups<'_>, chunk: usize, room: &mut Vec<f64>) -> DMatrix<f64> {
        let (n, rows) = (self.design.unknowns(), self.range(chunk));
        match self.readings.len() < MANY {
            true => {
                room.clear();
                room.extend_from_slice(self.design.columns(self.readings, rows.clone()).as_slice());
            }
            false => groups.columns(rows.clone(), room),
        }
        if !self.weights.is_empty() {
            let mut columns = room.chunks_exact_mut(n.max(1));
            for i in rows {
                let root = self.weight(i).sqrt();
                for column in columns.by_ref().take(self.instrument(i).sight.channels()) {
                    column.iter_mut().for_each(|slope| *slope *= root);
                }
            }
        }
        let m = room.len() / n.max(1);
        let by_columns = DMatrixView::from_slice(room, n, m);
        // The same numbers by rows: no second matrix.
        by_columns * DMatrixView::from_slice_with_strides(room, m, n, n, 1)
    }

    /// Residuals at these values, and `JᵀW r`.
    fn pass(
        &self,
        groups: &Groups<'_>,
        values: &[f64],
        residuals: &mut [[f64; 3]],
    ) -> Result<DVector<f64>, FitError> {
        let part = |(chunk, residuals): (usize, &mut [[f64; 3]])| {
            let range = self.range(chunk);
            let first = range.start;
            let compared = |i: usize, read: [f64; 3]| {
                let (instrument, mut counts) = (self.instrument(i), [0.0; 3]);
                for c in 0..instrument.sight.channels() {
                    let residual = self.readings.values[i][c] - read[c];
                    residuals[i - first][c] = residual;
                    counts[c] = self.weight(i) * residual / instrument.noise[c].powi(2);
                }
                counts
            };
            groups.pass(range, values, compared)
        };
        let parts: Vec<_> = residuals.par_chunks_mut(CHUNK).enumerate().map(part).collect();
        let mut gradient = DVector::zeros(self.design.unknowns());
        for part in parts {
            let part = part.map_err(|(row, fault)| FitError::Outside { row, fault })?;
            gradient += DVector::from_vec(part);
        }
        gradient += &self.prior.gradient;
        gradient -= &self.prior.normal * DVector::from_column_slice(values);
        Ok(gradient)
    }

    fn fit(
        &self,
        sight: Observability,
        values: DVector<f64>,
        residuals: Vec<[f64; 3]>,
        passes: usize,
    ) -> Fit {
        let (chi_square, numbers) = self.chi_square(&residuals);
        Fit {
            values: values.as_slice().to_vec(),
            covariance: sight.covariance(),
            degrees_of_freedom: (numbers + Observability::of(&self.prior.normal).rank)
                .saturating_sub(sight.rank),
            sight,
            residuals,
            chi_square,
            passes,
        }
    }

    /// χ² of the readings, and how many numbers they are.
    fn chi_square(&self, residuals: &[[f64; 3]]) -> (f64, usize) {
        let (mut chi_square, mut numbers) = (0.0, 0);
        for (i, residual) in residuals.iter().enumerate() {
            let instrument = self.instrument(i);
            let channels = instrument.sight.channels();
            for (r, u) in residual.iter().zip(&instrument.noise).take(channels) {
                chi_square += self.weight(i) * (r / u).powi(2);
            }
            // Rows of weight 0 do not count.
            numbers += if self.weight(i) > 0.0 { channels } else { 0 };
        }
        (chi_square, numbers)
    }
}

/// JᵀWJ of these readings and the priors; `weights` of the readings, empty for 1.
pub fn normal_matrix(design: &Design, readings: &Readings, weights: &[f64]) -> DMatrix<f64> {
    Rows::new(design, readings, weights).normal(&Groups::new(design, readings))
}

/// What readings with this JᵀWJ say about the unknowns of a design.
pub fn sight_of(design: &Design, normal: &DMatrix<f64>, threshold: f64) -> Observability {
    Observability::within(normal, threshold, &all_before(design))
}

/// The unknowns from the readings; `weights` of the readings (robust losses), empty for 1.
///
/// # Errors
/// Nothing to fit or to find, a row outside the tables of the machine, no convergence.
pub fn fit(design: &Design, readings: &Readings, weights: &[f64]) -> Result<Fit, FitError> {
    let rule = Rule { threshold: LEAST_SINGULAR_VALUE, model: Model::Full };
    fit_by(rule, design, readings, weights)
}

/// How a fit goes about it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rule {
    /// Singular values below this share of the greatest are not seen. Unit: 1.
    pub threshold: f64,
    /// The machine itself, or what is linear of it.
    pub model: Model,
}

/// What readings are compared with.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Model {
    /// The whole machine: passes until nothing changes.
    #[default]
    Full,
    /// f(0) + J x: one pass. Off by the products of errors, 1e-4 of them at 100 µrad; more with
    /// set-ups that are far from what is stated (3 mm of a ball at 150 mm: 30 µm).
    Linear,
}

/// The same by another rule.
///
/// # Errors
/// As [`fit`].
pub fn fit_by(
    rule: Rule,
    design: &Design,
    readings: &Readings,
    weights: &[f64],
) -> Result<Fit, FitError> {
    if readings.is_empty() {
        return Err(FitError::NoReadings);
    }
    if design.unknowns() == 0 {
        return Err(FitError::NoUnknowns);
    }
    let (rows, groups) = (Rows::new(design, readings, weights), Groups::new(design, readings));
    let sight = sight_of(design, &rows.normal(&groups), rule.threshold);
    let mut values = DVector::zeros(design.unknowns());
    let mut residuals = vec![[0.0; 3]; readings.len()];
    let mut before = 0.0;
    for passes in 1..=MOST_PASSES {
        let gradient = rows.pass(&groups, values.as_slice(), &mut residuals)?;
        let step = sight.solve(&gradient);
        // In units of its own standard uncertainty.
        let length = step.dot(&gradient).abs().sqrt();
        values += &step;
        if !length.is_finite() {
            return Err(FitError::NotConverged { passes });
        }
        if rule.model == Model::Linear {
            let nominal = residuals;
            let residuals = linear_residuals(design, readings, &nominal, |_| &values);
            return Ok(rows.fit(sight, values, residuals, passes));
        }
        // Steps shrink by a constant factor; what is still to come follows from the last two.
        let rounding = length < ROUNDING_STEP && length > 0.5 * before;
        if rounding || length.min(length * length / before) < SMALLEST_STEP {
            return Ok(rows.fit(sight, values, residuals, passes));
        }
        before = length;
    }
    Err(FitError::NotConverged { passes: MOST_PASSES })
}

/// The residuals of linearised readings with these values.
pub fn linear_residuals<'v>(
    design: &Design,
    readings: &Readings,
    z: &[[f64; 3]],
    values: impl Fn(usize) -> &'v DVector<f64> + Sync,
) -> Vec<[f64; 3]> {
    by_rows(design, readings, |i, c, slopes| {
        z[i][c] - slopes.iter().zip(values(i).iter()).map(|(a, b)| a * b).sum::<f64>()
    })
}

/// A number per channel of each reading from its slopes: one per unknown, mm or rad per unit.
pub fn by_rows(
    design: &Design,
    readings: &Readings,
    number: impl Fn(usize, usize, &[f64]) -> f64 + Sync,
) -> Vec<[f64; 3]> {
    let mut out = vec![[0.0; 3]; readings.len()];
    let (n, groups) = (design.unknowns(), Groups::new(design, readings));
    out.par_chunks_mut(CHUNK).enumerate().for_each(|(chunk, rows)| {
        let first = chunk * CHUNK;
        groups.slopes(first..first + rows.len(), |i, slopes| {
            for (c, slopes) in slopes.chunks_exact(n.max(1)).enumerate() {
                rows[i - first][c] = number(i, c, slopes);
            }
        });
    });
    out
}
