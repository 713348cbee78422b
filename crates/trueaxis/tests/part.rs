//! Measured test pieces: does E_n say what it should, and does the verdict?

use std::path::Path;
use trueaxis::files::disk;
use trueaxis::part::tolerance::Outcome;
use trueaxis::predict::{Study, cut_virtually, read_study};
use trueaxis::verify::part::{
    CmmPoints, Measurements, PartPoints, PartRule, PartStudy, PredictionSource, verify_part,
};

const U_POINT_MM: f64 = 0.0007;

fn study() -> Study {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let path = root.join("examples/03_predict/nas979-on-xkas2525.toml");
    let (study, problems) = read_study(&disk(), &path);
    assert!(!problems.has_errors());
    Study { sampling: None, variants: Vec::new(), ..study.expect("the shipped study") }
}

fn task(seeds: std::ops::Range<u64>, point_u_mm: f64) -> PartStudy {
    let study = study();
    let part = |seed| PartPoints {
        name: format!("part {seed}"),
        points: cut_virtually(&study, (seed, true), U_POINT_MM).expect("a part").points,
    };
    let parts = seeds.map(part).collect();
    PartStudy {
        name: "drawn parts".to_owned(),
        path: "drawn.toml".into(),
        piece: study.test_piece.clone(),
        tolerances: study.tolerances.clone(),
        measured: Measurements::Points(Box::new(CmmPoints {
            parts,
            point_u_mm,
            datum_u_mm: 0.0,
            datum_tilt_u_rad: 0.0,
            best_fit: false,
            frame: "datum".to_owned(),
        })),
        prediction: PredictionSource::Study(Box::new(study)),
        rule: PartRule::DEFAULT,
    }
}

/// Parts of machines within the uncertainties of the machine file agree with the prediction about 19 times of 20;
/// parts of which the machine file says nothing do not.
#[test]
fn law_parts_of_this_machine_agree_and_others_do_not() {
    let (mut agree, mut all) = (0, 0);
    for seed in 100..118 {
        let found = verify_part(&task(seed..seed + 1, U_POINT_MM)).expect("evaluated");
        assert_eq!(found.outcome, Outcome::Pass);
        for index in found.indices.iter().filter(|i| i.name.decisive) {
            all += 1;
            agree += usize::from(index.agreement.expect("both").agrees());
        }
    }
    assert_eq!(all, 54);
    // 54 · 0.95 = 51; fewer than 46 come once in 500 times.
    assert!(agree >= 46, "{agree} of {all}");
    // The same part, and a prediction for a head out of square.
    let mut other = task(100..101, U_POINT_MM);
    let PredictionSource::Study(predicted) = &mut other.prediction else { panic!("a study") };
    let name = trueaxis::machine::errors::ErrorName::parse("EA0A").expect("a name");
    predicted.machine = predicted.machine.clone().with_location(name, -450e-6).expect("EA0A");
    let found = verify_part(&other).expect("evaluated");
    let differs =
        |i: &&trueaxis::verify::part::IndexComparison| !i.agreement.expect("both").agrees();
    assert!(found.indices.iter().filter(|i| i.name.decisive).any(|i| differs(&i)));
    // The part is good all the same: the verdict is about the part.
    assert_eq!(found.outcome, Outcome::Pass);
}

/// Order of rows and number of points do not matter beyond their noise; the noise of u = 0 adds nothing.
#[test]
fn law_order_of_rows_does_not_matter() {
    let values = |change: &dyn Fn(&mut Vec<trueaxis::part::testpiece::measured::MeasuredPoint>)| {
        let mut task = task(100..101, 0.0);
        let Measurements::Points(points) = &mut task.measured else { panic!("points") };
        change(&mut points.parts[0].points);
        let found = verify_part(&task).expect("evaluated");
        assert!(found.indices.iter().all(|i| i.noise_mm == 0.0));
        found.indices.iter().map(|i| i.measured[0].value_mm).collect::<Vec<_>>()
    };
    let as_is = values(&|_| ());
    for (a, b) in as_is.iter().zip(values(&|p| p.reverse())) {
        assert!((a - b).abs() < 1e-12);
    }
    for (a, b) in as_is.iter().zip(values(&|p| p.rotate_left(37))) {
        assert!((a - b).abs() < 1e-12);
    }
    // Every second azimuth: the forms of the same part, with less of the noise.
    let half = values(&|p| *p = p.chunks(8).flat_map(|c| c[..4].to_vec()).collect());
    for (a, b) in as_is.iter().zip(half) {
        assert!((a - b).abs() < 0.003, "{a} {b}");
    }
}
