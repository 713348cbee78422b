//! ISO 230-3: environmental temperature variation error (ETVE) and drift; docs/model.md eq. 73.
//!
//! The parameter of a channel is its range: over the whole record, over the first hour, and the largest
//! over any window of that length.

use super::{check_temperatures, check_times};
use std::collections::VecDeque;
use trueaxis_input::sheet::{Cells, Sheet, heading};
use trueaxis_input::{Diagnostics, Dimension, Place, Unit};

/// The default window, s.
pub const HOUR_S: f64 = 3600.0;

/// One channel of the record, in mm, rad or °C.
#[derive(Debug, Clone, PartialEq)]
pub struct Channel {
    /// Its heading without the unit.
    pub name: String,
    /// Length, angle or temperature.
    pub dimension: Dimension,
    /// The readings. Unit: mm, rad or °C.
    pub values: Vec<f64>,
    /// Range over the whole record. Unit: mm, rad or °C.
    pub range: f64,
    /// Range over the first window. Unit: mm, rad or °C.
    pub first_window: f64,
    /// The largest range over any window, and where it begins, s.
    pub largest_window: (f64, f64),
    /// Last − first. Unit: mm, rad or °C.
    pub end: f64,
}

/// A record, evaluated.
#[derive(Debug, Clone, PartialEq)]
pub struct Drift {
    /// Times from the beginning, s.
    pub times_s: Vec<f64>,
    /// Length of the windows, s.
    pub window_s: f64,
    /// Every channel, in the order of the file.
    pub channels: Vec<Channel>,
}

/// No part of a machine begins a test warmer than this, °C.
const WARM_CELSIUS: f64 = 45.0;

fn dimension(name: &str) -> Option<Dimension> {
    let of = [Dimension::Length, Dimension::Angle, Dimension::Temperature];
    of.into_iter().find(|d| Unit::find(heading(name).1, *d).is_ok())
}

fn cells(name: &str) -> Cells {
    match dimension(name) {
        Some(_) => Cells::Numbers,
        None if heading(name).0 == "time" => Cells::Numbers,
        None => Cells::Unused,
    }
}

/// Reads and evaluates a record; `None` with errors in `problems`.
pub fn evaluate(
    file: &str,
    text: &str,
    window_s: f64,
    problems: &mut Diagnostics,
) -> Option<Drift> {
    let sheet = Sheet::parse(file, text, cells, problems)?;
    check_temperatures(&sheet, problems);
    let Some(time) = sheet.columns.iter().find(|c| heading(&c.name).0 == "time") else {
        let message = "the table has no column of times".to_owned();
        let hint = "name it time_s, time_min or time_h";
        problems.error("missing-column", sheet.headings_place(), message, hint);
        return None;
    };
    if !check_times(&sheet, true, problems) {
        return None;
    }
    let times = sheet.inner(time, Dimension::Time, problems)?;
    let times_s: Vec<f64> = times.iter().map(|t| t - times[0]).collect();
    let mut channels = Vec::new();
    for column in &sheet.columns {
        let (name, Some(dimension)) = (column.role(), dimension(&column.name)) else {
            if column.cells == Cells::Unused {
                let message = format!("column `{}` is not used", column.name);
                let hint = "channels have a unit: x_um, tilt_urad, spindle_degC";
                problems.warn("unused-column", column.place.clone(), message, hint);
            }
            continue;
        };
        if name == "time" {
            continue;
        }
        let values = sheet.inner(column, dimension, problems)?;
        if values.len() >= 10 && values.iter().all(|v| *v == values[0]) {
            let message = format!("channel `{}` never changes", column.name);
            let hint = "is the sensor stuck or not connected? it is shown like the others";
            problems.warn("stuck-channel", column.place.clone(), message, hint);
        }
        let least = values.iter().copied().fold(f64::INFINITY, f64::min);
        if dimension == Dimension::Temperature && least > WARM_CELSIUS {
            let message = format!("channel `{name}` never falls below {least:.1} °C");
            let hint = format!(
                "is it Fahrenheit? that would be {:.1} °C; or are columns swapped?",
                (least - 32.0) / 1.8
            );
            problems.warn("temperature-range", column.place.clone(), message, &hint);
        }
        channels.push(channel(name, dimension, values, &times_s, window_s));
    }
    if channels.is_empty() {
        let message = "the table has no channel".to_owned();
        let hint = "channels have a unit: x_um, tilt_urad, spindle_degC";
        problems.error("missing-column", sheet.headings_place(), message, hint);
        return None;
    }
    let length = times_s.last().copied().unwrap_or(0.0);
    if length < window_s {
        let message = format!(
            "the record is {:.1} min long, the window {:.1}",
            length / 60.0,
            window_s / 60.0
        );
        let hint = "the ranges hold for the recorded time";
        problems.warn("short-record", Place::whole(file), message, hint);
    }
    Some(Drift { times_s, window_s, channels })
}

fn channel(
    name: &str,
    dimension: Dimension,
    values: Vec<f64>,
    times_s: &[f64],
    window_s: f64,
) -> Channel {
    let range = |values: &[f64]| {
        let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        high - values.iter().copied().fold(f64::INFINITY, f64::min)
    };
    // A row on the edge belongs to the window: 3600 s from sixty steps of 60 s.
    let within = times_s.partition_point(|t| *t <= window_s * (1.0 + 1e-12));
    Channel {
        name: name.to_owned(),
        dimension,
        range: range(&values),
        first_window: range(&values[..within]),
        largest_window: largest_window(times_s, &values, window_s),
        end: values.last().zip(values.first()).map_or(0.0, |(last, first)| last - first),
        values,
    }
}

/// The largest range within any window and its begin, in one pass with two falling and rising queues.
fn largest_window(times_s: &[f64], values: &[f64], window_s: f64) -> (f64, f64) {
    let (mut high, mut low) = (VecDeque::<usize>::new(), VecDeque::<usize>::new());
    let (mut from, mut best) = (0, (0.0, 0.0));
    for (i, value) in values.iter().enumerate() {
        while high.back().is_some_and(|k| values[*k] <= *value) {
            high.pop_back();
        }
        while low.back().is_some_and(|k| values[*k] >= *value) {
            low.pop_back();
        }
        high.push_back(i);
        low.push_back(i);
        while times_s[i] - times_s[from] > window_s * (1.0 + 1e-12) {
            from += 1;
        }
        for queue in [&mut high, &mut low] {
            while queue.front().is_some_and(|k| *k < from) {
                queue.pop_front();
            }
        }
        if let (Some(h), Some(l)) = (high.front(), low.front())
            && values[*h] - values[*l] > best.0
        {
            best = (values[*h] - values[*l], times_s[from]);
        }
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_by_hand() {
        let text = "time_min,x_um,air_degC\n0,0,20\n30,2,20.5\n60,3,21\n90,9,21\n120,8,20\n";
        let mut problems = Diagnostics::new();
        let drift = evaluate("e.csv", text, HOUR_S, &mut problems).unwrap();
        let x = &drift.channels[0];
        let um = [x.range, x.first_window, x.largest_window.0, x.end].map(|v| v * 1e3);
        for (found, expected) in um.iter().zip([9.0, 3.0, 7.0, 8.0]) {
            assert!((found - expected).abs() < 1e-12, "{um:?}");
        }
        assert_eq!(x.largest_window.1, 1800.0); // 2 at 30 min to 9 at 90 min
        assert!(problems.iter().next().is_none());
    }

    #[test]
    fn times_that_run_backwards_are_refused() {
        let mut problems = Diagnostics::new();
        assert!(evaluate("e.csv", "time_s,x_um\n0,0\n9,1\n5,2\n", HOUR_S, &mut problems).is_none());
        let found = problems.iter().next().unwrap();
        assert_eq!((found.code, found.place.line), ("time-backwards", 4));
    }
}
