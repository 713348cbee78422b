//! What a micrometre or a microradian of each location error does to each index, and how well the
//! indices are known.

use super::Error;
use super::cutting::Change;
use super::judge::Judge;
use trueaxis_machine::Machine;
use trueaxis_machine::errors::{Component, ErrorIndex, ErrorKind, ErrorName};

/// The step of the central difference: 1 µm or 1 µrad, small beside errors, large beside rounding.
const STEP_MM: f64 = 1e-3;
const STEP_RAD: f64 = 1e-6;

/// How fast every index changes with one location error.
#[derive(Debug, Clone, PartialEq)]
pub struct Sensitivity {
    /// The location error; it need not be stated in the machine file.
    pub error: ErrorName,
    /// Change of each index with the error, a shift or a rotation. Unit: mm/mm or mm/rad.
    pub slope: Vec<f64>,
}

/// The slope of every index in every location error of the chain.
///
/// ```text
///     ∂I/∂e ≈ (I(e + h) − I(e − h)) / 2h                                docs/model.md eq. 30
/// ```
///
/// An index such as a zone width has kinks; the slope is the mean of the two sides there.
///
/// # Errors
/// As [`Judge::indices`].
pub fn sensitivities(machine: &Machine, judge: &Judge<'_>) -> Result<Vec<Sensitivity>, Error> {
    let mut all = Vec::new();
    for (body, b) in machine.bodies().iter().enumerate() {
        for component in Component::ALL {
            let kind = ErrorKind::Location;
            let index = ErrorIndex { body, kind, component };
            let step = if component.is_rotation() { STEP_RAD } else { STEP_MM };
            let [above, below] = [step, -step].map(|step| shifted(judge, index, step));
            let (above, below) = (above?, below?);
            let slope = above.iter().zip(below).map(|(a, b)| (a - b) / (2.0 * step)).collect();
            all.push(Sensitivity { error: ErrorName { body: b.name, kind, component }, slope });
        }
    }
    Ok(all)
}

/// The indices after a constant is added to one error.
///
/// # Errors
/// As [`Judge::indices`].
pub fn shifted(judge: &Judge<'_>, index: ErrorIndex, by: f64) -> Result<Vec<f64>, Error> {
    judge.once(&|values, _| {
        let mut changed = *values;
        changed.set(index, changed.get(index) + by);
        changed
    })
}

/// The standard uncertainty of any result of a cut by linear propagation.
///
/// ```text
///     u²(I) = Σ ( (I(z = +1) − I(z = −1)) / 2 )²                        docs/model.md eq. 31
/// ```
///
/// One standard-normal factor z per stated error moves the whole curve by its standard
/// uncertainty, one per coefficient of the thermal parts all that it makes grow; the step is one
/// standard uncertainty. `results` cuts with changed errors and
/// returns what is asked about.
///
/// # Errors
/// As [`Judge::indices`].
///
/// # Source
/// JCGM 100:2008 (GUM), 5.1.2 and the note of 5.1.3 on numerical sensitivity coefficients.
pub fn propagate(
    machine: &Machine,
    results: &dyn Fn(&Change<'_>) -> Result<Vec<f64>, Error>,
) -> Result<Vec<f64>, Error> {
    let mut variance: Vec<f64> = Vec::new();
    for quantity in 0..machine.uncertain_quantities().len() {
        let drawn = |z: f64| results(&move |values, u| u.displaced_by(values, quantity, z));
        let (above, below) = (drawn(1.0)?, drawn(-1.0)?);
        variance.resize(above.len(), 0.0);
        for ((sum, a), b) in variance.iter_mut().zip(above).zip(below) {
            *sum += (0.5 * (a - b)).powi(2);
        }
    }
    Ok(variance.into_iter().map(f64::sqrt).collect())
}
