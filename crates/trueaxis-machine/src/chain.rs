//! The kinematic chain of bodies, and the pose of the tool in the workpiece frame.
//!
//! One link, the only place where errors enter (docs/model.md eq. 1):
//!
//! ```text
//!     parent_from_link = P · Λ · J(q) · E(q) · M         linear; rotary in the moving frame
//!     parent_from_link = P · Λ · E(q) · J(q) · M         rotary in the fixed frame (ISO 230-7)
//! ```
//!
//! P placement, Λ location errors, J nominal motion, E error motions, M mounting (fixed, after the
//! motion; identity for axes). The order of the steps between P and M is defined in `chain/rule.rs`.

mod rule;

pub(crate) use rule::Step;

use crate::axis::{Approach, Axis, AxisKind, Command, Travel};
use crate::errors::{
    BodyErrors, BodyName, Component, Curve, ErrorIndex, ErrorKind, ErrorName, ErrorValues,
    Influence, JointErrors, OutsideTable, Rotation, SixErrors, StatedError, Uncertainties,
};
use crate::heat::{HeatModel, ThermalTerm, WorkpieceGrowth};
use std::sync::Arc;
use trueaxis_geometry::frame::{Bed, Body, Pose, Tool, Workpiece, rotation};
use trueaxis_geometry::{Mat3, Vec3};

/// A pose between two bodies of the chain; the name of the variable states which two.
pub type Link = Pose<Body, Body>;

/// In which frame the error motions of a rotary axis are stated.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum ErrorFrame {
    /// Not turning with the axis, as ISO 230-7 measures them.
    #[default]
    Fixed,
    /// Turning with the axis, as the papers write them.
    Moving,
}

/// The bodies that the squareness of a linear axis rotates.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Squareness {
    /// Everything that the axis carries (Wu et al. 2022).
    #[default]
    Carried,
    /// The direction of motion only.
    Direction,
}

/// The model by which errors enter the chain.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct ErrorModel {
    /// Exact rotations or the papers' small angles.
    pub rotation: Rotation,
    /// The bodies that a squareness rotates.
    pub squareness: Squareness,
}

/// One body of the chain: the workpiece, an axis or the tool.
#[derive(Debug, Clone, PartialEq)]
pub struct ChainBody {
    /// Its name.
    pub name: BodyName,
    /// P: its pose on its parent (towards the bed) at zero, without errors.
    pub placement: Link,
    /// Index of its axis in [`Machine::axes`]; `None` for the workpiece and the tool.
    pub axis: Option<usize>,
    /// Frame of its error motions.
    pub error_frame: ErrorFrame,
    /// M: the fixed pose after motion and errors (fixture, part zero).
    pub mounting: Link,
    /// Stated location errors, X Y Z A B C.
    pub location: [Option<StatedError>; 6],
    /// Stated error motions, X Y Z A B C.
    pub motion: [Option<StatedError>; 6],
    /// The thermal parts of its errors; empty without conditions ([`Machine::at`]).
    pub thermal: Vec<ThermalTerm>,
}

impl ChainBody {
    /// A body without placement, mounting and errors.
    pub fn new(name: BodyName, axis: Option<usize>) -> Self {
        Self {
            name,
            placement: Pose::identity(),
            axis,
            error_frame: ErrorFrame::Fixed,
            mounting: Pose::identity(),
            location: Default::default(),
            motion: Default::default(),
            thermal: Vec::new(),
        }
    }

    /// The stated error of a kind and direction.
    pub fn stated(&self, kind: ErrorKind, component: Component) -> Option<&StatedError> {
        match kind {
            ErrorKind::Location => self.location[component as usize].as_ref(),
            ErrorKind::Motion => self.motion[component as usize].as_ref(),
        }
    }
}

/// A checked machine tool: its chain, its axes, its errors.
#[derive(Debug, Clone, PartialEq)]
pub struct Machine {
    pub(crate) name: String,
    pub(crate) source: String,
    pub(crate) axes: Vec<Axis>,
    /// From the workpiece to the tool.
    pub(crate) bodies: Vec<ChainBody>,
    /// The number of bodies between workpiece and bed, the workpiece included.
    pub(crate) workpiece_side: usize,
    pub(crate) model: ErrorModel,
    /// The tip in the frame of the tool, mm.
    pub(crate) tip_mm: Vec3,
    /// Whether it is stated; else it is 0.
    pub(crate) tip_stated: bool,
    pub(crate) tools: Vec<crate::tool::ToolAssembly>,
    pub(crate) models: Vec<crate::models::Model>,
    pub(crate) heat: HeatModel,
    /// The thermal growth of the workpiece, if it is not at 20 °C.
    pub(crate) growth: Option<WorkpieceGrowth>,
    /// Errors that the control compensates.
    pub(crate) active: Vec<ErrorName>,
    pub(crate) equipment: crate::equipment::Equipment,
    /// Errors with a covariance; their own uncertainties do not count.
    pub(crate) joint: Option<Arc<JointErrors>>,
    /// Quantities of a study.
    pub(crate) influences: Arc<[Influence]>,
}

/// α_w among the uncertain quantities.
const WORKPIECE_EXPANSION: &str = "expansion of the workpiece";

/// Commands beyond 10¹² mm or rad are mistakes, as for the quantities of a file, and powers of them
/// overflow.
const LARGEST_COMMAND: f64 = 1e12;

/// The reason why the errors of a machine are not defined at a command.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum CommandFault {
    /// The command is not a finite number or exceeds 10¹² mm or rad.
    #[error("the commanded position {at} of {axis} is not a finite number")]
    NotFinite {
        /// The axis.
        axis: BodyName,
        /// The command, mm or rad.
        at: f64,
    },
    /// The command lies outside an error table that is not extended.
    #[error("{}", table_left(.name, .source))]
    TableLeft {
        /// The error of that table.
        name: ErrorName,
        /// The position and the range of the table.
        source: OutsideTable,
    },
}

fn table_left(name: &ErrorName, left: &OutsideTable) -> String {
    let (scale, unit) = match name.body.is_rotary() {
        true => (180.0 / std::f64::consts::PI, "deg"),
        false => (1.0, "mm"),
    };
    // Twelve digits hide the rounding of degrees to radians and back.
    let [at, from, to] = [left.at, left.from, left.to]
        .map(|v| format!("{:.11e}", v * scale).parse::<f64>().unwrap_or(v * scale));
    format!("{name}: {at} {unit} lies outside the error table, which covers {from} .. {to} {unit}")
}

impl Machine {
    /// The name of the machine.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The source of its data, as stated in the machine file.
    pub fn source(&self) -> &str {
        &self.source
    }

    /// Its axes, in chain order from the workpiece to the tool.
    pub fn axes(&self) -> &[Axis] {
        &self.axes
    }

    /// The command within the travel of all axes that is nearest to a command.
    pub fn nearest_in_travel(&self, command: &Command) -> Command {
        let mut inside = *command;
        for (q, axis) in inside.iter_mut().zip(&self.axes) {
            if let Travel::Between(low, high) = axis.travel {
                *q = q.clamp(low, high);
            }
        }
        inside
    }

    /// Its bodies, in chain order from the workpiece to the tool (without the bed).
    pub fn bodies(&self) -> &[ChainBody] {
        &self.bodies
    }

    /// The number of [`Machine::bodies`] on the workpiece side of the bed.
    pub fn workpiece_side(&self) -> usize {
        self.workpiece_side
    }

    /// The model by which errors enter.
    pub fn model(&self) -> ErrorModel {
        self.model
    }

    /// The tip of the tool in the frame of the tool, mm.
    pub fn tip_mm(&self) -> Vec3 {
        self.tip_mm
    }

    /// Whether the tip of the tool is stated, by the machine file or later; else it is 0.
    pub fn is_tip_stated(&self) -> bool {
        self.tip_stated
    }

    /// The tool assemblies that the machine file lists.
    pub fn tools(&self) -> &[crate::tool::ToolAssembly] {
        &self.tools
    }

    /// Spindle and magazine.
    pub fn equipment(&self) -> &crate::equipment::Equipment {
        &self.equipment
    }

    /// The solid models of its bodies, in the order of the machine file.
    pub fn models(&self) -> &[crate::models::Model] {
        &self.models
    }

    /// The same machine with another tool tip, mm in the frame of the tool.
    pub fn with_tip(mut self, tip_mm: Vec3) -> Self {
        self.tip_mm = tip_mm;
        self.tip_stated = true;
        self
    }

    /// The same machine with the workpiece elsewhere: its placement on its parent, and the fixed
    /// pose of the part zero after the errors of the mounting.
    pub fn with_workpiece(mut self, placement: Link, mounting: Link) -> Self {
        self.bodies[0].placement = placement;
        self.bodies[0].mounting = mounting;
        self
    }

    /// The same machine with another value of a location error, mm or rad; its uncertainty stays.
    ///
    /// `None` if the chain has no such body or the name is that of an error motion.
    pub fn with_location(mut self, name: ErrorName, value: f64) -> Option<Self> {
        let body = self.bodies.iter_mut().find(|b| b.name == name.body)?;
        if name.kind != ErrorKind::Location {
            return None;
        }
        let slot = &mut body.location[name.component as usize];
        let mut stated = slot.take().unwrap_or_else(|| StatedError::constant(value, None));
        stated.mean = Curve::Constant(value);
        *slot = Some(stated);
        Some(self)
    }

    /// The same machine with another statement of one error; `None`: as if it were not known. With another
    /// uncertainty, the error has no part in a covariance any more.
    pub fn with_error(mut self, index: ErrorIndex, stated: Option<StatedError>) -> Self {
        if let Some(body) = self.bodies.get_mut(index.body) {
            let slots = match index.kind {
                ErrorKind::Location => &mut body.location,
                ErrorKind::Motion => &mut body.motion,
            };
            let u = |stated: &Option<StatedError>| stated.as_ref().map(|s| s.u.clone());
            let slot = &mut slots[index.component as usize];
            if u(slot) != u(&stated) && self.joint.as_ref().is_some_and(|joint| joint.has(index)) {
                self.joint = self.joint.and_then(|joint| joint.without(index)).map(Arc::new);
            }
            *slot = stated;
        }
        self
    }

    /// The same machine with errors that are known better together than each alone.
    pub fn with_joint(mut self, joint: JointErrors) -> Self {
        self.joint = Some(Arc::new(joint));
        self
    }

    /// The same machine with quantities of a study: they stand after its own among those of
    /// [`Machine::uncertain_quantities`].
    pub fn with_influences(mut self, influences: Vec<Influence>) -> Self {
        self.influences = influences.into();
        self
    }

    /// Errors that are known better together than each alone: their own uncertainties do not count.
    pub fn joint(&self) -> Option<&JointErrors> {
        self.joint.as_deref()
    }

    /// Where an error of that name stands; `None` if the chain has no such body.
    pub fn error_index(&self, name: ErrorName) -> Option<ErrorIndex> {
        let body = self.bodies.iter().position(|b| b.name == name.body)?;
        Some(ErrorIndex { body, kind: name.kind, component: name.component })
    }

    /// The same machine under another error model.
    pub fn with_model(mut self, model: ErrorModel) -> Self {
        self.model = model;
        self
    }

    /// The index of an axis by its letter.
    pub fn axis_index(&self, name: BodyName) -> Option<usize> {
        self.axes.iter().position(|a| a.name == name)
    }

    /// The chain from the workpiece to the tool in the long form: `w C' A' b X Y Z t`.
    pub fn chain_text(&self) -> String {
        let mut words: Vec<String> = self
            .bodies
            .iter()
            .enumerate()
            .map(|(i, body)| {
                let prime = if body.axis.is_some() && i < self.workpiece_side { "'" } else { "" };
                format!("{}{prime}", body.name)
            })
            .collect();
        words.insert(self.workpiece_side, "b".to_owned());
        words.join(" ")
    }

    /// Every error that the machine file states, in chain order.
    pub fn stated_errors(&self) -> Vec<(ErrorIndex, ErrorName)> {
        let mut stated = Vec::new();
        for (body, b) in self.bodies.iter().enumerate() {
            for kind in [ErrorKind::Location, ErrorKind::Motion] {
                for component in Component::ALL {
                    if b.stated(kind, component).is_some() {
                        let name = ErrorName { body: b.name, kind, component };
                        stated.push((ErrorIndex { body, kind, component }, name));
                    }
                }
            }
        }
        stated
    }

    /// The value of every error at a command.
    ///
    /// # Errors
    /// A command that is not finite, or outside an error table that has no value there.
    pub fn errors_at(
        &self,
        command: &Command,
        approach: &Approach,
    ) -> Result<ErrorValues, CommandFault> {
        for (axis, &at) in self.axes.iter().zip(command) {
            if at.is_nan() || at.abs() > LARGEST_COMMAND {
                return Err(CommandFault::NotFinite { axis: axis.name, at });
            }
        }
        let mut values = ErrorValues::default();
        for (body, out) in self.bodies.iter().zip(&mut values.bodies) {
            let (q, side) = body.axis.map_or((0.0, 0.0), |i| (command[i], approach[i]));
            for component in Component::ALL {
                let i = component as usize;
                let at = |kind, stated: &Option<StatedError>| match stated {
                    None => Ok(0.0),
                    Some(error) => error.at(q, side).map_err(|source| CommandFault::TableLeft {
                        name: ErrorName { body: body.name, kind, component },
                        source,
                    }),
                };
                out.location.0[i] = at(ErrorKind::Location, &body.location[i])?;
                out.motion.0[i] = at(ErrorKind::Motion, &body.motion[i])?;
            }
            for term in &body.thermal {
                out.six_mut(term.kind).0[term.component as usize] += term.at(q);
            }
        }
        if let Some(growth) = &self.growth {
            values.workpiece_mm = growth.at(self.nominal_tip_mm(command));
        }
        Ok(values)
    }

    /// Every independent quantity that has, or could have, an uncertainty: the stated errors in
    /// chain order, then the combinations of those with a covariance, then the coefficients of the thermal
    /// parts, then the expansion of the workpiece, then what a study adds.
    pub fn uncertain_quantities(&self) -> Vec<String> {
        let stated = self.stated_errors().into_iter().map(|(_, name)| name.to_string());
        let mut all: Vec<String> = stated.collect();
        all.extend(self.joint.iter().flat_map(|joint| joint.names().iter().cloned()));
        for u in self.bodies.iter().flat_map(|b| &b.thermal).flat_map(|t| &t.u) {
            if !all.contains(&u.of) {
                all.push(u.of.clone());
            }
        }
        if self.growth.as_ref().is_some_and(|g| g.expansion_per_k.u.is_some()) {
            all.push(WORKPIECE_EXPANSION.to_owned());
        }
        all.extend(self.influences.iter().map(|influence| influence.name.clone()));
        all
    }

    /// Bodies that expand at the present temperatures and whose coefficient has no stated uncertainty.
    pub fn coefficients_without_u(&self) -> Vec<String> {
        let mut names = Vec::new();
        for body in &self.bodies {
            let without = body.thermal.iter().filter(|t| t.u.is_empty());
            names.extend(without.map(|t| {
                let error = ErrorName { body: body.name, kind: t.kind, component: t.component };
                format!("{error}({})", t.part.name())
            }));
        }
        if self.growth.as_ref().is_some_and(|g| g.expansion_per_k.u.is_none()) {
            names.push(WORKPIECE_EXPANSION.to_owned());
        }
        names
    }

    /// How well the errors at a command are known; `quantities` are those of
    /// [`Machine::uncertain_quantities`], of this machine at any temperatures of the same sensors.
    pub fn uncertainties_at(&self, command: &Command, quantities: &[String]) -> Uncertainties {
        let mut found = Uncertainties::default();
        let at = |body: usize| self.bodies[body].axis.map_or(0.0, |i| command[i]);
        let stated_errors = self.stated_errors();
        let alone = |index: &ErrorIndex| self.joint.as_ref().is_none_or(|joint| !joint.has(*index));
        for (quantity, (index, _)) in
            stated_errors.iter().enumerate().filter(|(_, (i, _))| alone(i))
        {
            let stated = self.bodies[index.body].stated(index.kind, index.component);
            found.add(quantity, *index, stated.map_or(0.0, |e| e.u_at(at(index.body))));
        }
        if let Some(joint) = &self.joint {
            joint.add_to(&mut found, stated_errors.len(), |index| at(index.body));
        }
        for (body, b) in self.bodies.iter().enumerate() {
            for term in &b.thermal {
                let index = ErrorIndex { body, kind: term.kind, component: term.component };
                for u in &term.u {
                    if let Some(quantity) = quantities.iter().position(|q| *q == u.of) {
                        found.add(quantity, index, u.at(at(body)));
                    }
                }
            }
        }
        let expansion = quantities.iter().position(|q| q == WORKPIECE_EXPANSION);
        if let (Some(growth), Some(quantity)) = (&self.growth, expansion) {
            found.add_workpiece(quantity, growth.u_at(self.nominal_tip_mm(command)));
        }
        let first = quantities.len().saturating_sub(self.influences.len());
        for (i, influence) in self.influences.iter().enumerate() {
            influence.add_to(&mut found, first + i, |index| at(index.body));
        }
        found
    }

    /// The nominal tip in the workpiece frame, mm.
    pub fn nominal_tip_mm(&self, command: &Command) -> Vec3 {
        let mut tip = self.tip_mm;
        let joint = |body: &ChainBody| body.axis.map(|a| (&self.axes[a], command[a]));
        for body in self.bodies[self.workpiece_side..].iter().rev() {
            tip = body.mounting.linear() * tip + body.mounting.shift_mm();
            tip = joint(body).map_or(tip, |(axis, q)| moved_point(axis, q, tip));
            tip = body.placement.linear() * tip + body.placement.shift_mm();
        }
        for body in self.bodies[..self.workpiece_side].iter().rev() {
            tip = body.placement.linear().transpose() * (tip - body.placement.shift_mm());
            // A motion backwards is the motion by minus the command.
            tip = joint(body).map_or(tip, |(axis, q)| moved_point(axis, -q, tip));
            tip = body.mounting.linear().transpose() * (tip - body.mounting.shift_mm());
        }
        tip
    }

    /// The pose of the tool in the workpiece with these errors; all zero gives the nominal pose.
    ///
    /// ```text
    ///     workpiece_from_tool = (bed_from_workpiece)⁻¹ · bed_from_tool       docs/model.md eq. 2
    /// ```
    ///
    /// less what the workpiece has grown at the tip, if it is warm (docs/model.md eq. 86).
    pub fn pose(&self, command: &Command, errors: &ErrorValues) -> Pose<Workpiece, Tool> {
        let (bed_from_workpiece, bed_from_tool) = self.ends(command, errors);
        let grown = Link::shift(-errors.workpiece_mm);
        let felt = bed_from_workpiece.inverse() * bed_from_tool;
        match errors.workpiece_mm == Vec3::zeros() {
            true => felt.relabel(),
            false => (grown * felt).relabel(),
        }
    }

    /// The pose of every body in the machine frame, in chain order.
    pub fn body_poses(&self, command: &Command, errors: &ErrorValues) -> Vec<Pose<Bed, Body>> {
        let mut poses = vec![Pose::identity(); self.bodies.len()];
        let outwards = (0..self.workpiece_side).rev();
        let mut bed_from_body = Link::identity();
        for i in outwards {
            bed_from_body = bed_from_body * self.link(i, command, &errors.bodies[i]);
            poses[i] = bed_from_body.relabel();
        }
        bed_from_body = Link::identity();
        for (i, pose) in poses.iter_mut().enumerate().skip(self.workpiece_side) {
            bed_from_body = bed_from_body * self.link(i, command, &errors.bodies[i]);
            *pose = bed_from_body.relabel();
        }
        poses
    }

    fn ends(&self, command: &Command, errors: &ErrorValues) -> (Link, Link) {
        let product = |acc: Link, i: usize| acc * self.link(i, command, &errors.bodies[i]);
        let from_workpiece = (0..self.workpiece_side).rev().fold(Link::identity(), product);
        let from_tool = (self.workpiece_side..self.bodies.len()).fold(Link::identity(), product);
        (from_workpiece, from_tool)
    }

    /// `parent_from_link`: the steps of the body from the left to the right.
    pub(crate) fn link(&self, i: usize, command: &Command, errors: &BodyErrors) -> Link {
        let body = &self.bodies[i];
        let joint = body.axis.map(|axis| (&self.axes[axis], command[axis]));
        // Most errors of a machine are zero: then there is no product.
        let displaced = |place: Link, six: &SixErrors| match six.is_zero() {
            true => place,
            false => place * self.error_pose(six),
        };
        let place = self.fold_steps(i, body.placement, |place, step| match (step, joint) {
            (Step::Location, _) => displaced(place, &errors.location),
            (Step::Motion, _) => displaced(place, &errors.motion),
            (Step::Joint, Some((axis, q))) => moved_by(place, axis, q),
            (Step::TiltedJoint, Some((axis, q))) => {
                let tilt = self.error_pose(&errors.location);
                let along = tilt.linear() * nominal_motion(axis, q).shift_mm();
                place * Link::shift(errors.location.shift_mm() + along)
            }
            (Step::Joint | Step::TiltedJoint, None) => place,
        });
        place * body.mounting
    }

    /// `shift(EX, EY, EZ) · turn(EA, EB, EC)`.
    fn error_pose(&self, six: &SixErrors) -> Link {
        let linear = Mat3::identity() + six.rotation_minus_identity(self.model.rotation);
        Pose::new(linear, six.shift_mm())
    }
}

/// `place · J(q)`; a linear axis turns nothing.
#[inline]
pub(crate) fn moved_by(place: Link, axis: &Axis, q: f64) -> Link {
    match axis.kind {
        AxisKind::Linear => {
            let along = place.linear() * (axis.direction * (axis.sense * q));
            Pose::new(*place.linear(), place.shift_mm() + along)
        }
        AxisKind::Rotary => place * nominal_motion(axis, q),
    }
}

/// J(q) of one point, without the matrix.
fn moved_point(axis: &Axis, q: f64, point: Vec3) -> Vec3 {
    let (along, by) = (axis.direction, axis.sense * q);
    match axis.kind {
        AxisKind::Linear => point + along * by,
        AxisKind::Rotary => {
            // Rodrigues: p cos φ + (d × p) sin φ + d (d·p)(1 − cos φ)
            let (sin, cos) = by.sin_cos();
            point * cos + along.cross(&point) * sin + along * (along.dot(&point) * (1.0 - cos))
        }
    }
}

/// J(q): the motion of a body at a command, without errors.
pub(crate) fn nominal_motion(axis: &Axis, q: f64) -> Link {
    match axis.kind {
        AxisKind::Linear => Pose::shift(axis.direction * (axis.sense * q)),
        AxisKind::Rotary => Pose::new(rotation(axis.direction, axis.sense * q), Vec3::zeros()),
    }
}
