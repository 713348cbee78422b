//! `trueaxis explain`: what a diagnostic means, why it comes and what to do.

use crate::output::{Answer, Format, Outcome, show, tell};
use clap::Args;
use trueaxis::explain::{codes_json, codes_report, explanation_json, explanations, nearest};

/// Which code to explain.
#[derive(Args)]
#[command(after_help = "\
Examples:
  trueaxis explain table-too-short
  trueaxis explain
  trueaxis explain arc-does-not-fit --format json

The code is the word in brackets of a message: error[table-too-short]: …
Without a code all of them are listed, with one line each.
Exit status: 0 explained, 2 unknown code.")]
pub struct Arguments {
    /// The code; without one all codes are listed
    code: Option<String>,
    /// Output as text or as one JSON document
    #[arg(long, value_enum, default_value = "text")]
    format: Format,
}

pub fn run(arguments: &Arguments) -> Outcome {
    let all = explanations();
    let Some(code) = &arguments.code else {
        return show(&match arguments.format {
            Format::Text => Answer::Text(codes_report(&all).text()),
            Format::Json => Answer::Json(codes_json(&all)),
        });
    };
    // People copy the brackets, too.
    let wanted = code.trim_matches(|c: char| !c.is_ascii_lowercase());
    let Some(found) = all.iter().find(|e| e.code == wanted || e.code == code) else {
        let near = nearest(code, &all).join(", ");
        tell(&format!("error: unknown diagnostic `{code}`\n  hint: similar codes are {near}"));
        return Outcome::Unusable;
    };
    show(&match arguments.format {
        Format::Text => Answer::Text(format!("{}\n\n{}\n", found.code, found.text)),
        Format::Json => Answer::Json(explanation_json(found)),
    })
}
