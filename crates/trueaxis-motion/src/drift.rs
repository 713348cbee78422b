//! The effect of changing temperatures on a run: their ranges, and the drift of the deviation.

use super::summary::Worst;
use super::{Batch, Observer, SetUp};
use trueaxis_input::Diagnostics;
use trueaxis_machine::Machine;
use trueaxis_machine::axis::MAX_AXES;
use trueaxis_machine::batch::{Commands, CompiledMachine, DeviationTable};
use trueaxis_machine::heat::{TemperatureRun, WarmingMachine};

/// The lowest and highest temperature of a sensor while the program runs.
#[derive(Debug, Clone, PartialEq)]
pub struct SensorRange {
    /// Its name.
    pub sensor: String,
    /// The lowest, °C.
    pub lowest_celsius: f64,
    /// The highest, °C.
    pub highest_celsius: f64,
}

/// Compares every place of the path with the same place at the temperatures of the start.
///
/// ```text
///     drift = deviation(q, T(t)) − deviation(q, T(0))
/// ```
pub struct Drift {
    run: TemperatureRun,
    warming: WarmingMachine,
    /// The machine of the start with the tool of the present batch.
    start: Option<CompiledMachine>,
    poses: DeviationTable,
    time_s: f64,
    /// Its greatest length at the tip while the tool feeds, mm.
    pub tip: Worst,
    /// The length at the last place with feed, mm.
    pub last_mm: f64,
    /// Points whose drift is not known: outside an error table.
    pub unknown: u64,
}

impl Drift {
    /// Empty; the simulation reports what is wrong with the log.
    pub fn of(machine: &Machine, setup: &SetUp, run: &TemperatureRun) -> Option<Self> {
        let problems = &mut Diagnostics::new();
        Some(Self {
            warming: WarmingMachine::new(&setup.mounted(machine), run, problems)?,
            run: run.clone(),
            start: None,
            poses: DeviationTable::zeros(0),
            time_s: 0.0,
            tip: Worst::default(),
            last_mm: 0.0,
            unknown: 0,
        })
    }

    /// The log and its start.
    pub fn run(&self) -> &TemperatureRun {
        &self.run
    }

    /// How long the program ran, s.
    pub fn time_s(&self) -> f64 {
        self.time_s
    }

    /// The range of every sensor of the log while the program ran.
    pub fn sensors(&self) -> Vec<SensorRange> {
        let (log, from_s) = (&self.run.log, self.run.start_s);
        let to_s = from_s + self.time_s.min(self.run.lasts_s());
        let ends = [log.at(from_s), log.at(to_s)];
        let rows = log.times_s().partition_point(|t| *t < from_s)
            ..log.times_s().partition_point(|t| *t <= to_s);
        let of = |sensor: &str| {
            let ends = ends.iter().flatten().filter_map(|c| c.celsius(sensor));
            let inner = log.celsius(sensor).and_then(|c| c.get(rows.clone())).unwrap_or_default();
            let all = ends.chain(inner.iter().copied());
            let (lowest_celsius, highest_celsius) =
                all.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), c| (l.min(c), h.max(c)));
            SensorRange { sensor: sensor.to_owned(), lowest_celsius, highest_celsius }
        };
        log.sensors().map(of).collect()
    }

    fn prepare(&mut self, batch: &Batch<'_>) {
        let tip_mm = batch.machine.tip_mm();
        if self.start.as_ref().is_some_and(|s| s.machine().tip_mm() == tip_mm) {
            return;
        }
        let machine = self.warming.at(0.0).map(|(machine, _)| machine.with_tip(tip_mm));
        self.start = machine.map(|machine| CompiledMachine::new(&machine));
    }
}

impl Observer for Drift {
    fn path(&mut self, batch: &Batch<'_>) {
        self.prepare(batch);
        if let Some(last) = batch.stamps.last() {
            self.time_s = last.time_s;
        }
        let Some(start) = &self.start else { return };
        let axes = batch.machine.axes().len();
        let columns: [Vec<f64>; MAX_AXES] = std::array::from_fn(|axis| {
            let used = if axis < axes { batch.nodes } else { &[] };
            used.iter().map(|node| node.command[axis]).collect()
        });
        let columns = columns.each_ref().map(Vec::as_slice);
        if self.poses.len() != batch.nodes.len() {
            self.poses = DeviationTable::zeros(batch.nodes.len());
        }
        let commands = Commands::new(&columns[..axes]).approached(&batch.approaches[..axes]);
        // After a point without errors, which the simulation reports, nothing is known.
        let done = start.deviations(&commands, &mut self.poses.columns());
        let known = done.err().and_then(|e| e.index()).unwrap_or(batch.nodes.len());
        self.unknown += (batch.nodes.len() - known) as u64;
        for (i, node) in batch.nodes.iter().enumerate().take(known) {
            if !node.is_rapid() {
                let off = batch.deviation(i).tip_mm - self.poses.at(i).tip_mm;
                self.last_mm = off.norm();
                self.tip.see(self.last_mm, node.origin, batch.stamps[i].time_s);
            }
        }
    }
}
