//! Comments that do something: MSG, DEBUG, PRINT, LOG, ABORT.

use crate::execution::mistakes;
use crate::moves::Event;
use crate::rs274::parameters::Parameter;
use crate::rs274::{Passage, Run};
use crate::text::program::{Fault, Item};

impl Run<'_> {
    /// Comments that do something: MSG, DEBUG, PRINT, LOG, ABORT.
    pub(in crate::rs274) fn comments(&mut self, passage: Passage<'_>) -> Result<(), Fault> {
        if !passage.program.dialect().o_words {
            self.outputs(passage);
            return Ok(());
        }
        for item in &passage.block.items {
            let Item::Comment(span) = item else { continue };
            let text = &passage.program.source()[span.clone()];
            let inner = match text {
                [b'(', inner @ .., b')'] => inner,
                [b';', inner @ ..] => inner,
                _ => continue,
            };
            let Some(comma) = inner.iter().position(|b| *b == b',') else { continue };
            let key: String = String::from_utf8_lossy(&inner[..comma])
                .chars()
                .filter(|c| !c.is_whitespace())
                .collect::<String>()
                .to_ascii_lowercase();
            let rest = String::from_utf8_lossy(&inner[comma + 1..]).into_owned();
            match key.as_str() {
                "msg" => self.core.emit(Event::Message(rest)),
                "debug" => {
                    let text = self.filled(&rest);
                    self.core.emit(Event::Message(text));
                }
                "print" | "log" => {
                    let text = self.filled(&rest);
                    self.core.emit(Event::Log(text));
                }
                "abort" => {
                    let text = self.filled(&rest);
                    return Err(self.core.for_good(mistakes::alarm(&text, span.start)));
                }
                _ => {}
            }
        }
        Ok(())
    }

    /// `DPRNT[H1*X#5061[44]]` of FANUC: what it would write.
    ///
    /// # Source
    /// The form that the manuals of Haas (96-8000, formatted output) and NCT (2000M, custom macro) print: text, `*`
    /// for a blank, `#number[places before, places after the point]`.
    fn outputs(&mut self, passage: Passage<'_>) {
        for item in &passage.block.items {
            let Item::Comment(span) = item else { continue };
            let text = String::from_utf8_lossy(&passage.program.source()[span.clone()]);
            let plain: String = text.chars().filter(|c| !c.is_whitespace()).collect();
            if let Some(inner) = plain.strip_prefix("DPRNT[").and_then(|t| t.strip_suffix(']')) {
                let text = self.printed(inner);
                self.core.emit(Event::Log(text));
            }
        }
    }

    fn printed(&self, text: &str) -> String {
        let mut out = String::new();
        let mut rest = text;
        while let Some(index) = rest.find(['#', '*']) {
            out.push_str(&rest[..index]);
            let after = &rest[index + 1..];
            let value = rest[index..].starts_with('#').then(|| places(after)).flatten();
            match value {
                Some((number, decimals, end)) => {
                    let value = self.read(&Parameter::Number(number)).unwrap_or(0.0);
                    out.push_str(&format!("{value:.decimals$}"));
                    rest = &after[end..];
                }
                None => {
                    out.push(if rest[index..].starts_with('*') { ' ' } else { '#' });
                    rest = after;
                }
            }
        }
        out + rest
    }

    /// The text with the values of parameters in their places; `%d`, `%f`, `%.3f` set the digits.
    fn filled(&self, text: &str) -> String {
        let mut out = String::new();
        let mut digits = 6;
        let mut rest = text;
        while let Some(index) = rest.find(['#', '%']) {
            out.push_str(&rest[..index]);
            rest = &rest[index..];
            if let Some((found, after)) = format_digits(rest) {
                digits = found;
                rest = after;
                continue;
            }
            match self.reference_in_text(rest) {
                Some((value, after)) => {
                    match value {
                        Some(value) => out.push_str(&format!("{value:.digits$}")),
                        None => out.push_str("######"),
                    }
                    rest = after;
                }
                None => {
                    out.push_str(&rest[..1]);
                    rest = &rest[1..];
                }
            }
        }
        out + rest
    }

    fn reference_in_text<'t>(&self, text: &'t str) -> Option<(Option<f64>, &'t str)> {
        let after = text.strip_prefix('#')?;
        if let Some(named) = after.strip_prefix('<') {
            let (name, rest) = named.split_once('>')?;
            let plain: String = name.chars().filter(|c| !c.is_whitespace()).collect();
            return Some((self.read(&Parameter::Name(plain.to_ascii_lowercase())), rest));
        }
        let end = after.find(|c: char| !c.is_ascii_digit()).unwrap_or(after.len());
        let number = after[..end].parse().ok()?;
        let value = self.read(&Parameter::Number(number));
        Some((value.or(self.is_in_range(number).then_some(0.0)), &after[end..]))
    }
}

/// `5061[44]`: the number of the variable, the decimals, and where it ends.
fn places(text: &str) -> Option<(u32, usize, usize)> {
    let (number, rest) = text.split_once('[')?;
    let (digits, _) = rest.split_once(']')?;
    let decimals = digits.chars().nth(1).and_then(|c| c.to_digit(10))? as usize;
    Some((number.parse().ok()?, decimals, number.len() + digits.len() + 2))
}

/// `%d`, `%f` or `%.nf` at the beginning of a text: the digits after the point, and the rest.
fn format_digits(text: &str) -> Option<(usize, &str)> {
    let after = text.strip_prefix('%')?;
    if let Some(rest) = after.strip_prefix('d') {
        return Some((0, rest));
    }
    if let Some(rest) = after.strip_prefix('f') {
        return Some((4, rest));
    }
    let (digits, rest) = after.strip_prefix('.')?.split_once('f')?;
    let digits: usize = digits.parse().ok()?;
    (digits <= 17).then_some((digits, rest))
}
