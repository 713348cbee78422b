//! Watches all bodies along the path: collisions, near misses, rapid moves through stock.

use super::collide::{Allowed, BodyModel, Contact, Role, Scene, Sweep, ToolShape};
use super::issues::{IssueKind, Log};
use super::setup::{Nearness, SetUp};
use super::{Batch, Node, Observer, Stamp};
use std::collections::BTreeMap;
use trueaxis_machine::Machine;
use trueaxis_machine::axis::Command;
use trueaxis_machine::errors::ErrorValues;

/// Watches the bodies of machine, tool, stock and fixtures, each path between two nodes as a whole.
///
/// The bodies move as those of the nominal machine: errors are far below any clearance.
pub struct Collisions {
    machine: Machine,
    models: Vec<BodyModel>,
    attached: Vec<BodyModel>,
    /// Shape and tip of each tool that is known.
    tools: BTreeMap<u32, ToolShape>,
    nearness: Nearness,
    scene: Scene,
    tool: u32,
    before: Option<(Command, f64)>,
    contacts: Vec<Contact>,
    /// The issues that were found.
    pub log: Log,
}

impl Collisions {
    /// Empty; `models` are those of the machine.
    ///
    /// `None` if fewer than two bodies are known: nothing can collide.
    pub fn watch(machine: &Machine, models: Vec<BodyModel>, setup: &SetUp) -> Option<Self> {
        let machine = setup.mounted(machine);
        let tools: BTreeMap<u32, ToolShape> =
            setup.tools.iter().filter_map(|(n, t)| Some((*n, t.tool_shape()?))).collect();
        if models.len() + setup.bodies.len() + usize::from(!tools.is_empty()) < 2 {
            return None;
        }
        let scene = Scene::new(&machine, models.clone(), &ToolShape::none(), setup.bodies.clone());
        Some(Self {
            machine,
            models,
            attached: setup.bodies.clone(),
            tools,
            nearness: setup.nearness,
            scene,
            tool: 0,
            before: None,
            contacts: Vec::new(),
            log: Log::default(),
        })
    }

    /// The pairs that are not watched because they overlap when all axes are at zero.
    pub fn left_out(&self) -> impl Iterator<Item = (&str, &str)> {
        self.scene.excluded().iter().map(|pair| (&*pair.first, &*pair.second))
    }

    fn change_tool(&mut self, number: u32) {
        self.tool = number;
        let shape = self.tools.get(&number).cloned().unwrap_or_else(ToolShape::none);
        let (models, attached) = (self.models.clone(), self.attached.clone());
        self.scene = Scene::new(&self.machine, models, &shape, attached);
    }

    fn see(&mut self, node: &Node, stamp: &Stamp) {
        let (from, from_s) = self.before.unwrap_or((node.command, stamp.time_s));
        let machine = &self.machine;
        let sweep = Sweep {
            from: &from,
            to: &node.command,
            clearance_mm: self.nearness.clearance_mm,
            resolution_mm: self.nearness.resolution_mm,
            allowed: Allowed { cutter_in_stock: !node.is_rapid() },
        };
        let poses = |command: &Command| machine.body_poses(command, &ErrorValues::default());
        self.contacts.clear();
        self.scene.sweep(&poses, &sweep, &mut self.contacts);
        for contact in &self.contacts {
            let time_s = from_s + contact.at * (stamp.time_s - from_s);
            let Some(kind) = kind(contact) else { continue };
            let limit = match kind {
                IssueKind::NearMiss { .. } => self.nearness.clearance_mm,
                _ => 0.0,
            };
            let stamp = Stamp { time_s, ..*stamp };
            self.log.note(kind, node, &stamp, contact.clearance_mm, limit);
        }
        self.log.close(from_s);
        self.before = Some((node.command, stamp.time_s));
    }
}

/// The kind of issue of a contact; `None` if it belongs to the process.
fn kind(contact: &Contact) -> Option<IssueKind> {
    let (first, second) = (contact.first.to_string(), contact.second.to_string());
    let overlap = contact.clearance_mm <= 0.0;
    let cuts = |a: Role, b: Role| a == Role::Cutter && matches!(b, Role::Stock | Role::Part);
    let (a, b) = contact.roles;
    if cuts(a, b) || cuts(b, a) {
        return overlap.then_some(IssueKind::RapidInStock { first, second });
    }
    Some(match overlap {
        true => IssueKind::Collision { first, second },
        false => IssueKind::NearMiss { first, second },
    })
}

impl Observer for Collisions {
    fn path(&mut self, batch: &Batch<'_>) {
        if batch.tool != self.tool {
            self.change_tool(batch.tool);
        }
        for (node, stamp) in batch.nodes.iter().zip(batch.stamps) {
            self.see(node, stamp);
        }
    }
}
