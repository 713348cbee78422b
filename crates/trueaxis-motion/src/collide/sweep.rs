//! Contacts between two commands: none that matters is skipped.
//!
//! Conservative advancement: two bodies that are d apart cannot be closer than the watched
//! clearance before they have moved by the difference. How far they can move follows from the path
//! of each axis: a linear axis moves all that it carries by |Δq|, a rotary one by at most |Δq|
//! times the reach of the body from its axis.

use super::room::between;
use super::scene::{Allowed, Contact, Distance, Pair, Scene, WORK_OF_POSES, relative};
use trueaxis_geometry::frame::{Bed, Body, Pose};
use trueaxis_machine::axis::Command;

/// Most questions for one pair in one sweep; beyond, the steps grow longer than the resolution.
const MOST_STEPS: f64 = 1e5;
/// How exactly the begin of an overlap is found, mm of the way.
const BEGIN_MM: f64 = 1e-9;

/// A straight path in axis space, and what to look for along it.
#[derive(Debug, Clone, Copy)]
pub struct Sweep<'a> {
    /// Where it begins.
    pub from: &'a Command,
    /// Where it ends; each axis goes there at a rate of its own, all in proportion.
    pub to: &'a Command,
    /// Bodies closer than this are reported, mm; at least half the resolution.
    pub clearance_mm: f64,
    /// See [`Scene::sweep`], mm.
    pub resolution_mm: f64,
    /// What is not an issue on the path.
    pub allowed: Allowed,
}

impl Sweep<'_> {
    /// Bodies closer than this are watched: no wall is passed between two questions.
    pub(super) fn watch_mm(&self) -> f64 {
        self.clearance_mm.max(0.5 * self.resolution_mm)
    }

    /// How far each axis goes.
    pub(super) fn way(&self) -> Command {
        std::array::from_fn(|axis| (self.to[axis] - self.from[axis]).abs())
    }

    fn command(&self, t: f64) -> Command {
        let mut command = *self.from;
        for (q, to) in command.iter_mut().zip(self.to) {
            *q += t * (to - *q);
        }
        command
    }
}

impl Scene {
    /// Finds every pair that comes closer than the clearance anywhere between two commands, at the
    /// moment when it is nearest (or when it begins to overlap).
    ///
    /// `poses_at` gives the poses of all bodies at a command, such as
    /// `|c| machine.body_poses(c, &ErrorValues::default())`, or with the errors there.
    ///
    /// Guarantee: a pair that comes closer than `max(clearance, resolution/2) − resolution/2` is
    /// reported, and the stated clearance is at most half a resolution above the least. So with a
    /// clearance of half the resolution or more no wall, however thin, is passed unnoticed. It
    /// holds for paths up to 10⁵ resolutions, and for axes that move straight in axis space: where
    /// the path between the two commands is curved, its deviation from the straight path adds to it.
    ///
    /// The number of steps grows with the length of the path of a body's outermost point: a tool of 160 m that turns by
    /// 3° goes through 8 m, 16,000 resolutions, for each pair of bodies that it passes. `false` if the work came to the
    /// limit of [`Scene::limit_work`]: then contacts may be missing, and nothing is guaranteed.
    pub fn sweep(
        &mut self,
        poses_at: &dyn Fn(&Command) -> Vec<Pose<Bed, Body>>,
        sweep: &Sweep<'_>,
        contacts: &mut Vec<Contact>,
    ) -> bool {
        self.place(&poses_at(sweep.from));
        let way = sweep.way();
        let reaches = self.reaches(&way);
        let watch = sweep.watch_mm();
        let mut pairs = std::mem::take(&mut self.pairs);
        for pair in &mut pairs {
            let reach = between(&reaches[pair.first], &reaches[pair.second]);
            let distance: f64 = way.iter().zip(reach).map(|(way, reach)| way * reach).sum();
            if self.is_allowed(pair, sweep.allowed) || self.free_mm(pair) - distance > watch {
                continue;
            }
            contacts.extend(self.advance(pair, distance, watch, poses_at, sweep));
        }
        self.pairs = pairs;
        self.work < self.most_work
    }

    fn advance(
        &mut self,
        pair: &mut Pair,
        way_mm: f64,
        watch_mm: f64,
        poses_at: &dyn Fn(&Command) -> Vec<Pose<Bed, Body>>,
        sweep: &Sweep<'_>,
    ) -> Option<Contact> {
        let least_mm = sweep.resolution_mm.max(way_mm / MOST_STEPS);
        let [mut first, mut second] = [pair.first, pair.second].map(|m| self.members[m].now);
        let mut nearest: Option<Contact> = None;
        let (mut t, mut before) = (0.0, 0.0);
        let mut free_mm = f64::NEG_INFINITY;
        loop {
            let placed = relative(&first, &second);
            let known = self.known_mm(pair, &placed);
            if t == 0.0 {
                free_mm = known;
            }
            let rest_mm = way_mm * (1.0 - t);
            if known - rest_mm > watch_mm {
                break;
            }
            let apart_mm = match self.ask(pair, &placed, watch_mm) {
                Distance::AtLeast(apart_mm) => apart_mm,
                Distance::Exactly(near) => {
                    let better = nearest.as_ref().is_none_or(|c| near.distance_mm < c.clearance_mm);
                    if near.distance_mm <= watch_mm && better {
                        nearest = Some(self.contact(pair, &near, &first, t));
                    }
                    near.distance_mm
                }
            };
            if t == 0.0 {
                free_mm = apart_mm;
            }
            let is_spent = self.work >= self.most_work;
            if apart_mm == 0.0 {
                // Where it begins does not depend on the steps that led here.
                if let Some(begin) = self.begin(pair, [before, t], way_mm, poses_at, sweep) {
                    nearest = Some(begin);
                }
                break;
            }
            if t >= 1.0 || way_mm <= 0.0 || is_spent {
                break;
            }
            self.work += WORK_OF_POSES;
            before = t;
            t = (t + (apart_mm - watch_mm).max(least_mm) / way_mm).min(1.0);
            let poses = poses_at(&sweep.command(t));
            [first, second] = [pair.first, pair.second].map(|m| self.members[m].at(&poses));
        }
        // Bodies count as standing at the beginning of the path.
        self.remember(pair, free_mm);
        nearest
    }

    /// Where an overlap begins between a moment without it and one with it; `None` if they are one.
    fn begin(
        &mut self,
        pair: &mut Pair,
        [mut apart, mut over]: [f64; 2],
        way_mm: f64,
        poses_at: &dyn Fn(&Command) -> Vec<Pose<Bed, Body>>,
        sweep: &Sweep<'_>,
    ) -> Option<Contact> {
        let mut found = None;
        while (over - apart) * way_mm > BEGIN_MM && self.work < self.most_work {
            let t = 0.5 * (apart + over);
            if t <= apart || t >= over {
                break;
            }
            self.work += WORK_OF_POSES;
            let poses = poses_at(&sweep.command(t));
            let [first, second] = [pair.first, pair.second].map(|m| self.members[m].at(&poses));
            match self.ask(pair, &relative(&first, &second), 0.0) {
                Distance::Exactly(near) if near.distance_mm == 0.0 => {
                    over = t;
                    found = Some(self.contact(pair, &near, &first, t));
                }
                _ => apart = t,
            }
        }
        found
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::collide::mesh::{Mesh, Placed};
    use crate::collide::scene::{BodyModel, Role, ToolShape};
    use crate::collide::shape::cuboid;
    use trueaxis_geometry::{Mat3, Vec3};
    use trueaxis_machine::Machine;
    use trueaxis_machine::errors::ErrorValues;
    use trueaxis_machine::file::NoTables;

    const TEXT: &str = "[machine]\nname = \"m\"\nchain = \"w C' A' b X Y Z B t\"\n\
                        [axis.A]\nplacement = \"50 20 -30 mm\"\n[axis.B]\nplacement = \"0 0 -80 mm\"\n";

    /// On every body of a chain of five axes a block: sampled on the path, no corner of it goes
    /// further in the frame of any body between it and the bed than its distances allow.
    #[test]
    fn law_no_corner_goes_further_than_its_way() {
        // C A X Y Z B: all at once, then each rotary axis alone.
        let from = [0.4, -0.7, 100.0, -50.0, 20.0, 0.3];
        for way in [
            [0.9, 0.5, 30.0, 40.0, -60.0, -0.8],
            [0.9, 0.0, 0.0, 0.0, 0.0, 0.0],
            [0.0, 0.9, 0.0, 0.0, 0.0, 0.0],
            [0.0, 0.0, 0.0, 0.0, 0.0, 2.0],
        ] {
            corners_stay_within_their_way(TEXT, &from, &way);
        }
        // B X Y Z: a slide goes out on an arm that turns.
        let arm = "[machine]\nname = \"m\"\nchain = \"w b B X Y Z t\"\n";
        corners_stay_within_their_way(arm, &[0.0; 6], &[6.0, 600.0, 0.0, 0.0, 0.0, 0.0]);
    }

    /// From several moments of the path on.
    fn corners_stay_within_their_way(text: &str, from: &Command, way: &Command) {
        let machine = Machine::check("m.toml", text, &NoTables).0.unwrap();
        let block = |node| BodyModel {
            name: format!("{node}"),
            node: Some(node),
            placement: Pose::shift(Vec3::new(30.0, -60.0, 90.0)),
            role: Role::Machine,
            mesh: Mesh::new(cuboid(Vec3::new(80.0, 20.0, 150.0))).unwrap(),
        };
        let models = (0..machine.bodies().len()).map(block).collect();
        let mut scene = Scene::new(&machine, models, &ToolShape::none(), Vec::new());
        let to: Command = std::array::from_fn(|axis| from[axis] + way[axis]);
        let (clearance_mm, resolution_mm, allowed) = (1.0, 1.0, Allowed::default());
        let sweep = Sweep { from, to: &to, clearance_mm, resolution_mm, allowed };
        let moments: Vec<_> = (0..=40)
            .map(|i| {
                machine.body_poses(&sweep.command(f64::from(i) / 40.0), &ErrorValues::default())
            })
            .collect();
        scene.place(&moments[0]);
        let reaches = scene.reaches(&sweep.way());
        for (m, member) in scene.members.iter().enumerate() {
            let (level, side) = scene.level(m);
            let (mut longest, mut whole) = (0.0_f64, 0.0);
            for k in 0..level {
                let inner = (0..scene.members.len()).find(|i| scene.level(*i) == (k, side));
                let in_inner = |moment: usize| {
                    let poses = &moments[moment];
                    let still = Placed { turn: Mat3::identity(), shift_mm: Vec3::zeros() };
                    relative(
                        &inner.map_or(still, |i| scene.members[i].at(poses)),
                        &member.at(poses),
                    )
                };
                let reach = between(&inner.map_or(Command::default(), |i| reaches[i]), &reaches[m]);
                let distance: f64 = sweep.way().iter().zip(reach).map(|(w, r)| w * r).sum();
                whole = if k == 0 { distance } else { whole };
                for begin in [0, 12, 36] {
                    let start = in_inner(begin);
                    for i in begin..=40 {
                        let (now, part) = (in_inner(i), (i - begin) as f64 / 40.0);
                        for corner in member.mesh.triangles().iter().flatten() {
                            let at = |p: &Placed| p.turn * corner + p.shift_mm;
                            let moved = (at(&now) - at(&start)).norm();
                            longest = longest.max(moved);
                            let most = part * distance + 1e-9;
                            assert!(moved <= most, "{m} in {k} from {begin}: {moved} > {most}");
                        }
                    }
                }
            }
            // An arm that turns nearly once comes back: its way is long, and it is not far.
            let is_loose = way[0] > 3.0 || level < 2 || whole < 4.0 * longest + 1e-9;
            assert!(is_loose, "{whole} for {longest}");
        }
    }

    /// Two cubes of 20 mm whose middles are 37.3 mm apart touch after 17.3 mm, in whatever pieces the way there is swept.
    #[test]
    fn law_an_overlap_begins_where_the_bodies_touch() {
        let machine = Machine::check("m.toml", TEXT, &NoTables).0.unwrap();
        let cube = |(node, middle_mm): (Option<usize>, Vec3)| BodyModel {
            name: format!("{node:?}"),
            node,
            placement: Pose::shift(middle_mm),
            role: Role::Machine,
            mesh: Mesh::new(cuboid(Vec3::new(20.0, 20.0, 20.0))).unwrap(),
        };
        let poses_at = |c: &Command| machine.body_poses(c, &ErrorValues::default());
        let last = machine.bodies().len() - 1;
        let tool_mm = *poses_at(&Command::default())[last].shift_mm();
        let wall_mm = tool_mm + Vec3::new(37.3, 0.0, 0.0);
        for ends in [vec![40.0], vec![3.0, 9.1, 17.2, 40.0], vec![17.299, 17.4], vec![16.9, 29.0]] {
            let models = vec![cube((Some(last), Vec3::zeros())), cube((None, wall_mm))];
            let mut scene = Scene::new(&machine, models, &ToolShape::none(), Vec::new());
            let (mut at, mut begin) = (Command::default(), None);
            for end in ends {
                let to = [0.0, 0.0, end, 0.0, 0.0, 0.0];
                let (clearance_mm, resolution_mm) = (0.0, 0.5);
                let allowed = Allowed::default();
                let sweep = Sweep { from: &at, to: &to, clearance_mm, resolution_mm, allowed };
                let mut found = Vec::new();
                assert!(scene.sweep(&poses_at, &sweep, &mut found));
                let over = found.iter().find(|contact| contact.clearance_mm == 0.0);
                begin = begin.or(over.map(|contact| at[2] + contact.at * (end - at[2])));
                at = to;
            }
            assert!((begin.unwrap() - 17.3).abs() < 1e-8, "{begin:?}");
        }
    }
}
