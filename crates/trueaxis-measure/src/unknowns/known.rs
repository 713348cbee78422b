//! What was known of several unknowns before the readings: a normal distribution with its full covariance.
//!
//! ```text
//!     g = F x, covariance C:   Λ = Fᵀ C⁻¹ F,   η = Fᵀ C⁻¹ g                 docs/model.md eq. 200
//! ```
//!
//! Λ and η are sums over everything that was read, so that the order does not matter, and a combination of
//! which nothing is known has no part in them.

use nalgebra::{DMatrix, DVector};

/// Knowledge of unknowns by their names, as normal equations.
#[derive(Debug, Clone, PartialEq)]
pub struct Known {
    /// The unknowns.
    pub names: Vec<String>,
    /// Λ, the inverse of the covariance where there is one.
    pub normal: DMatrix<f64>,
    /// η = Λ x.
    pub gradient: DVector<f64>,
    /// gᵀ C⁻¹ g. Unit: 1.
    pub square: f64,
    /// Fᵀ C⁻¹ m of what a machine file states with an uncertainty: its name, and how one standard uncertainty moves η. C is without
    /// it (docs/model.md eq. 346).
    pub stated: Vec<(String, DVector<f64>)>,
}

impl Known {
    /// Nothing is known of these unknowns.
    pub fn nothing(names: Vec<String>) -> Self {
        let n = names.len();
        let (normal, gradient) = (DMatrix::zeros(n, n), DVector::zeros(n));
        Self { names, normal, gradient, square: 0.0, stated: Vec::new() }
    }

    /// From values of combinations (one row of F each) with their covariance, and how one standard uncertainty of what a machine
    /// file states moves them; `None` if that is no covariance: it must be symmetric and positive definite.
    pub fn of_rows(
        names: Vec<String>,
        rows: &DMatrix<f64>,
        values: &DVector<f64>,
        covariance: &DMatrix<f64>,
        moves: &[(String, DVector<f64>)],
    ) -> Option<Self> {
        let scale = covariance.diagonal().map(|c| if c > 0.0 { c.sqrt() } else { f64::NAN });
        if scale.iter().any(|s| !s.is_finite()) || !rows.iter().all(|v| v.is_finite()) {
            return None;
        }
        // mm and rad differ by powers of ten: correlations are inverted, not covariances.
        let m = scale.len();
        let correlation = DMatrix::from_fn(m, m, |i, j| covariance[(i, j)] / (scale[i] * scale[j]));
        let asymmetry = (&correlation - correlation.transpose()).amax();
        let half = correlation.cholesky().filter(|_| asymmetry < 1e-9)?;
        let in_u = DMatrix::from_fn(m, rows.ncols(), |i, j| rows[(i, j)] / scale[i]);
        let g = values.component_div(&scale);
        let weighted = half.solve(&in_u);
        let pull = |m: &DVector<f64>| weighted.transpose() * m.component_div(&scale);
        Some(Self {
            stated: moves.iter().map(|(name, m)| (name.clone(), pull(m))).collect(),
            normal: in_u.transpose() * &weighted,
            gradient: weighted.transpose() * &g,
            square: g.dot(&half.solve(&g)),
            names,
        })
    }

    /// Adds an independent value of one unknown with its standard uncertainty.
    pub fn add_value(&mut self, k: usize, value: f64, u: f64) {
        self.normal[(k, k)] += u.powi(-2);
        self.gradient[k] += value / (u * u);
        self.square += (value / u).powi(2);
    }

    /// Adds what is known of the same unknowns from elsewhere, `times` as sure.
    pub fn add(&mut self, other: &Self, times: f64) {
        let other = other.on(&self.names);
        self.normal += other.normal * times;
        self.gradient += other.gradient * times;
        self.square += times * other.square;
        for (name, pull) in other.stated {
            match self.stated.iter_mut().find(|(own, _)| *own == name) {
                Some((_, own)) => *own += pull * times,
                None => self.stated.push((name, pull * times)),
            }
        }
    }

    /// The same for a list of unknowns: nothing is known of those that are new.
    pub fn on(&self, names: &[String]) -> Self {
        if self.names == names {
            return self.clone();
        }
        let of: Vec<Option<usize>> =
            names.iter().map(|n| self.names.iter().position(|own| own == n)).collect();
        let n = names.len();
        let both = |i: usize, j: usize| Some(self.normal[(of[i]?, of[j]?)]);
        let on_names = |v: &DVector<f64>| DVector::from_fn(n, |i, _| of[i].map_or(0.0, |k| v[k]));
        let stated = self.stated.iter().map(|(name, pull)| (name.clone(), on_names(pull)));
        Self {
            names: names.to_vec(),
            stated: stated.collect(),
            normal: DMatrix::from_fn(n, n, |i, j| both(i, j).unwrap_or(0.0)),
            gradient: on_names(&self.gradient),
            square: self.square,
        }
    }

    /// The squared deviation of these values from what is known, in units of its uncertainty.
    pub fn error(&self, values: &DVector<f64>) -> f64 {
        let bent = &self.normal * values;
        (self.square - 2.0 * values.dot(&self.gradient) + values.dot(&bent)).max(0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_correlated_values() {
        // u = 1 and 1, correlation 1/2: C⁻¹ = 4/3 [1 −½; −½ 1]; with g = (1, 0): gᵀC⁻¹g = 4/3
        let names = vec!["a".to_owned(), "b".to_owned()];
        let covariance = DMatrix::from_row_slice(2, 2, &[1.0, 0.5, 0.5, 1.0]);
        let g = DVector::from_vec(vec![1.0, 0.0]);
        let known = Known::of_rows(names, &DMatrix::identity(2, 2), &g, &covariance, &[]);
        let known = known.expect("a covariance");
        assert!((known.normal[(0, 1)] + 2.0 / 3.0).abs() < 1e-15);
        assert!((known.square - 4.0 / 3.0).abs() < 1e-15 && known.error(&g) < 1e-12);
        let turned = known.on(&["b".to_owned(), "c".to_owned(), "a".to_owned()]);
        assert!((turned.normal[(2, 0)] + 2.0 / 3.0).abs() < 1e-15 && turned.normal[(1, 1)] == 0.0);
        let impossible = DMatrix::from_row_slice(2, 2, &[1.0, 2.0, 2.0, 1.0]);
        let none =
            Known::of_rows(vec![String::new(); 2], &DMatrix::identity(2, 2), &g, &impossible, &[]);
        assert!(none.is_none());
    }
}
