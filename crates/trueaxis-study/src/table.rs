//! The inputs and outputs of all samples as a table.

use crate::design::{Matrix, Place};
use crate::inputs::Varied;
use crate::study::Study;
use std::fmt::Write;
use std::path::Path;
use trueaxis::input::{Diagnostics, Place as Where};

/// Numbers beyond these make a table that no program opens.
const MOST_NUMBERS: usize = 20_000_000;

/// What keeps a table from being written.
pub fn check(study: &Study, path: &Path, problems: &mut Diagnostics) {
    let place = Where::whole("--table");
    let is_csv = path.extension().is_some_and(|e| e.eq_ignore_ascii_case("csv"));
    if !is_csv {
        let message = format!("`{}` is no table", path.display());
        problems.error("unknown-word", place, message, "--table NAME.csv");
        return;
    }
    let numbers = study.design.samples() * (study.inputs.len() + study.output_count());
    if numbers > MOST_NUMBERS {
        let message = format!("a table of {numbers} numbers");
        let hint = format!("at most {MOST_NUMBERS}: fewer --machines; or from Python, in pieces");
        problems.error("table-too-large", place, message, &hint);
    }
}

/// The unit of an input in its column: inner ones, so that nothing is rounded.
pub fn input_unit(varied: &Varied) -> &'static str {
    match varied {
        Varied::Value(errors) | Varied::Added(errors) => {
            if errors.iter().any(|e| e.component.is_rotation()) { "rad" } else { "mm" }
        }
        Varied::Scale(_) | Varied::Curve { .. } | Varied::Stated(_) => "1",
        Varied::Temperatures(_) => "degC",
        Varied::Log(_) => "s",
        Varied::Workpiece(_) | Varied::ToolLength => "mm",
        Varied::Setting(_) => "rad",
    }
}

/// `sample,combination,machine,day,matrix`, then the inputs with their units, then the outputs.
pub fn csv(study: &Study, values_mm: &[f64]) -> String {
    let mut text = String::from("sample,combination,machine,day,matrix");
    for input in &study.inputs {
        let _ =
            write!(text, ",{}", quoted(&format!("{} [{}]", input.name, input_unit(&input.varied))));
    }
    for key in study.output_keys() {
        let _ = write!(text, ",{}", quoted(&key));
    }
    text.push('\n');
    let inputs = study.inputs_of(0..study.design.samples());
    let rows = inputs.chunks(study.inputs.len()).zip(values_mm.chunks(study.output_count()));
    for (sample, (inputs, outputs)) in rows.enumerate() {
        let _ = match study.design.place(sample) {
            Place::Main { combination, machine, day } => {
                write!(text, "{},{},{},{},", sample + 1, combination + 1, machine + 1, day + 1)
            }
            Place::Row { row, matrix } => {
                let matrix = match matrix {
                    Matrix::A => "A".to_owned(),
                    Matrix::B => "B".to_owned(),
                    Matrix::Mixed(group) => quoted(&format!("A with {} of B", study.groups[group])),
                };
                write!(text, "{},,{},,{matrix}", sample + 1, row + 1)
            }
        };
        for number in inputs.iter().chain(outputs) {
            let _ = write!(text, ",{number}");
        }
        text.push('\n');
    }
    text
}

/// A cell that a spreadsheet takes for words.
fn quoted(words: &str) -> String {
    let safe = match words.starts_with(['=', '+', '-', '@']) {
        true => format!("'{words}"),
        false => words.to_owned(),
    };
    match safe.contains([',', '"', '\n']) {
        true => format!("\"{}\"", safe.replace('"', "\"\"")),
        false => safe,
    }
}
