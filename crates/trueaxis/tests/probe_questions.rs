//! The answer of the programs of a probe says of its table what stands in it.

use std::path::{Path, PathBuf};
use trueaxis::files::disk;
use trueaxis::identify::probe::{Purpose, identify_probe, read_study};
use trueaxis::input::Diagnostics;
use trueaxis::questions::{Answer, ProbePrograms, ask};

/// The range of the corrections is the greatest less the least of them, in µm: tens of them for this ring.
#[test]
fn the_range_of_a_table_is_that_of_its_corrections() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let study = root.join("examples/05_identify/ring-programs.toml");
    let question = ProbePrograms {
        study: study.clone(),
        control: "fanuc".to_owned(),
        output: PathBuf::from("programs"),
        corrected: true,
        stylus: None,
        orientation: None,
    };
    let mut problems = Diagnostics::new();
    let answer = ask(&question, &disk(), &|_| {}, &mut problems);
    let answer = answer.unwrap_or_else(|| panic!("{problems:?}"));
    let shown = answer.document(&problems)["table"].clone();
    let (study, _) = read_study(&disk(), &study, Purpose::Calibration);
    let study = study.expect("the example");
    let found = identify_probe(&study, &mut Diagnostics::new()).expect("a calibration");
    let rows = found[0].table(study.table_steps, 0.0);
    let ends = rows.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], row| {
        [low.min(row.deviation_mm), high.max(row.deviation_mm)]
    });
    let range_um = 1e3 * (ends[1] - ends[0]);
    assert!((1.0..200.0).contains(&range_um), "{range_um}");
    assert_eq!(shown["directions"], rows.len());
    let said = shown["range_um"].as_f64().expect("a number");
    assert!((said - range_um).abs() < 1e-9 * range_um, "{said}, not {range_um}");
}
