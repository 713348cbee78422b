//! How large the errors are that are not listed: variance components by the evidence of the readings.
//!
//! ```text
//!     y = F β + G u + e,   u_g ~ N(0, t_g D_g²),   e ~ N(0, σ²)                       docs/model.md eq. 301
//!     S = GᵀG − GᵀF (FᵀF)⁻¹ FᵀG,   r = Gᵀy − GᵀF (FᵀF)⁻¹ Fᵀy,   s = yᵀy − yᵀF (FᵀF)⁻¹ Fᵀy      eq. 302
//!     −2 ln L = (n − p) ln σ² + ln|1 + T S/σ²| + (s − rᵀ v)/σ²,   v = (S + σ² T⁻¹)⁻¹ r         eq. 303
//!     t_g ← Σ v²/γ_g,   γ_g = Σ (1 − C_jj/t_g),   C = (S/σ² + T⁻¹)⁻¹                           eq. 304
//! ```
//!
//! L is the likelihood of what the listed unknowns cannot explain (restricted likelihood: Patterson and Thompson
//! 1971); the steps of eq. 304 are those of MacKay 1992, section 4. F are the listed unknowns, G the others with their usual size.

use nalgebra::{DMatrix, DVector};

/// A share of the usual size below which a group is nothing.
const NOTHING: f64 = 1e-3;
/// And the largest multiple: 1 mm and 1 mrad. Larger errors are not small, and the equations are linear in them.
const LARGEST: f64 = 100.0;
/// Steps; each gains a digit or more.
const STEPS: usize = 60;
/// Steps that change no size by more than this share end it.
const SETTLED: f64 = 1e-3;

/// Sums of readings that are linear about a solution, in units of their noise.
#[derive(Debug, Clone, Copy)]
pub struct Sums<'a> {
    /// JᵀJ of the listed unknowns first, then of the others.
    pub normal: &'a DMatrix<f64>,
    /// Jᵀy.
    pub gradient: &'a DVector<f64>,
    /// yᵀy. Unit: 1.
    pub square: f64,
    /// How many numbers were read.
    pub numbers: usize,
    /// How many unknowns are listed.
    pub listed: usize,
}

/// What the listed unknowns leave.
#[derive(Debug, Clone)]
pub struct Rest {
    /// S in units of the usual sizes.
    s: DMatrix<f64>,
    r: DVector<f64>,
    /// The squares that the listed unknowns leave. Unit: 1.
    pub square: f64,
    /// n − p. Unit: 1.
    pub freedom: f64,
}

/// What was found of the sizes.
#[derive(Debug, Clone, PartialEq)]
pub struct Sizes {
    /// How many times its usual size each group is. Unit: 1.
    pub times: Vec<f64>,
    /// The noise in units of that which is stated. Unit: 1.
    pub noise: f64,
    /// −2 ln L. Unit: 1.
    pub deviance: f64,
    /// How many numbers the groups explain. Unit: 1.
    pub effective: f64,
}

impl Sizes {
    /// Nothing of so many groups, and the noise that is stated.
    pub fn none(groups: usize) -> Self {
        Self { times: vec![0.0; groups], noise: 1.0, deviance: 0.0, effective: 0.0 }
    }
}

impl Rest {
    /// Takes the listed unknowns out; `before` is what is not known of each before, `sizes` those of the others.
    ///
    /// `None` if the sums are not finite.
    pub fn of(sums: Sums<'_>, before: &DVector<f64>, sizes: &[f64]) -> Option<Self> {
        let (p, q) = (sums.listed, sizes.len());
        let l = before.rows(0, p).into_owned();
        let mut f = sums.normal.view((0, 0), (p, p)).into_owned();
        let mut cross = sums.normal.view((0, p), (p, q)).into_owned();
        let mut own = sums.normal.view((p, p), (q, q)).into_owned();
        scale(&mut f, l.as_slice(), l.as_slice());
        scale(&mut cross, l.as_slice(), sizes);
        scale(&mut own, sizes, sizes);
        let seen = f.diagonal().sum();
        for k in 0..p {
            f[(k, k)] += 1.0;
        }
        let half = f.cholesky()?;
        let g = DVector::from_fn(p, |k, _| sums.gradient[k] * l[k]);
        let solved = half.solve(&cross);
        let by_g = half.solve(&g);
        let r = DVector::from_fn(q, |j, _| sums.gradient[p + j] * sizes[j]) - cross.tr_mul(&by_g);
        let s = own - cross.tr_mul(&solved);
        let used = p as f64 - half.inverse().diagonal().sum();
        let finite = seen.is_finite() && s.iter().all(|v| v.is_finite());
        finite.then(|| Self {
            s: (&s + s.transpose()) * 0.5,
            r,
            square: (sums.square - g.dot(&by_g)).max(0.0),
            freedom: (sums.numbers as f64 - used).max(0.0),
        })
    }

    /// The sizes of all groups, where the noise is as stated or larger.
    pub fn sizes(&self, groups: &[std::ops::Range<usize>], noise_is_free: bool) -> Sizes {
        let mut t: Vec<f64> = vec![1.0; groups.len()];
        let mut noise = 1.0_f64;
        for _ in 0..STEPS {
            let Some(state) = self.state(groups, &t, noise) else { break };
            let mut change = 0.0_f64;
            for (g, t) in t.iter_mut().enumerate().filter(|(_, t)| **t > 0.0) {
                let next = state.squares[g] / state.explained[g].max(1e-12);
                let next = if next < NOTHING * NOTHING { 0.0 } else { next.min(LARGEST * LARGEST) };
                change = change.max((next - *t).abs() / t.max(next));
                *t = next;
            }
            if noise_is_free {
                let free = self.freedom - state.explained.iter().sum::<f64>();
                let next = (state.residual / free.max(1.0)).sqrt().max(1.0);
                change = change.max((next - noise).abs());
                noise = next;
            }
            if change < SETTLED {
                break;
            }
        }
        let state = self.state(groups, &t, noise);
        let (deviance, effective) =
            state.map_or((f64::INFINITY, 0.0), |s| (s.deviance, s.explained.iter().sum()));
        Sizes { times: t.into_iter().map(f64::sqrt).collect(), noise, deviance, effective }
    }

    /// −2 ln L of these sizes. Unit: 1.
    pub fn deviance(&self, groups: &[std::ops::Range<usize>], times: &[f64], noise: f64) -> f64 {
        let t: Vec<f64> = times.iter().map(|t| t * t).collect();
        self.state(groups, &t, noise).map_or(f64::INFINITY, |s| s.deviance)
    }

    fn state(&self, groups: &[std::ops::Range<usize>], t: &[f64], noise: f64) -> Option<State> {
        let variance = noise * noise;
        let of = |g: usize| groups[g].clone().map(move |j| (j, g));
        let members: Vec<(usize, usize)> =
            (0..groups.len()).filter(|g| t[*g] > 0.0).flat_map(of).collect();
        let m = members.len();
        let matrix = DMatrix::from_fn(m, m, |a, b| {
            let (i, g) = members[a];
            let own = if a == b { 1.0 / t[g] } else { 0.0 };
            self.s[(i, members[b].0)] / variance + own
        });
        let r = DVector::from_fn(m, |a, _| self.r[members[a].0]);
        let half = matrix.cholesky()?;
        let v = half.solve(&r) / variance;
        let mut state = State {
            squares: vec![0.0; groups.len()],
            explained: vec![0.0; groups.len()],
            residual: 0.0,
            deviance: self.freedom * variance.ln() + (self.square - r.dot(&v)) / variance,
        };
        // Of the inverse only the diagonal is needed: the squares of the columns of L⁻¹.
        let lower = half.l().solve_lower_triangular(&DMatrix::identity(m, m))?;
        let mut penalty = 0.0;
        for (a, (_, g)) in members.iter().enumerate() {
            state.squares[*g] += v[a] * v[a];
            let own = lower.column(a).norm_squared();
            state.explained[*g] += 1.0 - own / t[*g];
            state.deviance += t[*g].ln() + 2.0 * half.l_dirty()[(a, a)].ln();
            penalty += variance * v[a] * v[a] / t[*g];
        }
        state.residual = (self.square - r.dot(&v) - penalty).max(0.0);
        Some(state)
    }
}

/// The groups at some sizes.
struct State {
    squares: Vec<f64>,
    explained: Vec<f64>,
    residual: f64,
    deviance: f64,
}

fn scale(matrix: &mut DMatrix<f64>, rows: &[f64], columns: &[f64]) {
    for (j, mut column) in matrix.column_iter_mut().enumerate() {
        for (value, row) in column.iter_mut().zip(rows) {
            *value *= row * columns[j];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_size_of_one_group_in_balanced_readings() {
        // Three groups of two readings about a known mean: 4 4, −4 −4, 0 0, noise 1. Analysis of variance:
        // E[(sum of squares of the means)/3] = t + 1/2, so t = 32/3 − 1/2.
        let y = [4.0, 4.0, -4.0, -4.0, 0.0, 0.0];
        let g = DMatrix::from_fn(6, 3, |i, j| if i / 2 == j { 1.0 } else { 0.0 });
        let y = DVector::from_column_slice(&y);
        let (normal, gradient) = (g.tr_mul(&g), g.tr_mul(&y));
        let sums = Sums {
            normal: &normal,
            gradient: &gradient,
            square: y.norm_squared(),
            numbers: 6,
            listed: 0,
        };
        let rest = Rest::of(sums, &DVector::zeros(0), &[1.0; 3]).expect("finite");
        let group = 0..3;
        let all = std::slice::from_ref(&group);
        let sizes = rest.sizes(all, false);
        assert!((sizes.times[0].powi(2) - (32.0 / 3.0 - 0.5)).abs() < 0.02, "{sizes:?}");
        // −2 ln L there is less than without the group.
        assert!(sizes.deviance < rest.deviance(all, &[0.0], 1.0));
    }
}
