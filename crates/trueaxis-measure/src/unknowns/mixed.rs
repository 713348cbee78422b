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
use std::ops::Range;

/// A share of the usual size below which a group is nothing.
const NOTHING: f64 = 1e-3;
/// And the largest multiple: 1 mm and 1 mrad. Larger errors are not small, and the equations are linear in them.
const LARGEST: f64 = 100.0;
/// Steps; each gains a digit or more.
const STEPS: usize = 60;
/// Steps that change no size by more than this share end it.
const SETTLED: f64 = 1e-3;

/// A direction with less than this part of the largest square is rounding.
const NO_SQUARE: f64 = 1e-10;

/// More degrees of freedom than this make no difference.
const MANY: f64 = 1e6;
/// Less information on the logarithm of a size is none.
const NO_INFORMATION: f64 = 1e-9;

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
    pub fn sizes(&self, groups: &[Range<usize>], noise_is_free: bool) -> Sizes {
        let mut t: Vec<f64> = vec![1.0; groups.len()];
        let mut noise = 1.0_f64;
        let factor = Factor::of(self, groups);
        for _ in 0..STEPS {
            let Some(state) = factor.state(&t, noise) else { break };
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
        let state = factor.state(&t, noise);
        let (deviance, effective) =
            state.map_or((f64::INFINITY, 0.0), |s| (s.deviance, s.explained.iter().sum()));
        Sizes { times: t.into_iter().map(f64::sqrt).collect(), noise, deviance, effective }
    }

    /// −2 ln L of these sizes. Unit: 1.
    pub fn deviance(&self, groups: &[Range<usize>], times: &[f64], noise: f64) -> f64 {
        let t: Vec<f64> = times.iter().map(|t| t * t).collect();
        Factor::of(self, groups).state(&t, noise).map_or(f64::INFINITY, |s| s.deviance)
    }

    /// How well the sizes are known: the covariance of ln t of every group, then of ln σ² where the noise was found,
    /// too. What is 0, or as stated, counts as known.
    ///
    /// ```text
    ///     K = 1 − T^−½ C T^−½     I_gh = ½ |K_gh|²     I_gσ = ½ (tr K_gg − |K_g|²)
    ///     I_σσ = ½ (n − p − 2 tr K + |K|²)             covariance = I⁻¹                   docs/model.md eq. 311
    /// ```
    ///
    /// `None` if the sums are not finite.
    pub fn covariance_of_sizes(
        &self,
        groups: &[Range<usize>],
        sizes: &Sizes,
    ) -> Option<DMatrix<f64>> {
        let noise_is_free = sizes.noise > 1.0;
        let of = |g: usize| groups[g].clone().map(move |j| (j, g));
        let members: Vec<(usize, usize)> =
            (0..groups.len()).filter(|g| sizes.times[*g] > 0.0).flat_map(of).collect();
        let m = members.len();
        let root = |a: usize| sizes.times[members[a].1] / sizes.noise;
        // 1 + T^½ S T^½/σ², whose inverse is T^−½ C T^−½.
        let matrix = DMatrix::from_fn(m, m, |a, b| {
            let own = if a == b { 1.0 } else { 0.0 };
            self.s[(members[a].0, members[b].0)] * root(a) * root(b) + own
        });
        let k = DMatrix::identity(m, m) - matrix.cholesky()?.inverse();
        let sigma = groups.len();
        let mut information = DMatrix::<f64>::zeros(sigma + 1, sigma + 1);
        for (a, (_, g)) in members.iter().enumerate() {
            for (b, (_, h)) in members.iter().enumerate() {
                information[(*g, *h)] += 0.5 * k[(a, b)].powi(2);
            }
            let with_noise = 0.5 * (k[(a, a)] - k.row(a).norm_squared());
            information[(*g, sigma)] += with_noise;
            information[(sigma, *g)] += with_noise;
        }
        let own = self.freedom - 2.0 * k.trace() + k.norm_squared();
        information[(sigma, sigma)] = 0.5 * own.max(1.0);
        let is_free = |i: &usize| match *i == sigma {
            true => noise_is_free,
            false => sizes.times[*i] > 0.0,
        };
        let free: Vec<usize> = (0..=sigma).filter(is_free).collect();
        let mut of_free = information.select_rows(&free).select_columns(&free);
        // A size of which the readings say nothing is not known at all.
        (0..free.len()).for_each(|i| of_free[(i, i)] += NO_INFORMATION);
        let inverse = of_free.cholesky()?.inverse();
        let mut covariance = DMatrix::zeros(sigma + 1, sigma + 1);
        for (a, i) in free.iter().enumerate() {
            for (b, j) in free.iter().enumerate() {
                covariance[(*i, *j)] = inverse[(a, b)];
            }
        }
        Some(covariance)
    }
}

/// S of some groups as W Wᵀ, with as many columns as it has rank: readings are often fewer than what may explain them.
///
/// ```text
///     A = σ² + WᵀTW      v = T W A⁻¹ z      r = W z      ln|1 + T S/σ²| = ln|A| − k ln σ²
///     Σ (1 − C_jj/t_g) = t_g tr(M_g A⁻¹)      M_g = W_gᵀ W_g      Σ v² = t_g² uᵀ M_g u, u = A⁻¹ z
/// ```
///
/// by the identity of Woodbury; docs/model.md eq. 303, 304.
struct Factor<'a> {
    rest: &'a Rest,
    /// M of every group.
    squares: Vec<DMatrix<f64>>,
    z: DVector<f64>,
}

impl<'a> Factor<'a> {
    fn of(rest: &'a Rest, groups: &[Range<usize>]) -> Self {
        let members: Vec<usize> = groups.iter().cloned().flatten().collect();
        let (w, pivots) = pivoted(&rest.s, &members);
        let k = pivots.len();
        let mut z = DVector::zeros(k);
        for (j, pivot) in pivots.iter().enumerate() {
            let before: f64 = (0..j).map(|i| w[(*pivot, i)] * z[i]).sum();
            z[j] = (rest.r[members[*pivot]] - before) / w[(*pivot, j)];
        }
        let mut begin = 0;
        let squares = groups.iter().map(|group| {
            let own = w.rows(begin, group.len());
            begin += group.len();
            own.transpose() * own
        });
        Self { rest, squares: squares.collect(), z }
    }

    fn state(&self, t: &[f64], noise: f64) -> Option<State> {
        let (variance, k) = (noise * noise, self.z.len());
        let mut a = DMatrix::identity(k, k) * variance;
        for (m, t) in self.squares.iter().zip(t).filter(|(_, t)| **t > 0.0) {
            a.zip_apply(m, |a, m| *a += t * m);
        }
        let lower = a.cholesky()?.unpack();
        let below = inverse_of_lower(&lower);
        let u = below.tr_mul(&(&below * &self.z));
        // A product of two matrices is blocked, `tr_mul` is not.
        let inverse = below.transpose() * &below;
        let explained_square = self.z.dot(&self.z) - variance * self.z.dot(&u);
        let ln_a = 2.0 * (0..k).map(|i| lower[(i, i)].ln()).sum::<f64>();
        let mut state = State {
            squares: vec![0.0; t.len()],
            explained: vec![0.0; t.len()],
            residual: 0.0,
            deviance: self.rest.freedom * variance.ln()
                + (self.rest.square - explained_square) / variance
                + ln_a
                - k as f64 * variance.ln(),
        };
        let mut penalty = 0.0;
        for (g, m) in self.squares.iter().enumerate().filter(|(g, _)| t[*g] > 0.0) {
            state.squares[g] = t[g] * t[g] * u.dot(&(m * &u));
            state.explained[g] = t[g] * m.dot(&inverse);
            penalty += variance * state.squares[g] / t[g];
        }
        state.residual = (self.rest.square - explained_square - penalty).max(0.0);
        Some(state)
    }
}

/// W with W Wᵀ = S of these members, and the row of each pivot: Cholesky with the largest remaining diagonal first.
fn pivoted(s: &DMatrix<f64>, members: &[usize]) -> (DMatrix<f64>, Vec<usize>) {
    let m = members.len();
    let mut remaining: Vec<f64> = members.iter().map(|j| s[(*j, *j)]).collect();
    let least = NO_SQUARE * remaining.iter().copied().fold(0.0, f64::max);
    let (mut columns, mut pivots): (Vec<DVector<f64>>, Vec<usize>) = (Vec::new(), Vec::new());
    while pivots.len() < m {
        let largest = (0..m).max_by(|a, b| remaining[*a].total_cmp(&remaining[*b]));
        let Some(pivot) = largest.filter(|i| remaining[*i] > least) else { break };
        let root = remaining[pivot].sqrt();
        let mut column = DVector::from_fn(m, |i, _| s[(members[i], members[pivot])]);
        for before in &columns {
            column.axpy(-before[pivot], before, 1.0);
        }
        column /= root;
        // Rounding must not bring back what was taken out.
        pivots.iter().for_each(|p| column[*p] = 0.0);
        remaining.iter_mut().zip(column.iter()).for_each(|(d, c)| *d -= c * c);
        remaining[pivot] = f64::NEG_INFINITY;
        columns.push(column);
        pivots.push(pivot);
    }
    let w = DMatrix::from_fn(m, columns.len(), |i, j| columns[j][i]);
    (w, pivots)
}

/// The inverse of a lower triangle: half of it is zero from the start, which a general solver would not know.
fn inverse_of_lower(lower: &DMatrix<f64>) -> DMatrix<f64> {
    let k = lower.nrows();
    let mut inverse = DMatrix::zeros(k, k);
    for j in 0..k {
        inverse[(j, j)] = 1.0;
        for i in j..k {
            let value = inverse[(i, j)] / lower[(i, i)];
            inverse[(i, j)] = value;
            let below = lower.view((i + 1, i), (k - i - 1, 1));
            let mut rest = inverse.view_mut((i + 1, j), (k - i - 1, 1));
            rest.zip_apply(&below, |r, l| *r -= value * l);
        }
    }
    inverse
}

/// What a covariance follows from: the unknowns, the listed ones first, then the groups.
#[derive(Debug, Clone, Copy)]
pub struct Solved<'a> {
    /// (N + Λ)⁻¹ in units of the noise.
    pub inverse: &'a DMatrix<f64>,
    /// Λ^−½: what is not known of each before. Unit: that of the unknown over that of the noise.
    pub scale: &'a [f64],
    /// The part of N that was known before and not read.
    pub before: &'a DMatrix<f64>,
    /// How many unknowns are listed.
    pub listed: usize,
}

/// ν of the uncertainty of each listed unknown: how well the sizes are known on which it rests; `None`: infinitely many.
///
/// ```text
///     w_g = Σ_{j∈g} C_kj²/(t_g D_j²) / C_kk      w_σ = 1 − Σ w_g − the share of what was known before
///     ν = 2/(wᵀ A w)      A: the covariance of ln t_g and ln σ² (eq. 311)                  docs/model.md eq. 312
/// ```
///
/// w are the derivatives of ln u² after ln t_g and ln σ²; 2/ν is the relative variance of u² (Satterthwaite 1946; for
/// variance components Giesbrecht and Burns 1985, Kuznetsova et al. 2017).
pub fn degrees_of_freedom(
    solved: Solved<'_>,
    groups: &[Range<usize>],
    of_sizes: &DMatrix<f64>,
) -> Vec<Option<f64>> {
    let Solved { inverse, scale, before, listed } = solved;
    let share = |k: usize, j: usize| match scale[j] > 0.0 {
        true => (inverse[(k, j)] / scale[j]).powi(2) / inverse[(k, k)],
        false => 0.0,
    };
    let of = |k: usize| {
        if inverse[(k, k)] <= 0.0 {
            return None;
        }
        let of_group = |g: &Range<usize>| g.clone().map(|j| share(k, listed + j)).sum::<f64>();
        let mut w: Vec<f64> = groups.iter().map(of_group).collect();
        let row = inverse.row(k);
        let known = (row * before * row.transpose())[(0, 0)] / inverse[(k, k)];
        let of_scale: f64 = (0..scale.len()).map(|j| share(k, j)).sum();
        w.push((1.0 - of_scale - known).max(0.0));
        let w = DVector::from_vec(w);
        let relative = w.dot(&(of_sizes * &w));
        (relative > 2.0 / MANY).then(|| 2.0 / relative)
    };
    (0..listed).map(of).collect()
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

    /// Eq. 303 and 304 as they stand, over all members.
    fn plain(rest: &Rest, groups: &[Range<usize>], t: &[f64], noise: f64) -> Option<State> {
        let variance = noise * noise;
        let of = |g: usize| groups[g].clone().map(move |j| (j, g));
        let members: Vec<(usize, usize)> =
            (0..groups.len()).filter(|g| t[*g] > 0.0).flat_map(of).collect();
        let m = members.len();
        let matrix = DMatrix::from_fn(m, m, |a, b| {
            let (i, g) = members[a];
            let own = if a == b { 1.0 / t[g] } else { 0.0 };
            rest.s[(i, members[b].0)] / variance + own
        });
        let r = DVector::from_fn(m, |a, _| rest.r[members[a].0]);
        let half = matrix.cholesky()?;
        let v = half.solve(&r) / variance;
        let mut state = State {
            squares: vec![0.0; groups.len()],
            explained: vec![0.0; groups.len()],
            residual: 0.0,
            deviance: rest.freedom * variance.ln() + (rest.square - r.dot(&v)) / variance,
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
        state.residual = (rest.square - r.dot(&v) - penalty).max(0.0);
        Some(state)
    }

    /// Members that are alike, more members than readings, groups of nothing, any noise.
    #[test]
    fn law_the_factor_gives_what_all_members_give() {
        let mut state = 1_u64;
        let mut random = || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
        };
        for (n, sizes) in
            [(8, vec![3, 4]), (12, vec![10, 15, 5]), (40, vec![6, 6, 3]), (5, vec![1; 9])]
        {
            let q: usize = sizes.iter().sum();
            let mut g = DMatrix::from_fn(n, q, |_, _| 6.0 * random());
            let twin = g.column(0).into_owned();
            g.set_column(q - 1, &twin);
            let x = DMatrix::from_fn(n, 2, |i, k| if k == 0 { 1.0 } else { i as f64 });
            let mut all = DMatrix::zeros(n, 2 + q);
            all.columns_mut(0, 2).copy_from(&x);
            all.columns_mut(2, q).copy_from(&g);
            let y = DVector::from_fn(n, |_, _| 9.0 * random());
            let (normal, gradient) = (all.tr_mul(&all), all.tr_mul(&y));
            let square = y.norm_squared();
            let sums = Sums { normal: &normal, gradient: &gradient, square, numbers: n, listed: 2 };
            let rest =
                Rest::of(sums, &DVector::from_element(2, 1e3), &vec![1.0; q]).expect("finite");
            let mut begin = 0;
            let groups: Vec<Range<usize>> = sizes
                .iter()
                .map(|count| {
                    begin += count;
                    begin - count..begin
                })
                .collect();
            let factor = Factor::of(&rest, &groups);
            for (t, noise) in [(1.0, 1.0), (0.01, 1.7), (30.0, 0.6)] {
                let t: Vec<f64> = (0..sizes.len())
                    .map(|g| if g == 1 { 0.0 } else { t * (1.0 + g as f64) })
                    .collect();
                let (fast, slow) = (
                    factor.state(&t, noise).expect("some"),
                    plain(&rest, &groups, &t, noise).expect("some"),
                );
                let near = |a: f64, b: f64| (a - b).abs() < 1e-6 * (1.0 + b.abs());
                assert!(near(fast.deviance, slow.deviance), "{} {}", fast.deviance, slow.deviance);
                assert!(near(fast.residual, slow.residual), "{} {}", fast.residual, slow.residual);
                for g in 0..sizes.len() {
                    assert!(near(fast.squares[g], slow.squares[g]), "{n} {g} {}", fast.squares[g]);
                    assert!(near(fast.explained[g], slow.explained[g]), "{n} {g}");
                }
            }
        }
    }

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

    /// ν of the listed unknowns (columns of `x`) with groups of readings, and the sizes: these, or found from y.
    fn freedom(
        x: &[Vec<f64>],
        of: &[Vec<usize>],
        sizes: Result<(&[f64], f64), &[f64]>,
    ) -> (Vec<f64>, Sizes) {
        let (n, p) = (x[0].len(), x.len());
        let counts: Vec<usize> =
            of.iter().map(|g| g.iter().max().map_or(0, |most| most + 1)).collect();
        let starts: Vec<usize> = (0..of.len()).map(|g| counts[..g].iter().sum()).collect();
        let groups: Vec<Range<usize>> =
            (0..of.len()).map(|g| starts[g]..starts[g] + counts[g]).collect();
        let q: usize = counts.iter().sum();
        let mut all = DMatrix::zeros(n, p + q);
        for i in 0..n {
            x.iter().enumerate().for_each(|(k, column)| all[(i, k)] = column[i]);
            of.iter().zip(&starts).for_each(|(g, start)| all[(i, p + start + g[i])] = 1.0);
        }
        let y = DVector::from_column_slice(sizes.err().unwrap_or(&vec![0.0; n]));
        let (normal, gradient) = (all.tr_mul(&all), all.tr_mul(&y));
        let (square, weak) = (y.norm_squared(), DVector::from_element(p, 1e5));
        let sums = Sums { normal: &normal, gradient: &gradient, square, numbers: n, listed: p };
        let rest = Rest::of(sums, &weak, &vec![1.0; q]).expect("finite");
        let found = match sizes {
            Err(_) => rest.sizes(&groups, true),
            Ok((t, noise)) => Sizes {
                times: t.iter().map(|t| t.sqrt()).collect(),
                noise,
                ..Sizes::none(of.len())
            },
        };
        let mut scale = vec![1e5; p];
        let each = groups.iter().zip(&found.times);
        scale.extend(each.flat_map(|(g, t)| g.clone().map(move |_| t / found.noise)));
        let mut weighted = normal.clone();
        (0..p + q).for_each(|i| weighted[(i, i)] += scale[i].powi(-2));
        let inverse = weighted.try_inverse().expect("with a prior");
        let before = DMatrix::zeros(p + q, p + q);
        let solved = Solved { inverse: &inverse, scale: &scale, before: &before, listed: p };
        let of_sizes = rest.covariance_of_sizes(&groups, &found).expect("finite");
        let freedom = degrees_of_freedom(solved, &groups, &of_sizes);
        (freedom.into_iter().map(|v| v.expect("a finite number")).collect(), found)
    }

    #[test]
    fn law_the_mean_of_balanced_groups_has_their_number_less_one() {
        // Balanced one-way layout: u² of the mean is a mean square of a − 1 degrees of freedom (Searle, Casella,
        // McCulloch 1992, section 3.6), whether σ is known or not.
        for (groups, each, t, noise) in
            [(6, 4, 2.0, 1.0), (6, 4, 2.0, 1.7), (3, 2, 0.1, 1.3), (9, 5, 30.0, 1.0)]
        {
            let of = (0..groups * each).map(|i| i / each).collect();
            let (found, _) = freedom(&[vec![1.0; groups * each]], &[of], Ok((&[t], noise)));
            let expected = groups as f64 - 1.0;
            assert!((found[0] - expected).abs() < 1e-5, "{}, not {expected}", found[0]);
        }
    }

    /// Two crossed groups with unequal counts, by `oracles/freedom.py` with the dense covariance of the readings.
    #[test]
    fn oracle_degrees_of_freedom_of_crossed_groups() {
        let of = [
            vec![0, 0, 0, 1, 1, 2, 2, 2, 2, 3, 4, 4, 5, 5, 5],
            vec![0, 1, 2, 0, 1, 0, 1, 2, 3, 3, 0, 1, 2, 3, 3],
        ];
        let x = [vec![1.0; 15], (0..15).map(|i| 0.1 * f64::from(i) - 0.6).collect()];
        for (t, noise, expected) in [
            ([1.5, 0.7], 1.0, [4.868_760, 4.343_998]),
            ([1.5, 0.7], 1.5, [3.710_378, 3.982_919]),
            ([4.0, 0.2], 1.2, [4.200_886, 5.491_729]),
        ] {
            let (found, _) = freedom(&x, &of, Ok((&t, noise)));
            for (found, expected) in found.iter().zip(expected) {
                assert!((found - expected).abs() < 1e-5, "{found}, not {expected}");
            }
        }
        // The sizes that have the largest restricted likelihood; statsmodels finds them, too.
        let y = [4.9, 0.8, 4.7, 1.1, -1.3, 3.6, 1.2, 1.0, 1.4, -1.9, 7.2, 2.4, 0.9, 0.2, 3.3];
        let (found, sizes) = freedom(&x, &of, Err(&y));
        for (found, expected) in [
            (sizes.times[0].powi(2), 4.953_011),
            (sizes.times[1].powi(2), 2.007_687),
            (sizes.noise.powi(2), 1.820_568),
            (found[0], 5.358_315),
            (found[1], 4.701_080),
        ] {
            assert!((found / expected - 1.0).abs() < 0.01, "{found}, not {expected}");
        }
    }
}
