//! A control at a bench: the written programs are executed by the interpreters, and a virtual probe says where each
//! touch triggers.
//!
//! No interpreter simulates a workpiece. So the end of every touch is rewritten to the place where the virtual probe
//! triggers (FANUC: 0.01 mm beyond it, as far before the end its interpreter takes the signal to come; HEIDENHAIN: the
//! results of the cycle). All else, above all the correction, is executed as it was written. Where an interpreter does
//! not say what goes into a log (WRITE, FN 16), the values are carried out as the ends of moves.

use std::collections::BTreeMap;
use trueaxis::identify::probe::program::ProbeFile;
use trueaxis::nc::moves::Event;
use trueaxis::nc::{Control, Library, Program, Settings, Step, interpret};

/// Where a touch from the way `from_deg` triggers: x, y, z.
pub type Trigger<'a> = &'a mut dyn FnMut(&Touched) -> [f64; 3];

/// A touch as the program asks for it.
#[derive(Debug, Clone, Copy)]
pub struct Touched {
    /// The planned end; NaN where the words do not say it.
    pub to_mm: [f64; 3],
    /// Its direction in the plane, if the words say it.
    pub angle_rad: Option<f64>,
}

pub struct Files<'a>(pub &'a [ProbeFile]);

impl Library for Files<'_> {
    fn text(&self, name: &str) -> Result<Vec<u8>, String> {
        let stem = |n: &str| n.to_ascii_lowercase().split('.').next().unwrap_or("").to_owned();
        let found = self.0.iter().find(|f| stem(&f.name) == stem(name));
        found.map(|f| f.text.clone()).ok_or_else(|| format!("no {name}"))
    }
}

fn text_of<'a>(files: &'a [ProbeFile], name: &str) -> &'a str {
    let file = files.iter().find(|f| f.name == name).unwrap_or_else(|| panic!("no file {name}"));
    std::str::from_utf8(&file.text).expect("text")
}

/// The log that a program writes if every touch triggers where the interpreter takes it to: at its end.
pub fn log_as_written(files: &[ProbeFile], name: &str, control: Control) -> String {
    let program = Program::new(name, text_of(files, name).as_bytes().to_vec(), control);
    let mut logged = Vec::new();
    let outcome = interpret(&program, &Files(files), &Settings::default(), &mut |step| {
        if let Step::Event(Event::Log(text), _) = step {
            logged.push(text);
        }
    });
    assert!(outcome.finished, "{name}");
    logged.join("\n") + "\n"
}

/// The log that a program writes.
pub fn log(files: &[ProbeFile], name: &str, control: Control, trigger: Trigger<'_>) -> String {
    let text = text_of(files, name);
    let (rewritten, lines) = match control {
        Control::Fanuc | Control::Haas | Control::LinuxCnc => {
            (g_code(text, control, trigger), None)
        }
        Control::Sinumerik840d => {
            let (text, lines) = sinumerik(text, trigger);
            (text, Some(lines))
        }
        Control::Heidenhain => {
            let (text, lines) = klartext(files, text, trigger);
            (text, Some(lines))
        }
    };
    let program = Program::new(name, rewritten.into_bytes(), control);
    let (mut logged, mut ends) = (Vec::new(), Vec::new());
    let outcome =
        interpret(&program, &Files(files), &Settings::default(), &mut |step| match step {
            Step::Move(m) => ends.push([m.target.0[0], m.target.0[1], m.target.0[2]]),
            Step::Event(Event::Log(text), _) => logged.push(text),
            Step::Event(..) => {}
        });
    let told: Vec<String> = outcome.problems.iter().map(ToString::to_string).collect();
    assert!(outcome.finished && !outcome.problems.has_errors(), "{name}: {told:?}");
    match lines {
        None => logged.join("\n") + "\n",
        Some(lines) => carried(&lines, &ends),
    }
}

/// A line of a log: pieces of text, and decimals of the value after each but the last (`None`: all).
struct Line(Vec<(String, Option<Option<usize>>)>);

/// What is added to a value so that it is found again among the ends of moves.
const MARK: f64 = 50_000.0;

/// Lines with the values that were carried out, three at once, marked.
fn carried(lines: &[Line], ends: &[[f64; 3]]) -> String {
    let mut values = ends.iter().filter(|e| e.iter().all(|v| *v > 0.5 * MARK)).flatten();
    let mut text = String::new();
    for Line(pieces) in lines {
        let mut count = 0;
        for (piece, decimals) in pieces {
            text += piece;
            let Some(decimals) = decimals else { continue };
            let value = values.next().expect("a value") - MARK;
            count += 1;
            text += &match decimals {
                Some(d) => format!("{value:>12.d$}"),
                None => format!("{value:.9}"),
            };
        }
        // The rest of the last three is filled up.
        for _ in 0..(3 - count % 3) % 3 {
            values.next();
        }
        text.push('\n');
    }
    text
}

fn words(line: &str) -> BTreeMap<char, f64> {
    let found = line.split_whitespace().filter_map(|w| {
        let letter = w.chars().next()?;
        Some((letter, w.get(1..)?.parse::<f64>().ok()?))
    });
    found.collect()
}

/// A line of a touch with another end.
fn ended(
    line: &str,
    start: &str,
    control: Control,
    trigger: &mut dyn FnMut(&Touched) -> [f64; 3],
) -> String {
    let at = words(line.strip_prefix(start).expect("a touch"));
    let word = |c: char| at.get(&c).copied().unwrap_or(f64::NAN);
    let to_mm = [word('X'), word('Y'), word('Z')];
    let place = trigger(&Touched { to_mm, angle_rad: None });
    // The interpreter of FANUC takes the signal 0.01 mm before the end, along the way.
    let way = [0, 1, 2].map(|i| if to_mm[i].is_nan() { 0.0 } else { to_mm[i] - place[i] });
    let length = way.iter().map(|d| d * d).sum::<f64>().sqrt();
    let beyond =
        if matches!(control, Control::Fanuc | Control::Haas) { 0.01 / length } else { 0.0 };
    let mut text = start.to_owned();
    for (i, letter) in ['X', 'Y', 'Z'].into_iter().enumerate() {
        if !to_mm[i].is_nan() {
            text += &format!(" {letter}{:.9}", place[i] + way[i] * beyond);
        }
    }
    text + &format!(" F{}", word('F'))
}

fn g_code(text: &str, control: Control, trigger: Trigger<'_>) -> String {
    let start = if control == Control::LinuxCnc { "G38.2" } else { "G31" };
    let line = |line: &str| match line.starts_with(start) {
        true => ended(line, start, control, trigger),
        false => line.to_owned(),
    };
    text.lines().map(line).collect::<Vec<_>>().join("\n") + "\n"
}

fn sinumerik(text: &str, trigger: Trigger<'_>) -> (String, Vec<Line>) {
    let (mut out, mut lines) = (String::new(), Vec::new());
    for line in text.lines() {
        if line.starts_with("MEAS=1 G1") {
            out += &(ended(line, "MEAS=1 G1", Control::Sinumerik840d, trigger) + "\n");
            continue;
        }
        let Some(written) = line.strip_prefix("WRITE(TOUCH_ERROR,") else {
            out += &format!("{line}\n");
            continue;
        };
        let written =
            written.split_once("_MPF\",").expect("a file").1.strip_suffix(')').expect("an end");
        let mut pieces: Vec<(String, Option<Option<usize>>)> = Vec::new();
        let mut values = Vec::new();
        for part in written.split("<<") {
            match part.strip_prefix('"').and_then(|p| p.strip_suffix('"')) {
                Some(text) => pieces.push((text.to_owned(), None)),
                None => {
                    values.push(part.to_owned());
                    pieces.last_mut().expect("text before a value").1 = Some(None);
                }
            }
        }
        lines.push(Line(pieces));
        // First all values, as the moves change where the axes stand; at the end they stand where they stood.
        out += "R57=$AA_MM[X]\nR58=$AA_MM[Y]\nR59=$AA_MM[Z]\n";
        for (i, value) in values.iter().enumerate() {
            out += &format!("R{}={value}\n", 60 + i);
        }
        for chunk in (0..values.len()).collect::<Vec<_>>().chunks(3) {
            let of = |k: usize| chunk.get(k).map_or("0".to_owned(), |i| format!("R{}", 60 + i));
            out += &format!(
                "G1 X={}+{MARK:.1} Y={}+{MARK:.1} Z={}+{MARK:.1} F1000\n",
                of(0),
                of(1),
                of(2)
            );
        }
        out += if values.is_empty() { "" } else { "G1 X=R57 Y=R58 Z=R59 F1000\n" };
    }
    (out, lines)
}

fn klartext(files: &[ProbeFile], text: &str, trigger: Trigger<'_>) -> (String, Vec<Line>) {
    let (mut out, mut lines, mut angle) = (String::new(), Vec::new(), None);
    let mut vector = [f64::NAN; 3];
    for line in text.lines() {
        let (number, block) = line.split_once(' ').unwrap_or((line, ""));
        let mut put = |text: String| out += &format!("{number} {text}\n");
        if let Some(direction) = block.strip_prefix("TCH PROBE 3.2 X ANGLE:") {
            angle = Some(direction.parse::<f64>().expect("an angle").to_radians());
            vector = [f64::NAN; 3];
        } else if let Some(direction) = block.strip_prefix("TCH PROBE 4.2 ") {
            let part = |w: &str| w[2..].parse::<f64>().expect("a component");
            let parts: Vec<f64> = direction.split(' ').map(part).collect();
            (vector, angle) = ([parts[0], parts[1], parts[2]], None);
        } else if block.starts_with("TCH PROBE 3.3") || block.starts_with("TCH PROBE 4.3") {
            assert!(block.ends_with("REFERENCE SYSTEM:1"), "{block}");
            let place = trigger(&Touched { to_mm: vector, angle_rad: angle });
            for (q, value) in (10..).zip(place) {
                put(format!("Q{q} = {value:+.9}"));
            }
            put("Q13 = +0".to_owned());
        } else if block.starts_with("FN 18: SYSREAD Q3") {
            put("Q3 = +5".to_owned());
        } else if let Some(print) = block.strip_prefix("FN 16: F-PRINT TNC:\\TRUEAXIS\\") {
            let mask = text_of(files, print.split_once(" / ").expect("a log").0);
            let (line, parameters) = mask_line(mask.lines().next().expect("a line"));
            lines.push(line);
            for chunk in parameters.chunks(3) {
                let of = |k: usize| chunk.get(k).map_or("0", String::as_str).to_owned();
                for (k, axis) in ['X', 'Y', 'Z'].into_iter().enumerate() {
                    put(format!("Q{} = {} + {MARK:.1}", 60 + k, of(k)));
                    let _ = axis;
                }
                put("L X+Q60 Y+Q61 Z+Q62 R0 F1000".to_owned());
            }
        } else if !block.starts_with("TCH") {
            put(block.to_owned());
        }
    }
    (out, lines)
}

/// `"H%7.0F T%7.0F",Q1,Q3;`
fn mask_line(mask: &str) -> (Line, Vec<String>) {
    let inner = mask.strip_prefix('"').expect("a quotation mark");
    let (format, parameters) = inner.split_once('"').expect("its end");
    let parameters = parameters.trim_end_matches(';').split(',').filter(|p| !p.is_empty());
    let mut pieces = Vec::new();
    let mut rest = format;
    while let Some((piece, after)) = rest.split_once('%') {
        let (size, next) = after.split_once('F').expect("%w.dF");
        let decimals = size.split_once('.').expect("decimals").1.parse().expect("a number");
        pieces.push((piece.to_owned(), Some(Some(decimals))));
        rest = next;
    }
    pieces.push((rest.to_owned(), None));
    (Line(pieces), parameters.map(str::to_owned).collect())
}
