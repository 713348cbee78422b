//! The geometry of cycles, the same for all controls: what the words of a control mean is in `trueaxis-nc`.
//!
//! - [`mill`]: bores; [`face`]: faces; [`slot`]; [`pocket`] and [`spigot`], whose outlines are in [`outline`].
//! - [`contour`]: the centre of a cutter along a whole contour.
//! - [`thread`]: the passes of a thread; [`thread_mill`]: milled ones.
//! - [`turning`]: a profile turned on a lathe.
//! - [`spline`]: rational B-splines and the arcs through them.
//! - [`pattern`]: holes in rows, on circles and in grids; pecks that become shorter.
//!
//! Lengths are in mm, angles in the unit that their names state. Points are in the plane of the cycle, its
//! first axis first.

pub mod contour;
pub mod face;
pub mod mill;
pub mod outline;
pub mod pattern;
pub mod pocket;
pub mod slot;
pub mod spigot;
pub mod spline;
pub mod thread;
pub mod thread_mill;
pub mod turning;

pub use trueaxis_contour::plane::Point;
