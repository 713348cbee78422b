//! Pre-travel, offset and centre by least squares; how large the model may be.

use super::hit::{Gauge, Hit, travelled};
use super::lobing::{Lobing, LobingModel};
use nalgebra::{DMatrix, DVector};
use trueaxis_geometry::Vec3;

/// Columns that differ by less than this, relative, are not separable.
const ALIKE: f64 = 1e-7;
/// The residual of exact hits is rounding, mm.
const NOTHING_MM: f64 = 1e-7;
/// Steps of Gauss and Newton; three are enough for real probes.
const MOST_STEPS: usize = 30;
/// The share of the hits that may be spent on parameters.
const SPENT: f64 = 2.0 / 3.0;
/// Knots of the splines that are tried.
const KNOTS: [usize; 11] = [4, 6, 8, 10, 12, 16, 20, 24, 30, 40, 60];

/// What is free beside the pre-travel.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Free {
    /// Coordinates of the offset of the ball.
    pub offset: usize,
    /// Coordinates of the centre of the gauge.
    pub centre: usize,
}

impl Free {
    /// What these hits determine: a known centre, or several orientations of the spindle.
    pub fn of(hits: &[Hit], gauge: &Gauge) -> Self {
        let dimensions = gauge.dimensions();
        if gauge.centre_mm.is_some() {
            return Self { offset: dimensions, centre: 0 };
        }
        let first = hits.first().map_or(0.0, |h| h.orientation_rad);
        // Nearer orientations separate offset and centre too badly.
        let turned = hits.iter().any(|h| (0.5 * (h.orientation_rad - first)).sin().abs() > 0.1);
        Self { offset: if turned { 2 } else { 0 }, centre: dimensions }
    }

    fn count(self) -> usize {
        self.offset + self.centre
    }
}

/// Hits with what they touch.
#[derive(Debug, Clone, Copy)]
pub struct Sample<'a> {
    /// The hits.
    pub hits: &'a [Hit],
    /// What they touch.
    pub gauge: &'a Gauge,
    /// Between the centres of ball and gauge at contact, mm.
    pub contact_mm: f64,
}

/// Values of all parameters with what the hits say of them.
#[derive(Debug, Clone)]
pub struct Fit {
    /// The functions.
    pub lobing: Lobing,
    /// Of the functions, mm.
    pub coefficients_mm: Vec<f64>,
    /// Ball − spindle in the frame of the probe, mm; 0 where it is not free.
    pub offset_mm: Vec3,
    /// Of the gauge, mm.
    pub centre_mm: Vec3,
    /// What is free.
    pub free: Free,
    /// Hit by hit: pre-travel − model, mm.
    pub left_mm: Vec<f64>,
    /// The same by a model that has seen no hit of that direction, mm.
    pub held_out_mm: Vec<f64>,
    /// (AᵀA)⁻¹ of coefficients, offset, centre.
    pub cofactor: DMatrix<f64>,
}

impl Fit {
    /// Hits less parameters.
    pub fn freedom(&self) -> usize {
        self.left_mm.len().saturating_sub(self.cofactor.nrows())
    }

    /// Standard deviation of one hit, mm.
    pub fn s_mm(&self) -> f64 {
        let squares: f64 = self.left_mm.iter().map(|r| r * r).sum();
        (squares / self.freedom().max(1) as f64).sqrt()
    }

    /// The pre-travel in a direction as the probe sees it, mm, without its first degree.
    pub fn travel_mm(&self, probe_direction: Vec3) -> f64 {
        let values = self.lobing.values(probe_direction);
        values.iter().zip(&self.coefficients_mm).map(|(v, c)| v * c).sum()
    }

    /// u of `Σ weight · parameter` from the scatter of the hits, mm.
    pub fn u_mm(&self, weights: &DVector<f64>) -> f64 {
        self.s_mm() * weights.dot(&(&self.cofactor * weights)).max(0.0).sqrt()
    }
}

/// The mean square of hits that were held out, for one size of the model.
#[derive(Debug, Clone, PartialEq)]
pub struct Score {
    /// Harmonics or spline.
    pub model: LobingModel,
    /// The highest order, or the number of knots.
    pub size: usize,
    /// Parameters in all.
    pub parameters: usize,
    /// Root mean square of the residual, mm.
    pub in_sample_mm: f64,
    /// Root mean square of what was held out, mm.
    pub held_out_mm: f64,
}

/// A first centre: the sphere or circle of least squares of |p|² (Kåsa).
pub fn rough_centre(positions: &[Vec3], dimensions: usize) -> Option<Vec3> {
    let mean = positions.iter().sum::<Vec3>() / positions.len().max(1) as f64;
    let rows = positions.len();
    if rows <= dimensions {
        return None;
    }
    let near = |i: usize| positions[i] - mean;
    let a = DMatrix::from_fn(rows, dimensions + 1, |i, j| match j < dimensions {
        true => 2.0 * near(i)[j],
        false => 1.0,
    });
    let b = DVector::from_fn(rows, |i, _| near(i).norm_squared());
    let (x, _, _) = solve(a, &b)?;
    let mut centre = mean;
    (0..dimensions).for_each(|j| centre[j] += x[j]);
    Some(centre)
}

/// Solves A x = b; also an orthonormal base of the columns of A, and (AᵀA)⁻¹.
type Solved = (DVector<f64>, DMatrix<f64>, DMatrix<f64>);

fn solve(mut a: DMatrix<f64>, b: &DVector<f64>) -> Option<Solved> {
    if a.nrows() < a.ncols() {
        return None;
    }
    let norms: Vec<f64> = a.column_iter().map(|c| c.norm()).collect();
    if norms.iter().any(|n| !(n.is_finite() && *n > 0.0)) {
        return None;
    }
    for (mut column, norm) in a.column_iter_mut().zip(&norms) {
        column /= *norm;
    }
    let (q, r) = a.qr().unpack();
    if r.diagonal().iter().any(|d| d.abs() < ALIKE) {
        return None;
    }
    let scaled = r.solve_upper_triangular(&(q.transpose() * b))?;
    let inverse = r.solve_upper_triangular(&DMatrix::identity(r.nrows(), r.ncols()))?;
    let mut cofactor = &inverse * inverse.transpose();
    for i in 0..norms.len() {
        for j in 0..norms.len() {
            cofactor[(i, j)] /= norms[i] * norms[j];
        }
    }
    let x = DVector::from_fn(norms.len(), |j, _| scaled[j] / norms[j]);
    Some((x, q, cofactor))
}

/// Fits one size of the model.
///
/// ```text
///     Σ b_j φ_j(u) − g·R(φ)·δo + g·δc = t(o, c)        g = ∂t/∂w                 docs/model.md eq. 138
/// ```
///
/// `None`: these hits do not determine so many parameters.
pub fn fit(sample: &Sample<'_>, free: Free, lobing: Lobing) -> Option<Fit> {
    let (hits, count) = (sample.hits, lobing.terms.len());
    let known = sample.gauge.centre_mm;
    let positions = || hits.iter().map(|h| h.spindle_mm).collect::<Vec<_>>();
    let rough = || rough_centre(&positions(), sample.gauge.dimensions());
    let mut centre_mm = known.or_else(rough)?;
    let mut offset_mm = Vec3::zeros();
    let functions: Vec<Vec<f64>> =
        hits.iter().map(|h| lobing.values(h.probe_direction())).collect();
    for _ in 0..MOST_STEPS {
        let rule = (sample.gauge.side, sample.contact_mm);
        let found: Option<Vec<_>> =
            hits.iter().map(|h| travelled(h, offset_mm, centre_mm, rule)).collect();
        let found = found?;
        let a = DMatrix::from_fn(hits.len(), count + free.count(), |i, j| {
            let g = found[i].gradient;
            match j.checked_sub(count) {
                None => functions[i][j],
                Some(k) if k < free.offset => -super::hit::turned(g, -hits[i].orientation_rad)[k],
                Some(k) => g[k - free.offset],
            }
        });
        let b = DVector::from_fn(hits.len(), |i, _| found[i].travel_mm);
        let (x, q, cofactor) = solve(a, &b)?;
        let step = x.rows(count, free.count());
        let moved = step.amax();
        if moved < 1e-10 || free.count() == 0 {
            let left_mm = (0..hits.len())
                .map(|i| b[i] - (0..count).map(|j| functions[i][j] * x[j]).sum::<f64>())
                .collect();
            let coefficients_mm = x.rows(0, count).iter().copied().collect();
            let held_out_mm = Vec::new();
            let mut fit = Fit {
                lobing,
                coefficients_mm,
                offset_mm,
                centre_mm,
                free,
                left_mm,
                held_out_mm,
                cofactor,
            };
            fit.held_out_mm = held_out(hits, &fit.left_mm, &q)?;
            return Some(fit);
        }
        (0..free.offset).for_each(|k| offset_mm[k] += step[k]);
        (0..free.centre).for_each(|k| centre_mm[k] += step[free.offset + k]);
    }
    None
}

/// What a model says of each direction of which it has seen no hit.
///
/// ```text
///     e_g = (I − Q_g Q_gᵀ)⁻¹ r_g                                                docs/model.md eq. 139
/// ```
///
/// # Source
/// Allen 1974 (PRESS); in blocks, because hits in one direction repeat each other.
fn held_out(hits: &[Hit], left_mm: &[f64], q: &DMatrix<f64>) -> Option<Vec<f64>> {
    let mut order: Vec<usize> = (0..hits.len()).collect();
    let key = |i: usize| hits[i].probe_direction().map(|v| (v * 1e6).round() as i64);
    let keys: Vec<[i64; 3]> = (0..hits.len()).map(|i| key(i).into()).collect();
    order.sort_by_key(|i| keys[*i]);
    let mut errors = vec![0.0; hits.len()];
    for group in order.chunk_by(|a, b| keys[*a] == keys[*b]) {
        let rows = q.select_rows(group);
        let block = DMatrix::identity(group.len(), group.len()) - &rows * rows.transpose();
        let r = DVector::from_iterator(group.len(), group.iter().map(|i| left_mm[*i]));
        let e = block.lu().solve(&r)?;
        // A direction that alone determines a parameter cannot be held out.
        if e.iter().any(|v| !v.is_finite() || v.abs() > 1e3) {
            return None;
        }
        group.iter().zip(e.iter()).for_each(|(i, v)| errors[*i] = *v);
    }
    Some(errors)
}

/// The sizes of a model that so many hits with so wide gaps may ask for.
fn sizes(sample: &Sample<'_>, model: LobingModel, most: usize, gap_rad: f64) -> Vec<Lobing> {
    let solid = sample.gauge.dimensions() == 3;
    // Half a period must not fit into a gap.
    let order = ((std::f64::consts::PI / gap_rad.max(1e-3)) * (1.0 + 1e-9)) as usize;
    match model {
        LobingModel::Fourier => {
            let orders = (0..=most.min(order)).filter(|k| *k != 1);
            orders.map(|k| Lobing::harmonics(k, solid)).collect()
        }
        LobingModel::Spline => {
            let knots = KNOTS.into_iter().filter(|m| *m <= 2 * order);
            knots.map(Lobing::spline).collect()
        }
    }
}

/// Fits all sizes and chooses the smallest that predicts as well as the best.
///
/// The mean over the hits of e² − e²(best) must not exceed its standard uncertainty.
///
/// # Source
/// Breiman et al. 1984 (one standard error), here of the paired differences.
pub fn choose(
    sample: &Sample<'_>,
    model: LobingModel,
    most: usize,
    gap_rad: f64,
) -> Option<(Fit, Vec<Score>)> {
    let free = Free::of(sample.hits, sample.gauge);
    let count = sample.hits.len() as f64;
    let sizes = sizes(sample, model, most, gap_rad).into_iter();
    let fits: Vec<Fit> = sizes
        .filter(|l| (l.terms.len() + free.count()) as f64 <= SPENT * count || l.terms.len() == 1)
        .filter_map(|l| fit(sample, free, l))
        .filter(|f| f.freedom() > 0)
        .collect();
    let mean = |values: &[f64]| values.iter().map(|v| v * v).sum::<f64>() / count;
    let scores = fits.iter().map(|f| Score {
        model,
        size: f.lobing.size,
        parameters: f.cofactor.nrows(),
        in_sample_mm: mean(&f.left_mm).sqrt(),
        held_out_mm: mean(&f.held_out_mm).sqrt(),
    });
    let scores: Vec<Score> = scores.collect();
    let best = fits.iter().min_by(|a, b| mean(&a.held_out_mm).total_cmp(&mean(&b.held_out_mm)))?;
    let near = |f: &&Fit| {
        let pairs = f.held_out_mm.iter().zip(&best.held_out_mm);
        let more: Vec<f64> = pairs.map(|(a, b)| a * a - b * b).collect();
        let mean_more = more.iter().sum::<f64>() / count;
        let scatter = more.iter().map(|m| (m - mean_more).powi(2)).sum::<f64>();
        let u = (scatter / (count - 1.0) / count).sqrt();
        mean_more <= u || mean(&f.held_out_mm) <= NOTHING_MM * NOTHING_MM
    };
    let chosen = fits.iter().find(near)?.clone();
    Some((chosen, scores))
}
