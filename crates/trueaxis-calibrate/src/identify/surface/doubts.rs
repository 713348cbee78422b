//! Whether hits can be those that were planned: order, tool, number, unit, frame, side.

use super::deviations::{Due, due};
use super::study::HitsStudy;
use trueaxis_geometry::Vec3;
use trueaxis_input::{Diagnostics, Place};
use trueaxis_machine::axis::AxisKind;

/// Further off than this a hit is not the planned one, mm.
const FAR_MM: f64 = 1.0;
/// No form error is so large, mm.
const LARGEST_DEVIATION_MM: f64 = 5.0;
/// All hits displaced by more than this are in another frame, mm …
const DISPLACED_MM: f64 = 0.5;
/// … if they are so to within this part of it.
const ALIKE: f64 = 0.2;
/// No more faults than these are named one by one.
const MOST_REPORTED: usize = 20;

/// Numbers, order and tool of the hits; errors go to `problems`.
pub(super) fn check_rows(study: &HitsStudy, problems: &mut Diagnostics) {
    let (points, planned) = (study.points.len(), study.planned);
    let last = Place::whole(&study.log_file);
    if planned < points || planned > 2 * points {
        let message = format!("{planned} hits are planned, but the table has {points} points");
        let hint = "use the table that was written together with the program";
        problems.error("other-points", Place::whole(&study.points_file), message, hint);
        return;
    }
    let mut due = 1;
    let mut lost = Vec::new();
    for hit in &study.log.hits {
        let place = hit.place.clone();
        if hit.hit < due {
            let message =
                format!("hit {} comes after hit {}: the hits are out of order", hit.hit, due - 1);
            let hint = "a row that was moved or copied, or two runs in one log?";
            problems.error("hits-out-of-order", place, message, hint);
            return;
        }
        lost.extend((due..hit.hit).map(|n| (n, place.clone())).take(MOST_REPORTED + 1));
        due = hit.hit + 1;
        if hit.hit > planned {
            let message = format!("hit {} of {planned} that are planned", hit.hit);
            let hint = "is this the log of the program of this study?";
            problems.error("too-many-hits", place, message, hint);
            return;
        }
        let point = if hit.hit <= points { hit.hit } else { hit.hit - points };
        if hit.point != point {
            let message =
                format!("hit {} is at point {}, planned at point {point}", hit.hit, hit.point);
            let hint = "is this the log of another program, or were rows changed?";
            problems.error("hits-out-of-order", place, message, hint);
            return;
        }
        match hit.tool {
            None => {
                let message = format!("hit {} does not say with which tool (T)", hit.hit);
                let hint = format!("T{}, if the probe was in the spindle", study.probe.tool);
                problems.error("missing-tool", place, message, &hint);
                return;
            }
            Some(tool) if tool != study.probe.tool => {
                let message = format!(
                    "hit {} was made with tool {tool}, the probe is tool {}",
                    hit.hit, study.probe.tool
                );
                let hint =
                    "was another tool in the spindle? its hits are not those of this calibration";
                problems.error("other-tool", place, message, hint);
                return;
            }
            Some(_) => {}
        }
    }
    lost.extend((due..=planned).map(|n| (n, last.clone())).take(MOST_REPORTED + 1));
    let count = planned - study.log.hits.len().min(planned);
    if let Some((first, place)) = lost.first() {
        let ended = if study.log.end.is_none() {
            "; the log has no end (END): the program was stopped"
        } else {
            ""
        };
        let message =
            format!("{count} of {planned} hits are lost, the first is hit {first}{ended}");
        let hint = "probe again, or state may_be_lost = true: these points have no deviation then";
        match study.may_be_lost {
            true => problems.warn("lost-hits", place.clone(), message, hint),
            false => problems.error("lost-hits", place.clone(), message, hint),
        }
    } else if let Some(end) = study.log.end.filter(|end| *end != planned) {
        let message = format!("the log ends with END {end}, but {planned} hits are planned");
        problems.error("lost-hits", last, message, "is this the log of the program of this study?");
    }
}

/// Whether the hits lie where they are due; errors go to `problems`.
pub(super) fn check_places(study: &HitsStudy, problems: &mut Diagnostics) {
    let all: Vec<(usize, Due)> =
        (0..study.log.hits.len()).filter_map(|i| Some((i, due(study, i)?))).collect();
    let linear: Vec<usize> = (0..study.machine.axes().len())
        .filter(|i| study.machine.axes()[*i].kind == AxisKind::Linear)
        .collect();
    let off: Vec<Vec3> = all
        .iter()
        .map(|(i, d)| {
            let hit = &study.log.hits[*i];
            let apart = |k: usize| linear.get(k).map_or(0.0, |a| hit.command[*a] - d.command[*a]);
            Vec3::new(apart(0), apart(1), apart(2))
        })
        .collect();
    let place = || study.log.hits.first().map_or(Place::default(), |h| h.place.clone());
    let median = |mut values: Vec<f64>| {
        values.sort_by(f64::total_cmp);
        values.get(values.len() / 2).copied().unwrap_or(0.0)
    };
    let middle = Vec3::from_fn(|k, _| median(off.iter().map(|o| o[k]).collect()));
    let spread = median(off.iter().map(|o| (o - middle).norm()).collect());
    let far = median(off.iter().map(|o| o.norm()).collect());
    if far > DISPLACED_MM {
        let ratios = all.iter().map(|(i, d)| {
            let norm = |c: &[f64]| linear.iter().map(|a| c[*a] * c[*a]).sum::<f64>().sqrt();
            norm(&study.log.hits[*i].command) / norm(&d.command).max(1e-9)
        });
        let ratio = median(ratios.collect());
        if (ratio * 25.4 - 1.0).abs() < 0.03 || (ratio / 25.4 - 1.0).abs() < 0.03 {
            let message = format!(
                "the positions are {ratio:.4} times those that are due: they are not in the unit of the heading ({})",
                study.log.unit
            );
            let hint = "inches: TRUEAXIS HITS INCH MACHINE";
            problems.error("wrong-unit", place(), message, hint);
            return;
        }
        if middle.norm() > DISPLACED_MM && spread < ALIKE * middle.norm() {
            let message = format!(
                "all hits stand ({:.3}, {:.3}, {:.3}) mm from where they are due: another frame",
                middle.x, middle.y, middle.z
            );
            let hint = "positions of the workpiece (G54 not 0), a tool length in them, or a workpiece that stands \
                        elsewhere: the log must have machine positions, [workpiece] of the machine its place";
            problems.error("other-frame", place(), message, hint);
            return;
        }
    }
    for (i, d) in all.iter().filter(|(_, d)| is_far(d, study)).take(MOST_REPORTED) {
        let hit = &study.log.hits[*i];
        let (along, aside) = (d.off_mm.dot(&d.normal), aside(d));
        let other = study.points.iter().enumerate().find(|(k, p)| {
            let due = p.point_mm + p.normal * study.probe.calibration.ball_radius_mm;
            *k + 1 != hit.point && (d.ball_mm - due).norm() < FAR_MM
        });
        let (code, message, hint) = match other {
            Some((k, _)) if aside > FAR_MM => (
                "hits-out-of-order",
                format!("hit {} lies at point {}, not at point {}", hit.hit, k + 1, hit.point),
                "are rows or points swapped?",
            ),
            _ if aside <= FAR_MM && along < 0.0 => (
                "wrong-face",
                format!(
                    "hit {} lies {along:.3} mm along the normal: on the other face of the wall",
                    hit.hit
                ),
                "was it touched from within? its normal must point to the side that is touched",
            ),
            _ => (
                "far-hit",
                format!(
                    "hit {} lies {along:.3} mm along the normal and {aside:.3} mm aside of point {}",
                    hit.hit, hit.point
                ),
                "a false trigger, a clamp in the way, or another part?",
            ),
        };
        problems.error(code, hit.place.clone(), message, hint);
    }
}

fn aside(due: &Due) -> f64 {
    (due.off_mm - due.normal * due.off_mm.dot(&due.normal)).norm()
}

/// The centre of the ball does not go below the surface: a program that touches nothing stops before.
fn is_far(due: &Due, study: &HitsStudy) -> bool {
    let along = due.off_mm.dot(&due.normal);
    let deepest = -study.probe.calibration.ball_radius_mm;
    aside(due) > FAR_MM || along < deepest || along > LARGEST_DEVIATION_MM
}
