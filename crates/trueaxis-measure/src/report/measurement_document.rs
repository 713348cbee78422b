//! A virtual measurement for programs: `trueaxis/measure/1`.

use super::measurement::MeasuredReport;
use crate::measure::virtual_campaign::{ChannelSummary, shown_unit};
use serde::Serialize;
use trueaxis_report::JsonSchema;
use trueaxis_report::Keyed;

/// The readings of a virtual machine.
#[derive(Debug, Serialize, JsonSchema)]
pub struct MeasurementDocument<'a> {
    /// Which document this is.
    #[schemars(extend("const" = "trueaxis/measure/1"))]
    pub schema: &'static str,
    /// Name of the campaign.
    pub name: &'a str,
    /// Name of the machine.
    pub machine: &'a str,
    /// Seed of the random numbers.
    pub seed: u64,
    /// Duration of the measurement, s.
    pub time_s: f64,
    /// Number of readings.
    pub readings: usize,
    /// Number of readings that were lost.
    pub lost: usize,
    /// The instruments of the campaign.
    pub instruments: Vec<InstrumentEntry<'a>>,
    /// Every channel of every instrument on every path.
    pub channels: Vec<ChannelEntry<'a>>,
    /// The files that were written.
    pub files: &'a [String],
}

/// An instrument.
#[derive(Debug, Serialize, JsonSchema)]
pub struct InstrumentEntry<'a> {
    /// Its name in the campaign.
    pub name: &'a str,
    /// What kind of instrument it is.
    pub kind: &'static str,
    /// Number of its readings.
    pub readings: usize,
}

/// Reading less nominal reading of one channel on one path.
#[derive(Debug, Serialize, JsonSchema)]
pub struct ChannelEntry<'a> {
    /// The path.
    pub path: &'a str,
    /// The instrument.
    pub instrument: &'a str,
    /// The channel.
    pub channel: &'static str,
    /// Number of readings.
    pub count: usize,
    /// `mean`, `rms` and `largest` (the greatest by amount, with its sign), each with `_um`, or `_urad` if
    /// the instrument reads angles.
    #[serde(flatten)]
    pub figures: Keyed<f64>,
    /// Row of the largest deviation, from 0.
    pub largest_row: usize,
}

impl<'a> MeasurementDocument<'a> {
    /// The document of a measurement.
    pub fn of(report: &'a MeasuredReport<'_>) -> Self {
        let measured = report.measurement;
        let instruments = report.campaign.instruments.iter().enumerate().map(|(of, instrument)| {
            let rows = measured.readings.instruments.iter().filter(|i| **i as usize == of);
            let (name, kind) = (instrument.name.as_str(), instrument.kind.name());
            InstrumentEntry { name, kind, readings: rows.count() }
        });
        Self {
            schema: "trueaxis/measure/1",
            name: &report.campaign.name,
            machine: report.campaign.machine.name(),
            seed: report.real.truth.seed,
            time_s: measured.time_s,
            readings: measured.readings.len(),
            lost: measured.lost,
            instruments: instruments.collect(),
            channels: report.summary().channels.iter().map(|s| channel(report, s)).collect(),
            files: report.files,
        }
    }
}

fn channel<'a>(report: &'a MeasuredReport<'_>, sum: &ChannelSummary) -> ChannelEntry<'a> {
    let instrument = &report.campaign.instruments[sum.instrument as usize];
    let unit = if instrument.sight.is_angle() { "urad" } else { "um" };
    let (_, scale) = shown_unit(instrument);
    let figures = [("mean", sum.mean), ("rms", sum.rms), ("largest", sum.largest)];
    let figures = figures.map(|(name, value)| (format!("{name}_{unit}"), value * scale));
    ChannelEntry {
        path: report.path(sum),
        instrument: &instrument.name,
        channel: report.channel(sum),
        count: sum.count,
        figures: figures.into_iter().collect(),
        largest_row: sum.largest_row,
    }
}
