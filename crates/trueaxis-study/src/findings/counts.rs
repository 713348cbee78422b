//! Parts and machines that are good, with the interval that the number of machines allows.

use trueaxis::geometry::statistics::fisher_above;
use trueaxis::part::tolerance::Outcome;

/// How many parts and machines hold their tolerances.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Good {
    /// The share of all parts. Unit: 1.
    pub parts_ratio: f64,
    /// Its standard uncertainty: parts of one machine are alike, so that machines count; none where all machines have the same share, which
    /// says nothing of how others differ. Unit: 1.
    pub u_parts_ratio: Option<f64>,
    /// Machines that hold them on enough days.
    pub machines: usize,
    /// The share of machines. Unit: 1.
    pub machines_ratio: f64,
    /// The ends of its interval of 95 %. Unit: 1.
    pub interval_ratio: [f64; 2],
}

impl Good {
    /// Of parts machine after machine, each with its days.
    pub fn of(parts: impl Iterator<Item = bool>, days: usize, days_ratio: f64) -> Self {
        let parts: Vec<bool> = parts.collect();
        let shares: Vec<f64> = parts
            .chunks(days)
            .map(|of| of.iter().filter(|good| **good).count() as f64 / of.len() as f64)
            .collect();
        let n = shares.len() as f64;
        let parts_ratio = shares.iter().sum::<f64>() / n;
        let squares = shares.iter().map(|s| (s - parts_ratio).powi(2)).sum::<f64>();
        // 0.95 of 20 days is 19 of them, whatever the rounding of 0.95.
        let machines = shares.iter().filter(|s| **s >= days_ratio - 1e-9).count();
        Self {
            parts_ratio,
            u_parts_ratio: (squares > 0.0).then(|| (squares / (n - 1.0) / n).sqrt()),
            machines,
            machines_ratio: machines as f64 / n,
            interval_ratio: interval(machines, shares.len()),
        }
    }

    /// Whether so large a share of all machines is good, by the interval.
    pub fn outcome(&self, wanted_ratio: f64) -> Outcome {
        match self.interval_ratio {
            [low, _] if low >= wanted_ratio => Outcome::Pass,
            [_, high] if high < wanted_ratio => Outcome::Fail,
            _ => Outcome::Undecided,
        }
    }
}

/// The interval of 95 % of a share of which `good` of `all` were found.
///
/// ```
/// use trueaxis_study::findings::interval;
/// // Clopper and Pearson 1934: of 10 none is found; the share is at most 1 − 0.025^(1/10).
/// let [low, high] = interval(0, 10);
/// assert_eq!(low, 0.0);
/// assert!((high - (1.0 - 0.025f64.powf(0.1))).abs() < 1e-9);
/// ```
///
/// *Source:* C. J. Clopper, E. S. Pearson, Biometrika 26 (1934), by quantiles of F (Johnson, Kotz, Kemp, Univariate Discrete
/// Distributions).
pub fn interval(good: usize, all: usize) -> [f64; 2] {
    let (k, n) = (good as f64, all as f64);
    let low = match good {
        0 => 0.0,
        _ => k / (k + (n - k + 1.0) * fisher_above(0.025, 2.0 * (n - k + 1.0), 2.0 * k)),
    };
    let high = match good == all {
        true => 1.0,
        false => {
            let f = (k + 1.0) * fisher_above(0.025, 2.0 * (k + 1.0), 2.0 * (n - k));
            f / (n - k + f)
        }
    };
    [low, high]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// scipy.stats.binomtest(k, n).proportion_ci(method="exact"): oracles/sobol.py.
    #[test]
    fn intervals_are_those_of_scipy() {
        let cases = [
            (9, 10, [0.554_983_882_971_804_7, 0.997_471_421_455_537_5]),
            (950, 1000, [0.934_609_512_084_506_4, 0.962_664_602_395_339_4]),
        ];
        for (good, all, expected) in cases {
            let found = interval(good, all);
            for (f, e) in found.iter().zip(expected) {
                assert!((f - e).abs() < 1e-7, "{good} of {all}: {found:?}");
            }
        }
    }

    #[test]
    fn a_machine_is_good_on_enough_of_its_days() {
        // Three machines with four days: 4, 3 and 0 good ones.
        let parts = [true, true, true, true, true, false, true, true, false, false, false, false];
        let found = Good::of(parts.into_iter(), 4, 0.75);
        assert_eq!(found.machines, 2);
        assert!((found.parts_ratio - 7.0 / 12.0).abs() < 1e-15);
        assert_eq!(Good::of(parts.into_iter(), 4, 1.0).machines, 1);
    }
}
