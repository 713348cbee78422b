//! What the samples say: spreads, shares of parts and machines that are good, shares of the variance.

mod components;
mod counts;
mod spread;

pub use components::Components;
pub use counts::{Good, interval};
pub use spread::{Histogram, Spread};

use crate::sensitivity::{GroupShares, Rows};
use crate::study::Study;
use rayon::prelude::*;
use trueaxis::part::tolerance::Outcome;

/// One output of one combination.
#[derive(Debug, Clone, PartialEq)]
pub struct OutputFindings {
    /// All machines and days together.
    pub spread: Spread,
    /// The share of parts on which it is in tolerance; none without a limit. Unit: 1.
    pub good_ratio: Option<f64>,
    /// What differs from machine to machine and from day to day; none for one machine or one day.
    pub components: Option<Components>,
}

/// One combination of levels; without a factorial design there is one.
#[derive(Debug, Clone, PartialEq)]
pub struct CombinationFindings {
    /// The value of each factorial input, in the order of the design. Unit: that of the input.
    pub levels: Vec<f64>,
    /// In the order of the outputs of the study.
    pub outputs: Vec<OutputFindings>,
    /// Of each case, what is good; none for a case without limits.
    pub cases: Vec<Option<Good>>,
    /// All cases together; none if nothing has a limit.
    pub good: Option<Good>,
    /// What is asked of the machines, decided.
    pub outcome: Option<Outcome>,
}

/// All that the samples of a study say.
#[derive(Debug, Clone, PartialEq)]
pub struct Findings {
    /// In the order of the design.
    pub combinations: Vec<CombinationFindings>,
    /// Of each output, the shares of each group of inputs; none for an output that does not vary. Empty without a
    /// sensitivity analysis.
    pub shares: Vec<Option<Vec<GroupShares>>>,
}

impl Findings {
    /// Whether the machines hold what is asked of them: at one combination, if there are several.
    pub fn outcome(&self) -> Option<Outcome> {
        let all = self.combinations.iter().filter_map(|c| c.outcome);
        all.reduce(|best, one| match (best, one) {
            (Outcome::Pass, _) | (_, Outcome::Pass) => Outcome::Pass,
            (Outcome::Undecided, _) | (_, Outcome::Undecided) => Outcome::Undecided,
            _ => Outcome::Fail,
        })
    }
}

impl Study {
    /// What all samples say: `values_mm` as of [`Study::evaluate`], of all of them.
    ///
    /// # Panics
    /// Another number of values.
    pub fn findings(&self, values_mm: &[f64]) -> Findings {
        let width = self.output_count();
        assert_eq!(values_mm.len(), self.design.samples() * width, "all samples of the study");
        let (main, rows) = values_mm.split_at(self.design.main_samples() * width);
        let size = self.design.machines * self.design.days * width;
        let one = |(c, values): (usize, &[f64])| self.combination(c, values);
        Findings {
            combinations: main.chunks(size.max(1)).enumerate().map(one).collect(),
            shares: match self.design.sensitivity {
                0 => Vec::new(),
                _ => (0..width).into_par_iter().map(|o| self.rows(rows, o).shares()).collect(),
            },
        }
    }

    /// One output of the samples of the sensitivity analysis.
    fn rows(&self, values: &[f64], output: usize) -> Rows {
        let width = self.output_count();
        let mut rows = Rows { mixed: vec![Vec::new(); self.design.groups], ..Rows::default() };
        for row in values.chunks(self.design.row_samples() * width) {
            let mut of = row.chunks(width).map(|sample| sample[output]);
            rows.a.extend(of.next());
            rows.b.extend(of.next());
            rows.mixed.iter_mut().zip(of).for_each(|(mixed, value)| mixed.push(value));
        }
        rows
    }

    fn combination(&self, number: usize, values: &[f64]) -> CombinationFindings {
        let (width, days) = (self.output_count(), self.design.days);
        let outputs: Vec<_> = self.cases.iter().flat_map(|c| &c.outputs).collect();
        let of = |o: usize| {
            let column: Vec<f64> = values.chunks(width).map(|sample| sample[o]).collect();
            let good = column.iter().filter(|v| outputs[o].allows(**v)).count();
            let components = Components::of(&column, days);
            OutputFindings {
                good_ratio: outputs[o].is_judged().then(|| good as f64 / column.len() as f64),
                components,
                spread: Spread::of(column),
            }
        };
        let required = self.requirement.unwrap_or_default();
        let good = |range: std::ops::Range<usize>| {
            let judged = outputs[range.clone()].iter().any(|o| o.is_judged());
            judged.then(|| {
                let is_good = |sample: &[f64]| range.clone().all(|o| outputs[o].allows(sample[o]));
                Good::of(values.chunks(width).map(is_good), days, required.days_ratio)
            })
        };
        let mut first = 0;
        let cases = self.cases.iter().map(|case| {
            let range = first..first + case.outputs.len();
            first = range.end;
            good(range)
        });
        let cases = cases.collect();
        let all = good(0..width);
        let level = |which: usize| {
            let (input, _) = self.design.levels[which];
            match &self.inputs[input].distribution {
                crate::Distribution::Values(values) => values[self.design.level(number, which)],
                other => other.mean(),
            }
        };
        CombinationFindings {
            levels: (0..self.design.levels.len()).map(level).collect(),
            outputs: (0..width).into_par_iter().map(of).collect(),
            outcome: self
                .requirement
                .zip(all)
                .map(|(asked, all)| all.outcome(asked.machines_ratio)),
            cases,
            good: all,
        }
    }
}
