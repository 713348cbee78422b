//! CYCLE800 and CYCLE832.

use super::values::Value;
use super::{Language, Run, fault, transform};
use crate::execution::mistakes;
use crate::moves::turns::{cross, from_axes, unit};
use crate::moves::{Axis, Branch, Event, Frame, Move, MoveKind, PathControl, Position};
use crate::text::program::Fault;

/// The parameters of a cycle by their place.
pub(super) struct Parameters<'a> {
    pub values: &'a [Option<Value>],
    pub at: usize,
}

impl Parameters<'_> {
    /// A number; an omitted one is `None`.
    pub fn number(&self, index: usize) -> Result<Option<f64>, Fault> {
        let Some(Some(value)) = self.values.get(index) else { return Ok(None) };
        let number = value.number(self.at)?;
        if number.abs() > 1e12 {
            return Err(mistakes::too_large(number, "a cycle", self.at));
        }
        Ok(Some(number))
    }

    pub fn or_zero(&self, index: usize) -> Result<f64, Fault> {
        Ok(self.number(index)?.unwrap_or(0.0))
    }
}

impl Run<'_> {
    /// CYCLE800(_FR,_TC,_ST,_MODE,_X0,_Y0,_Z0,_A,_B,_C,_X1,_Y1,_Z1,_DIR,_FR_I,_DMODE).
    ///
    /// ```text
    /// swivel frame = [swivel frame] · shift(X0) · rotation · shift(X1)
    /// ```
    ///
    /// # Source
    /// Operating Manual "Milling" and Programming Manual "Job Planning", swivelling CYCLE800. Of _ST
    /// the units (new or additive) and tens (tip follows) are read, of the other digits nothing. That
    /// a new plane deletes the programmable frame is said there; that an additive one keeps it after
    /// the swivel frame is our reading.
    pub(super) fn cycle_800(&mut self, parameters: &Parameters<'_>) -> Result<(), Fault> {
        self.settle();
        let at = parameters.at;
        let deselected = matches!(parameters.values.get(1), Some(Some(Value::Text(t))) if t == "0");
        if parameters.values.iter().all(Option::is_none) || deselected {
            return self.reset_swivel(at);
        }
        let status = parameters.or_zero(2)?.abs() as u64;
        let (additive, keep_tip) = (status % 10 == 1, status / 10 % 10 == 1);
        let mode = parameters.number(3)?.unwrap_or(57.0).clamp(0.0, 255.0) as u8;
        let angles = [7, 8, 9].map(|i| parameters.or_zero(i));
        let [a, b, c] = angles;
        let Some(rotation) = swivel_rotation(mode, [a?, b?, c?], at)? else {
            let hint = "use swivel angles of the plane; rotary-axis angles depend on the machine";
            self.core.not_applied("CYCLE800 by angles of the rotary axes", at, hint);
            return Ok(());
        };
        let unit = self.core.modes.unit_mm();
        let shift = |from: usize| -> Result<Frame, Fault> {
            let mut shift = Position::default();
            for i in 0..3 {
                shift.0[i] = parameters.or_zero(from + i)? * unit;
            }
            Ok(Frame::shifted(shift))
        };
        let own = shift(4)?.after(&rotation).after(&shift(10)?);
        let kept = self.chain.change(|c| {
            if additive {
                c.swivel = c.swivel.after(&own);
            } else {
                c.swivel = own;
                c.programmable = Frame::IDENTITY;
            }
        });
        if !kept {
            return Err(mistakes::flat_frame(at));
        }
        if parameters.or_zero(0)? != 0.0 {
            let hint = "write the retraction as a move before the cycle";
            self.core.not_applied("the retraction of CYCLE800", at, hint);
        }
        // A plane that is not turned is no other than the axes'.
        let tilted = self.chain.swivel.linear != Frame::IDENTITY.linear;
        self.core.emit(Event::TiltedPlane(tilted));
        self.emit_frame();
        let branch = match parameters.or_zero(13)? {
            d if d > 0.0 => Branch::Positive,
            d if d < 0.0 => Branch::Negative,
            _ => return Ok(()),
        };
        self.align(keep_tip, branch);
        Ok(())
    }

    fn reset_swivel(&mut self, at: usize) -> Result<(), Fault> {
        if !self.chain.change(|c| c.swivel = Frame::IDENTITY) {
            return Err(mistakes::flat_frame(at));
        }
        self.core.emit(Event::TiltedPlane(false));
        self.emit_frame();
        Ok(())
    }

    fn align(&mut self, keep_tip: bool, branch: Branch) {
        let position = self.chain.position;
        let kind = MoveKind::Align { keep_tip, branch };
        let (feed, origin) = (self.core.modes.feed, self.core.origin);
        self.core.emit_move(Move::plain(kind, position, Default::default(), feed, origin));
        let direction = self.chain.frame().vector([0.0, 0.0, 1.0]);
        let machine = self.chain.machine();
        if let Some(angles) = self.core.library.rotary_angles(direction, branch, &machine) {
            let shift = self.chain.frame().shift;
            for (axis, angle) in [Axis::A, Axis::B, Axis::C].into_iter().zip(angles) {
                self.chain.position[axis] = angle - shift[axis] - self.chain.tool[axis];
            }
        }
        self.modes.tangent = None;
    }

    /// TOROT: the rotation of the programmable frame puts Z along the tool, X into the plane of Z and X before;
    /// TOROTOF ends the rotation.
    ///
    /// # Source
    /// SINUMERIK 840D sl Programming Manual "Fundamentals", frame generation by tool orientation; that X lies in
    /// the old plane is the default of MD21110.
    pub(super) fn frame_along_tool(&mut self, on: bool, at: usize) -> Result<(), Fault> {
        let now = self.axis_positions();
        let turn = self.core.library.tool_turn([Axis::A, Axis::B, Axis::C].map(|a| now[a]));
        let mut linear = Frame::IDENTITY.linear;
        if on {
            let Some(turn) = turn.filter(|_| self.core.modes.tool_centre) else {
                let hint = "it needs TRAORI and a machine, which knows how the tool stands";
                self.core.not_applied("TOROT", at, hint);
                return Ok(());
            };
            let outer = Frame {
                shift: Position::default(),
                ..self.chain.settable.after(&self.chain.swivel)
            };
            let mut axis = Position::default();
            axis.0[..3].copy_from_slice(&turn.map(|row| row[2]));
            let Some(z) = outer.inverse_place(&axis) else { return Err(mistakes::flat_frame(at)) };
            let z = [z.0[0], z.0[1], z.0[2]];
            let across = unit([z[2], 0.0, -z[0]]).zip(unit(z));
            let Some((x, z)) = across else {
                let hint = "the tool is along Y: turn it away";
                self.core.not_applied("TOROT along Y", at, hint);
                return Ok(());
            };
            linear = from_axes([x, cross(z, x), z], [0.0; 3]).linear;
        }
        if !self.chain.change(|c| c.programmable.linear = linear) {
            return Err(mistakes::flat_frame(at));
        }
        self.emit_frame();
        Ok(())
    }

    /// CYCLE832(_TOL, _TOLM, …): the tolerance of the path; without parameters it ends.
    ///
    /// # Source
    /// Operating Manual "Milling", high-speed settings: the units of the second parameter are 0 to
    /// deselect, 1 finishing, 2 semi-finishing, 3 roughing.
    pub(super) fn cycle_832(&mut self, parameters: &Parameters<'_>) -> Result<(), Fault> {
        let off = parameters.number(1)?.is_some_and(|m| (m.abs() as u64).is_multiple_of(10));
        let tolerance = if off { 0.0 } else { parameters.or_zero(0)?.max(0.0) };
        self.report_path(PathControl::Continuous, tolerance * self.core.modes.unit_mm());
        Ok(())
    }
}

/// The rotation of CYCLE800; `None` where only the machine knows it.
///
/// # Source
/// Operating Manual "Milling", CYCLE800, _MODE: bits 7 and 6 are 00 axis by axis, 01 solid angle, 10
/// projection angle, 11 rotary axes direct; bits 1-0, 3-2 and 5-4 name the axes of the first, second
/// and third angle, 01 X, 10 Y, 11 Z. So 57 = 00 11 10 01 turns about X, Y', Z''.
fn swivel_rotation(mode: u8, angles_deg: [f64; 3], at: usize) -> Result<Option<Frame>, Fault> {
    let axis = |place: u8| match mode >> (2 * place) & 3 {
        1 => Some(Axis::X),
        2 => Some(Axis::Y),
        3 => Some(Axis::Z),
        _ => None,
    };
    let [a, b, c] = angles_deg;
    match mode >> 6 {
        0 => {
            let mut rotation = Frame::IDENTITY;
            for (place, angle) in angles_deg.into_iter().enumerate() {
                if angle == 0.0 {
                    continue;
                }
                let Some(axis) = axis(place as u8) else {
                    let message =
                        format!("_MODE {mode} of CYCLE800 does not name an axis for each angle");
                    return Err(fault(
                        "bad-swivel-mode",
                        at,
                        message,
                        "write for example 57: X, then Y, then Z",
                    ));
                };
                rotation = rotation.after(&transform::turned(axis, angle));
            }
            Ok(Some(rotation))
        }
        // About Z, then about the new Y.
        1 => Ok(Some(transform::turned(Axis::Z, a).after(&transform::turned(Axis::Y, b)))),
        2 => {
            let named = [axis(0), axis(1), axis(2)];
            let mut traces = [None; 3];
            for (axis, angle) in named.into_iter().zip([a, b]) {
                if let Some(axis) = axis {
                    traces[axis as usize] = Some(angle);
                }
            }
            let third = named[2].unwrap_or(Axis::Z);
            let plane = transform::projected(traces).ok_or_else(|| {
                let message = "the projection angles of CYCLE800 do not define a plane";
                fault("bad-angles", at, message, "check _MODE, _A and _B")
            })?;
            Ok(Some(plane.after(&transform::turned(third, c))))
        }
        _ => Ok(None),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn modes_are_orders_of_axes() {
        // 39 is Z, X, Y: -45 about Z, then 90 about X sends Z to -Y', which is (-s, -s, 0).
        let frame = swivel_rotation(39, [-45.0, 90.0, 0.0], 0).unwrap().unwrap();
        let (v, s) = (frame.vector([0.0, 0.0, 1.0]), 0.5_f64.sqrt());
        assert!((v[0] + s).abs() < 1e-12 && (v[1] + s).abs() < 1e-12 && v[2].abs() < 1e-12);
    }

    #[test]
    fn solid_angles_turn_about_z_and_y() {
        let frame = swivel_rotation(64, [90.0, 90.0, 0.0], 0).unwrap().unwrap();
        let v = frame.vector([0.0, 0.0, 1.0]);
        assert_eq!(v, [0.0, 1.0, 0.0]);
    }
}
