//! A ball-bar on a machine whose errors are known.

use trueaxis_geometry::Vec3;
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{Approach, Command};
use trueaxis_standards::iso230_4::Sense;

/// A step that shows which way an axis moves the tool, mm.
const STEP_MM: f64 = 1.0;
/// Two axes of a circle are square to each other up to this. Unit: 1.
const SQUARE: f64 = 1e-3;

/// A circle in the plane of two linear axes.
#[derive(Debug, Clone, PartialEq)]
pub struct VirtualCircle {
    /// The two axes; the angle counts from the first to the second, by their commands.
    pub axes: [usize; 2],
    /// Its centre as commanded, with the other axes where they stand; mm and rad.
    pub centre: Command,
    /// Its radius, mm.
    pub radius_mm: f64,
    /// The ball in the frame of the tool, mm.
    pub ball_mm: Vec3,
}

impl VirtualCircle {
    /// The machine with the ball in its spindle, while the compensations of its control are switched on.
    fn machine(&self, machine: &Machine) -> Machine {
        machine.with_active_compensation().with_tip(self.ball_mm)
    }

    /// The directions in which positive commands of the two axes move the ball, in the frame of the workpiece.
    ///
    /// # Errors
    /// In words, why these axes make no circle.
    pub fn directions(&self, machine: &Machine) -> Result<[Vec3; 2], String> {
        let machine = self.machine(machine);
        let at = |axis: usize, step: f64| {
            let mut command = self.centre;
            command[axis] += step;
            machine.deviation(&command, &Default::default()).nominal_tip.vector()
        };
        let [first, second] =
            self.axes.map(|axis| (at(axis, STEP_MM) - at(axis, -STEP_MM)) / (2.0 * STEP_MM));
        let is_straight = |d: &Vec3| (d.norm() - 1.0).abs() < SQUARE;
        match is_straight(&first) && is_straight(&second) && first.dot(&second).abs() < SQUARE {
            true => Ok([first, second]),
            false => {
                Err("these two axes do not move along two lines that are square to each other"
                    .to_owned())
            }
        }
    }

    /// What the ball-bar reads more than its radius, at angles with the sense of rotation, mm.
    ///
    /// # Errors
    /// A position that the machine file does not cover, axes that make no circle.
    pub fn read(&self, machine: &Machine, points: &[(f64, Sense)]) -> Result<Vec<f64>, String> {
        let [first, second] = self.directions(machine)?;
        let machine = self.machine(machine);
        let deviation = |command: &Command, approach: &Approach| {
            let errors = machine.errors_at(command, approach).map_err(|fault| fault.to_string())?;
            Ok::<Vec3, String>(machine.deviation(command, &errors).tip_mm)
        };
        let of_centre = deviation(&self.centre, &Approach::default())?;
        points
            .iter()
            .map(|(angle, sense)| {
                let (sin, cos) = angle.sin_cos();
                let (mut command, mut approach) = (self.centre, Approach::default());
                let [a, b] = self.axes;
                command[a] += self.radius_mm * cos;
                command[b] += self.radius_mm * sin;
                approach[a] = -sense.sign() * sin;
                approach[b] = sense.sign() * cos;
                for side in &mut approach {
                    *side = if *side == 0.0 { 0.0 } else { side.signum() };
                }
                let from_centre = (first * cos + second * sin) * self.radius_mm;
                let moved = deviation(&command, &approach)? - of_centre;
                Ok((from_centre + moved).norm() - self.radius_mm)
            })
            .collect()
    }
}
