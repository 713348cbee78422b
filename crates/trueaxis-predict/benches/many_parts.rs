//! Monte Carlo of a part with 20 features, against a limit.
//!
//! A plate with 16 bores and four planes, 24 characteristics, on a mill with 20 uncertain errors: 10^4 machines in at most 10 s on two
//! cores.
//!
//! `cargo bench -p trueaxis-predict --bench many_parts`

#![allow(clippy::print_stdout)] // a bench prints its figures

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::time::Instant;
use trueaxis_input::{Diagnostics, Files};
use trueaxis_predict::predict::Sampling;
use trueaxis_predict::predict::drawing::{PartStudy, predict_part, read_part_study};

const SAMPLES: usize = 10_000;
const LIMIT_S: f64 = 10.0;
const PITCH_MM: f64 = 40.0;

fn bores() -> impl Iterator<Item = [f64; 2]> {
    (0..16_i32).map(|k| [k % 4, k / 4].map(|n| PITCH_MM * (f64::from(n) - 1.5)))
}

fn part() -> String {
    let mut text = "name = \"plate\"\n[feature.A]\nplane = { at = \"0 0 0 mm\", normal = \"0 0 1\", size = \"190 190 mm\" }\nopenings = [".to_owned();
    for [x, y] in bores() {
        let _ = write!(text, "{{ at = \"{x} {y} 0 mm\", diameter = \"24 mm\" }},");
    }
    text += "]\n";
    for (name, at, normal) in [
        ("B", "0 -100 -5 mm", "0 -1 0"),
        ("C", "-100 0 -5 mm", "-1 0 0"),
        ("D", "100 0 -5 mm", "1 0 0"),
    ] {
        let along = if name == "B" { "1 0 0" } else { "0 1 0" };
        let _ = write!(
            text,
            "[feature.{name}]\nplane = {{ at = \"{at}\", normal = \"{normal}\", along = \"{along}\", size = \"180 8 mm\" }}\n"
        );
    }
    for (i, [x, y]) in bores().enumerate() {
        let _ = write!(
            text,
            "[feature.bore_{i}]\nhole = {{ at = \"{x} {y} -1 mm\", axis = \"0 0 -1\", diameter = \"20 mm\", length = \"8 mm\" }}\n\
             [[characteristic]]\nposition = \"20 um\"\nof = \"bore_{i}\"\ndatum = \"A|B|C\"\n"
        );
    }
    text += "[[characteristic]]\nflatness = \"9 um\"\nof = \"A\"\n";
    for name in ["B", "C", "D"] {
        let _ = write!(
            text,
            "[[characteristic]]\nperpendicularity = \"9 um\"\nof = \"{name}\"\ndatum = \"A\"\n"
        );
    }
    for name in ["bore_0", "bore_15"] {
        let _ = write!(
            text,
            "[[characteristic]]\ncylindricity = \"9 um\"\nof = \"{name}\"\n[[characteristic]]\ndiameter = \"9 um\"\nof = \"{name}\"\n"
        );
    }
    text
}

fn program() -> String {
    let mut text =
        "%\nO1\nG21 G17 G40 G80 G90 G94\nT1 M6\nG54 G0 X0. Y0. S8000 M3\nG43 Z5. H1\n".to_owned();
    // Faced by tracks, then the sides, then the bores.
    for k in 0..24 {
        let (x, y) = (if k % 2 == 0 { 110.0 } else { -110.0 }, f64::from(k).mul_add(9.0, -103.5));
        let _ = write!(text, "G0 X{:.3} Y{y:.3}\nG1 Z0. F900\nX{x:.3}\nG0 Z5.\n", -x);
    }
    text += "G0 X-106. Y-106.\nG1 Z-10.\nX106.\nY106.\nX-106.\nY-106.\nG0 Z5.\n";
    for [x, y] in bores() {
        let _ = write!(
            text,
            "G0 X{:.3} Y{y:.3}\nG1 Z-10.\nG3 X{:.3} Y{y:.3} I-4.\nG1 X{x:.3}\nG0 Z5.\n",
            x + 4.0,
            x + 4.0
        );
    }
    text + "M30\n%\n"
}

fn machine() -> String {
    let mut text = "[machine]\nname = \"mill\"\nchain = \"w b X Y Z t\"\n[location]\nEC0Y = \"20 ± 5 urad\"\nEB0Z = \"-15 ± 5 urad\"\n".to_owned();
    for axis in ["X", "Y", "Z"] {
        let _ = writeln!(text, "[motion.{axis}]");
        for (kinds, unit) in [(["X", "Y", "Z"], "um"), (["A", "B", "C"], "urad")] {
            for kind in kinds {
                let _ = writeln!(
                    text,
                    "E{kind}{axis} = {{ polynomial = [\"0 {unit}\", \"3 {unit}\", \"1 {unit}\"], scale = \"100 mm\", u = \"2 {unit}\" }}"
                );
            }
        }
    }
    text
}

fn study() -> PartStudy {
    let study = "name = \"s\"\nmachine = \"m.toml\"\npart = \"p.toml\"\nprogram = \"p.nc\"\n[monte_carlo]\nsamples = 10000\n";
    let set_up = "control = \"fanuc\"\nworkpiece_at = \"G54\"\n[work_offset.G54]\nX = \"300 mm\"\nY = \"200 mm\"\nZ = \"-300 mm\"\n\
        [tool.1]\nname = \"end mill 12\"\nlength = \"90 mm\"\ndiameter = \"12 mm\"\n";
    let texts = [
        ("s.toml", study.to_owned()),
        ("m.toml", machine()),
        ("p.toml", part()),
        ("p.nc", program()),
        ("p.setup.toml", set_up.to_owned()),
    ];
    let files = Files::none().with_texts(texts.map(|(name, text)| (PathBuf::from(name), text)));
    let (study, problems) = read_part_study(&files, Path::new("s.toml"));
    study.unwrap_or_else(|| panic!("{problems:?}"))
}

fn main() {
    let mut study = study();
    let threads = rayon::ThreadPoolBuilder::new().num_threads(2).build().expect("a pool");
    let seconds = |samples: usize, study: &mut PartStudy| {
        study.sampling = (samples > 0).then_some(Sampling { samples, seed: 1 });
        let mut problems = Diagnostics::new();
        let start = Instant::now();
        let found = threads.install(|| predict_part(study, &|_| {}, &mut problems));
        assert!(found.is_some(), "{problems:?}");
        start.elapsed().as_secs_f64()
    };
    let (features, asked) = (study.part.features.len(), study.part.characteristics.len());
    let quantities = study.mounted.uncertain_quantities().len();
    let (cut, all) = (seconds(0, &mut study), seconds(SAMPLES, &mut study));
    println!(
        "{features} features, {asked} characteristics, {} points, {quantities} uncertain errors",
        study.part.points()
    );
    println!(
        "cut and judged {cut:.2} s, {SAMPLES} machines more {:.2} s on two cores (limit: {LIMIT_S} s)",
        all - cut
    );
}
