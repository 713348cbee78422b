//! A work offset that goes round with the table: G254 of HAAS.

use super::{AxisPath, Fault};
use trueaxis_geometry::Vec3;
use trueaxis_machine::axis::{AxisKind, Command};
use trueaxis_nc::moves::{AxisSet, Origin};

impl AxisPath<'_> {
    /// The origin goes round with the table from here on, or no longer; the axes stay.
    pub(super) fn carry_origin(&mut self, zero_mm: Option<Vec3>, block: Origin) {
        self.dynamic_mm = zero_mm.filter(|_| self.control.is_some());
        self.reread();
        if zero_mm.is_some() && self.control.is_none() {
            let message = "a work offset that goes round with the table needs three linear axes";
            self.faults.push(Fault {
                origin: block,
                word: None,
                code: "no-tcp",
                message: message.to_owned(),
                hint: "run the program on another machine",
            });
        }
    }

    /// How far the rotary axes of the table have carried the origin O, along X, Y and Z:
    ///
    /// ```text
    ///     carried(q) = axes(tip at O, table at q) - axes(tip at O, table at zero)
    /// ```
    ///
    /// Tool and head are the same in both, so that they do not matter. Zero without G254.
    ///
    /// # Source
    /// Haas Automation, "Mill Operator's Manual" (Next Generation Control), G254 Dynamic Work Offset: the control
    /// knows the centres of rotation and the active work offset, and applies the difference; the axes are not turned.
    pub(super) fn carried(&self, command: &Command) -> Vec3 {
        let (Some(zero), Some(control)) = (self.dynamic_mm, &self.control) else {
            return Vec3::zeros();
        };
        let tip = self.place_in_workpiece(zero);
        let (mut there, mut before) = (*command, *command);
        for body in &self.machine.bodies()[..self.machine.workpiece_side()] {
            let axis = body.axis.filter(|i| self.machine.axes()[*i].kind == AxisKind::Rotary);
            if let Some(axis) = axis {
                before[axis] = 0.0;
            }
        }
        match control.place(tip, &mut there) && control.place(tip, &mut before) {
            true => self.linear_axes(&there) - self.linear_axes(&before),
            false => Vec3::zeros(),
        }
    }

    /// Before a move that turns rotary axes: its coordinates count from where the origin is at its end, and linear
    /// axes that it does not name stay.
    pub(super) fn count_from_origin_at(&mut self, end: &Command) {
        if self.rotary_way(&self.command, end) > 0.0 {
            self.basic = self.linear_axes(&self.command) - self.tool - self.carried(end);
            self.stale = AxisSet::XYZ;
        }
    }
}
