//! `trueaxis schema`: the JSON documents of the program.

use crate::output::{Answer, Format, Outcome, show, tell};
use clap::Args;
use serde_json::Value;

/// Which document to describe.
#[derive(Args)]
#[command(after_help = "\
Examples:
  trueaxis schema
  trueaxis schema pose
  trueaxis schema --format json

Without a name all documents are listed, with one line each, or with --format json as one object. With a name its JSON Schema is printed:
every key with its type, its meaning and its unit. The key \"schema\" of a document has its name:
trueaxis/pose/1. Several forms of one document have names such as pose and pose-rows.
Exit status: 0 printed, 2 unknown name.")]
pub struct Arguments {
    /// The name of the document; without one all documents are listed
    name: Option<String>,
    /// Output as text or as one JSON document
    #[arg(long, value_enum, default_value = "text")]
    format: Format,
}

include!(concat!(env!("OUT_DIR"), "/schemas.rs"));

/// The schemas in docs/schemas by name.
fn schemas() -> impl Iterator<Item = (&'static str, Value)> {
    // why: the texts are those of files that a test compares with the types
    SCHEMAS.iter().map(|(name, text)| (*name, serde_json::from_str(text).unwrap_or_default()))
}

pub fn run(arguments: &Arguments) -> Outcome {
    let Some(wanted) = &arguments.name else {
        if arguments.format == Format::Json {
            let all = schemas().map(|(name, schema)| (name.to_owned(), schema));
            return show(&Answer::Json(Value::Object(all.collect())));
        }
        let width = SCHEMAS.iter().map(|(name, _)| name.len()).max().unwrap_or(0);
        let line = |schema: &Value| {
            let description = schema.get("description").and_then(|text| text.as_str());
            let first = description.unwrap_or_default().split_inclusive(". ").next();
            first.unwrap_or_default().trim_end().replace('\n', " ")
        };
        let lines = schemas().map(|(name, schema)| format!("{name:width$}  {}\n", line(&schema)));
        return show(&Answer::Text(lines.collect()));
    };
    match schemas().find(|(name, _)| name == wanted) {
        Some((_, schema)) => show(&Answer::Json(schema)),
        None => {
            let names: Vec<&str> = SCHEMAS.iter().map(|(name, _)| *name).collect();
            let names = names.join(", ");
            tell(&format!("error: unknown document `{wanted}`\n  hint: the documents are {names}"));
            Outcome::Unusable
        }
    }
}
