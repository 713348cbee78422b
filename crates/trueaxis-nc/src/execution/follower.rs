//! What makes the moves of a program and knows where they lead.

use crate::moves::{AxisSet, Position, Step};

/// Takes the steps of a program as they come, and knows where the axes are.
///
/// After a swivel, under tool-centre-point control or with another tool only the machine knows where the
/// tool is in the program frame. The execution therefore reads its place again from here after every change
/// of frame, tool length, kinematics or plane, and before the first block.
pub trait Follower {
    /// The next step.
    fn take(&mut self, step: Step);

    /// The axes that follow the steps; `None` without a machine.
    fn axes(&self) -> Option<&dyn FollowingAxes> {
        None
    }

    /// How many points of the path it has made so far: loops that make many end earlier.
    fn points(&self) -> u64;
}

/// Axes that follow a program and know where they are.
pub trait FollowingAxes {
    /// The present place in the program frame, with the frame, tool length and kinematics of the steps so far.
    fn place(&self) -> KnownPosition;

    /// The present axis positions.
    fn positions(&self) -> KnownPosition;

    /// The axis positions at the end of the travel along the tool axis, away from the tip, and the axes that go there;
    /// `None` if the machine states no travel.
    fn retracted(&self) -> Option<KnownPosition>;
}

/// A place, and for which axes it is known.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct KnownPosition {
    /// The coordinates, mm and degrees.
    pub position: Position,
    /// The axes that the machine has.
    pub axes: AxisSet,
}

impl KnownPosition {
    /// The known coordinates in the place of those of `own`. Coordinates that differ by rounding only are
    /// kept, so that no axis moves because its place was read.
    pub(crate) fn over(&self, own: &Position) -> Position {
        const ROUNDING: f64 = 1e-9;
        let mut place = *own;
        for (i, value) in self.position.0.iter().enumerate() {
            let known = self.axes.0 >> i & 1 == 1 && value.is_finite();
            if known && (value - own.0[i]).abs() > ROUNDING {
                place.0[i] = *value;
            }
        }
        place
    }
}

/// A program without a machine: its frames alone say where it is.
pub(crate) struct Alone<'t> {
    pub take: &'t mut dyn FnMut(Step),
    pub steps: u64,
}

impl Follower for Alone<'_> {
    fn take(&mut self, step: Step) {
        self.steps += 1;
        (self.take)(step);
    }

    fn points(&self) -> u64 {
        self.steps
    }
}
