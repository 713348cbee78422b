//! The holes of a study on many machines: commands and compensation once, places for any errors.

use super::{Applied, Hole, HoleStudy, drill, felt};
use crate::predict::location::LocationCircle;
use trueaxis_geometry::Vec3;
use trueaxis_machine::Machine;
use trueaxis_machine::axis::Command;
use trueaxis_machine::errors::{ErrorValues, Uncertainties};

/// One hole where it is commanded.
struct Commanded {
    command: Command,
    errors: ErrorValues,
    u: Uncertainties,
    added_mm: Vec3,
    increments: [i64; 3],
}

/// Holes that are commanded as the study says: the control knows the machine of its file, and the actual one differs.
pub struct CommandedHoles<'a> {
    machine: &'a Machine,
    places_mm: &'a [Vec3],
    holes: Vec<Commanded>,
}

/// Where the holes of one machine are.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HolesOfMachine {
    /// The largest distance of a hole from its place in X and Y, mm.
    pub worst_mm: f64,
    /// Of the circle on which they are, what its tolerance judges, less the nominal diameter; none for fewer than three holes. Unit: mm.
    pub diameter_mm: Option<f64>,
}

impl<'a> CommandedHoles<'a> {
    /// The holes with the compensation that the study applies, computed for the machine that the control knows: that of the
    /// study, or the same at other temperatures. `actual` is what makes them.
    ///
    /// # Errors
    /// In words: a record of what acted, which belongs to one part; a hole that cannot be reached.
    pub fn new(study: &'a HoleStudy, known: &Machine, actual: &'a Machine) -> Result<Self, String> {
        let Applied::By(compensation) = study.applied else {
            return Err("a record of what acted belongs to the one part that was made".to_owned());
        };
        let quantities = actual.uncertain_quantities();
        let commanded = |(i, place): (usize, &Vec3)| {
            let named = |why: String| format!("hole {}: {why}", i + 1);
            let (hole, _) =
                drill(known, study.increment_mm, *place, compensation).map_err(named)?;
            let added_mm = Vec3::from(hole.increments.map(|n| n as f64 * study.increment_mm));
            let (command, errors) = felt(actual, place + added_mm).map_err(named)?;
            let u = actual.uncertainties_at(&command, &quantities);
            Ok(Commanded { command, errors, u, added_mm, increments: hole.increments })
        };
        let holes =
            study.holes_mm.iter().enumerate().map(commanded).collect::<Result<_, String>>()?;
        Ok(Self { machine: actual, places_mm: &study.holes_mm, holes })
    }

    /// The holes of the machine each of whose uncertain quantities is so many units off, in the order of
    /// [`Machine::uncertain_quantities`].
    pub fn of_machine(&self, factors: &[f64]) -> HolesOfMachine {
        let hole = |h: &Commanded| {
            let actual = h.u.displaced(&h.errors, factors);
            let error_mm = h.added_mm + self.machine.deviation(&h.command, &actual).tip_mm;
            Hole { increments: h.increments, error_mm, u_mm: Vec3::zeros(), u_distance_mm: 0.0 }
        };
        let holes: Vec<Hole> = self.holes.iter().map(hole).collect();
        let worst_mm = holes.iter().map(Hole::distance_mm).fold(0.0, f64::max);
        let no_u = vec![Vec::new(); holes.len()];
        let circle = LocationCircle::of(self.places_mm, &holes, &no_u);
        HolesOfMachine { worst_mm, diameter_mm: circle.map(|c| c.largest_mm().0) }
    }
}
