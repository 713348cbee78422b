//! The rule of one link as a list of steps: the only place that says in which order they stand.
//!
//! ```text
//!     parent_from_link = P · step · step · step · M        docs/model.md eq. 1
//! ```
//!
//! The pose ([`Machine::pose`]), the deviation ([`Machine::deviation`]), the error frames
//! ([`crate::twist`]), the Jacobian ([`crate::compensate`]) and the kernels ([`crate::batch`]) walk
//! through these lists, from the left or from the right. What a step *does* stands with its reader;
//! which steps there are, and in which order, stands here.

use super::{ErrorFrame, Machine, Squareness};
use crate::axis::AxisKind;

/// One step between the placement P and the mounting M of a body.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Step {
    /// Λ: the location errors move and turn everything that the body carries.
    Location,
    /// J(q): the nominal motion of the axis.
    Joint,
    /// Λ and J(q) of a linear axis in one step: the location errors shift what the body carries and
    /// tilt its direction of motion, but do not turn it. Shift by `t_Λ + R_Λ·d·sense·q`.
    TiltedJoint,
    /// E(q): the error motions.
    Motion,
}

/// The workpiece and the tool.
const RIGID: &[Step] = &[Step::Location];
/// A linear axis, and a rotary one whose errors turn with it.
const MOVING: &[Step] = &[Step::Location, Step::Joint, Step::Motion];
/// A rotary axis whose errors stand still (ISO 230-7).
const FIXED: &[Step] = &[Step::Location, Step::Motion, Step::Joint];
/// A linear axis whose squareness turns its direction of motion only.
const TILTED: &[Step] = &[Step::TiltedJoint, Step::Motion];

/// What a body is, as far as its rule goes.
#[derive(Clone, Copy)]
enum Rule {
    Rigid,
    Moving,
    Fixed,
    Tilted,
}

impl Machine {
    /// The steps of a body from the left to the right of eq. 1.
    ///
    /// They are constants: chosen by what the body is, so that no change of a machine can leave them
    /// out of date.
    #[inline]
    pub(crate) fn steps(&self, body: usize) -> &'static [Step] {
        match self.rule(body) {
            Rule::Rigid => RIGID,
            Rule::Moving => MOVING,
            Rule::Fixed => FIXED,
            Rule::Tilted => TILTED,
        }
    }

    /// Walks through [`Machine::steps`] from the left, written out for each list by the compiler: a loop with
    /// a choice in it costs the pose 8 %.
    #[inline(always)]
    pub(crate) fn fold_steps<T>(&self, body: usize, start: T, step: impl Fn(T, Step) -> T) -> T {
        match self.rule(body) {
            Rule::Rigid => RIGID.iter().fold(start, |place, s| step(place, *s)),
            Rule::Moving => MOVING.iter().fold(start, |place, s| step(place, *s)),
            Rule::Fixed => FIXED.iter().fold(start, |place, s| step(place, *s)),
            Rule::Tilted => TILTED.iter().fold(start, |place, s| step(place, *s)),
        }
    }

    /// The same from the right.
    #[inline(always)]
    pub(crate) fn fold_steps_back<T>(
        &self,
        body: usize,
        start: T,
        step: impl Fn(T, Step) -> T,
    ) -> T {
        match self.rule(body) {
            Rule::Rigid => RIGID.iter().rev().fold(start, |state, s| step(state, *s)),
            Rule::Moving => MOVING.iter().rev().fold(start, |state, s| step(state, *s)),
            Rule::Fixed => FIXED.iter().rev().fold(start, |state, s| step(state, *s)),
            Rule::Tilted => TILTED.iter().rev().fold(start, |state, s| step(state, *s)),
        }
    }

    #[inline]
    fn rule(&self, body: usize) -> Rule {
        let body = &self.bodies[body];
        let Some(axis) = body.axis else { return Rule::Rigid };
        match (self.axes[axis].kind, body.error_frame, self.model.squareness) {
            (AxisKind::Linear, _, Squareness::Direction) => Rule::Tilted,
            (AxisKind::Rotary, ErrorFrame::Fixed, _) => Rule::Fixed,
            _ => Rule::Moving,
        }
    }
}
