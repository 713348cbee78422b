//! All bodies of a simulation and the pairs of them that must not meet.

use super::mesh::{Mesh, Nearest, Placed, Scratch};
use super::shape::{cutter_profile, revolve};
use std::f64::consts::FRAC_1_SQRT_2;
use std::sync::Arc;
use trueaxis_geometry::frame::{Bed, Body, Pose};
use trueaxis_geometry::{Mat3, Vec3};
use trueaxis_machine::axis::{Axis, Command, Travel};
use trueaxis_machine::chain::Link;
use trueaxis_machine::errors::ErrorValues;
use trueaxis_machine::models::ToolSegment;
use trueaxis_machine::{Machine, ToolAssembly};

/// The role of a body in the process.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Role {
    /// A part of the machine.
    Machine,
    /// The part of the tool that cuts.
    Cutter,
    /// The rest of the tool: shank and holder.
    Holder,
    /// The stock before cutting: the simulation removes no material.
    Stock,
    /// The fixture that holds it.
    Fixture,
    /// The finished part.
    Part,
}

/// A body with its surface, on a node of the chain.
#[derive(Debug, Clone)]
pub struct BodyModel {
    /// How reports call it.
    pub name: String,
    /// Its node as an index of [`Machine::bodies`]; `None` is the bed.
    pub node: Option<usize>,
    /// Its model coordinate system in that of the node.
    pub placement: Link,
    /// Its role in the process.
    pub role: Role,
    /// Its surface.
    pub mesh: Mesh,
}

/// The tool in the spindle: cylinders from the tip upwards, the first of which cuts.
#[derive(Debug, Clone, PartialEq)]
pub struct ToolShape {
    /// The tip in the frame of the tool, mm.
    pub tip_mm: Vec3,
    /// From the tip upwards.
    pub segments: Vec<ToolSegment>,
    /// Of the first segment, mm; half its diameter for a ball.
    pub corner_radius_mm: f64,
}

impl ToolShape {
    /// No tool in the spindle.
    pub fn none() -> Self {
        Self { tip_mm: Vec3::zeros(), segments: Vec::new(), corner_radius_mm: 0.0 }
    }

    /// The shape that a tool assembly states; without one, a cylinder of its diameter and length.
    ///
    /// `None` if neither shape nor diameter is stated: nothing is known to collide.
    pub fn of(tool: &ToolAssembly) -> Option<Self> {
        let mut segments = tool.shape.clone();
        if segments.is_empty() {
            let (diameter_mm, length_mm) = (tool.diameter_mm?, tool.length_mm);
            if length_mm <= 0.0 {
                return None;
            }
            segments.push(ToolSegment { diameter_mm, length_mm });
        }
        let tip_mm = Vec3::new(0.0, 0.0, -tool.length_mm);
        Some(Self { tip_mm, segments, corner_radius_mm: tool.corner_radius_mm.unwrap_or(0.0) })
    }

    /// From the tip to the end of the last segment, mm.
    pub fn length_mm(&self) -> f64 {
        self.segments.iter().map(|s| s.length_mm).sum()
    }

    fn models(&self, node: usize) -> Vec<BodyModel> {
        let mut height = 0.0;
        let mut holder = Vec::new();
        let mut models = Vec::new();
        for (i, segment) in self.segments.iter().enumerate() {
            let (radius, length) = (0.5 * segment.diameter_mm, segment.length_mm);
            if i == 0 {
                let profile = cutter_profile(radius, self.corner_radius_mm, length);
                models.extend(self.model("cutter", Role::Cutter, &profile, node));
            } else {
                holder.extend([[radius, height], [radius, height + length]]);
            }
            height += length;
        }
        models.extend(self.model("holder", Role::Holder, &holder, node));
        models
    }

    fn model(
        &self,
        name: &str,
        role: Role,
        profile: &[[f64; 2]],
        node: usize,
    ) -> Option<BodyModel> {
        let mesh = Mesh::new(revolve(profile))?;
        let placement = Link::shift(self.tip_mm);
        Some(BodyModel { name: name.to_owned(), node: Some(node), placement, role, mesh })
    }
}

/// What is not an issue at this moment.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Allowed {
    /// The tool is feeding: its cutter may touch stock and part. In rapid it may not.
    pub cutter_in_stock: bool,
    /// The stock is cut, and what the tool does in it is asked of [`Machining`](crate::Machining).
    pub tool_in_stock: bool,
}

/// Two bodies that are closer than requested.
#[derive(Debug, Clone, PartialEq)]
pub struct Contact {
    /// The one body.
    pub first: Arc<str>,
    /// The other body.
    pub second: Arc<str>,
    /// Their roles in the process.
    pub roles: (Role, Role),
    /// How far they are apart, mm; 0 if they overlap.
    pub clearance_mm: f64,
    /// Where: the middle between the nearest points, in the machine frame, mm.
    pub point_mm: Vec3,
    /// When: 0 at the beginning of a sweep, 1 at its end; 0 in a check. Unit: 1.
    pub at: f64,
}

/// A pair that is not checked because it overlaps when all axes are at zero.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Excluded {
    /// The one body.
    pub first: Arc<str>,
    /// The other body.
    pub second: Arc<str>,
}

pub(super) struct Member {
    pub(super) name: Arc<str>,
    pub(super) role: Role,
    pub(super) node: Option<usize>,
    placement: Link,
    pub(super) mesh: Mesh,
    /// Where it is now: `bed_from_model`.
    pub(super) now: Placed,
    /// How far its points have moved in all, at most, mm.
    travelled_mm: f64,
}

pub(super) struct Pair {
    pub(super) first: usize,
    pub(super) second: usize,
    /// Where the second stood in the first when their distance was asked for the last time.
    reference: Placed,
    /// No less were they apart then, mm.
    pub(super) far_mm: f64,
    /// No less were they apart when both had travelled so far, mm.
    free_mm: f64,
    travelled_mm: f64,
    seed: Option<(u32, u32)>,
    /// By how much the next query searches beyond the request, mm.
    margin_mm: f64,
}

/// The distance of a pair, as far as it was asked for.
pub(super) enum Distance {
    /// No less than this, mm.
    AtLeast(f64),
    /// Exactly.
    Exactly(Nearest),
}

/// The bodies of a simulation, where they are, and what is known about their distances.
///
/// Left out are pairs that touch by construction: bodies on the same node, on neighbouring nodes
/// (the bed is the neighbour of the first on each side), and pairs on one side of the bed that
/// overlap when all axes are at zero ([`Scene::excluded`] lists them). Bodies on different
/// sides are never left out, nor is the tool against the bed.
pub struct Scene {
    pub(super) members: Vec<Member>,
    pub(super) pairs: Vec<Pair>,
    excluded: Vec<Excluded>,
    /// Where the bodies of the chain are now.
    pub(super) nodes_now: Vec<Pose<Bed, Body>>,
    pub(super) axes: Vec<Axis>,
    /// Axis of each body of the chain.
    pub(super) axis_of: Vec<Option<usize>>,
    pub(super) workpiece_side: usize,
    scratch: Scratch,
    questions: usize,
    /// Pairs of boxes that were compared, and poses that were asked for, each as [`WORK_OF_POSES`] of them.
    pub(super) work: u64,
    /// A sweep that has come so far ends.
    pub(super) most_work: u64,
}

/// The poses of all bodies at a command cost as much as so many pairs of boxes.
pub(super) const WORK_OF_POSES: u64 = 20;

impl Scene {
    /// A scene of a machine, a tool, and what is mounted on the workpiece node.
    pub fn new(
        machine: &Machine,
        models: Vec<BodyModel>,
        tool: &ToolShape,
        attached: Vec<BodyModel>,
    ) -> Self {
        let tool_node = machine.bodies().len() - 1;
        let all = models.into_iter().chain(tool.models(tool_node)).chain(attached);
        let still = Placed { turn: Mat3::identity(), shift_mm: Vec3::zeros() };
        let members: Vec<Member> = all
            .map(|m| Member {
                name: m.name.into(),
                role: m.role,
                node: m.node.filter(|i| *i <= tool_node),
                placement: m.placement,
                mesh: m.mesh,
                now: still,
                travelled_mm: 0.0,
            })
            .collect();
        let mut scene = Self {
            members,
            pairs: Vec::new(),
            excluded: Vec::new(),
            nodes_now: Vec::new(),
            axes: machine.axes().to_vec(),
            axis_of: machine.bodies().iter().map(|b| b.axis).collect(),
            workpiece_side: machine.workpiece_side(),
            scratch: Scratch::default(),
            questions: 0,
            work: 0,
            most_work: u64::MAX,
        };
        scene.make_pairs();
        scene.exclude_overlaps(machine);
        scene
    }

    /// The names of all bodies.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.members.iter().map(|m| &*m.name)
    }

    /// How many pairs are watched.
    pub fn pair_count(&self) -> usize {
        self.pairs.len()
    }

    /// How many times triangles had to be checked so far.
    pub fn questions(&self) -> usize {
        self.questions
    }

    /// Pairs of boxes that were compared so far, with what the poses between them cost: a measure of the time that does
    /// not depend on the computer.
    pub fn work(&self) -> u64 {
        self.work
    }

    /// A sweep ends when [`Scene::work`] has reached this much; without it only the path limits it.
    pub fn limit_work(&mut self, most: u64) {
        self.most_work = most;
    }

    /// The pairs that are not watched because they overlap when all axes are at zero.
    pub fn excluded(&self) -> &[Excluded] {
        &self.excluded
    }

    /// Steps from the bed: 0 for the bed itself; and the side, −1 workpiece, +1 tool, 0 bed.
    pub(super) fn level(&self, member: usize) -> (usize, i32) {
        match self.members[member].node {
            None => (0, 0),
            Some(i) if i < self.workpiece_side => (self.workpiece_side - i, -1),
            Some(i) => (i + 1 - self.workpiece_side, 1),
        }
    }

    fn make_pairs(&mut self) {
        for second in 0..self.members.len() {
            for first in 0..second {
                let [a, b] = [first, second].map(|m| self.level(m));
                let same_side = a.1 * b.1 >= 0;
                let steps = if same_side { a.0.abs_diff(b.0) } else { a.0 + b.0 };
                if steps > 1 {
                    self.pairs.push(Pair::new(first, second));
                }
            }
        }
    }

    fn exclude_overlaps(&mut self, machine: &Machine) {
        let zero = position_zero(machine.axes());
        self.place(&machine.body_poses(&zero, &ErrorValues::default()));
        let mut kept = Vec::new();
        for mut pair in std::mem::take(&mut self.pairs) {
            let (a, b) = (self.level(pair.first), self.level(pair.second));
            let tool_or_part = |m: usize| self.members[m].role != Role::Machine;
            let by_construction = match a.1 * b.1 {
                1 => true,
                // The bed carries both sides, but not the tool and not the workpiece.
                0 => !tool_or_part(pair.first) && !tool_or_part(pair.second),
                _ => false,
            };
            let placed = self.relative(&pair);
            let overlap = matches!(
                self.ask(&mut pair, &placed, 0.0),
                Distance::Exactly(n) if n.distance_mm == 0.0
            );
            if by_construction && overlap {
                let [first, second] =
                    [pair.first, pair.second].map(|m| self.members[m].name.clone());
                self.excluded.push(Excluded { first, second });
            } else {
                kept.push(pair);
            }
        }
        self.pairs = kept;
    }

    /// Moves every body to where it is at these poses of [`Machine::body_poses`].
    pub(super) fn place(&mut self, poses: &[Pose<Bed, Body>]) {
        self.nodes_now.clear();
        self.nodes_now.extend_from_slice(poses);
        self.members.iter_mut().for_each(|member| member.place(poses));
    }

    pub(super) fn relative(&self, pair: &Pair) -> Placed {
        relative(&self.members[pair.first].now, &self.members[pair.second].now)
    }

    /// Finds every pair that is nearer than `clearance_mm` (or overlaps) at these poses of
    /// [`Machine::body_poses`], nominal or actual. Poses that are not numbers give no result.
    ///
    /// Results of the previous poses avoid most queries: bodies that were 50 mm apart and
    /// have moved by 10 mm since are still 40 mm apart.
    pub fn check(
        &mut self,
        poses: &[Pose<Bed, Body>],
        clearance_mm: f64,
        allowed: Allowed,
        contacts: &mut Vec<Contact>,
    ) {
        self.place(poses);
        let mut pairs = std::mem::take(&mut self.pairs);
        for pair in &mut pairs {
            if self.is_allowed(pair, allowed) || self.free_mm(pair) > clearance_mm {
                continue;
            }
            let placed = self.relative(pair);
            let known = self.known_mm(pair, &placed);
            if known > clearance_mm {
                self.remember(pair, known);
                continue;
            }
            let distance = self.ask(pair, &placed, clearance_mm);
            self.remember(pair, pair.far_mm);
            if let Distance::Exactly(near) = distance
                && near.distance_mm <= clearance_mm
            {
                contacts.push(self.contact(pair, &near, &self.members[pair.first].now, 0.0));
            }
        }
        self.pairs = pairs;
    }

    pub(super) fn is_allowed(&self, pair: &Pair, allowed: Allowed) -> bool {
        let roles = [pair.first, pair.second].map(|m| self.members[m].role);
        let cut = roles.contains(&Role::Stock) || roles.contains(&Role::Part);
        let cutter = allowed.cutter_in_stock || allowed.tool_in_stock;
        let holder = allowed.tool_in_stock;
        cut && (cutter && roles.contains(&Role::Cutter) || holder && roles.contains(&Role::Holder))
    }

    /// How far the pair is still apart, at least, whatever path it took since.
    pub(super) fn free_mm(&self, pair: &Pair) -> f64 {
        pair.free_mm - (self.travelled_mm(pair) - pair.travelled_mm)
    }

    fn travelled_mm(&self, pair: &Pair) -> f64 {
        self.members[pair.first].travelled_mm + self.members[pair.second].travelled_mm
    }

    pub(super) fn remember(&self, pair: &mut Pair, free_mm: f64) {
        pair.free_mm = free_mm;
        pair.travelled_mm = self.travelled_mm(pair);
    }

    /// How far the pair is still apart, at least, from where it is now: no point of one has
    /// moved further in the frame of the other since the last question.
    pub(super) fn known_mm(&self, pair: &Pair, placed: &Placed) -> f64 {
        let [first, second] = [pair.first, pair.second].map(|m| &self.members[m].mesh);
        let of_second = motion_mm(second, &pair.reference, placed);
        let of_first = motion_mm(first, &pair.reference.inverse(), &placed.inverse());
        pair.far_mm - of_second.min(of_first)
    }

    /// Asks for the distance of a pair; exact if it is not above `clearance_mm`.
    pub(super) fn ask(&mut self, pair: &mut Pair, placed: &Placed, clearance_mm: f64) -> Distance {
        let [first, second] = [pair.first, pair.second].map(|m| &self.members[m].mesh);
        let numbers = placed.turn.iter().chain(&placed.shift_mm);
        if numbers.into_iter().any(|v| !v.is_finite()) {
            return Distance::AtLeast(0.0);
        }
        pair.reference = *placed;
        let centres = placed.turn * second.centre_mm() + placed.shift_mm - first.centre_mm();
        let spheres = centres.norm() - first.radius_mm() - second.radius_mm();
        let boxes = first.box_distance_mm(second, placed).max(spheres);
        let below = clearance_mm + pair.margin_mm;
        if boxes >= below {
            pair.far_mm = boxes;
            return Distance::AtLeast(boxes);
        }
        self.questions += 1;
        let mut found = first.nearest(second, placed, below, pair.seed, &mut self.scratch);
        self.work += self.scratch.visits as u64;
        let easy = self.scratch.visits < 256;
        pair.margin_mm = (pair.margin_mm * if easy { 2.0 } else { 0.5 }).clamp(1.0, 2000.0);
        pair.seed = found.map(|n| n.triangles).or(pair.seed);
        if boxes <= 0.0 && found.is_none_or(|n| n.distance_mm > 0.0) {
            let inner = first.swallows(second, placed);
            let back = placed.inverse();
            let outer = || Some(placed.turn * second.swallows(first, &back)? + placed.shift_mm);
            if let Some(point) = inner.or_else(outer) {
                let triangles = pair.seed.unwrap_or((0, 0));
                found = Some(Nearest {
                    distance_mm: 0.0,
                    on_first: point,
                    on_second: point,
                    triangles,
                });
            }
        }
        pair.far_mm = found.map_or(below, |n| n.distance_mm);
        found.map_or(Distance::AtLeast(below), Distance::Exactly)
    }

    pub(super) fn contact(
        &self,
        pair: &Pair,
        near: &Nearest,
        bed_from_first: &Placed,
        at: f64,
    ) -> Contact {
        let [first, second] = [pair.first, pair.second].map(|m| &self.members[m]);
        let middle = 0.5 * (near.on_first + near.on_second);
        Contact {
            first: first.name.clone(),
            second: second.name.clone(),
            roles: (first.role, second.role),
            clearance_mm: near.distance_mm,
            point_mm: bed_from_first.turn * middle + bed_from_first.shift_mm,
            at,
        }
    }
}

impl Member {
    /// Moves it to where it is at these poses.
    pub(super) fn place(&mut self, poses: &[Pose<Bed, Body>]) {
        let now = self.at(poses);
        self.travelled_mm += motion_mm(&self.mesh, &self.now, &now);
        self.now = now;
    }

    /// `bed_from_model`, as a rigid motion.
    pub(super) fn at(&self, poses: &[Pose<Bed, Body>]) -> Placed {
        let node = self.node.and_then(|i| poses.get(i));
        let pose = node.map_or(self.placement, |p| p.relabel() * self.placement);
        Placed { turn: orthonormal(pose.linear()), shift_mm: *pose.shift_mm() }
    }
}

impl Pair {
    fn new(first: usize, second: usize) -> Self {
        let reference = Placed { turn: Mat3::identity(), shift_mm: Vec3::zeros() };
        Self {
            first,
            second,
            reference,
            far_mm: 0.0,
            free_mm: 0.0,
            travelled_mm: 0.0,
            seed: None,
            margin_mm: 10.0,
        }
    }
}

/// All axes at zero, or as near to it as they can go.
fn position_zero(axes: &[Axis]) -> Command {
    let mut command = Command::default();
    for (q, axis) in command.iter_mut().zip(axes) {
        if let Travel::Between(from, to) = axis.travel {
            *q = 0.0_f64.clamp(from, to);
        }
    }
    command
}

pub(super) fn relative(bed_from_first: &Placed, bed_from_second: &Placed) -> Placed {
    let back = bed_from_first.turn.transpose();
    Placed {
        turn: back * bed_from_second.turn,
        shift_mm: back * (bed_from_second.shift_mm - bed_from_first.shift_mm),
    }
}

/// No point of the mesh moves further between two places:
///
/// ```text
///     |(R₁ − R₀) p + t₁ − t₀| ≤ |(R₁ − R₀) c + t₁ − t₀| + ‖R₁ − R₀‖₂ r,   ‖R₁ − R₀‖₂ = ‖R₁ − R₀‖_F / √2
/// ```
///
/// with the centre c and radius r of a ball around it. The norms: R₁ − R₀ of two rotations has the
/// singular values 2 sin(φ/2), 2 sin(φ/2), 0.
pub(super) fn motion_mm(mesh: &Mesh, from: &Placed, to: &Placed) -> f64 {
    let turn = to.turn - from.turn;
    let centre = turn * mesh.centre_mm() + to.shift_mm - from.shift_mm;
    centre.norm() + turn.norm() * FRAC_1_SQRT_2 * mesh.radius_mm()
}

/// The rotation that small-angle errors mean: bodies stay rigid.
fn orthonormal(m: &Mat3) -> Mat3 {
    let x: Vec3 = m.column(0).normalize();
    let z = x.cross(&m.column(1)).normalize();
    Mat3::from_columns(&[x, z.cross(&x), z])
}
