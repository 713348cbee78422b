//! Nonlinear least squares for any residuals: Levenberg and Marquardt with scaled columns, by QR.
//!
//! Docs/model.md eq. 220 and 221. The normal equations are never formed; the result states whether it has converged,
//! the rank of its Jacobian, and the covariance of the values.
//!
//! ```
//! use nalgebra::DMatrix;
//! use trueaxis_form::least_squares::{Residuals, solve};
//! // y = a e^(b x) through (0, 2), (1, 4), (2, 8): a = 2, b = ln 2.
//! struct Growth;
//! impl Residuals for Growth {
//!     fn count(&self) -> usize { 3 }
//!     fn evaluate(&self, v: &[f64], residual: &mut [f64], jacobian: Option<&mut DMatrix<f64>>) {
//!         let mut jacobian = jacobian;
//!         for (i, (x, y)) in [(0.0, 2.0), (1.0, 4.0), (2.0, 8.0_f64)].into_iter().enumerate() {
//!             let e = (v[1] * x).exp();
//!             residual[i] = v[0] * e - y;
//!             if let Some(j) = jacobian.as_deref_mut() {
//!                 (j[(i, 0)], j[(i, 1)]) = (e, v[0] * x * e);
//!             }
//!         }
//!     }
//! }
//! let found = solve(&Growth, &[1.0, 1.0]).unwrap();
//! assert!(found.is_converged() && (found.values[1] - 2.0_f64.ln()).abs() < 1e-12);
//! ```

use nalgebra::{DMatrix, DVector};

/// Steps after which the search is given up.
const MOST_STEPS: usize = 5000;
/// Steps are as small as rounding allows, relative to the values.
const LEAST_STEP: f64 = 1e-14;
/// A singular value below this part of the largest one, of scaled columns, is zero.
const RANK: f64 = 1e-13;
/// The last step of a minimum that is found to rounding, relative to the values.
const SMALL_STEP: f64 = 1e-7;
/// A fall of the sum of squares by less than this part of it is hidden by rounding.
const HIDDEN: f64 = 1e-12;
/// Damping at which not even a tiny step downhill helps.
const MOST_DAMPING: f64 = 1e25;

/// What is to be made small.
pub trait Residuals {
    /// How many residuals there are.
    fn count(&self) -> usize;

    /// The size of a value below which its changes do not count; 0 where it counts to the last digit.
    /// Unit: that of the model.
    fn typical(&self, _value: usize) -> f64 {
        0.0
    }

    /// Residuals at these values, and their derivatives: one row for each residual. Where the model has no value,
    /// a residual that is not finite says so.
    fn evaluate(&self, values: &[f64], residual: &mut [f64], jacobian: Option<&mut DMatrix<f64>>);
}

/// How the search ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ending {
    /// The next step is below rounding of the values.
    SmallStep,
    /// The gradient is zero to rounding: no residual is correlated with a column of the Jacobian.
    NoGradient,
    /// No smaller sum of squares is found nearby, but the gradient is not zero to rounding.
    Stalled,
    /// The limit of steps.
    TooManySteps,
}

/// The smallest sum of squares that was found.
#[derive(Debug, Clone)]
pub struct Solution {
    /// The values. Unit: that of the model.
    pub values: Vec<f64>,
    /// The residuals there. Unit: that of the model.
    pub residual: Vec<f64>,
    /// Their sum of squares. Unit: that of the model, squared.
    pub sum_of_squares: f64,
    /// (JᵀJ)⁻¹, by which the variance of a residual is multiplied; zero for what the residuals do not determine.
    pub inverse: DMatrix<f64>,
    /// How many combinations of the values the residuals determine.
    pub rank: usize,
    /// How the search ended.
    pub ending: Ending,
    /// The largest cosine between the residuals and a column of the Jacobian. Unit: 1.
    pub gradient_cosine: f64,
    /// Steps that were tried.
    pub steps: usize,
}

impl Solution {
    /// Whether it is a minimum to rounding.
    pub fn is_converged(&self) -> bool {
        matches!(self.ending, Ending::SmallStep | Ending::NoGradient)
    }

    /// Residuals less determined combinations.
    pub fn degrees_of_freedom(&self) -> usize {
        self.residual.len().saturating_sub(self.rank)
    }

    /// The standard deviation of a residual, √(S/ν); 0 without degrees of freedom.
    pub fn residual_deviation(&self) -> f64 {
        match self.degrees_of_freedom() {
            0 => 0.0,
            // why: fewer than 2^52 residuals.
            n => (self.sum_of_squares / n as f64).sqrt(),
        }
    }

    /// Standard uncertainties of the values for this standard deviation of a residual.
    pub fn uncertainties(&self, deviation: f64) -> Vec<f64> {
        (0..self.values.len()).map(|i| deviation * self.inverse[(i, i)].max(0.0).sqrt()).collect()
    }
}

/// The values with the smallest sum of squares near the start; `None` if the start has no finite residuals, or there
/// are fewer residuals than values.
///
/// # Source
/// Levenberg 1944, Marquardt 1963; scaling of the columns: Moré 1978; damping by the gain: Nielsen 1999.
pub fn solve(problem: &impl Residuals, start: &[f64]) -> Option<Solution> {
    solve_by(problem, start, &MANNERS)
}

/// As [`solve`], from a start that is so near that whole steps lead there.
pub(crate) fn solve_near(problem: &impl Residuals, start: &[f64]) -> Option<Solution> {
    solve_by(problem, start, &[WHOLE_STEPS])
        .filter(Solution::is_converged)
        .or_else(|| solve(problem, start))
}

fn solve_by(problem: &impl Residuals, start: &[f64], manners: &[Manner]) -> Option<Solution> {
    if problem.count() < start.len() {
        return None;
    }
    let mut best: Option<Solution> = None;
    for manner in manners {
        let mut search = Search::new(problem, start, *manner)?;
        let ending = search.run();
        let found = search.solution(ending);
        let is_converged = found.is_converged();
        if best.as_ref().is_none_or(|b| is_converged || found.sum_of_squares < b.sum_of_squares) {
            best = Some(found);
        }
        if is_converged {
            break;
        }
    }
    best
}

/// How steps are damped.
#[derive(Clone, Copy)]
struct Manner {
    /// At the start.
    damping: f64,
    /// Whether the scale of a column is the largest one so far, or the present one.
    keeps_scale: bool,
}

/// Tried in turn until one converges: steps that are too long at a bad start end where the model is flat.
const MANNERS: [Manner; 4] = [
    Manner { damping: 1e-3, keeps_scale: true },
    Manner { damping: 1e-3, keeps_scale: false },
    Manner { damping: 10.0, keeps_scale: false },
    Manner { damping: 1e3, keeps_scale: true },
];

/// Gauss and Newton's method.
const WHOLE_STEPS: Manner = Manner { damping: 1e-30, keeps_scale: true };

struct Search<'a, P: Residuals> {
    problem: &'a P,
    values: Vec<f64>,
    residual: DVector<f64>,
    squares: f64,
    jacobian: DMatrix<f64>,
    scale: Vec<f64>,
    damping: f64,
    keeps_scale: bool,
    growth: f64,
    steps: usize,
}

/// Of one Jacobian: R and the first entries of Qᵀr.
struct Factors {
    r: DMatrix<f64>,
    qtr: DVector<f64>,
}

impl<'a, P: Residuals> Search<'a, P> {
    fn new(problem: &'a P, start: &[f64], manner: Manner) -> Option<Self> {
        let (n, p) = (problem.count(), start.len());
        let mut search = Self {
            problem,
            values: start.to_vec(),
            residual: DVector::zeros(n),
            squares: 0.0,
            jacobian: DMatrix::zeros(n, p),
            scale: vec![0.0; p],
            damping: manner.damping,
            keeps_scale: manner.keeps_scale,
            growth: 2.0,
            steps: 0,
        };
        search.differentiate();
        (search.squares.is_finite() && search.jacobian.iter().all(|v| v.is_finite()))
            .then_some(search)
    }

    fn differentiate(&mut self) {
        let residual = self.residual.as_mut_slice();
        self.problem.evaluate(&self.values, residual, Some(&mut self.jacobian));
        self.squares = self.residual.norm_squared();
        for (scale, column) in self.scale.iter_mut().zip(self.jacobian.column_iter()) {
            let norm = column.norm();
            *scale = if self.keeps_scale { scale.max(norm) } else { norm };
        }
    }

    fn factors(&self) -> Factors {
        let p = self.values.len();
        let qr = self.jacobian.clone().qr();
        let mut right =
            DMatrix::from_column_slice(self.residual.len(), 1, self.residual.as_slice());
        qr.q_tr_mul(&mut right);
        Factors { r: qr.r(), qtr: DVector::from_iterator(p, right.iter().take(p).copied()) }
    }

    /// The largest cosine between residuals and columns.
    fn cosine(&self) -> f64 {
        let size = self.residual.norm();
        let columns = self.jacobian.column_iter().filter(|c| c.norm() > 0.0);
        let cosines = columns.map(|c| (c.dot(&self.residual) / (c.norm() * size)).abs());
        if size > 0.0 { cosines.fold(0.0, f64::max) } else { 0.0 }
    }

    fn run(&mut self) -> Ending {
        loop {
            if self.cosine() < 1e-15 {
                return Ending::NoGradient;
            }
            let factors = self.factors();
            if factors.qtr.norm_squared() < HIDDEN * self.squares {
                return self.finish(factors);
            }
            loop {
                self.steps += 1;
                if self.steps > MOST_STEPS {
                    return Ending::TooManySteps;
                }
                if self.damping > MOST_DAMPING {
                    // The residuals are rounding: what remains of the way shows whether that is the minimum.
                    return self.finish(factors);
                }
                let step = damped_step(&factors, &self.scale, self.damping);
                if step.is_some_and(|step| self.try_step(&factors, &step)) {
                    break;
                }
                self.damping *= self.growth;
                self.growth = (2.0 * self.growth).min(1e6);
            }
        }
    }

    /// Steps without damping where the sum of squares no longer shows its fall: as long as they become smaller.
    fn finish(&mut self, mut factors: Factors) -> Ending {
        let mut best = (f64::INFINITY, self.values.clone());
        let mut worse = 0;
        while worse < 3 {
            let step = damped_step(&factors, &self.scale, 0.0);
            let Some(step) = step.filter(|_| self.squares.is_finite()) else { break };
            let size = self.relative(&step);
            worse += 1;
            if size < best.0 {
                best = (size, self.values.clone());
                worse = 0;
            }
            if size < LEAST_STEP {
                break;
            }
            self.values.iter_mut().zip(step.iter()).for_each(|(v, s)| *v += s);
            self.differentiate();
            self.steps += 1;
            factors = self.factors();
        }
        self.values = best.1;
        self.differentiate();
        if best.0 < SMALL_STEP { Ending::SmallStep } else { Ending::Stalled }
    }

    /// The step relative to the values, largest entry.
    fn relative(&self, step: &DVector<f64>) -> f64 {
        let least = |k: usize| self.problem.typical(k).max(f64::MIN_POSITIVE.sqrt());
        let parts = step.iter().zip(&self.values).enumerate();
        parts.map(|(k, (s, v))| s.abs() / v.abs().max(least(k))).fold(0.0, f64::max)
    }

    /// Goes there if the sum of squares falls.
    fn try_step(&mut self, factors: &Factors, step: &DVector<f64>) -> bool {
        let values: Vec<f64> = self.values.iter().zip(step.iter()).map(|(v, s)| v + s).collect();
        let mut residual = DVector::zeros(self.residual.len());
        self.problem.evaluate(&values, residual.as_mut_slice(), None);
        let squares = residual.norm_squared();
        let linear = &factors.r * step;
        let damped: f64 = step.iter().zip(&self.scale).map(|(s, d)| (s * d).powi(2)).sum();
        let predicted = linear.norm_squared() + 2.0 * self.damping * damped;
        let gain = (self.squares - squares) / predicted.max(f64::MIN_POSITIVE);
        if !squares.is_finite() || gain.is_nan() || gain < 1e-4 {
            return false;
        }
        self.values = values;
        self.differentiate();
        let factor = (1.0 - (2.0 * gain - 1.0).powi(3)).max(1.0 / 3.0);
        self.damping = (self.damping * factor).max(1e-30);
        self.growth = 2.0;
        true
    }

    fn solution(self, ending: Ending) -> Solution {
        let p = self.values.len();
        let norms: Vec<f64> = self.jacobian.column_iter().map(|c| c.norm()).collect();
        let mut scaled = self.factors().r;
        for (mut column, norm) in scaled.column_iter_mut().zip(&norms) {
            column /= norm.max(f64::MIN_POSITIVE);
        }
        let svd = scaled.svd(false, true);
        let largest = svd.singular_values.max();
        let kept: Vec<usize> =
            (0..p).filter(|k| svd.singular_values[*k] > RANK * largest).collect();
        let mut inverse = DMatrix::zeros(p, p);
        if let Some(vt) = &svd.v_t {
            for k in &kept {
                let row = vt.row(*k).transpose() / svd.singular_values[*k];
                inverse += &row * row.transpose();
            }
        }
        for i in 0..p {
            for j in 0..p {
                inverse[(i, j)] /=
                    norms[i].max(f64::MIN_POSITIVE) * norms[j].max(f64::MIN_POSITIVE);
            }
        }
        let (rank, gradient_cosine) = (kept.len(), self.cosine());
        let (sum_of_squares, steps) = (self.squares, self.steps);
        let residual = self.residual.as_slice().to_vec();
        Solution {
            values: self.values,
            residual,
            sum_of_squares,
            inverse,
            rank,
            ending,
            gradient_cosine,
            steps,
        }
    }
}

/// The step of the linear problem with √λ D below R.
fn damped_step(factors: &Factors, scale: &[f64], damping: f64) -> Option<DVector<f64>> {
    let p = scale.len();
    let mut matrix = DMatrix::zeros(2 * p, p);
    matrix.view_mut((0, 0), (p, p)).copy_from(&factors.r);
    for (i, s) in scale.iter().enumerate() {
        matrix[(p + i, i)] = damping.sqrt() * if *s > 0.0 { *s } else { 1.0 };
    }
    let mut right = DMatrix::zeros(2 * p, 1);
    right.view_mut((0, 0), (p, 1)).copy_from(&(-&factors.qtr));
    let qr = matrix.qr();
    qr.q_tr_mul(&mut right);
    let right = right.rows(0, p).column(0).into_owned();
    let step = qr.r().solve_upper_triangular(&right)?;
    step.iter().all(|v| v.is_finite()).then_some(step)
}
