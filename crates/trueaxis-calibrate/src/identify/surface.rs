//! Hits of a probing program become deviations of the surface.
//!
//! ```text
//!     hits.toml ──read_hits──> HitsStudy {machine, nominal points, log, probe with its calibration}
//!     log ──deviations──> d = (b − p)·n − r + t        b: the ball by the chain with its errors   docs/model.md eq. 141
//!                         less the drift that the touch at the end shows, with U by parts
//! ```

mod deviations;
mod doubts;
mod log;
mod study;

pub use deviations::{Drift, PointDeviation, SurfaceDeviations, UncertaintyParts, deviations};
pub use log::{HitsLog, LoggedHit, parse_log};
pub use study::{HitsProbe, HitsStudy, read_hits};
