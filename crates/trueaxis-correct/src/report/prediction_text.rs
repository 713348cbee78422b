//! What the terminal shows.

use crate::predict::{Decision, Prediction, Share, Study};
use crate::report::decisive;
use crate::report::feature;
use crate::report::ranked;
use crate::report::relief;
use std::fmt::Write;
use trueaxis_machine::describe::command_words;
use trueaxis_machine::errors::ErrorKind;
use trueaxis_part::tolerance::{Judgement, Outcome};

/// How many errors the error budget shows.
const BLAMED: usize = 8;
/// How many corrections are shown.
const CORRECTIONS: usize = 5;

/// The prediction as a table with the verdict, the error budget and the corrections.
pub fn text(study: &Study, prediction: &Prediction) -> String {
    let mut out = String::new();
    header(&mut out, study, prediction);
    index_table(&mut out, prediction);
    verdict(&mut out, prediction);
    blame_table(&mut out, prediction);
    correction_table(&mut out, prediction);
    variant_table(&mut out, prediction);
    for warning in &prediction.warnings {
        line(&mut out, &format!("warning: {warning}"));
    }
    out
}

// Writing to a String cannot fail.
fn line(out: &mut String, text: &str) {
    let _ = writeln!(out, "{}", text.trim_end());
}

fn header(out: &mut String, study: &Study, prediction: &Prediction) {
    let machine = &study.machine;
    line(out, &study.name);
    line(out, &format!("  machine  {}   {}", machine.name(), machine.chain_text()));
    line(out, &format!("  part     {}", study.test_piece.name));
    if !study.what_if.is_empty() {
        line(out, &format!("  what if  {}", study.what_if.join(", ")));
    }
    let words = command_words(machine.axes(), &prediction.setting_command);
    line(out, &format!("  zero set at  {words}"));
    if let Decision::Guarded { coverage } = study.decision {
        line(out, &format!("  verdict by ISO 14253-1 with U = {coverage} u"));
    }
    line(out, "");
}

fn index_table(out: &mut String, prediction: &Prediction) {
    let monte_carlo = prediction.indices.iter().any(|i| i.spread.is_some());
    let heads = if monte_carlo { "u (MC)" } else { "" };
    line(
        out,
        &format!(
            "{:<34}{:>9}{:>8}{heads:>8}{:>9}{:>7}",
            "all in µm", "value", "u", "allowed", "used"
        ),
    );
    for index in &prediction.indices {
        let judged = judgement(prediction, index.name.key);
        let spread = index.spread.map_or(String::new(), |s| format!("{:.2}", s.u_mm * 1e3));
        let (allowed, used, word) = match judged {
            None => (String::new(), String::new(), ""),
            Some(j) => (
                format!("{:.1}", j.limit_mm * 1e3),
                format!("{:.0} %", j.used_ratio * 100.0),
                word(j.outcome),
            ),
        };
        let text = format!(
            "{:<34}{:>9.2}{:>8.2}{spread:>8}{allowed:>9}{used:>7}  {word}",
            index.name.title(),
            index.value_mm * 1e3,
            index.u_mm * 1e3
        );
        line(out, &text);
    }
    line(out, "");
}

fn judgement<'a>(prediction: &'a Prediction, key: &str) -> Option<&'a Judgement> {
    prediction.verdict.judgements.iter().find(|j| j.index.key == key)
}

fn word(outcome: Outcome) -> &'static str {
    match outcome {
        Outcome::Pass => "pass",
        Outcome::Fail => "FAIL",
        Outcome::Undecided => "undecided",
    }
}

fn verdict(out: &mut String, prediction: &Prediction) {
    let text = match prediction.verdict.outcome {
        Outcome::Pass => "PASS: the part will be in tolerance",
        Outcome::Fail => "FAIL: the part will be out of tolerance",
        Outcome::Undecided => "UNDECIDED: the tolerance lies within the uncertainty",
    };
    line(out, text);
    line(out, "");
}

/// Side by side for every decisive index: the errors that matter most, then the groups.
fn blame_table(out: &mut String, prediction: &Prediction) {
    if prediction.blame.errors.is_empty() {
        return;
    }
    line(
        out,
        "error budget, µm (alone: this error only; gain: what the index loses without it; negative: it compensates others)",
    );
    let mut head = String::from("  ");
    for (_, index) in decisive(prediction) {
        let _ = write!(head, "{:<10}{:>7}{:>7}    ", feature(&index.name), "alone", "gain");
    }
    line(out, &head);
    for rank in 0..BLAMED.min(prediction.blame.errors.len()) {
        let mut text = String::from("  ");
        for (i, _) in decisive(prediction) {
            let ranked = ranked(prediction, i, &prediction.blame.errors, BLAMED);
            text += &share_cell(prediction, i, ranked[rank], &ranked[rank].of.to_string());
        }
        line(out, &text);
    }
    for share in &prediction.blame.kinds {
        let word = match share.of {
            ErrorKind::Location => "location",
            ErrorKind::Motion => "motion",
        };
        group_line(out, prediction, share, word);
    }
    for share in &prediction.blame.bodies {
        group_line(out, prediction, share, &format!("all {}", share.of));
    }
    line(out, "");
}

fn share_cell<T>(prediction: &Prediction, index: usize, share: &Share<T>, name: &str) -> String {
    let gain = relief(prediction, index, share) * 1e3;
    // + 0.0: no minus before a zero.
    let tenth = |v: f64| (v * 10.0).round() / 10.0 + 0.0;
    let (alone, gain) = (tenth(share.alone_mm[index] * 1e3), tenth(gain));
    format!("{name:<10}{alone:>7.1}{gain:>+7.1}    ")
}

fn group_line<T>(out: &mut String, prediction: &Prediction, share: &Share<T>, name: &str) {
    let cells: String =
        decisive(prediction).map(|(i, _)| share_cell(prediction, i, share, name)).collect();
    line(out, &format!("  {cells}"));
}

fn correction_table(out: &mut String, prediction: &Prediction) {
    if prediction.verdict.outcome == Outcome::Pass {
        return;
    }
    if prediction.corrections.is_empty() {
        line(out, "no single location error can be corrected so that the part passes");
        line(out, "");
        return;
    }
    line(out, "one correction that would do (the smallest first; 1 µrad counts as 1 µm):");
    for correction in prediction.corrections.iter().take(CORRECTIONS) {
        let (size, unit) = match correction.error.component.is_rotation() {
            true => (correction.change * 1e6, "µrad"),
            false => (correction.change * 1e3, "µm"),
        };
        line(out, &format!("  shim {} by {size:+.1} {unit}", correction.error));
    }
    line(out, "");
}

fn variant_table(out: &mut String, prediction: &Prediction) {
    if prediction.variants.is_empty() {
        return;
    }
    let mut head = format!("{:<52}", "the same part, µm");
    for (_, index) in decisive(prediction) {
        let _ = write!(head, "{:>12}", feature(&index.name));
    }
    line(out, &head);
    let mut row = |name: &str, values: &dyn Fn(usize) -> f64| {
        let mut text = format!("  {name:<50}");
        for (i, _) in decisive(prediction) {
            let _ = write!(text, "{:>12.1}", values(i) * 1e3);
        }
        line(out, &text);
    };
    row("as studied", &|i| prediction.indices[i].value_mm);
    for variant in &prediction.variants {
        row(&variant.name, &|i| variant.indices_mm[i]);
    }
    line(out, "");
}
