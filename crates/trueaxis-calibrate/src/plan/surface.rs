//! A probing path over a surface: from cutter locations or an STL file.
//!
//! ```text
//!     study.toml ──read_surface──> SurfaceStudy {machine, candidates, probe}
//!     candidates ──spread──> points at least a spacing apart
//!     points ──poses──> reachable points with their rotary axes
//!     poses ──surface_program──> NC text ──check_surface──> duration, issues
//! ```
//!
//! The table of the points, with an empty column `deviation`, is what the measured offsets along the
//! normals are written into.

mod file;
mod points;
mod program;
mod study_of_hits;
mod virtual_probe;

pub use file::{SurfaceStudy, read_surface};
pub use points::{nominal_table, points_of_table};
pub use program::{Pose, check_surface, poses, surface_files, surface_program};
pub use study_of_hits::{HitsFiles, hits_study};
pub use trueaxis_geometry::surface::{Candidates, SurfacePoint, spread};
pub use virtual_probe::{TrueProbe, VirtualProbing, virtual_log};
