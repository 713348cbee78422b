//! The tables as readings of a design, each with the place that it comes from.

use super::study::{ReadingSet, RtcpStudy, command_of};
use trueaxis_geometry::Vec3;
use trueaxis_machine::axis::Command;
use trueaxis_machine::errors::ErrorValues;
use trueaxis_measure::measure::{Motion, Reading, Readings};

/// A sense that may have been mixed up.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Flip {
    Set(usize),
    Channel(usize, usize),
    Sense(usize),
}

/// Rows as numbers, with the place that each comes from.
pub(super) struct Rows {
    pub readings: Readings,
    /// Set, row, channel.
    pub origins: Vec<(usize, usize, usize)>,
}

/// Along which direction of the workpiece a channel reads at a command.
fn direction(study: &RtcpStudy, set: &ReadingSet, command: &Command, channel: usize) -> Vec3 {
    match set.in_spindle {
        true => {
            let pose = study.machine.pose(command, &ErrorValues::default());
            pose.linear().column(channel).into_owned()
        }
        false => Vec3::ith(channel, 1.0),
    }
}

/// All rows; with a sense turned over if one is suspected.
pub(super) fn rows(study: &RtcpStudy, flip: Option<Flip>) -> Rows {
    let mut made = Rows { readings: Readings::default(), origins: Vec::new() };
    for (s, set) in study.sets.iter().enumerate() {
        for (r, row) in set.rows.iter().enumerate() {
            let mut wanted = row.command;
            if let Some(Flip::Sense(axis)) = flip {
                wanted[axis] = -wanted[axis];
            }
            // The file was read with the same placing: a row that cannot be placed was reported there.
            let Some(command) = command_of(study, set, &wanted) else { continue };
            for (c, read) in row.read_mm.iter().enumerate() {
                let Some(mut value) = *read else { continue };
                let turned = set.reads_ball
                    != (flip == Some(Flip::Set(s)) || flip == Some(Flip::Channel(s, c)));
                if turned {
                    value = -value;
                }
                made.readings.push(Reading {
                    command,
                    approach: [0.0; 6],
                    instrument: u32::try_from(s).unwrap_or(u32::MAX),
                    direction: direction(study, set, &command, c),
                    value: [value, 0.0, 0.0],
                    group: u32::try_from(r).unwrap_or(u32::MAX),
                    time_s: 0.0,
                    motion: Motion::default(),
                    line: row.line,
                });
                made.origins.push((s, r, c));
            }
        }
    }
    made
}
