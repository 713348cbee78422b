//! G254 and G255 of HAAS: the work offset goes round with the table.
//!
//! # Source
//! Haas Automation, "Mill Operator's Manual" (Next Generation Control), G254 Dynamic Work Offset: for 3+1 and 3+2
//! axes; invoked after the work offset and after the rotary axes; X, Y and Z are to be programmed before a cut; the
//! rotary values of the work offset must be zero; G28, G29 and G53 do not count with it; M02, M30 and G255 end it.

use crate::moves::{Axis, AxisSet, Coordinates, Event, Move, MoveKind};
use crate::rs274::{Language, Run, fault};
use crate::text::program::Fault;

/// Whether the work offset goes round with the table.
#[derive(Debug, Clone, Copy, Default)]
pub(in crate::rs274) struct DynamicOffset {
    /// Its origin in basic coordinates, mm.
    zero_mm: Option<[f64; 3]>,
    /// The linear axes that were programmed since.
    placed: AxisSet,
}

impl DynamicOffset {
    pub fn is_on(&self) -> bool {
        self.zero_mm.is_some()
    }
}

impl Run<'_> {
    /// G254 and G255.
    pub(in crate::rs274) fn dynamic_offset(&mut self, on: bool, at: usize) -> Result<(), Fault> {
        if !on {
            if self.modes.dynamic.is_on() {
                self.set_dynamic_offset(None);
            }
            return Ok(());
        }
        let other = match (self.core.modes.tool_centre, self.modes.transforms.tilted) {
            (true, _) => Some("tool-centre-point control is"),
            (_, true) => Some("a tilted plane is"),
            _ => None,
        };
        if let Some(other) = other {
            let message =
                format!("G254 while {other} on: both say what the rotary axes do to the place");
            return Err(fault(
                "dynamic-offset-twice",
                at,
                message,
                "end the other first: G49 or G69",
            ));
        }
        let work = self.frames.work().offset.plus(&self.frames.external);
        let turned = Axis::ALL.into_iter().find(|a| a.is_rotary() && work[*a] != 0.0);
        if let Some(axis) = turned {
            let message = format!(
                "G254 with a work offset whose {axis} is {} deg: the rotary values must be 0",
                work[axis]
            );
            let hint = "set the rotary values of the work offset to 0 and turn the table by words";
            return Err(fault("dynamic-offset-turned", at, message, hint));
        }
        self.modes.dynamic.placed = AxisSet::default();
        self.set_dynamic_offset(Some(self.dynamic_zero()));
        Ok(())
    }

    /// A code that cannot be on together with G254.
    pub(in crate::rs274) fn refuse_with_dynamic_offset(
        &self,
        what: &str,
        at: usize,
    ) -> Result<(), Fault> {
        if !self.modes.dynamic.is_on() {
            return Ok(());
        }
        let message =
            format!("{what} while G254 is on: both say what the rotary axes do to the place");
        Err(fault("dynamic-offset-twice", at, message, "end G254 first: G255"))
    }

    /// The origin of the work offset. G52 and the frames of the program stay along the axes, as seen from it.
    fn dynamic_zero(&self) -> [f64; 3] {
        let zero = self.frames.work().offset.plus(&self.frames.external);
        [zero.0[0], zero.0[1], zero.0[2]]
    }

    fn set_dynamic_offset(&mut self, zero_mm: Option<[f64; 3]>) {
        self.modes.dynamic.zero_mm = zero_mm;
        self.core.emit(Event::DynamicOffset(zero_mm));
    }

    /// Tells the origin if it has changed while G254 is on.
    pub(in crate::rs274) fn emit_dynamic_offset(&mut self) {
        let zero = self.dynamic_zero();
        if self.modes.dynamic.zero_mm.is_some_and(|old| old != zero) {
            self.set_dynamic_offset(Some(zero));
        }
    }

    /// Does something as if all rotary axes stood at zero, as G28 does while G254 is on.
    pub(in crate::rs274) fn as_at_zero(&mut self, work: impl FnOnce(&mut Self)) {
        let zero = self.modes.dynamic.zero_mm;
        if zero.is_some() {
            self.set_dynamic_offset(None);
            self.settle();
        }
        work(self);
        if zero.is_some() {
            self.set_dynamic_offset(zero);
        }
    }

    /// What the manual forbids while G254 is on; the place after a rotary axis is read again.
    pub(in crate::rs274) fn watch_dynamic_offset(&mut self, step: &Move) {
        let moves = !matches!(step.kind, MoveKind::Dwell { .. });
        if !self.modes.dynamic.is_on() || !moves || step.coordinates == Coordinates::Machine {
            return;
        }
        let at = self.core.start;
        self.modes.dynamic.placed.0 |= step.named.0;
        let missing = [Axis::X, Axis::Y, Axis::Z]
            .into_iter()
            .find(|axis| !self.modes.dynamic.placed.contains(*axis));
        if let Some(axis) = missing.filter(|_| step.kind != MoveKind::Rapid) {
            let message = format!(
                "a cut after G254 before {axis} is programmed: {axis} stays where the axis is"
            );
            let hint =
                "write X and Y in one block and Z in the next, after G254 and before the cut";
            self.core.warn("dynamic-offset-place", axis as u32, at, message, hint);
        }
        let from = &self.frames.position;
        let turns = |a: &Axis| step.named.contains(*a) && step.target[*a] != from[*a];
        let turned = Axis::ALL.into_iter().filter(|a| a.is_rotary()).find(turns);
        if let Some(axis) = turned {
            let message = format!(
                "{axis} turns while G254 is on: coordinates count from where the origin is at the end of the block"
            );
            let hint =
                "end G254 by G255 before the rotary axes turn, and write it again afterwards";
            self.core.warn("dynamic-offset-turns", axis as u32, at, message, hint);
            self.core.read_again();
        }
    }
}
