//! Correlated inputs, by their normal scores (a Gaussian copula).
//!
//! ```text
//! R = L·Lᵀ,   z = L·z₀,   value = quantile of its own distribution at Φ(z)                     docs/model.md eq. 342
//! ```

use nalgebra::DMatrix;

/// Inputs that are correlated with each other.
#[derive(Debug, Clone, PartialEq)]
pub struct Correlation {
    inputs: Vec<usize>,
    root: DMatrix<f64>,
}

impl Correlation {
    /// From pairs of inputs with their coefficients; none if no distribution has these coefficients.
    ///
    /// ```
    /// use trueaxis_study::Correlation;
    /// assert!(Correlation::new(&[(0, 1, 0.9), (1, 2, 0.9), (0, 2, 0.7)]).is_some());
    /// // What is like the same thing twice cannot be opposite to each other.
    /// assert!(Correlation::new(&[(0, 1, 0.9), (1, 2, 0.9), (0, 2, -0.9)]).is_none());
    /// ```
    pub fn new(pairs: &[(usize, usize, f64)]) -> Option<Self> {
        let mut inputs: Vec<usize> = pairs.iter().flat_map(|(a, b, _)| [*a, *b]).collect();
        inputs.sort_unstable();
        inputs.dedup();
        let at = |input: usize| inputs.iter().position(|i| *i == input);
        let mut matrix = DMatrix::identity(inputs.len(), inputs.len());
        for (a, b, coefficient) in pairs {
            let (a, b) = (at(*a)?, at(*b)?);
            matrix[(a, b)] = *coefficient;
            matrix[(b, a)] = *coefficient;
        }
        let root = matrix.cholesky()?.unpack();
        Some(Self { inputs, root })
    }

    /// The inputs that are correlated.
    pub fn inputs(&self) -> &[usize] {
        &self.inputs
    }

    /// Puts the correlated score of each input, from independent ones.
    pub fn correlate(&self, score: impl Fn(usize) -> f64, mut put: impl FnMut(usize, f64)) {
        let scores: Vec<f64> = self.inputs.iter().map(|i| score(*i)).collect();
        for (k, input) in self.inputs.iter().enumerate() {
            put(*input, (0..=k).map(|j| self.root[(k, j)] * scores[j]).sum());
        }
    }
}
