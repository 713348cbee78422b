//! Laws of the prediction: judged by mathematics.

mod library;

use library::root;
use trueaxis::files::disk;
use trueaxis::machine::Machine;
use trueaxis::machine::errors::ErrorValues;
use trueaxis::machine::file::NoTables;
use trueaxis::predict::{
    Cutting, DatumAxis, Judge, Reference, Sampling, Setting, Study, corrections, monte_carlo,
    predict, propagate, read_study, sensitivities,
};

fn study() -> Study {
    let path = root().join("examples/03_predict/nas979-on-xkas2525.toml");
    let (study, problems) = read_study(&disk(), &path);
    assert!(!problems.has_errors());
    let mut study = study.expect("a study");
    study.sampling = None;
    study
}

/// Asks one question to a freshly prepared cut.
fn with_judge<T>(study: &Study, reference: &Reference, ask: impl FnOnce(&Judge<'_>) -> T) -> T {
    let cutting = Cutting::new(&study.machine, study.piece(), reference).expect("reachable");
    ask(&Judge { cutting: &cutting, piece: study.piece() })
}

#[test]
fn law_no_errors_make_a_perfect_part() {
    let study = study();
    for depth in [None, Some(40.0)] {
        let datum =
            depth.map_or(DatumAxis::Ideal, |depth_mm| DatumAxis::ReferenceHole { depth_mm });
        let reference = Reference { datum, ..Reference::default() };
        let indices = with_judge(&study, &reference, |judge| {
            judge.once(&|_, _| ErrorValues::default()).expect("indices")
        });
        assert!(indices.iter().all(|v| v.abs() < 1e-12), "{indices:?}");
    }
}

/// Where the workpiece stands on the table without turning, the zero is touched there: only
/// rotations of its mounting can be felt.
#[test]
fn law_a_shifted_mounting_drops_out() {
    let study = study();
    let before = predict(&study, &|_| {}).expect("a prediction");
    for share in &before.budget.errors {
        let name = share.of.to_string();
        // p1e and the errors of r_p drop out exactly (errata 000-17).
        if ["EX0w", "EY0w", "EZ0w", "EX0X", "EY0X", "EZ0X"].contains(&name.as_str()) {
            let alone = share.alone_mm.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
            assert!(alone < 1e-10, "{name} alone makes {alone:e} mm");
        }
    }
}

/// p5e and p6e do not drop out: they are of the size of the error itself (errata 000-17).
#[test]
fn law_offsets_behind_the_rotary_axes_do_not_drop_out() {
    let study = study();
    let prediction = predict(&study, &|_| {}).expect("a prediction");
    let coaxiality = prediction.indices.iter().position(|i| i.name.key == "coaxiality_lsc_mm");
    for name in ["EY0A", "EX0t", "EY0t"] {
        let share = prediction.budget.errors.iter().find(|s| s.of.to_string() == name);
        let alone = share.expect("a stated error").alone_mm[coaxiality.expect("an index")];
        assert!(alone > 0.02, "{name} alone makes {alone} mm");
    }
}

#[test]
fn law_without_setting_error_the_roundness_stays() {
    // A constant vector moves a section without changing its form, to second order.
    let study = study();
    let perfect = Reference { setting: Setting::Perfect, ..Reference::default() };
    let [touched, perfect] = [&study.reference, &perfect].map(|reference| {
        with_judge(&study, reference, |judge| judge.once(&|e, _| *e).expect("indices"))
    });
    let names = study.piece().index_names();
    for (i, name) in names.iter().enumerate() {
        match name.key {
            "roundness_lsc_mm" | "roundness_mzc_mm" | "angularity_zone_mm" => {
                assert!((touched[i] - perfect[i]).abs() < 5e-5, "{}", name.key);
            }
            "coaxiality_lsc_mm" => assert!((touched[i] - perfect[i]).abs() > 1e-2),
            _ => {}
        }
    }
}

#[test]
fn law_the_same_seed_gives_the_same_bits_at_any_thread_count() {
    let study = study();
    let sampling = Sampling { samples: 1500, seed: 42 };
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        pool.install(|| {
            with_judge(&study, &study.reference, |judge| {
                monte_carlo(&study.machine, judge, sampling, &|_| {}).expect("a run")
            })
        })
    };
    let bits = |spreads: Vec<trueaxis::predict::Spread>| -> Vec<u64> {
        let numbers = spreads.iter().flat_map(|s| [s.mean_mm, s.u_mm, s.low_mm, s.high_mm]);
        numbers.map(f64::to_bits).collect()
    };
    let one = bits(run(1));
    assert_eq!(one, bits(run(2)));
    assert_eq!(one, bits(run(5)));
    let other = Sampling { samples: 1500, seed: 43 };
    let other = with_judge(&study, &study.reference, |judge| {
        monte_carlo(&study.machine, judge, other, &|_| {}).expect("a run")
    });
    assert_ne!(one, bits(other));
}

/// The sensitivity times a small change is the change of the index.
#[test]
fn law_sensitivities_predict_small_changes() {
    let study = study();
    with_judge(&study, &study.reference, |judge| {
        let before = judge.once(&|e, _| *e).expect("indices");
        let all = sensitivities(&study.machine, judge).expect("sensitivities");
        let ea0a = all.iter().find(|s| s.error.to_string() == "EA0A").expect("EA0A");
        let (index, _) = study
            .machine
            .stated_errors()
            .into_iter()
            .find(|(_, name)| *name == ea0a.error)
            .expect("stated");
        let after = judge.once(&|e, _| {
            let mut changed = *e;
            changed.set(index, e.get(index) + 0.2e-6);
            changed
        });
        for ((b, a), slope) in before.iter().zip(after.expect("indices")).zip(&ea0a.slope) {
            assert!((a - b - slope * 0.2e-6).abs() < 2e-7, "{b} {a} {slope}");
        }
    });
}

/// Twice the uncertainties, twice the result; no stated errors, nothing to propagate.
#[test]
fn law_propagation_is_linear_in_the_uncertainties() {
    let study = study();
    with_judge(&study, &study.reference, |judge| {
        let scaled = |factor: f64| {
            propagate(&study.machine, &move |change| {
                judge.once(&|e, u| {
                    // The change that was asked for, `factor` times as far from the mean.
                    let drawn = change(e, u);
                    let mut further = *e;
                    for index in trueaxis::machine::errors::ErrorIndex::all() {
                        let step = drawn.get(index) - e.get(index);
                        further.set(index, e.get(index) + factor * step);
                    }
                    further
                })
            })
        };
        let (one, half) = (scaled(1.0).expect("u"), scaled(0.5).expect("u"));
        for (i, name) in study.piece().index_names().iter().enumerate() {
            // Kinks of zone widths bend the line a little.
            assert!((half[i] / one[i] - 0.5).abs() < 0.01, "{}", name.key);
        }
    });
}

#[test]
fn law_a_correction_makes_the_part_pass_and_is_the_smallest() {
    let study = study();
    with_judge(&study, &study.reference, |judge| {
        // A coaxiality of 40 µm, which the part does not keep.
        let names = study.piece().index_names();
        let at = names.iter().position(|n| n.key == "coaxiality_lsc_mm").expect("an index");
        let passes = |indices: &[f64]| indices[at] <= 0.040;
        assert!(!passes(&judge.once(&|e, _| *e).expect("indices")));
        let found = corrections(&study.machine, judge, &passes).expect("corrections");
        assert!(found.len() >= 3);
        assert!(found.windows(2).all(|w| w[0].effort() <= w[1].effort()));
        for correction in &found {
            assert!(passes(&correction.indices_mm), "{}", correction.error);
            let (index, _) = study
                .machine
                .stated_errors()
                .into_iter()
                .find(|(_, name)| *name == correction.error)
                .expect("all are stated on this machine");
            let short = judge.once(&|e, _| {
                let mut changed = *e;
                changed.set(index, e.get(index) + 0.99 * correction.change);
                changed
            });
            assert!(!passes(&short.expect("indices")), "{} is not minimal", correction.error);
        }
    });
}

/// A tool that is off by a constant vector cuts a perfect part if its zero was touched with it.
#[test]
fn law_the_setting_error_is_taken_off_once() {
    let text = "[machine]\nname = \"plain\"\nchain = \"w b X Y Z t\"\nsource = \"test\"\n\
                [tool]\nlength = \"100 mm\"\n[location]\nEX0t = \"50 um\"";
    let (machine, problems) = Machine::check("plain.toml", text, &NoTables);
    assert!(!problems.has_errors());
    let piece = "name = \"cylinder\"\n[cone]\nhalf_angle = \"0 deg\"\nbase_diameter = \"100 mm\"\n\
                 height = \"40 mm\"\nsections = [\"0 mm\", \"20 mm\", \"40 mm\"]\n\
                 roundness_at = \"20 mm\"\n[tool]\ndiameter = \"20 mm\"\n\
                 [tolerance]\nroundness_mzc = \"0.01 mm\"";
    let source = trueaxis::input::SourceText::new("cylinder.toml", piece);
    let piece = source.read(trueaxis::part::TestPieceFile::read).expect("a cylinder");
    let machine = machine.expect("a machine");
    let indices = |setting: Setting| {
        let reference = Reference { setting, ..Reference::default() };
        let cutting = Cutting::new(&machine, piece.piece(), &reference).expect("reachable");
        Judge { cutting: &cutting, piece: piece.piece() }.once(&|e, _| *e).expect("indices")
    };
    let keys: Vec<&str> = piece.piece().index_names().iter().map(|n| n.key).collect();
    let coaxiality = keys.iter().position(|k| *k == "coaxiality_lsc_mm").expect("an index");
    // The tool is off by 50 µm everywhere, also where the zero was touched: nothing remains.
    assert!(indices(Setting::default()).iter().all(|v| v.abs() < 1e-9));
    // Against a perfect zero the cylinder stands 50 µm beside its axis: coaxiality 100 µm. The
    // points lie on a limaçon, whose least-squares centre differs by e³/R² = 5e-8 mm.
    let off = indices(Setting::Perfect)[coaxiality] - 0.100;
    assert!(off.abs() < 1e-7, "{off:e} mm");
}

/// A mounting that is tilted by ε moves the cut as a rigid body about the set zero:
/// E = n_f · (ε × P) = ε sin φ (35 cos α + R sin α) on the section at z = −35 mm, so that its centre
/// seems 35 mm + R tan α = 66.7 mm times ε beside the ideal axis. A hole that the same machine
/// bored is tilted with it, and against the hole nothing remains.
#[test]
fn law_a_bored_hole_takes_off_what_moves_the_whole_part() {
    let study = study();
    let (index, _) = study
        .machine
        .stated_errors()
        .into_iter()
        .find(|(_, name)| name.to_string() == "EA0w")
        .expect("EA0w is stated");
    let tilted = |datum: DatumAxis| {
        let reference = Reference { datum, ..Reference::default() };
        with_judge(&study, &reference, |judge| {
            let only = judge.once(&|_, _| {
                let mut errors = ErrorValues::default();
                errors.set(index, 100e-6);
                errors
            });
            only.expect("indices")
        })
    };
    let names = study.piece().index_names();
    let coaxiality = names.iter().position(|n| n.key == "coaxiality_lsc_mm").expect("an index");
    let ideal = tilted(DatumAxis::Ideal)[coaxiality];
    // The mounting error tilts the fixture, which stands 10° inclined: EA0w about the machine's X
    // has the component cos 10° across the cone axis.
    let radius = 125.0 - 25.0 * 15_f64.to_radians().tan();
    let lever = 35.0 + radius * 15_f64.to_radians().tan();
    let by_hand = 2.0 * 100e-6 * lever * 10_f64.to_radians().cos();
    assert!((ideal - by_hand).abs() < 1e-6, "{ideal} {by_hand}");
    let hole = tilted(DatumAxis::ReferenceHole { depth_mm: 40.0 })[coaxiality];
    assert!(hole < 1e-6, "{hole:e} mm");
}
