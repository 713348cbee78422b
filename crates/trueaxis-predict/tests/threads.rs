//! Threads as cylinders of their outer diameter: cut by a tap, and by a thread mill.

use std::path::{Path, PathBuf};
use trueaxis_input::{Diagnostics, Files};
use trueaxis_predict::predict::drawing::{PartPrediction, predict_part, read_part_study};

const STUDY: &str = "name = \"s\"\nmachine = \"m.toml\"\npart = \"p.toml\"\nprogram = \"p.nc\"\n";
/// X of a place 30 mm up in Y is off by 3 µm.
const MACHINE: &str =
    "[machine]\nname = \"mill\"\nchain = \"w b X Y Z t\"\n[location]\nEC0Y = \"100 urad\"\n";
const SET_UP: &str = "control = \"fanuc\"\nworkpiece_at = \"G54\"\n[work_offset.G54]\nX = \"300 mm\"\nY = \"200 mm\"\nZ = \"-300 mm\"\n\
    [tool.1]\nname = \"drill 6.8\"\nlength = \"90 mm\"\ndiameter = \"6.8 mm\"\ncutter = { point = \"118 deg\" }\n\
    [tool.2]\nname = \"tap M8\"\nlength = \"90 mm\"\ndiameter = \"8 mm\"\n\
    [tool.3]\nname = \"thread mill\"\nlength = \"90 mm\"\ndiameter = \"6 mm\"\ncutter = { height = \"HEIGHT mm\" }\n";
const PART: &str = "name = \"p\"\n[feature.face]\nplane = { at = \"0 0 0 mm\", normal = \"0 0 1\", size = \"20 20 mm\" }\n\
    [feature.it]\nthread = { at = \"20 30 -1 mm\", axis = \"0 0 -1\", diameter = \"8 mm\", length = \"10 mm\" }\n\
    [[characteristic]]\nposition = \"20 um\"\nof = \"it\"\n[[characteristic]]\nperpendicularity = \"20 um\"\nof = \"it\"\ndatum = \"face\"\n";
/// The top as a facing cut leaves it, and the core hole.
const CORE: &str =
    "%\nO1\nG21 G17 G40 G80 G90 G94\nT3 M6\nG54 G0 X0. Y-20. S2000 M3\nG43 Z5. H3\nG1 Z0. F900\n";
const DRILL: &str = "T1 M6\nG0 X20. Y30.\nG43 Z5. H1\nG81 X20. Y30. Z-16. R2. F300\nG80\nG0 Z50.\n";

fn found(finish: &str, height_mm: f64, part: &str) -> Result<PartPrediction, Vec<&'static str>> {
    let facing: String = (0..12)
        .map(|k| {
            let y = f64::from(k).mul_add(2.0, -11.0);
            format!(
                "G1 X{}. Y{y}\nX{}.\n",
                if k % 2 == 0 { -14 } else { 14 },
                if k % 2 == 0 { 14 } else { -14 }
            )
        })
        .collect();
    let program = format!("{CORE}{facing}G0 Z50.\n{DRILL}{finish}\nM30\n%\n");
    let set_up = SET_UP.replace("HEIGHT", &height_mm.to_string());
    let texts = [
        ("s.toml", STUDY.to_owned()),
        ("m.toml", MACHINE.to_owned()),
        ("p.toml", part.to_owned()),
        ("p.nc", program),
        ("p.setup.toml", set_up),
    ];
    let files = Files::none().with_texts(texts.map(|(name, text)| (PathBuf::from(name), text)));
    let (study, problems) = read_part_study(&files, Path::new("s.toml"));
    let study = study.unwrap_or_else(|| panic!("{problems:?}"));
    let mut problems = Diagnostics::new();
    let found = predict_part(&study, &|_| {}, &mut problems);
    found.ok_or_else(|| problems.iter().map(|p| p.code).collect())
}

const TAP: &str =
    "T2 M6\nG0 X20. Y30. S200 M3\nG43 Z5. H2\nG84 X20. Y30. Z-14. R2. F250\nG80\nG0 Z50.";

/// One turn of 1.25 mm after the other, up from −14.
fn milled() -> String {
    let turns: String = (0..12)
        .map(|k| format!("G3 X21. Y30. Z{} I-1. J0.\n", -14.0 + 1.25 * f64::from(k + 1)))
        .collect();
    format!("T3 M6\nG0 X20. Y30.\nG43 Z5. H3\nG1 Z-14. F300\nG1 X21.\n{turns}G1 X20.\nG0 Z50.")
}

/// 3 µm beside its place is 6 µm of position, however the thread is cut, and as the core hole alone.
#[test]
fn law_a_thread_is_where_its_hole_is() {
    let core =
        PART.replace("thread =", "hole =").replace("diameter = \"8 mm\"", "diameter = \"6.8 mm\"");
    let ways = [(TAP.to_owned(), PART), (milled(), PART), (String::new(), core.as_str())];
    for (finish, part) in ways {
        let found = found(&finish, 4.0, part).unwrap_or_else(|p| panic!("{p:?}"));
        let position = found.values[0].value_mm;
        assert!((position - 6e-3).abs() < 2e-5, "{finish}: {position}");
        assert!(found.values[1].value_mm.abs() < 2e-5);
    }
}

/// A cutter that is lower than the pitch leaves material between its turns, and no cutter leaves all of it: named, never good.
#[test]
fn a_thread_that_is_not_cut_is_named() {
    for (finish, height) in [(milled(), 0.8), (String::new(), 4.0)] {
        let codes = found(&finish, height, PART).expect_err("not cut");
        assert!(codes.contains(&"not-cut"), "{codes:?}");
    }
}
