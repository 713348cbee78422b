//! The same move for the clock: lines and arcs by their formulas, other curves sampled as finely as
//! they bend, whatever the pieces that are drawn.

use super::{AxisPath, PathStep};
use crate::curve::Curve;
use crate::timing::{Element, Part, Parts, Tangent, Turn};
use trueaxis_geometry::Vec3;
use trueaxis_machine::axis::{Command, MAX_AXES};

/// At first a sampled curve has a cell for so many rad of the rotary axes and of a circle.
const CELL_RAD: f64 = 0.2;
const MOST_CELLS: f64 = 4096.0;
/// A cell is halved so often at most: near a pole an axis may jump however small the cell.
const MOST_HALVINGS: u32 = 8;
/// Differences below this part of a position are rounding.
const ROUNDING: f64 = 2e-12;

/// Axis positions at four u of a move one after the other, the first near others; `None` where one cannot be reached.
type Course<'a> = dyn FnMut([f64; 4], &Command) -> Option<[Command; 4]> + 'a;

impl AxisPath<'_> {
    /// From here on moves are handed out for the clock too, each before its nodes.
    #[must_use]
    pub fn with_elements(mut self) -> Self {
        self.has_elements = true;
        self
    }

    pub(super) fn announce(
        &self,
        length: f64,
        element: impl FnOnce() -> Option<Element>,
        out: &mut dyn FnMut(PathStep),
    ) {
        if self.has_elements
            && length > 0.0
            && length.is_finite()
            && let Some(element) = element().filter(moves)
        {
            out(PathStep::Element { element: Box::new(element), length });
        }
    }

    /// The way of the axes along a curve while rotary axes stand or go evenly. `to_axes` leads from
    /// vectors of the program frame to the linear axes.
    pub(super) fn element_of_axes(
        curve: &Curve,
        [begin, end]: [&Command; 2],
        length: f64,
        to_axes: impl Fn(Vec3) -> Command,
    ) -> Element {
        let Curve::Helix { axis, arm, radius_change, sweep, rise, .. } = *curve else {
            return Element::straight(begin, end, length);
        };
        let along = to_axes(axis * rise);
        let radius = arm.norm();
        // The linear axes: along the axis of the helix. The others: evenly.
        let linear = [Vec3::x(), Vec3::y(), Vec3::z()].map(&to_axes);
        let steady = std::array::from_fn(|i| match linear.iter().any(|v| v[i] != 0.0) {
            true => along[i] / length,
            false => (end[i] - begin[i]) / length,
        });
        let turn = Turn {
            length,
            rate: sweep / length,
            cos: to_axes(arm),
            sin: to_axes(axis.cross(&arm)),
            steady,
            growth: if radius > 0.0 { radius_change / radius / length } else { 0.0 },
        };
        turn.element()
    }
}

fn moves(element: &Element) -> bool {
    let any = |values: &Command| values.iter().any(|x| *x != 0.0);
    any(&element.begin.slope) || !element.parts.is_empty()
}

/// A curve without a formula: its derivatives by differences in cells, each so small that the
/// polynomial of five points is the curve.
pub(super) fn sampled(
    begin: &Command,
    length: f64,
    turned_rad: f64,
    course: &mut Course<'_>,
) -> Option<Element> {
    let cells = (turned_rad / CELL_RAD).ceil().clamp(1.0, MOST_CELLS);
    let mut sampler =
        Sampler { length, course, parts: Parts::new(), ends: [Tangent::default(); 2] };
    let mut at = *begin;
    for k in 0..cells as u32 {
        let [from, to] = [k, k + 1].map(|k| f64::from(k) / cells);
        at = sampler.cell([from, to], &at, 0)?;
    }
    let [begin, end] = sampler.ends;
    Some(Element { begin, end, parts: sampler.parts })
}

struct Sampler<'a, 'b> {
    length: f64,
    course: &'a mut Course<'b>,
    parts: Parts,
    ends: [Tangent; 2],
}

impl Sampler<'_, '_> {
    /// From u0 to u1; returns the axes there.
    fn cell(&mut self, [u0, u1]: [f64; 2], begin: &Command, halvings: u32) -> Option<Command> {
        let quarter = 0.25 * (u1 - u0);
        let u = [u0 + quarter, u0 + 2.0 * quarter, u0 + 3.0 * quarter, u1];
        let [one, two, three, four] = (self.course)(u, begin)?;
        let points = [*begin, one, two, three, four];
        if halvings < MOST_HALVINGS && is_coarse(&points) {
            let middle = 0.5 * (u0 + u1);
            let there = self.cell([u0, middle], begin, halvings + 1)?;
            return self.cell([middle, u1], &there, halvings + 1);
        }
        let length = self.length * (u1 - u0);
        let (part, ends) = part(&points, length);
        if self.parts.is_empty() {
            self.ends[0] = ends[0];
        }
        self.ends[1] = ends[1];
        self.parts.push(part);
        Some(points[4])
    }
}

/// Between two of five points a derivative may be a little larger than at them.
const BETWEEN: f64 = 1.02;

// What follows goes through the axes in its innermost loops: they are computed side by side.

/// Five equal differences: of second and third order, and that of fourth order, which is too large
/// where the polynomial of the points may not be the curve.
fn is_coarse(points: &[Command; 5]) -> bool {
    let mut is_coarse = false;
    for i in 0..MAX_AXES {
        let q = points.map(|q| q[i]);
        let first = (q[4] - q[0]).abs();
        let second = (q[4] - 2.0 * q[2] + q[0]).abs();
        let third = (q[4] - 2.0 * q[3] + 2.0 * q[1] - q[0]).abs();
        let fourth = (q[4] - 4.0 * q[3] + 6.0 * q[2] - 4.0 * q[1] + q[0]).abs();
        is_coarse |= fourth > 1e-3 * (second + third) + 1e-5 * first + 1e-8 * (1.0 + q[0].abs());
    }
    is_coarse
}

/// The part of the curve through five points, and the tangents at its ends.
fn part(points: &[Command; 5], length: f64) -> (Part, [Tangent; 2]) {
    let h = 0.25 * length;
    let [slope, mut bend, mut twist] = derivatives(points);
    let [one, two, three] = [1.0 / (12.0 * h), 1.0 / (12.0 * h * h), 0.5 / (h * h * h)];
    without_rounding(&mut twist, 0.5, &points[0]);
    without_rounding(&mut bend, 1.0 / 12.0, &points[0]);
    let part = Part {
        length,
        steady: [0.0; MAX_AXES],
        slope: slope.most.map(|x| x * one * BETWEEN),
        bend: bend.most.map(|x| x * two * BETWEEN),
        twist: twist.most.map(|x| x * three * BETWEEN),
        circular: false,
    };
    let tangent = |k: usize| Tangent {
        slope: slope.ends[k].map(|x| x * one),
        bend: bend.ends[k].map(|x| x * two),
    };
    (part, [tangent(0), tangent(1)])
}

/// A derivative at five points, but for a factor.
struct Derivative {
    /// At the first point and at the last.
    ends: [Command; 2],
    /// The largest magnitude of each axis at all of them.
    most: Command,
}

/// First three derivatives of the polynomial of fourth degree through five points at a distance h: 12 h, 12 h² and 2 h³
/// times them.
fn derivatives(points: &[Command; 5]) -> [Derivative; 3] {
    let [p, q, r, s, t] = points;
    let row = |[a, b, c, d, e]: [f64; 5]| {
        let mut row = Command::default();
        for i in 0..MAX_AXES {
            row[i] = a * p[i] + b * q[i] + c * r[i] + d * s[i] + e * t[i];
        }
        row
    };
    let derivative = |rows: [Command; 5]| {
        let mut most = Command::default();
        for row in &rows {
            for i in 0..MAX_AXES {
                most[i] = most[i].max(row[i].abs());
            }
        }
        Derivative { ends: [rows[0], rows[4]], most }
    };
    [
        derivative([
            row([-25.0, 48.0, -36.0, 16.0, -3.0]),
            row([-3.0, -10.0, 18.0, -6.0, 1.0]),
            row([1.0, -8.0, 0.0, 8.0, -1.0]),
            row([-1.0, 6.0, -18.0, 10.0, 3.0]),
            row([3.0, -16.0, 36.0, -48.0, 25.0]),
        ]),
        derivative([
            row([35.0, -104.0, 114.0, -56.0, 11.0]),
            row([11.0, -20.0, 6.0, 4.0, -1.0]),
            row([-1.0, 16.0, -30.0, 16.0, -1.0]),
            row([-1.0, 4.0, 6.0, -20.0, 11.0]),
            row([11.0, -56.0, 114.0, -104.0, 35.0]),
        ]),
        derivative([
            row([-5.0, 18.0, -24.0, 14.0, -3.0]),
            row([-3.0, 10.0, -12.0, 6.0, -1.0]),
            row([-1.0, 2.0, 0.0, -2.0, 1.0]),
            row([1.0, -6.0, 12.0, -10.0, 3.0]),
            row([3.0, -14.0, 24.0, -18.0, 5.0]),
        ]),
    ]
}

/// Derivatives of an axis that are rounding of its positions at all points are none; `scale` makes differences of them.
fn without_rounding(derivative: &mut Derivative, scale: f64, at: &Command) {
    for i in 0..MAX_AXES {
        if derivative.most[i] * scale < ROUNDING * (1.0 + at[i].abs()) {
            derivative.most[i] = 0.0;
            derivative.ends.iter_mut().for_each(|end| end[i] = 0.0);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// x⁴ at −2, −1, 0, 1, 2: 4x³, 12x², 24x.
    #[test]
    fn derivatives_of_a_fourth_power() {
        let points = [-2.0_f64, -1.0, 0.0, 1.0, 2.0].map(|x| [0.0, x.powi(4), x, 0.0, 0.0, 0.0]);
        let (part, [begin, end]) = part(&points, 4.0);
        let most = [part.slope, part.bend, part.twist].map(|row| row.map(|x| x / BETWEEN));
        assert_eq!((begin.slope[1], end.slope[1]), (-32.0, 32.0));
        assert_eq!((begin.bend[1], end.bend[1]), (48.0, 48.0));
        assert!((most[0][1] - 32.0).abs() < 1e-12 && (most[1][1] - 48.0).abs() < 1e-12);
        assert!((most[2][1] - 48.0).abs() < 1e-12);
        assert_eq!((begin.slope[2], begin.bend[2], most[2][2]), (1.0, 0.0, 0.0));
        // x³ − 4x: 3x² − 4, 6x, 6.
        let cubic = [-2.0_f64, -1.0, 0.0, 1.0, 2.0].map(|x| {
            let mut command = Command::default();
            command[3] = x * (x * x - 4.0);
            command
        });
        let (part, [begin, end]) = super::part(&cubic, 4.0);
        assert!((part.slope[3] / BETWEEN - 8.0).abs() < 1e-12 && begin.slope[3] == 8.0);
        assert!((part.bend[3] / BETWEEN - 12.0).abs() < 1e-12 && end.bend[3] == 12.0);
        assert!((part.twist[3] / BETWEEN - 6.0).abs() < 1e-12);
    }

    /// A quarter of a circle of radius 10: |q″| ≤ 1/10, |q‴| ≤ 1/100, and as fine whoever asks.
    #[test]
    fn a_sampled_circle_has_its_curvature() {
        let length = 5.0 * std::f64::consts::PI;
        let place = |u: f64| {
            let (sin, cos) = (u * length / 10.0).sin_cos();
            [10.0 * sin, 10.0 * (1.0 - cos), 0.0, 0.0, 0.0, 0.0]
        };
        let mut course = |u: [f64; 4], _: &Command| Some(u.map(place));
        let element = sampled(&[0.0; 6], length, 0.0, &mut course).unwrap();
        let most = |of: fn(&Part) -> f64| element.parts.iter().map(of).fold(0.0, f64::max);
        assert!((most(|p| p.bend[0]) / BETWEEN - 0.1).abs() < 1e-3);
        assert!((most(|p| p.twist[0]) / BETWEEN - 0.01).abs() < 1e-3);
        assert!((element.end.slope[1] - 1.0).abs() < 1e-5 && element.end.slope[0].abs() < 1e-5);
        let covered: f64 = element.parts.iter().map(|p| p.length).sum();
        assert!((covered - length).abs() < 1e-12);
    }
}
