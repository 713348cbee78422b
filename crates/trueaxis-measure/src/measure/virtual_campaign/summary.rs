//! What a measurement came to, channel by channel.

use super::Measurement;
use crate::instruments::instrument::Instrument;
use crate::measure::{Campaign, Readings};

/// One channel of one instrument on one path; mm or rad.
#[derive(Debug, Clone, PartialEq)]
pub struct ChannelSummary {
    /// The path, from 0.
    pub path: u32,
    /// The instrument, from 0.
    pub instrument: u32,
    /// The channel, from 0.
    pub channel: usize,
    /// How many readings.
    pub count: usize,
    /// The mean of the deviations. Unit: mm or rad.
    pub mean: f64,
    /// The root of the mean of their squares. Unit: mm or rad.
    pub rms: f64,
    /// The largest deviation, with its sign. Unit: mm or rad.
    pub largest: f64,
    /// The row of the largest one.
    pub largest_row: usize,
}

/// A measurement in few numbers.
#[derive(Debug, Clone, PartialEq)]
pub struct Summary {
    /// Path after path, instrument after instrument.
    pub channels: Vec<ChannelSummary>,
    /// Reading less nominal reading; one entry per row. Unit: mm or rad.
    pub deviations: Vec<[f64; 3]>,
}

/// Sums up what was read.
pub fn summarise(campaign: &Campaign, measurement: &Measurement) -> Summary {
    let deviations = deviations(campaign, &measurement.readings);
    let mut channels: Vec<ChannelSummary> = Vec::new();
    for (row, deviation) in deviations.iter().enumerate() {
        let of = measurement.readings.instruments[row];
        let path = measurement.paths[row];
        let count = campaign.instruments[of as usize].sight.channels();
        for (channel, value) in deviation.iter().enumerate().take(count) {
            let mine =
                |s: &ChannelSummary| (s.path, s.instrument, s.channel) == (path, of, channel);
            let at = channels.iter().rposition(mine).unwrap_or_else(|| {
                let (count, mean, rms, largest) = (0, 0.0, 0.0, 0.0);
                let largest_row = row;
                let new = ChannelSummary {
                    path,
                    instrument: of,
                    channel,
                    count,
                    mean,
                    rms,
                    largest,
                    largest_row,
                };
                channels.push(new);
                channels.len() - 1
            });
            let sum = &mut channels[at];
            sum.count += 1;
            sum.mean += value;
            sum.rms += value * value;
            if value.abs() > sum.largest.abs() {
                (sum.largest, sum.largest_row) = (*value, row);
            }
        }
    }
    for sum in &mut channels {
        sum.mean /= sum.count as f64;
        sum.rms = (sum.rms / sum.count as f64).sqrt();
    }
    Summary { channels, deviations }
}

/// Reading less what the nominal machine would read; of a hit what is missing to its radius.
pub fn deviations(campaign: &Campaign, readings: &Readings) -> Vec<[f64; 3]> {
    let one = |row: usize| {
        let instrument = &campaign.instruments[readings.instruments[row] as usize];
        let (command, direction) = (&readings.commands[row], readings.directions[row]);
        let nominal = instrument.nominal_reading(&campaign.machine, command, direction);
        let mut deviation = [0.0; 3];
        for c in 0..instrument.sight.channels() {
            deviation[c] = readings.values[row][c] - nominal[c];
        }
        deviation
    };
    (0..readings.len()).map(one).collect()
}

/// The unit of a channel in text output, and the factor from mm or rad.
pub fn shown_unit(instrument: &Instrument) -> (&'static str, f64) {
    if instrument.sight.is_angle() { ("µrad", 1e6) } else { ("µm", 1e3) }
}
