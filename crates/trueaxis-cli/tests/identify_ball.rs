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
    assert!(line.ends_with("not observable") || numbers.len() == 3, "{line}");
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
