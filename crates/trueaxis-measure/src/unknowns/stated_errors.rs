//! What the machine states of its errors, for groups of commands: constants once, functions of position per command.

use trueaxis_machine::Machine;
use trueaxis_machine::batch::{GROUP, Group, Station};
use trueaxis_machine::chain::ChainBody;
use trueaxis_machine::errors::{Component, Curve, ErrorKind, OutsideTable, StatedError};
use trueaxis_machine::heat::ThermalTerm;

/// The stated errors of the stations of a machine.
#[derive(Debug)]
pub(super) struct StatedErrors<'a> {
    /// The sums that do not depend on the command, of each station the same in every lane, mm and rad.
    constants: Vec<[Group; 6]>,
    varying: Vec<Varying<'a>>,
}

/// An error that is not the same everywhere.
#[derive(Debug)]
struct Varying<'a> {
    station: usize,
    component: usize,
    /// None: of a body that does not move; its position is 0.
    axis: Option<usize>,
    stated: Option<&'a StatedError>,
    warm: Vec<&'a ThermalTerm>,
}

impl<'a> StatedErrors<'a> {
    pub(super) fn new(machine: &'a Machine, stations: &[Station]) -> Self {
        let mut all =
            Self { constants: vec![[[0.0; GROUP]; 6]; stations.len()], varying: Vec::new() };
        for (station, Station { body, kind }) in stations.iter().enumerate() {
            let body = &machine.bodies()[*body];
            for component in Component::ALL {
                all.add(body, station, *kind, component);
            }
        }
        all
    }

    /// Whether the machine states anything at a station.
    pub(super) fn has(body: &ChainBody, kind: ErrorKind) -> bool {
        let is_warm = body.thermal.iter().any(|term| term.kind == kind);
        is_warm || Component::ALL.into_iter().any(|c| body.stated(kind, c).is_some())
    }

    fn add(&mut self, body: &'a ChainBody, station: usize, kind: ErrorKind, component: Component) {
        let stated = body.stated(kind, component);
        let of = |term: &&ThermalTerm| (term.kind, term.component) == (kind, component);
        let warm: Vec<&ThermalTerm> = body.thermal.iter().filter(of).collect();
        let constant = |curve: &Curve| match curve {
            Curve::Constant(value) => Some(*value),
            _ => None,
        };
        let of_stated = |error: &StatedError| match error.reversal {
            None => constant(&error.mean),
            Some(_) => None,
        };
        let stated_constant = stated.map_or(Some(0.0), of_stated);
        let warm_constant = warm.iter().map(|term| constant(&term.curve)).sum::<Option<f64>>();
        let component = component as usize;
        match stated_constant.zip(warm_constant) {
            Some((stated, warm)) => self.constants[station][component] = [stated + warm; GROUP],
            None => {
                let axis = body.axis;
                self.varying.push(Varying { station, component, axis, stated, warm });
            }
        }
    }

    /// Writes the errors of each station at commands, reached from these sides.
    ///
    /// # Errors
    /// A command outside an error table.
    pub(super) fn put(
        &self,
        commands: &[Group; 6],
        approaches: &[Group; 6],
        errors: &mut Vec<[Group; 6]>,
    ) -> Result<(), OutsideTable> {
        errors.clear();
        errors.extend_from_slice(&self.constants);
        for Varying { station, component, axis, stated, warm } in &self.varying {
            let error = &mut errors[*station][*component];
            for (lane, error) in error.iter_mut().enumerate() {
                let at = |columns: &[Group; 6]| axis.map_or(0.0, |axis| columns[axis][lane]);
                let q = at(commands);
                *error = match stated {
                    Some(stated) => stated.at(q, at(approaches))?,
                    None => 0.0,
                };
                for term in warm {
                    *error += term.at(q);
                }
            }
        }
        Ok(())
    }
}
