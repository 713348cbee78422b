//! Cutter radius compensation: G40, G41, G42, and G41.1, G42.1 of LinuxCNC.
//!
//! # Source
//! LinuxCNC 2.9 user manual, "Tool Compensation", and its interpreter as judge (`oracles/`); FANUC Series
//! 30i operator's manual, "Overview of cutter compensation": start-up and cancel of type A, outside corners
//! on lines.

use trueaxis_contour::radius::{Outside, Rules};

use super::{Run, fault};
use crate::execution::mistakes;
use crate::execution::radius::{Behaviour, Entry};
use crate::moves::{CompensationSide, Plane};
use crate::text::program::Fault;

/// LinuxCNC: arcs round corners; corners of less than 0.05 rad count as none.
const LINUXCNC: Behaviour = Behaviour {
    rules: Rules { outside: Outside::Arc, smooth_rad: 0.05 },
    entry: Entry::Element,
    enters_on_arcs: true,
    ends_at_once: true,
    radius_at_end: true,
    ..Behaviour::USUAL
};

const FANUC: Behaviour =
    Behaviour { rules: Rules { outside: Outside::Tangents, smooth_rad: 0.0 }, ..Behaviour::USUAL };

/// The variables of FANUC that hold the wear of the radius begin after this one.
pub(super) const RADIUS_WEAR: u32 = 12_000;

impl Run<'_> {
    /// G40, G41, G42 with D, the number of the radius; `direct`: D is the diameter itself.
    pub(super) fn compensation(
        &mut self,
        side: CompensationSide,
        direct: bool,
        at: usize,
    ) -> Result<(), Fault> {
        let written = self.words.take(b'D');
        if self.words.take(b'L').is_some_and(|nose| nose != 0.0 && nose != 9.0) {
            self.core.left_out("L of G41.1, the orientation of a lathe tool,", at);
        }
        if side != CompensationSide::Off && !self.is_fanuc() {
            self.check_linuxcnc(at)?;
        }
        self.modes.compensation = side;
        let radius = match (side, direct, written) {
            (CompensationSide::Off, ..) => Some(0.0),
            (_, true, Some(diameter)) => Some(diameter * self.core.modes.unit_mm() / 2.0),
            (_, true, None) => {
                let message = "G41.1 and G42.1 need D, the diameter of the tool";
                return Err(fault("missing-value", at, message, "write G41.1 D10"));
            }
            (_, false, number) => self.radius_of(number, at)?,
        };
        self.run_along(side, radius, at);
        Ok(())
    }

    /// D alone while the compensation is on is another radius (FANUC).
    pub(super) fn reselect_radius(&mut self, at: usize) -> Result<(), Fault> {
        if self.words.look(b'D').is_none() {
            return Ok(());
        }
        let number = self.words.take(b'D');
        let side = self.modes.compensation;
        if side == CompensationSide::Off {
            self.modes.last[2] = number.unwrap_or(0.0);
            return Ok(());
        }
        let radius = self.radius_of(number, at)?;
        self.run_along(side, radius, at);
        Ok(())
    }

    /// Moves to places of the machine. FANUC interrupts the compensation for them, LinuxCNC does not allow them.
    pub(super) fn off_contour(
        &mut self,
        name: &str,
        at: usize,
        moves: impl FnOnce(&mut Self) -> Result<(), Fault>,
    ) -> Result<(), Fault> {
        if self.core.has_radius()
            && !self.is_fanuc()
            && self.modes.compensation != CompensationSide::Off
        {
            return Err(mistakes::cycle_on_contour(name, at));
        }
        let Some((centre, back)) = self.core.interrupt_contour() else { return moves(self) };
        self.frames.position = centre;
        moves(self)?;
        if let Some((left_mm, behaviour)) = back {
            let place = self.frames.position;
            self.core.begin_radius(left_mm, behaviour, place, at);
        }
        Ok(())
    }

    fn run_along(&mut self, side: CompensationSide, radius: Option<f64>, at: usize) {
        let behaviour = if self.is_fanuc() { FANUC } else { LINUXCNC };
        let place = self.frames.position;
        self.core.compensate(side, radius, behaviour, place, at);
    }

    fn check_linuxcnc(&self, at: usize) -> Result<(), Fault> {
        if self.core.has_radius() && self.modes.compensation != CompensationSide::Off {
            let message = "the radius compensation is on already";
            return Err(fault("bad-compensation", at, message, "write G40 before"));
        }
        if self.core.modes.plane == Plane::Yz {
            let message = "LinuxCNC has radius compensation in the planes XY and XZ only";
            return Err(fault("bad-compensation", at, message, "write G17 or G18 before"));
        }
        Ok(())
    }

    /// The radius of D; `None`, with a warning, if it is not stated anywhere.
    pub(super) fn radius_of(
        &mut self,
        written: Option<f64>,
        at: usize,
    ) -> Result<Option<f64>, Fault> {
        let number = match written {
            Some(d) if d.fract() == 0.0 && (0.0..1e9).contains(&d) => d as u32,
            Some(d) => return Err(mistakes::bad_tool(format_args!("D{d}"), at)),
            None if self.is_fanuc() => self.modes.last[2] as u32,
            None => self.core.modes.tool,
        };
        self.modes.last[2] = f64::from(number);
        if number == 0 && self.is_fanuc() {
            // D0 is the radius 0; without any D it is what the control takes.
            if written.is_none() {
                self.core.unknown_radius("without D", at);
            }
            return Ok(Some(0.0));
        }
        let wear = self.globals.get(&(RADIUS_WEAR + number)).copied().unwrap_or(0.0);
        let wear_mm = if self.is_fanuc() { wear * self.core.modes.unit_mm() } else { 0.0 };
        let radius = self.core.radii.get(&number).map(|r| r + wear_mm);
        if radius.is_none() {
            self.core.unknown_radius(format_args!("of tool {number}"), at);
        }
        Ok(radius)
    }
}
