//! The chain as a list of steps from the tool tip to the workpiece.

use crate::axis::AxisKind;
use crate::chain::{ChainBody, Link, Machine, Step as Rule};
use crate::errors::{Component, Curve, ErrorKind, Rotation, SixErrors};
use trueaxis_geometry::{Mat3, Vec3};

/// One step of the tip p, the tool axis and their deviations d on their way to the workpiece.
#[derive(Debug, Clone, Copy)]
pub(super) enum Step {
    /// A constant error: `d ← d + t + D·(p + d)`.
    Error { shift_mm: [f64; 3], turn: [[f64; 3]; 3] },
    /// A constant nominal pose: `p ← R·p + s`, `d ← R·d`.
    Place { linear: [[f64; 3]; 3], shift_mm: [f64; 3] },
    /// A constant nominal shift: `p ← p + s`.
    Shift { shift_mm: [f64; 3] },
    /// The error motions of an axis; `against` towards the workpiece, where they are inverted.
    Motion { motion: usize, against: bool },
    /// The nominal motion of an axis.
    Joint(Joint),
}

/// The nominal motion of an axis, or its inverse.
#[derive(Debug, Clone, Copy)]
pub(super) enum Joint {
    /// A linear axis along a machine axis: `p[along] ← p[along] + q·per_unit`.
    SlideAlong { axis: usize, along: usize, per_unit: f64 },
    /// A linear axis in any direction.
    Slide { axis: usize, per_unit: [f64; 3] },
    /// A rotary axis about a machine axis, by `q·sense`.
    TurnAbout { axis: usize, about: usize, sense: f64 },
    /// A rotary axis about any direction, by `q·sense`.
    Turn { axis: usize, direction: [f64; 3], sense: f64 },
}

impl Joint {
    /// The motion of an axis times `way`: 1, or −1 for its inverse.
    pub(super) fn of(machine: &Machine, index: usize, way: f64) -> Self {
        let axis = &machine.axes()[index];
        let (direction, sense) = (axis.direction, axis.sense * way);
        // A direction along a machine axis has one component, ±1.
        let along = (0..3).find(|&k| direction[k].abs() == 1.0 && direction.norm_squared() == 1.0);
        match (axis.kind, along) {
            (AxisKind::Linear, Some(along)) => {
                Self::SlideAlong { axis: index, along, per_unit: sense * direction[along] }
            }
            (AxisKind::Linear, None) => {
                Self::Slide { axis: index, per_unit: (direction * sense).into() }
            }
            (AxisKind::Rotary, Some(about)) => {
                Self::TurnAbout { axis: index, about, sense: sense * direction[about] }
            }
            (AxisKind::Rotary, None) => {
                Self::Turn { axis: index, direction: direction.into(), sense }
            }
        }
    }
}

/// The whole way.
#[derive(Debug, Clone)]
pub(super) struct Steps {
    /// Tip, tool axis, deviation of the tip, of the axis, before the first step that moves.
    pub(super) start: [[f64; 3]; 4],
    pub(super) list: Vec<Step>,
}

impl Steps {
    /// `None` for a machine with a rule that the kernels do not know.
    pub(super) fn of(machine: &Machine, motion_of_body: &[Option<usize>]) -> Option<Self> {
        let mut path = Path {
            tip: [machine.tip_mm(), Vec3::zeros()],
            axis: [Vec3::z(), Vec3::zeros()],
            ahead: Constants::none(),
            list: Vec::new(),
        };
        let side = machine.workpiece_side();
        for i in (side..machine.bodies().len()).rev() {
            path.towards_bed(machine, i, motion_of_body[i])?;
        }
        for i in (0..side).rev() {
            path.away_from_bed(machine, i, motion_of_body[i])?;
        }
        path.flush();
        let start = [path.tip[0], path.axis[0], path.tip[1], path.axis[1]].map(Into::into);
        Some(Self { start, list: path.list })
    }
}

/// Constants met since the last step that moves: first the error `I + D, t`, then the pose `R, s`.
///
/// A run of constant errors and poses is one of each:
///
/// ```text
///     (I + D₂)(R((I + D)u + t) + s) + t₂  =  R((I + D′)u + t′) + s
///     D′ = D + RᵀD₂R(I + D)        t′ = t + Rᵀ(t₂ + D₂(R·t + s))
/// ```
struct Constants {
    turn: Mat3,
    shift_mm: Vec3,
    place: Link,
}

impl Constants {
    fn none() -> Self {
        Self { turn: Mat3::zeros(), shift_mm: Vec3::zeros(), place: Link::identity() }
    }

    fn displace(&mut self, shift_mm: Vec3, turn: &Mat3) {
        let (linear, place_mm) = (self.place.linear(), self.place.shift_mm());
        let back = linear.transpose();
        self.shift_mm += back * (shift_mm + turn * (linear * self.shift_mm + place_mm));
        self.turn += back * turn * linear * (Mat3::identity() + self.turn);
    }

    fn forward(&mut self, step: &Link) {
        self.place = *step * self.place;
    }

    /// Through a pose against its direction; nominal poses are rotations.
    fn backward(&mut self, step: &Link) {
        let back = step.linear().transpose();
        self.forward(&Link::new(back, -(back * step.shift_mm())));
    }
}

/// The list in the making; `tip` and `axis` are nominal vector and deviation.
struct Path {
    tip: [Vec3; 2],
    axis: [Vec3; 2],
    ahead: Constants,
    list: Vec<Step>,
}

impl Path {
    /// Through one link, the steps of its rule from the right to the left; `None` for a rule that
    /// the kernels do not know.
    fn towards_bed(&mut self, machine: &Machine, i: usize, motion: Option<usize>) -> Option<()> {
        let body = &machine.bodies()[i];
        self.ahead.forward(&body.mounting);
        for step in machine.steps(i).iter().rev() {
            match step {
                Rule::Location => {
                    let (shift, turn) = location(body);
                    self.ahead.displace(shift, &turn);
                }
                Rule::Joint => self.joint(machine, body.axis?, 1.0),
                Rule::Motion => self.motion(motion, false),
                Rule::TiltedJoint => return None,
            }
        }
        self.ahead.forward(&body.placement);
        Some(())
    }

    /// Through the inverse of one link, from the left to the right.
    fn away_from_bed(&mut self, machine: &Machine, i: usize, motion: Option<usize>) -> Option<()> {
        let body = &machine.bodies()[i];
        self.ahead.backward(&body.placement);
        for step in machine.steps(i) {
            match step {
                Rule::Location => {
                    // (I + D)⁻¹(u − t) = u + Dᵀu − (I + Dᵀ)t
                    let (shift, turn) = location(body);
                    let back = turn.transpose();
                    self.ahead.displace(-(shift + back * shift), &back);
                }
                Rule::Joint => self.joint(machine, body.axis?, -1.0),
                Rule::Motion => self.motion(motion, true),
                Rule::TiltedJoint => return None,
            }
        }
        self.ahead.backward(&body.mounting);
        Some(())
    }

    fn motion(&mut self, motion: Option<usize>, against: bool) {
        if let Some(motion) = motion {
            self.flush();
            self.list.push(Step::Motion { motion, against });
        }
    }

    fn joint(&mut self, machine: &Machine, index: usize, way: f64) {
        self.flush();
        self.list.push(Step::Joint(Joint::of(machine, index, way)));
    }

    /// Writes the constants down: into the start as long as nothing has moved, else as steps.
    fn flush(&mut self) {
        let ahead = std::mem::replace(&mut self.ahead, Constants::none());
        let (linear, shift_mm) = (*ahead.place.linear(), *ahead.place.shift_mm());
        if self.list.is_empty() {
            for ([nominal, deviation], place) in [(&mut self.tip, 1.0), (&mut self.axis, 0.0)] {
                *deviation += ahead.shift_mm * place + ahead.turn * (*nominal + *deviation);
                *nominal = linear * *nominal + shift_mm * place;
                *deviation = linear * *deviation;
            }
            return;
        }
        if ahead.turn != Mat3::zeros() || ahead.shift_mm != Vec3::zeros() {
            let (shift_mm, turn) = (ahead.shift_mm.into(), rows(&ahead.turn));
            self.list.push(Step::Error { shift_mm, turn });
        }
        if linear != Mat3::identity() {
            self.list.push(Step::Place { linear: rows(&linear), shift_mm: shift_mm.into() });
        } else if shift_mm != Vec3::zeros() {
            self.list.push(Step::Shift { shift_mm: shift_mm.into() });
        }
    }
}

/// Shift and `R − I` of location errors.
fn location(body: &ChainBody) -> (Vec3, Mat3) {
    let six = location_errors(body);
    (six.shift_mm(), six.rotation_minus_identity(Rotation::Exact))
}

/// The location errors of a body, which are constants here.
pub(super) fn location_errors(body: &ChainBody) -> SixErrors {
    let constant = |curve: &Curve| match curve {
        Curve::Constant(value) => *value,
        _ => 0.0,
    };
    let stated =
        |c: Component| body.location[c as usize].as_ref().map_or(0.0, |e| constant(&e.mean));
    let mut six = SixErrors(Component::ALL.map(stated));
    for term in body.thermal.iter().filter(|t| t.kind == ErrorKind::Location) {
        six.0[term.component as usize] += constant(&term.curve);
    }
    six
}

fn rows(m: &Mat3) -> [[f64; 3]; 3] {
    [0, 1, 2].map(|i| [0, 1, 2].map(|k| m[(i, k)]))
}
