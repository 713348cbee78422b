//! A part with every shape and every kind of characteristic.

use std::path::{Path, PathBuf};
use trueaxis_input::{Files, SourceText};
use trueaxis_part::part::Part;
use trueaxis_part::qif::results::Found;
use trueaxis_part::tolerance::Outcome;

const HOUSING: &str = include_str!("../../../../parts/housing.toml");

const SHAPES: &str = r#"
name = "every"
source = "invented for this test"
[feature.base]
datum = "A"
plane = { at = "0 0 0 mm", normal = "0 0 -1", along = "1 0 0", size = "100 60 mm" }
[feature.front]
datum = "B"
plane = { at = "0 -30 10 mm", normal = "0 -1 0", along = "1 0 0", size = "90 20 mm" }
[feature.left]
datum = "C"
plane = { at = "-50 0 10 mm", normal = "-1 0 0", along = "0 1 0", size = "50 20 mm" }
[feature.wedge]
plane = { at = "3 1 20 mm", normal = "0 0.6 0.8", along = "1 0 0", size = "12.5 8 mm" }
[feature.shaft]
datum = "D"
cylinder = { at = "10 5 20 mm", axis = "0 0 1", diameter = "20 mm", length = "30 mm" }
[feature.collar]
cylinder = { at = "10 5 50 mm", axis = "0 0 1", diameter = "12.7 mm", length = "8 mm" }
[feature.journal]
cylinder = { at = "10 5 70 mm", axis = "0 0 1", diameter = "9 mm", length = "6 mm" }
[feature.shoulder]
plane = { at = "10 5 50 mm", normal = "0 0 1", along = "0 1 0", size = "20 20 mm" }
[feature.bore]
hole = { at = "-20 5 20 mm", axis = "0 0 -1", diameter = "8 mm", length = "12 mm" }
[feature.taper]
cone = { at = "10 5 60 mm", axis = "0 0 1", diameters = "10 16 mm", length = "9 mm" }
[feature.sink]
conical_hole = { at = "-20 5 20 mm", axis = "0 0 -1", diameters = "14 8 mm", length = "3 mm" }
[feature.tip]
cone = { at = "30 5 60 mm", axis = "0 0 -1", diameters = "0 6 mm", length = "5 mm" }
[feature.ball]
sphere = { at = "40 5 30 mm", axis = "0 0 1", diameter = "10 mm", opening = "100 deg" }
[feature.socket]
hollow_sphere = { at = "40 15 20 mm", axis = "0 0.6 0.8", diameter = "6 mm", opening = "60 deg" }
[feature.rim]
torus = { at = "10 5 20 mm", axis = "0 0 1", ring = "30 mm", diameter = "4 mm", section = ["-90 deg", "90 deg"] }
[feature.fillet]
hollow_torus = { at = "10 5 22 mm", axis = "0 0 1", ring = "24 mm", diameter = "4 mm", section = ["180 deg", "270 deg"] }
[feature.slot]
slot = { at = "0 0 15 mm", across = "0 1 0", along = "1 0 0", width = "12 mm", size = "40 10 mm" }
[feature.outside]
datum = "E"
tongue = { at = "0 0 15 mm", across = "0 1 0", along = "1 0 0", width = "60 mm", size = "100 30 mm" }
[feature.table]
points = "table.csv"
[feature.blade]
programmed = { at = "0 0 80 mm", normal = "0 0 1", along = "1 0 0", size = "40 20 mm", depth = "5 mm" }
[feature.bolts]
hole = { at = "40 0 0 mm", axis = "0 0 1", diameter = "5 mm", length = "10 mm" }
repeat = { count = 4, about = "0 0 0 mm", axis = "0 0 1" }
"#;

const TABLE: &str = "x_mm,y_mm,z_mm,nx,ny,nz\n1,2,3,0,0,1\n4,5,6.25,0,0.6,0.8\n";

/// Kind, tolerance, feature, datums.
const ASKED: [[&str; 4]; 44] = [
    ["flatness", "10 um", "base", ""],
    ["straightness", "7 um", "shaft", ""],
    ["roundness", "5 um", "taper", ""],
    ["roundness", "5 um", "sink", ""],
    ["roundness", "5 um", "tip", ""],
    ["cylindricity", "6 um", "bore", ""],
    ["diameter", "-10 um|25 um", "bore", ""],
    ["diameter", "0 um|8 um", "shaft", ""],
    ["width", "-5 um|30 um", "slot", ""],
    ["width", "-20 um|20 um", "outside", ""],
    ["profile", "40 um", "ball", "A|B|C"],
    ["profile", "40 um", "socket", "A|B|C"],
    ["profile", "41 um", "rim", ""],
    ["profile", "42 um", "fillet", "A|B|C"],
    ["profile", "43 um", "table", ""],
    ["profile", "44 um", "blade", ""],
    ["profile", "45 um", "wedge", "A|B|C"],
    ["angularity", "15 um", "wedge", "A|B"],
    ["parallelism", "16 um", "shoulder", "A"],
    ["parallelism", "17 um", "bore", "D"],
    ["parallelism", "18 um", "slot", "B"],
    ["perpendicularity", "11 um", "front", "A"],
    ["perpendicularity", "12 um", "shaft", "A"],
    ["perpendicularity", "13 um", "shoulder", "collar"],
    ["perpendicularity", "14 um", "bore", "A|B"],
    ["position", "50 um", "bore", "A|B|C"],
    ["position", "51 um", "slot", "A|B|C"],
    ["position", "52 um", "bolts", "A"],
    ["position", "53 um", "shoulder", "A|B|C"],
    ["symmetry", "54 um", "slot", "E"],
    ["coaxiality", "21 um", "collar", "D"],
    ["circular_run_out", "22 um", "collar", "D"],
    ["total_run_out", "23 um", "shoulder", "D"],
    ["perpendicularity", "24 um", "bolts", "A"],
    ["coaxiality", "25 um", "journal", "D-collar"],
    ["position", "26 um", "bore", "A|D-collar|B"],
    ["perpendicularity", "27 um", "shoulder", "collar-D"],
    ["line_straightness", "28 um", "shaft", ""],
    ["line_straightness", "29 um", "base", ""],
    ["line_profile", "30 um", "taper", "A"],
    ["line_profile", "31 um", "front", ""],
    ["position", "32 um, 25 mm", "bore", "A|B|C"],
    ["position", "33 um, -12.5 mm", "bore", ""],
    ["perpendicularity", "34 um, 25 mm", "bolts", "A"],
];

pub fn part(text: &str) -> Part {
    let files = Files::none().with_texts([(PathBuf::from("table.csv"), TABLE.to_owned())]);
    let source = SourceText::from(&files, "part.toml", text);
    let part = source.read(|root| Part::read(root, Path::new("")));
    let problems = source.finish();
    part.unwrap_or_else(|| panic!("{:?}", problems.iter().map(|p| &p.message).collect::<Vec<_>>()))
}

pub fn housing() -> Part {
    part(HOUSING)
}

pub fn every() -> Part {
    let mut text = SHAPES.to_owned();
    for (number, [kind, tolerance, of, datum]) in ASKED.iter().enumerate() {
        let (tolerance, projected) = tolerance.split_once(", ").unwrap_or((tolerance, ""));
        let limits = match tolerance.split_once('|') {
            Some((low, high)) => format!("[\"{low}\", \"{high}\"]"),
            None => format!("\"{tolerance}\""),
        };
        text += &format!("[[characteristic]]\nname = \"no {number}\"\n{kind} = {limits}\n");
        text += &format!("of = \"{of}\"\n");
        if !projected.is_empty() {
            text += &format!("projected = \"{projected}\"\n");
        }
        if !datum.is_empty() {
            text += &format!("datum = \"{datum}\"\n");
        }
    }
    part(&text)
}

/// Names with all that XML, CSV and spreadsheets have a meaning for.
pub fn odd() -> Part {
    part(
        r#"
name = "Gehäuse \"1\" <&>\n'Ω' ]]>"
source = "a & b <c>"
[feature."a<b & \"c\" 'd'"]
datum = "Ä<\""
plane = { at = "0 0 0 mm", normal = "0 0 1", along = "1 0 0", size = "10 10 mm" }
[feature."Bohrung ü,\n2"]
hole = { at = "0 0 0 mm", axis = "0 0 -1", diameter = "5 mm", length = "10 mm" }
[feature."É"]
datum = "Ö<\""
plane = { at = "0 0 -20 mm", normal = "0 0 -1", along = "1 0 0", size = "10 10 mm" }
[[characteristic]]
name = "=HYPERLINK(\"a\",\"b\")\r\n<!-- -->"
flatness = "10 um"
of = "a<b & \"c\" 'd'"
[[characteristic]]
name = "@\u0000\u0007]]>&amp;"
perpendicularity = "10 um"
of = "Bohrung ü,\n2"
datum = ["Ä<\""]
[[characteristic]]
parallelism = "10 um"
of = "É"
datum = ["Ä<\""]
[[characteristic]]
parallelism = "10 um"
of = "a<b & \"c\" 'd'"
datum = ["É"]
"#,
    )
}

/// Values of many digits and each verdict, without a pattern.
pub fn found(part: &Part) -> Vec<Found> {
    let one = |i: usize| {
        let outcome = [Outcome::Pass, Outcome::Fail, Outcome::Undecided][i % 3];
        let value_mm = 0.001 * (1.0 + i as f64).sqrt() * if i % 4 == 2 { -1.0 } else { 1.0 };
        Found { value_mm, u_mm: 1e-4 / (3.0 + i as f64), outcome }
    };
    (0..part.characteristics.len()).map(one).collect()
}
