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
mod contour;
mod drilling;
mod execute;
mod expression;
mod face;
mod flow;
mod functions;
mod milling;
mod motion;
mod orientation;
mod patterns;
mod quick;
mod radius;
mod spigots;
mod swivel;
mod system;
mod tools;
mod transform;
mod values;
mod variables;
mod words;

use std::collections::{BTreeMap, HashMap};
use std::ops::Range;
use std::rc::Rc;
use trueaxis_blocks::siemens::{codes as tables, reader, structure};

use crate::execution::{Core, Language, Next, Outcome};
use crate::moves::{Event, Position};
use crate::text::lexer::Token;
use crate::text::program::{Fault, Program, fault};
pub use archive::{Archive, ArchivedTool, read_archive};
use calls::{Activation, ModalCall};
use chain::Chain;
use execute::Modes;
use reader::Reader;
use structure::Structure;
use words::Words;

/// Executes a program of SINUMERIK.
pub(crate) fn interpret(program: &Program, core: Core<'_>) -> Outcome {
    Run::new(program, core).outcome()
}

/// The state of the control while it executes.
struct Run<'r> {
    core: Core<'r>,
    structures: Vec<Option<Rc<Structure>>>,
    /// The programs that came from the library: number, span and first line.
    loaded: HashMap<String, (usize, Range<usize>, u32)>,
    stack: Vec<Activation>,
    chain: Chain,
    modes: Modes,
    words: Box<Words>,
    /// Room for the words of the next block while those of this one are executed.
    spare: Option<Box<Words>>,
    /// R parameters; what was never set is `None`.
    r: Vec<Option<f64>>,
    modal_call: Option<ModalCall>,
    /// The contour that CYCLE62 named.
    contour: Option<contour::Contour>,
    /// Numbers that names of tools got here.
    names: BTreeMap<String, u32>,
    /// Cells of all live variables.
    cells: usize,
    /// Brackets and functions within each other.
    depth: usize,
    archive: Option<Box<Archive>>,
    /// Where the block ends that is being executed.
    end: usize,
}

impl<'r> Language<'r> for Run<'r> {
    type Room = Vec<Token>;

    fn core(&mut self) -> &mut Core<'r> {
        &mut self.core
    }

    fn advance(&mut self, tokens: &mut Vec<Token>) -> Result<Next, Fault> {
        let Some(top) = self.stack.last_mut() else { return Ok(Next::Finished) };
        if top.at >= top.span.end || top.leaves_section() {
            return self.end_of_section().map_err(|fault| self.core.for_good(fault));
        }
        let (number, at, line) = (top.program, top.at, top.line);
        let program = Rc::clone(&self.core.programs[number]);
        self.core.begin(number, at, line);
        let next = self.one_block(&program, at, tokens);
        if let Ok(Next::Following) = next {
            self.follow();
        }
        next
    }

    fn pass_over(&mut self, _tokens: &Vec<Token>) {
        self.follow();
    }

    fn emit_frame(&mut self) {
        self.core.emit_frame(self.chain.frame());
    }

    fn position(&self) -> Position {
        self.chain.position
    }

    fn set_position(&mut self, place: Position) {
        self.chain.position = place;
    }
}

impl<'r> Run<'r> {
    fn new(program: &Program, core: Core<'r>) -> Self {
        let (start, line, end) = structure::main_section(program);
        Self {
            structures: vec![None],
            loaded: HashMap::new(),
            stack: vec![Activation::new(0, start..end, line)],
            chain: Chain::new(core.settings),
            modes: Modes::new(core.settings),
            words: Box::default(),
            spare: None,
            r: Vec::new(),
            modal_call: None,
            contour: None,
            names: BTreeMap::new(),
            cells: 0,
            depth: 0,
            archive: None,
            end: 0,
            core,
        }
    }

    fn follow(&mut self) {
        if let Some(top) = self.stack.last_mut() {
            top.at = self.end;
            top.line = self.core.origin.line + 1;
        }
    }

    fn one_block(
        &mut self,
        program: &Program,
        at: usize,
        tokens: &mut Vec<Token>,
    ) -> Result<Next, Fault> {
        self.depth = 0;
        let reported = self.core.settings.report_blocks;
        if !reported && let Some(end) = self.quick(program.source(), at) {
            self.end = end;
            return self.perform();
        }
        let line = reader::read_line(program, at, tokens);
        self.end = line.end;
        if line.skip && !self.core.settings.skipped_blocks_too {
            return Ok(Next::Following);
        }
        if let Some(fault) = line.fault {
            return Err(fault);
        }
        let mut reader = Reader::new(program.source(), tokens, line.stop);
        if !reported {
            return self.statement(&mut reader);
        }
        self.core.emit(Event::Block { text: at..line.end });
        let next = self.statement(&mut reader)?;
        if next == Next::Jumped {
            self.core.report_computed(at..line.end, None);
        }
        Ok(next)
    }
}
