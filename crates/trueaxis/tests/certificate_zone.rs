//! The prediction of a certificate for its zone: from every side from which the axes can come.

use std::fmt::Write;
use std::path::{Path, PathBuf};
use trueaxis::input::Files;
use trueaxis::verify::certificate::{Certificate, certify, read_certificate};

const MACHINE: &str = "[machine]\nname = \"c\"\nchain = \"w X' b Y Z t\"\n[axis.X]\n\
    travel = [\"0 mm\", \"500 mm\"]\n[axis.Y]\ntravel = [\"0 mm\", \"400 mm\"]\n[axis.Z]\n\
    travel = [\"-300 mm\", \"0 mm\"]\n[tool]\nlength = \"100 mm\"\n[location]\nEC0Y = \"50 ± 1 urad\"\n[motion.X]\n\
    EXX = { polynomial = [\"0 um\", \"20 um\"], scale = \"500 mm\", reversal = \"8 um\", u = \"0.3 um\" }\n\
    EYX = { polynomial = [\"0 um\", \"10 um\"], scale = \"500 mm\", reversal = \"9 um\", u = \"0.3 um\" }\n[motion.Y]\n\
    EYY = { polynomial = [\"0 um\", \"-20 um\"], scale = \"400 mm\", reversal = \"-6 um\", u = \"0.3 um\" }\n";

const BY: &str = "method = \"x\"\ndate = 2026-03-02\nby = \"x\"\n";
const WITH: &str = "instrument = \"x\"\ncalibration = \"x\"\ntemperature = \"20.3 ± 0.2 degC\"\n";

fn certificate(zero: &str) -> Certificate {
    let study = format!(
        "name = \"c\"\nmachine = \"m.toml\"\n[determination]\n{BY}{WITH}\
         used = [ {{ table = \"used.csv\", axis = \"X\", at = \"Y=200 Z=-150\" }} ]\n\
         [compensation]\nkind = \"tables\"\ntarget = \"isg\"\n{BY}[validation]\n{BY}{WITH}{zero}\
         before = \"read.csv\"\nafter = \"read.csv\"\nu = \"0.5 um\"\n[decision]\nlimit = \"12 um\"\n\
         rule = \"ISO 14253-1\"\ncoverage_factor = 2\n[monte_carlo]\nsamples = 1000\nseed = 1\n"
    );
    let mut read = "X,Y,Z,X_approach,Y_approach,Z_approach,x_um,y_um,z_um\n".to_owned();
    for i in 0..12 {
        let side = if i % 2 == 0 { 1 } else { -1 };
        let at = [17 + 40 * i, 13 + 31 * i, -11 - 23 * i];
        writeln!(read, "{},{},{},{side},{side},{side},0,0,0", at[0], at[1], at[2]).unwrap();
    }
    let texts = [
        ("m.toml", MACHINE.to_owned()),
        ("used.csv", "position_mm,EXX_um\n0,0\n500,1\n".to_owned()),
        ("read.csv", read),
        ("study.toml", study),
    ];
    let files = Files::none().with_texts(texts.map(|(name, text)| (PathBuf::from(name), text)));
    let (study, problems) = read_certificate(&files, Path::new("study.toml"));
    certify(&study.unwrap_or_else(|| panic!("{problems:?}"))).unwrap()
}

/// ISG's chain has one value for both directions. So ±4 µm of EXX, ±4.5 of EYX and ±3 of EYY are left everywhere: at
/// most √(4² + 7.5²) = 8.5 µm, root mean square √(4² + 4.5² + 3²) = 6.73 µm. Against a zero that was set from one side,
/// twice as much.
#[test]
fn the_zone_is_reached_from_every_side() {
    let plain = certificate("").volume;
    assert!((plain.rms_mm[1] - 6.73e-3).abs() < 0.05e-3, "{plain:?}");
    // With k·u of 50 ± 1 µrad and three errors of 0.3 µm: below 3 µm.
    assert!((8.5e-3..11.5e-3).contains(&plain.largest_mm), "{plain:?}");
    let from_zero = certificate("zero = \"X=250 Y=200 Z=-150\"\n").volume;
    assert!((from_zero.rms_mm[1] - 6.73e-3).abs() < 0.05e-3, "{from_zero:?}");
    assert!((17.0e-3..20.0e-3).contains(&from_zero.largest_mm), "{from_zero:?}");
}
