//! The six errors of one link of the chain, location errors in them, on either side of its joint.
//!
//! ```text
//!     P · Λ · J(q) · E(q) = P · J(q) · E′(q)       moving:   ε′ = R⁻¹·ε_Λ + ε_E       δ′ = R⁻¹·(δ_Λ + ε_Λ × d) + δ_E
//!     P · Λ · J(q) · E(q) = P · E″(q) · J(q)       fixed:    ε″ = ε_Λ + R·ε_E         δ″ = δ_Λ + R·δ_E − R·ε_E × d
//! ```
//!
//! R and d are the turn and the shift of J(q); to first order. docs/model.md eq. 328. What the products of two
//! errors add is part of the residual error, which is judged on the whole machine.

use super::content::Content;
use super::control::Control;
use super::table::{counts, interpolated};
use trueaxis_geometry::frame::rotation;
use trueaxis_geometry::{Mat3, Vec3};
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{Approach, AxisKind, Command};
use trueaxis_machine::chain::{ErrorFrame, Squareness};
use trueaxis_machine::errors::{BodyErrors, ErrorValues, SixErrors};

/// The joint of a body at a command: its turn and its shift.
struct Joint {
    turn: Mat3,
    shift: Vec3,
}

impl Joint {
    fn of(machine: &Machine, body: usize, command: &Command) -> Self {
        let still = Self { turn: Mat3::identity(), shift: Vec3::zeros() };
        let Some(i) = machine.bodies()[body].axis else { return still };
        let axis = &machine.axes()[i];
        let way = axis.sense * command[i];
        match axis.kind {
            AxisKind::Linear => Self { shift: axis.direction * way, ..still },
            AxisKind::Rotary => Self { turn: rotation(axis.direction, way), ..still },
        }
    }

    /// A small motion before the joint as one after it.
    fn moving_from_fixed(&self, six: &SixErrors) -> SixErrors {
        let (shift, turn) = halves(six);
        let back = self.turn.transpose();
        joined(back * (shift + turn.cross(&self.shift)), back * turn)
    }

    /// A small motion after the joint as one before it.
    fn fixed_from_moving(&self, six: &SixErrors) -> SixErrors {
        let (shift, turn) = halves(six);
        let turn = self.turn * turn;
        joined(self.turn * shift - turn.cross(&self.shift), turn)
    }
}

fn halves(six: &SixErrors) -> (Vec3, Vec3) {
    (six.shift_mm(), Vec3::new(six.0[3], six.0[4], six.0[5]))
}

fn joined(shift: Vec3, turn: Vec3) -> SixErrors {
    SixErrors([shift.x, shift.y, shift.z, turn.x, turn.y, turn.z])
}

fn sum(a: &SixErrors, b: &SixErrors) -> SixErrors {
    SixErrors(std::array::from_fn(|i| a.0[i] + b.0[i]))
}

/// The frame in which the machine file gives the error motions of a body.
fn frame_of(machine: &Machine, body: usize) -> ErrorFrame {
    let chain = &machine.bodies()[body];
    match chain.axis.map(|i| machine.axes()[i].kind) {
        Some(AxisKind::Rotary) => chain.error_frame,
        _ => ErrorFrame::Moving,
    }
}

/// The six errors of a link at a command in the frame of a control; mm and rad.
pub fn link_errors(
    machine: &Machine,
    body: usize,
    command: &Command,
    (of, frame): (&BodyErrors, ErrorFrame),
) -> SixErrors {
    let joint = Joint::of(machine, body, command);
    let rotary =
        machine.bodies()[body].axis.is_some_and(|i| machine.axes()[i].kind == AxisKind::Rotary);
    let (with, six) = match frame_of(machine, body) {
        ErrorFrame::Fixed => (ErrorFrame::Fixed, sum(&of.location, &of.motion)),
        ErrorFrame::Moving => {
            let mut placed = joint.moving_from_fixed(&of.location);
            if !rotary && machine.model().squareness == Squareness::Direction {
                // Only the direction of motion is tilted; what is carried keeps its attitude.
                placed = joined(placed.shift_mm(), Vec3::zeros());
            }
            (ErrorFrame::Moving, sum(&placed, &of.motion))
        }
    };
    in_frame(&joint, (with, frame), &six)
}

fn in_frame(joint: &Joint, frames: (ErrorFrame, ErrorFrame), six: &SixErrors) -> SixErrors {
    match frames {
        (ErrorFrame::Moving, ErrorFrame::Fixed) => joint.fixed_from_moving(six),
        (ErrorFrame::Fixed, ErrorFrame::Moving) => joint.moving_from_fixed(six),
        _ => *six,
    }
}

/// What the control's chain has for errors at a command, as the machine file would state them.
pub fn errors_of(
    machine: &Machine,
    (control, content): (&dyn Control, &Content),
    command: &Command,
    approach: &Approach,
) -> ErrorValues {
    let mut errors = ErrorValues::default();
    for known in &content.known {
        let Some(index) = machine.error_index(known.error) else { continue };
        let (q, side) = machine.bodies()[index.body]
            .axis
            .map_or((0.0, 0.0), |axis| (counts(machine, axis, command[axis]), approach[axis]));
        errors.set(index, interpolated(&known.nodes, known.modulo, q, side) * known.count());
    }
    if control.knows_links() {
        for (body, of) in errors.bodies.iter_mut().enumerate().take(machine.bodies().len()) {
            let joint = Joint::of(machine, body, command);
            let frames = (control.link_frame(machine, body), frame_of(machine, body));
            of.motion = in_frame(&joint, frames, &of.motion);
        }
    }
    if let Some(joints) = &content.joints {
        joints.place(machine, &mut errors);
    }
    errors
}

#[cfg(test)]
mod tests {
    use super::*;
    use trueaxis_machine::file::NoTables;

    /// 10 µrad of squareness of Y turn everything on it, and at Y = 500 mm have shifted it by −5 µm in x.
    #[test]
    fn squareness_as_a_function_of_the_axis() {
        let text =
            "[machine]\nname = \"m\"\nchain = \"w b X Y Z t\"\n[location]\nEC0Y = \"10 urad\"";
        let machine = Machine::check("m.toml", text, &NoTables).0.unwrap();
        let command = [0.0, 500.0, 0.0, 0.0, 0.0, 0.0];
        let errors = machine.errors_at(&command, &[0.0; 6]).unwrap();
        let six = link_errors(&machine, 2, &command, (&errors.bodies[2], ErrorFrame::Moving));
        assert!((six.0[0] + 0.005).abs() < 1e-15 && (six.0[5] - 1e-5).abs() < 1e-18, "{six:?}");
        let six = link_errors(&machine, 2, &command, (&errors.bodies[2], ErrorFrame::Fixed));
        assert!(six.0[0].abs() < 1e-15 && (six.0[5] - 1e-5).abs() < 1e-18, "{six:?}");
    }

    #[test]
    fn both_sides_of_a_joint_are_the_same_motion() {
        let turn = rotation(Vec3::y(), 0.7);
        let joint = Joint { turn, shift: Vec3::new(3.0, -200.0, 10.0) };
        let six = SixErrors([1e-3, -2e-3, 3e-3, 1e-5, 2e-5, -3e-5]);
        let back = joint.moving_from_fixed(&joint.fixed_from_moving(&six));
        for (a, b) in six.0.iter().zip(back.0) {
            assert!((a - b).abs() < 1e-15);
        }
    }
}
