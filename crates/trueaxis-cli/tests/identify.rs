//! `trueaxis identify CAMPAIGN.toml` as a user sees it.

mod command;

use command::{Folder, Ran, root, trueaxis};
use serde_json::Value;

const CAMPAIGN: &str = "examples/05_identify/probe-ball.toml";

#[test]
fn the_document_has_the_agreed_keys() {
    let ran = trueaxis(&["identify", CAMPAIGN, "--format", "json"]);
    assert_eq!(ran.status, 0, "{}", ran.err);
    let found = ran.json();
    assert_eq!(found["schema"], "trueaxis/identify/1");
    for error in found["errors"].as_array().expect("errors") {
        let value = ["value_um", "value_urad"].iter().any(|k| error.get(*k).is_some());
        let u = ["u_um", "u_urad"].iter().any(|k| error.get(*k).is_some());
        assert!(error["name"].is_string() && value && u, "{error}");
        assert!(error.get("u").is_some(), "{error}");
    }
    for of in found["unobservable"].as_array().expect("combinations") {
        for key in ["combination", "words", "resolve_with"] {
            assert!(of[key].is_string(), "{of}");
        }
    }
    for key in ["rms_in_um", "rms_held_out_um", "repeatability_um", "condition"] {
        assert!(found[key].as_f64().expect(key) > 0.0);
    }
    assert!(found["rank"].as_u64().expect("a rank") > 0);
    assert_eq!(found["verdict"]["key"], "explained");
}

#[test]
fn the_machine_file_is_new_and_the_input_stays() {
    let folder = Folder::new("identify-output");
    let machine = root().join("machines/lei-hsu-mill/machine.toml");
    let before = std::fs::read_to_string(&machine).expect("the machine file");
    let output = folder.path("found.toml");
    let page = folder.path("found.html");
    let ran = trueaxis(&["identify", CAMPAIGN, "-o", &output, "--report", &page]);
    assert_eq!(ran.status, 0, "{}", ran.err);
    let written = std::fs::read_to_string(&output).expect("the new file");
    assert!(written.contains("identified with probe-ball") && written.contains("2026-11-21"));
    assert!(written.contains("# Models for the collision check"), "comments stay");
    assert_eq!(trueaxis(&["check", &output]).status, 0);
    assert!(std::fs::read_to_string(&page).expect("a page").contains("Correlation"));
    let refused = trueaxis(&["identify", CAMPAIGN, "-o", "machines/lei-hsu-mill/machine.toml"]);
    assert_eq!(refused.status, 2);
    assert!(refused.err.contains("is read by this command"), "{}", refused.err);
    assert_eq!(std::fs::read_to_string(&machine).expect("the machine file"), before);
}

/// The example with other readings.
fn with_readings(folder: &Folder, change: impl Fn(usize, &str) -> String) -> String {
    let csv = root().join("examples/05_identify/probe-ball.csv");
    let csv = std::fs::read_to_string(csv).expect("the readings");
    let lines: Vec<String> = csv.lines().enumerate().map(|(i, line)| change(i, line)).collect();
    folder.file("readings.csv", lines.join("\n") + "\n");
    let text = std::fs::read_to_string(root().join(CAMPAIGN)).expect("the campaign");
    let machine = root().join("machines/lei-hsu-mill/machine.toml").display().to_string();
    let text = text
        .replace("../../machines/lei-hsu-mill/machine.toml", &machine)
        .replace("probe-ball.csv", "readings.csv");
    folder.file("campaign.toml", text)
}

fn refused(ran: &Ran, code: &str, place: &str) {
    assert_eq!(ran.status, 2, "{}", ran.err);
    assert!(ran.err.contains(&format!("error[{code}]")), "{code}: {}", ran.err);
    assert!(ran.err.contains(place), "{place}: {}", ran.err);
    assert!(ran.has_no_answer());
}

#[test]
fn bad_readings_get_no_confident_answer() {
    let folder = Folder::new("identify-bad");
    let same = |line: &str| line.to_owned();
    let cell = |line: &str, at: usize, value: &dyn Fn(&str) -> String| {
        let cells = line.split(',').enumerate();
        cells.map(|(i, c)| if i == at { value(c) } else { same(c) }).collect::<Vec<_>>().join(",")
    };
    let campaign = with_readings(&folder, |i, line| match i {
        9 => cell(line, 5, &|_| "nan".to_owned()),
        _ => same(line),
    });
    refused(&trueaxis(&["identify", &campaign]), "not-a-number", "readings.csv:10");
    // Few rows, and all in one place.
    let campaign = with_readings(&folder, |i, line| if i < 7 { same(line) } else { String::new() });
    refused(&trueaxis(&["identify", &campaign]), "too-few-readings", "campaign.toml");
    let first = std::cell::RefCell::new(String::new());
    let campaign = with_readings(&folder, |i, line| {
        if i == 3 {
            line.clone_into(&mut first.borrow_mut());
        }
        if i <= 3 { same(line) } else { first.borrow().clone() }
    });
    refused(&trueaxis(&["identify", &campaign]), "one-place", "campaign.toml");
    // A sign: the verdict is no, and the convention that fits is named.
    let campaign = with_readings(&folder, |i, line| {
        let negated = |z: &str| (-z.parse::<f64>().expect("a reading")).to_string();
        if i > 2 { cell(line, 7, &negated) } else { same(line) }
    });
    let ran = trueaxis(&["identify", &campaign]);
    assert_eq!(ran.status, 1, "{}{}", ran.out, ran.err);
    assert!(ran.out.contains("z with the opposite sign: the residual would fall"), "{}", ran.out);
    // The same file twice.
    let campaign = with_readings(&folder, |_, line| same(line));
    let text = std::fs::read_to_string(&campaign).expect("the campaign");
    let twice = text.replace("\"readings.csv\"", "[\"readings.csv\", \"readings.csv\"]");
    let campaign = folder.file("campaign.toml", twice);
    refused(&trueaxis(&["identify", &campaign]), "duplicate-file", "readings.csv");
    // Another unit: millimetres that no instrument reads.
    let campaign = with_readings(&folder, |_, line| line.replace("_um", "_mm"));
    refused(&trueaxis(&["identify", &campaign]), "impossible-value", "readings.csv:4");
}

#[test]
fn lost_rows_swapped_columns_and_a_ball_on_the_axis_are_told() {
    let folder = Folder::new("identify-reported");
    // Every place was read twice: of one a reading is lost.
    let campaign = with_readings(&folder, |i, line| match i {
        30 => String::new(),
        _ => line.to_owned(),
    });
    let ran = trueaxis(&["identify", &campaign]);
    assert!(ran.err.contains("warning[uneven-groups]"), "{}", ran.err);
    assert!(ran.err.contains("1 readings in this group, 2 in most"), "{}", ran.err);
    let campaign = with_readings(&folder, |i, line| match i {
        2 => line.replace("x_um,y_um", "y_um,x_um"),
        _ => line.to_owned(),
    });
    let ran = trueaxis(&["identify", &campaign]);
    assert_eq!(ran.status, 1, "{}{}", ran.out, ran.err);
    assert!(ran.out.contains("columns in the order y, x, z"), "{}", ran.out);
    // A ball on the axis of C: turning C moves nothing.
    let campaign = measured(
        &folder,
        "lei-hsu-mill",
        "[unknown]\nlocation = [\"EX0C\"]\n[instrument.probe]\nkind = \"probe-ball\"\n\
         ball = \"-60 -40 0 mm\"\nnoise = \"1 um\"\n[[path]]\nkind = \"C\"\nfrom = \"0 deg\"\n\
         to = \"330 deg\"\ncount = 12\n",
        str::to_owned,
    );
    let ran = trueaxis(&["identify", &campaign]);
    assert!(ran.err.contains("warning[on-axis]"), "{}", ran.err);
}

/// Powers up to the fourth over a travel of which a laser saw a quarter.
#[test]
fn powers_over_an_unmeasured_travel_are_told() {
    let folder = Folder::new("identify-range");
    let rest = |to: u32| {
        format!(
            "[unknown]\nlocation = []\n[unknown.motion]\nEXX = \"polynomial 4\"\n[instrument.probe]\n\
             kind = \"laser-line\"\ndirection = \"1 0 0\"\nnoise = \"1 um\"\n[[path]]\n\
             kind = \"targets\"\naxis = \"X\"\nfrom = \"0 mm\"\nto = \"{to} mm\"\ncount = 11\n"
        )
    };
    for (to, due) in [(800, true), (3000, false)] {
        let campaign = measured(&folder, "xkas2525", &rest(to), str::to_owned);
        let ran = trueaxis(&["identify", &campaign]);
        assert_eq!(ran.err.contains("warning[short-range]"), due, "{to} mm: {}", ran.err);
    }
}

/// A campaign with one instrument, `probe`, that was measured virtually; its readings changed.
fn measured(folder: &Folder, machine: &str, text: &str, change: impl Fn(&str) -> String) -> String {
    let machine = root().join("machines").join(machine).join("machine.toml");
    let text = format!("name = \"bad\"\nmachine = '{}'\n{text}", machine.display());
    let campaign = folder.file("campaign.toml", &text);
    let ran = trueaxis(&["measure", &campaign, "-o", &folder.path("measured")]);
    assert_eq!(ran.status, 0, "{}", ran.err);
    let csv = std::fs::read_to_string(folder.path("measured/probe.csv")).expect("the readings");
    folder.file("readings.csv", change(&csv));
    let noise = "noise = \"1 um\"";
    let named = text.replace(noise, &format!("{noise}\nreadings = \"readings.csv\""));
    folder.file("campaign.toml", named)
}

/// A stylus that reports a hit 31 mm from the ball touched something else.
#[test]
fn a_hit_on_the_wrong_side_is_refused_with_its_line() {
    const HITS: &str = "[unknown]\nlocation = [\"EX0C\", \"EY0C\"]\n[instrument.probe]\n\
        kind = \"touch-probe-ball\"\nstylus = \"0 0 -90 mm\"\nball = \"60 0 25 mm\"\n\
        length = \"15.5 mm\"\nnoise = \"1 um\"\n[[path]]\nkind = \"touch\"\nhits = 5\n\
        poses = [{ C = \"0 deg\" }, { C = \"90 deg\" }, { C = \"180 deg\" }, { C = \"-90 deg\" }]\n";
    let folder = Folder::new("identify-side");
    let campaign = measured(&folder, "i5-engraver", HITS, str::to_owned);
    let ran = trueaxis(&["identify", &campaign]);
    assert!(!ran.err.contains("wrong-side"), "{}", ran.err);
    let line = std::cell::Cell::new(0);
    let moved = |csv: &str| {
        let head = csv.lines().position(|l| l.contains("X,")).expect("a heading");
        let axis = csv.lines().nth(head).and_then(|l| l.split(',').position(|c| c == "X"));
        line.set(head + 8);
        let shifted = |cell: &str| (cell.parse::<f64>().expect("X") + 31.0).to_string();
        let cells = |line: &str| {
            let cells = line.split(',').enumerate();
            let cells = cells.map(|(k, c)| if Some(k) == axis { shifted(c) } else { c.to_owned() });
            cells.collect::<Vec<_>>().join(",")
        };
        let lines = csv.lines().enumerate();
        let lines = lines.map(|(i, l)| if i + 1 == head + 8 { cells(l) } else { l.to_owned() });
        lines.collect::<Vec<_>>().join("\n") + "\n"
    };
    let campaign = measured(&folder, "i5-engraver", HITS, moved);
    let place = format!("readings.csv:{}", line.get());
    refused(&trueaxis(&["identify", &campaign]), "wrong-side", &place);
}

#[test]
fn an_instrument_that_contradicts_the_others_is_named() {
    let folder = Folder::new("identify-conflict");
    let source = root().join("examples/05_identify");
    let machine = root().join("machines/lei-hsu-mill/machine.toml").display().to_string();
    for name in ["r-test.csv", "laser-x.csv"] {
        folder.file(name, std::fs::read(source.join(name)).expect("readings"));
    }
    // A bar in whose readings X and Y are swapped: the squareness has the other sign.
    let bar = std::fs::read_to_string(source.join("ball-bar.csv")).expect("readings");
    let mirrored: Vec<String> = bar
        .lines()
        .enumerate()
        .map(|(i, line)| match line.rsplit_once(',') {
            Some((rest, group)) if i > 2 => {
                let (axes, length) = rest.rsplit_once(',').expect("a length");
                let length: f64 = length.parse().expect("a length");
                format!("{axes},{},{group}", 300.0 - length)
            }
            _ => line.to_owned(),
        })
        .collect();
    folder.file("ball-bar.csv", mirrored.join("\n") + "\n");
    let text = std::fs::read_to_string(source.join("mixed-instruments.toml")).expect("a campaign");
    let text = text.replace("../../machines/lei-hsu-mill/machine.toml", &machine);
    let ran = trueaxis(&["identify", &folder.file("campaign.toml", text)]);
    assert!(ran.err.contains("warning[conflicting-instruments]"), "{}{}", ran.out, ran.err);
    assert!(ran.err.contains("contradicts the others"), "{}", ran.err);
}

#[test]
fn a_campaign_and_a_subcommand_do_not_mix() {
    assert_eq!(trueaxis(&["identify"]).status, 2);
    assert_eq!(trueaxis(&["identify", CAMPAIGN, "expansion", "x.toml"]).status, 2);
}

/// Both scales of the paper into one machine file, which shows the runs; nothing is overwritten.
#[test]
fn paper_two_scales_make_one_machine_file() {
    let folder = Folder::new("identify-scales");
    let out = folder.path("gantry");
    let [x, y] = ["x", "y"].map(|l| format!("examples/05_identify/{l}-axis-two-temperatures.toml"));
    let ran = trueaxis(&["identify", "expansion", &x, &y, "-o", &out, "--format", "json"]);
    assert_eq!(ran.status, 0, "{}", ran.err);
    let found = ran.json();
    // Zhang et al. 2019, section 1.4.2: 10.8 and 8.6 µm/(m·K), steel tape and glass.
    for (scale, (printed, material)) in [(0, (10.8, "steel tape")), (1, (8.6, "glass"))] {
        let scale = &found["scales"][scale];
        let (alpha, u) = (number(&scale["expansion_um_per_m_k"]), number(&scale["u_um_per_m_k"]));
        assert!((alpha - printed).abs() < u, "{alpha} ± {u}");
        assert_eq!(scale["materials"], serde_json::json!([material]));
        assert_eq!(scale["spline"].as_array().expect("pieces").len(), 10);
    }
    let machine = format!("{out}/machine.toml");
    assert_eq!(trueaxis(&["check", &machine]).status, 0);
    // The error of X at 3500 mm and 30.5 °C: 431 µm in the paper.
    let at =
        ["pose", &machine, "--at", "X=3500", "--temperature", "scale_x=30.5", "--format", "json"];
    let um = number(&trueaxis(&at).json()["deviation"]["tip_um"][0]);
    assert!((um - 431.0).abs() < 3.0, "{um}");
    let mut names: Vec<_> =
        std::fs::read_dir(&out).expect("made").flatten().map(|f| f.file_name()).collect();
    names.sort();
    assert_eq!(
        names,
        [
            ".trueaxis-written",
            "X-scale.csv",
            "X-spline.csv",
            "Y-scale.csv",
            "Y-spline.csv",
            "machine.toml"
        ]
    );
    // A second time it is no new folder.
    let again = trueaxis(&["identify", "expansion", &x, "-o", &out]);
    assert!(again.status == 2 && again.err.contains("unwritable-folder"), "{}", again.err);
}

/// What is wrong with the files of runs, before anything is written.
#[test]
fn scales_that_do_not_fit_are_refused() {
    let folder = Folder::new("identify-bad-scales");
    let table = root().join("examples/05_identify/y-axis-two-temperatures.csv");
    let table = std::fs::read_to_string(table).expect("the example");
    folder.file("t.csv", table);
    let machine = root().join("machines/gantry-001/machine.toml").display().to_string();
    let runs = "[run.cold]\ntemperature = \"29.3 ± 0.1 degC\"\n[run.warm]\ntemperature = \"33.8 ± 0.1 degC\"\n";
    let swapped = "[run.warm]\ntemperature = \"29.3 ± 0.1 degC\"\n[run.cold]\ntemperature = \"33.8 ± 0.1 degC\"\n";
    let none = "[run.cold]\n[run.warm]\ntemperature = \"33.8 degC\"\n";
    let on = |axis: &str| format!("machine = {machine:?}\naxis = \"{axis}\"\n");
    let out = folder.path("out");
    for (head, runs, code) in [
        (String::new(), runs, "missing-key"),
        (format!("machine = {machine:?}\n"), runs, "missing-key"),
        (on("Q"), runs, "unwritable-file"),
        (on("Z"), runs, "unwritable-file"),
        (on("Y"), swapped, "impossible-scale"),
        (on("Y"), none, "missing-key"),
    ] {
        let text = format!("name = \"y\"\ntable = \"t.csv\"\n{head}{runs}");
        let file = folder.file("y.toml", text);
        let ran = trueaxis(&["identify", "expansion", &file, "-o", &out]);
        assert!(ran.status == 2 && ran.err.contains(code), "{code}: {}", ran.err);
        assert!(!std::path::Path::new(&out).exists(), "{code}");
    }
    let file = folder.file("y.toml", format!("name = \"y\"\ntable = \"t.csv\"\n{}{runs}", on("Y")));
    let copied: String = std::fs::read_to_string(folder.path("t.csv"))
        .expect("written")
        .lines()
        .map(|l| if l.starts_with("230,") { format!("{l}\n{l}\n") } else { format!("{l}\n") })
        .collect();
    let table = std::fs::read_to_string(folder.path("t.csv")).expect("written");
    folder.file("t.csv", copied);
    let ran = trueaxis(&["identify", "expansion", &file]);
    assert!(ran.status == 2 && ran.err.contains("reading-twice"), "{}", ran.err);
    folder.file("t.csv", table);
    let twice = trueaxis(&["identify", "expansion", &file, &file, "-o", &out]);
    assert!(twice.status == 2 && twice.err.contains("axis-twice"), "{}", twice.err);
}

/// Readings for error tables as users spoil them.
#[test]
fn error_tables_name_what_is_wrong() {
    let folder = Folder::new("identify-bad-tables");
    let machine = root().join("machines/xkas2525/machine.toml").display().to_string();
    let sheet = |unit: &str, scale: f64| {
        let row = |i: i32| {
            let v = scale * f64::from(i * i) / 10.0;
            format!("{},1,up,{v}\n{},1,down,{v}\n", 620 * i, 620 * i)
        };
        format!("target_mm,run,direction,deviation_{unit}\n")
            + &(0..=10).map(row).collect::<String>()
    };
    folder.file("um.csv", sheet("um", 1.0));
    folder.file("mm.csv", sheet("mm", 2.0));
    folder.file("urad.csv", sheet("urad", 1.0));
    folder.file("twice.csv", sheet("um", 1.0) + "620,1,up,3\n");
    folder.file("one-side.csv", sheet("um", 1.0).replace("0,1,down,0\n", ""));
    folder.file("short.csv", sheet("um", 1.0).lines().take(9).collect::<Vec<_>>().join("\n"));
    folder.file("far.csv", sheet("um", 1.0) + "9000,1,up,1\n9000,1,down,1\n");
    folder.file(
        "c.csv",
        "target_deg,direction,deviation_um\n0,up,1\n90,up,2\n180,up,0\n270,up,1\n360,up,1\n",
    );
    for (error, table, more, status, code) in [
        ("EXX", "um.csv", "", 0, "missing-uncertainty"),
        ("EXX", "mm.csv", "", 2, "impossible-error"),
        ("EXX", "urad.csv", "", 2, "wrong-unit"),
        ("EAX", "um.csv", "", 2, "wrong-unit"),
        ("EXX", "twice.csv", "", 2, "reading-twice"),
        ("EXX", "one-side.csv", "", 2, "missing-side"),
        ("EXX", "short.csv", "", 2, "outside"),
        ("EXX", "far.csv", "", 2, "outside-travel"),
        ("EXU", "um.csv", "", 2, "unknown-axis"),
        ("EX0X", "um.csv", "", 2, "unknown-error-name"),
        ("EXX", "um.csv", "line = \"ends\"", 0, "idle-key"),
        ("EXX", "um.csv", "zero = \"-5 mm\"", 2, "zero-outside"),
        ("EXX", "um.csv", "reads = \"laser\"", 2, "unknown-word"),
        ("EXX", "no.csv", "", 2, "unreadable-file"),
        ("EXC", "c.csv", "", 2, "needs-partner"),
        ("EXC", "um.csv", "", 2, "wrong-axis"),
    ] {
        let text = format!(
            "name = \"t\"\nmachine = {machine:?}\n[readings.{error}]\ntable = \"{table}\"\n{more}\n"
        );
        let file = folder.file("t.toml", text);
        let ran = trueaxis(&["identify", "tables", &file]);
        assert!(
            ran.status == status && ran.err.contains(code),
            "{error} {table}: {code}: {}",
            ran.err
        );
        assert!(!ran.err.contains("unknown entry"), "{}", ran.err);
    }
    let file = folder.file("t.toml", format!("name = \"t\"\nmachine = {machine:?}\n"));
    assert!(trueaxis(&["identify", "tables", &file]).err.contains("nothing-read"));
}

/// A circle that is not the stated one, and what only looks like a table.
#[test]
fn circles_and_targets_that_mislead_are_refused() {
    let folder = Folder::new("identify-bad-circles");
    let machine = root().join("machines/xkas2525/machine.toml").display().to_string();
    let example = root().join("examples/05_identify/error-tables/circle-XY.csv");
    let circle = std::fs::read_to_string(example).expect("the example");
    folder.file("xy.csv", &circle);
    let ccw: Vec<&str> = circle.lines().filter(|l| !l.ends_with(",cw")).collect();
    folder.file("ccw.csv", ccw.join("\n"));
    let third: Vec<&str> = circle
        .lines()
        .enumerate()
        .filter(|(i, _)| *i < 3 || i % 360 > 120)
        .map(|(_, l)| l)
        .collect();
    folder.file("arc.csv", third.join("\n"));
    for (table, centre, radius, status, words) in [
        ("xy.csv", "3100 1250", "300", 0, ""),
        ("xy.csv", "1250 3100", "300", 2, "the stated centre"),
        ("xy.csv", "0 0", "300", 2, "the stated centre"),
        ("xy.csv", "3100 1250", "150", 2, "a radius of"),
        ("ccw.csv", "3100 1250", "300", 2, "in one direction"),
        ("arc.csv", "3100 1250", "300", 2, "have no points"),
    ] {
        let text = format!(
            "name = \"t\"\nmachine = {machine:?}\n[circle.XY]\ntable = \"{table}\"\ncentre = \"{centre} mm\"\n\
             radius = \"{radius} mm\"\nat = \"Z=-500\"\nu = \"0.3 um\"\n"
        );
        let file = folder.file("t.toml", text);
        let ran = trueaxis(&["identify", "tables", &file]);
        assert!(ran.status == status && ran.err.contains(words), "{table} {centre}: {}", ran.err);
    }
    // Measured positions instead of targets, and the same quantity twice.
    let row = |q: f64| format!("{q},up,1\n{q},down,1\n");
    let jitter: String = (0..=10)
        .flat_map(|i| [0.0, 0.001].map(|d| row(620.0 * f64::from(i) - d * f64::from(i.min(1)))))
        .collect();
    folder.file("jitter.csv", format!("target_mm,direction,deviation_um\n{jitter}"));
    folder.file(
        "double.csv",
        "target_mm,direction,deviation_um,deviation_mm\n0,up,1,1\n10,up,1,1\n20,up,1,1\n",
    );
    for (table, code) in [("jitter.csv", "targets-too-close"), ("double.csv", "duplicate-column")] {
        let text = format!(
            "name = \"t\"\nmachine = {machine:?}\n[readings.EXX]\ntable = \"{table}\"\nu = \"1 um\"\n"
        );
        let file = folder.file("t.toml", text);
        let ran = trueaxis(&["identify", "tables", &file]);
        assert!(ran.status == 2 && ran.err.contains(code), "{table}: {}", ran.err);
        assert!(!ran.err.contains("nothing-read"), "{}", ran.err);
    }
}

fn number(value: &serde_json::Value) -> f64 {
    value.as_f64().expect("a number")
}

/// A row of readings a thousandth as large, as millimetres under a heading in micrometres are.
fn as_millimetres(line: &str) -> String {
    let cells: Vec<&str> = line.split(',').collect();
    let small = |cell: &str| format!("{:.7}", cell.parse::<f64>().expect("a number") * 1e-3);
    match cells[..] {
        [c, a, x, y, z, ref read @ .., group] if c.parse::<f64>().is_ok() => {
            let read: Vec<String> = read.iter().map(|cell| small(cell)).collect();
            [c, a, x, y, z, &read.join(","), group].join(",")
        }
        _ => line.to_owned(),
    }
}

/// The axes in the units of their headings are what they are in mm and degrees.
#[test]
fn law_positions_may_have_any_unit_that_their_heading_states() {
    let folder = Folder::new("identify-units-of-axes");
    let told = |headings: [&str; 5], scales: [f64; 5]| {
        let campaign = with_readings(&folder, |_, line| {
            let mut cells: Vec<String> = line.split(',').map(str::to_owned).collect();
            match cells.len() {
                9 if cells[0] == "C" => cells.splice(..5, headings.map(str::to_owned)).count(),
                9 => {
                    let q = |i: usize| cells[i].parse::<f64>().expect("a number") * scales[i];
                    let all: [String; 5] = std::array::from_fn(|i| format!("{:.15e}", q(i)));
                    cells.splice(..5, all).count()
                }
                _ => 0,
            };
            cells.join(",")
        });
        trueaxis(&["identify", &campaign, "--format", "json"])
    };
    let errors = |ran: &Ran| -> Vec<f64> {
        assert_eq!(ran.status, 0, "{}", ran.err);
        let document = ran.json();
        let errors = document["errors"].as_array().expect("errors");
        // What cannot be separated has no value.
        let value = |e: &Value| e["value_um"].as_f64().or(e["value_urad"].as_f64());
        let values: Vec<f64> = errors.iter().filter_map(value).collect();
        assert!(values.len() > 5, "{errors:?}");
        values
    };
    let rad = 1f64.to_radians();
    let usual = errors(&told(["C", "A", "X", "Y", "Z"], [1.0; 5]));
    for (headings, scales) in [
        (["C_deg", "A_deg", "X_mm", "Y_mm", "Z_mm"], [1.0; 5]),
        (["C_rad", "A_arcsec", "X_in", "Y_um", "Z_m"], [rad, 3600.0, 1.0 / 25.4, 1e3, 1e-3]),
    ] {
        let others = errors(&told(headings, scales));
        let near = |(a, b): (&f64, &f64)| (a - b).abs() < 1e-6 * b.abs().max(1e-3);
        assert!(others.iter().zip(&usual).all(near), "{others:?} {usual:?}");
        assert_eq!(others.len(), usual.len());
    }
    refused(&told(["C_deg", "A_mm", "X", "Y", "Z"], [1.0; 5]), "wrong-unit", "readings.csv");
    refused(&told(["C", "C_deg", "X", "Y", "Z"], [1.0; 5]), "duplicate-column", "readings.csv");
}

#[test]
fn readings_below_their_noise_are_not_explained() {
    let folder = Folder::new("identify-below-noise");
    // Millimetres under a heading in µm leave a residual that is too good.
    let campaign = with_readings(&folder, |_, line| as_millimetres(line));
    let ran = trueaxis(&["identify", &campaign, "--format", "json"]);
    assert_eq!(ran.status, 1, "{}", ran.err);
    assert_eq!(ran.json()["verdict"]["key"], "below-noise");
    assert_eq!(ran.json()["verdict"]["good"], false);
    let shown = trueaxis(&["identify", &campaign]);
    assert!(shown.out.contains("of the noise: another unit"), "{}", shown.out);
    // Three poses leave three numbers beside the six of the set-up: too few to say so, on a machine without errors.
    let few = with_readings(&folder, |i, line| match i {
        0..=5 => as_millimetres(line),
        _ => String::new(),
    });
    let text = std::fs::read_to_string(&few).expect("the campaign");
    let list = text.lines().find(|line| line.starts_with("location = ")).expect("a list");
    let text = text.replace(list, "location = [\"EX0C\"]");
    let machine = root().join("machines/lei-hsu-mill/machine.toml").display().to_string();
    let described = std::fs::read_to_string(&machine).expect("the machine");
    let (chain, rest) = described.split_once("[location]").expect("errors");
    let (_, models) = rest.split_once("\n\n").expect("models");
    let bare = folder.file("bare.toml", format!("{chain}{models}"));
    let few = folder.file("few.toml", text.replace(&machine, &bare));
    let ran = trueaxis(&["identify", &few, "--format", "json"]);
    assert_eq!(ran.json()["readings"], 3, "{}", ran.err);
    assert_ne!(ran.json()["verdict"]["key"], "below-noise", "{}", ran.out);
}

#[test]
fn an_instrument_that_contradicts_the_others_is_not_explained() {
    let folder = Folder::new("identify-contradicts");
    let examples = root().join("examples/05_identify");
    let text =
        std::fs::read_to_string(examples.join("mixed-instruments.toml")).expect("a campaign");
    let mut text = text.replace("../../machines", &root().join("machines").display().to_string());
    for name in ["r-test.csv", "ball-bar.csv", "laser-x.csv"] {
        text = text.replace(name, &examples.join(name).display().to_string());
    }
    let plain = folder.file("plain.toml", text.clone());
    assert_eq!(trueaxis(&["identify", &plain]).status, 0);
    // All three channels the other way round: their residual alone is the same.
    let turned = folder.file("turned.toml", text.replace("reads = \"ball\"", "reads = \"tool\""));
    let ran = trueaxis(&["identify", &turned, "--format", "json"]);
    assert_eq!(ran.status, 1, "{}", ran.err);
    assert_eq!(ran.json()["verdict"]["key"], "instruments-contradict");
    assert!(ran.err.contains("conflicting-instruments"), "{}", ran.err);
}
