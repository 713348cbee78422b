//! What one standard uncertainty of each stated quantity changes.

use super::{ErrorIndex, ErrorValues};
use nalgebra::DMatrix;
use trueaxis_geometry::Vec3;

/// What one standard uncertainty of one quantity does.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Effect {
    /// It adds to an error, mm or rad.
    Error(ErrorIndex, f64),
    /// It adds to the growth of the workpiece, mm.
    Workpiece(Vec3),
}

impl Effect {
    fn act(&self, errors: &mut ErrorValues, z: f64) {
        match self {
            Self::Error(index, u) => errors.set(*index, errors.get(*index) + z * u),
            Self::Workpiece(u_mm) => errors.workpiece_mm += u_mm * z,
        }
    }
}

/// How well the errors are known at a command: what one standard uncertainty of each uncertain
/// quantity of the machine adds to them.
///
/// The quantities are those of [`crate::Machine::uncertain_quantities`], in their order, and
/// independent of each other; one may move several errors (the expansion of a scale that lies
/// across the machine axes).
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Uncertainties(Vec<(usize, Effect)>);

impl Uncertainties {
    pub(crate) fn add(&mut self, quantity: usize, index: ErrorIndex, u: f64) {
        if u != 0.0 {
            self.0.push((quantity, Effect::Error(index, u)));
        }
    }

    pub(crate) fn add_workpiece(&mut self, quantity: usize, u_mm: Vec3) {
        if u_mm != Vec3::zeros() {
            self.0.push((quantity, Effect::Workpiece(u_mm)));
        }
    }

    /// Each quantity with one of the things that it does.
    pub(crate) fn effects(&self) -> impl Iterator<Item = (usize, &Effect)> {
        self.0.iter().map(|(quantity, effect)| (*quantity, effect))
    }

    /// The errors where each quantity is `factors` standard uncertainties away from its value;
    /// a quantity without a factor keeps it.
    pub fn displaced(&self, errors: &ErrorValues, factors: &[f64]) -> ErrorValues {
        let mut displaced = *errors;
        for (quantity, effect) in &self.0 {
            effect.act(&mut displaced, factors.get(*quantity).copied().unwrap_or(0.0));
        }
        displaced
    }

    /// The errors where one quantity is `z` standard uncertainties away from its value.
    pub fn displaced_by(&self, errors: &ErrorValues, quantity: usize, z: f64) -> ErrorValues {
        let mut displaced = *errors;
        for (_, effect) in self.0.iter().filter(|(q, _)| *q == quantity) {
            effect.act(&mut displaced, z);
        }
        displaced
    }

    /// The errors that some quantity moves; one that several move comes several times.
    pub fn errors_moved(&self) -> impl Iterator<Item = ErrorIndex> {
        self.0.iter().filter_map(|(_, effect)| match effect {
            Effect::Error(index, _) => Some(*index),
            Effect::Workpiece(_) => None,
        })
    }

    /// The quantity that lets the workpiece grow, and by how much at one standard uncertainty, mm.
    pub fn of_workpiece(&self) -> Option<(usize, Vec3)> {
        self.0.iter().find_map(|(quantity, effect)| match effect {
            Effect::Workpiece(u_mm) => Some((*quantity, *u_mm)),
            Effect::Error(..) => None,
        })
    }

    /// What one standard uncertainty of each quantity adds to some errors: a row for each quantity.
    pub fn of_quantities(&self, quantities: usize, errors: &[ErrorIndex]) -> DMatrix<f64> {
        let mut moved = DMatrix::zeros(quantities, errors.len());
        for (quantity, effect) in self.0.iter().filter(|(quantity, _)| *quantity < quantities) {
            let Effect::Error(index, u) = effect else { continue };
            if let Some(k) = errors.iter().position(|own| own == index) {
                moved[(*quantity, k)] += u;
            }
        }
        moved
    }

    /// The standard uncertainty of each error; of the growth of the workpiece along each axis.
    pub fn of_errors(&self) -> ErrorValues {
        let mut u = ErrorValues::default();
        for (_, effect) in &self.0 {
            match effect {
                Effect::Error(index, value) => u.set(*index, u.get(*index).hypot(*value)),
                Effect::Workpiece(u_mm) => {
                    u.workpiece_mm = u.workpiece_mm.zip_map(u_mm, f64::hypot);
                }
            }
        }
        u
    }
}
