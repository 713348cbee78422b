//! Any bytes as readings and as the conditions beside them, by all standards: never a panic; either
//! figures or an error that says why, and no figure that is no number.
//!
//! `scripts/fuzz evaluation_sheet 120`

#![no_main]

use libfuzzer_sys::fuzz_target;
use trueaxis::input::Diagnostics;
use trueaxis::report::{Evaluation, EvaluationDocument, document, evaluation_report};
use trueaxis::verify::conditions::Conditions;
use trueaxis::verify::import::{From, Import};
use trueaxis::verify::{Request, Standard, evaluate};

fuzz_target!(|data: &[u8]| {
    let Ok(text) = std::str::from_utf8(data) else { return };
    // The conditions stand behind a line of ===.
    let (table, beside) = text.split_once("\n===\n").unwrap_or((text, ""));
    let (conditions, _) = Conditions::read("c.toml", beside);
    for standard in Standard::ALL {
        for import in Import::ALL {
            let mut problems = Diagnostics::new();
            let source =
                From { standard, file: "t.csv", text: table, feature: None, mapping: None };
            let Some(data) = import.read(&source, &mut problems) else {
                assert!(problems.has_errors());
                continue;
            };
            let conditions = data.conditions(&conditions);
            let request = Request {
                standard,
                file: "t.csv",
                text: data.table(),
                conditions: &conditions,
                conditions_file: "c.toml",
                window_s: 3600.0,
            };
            let evaluated = evaluate(&request, &mut problems);
            assert!(evaluated.is_some() || problems.has_errors());
            let Some(mut evaluated) = evaluated else { continue };
            data.finish(&mut evaluated, "t.csv", &mut problems);
            let shown = Evaluation {
                standard,
                file: "t.csv",
                conditions: &conditions,
                evaluated: &evaluated,
                remarks: &[],
                judged: &[],
            };
            assert!(!evaluation_report(&shown).text().contains("NaN"));
            assert!(document(&EvaluationDocument::of(&shown)).is_object());
        }
    }
});
