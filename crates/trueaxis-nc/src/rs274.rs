//! Executes programs of the RS-274 family, FANUC and LinuxCNC, block by block: words in, moves out.
//!
//! What both controls know lies here; `fanuc` and `linuxcnc` hold the tables of their codes and what
//! only one of them has.

mod arc;
pub mod code;
mod cycles;
mod execute;
pub(crate) mod fanuc;
mod flow;
mod frames;
pub(crate) mod linuxcnc;
mod parameters;
mod quick;
mod straight;
mod tables;
mod told;
mod values;
mod words;

use std::cell::Cell;
use std::collections::{HashMap, HashSet};
use std::rc::Rc;

use trueaxis_input::{Diagnostics, Place};

use crate::execution::library::Library;
use crate::execution::{Outcome, Settings};
use crate::moves::{Event, Frame, Move, Origin, Step};
use crate::text::program::{Block, Fault, Label, Places, Program, fault};
use frames::Frames;
use parameters::Locals;
use quick::CodeTable;
use words::{Modes, Words};

/// Executes a program of FANUC or LinuxCNC.
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

/// What the next block is, after one was executed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Next {
    /// The one that follows.
    Following,
    /// Wherever the current frame was sent.
    Jumped,
    /// None.
    Finished,
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
    /// How often a FANUC subprogram is still to be executed.
    repeats: u64,
    /// Its O number has come.
    named: bool,
    /// Its `#1` … are those of its caller: M98.
    shares_locals: bool,
}

/// One execution.
struct Run<'r> {
    library: &'r dyn Library,
    settings: &'r Settings,
    take: &'r mut dyn FnMut(Step),
    programs: Vec<Rc<Program>>,
    loaded: HashMap<String, usize>,
    stack: Vec<Activation>,
    globals: HashMap<u32, f64>,
    named: HashMap<String, f64>,
    returned: Option<f64>,
    jumps: u64,
    frames: Frames,
    /// What the receiver was told last.
    told: Frame,
    modes: Modes,
    words: Words,
    codes: CodeTable,
    problems: Diagnostics,
    errors: usize,
    reported: HashSet<(&'static str, u32)>,
    origin: Origin,
    /// Where the block begins that is being executed.
    start: usize,
    /// A tape mark opened the program: the next one closes it.
    opened: bool,
    /// A variable that only the running control knows was read: it counted as 0.
    guessed: Cell<Option<u32>>,
    /// The program that the block calls by name.
    called: Option<Label>,
    /// The text of the block's comment, for #3000 and #3006.
    remark: String,
}

impl<'r> Run<'r> {
    fn new(
        program: &Program,
        library: &'r dyn Library,
        settings: &'r Settings,
        take: &'r mut dyn FnMut(Step),
    ) -> Self {
        Self {
            library,
            settings,
            take,
            programs: vec![Rc::new(program.clone())],
            loaded: HashMap::new(),
            stack: vec![Activation::new(0, 0, 1)],
            globals: HashMap::new(),
            named: HashMap::new(),
            returned: None,
            jumps: 0,
            frames: Frames::new(settings.tools.clone(), &settings.work_offsets),
            told: Frame::IDENTITY,
            modes: Modes::new(settings, program.dialect().macro_words),
            words: Words::default(),
            codes: quick::code_table(program.dialect()),
            problems: Diagnostics::new(),
            errors: 0,
            reported: HashSet::new(),
            origin: Origin { program: 0, line: 1 },
            start: 0,
            opened: false,
            guessed: Cell::new(None),
            called: None,
            remark: String::new(),
        }
    }

    fn run(&mut self) -> bool {
        self.check_turn(self.frames.active, 0);
        self.emit_frame();
        let mut block = Block::default();
        while !self.settings.stop.is_asked() {
            let Some(frame) = self.stack.last() else { return true };
            let program = Rc::clone(&self.programs[frame.program]);
            if !self.settings.tell_blocks {
                self.straight_lines(program.source());
            }
            let Some(frame) = self.stack.last() else { return true };
            if frame.at >= program.source().len() {
                match self.end_of_text() {
                    Ok(true) => return true,
                    Ok(false) => continue,
                    Err(fault) => return self.report(fault),
                }
            }
            let (number, at, line) = (frame.program, frame.at, frame.line);
            self.start = at;
            self.origin = Origin { program: number as u32, line };
            match self.quick_or_block(&program, at, line, &mut block) {
                Ok(Next::Finished) => return true,
                Ok(Next::Following) => self.follow(&block),
                Ok(Next::Jumped) => {}
                Err(fault) => {
                    self.report(fault);
                    if !self.settings.keep_going || self.errors >= 100 {
                        return false;
                    }
                    self.follow(&block);
                    if program.dialect().o_words {
                        // LinuxCNC leaves all subs and goes on in the main program.
                        self.stack.truncate(1);
                    }
                }
            }
        }
        false
    }

    fn quick_or_block(
        &mut self,
        program: &Program,
        at: usize,
        line: u32,
        block: &mut Block,
    ) -> Result<Next, Fault> {
        let quick = match self.settings.tell_blocks {
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
                self.block(program, block)
            }
        }
    }

    fn follow(&mut self, block: &Block) {
        if let Some(frame) = self.stack.last_mut() {
            frame.at = block.span.end;
            frame.line = block.line + 1;
        }
    }

    /// Reports a fault of the program that is being executed.
    fn report(&mut self, fault: Fault) -> bool {
        let place = self.place(fault.offset);
        self.problems.error(fault.code, place, fault.message, fault.hint);
        self.errors += 1;
        false
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
    fn warn_once(
        &mut self,
        code: &'static str,
        subject: u32,
        offset: usize,
        message: String,
        hint: &str,
    ) {
        if self.reported.insert((code, subject)) {
            let place = self.place(offset);
            self.problems.warn(code, place, message, hint);
        }
    }

    fn emit(&mut self, event: Event) {
        (self.take)(Step::Event(event, self.origin));
    }

    /// Tells the frame if it has changed.
    fn emit_frame(&mut self) {
        let frame = self.frames.frame();
        if frame != self.told {
            self.told = frame;
            self.emit(Event::Frame(frame));
        }
    }

    fn emit_move(&mut self, step: Move) {
        self.frames.position = step.target;
        (self.take)(Step::Move(step));
    }
}
