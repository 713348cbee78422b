//! `trueaxis schema`: the JSON documents of the program.

use crate::output::{Answer, Format, Outcome, show, tell};
use clap::Args;
use serde_json::Value;
use trueaxis::Schema;

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

/// Those of the library, of live runs, of studies of many machines and of new folders, by name.
fn schemas() -> Vec<(&'static str, Schema)> {
    let mut all = trueaxis::schemas();
    all.extend(trueaxis_live::schemas());
    all.extend(trueaxis_study::schemas());
    all.extend(trueaxis_templates::schemas());
    all.sort_by_key(|(name, _)| *name);
    all
}

pub fn run(arguments: &Arguments) -> Outcome {
    let all = schemas();
    let Some(wanted) = &arguments.name else {
        if arguments.format == Format::Json {
            let all = all.into_iter().map(|(name, schema)| (name.to_owned(), schema.into()));
            return show(&Answer::Json(Value::Object(all.collect())));
        }
        let width = all.iter().map(|(name, _)| name.len()).max().unwrap_or(0);
        let line = |schema: &trueaxis::Schema| {
            let description = schema.get("description").and_then(|text| text.as_str());
            let first = description.unwrap_or_default().split_inclusive(". ").next();
            first.unwrap_or_default().trim_end().replace('\n', " ")
        };
        let lines = all.iter().map(|(name, schema)| format!("{name:width$}  {}\n", line(schema)));
        return show(&Answer::Text(lines.collect()));
    };
    match all.into_iter().find(|(name, _)| name == wanted) {
        Some((_, schema)) => show(&Answer::Json(schema.into())),
        None => {
            let names: Vec<&str> = schemas().iter().map(|(name, _)| *name).collect();
            let names = names.join(", ");
            tell(&format!("error: unknown document `{wanted}`\n  hint: the documents are {names}"));
            Outcome::Unusable
        }
    }
}
