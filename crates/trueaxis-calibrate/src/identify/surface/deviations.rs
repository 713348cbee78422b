//! From the place of the ball at the trigger to the deviation of the surface, with its uncertainty.

use super::doubts::{check_places, check_rows};
use super::study::HitsStudy;
use trueaxis_geometry::Vec3;
use trueaxis_geometry::surface::SurfacePoint;
use trueaxis_input::{Diagnostics, Place};
use trueaxis_machine::axis::{Approach, Command};
use trueaxis_machine::errors::ErrorValues;
use trueaxis_machine::tcp::TipControl;

/// No more hits than these are named one by one.
const MOST_REPORTED: usize = 10;

/// The standard uncertainties of one deviation, mm.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct UncertaintyParts {
    /// One trigger.
    pub repeatability_mm: f64,
    /// Ball radius, offset and pre-travel.
    pub calibration_mm: f64,
    /// Length of the probe.
    pub length_mm: f64,
    /// Errors of the machine, as far as the machine file knows them.
    pub machine_mm: f64,
    /// What the correction of the drift leaves.
    pub drift_mm: f64,
}

impl UncertaintyParts {
    /// All of them together, mm.
    pub fn u_mm(&self) -> f64 {
        let parts = [
            self.repeatability_mm,
            self.calibration_mm,
            self.length_mm,
            self.machine_mm,
            self.drift_mm,
        ];
        parts.iter().map(|u| u * u).sum::<f64>().sqrt()
    }

    /// U with k = 2, mm.
    pub fn expanded_mm(&self) -> f64 {
        2.0 * self.u_mm()
    }
}

/// A point of the surface as it was found.
#[derive(Debug, Clone, PartialEq)]
pub struct PointDeviation {
    /// Its number in the table, from 1.
    pub number: usize,
    /// The nominal point.
    pub point: SurfacePoint,
    /// Along the normal, positive where there is more material, mm.
    pub deviation_mm: f64,
    /// The same with the nominal machine and the ball radius alone, mm.
    pub as_read_mm: f64,
    /// What the errors of the machine did, mm.
    pub by_machine_mm: f64,
    /// What offset and pre-travel of the probe did, mm.
    pub by_probe_mm: f64,
    /// What the drift did, mm.
    pub by_drift_mm: f64,
    /// Its uncertainty.
    pub u: UncertaintyParts,
    /// The line of its hit.
    pub place: Place,
}

/// What the touch at the end shows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Drift {
    /// The point that was touched again.
    pub number: usize,
    /// The second deviation less the first, mm.
    pub change_mm: f64,
}

/// All points of a surface.
#[derive(Debug, Clone)]
pub struct SurfaceDeviations {
    /// Point by point, in the order of the table.
    pub points: Vec<PointDeviation>,
    /// Points without a hit.
    pub lost: Vec<usize>,
    /// What was seen of the drift.
    pub drift: Option<Drift>,
}

/// Where the ball is due, and where it was.
pub(super) struct Due {
    /// Of the axes, if the surface were nominal.
    pub command: Command,
    /// The ball as it was, workpiece frame, nominal machine.
    pub ball_mm: Vec3,
    /// The same less where it is due.
    pub off_mm: Vec3,
    /// Of the point.
    pub normal: Vec3,
}

/// Of a hit, with the rotary axes that it had.
pub(super) fn due(study: &HitsStudy, hit: usize) -> Option<Due> {
    let hit = study.log.hits.get(hit)?;
    let point = study.points.get(hit.point.checked_sub(1)?)?;
    let (command, _) = expected(study, hit.command, point)?;
    let tool = study.machine.pose(&hit.command, &ErrorValues::default());
    let ball_mm = tool.linear() * study.machine.tip_mm() + tool.shift_mm();
    let due = point.point_mm + point.normal * study.probe.calibration.ball_radius_mm;
    Some(Due { command, ball_mm, off_mm: ball_mm - due, normal: point.normal })
}

/// The axes where the nominal surface is touched, and from which side each axis comes.
fn expected(
    study: &HitsStudy,
    rotary: Command,
    point: &SurfacePoint,
) -> Option<(Command, Approach)> {
    let control = TipControl::of(&study.machine)?;
    let radius = study.probe.calibration.ball_radius_mm;
    let at = |gap: f64| {
        let mut command = rotary;
        let tip = point.point_mm + point.normal * (radius + gap);
        control.place(tip, &mut command).then_some(command)
    };
    let (command, before) = (at(0.0)?, at(1.0)?);
    let mut approach = Approach::default();
    for (side, (q, from)) in approach.iter_mut().zip(command.iter().zip(before)) {
        // The rounding of the placing is no motion.
        *side = if (q - from).abs() < 1e-9 { 0.0 } else { (q - from).signum() };
    }
    Some((command, approach))
}

/// What one hit says, before the drift.
struct Found {
    point: usize,
    deviation_mm: f64,
    as_read_mm: f64,
    by_machine_mm: f64,
    by_probe_mm: f64,
    /// The normal as the tool sees it.
    towards: Vec3,
    u: UncertaintyParts,
    place: Place,
    hit: usize,
}

/// Deviations of every point; `None` with errors among the problems.
pub fn deviations(study: &HitsStudy, problems: &mut Diagnostics) -> Option<SurfaceDeviations> {
    check_rows(study, problems);
    if !problems.has_errors() {
        check_places(study, problems);
    }
    if problems.has_errors() {
        return None;
    }
    let found: Vec<Found> =
        (0..study.log.hits.len()).filter_map(|i| one(study, i, problems)).collect();
    if problems.has_errors() {
        return None;
    }
    if study.machine.stated_errors().is_empty() {
        let message =
            "the machine file states no errors: the ball is taken to be where the axes say"
                .to_owned();
        let hint =
            "identify them first, or the errors of the machine count as those of the surface";
        problems.warn("no-errors", Place::whole(&study.file), message, hint);
    } else if found.iter().all(|f| f.u.machine_mm == 0.0) {
        let message =
            "the machine file states no uncertainty of its errors: U has no part of theirs"
                .to_owned();
        let hint = "such as EC0Y = \"18 ± 2 urad\"";
        problems.warn("no-uncertainty", Place::whole(&study.file), message, hint);
    }
    if study.probe.u_length_mm.is_none() {
        let message = "the length of the probe has no uncertainty: U has no part of it".to_owned();
        problems.warn(
            "no-uncertainty",
            Place::whole(&study.file),
            message,
            "length = \"90 ± 0.001 mm\"",
        );
    }
    Some(without_drift(study, found, problems))
}

/// One hit.
///
/// ```text
///     d = (b − p)·n − r + t(−Rᵀn)        b = T(q, E)·(tip + o)                       docs/model.md eq. 141
/// ```
fn one(study: &HitsStudy, index: usize, problems: &mut Diagnostics) -> Option<Found> {
    let hit = &study.log.hits[index];
    let point = study.points.get(hit.point - 1)?;
    let machine = &study.machine;
    let calibration = &study.probe.calibration;
    let nominal = ErrorValues::default();
    let Some((_, approach)) = expected(study, hit.command, point) else {
        let message = "the linear axes do not reach the point".to_owned();
        problems.error(
            "cannot-follow",
            hit.place.clone(),
            message,
            "is this the machine of the log?",
        );
        return None;
    };
    let errors = match machine.errors_at(&hit.command, &approach) {
        Ok(errors) => errors,
        Err(fault) => {
            problems.error("outside-table", hit.place.clone(), fault.to_string(), "");
            return None;
        }
    };
    let tip = machine.tip_mm();
    let along = |errors: &ErrorValues, tip: Vec3| {
        let tool = machine.pose(&hit.command, errors);
        (tool.linear() * tip + tool.shift_mm() - point.point_mm).dot(&point.normal)
    };
    let tool = machine.pose(&hit.command, &errors);
    let towards = tool.linear().transpose() * point.normal;
    if !calibration.reaches(-towards) {
        let reported = problems.iter().filter(|d| d.code == "direction-beyond-calibration").count();
        if reported < MOST_REPORTED {
            let [low, high] = calibration.latitude.map(|s| s.clamp(-1.0, 1.0).asin().to_degrees());
            let message = format!(
                "the direction of motion rises by {:.1} deg against the probe; the calibration knows {low:.1} to \
                 {high:.1} deg",
                (-towards.z).clamp(-1.0, 1.0).asin().to_degrees()
            );
            let hint = "calibrate on a sphere in such directions; nothing is extrapolated";
            problems.error("direction-beyond-calibration", hit.place.clone(), message, hint);
        }
        return None;
    }
    let radius = calibration.ball_radius_mm;
    let as_read_mm = along(&nominal, tip) - radius;
    let actual = along(&errors, tip) - radius;
    let with_offset = along(&errors, tip + calibration.fit.offset_mm) - radius;
    let deviation_mm = with_offset + calibration.fit.travel_mm(-towards);
    let quantities = machine.uncertain_quantities();
    let known = machine.uncertainties_at(&hit.command, &quantities);
    let by = |q: usize| along(&known.displaced_by(&errors, q, 1.0), tip) - actual - radius;
    let machine_mm = (0..quantities.len()).map(|q| by(q).powi(2)).sum::<f64>().sqrt();
    Some(Found {
        point: hit.point,
        deviation_mm,
        as_read_mm,
        by_machine_mm: as_read_mm - actual,
        by_probe_mm: actual - deviation_mm,
        towards,
        u: UncertaintyParts {
            repeatability_mm: study.probe.repeatability_mm,
            calibration_mm: calibration.deviation(-towards, 0.0).u_mm,
            length_mm: study.probe.u_length_mm.unwrap_or(0.0) * towards.z.abs(),
            machine_mm,
            drift_mm: 0.0,
        },
        place: hit.place.clone(),
        hit: hit.hit,
    })
}

/// A drift v of the tool grows evenly over the hits; of it the last touch shows the part along its normal w₁.
///
/// ```text
///     D = d_N − d_1        d_i ← d_i − D (w_i·w₁) f_i        f_i = (i − 1)/(N − 1)
///     u² = 2 s² (w_i·w₁)² f² + D² (1 − (w_i·w₁)²) f² + D² f (1 − f)/3
/// ```
fn without_drift(
    study: &HitsStudy,
    found: Vec<Found>,
    problems: &mut Diagnostics,
) -> SurfaceDeviations {
    let points = study.points.len();
    let again = found.iter().rev().find(|f| f.hit > points);
    let first = again.and_then(|a| found.iter().find(|f| f.hit <= points && f.point == a.point));
    let seen = again.zip(first).map(|(a, b)| {
        let span = (a.hit - b.hit).max(1) as f64;
        (a.deviation_mm - b.deviation_mm, b.towards, b.hit, span, a.point)
    });
    let within = study.drift_within_mm;
    if seen.is_none() && within.is_none() {
        let message = "no point was touched again and no `drift_within` is stated: U has no part of the drift".to_owned();
        let hint = "drift_within = \"2 um\", or plan with again = true";
        problems.warn("no-uncertainty", Place::whole(&study.file), message, hint);
    }
    let s = study.probe.repeatability_mm;
    let mut all = Vec::new();
    for f in found.iter().filter(|f| f.hit <= points) {
        let (mut by_drift_mm, mut drift_mm) = (0.0, within.unwrap_or(0.0) / 3.0_f64.sqrt());
        if let Some((change, towards, from, span, _)) = seen {
            let part = (f.hit.saturating_sub(from)) as f64 / span;
            let alike = f.towards.dot(&towards);
            by_drift_mm = change * alike * part;
            let noise = 2.0 * (s * alike * part).powi(2);
            let other = (change * part).powi(2) * (1.0 - alike * alike).max(0.0);
            let uneven = change * change * (part * (1.0 - part)).max(0.0) / 3.0;
            drift_mm = (noise + other + uneven).sqrt().hypot(drift_mm);
        }
        all.push(PointDeviation {
            number: f.point,
            point: study.points[f.point - 1],
            deviation_mm: f.deviation_mm - by_drift_mm,
            as_read_mm: f.as_read_mm,
            by_machine_mm: f.by_machine_mm,
            by_probe_mm: f.by_probe_mm,
            by_drift_mm,
            u: UncertaintyParts { drift_mm, ..f.u },
            place: f.place.clone(),
        });
    }
    all.sort_by_key(|p| p.number);
    let lost = (1..=points).filter(|n| !all.iter().any(|p| p.number == *n)).collect();
    let drift = seen.map(|(change_mm, _, _, _, number)| Drift { number, change_mm });
    SurfaceDeviations { points: all, lost, drift }
}
