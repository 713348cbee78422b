//! Curves as cubics on the union of their knots.

use crate::axis::{Axis, AxisKind, Travel};
use crate::errors::{Curve, Extrapolation, Spline};
use std::f64::consts::TAU;

/// Cells of the lookup of an uneven row of knots, at most.
const MOST_CELLS: usize = 4096;

/// Knots of a periodic table with its repetitions, at most.
const MOST_KNOTS: usize = 4096;

/// The six errors of an axis between two knots: `((c₃·h + c₂)·h + c₁)·h + c₀`, the powers from c₃
/// down, each with its six errors and two unused places. Four cache lines.
#[derive(Debug, Clone, Copy, PartialEq)]
#[repr(align(64))]
pub(super) struct Row(pub(super) [f64; 32]);

impl Row {
    pub(super) const ZERO: Self = Self([0.0; 32]);

    /// Adds a cubic, given by rising powers.
    pub(super) fn add(&mut self, component: usize, cubic: [f64; 4]) {
        for (power, c) in cubic.into_iter().enumerate() {
            self.0[8 * (3 - power) + component] += c;
        }
    }

    /// A bound of an error for `|h|` up to `h`.
    pub(super) fn bound(&self, component: usize, h: f64) -> f64 {
        (0..4).fold(0.0, |sum, falling| sum * h + self.0[8 * falling + component].abs())
    }
}

/// Which row holds at a position. Row 0 lies below the first knot, the last one above the last.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Knots {
    /// Even steps: row k is written about `first + k·step`.
    Even { first: f64, step: f64, per_step: f64, last_row: f64 },
    /// Any steps: row k is written about `about[k]`.
    Uneven(Lookup),
}

/// Finds the knots about a position by even cells and a correction.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Lookup {
    knots: Vec<f64>,
    pub(super) about: Vec<f64>,
    per_cell: f64,
    /// The row at the lower end of each cell.
    rows: Vec<u32>,
}

impl Lookup {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "positive, and limited by the number of cells"
    )]
    fn new(knots: Vec<f64>) -> Self {
        let (from, to) = (knots[0], knots[knots.len() - 1]);
        let narrowest = knots.windows(2).map(|w| w[1] - w[0]).fold(f64::INFINITY, f64::min);
        let cells = (((to - from) / narrowest).ceil() as usize).clamp(1, MOST_CELLS);
        let width = (to - from) / cells as f64;
        let row = |cell: usize| knots.partition_point(|&k| k <= from + width * cell as f64) as u32;
        let rows = (0..cells).map(row).collect();
        let mut about = vec![from];
        about.extend(&knots);
        Self { knots, about, per_cell: 1.0 / width, rows }
    }

    /// The row at a position; any row for NaN.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "positive, and limited by the number of cells"
    )]
    pub(super) fn row(&self, q: f64) -> usize {
        if q < self.knots[0] {
            return 0;
        }
        // A cast of NaN or of a negative number gives 0.
        let cell = ((q - self.knots[0]) * self.per_cell) as usize;
        let mut row = self.rows[cell.min(self.rows.len() - 1)] as usize;
        while row < self.knots.len() && q >= self.knots[row] {
            row += 1;
        }
        row
    }
}

impl Knots {
    /// The union of the knots of some curves; periodic tables repeat as far as the axis reaches.
    pub(super) fn union(curves: &[&Curve], axis: &Axis) -> Self {
        let mut knots: Vec<f64> = curves.iter().flat_map(|c| knots_of(c, axis)).collect();
        knots.sort_by(f64::total_cmp);
        let largest = knots.iter().fold(0.0_f64, |m, k| m.max(k.abs()));
        // The same position in two tables may differ by rounding.
        knots.dedup_by(|b, a| *b - *a <= 1e-14 * largest);
        let intervals = knots.len().saturating_sub(1);
        if intervals == 0 {
            // Without tables one row holds everywhere.
            return Self::Even { first: 0.0, step: 0.0, per_step: 0.0, last_row: 0.0 };
        }
        let step = (knots[intervals] - knots[0]) / intervals as f64;
        let even = |(i, k): (usize, &f64)| (k - (knots[0] + step * i as f64)).abs() <= 1e-12 * step;
        if knots.iter().enumerate().all(even) {
            let last_row = (intervals + 1) as f64;
            return Self::Even { first: knots[0] - step, step, per_step: 1.0 / step, last_row };
        }
        Self::Uneven(Lookup::new(knots))
    }

    /// Where the powers of each row are counted from.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "the number of rows, which was a whole number"
    )]
    pub(super) fn about(&self) -> Vec<f64> {
        match self {
            Self::Even { first, step, last_row, .. } => {
                (0..=*last_row as usize).map(|row| (row as f64).mul_add(*step, *first)).collect()
            }
            Self::Uneven(lookup) => lookup.about.clone(),
        }
    }

    /// The ends of each row, −∞ and ∞ included.
    pub(super) fn ends(&self) -> Vec<(f64, f64)> {
        // The first row is not written about its lower end; the others are.
        let about = self.about();
        let mut inner = match self {
            Self::Even { .. } => about[1..].to_vec(),
            Self::Uneven(lookup) => lookup.knots.clone(),
        };
        inner.insert(0, f64::NEG_INFINITY);
        inner.push(f64::INFINITY);
        inner.windows(2).map(|w| (w[0], w[1])).collect()
    }
}

fn knots_of(curve: &Curve, axis: &Axis) -> Vec<f64> {
    let Curve::Table { spline, .. } = curve else { return Vec::new() };
    let (from, to) = spline.range();
    let (below, above) = periods(spline, axis);
    let period = |turn: i32| spline.knots().iter().map(move |k| k + f64::from(turn) * (to - from));
    (-below..=above).flat_map(period).collect()
}

/// How many periods below and above a table its axis reaches.
#[expect(clippy::cast_possible_truncation, reason = "limited by the number of knots")]
fn periods(spline: &Spline, axis: &Axis) -> (i32, i32) {
    if !spline.is_periodic() {
        return (0, 0);
    }
    let (low, high) = match (axis.travel, axis.kind) {
        (Travel::Between(low, high), _) => (low, high),
        (_, AxisKind::Linear) => (-1e3, 1e3),
        (_, AxisKind::Rotary) => (-2.0 * TAU, 2.0 * TAU),
    };
    let (from, to) = spline.range();
    let most = (MOST_KNOTS / spline.knots().len()) as f64;
    let periods = |distance: f64| (distance / (to - from)).ceil().clamp(0.0, most) as i32;
    (periods(from - low), periods(high - to))
}

/// Where the cubics of a table hold; `None` if everywhere.
///
/// Beyond the ends of an extended table the scalar path has a step of its own (its slack).
pub(super) fn span(curve: &Curve, axis: &Axis) -> Option<(f64, f64)> {
    let Curve::Table { spline, outside } = curve else { return None };
    let (from, to) = spline.range();
    if spline.is_periodic() {
        let (below, above) = periods(spline, axis);
        let period = to - from;
        return Some((from - f64::from(below) * period, to + f64::from(above) * period));
    }
    (*outside != Extrapolation::Clamp).then_some((from, to))
}

/// Whether a curve is a cubic between its knots.
pub(super) fn is_piecewise_cubic(curve: &Curve) -> bool {
    match curve {
        Curve::Constant(_) | Curve::Table { .. } => true,
        Curve::Polynomial { coefficients, .. } => coefficients.len() <= 4,
        Curve::Fourier { .. } => false,
    }
}

/// The cubic of a piecewise cubic curve between two ends, by rising powers of `q − about`.
pub(super) fn cubic(curve: &Curve, ends: (f64, f64), about: f64) -> [f64; 4] {
    match curve {
        Curve::Constant(value) => [*value, 0.0, 0.0, 0.0],
        Curve::Polynomial { coefficients, origin, scale } => {
            let mut cubic = [0.0; 4];
            let mut power = 1.0;
            for (out, c) in cubic.iter_mut().zip(coefficients) {
                *out = c / power;
                power *= scale;
            }
            moved(cubic, about - origin)
        }
        Curve::Table { spline, .. } => table_cubic(spline, ends, about),
        Curve::Fourier { .. } => [0.0; 4],
    }
}

fn table_cubic(spline: &Spline, ends: (f64, f64), about: f64) -> [f64; 4] {
    let (from, to) = spline.range();
    let middle = 0.5 * (ends.0 + ends.1);
    let first = if spline.is_periodic() && middle.is_finite() {
        ((middle - from) / (to - from)).floor() * (to - from)
    } else {
        0.0
    };
    let (middle, about) = (middle - first, about - first);
    let end = middle.clamp(from, to);
    if end != middle {
        return [spline.at(end), 0.0, 0.0, 0.0];
    }
    let knots = spline.knots();
    let piece = knots.partition_point(|&k| k <= middle).clamp(1, knots.len() - 1) - 1;
    moved(spline.pieces()[piece], about - knots[piece])
}

/// The same cubic about a point further by `by`.
fn moved([c0, c1, c2, c3]: [f64; 4], by: f64) -> [f64; 4] {
    [
        ((c3 * by + c2) * by + c1) * by + c0,
        (3.0 * c3 * by + 2.0 * c2) * by + c1,
        3.0 * c3 * by + c2,
        c3,
    ]
}
