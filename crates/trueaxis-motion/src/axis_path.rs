//! From programmed moves to the axis positions that the control commands.
//!
//! ```text
//!     without tool-centre point:   axes = frame(target) + tool length (+ what the table has carried the origin)
//!     with it:                     tip in the workpiece = workpiece_from_basic · frame(target)
//!                                  rotary axes by ORIAXES, great circle or cone
//!                                  linear axes by TipControl::place
//! ```

mod axes;
mod back;
mod dynamic_offset;
mod elements;
mod fault;
mod tip;

pub use back::Straight;
pub use fault::Fault;

use super::basic::axes_of_programs;
use super::basic::start;
use super::basic::workpiece_from_basic;
use super::curve::Curve;
use super::densify::Densify;
use super::densify::MOST_PIECES;
use super::setup::SetUp;
use super::timing::Element;
use fault::{fault, no_farther_than_a_hall, not_finite, too_many_pieces};
use std::sync::Arc;
use trueaxis_geometry::frame::{Direction, Workpiece, inverse3};
use trueaxis_geometry::{Mat3, Vec3};
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{AxisKind, Command, MAX_AXES};
use trueaxis_machine::tcp::TipControl;
use trueaxis_nc::moves::{
    Axis, AxisSet, Coordinates, Event, FeedMode, Frame, Move, MoveKind, OrientationPath, Origin,
    PathControl, Position, RotaryDirection, Step,
};

/// One place of the path that the control commands.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Node {
    /// Axis positions, mm and rad.
    pub command: Command,
    /// The block.
    pub origin: Origin,
    /// The distance from the previous node along the programmed path: of the tip, or of the
    /// rotary axes where only they move. Unit: mm or deg.
    pub length: f64,
    /// The programmed speed along the path; infinite in rapid. Unit: mm/s or deg/s.
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
    /// Whether this is a rapid move.
    pub fn is_rapid(&self) -> bool {
        self.speed.is_infinite()
    }
}

/// A step of the path, in order.
#[derive(Debug, Clone, PartialEq)]
pub enum PathStep {
    /// How the axes go on the next move; the nodes up to its last follow. Only for a path
    /// [`AxisPath::with_elements`]; a move without one goes straight from node to node.
    Element {
        /// Its derivatives.
        element: Box<Element>,
        /// The sum of the lengths of the nodes.
        length: f64,
    },
    /// The next place.
    Node(Node),
    /// The move could not be made to its end.
    Abandoned,
    /// Another tool is in the spindle from here on.
    Tool(u32),
}

/// The state of the control while it runs.
pub struct AxisPath<'m> {
    machine: &'m Machine,
    densify: Densify,
    has_elements: bool,
    /// The axis of the machine for each axis of programs.
    axis_of: [Option<usize>; 9],
    /// From basic coordinates to the workpiece frame of the machine file.
    turn: Mat3,
    shift: Vec3,
    /// The inverse of `turn`.
    turn_back: Mat3,
    /// Without tools in the set-up the control counts with the tool of the machine file.
    lengths_known: bool,
    /// A move of the tip takes it out and puts it back.
    control: Option<Arc<TipControl>>,
    frame: Frame,
    tool: Vec3,
    tcp: bool,
    tilted: bool,
    /// The origin that goes round with the table, in basic coordinates: G254 of HAAS.
    dynamic_mm: Option<Vec3>,
    orientation: OrientationPath,
    exact: PathControl,
    rounding_mm: f64,
    default_rounding_mm: f64,
    revolutions_per_s: f64,
    command: Command,
    /// X, Y and Z of the present place in basic coordinates.
    basic: Vec3,
    /// The tool axis at axis positions that it was last turned to.
    aimed: (Command, Vec3),
    /// Axes whose position the interpreter does not know.
    stale: AxisSet,
    /// In which direction the tool axis turned last.
    tangent: Option<Vec3>,
    /// Pieces of the present move so far.
    pieces: u32,
    /// Moves that could not be commanded.
    pub faults: Vec<Fault>,
}

/// More faults add no information.
const MOST_FAULTS: usize = 100;

impl<'m> AxisPath<'m> {
    /// From the start of the set-up on.
    pub fn new(machine: &'m Machine, setup: &SetUp, densify: Densify, rounding_mm: f64) -> Self {
        let (turn, shift) = match setup.given {
            true => workpiece_from_basic(machine),
            false => (Mat3::identity(), Vec3::zeros()),
        };
        let mut path = Self {
            machine,
            densify,
            has_elements: false,
            axis_of: axes_of_programs(machine),
            turn,
            shift,
            turn_back: inverse3(&turn),
            lengths_known: !setup.tools.is_empty(),
            control: TipControl::of(machine).map(Arc::new),
            frame: Frame::IDENTITY,
            tool: Vec3::zeros(),
            tcp: false,
            tilted: false,
            dynamic_mm: None,
            orientation: OrientationPath::Axes,
            exact: PathControl::Continuous,
            rounding_mm,
            default_rounding_mm: rounding_mm,
            revolutions_per_s: 0.0,
            command: start(machine, setup),
            basic: Vec3::zeros(),
            aimed: ([f64::NAN; MAX_AXES], Vec3::z()),
            stale: AxisSet::default(),
            tangent: None,
            pieces: 0,
            faults: Vec::new(),
        };
        path.fit_tip();
        path.reread();
        path
    }

    /// The place before the program.
    pub fn start(&self) -> Node {
        Node {
            command: self.command,
            origin: Origin::default(),
            length: 0.0,
            speed: f64::INFINITY,
            last: false,
            stop: true,
            rounding_mm: 0.0,
            dwell_s: 0.0,
            tip_programmed: false,
        }
    }

    /// Where the axes are.
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
                self.pieces = 0;
                if let Err(fault) = self.move_by(m, out) {
                    out(PathStep::Abandoned);
                    if self.faults.len() < MOST_FAULTS {
                        self.faults.push(fault);
                    }
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
                match self.follows_tip() {
                    // The axes stay; where the tip is now depends on how the tool leans.
                    true => self.reread(),
                    false => self.find_basic(),
                }
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
            Event::DynamicOffset(zero) => self.carry_origin(zero.map(Vec3::from), origin),
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
            let tipped = self.machine.clone().with_tip(-self.tool);
            self.control = TipControl::of(&tipped).map(Arc::new);
        }
    }

    /// After a change of the coordinate system: the axes stay, the program position changes.
    fn reread(&mut self) {
        self.find_basic();
        self.stale = AxisSet::XYZ;
    }

    fn find_basic(&mut self) {
        self.basic = self.basic_of(&self.command);
    }

    /// The basic coordinates of axis positions.
    fn basic_of(&self, command: &Command) -> Vec3 {
        match &self.control {
            Some(control) if self.follows_tip() => {
                self.turn_back * (control.tip_and_axis(command).0 - self.shift)
            }
            _ => self.linear_axes(command) - self.tool - self.carried(command),
        }
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
        if self.dynamic_mm.is_some() {
            self.count_from_origin_at(&self.other_axes(m));
        }
        let straight = matches!(m.kind, MoveKind::Rapid | MoveKind::Linear);
        if self.is_only_tilted() && straight && m.named.has_rotary() && m.direction.is_none() {
            return self.turn_on_plane(m, feed, out);
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
            // Out again on the same path; the interpreter counts on the place before.
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
                    let direction = m.rotary_directions[*axis as usize - Axis::A as usize];
                    self.turned(index, target.to_radians(), direction)
                }
                false => target,
            };
        }
        end
    }

    /// The angle that a rotary axis goes to.
    fn turned(&self, axis: usize, target: f64, direction: RotaryDirection) -> f64 {
        let (now, turn) = (self.command[axis], std::f64::consts::TAU);
        let travel = self.machine.axes()[axis].travel;
        match direction {
            RotaryDirection::AsWritten => target,
            RotaryDirection::Shortest => {
                let near = target + turn * ((now - target) / turn).round();
                let others = [near, near - turn, near + turn];
                let inside = others.into_iter().filter(|q| travel.contains(*q));
                let distance = |q: &f64| (q - now).abs();
                inside.min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap_or(near)
            }
            RotaryDirection::Positive => target + turn * ((now - target) / turn - 1e-9).ceil(),
            RotaryDirection::Negative => target + turn * ((now - target) / turn + 1e-9).floor(),
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

    fn count(&self, m: &Move, curve: &Curve, length_mm: f64, turned: f64) -> Result<u32, Fault> {
        let mut count = self.densify.count(length_mm, turned);
        if let (Curve::Helix { .. }, Some(chord_mm)) = (curve, self.densify.circle_chord_mm()) {
            // The frame makes chords as much longer as the curve.
            let chord_mm = chord_mm / self.scale(curve);
            count = count.max(super::densify::pieces(curve.chords(chord_mm)));
        }
        if length_mm.is_finite() && turned.is_finite() {
            no_farther_than_a_hall(m, curve.span_mm() * self.scale(curve))?;
            return self.bounded(m, count);
        }
        Err(not_finite(m))
    }

    fn bounded(&self, m: &Move, count: f64) -> Result<u32, Fault> {
        match count {
            count if count.is_nan() || count >= MOST_PIECES => Err(too_many_pieces(m)),
            count => Ok(count.max(1.0) as u32),
        }
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

/// Pieces shorter than this drown in the rounding of a long path, mm or deg.
pub(super) const SHORTEST: f64 = 1e-6;

/// Shorter than [`SHORTEST`] a move in inverse time is over at once: what lasts so long is motion. Unit: mm/s or deg/s.
const AT_ONCE: f64 = 1e6;

/// The speed of a move.
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
            Self::Lasting(_) if length < SHORTEST => AT_ONCE,
            Self::Lasting(seconds) => length / seconds,
        }
    }
}

/// The length that the feed counts along: mm of the tip, or degrees of the
/// rotary axes where the tip is.
fn path_length(length_mm: f64, turned_rad: f64) -> f64 {
    if length_mm > 1e-9 { length_mm } else { turned_rad.to_degrees() }
}

fn fraction(k: u32, pieces: u32) -> f64 {
    f64::from(k) / f64::from(pieces)
}
