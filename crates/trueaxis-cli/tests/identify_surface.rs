//! `trueaxis identify surface` as users call it: from the plan over the log to the adapted path.

mod command;

use command::{Folder, Ran, root, trueaxis};
use std::collections::BTreeMap;

/// The study of the example with whole paths, so that it may lie anywhere.
fn study(folder: &Folder, changes: &[(&str, &str)]) -> String {
    let whole = |name: &str| root().join(name).display().to_string();
    let mut text =
        std::fs::read_to_string(whole("examples/04_plan/probe-surface.toml")).expect("the example");
    for (a, b) in [
        ("\"../../machines", format!("\"{}", whole("machines"))),
        ("\"bangle-", format!("\"{}", whole("examples/04_plan/bangle-"))),
        ("\"../05", format!("\"{}", whole("examples/05"))),
    ] {
        assert!(text.contains(a), "{a}");
        text = text.replace(a, &b);
    }
    for (a, b) in changes {
        assert!(text.contains(a), "{a}");
        text = text.replacen(a, b, 1);
    }
    folder.file("study.toml", text)
}

fn plan(study: &str, control: &str, out: &str) -> Ran {
    trueaxis(&["plan", "probe-surface", study, "--control", control, "-o", out])
}

/// Number of the point: deviation and U of it, µm.
fn found(ran: &Ran) -> BTreeMap<u64, [f64; 2]> {
    assert_eq!(ran.status, 0, "{}{}", ran.out, ran.err);
    let document = ran.json();
    let points = document["points"].as_array().expect("points");
    let entry = |p: &serde_json::Value| {
        let values = ["deviation_um", "U_um"].map(|k| p[k].as_f64().expect("µm"));
        (p["point"].as_u64().expect("a number"), values)
    };
    points.iter().map(entry).collect()
}

fn identify(hits: &str) -> Ran {
    trueaxis(&["identify", "surface", hits, "--format", "json"])
}

/// Deviations by place (1e-4 mm) of a table with `point,x,y,z,i,j,k,deviation…`.
fn table(text: &str) -> BTreeMap<[i64; 3], f64> {
    let rows = text.lines().filter(|l| l.starts_with(|c: char| c.is_ascii_digit()));
    let entry = |l: &str| {
        let cells: Vec<f64> = l.split(',').map(|c| c.parse().expect("a number")).collect();
        ([1, 2, 3].map(|i| (cells[i] * 1e4).round() as i64), cells[7])
    };
    rows.map(entry).collect()
}

fn true_blank() -> BTreeMap<[i64; 3], f64> {
    let path = root().join("examples/04_plan/bangle-true.csv");
    table(&std::fs::read_to_string(path).expect("the true blank"))
}

#[test]
fn the_deviations_of_the_example_are_the_true_ones_within_their_u() {
    let folder = Folder::new("hits-example");
    let out = folder.path("out");
    let truth = true_blank();
    for control in ["fanuc", "linuxcnc", "sinumerik", "heidenhain"] {
        let ran = plan("examples/04_plan/probe-surface.toml", control, &out);
        assert_eq!(ran.status, 0, "{control}: {}{}", ran.out, ran.err);
        let all = found(&identify(&format!("{out}/hits.toml")));
        let nominal = std::fs::read_to_string(format!("{out}/surface.csv")).expect("a table");
        let mut within = 0;
        for (number, row) in
            (1..).zip(nominal.lines().filter(|l| l.starts_with(|c: char| c.is_ascii_digit())))
        {
            let cells: Vec<f64> =
                row.split(',').take(4).map(|c| c.parse().expect("a number")).collect();
            let key = [1, 2, 3].map(|i| (cells[i] * 1e4).round() as i64);
            let [deviation, u] = all[&number];
            let error = deviation - truth[&key];
            assert!(error.abs() < 2.0, "{control}: point {number}: {error:+.2} µm");
            within += usize::from(error.abs() <= u);
        }
        assert!(all.len() > 60 && within * 100 >= 95 * all.len(), "{within} of {}", all.len());
    }
}

/// The example's log is by oracles/hits.py: matrices, the pre-travel by its formula, the blank by its formula.
#[test]
fn hits_of_another_chain_give_its_surface() {
    let data = root().join("crates/trueaxis-cli/tests/data/bangle-hits.csv");
    let data = std::fs::read_to_string(data).expect("the true deviations");
    let ran = identify("examples/05_identify/bangle-hits.toml");
    let all = found(&ran);
    let rows = data.lines().filter_map(|l| l.split_once(','));
    let truth: Vec<(u64, f64)> =
        rows.filter_map(|(n, d)| Some((n.parse().ok()?, d.parse().ok()?))).collect();
    assert_eq!((truth.len(), all.len()), (40, 40));
    for (number, deviation) in truth {
        let [found, u] = all[&number];
        assert!((found - deviation).abs() < u.min(0.6), "point {number}: {found} {deviation}");
    }
    // Without the errors of the machine and the pre-travel it would be another surface.
    let document = ran.json();
    let read = document["points"].as_array().expect("points").iter();
    let by =
        |key: &str| read.clone().map(|p| p[key].as_f64().expect("µm").abs()).fold(0.0, f64::max);
    assert!(by("by_machine_um") > 20.0 && by("by_probe_um") > 30.0);
}

/// The log that FN 16 writes: the Klartext program is gone through line by line, its touches trigger where the hits of
/// the virtual machine say, and the masks print the parameters.
fn klartext_log(out: &str) -> String {
    let read = |name: &str| std::fs::read_to_string(format!("{out}/{name}")).expect("a file");
    let virtual_log = read("virtual-hits.log");
    let mut hits = virtual_log.lines().filter(|l| l.starts_with('H'));
    let (mut q, mut log) = (BTreeMap::from([(3, 5.0)]), String::new());
    for line in read("surface.h").lines() {
        let block = line.split_once(' ').map_or("", |l| l.1);
        let assigned = block.strip_prefix('Q').and_then(|b| b.split_once(" = "));
        if let Some((number, Ok(value))) = assigned.map(|(n, v)| (n, v.parse::<f64>())) {
            q.insert(number.parse().expect("a number"), value);
        } else if block.starts_with("TCH PROBE 3.3") || block.starts_with("TCH PROBE 4.3") {
            let hit = hits.next().expect("a hit for every touch");
            for (axis, n) in ['X', 'Y', 'Z'].into_iter().zip(10..) {
                let word = hit.split(' ').find(|w| w.starts_with(axis)).expect("an axis");
                q.insert(n, word[1..].parse().expect("mm"));
            }
            q.insert(13, 0.0);
        } else if let Some(print) = block.strip_prefix("FN 16: F-PRINT TNC:\\TRUEAXIS\\") {
            assert!(q.get(&13).is_none_or(|v| *v == 0.0), "printed without a touch");
            let mask = read(print.split_once(" / ").expect("a log").0);
            let first = mask.lines().next().expect("a line").trim_end_matches(';');
            let (format, parameters) = first[1..].split_once('"').expect("a mask");
            let mut values = parameters.split(',').filter_map(|p| p.strip_prefix('Q'));
            let mut pieces = format.split('%');
            log += pieces.next().expect("text");
            for piece in pieces {
                let (size, rest) = piece.split_once('F').expect("a size");
                let (width, decimals) = size.split_once('.').expect("decimals");
                let [width, decimals] = [width, decimals].map(|n| n.parse().expect("a number"));
                let number: u32 = values.next().expect("a parameter").parse().expect("a number");
                log += &format!("{:>width$.decimals$}{rest}", q[&number]);
            }
            log += "\r\n";
        }
    }
    assert!(hits.next().is_none(), "a touch for every hit");
    log
}

#[test]
fn the_wall_of_the_bangle_holds_10_um_through_all_files() {
    let mut tables = Vec::new();
    for control in ["fanuc", "heidenhain"] {
        let folder = Folder::new(&format!("hits-chain-{control}"));
        let out = folder.path("out");
        let study = study(&folder, &[("\"4 mm\"", "\"2 mm\""), ("\"100 deg\"", "\"105 deg\"")]);
        let ran = plan(&study, control, &out);
        assert_eq!(ran.status, 0, "{}{}", ran.out, ran.err);
        let hits = format!("{out}/hits.toml");
        if control == "heidenhain" {
            let text = std::fs::read_to_string(&hits).expect("a study");
            std::fs::write(format!("{out}/klartext.log"), klartext_log(&out)).expect("a log");
            std::fs::write(&hits, text.replace("virtual-hits.log", "klartext.log"))
                .expect("a study");
        }
        let measured = folder.path("measured.csv");
        let ran = trueaxis(&["identify", "surface", &hits, "-o", &measured]);
        assert_eq!(ran.status, 0, "{control}: {}{}", ran.out, ran.err);
        let table = std::fs::read_to_string(&measured).expect("a table");
        let whole = |name: &str| root().join(name).display().to_string();
        let text = std::fs::read_to_string(whole("examples/06_compensate/bangle-adapt.toml"))
            .expect("a study");
        let text = text
            .replace("\"../../machines", &format!("\"{}", whole("machines")))
            .replace("\"bangle-measured.csv\"", "\"measured.csv\"")
            .replace("\"bangle-", &format!("\"{}", whole("examples/06_compensate/bangle-")));
        let adapted = |name: &str, text: &str| {
            let adapt = folder.file(name, text);
            let ran = trueaxis(&["compensate", "adapt", &adapt, "--no-report", "--format", "json"]);
            assert_eq!(ran.status, 0, "{control}, {name}: {}{}", ran.out, ran.err);
            ran.json()
        };
        let found = adapted("adapt.toml", &text);
        let walls = found["map"].as_array().expect("a map").iter();
        let off = walls.map(|c| (c["wall_after_mm"].as_f64().expect("mm") - 0.09).abs());
        assert!(off.clone().count() > 500);
        assert!(off.fold(0.0, f64::max) < 0.010, "{control}");
        if control == "fanuc" {
            // The study of the hits itself, in the place of its table: the same to the last digit.
            let direct = adapted("direct.toml", &text.replace("measured.csv", "out/hits.toml"));
            assert_eq!(direct["map"], found["map"]);
            // U of the rows is in U of the wall: without the column it is smaller, with a larger one it is larger.
            let rows = |change: &dyn Fn(&str, &str) -> String| {
                let line = |l: &str| match l.rsplit_once(',') {
                    Some((row, u)) if !l.starts_with('#') => change(row, u),
                    _ => l.to_owned(),
                };
                let text = table.lines().map(line).collect::<Vec<_>>().join("\n");
                folder.file("changed.csv", text);
            };
            let study = text.replace("measured.csv", "changed.csv").replace("1.5 um", "0.2 um");
            let u = |found: &serde_json::Value| {
                let cells = found["map"].as_array().expect("a map");
                let u = cells.iter().map(|c| c["u_wall_mm"].as_f64().expect("mm"));
                u.sum::<f64>() / cells.len() as f64
            };
            rows(&|row, u| format!("{row},{u}"));
            let stated = adapted("stated.toml", &study);
            rows(&|row, _| row.to_owned());
            let without = adapted("without.toml", &study);
            rows(&|row, u| match u.parse::<f64>() {
                Ok(u) => format!("{row},{}", 3.0 * u),
                Err(_) => format!("{row},{u}"),
            });
            let larger = adapted("larger.toml", &study);
            let all = [u(&without), u(&stated), u(&larger)];
            assert!(all[0] < all[1] && all[1] < 0.99 * all[2], "{all:?}");
            let common =
                |found: &serde_json::Value| found["field"]["common_um"].as_f64().expect("µm");
            assert!(common(&without) == 0.0 && common(&stated) > 0.1);
            assert!((common(&larger).hypot(0.2) / common(&stated).hypot(0.2) - 3.0).abs() < 1e-6);
        }
        tables.push(table);
    }
    // Three decimals of the table: the log of FN 16 has the same hits to 0.1 µm.
    let [a, b] = [&tables[0], &tables[1]].map(|t| self::table(t));
    assert!(a.len() > 100 && a.len() == b.len());
    assert!(a.iter().all(|(key, d)| (d - b[key]).abs() < 0.11));
}

/// Location errors known to ± 4 µm or µrad, drawn for every machine: the deviations err as much as U says.
#[test]
fn u_holds_on_machines_whose_errors_are_drawn() {
    let folder = Folder::new("hits-drawn");
    let machine = root().join("machines/i5-engraver/machine.toml");
    let text = std::fs::read_to_string(&machine).expect("a machine");
    let (before, rest) = text.split_once("[location]").expect("location errors");
    let (location, motion) = rest.split_once("[motion.C]").expect("error motions");
    let location = location.replace(" um\"", " ± 4 um\"").replace(" urad\"", " ± 4 urad\"");
    folder.file("machine.toml", format!("{before}[location]{location}[motion.C]{motion}"));
    let truth = true_blank();
    let (mut z, mut within) = (Vec::new(), 0);
    for seed in 1..=40 {
        let drawn = format!("[virtual]\ndraw = true\nseed = {seed}\n");
        let text =
            std::fs::read_to_string(study(&folder, &[("\"4 mm\"", "\"12 mm\"")])).expect("a study");
        let line =
            text.lines().find(|l| l.starts_with("machine = ")).expect("a machine").to_owned();
        let text = text.replace(&line, "machine = \"machine.toml\"").replace("[virtual]\n", &drawn);
        let out = folder.path(&format!("out-{seed}"));
        let ran = plan(&folder.file("drawn.toml", text), "fanuc", &out);
        assert_eq!(ran.status, 0, "{}{}", ran.out, ran.err);
        let document = identify(&format!("{out}/hits.toml")).json();
        for p in document["points"].as_array().expect("points") {
            let key =
                [0, 1, 2].map(|i| (p["point_mm"][i].as_f64().expect("mm") * 1e4).round() as i64);
            let [d, u] = ["deviation_um", "U_um"].map(|k| p[k].as_f64().expect("µm"));
            z.push(2.0 * (d - truth[&key]) / u);
            within += usize::from((d - truth[&key]).abs() <= u);
        }
    }
    // All points of a machine err together: 40 machines, not 360 independent points.
    let spread = (z.iter().map(|z| z * z).sum::<f64>() / z.len() as f64).sqrt();
    assert!(z.len() > 300 && (0.75..1.3).contains(&spread), "{spread}");
    assert!(within * 100 >= 86 * z.len(), "{within} of {}", z.len());
}

/// The log and the study of a plan, and what a changed one gives.
struct Chain {
    folder: Folder,
    log: String,
    hits: String,
}

impl Chain {
    fn new(name: &str) -> Self {
        let folder = Folder::new(name);
        let study = study(&folder, &[("\"4 mm\"", "\"8 mm\"")]);
        let out = folder.path("out");
        let ran = plan(&study, "fanuc", &out);
        assert_eq!(ran.status, 0, "{}{}", ran.out, ran.err);
        let read = |name: &str| std::fs::read_to_string(format!("{out}/{name}")).expect("a file");
        Self { log: read("virtual-hits.log"), hits: read("hits.toml"), folder }
    }

    fn with(&self, log: &str, hits: &str) -> Ran {
        std::fs::write(self.folder.path("out/virtual-hits.log"), log).expect("a log");
        std::fs::write(self.folder.path("out/hits.toml"), hits).expect("a study");
        identify(&self.folder.path("out/hits.toml"))
    }

    /// Positions of the linear axes changed line by line.
    fn moved(&self, heading: &str, change: impl Fn(char, f64) -> f64) -> String {
        let mut text = String::new();
        for line in self.log.lines() {
            if !line.starts_with('H') {
                text += &format!("{}\n", line.replace("TRUEAXIS HITS MM MACHINE", heading));
                continue;
            }
            let words = line.split(' ').map(|word| {
                let (letter, value) = word.split_at(1);
                let letter = letter.chars().next().expect("a letter");
                match "XYZ".contains(letter) {
                    true => format!("{letter}{:.7}", change(letter, value.parse().expect("mm"))),
                    false => word.to_owned(),
                }
            });
            text += &format!("{}\n", words.collect::<Vec<_>>().join(" "));
        }
        text
    }
}

#[test]
fn unit_form_and_order_of_words_do_not_matter() {
    let chain = Chain::new("hits-forms");
    let plain = found(&chain.with(&chain.log, &chain.hits));
    let inch = chain.moved("TRUEAXIS HITS INCH MACHINE", |_, v| v / 25.4);
    let backwards = |line: &str| {
        let mut words: Vec<&str> = line.split(' ').collect();
        words.reverse();
        words.join(" ")
    };
    let turned =
        chain.log.lines().map(|l| if l.starts_with('H') { backwards(l) } else { l.to_owned() });
    // DPRNT puts blanks between letter and number, LinuxCNC six decimals after every number.
    let spaced =
        chain.log.replace(" X", "  X  ").replace(" T5", " T5.000000").replace('\n', "\r\n");
    for log in [inch, turned.collect::<Vec<_>>().join("\n"), spaced, chain.log.to_lowercase()] {
        let other = found(&chain.with(&log, &chain.hits));
        assert_eq!(other.len(), plain.len());
        for (number, [deviation, u]) in &other {
            assert!(
                (deviation - plain[number][0]).abs() < 0.01 && (u - plain[number][1]).abs() < 0.01
            );
        }
    }
}

#[test]
fn mistakes_are_named_with_their_row() {
    let chain = Chain::new("hits-bad");
    let lines: Vec<&str> = chain.log.lines().collect();
    let line =
        |n: usize| lines.iter().position(|l| l.starts_with(&format!("H{n} "))).expect("a hit");
    let changed = |n: usize, from: &str, to: &str| {
        let mut all: Vec<String> = lines.iter().map(|l| (*l).to_owned()).collect();
        assert!(all[line(n)].contains(from));
        all[line(n)] = all[line(n)].replacen(from, to, 1);
        all.join("\n")
    };
    let without = |n: usize| {
        let kept = lines.iter().enumerate().filter(|(i, _)| *i != line(n)).map(|(_, l)| *l);
        kept.collect::<Vec<_>>().join("\n")
    };
    let swapped = |a: usize, b: usize| {
        let mut all = lines.clone();
        all.swap(line(a), line(b));
        all.join("\n")
    };
    // The positions of one hit with the number of the other.
    let exchanged = |a: usize, b: usize| {
        let tail = |n: usize| lines[line(n)].split_once(" T").expect("a tool").1;
        let mut all: Vec<String> = lines.iter().map(|l| (*l).to_owned()).collect();
        all[line(a)] = format!("H{a} K{a} T{}", tail(b));
        all[line(b)] = format!("H{b} K{b} T{}", tail(a));
        all.join("\n")
    };
    let hits = chain.hits.clone();
    let other = |from: &str, to: &str| {
        assert!(hits.contains(from), "{from}\n{hits}");
        hits.replacen(from, to, 1)
    };
    let first = line(1) + 1;
    let log = chain.log.clone();
    // Through the wall: 2.24 mm deeper along Y and Z, as the probe stands inclined.
    let deeper = {
        let words: Vec<f64> = lines[line(2)]
            .split(' ')
            .filter(|w| "YZ".contains(&w[..1]))
            .map(|w| w[1..].parse().expect("mm"))
            .collect();
        let [y, z] = [words[0], words[1]];
        let text = changed(
            2,
            &format!("Y{y:.4}"),
            &format!("Y{:.4}", y + 2.24 * 25_f64.to_radians().sin()),
        );
        text.replacen(
            &format!("Z{z:.4}"),
            &format!("Z{:.4}", z - 2.24 * 25_f64.to_radians().cos()),
            1,
        )
    };
    let cases = [
        (log.clone(), other("log = ", "# log = "), "missing-log", None),
        (log.clone(), other("calibration = ", "# calibration = "), "missing-calibration", None),
        (log.clone(), other("stylus = \"long\"", ""), "unknown-stylus", None),
        (log.clone(), other("stylus = \"long\"", "stylus = \"short\""), "other-ball", None),
        (log.clone(), other("tool = 5", "tool = 6"), "other-tool", Some(first)),
        (
            log.clone(),
            other("points = \"surface.csv\"", "points = \"no.csv\""),
            "unreadable-file",
            None,
        ),
        (changed(3, " T5", ""), hits.clone(), "missing-tool", Some(line(3) + 1)),
        (changed(3, " X", " Q"), hits.clone(), "missing-word", Some(line(3) + 1)),
        (changed(3, "H3", "H3 three"), hits.clone(), "unknown-line", Some(line(3) + 1)),
        (without(4), hits.clone(), "lost-hits", Some(line(5))),
        (lines[..line(9)].join("\n"), hits.clone(), "lost-hits", None),
        (swapped(4, 6), hits.clone(), "hits-out-of-order", Some(line(5) + 1)),
        (exchanged(4, 5), hits.clone(), "hits-out-of-order", Some(line(4) + 1)),
        (changed(4, "K4", "K5"), hits.clone(), "hits-out-of-order", Some(line(4) + 1)),
        (deeper, hits.clone(), "wrong-face", Some(line(2) + 1)),
        (
            chain.moved("TRUEAXIS HITS MM MACHINE", |_, v| v / 25.4),
            hits.clone(),
            "wrong-unit",
            Some(first),
        ),
        (
            chain.moved("TRUEAXIS HITS INCH MACHINE", |_, v| v),
            hits.clone(),
            "wrong-unit",
            Some(first),
        ),
        (
            chain.moved(
                "TRUEAXIS HITS MM MACHINE",
                |axis, v| if axis == 'Z' { v - 90.0 } else { v },
            ),
            hits.clone(),
            "other-frame",
            Some(first),
        ),
        (log.replace("MACHINE", "G54"), hits.clone(), "other-frame", Some(2)),
        (log.replace("TRUEAXIS HITS MM MACHINE\n", ""), hits.clone(), "no-heading", Some(2)),
        (String::new(), hits.clone(), "too-few-hits", None),
        (log.replace("K2 T5", "K2 T1e999"), hits.clone(), "unknown-axis", Some(line(2) + 1)),
    ];
    for (log, hits, code, row) in cases {
        let ran = chain.with(&log, &hits);
        assert_eq!(ran.status, 2, "{code}: {}{}", ran.out, ran.err);
        assert!(ran.err.contains(&format!("[{code}]")), "{code}: {}", ran.err);
        if let Some(row) = row {
            let place = format!("virtual-hits.log:{row}:");
            assert!(ran.err.contains(&place), "{code}: {place}\n{}", ran.err);
        }
        assert!(ran.has_no_answer(), "{code}");
    }
    // Lost hits may be allowed: their points have no deviation then.
    let some = found(&chain.with(&without(4), &format!("may_be_lost = true\n{hits}")));
    assert!(!some.contains_key(&4) && some.contains_key(&5));
}

#[test]
fn a_plan_without_a_virtual_machine_says_what_is_missing() {
    let folder = Folder::new("hits-real");
    let text = std::fs::read_to_string(study(&folder, &[])).expect("a study");
    let real = text.split("# A true machine").next().expect("a study").to_owned();
    let real = folder.file("real.toml", real);
    let out = folder.path("out");
    assert_eq!(plan(&real, "linuxcnc", &out).status, 0);
    assert!(!std::path::Path::new(&format!("{out}/virtual-hits.log")).exists());
    let ran = identify(&format!("{out}/hits.toml"));
    assert_eq!(ran.status, 2);
    assert!(
        ran.err.contains("[missing-log]") && ran.err.contains("surface-hits.log"),
        "{}",
        ran.err
    );
}
