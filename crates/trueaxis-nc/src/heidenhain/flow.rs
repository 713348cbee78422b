//! Labels, calls, jumps, and where programs end.

use std::collections::HashMap;
use std::rc::Rc;

use super::line::{Cursor, Line};
use super::variables::Variable;
use super::{Next, Run, fault};
use crate::execution::mistakes;
use crate::moves::Event;
use crate::text::program::{Fault, Program};

/// `LBL 5` or `LBL "UP"`.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub(super) enum Label {
    Number(u64),
    Name(String),
}

/// Labels with the byte and line of their blocks.
pub(super) type Labels = HashMap<Label, (usize, u32)>;

/// Why something is executed.
#[derive(Debug, Clone, PartialEq)]
enum Reason {
    Main,
    Program,
    Label(Label),
}

/// A program or subprogram that is being executed, and where.
pub(super) struct Activation {
    pub program: usize,
    pub at: usize,
    pub line: u32,
    reason: Reason,
    /// Remaining rounds of program section repeats by their byte.
    rounds: HashMap<usize, u64>,
    /// BEGIN PGM was read.
    begun: bool,
}

impl Activation {
    pub fn main() -> Self {
        Self::new(0, 0, 1, Reason::Main)
    }

    fn new(program: usize, at: usize, line: u32, reason: Reason) -> Self {
        Self { program, at, line, reason, rounds: HashMap::new(), begun: false }
    }
}

impl Run<'_> {
    fn active(&mut self) -> &mut Activation {
        // why: the stack is never empty while a block is executed.
        self.stack.last_mut().expect("every block belongs to an activation")
    }

    /// BEGIN PGM name MM.
    pub(super) fn begin(&mut self, c: &mut Cursor<'_>) -> Result<Next, Fault> {
        let at = c.offset();
        if !c.accept("PGM") {
            return Err(c.unknown());
        }
        let rest = c.rest().to_ascii_uppercase();
        let inches = rest.split_whitespace().last() == Some("INCH");
        if !inches && rest.split_whitespace().last() != Some("MM") {
            let message = "BEGIN PGM states neither MM nor INCH: MM is assumed";
            self.core.warn("no-unit", "begin", at, message, "write BEGIN PGM name MM");
        }
        self.active().begun = true;
        self.core.modes.inches = inches;
        Ok(Next::Following)
    }

    /// END PGM, and every other way in which a program is at its end.
    pub(super) fn end(&mut self, at: usize) -> Result<Next, Fault> {
        let reason = self.active().reason.clone();
        match reason {
            Reason::Main => {
                self.core.emit(Event::End);
                Ok(Next::Finished)
            }
            Reason::Program => {
                self.stack.pop();
                self.variables.leave();
                Ok(Next::Jumped)
            }
            Reason::Label(label) => {
                let message = format!("the subprogram {} has no end", show(&label));
                Err(self.core.for_good(fault("missing-end", at, message, "end it with LBL 0")))
            }
        }
    }

    pub(super) fn end_of_text(&mut self, program: &Program) -> Result<Next, Fault> {
        let at = program.source().len();
        let begun = self.stack.iter().rev().take_while(|a| a.begun).count() > 0;
        if begun && !matches!(self.active().reason, Reason::Label(_)) {
            let message = "END PGM is missing";
            return Err(fault(
                "truncated-program",
                at,
                message,
                "check whether the file is complete",
            ));
        }
        self.end(at)
    }

    /// LBL: a place to go to; LBL 0 ends a subprogram.
    pub(super) fn label(&mut self, c: &mut Cursor<'_>) -> Result<Next, Fault> {
        let label = self.label_name(c)?;
        c.finish()?;
        if label != Label::Number(0) {
            return Ok(Next::Following);
        }
        if matches!(self.active().reason, Reason::Label(_)) {
            self.stack.pop();
            return Ok(Next::Jumped);
        }
        Ok(Next::Following)
    }

    fn label_name(&mut self, c: &mut Cursor<'_>) -> Result<Label, Fault> {
        if let Some(name) = c.text() {
            return Ok(Label::Name(name));
        }
        let at = c.offset();
        if c.is("QS") {
            return Ok(Label::Name(self.text(c)?));
        }
        match self.operand(c)? {
            Some(n) if (0.0..65_536.0).contains(&n) => Ok(Label::Number(n.round() as u64)),
            _ => {
                let message = "the number or name of the label is missing".to_owned();
                Err(fault("bad-label", at, message, "write LBL 1 or LBL \"NAME\""))
            }
        }
    }

    /// CALL LBL, CALL PGM, CALL SELECTED PGM.
    pub(super) fn call(&mut self, c: &mut Cursor<'_>) -> Result<Next, Fault> {
        let at = c.start;
        if c.accept("LBL") {
            let label = self.label_name(c)?;
            if label == Label::Number(0) {
                let message = "LBL 0 is the end of subprograms";
                return Err(fault("bad-label", at, message, "call LBL 1 to LBL 65535"));
            }
            if c.accept("REP") {
                return self.repeat(label, c);
            }
            c.finish()?;
            return self.call_label(label, at);
        }
        if c.accept("PGM") {
            let name = if c.is("QS") { self.text(c)? } else { c.rest() };
            return self.call_program(&name, at);
        }
        if c.accept("SELECTED") && c.accept("PGM") {
            return match self.selected.clone() {
                Some(name) => self.call_program(&name, at),
                None => {
                    let message = "no program is selected";
                    Err(fault("missing-subprogram", at, message, "write SEL PGM before it"))
                }
            };
        }
        Err(c.unknown())
    }

    fn call_label(&mut self, label: Label, at: usize) -> Result<Next, Fault> {
        self.core.count(at)?;
        self.core.check_depth(self.stack.len(), at)?;
        let (start, line) = self.find_label(&label, at)?;
        let program = self.active().program;
        self.stack.push(Activation::new(program, start, line, Reason::Label(label)));
        Ok(Next::Jumped)
    }

    /// CALL LBL … REP n: back to the label n times more.
    fn repeat(&mut self, label: Label, c: &mut Cursor<'_>) -> Result<Next, Fault> {
        let at = c.start;
        let wanted = self.value(c)?;
        if c.accept_symbol(b'/') {
            // REP 3/2: how many are left, which only the display needs.
            self.value(c)?;
        }
        c.finish()?;
        if !(0.0..1e9).contains(&wanted) {
            let message = format!("expected a whole number of repeats, found {wanted}");
            return Err(fault("bad-repeats", at, message, "write REP 3"));
        }
        let left = self.active().rounds.entry(at).or_insert(wanted.round() as u64);
        if *left == 0 {
            self.active().rounds.remove(&at);
            return Ok(Next::Following);
        }
        *left -= 1;
        self.jump(&label, at)
    }

    fn jump(&mut self, label: &Label, at: usize) -> Result<Next, Fault> {
        let (start, line) = self.find_label(label, at)?;
        if start <= at {
            self.core.count(at)?;
        }
        let active = self.active();
        (active.at, active.line) = (start, line);
        Ok(Next::Jumped)
    }

    /// Where a label of the present program stands.
    fn find_label(&mut self, label: &Label, at: usize) -> Result<(usize, u32), Fault> {
        let number = self.active().program;
        let labels = match self.labels.get(&number) {
            Some(labels) => Rc::clone(labels),
            None => {
                let labels = Rc::new(find_labels(&self.core.programs[number]));
                self.labels.insert(number, Rc::clone(&labels));
                labels
            }
        };
        labels.get(label).copied().ok_or_else(|| mistakes::missing_label(show(label), at))
    }

    /// Enters another program: by its name, with .H, or the last part of its path.
    pub(super) fn call_program(&mut self, name: &str, at: usize) -> Result<Next, Fault> {
        self.core.count(at)?;
        self.core.check_depth(self.stack.len(), at)?;
        let name = name.trim().trim_matches('"').trim();
        let last = name.rsplit(['\\', '/', ':']).next().unwrap_or(name);
        let known = [name, last].into_iter().filter(|base| !base.is_empty());
        let names = known.flat_map(|base| ["", ".H", ".h"].map(|ending| format!("{base}{ending}")));
        let number = self.core.load(name, names, at)?;
        self.variables.enter();
        self.stack.push(Activation::new(number, 0, 1, Reason::Program));
        Ok(Next::Jumped)
    }

    /// SEL PGM; SEL TABLE and the like only choose what is not read here.
    pub(super) fn select(&mut self, c: &mut Cursor<'_>) -> Result<Next, Fault> {
        let at = c.start;
        if c.accept("PGM") {
            self.selected = Some(if c.is("QS") { self.text(c)? } else { c.rest() });
            return Ok(Next::Following);
        }
        if let Some(what) = c.accept_any(&["PATTERN", "TABLE", "CONTOUR", "CORR", "CYCLE"]) {
            c.leave();
            if what == 0 {
                // Its places are in a table that is not read.
                self.pattern.clear();
            }
            self.core.left_out("SEL of a table, pattern or contour", at);
            return Ok(Next::Following);
        }
        Err(c.unknown())
    }

    /// `IF +Q1 EQU +5 GOTO LBL 2` of FN 9 to FN 12.
    pub(super) fn branch(&mut self, c: &mut Cursor<'_>) -> Result<Next, Fault> {
        let at = c.start;
        if !c.accept("IF") {
            return Err(c.unknown());
        }
        let mut ahead = c.clone();
        let _ = ahead.accept_symbol(b'+');
        let variable = self.variable(&mut ahead)?;
        let holds = match variable.filter(|_| ahead.is("IS")) {
            Some(variable) => {
                *c = ahead;
                c.accept("IS");
                let defined = self.is_defined(variable);
                match c.accept_any(&["DEFINED", "UNDEFINED"]) {
                    Some(index) => defined == (index == 0),
                    None => return Err(c.unknown()),
                }
            }
            None if matches!(variable, Some(Variable::Text(_))) => {
                let left = self.text(c)?;
                let equal = c.accept_any(&["EQU", "NE"]);
                let right = self.text(c)?;
                (left == right) == (equal == Some(0))
            }
            None => {
                let left = self.value(c)?;
                let Some(operator) = c.accept_any(&["EQU", "NE", "GT", "LT"]) else {
                    return Err(c.unknown());
                };
                let right = self.value(c)?;
                match operator {
                    0 => left == right,
                    1 => left != right,
                    2 => left > right,
                    _ => left < right,
                }
            }
        };
        if !c.accept("GOTO") || !c.accept("LBL") {
            return Err(c.unknown());
        }
        let label = self.label_name(c)?;
        c.finish()?;
        if holds { self.jump(&label, at) } else { Ok(Next::Following) }
    }
}

/// All labels of a program; the first one of a name counts.
fn find_labels(program: &Program) -> Labels {
    let source = program.source();
    let mut found = HashMap::new();
    let (mut at, mut number, mut line) = (0, 1_u32, Line::default());
    while at < source.len() {
        line.read(source, program.dialect(), at);
        let mut c = Cursor::new(source, &line);
        if c.accept("LBL") {
            let label = match c.text() {
                Some(name) => Some(Label::Name(name)),
                None => c.whole().ok().flatten().map(|n| Label::Number(u64::from(n))),
            };
            if let Some(label) = label {
                found.entry(label).or_insert((at, number));
            }
        }
        at = line.end;
        number = number.saturating_add(line.lines);
    }
    found
}

fn show(label: &Label) -> String {
    match label {
        Label::Number(number) => format!("LBL {number}"),
        Label::Name(name) => format!("LBL \"{name}\""),
    }
}
