//! What several tests need: outside files, and canonical calls in mm.
#![allow(dead_code, reason = "each test uses a part")]
#![allow(clippy::print_stdout, reason = "what is skipped")]

pub mod radius;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use trueaxis_nc::moves::{Axis, FeedMode, PathControl, Plane, Position, SpindleDirection};
use trueaxis_nc::{Control, Event, Library, Move, MoveKind, Program, Settings, Step, interpret};

/// A folder or file of the outside data, or `None` with a message.
pub fn outside(path: &str) -> Option<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).ancestors().nth(3)?;
    let found = Some(root.join("shared/data/outside").join(path)).filter(|p| p.exists());
    if found.is_none() {
        println!("skipped: {path} of the outside data is not here");
    }
    found
}

/// One canonical call in mm.
#[derive(Debug, Clone, PartialEq)]
pub enum Call {
    /// Name, numbers in mm or degrees, and how far each may be off.
    Numbers(&'static str, Vec<f64>, f64),
    /// A message, blanks collapsed.
    Text(String),
}

impl Call {
    pub fn agrees(&self, their: &Self) -> bool {
        match (self, their) {
            (Self::Numbers(a, x, _), Self::Numbers(b, y, allowed)) => {
                a == b
                    && x.len() == y.len()
                    && x.iter().zip(y).all(|(x, y)| (x - y).abs() <= allowed + 1e-9)
            }
            (Self::Text(a), Self::Text(b)) => a == b || close_text(a, b),
            _ => false,
        }
    }
}

/// Messages with numbers: the same words, numbers to the last printed digit.
fn close_text(a: &str, b: &str) -> bool {
    let (a, b): (Vec<_>, Vec<_>) = (a.split(' ').collect(), b.split(' ').collect());
    a.len() == b.len()
        && a.iter().zip(&b).all(|(x, y)| {
            let number = |t: &str| t.trim_start_matches(char::is_alphabetic).parse::<f64>().ok();
            x == y || number(x).zip(number(y)).is_some_and(|(x, y)| (x - y).abs() < 1.5e-6)
        })
}

fn collapsed(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// The calls of an expected file that say where things are and what moves.
pub fn expected_calls(text: &str) -> Vec<Call> {
    let (mut unit, mut feed) = (1.0, 0.0);
    let mut calls = Vec::new();
    for line in text.lines() {
        let Some((_, call)) = line.split_once("N.....") else {
            continue;
        };
        let call = call.trim();
        let (name, inner) = call.split_once('(').unwrap_or((call, ""));
        let inner = inner.strip_suffix(')').unwrap_or(inner);
        let numbers: Vec<f64> =
            inner.split([',', ' ']).filter_map(|n| n.trim().parse().ok()).collect();
        let length = |count: usize| -> Vec<f64> {
            let scale = |i: usize| if (3..6).contains(&i) { 1.0 } else { unit };
            numbers.iter().take(count).enumerate().map(|(i, n)| n * scale(i)).collect()
        };
        let half = 0.00005 * unit;
        match name {
            "USE_LENGTH_UNITS" => unit = if inner.ends_with("INCHES") { 25.4 } else { 1.0 },
            "SET_FEED_RATE" => feed = numbers[0] * unit,
            "STRAIGHT_TRAVERSE" => calls.push(Call::Numbers("rapid", length(6), half)),
            "STRAIGHT_FEED" => {
                calls.push(Call::Numbers("line", length(6), half));
                calls.push(Call::Numbers("feed", vec![feed], half));
            }
            "RIGID_TAP" => calls.push(Call::Numbers("tap", length(3), half)),
            "ARC_FEED" => {
                let n = &numbers;
                let place: Vec<f64> =
                    [n[0], n[1], n[2], n[3], n[5]].iter().map(|v| v * unit).collect();
                calls.push(Call::Numbers("arc", place, half));
                calls.push(Call::Numbers("turns", vec![n[4], n[6], n[7], n[8]], half));
                calls.push(Call::Numbers("feed", vec![feed], half));
            }
            "SET_MOTION_CONTROL_MODE" => {
                let modes = ["CANON_EXACT_PATH", "CANON_EXACT_STOP", "CANON_CONTINUOUS"];
                let mode = modes.iter().position(|m| inner.starts_with(m)).unwrap();
                let tolerance = numbers.first().unwrap_or(&0.0) * unit;
                calls.push(Call::Numbers("path", vec![mode as f64, tolerance], half));
            }
            "DWELL" => calls.push(Call::Numbers("dwell", numbers, 0.00005)),
            "MESSAGE" => calls.push(Call::Text(collapsed(inner.trim_matches('"')))),
            "USE_TOOL_LENGTH_OFFSET" => calls.push(Call::Numbers("length", length(3), half)),
            "SET_G5X_OFFSET" => {
                let offset = numbers[1..].iter().enumerate();
                let scale = |i: usize| if (3..6).contains(&i) { 1.0 } else { unit };
                let offset = offset.map(|(i, v)| v * scale(i)).collect();
                calls.push(Call::Numbers("offset", offset, half));
            }
            "SET_G92_OFFSET" => calls.push(Call::Numbers("shift", length(6), half)),
            "SET_XY_ROTATION" => calls.push(Call::Numbers("rotation", numbers, 0.00005)),
            _ => calls.extend(plain_call(name, inner, &numbers)),
        }
    }
    tidy(calls)
}

/// The calls whose numbers have no unit.
fn plain_call(name: &str, inner: &str, numbers: &[f64]) -> Option<Call> {
    let (name, values) = match name {
        "SELECT_PLANE" => {
            let plane = ["XY", "XZ", "YZ"].iter().position(|p| inner.ends_with(p)).unwrap();
            ("plane", vec![plane as f64])
        }
        "STOP_SPINDLE_TURNING" => ("spindle", vec![0.0]),
        "START_SPINDLE_CLOCKWISE" => ("spindle", vec![1.0]),
        "START_SPINDLE_COUNTERCLOCKWISE" => ("spindle", vec![-1.0]),
        "SET_SPINDLE_SPEED" => ("speed", vec![numbers[1]]),
        "SELECT_TOOL" => ("tool", numbers.to_vec()),
        "CHANGE_TOOL" => ("change", vec![]),
        "PROGRAM_END" => ("end", vec![]),
        _ => return None,
    };
    Some(Call::Numbers(name, values, 0.0))
}

/// Takes out what LinuxCNC calls when a run begins and ends: initial values and resets.
fn tidy(mut calls: Vec<Call>) -> Vec<Call> {
    let frames = |c: &&Call| matches!(name(c), "offset" | "shift" | "rotation");
    if calls.iter().take_while(frames).count() >= 3 {
        calls.drain(..3);
    }
    // The spindle stops for a tool change without being asked.
    let mut out: Vec<Call> = Vec::new();
    for call in calls {
        if name(&call) == "change" && out.last().is_some_and(|c| name(c) == "spindle") {
            out.pop();
        }
        out.push(call);
    }
    tidy_end(out)
}

fn name(call: &Call) -> &'static str {
    if let Call::Numbers(name, ..) = call { name } else { "" }
}

/// Cuts off the resets at the end; frames that change at once are put into one order.
pub fn tidy_end(mut calls: Vec<Call>) -> Vec<Call> {
    if let Some(end) = calls.iter().position(|c| name(c) == "end") {
        calls.truncate(end);
    }
    let reset = ["offset", "shift", "rotation", "spindle", "plane"];
    while calls.last().is_some_and(|c| reset.contains(&name(c))) {
        calls.pop();
    }
    let frames = |c: &Call| matches!(name(c), "offset" | "shift" | "rotation");
    for run in calls.chunk_by_mut(|a, b| frames(a) && frames(b)) {
        run.sort_by_key(name);
    }
    calls
}

/// Subprograms beside a program.
pub struct Folder(pub PathBuf);

impl Library for Folder {
    fn text(&self, name: &str) -> Result<Vec<u8>, String> {
        let places = [self.0.join(format!("{name}.ngc")), self.0.join(format!("subs/{name}.ngc"))];
        let found = places.iter().find(|p| p.exists()).ok_or("no such file")?;
        std::fs::read(found).map_err(|e| e.to_string())
    }
}

/// Reads a LinuxCNC ini file as far as the tests need it.
fn constants(folder: &Path) -> BTreeMap<String, f64> {
    let text = std::fs::read_to_string(folder.join("test.ini")).unwrap_or_default();
    let mut section = String::new();
    let mut found = BTreeMap::new();
    for line in text.lines().map(str::trim) {
        if let Some(name) = line.strip_prefix('[') {
            section = name.trim_end_matches(']').to_ascii_lowercase();
        } else if let Some((key, value)) = line.split_once('=')
            && let Ok(value) = value.trim().parse()
        {
            let key = key.trim().to_ascii_lowercase();
            found.insert(format!("_ini[{section}]{key}"), value);
        }
    }
    found
}

/// The tool table of LinuxCNC's rs274 where a test has none: tool 2 is what two tests use.
fn tools() -> BTreeMap<u32, Position> {
    let mut length = Position::default();
    length[Axis::Z] = 2.54;
    BTreeMap::from([(1, Position::default()), (2, length)])
}

/// Our calls for a program, and what was wrong with it.
pub fn our_calls(file: &Path) -> (Vec<Call>, String) {
    let folder = file.parent().unwrap();
    // This one is about continuing after errors.
    let keep_going = folder.ends_with("oword-unwind");
    let (constants, tools) = (constants(folder), tools());
    let settings = Settings { constants, tools, keep_going, ..Settings::default() };
    let program = Program::new(
        &file.file_name().unwrap().to_string_lossy(),
        std::fs::read(file).unwrap(),
        Control::LinuxCnc,
    );
    let mut calls = Vec::new();
    let mut position = Position::default();
    let outcome =
        interpret(&program, &Folder(folder.to_owned()), &settings, &mut |step| match step {
            Step::Move(m) => {
                push_move(&m, &position, &mut calls);
                position = m.target;
            }
            Step::Event(event, _) => push_event(&event, &mut calls),
        });
    let problems =
        outcome.problems.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n   ");
    (tidy_end(calls), problems)
}

fn push_move(m: &Move, from: &Position, calls: &mut Vec<Call>) {
    let six = m.target.0[..6].to_vec();
    let feed = |calls: &mut Vec<Call>, length_mm: f64| {
        let value = match m.feed.mode {
            FeedMode::InverseTime => m.feed.value * length_mm,
            _ => m.feed.value,
        };
        calls.push(Call::Numbers("feed", vec![value], 0.0));
    };
    match m.kind {
        MoveKind::Rapid => calls.push(Call::Numbers("rapid", six, 0.0)),
        MoveKind::Linear => {
            calls.push(Call::Numbers("line", six, 0.0));
            let d = m.target.minus(from).0;
            feed(calls, (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]).sqrt());
        }
        MoveKind::RigidTap { .. } => calls.push(Call::Numbers("tap", six[..3].to_vec(), 0.0)),
        MoveKind::Dwell { seconds } => calls.push(Call::Numbers("dwell", vec![seconds], 0.0)),
        MoveKind::Arc(arc) => {
            let [a, b, n] = arc.plane.axes();
            let c = arc.center_mm;
            let place = vec![m.target[a], m.target[b], c[0], c[1], m.target[n]];
            calls.push(Call::Numbers("arc", place, 0.0));
            let turns = if arc.ccw { f64::from(arc.turns) } else { -f64::from(arc.turns) };
            calls.push(Call::Numbers("turns", vec![turns, six[3], six[4], six[5]], 0.0));
            let (start, end) =
                ([from[a] - c[0], from[b] - c[1]], [m.target[a] - c[0], m.target[b] - c[1]]);
            let swept = (start[0] * end[1] - start[1] * end[0])
                .atan2(start[0] * end[0] + start[1] * end[1]);
            let swept = if arc.ccw { swept } else { -swept };
            let swept = if swept <= 0.0 { swept + std::f64::consts::TAU } else { swept };
            feed(calls, swept * start[0].hypot(start[1]));
        }
        _ => calls.push(Call::Numbers("other", six, 0.0)),
    }
}

fn push_event(event: &Event, calls: &mut Vec<Call>) {
    match event {
        Event::WorkOffset { offset, rotation_deg, .. } => {
            calls.push(Call::Numbers("offset", offset.0[..6].to_vec(), 0.0));
            calls.push(Call::Numbers("rotation", vec![*rotation_deg], 0.0));
        }
        Event::Shift(shift) => calls.push(Call::Numbers("shift", shift.0[..6].to_vec(), 0.0)),
        Event::ToolLength(length) => {
            calls.push(Call::Numbers("length", length.0[..3].to_vec(), 0.0));
        }
        Event::Plane(plane) => {
            let number = [Plane::Xy, Plane::Zx, Plane::Yz].iter().position(|p| p == plane).unwrap();
            calls.push(Call::Numbers("plane", vec![number as f64], 0.0));
        }
        Event::Spindle(turning) => {
            let sign = match turning {
                SpindleDirection::Stopped => 0.0,
                SpindleDirection::Clockwise => 1.0,
                SpindleDirection::CounterClockwise => -1.0,
            };
            calls.push(Call::Numbers("spindle", vec![sign], 0.0));
        }
        Event::Path { control, tolerance_mm } => {
            let mode = match control {
                PathControl::ExactPath => 0.0,
                PathControl::ExactStop => 1.0,
                PathControl::Continuous => 2.0,
            };
            calls.push(Call::Numbers("path", vec![mode, *tolerance_mm], 0.0));
        }
        Event::SpindleSpeed(speed) => calls.push(Call::Numbers("speed", vec![*speed], 0.0)),
        Event::ToolSelect(tool) => calls.push(Call::Numbers("tool", vec![f64::from(*tool)], 0.0)),
        Event::ToolChange(_) => calls.push(Call::Numbers("change", vec![], 0.0)),
        Event::Message(text) => calls.push(Call::Text(collapsed(text))),
        Event::End => calls.push(Call::Numbers("end", vec![], 0.0)),
        _ => {}
    }
}

/// A number with at most six decimals, without trailing zeros.
pub fn short(value: f64) -> String {
    let text = format!("{value:.6}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

fn shorts(values: &[f64]) -> String {
    values.iter().map(|v| short(*v)).collect::<Vec<_>>().join(" ")
}

/// The axes of a place that are not zero, X, Y and Z always.
fn axes(place: &Position) -> String {
    let shown = |a: &Axis| (*a as usize) < 3 || place[*a].abs() > 5e-7;
    let word = |a: Axis| format!("{a}{}", short(place[a]));
    Axis::ALL.into_iter().filter(shown).map(word).collect::<Vec<_>>().join(" ")
}

/// One step as the `.expected` files of `tests/programs` have it.
pub fn step_line(step: &Step) -> String {
    match step {
        Step::Move(m) => move_line(m),
        Step::Event(Event::Frame(frame), origin) => {
            let mut line = format!("{} frame {}", origin.line, axes(&frame.shift));
            if frame.linear != trueaxis_nc::moves::Frame::IDENTITY.linear {
                let rows = frame.linear.map(|row| shorts(&row));
                line += &format!(" linear {}", rows.join(" / "));
            }
            line
        }
        Step::Event(Event::WorkOffset { index, offset, rotation_deg }, origin) => {
            let turn = short(*rotation_deg);
            format!("{} WorkOffset {index} {} turn {turn}", origin.line, axes(offset))
        }
        Step::Event(Event::Shift(shift), origin) => {
            format!("{} Shift {}", origin.line, axes(shift))
        }
        Step::Event(Event::ToolLength(length), origin) => {
            format!("{} ToolLength {}", origin.line, axes(length))
        }
        Step::Event(event, origin) => format!("{} {event:?}", origin.line),
    }
}

fn move_line(m: &Move) -> String {
    let (kind, feeds) = match m.kind {
        MoveKind::Rapid => ("rapid".to_owned(), false),
        MoveKind::Linear => ("line".to_owned(), true),
        MoveKind::Arc(arc) => {
            let way = if arc.ccw { "ccw" } else { "cw" };
            let center = shorts(&arc.center_mm);
            (format!("arc {way} {:?} centre {center} turns {}", arc.plane, arc.turns), true)
        }
        MoveKind::SpatialArc(arc) => {
            let (center, normal) = (shorts(&arc.center_mm), shorts(&arc.normal));
            (format!("arc centre {center} normal {normal} turns {}", arc.turns), true)
        }
        MoveKind::Align { keep_tip, branch } => {
            return format!("{} align keep_tip {keep_tip} {branch:?}", m.origin.line);
        }
        MoveKind::Thread { pitch_mm } => (format!("thread {}", short(pitch_mm)), false),
        MoveKind::RigidTap { pitch_mm } => (format!("tap {}", short(pitch_mm)), false),
        MoveKind::Probe => ("probe".to_owned(), true),
        MoveKind::Dwell { seconds } => {
            return format!("{} dwell {}", m.origin.line, short(seconds));
        }
    };
    let mut line = format!("{} {kind} {}", m.origin.line, axes(&m.target));
    for (axis, way) in [Axis::A, Axis::B, Axis::C].into_iter().zip(m.rotary_directions) {
        if way != trueaxis_nc::moves::RotaryDirection::AsWritten {
            line += &format!(" {axis} {way:?}");
        }
    }
    if m.coordinates == trueaxis_nc::moves::Coordinates::Machine {
        line += " machine";
    }
    if let Some(direction) = m.direction {
        line += &format!(" direction {}", shorts(&direction));
    }
    if feeds {
        let mode = match m.feed.mode {
            FeedMode::PerMinute => "F",
            FeedMode::InverseTime => "1/",
            FeedMode::PerRevolution => "F/rev ",
        };
        line += &format!(" {mode}{}", short(m.feed.value));
    }
    line
}

/// Whether two lines say the same, numbers to the last printed digit.
pub fn same_line(a: &str, b: &str) -> bool {
    let split = |t: &str| -> (String, Option<f64>) {
        let at = t.find(|c: char| c == '-' || c.is_ascii_digit()).unwrap_or(t.len());
        (t[..at].to_owned(), t[at..].parse().ok())
    };
    let same = |x: &str, y: &str| {
        let ((before_x, x_value), (before_y, y_value)) = (split(x), split(y));
        let close = x_value.zip(y_value).is_some_and(|(x, y)| (x - y).abs() < 1.5e-6);
        x == y || before_x == before_y && close
    };
    let (a, b): (Vec<_>, Vec<_>) = (a.split_whitespace().collect(), b.split_whitespace().collect());
    a.len() == b.len() && a.iter().zip(&b).all(|(x, y)| same(x, y))
}
