//! Which terms of error motions the readings support: cross-validation over places.
//!
//! ```text
//!     z = r + J x̂                  linear about the solution, in units of the noise
//!     N_f = Jᵀ J,  g_f = Jᵀ z,  s_f = zᵀ z        of each part f of the places
//!     error on part f = s_f − 2 xᵀ g_f + xᵀ N_f x       x from the other parts   docs/model.md eq. 127
//! ```
//!
//! Candidates enter one by one, the one first that explains most, until none is above a threshold
//! of z-scores; then those fall out that are below it. Cross-validation chooses the threshold: the
//! highest whose error is within one standard error of the least. Everything happens on the sums of
//! the parts, so a candidate costs n² and not another look at the readings.

use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;
use serde::{Serialize, Serializer};
use std::collections::BTreeMap;
use trueaxis_geometry::statistics::SplitMix64;
use trueaxis_measure::measure::Readings;
use trueaxis_measure::unknowns::design::Design;
use trueaxis_measure::unknowns::fit::Observability;
use trueaxis_report::JsonSchema;

/// Thresholds of z-scores; the first lets nothing in, the last everything.
pub const THRESHOLDS: [f64; 11] = [f64::INFINITY, 8.0, 6.0, 5.0, 4.5, 4.0, 3.5, 3.0, 2.5, 2.0, 0.0];
/// A term whose part that no other term has is less than this share of it is not separable.
const LEAST_PIVOT: f64 = 1e-8;
/// Rows at a time.
const CHUNK: usize = 2048;

/// Normal equations of some readings in units of their noise.
#[derive(Debug, Clone)]
pub struct Sums {
    /// JᵀJ.
    pub normal: DMatrix<f64>,
    /// Jᵀz.
    pub gradient: DVector<f64>,
    /// zᵀz. Unit: 1.
    pub square: f64,
    /// How many numbers were read.
    pub numbers: usize,
}

impl Sums {
    /// Of nothing.
    pub fn zero(unknowns: usize) -> Self {
        Self {
            normal: DMatrix::zeros(unknowns, unknowns),
            gradient: DVector::zeros(unknowns),
            square: 0.0,
            numbers: 0,
        }
    }

    /// Of these readings; `z` and `weights` as long as they are (no weights: 1).
    pub fn of(design: &Design, readings: &Readings, z: &[[f64; 3]], weights: &[f64]) -> Self {
        let starts: Vec<usize> = (0..readings.len()).step_by(CHUNK).collect();
        let part = |start: &usize| {
            let range = *start..(start + CHUNK).min(readings.len());
            let mut columns = design.columns(readings, range.clone());
            let mut right = Vec::with_capacity(columns.ncols());
            let (mut next, mut left_out) = (0, 0);
            for i in range {
                let instrument = &design.instruments[readings.instruments[i] as usize];
                let root = weights.get(i).map_or(1.0, |w| w.sqrt());
                for (value, u) in
                    z[i].iter().zip(instrument.noise).take(instrument.sight.channels())
                {
                    right.push(value / u * root);
                    left_out += usize::from(root == 0.0);
                    if root != 1.0 {
                        columns.column_mut(next).scale_mut(root);
                    }
                    next += 1;
                }
            }
            let right = DVector::from_vec(right);
            Self {
                normal: &columns * columns.transpose(),
                gradient: &columns * &right,
                square: right.norm_squared(),
                numbers: right.len() - left_out,
            }
        };
        let mut all = Self::zero(design.unknowns());
        for batch in starts.chunks(64) {
            for part in batch.par_iter().map(part).collect::<Vec<_>>() {
                all.add(&part, 1.0);
            }
        }
        all
    }

    /// Adds a number with its row, both in units of the noise.
    pub fn add_row(&mut self, row: &DVector<f64>, number: f64) {
        self.normal.ger(1.0, row, row, 1.0);
        self.gradient.axpy(number, row, 1.0);
        self.square += number * number;
        self.numbers += 1;
    }

    /// Adds others, or takes them away (−1).
    pub fn add(&mut self, other: &Self, sign: f64) {
        self.normal.zip_apply(&other.normal, |a, b| *a += sign * b);
        self.gradient.axpy(sign, &other.gradient, 1.0);
        self.square += sign * other.square;
        match sign < 0.0 {
            true => self.numbers = self.numbers.saturating_sub(other.numbers),
            false => self.numbers += other.numbers,
        }
    }

    /// What was known before, as if it had been read.
    pub fn of_priors(design: &Design) -> Self {
        let prior = design.prior();
        let numbers = Observability::of(&prior.normal).rank;
        let (normal, gradient, square) = (prior.normal, prior.gradient, prior.square);
        Self { normal, gradient, square, numbers }
    }

    /// The squared error of these values on the readings.
    pub fn error(&self, values: &DVector<f64>) -> f64 {
        let bent = &self.normal * values;
        (self.square - 2.0 * values.dot(&self.gradient) + values.dot(&bent)).max(0.0)
    }
}

/// Into which part each reading goes: readings of one group or of one place stay together.
///
/// The places are numbered in their own order (instrument, positions, direction), whatever the order of the rows: the parts,
/// and with them the terms that are chosen, depend on what was measured only. Places are dealt out instrument by instrument:
/// every part has its share of each, and none of the few readings of a laser among many of a ball.
/// Returns the part of every row and how many places there are.
pub fn parts_by_place(readings: &Readings, folds: usize) -> (Vec<usize>, usize) {
    let key = |i: usize| {
        let command = readings.commands[i].map(|q| (q * 1e6).round() as i64);
        let direction = readings.directions[i];
        let n = [direction.x, direction.y, direction.z].map(|v| (v * 1e6).round() as i64);
        (readings.instruments[i], command, n)
    };
    let keys: Vec<_> = (0..readings.len()).map(key).collect();
    let mut places = keys.clone();
    places.sort_unstable();
    places.dedup();
    // Every key is among them.
    let place_of: Vec<usize> =
        keys.iter().map(|key| places.partition_point(|place| place < key)).collect();
    let count = places.len();
    let mut union: Vec<usize> = (0..count).collect();
    // Directions that were read at one pose are one place, in whichever rows they stand.
    for next in
        (1..count).filter(|k| (places[*k].0, places[*k].1) == (places[k - 1].0, places[k - 1].1))
    {
        union[next] = root(&mut union, next - 1);
    }
    let mut first_of_group: BTreeMap<u32, usize> = BTreeMap::new();
    for (i, place) in place_of.iter().enumerate() {
        let first = *first_of_group.entry(readings.groups[i]).or_insert(*place);
        let (a, b) = (root(&mut union, first), root(&mut union, *place));
        union[a.max(b)] = a.min(b);
    }
    let mut roots: Vec<usize> = (0..count).map(|p| root(&mut union, p)).collect();
    let mut distinct = roots.clone();
    distinct.sort_unstable();
    distinct.dedup();
    // Groups that all hang together (a cycle over all places) say nothing about places.
    if distinct.len() < 2 * folds && distinct.len() < count {
        roots = (0..count).collect();
        distinct.clone_from(&roots);
    }
    // Those of each instrument mixed, always the same way, then dealt out.
    distinct.sort_by_key(|place| (places[*place].0, SplitMix64::new(*place as u64).bits()));
    let folds = folds.min(distinct.len()).max(1);
    let mut part = vec![0; count];
    for (i, place) in distinct.iter().enumerate() {
        part[*place] = i % folds;
    }
    (place_of.iter().map(|place| part[roots[*place]]).collect(), distinct.len())
}

fn root(union: &mut [usize], mut place: usize) -> usize {
    while union[place] != place {
        union[place] = union[union[place]];
        place = union[place];
    }
    place
}

/// Normal equations with some unknowns solved for: the sweep operator of Gauss and Jordan.
#[derive(Clone)]
struct Swept {
    /// JᵀJ with Jᵀz beside and zᵀz in the corner, columns of J scaled to 1.
    a: DMatrix<f64>,
    scale: DVector<f64>,
    inside: Vec<bool>,
}

impl Swept {
    fn new(sums: &Sums) -> Self {
        let n = sums.gradient.len();
        let scale = sums.normal.diagonal().map(|d| if d > 0.0 { d.sqrt() } else { 0.0 });
        let over = scale.map(|s| if s > 1e-11 * scale.max() { s.recip() } else { 0.0 });
        let a = DMatrix::from_fn(n + 1, n + 1, |i, j| match (i < n, j < n) {
            (true, true) => sums.normal[(i, j)] * over[i] * over[j],
            (true, false) => sums.gradient[i] * over[i],
            (false, true) => sums.gradient[j] * over[j],
            (false, false) => sums.square,
        });
        Self { a, scale: over, inside: vec![false; n] }
    }

    fn sweep(&mut self, k: usize) {
        let pivot = self.a[(k, k)];
        let mut own = self.a.column(k).into_owned();
        own[k] = 0.0;
        for (j, mut column) in self.a.column_iter_mut().enumerate() {
            if j != k {
                let by = column[k] / pivot;
                column.axpy(-by, &own, 1.0);
                column[k] = by;
            }
        }
        self.a.set_column(k, &(own * (-1.0 / pivot)));
        self.a[(k, k)] = 1.0 / pivot;
        self.inside[k] = !self.inside[k];
    }

    fn residual(&self) -> f64 {
        let n = self.inside.len();
        self.a[(n, n)].max(0.0)
    }

    /// How much the squares fall if an unknown enters.
    fn gain(&self, k: usize) -> f64 {
        let (n, pivot) = (self.inside.len(), self.a[(k, k)]);
        if pivot > LEAST_PIVOT { self.a[(k, n)].powi(2) / pivot } else { 0.0 }
    }

    /// How much they rise if it leaves.
    fn loss(&self, k: usize) -> f64 {
        self.a[(k, self.inside.len())].powi(2) / self.a[(k, k)]
    }

    fn strongest(&self, candidates: &[usize]) -> Option<(usize, f64)> {
        let outside = candidates.iter().filter(|k| !self.inside[**k]);
        outside.map(|k| (*k, self.gain(*k))).max_by(|a, b| a.1.total_cmp(&b.1))
    }

    fn weakest(&self, candidates: &[usize]) -> Option<(usize, f64)> {
        let inside = candidates.iter().filter(|k| self.inside[**k]);
        inside.map(|k| (*k, self.loss(*k))).min_by(|a, b| a.1.total_cmp(&b.1))
    }

    fn values(&self) -> DVector<f64> {
        let n = self.inside.len();
        DVector::from_fn(n, |k, _| match self.inside[k] {
            true => self.a[(k, n)] * self.scale[k],
            false => 0.0,
        })
    }

    fn enter(&mut self, wanted: &[usize]) {
        // The best separable one first, so that what cannot be separated is left to the last.
        let mut left: Vec<usize> = wanted.to_vec();
        while let Some(at) = (0..left.len())
            .max_by(|a, b| self.a[(left[*a], left[*a])].total_cmp(&self.a[(left[*b], left[*b])]))
        {
            let k = left.swap_remove(at);
            if self.a[(k, k)] <= LEAST_PIVOT {
                break;
            }
            self.sweep(k);
        }
    }
}

/// A model: which unknowns it has, and their values.
#[derive(Debug, Clone)]
pub struct Model {
    /// Which unknowns are in.
    pub members: Vec<bool>,
    /// Their values; 0 for those that are not in.
    pub values: DVector<f64>,
}

/// Which unknowns are always in, and which may be.
#[derive(Debug, Clone)]
pub struct Candidates {
    /// Always in unless unseen.
    pub always: Vec<usize>,
    /// In if the readings support them.
    pub maybe: Vec<usize>,
}

/// The models of every threshold from these readings.
fn models(sums: &Sums, candidates: &Candidates) -> Vec<Model> {
    let start = Swept::new(sums);
    let model = |swept: &Swept| Model { members: swept.inside.clone(), values: swept.values() };
    let mut base = start;
    base.enter(&candidates.always);
    let mut full = base.clone();
    full.enter(&candidates.maybe);
    let known = full.inside.iter().filter(|i| **i).count();
    // The variance that no candidate explains; from few readings the stated noise.
    let variance = match sums.numbers > known + 10 {
        true => full.residual() / (sums.numbers - known) as f64,
        false => 1.0,
    }
    .max(1e-12);
    let mut path = base;
    let mut found = Vec::new();
    for threshold in THRESHOLDS {
        if threshold == 0.0 {
            found.push(model(&full));
            continue;
        }
        let least = threshold * threshold * variance;
        while let Some((k, gain)) = path.strongest(&candidates.maybe) {
            // No more unknowns than numbers.
            let room = path.inside.iter().filter(|i| **i).count() + 2 < sums.numbers;
            if gain <= least || gain <= 0.0 || !room {
                break;
            }
            path.sweep(k);
        }
        let mut pruned = path.clone();
        while let Some((k, loss)) = pruned.weakest(&candidates.maybe) {
            if loss >= least {
                break;
            }
            pruned.sweep(k);
        }
        found.push(model(&pruned));
    }
    found
}

/// JSON has no infinite number; the schema of the field says what `null` means.
fn null_if_infinite<S: Serializer>(value: &f64, serializer: S) -> Result<S::Ok, S::Error> {
    Some(value).filter(|v| v.is_finite()).serialize(serializer)
}

/// How well a threshold predicts.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct Score {
    /// Least |z| of a term that is kept; ∞ (null): none is, 0: all are. Unit: 1.
    #[serde(rename = "least_z", serialize_with = "null_if_infinite")]
    #[schemars(with = "Option<f64>")]
    pub threshold: f64,
    /// Number of candidate terms that are kept.
    pub terms: usize,
    /// Root mean square of the residual on parts that were held out, in units of the noise. Unit: 1.
    #[serde(rename = "held_out_times_noise")]
    pub held_out: f64,
    /// The same on the readings themselves. Unit: 1.
    #[serde(rename = "in_sample_times_noise")]
    pub in_sample: f64,
}

/// What cross-validation chose.
#[derive(Debug, Clone)]
pub struct Selection {
    /// The model from all readings.
    pub chosen: Model,
    /// Its threshold. Unit: 1.
    pub threshold: f64,
    /// For every part: the values found, threshold included, without that part.
    pub without_part: Vec<DVector<f64>>,
    /// Every threshold.
    pub scores: Vec<Score>,
}

/// Chooses the terms; without `choose` all are in.
pub fn select(parts: &[Sums], priors: &Sums, candidates: &Candidates, choose: bool) -> Selection {
    let n = priors.gradient.len();
    let mut all = priors.clone();
    parts.iter().for_each(|part| all.add(part, 1.0));
    let without = |left_out: &[usize]| {
        let mut sums = all.clone();
        left_out.iter().for_each(|f| sums.add(&parts[*f], -1.0));
        sums
    };
    let last = THRESHOLDS.len() - 1;
    let single: Vec<Vec<Model>> =
        (0..parts.len()).into_par_iter().map(|f| models(&without(&[f]), candidates)).collect();
    let error = |model: &Model, part: usize| parts[part].error(&model.values);
    let errors: Vec<Vec<f64>> =
        (0..parts.len()).map(|f| single[f].iter().map(|m| error(m, f)).collect()).collect();
    let of_all = models(&all, candidates);
    let numbers: usize = parts.iter().map(|p| p.numbers).sum();
    let score = |(t, model): (usize, &Model)| {
        let held_out: f64 = errors.iter().map(|e| e[t]).sum();
        let within: f64 = (0..parts.len()).map(|f| error(model, f)).sum();
        Score {
            threshold: THRESHOLDS[t],
            terms: candidates.maybe.iter().filter(|k| model.members[**k]).count(),
            held_out: (held_out / numbers.max(1) as f64).sqrt(),
            in_sample: (within / numbers.max(1) as f64).sqrt(),
        }
    };
    let scores = of_all.iter().enumerate().map(score).collect();
    let choice = if choose { best(&errors, parts) } else { last };
    let without_part = match choose && parts.len() > 2 {
        false => single.iter().map(|m| m[choice].values.clone()).collect(),
        true => nested(parts, candidates, &single, &without),
    };
    debug_assert!(without_part.iter().all(|v: &DVector<f64>| v.len() == n));
    Selection {
        chosen: of_all[choice].clone(),
        threshold: THRESHOLDS[choice],
        without_part,
        scores,
    }
}

/// The highest threshold whose error is within one standard error of the least.
///
/// The standard error is that of the difference, part by part: what is hard to predict is so for
/// both.
fn best(errors: &[Vec<f64>], parts: &[Sums]) -> usize {
    let per_number = |f: usize, t: usize| errors[f][t] / parts[f].numbers.max(1) as f64;
    let count = errors.len() as f64;
    let sum = |t: usize| errors.iter().map(|e| e[t]).sum::<f64>();
    // why: there is at least one threshold, and the first stands for none
    let least = (0..THRESHOLDS.len()).min_by(|a, b| sum(*a).total_cmp(&sum(*b))).unwrap_or(0);
    (0..least)
        .find(|t| {
            let differences: Vec<f64> =
                (0..errors.len()).map(|f| per_number(f, *t) - per_number(f, least)).collect();
            let mean = differences.iter().sum::<f64>() / count;
            let variance = differences.iter().map(|d| (d - mean).powi(2)).sum::<f64>()
                / (count - 1.0).max(1.0);
            mean <= (variance / count).sqrt()
        })
        .unwrap_or(least)
}

/// Values for every part from the others, the threshold too: no part has a say in what predicts it.
fn nested(
    parts: &[Sums],
    candidates: &Candidates,
    single: &[Vec<Model>],
    without: &(dyn Fn(&[usize]) -> Sums + Sync),
) -> Vec<DVector<f64>> {
    let count = parts.len();
    let pairs: Vec<(usize, usize)> =
        (0..count).flat_map(|a| (a + 1..count).map(move |b| (a, b))).collect();
    let both: Vec<[Vec<f64>; 2]> = pairs
        .par_iter()
        .map(|(a, b)| {
            let models = models(&without(&[*a, *b]), candidates);
            [*a, *b].map(|f| models.iter().map(|m| parts[f].error(&m.values)).collect())
        })
        .collect();
    (0..count)
        .map(|f| {
            let (mut errors, mut others) = (Vec::new(), Vec::new());
            for ((a, b), [on_a, on_b]) in pairs.iter().zip(&both) {
                if *a == f {
                    errors.push(on_b.clone());
                    others.push(parts[*b].clone());
                } else if *b == f {
                    errors.push(on_a.clone());
                    others.push(parts[*a].clone());
                }
            }
            single[f][best(&errors, &others)].values.clone()
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sweeping_solves_and_sweeping_again_undoes() {
        // 2x = 4: x = 2, squares 10 − 8 = 2
        let sums = Sums {
            normal: DMatrix::from_element(1, 1, 2.0),
            gradient: DVector::from_element(1, 4.0),
            square: 10.0,
            numbers: 3,
        };
        let mut swept = Swept::new(&sums);
        let before = swept.a.clone();
        swept.sweep(0);
        assert!((swept.values()[0] - 2.0).abs() < 1e-12 && (swept.residual() - 2.0).abs() < 1e-12);
        swept.sweep(0);
        assert!((swept.a - before).norm() < 1e-12);
    }
}
