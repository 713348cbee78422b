//! Cutting the actual blank: the path of a nominal blank, moved onto the blank that was probed.
//!
//! ```text
//!     measured points ──Field::fit──> how the blank lies (registration) + its form + uncertainty
//!     ClFile ──foot on the nominal surface──> contacts ──field──> moved along the normals
//!            ──check──> thin walls, gouges, folds                        each with its line
//!            ──virtual_cut──> wall-thickness map, before and after       independent of the above
//!     adapted ClFile ──trueaxis_post──> program with its proof
//! ```
//!
//! The contact is computed from the place of the tool, its axis and the cutter, with the normal of the
//! nominal surface next to it; that surface is made of the nominal points and normals of the table.

mod check;
mod cut;
mod cutter;
mod field;
mod near;
mod offset;
mod registration;
mod study;
mod surface;
mod table;

pub use check::{Finding, Remaining, remaining_wall};
pub use cut::{Cell, virtual_cut};
pub use cutter::Cutter;
pub use field::{Covariance, Estimate, Field, FieldError, FieldOptions, MOST_POINTS, Outlier};
pub use offset::{Contact, MovedPlace};
pub use registration::{Freedoms, Registration};
pub use study::{AdaptStudy, Bounds, Follow, FromHits, Inner, PathAt, Wall, read_adapt_study};
pub use surface::{Foot, NominalSurface};
pub use table::{SurfacePoint, read_points};

use trueaxis_cl::{ClFile, ClPoint};
use trueaxis_geometry::Vec3;
use trueaxis_input::{Diagnostics, Place};

/// A place of the wall-thickness map.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MapCell {
    /// Cut along the programmed path.
    pub before: Cell,
    /// Cut along the adapted path.
    pub after: Cell,
    /// The field there.
    pub field: Estimate,
}

/// A path that was moved, and what comes of it.
#[derive(Debug, Clone)]
pub struct Adaptation {
    /// The deviation of the blank.
    pub field: Field,
    /// Every place of the path.
    pub places: Vec<MovedPlace>,
    /// The adapted path.
    pub path: ClFile,
    /// Why it may not be cut; empty: it may.
    pub findings: Vec<Finding>,
    /// The map, on the blank of the virtual cut or else on the measured points.
    pub map: Vec<MapCell>,
}

impl Adaptation {
    /// The wall that is wanted at a place of the map, mm.
    pub fn wanted_mm(study: &AdaptStudy, cell: &Cell) -> f64 {
        remaining_wall(study, cell.blank_mm, 0.0).wall_mm
    }
}

/// Moves the path of a study onto its blank.
///
/// No adaptation comes back where the blank was measured in another set-up, where the path goes
/// beyond what was probed, or where the table contradicts itself.
pub fn adapt(study: &AdaptStudy) -> (Option<Adaptation>, Diagnostics) {
    let mut problems = Diagnostics::new();
    let options =
        FieldOptions { noise_mm: study.noise_mm, length_mm: study.length_mm, form_mm: None };
    let field = match Field::fit(&study.points, &options) {
        Ok(field) => field,
        Err(error) => {
            let place = Place::whole(&study.table);
            problems.error("no-field", place, error.to_string(), field_hint(&error));
            return (None, problems);
        }
    };
    check_set_up(study, &field, &mut problems);
    if problems.has_errors() {
        return (None, problems);
    }
    name_outliers(study, &field, &mut problems);
    let places = offset::move_path(study, &field, &mut problems);
    if problems.has_errors() {
        return (None, problems);
    }
    check_layer(study, &places, &mut problems);
    if problems.has_errors() {
        return (None, problems);
    }
    let adapted: Vec<ClPoint> = places.iter().map(|p| p.adapted).collect();
    let path = study.path.with_points(&adapted);
    let mut findings = check::check(study, &places);
    let map = map(study, &field, &path);
    findings.extend(thin_cells(study, &map));
    (Some(Adaptation { field, places, path, findings, map }), problems)
}

fn field_hint(error: &FieldError) -> &'static str {
    match error {
        FieldError::TooManyPoints(_) => "leave out every second point",
        FieldError::TooManyOutliers { .. } => {
            "is the noise of the probe stated too small, or were two blanks mixed in one table?"
        }
        FieldError::Singular => "state the noise of the probe, and probe places that are apart",
    }
}

/// Is this the blank, in this set-up?
fn check_set_up(study: &AdaptStudy, field: &Field, problems: &mut Diagnostics) {
    let bounds = &study.bounds;
    let registration = &field.registration;
    let (shift, turn) = (registration.shift_mm(), registration.turn_rad());
    let place = Place::whole(&study.table);
    let hint = "probe the blank again as it is clamped now, or set it up again; larger limits: \
                [registration] most_shift, most_turn, most_form";
    let degrees = |v: f64| v.to_degrees();
    // Few points say little of how the blank lies: beyond means beyond with what is certain.
    let [u_shift, u_turn] = [registration.u_shift_mm().norm(), registration.u_turn_rad().norm()];
    if shift.norm() - 2.0 * u_shift > bounds.shift_mm
        || turn.norm() - 2.0 * u_turn > bounds.turn_rad
    {
        let message = format!(
            "the blank was measured in another set-up: it lies {:.3} ± {:.3} mm ({:.3} {:.3} {:.3}) off \
             and is turned by {:.4} ± {:.4} deg (k = 1); allowed are {} mm and {:.4} deg",
            shift.norm(),
            u_shift,
            shift.x,
            shift.y,
            shift.z,
            degrees(turn.norm()),
            degrees(u_turn),
            bounds.shift_mm,
            degrees(bounds.turn_rad)
        );
        problems.error("other-set-up", place, message, hint);
        return;
    }
    let rest = |p: &SurfacePoint| {
        let rigid: f64 =
            field.deviation_mm(&p.at_mm, &p.normal) - field.form_mm(&p.at_mm, &p.normal);
        p.deviation_mm - rigid
    };
    let named = |i: usize| field.outliers.iter().any(|o| o.index == i);
    let sound = study.points.iter().enumerate().filter(|(i, _)| !named(*i)).map(|(_, p)| p);
    let worst = sound.max_by(|a, b| rest(a).abs().total_cmp(&rest(b).abs()));
    if let Some(worst) = worst.filter(|p| rest(p).abs() > bounds.form_mm) {
        let square = study.points.iter().map(|p| rest(p).powi(2)).sum::<f64>();
        let rms = (square / study.points.len() as f64).sqrt();
        let message = format!(
            "the blank does not lie as this set-up states: {:.3} mm (rms {rms:.3} mm) remain at point \
             {} after the best fit; allowed are {} mm",
            rest(worst),
            worst.number,
            bounds.form_mm
        );
        let place = Place { line: worst.line as usize, column: 1, ..place };
        problems.error("other-set-up", place, message, hint);
    }
}

fn name_outliers(study: &AdaptStudy, field: &Field, problems: &mut Diagnostics) {
    for outlier in field.outliers.iter().take(offset::MOST_NAMED) {
        let point = &study.points[outlier.index];
        let place = Place { file: study.table.clone(), line: point.line as usize, column: 1 };
        let message = format!(
            "point {} is {:+.1} µm off what the others say ({:.0} standard deviations); it counts for \
             nearly nothing",
            point.number,
            outlier.residual_mm * 1e3,
            outlier.z.abs()
        );
        problems.warn("outlier", place, message, "clean the stylus and the place, and probe again");
    }
    if field.raised > 1.5 {
        let message = format!(
            "the readings scatter {:.1} times as much as the stated noise and a smooth form tell; all \
             uncertainties were raised by that",
            field.raised
        );
        let hint = "state the noise of the probe, or probe more closely";
        problems.warn("rough-readings", Place::whole(&study.table), message, hint);
    }
}

/// Does the path lie as deep below the nominal blank as the study says?
fn check_layer(study: &AdaptStudy, places: &[MovedPlace], problems: &mut Diagnostics) {
    let wall = &study.wall;
    let due = if wall.path_at == PathAt::Blank { 0.0 } else { -wall.layer_mm };
    let mut off: Vec<(f64, u32)> =
        places.iter().filter_map(|p| p.contact.map(|c| (c.foot.height_mm - due, p.line))).collect();
    off.sort_by(|a, b| a.0.total_cmp(&b.0));
    let Some((median, line)) = off.get(off.len() / 2).copied() else { return };
    if median.abs() > 0.25 * wall.layer_mm {
        let place = Place { file: study.path.name().to_owned(), line: line as usize, column: 1 };
        let message = format!(
            "the path touches {:.3} mm below the nominal blank (median of {} places); the study says {:.3} mm",
            -(median + due),
            off.len(),
            -due
        );
        let hint =
            "is [layer] depth, [layer] path or the cutter another one than in the CAM system?";
        problems.error("other-layer", place, message, hint);
    }
    let [(low, line), (high, _)] = [off[off.len() / 20], off[off.len() - 1 - off.len() / 20]];
    if high - low > wall.layer_mm {
        let place = Place { file: study.path.name().to_owned(), line: line as usize, column: 1 };
        let message = format!(
            "nine tenths of the path lie {low:.3} to {high:.3} mm off the depth that the study says"
        );
        let hint = "do the table and the cutter locations count from the same zero?";
        problems.error("other-zero", place, message, hint);
    }
}

fn map(study: &AdaptStudy, field: &Field, path: &ClFile) -> Vec<MapCell> {
    let foretold: Vec<SurfacePoint>;
    let blank = match &study.blank {
        Some((_, blank)) => blank,
        None => {
            let each = |p: &SurfacePoint| SurfacePoint {
                deviation_mm: field.deviation_mm(&p.at_mm, &p.normal),
                ..*p
            };
            foretold = study.points.iter().map(each).collect();
            &foretold
        }
    };
    let before = virtual_cut(&study.path, &study.cutter, &study.wall, blank);
    let after = virtual_cut(path, &study.cutter, &study.wall, blank);
    let pairs = before.into_iter().zip(after);
    let cell = |(before, after): (Cell, Cell)| MapCell {
        before,
        after,
        field: field.at(&before.at_mm, &before.normal),
    };
    pairs.map(cell).collect()
}

/// Where the virtual cut leaves less than the least wall; what is cut through is never good.
fn thin_cells(study: &AdaptStudy, map: &[MapCell]) -> Option<Finding> {
    let thin =
        map.iter().filter(|c| c.after.wall_mm < study.wall.least_mm || c.after.wall_mm <= 0.0);
    let places = thin.clone().count();
    let worst = thin.min_by(|a, b| a.after.wall_mm.total_cmp(&b.after.wall_mm))?;
    let at = worst.after.at_mm;
    let nearest = study.path.points().min_by(|a, b| {
        let d = |p: &ClPoint| (Vec3::from(p.tip_mm) - at).norm();
        d(a.1).total_cmp(&d(b.1))
    });
    let message = format!(
        "the virtual cut leaves {:.4} mm of wall at ({:.2} {:.2} {:.2}) mm, less than the least {} mm",
        worst.after.wall_mm, at.x, at.y, at.z, study.wall.least_mm
    );
    Some(Finding { code: "thin-wall", line: nearest.map_or(0, |n| n.0), places, message })
}
