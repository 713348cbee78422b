//! Numbers in 0..1 for every input of every sample, each by its place alone: any part of a study can be computed by any
//! computer at any time, and gives the same bits.
//!
//! ```text
//! seed, name of the input, kind of place ──ChaCha8──> stream of numbers; the one at index i is word pair i
//! ```

mod latin;
mod sobol;

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

/// How the points of a design are spread.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Spreading {
    /// Independent of each other (JCGM 101).
    Random,
    /// One in each of as many strata of every input as there are points (McKay, Beckman, Conover 1979).
    LatinHypercube,
    /// The sequence of Sobol', by the direction numbers of Joe and Kuo 2008, shifted at random.
    Sobol,
}

/// To which numbered things the points of a column belong. The numbers of one are independent of those of another.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Set {
    /// To machines.
    Machines,
    /// To days of the hall, the same for all machines.
    Days,
    /// To each day of each machine.
    MachineDays,
    /// To the rows of the first matrix of a sensitivity analysis.
    First,
    /// To those of the second.
    Second,
}

/// Numbers of one input for the things of one set.
pub struct Column {
    spreading: Spreading,
    /// How many things there are.
    count: u64,
    key: u64,
    generator: ChaCha8Rng,
    /// The index whose number the generator gives next.
    next: u64,
    last: Option<(u64, f64)>,
    /// Of the sequence of Sobol'.
    directions: [u64; sobol::BITS],
    shift: u64,
}

/// The numbers of one column, before its generator is set up.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ColumnPlan {
    /// How they are spread.
    pub spreading: Spreading,
    /// The seed of the study.
    pub seed: u64,
    /// To what they belong.
    pub set: Set,
    /// How many things there are.
    pub count: u64,
    /// Which input it is among those of the set, for the sequence of Sobol'.
    pub dimension: usize,
}

impl Column {
    /// The numbers of an input; its name decides them, not its place in a file.
    ///
    /// # Panics
    /// A dimension of the sequence of Sobol' from [`sobol_dimensions`] on.
    pub fn new(plan: ColumnPlan, name: &str) -> Self {
        let key = hash(name.as_bytes());
        let mut seed = [0u8; 32];
        seed[..8].copy_from_slice(&plan.seed.to_le_bytes());
        seed[8..16].copy_from_slice(&key.to_le_bytes());
        seed[16] = plan.set as u8;
        seed[24..].copy_from_slice(b"trueaxis");
        let mut generator = ChaCha8Rng::from_seed(seed);
        // The first number of the stream is that of the column, the others are those of its things.
        let own = generator.next_u64();
        let directions = match plan.spreading {
            Spreading::Sobol => sobol::directions(plan.dimension),
            _ => [0; sobol::BITS],
        };
        let (spreading, count) = (plan.spreading, plan.count.max(1));
        Self {
            spreading,
            count,
            key: own,
            generator,
            next: 0,
            last: None,
            directions,
            shift: own >> 12,
        }
    }

    /// The number of thing `index`, above 0 and below 1.
    pub fn at(&mut self, index: u64) -> f64 {
        if let Some((_, value)) = self.last.filter(|(last, _)| *last == index) {
            return value;
        }
        let value = match self.spreading {
            Spreading::Random => inside(self.bits(index)),
            Spreading::LatinHypercube => {
                let stratum = latin::permuted(index, self.count, self.key);
                (stratum as f64 + inside(self.bits(index))) / self.count as f64
            }
            Spreading::Sobol => centred(sobol::point(&self.directions, index) ^ self.shift),
        };
        self.last = Some((index, value));
        value
    }

    fn bits(&mut self, index: u64) -> u64 {
        if index != self.next {
            self.generator.set_word_pos(2 * (u128::from(index) + 1));
        }
        self.next = index + 1;
        self.generator.next_u64()
    }
}

/// How many inputs the sequence of Sobol' has numbers for.
pub fn sobol_dimensions() -> usize {
    sobol::DIMENSIONS
}

/// Any 64 bits as a number above 0 and below 1.
fn inside(bits: u64) -> f64 {
    centred(bits >> 12)
}

/// The middle of one of 2⁵² cells: with half of a cell, both ends stay out and no rounding happens.
fn centred(cell: u64) -> f64 {
    (cell as f64 + 0.5) / (1u64 << 52) as f64
}

/// FNV-1a (Fowler, Noll, Vo).
fn hash(bytes: &[u8]) -> u64 {
    let step = |sum: u64, byte: &u8| (sum ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3);
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, step)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plan(spreading: Spreading, count: u64) -> ColumnPlan {
        ColumnPlan { spreading, seed: 1, set: Set::Machines, count, dimension: 3 }
    }

    /// A number depends on its index alone, whatever was asked before.
    #[test]
    fn any_order_gives_the_same_bits() {
        for spreading in [Spreading::Random, Spreading::LatinHypercube, Spreading::Sobol] {
            let mut column = Column::new(plan(spreading, 1000), "EC0Y");
            let forwards: Vec<f64> = (0..1000).map(|i| column.at(i)).collect();
            let mut column = Column::new(plan(spreading, 1000), "EC0Y");
            for i in (0..1000).rev().chain([7, 7, 500, 8]) {
                assert_eq!(column.at(i), forwards[i as usize]);
            }
            let mut sorted = forwards;
            sorted.sort_by(f64::total_cmp);
            sorted.dedup();
            assert_eq!(sorted.len(), 1000);
        }
    }

    #[test]
    fn names_sets_and_seeds_have_numbers_of_their_own() {
        let first = |plan: ColumnPlan, name: &str| Column::new(plan, name).at(0);
        let base = plan(Spreading::Random, 10);
        let all = [
            first(base, "EC0Y"),
            first(base, "EC0X"),
            first(ColumnPlan { seed: 2, ..base }, "EC0Y"),
            first(ColumnPlan { set: Set::First, ..base }, "EC0Y"),
        ];
        for (i, one) in all.iter().enumerate() {
            assert!(all[..i].iter().all(|other| other != one));
        }
    }

    /// Of a Latin hypercube, and of 2ᵏ points of the sequence of Sobol', one lies in each stratum.
    #[test]
    fn one_in_each_stratum() {
        for (spreading, count) in [
            (Spreading::LatinHypercube, 777),
            (Spreading::LatinHypercube, 1),
            (Spreading::Sobol, 512),
        ] {
            let mut column = Column::new(plan(spreading, count), "EXX");
            let mut found: Vec<u64> =
                (0..count).map(|i| (column.at(i) * count as f64) as u64).collect();
            found.sort_unstable();
            assert_eq!(found, (0..count).collect::<Vec<_>>(), "{spreading:?}");
        }
    }

    /// Ten million uniform numbers: mean and variance within five of their standard deviations.
    #[test]
    fn random_numbers_are_uniform() {
        let n = 1_000_000;
        let mut column = Column::new(plan(Spreading::Random, n), "EXX");
        let (mut sum, mut squares) = (0.0, 0.0);
        for i in 0..n {
            let x = column.at(i) - 0.5;
            sum += x;
            squares += x * x;
        }
        let n = n as f64;
        assert!((sum / n).abs() < 5.0 / (12.0 * n).sqrt());
        assert!((squares / n - 1.0 / 12.0).abs() < 5.0 / (180.0 * n).sqrt());
    }
}
