//! Paths that lead the centre of a tool to a contour and away from it.
//!
//! They meet the path of the centre at its begin B with the tangent t; n is the normal on the side of the
//! tool. The way away from a contour is the way to it, reversed.

use std::fmt;

use crate::plane::{Point, along, cross, dot, length, minus};
use crate::radius::Link;

/// A way to a contour; lengths are those of the centre of the tool.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Lead {
    /// A line of this length in the direction of the first element.
    Tangent {
        /// The length, mm.
        length_mm: f64,
    },
    /// A line of this length, perpendicular to the first element.
    Normal {
        /// The length, mm.
        length_mm: f64,
    },
    /// An arc that continues in the first element.
    Arc {
        /// The radius, mm; negative: it comes from the other side of the contour.
        radius_mm: f64,
        /// The angle that it sweeps, rad.
        sweep_rad: f64,
    },
    /// A line, and an arc that continues it and continues in the first element.
    LineAndArc {
        /// The radius, mm.
        radius_mm: f64,
    },
    /// A line to the circle about the start of the contour, and along it, if the way would cross the contour.
    Round,
}

/// The start lies within the circle of a lead.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct WithinCircle;

impl fmt::Display for WithinCircle {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("the start lies within the circle of the approach")
    }
}

impl std::error::Error for WithinCircle {}

/// Where a contour begins.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Begin {
    /// Its first point, mm.
    pub corner: Point,
    /// Where the centre of the tool is there, mm.
    pub centre: Point,
    /// The unit tangent of the first element. Unit: 1.
    pub tangent: Point,
    /// 1 if the tool is to the left, -1 if it is to the right. Unit: 1.
    pub side: f64,
}

impl Lead {
    /// The pieces from a start to the begin of a contour; the first one is always a line.
    ///
    /// # Errors
    /// If the start lies within the circle of the lead.
    pub fn pieces(&self, start: Point, begin: &Begin) -> Result<Vec<Link>, WithinCircle> {
        let Begin { corner, centre, tangent: t, side } = *begin;
        let normal = [-side * t[1], side * t[0]];
        let line = |to| Link::Line { to };
        Ok(match *self {
            Self::Tangent { length_mm } => vec![line(along(centre, t, -length_mm)), line(centre)],
            Self::Normal { length_mm } => {
                vec![line(along(centre, normal, length_mm)), line(centre)]
            }
            Self::Arc { radius_mm, sweep_rad } => {
                let center = along(centre, normal, radius_mm);
                let ccw = side * radius_mm > 0.0;
                let back = if ccw { -sweep_rad } else { sweep_rad };
                let from = turned(minus(centre, center), back);
                let from = along(center, from, 1.0);
                vec![line(from), Link::Arc { center, to: centre, ccw }]
            }
            Self::LineAndArc { radius_mm } => {
                let ccw = cross(t, minus(start, centre)) > 0.0;
                let inward = if ccw { [-t[1], t[0]] } else { [t[1], -t[0]] };
                let center = along(centre, inward, radius_mm);
                let touch = touch(start, center, radius_mm, ccw)?;
                vec![line(touch), Link::Arc { center, to: centre, ccw }]
            }
            Self::Round => {
                let behind = side * cross(t, minus(start, corner)) < 0.0;
                let radius_mm = length(minus(centre, corner));
                if !behind || radius_mm == 0.0 {
                    return Ok(vec![line(centre)]);
                }
                let ccw = side < 0.0;
                let touch = touch(start, corner, radius_mm, ccw)?;
                vec![line(touch), Link::Arc { center: corner, to: centre, ccw }]
            }
        })
    }
}

fn turned(v: Point, angle_rad: f64) -> Point {
    let (sin, cos) = angle_rad.sin_cos();
    [v[0] * cos - v[1] * sin, v[0] * sin + v[1] * cos]
}

/// Where a line from a start touches a circle so that it continues in its sense: with d from the centre to
/// the start, at the angle of d plus (counter-clockwise) or less arccos(R / |d|).
fn touch(start: Point, center: Point, radius: f64, ccw: bool) -> Result<Point, WithinCircle> {
    let d = minus(start, center);
    let square = dot(d, d);
    if square <= radius * radius {
        return Err(WithinCircle);
    }
    let cos = radius / square.sqrt();
    let sin = (1.0 - cos * cos).sqrt() * if ccw { 1.0 } else { -1.0 };
    let unit = [d[0] / square.sqrt(), d[1] / square.sqrt()];
    let arm = [unit[0] * cos - unit[1] * sin, unit[0] * sin + unit[1] * cos];
    Ok(along(center, arm, radius))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The contour begins at the origin along X, a tool of radius 2 is to its left.
    const BEGIN: Begin =
        Begin { corner: [0.0, 0.0], centre: [0.0, 2.0], tangent: [1.0, 0.0], side: 1.0 };

    fn close(a: Point, b: Point) -> bool {
        length(minus(a, b)) < 1e-12
    }

    fn pieces(lead: Lead, start: Point) -> Vec<Link> {
        lead.pieces(start, &BEGIN).unwrap()
    }

    #[test]
    fn lines_by_hand() {
        let line = |to| Link::Line { to };
        let tangent = pieces(Lead::Tangent { length_mm: 5.0 }, [-20.0, 9.0]);
        assert_eq!(tangent, [line([-5.0, 2.0]), line([0.0, 2.0])]);
        let normal = pieces(Lead::Normal { length_mm: 5.0 }, [-20.0, 9.0]);
        assert_eq!(normal, [line([0.0, 7.0]), line([0.0, 2.0])]);
    }

    #[test]
    fn arcs_by_hand() {
        // A quarter of a circle about (0, 5), counter-clockwise, from its leftmost point.
        let found = pieces(Lead::Arc { radius_mm: 3.0, sweep_rad: PI_2 }, [-20.0, 9.0]);
        let [Link::Line { to: from }, Link::Arc { center, ccw, .. }] = found[..] else { panic!() };
        assert!(close(from, [-3.0, 5.0]) && close(center, [0.0, 5.0]) && ccw);
        let found = pieces(Lead::Arc { radius_mm: -3.0, sweep_rad: PI_2 }, [-20.0, 9.0]);
        let [Link::Line { to: from }, Link::Arc { center, ccw, .. }] = found[..] else { panic!() };
        assert!(close(from, [-3.0, -1.0]) && close(center, [0.0, -1.0]) && !ccw);
    }

    #[test]
    fn a_line_touches_the_circle_that_it_continues_in() {
        for start in [[-20.0, 9.0], [7.0, 30.0], [-4.0, -9.0]] {
            let found = pieces(Lead::LineAndArc { radius_mm: 3.0 }, start);
            let [Link::Line { to }, Link::Arc { center, ccw, .. }] = found[..] else { panic!() };
            let (arm, way) = (minus(to, center), minus(to, start));
            assert!((length(arm) - 3.0).abs() < 1e-12 && dot(arm, way).abs() < 1e-12);
            assert_eq!(cross(arm, way) > 0.0, ccw, "it continues in the sense of the circle");
        }
        let inside = Lead::LineAndArc { radius_mm: 3.0 }.pieces([0.0, 5.0], &BEGIN);
        assert_eq!(inside, Err(WithinCircle));
    }

    #[test]
    fn a_tool_behind_the_contour_goes_round_its_start() {
        assert_eq!(pieces(Lead::Round, [-5.0, 1.0]), [Link::Line { to: [0.0, 2.0] }]);
        // From (-2, -9) straight up to (-2, 0) on the circle of radius 2, then clockwise to the top.
        let found = pieces(Lead::Round, [-2.0, -9.0]);
        let [Link::Line { to }, Link::Arc { center, ccw, .. }] = found[..] else { panic!() };
        assert!(close(to, [-2.0, 0.0]) && center == [0.0, 0.0] && !ccw);
    }

    const PI_2: f64 = std::f64::consts::FRAC_PI_2;
}
