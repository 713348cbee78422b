//! States of the governor, and the reason for each.

use serde::{Deserialize, Serialize};
use std::fmt;
use trueaxis_report::JsonSchema;

/// The state of a run.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum State {
    /// The correction is not wanted; nothing is written.
    Off,
    /// It is wanted; the first reading of the control and of the sensors is missing.
    Arm,
    /// It follows its target.
    Run,
    /// It stays as it is.
    Hold,
    /// It goes to zero.
    RampDown,
    /// It stays as it is until a person confirms.
    Latched,
}

/// All of them.
pub const STATES: [State; 6] =
    [State::Off, State::Arm, State::Run, State::Hold, State::RampDown, State::Latched];

impl fmt::Display for State {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Off => "Off",
            Self::Arm => "Arm",
            Self::Run => "Run",
            Self::Hold => "Hold",
            Self::RampDown => "RampDown",
            Self::Latched => "Latched",
        })
    }
}

/// Why a run is in its state.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub enum Reason {
    /// The correction is not wanted, or no more.
    NotAsked,
    /// It follows its target.
    Follows,
    /// The target is beyond the limit of an axis.
    Limit,
    /// No connection to the control.
    LinkLost {
        /// What the connection says.
        what: String,
    },
    /// Emergency stop.
    Emergency,
    /// An axis has no reference point.
    NotHomed,
    /// The axes were homed again while an offset was written.
    HomedAgain,
    /// The watchdog of the control has let the offsets go.
    Watchdog,
    /// The control forbids it: probing, threading, tool setting.
    Inhibited,
    /// The control has taken the offset back itself: its kinematics change.
    Released,
    /// A mode in which offsets do not change.
    Mode,
    /// A sensor gives nothing that can be used.
    Sensor {
        /// Its name.
        sensor: String,
        /// What is wrong.
        what: String,
    },
    /// The sensor on the workpiece is lost: the machine alone would make the part worse.
    Workpiece {
        /// Its name.
        sensor: String,
        /// What is wrong.
        what: String,
    },
    /// The model gives no value there.
    Model {
        /// What it says.
        what: String,
    },
    /// Another setup is in the machine, and its zero was never touched.
    Setup {
        /// Its number.
        number: i32,
    },
    /// The target is no number.
    NotFinite,
    /// The target has jumped.
    Jump,
    /// The control refuses what is written.
    WriteRefused,
    /// The journal takes no entry.
    Journal,
    /// The control holds what this program has not written.
    Foreign,
    /// At the start the control holds another value than the journal.
    Difference,
    /// At the start the control holds an offset, and what of it is this program's is not known: the journal is lost.
    Lost,
}

impl Reason {
    /// Whether it is the same reason for readers of a journal: what a broken sensor sends changes with every sample.
    pub fn is_like(&self, other: &Self) -> bool {
        let of = |reason: &Self| match reason {
            Self::Sensor { sensor, .. } | Self::Workpiece { sensor, .. } => Some(sensor.clone()),
            Self::Setup { number } => Some(number.to_string()),
            _ => None,
        };
        std::mem::discriminant(self) == std::mem::discriminant(other) && of(self) == of(other)
    }
}

impl fmt::Display for Reason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotAsked => write!(f, "not asked for"),
            Self::Follows => write!(f, "follows its target"),
            Self::Limit => write!(f, "an axis is at its limit"),
            Self::LinkLost { what } => write!(f, "link lost: {what}"),
            Self::Emergency => write!(f, "emergency stop"),
            Self::NotHomed => write!(f, "an axis is not homed"),
            Self::HomedAgain => write!(f, "the axes were homed again"),
            Self::Watchdog => write!(f, "the watchdog of the control has tripped"),
            Self::Inhibited => write!(f, "the control forbids a change now"),
            Self::Released => {
                write!(f, "the control has taken the offset back: its kinematics change")
            }
            Self::Mode => write!(f, "mode of operation"),
            Self::Sensor { sensor, what } => write!(f, "sensor {sensor}: {what}"),
            Self::Workpiece { sensor, what } => write!(f, "workpiece sensor {sensor}: {what}"),
            Self::Model { what } => write!(f, "{what}"),
            Self::Setup { number } => {
                write!(f, "setup {number}: its zero was not touched yet")
            }
            Self::NotFinite => write!(f, "the target is no number"),
            Self::Jump => write!(f, "the target has jumped"),
            Self::WriteRefused => write!(f, "the control refuses what is written"),
            Self::Journal => write!(f, "the journal cannot be written"),
            Self::Foreign => write!(f, "the control holds a value of another source"),
            Self::Difference => write!(f, "the control holds another value than the journal"),
            Self::Lost => write!(
                f,
                "the journal does not say what of the offset in the control is this program's"
            ),
        }
    }
}
