//! Test pieces: the feature, the path that cuts it, and the indices evaluated on it.
//!
//! [`TestPiece`] is the interface for the simulation. [`Cone`](cone::Cone) is the first of the family
//! (the frustum of NAS 979 and Wu et al. 2022, that of ISO 10791-7, a cylinder at half angle 0);
//! an S-shaped piece or a surface of the user can implement the same trait: their contacts have
//! other normals and their features other indices.

pub mod agreement;
pub mod cone;
mod datum;
pub mod measured;
mod mounting;

pub use datum::Datum;
pub use mounting::NasMounting;

use crate::Error;
use crate::fit::circle::{Circles, Fitter};
use trueaxis_geometry::Vec3;
use trueaxis_geometry::frame::{Direction, Point, Workpiece};

/// One ideal position of the tool on its path, in the workpiece frame.
#[derive(Debug, Clone)]
pub struct ToolPosition {
    /// The tool tip (centre of the end of the cutter).
    pub tip: Point<Workpiece>,
    /// From the tip to the spindle.
    pub axis: Direction<Workpiece>,
    /// The contacts of the flank with the part, one per height, in the order of the sections.
    pub contacts: Vec<Contact>,
}

/// A point of the tool axis at the height of a contact, and the normal of the surface there.
#[derive(Debug, Clone, Copy)]
pub struct Contact {
    /// Distance from the tip along the tool axis, mm.
    pub along_axis_mm: f64,
    /// The normal of the surface, out of the material.
    pub normal: Direction<Workpiece>,
    /// Index of the section (height) of the piece.
    pub section: usize,
}

/// The cut surface: actual minus ideal position of the tool-axis point of every contact, E_v.
///
/// Row-major: all contacts of the first tool position, then of the second …
#[derive(Debug, Clone, Copy)]
pub struct CutSurface<'a> {
    /// E_v of every contact, relative to the tool-setting point, workpiece frame, mm.
    pub deviation_mm: &'a [Vec3],
    /// The datum of coaxiality and angularity.
    pub datum: Datum,
}

/// The source of the definition of an index.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Family {
    /// Wu et al. 2022, Eq 18–20; shown for comparison, never decisive.
    Paper,
    /// ISO 12181 and ISO 1101 on the section points.
    Iso,
    /// The error vector itself, without a feature.
    Spatial,
}

/// The characteristic that an index describes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Feature {
    /// Form of one section.
    Roundness,
    /// Position of one section.
    Coaxiality,
    /// Direction of the generatrix.
    Angularity,
    /// The error vector of the tool.
    Volumetric,
}

/// The name of one index of a test piece.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct IndexName {
    /// The source of its definition.
    pub family: Family,
    /// The key in reports, with its unit: `roundness_mzc_mm`.
    pub key: &'static str,
    /// The characteristic that it describes.
    pub feature: Feature,
    /// Whether it decides the verdict.
    pub decisive: bool,
}

impl IndexName {
    /// Its title in tables.
    pub fn title(&self) -> &'static str {
        match self.key {
            "roundness_eq18_mm" => "roundness, paper Eq 18",
            "angularity_eq19_mm" => "angularity, paper Eq 19",
            "coaxiality_eq20_mm" => "coaxiality, paper Eq 20",
            "coaxiality_diameter_mm" => "coaxiality, Eq 20 as diameter",
            "roundness_lsc_mm" => "roundness, least squares",
            "roundness_mzc_mm" => "roundness, minimum zone",
            "roundness_mic_mm" => "roundness, maximum inscribed",
            "roundness_mcc_mm" => "roundness, minimum circumscribed",
            "coaxiality_lsc_mm" => "coaxiality, diameter",
            "angularity_zone_mm" => "angularity, zone",
            "volumetric_max_mm" => "greatest deviation of the tip",
            other => other,
        }
    }
}

/// Working memory of an evaluation; one per thread.
#[derive(Debug, Clone, Default)]
pub struct Scratch {
    fitter: Fitter,
    profile_mm: Vec<[f64; 2]>,
}

/// One section of the piece with the data of its diagram.
#[derive(Debug, Clone)]
pub struct PartSection {
    /// Height above the base along the axis of the piece, mm.
    pub height_mm: f64,
    /// The same height in the workpiece frame, mm.
    pub z_mm: f64,
    /// Nominal radius, mm.
    pub radius_mm: f64,
    /// Azimuth of every tool position, rad.
    pub azimuth_rad: Vec<f64>,
    /// E = n_f·E_v for each tool position, mm; positive where material remains.
    pub deviation_mm: Vec<f64>,
    /// The points of the section (radius + E / cos α), mm.
    pub profile_mm: Vec<[f64; 2]>,
    /// The four reference circles.
    pub circles: Circles,
    /// Every index of the piece at this height, in the order of [`TestPiece::index_names`];
    /// `None` where it needs more than one height.
    pub indices_mm: Vec<Option<f64>>,
}

/// A part that is cut to determine the accuracy of a machine.
pub trait TestPiece: std::fmt::Debug + Send + Sync {
    /// Its name.
    fn name(&self) -> &str;

    /// The ideal path; the tool-setting point is the origin of the workpiece frame.
    fn tool_positions(&self) -> Vec<ToolPosition>;

    /// The same path with so many positions for each one; the first of them is that one.
    fn finer_positions(&self, times: usize) -> Vec<ToolPosition>;

    /// Number of tool positions of the path.
    fn position_count(&self) -> usize;

    /// Number of contacts of each tool position.
    fn contacts_per_position(&self) -> usize;

    /// The indices, in the order in which [`TestPiece::evaluate`] writes them.
    fn index_names(&self) -> &[IndexName];

    /// Working memory for [`TestPiece::evaluate`], so that it allocates nothing.
    fn scratch(&self) -> Scratch {
        Scratch::default()
    }

    /// Every index of the cut, in mm.
    ///
    /// # Errors
    /// A list of the wrong length, a deviation that is not finite, a section that no circle fits.
    fn evaluate(
        &self,
        cut: &CutSurface<'_>,
        scratch: &mut Scratch,
        indices_mm: &mut [f64],
    ) -> Result<(), Error>;

    /// All sections with their profiles, for reports.
    ///
    /// # Errors
    /// As [`TestPiece::evaluate`].
    fn sections(&self, cut: &CutSurface<'_>) -> Result<Vec<PartSection>, Error>;

    /// The frame in which the cut agrees best with the nominal piece.
    fn best_fit(&self, deviation_mm: &[Vec3]) -> Datum;

    /// The deviations of a machine without errors: all zero, so that every index must be 0.
    fn ideal_deviation_mm(&self) -> Vec<Vec3> {
        vec![Vec3::zeros(); self.position_count() * self.contacts_per_position()]
    }
}

impl<'a> CutSurface<'a> {
    /// A cut surface with the ideal axis of the piece as datum.
    pub fn about_ideal_axis(deviation_mm: &'a [Vec3]) -> Self {
        Self { deviation_mm, datum: Datum::IDEAL }
    }
}
