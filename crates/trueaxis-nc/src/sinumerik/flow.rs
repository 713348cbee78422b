//! Jumps, branches, loops and repetitions.

use std::rc::Rc;

use super::calls::Repetition;
use super::reader::Reader;
use super::structure::{Keyword, Mark, Structure};
use super::values::Value;
use super::{Next, Run, fault};
use crate::execution::mistakes;
use crate::text::program::Fault;

/// Where the search for a label goes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Direction {
    Forward,
    Backward,
    Both,
    /// As both; without the label the program goes on.
    Quiet,
}

/// Statements that a flat program does without; calls say so themselves by their jump.
const STEERING: [&str; 23] = [
    "IF", "ELSE", "ENDIF", "LOOP", "ENDLABEL", "FOR", "WHILE", "ENDFOR", "ENDWHILE", "ENDLOOP",
    "UNTIL", "REPEAT", "REPEATB", "CASE", "GOTO", "GOTOF", "GOTOB", "GOTOC", "GOTOS", "DEF",
    "PROC", "EXTERN", "RET",
];

impl Run<'_> {
    /// Executes a block after its mark for skipping.
    pub(super) fn statement(&mut self, reader: &mut Reader<'_>) -> Result<Next, Fault> {
        let numbered = reader.letter() == Some(b'N') || reader.symbol() == Some(b':');
        if numbered && reader.number_ahead(1).is_some() {
            reader.at += 2;
        }
        let labels = reader.here();
        while reader.word().is_some() && reader.symbol_ahead(1) == Some(b':') {
            reader.at += 2;
        }
        let at = reader.here();
        if at > labels {
            self.core.report_computed(labels..at, None);
        }
        if let Some(word) = reader.word()
            && !self.has_variable(&word)
            && let Some(next) = self.control(&word, reader, at)?
        {
            if STEERING.contains(&word.as_str()) {
                self.core.report_computed(self.core.start..self.end, None);
            }
            return Ok(next);
        }
        if reader.is_empty() {
            return Ok(Next::Following);
        }
        self.words.clear();
        if let Some(next) = self.gather(reader)? {
            return Ok(next);
        }
        self.perform()
    }

    /// A control statement; `None` if the word is none.
    fn control(
        &mut self,
        word: &str,
        reader: &mut Reader<'_>,
        at: usize,
    ) -> Result<Option<Next>, Fault> {
        let next = match word {
            "IF" => self.branch(reader, at)?,
            "ELSE" => {
                let mark = self.mark(at)?;
                self.jump_behind(mark.partner, at)?
            }
            "ENDIF" | "LOOP" | "ENDLABEL" => {
                self.mark(at)?;
                Next::Following
            }
            "FOR" => self.count_loop(reader, at)?,
            "WHILE" => {
                reader.advance();
                let holds = self.number(reader)? != 0.0;
                self.nothing_more(reader)?;
                let end = self.mark(at)?.partner;
                if holds { Next::Following } else { self.jump_behind(end, at)? }
            }
            "ENDFOR" | "ENDWHILE" | "ENDLOOP" => self.loop_end(word, at)?,
            "UNTIL" => {
                reader.advance();
                let done = self.number(reader)? != 0.0;
                let begin = self.mark(at)?.partner;
                if done {
                    Next::Following
                } else {
                    self.core.count(at)?;
                    self.jump_behind(begin, at)?
                }
            }
            "REPEAT" if reader.ahead(1).is_none() => {
                self.mark(at)?;
                Next::Following
            }
            "REPEAT" | "REPEATB" => self.repeat_part(word == "REPEATB", reader, at)?,
            "CASE" => self.case(reader, at)?,
            "GOTO" | "GOTOF" | "GOTOB" | "GOTOC" | "GOTOS" => self.go_to(reader)?,
            "DEF" => {
                reader.advance();
                self.define(reader)?;
                Next::Following
            }
            "PROC" | "EXTERN" => Next::Following,
            _ => return self.call_statement(word, reader, at),
        };
        Ok(Some(next))
    }

    fn structure(&mut self) -> Rc<Structure> {
        let number = self.core.origin.program as usize;
        if let Some(Some(found)) = self.structures.get(number) {
            return Rc::clone(found);
        }
        let found = Rc::new(Structure::of(&self.core.programs[number]));
        if self.structures.len() <= number {
            self.structures.resize(number + 1, None);
        }
        self.structures[number] = Some(Rc::clone(&found));
        found
    }

    pub(super) fn structure_of(&mut self, program: usize) -> Rc<Structure> {
        let before = std::mem::replace(&mut self.core.origin.program, program as u32);
        let found = self.structure();
        self.core.origin.program = before;
        found
    }

    /// The structure that stands in this block.
    fn mark(&mut self, at: usize) -> Result<Mark, Fault> {
        let structure = self.structure();
        let index = structure.by_start.get(&self.core.start);
        let mark = index.map(|i| structure.marks[*i].clone());
        match mark {
            Some(mark) if mark.partner.is_some() || mark.keyword == Keyword::EndLabel => Ok(mark),
            Some(mark) => {
                let begins = matches!(
                    mark.keyword,
                    Keyword::If | Keyword::For | Keyword::While | Keyword::Loop | Keyword::Repeat
                );
                let (code, message) = match begins {
                    true => ("missing-end", "the end of this structure is missing"),
                    false => ("unopened-control", "the beginning of this structure is missing"),
                };
                let hint = "IF ENDIF, FOR ENDFOR, WHILE ENDWHILE, LOOP ENDLOOP, REPEAT UNTIL";
                Err(fault(code, at, message, hint))
            }
            None => {
                let message = "a control structure must be alone in its block";
                Err(fault("unopened-control", at, message, "write it on a separate line"))
            }
        }
    }

    fn jump_behind(&mut self, mark: Option<usize>, at: usize) -> Result<Next, Fault> {
        let structure = self.structure();
        let Some(mark) = mark.and_then(|i| structure.marks.get(i)) else {
            return Err(fault(
                "missing-end",
                at,
                "the end of this structure is missing",
                "write its end, such as ENDIF or ENDFOR",
            ));
        };
        Ok(self.send(mark.next, mark.line + 1))
    }

    fn send(&mut self, at: usize, line: u32) -> Next {
        if let Some(top) = self.stack.last_mut() {
            (top.at, top.line) = (at, line);
            top.leave_sections(at);
        }
        Next::Jumped
    }

    pub(super) fn nothing_more(&self, reader: &Reader<'_>) -> Result<(), Fault> {
        if reader.is_empty() {
            return Ok(());
        }
        let message = "unexpected text after this statement";
        let symbol = reader.symbol();
        let code = match symbol {
            Some(b')' | b']') => "unbalanced-brackets",
            _ => "unexpected-sign",
        };
        Err(fault(code, reader.here(), message, "write it on a separate line"))
    }

    fn branch(&mut self, reader: &mut Reader<'_>, at: usize) -> Result<Next, Fault> {
        reader.advance();
        let holds = self.number(reader)? != 0.0;
        if reader.is_empty() {
            let mark = self.mark(at)?;
            if holds {
                return Ok(Next::Following);
            }
            return self.jump_behind(mark.other.or(mark.partner), at);
        }
        if !reader.word().is_some_and(|w| w.starts_with("GOTO")) {
            self.nothing_more(reader)?;
        }
        if holds { self.go_to(reader) } else { Ok(Next::Following) }
    }

    fn loop_end(&mut self, word: &str, at: usize) -> Result<Next, Fault> {
        let mark = self.mark(at)?;
        self.core.count(at)?;
        let structure = self.structure();
        let Some(begin) = mark.partner.and_then(|i| structure.marks.get(i)) else {
            return Ok(Next::Following);
        };
        if word == "ENDLOOP" {
            return Ok(self.send(begin.next, begin.line + 1));
        }
        if let Some(top) = self.stack.last_mut() {
            top.continuing = (word == "ENDFOR").then_some(begin.start);
        }
        Ok(self.send(begin.start, begin.line))
    }

    /// `FOR variable = first TO last`
    fn count_loop(&mut self, reader: &mut Reader<'_>, at: usize) -> Result<Next, Fault> {
        reader.advance();
        let mark = self.mark(at)?;
        let start = self.core.start;
        let top = self.stack.last_mut().and_then(|t| t.continuing.take());
        let place = reader.here();
        let slot = self.slot(reader)?;
        reader.require(b'=', "write FOR R1=0 TO 5")?;
        let first = self.number(reader)?;
        if !reader.accept_word("TO") {
            let message = "expected TO";
            return Err(fault("missing-sign", reader.here(), message, "write FOR R1=0 TO 5"));
        }
        let last = self.number(reader)?;
        self.nothing_more(reader)?;
        let value = match top {
            Some(continuing) if continuing == start => {
                self.read(&slot, place)?.number(place)? + 1.0
            }
            _ => first,
        };
        self.write(&slot, Value::Number(value), place)?;
        if value > last {
            return self.jump_behind(mark.partner, at);
        }
        Ok(Next::Following)
    }

    /// `CASE x OF 1 GOTOF A 2 GOTOF B DEFAULT GOTOF C`
    fn case(&mut self, reader: &mut Reader<'_>, at: usize) -> Result<Next, Fault> {
        reader.advance();
        let value = self.expression(reader)?;
        if !reader.accept_word("OF") {
            let hint = "write CASE R1 OF 1 GOTOF A DEFAULT GOTOF B";
            return Err(fault("missing-sign", reader.here(), "expected OF", hint));
        }
        while !reader.is_empty() {
            let matches = if reader.accept_word("DEFAULT") {
                true
            } else {
                let wanted = self.expression(reader)?;
                match (&value, &wanted) {
                    (Value::Text(a), Value::Text(b)) => a == b,
                    _ => value.number(at)? == wanted.number(at)?,
                }
            };
            if matches {
                return self.go_to(reader);
            }
            if !reader.word().is_some_and(|w| w.starts_with("GOTO")) {
                let message = "expected a jump such as GOTOF";
                let hint = "write CASE R1 OF 1 GOTOF A DEFAULT GOTOF B";
                return Err(fault("missing-sign", reader.here(), message, hint));
            }
            reader.advance();
            self.block_name(reader)?;
        }
        Ok(Next::Following)
    }

    /// The name of a block: a label, N10 or a text.
    fn block_name(&mut self, reader: &mut Reader<'_>) -> Result<String, Fault> {
        if (reader.letter() == Some(b'N') || reader.symbol() == Some(b':'))
            && let Some(number) = reader.number_ahead(1)
        {
            reader.at += 2;
            return Ok(format!("N{}", String::from_utf8_lossy(reader.text(number))));
        }
        if let Some(word) = reader.word()
            && !self.has_variable(&word)
        {
            reader.advance();
            return Ok(word);
        }
        if reader.is_empty() {
            let message = "expected the name of a block";
            return Err(fault("missing-value", reader.here(), message, "write GOTOF END1"));
        }
        Ok(self.text(reader)?.to_ascii_uppercase())
    }

    /// GOTOF, GOTOB, GOTO, GOTOC and GOTOS with what follows.
    fn go_to(&mut self, reader: &mut Reader<'_>) -> Result<Next, Fault> {
        let at = reader.here();
        let word = reader.word().unwrap_or_default();
        reader.advance();
        let direction = match word.as_str() {
            "GOTOF" => Direction::Forward,
            "GOTOB" => Direction::Backward,
            "GOTOC" => Direction::Quiet,
            "GOTOS" => {
                self.core.count(at)?;
                let begin = self.stack.last().map(|t| (t.span.start, t.first_line));
                let (start, line) = begin.unwrap_or((0, 1));
                return Ok(self.send(start, line));
            }
            _ => Direction::Both,
        };
        let target = self.block_name(reader)?;
        let Some((start, line)) = self.find(&target, direction) else {
            if direction == Direction::Quiet {
                return Ok(Next::Following);
            }
            return Err(mistakes::missing_label(target, at));
        };
        if start <= self.core.start {
            self.core.count(at)?;
        }
        Ok(self.send(start, line))
    }

    /// A block of the running program by its name.
    pub(super) fn find(&mut self, target: &str, direction: Direction) -> Option<(usize, u32)> {
        let structure = self.structure();
        let here = self.core.start;
        let span = self.stack.last().map(|t| t.span.clone())?;
        let number = target.strip_prefix('N').and_then(|n| n.parse::<u64>().ok());
        let mut places: Vec<(usize, u32)> = match number {
            Some(number) => {
                let numbers = &structure.numbers;
                let from = numbers.partition_point(|(n, ..)| *n < number);
                let same = numbers[from..].iter().take_while(|(n, ..)| *n == number);
                same.map(|(_, start, line)| (*start, *line)).collect()
            }
            None => structure.labels.get(target).cloned().unwrap_or_default(),
        };
        places.retain(|(start, _)| span.contains(start));
        let forward = places.iter().find(|(start, _)| *start > here).copied();
        let backward = places.iter().rev().find(|(start, _)| *start <= here).copied();
        match direction {
            Direction::Forward => forward,
            Direction::Backward => backward,
            _ => forward.or(backward),
        }
    }

    /// `REPEAT A B P=3`, `REPEATB A P=3`
    fn repeat_part(
        &mut self,
        one_block: bool,
        reader: &mut Reader<'_>,
        at: usize,
    ) -> Result<Next, Fault> {
        reader.advance();
        let first = self.block_name(reader)?;
        let mut last = None;
        if reader.letter() != Some(b'P') && !reader.is_empty() {
            last = Some(self.block_name(reader)?);
        }
        let mut rounds = 1.0;
        if reader.letter() == Some(b'P') {
            reader.advance();
            reader.accept(b'=');
            rounds = self.number(reader)?;
        }
        self.nothing_more(reader)?;
        let missing = |name: &str| mistakes::missing_label(name, at);
        let begin = self.find(&first, Direction::Both).ok_or_else(|| missing(&first))?;
        let end = match &last {
            _ if one_block => self.block_end(begin.0),
            Some(name) => {
                let place = self.find(name, Direction::Both).ok_or_else(|| missing(name))?;
                self.block_end(place.0)
            }
            None => self.part_end(begin.0),
        };
        if rounds < 1.0 || end <= begin.0 {
            return Ok(Next::Following);
        }
        self.core.count(at)?;
        let repetitions = self.stack.last().map_or(0, |top| top.sections.len());
        self.core.check_depth(repetitions + 1, at)?;
        let back = (self.end, self.core.origin.line + 1);
        let left = rounds.min(1e9) as u64 - 1;
        let Some(top) = self.stack.last_mut() else { return Ok(Next::Following) };
        top.sections.push(Repetition { span: begin.0..end, line: begin.1, left, back });
        (top.at, top.line) = begin;
        Ok(Next::Jumped)
    }

    /// The offset after the block that begins at a byte.
    pub(super) fn block_end(&self, start: usize) -> usize {
        let source = self.core.programs[self.core.origin.program as usize].source();
        let found = source[start..].iter().position(|b| *b == b'\n');
        found.map_or(source.len(), |i| start + i + 1)
    }

    /// Where the part ends that begins at a label and has no second one: at ENDLABEL, at the REPEAT
    /// after it, or with the program.
    fn part_end(&mut self, begin: usize) -> usize {
        let structure = self.structure();
        let here = self.core.start;
        let from = structure.marks.partition_point(|m| m.start < begin);
        let label = structure.marks[from..].iter().find(|m| m.keyword == Keyword::EndLabel);
        match label {
            Some(mark) if begin > here || mark.start < here => mark.start,
            _ if begin < here => here,
            _ => self.stack.last().map_or(0, |t| t.span.end),
        }
    }

    /// The text, or a repeated part of it, is at its end.
    pub(super) fn end_of_section(&mut self) -> Result<Next, Fault> {
        let Some(top) = self.stack.last_mut() else { return Ok(Next::Finished) };
        let Some(part) = top.sections.last_mut() else { return self.return_from(1) };
        if part.left > 0 {
            part.left -= 1;
            let (at, line) = (part.span.start, part.line);
            (top.at, top.line) = (at, line);
            self.core.count(at)?;
        } else {
            let back = part.back;
            top.sections.pop();
            (top.at, top.line) = back;
        }
        Ok(Next::Jumped)
    }
}
