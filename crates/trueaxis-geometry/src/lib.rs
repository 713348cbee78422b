//! Points, directions and poses whose *frames are part of their types* ([`frame`]), so that a point in
//! the workpiece frame cannot be added to a point in the machine frame by mistake.
//!
//! Inside the programs lengths are mm, angles rad, times s, temperatures °C. µm, µrad, deg and
//! m/min exist only in text.
//!
//! ```
//! use trueaxis_geometry::frame::{Direction, Point, Pose, Tool, Workpiece};
//! use trueaxis_geometry::Vec3;
//!
//! // A tool holder 100 mm above part zero, not tilted; the tip is 100 mm below the holder.
//! let workpiece_from_tool: Pose<Workpiece, Tool> = Pose::shift(Vec3::new(0.0, 0.0, 100.0));
//! let tip = workpiece_from_tool * Point::<Tool>::new(0.0, 0.0, -100.0);
//! assert_eq!(tip.vector(), Vec3::zeros());
//! assert_eq!((workpiece_from_tool * Direction::<Tool>::Z).vector(), Vec3::z());
//! ```
//!
//! `examples/tilted_tool.rs` computes the tip of a tilted tool.
//!
//! The crate knows nothing of machines, programs and parts.

// On top of the list of the workspace, as this crate has no hits.
#![warn(clippy::needless_pass_by_value, clippy::redundant_closure_for_method_calls)]
// Numbers decide here: a cast that could change one is checked or has a reason.
#![warn(clippy::cast_possible_truncation, clippy::cast_sign_loss)]

pub mod exchange;
pub mod frame;
pub mod statistics;
pub mod surface;

/// A column vector of three components; its unit and frame are in the name of the variable.
pub type Vec3 = nalgebra::Vector3<f64>;
/// A 3×3 matrix that acts on column vectors.
pub type Mat3 = nalgebra::Matrix3<f64>;

/// The angle between two unit vectors, to rounding everywhere, rad.
pub fn angle(a: &Vec3, b: &Vec3) -> f64 {
    let (sine, cosine) = (a.cross(b).norm(), a.dot(b));
    if sine < 1e-3 && cosine > 0.0 {
        // The arc sine: the next term, 15/336 s⁷, is 5e-20 of it.
        let square = sine * sine;
        return sine * (1.0 + square * (1.0 / 6.0 + 0.075 * square));
    }
    sine.atan2(cosine)
}

/// The kind of motion of an axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AxisKind {
    /// Moves along its direction, mm.
    Linear,
    /// Turns about its direction, rad.
    Rotary,
}
