//! The nominal chain as one row of joints from the workpiece to the tool.
//!
//! ```text
//!     workpiece_from_tool = F0 · J0(q0) · F1 · J1(q1) ⋯ Fn
//! ```
//!
//! Crossing the bed turns the workpiece side round: its joints stand here with the opposite sense.

use crate::Machine;
use crate::axis::{AxisKind, Command};
use crate::chain::Link;
use trueaxis_geometry::Vec3;
use trueaxis_geometry::frame::{Pose, rotation};

/// One axis of the row.
#[derive(Debug, Clone)]
pub(crate) struct Joint {
    pub kind: AxisKind,
    pub direction: Vec3,
    /// +1 if a positive command moves what stands towards the tool in the positive direction.
    pub sense: f64,
}

/// The row of joints; joint i is axis i of the machine.
#[derive(Debug, Clone)]
pub(crate) struct Serial {
    pub joints: Vec<Joint>,
    /// The fixed pose before each joint, and after the last.
    pub fixed: Vec<Link>,
    tip_mm: Vec3,
}

/// Where the joints and the tool are at one command, in the workpiece frame.
pub(crate) struct Frames {
    /// The fixed side of each joint.
    pub joints: Vec<Link>,
    tool: Link,
}

impl Frames {
    pub fn tool_axis(&self) -> Vec3 {
        self.tool.linear().column(2).normalize()
    }
}

impl Serial {
    pub fn of(machine: &Machine) -> Self {
        let (mut joints, mut fixed) = (Vec::new(), Vec::new());
        let mut since_last = Link::identity();
        for (i, body) in machine.bodies.iter().enumerate() {
            let on_workpiece = i < machine.workpiece_side;
            let (before, behind) = match on_workpiece {
                true => (body.mounting.inverse(), body.placement.inverse()),
                false => (body.placement, body.mounting),
            };
            since_last = since_last * before;
            if let Some(axis) = body.axis {
                let axis = &machine.axes[axis];
                let sense = if on_workpiece { -axis.sense } else { axis.sense };
                joints.push(Joint { kind: axis.kind, direction: axis.direction, sense });
                fixed.push(since_last);
                since_last = Link::identity();
            }
            since_last = since_last * behind;
        }
        fixed.push(since_last);
        Self { joints, fixed, tip_mm: machine.tip_mm }
    }

    /// The rotary axes in chain order.
    pub fn rotary(&self) -> impl Iterator<Item = usize> + Clone + '_ {
        self.of_kind(AxisKind::Rotary)
    }

    /// The linear axes in chain order.
    pub fn linear(&self) -> impl Iterator<Item = usize> + Clone + '_ {
        self.of_kind(AxisKind::Linear)
    }

    fn of_kind(&self, kind: AxisKind) -> impl Iterator<Item = usize> + Clone + '_ {
        (0..self.joints.len()).filter(move |&i| self.joints[i].kind == kind)
    }

    pub fn frames(&self, command: &Command) -> Frames {
        let mut at = Link::identity();
        let mut joints = Vec::with_capacity(self.joints.len());
        for ((joint, fixed), q) in self.joints.iter().zip(&self.fixed).zip(command) {
            at = at * *fixed;
            joints.push(at);
            at = at
                * match joint.kind {
                    AxisKind::Linear => Pose::shift(joint.direction * (joint.sense * q)),
                    AxisKind::Rotary => Pose::turn(joint.direction, joint.sense * q),
                };
        }
        Frames { joints, tool: at * self.fixed[self.joints.len()] }
    }

    /// The direction of an axis in the workpiece frame.
    pub fn axis_in(&self, frames: &Frames, i: usize) -> Vec3 {
        frames.joints[i].linear() * self.joints[i].direction
    }

    /// How the tool moves in the workpiece frame when a linear axis moves by 1.
    pub fn step_of(&self, frames: &Frames, i: usize) -> Vec3 {
        self.axis_in(frames, i) * self.joints[i].sense
    }

    pub fn tip(&self, frames: &Frames) -> Vec3 {
        frames.tool.linear() * self.tip_mm + frames.tool.shift_mm()
    }

    /// The tool axis alone.
    pub fn tool_axis(&self, command: &Command) -> Vec3 {
        let mut axis = self.fixed[self.joints.len()].linear() * Vec3::z();
        for ((joint, fixed), q) in self.joints.iter().zip(&self.fixed).zip(command).rev() {
            if joint.kind == AxisKind::Rotary {
                axis = rotation(joint.direction, joint.sense * q) * axis;
            }
            axis = fixed.linear() * axis;
        }
        axis.normalize()
    }
}
