//! The JSON Schemas of what the server sends and reads.

use crate::{answers, frame, refusal, socket};
use schemars::generate::SchemaSettings;
use trueaxis::report::named_schema;
use trueaxis::{JsonSchema, NamedSchema};

/// The JSON Schemas of what the server sends and reads, by name, such as `serve-pose` and `serve-pose-request`;
/// those of the documents in its answers stand in them, too.
pub fn schemas() -> Vec<NamedSchema> {
    let mut all: Vec<NamedSchema> = answers::QUESTIONS.iter().flat_map(|q| (q.schemas)()).collect();
    all.push(named_schema::<frame::ArrayEntry>("serve-array"));
    all.push(named_schema::<refusal::RefusedAnswer<'_>>("serve-refused"));
    all.push(named_schema::<socket::SocketAnswer<'_>>("serve-socket"));
    all.push(request_schema::<socket::SocketRequest>("serve-socket-request"));
    all.sort_by_key(|(name, _)| *name);
    all
}

/// The JSON Schema of what the server reads, under its name.
pub(crate) fn request_schema<R: JsonSchema>(name: &'static str) -> NamedSchema {
    let settings = SchemaSettings::draft2020_12().for_deserialize();
    (name, settings.into_generator().into_root_schema_for::<R>())
}
