//! Lines and arcs in a plane, the curves parallel to them, and where these meet.

use std::f64::consts::TAU;

use crate::plane::{Point, along, cross, dot, length, minus};

/// What rounding adds to the length of an element, relative to it.
pub(crate) const ROUNDING: f64 = 1e-9;

/// A line or an arc of a contour.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Element {
    /// From one point to another.
    Line {
        /// Its start, mm.
        from: Point,
        /// Its end, mm.
        to: Point,
    },
    /// About a centre.
    Arc {
        /// The centre, mm.
        center: Point,
        /// The radius, mm.
        radius_mm: f64,
        /// The direction from the centre to the start, rad.
        start_rad: f64,
        /// The angle that it sweeps, counter-clockwise positive, rad.
        sweep_rad: f64,
    },
}

impl Element {
    /// A line between two points.
    pub fn line(from: Point, to: Point) -> Self {
        Self::Line { from, to }
    }

    /// An arc between two points about a centre, with the number of turns begun (1 up to a full circle).
    pub fn arc(from: Point, to: Point, center: Point, ccw: bool, turns: u32) -> Self {
        let (out, end) = (minus(from, center), minus(to, center));
        let sign = if ccw { 1.0 } else { -1.0 };
        let mut sweep = (sign * cross(out, end).atan2(dot(out, end))).rem_euclid(TAU);
        if sweep < 1e-9 {
            sweep = TAU;
        }
        Self::Arc {
            center,
            radius_mm: length(out),
            start_rad: out[1].atan2(out[0]),
            sweep_rad: sign * (sweep + TAU * f64::from(turns.max(1) - 1)),
        }
    }

    /// The length, mm.
    pub fn length_mm(&self) -> f64 {
        match *self {
            Self::Line { from, to } => length(minus(to, from)),
            Self::Arc { radius_mm, sweep_rad, .. } => radius_mm * sweep_rad.abs(),
        }
    }

    /// The point after a part of its length, mm.
    pub fn point(&self, part: f64) -> Point {
        match *self {
            Self::Line { from, to } => along(from, minus(to, from), part),
            Self::Arc { center, radius_mm, start_rad, sweep_rad } => {
                let (sin, cos) = (start_rad + part * sweep_rad).sin_cos();
                along(center, [cos, sin], radius_mm)
            }
        }
    }

    /// The unit tangent in the direction of motion after a part of its length. Unit: 1.
    pub fn tangent(&self, part: f64) -> Point {
        match *self {
            Self::Line { from, to } => {
                let d = minus(to, from);
                let l = length(d);
                [d[0] / l, d[1] / l]
            }
            Self::Arc { start_rad, sweep_rad, .. } => {
                let (sin, cos) = (start_rad + part * sweep_rad).sin_cos();
                if sweep_rad > 0.0 { [-sin, cos] } else { [sin, -cos] }
            }
        }
    }

    /// The same element with the radius of one of its ends: those of a written arc differ by rounding.
    #[must_use]
    pub fn through(&self, end: Point) -> Self {
        match *self {
            Self::Arc { center, start_rad, sweep_rad, .. } => {
                Self::Arc { center, radius_mm: length(minus(end, center)), start_rad, sweep_rad }
            }
            line @ Self::Line { .. } => line,
        }
    }

    /// The part of the element between its end (or its start) and a point on it.
    pub(crate) fn cut_off(&self, p: Point, at_end: bool) -> f64 {
        match *self {
            Self::Line { .. } => {
                let (corner, sign) = (self.point(f64::from(u8::from(at_end))), at_end);
                let distance = dot(minus(p, corner), self.tangent(0.0));
                (if sign { -distance } else { distance }) / self.length_mm()
            }
            Self::Arc { center, start_rad, sweep_rad, .. } => {
                let here = minus(p, center);
                let corner = start_rad + if at_end { sweep_rad } else { 0.0 };
                let angle = here[1].atan2(here[0]) - corner;
                let sign = if at_end { -sweep_rad.signum() } else { sweep_rad.signum() };
                let turned = (sign * angle).rem_euclid(TAU);
                // What lies just before the corner by rounding is at the corner.
                (if turned > TAU - 1e-9 { turned - TAU } else { turned }) / sweep_rad.abs()
            }
        }
    }

    /// The same part, counted backwards where that is the shorter way round.
    pub(crate) fn shorter_way(&self, part: f64) -> f64 {
        match *self {
            Self::Line { .. } => part,
            Self::Arc { sweep_rad, .. } => {
                let round = TAU / sweep_rad.abs();
                if part > round / 2.0 { part - round } else { part }
            }
        }
    }

    /// The part of the element that ends (or begins) at a distance from the corner.
    pub(crate) fn part_at(&self, distance: f64) -> Option<f64> {
        let part = match *self {
            Self::Line { .. } => distance / self.length_mm(),
            Self::Arc { radius_mm, sweep_rad, .. } => {
                let half = distance / (2.0 * radius_mm);
                if half > 1.0 {
                    return None;
                }
                2.0 * half.asin() / sweep_rad.abs()
            }
        };
        (part <= 1.0 + ROUNDING).then_some(part.min(1.0))
    }

    /// The curve at a distance to the left (negative: to the right) of the element.
    pub(crate) fn parallel(&self, left: f64) -> Option<Curve> {
        match *self {
            Self::Line { from, .. } => {
                let t = self.tangent(0.0);
                Some(Curve::Line(along(from, [-t[1], t[0]], left), t))
            }
            Self::Arc { center, radius_mm, sweep_rad, .. } => {
                let radius = radius_mm - left * sweep_rad.signum();
                (radius > 0.0).then_some(Curve::Circle(center, radius))
            }
        }
    }

    /// Where a circle about a point touches the element, or the line or circle that it lies on.
    pub(crate) fn foot(&self, p: Point) -> Point {
        match *self {
            Self::Line { from, .. } => {
                let t = self.tangent(0.0);
                along(from, t, dot(minus(p, from), t))
            }
            Self::Arc { center, radius_mm, .. } => {
                let out = minus(p, center);
                along(center, out, radius_mm / length(out))
            }
        }
    }
}

/// What the centre of a rounding lies on.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Curve {
    Line(Point, Point),
    Circle(Point, f64),
}

impl Curve {
    pub(crate) fn meet(self, other: Self) -> Vec<Point> {
        match (self, other) {
            (Self::Line(p, t), Self::Line(q, u)) => {
                vec![along(p, t, cross(minus(q, p), u) / cross(t, u))]
            }
            (Self::Line(p, t), Self::Circle(c, r)) | (Self::Circle(c, r), Self::Line(p, t)) => {
                let foot = along(p, t, dot(minus(c, p), t));
                half_chord(r, length(minus(foot, c)))
                    .map_or(Vec::new(), |h| vec![along(foot, t, h), along(foot, t, -h)])
            }
            (Self::Circle(a, r), Self::Circle(b, s)) => {
                let d = minus(b, a);
                let distance = length(d);
                if distance == 0.0 {
                    return Vec::new();
                }
                let e = [d[0] / distance, d[1] / distance];
                // From |x − a|² = r² and |x − b|² = s².
                let x = (distance * distance + r * r - s * s) / (2.0 * distance);
                let foot = along(a, e, x);
                half_chord(r, x).map_or(Vec::new(), |h| {
                    vec![along(foot, [-e[1], e[0]], h), along(foot, [e[1], -e[0]], h)]
                })
            }
        }
    }
}

/// Half of the chord of a circle at a distance from its centre, also where it just touches.
fn half_chord(radius: f64, distance: f64) -> Option<f64> {
    let square = radius * radius - distance * distance;
    (square > -1e-9 * radius * radius).then(|| square.max(0.0).sqrt())
}
