//! The deviation of the tool, to the last digit.
//!
//! Actual minus nominal pose, both computed with matrices, loses digits: on a 6 m machine a double
//! ends at 1e-12 mm, and a microradian of a direction at 1e-10. Here the *difference* travels
//! through the chain beside the nominal vector, so that it keeps its own sixteen digits:
//!
//! ```text
//!     actual = p + d.   One error (t, I + D):   p' = p            d' = d + t + D·(p + d)
//!     One nominal step (R, s):                  p' = R·p + s      d' = R·d
//! ```
//!
//! No order of smallness is neglected; docs/model.md eq. 5 and 6.

use crate::axis::{AxisKind, Command};
use crate::chain::{ErrorFrame, Link, Machine, Squareness, nominal_motion};
use crate::errors::{BodyErrors, ErrorValues, Rotation, Six};
use trueaxis_geometry::frame::{Direction, Point, Workpiece, inverse3};
use trueaxis_geometry::{Mat3, Vec3};

/// Nominal tool in the workpiece, and how far the actual one is from it: what the part feels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Deviation {
    /// Nominal tip.
    pub nominal_tip: Point<Workpiece>,
    /// Nominal tool axis, from the tip to the spindle.
    pub nominal_axis: Direction<Workpiece>,
    /// Actual minus nominal tip, mm.
    pub tip_mm: Vec3,
    /// Actual minus nominal unit vector of the tool axis.
    pub axis: Vec3,
}

/// A vector and its deviation on their way through the chain; `place` is 1 for a point, 0 for a
/// direction, which feels no shift.
#[derive(Clone, Copy)]
struct Traveller {
    nominal: Vec3,
    deviation: Vec3,
    place: f64,
}

impl Traveller {
    fn forward(&mut self, step: &Link) {
        self.nominal = step.linear() * self.nominal + step.shift_mm() * self.place;
        self.deviation = step.linear() * self.deviation;
    }

    /// Through a nominal step against its direction; nominal steps are rotations.
    fn backward(&mut self, step: &Link) {
        let back = step.linear().transpose();
        self.nominal = back * (self.nominal - step.shift_mm() * self.place);
        self.deviation = back * self.deviation;
    }

    /// Through an error: shift after rotation.
    fn displace(&mut self, error: Option<&Displacement>) {
        let Some(Displacement { shift, turn_minus_identity }) = error else { return };
        let actual = self.nominal + self.deviation;
        self.deviation += shift * self.place + turn_minus_identity * actual;
    }

    /// Through the inverse of an error, whose turn is that of the inverse.
    fn displace_back(&mut self, error: Option<&Displacement>) {
        let Some(Displacement { shift, turn_minus_identity }) = error else { return };
        let shift = shift * self.place;
        let actual = self.nominal + self.deviation - shift;
        self.deviation += turn_minus_identity * actual - shift;
    }
}

/// An error as a shift and a turn; most of a machine's are zero, and then there is none.
struct Displacement {
    shift: Vec3,
    turn_minus_identity: Mat3,
}

/// How a body moves at a command, and where its errors act.
struct Joint {
    /// J(q).
    motion: Link,
    /// The error motion does not turn with the axis.
    error_stands_still: bool,
    /// The squareness tilts the direction of motion, not what is carried.
    tilts_direction_only: bool,
}

impl Machine {
    /// The deviation of the tool in the workpiece frame under the given errors.
    ///
    /// Agrees with [`Machine::pose`] but keeps sixteen digits of the *difference*.
    pub fn deviation(&self, command: &Command, errors: &ErrorValues) -> Deviation {
        let mut tip = Traveller { nominal: self.tip_mm, deviation: Vec3::zeros(), place: 1.0 };
        let mut axis = Traveller { nominal: Vec3::z(), deviation: Vec3::zeros(), place: 0.0 };
        for i in (self.workpiece_side..self.bodies.len()).rev() {
            self.towards_bed(i, command, &errors.bodies[i], [&mut tip, &mut axis]);
        }
        for i in (0..self.workpiece_side).rev() {
            self.away_from_bed(i, command, &errors.bodies[i], [&mut tip, &mut axis]);
        }
        if self.model.rotation == Rotation::SmallAngle {
            axis.deviation = renormalised(&axis);
        }
        tip.deviation -= errors.workpiece_mm;
        Deviation {
            nominal_tip: Point::from_vector(tip.nominal),
            nominal_axis: Direction::of(axis.nominal).unwrap_or(Direction::Z),
            tip_mm: tip.deviation,
            axis: axis.deviation,
        }
    }

    fn towards_bed(
        &self,
        i: usize,
        command: &Command,
        errors: &BodyErrors,
        travellers: [&mut Traveller; 2],
    ) {
        let body = &self.bodies[i];
        let turn = |six: &Six| six.rotation_minus_identity(self.model.rotation);
        let joint = self.joint(i, command);
        let location = tilted(&errors.location, joint.as_ref(), turn, turn);
        let motion = displacement(&errors.motion, turn);
        for traveller in travellers {
            traveller.forward(&body.mounting);
            if let Some(joint) = &joint {
                if joint.error_stands_still {
                    traveller.forward(&joint.motion);
                    traveller.displace(motion.as_ref());
                } else {
                    traveller.displace(motion.as_ref());
                    traveller.forward(&joint.motion);
                }
            }
            traveller.displace(location.as_ref());
            traveller.forward(&body.placement);
        }
    }

    fn away_from_bed(
        &self,
        i: usize,
        command: &Command,
        errors: &BodyErrors,
        travellers: [&mut Traveller; 2],
    ) {
        let body = &self.bodies[i];
        let turn = |six: &Six| six.rotation_minus_identity(self.model.rotation);
        let back = |six: &Six| self.inverse_turn_minus_identity(six);
        let joint = self.joint(i, command);
        let location = tilted(&errors.location, joint.as_ref(), turn, back);
        let motion = displacement(&errors.motion, back);
        for traveller in travellers {
            traveller.backward(&body.placement);
            traveller.displace_back(location.as_ref());
            if let Some(joint) = &joint {
                if joint.error_stands_still {
                    traveller.displace_back(motion.as_ref());
                    traveller.backward(&joint.motion);
                } else {
                    traveller.backward(&joint.motion);
                    traveller.displace_back(motion.as_ref());
                }
            }
            traveller.backward(&body.mounting);
        }
    }

    /// The joint of a body at a command; none for the workpiece and the tool.
    fn joint(&self, i: usize, command: &Command) -> Option<Joint> {
        let body = &self.bodies[i];
        let axis = body.axis?;
        let (kind, motion) =
            (self.axes[axis].kind, nominal_motion(&self.axes[axis], command[axis]));
        let linear = kind == AxisKind::Linear;
        Some(Joint {
            motion,
            error_stands_still: !linear && body.error_frame == ErrorFrame::Fixed,
            tilts_direction_only: linear && self.model.squareness == Squareness::Direction,
        })
    }

    /// `R⁻¹ − I` of an error's rotation.
    fn inverse_turn_minus_identity(&self, six: &Six) -> Mat3 {
        let turn = six.rotation_minus_identity(self.model.rotation);
        match self.model.rotation {
            Rotation::Exact => turn.transpose(),
            Rotation::SmallAngle => -(inverse3(&(Mat3::identity() + turn)) * turn),
        }
    }
}

/// The displacement of an error, its turn by a function.
fn displacement(six: &Six, turn: impl Fn(&Six) -> Mat3) -> Option<Displacement> {
    (!six.is_zero()).then(|| Displacement { shift: six.shift_mm(), turn_minus_identity: turn(six) })
}

/// That of a location error, which in one model tilts the direction of motion, not what is carried.
fn tilted(
    six: &Six,
    joint: Option<&Joint>,
    turn: impl Fn(&Six) -> Mat3,
    turn_felt: impl Fn(&Six) -> Mat3,
) -> Option<Displacement> {
    let Some(joint) = joint.filter(|joint| joint.tilts_direction_only) else {
        return displacement(six, turn_felt);
    };
    let shift = turn(six) * joint.motion.shift_mm() + six.shift_mm();
    (!six.is_zero()).then(|| Displacement { shift, turn_minus_identity: Mat3::zeros() })
}

/// The deviation of a direction after the actual vector has been made a unit vector again.
fn renormalised(direction: &Traveller) -> Vec3 {
    let d = direction.deviation;
    let excess = 2.0 * direction.nominal.dot(&d) + d.norm_squared();
    let norm = (1.0 + excess).sqrt();
    // 1/norm − 1 without cancellation.
    let shrink = -excess / (norm * (1.0 + norm));
    d + (direction.nominal + d) * shrink
}
