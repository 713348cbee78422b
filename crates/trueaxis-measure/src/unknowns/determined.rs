//! What readings leave of an unknown, where some combinations change no reading at all.
//!
//! ```text
//!     N x = 0 for the columns of N;   Q an orthonormal basis of L⁻¹ N,   L = diag(u before)
//!     P = I − L Q Qᵀ L⁻¹        x̂ = P x        C = P C₀ Pᵀ + L Q Qᵀ L             docs/model.md eq. 300
//! ```
//!
//! It is the limit of a least-squares fit with a prior 0 ± L as the prior becomes weak against the readings: in
//! what they see it changes nothing, and what they do not see keeps its uncertainty. So a combination voids
//! only the unknowns that have a part in it that matters.

use super::confusion::{Confusion, confusions};
use super::design::{Design, Unknown};
use super::fit::{Fit, Observability};
use nalgebra::{DMatrix, DVector};

/// An unknown is determined if the readings leave a tenth of what was not known of it before.
const DETERMINED: f64 = 0.1;
/// A part of a combination that is smaller than this, in units of what was not known before, is not named.
const NAMED: f64 = 0.01;

/// Values with their covariance, what no reading sees included.
#[derive(Debug, Clone)]
pub struct Determined {
    /// The unknowns. Unit: mm, rad, s or 1.
    pub values: Vec<f64>,
    /// Their covariance.
    pub covariance: DMatrix<f64>,
    /// The part of it that the readings leave in what they see: P C₀ Pᵀ.
    pub seen: DMatrix<f64>,
    /// Whether each is known well enough to be stated.
    pub is_determined: Vec<bool>,
}

/// What is not known of an unknown before anything is read: its standard uncertainty, mm, rad, s or 1.
///
/// Machines are built to some tenths of a millimetre, balls are placed by eye to a few. The
/// numbers decide only what is stated and what is not; a tenfold larger one changes no value that is determined.
pub fn before(unknown: &Unknown<'_>) -> f64 {
    let machine = matches!(unknown, Unknown::Term(_));
    match (machine, unknown.is_angle()) {
        _ if unknown.is_time() => 0.1,
        _ if unknown.is_share() => 1e-3,
        (_, true) if unknown.is_rate() => 0.3e-3,
        _ if unknown.is_rate() => 0.3,
        (true, true) => 1e-3,
        (true, false) => 1.0,
        (false, true) => 3e-3,
        (false, false) => 3.0,
    }
}

/// The same of all unknowns of a design.
pub fn all_before(design: &Design) -> DVector<f64> {
    let of = |k: usize| design.unknown(k).map_or(1.0, |u| before(&u));
    DVector::from_fn(design.unknowns(), |k, _| of(k))
}

impl Determined {
    /// Of a fit.
    pub fn of(design: &Design, fit: &Fit) -> Self {
        Self::from(design, &fit.sight, &fit.values, &fit.covariance)
    }

    /// Of what a plan will show: the values are 0.
    pub fn expected(design: &Design, sight: &Observability) -> Self {
        Self::from(design, sight, &vec![0.0; design.unknowns()], &sight.covariance())
    }

    fn from(
        design: &Design,
        sight: &Observability,
        values: &[f64],
        covariance: &DMatrix<f64>,
    ) -> Self {
        let scale = all_before(design);
        let n = values.len();
        let Limit { values, seen, covariance } = limit(sight, &scale, values, covariance);
        let is_determined = (0..n).map(|k| {
            let known = design.unknown(k).is_some_and(|u| u.prior().is_some())
                || design.known().is_some_and(|known| known.normal[(k, k)] > 0.0);
            let u = covariance[(k, k)].max(0.0).sqrt();
            u <= DETERMINED * scale[k] || known && sight.is_seen[k]
        });
        let (values, is_determined) = (values.as_slice().to_vec(), is_determined.collect());
        Self { values, covariance, seen, is_determined }
    }

    /// How the values move where those of the fit move so: a column for each change.
    pub fn moved(design: &Design, sight: &Observability, changes: &DMatrix<f64>) -> DMatrix<f64> {
        let (project, _) = projection(sight, &all_before(design));
        project * changes
    }

    /// The combinations that change no reading and in which an unknown has so large a part that it is not determined.
    pub fn confusions(&self, design: &Design, sight: &Observability) -> Vec<Confusion> {
        let mut all = confusions(sight);
        all.retain(|confusion| {
            let members = members_that_matter(design, &confusion.members);
            members.iter().any(|(k, _)| !self.is_determined[*k])
        });
        all
    }

    /// The standard uncertainty of one.
    pub fn u(&self, unknown: usize) -> f64 {
        self.covariance[(unknown, unknown)].max(0.0).sqrt()
    }
}

/// Values with what is known of them, as a prior 0 ± `scale` becomes weak.
struct Limit {
    values: DVector<f64>,
    seen: DMatrix<f64>,
    covariance: DMatrix<f64>,
}

fn limit(
    sight: &Observability,
    scale: &DVector<f64>,
    values: &[f64],
    covariance: &DMatrix<f64>,
) -> Limit {
    let (project, hidden) = projection(sight, scale);
    let values = &project * DVector::from_column_slice(values);
    let seen = &project * covariance * project.transpose();
    let covariance = &seen + &hidden * hidden.transpose();
    Limit { values, seen, covariance }
}

/// P, and what is not seen: L Q.
fn projection(sight: &Observability, scale: &DVector<f64>) -> (DMatrix<f64>, DMatrix<f64>) {
    let unseen = unseen(sight, scale);
    let n = scale.len();
    let hidden = DMatrix::from_fn(n, unseen.ncols(), |k, j| scale[k] * unseen[(k, j)]);
    let reading = DMatrix::from_fn(unseen.ncols(), n, |j, k| unseen[(k, j)] / scale[k]);
    (DMatrix::identity(n, n) - &hidden * reading, hidden)
}

/// An orthonormal basis of what is not seen, in units of what was not known before.
fn unseen(sight: &Observability, scale: &DVector<f64>) -> DMatrix<f64> {
    let null = &sight.null_space;
    if null.ncols() == 0 {
        return null.clone();
    }
    let in_units = DMatrix::from_fn(null.nrows(), null.ncols(), |k, j| null[(k, j)] / scale[k]);
    in_units.qr().q()
}

/// Which members of a combination matter: all others are smaller than a hundredth of the largest, in units of
/// what was not known before.
pub fn members_that_matter(design: &Design, members: &[(usize, f64)]) -> Vec<(usize, f64)> {
    let size =
        |(k, share): &(usize, f64)| design.unknown(*k).map_or(0.0, |u| (share / before(&u)).abs());
    let greatest = members.iter().map(size).fold(0.0, f64::max);
    members.iter().filter(|m| size(m) >= NAMED * greatest).copied().collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_slight_part_in_what_is_not_seen_costs_little() {
        // Only a + b/1000 is read, 0.02 mm with u = 1 µm; neither was known to better than 1 mm (docs/model.md 300).
        let row = DVector::from_vec(vec![1e3, 1.0]);
        let sight = Observability::of(&(&row * row.transpose()));
        let values = sight.solve(&(&row * 20.0));
        let scale = DVector::from_element(2, 1.0);
        let found = limit(&sight, &scale, values.as_slice(), &sight.covariance());
        let u = |k: usize| found.covariance[(k, k)].sqrt();
        assert!((u(0) - 2f64.sqrt() * 1e-3).abs() < 1e-8, "{}", u(0));
        assert!((u(1) - 1.0).abs() < 1e-5, "{}", u(1));
        assert!((found.values[0] - 0.02).abs() < 1e-7 && found.values[1].abs() < 1e-4);
        // With a prior 0 ± 1 mm the normal equations say the same.
        let normal = &row * row.transpose() + DMatrix::identity(2, 2);
        let by_prior = normal.try_inverse().expect("with a prior");
        assert!((by_prior - found.covariance).amax() < 1e-5);
    }
}
