//! Sensitivity of the tool pose to each error: the derivative of the chain.
//!
//! ```text
//!     δp = v + ω × p        a point p of the tool, in the frame of the reference     docs/model.md eq. 102
//! ```

use crate::axis::Command;
use crate::chain::{Link, Machine, Step, moved_by};
use crate::errors::{Component, ErrorIndex, ErrorKind, ErrorValues, MAX_BODIES};
use trueaxis_geometry::Vec3;
use trueaxis_geometry::frame::{Bed, Pose, Tool};

/// The body relative to which the motion of the tool is stated.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
pub enum Reference {
    /// The workpiece, and everything else mounted on the table.
    #[default]
    Workpiece,
    /// The bed: instruments on the floor or on the machine frame.
    Bed,
}

/// A small motion of the tool as seen from the reference: the point p moves by `v + ω × p`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Twist {
    /// v: the motion of the point of the tool at the origin of the reference, mm per mm or
    /// mm per rad of the error.
    pub shift_mm: Vec3,
    /// ω, rad per mm or rad per rad of the error.
    pub turn_rad: Vec3,
}

/// The frames in which the errors of the chain act at one command.
#[derive(Debug, Clone, Copy)]
pub struct ErrorFrames {
    bodies: [BodyFrames; MAX_BODIES],
    reference_from_tool: Link,
}

#[derive(Debug, Clone, Copy)]
struct BodyFrames {
    /// reference_from_frame of the location errors and of the error motions.
    frames: [Link; 2],
    /// +1 on the tool's side of the chain, −1 on the workpiece's, 0 where the reference carries it.
    side: f64,
    /// A squareness tilts only this motion, mm.
    tilted_mm: Option<Vec3>,
}

impl ErrorFrames {
    /// The nominal pose of the tool in the frame of the reference.
    pub fn reference_from_tool(&self) -> &Link {
        &self.reference_from_tool
    }

    /// The motion of the tool per unit (mm or rad) of one error.
    ///
    /// # Example
    /// ```
    /// use trueaxis_geometry::Vec3;
    /// use trueaxis_machine::{Machine, errors::{ErrorName, ErrorIndex}, file::NoTables, twist::Reference};
    /// let text = "[machine]\nname = \"mill\"\nchain = \"w b Y X Z t\"\n[tool]\nlength = \"100 mm\"";
    /// let machine = Machine::check("mill.toml", text, &NoTables).0.expect("a machine");
    /// let frames = machine.error_frames(&[500.0, 0.0, 0.0, 0.0, 0.0, 0.0], Reference::Workpiece);
    /// let name = ErrorName::parse("EC0Y").expect("a name");
    /// let index = ErrorIndex { body: 1, kind: name.kind, component: name.component };
    /// let twist = frames.twist(index);
    /// // A point at Y = 500 mm moves by −500 mm per rad in X: 10 µrad of EC0Y are −5 µm.
    /// let moved = twist.shift_mm + twist.turn_rad.cross(&Vec3::new(0.0, 500.0, -100.0));
    /// assert!((moved - Vec3::new(-500.0, 0.0, 0.0)).norm() < 1e-9);
    /// ```
    pub fn twist(&self, index: ErrorIndex) -> Twist {
        let body = &self.bodies[index.body];
        let frame = &body.frames[index.kind as usize];
        let column = frame.linear().column(index.component as usize % 3) * body.side;
        if !index.component.is_rotation() {
            return Twist { shift_mm: column, turn_rad: Vec3::zeros() };
        }
        match body.tilted_mm {
            Some(motion) if index.kind == ErrorKind::Location => {
                let along = unit(index.component).cross(&motion);
                let shift_mm = frame.linear() * along * body.side;
                Twist { shift_mm, turn_rad: Vec3::zeros() }
            }
            _ => Twist { shift_mm: frame.shift_mm().cross(&column), turn_rad: column },
        }
    }
}

fn unit(component: Component) -> Vec3 {
    Vec3::ith(component as usize % 3, 1.0)
}

impl Machine {
    /// The frames in which the errors act at a command of the nominal machine.
    ///
    /// ```text
    ///     shift error i:     v = ± R·eᵢ               ω = 0
    ///     rotation error i:  v = ± o × R·eᵢ           ω = ± R·eᵢ                    docs/model.md eq. 103
    /// ```
    ///
    /// (R, o) is the frame of the error in the reference, + on the tool's side of the chain and −
    /// on the workpiece's.
    pub fn error_frames(&self, command: &Command, reference: Reference) -> ErrorFrames {
        let nothing = BodyFrames { frames: [Link::identity(); 2], side: 0.0, tilted_mm: None };
        let mut bodies = [nothing; MAX_BODIES];
        let mut bed_from_body = Link::identity();
        for i in (0..self.workpiece_side).rev() {
            bodies[i] = self.body_frames(i, command, &mut bed_from_body, -1.0);
        }
        let reference_from_bed = match reference {
            Reference::Bed => Link::identity(),
            Reference::Workpiece => bed_from_body.inverse(),
        };
        bed_from_body = Link::identity();
        for (i, body) in bodies.iter_mut().enumerate().take(self.bodies.len()) {
            if i >= self.workpiece_side {
                *body = self.body_frames(i, command, &mut bed_from_body, 1.0);
            }
            if i < self.workpiece_side && reference == Reference::Bed {
                body.side = 0.0;
            }
            for frame in &mut body.frames {
                *frame = reference_from_bed * *frame;
            }
        }
        ErrorFrames { bodies, reference_from_tool: reference_from_bed * bed_from_body }
    }

    /// The frames of one body, and on to the next.
    fn body_frames(
        &self,
        i: usize,
        command: &Command,
        bed_from_body: &mut Link,
        side: f64,
    ) -> BodyFrames {
        let body = &self.bodies[i];
        let mut here = *bed_from_body * body.placement;
        let mut frames = BodyFrames { frames: [here; 2], side, tilted_mm: None };
        let joint = body.axis.map(|axis| (&self.axes[axis], command[axis]));
        for step in self.steps(i) {
            match (step, joint) {
                (Step::Location, _) => frames.frames[ErrorKind::Location as usize] = here,
                (Step::Motion, _) => frames.frames[ErrorKind::Motion as usize] = here,
                (Step::Joint, Some((axis, q))) => here = moved_by(here, axis, q),
                (Step::TiltedJoint, Some((axis, q))) => {
                    frames.tilted_mm = Some(axis.direction * (axis.sense * q));
                    here = moved_by(here, axis, q);
                }
                (Step::Joint | Step::TiltedJoint, None) => {}
            }
        }
        *bed_from_body = here * body.mounting;
        frames
    }

    /// The pose of the tool in the frame of the bed with these errors; [`Machine::pose`] gives it in the
    /// frame of the workpiece.
    pub fn tool_on_bed(&self, command: &Command, errors: &ErrorValues) -> Pose<Bed, Tool> {
        let product = |acc: Link, i: usize| acc * self.link(i, command, &errors.bodies[i]);
        (self.workpiece_side..self.bodies.len()).fold(Link::identity(), product).relabel()
    }
}
