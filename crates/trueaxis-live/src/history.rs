//! What the correction took over the last days: of each axis before and after, the sensors, the states.

use crate::cycle::Correction;
use crate::file::Plan;
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

/// The last hours of a plan. Each line has the largest deviation of its ten seconds, each point that of its lines, so that no peak
/// is lost.
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
    /// The root mean square without the correction; null as above. Unit: that of `unit`.
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

/// Of each axis the largest deviation since the last line, without the correction and with it.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Peaks(Vec<[Option<f64>; 2]>);

impl Peaks {
    /// One cycle: without the correction the tool is off by minus the target, with it by what acts of this program's
    /// offset minus the target; nothing is known without a link.
    pub fn add(&mut self, plan: &Plan, cycle: &Cycle, correction: &Correction) {
        self.0.resize(plan.axes.len(), [None; 2]);
        let Some(target) = &cycle.output.target else { return };
        let Ok(seen) = &cycle.input.seen else { return };
        let Some(at) = &cycle.output.programmed else { return };
        let acting = correction.acting_at(seen, at);
        for (i, (peak, axis)) in self.0.iter_mut().zip(&plan.axes).enumerate() {
            let Some(target) = target.here.get(i) else { continue };
            let acts = acting.get(i).copied().unwrap_or(0.0);
            let scale = axis.increment * if is_linear(plan, axis) { 1e3 } else { 1e6 };
            for (peak, now) in peak.iter_mut().zip([0.0 - target, acts - target]) {
                let larger = peak.is_none_or(|peak: f64| (now * scale).abs() > peak.abs());
                if larger {
                    *peak = Some(now * scale);
                }
            }
        }
    }
}

/// The headings of the lines of a plan.
pub fn heading(plan: &Plan) -> String {
    let mut text = "date_s,time_s,state".to_owned();
    let clean = |name: &str| name.replace([',', '"', '\n', '\r'], "-");
    for axis in &plan.axes {
        let unit = if is_linear(plan, axis) { "um" } else { "urad" };
        let name = clean(&axis.name);
        // A text in memory takes everything.
        let _ = write!(text, ",{name}_before_{unit},{name}_left_{unit}");
    }
    for sensor in &plan.sensors {
        let _ = write!(text, ",{}_celsius", clean(&sensor.settings.name));
    }
    text
}

/// The line of a state; the peaks begin again.
pub fn line(state: &LiveState, peaks: &mut Peaks) -> String {
    let mut text = format!("{},{:.1},{}", state.date_s, state.time_s, state.state);
    let mut put = |value: Option<f64>, digits: usize| {
        text.push(',');
        if let Some(value) = value {
            let _ = write!(text, "{value:.digits$}");
        }
    };
    for value in std::mem::take(peaks).0.into_iter().flatten() {
        put(value, 2);
    }
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

/// The last hours of a plan.
pub fn history(folder: &Path, plan: &Plan, hours: f64) -> LiveHistory {
    let (axes, sensors) = (plan.axes.len(), plan.sensors.len());
    let lines = history_lines(folder, &heading(plan));
    let mut rows: Vec<Row> = lines.iter().filter_map(|l| row(l, 2 * axes + sensors)).collect();
    let last_s = rows.last().map_or(0, |row| row.date_s);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "hours above 0")]
    let span_s = (hours * 3600.0) as u64;
    rows.retain(|row| row.date_s.saturating_add(span_s) >= last_s);
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
    let all = |column: usize| -> [Option<f64>; 2] {
        let known: Vec<f64> = rows.iter().filter_map(|row| row.values[column]).collect();
        let most = known.iter().map(|v| v.abs()).reduce(f64::max);
        #[expect(clippy::cast_precision_loss, reason = "some thousand lines")]
        let count = known.len().max(1) as f64;
        [most, most.map(|_| (known.iter().map(|v| v * v).sum::<f64>() / count).sqrt())]
    };
    let axes = plan.axes.iter().enumerate().map(|(i, axis)| {
        let [[before_max, before_rms], [left_max, left_rms]] = [2 * i, 2 * i + 1].map(all);
        LiveHistoryAxis {
            axis: axis.name.clone(),
            unit: if is_linear(plan, axis) { "um" } else { "urad" }.to_owned(),
            before: largest(2 * i),
            left: largest(2 * i + 1),
            before_max,
            left_max,
            before_rms,
            left_rms,
        }
    });
    let first = 2 * plan.axes.len();
    let sensors = plan.sensors.iter().enumerate().map(|(i, sensor)| {
        let last = |part: &&[Row]| part.last().and_then(|row| row.values[first + i]);
        let celsius = parts.iter().map(last).collect();
        LiveHistorySensor { sensor: sensor.settings.name.clone(), celsius }
    });
    let last = |part: &&[Row]| part.last().map(|row| (row.date_s, row.state.clone()));
    let (date_s, state) = parts.iter().filter_map(last).unzip();
    LiveHistory { hours, date_s, state, axes: axes.collect(), sensors: sensors.collect() }
}
