//! A virtual measurement in text and on a page.

use crate::measure::virtual_campaign::{
    ChannelSummary, Measurement, Summary, VirtualCampaign, shown_unit, summarise,
};
use crate::measure::{Campaign, Kind};
use trueaxis_geometry::Vec3;
use trueaxis_machine::errors::ErrorValues;
use trueaxis_report::{Band, Picture, Polar, PolarLine, Report, Scatter, Section, Table};

/// More points say nothing new to the eye.
const MOST_POINTS: usize = 4000;
/// Rows that the terminal shows of each instrument.
const FIRST_ROWS: usize = 5;

/// What a report of a measurement shows.
pub struct MeasuredReport<'a> {
    /// The campaign.
    pub campaign: &'a Campaign,
    /// With its paths.
    pub real: &'a VirtualCampaign,
    /// What was read.
    pub measurement: &'a Measurement,
    /// The files that were written.
    pub files: &'a [String],
}

impl MeasuredReport<'_> {
    pub(super) fn summary(&self) -> Summary {
        summarise(self.campaign, self.measurement)
    }

    pub(super) fn path(&self, sum: &ChannelSummary) -> &str {
        self.real.paths.get(sum.path as usize).map_or("", |p| p.name.as_str())
    }

    pub(super) fn channel(&self, sum: &ChannelSummary) -> &'static str {
        let instrument = &self.campaign.instruments[sum.instrument as usize];
        // Of a hit the deviation is what lacks to the radius.
        if instrument.kind.triggers() { "hit" } else { instrument.kind.channels()[sum.channel] }
    }

    fn table(&self, summary: &Summary) -> Table {
        let headings =
            ["path", "instrument", "channel", "readings", "mean", "rms", "largest", "unit"];
        Table::new(headings).most_on_terminal(usize::MAX).rows(summary.channels.iter().map(|sum| {
            let instrument = &self.campaign.instruments[sum.instrument as usize];
            let (unit, scale) = shown_unit(instrument);
            let [mean, rms, largest] =
                [sum.mean, sum.rms, sum.largest].map(|v| format!("{:.2}", v * scale + 0.0));
            let (path, channel) = (self.path(sum).to_owned(), self.channel(sum).to_owned());
            let count = sum.count.to_string();
            [path, instrument.name.clone(), channel, count, mean, rms, largest, unit.to_owned()]
        }))
    }

    fn lines(&self) -> Vec<String> {
        let m = self.measurement;
        let truth = match &self.real.truth.machine_path {
            Some(_) => format!("measured on {} of [truth]", self.real.truth.machine.name()),
            None => format!("measured on {}", self.campaign.machine.name()),
        };
        let minutes = (m.time_s / 60.0).floor();
        vec![
            format!("{truth}, seed {}: virtual readings", self.real.truth.seed),
            format!(
                "paths: {}, readings: {}, lost: {}, time: {minutes:.0} min {:.0} s",
                self.real.paths.len(),
                m.readings.len(),
                m.lost,
                m.time_s - 60.0 * minutes
            ),
        ]
    }

    /// The first rows of one instrument, as they stand in its file.
    fn first_rows(&self, of: usize) -> String {
        let index = u32::try_from(of).unwrap_or(u32::MAX);
        let readings = &self.measurement.readings;
        let rows = readings.instruments.iter().enumerate().filter(|(_, i)| **i == index);
        let first: Vec<usize> = rows.map(|(row, _)| row).take(FIRST_ROWS).collect();
        let some = readings.filtered(|row| first.contains(&row));
        some.table(&self.campaign.machine, &self.campaign.instruments[of], index)
    }
}

/// The measurement; pictures are drawn on the page.
pub fn measurement_report<'a>(answer: &MeasuredReport<'_>) -> Report<'a> {
    let summary = &answer.summary();
    let instruments = answer.campaign.instruments.iter().enumerate();
    // What has been written to files need not be shown.
    let first = instruments.filter(|_| answer.files.is_empty()).map(|(of, instrument)| {
        let title = format!("The first rows of {}; -o FOLDER writes all", instrument.name);
        Section::new(title).on_terminal().code(answer.first_rows(of))
    });
    let mut report = Report::new(&answer.campaign.name);
    report.lines = answer.lines();
    report
        .section(Section::new("Readings less nominal").table(answer.table(summary)))
        .sections(first)
        .section(Section::new("Written").on_terminal().list(answer.files.iter().cloned()))
        .sections(pictures(answer, summary).into_iter().map(Section::from))
}

/// Readings over stations, path after path, as in Figs 10–12 of Lei and Hsu 2003; circles of a ball-bar
/// round their centre.
fn pictures(report: &MeasuredReport<'_>, summary: &Summary) -> Vec<Picture> {
    let mut pictures = Vec::new();
    for path in 0..report.real.paths.len() {
        for (of, instrument) in report.campaign.instruments.iter().enumerate() {
            let rows = rows_of(report, path, of);
            if rows.is_empty() {
                continue;
            }
            pictures.push(over_stations(report, summary, (path, of), &rows));
            if instrument.kind == Kind::BallBar {
                pictures.extend(around(report, summary, (path, of), &rows));
            }
        }
    }
    pictures
}

/// Rows of an instrument on a path, thinned out for the eye.
fn rows_of(report: &MeasuredReport<'_>, path: usize, instrument: usize) -> Vec<usize> {
    let m = report.measurement;
    let mine = |row: &usize| {
        m.paths[*row] as usize == path && m.readings.instruments[*row] as usize == instrument
    };
    let rows: Vec<usize> = (0..m.readings.len()).filter(mine).collect();
    let stride = rows.len().div_ceil(MOST_POINTS).max(1);
    rows.into_iter().step_by(stride).collect()
}

fn title(report: &MeasuredReport<'_>, (path, of): (usize, usize)) -> String {
    let path = &report.real.paths[path];
    let how = match path.feed_mm_per_s {
        Some(feed) => format!("feed {:.0} mm/min", feed * 60.0),
        None => "standing".to_owned(),
    };
    format!("Path {}, {}: {how}", path.name, report.campaign.instruments[of].name)
}

fn over_stations(
    report: &MeasuredReport<'_>,
    summary: &Summary,
    at: (usize, usize),
    rows: &[usize],
) -> Picture {
    let instrument = &report.campaign.instruments[at.1];
    let (unit, scale) = shown_unit(instrument);
    let single = instrument.kind.triggers();
    let bands = (0..instrument.sight.channels()).map(|c| {
        let label = if single { "hit" } else { instrument.kind.channels()[c] };
        let line = rows
            .iter()
            .enumerate()
            .map(|(k, row)| ((k + 1) as f64, summary.deviations[*row][c] * scale, 0.0));
        Band { label: label.to_owned(), colour: c, line: line.collect(), points: Vec::new() }
    });
    Picture::Scatter(Scatter {
        title: title(report, at),
        note: String::new(),
        x: "station".to_owned(),
        y: format!("reading less nominal, {unit}"),
        from_zero: true,
        bands: bands.collect(),
        dashed: Vec::new(),
    })
}

/// A ball-bar round its centre.
fn around(
    report: &MeasuredReport<'_>,
    summary: &Summary,
    at: (usize, usize),
    rows: &[usize],
) -> Option<Picture> {
    let instrument = &report.campaign.instruments[at.1];
    let bar = |row: &usize| {
        let command = &report.measurement.readings.commands[*row];
        let none = ErrorValues::default();
        let view = instrument.view(&report.campaign.machine, command, &none, Vec3::x());
        let p = view.nominal.linear() * instrument.tool_point_mm + view.nominal.shift_mm();
        p - instrument.reference_point_mm
    };
    let bars: Vec<Vec3> = rows.iter().map(bar).collect();
    let mut normal = Vec3::zeros();
    for pair in bars.windows(2) {
        normal += pair[0].cross(&pair[1]);
    }
    // A bar that only swings to and fro has no circle.
    let normal = normal.try_normalize(1e-6)?;
    let flat = |v: Vec3| (v - normal * normal.dot(&v)).try_normalize(0.1);
    let across = flat(Vec3::x()).or_else(|| flat(Vec3::y()))?;
    let up = normal.cross(&across);
    let points = rows.iter().zip(&bars).map(|(row, bar)| {
        (bar.dot(&up).atan2(bar.dot(&across)), summary.deviations[*row][0] * 1e3)
    });
    let line = PolarLine { label: "length".to_owned(), colour: 0, points: points.collect() };
    let title = title(report, at);
    Some(Picture::Polar(Polar { title, note: String::new(), lines: vec![line] }))
}
