//! Readings that no instrument shows and commands that no machine has: a slip of the unit, by column and row.

use super::readings::absolute;
use super::{Instrument, Kind, Readings};
use crate::instruments::instrument::Sight;
use trueaxis_input::plausible::{Limits, Quantity};
use trueaxis_input::{CsvTable, Diagnostics, Place};
use trueaxis_machine::Machine;
use trueaxis_machine::axis::AxisKind;

/// Readings that all are smaller than this part of their stated noise are not readings in that unit.
const PART_OF_NOISE: f64 = 0.1;
/// Fewer readings say nothing about their size.
const FEWEST: usize = 6;

impl Readings {
    /// Judges all rows of a table that [`Readings::parse`] has read: deviations, distances and commands.
    pub fn judge(
        &self,
        table: &CsvTable,
        (machine, instrument): (&Machine, &Instrument),
        limits: &Limits,
        problems: &mut Diagnostics,
    ) {
        let place = |row: usize| table.row_place(row);
        for (i, axis) in machine.axes().iter().enumerate() {
            let name = axis.name.to_string();
            if table.column(&name).is_some() {
                let values: Vec<f64> = self.commands.iter().map(|command| command[i]).collect();
                let quantity = match axis.kind {
                    AxisKind::Linear => Quantity::Length,
                    AxisKind::Rotary => Quantity::RotaryPosition,
                };
                limits.judge_column(quantity, (&name, &values), place, problems);
            }
        }
        let feeds: Vec<f64> = self.motions.iter().filter_map(|m| m.feed_mm_per_s).collect();
        if feeds.len() == self.len() {
            limits.judge_column(Quantity::Velocity, ("feed", &feeds), place, problems);
        }
        limits.judge_column(Quantity::Time, ("time_s", &self.times_s), place, problems);
        if instrument.kind.triggers() || instrument.kind == Kind::BallCentre {
            return; // The axes are its reading; a centre that is far from its ball is refused when it is read.
        }
        self.judge_channels(table, (machine, instrument), limits, problems);
    }

    fn judge_channels(
        &self,
        table: &CsvTable,
        (machine, instrument): (&Machine, &Instrument),
        limits: &Limits,
        problems: &mut Diagnostics,
    ) {
        let quantity = match instrument.sight {
            Sight::Distance => Quantity::Distance,
            sight if sight.is_angle() => Quantity::AngularDeviation,
            _ => Quantity::Deviation,
        };
        let deviations: Vec<[f64; 3]> =
            (0..self.len()).map(|i| self.deviation(i, machine, instrument)).collect();
        let mut greatest: f64 = 0.0;
        for c in 0..instrument.sight.channels() {
            let name = instrument.kind.channels()[c];
            let is_own = |n: &&str| n.rsplit_once('_').is_some_and(|(role, _)| role == name);
            let heading = table.columns.iter().map(|c| c.name.as_str()).find(is_own);
            let values: Vec<f64> = deviations.iter().map(|d| d[c]).collect();
            let heading = heading.unwrap_or(name);
            // What is judged is what stands in the table, or what it differs from its nominal value by.
            let less = format!("{heading} less its nominal value");
            let stands = !absolute(instrument) && instrument.kind.element().is_none();
            let column = (if stands { heading } else { &less }, &values[..]);
            limits.judge_column(quantity, column, |row| table.row_place(row), problems);
            let most = values.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
            greatest = greatest.max(most / instrument.noise[c]);
        }
        if self.len() >= FEWEST && greatest > 0.0 && greatest < PART_OF_NOISE {
            let message = format!(
                "all {} readings of `{}` are below {:.1e} of their stated noise",
                self.len(),
                instrument.name,
                greatest
            );
            let hint = "no instrument reads so little: are the values of another unit than the heading says, \
                        such as mm under a heading in µm? Else state a smaller `noise`";
            problems.warn("small-readings", Place::whole(&table.file), message, hint);
        }
    }

    /// A row against its nominal reading. Unit: mm or rad.
    fn deviation(&self, row: usize, machine: &Machine, instrument: &Instrument) -> [f64; 3] {
        let value = self.values[row];
        if instrument.kind == Kind::ProbeBall {
            return value; // It reads where the ball is.
        }
        let nominal =
            instrument.nominal_reading(machine, &self.commands[row], self.directions[row]);
        [0, 1, 2].map(|c| value[c] - nominal[c])
    }
}
