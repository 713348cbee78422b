//! The datum axis that a coordinate measuring machine aligned to.

use trueaxis_geometry::Vec3;

/// What a coordinate measuring machine aligned to: the ideal axis, or a machined reference hole.
///
/// A hole that the same machine has bored is itself out of place; measured from the hole, its
/// deviation disappears from the part. It is a small rigid motion that is taken off:
///
/// ```text
/// E_v′(p) = E_v(p) − (shift + tilt × p)        p from the origin of the workpiece frame
/// ```
///
/// Second order: tilt² · size, 0.1 nm for 30 µrad over 100 mm.
///
/// # Example
/// ```
/// use trueaxis_geometry::Vec3;
/// use trueaxis_part::testpiece::Datum;
/// // 20 µrad about y moves a point 60 mm below the origin by −1.2 µm in x.
/// let hole = Datum { shift_mm: Vec3::zeros(), tilt_rad: Vec3::new(0.0, 20e-6, 0.0) };
/// let moved = hole.displacement_mm(Vec3::new(0.0, 0.0, -60.0));
/// assert!((moved.x + 0.0012).abs() < 1e-15);
/// ```
/// # Source
/// Wu et al. 2022 measured from a reference hole (section 3, fig. 17 c); the prediction there
/// uses the ideal axis, as [`Datum::IDEAL`] does.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Datum {
    /// Displacement of the hole at the origin of the workpiece frame.
    pub shift_mm: Vec3,
    /// Rotation of the hole, as a small rotation vector.
    pub tilt_rad: Vec3,
}

impl Datum {
    /// The ideal z axis through the tool-setting point.
    pub const IDEAL: Self =
        Self { shift_mm: Vec3::new(0.0, 0.0, 0.0), tilt_rad: Vec3::new(0.0, 0.0, 0.0) };

    /// The motion of the datum at a place of the workpiece frame.
    pub fn displacement_mm(&self, place_mm: Vec3) -> Vec3 {
        self.shift_mm + self.tilt_rad.cross(&place_mm)
    }
}

impl Default for Datum {
    fn default() -> Self {
        Self::IDEAL
    }
}
