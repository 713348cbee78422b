//! Error tables of the axes from the readings of a laser, a level, a ball-bar or an R-test: positioning,
//! straightness, angles, run-out of rotary axes, averaged over runs; squareness from circles.
//!
//! An instrument sees the tool against the workpiece where its optics are, not the error of the body: what the
//! angles of the axis do over that arm is subtracted, by the chain of the machine file (docs/model.md eq. 181).
//! What the set-up of the instrument hides (its zero, the line of a straightedge, the eccentricity of a
//! ball) is subtracted, too, and stated.

mod file;
mod machine_file;
mod means;
mod reduce;
mod squareness;

pub use file::{parse_tables, read_tables};
pub use machine_file::{MachineFiles, machine_files};
pub use reduce::{ErrorTable, Removed, error_tables};
pub use squareness::{Squareness, squarenesses};

use super::iso230_2::Measurement;
use std::path::PathBuf;
use trueaxis_geometry::Vec3;
use trueaxis_machine::Machine;
use trueaxis_machine::axis::Command;
use trueaxis_machine::errors::{ErrorIndex, ErrorName};
use trueaxis_machine::twist::Reference;

/// The straight line that is subtracted the readings of straightness: how the reference lies is not an error.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum ReferenceLine {
    /// The least-squares line of both directions.
    #[default]
    LeastSquares,
    /// Through the first and the last target.
    Ends,
    /// None: the reference is square to the machine by itself.
    None,
}

/// The readings of one error motion.
#[derive(Debug, Clone)]
pub struct ErrorReadings {
    /// The error.
    pub name: ErrorName,
    /// Where it stands in the chain.
    pub index: ErrorIndex,
    /// Its axis.
    pub axis: usize,
    /// The file, for messages.
    pub file: String,
    /// The readings, deviations in mm or rad.
    pub measurement: Measurement,
    /// The instrument, in words.
    pub instrument: Option<String>,
    /// When.
    pub date: Option<String>,
    /// The temperature of the scale, °C.
    pub celsius: Option<f64>,
    /// Standard uncertainty of the instrument, common to all rows. Unit: mm or rad.
    pub u: f64,
    /// Standard uncertainty in proportion to the travel from the zero. Unit: 1.
    pub u_ratio: f64,
    /// Where the other axes stood.
    pub at: Command,
    /// The point that the instrument sees, in the tool frame, mm.
    pub optics_mm: Vec3,
    /// What the other part of the instrument stands on.
    pub stands_on: Reference,
    /// Whether the readings are of the workpiece against the tool: the opposite sign.
    pub of_workpiece: bool,
    /// Which line of a straightness is subtracted.
    pub line: ReferenceLine,
    /// Where the table is zero. Unit: mm or rad.
    pub zero: Option<f64>,
    /// Whether the eccentricity of the artefact is subtracted the run-out of a rotary axis.
    pub centred: bool,
}

/// A circular test.
#[derive(Debug, Clone)]
pub struct CircleReadings {
    /// The file, for messages.
    pub file: String,
    /// The points as text, for ISO 230-4.
    pub text: String,
    /// The commanded centre in the two axes of the circle, mm.
    pub centre_mm: [f64; 2],
    /// The nominal radius, mm.
    pub radius_mm: f64,
    /// Where the other axes stood.
    pub at: Command,
    /// The ball in the spindle, in the tool frame, mm.
    pub ball_mm: Vec3,
    /// Standard uncertainty of a radial reading that does not average out, mm.
    pub u_mm: f64,
}

/// A file of readings for the error tables of a machine.
#[derive(Debug, Clone)]
pub struct TableStudy {
    /// Its name.
    pub name: String,
    /// The machine file.
    pub machine_path: PathBuf,
    /// The machine, at the temperatures of its tables.
    pub machine: Machine,
    /// The readings of error motions.
    pub readings: Vec<ErrorReadings>,
    /// The circular tests.
    pub circles: Vec<CircleReadings>,
}
