//! Nails: straight lines along the normals of a surface, which the cutter shortens.

use trueaxis_geometry::Vec3;

/// A point of the nominal surface, and how far along its normal the cut is looked for.
///
/// Material fills the nail from below; the lowest place that any cutter reached is the surface that is left.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Nail {
    /// Where it stands, in the workpiece frame.
    pub foot_mm: Vec3,
    /// Out of the material, a unit vector.
    pub normal: Vec3,
    /// How far into the material is looked; on a thin wall less than half of it.
    pub below_mm: f64,
    /// How far out of it; the length of a nail that no cutter reached.
    pub above_mm: f64,
}

/// What the cutters left of a nail.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Reach {
    /// Cut off here.
    Cut(Cut),
    /// Cut off below the end of the nail: a gouge of at least that depth.
    Deeper(Cut),
    /// No cutter came as low as the upper end.
    NotCut,
}

impl Reach {
    /// The place where it was cut.
    pub fn cut(&self) -> Option<&Cut> {
        match self {
            Self::Cut(cut) | Self::Deeper(cut) => Some(cut),
            Self::NotCut => None,
        }
    }
}

/// Where a nail was cut off, and by what.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cut {
    /// The deviation of the surface along the normal; positive: material is left.
    pub deviation_mm: f64,
    /// Which sweep.
    pub sweep: usize,
    /// Which of its moves, in the order of the program; the first of them, where several came equally low.
    pub step: usize,
    /// How much of the move was done then, 0 to 1. Unit: 1.
    pub place: f64,
    /// The tip of the tool then, in the workpiece frame.
    pub tip_mm: Vec3,
    /// Its axis, from the tip to the holder.
    pub axis: Vec3,
    /// The outward normal of the cutter where it touched.
    pub out: Vec3,
}

impl Cut {
    /// By how much the surface is displaced along its normal if the tool is displaced by so little: the tip, and the direction of
    /// the axis.
    ///
    /// ```text
    ///     dδ = g · (d_tip + ω × r) / (g · n),   ω = a × d_axis              docs/model.md eq. 245
    /// ```
    pub fn shift_mm(&self, nail: &Nail, tip_mm: &Vec3, axis: &Vec3) -> f64 {
        let arm = nail.foot_mm + nail.normal * self.deviation_mm - self.tip_mm;
        // The small rotation that turns the axis so: a × d_axis.
        let turn = self.axis.cross(axis);
        let moved = tip_mm + turn.cross(&arm);
        self.out.dot(&moved) / self.out.dot(&nail.normal)
    }
}

/// A nail as a line with a lowest place.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Line {
    pub foot_mm: Vec3,
    pub normal: Vec3,
    pub lowest_mm: f64,
}

impl Line {
    pub fn of(nail: &Nail) -> Self {
        Self { foot_mm: nail.foot_mm, normal: nail.normal, lowest_mm: -nail.below_mm }
    }

    #[inline]
    pub fn at(&self, along_mm: f64) -> Vec3 {
        self.foot_mm + self.normal * along_mm
    }
}
