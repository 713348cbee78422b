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

use crate::axis::Command;
use crate::chain::{Link, Machine, Step, nominal_motion};
use crate::errors::{BodyErrors, ErrorValues, Rotation, SixErrors};
use trueaxis_geometry::frame::{Direction, Point, Workpiece, inverse3};
use trueaxis_geometry::{Mat3, Vec3};

/// Nominal tool in the workpiece frame, and the deviation of the actual one from it: the deviation
/// that the part is subject to.
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

/// A vector and its deviation, propagated through the chain; `place` is 1 for a point, 0 for a
/// direction, which does not change with a shift.
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
            axis.deviation = renormalised(&axis.nominal, &axis.deviation);
        }
        tip.deviation -= errors.workpiece_mm;
        Deviation {
            nominal_tip: Point::from_vector(tip.nominal),
            nominal_axis: Direction::of(axis.nominal).unwrap_or(Direction::Z),
            tip_mm: tip.deviation,
            axis: axis.deviation,
        }
    }

    /// Through one link, its steps from the right to the left.
    fn towards_bed(
        &self,
        i: usize,
        command: &Command,
        errors: &BodyErrors,
        mut travellers: [&mut Traveller; 2],
    ) {
        let body = &self.bodies[i];
        let turn = |six: &SixErrors| six.rotation_minus_identity(self.model.rotation);
        let joint = self.nominal_joint(i, command);
        for t in &mut travellers {
            t.forward(&body.mounting);
        }
        let travellers = self.fold_steps_back(i, travellers, |mut travellers, step| {
            let moves = matches!(step, Step::Joint | Step::TiltedJoint);
            let error = match step {
                Step::Location => displacement(&errors.location, turn),
                Step::Motion => displacement(&errors.motion, turn),
                Step::TiltedJoint => self.tilt(&errors.location, &joint),
                Step::Joint => None,
            };
            for traveller in &mut travellers {
                if moves {
                    traveller.forward(&joint);
                }
                traveller.displace(error.as_ref());
            }
            travellers
        });
        for t in travellers {
            t.forward(&body.placement);
        }
    }

    /// Through the inverse of one link, its steps from the left to the right.
    fn away_from_bed(
        &self,
        i: usize,
        command: &Command,
        errors: &BodyErrors,
        mut travellers: [&mut Traveller; 2],
    ) {
        let body = &self.bodies[i];
        let back = |six: &SixErrors| inverse_turn_minus_identity(six, self.model.rotation);
        let joint = self.nominal_joint(i, command);
        for t in &mut travellers {
            t.backward(&body.placement);
        }
        let travellers = self.fold_steps(i, travellers, |mut travellers, step| {
            let moves = matches!(step, Step::Joint | Step::TiltedJoint);
            let error = match step {
                Step::Location => displacement(&errors.location, back),
                Step::Motion => displacement(&errors.motion, back),
                Step::TiltedJoint => self.tilt(&errors.location, &joint),
                Step::Joint => None,
            };
            for traveller in &mut travellers {
                traveller.displace_back(error.as_ref());
                if moves {
                    traveller.backward(&joint);
                }
            }
            travellers
        });
        for t in travellers {
            t.backward(&body.mounting);
        }
    }

    /// J(q); the workpiece and the tool do not move.
    pub(crate) fn nominal_joint(&self, i: usize, command: &Command) -> Link {
        let axis = self.bodies[i].axis;
        axis.map_or(Link::identity(), |axis| nominal_motion(&self.axes[axis], command[axis]))
    }

    /// The location errors where they tilt the direction of motion and do not turn what is carried.
    fn tilt(&self, location: &SixErrors, joint: &Link) -> Option<Displacement> {
        let turn = location.rotation_minus_identity(self.model.rotation);
        let shift = turn * joint.shift_mm() + location.shift_mm();
        (!location.is_zero()).then(|| Displacement { shift, turn_minus_identity: Mat3::zeros() })
    }
}

/// `R⁻¹ − I` of an error's rotation.
pub(crate) fn inverse_turn_minus_identity(six: &SixErrors, rotation: Rotation) -> Mat3 {
    let turn = six.rotation_minus_identity(rotation);
    match rotation {
        Rotation::Exact => turn.transpose(),
        Rotation::SmallAngle => -(inverse3(&(Mat3::identity() + turn)) * turn),
    }
}

/// The displacement of an error, its turn by a function.
fn displacement(six: &SixErrors, turn: impl Fn(&SixErrors) -> Mat3) -> Option<Displacement> {
    (!six.is_zero()).then(|| Displacement { shift: six.shift_mm(), turn_minus_identity: turn(six) })
}

/// The deviation of a direction after the actual vector has been made a unit vector again.
pub(crate) fn renormalised(nominal: &Vec3, d: &Vec3) -> Vec3 {
    let excess = 2.0 * nominal.dot(d) + d.norm_squared();
    let norm = (1.0 + excess).sqrt();
    // 1/norm − 1 without cancellation.
    let shrink = -excess / (norm * (1.0 + norm));
    d + (nominal + d) * shrink
}
