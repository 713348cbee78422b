//! Our figures for the claims of Zhang Jian et al. 2023.

use crate::Ours;
use crate::shop::{command, machine, shown, target};
use std::f64::consts::PI;
use trueaxis::files::disk;
use trueaxis::identify::probe::datums::{FourHits, xy_datum};
use trueaxis::identify::probe::{self, Tables, identify_probe, parse_study};
use trueaxis::identify::rtcp::{Purpose, RtcpStudy, calibrate, read_rtcp};
use trueaxis::input::Diagnostics;

pub const CLAIMS: &[(&str, Ours)] = &[
    ("003-eq-1-3-A90-C0", || linear_axes(90.0, 0.0)),
    ("003-eq-1-3-A30-C90", || linear_axes(30.0, 90.0)),
    ("003-eq-1-3-A-60-C45", || linear_axes(-60.0, 45.0)),
    ("003-angles", || angles(0)),
    ("003-angles-other-branch", || angles(1)),
    ("003-angles-upright", upright),
    ("003-rtcp-half-turn", half_turn),
    ("003-rtcp-mean-of-a-turn", mean_of_a_turn),
    ("003-rtcp-step-4", step_4),
    ("003-probe-before", || probe_radii([31.0090, 31.0396])),
    ("003-probe-after", || probe_radii([30.9978, 31.0069])),
    ("003-four-hits", four_hits),
];

/// X, Y, Z for the tool tip (10, 20, 30) at these angles, on the branch that has them.
fn linear_axes(a_deg: f64, c_deg: f64) -> Vec<f64> {
    let machine = machine("i5-engraver");
    let ((sa, ca), (sc, cc)) = (a_deg.to_radians().sin_cos(), c_deg.to_radians().sin_cos());
    let wanted = target([10.0, 20.0, 30.0], [sc * sa, -cc * sa, ca]);
    let from = command(&machine, &format!("A={a_deg} C={c_deg}"));
    let best = machine.solve(&wanted, &from).expect("reachable").solutions[0].command;
    shown(&machine, &best, "XYZ")
}

/// C and A of one of the two branches with angles within half a turn.
fn angles(branch: usize) -> Vec<f64> {
    let machine = machine("i5-engraver");
    let wanted = target([10.0, 20.0, 30.0], [0.3, -0.2, 0.93]);
    let solved = machine.solve(&wanted, &[0.0; 6]).expect("reachable");
    let within = |s: &&trueaxis::machine::Solution| s.command[..2].iter().all(|q| q.abs() <= PI);
    let solution = solved.solutions.iter().filter(within).nth(branch);
    shown(&machine, &solution.expect("two branches").command, "CA")
}

/// An upright tool while C stands at 37 deg.
fn upright() -> Vec<f64> {
    let machine = machine("i5-engraver");
    let from = command(&machine, "C=37");
    let solved = machine.solve(&target([10.0, 20.0, 30.0], [0.0, 0.0, 1.0]), &from);
    shown(&machine, &solved.expect("reachable").solutions[0].command, "CA")
}

/// X of C and Y of C (µm) from rows of step 1: C (deg), what the tool is off the mandrel in X and Y.
fn step_1(rows: &[(f64, f64, f64)]) -> Vec<f64> {
    let mut study = engraver();
    study.sets.truncate(1);
    let blank = study.sets[0].rows[0].clone();
    let c = study.machine.axes().iter().position(|a| a.name.letter() == 'C').expect("a C axis");
    let row = |(at, x, y): &(f64, f64, f64)| {
        let mut row = blank.clone();
        row.command[c] = at.to_radians();
        row.read_mm = [Some(x * 1e-3), Some(y * 1e-3), None];
        row
    };
    study.sets[0].rows = rows.iter().map(row).collect();
    let found = calibrate(&study).expect("readings");
    // A stands at 0: of Y of A and Y of C from A the sum is seen, as the place of C.
    let value = |name: &str| {
        let k = found.offsets.iter().position(|o| o.name == name).expect("an offset");
        found.values_mm[k] * 1e3
    };
    vec![value("EX0C"), value("EY0A") + value("EY0C")]
}

/// The mandrel stands under the spindle at C = 0; half a turn later the tool is (−20, 10) µm off it.
fn half_turn() -> Vec<f64> {
    step_1(&[(0.0, 0.0, 0.0), (180.0, -20.0, 10.0)])
}

/// A mandrel anywhere: it goes round with 33 µm, and the mean says where the axis is.
fn mean_of_a_turn() -> Vec<f64> {
    let rows: Vec<(f64, f64, f64)> = (0..8)
        .map(|k| {
            let at = 45.0 * f64::from(k);
            let (s, c) = at.to_radians().sin_cos();
            (at, -10.0 - 33.0 * c, 5.0 + 33.0 * s)
        })
        .collect();
    step_1(&rows)
}

/// What RTCP_OFFSET1 Y and RTCP_OFFSET2 Y gain (µm) where A stands 30 µm farther and C does not.
fn step_4() -> Vec<f64> {
    let study = engraver();
    let slots = study.slots.expect("i5");
    let place = |name: &str| study.centres.terms.iter().position(|t| t.error.to_string() == name);
    let (a, c_on_a) = (place("EY0A").expect("A"), place("EY0C").expect("C"));
    let grown = |name: &str| {
        let slot = slots.slots.iter().find(|s| s.name == name).expect("a name of the control");
        30.0 * slot.slopes[a] - 30.0 * slot.slopes[c_on_a]
    };
    vec![grown("RTCP_OFFSET1_Y"), grown("RTCP_OFFSET2_Y")]
}

fn engraver() -> RtcpStudy {
    let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let path = root.join("examples/05_identify/rtcp-engraver.toml");
    let (study, problems) = read_rtcp(&disk(), &path, Purpose::Result);
    study.unwrap_or_else(|| panic!("{problems:?}"))
}

/// Least and greatest radius of 60 hits with three lobes between these two, and their range.
fn probe_radii([low, high]: [f64; 2]) -> Vec<f64> {
    let mut hits = "angle_deg,radius_mm\n".to_owned();
    for angle in (0..60).map(|i| 6.0 * f64::from(i)) {
        let wave = (3.0 * angle.to_radians()).cos();
        hits += &format!("{angle},{:.12}\n", 0.5 * (low + high) + 0.5 * (high - low) * wave);
    }
    let text = "name = 'p'\n[ring]\ndiameter = '62 mm'\ncentre = '0 0 mm'\n[stylus.a]\n\
                ball_diameter = '4 mm'\nhits = ['h.csv']\n";
    let load = |_: &str, _: &mut Diagnostics| Some(hits.clone());
    let tables = Tables { load: &load, show: &str::to_owned };
    let study = parse_study("p.toml", text, &tables, probe::Purpose::Result).0.expect("a study");
    let found = identify_probe(&study, &mut Diagnostics::new()).expect("a calibration");
    let radius = |d: &f64| found[0].gauge.radius_mm + d;
    let radii = || found[0].before_mm.iter().map(radius);
    let least = radii().fold(f64::INFINITY, f64::min);
    vec![least, radii().fold(0.0, f64::max), found[0].before.range_mm]
}

fn four_hits() -> Vec<f64> {
    let hits_mm = [128.97, 70.97, 79.02, 21.02];
    xy_datum(&FourHits { hits_mm, centre_mm: [100.0, 50.0], ring_radius_mm: 31.0 }).offset_mm.into()
}
