//! Corrections of a whole stretch, made ahead by the batch compensator.
//!
//! The side from which an axis comes depends on what was written before: it is guessed from the
//! program as it is, and who takes a correction asks whether the guess was right.

use super::correct::reached;
use trueaxis_machine::Deviation;
use trueaxis_machine::axis::{Approach, AxisKind, Command, MAX_AXES};
use trueaxis_machine::batch::{
    CommandTable, Commands, CompensationError, CompiledCompensator, CompiledMachine, DeviationTable,
};
use trueaxis_machine::compensate::{AxisLimitation, Compensator, Scope};

/// Less is no deviation of the tool axis, rad.
const NONE_RAD: f64 = 1e-13;

/// A tool axis that misses more after its correction was left on purpose, rad: some ten times the
/// rounding of both evaluations.
const LEFT_RAD: f64 = 1e-12;

/// A correction made ahead.
#[derive(Debug, Clone, Copy)]
pub(super) struct Prepared {
    pub command: Command,
    /// What the machine misses without it.
    pub before: Deviation,
    pub left: Option<AxisLimitation>,
    /// From where each axis was taken to come.
    pub side: Approach,
}

/// Corrects stretch after stretch.
pub(super) struct Preparation {
    compensator: CompiledCompensator,
    machine: CompiledMachine,
    /// Where the tool axis is never (fully) corrected.
    always_left: Option<AxisLimitation>,
    places: [Vec<f64>; MAX_AXES],
    sides: [Vec<f64>; MAX_AXES],
    /// Whether the side counts.
    reverses: bool,
    /// In the mean of both sides, if it does and all poses have one.
    mean: Option<CommandTable>,
    commands: CommandTable,
    before: DeviationTable,
    after: DeviationTable,
    /// What only the scalar compensator can tell.
    open: Vec<bool>,
}

impl Preparation {
    pub fn of(compensator: &Compensator, reverses: bool) -> Self {
        let machine = compensator.machine();
        let rotary = machine.axes().iter().filter(|a| a.kind == AxisKind::Rotary).count();
        let always_left = match (compensator.scope(), rotary) {
            (Scope::Position, _) => Some(AxisLimitation::PositionOnly),
            (Scope::Pose, 0 | 1) => Some(AxisLimitation::FewRotaryAxes),
            (Scope::Pose, _) => None,
        };
        Self {
            machine: CompiledMachine::new(machine),
            compensator: CompiledCompensator::new(compensator.clone()),
            always_left,
            places: Default::default(),
            sides: Default::default(),
            reverses,
            mean: None,
            commands: CommandTable::zeros(0, 0),
            before: DeviationTable::zeros(0),
            after: DeviationTable::zeros(0),
            open: Vec::new(),
        }
    }

    /// Corrects places that are reached one after the other, from a place and its sides.
    pub fn prepare(
        &mut self,
        places: impl Iterator<Item = Command>,
        (mut from, mut side): (Command, Approach),
    ) {
        self.places.iter_mut().chain(&mut self.sides).for_each(Vec::clear);
        let axes = self.axes();
        for place in places {
            for (column, q) in self.places.iter_mut().zip(place).take(axes) {
                column.push(q);
            }
        }
        self.mean = self.reverses.then(|| self.means()).flatten();
        for k in 0..self.places[0].len() {
            // Only where errors depend on it does the side have to be the true one.
            let place = std::array::from_fn(|i| self.places[i].get(k).copied().unwrap_or(0.0));
            let place = self.mean_at(k).unwrap_or(place);
            side = reached(&side, &from, &place);
            from = place;
            for (column, side) in self.sides.iter_mut().zip(side).take(axes) {
                column.push(side);
            }
        }
        let count = self.places[0].len();
        self.open.clear();
        self.open.resize(count, false);
        if self.before.len() != count {
            self.commands = CommandTable::zeros(self.axes(), count);
            self.before = DeviationTable::zeros(count);
        }
        self.deviate();
        if self.correct() > 0 && self.always_left.is_none() {
            self.look_at_what_is_left();
        }
    }

    fn means(&self) -> Option<CommandTable> {
        let (axes, places) = (self.axes(), tail(&self.places, 0));
        let mut mean = CommandTable::zeros(axes, self.places[0].len());
        let done = self.compensator.commands(&Commands::new(&places[..axes]), &mut mean.columns());
        done.ok().map(|_| mean)
    }

    /// The command of a place in the mean of both sides.
    pub fn mean_at(&self, i: usize) -> Option<Command> {
        self.mean.as_ref().map(|mean| mean.at(i))
    }

    fn axes(&self) -> usize {
        self.machine.machine().axes().len()
    }

    fn deviate(&mut self) {
        let mut from = 0;
        while from < self.open.len() {
            let positions = tail(&self.places, from);
            let sides = tail(&self.sides, from);
            let axes = self.axes();
            let commands = Commands::new(&positions[..axes]).approached(&sides[..axes]);
            let mut rest = self.before.columns().skip(from);
            let done = self.machine.deviations(&commands, &mut rest);
            let Err(error) = done else { return };
            // Without the fault of one pose no pose is known.
            let bad = error.index().map_or(self.open.len() - from, |index| index + 1);
            let known = error.index().unwrap_or(0);
            self.open[from + known..from + bad].fill(true);
            from += bad;
        }
    }

    /// How many poses took the scalar path.
    fn correct(&mut self) -> u64 {
        let (mut from, mut by_scalar) = (0, 0);
        let axes = self.axes();
        while from < self.open.len() {
            let positions = tail(&self.places, from);
            let sides = tail(&self.sides, from);
            let commands = Commands::new(&positions[..axes]).approached(&sides[..axes]);
            let mut rest = self.commands.columns().skip(from);
            let (known, bad) = match self.compensator.commands(&commands, &mut rest) {
                Ok(effort) => return by_scalar + effort.by_scalar,
                Err(CompensationError::Pose { index, .. }) => (index, index + 1),
                Err(CompensationError::Batch(_)) => (0, self.open.len() - from),
            };
            self.open[from + known..from + bad].fill(true);
            // How those before it went is not recorded.
            by_scalar += 1;
            from += bad;
        }
        by_scalar
    }

    /// Near a pole the tool axis may keep a part of its deviation: the scalar compensator says why.
    fn look_at_what_is_left(&mut self) {
        let (count, axes) = (self.open.len(), self.axes());
        if self.after.len() != count {
            self.after = DeviationTable::zeros(count);
        }
        let positions: Vec<&[f64]> = self.commands.axes().collect();
        let sides = tail(&self.sides, 0);
        let commands = Commands::new(&positions).approached(&sides[..axes]);
        if self.machine.deviations(&commands, &mut self.after.columns()).is_err() {
            self.open.fill(true);
            return;
        }
        for i in 0..count {
            let (wanted, is) = (self.before.at(i).nominal_axis.vector(), self.after.at(i));
            let missed = is.nominal_axis.vector() + is.axis - wanted;
            self.open[i] |= missed.norm() > LEFT_RAD;
        }
    }

    /// The correction of a place of the stretch; `None` if the scalar compensator has to be asked.
    pub fn at(&self, i: usize) -> Option<Prepared> {
        if self.open.get(i).copied().unwrap_or(true) {
            return None;
        }
        let before = self.before.at(i);
        let side = std::array::from_fn(|axis| self.sides[axis].get(i).copied().unwrap_or(0.0));
        let left = self.always_left.filter(|_| before.axis.norm() > NONE_RAD);
        Some(Prepared { command: self.commands.at(i), before, left, side })
    }
}

fn tail(columns: &[Vec<f64>; MAX_AXES], from: usize) -> [&[f64]; MAX_AXES] {
    columns.each_ref().map(|column| column.get(from..).unwrap_or_default())
}
