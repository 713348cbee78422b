//! Errors that are known better together than each alone: a covariance instead of one uncertainty for each.
//!
//! ```text
//!     E(q) = Ê(q) + Σ_j z_j Σ_k L_kj φ_k(q),   L Lᵀ = C      z_j independent, standard normal      docs/model.md eq. 310
//! ```

use super::{Curve, ErrorIndex, ErrorName, Uncertainties};
use nalgebra::{DMatrix, SymmetricEigen};

/// A covariance may have eigenvalues below zero by rounding, in units of its correlations.
const ROUNDING: f64 = 1e-6;

/// A known function of the position of one axis, and the factor that was found for it.
#[derive(Debug, Clone, PartialEq)]
pub struct JointFunction {
    /// The error that it is part of.
    pub index: ErrorIndex,
    /// Its name.
    pub error: ErrorName,
    /// φ.
    pub curve: Curve,
    /// Its factor. Unit: mm or rad.
    pub value: f64,
}

/// Errors with the covariance of their factors.
#[derive(Debug, Clone, PartialEq)]
pub struct JointErrors {
    /// The file that it was read from.
    file: String,
    functions: Vec<JointFunction>,
    /// L: a row for each function.
    root: DMatrix<f64>,
    names: Vec<String>,
}

impl JointErrors {
    /// From a covariance of the factors, mm and rad; `None` if it is none.
    ///
    /// ```
    /// use nalgebra::DMatrix;
    /// use trueaxis_machine::{Machine, file::NoTables};
    /// use trueaxis_machine::errors::{Curve, ErrorName, JointErrors, JointFunction};
    /// let text = "[machine]\nname = \"m\"\nchain = \"w b X Y Z t\"\n[location]\nEX0X = \"1 um\"\nEX0Y = \"2 um\"";
    /// let machine = Machine::check("m.toml", text, &NoTables).0.unwrap();
    /// let function = |name: &str, value| {
    ///     let error = ErrorName::parse(name).unwrap();
    ///     let index = machine.error_index(error).unwrap();
    ///     JointFunction { index, error, curve: Curve::Constant(1.0), value }
    /// };
    /// // Both are known to 1 µm, but their sum is known exactly.
    /// let c = DMatrix::from_row_slice(2, 2, &[1e-6, -1e-6, -1e-6, 1e-6]);
    /// let functions = vec![function("EX0X", 0.001), function("EX0Y", 0.002)];
    /// let joint = JointErrors::new("c.toml".into(), functions, &c).unwrap();
    /// let machine = machine.with_joint(joint);
    /// let names = machine.uncertain_quantities();
    /// assert_eq!(names.len(), 3); // EX0X, EX0Y, and one factor of both
    /// let u = machine.uncertainties_at(&[0.0; 6], &names);
    /// let moved = u.displaced_by(&Default::default(), 2, 1.0);
    /// assert!((moved.bodies[1].location.0[0] + moved.bodies[2].location.0[0]).abs() < 1e-15);
    /// assert!((u.of_errors().bodies[1].location.0[0] - 0.001).abs() < 1e-15);
    /// ```
    pub fn new(
        file: String,
        mut functions: Vec<JointFunction>,
        covariance: &DMatrix<f64>,
    ) -> Option<Self> {
        // Functions of one error stand together.
        let mut order: Vec<usize> = (0..functions.len()).collect();
        order.sort_by_key(|k| functions[*k].index);
        let root = root(&covariance.select_rows(&order).select_columns(&order))?;
        functions.sort_by_key(|f| f.index);
        let names = (0..root.ncols()).map(|j| name(&functions, &root, j)).collect();
        Some(Self { file, functions, root, names })
    }

    /// The file that it was read from.
    pub fn file(&self) -> &str {
        &self.file
    }

    /// The functions with their factors; those of one error stand together.
    pub fn functions(&self) -> &[JointFunction] {
        &self.functions
    }

    /// Whether an error is among them.
    pub fn has(&self, index: ErrorIndex) -> bool {
        self.functions.iter().any(|f| f.index == index)
    }

    /// What each independent factor is called.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// The others, without an error.
    pub(crate) fn without(&self, index: ErrorIndex) -> Option<Self> {
        let keep: Vec<usize> =
            (0..self.functions.len()).filter(|k| self.functions[*k].index != index).collect();
        let functions: Vec<JointFunction> =
            keep.iter().map(|k| self.functions[*k].clone()).collect();
        (!functions.is_empty()).then(|| Self {
            functions,
            root: self.root.select_rows(&keep),
            ..self.clone()
        })
    }

    /// Adds what each factor moves where the axis of each error stands, as quantities from `first` on.
    pub(crate) fn add_to(
        &self,
        found: &mut Uncertainties,
        first: usize,
        position: impl Fn(ErrorIndex) -> f64,
    ) {
        let shape = |f: &JointFunction| f.curve.at(position(f.index)).unwrap_or(0.0);
        let shapes: Vec<f64> = self.functions.iter().map(shape).collect();
        for j in 0..self.root.ncols() {
            let mut k = 0;
            for run in self.functions.chunk_by(|a, b| a.index == b.index) {
                let of_run = k..k + run.len();
                let moved = of_run.clone().map(|i| self.root[(i, j)] * shapes[i]).sum();
                found.add(first + j, run[0].index, moved);
                k = of_run.end;
            }
        }
    }
}

/// `combination 3 (EC0Y, EXX)`: by the two errors with the largest parts in it.
fn name(functions: &[JointFunction], root: &DMatrix<f64>, j: usize) -> String {
    let part = |k: &usize| {
        let u = root.row(*k).norm();
        if u > 0.0 { root[(*k, j)].abs() / u } else { 0.0 }
    };
    let mut order: Vec<usize> = (0..functions.len()).collect();
    order.sort_by(|a, b| part(b).total_cmp(&part(a)));
    let mut largest: Vec<String> = Vec::new();
    for name in order.iter().map(|k| functions[*k].error.to_string()) {
        if largest.len() < 2 && !largest.contains(&name) {
            largest.push(name);
        }
    }
    format!("combination {} ({})", j + 1, largest.join(", "))
}

/// L with L·Lᵀ = C, without the columns that are zero; mm and rad differ by powers of ten, so correlations are
/// decomposed.
fn root(covariance: &DMatrix<f64>) -> Option<DMatrix<f64>> {
    let n = covariance.nrows();
    if !covariance.iter().all(|v| v.is_finite()) || covariance.diagonal().iter().any(|v| *v < 0.0) {
        return None;
    }
    let u = covariance.diagonal().map(f64::sqrt);
    let scale = u.map(|u| if u > 0.0 { u } else { 1.0 });
    let correlation = DMatrix::from_fn(n, n, |i, j| covariance[(i, j)] / (scale[i] * scale[j]));
    let eigen = SymmetricEigen::new(correlation);
    if eigen.eigenvalues.iter().any(|v| *v < -ROUNDING) {
        return None;
    }
    let least = f64::EPSILON * n as f64;
    let mut kept: Vec<usize> = (0..n).filter(|k| eigen.eigenvalues[*k] > least).collect();
    kept.sort_by(|a, b| eigen.eigenvalues[*b].total_cmp(&eigen.eigenvalues[*a]));
    Some(DMatrix::from_fn(n, kept.len(), |i, k| {
        scale[i] * eigen.eigenvectors[(i, kept[k])] * eigen.eigenvalues[kept[k]].sqrt()
    }))
}
