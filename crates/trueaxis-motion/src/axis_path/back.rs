//! From axis positions back to the words that lead to them, in the present state of the program.

use super::AxisPath;
use std::sync::Arc;
use trueaxis_geometry::{Mat3, Vec3};
use trueaxis_machine::axis::{Command, Travel};
use trueaxis_machine::tcp::TipControl;
use trueaxis_nc::moves::{Axis, AxisSet, Coordinates, Frame, OrientationPath, Position};
use trueaxis_nc::{FollowingAxes, KnownPosition};

/// The coordinates that the control interpolates linearly in a block.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Straight {
    /// Every axis.
    Axes,
    /// The tip and every rotary axis.
    TipAndAngles,
    /// The tip; the tool axis swings in the plane of both directions, or on a cone.
    TipAndSwing,
}

impl AxisPath<'_> {
    /// The coordinates that the next linear block interpolates linearly.
    pub fn straight(&self) -> Straight {
        match (self.follows_tip(), self.orientation) {
            (false, _) => Straight::Axes,
            (true, OrientationPath::Axes) => Straight::TipAndAngles,
            (true, _) => Straight::TipAndSwing,
        }
    }

    /// A plane is swivelled and the tip is not followed when rotary axes move.
    pub fn is_only_tilted(&self) -> bool {
        self.tilted && !self.tcp
    }

    /// The tool axis turns on a cone in the next block.
    pub fn turns_on_cone(&self) -> bool {
        matches!(self.orientation, OrientationPath::Cone(_))
    }

    /// The nominal machine with the tool length of the control.
    pub fn control(&self) -> Option<&TipControl> {
        self.control.as_deref()
    }

    /// The same for another thread: it stays as it is when the control counts with another tool.
    pub fn shared_control(&self) -> Option<Arc<TipControl>> {
        self.control.clone()
    }

    /// The machine's axis of a word.
    pub fn axis_of(&self, axis: Axis) -> Option<usize> {
        self.axis_of[axis as usize]
    }

    /// The axes of programs that the machine has.
    fn axes(&self) -> AxisSet {
        let known = Axis::ALL.into_iter().filter(|axis| self.axis_of(*axis).is_some());
        known.fold(AxisSet::default(), AxisSet::with)
    }

    /// The words, mm and degrees, that lead to axis positions from here.
    pub fn words_of(&self, command: &Command, from: Coordinates) -> Position {
        let mut words = Position::default();
        for axis in Axis::ALL {
            let Some(index) = self.axis_of[axis as usize] else { continue };
            let q = command[index];
            words[axis] = if axis.is_rotary() { q.to_degrees() } else { q };
        }
        if from == Coordinates::Machine {
            return words;
        }
        // Where the axes are the place is known, and is the programmed one to the last digit.
        let basic = match self.follows_tip() && *command == self.command {
            true => self.basic,
            false => self.basic_of(command),
        };
        let mut place = words;
        place.0[..3].copy_from_slice(basic.as_slice());
        self.frame.inverse_place(&place).unwrap_or(place)
    }

    /// The direction in the program frame along which the tool points at axis positions.
    pub fn direction_of(&self, command: &Command) -> Option<[f64; 3]> {
        let (_, axis) = self.control.as_ref()?.tip_and_axis(command);
        let direction = match self.frame.linear == Frame::IDENTITY.linear {
            true => self.turn_back * axis,
            false => {
                let linear = Mat3::from_fn(|i, j| self.frame.linear[i][j]);
                (self.turn * linear).try_inverse()? * axis
            }
        };
        direction.try_normalize(0.0).map(Vec3::into)
    }
}

impl FollowingAxes for AxisPath<'_> {
    /// The place in the program frame, as the words of the next block would name it.
    fn place(&self) -> KnownPosition {
        KnownPosition {
            position: self.words_of(&self.command, Coordinates::Program),
            axes: self.axes(),
        }
    }

    /// Where the axes are, as machine coordinates name it.
    fn positions(&self) -> KnownPosition {
        KnownPosition {
            position: self.words_of(&self.command, Coordinates::Machine),
            axes: self.axes(),
        }
    }

    /// Where the axes are if the tool goes back along its own axis until the first of them reaches
    /// the end of its travel, as machine coordinates name it, and the axes that move; `None` if one
    /// of them has no stated travel.
    ///
    /// ```text
    ///     q(s) = q + s·v,    tip(q + v) = tip(q) + axis,    s = min (end_i - q_i) / v_i
    /// ```
    fn retracted(&self) -> Option<KnownPosition> {
        let control = self.control.as_ref()?;
        let (tip, along) = control.tip_and_axis(&self.command);
        let mut next = self.command;
        if !control.place(tip + along, &mut next) {
            return None;
        }
        let (mut way_mm, mut axes) = (f64::INFINITY, AxisSet::default());
        for axis in [Axis::X, Axis::Y, Axis::Z] {
            let Some(index) = self.axis_of(axis) else { continue };
            let (q, rate) = (self.command[index], next[index] - self.command[index]);
            if rate.abs() < 1e-9 {
                continue;
            }
            let Travel::Between(from, to) = self.machine.axes()[index].travel else { return None };
            let end = if rate > 0.0 { to } else { from };
            way_mm = way_mm.min(((end - q) / rate).max(0.0));
            axes = axes.with(axis);
        }
        if axes == AxisSet::default() {
            return None;
        }
        for axis in [Axis::X, Axis::Y, Axis::Z].into_iter().filter(|a| axes.contains(*a)) {
            let index = self.axis_of(axis)?;
            next[index] = self.command[index] + way_mm * (next[index] - self.command[index]);
        }
        Some(KnownPosition { position: self.words_of(&next, Coordinates::Machine), axes })
    }
}
