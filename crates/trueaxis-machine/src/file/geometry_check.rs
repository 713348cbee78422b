//! Checks that the directions of the axes are independent.

use crate::axis::AxisKind;
use crate::chain::{ChainBody, Machine};
use crate::errors::{BodyName, ErrorValues};
use trueaxis_geometry::Vec3;
use trueaxis_geometry::frame::{Bed, Body, Pose};
use trueaxis_input::Item;

/// Directions closer than this (sine of the angle, or volume of three) count as one.
const ALIKE: f64 = 1e-6;

/// Warns of linear axes that leave a direction without motion, and of neighbouring rotary axes that
/// turn about the same direction; both with all axes at zero.
pub fn warn_about_directions(machine: &Machine, chain: &Item<'_>) {
    let linear = directions(machine, AxisKind::Linear);
    let spans = linear.iter().enumerate().any(|(i, (_, a))| {
        linear[i + 1..].iter().enumerate().any(|(j, (_, b))| {
            linear[i + j + 2..].iter().any(|(_, c)| a.cross(b).dot(c).abs() > ALIKE)
        })
    });
    if !spans {
        let message = "the linear axes do not move the tool in all three directions".to_owned();
        chain.warn("dependent-axes", message, "check their `direction` and the placements");
    }
    for pair in directions(machine, AxisKind::Rotary).windows(2) {
        let [(first, a), (second, b)] = pair else { continue };
        if a.cross(b).norm() < ALIKE {
            let message = format!("{first} and {second} turn about the same direction");
            chain.warn("parallel-axes", message, "check their `direction` and the placements");
        }
    }
}

/// The direction of every axis of a kind in the machine frame, with all axes at zero.
fn directions(machine: &Machine, kind: AxisKind) -> Vec<(BodyName, Vec3)> {
    let at_zero = machine.body_poses(&Default::default(), &ErrorValues::default());
    let of_body = |(body, pose): (&ChainBody, &Pose<Bed, Body>)| {
        let axis = &machine.axes()[body.axis?];
        (axis.kind == kind).then(|| (axis.name, pose.linear() * axis.direction))
    };
    machine.bodies().iter().zip(&at_zero).filter_map(of_body).collect()
}
