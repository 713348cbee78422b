//! Our figures for the claims of Wu et al. 2022.

use crate::Ours;
use crate::shop::{PREDICTION, STUDY, command, list, machine, nominal, shown};
use trueaxis::geometry::Vec3;
use trueaxis::geometry::frame::{Point, Pose};
use trueaxis::machine::axis::Travel;
use trueaxis::part::testpiece::cone::{Cone, ConeSize};
use trueaxis::part::testpiece::{CutSurface, TestPiece};

pub const CLAIMS: &[(&str, Ours)] = &[
    ("000-table-1-travel", || travels()[..3].to_vec()),
    ("000-table-1-rotary-travel", || travels()[3..].to_vec()),
    ("000-table-4-conversion", conversions),
    ("000-table-4-conversion-rounded", conversions),
    ("000-table-4-means", means),
    ("000-table-4-mean-angularity-uncut", || vec![mean(&conversions())]),
    ("000-fig-20-ratios", ratios),
    ("000-angularity-over-50-mm", || vec![lean_over(50.0, mean(&TABLE_4_DEG))]),
    ("000-ratio-over-50-mm", ratio_over_50),
    ("000-tolerances", tolerances),
    ("000-fig-13-positions", || PREDICTION.sections.iter().map(|s| s.section.z_mm).collect()),
    ("000-generatrix", generatrix),
    ("000-eq-2-top-centre", top_centre),
    ("000-eq-8-setting-command", || commanded(&PREDICTION.setting_command, "XYZ")),
    ("000-eq-10-relative-command", relative_command),
    ("000-eq-11-tool-axis", tool_axis),
    ("000-eq-12-13-at-0", || commanded(&PREDICTION.commands[0], "CA")),
    ("000-eq-12-13-at-180", || commanded(&PREDICTION.commands[36], "CA")),
    ("000-n-at-180", || list(cone().tool_positions()[36].axis.vector())),
    ("000-nf-at-180", || list(cone().tool_positions()[36].contacts[0].normal.vector())),
    ("000-eq-18-of-a-shift", || of_a_shift(&["roundness_eq18_mm"])),
    ("000-iso-roundness-of-a-shift", || {
        of_a_shift(&[
            "roundness_lsc_mm",
            "roundness_mzc_mm",
            "roundness_mic_mm",
            "roundness_mcc_mm",
        ])
    }),
    ("000-eq-19-of-a-shift", || of_a_shift(&["angularity_eq19_mm"])),
    ("000-eq-19-of-a-lean", || of_a_lean(1e-4)),
    ("000-eq-19-of-a-lean-inward", || of_a_lean(-1e-4)),
    ("000-eq-20-of-a-shift", || {
        of_a_shift(&["coaxiality_eq20_mm", "coaxiality_diameter_mm", "coaxiality_lsc_mm"])
    }),
    ("000-p1e-drops-out", || {
        vec![largest_share(&["EX0w", "EY0w", "EZ0w", "EX0X", "EY0X", "EZ0X"])]
    }),
    ("000-p5e-stays", || vec![coaxiality_per_error("EY0A")]),
];

/// Table 4, the measured angularity.
const TABLE_4_DEG: [f64; 4] = [0.0633, 0.0648, 0.0642, 0.0566];

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

fn cone() -> Cone {
    Cone::new("frustum of Table 2", ConeSize::nas979()).expect("a cone")
}

/// The value of an index of the cone that was cut with these deviations.
fn index(cone: &Cone, deviation_mm: &[Vec3], key: &str) -> f64 {
    let mut values = vec![0.0; cone.index_names().len()];
    let cut = CutSurface::about_ideal_axis(deviation_mm);
    cone.evaluate(&cut, &mut cone.scratch(), &mut values).expect("indices");
    values[cone.index_names().iter().position(|n| n.key == key).expect("an index")]
}

/// The deviations of a cut whose error along the normal is a function of the height.
fn along_normal(cone: &Cone, error_mm: impl Fn(f64) -> f64) -> Vec<Vec3> {
    let heights = &cone.size().heights_mm;
    let positions = cone.tool_positions();
    let contacts = positions.iter().flat_map(|p| &p.contacts);
    contacts.map(|c| c.normal.vector() * error_mm(heights[c.section])).collect()
}

/// The angularity zone of generatrices that lean by an angle, over a length above the base.
fn lean_over(length_mm: f64, degrees: f64) -> f64 {
    let size = ConeSize {
        heights_mm: vec![0.0, length_mm],
        roundness_height_mm: 0.0,
        angularity_heights_mm: vec![0.0, length_mm],
        ..ConeSize::nas979()
    };
    let cone = Cone::new("two heights", size).expect("a cone");
    let slope = degrees.to_radians().tan();
    index(&cone, &along_normal(&cone, |height| height * slope), "angularity_zone_mm")
}

/// Over the 25 mm from position 1 to position 2.
fn conversions() -> Vec<f64> {
    let heights = ConeSize::nas979().heights_mm;
    TABLE_4_DEG.iter().map(|degrees| lean_over(heights[1] - heights[0], *degrees)).collect()
}

/// The means of the published measurements that stand beside the prediction in the report.
fn means() -> Vec<f64> {
    let published = STUDY.published.as_ref().expect("published figures");
    let measured = published.rows.iter().filter(|row| !row.measured_mm.is_empty());
    measured.map(|row| mean(&row.measured_mm)).collect()
}

fn predicted_by_the_paper() -> Vec<f64> {
    let published = STUDY.published.as_ref().expect("published figures");
    published.rows.iter().filter_map(|row| row.predicted_mm).collect()
}

fn ratios() -> Vec<f64> {
    predicted_by_the_paper().iter().zip(means()).map(|(p, m)| 100.0 * p / m).collect()
}

fn ratio_over_50() -> Vec<f64> {
    vec![100.0 * predicted_by_the_paper()[2] / lean_over(50.0, mean(&TABLE_4_DEG))]
}

/// Whole travels of the linear axes in mm, half travels of the rotary axes in deg.
fn travels() -> Vec<f64> {
    let machine = machine("xkas2525");
    let reach = |i: usize| match machine.axes()[i].travel {
        Travel::Between(from, to) if i < 3 => to - from,
        Travel::Between(from, to) => (0.5 * (to - from)).to_degrees(),
        _ => f64::NAN,
    };
    (0..5).map(reach).collect()
}

fn tolerances() -> Vec<f64> {
    let keys = ["roundness_mzc_mm", "coaxiality_lsc_mm", "angularity_zone_mm"];
    let limits = keys.map(|key| STUDY.test_piece.tolerances.limit_mm(key));
    limits.iter().map(|limit| limit.expect("a limit")).collect()
}

fn generatrix() -> Vec<f64> {
    let position = &cone().tool_positions()[0];
    [2, 3].map(|i: usize| position.contacts[i].along_axis_mm).to_vec()
}

fn top_centre() -> Vec<f64> {
    let mounting = STUDY.test_piece.mounting.expect("the mounting of Fig 5");
    list((mounting.fixture_from_workpiece() * Point::ORIGIN).vector())
}

fn commanded(command: &[f64; 6], letters: &str) -> Vec<f64> {
    shown(&STUDY.machine, command, letters)
}

/// The command at azimuth 0 minus that at the setting point.
fn relative_command() -> Vec<f64> {
    let (at, zero) = (&PREDICTION.commands[0], &PREDICTION.setting_command);
    (0..3).map(|i| at[i] - zero[i]).collect()
}

/// With the workpiece frame parallel to the machine's.
fn tool_axis() -> Vec<f64> {
    let machine = machine("xkas2525").with_workpiece(Pose::identity(), Pose::identity());
    list(nominal(&machine, &command(&machine, "C=30 A=40")).1)
}

/// Indices of a cut that is 10 µm off in x everywhere.
fn of_a_shift(keys: &[&str]) -> Vec<f64> {
    let cone = cone();
    let shift = vec![Vec3::new(0.010, 0.0, 0.0); cone.ideal_deviation_mm().len()];
    keys.iter().map(|key| index(&cone, &shift, key)).collect()
}

/// Eq 19 and the zone, if the tool leans by this angle along its generatrix at every azimuth.
fn of_a_lean(angle_rad: f64) -> Vec<f64> {
    let cone = cone();
    let cos = cone.size().half_angle_rad.cos();
    let cut = along_normal(&cone, |height| height / cos * angle_rad);
    ["angularity_eq19_mm", "angularity_zone_mm"].map(|key| index(&cone, &cut, key)).to_vec()
}

/// The largest effect that any of these errors alone has on any index.
fn largest_share(names: &[&str]) -> f64 {
    let errors = PREDICTION.budget.errors.iter();
    let shares: Vec<_> = errors.filter(|s| names.contains(&s.of.to_string().as_str())).collect();
    assert_eq!(shares.len(), names.len());
    shares.iter().flat_map(|s| &s.alone_mm).fold(0.0, |m, v| m.max(v.abs()))
}

/// What this error alone makes of the coaxiality, per µm of it.
fn coaxiality_per_error(name: &str) -> f64 {
    let machine = &STUDY.machine;
    let stated = machine.stated_errors().into_iter().find(|(_, n)| n.to_string() == name);
    let command = &PREDICTION.setting_command;
    let errors = machine.errors_at(command, &[0.0; 6]).expect("within the tables");
    let value_mm = errors.get(stated.expect("a stated error").0);
    let share = PREDICTION.budget.errors.iter().find(|s| s.of.to_string() == name);
    let at = PREDICTION.indices.iter().position(|i| i.name.key == "coaxiality_lsc_mm");
    share.expect("a share").alone_mm[at.expect("an index")] / value_mm.abs()
}
