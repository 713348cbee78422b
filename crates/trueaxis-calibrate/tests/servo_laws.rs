//! How the axes follow, as an unknown: what was injected comes back, geometry stays what it is, and
//! what one feed cannot separate is named.

use std::path::PathBuf;
use trueaxis_calibrate::identify::errors::{Identification, identify};
use trueaxis_calibrate::identify::records::{Options, Records};
use trueaxis_geometry::Vec3;
use trueaxis_input::{CsvTable, Diagnostics, Files, Source};
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{AxisKind, Command, MAX_AXES};
use trueaxis_machine::errors::StatedError;
use trueaxis_machine::twist::Reference;
use trueaxis_measure::measure::instrument::Instrument;
use trueaxis_measure::measure::path::{Path, station};
use trueaxis_measure::measure::virtual_campaign::{
    AxisDisturb, Disturb, Truth, VirtualCampaign, measure, read_virtual,
};
use trueaxis_measure::measure::{Campaign, Kind, Readings, fill_motion, read_campaign};
use trueaxis_measure::unknowns::minimal::minimal_location_errors;
use trueaxis_measure::unknowns::term::{Basis, Term};

const MACHINES: [&str; 8] = [
    "xkas2525",
    "i5-engraver",
    "lei-hsu-mill",
    "head-table",
    "wyxzcat-gantry",
    "three-axis-mill",
    "gantry-001",
    "nutating-head",
];

struct Disk;

impl Source for Disk {
    fn read(&self, path: &std::path::Path) -> std::io::Result<Vec<u8>> {
        std::fs::read(path)
    }

    fn is_file(&self, path: &std::path::Path) -> bool {
        path.is_file()
    }
}

fn disk() -> Files {
    Files::new(Disk)
}

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn machine(name: &str) -> Machine {
    let path = root().join("machines").join(name).join("machine.toml");
    let (machine, problems) = Machine::read(&disk(), &path);
    let stated = machine.unwrap_or_else(|| panic!("{problems:?}"));
    let errors = stated.stated_errors();
    errors.iter().fold(stated.clone(), |m, (index, _)| m.with_error(*index, None))
}

/// Numbers that are the same in every run (splitmix64).
struct Random(u64);

impl Random {
    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    fn within(&mut self, size: f64) -> f64 {
        size * (2.0 * self.unit() - 1.0)
    }
}

const FREE_S: f64 = 0.03;
const STILL: Option<f64> = None;

fn probe(machine: &Machine) -> Instrument {
    Instrument {
        name: "place".to_owned(),
        kind: Kind::ProbeBall,
        sight: Kind::ProbeBall.sight(),
        reference: Reference::Workpiece,
        tool_point_mm: machine.tip_mm(),
        reference_point_mm: Vec3::zeros(),
        direction: Vec3::x(),
        length_mm: 0.0,
        noise: [1e-3; 3],
        unknowns: Vec::new(),
        material: None,
        reads: Default::default(),
        assumed: Default::default(),
        drift: Default::default(),
    }
}

fn servo(machine: &Machine) -> Vec<Term> {
    let of = |i| {
        [
            Term::servo(machine, i, |sense| Basis::Lag { sense }),
            Term::servo(machine, i, |sense| Basis::LostMotion { sense }),
            Term::servo(machine, i, |sense| Basis::Friction { free_s: FREE_S, sense }),
        ]
    };
    (0..machine.axes().len()).flat_map(of).flatten().collect()
}

fn campaign(machine: &Machine, with_servo: bool) -> Campaign {
    let mut terms = minimal_location_errors(machine);
    if with_servo {
        terms.extend(servo(machine));
    }
    terms.sort_by_key(|t| t.index);
    Campaign {
        conditions: None,
        files: disk(),
        name: "servo".into(),
        path: PathBuf::from("servo.toml"),
        machine: machine.clone(),
        machine_path: PathBuf::from("machine.toml"),
        terms,
        instruments: vec![probe(machine)],
        tables: vec![Vec::new()],
        stages: Default::default(),
        limits: Default::default(),
    }
}

/// Closed curves in all axes, each axis with a frequency of its own, so that all turn round.
fn commands(machine: &Machine) -> Vec<Command> {
    let at = |k: usize| {
        let t = std::f64::consts::TAU * k as f64 / 60.0;
        let mut q = Command::default();
        for (i, axis) in machine.axes().iter().enumerate() {
            let (order, size) = match axis.kind {
                AxisKind::Linear => (1.0 + i as f64 % 3.0, 60.0),
                AxisKind::Rotary => (2.0, 0.3),
            };
            q[i] = size * (order * t + 0.7 * i as f64).sin();
        }
        q
    };
    (0..=60).map(at).collect()
}

fn paths(campaign: &Campaign, feeds: &[Option<f64>]) -> Vec<Path> {
    let path = |feed: &Option<f64>| {
        let mut stations = Readings::default();
        for (group, command) in commands(&campaign.machine).iter().enumerate() {
            stations.push(station(*command, campaign, 0, group));
        }
        let feed_mm_per_s = feed.map(|f| f / 60.0);
        Path { name: format!("{feed:?}"), stations, feed_mm_per_s, dwell_s: 1.0, overrun: 0.0 }
    };
    feeds.iter().map(path).collect()
}

struct Injected {
    axes: [AxisDisturb; MAX_AXES],
    geometry: Vec<f64>,
}

fn inject(campaign: &Campaign, random: &mut Random) -> Injected {
    let mut axes = [AxisDisturb::default(); MAX_AXES];
    for (disturb, axis) in axes.iter_mut().zip(campaign.machine.axes()) {
        let size = if axis.kind == AxisKind::Rotary { 2e-5 } else { 4e-3 };
        disturb.lag_s = 0.02 + 0.03 * random.unit();
        disturb.backlash = size * random.unit();
        disturb.spike = size * random.unit();
        disturb.spike_time_s = FREE_S;
    }
    let size = |t: &Term| if t.error.component.is_rotation() { 6e-5 } else { 0.02 };
    let made = campaign.terms.iter().filter(|t| !t.basis.is_servo());
    Injected { axes, geometry: made.map(|t| random.within(size(t))).collect() }
}

fn readings(
    campaign: &Campaign,
    injected: &Injected,
    feeds: &[Option<f64>],
    seed: u64,
) -> Readings {
    let mut machine = campaign.design().machine;
    let made = campaign.terms.iter().filter(|t| !t.basis.is_servo());
    for (term, value) in made.zip(&injected.geometry) {
        machine = machine.with_error(term.index, Some(StatedError::constant(*value, None)));
    }
    let truth = Truth {
        machine,
        machine_path: None,
        errors: Vec::new(),
        factors: None,
        instruments: campaign.instruments.clone(),
        setups: vec![Vec::new()],
        log: None,
        added: Vec::new(),
        seed,
    };
    let disturb = Disturb { axes: injected.axes, ..Disturb::of_instruments(1) };
    let real = VirtualCampaign { paths: paths(campaign, feeds), truth, disturb };
    measure(campaign, &real).expect("no tables").readings
}

fn found(campaign: &Campaign, readings: Readings) -> Identification {
    let mut problems = Diagnostics::new();
    let found = identify(campaign, &Options::default(), &Records::bare(readings), &mut problems);
    found.unwrap_or_else(|| panic!("{}: {problems:?}", campaign.machine.name()))
}

/// The true value of a servo unknown by its name: `lag X`.
fn truth_of(campaign: &Campaign, injected: &Injected, term: &Term) -> f64 {
    let made: Vec<&Term> = campaign.terms.iter().filter(|t| !t.basis.is_servo()).collect();
    let Some(axis) = term.axis.filter(|_| term.basis.is_servo()) else {
        let k = made.iter().position(|t| **t == *term).expect("a location error");
        return injected.geometry[k];
    };
    let of = injected.axes[axis];
    match term.basis {
        Basis::Lag { .. } => of.lag_s,
        Basis::LostMotion { .. } => of.backlash,
        _ => of.spike,
    }
}

/// How many unknowns are within 2 U of the truth, within U, and how many there are.
fn score(campaign: &Campaign, injected: &Injected, found: &Identification) -> [usize; 3] {
    let mut counts = [0; 3];
    for (term, f) in found.design.terms.iter().zip(&found.found) {
        let Some((value, u)) = f.value else { continue };
        let off = (value - truth_of(campaign, injected, term)).abs();
        // U = 2u, and "within 2 U" is four standard uncertainties.
        assert!(off < 4.0 * u, "{}: {} off by {off:e}, u {u:e}", campaign.machine.name(), f.name);
        counts[0] += usize::from(off < 4.0 * u);
        counts[1] += usize::from(off < 1.96 * u);
        counts[2] += 1;
    }
    counts
}

/// The servo unknowns that are named as not observable, by their names.
fn named(found: &Identification) -> Vec<String> {
    let is_named = |name: &str| found.unobservable.iter().any(|u| names_it(&u.combination, name));
    let unseen = found.design.terms.iter().zip(&found.found).filter(|(t, f)| {
        // A servo unknown without a value that is named nowhere would be lost in silence.
        let lost = t.basis.is_servo() && f.value.is_none();
        assert!(!lost || is_named(&f.name), "{} is neither found nor named", f.name);
        lost
    });
    unseen.map(|(_, f)| f.name.clone()).collect()
}

/// Whether a name stands in a sum such as `EX0C − 2 · lag X + lag Y`.
fn names_it(sum: &str, name: &str) -> bool {
    sum.split(['−', '+', '·']).any(|part| part.trim() == name)
}

/// The gain mismatch of every lag against the first that is seen, true and found with its u, s.
fn mismatches(found: &Identification, injected: &Injected) -> Vec<[f64; 3]> {
    let lags: Vec<(usize, f64)> = found
        .design
        .terms
        .iter()
        .enumerate()
        .filter(|(k, t)| t.basis.is_lag() && found.found[*k].value.is_some())
        .filter_map(|(k, t)| Some((k, injected.axes[t.axis?].lag_s)))
        .collect();
    let c = &found.fit.covariance;
    let pairs = lags.iter().skip(1).map(|(k, truth)| {
        let (first, first_truth) = lags[0];
        let value = |k: usize| found.found[k].value.map_or(f64::NAN, |(v, _)| v);
        let variance = c[(*k, *k)] + c[(first, first)] - 2.0 * c[(*k, first)];
        let u = variance.max(0.0).sqrt();
        [truth - first_truth, value(*k) - value(first), u]
    });
    pairs.collect()
}

#[test]
fn law_lag_gain_friction_and_lost_motion_at_three_feeds_come_back_on_eight_machines() {
    // Lag, lost motion and friction of every axis come back within 2 U; so do gain mismatch and velocity
    // gain. What is not observable is named and not counted: C under a tool on its own axis turns nothing.
    let mut random = Random(2003);
    let (mut counts, mut unseen) = ([0; 3], Vec::new());
    for name in MACHINES {
        let campaign = campaign(&machine(name), true);
        for seed in 5..8 {
            let injected = inject(&campaign, &mut random);
            let feeds = [STILL, Some(30.0), Some(150.0)];
            let found = found(&campaign, readings(&campaign, &injected, &feeds, seed));
            let of_this = score(&campaign, &injected, &found);
            let named = named(&found);
            let all = found.design.terms.len();
            assert_eq!(of_this[2] + unseen_of(&found), all, "{name}");
            for [truth, value, u] in mismatches(&found, &injected) {
                assert!(
                    (value - truth).abs() < 4.0 * u,
                    "{name}: mismatch {value:e} ± {u:e}, {truth:e}"
                );
            }
            for (term, f) in found.design.terms.iter().zip(&found.found) {
                let (true, Some((lag, u)), Some(axis)) = (term.basis.is_lag(), f.value, term.axis)
                else {
                    continue;
                };
                // Kv = 1/τ, u(Kv) = u/τ². A U as large as the lag would prove nothing.
                let (kv, true_kv) = (1.0 / lag, 1.0 / injected.axes[axis].lag_s);
                assert!((kv - true_kv).abs() < 4.0 * u * kv * true_kv, "{name}: Kv of {}", f.name);
                assert!(2.0 * u < 0.3 * lag, "{name}: {} U {:e}", f.name, 2.0 * u);
            }
            (0..3).for_each(|k| counts[k] += of_this[k]);
            if seed == 5 {
                unseen.extend(named.iter().map(|n| format!("{name}: {n}")));
            }
        }
    }
    let share = counts[1] as f64 / counts[2] as f64;
    assert!((0.93..=0.97).contains(&share), "U is stated properly: {share} within it");
    assert_eq!(unseen, UNSEEN);
    assert_eq!(counts[2], 540, "all others, three times");
}

/// The servo unknowns of all eight machines that these paths cannot show: C turns under a point on its own axis.
/// B of nutating-head lies along no axis of the machine: a campaign refuses its servo (`inclined-axis`).
const UNSEEN: [&str; 6] = [
    "i5-engraver: lag C",
    "i5-engraver: lost motion C",
    "i5-engraver: friction C",
    "nutating-head: lag C",
    "nutating-head: lost motion C",
    "nutating-head: friction C",
];

fn unseen_of(found: &Identification) -> usize {
    found.design.terms.iter().zip(&found.found).filter(|(_, f)| f.value.is_none()).count()
}

#[test]
fn law_at_one_feed_every_lag_is_named_on_eight_machines() {
    let mut random = Random(30);
    for name in MACHINES {
        let campaign = campaign(&machine(name), true);
        let injected = inject(&campaign, &mut random);
        let one = found(&campaign, readings(&campaign, &injected, &[Some(150.0)], 5));
        let lags = one.design.terms.iter().zip(&one.found).filter(|(t, _)| t.basis.is_lag());
        for (_, lag) in lags {
            let shared = one.feeds.not_separable.iter().find(|s| s.name == lag.name);
            let words = shared.map(|s| s.words()).unwrap_or_default();
            let unseen = one.unobservable.iter().any(|u| names_it(&u.combination, &lag.name));
            assert!(unseen || words.contains(&lag.name), "{name}: {} is not named", lag.name);
            // By name what it passes for, or that nothing shows it.
            assert!(unseen || shared.is_some_and(|s| !s.passes_for.is_empty()), "{name}: {words}");
        }
        let three = [STILL, Some(30.0), Some(150.0)];
        let all = found(&campaign, readings(&campaign, &injected, &three, 5));
        assert!(all.feeds.not_separable.is_empty(), "{name}: {:?}", all.feeds.not_separable);
    }
}

#[test]
fn law_a_common_lag_on_the_paths_f_and_s_is_separated_or_named() {
    // Lei and Hsu's own paths with 30 ms in every axis. On one path alone such a lag is a delay along it.
    let file = root().join("examples/05_identify/probe-ball-two-feeds.toml");
    let (read, problems) =
        read_campaign(&disk(), &file, |root, campaign| read_virtual(root, campaign, None));
    let (campaign, mut real) = read.unwrap_or_else(|| panic!("{problems:?}"));
    const LAG_S: f64 = 0.03;
    real.disturb.axes.iter_mut().for_each(|a| a.lag_s = LAG_S);
    let made = measure(&campaign, &real).expect("no tables").readings;
    let feed = |i: usize| made.motions[i].feed_mm_per_s.unwrap_or(0.0);
    let cases: [(&str, Readings); 3] = [
        ("three feeds", made.clone()),
        ("150 mm/min alone", made.filtered(|i| feed(i) > 2.0)),
        ("30 and 150 mm/min", made.filtered(|i| feed(i) > 0.1)),
    ];
    for (case, readings) in cases {
        let found = found(&campaign, readings);
        let mut apart = 0;
        for (term, f) in found.design.terms.iter().zip(&found.found) {
            if !term.basis.is_lag() {
                continue;
            }
            if let Some((value, u)) = f.value {
                assert!((value - LAG_S).abs() < 4.0 * u, "{case}: {} {value} ± {u}", f.name);
            }
            let is_named = found.feeds.not_separable.iter().any(|s| s.name == f.name)
                || found.unobservable.iter().any(|o| names_it(&o.combination, &f.name));
            let seen = f.value.is_some_and(|(value, u)| 4.0 * u < value);
            assert!(seen || is_named, "{case}: {} is neither separated nor named", f.name);
            apart += usize::from(seen && !is_named);
        }
        let expected = if case == "150 mm/min alone" { 0 } else { 5 };
        assert_eq!(apart, expected, "{case}");
    }
}

/// 95 % intervals of geometry with lag present, on all machines in turn: the share that holds, of how many.
fn coverage(campaigns: u64) -> (f64, u32) {
    let mut random = Random(77);
    let all_machines = MACHINES.map(|name| campaign(&machine(name), true));
    let (mut within, mut all) = (0, 0);
    for seed in 0..campaigns {
        let campaign = &all_machines[seed as usize % MACHINES.len()];
        let injected = inject(campaign, &mut random);
        let found = found(campaign, readings(campaign, &injected, &[STILL, Some(150.0)], seed));
        for (term, f) in found.design.terms.iter().zip(&found.found) {
            let (false, Some((value, u))) = (term.basis.is_servo(), f.value) else { continue };
            let off = (value - truth_of(campaign, &injected, term)).abs();
            within += u32::from(off < 1.96 * u);
            all += 1;
        }
    }
    (f64::from(within) / f64::from(all), all)
}

#[test]
fn law_geometry_is_covered_with_lag_present() {
    let (share, all) = coverage(40);
    assert!((0.91..=0.985).contains(&share), "{share} of {all}");
}

/// On 24 November 2026, 100 campaigns on each of the eight machines: 94.5 % of 8200 intervals.
#[test]
#[ignore = "cargo nextest run -p trueaxis-calibrate --test servo_laws --run-ignored all covered_between"]
fn law_geometry_is_covered_between_93_and_97_percent() {
    let (share, all) = coverage(800);
    assert!((0.93..=0.97).contains(&share), "{share} of {all}");
}

#[test]
fn law_gain_mismatch_turns_a_circle_into_an_ellipse_at_45_degrees() {
    // Two axes with lags that differ by Δτ on a circle at feed F: the radius deviates by
    // F Δτ/2 · sin 2φ (ISO 230-4), half the difference of the following errors.
    let (feed, tau) = (2.5, [0.03, 0.034]);
    for k in 0..360 {
        let (s, c) = f64::from(k).to_radians().sin_cos();
        let delta = [-tau[0] * -feed * s, -tau[1] * feed * c];
        let lags: Vec<f64> = [-feed * s, feed * c]
            .iter()
            .zip(tau)
            .map(|(v, tau)| {
                let motion = trueaxis_measure::measure::Motion {
                    speed: [*v, 0.0, 0.0, 0.0, 0.0, 0.0],
                    ..Default::default()
                };
                tau * Basis::Lag { sense: 1.0 }.in_motion(&[0.0; 6], &[0.0; 6], 0, &motion)
            })
            .collect();
        assert!((delta[0] - lags[0]).abs() + (delta[1] - lags[1]).abs() < 1e-15);
        let radial = lags[0] * c + lags[1] * s;
        assert!((radial - 0.5 * feed * (tau[0] - tau[1]) * 2.0 * s * c).abs() < 1e-12);
    }
}

#[test]
fn law_the_order_of_rows_does_not_matter_where_times_are_stated() {
    let campaign = campaign(&machine(MACHINES[0]), true);
    let injected = inject(&campaign, &mut Random(9));
    let all = readings(&campaign, &injected, &[STILL, Some(150.0)], 3);
    let text = all.table(&campaign.machine, &campaign.instruments[0], 0);
    let (head, rows) = text.split_once('\n').expect("a heading");
    let mut lines: Vec<&str> = rows.lines().collect();
    lines.reverse();
    let turned = format!("{head}\n{}\n", lines.join("\n"));
    let lag = |text: &str| {
        let mut problems = Diagnostics::new();
        let table = CsvTable::parse("place.csv", text, &mut problems);
        let own = &campaign.instruments[0];
        let read = Readings::parse(&table, &campaign.machine, own, 0, &mut problems);
        let mut read = read.expect("a table");
        fill_motion(&mut read, &campaign.machine, &campaign.instruments);
        let found = found(&campaign, read);
        found.found.iter().filter_map(|f| f.value).map(|(v, _)| v).collect::<Vec<f64>>()
    };
    for (a, b) in lag(&text).iter().zip(lag(&turned)) {
        assert!((a - b).abs() < 1e-9, "{a} {b}");
    }
}

#[test]
fn law_two_feeds_without_a_column_are_refused_with_the_row() {
    let campaign = campaign(&machine(MACHINES[0]), false);
    let injected = inject(&campaign, &mut Random(9));
    let mut all = readings(&campaign, &injected, &[STILL, Some(150.0)], 3);
    all.motions.iter_mut().for_each(|m| *m = Default::default());
    all.approaches.iter_mut().for_each(|a| *a = [0.0; 6]);
    for (i, line) in all.lines.iter_mut().enumerate() {
        *line = i as u32 + 2;
    }
    let mut problems = Diagnostics::new();
    let options = Options::default();
    assert!(identify(&campaign, &options, &Records::bare(all), &mut problems).is_none());
    let refused = problems.iter().find(|d| d.code == "mixed-feeds").expect("refused");
    assert!(refused.place.line > 62, "the repeat, not the first: {}", refused.place.line);
}

/// The campaign of the example, its virtual readings, and what was found.
#[test]
fn the_example_says_what_its_truth_is() {
    let file = root().join("examples/05_identify/probe-ball-two-feeds.toml");
    let (read, problems) =
        read_campaign(&disk(), &file, |root, campaign| read_virtual(root, campaign, None));
    let (campaign, real) = read.unwrap_or_else(|| panic!("{problems:?}"));
    let made = measure(&campaign, &real).expect("no tables").readings;
    let text = made.table(&campaign.machine, &campaign.instruments[0], 0);
    if let Ok(to) = std::env::var("TRUEAXIS_WRITE_TWO_FEEDS") {
        std::fs::write(to, &text).expect("written");
    }
    let whole = found(&campaign, made.clone());
    for (term, f) in whole.design.terms.iter().zip(&whole.found) {
        let (Some(axis), Some((value, u))) = (term.axis, f.value) else { continue };
        let of = real.disturb.axes[axis];
        let truth = match term.basis {
            Basis::Lag { .. } => of.lag_s,
            Basis::LostMotion { .. } => of.backlash,
            _ => of.spike,
        };
        assert!((value - truth).abs() < 4.0 * u, "{}: {value} ± {u}, true {truth}", f.name);
    }
    let one = found(
        &campaign,
        made.filtered(|i| {
            made.motions[i].feed_mm_per_s != Some(0.0)
                && made.motions[i].feed_mm_per_s.is_some_and(|f| f > 1.0)
        }),
    );
    assert_eq!(whole.feeds.not_separable, Vec::new());
    assert_eq!(one.feeds.not_separable.len(), 5, "at one feed every lag is named");
    assert_eq!((whole.feeds.counts.len(), one.feeds.counts.len()), (3, 1));
}

/// What that lag changes in the readings at every station, mm.
fn deviations(commands: &[Command], lag_s: f64, feed_mm_per_s: f64) -> Vec<[f64; 2]> {
    let of = |lag_s| read_with(commands, lag_s, feed_mm_per_s);
    of(lag_s).iter().zip(of(0.0)).map(|(a, b)| [a[0] - b[0], a[1] - b[1]]).collect()
}

/// The readings of a machine with that lag in all axes on a path, mm.
fn read_with(commands: &[Command], lag_s: f64, feed_mm_per_s: f64) -> Vec<[f64; 2]> {
    let mut campaign = campaign(&machine("three-axis-mill"), false);
    campaign.instruments[0].noise = [1e-15; 3];
    let mut stations = Readings::default();
    for (group, command) in commands.iter().enumerate() {
        stations.push(station(*command, &campaign, 0, group));
    }
    let path = Path {
        name: "path".into(),
        stations,
        feed_mm_per_s: Some(feed_mm_per_s),
        dwell_s: 1.0,
        overrun: 0.0,
    };
    let mut axes = [AxisDisturb::default(); MAX_AXES];
    axes.iter_mut().for_each(|a| a.lag_s = lag_s);
    let truth = Truth {
        machine: campaign.design().machine,
        machine_path: None,
        errors: Vec::new(),
        factors: None,
        instruments: campaign.instruments.clone(),
        setups: vec![Vec::new()],
        log: None,
        added: Vec::new(),
        seed: 1,
    };
    let disturb = Disturb { axes, ..Disturb::of_instruments(1) };
    let real = VirtualCampaign { paths: vec![path], truth, disturb };
    let read = measure(&campaign, &real).expect("no tables").readings;
    read.values.iter().map(|v| [v[0], v[1]]).collect()
}

/// Commands of X and Y of the three-axis mill at these places.
fn places(places: impl Iterator<Item = [f64; 2]>) -> Vec<Command> {
    let machine = machine("three-axis-mill");
    let number = |letter: &str| machine.axes().iter().position(|a| a.name.to_string() == letter);
    let (x, y) = (number("X").expect("X"), number("Y").expect("Y"));
    let command = |place: [f64; 2]| {
        let mut q = Command::default();
        (q[x], q[y]) = (place[0], place[1]);
        q
    };
    places.map(command).collect()
}

#[test]
fn oracle_following_error_and_circle_against_a_simulated_loop() {
    let rows = include_str!("data/servo.csv").lines().filter(|l| l.starts_with(char::is_numeric));
    let mut count = 0;
    for row in rows {
        let n: Vec<f64> = row.split(',').map(|v| v.parse().expect("a number")).collect();
        let [kv, k, feed, radius, following_um, change_um, phase_urad] = n[..] else {
            panic!("{row}")
        };
        // Feedforward k leaves (1 − k) of the following error: the lag that is identified.
        let (lag_s, v) = ((1.0 - k) / kv, feed / 60.0);
        let unknown = lag_s * v * 1e3;
        assert!((unknown - following_um).abs() < 1e-6 * following_um, "{row}: {unknown}");
        let ramp = places((0..=40).map(|i| [v * 0.1 * f64::from(i), 0.0]));
        let last = deviations(&ramp, lag_s, v)[40][0];
        assert!((last.abs() * 1e3 - following_um).abs() < 1e-6 * following_um, "{row}: {last}");
        // An arc of 60 time constants in steps of 1/20 of one, so that it is no polygon.
        let stations = 1200;
        let angle = |i: i32| v / radius * 0.05 * lag_s * f64::from(i);
        let circle = places((0..=stations).map(|i| {
            let (s, c) = angle(i).sin_cos();
            [radius * c, radius * s]
        }));
        let (mut change, mut phase) = (0.0, 0.0);
        let read = deviations(&circle, lag_s, v);
        // The sense in which the probe reads, by the ramp: it reads less.
        let sense = -last.signum();
        for i in stations / 2..stations {
            let (s, c) = angle(i).sin_cos();
            let d = read[i as usize].map(|d| d * sense);
            let at = [radius * c + d[0], radius * s + d[1]];
            change += at[0].hypot(at[1]) - radius;
            phase += (at[1] * c - at[0] * s).atan2(at[0] * c + at[1] * s);
        }
        let half = f64::from(stations / 2);
        let (change_is, phase_is) = (change / half * 1e3, phase / half * 1e6);
        assert!((phase_is - phase_urad).abs() < 1e-3 * phase_urad.abs(), "{row}: {phase_is} µrad");
        // DIFFERENCE: with feedforward the radius shrinks by (1 − k²) of R(ω/Kv)²/2, a lag of
        // (1 − k)/Kv alone by (1 − k)²; both are of second order.
        let of_lag = match k == 0.0 {
            true => change_um,
            false => change_um * (1.0 - k) / (1.0 + k),
        };
        assert!(
            (change_is - of_lag).abs() < 5e-3 * of_lag.abs() + 1e-4,
            "{row}: {change_is} µm, {of_lag}"
        );
        count += 1;
    }
    assert_eq!(count, 6);
}

#[test]
fn law_a_lag_that_is_left_out_shows_in_the_verdict() {
    // The same readings, standing and moving, without the servo among the unknowns.
    for name in ["xkas2525", "lei-hsu-mill", "three-axis-mill"] {
        let with = campaign(&machine(name), true);
        let injected = inject(&with, &mut Random(4));
        let read = readings(&with, &injected, &[STILL, Some(150.0)], 3);
        let right = found(&with, read.clone());
        let wrong = found(&campaign(&machine(name), false), read);
        assert!(!wrong.verdict.is_good(), "{name}: {:?}", wrong.verdict);
        assert!(right.verdict.is_good(), "{name}: {:?}", right.verdict);
    }
}

#[test]
fn law_a_lag_that_all_axes_share_is_told_apart_or_named() {
    for name in ["xkas2525", "lei-hsu-mill", "three-axis-mill"] {
        let campaign = campaign(&machine(name), true);
        let mut injected = inject(&campaign, &mut Random(6));
        injected.axes.iter_mut().for_each(|a| a.lag_s = 0.03);
        let read = readings(&campaign, &injected, &[STILL, Some(30.0), Some(150.0)], 8);
        let found = found(&campaign, read);
        score(&campaign, &injected, &found);
        for (_, f) in found.design.terms.iter().zip(&found.found).filter(|(t, _)| t.basis.is_lag())
        {
            let seen = f.value.is_some_and(|(value, u)| 4.0 * u < value);
            let named = found.feeds.not_separable.iter().any(|s| s.name == f.name);
            let unseen = found.unobservable.iter().any(|u| format!("{u:?}").contains(&f.name));
            assert!(seen || named || unseen, "{name}: {} {:?}", f.name, f.value);
        }
    }
}
