//! The linear axes: they bring the tip to its place whatever the rotary axes do.

use super::columns::Columns;
use super::{FLAT, Fault};
use trueaxis_geometry::Vec3;

/// The linear axes at a pose.
pub(super) struct Placing {
    axes: [usize; 3],
    /// How each moves per mm that the tip shall move.
    per_mm: [Vec3; 3],
}

impl Placing {
    pub fn of(columns: &Columns, axes: [usize; 3]) -> Result<Self, Fault> {
        let [d1, d2, d3] = axes.map(|i| columns.tip[i]);
        let normals = [d2.cross(&d3), d3.cross(&d1), d1.cross(&d2)];
        let volume = d1.dot(&normals[0]);
        if volume.is_nan() || volume.abs() <= FLAT {
            return Err(Fault::Flat);
        }
        Ok(Self { axes, per_mm: normals.map(|normal| normal / volume) })
    }

    /// The motion of each axis that moves the tip by a vector.
    pub fn motion(&self, tip_mm: Vec3) -> impl Iterator<Item = (usize, f64)> {
        self.axes.into_iter().zip(self.per_mm.map(|per_mm| per_mm.dot(&tip_mm)))
    }

    /// How the tool axis turns while the tip moves by a vector: guides are not straight.
    pub fn turned(&self, columns: &Columns, tip_mm: Vec3) -> Vec3 {
        self.motion(tip_mm).map(|(i, by)| columns.axis[i] * by).sum()
    }
}
