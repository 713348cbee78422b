//! The programs of a probe: executed as they were written, their logs read again, and the correction inside the control.

#![allow(clippy::print_stdout, reason = "says what the table leaves")]

#[path = "probe_programs/bench.rs"]
mod bench;

use bench::Touched;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use rand_distr::{Distribution, Normal};
use std::cell::RefCell;
use trueaxis::identify::probe::program::{
    Correction, ProbeFile, ProgramOf, probe_programs, probe_stations,
};
use trueaxis::identify::probe::{
    Calibration, Purpose, Study, Tables, datums, identify_probe, parse_study, read_study,
};
use trueaxis::input::Diagnostics;
use trueaxis::nc::Control;

const CONTROLS: [Control; 5] =
    [Control::Fanuc, Control::Haas, Control::LinuxCnc, Control::Sinumerik840d, Control::Heidenhain];
const CENTRE: [f64; 2] = [120.0, -80.0];
const REACH: f64 = 31.0 - 2.0;
const TOP: f64 = -60.0 - 100.0 - 50.0;
const LENGTH: f64 = 90.0123;

/// What is true: lobes, offset of the ball, noise of each trigger.
struct Bench {
    offset: [f64; 2],
    lobes: f64,
    random: RefCell<ChaCha8Rng>,
    noise: f64,
}

impl Bench {
    fn new(noise: f64, seed: u64) -> Self {
        let random = RefCell::new(ChaCha8Rng::seed_from_u64(seed));
        Self { offset: [0.0135, -0.0220], lobes: 0.010, random, noise }
    }

    fn travel(&self, angle: f64) -> f64 {
        0.0175 + self.lobes * (3.0 * angle - 1.0).cos() + 0.0015 * (2.0 * angle + 0.4).cos()
    }

    /// Of the spindle along a direction from the centre, where it triggers: by the cosine law.
    fn reach(&self, angle: f64) -> f64 {
        let [ox, oy] = self.offset;
        let along = ox * angle.cos() + oy * angle.sin();
        let across = oy * angle.cos() - ox * angle.sin();
        -along + (REACH * REACH - across * across).sqrt() + self.travel(angle)
    }

    fn draw(&self) -> f64 {
        let unit = Normal::new(0.0, 1.0).expect("finite");
        unit.sample(&mut *self.random.borrow_mut()) * self.noise
    }

    /// In the ring, or on the face where the words go down.
    fn trigger(&self, touched: &Touched) -> [f64; 3] {
        let [x, y, z] = touched.to_mm;
        let down = touched.angle_rad.is_none() && x.is_nan() && y.is_nan()
            || touched.angle_rad.is_none() && x == 0.0 && y == 0.0;
        if down {
            return [158.0, -80.0, TOP + LENGTH + self.draw()];
        }
        // A word that is missing does not move: the centre.
        let or = |v: f64, c: f64| if v.is_nan() { 0.0 } else { v - c };
        let planned = || or(y, CENTRE[1]).atan2(or(x, CENTRE[0]));
        let angle = touched.angle_rad.unwrap_or_else(planned);
        let s = self.reach(angle) + self.draw();
        let _ = z;
        [CENTRE[0] + s * angle.cos(), CENTRE[1] + s * angle.sin(), -127.0]
    }
}

const STUDY: &str = "\
name = 'bench'
[ring]
diameter = '62 mm'
centre = '120 -80 mm'
[stylus.ruby]
ball_diameter = '4 mm'
hits = ['ring-hits.log']
[xy_datum]
log = 'four-hits.log'
[z_datum]
reference_length = '100 ± 0.001 mm'
block = '50 mm'
reference_z = '-60 mm'
log = 'z-datum.log'
[program]
tool = 5
z = '-127 mm'
clear_z = '-50 mm'
face = '158 -80 mm'
length = '90 mm'
";

type Logs = Vec<(String, String)>;

fn read(text: &str, logs: &Logs, purpose: Purpose) -> (Option<Study>, Diagnostics) {
    let load = |name: &str, problems: &mut Diagnostics| {
        let found = logs.iter().find(|(n, _)| n == name).map(|(_, t)| t.clone());
        if found.is_none() {
            let place = trueaxis::input::Place::whole(name);
            problems.error("unreadable-file", place, "no such log".to_owned(), "");
        }
        found
    };
    let tables = Tables { load: &load, show: &|name: &str| name.to_owned() };
    parse_study("study.toml", text, &tables, purpose)
}

#[track_caller]
fn study(text: &str, logs: &Logs, purpose: Purpose) -> Study {
    let (study, problems) = read(text, logs, purpose);
    let told: Vec<String> = problems.iter().map(ToString::to_string).collect();
    study.unwrap_or_else(|| panic!("{told:?}"))
}

fn programs(study: &Study, control: Control, correction: Option<&Correction>) -> Vec<ProbeFile> {
    let of = ProgramOf { study, stylus: &study.styli[0], control, correction, is_stand_in: false };
    let files = probe_programs(&of).expect("programs");
    for file in files.iter().filter(|f| f.hits.is_some()) {
        let off = probe_stations(&of, &files, &file.name);
        assert!(off < 1e-4, "{control:?} {}: {off} mm off its stations", file.name);
    }
    files
}

fn name(stem: &str, control: Control) -> String {
    let extension = match control {
        Control::Fanuc | Control::Haas => "nc",
        Control::LinuxCnc => "ngc",
        Control::Sinumerik840d => "mpf",
        Control::Heidenhain => "h",
    };
    format!("{stem}.{extension}")
}

/// Every program of a set is executed; its log by its stem.
fn logs(files: &[ProbeFile], control: Control, bench: &Bench, stems: [&str; 3]) -> Logs {
    let log = |stem: &str| {
        let text = bench::log(files, &name(stem, control), control, &mut |t| bench.trigger(t));
        (format!("{stem}.log"), text)
    };
    stems.map(log).into_iter().collect()
}

const RAW: [&str; 3] = ["ring-hits", "four-hits", "z-datum"];
const CORRECTED: [&str; 3] = ["ring-corrected", "four-hits-corrected", "z-datum-corrected"];

fn calibrated(study: &Study) -> Calibration {
    let mut problems = Diagnostics::new();
    let mut all = identify_probe(study, &mut problems).unwrap_or_else(|| panic!("{problems:?}"));
    all.remove(0)
}

fn correction(study: &Study, found: &Calibration) -> Correction {
    let rows = found.table(study.table_steps, 0.0);
    Correction {
        dr_mm: rows.iter().map(|r| r.deviation_mm).collect(),
        length_mm: study.z_datum.as_ref().map(|z| datums::z_datum(z).length_mm),
        about: "bench".to_owned(),
    }
}

/// The words of a line of a log.
fn words(line: &str) -> Vec<(char, f64)> {
    let spaced: String = line
        .chars()
        .flat_map(|c| match c.is_ascii_alphabetic() {
            true => vec![' ', c, ' '],
            false => vec![c],
        })
        .collect();
    let parts: Vec<&str> = spaced.split_whitespace().collect();
    let pairs = parts.chunks(2).filter(|p| p.len() == 2);
    pairs.filter_map(|p| Some((p[0].chars().next()?, p[1].parse().ok()?))).collect()
}

fn result(log: &str) -> Vec<(char, f64)> {
    let line = log.lines().find_map(|l| l.trim().strip_prefix("RESULT")).expect("a result");
    words(line)
}

/// Plan, hits, calibration, correction inside the control, hits again: by files alone. Measured again with the table the
/// hits leave the noise; before, they leave 20 µm of lobes and the offset.
#[test]
fn the_loop_is_closed_by_the_logs_of_every_control() {
    for control in CONTROLS {
        let before =
            study(&STUDY.replace("hits = ['ring-hits.log']\n", ""), &Vec::new(), Purpose::Programs);
        let made = logs(&programs(&before, control, None), control, &Bench::new(0.001, 7), RAW);
        let after = study(STUDY, &made, Purpose::Result);
        let found = calibrated(&after);
        assert_eq!(found.before_mm.len(), 60, "{control:?}");
        assert!(found.before.range_mm > 0.040, "{control:?}: {:?}", found.before);
        let offset = found.offset.expect("an offset").value_mm;
        assert!((offset.x - 0.0135).abs() < 1e-3 && (offset.y + 0.0220).abs() < 1e-3, "{offset}");
        let z = datums::z_datum(after.z_datum.as_ref().expect("a length"));
        assert!((z.length_mm - LENGTH).abs() < 0.002, "{control:?}: {z:?}");
        // The second run of the paper: the same ring, each hit corrected by the control.
        let table = correction(&after, &found);
        let again = logs(
            &programs(&after, control, Some(&table)),
            control,
            &Bench::new(0.001, 8),
            CORRECTED,
        );
        let text = STUDY.replace("ring-hits.log", "ring-corrected.log");
        let text = text.split("[xy_datum]").next().expect("a ring").to_owned();
        let (left, problems) = read(&text, &again, Purpose::Result);
        assert!(problems.iter().any(|d| d.code == "corrected-log"), "{control:?}: {problems:?}");
        let left = calibrated(&left.expect("a study")).before;
        // 1 µm of noise: the range of 60 is 4.6 µm on average, and the table has its own.
        println!("{control:?}: before {:?}, with the table {left:?}", found.before);
        assert!(left.rms_mm < 0.0015 && left.range_mm < 0.0075, "{control:?}: {left:?}");
        let four = result(&again[1].1);
        assert_eq!(four.iter().map(|w| w.0).collect::<String>(), "XYUV", "{control:?}");
        assert!(four[0].1.abs() < 0.002 && four[1].1.abs() < 0.002, "{control:?}: {four:?}");
        assert!((four[2].1 - 4.0).abs() < 0.004 && (four[3].1 - 4.0).abs() < 0.004, "{four:?}");
        let face = result(&again[2].1);
        assert!(
            (face[0].1 - TOP).abs() < 0.002 && face[1].1.abs() < 0.002,
            "{control:?}: {face:?}"
        );
    }
}

/// What the control computes against the formula, written out here: 0.1 µm after rounding, in any direction.
#[test]
fn oracle_the_control_corrects_by_the_table_in_any_direction() {
    // Not a multiple of the steps of the table, so that every hit lies between two of its directions.
    let text = STUDY.replace("tool = 5", "tool = 5\ndirections = 47");
    let study =
        study(&text.replace("hits = ['ring-hits.log']\n", ""), &Vec::new(), Purpose::Programs);
    let mut random = ChaCha8Rng::seed_from_u64(11);
    let unit = Normal::new(0.0, 0.015).expect("finite");
    for (control, steps) in CONTROLS.into_iter().flat_map(|c| [4, 7, 60].map(|n| (c, n))) {
        let dr_mm: Vec<f64> = (0..steps).map(|_| unit.sample(&mut random)).collect();
        let table = Correction { dr_mm: dr_mm.clone(), length_mm: None, about: "x".to_owned() };
        let files = programs(&study, control, Some(&table));
        let bench = Bench::new(0.02, 3);
        let seen = RefCell::new(Vec::new());
        let log = bench::log(&files, &name("ring-corrected", control), control, &mut |t| {
            let place = bench.trigger(t);
            seen.borrow_mut().push(place);
            place
        });
        // The slow touch counts.
        let hits: Vec<[f64; 3]> = seen.borrow().iter().copied().skip(1).step_by(2).collect();
        let lines: Vec<&str> = log.lines().filter(|l| l.starts_with('H')).collect();
        assert_eq!((lines.len(), hits.len()), (47, 47), "{control:?}");
        for (i, (line, hit)) in lines.iter().zip(hits).enumerate() {
            // The way of the touch: from 2 mm before the nominal place, as the program goes.
            let planned = std::f64::consts::TAU * i as f64 / 47.0;
            let start = [0, 1].map(|k| {
                let u = [planned.cos(), planned.sin()][k];
                ((CENTRE[k] + (REACH - 2.0) * u) * 1e4).round() / 1e4
            });
            let way = [hit[0] - start[0], hit[1] - start[1]];
            let turn = way[1].atan2(way[0]).to_degrees().rem_euclid(360.0) / 360.0 * steps as f64;
            let (k, part) = (turn as usize % steps, turn.fract());
            let dr = dr_mm[k] * (1.0 - part) + dr_mm[(k + 1) % steps] * part;
            let length = way[0].hypot(way[1]);
            let wanted = [0, 1].map(|k| hit[k] - dr * way[k] / length);
            let found = words(line);
            let word = |c: char| found.iter().find(|w| w.0 == c).expect("a word").1;
            for (c, value) in [('X', wanted[0]), ('Y', wanted[1]), ('E', dr)] {
                let off = (word(c) - value).abs();
                assert!(off <= 1e-4, "{control:?}, {steps} steps, hit {}: {c} off by {off}", i + 1);
            }
            assert!((word('D') - planned.to_degrees()).abs() < 1e-4);
        }
    }
}

/// The programs of the example as LinuxCNC itself executes them: its interpreter `rs274` says what its LOG lines are, with
/// every touch at the end of its way. Ours has the same to the last printed digit.
#[test]
fn oracle_linuxcnc_corrects_as_our_interpreter_does() {
    let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR"));
    let path = root.join("../../examples/05_identify/ring-programs.toml");
    let (study, _) = read_study(&trueaxis::files::disk(), &path, Purpose::Calibration);
    let study = study.expect("the example");
    let table = correction(&study, &calibrated(&study));
    let files = programs(&study, Control::LinuxCnc, Some(&table));
    let theirs = std::fs::read_to_string(root.join("tests/data/linuxcnc-ring.txt")).expect("data");
    let mut compared = 0;
    for part in theirs.split("program ").skip(1) {
        let (stem, lines) = part.split_once('\n').expect("a name");
        let ours = bench::log_as_written(&files, &name(stem, Control::LinuxCnc), Control::LinuxCnc);
        assert_eq!(ours.lines().count(), lines.lines().count(), "{stem}");
        for (our, their) in ours.lines().zip(lines.lines()) {
            let (a, b) = (words(our), words(their));
            assert_eq!(a.len(), b.len(), "{our}\n{their}");
            for (x, y) in a.iter().zip(&b) {
                assert!(x.0 == y.0 && (x.1 - y.1).abs() < 1.5e-6, "{our}\n{their}");
                compared += 1;
            }
        }
    }
    assert!(compared > 400, "{compared}");
}

/// Between 60 directions three lobes of 10 µm bend by (2π/60)²/8 · 9 · 10 µm = 0.123 µm from a straight line.
#[test]
fn the_straight_lines_of_a_table_leave_what_the_curvature_says() {
    let dr = |angle: f64| 0.010 * (3.0 * angle).cos();
    let at = |i: usize, n: usize| std::f64::consts::TAU * i as f64 / n as f64;
    let dr_mm = (0..60).map(|i| dr(at(i, 60))).collect();
    let table = Correction { dr_mm, length_mm: None, about: String::new() };
    let off = (0..6000).map(|i| (table.dr_at(at(i, 6000)) - dr(at(i, 6000))).abs());
    let most = off.fold(0.0, f64::max);
    assert!((most - 1.2337e-4).abs() < 2e-6, "{most}");
}

/// The fast touch and the way back do not count, and no touch ends beyond what the ball allows.
#[test]
fn every_touch_has_two_stages_an_alarm_and_a_line() {
    let before =
        study(&STUDY.replace("hits = ['ring-hits.log']\n", ""), &Vec::new(), Purpose::Programs);
    for (control, touch, alarm) in [
        (Control::Fanuc, "G31 ", "#3000=1(NO TOUCH AT HIT"),
        (Control::Haas, "G31 ", "#3000=1(NO TOUCH AT HIT"),
        (Control::LinuxCnc, "G38.2 ", ""),
        (Control::Sinumerik840d, "MEAS=1 ", "SETAL(65001,\"NO TOUCH AT HIT"),
        (Control::Heidenhain, "TCH PROBE 3.3 ", "EQU -1 GOTO LBL 99"),
    ] {
        let files = programs(&before, control, None);
        let ring = files.iter().find(|f| f.name == name("ring-hits", control)).expect("a ring");
        let text = String::from_utf8(ring.text.clone()).expect("text");
        assert_eq!(text.matches(touch).count(), 120, "{control:?}");
        let alarms = if alarm.is_empty() { 120 } else { text.matches(alarm).count() };
        assert_eq!(alarms, 120, "{control:?}");
        assert!(text.contains("F300") && text.contains("F100"), "{control:?}");
    }
    // A cycle that touched nothing leaves −1: the alarm, not a line of the log.
    let files = programs(&before, Control::Heidenhain, None);
    let ring = files.iter().find(|f| f.name == "ring-hits.h").expect("a ring");
    let program = trueaxis::nc::Program::new("ring-hits.h", ring.text.clone(), Control::Heidenhain);
    let outcome = trueaxis::nc::interpret(
        &program,
        &bench::Files(&files),
        &trueaxis::nc::Settings::default(),
        &mut |_| {},
    );
    assert!(
        !outcome.finished && outcome.problems.iter().any(|d| d.code == "program-alarm"),
        "{:?}",
        outcome.problems
    );
}

#[test]
fn mistakes_in_a_log_are_named_with_their_row() {
    let before =
        study(&STUDY.replace("hits = ['ring-hits.log']\n", ""), &Vec::new(), Purpose::Programs);
    let control = Control::Fanuc;
    let files = programs(&before, control, None);
    let made = logs(&files, control, &Bench::new(0.001, 7), RAW);
    let ring = made[0].1.clone();
    let lines: Vec<&str> = ring.lines().collect();
    let changed = |row: usize, from: &str, to: &str| {
        let mut all: Vec<String> = lines.iter().map(|l| (*l).to_owned()).collect();
        assert!(all[row].contains(from), "{}", all[row]);
        all[row] = all[row].replacen(from, to, 1);
        all.join("\n")
    };
    let without = |row: usize| {
        let kept = lines.iter().enumerate().filter(|(i, _)| *i != row).map(|(_, l)| *l);
        kept.collect::<Vec<_>>().join("\n")
    };
    // Row 0 is the heading, row n hit n; places count from 1.
    let x = words(lines[10]).iter().find(|w| w.0 == 'X').expect("X").1;
    let cases = [
        (without(0), "no-heading", 1),
        (without(10), "lost-hits", 11),
        (lines[..30].join("\n"), "lost-hits", 30),
        (ring.replace("END 60", "END 59"), "lost-hits", 61),
        (changed(10, "H10 ", "H9 "), "hits-out-of-order", 11),
        (changed(10, " T5", " T6"), "other-tool", 11),
        (changed(10, " T5", ""), "missing-tool", 11),
        (changed(10, " D54.00000", " D48.00000"), "doubled-direction", 11),
        (changed(10, " D54.00000", " D55.00000"), "other-directions", 11),
        (changed(10, " D54.00000", ""), "missing-word", 11),
        (changed(10, " D54", " Q54"), "unknown-line", 11),
        (changed(10, &format!("X{x:.4}"), &format!("X{:.4}", x - 5.0)), "far-hit", 11),
        (ring.replace("MACHINE", "G54"), "other-frame", 1),
        (ring.replace("RING", "PLANE"), "other-log", 1),
        (format!("{ring}{ring}"), "two-logs", 63),
        (ring.replace("MACHINE", "MACHINE CORRECTED"), "corrected-log", 0),
        (ring.replace(" MM ", " INCH "), "wrong-unit", 2),
    ];
    for (log, code, row) in cases {
        let logs = vec![("ring-hits.log".to_owned(), log), made[1].clone(), made[2].clone()];
        let (found, mut problems) = read(STUDY, &logs, Purpose::Result);
        if let Some(study) = &found {
            let _ = identify_probe(study, &mut problems);
        }
        let named = problems.iter().find(|d| d.code == code);
        let told: Vec<String> = problems.iter().map(ToString::to_string).collect();
        let named = named.unwrap_or_else(|| panic!("{code}: {told:?}"));
        assert!(
            row == 0 || named.place.line == row,
            "{code}: line {row}, not {}",
            named.place.line
        );
        assert!(code == "corrected-log" || problems.has_errors(), "{code}");
    }
    // A log of another number of directions, and the logs of two datums mixed up.
    let other = STUDY.replace("tool = 5", "tool = 5\ndirections = 36");
    let (_, problems) = read(&other, &made, Purpose::Result);
    assert!(problems.iter().any(|d| d.code == "other-directions"), "{problems:?}");
    let (_, problems) =
        read(&STUDY.replace("'four-hits.log'", "'ring-hits.log'"), &made, Purpose::Result);
    assert!(problems.iter().any(|d| d.code == "other-directions"), "{problems:?}");
    let (_, problems) =
        read(&STUDY.replace("'z-datum.log'", "'four-hits.log'"), &made, Purpose::Result);
    assert!(problems.iter().any(|d| d.code == "other-log"), "{problems:?}");
    // A calibration cannot be made of hits that the control has corrected.
    let corrected = ring.replace("MACHINE", "MACHINE CORRECTED");
    let logs = vec![("ring-hits.log".to_owned(), corrected), made[1].clone(), made[2].clone()];
    let (found, problems) = read(STUDY, &logs, Purpose::Calibration);
    assert!(found.is_none() && problems.iter().any(|d| d.code == "corrected-log"), "{problems:?}");
    // Both a log and numbers; a probe that does not fit.
    for (from, to, code) in [
        ("log = 'four-hits.log'", "log = 'four-hits.log'\nx_plus = '1 mm'", "two-readings"),
        ("log = 'z-datum.log'", "log = 'z-datum.log'\nprobe_z = ['1 mm']", "two-readings"),
        ("clear_z = '-50 mm'", "clear_z = '-150 mm'", "bad-size"),
        ("tool = 5", "tool = 5\ndirections = 3", "bad-count"),
        ("tool = 5", "tool = 5\nback_off = '3 mm'", "bad-size"),
        ("tool = 5", "tool = 5\ntouch_feed = '600 mm/min'", "bad-size"),
        ("face = '158 -80 mm'", "face = '158 mm'", "bad-vector"),
    ] {
        let (found, problems) = read(&STUDY.replace(from, to), &made, Purpose::Result);
        assert!(found.is_none() && problems.iter().any(|d| d.code == code), "{code}: {problems:?}");
    }
    let refused = |from: &str, to: &str, control| {
        let study = study(&STUDY.replace(from, to), &Vec::new(), Purpose::Programs);
        let of = ProgramOf {
            study: &study,
            stylus: &study.styli[0],
            control,
            correction: None,
            is_stand_in: false,
        };
        probe_programs(&of).expect_err("nonsense").to_string()
    };
    assert!(refused("tool = 5", "tool = 5\nbeyond = '3 mm'", control).contains("crushed"));
    assert!(refused("tool = 5", "tool = 5\nstand_off = '40 mm'", control).contains("does not fit"));
    assert!(refused("centre = '120 -80 mm'", "", control).contains("centre"));
    assert!(refused("tool = 5", "tool = 5\norientation = '90 deg'", control).contains("M19"));
}
