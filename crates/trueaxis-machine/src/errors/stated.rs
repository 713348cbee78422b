//! One error as a machine file states it: curve, reversal, uncertainty.

use super::{Curve, OutsideTable, Spline};

/// Where the numbers of an error came from.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Measurement {
    /// The instrument.
    pub instrument: Option<String>,
    /// The date as written.
    pub date: Option<String>,
    /// The temperature during the measurement, °C.
    pub temperature_celsius: Option<f64>,
}

/// One error of the machine as the machine file states it.
///
/// A location error has a [`Curve::Constant`]; an error motion any curve. The value at a position
/// is `mean(q) + approach · reversal(q)/2 + z · u(q)`, where `approach` is +1 when the position is
/// reached with rising commands, −1 with falling ones and 0 when that is not known, and `z` is one
/// standard-normal factor for the whole curve (fully correlated along it).
#[derive(Debug, Clone, PartialEq)]
pub struct StatedError {
    /// Mean of the two directions of approach.
    pub mean: Curve,
    /// E↑ − E↓, ISO 230-2's B, if it is known.
    pub reversal: Option<Curve>,
    /// Standard uncertainty at a position, if it is known.
    pub u: Option<Uncertainty>,
    /// Instrument, date, temperature.
    pub measured: Measurement,
}

/// The standard uncertainty of an error.
#[derive(Debug, Clone, PartialEq)]
pub enum Uncertainty {
    /// The same at every position, mm or rad.
    Constant(f64),
    /// Between measured positions by straight lines, so that it never falls below zero.
    Table(Spline),
}

impl StatedError {
    /// A constant with an optional standard uncertainty.
    pub fn constant(value: f64, u: Option<f64>) -> Self {
        Self {
            mean: Curve::Constant(value),
            reversal: None,
            u: u.map(Uncertainty::Constant),
            measured: Measurement::default(),
        }
    }

    /// The error times a factor, and shifted (mm or rad); its uncertainty stays.
    ///
    /// ```
    /// use trueaxis_machine::errors::StatedError;
    /// let doubled = StatedError::constant(0.010, Some(0.002)).changed(2.0, 0.001);
    /// assert!((doubled.at(0.0, 0.0).unwrap() - 0.021).abs() < 1e-15);
    /// assert_eq!(doubled.u_at(0.0), 0.002);
    /// ```
    pub fn changed(&self, factor: f64, add: f64) -> Self {
        Self {
            mean: self.mean.changed(factor, add),
            reversal: self.reversal.as_ref().map(|r| r.changed(factor, 0.0)),
            ..self.clone()
        }
    }

    /// The value at a programmed position for a direction of approach (+1, −1, or 0: the mean).
    ///
    /// # Errors
    /// A position that a table does not cover.
    pub fn at(&self, q: f64, approach: f64) -> Result<f64, OutsideTable> {
        let mean = self.mean.at(q)?;
        match &self.reversal {
            Some(reversal) if approach != 0.0 => Ok(mean + 0.5 * approach * reversal.at(q)?),
            _ => Ok(mean),
        }
    }

    /// The standard uncertainty at a programmed position; 0 where none is stated.
    pub fn u_at(&self, q: f64) -> f64 {
        match &self.u {
            None => 0.0,
            Some(Uncertainty::Constant(u)) => *u,
            Some(Uncertainty::Table(table)) => {
                let (from, to) = table.range();
                table.at(q.clamp(from, to))
            }
        }
    }
}
