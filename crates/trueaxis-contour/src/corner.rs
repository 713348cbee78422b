//! Roundings and chamfers at the corner of two elements of a contour.
//!
//! A rounding of radius r touches both elements. Its centre is at the distance r from each of them, on the
//! side to which the contour turns: it lies on the parallel of a line at the distance r, and on a circle
//! with the radius ρ − r or ρ + r about the centre of an arc of radius ρ. Of the intersections of these
//! two curves the one nearest to the corner counts.
//!
//! A chamfer begins and ends at the same distance from the corner. With the unit tangents t₁ and t₂ of two
//! lines and the distance d its length is d · |t₁ + t₂|.

use std::fmt;

use crate::element::{Element, ROUNDING};
use crate::plane::{Point, cross, dot, length, minus};

/// Elements whose tangents differ by less than this sine continue each other without a corner.
const SMOOTH: f64 = 1e-7;

/// What is inserted at a corner.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Shape {
    /// An arc that touches both elements.
    Round {
        /// Its radius, mm.
        radius_mm: f64,
    },
    /// A line that begins and ends at this distance from the corner.
    ChamferLeg {
        /// The distance, mm.
        leg_mm: f64,
    },
    /// A line of this length.
    ChamferLength {
        /// The length, mm.
        length_mm: f64,
    },
}

/// The inserted element, and what it cuts off from its neighbours.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Transition {
    /// Where it leaves the first element, mm.
    pub from: Point,
    /// Where it meets the second element, mm.
    pub to: Point,
    /// The part of the first element that remains, from 0 to 1. Unit: 1.
    pub first_ends: f64,
    /// The part of the second element that is cut off, from 0 to 1. Unit: 1.
    pub second_begins: f64,
    /// Centre and sense (counter-clockwise) of a rounding; a chamfer has none.
    pub arc: Option<(Point, bool)>,
}

/// Why a corner cannot be made.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CornerError {
    /// The inserted element is longer than one of its neighbours.
    TooLarge,
    /// The second element runs back along the first one.
    Reversal,
    /// An element has no length in the plane.
    NoLength,
}

impl fmt::Display for CornerError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::TooLarge => "it is larger than one of the two elements allows",
            Self::Reversal => "the second element runs back along the first one",
            Self::NoLength => "one of the two elements has no length in the plane",
        })
    }
}

impl std::error::Error for CornerError {}

/// The transition from one element to the next, which begins where the first one ends; `None` where they
/// continue each other without a corner.
///
/// # Errors
/// Where the shape does not fit.
pub fn transition(
    first: &Element,
    second: &Element,
    shape: Shape,
) -> Result<Option<Transition>, CornerError> {
    if [first, second].iter().any(|e| e.length_mm().is_nan() || e.length_mm() < 1e-9) {
        return Err(CornerError::NoLength);
    }
    let (t1, t2) = (first.tangent(1.0), second.tangent(0.0));
    let turn = cross(t1, t2);
    if turn.abs() < SMOOTH {
        return if dot(t1, t2) > 0.0 { Ok(None) } else { Err(CornerError::Reversal) };
    }
    match shape {
        Shape::Round { radius_mm } => rounding(first, second, radius_mm, turn > 0.0),
        Shape::ChamferLeg { leg_mm } => chamfer(first, second, leg_mm),
        Shape::ChamferLength { length_mm } => {
            let leg = leg_of_length(first, second, length_mm).ok_or(CornerError::TooLarge)?;
            chamfer(first, second, leg)
        }
    }
    .map(Some)
}

fn rounding(
    first: &Element,
    second: &Element,
    radius: f64,
    ccw: bool,
) -> Result<Transition, CornerError> {
    let left = if ccw { radius } else { -radius };
    let curves = first.parallel(left).zip(second.parallel(left));
    let (a, b) = curves.ok_or(CornerError::TooLarge)?;
    let mut best: Option<(f64, Transition)> = None;
    for center in a.meet(b) {
        let (from, to) = (first.foot(center), second.foot(center));
        let cut = [first.cut_off(from, true), second.cut_off(to, false)];
        if !cut.iter().all(|c| (-ROUNDING..=1.0 + ROUNDING).contains(c)) {
            continue;
        }
        let removed = cut[0] * first.length_mm() + cut[1] * second.length_mm();
        if best.as_ref().is_none_or(|(least, _)| removed < *least) {
            let arc = Some((center, ccw));
            let [first_cut, second_begins] = cut.map(|c| c.clamp(0.0, 1.0));
            let found = Transition { from, to, first_ends: 1.0 - first_cut, second_begins, arc };
            best = Some((removed, found));
        }
    }
    best.map(|(_, found)| found).ok_or(CornerError::TooLarge)
}

fn chamfer(first: &Element, second: &Element, leg: f64) -> Result<Transition, CornerError> {
    let parts = first.part_at(leg).zip(second.part_at(leg));
    let (cut, second_begins) = parts.ok_or(CornerError::TooLarge)?;
    let first_ends = 1.0 - cut;
    let (from, to) = (first.point(first_ends), second.point(second_begins));
    Ok(Transition { from, to, first_ends, second_begins, arc: None })
}

/// The distance from the corner at which a chamfer has a length: closed form for lines, halving else.
fn leg_of_length(first: &Element, second: &Element, wanted: f64) -> Option<f64> {
    let (t1, t2) = (first.tangent(1.0), second.tangent(0.0));
    let straight = wanted / length([t1[0] + t2[0], t1[1] + t2[1]]);
    if matches!((first, second), (Element::Line { .. }, Element::Line { .. })) {
        return Some(straight);
    }
    let length_at =
        |leg: f64| chamfer(first, second, leg).ok().map(|c| length(minus(c.to, c.from)));
    let (mut low, mut high) = (0.0, straight);
    for _ in 0..60 {
        match length_at(high) {
            Some(found) if found < wanted => (low, high) = (high, 2.0 * high),
            _ => break,
        }
    }
    for _ in 0..100 {
        let middle = f64::midpoint(low, high);
        match length_at(middle) {
            Some(found) if found < wanted => low = middle,
            _ => high = middle,
        }
    }
    length_at(low).filter(|found| (found - wanted).abs() < 1e-6 * wanted).map(|_| low)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn close(a: Point, b: Point) -> bool {
        length(minus(a, b)) < 1e-9
    }

    #[test]
    fn a_right_angle_is_rounded_by_its_radius_and_cut_by_its_leg() {
        let (a, b) =
            (Element::line([0.0, 0.0], [10.0, 0.0]), Element::line([10.0, 0.0], [10.0, -8.0]));
        let round = transition(&a, &b, Shape::Round { radius_mm: 3.0 }).unwrap().unwrap();
        assert_eq!(
            (round.from, round.to, round.arc),
            ([7.0, 0.0], [10.0, -3.0], Some(([7.0, -3.0], false)))
        );
        let cut = transition(&a, &b, Shape::ChamferLeg { leg_mm: 2.0 }).unwrap().unwrap();
        assert_eq!((cut.from, cut.to, cut.arc), ([8.0, 0.0], [10.0, -2.0], None));
        // The hypotenuse of legs of 2 is 2 √2.
        let long = Shape::ChamferLength { length_mm: 8.0_f64.sqrt() };
        assert!(close(transition(&a, &b, long).unwrap().unwrap().from, [8.0, 0.0]));
    }

    #[test]
    fn a_line_into_a_semicircle() {
        // Down the Y axis to the origin, then the upper half of a circle about (5, 0) from the origin:
        // the tangents are -Y and +Y. From the left along X instead they make a right angle. The centre of
        // the rounding lies at the height 1 above the line and at 5 + 1 from (5, 0):
        // x = 5 - √(36 - 1).
        let a = Element::line([-10.0, 0.0], [0.0, 0.0]);
        let b = Element::arc([0.0, 0.0], [10.0, 0.0], [5.0, 0.0], false, 1);
        let round = transition(&a, &b, Shape::Round { radius_mm: 1.0 }).unwrap().unwrap();
        let x = 5.0 - 35.0_f64.sqrt();
        assert!(close(round.from, [x, 0.0]) && round.arc.unwrap().1);
        assert!(close(round.arc.unwrap().0, [x, 1.0]));
        assert!(close(round.to, [5.0 - 5.0 * 35.0_f64.sqrt() / 6.0, 5.0 / 6.0]));
        let back = Element::line([0.0, 9.0], [0.0, 0.0]);
        assert_eq!(
            transition(&back, &b, Shape::Round { radius_mm: 1.0 }),
            Err(CornerError::Reversal)
        );
    }

    #[test]
    fn what_does_not_fit_is_refused() {
        let (a, b) =
            (Element::line([0.0, 0.0], [10.0, 0.0]), Element::line([10.0, 0.0], [10.0, 2.0]));
        for shape in [Shape::Round { radius_mm: 2.1 }, Shape::ChamferLeg { leg_mm: 2.1 }] {
            assert_eq!(transition(&a, &b, shape), Err(CornerError::TooLarge));
        }
        assert!(transition(&a, &b, Shape::Round { radius_mm: 2.0 }).is_ok());
        let on = Element::line([10.0, 0.0], [12.0, 0.0]);
        assert_eq!(transition(&a, &on, Shape::Round { radius_mm: 2.0 }), Ok(None));
    }
}
