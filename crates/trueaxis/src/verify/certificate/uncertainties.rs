//! The uncertainties of the errors of a machine: independent factors, each of which changes some errors.
//!
//! ```text
//!     E(q) = Ê(q) + Σ_j z_j e_j(q)          z_j independent, standard normal             docs/model.md eq. 172
//!     e_j = u_j(q) of one stated error                         from a machine file
//!     e_j = Σ_k L_kj φ_k(q),   L Lᵀ = covariance of the terms     from an identification
//! ```
//!
//! A machine file states one u per error without correlations; an identification has the covariance of errors
//! that its readings can hardly separate.

use nalgebra::{DMatrix, SymmetricEigen};
use trueaxis_calibrate::identify::errors::Identification;
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{Approach, Command};
use trueaxis_machine::errors::{ErrorIndex, ErrorValues, Uncertainties};
use trueaxis_measure::unknowns::term::Term;

/// The factors of a machine.
#[derive(Debug, Clone)]
pub struct UncertaintyFactors {
    quantities: Vec<String>,
    /// The quantities with a covariance from an identification.
    is_fitted: Vec<bool>,
    terms: Vec<Term>,
    /// L: one row per term, one column per factor.
    root: DMatrix<f64>,
}

/// The factors at a command.
#[derive(Debug)]
pub struct LocalFactors<'a> {
    known: &'a UncertaintyFactors,
    stated: Uncertainties,
    /// φ of every term.
    shapes: Vec<f64>,
}

impl UncertaintyFactors {
    /// From the machine file: errors that are independent of each other, each one factor for its whole curve.
    pub fn stated(machine: &Machine) -> Self {
        let quantities = machine.uncertain_quantities();
        let is_fitted = vec![false; quantities.len()];
        Self { quantities, is_fitted, terms: Vec::new(), root: DMatrix::zeros(0, 0) }
    }

    /// From an identification of this machine; for errors that it did not determine, from the machine file.
    /// Terms that its selection left out count as 0, without an uncertainty.
    pub fn identified(machine: &Machine, found: &Identification) -> Self {
        let covariance = &found.fit.covariance;
        Self::of_fit(machine, &found.design.terms, covariance)
    }

    /// The same from terms and their covariance (mm², mm·rad, rad²); rows after those of the terms
    /// belong to the set-up and are left out.
    ///
    /// # Example
    /// ```
    /// use nalgebra::DMatrix;
    /// use trueaxis::machine::{Machine, errors::ErrorName, file::NoTables};
    /// use trueaxis::unknowns::term::Term;
    /// use trueaxis::verify::certificate::uncertainties::UncertaintyFactors;
    /// let text = "[machine]\nname = \"m\"\nchain = \"w b X Y Z t\"\n[location]\nEX0X = \"0 ± 9 um\"";
    /// let machine = Machine::check("m.toml", text, &NoTables).0.unwrap();
    /// let names = ["EX0X", "EX0Y"].map(|n| ErrorName::parse(n).unwrap());
    /// let terms = names.map(|name| Term::location(&machine, name).unwrap());
    /// // Both known to 1 µm, but only their sum: they are wrong by opposite amounts.
    /// let c = DMatrix::from_row_slice(2, 2, &[1e-6, -1e-6, -1e-6, 1e-6]);
    /// let known = UncertaintyFactors::of_fit(&machine, &terms, &c);
    /// assert_eq!(known.factors(), 2); // that of EX0X in the file, which counts no more, and one
    /// let errors = known.at(&machine, &[0.0; 6], &[0.0; 6]).displaced(&Default::default(), 1, 1.0);
    /// let moved = terms.map(|t| errors.get(t.index));
    /// assert!((moved[0].abs() - 1e-3).abs() < 1e-12 && (moved[0] + moved[1]).abs() < 1e-12);
    /// ```
    pub fn of_fit(machine: &Machine, terms: &[Term], covariance: &DMatrix<f64>) -> Self {
        let mut known = Self::stated(machine);
        for (i, (index, _)) in machine.stated_errors().iter().enumerate() {
            known.is_fitted[i] = terms.iter().any(|t| t.index == *index);
        }
        if machine.joint().is_some_and(|joint| terms.iter().any(|t| joint.has(t.index))) {
            let names = machine.joint().map_or(&[][..], |joint| joint.names());
            let both = known.quantities.iter().zip(&mut known.is_fitted);
            both.for_each(|(quantity, is_fitted)| *is_fitted |= names.contains(quantity));
        }
        known.terms = terms.to_vec();
        known.root = root(&covariance.view((0, 0), (terms.len(), terms.len())).into_owned());
        known
    }

    /// The errors and coefficients without a stated uncertainty.
    pub fn unknown(&self, machine: &Machine) -> Vec<String> {
        let stated = machine.stated_errors().into_iter().zip(&self.is_fitted);
        let without = stated.filter(|((index, _), is_fitted)| {
            let body = &machine.bodies()[index.body];
            let stated = body.stated(index.kind, index.component);
            !**is_fitted && stated.is_some_and(|s| s.u.is_none())
        });
        let mut names: Vec<String> = without.map(|((_, name), _)| name.to_string()).collect();
        names.extend(machine.coefficients_without_u());
        names
    }

    /// How many factors there are.
    pub fn factors(&self) -> usize {
        self.quantities.len() + self.root.ncols()
    }

    /// The factors at a command.
    pub fn at(
        &self,
        machine: &Machine,
        command: &Command,
        approach: &Approach,
    ) -> LocalFactors<'_> {
        let stated = machine.uncertainties_at(command, &self.quantities);
        let shapes = self.terms.iter().map(|t| t.value(command, approach)).collect();
        LocalFactors { known: self, stated, shapes }
    }
}

impl LocalFactors<'_> {
    /// The errors where one factor is `z`.
    pub fn displaced(&self, errors: &ErrorValues, factor: usize, z: f64) -> ErrorValues {
        let stated = self.known.quantities.len();
        if factor < stated {
            return match self.known.is_fitted[factor] {
                true => *errors,
                false => self.stated.displaced_by(errors, factor, z),
            };
        }
        let mut displaced = *errors;
        self.move_by(&mut displaced, factor - stated, z);
        displaced
    }

    fn move_by(&self, errors: &mut ErrorValues, column: usize, z: f64) {
        let terms = self.known.terms.iter().zip(&self.shapes).enumerate();
        for (k, (term, shape)) in terms {
            errors.add(term.index, z * self.known.root[(k, column)] * shape);
        }
    }

    /// The standard uncertainty of one error here, mm or rad.
    pub fn u(&self, index: ErrorIndex) -> f64 {
        let none = ErrorValues::default();
        let squares = (0..self.known.factors())
            .map(|factor| self.displaced(&none, factor, 1.0).get(index).powi(2));
        squares.sum::<f64>().sqrt()
    }
}

/// L with L·Lᵀ = C, without the columns that are zero.
///
/// C mixes mm and rad, so its correlations are decomposed, not C itself.
fn root(covariance: &DMatrix<f64>) -> DMatrix<f64> {
    let u = covariance.diagonal().map(|v| v.max(0.0).sqrt());
    let scale = u.map(|u| if u > 0.0 { u } else { 1.0 });
    let n = covariance.nrows();
    let correlation = DMatrix::from_fn(n, n, |i, j| covariance[(i, j)] / (scale[i] * scale[j]));
    let eigen = SymmetricEigen::new(correlation);
    let least = f64::EPSILON * n as f64;
    let kept: Vec<usize> = (0..n).filter(|k| eigen.eigenvalues[*k] > least).collect();
    DMatrix::from_fn(n, kept.len(), |i, k| {
        scale[i] * eigen.eigenvectors[(i, kept[k])] * eigen.eigenvalues[kept[k]].sqrt()
    })
}
