//! What a study varies, and what that does to a machine.

use crate::distribution::Distribution;
use std::sync::Arc;
use trueaxis::machine::Machine;
use trueaxis::machine::axis::{AxisKind, Travel};
use trueaxis::machine::errors::{
    BodyName, Curve, ErrorKind, ErrorName, Harmonic, Influence, StatedError,
};
use trueaxis::machine::heat::TemperatureLog;

/// How often an input is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Level {
    /// Once for each machine, which keeps it.
    Machine,
    /// Again on each day of each machine.
    Day,
    /// Again on each day, the same for all machines: they stand in one hall.
    Hall,
}

impl Level {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Machine, Self::Day, Self::Hall];

    /// In one word, as in study files.
    pub fn word(self) -> &'static str {
        match self {
            Self::Machine => "machine",
            Self::Day => "day",
            Self::Hall => "hall",
        }
    }
}

/// What an input varies.
#[derive(Debug, Clone, PartialEq)]
pub enum Varied {
    /// The value of location errors, instead of that of the machine file.
    Value(Vec<ErrorName>),
    /// What is added to errors.
    Added(Vec<ErrorName>),
    /// A factor of errors, their reversal among them.
    Scale(Vec<ErrorName>),
    /// One term of a random curve along the axis of an error.
    Curve {
        /// Of which error.
        error: ErrorName,
        /// Which term.
        term: Term,
        /// Its root mean square along the axis. Unit: mm or rad.
        u: f64,
    },
    /// An uncertain quantity of the machine file: its factor, in standard uncertainties.
    Stated(String),
    /// What sensors say, °C.
    Temperatures(Vec<String>),
    /// The time of a log whose temperatures hold, s.
    Log(Arc<TemperatureLog>),
    /// Where the workpiece stands along an axis of its base, beside where the study mounts it, mm.
    Workpiece(usize),
    /// Where a rotary axis stands while the part zero is touched, rad.
    Setting(BodyName),
    /// The length of the tool, mm.
    ToolLength,
}

/// A term of a random curve: all of them have a root mean square of 1, and the mean of the product of two is 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Term {
    /// The polynomial of Legendre of this degree, over the travel of a linear axis.
    Legendre(usize),
    /// The cosine of this many waves a turn.
    Cosine(usize),
    /// The sine of this many waves a turn.
    Sine(usize),
}

/// One number that a study draws.
#[derive(Debug, Clone, PartialEq)]
pub struct Input {
    /// Its name.
    pub name: String,
    /// The inputs whose effect is found together; its own name unless the study says another.
    pub group: String,
    /// How often it is drawn.
    pub level: Level,
    /// What it varies.
    pub varied: Varied,
    /// How it is distributed.
    pub distribution: Distribution,
}

impl Input {
    /// The factor of its influence for a drawn value. Unit: 1.
    pub fn factor(&self, value: f64) -> f64 {
        match self.varied {
            Varied::Value(_) | Varied::Added(_) | Varied::Scale(_) => {
                let u = self.distribution.u();
                if u > 0.0 { (value - self.distribution.mean()) / u } else { 0.0 }
            }
            _ => value,
        }
    }

    /// Whether commands or temperatures depend on it, so that more than errors change.
    pub fn changes_state(&self) -> bool {
        matches!(
            self.varied,
            Varied::Temperatures(_)
                | Varied::Log(_)
                | Varied::Workpiece(_)
                | Varied::Setting(_)
                | Varied::ToolLength
        )
    }

    /// Puts its mean into the machine, and returns what a standard uncertainty of it adds; none if it is no error.
    ///
    /// # Errors
    /// In words: an error that the machine does not have, or does not state.
    pub fn put(&self, machine: Machine) -> Result<(Machine, Option<Influence>), String> {
        let (mean, u) = (self.distribution.mean(), self.distribution.u());
        let mut machine = machine;
        let mut effects = Vec::new();
        match &self.varied {
            Varied::Value(errors) => {
                for name in errors {
                    let index = index_of(&machine, *name)?;
                    machine = machine.with_error(index, Some(StatedError::constant(mean, None)));
                    effects.push((index, Curve::Constant(u)));
                }
            }
            Varied::Added(errors) => {
                for name in errors {
                    let index = index_of(&machine, *name)?;
                    let stated = stated(&machine, *name);
                    let stated = stated.unwrap_or_else(|| StatedError::constant(0.0, None));
                    machine = machine.with_error(index, Some(stated.changed(1.0, mean)));
                    effects.push((index, Curve::Constant(u)));
                }
            }
            Varied::Scale(errors) => {
                for name in errors {
                    let index = index_of(&machine, *name)?;
                    let Some(stated) = stated(&machine, *name) else {
                        return Err(format!(
                            "the machine states no {name} that a factor could change"
                        ));
                    };
                    machine = machine.with_error(index, Some(stated.changed(mean, 0.0)));
                    effects.push((index, stated.changed(u, 0.0).mean));
                }
            }
            Varied::Curve { error, term, u } => {
                let index = index_of(&machine, *error)?;
                effects.push((index, term.curve(travel_of(&machine, *error)?, *u)));
            }
            _ => return Ok((machine, None)),
        }
        let influence = Influence { name: influence_name(&self.name), effects };
        Ok((machine, Some(influence)))
    }
}

/// The name of an input among the quantities of a machine; no error has such a name.
pub fn influence_name(input: &str) -> String {
    format!("study: {input}")
}

impl Term {
    /// The terms of a random curve of an error with their shares of its variance, which fall with the fourth power of
    /// the degree, as those of a smooth curve do: docs/model.md eq. 341.
    ///
    /// A straightness begins at the second degree: its straight line is the squareness, a location error. Others begin
    /// at the first.
    pub fn of(
        machine: &Machine,
        error: ErrorName,
        count: usize,
    ) -> Result<Vec<(Self, f64)>, String> {
        let Some(axis) = machine.axis_index(error.body).map(|i| &machine.axes()[i]) else {
            return Err(format!("the machine has no axis of {error}"));
        };
        if error.kind != ErrorKind::Motion {
            return Err(format!("{error} is a location error, which is no curve"));
        }
        let orders = |first: usize| {
            let share = move |k: usize| (k as f64).powi(-4);
            let sum: f64 = (first..first + count).map(share).sum();
            (first..first + count).map(move |k| (k, share(k) / sum))
        };
        Ok(match axis.kind {
            AxisKind::Rotary => {
                orders(1).flat_map(|(k, s)| [(Self::Cosine(k), s), (Self::Sine(k), s)]).collect()
            }
            AxisKind::Linear => {
                let along = error.component.letter()
                    == error.body.to_string().chars().next().unwrap_or(' ');
                let is_straightness = !error.component.is_rotation() && !along;
                let first = if is_straightness { 2 } else { 1 };
                orders(first).map(|(k, s)| (Self::Legendre(k), s)).collect()
            }
        })
    }

    fn curve(self, travel: (f64, f64), u: f64) -> Curve {
        let wave = |order: usize, cosine: f64, sine: f64| Curve::Fourier {
            mean: 0.0,
            terms: vec![Harmonic { order: order as f64, cosine, sine }],
        };
        match self {
            Self::Cosine(order) => wave(order, u, 0.0),
            Self::Sine(order) => wave(order, 0.0, u),
            Self::Legendre(degree) => {
                let size = u * (2.0 * degree as f64 + 1.0).sqrt();
                let coefficients = legendre(degree).into_iter().map(|c| c * size).collect();
                let (from, to) = travel;
                Curve::Polynomial {
                    coefficients,
                    origin: 0.5 * (from + to),
                    scale: 0.5 * (to - from),
                }
            }
        }
    }
}

/// The coefficients of the polynomial of Legendre, from the constant on: (k + 1) Pₖ₊₁ = (2k + 1) x Pₖ − k Pₖ₋₁.
fn legendre(degree: usize) -> Vec<f64> {
    let (mut before, mut last) = (vec![1.0], vec![0.0, 1.0]);
    if degree == 0 {
        return before;
    }
    for k in 1..degree {
        let k = k as f64;
        let mut next = vec![0.0; last.len() + 1];
        for (i, c) in last.iter().enumerate() {
            next[i + 1] += (2.0 * k + 1.0) * c / (k + 1.0);
        }
        for (i, c) in before.iter().enumerate() {
            next[i] -= k * c / (k + 1.0);
        }
        (before, last) = (last, next);
    }
    last
}

fn index_of(
    machine: &Machine,
    name: ErrorName,
) -> Result<trueaxis::machine::errors::ErrorIndex, String> {
    let missing = || format!("the chain {} has no body for {name}", machine.chain_text());
    machine.error_index(name).ok_or_else(missing)
}

fn stated(machine: &Machine, name: ErrorName) -> Option<StatedError> {
    let index = machine.error_index(name)?;
    machine.bodies()[index.body].stated(name.kind, name.component).cloned()
}

/// The ends between which a curve of the axis of an error runs; of a rotary axis they do not matter.
fn travel_of(machine: &Machine, error: ErrorName) -> Result<(f64, f64), String> {
    let axis = machine.axis_index(error.body).map(|i| &machine.axes()[i]);
    match axis.map(|a| (a.kind, a.travel)) {
        Some((AxisKind::Rotary, _)) => Ok((0.0, 1.0)),
        Some((AxisKind::Linear, Travel::Between(from, to))) => Ok((from, to)),
        _ => Err(format!("the machine file states no travel of the axis of {error}")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// P₂ = (3x² − 1)/2, P₃ = (5x³ − 3x)/2, P₄ = (35x⁴ − 30x² + 3)/8: Abramowitz and Stegun, table 22.9.
    #[test]
    fn polynomials_of_legendre() {
        assert_eq!(legendre(2), [-0.5, 0.0, 1.5]);
        assert_eq!(legendre(3), [0.0, -1.5, 0.0, 2.5]);
        let fourth = legendre(4);
        for (found, expected) in fourth.iter().zip([0.375, 0.0, -3.75, 0.0, 4.375]) {
            assert!((found - expected).abs() < 1e-15);
        }
    }

    /// The root mean square of a term along its axis is its u; different terms are orthogonal.
    #[test]
    fn terms_of_a_curve_are_orthogonal() {
        let (from, to) = (100.0, 700.0);
        let n = 20_000;
        let mean = |f: &dyn Fn(f64) -> f64| {
            (0..n).map(|i| f(from + (f64::from(i) + 0.5) * (to - from) / f64::from(n))).sum::<f64>()
                / f64::from(n)
        };
        let curve = |k: usize| Term::Legendre(k).curve((from, to), 0.003);
        for a in 1..6 {
            let own = curve(a);
            for b in 0..=a {
                let other = curve(b);
                let product = mean(&|q| own.at(q).unwrap() * other.at(q).unwrap());
                let expected = if a == b { 9e-6 } else { 0.0 };
                assert!((product - expected).abs() < 1e-11, "{a} {b}: {product}");
            }
        }
    }
}
