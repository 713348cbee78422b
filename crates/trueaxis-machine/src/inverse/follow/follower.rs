//! Point after point along a path.

#![expect(clippy::cast_possible_truncation, reason = "a point has far fewer than 2^32 states")]

use super::followed::turned;
use super::undecided::{Kept, Undecided};
use super::{FollowError, FollowFault, FollowSolver, FollowedPath, Label, Reached, Stage};
use crate::axis::Command;
use crate::inverse::Target;
use crate::inverse::turns::nearest;
use std::f64::consts::TAU;

/// So many undecided points are looked through for a junction at the earliest.
const FIRST_LOOK: usize = 256;

/// A point where an angle is free: it waits for the next one where none is.
pub(super) struct Pole {
    pub target: Target,
    pub branches: Vec<Command>,
    pub held: Option<usize>,
}

/// Follows a path in pieces: the same commands as [`crate::Machine::follow`], whatever the pieces are.
///
/// A point is handed out as soon as it is decided: when the best ways to all states that are still
/// possible lead through the same state of it. **Where two branches stay possible to the end of the path,
/// as mostly on machines whose second axis tilts both ways, nothing is decided before the end**: of each
/// point some 40 bytes are kept. Points where an angle is free wait for the next one where none is, too.
///
/// ```
/// # use trueaxis_geometry::{Vec3, frame::{Direction, Point}};
/// # use trueaxis_machine::{Machine, Target, file::NoTables};
/// use trueaxis_machine::{FollowedPath, Follower, Reached};
/// # let text = "[machine]\nname = \"gantry\"\nchain = \"w b X Y Z C A t\"\n";
/// # let machine = Machine::check("gantry.toml", text, &NoTables).0.expect("a machine");
/// # let path: Vec<Target> = (0..36)
/// #     .map(|i| f64::from(i * 10).to_radians())
/// #     .map(|c| Direction::of(Vec3::new(c.sin(), -c.cos(), 1.0)).expect("a direction"))
/// #     .map(|axis| Target { tip: Point::ORIGIN, axis })
/// #     .collect();
/// let solver = machine.follow_solver(&[0.0; 6])?;
/// let (mut follower, mut reached) = (Follower::on(&solver), Reached::default());
/// let mut followed = FollowedPath::default();
/// for piece in path.chunks(7) {
///     solver.reach(piece.iter().copied(), &mut reached);
///     assert_eq!(follower.take(&mut reached, &mut followed)?, None);
/// }
/// follower.finish(&mut followed)?;
/// assert_eq!(solver.command(&followed, 35, &path[35]), machine.follow(&path, &[0.0; 6])?[35]);
/// # Ok::<(), trueaxis_machine::FollowError>(())
/// ```
pub struct Follower<'s> {
    way: &'s FollowSolver<'s>,
    /// The last point that is labelled, if there is one.
    last: Option<Stage>,
    /// Points whose states are known, but not yet the best ways to them.
    ahead: Vec<Stage>,
    /// Room for further points.
    spare: Vec<Stage>,
    poles: Vec<Pole>,
    /// Points whose best ways are known.
    labelled: usize,
    undecided: Undecided,
    look: usize,
    kept: Vec<Kept>,
    /// Where the aiming axes were last handed out.
    turned: [f64; 2],
    jump: Option<FollowError>,
}

impl<'s> Follower<'s> {
    /// At the beginning of a path.
    pub fn on(way: &'s FollowSolver<'_>) -> Self {
        Self {
            way,
            last: None,
            ahead: Vec::new(),
            spare: Vec::new(),
            poles: Vec::new(),
            labelled: 0,
            undecided: Undecided::default(),
            look: FIRST_LOOK,
            kept: Vec::new(),
            turned: way.angles(&way.solver.from),
            jump: None,
        }
    }

    /// Goes on with the next targets and adds the points that are decided to `out`; the jump to which a
    /// continuous motion leads, if it ends here: what comes after it has no effect.
    ///
    /// # Errors
    /// As [`crate::Machine::follow`], without [`FollowFault::Jump`].
    pub fn take(
        &mut self,
        reached: &mut Reached,
        out: &mut FollowedPath,
    ) -> Result<Option<FollowError>, FollowError> {
        for i in 0..reached.targets.len() {
            if self.jump.is_some() {
                break;
            }
            let (target, held) = (reached.targets[i], reached.held[i]);
            if self.way.offered(held).is_some() {
                let branches = reached.branches(i).to_vec();
                self.poles.push(Pole { target, branches, held });
                continue;
            }
            let mut stage = self.stage(&target, held);
            stage.states.extend_from_slice(reached.states(i));
            let branches = reached.branches(i).iter().map(|command| self.way.angles(command));
            stage.branches.extend(branches);
            self.add_poles(&stage)?;
            self.add(stage, &target)?;
            self.label_all();
            if self.undecided.len() >= self.look {
                self.decide(out);
            }
        }
        if let (Some(fault), None) = (reached.fault.take(), &self.jump) {
            let index = self.labelled + self.poles.len();
            return Err(FollowError { index, fault: fault.into() });
        }
        Ok(self.jump.clone())
    }

    /// The end of the path: hands out all points that a continuous motion reaches; the jump that it ends at.
    ///
    /// # Errors
    /// As [`Self::take`].
    pub fn finish(mut self, out: &mut FollowedPath) -> Result<Option<FollowError>, FollowError> {
        if self.jump.is_none() {
            self.add_poles(&Stage::default())?;
            self.label_all();
        }
        if let Some(last) = &self.last {
            let labels = &last.labels;
            let best = (0..labels.len()).fold(0, |best, i| match labels[i].beats(&labels[best]) {
                true => i,
                false => best,
            });
            self.hand_out((self.undecided.len() - 1, best as u32), out);
        }
        Ok(self.jump)
    }

    fn stage(&mut self, target: &Target, held: Option<usize>) -> Stage {
        let mut stage = self.spare.pop().unwrap_or_default();
        stage.branches.clear();
        stage.states.clear();
        (stage.axis, stage.held) = (target.axis.vector(), held);
        stage
    }

    fn add(&mut self, stage: Stage, target: &Target) -> Result<(), FollowError> {
        if stage.states.is_empty() {
            let index = self.labelled + self.ahead.len();
            return Err(FollowError { index, fault: self.way.leaves_travel(target) });
        }
        self.ahead.push(stage);
        Ok(())
    }

    /// Adds the points that waited for this one, which has no states at the end of the path.
    fn add_poles(&mut self, after: &Stage) -> Result<(), FollowError> {
        for pole in std::mem::take(&mut self.poles) {
            let before = self.ahead.last().or(self.last.as_ref());
            let before = before.map_or(&[][..], |stage| &stage.states);
            let index = self.labelled + self.ahead.len();
            let offered = self
                .way
                .at_pole(&pole, [before, &after.states])
                .map_err(|e| FollowError { index, fault: e.into() })?;
            let mut stage = self.stage(&pole.target, pole.held);
            self.way.push_states(&offered, pole.held, &mut stage.states);
            stage.branches.extend(offered.iter().map(|command| self.way.angles(command)));
            self.add(stage, &pole.target)?;
        }
        Ok(())
    }

    /// The best ways to the points ahead, as far as there is one.
    fn label_all(&mut self) {
        let mut ahead = std::mem::take(&mut self.ahead);
        for mut stage in ahead.drain(..) {
            if self.jump.is_some() {
                break;
            }
            match self.label(&mut stage) {
                Err(fault) => self.jump = Some(FollowError { index: self.labelled, fault }),
                Ok(()) => {
                    self.keep(&stage);
                    self.labelled += 1;
                    self.spare.extend(self.last.replace(stage));
                }
            }
        }
        self.ahead = ahead;
    }

    fn label(&self, stage: &mut Stage) -> Result<(), FollowFault> {
        if let Some(last) = &self.last {
            return self.way.advance(last, stage);
        }
        let start = |(rank, state): (usize, &super::State)| self.way.start(rank, &state.command);
        stage.labels = stage.states.iter().enumerate().map(start).collect();
        Ok(())
    }

    fn keep(&mut self, stage: &Stage) {
        self.kept.clear();
        self.kept.extend(stage.states.iter().zip(&stage.labels).map(|(state, label)| Kept {
            branch: state.branch,
            before: label.before as u32,
            turns: state.turns,
        }));
        self.undecided.push(stage.branches.iter().copied(), &self.kept);
    }

    /// Hands out what is decided whatever comes.
    fn decide(&mut self, out: &mut FollowedPath) {
        let labels = self.last.iter().flat_map(|stage| &stage.labels);
        let alive = (0..).zip(labels).filter(|(_, label)| Label::is_reached(label));
        if let Some(junction) = self.undecided.junction(alive.map(|(i, _)| i).collect()) {
            self.hand_out(junction, out);
        }
        // Looking takes as long as there are points: the next time when there are twice as many.
        self.look = FIRST_LOOK.max(2 * self.undecided.len());
    }

    fn hand_out(&mut self, to: (usize, u32), out: &mut FollowedPath) {
        let (way, mut last) = (self.way, self.turned);
        self.undecided.decide(to, &mut |placed, turns| {
            let mut whole = turns.map(f64::from);
            for (k, turn) in way.solver.aim.turning.iter().enumerate().take(2) {
                if way.is_endless(turn.axis) {
                    whole[k] = ((nearest(placed[k], last[k]) - placed[k]) / TAU).round();
                }
            }
            out.push(placed, whole);
            last = turned(placed, whole);
        });
        self.turned = last;
    }
}
