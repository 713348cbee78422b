//! Errors of the evaluation of a part.

use thiserror::Error;

/// The reason why a part cannot be evaluated; each variant is something that the caller can change.
///
/// ```
/// use trueaxis_part::{Error, fit::circle};
/// let two: Result<_, Error> = circle::least_squares(&[[0.0, 0.0], [1.0, 0.0]]).map_err(Error::from);
/// assert!(matches!(two, Err(Error::Fit(_))));
/// ```
#[derive(Debug, Clone, PartialEq, Error)]
pub enum Error {
    /// Points without a circle.
    #[error("no circle: {0}")]
    Fit(#[from] trueaxis_form::Error),
    /// NaN, infinite, or beyond ±1e100.
    #[error("value {index} (counted from 0) is not finite or exceeds ±1e100")]
    NotFinite {
        /// Index of the deviation or value, from 0.
        index: usize,
    },
    /// A dimension of a test piece that is not possible.
    #[error("{what}")]
    Shape {
        /// The dimension and its permitted range.
        what: String,
    },
    /// A characteristic without a value.
    #[error("{name}: {reason}")]
    Characteristic {
        /// Its name.
        name: String,
        /// Why its points have none.
        reason: String,
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
