//! Studies of holes as users spoil them.

use std::path::{Path, PathBuf};
use trueaxis_input::Files;
use trueaxis_predict::predict::holes::read_hole_study;

const STUDY: &str = "name = \"h\"\nmachine = \"m.toml\"\n[holes]\ncount = 4\ncircle = \"400 mm\"\ncentre = \"0 0 0 mm\"\n\
                     tolerance = \"0.02 mm\"\nlocation_diameter_tolerance = \"0.046 mm\"\n";

/// Whether the study is read, and the codes of what is reported.
fn read(from: &str, to: &str) -> (bool, Vec<&'static str>) {
    assert!(STUDY.contains(from), "{from}");
    let texts = [
        ("m.toml", "[machine]\nname = \"m\"\nchain = \"w X' Y' b Z t\"\n".to_owned()),
        ("s.toml", STUDY.replace(from, to)),
    ];
    let files = Files::none().with_texts(texts.map(|(name, text)| (PathBuf::from(name), text)));
    let (study, problems) = read_hole_study(&files, Path::new("s.toml"));
    (study.is_some(), problems.iter().map(|d| d.code).collect())
}

/// All holes in one place have no location diameter: its tolerance was dropped, and the verdict spoke of it.
#[test]
fn a_circle_without_a_diameter_is_refused() {
    assert_eq!(read("400 mm", "400 mm"), (true, vec![]));
    for none in ["0 mm", "-400 mm"] {
        assert_eq!(read("400 mm", none), (false, vec!["not-positive"]), "{none}");
    }
}

/// A tolerance of metres for micrometres is always held.
#[test]
fn tolerances_of_holes_have_a_plausible_size() {
    for tolerance in ["0.02 mm", "0.046 mm"] {
        assert_eq!(read(tolerance, "20 m"), (false, vec!["impossible-value"]), "{tolerance}");
        assert_eq!(read(tolerance, "3 mm"), (true, vec!["implausible-value"]), "{tolerance}");
    }
}
