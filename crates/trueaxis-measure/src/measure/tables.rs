//! One table of readings with all that is wrong with it by itself.

use super::drift::check_time;
use super::{Readings, fill_motion};
use crate::instruments::Instrument;
use std::collections::BTreeMap;
use trueaxis_input::plausible::Limits;
use trueaxis_input::{CsvTable, Diagnostics, Place};
use trueaxis_machine::Machine;

/// Copies that are named one by one.
const MOST_NAMED: usize = 3;
/// Positions that differ by less are one: no control states more digits, mm or rad.
const ONE_POSITION: f64 = 1e-7;

/// Reads the table of an instrument; rows that are copies of others count once.
pub fn read_table(
    table: &CsvTable,
    (machine, limits): (&Machine, &Limits),
    (instruments, index): (&[Instrument], usize),
    problems: &mut Diagnostics,
) -> Option<Readings> {
    let (instrument, number) = (&instruments[index], u32::try_from(index).ok()?);
    let read = Readings::parse(table, machine, instrument, number, problems)?;
    read.judge(table, (machine, instrument), limits, problems);
    let place = Place::whole(&table.file);
    if read.is_empty() {
        let message = format!("the table of {} has no rows", instrument.name);
        let hint = "was the measurement stopped? leave the table out of `readings`";
        problems.error("no-rows", place, message, hint);
        return None;
    }
    let has_time = table.columns.iter().any(|c| c.name.starts_with("time_"));
    check_time(instrument, &read, has_time, &place, problems);
    let mut read = without_copies(&read, table, problems);
    fill_motion(&mut read, machine, instruments);
    Some(read)
}

/// A row that is equal to an earlier one, its reading to the last digit and its position to a tenth of a nanometre, and does not say that it was read again (its time, its
/// group), is no second reading: it would make everything look surer.
pub fn without_copies(
    readings: &Readings,
    table: &CsvTable,
    problems: &mut Diagnostics,
) -> Readings {
    let says_group = table.column("group").is_some();
    let mut first: BTreeMap<Vec<u64>, usize> = BTreeMap::new();
    let mut copies: BTreeMap<usize, usize> = BTreeMap::new();
    for i in 0..readings.len() {
        let row = readings.row(i);
        let feed = row.motion.feed_mm_per_s.unwrap_or(-1.0);
        let group = if says_group { f64::from(row.group) } else { 0.0 };
        let command = row.command.map(|q| (q / ONE_POSITION).round());
        let numbers = command.iter().chain(&row.approach).chain(&row.value);
        let numbers = numbers.chain(row.direction.iter()).chain([&row.time_s, &feed, &group]);
        // −0 is 0.
        let key: Vec<u64> = numbers.map(|v| (v + 0.0).to_bits()).collect();
        let of = *first.entry(key).or_insert(i);
        if of != i {
            copies.insert(i, of);
        }
    }
    if copies.is_empty() {
        return readings.clone();
    }
    let line = |i: usize| readings.lines[i] as usize;
    let place = |i: usize| Place { line: line(i), ..Place::whole(&table.file) };
    let hint = "a reading that was taken again has another time_s or another group; delete copies";
    for (copy, of) in copies.iter().take(MOST_NAMED) {
        let message = format!(
            "this row is that of line {} again, to the last digit: the two count once",
            line(*of)
        );
        problems.warn("copied-rows", place(*copy), message, hint);
    }
    if let Some((copy, _)) = copies.iter().nth(MOST_NAMED) {
        let message = format!("{} of {} rows are copies in all", copies.len(), readings.len());
        problems.warn("copied-rows", place(*copy), message, hint);
    }
    readings.filtered(|i| !copies.contains_key(&i))
}
