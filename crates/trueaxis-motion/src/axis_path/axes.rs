//! Moves that the axes make as they are written: without tool-centre point, to machine
//! coordinates, and onto a swivelled plane.

use super::elements::sampled;
use super::fault::{fault, no_farther_than_a_hall, unreachable};
use super::{AxisPath, Fault, PathStep, Speed, fraction, path_length};
use crate::basic::choose;
use crate::curve::Curve;
use crate::timing::Element;
use trueaxis_geometry::Vec3;
use trueaxis_machine::axis::Command;
use trueaxis_nc::moves::{Axis, Branch, Move};

impl AxisPath<'_> {
    /// The axes go straight to their positions; circles by their chords.
    pub(super) fn axis_move(
        &mut self,
        m: &Move,
        curve: &Curve,
        feed: Speed,
        out: &mut dyn FnMut(PathStep),
    ) -> Result<(), Fault> {
        if m.direction.is_some() {
            let message = "a tool direction without tool-centre-point control".to_owned();
            let hint = "switch it on before: TRAORI, G43.5, M128";
            return Err(fault(m, None, "direction-without-tcp", message, hint));
        }
        let (begin, end) = (self.command, self.other_axes(m));
        let offset = self.tool + self.carried(&end);
        let turned = self.rotary_way(&begin, &end);
        let straight = matches!(curve, Curve::Line { .. });
        let scale = self.scale(curve);
        let length_mm = curve.length_mm() * scale;
        let pieces = self.count(m, curve, length_mm, turned)?;
        let length = path_length(length_mm, turned);
        let speed = feed.along(length);
        let element = || {
            let mut goal = end;
            self.set_linear(&mut goal, self.in_basic(curve.at(1.0)) + offset);
            let to_axes = |v: Vec3| {
                let mut axes = Command::default();
                self.set_linear(&mut axes, Vec3::from(self.frame.vector(v.into())));
                axes
            };
            Some(Self::element_of_axes(curve, [&begin, &goal], length, to_axes))
        };
        self.announce(length, element, out);
        let mut command = begin;
        for k in 1..=pieces {
            let u = fraction(k, pieces);
            for (i, q) in command.iter_mut().enumerate() {
                *q = if u == 1.0 { end[i] } else { begin[i] + (end[i] - begin[i]) * u };
            }
            if !straight || u == 1.0 {
                self.basic = self.in_basic(curve.at(u));
                self.set_linear(&mut command, self.basic + offset);
            } else {
                let goal = self.in_basic(curve.at(1.0)) + offset;
                let start = self.linear_axes(&begin);
                self.set_linear(&mut command, start + (goal - start) * u);
            }
            self.command = command;
            out(self.next(m, length / f64::from(pieces), speed, k == pieces));
        }
        Ok(())
    }

    /// The rotary axes turn the tool onto Z of the program frame.
    pub(super) fn align(
        &mut self,
        m: &Move,
        keep_tip: bool,
        branch: Branch,
        out: &mut dyn FnMut(PathStep),
    ) -> Result<(), Fault> {
        let Some(control) = self.control.clone() else { return Ok(()) };
        let direction = self.direction_in_workpiece(m, [0.0, 0.0, 1.0])?;
        let aimed = control.aim(direction, &self.command).map_err(|e| unreachable(m, &e))?;
        let chosen = choose(self.machine, &aimed, branch);
        let tip = control.tip_and_axis(&self.command).0;
        let (begin, mut end) = (self.command, chosen);
        if keep_tip && !control.place(tip, &mut end) {
            return Ok(());
        }
        let turned = self.rotary_way(&begin, &end);
        let pieces = self.bounded(m, self.densify.count(0.0, turned))?;
        let length = turned.to_degrees();
        let element = || {
            if !keep_tip {
                return Some(Element::straight(&begin, &end, length));
            }
            sampled(&begin, length, turned, &mut |u, _| {
                let mut command = std::array::from_fn(|i| begin[i] + (end[i] - begin[i]) * u);
                control.place(tip, &mut command).then_some(command)
            })
        };
        self.announce(length, element, out);
        for k in 1..=pieces {
            let u = fraction(k, pieces);
            let mut command = std::array::from_fn(|i| begin[i] + (end[i] - begin[i]) * u);
            if keep_tip && k < pieces {
                control.place(tip, &mut command);
            }
            self.command = if k == pieces { end } else { command };
            out(self.next(m, length / f64::from(pieces), f64::INFINITY, k == pieces));
        }
        self.reread();
        Ok(())
    }

    /// The named axes go to machine coordinates.
    pub(super) fn machine_move(
        &mut self,
        m: &Move,
        feed: Speed,
        out: &mut dyn FnMut(PathStep),
    ) -> Result<(), Fault> {
        let (begin, mut end) = (self.command, self.command);
        for axis in Axis::ALL {
            if let Some(index) = self.axis_of[axis as usize].filter(|_| m.named.contains(axis)) {
                let value = m.target[axis];
                end[index] = if axis.is_rotary() { value.to_radians() } else { value };
            }
        }
        let length_mm = (self.linear_axes(&end) - self.linear_axes(&begin)).norm();
        let turned = self.rotary_way(&begin, &end);
        let length = path_length(length_mm, turned);
        no_farther_than_a_hall(m, length_mm)?;
        let pieces = self.bounded(m, self.densify.count(length_mm, turned))?;
        let speed = feed.along(length);
        self.announce(length, || Some(Element::straight(&begin, &end, length)), out);
        for k in 1..=pieces {
            let u = fraction(k, pieces);
            self.command = std::array::from_fn(|i| {
                if u == 1.0 { end[i] } else { begin[i] + (end[i] - begin[i]) * u }
            });
            let part = length / f64::from(pieces);
            out(self.next(m, part, speed, k == pieces));
        }
        self.reread();
        Ok(())
    }
}
