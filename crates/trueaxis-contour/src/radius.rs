//! Cutter radius compensation: how the centre of a tool passes from one element to the next.
//!
//! The centre runs at the distance r of the tool radius on one side of the contour: on parallels of lines,
//! and on circles with the radius ρ − r inside and ρ + r outside an arc of radius ρ. With the unit tangents
//! t₁ and t₂ at the corner P and the normals n₁, n₂ on the side of the tool:
//!
//! - *inside corner* (the contour turns towards the tool): both paths end where they meet, which takes
//!   r · tan(φ/2) from each of two lines that turn by φ;
//! - *outside corner*: the centre goes round P, from P + r n₁ to P + r n₂, see [`Outside`];
//! - *reversal* (φ = 180°): an outside corner unless the two elements bend away from each other and leave
//!   the tool between them.

use std::f64::consts::PI;
use std::fmt;

use crate::element::{Curve, Element, ROUNDING};
use crate::plane::{Point, along, cross, dot};

/// Elements that turn by less continue each other, rad.
const SMOOTH_RAD: f64 = 1e-6;

/// Up to here a corner may come from rounded numbers: where the two paths do not meet, a short line joins
/// them, rad.
const ROUNDED_RAD: f64 = 0.02;

/// How the centre goes round an outside corner.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Outside {
    /// On an arc about the corner.
    Arc,
    /// On the tangents to where they meet; if the contour turns by more than 90°, along each tangent by the
    /// radius and on a line from one to the other.
    Tangents,
    /// Along both paths, which go on as lines or circles, to where they meet; if the contour turns by more
    /// than [`POINTED_DEG`], on an arc.
    Meeting,
}

/// The largest turn of an outside corner at which the paths go on to where they meet, degrees: the value that
/// SINUMERIK comes with (MD20210).
pub const POINTED_DEG: f64 = 100.0;

/// What a control does at corners.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rules {
    /// How it goes round outside corners.
    pub outside: Outside,
    /// Elements that turn by less are joined as if they continued each other, rad.
    pub smooth_rad: f64,
}

/// A piece of the path of the centre between two elements.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Link {
    /// A straight line.
    Line {
        /// Its end, mm.
        to: Point,
    },
    /// An arc.
    Arc {
        /// Its centre, mm.
        center: Point,
        /// Its end, mm.
        to: Point,
        /// Whether it is counter-clockwise.
        ccw: bool,
    },
}

/// How the centre passes from one element to the next.
#[derive(Debug, Clone, PartialEq)]
pub struct Passage {
    /// Where it leaves the path along the first element, mm.
    pub end: Point,
    /// The part of the first element that is cut off at its end, up to 1; negative: by which it goes on.
    /// Unit: 1.
    pub first_cut: f64,
    /// What lies between the two.
    pub links: Vec<Link>,
    /// The part of the second element that is cut off at its start, up to 1; negative: by which it begins
    /// before. Unit: 1.
    pub second_cut: f64,
}

/// Why the tool does not fit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Gouge {
    /// The tool is as large as the inside of an arc, or larger.
    Arc,
    /// The inside corner takes more than the length of an element.
    Corner,
}

impl fmt::Display for Gouge {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Arc => {
                "the radius of the tool is not smaller than that of the arc it cuts inside"
            }
            Self::Corner => "the inside corner takes more than the length of an element",
        })
    }
}

impl std::error::Error for Gouge {}

/// The place of the centre at a part of the length of an element, at a distance to its left, mm.
pub fn centre(element: &Element, part: f64, left_mm: f64) -> Point {
    let t = element.tangent(part);
    along(element.point(part), [-t[1], t[0]], left_mm)
}

/// Looks whether the tool fits inside an element if it is an arc.
///
/// # Errors
/// If it does not.
pub fn check_fit(element: &Element, left_mm: f64) -> Result<(), Gouge> {
    match *element {
        Element::Arc { radius_mm, sweep_rad, .. }
            if radius_mm - left_mm * sweep_rad.signum() <= ROUNDING * radius_mm =>
        {
            Err(Gouge::Arc)
        }
        _ => Ok(()),
    }
}

/// How the centre passes from one element to the next at a corner, at a distance to the left (negative: to
/// the right) of both. Of the first element `first_room` is left at most.
///
/// # Errors
/// If the tool does not fit.
pub fn passage(
    first: &Element,
    second: &Element,
    corner: Point,
    left_mm: f64,
    first_room: f64,
    rules: Rules,
) -> Result<Passage, Gouge> {
    let (t1, t2) = (first.tangent(1.0), second.tangent(0.0));
    let turn_rad = cross(t1, t2).atan2(dot(t1, t2));
    let smooth_rad = rules.smooth_rad.max(SMOOTH_RAD);
    let ends = [t1, t2].map(|t| along(corner, [-t[1], t[0]], left_mm));
    let direct = |links| Passage { end: ends[0], first_cut: 0.0, links, second_cut: 0.0 };
    if turn_rad.abs() <= smooth_rad {
        return Ok(direct(Vec::new()));
    }
    let reversal = PI - turn_rad.abs() < smooth_rad;
    let inside = if reversal {
        (curvature(first) + curvature(second)) * left_mm < -ROUNDING
    } else {
        turn_rad * left_mm > 0.0
    };
    if !inside && rules.outside == Outside::Meeting && turn_rad.abs() <= POINTED_DEG.to_radians() {
        let found = meeting(first, second, corner, left_mm, Fit::Longer);
        if let Some(found) = found {
            return Ok(found);
        }
    }
    if !inside && rules.outside == Outside::Tangents {
        return Ok(on_tangents([first, second], ends, left_mm, turn_rad.abs()));
    }
    if !inside {
        // Round the corner with the contour on the other side.
        let arc = Link::Arc { center: corner, to: ends[1], ccw: left_mm < 0.0 };
        return Ok(direct(vec![arc]));
    }
    match meeting(first, second, corner, left_mm, Fit::Within(first_room)) {
        Some(found) => Ok(found),
        None if turn_rad.abs() < ROUNDED_RAD => Ok(direct(vec![Link::Line { to: ends[1] }])),
        None => Err(Gouge::Corner),
    }
}

/// The curvature of an element, positive if it turns to the left, 1/mm.
fn curvature(element: &Element) -> f64 {
    match *element {
        Element::Line { .. } => 0.0,
        Element::Arc { radius_mm, sweep_rad, .. } => sweep_rad.signum() / radius_mm,
    }
}

/// The way round an outside corner on the tangents. Lines become longer; at arcs lines are added.
fn on_tangents(
    [first, second]: [&Element; 2],
    [from, to]: [Point; 2],
    left_mm: f64,
    turn_rad: f64,
) -> Passage {
    let (t1, t2) = (first.tangent(1.0), second.tangent(0.0));
    let wide = turn_rad <= PI / 2.0 + SMOOTH_RAD;
    let extension = left_mm.abs() * if wide { (turn_rad / 2.0).tan() } else { 1.0 };
    let (leaves, meets) = (along(from, t1, extension), along(to, t2, -extension));
    let mut passage = Passage { end: from, first_cut: 0.0, links: Vec::new(), second_cut: 0.0 };
    match first {
        Element::Line { .. } => {
            (passage.end, passage.first_cut) = (leaves, -extension / first.length_mm());
        }
        Element::Arc { .. } => passage.links.push(Link::Line { to: leaves }),
    }
    if !wide {
        passage.links.push(Link::Line { to: meets });
    }
    match second {
        Element::Line { .. } => passage.second_cut = -extension / second.length_mm(),
        Element::Arc { .. } => passage.links.push(Link::Line { to }),
    }
    passage
}

/// Where two paths may meet.
#[derive(Clone, Copy)]
enum Fit {
    /// Within both elements, of the first one within the part that is left.
    Within(f64),
    /// Beyond the end of the first one and before the start of the second one.
    Longer,
}

impl Fit {
    fn accepts(self, first_cut: f64, second_cut: f64) -> bool {
        match self {
            Self::Within(room) => {
                (-ROUNDING..=room + ROUNDING).contains(&first_cut)
                    && (-ROUNDING..=1.0 + ROUNDING).contains(&second_cut)
            }
            Self::Longer => first_cut < ROUNDING && second_cut < ROUNDING,
        }
    }
}

/// Where the paths along two elements meet.
fn meeting(
    first: &Element,
    second: &Element,
    corner: Point,
    left_mm: f64,
    fit: Fit,
) -> Option<Passage> {
    // The ends of a written arc have slightly different radii: that at the corner counts.
    let (a, b) = (first.through(corner).parallel(left_mm)?, second.parallel(left_mm)?);
    let mut best: Option<(f64, Passage)> = None;
    for end in Curve::meet(a, b) {
        let mut cuts =
            [first.cut_off(first.foot(end), true), second.cut_off(second.foot(end), false)];
        if matches!(fit, Fit::Longer) {
            cuts = [first.shorter_way(cuts[0]), second.shorter_way(cuts[1])];
        }
        let [first_cut, second_cut] = cuts;
        if !fit.accepts(first_cut, second_cut) || !end[0].is_finite() || !end[1].is_finite() {
            continue;
        }
        let removed =
            (first_cut * first.length_mm()).abs() + (second_cut * second.length_mm()).abs();
        if best.as_ref().is_none_or(|(least, _)| removed < *least) {
            if matches!(fit, Fit::Within(_)) {
                cuts = cuts.map(|c| c.max(0.0));
            }
            let [first_cut, second_cut] = cuts;
            best = Some((removed, Passage { end, first_cut, links: Vec::new(), second_cut }));
        }
    }
    best.map(|(_, found)| found)
}
