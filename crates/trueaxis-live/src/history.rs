//! What the correction took over the last days: of each axis before and after, the sensors, the states.

use crate::cycle::Correction;
use crate::file::Plan;
use crate::part::scale;
use crate::run::Cycle;
use crate::status::{LiveState, is_linear};
use crate::store::history_lines;
use serde::{Deserialize, Serialize};
use std::fmt::Write;
use std::path::Path;
use trueaxis_report::JsonSchema;

/// A line is written so often, s.
pub const HISTORY_S: f64 = 10.0;
/// Points of a history that is shown.
const MOST_POINTS: usize = 1500;

/// The last hours of a plan, up to now. Each line has the largest deviation of its ten seconds, each point that of its lines, so that
/// no peak is lost.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct LiveHistory {
    /// The time that it covers at most. Unit: h.
    pub hours: f64,
    /// When, seconds since 1970 (UTC).
    pub date_s: Vec<u64>,
    /// The state.
    pub state: Vec<String>,
    /// The live axes.
    pub axes: Vec<LiveHistoryAxis>,
    /// The sensors.
    pub sensors: Vec<LiveHistorySensor>,
}

/// One axis over time: what the tool is off along it by the model.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct LiveHistoryAxis {
    /// Its letter.
    pub axis: String,
    /// The unit of its numbers: um or urad.
    pub unit: String,
    /// Without the correction; null where nothing is known. Unit: that of `unit`.
    pub before: Vec<Option<f64>>,
    /// With the offset that acted. Unit: that of `unit`.
    pub left: Vec<Option<f64>>,
    /// The largest without the correction, of all lines, thinned or not; null where nothing is known. Unit: that of `unit`.
    pub before_max: Option<f64>,
    /// The largest with it; null as above. Unit: that of `unit`.
    pub left_max: Option<f64>,
    /// The root mean square over all cycles without the correction; null as above. Unit: that of `unit`.
    pub before_rms: Option<f64>,
    /// The root mean square with it; null as above. Unit: that of `unit`.
    pub left_rms: Option<f64>,
}

/// One sensor over time.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct LiveHistorySensor {
    /// Its name.
    pub sensor: String,
    /// Its temperature; null where it could not be used.
    pub celsius: Vec<Option<f64>>,
}

/// Of each axis what the tool was off since the last line, without the correction and with it.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Peaks {
    /// Cycles in which it was known.
    cycles: u32,
    axes: Vec<[Peak; 2]>,
}

/// The largest, and the sum of all squares.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
struct Peak {
    largest: f64,
    squares: f64,
}

impl Peak {
    fn add(&mut self, now: f64) {
        if now.abs() > self.largest.abs() {
            self.largest = now;
        }
        self.squares += now * now;
    }
}

impl Peaks {
    /// One cycle, as motions of the tool along the axis: without the correction it is off by minus the target, with it by what acts
    /// of this program's offset minus the target; nothing is known without a link.
    pub fn add(&mut self, plan: &Plan, cycle: &Cycle, correction: &Correction) {
        let Some(target) = &cycle.output.target else { return };
        let Ok(seen) = &cycle.input.seen else { return };
        let Some(at) = &cycle.output.programmed else { return };
        let acting = correction.acting_at(seen, at);
        if target.here.len() != plan.axes.len() {
            return;
        }
        self.axes.resize(plan.axes.len(), Default::default());
        self.cycles += 1;
        for (i, (peaks, axis)) in self.axes.iter_mut().zip(&plan.axes).enumerate() {
            let (acts, target) = (acting.get(i).copied().unwrap_or(0.0), target.here[i]);
            let [before, left] = [0.0 - target, acts - target].map(|n| n * scale(plan, axis));
            peaks[0].add(before);
            peaks[1].add(left);
        }
    }

    /// Of each axis the largest and the root mean square, without the correction and with it; none where nothing was known.
    fn values(&self, axes: usize) -> Vec<Option<f64>> {
        if self.cycles == 0 {
            return vec![None; 4 * axes];
        }
        let cycles = f64::from(self.cycles);
        let rms = |peak: &Peak| (peak.squares / cycles).sqrt();
        let of = |[before, left]: &[Peak; 2]| {
            [before.largest, left.largest, rms(before), rms(left)].map(Some)
        };
        self.axes.iter().flat_map(of).collect()
    }
}

/// The headings of the lines of a plan.
pub fn heading(plan: &Plan) -> String {
    let mut text = "date_s,time_s,state,cycles".to_owned();
    let clean = |name: &str| name.replace([',', '"', '\n', '\r'], "-");
    for axis in &plan.axes {
        let unit = if is_linear(plan, axis) { "um" } else { "urad" };
        let name = clean(&axis.name);
        // A text in memory takes everything.
        for of in ["before", "left", "before_rms", "left_rms"] {
            let _ = write!(text, ",{name}_{of}_{unit}");
        }
    }
    for sensor in &plan.sensors {
        let _ = write!(text, ",{}_celsius", clean(&sensor.settings.name));
    }
    text
}

/// The line of a state; the peaks begin again.
pub fn line(state: &LiveState, peaks: &mut Peaks) -> String {
    let now = std::mem::take(peaks);
    let mut text = format!("{},{:.1},{},{}", state.date_s, state.time_s, state.state, now.cycles);
    let mut put = |value: Option<f64>, digits: usize| {
        text.push(',');
        if let Some(value) = value {
            let _ = write!(text, "{value:.digits$}");
        }
    };
    now.values(state.axes.len()).into_iter().for_each(|value| put(value, 2));
    state.sensors.iter().for_each(|sensor| put(sensor.celsius, 3));
    text
}

/// A line that was read.
struct Row {
    date_s: u64,
    state: String,
    values: Vec<Option<f64>>,
}

/// None of a line that is cut.
fn row(line: &str, values: usize) -> Option<Row> {
    let mut cells = line.split(',');
    let date_s = cells.next()?.parse().ok()?;
    let state = cells.nth(1)?.to_owned();
    let read = |cell: &str| match cell {
        "" => Some(None),
        _ => cell.parse::<f64>().ok().filter(|v| v.is_finite()).map(Some),
    };
    let values: Vec<_> =
        cells.map(read).collect::<Option<Vec<_>>>().filter(|v| v.len() == values)?;
    Some(Row { date_s, state, values })
}

/// A line may be of a clock that was ahead by so much, s.
const AHEAD_S: u64 = 60;

/// The last hours of a plan before a date, seconds since 1970: of a run that ended earlier nothing, nor of one that is yet to come.
pub fn history(folder: &Path, plan: &Plan, (hours, now_s): (f64, u64)) -> LiveHistory {
    let values = 1 + 4 * plan.axes.len() + plan.sensors.len();
    let lines = history_lines(folder, &heading(plan));
    let mut rows: Vec<Row> = lines.iter().filter_map(|l| row(l, values)).collect();
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "hours above 0")]
    let span_s = (hours * 3600.0) as u64;
    let from_s = now_s.saturating_sub(span_s);
    rows.retain(|row| (from_s..=now_s + AHEAD_S).contains(&row.date_s));
    thinned(plan, &rows, hours)
}

fn thinned(plan: &Plan, rows: &[Row], hours: f64) -> LiveHistory {
    let parts: Vec<&[Row]> = rows.chunks(rows.len().div_ceil(MOST_POINTS).max(1)).collect();
    let largest = |column: usize| -> Vec<Option<f64>> {
        let size = |value: &f64| value.abs();
        let of = |part: &&[Row]| {
            let known = part.iter().filter_map(|row| row.values[column]);
            known.max_by(|a, b| size(a).total_cmp(&size(b)))
        };
        parts.iter().map(of).collect()
    };
    let most = |column: usize| {
        rows.iter().filter_map(|row| row.values[column]).map(f64::abs).reduce(f64::max)
    };
    // Over all cycles of all lines.
    let rms = |column: usize| -> Option<f64> {
        let known = rows.iter().filter_map(|row| row.values[0].zip(row.values[column]));
        let add = |(n, sum): (f64, f64), (cycles, rms): (f64, f64)| {
            (n + cycles, sum + cycles * rms * rms)
        };
        let (cycles, squares) = known.fold((0.0, 0.0), add);
        (cycles > 0.0).then(|| (squares / cycles).sqrt())
    };
    let axes = plan.axes.iter().enumerate().map(|(i, axis)| {
        let first = 1 + 4 * i;
        LiveHistoryAxis {
            axis: axis.name.clone(),
            unit: if is_linear(plan, axis) { "um" } else { "urad" }.to_owned(),
            before: largest(first),
            left: largest(first + 1),
            before_max: most(first),
            left_max: most(first + 1),
            before_rms: rms(first + 2),
            left_rms: rms(first + 3),
        }
    });
    let first = 1 + 4 * plan.axes.len();
    let sensors = plan.sensors.iter().enumerate().map(|(i, sensor)| {
        let last = |part: &&[Row]| part.last().and_then(|row| row.values[first + i]);
        let celsius = parts.iter().map(last).collect();
        LiveHistorySensor { sensor: sensor.settings.name.clone(), celsius }
    });
    let last = |part: &&[Row]| part.last().map(|row| (row.date_s, row.state.clone()));
    let (date_s, state) = parts.iter().filter_map(last).unzip();
    LiveHistory { hours, date_s, state, axes: axes.collect(), sensors: sensors.collect() }
}
