//! From strokes to axis positions: poles, branches, turns, and where the tool must go back.

use crate::Fault;
use crate::path::{Event, Path, Stand, Stroke, Way, between};
use crate::strokes::Strokes;
use std::ops::Range;
use trueaxis_geometry::frame::{Direction, Point};
use trueaxis_geometry::{Vec3, angle};
use trueaxis_input::{in_order, usual_threads};
use trueaxis_machine::axis::{AxisKind, Command};
use trueaxis_machine::tcp::TipControl;
use trueaxis_machine::{
    FollowError, FollowFault, FollowSolver, FollowedPath, Follower, Machine, Reached, Target,
};

/// Nearer to a pole than this the tool axis is taken for the pole: an angle that no part shows.
const POLE_RAD: f64 = 2e-7;

/// A stroke near a pole is cut at most so often.
const MOST_CUTS: u32 = 60;

/// Strokes in a row that one continuous motion makes, and the axis positions at their ends.
pub(crate) struct Leg<'m> {
    /// The stroke at whose end the leg begins.
    pub first: usize,
    /// Whether that stroke is still to be cut by this leg.
    pub cuts_first: bool,
    solver: FollowSolver<'m>,
    /// At the end of each stroke from there on.
    followed: FollowedPath,
}

impl Leg<'_> {
    /// The stroke after the last one.
    pub fn end(&self) -> usize {
        self.first + self.followed.len()
    }

    /// The axis positions at the end of a stroke of the leg.
    pub fn command(&self, path: &Path, index: usize) -> Command {
        self.solver.command(&self.followed, index - self.first, &target(path.strokes.to(index)))
    }

    /// The same with the rotary axes alone: the linear ones are not placed.
    pub fn turned(&self, index: usize) -> Command {
        self.solver.turned(&self.followed, index - self.first)
    }
}

fn target(stand: Stand) -> Target {
    Target {
        tip: Point::from_vector(stand.tip),
        axis: Direction::of(stand.axis).unwrap_or(Direction::Z),
    }
}

/// Turns tool axes near a pole onto it and cuts strokes that pass it, so that the swing of the first
/// rotary axis is seen; the largest turn, rad.
pub(crate) fn pass_poles(path: &mut Path, control: &TipControl, pole_rad: f64) -> f64 {
    let Some(pole) = control.pole() else { return 0.0 };
    let pole = pole.vector();
    let near = pole_rad.max(POLE_RAD);
    let mut most = 0.0_f64;
    let mut onto_pole = |axis: Vec3| {
        for end in [pole, -pole] {
            let away = angle(&axis, &end);
            if away <= near {
                most = most.max(away);
                return end;
            }
        }
        axis
    };
    let far = (near < 0.5).then(|| (near * (1.0 + 1e-9) + 1e-12).powi(2));
    for stand in path.strokes.ends_mut() {
        // The sine is smaller than the angle: most axes are farther away at a glance.
        if far.is_none_or(|far| stand.axis.cross(&pole).norm_squared() <= far) {
            stand.axis = onto_pole(stand.axis);
        }
    }
    let cuts = all_cuts(path, &pole, near);
    if !cuts.is_empty() {
        cut_at_pole(path, &cuts, &mut onto_pole);
    }
    // What is below the digits of programs is not reported as a deviation.
    if most > POLE_RAD { most } else { 0.0 }
}

/// The strokes that have to be cut, and where.
type StrokeCuts = Vec<(usize, Vec<f64>)>;

fn all_cuts(path: &Path, pole: &Vec3, near: f64) -> StrokeCuts {
    let ends = path.strokes.ends();
    let strokes = ends.len().saturating_sub(1);
    let find = |block: usize, found: &mut StrokeCuts| {
        let first = 1 + block * BLOCK;
        let of = |i: usize| (i, cuts_at_pole(&ends[i - 1].axis, &ends[i].axis, pole, near));
        let last = ends.len().min(first + BLOCK);
        found.clear();
        found.extend((first..last).map(of).filter(|(_, cuts)| !cuts.is_empty()));
    };
    let mut all = Vec::new();
    in_order(strokes.div_ceil(BLOCK), usual_threads(), &find, &mut |found| {
        all.append(found);
        true
    });
    all
}

/// Cuts strokes; the numbers of strokes that events and holes name follow.
fn cut_at_pole(path: &mut Path, cuts: &StrokeCuts, onto_pole: &mut dyn FnMut(Vec3) -> Vec3) {
    let (mut strokes, mut next) = (Strokes::default(), 0);
    // How many strokes there are more, from the stroke after one on.
    let (mut more, mut added) = (Vec::new(), 0);
    for (i, cuts) in cuts {
        strokes.push_all(&path.strokes, next..*i);
        let (from, stroke) = (path.strokes.to(i - 1), path.strokes.get(*i));
        let mut before = 0.0;
        for &u in cuts {
            let mut to = stroke.at(&from, u);
            to.axis = onto_pole(to.axis);
            strokes.push(&Stroke { to, way: part(&stroke.way, u - before), ..stroke });
            before = u;
        }
        strokes.push(&Stroke { way: part(&stroke.way, 1.0 - before), ..stroke });
        next = i + 1;
        added += cuts.len();
        more.push((*i, added));
    }
    strokes.push_all(&path.strokes, next..path.strokes.len());
    let moved = |at: usize| {
        let before = more.partition_point(|(stroke, _)| *stroke < at);
        at + before.checked_sub(1).map_or(0, |last| more[last].1)
    };
    for (at, _) in &mut path.events {
        *at = moved(*at);
    }
    for hole in &mut path.holes {
        (hole.begin, hole.down) = (moved(hole.begin), moved(hole.down));
        hole.last = moved(hole.last + 1) - 1;
    }
    path.strokes = strokes;
}

fn part(way: &Way, fraction: f64) -> Way {
    match *way {
        Way::Arc { center, normal, angle_rad } => {
            Way::Arc { center, normal, angle_rad: angle_rad * fraction }
        }
        Way::Line => Way::Line,
    }
}

/// Where a turn of the tool axis is cut so that no piece turns by more than half of its distance
/// from the pole; at the pole itself where it passes it.
fn cuts_at_pole(from: &Vec3, to: &Vec3, pole: &Vec3, near: f64) -> Vec<f64> {
    let mut cuts = Vec::new();
    // 2 asin(c/2) ≤ 1.05 c for a chord c ≤ 1, and a sine is smaller than its angle: most turns are far
    // smaller than their distance at a glance.
    let chord = (to - from).norm();
    let sines = from.cross(pole).norm_squared().min(to.cross(pole).norm_squared());
    if chord <= 1.0 && (3.15 * chord + 1e-9).powi(2) <= sines {
        return cuts;
    }
    let turn = angle(from, to);
    let away = |axis: &Vec3| angle(axis, pole).min(angle(axis, &-pole));
    if turn <= 0.5 * (away(from).min(away(to)) - turn).max(0.0) {
        return cuts;
    }
    let mut wait = vec![(0.0, 1.0, 0)];
    while let Some((u0, u1, depth)) = wait.pop() {
        let (a, b) = (between(from, to, u0), between(from, to, u1));
        let closest = closest_to(&a, &b, pole);
        let least = away(&between(&a, &b, closest));
        let ends_at_pole = away(&a) <= near || away(&b) <= near;
        let step = angle(&a, &b);
        if depth >= MOST_CUTS || ends_at_pole || step <= 0.5 * least {
            if u1 < 1.0 {
                cuts.push(u1);
            }
            continue;
        }
        let inside = closest > 0.0 && closest < 1.0;
        let at = if inside && least <= near { closest } else { 0.5 };
        let middle = u0 + (u1 - u0) * at;
        wait.push((middle, u1, depth + 1));
        wait.push((u0, middle, depth + 1));
    }
    cuts
}

/// Where a great circle is nearest to the pole or the one opposite.
///
/// d/du ⟨a(u), p⟩ = 0:  tan(uθ) = (⟨a₁, p⟩ − ⟨a₀, p⟩ cos θ)/(⟨a₀, p⟩ sin θ)
///                                                            docs/model.md eq. 123
fn closest_to(from: &Vec3, to: &Vec3, pole: &Vec3) -> f64 {
    let theta = angle(from, to);
    if theta < 1e-12 {
        return 0.0;
    }
    let (a, b) = (from.dot(pole), to.dot(pole));
    let (sin, cos) = theta.sin_cos();
    let mut at = (b - a * cos).atan2(a * sin);
    // The same place of the circle in either direction.
    if at < 0.0 {
        at += std::f64::consts::PI;
    }
    if at <= theta {
        return at / theta;
    }
    if a.abs() >= b.abs() { 0.0 } else { 1.0 }
}

/// So many strokes are examined together.
pub(crate) const BLOCK: usize = 1024;

/// The stretches of a path between changes of the tool.
pub(crate) fn stretches(path: &Path) -> Vec<Range<usize>> {
    let strokes = path.strokes.len();
    let mut begins: Vec<usize> = vec![0];
    let changes = path.events.iter().filter(|(_, e)| matches!(e, Event::Tool { .. }));
    begins.extend(changes.map(|(at, _)| *at).filter(|at| *at > 0 && *at < strokes));
    begins.dedup();
    begins.push(strokes);
    begins.windows(2).map(|ends| ends[0]..ends[1]).collect()
}

/// Axis positions for all strokes of a stretch, in as few legs as continuous motions allow, each handed out
/// before the next one is looked for; they begin at `from`, which is where they end then.
pub(crate) fn legs(
    machine: &Machine,
    path: &Path,
    stretch: Range<usize>,
    from: &mut Command,
    out: &mut dyn FnMut(&Leg<'_>),
) -> Result<(), Fault> {
    let (mut first, mut cuts_first) = (stretch.start, true);
    while first < stretch.end {
        let explained = |e: &FollowError| explained(path.strokes.line(first + e.index), &e.fault);
        let solver = machine.follow_solver(from).map_err(|e| explained(&e))?;
        let (followed, jump) =
            follow(&solver, path, first..stretch.end).map_err(|e| explained(&e))?;
        let leg = Leg { first, cuts_first, solver, followed };
        if let Some(jump) = jump.filter(|_| leg.followed.len() < 2 && !cuts_first) {
            return Err(explained(&jump));
        }
        let reached = leg.end();
        if !leg.followed.is_empty() {
            *from = leg.command(path, reached - 1);
        }
        out(&leg);
        if reached == stretch.end {
            break;
        }
        // The next leg begins where this one ends, turned otherwise.
        (first, cuts_first) = (reached - 1, false);
    }
    Ok(())
}

/// As [`Machine::follow_on`], with the branches of each block of strokes found on any thread.
fn follow(
    solver: &FollowSolver<'_>,
    path: &Path,
    strokes: Range<usize>,
) -> Result<(FollowedPath, Option<FollowError>), FollowError> {
    let (mut follower, mut followed) = (Follower::on(solver), FollowedPath::default());
    let ends = &path.strokes.ends()[strokes];
    let mut jump = Ok(None);
    let reach = |block: usize, reached: &mut Reached| {
        let piece = ends.chunks(BLOCK).nth(block).unwrap_or_default();
        solver.reach(piece.iter().map(|stand| target(*stand)), reached);
    };
    let blocks = ends.len().div_ceil(BLOCK);
    in_order(blocks, usual_threads(), &reach, &mut |reached| {
        jump = follower.take(reached, &mut followed);
        matches!(jump, Ok(None))
    });
    let jump = jump?;
    let at_end = follower.finish(&mut followed)?;
    Ok((followed, at_end.or(jump)))
}

/// Whether a rotary axis is turned at the end of a stroke of a leg.
pub(crate) fn is_turned(machine: &Machine, path: &Path, leg: &Leg<'_>) -> bool {
    let turned = |command: &Command| {
        let mut axes = machine.axes().iter().zip(command);
        axes.any(|(axis, q)| axis.kind == AxisKind::Rotary && q.abs() > POLE_RAD)
    };
    (leg.first..leg.end()).any(|index| turned(&leg.command(path, index)))
}

/// With tool length compensation alone the places of the program are those of the tip only where no rotary axis is
/// turned and the linear axes are parallel to the workpiece frame.
pub(crate) fn check_upright(
    machine: &Machine,
    control: &TipControl,
    path: &Path,
    is_turned: bool,
) -> Result<(), Fault> {
    let refused = |line, message: &str| Fault {
        line,
        code: "turned-tool",
        message: message.to_owned(),
        hint: "write --tcp on, or --tcp off for positions of the axes",
    };
    if is_turned {
        let (_, upright) = control.tip_and_axis(&Command::default());
        let tilted = |stand: &Stand| angle(&stand.axis, &upright) > POLE_RAD;
        let line = path.strokes.ends().iter().position(tilted);
        let message = "a rotary axis is turned here: tool length compensation does not follow it";
        return Err(refused(line.map_or(0, |index| path.strokes.line(index)), message));
    }
    let tip = machine.tip_mm();
    let straight = tip.x.hypot(tip.y) < 1e-9 && tip.z <= 0.0;
    let placed = |tip: Vec3| {
        let mut command = Command::default();
        control.place(tip, &mut command).then_some(command)
    };
    let at = |i: usize| placed(Vec3::ith(i, 1000.0));
    let parallel = (0..3).all(|i| {
        let (Some(from), Some(to)) = (placed(Vec3::zeros()), at(i)) else { return false };
        machine.axes().iter().enumerate().all(|(k, axis)| {
            let wanted = if axis.name.letter() == ['X', 'Y', 'Z'][i] { 1000.0 } else { 0.0 };
            (to[k] - from[k] - wanted).abs() < 1e-6
        })
    });
    match straight && parallel {
        true => Ok(()),
        false => Err(refused(
            0,
            "the tool or the linear axes are not parallel to the axes of the workpiece",
        )),
    }
}

fn explained(line: u32, fault: &FollowFault) -> Fault {
    let (code, hint) = match fault {
        FollowFault::Solve(_) => {
            ("unreachable", "take a machine whose rotary axes reach it, or turn the part")
        }
        FollowFault::LeavesTravel { .. } => ("leaves-travel", "no program is written"),
        FollowFault::Jump { .. } => ("no-continuous-motion", "put points between the two"),
    };
    Fault { line, code, message: fault.to_string(), hint }
}
