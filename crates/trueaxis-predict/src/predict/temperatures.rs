//! `[temperature]` of a study: constant, or a log that runs on while the part is made.

use super::Error;
use std::path::Path;
use std::sync::Arc;
use trueaxis_input::{Diagnostics, Dimension, Section};
use trueaxis_machine::Machine;
use trueaxis_machine::heat::{Conditions, TemperatureRun, UnknownGrowth, WarmingMachine};
use trueaxis_motion::read_temperature_log;
use trueaxis_part::testpiece::ToolPosition;

/// How time runs while the part is made.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Pace {
    /// The tool tip goes on at this speed, mm/s.
    Feed(f64),
    /// The whole part takes so long, evenly, s.
    Duration(f64),
}

/// A log, its time when the part was begun, and how fast it is made.
#[derive(Debug, Clone, PartialEq)]
pub struct RunningTemperatures {
    /// The log from its start on.
    pub run: TemperatureRun,
    /// The clock of the part.
    pub pace: Pace,
}

impl RunningTemperatures {
    /// When each place along a way is reached: lengths of the way up to it, mm.
    pub fn times_s(&self, way_mm: &[f64]) -> Vec<f64> {
        let whole_mm = way_mm.last().copied().unwrap_or(0.0);
        let time = |mm: &f64| match self.pace {
            Pace::Feed(mm_per_s) => mm / mm_per_s,
            Pace::Duration(_) if whole_mm == 0.0 => 0.0,
            Pace::Duration(s) => s * mm / whole_mm,
        };
        way_mm.iter().map(time).collect()
    }
}

/// What `[temperature]` says.
#[derive(Default)]
pub(super) struct StudyTemperatures {
    /// At the start, or always; none without the section.
    pub conditions: Option<Conditions>,
    /// The log after the start.
    pub running: Option<RunningTemperatures>,
}

impl StudyTemperatures {
    /// Reads `scale_x = "30.5 degC"`, or `log = "hall.csv"`, `start = "2 h"` and `duration = "3 h"`
    /// or (where `has_feed`) `feed = "500 mm/min"`.
    pub fn read(root: &Section<'_>, folder: &Path, has_feed: bool) -> Self {
        let read = |section: &Section<'_>| match section.get("log") {
            Some(_) => read_log(section, folder, has_feed).unwrap_or_default(),
            None => Self { conditions: Some(Conditions::read(section)), running: None },
        };
        root.section("temperature", read).unwrap_or_default()
    }

    /// The machine at the start; what does not fit goes to the problems of the study.
    ///
    /// A part whose growth is not known is not predicted: without its temperature the machine file would give
    /// the error of the machine for that of the part.
    pub fn warm(&self, root: &Section<'_>, machine: Machine) -> Option<Machine> {
        let Some(conditions) = &self.conditions else {
            let unknown = machine.unknown_growth(&Conditions::default());
            // What is wrong with a stated section was reported there.
            if let (Some(unknown), None) = (&unknown, root.get("temperature")) {
                no_workpiece(root, &machine, unknown);
            }
            return Some(machine).filter(|_| unknown.is_none());
        };
        let mut problems = Diagnostics::new();
        let warm = machine.at(conditions, &mut problems);
        let can_run = |running: &RunningTemperatures| {
            // Only what is wrong with the log as a whole: the rest was reported above.
            let mut more = Diagnostics::new();
            let can = WarmingMachine::new(&machine, &running.run, &mut more).is_some();
            if !can && !problems.has_errors() {
                problems.append(more);
            }
            can
        };
        let sound = self.running.as_ref().is_none_or(can_run);
        root.take_over(problems);
        let unknown = warm.as_ref().and_then(|warm| warm.unknown_growth(conditions));
        if let Some(unknown) = &unknown {
            no_workpiece(root, &machine, unknown);
        }
        warm.filter(|_| sound && unknown.is_none())
    }
}

/// The workpiece grows, and nothing says how warm it is.
fn no_workpiece(root: &Section<'_>, machine: &Machine, unknown: &UnknownGrowth) {
    let UnknownGrowth { over_mm, per_k_mm, .. } = unknown;
    let message = format!(
        "the temperature of the workpiece is not given: each K above 20 °C displaces the part by {:.1} µm over \
         {over_mm} mm, and a part is not predicted without it",
        per_k_mm * 1e3
    );
    let sensors = machine.heat().workpiece.iter().flat_map(|w| &w.sensors);
    let sensors: Vec<String> = sensors.map(|s| format!("{} = \"20 degC\"", s.name)).collect();
    let hint = format!("[temperature] {}, if it is at 20 °C", sensors.join(", "));
    root.error("no-workpiece-temperature", message, &hint);
}

fn read_log(section: &Section<'_>, folder: &Path, has_feed: bool) -> Option<StudyTemperatures> {
    let path = section.require("log", "a CSV log of temperatures").and_then(|i| i.text());
    let hint = "the time of the log when the part is begun, such as \"2 h\"";
    let start = section.require("start", hint);
    let start_s = start.as_ref().and_then(|i| i.quantity(Dimension::Time));
    let pace = read_pace(section, has_feed);
    let mut problems = Diagnostics::new();
    let log =
        path.and_then(|p| read_temperature_log(section.files(), &folder.join(p), &mut problems));
    section.take_over(problems);
    let (log, start_s) = (Arc::new(log?), start_s?);
    let conditions = log.at(start_s);
    if let (None, Some(item)) = (&conditions, start) {
        let outside = log.outside(start_s);
        item.error(outside.code, outside.message, &outside.hint);
    }
    let running = RunningTemperatures { run: TemperatureRun { log, start_s }, pace: pace? };
    Some(StudyTemperatures { conditions: Some(conditions?), running: Some(running) })
}

fn read_pace(section: &Section<'_>, has_feed: bool) -> Option<Pace> {
    let duration = section.get("duration");
    // Not asked for, it is an unknown key.
    let feed = if has_feed { section.get("feed") } else { None };
    let (item, dimension) = match (duration, feed) {
        (Some(item), None) => (item, Dimension::Time),
        (None, Some(item)) => (item, Dimension::Velocity),
        _ => {
            let (message, hint) = match has_feed {
                true => (
                    "a log needs the clock of the part: `duration` or `feed`",
                    "duration = \"40 min\", or feed = \"500 mm/min\"",
                ),
                false => ("a log needs the clock of the part: `duration`", "duration = \"3 h\""),
            };
            section.error("missing-key", message.to_owned(), hint);
            return None;
        }
    };
    let value = item.quantity(dimension)?;
    if value <= 0.0 {
        item.error("not-positive", "this must be above zero".to_owned(), "check its sign");
        return None;
    }
    Some(match dimension {
        Dimension::Time => Pace::Duration(value),
        _ => Pace::Feed(value),
    })
}

/// Hands out the machine of each place in the order in which they are made.
pub(super) struct CuttingClock {
    warming: Option<WarmingMachine>,
    times_s: Vec<f64>,
    present: Option<(Machine, f64)>,
}

impl CuttingClock {
    /// For the positions of a test piece: along the path of the tool tip.
    pub fn of(
        machine: &Machine,
        temperatures: Option<&RunningTemperatures>,
        positions: &[ToolPosition],
    ) -> Self {
        let mut way_mm = 0.0;
        let mut before = positions.first().map(|p| p.tip);
        let ways = positions.iter().map(|p| {
            way_mm += before.replace(p.tip).map_or(0.0, |b| (p.tip.vector() - b.vector()).norm());
            way_mm
        });
        Self::along(machine, temperatures, &ways.collect::<Vec<_>>())
    }

    /// For places along a way, mm.
    pub fn along(
        machine: &Machine,
        temperatures: Option<&RunningTemperatures>,
        way_mm: &[f64],
    ) -> Self {
        // What is wrong with the log was reported when the study was read.
        let told = &mut Diagnostics::new();
        let warming = temperatures.and_then(|t| WarmingMachine::new(machine, &t.run, told));
        let times_s = temperatures.map_or(Vec::new(), |t| t.times_s(way_mm));
        Self { warming, times_s, present: None }
    }

    /// When a place is made, s; 0 without a log.
    pub fn time_s(&self, place: usize) -> f64 {
        self.times_s.get(place).copied().unwrap_or(0.0)
    }

    /// The machine when a place is made; none where no log runs.
    pub fn machine_at(&mut self, place: usize) -> Result<Option<&Machine>, Error> {
        let Some(warming) = &self.warming else { return Ok(None) };
        let (time_s, lasts_s) = (self.time_s(place), warming.run().lasts_s());
        let holds = self.present.as_ref().is_some_and(|(_, until)| time_s < *until);
        if time_s > lasts_s || !holds {
            let ends = Error::LogEnds { position: place, time_s, lasts_s };
            self.present = Some(warming.at(time_s).ok_or(ends)?);
        }
        Ok(self.present.as_ref().map(|(machine, _)| machine))
    }
}
