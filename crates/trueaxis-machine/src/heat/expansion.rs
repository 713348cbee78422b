//! Thermal expansion of a body at a place: α times the integral of its temperature.

use crate::errors::{Curve, Extrapolation, Spline};

/// The temperature along a body, by straight lines between sensors and constant beyond them.
#[derive(Debug, Clone, PartialEq)]
pub struct Profile {
    places_mm: Vec<f64>,
    celsius: Vec<f64>,
}

impl Profile {
    /// From sensors in any order; of two at one place the mean counts. `None` without any.
    pub fn new(mut sensors: Vec<(f64, f64)>) -> Option<Self> {
        sensors.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut profile = Self { places_mm: Vec::new(), celsius: Vec::new() };
        for group in sensors.chunk_by(|a, b| a.0 == b.0) {
            profile.places_mm.push(group[0].0);
            profile.celsius.push(group.iter().map(|s| s.1).sum::<f64>() / group.len() as f64);
        }
        (!profile.places_mm.is_empty()).then_some(profile)
    }

    /// The one temperature, if it is the same everywhere.
    pub fn uniform(&self) -> Option<f64> {
        self.celsius.iter().all(|c| *c == self.celsius[0]).then_some(self.celsius[0])
    }

    /// The temperature at a place, °C.
    pub fn celsius_at(&self, s_mm: f64) -> f64 {
        let last = self.places_mm.len() - 1;
        let right = self.places_mm.partition_point(|p| *p <= s_mm);
        if right == 0 || right > last {
            return self.celsius[right.min(last)];
        }
        let (p0, p1) = (self.places_mm[right - 1], self.places_mm[right]);
        let (t0, t1) = (self.celsius[right - 1], self.celsius[right]);
        t0 + (t1 - t0) * (s_mm - p0) / (p1 - p0)
    }

    /// ∫ (T − T_ref) ds from one place to another, mm·K; the trapezoids are exact here.
    pub fn integral(&self, from_mm: f64, to_mm: f64, reference_celsius: f64) -> f64 {
        let inner = |p: &f64| {
            let (low, high) = (from_mm.min(to_mm), from_mm.max(to_mm));
            low < *p && *p < high
        };
        let mut stops = vec![from_mm];
        let between = self.places_mm.iter().copied().filter(inner);
        if from_mm <= to_mm {
            stops.extend(between);
        } else {
            stops.extend(between.rev());
        }
        stops.push(to_mm);
        let trapezoid = |w: &[f64]| {
            let mean = 0.5 * (self.celsius_at(w[0]) + self.celsius_at(w[1]));
            (mean - reference_celsius) * (w[1] - w[0])
        };
        stops.windows(2).map(trapezoid).sum()
    }
}

/// Where a positioning element is fixed, and at which temperature its error table holds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Anchor {
    /// f: where it does not move, mm.
    pub fixed_mm: f64,
    /// T_table, °C.
    pub table_celsius: f64,
}

/// The growth of a body as a curve of its axis.
///
/// ```text
///     E(q) = α ∫_f^q (T(s) − T_table) ds                                  docs/model.md eq. 81
/// ```
///
/// A uniform temperature gives a straight line, sensors along the body parabolas between them.
pub fn growth_curve(
    profile: &Profile,
    coefficient: f64,
    anchor: Anchor,
    reach: (f64, f64),
) -> Curve {
    let Anchor { fixed_mm, table_celsius } = anchor;
    if let Some(celsius) = profile.uniform() {
        let coefficients = vec![0.0, coefficient * (celsius - table_celsius)];
        return Curve::Polynomial { coefficients, origin: fixed_mm, scale: 1.0 };
    }
    let mut knots = profile.places_mm.clone();
    // A little beyond the travel, so that its ends lie inside.
    knots.extend([reach.0 - 1.0, reach.1 + 1.0]);
    knots.sort_by(f64::total_cmp);
    knots.dedup();
    let piece = |w: &[f64]| {
        let (t0, t1) = (profile.celsius_at(w[0]), profile.celsius_at(w[1]));
        let grown = profile.integral(fixed_mm, w[0], table_celsius);
        let slope = (t1 - t0) / (w[1] - w[0]);
        [grown, t0 - table_celsius, 0.5 * slope, 0.0].map(|c| coefficient * c)
    };
    let pieces = knots.windows(2).map(piece).collect();
    Curve::Table { spline: Spline::from_pieces(knots, pieces), outside: Extrapolation::Extend }
}

/// Pieces of a sampled curve per depth of the heat: the cubics stay within 2e-9 of depth · rise.
const PIECES_PER_DEPTH: f64 = 32.0;
/// ierfc is below 1e-17 from here, in depths.
const FURTHEST_DEPTHS: f64 = 6.0;

/// The growth of a body from its temperature and the exact integral of it, as cubics that have
/// value and slope at their ends in common with it.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a constant, 192")]
pub fn sampled_curve(
    rise_at: impl Fn(f64) -> f64,
    integral_to: impl Fn(f64) -> f64,
    coefficient: f64,
    places: &[f64],
    depth_mm: f64,
    reach: (f64, f64),
) -> Curve {
    let ends = (reach.0 - 1.0, reach.1 + 1.0);
    let mut knots = vec![ends.0, ends.1];
    for &place in places {
        let steps = (FURTHEST_DEPTHS * PIECES_PER_DEPTH) as usize;
        for i in 0..=steps {
            let away = i as f64 * depth_mm / PIECES_PER_DEPTH;
            knots.extend([place - away, place + away]);
        }
    }
    knots.retain(|k| (ends.0..=ends.1).contains(k));
    knots.sort_by(f64::total_cmp);
    // Knots from two places may almost meet; a cubic between them would have no digits.
    let closest = 1e-6 * depth_mm;
    knots.dedup_by(|b, a| *b - *a < closest);
    let values: Vec<[f64; 2]> =
        knots.iter().map(|k| [integral_to(*k), rise_at(*k)].map(|v| coefficient * v)).collect();
    let pieces = knots.windows(2).zip(values.windows(2)).map(|(k, v)| {
        let h = k[1] - k[0];
        let ([y0, s0], [y1, s1]) = (v[0], v[1]);
        let mean = (y1 - y0) / h;
        [y0, s0, (3.0 * mean - 2.0 * s0 - s1) / h, (s0 + s1 - 2.0 * mean) / (h * h)]
    });
    let pieces = pieces.collect();
    Curve::Table { spline: Spline::from_pieces(knots, pieces), outside: Extrapolation::Extend }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sensors_along_a_scale() {
        // 20 °C at 0, 30 °C at 1000 mm, 30 beyond: ∫(T − 20) = 5·1000 + 10·1000 = 15000 mm K
        let profile = Profile::new(vec![(1000.0, 30.0), (0.0, 20.0)]).unwrap();
        assert_eq!(profile.integral(0.0, 2000.0, 20.0), 15_000.0);
        assert_eq!(profile.integral(2000.0, 0.0, 20.0), -15_000.0);
        let anchor = Anchor { fixed_mm: 0.0, table_celsius: 20.0 };
        let curve = growth_curve(&profile, 1e-5, anchor, (0.0, 2000.0));
        for (q, mm) in [(0.0, 0.0), (500.0, 0.0125), (2000.0, 0.15), (3000.0, 0.25)] {
            assert!((curve.at(q).unwrap() - mm).abs() < 1e-15);
        }
    }
}
