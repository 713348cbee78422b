//! Errors of the evaluation of a part.

use thiserror::Error;

/// The reason why a part cannot be evaluated; each variant is something that the caller can change.
///
/// ```
/// use trueaxis_part::{Error, fit::circle};
/// let two = [[0.0, 0.0], [1.0, 0.0]];
/// assert_eq!(circle::least_squares(&two), Err(Error::TooFewPoints { found: 2, needed: 3 }));
/// ```
#[derive(Debug, Clone, PartialEq, Error)]
pub enum Error {
    /// A circle needs three points.
    #[error("too few points: {found}, at least {needed} are needed")]
    TooFewPoints {
        /// Number of points.
        found: usize,
        /// Least number of points.
        needed: usize,
    },
    /// NaN, infinite, or beyond ±1e100.
    #[error("value {index} (counted from 0) is not finite or exceeds ±1e100")]
    NotFinite {
        /// Index of the point, deviation or value, from 0.
        index: usize,
    },
    /// All points are the same point.
    #[error("all points coincide: there is no circle")]
    Coincident,
    /// All points lie on one straight line.
    #[error("all points lie on one line: there is no circle")]
    Collinear,
    /// The points do not enclose a centre (a short arc, a cloud).
    #[error("the points do not enclose a centre: measure the whole circumference")]
    NoCentre,
    /// A dimension of a test piece that is not possible.
    #[error("{what}")]
    Shape {
        /// The dimension and its permitted range.
        what: String,
    },
    /// A list whose length does not fit this test piece.
    #[error("{what}: {found} values, expected {expected}")]
    WrongLength {
        /// The name of the list.
        what: &'static str,
        /// Its length.
        found: usize,
        /// The expected length.
        expected: usize,
    },
}
