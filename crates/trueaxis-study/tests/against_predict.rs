//! The uncertainties that the machine file states: a study draws what `predict` draws.

mod common;

use common::{frustum, root, sound, values};
use trueaxis::files::disk;
use trueaxis::predict::drawing::{predict_part, read_part_study};
use trueaxis::predict::{Sampling, predict, read_study};

/// Mean and u of 4000 machines by another generator: within five standard deviations of each.
#[test]
fn law_spreads_are_those_of_predict() {
    let n = 4000;
    let study = frustum("against-predict", &format!("stated = true\n[design]\nmachines = {n}\n"));
    let found = study.findings(&values(&study, 0..n));
    let path = root().join("examples/03_predict/nas979-on-xkas2525.toml");
    let mut one = read_study(&disk(), &path).0.unwrap();
    one.sampling = Some(Sampling { samples: n, seed: 3 });
    let prediction = predict(&one, &|_| {}).unwrap();
    for (ours, index) in found.combinations[0].outputs.iter().zip(&prediction.indices) {
        let (ours, theirs) = (&ours.spread, index.spread.unwrap());
        let of_mean = theirs.u_mm * (2.0 / n as f64).sqrt();
        assert!((ours.mean_mm - theirs.mean_mm).abs() < 5.0 * of_mean, "{}", index.name.key);
        let of_u = (1.0 / n as f64).sqrt();
        assert!((ours.u_mm.unwrap() / theirs.u_mm - 1.0).abs() < 5.0 * of_u, "{}", index.name.key);
    }
}

/// A Latin hypercube and the sequence of Sobol' know the mean better than independent machines: by their error over
/// twenty seeds.
#[test]
fn law_even_designs_know_the_mean_better() {
    let error = |kind: &str| {
        let means: Vec<f64> = (0..20)
            .map(|seed| {
                let text = format!(
                    "stated = true\n[design]\nkind = \"{kind}\"\nmachines = 64\nseed = {seed}\n"
                );
                let study = frustum(&format!("even-{kind}-{seed}"), &text);
                study.findings(&values(&study, 0..64)).combinations[0].outputs[8].spread.mean_mm
            })
            .collect();
        let mean = means.iter().sum::<f64>() / 20.0;
        (means.iter().map(|m| (m - mean).powi(2)).sum::<f64>() / 19.0).sqrt()
    };
    let random = error("monte-carlo");
    for kind in ["latin-hypercube", "sobol"] {
        let even = error(kind);
        assert!(even < 0.5 * random, "{kind}: {even} instead of {random}");
    }
}

/// A part of any shape: its characteristics on drawn machines, as predict's own Monte Carlo finds them.
#[test]
fn law_parts_are_those_of_predict() {
    let n = 2000;
    let text = format!(
        "name = \"part\"\nstudy = \"ROOT/examples/03_predict/housing.toml\"\nstated = true\n[design]\nmachines = {n}\n"
    );
    let study = sound("against-part", &text);
    let found = study.findings(&values(&study, 0..n));
    let path = root().join("examples/03_predict/housing.toml");
    let mut one = read_part_study(&disk(), &path).0.unwrap();
    one.sampling = Some(Sampling { samples: n, seed: 3 });
    let mut problems = trueaxis::input::Diagnostics::new();
    let prediction = predict_part(&one, &|_| {}, &mut problems).unwrap();
    let drawn = prediction.drawn.unwrap();
    for (i, theirs) in drawn.characteristics.iter().enumerate() {
        let ours = &found.combinations[0].outputs[i];
        let of_mean = theirs.spread.u_mm * (2.0 / n as f64).sqrt();
        let off = (ours.spread.mean_mm - theirs.spread.mean_mm).abs();
        assert!(off < 5.0 * of_mean + 1e-9, "{}", study.cases[0].outputs[i].key);
        let share = theirs.good_ratio;
        let of_share = (2.0 * share * (1.0 - share) / n as f64).sqrt();
        assert!((ours.good_ratio.unwrap() - share).abs() < 5.0 * of_share + 1e-9);
    }
}
