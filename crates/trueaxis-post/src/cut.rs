//! Cuts strokes so that what the control does between two blocks stays near the stroke.

use crate::axes::Leg;
use crate::path::{Path, Stand, Stroke, Turn, Way, between};
use crate::{Fault, PostOptions};
use trueaxis_geometry::frame::Direction;
use trueaxis_geometry::{Vec3, angle};
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{AxisKind, Command};
use trueaxis_machine::tcp::{POLE_RAD, TipControl};
use trueaxis_nc::Control;
use trueaxis_writer::TipWords;

/// A stroke is halved so often at most.
const MOST_HALVINGS: u32 = 20;

/// Pieces are cut within this share of the tolerances: between the places that are examined, and by
/// rounding, they come out wider.
const SHARE: f64 = 0.8;

/// What the control keeps straight between two blocks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Between {
    /// Every axis.
    Axes,
    /// The tip and every rotary axis.
    TipAndAngles,
    /// The tip; the tool axis stays in the plane of both.
    TipAndVector,
}

/// Cuts strokes for one machine.
#[derive(Debug)]
pub(crate) struct Cutter<'c> {
    pub machine: &'c Machine,
    pub control: &'c TipControl,
    pub options: &'c PostOptions,
    between: Between,
    tolerance_mm: f64,
    axis_tolerance_rad: f64,
    rotary: Vec<usize>,
    /// Of the angles that are written.
    half_increment_rad: f64,
    /// The linear axes are those that place the tip, and no others.
    pub has_three_linear: bool,
    /// 10 to the decimals of written angles.
    angle_scale: f64,
    /// 10 to the decimals of written vectors; `None` where angles are written.
    vector_scale: Option<f64>,
}

/// A place on a stroke with its axis positions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Node {
    /// 1 at the end of the stroke.
    pub u: f64,
    pub stand: Stand,
    pub command: Command,
}

impl<'c> Cutter<'c> {
    pub fn new(machine: &'c Machine, control: &'c TipControl, options: &'c PostOptions) -> Self {
        let between = match (options.tip_words, options.control) {
            (None, _) => Between::Axes,
            (Some(TipWords::Vectors), Control::Sinumerik840d | Control::Heidenhain) => {
                Between::TipAndVector
            }
            // FANUC turns its rotary axes evenly with G43.5 too.
            (Some(_), _) => Between::TipAndAngles,
        };
        let kind = |i: &usize| machine.axes()[*i].kind == AxisKind::Rotary;
        let rotary: Vec<usize> = (0..machine.axes().len()).filter(kind).collect();
        Self {
            machine,
            control,
            options,
            between,
            tolerance_mm: SHARE * options.tolerance_mm,
            axis_tolerance_rad: SHARE * options.axis_tolerance_rad,
            half_increment_rad: 0.5 * 10_f64.powi(-i32::from(options.decimals.angle)).to_radians(),
            has_three_linear: machine.axes().len() == 3 + rotary.len(),
            rotary,
            angle_scale: 10_f64.powi(i32::from(options.decimals.angle)),
            vector_scale: (options.tip_words == Some(TipWords::Vectors))
                .then(|| 10_f64.powi(i32::from(options.decimals.vector))),
        }
    }

    /// Whether tool axes are written as vectors.
    pub fn has_vectors(&self) -> bool {
        self.vector_scale.is_some()
    }

    /// The end of a stroke of a leg.
    pub fn end_of(&self, path: &Path, leg: &Leg<'_>, index: usize) -> Node {
        let stand = path.strokes.to(index);
        Node { u: 1.0, stand, command: self.exact(&stand, &leg.command(path, index)) }
    }

    /// The rotary axes as they are printed, and the linear axes that go with exactly them.
    pub fn exact(&self, stand: &Stand, command: &Command) -> Command {
        if self.has_vectors() {
            return *command;
        }
        self.printed(stand, command).unwrap_or(*command)
    }

    fn printed(&self, stand: &Stand, command: &Command) -> Option<Command> {
        let mut printed = *command;
        self.round(&mut printed);
        self.control.place(stand.tip, &mut printed).then_some(printed)
    }

    fn round(&self, command: &mut Command) {
        for &axis in &self.rotary {
            let q = &mut command[axis];
            *q = ((q.to_degrees() * self.angle_scale).round_ties_even() / self.angle_scale)
                .to_radians();
        }
    }

    /// What is printed at ends in a row of which the rotary axes are known; `false` where that is not enough.
    pub fn print_ends(&self, tips: &[Vec3], commands: &mut [Command]) -> bool {
        if !self.has_three_linear || self.has_vectors() {
            return false;
        }
        commands.iter_mut().for_each(|command| self.round(command));
        self.control.place_all(tips, commands)
    }

    /// Hands out the ends of the pieces of a stroke from `from` to `to`, which is its end.
    pub fn cut(
        &self,
        stroke: &Stroke,
        from: &Node,
        to: Command,
        out: &mut dyn FnMut(&Node) -> Result<(), Fault>,
    ) -> Result<(), Fault> {
        let begin = Node { u: 0.0, ..*from };
        let end = Node { u: 1.0, stand: stroke.to, command: to };
        let turn = Turn::between(&begin.stand.axis, &stroke.to.axis);
        let on_stroke = |u: f64| stroke.on(&begin.stand, &turn, u);
        let mut at = begin;
        // Ends of pieces that wait; the next one on top.
        let mut wait = vec![(end, 0)];
        while let Some((next, halvings)) = wait.pop() {
            let next = self.as_the_control_turns(&at, next);
            if self.is_near(stroke, on_stroke, &at, &next) {
                out(&next)?;
                at = next;
                continue;
            }
            if halvings >= MOST_HALVINGS {
                return Err(too_coarse(stroke));
            }
            let middle = self.middle(stroke, on_stroke, &at, &next)?;
            wait.push((next, halvings + 1));
            wait.push((middle, halvings + 1));
        }
        Ok(())
    }

    /// Of a written vector the control takes the pose nearest to where it is, whatever was meant.
    fn as_the_control_turns(&self, at: &Node, next: Node) -> Node {
        let Some(scale) = self.vector_scale else { return next };
        let written = next.stand.axis.map(|v| (v * scale).round_ties_even() / scale);
        let Some(direction) = Direction::of(written) else { return next };
        let (_, axis) = self.control.tip_and_axis(&at.command);
        let mut command = at.command;
        if angle(&axis, &direction.vector()) >= POLE_RAD {
            match self.control.aim(direction, &at.command) {
                Ok(aimed) => command = aimed[0].command,
                Err(_) => return next,
            }
        }
        match self.control.place(next.stand.tip, &mut command) {
            true => Node { command, ..next },
            false => next,
        }
    }

    /// Whether a whole line can be left to the control at a glance: sufficient for [`Self::is_near`].
    ///
    /// The control turns all rotary axes evenly, by T in all, the tool axis of the file by θ: halfway both are
    /// no farther than T²/8 and θ²/8 from the middles of their chords, and the ends of these chords are as far
    /// apart as the least increment is wide. The tip is on the line.
    pub fn is_near_at_a_glance(&self, stroke: &Stroke, from: &Node, to: &Command) -> bool {
        let turned = |&i: &usize| (to[i] - from.command[i]).abs();
        let total: f64 = self.rotary.iter().map(turned).sum();
        let turn = (stroke.to.axis - from.stand.axis).norm_squared();
        let ends = 1e-9 + self.rotary.len() as f64 * self.half_increment_rad;
        self.between == Between::TipAndAngles
            && stroke.way == Way::Line
            && turn <= 1.0
            && (total * total + 1.2 * turn) / 8.0 + ends <= 0.8 * self.axis_tolerance_rad.min(1.0)
    }

    fn turns(&self, a: &Node, b: &Node) -> bool {
        self.rotary.iter().any(|&i| a.command[i] != b.command[i])
    }

    /// Whether the control, left alone from a to b, stays within the tolerances.
    ///
    /// max |tip(u) − s(u)| ≤ ε,  max ∠(a(u), s_a(u)) ≤ φ,  u = ¼, ½, ¾      docs/model.md eq. 121
    fn is_near(
        &self,
        stroke: &Stroke,
        on_stroke: impl Fn(f64) -> Stand,
        a: &Node,
        b: &Node,
    ) -> bool {
        if stroke.way == Way::Line && !self.turns(a, b) {
            return true;
        }
        [0.5, 0.25, 0.75].into_iter().all(|t| {
            let wanted = on_stroke(a.u + (b.u - a.u) * t);
            let is = self.between(a, b, t);
            (is.tip - wanted.tip).norm() <= self.tolerance_mm
                && is_within(&is.axis, &wanted.axis, self.axis_tolerance_rad)
        })
    }

    /// Where the control is at t between two blocks.
    fn between(&self, a: &Node, b: &Node, t: f64) -> Stand {
        let straight = a.stand.tip + (b.stand.tip - a.stand.tip) * t;
        if self.between == Between::TipAndVector {
            return Stand { tip: straight, axis: between(&a.stand.axis, &b.stand.axis, t) };
        }
        let (tip, axis) = self.control.tip_and_axis(&mixed(a, b, t));
        match self.between {
            Between::Axes => Stand { tip, axis },
            _ => Stand { tip: straight, axis },
        }
    }

    /// The axis positions halfway on the stroke, next to those halfway between its ends.
    fn middle(
        &self,
        stroke: &Stroke,
        on_stroke: impl Fn(f64) -> Stand,
        a: &Node,
        b: &Node,
    ) -> Result<Node, Fault> {
        let u = 0.5 * (a.u + b.u);
        let stand = on_stroke(u);
        let near = mixed(a, b, 0.5);
        let mut command = near;
        let (_, axis) = self.control.tip_and_axis(&near);
        if angle(&axis, &stand.axis) > 1e-12 {
            let direction = Direction::of(stand.axis).unwrap_or(Direction::Z);
            let aimed = self.control.aim(direction, &near).map_err(|e| Fault {
                line: stroke.line,
                code: "unreachable",
                message: format!("on the way to this point: {e}"),
                hint: "take a machine whose rotary axes reach it, or turn the part",
            })?;
            command = aimed[0].command;
            let swings = |&i: &usize| {
                let room = (b.command[i] - a.command[i]).abs().max(0.1);
                (command[i] - near[i]).abs() > room
            };
            if self.rotary.iter().any(swings) {
                return Err(Fault {
                    line: stroke.line,
                    code: "no-continuous-motion",
                    message: "the rotary axes would have to jump on the way to this point".into(),
                    hint: "put points between, or let the path pass the pole: --pole-tolerance",
                });
            }
        }
        if !self.control.place(stand.tip, &mut command) {
            return Err(Fault {
                line: stroke.line,
                code: "unreachable",
                message: "the linear axes do not reach a place on the way to this point".into(),
                hint: "turn the part, or take another machine",
            });
        }
        self.inside(&command, stroke.line)?;
        Ok(Node { u, stand, command })
    }

    /// Whether all axes stay within their travel.
    pub fn inside(&self, command: &Command, line: u32) -> Result<(), Fault> {
        let leaves = self.machine.axes().iter().zip(command).find(|(a, q)| !a.travel.contains(**q));
        match leaves {
            None => Ok(()),
            Some((axis, q)) => {
                let shown = match axis.kind {
                    AxisKind::Linear => format!("{q:.4} mm"),
                    AxisKind::Rotary => format!("{:.4} deg", q.to_degrees()),
                };
                Err(Fault {
                    line,
                    code: "leaves-travel",
                    message: format!(
                        "{} would go to {shown}, outside its travel, on the way to this point",
                        axis.name
                    ),
                    hint: "move or turn the part; no program is written",
                })
            }
        }
    }
}

/// Whether two unit vectors are no farther apart than an angle, which is mostly small.
fn is_within(a: &Vec3, b: &Vec3, rad: f64) -> bool {
    match rad < 1.0 {
        true => a.dot(b) > 0.0 && a.cross(b).norm_squared() <= rad.sin().powi(2),
        false => angle(a, b) <= rad,
    }
}

fn mixed(a: &Node, b: &Node, t: f64) -> Command {
    std::array::from_fn(|i| a.command[i] + (b.command[i] - a.command[i]) * t)
}

fn too_coarse(stroke: &Stroke) -> Fault {
    Fault {
        line: stroke.line,
        code: "not-within-tolerance",
        message: format!(
            "2^{MOST_HALVINGS} pieces do not bring the way to this point within the tolerances"
        ),
        hint: "allow a larger --tolerance or --axis-tolerance, or let the path pass the pole: \
               --pole-tolerance",
    }
}
