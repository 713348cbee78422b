//! The path of the centre of a cutter along a contour that is known as a whole, and the ways to it and away.

use trueaxis_contour::Element;
use trueaxis_contour::lead::{Begin, Lead};
use trueaxis_contour::radius::{Gouge, Link, Rules, centre, check_fit, passage};

use crate::Point;
use crate::mill::Stroke;

/// The path of the centre along a contour.
#[derive(Debug, Clone, PartialEq)]
pub struct CentrePath {
    /// Where it begins, mm.
    pub begin: Point,
    /// Its pieces.
    pub links: Vec<Link>,
    /// Where it ends, mm.
    pub end: Point,
    first: Element,
    last: Element,
    left_mm: f64,
}

/// The path at a distance to the left (negative: to the right) of a contour; `None` for a contour without
/// elements.
///
/// # Errors
/// If the cutter does not fit.
pub fn centre_path(
    elements: &[Element],
    left_mm: f64,
    rules: Rules,
) -> Option<Result<CentrePath, Gouge>> {
    let (first, last) = (*elements.first()?, *elements.last()?);
    let along = |e: &Element, to: Point| match *e {
        Element::Line { .. } => Link::Line { to },
        Element::Arc { center, sweep_rad, .. } => Link::Arc { center, to, ccw: sweep_rad > 0.0 },
    };
    let links = || -> Result<Vec<Link>, Gouge> {
        let (mut links, mut used) = (Vec::new(), 0.0);
        for element in elements {
            check_fit(element, left_mm)?;
        }
        for pair in elements.windows(2) {
            let corner = pair[0].point(1.0);
            if left_mm == 0.0 {
                links.push(along(&pair[0], corner));
                continue;
            }
            let passed = passage(&pair[0], &pair[1], corner, left_mm, 1.0 - used, rules)?;
            links.push(along(&pair[0], passed.end));
            links.extend(passed.links);
            used = passed.second_cut;
        }
        links.push(along(&last, centre(&last, 1.0, left_mm)));
        Ok(links)
    };
    let (begin, end) = (centre(&first, 0.0, left_mm), centre(&last, 1.0, left_mm));
    Some(links().map(|links| CentrePath { begin, links, end, first, last, left_mm }))
}

impl CentrePath {
    /// The pieces of a way to the begin, the first of them to where it begins; `None` if it has none.
    pub fn way_in(&self, lead: Lead) -> Option<Vec<Link>> {
        let begin = Begin {
            corner: self.first.point(0.0),
            centre: self.begin,
            tangent: self.first.tangent(0.0),
            side: self.left_mm.signum(),
        };
        lead.pieces(self.begin, &begin).ok()
    }

    /// The pieces of a way from the end: the way to it, reversed.
    pub fn way_out(&self, lead: Lead) -> Option<Vec<Link>> {
        let begin = Begin {
            corner: self.last.point(1.0),
            centre: self.end,
            tangent: self.last.tangent(1.0).map(|t| -t),
            side: -self.left_mm.signum(),
        };
        let pieces = lead.pieces(self.end, &begin).ok()?;
        let ends: Vec<Point> = pieces.iter().map(end_of).collect();
        let back = (1..pieces.len()).rev().map(|i| match pieces[i] {
            Link::Line { .. } => Link::Line { to: ends[i - 1] },
            Link::Arc { center, ccw, .. } => Link::Arc { center, to: ends[i - 1], ccw: !ccw },
        });
        Some(back.collect())
    }
}

/// Where a piece ends, mm.
pub fn end_of(link: &Link) -> Point {
    match *link {
        Link::Line { to } | Link::Arc { to, .. } => to,
    }
}

/// A piece at a height.
pub fn stroke(link: &Link, height: f64) -> Stroke {
    match *link {
        Link::Line { to } => Stroke::Line([to[0], to[1], height]),
        Link::Arc { center, to, ccw } => {
            Stroke::Arc { to: [to[0], to[1], height], center, ccw, plunges: false }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::FRAC_PI_2;
    use trueaxis_contour::radius::Outside;

    const RULES: Rules = Rules { outside: Outside::Arc, smooth_rad: 0.0 };

    /// Around the outside of two sides of a square by 2: a quarter circle at the corner, and quarter circles to
    /// the contour and away from it.
    #[test]
    fn outside_a_corner() {
        let elements =
            [Element::line([0.0, 0.0], [10.0, 0.0]), Element::line([10.0, 0.0], [10.0, 10.0])];
        let path = centre_path(&elements, -2.0, RULES).unwrap().unwrap();
        assert_eq!((path.begin, path.end), ([0.0, -2.0], [12.0, 10.0]));
        assert_eq!(path.links[0], Link::Line { to: [10.0, -2.0] });
        assert_eq!(path.links[1], Link::Arc { center: [10.0, 0.0], to: [12.0, 0.0], ccw: true });
        let lead = Lead::Arc { radius_mm: 5.0, sweep_rad: FRAC_PI_2 };
        let [from, to] = path.way_in(lead).unwrap()[..] else { panic!() };
        let near = |a: Point, b: Point| (a[0] - b[0]).hypot(a[1] - b[1]) < 1e-9;
        // About (0, -7), clockwise onto the direction +X: from its left end (-5, -7).
        assert!(near(end_of(&from), [-5.0, -7.0]), "{from:?}");
        assert!(matches!(to, Link::Arc { center, ccw: false, .. } if near(center, [0.0, -7.0])));
        let [away] = path.way_out(lead).unwrap()[..] else { panic!() };
        assert!(near(end_of(&away), [17.0, 15.0]), "{away:?}");
        assert!(matches!(away, Link::Arc { center, ccw: false, .. } if near(center, [17.0, 10.0])));
        // Inside the same corner, and one that is too narrow.
        let inside = centre_path(&elements, 2.0, RULES).unwrap().unwrap();
        assert_eq!(inside.links, [Link::Line { to: [8.0, 2.0] }, Link::Line { to: [8.0, 10.0] }]);
        assert_eq!(centre_path(&elements, 11.0, RULES).unwrap(), Err(Gouge::Corner));
        assert_eq!(centre_path(&[], 1.0, RULES), None);
    }
}
