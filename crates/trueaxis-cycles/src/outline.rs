//! Closed outlines of pockets and spigots, and the way once around them.

use trueaxis_contour::plane::along;

use crate::Point;
use crate::mill::Stroke;

/// An outline about the origin, its longer side in any direction; lengths in mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Outline {
    /// A rectangle with rounded corners.
    Rectangle {
        /// Half of its sides along its own two axes, mm.
        half_mm: Point,
        /// The radius of its corners, mm.
        corner_mm: f64,
        /// The direction of its first axis, degrees.
        angle_deg: f64,
    },
    /// A circle.
    Circle {
        /// Its radius, mm.
        radius_mm: f64,
    },
}

/// A quarter or half circle that leads to an outline or away from it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Lead {
    pub begin: Point,
    pub end: Point,
    pub center: Point,
    pub ccw: bool,
}

impl Outline {
    /// The outline at a distance inside (negative: outside) of this one; `None` if none remains.
    pub fn inside(&self, by_mm: f64) -> Option<Self> {
        match *self {
            Self::Rectangle { half_mm, corner_mm, angle_deg } => {
                let half_mm = half_mm.map(|h| h - by_mm);
                let fits = half_mm.iter().all(|h| *h >= 0.0);
                let corner_mm = (corner_mm - by_mm).max(0.0).min(half_mm[0]).min(half_mm[1]);
                fits.then_some(Self::Rectangle { half_mm, corner_mm, angle_deg })
            }
            Self::Circle { radius_mm } => {
                let radius_mm = radius_mm - by_mm;
                (radius_mm >= 0.0).then_some(Self::Circle { radius_mm })
            }
        }
    }

    /// How far the outline is from its middle line.
    pub(crate) fn narrow_mm(&self) -> f64 {
        match *self {
            Self::Rectangle { half_mm, .. } => half_mm[0].min(half_mm[1]),
            Self::Circle { radius_mm } => radius_mm,
        }
    }

    /// A place of the outline's own axes about a centre.
    pub(crate) fn place(&self, center: Point, p: Point) -> Point {
        let angle_deg = match *self {
            Self::Rectangle { angle_deg, .. } => angle_deg,
            Self::Circle { .. } => 0.0,
        };
        let (sin, cos) = angle_deg.to_radians().sin_cos();
        [center[0] + p[0] * cos - p[1] * sin, center[1] + p[0] * sin + p[1] * cos]
    }

    /// Half of the longer axis, and half of the middle line along it, in the outline's own axes.
    pub(crate) fn long(&self) -> [Point; 2] {
        match *self {
            Self::Rectangle { half_mm: [a, b], .. } if a >= b => [[a, 0.0], [a - b, 0.0]],
            Self::Rectangle { half_mm: [a, b], .. } => [[0.0, b], [0.0, b - a]],
            Self::Circle { radius_mm } => [[radius_mm, 0.0], [0.0, 0.0]],
        }
    }

    /// Where the way around begins: the end of the first axis.
    pub(crate) fn begin(&self) -> Point {
        match *self {
            Self::Rectangle { half_mm, .. } => [half_mm[0], 0.0],
            Self::Circle { radius_mm } => [radius_mm, 0.0],
        }
    }

    /// Once around from where it begins; the tool is there already.
    pub(crate) fn around(&self, center: Point, height: f64, ccw: bool, strokes: &mut Vec<Stroke>) {
        let at = |p: Point| {
            let p = self.place(center, p);
            [p[0], p[1], height]
        };
        let arc = |to: Point, about: Point| {
            let center = self.place(center, about);
            Stroke::Arc { to: at(to), center, ccw, plunges: false }
        };
        let (a, b, c) = match *self {
            Self::Circle { radius_mm: r } => {
                strokes.extend([arc([-r, 0.0], [0.0; 2]), arc([r, 0.0], [0.0; 2])]);
                return;
            }
            Self::Rectangle { half_mm, corner_mm, .. } => (half_mm[0], half_mm[1], corner_mm),
        };
        let sign = if ccw { 1.0 } else { -1.0 };
        // Corners counter-clockwise from the right upper one: where each begins, ends, and its centre.
        let corners = [
            ([a, b - c], [a - c, b], [a - c, b - c]),
            ([c - a, b], [-a, b - c], [c - a, b - c]),
            ([-a, c - b], [c - a, -b], [c - a, c - b]),
            ([a - c, -b], [a, c - b], [a - c, c - b]),
        ];
        let mut place = [a, 0.0];
        let mut line = |to: Point, strokes: &mut Vec<Stroke>| {
            let to = [to[0], sign * to[1]];
            if (to[0] - place[0]).hypot(to[1] - place[1]) > 1e-9 {
                strokes.push(Stroke::Line(at(to)));
            }
            place = to;
        };
        for (begin, end, about) in corners {
            line(begin, strokes);
            if c > 1e-9 {
                strokes.push(arc([end[0], sign * end[1]], [about[0], sign * about[1]]));
                line(end, &mut Vec::new());
            }
        }
        line([a, 0.0], strokes);
    }

    /// Circles that touch the outline where the way around begins: from inside with a quarter to it and a
    /// quarter away, or from outside with a half circle each, which begins and ends at the same point.
    pub(crate) fn leads(
        &self,
        center: Point,
        radius_mm: f64,
        inside: bool,
        ccw: bool,
    ) -> [Lead; 2] {
        let begin = self.begin();
        let sign = if ccw { 1.0 } else { -1.0 };
        let place = |p: Point| self.place(center, p);
        let touch = place(begin);
        if inside {
            let middle = [begin[0] - radius_mm, 0.0];
            let [from, to] = [-sign, sign].map(|s| place(along(middle, [0.0, s], radius_mm)));
            let center = place(middle);
            return [
                Lead { begin: from, end: touch, center, ccw },
                Lead { begin: touch, end: to, center, ccw },
            ];
        }
        let (center, far) =
            (place([begin[0] + radius_mm, 0.0]), place([begin[0] + 2.0 * radius_mm, 0.0]));
        [
            Lead { begin: far, end: touch, center, ccw: !ccw },
            Lead { begin: touch, end: far, center, ccw: !ccw },
        ]
    }
}
