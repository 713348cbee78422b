//! The tool at eight commands, each with errors of its own, and the frames in which the errors act.
//!
//! ```text
//!     reference_from_tool = step · step · …          from the reference outwards, each from the right
//!     one step (J, t):  o ← o + R·t    R ← R·J       one station of errors (D, t):  o ← o + R·t    R ← R·(I + D)
//!     on the workpiece's side by the inverse:        R ← R·(I + D)ᵀ   o ← o − R·t        docs/model.md eq. 1, 2
//! ```

use super::groups::{lanes, put};
use super::kernel::error_turn;
use super::steps::Joint;
use super::{InstructionSet, LARGEST_TURN_RAD};
use crate::axis::{AxisKind, MAX_AXES};
use crate::chain::{Link, Machine, Step as Rule};
use crate::errors::{ErrorKind, Rotation};
use crate::lanes::vectors::{rotation, splat3, splat33, turn_pair_about};
use crate::lanes::{Lanes, Plain, sine_cosine};
use crate::twist::Reference;
use trueaxis_geometry::{Mat3, Vec3};

/// Commands of a group.
pub const GROUP: usize = 8;

/// A number of each command of a group.
pub type Group = [f64; GROUP];

/// Sine and cosine of lanes hold up to here. Unit: rad.
const LARGEST_ANGLE_RAD: f64 = 1e5;

/// Commands beyond are mistakes, as for one command. Unit: mm.
const LARGEST_COMMAND_MM: f64 = 1e12;

/// A frame at each command of a group, in the frame of the reference.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frames {
    /// R by columns: the directions of x, y, z.
    pub columns: [[Group; 3]; 3],
    /// o, mm.
    pub shift_mm: [Group; 3],
}

impl Frames {
    /// Nothing yet.
    pub const ZERO: Self = Self { columns: [[[0.0; GROUP]; 3]; 3], shift_mm: [[0.0; GROUP]; 3] };

    /// The frame at one of the commands.
    pub fn at(&self, lane: usize) -> Link {
        let linear = Mat3::from_fn(|i, k| self.columns[k][i][lane]);
        Link::new(linear, Vec3::from_fn(|i, _| self.shift_mm[i][lane]))
    }
}

/// Where six errors of the chain act.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Station {
    /// The body, in chain order.
    pub body: usize,
    /// Location errors or error motions.
    pub kind: ErrorKind,
}

/// The chain of a machine for groups of commands; what the machine states of its errors does not enter.
///
/// # Example
/// ```
/// use trueaxis_machine::batch::{CompiledChain, Frames, Station};
/// use trueaxis_machine::{Machine, errors::ErrorKind, file::NoTables, twist::Reference};
/// let text = "[machine]\nname = \"mill\"\nchain = \"w b Y X Z t\"\n[tool]\nlength = \"100 mm\"";
/// let machine = Machine::check("mill.toml", text, &NoTables).0.unwrap();
/// let squareness = Station { body: 1, kind: ErrorKind::Location };
/// let chain = CompiledChain::new(&machine, Reference::Workpiece, &[squareness]).unwrap();
/// // Y at 500 mm with 10 µrad of EC0Y: the tool is 5 µm too far in −X.
/// let mut commands = [[0.0; 8]; 6];
/// commands[0] = [500.0; 8];
/// let mut six = [[0.0; 8]; 6];
/// six[5] = [1e-5; 8];
/// let mut tool = Frames::ZERO;
/// assert_eq!(chain.tools(&commands, &[six], &mut tool), 0);
/// assert!((tool.at(3).shift_mm().x + 0.005).abs() < 1e-12);
/// ```
#[derive(Debug, Clone)]
pub struct CompiledChain {
    steps: Vec<Step>,
    stations: Vec<Station>,
    /// +1 on the tool's side of the chain, −1 on the workpiece's, 0 where the reference carries it.
    sides: Vec<f64>,
    /// Largest magnitudes of the commands.
    largest: [f64; MAX_AXES],
    axes: usize,
}

/// One factor of the product.
#[derive(Debug, Clone)]
enum Step {
    Shift([f64; 3]),
    Place { columns: [[f64; 3]; 3], shift_mm: [f64; 3] },
    Joint(Joint),
    Errors { station: usize, against: bool },
}

impl CompiledChain {
    /// The chain with errors at these stations, as the reference sees the tool; `None` for what only the scalar form covers: the
    /// small-angle model, and a squareness that tilts the direction of a motion only.
    pub fn new(machine: &Machine, reference: Reference, stations: &[Station]) -> Option<Self> {
        if machine.model().rotation != Rotation::Exact {
            return None;
        }
        let mut chain = Self {
            steps: Vec::new(),
            stations: stations.to_vec(),
            sides: vec![0.0; stations.len()],
            largest: [f64::INFINITY; MAX_AXES],
            axes: machine.axes().len(),
        };
        for (limit, axis) in chain.largest.iter_mut().zip(machine.axes()) {
            *limit = match axis.kind {
                AxisKind::Rotary => LARGEST_ANGLE_RAD,
                AxisKind::Linear => LARGEST_COMMAND_MM,
            };
        }
        let mut ahead = Link::identity();
        if reference == Reference::Workpiece {
            for i in 0..machine.workpiece_side() {
                let body = &machine.bodies()[i];
                ahead = ahead * body.mounting.inverse();
                for rule in machine.steps(i).iter().rev() {
                    chain.push(machine, i, *rule, true, &mut ahead)?;
                }
                ahead = ahead * body.placement.inverse();
            }
        }
        for i in machine.workpiece_side()..machine.bodies().len() {
            let body = &machine.bodies()[i];
            ahead = ahead * body.placement;
            for rule in machine.steps(i) {
                chain.push(machine, i, *rule, false, &mut ahead)?;
            }
            ahead = ahead * body.mounting;
        }
        chain.flush(&mut ahead);
        Some(chain)
    }

    fn push(
        &mut self,
        machine: &Machine,
        i: usize,
        rule: Rule,
        against: bool,
        ahead: &mut Link,
    ) -> Option<()> {
        let kind = match rule {
            Rule::TiltedJoint => return None,
            Rule::Location => ErrorKind::Location,
            Rule::Motion => ErrorKind::Motion,
            Rule::Joint => {
                let index = machine.bodies()[i].axis?;
                self.flush(ahead);
                let way = if against { -1.0 } else { 1.0 };
                self.steps.push(Step::Joint(Joint::of(machine, index, way)));
                return Some(());
            }
        };
        if let Some(station) = self.stations.iter().position(|s| s.body == i && s.kind == kind) {
            self.flush(ahead);
            self.sides[station] = if against { -1.0 } else { 1.0 };
            self.steps.push(Step::Errors { station, against });
        }
        Some(())
    }

    /// Writes the constants down.
    fn flush(&mut self, ahead: &mut Link) {
        let place = std::mem::replace(ahead, Link::identity());
        let (linear, shift_mm) = (place.linear(), (*place.shift_mm()).into());
        if *linear != Mat3::identity() {
            let columns = [0, 1, 2].map(|k| [0, 1, 2].map(|i| linear[(i, k)]));
            self.steps.push(Step::Place { columns, shift_mm });
        } else if shift_mm != [0.0; 3] {
            self.steps.push(Step::Shift(shift_mm));
        }
    }

    /// Where errors act, in the order of the errors that are given.
    pub fn stations(&self) -> &[Station] {
        &self.stations
    }

    /// On which side of the chain a station is: 1 the tool's, −1 the workpiece's, 0 where the reference carries it. Unit: 1.
    pub fn side(&self, station: usize) -> f64 {
        self.sides[station]
    }

    /// reference_from_tool at eight commands with these errors (mm, rad) at each station; none at all without a list.
    ///
    /// Returns one bit for each command that only the scalar form covers: beyond 10⁵ rad, or with errors that turn by more than
    /// [`LARGEST_TURN_RAD`].
    pub fn tools(
        &self,
        commands: &[Group; MAX_AXES],
        errors: &[[Group; 6]],
        tool: &mut Frames,
    ) -> u32 {
        self.walk(InstructionSet::best(), commands, errors, &mut [], tool)
    }

    /// The nominal frames in which the errors of each station act, and reference_from_tool, at eight commands.
    ///
    /// Returns as [`CompiledChain::tools`].
    pub fn frames(
        &self,
        commands: &[Group; MAX_AXES],
        stations: &mut [Frames],
        tool: &mut Frames,
    ) -> u32 {
        self.walk(InstructionSet::best(), commands, &[], stations, tool)
    }

    /// Both with given vector instructions, for tests.
    pub fn walk(
        &self,
        set: InstructionSet,
        commands: &[Group; MAX_AXES],
        errors: &[[Group; 6]],
        stations: &mut [Frames],
        tool: &mut Frames,
    ) -> u32 {
        let walk = Walk { chain: self, commands, errors };
        match set {
            #[cfg(target_arch = "x86_64")]
            InstructionSet::Avx512 => super::x86::chain_avx512(walk, stations, tool),
            #[cfg(target_arch = "x86_64")]
            InstructionSet::Avx2 => super::x86::chain_avx2(walk, stations, tool),
            _ => by::<8, Plain<8>>(walk, stations, tool),
        }
    }
}

/// The frame on its way: columns of R, and o.
#[derive(Clone, Copy)]
struct State<L> {
    columns: [[L; 3]; 3],
    shift: [L; 3],
}

/// What a walk through the chain is given.
#[derive(Clone, Copy)]
pub(super) struct Walk<'a> {
    chain: &'a CompiledChain,
    commands: &'a [Group; MAX_AXES],
    /// Of each station; none at all where only the nominal chain counts.
    errors: &'a [[Group; 6]],
}

/// W commands at a time.
#[inline(always)]
pub(super) fn by<const W: usize, L: Lanes<W>>(
    Walk { chain, commands, errors }: Walk<'_>,
    stations: &mut [Frames],
    tool: &mut Frames,
) -> u32 {
    let mut undecided = 0;
    for at in (0..GROUP).step_by(W) {
        let (zero, one) = (L::splat(0.0), L::splat(1.0));
        let columns = [[one, zero, zero], [zero, one, zero], [zero, zero, one]];
        let mut state = State { columns, shift: [zero; 3] };
        let mut outside = 0;
        for (largest, q) in chain.largest.iter().zip(commands).take(chain.axes) {
            outside |= lanes::<W, GROUP, L>(q, at).outside(-largest, *largest);
        }
        for step in &chain.steps {
            outside |= passed(&mut state, step, commands, errors, at);
            if let Step::Errors { station, .. } = step
                && let Some(frames) = stations.get_mut(*station)
            {
                store(&state, frames, at);
            }
        }
        store(&state, tool, at);
        undecided |= outside << at;
    }
    undecided
}

/// Through one step; lanes whose errors are too large for it.
#[inline(always)]
fn passed<const W: usize, L: Lanes<W>>(
    state: &mut State<L>,
    step: &Step,
    commands: &[Group; MAX_AXES],
    errors: &[[Group; 6]],
    at: usize,
) -> u32 {
    match step {
        Step::Shift(shift_mm) => {
            state.shift = moved(state.shift, &state.columns, splat3(shift_mm));
        }
        Step::Place { columns, shift_mm } => {
            state.shift = moved(state.shift, &state.columns, splat3(shift_mm));
            state.columns = turned(&state.columns, &splat33(columns));
        }
        Step::Joint(Joint::Slide { axis, per_unit }) => {
            let q: L = lanes(&commands[*axis], at);
            let [x, y, z] = splat3(per_unit);
            state.shift = moved(state.shift, &state.columns, [q * x, q * y, q * z]);
        }
        Step::Joint(Joint::SlideAlong { axis, along, per_unit }) => {
            let by = lanes::<W, GROUP, L>(&commands[*axis], at) * L::splat(*per_unit);
            // Written out: an index known only at run time would put the columns into memory.
            let column = match along {
                0 => state.columns[0],
                1 => state.columns[1],
                _ => state.columns[2],
            };
            state.shift = plus(state.shift, by, column);
        }
        Step::Joint(Joint::TurnAbout { axis, about, sense }) => {
            let (sin, cos) = sine_cosine(lanes::<W, GROUP, L>(&commands[*axis], at));
            turn_columns_about(&mut state.columns, *about, sin * L::splat(*sense), cos);
        }
        Step::Joint(Joint::Turn { axis, direction, sense }) => {
            let (sin, cos) = sine_cosine(lanes::<W, GROUP, L>(&commands[*axis], at));
            let [x, y, z] = rotation(splat3(direction), sin * L::splat(*sense), cos);
            // By columns.
            let by = [[x[0], y[0], z[0]], [x[1], y[1], z[1]], [x[2], y[2], z[2]]];
            state.columns = turned(&state.columns, &by);
        }
        Step::Errors { station, against } => {
            if let Some(six) = errors.get(*station) {
                return displaced(state, six, *against, at);
            }
        }
    }
    0
}

/// Through six errors.
#[inline(always)]
fn displaced<const W: usize, L: Lanes<W>>(
    state: &mut State<L>,
    six: &[Group; 6],
    against: bool,
    at: usize,
) -> u32 {
    let shift = [lanes(&six[0], at), lanes(&six[1], at), lanes(&six[2], at)];
    let angles: [L; 3] = [lanes(&six[3], at), lanes(&six[4], at), lanes(&six[5], at)];
    let mut outside = 0;
    for angle in angles {
        outside |= angle.outside(-LARGEST_TURN_RAD, LARGEST_TURN_RAD);
    }
    let [x, y, z] = error_turn(angles);
    let columns = state.columns;
    if against {
        // The columns of Dᵀ are the rows of D.
        for (column, by) in state.columns.iter_mut().zip([x, y, z]) {
            *column = moved(*column, &columns, by);
        }
        let zero = L::splat(0.0);
        let back = [zero - shift[0], zero - shift[1], zero - shift[2]];
        state.shift = moved(state.shift, &state.columns, back);
    } else {
        state.shift = moved(state.shift, &columns, shift);
        let by = [[x[0], y[0], z[0]], [x[1], y[1], z[1]], [x[2], y[2], z[2]]];
        for (column, by) in state.columns.iter_mut().zip(by) {
            *column = moved(*column, &columns, by);
        }
    }
    outside
}

/// `v + R·t`
#[inline(always)]
fn moved<const W: usize, L: Lanes<W>>(v: [L; 3], columns: &[[L; 3]; 3], t: [L; 3]) -> [L; 3] {
    plus(plus(plus(v, t[0], columns[0]), t[1], columns[1]), t[2], columns[2])
}

/// `v + s·u`
#[inline(always)]
fn plus<const W: usize, L: Lanes<W>>(v: [L; 3], s: L, u: [L; 3]) -> [L; 3] {
    [s.times_plus(u[0], v[0]), s.times_plus(u[1], v[1]), s.times_plus(u[2], v[2])]
}

/// `R·B`, both by columns.
#[inline(always)]
fn turned<const W: usize, L: Lanes<W>>(columns: &[[L; 3]; 3], by: &[[L; 3]; 3]) -> [[L; 3]; 3] {
    let zero = [L::splat(0.0); 3];
    [moved(zero, columns, by[0]), moved(zero, columns, by[1]), moved(zero, columns, by[2])]
}

/// R times a turn about x, y or z: the rows of R turn the other way.
#[inline(always)]
fn turn_columns_about<const W: usize, L: Lanes<W>>(
    columns: &mut [[L; 3]; 3],
    about: usize,
    sin: L,
    cos: L,
) {
    let back = L::splat(0.0) - sin;
    let [x, y, z] = *columns;
    let mut rows = [[x[0], y[0], z[0]], [x[1], y[1], z[1]], [x[2], y[2], z[2]]];
    turn_pair_about(&mut rows[0], about, back, cos);
    turn_pair_about(&mut rows[1], about, back, cos);
    turn_pair_about(&mut rows[2], about, back, cos);
    let [x, y, z] = rows;
    *columns = [[x[0], y[0], z[0]], [x[1], y[1], z[1]], [x[2], y[2], z[2]]];
}

#[inline(always)]
fn store<const W: usize, L: Lanes<W>>(state: &State<L>, frames: &mut Frames, at: usize) {
    for k in 0..3 {
        for i in 0..3 {
            put(&mut frames.columns[k][i], at, state.columns[k][i]);
        }
        put(&mut frames.shift_mm[k], at, state.shift[k]);
    }
}

/// Sines and cosines of eight angles, to about one unit in the last place of 1.
pub fn sines_and_cosines(angles: &Group) -> [Group; 2] {
    let mut out = [[0.0; GROUP]; 2];
    match InstructionSet::best() {
        #[cfg(target_arch = "x86_64")]
        InstructionSet::Avx512 => super::x86::sines_avx512(angles, &mut out),
        #[cfg(target_arch = "x86_64")]
        InstructionSet::Avx2 => super::x86::sines_avx2(angles, &mut out),
        _ => sines_by::<8, Plain<8>>(angles, &mut out),
    }
    let [sines, cosines] = &mut out;
    for ((angle, sine), cosine) in angles.iter().zip(sines).zip(cosines) {
        if angle.is_nan() || angle.abs() > LARGEST_ANGLE_RAD {
            (*sine, *cosine) = angle.sin_cos();
        }
    }
    out
}

#[inline(always)]
pub(super) fn sines_by<const W: usize, L: Lanes<W>>(angles: &Group, out: &mut [Group; 2]) {
    for at in (0..GROUP).step_by(W) {
        let (sin, cos) = sine_cosine(lanes::<W, GROUP, L>(angles, at));
        put(&mut out[0], at, sin);
        put(&mut out[1], at, cos);
    }
}
