//! Lines and arcs with both of their ends as they were written.

use std::f64::consts::TAU;

use trueaxis_contour::plane::{Point, cross, dot, length, minus};

/// Points that are less apart are one point, mm.
pub(super) const SAME_MM: f64 = 1e-9;

/// A line or an arc of a profile.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stretch {
    /// Its start. Unit: mm.
    pub from: Point,
    /// Its end. Unit: mm.
    pub to: Point,
    /// Centre and sense (counter-clockwise) of an arc; a line has none. Unit: mm.
    pub arc: Option<(Point, bool)>,
}

impl Stretch {
    /// A line.
    pub fn line(from: Point, to: Point) -> Self {
        Self { from, to, arc: None }
    }

    /// Whether it leads nowhere: a full circle counts as such.
    pub fn is_empty(&self) -> bool {
        length(minus(self.to, self.from)) < SAME_MM
    }

    /// The angle that an arc sweeps, positive counter-clockwise. Unit: rad.
    pub(super) fn sweep(&self) -> f64 {
        let Some((center, ccw)) = self.arc else { return 0.0 };
        self.turned(self.to, center, ccw) * if ccw { 1.0 } else { -1.0 }
    }

    /// By how much an arc has turned in its own sense where it comes to a point, from 0 to a full turn.
    fn turned(&self, p: Point, center: Point, ccw: bool) -> f64 {
        let (a, b) = (minus(self.from, center), minus(p, center));
        let angle = cross(a, b).atan2(dot(a, b)) * if ccw { 1.0 } else { -1.0 };
        // What lies before the start by rounding is the start.
        if angle < -1e-12 { angle + TAU } else { angle.max(0.0) }
    }

    pub(super) fn radius(&self) -> f64 {
        self.arc.map_or(0.0, |(center, _)| length(minus(self.from, center)))
    }

    /// A range of the first coordinate that holds it.
    pub(super) fn span(&self) -> [f64; 2] {
        let (mut low, mut high) = (self.from[0].min(self.to[0]), self.from[0].max(self.to[0]));
        if let Some((center, _)) = self.arc {
            (low, high) = (low.min(center[0] - self.radius()), high.max(center[0] + self.radius()));
        }
        [low, high]
    }

    /// By how much the radius of an arc differs at its end, mm.
    pub(super) fn ends_apart(&self) -> f64 {
        self.arc.map_or(0.0, |(c, _)| (length(minus(self.to, c)) - self.radius()).abs())
    }

    /// The unit tangent at a point of it.
    fn tangent(&self, p: Point) -> Point {
        let along = match self.arc {
            None => minus(self.to, self.from),
            Some((center, ccw)) => {
                let r = minus(p, center);
                if ccw { [-r[1], r[0]] } else { [r[1], -r[0]] }
            }
        };
        let l = length(along);
        if l > 0.0 { [along[0] / l, along[1] / l] } else { [0.0; 2] }
    }

    pub(super) fn tangent_at_start(&self) -> Point {
        self.tangent(self.from)
    }

    pub(super) fn tangent_at_end(&self) -> Point {
        self.tangent(self.to)
    }

    /// The point after half of it.
    pub(super) fn middle(&self) -> Point {
        match self.arc {
            None => [0, 1].map(|i| f64::midpoint(self.from[i], self.to[i])),
            Some((center, _)) => {
                let (sin, cos) = (self.sweep() / 2.0).sin_cos();
                let r = minus(self.from, center);
                [center[0] + cos * r[0] - sin * r[1], center[1] + sin * r[0] + cos * r[1]]
            }
        }
    }

    /// The part of it that lies before a point on it, 0 to 1.
    pub(super) fn part(&self, p: Point) -> f64 {
        match self.arc {
            None => {
                let d = minus(self.to, self.from);
                dot(minus(p, self.from), d) / dot(d, d)
            }
            Some((center, ccw)) => {
                let sweep = self.sweep().abs();
                let turned = self.turned(p, center, ccw);
                // Just before the start, by rounding, is no full turn.
                let turned = if (TAU - turned) * self.radius() < 1e-7 { 0.0 } else { turned };
                turned / sweep
            }
        }
    }

    /// Whether an arc goes through the point of its circle in a direction, farther than a tolerance from its ends.
    pub(super) fn passes(&self, direction: Point, tolerance: f64) -> Option<Point> {
        let (center, _) = self.arc?;
        let r = self.radius();
        let top = [center[0] + r * direction[0], center[1] + r * direction[1]];
        let part = self.part(top);
        let far = |end: Point| {
            let out = minus(end, center);
            cross(out, direction).abs() > tolerance || dot(out, direction) < 0.0
        };
        let inside = part > 0.0 && part < 1.0 && far(self.from) && far(self.to);
        inside.then_some(top)
    }

    pub(super) fn until(&self, p: Point) -> Self {
        Self { to: p, ..*self }
    }

    pub(super) fn after(&self, p: Point) -> Self {
        Self { from: p, ..*self }
    }

    /// Where a stretch whose second coordinate only rises or only falls has a height.
    pub(super) fn at_height(&self, height: f64) -> Point {
        let [from, to] = [self.from[1], self.to[1]];
        let Some((center, _)) = self.arc else {
            let part =
                if from == to { 1.0 } else { ((height - from) / (to - from)).clamp(0.0, 1.0) };
            return [self.from[0] + part * (self.to[0] - self.from[0]), height];
        };
        let rise = height - center[1];
        let aside = (self.radius().powi(2) - rise * rise).max(0.0).sqrt();
        let right = self.middle()[0] >= center[0];
        [center[0] + if right { aside } else { -aside }, height]
    }

    /// Where it meets another one, on both of them.
    pub(super) fn meet(&self, other: &Self) -> Vec<Point> {
        let found = self.extended_to(other);
        found.into_iter().flatten().filter(|p| self.holds(*p) && other.holds(*p)).collect()
    }

    /// Where its line or circle meets that of another one.
    pub(super) fn extended_to(&self, other: &Self) -> [Option<Point>; 2] {
        match (self.arc, other.arc) {
            (None, None) => lines(self, other),
            (None, Some((c, _))) => line_circle(self, c, other.radius()),
            (Some((c, _)), None) => line_circle(other, c, self.radius()),
            (Some((a, _)), Some((b, _))) => circles(a, self.radius(), b, other.radius()),
        }
    }

    /// Whether a point of its line or circle lies between its ends.
    fn holds(&self, p: Point) -> bool {
        let near = |end: Point| length(minus(p, end)) < 1e-7;
        near(self.from) || near(self.to) || (0.0..=1.0).contains(&self.part(p))
    }

    /// How far a point is from it, mm.
    pub(super) fn distance(&self, p: Point) -> f64 {
        let ends = length(minus(p, self.from)).min(length(minus(p, self.to)));
        let foot = match self.arc {
            None => {
                let (t, d) = (self.tangent(self.from), minus(p, self.from));
                let along = dot(d, t);
                [self.from[0] + along * t[0], self.from[1] + along * t[1]]
            }
            Some((center, _)) => {
                let out = minus(p, center);
                let l = length(out);
                if l == 0.0 {
                    return self.radius();
                }
                let k = self.radius() / l;
                [center[0] + k * out[0], center[1] + k * out[1]]
            }
        };
        if self.holds(foot) { ends.min(length(minus(p, foot))) } else { ends }
    }
}

fn lines(a: &Stretch, b: &Stretch) -> [Option<Point>; 2] {
    let (d, e) = (minus(a.to, a.from), minus(b.to, b.from));
    let turn = cross(d, e);
    if turn.abs() < 1e-12 * length(d) * length(e) {
        return [None; 2];
    }
    let part = cross(minus(b.from, a.from), e) / turn;
    [Some([a.from[0] + part * d[0], a.from[1] + part * d[1]]), None]
}

fn line_circle(line: &Stretch, center: Point, radius: f64) -> [Option<Point>; 2] {
    let t = line.tangent(line.from);
    let along = dot(minus(center, line.from), t);
    let foot = [line.from[0] + along * t[0], line.from[1] + along * t[1]];
    let half = half_chord(radius, length(minus(foot, center)));
    half.map_or([None; 2], |h| [-h, h].map(|h| Some([foot[0] + h * t[0], foot[1] + h * t[1]])))
}

fn circles(a: Point, r: f64, b: Point, s: f64) -> [Option<Point>; 2] {
    let d = minus(b, a);
    let apart = length(d);
    if apart < SAME_MM {
        return [None; 2];
    }
    let e = [d[0] / apart, d[1] / apart];
    // From |p − a|² = r² and |p − b|² = s².
    let x = (apart * apart + r * r - s * s) / (2.0 * apart);
    half_chord(r, x).map_or([None; 2], |h| {
        [-h, h].map(|h| Some([a[0] + x * e[0] - h * e[1], a[1] + x * e[1] + h * e[0]]))
    })
}

/// Half of the chord of a circle at a distance from its centre, also where it just touches.
fn half_chord(radius: f64, distance: f64) -> Option<f64> {
    let square = radius * radius - distance * distance;
    (square > -1e-9 * radius * radius).then(|| square.max(0.0).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_arcs_meet_where_both_circles_go_through() {
        // 4² + 3² = 3² + 4² = 5², from (0, 0) and from (1, 7)
        let arc = |center: Point| Stretch {
            from: [center[0], center[1] - 5.0],
            to: [center[0], center[1] + 5.0],
            arc: Some((center, true)),
        };
        let mut found = arc([0.0, 0.0]).extended_to(&arc([1.0, 7.0])).map(Option::unwrap);
        found.sort_by(|a, b| a[0].total_cmp(&b[0]));
        assert!(length(minus(found[0], [-3.0, 4.0])) < 1e-12, "{found:?}");
        assert!(length(minus(found[1], [4.0, 3.0])) < 1e-12, "{found:?}");
    }
}
