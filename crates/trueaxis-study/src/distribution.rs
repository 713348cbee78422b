//! Distributions of one input, by their quantiles: a number in 0..1 becomes a value.

use trueaxis::geometry::statistics::{normal_quantile_above, normal_tail};

/// How an input is distributed (JCGM 101:2008, 6.4).
#[derive(Debug, Clone, PartialEq)]
pub enum Distribution {
    /// Mean and standard uncertainty.
    Normal {
        /// Its mean. Unit: that of the input.
        mean: f64,
        /// Its standard deviation. Unit: that of the input.
        u: f64,
    },
    /// Anywhere between two limits, equally probable.
    Uniform {
        /// Lower limit. Unit: that of the input.
        low: f64,
        /// Upper limit. Unit: that of the input.
        high: f64,
    },
    /// Between two limits, most often at a value between them.
    Triangular {
        /// Lower limit. Unit: that of the input.
        low: f64,
        /// The most probable value. Unit: that of the input.
        mode: f64,
        /// Upper limit. Unit: that of the input.
        high: f64,
    },
    /// As a sine between two limits: most often near them.
    Arcsine {
        /// Lower limit. Unit: that of the input.
        low: f64,
        /// Upper limit. Unit: that of the input.
        high: f64,
    },
    /// One of these values, equally probable; the levels of a factorial design. Unit: that of the input.
    Values(Vec<f64>),
}

impl Distribution {
    /// The value that is not exceeded with probability `p`, between 0 and 1.
    ///
    /// ```
    /// use trueaxis_study::Distribution;
    /// let triangle = Distribution::Triangular { low: 0.0, mode: 1.0, high: 3.0 };
    /// // A third of the area lies below the mode.
    /// assert!((triangle.quantile(1.0 / 3.0) - 1.0).abs() < 1e-15);
    /// let normal = Distribution::Normal { mean: 5.0, u: 2.0 };
    /// assert!((normal.quantile(0.975) - (5.0 + 2.0 * 1.959_963_984_540_054)).abs() < 1e-12);
    /// ```
    pub fn quantile(&self, p: f64) -> f64 {
        match self {
            Self::Normal { mean, u } => mean + u * normal_score(p),
            Self::Uniform { low, high } => low + p * (high - low),
            Self::Triangular { low, mode, high } => {
                let (width, below) = (high - low, mode - low);
                match p * width <= below {
                    true => low + (p * width * below).sqrt(),
                    false => high - ((1.0 - p) * width * (high - mode)).sqrt(),
                }
            }
            Self::Arcsine { low, high } => {
                let (middle, half) = (0.5 * (low + high), 0.5 * (high - low));
                middle - half * (std::f64::consts::PI * p).cos()
            }
            Self::Values(values) => {
                let at = (p * values.len() as f64) as usize;
                values[at.min(values.len() - 1)]
            }
        }
    }

    /// The value of a standard-normal score: the same probability.
    pub fn of_score(&self, z: f64) -> f64 {
        match self {
            Self::Normal { mean, u } => mean + u * z,
            // Of the nearer side, so that no digits are lost.
            _ if z > 0.0 => self.quantile(1.0 - normal_tail(z)),
            _ => self.quantile(normal_tail(-z)),
        }
    }

    /// Its mean. Unit: that of the input.
    pub fn mean(&self) -> f64 {
        match self {
            Self::Normal { mean, .. } => *mean,
            Self::Uniform { low, high } | Self::Arcsine { low, high } => 0.5 * (low + high),
            Self::Triangular { low, mode, high } => (low + mode + high) / 3.0,
            Self::Values(values) => values.iter().sum::<f64>() / values.len() as f64,
        }
    }

    /// Its standard deviation. Unit: that of the input.
    pub fn u(&self) -> f64 {
        match self {
            Self::Normal { u, .. } => *u,
            Self::Uniform { low, high } => (high - low) / 12f64.sqrt(),
            Self::Arcsine { low, high } => (high - low) / 8f64.sqrt(),
            Self::Triangular { low: a, mode: c, high: b } => {
                ((a * a + b * b + c * c - a * b - a * c - b * c) / 18.0).max(0.0).sqrt()
            }
            Self::Values(values) => {
                let mean = self.mean();
                let squares = values.iter().map(|v| (v - mean).powi(2)).sum::<f64>();
                (squares / values.len() as f64).sqrt()
            }
        }
    }

    /// In one word, as in study files.
    pub fn word(&self) -> &'static str {
        match self {
            Self::Normal { .. } => "normal",
            Self::Uniform { .. } => "uniform",
            Self::Triangular { .. } => "triangular",
            Self::Arcsine { .. } => "arcsine",
            Self::Values(_) => "values",
        }
    }
}

/// The standard-normal number that is not exceeded with probability `p`.
pub fn normal_score(p: f64) -> f64 {
    match p < 0.5 {
        true => -normal_quantile_above(p),
        false => normal_quantile_above(1.0 - p),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Mean and standard deviation are those of many quantiles, of every distribution.
    #[test]
    fn moments_are_those_of_the_quantiles() {
        let all = [
            Distribution::Normal { mean: -24.0, u: 5.0 },
            Distribution::Uniform { low: -3.0, high: 9.0 },
            Distribution::Triangular { low: -1.0, mode: 4.0, high: 5.0 },
            Distribution::Triangular { low: 0.0, mode: 0.0, high: 5.0 },
            Distribution::Arcsine { low: 2.0, high: 4.0 },
            Distribution::Values(vec![1.0, 2.0, 4.0]),
        ];
        for distribution in all {
            let n = 300_000;
            let at = |i: usize| distribution.quantile((i as f64 + 0.5) / n as f64);
            let mean = (0..n).map(at).sum::<f64>() / n as f64;
            let variance = (0..n).map(|i| (at(i) - mean).powi(2)).sum::<f64>() / n as f64;
            assert!((mean - distribution.mean()).abs() < 1e-4, "{distribution:?}: {mean}");
            let u = variance.sqrt();
            assert!((u / distribution.u() - 1.0).abs() < 1e-4, "{distribution:?}: {u}");
        }
    }

    #[test]
    fn a_score_has_the_value_of_its_probability() {
        let uniform = Distribution::Uniform { low: 0.0, high: 1.0 };
        for z in [-7.0, -1.0, 0.0, 0.3, 2.5, 7.0] {
            assert!(
                (normal_score(uniform.of_score(z)) - z).abs() < 1e-4 * z.abs().max(1e-8),
                "{z}"
            );
        }
    }
}
