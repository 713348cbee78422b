//! How do scales and errors follow temperatures?
//!
//! ```text
//!     laser runs at two temperatures ──expansion──> coefficient, error table, spline, machine file
//!     logs of whole cycles           ──thermal────> which sensors explain a drift, scored on held-out cycles
//! ```
//!
//! A drift that no temperature explains, and errors that need the chain of the machine, are those of
//! `trueaxis-calibrate`.

pub mod expansion;
pub mod report;
pub mod thermal;

/// The JSON Schemas of the documents of this crate, by name.
#[cfg(feature = "schemas")]
pub fn schemas() -> Vec<trueaxis_report::NamedSchema> {
    use report::ThermalDocument;
    use trueaxis_report::named_schema;
    vec![named_schema::<ThermalDocument<'_>>("identify-thermal")]
}
