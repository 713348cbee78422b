//! The curve at a distance from a profile.
//!
//! Each stretch is shifted along its normal. At each corner an arc about the corner joins what was shifted. The
//! result has loops where the profile is too narrow for the distance, and at each inner corner; they are cut off
//! where the curve meets itself. What remains is nowhere nearer to the profile than the distance, which is
//! checked.

use trueaxis_contour::plane::{Point, cross, dot, length, minus};

use super::stretch::{SAME_MM, Stretch};

/// The curve at a distance to the left (below 0: to the right) of connected stretches; `None` where there is none
/// that keeps it.
///
/// Arcs about a corner that are shorter than `short_mm` are left out: their neighbours are extended.
pub(super) fn parallel(profile: &[Stretch], left: f64, short_mm: f64) -> Option<Vec<Stretch>> {
    let mut raw: Vec<Stretch> = Vec::new();
    for (n, stretch) in profile.iter().enumerate() {
        let mut next = shifted(stretch, left);
        if let (Some(before), Some(last)) = (n.checked_sub(1).map(|b| &profile[b]), raw.last_mut())
        {
            let joint = joint(before, stretch, left);
            let short = joint.filter(|j| j.radius() * j.sweep().abs() < short_mm);
            match short.and_then(|j| corner_of(last, &next, j)) {
                Some(p) => (last.to, next.from) = (p, p),
                None => raw.extend(joint),
            }
        }
        raw.push(next);
    }
    let mut kept: Vec<Stretch> = Vec::new();
    for stretch in raw {
        append(&mut kept, stretch);
    }
    // The radii of a written arc differ at its ends by rounding.
    let slack = 2.0 * profile.iter().map(Stretch::ends_apart).fold(0.0, f64::max);
    let widened = |s: &Stretch| [s.span()[0] - left.abs(), s.span()[1] + left.abs()];
    let spans: Vec<([f64; 2], &Stretch)> = profile.iter().map(|s| (widened(s), s)).collect();
    let far = |p: Point| {
        let near = spans.iter().filter(|([low, high], _)| *low <= p[0] && p[0] <= *high);
        let least = near.map(|(_, s)| s.distance(p)).fold(f64::INFINITY, f64::min);
        least > left.abs() * (1.0 - 1e-6) - 1e-6 - slack
    };
    let good = kept.iter().all(|s| far(s.from) && far(s.middle()) && far(s.to));
    (good && !kept.is_empty()).then_some(kept)
}

/// A stretch at a distance. An arc of a smaller radius turns inside out: its part is cut off as a loop.
fn shifted(stretch: &Stretch, left: f64) -> Stretch {
    let by = |p: Point, t: Point| [p[0] - left * t[1], p[1] + left * t[0]];
    Stretch {
        from: by(stretch.from, stretch.tangent_at_start()),
        to: by(stretch.to, stretch.tangent_at_end()),
        arc: stretch.arc,
    }
}

/// The arc about a corner, if there is one.
fn joint(first: &Stretch, second: &Stretch, left: f64) -> Option<Stretch> {
    let (t, u) = (first.tangent_at_end(), second.tangent_at_start());
    let turn = cross(t, u);
    if turn.abs() < 1e-9 && dot(t, u) > 0.0 {
        return None;
    }
    let (from, to) = (shifted(first, left).to, shifted(second, left).from);
    Some(Stretch { from, to, arc: Some((first.to, turn > 0.0)) })
}

/// Where two stretches meet beyond the ends that a short arc about an outer corner would join.
fn corner_of(last: &Stretch, next: &Stretch, joint: Stretch) -> Option<Point> {
    let near = |p: &Point| length(minus(*p, joint.from));
    let points = last.extended_to(next).into_iter().flatten();
    let p = points.min_by(|a, b| near(a).total_cmp(&near(b)))?;
    let ahead = dot(minus(p, joint.from), last.tangent_at_end()) > 0.0;
    (ahead && near(&p) < joint.radius() * joint.sweep().abs()).then_some(p)
}

/// Adds a stretch, and cuts off the loop where it meets what is there.
fn append(kept: &mut Vec<Stretch>, mut next: Stretch) {
    while !next.is_empty() {
        let Some((index, p)) = first_meeting(kept, &next) else {
            kept.push(next);
            return;
        };
        kept.truncate(index + 1);
        kept[index] = kept[index].until(p);
        if kept[index].is_empty() {
            kept.pop();
        }
        next = next.after(p);
    }
}

/// The first place of a curve at which a stretch meets it, other than where it begins.
fn first_meeting(kept: &[Stretch], next: &Stretch) -> Option<(usize, Point)> {
    let [low, high] = next.span();
    for (index, stretch) in kept.iter().enumerate() {
        let [from, to] = stretch.span();
        if to < low - SAME_MM || from > high + SAME_MM {
            continue;
        }
        let joined = |p: &Point| {
            index + 1 == kept.len() && length(minus(*p, next.from)) < 1e-7
                || length(minus(*p, next.from)) < SAME_MM && length(minus(*p, stretch.to)) < SAME_MM
        };
        let mut points = stretch.meet(next);
        points.retain(|p| !joined(p));
        let first = points.into_iter().min_by(|a, b| stretch.part(*a).total_cmp(&stretch.part(*b)));
        if let Some(p) = first {
            return Some((index, p));
        }
    }
    None
}
