//! The datum axis of a measurement on a coordinate measuring machine.

use trueaxis_geometry::Vec3;

/// The datum of a measurement on a coordinate measuring machine: the ideal axis, or a machined
/// reference hole.
///
/// A hole bored on the same machine has itself a deviation; measured from the hole, this deviation
/// does not appear in the part. It is a small rigid motion that is subtracted:
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
    /// Displacement of the hole at the origin of the workpiece frame, mm.
    pub shift_mm: Vec3,
    /// Rotation of the hole, as a small rotation vector, rad.
    pub tilt_rad: Vec3,
}

impl Datum {
    /// The ideal z axis through the tool-setting point.
    pub const IDEAL: Self =
        Self { shift_mm: Vec3::new(0.0, 0.0, 0.0), tilt_rad: Vec3::new(0.0, 0.0, 0.0) };

    /// The displacement of the datum at a point of the workpiece frame, mm.
    pub fn displacement_mm(&self, place_mm: Vec3) -> Vec3 {
        self.shift_mm + self.tilt_rad.cross(&place_mm)
    }
}

impl Default for Datum {
    fn default() -> Self {
        Self::IDEAL
    }
}
