//! The deviation of the blank as a smooth field on its surface: universal kriging.
//!
//! ```text
//!     d(p) = rigid part (registration) + form (Gaussian process) + noise of the probe
//! ```
//!
//! Both parts are estimated at once, so that the uncertainty of the registration knows of the form.

use super::registration::{Freedoms, Registration};
use super::table::{SurfacePoint, order_of_points};
use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;
use trueaxis_geometry::Vec3;
use trueaxis_geometry::statistics::normal_quantile_above;

/// More points make a system that takes minutes.
pub const MOST_POINTS: usize = 2500;
/// The length of the field is chosen on so many of them.
const MOST_CHOSEN_ON: usize = 260;
/// A reading this many standard deviations off is examined, whatever their number.
const LEAST_OUTLIER: f64 = 4.0;
/// More outliers than this share are no outliers.
const MOST_OUTLIERS: f64 = 0.1;

/// What a field could not be made of.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum FieldError {
    /// Too many points.
    #[error("{0} points are more than {MOST_POINTS}")]
    TooManyPoints(usize),
    /// So many readings contradict their neighbours that the rest says nothing.
    #[error("{outliers} of {points} readings contradict their neighbours")]
    TooManyOutliers {
        /// How many.
        outliers: usize,
        /// Of how many.
        points: usize,
    },
    /// The equations have no solution in double precision.
    #[error("the readings do not determine the field")]
    Singular,
}

/// How the form of the blank varies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Covariance {
    /// Over what distance it stays alike, mm.
    pub length_mm: f64,
    /// How large it is, standard deviation.
    pub form_mm: f64,
}

impl Covariance {
    /// Matérn 5/2 over the distance of places and of normals, so that the two sides of a thin wall
    /// are not taken for neighbours; a distance in space knows by itself that a ring closes.
    ///
    /// k = σ²(1 + √5ρ + 5ρ²/3)·exp(−√5ρ), ρ² = |Δp|²/ℓ² + |Δn|²      docs/model.md eq. 148
    pub fn between(&self, a: (&Vec3, &Vec3), b: (&Vec3, &Vec3)) -> f64 {
        let square =
            (a.0 - b.0).norm_squared() / self.length_mm.powi(2) + (a.1 - b.1).norm_squared();
        let r = (5.0 * square).sqrt();
        self.form_mm.powi(2) * (1.0 + r + r * r / 3.0) * (-r).exp()
    }
}

/// A value of the field.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Estimate {
    /// The whole deviation, mm.
    pub deviation_mm: f64,
    /// Of it the form, without the rigid part.
    pub form_mm: f64,
    /// Standard uncertainty of the whole.
    pub u_mm: f64,
}

/// A reading against what all others say.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Outlier {
    /// Which point of the table, from 0.
    pub index: usize,
    /// Reading − what the others say, mm.
    pub residual_mm: f64,
    /// The same in standard deviations. Unit: 1.
    pub z: f64,
}

/// What is wanted of a field.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FieldOptions {
    /// Standard uncertainty of a reading.
    pub noise_mm: f64,
    /// Over what distance the form stays alike; `None`: chosen by cross-validation.
    pub length_mm: Option<f64>,
    /// How large it is, standard deviation; `None`: chosen likewise.
    pub form_mm: Option<f64>,
}

/// The deviation of the blank everywhere.
#[derive(Debug, Clone)]
pub struct Field {
    places: Vec<(Vec3, Vec3)>,
    /// How the form varies.
    pub covariance: Covariance,
    /// How the blank lies.
    pub registration: Registration,
    /// Readings that count less.
    pub outliers: Vec<Outlier>,
    /// Each reading against all others, in standard deviations of that difference. Unit: 1.
    pub left_out_z: Vec<f64>,
    /// Root mean square of those differences without outliers, mm.
    pub left_out_rms_mm: f64,
    /// By how much uncertainties were raised because the readings scatter more than they should. Unit: 1.
    pub raised: f64,
    /// What the stated uncertainties of all readings have in common: no number of readings averages it out, mm.
    pub common_mm: f64,
    solved: Solved,
}

impl Field {
    /// Fits rigid part and form.
    ///
    /// # Errors
    /// Too many points or outliers; equations without solution.
    pub fn fit(points: &[SurfacePoint], options: &FieldOptions) -> Result<Self, FieldError> {
        if points.len() > MOST_POINTS {
            return Err(FieldError::TooManyPoints(points.len()));
        }
        // The length of the form is chosen on every so many of the points: not on those that the rows happen to show.
        let order = order_of_points(points);
        let points: Vec<SurfacePoint> = order.iter().map(|i| points[*i]).collect();
        let mut field = Self::fit_in_order(&points, options)?;
        let mut left_out_z = vec![0.0; points.len()];
        order.iter().zip(&field.left_out_z).for_each(|(row, z)| left_out_z[*row] = *z);
        field.left_out_z = left_out_z;
        field.outliers.iter_mut().for_each(|outlier| outlier.index = order[outlier.index]);
        Ok(field)
    }

    fn fit_in_order(points: &[SurfacePoint], options: &FieldOptions) -> Result<Self, FieldError> {
        let freedoms = Freedoms::of(points);
        let readings = Readings::of(points, &freedoms, options.noise_mm);
        let mut extra = vec![0.0; points.len()];
        let mut covariance = readings.choose(options, &extra);
        let mut solved = readings.solve(&covariance, &extra).ok_or(FieldError::Singular)?;
        let mut outliers = readings.weigh_down(&mut solved, &mut extra)?;
        if !outliers.is_empty() {
            // Outliers have made the form look rougher than it is.
            covariance = readings.choose(options, &extra);
            solved = readings.solve(&covariance, &extra).ok_or(FieldError::Singular)?;
            outliers.extend(readings.weigh_down(&mut solved, &mut extra)?);
        }
        let sound: Vec<usize> = (0..points.len()).filter(|i| extra[*i] == 0.0).collect();
        let left_out_z: Vec<f64> = (0..points.len()).map(|i| solved.z(i)).collect();
        let mean = |f: &dyn Fn(usize) -> f64| {
            sound.iter().map(|i| f(*i).powi(2)).sum::<f64>() / sound.len().max(1) as f64
        };
        let raised = mean(&|i| left_out_z[i]).sqrt().max(1.0);
        let left_out_rms_mm = mean(&|i| solved.left_out(i)).sqrt();
        let registration = Registration::of(
            freedoms,
            solved.beta.as_slice(),
            &(&solved.beta_covariance * raised.powi(2)),
        );
        Ok(Self {
            places: readings.places,
            covariance,
            registration,
            outliers,
            left_out_z,
            left_out_rms_mm,
            raised,
            common_mm: readings.common_mm,
            solved,
        })
    }

    fn covariances(&self, at: &Vec3, normal: &Vec3) -> DVector<f64> {
        let each = |p: &(Vec3, Vec3)| self.covariance.between((&p.0, &p.1), (at, normal));
        DVector::from_iterator(self.places.len(), self.places.iter().map(each))
    }

    /// The deviation at a place of the nominal surface with its normal.
    ///
    /// d = hᵀβ + kᵀα, u² = k₀ − kᵀK⁻¹k + gᵀCg + c², g = h − HᵀK⁻¹k    docs/model.md eq. 149, 192
    pub fn at(&self, at: &Vec3, normal: &Vec3) -> Estimate {
        let k = self.covariances(at, normal);
        let h = DVector::from_vec(self.registration.freedoms.basis(at, normal));
        let s = &self.solved;
        let form_mm = k.dot(&s.alpha);
        let g = &h - s.inverse_basis.tr_mul(&k);
        let simple = self.covariance.form_mm.powi(2) - k.dot(&(&s.inverse * &k));
        let variance = simple.max(0.0) + (&s.beta_covariance * &g).dot(&g);
        let u_mm = (self.raised * variance.max(0.0).sqrt()).hypot(self.common_mm);
        Estimate { deviation_mm: h.dot(&s.beta) + form_mm, form_mm, u_mm }
    }

    /// The deviation alone: many times faster than [`Self::at`].
    pub fn deviation_mm(&self, at: &Vec3, normal: &Vec3) -> f64 {
        let h = self.registration.freedoms.basis(at, normal);
        let rigid: f64 = h.iter().zip(self.solved.beta.iter()).map(|(h, b)| h * b).sum();
        rigid + self.form_mm(at, normal)
    }

    /// The form alone.
    pub fn form_mm(&self, at: &Vec3, normal: &Vec3) -> f64 {
        let each = |p: &(Vec3, Vec3)| self.covariance.between((&p.0, &p.1), (at, normal));
        self.places.iter().zip(self.solved.alpha.iter()).map(|(p, a)| a * each(p)).sum()
    }

    /// Which share of the readings lies within k standard uncertainties of what the others say.
    pub fn share_within(&self, k: f64) -> f64 {
        let inside = self.left_out_z.iter().filter(|z| z.abs() <= k * self.raised).count();
        inside as f64 / self.left_out_z.len().max(1) as f64
    }
}

/// What was read where.
struct Readings {
    places: Vec<(Vec3, Vec3)>,
    basis: DMatrix<f64>,
    values: DVector<f64>,
    noise_mm: f64,
    /// Of each reading alone, mm².
    nuggets: Vec<f64>,
    common_mm: f64,
}

/// What of the stated uncertainties is of each reading alone, and what all of them share.
///
/// What even the best of the readings states beyond the noise of a hit, s, is in all of them: ball radius, length,
/// machine. The rest is of each reading alone, so that it pulls the less the larger it is. A reading that states
/// nothing errs by the noise.
///
/// c² = max(0, min u_i² − s²), n_i = u_i² − c²                    docs/model.md eq. 192
fn nuggets(points: &[SurfacePoint], noise_mm: f64) -> (Vec<f64>, f64) {
    let squares = points.iter().map(|p| p.u_mm.unwrap_or(noise_mm).powi(2));
    let least = squares.clone().fold(f64::INFINITY, f64::min);
    let common = if least.is_finite() { (least - noise_mm.powi(2)).max(0.0) } else { 0.0 };
    (squares.map(|u| u - common).collect(), common.sqrt())
}

impl Readings {
    fn of(points: &[SurfacePoint], freedoms: &Freedoms, noise_mm: f64) -> Self {
        let rows: Vec<Vec<f64>> =
            points.iter().map(|p| freedoms.basis(&p.at_mm, &p.normal)).collect();
        let (nuggets, common_mm) = nuggets(points, noise_mm);
        Self {
            places: points.iter().map(|p| (p.at_mm, p.normal)).collect(),
            basis: DMatrix::from_fn(points.len(), freedoms.seen.len(), |i, j| rows[i][j]),
            values: DVector::from_iterator(points.len(), points.iter().map(|p| p.deviation_mm)),
            noise_mm,
            nuggets,
            common_mm,
        }
    }

    fn solve(&self, covariance: &Covariance, extra: &[f64]) -> Option<Solved> {
        let n = self.places.len();
        let place = |i: usize| (&self.places[i].0, &self.places[i].1);
        let mut k = DMatrix::zeros(n, n);
        for j in 0..n {
            for i in j..n {
                let value = covariance.between(place(i), place(j));
                k[(i, j)] = value;
                k[(j, i)] = value;
            }
            k[(j, j)] += self.nuggets[j] + extra[j];
        }
        let inverse = k.cholesky()?.inverse();
        Solved::of(inverse, &self.basis, &self.values)
    }

    /// Every so many of the readings, for what is tried many times.
    fn thinned(&self) -> (Self, Vec<usize>) {
        let n = self.places.len();
        let step = n.div_ceil(MOST_CHOSEN_ON).max(1);
        let kept: Vec<usize> = (0..n).step_by(step).collect();
        let thin = Self {
            places: kept.iter().map(|i| self.places[*i]).collect(),
            basis: self.basis.select_rows(&kept),
            values: self.values.select_rows(&kept),
            noise_mm: self.noise_mm,
            nuggets: kept.iter().map(|i| self.nuggets[*i]).collect(),
            common_mm: self.common_mm,
        };
        (thin, kept)
    }

    /// The covariance under which each reading is best foretold by all others, with its uncertainty.
    ///
    /// min Σ ln vᵢ/2 + min(rᵢ²/vᵢ, 9)/2                            docs/model.md eq. 150
    fn choose(&self, stated: &FieldOptions, extra: &[f64]) -> Covariance {
        if let (Some(length_mm), Some(form_mm)) = (stated.length_mm, stated.form_mm) {
            return Covariance { length_mm, form_mm };
        }
        let (thin, kept) = self.thinned();
        let extra: Vec<f64> = kept.iter().map(|i| extra[*i]).collect();
        let [least, most] = self.scales();
        let spread = thin.values.norm() / (thin.values.len().max(1) as f64).sqrt();
        let size = spread.max(self.noise_mm).max(1e-9);
        let bounds = [[least.ln(), most.ln()], [(0.01 * size).ln(), (10.0 * size).ln()]];
        let covariance = |x: [f64; 2]| Covariance {
            length_mm: stated.length_mm.unwrap_or_else(|| x[0].exp()),
            form_mm: stated.form_mm.unwrap_or_else(|| x[1].exp()),
        };
        let score =
            |x: [f64; 2]| thin.solve(&covariance(x), &extra).map_or(f64::INFINITY, |s| s.score());
        let lengths = if stated.length_mm.is_some() { 1 } else { 7 };
        let grid = (0..lengths).flat_map(|i| {
            let share = (f64::from(i) + 0.5) / f64::from(lengths);
            let length = bounds[0][0] + share * (bounds[0][1] - bounds[0][0]);
            [0.1, 0.3, 1.0, 3.0].map(|f: f64| [length, (f * size).ln()])
        });
        let grid: Vec<[f64; 2]> = grid.collect();
        let scored: Vec<f64> = grid.par_iter().map(|x| score(*x)).collect();
        let first = (0..grid.len()).min_by(|a, b| scored[*a].total_cmp(&scored[*b])).unwrap_or(0);
        let mut best = (grid[first], scored[first]);
        let mut step = [(bounds[0][1] - bounds[0][0]) / f64::from(lengths) / 2.0, 0.5];
        for _ in 0..7 {
            let tried = [[1.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [0.0, -1.0]].map(|d| {
                [0, 1].map(|a| (best.0[a] + d[a] * step[a]).clamp(bounds[a][0], bounds[a][1]))
            });
            let scored: Vec<f64> = tried.par_iter().map(|x| score(*x)).collect();
            match (0..4).min_by(|a, b| scored[*a].total_cmp(&scored[*b])) {
                Some(i) if scored[i] < best.1 => best = (tried[i], scored[i]),
                _ => step = step.map(|s| 0.5 * s),
            }
        }
        covariance(best.0)
    }

    /// From the distance between neighbours to the size of the part, mm.
    fn scales(&self) -> [f64; 2] {
        let first = self.places.first().map_or(Vec3::zeros(), |p| p.0);
        let size = self.places.iter().fold(0.0_f64, |m, p| m.max((p.0 - first).norm()));
        let step = (self.places.len() / 100).max(1);
        let mut nearest: Vec<f64> = (0..self.places.len())
            .step_by(step)
            .map(|i| {
                let others = self.places.iter().enumerate().filter(|(j, _)| *j != i);
                others.fold(f64::INFINITY, |m, (_, p)| m.min((p.0 - self.places[i].0).norm()))
            })
            .collect();
        nearest.sort_by(f64::total_cmp);
        let spacing = nearest.get(nearest.len() / 2).copied().unwrap_or(1.0).max(1e-3);
        [spacing, (3.0 * size).max(2.0 * spacing)]
    }

    /// Gives readings that contradict all others the variance of their own residual, the worst first.
    fn weigh_down(
        &self,
        solved: &mut Solved,
        extra: &mut [f64],
    ) -> Result<Vec<Outlier>, FieldError> {
        let n = self.places.len();
        let limit = normal_quantile_above(0.005 / n as f64).max(LEAST_OUTLIER);
        let mut outliers = Vec::new();
        loop {
            let free = (0..n).filter(|i| extra[*i] == 0.0);
            let mut sizes: Vec<f64> = free.clone().map(|i| solved.z(i).abs()).collect();
            sizes.sort_by(f64::total_cmp);
            let median = sizes.get(sizes.len() / 2).copied().unwrap_or(0.0);
            let scale = (1.4826 * median).max(1.0);
            let worst = free.max_by(|a, b| solved.z(*a).abs().total_cmp(&solved.z(*b).abs()));
            let Some(index) = worst.filter(|i| solved.z(*i).abs() > limit * scale) else {
                return Ok(outliers);
            };
            let residual_mm = solved.left_out(index);
            outliers.push(Outlier { index, residual_mm, z: solved.z(index) });
            if outliers.len() as f64 > MOST_OUTLIERS * n as f64 {
                return Err(FieldError::TooManyOutliers { outliers: outliers.len(), points: n });
            }
            extra[index] = residual_mm.powi(2);
            // Sherman and Morrison: the inverse with one variance raised.
            let column = solved.inverse.column(index).into_owned();
            let factor = extra[index] / (1.0 + extra[index] * column[index]);
            let inverse = &solved.inverse - &column * column.transpose() * factor;
            *solved = Solved::of(inverse, &self.basis, &self.values).ok_or(FieldError::Singular)?;
        }
    }
}

/// The equations of universal kriging, solved.
///
/// Q = K⁻¹ − K⁻¹H(HᵀK⁻¹H)⁻¹HᵀK⁻¹, rᵢ = (Qd)ᵢ/Qᵢᵢ, vᵢ = 1/Qᵢᵢ         docs/model.md eq. 150
#[derive(Debug, Clone)]
struct Solved {
    inverse: DMatrix<f64>,
    /// K⁻¹H
    inverse_basis: DMatrix<f64>,
    beta: DVector<f64>,
    beta_covariance: DMatrix<f64>,
    /// Qd
    alpha: DVector<f64>,
    /// Diagonal of Q.
    diagonal: DVector<f64>,
}

impl Solved {
    fn of(inverse: DMatrix<f64>, basis: &DMatrix<f64>, values: &DVector<f64>) -> Option<Self> {
        let inverse_basis = &inverse * basis;
        let beta_covariance = basis.tr_mul(&inverse_basis).cholesky()?.inverse();
        let beta = &beta_covariance * inverse_basis.tr_mul(values);
        let alpha = &inverse * values - &inverse_basis * &beta;
        let diagonal = DVector::from_fn(values.len(), |i, _| {
            let b = inverse_basis.row(i);
            inverse[(i, i)] - (b * &beta_covariance).dot(&b)
        });
        let sound = diagonal.iter().all(|d| d.is_finite() && *d > 0.0);
        let solved = Self { inverse, inverse_basis, beta, beta_covariance, alpha, diagonal };
        sound.then_some(solved)
    }

    /// Reading − what all others say.
    fn left_out(&self, i: usize) -> f64 {
        self.alpha[i] / self.diagonal[i]
    }

    /// The same in standard deviations.
    fn z(&self, i: usize) -> f64 {
        self.alpha[i] / self.diagonal[i].sqrt()
    }

    fn score(&self) -> f64 {
        let each = |i: usize| -0.5 * self.diagonal[i].ln() + 0.5 * self.z(i).powi(2).min(9.0);
        (0..self.alpha.len()).map(each).sum()
    }
}
