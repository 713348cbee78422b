//! Control statements: subs, calls, loops, branches, jumps.

use std::rc::Rc;

use std::collections::HashMap;

use super::parameters::Locals;
use super::{Activation, Next, Passage, Run, fault};
use crate::execution::mistakes;
use crate::moves::Event;
use crate::text::program::{Block, Fault, Item, Keyword, Label, Mark, NodeId, Program};

impl Activation {
    pub(super) fn new(program: usize, at: usize, line: u32) -> Self {
        Self {
            program,
            at,
            line,
            sub: None,
            locals: Locals::default(),
            rounds: HashMap::new(),
            seeking: false,
            repeats: 0,
            named: false,
            shares_locals: false,
            saved: super::linuxcnc::modal_state::Saved::default(),
            entry: (at, line),
        }
    }
}

/// A control statement that is being executed.
struct Statement<'b> {
    passage: Passage<'b>,
    keyword: Keyword,
    label: Label,
    arguments: &'b [NodeId],
    offset: usize,
}

impl Run<'_> {
    pub(super) fn frame(&mut self) -> &mut Activation {
        // why: the stack is never empty while a block is executed.
        self.stack.last_mut().expect("every block belongs to a frame")
    }

    /// The text has no more blocks.
    pub(super) fn end_of_text(&mut self) -> Result<Next, Fault> {
        let at = self.core.program().source().len();
        let Some(label) = self.frame().sub.take() else {
            if self.opened {
                let message = "the closing % is missing";
                self.core.warn(
                    "truncated-program",
                    0,
                    at,
                    message,
                    "check whether the file is complete",
                );
            }
            self.core.emit(Event::End);
            return Ok(Next::Finished);
        };
        let message = format!("the end of the subprogram {} is missing", show(&label));
        Err(fault("missing-end", at, message, "end it with endsub or M99"))
    }

    /// Executes a control statement; `None` if the rest of the block is to be executed.
    pub(super) fn control(
        &mut self,
        passage: Passage<'_>,
        item: &Item,
    ) -> Result<Option<Next>, Fault> {
        let Item::Control { keyword, label, arguments, offset } = item else { return Ok(None) };
        let label = match label {
            Some(Label::Computed(node)) => {
                let value = self.value(passage, *node)?;
                if !(0.0..1e15).contains(&value) {
                    let message = format!("expected a whole number as label, found {value}");
                    return Err(fault("bad-label", *offset, message, "write a whole number"));
                }
                Label::Number(value.round() as u64)
            }
            Some(label) => label.clone(),
            None => Label::Number(0),
        };
        let statement = Statement { passage, keyword: *keyword, label, arguments, offset: *offset };
        match keyword {
            Keyword::ProgramNumber => self.program_begins(&statement),
            Keyword::IfThen => {
                let holds = self.condition(passage, arguments)?;
                Ok(if holds { None } else { Some(Next::Following) })
            }
            Keyword::Goto => self.go_to(&statement).map(Some),
            Keyword::IfGoto => {
                let holds = self.condition(passage, arguments)?;
                let next = if holds { self.go_to(&statement)? } else { Next::Following };
                Ok(Some(next))
            }
            Keyword::Sub | Keyword::EndSub | Keyword::Call | Keyword::Return => {
                self.sub_statement(&statement).map(Some)
            }
            Keyword::If | Keyword::ElseIf | Keyword::Else | Keyword::EndIf => {
                self.branch(&statement).map(Some)
            }
            _ => self.repetition(&statement).map(Some),
        }
    }

    /// `O1234` within the text: the program that was executed has come to its end.
    fn program_begins(&mut self, statement: &Statement<'_>) -> Result<Option<Next>, Fault> {
        let at = statement.offset;
        if let Label::Number(number) = statement.label {
            self.modes.last[3] = number as f64;
        }
        if !std::mem::replace(&mut self.frame().named, true) {
            return Ok(None);
        }
        if let Some(label) = self.frame().sub.take() {
            let message = format!("the end of the subprogram {} is missing", show(&label));
            return Err(fault("missing-end", at, message, "end it with M99"));
        }
        let message = "the next program begins before the end of this one".to_owned();
        self.core.warn("missing-end", 0, at, message, "end the main program with M30");
        self.core.emit(Event::End);
        Ok(Some(Next::Finished))
    }

    fn condition(&self, passage: Passage<'_>, arguments: &[NodeId]) -> Result<bool, Fault> {
        match arguments.first() {
            Some(node) => Ok(self.value(passage, *node)?.abs() > 1e-20),
            None => Ok(true),
        }
    }

    fn holds(&self, statement: &Statement<'_>) -> Result<bool, Fault> {
        self.condition(statement.passage, statement.arguments)
    }

    fn go_to(&mut self, statement: &Statement<'_>) -> Result<Next, Fault> {
        let Label::Number(wanted) = statement.label else { return Ok(Next::Following) };
        let Some((start, line)) =
            statement.passage.program.structure().block_number(wanted, statement.offset)
        else {
            return Err(mistakes::missing_label(format_args!("N{wanted}"), statement.offset));
        };
        self.jump(start, line, statement.offset)
    }

    /// Goes to a block; going back is counted.
    fn jump(&mut self, start: usize, line: u32, from: usize) -> Result<Next, Fault> {
        if start <= from {
            self.core.count(from)?;
        }
        let frame = self.frame();
        (frame.at, frame.line) = (start, line);
        Ok(Next::Jumped)
    }

    /// The next matching mark after a byte.
    fn ahead(
        &self,
        statement: &Statement<'_>,
        wanted: &[Keyword],
        code: &'static str,
    ) -> Result<Mark, Fault> {
        let marks = &statement.passage.program.structure().marks;
        let from = marks.partition_point(|m| m.start <= statement.offset);
        let fits = |m: &&Mark| m.label == statement.label && wanted.contains(&m.keyword);
        marks[from..].iter().find(fits).cloned().ok_or_else(|| {
            let message = format!("the end of {} is missing", show(&statement.label));
            fault(code, statement.offset, message, "end each control structure with the same label")
        })
    }

    fn behind(
        &self,
        program: &Program,
        from: usize,
        label: &Label,
        wanted: &[Keyword],
    ) -> Option<Mark> {
        let marks = &program.structure().marks;
        let until = marks.partition_point(|m| m.next <= from);
        let fits = |m: &&Mark| &m.label == label && wanted.contains(&m.keyword);
        marks[..until].iter().rev().find(fits).cloned()
    }

    fn branch(&mut self, statement: &Statement<'_>) -> Result<Next, Fault> {
        let seeking = std::mem::take(&mut self.frame().seeking);
        let begins = statement.keyword == Keyword::If;
        match statement.keyword {
            Keyword::EndIf => return Ok(Next::Following),
            Keyword::Else if seeking => return Ok(Next::Following),
            Keyword::If | Keyword::ElseIf if seeking || begins => {
                if self.holds(statement)? {
                    return self.closed(statement, &[Keyword::EndIf], "missing-endif");
                }
                let branches = [Keyword::ElseIf, Keyword::Else, Keyword::EndIf];
                let mark = self.ahead(statement, &branches, "missing-endif")?;
                self.frame().seeking = mark.keyword != Keyword::EndIf;
                return self.jump(mark.start, mark.line, statement.offset);
            }
            _ => {}
        }
        // The branch before this one was executed.
        let mark = self.ahead(statement, &[Keyword::EndIf], "missing-endif")?;
        self.jump(mark.next, mark.line + 1, statement.offset)
    }

    fn repetition(&mut self, statement: &Statement<'_>) -> Result<Next, Fault> {
        let at = statement.offset;
        let label = &statement.label;
        match statement.keyword {
            Keyword::While => self.while_statement(statement),
            Keyword::EndWhile => {
                match self.behind(
                    statement.passage.program,
                    at,
                    label,
                    &[Keyword::While, Keyword::Do],
                ) {
                    Some(open) => self.jump(open.start, open.line, at),
                    None => Err(unopened(statement)),
                }
            }
            Keyword::Repeat => {
                let count = statement.arguments.first().map(|n| self.value(statement.passage, *n));
                let count = count.transpose()?.unwrap_or(0.0).round().clamp(0.0, 1e15) as u64;
                if count == 0 {
                    return self.leave(statement);
                }
                self.frame().rounds.insert(statement.passage.block.span.start, count);
                self.closed(statement, &[Keyword::EndRepeat], "missing-endwhile")
            }
            Keyword::EndRepeat => {
                let Some(open) =
                    self.behind(statement.passage.program, at, label, &[Keyword::Repeat])
                else {
                    return Err(unopened(statement));
                };
                let rounds = self.frame().rounds.entry(open.start).or_insert(1);
                *rounds = rounds.saturating_sub(1);
                if *rounds == 0 {
                    Ok(Next::Following)
                } else {
                    self.jump(open.next, open.line + 1, at)
                }
            }
            Keyword::Break => self.leave(statement),
            Keyword::Continue => {
                let ends = [Keyword::EndWhile, Keyword::EndRepeat, Keyword::While];
                let mark = self.ahead(statement, &ends, "missing-endwhile")?;
                self.jump(mark.start, mark.line, at)
            }
            Keyword::Do => {
                self.closed(statement, &[Keyword::While, Keyword::EndWhile], "missing-endwhile")
            }
            _ => Ok(Next::Following),
        }
    }

    /// Goes into a structure, whose end must be there: without it the program is not complete.
    fn closed(
        &self,
        statement: &Statement<'_>,
        ends: &[Keyword],
        code: &'static str,
    ) -> Result<Next, Fault> {
        self.ahead(statement, ends, code).map(|_| Next::Following)
    }

    fn while_statement(&mut self, statement: &Statement<'_>) -> Result<Next, Fault> {
        let (start, at) = (statement.passage.block.span.start, statement.offset);
        let holds = self.holds(statement)?;
        let loops = [Keyword::While, Keyword::Do, Keyword::Repeat];
        let open = self.behind(statement.passage.program, start, &statement.label, &loops);
        match open
            .filter(|o| o.keyword == Keyword::Do && statement.passage.program.dialect().o_words)
        {
            // It ends a `do`.
            Some(open) if holds => self.jump(open.next, open.line + 1, at),
            Some(_) => Ok(Next::Following),
            None if holds => self.closed(statement, &[Keyword::EndWhile], "missing-endwhile"),
            None => self.leave(statement),
        }
    }

    /// Continues after the end of the loop.
    fn leave(&mut self, statement: &Statement<'_>) -> Result<Next, Fault> {
        let closing_while = statement.keyword == Keyword::Break;
        let mut ends = vec![Keyword::EndWhile, Keyword::EndRepeat];
        if closing_while {
            ends.push(Keyword::While);
        }
        let mark = self.ahead(statement, &ends, "missing-endwhile")?;
        self.jump(mark.next, mark.line + 1, statement.offset)
    }

    fn sub_statement(&mut self, statement: &Statement<'_>) -> Result<Next, Fault> {
        let at = statement.offset;
        match statement.keyword {
            Keyword::Call => {
                let mut locals = Locals::default();
                if statement.arguments.len() > 30 {
                    let message = "the call has more than 30 arguments";
                    return Err(fault("too-many-arguments", at, message, "use global parameters"));
                }
                for number in &mut locals.numbers[1..=30] {
                    *number = Some(0.0);
                }
                for (index, node) in statement.arguments.iter().enumerate() {
                    locals.numbers[index + 1] = Some(self.value(statement.passage, *node)?);
                }
                self.enter(statement.passage, &statement.label, locals, 1, at)
            }
            Keyword::Sub if self.frame().sub.is_some() => {
                let message = "a subprogram is defined within a subprogram";
                Err(fault("nested-sub", at, message, "define the subprograms one after the other"))
            }
            Keyword::Sub => {
                let mark = self.ahead(statement, &[Keyword::EndSub], "missing-endsub")?;
                let nested =
                    statement.passage.program.structure().marks.iter().find(|m| {
                        m.keyword == Keyword::Sub && m.start > at && m.start < mark.start
                    });
                if let Some(nested) = nested {
                    let message = "a subprogram is defined within a subprogram";
                    let hint = "define the subprograms one after the other";
                    return Err(fault("nested-sub", nested.start, message, hint));
                }
                self.jump(mark.next, mark.line + 1, at)
            }
            _ => {
                let value = match statement.arguments.first() {
                    Some(node) => Some(self.value(statement.passage, *node)?),
                    None => None,
                };
                if self.frame().sub.is_none() {
                    return Err(unopened(statement));
                }
                self.returned = value;
                if let Some(ended) = self.stack.pop() {
                    self.restore_at_return(&ended.saved, at)?;
                }
                Ok(Next::Jumped)
            }
        }
    }

    /// Enters a subprogram of this text or of the library; the caller continues after `block`.
    pub(super) fn enter(
        &mut self,
        passage: Passage<'_>,
        label: &Label,
        locals: Locals,
        repeats: u64,
        at: usize,
    ) -> Result<Next, Fault> {
        self.core.count(at)?;
        self.core.check_depth(self.stack.len(), at)?;
        let (number, start, line) = self.find_sub(passage.program, label, at)?;
        self.follow(passage.block);
        self.call(number, (start, line), label.clone(), locals, repeats);
        Ok(Next::Jumped)
    }

    /// A program of the user's dictionary, to M99 or to the end of its O word.
    pub(super) fn call_own(&mut self, name: &str, block: &Block, at: usize) -> Result<Next, Fault> {
        self.core.count(at)?;
        self.core.check_depth(self.stack.len(), at)?;
        let names = ["", ".ngc", ".nc"].map(|ending| format!("{name}{ending}"));
        let number = self.core.load(name, names, at)?;
        let plain = name.rsplit_once('.').map_or(name, |(plain, _)| plain);
        let label = Label::Name(plain.to_ascii_lowercase());
        let program = Rc::clone(&self.core.programs[number]);
        let structure = program.structure();
        let mark = structure.subs.get(&label).map(|i| &structure.marks[*i]);
        let begin = mark.map_or((0, 1), |mark| (mark.next, mark.line + 1));
        self.follow(block);
        self.call(number, begin, label, Locals::default(), 1);
        Ok(Next::Jumped)
    }

    /// A subprogram is on top.
    pub(super) fn call(
        &mut self,
        program: usize,
        (start, line): (usize, u32),
        label: Label,
        locals: Locals,
        repeats: u64,
    ) {
        let mut frame = Activation::new(program, start, line);
        (frame.sub, frame.locals, frame.repeats) = (Some(label), locals, repeats);
        frame.named = start > 0;
        self.stack.push(frame);
        self.returned = None;
    }

    /// The name by which the library knows a subprogram.
    fn name_of(&self, label: &Label) -> String {
        match label {
            Label::Number(number) if self.is_fanuc() => format!("O{number:04}"),
            named => show(named),
        }
    }

    /// The names that the file of a subprogram may have: a number of four, five or eight digits, or alone.
    fn file_names(&self, label: &Label, name: &str) -> Vec<String> {
        match label {
            Label::Number(n) if self.is_fanuc() => {
                vec![
                    name.to_owned(),
                    format!("O{n:05}"),
                    format!("O{n:08}"),
                    format!("O{n}"),
                    n.to_string(),
                ]
            }
            _ => vec![name.to_owned()],
        }
    }

    pub(super) fn find_sub(
        &mut self,
        program: &Program,
        label: &Label,
        at: usize,
    ) -> Result<(usize, usize, u32), Fault> {
        let place = |program: &Program| {
            let structure = program.structure();
            let mark = &structure.marks[*structure.subs.get(label)?];
            Some((mark.next, mark.line + 1))
        };
        let here = self.core.origin.program as usize;
        if let Some((start, line)) = place(program) {
            return Ok((here, start, line));
        }
        let name = self.name_of(label);
        let number = self.core.load(&name, self.file_names(label, &name), at)?;
        match place(&self.core.programs[number]) {
            Some((start, line)) => Ok((number, start, line)),
            None if program.dialect().macro_words => Ok((number, 0, 1)),
            None => {
                let message = format!(
                    "the file {} does not define {name}",
                    self.core.programs[number].file()
                );
                Err(fault("missing-subprogram", at, message, "the file needs o<name> sub … endsub"))
            }
        }
    }
}

fn unopened(statement: &Statement<'_>) -> Fault {
    let keyword = match statement.passage.program.dialect().macro_words {
        true => "END".to_owned(),
        false => format!("{:?}", statement.keyword).to_lowercase(),
    };
    let message = format!("{keyword} of {} without its beginning", show(&statement.label));
    fault("unopened-control", statement.offset, message, "check the labels")
}

pub(super) fn show(label: &Label) -> String {
    match label {
        Label::Number(number) => number.to_string(),
        Label::Name(name) => name.clone(),
        Label::Computed(_) => String::new(),
    }
}
