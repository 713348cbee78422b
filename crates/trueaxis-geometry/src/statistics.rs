//! Quantiles of distributions for statistical tests, and pseudo-random numbers.

use std::f64::consts::TAU;

/// The probability that a standard-normal number exceeds z.
pub fn normal_tail(z: f64) -> f64 {
    if z < 0.0 {
        return 1.0 - normal_tail(-z);
    }
    let density = (-0.5 * z * z).exp() / TAU.sqrt();
    if z < 3.0 {
        // Φ(z) − 1/2 = φ(z) (z + z³/3 + z⁵/(3·5) + …)
        let (mut term, mut sum, mut k) = (z, z, 1.0);
        while term > 1e-17 * sum {
            k += 2.0;
            term *= z * z / k;
            sum += term;
        }
        return 0.5 - density * sum;
    }
    // Laplace's continued fraction: φ(z)/(z + 1/(z + 2/(z + …)))
    let below = (1..=60).rev().fold(z, |below, k| z + f64::from(k) / below);
    density / below
}

/// The z that a standard-normal number exceeds with this probability.
///
/// ```
/// let z = trueaxis_geometry::statistics::normal_quantile_above(0.025);
/// assert!((z - 1.959_964).abs() < 1e-6);
/// ```
pub fn normal_quantile_above(tail: f64) -> f64 {
    if tail > 0.5 {
        return -normal_quantile_above(1.0 - tail);
    }
    let (mut low, mut high) = (0.0, 38.0);
    for _ in 0..80 {
        let middle = 0.5 * (low + high);
        if normal_tail(middle) > tail { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

/// The value that χ² with these degrees of freedom exceeds with this probability (Wilson and
/// Hilferty).
pub fn chi_square_above(tail: f64, degrees_of_freedom: f64) -> f64 {
    let a = 2.0 / (9.0 * degrees_of_freedom.max(1e-9));
    let root = 1.0 - a + normal_quantile_above(tail) * a.sqrt();
    degrees_of_freedom * root.max(0.0).powi(3)
}

/// The value that Student's t exceeds with this probability (Cornish and Fisher, third order).
pub fn student_above(tail: f64, degrees_of_freedom: f64) -> f64 {
    let z = normal_quantile_above(tail);
    let n = degrees_of_freedom.max(1.0);
    let z2 = z * z;
    let first = z * (z2 + 1.0) / 4.0;
    let second = z * (5.0 * z2 * z2 + 16.0 * z2 + 3.0) / 96.0;
    let third = z * (3.0 * z2.powi(3) + 19.0 * z2 * z2 + 17.0 * z2 - 15.0) / 384.0;
    z + first / n + second / (n * n) + third / n.powi(3)
}

/// Standard deviation from the median of the absolute values, robust against outliers.
///
/// 1.4826 is 1/Φ⁻¹(3/4).
pub fn robust_deviation(values: impl Iterator<Item = f64>) -> f64 {
    let mut sizes: Vec<f64> = values.map(f64::abs).collect();
    if sizes.is_empty() {
        return 0.0;
    }
    let middle = sizes.len() / 2;
    let (_, median, _) = sizes.select_nth_unstable_by(middle, f64::total_cmp);
    1.482_602_2 * *median
}

/// Numbers without a pattern that are the same in every run (splitmix64; Steele, Lea, Flood 2014).
#[derive(Debug, Clone)]
pub struct SplitMix64(u64);

impl SplitMix64 {
    /// The numbers of a seed.
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// Any number.
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// In 0..1.
    pub fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1u64 << 53) as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_of_the_tables() {
        // χ²(0.99; 10) = 23.209, t(0.975; 10) = 2.228, t(0.995; 30) = 2.750
        assert!((chi_square_above(0.01, 10.0) - 23.209).abs() < 0.05);
        assert!((student_above(0.025, 10.0) - 2.228).abs() < 2e-3);
        assert!((student_above(0.005, 30.0) - 2.750).abs() < 1e-3);
        assert!((normal_quantile_above(1e-6) - 4.753_424).abs() < 1e-5);
    }
}
