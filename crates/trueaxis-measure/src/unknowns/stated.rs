//! What the stated uncertainties of a machine do to readings, and through them to what is found from these.
//!
//! ```text
//!     s = J_e u + …      what one standard uncertainty of each quantity of the machine file adds to a reading
//!     M = (JᵀWJ)⁺ JᵀW S          C' = C + M Mᵀ                                      docs/model.md eq. 346
//! ```
//!
//! A quantity is an error that is stated with an uncertainty and is no unknown, or a coefficient of expansion. It is the same in
//! every reading, so that no number of readings averages it away.

use super::design::Design;
use super::determined::Determined;
use super::fit::Observability;
use super::term::{Basis, Term};
use crate::instruments::Readings;
use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;
use trueaxis_machine::Machine;
use trueaxis_machine::axis::Command;
use trueaxis_machine::errors::{ErrorIndex, ErrorName, ErrorValues, Uncertainties};

/// Rows that one thread takes at a time: fixed, so that sums do not depend on the machine.
const CHUNK: usize = 512;

/// What is stated with an uncertainty in the machine of a design.
#[derive(Debug, Clone)]
pub struct Stated {
    /// The unknowns of the design first, then a constant for each uncertain error.
    all: Design,
    /// Where the unknowns of the design stand among these.
    own: Vec<usize>,
    /// Where the constants begin.
    first: usize,
    errors: Vec<ErrorIndex>,
    /// Those of the machine, then those of what was known before.
    quantities: Vec<String>,
    of_machine: usize,
}

/// One number of a reading.
#[derive(Debug, Clone, PartialEq)]
pub struct Effects {
    /// How it follows each unknown. Unit: mm or rad per unit of the unknown.
    pub slopes: DVector<f64>,
    /// What one standard uncertainty of each quantity adds to it. Unit: mm or rad.
    pub stated: DVector<f64>,
}

impl Stated {
    /// Of a design at the places of some readings.
    pub fn of(design: &Design, readings: &Readings) -> Self {
        let machine = &design.machine;
        let mut quantities = machine.uncertain_quantities();
        let errors = errors_moved(machine, &quantities, readings);
        if errors.is_empty() && !design.instruments.iter().any(|i| i.kind.reads_the_workpiece()) {
            quantities.clear();
        }
        let of_machine = quantities.len();
        for (name, _) in design.known().into_iter().flat_map(|known| &known.stated) {
            if !quantities.contains(name) {
                quantities.push(name.clone());
            }
        }
        let constant = |index: &ErrorIndex| Term {
            error: ErrorName {
                body: machine.bodies()[index.body].name,
                kind: index.kind,
                component: index.component,
            },
            index: *index,
            axis: None,
            basis: Basis::Constant,
            prior: None,
        };
        let further: Vec<Term> = errors.iter().map(constant).collect();
        let (first, count) = (design.terms.len(), further.len());
        let own = (0..design.unknowns()).map(|k| if k < first { k } else { k + count }).collect();
        let all = design.with_more(&further);
        Self { all, own, first, errors, quantities, of_machine }
    }

    /// The names of the quantities; none if none of them changes a reading.
    pub fn names(&self) -> &[String] {
        &self.quantities
    }

    /// The numbers of a reading.
    pub fn effects(&self, readings: &Readings, row: usize) -> Vec<Effects> {
        let width = self.all.unknowns();
        let mut slopes = vec![0.0; 3 * width];
        let channels = self.all.slopes(readings, row, &mut slopes);
        let quantities = &self.quantities[..self.of_machine];
        let known = self.all.machine.uncertainties_at(&readings.commands[row], quantities);
        let u = known.of_quantities(self.quantities.len(), &self.errors);
        let growth = self.growth(readings, row, &known);
        let of_channel = |c: usize| {
            let row = &slopes[c * width..(c + 1) * width];
            let constants = &row[self.first..self.first + self.errors.len()];
            let mut stated = &u * DVector::from_column_slice(constants);
            if let Some((quantity, read)) = &growth {
                stated[*quantity] += read[c];
            }
            let slopes = DVector::from_iterator(self.own.len(), self.own.iter().map(|k| row[*k]));
            Effects { slopes, stated }
        };
        (0..channels).map(of_channel).collect()
    }

    /// What an instrument on the workpiece reads of one standard uncertainty of its expansion.
    fn growth(
        &self,
        readings: &Readings,
        row: usize,
        known: &Uncertainties,
    ) -> Option<(usize, [f64; 3])> {
        let design = &self.all;
        let instrument = &design.instruments[readings.instruments[row] as usize];
        if !instrument.kind.reads_the_workpiece() {
            return None;
        }
        let (quantity, by) = known.of_workpiece()?;
        let grown = |errors: &mut ErrorValues| errors.workpiece_mm += by;
        let nominal = vec![0.0; design.unknowns()];
        let with = design.read_with(readings, row, &nominal, grown).ok()?;
        let without = design.read(readings, row, &nominal).ok()?;
        Some((quantity, std::array::from_fn(|c| with[c] - without[c])))
    }

    /// JᵀWS: a row for each unknown of the design, a column for each quantity; `weights` of the readings, empty for 1.
    pub fn pull(&self, readings: &Readings, weights: &[f64]) -> DMatrix<f64> {
        let zeros = || DMatrix::zeros(self.own.len(), self.quantities.len());
        if self.quantities.is_empty() {
            return zeros();
        }
        let rows: Vec<usize> = (0..readings.len()).collect();
        let of_chunk = |rows: &[usize]| {
            let mut pull = zeros();
            for row in rows {
                let noise = self.all.instruments[readings.instruments[*row] as usize].noise;
                let weight = weights.get(*row).copied().unwrap_or(1.0);
                for (number, noise) in self.effects(readings, *row).iter().zip(noise) {
                    pull.ger(weight * noise.powi(-2), &number.slopes, &number.stated, 1.0);
                }
            }
            pull
        };
        let parts: Vec<DMatrix<f64>> = rows.par_chunks(CHUNK).map(of_chunk).collect();
        let mut pull = parts.into_iter().fold(zeros(), |sum, part| sum + part);
        for (name, by) in self.all.known().into_iter().flat_map(|known| &known.stated) {
            if let Some(k) = self.quantities.iter().position(|own| own == name) {
                let mut column = pull.column_mut(k);
                column += by.select_rows(&self.own);
            }
        }
        pull
    }

    /// M less what each quantity adds to the error itself: how far an error that comes in addition to what is stated of it is off
    /// together with that, for constants.
    pub fn off_together(&self, mut moved: DMatrix<f64>, readings: &Readings) -> DMatrix<f64> {
        let Some(command) = readings.commands.first() else { return moved };
        let machine = self.all.machine.without_heat();
        let quantities = machine.uncertain_quantities();
        let known = machine.uncertainties_at(command, &quantities);
        let terms = self.all.terms[..self.first].iter().enumerate();
        for (k, term) in terms.filter(|(_, term)| term.basis == Basis::Constant) {
            let u = known.of_quantities(quantities.len(), &[term.index]);
            for (name, u) in quantities.iter().zip(u.iter()) {
                if let Some(q) = self.quantities.iter().position(|own| own == name) {
                    moved[(k, q)] -= u;
                }
            }
        }
        moved
    }

    /// M: how the unknowns of the design move by one standard uncertainty of each quantity.
    pub fn moved(
        &self,
        (design, sight): (&Design, &Observability),
        readings: &Readings,
        weights: &[f64],
    ) -> DMatrix<f64> {
        let changes = sight.covariance() * self.pull(readings, weights);
        Determined::moved(design, sight, &changes)
    }
}

/// The errors that are uncertain at some of the places; tables of u may be 0 at others.
fn errors_moved(machine: &Machine, quantities: &[String], readings: &Readings) -> Vec<ErrorIndex> {
    if quantities.is_empty() {
        return Vec::new();
    }
    let of_chunk = |commands: &[Command]| {
        let mut errors: Vec<ErrorIndex> = Vec::new();
        for command in commands {
            let known = machine.uncertainties_at(command, quantities);
            for index in known.errors_moved() {
                if !errors.contains(&index) {
                    errors.push(index);
                }
            }
        }
        errors
    };
    let mut all: Vec<ErrorIndex> =
        readings.commands.par_chunks(CHUNK).map(of_chunk).collect::<Vec<_>>().concat();
    all.sort();
    all.dedup();
    all
}
