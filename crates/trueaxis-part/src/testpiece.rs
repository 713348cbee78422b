//! Test pieces: a feature, the path that cuts it, and what is evaluated on it.
//!
//! [`TestPiece`] is what the loop sees. [`Cone`](cone::Cone) is the first member of the family
//! (the frustum of NAS 979 and Wu et al. 2022, that of ISO 10791-7, a cylinder at half angle 0);
//! an S-shaped piece or a surface of the user's own implement the same trait: their contacts have
//! other normals and their features other indices.

pub mod cone;
mod datum;
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
    /// Where the flank touches the part, one per height, in the order of the piece's sections.
    pub contacts: Vec<Contact>,
}

/// A place on the tool axis whose deviation counts, with the direction in which it counts.
#[derive(Debug, Clone, Copy)]
pub struct Contact {
    /// Distance from the tip up the tool axis.
    pub along_axis_mm: f64,
    /// Out of the material.
    pub normal: Direction<Workpiece>,
    /// Which section (height) of the piece.
    pub section: usize,
}

/// What was cut: actual minus ideal place of the tool-axis point of every contact, E_v.
///
/// Row-major: all contacts of the first tool position, then of the second …
#[derive(Debug, Clone, Copy)]
pub struct CutSurface<'a> {
    /// E_v of every contact, relative to the tool-setting point, workpiece frame.
    pub deviation_mm: &'a [Vec3],
    /// What coaxiality and angularity refer to.
    pub datum: Datum,
}

/// Whose definition an index follows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Family {
    /// Wu et al. 2022, Eq 18–20; shown beside the standard's, never decisive.
    Paper,
    /// ISO 12181 and ISO 1101 on the section points.
    Iso,
    /// The error vector itself, of no feature.
    Spatial,
}

/// What an index is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Feature {
    /// Form of one section.
    Roundness,
    /// Place of one section.
    Coaxiality,
    /// Direction of the generatrix.
    Angularity,
    /// The error vector of the tool.
    Volumetric,
}

/// The name of one index of a test piece.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct IndexName {
    /// Whose definition.
    pub family: Family,
    /// The key in reports, with its unit: `roundness_mzc_mm`.
    pub key: &'static str,
    /// What it is about.
    pub feature: Feature,
    /// Whether the verdict hangs on it.
    pub decisive: bool,
}

impl IndexName {
    /// What tables call it.
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

/// The memory of an evaluation; one per thread.
#[derive(Debug, Clone, Default)]
pub struct Scratch {
    fitter: Fitter,
    profile_mm: Vec<[f64; 2]>,
}

/// One height of the piece with everything that a report draws.
#[derive(Debug, Clone)]
pub struct PartSection {
    /// Height above the base along the axis of the piece.
    pub height_mm: f64,
    /// The same height in the workpiece frame.
    pub z_mm: f64,
    /// Nominal radius.
    pub radius_mm: f64,
    /// Azimuth of every tool position.
    pub azimuth_rad: Vec<f64>,
    /// E = n_f·E_v per tool position, positive where material is left.
    pub deviation_mm: Vec<f64>,
    /// The points of the section (radius + E / cos α).
    pub profile_mm: Vec<[f64; 2]>,
    /// The four reference circles.
    pub circles: Circles,
    /// Every index of the piece at this height, in the order of [`TestPiece::index_names`];
    /// `None` where it needs more than one height.
    pub indices_mm: Vec<Option<f64>>,
}

/// A part that is cut to find out how good a machine is.
pub trait TestPiece: std::fmt::Debug + Send + Sync {
    /// What the shop calls it.
    fn name(&self) -> &str;

    /// The ideal path; the tool-setting point is the origin of the workpiece frame.
    fn tool_positions(&self) -> Vec<ToolPosition>;

    /// How many tool positions the path has.
    fn position_count(&self) -> usize;

    /// How many contacts each tool position has.
    fn contacts_per_position(&self) -> usize;

    /// The indices, in the order in which [`TestPiece::evaluate`] writes them.
    fn index_names(&self) -> &[IndexName];

    /// Memory for [`TestPiece::evaluate`], so that it allocates nothing.
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

    /// Every height in full, for reports.
    ///
    /// # Errors
    /// As [`TestPiece::evaluate`].
    fn sections(&self, cut: &CutSurface<'_>) -> Result<Vec<PartSection>, Error>;

    /// The deviations of a faultless machine: all zero, so that every index must be 0.
    fn ideal_deviation_mm(&self) -> Vec<Vec3> {
        vec![Vec3::zeros(); self.position_count() * self.contacts_per_position()]
    }
}

impl<'a> CutSurface<'a> {
    /// A cut seen from the ideal axis of the piece.
    pub fn about_ideal_axis(deviation_mm: &'a [Vec3]) -> Self {
        Self { deviation_mm, datum: Datum::IDEAL }
    }
}
