//! Subprograms, cycles, messages.

use std::collections::HashMap;
use std::ops::Range;
use std::rc::Rc;

use super::execute::Modes;
use super::reader::{self, Reader};
use super::structure::{main_section, plain_name};
use super::tables;
use super::values::{Kind, Value, Variable};
use super::variables::Slot;
use super::{Next, Run, fault, functions};
use crate::execution::{Modes as CommonModes, OwnCode, mistakes};
use crate::moves::Event;
use crate::text::program::Fault;

/// A part of a program that is executed again.
#[derive(Debug, Clone)]
pub(super) struct Repetition {
    pub span: Range<usize>,
    pub line: u32,
    pub left: u64,
    /// Byte and line where it goes on afterwards.
    pub back: (usize, u32),
}

/// A program that is being executed, and where.
pub(super) struct Activation {
    pub program: usize,
    pub span: Range<usize>,
    pub first_line: u32,
    pub at: usize,
    pub line: u32,
    pub variables: HashMap<String, Variable>,
    pub sections: Vec<Repetition>,
    /// The FOR that continues to count instead of beginning again.
    pub continuing: Option<usize>,
    /// Further rounds of the whole program, and where each begins.
    rounds: (u64, usize, u32),
    /// Parameters by reference: the name here, the place at the caller.
    references: Vec<(String, Slot)>,
    /// What SAVE brings back.
    saved: Option<Box<(CommonModes, Modes)>>,
}

impl Activation {
    pub fn new(program: usize, span: Range<usize>, line: u32) -> Self {
        Self {
            program,
            at: span.start,
            span,
            first_line: line,
            line,
            variables: HashMap::new(),
            sections: Vec::new(),
            continuing: None,
            rounds: (0, 0, 1),
            references: Vec::new(),
            saved: None,
        }
    }

    /// The end of the repeated part is reached.
    pub fn leaves_section(&self) -> bool {
        self.sections.last().is_some_and(|s| self.at >= s.span.end)
    }

    /// A jump to a byte leaves the repeated parts that do not hold it.
    pub fn leave_sections(&mut self, at: usize) {
        while self.sections.last().is_some_and(|s| !(s.span.start..=s.span.end).contains(&at)) {
            self.sections.pop();
        }
    }
}

/// The subprogram called after each block with a move.
#[derive(Debug, Clone)]
pub(super) struct ModalCall {
    pub name: String,
    pub arguments: Vec<Argument>,
    /// The calls within each other where it was given.
    pub depth: usize,
}

/// A value and, if it is a variable, its place.
#[derive(Debug, Clone)]
pub(super) struct Argument {
    pub value: Option<Value>,
    slot: Option<Slot>,
}

impl Run<'_> {
    /// Calls, messages and whatever takes a whole block; `None` if the word is none of these.
    pub(super) fn call_statement(
        &mut self,
        word: &str,
        reader: &mut Reader<'_>,
        at: usize,
    ) -> Result<Option<Next>, Fault> {
        match word {
            "MSG" => {
                reader.advance();
                let values = self.arguments(reader)?;
                let text = values.first().and_then(Option::as_ref).map(functions::message);
                self.core.emit(Event::Message(text.unwrap_or_default()));
                return Ok(reader.is_empty().then_some(Next::Following));
            }
            "RET" => {
                reader.advance();
                if !self.arguments(reader)?.is_empty() {
                    self.core.not_applied(
                        "RET with a target",
                        at,
                        "it returns to the block after the call",
                    );
                }
                return self.return_from(1).map(Some);
            }
            "SETAL" => {
                reader.advance();
                let values = self.arguments(reader)?;
                let texts: Vec<_> = values.iter().flatten().map(functions::message).collect();
                return Err(self.core.for_good(mistakes::alarm(&texts.join(": "), at)));
            }
            "CALL" | "PCALL" | "EXTCALL" | "ISOCALL" => {
                return self.call_by_text(word, reader, at).map(Some);
            }
            "MCALL" => {
                reader.advance();
                self.modal_call = None;
                if !reader.is_empty() {
                    let (name, arguments) = self.called(reader)?;
                    let depth = self.stack.len();
                    self.modal_call = Some(ModalCall { name, arguments, depth });
                }
                return Ok(Some(Next::Following));
            }
            "DEFINE" => {
                let hint = "write the text of the macro instead";
                self.core.not_applied("DEFINE", at, hint);
                return Ok(Some(Next::Following));
            }
            "WRITE" | "DELETE" | "MMC" | "NEWCONF" => {
                self.core.emit(Event::Note("file, display or machine data"));
                return Ok(Some(Next::Following));
            }
            _ if tables::takes_block(word) => {
                let hint = "the following moves are computed without it";
                self.core.not_applied(word, at, hint);
                return Ok(Some(Next::Following));
            }
            _ => {}
        }
        self.plain_call(word, reader, at)
    }

    /// A program or cycle by its name alone; `None` if the word is something else.
    fn plain_call(
        &mut self,
        word: &str,
        reader: &mut Reader<'_>,
        at: usize,
    ) -> Result<Option<Next>, Fault> {
        let alone = match reader.ahead(1) {
            None => true,
            Some(_) if reader.symbol_ahead(1) == Some(b'(') => true,
            Some(_) => reader.letter_ahead(1) == Some(b'P'),
        };
        if !alone || tables::code(word).is_some() || tables::is_note(word).is_some() {
            return Ok(None);
        }
        if tables::parameter(word).is_some()
            || self.core.settings.constants.contains_key(&word.to_ascii_lowercase())
        {
            return Ok(None);
        }
        let (name, arguments) = self.called(reader)?;
        let rounds = self.rounds(reader)?;
        self.call(&name, arguments, rounds, at).map(Some)
    }

    /// A name with its arguments.
    pub(super) fn called(
        &mut self,
        reader: &mut Reader<'_>,
    ) -> Result<(String, Vec<Argument>), Fault> {
        let Some((name, length)) = reader.name() else {
            let message = "expected the name of a program";
            return Err(fault(
                "missing-value",
                reader.here(),
                message,
                "write the name of the program",
            ));
        };
        reader.at += length;
        let mut arguments = Vec::new();
        let open = reader.here();
        if !reader.accept(b'(') || reader.accept(b')') {
            return Ok((name, arguments));
        }
        loop {
            arguments.push(self.argument(reader)?);
            if reader.accept(b')') {
                return Ok((name, arguments));
            }
            if !reader.accept(b',') {
                return Err(mistakes::unclosed_bracket(open));
            }
        }
    }

    fn argument(&mut self, reader: &mut Reader<'_>) -> Result<Argument, Fault> {
        if let Some(b',' | b')') = reader.symbol() {
            return Ok(Argument { value: None, slot: None });
        }
        let mut probe = *reader;
        let is_r = reader.letter() == Some(b'R') && reader.ahead(1).is_some();
        let is_name = reader.word().is_some_and(|w| self.has_variable(&w));
        let slot = if is_r || is_name {
            let slot = self.slot(&mut probe)?;
            matches!(probe.symbol(), Some(b',' | b')')).then_some(slot)
        } else {
            None
        };
        Ok(Argument { value: Some(self.expression(reader)?), slot })
    }

    /// `P3` or `P=3` after a call.
    pub(super) fn rounds(&mut self, reader: &mut Reader<'_>) -> Result<u64, Fault> {
        if reader.letter() == Some(b'P') {
            reader.advance();
            reader.accept(b'=');
            return Ok(self.number(reader)?.clamp(0.0, 1e9) as u64);
        }
        self.nothing_more(reader).map(|()| 1)
    }

    /// CALL "NAME", CALL NAME, PCALL path(arguments), EXTCALL "NAME".
    fn call_by_text(
        &mut self,
        word: &str,
        reader: &mut Reader<'_>,
        at: usize,
    ) -> Result<Next, Fault> {
        reader.advance();
        if word == "ISOCALL" || reader.accept_word("BLOCK") {
            let subject = format!("{word} of blocks or ISO programs");
            self.core.not_applied(&subject, at, "write the blocks here");
            return Ok(Next::Following);
        }
        let bracket = word == "EXTCALL" && reader.accept(b'(');
        let plain = word == "PCALL"
            || reader.word().is_some_and(|w| !self.has_variable(&w) && !reader.source.is_empty());
        let (name, arguments) = if plain && reader.symbol() != Some(b'(') {
            while reader.accept(b'/') {
                if reader.symbol_ahead(1) == Some(b'/') {
                    reader.advance();
                }
            }
            self.called(reader)?
        } else {
            let name = self.text(reader)?;
            (name, Vec::new())
        };
        if bracket {
            reader.require(b')', "write one ) for each (")?;
        }
        let rounds = self.rounds(reader)?;
        if word == "EXTCALL" && self.find_program(&name, at).is_err() {
            let message = format!(
                "the program {name} of EXTCALL was not found: its moves are missing from the path"
            );
            let hint = "put it into the folder of the program";
            self.core.warn("not-executed", &name, at, message, hint);
            return Ok(Next::Following);
        }
        self.call(&name, arguments, rounds, at)
    }

    /// Calls a program or cycle by its name.
    pub(super) fn call(
        &mut self,
        name: &str,
        arguments: Vec<Argument>,
        rounds: u64,
        at: usize,
    ) -> Result<Next, Fault> {
        let own = self.core.settings.codes.get(&name.to_ascii_uppercase()).cloned();
        let name = match &own {
            Some(OwnCode::Call(program)) => program.as_str(),
            Some(_) => {
                self.core.own_code(&name.to_ascii_uppercase(), at);
                return Ok(Next::Following);
            }
            None => name,
        };
        let cycle = tables::is_cycle(name);
        if cycle {
            let values: Vec<_> = arguments.iter().map(|a| a.value.clone()).collect();
            if self.cycle(name, &values, at)? {
                return Ok(Next::Following);
            }
        }
        let found = match self.find_program(name, at) {
            Ok(found) => found,
            Err(_) if cycle || self.archive.is_some() => {
                let message =
                    format!("{name} is not executed: its moves are missing from the path");
                let hint = "the other moves are those of the program";
                if self.archive.is_none() {
                    self.core.warn("not-executed", name, at, message, hint);
                }
                return Ok(Next::Following);
            }
            Err(fault) => return Err(fault),
        };
        if rounds == 0 {
            return Ok(Next::Following);
        }
        self.core.count(at)?;
        self.core.check_depth(self.stack.len(), at)?;
        self.follow();
        self.enter(found, arguments, rounds, at)?;
        Ok(Next::Jumped)
    }

    /// A program by its name: beside the running one in its file, or from the library.
    pub(super) fn find_program(
        &mut self,
        name: &str,
        at: usize,
    ) -> Result<(usize, Range<usize>, u32), Fault> {
        let plain = plain_name(name);
        let program = self.core.origin.program as usize;
        let structure = self.structure_of(program);
        if let Some(section) = structure.sections.iter().find(|s| s.name == plain) {
            return Ok((program, section.span.clone(), section.line));
        }
        if let Some(found) = self.loaded.get(&plain) {
            return Ok(found.clone());
        }
        let last = name.rsplit(['/', '\\']).next().unwrap_or(name).to_owned();
        let mut names =
            vec![last.clone(), last.to_ascii_uppercase(), last.to_ascii_lowercase(), plain.clone()];
        for end in ["SPF", "MPF", "spf", "mpf"] {
            names.push(format!("{plain}.{end}"));
            names.push(format!("{}.{end}", plain.to_ascii_lowercase()));
        }
        let number = self.core.load(name, names, at)?;
        let (start, line, end) = main_section(&self.core.programs[number]);
        let found = (number, start..end, line);
        self.loaded.insert(plain, found.clone());
        Ok(found)
    }

    fn enter(
        &mut self,
        place: (usize, Range<usize>, u32),
        arguments: Vec<Argument>,
        rounds: u64,
        at: usize,
    ) -> Result<(), Fault> {
        let (number, span, line) = place;
        let program = Rc::clone(&self.core.programs[number]);
        let mut activation = Activation::new(number, span.clone(), line);
        let mut tokens = Vec::new();
        let (mut start, mut here) = (span.start, line);
        let mut bound = false;
        while start < span.end {
            let read = reader::read_line(&program, start, &mut tokens);
            if !tokens.is_empty() {
                let mut reader = Reader::new(program.source(), &tokens, read.stop);
                if reader.letter() == Some(b'N') {
                    reader.at += 2;
                }
                if reader.accept_word("PROC") {
                    self.stack.push(activation);
                    let result = self.bind(&mut reader, &arguments, at);
                    let Some(top) = self.stack.pop() else { return result };
                    activation = top;
                    result?;
                    (bound, start, here) = (true, read.end, here + 1);
                }
                break;
            }
            (start, here) = (read.end, here + 1);
        }
        if !bound && arguments.iter().any(|a| a.value.is_some()) {
            let message = "the subprogram has no PROC for these arguments";
            let hint = "begin the subprogram with PROC NAME(REAL A)";
            self.core.warn("unused-arguments", number, at, message, hint);
        }
        (activation.at, activation.line) = (start, here);
        activation.rounds = (rounds - 1, start, here);
        self.stack.push(activation);
        Ok(())
    }

    /// Declares the parameters of `PROC NAME(REAL A, VAR INT B, REAL C=5) SAVE` in the top
    /// activation.
    fn bind(
        &mut self,
        reader: &mut Reader<'_>,
        arguments: &[Argument],
        at: usize,
    ) -> Result<(), Fault> {
        // The name of the program: of one token, or L and its number.
        reader.at += reader.name().map_or(1, |(_, length)| length);
        let mut index = 0;
        if reader.accept(b'(') {
            while !reader.accept(b')') {
                if reader.is_empty() {
                    return Err(mistakes::unclosed_bracket(at));
                }
                self.parameter(reader, arguments.get(index), at)?;
                index += 1;
                reader.accept(b',');
            }
        }
        if arguments.len() > index {
            let message = format!(
                "the call has {} arguments, but PROC has {index} parameters",
                arguments.len()
            );
            return Err(fault("too-many-arguments", at, message, "check the call"));
        }
        while let Some(word) = reader.word() {
            reader.advance();
            if word == "SAVE" {
                let modes = Box::new((self.core.modes.clone(), self.modes.clone()));
                if let Some(top) = self.stack.last_mut() {
                    top.saved = Some(modes);
                }
            }
        }
        Ok(())
    }

    fn parameter(
        &mut self,
        reader: &mut Reader<'_>,
        argument: Option<&Argument>,
        at: usize,
    ) -> Result<(), Fault> {
        let by_reference = reader.accept_word("VAR");
        let kind: Kind = self.kind(reader)?;
        let Some(name) = reader.word() else {
            let message = "expected the name of a parameter in PROC";
            return Err(fault("bad-definition", at, message, "names begin with two letters or _"));
        };
        reader.advance();
        let sizes = self.sizes(reader)?;
        self.declare(&name, kind, sizes, at)?;
        let place = Slot::Cell(name.clone(), 0);
        let default = match reader.equals_ahead(0) {
            true => {
                reader.advance();
                Some(self.expression(reader)?)
            }
            false => None,
        };
        if let Some(value) = argument.and_then(|a| a.value.clone()).or(default) {
            self.write(&place, value, at)?;
        }
        if by_reference
            && let Some(slot) = argument.and_then(|a| a.slot.clone())
            && let Some(top) = self.stack.last_mut()
        {
            top.references.push((name, slot));
        }
        Ok(())
    }

    /// M17, RET and the end of the text: back to the caller, over some levels.
    pub(super) fn return_from(&mut self, levels: usize) -> Result<Next, Fault> {
        for _ in 0..levels {
            if self.stack.len() <= 1 {
                self.core.emit(Event::End);
                return Ok(Next::Finished);
            }
            let Some(top) = self.stack.last_mut() else { return Ok(Next::Finished) };
            let (left, at, line) = top.rounds;
            if left > 0 {
                top.rounds.0 -= 1;
                top.sections.clear();
                (top.at, top.line) = (at, line);
                self.core.count(at)?;
                return Ok(Next::Jumped);
            }
            let Some(done) = self.stack.pop() else { return Ok(Next::Finished) };
            let mut results = Vec::new();
            for (name, slot) in &done.references {
                if let Some(variable) = done.variables.get(name) {
                    results.push((slot.clone(), variable.values[0].clone()));
                }
            }
            self.forget(&done.variables);
            let here = self.core.start;
            for (slot, value) in results {
                self.write(&slot, value, here)?;
            }
            if let Some(saved) = done.saved {
                self.restore(*saved);
            }
        }
        Ok(Next::Jumped)
    }
}
