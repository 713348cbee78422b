//! Why no element goes through points.

use thiserror::Error;

/// The reason why points have no element; each variant is something that the caller can change.
///
/// ```
/// use trueaxis_form::{Error, circle};
/// let two = [[0.0, 0.0], [1.0, 0.0]];
/// assert_eq!(circle::least_squares(&two), Err(Error::TooFewPoints { found: 2, needed: 3 }));
/// ```
#[derive(Debug, Clone, PartialEq, Error)]
pub enum Error {
    /// Fewer points than the element has unknowns.
    #[error("too few points: {found}, at least {needed} are needed")]
    TooFewPoints {
        /// Number of points.
        found: usize,
        /// Least number of points.
        needed: usize,
    },
    /// NaN, infinite, or beyond ±1e100.
    #[error("point {index} (counted from 0) is not finite or exceeds ±1e100")]
    NotFinite {
        /// Index of the point, from 0.
        index: usize,
    },
    /// All points are the same point.
    #[error("all points coincide")]
    Coincident,
    /// All points lie on one straight line.
    #[error("all points lie on one line")]
    Collinear,
    /// The points do not enclose a centre (a short arc, a cloud).
    #[error("the points do not enclose a centre: measure the whole circumference")]
    NoCentre,
}
