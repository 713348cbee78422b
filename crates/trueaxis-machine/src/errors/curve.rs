//! Errors as functions of the position of their axis.

use super::Spline;

/// The value of an error table outside its first and last position; a periodic one repeats.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Extrapolation {
    /// No value: the command is an error.
    Error,
    /// The value at the end.
    Clamp,
    /// The straight line along the slope at the end.
    Extend,
}

/// A command lies outside an error table that has no value there.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error("position {at} lies outside the error table, which covers {from} .. {to}")]
pub struct OutsideTable {
    /// The command. Unit: mm or rad.
    pub at: f64,
    /// The first position of the table. Unit: mm or rad.
    pub from: f64,
    /// The last position of the table. Unit: mm or rad.
    pub to: f64,
}

/// An error as a function of the programmed position q (mm or rad); its value is in mm or rad.
#[derive(Debug, Clone, PartialEq)]
pub enum Curve {
    /// The same everywhere.
    Constant(f64),
    /// `Σ cₖ ((q − origin)/scale)ᵏ`
    Polynomial {
        /// c₀, c₁, … in mm or rad.
        coefficients: Vec<f64>,
        /// Where the argument is zero, mm or rad.
        origin: f64,
        /// Where the argument is one above the origin, mm or rad; not zero.
        scale: f64,
    },
    /// `mean + Σ a cos kq + b sin kq`, for rotary axes.
    Fourier {
        /// The mean over a turn.
        mean: f64,
        /// The harmonics.
        terms: Vec<Harmonic>,
    },
    /// Interpolated between measured positions.
    Table {
        /// The interpolant.
        spline: Spline,
        /// What holds beyond its ends.
        outside: Extrapolation,
    },
}

/// One harmonic of a Fourier series.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Harmonic {
    /// Periods per turn. Unit: 1.
    pub order: f64,
    /// Amplitude of cos kq. Unit: mm or rad.
    pub cosine: f64,
    /// Amplitude of sin kq. Unit: mm or rad.
    pub sine: f64,
}

impl Curve {
    /// The curve of `factor · E(q) + add`.
    pub(crate) fn changed(&self, factor: f64, add: f64) -> Self {
        match self {
            Self::Constant(value) => Self::Constant(factor * value + add),
            Self::Polynomial { coefficients, origin, scale } => {
                let mut coefficients: Vec<f64> = coefficients.iter().map(|c| factor * c).collect();
                match coefficients.first_mut() {
                    Some(constant) => *constant += add,
                    None => coefficients.push(add),
                }
                Self::Polynomial { coefficients, origin: *origin, scale: *scale }
            }
            Self::Fourier { mean, terms } => {
                let times = |h: &Harmonic| Harmonic {
                    cosine: factor * h.cosine,
                    sine: factor * h.sine,
                    ..*h
                };
                Self::Fourier {
                    mean: factor * mean + add,
                    terms: terms.iter().map(times).collect(),
                }
            }
            Self::Table { spline, outside } => {
                Self::Table { spline: spline.changed(factor, add), outside: *outside }
            }
        }
    }

    /// The error at a programmed position.
    ///
    /// # Errors
    /// A position that a table with [`Extrapolation::Error`] does not cover.
    ///
    /// # Example
    /// ```
    /// use trueaxis_machine::errors::Curve;
    /// // EXX = 12 µm · q/100 mm − 5 µm · (q/100 mm)²; at 200 mm: 24 − 20 = 4 µm
    /// let exx = Curve::Polynomial { coefficients: vec![0.0, 0.012, -0.005], origin: 0.0, scale: 100.0 };
    /// assert!((exx.at(200.0)? - 0.004).abs() < 1e-15);
    /// # Ok::<(), trueaxis_machine::errors::OutsideTable>(())
    /// ```
    pub fn at(&self, q: f64) -> Result<f64, OutsideTable> {
        Ok(match self {
            Self::Constant(value) => *value,
            Self::Polynomial { coefficients, origin, scale } => {
                let x = (q - origin) / scale;
                coefficients.iter().rev().fold(0.0, |sum, c| sum * x + c)
            }
            Self::Fourier { mean, terms } => terms.iter().fold(*mean, |sum, t| {
                let (sin, cos) = (t.order * q).sin_cos();
                sum + t.cosine * cos + t.sine * sin
            }),
            Self::Table { spline, outside } => return table_at(spline, *outside, q),
        })
    }
}

fn table_at(spline: &Spline, outside: Extrapolation, q: f64) -> Result<f64, OutsideTable> {
    if spline.is_periodic() {
        return Ok(spline.at(q));
    }
    let (from, to) = spline.range();
    // Numbers of a file are rounded (±105° as 1.832595714 rad): the same slack as for a travel.
    let slack = 1e-9 * from.abs().max(to.abs()).max(1.0);
    let inside = q.clamp(from, to);
    if (q - inside).abs() <= slack {
        return Ok(spline.at(inside));
    }
    match outside {
        Extrapolation::Error => Err(OutsideTable { at: q, from, to }),
        Extrapolation::Clamp => Ok(spline.at(inside)),
        Extrapolation::Extend => Ok(spline.at(inside) + spline.slope_at(inside) * (q - inside)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::errors::Interpolation;
    use std::f64::consts::TAU;

    #[test]
    fn a_periodic_table_repeats_turn_after_turn() {
        let x: Vec<f64> = (0..=12).map(|i| TAU * f64::from(i) / 12.0).collect();
        let y: Vec<f64> = (0..=12).map(|i| f64::from(i % 12)).collect();
        let spline = Spline::new(&x, &y, Interpolation::Periodic).expect("a closed table");
        let table = Curve::Table { spline, outside: Extrapolation::Error };
        let at = |degrees: f64| table.at(degrees.to_radians()).expect("everywhere");
        for turn in [-720.0, -360.0, 360.0, 1080.0] {
            assert!((at(30.0 + turn) - 1.0).abs() < 1e-12);
            assert!((at(97.0 + turn) - at(97.0)).abs() < 1e-12);
        }
    }

    #[test]
    fn a_changed_curve_is_the_factor_times_it_and_more() {
        let line = Spline::new(&[0.0, 2.0, 5.0], &[1.0, 3.0, -1.0], Interpolation::Linear);
        let harmonic = Harmonic { order: 2.0, cosine: 0.5, sine: -1.0 };
        let curves = [
            Curve::Constant(3.0),
            Curve::Polynomial { coefficients: vec![1.0, 2.0, -1.0], origin: 1.0, scale: 3.0 },
            Curve::Fourier { mean: 0.2, terms: vec![harmonic] },
            Curve::Table { spline: line.expect("a table"), outside: Extrapolation::Error },
        ];
        for curve in curves {
            for q in [0.0, 0.7, 2.0, 4.9] {
                let (old, new) = (curve.at(q), curve.changed(-2.0, 0.25).at(q));
                let expected = -2.0 * old.expect("inside") + 0.25;
                assert!((new.expect("inside") - expected).abs() < 1e-14, "{curve:?} at {q}");
            }
        }
    }
}
