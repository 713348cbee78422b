//! Sensors: what comes in, and whether it can be used.
//!
//! A [`Sensor`] hands on what it was sent, a text or a number, with the time at which it was taken. [`Watch`] judges all of
//! them in one place: freshness by the time of the sample itself, range, rate, stuck values. Nothing that is no plausible
//! temperature gets further.

mod inbox;
mod log;
pub mod modbus;
pub mod mqtt;
pub mod opcua;
mod watch;

pub use log::LogSensor;
pub(crate) use watch::DIGIT_K;
pub use watch::{Judged, SensorFault, SensorSettings, Watch};

use serde::{Deserialize, Serialize};

/// What a sensor sent.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Sample {
    /// The sensor, by its place in the plan.
    pub sensor: usize,
    /// As it was sent.
    pub sent: Sent,
    /// When it was taken, on the clock of the run, s; none where the source does not say, as with a retained message: then
    /// it is not fresh.
    pub taken_s: Option<f64>,
}

/// A number, or a text that should be one.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Sent {
    /// °C.
    Number(f64),
    /// To be read.
    Text(String),
}

impl Sent {
    /// A number; one that is not finite becomes its text, which no record loses.
    pub fn number(celsius: f64) -> Self {
        if celsius.is_finite() { Self::Number(celsius) } else { Self::Text(celsius.to_string()) }
    }

    /// As it was sent, shortened.
    pub fn shown(&self) -> String {
        match self {
            Self::Number(number) => number.to_string(),
            Self::Text(text) => text.chars().take(40).collect(),
        }
    }

    /// °C, if it is a finite number.
    pub fn celsius(&self) -> Option<f64> {
        let number = match self {
            Self::Number(number) => Some(*number),
            Self::Text(text) => text.trim().parse().ok(),
        };
        number.filter(|n| n.is_finite())
    }
}

/// A source of samples: a log, a broker, a bus, a test.
pub trait Sensor {
    /// What came since the last call; never waits.
    fn poll(&mut self, now_s: f64) -> Vec<Sample>;
}
