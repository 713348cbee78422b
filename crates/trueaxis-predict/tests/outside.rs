//! Programs of others as studies of parts; skipped with a message where they are not there.

#![allow(clippy::print_stdout, reason = "a test that is skipped says so")]

use std::path::{Path, PathBuf};
use trueaxis_geometry::Vec3;
use trueaxis_input::Files;
use trueaxis_predict::predict::drawing::{PartPrediction, predict_part, read_part_study};

const BOATS: &str = "../../../shared/data/outside/nc/LinuxCNC__linuxcnc";

fn boat(of: &str) -> Option<String> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(BOATS).join(format!("boat-xyz{of}.ngc"));
    let text = std::fs::read_to_string(&path).ok();
    if text.is_none() {
        println!("skipped: the boats of LinuxCNC are not available");
    }
    text
}

/// The hull of a boat as a program cuts it on a table A C or B C with these errors.
fn hull(of: &str, errors: &str) -> Option<PartPrediction> {
    let tilt = if of == "ac" { "A" } else { "B" };
    // One program switches no tool length on: its tool has none.
    let length = if of == "ac" { "0.001 mm" } else { "100 mm" };
    let texts = [
        ("s.toml", "name = \"s\"\nmachine = \"m.toml\"\npart = \"p.toml\"\nprogram = \"p.ngc\"\n[setting]\nperfect = true\n".to_owned()),
        (
            "m.toml",
            format!(
                "[machine]\nname = \"table\"\nchain = \"w C' {tilt}' b X Y Z t\"\n[axis.C]\nsense = 1\ntravel = \"unlimited\"\n[axis.{tilt}]\nsense = 1\n[location]\n{errors}\n"
            ),
        ),
        (
            "p.toml",
            "name = \"boat\"\n[feature.hull]\nprogrammed = { at = \"0 0 5 mm\", normal = \"0 0 1\", along = \"1 0 0\", size = \"60 20 mm\", depth = \"20 mm\" }\n\
             spacing = \"1 mm\"\n[[characteristic]]\nprofile = \"50 um\"\nof = \"hull\"\n"
                .to_owned(),
        ),
        (
            "p.setup.toml",
            format!(
                "control = \"linuxcnc\"\nworkpiece_at = \"G54\"\n[work_offset.G54]\nX = \"0 mm\"\nY = \"0 mm\"\nZ = \"0 mm\"\n\
                 [tool.1]\nname = \"end mill 10\"\nlength = \"{length}\"\ndiameter = \"10 mm\"\n"
            ),
        ),
        ("p.ngc", boat(of)?),
    ];
    let files = Files::none().with_texts(texts.map(|(name, text)| (PathBuf::from(name), text)));
    let (study, mut problems) = read_part_study(&files, Path::new("s.toml"));
    let study = study.unwrap_or_else(|| panic!("{problems:?}"));
    let found = predict_part(&study, &|_| {}, &mut problems);
    Some(found.unwrap_or_else(|| panic!("{problems:?}")))
}

fn at(found: &PartPrediction, place: &Vec3) -> Option<Vec3> {
    let points = found.part.features[0].points.iter().map(|p| p.point_mm);
    points.into_iter().find(|p| (p.xy() - place.xy()).norm() < 1e-6)
}

/// Two programs for two tables, A C and B C, made by others from one model: where both cut the hull they leave the same surface.
#[test]
fn oracle_the_boats_of_linuxcnc_are_one_boat() {
    let (Some(ac), Some(bc)) = (hull("ac", ""), hull("bc", "")) else { return };
    let points = &ac.part.features[0].points;
    // The tool that has no length was stated 1 µm long.
    let off = points.iter().filter_map(|p| Some(at(&bc, &p.point_mm)?.z - p.point_mm.z - 1e-3));
    let mut off: Vec<f64> = off.map(f64::abs).collect();
    off.sort_by(f64::total_cmp);
    let share = |part: usize| 1e3 * off[off.len() * part / 100];
    println!(
        "{} points on both: {:.3} µm at most on 50 %, {:.3} on 90 %, {:.3} on 95 %",
        off.len(),
        share(50),
        share(90),
        share(95)
    );
    assert!(off.len() > 850, "{}", off.len());
    assert!(share(50) < 0.02 && share(90) < 0.1, "{} {}", share(50), share(90));
}

/// A workpiece that stands 20 µm too high is cut too deep by 20 µm along Z, whatever the table and wherever it is turned.
#[test]
fn law_a_workpiece_that_stands_too_high() {
    for of in ["ac", "bc"] {
        let Some(found) = hull(of, "EZ0w = \"20 um\"") else { return };
        let points = &found.features[0].points;
        let due = |normal: &Vec3| -0.02 * normal.z;
        // Where two blocks meet, another one comes first.
        let near = points.iter().filter(|p| (p.deviation_mm - due(&p.normal)).abs() < 1e-5);
        let (near, all) = (near.count(), points.len());
        println!("{of}: {near} of {all} points");
        assert!(near as f64 > 0.97 * all as f64, "{of}: {near} of {all}");
        assert!(points.iter().all(|p| (p.deviation_mm - due(&p.normal)).abs() < 2e-3));
    }
}
