//! Which samples a study has, and what each of them is: a machine on a day, with levels of a factorial design; or a row of
//! the matrices of a sensitivity analysis.
//!
//! ```text
//! main:         sample = (combination · machines + machine) · days + day
//! sensitivity:  main samples, then for each of N rows: A, B, and A with each group of inputs from B    (Saltelli 2010)
//! ```

use crate::inputs::Level;
use crate::points::{Set, Spreading};

/// The design of a study.
#[derive(Debug, Clone, PartialEq)]
pub struct Design {
    /// Whether inputs with `values` take each of them with each of the others.
    pub factorial: bool,
    /// How all others are drawn.
    pub spreading: Spreading,
    /// How many machines, of each combination.
    pub machines: usize,
    /// On how many days each of them makes the part.
    pub days: usize,
    /// All random numbers come from it.
    pub seed: u64,
    /// Rows of the sensitivity analysis; 0: none.
    pub sensitivity: usize,
    /// Of each factorial input its number among the inputs, and how many levels it has.
    pub levels: Vec<(usize, usize)>,
    /// How many groups of inputs the sensitivity analysis separates.
    pub groups: usize,
}

/// What a sample is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Place {
    /// A machine on a day.
    Main {
        /// Which combination of levels.
        combination: usize,
        /// Which machine.
        machine: usize,
        /// Which day.
        day: usize,
    },
    /// A row of the sensitivity analysis.
    Row {
        /// Which row.
        row: usize,
        /// Of which matrix.
        matrix: Matrix,
    },
}

/// A matrix of a sensitivity analysis: a row is a sample.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Matrix {
    /// The first.
    A,
    /// The second, independent of the first.
    B,
    /// The first with one group of inputs from the second.
    Mixed(usize),
}

impl Design {
    /// In words, as in study files.
    pub fn word(&self) -> &'static str {
        match (self.factorial, self.spreading) {
            (true, _) => "factorial",
            (_, Spreading::Random) => "monte-carlo",
            (_, Spreading::LatinHypercube) => "latin-hypercube",
            (_, Spreading::Sobol) => "sobol",
        }
    }

    /// Combinations of levels; 1 without a factorial input.
    pub fn combinations(&self) -> usize {
        self.levels.iter().map(|(_, count)| count).product()
    }

    /// Samples of machines on days.
    pub fn main_samples(&self) -> usize {
        // A design that is too large is refused, not counted wrongly.
        self.combinations().saturating_mul(self.machines).saturating_mul(self.days)
    }

    /// Samples of a row of the sensitivity analysis.
    pub fn row_samples(&self) -> usize {
        self.groups + 2
    }

    /// All samples.
    pub fn samples(&self) -> usize {
        self.main_samples().saturating_add(self.sensitivity.saturating_mul(self.row_samples()))
    }

    /// What a sample is.
    pub fn place(&self, sample: usize) -> Place {
        if let Some(rest) = sample.checked_sub(self.main_samples()) {
            let matrix = match rest % self.row_samples() {
                0 => Matrix::A,
                1 => Matrix::B,
                group => Matrix::Mixed(group - 2),
            };
            return Place::Row { row: rest / self.row_samples(), matrix };
        }
        let (rest, day) = (sample / self.days, sample % self.days);
        Place::Main { combination: rest / self.machines, machine: rest % self.machines, day }
    }

    /// Which level of a factorial input a combination has; the last of them changes first.
    pub fn level(&self, combination: usize, which: usize) -> usize {
        let faster: usize = self.levels[which + 1..].iter().map(|(_, count)| count).product();
        combination / faster % self.levels[which].1
    }

    /// To what the numbers of an input belong. On one day alone, what is drawn for each day of each machine belongs to
    /// machines: then the points fill the space of these inputs together. The hall stays one for all machines.
    pub fn set(&self, level: Level) -> Set {
        match level {
            Level::Hall => Set::Days,
            Level::Day if self.days == 1 => Set::Machines,
            Level::Machine => Set::Machines,
            Level::Day => Set::MachineDays,
        }
    }

    /// How many things a set has.
    pub fn count(&self, set: Set) -> u64 {
        let count = match set {
            Set::Machines => self.machines,
            Set::Days => self.days,
            Set::MachineDays => self.machines * self.days,
            Set::First | Set::Second => self.sensitivity,
        };
        count as u64
    }

    /// Which thing of a set a machine on a day is.
    pub fn index(&self, set: Set, machine: usize, day: usize) -> u64 {
        let index = match set {
            Set::Days => day,
            Set::MachineDays => machine * self.days + day,
            _ => machine,
        };
        index as u64
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_count_through_all_samples() {
        let design = Design {
            factorial: true,
            spreading: Spreading::Random,
            machines: 2,
            days: 3,
            seed: 1,
            sensitivity: 2,
            levels: vec![(0, 2), (4, 3)],
            groups: 2,
        };
        assert_eq!(design.samples(), 2 * 3 * 2 * 3 + 2 * 4);
        let main = |combination, machine, day| Place::Main { combination, machine, day };
        assert_eq!(design.place(0), main(0, 0, 0));
        assert_eq!(design.place(5), main(0, 1, 2));
        assert_eq!(design.place(6), main(1, 0, 0));
        assert_eq!(design.place(36), Place::Row { row: 0, matrix: Matrix::A });
        assert_eq!(design.place(39), Place::Row { row: 0, matrix: Matrix::Mixed(1) });
        assert_eq!(design.place(41), Place::Row { row: 1, matrix: Matrix::B });
        // The last input changes first.
        assert_eq!([0, 1, 2, 3].map(|c| design.level(c, 1)), [0, 1, 2, 0]);
        assert_eq!([0, 1, 2, 3].map(|c| design.level(c, 0)), [0, 0, 0, 1]);
    }
}
