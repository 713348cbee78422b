//! Whether hits can be what they are said to be: unit, side, direction, gaps.

use super::file::{Study, Stylus};
use super::fit::rough_centre;
use super::hit::{Gauge, GaugeKind, Hit, Side};
use std::f64::consts::TAU;
use trueaxis_geometry::Vec3;
use trueaxis_input::{Diagnostics, Place};

/// More hits on one gauge are a slip.
pub const MOST_HITS: usize = 10_000;
/// A hit farther off than this is no pre-travel, mm.
const FAR_MM: f64 = 1.0;
/// Position and direction of motion may differ by this, rad.
const ASIDE_RAD: f64 = 0.09;
/// No more hits than these are reported one by one.
const MOST_REPORTED: usize = 20;
/// Directions nearer than this are one, rad.
const SAME_RAD: f64 = 0.005;

/// Looks at the hits of a stylus; the widest arc without one, rad, or `None` with errors among the
/// problems.
pub fn check_hits(study: &Study, stylus: &Stylus, problems: &mut Diagnostics) -> Option<f64> {
    let (hits, gauge) = (&stylus.hits, &study.gauge);
    let fewest = gauge.dimensions() + 2;
    let place = || hits.first().map_or(Place::whole(&study.file), |h| h.place.clone());
    if hits.len() < fewest {
        let message = format!("stylus `{}` has {} hits", stylus.name, hits.len());
        let hint = format!("{fewest} at least determine offset and mean, 12 three lobes");
        problems.error("too-few-hits", place(), message, &hint);
        return None;
    }
    let positions: Vec<Vec3> = hits.iter().map(|h| h.spindle_mm).collect();
    let Some(centre) = gauge.centre_mm.or_else(|| rough_centre(&positions, gauge.dimensions()))
    else {
        let message = format!("the hits of stylus `{}` lie on no circle or sphere", stylus.name);
        problems.error("no-circle", place(), message, "are the right columns named?");
        return None;
    };
    let before = problems.iter().count();
    let has_new = |problems: &Diagnostics| {
        let errors =
            |d: &&trueaxis_input::Diagnostic| d.severity == trueaxis_input::Severity::Error;
        problems.iter().skip(before).any(|d| errors(&d))
    };
    let sight = Sight { gauge, ball_radius_mm: stylus.ball_radius_mm, centre };
    sight.check_size(hits, problems);
    if has_new(problems) {
        return None;
    }
    sight.check_directions(hits, problems);
    for hit in &stylus.check {
        sight.check_one(hit, problems);
    }
    tell_copies(hits, problems);
    if has_new(problems) {
        return None;
    }
    let gap = check_gaps(hits, gauge, problems);
    (!has_new(problems)).then_some(gap)
}

/// A gauge with the place where it stands, or seems to.
struct Sight<'a> {
    gauge: &'a Gauge,
    ball_radius_mm: f64,
    centre: Vec3,
}

impl Sight<'_> {
    fn distance(&self, hit: &Hit) -> f64 {
        (hit.spindle_mm - self.centre).norm()
    }

    /// Whether the hits together are as far from the centre as they must be; if not, why.
    fn check_size(&self, hits: &[Hit], problems: &mut Diagnostics) {
        let median = median_of(hits, |h| self.distance(h));
        let touched =
            |h: &Hit| (h.spindle_mm + h.direction * self.ball_radius_mm - self.centre).norm();
        let touched = median_of(hits, touched);
        let (radius, ball) = (self.gauge.radius_mm, self.ball_radius_mm);
        let due = self.gauge.contact_mm(ball);
        let allowed = (ball / 3.0).clamp(0.05, 0.5);
        let near = |v: f64| (median - v).abs() <= allowed;
        if near(due) {
            hits.iter().for_each(|h| self.check_one(h, problems));
            return;
        }
        let other = match self.gauge.side {
            Side::Inside => radius + ball,
            Side::Outside => radius - ball,
        };
        let ratios = [median / due, touched / radius];
        let like = |v: f64| ratios.iter().any(|ratio| (ratio / v - 1.0).abs() < 0.02);
        // Far from the zero of the machine the unit changes the place more than the size.
        let place = median_of(hits, |h| h.spindle_mm.norm()) / self.centre.norm().max(1e-9);
        let stated = self.gauge.centre_mm.is_some_and(|c| c.norm() > 2.0 * due);
        let placed = |v: f64| stated && (place / v - 1.0).abs() < 0.1;
        let (code, hint) = if near(other) {
            (
                "wrong-side",
                "they lie on the other side of the surface: state side = \"inside\" or \"outside\"",
            )
        } else if near(radius) {
            (
                "wrong-reading",
                "they are touched points, not spindle positions: state reading = \"point\"",
            )
        } else if near(due - self.gauge.side.sign() * ball) {
            ("wrong-reading", "the ball radius was subtracted twice: state reading = \"spindle\"")
        } else if like(1.0 / 25.4) || placed(1.0 / 25.4) {
            ("wrong-unit", "are they inches? then the heading says x_in")
        } else if like(25.4) || like(1e3) || like(1e-3) || placed(25.4) {
            ("wrong-unit", "is the unit in the heading right?")
        } else if like(2.0) || like(0.5) {
            ("wrong-size", "are radius and diameter mixed up?")
        } else {
            ("wrong-size", "check diameter of the gauge, its centre, ball_diameter and reading")
        };
        let place = hits.first().map_or(Place::default(), |h| h.place.clone());
        let message = format!(
            "the hits lie {median:.4} mm from the centre (median); {due:.4} mm are due between the \
             centres of ball and gauge"
        );
        problems.error(code, place, message, hint);
    }

    fn check_one(&self, hit: &Hit, problems: &mut Diagnostics) {
        let due = self.gauge.contact_mm(self.ball_radius_mm);
        let off = self.distance(hit) - due;
        if off.abs() <= FAR_MM {
            return;
        }
        let across = 2.0 * self.ball_radius_mm * self.gauge.side.sign();
        let (code, hint) = match (off - across).abs() < FAR_MM.min(self.ball_radius_mm) {
            true => ("wrong-side", "it lies on the other side of the surface"),
            false => (
                "far-hit",
                "no pre-travel is so long: a false trigger, a slip of the pen, a wrong unit?",
            ),
        };
        let message = format!("this hit stands {off:+.4} mm off the gauge");
        problems.error(code, hit.place.clone(), message, hint);
    }

    /// Whether each hit lies where its direction of motion leads.
    fn check_directions(&self, hits: &[Hit], problems: &mut Diagnostics) {
        let sign = self.gauge.side.sign();
        let outward =
            |h: &Hit| (h.spindle_mm - self.centre).try_normalize(1e-9).unwrap_or_default();
        let off = |u: Vec3, v: Vec3| u.cross(&v).norm().atan2(u.dot(&v));
        let aside = |h: &Hit| off(outward(h) * sign, h.direction);
        let most = |holds: &dyn Fn(&Hit) -> bool| {
            2 * hits.iter().filter(|h| holds(h)).count() > hits.len()
        };
        if most(&|h| aside(h) > ASIDE_RAD) {
            let swapped = |v: Vec3| Vec3::new(v.y, v.x, v.z);
            let turn =
                |h: &Hit| super::turned(outward(h) * sign, -h.direction.y.atan2(h.direction.x));
            let first = turn(&hits[0]);
            let (code, hint) = if most(&|h| aside(h) > std::f64::consts::PI - ASIDE_RAD) {
                (
                    "wrong-side",
                    "they move away from the surface: is `side` right, or is the angle that \
                  of the normal?",
                )
            } else if most(&|h| off(swapped(outward(h)) * sign, h.direction) <= ASIDE_RAD) {
                ("swapped-columns", "x and y are swapped")
            } else if most(&|h| off(turn(h), first) <= ASIDE_RAD) {
                (
                    "direction-mismatch",
                    "all by the same angle: from which axis do the angles count?",
                )
            } else {
                (
                    "direction-mismatch",
                    "are the angles in the unit of their heading, and the centre right?",
                )
            };
            let message = format!(
                "direction of motion and position differ, here by {:.1} deg, at most hits",
                aside(&hits[0]).to_degrees()
            );
            problems.error(code, hits[0].place.clone(), message, hint);
            return;
        }
        for hit in hits.iter().filter(|h| aside(h) > ASIDE_RAD).take(MOST_REPORTED) {
            let angle = aside(hit).to_degrees();
            let message = format!("direction of motion and position differ by {angle:.1} deg");
            let hint = "a hit lies where its motion leads; is a sign or an angle wrong?";
            problems.error("direction-mismatch", hit.place.clone(), message, hint);
        }
    }
}

fn median_of(hits: &[Hit], of: impl Fn(&Hit) -> f64) -> f64 {
    let mut values: Vec<f64> = hits.iter().map(of).collect();
    let middle = values.len() / 2;
    *values.select_nth_unstable_by(middle, f64::total_cmp).1
}

/// A row that stands twice makes the uncertainty smaller than it is.
fn tell_copies(hits: &[Hit], problems: &mut Diagnostics) {
    let key = |h: &Hit| {
        let all = [h.spindle_mm.x, h.spindle_mm.y, h.spindle_mm.z, h.direction.x, h.direction.y];
        (all.map(f64::to_bits), h.direction.z.to_bits(), h.orientation_rad.to_bits())
    };
    let mut first = std::collections::BTreeMap::new();
    let mut reported = 0;
    for hit in hits {
        let line = first.entry(key(hit)).or_insert(hit.place.line).to_owned();
        if line != hit.place.line && reported < MOST_REPORTED {
            reported += 1;
            let message = format!("this row is the same as line {line} to the last digit");
            let hint = "if it is a copy, take it out: it makes the uncertainty too small";
            problems.warn("duplicate-row", hit.place.clone(), message, hint);
        }
    }
}

/// The widest arc without a hit, rad; too wide an arc is an error.
fn check_gaps(hits: &[Hit], gauge: &Gauge, problems: &mut Diagnostics) -> f64 {
    // Near the pole of a sphere an azimuth means little.
    let level = |h: &&Hit| h.direction.x.hypot(h.direction.y) > 0.3;
    let azimuth = |u: Vec3| u.y.atan2(u.x).rem_euclid(TAU);
    let around = hits.iter().filter(level).map(|h| (azimuth(h.probe_direction()), h));
    let mut all: Vec<(f64, &Hit)> = around.collect();
    all.sort_by(|a, b| a.0.total_cmp(&b.0));
    let Some(first) = all.first().map(|(angle, hit)| (angle + TAU, *hit)) else { return TAU };
    all.push(first);
    let steps = || all.windows(2).map(|w| (w[1].0 - w[0].0, &w[0], &w[1]));
    let count = steps().filter(|s| s.0 > SAME_RAD).count().max(1);
    let mean = TAU / count as f64;
    let widest = steps().fold(0.0_f64, |m, s| m.max(s.0));
    let limit = (4.0 * mean).clamp(15_f64.to_radians(), 120.5_f64.to_radians());
    for (step, from, to) in steps().filter(|s| s.0 > limit.min(2.5 * mean.max(0.1))) {
        let degrees = |angle: f64| angle.rem_euclid(TAU).to_degrees();
        let message = format!(
            "no hit between {:.1} deg and {:.1} deg: a gap of {:.1} deg",
            degrees(from.0),
            degrees(to.0),
            step.to_degrees()
        );
        let place = to.1.place.clone();
        if step > limit {
            let kind = if gauge.kind == GaugeKind::Ring { "ring" } else { "sphere" };
            let radians = step > 0.9 * TAU;
            let hint = match radians {
                true => "are the angles radians? then the heading says angle_rad".to_owned(),
                false => format!(
                    "measure the rest of the {kind}; nothing is interpolated over so wide an arc"
                ),
            };
            problems.error("gap-in-directions", place, message, &hint);
        } else {
            let hint = "harmonics with half a period shorter than that are left out";
            problems.warn("gap-in-directions", place, message, hint);
        }
    }
    widest
}
