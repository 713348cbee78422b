//! `datum.json`: the zero of the part over restarts; and the file by which another process asks for one.

use super::foreign::foreign_file;
use super::kept::kept;
use crate::datum::DatumOrder;
use crate::setups::SetupDatum;
use serde::{Deserialize, Serialize};
use std::fs;
use std::io;
use std::path::Path;

const KEPT: &str = "datum.json";
/// Its text is what is asked: `take` or `clear`.
const ASKED: &str = "datum-asked";

/// The zeros of the setups, and when the last one was touched.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct KeptDatums {
    /// The plan and machine file that they were touched under.
    pub plan_hash: String,
    /// When, seconds since 1970 (UTC).
    pub date_s: u64,
    /// What was missing at each.
    pub zeros: Vec<SetupDatum>,
}

/// The zeros that a run of this folder has left.
///
/// # Errors
/// A file that cannot be read.
pub fn kept_datums(folder: &Path) -> Result<Option<KeptDatums>, String> {
    kept(folder, KEPT)
}

/// Keeps zeros, or removes them.
///
/// # Errors
/// What the disk says.
pub(super) fn keep(folder: &Path, kept: Option<&KeptDatums>) -> Result<(), String> {
    let path = folder.join(KEPT);
    let done = match kept {
        Some(kept) => {
            let text = serde_json::to_string_pretty(kept).map_err(|error| error.to_string())?;
            trueaxis::files::write(&path, format!("{text}\n").as_bytes())
        }
        None => match fs::remove_file(&path) {
            Err(error) if error.kind() != io::ErrorKind::NotFound => Err(error),
            _ => Ok(()),
        },
    };
    done.map_err(|error| error.to_string())
}

/// Asks the run of a folder to take the zero now, or to clear it; without a run only the second, at once.
///
/// # Errors
/// What the disk says.
pub fn ask_datum(folder: &Path, clear: bool, is_running: bool) -> Result<(), String> {
    match is_running {
        true => {
            let text = if clear { "clear" } else { "take" };
            let path = folder.join(ASKED);
            trueaxis::files::write(&path, text.as_bytes()).map_err(|error| error.to_string())
        }
        false => match foreign_file(folder) {
            Some(file) => Err(file.to_string()),
            None => keep(folder, None),
        },
    }
}

/// What was asked; the file goes.
pub(super) fn asked(folder: &Path) -> Option<DatumOrder> {
    let path = folder.join(ASKED);
    let text = fs::read_to_string(&path).ok()?;
    fs::remove_file(&path).ok()?;
    match text.trim() {
        "take" => Some(DatumOrder::Take),
        "clear" => Some(DatumOrder::Clear),
        _ => None,
    }
}
