//! A campaign measured on a machine that exists only as a file: the true one.
//!
//! ```text
//!     [truth]   ──> Truth    the machine and the set-ups as they are
//!     [disturb] ──> Disturb  noise, drift, axes that lag …
//!     [[path]] + both ──measure──> Measurement {readings}       the truth is not in it
//! ```
//!
//! ```text
//!     r = read(true pose at q + δ, true set-up) + drift · t + noise            docs/model.md eq. 114
//! ```
//!
//! q is what the program commands, δ where the axes are instead, with what a compensation adds; errors
//! follow the command, as in [`Machine::errors_at`].

mod file;
mod follow;
mod hit;
mod stage_tables;
mod summary;

pub use file::read_virtual;
pub use follow::{Stand, move_time_s, set_times};
pub use stage_tables::stage_tables;
pub use summary::{ChannelSummary, Summary, shown_unit, summarise};

use super::motion::{fill_motion, reference_from_tool};
use super::path::Path;
use super::{Campaign, Instrument, Readings};
use crate::instruments::instrument::View;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};
use rand_distr::{Distribution, StandardNormal};
use rayon::prelude::*;
use std::path::PathBuf;
use std::sync::Arc;
use trueaxis_input::Diagnostics;
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{AxisKind, Command, MAX_AXES};
use trueaxis_machine::chain::{CommandFault, Link};
use trueaxis_machine::errors::{ErrorName, ErrorValues};
use trueaxis_machine::heat::TemperatureLog;

/// The machine changes its temperature so often, s …
const TEMPERATURE_STEP_S: f64 = 10.0;
/// … but no more often than this in a whole campaign.
const MOST_TEMPERATURES: f64 = 500.0;
/// No campaign reads more often.
const MOST_READINGS: usize = 5_000_000;

/// A campaign with all that is needed to measure it without a machine.
#[derive(Debug, Clone)]
pub struct VirtualCampaign {
    /// Where the machine stands or goes.
    pub paths: Vec<Path>,
    /// The machine and the set-ups as they are.
    pub truth: Truth,
    /// Disturbances of readings.
    pub disturb: Disturb,
}

/// How far the true machine is from what its file states.
#[derive(Debug, Clone, PartialEq)]
pub struct Drawn {
    /// What is uncertain: [`Machine::uncertain_quantities`].
    pub quantities: Vec<String>,
    /// By how many standard uncertainties each is off. Unit: 1.
    pub factors: Vec<f64>,
}

impl Drawn {
    /// Draws every uncertain quantity of a machine.
    pub fn new(machine: &Machine, mut normal: impl FnMut() -> f64) -> Self {
        let quantities = machine.uncertain_quantities();
        let factors = quantities.iter().map(|_| normal()).collect();
        Self { quantities, factors }
    }
}

/// The machine and the set-ups as they are.
#[derive(Debug, Clone)]
pub struct Truth {
    /// The true machine.
    pub machine: Machine,
    /// Its file, if it is another than that of the campaign.
    pub machine_path: Option<PathBuf>,
    /// Errors that the campaign replaces, mm or rad.
    pub errors: Vec<(ErrorName, f64)>,
    /// By how many standard uncertainties each error is away from its file; `None`: by none.
    pub factors: Option<Drawn>,
    /// The instruments; their unknowns are those of which [`Truth::setups`] has the values.
    pub instruments: Vec<Instrument>,
    /// The true values of the set-up unknowns of each instrument. Unit: mm, rad or 1.
    pub setups: Vec<Vec<f64>>,
    /// Temperatures during the campaign.
    pub log: Option<Arc<TemperatureLog>>,
    /// What a compensation adds to the command of each station of each path, mm and rad; empty: nothing.
    pub added: Vec<Vec<Command>>,
    /// The same seed gives the same readings to the bit.
    pub seed: u64,
}

/// Disturbances of readings.
#[derive(Debug, Clone, PartialEq)]
pub struct Disturb {
    /// Times the noise of the instruments; 0: none. Unit: 1.
    pub noise: f64,
    /// The drift of the zero of each instrument and channel. Unit: mm/h or rad/h.
    pub drift_per_hour: Vec<[f64; 3]>,
    /// Readings are multiples of this; 0: not rounded. Unit: mm or rad.
    pub resolution: Vec<f64>,
    /// The share of readings that are wrong. Unit: 1.
    pub outlier_share: f64,
    /// By how many times the noise of the instrument they are wrong. Unit: 1.
    pub outlier_size: f64,
    /// The share of rows that are lost. Unit: 1.
    pub lost_share: f64,
    /// How the axes move.
    pub axes: [AxisDisturb; MAX_AXES],
}

/// How an axis follows its command.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct AxisDisturb {
    /// Standard deviation of where it stops. Unit: mm or rad.
    pub repeatability: f64,
    /// How far the motor turns before the slide follows. Unit: mm or rad.
    pub backlash: f64,
    /// The time constant with which it follows, s: 1/Kv.
    pub lag_s: f64,
    /// How far it sticks when it reverses. Unit: mm or rad.
    pub spike: f64,
    /// The time constant with which it comes free, s.
    pub spike_time_s: f64,
}

/// What was read.
#[derive(Debug, Clone)]
pub struct Measurement {
    /// All rows that were not lost.
    pub readings: Readings,
    /// The path that each row was read on.
    pub paths: Vec<u32>,
    /// Where the axes really were, less the command, mm or rad.
    pub offsets: Vec<Command>,
    /// Rows that are wrong on purpose.
    pub outliers: Vec<usize>,
    /// How many rows were lost.
    pub lost: usize,
    /// How long the campaign takes, s.
    pub time_s: f64,
}

/// Why nothing can be read.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum MeasureError {
    /// A station stands where an error table of the machine says nothing.
    #[error("path `{path}`, station {station}: {fault}")]
    Outside {
        /// The name of the path.
        path: String,
        /// Counted from 1.
        station: usize,
        /// Why.
        fault: CommandFault,
    },
    /// A touch probe hits nothing.
    #[error("path `{path}`, station {station}: the probe does not trigger: {why}")]
    NoHit {
        /// The name of the path.
        path: String,
        /// Counted from 1.
        station: usize,
        /// Why.
        why: &'static str,
    },
    /// More readings than memory.
    #[error("{0} readings, and {MOST_READINGS} are the most")]
    TooMany(usize),
    /// The temperature log ends before the campaign.
    #[error("the temperature log says nothing of {0:.0} s; the campaign runs from 0")]
    Temperature(f64),
    /// The log does not fit the machine.
    #[error("temperatures: {0}")]
    Heat(String),
}

/// One source of chance each, so that what is switched off changes nothing else.
#[derive(Clone, Copy)]
pub(super) enum Chance {
    Truth,
    Noise,
    Repeatability,
    Outliers,
    Lost,
    Touches,
    Stages,
}

pub(super) fn chance(seed: u64, of: Chance) -> ChaCha8Rng {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    random.set_stream(of as u64);
    random
}

pub(super) fn normal(random: &mut ChaCha8Rng) -> f64 {
    StandardNormal.sample(random)
}

/// Standard normal numbers for touches outside of a campaign, the same for the same seed.
pub fn touch_noise(seed: u64) -> impl FnMut() -> f64 {
    let mut random = chance(seed, Chance::Touches);
    move || normal(&mut random)
}

/// Between 0 and 1, with 1 left out.
fn unit(random: &mut ChaCha8Rng) -> f64 {
    (random.next_u64() >> 11) as f64 / (1u64 << 53) as f64
}

/// Reads all stations on the true machine.
///
/// # Errors
/// A station outside the tables of the machine, a hit that misses, a log that is too short.
pub fn measure(campaign: &Campaign, real: &VirtualCampaign) -> Result<Measurement, MeasureError> {
    let count = real.paths.iter().map(|p| p.stations.len()).sum();
    if count > MOST_READINGS {
        return Err(MeasureError::TooMany(count));
    }
    let (stands, time_s) = follow::follow(campaign, real);
    let step_s = TEMPERATURE_STEP_S.max(time_s / MOST_TEMPERATURES);
    let moments = moments(real, time_s, step_s)?;
    let additions = additions(real, &stands);
    let read = |(stand, addition): (&Stand, &Addition)| {
        let at = (stand.reading.time_s / step_s).max(0.0) as usize;
        read_one(campaign, real, &moments[at.min(moments.len() - 1)], stand, addition)
    };
    let rows: Result<Vec<_>, _> = stands.par_iter().zip(&additions).map(read).collect();
    let mut lost = chance(real.truth.seed, Chance::Lost);
    let mut measurement = Measurement {
        readings: Readings::default(),
        paths: Vec::new(),
        offsets: Vec::new(),
        outliers: Vec::new(),
        lost: 0,
        time_s,
    };
    for ((row, stand), addition) in rows?.into_iter().zip(&stands).zip(&additions) {
        if unit(&mut lost) < real.disturb.lost_share {
            measurement.lost += 1;
            continue;
        }
        if addition.outlier {
            measurement.outliers.push(measurement.readings.len());
        }
        measurement.paths.push(stand.path);
        measurement.offsets.push(stand.offset);
        measurement.readings.push(row);
    }
    fill_motion(&mut measurement.readings, &campaign.machine, &campaign.instruments);
    Ok(measurement)
}

/// When each station of one path is read after its beginning, s: by the limits of the axes and the feed.
pub fn station_times_s(campaign: &Campaign, path: &Path) -> Vec<f64> {
    let real = VirtualCampaign {
        paths: vec![path.clone()],
        truth: file::plain(campaign, 1),
        disturb: Disturb::none(campaign.instruments.len()),
    };
    let (stands, _) = follow::follow(campaign, &real);
    stands.iter().map(|stand| stand.reading.time_s).collect()
}

/// The true machine and the instruments at the temperatures of a time.
struct Moment {
    machine: Machine,
    instruments: Vec<Instrument>,
}

/// Every step of the time, or one for all times.
fn moments(real: &VirtualCampaign, time_s: f64, step_s: f64) -> Result<Vec<Moment>, MeasureError> {
    let Some(log) = &real.truth.log else {
        let (machine, instruments) = (real.truth.machine.clone(), real.truth.instruments.clone());
        return Ok(vec![Moment { machine, instruments }]);
    };
    let steps = (time_s / step_s) as usize;
    if let (Some(first), Some(last)) = (log.times_s().first(), log.times_s().last()) {
        // Said before thousands of machines are warmed.
        if *first > 0.0 || *last < time_s {
            return Err(MeasureError::Temperature(if *first > 0.0 { 0.0 } else { time_s }));
        }
    }
    let warm = |k: usize| {
        let at = ((k as f64 + 0.5) * step_s).min(time_s);
        let conditions = log.at(at).ok_or(MeasureError::Temperature(at))?;
        let mut problems = Diagnostics::new();
        let machine = real.truth.machine.at(&conditions, &mut problems).ok_or_else(|| {
            let why = problems.iter().map(|d| d.message.clone()).collect::<Vec<_>>();
            MeasureError::Heat(why.join("; "))
        })?;
        let warm = |instrument: &Instrument| {
            let unread = |sensor| {
                let name = &instrument.name;
                MeasureError::Heat(format!("the log has no `{sensor}` for the material of {name}"))
            };
            let material = instrument.material.as_ref().map(|m| m.at(&conditions)).transpose();
            Ok(Instrument { material: material.map_err(unread)?, ..instrument.clone() })
        };
        let instruments = real.truth.instruments.iter().map(warm).collect::<Result<_, _>>()?;
        Ok(Moment { machine, instruments })
    };
    (0..=steps).into_par_iter().map(warm).collect()
}

/// What is added to the readings of one row.
struct Addition {
    value: [f64; 3],
    outlier: bool,
}

fn additions(real: &VirtualCampaign, stands: &[Stand]) -> Vec<Addition> {
    let mut noise = chance(real.truth.seed, Chance::Noise);
    let mut wrong = chance(real.truth.seed, Chance::Outliers);
    let addition = |stand: &Stand| {
        let of = stand.reading.instrument as usize;
        let instrument = &real.truth.instruments[of];
        let hours = stand.reading.time_s / 3600.0;
        let mut value = [0.0; 3];
        for (c, value) in value.iter_mut().enumerate() {
            *value = real.disturb.noise * instrument.noise[c] * normal(&mut noise)
                + real.disturb.drift_per_hour[of][c] * hours;
        }
        // Always as many numbers, so that the share does not change the other rows.
        let (draw, channel, side) = (unit(&mut wrong), unit(&mut wrong), unit(&mut wrong));
        let outlier = draw < real.disturb.outlier_share;
        if outlier {
            let c = (channel * instrument.sight.channels() as f64) as usize;
            let by = real.disturb.outlier_size * instrument.noise[c];
            value[c] += if side < 0.5 { -by } else { by };
        }
        Addition { value, outlier }
    };
    stands.iter().map(addition).collect()
}

fn read_one(
    campaign: &Campaign,
    real: &VirtualCampaign,
    moment: &Moment,
    stand: &Stand,
    addition: &Addition,
) -> Result<super::Reading, MeasureError> {
    let of = stand.reading.instrument as usize;
    let (machine, instrument) = (&moment.machine, &moment.instruments[of]);
    let path = || real.paths.get(stand.path as usize).map_or(String::new(), |p| p.name.clone());
    let station = stand.station as usize + 1;
    let outside = |fault| MeasureError::Outside { path: path(), station, fault };
    let step = real.disturb.resolution[of];
    let mut row = stand.reading;
    let tool = TrueTool { real, machine, instrument, setup: &real.truth.setups[of] };
    if instrument.kind.triggers() {
        let reach = instrument.length_mm + addition.value[0];
        let found = hit::hit(campaign, &tool, stand, reach).map_err(|miss| match miss {
            hit::Miss::Outside(fault) => outside(fault),
            hit::Miss::No(why) => MeasureError::NoHit { path: path(), station, why },
        })?;
        row.command = found;
        for (q, axis) in row.command.iter_mut().zip(machine.axes()) {
            if axis.kind == AxisKind::Linear {
                *q = rounded(*q, step);
            }
        }
        row.value = [instrument.length_mm, 0.0, 0.0];
        return Ok(row);
    }
    let actual = tool.pose(&row.command, stand).map_err(outside)?;
    let nominal = reference_from_tool(
        &campaign.machine,
        instrument.reference,
        &row.command,
        &ErrorValues::default(),
    );
    let drifted = instrument.drifted(&campaign.machine, &row.command, row.time_s);
    let view = View { nominal, actual, direction: row.direction, drifted };
    let read = instrument.read(&view, tool.setup);
    let against = match instrument.sight {
        crate::instruments::instrument::Sight::Distance => [0.0; 3],
        _ => {
            campaign.instruments[of].nominal_reading(&campaign.machine, &row.command, row.direction)
        }
    };
    row.value = [0.0; 3];
    for c in 0..instrument.sight.channels() {
        // As it stands in the file: most as deviations from the nominal reading.
        row.value[c] = rounded(read[c] + addition.value[c] - against[c], step) + against[c];
    }
    Ok(row)
}

/// To the nearest multiple of a step.
fn rounded(value: f64, step: f64) -> f64 {
    if step > 0.0 { (value / step).round() * step } else { value }
}

/// The tool as it is.
struct TrueTool<'a> {
    real: &'a VirtualCampaign,
    machine: &'a Machine,
    instrument: &'a Instrument,
    setup: &'a [f64],
}

impl TrueTool<'_> {
    /// reference_from_tool where the axes are off their command as they are at this stand.
    fn pose(&self, command: &Command, stand: &Stand) -> Result<Link, CommandFault> {
        let mut errors = self.machine.errors_at(command, &stand.reading.approach)?;
        if let Some(drawn) = &self.real.truth.factors {
            let u = self.machine.uncertainties_at(command, &drawn.quantities);
            errors = u.displaced(&errors, &drawn.factors);
        }
        errors = self.instrument.errors_seen(&errors);
        let mut actual = *command;
        for (q, off) in actual.iter_mut().zip(stand.offset) {
            *q += off;
        }
        let added = self.real.truth.added.get(stand.path as usize);
        if let Some(added) = added.and_then(|path| path.get(stand.station as usize)) {
            actual.iter_mut().zip(added).for_each(|(q, more)| *q += more);
        }
        Ok(reference_from_tool(self.machine, self.instrument.reference, &actual, &errors))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn readings_are_multiples_of_the_resolution() {
        assert_eq!(rounded(0.00123, 0.0005), 0.001);
        assert_eq!(rounded(0.00123, 0.0), 0.00123);
    }

    #[test]
    fn each_source_of_chance_has_its_own_numbers() {
        let first = |of| unit(&mut chance(1, of));
        assert_ne!(first(Chance::Noise), first(Chance::Lost));
        assert_eq!(first(Chance::Noise), first(Chance::Noise));
    }
}
