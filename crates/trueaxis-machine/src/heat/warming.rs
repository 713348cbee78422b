//! A machine whose temperatures follow a log while the time of a program runs.

use super::conditions::TemperatureLog;
use super::field::Source;
use crate::chain::Machine;
use std::sync::Arc;
use trueaxis_input::{Diagnostics, Place};

/// A machine holds until a sensor has moved by so much, K: 0.12 µm per metre of steel.
const STEP_K: f64 = 0.01;
/// … or until heat from a bearing could have lengthened a scale by so much, mm.
const STEP_MM: f64 = 1e-4;

/// A log, and the time in it when a program begins.
#[derive(Debug, Clone, PartialEq)]
pub struct TemperatureRun {
    /// The log.
    pub log: Arc<TemperatureLog>,
    /// Its time at the begin of the program, s.
    pub start_s: f64,
}

impl TemperatureRun {
    /// Duration of the log after the start, s.
    pub fn lasts_s(&self) -> f64 {
        self.log.times_s().last().map_or(0.0, |last| last - self.start_s)
    }
}

/// Makes the machine of each moment of a run.
///
/// The temperatures are piecewise constant: a machine holds until one of its sensors has moved by
/// 0.01 K since it was made, or heat from a bearing could have lengthened a scale by 0.1 µm. So each
/// temperature is the log's within 0.01 K at every time; docs/model.md eq. 98.
///
/// ```
/// use std::sync::Arc;
/// use trueaxis_input::Diagnostics;
/// use trueaxis_machine::{Machine, file::NoTables};
/// use trueaxis_machine::heat::{TemperatureLog, TemperatureRun, WarmingMachine};
/// let text = r#"
///     machine = { name = "one axis", chain = "w b X Y Z t" }
///     [scale.X]
///     expansion = "10 um/(m K)"
///     table_temperature = "20 degC"
///     sensors = { scale_x = "0 mm" }
/// "#;
/// let machine = Machine::check("machine.toml", text, &NoTables).0.unwrap();
/// let mut problems = Diagnostics::new();
/// let log = "time_s,scale_x_degC\n0,20\n1000,30\n";
/// let log = TemperatureLog::parse("log.csv", log, &mut problems).map(Arc::new).unwrap();
/// let run = TemperatureRun { log, start_s: 100.0 };
/// let warming = WarmingMachine::new(&machine, &run, &mut problems).unwrap();
///
/// // After 400 s it is 25 °C, 0.01 K a second: 10 µm/(m·K) · 2 m · 5 K = 100 µm.
/// let (warm, until_s) = warming.at(400.0).unwrap();
/// let command = [2000.0, 0.0, 0.0, 0.0, 0.0, 0.0];
/// let errors = warm.errors_at(&command, &[0.0; 6]).unwrap();
/// assert!((warm.deviation(&command, &errors).tip_mm.x - 0.1).abs() < 1e-9);
/// assert!((until_s - 401.0).abs() < 1e-9);
/// assert!(warming.at(901.0).is_none());
/// ```
#[derive(Debug, Clone)]
pub struct WarmingMachine {
    machine: Machine,
    run: TemperatureRun,
    /// Of each scale, over the whole log.
    sources: Vec<Option<Vec<Source>>>,
}

impl WarmingMachine {
    /// From a machine at any temperatures; problems of the log or its start are reported.
    pub fn new(
        machine: &Machine,
        run: &TemperatureRun,
        problems: &mut Diagnostics,
    ) -> Option<Self> {
        let Some(conditions) = run.log.at(run.start_s) else {
            problems.add(run.log.outside(run.start_s));
            return None;
        };
        // Reported once, for the start; everything else is the same at every time.
        machine.at(&conditions, problems)?;
        let end_s = run.log.times_s().last().copied().unwrap_or(run.start_s);
        let scales = machine.heat.scales.iter();
        let sources: Vec<_> = scales.map(|scale| scale.sources(&conditions, end_s)).collect();
        let lost = machine.heat.scales.iter().zip(&sources).any(|(scale, sources)| {
            let known = |s: &str| conditions.celsius(s).is_some();
            scale.heated.is_some() && scale.sensors().all(known) && sources.is_none()
        });
        if lost {
            let message = "the log is too long for the flux of a heated scale".to_owned();
            let hint =
                "give at most 5000 rows: remove those after the program, or keep every n-th row";
            problems.error("unknown-flux", Place::whole(run.log.file()), message, hint);
            return None;
        }
        Some(Self { machine: machine.clone(), run: run.clone(), sources })
    }

    /// The run.
    pub fn run(&self) -> &TemperatureRun {
        &self.run
    }

    /// The machine at a time of the program (s, 0 at its begin), and until when it holds; `None`
    /// outside the log.
    pub fn at(&self, time_s: f64) -> Option<(Machine, f64)> {
        let now_s = self.run.start_s + time_s;
        let conditions = self.run.log.at(now_s)?;
        // All problems were reported by `new`.
        let told = &mut Diagnostics::new();
        let machine = self.machine.heated_by(&conditions, &self.sources, told)?;
        let until_s = self.holds_until(now_s) - self.run.start_s;
        Some((machine, until_s.max(time_s.next_up())))
    }

    /// When a sensor of this machine has moved by [`STEP_K`], or a scale by [`STEP_MM`], in the
    /// time of the log; infinite if never.
    fn holds_until(&self, now_s: f64) -> f64 {
        let (log, times_s) = (&self.run.log, self.run.log.times_s());
        let columns: Vec<&[f64]> =
            self.machine.heat.sensors().into_iter().filter_map(|s| log.celsius(s)).collect();
        let first = times_s.partition_point(|t| *t <= now_s).max(1);
        let Some(at_first) = times_s.get(first) else { return f64::INFINITY };
        let since = (now_s - times_s[first - 1]) / (at_first - times_s[first - 1]);
        let begin: Vec<f64> =
            columns.iter().map(|c| c[first - 1] + (c[first] - c[first - 1]) * since).collect();
        let mut grown_mm = 0.0;
        for row in first..times_s.len() {
            let from_s = times_s[row - 1].max(now_s);
            let mut earliest = f64::INFINITY;
            for (column, begin) in columns.iter().zip(&begin) {
                let before = if row == first { *begin } else { column[row - 1] };
                let (moved, by) = (before - begin, column[row] - before);
                // As a part of the way to this row.
                let part = (STEP_K.copysign(by) - moved) / by;
                if (moved + by).abs() >= STEP_K && part.is_finite() {
                    earliest = earliest.min(from_s + part * (times_s[row] - from_s));
                }
            }
            let speed = self.growth_mm_per_s(from_s);
            let left_s = (STEP_MM - grown_mm) / speed;
            if left_s.is_finite() {
                earliest = earliest.min(from_s + left_s);
            }
            if earliest <= times_s[row] {
                return earliest;
            }
            grown_mm += speed * (times_s[row] - from_s);
        }
        f64::INFINITY
    }

    fn growth_mm_per_s(&self, now_s: f64) -> f64 {
        let scales = self.machine.heat.scales.iter().zip(&self.sources);
        let speed = scales.map(|(scale, sources)| {
            sources.as_ref().map_or(0.0, |sources| scale.growth_mm_per_s(sources, now_s))
        });
        speed.fold(0.0, f64::max)
    }
}
