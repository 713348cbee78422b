//! A drift that a campaign lists: its rate with U, errors that do not suffer from it, and what it needs to be found.

mod library;

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::Arc;
use trueaxis_calibrate::identify::covariance_file::covariance_file;
use trueaxis_calibrate::identify::errors::{Identification, identify};
use trueaxis_calibrate::identify::machine_file::machine_file;
use trueaxis_calibrate::identify::records::{Options, Records, read_options, read_records};
use trueaxis_calibrate::plan::{planned, read_plan};
use trueaxis_geometry::Mat3;
use trueaxis_input::{Diagnostics, Files};
use trueaxis_machine::file::Folder;
use trueaxis_measure::instruments::instrument::SetupError;
use trueaxis_measure::measure::virtual_campaign::{Truth, VirtualCampaign, measure, read_virtual};
use trueaxis_measure::measure::{Campaign, Readings, read_campaign};
use trueaxis_measure::unknowns::design::{Design, Unknown};
use trueaxis_measure::unknowns::fit::{Fit, fit};
use trueaxis_measure::unknowns::unlisted::Follows;
use trueaxis_nc::Control;

fn folder() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../examples/05_identify")
}

fn path() -> PathBuf {
    folder().join("drift-in-memory.toml")
}

/// A probe on a ball of the Lei-Hsu mill for an hour and a half, on a drift of some µm/h.
const CAMPAIGN: &str = r#"
name = "an hour and a half"
machine = "../../machines/lei-hsu-mill/machine.toml"
[unknown]
location = ["EX0C", "EY0C", "EB0C", "EY0A", "EZ0A", "EA0A", "EB0A", "EC0A", "EC0X", "EA0Z", "EB0Z"]
[instrument.probe]
kind = "probe-ball"
socket = "0 0 -330 mm"
noise = "1 um"
reads = "ball"
readings = "drift.csv"
unknown = { ball = "free", socket = "5 um", drift = "free" }
[[path]]
kind = "C"
from = "0 deg"
to = "330 deg"
count = 12
at = { A = "20 deg" }
dwell = "100 s"
[[path]]
kind = "A"
from = "-40 deg"
to = "60 deg"
count = 11
at = { C = "70 deg" }
dwell = "100 s"
[[path]]
kind = "random"
A = ["-50 deg", "70 deg"]
C = ["0 deg", "350 deg"]
count = 30
seed = 5
dwell = "100 s"
[truth]
setup = { ball_x = "30 um", ball_y = "-12 um", drift_x = "5 um/h", drift_y = "-3 um/h", drift_z = "8 um/h" }
"#;

/// The campaign with these tables.
fn files(campaign: &str, table: &str) -> Files {
    let mut all = BTreeMap::new();
    all.insert(path(), campaign.to_owned());
    all.insert(folder().join("drift.csv"), table.to_owned());
    library::disk().with_texts(all)
}

fn virtually(campaign: &str, seed: u64) -> (Campaign, VirtualCampaign) {
    let (read, problems) =
        read_campaign(&files(campaign, ""), &path(), |r, c| read_virtual(r, c, Some(seed)));
    read.unwrap_or_else(|| panic!("{problems:?}"))
}

/// The readings of a seed as a table.
fn table(campaign: &str, seed: u64) -> String {
    let (campaign, real) = virtually(campaign, seed);
    let read = measure(&campaign, &real).expect("readings").readings;
    read.table(&campaign.machine, &campaign.instruments[0], 0)
}

/// What is found in a table, and what was said.
fn told(campaign: &str, table: &str) -> (Option<(Campaign, Identification, Records)>, Diagnostics) {
    let read = read_campaign(&files(campaign, table), &path(), |root, _| Some(read_options(root)));
    let (Some((campaign, options)), mut problems) = read else { return (None, read.1) };
    let options = Options { predicts: false, ..options };
    let Some(records) = read_records(&campaign, &mut problems) else { return (None, problems) };
    let found = identify(&campaign, &options, &records, &mut problems);
    (found.map(|found| (campaign, found, records)), problems)
}

fn found(campaign: &str, table: &str) -> (Campaign, Identification, Records) {
    let (found, problems) = told(campaign, table);
    found.unwrap_or_else(|| panic!("{problems:?}"))
}

fn value(found: &Identification, name: &str) -> (f64, f64) {
    let of = found.found.iter().find(|f| f.name == name);
    of.and_then(|f| f.value).unwrap_or_else(|| panic!("{name} is not stated"))
}

/// The fit of the readings of a seed.
fn fitted(campaign: &Campaign, real: &VirtualCampaign, seed: u64) -> (Design, Fit) {
    let truth = Truth { seed, ..real.truth.clone() };
    let real = VirtualCampaign { truth, ..real.clone() };
    let readings = measure(campaign, &real).expect("readings").readings;
    let design = campaign.design().from_first_readings(&readings);
    let fit = fit(&design, &readings, &[]).expect("a fit");
    (design, fit)
}

/// Rates and errors of many campaigns lie within their 95 % intervals as often as they say; a drift that is not listed
/// displaces them.
#[test]
fn law_a_listed_drift_is_covered() {
    // A prior that the truth does not vary within would make intervals too wide.
    let exact = CAMPAIGN.replace("socket = \"5 um\"", "socket = \"0.001 um\"");
    let (campaign, real) = virtually(&exact, 1);
    let (mut inside, mut all, mut rates) = (0_u32, 0_u32, [0_u32; 2]);
    for seed in 0..150 {
        let (design, fit) = fitted(&campaign, &real, seed);
        for k in 0..design.unknowns() {
            let name = design.unknown(k).expect("in range").name();
            let truth = match name.as_str() {
                "probe.drift_x" => 0.005,
                "probe.drift_y" => -0.003,
                "probe.drift_z" => 0.008,
                "EX0C" => 0.009,
                "EA0A" => 40e-6,
                "EC0X" => 31e-6,
                "EA0Z" => -26e-6,
                _ => continue,
            };
            if !fit.sight.is_seen[k] {
                continue;
            }
            let is_in = (fit.values[k] - truth).abs() < 1.96 * fit.covariance[(k, k)].sqrt();
            (inside, all) = (inside + u32::from(is_in), all + 1);
            if name.contains("drift") {
                rates = [rates[0] + u32::from(is_in), rates[1] + 1];
            }
        }
    }
    let share = |part: u32, of: u32| f64::from(part) / f64::from(of);
    assert!(all >= 150 * 6, "{all}");
    assert!((0.93..0.97).contains(&share(inside, all)), "{}", share(inside, all));
    assert!((0.92..0.98).contains(&share(rates[0], rates[1])), "{}", share(rates[0], rates[1]));
}

#[test]
fn a_listed_drift_is_told_and_belongs_to_no_machine() {
    let (campaign, found, records) = found(CAMPAIGN, &table(CAMPAIGN, 3));
    assert!(found.verdict.is_good(), "{:?}", found.verdict);
    for (name, truth) in [("x", 0.005), ("y", -0.003), ("z", 0.008)] {
        let (rate, u) = value(&found, &format!("probe.drift_{name}"));
        assert!((rate - truth).abs() < 4.0 * u && u < 1.5e-3, "{name}: {rate} ± {u}");
    }
    let entry = found.found.iter().find(|f| f.name == "probe.drift_x").expect("listed");
    assert!(entry.is_setup && entry.is_rate && !entry.is_angle);
    let old = std::fs::read_to_string(&campaign.machine_path).expect("the machine file");
    let beside = Folder::of(&campaign.files, &campaign.machine_path);
    let made = machine_file(&campaign, &found, None, &old, &beside).expect("a machine file");
    assert!(!made.text.contains("drift_"), "{}", made.text);
    // A later campaign starts neither from this rate nor from where the ball stood by then.
    let text = covariance_file(&campaign, &found, &records, None);
    assert!(!text.contains("drift_") && !text.contains("ball_x\""), "{text}");
    assert!(text.contains("EB0C"));
}

#[test]
fn a_drift_that_is_not_listed_is_named_by_the_verdict() {
    let strong = CAMPAIGN.replace("5 um/h", "25 um/h").replace("8 um/h", "30 um/h");
    let table = table(&strong, 4);
    let silent = strong.replace(", drift = \"free\"", "");
    let (_, without, _) = found(&silent, &table);
    assert_eq!(without.verdict.key(), "drifts");
    let kinds = |found: &Identification| -> Vec<Follows> {
        found.adequacy.kinds.iter().map(|k| k.follows).collect()
    };
    assert!(kinds(&without).contains(&Follows::Time));
    // Switched off, no walk is looked for: the verdict is bad all the same.
    let (_, off, _) = found(&strong.replace("drift = \"free\"", "drift = \"none\""), &table);
    assert!(!off.verdict.is_good() && !kinds(&off).contains(&Follows::Time));
    assert!(found(&strong, &table).1.verdict.is_good());
}

#[test]
fn a_walk_that_is_asked_for_enters_u_where_the_residual_is_small() {
    let small = CAMPAIGN.replace("5 um/h", "0.4 um/h").replace("-3 um/h", "-0.3 um/h");
    let small = small.replace("8 um/h", "0.6 um/h");
    let mut grew = 0;
    for seed in 20..26 {
        let table = table(&small, seed);
        let u = |drift: &str| {
            let (_, found, _) = found(&small.replace(", drift = \"free\"", drift), &table);
            (value(&found, "EY0C").1, found.adequacy.lack.is_found())
        };
        let ((asked, lack), (never, also)) = (u(", drift = \"walk\""), u(", drift = \"none\""));
        if lack || also {
            continue;
        }
        assert!(asked > never * (1.0 - 1e-6), "{asked} {never}");
        grew += i32::from(asked > 1.01 * never);
    }
    assert!(grew >= 2, "{grew} of 6");
}

/// Neither the order of the rows nor the origin of the time nor its unit changes anything.
#[test]
fn law_order_origin_and_unit_of_time_do_not_matter() {
    let table = table(CAMPAIGN, 11);
    let (_, plain, _) = found(CAMPAIGN, &table);
    let mut lines: Vec<&str> = table.lines().collect();
    let head = lines.remove(0);
    let time = head.split(',').position(|h| h == "time_s").expect("a time");
    let with_time = |change: &dyn Fn(f64) -> f64, head: String, lines: &[&str]| {
        let mut text = head + "\n";
        for line in lines {
            let mut cells: Vec<String> = line.split(',').map(str::to_owned).collect();
            cells[time] = change(cells[time].parse().expect("a number")).to_string();
            text += &(cells.join(",") + "\n");
        }
        text
    };
    let reversed: Vec<&str> = lines.iter().rev().copied().collect();
    let others = [
        with_time(&|t| t + 1.7e9, head.to_owned(), &lines),
        with_time(&|t| t / 60.0, head.replace("time_s", "time_min"), &lines),
        with_time(&|t| t / 3600.0, head.replace("time_s", "time_h"), &lines),
        with_time(&|t| t, head.to_owned(), &reversed),
    ];
    for (n, other) in others.iter().enumerate() {
        let (_, found, _) = found(CAMPAIGN, other);
        for own in plain.found.iter().filter(|f| f.value.is_some()) {
            let ((a, u), (b, v)) = (own.value.expect("told"), value(&found, &own.name));
            assert!(
                (a - b).abs() < 2e-3 * u && (u - v).abs() < 1e-3 * u,
                "{n}: {} {a} {b}",
                own.name
            );
        }
    }
}

/// The first stations once more at the end: the rate is known better, and what comes back to its place is not called a
/// closure that fails.
#[test]
fn the_return_to_the_first_station_makes_the_rate_surer() {
    let again = "[[path]]\nkind = \"C\"\nname = \"again\"\nfrom = \"0 deg\"\nto = \"330 deg\"\ncount = 12\n\
                 at = { A = \"20 deg\" }\ndwell = \"100 s\"\n[truth]";
    let closed = CAMPAIGN.replace("[truth]", again);
    // As many rows without a return: more poses at random.
    let open = CAMPAIGN.replace("count = 30", "count = 42");
    let u = |campaign: &str| {
        let (_, found, _) = found(campaign, &table(campaign, 6));
        value(&found, "probe.drift_x").1 + value(&found, "probe.drift_z").1
    };
    let (with, without) = (u(&closed), u(CAMPAIGN));
    assert!(with < 0.8 * without, "{with} {without}");
    assert!(with < 1.05 * u(&open), "{with}");
    // A drift that a closure shows is not warned of where it is listed.
    let strong = closed.replace("8 um/h", "40 um/h");
    let table = table(&strong, 6);
    let codes = |campaign: &str| -> Vec<&'static str> {
        told(campaign, &table).1.iter().map(|d| d.code).collect()
    };
    let silent = codes(&strong.replace(", drift = \"free\"", ""));
    assert!(silent.contains(&"closure") && !silent.contains(&"mixed-feeds"), "{silent:?}");
    assert!(!codes(&strong).contains(&"closure"));
}

#[test]
fn a_drift_without_a_time_is_refused_with_its_table() {
    let table = table(CAMPAIGN, 2);
    let time = table.lines().next().expect("a head").split(',').position(|h| h == "time_s");
    let time = time.expect("a time");
    let without: String = table
        .lines()
        .map(|line| {
            let mut cells: Vec<&str> = line.split(',').collect();
            cells.remove(time);
            cells.join(",") + "\n"
        })
        .collect();
    let of = |table: &str| {
        let (found, problems) = told(CAMPAIGN, table);
        assert!(found.is_none());
        let error = problems.iter().find(|d| d.code == "drift-without-time").cloned();
        error.unwrap_or_else(|| panic!("{problems:?}"))
    };
    let error = of(&without);
    assert!(error.place.file.ends_with("drift.csv") && error.hint.contains("time_s"), "{error:?}");
    // A column that is all one time says no more.
    let stands: String = table
        .lines()
        .enumerate()
        .map(|(n, line)| {
            let mut cells: Vec<&str> = line.split(',').collect();
            if n > 0 {
                cells[time] = "60";
            }
            cells.join(",") + "\n"
        })
        .collect();
    assert!(of(&stands).message.contains("60 s"));
    assert!(told(&CAMPAIGN.replace(", drift = \"free\"", ""), &without).0.is_some());
}

#[test]
fn words_of_a_drift_are_checked() {
    let codes = |drift: &str| -> Vec<&'static str> {
        let text = CAMPAIGN.replace("drift = \"free\"", drift);
        let read = read_campaign(&files(&text, ""), &path(), |r, c| read_virtual(r, c, None));
        read.1.iter().map(|d| d.code).collect()
    };
    assert!(codes("drift = \"5 um/h\"").is_empty());
    assert_eq!(codes("drift = \"-5 um/h\""), ["bad-drift"]);
    assert_eq!(codes("drift = \"5 um\""), ["wrong-unit"]);
    // With nothing but a drift the ball stays unknown.
    let alone = CAMPAIGN.replace(
        "{ ball = \"free\", socket = \"5 um\", drift = \"free\" }",
        "{ drift = \"2 um/h\" }",
    );
    let (campaign, _) = virtually(&alone, 1);
    let names: Vec<&str> =
        campaign.instruments[0].unknowns.iter().map(|u| u.name.as_str()).collect();
    assert_eq!(names, ["ball_x", "ball_y", "ball_z", "drift_x", "drift_y", "drift_z", "socket_z"]);
    assert!((campaign.instruments[0].unknowns[3].prior_u.expect("stated") - 0.002).abs() < 1e-15);
}

/// A laser that stands at one place: 0, −4 and −11 µm at 0, 1 and 2 h. The least-squares line falls by
/// (−11 − 0)/2 = 5.5 µm/h: so fast the laser moves away; u = 1 µm/√(1 + 0 + 1).
#[test]
fn three_readings_by_hand() {
    let text = "name = \"h\"\nmachine = \"../../machines/three-axis-mill/machine.toml\"\n[unknown]\nlocation = [\"EC0Y\"]\n\
                [instrument.laser]\nkind = \"laser-line\"\nnoise = \"1 um\"\nreads = \"deviation\"\nreadings = \"drift.csv\"\n\
                unknown = { zero = \"free\", drift = \"free\" }\n";
    let rows = "X,Y,Z,deviation_um,time_h\n0,0,0,0,7\n0,0,0,-4,8\n0,0,0,-11,9\n";
    let (read, problems) = read_campaign(&files(text, rows), &path(), |_, _| Some(()));
    let (campaign, ()) = read.unwrap_or_else(|| panic!("{problems:?}"));
    let readings = campaign.readings(&mut Diagnostics::new()).expect("three rows");
    let bare = trueaxis_measure::unknowns::design::Design::new(
        &campaign.machine,
        Vec::new(),
        campaign.instruments.clone(),
    );
    let design = bare.from_first_readings(&readings);
    assert_eq!(design.names(), ["laser.zero", "laser.drift_x"]);
    let fit = fit(&design, &readings, &[]).expect("a line");
    assert!((fit.values[1] - 5.5e-3).abs() < 1e-9, "{:?}", fit.values);
    assert!((fit.covariance[(1, 1)].sqrt() - 1e-3 / 2f64.sqrt()).abs() < 1e-12);
}

/// The ball goes 10 µm along +X of the machine in an hour: a probe that does not turn sees it there, however the table
/// has turned; the ball place in the workpiece frame turns with the table.
#[test]
fn a_drift_is_along_the_machine() {
    let (campaign, _) = virtually(CAMPAIGN, 1);
    let design = campaign.design();
    let of = |name: &str| design.names().iter().position(|n| n == name).expect("an unknown");
    let mut values = vec![0.0; design.unknowns()];
    values[of("probe.drift_x")] = 0.010;
    for angle in [0.0_f64, 30.0, 90.0, 200.0] {
        let (_, real) = virtually(CAMPAIGN, 1);
        let mut row = real.paths[2].stations.row(3);
        row.command[0] = angle.to_radians();
        let mut readings = Readings::default();
        readings.push(trueaxis_measure::measure::Reading { time_s: 3600.0, ..row });
        readings.push(trueaxis_measure::measure::Reading { time_s: 0.0, ..row });
        let [later, first] = [0, 1].map(|i| design.read(&readings, i, &values).expect("read"));
        let moved = [0, 1, 2].map(|c| later[c] - first[c]);
        // The errors of the machine file turn the probe by some 1e-4.
        assert!((moved[0] - 0.010).abs() < 3e-6, "{moved:?}");
        assert!(moved[1].abs() < 3e-6 && moved[2].abs() < 3e-6, "{moved:?}");
    }
    let bare = &design.instruments[0];
    assert_ne!(bare.drifted(&design.machine, &[0.3; 6], 10.0).along_axes, Mat3::zeros());
}

/// What a reading does is what its slope says, for every unknown, the drift too.
#[test]
fn law_slopes_are_those_of_the_reading() {
    for kind in ["probe-ball", "ball-bar", "cut-piece", "laser-line", "laser-angle"] {
        let noise = if kind == "laser-angle" { "1 urad" } else { "1 um" };
        let text = format!(
            "name = \"s\"\nmachine = \"../../machines/lei-hsu-mill/machine.toml\"\n[unknown]\nlocation = [\"EX0C\"]\n\
             [instrument.it]\nkind = \"{kind}\"\nnoise = \"{noise}\"\ndirection = \"0.6 0 0.8\"\nunknown = {{ drift = \"free\" }}\n"
        );
        let (read, problems) = read_campaign(&files(&text, ""), &path(), |_, _| Some(()));
        let (campaign, ()) = read.unwrap_or_else(|| panic!("{problems:?}"));
        let (_, real) = virtually(CAMPAIGN, 1);
        let mut row = real.paths[2].stations.row(7);
        row.command[2] += 40.0; // off the ball, so that a distance has a direction
        row.direction = campaign.instruments[0].direction;
        row.time_s = 5000.0;
        let mut readings = Readings::default();
        readings.push(row);
        let design = campaign.design();
        let n = design.unknowns();
        let mut slopes = vec![0.0; 3 * n];
        let channels = design.slopes(&readings, 0, &mut slopes);
        let drifts = (0..n).filter(|k| design.unknown(*k).expect("in range").is_rate());
        let drifts: Vec<usize> = drifts.collect();
        assert!(drifts.len() >= 2, "{kind}");
        // The nominal machine: slopes are taken there, and the stated errors of the file turn it by 1e-4, a short distance by more.
        let steps = 1e-3;
        for k in drifts {
            let at = |by: f64| {
                let mut values = vec![0.0; n];
                values[k] = by;
                design.read(&readings, 0, &values).expect("read")
            };
            let (more, less) = (at(steps), at(-steps));
            for c in 0..channels {
                let by_reading = (more[c] - less[c]) / (2.0 * steps);
                assert!(
                    (by_reading - slopes[c * n + k]).abs() < 5e-3,
                    "{kind} {k} {c}: {by_reading}"
                );
            }
        }
    }
}

/// A plan knows when each station will be read, and so what it will show of a rate.
#[test]
fn a_plan_states_what_will_be_known_of_a_rate() {
    let (read, problems) = read_plan(&files(CAMPAIGN, ""), &path());
    let report = planned(read.unwrap_or_else(|| panic!("{problems:?}")), None, Control::Fanuc);
    let of =
        |name: &str| report.expectation.unknowns.iter().find(|e| e.name == name).and_then(|e| e.u);
    let expected = of("probe.drift_z").expect("observable");
    let (_, found, _) = found(CAMPAIGN, &table(CAMPAIGN, 3));
    let (_, u) = value(&found, "probe.drift_z");
    assert!((expected - u).abs() < 0.1 * u, "{expected} {u}");
}

/// Two threads that identify the same say the same.
#[test]
fn nothing_depends_on_threads() {
    let table = Arc::new(table(CAMPAIGN, 5));
    let run = |table: Arc<String>| move || value(&found(CAMPAIGN, &table).1, "probe.drift_z");
    let [a, b] = [0, 1].map(|_| std::thread::spawn(run(Arc::clone(&table))));
    assert_eq!(a.join().expect("a value"), b.join().expect("a value"));
}

/// A bar on the tests BK1, BK2 and BK3 of ISO 10791-6 on a mill whose tables turn.
const BAR: &str = r#"
name = "a bar that grows"
machine = "../../machines/lei-hsu-mill/machine.toml"
[unknown]
location = "minimal"
[instrument.bar]
kind = "ball-bar"
spindle_ball = "0 0 -180 mm"
table_ball = "0 0 50 mm"
length = "100 mm"
noise = "0.5 um"
reads = "deviation"
readings = "drift.csv"
unknown = { drift = "free" }
[[path]]
kind = "BK1"
from = "90 deg"
to = "0 deg"
count = 31
[[path]]
kind = "BK2"
from = "0 deg"
to = "350 deg"
count = 36
[[path]]
kind = "BK3"
half_angle = "15 deg"
pole = "0 0.173648 0.984808"
count = 73
[truth]
errors = { EX0C = "10 um", EY0C = "-12 um", EA0C = "20 urad", EB0C = "-25 urad", EY0A = "15 um", EZ0A = "-10 um", EB0A = "30 urad", EC0A = "-20 urad", EC0X = "25 urad", EA0Y = "-15 urad", EB0Z = "20 urad" }
[disturb]
drift_per_hour = "20 um"
"#;

/// A probe in a head: a spindle that grows along itself, which no motion of the ball can stand for.
const HEAD: &str = r#"
name = "a spindle that grows"
machine = "../../machines/wyxzcat-gantry/machine.toml"
[unknown]
location = "minimal"
[instrument.probe]
kind = "probe-ball"
socket = "0 0 -330 mm"
noise = "1 um"
reads = "ball"
readings = "drift.csv"
unknown = { ball = "free", socket = "5 um", drift = "free" }
[[path]]
kind = "random"
A = ["-60 deg", "60 deg"]
C = ["-150 deg", "150 deg"]
count = 40
seed = 5
dwell = "100 s"
[truth]
errors = { EY0C = "12 um", EX0C = "8 um", EA0C = "20 urad", EB0C = "-15 urad", EY0A = "9 um", EZ0A = "5 um" , EB0A = "20 urad", EC0A = "-12 urad" }
setup = { socket_drift_z = "-30 um/h", drift_x = "6 um/h" }
"#;

/// How often the errors and rates of many campaigns lie within their 95 % intervals.
fn share_inside(campaign: &str) -> f64 {
    let (campaign, real) = virtually(campaign, 1);
    // A bar whose readings drift grows.
    let grows = |e: SetupError| {
        if e == SetupError::ZeroDrift { real.disturb.drift_per_hour[0][0] } else { 0.0 }
    };
    let made = |e: SetupError| {
        let names = real.truth.instruments[0].unknowns.iter().map(|u| u.error);
        names.zip(&real.truth.setups[0]).find(|(error, _)| *error == e).map_or(0.0, |(_, v)| *v)
    };
    let true_value = |design: &Design, k: usize| match design.unknown(k).expect("in range") {
        Unknown::Term(t) => real.truth.errors.iter().find(|(e, _)| *e == t.error).map(|(_, v)| *v),
        Unknown::Setup(_, u) => u.error.is_rate().then(|| made(u.error) + grows(u.error)),
    };
    let (mut inside, mut all) = (0_u32, 0_u32);
    for seed in 0..100 {
        let (design, fit) = fitted(&campaign, &real, seed);
        for k in (0..design.unknowns()).filter(|k| fit.sight.is_seen[*k]) {
            let Some(truth) = true_value(&design, k) else { continue };
            let is_in = (fit.values[k] - truth).abs() < 1.96 * fit.covariance[(k, k)].sqrt();
            (inside, all) = (inside + u32::from(is_in), all + 1);
        }
    }
    assert!(all >= 100 * 8, "{all}");
    f64::from(inside) / f64::from(all)
}

/// A drift of the length of a bar, and of a tool along a head, are found with their own rates, and displace no error.
#[test]
fn law_a_bar_that_grows_and_a_spindle_that_grows_are_covered() {
    for campaign in [BAR, HEAD] {
        let share = share_inside(campaign);
        assert!((0.92..0.98).contains(&share), "{share}");
    }
    // Without the rate of its own length, the bar's growth is taken for angles of the tables, in silence.
    let (bar, head) = (found(BAR, &table(BAR, 3)).1, found(HEAD, &table(HEAD, 3)).1);
    for (found, name, truth) in
        [(&bar, "bar.length_drift", 0.020), (&head, "probe.socket_drift_z", -0.030)]
    {
        let (rate, u) = value(found, name);
        assert!(found.verdict.is_good(), "{:?}", found.verdict);
        assert!((rate - truth).abs() < 4.0 * u && u < 0.4 * truth.abs(), "{name}: {rate} ± {u}");
    }
    // A table machine does not turn the tool: there a spindle that grows is a ball that sinks, and no rate of its own.
    assert!(bar.found.iter().all(|f| !f.name.contains("ball_drift_z")));
}
