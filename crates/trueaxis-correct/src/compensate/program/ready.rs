//! Corrections of a whole stretch, made ahead by the batch compensator, and where the tool stands by them.
//!
//! The side from which an axis comes depends on what is written before: it is guessed from the
//! program as it is, and who takes a correction asks whether the guess was right.

use super::ProgramOptions;
use super::ahead::Stretch;
use super::correct::{reached, reverses};
use super::stand::Stand;
use std::sync::Arc;
use trueaxis_geometry::Vec3;
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{Approach, AxisKind, Command, MAX_AXES};
use trueaxis_machine::batch::{
    CommandTable, Commands, CompensationError, CompiledCompensator, CompiledMachine, DeviationTable,
};
use trueaxis_machine::compensate::{AxisLimitation, Compensator, Scope};
use trueaxis_machine::tcp::TipControl;
use trueaxis_motion::SetUp;

/// Less is no deviation of the tool axis, rad.
const NONE_RAD: f64 = 1e-13;

/// A tool axis that misses more after its correction was left on purpose, rad: some ten times the
/// rounding of both evaluations.
const LEFT_RAD: f64 = 1e-12;

/// A correction made ahead.
#[derive(Debug, Clone, Copy)]
pub(super) struct Prepared {
    pub command: Command,
    /// What the machine misses without it: its tip, mm, and its tool axis.
    pub before: [Vec3; 2],
    pub left: Option<AxisLimitation>,
    /// From where each axis was taken to come.
    pub side: Approach,
}

/// What was found ahead for the places of a stretch; nothing at first.
#[derive(Debug)]
pub(super) struct Ready {
    places: [Vec<f64>; MAX_AXES],
    sides: [Vec<f64>; MAX_AXES],
    /// In the mean of both sides, if the side counts and all poses have one.
    mean: Option<CommandTable>,
    commands: CommandTable,
    before: DeviationTable,
    after: DeviationTable,
    /// What only the scalar compensator can tell.
    open: Vec<bool>,
    /// Where the tool axis is never (fully) corrected.
    always_left: Option<AxisLimitation>,
    /// Tip and tool axis that are programmed, and those that the control believes with the corrections.
    wanted: Vec<(Vec3, Vec3)>,
    believed: Vec<(Vec3, Vec3)>,
    room: Vec<Command>,
}

impl Default for Ready {
    fn default() -> Self {
        Self {
            places: Default::default(),
            sides: Default::default(),
            mean: None,
            commands: CommandTable::zeros(0, 0),
            before: DeviationTable::zeros(0),
            after: DeviationTable::zeros(0),
            open: Vec::new(),
            always_left: None,
            wanted: Vec::new(),
            believed: Vec::new(),
            room: Vec::new(),
        }
    }
}

impl Ready {
    /// The correction of a place of the stretch; `None` if the scalar compensator has to be asked.
    pub fn at(&self, i: usize) -> Option<Prepared> {
        if self.open.get(i).copied().unwrap_or(true) {
            return None;
        }
        let [_, _, tip_mm, axis] = self.before.vectors_at(i);
        let side = std::array::from_fn(|axis| self.sides[axis].get(i).copied().unwrap_or(0.0));
        let left = self.always_left.filter(|_| axis.norm() > NONE_RAD);
        Some(Prepared { command: self.commands.at(i), before: [tip_mm, axis], left, side })
    }

    /// The command of a place in the mean of both sides.
    pub fn mean_at(&self, i: usize) -> Option<Command> {
        self.mean.as_ref().map(|mean| mean.at(i))
    }

    /// Where the tool shall stand at a place.
    pub fn wanted_at(&self, i: usize) -> Option<Stand> {
        self.wanted.get(i).map(|(tip, axis)| Stand { tip: *tip, axis: *axis })
    }

    /// Where the control believes it with the correction that was made ahead, if it is this command.
    pub fn believed_at(&self, i: usize, command: &Command) -> Option<Stand> {
        let (tip, axis) = self.believed.get(i).filter(|_| self.commands.at(i) == *command)?;
        Some(Stand { tip: *tip, axis: *axis })
    }

    fn clear(&mut self) {
        self.places.iter_mut().chain(&mut self.sides).for_each(Vec::clear);
        self.mean = None;
        self.open.clear();
        self.wanted.clear();
        self.believed.clear();
    }

    /// Where the tool stands from a place up to before another, by a control.
    fn stand(&mut self, control: &TipControl, (from, to): (usize, usize), nominal: &[Command]) {
        control.tips_and_axes(&nominal[from..to], &mut self.wanted);
        self.room.clear();
        self.room.extend((from..to).map(|i| self.commands.at(i)));
        control.tips_and_axes(&self.room, &mut self.believed);
    }
}

/// Prepares stretch after stretch with the tool that is in the spindle.
pub(super) struct Preparer<'m> {
    machine: &'m Machine,
    setup: &'m SetUp,
    options: &'m ProgramOptions,
    /// `None` where every place is corrected by itself.
    preparation: Option<Preparation>,
    /// From which place of the stretch on the control counts with which tool.
    controls: Vec<(usize, Option<Arc<TipControl>>)>,
    commands: Vec<Command>,
}

impl<'m> Preparer<'m> {
    /// With the tool of the machine.
    pub fn of(machine: &'m Machine, setup: &'m SetUp, options: &'m ProgramOptions) -> Self {
        let preparation = (!options.pose_by_pose).then(|| Preparation::of(machine, options));
        let preparation = preparation.flatten();
        let (controls, commands) = (Vec::new(), Vec::new());
        Self { machine, setup, options, preparation, controls, commands }
    }

    /// The control counts so from the place on that is the next of the stretch.
    pub fn count_by(&mut self, place: usize, control: Option<Arc<TipControl>>) {
        let same = |last: &Option<Arc<TipControl>>| match (last, &control) {
            (Some(last), Some(control)) => Arc::ptr_eq(last, control),
            (None, None) => true,
            _ => false,
        };
        if !self.controls.last().is_some_and(|(_, last)| same(last)) {
            self.controls.push((place, control));
        }
    }

    /// After a stretch: another tool is in the spindle.
    pub fn change_tool(&mut self, number: u32) {
        let Some(tool) = self.setup.tools.get(&number) else { return };
        let Some(before) = self.preparation.take() else { return };
        let machine = self.machine.clone().with_tip(tool.tip_mm);
        let next = Preparation::of(&machine, self.options);
        self.preparation = next.map(|next| next.with_history_of(&before));
    }

    /// Corrects the places of a stretch and finds where the tool stands.
    pub fn prepare(&mut self, stretch: &mut Stretch) {
        let ready = &mut stretch.ready;
        ready.clear();
        let Some(preparation) = &mut self.preparation else { return };
        self.commands.clear();
        self.commands.extend(stretch.nodes.iter().map(|node| node.command));
        if let Some(first) = stretch.steps.first() {
            preparation.prepare(&self.commands, first.begin, ready);
        }
        let ends = self.controls.iter().skip(1).map(|(from, _)| *from).chain([self.commands.len()]);
        for ((from, control), to) in self.controls.iter().zip(ends) {
            // Without a control there is nothing to correct.
            let Some(control) = control else { break };
            ready.stand(control, (*from, to), &self.commands);
        }
        if let Some((from, _)) = self.controls.last_mut() {
            *from = 0;
        }
        self.controls.drain(..self.controls.len().saturating_sub(1));
    }
}

/// Corrects the places of a machine with one tool.
struct Preparation {
    compensator: CompiledCompensator,
    machine: CompiledMachine,
    always_left: Option<AxisLimitation>,
    /// Whether the side counts.
    reverses: bool,
    /// The last place, and from where the axes came to it.
    last: Option<(Command, Approach)>,
}

impl Preparation {
    /// `None` for a machine that cannot be corrected.
    fn of(machine: &Machine, options: &ProgramOptions) -> Option<Self> {
        let scope = if options.position_only { Scope::Position } else { Scope::Pose };
        let compensator = Compensator::of(machine, scope).ok()?;
        let rotary = machine.axes().iter().filter(|a| a.kind == AxisKind::Rotary).count();
        let always_left = match (scope, rotary) {
            (Scope::Position, _) => Some(AxisLimitation::PositionOnly),
            (Scope::Pose, 0 | 1) => Some(AxisLimitation::FewRotaryAxes),
            (Scope::Pose, _) => None,
        };
        Some(Self {
            machine: CompiledMachine::new(machine),
            compensator: CompiledCompensator::new(compensator),
            always_left,
            reverses: reverses(machine),
            last: None,
        })
    }

    fn with_history_of(self, other: &Self) -> Self {
        Self { last: other.last, ..self }
    }

    /// Corrects places that are reached one after the other; the first of a program from where the axes stand.
    fn prepare(&mut self, places: &[Command], begin: Command, ready: &mut Ready) {
        let (mut from, mut side) = self.last.unwrap_or((begin, Approach::default()));
        let (axes, count) = (self.axes(), places.len());
        for (axis, column) in ready.places.iter_mut().enumerate().take(axes) {
            column.extend(places.iter().map(|place| place[axis]));
        }
        ready.mean = self.reverses.then(|| self.means(ready, count)).flatten();
        for (k, place) in places.iter().enumerate() {
            // Only where errors depend on it does the side have to be the true one.
            let place = ready.mean_at(k).unwrap_or(*place);
            side = reached(&side, &from, &place);
            from = place;
            for (column, side) in ready.sides.iter_mut().zip(side).take(axes) {
                column.push(side);
            }
        }
        self.last = Some((from, side));
        ready.always_left = self.always_left;
        ready.open.resize(count, false);
        if ready.before.len() != count {
            ready.commands = CommandTable::zeros(axes, count);
            ready.before = DeviationTable::zeros(count);
        }
        self.deviate(ready);
        if self.correct(ready) > 0 && self.always_left.is_none() {
            self.look_at_what_is_left(ready);
        }
    }

    fn means(&self, ready: &Ready, count: usize) -> Option<CommandTable> {
        let (axes, places) = (self.axes(), tail(&ready.places, 0));
        let mut mean = CommandTable::zeros(axes, count);
        let done = self.compensator.commands(&Commands::new(&places[..axes]), &mut mean.columns());
        done.ok().map(|_| mean)
    }

    fn axes(&self) -> usize {
        self.machine.machine().axes().len()
    }

    fn deviate(&self, ready: &mut Ready) {
        let mut from = 0;
        while from < ready.open.len() {
            let positions = tail(&ready.places, from);
            let sides = tail(&ready.sides, from);
            let axes = self.axes();
            let commands = Commands::new(&positions[..axes]).approached(&sides[..axes]);
            let mut rest = ready.before.columns().skip(from);
            let done = self.machine.deviations(&commands, &mut rest);
            let Err(error) = done else { return };
            // Without the fault of one pose no pose is known.
            let bad = error.index().map_or(ready.open.len() - from, |index| index + 1);
            let known = error.index().unwrap_or(0);
            ready.open[from + known..from + bad].fill(true);
            from += bad;
        }
    }

    /// How many poses took the scalar path.
    fn correct(&self, ready: &mut Ready) -> u64 {
        let (mut from, mut by_scalar) = (0, 0);
        let axes = self.axes();
        while from < ready.open.len() {
            let positions = tail(&ready.places, from);
            let sides = tail(&ready.sides, from);
            let commands = Commands::new(&positions[..axes]).approached(&sides[..axes]);
            let mut rest = ready.commands.columns().skip(from);
            let (known, bad) = match self.compensator.commands(&commands, &mut rest) {
                Ok(effort) => return by_scalar + effort.by_scalar,
                Err(CompensationError::Pose { index, .. }) => (index, index + 1),
                Err(CompensationError::Batch(_)) => (0, ready.open.len() - from),
            };
            ready.open[from + known..from + bad].fill(true);
            // How those before it went is not recorded.
            by_scalar += 1;
            from += bad;
        }
        by_scalar
    }

    /// Near a pole the tool axis may keep a part of its deviation: the scalar compensator says why.
    fn look_at_what_is_left(&self, ready: &mut Ready) {
        let (count, axes) = (ready.open.len(), self.axes());
        if ready.after.len() != count {
            ready.after = DeviationTable::zeros(count);
        }
        let positions: Vec<&[f64]> = ready.commands.axes().collect();
        let sides = tail(&ready.sides, 0);
        let commands = Commands::new(&positions).approached(&sides[..axes]);
        if self.machine.deviations(&commands, &mut ready.after.columns()).is_err() {
            ready.open.fill(true);
            return;
        }
        for i in 0..count {
            let (wanted, is) = (ready.before.at(i).nominal_axis.vector(), ready.after.at(i));
            let missed = is.nominal_axis.vector() + is.axis - wanted;
            ready.open[i] |= missed.norm() > LEFT_RAD;
        }
    }
}

fn tail(columns: &[Vec<f64>; MAX_AXES], from: usize) -> [&[f64]; MAX_AXES] {
    columns.each_ref().map(|column| column.get(from..).unwrap_or_default())
}
