//! Our figures for the claims of Lei and Hsu 2003.

use crate::Ours;
use crate::shop::{command, list, machine, nominal, root, shown, target};
use trueaxis::files::disk;
use trueaxis::geometry::Vec3;
use trueaxis::machine::axis::Command;
use trueaxis::machine::{Machine, Target};
use trueaxis::measure::path::Path;
use trueaxis::plan::{Plan, read_plan};

pub const CLAIMS: &[(&str, Ours)] = &[
    ("004-eq-8-10-a30-c90", || linear_axes(30.0, 90.0)),
    ("004-eq-8-10-a45-c-60", || linear_axes(45.0, -60.0)),
    ("004-eq-2-4-a90-c30", || tip("X=300 Y=180 Z=-200 A=90 C=30")),
    ("004-eq-2-4-a30-c60", || tip("X=300 Y=180 Z=-200 A=30 C=60")),
    ("004-eq-5-7", || list(nominal(&mill(), &command(&mill(), "A=30 C=60")).1)),
    ("004-eq-11-12", quadrant),
    ("004-path-f", path_f),
    ("004-path-s-reversal-a", || vec![turning_point('A', 0.5, 150.0, 215.0)]),
    ("004-path-s-reversal-c-120", || {
        vec![turning_point('C', 0.5, 80.0, 170.0), turning_point('C', 0.5, 190.0, 280.0)]
    }),
    ("004-path-s-reversal-x-120", || {
        vec![turning_point('X', 0.5, 100.0, 140.0), turning_point('X', 0.5, 220.0, 260.0)]
    }),
    ("004-path-s-reversal-c-150", || {
        let tan_squared = 0.75f64.sqrt();
        let turns = |from, to| turning_point('C', tan_squared, from, to);
        vec![turns(110.0, 178.0), turns(182.0, 250.0)]
    }),
    ("004-path-a-moves", || moved("A")),
    ("004-path-c-moves", || moved("C")),
    ("004-path-f-planned", planned_f),
    ("004-path-s-planned", planned_s),
    ("004-no-errors", no_errors),
    ("004-feeds", || {
        let mut feeds: Vec<f64> = two_feeds().iter().map(|row| row[1]).collect();
        feeds.sort_by(f64::total_cmp);
        feeds.dedup();
        feeds
    }),
    ("004-fig-10-12", grows_with_feed),
];

/// y in µm and feed in mm/min of every row of the readings at two feeds.
fn two_feeds() -> Vec<[f64; 2]> {
    let file = root().join("examples/05_identify/probe-ball-two-feeds.csv");
    let text = std::fs::read_to_string(file).expect("shipped readings");
    let mut lines = text.lines();
    let head: Vec<&str> = lines.next().expect("a heading").split(',').collect();
    let column = |name: &str| head.iter().position(|h| *h == name).expect("a column");
    let (y, feed) = (column("y_um"), column("feed_mm_per_min"));
    let row = |line: &str| {
        let cells: Vec<f64> = line.split(',').map(|c| c.parse().expect("a number")).collect();
        [cells[y], cells[feed]]
    };
    lines.map(row).collect()
}

/// Path F is the first 37 rows standing, then after those of path S at 30 and at 150 mm/min.
fn grows_with_feed() -> Vec<f64> {
    const STATIONS: usize = 37;
    const NOISE_UM: f64 = 1.0;
    let rows = two_feeds();
    let y = |pass: usize| rows[2 * pass * STATIONS..][..STATIONS].iter().map(|r| r[0]);
    let off = |pass| y(pass).zip(y(0)).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    let (slow, fast): (f64, f64) = (off(1), off(2));
    vec![f64::from(u8::from(fast > slow)), f64::from(u8::from(slow > NOISE_UM))]
}

/// The paths of examples/04_plan/probe-ball.toml.
fn planned() -> Plan {
    let file = root().join("examples/04_plan/probe-ball.toml");
    let (plan, problems) = read_plan(&disk(), &file);
    plan.unwrap_or_else(|| panic!("{problems:?}"))
}

fn path<'p>(plan: &'p Plan, name: &str) -> &'p Path {
    plan.paths.iter().find(|p| p.name == name).expect("a path")
}

/// By how much each of X, Y, Z, A, C moves along a path, 0 or 1.
fn moved(name: &str) -> Vec<f64> {
    let plan = planned();
    let machine = &plan.campaign.machine;
    let commands = &path(&plan, name).stations.commands;
    let all: Vec<Vec<f64>> = commands.iter().map(|c| shown(machine, c, "XYZAC")).collect();
    let range = |i: usize| {
        let values = all.iter().map(|c| c[i]);
        values.fold((f64::MAX, f64::MIN), |(a, b), v| (a.min(v), b.max(v)))
    };
    (0..5).map(|i| f64::from(range(i).1 - range(i).0 > 1e-9)).collect()
}

/// The largest distance of A and C from 90 − φ/4 and 90 − φ along the planned path F, deg; the pole
/// keeps the last C.
fn planned_f() -> Vec<f64> {
    let plan = planned();
    let commands = &path(&plan, "F").stations.commands;
    let steps = (commands.len() - 1) as f64;
    let mut off = [0.0_f64; 2];
    for (k, command) in commands.iter().enumerate().take(commands.len() - 1) {
        let phi = 360.0 * k as f64 / steps;
        let axes = shown(&plan.campaign.machine, command, "AC");
        off[0] = off[0].max((axes[0] - (90.0 - phi / 4.0)).abs());
        off[1] = off[1].max((axes[1] - (90.0 - phi)).abs());
    }
    off.to_vec()
}

/// The stations of the planned path S (every 10 deg) at which A, C and C turn round, deg.
fn planned_s() -> Vec<f64> {
    let plan = planned();
    let commands = &path(&plan, "S").stations.commands;
    let step = 360.0 / (commands.len() - 1) as f64;
    let turns = |letter: &str| {
        let q = |k: usize| shown(&plan.campaign.machine, &commands[k], letter)[0];
        let is_turn = |k: &usize| (q(*k) - q(k - 1)) * (q(k + 1) - q(*k)) < 0.0;
        (1..commands.len() - 1).filter(is_turn).map(|k| k as f64 * step).collect::<Vec<f64>>()
    };
    [turns("A"), turns("C")].concat()
}

/// The largest reading of the probe on the machine without errors, mm.
fn no_errors() -> Vec<f64> {
    let plan = planned();
    let probe = &plan.campaign.instruments[0];
    let reading = |path: &Path| {
        let stations = &path.stations;
        let largest = |i: usize| {
            let command = &stations.commands[i];
            let read =
                probe.nominal_reading(&plan.campaign.machine, command, stations.directions[i]);
            read.iter().fold(0.0_f64, |w, v| w.max(v.abs()))
        };
        (0..stations.len()).map(largest).fold(0.0, f64::max)
    };
    plan.paths.iter().map(reading).collect()
}

/// Radius of the spherical test surface.
const R_W_MM: f64 = 150.0;

/// The mill of the document; its tip is the programmed point, so that Zm is the command of Z.
fn mill() -> Machine {
    machine("lei-hsu-mill").with_tip(Vec3::new(0.0, 0.0, -180.0))
}

/// Eq 5–7 as the wanted tool axis.
fn axis(a_deg: f64, c_deg: f64) -> [f64; 3] {
    let ((sa, ca), (sc, cc)) = (a_deg.to_radians().sin_cos(), c_deg.to_radians().sin_cos());
    [sa * sc, sa * cc, ca]
}

fn best(machine: &Machine, wanted: &Target, from: &str) -> Command {
    let from = command(machine, from);
    machine.solve(wanted, &from).expect("reachable").solutions[0].command
}

/// Xm, Ym, Zm for the point (10, 20, 30).
fn linear_axes(a_deg: f64, c_deg: f64) -> Vec<f64> {
    let machine = mill();
    let wanted = target([10.0, 20.0, 30.0], axis(a_deg, c_deg));
    let found = best(&machine, &wanted, &format!("A={a_deg} C={c_deg}"));
    shown(&machine, &found, "XYZ")
}

fn tip(at: &str) -> Vec<f64> {
    list(nominal(&mill(), &command(&mill(), at)).0)
}

/// C and A for a tool axis in the third quadrant, from C = A = 0.
fn quadrant() -> Vec<f64> {
    let machine = mill();
    let wanted = target([0.0; 3], axis(30.0, -120.0));
    let solved = machine.solve(&wanted, &[0.0; 6]).expect("reachable");
    let upwards = solved.solutions.iter().find(|s| s.command[1] > 0.0);
    shown(&machine, &upwards.expect("a branch with a > 0").command, "CA")
}

/// A and C at phi = 120 and 300 deg of path F (Eq 14), C unwound along the path.
fn path_f() -> Vec<f64> {
    let machine = mill();
    let point = |phi_deg: f64| {
        let (sin, cos) = phi_deg.to_radians().sin_cos();
        let (up, out) = (phi_deg / 4.0).to_radians().sin_cos();
        let place = [out * cos, out * sin, up];
        target(place.map(|v| R_W_MM * v), place)
    };
    let path: Vec<Target> = (0..=30).map(|i| point(f64::from(i) * 10.0)).collect();
    let way = machine.follow(&path, &command(&machine, "A=90 C=90")).expect("a way");
    [12, 30].iter().flat_map(|&i: &usize| shown(&machine, &way[i], "AC")).collect()
}

/// Position of an axis at an angle of path S (Eq 17, 18) on the sphere.
fn on_path_s(machine: &Machine, letter: char, tan_squared_psi: f64, theta_deg: f64) -> f64 {
    let (sin_psi, cos_psi) = tan_squared_psi.sqrt().atan().sin_cos();
    let (sin, cos) = theta_deg.to_radians().sin_cos();
    let r_p = R_W_MM * sin_psi;
    let place = [r_p * sin_psi * (cos - 1.0) + R_W_MM, r_p * sin, r_p * cos_psi * (1.0 - cos)];
    let found = best(machine, &target(place, place), "A=90 C=90");
    shown(machine, &found, &letter.to_string())[0]
}

/// The angle of path S, in deg, at which an axis reverses between two angles.
fn turning_point(letter: char, tan_squared_psi: f64, from_deg: f64, to_deg: f64) -> f64 {
    let machine = mill();
    let at = |theta_deg| on_path_s(&machine, letter, tan_squared_psi, theta_deg);
    let (mut low, mut high) = (from_deg, to_deg);
    // A peak or a trough: compare the middle with the ends.
    let middle = at(0.5 * (low + high));
    let sign = if middle > at(low).max(at(high)) { 1.0 } else { -1.0 };
    assert!(sign > 0.0 || middle < at(low).min(at(high)), "{letter} does not turn round there");
    for _ in 0..60 {
        let third = (high - low) / 3.0;
        if sign * at(low + third) < sign * at(high - third) {
            low += third;
        } else {
            high -= third;
        }
    }
    0.5 * (low + high)
}
