//! The indices of many machines whose errors are drawn within their uncertainties.

use super::Error;
use super::judge::{Bench, Judge};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use rand_distr::{Distribution, StandardNormal};
use rayon::prelude::*;
use std::sync::atomic::{AtomicUsize, Ordering};
use trueaxis_machine::Machine;
use trueaxis_machine::variations::DRAWN;

/// Samples that one thread draws in a row; fixed, so that the sums below do not depend on the
/// number of threads.
const CHUNK: usize = 256;
/// Quantiles come from at most this many samples (the first ones: they are as random as any).
const KEPT: usize = 1 << 20;

/// How many machines, and the seed that makes a run repeatable to the bit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Sampling {
    /// Number of samples.
    pub samples: usize,
    /// Seed; sample k draws from the k-th stream of the generator.
    pub seed: u64,
}

impl Default for Sampling {
    /// 10 000 samples: u of an index to about 1 %.
    fn default() -> Self {
        Self { samples: 10_000, seed: 1 }
    }
}

/// What the samples of one index say.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spread {
    /// Mean, mm.
    pub mean_mm: f64,
    /// Standard deviation, mm.
    pub u_mm: f64,
    /// 2.5 % quantile, mm.
    pub low_mm: f64,
    /// 97.5 % quantile, mm.
    pub high_mm: f64,
}

/// Draws the errors and evaluates the part, as often as asked.
///
/// `progress` is called with the number of samples done, from any thread.
///
/// # Errors
/// As [`Judge::indices`]; fewer than two samples.
///
/// # Source
/// JCGM 101:2008, clause 7; one standard-normal factor per stated error (fully correlated along
/// a curve) and per coefficient of the thermal parts, the expansion of the workpiece among them. The generator is ChaCha8, one stream per sample, so that the same seed gives the same
/// bits at any number of threads.
pub fn monte_carlo(
    machine: &Machine,
    judge: &Judge<'_>,
    sampling: Sampling,
    progress: &(dyn Fn(usize) + Sync),
) -> Result<Vec<Spread>, Error> {
    if sampling.samples < 2 {
        return Err(Error::TooFewSamples(sampling.samples));
    }
    let counts = [machine.uncertain_quantities().len(), judge.index_count()];
    let drawn = judge.cutting.drawn();
    let prepare = |factors: &[Vec<f64>], work: &mut Group| {
        work.fill(factors);
        drawn.deviations(&work.factors, &mut work.found);
    };
    let indices = |k: usize, _: &[f64], work: &mut Group, indices: &mut [f64]| {
        let datum = drawn.cut(&work.found, k, &mut work.bench.deviations);
        judge.judged(datum, &mut work.bench, indices)
    };
    spreads_of_groups(sampling, counts, (prepare, indices), progress)
}

/// What a thread needs for eight machines at a time.
#[derive(Default)]
struct Group {
    /// A row for each quantity, a column for each machine.
    factors: Vec<[f64; DRAWN]>,
    found: Vec<[[f64; DRAWN]; 6]>,
    bench: Bench,
}

impl Group {
    /// The factors of up to eight machines; the others are as stated.
    fn fill(&mut self, machines: &[Vec<f64>]) {
        let of = |quantity: usize| {
            std::array::from_fn(|k| machines.get(k).map_or(0.0, |factors| factors[quantity]))
        };
        self.factors.clear();
        self.factors.extend((0..machines[0].len()).map(of));
    }
}

/// The spread of each of many values of samples, by the number of factors of a sample and of its values. What a sample needs to
/// work on is kept by its thread.
pub(super) fn spreads<W: Default, E: Send>(
    sampling: Sampling,
    [factors, values]: [usize; 2],
    evaluate: impl Fn(&[f64], &mut W, &mut [f64]) -> Result<(), E> + Sync,
    progress: &(dyn Fn(usize) + Sync),
) -> Result<Vec<Spread>, E> {
    let evaluate =
        |_: usize, factors: &[f64], work: &mut W, found: &mut [f64]| evaluate(factors, work, found);
    spreads_of_groups(
        sampling,
        [factors, values],
        (|_: &[Vec<f64>], _: &mut W| (), evaluate),
        progress,
    )
}

/// The same where what a sample needs is prepared for a group of up to eight by their factors; then each is evaluated by its number in
/// the group.
fn spreads_of_groups<W: Default, E: Send>(
    sampling: Sampling,
    [factors, values]: [usize; 2],
    (prepare, evaluate): (
        impl Fn(&[Vec<f64>], &mut W) + Sync,
        impl Fn(usize, &[f64], &mut W, &mut [f64]) -> Result<(), E> + Sync,
    ),
    progress: &(dyn Fn(usize) + Sync),
) -> Result<Vec<Spread>, E> {
    let done = AtomicUsize::new(0);
    let chunks = sampling.samples.div_ceil(CHUNK);
    // Each chunk keeps its own sums; they are added up in order afterwards. Memory stays bounded:
    // only the first KEPT samples are kept one by one.
    let results: Vec<Chunk> = (0..chunks)
        .into_par_iter()
        .map_init(W::default, |work, c| {
            let range = c * CHUNK..((c + 1) * CHUNK).min(sampling.samples);
            let length = range.len();
            let mut chunk = Chunk::of(values);
            for first in range.clone().step_by(DRAWN) {
                let group = first..(first + DRAWN).min(range.end);
                let drawn = |sample| draw(factors, sampling.seed, sample);
                let machines: Vec<Vec<f64>> = group.clone().map(drawn).collect();
                prepare(&machines, work);
                for (k, (sample, factors)) in group.zip(&machines).enumerate() {
                    chunk.add(sample < KEPT, |found| evaluate(k, factors, work, found))?;
                }
            }
            progress(done.fetch_add(length, Ordering::Relaxed) + length);
            Ok(chunk)
        })
        .collect::<Result<_, E>>()?;
    Ok(summarise(&results, sampling.samples, values))
}

/// Sums of a run of samples.
struct Chunk {
    count: f64,
    mean: Vec<f64>,
    /// Sum of squares about the mean.
    squares: Vec<f64>,
    /// The samples themselves, index after index, if they are among the first.
    kept: Vec<f64>,
    /// Those of the present sample.
    values: Vec<f64>,
}

impl Chunk {
    fn of(values: usize) -> Self {
        let zeros = || vec![0.0; values];
        Self { count: 0.0, mean: zeros(), squares: zeros(), kept: Vec::new(), values: zeros() }
    }

    fn add<E>(
        &mut self,
        is_kept: bool,
        evaluate: impl FnOnce(&mut [f64]) -> Result<(), E>,
    ) -> Result<(), E> {
        evaluate(&mut self.values)?;
        self.count += 1.0;
        for ((mean, squares), &x) in self.mean.iter_mut().zip(&mut self.squares).zip(&self.values) {
            // Welford's update: no difference of large sums.
            let before = x - *mean;
            *mean += before / self.count;
            *squares += before * (x - *mean);
        }
        if is_kept {
            self.kept.extend_from_slice(&self.values);
        }
        Ok(())
    }
}

/// One standard-normal factor per uncertain quantity: how many standard uncertainties the machine of a sample is off. Unit: 1.
pub fn draw(quantities: usize, seed: u64, sample: usize) -> Vec<f64> {
    let mut generator = ChaCha8Rng::seed_from_u64(seed);
    generator.set_stream(sample as u64);
    (0..quantities).map(|_| StandardNormal.sample(&mut generator)).collect()
}

fn summarise(chunks: &[Chunk], samples: usize, n: usize) -> Vec<Spread> {
    let kept = samples.min(KEPT);
    (0..n)
        .map(|i| {
            let (mut count, mut mean, mut squares) = (0.0, 0.0, 0.0);
            for chunk in chunks {
                // Chan's rule for joining two sets of samples.
                let total = count + chunk.count;
                let gap = chunk.mean[i] - mean;
                mean += gap * chunk.count / total;
                squares += chunk.squares[i] + gap * gap * count * chunk.count / total;
                count = total;
            }
            let mut values: Vec<f64> = Vec::with_capacity(kept);
            values.extend(chunks.iter().flat_map(|c| c.kept.iter().skip(i).step_by(n)));
            values.sort_by(f64::total_cmp);
            let quantile = |q: f64| values[((values.len() - 1) as f64 * q).round() as usize];
            let u_mm = (squares / (count - 1.0)).sqrt();
            Spread { mean_mm: mean, u_mm, low_mm: quantile(0.025), high_mm: quantile(0.975) }
        })
        .collect()
}
