//! A program unrolled: the blocks in the order of their execution, with numbers for what is computed.
//!
//! ```text
//!     program ──execute, telling blocks──> text of each block, its computed parts
//!             ──numbers in, statements that only steer out──> flat program
//!     both executed side by side: the same steps, or none is handed out
//! ```
//!
//! Subprograms, loops, jumps, repeated parts and variables are gone then; comments of executed blocks
//! stay. Blocks keep no numbers (nothing jumps to them), those of Klartext are counted again.

mod centre;
mod cycles;

use super::number::{Grid, Unit};
use super::text::{Edits, Modes};
use super::words::Words;
use std::ops::Range;
use std::path::Path;
use std::sync::mpsc::{Receiver, sync_channel};
use trueaxis_input::{Diagnostics, Place, Severity};
use trueaxis_machine::Machine;
use trueaxis_motion::{SetUp, execute};
use trueaxis_nc::lexer::{Lexer, TokenKind};
use trueaxis_nc::moves::{
    AxisSet, CompensationSide, Event, Feed, FeedMode, Move, MoveKind, Origin, Position, Step,
};
use trueaxis_nc::{Control, Program, Settings};

/// A block that was executed.
struct Told {
    origin: Origin,
    text: Range<usize>,
    /// Parts of it and their values; without one they only steer.
    computed: Vec<(Range<usize>, Option<f64>)>,
    moves: Vec<Move>,
    /// The tool runs along a contour, or begins or ends to do so.
    on_contour: bool,
}

/// What becomes of radius compensation.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Contour {
    /// It stays.
    Kept,
    /// The path of the centre of the tool is written, without it.
    Centre,
}

/// Steps that are handed over at once.
const STEPS: usize = 4096;

/// The flat program; why there is none goes to `problems`.
pub(super) fn unrolled(
    mounted: &Machine,
    program: &Program,
    setup: &SetUp,
    contour: Contour,
    problems: &mut Diagnostics,
) -> Option<Program> {
    let settings = Settings { report_blocks: true, ..setup.settings(false) };
    let mut told: Vec<Told> = Vec::new();
    let mut on_contour = false;
    let outcome = execute(mounted, program, setup, &settings, &mut |step| match step {
        Step::Event(Event::Block { text }, origin) => {
            let (computed, moves) = (Vec::new(), Vec::new());
            told.push(Told { origin, text, computed, moves, on_contour });
        }
        Step::Event(Event::Computed { text, value }, _) => {
            if let Some(block) = told.last_mut() {
                block.computed.push((text, value));
            }
        }
        Step::Move(m) => {
            if let Some(block) = told.last_mut().filter(|b| b.origin == m.origin) {
                block.moves.push(m);
            }
        }
        Step::Event(Event::Compensation { side, .. }, _) => {
            on_contour = side != CompensationSide::Off;
            if let Some(block) = told.last_mut() {
                block.on_contour = true;
            }
        }
        Step::Event(..) => {}
    });
    if outcome.problems.has_errors() {
        problems.append(outcome.problems);
        return None;
    }
    let control = program.dialect().control;
    let mut programs = vec![program.clone()];
    for name in &outcome.programs[1..] {
        match setup.files.read(Path::new(name)) {
            Ok(bytes) => programs.push(Program::new(name, bytes, control)),
            Err(e) => {
                let message = format!("cannot be read again: {e}");
                problems.error("unreadable-file", Place::whole(name), message, "put it back");
                return None;
            }
        }
    }
    let mut flat = Flat {
        programs: &programs,
        out: Vec::new(),
        number: 0,
        origins: Vec::new(),
        modes: Modes::default(),
        after_cycle: false,
        contour,
        place: None,
    };
    told.iter().for_each(|block| flat.block(block));
    flat.close();
    let file = program.file();
    let name = format!("{} (unrolled)", file.strip_suffix(" (unrolled)").unwrap_or(file));
    let text = Program::new(&name, flat.out, control);
    let origins = flat.origins;
    match differs(mounted, [program, &text], setup, contour) {
        None => Some(text),
        Some((at, error)) => {
            let origin = origins.get(at.saturating_sub(1) as usize).copied().unwrap_or_default();
            let file = programs.get(origin.program as usize).map_or(program.file(), Program::file);
            let place = Place { file: file.to_owned(), line: origin.line as usize, column: 1 };
            let lines = text.source().split(|b| *b == b'\n');
            let line =
                lines.skip(at.saturating_sub(1) as usize).map(String::from_utf8_lossy).next();
            let line = line.unwrap_or_default();
            let message = match error {
                Some(error) => format!("unrolled to `{}`, it is refused: {error}", line.trim()),
                None => format!("unrolled to `{}`, the program would go another way", line.trim()),
            };
            let hint = "modal macros, tapping and moves in a block that \
                        calls do not unroll: write this block out; the postprocessor can";
            problems.error("not-unrolled", place, message, hint);
            None
        }
    }
}

/// What stands before the words of a block: `/`, and in Klartext the number.
struct Front {
    skip: String,
    klartext: bool,
}

impl Front {
    fn of(program: &Program, words: &Words) -> Self {
        let skip = words.skip.clone().map(|range| &program.source()[range]);
        let skip = String::from_utf8_lossy(skip.unwrap_or_default()).into_owned();
        Self { skip, klartext: program.dialect().control == Control::Heidenhain }
    }

    /// As it is written before the block with a number.
    fn text(&self, number: u32) -> String {
        let number = if self.klartext { format!("{number} ") } else { String::new() };
        format!("{}{number}", self.skip)
    }
}

/// The first words of Klartext whose blocks may state a feed.
const PATHS: [&[u8]; 10] = [b"L", b"LN", b"LP", b"C", b"CP", b"CR", b"CT", b"CTP", b"CHF", b"RND"];

struct Flat<'p> {
    programs: &'p [Program],
    out: Vec<u8>,
    /// The number of the next block of Klartext.
    number: u32,
    /// Where each line comes from.
    origins: Vec<Origin>,
    modes: Modes,
    /// The last motion code and feed are those of an unrolled cycle.
    after_cycle: bool,
    contour: Contour,
    /// Where the last move ended.
    place: Option<Position>,
}

impl Flat<'_> {
    fn block(&mut self, told: &Told) {
        let Some(program) = self.programs.get(told.origin.program as usize) else { return };
        let source = program.source();
        let line = without_end(source, &told.text);
        let steers = |range: &Range<usize>| range.start <= line.start && range.end >= line.end;
        if told.computed.iter().any(|(range, value)| value.is_none() && steers(range)) {
            let comments = comments(program, &line);
            if !comments.is_empty() {
                let front = Front::of(program, &Words::read(source, program.dialect(), line));
                let comments = [front.text(self.number).as_bytes(), &comments].concat();
                self.line(&comments, told.origin);
            }
            return;
        }
        let mut edits = Edits::default();
        let is_inside = |(range, _): &(Range<usize>, Option<f64>)| {
            told.computed.iter().any(|(outer, value)| {
                value.is_none()
                    && outer != range
                    && outer.start <= range.start
                    && outer.end >= range.end
            })
        };
        for (range, value) in told.computed.iter().filter(|part| !is_inside(part)) {
            let mut range = range.start..range.end.min(line.end);
            while range.end > range.start && source[range.end - 1].is_ascii_whitespace() {
                range.end -= 1;
            }
            let text = value.map_or(String::new(), |v| number(v, source, range.start, program));
            edits.put(range, &text);
        }
        let words = Words::read(source, program.dialect(), line.clone());
        self.modes.follow(&words);
        let front = Front::of(program, &words);
        if self.centre(program, words.front..line.end, told, &front) {
            return;
        }
        self.place = told.moves.last().map(|m| m.target).or(self.place);
        if self.cycle(program, words.front..line.end, told, &edits, &front) {
            return;
        }
        if words.front > line.start {
            edits.put(line.start..words.front, front.text(self.number).trim_end());
        }
        self.restate(program, &words, told, &mut edits);
        let was_blank = source[line.clone()].iter().all(u8::is_ascii_whitespace);
        let changed = !edits.is_empty();
        let text = edits.applied(source, line.clone());
        let says = text.iter().any(|b| !b.is_ascii_whitespace() && !b.is_ascii_digit());
        if says || (was_blank && !changed) {
            let text = text.trim_ascii_start();
            self.line(text, told.origin);
        }
    }

    /// Writes the path of the centre of the tool; `false` if the block has no radius compensation.
    fn centre(
        &mut self,
        program: &Program,
        line: Range<usize>,
        told: &Told,
        front: &Front,
    ) -> bool {
        if self.contour == Contour::Kept || !told.on_contour {
            return false;
        }
        let from = self.place;
        let Some(found) = centre::written(program, &line, &told.moves, from, self.modes) else {
            return false;
        };
        self.place = told.moves.last().map(|m| m.target).or(from);
        self.lines(front, &found, told.origin);
        true
    }

    /// What remains of a block, and its moves; each with `front`, what stands before the words of a block.
    fn lines(&mut self, front: &Front, unrolled: &cycles::Unrolled, origin: Origin) {
        let head = Some(unrolled.head.trim()).filter(|head| !head.is_empty());
        for block in head.into_iter().chain(unrolled.moves.iter().flat_map(|text| text.lines())) {
            let block = [front.text(self.number).as_bytes(), block.as_bytes()].concat();
            self.line(&block, origin);
        }
    }

    /// Writes the moves of a cycle one by one; `false` if the block is none.
    fn cycle(
        &mut self,
        program: &Program,
        line: Range<usize>,
        told: &Told,
        numbers: &Edits,
        front: &Front,
    ) -> bool {
        let control = program.dialect().control;
        let text = String::from_utf8_lossy(&program.source()[line.clone()]).to_ascii_uppercase();
        if control == Control::Sinumerik840d && text.contains("MCALL") {
            // Its calls are written out.
            self.line(format!("; {}", text.trim()).as_bytes(), told.origin);
            return true;
        }
        if told.moves.len() < 2 {
            return false;
        }
        // The block with numbers for what it computes.
        let text = numbers.clone().applied(program.source(), line);
        let block = Program::new(program.file(), text, control);
        let words = Words::read(block.source(), block.dialect(), 0..block.source().len());
        let Some(mut cycle) = cycles::unrolled(&block, &words, &told.moves, self.modes) else {
            return false;
        };
        if control == Control::Sinumerik840d && self.after_cycle && words.motion.is_none() {
            // A further call is reached with the motion code from before the cycle.
            let code = told.moves.first().and_then(cycles::motion_code).unwrap_or_default();
            cycle.head.insert_str(0, code);
        }
        self.lines(front, &cycle, told.origin);
        self.after_cycle = true;
        true
    }

    /// After a cycle a block states the motion code, or the feed, that it had from before.
    fn restate(&mut self, program: &Program, words: &Words, told: &Told, edits: &mut Edits) {
        let ([m], true) = (&told.moves[..], self.after_cycle) else { return };
        let klartext = program.dialect().control == Control::Heidenhain;
        // Of Klartext only the blocks of paths have a feed.
        let first = words.motion.clone().map(|range| program.source()[range].to_ascii_uppercase());
        let has_feed = first.is_some_and(|word| PATHS.contains(&&word[..]));
        if klartext && !has_feed {
            return;
        }
        if klartext && words.feed.is_none() && m.kind != MoveKind::Rapid {
            edits.put(words.end..words.end, &format!(" F{}", cycles::klartext_feed(m, self.modes)));
            self.after_cycle = false;
        } else if klartext {
            self.after_cycle = words.feed.is_none() || m.kind == MoveKind::Rapid;
        } else {
            if let Some(code) = cycles::motion_code(m).filter(|_| words.motion.is_none()) {
                edits.put(words.front..words.front, code);
            }
            self.after_cycle = false;
        }
    }

    fn line(&mut self, text: &[u8], origin: Origin) {
        self.number += 1;
        self.out.extend_from_slice(text);
        self.out.extend_from_slice(self.ending());
        // A block of several lines counts as several.
        let lines = 1 + text.iter().filter(|b| **b == b'\n').count();
        self.origins.extend(std::iter::repeat_n(origin, lines));
    }

    fn ending(&self) -> &'static [u8] {
        let main = self.programs.first().map_or(&b""[..], Program::source);
        match main.iter().position(|b| *b == b'\n') {
            Some(at) if at > 0 && main[at - 1] == b'\r' => b"\r\n",
            _ => b"\n",
        }
    }

    /// Lines after the end of the execution that belong to every program: `%`, `END PGM`.
    fn close(&mut self) {
        let Some(main) = self.programs.first() else { return };
        let source = String::from_utf8_lossy(main.source());
        let is_mark = |line: &str| match main.dialect().control {
            Control::Heidenhain => line.to_ascii_uppercase().contains("END PGM"),
            Control::Sinumerik840d => false,
            Control::Fanuc | Control::Haas | Control::LinuxCnc => line.trim() == "%",
        };
        let ends = |text: &str| text.trim_end().lines().next_back().is_some_and(is_mark);
        let is_closed = ends(&String::from_utf8_lossy(&self.out));
        let Some(mark) = source.lines().rfind(|l| is_mark(l)).filter(|_| !is_closed) else {
            return;
        };
        let words = mark.trim_start_matches(|c: char| c.is_ascii_digit() || c == ' ');
        let text = match main.dialect().control {
            Control::Heidenhain => format!("{} {words}", self.number),
            _ => words.to_owned(),
        };
        self.line(text.as_bytes(), Origin::default());
    }
}

fn without_end(source: &[u8], text: &Range<usize>) -> Range<usize> {
    let mut end = text.end.min(source.len());
    while end > text.start && matches!(source[end - 1], b'\n' | b'\r') {
        end -= 1;
    }
    text.start..end
}

fn comments(program: &Program, line: &Range<usize>) -> Vec<u8> {
    let tokens = Lexer::new(program.source(), program.dialect(), line.start);
    let inside = tokens.take_while(|t| t.start < line.end);
    let comments = inside.filter(|t| t.kind == TokenKind::Comment);
    let each: Vec<&[u8]> =
        comments.map(|t| &program.source()[t.start..t.end.min(line.end)]).collect();
    each.join(&b' ')
}

/// A number in full, after the address that stands before a byte.
fn number(value: f64, source: &[u8], at: usize, program: &Program) -> String {
    let address = source[..at].last().map_or(b' ', u8::to_ascii_uppercase);
    let control = program.dialect().control;
    let is_place = b"XYZABCUVWIJKRQF".contains(&address);
    match control {
        // Without its point a number of FANUC may count increments.
        Control::Fanuc | Control::Haas if !is_place => format!("{value}"),
        Control::Heidenhain if address == b'F' || !is_place => format!("{value}"),
        _ => Grid::of(None, Unit::Millimetre).text(value, super::number::Of::Linear, control),
    }
}

/// The line of the second program where it begins to do something else than the first, and its error if it has
/// one there.
fn differs(
    mounted: &Machine,
    [a, b]: [&Program; 2],
    setup: &SetUp,
    contour: Contour,
) -> Option<(u32, Option<String>)> {
    std::thread::scope(|scope| {
        let (to, from) = sync_channel::<Vec<Step>>(4);
        scope.spawn(move || {
            let mut steps = Vec::new();
            execute(mounted, a, setup, &setup.settings(false), &mut |step| {
                steps.push(step);
                if steps.len() >= STEPS {
                    // No receiver is left where they differ.
                    let _ = to.send(std::mem::take(&mut steps));
                }
            });
            let _ = to.send(steps);
        });
        let mut expected = Expected { from, steps: Vec::new().into_iter(), contour };
        let (mut found, mut last) = (None, 0);
        let outcome = execute(mounted, b, setup, &setup.settings(false), &mut |step| {
            let plain = plain(step, Some(contour)).filter(|_| found.is_none());
            let Some((step, origin)) = plain else { return };
            last = origin.line;
            if !expected.next().is_some_and(|known| is_same(&known, &step, ROUNDING)) {
                found = Some(origin.line);
            }
        });
        if let Some(error) = outcome.problems.iter().find(|d| d.severity == Severity::Error) {
            return Some((error.place.line as u32, Some(error.message.clone())));
        }
        let ends_early = expected.next().is_some();
        found.or(ends_early.then_some(last)).map(|line| (line, None))
    })
}

/// The steps of the other program, as they come.
struct Expected {
    from: Receiver<Vec<Step>>,
    steps: std::vec::IntoIter<Step>,
    contour: Contour,
}

impl Expected {
    fn next(&mut self) -> Option<Step> {
        loop {
            match self.steps.next() {
                Some(step) => {
                    if let Some((step, _)) = plain(step, Some(self.contour)) {
                        return Some(step);
                    }
                }
                None => self.steps = self.from.recv().ok()?.into_iter(),
            }
        }
    }
}

/// A step as if it stood nowhere; `None` for what has nothing to do with machining, or is not there any more.
pub(super) fn plain(step: Step, contour: Option<Contour>) -> Option<(Step, Origin)> {
    let nowhere = Origin::default();
    match step {
        Step::Move(mut m) => {
            let origin = std::mem::replace(&mut m.origin, nowhere);
            // Unrolled cycles name coordinates that do not change; the target says where it goes.
            m.named = AxisSet::default();
            use MoveKind::{Align, Dwell, Rapid};
            if matches!(m.kind, Rapid | Dwell { .. } | Align { .. }) {
                // They have no feed, whatever is modal.
                m.feed = Feed { mode: FeedMode::PerMinute, value: 0.0 };
            }
            Some((Step::Move(m), origin))
        }
        Step::Event(Event::Note(_) | Event::Log(_), _) => None,
        Step::Event(Event::Compensation { .. }, _) if contour == Some(Contour::Centre) => None,
        Step::Event(event, origin) => Some((Step::Event(event, nowhere), origin)),
    }
}

/// What rounding makes of numbers of the size of places and feeds: inches have as many decimals as millimetres.
const ROUNDING: f64 = 1e-7;

/// Whether two steps are the same, to so many mm, degrees and mm/min.
pub(super) fn is_same(known: &Step, step: &Step, tolerance: f64) -> bool {
    let (Step::Move(a), Step::Move(b)) = (known, step) else { return known == step };
    let near = |a: f64, b: f64| (a - b).abs() <= tolerance;
    let kind = match (a.kind, b.kind) {
        (MoveKind::Arc(x), MoveKind::Arc(y)) => {
            let centre = x.center_mm.iter().zip(y.center_mm).all(|(x, y)| near(*x, y));
            centre && (x.plane, x.ccw, x.turns) == (y.plane, y.ccw, y.turns)
        }
        (x, y) => x == y,
    };
    let places = a.target.0.iter().zip(b.target.0).all(|(a, b)| near(*a, b));
    let feed = a.feed.mode == b.feed.mode && near(a.feed.value, b.feed.value);
    let direction = match (a.direction, b.direction) {
        (Some(a), Some(b)) => a.iter().zip(b).all(|(a, b)| near(*a, b)),
        (a, b) => a == b,
    };
    kind && places && feed && direction && a.coordinates == b.coordinates
}
