//! A virtual laser before and after compensation: Fig 9 and 10 of Zhang et al. 2019 for any campaign.
//!
//! ```text
//!     campaign.toml ──read_before_after──> BeforeAfter { machine, lasers, paths, compensations }
//!     each compensation × each path ──measure──> readings ──ISO 230-2──> Curve
//! ```
//!
//! The values are those of `compensate values` for the machine file, those of the tables of a control if
//! one is named; the readings are of the machine of `[truth]`, so what the file does not know remains.

mod file;

pub use file::{AppliedValues, BeforeAfter, LoadedTables, read_before_after};

use std::collections::BTreeMap;
use trueaxis_correct::compensate::tables::emulation::Emulation;
use trueaxis_correct::compensate::values::{Order, ValuesError, compensation_values};
use trueaxis_geometry::{AxisKind as Kind, Vec3};
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{Approach, AxisKind, Command};
use trueaxis_machine::errors::ErrorValues;
use trueaxis_measure::measure::instrument::SetupError;
use trueaxis_measure::measure::path::Path;
use trueaxis_measure::measure::virtual_campaign::{MeasureError, Measurement, measure};
use trueaxis_measure::measure::{Campaign, Instrument};
use trueaxis_predict::predict::holes::Compensation;
use trueaxis_standards::iso230_2::{self, Budget, Positioning, Reading, Share, Target};

/// One laser on one axis under one compensation.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    /// The path, by its place in the campaign.
    pub path: usize,
    /// The instrument, by its place in the campaign.
    pub instrument: usize,
    /// The axis, by its place in the machine.
    pub axis: usize,
    /// What the control added.
    pub compensation: Compensation,
    /// The readings.
    pub measured: iso230_2::Measurement,
    /// The evaluation by ISO 230-2.
    pub result: Positioning,
    /// What was added to the command at each target, mean of both directions. Unit: mm.
    pub added_mm: Vec<f64>,
    /// The largest mean deviation of all targets and directions.
    pub largest: LargestDeviation,
    /// Standard uncertainty of the error at that target by the machine file, where it has one. Unit: mm.
    pub file_u_mm: Option<f64>,
}

/// The largest mean deviation of a curve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LargestDeviation {
    /// With its sign. Unit: mm.
    pub deviation_mm: f64,
    /// At this target. Unit: mm.
    pub target_mm: f64,
    /// Standard uncertainty of the reading: scatter of the mean, expansion and temperature of the material. Unit: mm.
    pub u_mm: f64,
}

/// Why there is no answer.
#[derive(Debug, thiserror::Error)]
pub enum BeforeAfterError {
    /// Nothing can be read.
    #[error(transparent)]
    Measure(#[from] MeasureError),
    /// There is no value for a target.
    #[error("path `{path}`: {fault}")]
    Values {
        /// Its name.
        path: String,
        /// Why.
        fault: ValuesError,
    },
}

/// Measures and evaluates every path under every compensation; the curves of an axis stand together.
///
/// ```text
///     r(q) = r₀(q + c(q)) − r_nominal(q)     c of compensate values or tables     docs/model.md eq. 188
/// ```
///
/// # Errors
/// [`BeforeAfterError`].
///
/// # Source
/// Zhang et al. 2019, sections 3.2.1 and 3.2.2.
pub fn before_after(study: &BeforeAfter) -> Result<Vec<Curve>, BeforeAfterError> {
    let mut curves = Vec::new();
    for (seed, compensation) in (study.real.truth.seed..).zip(&study.states) {
        let mut real = study.real.clone();
        real.truth.seed = seed;
        let paths = real.paths.iter();
        let added = paths.map(|path| study.added_on(path, *compensation));
        real.truth.added = added.collect::<Result<_, _>>()?;
        let measurement = measure(&study.campaign, &real)?;
        for path in 0..real.paths.len() {
            curves.push(curve(study, &measurement, &real.truth.added, path, *compensation)?);
        }
    }
    let order = |c: &Curve| (c.axis, c.instrument, c.path, c.compensation as usize);
    curves.sort_by_key(order);
    Ok(curves)
}

impl BeforeAfter {
    /// The machine that is compensated: without the workpiece where only the machine is.
    fn model(&self, of: Compensation) -> Machine {
        match of {
            Compensation::Comprehensive => self.model.clone(),
            Compensation::Machine | Compensation::None => self.model.without_growth(),
        }
    }

    /// What is added at every station of a path.
    fn added_on(&self, path: &Path, of: Compensation) -> Result<Vec<Command>, BeforeAfterError> {
        let stations = path.stations.commands.iter().zip(&path.stations.approaches);
        if of == Compensation::None {
            return Ok(vec![Command::default(); path.stations.len()]);
        }
        let fault = |fault| BeforeAfterError::Values { path: path.name.clone(), fault };
        match &self.values {
            AppliedValues::Tables(of_state) => {
                let Some(tables) = of_state.iter().find(|t| t.of == of) else {
                    return Ok(vec![Command::default(); path.stations.len()]);
                };
                let model = self.model(of);
                let emulation = Emulation::new(&model, tables.control.as_ref(), &tables.content);
                Ok(stations.map(|(command, side)| emulation.added(command, side)).collect())
            }
            AppliedValues::Values => stations
                .map(|(command, side)| self.values_at(command, side, of).map_err(fault))
                .collect(),
        }
    }

    /// The values of all axes at a command.
    fn values_at(
        &self,
        command: &Command,
        approach: &Approach,
        of: Compensation,
    ) -> Result<Command, ValuesError> {
        let mut added = Command::default();
        for (axis, own) in self.model.axes().iter().enumerate() {
            let order = self.order(axis, command, of, own.kind);
            let table = compensation_values(&self.model, &order)?;
            let Some(node) = table.nodes.first() else { continue };
            let by_side = node.by_direction.filter(|_| approach[axis] != 0.0);
            let value = by_side.map_or(node.value, |[up, down]| match approach[axis] > 0.0 {
                true => up,
                false => down,
            });
            added[axis] = value.added;
        }
        Ok(added)
    }

    fn order(&self, axis: usize, command: &Command, of: Compensation, kind: AxisKind) -> Order {
        let increment = match kind {
            AxisKind::Linear => self.increment_mm,
            AxisKind::Rotary => self.increment_rad,
        };
        Order { axis, command: *command, positions: vec![command[axis]], increment, of }
    }

    /// The instrument of a path.
    fn laser(&self, path: usize) -> (usize, &Instrument) {
        let of = self.real.paths[path].stations.instruments.first().map_or(0, |i| *i as usize);
        (of, &self.campaign.instruments[of])
    }
}

/// The axis that moves on a path and whether a positive command lengthens the beam, if it is one axis alone and the beam
/// is along it.
fn axis_of(campaign: &Campaign, path: &Path) -> Option<(usize, f64)> {
    let stations = &path.stations;
    let first = *stations.commands.first()?;
    let moves = |axis: &usize| stations.commands.iter().any(|c| c[*axis] != first[*axis]);
    let moving: Vec<usize> = (0..first.len()).filter(moves).collect();
    let [axis] = moving[..] else { return None };
    let instrument = &campaign.instruments[*stations.instruments.first()? as usize];
    let other = stations.commands.iter().find(|c| c[axis] != first[axis])?;
    let along = |command: &Command| {
        instrument.nominal_reading(&campaign.machine, command, stations.directions[0])[0]
    };
    let way = other[axis] - first[axis];
    let slope = (along(other) - along(&first)) / way;
    let linear = campaign.machine.axes()[axis].kind == AxisKind::Linear;
    // A beam at an angle of 1 deg is short by 0.15 ‰.
    (linear && slope.abs() > 0.999).then_some((axis, slope.signum()))
}

fn curve(
    study: &BeforeAfter,
    measurement: &Measurement,
    added: &[Vec<Command>],
    path: usize,
    compensation: Compensation,
) -> Result<Curve, BeforeAfterError> {
    let stations = &study.real.paths[path];
    let (of, instrument) = study.laser(path);
    // Checked when the file was read.
    let (axis, sign) = axis_of(&study.campaign, stations).unwrap_or((0, 1.0));
    let measured = readings(study, measurement, path, (axis, sign));
    let length = measured.length();
    let budget = Budget { length, shares: shares(instrument, length), drift_u: drift_u(study, of) };
    // Without any contribution U is not 0 but not known.
    let is_known = budget.drift_u.is_some() || !budget.shares.is_empty();
    let result = iso230_2::evaluate(&measured, is_known.then_some(budget));
    let at_target = |target_mm: f64| {
        let mut command = stations.stations.commands.first().copied().unwrap_or_default();
        command[axis] = target_mm;
        command
    };
    let u_material = |target_mm: f64| {
        let direction = stations.stations.directions.first().copied().unwrap_or_default();
        u_of_material(study, instrument, &at_target(target_mm), direction)
    };
    let largest = largest(&result, instrument, u_material);
    let targets = result.positions.iter().map(|p| p.target);
    let added_mm = targets.map(|q| mean_added(stations, &added[path], axis, q)).collect();
    let command = at_target(largest.target_mm);
    let whole = match instrument.material {
        Some(_) => Compensation::Comprehensive,
        None => Compensation::Machine,
    };
    let order = study.order(axis, &command, whole, AxisKind::Linear);
    let refused = |fault| BeforeAfterError::Values { path: stations.name.clone(), fault };
    let table = compensation_values(&study.model(whole), &order).map_err(refused)?;
    let file_u_mm = table.nodes.first().and_then(|node| node.u);
    Ok(Curve {
        path,
        instrument: of,
        axis,
        compensation,
        measured,
        result,
        added_mm,
        largest,
        file_u_mm,
    })
}

/// The readings of a path as those of a positioning test.
fn readings(
    study: &BeforeAfter,
    measurement: &Measurement,
    path: usize,
    (axis, sign): (usize, f64),
) -> iso230_2::Measurement {
    let (_, instrument) = study.laser(path);
    let machine = &study.campaign.machine;
    let mut targets: BTreeMap<i64, Target> = BTreeMap::new();
    let rows = &measurement.readings;
    for i in (0..rows.len()).filter(|i| measurement.paths[*i] as usize == path) {
        let (command, side) = (&rows.commands[i], rows.approaches[i][axis]);
        let nominal = instrument.nominal_reading(machine, command, rows.directions[i]);
        let deviation = sign * (rows.values[i][0] - nominal[0]);
        // The same target to a picometre.
        let key = (command[axis] * 1e9).round() as i64;
        let target =
            targets.entry(key).or_insert(Target { position: command[axis], ..Target::default() });
        let list = if side < 0.0 { &mut target.down } else { &mut target.up };
        let run = u32::try_from(list.len() + 1).unwrap_or(u32::MAX);
        list.push(Reading { run, deviation });
    }
    iso230_2::Measurement { kind: Kind::Linear, targets: targets.into_values().collect() }
}

/// What of the uncertainty grows with the length: the expansion and the temperature of the material.
fn shares(laser: &Instrument, length_mm: f64) -> Vec<Share> {
    let Some(material) = &laser.material else { return Vec::new() };
    let whole = material.u_share();
    let by_temperature = (material.expansion_per_k.value * material.celsius.u.unwrap_or(0.0)).abs();
    let by_expansion = (whole * whole - by_temperature * by_temperature).max(0.0).sqrt();
    vec![
        Share { name: "expansion of the material", u: by_expansion * length_mm },
        Share { name: "temperature of the material", u: by_temperature * length_mm },
    ]
}

/// The drift of a virtual laser is known, if it has one: anywhere within what it comes to in the whole time.
fn drift_u(study: &BeforeAfter, laser: usize) -> Option<f64> {
    let per_hour = study.real.disturb.drift_per_hour[laser][0].abs();
    let whole_s: f64 = study.real.paths.iter().map(|p| p.stations.len() as f64 * p.dwell_s).sum();
    (per_hour > 0.0).then(|| per_hour * whole_s / 3600.0 / 12f64.sqrt())
}

/// Of the means of all targets and directions the one that is farthest from 0.
///
/// ```text
///     u² = s²/n + (u(κ) ℓ)²      s of n readings, its noise if n = 1      docs/model.md eq. 189
/// ```
fn largest(
    result: &Positioning,
    laser: &Instrument,
    u_material: impl Fn(f64) -> f64,
) -> LargestDeviation {
    let sides = result
        .positions
        .iter()
        .flat_map(|p| [p.up, p.down].into_iter().flatten().map(move |side| (p.target, side)));
    let worst = sides.max_by(|a, b| a.1.mean.abs().total_cmp(&b.1.mean.abs()));
    let Some((target_mm, side)) = worst else {
        return LargestDeviation { deviation_mm: 0.0, target_mm: 0.0, u_mm: 0.0 };
    };
    let scatter = side.s.unwrap_or(laser.noise[0]) / (side.count as f64).sqrt();
    let u_mm = scatter.hypot(u_material(target_mm));
    LargestDeviation { deviation_mm: side.mean, target_mm, u_mm }
}

/// u(κ) times the length of the material at a command, mm.
fn u_of_material(study: &BeforeAfter, laser: &Instrument, command: &Command, along: Vec3) -> f64 {
    let Some(material) = &laser.material else { return 0.0 };
    let none = ErrorValues::default();
    let view = laser.view(&study.campaign.machine, command, &none, along);
    let [wrench, ..] = laser.wrenches(&view);
    material.u_share() * laser.setup_slope(SetupError::Material, 0, &wrench, &view).abs()
}

fn mean_added(path: &Path, added: &[Command], axis: usize, target_mm: f64) -> f64 {
    let here = path.stations.commands.iter().zip(added);
    let mine: Vec<f64> =
        here.filter(|(c, _)| (c[axis] - target_mm).abs() < 1e-9).map(|(_, a)| a[axis]).collect();
    mine.iter().sum::<f64>() / mine.len().max(1) as f64
}
