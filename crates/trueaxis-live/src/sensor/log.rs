//! A log of temperatures as a sensor: each row is a sample when its time has come.

use super::{Sample, Sensor, Sent};
use std::sync::Arc;
use trueaxis::machine::heat::TemperatureLog;

/// Replays one column of a log on the clock of the run.
#[derive(Debug, Clone)]
pub struct LogSensor {
    log: Arc<TemperatureLog>,
    column: String,
    sensor: usize,
    /// The time in the log at the start of the run, s.
    start_s: f64,
    /// Seconds of the log per second of the run.
    speed: f64,
    next: usize,
}

impl LogSensor {
    /// From a time of the log on; the row before is known at once, and is as old as it is.
    pub fn new(log: Arc<TemperatureLog>, column: &str, sensor: usize, start_s: f64) -> Self {
        let next = log.times_s().partition_point(|t| *t <= start_s).saturating_sub(1);
        Self { log, column: column.to_owned(), sensor, start_s, speed: 1.0, next }
    }

    /// The same, faster.
    #[must_use]
    pub fn at_speed(mut self, speed: f64) -> Self {
        self.speed = speed;
        self
    }
}

impl Sensor for LogSensor {
    fn poll(&mut self, now_s: f64) -> Vec<Sample> {
        let (times, values) = (self.log.times_s(), self.log.celsius(&self.column));
        let log_s = self.start_s + now_s * self.speed;
        let mut samples = Vec::new();
        while let Some((time, celsius)) =
            times.get(self.next).zip(values.and_then(|v| v.get(self.next)))
        {
            if *time > log_s {
                break;
            }
            let taken_s = (time - self.start_s) / self.speed;
            let sent = Sent::Number(*celsius);
            samples.push(Sample { sensor: self.sensor, sent, taken_s: Some(taken_s) });
            self.next += 1;
        }
        // Only the last one counts, and a long gap must not fill the memory.
        samples.split_off(samples.len().saturating_sub(1))
    }
}
