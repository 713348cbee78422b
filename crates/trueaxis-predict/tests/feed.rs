//! The part at a feed: closed forms of axes that follow late, and a loop in the time domain.

use std::collections::HashMap;
use std::io;
use std::path::{Path, PathBuf};
use trueaxis_input::{CsvTable, Diagnostics, Files, Source};
use trueaxis_predict::predict::{Prediction, parse_study, predict};

/// Files of a test: some of its own, the rest from the repository.
struct Memory(HashMap<PathBuf, String>);

impl Source for Memory {
    fn read(&self, path: &Path) -> io::Result<Vec<u8>> {
        match self.0.get(path) {
            Some(text) => Ok(text.clone().into_bytes()),
            None => std::fs::read(root().join(path)),
        }
    }

    fn is_file(&self, path: &Path) -> bool {
        self.0.contains_key(path) || root().join(path).is_file()
    }
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

const MACHINE: &str = r#"
[machine]
name = "three axes without errors"
chain = "w b X Y Z t"
[axis.X]
max_velocity = "1000 m/min"
max_acceleration = "1000 m/s^2"
[axis.Y]
max_velocity = "1000 m/min"
max_acceleration = "1000 m/s^2"
[plausible]
velocity_m_per_min = 1000
acceleration_m_per_s2 = 1000
"#;

/// A cylinder around which the tip goes at this radius and feed.
fn cylinder(radius_mm: f64, positions: usize, feed: &str) -> String {
    format!(
        r#"
name = "cylinder"
[cone]
half_angle = "0 deg"
base_diameter = "{} mm"
height = "20 mm"
positions = {positions}
sections = ["0 mm", "10 mm", "20 mm"]
roundness_at = "10 mm"
angularity_over = ["0 mm", "20 mm"]
[[condition]]
name = "finish"
feed = "{feed}"
[tool]
diameter = "20 mm"
[tolerance]
roundness_mzc = "0.1 mm"
"#,
        2.0 * radius_mm - 20.0
    )
}

fn predicted(machine: &str, piece: &str, servo: &str) -> Prediction {
    let files = HashMap::from([("m.toml".into(), machine.into()), ("p.toml".into(), piece.into())]);
    let text = format!(
        "name = \"s\"\nmachine = \"m.toml\"\ntest_piece = \"p.toml\"\n[monte_carlo]\nsamples = 0\n{servo}"
    );
    let (study, problems) = parse_study(&Files::new(Memory(files)), Path::new("s.toml"), &text);
    let study = study.unwrap_or_else(|| panic!("{:?}", problems.iter().collect::<Vec<_>>()));
    predict(&study, &|_| ()).expect("a prediction")
}

const MZC: usize = 5;
const LARGEST: usize = 10;

/// Value of an index at the only feed, mm.
fn at_feed(radius_mm: f64, positions: usize, feed: &str, servo: &str, index: usize) -> f64 {
    let prediction = predicted(MACHINE, &cylinder(radius_mm, positions, feed), servo);
    prediction.conditions[0].indices_mm[index]
}

/// The same lag of both axes: the circle shrinks to R/√(1 + (ωτ)²) and is round, wherever it is checked.
#[test]
fn law_equal_lags_shrink_the_circle() {
    for (radius, feed_mm_per_min, tau) in [
        (50.0, 1500.0, 0.02),
        (50.0, 6000.0, 0.02),
        (134.659, 30_000.0, 0.01),
        (20.0, 3000.0, 0.05),
    ] {
        let turn = feed_mm_per_min / 60.0 / radius * tau;
        let shrinks = radius - radius / (1.0 + f64::powi(turn, 2)).sqrt();
        let servo = format!("[servo]\nX.lag = \"{tau} s\"\nY.lag = \"{tau} s\"\n");
        for positions in [24, 72, 100] {
            let feed = format!("{feed_mm_per_min} mm/min");
            let largest = at_feed(radius, positions, &feed, &servo, LARGEST);
            assert!((largest - shrinks).abs() < 2e-5, "{radius} {positions}: {largest} {shrinks}");
            let round = at_feed(radius, positions, &feed, &servo, MZC);
            assert!(round < 2e-5, "{round}");
        }
    }
}

/// Different lags: an ellipse at 45°, ΔR = ½ F Δτ sin 2φ, so that the zone is F |Δτ| wide; which axis is late
/// and by how much both are does not matter.
#[test]
fn law_unequal_lags_make_an_ellipse() {
    for (x, y) in [(0.020, 0.021), (0.021, 0.020), (0.001, 0.0), (0.0, 0.001)] {
        let servo = format!("[servo]\nX.lag = \"{x} s\"\nY.lag = \"{y} s\"\n");
        for feed in [300.0, 1500.0] {
            let zone = at_feed(100.0, 72, &format!("{feed} mm/min"), &servo, MZC);
            let expected: f64 = feed / 60.0 * 0.001;
            assert!((zone / expected - 1.0).abs() < 0.002, "{x} {y} {feed}: {zone} {expected}");
        }
    }
    // At 22.5° to the ellipse the same: positions at 0°, 90° … see no radial deviation of it.
    let servo = "[servo]\nX.lag = \"1 ms\"\n";
    let prediction = predicted(MACHINE, &cylinder(100.0, 72, "1500 mm/min"), servo);
    // u of a lag passes through with the same slope.
    assert_eq!(prediction.conditions[0].u_mm[MZC], 0.0);
    // Also of a lag that is smaller than its u, which can be moved up only.
    for lag in ["1.0", "0.02", "0"] {
        let servo = format!("[servo]\nX.lag = \"{lag} ± 0.1 ms\"\n");
        let prediction = predicted(MACHINE, &cylinder(100.0, 72, "1500 mm/min"), &servo);
        let u = prediction.conditions[0].u_servo_mm[MZC];
        assert!((u - 0.0025).abs() < 2e-5, "{lag}: {u}");
    }
}

/// A loop with feedforward in the time domain (scipy): `oracles/servo.py`.
#[test]
fn oracle_the_radius_of_a_loop_with_feedforward() {
    let text =
        std::fs::read_to_string(root().join("crates/trueaxis-calibrate/tests/data/servo.csv"));
    let mut problems = Diagnostics::new();
    let table = CsvTable::parse("servo.csv", &text.expect("the table"), &mut problems);
    let column = |name: &str| table.column(name).expect("a column").values.clone();
    let (kv, k, feed) = (column("kv_per_s"), column("feedforward"), column("feed_mm_per_min"));
    let (radius, change_um) = (column("radius_mm"), column("radius_change_um"));
    assert!(kv.len() > 4);
    for row in 0..kv.len() {
        let axis = format!("{{ gain = {}, feedforward = {} }}", kv[row], k[row]);
        let servo = format!("[servo]\nX = {axis}\nY = {axis}\n");
        let feed = format!("{} mm/min", feed[row]);
        let largest = at_feed(radius[row], 72, &feed, &servo, LARGEST);
        assert!(
            (largest * 1e3 + change_um[row]).abs() < 0.02,
            "{row}: {largest} {}",
            change_um[row]
        );
    }
}

/// Without a lag nothing changes, to the last bit.
#[test]
fn law_no_lag_changes_nothing() {
    let study = |servo: &str| {
        let machine = std::fs::read_to_string(root().join("machines/three-axis-mill/machine.toml"));
        let machine = machine.expect("the machine");
        // The tables stand beside the machine.
        let lines = machine.lines().filter(|l| !l.contains("table")).collect::<Vec<_>>().join("\n");
        predicted(&lines, &cylinder(100.0, 72, "3 m/min"), servo)
    };
    let still = study("");
    assert!(still.conditions.is_empty());
    let zero = study("[servo]\nX.lag = \"0 ms\"\nY = { lost_motion = \"0 um\" }\n");
    let there = &zero.conditions[0];
    for (i, index) in still.indices.iter().enumerate() {
        assert_eq!(index.value_mm.to_bits(), there.indices_mm[i].to_bits());
        assert_eq!(index.u_mm.to_bits(), there.u_mm[i].to_bits());
        assert!(there.servo_alone_mm[i].abs() < 1e-12, "{}", there.servo_alone_mm[i]);
    }
    // A lag of a nanosecond is next to none.
    let small = study("[servo]\nX.lag = \"0.000001 ms\"\n");
    for (i, index) in still.indices.iter().enumerate() {
        assert!((index.value_mm - small.conditions[0].indices_mm[i]).abs() < 1e-5);
    }
}

/// A play of b displaces the tool by b/2 to either side; twice the play twice the form.
#[test]
fn a_play_makes_a_step_at_the_quadrants() {
    let zone = |b: f64| {
        at_feed(100.0, 360, "1500 mm/min", &format!("[servo]\nX.lost_motion = \"{b} um\"\n"), MZC)
    };
    let (small, large) = (zone(4.0), zone(8.0));
    assert!((0.003..0.0041).contains(&small), "{small}");
    assert!((large / small - 2.0).abs() < 0.05, "{large}");
    let largest =
        at_feed(100.0, 360, "1500 mm/min", "[servo]\nX.lost_motion = \"4 um\"\n", LARGEST);
    assert!((largest - 0.002).abs() < 1e-5, "{largest}");
}

/// The frustum of Wu et al. 2022 on its gantry.
fn gantry(more: &str) -> Prediction {
    let text = format!(
        "name = \"s\"\nmachine = \"machines/xkas2525/machine.toml\"\n\
         test_piece = \"testpieces/nas979-gbt33150.toml\"\n[monte_carlo]\nsamples = 0\n{more}"
    );
    let files = Files::new(Memory(HashMap::new()));
    let (study, problems) = parse_study(&files, Path::new("s.toml"), &text);
    let study = study.unwrap_or_else(|| panic!("{:?}", problems.iter().collect::<Vec<_>>()));
    predict(&study, &|_| ()).expect("a prediction")
}

/// The length of the tool as it was measured, with u: u of an index grows by its slope times u.
#[test]
fn law_the_measured_length_of_the_tool_enters_with_its_uncertainty() {
    let coaxiality = 8;
    let [without, with] = [gantry(""), gantry("[what_if]\nEZ0t = \"25 ± 30 um\"\n")];
    let slope = with.sensitivities.iter().find(|s| s.error.to_string() == "EZ0t").expect("EZ0t");
    // The machine file states 25 ± 0.5 µm.
    let added = slope.slope[coaxiality] * (0.030f64.powi(2) - 0.0005f64.powi(2)).sqrt();
    let [before, after] = [&without, &with].map(|p| p.indices[coaxiality].u_mm);
    // A length is not linear: 30 µm are a large step.
    assert!((after - before.hypot(added)).abs() < 2e-5, "{before} {after} {added}");
    assert!(added.abs() > 0.001, "{added}");
    // The zero was touched with this tool upright, and the piece leans by 10°: what is cut moves across its axis by
    // sin 10° of the length.
    let longer = gantry("[what_if]\nEZ0t = \"55 um\"\n");
    let centre = |p: &Prediction| p.sections[1].section.circles.lsc.center_mm;
    let moved = centre(&longer)[0] - centre(&without)[0];
    assert!((moved.abs() - 0.030 * 10f64.to_radians().sin()).abs() < 1e-5, "{moved}");
}

/// Five axes that are all late alike cut nearly the same part; one that is late alone does not.
#[test]
fn five_axes_that_are_late_alike_leave_the_part() {
    let study = gantry;
    let all = "[servo]\nX.lag = \"10 ms\"\nY.lag = \"10 ms\"\nZ.lag = \"10 ms\"\nC.lag = \"10 ms\"\nA.lag = \"10 ms\"\n";
    let alike = study(all);
    assert_eq!(alike.conditions.len(), 4);
    // 1.5 m/min, 10 ms: 250 µm late along the path; across it of second order.
    let slow = &alike.conditions[0];
    assert!(slow.servo_alone_mm[MZC] < 0.0005, "{}", slow.servo_alone_mm[MZC]);
    let alone = study("[servo]\nX.lag = \"1 ms\"\n");
    let zones: Vec<f64> = alone.conditions.iter().map(|c| c.servo_alone_mm[MZC]).collect();
    assert!(zones[0] > 0.005 && (zones[1] / zones[0] - 2.0).abs() < 0.05, "{zones:?}");
    // 10 and 30 m/min: the axes of this gantry do not allow it all around.
    let fastest = alone.conditions[3].speed_mm_per_s;
    assert!(fastest[0] < 500.0 && fastest[1] <= 500.0, "{fastest:?}");
    assert!(alone.warnings.iter().any(|w| w.contains("condition 4")), "{:?}", alone.warnings);
}

/// What cannot be is refused, with its place.
#[test]
fn a_servo_that_cannot_be_is_refused() {
    let problems = |servo: &str| {
        let more = "coaxiality_lsc = \"0.1 mm\"\nangularity_zone = \"0.1 mm\"\n";
        let piece = cylinder(50.0, 72, "3 m/min") + more;
        let files = HashMap::from([("m.toml".into(), MACHINE.into()), ("p.toml".into(), piece)]);
        let text = format!("name = \"s\"\nmachine = \"m.toml\"\ntest_piece = \"p.toml\"\n{servo}");
        let (study, found) = parse_study(&Files::new(Memory(files)), Path::new("s.toml"), &text);
        assert!(study.is_none(), "{servo}");
        found.iter().map(|d| d.code).collect::<Vec<_>>()
    };
    assert_eq!(problems("[servo]\nA.lag = \"1 ms\"\n"), ["unknown-axis"]);
    assert_eq!(problems("[servo]\nX.lag = \"1 um\"\n"), ["wrong-unit"]);
    assert_eq!(problems("[servo]\nX.lag = \"-1 ms\"\n"), ["negative"]);
    assert_eq!(problems("[servo]\nX.lag = \"20 s\"\n"), ["bad-gain"]);
    assert_eq!(problems("[servo]\nX = { gain = 0 }\n"), ["bad-gain"]);
    assert_eq!(problems("[servo]\nX = { gain = 50, lag = \"20 ms\" }\n"), ["bad-gain"]);
    assert_eq!(problems("[servo]\nX = { gain = 50, feedforward = 2 }\n"), ["bad-gain"]);
    assert_eq!(problems("[servo]\nX.friction = \"3 um\"\n"), ["missing-key"]);
    assert_eq!(problems("[servo]\nX.backlash = \"3 um\"\n"), ["unknown-key"]);
}
