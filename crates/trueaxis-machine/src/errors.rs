//! The errors of a machine: their names, their curves, their values at a position.

mod curve;
mod influence;
mod joint;
mod name;
mod slope;
mod spline;
mod stated;
mod uncertain;
mod values;

pub use curve::{Curve, Extrapolation, Harmonic, OutsideTable};
pub use influence::Influence;
pub use joint::{JointErrors, JointFunction};
pub use name::{BodyName, Component, ErrorKind, ErrorName};
pub use spline::{Interpolation, Spline, SplineError};
pub use stated::{Measurement, StatedError, Uncertainty};
pub(crate) use uncertain::Effect;
pub use uncertain::Uncertainties;
pub use values::{BodyErrors, ErrorIndex, ErrorValues, MAX_BODIES, Rotation, SixErrors};
