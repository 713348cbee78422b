//! Executes programs of the RS-274 family, FANUC and LinuxCNC, block by block: words in, moves out.
//!
//! What both controls know lies here; `fanuc` and `linuxcnc` hold the tables of their codes and what
//! only one of them has.

mod arc;
mod circular_pocket;
mod cycles;
mod dwell;
mod execute;
mod fanuc;
mod flow;
mod frames;
mod linuxcnc;
mod machine_place;
mod parameters;
mod quick;
mod radius;
mod reported;
mod straight;
mod tables;
mod threading;
mod values;
mod words;

use std::cell::Cell;
use std::collections::HashMap;
use std::rc::Rc;

use trueaxis_blocks::Control;
pub(crate) use trueaxis_blocks::code;

use crate::execution::{Core, Language, Next, Outcome};
use crate::moves::{Move, Position};
use crate::text::program::{Block, Fault, Label, Program, fault};
use frames::Frames;
use linuxcnc::modal_state::Saved;
use linuxcnc::turning::Turning;
use parameters::Locals;
use quick::CodeTable;
use words::{Modes, Words};

/// Executes a program of FANUC or LinuxCNC.
pub(crate) fn interpret(program: &Program, core: Core<'_>) -> Outcome {
    let mut run = Run::new(program, core);
    run.check_turn(run.frames.active, 0);
    run.outcome()
}

/// A program that is being executed, and where.
struct Activation {
    program: usize,
    at: usize,
    line: u32,
    /// The sub, if it is one.
    sub: Option<Label>,
    locals: Locals,
    /// Remaining rounds of `repeat` loops by their byte.
    rounds: HashMap<usize, u64>,
    /// The condition before was false: the next branch is to be tried.
    seeking: bool,
    /// Where its text begins, and its line.
    entry: (usize, u32),
    /// How often a FANUC subprogram is still to be executed.
    repeats: u64,
    /// Its O number has come.
    named: bool,
    /// Its `#1` … are those of its caller: M98.
    shares_locals: bool,
    /// M70 and M73 of LinuxCNC.
    saved: Saved,
}

/// A block and the program that it stands in.
#[derive(Debug, Clone, Copy)]
struct Passage<'b> {
    program: &'b Program,
    block: &'b Block,
}

/// One execution.
struct Run<'r> {
    core: Core<'r>,
    stack: Vec<Activation>,
    globals: HashMap<u32, f64>,
    named: HashMap<String, f64>,
    returned: Option<f64>,
    frames: Frames,
    modes: Modes,
    words: Words,
    codes: CodeTable,
    /// A tape mark opened the program: the next one closes it.
    opened: bool,
    /// A variable that only the running control knows was read: it counted as 0.
    guessed: Cell<Option<u32>>,
    /// The program that the block calls by name.
    called: Option<Label>,
    /// The profile of a turning cycle that is being read.
    turning: Option<Box<Turning>>,
    /// The text of the block's comment, for #3000 and #3006.
    remark: String,
}

impl<'r> Language<'r> for Run<'r> {
    type Room = Block;

    fn core(&mut self) -> &mut Core<'r> {
        &mut self.core
    }

    fn advance(&mut self, block: &mut Block) -> Result<Next, Fault> {
        if self.turning.is_some() && self.profile_is_complete() {
            return self.turn_profile();
        }
        let Some(top) = self.stack.last() else { return Ok(Next::Finished) };
        let program = Rc::clone(&self.core.programs[top.program]);
        if !self.core.settings.report_blocks && self.turning.is_none() {
            self.straight_lines(program.source());
        }
        let Some(top) = self.stack.last() else { return Ok(Next::Finished) };
        let (number, at, line) = (top.program, top.at, top.line);
        if at >= program.source().len() {
            return self.end_of_text().map_err(|fault| self.core.for_good(fault));
        }
        self.core.begin(number, at, line);
        let next = self.quick_or_block(&program, at, line, block);
        if let Ok(Next::Following) = next {
            self.follow(block);
        }
        next
    }

    fn pass_over(&mut self, block: &Block) {
        self.forget_profile();
        self.follow(block);
        if self.core.program().dialect().o_words {
            // LinuxCNC leaves all subs and goes on in the main program.
            self.stack.truncate(1);
        }
    }

    fn emit_frame(&mut self) {
        self.core.emit_frame(self.frames.frame());
        self.emit_dynamic_offset();
    }

    fn position(&self) -> Position {
        self.frames.position
    }

    fn set_position(&mut self, place: Position) {
        self.frames.position = place;
    }
}

impl<'r> Run<'r> {
    fn new(program: &Program, core: Core<'r>) -> Self {
        let settings = core.settings;
        Self {
            stack: vec![Activation::new(0, 0, 1)],
            globals: HashMap::new(),
            named: HashMap::new(),
            returned: None,
            frames: Frames::new(settings.tools.clone(), &settings.work_offsets),
            modes: Modes::new(settings, program.dialect().macro_words),
            words: Words::default(),
            codes: quick::code_table(program.dialect()),
            opened: false,
            guessed: Cell::new(None),
            called: None,
            turning: None,
            remark: String::new(),
            core,
        }
    }

    /// The program is one of FANUC, not of LinuxCNC.
    fn is_fanuc(&self) -> bool {
        self.core.programs[0].dialect().macro_words
    }

    fn is_haas(&self) -> bool {
        self.core.programs[0].dialect().control == Control::Haas
    }

    fn quick_or_block(
        &mut self,
        program: &Program,
        at: usize,
        line: u32,
        block: &mut Block,
    ) -> Result<Next, Fault> {
        let quick = match self.core.settings.report_blocks || self.turning.is_some() {
            true => None,
            false => self.quick(program.dialect(), program.source(), at),
        };
        match quick {
            Some(end) => {
                (block.span, block.line) = (at..end, line);
                self.perform(block)
            }
            None => {
                program.read_block(at, line, block);
                self.block(Passage { program, block })
            }
        }
    }

    fn follow(&mut self, block: &Block) {
        if let Some(top) = self.stack.last_mut() {
            top.at = block.span.end;
            top.line = block.line + 1;
        }
    }

    fn emit_move(&mut self, step: Move) {
        self.watch_dynamic_offset(&step);
        self.frames.position = step.target;
        self.core.emit_move(step);
    }
}
