//! Readings and files that prove less than they seem to: what is not known, not applied or there twice is said.

mod command;

use command::{Folder, Ran, root, trueaxis};

const LASER: &str = "examples/07_verify/x-axis-laser.csv";

fn example(name: &str) -> String {
    std::fs::read_to_string(root().join("examples/07_verify").join(name)).expect("an example")
}

/// A copy of examples and machines, to be changed.
struct Copy(Folder);

impl Copy {
    fn new(name: &str, folders: &[&str]) -> Self {
        let folder = Folder::new(name);
        for from in folders {
            let to = folder.path(from);
            std::fs::create_dir_all(&to).expect("a folder");
            for file in std::fs::read_dir(root().join(from)).expect("a folder").flatten() {
                if file.path().is_file() {
                    let to = std::path::Path::new(&to).join(file.file_name());
                    std::fs::copy(file.path(), to).expect("a copy");
                }
            }
        }
        Self(folder)
    }

    fn change(&self, name: &str, of: impl Fn(&str) -> String) {
        let text = std::fs::read_to_string(self.0.path(name)).expect("a file");
        let changed = of(&text);
        assert_ne!(text, changed, "{name}");
        std::fs::write(self.0.path(name), changed).expect("a written file");
    }
}

#[track_caller]
fn says(ran: &Ran, status: i32, word: &str) {
    assert_eq!(ran.status, status, "{}{}", ran.out, ran.err);
    assert!(ran.err.contains(word), "no {word}: {}", ran.err);
}

fn first_line_of(ran: &Ran, word: &str) -> String {
    ran.out.lines().find(|l| l.contains(word)).unwrap_or_else(|| panic!("{}", ran.out)).to_owned()
}

#[test]
fn a_limit_of_a_history_has_the_unit_of_its_figure() {
    let files = ["examples/07_verify/history"];
    let run = |limit: &str| {
        let mut arguments = vec!["verify", "--history"];
        arguments.extend(files);
        arguments.extend(["--limit", limit]);
        trueaxis(&arguments)
    };
    says(&run("EC0X=5 um"), 2, "error[wrong-unit]");
    assert!(!run("EC0X=5 urad").err.contains("error["));
}

/// Two files of one name with different chains; the same file twice.
#[test]
fn a_history_is_that_of_one_chain_and_counts_a_measurement_once() {
    let mill = |chain: &str, year: &str, urad: &str| {
        format!(
            "[machine]\nname = \"mill\"\nchain = \"{chain}\"\n[location]\nmeasured = {{ date = {year}-03-01 }}\n\
             EC0Y = \"{urad} ± 2 urad\"\n"
        )
    };
    let folder = Folder::new("history-chain");
    let a = folder.file("a.toml", mill("w X' Y' b Z t", "2022", "10"));
    let b = folder.file("b.toml", mill("w b X Y Z t", "2023", "12"));
    says(&trueaxis(&["verify", "--history", &a, &b]), 2, "error[other-machine]");
    let c = folder.file("c.toml", mill("w X' Y' b Z t", "2023", "12"));
    let d = folder.file("d.toml", mill("w X' Y' b Z t", "2024", "19"));
    let copy = folder.file("copy-of-c.toml", mill("w X' Y' b Z t", "2023", "12"));
    let of = |files: &[&str]| {
        let mut arguments = vec!["verify", "--history"];
        arguments.extend(files);
        arguments.extend(["--format", "json"]);
        trueaxis(&arguments)
    };
    let (once, twice) = (of(&[&a, &c, &d]), of(&[&a, &c, &copy, &d, &a]));
    assert!(twice.err.contains("[same-date]"), "{}", twice.err);
    assert_eq!(once.json()["series"], twice.json()["series"]);
    assert_eq!(once.status, twice.status);
}

#[test]
fn tolerances_that_do_not_apply_are_named() {
    let folder = Folder::new("tolerances-not-applied");
    let conditions = example("x-axis-laser.toml");
    let run = |conditions: &str, tolerances: &str| {
        let conditions = folder.file("c.toml", conditions);
        let file = folder.file("t.toml", tolerances);
        let files = ["--conditions", &conditions, "--tolerances", &file, "--rule", "simple"];
        trueaxis(&[&["evaluate", "iso230-2", LASER][..], &files].concat())
    };
    let both = "[tolerance]\nA = \"20 um\"\n[axis.X]\nA = \"8 um\"\n";
    assert!(run(&conditions, both).out.contains("FAIL"));
    // Which of both holds is not known.
    let no_axis = conditions.replace("axis = \"X\"\n", "");
    says(&run(&no_axis, both), 2, "error[bad-tolerance]");
    for nothing in ["[axis.Y]\nA = \"1 um\"\n", ""] {
        says(&run(&conditions, nothing), 0, "warning[tolerances-unused]");
    }
}

#[test]
fn what_makes_u_of_a_positioning_test_too_small_is_said() {
    let folder = Folder::new("temperature-without-u");
    let stated = example("x-axis-laser.toml");
    let run = |conditions: &str, data: &str| {
        let conditions = folder.file("c.toml", conditions);
        trueaxis(&["evaluate", "iso230-2", data, "--conditions", &conditions])
    };
    assert_eq!(run(&stated, LASER).err, "");
    let without_u = stated.replace("21.9 ± 0.2 degC", "21.9 degC");
    says(&run(&without_u, LASER), 0, "warning[missing-uncertainty]");
    let lines = stated.lines().filter(|l| !l.starts_with("expansion"));
    let without_expansion = lines.collect::<Vec<_>>().join("\n");
    says(&run(&without_expansion, LASER), 0, "warning[missing-uncertainty]");
    let warm: String = example("x-axis-laser.csv")
        .lines()
        .map(|l| match l.rsplit_once(',') {
            Some((row, _)) if l.starts_with(|c: char| c == '-' || c.is_ascii_digit()) => {
                format!("{row},35.0\n")
            }
            _ => format!("{l}\n"),
        })
        .collect();
    says(&run(&stated, &folder.file("warm.csv", warm)), 0, "warning[other-temperature]");
}

#[test]
fn two_axes_are_not_one_axis() {
    let folder = Folder::new("two-axes");
    let rows = "target_mm,axis,run,direction,deviation_um\n0,X,1,up,1\n100,X,1,up,2\n0,Y,1,up,5\n";
    let file = folder.file("two.csv", rows);
    says(&trueaxis(&["evaluate", "iso230-2", &file]), 2, "error[several-axes]");
    let file = folder.file("one.csv", rows.replace(",Y,", ",x,"));
    says(&trueaxis(&["evaluate", "iso230-2", &file]), 0, "warning[unused-column]");
    // Nor are the readings of X written to Y.
    let mill = std::fs::read(root().join("machines/three-axis-mill/machine.toml")).expect("a mill");
    let machine = folder.file("machine.toml", mill);
    let ran = trueaxis(&["evaluate", "iso230-2", LASER, "--write-back", &machine, "Y"]);
    says(&ran, 2, "error[wrong-axis]");
    assert_eq!(folder.names(), ["machine.toml", "one.csv", "two.csv"]);
}

#[test]
fn edges_of_a_volume_are_those_of_its_diagonals() {
    let folder = Folder::new("edges");
    let data = "examples/07_verify/body-diagonals.csv";
    let stated = example("body-diagonals.toml");
    for (edges, code) in [
        ("-500 400 300 mm", "not-positive"),
        ("500 0 300 mm", "not-positive"),
        ("250 200 150 mm", "edges-differ"),
    ] {
        let conditions = folder.file("c.toml", stated.replace("500 400 300 mm", edges));
        let ran = trueaxis(&["evaluate", "iso230-6", data, "--conditions", &conditions]);
        says(&ran, 2, &format!("error[{code}]"));
    }
}

#[test]
fn a_column_of_a_mapping_file_is_used_once() {
    let folder = Folder::new("map-twice");
    let data = folder.file("a.csv", "P;V1;V2\n0;1,0;1,1\n100;3,0;3,1\n200;2,0;2,1\n");
    let map = |second: &str| {
        let column = |role: &str, heading: &str, unit: &str| {
            format!("[columns.{role}]\ncolumn = {heading}\nunit = \"{unit}\"\n")
        };
        let text = "separator = \";\"\ndecimal = \",\"\n".to_owned()
            + &column("target", "\"P\"", "mm")
            + &column("up_1", "\"V1\"", "um")
            + &column("up_2", second, "um");
        let map = folder.file("map.toml", text);
        trueaxis(&["evaluate", "iso230-2", &data, "--map", &map])
    };
    assert_eq!(map("\"V2\"").status, 0);
    // By its heading, and by its number.
    says(&map("\"V1\""), 2, "error[duplicate-column]");
    says(&map("2"), 2, "error[duplicate-column]");
}

/// A table that was pasted ten times, and a ring whose rows were.
#[test]
fn copied_hits_of_a_probe_count_once() {
    let folder = Folder::new("copied-hits");
    let conditions = "examples/07_verify/probe-performance.toml";
    let run = |name: &str, text: &str| {
        let file = folder.file(name, text);
        trueaxis(&["evaluate", "iso230-10", &file, "--conditions", conditions, "--format", "json"])
    };
    let text = example("probe-performance.csv");
    let (heads, rows): (Vec<&str>, Vec<&str>) =
        text.lines().partition(|l| l.starts_with('#') || l.starts_with("test"));
    let joined = |rows: &[&str]| format!("{}\n{}\n", heads.join("\n"), rows.join("\n"));
    let once = run("once.csv", &joined(&rows));
    let ring: Vec<&str> = rows.iter().copied().filter(|l| l.starts_with("ring")).collect();
    for more in [rows.repeat(10), [rows.clone(), ring.repeat(5)].concat()] {
        let ran = run("more.csv", &joined(&more));
        assert!(ran.err.contains("[copied-rows]"), "{}", ran.err);
        assert_eq!(ran.json()["quantities"], once.json()["quantities"]);
        assert_eq!(ran.status, once.status);
    }
}

/// As many numbers as the socket of a ball has unknowns agree with any machine.
#[test]
fn a_comparison_needs_more_numbers_than_its_set_up_has_unknowns() {
    let copy = Copy::new("one-reading", &["examples/07_verify", "machines/lei-hsu-mill"]);
    let rows = |count: usize| {
        move |text: &str| {
            let (heads, rows): (Vec<&str>, Vec<&str>) =
                text.lines().partition(|l| l.starts_with('#') || l.starts_with('C'));
            let kept = rows.into_iter().take(count);
            heads.into_iter().chain(kept).map(|l| format!("{l}\n")).collect()
        }
    };
    let run = || trueaxis(&["verify", &copy.0.path("examples/07_verify/probe-ball.toml")]);
    assert_eq!(run().status, 0);
    copy.change("examples/07_verify/probe-ball.csv", rows(1));
    let ran = run();
    says(&ran, 1, "warning[too-few-readings]");
    assert!(ran.out.contains("UNDECIDED: 0 numbers pass, 0 fail, 3 are undecided"), "{}", ran.out);
}

const CERTIFICATE: [&str; 3] =
    ["examples/07_verify", "examples/07_verify/xkas2525-tables", "machines/xkas2525"];

fn certify(copy: &Copy) -> Ran {
    trueaxis(&["verify", "--certificate", &copy.0.path("examples/07_verify/certificate.toml")])
}

#[test]
fn copied_poses_of_a_certificate_count_once() {
    let copy = Copy::new("certificate-copies", &CERTIFICATE);
    for name in ["before", "after"] {
        copy.change(&format!("examples/07_verify/certificate-{name}.csv"), |text| {
            let rows: Vec<&str> = text.lines().skip(2).collect();
            format!("{text}{}\n", rows.join("\n"))
        });
    }
    let ran = certify(&copy);
    says(&ran, 0, "warning[copied-rows]");
    assert!(ran.out.contains("all 24 poses"), "{}", ran.out);
}

#[test]
fn a_validation_is_later_than_its_compensation() {
    let copy = Copy::new("certificate-dates", &CERTIFICATE);
    let name = "examples/07_verify/certificate.toml";
    copy.change(name, |text| text.replace("date = 2026-03-04", "date = 2026-03-03"));
    assert_eq!(certify(&copy).status, 0);
    copy.change(name, |text| {
        let (compensation, validation) = text.split_once("[validation]").expect("both");
        format!("{compensation}[validation]{}", validation.replace("2026-03-03", "2026-03-01"))
    });
    says(&certify(&copy), 2, "error[bad-date]");
}

/// One pose says nothing about the rest of the zone; readings before that contradict the machine file are named.
#[test]
fn a_certificate_does_not_reach_beyond_its_readings() {
    let copy = Copy::new("certificate-one-pose", &CERTIFICATE);
    for name in ["before", "after"] {
        copy.change(&format!("examples/07_verify/certificate-{name}.csv"), |text| {
            text.lines().take(3).map(|l| format!("{l}\n")).collect()
        });
    }
    let ran = certify(&copy);
    says(&ran, 1, "warning[zone-not-covered]");
    let verdict = first_line_of(&ran, "UNDECIDED");
    assert!(verdict.contains("at one position of X Y Z"), "{verdict}");

    let copy = Copy::new("certificate-before", &CERTIFICATE);
    copy.change("examples/07_verify/certificate-before.csv", |text| {
        let moved = |line: &str| -> Option<String> {
            let (row, z) = line.rsplit_once(',')?;
            Some(format!("{row},{}\n", z.parse::<f64>().ok()? + 100.0))
        };
        text.lines().map(|l| moved(l).unwrap_or_else(|| format!("{l}\n"))).collect()
    });
    says(&certify(&copy), 0, "warning[not-as-predicted]");
}

/// Without a contribution U is not known, and not 0.
#[test]
fn no_budget_is_no_uncertainty_of_zero() {
    let file = "examples/07_verify/laser-before-after-x.toml";
    let found = trueaxis(&["verify", "--before-after", file, "--format", "json"]).json();
    let curves = found["curves"].as_array().expect("curves");
    let u = |laser: &str| {
        let curve = curves.iter().find(|c| c["laser"] == laser).expect("a curve");
        curve["U_um"].as_object().expect("U").clone()
    };
    assert!(u("laser").values().all(serde_json::Value::is_null), "{:?}", u("laser"));
    let of_material = u("laser-workpiece");
    assert!(of_material["A"].as_f64().expect("known") > 0.0, "{of_material:?}");
}

#[test]
fn an_empty_record_and_a_silent_history_prove_nothing() {
    let folder = Folder::new("empty-record");
    let empty = folder.file("empty.jsonl", "");
    let plan = "examples/08_live/gantry-mock.toml";
    says(&trueaxis(&["live", "replay", plan, &empty]), 2, "error[live-record]");
}

/// The correction would refuse what the forecast is made of.
#[test]
fn a_forecast_from_readings_outside_their_range_is_remarked_on() {
    let copy = Copy::new(
        "expect-range",
        &["examples/08_live", "examples/03_predict", "machines/gantry-001"],
    );
    let run = || {
        let plan = copy.0.path("examples/08_live/gantry-mock.toml");
        let log = copy.0.path("examples/03_predict/torque-arm-hall.csv");
        trueaxis(&["live", "expect", &plan, "--temperature-log", &log])
    };
    assert!(!run().err.contains("live-range"));
    copy.change("examples/08_live/gantry-mock.toml", |text| {
        let cut = |line: &str| match line.starts_with("range") {
            true => "range = [\"10 degC\", \"22 degC\"]\n".to_owned(),
            false => format!("{line}\n"),
        };
        text.lines().map(cut).collect()
    });
    says(&run(), 0, "warning[live-range]");
}
