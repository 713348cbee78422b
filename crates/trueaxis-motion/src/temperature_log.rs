//! A log of temperatures from a file.

use super::parquet_log;
use std::path::Path;
use trueaxis_input::{Diagnostics, Files};
use trueaxis_machine::heat::TemperatureLog;

/// Reads a log of temperatures: CSV, or Parquet with the same columns if the file ends in `.parquet`.
pub fn read_temperature_log(
    files: &Files,
    path: &Path,
    problems: &mut Diagnostics,
) -> Option<TemperatureLog> {
    let file = path.display().to_string();
    if path.extension().is_some_and(|e| e.eq_ignore_ascii_case("parquet")) {
        let bytes = files.bytes(path, "a Parquet log of temperatures", problems)?;
        let table = parquet_log::table(&file, bytes, problems)?;
        return TemperatureLog::from_table(&table, problems);
    }
    let text = files.text(path, "a CSV log of temperatures", problems)?;
    TemperatureLog::parse(&file, &text, problems)
}
