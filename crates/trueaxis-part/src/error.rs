//! Why a part cannot be evaluated.

use thiserror::Error;

/// Why a part cannot be evaluated; each variant is something that the caller can change.
///
/// ```
/// use trueaxis_part::{Error, fit::circle};
/// let two = [[0.0, 0.0], [1.0, 0.0]];
/// assert_eq!(circle::least_squares(&two), Err(Error::TooFewPoints { found: 2, needed: 3 }));
/// ```
#[derive(Debug, Clone, PartialEq, Error)]
pub enum Error {
    /// A circle needs three points.
    #[error("{found} points are too few, {needed} are needed")]
    TooFewPoints {
        /// How many there are.
        found: usize,
        /// How many there must be.
        needed: usize,
    },
    /// NaN, infinite, or beyond ±1e100.
    #[error("value {index} is not a finite number of usable size")]
    NotFinite {
        /// Which point, deviation or value, from 0.
        index: usize,
    },
    /// All points are the same point.
    #[error("all points coincide: there is no circle")]
    Coincident,
    /// All points lie on one straight line.
    #[error("all points lie on one line: there is no circle")]
    Collinear,
    /// The points do not go round a centre (a short arc, a cloud).
    #[error("the points do not surround a centre: measure the whole circumference")]
    NoCentre,
    /// A dimension of a test piece that cannot be made.
    #[error("{what}")]
    Shape {
        /// Which dimension and what is allowed.
        what: String,
    },
    /// A list that does not belong to this test piece.
    #[error("{what}: {found} values, {expected} are due")]
    WrongLength {
        /// Which list.
        what: &'static str,
        /// Its length.
        found: usize,
        /// The length that it must have.
        expected: usize,
    },
}
