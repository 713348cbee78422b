//! `heat.json`: the heat in the scales over restarts.

use super::kept::kept;
use crate::memory::HeatOfRun;
use serde::{Deserialize, Serialize};
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
    kept(folder, KEPT)
}
