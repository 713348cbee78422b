//! What is calibrated, and from which readings.

use super::angles::Angles;
use super::centres::Centres;
use super::control::Slots;
use super::segments::Segments;
use std::path::PathBuf;
use trueaxis_machine::Machine;
use trueaxis_machine::axis::Command;
use trueaxis_measure::measure::Instrument;
use trueaxis_measure::measure::path::Placing;

/// Angles that differ by less are the same pose, rad.
pub(super) const SAME_RAD: f64 = 1e-6;

/// One row of a table: the commanded positions of the axes, and the readings.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    /// Axis positions, mm and rad; with RTCP on only the rotary ones count.
    pub command: Command,
    /// What was read along x, y, z, mm; not every indicator reads all.
    pub read_mm: [Option<f64>; 3],
    /// The line of the table.
    pub line: u32,
}

/// Readings of one set-up: one ball, one indicator, one table.
#[derive(Debug, Clone, PartialEq)]
pub struct ReadingSet {
    /// Its name.
    pub name: String,
    /// Whether RTCP (TCP, TRAORI, M128) was on.
    pub tcp: bool,
    /// The indicator turns with the spindle head; else with the table.
    pub in_spindle: bool,
    /// Readings are of the ball against the tool, not of the tool against the ball.
    pub reads_ball: bool,
    /// Ball, noise, and the place of the ball as unknown.
    pub instrument: Instrument,
    /// The offsets for which the control was set while this was read, mm.
    pub set_for_mm: Vec<f64>,
    /// The rows.
    pub rows: Vec<Row>,
    /// The table.
    pub file: String,
}

/// What shall be calibrated, from which readings.
#[derive(Debug, Clone, PartialEq)]
pub struct RtcpStudy {
    /// What this is.
    pub name: String,
    /// The file.
    pub path: PathBuf,
    /// The machine file.
    pub machine_path: PathBuf,
    /// The machine; what it states of the centres is what stands in the control.
    pub machine: Machine,
    /// The unknowns.
    pub centres: Centres,
    /// The angle errors of the rotary axes.
    pub angles: Angles,
    /// What the segments of a path shall keep, if stated.
    pub segments: Option<Segments>,
    /// The names of the control, if one is named.
    pub slots: Option<Slots>,
    /// What stands in the control, by the place in [`Slots::slots`], mm.
    pub now: Vec<(usize, f64)>,
    /// The same as offsets from the machine file, mm.
    pub set_for_mm: Vec<f64>,
    /// Decimals that the control takes.
    pub decimals: u8,
    /// How well the tool is centred in the spindle, and how well its length is known, mm (k = 1).
    pub tool_u_mm: [f64; 2],
    /// The readings.
    pub sets: Vec<ReadingSet>,
    /// When it was measured.
    pub date: Option<String>,
}

/// Where the axes stand at a row.
pub(super) fn command_of(study: &RtcpStudy, set: &ReadingSet, row: &Command) -> Option<Command> {
    if !set.tcp {
        return Some(*row);
    }
    let placing = Placing::of(&study.machine, &set.instrument).ok()?;
    let by_the_control = study.centres.moved_mm(&study.machine, row, &set.set_for_mm);
    placing.place(set.instrument.reference_point_mm - by_the_control, row)
}

/// From the least to the greatest.
pub(super) fn spread(values: impl Iterator<Item = f64>) -> f64 {
    let (low, high) =
        values.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(v), h.max(v)));
    (high - low).max(0.0)
}
