//! The most informative set of measurements within a time limit: exchange of one candidate at a time.
//!
//! *Source:* Fedorov 1972 (exchange), Woodbury 1950 (update of the covariance by one pose).

use nalgebra::DMatrix;

/// Least relative gain of an exchange, so that rounding does not cause endless exchanges.
const LEAST_GAIN: f64 = 1e-6;
/// Limit for the sweeps over all poses.
const MOST_SWEEPS: usize = 30;

/// A pose that can be measured.
#[derive(Debug, Clone)]
pub struct Candidate {
    /// One column for each reading at this pose, in units of its noise: Jᵀ/u.
    pub columns: DMatrix<f64>,
    /// Duration of the measurement, s.
    pub cost_s: f64,
}

/// The quantity to be minimised.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Criterion {
    /// The sum of the variances, each in units of its permitted value.
    A,
    /// The volume of the ellipsoid of uncertainty.
    D,
}

/// The task: candidates, prior knowledge, wanted quantities and limits.
#[derive(Debug, Clone)]
pub struct Exchange {
    /// The candidate poses.
    pub candidates: Vec<Candidate>,
    /// Prior information: JᵀWJ of fixed paths and priors, regular over all unknowns.
    pub before: DMatrix<f64>,
    /// One row for each required quantity, in units of its permitted uncertainty.
    pub wanted: DMatrix<f64>,
    /// The quantity to be minimised.
    pub criterion: Criterion,
    /// Available time, s.
    pub limit_s: f64,
    /// Largest number of poses.
    pub most: usize,
}

/// The selected poses.
#[derive(Debug, Clone, PartialEq)]
pub struct Selection {
    /// Indices of the poses.
    pub poses: Vec<usize>,
    /// Total duration, s.
    pub cost_s: f64,
    /// The criterion after the greedy start and after each exchange, not increasing. Unit: 1.
    pub history: Vec<f64>,
}

impl Exchange {
    /// Selects poses one after the other by their gain per second, then exchanges them as long as
    /// the criterion decreases. No pose is selected twice; the same input gives the same poses.
    ///
    /// ```text
    ///     A: tr(L C Lᵀ)    D: log det(L C Lᵀ)    C = (M₀ + Σ Jᵀ J/u²)⁻¹           docs/model.md eq. 112
    /// ```
    pub fn choose(&self) -> Selection {
        let Some(mut c) = self.before.clone().cholesky().map(|f| f.inverse()) else {
            return Selection { poses: Vec::new(), cost_s: 0.0, history: Vec::new() };
        };
        let mut poses: Vec<usize> = Vec::new();
        let mut cost_s = 0.0;
        while poses.len() < self.most {
            let now = self.value(&c);
            let fits = |k: &usize| {
                !poses.contains(k) && cost_s + self.candidates[*k].cost_s <= self.limit_s + 1e-9
            };
            let gain = |k: usize| {
                let with = self.value(&self.with(&c, k)?);
                Some((k, (now - with) / self.candidates[k].cost_s.max(1e-9)))
            };
            let gains = (0..self.candidates.len()).filter(fits).filter_map(gain);
            let Some((best, _)) = gains.max_by(|a, b| a.1.total_cmp(&b.1).then(b.0.cmp(&a.0)))
            else {
                break;
            };
            let Some(with) = self.with(&c, best) else { break };
            c = with;
            cost_s += self.candidates[best].cost_s;
            poses.push(best);
        }
        let mut history = vec![self.value_of(&poses)];
        for _ in 0..MOST_SWEEPS {
            if !self.sweep(&mut poses, &mut cost_s, &mut history) {
                break;
            }
        }
        Selection { poses, cost_s, history }
    }

    /// Every chosen pose once against the best other one; whether anything was gained.
    fn sweep(&self, poses: &mut [usize], cost_s: &mut f64, history: &mut Vec<f64>) -> bool {
        let mut gained = false;
        for place in 0..poses.len() {
            let out = poses[place];
            // Afresh for each place, so that rounding does not add up.
            let rest: Vec<usize> = poses.iter().copied().filter(|k| *k != out).collect();
            let Some(without) = self.covariance(&rest) else { continue };
            let room = self.limit_s - (*cost_s - self.candidates[out].cost_s) + 1e-9;
            let fits = |k: &usize| !poses.contains(k) && self.candidates[*k].cost_s <= room;
            let value = |k: usize| Some((k, self.value(&self.with(&without, k)?)));
            let values = (0..self.candidates.len()).filter(fits).filter_map(value);
            let best = values.min_by(|a, b| a.1.total_cmp(&b.1).then(a.0.cmp(&b.0)));
            let Some((best, _)) = best else { continue };
            let now = self.value_of(poses);
            poses[place] = best;
            let swapped = self.value_of(poses);
            let enough = match self.criterion {
                Criterion::A => swapped < now * (1.0 - LEAST_GAIN),
                Criterion::D => swapped < now - LEAST_GAIN,
            };
            if enough {
                *cost_s += self.candidates[best].cost_s - self.candidates[out].cost_s;
                history.push(swapped);
                gained = true;
            } else {
                poses[place] = out;
            }
        }
        gained
    }

    /// The covariance with these poses.
    pub fn covariance(&self, poses: &[usize]) -> Option<DMatrix<f64>> {
        let mut m = self.before.clone();
        for k in poses {
            let columns = &self.candidates[*k].columns;
            m += columns * columns.transpose();
        }
        m.cholesky().map(|f| f.inverse())
    }

    /// The criterion with these poses; infinite where they do not do.
    pub fn value_of(&self, poses: &[usize]) -> f64 {
        self.covariance(poses).map_or(f64::INFINITY, |c| self.value(&c))
    }

    fn value(&self, c: &DMatrix<f64>) -> f64 {
        let wanted = &self.wanted * c * self.wanted.transpose();
        match self.criterion {
            Criterion::A => wanted.trace(),
            Criterion::D => wanted.cholesky().map_or(f64::INFINITY, |f| {
                2.0 * f.l_dirty().diagonal().iter().map(|d| d.ln()).sum::<f64>()
            }),
        }
    }

    /// C − C Jᵀ (1 + J C Jᵀ)⁻¹ J C.
    fn with(&self, c: &DMatrix<f64>, pose: usize) -> Option<DMatrix<f64>> {
        let columns = &self.candidates[pose].columns;
        let half = c * columns;
        let inner = columns.tr_mul(&half) + DMatrix::identity(columns.ncols(), columns.ncols());
        let solved = inner.cholesky()?.solve(&half.transpose());
        Some(c - half * solved)
    }
}

impl Exchange {
    /// The standard uncertainty of each wanted quantity, in units of what is allowed of it.
    pub fn wanted_u(&self, poses: &[usize]) -> Vec<f64> {
        let Some(c) = self.covariance(poses) else { return Vec::new() };
        let wanted = &self.wanted * c * self.wanted.transpose();
        wanted.diagonal().iter().map(|v| v.max(0.0).sqrt()).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_straight_line_is_measured_at_its_ends() {
        // a + b x, x in −1, 0, 1: both criteria want the ends.
        let candidate = |x: f64| Candidate {
            columns: DMatrix::from_column_slice(2, 1, &[1.0, x]),
            cost_s: 1.0,
        };
        for criterion in [Criterion::A, Criterion::D] {
            let exchange = Exchange {
                candidates: [-1.0, 0.0, 1.0].map(candidate).to_vec(),
                before: DMatrix::identity(2, 2) * 1e-6,
                wanted: DMatrix::identity(2, 2),
                criterion,
                limit_s: 2.0,
                most: 9,
            };
            let mut chosen = exchange.choose().poses;
            chosen.sort_unstable();
            assert_eq!(chosen, [0, 2]);
        }
    }
}
