//! Mounting of a test piece on the machine.

use trueaxis_geometry::Vec3;
use trueaxis_geometry::frame::{Body, Pose, Workpiece};

/// Mounting of the frustum of Wu et al. 2022 on its inclined fixture.
///
/// ```text
///            ╱╲  h1 cone
///           ╱──╲ h2 pedestal
///       ╱───────   fixture, top face l1 long, inclined by β
///     ╱_________|  h3 its lower height
/// ```
/// # Source
/// Wu et al. 2022, fig. 5, table 2.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NasMounting {
    /// Height of the cone, h1.
    pub cone_height_mm: f64,
    /// Height of the pedestal under the cone, h2.
    pub pedestal_height_mm: f64,
    /// Height of the low end of the fixture, h3.
    pub fixture_height_mm: f64,
    /// Length of the top face of the fixture, l1.
    pub fixture_length_mm: f64,
    /// Inclination of the cone axis, β.
    pub inclination_rad: f64,
    /// Rotation of the fixture on the table, γ.
    pub rotation_rad: f64,
}

impl NasMounting {
    /// From the workpiece frame (centre of the top face, z = cone axis) to the fixture.
    ///
    /// ```text
    /// Rz(γ) · Trans((h1+h2) sin β, 0, h3 + l1 sin β / 2 + (h1+h2) cos β) · Ry(β)
    /// ```
    ///
    /// docs/model.md eq. 19.
    ///
    /// # Example
    /// ```
    /// use trueaxis_geometry::frame::Point;
    /// use trueaxis_part::testpiece::NasMounting;
    /// let table_2 = NasMounting {
    ///     cone_height_mm: 60.0, pedestal_height_mm: 25.0, fixture_height_mm: 25.0,
    ///     fixture_length_mm: 310.0, inclination_rad: 10f64.to_radians(), rotation_rad: 0.0,
    /// };
    /// let top = (table_2.fixture_from_workpiece() * Point::ORIGIN).vector();
    /// // 85 · 0.173648 = 14.7601;  25 + 155 · 0.173648 + 85 · 0.984808 = 135.6241
    /// assert!((top.x - 14.7601).abs() < 1e-4 && (top.z - 135.6241).abs() < 1e-4);
    /// ```
    /// # Source
    /// Wu et al. 2022, Eq 2; the misalignment of the fixture on the machine (S⁰ʷᵖᵉ) belongs to
    /// the location errors of the machine and is not included.
    pub fn fixture_from_workpiece(&self) -> Pose<Body, Workpiece> {
        let (sin, cos) = self.inclination_rad.sin_cos();
        let axis_length = self.cone_height_mm + self.pedestal_height_mm;
        let top = Vec3::new(
            axis_length * sin,
            0.0,
            self.fixture_height_mm + 0.5 * self.fixture_length_mm * sin + axis_length * cos,
        );
        Pose::<Body, Body>::turn(Vec3::z(), self.rotation_rad)
            * Pose::<Body, Body>::shift(top)
            * Pose::turn(Vec3::y(), self.inclination_rad)
    }
}
