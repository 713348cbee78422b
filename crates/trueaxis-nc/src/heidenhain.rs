//! Executes HEIDENHAIN Klartext programs.
//!
//! ```text
//!     bytes ──Lexer──> Line (a block, `~` joined) ──Cursor──> statement ──> moves, events
//! ```
//!
//! A block is executed while it is read: Klartext has no expression that reaches beyond its block,
//! so no tree is built.
//!
//! Not applied, each with a warning: 3D compensation, the cycles that
//! `docs/cycles.md` does not list, probing, datum tables, M140 MB MAX without a machine, M103, M109, M138 … Errors, because the path
//! would be unknown: free contours (FK), PLANE AXIAL without a machine, structured IF, FOR and WHILE, and values that
//! only the machine knows (FN 18, Q100 to Q199) as soon as they are used.
//!
//! Preset n of cycle 247 is work offset n of the settings; until then work offset 1 is on.

mod arc_slot;
mod arcs;
mod back_boring;
mod cycles;
mod drilling;
mod flow;
mod functions;
mod milling;
mod path;
mod pattern_def;
mod patterns;
mod plane;
mod radius;
mod statements;
mod straight;
mod thread_mill;
mod tools;
mod values;
mod variables;
mod words;

use std::collections::{BTreeMap, HashMap};
use std::rc::Rc;

use crate::execution::{Core, Language, Next, Outcome};
use crate::moves::chain::TransformationChain;
use crate::moves::{
    Axis, CompensationSide, Coordinates, Event, Move, MoveKind, OrientationPath, Position,
    RotaryDirection,
};
use crate::text::program::{Fault, Program, fault};
use cycles::Cycle;
use flow::{Activation, Labels};
use line::{Cursor, Line};
use trueaxis_blocks::klartext as line;
use variables::Variables;

/// Executes a program of Klartext.
pub(crate) fn interpret(core: Core<'_>) -> Outcome {
    Run::new(core).outcome()
}

/// What lasts from block to block.
struct Modes {
    /// F of the tool call, for FAUTO.
    feed_of_tool: f64,
    side: CompensationSide,
    coolant: bool,
    /// M126: rotary axes take the shortest way.
    shortest: bool,
    /// The last reported motion of the tool axis.
    orientation: OrientationPath,
    /// FUNCTION TCPM AXIS SPAT: A B C are space angles.
    space_angles: bool,
    /// M136: F counts per revolution.
    per_revolution: bool,
    /// M89: the cycle is called at each place.
    cycle_everywhere: bool,
    tool_axis: Option<Axis>,
    tool_length_mm: f64,
    tool_radius_mm: Option<f64>,
}

/// One execution.
struct Run<'r> {
    core: Core<'r>,
    labels: HashMap<usize, Rc<Labels>>,
    stack: Vec<Activation>,
    selected: Option<String>,
    variables: Variables,
    frames: TransformationChain,
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
    /// The places of PATTERN DEF.
    pattern: Vec<pattern_def::PatternPlace>,
    /// The first corner of the blank.
    blank: Option<[f64; 3]>,
    tools: BTreeMap<u32, (f64, Option<f64>)>,
}

impl<'r> Language<'r> for Run<'r> {
    type Room = Line;

    fn core(&mut self) -> &mut Core<'r> {
        &mut self.core
    }

    fn advance(&mut self, line: &mut Line) -> Result<Next, Fault> {
        let Some(active) = self.stack.last() else { return Ok(Next::Finished) };
        let program = Rc::clone(&self.core.programs[active.program]);
        self.straight_lines(program.source());
        let Some(active) = self.stack.last_mut() else { return Ok(Next::Finished) };
        let (number, at) = (active.program, active.at);
        self.core.begin(number, at, active.line);
        if at >= program.source().len() {
            return self.end_of_text(&program).map_err(|fault| self.core.for_good(fault));
        }
        line.read(program.source(), program.dialect(), at);
        active.at = line.end;
        active.line = active.line.saturating_add(line.lines);
        self.block(&program, line)
    }

    /// The block was left before it was executed.
    fn pass_over(&mut self, _line: &Line) {}

    fn emit_frame(&mut self) {
        if self.core.emit_frame(self.frames.frame()) {
            self.tangent = None;
        }
    }

    fn position(&self) -> Position {
        let mut place = self.frames.position;
        for (i, turned) in self.turned.iter().enumerate() {
            place.0[3 + i] += turned;
        }
        place
    }

    fn set_position(&mut self, mut place: Position) {
        for (i, turned) in self.turned.iter().enumerate() {
            place.0[3 + i] -= turned;
        }
        self.frames.position = place;
    }
}

impl<'r> Run<'r> {
    fn new(core: Core<'r>) -> Self {
        let settings = core.settings;
        let modes = Modes {
            feed_of_tool: 0.0,
            side: CompensationSide::Off,
            coolant: false,
            shortest: false,
            orientation: OrientationPath::Axes,
            space_angles: false,
            per_revolution: false,
            cycle_everywhere: false,
            tool_axis: None,
            tool_length_mm: 0.0,
            tool_radius_mm: None,
        };
        let radius = |n: &u32| settings.radii.get(n).copied();
        let tools = settings.tools.iter().map(|(n, p)| (*n, (p[Axis::Z], radius(n)))).collect();
        Self {
            labels: HashMap::new(),
            stack: vec![Activation::main()],
            selected: None,
            variables: Variables::default(),
            frames: TransformationChain::new(settings.work_offsets.get(&1)),
            modes,
            turned: [0.0; 3],
            pole: None,
            tangent: None,
            direction: None,
            cycle: None,
            pattern: Vec::new(),
            blank: None,
            tools,
            core,
        }
    }

    fn block(&mut self, program: &Program, line: &Line) -> Result<Next, Fault> {
        if line.too_long {
            let message = "more than 10000 words in one block";
            return Err(fault(
                "too-many-words",
                line.start,
                message,
                "check whether the file is an NC program",
            ));
        }
        if line.skip && !self.core.settings.skipped_blocks_too {
            return Ok(Next::Following);
        }
        let reported = self.core.settings.report_blocks;
        if reported {
            self.core.emit(Event::Block { text: line.start..line.end });
        }
        if line.tokens.is_empty() {
            return Ok(Next::Following);
        }
        let mut cursor = Cursor::new(program.source(), line);
        let steers = reported && (self.variable(&mut cursor.clone())?.is_some() || cursor.steers());
        let next = self.statement(&mut cursor)?;
        cursor.finish()?;
        if steers {
            self.core.report_computed(line.start..line.end, None);
        }
        match self.core.own_call.take() {
            Some((name, at)) if next == Next::Following => self.call_program(&name, at),
            _ => Ok(next),
        }
    }

    /// A move of which every value is reported; the position is kept.
    fn emit_move(&mut self, mut step: Move, at: usize) -> Result<(), Fault> {
        let numbers = step.target.0.iter().chain(step.direction.iter().flatten());
        if !numbers.chain([&step.feed.value]).all(|v| v.abs() < 1e9) {
            let message = "a coordinate, direction or feed is too large";
            return Err(fault("too-large", at, message, "check the numbers of the block"));
        }
        if step.coordinates == Coordinates::Program {
            for (i, turned) in self.turned.iter_mut().enumerate() {
                let (axis, target) = (3 + i, step.target.0[3 + i]);
                let before = self.frames.position.0[axis];
                if step.rotary_directions[i] == RotaryDirection::Shortest && target != before {
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
        self.core.emit_move(step);
        Ok(())
    }

    /// A move in program coordinates with the feed that is on.
    fn step(&mut self, kind: MoveKind, target: Position, at: usize) -> Result<(), Fault> {
        let before = self.frames.position;
        let mut named = crate::moves::AxisSet::default();
        for axis in Axis::ALL.into_iter().filter(|a| before[*a] != target[*a]) {
            named = named.with(axis);
        }
        let mut step = self.core.plain_move(kind, target, named);
        for (i, axis) in [Axis::A, Axis::B, Axis::C].into_iter().enumerate() {
            if self.modes.shortest && named.contains(axis) {
                step.rotary_directions[i] = RotaryDirection::Shortest;
            }
        }
        self.emit_move(step, at)
    }
}

/// The same turn within half a turn.
fn shortest_deg(turn: f64) -> f64 {
    let turn = turn.rem_euclid(360.0);
    if turn > 180.0 { turn - 360.0 } else { turn }
}
