//! `trueaxis plan probe-surface` as users call it.

mod command;

use command::{Folder, root, trueaxis};

const STUDY: &str = "examples/04_plan/probe-surface.toml";

/// The bangle of oracles/cutter_locations.py and its outward normal by differences.
fn bangle_normal(u: f64, v: f64) -> [f64; 3] {
    let point = |u: f64, v: f64| {
        let wave = 0.5 * (6.0 * u + 0.35 * v).sin() + 0.25 * (9.0 * u - 0.5 * v).cos();
        let bulge = 0.9 * (std::f64::consts::PI * (v - 6.0) / 14.0).cos();
        let r = 31.0 / u.cos().hypot(31.0 / 28.0 * u.sin()) + wave + bulge;
        [r * u.cos(), r * u.sin(), v]
    };
    let slope = |a: [f64; 3], b: [f64; 3]| [0, 1, 2].map(|i| (a[i] - b[i]) / 2e-5);
    let du = slope(point(u + 1e-5, v), point(u - 1e-5, v));
    let dv = slope(point(u, v + 1e-5), point(u, v - 1e-5));
    let n = [
        du[1] * dv[2] - du[2] * dv[1],
        du[2] * dv[0] - du[0] * dv[2],
        du[0] * dv[1] - du[1] * dv[0],
    ];
    let norm = n.iter().map(|c| c * c).sum::<f64>().sqrt();
    n.map(|c| c / norm)
}

/// Rows of numbers of the nominal table; the last cell must be empty.
fn rows(text: &str) -> Vec<Vec<f64>> {
    let mut lines = text.lines().filter(|l| !l.starts_with('#'));
    assert_eq!(lines.next(), Some("point,x_mm,y_mm,z_mm,i,j,k,deviation_um"));
    let cells = |l: &str| {
        let open = l.strip_suffix(',').expect("an empty deviation");
        open.split(',').map(|c| c.parse().expect("a number")).collect()
    };
    lines.map(cells).collect()
}

#[test]
fn the_bangle_is_touched_along_its_normals() {
    let folder = Folder::new("surface");
    let out = folder.path("out");
    let ran = trueaxis(&[
        "plan",
        "probe-surface",
        STUDY,
        "--control",
        "fanuc",
        "-o",
        &out,
        "--format",
        "json",
    ]);
    assert_eq!(ran.status, 0, "{}{}", ran.out, ran.err);
    let found = ran.json();
    assert_eq!(found["schema"], "trueaxis/plan-probe-surface/1");
    let table = std::fs::read_to_string(format!("{out}/surface.csv")).expect("a table");
    let rows = rows(&table);
    assert!(rows.len() > 60, "{}", rows.len());
    assert_eq!(found["points"].as_array().map(Vec::len), Some(rows.len()));
    for (i, row) in rows.iter().enumerate() {
        let normal = bangle_normal(row[2].atan2(row[1]), row[3]);
        let cosine: f64 = (0..3).map(|k| normal[k] * row[4 + k]).sum();
        // Neighbours within a millimetre of a waved surface; at its rims they lie to one side.
        assert!(cosine > 12_f64.to_radians().cos(), "point {}: {cosine}", i + 1);
        let near = |b: &Vec<f64>| (1..4).map(|k| (b[k] - row[k]).powi(2)).sum::<f64>().sqrt();
        assert!(rows[..i].iter().all(|b| near(b) >= 4.0 - 1e-5));
    }
    let program = std::fs::read_to_string(format!("{out}/surface.nc")).expect("a program");
    // The first point is touched again at the end; every touch has its alarm and its line in the log.
    for word in ["G31", "#3000=1", "DPRNT[H"] {
        assert_eq!(program.matches(word).count(), rows.len() + 1, "{word}");
    }
}

/// The whole of a Klartext program is read back: touches are motions there, with their alarm and their line.
#[test]
fn every_touch_of_klartext_is_kept_by_a_mask() {
    let folder = Folder::new("surface-klartext");
    let out = folder.path("out");
    let ran = trueaxis(&[
        "plan",
        "probe-surface",
        STUDY,
        "--control",
        "heidenhain",
        "-o",
        &out,
        "--format",
        "json",
    ]);
    assert_eq!(ran.status, 0, "{}{}", ran.out, ran.err);
    let read = |name: &str| std::fs::read_to_string(format!("{out}/{name}")).expect("a file");
    let touches = rows(&read("surface.csv")).len() + 1;
    let program = read("surface.h");
    for word in ["TCH PROBE 4.3 DIST", "EQU -1 GOTO LBL 99", "SURFACE_HITS.A / "] {
        assert_eq!(program.matches(word).count(), touches, "{word}");
    }
    // No motion stands in for a touch in what the control gets.
    assert_eq!(program.matches("Q13 = +0").count(), 0);
    assert!(read("SURFACE_HITS_START.A").contains("TRUEAXIS HITS MM MACHINE"));
    assert!(
        read("SURFACE_HITS.A").contains("A%12.5F")
            && read("SURFACE_HITS_END.A").contains("M_CLOSE")
    );
}

#[test]
fn a_box_is_touched_from_above_on_a_machine_without_rotary_axes() {
    let folder = Folder::new("surface-stl");
    let top = "facet normal 0 0 1\nouter loop\nvertex 0 0 10\nvertex 30 0 10\nvertex 30 20 10\n\
               endloop\nendfacet\n";
    let side = "facet normal 1 0 0\nouter loop\nvertex 30 0 0\nvertex 30 20 0\nvertex 30 20 10\n\
                endloop\nendfacet\n";
    folder.file("part.stl", format!("solid p\n{top}{side}endsolid p\n"));
    let machine = root().join("machines/three-axis-mill/machine.toml").display().to_string();
    let study = |more: &str| {
        format!(
            "name = 's'\nmachine = '{machine}'\nspacing = '5 mm'\n{more}\n[probe]\nlength = '100 mm'\n\
             ball_diameter = '4 mm'\n"
        )
    };
    let run = |text: String, more: &[&str]| {
        let file = folder.file("s.toml", text);
        trueaxis(&[&["plan", "probe-surface", &file, "--format", "json"], more].concat())
    };
    let up = "stl = 'part.stl'\nfacing = '0 0 1'\nwithin = '20 deg'";
    let ran = run(study(up), &[]);
    assert!(ran.status < 2, "{}", ran.err);
    let found = ran.json();
    let points = found["points"].as_array().expect("points");
    assert!(points.len() > 4 && points.iter().all(|p| p["normal"][2] == 1.0), "{points:?}");
    assert!(points.iter().all(|p| (p["point_mm"][2].as_f64().expect("mm") - 10.0).abs() < 1e-9));
    for (text, more, code) in [
        (study(""), &[][..], "missing-key"),
        (study("stl = 'no.stl'"), &[], "unreadable-file"),
        (study(up).replace("5 mm", "0 mm"), &[], "not-positive"),
        (study(up).replace("5 mm", "0.00001 mm"), &[], "too-many-points"),
        (study(up).replace("0 0 1", "0 0 -1"), &[], "no-points"),
        (study(up).replace("100 mm", "9 m"), &[], "unreachable-point"),
        (study(up).replace("100 mm", "1e9 mm"), &[], "impossible-value"),
        (study(up), &["--control", "fidia"], "unknown-control"),
        (study("stl = 'part.stl'\nnormals = 'up'"), &[], "unknown-word"),
    ] {
        let ran = run(text.clone(), more);
        assert_eq!(ran.status, 2, "{code}: {text}\n{}", ran.err);
        assert!(ran.err.contains(&format!("[{code}]")), "{code}: {}", ran.err);
        assert!(ran.has_no_answer());
    }
}

/// What a person has filled in is not replaced by the plan that is made again; the same plan may be.
#[test]
fn a_table_that_was_filled_in_stays() {
    let folder = Folder::new("surface-filled-in");
    let out = folder.path("out");
    let words = ["plan", "probe-surface", STUDY, "--control", "fanuc", "-o", &out];
    assert_eq!(trueaxis(&words).status, 0);
    assert_eq!(trueaxis(&words).status, 0);
    let path = format!("{out}/surface.csv");
    let table = std::fs::read_to_string(&path).expect("a table");
    let filled: String = table
        .lines()
        .map(|l| if l.ends_with(',') { format!("{l}12.5\n") } else { format!("{l}\n") })
        .collect();
    assert_ne!(filled, table);
    std::fs::write(&path, &filled).expect("written");
    let again = trueaxis(&[&words[..], &["--format", "json"]].concat());
    assert!(again.status == 2 && again.err.contains("was edited since"), "{}", again.err);
    assert_eq!(again.json()["schema"], "trueaxis/refused/1");
    assert_eq!(std::fs::read_to_string(&path).expect("a table"), filled);
}

/// The study of the bangle elsewhere, with a change.
fn bangle(folder: &Folder, from: &str, to: &str) -> String {
    let here = root().join("examples/04_plan").display().to_string();
    let text = std::fs::read_to_string(root().join(STUDY)).expect("the study");
    assert!(text.contains(from), "{from}");
    let text = text.replace(from, to);
    let text = text.replace("\"../", &format!("\"{here}/../"));
    folder.file("s.toml", text.replace("\"bangle-", &format!("\"{here}/bangle-")))
}

/// A program that is not safe is a file only where that is asked for.
#[test]
fn what_is_not_safe_is_not_written() {
    let folder = Folder::new("surface-not-safe");
    // A handle of 80 mm just above the ball runs into the part.
    let thick = "shape = [[\"1.2 mm\", \"2 mm\"], [\"80 mm\", \"88 mm\"]]";
    let study = bangle(&folder, "shape = [[\"1.2 mm\", \"45 mm\"], [\"20 mm\", \"45 mm\"]]", thick);
    let out = folder.path("out");
    let words = ["plan", "probe-surface", &study, "--control", "fanuc", "-o", &out];
    let ran = trueaxis(&words);
    assert_eq!(ran.status, 1, "{}{}", ran.out, ran.err);
    assert!(ran.out.contains("NOT SAFE") && ran.err.contains("nothing was written"), "{}", ran.err);
    assert!(!std::path::Path::new(&out).exists());
    let ran = trueaxis(&[&words[..], &["--write-unsafe"]].concat());
    assert_eq!(ran.status, 1, "{}", ran.err);
    assert!(std::path::Path::new(&out).join("surface.nc").exists());
}

#[test]
fn another_ball_and_a_negative_noise_are_named() {
    let folder = Folder::new("surface-ball");
    let ran =
        |from: &str, to: &str| trueaxis(&["plan", "probe-surface", &bangle(&folder, from, to)]);
    let ball = ran("ball_diameter = \"2 mm\"", "ball_diameter = \"20 mm\"");
    let said = "the ball has 20 mm here, 2 mm in the calibration";
    assert!(ball.err.contains("warning[other-ball]") && ball.err.contains(said), "{}", ball.err);
    let same = ran("noise = \"0.5 um\"", "noise = \"0 um\"");
    assert!(same.status == 0 && !same.err.contains("other-ball"), "{}", same.err);
    let noise = ran("noise = \"0.5 um\"", "noise = \"-0.5 um\"");
    assert!(noise.status == 2 && noise.err.contains("error[bad-size]: `noise`"), "{}", noise.err);
}
