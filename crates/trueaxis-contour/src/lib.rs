//! Contours in a plane: lines and arcs, the corners between them, and the path of a tool along them.
//!
//! - [`Element`]: a line or an arc.
//! - [`corner`]: roundings and chamfers between two elements.
//! - [`radius`]: the path of the centre of a tool with cutter radius compensation.
//! - [`lead`]: ways to a contour and away from it.
//!
//! Lengths are in mm, angles in the unit that their names state. Points are in the plane of the contour, its
//! first axis first; seen against the axis perpendicular to it, the second axis is counter-clockwise from
//! the first one.
//!
//! ```
//! use trueaxis_contour::Element;
//! use trueaxis_contour::corner::{Shape, transition};
//! let first = Element::line([0.0, 0.0], [20.0, 0.0]);
//! let second = Element::line([20.0, 0.0], [20.0, 10.0]);
//! let round = transition(&first, &second, Shape::Round { radius_mm: 4.0 })?.unwrap();
//! assert_eq!((round.from, round.to), ([16.0, 0.0], [20.0, 4.0]));
//! # Ok::<(), trueaxis_contour::corner::CornerError>(())
//! ```

pub mod corner;
mod element;
pub mod lead;
pub mod plane;
pub mod radius;

pub use element::Element;
