//! The JSON documents of the program with their JSON Schemas.

use crate::report::{CheckDocument, DiagnosticEntry};
use trueaxis_report::{NamedSchema, named_schema};

/// The JSON Schema of every document that the library makes, by name.
///
/// ```
/// let all = trueaxis::schemas();
/// let (_, check) = all.iter().find(|(name, _)| *name == "check").unwrap();
/// assert!(check.get("properties").is_some());
/// ```
pub fn schemas() -> Vec<NamedSchema> {
    let mut all = vec![
        named_schema::<CheckDocument<'_>>("check"),
        named_schema::<DiagnosticEntry<'_>>("diagnostic"),
    ];
    all.sort_by_key(|(name, _)| *name);
    all
}
