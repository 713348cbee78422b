//! The tip and the tool axis of a chain, and the linear axes that bring the tip to its place, without
//! memory from the heap.

use super::Serial;
use crate::Machine;
use crate::axis::{AxisKind, Command};
use crate::chain::Link;
use trueaxis_geometry::{Mat3, Vec3};

/// Below this volume the three linear axes do not span the space: 1 mm of the tip would cost more
/// than 1 m of an axis.
const FLAT: f64 = 1e-3;

/// The nominal chain made ready for one command after the other.
#[derive(Debug, Clone)]
pub(crate) struct Placer {
    /// From the workpiece to the tool: the fixed pose before each joint, and after the last.
    steps: Vec<Step>,
    /// The linear axes that place the tip: X Y Z before U V W.
    pub placing: [usize; 3],
    tip_mm: Vec3,
}

/// A fixed step of the chain and the joint after it.
#[derive(Debug, Clone)]
struct Step {
    shift_mm: Vec3,
    /// `None` if nothing is turned.
    turn: Option<Mat3>,
    joint: Option<(AxisKind, Vec3)>,
}

impl Step {
    fn of(link: &Link, joint: Option<(AxisKind, Vec3)>) -> Self {
        let turn = Some(*link.linear()).filter(|turn| *turn != Mat3::identity());
        Self { shift_mm: *link.shift_mm(), turn, joint }
    }
}

impl Placer {
    /// `None` if the machine has fewer than three linear axes.
    pub fn of(machine: &Machine, serial: &Serial) -> Option<Self> {
        let mut linear: Vec<usize> = serial.linear().collect();
        linear.sort_by_key(|&i| !matches!(machine.axes()[i].name.letter(), 'X' | 'Y' | 'Z'));
        let placing = [*linear.first()?, *linear.get(1)?, *linear.get(2)?];
        // The sense goes into the direction: along −d is +d, about −d is the other way round.
        let joints = serial.joints.iter().map(|j| Some((j.kind, j.direction * j.sense)));
        let joints = joints.chain([None]);
        let steps = serial.fixed.iter().zip(joints).map(|(link, joint)| Step::of(link, joint));
        Some(Self { steps: steps.collect(), placing, tip_mm: machine.tip_mm() })
    }

    /// Tip (mm) and tool axis (unit vector) at a command.
    pub fn tip_and_axis(&self, command: &Command) -> (Vec3, Vec3) {
        let mut vectors = [self.tip_mm, Vec3::z()];
        for (i, step) in self.steps.iter().enumerate().rev() {
            match step.joint {
                Some((AxisKind::Rotary, about)) => turn_all(about, command[i], &mut vectors),
                Some((AxisKind::Linear, along)) => vectors[0] += along * command[i],
                None => {}
            }
            step.place(&mut vectors);
        }
        (vectors[0], vectors[1].normalize())
    }

    /// Sets the linear axes so that the tip is at `tip_mm`; `false`, and nothing set, where they do not
    /// reach it.
    pub fn place(&self, tip_mm: Vec3, command: &mut Command) -> bool {
        let mut vectors = [self.tip_mm, Vec3::zeros(), Vec3::zeros(), Vec3::zeros()];
        for (i, step) in self.steps.iter().enumerate().rev() {
            match step.joint {
                Some((AxisKind::Rotary, about)) => turn_all(about, command[i], &mut vectors),
                Some((AxisKind::Linear, along)) => {
                    match self.placing.iter().position(|&axis| axis == i) {
                        Some(column) => vectors[1 + column] = along,
                        None => vectors[0] += along * command[i],
                    }
                }
                None => {}
            }
            step.place(&mut vectors);
        }
        let [at_zero, d1, d2, d3] = vectors;
        let missing = tip_mm - at_zero;
        let across = d2.cross(&d3);
        let volume = d1.dot(&across);
        if volume.is_nan() || volume.abs() <= FLAT {
            return false;
        }
        let solved = [
            missing.dot(&across) / volume,
            missing.dot(&d3.cross(&d1)) / volume,
            missing.dot(&d1.cross(&d2)) / volume,
        ];
        let finite = solved.iter().all(|q| q.is_finite());
        if finite {
            for (axis, q) in self.placing.into_iter().zip(solved) {
                command[axis] = q + 0.0; // −0 is 0
            }
        }
        finite
    }
}

impl Step {
    /// Through the fixed step: the first vector is a place, the others are directions.
    fn place<const N: usize>(&self, vectors: &mut [Vec3; N]) {
        if let Some(turn) = &self.turn {
            vectors.iter_mut().for_each(|v| *v = turn * *v);
        }
        vectors[0] += self.shift_mm;
    }
}

/// Turns vectors about a unit vector (Rodrigues).
fn turn_all<const N: usize>(about: Vec3, angle_rad: f64, vectors: &mut [Vec3; N]) {
    let (sin, cos) = angle_rad.sin_cos();
    for v in vectors {
        *v = *v * cos + about.cross(v) * sin + about * (about.dot(v) * (1.0 - cos));
    }
}
