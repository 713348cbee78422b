//! ISO 230-3: environmental temperature variation error (ETVE) and drift; docs/model.md eq. 73.
//!
//! The parameter of a channel is its range: over the whole record, over the first hour, and the largest
//! over any window of that length. Between neighbouring readings the channel is taken as straight; what a gap may
//! hide is stated as well.

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
    /// What the first window and any window can hold at most, if the channel changes within a gap at the worst
    /// moment. Unit: mm, rad or °C.
    pub at_most: [f64; 2],
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

/// Two neighbouring readings that are farther apart than this part of the window have a gap between them.
const GAP: f64 = 0.1;

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
        let found = channel(name, dimension, values, &times_s, window_s);
        remark_on_gaps(&found, &times_s, column.place.clone(), problems);
        channels.push(found);
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
    let record = Record { times_s, values: &values, window_s };
    let (first_window, first_at_most) = record.first_window();
    let largest_window = record.largest_window();
    let at_most = [first_at_most, record.largest_at_most().max(largest_window.0)];
    Channel {
        name: name.to_owned(),
        dimension,
        range: range(&values),
        first_window,
        largest_window,
        at_most,
        end: values.last().zip(values.first()).map_or(0.0, |(last, first)| last - first),
        values,
    }
}

fn range(values: &[f64]) -> f64 {
    let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    high - values.iter().copied().fold(f64::INFINITY, f64::min)
}

/// Says where gaps leave the result of a channel open.
fn remark_on_gaps(channel: &Channel, times_s: &[f64], place: Place, problems: &mut Diagnostics) {
    let found = channel.largest_window.0;
    if channel.at_most[1] <= found * (1.0 + 1e-9) {
        return;
    }
    let widest = times_s.windows(2).map(|w| w[1] - w[0]).fold(0.0, f64::max);
    let (unit, scale) = match channel.dimension {
        Dimension::Length => ("µm", 1e3),
        Dimension::Angle => ("µrad", 1e6),
        _ => ("°C", 1.0),
    };
    let message = format!(
        "the readings of `{}` are up to {:.1} min apart: within a window it changes by {:.2} {unit} if it drifts \
         steadily, by up to {:.2} {unit} if not",
        channel.name,
        widest / 60.0,
        found * scale,
        channel.at_most[1] * scale
    );
    let hint =
        "a tolerance between the two is not proved; record at least ten readings in each window";
    problems.warn("gap-in-record", place, message, hint);
}

/// One channel over time.
struct Record<'a> {
    times_s: &'a [f64],
    values: &'a [f64],
    window_s: f64,
}

impl Record<'_> {
    /// A reading on the edge belongs to the window: 3600 s from sixty steps of 60 s.
    fn reach(&self, from_s: f64) -> f64 {
        from_s + self.window_s * (1.0 + 1e-12)
    }

    fn is_gap(&self, i: usize) -> bool {
        self.times_s.get(i + 1).is_some_and(|t| t - self.times_s[i] > GAP * self.window_s)
    }

    /// The value at a time between a reading and the next.
    fn between(&self, i: usize, time_s: f64) -> f64 {
        let part = (time_s - self.times_s[i]) / (self.times_s[i + 1] - self.times_s[i]);
        self.values[i] + part * (self.values[i + 1] - self.values[i])
    }

    /// Its range, and what it can be at most.
    fn first_window(&self) -> (f64, f64) {
        let Some(first) = self.times_s.first() else { return (0.0, 0.0) };
        let within = self.times_s.partition_point(|t| *t <= self.reach(*first));
        let mut values = self.values[..within].to_vec();
        if within == self.values.len() {
            return (range(&values), range(&values));
        }
        let mut more = values.clone();
        values.push(self.between(within - 1, first + self.window_s));
        let last = match self.is_gap(within - 1) {
            true => self.values[within],
            false => values[within],
        };
        more.push(last);
        (range(&values), range(&more))
    }

    /// The largest range within any window and its begin. Between readings the channel is straight: either both ends of
    /// the range are readings, or they are a whole window apart and one is a reading.
    ///
    /// ```text
    ///     max { max over readings in [s, s + W], |x(tᵢ) − x(tᵢ ± W)| }                  docs/model.md eq. 73
    /// ```
    fn largest_window(&self) -> (f64, f64) {
        let last_in =
            |i: usize| self.times_s.partition_point(|t| *t <= self.reach(self.times_s[i]));
        let mut best = self.largest(|i| last_in(i).max(i + 1));
        let inside = self.window_s * (1.0 - 1e-12);
        for (i, (time, value)) in self.times_s.iter().zip(self.values).enumerate() {
            let after = last_in(i);
            if after < self.times_s.len() && time + inside > self.times_s[after - 1] {
                let change = (self.between(after - 1, time + self.window_s) - value).abs();
                best = if change > best.0 { (change, *time) } else { best };
            }
            let before = self.times_s.partition_point(|t| *t < time - inside);
            if before > 0 && time - self.reach(0.0) > self.times_s[before - 1] {
                let from_s = time - self.window_s;
                let change = (self.between(before - 1, from_s) - value).abs();
                best = if change > best.0 { (change, from_s) } else { best };
            }
        }
        best
    }

    /// The same with the readings beyond a gap at either end: all that lies between them may happen within the window.
    fn largest_at_most(&self) -> f64 {
        let end = |i: usize| {
            let from = if self.is_gap(i) { self.times_s[i + 1] } else { self.times_s[i] };
            let end = self.times_s.partition_point(|t| *t <= self.reach(from));
            if self.is_gap(end - 1) { end + 1 } else { end }
        };
        self.largest(end).0
    }

    /// The largest range of the readings from one to an end that never falls, and where it begins, in one pass with two
    /// falling and rising queues.
    fn largest(&self, end: impl Fn(usize) -> usize) -> (f64, f64) {
        let (mut high, mut low) = (VecDeque::<usize>::new(), VecDeque::<usize>::new());
        let (mut next, mut best) = (0, (0.0, 0.0));
        for from in 0..self.values.len() {
            while next < end(from).min(self.values.len()) {
                while high.back().is_some_and(|k| self.values[*k] <= self.values[next]) {
                    high.pop_back();
                }
                while low.back().is_some_and(|k| self.values[*k] >= self.values[next]) {
                    low.pop_back();
                }
                high.push_back(next);
                low.push_back(next);
                next += 1;
            }
            for queue in [&mut high, &mut low] {
                while queue.front().is_some_and(|k| *k < from) {
                    queue.pop_front();
                }
            }
            if let (Some(h), Some(l)) = (high.front(), low.front())
                && self.values[*h] - self.values[*l] > best.0
            {
                best = (self.values[*h] - self.values[*l], self.times_s[from]);
            }
        }
        best
    }
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
        // Half an hour apart: an hour can hold the readings before and after it as well.
        assert!((x.at_most[1] * 1e3 - 9.0).abs() < 1e-12);
        let codes: Vec<_> = problems.iter().map(|d| d.code).collect();
        assert_eq!(codes, ["gap-in-record"]);
    }

    #[test]
    fn times_that_run_backwards_are_refused() {
        let mut problems = Diagnostics::new();
        assert!(evaluate("e.csv", "time_s,x_um\n0,0\n9,1\n5,2\n", HOUR_S, &mut problems).is_none());
        let found = problems.iter().next().unwrap();
        assert_eq!((found.code, found.place.line), ("time-backwards", 4));
    }

    fn drift(text: &str) -> (Channel, Vec<&'static str>) {
        let mut problems = Diagnostics::new();
        let drift = evaluate("e.csv", text, HOUR_S, &mut problems).unwrap();
        (drift.channels.into_iter().next().unwrap(), problems.iter().map(|d| d.code).collect())
    }

    /// 120 µm in two hours without a reading: 60 µm in one of them if steadily, all 120 µm if not.
    #[test]
    fn a_gap_hides_no_drift() {
        let (x, codes) = drift("time_min,x_um\n0,0\n1,0\n121,120\n122,120\n");
        assert!((x.largest_window.0 * 1e3 - 60.0).abs() < 1e-9, "{x:?}");
        assert!((x.at_most[1] * 1e3 - 120.0).abs() < 1e-9, "{x:?}");
        assert_eq!(codes, ["gap-in-record"]);
        // Coarser than the window everywhere.
        let (x, _) = drift("time_min,x_um\n0,0\n90,30\n180,15\n");
        let um = [x.first_window, x.largest_window.0, x.at_most[0], x.at_most[1]].map(|v| v * 1e3);
        for (found, expected) in um.iter().zip([20.0, 20.0, 30.0, 30.0]) {
            assert!((found - expected).abs() < 1e-9, "{um:?}");
        }
    }

    /// Of readings that lie close the result is the old one, and the mirror image of the record has the same.
    #[test]
    fn law_a_dense_record_needs_no_bound_and_time_may_run_either_way() {
        let mut random = trueaxis_geometry::statistics::SplitMix64::new(3);
        for step_min in [1.0, 5.0, 7.0, 25.0, 61.0, 200.0] {
            let mut values = vec![0.0];
            for _ in 0..60 {
                values.push(values[values.len() - 1] + random.unit() - 0.5);
            }
            let table = |values: &[f64]| {
                let rows = values.iter().enumerate();
                let rows = rows.map(|(i, v)| format!("{},{v}\n", i as f64 * step_min));
                format!("time_min,x_um\n{}", rows.collect::<String>())
            };
            let (x, codes) = drift(&table(&values));
            assert!(x.at_most[1] >= x.largest_window.0 && x.range >= x.at_most[1] - 1e-12);
            assert_eq!(step_min < 6.1, codes.is_empty(), "{step_min} {codes:?}");
            values.reverse();
            let (mirrored, _) = drift(&table(&values));
            assert!((x.largest_window.0 - mirrored.largest_window.0).abs() < 1e-12);
            assert!((x.at_most[1] - mirrored.at_most[1]).abs() < 1e-12);
        }
    }
}
