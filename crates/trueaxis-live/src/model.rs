//! What the offsets shall be: the values of `compensate values`, at the temperatures and the position of now.
//!
//! ```text
//!     readings ──Machine::at──> machine of now ──error_split──> δ(q) · d(q) ──− , / increment──> target
//! ```
//!
//! Nothing is calculated here that `trueaxis compensate values` calculates in another way: docs/model.md eq. 99.

use crate::governor::Reason;
use trueaxis::compensate::values::{error_of, error_split};
use trueaxis::input::{Diagnostics, Severity};
use trueaxis::machine::Machine;
use trueaxis::machine::axis::{Command, Travel};
use trueaxis::machine::heat::Conditions;
use trueaxis::predict::holes::Compensation;

/// Which part of the correction goes live.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Part {
    /// All of it.
    Whole,
    /// What temperatures add: scales, structure, workpiece; the geometric part is in tables of the control.
    Thermal,
}

/// One live axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LiveAxis {
    /// Its place in [`Machine::axes`].
    pub axis: usize,
    /// The least increment of the control. Unit: mm or rad.
    pub increment: f64,
    /// +1 if a larger offset moves the tool in the direction of the axis for the same program, else −1. Unit: 1.
    pub sign: f64,
}

/// The model of a run.
#[derive(Debug, Clone)]
pub struct Model {
    machine: Machine,
    of: Compensation,
    part: Part,
    axes: Vec<LiveAxis>,
    warm: Option<Warm>,
}

/// The machine at certain readings.
#[derive(Debug, Clone)]
struct Warm {
    readings: Vec<(String, f64)>,
    machine: Machine,
}

/// Where the offsets shall go.
#[derive(Debug, Clone, PartialEq)]
pub struct Target {
    /// In increments, one for each live axis. Unit: counts.
    pub offsets: Vec<f64>,
    /// An axis stands outside its travel: the value is that of its end.
    pub is_clamped: bool,
}

impl Model {
    /// Of a machine whose active compensation is subtracted already.
    pub fn new(machine: Machine, of: Compensation, part: Part, axes: Vec<LiveAxis>) -> Self {
        Self { machine, of, part, axes, warm: None }
    }

    /// The machine at no particular temperature.
    pub fn machine(&self) -> &Machine {
        &self.machine
    }

    /// The live axes.
    pub fn axes(&self) -> &[LiveAxis] {
        &self.axes
    }

    /// Takes readings, °C; the machine is only made again where they differ.
    ///
    /// # Errors
    /// What the machine file says against them.
    pub fn set_readings(&mut self, readings: &[(&str, f64)]) -> Result<(), Reason> {
        let same = |warm: &Warm| {
            warm.readings.len() == readings.len()
                && warm.readings.iter().zip(readings).all(|(a, b)| a.0 == b.0 && a.1 == b.1)
        };
        if self.warm.as_ref().is_some_and(same) {
            return Ok(());
        }
        let machine = at(&self.machine, readings).map_err(|what| Reason::Model { what })?;
        let readings = readings.iter().map(|(name, celsius)| ((*name).to_owned(), *celsius));
        self.warm = Some(Warm { readings: readings.collect(), machine });
        Ok(())
    }

    /// The target at a programmed position.
    ///
    /// # Errors
    /// [`Reason::Model`].
    pub fn target(&self, programmed: &Command) -> Result<Target, Reason> {
        let fault = |what: &str| Reason::Model { what: what.to_owned() };
        let warm = self.warm.as_ref().ok_or_else(|| fault("no temperatures yet"))?;
        let (command, is_clamped) = clamped(&self.machine, programmed);
        let offsets = self.axes.iter().map(|live| {
            let error = self.error(&warm.machine, live.axis, &command)?;
            Ok(-error * live.sign / live.increment)
        });
        Ok(Target { offsets: offsets.collect::<Result<_, _>>()?, is_clamped })
    }

    /// The error that is compensated, of a machine at its temperatures. Unit: mm or rad.
    ///
    /// # Errors
    /// [`Reason::Model`].
    pub fn error(&self, warm: &Machine, axis: usize, command: &Command) -> Result<f64, Reason> {
        let mut split = error_split(warm, axis, command)
            .map_err(|fault| Reason::Model { what: fault.to_string() })?;
        if self.part == Part::Thermal {
            split[0] = 0.0;
        }
        Ok(error_of(self.of, &split))
    }
}

/// A machine at readings of its sensors, °C.
///
/// # Errors
/// The first problem, in words.
pub fn at(machine: &Machine, readings: &[(&str, f64)]) -> Result<Machine, String> {
    let mut conditions = Conditions::default();
    for (sensor, celsius) in readings {
        conditions = conditions.with_reading(sensor, *celsius);
    }
    let mut problems = Diagnostics::new();
    let warm = machine.at(&conditions, &mut problems);
    let first = problems.iter().find(|d| d.severity == Severity::Error);
    warm.ok_or_else(|| first.map_or_else(String::new, |d| d.message.clone()))
}

/// A position within the travels, and whether it was outside by more than what an offset moves.
pub fn clamped(machine: &Machine, command: &Command) -> (Command, bool) {
    const OFFSET_MM: f64 = 0.01;
    let (mut inside, mut is_clamped) = (*command, false);
    for (axis, at) in machine.axes().iter().zip(&mut inside) {
        if let Travel::Between(from, to) = axis.travel {
            is_clamped |= *at < from - OFFSET_MM || *at > to + OFFSET_MM;
            *at = at.clamp(from, to);
        }
    }
    (inside, is_clamped)
}
