//! Executes SINUMERIK 840D programs.
//!
//! ```text
//! block ─Reader─> control statement ─flow, calls─> next block
//!              └> words, assignments ─execute─> moves, events
//! ```
//!
//! Expressions are evaluated where they are read: a block is taken apart each time it is executed.
//!
//! # Sources
//! Siemens, SINUMERIK 840D sl Programming Manuals "Fundamentals" and "Job Planning"; Operating
//! Manual "Milling" for the parameters of cycles.

mod arc;
mod archive;
mod calls;
mod chain;
pub(crate) mod dialect;
mod drilling;
mod execute;
mod expression;
mod flow;
mod functions;
mod motion;
mod orientation;
mod quick;
mod reader;
mod structure;
mod swivel;
mod system;
mod tables;
mod tools;
mod transform;
mod values;
mod variables;
mod words;

use std::collections::{BTreeMap, HashMap, HashSet};
use std::rc::Rc;

use trueaxis_input::{Diagnostics, Place};

use crate::execution::library::Library;
use crate::execution::{Outcome, Settings};
use crate::moves::{Event, Frame, Move, Origin, Step};
use crate::text::program::{Fault, Places, Program, fault};
pub use archive::{Archive, ArchivedTool, read_archive};
use calls::{Activation, ModalCall};
use chain::Chain;
use execute::Modes;
use reader::Reader;
use structure::Structure;
use words::Words;

/// Errors that a run lists before it stops.
const MOST_ERRORS: usize = 100;

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
    /// Wherever the current activation was sent.
    Jumped,
    /// None.
    Finished,
}

/// The state of the control while it executes.
struct Run<'r> {
    library: &'r dyn Library,
    settings: &'r Settings,
    take: &'r mut dyn FnMut(Step),
    programs: Vec<Rc<Program>>,
    structures: Vec<Option<Rc<Structure>>>,
    /// The programs that came from the library: number, span and first line.
    loaded: HashMap<String, (usize, std::ops::Range<usize>, u32)>,
    stack: Vec<Activation>,
    jumps: u64,
    chain: Chain,
    /// The frame as it was told last.
    told: Frame,
    modes: Modes,
    words: Box<Words>,
    /// Room for the words of the next block while those of this one are executed.
    spare: Option<Box<Words>>,
    /// R parameters; what was never set is `None`.
    r: Vec<Option<f64>>,
    modal_call: Option<ModalCall>,
    /// Numbers that names of tools got here.
    names: BTreeMap<String, u32>,
    /// Cells of all live variables.
    cells: usize,
    /// Brackets and functions within each other.
    depth: usize,
    archive: Option<Box<Archive>>,
    problems: Diagnostics,
    errors: usize,
    reported: HashSet<(&'static str, String)>,
    origin: Origin,
    /// Where the block begins that is being executed, and ends.
    block: std::ops::Range<usize>,
}

impl<'r> Run<'r> {
    fn new(
        program: &Program,
        library: &'r dyn Library,
        settings: &'r Settings,
        take: &'r mut dyn FnMut(Step),
    ) -> Self {
        let (start, line, end) = structure::main_section(program.source());
        Self {
            library,
            settings,
            take,
            programs: vec![Rc::new(program.clone())],
            structures: vec![None],
            loaded: HashMap::new(),
            stack: vec![Activation::new(0, start..end, line)],
            jumps: 0,
            chain: Chain::new(settings),
            told: Frame::IDENTITY,
            modes: Modes::new(settings),
            words: Box::default(),
            spare: None,
            r: Vec::new(),
            modal_call: None,
            names: BTreeMap::new(),
            cells: 0,
            depth: 0,
            archive: None,
            problems: Diagnostics::new(),
            errors: 0,
            reported: HashSet::new(),
            origin: Origin { program: 0, line: 1 },
            block: 0..0,
        }
    }

    fn run(&mut self) -> bool {
        self.emit_frame();
        let mut tokens = Vec::new();
        while !self.settings.stop.is_asked() {
            let Some(top) = self.stack.last_mut() else { return true };
            if top.at >= top.span.end || top.leaves_section() {
                match self.end_of_section() {
                    Ok(Next::Finished) => return true,
                    Ok(_) => continue,
                    Err(fault) => {
                        self.report(fault);
                        return false;
                    }
                }
            }
            let (number, at, line) = (top.program, top.at, top.line);
            let program = Rc::clone(&self.programs[number]);
            self.origin = Origin { program: number as u32, line };
            match self.one_block(&program, at, &mut tokens) {
                Ok(Next::Finished) => return true,
                Ok(Next::Following) => self.follow(),
                Ok(Next::Jumped) => {}
                Err(fault) => {
                    self.report(fault);
                    if !self.settings.keep_going || self.errors >= MOST_ERRORS {
                        return false;
                    }
                    self.follow();
                }
            }
        }
        false
    }

    fn one_block(
        &mut self,
        program: &Program,
        at: usize,
        tokens: &mut Vec<crate::text::lexer::Token>,
    ) -> Result<Next, Fault> {
        self.depth = 0;
        let told = self.settings.tell_blocks;
        if !told && let Some(end) = self.quick(program.source(), at) {
            self.block = at..end;
            return self.perform();
        }
        let line = reader::read_line(program, at, tokens);
        self.block = at..line.end;
        if line.skip && !self.settings.skipped_blocks_too {
            return Ok(Next::Following);
        }
        if let Some(fault) = line.fault {
            return Err(fault);
        }
        let mut reader = Reader::new(program.source(), tokens, line.stop);
        if !told {
            return self.statement(&mut reader);
        }
        self.emit(Event::Block { text: at..line.end });
        let next = self.statement(&mut reader)?;
        if next == Next::Jumped {
            self.tell_steering(at..line.end);
        }
        Ok(next)
    }

    /// A part of the block that only steers the execution, if anybody asks.
    fn tell_steering(&mut self, text: std::ops::Range<usize>) {
        if self.settings.tell_blocks {
            self.emit(Event::Computed { text, value: None });
        }
    }

    fn follow(&mut self) {
        let end = self.block.end;
        if let Some(top) = self.stack.last_mut() {
            top.at = end;
            top.line = self.origin.line + 1;
        }
    }

    /// Reports a fault of the program that is being executed.
    fn report(&mut self, fault: Fault) {
        let place = self.place(fault.offset);
        self.problems.error(fault.code, place, fault.message, fault.hint);
        self.errors += 1;
    }

    /// A fault after which nothing can go on.
    fn stop_for_good(&mut self) {
        self.errors = self.errors.max(MOST_ERRORS);
    }

    fn place(&self, offset: usize) -> Place {
        let program = &self.programs[self.origin.program as usize];
        let mut places = Places::new(program);
        if offset >= self.block.start {
            places = Places::beginning(program, self.block.start, self.origin.line);
        }
        places.of(offset)
    }

    /// Warns once about each subject.
    fn warn_once(
        &mut self,
        code: &'static str,
        subject: &str,
        offset: usize,
        message: String,
        hint: &str,
    ) {
        if self.reported.len() < 10_000 && self.reported.insert((code, subject.to_owned())) {
            let place = self.place(offset);
            self.problems.warn(code, place, message, hint);
        }
    }

    /// Warns that something known has no effect here.
    fn not_applied(&mut self, subject: &str, offset: usize, hint: &str) {
        let message = format!("{subject} is not applied");
        self.warn_once("not-applied", subject, offset, message, hint);
    }

    fn emit(&mut self, event: Event) {
        (self.take)(Step::Event(event, self.origin));
    }

    /// Tells the frame if it has changed.
    fn emit_frame(&mut self) {
        let frame = self.chain.frame();
        if frame != self.told {
            self.told = frame;
            self.emit(Event::Frame(frame));
        }
    }

    fn emit_move(&mut self, step: Move) {
        (self.take)(Step::Move(step));
    }
}
