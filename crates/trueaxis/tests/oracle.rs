//! The prediction of the NAS979 frustum against an independent program (oracles/nas979.py).

mod library;

use library::root;
use serde_json::Value;
use std::path::Path;
use trueaxis::files::disk;
use trueaxis::predict::{Cutting, Prediction, Reference, Setting, Study, predict, read_study};

fn study() -> Study {
    let path = root().join("examples/03_predict/nas979-on-xkas2525.toml");
    let (study, problems) = read_study(&disk(), &path);
    let list: Vec<String> = problems.iter().map(ToString::to_string).collect();
    let mut study = study.unwrap_or_else(|| panic!("{}", list.join("\n")));
    study.sampling = None;
    study
}

fn predicted() -> Prediction {
    predict(&study(), &|_| {}).expect("a prediction")
}

fn data(name: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data").join(name);
    std::fs::read_to_string(path).expect("a committed oracle file")
}

fn golden() -> Value {
    serde_json::from_str(&data("nas979-xkas2525.json")).expect("JSON")
}

/// Our key of an index and the oracle's.
const KEYS: [(&str, &str); 11] = [
    ("roundness_eq18_mm", "paper_roundness"),
    ("angularity_eq19_mm", "paper_angularity"),
    ("coaxiality_eq20_mm", "paper_coaxiality"),
    ("coaxiality_diameter_mm", "paper_coaxiality_diameter"),
    ("roundness_lsc_mm", "iso_roundness_lsc"),
    ("roundness_mzc_mm", "iso_roundness_mzc"),
    ("roundness_mic_mm", "iso_roundness_mic"),
    ("roundness_mcc_mm", "iso_roundness_mcc"),
    ("coaxiality_lsc_mm", "iso_coaxiality"),
    ("angularity_zone_mm", "iso_angularity_zone"),
    ("volumetric_max_mm", "volumetric_max"),
];

fn theirs(key: &str) -> &'static str {
    KEYS.iter().find(|(ours, _)| *ours == key).expect("a known index").1
}

#[test]
fn oracle_indices_and_their_uncertainties() {
    let (golden, ours) = (golden(), predicted());
    assert_eq!(ours.indices.len(), KEYS.len());
    for index in &ours.indices {
        let entry = &golden["indices_mm"][theirs(index.name.key)];
        let number = |key: &str| entry[key].as_f64().expect("a number");
        assert!((index.value_mm - number("value")).abs() < 1e-10, "{}", index.name.key);
        let u = number("u_linear_step_1");
        assert!((index.u_mm - u).abs() < 1e-7 * u, "u of {}", index.name.key);
    }
}

#[test]
fn oracle_indices_at_every_position() {
    let (golden, ours) = (golden(), predicted());
    let mut compared = 0;
    for (i, result) in ours.sections.iter().enumerate() {
        for (index, value) in ours.indices.iter().zip(&result.section.indices_mm) {
            let key = format!("{}@{}", theirs(index.name.key), i + 1);
            let Some(entry) = golden["indices_all_positions_mm"].get(&key) else { continue };
            let theirs = entry["value"].as_f64().expect("a number");
            assert!((value.expect("a value") - theirs).abs() < 1e-10, "{key}");
            compared += 1;
        }
    }
    assert!(compared >= 28, "only {compared} indices were compared");
}

#[test]
fn oracle_budget_of_every_error() {
    let (golden, ours) = (golden(), predicted());
    let mut worst = 0.0_f64;
    for share in &ours.budget.errors {
        for (i, index) in ours.indices.iter().enumerate() {
            let entry = &golden["blame"][share.of.to_string()][theirs(index.name.key)];
            let pairs = [(share.alone_mm[i], "alone_mm"), (share.without_mm[i], "without_mm")];
            for (value, key) in pairs {
                // The oracle has no inscribed circle where none is bounded by its contacts.
                if let Some(theirs) = entry[key].as_f64() {
                    worst = worst.max((value - theirs).abs());
                }
            }
        }
    }
    assert_eq!(ours.budget.errors.len(), 72);
    assert!(worst < 1e-9, "{worst:e} mm");
}

#[test]
fn oracle_commands_and_errors_at_every_azimuth() {
    let text = data("nas979-xkas2525.csv");
    let mut lines = text.lines().filter(|l| !l.starts_with('#'));
    let heads: Vec<&str> = lines.next().expect("headings").split(',').collect();
    let column = |name: &str| heads.iter().position(|h| *h == name).expect("a column");
    let ours = predicted();
    let rows: Vec<Vec<f64>> =
        lines.map(|l| l.split(',').map(|f| f.parse().expect("a number")).collect()).collect();
    assert_eq!(rows.len(), 72);
    for (i, row) in rows.iter().enumerate() {
        let [x, y, z, c, a, _] = ours.commands[i];
        let shown = [x, y, z, c.to_degrees(), a.to_degrees()];
        for (value, axis) in shown.into_iter().zip(["X", "Y", "Z", "C", "A"]) {
            assert!((value - row[column(axis)]).abs() < 1e-9, "{axis} of position {i}");
        }
        for (result, name) in ours.sections.iter().zip(["E0_mm", "E25_mm", "E50_mm", "E60_mm"]) {
            let e = result.section.deviation_mm[i];
            assert!((e - row[column(name)]).abs() < 1e-10, "{name} of position {i}");
        }
        let vector = ["Ev_x_mm", "Ev_y_mm", "Ev_z_mm"].map(|name| row[column(name)]);
        let at_base = ours.deviations_mm[i * ours.sections.len()];
        for (value, theirs) in at_base.iter().zip(vector) {
            assert!((value - theirs).abs() < 1e-10, "E_v of position {i}");
        }
    }
}

#[test]
fn oracle_zero_touched_along_the_cone_axis() {
    let golden = golden();
    let ours = predicted();
    let name = "zero touched with the tool along the cone axis";
    let variant = ours.variants.iter().find(|v| v.name == name).expect("a variant");
    for (index, value) in ours.indices.iter().zip(&variant.indices_mm) {
        let entry = &golden["setting_variant_C90_A10"]["indices_mm"][theirs(index.name.key)];
        let theirs = entry["value"].as_f64().expect("a number");
        assert!((value - theirs).abs() < 1e-10, "{}", index.name.key);
    }
    let study = study();
    let mut rotary = [0.0; 6];
    (rotary[3], rotary[4]) = (90_f64.to_radians(), 10_f64.to_radians());
    let reference = Reference { setting: Setting::Touched { rotary }, ..Reference::default() };
    let cutting = Cutting::new(&study.machine, study.piece(), &reference).expect("reachable");
    let [x, _, z, ..] = *cutting.setting_command();
    let command = &golden["setting_variant_C90_A10"]["setting_command"];
    assert!((x - command["X"].as_f64().expect("X")).abs() < 1e-9);
    assert!((z - command["Z"].as_f64().expect("Z")).abs() < 1e-9);
}

#[test]
fn oracle_monte_carlo_agrees_within_its_own_noise() {
    let golden = golden();
    let mut study = study();
    study.sampling = Some(trueaxis::predict::Sampling { samples: 4000, seed: 3 });
    let ours = predict(&study, &|_| {}).expect("a prediction");
    for index in &ours.indices {
        let entry = &golden["indices_mm"][theirs(index.name.key)]["monte_carlo"];
        let (mean, u) = (entry["mean"].as_f64().expect("mean"), entry["u"].as_f64().expect("u"));
        let n = entry["n"].as_f64().expect("n");
        let spread = index.spread.expect("a Monte Carlo run");
        // Both are samples: five standard deviations of the difference of the two estimates.
        let noise = (1.0 / 4000.0 + 1.0 / n).sqrt();
        assert!((spread.mean_mm - mean).abs() < 5.0 * u * noise, "mean of {}", index.name.key);
        assert!(
            (spread.u_mm / u - 1.0).abs() < 5.0 * noise / 2f64.sqrt() * 1.3,
            "u of {}",
            index.name.key
        );
    }
}
