//! Watches all bodies along the path: collisions, near misses, rapid moves through stock.

use super::collide::{Allowed, BodyModel, Contact, Role, Room, Scene, Sweep, ToolShape};
use super::issues::{IssueKind, Log};
use super::setup::{Nearness, SetUp};
use super::{Batch, Node, Observer, Stamp};
use std::collections::BTreeMap;
use trueaxis_input::{Diagnostics, Place};
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{AxisKind, Command};
use trueaxis_machine::errors::ErrorValues;
use trueaxis_nc::moves::Origin;

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
    stock_is_cut: bool,
    scene: Scene,
    tool: u32,
    before: Option<(Command, f64)>,
    /// What was free around the last place that was checked.
    room: Option<Room>,
    contacts: Vec<Contact>,
    /// How much work the check was so far, and how much it may be.
    work: u64,
    most_work: u64,
    /// The block at which the check ended because it was too much work.
    ended_at: Option<Origin>,
    /// The issues that were found.
    pub log: Log,
}

/// Work of a check, in pairs of boxes (about 0.1 µs each): a basis, and what each move within the travels adds, and each
/// mm or milliradian of it. A path that leads out of the travels is absurd or wrong, and adds nothing.
const WORK: u64 = 20_000_000;
const WORK_OF_MOVE: u64 = 10_000;
const WORK_OF_STEP: f64 = 2_000.0;

/// An axis without a stated travel counts as no longer than this, mm or mrad.
const LONGEST_STEP: f64 = 2_000.0;

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
            stock_is_cut: false,
            scene,
            tool: 0,
            before: None,
            room: None,
            contacts: Vec::new(),
            work: 0,
            most_work: WORK,
            ended_at: None,
            log: Log::default(),
        })
    }

    /// The same where the stock is cut: what the tool does in it is asked of [`Machining`](super::Machining). The bodies of the machine
    /// are still watched against the stock as it was before.
    #[must_use]
    pub fn beside_cut_stock(self) -> Self {
        Self { stock_is_cut: true, ..self }
    }

    /// The error that a part of the path was not checked, if that is so. The check is too much work where a body is
    /// absurdly long: the time of a sweep grows with the way of its outermost point. `programs` are those of the
    /// [`Run`](super::Run).
    pub fn problems(&self, programs: &[String]) -> Diagnostics {
        let mut problems = Diagnostics::new();
        let Some(Origin { program, line }) = self.ended_at else { return problems };
        let file = programs.get(program as usize).cloned().unwrap_or_default();
        let reach_mm = self.tools.values().map(ToolShape::length_mm).fold(0.0, f64::max);
        let message = format!(
            "from this line on collisions were not checked: the bodies pass through too many places for it; the \
             longest tool has {} mm",
            reach_mm.round()
        );
        let hint = "check the units of tool lengths and offsets; a larger `resolution` in [collision] of the set-up makes \
                    the check coarser, --no-collisions leaves it out";
        let place = Place { file, line: line as usize, column: 1 };
        problems.error("collisions-not-checked", place, message, hint);
        problems
    }

    /// The pairs that are not watched because they overlap when all axes are at zero.
    pub fn left_out(&self) -> impl Iterator<Item = (&str, &str)> {
        self.scene.excluded().iter().map(|pair| (&*pair.first, &*pair.second))
    }

    /// Pairs of boxes that were compared so far, and how many it may be: a measure of the time that does not depend on
    /// the computer.
    pub fn work(&self) -> [u64; 2] {
        [self.work, self.most_work]
    }

    /// How much the check of a move may be.
    fn work_of_move(&self, from: &Command, to: &Command) -> u64 {
        let axes = self.machine.axes();
        if axes
            .iter()
            .enumerate()
            .any(|(i, a)| !a.travel.contains(from[i]) || !a.travel.contains(to[i]))
        {
            return 0;
        }
        let steps = axes.iter().enumerate().map(|(i, axis)| {
            let way = (to[i] - from[i]).abs();
            if axis.kind == AxisKind::Rotary { 1e3 * way } else { way }
        });
        WORK_OF_MOVE + (WORK_OF_STEP * steps.sum::<f64>().min(LONGEST_STEP)) as u64
    }

    fn change_tool(&mut self, number: u32) {
        (self.tool, self.room) = (number, None);
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
            allowed: Allowed {
                cutter_in_stock: !node.is_rapid(),
                tool_in_stock: self.stock_is_cut,
            },
        };
        let poses = |command: &Command| machine.body_poses(command, &ErrorValues::default());
        self.contacts.clear();
        self.most_work += self.work_of_move(&from, &node.command);
        let holds = |room: &Room| room.holds(&node.command, sweep.allowed);
        let before = self.scene.work();
        self.scene.limit_work(before + self.most_work.saturating_sub(self.work));
        let mut renewed = |room: &mut Room| self.scene.renew(room, &poses, &sweep);
        let is_free = self.room.as_mut().is_some_and(|room| holds(room) || renewed(room));
        let is_whole = is_free || self.scene.sweep(&poses, &sweep, &mut self.contacts);
        self.work += self.scene.work() - before;
        if is_free {
            self.log.close(from_s);
            self.before = Some((node.command, stamp.time_s));
            return;
        }
        if !is_whole {
            self.ended_at = Some(node.origin);
        }
        self.room = self.contacts.is_empty().then(|| self.scene.room(&sweep)).filter(holds);
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
            if self.ended_at.is_none() {
                self.see(node, stamp);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Job, Options, ProgramFiles, simulate};
    use std::path::Path;
    use trueaxis_input::{Files, Source};
    use trueaxis_machine::file::NoTables;

    const MACHINE: &str = include_str!("../../../machines/wyxzcat-gantry/machine.toml");
    const PROGRAM: &[u8] = include_bytes!("../../../examples/02_simulate/impeller-840d.mpf");
    const SETUP: &str = include_str!("../../../examples/02_simulate/impeller-840d.setup.toml");

    /// The one file that a test needs.
    struct SetUpFile(String);

    impl Source for SetUpFile {
        fn read(&self, _: &Path) -> std::io::Result<Vec<u8>> {
            Ok(self.0.clone().into_bytes())
        }

        fn is_file(&self, path: &Path) -> bool {
            path == Path::new("part.setup.toml")
        }
    }

    /// The check of the impeller on the gantry whose tool has another length, with the names of its programs.
    fn impeller(length: &str) -> (Collisions, Vec<String>) {
        assert!(SETUP.contains("length = \"160 mm\""));
        // What would be refused before is accepted here.
        let accepted = "\n[plausible]\ntool_length_mm = 200_000\n";
        let setup = SETUP.replace("length = \"160 mm\"", &format!("length = \"{length}\""));
        let setup = setup + accepted;
        let files = Files::new(SetUpFile(setup));
        let named = ProgramFiles {
            files: &files,
            program: "part.mpf".as_ref(),
            text: Some(PROGRAM),
            setup: Some("part.setup.toml".as_ref()),
            control: None,
        };
        let mut problems = Diagnostics::new();
        let machine = Machine::check("m.toml", MACHINE, &NoTables).0.unwrap();
        let job = Job::read(machine, &named, Options::default(), &mut problems).unwrap();
        let job = job.with_models("m.toml".as_ref(), &mut problems);
        assert!(!problems.has_errors(), "{problems:?}");
        let mut watch = job.collisions().unwrap();
        let run = simulate(&job.machine, &job.program, &job.setup, &job.options, &mut [&mut watch]);
        (watch, run.programs)
    }

    /// "160 m" by a slip of the unit: the check took minutes, as its steps follow the end of the tool.
    #[test]
    fn the_check_of_an_absurdly_long_tool_ends_and_says_so() {
        let (usual, programs) = impeller("160 mm");
        let [work, most] = usual.work();
        assert!(usual.problems(&programs).iter().next().is_none());
        assert!(work > 1_000 && 100 * work < most, "{work} of {most}");
        let (long, programs) = impeller("160 m");
        let [work, most] = long.work();
        let problems = long.problems(&programs);
        let found = problems.iter().next().expect("it says so");
        assert_eq!((found.code, &*found.place.file), ("collisions-not-checked", "part.mpf"));
        assert!(found.place.line > 1 && found.message.contains("160000 mm"), "{found}");
        // The last question goes a little beyond; nothing is added outside the travels.
        assert!(most < 2 * WORK && work < most + most / 10, "{work} of {most}");
    }
}
