//! From strokes to axis positions: poles, branches, turns, and where the tool must go back.

use crate::path::{Path, Stroke, Way, between};
use crate::{Fault, PostOptions};
use trueaxis_geometry::frame::{Direction, Point};
use trueaxis_geometry::{Vec3, angle};
use trueaxis_machine::axis::{AxisKind, Command};
use trueaxis_machine::tcp::TipControl;
use trueaxis_machine::{FollowFault, Machine, Target};
use trueaxis_writer::TipWords;

/// Nearer to a pole than this the tool axis is taken for the pole: an angle that no part shows.
const POLE_RAD: f64 = 2e-7;

/// A stroke near a pole is cut at most so often.
const MOST_CUTS: u32 = 60;

/// Strokes in a row that one continuous motion makes, and the axis positions at their ends.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Leg {
    /// The stroke at whose end the leg begins.
    pub first: usize,
    /// Whether that stroke is still to be cut by this leg.
    pub cuts_first: bool,
    /// At the end of each stroke from there on.
    pub commands: Vec<Command>,
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
    for stroke in &mut path.strokes {
        stroke.to.axis = onto_pole(stroke.to.axis);
    }
    let (mut strokes, mut moved) = (Vec::with_capacity(path.strokes.len()), Vec::new());
    for (i, stroke) in path.strokes.iter().enumerate() {
        moved.push(strokes.len());
        if i > 0 {
            let from = path.strokes[i - 1].to;
            let cuts = cuts_at_pole(&from.axis, &stroke.to.axis, &pole, near);
            let mut before = 0.0;
            for u in cuts {
                let mut to = stroke.at(&from, u);
                to.axis = onto_pole(to.axis);
                strokes.push(Stroke { to, way: part(&stroke.way, u - before), ..*stroke });
                before = u;
            }
            strokes.push(Stroke { way: part(&stroke.way, 1.0 - before), ..*stroke });
        } else {
            strokes.push(*stroke);
        }
    }
    moved.push(strokes.len());
    for (at, _) in &mut path.events {
        *at = moved[*at];
    }
    for hole in &mut path.holes {
        (hole.begin, hole.down) = (moved[hole.begin], moved[hole.down]);
        hole.last = moved[hole.last + 1] - 1;
    }
    path.strokes = strokes;
    // What is below the digits of programs is not reported as a deviation.
    if most > POLE_RAD { most } else { 0.0 }
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

/// Axis positions for all strokes, in as few legs as continuous motions allow.
pub(crate) fn legs(machine: &Machine, path: &Path) -> Result<Vec<Leg>, Fault> {
    let target = |stroke: &Stroke| Target {
        tip: Point::from_vector(stroke.to.tip),
        axis: Direction::of(stroke.to.axis).unwrap_or(Direction::Z),
    };
    let targets: Vec<Target> = path.strokes.iter().map(target).collect();
    let mut legs: Vec<Leg> = Vec::new();
    let mut from = Command::default();
    let mut begins: Vec<usize> = vec![0];
    let changes = path.events.iter().filter(|(_, e)| matches!(e, crate::path::Event::Tool { .. }));
    begins.extend(changes.map(|(at, _)| *at).filter(|at| *at > 0 && *at < targets.len()));
    begins.dedup();
    begins.push(targets.len());
    for ends in begins.windows(2) {
        let (mut first, end, mut cuts_first) = (ends[0], ends[1], true);
        while first < end {
            let (commands, jump) = machine
                .follow_on(&targets[first..end], &from)
                .map_err(|e| explained(path.strokes[first + e.index].line, &e.fault))?;
            let reached = first + commands.len();
            if let Some(jump) = jump.filter(|_| commands.len() < 2 && !cuts_first) {
                return Err(explained(path.strokes[reached].line, &jump.fault));
            }
            from = *commands.last().unwrap_or(&from);
            legs.push(Leg { first, cuts_first, commands });
            if reached == end {
                break;
            }
            // The next leg begins where this one ends, turned otherwise.
            (first, cuts_first) = (reached - 1, false);
        }
    }
    Ok(legs)
}

/// With tool length compensation alone the places of the program are those of the tip only where no rotary axis is
/// turned and the linear axes are parallel to the workpiece frame.
pub(crate) fn check_upright(
    machine: &Machine,
    control: &TipControl,
    path: &Path,
    legs: &[Leg],
    options: &PostOptions,
) -> Result<(), Fault> {
    if options.tip_words != Some(TipWords::Length) {
        return Ok(());
    }
    let refused = |line, message: &str| Fault {
        line,
        code: "turned-tool",
        message: message.to_owned(),
        hint: "write --tcp on, or --tcp off for positions of the axes",
    };
    let turned = |command: &Command| {
        let mut axes = machine.axes().iter().zip(command);
        axes.any(|(axis, q)| axis.kind == AxisKind::Rotary && q.abs() > POLE_RAD)
    };
    if legs.iter().any(|leg| leg.commands.iter().any(turned)) {
        let (_, upright) = control.tip_and_axis(&Command::default());
        let tilted = |stroke: &&Stroke| angle(&stroke.to.axis, &upright) > POLE_RAD;
        let line = path.strokes.iter().find(tilted).map_or(0, |stroke| stroke.line);
        let message = "a rotary axis is turned here: tool length compensation does not follow it";
        return Err(refused(line, message));
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
