//! The geometry of cycles, the same for all controls: what the words of a control mean is in `trueaxis-nc`.
//!
//! - [`corner`]: roundings and chamfers between lines and arcs in a plane.
//! - [`mill`]: pockets and faces; [`thread`]: the passes of a thread.
//! - [`pattern`]: holes in rows, on circles and in grids; pecks that become shorter.
//!
//! Lengths are in mm, angles in the unit that their names state. Points are in the plane of the cycle, its
//! first axis first.
//!
//! ```
//! use trueaxis_cycles::corner::{Element, Shape, transition};
//! let first = Element::line([0.0, 0.0], [20.0, 0.0]);
//! let second = Element::line([20.0, 0.0], [20.0, 10.0]);
//! let round = transition(&first, &second, Shape::Round { radius_mm: 4.0 })?.unwrap();
//! assert_eq!((round.from, round.to), ([16.0, 0.0], [20.0, 4.0]));
//! # Ok::<(), trueaxis_cycles::corner::CornerError>(())
//! ```

pub mod corner;
pub mod mill;
pub mod pattern;
pub mod thread;

/// A point in the plane of a cycle, mm.
pub type Point = [f64; 2];

pub(crate) fn minus(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1]]
}

pub(crate) fn along(from: Point, direction: Point, length: f64) -> Point {
    [from[0] + length * direction[0], from[1] + length * direction[1]]
}

pub(crate) fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

pub(crate) fn cross(a: Point, b: Point) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

pub(crate) fn length(a: Point) -> f64 {
    a[0].hypot(a[1])
}
