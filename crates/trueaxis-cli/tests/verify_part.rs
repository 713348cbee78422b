//! `trueaxis verify --part` as its users call it, with the mistakes that they make.

mod command;

use command::{Folder, trueaxis};
use std::fmt::Write;

const MEASURED: &str = "examples/07_verify/nas979-measured.toml";
const POINTS: &str = "examples/07_verify/nas979-points.csv";

/// Fig 20 of Wu et al. 2022 from the values of its Table 4.
#[test]
fn paper_table_4_gives_the_ratios_of_fig_20() {
    let ran = trueaxis(&["verify", "--part", MEASURED]);
    // 0.0282 + U is beyond 0.030: the second part is not proved good.
    assert_eq!(ran.status, 1, "{}", ran.err);
    for ratio in ["81.46 %", "81.24 %", "89.67 %"] {
        assert!(ran.out.contains(ratio), "{ratio}: {}", ran.out);
    }
    assert!(ran.err.contains("warning[other-length]"), "{}", ran.err);
    let found = trueaxis(&["verify", "--part", MEASURED, "--format", "json"]).json();
    assert_eq!(found["schema"], "trueaxis/verify-part/1");
    let angularity = &found["indices"][2];
    assert_eq!(angularity["index"], "angularity_zone_mm");
    assert_eq!(angularity["verdicts"], serde_json::json!(["pass", "undecided", "pass", "pass"]));
}

struct Part {
    folder: Folder,
    rows: Vec<(usize, [f64; 3])>,
}

impl Part {
    fn new(name: &str) -> Self {
        let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
        let text = std::fs::read_to_string(root.join(POINTS)).expect("the points");
        let rows = text.lines().filter(|l| l.starts_with(|c: char| c.is_ascii_digit()));
        let rows = rows.map(|line| {
            let numbers: Vec<f64> = line.split(',').map(|n| n.parse().expect("a number")).collect();
            (line[..1].parse().expect("a section"), [numbers[1], numbers[2], numbers[3]])
        });
        Self { folder: Folder::new(name), rows: rows.collect() }
    }

    /// Status and messages after a change of the points.
    fn with(
        &self,
        keys: &str,
        change: &dyn Fn(usize, [f64; 3]) -> [f64; 3],
    ) -> (i32, String, String) {
        self.table(keys, "section,x_mm,y_mm,z_mm", &|i, (section, p)| {
            let [x, y, z] = change(i, p);
            vec![format!("{section},{x},{y},{z}")]
        })
    }

    fn table(
        &self,
        keys: &str,
        head: &str,
        row: &dyn Fn(usize, (usize, [f64; 3])) -> Vec<String>,
    ) -> (i32, String, String) {
        let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
        let mut text = format!("{head}\n");
        for (i, p) in self.rows.iter().enumerate() {
            for line in row(i, *p) {
                writeln!(text, "{line}").expect("a line");
            }
        }
        std::fs::write(self.folder.path("points.csv"), text).expect("written");
        // The shipped study without its Monte Carlo run.
        let study = root.join("examples/03_predict/nas979-on-xkas2525.toml");
        let study_text = std::fs::read_to_string(study).expect("the study");
        let parts = study_text.split("[published]").next().expect("a text");
        let here = format!("{}/", root.display());
        let parts = parts.replace("../../", &here).replace("samples = 10000", "samples = 0");
        let study = self.folder.path("study.toml");
        std::fs::write(&study, parts).expect("written");
        let file = format!(
            "name = \"part\"\nstudy = {study:?}\n[cmm]\npoints = \"points.csv\"\npoint_u = \"0.7 um\"\n{keys}\n"
        );
        let path = self.folder.path("part.toml");
        std::fs::write(&path, file).expect("written");
        let ran = trueaxis(&["verify", "--part", &path]);
        (ran.status, ran.err, ran.out)
    }
}

const CORRECTED: &str = "probe = \"corrected\"";

#[test]
fn points_with_a_mistake_are_named_with_the_likely_reason() {
    let part = Part::new("verify-part-bad");
    let outwards = |[x, y, z]: [f64; 3], r: f64| {
        let (cos, sin, radius) = (15f64.to_radians().cos(), 15f64.to_radians().sin(), x.hypot(y));
        [x + r * cos * x / radius, y + r * cos * y / radius, z + r * sin]
    };
    let refused = |keys: &str, change: &dyn Fn(usize, [f64; 3]) -> [f64; 3], words: &[&str]| {
        let (status, err, _) = part.with(keys, change);
        assert_eq!(status, 2, "{words:?}: {err}");
        words.iter().for_each(|word| assert!(err.contains(word), "{word}: {err}"));
    };
    let wrong = |change: &dyn Fn(usize, [f64; 3]) -> [f64; 3], words: &[&str]| {
        refused(CORRECTED, change, words);
    };
    wrong(&|_, p| p.map(|v| v / 25.4), &["wrong-unit", "inches"]);
    wrong(&|_, p| p.map(|v| v * 1e3), &["wrong-unit", "x_um"]);
    wrong(&|_, [x, y, z]| [z, y, x], &["swapped-columns", "z as x"]);
    wrong(&|_, [x, y, z]| [x, y, z + 60.0], &["other-frame", "59.9"]);
    wrong(&|_, [x, y, z]| [x + 40.0, y - 30.0, z + 5.0], &["other-frame", "39.99"]);
    wrong(&|_, [x, y, z]| [x, -y, -z], &["other-frame", "the other way"]);
    wrong(&|_, p| outwards(p, 1.5), &["stylus-radius", "outside", "centres"]);
    let centres = "probe = \"centres\"\nstylus_diameter = \"3 mm\"";
    refused(centres, &|_, p| p, &["stylus-radius", "inside", "corrected already"]);
    wrong(
        &|i, p| if i == 101 { outwards(p, 4.0) } else { p },
        &["point-off-piece", "points.csv:103"],
    );
    wrong(&|i, p| if i == 200 { part.rows[9].1 } else { p }, &["points.csv:202"]);
    refused("", &|_, p| p, &["missing-key", "probe"]);
    refused("probe = \"centres\"", &|_, p| p, &["stylus_diameter"]);
    refused(
        "probe = \"corrected\"\ncondition = \"condition 9\"",
        &|_, p| p,
        &["condition 9", "condition 1, condition 2"],
    );
}

#[test]
fn points_that_are_stated_otherwise_give_the_same_part() {
    let part = Part::new("verify-part-same");
    let verdict = |(status, err, out): (i32, String, String)| {
        assert_eq!(status, 0, "{err}");
        let line = out.lines().find(|l| l.contains("roundness, minimum zone")).expect("a line");
        line.to_owned()
    };
    let as_is = verdict(part.with(CORRECTED, &|_, p| p));
    assert!(as_is.contains("13.04"), "{as_is}");
    let frame = "probe = \"corrected\"\nframe = \"40 -30 5 mm\"";
    assert_eq!(as_is, verdict(part.with(frame, &|_, [x, y, z]| [x + 40.0, y - 30.0, z + 5.0])));
    let row = |unit: f64| {
        move |_, (_, p): (usize, [f64; 3])| vec![p.map(|v| (v / unit).to_string()).join(",")]
    };
    assert_eq!(as_is, verdict(part.table(CORRECTED, "x_in,y_in,z_in", &row(25.4))));
    assert_eq!(as_is, verdict(part.table(CORRECTED, "x_um,y_um,z_um", &row(1e-3))));
    let heights = |_, (section, [x, y, z]): (usize, [f64; 3])| {
        vec![format!("{z},{x},{},{y}", [0, 25, 50, 60][section - 1])]
    };
    assert_eq!(as_is, verdict(part.table(CORRECTED, "z_mm,x_mm,height_mm,y_mm", &heights)));
}

#[test]
fn points_that_should_be_looked_at_are_named_and_count() {
    let part = Part::new("verify-part-look");
    let (status, err, out) = part.with(CORRECTED, &|i, [x, y, z]| {
        if i == 101 { [x * 1.002, y * 1.002, z] } else { [x, y, z] }
    });
    assert_eq!(status, 1);
    assert!(err.contains("warning[jumping-point]") && err.contains("points.csv:103"), "{err}");
    assert!(out.contains("FAIL"), "{out}");
    // An eighth of one section is missing: its u grows.
    let gap = |_, (section, [x, y, z]): (usize, [f64; 3])| match section {
        2 if (0.5..1.6).contains(&f64::atan2(y, x)) => Vec::new(),
        _ => vec![format!("{section},{x},{y},{z}")],
    };
    let (status, err, _) = part.table(CORRECTED, "section,x_mm,y_mm,z_mm", &gap);
    assert!(status == 0 && err.contains("warning[arc-of-points]"), "{err}");
    let arc = |_, (section, [x, y, z]): (usize, [f64; 3])| match section {
        2 if (0.0..2.6).contains(&f64::atan2(y, x)) => Vec::new(),
        _ => vec![format!("{section},{x},{y},{z}")],
    };
    let (status, err, _) = part.table(CORRECTED, "section,x_mm,y_mm,z_mm", &arc);
    assert!(status == 2 && err.contains("error[arc-of-points]"), "{err}");
    // x and y swapped: the part of revolution does not show it, its form does.
    let (_, _, out) = part.with(CORRECTED, &|_, [x, y, z]| [y, x, z]);
    assert!(out.contains("x\n    and y swapped") || out.contains("x and y swapped"), "{out}");
}

#[test]
fn typed_values_with_a_mistake_are_refused() {
    let folder = Folder::new("verify-part-typed");
    let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let piece = root.join("testpieces/nas979-gbt33150.toml").display().to_string();
    let ask = |body: &str| {
        let path = folder.path("part.toml");
        let text = format!("name = \"part\"\ntest_piece = {piece:?}\n{body}\n");
        std::fs::write(&path, text).expect("written");
        trueaxis(&["verify", "--part", &path])
    };
    let refused = |body: &str, words: &[&str]| {
        let ran = ask(body);
        assert_eq!(ran.status, 2, "{body}: {}", ran.err);
        words.iter().for_each(|word| assert!(ran.err.contains(word), "{word}: {}", ran.err));
    };
    refused("", &["missing-key", "what was measured"]);
    refused("[measured]\nroundness_mzc_mm = [\"0.038 mm\"]", &["no-uncertainty", "u = "]);
    refused("[measured]\nu = \"1 um\"\nroundness_mm = [\"0.038 mm\"]", &["unknown-index"]);
    refused("[measured]\nu = \"1 um\"\nroundness_mzc_mm = [\"0.038\"]", &["missing-unit"]);
    let ragged = "[measured]\nu = \"1 um\"\nroundness_mzc_mm = [\"0.03 mm\"]\ncoaxiality_lsc_mm = [\"0.03 mm\", \"0.02 mm\"]";
    refused(ragged, &["ragged-row"]);
    let mean = "[measured]\nu = \"1 um\"\nroundness_mzc_mm = { values = [\"0.03 mm\"], mean = \"0.04 mm\" }";
    refused(mean, &["other-mean", "0.030000"]);
    let angle = "[measured]\nu = \"1 um\"\nangularity_zone_mm = { angles = [\"0.0633 deg\"] }";
    refused(angle, &["over = "]);
    // 25 tan(0.0633 deg) = 27.62 µm; nothing else was measured: undecided.
    let ran = ask(
        "[measured]\nu = \"1 um\"\nangularity_zone_mm = { angles = [\"0.0633 deg\"], over = \"25 mm\" }",
    );
    assert!(ran.status == 1 && ran.out.contains("27.62"), "{}", ran.out);
    assert!(ran.out.contains("not measured: roundness"), "{}", ran.out);
    let simple = "[decision]\nrule = \"simple\"\n[measured]\nroundness_mzc_mm = \"0.03 mm\"\ncoaxiality_lsc_mm = \"0.03 mm\"\nangularity_zone_mm = \"0.03 mm\"";
    let ran = ask(simple);
    assert_eq!(ran.status, 0, "{}", ran.err);
}

/// Points of one section: the part is counted, and what was not measured does not pass.
#[test]
fn one_section_is_a_part_that_is_not_decided() {
    let part = Part::new("verify-part-one-section");
    let first = |_, (section, [x, y, z]): (usize, [f64; 3])| match section {
        1 => vec![format!("{section},{x},{y},{z}")],
        _ => Vec::new(),
    };
    let (status, err, out) = part.table(CORRECTED, "section,x_mm,y_mm,z_mm", &first);
    assert_eq!(status, 1, "{err}");
    assert!(out.contains("measured: 1 part,") && out.contains("not measured:"), "{out}");
}
