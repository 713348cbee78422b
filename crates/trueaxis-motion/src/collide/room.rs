//! How far the axes may go before any body can come near another: one bound for many blocks.

use super::scene::{Allowed, Distance, Scene};
use super::sweep::Sweep;
use trueaxis_geometry::Vec3;
use trueaxis_geometry::frame::{Bed, Body, Pose};
use trueaxis_machine::axis::{AxisKind, Command, MAX_AXES};

/// The room around the place where a sweep began that found no contact: as long as the axes are in it, no pair can be near.
///
/// With the axes of the chain where they stand at the place, a point goes to T₁(T₂(… p)), and as each T leaves distances as they are,
/// |T₁(T₂(… p)) − p| ≤ Σ |T_k(p) − p|: the way of a linear axis, of a rotary one at most its angle times the distance of p from it.
#[derive(Debug, Clone)]
pub struct Room {
    allowed: Allowed,
    /// The pairs with the least room: they are asked again before the others need it.
    near: Vec<usize>,
    of_near: Bound,
    of_far: Bound,
}

/// Error motions change along the path, by less than a thousandth of it on any machine tool.
const ERROR_SLOPE: f64 = 1.001;
/// Pairs with more than so many times the least room are far.
const FAR: f64 = 8.0;

/// One bound for many pairs. A pair has the room m beyond the clearance and loses at most Σ a_k w_k of it while axis k is w_k from the
/// place. With ρ_k the largest a_k / m of all pairs, Σ a_k w_k < m for each of them where Σ ρ_k w_k < 1.
#[derive(Debug, Clone, Copy)]
struct Bound {
    place: Command,
    /// ρ_k, per mm and rad.
    rates: Command,
    /// A pair has no room.
    is_closed: bool,
}

impl Bound {
    fn around(place: &Command) -> Self {
        Self { place: *place, rates: Command::default(), is_closed: false }
    }

    fn add(&mut self, room_mm: f64, reach: &Command) {
        self.is_closed |= room_mm.is_nan() || room_mm <= 0.0;
        for (rate, of_pair) in self.rates.iter_mut().zip(reach) {
            *rate = rate.max(of_pair / room_mm);
        }
    }

    /// NaN is not in it.
    fn holds(&self, command: &Command) -> bool {
        let used = |axis: usize| self.rates[axis] * (command[axis] - self.place[axis]).abs();
        !self.is_closed && (0..MAX_AXES).map(used).sum::<f64>() < 1.0
    }
}

impl Room {
    /// Whether nothing can be near while the axes go straight there from a place that is in the room: the sum of the bound is largest at
    /// an end.
    pub fn holds(&self, command: &Command, allowed: Allowed) -> bool {
        allowed == self.allowed && self.of_near.holds(command) && self.of_far.holds(command)
    }
}

impl Scene {
    /// The room around the place where a sweep began that found no contact.
    pub fn room(&self, sweep: &Sweep<'_>) -> Room {
        let mut room = Room {
            allowed: sweep.allowed,
            near: Vec::new(),
            of_near: Bound::around(sweep.from),
            of_far: Bound::around(sweep.from),
        };
        let watched = |pair: &usize| !self.is_allowed(&self.pairs[*pair], sweep.allowed);
        let rooms: Vec<(usize, f64)> = (0..self.pairs.len())
            .filter(watched)
            .map(|index| {
                let pair = &self.pairs[index];
                let known_mm = self.known_mm(pair, &self.relative(pair));
                (index, self.free_mm(pair).max(known_mm) - sweep.watch_mm())
            })
            .collect();
        let least_mm = rooms.iter().map(|(_, room_mm)| *room_mm).fold(f64::INFINITY, f64::min);
        let reaches = self.reaches(&Command::default());
        for (index, room_mm) in rooms {
            let pair = &self.pairs[index];
            let bound = match room_mm > FAR * least_mm {
                true => &mut room.of_far,
                false => {
                    room.near.push(index);
                    &mut room.of_near
                }
            };
            bound.add(room_mm, &between(&reaches[pair.first], &reaches[pair.second]));
        }
        room
    }

    /// Asks the near pairs again where a sweep begins that leads out of the room; `false` if it leads out of that, too.
    pub fn renew(
        &mut self,
        room: &mut Room,
        poses_at: &dyn Fn(&Command) -> Vec<Pose<Bed, Body>>,
        sweep: &Sweep<'_>,
    ) -> bool {
        if sweep.allowed != room.allowed || !room.of_far.holds(sweep.to) {
            return false;
        }
        let (watch_mm, still) = (sweep.watch_mm(), Command::default());
        let poses = poses_at(sweep.from);
        self.nodes_now.clone_from(&poses);
        let mut pairs = std::mem::take(&mut self.pairs);
        room.of_near = Bound::around(sweep.from);
        for index in &room.near {
            let pair = &mut pairs[*index];
            let members = [pair.first, pair.second];
            members.iter().for_each(|m| self.members[*m].place(&poses));
            let placed = self.relative(pair);
            let mut apart_mm = self.known_mm(pair, &placed);
            // Once half of the room that was known is lost.
            if apart_mm - watch_mm < 0.5 * (pair.far_mm - watch_mm) {
                apart_mm = match self.ask(pair, &placed, watch_mm) {
                    Distance::AtLeast(apart_mm) => apart_mm,
                    Distance::Exactly(near) => near.distance_mm,
                };
            }
            self.remember(pair, apart_mm);
            let [first, second] = members.map(|m| self.reach_of(m, &still));
            room.of_near.add(apart_mm - watch_mm, &between(&first, &second));
        }
        self.pairs = pairs;
        room.of_near.holds(sweep.to) && self.work < self.most_work
    }

    pub(super) fn reaches(&self, ways: &Command) -> Vec<Command> {
        (0..self.members.len()).map(|member| self.reach_of(member, ways)).collect()
    }

    /// How far a member moves at most per mm and rad of each axis that carries it, from wherever it comes to while the axes go no farther
    /// than these ways: axes further out may bring it farther from a rotary one.
    fn reach_of(&self, member: usize, ways: &Command) -> Command {
        let (level, side) = self.level(member);
        let own = &self.members[member];
        let centre = own.now.turn * own.mesh.centre_mm() + own.now.shift_mm;
        let (mut reach, mut beyond) = (Command::default(), 0.0);
        for step in (1..=level).rev() {
            let body = match side {
                1 => self.workpiece_side + step - 1,
                _ => self.workpiece_side - step,
            };
            let Some(i) = self.axis_of[body] else { continue };
            reach[i] = ERROR_SLOPE
                * match self.axes[i].kind {
                    AxisKind::Linear => 1.0,
                    AxisKind::Rotary => {
                        self.reach_mm(body, i, &centre) + own.mesh.radius_mm() + beyond
                    }
                };
            beyond += ways[i] * reach[i];
        }
        reach
    }

    /// How far a point of the bed frame is from a rotary axis where it is now.
    fn reach_mm(&self, body: usize, axis: usize, point: &Vec3) -> f64 {
        let node = &self.nodes_now[body];
        let direction = node.linear() * self.axes[axis].direction;
        (point - node.shift_mm()).cross(&direction).norm() / direction.norm()
    }
}

/// How far two bodies move as seen from each other, per mm and rad of each axis: one that carries both moves neither.
pub(super) fn between(first: &Command, second: &Command) -> Command {
    let mut reach = Command::default();
    for axis in 0..MAX_AXES {
        let carries_both = first[axis] > 0.0 && second[axis] > 0.0;
        reach[axis] = if carries_both { 0.0 } else { first[axis] + second[axis] };
    }
    reach
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::collide::mesh::Mesh;
    use crate::collide::scene::{BodyModel, Contact, Role, ToolShape};
    use crate::collide::shape::cuboid;
    use trueaxis_machine::Machine;
    use trueaxis_machine::errors::ErrorValues;
    use trueaxis_machine::file::NoTables;

    const TEXT: &str = "[machine]\nname = \"m\"\nchain = \"w C' A' b X Y Z B t\"\n\
                        [axis.A]\nplacement = \"50 20 -30 mm\"\n[axis.B]\nplacement = \"0 0 -80 mm\"\n";

    /// A walk of small steps among blocks: where the room says that nothing can be near, a scene that knows nothing finds nothing; and
    /// many steps are in a room, or in one that is renewed.
    #[test]
    fn law_in_a_room_nothing_is_near() {
        let machine = Machine::check("m.toml", TEXT, &NoTables).0.unwrap();
        let block = |(node, shift): (Option<usize>, Vec3)| BodyModel {
            name: format!("{node:?} {shift:?}"),
            node,
            placement: Pose::shift(shift),
            role: Role::Machine,
            mesh: Mesh::new(cuboid(Vec3::new(30.0, 20.0, 25.0))).unwrap(),
        };
        let last = machine.bodies().len() - 1;
        let models = || {
            [
                (Some(0), Vec3::new(40.0, -60.0, 20.0)),
                (Some(0), Vec3::new(-80.0, 30.0, 20.0)),
                (None, Vec3::new(150.0, 0.0, -200.0)),
                (Some(last - 3), Vec3::new(-90.0, 20.0, 60.0)),
                (Some(last), Vec3::new(0.0, 0.0, 120.0)),
                (Some(last), Vec3::new(60.0, 0.0, 200.0)),
            ]
            .map(block)
            .to_vec()
        };
        let new = || Scene::new(&machine, models(), &ToolShape::none(), Vec::new());
        let poses_at = |c: &Command| machine.body_poses(c, &ErrorValues::default());
        let (mut scene, mut room): (Scene, Option<Room>) = (new(), None);
        let (mut state, mut at) = (11_u64, Command::default());
        let mut random = || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            2.0 * (state >> 11) as f64 / (1_u64 << 53) as f64 - 1.0
        };
        let (mut free, mut renewed, mut near, mut begun) = (0, 0, 0, 0);
        let mut goal = at;
        for step in 0..3000 {
            if step % 50 == 0 {
                goal = [2.0, 0.6, 80.0, 80.0, 80.0, 1.0].map(|most| most * random());
            }
            let part = 1.0 / f64::from(50 - step % 50);
            let to: Command = std::array::from_fn(|i| at[i] + part * (goal[i] - at[i]));
            // Feed and rapid in turn: what one allows holds no more in the other.
            let allowed = Allowed { cutter_in_stock: step % 40 < 30, ..Allowed::default() };
            let sweep =
                Sweep { from: &at, to: &to, clearance_mm: 2.0, resolution_mm: 0.5, allowed };
            let mut found = Vec::new();
            let is_in = room.as_ref().is_some_and(|room| room.holds(&to, allowed));
            let renewal = |room: &mut Room| scene.renew(room, &poses_at, &sweep);
            if is_in || room.as_mut().is_some_and(renewal) {
                free += 1;
                renewed += u32::from(!is_in);
                new().sweep(&poses_at, &sweep, &mut found);
                assert!(found.is_empty(), "{step}: {found:?}");
            } else {
                scene.sweep(&poses_at, &sweep, &mut found);
                near += u32::from(!found.is_empty());
                let mut fresh = Vec::new();
                new().sweep(&poses_at, &sweep, &mut fresh);
                // What was asked before changes no begin of an overlap, and no distance by more than the resolution.
                assert_eq!(found.len(), fresh.len(), "{step}");
                for (one, other) in found.iter().zip(&fresh) {
                    let names = |c: &Contact| [c.first.clone(), c.second.clone()];
                    assert_eq!(names(one), names(other));
                    assert_eq!(one.clearance_mm == 0.0, other.clearance_mm == 0.0, "{step}");
                    let is_over = one.clearance_mm == 0.0;
                    let same = !is_over || (one.at - other.at).abs() < 1e-8;
                    assert!(same, "{step}: {} {}", one.at, other.at);
                    begun += u32::from(is_over && one.at > 0.0);
                    assert!((one.clearance_mm - other.clearance_mm).abs() <= 0.5, "{step}");
                }
                room = found.is_empty().then(|| scene.room(&sweep));
                room = room.filter(|room| room.holds(&to, allowed));
            }
            at = to;
        }
        assert!(
            free > 1500 && renewed > 100 && near > 30 && begun > 3,
            "{free} {renewed} {near} {begun}"
        );
    }
}
