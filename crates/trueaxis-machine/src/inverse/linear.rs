//! The linear axes that bring the tip to its place once the rotary axes stand.
//!
//! ```text
//!     tip = tip(q_k = 0) + Σ q_k · d_k        d_k direction of axis k in the workpiece frame
//! ```
//!
//! Solved by Gram-Schmidt in any number of axes; the first digits that rounding takes are given
//! back by one correction with the tip that the chain really reaches.

use super::serial::Frames;
use super::{SolveError, Solver, Target};
use crate::axis::Command;
use trueaxis_geometry::Vec3;

/// Sine of the angle below which an axis counts as dependent on those before it: there 1 mm of the
/// tip would cost more than 1 m of the axis.
const DEPENDENT: f64 = 1e-3;

/// Tolerance for the position of the tip where fewer than three directions are available, mm.
const MET_MM: f64 = 1e-9;

/// An axis, its direction, and the part of it across those before it (unit vector).
struct Step {
    axis: usize,
    direction: Vec3,
    across: Vec3,
}

impl Solver<'_> {
    /// Completes a command whose rotary axes stand by its linear axes.
    pub(super) fn place_tip(
        &self,
        mut command: Command,
        target: &Target,
    ) -> Result<Command, SolveError> {
        if let Some(placer) = &self.placer
            && placer.place(target.tip.vector(), &mut command)
        {
            return Ok(command);
        }
        let linear = self.serial.linear();
        linear.clone().for_each(|i| command[i] = 0.0);
        let frames = self.serial.frames(&command);
        let steps = self.independent_steps(&frames);
        let mut missing = target.tip.vector() - self.serial.tip(&frames);
        for i in linear.filter(|&i| steps.iter().all(|step| step.axis != i)) {
            command[i] = self.from[i];
            missing -= self.serial.step_of(&frames, i) * command[i];
        }
        move_by(&steps, missing, &mut command);
        missing = self.missing(&command, target);
        move_by(&steps, missing, &mut command);
        if !command.iter().all(|q| q.is_finite()) {
            return Err(SolveError::NotFinite);
        }
        let allowed = MET_MM + 1e-14 * target.tip.vector().norm();
        if steps.len() < 3 && self.missing(&command, target).norm() > allowed {
            let missed_by_mm = self.missing(&command, target).norm();
            let moving = steps.iter().map(|s| self.machine.axes[s.axis].name).collect();
            return Err(SolveError::TipUnreachable { missed_by_mm, moving });
        }
        for step in &steps {
            command[step.axis] += 0.0; // −0 is 0
        }
        Ok(command)
    }

    /// From the tip that a command reaches to the one wanted.
    fn missing(&self, command: &Command, target: &Target) -> Vec3 {
        target.tip.vector() - self.serial.tip(&self.serial.frames(command))
    }

    /// Up to three independent linear axes: X Y Z before U V W, then in chain order.
    fn independent_steps(&self, frames: &Frames) -> Vec<Step> {
        let mut linear: Vec<usize> = self.serial.linear().collect();
        linear.sort_by_key(|&i| !matches!(self.machine.axes[i].name.letter(), 'X' | 'Y' | 'Z'));
        let mut steps: Vec<Step> = Vec::with_capacity(3);
        for axis in linear {
            let direction = self.serial.step_of(frames, axis);
            let mut across = direction;
            // Twice, or nearly dependent axes leave a remainder along the others.
            for step in steps.iter().chain(&steps) {
                across -= step.across * step.across.dot(&across);
            }
            if steps.len() < 3 && across.norm() > DEPENDENT {
                steps.push(Step { axis, direction, across: across.normalize() });
            }
        }
        steps
    }
}

/// Moves the axes so that the tip moves by `shift`, as far as they can.
fn move_by(steps: &[Step], shift: Vec3, command: &mut Command) {
    let mut rest = shift;
    for step in steps.iter().rev() {
        // Only this axis and later ones, already served, leave the plane of the axes before it.
        let by = rest.dot(&step.across) / step.direction.dot(&step.across);
        command[step.axis] += by;
        rest -= step.direction * by;
    }
}
