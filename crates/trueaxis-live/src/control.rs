//! A control as the loop needs it: its pose and state are read, an offset is written and read back.
//!
//! [`Control`] is what FANUC, LinuxCNC, a PLC over OPC UA and the replay of a record have in common. Offsets are whole
//! least increments, one for each live axis, in the order of the plan; a control that takes another unit (LinuxCNC: mm,
//! SD43900: mm) converts inside.

use crate::pose::Frame;
use serde::{Deserialize, Serialize};

/// What a control says of itself; a plan is bound to it.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Identity {
    /// Its kind, such as `31`.
    pub kind: String,
    /// Its series.
    pub series: String,
    /// The version of its software.
    pub version: String,
    /// The names of its axes, in its own order.
    pub axes: Vec<String>,
    /// Digits after the decimal point of their positions, mm or deg, in the same order: 3 where the least increment is 1 µm.
    pub decimals: Vec<u16>,
}

/// The mode of operation.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Mode {
    /// A program from memory, or from a line.
    Automatic,
    /// A block that is typed.
    Mdi,
    /// Handwheel, jog, increments, teach-in.
    Manual,
    /// Going to the reference points.
    Reference,
    /// Editing, or no mode.
    Other,
}

impl Mode {
    /// All, with the name in a plan.
    pub const NAMED: [(&'static str, Self); 5] = [
        ("automatic", Self::Automatic),
        ("mdi", Self::Mdi),
        ("manual", Self::Manual),
        ("reference", Self::Reference),
        ("other", Self::Other),
    ];
}

/// A block of a program that is executed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub struct Block {
    /// The number of the program; 0 where the control does not say.
    pub program: i32,
    /// Its sequence number (the last N), or its line.
    pub number: i32,
}

/// What a control reports in one cycle.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Seen {
    /// Machine positions of all axes of the machine file, in its order, with the offset in them. Unit: mm or rad.
    pub positions: Vec<f64>,
    /// The offsets that the control holds, one for each live axis, in least increments.
    pub offsets: Vec<i32>,
    /// The offsets that act now, where the control reports them: a ladder may follow slowly.
    pub acting: Option<Vec<i32>>,
    /// Whether every live axis has its reference point.
    pub homed: bool,
    /// Emergency stop.
    pub emergency: bool,
    /// An alarm is shown.
    pub alarm: bool,
    /// The mode.
    pub mode: Mode,
    /// A program moves the axes.
    pub cutting: bool,
    /// The control says that offsets must not change now: probing, threading, tapping, tool setting.
    pub inhibited: bool,
    /// The ladder has let the offsets go, because nothing came from here.
    pub tripped: bool,
    /// The control has taken the offsets to zero itself and goes on from there: its kinematics change, its watchdog has tripped.
    #[serde(default)]
    pub released: bool,
    /// The feed along the path.
    pub feed_mm_per_min: f64,
    /// What its offsets are added to.
    #[serde(default)]
    pub frame: Frame,
    /// The length of the tool that the control counts with; none where it does not say.
    #[serde(default)]
    pub tool_length_mm: Option<f64>,
    /// Tip of the tool in X Y Z of the control, while all axes stand; none where it does not say.
    #[serde(default)]
    pub standing_tip_mm: Option<[f64; 3]>,
    /// The block that is executed; none where it does not say.
    #[serde(default)]
    pub block: Option<Block>,
    /// The number of the setup that is in the machine; none where it does not say.
    #[serde(default)]
    pub setup: Option<i32>,
}

impl Seen {
    /// Of a control in automatic that moves and lacks nothing, with positions (mm or rad) and offsets (least increments).
    pub fn moving(positions: Vec<f64>, offsets: Vec<i32>) -> Self {
        Self {
            positions,
            offsets,
            acting: None,
            homed: true,
            emergency: false,
            alarm: false,
            mode: Mode::Automatic,
            cutting: true,
            inhibited: false,
            tripped: false,
            released: false,
            feed_mm_per_min: 0.0,
            frame: Frame::Machine,
            tool_length_mm: None,
            standing_tip_mm: None,
            block: None,
            setup: None,
        }
    }
}

/// What is sent in one cycle.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, Deserialize)]
pub struct Sent {
    /// The offsets, if they change.
    pub offsets: Option<Vec<i32>>,
    /// Changes with every cycle: while it does, the ladder holds the offsets.
    pub beat: u8,
    /// Asks the control for feed hold, with its alarm.
    pub ask_hold: bool,
}

/// Why a control could not be read or written.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, thiserror::Error)]
#[serde(tag = "fault", rename_all = "kebab-case")]
pub enum LinkFault {
    /// No connection, or it broke.
    #[error("no connection: {reason}")]
    Down {
        /// What the system says.
        reason: String,
    },
    /// It did not answer in time.
    #[error("no answer within {millis} ms")]
    Silent {
        /// The time that was allowed.
        millis: u32,
    },
    /// It answered what is no answer.
    #[error("{reason}")]
    Garbage {
        /// What is wrong with it.
        reason: String,
    },
    /// It refuses.
    #[error("{call} is refused: {reason}")]
    Refused {
        /// What was asked.
        call: String,
        /// Why, with what to change in the control.
        reason: String,
    },
}

/// A control.
pub trait Control {
    /// What it says of itself; opens the connection.
    ///
    /// # Errors
    /// [`LinkFault`].
    fn identity(&mut self, now_s: f64) -> Result<Identity, LinkFault>;

    /// Its pose and state, and the offsets that it holds. Returns within the time limit of the connection, also while
    /// there is none.
    ///
    /// # Errors
    /// [`LinkFault`].
    fn read(&mut self, now_s: f64) -> Result<Seen, LinkFault>;

    /// Writes.
    ///
    /// # Errors
    /// [`LinkFault`]: it is then not known which of the axes have their new offset.
    fn write(&mut self, sent: &Sent, now_s: f64) -> Result<(), LinkFault>;

    /// Whether its offsets end with it, so that no journal needs to know them: nothing is kept before each write then.
    fn is_volatile(&self) -> bool {
        false
    }
}
