//! `trueaxis post` as a user sees it.

mod command;

use command::{Folder, trueaxis};

const ENGRAVER: &str = "machines/i5-engraver/machine.toml";
const BANGLE: &str = "examples/06_compensate/bangle.cls";

#[test]
fn the_document_has_the_agreed_keys() {
    let folder = Folder::new("post-json");
    let out = folder.path("bangle.nc");
    let ran = trueaxis(&[
        "post",
        ENGRAVER,
        BANGLE,
        "--control",
        "fanuc",
        "-o",
        &out,
        "--verify",
        "--format",
        "json",
    ]);
    assert_eq!((ran.status, ran.err.as_str()), (0, ""));
    let found = ran.json();
    assert_eq!(found["schema"], "trueaxis/post/1");
    assert_eq!(found["points"], 1203);
    assert_eq!(found["written"], true);
    let verify = &found["verify"];
    assert_eq!(verify["within_tolerance"], true);
    assert_eq!(verify["blocks_compared"], found["blocks"]);
    for key in ["tip_at_blocks_um", "axis_at_blocks_urad", "tip_on_path_um", "axis_on_path_deg"] {
        assert!(verify[key]["value"].is_f64(), "{key}");
        assert!(verify[key]["file_line"].is_u64(), "{key}");
    }
    assert!(verify["tip_on_path_um"]["value"].as_f64() < Some(10.1));
    assert_eq!(folder.names(), ["bangle.nc"]);
}

#[test]
fn a_written_program_is_simulated_like_any_other() {
    let folder = Folder::new("post-simulate");
    let out = folder.path("blade.mpf");
    let machine = "machines/xkas2525/machine.toml";
    let blade = "examples/06_compensate/blade.cls";
    let ran = trueaxis(&[
        "post",
        machine,
        blade,
        "--control",
        "sinumerik",
        "--tcp",
        "off",
        "-o",
        &out,
        "--verify",
    ]);
    assert_eq!(ran.status, 0, "{}", ran.err);
    assert!(ran.out.contains("retracts 2 times"), "{}", ran.out);
    let ran = trueaxis(&["simulate", machine, &out, "--no-report", "--no-collisions"]);
    assert_eq!(ran.status, 0, "{}{}", ran.out, ran.err);
}

#[test]
fn what_cannot_be_used_is_refused_with_its_line() {
    let folder = Folder::new("post-bad");
    let out = folder.path("out.nc");
    for (text, code, place) in [
        ("UNITS/MM\nFEDRAT/9\nGOTO/0,0,0\nGOTO/900,0,0\n", "leaves-travel", ":4:1"),
        ("UNITS/MM\nFEDRAT/9\nMULTAX/ON\nGOTO/0,0,0\n", "no-tool-axis", ":4:1"),
        ("UNITS/MM\nFEDRAT/9\nGOTO/0,0,0,0,0,0\n", "zero-tool-axis", ":3:1"),
        ("UNITS/MM\nFEDRAT/9\nGOTO/0,NaN,0\n", "bad-number", ":3:1"),
        ("UNITS/MM\nGOTO/0,0,0\n", "no-feed", ":2:1"),
        ("", "no-points", ""),
    ] {
        let file = folder.file("a.cls", text);
        let ran = trueaxis(&["post", ENGRAVER, &file, "--control", "fanuc", "-o", &out]);
        assert_eq!(ran.status, 2, "{text}{}", ran.err);
        assert!(ran.err.contains(&format!("error[{code}]")), "{code}: {}", ran.err);
        assert!(ran.err.contains(&format!("a.cls{place}")), "{place}: {}", ran.err);
        assert_eq!(folder.names(), ["a.cls"]);
    }
    let file = folder.file("a.cls", "UNITS/MM\nFEDRAT/9\nGOTO/0,0,0,0.6,0,0.8\n");
    let mill = "machines/three-axis-mill/machine.toml";
    let ran = trueaxis(&["post", mill, &file, "--control", "linuxcnc", "-o", &out]);
    assert!(ran.status == 2 && ran.err.contains("error[unreachable]"), "{}", ran.err);
    let bad = folder.file("bad.j2", "{% block start %}{{ nmae }}{% endblock %}");
    let template = ["--template", &bad];
    let ran = trueaxis(
        &[&["post", ENGRAVER, BANGLE, "--control", "fanuc", "-o", &out][..], &template].concat(),
    );
    assert!(ran.status == 2 && ran.err.contains("error[bad-template]"), "{}", ran.err);
}

#[test]
fn templates_are_shown_to_be_edited() {
    let folder = Folder::new("post-template");
    let ran = trueaxis(&["post", ENGRAVER, BANGLE, "--control", "fanuc", "--show-template"]);
    assert_eq!(ran.status, 0);
    let mine = folder.file("mine.j2", ran.out.replace("M30", "M99"));
    let out = folder.path("out.nc");
    let ran = trueaxis(&[
        "post",
        ENGRAVER,
        BANGLE,
        "--control",
        "fanuc",
        "-o",
        &out,
        "--template",
        &mine,
    ]);
    assert_eq!(ran.status, 0, "{}", ran.err);
    let text = std::fs::read_to_string(&out).expect("a program");
    assert!(text.contains("\nM99\n") && !text.contains("M30"));
}

#[test]
fn the_old_name_of_the_option_still_works_and_says_so() {
    let options = |name| ["post", ENGRAVER, BANGLE, name, "heidenhain", "--show-template"];
    let [old, new] = ["--dialect", "--control"].map(|name| trueaxis(&options(name)));
    assert_eq!((old.status, &old.out), (0, &new.out));
    assert!(old.err.contains("`--dialect` is now called `--control`"), "{}", old.err);
    assert_eq!(new.err, "");
}
