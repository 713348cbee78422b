//! How much of the variance of an output each group of inputs makes: indices of Sobol'.
//!
//! ```text
//! first:  S = E[(f(B) − μ)·(f(A_B) − f(A))] / V          what fixing the group would take away on average
//! total:  T = E[(f(A) − f(A_B))²] / (2V)                 what remains if only the group varies: with all interactions
//! u of a ratio m(t)/m(v):  s(t − S·v) / (m(v)·√N)                                              docs/model.md eq. 340
//! ```
//!
//! A and B are independent rows of inputs, A_B is A with the group from B.
//!
//! *Source:* A. Saltelli et al., Variance based sensitivity analysis of model output, Computer Physics Communications 181
//! (2010), table 2, (b) and (f); the uncertainty by the delta method.

/// A share of the variance with its uncertainty.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Share {
    /// The share. Unit: 1.
    pub ratio: f64,
    /// Its standard uncertainty, from the spread of the rows. Unit: 1.
    pub u_ratio: f64,
}

/// The shares of one group.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GroupShares {
    /// Of the group alone.
    pub first: Share,
    /// Of the group with all its interactions.
    pub total: Share,
}

/// One output at the rows of A, of B, and of A with each group from B.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Rows {
    /// At A. Unit: that of the output.
    pub a: Vec<f64>,
    /// At B. Unit: that of the output.
    pub b: Vec<f64>,
    /// Of each group, at A with the group from B. Unit: that of the output.
    pub mixed: Vec<Vec<f64>>,
}

impl Rows {
    /// The shares of all groups; none where the output does not vary.
    ///
    /// ```
    /// use trueaxis_study::sensitivity::Rows;
    /// // f = 3x + 4y at independent rows of ±1: 9/25 and 16/25 of the variance.
    /// let (mut rows, mut at) = (Rows { mixed: vec![vec![], vec![]], ..Rows::default() }, 0);
    /// for bits in 0..16 {
    ///     let sign = |k: i32| if bits >> k & 1 == 1 { 1.0 } else { -1.0 };
    ///     rows.a.push(3.0 * sign(0) + 4.0 * sign(1));
    ///     rows.b.push(3.0 * sign(2) + 4.0 * sign(3));
    ///     rows.mixed[0].push(3.0 * sign(2) + 4.0 * sign(1));
    ///     rows.mixed[1].push(3.0 * sign(0) + 4.0 * sign(3));
    /// }
    /// let shares = rows.shares().unwrap();
    /// assert!((shares[0].first.ratio - 0.36).abs() < 1e-12);
    /// assert!((shares[1].total.ratio - 0.64).abs() < 1e-12);
    /// ```
    pub fn shares(&self) -> Option<Vec<GroupShares>> {
        let n = self.a.len() as f64;
        let mean = (self.a.iter().sum::<f64>() + self.b.iter().sum::<f64>()) / (2.0 * n);
        let square = |(a, b): (&f64, &f64)| 0.5 * ((a - mean).powi(2) + (b - mean).powi(2));
        let squares: Vec<f64> = self.a.iter().zip(&self.b).map(square).collect();
        let variance = squares.iter().sum::<f64>() / n;
        // Rounding of equal values is no variance.
        if !(variance > (1e-12 * mean).powi(2) && variance > 0.0) {
            return None;
        }
        let share = |terms: Vec<f64>| {
            let ratio = terms.iter().sum::<f64>() / n / variance;
            let rest = terms.iter().zip(&squares).map(|(t, v)| (t - ratio * v).powi(2));
            let u_ratio = (rest.sum::<f64>() / (n - 1.0) / n).sqrt() / variance;
            Share { ratio, u_ratio }
        };
        let of = |mixed: &Vec<f64>| {
            let rows = self.a.iter().zip(&self.b).zip(mixed);
            GroupShares {
                first: share(rows.clone().map(|((a, b), m)| (b - mean) * (m - a)).collect()),
                total: share(rows.map(|((a, _), m)| 0.5 * (a - m).powi(2)).collect()),
            }
        };
        Some(self.mixed.iter().map(of).collect())
    }
}
