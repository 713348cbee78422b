//! The JSON documents of the program with their JSON Schemas.

use crate::explain::{ExplainDocument, ExplainListDocument};
use crate::questions::{ProbeProgramsDocument, RtcpProgramsDocument, VirtualPartDocument};
use crate::report::{
    BeforeAfterDocument, CertificateDocument, CheckDocument, DescriptionDocument, DiagnosticEntry,
    DiffDocument, ExpansionDocument, ExpansionsDocument, PartFileDocument, PoseDocument,
    PoseRowsDocument, PostDocument, RefusedDocument, SolveDocument, SolvePathDocument,
    TablesFoundDocument, TraceDocument, VerifyDocument, VerifyPartDocument,
};
use schemars::{JsonSchema, Schema, generate::SchemaSettings, json_schema};
use serde_json::Value;
use trueaxis_report::{NamedSchema, named_schema};

/// The JSON Schema of every document that the program prints, by name; several forms of one document have names
/// such as `pose` and `pose-rows`.
///
/// ```
/// let all = trueaxis::schemas();
/// let (_, check) = all.iter().find(|(name, _)| *name == "check").unwrap();
/// assert!(check.get("properties").is_some());
/// ```
pub fn schemas() -> Vec<NamedSchema> {
    let mut all = vec![
        named_schema::<BeforeAfterDocument<'_>>("before-after"),
        named_schema::<CertificateDocument<'_>>("certificate"),
        named_schema::<CheckDocument<'_>>("check"),
        named_schema::<DescriptionDocument<'_>>("description"),
        named_schema::<DiffDocument<'_>>("diff"),
        named_schema::<ExplainDocument>("explain"),
        named_schema::<ExplainListDocument>("explain-list"),
        named_schema::<ExpansionDocument<'_>>("identify-expansion"),
        named_schema::<ExpansionsDocument<'_>>("identify-expansions"),
        named_schema::<TablesFoundDocument<'_>>("identify-tables"),
        named_schema::<ProbeProgramsDocument<'_>>("identify-probe-programs"),
        named_schema::<RtcpProgramsDocument<'_>>("identify-rtcp-programs"),
        named_schema::<PartFileDocument<'_>>("part"),
        named_schema::<PoseDocument>("pose"),
        named_schema::<PoseRowsDocument>("pose-rows"),
        named_schema::<PostDocument<'_>>("post"),
        named_schema::<RefusedDocument<'_>>("refused"),
        named_schema::<SolveDocument>("solve"),
        named_schema::<SolvePathDocument>("solve-path"),
        named_schema::<TraceDocument<'_>>("trace"),
        named_schema::<VerifyDocument<'_>>("verify"),
        named_schema::<VerifyPartDocument<'_>>("verify-part"),
        named_schema::<VirtualPartDocument<'_>>("measure-part"),
    ];
    all.extend(trueaxis_measure::schemas());
    all.extend(trueaxis_calibrate::schemas());
    all.extend(trueaxis_rtcp::schemas());
    all.extend(trueaxis_thermal::schemas());
    all.extend(trueaxis_predict::schemas());
    all.extend(trueaxis_correct::schemas());
    all.extend(trueaxis_motion::schemas());
    all.extend(trueaxis_condition::schemas());
    all.extend(trueaxis_standards::schemas());
    all.iter_mut().for_each(|(_, schema)| add_diagnostics(schema));
    all.push(named_schema::<DiagnosticEntry<'_>>("diagnostic"));
    all.sort_by_key(|(name, _)| *name);
    all
}

/// The problems of the input, which the commands add to the documents of their answers.
pub fn add_diagnostics(schema: &mut Schema) {
    let settings = SchemaSettings::draft2020_12().for_serialize();
    let entry = DiagnosticEntry::json_schema(&mut settings.into_generator());
    let diagnostics = json_schema!({
        "description": "The problems found in the input; the command line prints them on standard error, too.",
        "type": "array",
        "items": entry,
    });
    if let Some(Value::Object(properties)) = schema.get_mut("properties") {
        properties.entry("diagnostics").or_insert(diagnostics.into());
    }
}
