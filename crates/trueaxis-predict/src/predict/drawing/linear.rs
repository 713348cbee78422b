//! A part whose surface follows the errors of the machine to first order: cut once, judged for any machine.

use super::budget::shifts;
use super::path::CutPath;
use super::{PartStudy, cut_once};
use crate::predict::drawing::nails;
use trueaxis_input::{Diagnostics, Place};
use trueaxis_part::part::Part;

/// Deviations of the points of a part, and what each uncertain quantity of the machine does to them.
pub struct LinearPart {
    /// The part; surfaces that its file leaves to the program have their points.
    pub part: Part,
    /// Of each point, mm.
    pub(super) deviations_mm: Vec<f64>,
    /// From one standard uncertainty of each quantity below its value to one above, of each point, mm.
    pub(super) shifts_mm: Vec<Vec<f64>>,
}

impl LinearPart {
    /// Cuts the part of a study.
    ///
    /// # Errors
    /// As [`super::predict_part`].
    pub fn new(study: &PartStudy, problems: &mut Diagnostics) -> Option<Self> {
        let zero = study.zero(problems)?;
        let mut path = CutPath::new(&study.job, &zero);
        let made = cut_once(study, &mut path, &|_| (), problems)?;
        let nails = nails(&made.part);
        match shifts(study, &path, (&nails, &made.actual)) {
            Ok(shifts) => {
                let deviations_mm = made.actual.iter().map(|c| c.deviation_mm).collect();
                Some(Self { part: made.part, deviations_mm, shifts_mm: shifts.uncertain })
            }
            Err(why) => {
                let place = Place::whole(&study.path.display().to_string());
                problems.error("outside-table", place, why, "cover the travel by the table");
                None
            }
        }
    }

    /// The values of its characteristics on the machine each of whose uncertain quantities is so many standard
    /// uncertainties off, in the order of [`trueaxis_machine::Machine::uncertain_quantities`], mm; `surface` is memory to
    /// work in. docs/model.md eq. 321.
    ///
    /// # Errors
    /// In words: a surface that cannot be evaluated.
    pub fn values_mm(&self, factors: &[f64], surface: &mut Vec<f64>) -> Result<Vec<f64>, String> {
        displace((&self.deviations_mm, &self.shifts_mm), factors, surface);
        self.part.evaluate(surface).map_err(|e| e.to_string())
    }
}

/// The surface of the machine each of whose uncertain quantities is so many standard uncertainties off: docs/model.md eq. 321.
pub(super) fn displace(
    (deviations, shifts): (&[f64], &[Vec<f64>]),
    factors: &[f64],
    surface: &mut Vec<f64>,
) {
    surface.clear();
    surface.extend_from_slice(deviations);
    for (shift, z) in shifts.iter().zip(factors).filter(|(_, z)| **z != 0.0) {
        surface.iter_mut().zip(shift).for_each(|(d, s)| *d += 0.5 * z * s);
    }
}
