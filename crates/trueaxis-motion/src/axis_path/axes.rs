//! Moves that the axes make as they are written: without tool-centre point, to machine
//! coordinates, and onto a swivelled plane.

use super::elements::sampled;
use super::fault::{fault, no_farther_than_a_hall, not_finite, unreachable};
use super::{AxisPath, Fault, PathStep, Speed, fraction, path_length};
use crate::basic::choose;
use crate::curve::Curve;
use crate::densify::MOST_PIECES;
use crate::timing::Element;
use trueaxis_geometry::Vec3;
use trueaxis_machine::axis::Command;
use trueaxis_machine::errors::ErrorValues;
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
        let mut goal = end;
        self.set_linear(&mut goal, self.in_basic(curve.at(1.0)) + offset);
        let between = |u: f64| {
            let mut command = between(&begin, &goal, u);
            if !straight {
                self.set_linear(&mut command, self.in_basic(curve.at(u)) + offset);
            }
            command
        };
        let pieces = self.count(m, curve, length_mm, turned)?;
        let pieces = self.as_the_tool_goes(m, &between, turned, pieces)?;
        let length = path_length(length_mm, turned);
        let speed = feed.along(length);
        let element = || {
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
        let pieces = match keep_tip {
            true => pieces,
            false => self.as_the_tool_goes(m, &|u| between(&begin, &end, u), turned, pieces)?,
        };
        let length = turned.to_degrees();
        let element = || {
            if !keep_tip {
                return Some(Element::straight(&begin, &end, length));
            }
            sampled(&begin, length, turned, &mut |u, _| {
                let mut commands = u.map(|u| between(&begin, &end, u));
                control.place_four(&[tip; 4], &mut commands).then_some(commands)
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
        let mut end = self.command;
        for axis in Axis::ALL {
            if let Some(index) = self.axis_of[axis as usize].filter(|_| m.named.contains(axis)) {
                let value = m.target[axis];
                end[index] = if axis.is_rotary() { value.to_radians() } else { value };
            }
        }
        self.go_straight(m, end, feed, out)
    }

    /// Rotary axes are named while a plane is swivelled and the tip is not followed: linear axes that are not named stand. With
    /// some that are, the tip comes to the place in the plane as it lies at the end; all axes go there straight. *Source:*
    /// HEIDENHAIN TNC 620, user's manual for DIN/ISO programming (2013), M128, "Standard behavior".
    pub(super) fn turn_on_plane(
        &mut self,
        m: &Move,
        feed: Speed,
        out: &mut dyn FnMut(PathStep),
    ) -> Result<(), Fault> {
        let mut end = self.other_axes(m);
        let linear = [Axis::X, Axis::Y, Axis::Z];
        if linear.iter().any(|axis| m.named.contains(*axis)) {
            let to = self.target(m);
            let tip = self.place_in_workpiece(self.in_basic(to));
            let placed = self.control.as_ref().is_some_and(|control| control.place(tip, &mut end));
            if !placed {
                return Err(not_finite(m));
            }
        }
        self.go_straight(m, end, feed, out)
    }

    /// All axes go straight to these positions, and the place in the program is read from there.
    fn go_straight(
        &mut self,
        m: &Move,
        end: Command,
        feed: Speed,
        out: &mut dyn FnMut(PathStep),
    ) -> Result<(), Fault> {
        let begin = self.command;
        let length_mm = (self.linear_axes(&end) - self.linear_axes(&begin)).norm();
        let turned = self.rotary_way(&begin, &end);
        let length = path_length(length_mm, turned);
        no_farther_than_a_hall(m, length_mm)?;
        let pieces = self.bounded(m, self.densify.count(length_mm, turned))?;
        let pieces = self.as_the_tool_goes(m, &|u| between(&begin, &end, u), turned, pieces)?;
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

    /// So many pieces, or more: where rotary axes turn, straight moves of the axes lead the tool round.
    fn as_the_tool_goes(
        &self,
        m: &Move,
        at: &dyn Fn(f64) -> Command,
        turned: f64,
        pieces: u32,
    ) -> Result<u32, Fault> {
        let Some([chord_mm, reach_mm]) = self.densify.limits_of_tool().filter(|_| turned > 0.0)
        else {
            return Ok(pieces);
        };
        let tool = |u: f64| {
            let pose = self.machine.pose(&at(u), &ErrorValues::default());
            let tip = pose.linear() * self.tip_mm() + pose.shift_mm();
            [tip, tip + pose.linear() * Vec3::z() * reach_mm]
        };
        // The way bends evenly enough for three of its pieces to speak for all.
        let bow = |k: u32| {
            let [a, b] = [k, k + 1].map(|k| fraction(k, pieces));
            let [from, to, middle] = [a, b, 0.5 * (a + b)].map(tool);
            let off = [0, 1].map(|i| (middle[i] - 0.5 * (from[i] + to[i])).norm());
            off[0].max(off[1])
        };
        let most_mm = [0, pieces / 2, pieces - 1].map(bow).into_iter().fold(0.0, f64::max);
        let finer = (f64::from(pieces) * (most_mm / chord_mm).sqrt()).ceil();
        // A table that turns a hundred times in one block is followed as finely as there is room for.
        self.bounded(m, finer.min(0.5 * MOST_PIECES).max(f64::from(pieces)))
    }

    /// The tip in the frame of the tool, by the length that the control counts with.
    fn tip_mm(&self) -> Vec3 {
        match self.lengths_known {
            true => -self.tool,
            false => self.machine.tip_mm(),
        }
    }
}

pub(super) fn between(begin: &Command, end: &Command, u: f64) -> Command {
    std::array::from_fn(|i| begin[i] + (end[i] - begin[i]) * u)
}
