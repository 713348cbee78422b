//! From the tool that is wanted to the axis positions: the inverse of the nominal chain.
//!
//! ```text
//!     Target {tip, axis} ──direction──> angles of the rotary axes     two cones that meet
//!                        ──linear─────> linear axes                    linear equations
//!                        ──turns──────> ±360°, travel, order           conventions.md
//!     [Target] ──follow──> one command per target                      dynamic programming
//! ```

mod closed;
mod direction;
mod follow;
mod linear;
mod placer;
mod serial;
pub(crate) mod turns;

pub use follow::{FollowError, FollowFault, FollowSolver, FollowedPath, Follower, Reached};

use crate::Machine;
use crate::axis::{AxisKind, Command};
use crate::errors::BodyName;
pub(crate) use closed::{Aim, ClosedForm};
pub(crate) use direction::DirectionSolver;
pub(crate) use placer::Placer;
pub(crate) use serial::Serial;
use std::fmt;
use trueaxis_geometry::frame::{Direction, Point, Workpiece};

/// What one double can tell of a direction after a whole chain, in rad.
///
/// A unit vector is rounded at 1e-16, the rotations of a chain add a few of that; nothing that a
/// program can mean is so small (at 10 m it is 5e-9 mm). Closer than this to a pole the angle of
/// the axis there would be rounding noise, so it is held; farther than this from the last
/// reachable direction is out of reach. Both together keep the tool axis within 1e-12.
pub(crate) const RESOLUTION_RAD: f64 = 5e-13;

/// Where the tool shall be: its tip, and its axis from the tip to the spindle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Target {
    /// The tip.
    pub tip: Point<Workpiece>,
    /// The tool axis.
    pub axis: Direction<Workpiece>,
}

/// One way to bring the tool to a target.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Solution {
    /// The axis positions.
    pub command: Command,
    /// Whether every axis stays within its travel; an axis without a stated travel always does.
    pub within_travel: bool,
    /// √(Δq1² + Δq2²) of the rotary axes from where they were.
    pub rotary_travel_rad: f64,
}

/// Every way to bring the tool to a target.
#[derive(Debug, Clone, PartialEq)]
pub struct Solutions {
    /// Best first, never empty.
    pub solutions: Vec<Solution>,
    /// The axis that has no effect on the tool axis here and has kept its angle, if any.
    pub singular: Option<Singularity>,
}

/// A rotary axis turns about the tool axis: it has no effect on its direction.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Singularity {
    /// The rotary axis.
    pub axis: BodyName,
}

impl fmt::Display for Singularity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} turns about the tool axis; its angle is kept", self.axis)
    }
}

/// Why no axis positions bring the tool to a target.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SolveError {
    /// A number of the target or of the starting position is no number or too large.
    #[error(
        "a coordinate of the target or of the starting position is not a finite number; correct it"
    )]
    NotFinite,
    /// No angle of the rotary axes points the tool there.
    #[error(
        "the tool axis cannot reach the required direction, the difference is {:.6} deg: {}; tilt \
         the path or the part towards the closest direction, ({:.9} {:.9} {:.9})",
        .missed_by_rad.to_degrees(), turned_by(.turning), .closest.vector().x,
        .closest.vector().y, .closest.vector().z
    )]
    Unreachable {
        /// The reachable direction that comes closest: tilt the part or the path towards it.
        closest: Direction<Workpiece>,
        /// The angle between it and the wanted one.
        missed_by_rad: f64,
        /// The axes that could turn the tool; empty if none does.
        turning: Vec<BodyName>,
    },
    /// The linear axes do not span the space at this pose, and the tip lies off what they span.
    #[error(
        "{}: in this pose {} cannot move it in all three directions; {}",
        left(*missed_by_mm), listed(.moving), advice(*missed_by_mm)
    )]
    TipUnreachable {
        /// How far; not a number where the path passes such a pose and the distance is not known.
        missed_by_mm: f64,
        /// The independent linear axes.
        moving: Vec<BodyName>,
    },
}

/// How far the tip is from its place, where that is known.
fn left(missed_by_mm: f64) -> String {
    match missed_by_mm.is_nan() {
        true => "the tip cannot keep to its path".into(),
        false => format!("the tip remains {missed_by_mm:.6} mm from the target"),
    }
}

fn advice(missed_by_mm: f64) -> &'static str {
    match missed_by_mm.is_nan() {
        true => "tilt the part, or lead the path round this pose",
        false => "move the target or the part by that distance",
    }
}

fn turned_by(turning: &[BodyName]) -> String {
    match turning {
        [] => "no rotary axis turns the tool".into(),
        _ => format!("the tool is turned only by {}", listed(turning)),
    }
}

fn listed(axes: &[BodyName]) -> String {
    match axes {
        [] => "no linear axis".into(),
        _ => axes.iter().map(ToString::to_string).collect::<Vec<_>>().join(" and "),
    }
}

impl Machine {
    /// Every command that brings the tip of the nominal machine to a target, best first.
    ///
    /// ```text
    ///     R(a, θ1) · R(b, θ2) · v = u        a, b rotary axes, v tool axis at zero, u wanted
    ///     Σ q_k · d_k = tip − tip(q_k = 0)   linear axes; docs/model.md eq. 15 and 16
    /// ```
    ///
    /// One entry for each branch with angles in (−180°, 180°], and the other turns that lie inside
    /// the travel; on an axis without end also the turn nearest to `from`; entries that leave the
    /// travel stand last. Best is the shortest way √(Δq1² + Δq2²) of the rotary axes from `from`;
    /// among equals (1e-9) the shorter way of the first one in chain order, then a second angle
    /// that is not negative, then the smaller first.
    ///
    /// Redundant axes stay where `from` has them: of three rotary axes the last that is not
    /// needed, of parallel linear axes U, V, W and then the later one in the chain. Where a rotary
    /// axis turns about the tool axis (within 5e-13 rad) it stays too and is named in
    /// [`Solutions::singular`]; a tool axis farther away from there is solved exactly.
    ///
    /// # Errors
    /// A direction or a tip that the machine cannot reach, with the closest one; see
    /// [`SolveError`]. Leaving the travel is no error: such entries are marked.
    ///
    /// # Example
    /// ```
    /// use trueaxis_geometry::{Vec3, frame::{Direction, Point}};
    /// use trueaxis_machine::{Machine, Target, file::NoTables};
    /// let text = "[machine]\nname = \"gantry\"\nchain = \"w b X Y Z C A t\"\n\
    ///             [tool]\nlength = \"100 mm\"";
    /// let machine = Machine::check("gantry.toml", text, &NoTables).0.expect("a machine");
    ///
    /// // The tip at the origin, the tool leaning by 30° towards −y: A = 30°, C = 0; the pivot
    /// // stands 100 mm up the tool, so Y = −50 mm and Z = 86.6 mm.
    /// let axis = Direction::of(Vec3::new(0.0, -0.5, 0.75_f64.sqrt())).expect("a direction");
    /// let target = Target { tip: Point::ORIGIN, axis };
    /// let found = machine.solve(&target, &[0.0; 6]).expect("reachable");
    /// let [x, y, z, c, a, _] = found.solutions[0].command;
    /// assert!(x.abs() < 1e-9 && (y + 50.0).abs() < 1e-9 && (z - 86.602540378).abs() < 1e-9);
    /// assert!(c.abs() < 1e-12 && (a.to_degrees() - 30.0).abs() < 1e-12);
    /// // The other branch: C = 180°, A = −30°.
    /// assert_eq!(found.solutions.len(), 2);
    /// ```
    ///
    /// # Source
    /// The geometry of two cones (Paden 1986, second subproblem); cases of Wu et al. 2022
    /// (Eq 12, 13), Zhang et al. 2023 and Lei and Hsu 2003 (Eq 11–13) with their errata. This
    /// solution needs no case for each machine type and no arccos, which loses half of the digits
    /// near the poles.
    pub fn solve(&self, target: &Target, from: &Command) -> Result<Solutions, SolveError> {
        let solver = Solver::new(self, from)?;
        let branches = solver.branches(target)?;
        let solutions = turns::in_order(self, solver.with_turns(&branches), from);
        let singular = branches.held.map(|i| Singularity { axis: self.axes[i].name });
        Ok(Solutions { solutions, singular })
    }

    /// One command for each target of a path, so that the rotary axes travel least in total.
    ///
    /// ```text
    ///     min Σ √(Δq1² + Δq2²)   over all branches and all turns within the travel
    /// ```
    ///
    /// The first step is measured from `from`. Axes without end, and those without a stated
    /// travel, unwind freely. Every step must be continuous: on its way the tool axis is never
    /// farther from one of its ends than they are from each other, so a change of branch and a
    /// rewind by 360° are refused, except at a pole. There the idle axis takes an angle of the
    /// nearest points that need one; it rather turns while the tool stands than while it tilts
    /// (its turn counts twice on a step that enters or leaves the pole). Ties (1e-9) as in
    /// [`Machine::solve`], then a first point in (−180°, 180°].
    ///
    /// # Errors
    /// The first point that cannot be reached, that leaves the travel (which axis, by how much) or
    /// that no continuous motion reaches; see [`FollowFault`].
    ///
    /// # Example
    /// ```
    /// use trueaxis_geometry::{Vec3, frame::{Direction, Point}};
    /// use trueaxis_machine::{Machine, Target, file::NoTables};
    /// let text = "[machine]\nname = \"gantry\"\nchain = \"w b X Y Z C A t\"\n\
    ///             [axis.C]\ntravel = [\"-360 deg\", \"360 deg\"]";
    /// let machine = Machine::check("gantry.toml", text, &NoTables).0.expect("a machine");
    ///
    /// // The tool leans by 45° and goes once round; C unwinds from 0 to 350°.
    /// let path: Vec<Target> = (0..36)
    ///     .map(|i| f64::from(i * 10).to_radians())
    ///     .map(|c| Direction::of(Vec3::new(c.sin(), -c.cos(), 1.0)).expect("a direction"))
    ///     .map(|axis| Target { tip: Point::ORIGIN, axis })
    ///     .collect();
    /// let commands = machine.follow(&path, &[0.0; 6]).expect("a way");
    /// assert!((commands[35][3].to_degrees() - 350.0).abs() < 1e-9);
    /// assert!((commands[35][4].to_degrees() - 45.0).abs() < 1e-9);
    /// ```
    ///
    /// # Source
    /// Wu et al. 2022, Eq 13 (the k of C by unwinding, errata 000-8); dynamic programming: Bellman
    /// 1957.
    pub fn follow(&self, path: &[Target], from: &Command) -> Result<Vec<Command>, FollowError> {
        match follow::follow(self, path, from)? {
            (_, Some(jump)) => Err(jump),
            (commands, None) => Ok(commands),
        }
    }

    /// The same as far as a continuous motion leads: the commands, and the jump that it ends at.
    ///
    /// # Errors
    /// As [`Machine::follow`], without [`FollowFault::Jump`].
    pub fn follow_on(
        &self,
        path: &[Target],
        from: &Command,
    ) -> Result<(Vec<Command>, Option<FollowError>), FollowError> {
        follow::follow(self, path, from)
    }

    /// What follows a path that begins at a command piece by piece; see [`Follower`].
    ///
    /// # Errors
    /// A number of the command is not finite.
    pub fn follow_solver(&self, from: &Command) -> Result<FollowSolver<'_>, FollowError> {
        FollowSolver::of(self, from)
    }
}

/// The machine with its redundant axes held where they were.
struct Solver<'m> {
    machine: &'m Machine,
    serial: Serial,
    aim: DirectionSolver,
    from: Command,
    /// Where there are many targets: what places one tip after the other.
    placer: Option<Placer>,
}

/// The ways to reach one target, free rotary angles in (−π, π].
struct Branches {
    commands: Vec<Command>,
    /// The axis that has no effect on the tool axis and keeps its angle.
    held: Option<usize>,
}

impl<'m> Solver<'m> {
    fn new(machine: &'m Machine, from: &Command) -> Result<Self, SolveError> {
        if !from.iter().all(|q| q.is_finite()) {
            return Err(SolveError::NotFinite);
        }
        let serial = Serial::of(machine);
        let aim = DirectionSolver::of(&serial, from);
        Ok(Self { machine, serial, aim, from: *from, placer: None })
    }

    fn branches(&self, target: &Target) -> Result<Branches, SolveError> {
        let mut commands = Vec::new();
        let held = self.branches_into(target, &mut commands)?;
        Ok(Branches { commands, held })
    }

    /// Puts the ways to reach a target in place of what `commands` holds; the axis that is held.
    fn branches_into(
        &self,
        target: &Target,
        commands: &mut Vec<Command>,
    ) -> Result<Option<usize>, SolveError> {
        commands.clear();
        let tip = target.tip.vector();
        if !tip.iter().chain(target.axis.vector().iter()).all(|v| v.is_finite()) {
            return Err(SolveError::NotFinite);
        }
        let aimed =
            self.aim.at(target.axis.vector()).map_err(|missed| self.unreachable(&missed))?;
        let mut missed = None;
        for angles in aimed.branches() {
            let mut command = self.from;
            for (turn, angle) in self.aim.turning.iter().zip(angles) {
                if let Some(angle) = angle {
                    command[turn.axis] = turns::principal(turn.sense * angle);
                }
            }
            match self.place_tip(command, target) {
                Ok(command) => commands.push(command),
                Err(error) => missed = Some(error),
            }
        }
        // With fewer than three linear axes one branch may meet the tip and another not.
        if let (true, Some(error)) = (commands.is_empty(), missed) {
            return Err(error);
        }
        Ok(match aimed.first_is_idle {
            true => Some(self.aim.turning[0].axis),
            false => self.idle_axis(&commands[0]),
        })
    }

    /// A held rotary axis that turns about the tool axis.
    fn idle_axis(&self, command: &Command) -> Option<usize> {
        if self.serial.rotary().count() == self.aim.turning.len() {
            return None;
        }
        let frames = self.serial.frames(command);
        let tool = frames.tool_axis();
        self.serial
            .rotary()
            .filter(|&i| self.aim.turning.iter().all(|turn| turn.axis != i))
            .find(|&i| self.serial.axis_in(&frames, i).cross(&tool).norm() <= RESOLUTION_RAD)
    }

    fn unreachable(&self, missed: &direction::UnreachableDirection) -> SolveError {
        let turning = self.aim.turning.iter().map(|t| self.machine.axes[t.axis].name).collect();
        let closest = Direction::of(missed.closest).unwrap_or(Direction::Z);
        SolveError::Unreachable { closest, missed_by_rad: missed.by_rad, turning }
    }

    /// All turns of all branches, without order and marks.
    fn with_turns(&self, branches: &Branches) -> Vec<Command> {
        let mut all = Vec::new();
        for command in &branches.commands {
            let mut turned = vec![*command];
            for turn in &self.aim.turning {
                if branches.held == Some(turn.axis) {
                    continue;
                }
                let (travel, q) = (self.machine.axes[turn.axis].travel, command[turn.axis]);
                let others = turns::others(travel, q, self.from[turn.axis]);
                let shifted = |c: &Command| others.clone().map(|q| with(c, turn.axis, q)).collect();
                let more: Vec<Command> = turned.iter().flat_map::<Vec<_>, _>(shifted).collect();
                turned.extend(more);
            }
            // The branch itself stays in any case; another turn only if it is a place to go to.
            let inside = |c: &Command| {
                self.aim
                    .turning
                    .iter()
                    .all(|t| self.machine.axes[t.axis].travel.contains(c[t.axis]))
            };
            all.extend(
                turned.iter().enumerate().filter(|(i, c)| *i == 0 || inside(c)).map(|x| *x.1),
            );
        }
        all
    }
}

fn with(command: &Command, axis: usize, q: f64) -> Command {
    let mut command = *command;
    command[axis] = q;
    command
}

impl Machine {
    fn within_travel(&self, command: &Command) -> bool {
        self.axes.iter().zip(command).all(|(axis, &q)| axis.travel.contains(q))
    }

    /// The rotary axes in chain order.
    fn rotary_axes(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.axes.len()).filter(|&i| self.axes[i].kind == AxisKind::Rotary)
    }
}
