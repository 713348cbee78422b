//! What is the shape of points? The ideal geometry that represents them.
//!
//! - [`fit`](fn@fit): a line, plane, circle, sphere, cylinder or cone in space, by least squares with its covariance, by
//!   the minimum zone, circumscribed and inscribed, each with what is proved of it;
//! - [`Fitted::uncertainty`], [`Fitted::form_noise`]: what the uncertainty of a point makes of it;
//! - [`filter`]: the Gaussian filter; [`checks`]: what speaks against the points;
//! - [`circle`]: the four reference circles in a plane, exact and fast;
//! - [`least_squares`]: nonlinear least squares for any residuals.
//!
//! ```
//! use trueaxis_form::{Criterion, Element, Known, fit};
//! use trueaxis_geometry::Vec3;
//! // A ring of radius 10 mm at z = 5 mm; every other point is 2 µm outside.
//! let points: Vec<Vec3> = (0..8_u8)
//!     .map(|i| (f64::from(i) * std::f64::consts::FRAC_PI_4, 10.0 + 0.002 * f64::from(i % 2)))
//!     .map(|(a, r)| Vec3::new(r * a.cos(), r * a.sin(), 5.0))
//!     .collect();
//! let ring = fit(Element::Circle, &points, &Known::default())?;
//! let zone = ring.reference(Criterion::MinimumZone).unwrap();
//! assert!((zone.form_mm() - 0.002).abs() < 1e-12 && (zone.shape.point_mm.z - 5.0).abs() < 1e-12);
//! # Ok::<(), trueaxis_form::Error>(())
//! ```
//!
//! All lengths are in mm, in the frame of the points. The crate knows no file, no machine and no part.

// On top of the list of the workspace, as this crate has no hits.
#![warn(clippy::needless_pass_by_value, clippy::redundant_closure_for_method_calls)]
// Numbers decide here: a cast that could change one is checked or has a reason.
#![warn(clippy::cast_possible_truncation, clippy::cast_sign_loss)]

mod chebyshev;
pub mod checks;
pub mod circle;
mod element;
mod error;
pub mod filter;
mod fit;
pub mod least_squares;
mod linear;
pub mod placed;
mod profile;
mod start;
mod surface;
mod uncertainty;

pub use chebyshev::Contact;
pub use element::{Criterion, Element, Shape};
pub use error::Error;
pub use fit::{Fitted, Known, Proof, Reference, Sensitivity, fit, fit_by};
pub use uncertainty::{
    FormNoise, PointUncertainty, Source, Uncertainty, coverage_factor, noise_of_neighbours,
};
