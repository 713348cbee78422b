//! What is the machine like? What instruments read, what a measurement will tell before anybody measures,
//! and which errors readings show.
//!
//! ```text
//!     instruments ──> unknowns ──> measure ──> plan ──> identify
//!     what is read    what is      campaigns   before   after the
//!                     sought                             measurement
//! ```

pub mod identify;
pub mod instruments;
pub mod measure;
pub mod plan;
pub mod report;
pub mod unknowns;
