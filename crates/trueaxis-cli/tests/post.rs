//! `trueaxis post` as a user sees it.

mod command;

use command::{Folder, trueaxis};

const ENGRAVER: &str = "machines/i5-engraver/machine.toml";
const BANGLE: &str = "examples/06_compensate/bangle.cls";
const MILL: &str = "machines/three-axis-mill/machine.toml";
const PLATE: &str = "examples/06_compensate/plate.cls";

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

/// A path that is proved is not the whole file where words are not applied: the verdict, the document and the exit
/// status say so. What changes neither motion nor spindle nor coolant stays a note.
#[test]
fn words_that_are_not_applied_are_in_the_verdict() {
    let folder = Folder::new("post-not-applied");
    let out = folder.path("a.nc");
    let post = |words: &str, more: &[&str]| {
        let text =
            format!("UNITS/MM\nLOADTL/1\nFEDRAT/500\n{words}GOTO/0,0,9,0,0,1\nGOTO/9,0,9\nFINI\n");
        let file = folder.file("a.cls", text);
        let _ = std::fs::remove_file(&out);
        let arguments = ["post", ENGRAVER, &file, "--control", "fanuc", "-o", &out];
        trueaxis(&[&arguments, more].concat())
    };
    let ran = post("CUTCOM/LEFT\nAUXFUN/8\n", &["--verify"]);
    assert_eq!(ran.status, 1, "{}", ran.err);
    assert!(
        ran.out.contains("PATH: as the CL file; NOT APPLIED: 2 words, listed above"),
        "{}",
        ran.out
    );
    assert!(!ran.out.contains("PASS"), "{}", ran.out);
    assert!(std::path::Path::new(&out).exists());
    let ran = post("INSERT/M4\n", &[]);
    assert!(
        ran.status == 1 && ran.out.contains("NOT APPLIED: 1 word, listed above"),
        "{}",
        ran.out
    );
    for (words, count) in [("CYCLE/BORE,FEDTO,5,MMPM,50,RAPTO,3\n", 1), ("ABRACA/1\n", 1), ("", 0)]
    {
        let ran = post(words, &["--verify", "--format", "json"]);
        let found = ran.json();
        assert_eq!(
            (ran.status, &found["not_applied"]),
            (i32::from(count > 0), &count.into()),
            "{words}"
        );
        assert_eq!(
            (&found["written"], &found["verify"]["within_tolerance"]),
            (&true.into(), &true.into())
        );
    }
    let ran = post("GOHOME\nCLAMP/ON\n", &["--verify"]);
    assert!(ran.status == 0 && ran.out.contains("PASS"), "{}{}", ran.out, ran.err);
    // Points that a word displaces are displaced, or there is no program.
    let ran = post("TRANS/0,5,0\n", &["--verify"]);
    let program = std::fs::read_to_string(&out).expect("a program");
    assert!(ran.status == 0 && program.contains("Y5."), "{program}");
    for words in ["TRACUT/1,0,0,5,0,1,0,0,0,0,1,0\n", "ORIGIN/5,0,0\n", "ROTABL/90\n"] {
        let ran = post(words, &["--verify"]);
        assert!(ran.status == 2 && ran.err.contains("error[motion-not-read]"), "{}", ran.err);
        assert!(!std::path::Path::new(&out).exists());
    }
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

/// The frustum of Wu et al. 2022 as a program: whatever the control and the tolerance, the flank of the tool touches
/// the cone. Distance of a point P from a cone of half angle α and base radius R, h below its top: (ρ − R + (z + h)
/// tan α) cos α; for each point of the tool axis along the flank it must be the radius of the tool and the allowance.
#[test]
fn a_test_piece_becomes_a_program_that_cuts_it() {
    let gantry = "machines/xkas2525/machine.toml";
    let piece = "testpieces/nas979-gbt33150.toml";
    let (sin, cos) = 15f64.to_radians().sin_cos();
    let folder = Folder::new("post-test-piece");
    for (control, tolerance_mm) in [("sinumerik", 0.01), ("heidenhain", 0.01), ("sinumerik", 0.001)]
    {
        let program = folder.path(&format!("cone-{control}-{tolerance_mm}.nc"));
        let tolerance = tolerance_mm.to_string();
        let words = ["post", gantry, piece, "--control", control, "-o", &program, "--verify"];
        let ran = trueaxis(&[&words[..], &["--tolerance", &tolerance]].concat());
        assert_eq!(ran.status, 0, "{}", ran.err);
        let path = folder.path(&format!("path-{control}-{tolerance_mm}.csv"));
        let words = ["simulate", gantry, &program, "--control", control, "--no-report"];
        let ran = trueaxis(&[&words[..], &["--no-collisions", "--path", &path]].concat());
        assert_eq!(ran.status, 0, "{}", ran.err);
        let text = std::fs::read_to_string(&path).expect("the table");
        let mut lines = text.lines().map(|line| line.split(',').collect::<Vec<_>>());
        let names = lines.next().expect("a head");
        let column = |name: &str| names.iter().position(|n| *n == name).expect("a column");
        let columns =
            ["rapid", "line", "tip_x_mm", "tip_y_mm", "tip_z_mm", "axis_i", "axis_j", "axis_k"]
                .map(column);
        let rows: Vec<[f64; 8]> =
            lines.map(|row| columns.map(|c| row[c].parse().expect("a number"))).collect();
        let feeds = feeds(&std::fs::read_to_string(&program).expect("the program"));
        // Feed, height of the end above the base, allowance: Table 3, and the steps of the file.
        for (feed, height, allowance) in
            [(1500.0, 45.0, 0.0), (3000.0, 30.0, 0.5), (10_000.0, 15.0, 1.0), (30_000.0, 0.0, 1.5)]
        {
            let wanted = 10.0 + allowance;
            let mut azimuths = Vec::new();
            for [_, _, x, y, z, i, j, k] in
                rows.iter().filter(|r| r[0] == 0.0 && feeds[r[1] as usize] == feed)
            {
                let off = |s: f64| {
                    let (x, y, z) = (x + s * i, y + s * j, z + s * k);
                    (x.hypot(y) - 125.0 + (z + 60.0) * sin / cos) * cos
                };
                // The ways to the flank and back.
                if off(0.0) - wanted > 0.1 {
                    continue;
                }
                azimuths.push(y.atan2(*x).to_degrees());
                for s in [0.0, 0.5, 1.0].map(|share| share * (60.0 - height) / cos) {
                    let error = off(s) - wanted;
                    assert!(error.abs() < 2.0 * tolerance_mm, "{control} {feed} {s}: {error} mm");
                }
                // The end of the flank, where the tool touches, is at the height of the step.
                let touch_z = z - wanted * sin;
                assert!((touch_z - (height - 60.0)).abs() < 2.0 * tolerance_mm, "{touch_z}");
            }
            azimuths.sort_by(f64::total_cmp);
            let gap = azimuths.windows(2).map(|w| w[1] - w[0]).fold(0.0, f64::max);
            assert!(
                azimuths.len() > 72 && gap < 5.0,
                "{control} {feed}: {} points",
                azimuths.len()
            );
        }
    }
}

/// The feed that holds in each line of a program, from line 1.
fn feeds(program: &str) -> Vec<f64> {
    let mut feed = 0.0;
    let mut all = vec![0.0];
    for line in program.lines() {
        let word = line.split_whitespace().find_map(|word| word.strip_prefix('F')?.parse().ok());
        feed = word.unwrap_or(feed);
        all.push(feed);
    }
    all
}

#[test]
fn mistakes_in_a_test_piece_are_named() {
    let folder = Folder::new("post-test-piece-bad");
    let sound = std::fs::read_to_string(command::root().join("testpieces/nas979-gbt33150.toml"))
        .expect("the file");
    for (from, to, code) in [
        ("feed = \"3 m/min\"", "feed = \"0 m/min\"", "not-positive"),
        ("feed = \"3 m/min\"", "feed = \"3 rpm\"", "wrong-unit"),
        ("height = \"45 mm\"", "height = \"61 mm\"", "bad-value"),
        ("allowance = \"1 mm\"", "allowance = \"-1 mm\"", "bad-value"),
        ("allowance = \"1 mm\"", "alowance = \"1 mm\"", "unknown-key"),
        ("[cone]", "[cylinder]", "missing-key"),
    ] {
        let file = folder.path("piece.toml");
        std::fs::write(&file, sound.replace(from, to)).expect("a file");
        let out = folder.path("cone.mpf");
        let words =
            ["post", "machines/xkas2525/machine.toml", &file, "--control", "sinumerik", "-o", &out];
        let ran = trueaxis(&words);
        assert_eq!(ran.status, 2, "{to}");
        assert!(ran.err.contains(&format!("[{code}]")), "{to}: {}", ran.err);
        assert!(!std::path::Path::new(&out).exists());
    }
}

/// The first 754 bytes of the example end in `GOTO/0,30,-1`, where the file has `-10`: the hole would be 9 mm too high.
#[test]
fn a_file_that_was_cut_becomes_no_program() {
    let folder = Folder::new("post-cut");
    let whole = std::fs::read_to_string(command::root().join(PLATE)).expect("the example");
    let at = whole.find("GOTO/0,30,-10").expect("the hole") + "GOTO/0,30,-1".len();
    let ran = |text: &str| {
        let (file, out) = (folder.file("cut.cls", text), folder.path("cut.nc"));
        let all =
            ["post", MILL, &file, "--control", "fanuc", "--tcp", "length", "-o", &out, "--verify"];
        trueaxis(&all)
    };
    let cut = ran(&whole[..at]);
    assert_eq!((cut.status, cut.out.as_str()), (2, ""), "{}", cut.err);
    assert!(cut.err.contains("error[cut-file]: the file ends here within a line"), "{}", cut.err);
    assert_eq!(folder.names(), ["cut.cls"]);
    let open = ran(&format!("{}0\n", &whole[..at]));
    assert!(open.err.contains("is still on") && open.status == 2, "{}", open.err);
    let without_end = ran(whole.trim_end().strip_suffix("FINI").expect("FINI"));
    assert!(without_end.err.contains("warning[no-end]"), "{}", without_end.err);
    assert_eq!(without_end.status, 0);
}
