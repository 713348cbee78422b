//! From a sample to the values of its inputs.

use crate::correlation::Correlation;
use crate::design::{Design, Matrix, Place};
use crate::distribution::{Distribution, normal_score};
use crate::inputs::Input;
use crate::points::{Column, ColumnPlan, Set};

/// Draws the inputs of samples, one after the other or in any order.
pub struct Drawer<'a> {
    design: &'a Design,
    inputs: &'a [Input],
    correlation: Option<&'a Correlation>,
    /// Which group each input belongs to.
    group_of: &'a [usize],
    main: Vec<Column>,
    rows: Option<[Vec<Column>; 2]>,
    /// Of each input, which factorial one it is.
    level_of: Vec<Option<usize>>,
    units: Vec<f64>,
}

impl<'a> Drawer<'a> {
    /// For the inputs of a study.
    pub fn new(
        design: &'a Design,
        inputs: &'a [Input],
        correlation: Option<&'a Correlation>,
        group_of: &'a [usize],
    ) -> Self {
        let columns = |set: &dyn Fn(&Input) -> Set, first: usize| -> Vec<Column> {
            let column = |input: &Input| {
                let own = set(input);
                // By the order of the names, so that the order in the file does not matter.
                let before = |other: &&Input| set(other) == own && other.name < input.name;
                let dimension = first + inputs.iter().filter(before).count();
                let (spreading, seed, count) = (design.spreading, design.seed, design.count(own));
                Column::new(ColumnPlan { spreading, seed, set: own, count, dimension }, &input.name)
            };
            inputs.iter().map(column).collect()
        };
        let main = columns(&|input| design.set(input.level), 0);
        let rows = (design.sensitivity > 0)
            .then(|| [columns(&|_| Set::First, 0), columns(&|_| Set::Second, inputs.len())]);
        let level_of = |i: usize| design.levels.iter().position(|(input, _)| *input == i);
        let level_of = (0..inputs.len()).map(level_of).collect();
        let units = vec![0.0; inputs.len()];
        Self { design, inputs, correlation, group_of, main, rows, level_of, units }
    }

    /// The values of all inputs of a sample.
    pub fn values(&mut self, sample: usize, out: &mut [f64]) {
        let combination = match self.design.place(sample) {
            Place::Main { combination, machine, day } => {
                for ((unit, column), input) in
                    self.units.iter_mut().zip(&mut self.main).zip(self.inputs)
                {
                    let set = self.design.set(input.level);
                    *unit = column.at(self.design.index(set, machine, day));
                }
                combination
            }
            Place::Row { row, matrix } => {
                let Some([first, second]) = &mut self.rows else { return };
                for (i, unit) in self.units.iter_mut().enumerate() {
                    let from_second = match matrix {
                        Matrix::A => false,
                        Matrix::B => true,
                        Matrix::Mixed(group) => self.group_of[i] == group,
                    };
                    let columns = if from_second { &mut *second } else { &mut *first };
                    *unit = columns[i].at(row as u64);
                }
                0
            }
        };
        for (i, input) in self.inputs.iter().enumerate() {
            out[i] = match (self.level_of[i], &input.distribution) {
                (Some(which), Distribution::Values(values)) => {
                    values[self.design.level(combination, which)]
                }
                _ => input.distribution.quantile(self.units[i]),
            };
        }
        if let Some(correlation) = self.correlation {
            let units = &self.units;
            correlation.correlate(
                |i| normal_score(units[i]),
                |i, z| {
                    out[i] = self.inputs[i].distribution.of_score(z);
                },
            );
        }
    }
}
