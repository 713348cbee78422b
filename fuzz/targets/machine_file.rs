//! Any bytes as a machine file with its tables: never a panic; a machine or an error, and the poses
//! of a machine are finite.
//!
//! `scripts/fuzz machine_file 600`

#![no_main]

use libfuzzer_sys::fuzz_target;
use trueaxis_machine::Machine;
use trueaxis_machine::file::Tables;

/// Every table that the file names is the second half of the input.
struct Half<'a>(&'a str);

impl Tables for Half<'_> {
    fn text(&self, _name: &str) -> Result<String, String> {
        Ok(self.0.to_owned())
    }
}

fuzz_target!(|data: &[u8]| {
    let text = String::from_utf8_lossy(data);
    let (file, table) = text.split_once("\n===\n").unwrap_or((&text, ""));
    let (machine, problems) = Machine::check("machine.toml", file, &Half(table));
    let Some(machine) = machine else {
        assert!(problems.has_errors());
        return;
    };
    let command = [1.0; 6];
    if let Ok(errors) = machine.errors_at(&command, &[1.0; 6]) {
        let deviation = machine.deviation(&command, &errors);
        assert!(deviation.tip_mm.iter().all(|v| v.is_finite()));
    }
});
