//! `trueaxis identify` with campaigns on a ball whose errors are not all listed: a head-head router, a cone path.
//!
//! The readings are those of `oracles/ball_campaigns.py`; the true errors stand in the comments of the campaigns.

mod command;

use command::{Folder, root, trueaxis};

const HEAD_HEAD: &str = "examples/05_identify/head-head.toml";
const CONE: &str = "examples/05_identify/cone-path.toml";

/// Value and standard uncertainty (µm, µrad) of an error of the report; `None` where it is not observable.
fn found(report: &str, name: &str) -> Option<[f64; 2]> {
    let line = report.lines().find(|l| l.split_whitespace().next() == Some(name)).expect(name);
    let numbers: Vec<f64> = line.split_whitespace().filter_map(|w| w.parse().ok()).collect();
    assert!(line.ends_with("not observable") || numbers.len() >= 4, "{line}");
    Some([*numbers.first()?, *numbers.get(1)?])
}

/// Every error that has a value lies within U (k = 2) of the truth; at least so many of them differ from 0.
fn agrees(report: &str, truth: &[(&str, f64)], significant: usize) {
    let mut differ = 0;
    for (name, true_value) in truth {
        let Some([value, u]) = found(report, name) else { continue };
        assert!((value - true_value).abs() <= 2.0 * u, "{name}: {value} ± {u}, truth {true_value}");
        differ += usize::from(value.abs() > 2.0 * u);
    }
    assert!(differ >= significant, "{differ} of {} differ from 0", truth.len());
}

/// µm of a coordinate, held out: by the listed errors, by all errors.
fn predicted(report: &str, what: &str) -> [f64; 2] {
    let line = report.lines().find(|l| l.contains("held out:") && l.contains(what)).expect(what);
    let words: Vec<&str> = line.split_whitespace().collect();
    let numbers =
        words.windows(2).filter(|w| w[1] == "µm").map(|w| w[0].parse().expect("a number"));
    numbers.collect::<Vec<f64>>().try_into().unwrap_or_else(|_| panic!("two figures: {line}"))
}

#[test]
fn errors_of_a_head_are_named_and_the_rest_is_predicted() {
    let ran = trueaxis(&["identify", HEAD_HEAD]);
    assert_eq!(ran.status, 1, "{}", ran.err);
    assert!(ran.out.contains("it follows machine XYZ (volumetric)"), "{}", ran.out);
    let truth = [
        ("EC0Y", 90.0),
        ("EA0Z", -60.0),
        ("EB0Z", 75.0),
        ("EA0C", -180.0),
        ("EB0C", 140.0),
        ("EX0B", 85.0),
        ("EA0B", -220.0),
        ("EC0B", 160.0),
    ];
    agrees(&ran.out, &truth, 2);
    // The noise is 6 µm. With the listed errors alone twice as much remains.
    for (what, most) in [("a part of the places", 8.0), ("angle of B", 9.0), ("angle of C", 9.0)] {
        let [listed, all] = predicted(&ran.out, what);
        assert!(all < most && listed > 11.0, "{what}: {listed} µm, {all} µm");
    }
}

#[test]
fn a_drift_over_a_cone_path_is_named() {
    let ran = trueaxis(&["identify", CONE]);
    assert_eq!(ran.status, 1, "{}", ran.err);
    assert!(ran.out.contains("of it drifts with time"), "{}", ran.out);
    let truth = [
        ("EX0C", 9.0),
        ("EY0C", -15.0),
        ("EB0C", 71.0),
        ("EY0A", 12.0),
        ("EZ0A", -18.0),
        ("EA0A", 40.0),
        ("EB0A", 65.0),
        ("EC0A", -52.0),
        ("EC0X", 31.0),
        ("EA0Z", -26.0),
        ("EB0Z", 17.0),
    ];
    agrees(&ran.out, &truth, 6);
    let [listed, all] = predicted(&ran.out, "a part of the places");
    assert!(all < 1.2 && listed > 1.6, "{listed} µm, {all} µm");
}

/// The head-head campaign with other readings.
fn with_readings(folder: &Folder, change: impl Fn(usize, &str) -> String) -> String {
    let source = root().join("examples/05_identify");
    let csv = std::fs::read_to_string(source.join("head-head.csv")).expect("the readings");
    let lines: Vec<String> = csv.lines().enumerate().map(|(i, line)| change(i, line)).collect();
    folder.file("head-head.csv", lines.join("\n") + "\n");
    let machine =
        std::fs::read_to_string(source.join("head-head-machine.toml")).expect("a machine");
    folder.file("head-head-machine.toml", machine);
    let text = std::fs::read_to_string(root().join(HEAD_HEAD)).expect("the campaign");
    folder.file("campaign.toml", text)
}

fn refused(campaign: &str, code: &str, place: &str) {
    let ran = trueaxis(&["identify", campaign]);
    assert_eq!(ran.status, 2, "{}", ran.err);
    assert!(ran.err.contains(&format!("error[{code}]")), "{code}: {}", ran.err);
    assert!(ran.err.contains(place), "{place}: {}", ran.err);
    assert!(ran.has_no_answer());
}

#[test]
fn mistakes_in_a_list_of_centres_are_refused_with_their_place() {
    let folder = Folder::new("identify-centres");
    // The heading is line 3; the fifth station stands in line 8.
    let heading = |from: &'static str, to: &'static str| {
        move |i: usize, line: &str| if i == 2 { line.replace(from, to) } else { line.to_owned() }
    };
    let campaign = with_readings(&folder, heading("y_mm", "y_deg"));
    refused(&campaign, "wrong-unit", "head-head.csv:3");
    let campaign = with_readings(&folder, heading("y_mm", "y_um"));
    refused(&campaign, "far-from-ball", "head-head.csv:4");
    let campaign = with_readings(&folder, heading("y_mm", "Y"));
    refused(&campaign, "place-twice", "head-head.csv:3");
    let campaign = with_readings(&folder, heading("y_mm", "why_mm"));
    refused(&campaign, "missing-column", "head-head.csv");
    let campaign = with_readings(&folder, |i, line| {
        if i == 7 { line.replace(",800.", ",830.") } else { line.to_owned() }
    });
    refused(&campaign, "far-from-ball", "head-head.csv:8");
}

/// A station: B, C and where the ball was seen.
fn station(line: &str) -> Option<([&str; 2], [f64; 3])> {
    let mut cells = line.split(',');
    let angles = [cells.next()?, cells.next()?];
    let seen = cells.map(|v| v.parse().ok()).collect::<Option<Vec<f64>>>()?;
    Some((angles, seen.try_into().ok()?))
}

/// Where the ball was seen and what the tool must do are opposite: both forms of one table give one answer.
#[test]
fn the_correction_of_the_tool_gives_the_same_errors() {
    const STATIONS: usize = 42;
    let folder = Folder::new("identify-reads");
    let short =
        |i: usize, line: &str| if i < 3 + STATIONS { line.to_owned() } else { String::new() };
    let seen = trueaxis(&["identify", &with_readings(&folder, short)]);
    let campaign = with_readings(&folder, |i, line| match station(&short(i, line)) {
        None => short(i, line),
        Some(([b, c], [x, y, z])) => {
            format!("{b},{c},{:.4},{:.4},{:.4}", 1600.0 - x, 1000.0 - y, -400.0 - z)
        }
    });
    let wrong = trueaxis(&["identify", &campaign]);
    let text = std::fs::read_to_string(&campaign).expect("the campaign");
    folder.file("campaign.toml", text.replace("reads = \"ball\"", "reads = \"tool\""));
    let corrected = trueaxis(&["identify", &campaign]);
    for name in ["EX0B", "EA0B", "EC0B"] {
        let of = |report: &str| found(report, name).expect(name)[0];
        assert!((of(&seen.out) - of(&corrected.out)).abs() < 0.002, "{name}");
        // Taken for the other, the errors have the other sign.
        assert!(of(&wrong.out) * of(&seen.out) < 0.0, "{name}");
    }
}

/// The tip deviation (µm) at a place, by a machine file.
fn tip_um(machine: &str, place: &str) -> Vec<f64> {
    let ran = trueaxis(&["pose", machine, "--at", place, "--format", "json"]);
    assert_eq!(ran.status, 0, "{}", ran.err);
    let document: serde_json::Value = serde_json::from_str(&ran.out).expect("JSON");
    let tip = document["deviation"]["tip_um"].as_array().expect("a list");
    tip.iter().map(|v| v.as_f64().expect("a number")).collect()
}

/// Writes the predictor of a campaign into its folder.
fn predictor(folder: &Folder, campaign: &str, name: &str) -> String {
    let path = folder.path(name);
    let ran = trueaxis(&["identify", campaign, "--predictor", &path]);
    assert_eq!(ran.status, 1, "{}", ran.err);
    path
}

#[test]
fn a_prediction_is_a_machine_file_whose_uncertainty_knows_what_is_separable() {
    let folder = Folder::new("predictor");
    let campaign = with_readings(&folder, |_, line| line.to_owned());
    let file = predictor(&folder, &campaign, "predicted.toml");
    let text = std::fs::read_to_string(&file).expect("a machine file");
    assert!(
        text.contains("EX0B = ") && text.contains("single values are not identified"),
        "{text}"
    );
    assert!(text.contains("# scored over X ") && text.contains("without compensation: "), "{text}");
    // One of its errors alone can't be replaced.
    let on_it = std::fs::read_to_string(&campaign).expect("a campaign");
    let machine = on_it.lines().find(|l| l.starts_with("machine")).expect("a machine");
    let path = folder.path("on-it.toml");
    let text = on_it.replace(machine, &format!("machine = {file:?}"));
    std::fs::write(&path, text).expect("a campaign");
    let on_it = path;
    let refused = trueaxis(&["identify", &on_it, "-o", &folder.path("single.toml")]);
    assert_eq!(refused.status, 2, "{}", refused.err);
    assert!(
        refused.err.contains("known together") && refused.err.contains("--predictor"),
        "{}",
        refused.err
    );
    let place = "X=850 Y=450 Z=150 B=20 C=45";
    let first = tip_um(&file, place);
    // Another order of the rows, and another unit.
    let turned = Folder::new("predictor-turned");
    let campaign = with_readings(&turned, |i, line| {
        let cells: Vec<&str> = line.split(',').collect();
        let um = |v: &&str| format!("{:.1}", v.parse::<f64>().expect("a number") * 1e3);
        match cells[..] {
            _ if line.starts_with('#') => line.to_owned(),
            ["B", ..] => "B,C,x_um,y_um,z_um".to_owned(),
            [b, c, ref xyz @ ..] if i > 0 => {
                let xyz: Vec<String> = xyz.iter().map(um).collect();
                format!("{b},{c},{}", xyz.join(","))
            }
            _ => line.to_owned(),
        }
    });
    let other = tip_um(&predictor(&turned, &campaign, "predicted.toml"), place);
    for (a, b) in first.iter().zip(&other) {
        assert!((a - b).abs() < 1e-3, "{first:?} {other:?}");
    }
}

#[test]
fn a_prediction_that_makes_the_machine_worse_is_refused() {
    let folder = Folder::new("predictor-worse");
    // Nothing but noise, at eight places: the listed errors follow it.
    let mut random = 12_345_u64;
    let mut noise = || {
        random =
            random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((random >> 33) as f64 / f64::from(1u32 << 31) - 0.5) * 0.04
    };
    let values: Vec<[f64; 3]> =
        (0..200).map(|_| [800.0 + noise(), 500.0 + noise(), -200.0 + noise()]).collect();
    let campaign = with_readings(&folder, |i, line| match line.starts_with(['#', 'B']) {
        true => line.to_owned(),
        false if i % 12 != 0 => String::new(),
        false => {
            let head: Vec<&str> = line.split(',').take(2).collect();
            let [x, y, z] = values[i];
            format!("{},{x:.4},{y:.4},{z:.4}", head.join(","))
        }
    });
    let file = folder.path("predicted.toml");
    let ran = trueaxis(&["identify", &campaign, "--predictor", &file]);
    assert_eq!(ran.status, 2, "{}", ran.err);
    assert!(ran.err.contains("prediction-worse"), "{}", ran.err);
    assert!(!std::path::Path::new(&file).exists());
}

#[test]
fn a_covariance_that_does_not_belong_to_the_machine_file_is_refused() {
    let folder = Folder::new("predictor-other");
    let campaign = with_readings(&folder, |_, line| line.to_owned());
    let file = predictor(&folder, &campaign, "predicted.toml");
    let text = std::fs::read_to_string(&file).expect("a machine file");
    let covariance = folder.path("predicted-covariance.toml");
    let known = std::fs::read_to_string(&covariance).expect("a covariance");
    let refused = |text: &str, known: Option<&str>, code: &str, place: &str| {
        let machine = folder.file("changed.toml", text);
        match known {
            Some(known) => std::fs::write(&covariance, known).expect("a file"),
            None => std::fs::remove_file(&covariance).expect("a file"),
        }
        let ran = trueaxis(&["check", &machine]);
        assert_eq!(ran.status, 2, "{code}: {}", ran.err);
        assert!(ran.err.contains(code) && ran.err.contains(place), "{code}: {}", ran.err);
    };
    let changed: String = text
        .lines()
        .map(|l| if l.starts_with("EC0Y = ") { "EC0Y = \"1 ± 1 urad\"" } else { l })
        .fold(String::new(), |all, l| all + l + "\n");
    refused(&changed, Some(&known), "other-covariance", "changed.toml:");
    let line = known.lines().find(|l| l.starts_with("u = ")).expect("a row");
    let other = known.replacen(line, "u = 1.0", 1);
    refused(&text, Some(&other), "bad-covariance", "predicted-covariance.toml:");
    let nowhere = known.replacen("error = \"EX0B\"", "error = \"EX0A\"", 1);
    refused(&text, Some(&nowhere), "unknown-body", "predicted-covariance.toml:");
    refused(&text, Some("[[known]]\n"), "missing-key", "predicted-covariance.toml:");
    refused(&text, None, "missing-table", "changed.toml:");
}
