//! Error tables: what an eccentric artefact takes and leaves, and which angle a reading hangs on.

use std::collections::BTreeMap;
use std::f64::consts::TAU;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use trueaxis::files::disk;
use trueaxis::input::Diagnostics;
use trueaxis::verify::error_tables::{ErrorTable, error_tables, parse_tables};

/// The tables of readings (name, rows of target and deviation in µm, further keys) on a machine.
fn tables(
    machine: &str,
    target: &str,
    readings: &[(&str, Vec<[f64; 2]>, &str)],
) -> (Vec<ErrorTable>, Diagnostics) {
    let mut files = BTreeMap::from([(PathBuf::from("m.toml"), machine.to_owned())]);
    let mut study = "name = \"t\"\nmachine = \"m.toml\"\n".to_owned();
    for (name, rows, keys) in readings {
        let _ = write!(study, "[readings.{name}]\ntable = \"{name}.csv\"\nu = \"1 um\"\n{keys}");
        let mut sheet = format!("{target},run,direction,deviation_um\n");
        for [q, um] in rows {
            for (run, direction) in [(1, "up"), (1, "down"), (2, "up"), (2, "down")] {
                let _ = writeln!(sheet, "{q},{run},{direction},{um:.9}");
            }
        }
        files.insert(PathBuf::from(format!("{name}.csv")), sheet);
    }
    let files = disk().with_texts(files);
    let (study, mut problems) = parse_tables(&files, Path::new("study.toml"), &study);
    let study = study.unwrap_or_else(|| panic!("{problems:?}"));
    let found = error_tables(&study, &mut problems);
    (found, problems)
}

/// An axis that wobbles by 10 µm once a turn in one direction across it only is half a wobble that goes round with
/// the axis, as an artefact off its centre does, and half a wobble against it: the first is subtracted, and 5 µm stay
/// at every angle. The direction does not matter, nor on which side the axis is.
#[test]
fn law_an_eccentric_artefact_takes_half_of_a_wobble_in_one_direction() {
    let on_axis = [
        ("w C' b X Y Z t", "C", ["EXC", "EYC"]),
        ("w b X Y Z C t", "C", ["EXC", "EYC"]),
        ("w b X Y Z B t", "B", ["EXB", "EZB"]),
        ("w A' b X Y Z t", "A", ["EYA", "EZA"]),
    ];
    for (chain, axis, names) in on_axis {
        let head = format!("[machine]\nname = \"m\"\nchain = \"{chain}\"\n");
        let machine = format!("{head}[axis.{axis}]\ntravel = \"unlimited\"\n");
        for wobbles in 0..2 {
            let rows = |i: usize| -> Vec<[f64; 2]> {
                let um = |k: u32| 10.0 * (TAU * f64::from(k) / 12.0).cos();
                let at = |k: u32| [30.0 * f64::from(k), if i == wobbles { um(k) } else { 0.0 }];
                (0..12).map(at).collect()
            };
            let readings = [(names[0], rows(0), ""), (names[1], rows(1), "")];
            let (found, problems) = tables(&machine, "target_deg", &readings);
            assert!(!problems.has_errors(), "{chain}: {:?}", problems.sorted());
            let [u, v] = &found[..] else { panic!("two tables") };
            for (u, v) in u.mean().iter().zip(v.mean()) {
                let left_um = 1e3 * u.hypot(v);
                assert!((left_um - 5.0).abs() < 1e-6, "{chain}, {}: {left_um}", names[wobbles]);
            }
        }
    }
}

/// A straightness of X along Y that was read 300 mm below depends on the roll of X, 0.30 µm for each µrad: that is said,
/// unless the machine file knows the roll, or it was read where it acts.
#[test]
fn an_arm_of_an_unknown_angle_is_named_with_its_length() {
    let warned = |errors: &str, optics: &str| -> Vec<String> {
        let machine = format!("[machine]\nname = \"m\"\nchain = \"w b X Y Z t\"\n{errors}");
        let rows: Vec<[f64; 2]> =
            (0..5).map(|k| [100.0 * f64::from(k), f64::from(k * k)]).collect();
        let keys = format!("optics = \"{optics}\"\n");
        let (_, problems) = tables(&machine, "target_mm", &[("EYX", rows, keys.as_str())]);
        let named = problems.iter().filter(|d| d.code == "unknown-angle");
        named.map(|d| d.message.clone()).collect()
    };
    let found = warned("", "0 0 -300 mm");
    assert_eq!(found.len(), 1, "{found:?}");
    assert!(["300 mm away", "EAX is not known", "0.30 µm"].iter().all(|w| found[0].contains(*w)));
    assert!(warned("[motion.X]\nEAX = \"0 urad\"\n", "0 0 -300 mm").is_empty());
    assert!(warned("", "0 0 0 mm").is_empty());
}

/// A table without a temperature would hold at that of the table which it replaces; this is said, once for the scale, and
/// not for errors that no scale makes.
#[test]
fn a_scale_without_a_temperature_is_named() {
    let machine = |celsius: f64| {
        format!(
            "[machine]\nname = \"m\"\nchain = \"w b X Y Z t\"\n[scale.X]\nexpansion = \"10 um/(m K)\"\n\
             fixed_point = \"0 mm\"\nsensors = {{ x = \"0 mm\" }}\n\
             [motion.X]\nmeasured = {{ temperature = \"{celsius} degC\" }}\n\
             EXX = {{ polynomial = [\"0 um\", \"9 um\"], scale = \"100 mm\" }}\n"
        )
    };
    let rows = || (0..5).map(|i| [100.0 * f64::from(i), f64::from(i)]).collect::<Vec<_>>();
    for celsius in [20.0, 28.4] {
        for (keys, due, is_said) in
            [("", celsius, true), ("temperature = \"22 degC\"\n", 22.0, false)]
        {
            let readings = [("EXX", rows(), keys), ("EYX", rows(), "")];
            let (found, problems) = tables(&machine(celsius), "target_mm", &readings);
            let of = |name: &str| found.iter().find(|t| t.name.to_string() == name);
            assert_eq!(of("EXX").and_then(|t| t.celsius), Some(due));
            assert_eq!(of("EYX").and_then(|t| t.celsius), None);
            let said = problems.iter().filter(|d| d.code == "no-temperature");
            let said: Vec<&str> = said.map(|d| d.message.as_str()).collect();
            assert_eq!(said.len(), usize::from(is_said), "{said:?}");
            assert!(said.iter().all(|m| m.contains("EXX") && m.contains(&celsius.to_string())));
        }
    }
}
