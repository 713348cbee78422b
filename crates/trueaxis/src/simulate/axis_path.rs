//! From programmed moves to axis positions: what the control commands.
//!
//! ```text
//!     without tool-centre point:   axes = frame(target) + tool length
//!     with it:                     tip in the workpiece = workpiece_from_basic · frame(target)
//!                                  rotary axes by ORIAXES, great circle or cone
//!                                  linear axes by TipControl::place
//! ```

use super::curve::Curve;
use super::densify::{Densify, MOST_PIECES};
use super::orientation::{NoSwing, Swing, angle};
use super::setup::SetUp;
use trueaxis_geometry::frame::{Direction, Pose, Workpiece};
use trueaxis_geometry::{Mat3, Vec3};
use trueaxis_machine::axis::{AxisKind, Command, Travel};
use trueaxis_machine::tcp::TipControl;
use trueaxis_machine::{Machine, SolveError};
use trueaxis_nc::moves::{
    Axis, AxisSet, Branch, Cone, Coordinates, Event, FeedMode, Frame, Move, MoveKind,
    OrientationPath, Origin, PathControl, Position, Step, Way,
};

/// One place of the path that the control commands.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Node {
    /// Axis positions, mm and rad.
    pub command: Command,
    /// The block.
    pub origin: Origin,
    /// The way from the node before along the programmed path: of the tip in mm; degrees of the
    /// rotary axes where only they move.
    pub length: f64,
    /// The programmed speed along the path, mm/s or deg/s; infinite in rapid.
    pub speed: f64,
    /// The last node of its move.
    pub last: bool,
    /// The axes come to rest here.
    pub stop: bool,
    /// How far the path may be rounded here, mm.
    pub rounding_mm: f64,
    /// The axes wait here, s.
    pub dwell_s: f64,
    /// The tip is programmed, not the axes.
    pub tip_programmed: bool,
}

impl Node {
    /// Whether the machine goes here as fast as it can.
    pub fn is_rapid(&self) -> bool {
        self.speed.is_infinite()
    }
}

/// What comes out of the path, in order.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum PathStep {
    /// The next place.
    Node(Node),
    /// Another tool is in the spindle from here on.
    Tool(u32),
}

/// Why a move could not be made.
#[derive(Debug, Clone, PartialEq)]
pub struct Fault {
    /// The block.
    pub origin: Origin,
    /// What it is about in the block, to find the column.
    pub word: Option<u8>,
    /// Short name.
    pub code: &'static str,
    /// What is wrong.
    pub message: String,
    /// What to do.
    pub hint: &'static str,
}

/// What the control knows while it runs.
pub(super) struct AxisPath<'m> {
    machine: &'m Machine,
    densify: Densify,
    /// The axis of the machine for each axis of programs.
    axis_of: [Option<usize>; 9],
    /// From basic coordinates to the workpiece frame of the machine file.
    turn: Mat3,
    shift: Vec3,
    /// Without a set-up the control takes the tool of the machine file for its tool length.
    lengths_known: bool,
    control: Option<TipControl>,
    frame: Frame,
    tool: Vec3,
    tcp: bool,
    tilted: bool,
    orientation: OrientationPath,
    exact: PathControl,
    rounding_mm: f64,
    default_rounding_mm: f64,
    revolutions_per_s: f64,
    command: Command,
    /// X, Y and Z of the present place in basic coordinates.
    basic: Vec3,
    /// Axes whose place the interpreter does not know.
    stale: AxisSet,
    /// In which direction the tool axis turned last.
    tangent: Option<Vec3>,
    pub faults: Vec<Fault>,
}

impl<'m> AxisPath<'m> {
    pub fn new(machine: &'m Machine, setup: &SetUp, densify: Densify, rounding_mm: f64) -> Self {
        let letters = Axis::ALL.map(|a| char::from(a.letter()));
        let index = |letter: char| machine.axes().iter().position(|a| a.name.letter() == letter);
        let axis_of = letters.map(index);
        let (turn, shift) = match setup.given {
            true => workpiece_from_basic(machine, &axis_of),
            false => (Mat3::identity(), Vec3::zeros()),
        };
        let mut path = Self {
            machine,
            densify,
            axis_of,
            turn,
            shift,
            lengths_known: setup.given,
            control: TipControl::of(machine),
            frame: Frame::IDENTITY,
            tool: Vec3::zeros(),
            tcp: false,
            tilted: false,
            orientation: OrientationPath::Axes,
            exact: PathControl::Continuous,
            rounding_mm,
            default_rounding_mm: rounding_mm,
            revolutions_per_s: 0.0,
            command: start(machine, setup, &axis_of),
            basic: Vec3::zeros(),
            stale: AxisSet::default(),
            tangent: None,
            faults: Vec::new(),
        };
        path.find_basic();
        path.stale = AxisSet::XYZ;
        path
    }

    /// Where the axes stand.
    pub fn command(&self) -> &Command {
        &self.command
    }

    /// From basic coordinates to the workpiece frame.
    pub fn place_in_workpiece(&self, basic: Vec3) -> Vec3 {
        self.turn * basic + self.shift
    }

    fn follows_tip(&self) -> bool {
        self.tcp || self.tilted
    }

    /// Executes a step of the program.
    pub fn take(&mut self, step: &Step, out: &mut dyn FnMut(PathStep)) {
        match step {
            Step::Move(m) => {
                if let Err(fault) = self.move_by(m, out) {
                    self.faults.push(fault);
                }
            }
            Step::Event(event, origin) => self.event(event, *origin, out),
        }
    }

    fn event(&mut self, event: &Event, origin: Origin, out: &mut dyn FnMut(PathStep)) {
        match event {
            Event::Frame(frame) => self.frame = *frame,
            Event::ToolLength(length) => {
                self.tool = Vec3::new(length.0[0], length.0[1], length.0[2]);
                self.fit_tip();
                self.find_basic();
            }
            Event::ToolChange(number) => out(PathStep::Tool(*number)),
            Event::ToolCentre(on) => {
                let needed = *on && self.control.is_none();
                self.tcp = *on && !needed;
                self.reread();
                if needed {
                    let message = "tool-centre-point control needs three linear axes".to_owned();
                    let hint = "run the program on another machine";
                    let code = "no-tcp";
                    self.faults.push(Fault { origin, word: None, code, message, hint });
                }
            }
            Event::TiltedPlane(on) => {
                self.tilted = *on && self.control.is_some();
                self.reread();
            }
            Event::Orientation(path) => self.orientation = *path,
            Event::SpindleSpeed(per_minute) => self.revolutions_per_s = per_minute.abs() / 60.0,
            Event::Path { control, tolerance_mm } => {
                self.exact = *control;
                self.rounding_mm = match tolerance_mm {
                    t if *t > 0.0 => *t,
                    _ => self.default_rounding_mm,
                };
            }
            _ => {}
        }
    }

    /// The control counts with the tool length that the program has switched on.
    fn fit_tip(&mut self) {
        if self.lengths_known {
            self.control = TipControl::of(&self.machine.clone().with_tip(-self.tool));
        }
    }

    /// After a change of what coordinates mean: the axes stay, the program place is another.
    fn reread(&mut self) {
        self.find_basic();
        self.stale = AxisSet::XYZ;
    }

    fn find_basic(&mut self) {
        self.basic = match &self.control {
            Some(control) if self.follows_tip() => {
                let tip = control.tip_and_axis(&self.command).0;
                self.turn.transpose() * (tip - self.shift)
            }
            _ => self.linear_axes(&self.command) - self.tool,
        };
    }

    fn linear_axes(&self, command: &Command) -> Vec3 {
        Vec3::from_fn(|i, _| self.axis_of[i].map_or(0.0, |axis| command[axis]))
    }

    /// The present place in the program frame.
    fn place(&self) -> Vec3 {
        let mut basic = Position::default();
        basic.0[..3].copy_from_slice(self.basic.as_slice());
        let place = self.frame.inverse_place(&basic).unwrap_or(basic);
        Vec3::new(place.0[0], place.0[1], place.0[2])
    }

    fn move_by(&mut self, m: &Move, out: &mut dyn FnMut(PathStep)) -> Result<(), Fault> {
        match m.kind {
            MoveKind::Dwell { seconds } => {
                let node = Node { dwell_s: seconds, ..self.node(m, 0.0, f64::INFINITY) };
                out(PathStep::Node(Node { stop: true, last: true, ..node }));
                return Ok(());
            }
            MoveKind::Align { keep_tip, branch } => return self.align(m, keep_tip, branch, out),
            _ => {}
        }
        self.refuse_unknown_axes(m)?;
        let feed = self.feed(m)?;
        if m.coordinates == Coordinates::Machine {
            return self.machine_move(m, feed, out);
        }
        let (from, to) = (self.place(), self.target(m));
        let curve = match &m.kind {
            MoveKind::Arc(arc) => Curve::arc(from, to, arc),
            MoveKind::SpatialArc(arc) => Curve::spatial(from, to, arc),
            _ => Curve::Line { from, to },
        };
        if self.follows_tip() {
            self.tip_move(m, &curve, feed, out)?;
        } else {
            self.axis_move(m, &curve, feed, out)?;
        }
        if let MoveKind::RigidTap { .. } = m.kind {
            // Out again by the same way; the interpreter counts on the place before.
            let back = Curve::Line { from: to, to: from };
            match self.follows_tip() {
                true => self.tip_move(m, &back, feed, out)?,
                false => self.axis_move(m, &back, feed, out)?,
            }
        }
        Ok(())
    }

    fn refuse_unknown_axes(&self, m: &Move) -> Result<(), Fault> {
        let missing = |a: &&Axis| m.named.contains(**a) && self.axis_of[**a as usize].is_none();
        let Some(axis) = Axis::ALL.iter().find(missing) else { return Ok(()) };
        let axes: Vec<String> = self.machine.axes().iter().map(|a| a.name.to_string()).collect();
        let message = format!("the machine has no axis {axis}; it has {}", axes.join(" "));
        let hint = "is the program written for another machine?";
        Err(fault(m, Some(axis.letter()), "unknown-axis", message, hint))
    }

    /// Where X, Y and Z lead in the program frame.
    fn target(&mut self, m: &Move) -> Vec3 {
        let mut to = Vec3::new(m.target.0[0], m.target.0[1], m.target.0[2]);
        if self.stale != AxisSet::default() {
            let now = self.place();
            for axis in [Axis::X, Axis::Y, Axis::Z] {
                if self.stale.contains(axis) && !m.named.contains(axis) {
                    to[axis as usize] = now[axis as usize];
                }
            }
            self.stale = AxisSet(self.stale.0 & !m.named.0);
        }
        to
    }

    /// The rotary and parallel axes at the end of a move.
    fn other_axes(&self, m: &Move) -> Command {
        let mut end = self.command;
        for axis in &Axis::ALL[3..] {
            let Some(index) = self.axis_of[*axis as usize].filter(|_| m.named.contains(*axis))
            else {
                continue;
            };
            let target = m.target[*axis] + self.frame.shift[*axis];
            end[index] = match axis.is_rotary() {
                true => {
                    let way = m.ways[*axis as usize - Axis::A as usize];
                    self.turned(index, target.to_radians(), way)
                }
                false => target,
            };
        }
        end
    }

    /// The angle that a rotary axis goes to.
    fn turned(&self, axis: usize, target: f64, way: Way) -> f64 {
        let (now, turn) = (self.command[axis], std::f64::consts::TAU);
        let travel = self.machine.axes()[axis].travel;
        match way {
            Way::AsWritten => target,
            Way::Shortest => {
                let near = target + turn * ((now - target) / turn).round();
                let others = [near, near - turn, near + turn];
                let inside = others.into_iter().filter(|q| travel.contains(*q));
                let distance = |q: &f64| (q - now).abs();
                inside.min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap_or(near)
            }
            Way::Positive => target + turn * ((now - target) / turn - 1e-9).ceil(),
            Way::Negative => target + turn * ((now - target) / turn + 1e-9).floor(),
        }
    }

    /// The speed along the path, or the time of the whole move.
    fn feed(&mut self, m: &Move) -> Result<Speed, Fault> {
        let spindle = self.revolutions_per_s;
        match (m.kind, m.feed.mode) {
            (MoveKind::Rapid, _) => Ok(Speed::Rapid),
            (MoveKind::Thread { pitch_mm } | MoveKind::RigidTap { pitch_mm }, _)
                if spindle > 0.0 =>
            {
                Ok(Speed::PerSecond(pitch_mm.abs() * spindle))
            }
            (_, FeedMode::PerRevolution)
            | (MoveKind::Thread { .. } | MoveKind::RigidTap { .. }, _)
                if spindle == 0.0 =>
            {
                let message = "a feed per revolution while the spindle has no speed".to_owned();
                Err(fault(m, Some(b'F'), "no-spindle-speed", message, "write S before it"))
            }
            (_, FeedMode::PerRevolution) => Ok(Speed::PerSecond(m.feed.value * spindle)),
            (_, FeedMode::InverseTime) => Ok(Speed::Lasting(60.0 / m.feed.value)),
            (_, FeedMode::PerMinute) => Ok(Speed::PerSecond(m.feed.value / 60.0)),
        }
    }

    /// The axes go straight to their positions; circles by their chords.
    fn axis_move(
        &mut self,
        m: &Move,
        curve: &Curve,
        feed: Speed,
        out: &mut dyn FnMut(PathStep),
    ) -> Result<(), Fault> {
        if m.direction.is_some() {
            let message = "a tool direction without tool-centre-point control".to_owned();
            let hint = "switch it on before: TRAORI, G43.5, M128";
            return Err(fault(m, None, "direction-without-tcp", message, hint));
        }
        let (begin, end) = (self.command, self.other_axes(m));
        let turned = self.rotary_way(&begin, &end);
        let straight = matches!(curve, Curve::Line { .. });
        let scale = self.scale(curve);
        let length_mm = curve.length_mm() * scale;
        let pieces = self.count(m, curve, length_mm, turned)?;
        let length = path_length(length_mm, turned);
        let speed = feed.along(length);
        let mut command = begin;
        for k in 1..=pieces {
            let u = fraction(k, pieces);
            for (i, q) in command.iter_mut().enumerate() {
                *q = if u == 1.0 { end[i] } else { begin[i] + (end[i] - begin[i]) * u };
            }
            if !straight || u == 1.0 {
                self.basic = self.in_basic(curve.at(u));
                self.set_linear(&mut command, self.basic + self.tool);
            } else {
                let goal = self.in_basic(curve.at(1.0)) + self.tool;
                let start = self.linear_axes(&begin);
                self.set_linear(&mut command, start + (goal - start) * u);
            }
            self.command = command;
            out(self.next(m, length / f64::from(pieces), speed, k == pieces));
        }
        Ok(())
    }

    /// The tip goes along the curve while the tool axis turns as programmed.
    fn tip_move(
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
        let way = TipWay {
            control,
            m,
            curve,
            turning: &turning,
            begin,
            length,
            speed: feed.along(length),
        };
        for k in 1..=pieces {
            self.advance(&way, fraction(k - 1, pieces), fraction(k, pieces), 0, out)
                .map_err(|error| unreachable(m, &error))?;
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
    /// axis turn too far, while the axes go straight between nodes.
    fn advance(
        &mut self,
        way: &TipWay<'_>,
        u0: f64,
        u1: f64,
        halvings: u32,
        out: &mut dyn FnMut(PathStep),
    ) -> Result<(), SolveError> {
        let (basic, command) = self.tip_pose(way, u1)?;
        if halvings < MOST_HALVINGS && self.is_too_coarse(way, 0.5 * (u0 + u1), &command) {
            let middle = 0.5 * (u0 + u1);
            self.advance(way, u0, middle, halvings + 1, out)?;
            return self.advance(way, middle, u1, halvings + 1, out);
        }
        (self.basic, self.command) = (basic, command);
        out(self.next(way.m, way.length * (u1 - u0), way.speed, u1 == 1.0));
        Ok(())
    }

    fn is_too_coarse(&self, way: &TipWay<'_>, middle: f64, end: &Command) -> bool {
        let Densify::Tolerance { chord_mm, angle_rad, .. } = self.densify else { return false };
        let turned = self.rotary_way(&self.command, end);
        if turned == 0.0 {
            return false;
        }
        let axes = self.machine.axes().iter().zip(self.command.iter().zip(end));
        let far = |(axis, (a, b)): (&trueaxis_machine::axis::Axis, (&f64, &f64))| {
            axis.kind == AxisKind::Rotary && (b - a).abs() > angle_rad * (1.0 + 1e-9)
        };
        if axes.into_iter().any(far) {
            return true;
        }
        let Ok((there, _)) = self.tip_pose(way, middle) else { return false };
        let between = std::array::from_fn(|i| 0.5 * (self.command[i] + end[i]));
        let tip = way.control.tip_and_axis(&between).0;
        (tip - self.place_in_workpiece(there)).norm() > chord_mm
    }

    /// Basic coordinates and axes at u of a move of the tip.
    fn tip_pose(&self, way: &TipWay<'_>, u: f64) -> Result<(Vec3, Command), SolveError> {
        let begin = &way.begin;
        let mut command = match way.turning {
            Turning::Axes(end) if u == 1.0 => *end,
            Turning::Axes(end) => std::array::from_fn(|i| begin[i] + (end[i] - begin[i]) * u),
            Turning::Swing(_, Some(end)) if u == 1.0 => *end,
            Turning::Swing(swing, _) => {
                let direction = Direction::of(swing.at(u)).unwrap_or(Direction::Z);
                nearest(way.control, direction, &self.command)?
            }
        };
        let basic = self.in_basic(way.curve.at(u));
        if !way.control.place(self.place_in_workpiece(basic), &mut command) {
            let moving = self.machine.axes().iter().filter(|a| a.kind == AxisKind::Linear);
            let moving = moving.map(|a| a.name).collect();
            return Err(SolveError::TipUnreachable { missed_by_mm: f64::NAN, moving });
        }
        Ok((basic, command))
    }

    /// How the tool axis gets to the end of a move.
    fn turning(&self, control: &TipControl, m: &Move) -> Result<Turning, Fault> {
        let axes = self.other_axes(m);
        let wanted = match m.direction {
            Some(direction) => Some(self.direction_in_workpiece(m, direction)?),
            None => None,
        };
        let (_, now) = control.tip_and_axis(&self.command);
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

    fn direction_in_workpiece(
        &self,
        m: &Move,
        direction: [f64; 3],
    ) -> Result<Direction<Workpiece>, Fault> {
        let vector = self.turn * Vec3::from(self.frame.vector(direction));
        Direction::of(vector).ok_or_else(|| {
            let message = "the direction of the tool has no length".to_owned();
            fault(m, None, "zero-direction", message, "write a vector that is not 0 0 0")
        })
    }

    fn cone_in_workpiece(&self, cone: &Cone) -> Cone {
        let turned = |v: [f64; 3]| (self.turn * Vec3::from(self.frame.vector(v))).into();
        Cone { axis: cone.axis.map(turned), through: cone.through.map(turned), ..*cone }
    }

    /// The rotary axes turn the tool onto Z of the program frame.
    fn align(
        &mut self,
        m: &Move,
        keep_tip: bool,
        branch: Branch,
        out: &mut dyn FnMut(PathStep),
    ) -> Result<(), Fault> {
        let Some(control) = self.control.clone() else { return Ok(()) };
        let direction = self.direction_in_workpiece(m, [0.0, 0.0, 1.0])?;
        let aimed = control.aim(direction, &self.command).map_err(|e| unreachable(m, &e))?;
        let chosen = choose(self.machine, &aimed, branch);
        let tip = control.tip_and_axis(&self.command).0;
        let (begin, mut end) = (self.command, chosen);
        if keep_tip && !control.place(tip, &mut end) {
            return Ok(());
        }
        let turned = self.rotary_way(&begin, &end);
        let pieces = self.densify.count(0.0, turned).max(1.0) as u32;
        for k in 1..=pieces {
            let u = fraction(k, pieces);
            let mut command = std::array::from_fn(|i| begin[i] + (end[i] - begin[i]) * u);
            if keep_tip && k < pieces {
                control.place(tip, &mut command);
            }
            self.command = if k == pieces { end } else { command };
            let length = turned.to_degrees() / f64::from(pieces);
            out(self.next(m, length, f64::INFINITY, k == pieces));
        }
        self.reread();
        Ok(())
    }

    /// The named axes go to machine coordinates.
    fn machine_move(
        &mut self,
        m: &Move,
        feed: Speed,
        out: &mut dyn FnMut(PathStep),
    ) -> Result<(), Fault> {
        let (begin, mut end) = (self.command, self.command);
        for axis in Axis::ALL {
            if let Some(index) = self.axis_of[axis as usize].filter(|_| m.named.contains(axis)) {
                let value = m.target[axis];
                end[index] = if axis.is_rotary() { value.to_radians() } else { value };
            }
        }
        let length_mm = (self.linear_axes(&end) - self.linear_axes(&begin)).norm();
        let turned = self.rotary_way(&begin, &end);
        let length = path_length(length_mm, turned);
        let pieces = self.densify.count(length_mm, turned) as u32;
        let speed = feed.along(length);
        for k in 1..=pieces.max(1) {
            let u = fraction(k, pieces.max(1));
            self.command = std::array::from_fn(|i| {
                if u == 1.0 { end[i] } else { begin[i] + (end[i] - begin[i]) * u }
            });
            let part = length / f64::from(pieces.max(1));
            out(self.next(m, part, speed, k == pieces.max(1)));
        }
        self.reread();
        Ok(())
    }

    fn count(&self, m: &Move, curve: &Curve, length_mm: f64, turned: f64) -> Result<u32, Fault> {
        let mut count = self.densify.count(length_mm, turned);
        if let (Curve::Helix { .. }, Some(chord_mm)) = (curve, self.densify.circle_chord_mm()) {
            count = count.max(super::densify::pieces(curve.chords(chord_mm)));
        }
        if count.is_finite() && length_mm.is_finite() && turned.is_finite() {
            return Ok(count.min(MOST_PIECES) as u32);
        }
        let message = "the move leads to no finite place".to_owned();
        Err(fault(m, None, "not-finite", message, "check offsets, scale and coordinates"))
    }

    /// √Σ Δq² of the rotary axes.
    fn rotary_way(&self, begin: &Command, end: &Command) -> f64 {
        let axes = self.machine.axes().iter().zip(begin.iter().zip(end));
        let rotary = axes.filter(|(axis, _)| axis.kind == AxisKind::Rotary);
        rotary.map(|(_, (a, b))| (b - a).powi(2)).sum::<f64>().sqrt()
    }

    /// How much longer the frame makes a curve.
    fn scale(&self, curve: &Curve) -> f64 {
        if self.frame.linear == Frame::IDENTITY.linear {
            return 1.0;
        }
        let along = match curve {
            Curve::Line { from, to } => to - from,
            // Circles are evenly scaled, or no circles any more.
            Curve::Helix { arm, .. } => *arm,
        };
        let length = along.norm();
        if length == 0.0 {
            1.0
        } else {
            Vec3::from(self.frame.vector(along.into())).norm() / length
        }
    }

    fn in_basic(&self, place: Vec3) -> Vec3 {
        let shift = &self.frame.shift.0;
        let shift = Vec3::new(shift[0], shift[1], shift[2]);
        if self.frame.linear == Frame::IDENTITY.linear {
            return place + shift;
        }
        Vec3::from(self.frame.vector(place.into())) + shift
    }

    fn set_linear(&self, command: &mut Command, xyz: Vec3) {
        for (i, axis) in self.axis_of[..3].iter().enumerate() {
            if let Some(axis) = axis {
                command[*axis] = xyz[i];
            }
        }
    }

    fn node(&self, m: &Move, length: f64, speed: f64) -> Node {
        Node {
            command: self.command,
            origin: m.origin,
            length,
            speed,
            last: false,
            stop: false,
            rounding_mm: f64::INFINITY,
            dwell_s: 0.0,
            tip_programmed: self.follows_tip(),
        }
    }

    /// The node at the present place.
    fn next(&self, m: &Move, length: f64, speed: f64, last: bool) -> PathStep {
        let mut node = self.node(m, length, speed);
        if last {
            node.last = true;
            // In rapid, and before a spindle that is coupled reverses, axes come to rest.
            let rests = matches!(
                m.kind,
                MoveKind::Rapid
                    | MoveKind::RigidTap { .. }
                    | MoveKind::Probe
                    | MoveKind::Align { .. }
            );
            node.stop = rests || self.exact != PathControl::Continuous;
            node.rounding_mm = self.rounding_mm;
        }
        PathStep::Node(node)
    }
}

/// How fast a move goes.
#[derive(Debug, Clone, Copy)]
enum Speed {
    Rapid,
    /// mm/s or deg/s.
    PerSecond(f64),
    /// The whole move, s.
    Lasting(f64),
}

impl Speed {
    fn along(self, length: f64) -> f64 {
        match self {
            Self::Rapid => f64::INFINITY,
            Self::PerSecond(speed) => speed,
            Self::Lasting(seconds) => length / seconds,
        }
    }
}

/// A move of the tip while it is being cut into pieces.
struct TipWay<'a> {
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

/// A piece is halved so often at most: near a pole an axis may jump however small the piece.
const MOST_HALVINGS: u32 = 14;

/// How the tool axis turns in a move of the tip.
enum Turning {
    /// The rotary axes go evenly to these positions.
    Axes(Command),
    /// The tool axis swings; the axes end here if angles are programmed.
    Swing(Swing, Option<Command>),
}

/// The length that the feed counts along: mm of the tip, or degrees of the
/// rotary axes where the tip stands.
fn path_length(length_mm: f64, turned_rad: f64) -> f64 {
    if length_mm > 1e-9 { length_mm } else { turned_rad.to_degrees() }
}

fn fraction(k: u32, pieces: u32) -> f64 {
    f64::from(k) / f64::from(pieces)
}

/// The pose along a direction that is nearest to the present one.
fn nearest(
    control: &TipControl,
    direction: Direction<Workpiece>,
    now: &Command,
) -> Result<Command, SolveError> {
    let (_, axis) = control.tip_and_axis(now);
    // Rounding of a direction that is held must not turn an axis at a pole.
    if angle(&axis, &direction.vector()) < trueaxis_machine::tcp::POLE_RAD {
        return Ok(*now);
    }
    Ok(control.aim(direction, now)?[0].command)
}

/// The pose of an alignment: by the sign of the rotary axis that tilts the tool.
fn choose(machine: &Machine, aimed: &[trueaxis_machine::tcp::Aimed], branch: Branch) -> Command {
    // The tilting axis is the one next to the tool of a head, next to the bed of a table.
    let rotary =
        || (0..machine.axes().len()).filter(|i| machine.axes()[*i].kind == AxisKind::Rotary);
    let tilting = rotary().nth(1).or(rotary().next());
    let fits = |c: &Command| match (branch, tilting) {
        (Branch::Nearest, _) | (_, None) => true,
        (Branch::Positive, Some(axis)) => c[axis] >= 0.0,
        (Branch::Negative, Some(axis)) => c[axis] <= 0.0,
    };
    let mut inside = aimed.iter().filter(|a| a.within_travel).map(|a| a.command);
    inside.find(fits).unwrap_or(aimed[0].command)
}

fn fault(
    m: &Move,
    word: Option<u8>,
    code: &'static str,
    message: String,
    hint: &'static str,
) -> Fault {
    Fault { origin: m.origin, word, code, message, hint }
}

fn unreachable(m: &Move, error: &SolveError) -> Fault {
    let hint = "tilt the part or the tool, or take a machine whose rotary axes reach it";
    fault(m, None, "unreachable-orientation", error.to_string(), hint)
}

fn no_swing(m: &Move, why: NoSwing) -> Fault {
    let (code, message, hint) = match why {
        NoSwing::Opposite => (
            "opposite-directions",
            "the tool axis turns by 180 deg: no plane is given for it",
            "put a direction between the two",
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

/// The place of basic coordinates in the workpiece: where the gauge point of the spindle stands
/// when the linear axes do and all rotary axes are at zero.
fn workpiece_from_basic(machine: &Machine, axis_of: &[Option<usize>; 9]) -> (Mat3, Vec3) {
    let Some(control) = TipControl::of(&machine.clone().with_tip(Vec3::zeros())) else {
        return (Mat3::identity(), Vec3::zeros());
    };
    let at = |i: Option<usize>| {
        let mut command = Command::default();
        if let Some(axis) = i.and_then(|i| axis_of[i]) {
            command[axis] = 1.0;
        }
        control.tip_and_axis(&command).0
    };
    let zero = at(None);
    let columns = [0, 1, 2].map(|i| at(Some(i)) - zero);
    (Mat3::from_columns(&columns), zero)
}

/// Where the axes stand before the program: as the set-up says, else at zero or the end of the
/// travel next to it.
fn start(machine: &Machine, setup: &SetUp, axis_of: &[Option<usize>; 9]) -> Command {
    let mut command = Command::default();
    for (q, axis) in command.iter_mut().zip(machine.axes()) {
        if let Travel::Between(low, high) = axis.travel {
            *q = 0.0_f64.clamp(low, high);
        }
    }
    if let Some(start) = &setup.start {
        for axis in Axis::ALL {
            if let Some(index) = axis_of[axis as usize] {
                let value = start[axis];
                command[index] = if axis.is_rotary() { value.to_radians() } else { value };
            }
        }
    }
    command
}

/// A, B and C in degrees at which the tool stands along a direction of the basic frame; what the
/// interpreter asks for Q120 to Q122 and the like.
pub(super) fn rotary_angles(
    control: &TipControl,
    direction: [f64; 3],
    branch: Branch,
    now: &Position,
) -> Option<[f64; 3]> {
    let machine = control.machine();
    let index = |axis: Axis| {
        machine.axes().iter().position(|a| a.name.letter() == char::from(axis.letter()))
    };
    let mut from = Command::default();
    let rotary = [Axis::A, Axis::B, Axis::C];
    for axis in rotary {
        if let Some(i) = index(axis) {
            from[i] = now[axis].to_radians();
        }
    }
    let aimed = control.aim(Direction::of(direction.into())?, &from).ok()?;
    let chosen = choose(machine, &aimed, branch);
    Some(rotary.map(|axis| index(axis).map_or(0.0, |i| chosen[i].to_degrees())))
}

/// The machine with its workpiece frame at a program zero.
pub(super) fn mount(machine: &Machine, frame: &Frame) -> Machine {
    let letters = Axis::ALL.map(|a| char::from(a.letter()));
    let axis_of =
        letters.map(|letter| machine.axes().iter().position(|a| a.name.letter() == letter));
    let (turn, shift) = workpiece_from_basic(machine, &axis_of);
    let zero = Vec3::new(frame.shift.0[0], frame.shift.0[1], frame.shift.0[2]);
    let linear = Mat3::from_fn(|i, j| frame.linear[i][j]);
    let there = Pose::new(turn * linear, turn * zero + shift);
    // The workpiece is the first body of the chain; what stands fixed on it is its mounting.
    let body = &machine.bodies()[0];
    machine.clone().with_workpiece(body.placement, body.mounting * there)
}
