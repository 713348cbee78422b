//! Any text as the record of a part: never a panic; a record that is taken has finite positions and offsets, and every
//! row that a hole finds is one of its own, at the place of the hole.
//!
//! `scripts/fuzz part_record 120`

#![no_main]

use libfuzzer_sys::fuzz_target;
use trueaxis::predict::acted::{ActedRecord, SAME_PLACE_MM, is_lateral};
use trueaxis_input::Diagnostics;
use trueaxis_machine::Machine;
use trueaxis_machine::file::NoTables;

const MACHINES: [&str; 2] = [
    "[machine]\nname = \"m\"\nchain = \"w b X Y Z t\"\n",
    "[machine]\nname = \"m\"\nchain = \"w C A b X Y Z t\"\n",
];

fuzz_target!(|data: &[u8]| {
    let Ok(text) = std::str::from_utf8(data) else { return };
    for machine in MACHINES {
        let machine = Machine::check("m", machine, &NoTables).0.expect("a machine");
        let mut problems = Diagnostics::new();
        let record = ActedRecord::parse("part.csv", text, &machine, &mut problems);
        assert!(record.is_some() != problems.has_errors());
        for row in record.iter().flat_map(|record| &record.rows) {
            assert!(row.time_s.is_finite() && row.at.iter().chain(&row.by).all(|v| v.is_finite()));
            let last = record.as_ref().and_then(|r| r.at(&machine, &row.at)).expect("its own row at least");
            let mut lateral = machine.axes().iter().enumerate().filter(|(_, axis)| is_lateral(axis));
            assert!(lateral.all(|(i, _)| (last.at[i] - row.at[i]).abs() <= SAME_PLACE_MM));
        }
    }
});
