//! One line of a stock: its material, and what a cutter removes from it.

use super::{Grid, Step};
use crate::Cutter;
use trueaxis_geometry::Vec3;

/// Stretches of a line that are material, from low to high, without common points.
pub(super) type Material = Vec<[f64; 2]>;

/// Shorter stretches are nothing. Unit: mm.
const SHORTEST_MM: f64 = 1e-7;
/// Newton's method ends at this distance from the cutter. Unit: mm.
const CLOSE_MM: f64 = 1e-8;
const MOST_STEPS: usize = 60;

/// A cutter at a pose: the part of it that may be within some bounds, and the box around that.
pub(super) struct Body<'c> {
    cutter: &'c Cutter,
    tip_mm: Vec3,
    axis: Vec3,
    radius_mm: f64,
    inset_mm: f64,
    takes: bool,
    /// The end of that part of its axis.
    end_mm: Vec3,
    pub low_mm: Vec3,
    pub high_mm: Vec3,
}

impl<'c> Body<'c> {
    /// None if it is outside of these bounds.
    pub fn of(step: &Step<'c>, bounds: &[Vec3; 2]) -> Option<Self> {
        let Step { cutter, pose, inset_mm, takes } = *step;
        let (radius, height) = cutter.extent_mm();
        let aside = pose.axis.map(|c| radius * (1.0 - c * c).max(0.0).sqrt());
        // Higher up all of it is beyond a side of the bounds.
        let within = |k: usize| match pose.axis[k] {
            a if a > 0.0 => (bounds[1][k] - pose.tip_mm[k] + aside[k]) / a,
            a if a < 0.0 => (bounds[0][k] - pose.tip_mm[k] - aside[k]) / a,
            _ => height,
        };
        let height = (0..3).map(within).fold(height, f64::min);
        if height < 0.0 {
            return None;
        }
        let end_mm = pose.tip_mm + pose.axis * height;
        let low_mm = pose.tip_mm.inf(&end_mm) - aside;
        let high_mm = pose.tip_mm.sup(&end_mm) + aside;
        let meets = (0..3).all(|k| low_mm[k] <= bounds[1][k] && high_mm[k] >= bounds[0][k]);
        let (tip_mm, axis) = (pose.tip_mm, pose.axis);
        meets.then_some(Self {
            cutter,
            tip_mm,
            axis,
            radius_mm: radius,
            inset_mm,
            takes,
            end_mm,
            low_mm,
            high_mm,
        })
    }

    /// From where to where along the first of two axes lines across both may meet it, at a place of the second: seen along the lines it is within
    /// a strip around its axis with round ends.
    pub fn reach_at(&self, [a, b]: [usize; 2], v: f64) -> Option<[f64; 2]> {
        let ends = [self.tip_mm, self.end_mm].map(|p| [p[a], p[b]]);
        let mut reach = [f64::MAX, f64::MIN];
        let mut add = |u: f64| reach = [reach[0].min(u), reach[1].max(u)];
        for end in ends {
            let half = self.radius_mm * self.radius_mm - (v - end[1]).powi(2);
            if half >= 0.0 {
                add(end[0] - half.sqrt());
                add(end[0] + half.sqrt());
            }
        }
        let way = [ends[1][0] - ends[0][0], ends[1][1] - ends[0][1]];
        let length = way[0].hypot(way[1]);
        if length > 0.0 && way[1] != 0.0 {
            for side in [-self.radius_mm, self.radius_mm] {
                let edge =
                    [ends[0][0] - side * way[1] / length, ends[0][1] + side * way[0] / length];
                let place = (v - edge[1]) / way[1];
                if (0.0..=1.0).contains(&place) {
                    add(edge[0] + place * way[0]);
                }
            }
        }
        (reach[0] <= reach[1]).then_some(reach)
    }
}

/// A line seen from a body: arm from its tip at the coordinate 0, height along its axis.
struct Line {
    arm_along: f64,
    arm_squared: f64,
    height: f64,
    slope: f64,
}

impl Line {
    /// Through a place, along an axis of the frame; the place has the coordinate 0 there.
    fn through(body: &Body<'_>, at: &Vec3, along: usize) -> Self {
        let arm = at - body.tip_mm;
        Self {
            arm_along: arm[along],
            arm_squared: arm.norm_squared(),
            height: arm.dot(&body.axis),
            slope: body.axis[along],
        }
    }

    /// The signed distance from the cutter at a coordinate, and how it changes along the line; convex.
    fn distance(&self, body: &Body<'_>, t: f64) -> (f64, f64) {
        let height = self.height + t * self.slope;
        let arm = self.arm_along + t;
        let squared = self.arm_squared + t * (2.0 * self.arm_along + t) - height * height;
        let radial = squared.max(0.0).sqrt();
        let (distance, [out, up]) = body.cutter.distance(radial, height);
        let radial_slope = if radial > 0.0 { (arm - height * self.slope) / radial } else { 0.0 };
        (distance + body.inset_mm, out * radial_slope + up * self.slope)
    }

    /// From outside towards the cutter by Newton's method, which stays outside of a convex body: none if the line passes it.
    fn enter(&self, body: &Body<'_>, from: (f64, f64, f64), end: f64) -> Option<f64> {
        let (mut t, mut distance, mut slope) = from;
        let way = (end - t).signum();
        for _ in 0..MOST_STEPS {
            if distance <= CLOSE_MM {
                return Some(t);
            }
            if slope * way >= 0.0 {
                return None;
            }
            t -= distance / slope;
            if (end - t) * way < 0.0 {
                return None;
            }
            (distance, slope) = self.distance(body, t);
        }
        Some(t)
    }
}

/// What a line lost.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Stretch {
    pub length_mm: f64,
    pub longest_mm: f64,
    pub gouged_mm: f64,
    pub gouge_mm: f64,
}

impl Stretch {
    pub fn add(&mut self, other: &Self) {
        self.length_mm += other.length_mm;
        self.longest_mm = self.longest_mm.max(other.longest_mm);
        self.gouged_mm += other.gouged_mm;
        self.gouge_mm = self.gouge_mm.max(other.gouge_mm);
    }
}

/// How much of a stretch is material.
pub(super) fn overlap(material: &[[f64; 2]], stretch: [f64; 2]) -> f64 {
    let common = |s: &[f64; 2]| (s[1].min(stretch[1]) - s[0].max(stretch[0])).max(0.0);
    material.iter().map(common).sum()
}

/// What of the line through a place along an axis is inside of the body, and off it if the body takes it; the place has the coordinate 0 there.
/// And no material of the line is nearer to the cutter than the distance that comes with it (0 where it is not known), mm.
pub(super) fn take(
    material: &mut Material,
    part: Option<(&[[f64; 2]], &[Grid; 3])>,
    body: &Body<'_>,
    (at, along): (&Vec3, usize),
) -> (Stretch, f64) {
    let mut taken = Stretch::default();
    let box_mm = [body.low_mm[along], body.high_mm[along]];
    if material.iter().all(|s| s[1] <= box_mm[0] || s[0] >= box_mm[1]) {
        return (taken, 0.0);
    }
    let line = Line::through(body, at, along);
    let mut clear_mm = f64::MAX;
    let mut k = 0;
    while k < material.len() {
        let stretch = material[k];
        let [from, to] = match inside(stretch, body, &line, box_mm) {
            Ok(inside) => inside,
            Err(distance) => {
                clear_mm = clear_mm.min(distance - body.inset_mm);
                k += 1;
                continue;
            }
        };
        clear_mm = 0.0;
        taken.length_mm += to - from;
        taken.longest_mm = taken.longest_mm.max(to - from);
        if let Some((own, part)) = part {
            let gouged = overlap(own, [from, to]);
            taken.gouged_mm += gouged;
            if gouged > SHORTEST_MM {
                // Both ends that are new surface; a stretch that is gone as a whole has none.
                let ends = [from, to].into_iter().filter(|e| !stretch.contains(e));
                for end in ends {
                    let mut place = *at;
                    place[along] = end;
                    let depth =
                        part.iter().map(|grid| grid.depth_mm(&place)).fold(f64::MAX, f64::min);
                    taken.gouge_mm = taken.gouge_mm.max(depth);
                }
            }
        }
        if !body.takes {
            k += 1;
            continue;
        }
        let below = [stretch[0], from];
        let above = [to, stretch[1]];
        let is_there = |s: &[f64; 2]| s[1] - s[0] > SHORTEST_MM;
        match (is_there(&below), is_there(&above)) {
            (true, true) => {
                material[k] = below;
                material.insert(k + 1, above);
                k += 2;
            }
            (true, false) => {
                material[k] = below;
                k += 1;
            }
            (false, true) => {
                material[k] = above;
                k += 1;
            }
            (false, false) => {
                material.remove(k);
            }
        }
    }
    (taken, clear_mm)
}

/// The part of a stretch that is inside of the body; outside of its box there is none. Otherwise what the distance of the stretch from it is at
/// least, not above 0 where that is not known.
fn inside(
    stretch: [f64; 2],
    body: &Body<'_>,
    line: &Line,
    box_mm: [f64; 2],
) -> Result<[f64; 2], f64> {
    let (low, high) = (stretch[0].max(box_mm[0]), stretch[1].min(box_mm[1]));
    if low >= high {
        return Err(0.0);
    }
    // The distance is convex along the line: where it grows away from the stretch the body is not in it, and it lies above its tangents.
    let (far, slope) = line.distance(body, high);
    if far > 0.0 && slope <= 0.0 {
        return Err(far + slope * (stretch[1] - high));
    }
    let (near, first) = line.distance(body, low);
    if near > 0.0 && first >= 0.0 {
        return Err(near + first * (stretch[0] - low));
    }
    if near > 0.0 && far > 0.0 {
        let crossing = low + (far - near + slope * (low - high)) / (first - slope);
        let least = near + first * (crossing - low);
        if least > CLOSE_MM {
            return Err(least);
        }
    }
    let enter = |from, end| line.enter(body, from, end).ok_or(0.0);
    let from = if near <= 0.0 { low } else { enter((low, near, first), high)? };
    let to = if far <= 0.0 { high } else { enter((high, far, slope), low)? };
    if to - from > SHORTEST_MM { Ok([from, to]) } else { Err(0.0) }
}
