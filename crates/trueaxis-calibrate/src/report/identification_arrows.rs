//! Readings as arrows: where the linear axes stand, and how far the model is off there.

use super::identification::IdentificationReport;
use trueaxis_geometry::{Mat3, Vec3};
use trueaxis_machine::axis::{AxisKind, iso_841_direction};
use trueaxis_machine::errors::ErrorValues;
use trueaxis_machine::twist::Reference;

/// Most arrows of a picture; of more readings every n-th is shown.
const MOST_ARROWS: usize = 400;

/// A reading as an arrow, mm, in the frame of the machine.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Arrow {
    /// Where the linear axes stand.
    pub at_mm: Vec3,
    /// The residual without the errors sought, along what the instrument sees.
    pub before_mm: Vec3,
    /// The residual after identification.
    pub after_mm: Vec3,
}

impl IdentificationReport<'_> {
    /// The residuals along what the instruments see; readings of angles have no arrow.
    pub fn arrows(&self) -> Vec<Arrow> {
        let count = self.records.readings.len();
        let step = count.div_ceil(MOST_ARROWS).max(1);
        (0..count).step_by(step).filter_map(|i| self.arrow(i)).collect()
    }

    fn arrow(&self, i: usize) -> Option<Arrow> {
        let (design, readings) = (&self.found.design, &self.records.readings);
        let none = ErrorValues::default();
        let instrument = &design.instruments[readings.instruments[i] as usize];
        if instrument.sight.is_angle() {
            return None;
        }
        let (machine, command) = (&design.machine, &readings.commands[i]);
        let view = instrument.view(machine, command, &none, readings.directions[i]);
        let wrenches = instrument.wrenches(&view);
        let vector = |r: &[f64; 3]| {
            (0..instrument.sight.channels()).map(|c| wrenches[c].force * r[c]).sum::<Vec3>()
        };
        // What the machine's axes do: in the frame of the machine.
        let turn = match instrument.reference {
            Reference::Bed => Mat3::identity(),
            Reference::Workpiece => {
                machine.tool_on_bed(command, &none).linear() * view.nominal.linear().transpose()
            }
        };
        let axes = machine.axes().iter().zip(command);
        let linear = axes.filter(|(axis, _)| axis.kind == AxisKind::Linear);
        let residuals = &self.found.residuals;
        Some(Arrow {
            at_mm: linear.map(|(axis, q)| iso_841_direction(axis.name) * *q).sum(),
            before_mm: turn * vector(&residuals.before[i]),
            after_mm: turn * vector(&residuals.after[i]),
        })
    }
}
