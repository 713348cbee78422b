//! Executes HEIDENHAIN Klartext programs.
//!
//! ```text
//!     bytes ──Lexer──> Line (a block, `~` joined) ──Cursor──> statement ──> moves, events
//! ```
//!
//! A block is executed while it is read: Klartext has no expression that reaches beyond its block,
//! so no tree is built.
//!
//! What is left out, each with a warning: radius and 3D compensation, RND and CHF (the corner is
//! kept), APPR (a line to its point), cycles other than drilling, patterns, probing, datum tables,
//! M140 MB MAX, M103, M109, M138 … Errors, because the path would be unknown: free contours (FK),
//! PLANE PROJECTED and AXIAL, structured IF, FOR and WHILE, and values that only the machine knows
//! (FN 18, Q100 to Q199) as soon as they are used.
//!
//! Preset n of cycle 247 is work offset n of the settings; until then work offset 1 is on.

mod arcs;
mod cycles;
pub(crate) mod dialect;
mod drilling;
mod flow;
mod frames;
mod functions;
mod line;
mod path;
mod plane;
mod statements;
mod tools;
mod values;
mod variables;
mod words;

use std::collections::{BTreeMap, HashMap, HashSet};
use std::rc::Rc;

use trueaxis_input::{Diagnostics, Place};

use crate::execution::library::Library;
use crate::execution::{Outcome, Settings};
use crate::moves::{
    Axis, CompensationSide, Coordinates, Event, Feed, FeedMode, Frame, Move, MoveKind,
    OrientationPath, Origin, Plane, Position, Step, Turning, Way,
};
use crate::text::program::{Fault, Places, Program, fault};
use cycles::Cycle;
use flow::{Activation, Labels, Next};
use frames::Frames;
use line::{Cursor, Line};
use variables::Variables;

pub(crate) fn interpret(
    program: &Program,
    library: &dyn Library,
    settings: &Settings,
    take: &mut dyn FnMut(Step),
) -> Outcome {
    let mut run = Run::new(program, library, settings, take);
    let finished = run.run();
    let programs = run.programs.iter().map(|p| p.file().to_owned()).collect();
    Outcome { problems: run.problems, finished, programs }
}

/// Warnings of one run: more than anybody reads.
const MOST_WARNINGS: usize = 1000;

/// What lasts from block to block.
struct Modes {
    inches: bool,
    plane: Plane,
    feed: Feed,
    /// F of the tool call, for FAUTO.
    feed_of_tool: f64,
    side: CompensationSide,
    turning: Turning,
    coolant: bool,
    /// M126: rotary axes take the shortest way.
    shortest: bool,
    /// The tip of the tool is programmed.
    tool_centre: bool,
    /// How the tool axis turns, as the receiver was told last.
    orientation: OrientationPath,
    /// FUNCTION TCPM AXIS SPAT: A B C are space angles.
    space_angles: bool,
    /// M136: F counts per revolution.
    per_revolution: bool,
    /// M89: the cycle is called at each place.
    cycle_everywhere: bool,
    tool: u32,
    tool_axis: Option<Axis>,
    tool_length_mm: f64,
    tool_radius_mm: Option<f64>,
}

/// One execution.
struct Run<'r> {
    library: &'r dyn Library,
    settings: &'r Settings,
    take: &'r mut dyn FnMut(Step),
    programs: Vec<Rc<Program>>,
    loaded: HashMap<String, usize>,
    labels: HashMap<usize, Rc<Labels>>,
    stack: Vec<Activation>,
    selected: Option<String>,
    variables: Variables,
    jumps: u64,
    frames: Frames,
    /// What the receiver was told last.
    told: Frame,
    modes: Modes,
    /// Full turns of A, B and C that the display does not show (M94, M126), degrees.
    turned: [f64; 3],
    /// The centre of polar coordinates and circles in the plane.
    pole: Option<[f64; 2]>,
    /// Where the path runs at the end of the last move.
    tangent: Option<[f64; 3]>,
    /// The last direction that was programmed as a vector.
    direction: Option<[f64; 3]>,
    cycle: Option<Cycle>,
    /// The first corner of the blank.
    blank: Option<[f64; 3]>,
    tools: BTreeMap<u32, (f64, Option<f64>)>,
    problems: Diagnostics,
    errors: usize,
    reported: HashSet<(&'static str, String)>,
    origin: Origin,
    /// Where the block begins that is being executed.
    start: usize,
}

impl<'r> Run<'r> {
    fn new(
        program: &Program,
        library: &'r dyn Library,
        settings: &'r Settings,
        take: &'r mut dyn FnMut(Step),
    ) -> Self {
        let modes = Modes {
            inches: settings.inches,
            plane: settings.plane,
            feed: Feed { mode: FeedMode::PerMinute, value: 0.0 },
            feed_of_tool: 0.0,
            side: CompensationSide::Off,
            turning: Turning::Stopped,
            coolant: false,
            shortest: false,
            tool_centre: false,
            orientation: OrientationPath::Axes,
            space_angles: false,
            per_revolution: false,
            cycle_everywhere: false,
            tool: 0,
            tool_axis: None,
            tool_length_mm: 0.0,
            tool_radius_mm: None,
        };
        let tools = settings.tools.iter().map(|(n, p)| (*n, (p[Axis::Z], None))).collect();
        Self {
            library,
            settings,
            take,
            programs: vec![Rc::new(program.clone())],
            loaded: HashMap::new(),
            labels: HashMap::new(),
            stack: vec![Activation::main()],
            selected: None,
            variables: Variables::default(),
            jumps: 0,
            frames: Frames::new(settings.work_offsets.get(&1)),
            told: Frame::IDENTITY,
            modes,
            turned: [0.0; 3],
            pole: None,
            tangent: None,
            direction: None,
            cycle: None,
            blank: None,
            tools,
            problems: Diagnostics::new(),
            errors: 0,
            reported: HashSet::new(),
            origin: Origin { program: 0, line: 1 },
            start: 0,
        }
    }

    fn run(&mut self) -> bool {
        self.emit_frame();
        let mut line = Line::default();
        while !self.settings.stop.is_asked() {
            let Some(active) = self.stack.last() else { return true };
            let (number, at) = (active.program, active.at);
            let program = Rc::clone(&self.programs[number]);
            self.origin = Origin { program: number as u32, line: active.line };
            self.start = at;
            let next = if at >= program.source().len() {
                self.end_of_text(&program)
            } else {
                line.read(program.source(), program.dialect(), at);
                if let Some(active) = self.stack.last_mut() {
                    active.at = line.end;
                    active.line = active.line.saturating_add(line.lines);
                }
                self.block(&program, &line)
            };
            match next {
                Ok(Next::Finished) => return true,
                Ok(_) => {}
                Err(fault) => {
                    self.report(fault);
                    if !self.settings.keep_going || self.errors >= 100 || at >= line.end {
                        return false;
                    }
                }
            }
        }
        false
    }

    fn block(&mut self, program: &Program, line: &Line) -> Result<Next, Fault> {
        if line.too_long {
            let message = "more than 10000 words in one block".to_owned();
            return Err(fault("too-many-words", line.start, message, "is this an NC program?"));
        }
        if line.skip && !self.settings.skipped_blocks_too {
            return Ok(Next::Following);
        }
        let told = self.settings.tell_blocks;
        if told {
            self.emit(Event::Block { text: line.start..line.end });
        }
        if line.tokens.is_empty() {
            return Ok(Next::Following);
        }
        let mut cursor = Cursor::new(program.source(), line);
        let steers = told && (self.variable(&mut cursor.clone())?.is_some() || cursor.steers());
        let next = self.statement(&mut cursor)?;
        cursor.finish()?;
        if steers {
            self.emit(Event::Computed { text: line.start..line.end, value: None });
        }
        Ok(next)
    }

    /// Reports a fault of the program that is being executed.
    fn report(&mut self, fault: Fault) {
        let place = self.place(fault.offset);
        self.problems.error(fault.code, place, fault.message, fault.hint);
        self.errors += 1;
    }

    fn place(&self, offset: usize) -> Place {
        let program = &self.programs[self.origin.program as usize];
        let mut places = Places::new(program);
        if offset >= self.start {
            places = Places::beginning(program, self.start, self.origin.line);
        }
        places.of(offset)
    }

    /// Warns once about each subject.
    fn warn(&mut self, code: &'static str, subject: &str, at: usize, message: &str, hint: &str) {
        // Hostile programs could fill the memory with warnings about ever new numbers.
        if self.reported.len() < MOST_WARNINGS && self.reported.insert((code, subject.to_owned())) {
            let place = self.place(at);
            self.problems.warn(code, place, message.to_owned(), hint);
        }
    }

    /// Warns once that something known is left out.
    fn not_applied(&mut self, name: &str, at: usize) {
        let message = format!("{name} is not applied");
        let hint = "the moves that follow are those without it";
        self.warn("not-applied", name, at, &message, hint);
    }

    fn emit(&mut self, event: Event) {
        (self.take)(Step::Event(event, self.origin));
    }

    /// Tells the frame if it has changed.
    fn emit_frame(&mut self) {
        let frame = self.frames.frame();
        if frame != self.told {
            self.told = frame;
            self.tangent = None;
            self.emit(Event::Frame(frame));
        }
    }

    /// A move of which every value is told; the place is kept.
    fn emit_move(&mut self, mut step: Move, at: usize) -> Result<(), Fault> {
        let numbers = step.target.0.iter().chain(step.direction.iter().flatten());
        if !numbers.chain([&step.feed.value]).all(|v| v.abs() < 1e9) {
            let message = "a coordinate, direction or feed is too large".to_owned();
            return Err(fault("too-large", at, message, "check the numbers of the block"));
        }
        if step.coordinates == Coordinates::Program {
            for (i, turned) in self.turned.iter_mut().enumerate() {
                let (axis, target) = (3 + i, step.target.0[3 + i]);
                let before = self.frames.position.0[axis];
                if step.ways[i] == Way::Shortest && target != before {
                    // The display shows the written angle, whatever turns the axis has made.
                    *turned += before + shortest_deg(target - before) - target;
                }
                step.target.0[axis] += *turned;
                self.frames.position.0[axis] = target;
            }
            for (i, value) in step.target.0.iter().enumerate().filter(|(i, _)| !(3..6).contains(i))
            {
                self.frames.position.0[i] = *value;
            }
        }
        (self.take)(Step::Move(step));
        Ok(())
    }

    /// A move in program coordinates with the feed that is on.
    fn step(&mut self, kind: MoveKind, target: Position, at: usize) -> Result<(), Fault> {
        let before = self.frames.position;
        let mut named = crate::moves::AxisSet::default();
        for axis in Axis::ALL.into_iter().filter(|a| before[*a] != target[*a]) {
            named = named.with(axis);
        }
        let mut step = Move::plain(kind, target, named, self.modes.feed, self.origin);
        if self.modes.shortest {
            step.ways = [Way::Shortest; 3];
        }
        self.emit_move(step, at)
    }

    fn unit_mm(&self) -> f64 {
        if self.modes.inches { 25.4 } else { 1.0 }
    }
}

/// The same turn within half a turn.
fn shortest_deg(turn: f64) -> f64 {
    let turn = turn.rem_euclid(360.0);
    if turn > 180.0 { turn - 360.0 } else { turn }
}
