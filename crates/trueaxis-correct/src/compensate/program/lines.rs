//! The changed line of a block and the lines that follow it.

use super::block::{Block, Put};
use std::ops::Range;
use trueaxis_nc::Control;

impl Block<'_> {
    /// The block itself: what is added goes after the words that are there.
    pub(super) fn first(&mut self, puts: Vec<Put>) {
        let (room, end) = (self.words.room(self.control), self.words.end);
        if self.is_circle() && self.arc.is_none() {
            self.line_for_circle();
        }
        let vectors = puts.iter().any(|p| p.letters == "TX");
        if let (true, Some(motion)) = (vectors, &self.words.motion)
            && motion.len() == 1
        {
            self.edits.put(motion.clone(), "LN");
        }
        for put in puts {
            let at = if put.letters == "F" { end } else { room };
            self.edits.put_with(at..at, |out| out.extend([" ", put.letters, &put.text]));
        }
    }

    fn line_for_circle(&mut self) {
        let line = if self.control == Control::Heidenhain { "L" } else { "G1" };
        match &self.words.motion {
            Some(motion) => self.edits.put(motion.clone(), line),
            None => {
                let at = self.words.front;
                let beginning = at == 0 || matches!(self.source[at - 1], b'\n' | b'\r');
                let text = if beginning { format!("{line} ") } else { format!(" {line}") };
                self.edits.put(at..at, &text);
            }
        }
        for range in &self.words.circle_words {
            self.edits.put(range.clone(), "");
        }
    }

    /// A line of its own for a further piece.
    pub(super) fn follow(&mut self, puts: &[Put]) {
        let klartext = self.control == Control::Heidenhain;
        let mut line = String::new();
        if let Some(skip) = &self.words.skip {
            line.push_str(&self.text_of(skip));
            line.push(' ');
        }
        if klartext {
            line.push_str(if puts.iter().any(|p| p.letters == "TX") { "LN" } else { "L" });
        } else if self.words.machine.is_some() {
            let supa = self.control == Control::Sinumerik840d;
            line.push_str(if supa { "SUPA" } else { "G53" });
        }
        for put in puts {
            if !line.is_empty() && !line.ends_with(' ') {
                line.push(' ');
            }
            line.push_str(put.letters);
            line.push_str(&put.text);
        }
        if klartext && self.words.machine.is_some() {
            line.push_str(" M91");
        }
        self.further.push(line);
    }

    /// M functions that act after the travel go to the last piece.
    pub(super) fn functions_at_end(&mut self) {
        if self.further.is_empty() {
            return;
        }
        for range in &self.words.at_end {
            self.edits.put(range.clone(), "");
            let text = self.text_of(range);
            if let Some(last) = self.further.last_mut() {
                last.push(' ');
                last.push_str(&text);
            }
        }
    }

    fn text_of(&self, range: &Range<usize>) -> String {
        String::from_utf8_lossy(&self.source[range.clone()]).into_owned()
    }
}
