//! What the offsets shall be: the values of `compensate values`, at the temperatures and the position of now.
//!
//! ```text
//!     readings ──Machine::at──> machine of now ──error_split──> δ(q) · d(q) ──− , / increment──> target
//! ```
//!
//! Nothing is calculated here that `trueaxis compensate values` calculates in another way: docs/model.md eq. 99. A control that
//! takes tip and angles gets the command of `compensate program` instead, as an offset: see [`crate::pose`].

use crate::datum::Datum;
use crate::governor::Reason;
use crate::line::{Line, at_positions, places};
use crate::linuxcnc::KinematicsCheck;
use crate::pose::{Frame, PoseCorrection, World, turns};
use trueaxis::compensate::values::{error_of, error_split};
use trueaxis::geometry::Vec3;
use trueaxis::input::{Diagnostics, Severity};
use trueaxis::machine::Machine;
use trueaxis::machine::axis::{Command, Travel};
use trueaxis::machine::heat::{Conditions, ROW_S, ThermalMemory};
use trueaxis::predict::holes::Compensation;

/// A machine with heat in its scales, which takes milliseconds to make, is made again once a reading has moved by so much, or after
/// [`ROW_S`]: 0.2 µm of a metre of steel. Unit: K.
const STEP_K: f64 = 0.02;

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
    /// The ends of the travel, where the control corrects along a line of the position. Unit: mm.
    pub line: Option<[f64; 2]>,
}

/// The model of a run.
#[derive(Debug, Clone)]
pub struct Model {
    machine: Machine,
    of: Compensation,
    part: Part,
    axes: Vec<LiveAxis>,
    pose: Option<Pose>,
    warm: Option<Warm>,
    datum: Option<Datum>,
    /// The heat in scales with heated places; none of a machine without such.
    memory: Option<ThermalMemory>,
}

/// What belongs to the correction of tip and tool axis together.
#[derive(Debug, Clone)]
struct Pose {
    world: World,
    /// Without temperatures: what tables in the control have corrected.
    cold: PoseCorrection,
    check: KinematicsCheck,
    /// Whether the rotary axes take a part.
    turns: bool,
}

/// The machine at certain readings.
#[derive(Debug, Clone)]
struct Warm {
    readings: Vec<(String, f64)>,
    /// When it was made; none of readings without a time.
    at_s: Option<f64>,
    machine: Machine,
    pose: Option<PoseCorrection>,
}

/// Where the offsets shall go.
#[derive(Debug, Clone, PartialEq)]
pub struct Target {
    /// In increments, one for each live axis, of a line two, those of its ends. Unit: counts.
    pub offsets: Vec<f64>,
    /// What is wanted at the position itself, in increments, one for each live axis: of a line it need not lie on it. Unit: counts.
    pub here: Vec<f64>,
    /// An axis stands outside its travel: the value is that of its end.
    pub is_clamped: bool,
}

impl Model {
    /// Of a machine whose active compensation is subtracted already.
    pub fn new(machine: Machine, of: Compensation, part: Part, axes: Vec<LiveAxis>) -> Self {
        let memory = ThermalMemory::is_needed(&machine).then(ThermalMemory::default);
        Self { machine, of, part, axes, pose: None, warm: None, datum: None, memory }
    }

    /// The same for a control that takes offsets of tip and angles: all axes are corrected together.
    ///
    /// # Errors
    /// A machine without three linear axes square to each other.
    pub fn with_pose(mut self) -> Result<Self, String> {
        let turns = turns(&self.machine, |i| self.axes.iter().any(|live| live.axis == i));
        let (world, cold) = (World::of(&self.machine)?, PoseCorrection::of(&self.machine, turns)?);
        self.pose = Some(Pose { world, cold, check: KinematicsCheck::default(), turns });
        Ok(self)
    }

    /// Takes the length of the tool that the control counts with, mm.
    ///
    /// # Errors
    /// [`Reason::Model`].
    pub fn set_tool(&mut self, length_mm: f64) -> Result<(), Reason> {
        let tip = self.machine.tip_mm();
        if tip.z == -length_mm {
            return Ok(());
        }
        if !(0.0..1e4).contains(&length_mm) {
            let what = format!("a tool of {length_mm} mm is none");
            return Err(Reason::Model { what });
        }
        self.machine = self.machine.clone().with_tip(Vec3::new(tip.x, tip.y, -length_mm));
        if let Some(pose) = &mut self.pose {
            let made = World::of(&self.machine).and_then(|world| {
                Ok((
                    world,
                    PoseCorrection::of(&self.machine, pose.turns)?
                        .with_history_of(Some(&pose.cold)),
                ))
            });
            (pose.world, pose.cold) = made.map_err(|what| Reason::Model { what })?;
        }
        self.warm = None;
        Ok(())
    }

    /// Takes what was missing when the zero of the part was touched, from every target from now on.
    pub fn set_datum(&mut self, datum: Option<Datum>) {
        self.datum = datum;
    }

    /// What is subtracted.
    pub fn datum(&self) -> Option<&Datum> {
        self.datum.as_ref()
    }

    /// The datum of offsets that are missing at a position, in increments: of the pose its tip in the workpiece.
    pub fn datum_of(&self, frame: Frame, at: &Command, missing: &[f64]) -> Datum {
        let each = self.axes.iter().zip(missing);
        let lengths: Vec<f64> = each.map(|(live, m)| m * live.increment * live.sign).collect();
        let Some(pose) = &self.pose else { return Datum { missing: lengths } };
        let mut by = Command::default();
        self.axes.iter().zip(&lengths).for_each(|(live, mm)| by[live.axis] = *mm);
        let moved = pose.world.moves_tip(frame, at, &by);
        let place = |live: &LiveAxis| pose.world.linear().iter().position(|i| *i == live.axis);
        Datum { missing: self.axes.iter().map(|l| place(l).map_or(0.0, |i| moved[i])).collect() }
    }

    /// Values of each live axis at a position, from those of the control, two of each line.
    pub fn at_position(
        &self,
        values: impl Iterator<Item = f64>,
        at: &Command,
    ) -> impl Iterator<Item = f64> {
        at_positions(self.axes.iter().map(|live| (live.line, at[live.axis])), values)
    }

    /// What is subtracted of each live axis at a position. Unit: mm or rad.
    fn subtracted(&self, frame: Frame, at: &Command) -> Vec<f64> {
        let Some(datum) = &self.datum else { return vec![0.0; self.axes.len()] };
        let Some(pose) = &self.pose else { return datum.missing.clone() };
        let mut moved = Vec3::zeros();
        for (live, missing) in self.axes.iter().zip(&datum.missing) {
            if let Some(i) = pose.world.linear().iter().position(|i| *i == live.axis) {
                moved[i] = *missing;
            }
        }
        let by = pose.world.moving_tip(frame, at, &moved);
        self.axes.iter().map(|live| by[live.axis]).collect()
    }

    /// Compares the tip of the control with that of the machine file, at a standing pose in the frame of the workpiece.
    ///
    /// # Errors
    /// [`Reason::Model`] where they part: one of them describes another machine.
    pub fn check_tip(&mut self, control_mm: [f64; 3], positions: &Command) -> Result<(), Reason> {
        let Some(pose) = &mut self.pose else { return Ok(()) };
        let nominal = pose.world.tip_xyz(positions);
        match pose.check.apart(&control_mm.into(), &nominal) {
            None => Ok(()),
            Some(apart_mm) => {
                let what = format!(
                    "the control moves the tip by {:.1} um otherwise than the machine file: pivots, senses or tool differ",
                    apart_mm * 1e3
                );
                Err(Reason::Model { what })
            }
        }
    }

    /// The command of the program from positions with an offset of each live axis, in increments.
    pub fn programmed(&self, frame: Frame, positions: &Command, acting: &[i32]) -> Command {
        let mut offset = Command::default();
        let counted = acting.iter().map(|n| f64::from(*n));
        for (axis, counted) in self.axes.iter().zip(self.at_position(counted, positions)) {
            offset[axis.axis] = axis.sign * counted * axis.increment;
        }
        match &self.pose {
            Some(pose) => pose.world.without(frame, positions, &offset),
            None => std::array::from_fn(|i| positions[i] - offset[i]),
        }
    }

    /// The machine at no particular temperature.
    pub fn machine(&self) -> &Machine {
        &self.machine
    }

    /// The live axes.
    pub fn axes(&self) -> &[LiveAxis] {
        &self.axes
    }

    /// The heat in its scales; none of a machine without heated places.
    pub fn memory(&self) -> Option<&ThermalMemory> {
        self.memory.as_ref()
    }

    /// Goes on with the heat of an earlier run, on the clock of this one.
    pub fn remember(&mut self, memory: ThermalMemory) {
        if self.memory.is_some() && memory.fits(&self.machine) {
            self.memory = Some(memory);
        }
    }

    /// Takes readings of now, °C; the machine is only made again where they differ, or where heat has gone on in its scales.
    ///
    /// # Errors
    /// What the machine file says against them.
    pub fn follow(&mut self, now_s: f64, readings: &[(&str, f64)]) -> Result<(), Reason> {
        let Some(memory) = &mut self.memory else { return self.set_readings(readings) };
        let read = |sensor: &str| readings.iter().find(|(name, _)| *name == sensor).map(|r| r.1);
        let of = |what: String| Reason::Model { what };
        memory.take(&self.machine, now_s, &read).map_err(|fault| of(fault.to_string()))?;
        let is_old = |warm: &Warm| warm.at_s.is_none_or(|at_s| now_s - at_s >= ROW_S);
        if self.warm.as_ref().is_some_and(|warm| warm.is_near(readings) && !is_old(warm)) {
            return Ok(());
        }
        let machine = remembered(&self.machine, memory, now_s, readings).map_err(of)?;
        self.warm_up(machine, readings, Some(now_s))
    }

    /// Takes readings that have no time, °C.
    ///
    /// # Errors
    /// What the machine file says against them; a heated scale then needs the `time` of its flux.
    pub fn set_readings(&mut self, readings: &[(&str, f64)]) -> Result<(), Reason> {
        if self.warm.as_ref().is_some_and(|warm| warm.is_of(readings)) {
            return Ok(());
        }
        let machine = at(&self.machine, readings).map_err(|what| Reason::Model { what })?;
        self.warm_up(machine, readings, None)
    }

    fn warm_up(
        &mut self,
        machine: Machine,
        readings: &[(&str, f64)],
        at_s: Option<f64>,
    ) -> Result<(), Reason> {
        let readings = readings.iter().map(|(name, celsius)| ((*name).to_owned(), *celsius));
        let before = self.warm.take().and_then(|warm| warm.pose);
        let pose = self.pose.as_ref().map(|pose| {
            let history = before.as_ref().or(Some(&pose.cold));
            PoseCorrection::of(&machine, pose.turns).map(|made| made.with_history_of(history))
        });
        let pose = pose.transpose().map_err(|what| Reason::Model { what })?;
        self.warm = Some(Warm { readings: readings.collect(), at_s, machine, pose });
        Ok(())
    }

    /// The target at a programmed position, as an offset in a frame.
    ///
    /// # Errors
    /// [`Reason::Model`].
    pub fn target(&mut self, frame: Frame, programmed: &Command) -> Result<Target, Reason> {
        let (command, is_clamped) = clamped(&self.machine, programmed);
        let by = self.pose_offset(frame, (programmed, &command))?;
        let fault = |what: &str| Reason::Model { what: what.to_owned() };
        let warm = self.warm.as_ref().ok_or_else(|| fault("no temperatures yet"))?;
        let subtracted = self.subtracted(frame, &command);
        let (mut offsets, mut here) = (Vec::new(), Vec::new());
        for (live, subtracted) in self.axes.iter().zip(subtracted) {
            let wanted = match &by {
                Some(by) => by[live.axis],
                None => -self.error(&warm.machine, live.axis, &command)?,
            };
            let counted = |wanted: f64| (wanted - subtracted) * live.sign / live.increment;
            here.push(counted(wanted));
            match live.line {
                None => offsets.push(counted(wanted)),
                Some(ends) => {
                    let line = self.line(&warm.machine, (live.axis, ends), &command)?;
                    offsets.extend(line.values.map(counted));
                }
            }
        }
        Ok(Target { offsets, here, is_clamped })
    }

    /// Offsets that do not depend on anything, as a target at a position.
    pub fn constant(&self, offsets: &[f64], at: Option<&Command>) -> Target {
        let here = |at| self.at_position(offsets.iter().copied(), at).collect();
        Target {
            offsets: offsets.to_vec(),
            here: at.map_or_else(Vec::new, here),
            is_clamped: false,
        }
    }

    /// The line along an axis that comes closest to what is wanted there, the others where they are.
    fn line(
        &self,
        warm: &Machine,
        (axis, ends): (usize, [f64; 2]),
        command: &Command,
    ) -> Result<Line, Reason> {
        let (places, mut along, mut wanted) = (places(ends), *command, Vec::new());
        for place in places {
            along[axis] = place;
            wanted.push(-self.error(warm, axis, &along)?);
        }
        Ok(Line::through(&places, &wanted, ends))
    }

    /// The offset of every axis where tip and tool axis are corrected together. Unit: mm or rad.
    fn pose_offset(
        &mut self,
        frame: Frame,
        (programmed, inside): (&Command, &Command),
    ) -> Result<Option<Command>, Reason> {
        let hot = self.warm.as_mut().and_then(|warm| warm.pose.as_mut());
        let (Some(pose), Some(hot)) = (&mut self.pose, hot) else { return Ok(None) };
        hot.follow(programmed);
        pose.cold.follow(programmed);
        let of = |what| Reason::Model { what };
        let mut by = pose.world.offset(frame, inside, &hot.corrected(inside).map_err(of)?);
        if self.part == Part::Thermal {
            let cold = pose.cold.corrected(inside).map_err(of)?;
            let held = pose.world.offset(frame, inside, &cold);
            by.iter_mut().zip(held).for_each(|(by, held)| *by -= held);
        }
        Ok(Some(by))
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

impl Warm {
    /// Whether no reading has moved by more than [`STEP_K`].
    fn is_near(&self, readings: &[(&str, f64)]) -> bool {
        self.readings.len() == readings.len()
            && self
                .readings
                .iter()
                .zip(readings)
                .all(|(a, b)| a.0 == b.0 && (a.1 - b.1).abs() <= STEP_K)
    }

    fn is_of(&self, readings: &[(&str, f64)]) -> bool {
        self.readings.len() == readings.len()
            && self.readings.iter().zip(readings).all(|(a, b)| a.0 == b.0 && a.1 == b.1)
    }
}

/// A machine at readings of now, with the heat that is in its scales.
///
/// # Errors
/// The first problem, in words.
pub fn remembered(
    machine: &Machine,
    memory: &ThermalMemory,
    now_s: f64,
    readings: &[(&str, f64)],
) -> Result<Machine, String> {
    let mut problems = Diagnostics::new();
    let warm = memory.machine_at(machine, &conditions(readings), now_s, &mut problems);
    warm.ok_or_else(|| first_of(&problems))
}

fn conditions(readings: &[(&str, f64)]) -> Conditions {
    let none = Conditions::default();
    readings.iter().fold(none, |found, (sensor, celsius)| found.with_reading(sensor, *celsius))
}

fn first_of(problems: &Diagnostics) -> String {
    let first = problems.iter().find(|d| d.severity == Severity::Error);
    first.map_or_else(String::new, |d| d.message.clone())
}

/// A machine at readings of its sensors, °C.
///
/// # Errors
/// The first problem, in words.
pub fn at(machine: &Machine, readings: &[(&str, f64)]) -> Result<Machine, String> {
    let mut problems = Diagnostics::new();
    let warm = machine.at(&conditions(readings), &mut problems);
    warm.ok_or_else(|| first_of(&problems))
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
