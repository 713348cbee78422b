//! Distributions and their quantiles for statistical tests, and pseudo-random numbers.
//!
//! The distribution functions are those of `statrs`; the quantiles are their roots, found here by Newton's
//! method on logarithms (docs/model.md eq. 270), because the `inverse_cdf` of `statrs` is less accurate.
//!
//! ```text
//!     ln P(e^y) = ln p,     y ← y − (ln P − ln p) P / (x f(x)),   x = e^y                        docs/model.md eq. 270
//! ```

use statrs::function::beta::{beta_reg, ln_beta};
use statrs::function::erf::{erfc, erfc_inv};
use statrs::function::gamma::{gamma_lr, gamma_ur, ln_gamma};
use std::f64::consts::SQRT_2;

/// The probability that a standard-normal number lies within ±2: what a coverage factor of 2 is meant to cover.
pub const WITHIN_TWO: f64 = 0.954_499_736_103_641_6;

/// From here on Student's t has a series that is exact to the last digit but a few; the incomplete
/// beta function loses digits instead.
const MANY: f64 = 1e4;

/// The probability that a standard-normal number exceeds z.
pub fn normal_tail(z: f64) -> f64 {
    0.5 * erfc(z / SQRT_2)
}

/// The z that a standard-normal number exceeds with this probability.
///
/// ```
/// let z = trueaxis_geometry::statistics::normal_quantile_above(0.025);
/// assert!((z - 1.959_963_984_540_054).abs() < 1e-14);
/// ```
pub fn normal_quantile_above(tail: f64) -> f64 {
    SQRT_2 * erfc_inv(2.0 * tail)
}

/// The probability that χ² with these degrees of freedom exceeds this value.
pub fn chi_square_tail(value: f64, degrees_of_freedom: f64) -> f64 {
    if value <= 0.0 || degrees_of_freedom <= 0.0 {
        return if value < 0.0 || degrees_of_freedom > 0.0 { 1.0 } else { 0.0 };
    }
    gamma_ur(0.5 * degrees_of_freedom, 0.5 * value)
}

/// The value that χ² with these degrees of freedom exceeds with this probability; 0 without degrees of
/// freedom.
pub fn chi_square_above(tail: f64, degrees_of_freedom: f64) -> f64 {
    let a = 0.5 * degrees_of_freedom;
    if a <= 0.0 || tail >= 1.0 {
        return 0.0;
    }
    // Wilson and Hilferty, to start from.
    let width = 2.0 / (9.0 * degrees_of_freedom);
    let start = 1.0 - width + normal_quantile_above(tail) * width.sqrt();
    let start = degrees_of_freedom * start.max(0.01).powi(3);
    let log_gamma = ln_gamma(a);
    root(start, tail, |x| Sides {
        above: gamma_ur(a, 0.5 * x),
        below: gamma_lr(a, 0.5 * x),
        slope: (a * (0.5 * x).ln() - 0.5 * x - log_gamma).exp(),
    })
}

/// The value that Fisher's F with these degrees of freedom exceeds with this probability; infinite
/// without degrees of freedom of its divisor.
///
/// Within 2·10⁻⁹ of its value.
pub fn fisher_above(tail: f64, above: f64, below: f64) -> f64 {
    if above <= 0.0 || tail >= 1.0 {
        return 0.0;
    }
    if below <= 0.0 {
        return f64::INFINITY;
    }
    let rough = fisher_of_many(tail, above, below);
    if above > MANY && below > MANY {
        return rough;
    }
    let (a, b) = (0.5 * above, 0.5 * below);
    let log_beta = ln_beta(a, b);
    let start = if rough.is_finite() && above > 2.0 && below > 2.0 { rough } else { 1.0 };
    root(start, tail, |x| {
        let (part, rest) = (above * x / (below + above * x), below / (below + above * x));
        Sides {
            above: beta_reg(b, a, rest),
            below: beta_reg(a, b, part),
            slope: (a * part.ln() + b * rest.ln() - log_beta).exp(),
        }
    })
}

/// Fisher's F of many degrees of freedom (Abramowitz and Stegun 26.6.16 with 26.5.22).
fn fisher_of_many(tail: f64, above: f64, below: f64) -> f64 {
    let z = normal_quantile_above(tail);
    let lambda = (z * z - 3.0) / 6.0;
    let (a, b) = (1.0 / (above - 1.0), 1.0 / (below - 1.0));
    let h = 2.0 / (a + b);
    let w = z * (h + lambda).sqrt() / h - (a - b) * (lambda + 5.0 / 6.0 - 2.0 / (3.0 * h));
    (2.0 * w).exp()
}

/// The value that Student's t exceeds with this probability; infinite without degrees of freedom.
///
/// t² of ν degrees of freedom is F of 1 and ν; from 10 000 on the series of Cornish and Fisher.
pub fn student_above(tail: f64, degrees_of_freedom: f64) -> f64 {
    let n = degrees_of_freedom;
    if tail > 0.5 {
        return -student_above(1.0 - tail, n);
    }
    if n <= 0.0 {
        return f64::INFINITY;
    }
    if n < MANY {
        return fisher_above(2.0 * tail, 1.0, n).sqrt();
    }
    let z = normal_quantile_above(tail);
    let z2 = z * z;
    let first = z * (z2 + 1.0) / 4.0;
    let second = z * (5.0 * z2 * z2 + 16.0 * z2 + 3.0) / 96.0;
    let third = z * (3.0 * z2.powi(3) + 19.0 * z2 * z2 + 17.0 * z2 - 15.0) / 384.0;
    z + first / n + second / (n * n) + third / n.powi(3)
}

/// The coverage factor of ν degrees of freedom for the probability that 2 has of a normal distribution,
/// 95.45 % (GUM G.3, table G.2).
pub fn coverage_factor(degrees_of_freedom: f64) -> f64 {
    student_above(0.5 * (1.0 - WITHIN_TWO), degrees_of_freedom)
}

/// The probabilities beyond and up to x, and x times the density.
struct Sides {
    above: f64,
    below: f64,
    slope: f64,
}

/// The x that is exceeded with this probability: Newton's method on the logarithm of the smaller side,
/// halved where it would leave what is known to contain x.
fn root(start: f64, tail: f64, sides: impl Fn(f64) -> Sides) -> f64 {
    if tail <= 0.0 {
        return f64::INFINITY;
    }
    let (mut low, mut high) = (f64::MIN_POSITIVE.ln(), f64::MAX.ln());
    let mut y = start.ln().clamp(low, high);
    for _ in 0..200 {
        let found = sides(y.exp());
        // How much too large the logarithm of the side is, and its slope over y.
        let (excess, slope) = match tail <= 0.5 {
            true => ((found.above / tail).ln(), -found.slope / found.above),
            false => ((found.below / (1.0 - tail)).ln(), found.slope / found.below),
        };
        let too_small = (excess > 0.0) == (tail <= 0.5);
        if too_small {
            low = y;
        } else {
            high = y;
        }
        let next = y - excess / slope;
        let next = if next > low && next < high { next } else { 0.5 * (low + high) };
        if (next - y).abs() <= 1e-15 * (1.0 + y.abs()) || excess == 0.0 {
            return if excess == 0.0 { y.exp() } else { next.exp() };
        }
        y = next;
    }
    y.exp()
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

/// Standard deviation within groups, and its degrees of freedom; none where no group has two values.
///
/// The squares about the mean of each group, over Σ (n − 1) (GUM, JCGM 100:2008, H.3.6 and H.5.2).
///
/// ```
/// use trueaxis_geometry::statistics::pooled_deviation;
/// // 1, 3 about 2; 10, 10, 13 about 11; a single value tells nothing: √((2 + 6) / (1 + 2)).
/// let groups = [vec![1.0, 3.0], vec![10.0, 10.0, 13.0], vec![99.0]];
/// let (s, freedom) = pooled_deviation(groups.iter().map(Vec::as_slice)).unwrap();
/// assert!((s - (8.0_f64 / 3.0).sqrt()).abs() < 1e-15 && freedom == 3.0);
/// ```
pub fn pooled_deviation<'a>(groups: impl Iterator<Item = &'a [f64]>) -> Option<(f64, f64)> {
    let (mut squares, mut free) = (0.0, 0.0);
    for group in groups {
        let mean = group.iter().sum::<f64>() / group.len() as f64;
        squares += group.iter().map(|v| (v - mean).powi(2)).sum::<f64>();
        free += group.len() as f64 - 1.0;
    }
    (free > 0.0).then(|| ((squares / free).sqrt(), free))
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
        // χ²(0.99; 10) = 23.209, t(0.975; 10) = 2.228, t(0.995; 30) = 2.750, F(0.95; 3, 20) = 3.098
        assert!((chi_square_above(0.01, 10.0) - 23.209).abs() < 5e-4);
        assert!((student_above(0.025, 10.0) - 2.228).abs() < 5e-4);
        assert!((student_above(0.005, 30.0) - 2.750).abs() < 5e-4);
        assert!((fisher_above(0.05, 3.0, 20.0) - 3.098).abs() < 5e-4);
        assert!((normal_quantile_above(1e-6) - 4.753_424).abs() < 1e-6);
        // GUM, table G.2, 95.45 %
        for (n, k) in [(1.0, 13.97), (2.0, 4.53), (3.0, 3.31), (10.0, 2.28), (50.0, 2.05)] {
            assert!((coverage_factor(n) - k).abs() < 0.005, "{n}: {}", coverage_factor(n));
        }
    }

    #[test]
    fn without_degrees_of_freedom_nothing_is_covered() {
        assert_eq!(student_above(0.025, 0.0), f64::INFINITY);
        assert_eq!(fisher_above(0.05, 3.0, 0.0), f64::INFINITY);
        assert_eq!(chi_square_above(0.05, 0.0), 0.0);
        assert_eq!((chi_square_tail(0.0, 0.0), chi_square_tail(1.0, 0.0)), (0.0, 0.0));
        assert_eq!(chi_square_tail(0.0, 3.0), 1.0);
    }
}
