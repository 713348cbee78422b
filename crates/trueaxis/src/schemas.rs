//! The JSON documents of the program with their JSON Schemas.

use crate::report::{
    CertificateDocument, CheckDocument, DescriptionDocument, DiagnosticEntry, DiffDocument,
    PoseDocument, PoseRowsDocument, PostDocument, SolveDocument, SolvePathDocument, TraceDocument,
    VerifyDocument,
};
use trueaxis_report::{NamedSchema, named_schema};

/// The JSON Schema of every document that the library makes, by name; several forms of one document have names
/// such as `pose` and `pose-rows`.
///
/// ```
/// let all = trueaxis::schemas();
/// let (_, check) = all.iter().find(|(name, _)| *name == "check").unwrap();
/// assert!(check.get("properties").is_some());
/// ```
pub fn schemas() -> Vec<NamedSchema> {
    let mut all = vec![
        named_schema::<CertificateDocument<'_>>("certificate"),
        named_schema::<CheckDocument<'_>>("check"),
        named_schema::<DescriptionDocument<'_>>("description"),
        named_schema::<DiagnosticEntry<'_>>("diagnostic"),
        named_schema::<DiffDocument<'_>>("diff"),
        named_schema::<PoseDocument>("pose"),
        named_schema::<PoseRowsDocument>("pose-rows"),
        named_schema::<PostDocument<'_>>("post"),
        named_schema::<SolveDocument>("solve"),
        named_schema::<SolvePathDocument>("solve-path"),
        named_schema::<TraceDocument<'_>>("trace"),
        named_schema::<VerifyDocument<'_>>("verify"),
    ];
    all.sort_by_key(|(name, _)| *name);
    all
}
