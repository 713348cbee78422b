//! `heat.json`: the heat in the scales over restarts.

use crate::memory::HeatOfRun;
use serde::{Deserialize, Serialize};
use std::fs;
use std::io;
use std::path::Path;

pub(super) const KEPT: &str = "heat.json";

/// The heat in the scales, and when it was.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct KeptHeat {
    /// The machine.
    pub machine: String,
    /// When, seconds since 1970 (UTC): 0 on the clock of the heat.
    pub date_s: u64,
    /// What is in the scales.
    pub heat: HeatOfRun,
}

/// The heat that a run of this folder has left.
///
/// # Errors
/// A file that cannot be read.
pub fn kept_heat(folder: &Path) -> Result<Option<KeptHeat>, String> {
    match fs::read_to_string(folder.join(KEPT)) {
        Ok(text) => serde_json::from_str(&text).map(Some).map_err(|error| error.to_string()),
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(None),
        Err(error) => Err(error.to_string()),
    }
}
