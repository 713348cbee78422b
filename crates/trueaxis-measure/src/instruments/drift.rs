//! How an instrument drifts against the tool while it reads.
//!
//! ```text
//!     Q(t) = Q + R d (t − t₀)     z(t) = z + ż (t − t₀)     P(t) = P + (0 0 g) (t − t₀)     docs/model.md eq. 307
//! ```
//!
//! d along X, Y, Z of the machine, R the nominal attitude of the machine as the reference sees it, t₀ the first reading
//! of the instrument: where a machine, its table and a ball on it expand, they do it along the axes of the machine. z the
//! zero of a distance (the length of a bar), g along z of the tool: a spindle expands along itself.

use super::Readings;
use super::instrument::Instrument;
pub use super::rate::{Drift, Drifted, Walk};
use trueaxis_geometry::Mat3;
use trueaxis_machine::Machine;
use trueaxis_machine::axis::Command;
use trueaxis_machine::errors::ErrorValues;
use trueaxis_machine::twist::Reference;

/// Seconds of an hour.
const HOUR_S: f64 = 3600.0;

impl Instrument {
    /// Whether a rate is among its unknowns.
    pub fn has_rate(&self) -> bool {
        self.unknowns.iter().any(|u| u.error.is_rate())
    }

    /// Whether its readings need a time.
    pub fn needs_time(&self) -> bool {
        self.has_rate() || self.drift.walk == Walk::Always
    }

    /// R (t − t₀) and t − t₀ in hours; 0 without a rate among its unknowns.
    pub fn drifted(&self, machine: &Machine, command: &Command, time_s: f64) -> Drifted {
        if !self.has_rate() {
            return Drifted::default();
        }
        let hours = (time_s - self.drift.from_s) / HOUR_S;
        let along_axes = match self.reference {
            Reference::Bed => Mat3::identity() * hours,
            Reference::Workpiece => {
                let none = ErrorValues::default();
                let from_tool = machine.pose(command, &none).linear().into_owned();
                let on_bed = machine.tool_on_bed(command, &none).linear().into_owned();
                from_tool * on_bed.transpose() * hours
            }
        };
        Drifted { along_axes, hours }
    }
}

impl Readings {
    /// The time of the first reading of an instrument; none if there is none. Unit: s.
    pub fn first_s(&self, instrument: usize) -> Option<f64> {
        let mine = (0..self.len()).filter(|i| self.instruments[*i] as usize == instrument);
        mine.map(|i| self.times_s[i]).min_by(f64::total_cmp)
    }
}
