//! Surfaces of known shape that may move by some motions only: what datums leave free.
//!
//! Docs/model.md eq. 248 and 249.

use crate::chebyshev::{Distances, ends, objective};
use crate::surface::MOST;
use crate::{Criterion, Error};
use nalgebra::{DMatrix, SymmetricEigen};
use trueaxis_geometry::Vec3;
use trueaxis_geometry::frame::{Body, Point, Pose, rotation};

/// A motion of a surface from its nominal place.
pub type Motion = Pose<Body, Body>;

/// Square of the motion of a surface, per unit of a small motion, below which it does not move.
const STILL: f64 = 1e-12;
const MOST_STEPS: usize = 200;
/// A rigid body has so many.
const DEGREES: usize = 6;
/// Gains below this are rounding; lengths are in units of the size.
const ROUNDING: f64 = 4e-15;
const FIRST_TRUST: f64 = 1e-3;

/// A small rigid motion: of the pivot, and about it, both in units of the size.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Twist {
    /// How the pivot moves.
    pub way: Vec3,
    /// How the body turns about it.
    pub turn: Vec3,
}

/// The small rigid motions that surfaces leave possible.
///
/// ```
/// use trueaxis_form::placed::Freedom;
/// use trueaxis_geometry::Vec3;
/// let normal = Vec3::z();
/// let corners = [(0.0, 0.0), (10.0, 0.0), (0.0, 10.0)];
/// let plane = corners.map(|(x, y)| [Vec3::new(x, y, 0.0), normal]);
/// let free = Freedom::all(Vec3::zeros(), 10.0).held_by(&plane);
/// // A plane leaves two shifts along it and the turn about its normal.
/// assert_eq!(free.degrees(), 3);
/// assert!(!free.moves(&plane));
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Freedom {
    pivot_mm: Vec3,
    size_mm: f64,
    twists: Vec<Twist>,
}

impl Freedom {
    /// All six degrees, about a pivot, of a body of this size.
    pub fn all(pivot_mm: Vec3, size_mm: f64) -> Self {
        let zero = Vec3::zeros();
        let axes = [Vec3::x(), Vec3::y(), Vec3::z()];
        let shifts = axes.iter().map(|way| Twist { way: *way, turn: zero });
        let turns = axes.iter().map(|turn| Twist { way: zero, turn: *turn });
        Self { pivot_mm, size_mm, twists: shifts.chain(turns).collect() }
    }

    /// None of them.
    pub fn none(&self) -> Self {
        Self { twists: Vec::new(), ..self.clone() }
    }

    /// How many independent motions there are.
    pub fn degrees(&self) -> usize {
        self.twists.len()
    }

    /// The motions, at right angles to each other.
    pub fn twists(&self) -> &[Twist] {
        &self.twists
    }

    /// What remains of them when a surface, given by points and normals, is held along its normals.
    pub fn held_by(&self, surface: &[[Vec3; 2]]) -> Self {
        self.divided(surface).0
    }

    /// Those of them that move a surface.
    pub fn moving(&self, surface: &[[Vec3; 2]]) -> Self {
        self.divided(surface).1
    }

    /// Whether one of them moves a surface.
    pub fn moves(&self, surface: &[[Vec3; 2]]) -> bool {
        self.moving(surface).degrees() > 0
    }

    /// Whether a shift of the whole in this direction is among them.
    pub fn has_shift(&self, direction: &Vec3) -> bool {
        let shares = self.twists.iter().map(|t| t.way.dot(direction).powi(2));
        (shares.sum::<f64>() - 1.0).abs() < 1e-9
    }

    fn divided(&self, surface: &[[Vec3; 2]]) -> (Self, Self) {
        let with = |twists| Self { twists, ..self.clone() };
        let n = self.twists.len();
        if n == 0 || surface.is_empty() {
            return (self.clone(), with(Vec::new()));
        }
        let mut sums = [[0.0; DEGREES]; DEGREES];
        for [point, normal] in surface {
            let rows = self.slopes(point, normal);
            for (row, a) in sums.iter_mut().zip(rows) {
                row.iter_mut().zip(rows).for_each(|(sum, b)| *sum += a * b);
            }
        }
        let count = surface.len() as f64;
        let eigen = SymmetricEigen::new(DMatrix::from_fn(n, n, |a, b| sums[a][b] / count));
        let (mut still, mut moving) = (Vec::new(), Vec::new());
        for (k, value) in eigen.eigenvalues.iter().enumerate() {
            let vector = eigen.eigenvectors.column(k);
            let sum = |part: fn(&Twist) -> Vec3| {
                let parts = self.twists.iter().zip(vector.iter());
                parts.fold(Vec3::zeros(), |sum, (t, v)| sum + part(t) * *v)
            };
            let twist = Twist { way: sum(|t| t.way), turn: sum(|t| t.turn) };
            if *value < STILL { still.push(twist) } else { moving.push(twist) }
        }
        (with(still), with(moving))
    }

    /// How far each twist moves a point along a direction; zeros after the last.
    fn slopes(&self, point_mm: &Vec3, normal: &Vec3) -> [f64; DEGREES] {
        let arm = (point_mm - self.pivot_mm) / self.size_mm;
        // The same for all twists: (n, t × a) = (t, a × n).
        let moment = arm.cross(normal);
        let mut slopes = [0.0; DEGREES];
        for (slope, t) in slopes.iter_mut().zip(&self.twists) {
            *slope = t.way.dot(normal) + t.turn.dot(&moment);
        }
        slopes
    }

    /// The motion of so much of each twist: a screw, so that a surface that a twist leaves alone stays where it is.
    fn motion(&self, amounts: &[f64]) -> Motion {
        let sum = |part: fn(&Twist) -> Vec3| {
            let parts = self.twists.iter().zip(amounts);
            parts.fold(Vec3::zeros(), |sum, (t, a)| sum + part(t) * *a)
        };
        let (way, turn) = (sum(|t| t.way) * self.size_mm, sum(|t| t.turn));
        let angle = turn.norm();
        if angle == 0.0 {
            return Pose::shift(way);
        }
        let axis = turn / angle;
        let linear = rotation(axis, angle);
        // The integral of the rotation over the way (Rodrigues); 1 − cos φ by 2 sin²(φ/2).
        let (sin, half) = (angle.sin(), (0.5 * angle).sin());
        let along = axis * axis.dot(&way);
        let moved =
            along + (way - along) * (sin / angle) + axis.cross(&way) * (2.0 * half * half / angle);
        Pose::new(linear, self.pivot_mm + moved - linear * self.pivot_mm)
    }
}

/// Where a surface lies best.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Placed {
    /// From its nominal place.
    pub motion: Motion,
    /// The smallest distance of a point from it then, mm.
    pub low_mm: f64,
    /// The largest distance, mm.
    pub high_mm: f64,
}

/// Moves a surface by what is free until the range, the upper end or the lower end of the distances of points from it is best. Distances
/// are signed, with their gradients, of points seen from the surface in its nominal place.
///
/// # Errors
/// No points, or more than five degrees that move the surface.
pub fn place(
    points_mm: &[Vec3],
    free: &Freedom,
    distance: &dyn Fn(usize, &Vec3) -> (f64, Vec3),
    criterion: Criterion,
) -> Result<Placed, Error> {
    let degrees = free.degrees();
    if points_mm.is_empty() {
        return Err(Error::TooFewPoints { found: 0, needed: 1 });
    }
    if degrees > MOST {
        return Err(Error::TooFewPoints { found: MOST, needed: degrees });
    }
    let about = |motion: &Motion| {
        let back = motion.inverse();
        let count = points_mm.len();
        let (mut values, mut slopes) = (Vec::with_capacity(count), Vec::with_capacity(count));
        for (i, point) in points_mm.iter().enumerate() {
            let there = (back * Point::from_vector(*point)).vector();
            let (value, gradient) = distance(i, &there);
            let mut slope = [0.0; MOST];
            let moved = free.slopes(&there, &gradient);
            slope.iter_mut().zip(moved).for_each(|(s, m)| *s = -m);
            values.push(value / free.size_mm);
            slopes.push(slope);
        }
        Distances { values, slopes }
    };
    let size = |d: &Distances| {
        let (low, high) = d.range();
        objective(criterion, low, high)
    };
    let mut motion = Motion::identity();
    let mut here = about(&motion);
    let mut trust = FIRST_TRUST;
    for _ in 0..MOST_STEPS {
        if degrees == 0 {
            break;
        }
        let Some(best) = here.linear(degrees, criterion, trust) else { break };
        let before = size(&here);
        let predicted = before - best.objective(ends(criterion));
        if predicted <= ROUNDING || trust < 1e-14 {
            break;
        }
        let moved = motion * free.motion(&best.step[..degrees]);
        let there = about(&moved);
        let gain = (before - size(&there)) / predicted;
        if gain > 0.05 {
            (motion, here) = (moved, there);
        }
        trust *= match gain {
            g if g > 0.75 => 2.0,
            g if g < 0.25 => 0.25,
            _ => 1.0,
        };
    }
    let (low, high) = here.range();
    Ok(Placed { motion, low_mm: low * free.size_mm, high_mm: high * free.size_mm })
}
