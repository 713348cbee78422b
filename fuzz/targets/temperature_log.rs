//! Any text as a log of temperatures: never a panic; a log that is taken gives finite temperatures
//! and a finite machine at every time that it covers.
//!
//! `scripts/fuzz temperature_log 120`

#![no_main]

use libfuzzer_sys::fuzz_target;
use std::sync::Arc;
use trueaxis_input::Diagnostics;
use trueaxis_machine::Machine;
use trueaxis_machine::file::NoTables;
use trueaxis_machine::heat::{TemperatureLog, TemperatureRun, WarmingMachine};

const MACHINE: &str = r#"
machine = { name = "m", chain = "w b X Y Z t" }
workpiece = { expansion = "12 um/(m K)" }
[scale.X]
expansion = "10 um/(m K)"
table_temperature = "20 degC"
sensors = { a = "0 mm", b = "900 mm" }
[scale.Y]
expansion = "10 um/(m K)"
table_temperature = "20 degC"
heated = [
    { at = "0 mm", near = "a", far = "f", diffusivity = "4 mm^2/s" },
    { at = "90 mm", near = "b", far = "f", diffusivity = "4 mm^2/s" },
]
"#;

fuzz_target!(|data: &[u8]| {
    let Ok(text) = std::str::from_utf8(data) else { return };
    let mut problems = Diagnostics::new();
    let log = TemperatureLog::parse("log.csv", text, &mut problems);
    assert!(log.is_some() != problems.has_errors());
    let Some(log) = log.map(Arc::new) else { return };
    let machine = Machine::check("m", MACHINE, &NoTables).0.expect("a machine");
    let start_s = log.times_s()[0];
    let run = TemperatureRun { log, start_s };
    let Some(warming) = WarmingMachine::new(&machine, &run, &mut problems) else {
        assert!(problems.has_errors());
        return;
    };
    let mut time_s = 0.0;
    for _ in 0..10 {
        let Some((warm, until_s)) = warming.at(time_s) else { break };
        let command = [500.0, 50.0, 0.0, 0.0, 0.0, 0.0];
        let errors = warm.errors_at(&command, &[0.0; 6]).expect("within the travel");
        assert!(warm.deviation(&command, &errors).tip_mm.iter().all(|v| v.is_finite()));
        assert!(until_s > time_s);
        time_s = until_s;
    }
});
