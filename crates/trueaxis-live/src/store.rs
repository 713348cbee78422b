//! What a run leaves: what it owns in the control, its events, its state, its record.

mod datum;
mod disk;
mod foreign;
mod heat;
mod history;
mod kept;
mod latest;
mod lines;
mod memory;
mod owned;
mod part;

pub use datum::{KeptDatums, ask_datum, kept_datums};
pub use disk::{DiskStore, StoreFault, ask_stop, is_running, last_events, last_state, own_folder};
pub use foreign::Foreign;
pub use heat::{KeptHeat, kept_heat};
pub use history::history_lines;
pub use memory::{MemoryStore, Noted};
pub use part::{PartFault, begin_part, end_part, part_now, part_path, parts};

use crate::control::Identity;
use crate::cycle::CycleInput;
use crate::datum::DatumOrder;
use crate::governor::{Order, Owned};
use crate::memory::HeatOfRun;
use crate::setups::SetupDatum;
use serde::{Deserialize, Serialize};

/// Whose offsets they are.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Owner {
    /// The name of the machine.
    pub machine: String,
    /// The control.
    pub control: Identity,
    /// The live axes.
    pub axes: Vec<String>,
}

/// A line of the journal.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Event {
    /// The clock of the run.
    pub at_s: f64,
    /// The date, seconds since 1970 (UTC), for readers only.
    pub date_s: u64,
    /// What happened, in one word.
    pub event: String,
    /// More about it.
    pub what: String,
    /// The offsets at that time, increments.
    pub offsets: Vec<i32>,
}

/// Keeps it.
pub trait Store {
    /// What will be in the control after the next write; kept before it is written.
    ///
    /// # Errors
    /// What the disk says: then nothing is written.
    fn own(&mut self, owned: &Owned) -> Result<(), String>;

    /// A line of the journal.
    ///
    /// # Errors
    /// What the disk says.
    fn event(&mut self, event: &Event) -> Result<(), String>;

    /// The present state, for `trueaxis live status`.
    ///
    /// # Errors
    /// What the disk says.
    fn state(&mut self, document: &serde_json::Value) -> Result<(), String>;

    /// The same as metrics, for other programs.
    ///
    /// # Errors
    /// What the disk says.
    fn metrics(&mut self, _text: String) -> Result<(), String> {
        Ok(())
    }

    /// The zeros of all setups, for the next run.
    ///
    /// # Errors
    /// What the disk says.
    fn datums(&mut self, _all: &[SetupDatum]) -> Result<(), String> {
        Ok(())
    }

    /// What another process has asked of the zero of the part; each is given once.
    fn datum_order(&mut self) -> Option<DatumOrder> {
        None
    }

    /// A line of the history, under these headings; a line that the disk is too slow for is lost.
    fn history(&mut self, _heading: &str, _line: String) {}

    /// The heat in the scales, for the next run, on a clock that is 0 now.
    ///
    /// # Errors
    /// What the disk says.
    fn heat(&mut self, _heat: HeatOfRun) -> Result<(), String> {
        Ok(())
    }

    /// The part that a person says is being made.
    fn part(&mut self) -> Option<String> {
        None
    }

    /// Goes on with the record of a part under these headings; without a name it ends.
    ///
    /// # Errors
    /// Why it cannot be filled.
    fn open_part(&mut self, _part: Option<&str>, _heading: &str) -> Result<(), String> {
        Ok(())
    }

    /// A line of the record of the part that is open.
    ///
    /// # Errors
    /// It is lost.
    fn part_line(&mut self, _line: String) -> Result<(), String> {
        Ok(())
    }

    /// Whether another process has asked for the end of this run.
    fn is_stop_asked(&mut self) -> bool {
        false
    }

    /// One cycle, where a record is wanted.
    ///
    /// # Errors
    /// What the disk says.
    fn record(&mut self, input: &CycleInput, order: &Order) -> Result<(), String>;
}
