//! Points, directions and poses with their frames in their types.
//!
//! Only the public ends of a computation are typed (`Pose<Workpiece, Tool>`); inside a chain the
//! frames stand in the names (`bed_from_x`), because typing every link would make each of them a
//! type of its own.

use crate::{Mat3, Vec3};
use std::marker::PhantomData;
use std::ops::{Mul, Sub};

/// The machine frame, fixed to the bed: axes parallel to the nominal X, Y, Z of ISO 841.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Bed {}
/// The workpiece frame of the program, with its origin at part zero.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Workpiece {}
/// The frame of the tool holder; +z points from the tool tip to the spindle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Tool {}
/// The frame of any body of the machine; the name of the variable states which.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Body {}

/// A point, in mm, in frame `F`.
#[derive(Debug, PartialEq)]
pub struct Point<F>(Vec3, PhantomData<F>);

/// A unit vector in frame `F`.
#[derive(Debug, PartialEq)]
pub struct Direction<F>(Vec3, PhantomData<F>);

/// `Pose<To, From>` takes coordinates in `From` to coordinates in `To`: `p_to = R·p_from + t`.
///
/// `R` is a rotation, except under the papers' small-angle model, where it is `I + [ε]×`; the
/// inverse is therefore the true inverse, not the transpose.
#[derive(Debug, PartialEq)]
pub struct Pose<To, From> {
    linear: Mat3,
    shift_mm: Vec3,
    frames: PhantomData<(To, From)>,
}

// By hand: a derive would ask the frame markers, which have no values, for the same traits.
impl<F> Clone for Point<F> {
    fn clone(&self) -> Self {
        *self
    }
}
impl<F> Copy for Point<F> {}
impl<F> Clone for Direction<F> {
    fn clone(&self) -> Self {
        *self
    }
}
impl<F> Copy for Direction<F> {}
impl<To, From> Clone for Pose<To, From> {
    fn clone(&self) -> Self {
        *self
    }
}
impl<To, From> Copy for Pose<To, From> {}

impl<F> Point<F> {
    /// The origin of the frame.
    pub const ORIGIN: Self = Self(Vec3::new(0.0, 0.0, 0.0), PhantomData);

    /// A point from its coordinates in mm.
    pub const fn new(x_mm: f64, y_mm: f64, z_mm: f64) -> Self {
        Self(Vec3::new(x_mm, y_mm, z_mm), PhantomData)
    }

    /// A point from a vector of coordinates in mm.
    pub const fn from_vector(mm: Vec3) -> Self {
        Self(mm, PhantomData)
    }

    /// The coordinates in mm.
    pub const fn vector(self) -> Vec3 {
        self.0
    }

    /// The point `distance_mm` further along a direction.
    pub fn along(self, direction: Direction<F>, distance_mm: f64) -> Self {
        Self(self.0 + direction.0 * distance_mm, PhantomData)
    }
}

impl<F> Sub for Point<F> {
    type Output = Vec3;
    fn sub(self, other: Self) -> Vec3 {
        self.0 - other.0
    }
}

impl<F> Direction<F> {
    /// The z direction of the frame.
    pub const Z: Self = Self(Vec3::new(0.0, 0.0, 1.0), PhantomData);

    /// The direction of a vector of any length; `None` where it has none (zero, NaN, infinite).
    ///
    /// ```
    /// use trueaxis_geometry::{Vec3, frame::{Direction, Workpiece}};
    /// let d = Direction::<Workpiece>::of(Vec3::new(0.0, 3.0, 4.0)).expect("not zero");
    /// assert_eq!(d.vector(), Vec3::new(0.0, 0.6, 0.8));
    /// assert!(Direction::<Workpiece>::of(Vec3::zeros()).is_none());
    /// ```
    pub fn of(vector: Vec3) -> Option<Self> {
        let square = vector.norm_squared();
        if (1e-200..1e200).contains(&square) {
            return Some(Self(vector / square.sqrt(), PhantomData));
        }
        // Scaled first, so that neither 1e-200 nor 1e200 loses its direction in the squares.
        let scale = vector.amax();
        if !vector.iter().all(|v| v.is_finite()) || scale == 0.0 {
            return None;
        }
        let scaled = vector / scale;
        Some(Self(scaled / scaled.norm(), PhantomData))
    }

    /// The components of the unit vector.
    pub const fn vector(self) -> Vec3 {
        self.0
    }
}

impl<To, From> Pose<To, From> {
    /// The two frames coincide.
    pub fn identity() -> Self {
        Self::new(Mat3::identity(), Vec3::zeros())
    }

    /// A pose from the matrix `R` and the position of the origin of `From` in `To`, in mm.
    pub const fn new(linear: Mat3, shift_mm: Vec3) -> Self {
        Self { linear, shift_mm, frames: PhantomData }
    }

    /// A shift without rotation.
    pub fn shift(mm: Vec3) -> Self {
        Self::new(Mat3::identity(), mm)
    }

    /// A right-handed rotation about a unit vector through the origin (Rodrigues).
    ///
    /// ```
    /// use trueaxis_geometry::{Vec3, frame::{Bed, Body, Point, Pose}};
    /// let quarter = Pose::<Bed, Body>::turn(Vec3::z(), std::f64::consts::FRAC_PI_2);
    /// let y = (quarter * Point::new(1.0, 0.0, 0.0)).vector();
    /// assert!((y - Vec3::y()).norm() < 1e-15);
    /// ```
    pub fn turn(axis: Vec3, angle_rad: f64) -> Self {
        Self::new(rotation(axis, angle_rad), Vec3::zeros())
    }

    /// The matrix `R`.
    pub const fn linear(&self) -> &Mat3 {
        &self.linear
    }

    /// The origin of `From` in `To`, in mm.
    pub const fn shift_mm(&self) -> &Vec3 {
        &self.shift_mm
    }

    /// The inverse pose.
    ///
    /// `R` must be invertible, as every rotation and every `I + [ε]×` is.
    pub fn inverse(&self) -> Pose<From, To> {
        let inverse = inverse3(&self.linear);
        Pose::new(inverse, -(inverse * self.shift_mm))
    }

    /// The same numbers with other frames: for the ends of a chain whose links are untyped.
    pub fn relabel<To2, From2>(self) -> Pose<To2, From2> {
        Pose::new(self.linear, self.shift_mm)
    }
}

impl<To, Mid, From> Mul<Pose<Mid, From>> for Pose<To, Mid> {
    type Output = Pose<To, From>;
    fn mul(self, inner: Pose<Mid, From>) -> Pose<To, From> {
        Pose::new(self.linear * inner.linear, self.linear * inner.shift_mm + self.shift_mm)
    }
}

impl<To, From> Mul<Point<From>> for Pose<To, From> {
    type Output = Point<To>;
    fn mul(self, point: Point<From>) -> Point<To> {
        Point(self.linear * point.0 + self.shift_mm, PhantomData)
    }
}

impl<To, From> Mul<Direction<From>> for Pose<To, From> {
    type Output = Direction<To>;
    /// Normalised, so that a direction remains a unit vector in the small-angle model too.
    fn mul(self, direction: Direction<From>) -> Direction<To> {
        let turned = self.linear * direction.0;
        Direction(turned / turned.norm(), PhantomData)
    }
}

/// The rotation matrix about a unit vector (Rodrigues), exact at 0.
pub fn rotation(axis: Vec3, angle_rad: f64) -> Mat3 {
    let (sin, cos) = angle_rad.sin_cos();
    // 1 − cos loses half its digits at small angles; 2 sin²(φ/2) does not.
    let half = (0.5 * angle_rad).sin();
    let versine = 2.0 * half * half;
    let skew = axis.cross_matrix();
    Mat3::identity() * cos + skew * sin + axis * axis.transpose() * versine
}

/// The inverse of an invertible 3×3 matrix by its adjugate.
pub fn inverse3(m: &Mat3) -> Mat3 {
    let (a, b, c) = (m.column(0), m.column(1), m.column(2));
    let rows = [b.cross(&c), c.cross(&a), a.cross(&b)];
    let determinant = a.dot(&rows[0]);
    Mat3::from_rows(&rows.map(|row| (row / determinant).transpose()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inverse_of_a_small_angle_matrix_is_not_its_transpose() {
        let linear = Mat3::identity() + Vec3::new(0.0, 0.0, 0.01).cross_matrix();
        let pose = Pose::<Bed, Body>::new(linear, Vec3::new(1.0, 2.0, 3.0));
        let back = pose.inverse() * (pose * Point::new(5.0, 6.0, 7.0));
        assert!((back.vector() - Vec3::new(5.0, 6.0, 7.0)).norm() < 1e-14);
    }

    #[test]
    fn direction_survives_extreme_lengths() {
        let tiny = Direction::<Bed>::of(Vec3::new(3e-300, 0.0, 4e-300)).unwrap();
        let huge = Direction::<Bed>::of(Vec3::new(3e300, 0.0, 4e300)).unwrap();
        assert!((tiny.vector() - huge.vector()).norm() < 1e-15);
        assert!(Direction::<Bed>::of(Vec3::new(f64::NAN, 0.0, 1.0)).is_none());
    }
}
