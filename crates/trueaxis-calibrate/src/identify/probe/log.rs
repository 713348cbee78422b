//! The logs of the programs of a probe, as the controls write them.
//!
//! ```text
//!     TRUEAXIS RING MM MACHINE                                    or … CORRECTED: each hit less the table
//!     H1 T5 D6.00000 S0.00000 X149.0206 Y83.0340 Z-210.0000      D direction of motion, S orientation of the spindle
//!     RESULT X0.0035 Y-0.0020 U3.9650 V3.9642                     what the control made of them; not read
//!     END 60
//! ```
//!
//! A plane face: `TRUEAXIS PLANE MM MACHINE`, `H1 T5 Z-120.0125`.

use super::hit::Hit;
use crate::identify::log_words::{heading, words};
use trueaxis_geometry::Vec3;
use trueaxis_input::{Diagnostics, Place, Unit};

/// No more faults than these are named one by one.
const MOST_REPORTED: usize = 20;
/// Directions nearer than this are one, degrees.
const SAME_DEG: f64 = 0.01;
/// Planned and logged direction may differ by this, degrees.
const OFF_DEG: f64 = 0.05;
const RING_FORM: &str = "such as: H1 T5 D6.00000 S0.00000 X149.0206 Y83.0340 Z-210.0000";
const PLANE_FORM: &str = "such as: H1 T5 Z-120.0125";

/// What the program was to make.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Planned {
    /// Hits; around a ring as many even directions.
    pub hits: usize,
    /// The tool of `[program]`.
    pub tool: Option<u32>,
}

/// A log that was read.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct ProbeLog {
    /// The hits in order. On a face the direction is −z.
    pub hits: Vec<Hit>,
    /// Whether the control took its table off each of them.
    pub is_corrected: bool,
}

/// Whether a table is a log of a ring.
pub(super) fn is_ring_log(text: &str) -> bool {
    let text = text.trim_start_matches('\u{feff}');
    let mut lines =
        text.lines().map(str::trim).filter(|l| !l.is_empty() && !l.starts_with(['#', '%']));
    lines.next().is_some_and(|l| {
        let upper = l.to_ascii_uppercase();
        // A hit whose heading is missing is one all the same: it is said then.
        let hit =
            upper.strip_prefix('H').is_some_and(|r| r.starts_with(|c: char| c.is_ascii_digit()));
        upper.starts_with("TRUEAXIS") || hit
    })
}

/// Reads a log of hits in a ring; `None` with errors among the problems.
pub(super) fn parse_ring_log(
    file: &str,
    text: &str,
    planned: Option<Planned>,
    problems: &mut Diagnostics,
) -> Option<ProbeLog> {
    let log = parse(file, text, ("RING", RING_FORM), planned, problems)?;
    let mut found = Diagnostics::new();
    doubled(&log.hits, &mut found);
    if let Some(planned) = planned.filter(|_| !found.has_errors()) {
        uneven(&log.hits, planned.hits, &mut found);
    }
    let sound = !found.has_errors();
    problems.append(found);
    sound.then_some(log)
}

/// Reads a log of hits on a plane face; `None` with errors among the problems.
pub(super) fn parse_plane_log(
    file: &str,
    text: &str,
    planned: Option<Planned>,
    problems: &mut Diagnostics,
) -> Option<ProbeLog> {
    parse(file, text, ("PLANE", PLANE_FORM), planned, problems)
}

fn parse(
    file: &str,
    text: &str,
    (kind, form): (&str, &str),
    planned: Option<Planned>,
    problems: &mut Diagnostics,
) -> Option<ProbeLog> {
    let mut log = ProbeLog { hits: Vec::new(), is_corrected: false };
    let (mut unit, mut end, mut faults) = (None, None, 0);
    for (i, line) in text.trim_start_matches('\u{feff}').lines().enumerate() {
        let place = Place { file: file.to_owned(), line: i + 1, column: 1 };
        let line = line.trim_matches(|c: char| c.is_whitespace() || c.is_control());
        if line.is_empty() || line.starts_with(['#', '%', ';', '(']) {
            continue;
        }
        let upper = line.to_ascii_uppercase();
        if let Some(rest) = upper.strip_prefix("TRUEAXIS") {
            if unit.is_some() {
                let message = "a second heading: two logs stand in one file".to_owned();
                problems.error("two-logs", place, message, "keep one log in each file");
                return None;
            }
            let Some(rest) = rest.trim().strip_prefix(kind) else {
                let message = format!("this is the log of other hits: {}", rest.trim());
                let hint = format!("here TRUEAXIS {kind} MM MACHINE is due");
                problems.error("other-log", place, message, &hint);
                return None;
            };
            let rest = rest.trim();
            log.is_corrected = rest.ends_with("CORRECTED");
            unit = Some(heading(kind, rest.trim_end_matches("CORRECTED"), &place, problems)?);
        } else if let Some(rest) = upper.strip_prefix("END") {
            end = rest.trim().parse::<f64>().ok().map(|n| n.max(0.0) as usize);
        } else if upper.starts_with("RESULT") {
            continue;
        } else if let Some(unit) = unit {
            match hit(&upper, unit, kind == "RING", (log.hits.len() + 1, planned), &place) {
                Ok(hit) => log.hits.push(hit),
                Err((code, message)) => {
                    faults += 1;
                    let hint = match code {
                        "lost-hits" => "run the program again; was a line taken out?",
                        "hits-out-of-order" => {
                            "a row that was moved or copied, or two runs in one log?"
                        }
                        "other-tool" => "was another tool in the spindle? `tool` of [program]",
                        "missing-tool" => {
                            "T with the number of the tool, if the probe was in the spindle"
                        }
                        _ => form,
                    };
                    problems.error(code, place, message, hint);
                    // A hit that is missing displaces all that follow.
                    if faults == MOST_REPORTED || matches!(code, "lost-hits" | "hits-out-of-order")
                    {
                        return None;
                    }
                }
            }
        } else {
            let message = "the log does not begin with its heading: unit and frame are not known";
            let hint =
                format!("the first line is TRUEAXIS {kind} MM MACHINE, as the programs write it");
            problems.error("no-heading", place, message.to_owned(), &hint);
            return None;
        }
        if log.hits.len() > super::MOST_HITS {
            let message = format!("more than {} hits", super::MOST_HITS);
            problems.error("too-many-hits", Place::whole(file), message, "is this the log?");
            return None;
        }
    }
    let sound = faults == 0 && is_whole(file, &log, end, planned, problems);
    sound.then_some(log)
}

/// Whether as many hits are there as the end of the log and the plan say.
fn is_whole(
    file: &str,
    log: &ProbeLog,
    end: Option<usize>,
    planned: Option<Planned>,
    problems: &mut Diagnostics,
) -> bool {
    let found = log.hits.len();
    let place = log.hits.last().map_or(Place::whole(file), |h| h.place.clone());
    let (code, message, hint) = match (end, planned) {
        (None, _) => (
            "lost-hits",
            format!("the log has {found} hits and no end (END): the program was stopped"),
            "run the program again",
        ),
        (Some(end), _) if end != found => (
            "lost-hits",
            format!("the log has {found} hits, its end says {end}"),
            "were lines taken out? run the program again",
        ),
        (_, Some(planned)) if planned.hits != found => (
            "other-directions",
            format!("the log has {found} hits, {} are planned", planned.hits),
            "is this the log of another program? state directions of [program] as they were made",
        ),
        _ => return true,
    };
    problems.error(code, place, message, hint);
    false
}

fn hit(
    line: &str,
    unit: Unit,
    is_ring: bool,
    (due, planned): (usize, Option<Planned>),
    place: &Place,
) -> Result<Hit, (&'static str, String)> {
    let words = words(line).map_err(|message| ("unknown-line", message))?;
    let letters = if is_ring { "HTDSXYZE" } else { "HTZ" };
    for (i, (letter, _)) in words.iter().enumerate() {
        if words[..i].iter().any(|o| o.0 == *letter) {
            return Err(("duplicate-word", format!("`{letter}` stands twice in the line")));
        }
        if !letters.contains(*letter) {
            return Err(("unknown-line", format!("`{letter}` is no word of this log")));
        }
    }
    let find = |letter: char| words.iter().find(|w| w.0 == letter).map(|w| w.1);
    let need = |letter: char, what: &str| {
        find(letter).ok_or_else(|| ("missing-word", format!("the line has no `{letter}`, {what}")))
    };
    let number = need('H', "the number of the hit")?;
    if number > due as f64 {
        return Err(("lost-hits", format!("hit {due} is missing: hit {number} stands here")));
    }
    if number != due as f64 {
        return Err(("hits-out-of-order", format!("hit {number} stands where hit {due} is due")));
    }
    if let Some(tool) = planned.and_then(|p| p.tool) {
        let found = find('T').ok_or_else(|| {
            ("missing-tool", format!("hit {number} does not say with which tool (T)"))
        })?;
        if found != f64::from(tool) {
            let message =
                format!("hit {number} was made with tool {found}, the probe is tool {tool}");
            return Err(("other-tool", message));
        }
    }
    let length = |letter: char| {
        let value = need(letter, "a position of the spindle")?;
        let mm = unit.checked(value).map_err(|e| (e.code(), e.to_string()))?;
        match mm.is_finite() && mm.abs() < 1e6 {
            true => Ok(mm),
            false => Err(("too-large", format!("{letter}{value} is on no machine"))),
        }
    };
    let place = place.clone();
    if !is_ring {
        let spindle_mm = Vec3::new(0.0, 0.0, length('Z')?);
        return Ok(Hit { spindle_mm, direction: -Vec3::z(), orientation_rad: 0.0, place });
    }
    let angle = need('D', "the direction of motion in degrees")?;
    let orientation = need('S', "the orientation of the spindle in degrees")?;
    if angle.abs() > 720.0 || orientation.abs() > 720.0 {
        return Err(("too-large", format!("D{angle} S{orientation} are no directions in degrees")));
    }
    let (s, c) = angle.to_radians().sin_cos();
    Ok(Hit {
        // A ring says nothing along its axis.
        spindle_mm: Vec3::new(length('X')?, length('Y')?, 0.0),
        direction: Vec3::new(c, s, 0.0),
        orientation_rad: orientation.to_radians(),
        place,
    })
}

fn degrees(hit: &Hit) -> f64 {
    hit.direction.y.atan2(hit.direction.x).to_degrees().rem_euclid(360.0)
}

/// The shorter way between two directions, degrees.
fn apart(a: f64, b: f64) -> f64 {
    let d = (a - b).rem_euclid(360.0);
    d.min(360.0 - d)
}

/// A program touches each direction once.
fn doubled(hits: &[Hit], problems: &mut Diagnostics) {
    let mut reported = 0;
    for (i, hit) in hits.iter().enumerate() {
        let first = hits[..i].iter().find(|o| apart(degrees(o), degrees(hit)) < SAME_DEG);
        if let Some(first) = first.filter(|_| reported < MOST_REPORTED) {
            reported += 1;
            let message = format!(
                "the direction {:.3} deg stands twice, first in line {}",
                degrees(hit),
                first.place.line
            );
            let hint = "two runs in one log, or a row that was copied? one log for each run";
            problems.error("doubled-direction", hit.place.clone(), message, hint);
        }
    }
}

/// Whether the directions are those of so many even steps.
fn uneven(hits: &[Hit], count: usize, problems: &mut Diagnostics) {
    let step = 360.0 / count as f64;
    let off = |h: &&Hit| {
        let place = degrees(h) / step;
        (place - place.round()).abs() * step > OFF_DEG
    };
    if let Some(hit) = hits.iter().find(off) {
        let message = format!(
            "the direction {:.3} deg is none of {count} even ones, {step:.3} deg apart",
            degrees(hit)
        );
        let hint =
            "is this the log of another program? state directions of [program] as they were made";
        problems.error("other-directions", hit.place.clone(), message, hint);
    }
}
