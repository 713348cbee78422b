//! The angles of the rotary axes that point the tool in a wanted direction.
//!
//! ```text
//!     R(a, θ1) · R(b, θ2) · v = u
//! ```
//!
//! a and b are the rotary axes and v the tool axis with both angles at zero, all in the workpiece
//! frame. The second axis moves v on a circle about b, the first moves a point of it on a circle
//! about a to u. So w = R(b, θ2)·v is where two circles on the unit sphere meet: the corner of a
//! spherical triangle with the corners a and b and the sides α = ∠(a,u), β = ∠(b,v), γ = ∠(a,b).
//!
//! ```text
//!     s = (α + β + γ)/2
//!     tan²(φ/2) = sin(s−α)·sin(s−γ) / (sin s · sin(s−β))         φ at the corner a
//!     w = a cos α + (n×a) sin α cos φ ± n sin α sin φ            n = a×b / |a×b|
//! ```
//!
//! Half-angle form and sides from atan2 keep their digits at every pose, near the poles (α → 0, π)
//! and where the two branches meet (φ → 0, π). w lies on its circle about a by construction and on
//! the one about b to rounding, and both θ are read off the same w, so the tool points to u to
//! rounding even where the angles themselves are poorly determined.

use super::RESOLUTION_RAD;
use super::serial::Serial;
use crate::axis::Command;
use std::f64::consts::PI;
use trueaxis_geometry::Vec3;

/// Two directions count as parallel below this sine: no machine is built with such a rotary pair.
const PARALLEL: f64 = 1e-6;

/// A triangle is flat if one of its excesses is below this (rounding of its sides, in rad).
const FLAT_RAD: f64 = 4e-15;

/// A rotary axis that aims the tool.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Turn {
    pub axis: usize,
    /// In the workpiece frame, all aiming axes at zero.
    about: Vec3,
    pub sense: f64,
}

/// The rotary axes that aim the tool, at most two, in chain order; all others are held.
#[derive(Debug, Clone)]
pub(crate) struct DirectionSolver {
    pub turning: Vec<Turn>,
    /// The tool axis with all aiming axes at zero.
    tool_at_zero: Vec3,
    /// Of the first two.
    pub(super) pair: Option<Pair>,
}

/// Two rotary axes and the tool with both at zero: what of the triangle is the same for every
/// direction.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pair {
    pub a: Vec3,
    pub b: Vec3,
    pub v: Vec3,
    pub beta: f64,
    pub gamma: f64,
    pub n: Vec3,
    pub towards_b: Vec3,
}

/// The angles of one branch, right-handed about each axis; `None` keeps the axis where it is.
type Angles = [Option<f64>; 2];

/// The branches: two, or one where both meet.
pub(crate) struct AngleBranches {
    pub one: Angles,
    pub other: Option<Angles>,
    pub first_is_idle: bool,
}

impl AngleBranches {
    fn only(one: Angles) -> Self {
        Self { one, other: None, first_is_idle: false }
    }

    pub fn branches(&self) -> impl Iterator<Item = Angles> {
        [Some(self.one), self.other].into_iter().flatten()
    }
}

/// The direction cannot be reached.
pub(crate) struct UnreachableDirection {
    pub closest: Vec3,
    pub by_rad: f64,
}

impl DirectionSolver {
    /// The first two rotary axes of the chain that can aim, or the only one, or none.
    pub fn of(serial: &Serial, held: &Command) -> Self {
        let rotary: Vec<usize> = serial.rotary().collect();
        let pairs = rotary
            .iter()
            .enumerate()
            .flat_map(|(k, &i)| rotary[k + 1..].iter().map(move |&j| vec![i, j]));
        let singles = rotary.iter().map(|&i| vec![i]);
        pairs
            .chain(singles)
            .map(|axes| Self::with(serial, held, &axes))
            .find(Self::is_independent)
            .unwrap_or_else(|| Self::with(serial, held, &[]))
    }

    fn with(serial: &Serial, held: &Command, axes: &[usize]) -> Self {
        let mut command = *held;
        for &i in axes {
            command[i] = 0.0;
        }
        let frames = serial.frames(&command);
        let turn = |&axis: &usize| Turn {
            axis,
            about: serial.axis_in(&frames, axis).normalize(),
            sense: serial.joints[axis].sense,
        };
        let turning: Vec<Turn> = axes.iter().map(turn).collect();
        let tool_at_zero = frames.tool_axis();
        let pair = match turning[..] {
            [first, second, ..] => Some(Pair::of(first.about, second.about, tool_at_zero)),
            _ => None,
        };
        Self { turning, tool_at_zero, pair }
    }

    fn is_independent(&self) -> bool {
        let next = self.turning[1..].iter().map(|t| t.about).chain([self.tool_at_zero]);
        self.turning.iter().zip(next).all(|(t, next)| t.about.cross(&next).norm() > PARALLEL)
    }

    /// The angles that point the tool to the unit vector `u`.
    pub fn at(&self, u: Vec3) -> Result<AngleBranches, UnreachableDirection> {
        let v = self.tool_at_zero;
        if let Some(pair) = &self.pair {
            return pair.aim(u);
        }
        match self.turning[..] {
            [only, ..] => {
                let (alpha, beta) = (angle(only.about, u), angle(only.about, v));
                if (alpha - beta).abs() > RESOLUTION_RAD {
                    return Err(missed(only.about, u, v, alpha, beta));
                }
                Ok(AngleBranches::only([Some(turned(only.about, v, u)), None]))
            }
            [] => match angle(u, v) {
                by_rad if by_rad > RESOLUTION_RAD => {
                    Err(UnreachableDirection { closest: v, by_rad })
                }
                _ => Ok(AngleBranches::only([None; 2])),
            },
        }
    }
}

impl Pair {
    fn of(a: Vec3, b: Vec3, v: Vec3) -> Self {
        let across = a.cross(&b);
        // Again perpendicular to a: the cross product of nearly parallel axes is not, to the last digit.
        let n = (across - a * a.dot(&across)).normalize();
        Self { a, b, v, beta: angle(b, v), gamma: angle(a, b), n, towards_b: n.cross(&a) }
    }

    fn aim(&self, u: Vec3) -> Result<AngleBranches, UnreachableDirection> {
        let Self { a, b, v, beta, gamma, n, towards_b } = *self;
        let alpha = angle(a, u);
        // Twice s−α, s−β, s−γ and π−s; a triangle exists if none is negative.
        let excess = [
            (beta + gamma - alpha, beta + gamma),
            (gamma - beta + alpha, beta - gamma),
            (beta - gamma + alpha, gamma - beta),
            (2.0 * PI - (beta + gamma) - alpha, 2.0 * PI - (beta + gamma)),
        ];
        if let Some((_, limit)) = excess.iter().find(|(e, _)| *e < -RESOLUTION_RAD) {
            return Err(missed(a, u, b, alpha, *limit));
        }
        if alpha.min(PI - alpha) <= RESOLUTION_RAD {
            let pole = if alpha < 1.0 { a } else { -a };
            let one = [None, Some(turned(b, v, pole))];
            return Ok(AngleBranches { one, other: None, first_is_idle: true });
        }
        let half_sine = |i: usize| match excess[i].0 {
            e if e <= FLAT_RAD => 0.0,
            e => (0.5 * e).sin(),
        };
        let (up, down) = (half_sine(0) * half_sine(2), half_sine(3) * half_sine(1));
        let phi = 2.0 * up.sqrt().atan2(down.sqrt());
        let branch = |phi: f64| {
            let w = a * alpha.cos() + (towards_b * phi.cos() + n * phi.sin()) * alpha.sin();
            [Some(turned(a, w, u)), Some(turned(b, v, w))]
        };
        let other = (up > 0.0 && down > 0.0).then(|| branch(-phi));
        Ok(AngleBranches { one: branch(phi), other, first_is_idle: false })
    }
}

/// The angle between two unit vectors, to rounding everywhere.
fn angle(a: Vec3, b: Vec3) -> f64 {
    a.cross(&b).norm().atan2(a.dot(&b))
}

/// The angle about a unit vector that turns the half plane of `from` into that of `to`.
fn turned(about: Vec3, from: Vec3, to: Vec3) -> f64 {
    let (from, to) = (about.cross(&from), about.cross(&to));
    about.dot(&from.cross(&to)).atan2(from.dot(&to))
}

/// `u` brought to the angle `limit` from `a`; if it lies on `a`, in the half plane of `side`.
fn missed(a: Vec3, u: Vec3, side: Vec3, alpha: f64, limit: f64) -> UnreachableDirection {
    let across = [u, side].map(|x| x - a * a.dot(&x));
    let outwards = if across[0].norm() > RESOLUTION_RAD { across[0] } else { across[1] };
    let closest = a * limit.cos() + outwards.normalize() * limit.sin();
    UnreachableDirection { closest, by_rad: (alpha - limit).abs() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn right_angles_give_the_textbook_angles() {
        // w b X Y Z C A t: u = (sin C sin A, −cos C sin A, cos A); C = 90°, A = 30°.
        let u = Vec3::new(0.5, 0.0, 0.75_f64.sqrt());
        let pair = Pair::of(Vec3::z(), Vec3::x(), Vec3::z());
        let Ok(aimed) = pair.aim(u) else { panic!("reachable") };
        let degrees = aimed.branches().map(|q| q.map(|q| q.unwrap_or(f64::NAN).to_degrees()));
        let mut degrees: Vec<[f64; 2]> = degrees.collect();
        degrees.sort_by(|x, y| x[1].total_cmp(&y[1]));
        for (found, wanted) in degrees.iter().zip([[-90.0, -30.0], [90.0, 30.0]]) {
            assert!((found[0] - wanted[0]).abs() < 1e-13 && (found[1] - wanted[1]).abs() < 1e-13);
        }
    }

    #[test]
    fn closest_direction_of_a_short_cone() {
        // Axes 30° apart, tool 30° from the second: never more than 60° from the first.
        let at = |deg: f64| Vec3::new(deg.to_radians().sin(), 0.0, deg.to_radians().cos());
        let pair = Pair::of(at(0.0), at(30.0), at(0.0));
        let Err(missed) = pair.aim(at(75.0)) else { panic!("too far") };
        assert!((missed.by_rad.to_degrees() - 15.0).abs() < 1e-12);
        assert!((missed.closest - at(60.0)).norm() < 1e-15);
    }
}
