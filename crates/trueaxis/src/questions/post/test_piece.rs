//! The path of a test piece as cutter locations: one turn for each cutting condition.

use std::f64::consts::PI;
use std::fmt::Write;
use std::path::Path;
use trueaxis_geometry::Vec3;
use trueaxis_input::{Diagnostics, Files};
use trueaxis_part::testpiece::cone::{Cone, ConeSize};
use trueaxis_part::testpiece::{TestPiece, ToolPosition};
use trueaxis_part::{CuttingCondition, Shape, TestPieceFile};

/// Distance of the tool from the flank before and after a turn, mm.
const CLEARANCE_MM: f64 = 15.0;

/// How far above the part the tool comes and goes, mm.
const ABOVE_MM: f64 = 50.0;

/// Positions of the way back round above the part: its chords stay well outside it.
const BACK: usize = 24;

/// The cutter locations of a file, if it describes a test piece that can be cut.
pub fn read(
    path: &Path,
    files: &Files,
    tolerance_mm: f64,
    problems: &mut Diagnostics,
) -> Option<String> {
    Some(cutter_locations(&TestPieceFile::of_file(files, path, problems)?, tolerance_mm))
}

/// One turn about the piece for each condition, as an APT file in the workpiece frame.
pub fn cutter_locations(piece: &TestPieceFile, tolerance_mm: f64) -> String {
    let Shape::Cone(cone) = &piece.shape;
    let dense = dense(cone, tolerance_mm);
    let cone = dense.as_ref().unwrap_or(cone);
    let usual = [CuttingCondition::default()];
    let conditions = if piece.conditions.is_empty() { &usual[..] } else { &piece.conditions };
    let mut text = format!("PARTNO/{}\nUNITS/MM\nMULTAX/ON\n", plain(&piece.name));
    let _ = writeln!(text, "CUTTER/{}\nLOADTL/1", cone.size().tool_diameter_mm);
    for condition in conditions {
        turn(&mut text, cone, condition);
    }
    text + "SPINDL/OFF\nFINI\n"
}

/// The same cone with so many positions that neither chord nor tool axis leaves its cone by more than the tolerance.
fn dense(cone: &Cone, tolerance_mm: f64) -> Option<Cone> {
    let size = cone.size();
    let reach_mm = 0.5 * (size.base_diameter_mm + size.tool_diameter_mm);
    // Sagitta of a chord over the angle δ: r (1 − cos δ/2); the great circle between two axes leaves the cone by
    // less than the same share of its radius sin α over the length of the flank.
    let flank_mm = size.height_mm * size.half_angle_rad.tan();
    let share = (0.5 * tolerance_mm / (reach_mm + flank_mm)).min(0.5);
    let step_rad = 2.0 * (1.0 - share).acos();
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "bounded above")]
    let needed = (2.0 * PI / step_rad).ceil().min(1e6) as usize;
    let positions = needed.max(size.positions);
    Cone::new(cone.name(), ConeSize { positions, ..size.clone() }).ok()
}

fn turn(text: &mut String, cone: &Cone, condition: &CuttingCondition) {
    let size = cone.size();
    let cos = size.half_angle_rad.cos();
    let place = |position: &ToolPosition| {
        let axis = position.axis.vector();
        let normal = position.contacts.first()?.normal.vector();
        let up = axis * (condition.height_mm / cos) + normal * condition.allowance_mm;
        Some((position.tip.vector() + up, axis, normal))
    };
    let places: Vec<_> = cone.tool_positions().iter().filter_map(place).collect();
    let Some((tip, axis, normal)) = places.first().copied() else { return };
    let away = tip + normal * CLEARANCE_MM;
    let rise_mm = (size.height_mm - condition.height_mm) / cos + ABOVE_MM;
    let above = away + axis * rise_mm;
    if !condition.name.is_empty() {
        let _ = writeln!(text, "PPRINT/{}", plain(&condition.name));
    }
    if let Some(per_minute) = condition.spindle_per_min {
        let _ = writeln!(text, "SPINDL/{per_minute},RPM,CLW");
    }
    for place in [above, away] {
        text.push_str("RAPID\n");
        go(text, place, axis);
    }
    if let Some(feed) = condition.feed_mm_per_min {
        let _ = writeln!(text, "FEDRAT/{feed},MMPM");
    }
    places.iter().chain(places.first()).for_each(|(tip, axis, _)| go(text, *tip, *axis));
    go(text, away, axis);
    text.push_str("RAPID\n");
    go(text, above, axis);
    // Back round above the part: the next turn finds the rotary axes where this one found them, and none has to
    // be rewound on the flank.
    for (tip, axis, normal) in places.iter().step_by(places.len().div_ceil(BACK)).rev() {
        text.push_str("RAPID\n");
        go(text, tip + normal * CLEARANCE_MM + axis * rise_mm, *axis);
    }
}

fn go(text: &mut String, place: Vec3, axis: Vec3) {
    let numbers = [place.x, place.y, place.z, axis.x, axis.y, axis.z];
    let numbers = numbers.map(|number| format!("{:.9}", number + 0.0)).join(",");
    let _ = writeln!(text, "GOTO/{numbers}");
}

/// Text that no reader of APT takes for more than a comment.
fn plain(text: &str) -> String {
    let kept = |c: char| if c.is_ascii_alphanumeric() || " .,-".contains(c) { c } else { ' ' };
    text.chars().map(kept).take(60).collect()
}
