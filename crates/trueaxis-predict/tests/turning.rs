//! Moves in which the workpiece or the tool turns while it cuts: the surface does not depend on how the move is written.

use std::path::{Path, PathBuf};
use trueaxis_input::Files;
use trueaxis_predict::predict::drawing::{PartPrediction, predict_part, read_part_study};

const STUDY: &str = "name = \"s\"\nmachine = \"m.toml\"\npart = \"p.toml\"\nprogram = \"p.nc\"\n[setting]\nperfect = true\n";
const MACHINE: &str = "[machine]\nname = \"mill with a rotary table\"\nchain = \"w C b X Y Z t\"\n";
const SET_UP: &str = "control = \"fanuc\"\nworkpiece_at = \"G54\"\n[work_offset.G54]\nX = \"0 mm\"\nY = \"0 mm\"\nZ = \"-300 mm\"\n\
    [tool.1]\nname = \"end mill 12\"\nlength = \"90 mm\"\ndiameter = \"12 mm\"\n";
const SHAFT: &str = "name = \"p\"\n[feature.shaft]\ncylinder = { at = \"0 0 -14 mm\", axis = \"0 0 1\", diameter = \"400 mm\", length = \"12 mm\" }\nspacing = \"3 mm\"\n\
    [[characteristic]]\nroundness = \"10 um\"\nof = \"shaft\"\n[[characteristic]]\ndiameter = \"10 um\"\nof = \"shaft\"\n";

fn predicted(texts: &[(&str, &str)]) -> PartPrediction {
    let all = [("s.toml", STUDY), ("m.toml", MACHINE), ("p.toml", SHAFT), ("p.setup.toml", SET_UP)];
    let all = all.iter().chain(texts).map(|(name, text)| (PathBuf::from(name), (*text).to_owned()));
    let files = Files::none().with_texts(all);
    let (study, mut problems) = read_part_study(&files, Path::new("s.toml"));
    let study = study.unwrap_or_else(|| panic!("{problems:?}"));
    let found = predict_part(&study, &|_| {}, &mut problems);
    found.unwrap_or_else(|| panic!("{problems:?}"))
}

fn program(moves: &str) -> String {
    format!(
        "%\nO1\nG21 G17 G40 G80 G90 G94\nT1 M6\nG54 G0 X230. Y0. C0. S8000 M3\nG43 Z5. H1\nG1 Z-16. F900\nX206.\n{moves}\nG1 X230.\nG0 Z50.\nM30\n%\n"
    )
}

#[test]
fn law_a_shaft_milled_by_turning_the_table_is_round() {
    let many = format!("G1 C{}.", 360 * 400);
    let ways = ["G1 C360. F5000", "G1 C90.\nC180.\nC270.\nC360.", "G1 C-180.\nC-360.", &many];
    for moves in ways {
        let found = predicted(&[("p.nc", &program(moves))]);
        for value in &found.values {
            // Of 400 turns in one block the pieces are limited.
            let most_mm = if moves == many { 2e-3 } else { 1e-4 };
            assert!(value.value_mm.abs() < most_mm, "{moves}: {} mm", value.value_mm);
        }
    }
}

/// A flank cut while both rotary axes turn, in one block and in several.
#[test]
fn law_a_flank_does_not_depend_on_the_number_of_blocks() {
    let machine = MACHINE.replace("w C b", "w C A b");
    let part = "name = \"p\"\n[feature.flank]\nplane = { at = \"60 0 -10 mm\", normal = \"1 0 0\", along = \"0 1 0\", size = \"70 16 mm\" }\n\
        spacing = \"2 mm\"\nbelow = \"25 mm\"\nabove = \"25 mm\"\n[[characteristic]]\nprofile = \"9 mm\"\nof = \"flank\"\n";
    let value = |blocks: u32| {
        let at = |k: u32| {
            let u = f64::from(k) / f64::from(blocks);
            format!(
                "G1 X{:.9} Y{:.9} Z{:.9} A{:.9} C{:.9}\n",
                66.0 + 2.0 * u,
                90.0 * u - 45.0,
                -22.0 + u,
                4.0 + 8.0 * u,
                -12.0 + 30.0 * u
            )
        };
        let moves: String = (0..=blocks).map(at).collect();
        let program = format!(
            "%\nO1\nG21 G17 G40 G80 G90 G94\nT1 M6\nG54 G0 X100. Y-45. A4. C-12. S8000 M3\nG43.4 Z60. H1\nG1 X66. Y-45. Z-22. F900\n{moves}G49 G0 Z50.\nM30\n%\n"
        );
        let found = predicted(&[("m.toml", &machine), ("p.toml", part), ("p.nc", &program)]);
        found.values[0].value_mm
    };
    let whole = value(1);
    assert!(whole > 1.0, "the flank winds: {whole} mm");
    for blocks in [2, 7, 60, 300] {
        let found = value(blocks);
        assert!((found - whole).abs() < 1e-4, "{blocks} blocks: {found} mm, in one {whole} mm");
    }
}
