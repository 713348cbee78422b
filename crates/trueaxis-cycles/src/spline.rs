//! Rational B-splines in the plane, and biarcs through them.
//!
//! # Source
//! L. Piegl, W. Tiller, "The NURBS Book", 2nd edition, equations (2.5) and (4.1); biarcs with equal tangents: K. M.
//! Bolton, "Biarc curves", Computer-Aided Design 7 (1975) 89–92.

use trueaxis_contour::plane::{Point, along, cross, dot, length, minus};

/// Pieces of one curve: more than any program means.
const MOST_PIECES: usize = 1_000_000;

/// A rational B-spline with a clamped uniform knot vector: its knots are whole numbers from 0, the first and
/// the last as often as the order.
#[derive(Debug, Clone, PartialEq)]
pub struct Nurbs {
    points: Vec<[f64; 3]>,
    order: usize,
}

/// A line or an arc of a curve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Piece {
    /// A line to a place, mm.
    Line(Point),
    /// An arc.
    Arc {
        /// Its end, mm.
        to: Point,
        /// Its centre, mm.
        center: Point,
        /// Counter-clockwise.
        ccw: bool,
    },
}

impl Piece {
    /// Its end, mm.
    pub fn end(&self) -> Point {
        match *self {
            Self::Line(to) | Self::Arc { to, .. } => to,
        }
    }
}

impl Nurbs {
    /// A curve of control points (mm) with weights; `None` with fewer points than the order, an order below 2 or
    /// weights that are not above 0.
    pub fn new(points: &[(Point, f64)], order: usize) -> Option<Self> {
        let sound = |(p, w): &(Point, f64)| *w > 0.0 && (w + p[0] + p[1]).is_finite();
        if order < 2 || points.len() < order || !points.iter().all(sound) {
            return None;
        }
        let points = points.iter().map(|(p, w)| [p[0] * w, p[1] * w, *w]).collect();
        Some(Self { points, order })
    }

    /// The number of spans, which is the end of the parameter; it begins at 0.
    pub fn spans(&self) -> usize {
        self.points.len() - self.order + 1
    }

    /// The number of control points.
    pub fn count(&self) -> usize {
        self.points.len()
    }

    fn knot(&self, index: usize) -> f64 {
        (index + 1).saturating_sub(self.order).min(self.spans()) as f64
    }

    /// The point in homogeneous coordinates and its derivative, by de Boor's scheme, equation (2.5) written as
    /// repeated interpolation.
    fn homogeneous(&self, u: f64) -> ([f64; 3], [f64; 3]) {
        let spans = self.spans();
        let u = u.clamp(0.0, spans as f64);
        let degree = self.order - 1;
        let span = (u.floor() as usize).min(spans - 1);
        let mut d = self.points[span..=span + degree].to_vec();
        let mut slope = [0.0; 3];
        for level in 1..=degree {
            if level == degree {
                // The last two points give the derivative.
                let (from, to) = (self.knot(span + degree), self.knot(span + degree + 1));
                slope = std::array::from_fn(|i| degree as f64 * (d[1][i] - d[0][i]) / (to - from));
            }
            for j in 0..=degree - level {
                let (from, to) = (self.knot(span + j + level), self.knot(span + j + degree + 1));
                let share = (u - from) / (to - from);
                d[j] = std::array::from_fn(|i| (1.0 - share) * d[j][i] + share * d[j + 1][i]);
            }
        }
        (d[0], slope)
    }

    /// The point at a parameter, mm.
    pub fn point(&self, u: f64) -> Point {
        let (p, _) = self.homogeneous(u);
        [p[0] / p[2], p[1] / p[2]]
    }

    /// The derivative at a parameter, by the quotient rule.
    pub fn tangent(&self, u: f64) -> Point {
        let (p, s) = self.homogeneous(u);
        [0, 1].map(|i| (s[i] * p[2] - p[i] * s[2]) / (p[2] * p[2]))
    }

    /// The direction at a parameter; where the derivative is zero, that towards a parameter nearby.
    fn direction(&self, u: f64, inside: f64) -> Option<Point> {
        let way = minus(self.point(inside), self.point(u));
        let slope = self.tangent(u);
        if length(slope) > 1e-6 * (length(way) / (inside - u).abs()) {
            return Some(unit(slope));
        }
        let way = minus(self.point(u + 1e-4 * (inside - u)), self.point(u));
        let sign = if inside > u { 1.0 } else { -1.0 };
        (length(way) > 0.0).then(|| unit(way).map(|c| sign * c))
    }

    /// Pieces through `count` points at equal steps of the parameter, two arcs between neighbours; `None` if
    /// they are too many.
    pub fn biarcs(&self, count: usize) -> Option<Vec<Piece>> {
        if count > MOST_PIECES {
            return None;
        }
        let at = |i: usize| self.spans() as f64 * i as f64 / count as f64;
        let mut pieces = Vec::new();
        for i in 0..count {
            let (u, v) = (at(i), at(i + 1));
            let ends = [self.point(u), self.point(v)];
            match [self.direction(u, v), self.direction(v, u)] {
                [Some(begin), Some(end)] => pieces.extend(biarc(ends, [begin, end])),
                _ => pieces.push(Piece::Line(ends[1])),
            }
        }
        Some(pieces)
    }
}

fn unit(a: Point) -> Point {
    a.map(|c| c / length(a))
}

/// Two arcs between two points that leave and arrive in given directions (unit vectors) and meet without a
/// corner; their tangents at the ends are as long as each other. A line where there are none.
///
/// With the chord v and the directions s and e the tangents have the length d of
/// v·v − 2 d v·(s + e) − 2 d² (1 − s·e) = 0.
pub fn biarc([from, to]: [Point; 2], [begin, end]: [Point; 2]) -> Vec<Piece> {
    let v = minus(to, from);
    let chord = length(v);
    let sum = dot(v, begin) + dot(v, end);
    let bend = 2.0 * (1.0 - dot(begin, end));
    let tangent = if bend < 1e-12 {
        chord * chord / (2.0 * sum)
    } else {
        ((sum * sum + bend * chord * chord).sqrt() - sum) / bend
    };
    // Lengths of many chords belong to directions that the points contradict.
    if !(tangent > 0.0 && tangent < 100.0 * chord) {
        return vec![Piece::Line(to)];
    }
    let (first, second) = (along(from, begin, tangent), along(to, end, -tangent));
    let middle = [0, 1].map(|i| f64::midpoint(first[i], second[i]));
    vec![arc([from, middle], begin), arc([middle, to], minus(second, first))]
}

/// The arc that leaves a point in a direction and ends at another; a line where it is straight to 1e-6 mm.
fn arc([from, to]: [Point; 2], direction: Point) -> Piece {
    let (d, t) = (minus(to, from), unit(direction));
    let across = cross(t, d);
    let square = dot(d, d);
    // The sagitta is a quarter of the chord times the sine of its angle to the tangent, nearly.
    if across.abs() < 4e-6 && dot(t, d) > 0.0 || square == 0.0 || !across.is_finite() {
        return Piece::Line(to);
    }
    let radius = square / (2.0 * across);
    let center = along(from, [-t[1], t[0]], radius);
    Piece::Arc { to, center, ccw: radius > 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn close(a: Point, b: Point) {
        assert!(length(minus(a, b)) < 1e-12, "{a:?} {b:?}");
    }

    /// Three points of order 3 are Bézier's parabola: C(u) = (1−u)² P0 + 2 u (1−u) P1 + u² P2.
    #[test]
    fn three_points_of_order_three_are_a_parabola() {
        let curve =
            Nurbs::new(&[([-2.0, 4.0], 1.0), ([0.0, -4.0], 1.0), ([2.0, 4.0], 1.0)], 3).unwrap();
        for i in 0..=10 {
            let x = -2.0 + 0.4 * f64::from(i);
            close(curve.point(f64::from(i) / 10.0), [x, x * x]);
            // dx/du = 4, dy/du = 2 x · 4.
            close(curve.tangent(f64::from(i) / 10.0), [4.0, 8.0 * x]);
        }
    }

    /// A quarter of a circle: three points with the middle weight cos 45° (The NURBS Book, section 7.3).
    #[test]
    fn a_weight_makes_a_circle() {
        let w = 0.5_f64.sqrt();
        let points = [([10.0, 0.0], 1.0), ([10.0, 10.0], w), ([0.0, 10.0], 1.0)];
        let curve = Nurbs::new(&points, 3).unwrap();
        for piece in curve.biarcs(12).unwrap() {
            let Piece::Arc { center, ccw, to } = piece else { panic!("{piece:?}") };
            close(center, [0.0, 0.0]);
            assert!(ccw && (length(to) - 10.0).abs() < 1e-12);
        }
    }

    /// Two half circles, and a straight line.
    #[test]
    fn biarcs_between_parallel_directions() {
        let [a, b] = biarc([[0.0, 0.0], [4.0, 4.0]], [[0.0, 1.0], [0.0, 1.0]])[..] else {
            panic!()
        };
        close(a.end(), [2.0, 2.0]);
        let Piece::Arc { center, ccw: true, .. } = b else { panic!("{b:?}") };
        close(center, [2.0, 4.0]);
        assert_eq!(
            biarc([[0.0, 0.0], [4.0, 0.0]], [[1.0, 0.0]; 2]),
            [Piece::Line([2.0, 0.0]), Piece::Line([4.0, 0.0])]
        );
    }

    #[test]
    fn too_few_points_or_no_weight() {
        assert_eq!(Nurbs::new(&[([0.0, 0.0], 1.0), ([1.0, 0.0], 1.0)], 3), None);
        assert_eq!(Nurbs::new(&[([0.0, 0.0], 1.0), ([1.0, 0.0], 0.0)], 2), None);
    }
}
