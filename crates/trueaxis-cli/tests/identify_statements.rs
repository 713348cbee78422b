//! What a campaign states and what a machine file can state, against what the readings know.

mod command;

use command::{Folder, root, trueaxis};

/// A ball-bar on the table of the head-table machine whose ball lies so far from where it is stated to 5 µm.
fn campaign(folder: &Folder, off_um: f64) -> String {
    let machine = root().join("machines/head-table/machine.toml");
    folder.file(
        "campaign.toml",
        format!(
            r#"name = "bar"
machine = "{}"
[unknown]
location = "minimal"
[instrument.bar]
kind = "ball-bar"
spindle_ball = "0 0 -110 mm"
table_ball = "150 60 40 mm"
length = "150 mm"
noise = "1 um"
readings = "readings/bar.csv"
unknown = {{ table_ball = "5 um", length = "free" }}
[[path]]
kind = "random"
B = ["-60 deg", "60 deg"]
C = ["-170 deg", "170 deg"]
count = 120
seed = 3
[truth]
errors = {{ EX0C = "14 um", EA0C = "23 urad", EC0Y = "20 urad", EX0B = "8 um" }}
setup = {{ table_ball_x = "{off_um} um", table_ball_y = "-3 um" }}
seed = 5
"#,
            machine.display()
        ),
    )
}

fn measured(folder: &Folder, off_um: f64) -> String {
    let campaign = campaign(folder, off_um);
    let ran = trueaxis(&["measure", &campaign, "-o", &folder.path("readings"), "--force"]);
    assert_eq!(ran.status, 0, "{}", ran.err);
    campaign
}

/// The readings place the ball to half a micrometre, wherever it is stated: a statement that is seven times its uncertainty off is wrong.
#[test]
fn a_set_up_that_the_readings_contradict_is_not_explained() {
    let folder = Folder::new("identify-set-up");
    for (off_um, key) in
        [(6.0, "explained"), (35.0, "set-up-contradicted"), (-35.0, "set-up-contradicted")]
    {
        let ran = trueaxis(&["identify", &measured(&folder, off_um), "--format", "json"]);
        let verdict = &ran.json()["verdict"];
        assert_eq!(verdict["key"], key, "{}", ran.err);
        assert_eq!(ran.status, i32::from(key != "explained"));
        let words = verdict["words"].to_string();
        assert_eq!(words.contains("`table_ball_x` of `bar`"), key != "explained", "{words}");
    }
}

/// Of sums of errors a machine file has nothing: that it misses the readings is said with figures, and only where it does.
#[test]
fn a_machine_file_without_sums_of_errors_says_what_it_misses() {
    let folder = Folder::new("identify-partial-file");
    let campaign = measured(&folder, 6.0);
    let output = folder.path("machine.toml");
    let ran = trueaxis(&["identify", &campaign, "-o", &output]);
    assert_eq!(ran.status, 0, "{}", ran.err);
    assert!(ran.err.contains("warning[partial-machine-file]"), "{}", ran.err);
    // Three errors that are all observable: nothing is missing.
    let text = std::fs::read_to_string(&campaign).expect("the campaign");
    let few = text.replace("location = \"minimal\"", "location = [\"EX0C\", \"EA0C\", \"EC0Y\"]");
    let few = folder.file("few.toml", few);
    let ran = trueaxis(&["identify", &few, "-o", &output, "--force"]);
    assert!(!ran.err.contains("partial-machine-file"), "{}", ran.err);
    assert_eq!(ran.status, 0, "{} {}", ran.out, ran.err);
}
