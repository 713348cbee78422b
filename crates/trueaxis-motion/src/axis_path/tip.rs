//! Moves of the tip, with tool-centre point or in a swivelled plane.

use super::axes::between;
use super::elements::sampled;
use super::fault::{fault, too_many_pieces, unreachable};
use super::{AxisPath, Fault, PathStep, Speed, fraction, path_length};
use crate::basic::{nearest, nearest_to};
use crate::curve::Curve;
use crate::densify::MOST_PIECES;
use crate::orientation::{NoSwing, Swing};
use crate::timing::Element;
use trueaxis_geometry::Vec3;
use trueaxis_geometry::frame::Direction;
use trueaxis_machine::SolveError;
use trueaxis_machine::axis::{AxisKind, Command};
use trueaxis_machine::tcp::TipControl;
use trueaxis_nc::moves::{Axis, Cone, Move, OrientationPath};

/// A move of the tip while it is being cut into pieces.
struct TipMove<'a> {
    control: &'a TipControl,
    m: &'a Move,
    curve: &'a Curve,
    turning: &'a Turning,
    /// Where the axes stood.
    begin: Command,
    /// The length that the feed counts along.
    length: f64,
    speed: f64,
}

/// Basic coordinates and axes.
type TipPose = (Vec3, Command);

/// A tool axis that turns less than this from pose to pose may be held, rad; see [`nearest`].
const HARDLY_RAD: f64 = 1e3 * trueaxis_machine::tcp::POLE_RAD;

/// A piece is halved so often at most: near a pole an axis may jump however small the piece.
const MOST_HALVINGS: u32 = 14;

/// How the tool axis turns in a move of the tip.
enum Turning {
    /// The rotary axes go evenly to these positions.
    Axes(Command),
    /// The tool axis swings; the axes end here if angles are programmed.
    Swing(Swing, Option<Command>),
}

impl AxisPath<'_> {
    /// The tip goes along the curve while the tool axis turns as programmed.
    pub(super) fn tip_move(
        &mut self,
        m: &Move,
        curve: &Curve,
        feed: Speed,
        out: &mut dyn FnMut(PathStep),
    ) -> Result<(), Fault> {
        let Some(control) = self.control.take() else { return Ok(()) };
        let done = self.tip_move_with(&control, m, curve, feed, out);
        self.control = Some(control);
        done
    }

    fn tip_move_with(
        &mut self,
        control: &TipControl,
        m: &Move,
        curve: &Curve,
        feed: Speed,
        out: &mut dyn FnMut(PathStep),
    ) -> Result<(), Fault> {
        let turning = self.turning(control, m)?;
        let begin = self.command;
        let turned = match &turning {
            Turning::Axes(end) => self.rotary_way(&begin, end),
            Turning::Swing(swing, _) => swing.travelled_rad(),
        };
        let length_mm = curve.length_mm() * self.scale(curve);
        let length = path_length(length_mm, turned);
        let pieces = self.count(m, curve, length_mm, turned)?;
        let tip_move = TipMove {
            control,
            m,
            curve,
            turning: &turning,
            begin,
            length,
            speed: feed.along(length),
        };
        self.announce(length, || self.tip_element(&tip_move, turned), out);
        for k in 1..=pieces {
            self.advance(&tip_move, [fraction(k - 1, pieces), fraction(k, pieces)], 0, None, out)?;
        }
        if let Turning::Swing(swing, _) = &turning {
            self.tangent = swing.end_tangent();
            if matches!(self.orientation, OrientationPath::Cone(_)) {
                self.orientation = OrientationPath::GreatCircle;
            }
        }
        Ok(())
    }

    /// Goes on from u0 to u1, in smaller pieces where the tip would leave the path, or a rotary
    /// axis turn too far, while the axes go straight between nodes. `known` is the pose at u1 as
    /// seen from u0, if it was computed before.
    fn advance(
        &mut self,
        tip_move: &TipMove<'_>,
        [u0, u1]: [f64; 2],
        halvings: u32,
        known: Option<TipPose>,
        out: &mut dyn FnMut(PathStep),
    ) -> Result<(), Fault> {
        let pose = known.map_or_else(|| self.tip_pose(tip_move, u1, &self.command), Ok);
        let (basic, command) = pose.map_err(|error| unreachable(tip_move.m, &error))?;
        if halvings < MOST_HALVINGS {
            let middle = 0.5 * (u0 + u1);
            if let Some(there) = self.coarse(tip_move, middle, &command) {
                self.advance(tip_move, [u0, middle], halvings + 1, there, out)?;
                return self.advance(tip_move, [middle, u1], halvings + 1, None, out);
            }
        }
        self.pieces += 1;
        if f64::from(self.pieces) > MOST_PIECES {
            return Err(too_many_pieces(tip_move.m));
        }
        if let Turning::Swing(swing, None) = tip_move.turning
            && self.rotary_way(&self.command, &command) > 0.0
        {
            self.aimed = (command, swing.at(u1));
        }
        (self.basic, self.command) = (basic, command);
        out(self.next(tip_move.m, tip_move.length * (u1 - u0), tip_move.speed, u1 == 1.0));
        Ok(())
    }

    /// Whether the piece to `end` is too coarse, then with the pose in its middle where that was
    /// computed.
    fn coarse(
        &self,
        tip_move: &TipMove<'_>,
        middle: f64,
        end: &Command,
    ) -> Option<Option<TipPose>> {
        let (angle_rad, chord_mm) = self.densify.limits_of_pieces()?;
        let turned = self.rotary_way(&self.command, end);
        if turned == 0.0 {
            return None;
        }
        let axes = self.machine.axes().iter().zip(self.command.iter().zip(end));
        let far = |(axis, (a, b)): (&trueaxis_machine::axis::Axis, (&f64, &f64))| {
            axis.kind == AxisKind::Rotary && (b - a).abs() > angle_rad * (1.0 + 1e-9)
        };
        if axes.into_iter().any(far) {
            return Some(None);
        }
        let tool = self.densify.limits_of_tool();
        if chord_mm.is_infinite() && tool.is_none() {
            return None;
        }
        let (there, at) = self.tip_pose(tip_move, middle, &self.command).ok()?;
        if let Some([chord_mm, reach_mm]) = tool {
            // The tip goes as programmed: only the axis may turn otherwise than evenly.
            let axis = |command: &Command| tip_move.control.tip_and_axis(command).1;
            let even = (axis(&self.command) + axis(end)).normalize();
            let leaves = reach_mm * (axis(&at) - even).norm() > chord_mm;
            return leaves.then_some(Some((there, at)));
        }
        let between = std::array::from_fn(|i| 0.5 * (self.command[i] + end[i]));
        let tip = tip_move.control.tip_and_axis(&between).0;
        let leaves = (tip - self.place_in_workpiece(there)).norm() > chord_mm;
        leaves.then_some(Some((there, at)))
    }

    /// How the axes go on the whole move; `None` where they cannot.
    fn tip_element(&self, tip_move: &TipMove<'_>, turned: f64) -> Option<Element> {
        let (begin, length) = (&tip_move.begin, tip_move.length);
        let mut at = |u: [f64; 4], near: &Command| self.four_poses(tip_move, u, near);
        let Turning::Axes(end) = tip_move.turning else {
            return sampled(begin, length, turned, &mut at);
        };
        if self.rotary_way(begin, end) > 0.0 {
            let sweep = match *tip_move.curve {
                Curve::Line { .. } => 0.0,
                Curve::Helix { sweep, .. } => sweep.abs(),
            };
            return sampled(begin, length, turned.max(sweep), &mut at);
        }
        // Without rotary axes the linear ones follow the tip in a fixed frame.
        let end = self.tip_pose(tip_move, 1.0, begin).ok()?.1;
        let place = |basic: Vec3| {
            let mut command = *begin;
            let reached = tip_move.control.place(self.place_in_workpiece(basic), &mut command);
            reached.then_some(command)
        };
        let origin = place(self.basic)?;
        let mut columns = [Command::default(); 3];
        for (column, unit) in columns.iter_mut().zip([Vec3::x(), Vec3::y(), Vec3::z()]) {
            let there = place(self.basic + unit)?;
            *column = std::array::from_fn(|i| there[i] - origin[i]);
        }
        let to_axes = |v: Vec3| {
            let v = self.frame.vector(v.into());
            std::array::from_fn(|i| (0..3).map(|k| columns[k][i] * v[k]).sum())
        };
        Some(Self::element_of_axes(tip_move.curve, [begin, &end], length, to_axes))
    }

    /// Basic coordinates and axes at u of a move of the tip, near other axis positions.
    fn tip_pose(
        &self,
        tip_move: &TipMove<'_>,
        u: f64,
        near: &Command,
    ) -> Result<TipPose, SolveError> {
        let begin = &tip_move.begin;
        let mut command = match tip_move.turning {
            Turning::Axes(end) if u == 1.0 => *end,
            Turning::Axes(end) => between(begin, end, u),
            Turning::Swing(_, Some(end)) if u == 1.0 => *end,
            Turning::Swing(swing, _) => {
                let direction = Direction::of(swing.at(u)).unwrap_or(Direction::Z);
                let axis = self.tool_axis(tip_move.control, near);
                nearest_to(tip_move.control, direction, (near, axis))?
            }
        };
        let basic = self.in_basic(tip_move.curve.at(u));
        if !tip_move.control.place(self.place_in_workpiece(basic), &mut command) {
            let moving = self.machine.axes().iter().filter(|a| a.kind == AxisKind::Linear);
            let moving = moving.map(|a| a.name).collect();
            return Err(SolveError::TipUnreachable { missed_by_mm: f64::NAN, moving });
        }
        Ok((basic, command))
    }

    /// The axes at four u of a move of the tip, one after the other, the first near other axis positions.
    fn four_poses(
        &self,
        tip_move: &TipMove<'_>,
        u: [f64; 4],
        near: &Command,
    ) -> Option<[Command; 4]> {
        let TipMove { control, begin, .. } = tip_move;
        let mut commands = match tip_move.turning {
            Turning::Axes(end) => u.map(|u| if u == 1.0 { *end } else { between(begin, end, u) }),
            Turning::Swing(swing, _) if swing.travelled_rad() * (u[1] - u[0]) < HARDLY_RAD => {
                return self.one_by_one(tip_move, u, near);
            }
            Turning::Swing(swing, end) => {
                let directions = u.map(|u| Direction::of(swing.at(u)).unwrap_or(Direction::Z));
                let mut commands = control.aim_four(&directions, near).ok()?;
                if let (Some(end), 1.0) = (end, u[3]) {
                    commands[3] = *end;
                }
                commands
            }
        };
        let tips = u.map(|u| self.place_in_workpiece(self.in_basic(tip_move.curve.at(u))));
        control.place_four(&tips, &mut commands).then_some(commands)
    }

    /// The same where the tool hardly turns and may keep its axes: each pose looks at the one before.
    fn one_by_one(
        &self,
        tip_move: &TipMove<'_>,
        u: [f64; 4],
        near: &Command,
    ) -> Option<[Command; 4]> {
        let mut commands = [*near; 4];
        let mut last = *near;
        for (command, u) in commands.iter_mut().zip(u) {
            last = self.tip_pose(tip_move, u, &last).ok()?.1;
            *command = last;
        }
        Some(commands)
    }

    /// The tool axis at axis positions.
    fn tool_axis(&self, control: &TipControl, command: &Command) -> Vec3 {
        let (at, axis) = &self.aimed;
        if at == command { *axis } else { control.tip_and_axis(command).1 }
    }

    /// How the tool axis gets to the end of a move.
    fn turning(&self, control: &TipControl, m: &Move) -> Result<Turning, Fault> {
        let axes = self.other_axes(m);
        let wanted = match m.direction {
            Some(direction) => Some(self.direction_in_workpiece(m, direction)?),
            None => None,
        };
        let cone = match self.orientation {
            OrientationPath::Axes => {
                let Some(wanted) = wanted else { return Ok(Turning::Axes(axes)) };
                let end =
                    nearest(control, wanted, &self.command).map_err(|e| unreachable(m, &e))?;
                return Ok(Turning::Axes(end));
            }
            OrientationPath::GreatCircle => None,
            OrientationPath::Cone(cone) => Some(cone),
        };
        let rotary = Axis::ALL[3..6].iter().any(|a| m.named.contains(*a));
        // Angles under ORIVECT: their direction counts, and the axes end on them.
        let end = (wanted.is_none() && rotary).then_some(axes);
        let to = wanted.map(|d| d.vector()).or(end.map(|end| control.tip_and_axis(&end).1));
        let now = self.tool_axis(control, &self.command);
        let swing = match cone {
            Some(cone) => {
                let cone = self.cone_in_workpiece(&cone);
                Swing::cone(now, to, &cone, self.tangent)
            }
            None if to.is_none() => return Ok(Turning::Axes(axes)),
            None => Swing::great_circle(now, to.unwrap_or(now)),
        };
        let swing = swing.map_err(|why| no_swing(m, why))?;
        // A tool that does not turn keeps its axes, also at a pole.
        match swing.angle_rad == 0.0 && end.is_none() {
            true => Ok(Turning::Axes(axes)),
            false => Ok(Turning::Swing(swing, end)),
        }
    }

    fn cone_in_workpiece(&self, cone: &Cone) -> Cone {
        let turned = |v: [f64; 3]| (self.turn * Vec3::from(self.frame.vector(v))).into();
        Cone { axis: cone.axis.map(turned), through: cone.through.map(turned), ..*cone }
    }
}

fn no_swing(m: &Move, why: NoSwing) -> Fault {
    let (code, message, hint) = match why {
        NoSwing::Opposite => (
            "opposite-directions",
            "the tool axis turns by 180 deg: the plane of the rotation is not determined",
            "insert a direction between the two",
        ),
        NoSwing::NotOnCone => (
            "not-on-cone",
            "the two directions of the tool do not lie on one cone about the given axis",
            "correct A6 B6 C6 or the direction at the end",
        ),
        NoSwing::Undetermined => (
            "undetermined-cone",
            "the cone of the tool axis is not determined",
            "give A6 B6 C6, A7 B7 C7, NUT, or the direction at the end",
        ),
    };
    fault(m, None, code, message.to_owned(), hint)
}
