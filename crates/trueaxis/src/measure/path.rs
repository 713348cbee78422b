//! The paths of a campaign: where the machine stands or goes while an instrument reads.

use super::{Campaign, Reading, Readings};
use crate::files;
use trueaxis_geometry::input::{CsvTable, Diagnostics, Dimension, Section};
use trueaxis_machine::axis::AxisKind;

/// More paths in one campaign are a slip of the pen.
const MOST_PATHS: usize = 200;

/// One test path.
#[derive(Debug, Clone, PartialEq)]
pub struct Path {
    /// Its name.
    pub name: String,
    /// The stations in order; their values are 0 until somebody reads.
    pub stations: Readings,
    /// Standing still at every station, or going through them at this feed of the tool point
    /// against the workpiece, mm/s.
    pub feed_mm_per_s: Option<f64>,
    /// How long the machine stands before a reading, s.
    pub dwell_s: f64,
}

/// `[[path]]`: the paths of a campaign.
pub fn read_paths(root: &Section<'_>, campaign: &Campaign) -> Option<Vec<Path>> {
    let Some(item) = root.get("path") else { return Some(Vec::new()) };
    let items = item.list()?;
    let mut paths = Vec::new();
    for (i, item) in items.iter().enumerate().take(MOST_PATHS) {
        paths.push(item.section(&format!("path.{}", i + 1), |s| read_path(s, campaign)).flatten());
    }
    paths.into_iter().collect()
}

fn read_path(section: &Section<'_>, campaign: &Campaign) -> Option<Path> {
    let instrument = match section.text("instrument") {
        Some(name) => campaign.instrument(name),
        None => (campaign.instruments.len() == 1).then_some(0),
    };
    let Some(instrument) = instrument else {
        let names: Vec<&str> = campaign.instruments.iter().map(|i| i.name.as_str()).collect();
        let message = "which instrument reads on this path?".to_owned();
        section.error(
            "unknown-instrument",
            message,
            &format!("instrument = one of {}", names.join(", ")),
        );
        section.entries();
        return None;
    };
    let kind = section.require("kind", "\"table\" with table = \"poses.csv\"")?;
    let name = section.text("name");
    let feed_mm_per_s = section.quantity("feed", Dimension::Velocity);
    let dwell_s = section.quantity("dwell", Dimension::Time).unwrap_or(1.0);
    let stations = match kind.text()? {
        "table" => read_table(section, campaign, instrument),
        other => {
            kind.error("unknown-path", format!("no path is called `{other}`"), "\"table\"");
            None
        }
    };
    let name = name.map_or_else(|| kind.as_text().unwrap_or("path").to_owned(), str::to_owned);
    Some(Path { name, stations: stations?, feed_mm_per_s, dwell_s })
}

/// Poses from a table whose columns are named by axis (mm, deg).
fn read_table(section: &Section<'_>, campaign: &Campaign, instrument: usize) -> Option<Readings> {
    let file =
        section.require("table", "a CSV file with columns X, Y, Z (mm), A, C (deg)")?.text()?;
    let folder = campaign.path.parent().unwrap_or(std::path::Path::new(""));
    let path = folder.join(file);
    let mut problems = Diagnostics::new();
    let text = files::text(&path, "a table of poses (CSV)", &mut problems);
    let table = text.map(|t| CsvTable::parse(&path.display().to_string(), &t, &mut problems));
    let sound = !problems.has_errors();
    section.take_over(problems);
    let table = table.filter(|_| sound)?;
    let mut stations = Readings::default();
    for row in 0..table.rows() {
        let mut command = [0.0; 6];
        for (q, axis) in command.iter_mut().zip(campaign.machine.axes()) {
            let Some(column) = table.column(&axis.name.to_string()) else { continue };
            let rotary = axis.kind == AxisKind::Rotary;
            *q = column.values[row] * if rotary { 1f64.to_radians() } else { 1.0 };
        }
        stations.push(station(command, campaign, instrument, row));
    }
    Some(stations)
}

/// A station of an instrument that looks in its usual direction.
pub fn station(command: [f64; 6], campaign: &Campaign, instrument: usize, group: usize) -> Reading {
    Reading {
        command,
        approach: [0.0; 6],
        instrument: u32::try_from(instrument).unwrap_or(u32::MAX),
        direction: campaign.instruments[instrument].direction,
        value: [0.0; 3],
        group: u32::try_from(group).unwrap_or(u32::MAX),
        time_s: 0.0,
        line: 0,
    }
}
