//! The log of a probing program, as the controls write it.
//!
//! ```text
//!     TRUEAXIS HITS MM MACHINE
//!     H1 K1 T1 X12.3456 Y-3.0000 Z80.1234 A-30.00000 C45.00000
//!     END 71
//! ```

use crate::identify::log_words::{heading, words};
use trueaxis_input::{Diagnostics, Place, Unit};
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{AxisKind, Command};

/// More hits than these are a slip.
const MOST_HITS: usize = 20_000;
/// No more faults than these are named one by one.
const MOST_REPORTED: usize = 20;
const FORM: &str = "such as: H1 K1 T1 X12.3456 Y-3.0000 Z80.1234 A-30.00000 C45.00000";

/// One hit of a log.
#[derive(Debug, Clone, PartialEq)]
pub struct LoggedHit {
    /// Its number, from 1.
    pub hit: usize,
    /// The number of the point or pose, from 1.
    pub point: usize,
    /// The tool that was in the spindle.
    pub tool: Option<usize>,
    /// The axes when the probe triggered.
    pub command: Command,
    /// Its line.
    pub place: Place,
}

/// A log that was read.
#[derive(Debug, Clone, PartialEq)]
pub struct HitsLog {
    /// The hits in the order of the file.
    pub hits: Vec<LoggedHit>,
    /// How many hits there were, as the end of the log says; none: it has no end.
    pub end: Option<usize>,
    /// Whether a virtual machine wrote it.
    pub is_virtual: bool,
    /// The length unit in the heading, as it stands there.
    pub unit: String,
}

/// Reads a log; `None` with errors among the problems.
pub fn parse_log(
    file: &str,
    text: &str,
    machine: &Machine,
    problems: &mut Diagnostics,
) -> Option<HitsLog> {
    let mut log = HitsLog { hits: Vec::new(), end: None, is_virtual: false, unit: String::new() };
    let mut unit = None;
    let mut faults = 0;
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    for (i, line) in text.lines().enumerate() {
        let place = Place { file: file.to_owned(), line: i + 1, column: 1 };
        let line = line.trim_matches(|c: char| c.is_whitespace() || c.is_control());
        if line.starts_with('#') && line.contains("virtual") {
            log.is_virtual = true;
        }
        if line.is_empty() || line.starts_with(['#', '%', ';', '(']) {
            continue;
        }
        let upper = line.to_ascii_uppercase();
        if let Some(rest) = upper.strip_prefix("TRUEAXIS HITS") {
            if unit.is_some() {
                let message = "a second heading: two logs stand in one file".to_owned();
                problems.error("two-logs", place, message, "keep one log in each file");
                return None;
            }
            unit = Some(heading("HITS", rest, &place, problems)?);
            log.unit = rest.split_whitespace().next().unwrap_or_default().to_ascii_lowercase();
            continue;
        }
        if let Some(rest) = upper.strip_prefix("END") {
            log.end = rest.trim().parse::<f64>().ok().map(|n| n.max(0.0) as usize);
            continue;
        }
        let Some(unit) = unit else {
            let message =
                "the log does not begin with its heading: unit and frame are not known".to_owned();
            let hint =
                "the first line is TRUEAXIS HITS MM MACHINE (or INCH), as the programs write it";
            problems.error("no-heading", place, message, hint);
            return None;
        };
        match hit(&upper, unit, machine, &place) {
            Ok(hit) => log.hits.push(hit),
            Err((code, message)) => {
                faults += 1;
                problems.error(code, place, message, FORM);
                if faults == MOST_REPORTED {
                    return None;
                }
            }
        }
        if log.hits.len() > MOST_HITS {
            let message = format!("more than {MOST_HITS} hits");
            problems.error("too-many-hits", Place::whole(file), message, "is this the log?");
            return None;
        }
    }
    if log.hits.is_empty() && faults == 0 {
        let message = "the log has no hit".to_owned();
        problems.error("too-few-hits", Place::whole(file), message, FORM);
    }
    (faults == 0 && !log.hits.is_empty()).then_some(log)
}

fn hit(
    line: &str,
    unit: Unit,
    machine: &Machine,
    place: &Place,
) -> Result<LoggedHit, (&'static str, String)> {
    let words = words(line).map_err(|message| ("unknown-line", message))?;
    if let Some((letter, _)) = words
        .iter()
        .enumerate()
        .find(|(i, w)| words[..*i].iter().any(|o| o.0 == w.0))
        .map(|(_, w)| w)
    {
        return Err(("duplicate-word", format!("`{letter}` stands twice in the line")));
    }
    let find = |letter: char| words.iter().find(|w| w.0 == letter).map(|w| w.1);
    let whole = |letter: char| {
        let value = find(letter);
        let whole =
            value.filter(|v| v.fract() == 0.0 && (0.0..1e9).contains(v)).map(|v| v as usize);
        match (value, whole) {
            (Some(v), None) => Err(("bad-count", format!("`{letter}{v}` is no whole number"))),
            (_, found) => Ok(found),
        }
    };
    let need = |letter: char, what: &str| {
        let missing = ("missing-word", format!("the line has no `{letter}`, {what}"));
        whole(letter)?.filter(|n| *n > 0).ok_or(missing)
    };
    let (hit, point) = (need('H', "the number of the hit")?, need('K', "the number of the point")?);
    let mut command = Command::default();
    for (q, axis) in command.iter_mut().zip(machine.axes()) {
        let letter = axis.name.letter();
        let value = find(letter).ok_or_else(|| {
            let message = format!("the line has no position of the axis {letter}");
            ("missing-word", message)
        })?;
        *q = match axis.kind {
            AxisKind::Linear => unit.checked(value).map_err(|e| (e.code(), e.to_string()))?,
            AxisKind::Rotary => value.to_radians(),
        };
        if q.is_nan() || q.abs() >= 1e6 {
            return Err(("too-large", format!("{letter}{value} is on no machine")));
        }
    }
    let axes = || machine.axes().iter().map(|a| a.name.letter());
    if let Some((letter, _)) =
        words.iter().find(|w| !"HKT".contains(w.0) && !axes().any(|a| a == w.0))
    {
        return Err(("unknown-axis", format!("the machine has no axis {letter}")));
    }
    Ok(LoggedHit { hit, point, tool: whole('T')?, command, place: place.clone() })
}
