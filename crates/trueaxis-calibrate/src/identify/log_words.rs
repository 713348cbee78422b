//! Heading and words of the logs of probing programs.

use trueaxis_input::{Diagnostics, Dimension, Place, Unit};

/// Unit and frame.
pub(super) fn heading(
    kind: &str,
    rest: &str,
    place: &Place,
    problems: &mut Diagnostics,
) -> Option<Unit> {
    let words: Vec<&str> = rest.split_whitespace().collect();
    let hint = format!("TRUEAXIS {kind} MM MACHINE or TRUEAXIS {kind} INCH MACHINE");
    let hint = hint.as_str();
    let [unit, frame] = words[..] else {
        let message = "the heading does not say unit and frame".to_owned();
        problems.error("no-heading", place.clone(), message, hint);
        return None;
    };
    if frame != "MACHINE" {
        let message =
            format!("the positions are said to be those of `{frame}`, not of the machine");
        let hint =
            "write positions from the machine zero: work offset and tool length 0, heading MACHINE";
        problems.error("other-frame", place.clone(), message, hint);
        return None;
    }
    let name = if unit == "INCH" { "in".to_owned() } else { unit.to_ascii_lowercase() };
    match Unit::find(&name, Dimension::Length) {
        Ok(unit) => Some(unit),
        Err(e) => {
            problems.error(e.code(), place.clone(), e.to_string(), hint);
            None
        }
    }
}

/// Letters with numbers; blanks between them do not matter.
pub(super) fn words(line: &str) -> Result<Vec<(char, f64)>, String> {
    let mut found = Vec::new();
    let mut rest = line.trim_start();
    while let Some(letter) = rest.chars().next() {
        if !letter.is_ascii_alphabetic() {
            return Err(format!("`{}` does not begin with a letter", cut(rest)));
        }
        rest = rest[1..].trim_start().trim_start_matches('=').trim_start();
        let end =
            rest.find(|c: char| !(c.is_ascii_digit() || "+-.".contains(c))).unwrap_or(rest.len());
        let number = rest[..end].parse::<f64>().ok().filter(|v| v.is_finite());
        let Some(number) = number else {
            return Err(format!("no number stands after `{letter}`: `{}`", cut(rest)));
        };
        found.push((letter, number));
        rest = rest[end..].trim_start();
    }
    Ok(found)
}

fn cut(text: &str) -> String {
    text.chars().take(30).collect()
}
