//! M98, G65, G66: subprograms and macros of FANUC.

use std::rc::Rc;

use crate::execution::mistakes;
use crate::rs274::code::Action;
use crate::rs274::parameters::Locals;
use crate::rs274::{Next, Passage, Run, fault};
use crate::text::program::{Block, Fault, Item, Label, Node};

/// The local parameter of each letter, A to Z.
const NUMBERS: [usize; 26] =
    [1, 2, 3, 7, 8, 9, 10, 11, 4, 5, 6, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26];

/// More arguments than any macro takes.
const MOST_ARGUMENTS: usize = 100;

/// A macro that is called again and again: G66, G66.1.
#[derive(Debug, Clone)]
pub(in crate::rs274) struct ModalMacro {
    each_block: bool,
    /// Depth of calls in which it was set; there alone it is called.
    depth: usize,
    label: Label,
    repeats: f64,
    locals: Locals,
}

/// What the letters of a block are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::rs274) enum Gathering {
    Words,
    /// All letters but G, P, L, N and O are arguments.
    Call,
    /// All letters are.
    EachBlock,
}

impl Gathering {
    pub fn is_argument(self, letter: u8) -> bool {
        match self {
            Self::Words => false,
            Self::Call => !b"GPLNO".contains(&letter),
            Self::EachBlock => true,
        }
    }
}

/// The local parameters of a call.
///
/// # Source
/// FANUC Series 30i operator's manual, "Custom macro", argument specification I (a letter each) and
/// II (A B C once, then up to ten times I J K, in order): the first I J K are the same in both.
fn locals_of(arguments: &[(u8, f64)], at: usize) -> Result<Locals, Fault> {
    let mut locals = Locals::default();
    let (mut set, mut last) = (0, None);
    for (letter, value) in arguments {
        let mut number = NUMBERS[usize::from(letter - b'A')];
        if let Some(place) = b"IJK".iter().position(|l| l == letter) {
            if last.is_some_and(|l| place <= l) {
                set += 1;
            }
            last = Some(place);
            number = 4 + 3 * set + place;
        }
        if number > 33 {
            let message = "more than ten sets of I J K";
            return Err(fault("too-many-arguments", at, message, "use common variables (#100)"));
        }
        locals.numbers[number] = Some(*value);
    }
    Ok(locals)
}

impl Run<'_> {
    /// Whether a block calls a macro with its letters.
    pub(in crate::rs274) fn gathering(&self, passage: Passage<'_>, items: &[Item]) -> Gathering {
        if !passage.program.dialect().macro_words {
            return Gathering::Words;
        }
        let has = |codes: &[f64]| {
            items.iter().any(|item| match item {
                Item::Word { letter: b'G', value, .. } => {
                    matches!(passage.block.nodes.get(*value as usize), Some(Node::Number(n)) if codes.contains(n))
                }
                _ => false,
            })
        };
        let words = items.iter().filter(|i| matches!(i, Item::Word { .. })).count();
        if words > MOST_ARGUMENTS {
            Gathering::Words
        } else if has(&[65.0, 66.0, 66.1]) {
            Gathering::Call
        } else if words > 0 && self.modal_here(true).is_some() && !has(&[67.0]) {
            Gathering::EachBlock
        } else {
            Gathering::Words
        }
    }

    /// What a number without a decimal point counts as an argument of a macro.
    ///
    /// # Source
    /// Haas Automation, "Mill Operator's Manual", "Integer Argument Passing (no decimal point)": 0.0001 (metric 0.001),
    /// 1 for the other letters.
    pub(in crate::rs274) fn argument_unit(&self, letter: u8, place: usize) -> f64 {
        let scaled = self.is_haas() && b"ABCIJKQRUVWXYZ".contains(&letter);
        match self.core.modes.inches {
            _ if !scaled || self.written(place) != (true, false) => 1.0,
            true => 0.0001,
            false => 0.001,
        }
    }

    /// The modal macro of this depth of calls.
    fn modal_here(&self, each_block: bool) -> Option<&ModalMacro> {
        let modal = self.modes.macros.last()?;
        (modal.depth == self.stack.len() && modal.each_block == each_block).then_some(modal)
    }

    /// Calls the modal macro that is due after a move, or instead of a block.
    pub(in crate::rs274) fn call_modal(
        &mut self,
        block: &Block,
        each_block: bool,
    ) -> Result<Option<Next>, Fault> {
        let Some(modal) = self.modal_here(each_block) else { return Ok(None) };
        let (label, repeats) = (modal.label.clone(), modal.repeats);
        let mut locals = modal.locals.clone();
        let at = block.span.start;
        if each_block {
            let arguments = std::mem::take(&mut self.words.arguments);
            if arguments.is_empty() {
                return Ok(None);
            }
            locals = locals_of(&arguments, at)?;
        }
        self.call_label(&label, locals, block, repeats, at).map(Some)
    }

    /// G66 and G66.1.
    fn modal_call(&mut self, block: &Block, each_block: bool) -> Result<Next, Fault> {
        let at = self.words.place(b'P').max(block.span.start);
        let (label, _) = self.called_label(at)?;
        let repeats = self.words.take(b'L').unwrap_or(1.0);
        let locals = locals_of(&std::mem::take(&mut self.words.arguments), at)?;
        let depth = self.stack.len();
        if self.modes.macros.len() > self.core.settings.deepest_call {
            let message = "modal macros are nested too deeply";
            return Err(fault("calls-too-deep", at, message, "end them by G67"));
        }
        self.modes.macros.push(ModalMacro { each_block, depth, label, repeats, locals });
        Ok(Next::Following)
    }

    /// M98 P…: a numbered subprogram, L times; P of FANUC with more than 4 digits carries the count in
    /// front. Its `#1` to `#30` are those of its caller, on LinuxCNC too (user manual 2.9, "O Codes").
    pub(in crate::rs274) fn subprogram_call(&mut self, block: &Block) -> Result<Next, Fault> {
        let at = self.words.place(b'P').max(block.span.start);
        let (label, digits) = self.called_label(at)?;
        let repeats = self.words.take(b'L').unwrap_or((digits / 10_000).max(1) as f64);
        let locals = self.frame().locals.clone();
        let next = self.call_label(&label, locals, block, repeats, at)?;
        if next == Next::Jumped {
            self.frame().shares_locals = true;
            self.begin_at_number(at)?;
        }
        Ok(next)
    }

    /// Q of M98 on FANUC: the subprogram begins at this block number, each time.
    ///
    /// # Source
    /// FANUC Series 30i operator's manual, M98 P Q; "Subprogram Call: M98, M99" (okumacnc.blogspot.com).
    fn begin_at_number(&mut self, at: usize) -> Result<(), Fault> {
        let fanuc = self.is_fanuc() && !self.is_haas();
        let Some(number) = self.words.look(b'Q').filter(|_| fanuc) else { return Ok(()) };
        self.words.take(b'Q');
        let (program, from) = (self.frame().program, self.frame().at);
        let called = Rc::clone(&self.core.programs[program]);
        let found = called.structure().block_number(number as u64, from.saturating_sub(1));
        let Some((start, line)) = found.filter(|_| number >= 0.0 && number.fract() == 0.0) else {
            return Err(mistakes::missing_label(format_args!("N{number}"), at));
        };
        let frame = self.frame();
        (frame.at, frame.line, frame.entry, frame.named) = (start, line, (start, line), start > 0);
        Ok(())
    }

    /// M97 P…: from the block number P of this program to M99, L times.
    ///
    /// # Source
    /// Haas Automation, "Mill Operator's Manual", M97 Local Sub-Program Call.
    pub(in crate::rs274) fn local_call(&mut self, block: &Block) -> Result<Next, Fault> {
        let at = self.words.place(b'P').max(block.span.start);
        let number = self.words.take(b'P').filter(|p| *p >= 1.0 && p.fract() == 0.0);
        let repeats = self.words.take(b'L').unwrap_or(1.0);
        let program = self.current();
        let found =
            number.and_then(|n| program.structure().block_number(n as u64, block.span.start));
        let (Some(number), Some(entry)) = (number, found) else {
            return Err(mistakes::missing_label(format_args!("N{}", number.unwrap_or(0.0)), at));
        };
        if repeats < 1.0 {
            return Ok(Next::Following);
        }
        self.core.count(at)?;
        self.core.check_depth(self.stack.len(), at)?;
        let locals = self.frame().locals.clone();
        let program = self.frame().program;
        self.follow(block);
        let label = Label::Number(number as u64);
        self.call(program, entry, label, locals, repeats as u64);
        self.frame().shares_locals = true;
        Ok(Next::Jumped)
    }

    /// G65 P… with letters as arguments, G66, G66.1.
    pub(in crate::rs274) fn macro_call(
        &mut self,
        actions: &[(Action, usize)],
        block: &Block,
    ) -> Result<Next, Fault> {
        for (action, at) in actions {
            match action {
                Action::ModalMacro { each_block } => return self.modal_call(block, *each_block),
                Action::MacroCall => {}
                other => {
                    self.act(*other, *at)?;
                }
            }
        }
        let at = self.words.place(b'P').max(block.span.start);
        let (label, _) = self.called_label(at)?;
        let repeats = self.words.take(b'L').unwrap_or(1.0);
        let locals = locals_of(&std::mem::take(&mut self.words.arguments), at)?;
        self.call_label(&label, locals, block, repeats, at)
    }

    /// Which program is called: by name or by P; and all digits of P.
    fn called_label(&mut self, at: usize) -> Result<(Label, u64), Fault> {
        if let Some(label) = self.called.take() {
            return Ok((label, 0));
        }
        match self.words.take(b'P') {
            Some(p) if (1.0..1e9).contains(&p) && p.fract() == 0.0 => {
                let digits = p as u64;
                if !self.is_fanuc() {
                    return Ok((Label::Number(digits), 0));
                }
                let number = if digits > 9999 { digits % 10_000 } else { digits };
                Ok((Label::Number(number), digits))
            }
            _ => {
                let message = "the number of the subprogram is missing";
                Err(fault("missing-subprogram", at, message, "write M98 P1000"))
            }
        }
    }

    fn call_label(
        &mut self,
        label: &Label,
        locals: Locals,
        block: &Block,
        repeats: f64,
        at: usize,
    ) -> Result<Next, Fault> {
        let program = self.current();
        if repeats < 1.0 {
            return Ok(Next::Following);
        }
        let passage = Passage { program: &program, block };
        self.enter(passage, label, locals, repeats as u64, at)
    }

    /// M99: back to the caller, or once more; in the main program back to its beginning, which is
    /// taken as its end.
    pub(in crate::rs274) fn subprogram_return(&mut self, block: &Block) -> Result<Next, Fault> {
        let back = self.words.take(b'P');
        let at = block.span.start;
        let frame = self.frame();
        if frame.sub.is_none() {
            if let Some(number) = back {
                return self.jump_to_number(number, at);
            }
            let message = "M99 in the main program repeats it without end: it is read as the end \
                of the program"
                .to_owned();
            self.core.warn("endless-main", 0, at, message, "write M30");
            self.core.emit(crate::moves::Event::End);
            return Ok(Next::Finished);
        }
        frame.repeats = frame.repeats.saturating_sub(1);
        if frame.repeats > 0 {
            self.core.count(at)?;
            let frame = self.frame();
            let (start, line) = frame.entry;
            (frame.at, frame.line, frame.named) = (start, line, start > 0);
            return Ok(Next::Jumped);
        }
        if let Some(ended) = self.stack.pop() {
            self.restore_at_return(&ended.saved, at)?;
            if ended.shares_locals {
                self.frame().locals = ended.locals;
            }
        }
        let depth = self.stack.len();
        self.modes.macros.retain(|m| m.depth <= depth);
        match back {
            Some(number) => self.jump_to_number(number, at),
            None => Ok(Next::Jumped),
        }
    }

    /// P of M99: to a block of the program that is now on top.
    fn jump_to_number(&mut self, number: f64, at: usize) -> Result<Next, Fault> {
        self.core.count(at)?;
        let (program, from) = (self.frame().program, self.frame().at);
        let caller = Rc::clone(&self.core.programs[program]);
        // The caller continues after its block: that byte less one lies within the same program.
        let found = caller.structure().block_number(number as u64, from.saturating_sub(1));
        let Some((start, line)) = found.filter(|_| number >= 0.0) else {
            return Err(mistakes::missing_label(format_args!("N{number}"), at));
        };
        let frame = self.frame();
        (frame.at, frame.line) = (start, line);
        Ok(Next::Jumped)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn second_and_third_sets_of_ijk_go_on_counting() {
        let arguments =
            [(b'A', 1.0), (b'I', 4.0), (b'K', 6.0), (b'I', 7.0), (b'J', 8.0), (b'I', 10.0)];
        let found = locals_of(&arguments, 0).unwrap().numbers;
        let numbers: Vec<_> = (0..34).filter(|i| found[*i] == Some(*i as f64)).collect();
        assert_eq!(numbers, [1, 4, 6, 7, 8, 10]);
    }
}
