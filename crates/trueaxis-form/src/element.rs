//! Elements in space and the ways to lay them through points.

use trueaxis_geometry::Vec3;

/// A kind of ideal geometry.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Element {
    /// A straight line: of a profile in a plane, or in space.
    Line,
    /// A plane.
    Plane,
    /// A circle in a plane of its own.
    Circle,
    /// A sphere.
    Sphere,
    /// A cylinder.
    Cylinder,
    /// A cone.
    Cone,
}

impl Element {
    /// All of them.
    pub const ALL: [Self; 6] =
        [Self::Line, Self::Plane, Self::Circle, Self::Sphere, Self::Cylinder, Self::Cone];

    /// Its name.
    pub fn key(self) -> &'static str {
        match self {
            Self::Line => "line",
            Self::Plane => "plane",
            Self::Circle => "circle",
            Self::Sphere => "sphere",
            Self::Cylinder => "cylinder",
            Self::Cone => "cone",
        }
    }

    /// What the range of the deviations from it is called by ISO 1101.
    pub fn deviation_name(self) -> &'static str {
        match self {
            Self::Line => "straightness",
            Self::Plane => "flatness",
            Self::Circle => "roundness",
            Self::Sphere => "sphericity",
            Self::Cylinder => "cylindricity",
            Self::Cone => "form of the cone",
        }
    }

    /// Unknowns of the element; fewer points have none.
    pub fn unknowns(self) -> usize {
        match self {
            Self::Plane | Self::Circle => 3,
            Self::Line | Self::Sphere => 4,
            Self::Cylinder => 5,
            Self::Cone => 6,
        }
    }

    /// The ways in which it is laid through points.
    pub fn criteria(self) -> &'static [Criterion] {
        use Criterion::{LeastSquares, MaximumInscribed, MinimumCircumscribed, MinimumZone};
        match self {
            Self::Line | Self::Plane | Self::Cone => &[LeastSquares, MinimumZone],
            Self::Circle | Self::Sphere | Self::Cylinder => {
                &[LeastSquares, MinimumZone, MinimumCircumscribed, MaximumInscribed]
            }
        }
    }
}

/// What is made small or large.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Criterion {
    /// The sum of the squared deviations.
    LeastSquares,
    /// The range of the deviations.
    MinimumZone,
    /// The radius; no point is outside.
    MinimumCircumscribed,
    /// The radius; no point is inside.
    MaximumInscribed,
}

impl Criterion {
    /// `LSC`, `MZC`, `MCC`, `MIC`.
    pub fn key(self) -> &'static str {
        match self {
            Self::LeastSquares => "LSC",
            Self::MinimumZone => "MZC",
            Self::MinimumCircumscribed => "MCC",
            Self::MaximumInscribed => "MIC",
        }
    }

    /// In words.
    pub fn name(self) -> &'static str {
        match self {
            Self::LeastSquares => "least squares",
            Self::MinimumZone => "minimum zone",
            Self::MinimumCircumscribed => "minimum circumscribed",
            Self::MaximumInscribed => "maximum inscribed",
        }
    }
}

/// An element in the frame of the points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Shape {
    /// Which kind.
    pub element: Element,
    /// A point of it, mm: the centre of a circle or sphere, a point of a line, plane or axis next to the middle of
    /// the points.
    pub point_mm: Vec3,
    /// Direction of the line or axis, normal of the plane; of a cone to its larger end. Zero for a sphere.
    pub direction: Vec3,
    /// Radius, of a cone at the point of its axis; 0 for lines and planes, mm.
    pub radius_mm: f64,
    /// Half of the angle at the apex of a cone, otherwise 0, rad.
    pub half_angle_rad: f64,
}

impl Shape {
    /// How far a point is off the element: away from the material side of the normal or the axis positive; of a line
    /// in space the distance, of a circle in its plane, mm.
    ///
    /// ```
    /// use trueaxis_form::{Element, Shape};
    /// use trueaxis_geometry::Vec3;
    /// let sphere = Shape {
    ///     element: Element::Sphere, point_mm: Vec3::zeros(), direction: Vec3::zeros(), radius_mm: 5.0,
    ///     half_angle_rad: 0.0,
    /// };
    /// assert_eq!(sphere.deviation_mm(&Vec3::new(0.0, 3.0, 4.5)).signum(), 1.0);
    /// ```
    pub fn deviation_mm(&self, point_mm: &Vec3) -> f64 {
        let v = point_mm - self.point_mm;
        let along = v.dot(&self.direction);
        let across = (v - self.direction * along).norm();
        match self.element {
            Element::Plane => along,
            Element::Line => across,
            Element::Circle | Element::Cylinder => across - self.radius_mm,
            Element::Sphere => v.norm() - self.radius_mm,
            Element::Cone => {
                let (sin, cos) = self.half_angle_rad.sin_cos();
                (across - self.radius_mm) * cos - along * sin
            }
        }
    }

    /// The apex of a cone, mm; `None` where it is a cylinder to rounding.
    pub fn apex_mm(&self) -> Option<Vec3> {
        let slope = self.half_angle_rad.tan();
        let is_cone = self.element == Element::Cone && slope.abs() > 1e-12;
        is_cone.then(|| self.point_mm - self.direction * (self.radius_mm / slope))
    }
}
