//! From the plan to the errors as users call it: `plan`, `measure`, `identify`, and nothing by hand in between.

mod command;

use command::{Folder, trueaxis};
use std::fs::{create_dir, read_to_string, write};

const CAMPAIGN: &str = "examples/04_plan/touch-probe-5-minutes.toml";

/// machines/i5-engraver/machine.toml, µm and µrad.
const TRUE: [(&str, f64); 11] = [
    ("EX0C", -12.0),
    ("EY0C", 16.0),
    ("EA0C", 19.0),
    ("EB0C", 28.0),
    ("EY0A", 9.0),
    ("EZ0A", -14.0),
    ("EB0A", -17.0),
    ("EC0A", 25.0),
    ("EC0Y", 18.0),
    ("EA0Z", -22.0),
    ("EB0Z", 13.0),
];

#[test]
fn what_is_planned_is_measured_and_identified_without_work_by_hand() {
    let folder = Folder::new("plan-campaign");
    let planned = trueaxis(&["plan", CAMPAIGN, "-o", &folder.path("d"), "--format", "json"]);
    assert_eq!(planned.status, 0, "{}", planned.err);
    let [campaign, readings] = ["d/campaign.toml", "d/readings"].map(|name| folder.path(name));
    let measured = trueaxis(&["measure", &campaign, "-o", &readings]);
    assert_eq!(measured.status, 0, "{}", measured.err);
    let found = trueaxis(&["identify", &campaign, "--format", "json"]);
    assert_eq!(found.status, 0, "{}", found.err);
    let (planned, found) = (planned.json(), found.json());
    let entry = |document: &serde_json::Value, list: &str, name: &str| {
        let entries = document[list].as_array().expect(list);
        entries.iter().find(|e| e["name"] == name).cloned().unwrap_or_default()
    };
    for (name, due) in TRUE {
        let promised = entry(&planned, "expected", name)["u"].as_f64().expect(name);
        let error = entry(&found, "errors", name);
        let unit = if name.starts_with("EX0") || name.starts_with("EY0") || name.starts_with("EZ0")
        {
            "value_um"
        } else {
            "value_urad"
        };
        let [value, u] = [unit, "u"].map(|key| error[key].as_f64().expect(name));
        assert!((u / promised - 1.0).abs() < 0.02, "{name}: {u}, not {promised}");
        assert!((value - due).abs() < 2.0 * u, "{name}: {value} ± {u}, not {due}");
    }
    // Once more: the same files stay.
    assert_eq!(trueaxis(&["plan", CAMPAIGN, "-o", &folder.path("d")]).status, 0);
    assert_eq!(trueaxis(&["measure", &campaign, "-o", &readings]).status, 0);
}

#[test]
fn nothing_that_a_person_has_made_is_overwritten() {
    let folder = Folder::new("plan-kept");
    let out = folder.path("d");
    assert_eq!(trueaxis(&["plan", CAMPAIGN, "-o", &out]).status, 0);
    let [campaign, readings] = ["d/campaign.toml", "d/readings"].map(|name| folder.path(name));
    assert_eq!(trueaxis(&["measure", &campaign, "-o", &readings]).status, 0);
    // Own readings in the place of the virtual ones.
    let own = folder.path("d/readings/probe.csv");
    let table = read_to_string(&own).expect("readings");
    let table: String = table.split_inclusive('\n').skip(1).collect();
    write(&own, &table).expect("own readings");
    let ran = trueaxis(&["measure", &campaign, "-o", &readings]);
    assert!(ran.status == 2 && ran.err.contains("unwritable-file"), "{}", ran.err);
    assert_eq!(read_to_string(&own).expect("readings"), table);
    assert_eq!(trueaxis(&["identify", &campaign]).status, 0);
    // A plan into a folder where something was edited.
    for name in ["campaign.toml", "01-chosen.csv"] {
        let path = folder.path(&format!("d/{name}"));
        let before = read_to_string(&path).expect(name);
        let edited = before.replacen('\n', "\r\n", 1);
        write(&path, &edited).expect(name);
        let ran = trueaxis(&["plan", CAMPAIGN, "-o", &out]);
        assert!(ran.status == 2 && ran.err.contains(name), "{name}: {}", ran.err);
        assert!(ran.err.contains("unwritable-file"), "{}", ran.err);
        assert_eq!(read_to_string(&path).expect(name), edited, "{name}");
        write(&path, &before).expect(name);
    }
    // The campaign itself stands there under this name; as deep as the first, since it names the machine from there.
    let text = read_to_string(&campaign).expect("a campaign");
    create_dir(folder.path("e")).expect("a folder");
    let campaign = folder.file("e/campaign.toml", text);
    let poses = read_to_string(folder.path("d/01-chosen.csv")).expect("it");
    write(folder.path("e/01-chosen.csv"), poses).expect("poses");
    let ran = trueaxis(&["plan", &campaign, "-o", &folder.path("e")]);
    assert!(ran.status == 2 && ran.err.contains("unwritable-file"), "{}", ran.err);
}

/// The length of a touch probe is the sum of two radii: one of them cannot be as large.
#[test]
fn a_ball_larger_than_the_length_of_the_probe_is_refused() {
    let folder = Folder::new("plan-large-ball");
    let text = read_to_string(command::root().join(CAMPAIGN)).expect("a campaign");
    let machine = command::root().join("machines").display().to_string();
    let text = text.replace("../../machines", &machine);
    for (ball, status) in [("25 mm", 0), ("30.9 mm", 0), ("31 mm", 2), ("40 mm", 2)] {
        let of = folder.file("c.toml", text.replace("\"25 mm\"", &format!("\"{ball}\"")));
        let ran = trueaxis(&["plan", &of]);
        assert_eq!(ran.status, status, "{ball} {}", ran.err);
        assert_eq!(ran.err.contains("error[contradiction]"), status == 2, "{}", ran.err);
    }
}

/// A dwell below 0 counted as 0.
#[test]
fn a_negative_dwell_is_an_error_with_its_place() {
    let folder = Folder::new("plan-dwell");
    let root = command::root();
    let text = read_to_string(root.join("examples/04_plan/probe-ball.toml")).expect("the campaign");
    let text = text.replace("../../", &format!("{}/", root.display()));
    let at = text.find("[[path]]").expect("a path") + "[[path]]\n".len();
    let line = text[..at].matches('\n').count() + 1;
    for (dwell, is_bad) in [("-1 s", true), ("0 s", false)] {
        let campaign = folder.path("c.toml");
        let rest = text[at..].lines().filter(|l| !l.starts_with("dwell"));
        let rest = rest.collect::<Vec<_>>().join("\n");
        write(&campaign, format!("{}dwell = \"{dwell}\"\n{rest}\n", &text[..at])).expect("written");
        let ran = trueaxis(&["plan", &campaign]);
        assert_eq!(ran.status == 2, is_bad, "{}", ran.err);
        assert_eq!(ran.err.contains("error[bad-dwell]"), is_bad, "{}", ran.err);
        assert_eq!(ran.err.contains(&format!("c.toml:{line}:")), is_bad, "{}", ran.err);
    }
}
