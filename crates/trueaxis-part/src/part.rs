//! A part as its drawing describes it: features of nominal shape, datums, characteristics with their tolerances.
//!
//! ```text
//! part.toml ──Part::read──> Part { features with points and normals, characteristics }
//! deviations along the normals ──Part::evaluate──> one value for each characteristic
//! ```

mod characteristic;
mod datum;
mod feature;
mod file;
mod lines;
mod pattern;
mod values;

pub use characteristic::{Characteristic, Datum, Kind, Limits};
pub(crate) use feature::across;
pub use feature::{Extraction, Feature, Geometry, Sampled};

/// A checked part file.
#[derive(Debug, Clone, PartialEq)]
pub struct Part {
    /// Its name.
    pub name: String,
    /// Where its dimensions come from.
    pub source: String,
    /// In the order of the file.
    pub features: Vec<Feature>,
    /// What is judged, in the order of the file.
    pub characteristics: Vec<Characteristic>,
}

impl Part {
    /// All points of all features.
    pub fn points(&self) -> usize {
        self.features.iter().map(|f| f.points.len()).sum()
    }
}
