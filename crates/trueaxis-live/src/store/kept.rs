//! What an earlier run has left in a file.

use serde::de::DeserializeOwned;
use std::fs;
use std::io;
use std::path::Path;

/// What a file of a folder holds; none where it is not there.
pub(super) fn kept<T: DeserializeOwned>(folder: &Path, name: &str) -> Result<Option<T>, String> {
    match fs::read_to_string(folder.join(name)) {
        Ok(text) => serde_json::from_str(&text).map(Some).map_err(|error| error.to_string()),
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(None),
        Err(error) => Err(error.to_string()),
    }
}
