//! Degrees of freedom and coverage factors of the GUM: docs/model.md eq. 250, 251.

/// From so many degrees of freedom on the distribution is normal for this purpose.
const MANY: f64 = 1000.0;
/// The coverage probability at k = 2 of a normal distribution.
const PROBABILITY: f64 = 0.954_499_736_103_641_6;

/// A standard uncertainty with its degrees of freedom; without any number of them it is known as well as a standard states it.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Contribution {
    /// The standard uncertainty. Unit: mm or rad.
    pub u: f64,
    /// Its degrees of freedom; `None`: infinitely many. Unit: 1.
    pub degrees_of_freedom: Option<f64>,
}

/// A combined uncertainty, expanded.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Expanded {
    /// The combined standard uncertainty. Unit: mm or rad.
    pub u: f64,
    /// Effective degrees of freedom; `None`: infinitely many. Unit: 1.
    pub degrees_of_freedom: Option<f64>,
    /// k. Unit: 1.
    pub coverage_factor: f64,
}

impl Expanded {
    /// U = k u. Unit: mm or rad.
    pub fn expanded(&self) -> f64 {
        self.coverage_factor * self.u
    }

    /// The same in another unit.
    pub fn scaled(self, factor: f64) -> Self {
        Self { u: self.u * factor.abs(), ..self }
    }
}

/// The contributions combined by Welch and Satterthwaite, expanded to 95.45 %.
///
/// ```
/// use trueaxis_standards::coverage::{Contribution, combine};
/// // GUM H.1.6 in nm: 25, 9.7, 2.9, 16.6 with 18, 25.6, 50, 2: u = 32, ν = 16.
/// let known = [(25.0, 18.0), (9.7, 25.6), (2.9, 50.0), (16.6, 2.0)];
/// let known = known.map(|(u, n)| Contribution { u, degrees_of_freedom: Some(n) });
/// let all = combine(&known);
/// assert!((all.u - 31.7).abs() < 0.1 && (all.degrees_of_freedom.unwrap() - 16.7).abs() < 0.1);
/// ```
pub fn combine(contributions: &[Contribution]) -> Expanded {
    let squares: f64 = contributions.iter().map(|c| c.u * c.u).sum();
    let fourth: f64 = contributions
        .iter()
        .filter_map(|c| Some(c.u.powi(4) / c.degrees_of_freedom?.max(f64::MIN_POSITIVE)))
        .sum();
    let degrees_of_freedom = (fourth > 0.0).then(|| squares * squares / fourth);
    let coverage_factor = coverage_factor(degrees_of_freedom);
    Expanded { u: squares.sqrt(), degrees_of_freedom, coverage_factor }
}

/// k for 95.45 %: the quantile of Student's t, the degrees of freedom cut to a whole number (GUM G.4.2), at least one.
///
/// ```
/// use trueaxis_standards::coverage::coverage_factor;
/// assert_eq!(coverage_factor(None), 2.0);
/// assert!((coverage_factor(Some(4.9)) - 2.87).abs() < 0.005); // GUM table G.2, ν = 4
/// ```
pub fn coverage_factor(degrees_of_freedom: Option<f64>) -> f64 {
    let Some(count) = degrees_of_freedom.filter(|n| *n < MANY) else { return 2.0 };
    let count = count.floor().max(1.0) as u32;
    let (mut low, mut high) = (1.0, 20.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if within(middle, count) < PROBABILITY { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

/// The probability that |t| with a whole number of degrees of freedom is below a value: Abramowitz and Stegun 26.7.3, 26.7.4.
fn within(t: f64, count: u32) -> f64 {
    let angle = (t / f64::from(count).sqrt()).atan();
    let (sin, cos) = angle.sin_cos();
    let odd = count % 2 == 1;
    let (mut term, mut sum) = if odd { (cos, 0.0) } else { (1.0, 0.0) };
    // Powers of the cosine up to ν − 2: 1, 3, 5 … or 0, 2, 4 …
    let mut power = u32::from(odd);
    while power + 2 <= count {
        sum += term;
        let (above, below) = (f64::from(power + 1), f64::from(power + 2));
        term *= cos * cos * above / below;
        power += 2;
    }
    match odd {
        true => std::f64::consts::FRAC_2_PI * (angle + sin * sum),
        false => sin * sum,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Table G.2 of JCGM 100:2008, column 95.45 %.
    #[test]
    fn paper_coverage_factors_of_the_gum() {
        for (count, k) in [
            (1, 13.97),
            (2, 4.53),
            (3, 3.31),
            (4, 2.87),
            (5, 2.65),
            (6, 2.52),
            (7, 2.43),
            (8, 2.37),
            (9, 2.32),
            (10, 2.28),
            (15, 2.18),
            (20, 2.13),
            (25, 2.11),
            (30, 2.09),
            (40, 2.06),
            (50, 2.05),
            (100, 2.025),
        ] {
            let found = coverage_factor(Some(f64::from(count)));
            assert!((found - k).abs() <= 0.0051, "{count}: {found}, not {k}");
        }
        assert!((coverage_factor(Some(0.2)) - 13.97).abs() < 0.01);
    }

    #[test]
    fn one_contribution_keeps_its_degrees_of_freedom() {
        let one = combine(&[Contribution { u: 2.0, degrees_of_freedom: Some(4.0) }]);
        assert_eq!((one.u, one.degrees_of_freedom), (2.0, Some(4.0)));
        let known = Contribution { u: 3.0, degrees_of_freedom: None };
        let with = combine(&[Contribution { u: 4.0, degrees_of_freedom: Some(4.0) }, known]);
        // 5⁴ / (4⁴/4) = 625/64
        assert!((with.degrees_of_freedom.unwrap() - 625.0 / 64.0).abs() < 1e-12);
        assert_eq!(combine(&[known]).degrees_of_freedom, None);
        assert_eq!(combine(&[]).expanded(), 0.0);
    }
}
