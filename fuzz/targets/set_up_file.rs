//! Any text as a set-up file: never a panic; what is taken has finite numbers.
//!
//! `scripts/fuzz set_up_file 120`

#![no_main]

use libfuzzer_sys::fuzz_target;
use trueaxis::files::disk;
use trueaxis::machine::Machine;
use trueaxis::machine::file::NoTables;
use trueaxis::simulate::parse_setup;

fuzz_target!(|data: &[u8]| {
    let Ok(text) = std::str::from_utf8(data) else { return };
    let machine = "[machine]\nname = \"m\"\nchain = \"w C' A' b X Y Z t\"\n\
                   [tool.library.t]\nlength = \"100 mm\"\n";
    let machine = Machine::check("m", machine, &NoTables).0.expect("a machine");
    let (setup, problems) = parse_setup(&disk(), "p", text, "/nonexistent".as_ref(), &machine);
    assert!(setup.is_some() != problems.has_errors());
    if let Some(setup) = setup {
        assert!(setup.tools.values().all(|t| t.tip_mm.iter().all(|x| x.is_finite())));
        assert!(setup.work_offsets.values().all(|f| f.shift.0.iter().all(|x| x.is_finite())));
    }
});
