//! The paths of a campaign: where the machine stands or goes while an instrument reads.
//!
//! ```text
//!     [[path]] ──kind──> places of the tool point on the workpiece, or axes ──Placing──> commands
//! ```

mod element;
mod kinematic;
mod linear;
mod overrun;
mod placing;
mod sphere;
mod spread;
mod touch;

pub use overrun::before_station;
pub use placing::turns_about;
pub use placing::{Placing, Strayed, leaves_travel};
pub use sphere::{directions_cone, directions_f, directions_s};
pub use spread::{Poses, read_poses};
pub use touch::{FreeSide, STAND_OFF_MM, hits};

use super::{Campaign, Reading, Readings};
use trueaxis_geometry::Vec3;
use trueaxis_input::{CsvTable, Diagnostics, Dimension, Item, Section};
use trueaxis_machine::axis::{AxisKind, Command};

/// More paths in one campaign are a slip of the pen.
const MOST_PATHS: usize = 200;
/// More stations on one path are a slip of the pen.
pub(crate) const MOST_STATIONS: usize = 200_000;

/// What a path may be.
const KINDS: &str = "\"A\", \"B\", \"C\" (one rotary axis turns), \"F\", \"S\" (Lei and Hsu 2003), \
                     \"cone\", \"BK1\" … (ISO 10791-6), \"circle\", \"diagonal\", \"targets\", \"touch\", \"element\", \"grid\", \"random\", \"table\"";

/// One test path.
#[derive(Debug, Clone, PartialEq)]
pub struct Path {
    /// Its name.
    pub name: String,
    /// The stations in order; their values are 0 until they are measured.
    pub stations: Readings,
    /// Standing still at every station, or going through them at this feed of the tool point
    /// against the workpiece, mm/s.
    pub feed_mm_per_s: Option<f64>,
    /// How long the machine stands before a reading, s.
    pub dwell_s: f64,
    /// How far an axis goes beyond a station that it does not reach from the stated side. Unit: mm or rad.
    pub overrun: f64,
}

/// `[[path]]`: the paths of a campaign.
pub fn read_paths(root: &Section<'_>, campaign: &Campaign) -> Option<Vec<Path>> {
    let Some(item) = root.get("path") else { return Some(Vec::new()) };
    let items = item.list()?;
    if items.len() > MOST_PATHS {
        let message = format!("{} paths are more than anybody measures", items.len());
        item.error("too-many-paths", message, &format!("at most {MOST_PATHS}"));
        return None;
    }
    let mut paths = Vec::new();
    for (i, item) in items.iter().enumerate() {
        paths.push(item.section(&format!("path.{}", i + 1), |s| read_path(s, campaign)).flatten());
    }
    let paths: Option<Vec<Vec<Path>>> = paths.into_iter().collect();
    paths.map(|p| p.into_iter().flatten().collect())
}

/// Which instrument a section means; the only one need not be named.
pub(crate) fn read_instrument(section: &Section<'_>, campaign: &Campaign) -> Option<usize> {
    let instrument = match section.text("instrument") {
        Some(name) => campaign.instrument(name),
        None => (campaign.instruments.len() == 1).then_some(0),
    };
    if instrument.is_none() {
        let names: Vec<&str> = campaign.instruments.iter().map(|i| i.name.as_str()).collect();
        let message = "which instrument reads here?".to_owned();
        let hint = format!("instrument = one of {}", names.join(", "));
        section.error("unknown-instrument", message, &hint);
        section.entries();
    }
    instrument
}

/// One `[[path]]`: one path, or those of a test that has several.
pub fn read_path(section: &Section<'_>, campaign: &Campaign) -> Option<Vec<Path>> {
    let instrument = read_instrument(section, campaign)?;
    let kind = section.require("kind", KINDS)?;
    let name = section.text("name");
    let feed_mm_per_s = section.quantity("feed", Dimension::Velocity);
    if feed_mm_per_s.is_some_and(|f| f <= 0.0) {
        let message = "at this feed nothing moves".to_owned();
        section.error("bad-feed", message, "feed = \"600 mm/min\"; without it the machine stands");
        return None;
    }
    let dwell = section.get("dwell");
    let dwell_s = dwell.and_then(|item| item.quantity(Dimension::Time)).unwrap_or(1.0);
    if let Some(item) = dwell.filter(|_| dwell_s < 0.0) {
        let message = format!("a dwell time is not negative, as {dwell_s} s");
        item.error("bad-dwell", message, "such as dwell = \"2 s\"");
    }
    let Some(overrun) = overrun::read_overrun(section, kind.text()?, campaign) else {
        // The other keys are of no use now.
        section.entries();
        return None;
    };
    let parts = match kind.text()? {
        word if kinematic::is_test(word) => {
            kinematic::read_test(section, &kind, campaign, instrument)
        }
        word => read_stations(section, &kind, word, campaign, instrument)
            .map(|stations| vec![(String::new(), stations)]),
    };
    let whole = name.map_or_else(|| kind.as_text().unwrap_or("path").to_owned(), str::to_owned);
    let path = |(part, mut stations): (String, Readings)| {
        let name = if part.is_empty() { whole.clone() } else { format!("{whole} {part}") };
        if stations.is_empty() {
            section.error("no-stations", format!("path {name} has no station"), "count = 20");
            return None;
        }
        if !placing::check_travel(section, &name, campaign, &stations) {
            return None;
        }
        come_from(&mut stations);
        if !overrun::check_room(section, &campaign.machine, &stations, overrun) {
            return None;
        }
        Some(Path { name, stations, feed_mm_per_s, dwell_s, overrun: overrun.amount })
    };
    parts?.into_iter().map(path).collect()
}

/// The stations of a path of this kind.
fn read_stations(
    section: &Section<'_>,
    kind: &Item<'_>,
    word: &str,
    campaign: &Campaign,
    instrument: usize,
) -> Option<Readings> {
    match word {
        "table" => read_table(section, campaign, instrument),
        "A" | "B" | "C" => sphere::read_rotary(section, kind, campaign, instrument),
        "F" => sphere::read_f(section, campaign, instrument),
        "S" => sphere::read_s(section, campaign, instrument),
        "cone" => sphere::read_cone(section, campaign, instrument),
        "circle" => linear::read_circle(section, campaign, instrument),
        "diagonal" => linear::read_diagonal(section, campaign, instrument),
        "targets" => linear::read_targets(section, campaign, instrument),
        "touch" => touch::read_touch(section, campaign, instrument),
        "element" => element::read_element(section, campaign, instrument),
        "grid" | "random" => spread::read_spread(section, campaign, instrument),
        other => {
            kind.error("unknown-path", format!("no path is called `{other}`"), KINDS);
            section.entries();
            None
        }
    }
}

/// From which side each axis comes, by the station before; axes that stand keep theirs. Where a
/// path states it already (targets, hits) nothing is changed.
pub fn come_from(stations: &mut Readings) {
    if stations.approaches.iter().any(|a| *a != [0.0; 6]) {
        return;
    }
    for i in 1..stations.len() {
        let (before, here) = (stations.commands[i - 1], stations.commands[i]);
        let came = stations.approaches[i - 1];
        stations.approaches[i] = std::array::from_fn(|axis| {
            let moved = here[axis] - before[axis];
            // Rounding of an inverse is no motion.
            if moved.abs() > 1e-9 { moved.signum() } else { came[axis] }
        });
    }
}

/// How many stations; a problem if there are none or too many.
pub(crate) fn read_count(section: &Section<'_>, key: &str, usual: usize) -> Option<usize> {
    let Some(item) = section.get(key) else { return Some(usual) };
    let count = item.count()?;
    if !(1..=MOST_STATIONS).contains(&count) {
        let message = format!("{count} is not from 1 to {MOST_STATIONS}");
        item.error("bad-count", message, &format!("{key} = {usual}"));
        return None;
    }
    Some(count)
}

/// The position of an axis with its unit.
pub(crate) fn read_position(item: &Item<'_>, kind: AxisKind) -> Option<f64> {
    item.quantity(match kind {
        AxisKind::Linear => Dimension::Length,
        AxisKind::Rotary => Dimension::Angle,
    })
}

/// `at = { A = "90 deg" }`: where the axes stand that the path does not move; 0 if not stated.
pub(crate) fn read_at(section: &Section<'_>, campaign: &Campaign) -> Option<Command> {
    let mut command = Command::default();
    let Some(item) = section.get("at") else { return Some(command) };
    let read = item.section(&section.path("at"), |s| read_axes(s, campaign, &mut command));
    read.flatten().map(|()| command)
}

/// Axes by letter into a command.
fn read_axes(section: &Section<'_>, campaign: &Campaign, command: &mut Command) -> Option<()> {
    let mut sound = true;
    for (i, axis) in campaign.machine.axes().iter().enumerate() {
        if let Some(item) = section.get(&axis.name.to_string()) {
            match read_position(&item, axis.kind) {
                Some(q) => command[i] = q,
                None => sound = false,
            }
        }
    }
    sound.then_some(())
}

/// Poses from a table whose columns are named by axis (mm, deg); where they are there, the sides from which the axes
/// come (`X_approach`) and the direction of the station (`n_x`, `n_y`, `n_z`).
fn read_table(section: &Section<'_>, campaign: &Campaign, instrument: usize) -> Option<Readings> {
    let file =
        section.require("table", "a CSV file with columns X, Y, Z (mm), A, C (deg)")?.text()?;
    let folder = campaign.path.parent().unwrap_or(std::path::Path::new(""));
    let path = folder.join(file);
    let mut problems = Diagnostics::new();
    let text = section.files().text(&path, "a table of poses (CSV)", &mut problems);
    let table = text.map(|t| CsvTable::parse(&path.display().to_string(), &t, &mut problems));
    let sound = !problems.has_errors();
    section.take_over(problems);
    let table = table.filter(|_| sound)?;
    let mut stations = Readings::default();
    let normal = ["n_x", "n_y", "n_z"].map(|name| table.column(name));
    for row in 0..table.rows() {
        let (mut command, mut approach) = ([0.0; 6], [0.0; 6]);
        for (i, axis) in campaign.machine.axes().iter().enumerate() {
            if let Some(column) = table.column(&format!("{}_approach", axis.name)) {
                approach[i] = column.values[row].clamp(-1.0, 1.0);
            }
            let Some(column) = table.column(&axis.name.to_string()) else { continue };
            let rotary = axis.kind == AxisKind::Rotary;
            command[i] = column.values[row] * if rotary { 1f64.to_radians() } else { 1.0 };
        }
        let group = table.column("group").map_or(row, |c| c.values[row].clamp(0.0, 1e9) as usize);
        let mut station = Reading { approach, ..station(command, campaign, instrument, group) };
        if let [Some(x), Some(y), Some(z)] = normal {
            let stated = Vec3::new(x.values[row], y.values[row], z.values[row]);
            station.direction = stated.try_normalize(0.0).unwrap_or(station.direction);
        }
        stations.push(station);
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
        motion: super::Motion::default(),
        line: 0,
    }
}
