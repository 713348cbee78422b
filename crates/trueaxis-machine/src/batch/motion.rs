//! The error motions of one axis, compiled.

use super::pieces::{Knots, Row, cubic, is_piecewise_cubic, span};
use crate::axis::{Axis, AxisKind, Travel};
use crate::chain::ChainBody;
use crate::errors::{Component, Curve, ErrorKind};

/// Error motions may turn by so much; the sine and cosine of larger ones need more terms.
///
/// `sin a − (a − a³/6 + a⁵/120)` and `cos a − (1 − a²/2 + a⁴/24)` stay below 6e-18 rad: less than
/// 1e-12 mm on any machine shorter than 100 m.
pub const LARGEST_TURN_RAD: f64 = 4e-3;

/// Arguments of sine and cosine go through the kernel up to here; its three-part π/2 has digits
/// for ten times more.
const LARGEST_ARGUMENT_RAD: f64 = 1e5;

/// Positions from `from` to `to`, mm or rad; empty if `from > to`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Range {
    pub(super) from: f64,
    pub(super) to: f64,
}

impl Range {
    pub(super) const EMPTY: Self = Self { from: f64::INFINITY, to: f64::NEG_INFINITY };

    pub(super) fn within(self, from: f64, to: f64) -> Self {
        Self { from: self.from.max(from), to: self.to.min(to) }
    }

    /// Where the commands of a body's axis have sines in the kernel and values in every table.
    pub(super) fn of(body: &ChainBody, axis: &Axis) -> Self {
        let largest = match axis.kind {
            AxisKind::Linear => 1e9,
            AxisKind::Rotary => 1e4,
        };
        let mut range = Self { from: -largest, to: largest };
        for curve in curves(body).map(|part| part.curve) {
            if let Some((from, to)) = span(curve, axis) {
                range = range.within(from, to);
            }
            if let Curve::Fourier { terms, .. } = curve {
                let order = terms.iter().fold(1.0_f64, |m, t| m.max(t.order.abs()));
                let largest = LARGEST_ARGUMENT_RAD / order;
                range = range.within(-largest, largest);
            }
        }
        range
    }
}

/// One stated curve of an axis.
struct Part<'a> {
    component: usize,
    curve: &'a Curve,
    /// Counts half, with the sign of the approach.
    is_reversal: bool,
}

fn curves(body: &ChainBody) -> impl Iterator<Item = Part<'_>> {
    let thermal = body.thermal.iter().filter(|t| t.kind == ErrorKind::Motion);
    let thermal = thermal.map(|t| Part {
        component: t.component as usize,
        curve: &t.curve,
        is_reversal: false,
    });
    let stated = body.motion.iter().enumerate().flat_map(|(component, stated)| {
        let part = move |is_reversal| move |curve| Part { component, curve, is_reversal };
        let mean = stated.iter().map(|s| &s.mean).map(part(false));
        let reversal = stated.iter().filter_map(|s| s.reversal.as_ref()).map(part(true));
        mean.chain(reversal)
    });
    stated.chain(thermal)
}

/// A curve that is not a cubic between knots.
#[derive(Debug, Clone)]
pub(super) struct General {
    pub(super) component: usize,
    pub(super) is_reversal: bool,
    pub(super) curve: GeneralCurve,
}

#[derive(Debug, Clone)]
pub(super) enum GeneralCurve {
    /// `Σ cₖ ((q − origin)·per_unit)ᵏ`, falling powers.
    Polynomial { falling: Vec<f64>, origin: f64, per_unit: f64 },
    /// `mean + Σ a cos kq + b sin kq`; order, a, b.
    Fourier { mean: f64, terms: Vec<[f64; 3]> },
}

impl General {
    fn of(part: &Part<'_>) -> Option<Self> {
        let curve = match part.curve {
            Curve::Polynomial { coefficients, origin, scale } => GeneralCurve::Polynomial {
                falling: coefficients.iter().rev().copied().collect(),
                origin: *origin,
                per_unit: 1.0 / scale,
            },
            Curve::Fourier { mean, terms } => GeneralCurve::Fourier {
                mean: *mean,
                terms: terms.iter().map(|t| [t.order, t.cosine, t.sine]).collect(),
            },
            Curve::Constant(_) | Curve::Table { .. } => return None,
        };
        Some(Self { component: part.component, is_reversal: part.is_reversal, curve })
    }

    fn bound(&self, range: Range) -> f64 {
        let value = match &self.curve {
            GeneralCurve::Polynomial { falling, origin, per_unit } => {
                let x = (range.from - origin).abs().max((range.to - origin).abs()) * per_unit.abs();
                falling.iter().fold(0.0, |sum, c| sum * x + c.abs())
            }
            GeneralCurve::Fourier { mean, terms } => {
                let amplitude = |[_, cosine, sine]: &[f64; 3]| cosine.hypot(*sine);
                mean.abs() + terms.iter().map(amplitude).sum::<f64>()
            }
        };
        if self.is_reversal { 0.5 * value } else { value }
    }
}

/// The six error motions of an axis.
#[derive(Debug, Clone)]
pub(super) struct Motion {
    pub(super) axis: usize,
    pub(super) knots: Knots,
    /// Once, or three times (falling, not known, rising) if the approach matters.
    pub(super) rows: Vec<Row>,
    /// How many rows one approach has.
    pub(super) rows_per_approach: usize,
    pub(super) general: Vec<General>,
    /// Whether it ever turns.
    pub(super) turns: bool,
}

impl Motion {
    /// The motions of a body and the range where they turn by little enough; `None` if they are
    /// zero everywhere.
    pub(super) fn of(
        body: &ChainBody,
        axis: &Axis,
        index: usize,
        range: Range,
    ) -> Option<(Self, Range)> {
        let (cubics, others): (Vec<_>, Vec<_>) = curves(body)
            .filter(|part| *part.curve != Curve::Constant(0.0))
            .partition(|part| is_piecewise_cubic(part.curve));
        if cubics.is_empty() && others.is_empty() {
            return None;
        }
        let knots = Knots::union(&cubics.iter().map(|part| part.curve).collect::<Vec<_>>(), axis);
        let signs: &[f64] = if cubics.iter().chain(&others).any(|part| part.is_reversal) {
            &[-1.0, 0.0, 1.0]
        } else {
            &[0.0]
        };
        let rows: Vec<Row> = signs.iter().flat_map(|&sign| rows(&cubics, &knots, sign)).collect();
        let turns = cubics.iter().chain(&others).any(|part| part.component >= 3);
        let motion = Self {
            axis: index,
            rows_per_approach: rows.len() / signs.len(),
            rows,
            knots,
            general: others.iter().filter_map(General::of).collect(),
            turns,
        };
        let range = motion.narrowed(range, axis);
        Some((motion, range))
    }

    /// Whether the direction of approach matters.
    pub(super) fn has_reversal(&self) -> bool {
        self.rows.len() > self.rows_per_approach
    }

    /// The widest of some ranges on which no error motion turns by more than the series allow.
    fn narrowed(&self, widest: Range, axis: &Axis) -> Range {
        // Positions far beyond the travel or the tables are rare; the bound is cheap, so go there in steps.
        let ends = self.knots.ends();
        let (first, last) = (ends[0].1, ends[ends.len() - 1].0);
        let core = match (first <= last, axis.travel) {
            (true, _) => (first, last),
            (false, Travel::Between(from, to)) => (from, to),
            (false, _) => (0.0, 0.0),
        };
        let core = widest.within(core.0, core.1);
        let mut range = widest;
        for _ in 0..60 {
            if self.largest_turn(range) <= LARGEST_TURN_RAD {
                return range;
            }
            range.from = 0.5 * (range.from + core.from);
            range.to = 0.5 * (range.to + core.to);
        }
        if self.largest_turn(core) <= LARGEST_TURN_RAD { core } else { Range::EMPTY }
    }

    /// A bound of the angles of the error motions on a range.
    pub(super) fn largest_turn(&self, range: Range) -> f64 {
        let (ends, about) = (self.knots.ends(), self.knots.about());
        let turns = Component::ALL.into_iter().filter(|c| c.is_rotation()).map(|c| c as usize);
        let bound = |component: usize| {
            let general = self.general.iter().filter(|g| g.component == component);
            let general: f64 = general.map(|g| g.bound(range)).sum();
            let of_row = |(i, row): (usize, &Row)| {
                let k = i % self.rows_per_approach;
                let part = range.within(ends[k].0, ends[k].1);
                let h = (part.from - about[k]).abs().max((part.to - about[k]).abs());
                if part.from > part.to { 0.0 } else { row.bound(component, h) }
            };
            self.rows.iter().enumerate().map(of_row).fold(0.0, f64::max) + general
        };
        turns.map(bound).fold(0.0, f64::max)
    }
}

fn rows(parts: &[Part<'_>], knots: &Knots, sign: f64) -> Vec<Row> {
    let row = |(ends, about): ((f64, f64), f64)| {
        let mut row = Row::ZERO;
        for part in parts {
            let factor = if part.is_reversal { 0.5 * sign } else { 1.0 };
            row.add(part.component, cubic(part.curve, ends, about).map(|c| c * factor));
        }
        row
    };
    knots.ends().into_iter().zip(knots.about()).map(row).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_value_of_a_polynomial_is_beyond_its_bound() {
        // ((2 · 5 + 1) · 5 + ½) at x = −5, 50 from the origin
        let curve =
            GeneralCurve::Polynomial { falling: vec![2.0, -1.0, 0.5], origin: 10.0, per_unit: 0.1 };
        let general = General { component: 0, is_reversal: false, curve };
        let range = Range { from: -40.0, to: 30.0 };
        assert_eq!(general.bound(range), 55.5);
        let value = |q: f64| ((q - 10.0) * 0.1).powi(2) * 2.0 - (q - 10.0) * 0.1 + 0.5;
        assert_eq!(value(-40.0), 55.5);
        assert!((0..=70).all(|k| value(f64::from(k) - 40.0).abs() <= 55.5));
        assert_eq!(General { is_reversal: true, ..general }.bound(range), 27.75);
    }
}
